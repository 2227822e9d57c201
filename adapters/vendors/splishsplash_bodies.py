# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies of a job as those of SPlisHSPlasH, which are PositionBasedDynamics' own: it reads the same scene file.

A body's mass and moments are those of its mesh at one density. The corners of a mesh that come within the contact
tolerance of another body's box or ball are contacts. The liquid sees the body's particles alone."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

from contract import Job
from rotation import (
    IDENTITY,
    Quaternion,
    Vector,
    add,
    conjugate,
    cross,
    dot,
    norm,
    product,
    quaternion,
    rotate,
    scaled,
    subtract,
    vector,
)

TOLERANCE = 0.01  # [m]: its contacts act at this distance, and a scene file cannot change it (CollisionDetection.cpp)
NO_CONTACT, BALL, BOX = 0, 1, 2  # collisionObjectType

Cuboid = tuple[Vector, Vector]  # lowest and highest corner [m]
Triangle = tuple[int, int, int]


class Solid(NamedTuple):
    """Shape of a free body that others can touch: a box or a ball."""

    kind: int  # BOX or BALL
    centre: Vector  # [m]
    turn: Quaternion  # from its own axes to the world's
    half: Vector  # half lengths of a box, radius of a ball [m]


class Form(NamedTuple):
    """A closed mesh about its centre, of half length or radius 1."""

    corners: list[Vector]
    faces: list[Triangle]  # counter-clockwise seen from outside
    volume: float
    square: float  # mean of x^2 over the volume


def _form(corners: list[Vector], faces: list[Triangle]) -> Form:
    volume = square = 0.0
    for face in faces:
        a, b, c = (corners[k] for k in face)
        part = dot(a, cross(b, c)) / 6.0
        volume += part
        square += part / 20.0 * ((a[0] + b[0] + c[0]) ** 2 + a[0] ** 2 + b[0] ** 2 + c[0] ** 2)
    return Form(corners, faces, volume, square / volume)


