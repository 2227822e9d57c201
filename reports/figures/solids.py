# SPDX-License-Identifier: BSD-3-Clause
"""Rigid boxes and balls as what they are, by their shapes and the poses of a frame: no lump of particles."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.patches import Circle, Polygon, Rectangle

from shapes import FACES

from . import style

LIGHT = 0.72  # of a face that is seen edge on; a face that is seen from the front has all of its colour


def usable(trajectory):
    """Whether all bodies of the scene are boxes and balls, and the run says where they are."""
    return bool(trajectory.shapes) and {"position", "orientation"} <= trajectory.bodies.keys()


def draw(sheet, place, trajectory, frame, view, pale):
    """Draws the bodies of one time, what is fixed first and the far before the near."""
    row = int(np.argmin(np.abs(trajectory.body_times - frame.time)))
    corner, (wide, tall) = sheet.origin(place), sheet.size
    clip = Rectangle(corner, wide, tall, transform=sheet.inches, facecolor="none", edgecolor=style.GRID, linewidth=0.8)
    sheet.figure.add_artist(clip)
    found = [part for shape in trajectory.shapes for part in parts(shape, pose(trajectory, shape, row), view)]
    for fixed, _, outline, shade, body in sorted(found, key=lambda part: (not part[0], -part[1])):
        artist = patch(outline, sheet, place)
        hue = np.array(matplotlib.colors.to_rgb(style.GREY if fixed else style.BODIES[body % len(style.BODIES)]))
        artist.set(
            transform=sheet.inches, facecolor=hue * shade, edgecolor=hue * 0.5, linewidth=0.5, alpha=pale, zorder=1.5
        )
        sheet.figure.add_artist(artist)
        artist.set_clip_path(clip)


def pose(trajectory, shape, row):
    return trajectory.bodies["position"][row, shape.row], trajectory.bodies["orientation"][row, shape.row]


def parts(shape, pose_of_body, view):
    """(fixed, depth, outline, shade, body): the faces of a box that look at the viewer, or a ball. A body that is not
    alive has none.
    """
    if not all(np.isfinite(part).all() for part in pose_of_body):
        return []
    points = view(shape.points(*pose_of_body))
    if shape.corners is None:
        return [(shape.fixed, points[0, 2], (points[0, :2], shape.radius), 0.9, shape.row)]
    middle = points.mean(axis=0)
    return [face(shape, points[list(corners)], middle) for corners in FACES if is_front(points[list(corners)], middle)]


def outward(corners, middle):
    """The unit normal of a face, away from the middle of its box, in the picture's axes."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
    length = np.linalg.norm(normal)
    return normal * np.sign(normal @ (corners.mean(axis=0) - middle)) / length if length > 0 else normal


def is_front(corners, middle):
    return outward(corners, middle)[2] < -1e-9  # depth grows away from the viewer


def face(shape, corners, middle):
    return (
        shape.fixed,
        corners[:, 2].mean(),
        corners[:, :2],
        LIGHT - (1 - LIGHT) * outward(corners, middle)[2],
        shape.row,
    )


def patch(outline, sheet, place):
    """A polygon, or a circle of (middle, radius), in inches."""
    at = sheet.origin(place)
    if isinstance(outline, tuple):
        return Circle(at + (outline[0] - sheet.low) * sheet.scale, outline[1] * sheet.scale)
    return Polygon(at + (outline - sheet.low) * sheet.scale, closed=True)
