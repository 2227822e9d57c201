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


class Ties:
    """@param plant not yet finalised   @param rigid Drake's bodies by the number of the body"""

    def __init__(self, job: Job, bodies: list[Body], plant: Any, rigid: dict[int, Any]) -> None:
        self.bodies, self.plant, self.rigid = bodies, plant, rigid
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
            made = tree.BallRpyJoint(joint.name, *ends)
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
        from pydrake.math import RigidTransform, RotationMatrix
        from pydrake.multibody.tree import FixedOffsetFrame, UniversalJoint

        first, second = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
        axes = np.column_stack([first, second, np.cross(first, second)])
        ends = []
        for number, name in ((link.parent, "x"), (link.number, "y")):
            number = number if number in self.rigid else WORLD
            pose = transform(*pose_in(self.bodies, number, joint.place, IDENTITY))
            turned = pose @ RigidTransform(RotationMatrix(axes), [0.0, 0.0, 0.0])
            ends.append(
                self.plant.AddFrame(FixedOffsetFrame(f"{joint.name} {name}", self.body(number).body_frame(), turned))
            )
        return UniversalJoint(joint.name, *ends, damping=0.0)

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

    def start(self, context: Any, coordinates: Any) -> None:
        if coordinates is not None:
            self.plant.SetPositionsAndVelocities(context, coordinates)
        for link, made in self.joints if coordinates is None else ():
            joint = link.joint
            assert joint
            turn = subtract(self.bodies[link.number].spin, spin_of(self.bodies, link.parent))
            if joint.kind == "ball":
                made.set_angular_velocity(context, list(turn))
            elif joint.kind == "universal":
                axes = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
                made.set_angular_rates(context, [dot(turn, axis) for axis in axes])
            elif joint.kind == "hinge":
                made.set_angular_rate(context, start_rate(joint, self.bodies))
            elif joint.kind == "slider":
                made.set_translation_rate(context, start_rate(joint, self.bodies))
        if self.motors:
            self.plant.get_actuation_input_port().FixValue(context, [effort for _, effort in self.motors])

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
