# SPDX-License-Identifier: BSD-3-Clause
"""Joints of an imported model (imported_model.py) as those of a case file, and a list of those that it cannot say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

KINDS = {"hinge": "hinge", "slide": "slider", "ball": "ball"}


def numbers(values: Any) -> str:
    return f"[{', '.join(repr(0.0 if abs(v) < 1e-15 else float(v)) for v in values)}]"


SAME_PLACE, ACROSS = 1e-9, 1e-9  # [m], cosine of two axes


@dataclass
class Joint:
    """`kind` as a case file has it; the first body moves against the second."""

    name: str
    kind: str
    bodies: tuple[str, str]
    place: np.ndarray  # [m]
    axis: np.ndarray | None = None
    other_axis: np.ndarray | None = None  # of a universal: that of the second body
    limits: tuple[float, float] | None = None  # [rad or m], 0 at the start
    friction: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0

    def text(self) -> str:
        lines = [f'[[joint]]\nname = "{self.name}"\nkind = "{self.kind}"']
        lines += [f'bodies = ["{self.bodies[0]}", "{self.bodies[1]}"]', f"place = {numbers(self.place)}"]
        lines += [
            f"{key} = {numbers(values)}"
            for key in ("axis", "other_axis", "limits")
            if (values := getattr(self, key)) is not None
        ]
        lines += [f"{key} = {float(getattr(self, key))!r}" for key in ("friction", "damping") if getattr(self, key)]
        if self.stiffness:
            lines.append(f"spring = {{ stiffness = {float(self.stiffness)!r}, rest = {float(self.rest)!r} }}")
        return "\n".join([*lines, ""])


def kind_of(model: Any, joint: int) -> str:
    return mujoco.mjtJoint(model.jnt_type[joint]).name.removeprefix("mjJNT_").lower()


def dofs_of(model: Any, joint: int) -> range:
    first = int(model.jnt_dofadr[joint])
    return range(first, first + {"free": 6, "ball": 3}.get(kind_of(model, joint), 1))


def has_forces(model: Any, joint: int) -> bool:
    forces = any(model.dof_damping[d] or model.dof_frictionloss[d] for d in dofs_of(model, joint))
    return bool(forces or model.jnt_limited[joint] or model.jnt_stiffness[joint])


def single(model: Any, data: Any, joint: int, name: str, bodies: tuple[str, str], lost: list[str]) -> Joint:
    """One joint between a body and its parent. @param lost what of it a case file does not say"""
    made = Joint(name, KINDS[kind_of(model, joint)], bodies, np.array(data.xanchor[joint]))
    if made.kind == "ball":
        lost += ["limits, springs, friction and damping of a ball"] if has_forces(model, joint) else []
        return made
    dof, now = int(model.jnt_dofadr[joint]), float(data.qpos[model.jnt_qposadr[joint]])
    made.axis = np.array(data.xaxis[joint])
    made.friction, made.damping = float(model.dof_frictionloss[dof]), float(model.dof_damping[dof])
    made.stiffness = float(model.jnt_stiffness[joint])
    made.rest = float(model.qpos_spring[model.jnt_qposadr[joint]]) - now
    if model.jnt_limited[joint]:
        low, high = (float(x) - now for x in model.jnt_range[joint])
        if low <= 0.0 <= high and low < high:
            made.limits = (low, high)
        else:
            lost.append("limits: it starts beyond them")
    return made


def several(model: Any, data: Any, joints: list[int], name: str, bodies: tuple[str, str]) -> Joint | None:
    """Hinges at one place without forces: two at right angles are a universal, three a ball."""
    hinges = all(kind_of(model, j) == "hinge" and not has_forces(model, j) for j in joints)
    places = np.array([data.xanchor[j] for j in joints])
    axes = np.array([data.xaxis[j] for j in joints])
    if not hinges or np.ptp(places, axis=0).max() > SAME_PLACE:
        return None
    if len(joints) == 2 and abs(float(axes[0] @ axes[1])) < ACROSS:
        return Joint(name, "universal", bodies, places[0], axes[1], axes[0])
    if len(joints) == 3 and abs(float(np.linalg.det(axes))) > ACROSS:
        return Joint(name, "ball", bodies, places[0])
    return None


class Joints:
    """@param link_of  of each body of the model the name of the case's, "world", or None where it has no shape"""

    def __init__(self, model: Any, data: Any, link_of: list[str | None], name_of: Any) -> None:
        self.model, self.data, self.link_of, self.name_of = model, data, link_of, name_of
        self.made: list[Joint] = []
        self.left_out: list[str] = []
        for body in range(1, model.nbody):
            first = int(model.body_jntadr[body])
            joints = list(range(first, first + int(model.body_jntnum[body])))
            if joints and kind_of(model, joints[0]) != "free":
                self.add(body, joints)
            elif joints:
                self.tell_free(body, joints[0])

    def tell_free(self, body: int, joint: int) -> None:
        self.tell(
            f"the free joint of body {self.name_of(self.model, 'body', body)}", joint, ["damping", "frictionloss"]
        )

    def tell(self, what: str, joint: int, kinds: list[str]) -> None:
        found = [
            k
            for k in [*kinds, "armature"]
            if any(getattr(self.model, f"dof_{k}")[d] for d in dofs_of(self.model, joint))
        ]
        self.left_out += [f"{' and '.join(found)} of {what}"] if found else []

    def add(self, body: int, joints: list[int]) -> None:
        ends = (self.link_of[body], self.link_of[int(self.model.body_parentid[body])])
        names = [self.name_of(self.model, "joint", j) for j in joints]
        words = f"joint {' and '.join(names)}: {' and '.join(kind_of(self.model, j) for j in joints)}"
        if ends[0] is None or ends[1] is None:
            self.left_out.append(f"{words}, of a body without a shape")
            return
        name = self.unused(names[0])
        lost: list[str] = []
        if len(joints) == 1:
            self.made.append(single(self.model, self.data, joints[0], name, (ends[0], ends[1]), lost))
        elif (one := several(self.model, self.data, joints, name, (ends[0], ends[1]))) is not None:
            self.made.append(one)
        else:
            self.left_out.append(f"{words} between {ends[0]} and {ends[1]}: several of one pair of bodies")
            return
        self.left_out += [f"{line} ({words})" for line in lost]
        for joint, of in zip(joints, names):
            self.tell(f"joint {of}", joint, [])

    def unused(self, name: str) -> str:
        names = {joint.name for joint in self.made}
        return next(n for n in (name, *(f"{name} {k}" for k in range(2, len(names) + 3))) if n not in names)
