# SPDX-License-Identifier: BSD-3-Clause
"""Rigid boxes and balls in space, by the shapes of the job and the poses of the trajectory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


@dataclass
class Shape:
    """One body of the job: a box by its corners, or a ball by its radius, about the centre of mass at the start."""

    row: int
    name: str
    fixed: bool
    corners: np.ndarray | None = None  # (8, 3), from the centre
    offset: np.ndarray | None = None  # of a ball's middle, from the centre
    radius: float = 0.0

    def points(self, position, orientation):
        """Corners in the world, or the middle of the ball."""
        own = self.corners if self.corners is not None else self.offset[None, :]
        return position + turned(orientation, own)


def turned(quaternion, points):
    """Points (n, 3) turned by (w, x, y, z)."""
    w, axis = quaternion[0], np.asarray(quaternion[1:])
    twice = 2 * np.cross(axis, points)
    return points + w * twice + np.cross(axis, twice)


def numbers(values):
    return np.array([float(value) for value in values])


def shape_of(body, row):
    """@return a Shape; None where the body is no box and no ball, or stands turned at the start. @raises KeyError,
    TypeError, ValueError
    """
    form, centre = body["shape"], numbers(body["centre"])
    if body["phase"] != "rigid" or list(body.get("rotation") or (1, 0, 0, 0)) != [1, 0, 0, 0]:
        return None
    fixed = body.get("motion") == "fixed"
    if form["kind"] == "box":
        low, high = numbers(form["min"]), numbers(form["max"])
        return Shape(row, str(body["name"]), fixed, low + CORNERS * (high - low) - centre)
    if form["kind"] == "sphere":
        return Shape(row, str(body["name"]), fixed, None, numbers(form["centre"]) - centre, float(form["radius"]))
    return None


def shapes_of(scene):
    """The shapes of every body of a job's scene; empty where one of them has none."""
    try:
        found = [shape_of(body, row) for row, body in enumerate(scene["bodies"])]
    except (KeyError, TypeError, ValueError):
        return []
    return (
        [] if None in found or any(not np.isfinite(s.points(np.zeros(3), (1, 0, 0, 0))).all() for s in found) else found
    )
