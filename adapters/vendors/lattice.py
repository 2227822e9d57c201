# SPDX-License-Identifier: BSD-3-Clause
"""Boxes of a scene as a mesh of cubes of one spacing, for solvers of fields that want nodes and elements; only the
standard library."""

from __future__ import annotations

import ast
import math
from dataclasses import dataclass, field
from typing import Any

from contract import Job
from rotation import Vector, vector

Place = tuple[int, int, int]  # of a node, in halves of a spacing from the mesh's corner

# Corners of an element in the order of C3D8, and middles of its edges in the order of C3D20, in halves of a spacing.
CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
EDGES = (
    (1, 0, 0),
    (2, 1, 0),
    (1, 2, 0),
    (0, 1, 0),
    (1, 0, 2),
    (2, 1, 2),
    (1, 2, 2),
    (0, 1, 2),
    (0, 0, 1),
    (2, 0, 1),
    (2, 2, 1),
    (0, 2, 1),
)


@dataclass
class Mesh:
    corner: Vector  # [m]
    spacing: float  # [m]
    quadratic: bool
    node: dict[Place, int] = field(default_factory=dict)  # place -> number from 1
    elements: list[tuple[int, ...]] = field(default_factory=list)  # nodes of each
    body: list[int] = field(default_factory=list)  # of each element, as the job counts them
    first: list[Place] = field(default_factory=list)  # lowest corner of each element

    def place(self, at: Place) -> Vector:
        return tuple(c + 0.5 * self.spacing * k for c, k in zip(self.corner, at))  # type: ignore[return-value]

    def add(self, at: Place, body: int) -> None:
        offsets = CORNERS + EDGES if self.quadratic else CORNERS
        nodes = [(at[0] + dx, at[1] + dy, at[2] + dz) for dx, dy, dz in offsets]
        self.elements.append(tuple(self.node.setdefault(n, len(self.node) + 1) for n in nodes))
        self.body.append(body)
        self.first.append(at)

    def middle(self, element: int) -> Vector:
        # type: ignore[return-value]
        return tuple(c + self.spacing * (0.5 * k + 0.5) for c, k in zip(self.corner, self.first[element]))

    def weights(self, point: Vector, wanted: set[int]) -> dict[int, float]:
        """Trilinear weights of the corner nodes at a point [m]; empty where no element of the wanted bodies holds
        it."""
        rest = [(x - c) / self.spacing for x, c in zip(point, self.corner)]
        for nodes, body, first in zip(self.elements, self.body, self.first):
            local = [r - 0.5 * k for r, k in zip(rest, first)]
            if body in wanted and all(-1e-9 <= s <= 1.0 + 1e-9 for s in local):
                share = {}
                for n, offset in zip(nodes, CORNERS):
                    w = math.prod(s if o else 1.0 - s for s, o in zip(local, offset))
                    if abs(w) > 1e-12:
                        share[n] = w
                return share
        return {}

    def mean(self, weight: list[float], inside: list[bool]) -> dict[int, float]:
        """Weights of the corner nodes for the mean over elements, each with its own weight."""
        share: dict[int, float] = {}
        total = sum(w for w, take in zip(weight, inside) if take)
        for nodes, w, take in zip(self.elements, weight, inside):
            for n in nodes[:8] if take else ():
                share[n] = share.get(n, 0.0) + 0.125 * w / total
        return share


def whole(value: float) -> bool:
    return abs(value - round(value)) < 1e-6


def refuse_boxes(job: Job, engine: str) -> str:
    """Why the bodies are no mesh of cubes; "" if they are."""
    dx = float(job.scene["spacing"])
    corner = job.bodies[0]["shape"].get("min")
    for body in job.bodies:
        shape = body["shape"]
        if shape["kind"] != "box" or "rotation" in shape:
            return (
                f"{engine} is handed boxes along the axes, and {body['name']} is a "
                f"{shape['kind']}{' that is turned' if 'rotation' in shape else ''}"
            )
        if not all(
            whole((end - begin) / dx) and whole((begin - c) / dx)
            for begin, end, c in zip(shape["min"], shape["max"], corner)
        ):
            return f"{engine}'s elements are cubes of one spacing, and {body['name']} is not made of whole ones"
    return ""


def materials_of(job: Job) -> list[dict]:
    """Of each body."""
    named = {m["name"]: m for m in job.scene["materials"]}
    return [named[body["material"]] for body in job.bodies]


def refuse_body(body: dict, material: dict, engine: str) -> str:
    """Why a body is not linearly elastic, or held, without heat; "" if it is."""
    name = body["name"]
    if body["phase"] == "liquid" or body["temperature"] is not None:
        return f"{engine} is handed elastic bodies without heat or liquid, and {name} is not that"
    if body["motion"] == "prescribed":
        return f"prescribed motion is not handed to {engine}, and {name} has one"
    if any(body["angular_velocity"]):
        return f"small strains know no turning body, and {name} turns"
    limits = ("elastic_limit", "fracture_stretch", "fracture_distance", "t_melt")
    if body["phase"] == "elastic" and any(material[key] is not None for key in limits):
        return f"linear elasticity has no plastic flow, fracture or melting, and {name} may do so"
    return ""


