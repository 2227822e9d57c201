# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a job in Rapier: impulse joints between free bodies, or a multibody, which is its reduced coordinates.

A multibody damps each coordinate by 0.1 N m s/rad as it comes (`Multibody.damping`); here it is set to 0 and read
back, but in the preset `multibody-as-it-comes`."""

from __future__ import annotations

from typing import Any

from contract import Job
from joints import WORLD, Joint, across_of, joints_of, pose_in, tree_of
from rigid import Body
from rotation import Quaternion, Vector, cross, normalised, scaled

KINDS = ("hinge", "ball", "slider", "fixed")
LAWS = ("limits", "damping", "spring")
LOCKED = {"hinge": "REVOLUTE", "ball": "SPHERICAL", "slider": "PRISMATIC", "fixed": "FIXED"}
REDUCED = ("multibody", "multibody-as-it-comes")  # presets


def quaternion_of(x: Vector, y: Vector, z: Vector) -> Quaternion:
    """The rotation that takes the axes of the world to x, y, z."""
    w2 = 1.0 + x[0] + y[1] + z[2]
    if w2 > 1e-6:
        return normalised((w2, y[2] - z[1], z[0] - x[2], x[1] - y[0]))
    largest = max(range(3), key=lambda k: (x[0], y[1], z[2])[k])  # half a turn
    column = [((x[0] + 1.0), x[1], x[2]), (y[0], (y[1] + 1.0), y[2]), (z[0], z[1], (z[2] + 1.0))][largest]
    return normalised((0.0, *column))


class Ties:
    """@param isometry makes Rapier's of a place and an orientation"""

    def __init__(self, rapier: Any, world: Any, job: Job, bodies: list[Body], handles: dict[int, Any], isometry: Any):
        self.rapier, self.world, self.bodies, self.handles = rapier, world, bodies, dict(handles)
        self.isometry = isometry
        joints = joints_of(job, bodies)
        if any(WORLD in joint.numbers for joint in joints):
            ground = rapier.RigidBody.fixed().position(isometry((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))
            self.handles[WORLD] = world.add_body(ground, [])
        self.names: dict[str, Any] = {}  # joint -> handle
        self.motors: dict[str, Any] = {}  # joint -> axis of its spring and damper
        self.reduced, self.as_it_comes = job.preset in REDUCED, job.preset == REDUCED[1]
        if not self.reduced:
            for joint in joints:
                self.names[joint.name] = self.insert(world.impulse_joints, joint, joint.other.number, joint.one.number)
            return
        for link in tree_of(bodies, joints)[0]:
            if link.joint:
                numbers = link.joint.numbers
                parent = numbers[1] if link.sign > 0.0 else numbers[0]
                self.names[link.joint.name] = self.insert(
                    world.multibody_joints, link.joint, parent, link.number, link.sign
                )
        if not self.as_it_comes:
            self.undamp()

    def undamp(self) -> None:
        for handle in self.names.values():
            held = self.world.multibody_joints.multibody(handle)
            count = held.ndofs if not callable(held.ndofs) else held.ndofs()
            held.set_damping([0.0] * count)

    def insert(self, joints: Any, joint: Joint, parent: int, child: int, sign: float = 1.0) -> Any:
        rapier = self.rapier
        axis = scaled(sign, joint.axis)
        across = across_of(joint)
        turn = quaternion_of(axis, across, cross(axis, across))  # x is the axis, as in Rapier
        mask = getattr(rapier.JointAxesMask, f"LOCKED_{LOCKED[joint.kind]}_AXES")
        made = rapier.GenericJoint.builder(mask).contacts_enabled(False)
        made = made.local_frame1(self.isometry(*pose_in(self.bodies, parent, joint.place, turn)))
        made = made.local_frame2(self.isometry(*pose_in(self.bodies, child, joint.place, turn)))
        along = rapier.JointAxis.LIN_X if joint.kind == "slider" else rapier.JointAxis.ANG_X
        if joint.limits:
            made = made.limits(along, *joint.limits)
        if joint.damping > 0.0 or joint.stiffness > 0.0:
            self.motors[joint.name] = along
            made = made.motor_model(along, rapier.MotorModel.FORCE_BASED)
            made = made.motor(along, joint.rest, 0.0, joint.stiffness, joint.damping)
        return joints.insert(self.handles[parent], self.handles[child], made.build(), True)

    def held(self) -> list[dict[str, Any]]:
        """What a multibody damps its coordinates by; impulse joints have no such law. As it comes it is judged by its
        motion, with the law that the scene does not have."""
        out = []
        for name, handle in self.names.items() if not self.as_it_comes else ():
            numbers = {"damping": 0.0, "armature": 0.0, "stiffness": 0.0}
            motor = self.motors.get(name)
            if motor:
                if self.reduced:
                    body, link = self.world.multibody_joints.get(handle)
                    held = body.link_motor(link, motor)
                else:
                    held = self.world.impulse_joints.get(handle).data.motor(motor)
                numbers |= {"damping": float(held.damping), "stiffness": float(held.stiffness)}
            if self.reduced:
                held = self.world.multibody_joints.multibody(handle)
                for law in ("damping", "armature"):
                    values = getattr(held, law)
                    numbers[law] += float(max(values() if callable(values) else values, default=0.0))
            out.append({"name": name, **numbers})
        return out
