# SPDX-License-Identifier: BSD-3-Clause
"""Quaternions (w, x, y, z) and vectors as plain tuples: an environment need not hold numpy."""

from __future__ import annotations

import math

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

IDENTITY: Quaternion = (1.0, 0.0, 0.0, 0.0)


def vector(values: object) -> Vector:
    x, y, z = (float(v) for v in values)  # type: ignore[attr-defined]
    return x, y, z


def quaternion(values: object) -> Quaternion:
    w, x, y, z = (float(v) for v in values)  # type: ignore[attr-defined]
    return w, x, y, z


def add(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def subtract(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scaled(s: float, a: Vector) -> Vector:
    return s * a[0], s * a[1], s * a[2]


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def norm(a: Vector) -> float:
    return math.sqrt(dot(a, a))


def conjugate(q: Quaternion) -> Quaternion:
    return q[0], -q[1], -q[2], -q[3]


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The rotation b, then a."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def rotate(q: Quaternion, v: Vector) -> Vector:
    return product(product(q, (0.0, *v)), conjugate(q))[1:]


def rotate_back(q: Quaternion, v: Vector) -> Vector:
    return rotate(conjugate(q), v)


def normalised(q: Quaternion) -> Quaternion:
    length = math.sqrt(sum(c * c for c in q))
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length


def between(a: Vector, b: Vector) -> Quaternion:
    """The shortest rotation that takes direction a to direction b."""
    a, b = scaled(1.0 / norm(a), a), scaled(1.0 / norm(b), b)
    cosine = dot(a, b)
    if cosine < -1.0 + 1e-12:  # opposite: half a turn about any normal
        other = (0.0, 1.0, 0.0) if abs(a[0]) > 0.9 else (1.0, 0.0, 0.0)
        axis = cross(a, other)
        return (0.0, *scaled(1.0 / norm(axis), axis))
    return normalised((1.0 + cosine, *cross(a, b)))
