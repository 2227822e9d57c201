# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a job in ODE: joints between free bodies. Its error reduction (erp 0.2, cfm 1e-10) is a setting."""

from __future__ import annotations

from typing import Any

from contract import Job
from joints import WORLD, Joint, joints_of
from rigid import Body

KINDS = ("hinge", "ball", "slider", "fixed", "distance", "universal")
LAWS = ("limits", "restitution", "friction", "effort", "speed")
WORDS = {"hinge": "Hinge", "ball": "Ball", "slider": "Slider", "fixed": "Fixed", "distance": "DBall"}
WORDS["universal"] = "Universal"
LOW, HIGH, SPEED, MOST, BOUNCE = 0, 1, 2, 5, 7  # dParamLoStop, dParamHiStop, dParamVel, dParamFMax, dParamBounce
ENDLESS = 1e30  # effort of a motor that keeps its speed [N m] or [N]


class Ties:
    """@param handles ODE's bodies by the number of the body; fixed ones are the world"""

    def __init__(self, ode: Any, world: Any, job: Job, bodies: list[Body], handles: dict[int, Any]) -> None:
        self.ode = ode
        self.efforts: list[tuple[Any, Any, float]] = []
        self.joints = [(joint, self.add(world, joint, handles)) for joint in joints_of(job, bodies)]

    def add(self, world: Any, joint: Joint, handles: dict[int, Any]) -> Any:
        ode, word = self.ode, WORDS[joint.kind]
        made = getattr(ode, f"dJointCreate{word}")(world, None)
        ode.dJointAttach(made, *(handles.get(n) if n != WORLD else None for n in joint.numbers))
        if joint.kind == "fixed":
            ode.dJointSetFixed(made)
        elif joint.kind == "slider":
            ode.dJointSetSliderAxis(made, *joint.axis)
        elif joint.kind == "distance":
            ode.dJointSetDBallAnchor1(made, *joint.place)
            ode.dJointSetDBallAnchor2(made, *joint.other_place)
        else:
            getattr(ode, f"dJointSet{word}Anchor")(made, *joint.place)
        if joint.kind == "hinge":
            ode.dJointSetHingeAxis(made, *joint.axis)
        if joint.kind == "universal":
            ode.dJointSetUniversalAxis1(made, *joint.axis)
            ode.dJointSetUniversalAxis2(made, *joint.other_axis)
        if joint.kind in ("hinge", "slider"):
            self.give_laws(made, joint, word)
        return made

    def give_laws(self, made: Any, joint: Joint, word: str) -> None:
        """Coulomb's friction is a motor of speed 0 that is not stronger than it."""
        give = getattr(self.ode, f"dJointSet{word}Param")
        if joint.limits:
            give(made, LOW, joint.limits[0])
            give(made, HIGH, joint.limits[1])
            give(made, BOUNCE, joint.restitution)
        if joint.speed is not None or joint.friction > 0.0:
            give(made, SPEED, joint.speed or 0.0)
            give(made, MOST, ENDLESS if joint.speed is not None else joint.friction)
        if joint.effort != 0.0:
            push = self.ode.dJointAddHingeTorque if joint.kind == "hinge" else self.ode.dJointAddSliderForce
            self.efforts.append((push, made, joint.effort))

    def push(self) -> None:
        """Efforts of motors, which ODE forgets after each step."""
        for push, made, effort in self.efforts:
            push(made, effort)

    def held(self) -> list[dict[str, Any]]:
        """ODE's joints have no damping, armature or spring; friction is read back as the strength of a motor."""
        out = []
        for joint, made in self.joints:
            friction = 0.0
            if joint.kind in ("hinge", "slider") and joint.speed is None:
                friction = float(getattr(self.ode, f"dJointGet{WORDS[joint.kind]}Param")(made, MOST))
            out.append({"name": joint.name, "friction": friction})
        return out