def refuse_work(job: Job, step: float, most: float, quadratic: str, linear: str) -> str:
    """Why a run of quadratic elements takes more than `most` elements times steps of `step` [s]; "" if it does not."""
    every = zip(job.bodies, materials_of(job))
    elements = sum(body["mass"] / (material["density"] * job.scene["spacing"] ** 3) for body, material in every)
    steps = (job.times[-1] - job.times[0]) / step
    if elements * steps <= most:
        return ""
    return (
        f"{round(elements)} elements for {math.ceil(steps)} steps are more than {quadratic} finishes within a run's "
        "time; "
        f"a longer time_step makes them fewer, and {linear} needs a tenth"
    )


def mesh_of(job: Job, wanted: set[int], quadratic: bool) -> Mesh:
    """@param wanted numbers of the bodies that get elements. The boxes have been looked at by `refuse_boxes`."""
    dx = float(job.scene["spacing"])
    corner = tuple(min(body["shape"]["min"][k] for body in job.bodies) for k in range(3))
    mesh = Mesh(corner, dx, quadratic)  # type: ignore[arg-type]
    for number in sorted(wanted):
        shape = job.bodies[number]["shape"]
        low = [round(2.0 * (a - c) / dx) for a, c in zip(shape["min"], corner)]
        high = [round(2.0 * (a - c) / dx) for a, c in zip(shape["max"], corner)]
        for z in range(low[2], high[2], 2):
            for y in range(low[1], high[1], 2):
                for x in range(low[0], high[0], 2):
                    mesh.add((x, y, z), number)
    return mesh


def nodes_in_box(mesh: Mesh, shape: dict[str, Any]) -> list[int]:
    """Numbers of the nodes in or on a box."""
    slack = 1e-6 * mesh.spacing
    low, high = vector(shape["min"]), vector(shape["max"])
    inside = (
        n
        for at, n in mesh.node.items()
        if all(a - slack <= x <= b + slack for x, a, b in zip(mesh.place(at), low, high))
    )
    return sorted(inside)


_FUNCTIONS = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "exp": math.exp,
    "log": math.log,
    "sqrt": math.sqrt,
    "abs": abs,
    "min": min,
    "max": max,
}
_OPERATORS = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
}


def formula(text: str, at: Vector) -> float:
    """A case's expression of x, y and z [m] at a place. @raise ValueError for what is no arithmetic of them"""
    names = {"x": at[0], "y": at[1], "z": at[2], "pi": math.pi}

    def value(node: ast.expr) -> float:
        if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
            return float(node.value)
        if isinstance(node, ast.Name) and node.id in names:
            return names[node.id]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
            return -value(node.operand) if isinstance(node.op, ast.USub) else value(node.operand)
        if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
            return _OPERATORS[type(node.op)](value(node.left), value(node.right))
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in _FUNCTIONS
            and not node.keywords
        ):
            return _FUNCTIONS[node.func.id](*map(value, node.args))
        raise ValueError(f"{text}: is no arithmetic of x, y and z")

    return value(ast.parse(text.replace("^", "**"), mode="eval").body)


def temperature_at(start: dict[str, Any], at: Vector) -> float:
    """[K], of a body's temperature as the job states it."""
    if start["kind"] == "constant":
        return float(start["value"])
    if start["kind"] == "cosine":
        return float(start["mean"]) + float(start["amplitude"]) * math.cos(
            sum(k * x for k, x in zip(start["wave_vector"], at)) + float(start["phase"])
        )
    if start["kind"] == "step":
        side = sum(n * (x - p) for n, x, p in zip(start["normal"], at, start["point"]))
        return float(start["behind"] if side < 0.0 else start["ahead"])
    return formula(start["value"], at)


def velocity_at(start: dict[str, Any], at: Vector) -> Vector:
    """[m/s], of a body's velocity field. @raise ValueError for a kind that has no words here"""
    if start["kind"] == "constant":
        return vector(start["value"])
    if start["kind"] == "expression":
        return vector([formula(text, at) for text in start["value"]])
    raise ValueError(f"a velocity of the kind {start['kind']} is not handed over")


def across(job: Job) -> tuple[str, tuple[int, ...]]:
    """Periodic directions along which nothing changes, so that flat sides without flow or motion stand for them.

    @return why a periodic direction is not like that, or ""; and the directions"""
    scene, found = job.scene, []
    for axis, name in enumerate("xyz"):
        if name not in scene["periodic"]:
            continue
        for body in job.bodies:
            shape, start = body["shape"], body["temperature"]
            low, high = scene["min"][axis], scene["max"][axis]
            if abs(shape["min"][axis] - low) + abs(shape["max"][axis] - high) > 1e-6 * (high - low):
                return f"{body['name']} does not fill the periodic direction {name}", ()
            if start is not None and (
                start["kind"] == "expression" or start.get("wave_vector", start.get("normal", (0.0,) * 3))[axis] != 0.0
            ):
                return f"the temperature of {body['name']} may change along the periodic direction {name}", ()
        if scene["gravity"][axis] != 0.0 and any(body["phase"] == "elastic" for body in job.bodies):
            return f"gravity acts along the periodic direction {name}", ()
        found.append(axis)
    return "", tuple(found)
