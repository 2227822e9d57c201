# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a job in DART: a skeleton for each tree of bodies."""

from __future__ import annotations

from typing import Any

from contract import Job
from joints import WORLD, Joint, Link, joints_of, pose_in, spin_of, start_rate, tree_of
from rigid import Body
from rotation import IDENTITY, dot, scaled, subtract

KINDS = ("hinge", "ball", "slider", "fixed", "universal")
LAWS = ("limits", "friction", "damping", "spring", "effort")
LOOPS = ""  # its constraints leave Bricard's mechanism at rest, and a slider-crank ends at no number
WORDS = {"hinge": "Revolute", "ball": "Ball", "slider": "Prismatic", "fixed": "Weld", "universal": "Universal"}


class Ties:
    """@param transform makes DART's isometry of a place and an orientation"""

    def __init__(self, job: Job, bodies: list[Body], transform: Any) -> None:
        import numpy as np

        self.np, self.bodies, self.transform = np, bodies, transform
        self.links, _ = tree_of(bodies, joints_of(job, bodies))
        self.joints: list[tuple[Joint, Any]] = []
        self.tree = {link.parent for link in self.links if link.joint} | {
            link.number for link in self.links if link.joint
        }

    def add(self, skeleton: Any, link: Link, nodes: dict[int, Any]) -> Any:
        """A body under its parent. @return its node"""
        joint = link.joint
        assert joint
        make = getattr(skeleton, f"create{WORDS[joint.kind]}JointAndBodyNodePair")
        held, node = make() if link.parent == WORLD else make(nodes[link.parent])
        held.setTransformFromParentBodyNode(self.transform(*pose_in(self.bodies, link.parent, joint.place, IDENTITY)))
        held.setTransformFromChildBodyNode(self.transform(*pose_in(self.bodies, link.number, joint.place, IDENTITY)))
        turn = subtract(self.bodies[link.number].spin, spin_of(self.bodies, link.parent))
        if joint.kind == "ball":
            held.setVelocities(self.np.array(turn))
        elif joint.kind == "universal":  # the first axis is fixed in the parent
            axes = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
            held.setAxis1(self.np.array(axes[0]))
            held.setAxis2(self.np.array(axes[1]))
            held.setVelocities(self.np.array([dot(turn, axis) for axis in axes]))
        elif joint.kind != "fixed":
            held.setAxis(self.np.array(scaled(link.sign, joint.axis)))
            held.setVelocity(0, start_rate(joint, self.bodies))
            self.give_laws(held, joint)
        self.joints.append((joint, held))
        return node

    @staticmethod
    def give_laws(held: Any, joint: Joint) -> None:
        held.setDampingCoefficient(0, joint.damping)
        held.setSpringStiffness(0, joint.stiffness)
        held.setRestPosition(0, joint.rest)
        held.setCoulombFriction(0, joint.friction)
        if joint.limits:
            held.setPositionLowerLimit(0, joint.limits[0])
            held.setPositionUpperLimit(0, joint.limits[1])
            held.setLimitEnforcement(True)

    def push(self) -> None:
        """Efforts of motors, which DART forgets after each step."""
        for joint, held in self.joints:
            if joint.effort != 0.0:
                held.setForce(0, joint.effort)

    def held(self) -> list[dict[str, Any]]:
        """Laws of the joints, as DART holds them: the greatest of the axes of each."""
        out = []
        for joint, held in self.joints:
            axes = range(held.getNumDofs())
            numbers = {
                "damping": [held.getDampingCoefficient(k) for k in axes],
                "friction": [held.getCoulombFriction(k) for k in axes],
                "stiffness": [held.getSpringStiffness(k) for k in axes],
            }
            out.append({"name": joint.name, **{law: float(max(of, default=0.0)) for law, of in numbers.items()}})
        return out