def _box() -> Form:
    corners = [vector((2 * (k & 1) - 1, 2 * (k >> 1 & 1) - 1, 2 * (k >> 2) - 1)) for k in range(8)]
    sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return _form(corners, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def _ball(finer: int = 2) -> Form:
    """An icosahedron with corners at its poles, each triangle parted into four, `finer` times."""
    corners: list[Vector] = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    for z, turn in ((1.0, 0.0), (-1.0, math.pi / 5.0)):
        angles = (turn + 2.0 * math.pi * k / 5.0 for k in range(5))
        corners += [scaled(1.0 / math.sqrt(5.0), (2.0 * math.cos(a), 2.0 * math.sin(a), z)) for a in angles]
    faces: list[Triangle] = []
    for k in range(5):
        up, next_up, low, next_low = 2 + k, 2 + (k + 1) % 5, 7 + k, 7 + (k + 1) % 5
        faces += [(0, up, next_up), (1, next_low, low), (up, low, next_up), (low, next_low, next_up)]
    for _ in range(finer):
        middle: dict[tuple[int, int], int] = {}

        def between_two(a: int, b: int, middle: dict[tuple[int, int], int] = middle) -> int:
            key = (min(a, b), max(a, b))
            if key not in middle:
                at = add(corners[a], corners[b])
                corners.append(scaled(1.0 / norm(at), at))
                middle[key] = len(corners) - 1
            return middle[key]

        parted = []
        for a, b, c in faces:
            ab, bc, ca = between_two(a, b), between_two(b, c), between_two(c, a)
            parted += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = parted
    return _form(corners, faces)


UNIT_BOX, UNIT_BALL = _box(), _ball()


def equal_half(form: Form, mass: float, inertia: Vector) -> Vector:
    """How far a form reaches along each axis [m] so that it has this mass [kg] and these principal moments [kg m2]."""
    whole = sum(inertia)
    # type: ignore[return-value]
    return tuple(math.sqrt((whole - 2.0 * moment) / (2.0 * mass * form.square)) for moment in inertia)


def solid_of(body: dict[str, Any]) -> Solid | None:
    """None for a shape that has no contact here."""
    shape = body["shape"]
    turn = quaternion(shape["rotation"]) if "rotation" in shape else IDENTITY

    def turned(at: Vector) -> Vector:
        middle = vector(shape["rotation_centre"]) if "rotation" in shape else at
        return add(middle, rotate(turn, subtract(at, middle)))

    if shape["kind"] == "box":
        low, high = vector(shape["min"]), vector(shape["max"])
        return Solid(BOX, turned(scaled(0.5, add(low, high))), turn, scaled(0.5, subtract(high, low)))
    if shape["kind"] == "sphere":
        return Solid(BALL, turned(vector(shape["centre"])), turn, (float(shape["radius"]),) * 3)
    return None


def cut(box: Cuboid, hole: Cuboid) -> list[Cuboid]:
    """What is left of a box: up to six boxes."""
    left, (low, high) = [], (list(box[0]), list(box[1]))
    if any(hole[1][k] <= low[k] or hole[0][k] >= high[k] for k in range(3)):
        return [box]
    for k in range(3):
        for a, b in ((low[k], hole[0][k]), (hole[1][k], high[k])):
            if a < b:
                left.append((vector([*low[:k], a, *low[k + 1 :]]), vector([*high[:k], b, *high[k + 1 :]])))
        low[k], high[k] = max(low[k], hole[0][k]), min(high[k], hole[1][k])
    return left


def cuboids_of(shape: dict[str, Any]) -> list[Cuboid] | None:
    """Boxes along the axes that a shape is made of; None if it is not."""
    if "rotation" in shape:
        return None
    if shape["kind"] == "box":
        return [(vector(shape["min"]), vector(shape["max"]))]
    parts = [cuboids_of(part) for part in shape["of"]] if shape["kind"] in ("union", "difference") else [None]
    if None in parts:
        return None
    if shape["kind"] == "union":
        return [box for part in parts for box in part]  # type: ignore[union-attr]
    left = parts[0]
    for hole in (box for part in parts[1:] for box in part):  # type: ignore[union-attr]
        left = [piece for box in left for piece in cut(box, hole)]  # type: ignore[union-attr]
    return left


def refuse_contact(job: Job) -> str:
    """Why no contact between the bodies can be handed over; "" if it can."""
    for body in job.bodies:
        if body["phase"] != "rigid":
            continue
        if body["motion"] == "free":
            solid = solid_of(body)
            if solid is None:
                return (
                    f"free bodies that may touch others are boxes or balls in SPlisHSPlasH, and {body['name']} is not"
                )
            if min(solid.half) <= 2.0 * TOLERANCE:
                return (
                    f"contacts of SPlisHSPlasH act {TOLERANCE:g} m off a surface, and {body['name']} is not much larger"
                )
        elif cuboids_of(body["shape"]) is None:
            return f"free bodies touch boxes along the axes in SPlisHSPlasH, and {body['name']} is not made of them"
    return ""


def touched(job: Job, boxes: list[Cuboid]) -> list[Cuboid]:
    """Boxes whose contacts act at the surfaces of these: smaller by the tolerance, but for faces that another box or a
    periodic direction continues."""
    scene, dx = job.scene, float(job.scene["spacing"])

    def goes_on(box: Cuboid, axis: int, end: int) -> float:
        """[m] by which a face lies beyond the box's own."""
        if "xyz"[axis] in scene["periodic"]:
            edge = scene["max" if end else "min"][axis]
            if abs(box[end][axis] - edge) < 1e-6 * dx:
                return 2.0 * dx + TOLERANCE
        at = [0.5 * (a + b) for a, b in zip(*box)]
        at[axis] = box[end][axis] + (1e-6 if end else -1e-6) * dx
        met = any(other is not box and all(a <= x <= b for x, a, b in zip(at, *other)) for other in boxes)
        return TOLERANCE if met else -TOLERANCE

    def moved(box: Cuboid, end: int) -> Vector:
        return vector([x + (1 if end else -1) * goes_on(box, axis, end) for axis, x in enumerate(box[end])])

    return [(moved(box, 0), moved(box, 1)) for box in boxes]


def write_mesh(path: Path, corners: list[Vector], faces: list[Triangle]) -> None:
    """An OBJ file. @param corners [m]"""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def sized(corner: Vector, by: Vector) -> Vector:
    return corner[0] * by[0], corner[1] * by[1], corner[2] * by[2]


class Mesh(NamedTuple):
    """Of a free body, about its solid's centre in the solid's axes."""

    corners: list[Vector]  # [m]; those of the solid come last, and no face has them
    faces: list[Triangle]
    density: float  # [kg/m3]


def mesh_of(body: dict[str, Any], solid: Solid) -> Mesh:
    """A mesh with the body's mass, centre and moments."""
    form = UNIT_BALL if solid.kind == BALL else UNIT_BOX
    half = equal_half(form, body["mass"], vector(body["principal_inertia"]))
    frame = product(conjugate(solid.turn), quaternion(body["principal_axes"]))
    middle = rotate(conjugate(solid.turn), subtract(vector(body["centre"]), solid.centre))

    corners = [add(middle, rotate(frame, sized(corner, half))) for corner in form.corners]
    if solid.kind != NO_CONTACT:
        corners += [sized(corner, solid.half) for corner in form.corners]
    return Mesh(corners, form.faces, body["mass"] / (form.volume * math.prod(half)))


def axis_angle(turn: Quaternion) -> tuple[Vector, float]:
    """@return unit axis and angle [rad]"""
    length = norm(turn[1:])
    if length < 1e-12:
        return (1.0, 0.0, 0.0), 0.0
    return scaled(1.0 / length, turn[1:]), 2.0 * math.atan2(length, turn[0])
