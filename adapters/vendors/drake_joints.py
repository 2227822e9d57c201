# SPDX-License-Identifier: BSD-3-Clause
"""Joints and springs of a job in Drake's MultibodyPlant. Loops are constraints of its discrete update alone."""

from __future__ import annotations

from typing import Any

from contract import Job
from joints import WORLD, Joint, Link, Side, joints_of, laws_of, pose_in, spin_of, springs_of, start_rate, tree_of
from rigid import Body
from rotation import IDENTITY, Quaternion, Vector, add, dot, rotate, scaled, subtract

KINDS = ("hinge", "ball", "slider", "fixed", "distance", "universal")
LAWS = ("limits", "damping", "spring", "effort")
LOOPS = "hinge ball fixed distance"
PITCH = 0.8  # of a ball joint, beyond which its axes are chosen anew [rad]


def refuse_continuous(job: Job, bodies: list[Body]) -> str:
    """What the integrators of continuous plants leave out."""
    joints = joints_of(job, bodies)
    for joint in tree_of(bodies, joints)[1]:
        return f"Drake closes loops in its discrete update alone, and {joint.name} closes one"
    limited = [joint.name for joint in joints if "limits" in laws_of(joint)]
    return f"Drake has limits of joints in its discrete update alone, and {limited[0]} has some" if limited else ""


def transform(at: Vector, turn: Quaternion) -> Any:
    from pydrake.common.eigen_geometry import Quaternion as Turn
    from pydrake.math import RigidTransform

    length = sum(c * c for c in turn) ** 0.5
    return RigidTransform(Turn([c / length for c in turn]), list(at))


def first_direction(vectors: list[Any]) -> Any:
    """The first that is no zero, as a unit vector."""
    sizes = [float(v @ v) ** 0.5 for v in vectors]
    return next(v / size for v, size in zip(vectors, sizes) if size > 1e-9 * max(sizes))


def axes_about(directions: list[Any]) -> Any:
    """Columns x, y, z of a frame, x along the first direction that is no zero."""
    import numpy as np

    x = first_direction([*directions, np.eye(3)[0]])
    z = first_direction([v - x * (x @ v) for v in (*directions[1:], *np.eye(3))])
    return np.column_stack([x, np.cross(z, x), z])


def vector_of(values: Any) -> Vector:
    return (float(values[0]), float(values[1]), float(values[2]))


