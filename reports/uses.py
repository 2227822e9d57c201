# SPDX-License-Identifier: BSD-3-Clause
"""What engines are used for: the acceptance cases of each use, the words of a verdict and the picture."""

from __future__ import annotations

from dataclasses import dataclass

import thumbnails


@dataclass(frozen=True)
class Use:
    name: str
    right: str  # what an engine does that holds every limit
    cases: tuple  # ids, or beginnings of ids
    pictured: tuple  # the first of these that the engine ran is drawn
    draw: object  # (trajectory, truth's trajectory or None) -> SVG or None
    shows: str  # what the picture has


RIGID = (
    Use(
        "Stack",
        "stands",
        ("contact/tower-", "contact/pyramid-", "contact/stack-"),
        ("contact/tower-1000", "contact/tower-10", "contact/tower-1"),
        thumbnails.boxes,
        "the boxes at the end; grey outlines: at the start",
    ),
    Use(
        "Slide and roll",
        "slides and rolls",
        (
            "contact/slide-to-rest",
            "contact/slope-",
            "contact/roll-down-slope",
            "contact/slip-to-roll",
            "contact/conveyor",
            "contact/moving-board",
        ),
        ("contact/slide-to-rest", "contact/slope-frictionless"),
        thumbnails.over(thumbnails.way),
        "the way of a sliding box against time; grey: the engine that ranks first",
    ),
    Use(
        "Bounce",
        "bounces",
        (
            "contact/ball-restitution-",
            "contact/box-restitution-",
            "contact/low-bounce",
            "contact/oblique-hit",
            "contact/unequal-hit",
            "contact/edge-landing",
            "contact/corner-landing",
            "contact/tumble-",
        ),
        ("contact/ball-restitution-050", "contact/ball-restitution-000"),
        thumbnails.over(thumbnails.height),
        "the height of a ball against time; grey: the engine that ranks first",
    ),
    Use(
        "Spin",
        "spins",
        ("rigid/torque-free", "rigid/precession", "rigid/flip-time", "rigid/hundred-turns", "rigid/long-spin"),
        ("rigid/torque-free", "rigid/precession"),
        thumbnails.over(thumbnails.spin),
        "the height of the long axis's tip against time; grey: exact",
    ),
)
MATTER = (
    Use(
        "Float",
        "floats",
        ("coupling/floating-block-",),
        ("coupling/floating-block-050",),
        thumbnails.dots(),
        "water and block at the end",
    ),
    Use("Pour", "pours", ("fluid/dam-break",), ("fluid/dam-break",), thumbnails.dots(), "the column at the end"),
    Use(
        "Bend",
        "bends",
        ("solid/cantilever", "solid/hanging-bar", "solid/tension"),
        ("solid/cantilever", "solid/hanging-bar"),
        thumbnails.dots(thumbnails.ENLARGED),
        "the loaded body, its displacement ten times larger",
    ),
    Use(
        "Conduct",
        "conducts",
        ("heat/",),
        ("heat/step-insulated", "heat/cosine-mode", "heat/three-waves"),
        thumbnails.profile,
        "temperature along the bar at the end; grey: exact",
    ),
    Use(
        "Melt",
        "melts",
        ("phase/stefan",),
        ("phase/stefan",),
        thumbnails.profile,
        "temperature along the bar at the end; grey: exact, or the engine that ranks first",
    ),
)


def belongs(use, case):
    """Whether a case is of this use. An entry that ends with - or / stands for all that begin with it."""
    return any(case == entry or entry[-1] in "-/" and case.startswith(entry) for entry in use.cases)
