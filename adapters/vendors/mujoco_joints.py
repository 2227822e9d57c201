# SPDX-License-Identifier: BSD-3-Clause
"""Joints and springs of a job in MJCF: the free bodies as trees, loops by equality constraints.

MuJoCo's constraints are springs with a time constant of 0.02 s as they come (solref), whatever the step: loops, limits
and friction get one of two time steps here, or the setting `joint_solref`."""

from __future__ import annotations

from typing import Any

from contract import Job
from joints import WORLD, Joint, Link, Side, joints_of, spin_of, springs_of, start_rate, tree_of
from rigid import Body
from rotation import Quaternion, Vector, add, dot, product, rotate, rotate_back, scaled, subtract

KINDS = ("hinge", "ball", "slider", "fixed", "distance", "universal")
LAWS = ("limits", "friction", "damping", "spring", "effort")
LOOPS = "hinge ball fixed distance"


def words(values: tuple[float, ...]) -> str:
    """Numbers of an MJCF attribute, without loss."""
    return " ".join(map(repr, values))


class Ties:
    """What holds the bodies of a job to each other. @param dt of the time constants [s]"""

    def __init__(self, job: Job, bodies: list[Body], dt: float) -> None:
        self.bodies = bodies
        self.joints = joints_of(job, bodies)
        self.links, self.loops = tree_of(bodies, self.joints)
        self.springs = springs_of(job, bodies)
        self.solref = str(job.settings.get("joint_solref", f"{2.0 * dt!r} 1"))
        self.solimp = str(job.settings.get("joint_solimp", "0.9 0.95 0.001 0.5 2"))

    def children(self, number: int) -> list[Link]:
        return [link for link in self.links if link.parent == number and (number != WORLD or link.joint)]

    def root(self, number: int) -> Link:
        """The link of a free body."""
        return next(link for link in self.links if link.number == number)

    def is_tied(self, number: int) -> bool:
        return any(number in joint.numbers for joint in self.joints)

    def joint_text(self, link: Link) -> str:
        """The MJCF joints of a body, in the body's own frame; empty for a fixed one."""
        joint = link.joint
        if joint is None:
            return "<freejoint/>"
        side = joint.one if link.sign > 0.0 else joint.other
        at = f'pos="{words(side.point)}"'
        if joint.kind == "ball":
            return f'<joint name="{joint.name}" type="ball" {at}/>'
        if joint.kind == "fixed":
            return ""
        if joint.kind == "universal":  # the first of two is fixed in the parent
            axes = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
            return "".join(
                f'<joint name="{joint.name}{k}" type="hinge" axis="{words(side.direction(axis))}" {at}/>'
                for k, axis in enumerate(axes)
            )
        axis = words(side.direction(scaled(link.sign, joint.axis)))
        kind = "hinge" if joint.kind == "hinge" else "slide"
        return f'<joint name="{joint.name}" type="{kind}" axis="{axis}" {at} {self.laws_text(joint)}/>'

    def laws_text(self, joint: Joint) -> str:
        text = f'damping="{joint.damping!r}" stiffness="{joint.stiffness!r}" springref="{joint.rest!r}"'
        if joint.limits:
            text += f' limited="true" range="{words(joint.limits)}" solreflimit="{self.solref}"'
        if joint.friction > 0.0:
            text += f' frictionloss="{joint.friction!r}" solreffriction="{self.solref}"'
        return text

    def sites_of(self, number: int) -> str:
        """Ends of tendons on a body, or in the world."""
        ends: list[tuple[str, Side]] = []
        for k, (one, other, *_) in enumerate(self.springs):
            ends += [(f"spring{k}a", one), (f"spring{k}b", other)]
        for joint in self.loops:
            if joint.kind == "distance":
                ends += [(f"{joint.name}a", joint.one), (f"{joint.name}b", joint.other)]
        text = []
        for name, side in ends:
            fixed = side.number != WORLD and not self.bodies[side.number].free
            if side.number == number and not fixed:
                text.append(f'<site name="{name}" pos="{words(side.point)}"/>')
            elif fixed and number == WORLD:
                body = self.bodies[side.number]
                text.append(f'<site name="{name}" pos="{words(add(body.centre, rotate(body.frame, side.point)))}"/>')
        return "".join(text)

    def name_of(self, side: Side) -> str:
        return "world" if side.number == WORLD else f"b{side.number}"

    def closing_text(self) -> str:
        """Tendons, equality constraints, and pairs that do not touch."""
        tendons = [
            f'<spatial name="spring{k}" stiffness="{stiffness!r}" damping="{damping!r}" springlength="{length!r}">'
            f'<site site="spring{k}a"/><site site="spring{k}b"/></spatial>'
            for k, (_, _, stiffness, damping, length) in enumerate(self.springs)
        ]
        tendons += [
            f'<spatial name="{joint.name}"><site site="{joint.name}a"/><site site="{joint.name}b"/></spatial>'
            for joint in self.loops
            if joint.kind == "distance"
        ]
        closing = "".join(self.equality(joint) for joint in self.loops)
        apart = "".join(
            f'<exclude body1="{self.name_of(joint.one)}" body2="{self.name_of(joint.other)}"/>'
            for joint in self.joints
            if WORLD not in joint.numbers
        )
        text = f"<tendon>{''.join(tendons)}</tendon>" if tendons else ""
        text += f"<equality>{closing}</equality>" if closing else ""
        return text + (f"<contact>{apart}</contact>" if apart else "")

    def equality(self, joint: Joint) -> str:
        """A hinge is held at two points of its axis, 1 m apart."""
        soft = f'solref="{self.solref}" solimp="{self.solimp}"'
        if joint.kind == "distance":
            return f'<tendon tendon1="{joint.name}" {soft}/>'
        one, other = (joint.one, joint.other) if joint.one.number != WORLD else (joint.other, joint.one)
        pair = f'body1="{self.name_of(one)}" body2="{self.name_of(other)}" {soft}'
        if joint.kind == "fixed":
            return f"<weld {pair}/>"
        points = [one.point]
        if joint.kind == "hinge":
            points = [add(one.point, scaled(way, one.direction(joint.axis))) for way in (-0.5, 0.5)]
        return "".join(f'<connect anchor="{words(point)}" {pair}/>' for point in points)

    def start(self, model: Any, data: Any) -> None:
        """Rates of all joints at the start, and efforts of motors."""
        for link in self.links:
            body, joint = self.bodies[link.number], link.joint
            address = int(model.body_dofadr[model.body(f"b{link.number}").id])
            if joint is None:  # MuJoCo's qvel holds a free joint's spin in the body frame
                data.qvel[address : address + 6] = [*body.velocity, *rotate_back(body.frame, body.spin)]
            elif joint.kind == "ball":
                turn = subtract(body.spin, spin_of(self.bodies, link.parent))
                data.qvel[address : address + 3] = rotate_back(body.frame, turn)
            elif joint.kind == "universal":
                turn = subtract(body.spin, spin_of(self.bodies, link.parent))
                axes = (joint.other_axis, joint.axis) if link.sign > 0.0 else (joint.axis, joint.other_axis)
                data.qvel[address : address + 2] = [dot(turn, axis) for axis in axes]
            elif joint.kind != "fixed":
                data.qvel[address] = start_rate(joint, self.bodies)
                data.qfrc_applied[address] = joint.effort

    def held(self, model: Any) -> list[dict[str, Any]]:
        """Laws of the joints of the tree, as MuJoCo holds them; a closing constraint has none."""
        out = []
        for link in self.links:
            if link.joint is None or link.joint.kind in ("fixed",):
                continue
            body = model.body(f"b{link.number}").id
            first, count = int(model.body_dofadr[body]), int(model.body_dofnum[body])
            dofs = range(first, first + count)
            stiffness = float(model.jnt_stiffness[int(model.body_jntadr[body])].max())
            out.append(
                {
                    "name": link.joint.name,
                    "damping": max(float(model.dof_damping[k].max()) for k in dofs),
                    "friction": max(float(model.dof_frictionloss[k]) for k in dofs),
                    "stiffness": stiffness,
                    "armature": max(float(model.dof_armature[k]) for k in dofs),
                }
            )
        return out


def pose_under(bodies: list[Body], link: Link) -> tuple[Vector, Quaternion]:
    """Of a body in the frame of its parent, at the start."""
    body = bodies[link.number]
    if link.parent == WORLD:
        return body.centre, body.frame
    parent = bodies[link.parent]
    w, x, y, z = parent.frame
    return rotate_back(parent.frame, subtract(body.centre, parent.centre)), product((w, -x, -y, -z), body.frame)