class Ties:
    """@param plant not yet finalised   @param rigid Drake's bodies by the number of the body
    @param balls axes of ball joints at parent and child, at the start in the world's frame; made where they lack"""

    def __init__(self, job: Job, bodies: list[Body], plant: Any, rigid: dict[int, Any], balls: dict[str, Any]) -> None:
        self.bodies, self.plant, self.rigid, self.balls = bodies, plant, rigid, balls
        self.links, self.loops = tree_of(bodies, joints_of(job, bodies))
        self.springs: dict[str, Any] = {}
        self.held_by_joints = {link.number for link in self.links if link.joint}
        self.joints = [(link, self.add(link)) for link in self.links if link.joint]
        for joint in self.loops:
            self.close(joint)
        for one, other, stiffness, damping, length in springs_of(job, bodies):
            self.add_spring(one, other, stiffness, damping, length)
        self.motors = [
            (self.plant.AddJointActuator(f"motor of {link.joint.name}", made), link.joint.effort)
            for link, made in self.joints
            if link.joint and link.joint.effort != 0.0
        ]

    def body(self, number: int) -> Any:
        return self.rigid.get(number) or self.plant.world_body()

    def end(self, side: Side) -> Vector:
        """Place of a side in the frame of Drake's body [m]: of the world for fixed ones."""
        if side.number == WORLD or side.number in self.rigid:
            return side.point
        body = self.bodies[side.number]
        return add(body.centre, rotate(body.frame, side.point))

    def frame(self, number: int, joint: Joint, name: str) -> Any:
        """At the joint, with the axes of the world at the start."""
        from pydrake.multibody.tree import FixedOffsetFrame

        number = number if number in self.rigid else WORLD
        pose = transform(*pose_in(self.bodies, number, joint.place, IDENTITY))
        return self.plant.AddFrame(FixedOffsetFrame(name, self.body(number).body_frame(), pose))

    def add(self, link: Link) -> Any:
        from pydrake.multibody import tree

        joint = link.joint
        assert joint
        names = (f"{joint.name} parent", f"{joint.name} child")
        ends = [self.frame(link.parent, joint, names[0]), self.frame(link.number, joint, names[1])]
        axis = list(scaled(link.sign, joint.axis))
        if joint.kind == "hinge":
            made = tree.RevoluteJoint(joint.name, *ends, axis, damping=joint.damping)
        elif joint.kind == "slider":
            made = tree.PrismaticJoint(joint.name, *ends, axis, damping=joint.damping)
        elif joint.kind == "ball":
            both = self.balls.setdefault(joint.name, (self.axes_of_ball(link.number, joint),) * 2)
            numbers = (link.parent, link.number)
            made = tree.BallRpyJoint(joint.name, *(self.turned(n, joint, axes) for n, axes in zip(numbers, both)))
        elif joint.kind == "fixed":
            made = tree.WeldJoint(joint.name, *ends, transform((0.0, 0.0, 0.0), IDENTITY))
        else:
            made = self.universal(link, joint)
        made = self.plant.AddJoint(made)
        if joint.limits:
            made.set_position_limits([joint.limits[0]], [joint.limits[1]])
        if joint.stiffness > 0.0:
            spring = tree.RevoluteSpring if joint.kind == "hinge" else tree.PrismaticSpring
            self.springs[joint.name] = self.plant.AddForceElement(spring(made, joint.rest, joint.stiffness))
        return made

    def universal(self, link: Link, joint: Joint) -> Any:
        """Drake's first axis is x of the parent's frame, its second y of the child's."""
        import numpy as np
        from pydrake.multibody.tree import UniversalJoint

        first, second = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
        axes = np.column_stack([first, second, np.cross(first, second)])
        return UniversalJoint(
            joint.name, *(self.turned(n, joint, axes) for n in (link.parent, link.number)), damping=0.0
        )

    def turned(self, number: int, joint: Joint, axes: Any) -> Any:
        """A frame of a body at the joint. @param axes columns, at the start in the world's frame"""
        from pydrake.math import RigidTransform, RotationMatrix
        from pydrake.multibody.tree import FixedOffsetFrame

        own = number if number in self.rigid else WORLD
        pose = transform(*pose_in(self.bodies, own, joint.place, IDENTITY))
        frame = pose @ RigidTransform(RotationMatrix(axes), [0.0, 0.0, 0.0])
        return self.plant.AddFrame(
            FixedOffsetFrame(f"{joint.name} axes of {number}", self.body(own).body_frame(), frame)
        )

    def axes_of_ball(self, number: int, joint: Joint) -> Any:
        """x along the angular velocity at the start, else the axis about which weight swings the body."""
        import numpy as np

        body, down = self.bodies[number], np.array(self.plant.gravity_field().gravity_vector())
        arm = np.subtract(body.centre, joint.place)
        return axes_about([np.array(body.spin), np.cross(arm, down), arm])

    def turn_balls(self, context: Any) -> dict[str, Vector]:
        """BallRpyJoint counts roll, pitch and yaw about x, y and z, and has no coordinates at a pitch of 90 degrees.

        Chooses axes anew for each ball whose pitch is large. @return angular velocities about these axes, by joint"""
        import numpy as np

        found = {}
        for link, made in self.joints:
            if not link.joint or link.joint.kind != "ball" or abs(made.get_angles(context)[1]) < PITCH:
                continue
            parent, child = self.balls[link.joint.name]
            ends = (made.frame_on_parent(), made.frame_on_child())
            now = [end.CalcPoseInWorld(context).rotation().matrix() for end in ends]
            turn_of_parent, turn_of_child = now[0] @ parent.T, now[1] @ child.T
            spin = turn_of_parent.T @ now[0] @ np.array(made.get_angular_velocity(context))
            axes = axes_about([spin, parent[:, 0]])
            self.balls[link.joint.name] = (axes, turn_of_child.T @ turn_of_parent @ axes)
            found[link.joint.name] = vector_of(axes.T @ spin)
        return found

    def close(self, joint: Joint) -> None:
        one, other = (self.rigid.get(side.number) or self.ground() for side in (joint.one, joint.other))
        p, q = (list(self.end(side)) for side in (joint.one, joint.other))
        if joint.kind == "distance":
            length = sum(c * c for c in subtract(joint.place, joint.other_place)) ** 0.5
            self.plant.AddDistanceConstraint(one, p, other, q, length)
        elif joint.kind == "fixed":
            poses = [
                transform(*pose_in(self.bodies, n if n in self.rigid else WORLD, joint.place, IDENTITY))
                for n in joint.numbers
            ]
            self.plant.AddWeldConstraint(one, poses[0], other, poses[1])
        else:
            ways = (-0.5, 0.5) if joint.kind == "hinge" else (0.0,)  # of a hinge two points of its axis
            for way in ways:
                place = add(joint.place, scaled(way, joint.axis))
                ends = [
                    list(pose_in(self.bodies, n if n in self.rigid else WORLD, place, IDENTITY)[0])
                    for n in joint.numbers
                ]
                self.plant.AddBallConstraint(one, ends[0], other, ends[1])

    def ground(self) -> Any:
        """A body that is welded to the world: a constraint of the world itself ends Drake 1.51 by a signal."""
        from pydrake.multibody.tree import SpatialInertia, UnitInertia

        if not self.plant.HasBodyNamed("ground"):
            held = self.plant.AddRigidBody("ground", SpatialInertia(1.0, [0.0, 0.0, 0.0], UnitInertia(1.0, 1.0, 1.0)))
            self.plant.WeldFrames(self.plant.world_frame(), held.body_frame())
        return self.plant.GetBodyByName("ground")

    def add_spring(self, one: Side, other: Side, stiffness: float, damping: float, length: float) -> None:
        from pydrake.multibody.tree import LinearSpringDamper

        ends = (self.body(one.number), list(self.end(one)), self.body(other.number), list(self.end(other)))
        self.plant.AddForceElement(LinearSpringDamper(*ends, length, stiffness, damping))

    def coordinates(self, context: Any) -> Any:
        """Of joints and bodies, to go on with in a plant of another step."""
        return self.plant.GetPositionsAndVelocities(context) if self.joints else None

    def start(self, context: Any, coordinates: Any, turned: dict[str, Vector]) -> None:
        """@param turned  angular velocities of the balls whose axes are new"""
        if coordinates is not None:
            self.plant.SetPositionsAndVelocities(context, coordinates)
        for link, made in self.joints:
            assert link.joint
            if link.joint.name in turned:
                made.set_angles(context, [0.0, 0.0, 0.0])
                made.set_angular_velocity(context, list(turned[link.joint.name]))
            elif coordinates is None:
                self.start_joint(context, link, made)
        if self.motors:
            self.plant.get_actuation_input_port().FixValue(context, [effort for _, effort in self.motors])

    def start_joint(self, context: Any, link: Link, made: Any) -> None:
        """Gives a joint the rates of its bodies at the start."""
        joint = link.joint
        assert joint
        turn = subtract(self.bodies[link.number].spin, spin_of(self.bodies, link.parent))
        if joint.kind == "ball":
            made.set_angular_velocity(context, [dot(turn, tuple(axis)) for axis in self.balls[joint.name][0].T])
        elif joint.kind == "universal":
            axes = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
            made.set_angular_rates(context, [dot(turn, axis) for axis in axes])
        elif joint.kind == "hinge":
            made.set_angular_rate(context, start_rate(joint, self.bodies))
        elif joint.kind == "slider":
            made.set_translation_rate(context, start_rate(joint, self.bodies))

    def held(self) -> list[dict[str, Any]]:
        """Laws of the joints, as Drake holds them."""
        out = []
        for link, made in self.joints:
            assert link.joint
            damping = max(map(float, made.default_damping_vector()), default=0.0)
            name = link.joint.name
            spring = self.springs.get(name)
            stiffness = getattr(spring, "default_stiffness", None) or getattr(spring, "stiffness", float)
            out.append({"name": name, "damping": damping, "stiffness": float(stiffness())})
        return out
