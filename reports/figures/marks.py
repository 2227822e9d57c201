# SPDX-License-Identifier: BSD-3-Clause
"""The pieces of a panel as SVG: words, lines and markers."""

import functools
import html
import math

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

SHAPES = {
    "s": ((-1, -1), (1, -1), (1, 1), (-1, 1)),
    "D": ((0, -math.sqrt(2)), (math.sqrt(2), 0), (0, math.sqrt(2)), (-math.sqrt(2), 0)),
    "^": ((0, -1), (-1, 1), (1, 1)),
    "v": ((0, 1), (1, -1), (-1, -1)),
    "P": tuple(
        (x / 3, y / 3)
        for x, y in (
            (-1, -3),
            (1, -3),
            (1, -1),
            (3, -1),
            (3, 1),
            (1, 1),
            (1, 3),
            (-1, 3),
            (-1, 1),
            (-3, 1),
            (-3, -1),
            (-1, -1),
        )
    ),
}  # about a centre, y down, in halves of the marker's size


@functools.lru_cache(10000)
def extent(words, size):
    """(width, height, descent) [points]"""
    return (
        TextToPath().get_text_width_height_descent(words, FontProperties(size=size), False)
        if words
        else (0.0, 0.0, 0.0)
    )


def number(value):
    return f"{value:.2f}".rstrip("0").rstrip(".")


def write(words, x, y, size, hue, anchor="start", turned=False):
    turn = f' transform="rotate(-90 {number(x)} {number(y)})"' if turned else ""
    return (
        f'<text x="{number(x)}" y="{number(y)}"{turn} style="fill: {hue}; font-size: {size:g}px; text-anchor: '
        f'{anchor}">{html.escape(words, quote=False)}</text>\n'
    )


def stroke(hue, width, alpha=None, dashes=None, more=""):
    dashes = "; stroke-dasharray: " + ",".join(number(part * width) for part in dashes) if dashes else ""
    return (
        f'style="fill: none; stroke: {hue}; stroke-width: '
        f'{width:g}{dashes}{f"; stroke-opacity: {alpha:g}" if alpha not in (None, 1.0) else ""}{more}"'
    )


def through(points):
    """The path of a line: it is broken where a point is not finite, and a point in the same place as the one before is
    left out."""
    parts, pen, last = [], "M", None
    for x, y in np.clip(points, -2e4, 2e4).tolist():
        if x != x or y != y:
            pen, last = "M", None
            continue
        place = f"{x:.2f} {y:.2f}"
        if place != last:
            parts.append(pen + place)
        pen, last = "L", place
    return "".join(parts)


def markers(points, shape, size, hue, face, edge=1.0, alpha=None):
    points, half = points[np.isfinite(points).all(axis=1)], 0.5 * size
    if shape == "o":
        path = "".join(
            f"M{x - half:.2f} {y:.2f}a{half:g} {half:g} 0 1 0 {size:g} 0a{half:g} {half:g} 0 1 0 {-size:g} 0z"
            for x, y in points.tolist()
        )
    elif shape == "x":
        path = "".join(
            f"M{x - half:.2f} {y - half:.2f}l{size:g} {size:g}M{x - half:.2f} {y + half:.2f}l{size:g} {-size:g}"
            for x, y in points.tolist()
        )
    else:
        path = "".join(
            "M" + "L".join(f"{x + half * a:.2f} {y + half * b:.2f}" for a, b in SHAPES[shape]) + "z"
            for x, y in points.tolist()
        )
    fill = "none" if shape == "x" or face == "none" else face or hue
    more = "" if shape == "o" else "; stroke-linejoin: miter"
    more += f"; opacity: {alpha:g}" if alpha not in (None, 1.0) else ""
    return f'<path d="{path}" style="fill: {fill}; stroke: {hue}; stroke-width: {edge:g}{more}"/>\n' if path else ""
