# SPDX-License-Identifier: BSD-3-Clause
"""The page "Stable steps and hard cases": the stored frontiers of the time step beside what linear modes predict, how
exact a contact is, where other engines hold, and every case tagged `hard`, corrected and printed side by side.

validation/stability/frontiers.csv is the stored map, which a test of the solver holds against what it measures; here it
is drawn."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import table1

MAP = Path(__file__).resolve().parent.parent / "validation" / "stability" / "frontiers.csv"
COLUMNS = (("corrected", "tripoint", "corrected"), ("as printed", "tripoint", "paper"))


@dataclass
class Frontier:
    """One point of a map; times in seconds."""

    map: str
    mode: str
    parameter: str
    value: float
    measured: float
    predicted: float
    own: float


def read_map(path=MAP):
    """@return (frontiers, notes)"""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return [
                Frontier(
                    r["map"],
                    r["mode"],
                    r["parameter"],
                    *(float(r[k]) for k in ("value", "frontier [s]", "predicted [s]", "own step [s]")),
                )
                for r in csv.DictReader(file)
            ], []
    except (OSError, ValueError, KeyError, TypeError) as error:
        return [], [f"the stored map of stable steps cannot be read: {error}"]


def groups(frontiers):
    """Frontiers by what bounds the step and what is varied, in the order of the file."""
    found = {}
    for point in frontiers:
        found.setdefault((point.map, point.parameter), []).append(point)
    return found


def draw(frontiers, out):
    """@return (svg, notes): measured, predicted and own step, one panel a map"""
    try:
        from figures import style
    except Exception as error:
        return "", [f"the maps are not drawn: {error}"]
    maps = groups(frontiers)
    if not maps:
        return "", []
    figure, axes = style.panels(len(maps), 6, height=2.8)
    for axis, ((name, parameter), points) in zip(axes, maps.items()):
        draw_mode(axis, points, "corrected", style.SOFT, style.BLUE)
        draw_mode(axis, points, "paper", style.SOFT, style.ORANGE)
        values = [p.value for p in points]
        style.logarithmic(axis, "xy" if min(values) > 0.0 and max(values) > 20.0 * min(values) else "y")
        axis.set_title(f"{name}, over {parameter}")
        axis.set_xlabel(parameter)
        axis.set_ylabel("time step [s]")
    style.legend(figure, axes)
    return style.inline(style.files(figure, out / "figures" / "stability-maps"), "stability"), []


def draw_mode(axis, points, mode, soft, hue):
    shown = sorted((p for p in points if p.mode == mode), key=lambda p: p.value)
    if not shown:
        return
    x, printed = [p.value for p in shown], mode == "paper"
    lines = (
        ("predicted", [p.predicted for p in shown], {"color": soft, "linestyle": "--" if printed else "-"}),
        ("longest stable", [p.measured for p in shown], {"color": hue, "linestyle": "", "marker": "o"}),
        ("solver's own", [p.own for p in shown], {"color": hue, "linestyle": "", "marker": "_", "markersize": 9}),
    )
    for words, y, look in lines:
        axis.plot(x, y, label=words + (", printed" if printed else ""), **look)


def read(results, out):
    """@return (frontiers, svg, rows, notes); a row is a case and its entries by column"""
    frontiers, notes = read_map()
    svg, more = draw(frontiers, out) if frontiers else ("", [])
    listed = []
    for case in results.cases:
        if "hard" not in table1.tags(case):
            continue
        listed.append(
            (
                case,
                [
                    [
                        table1.entry(case, engine, mode)
                        for engine in case.engines
                        if engine.name == name and mode in engine.modes
                    ]
                    for _, name, mode in COLUMNS
                ],
            )
        )
    return frontiers, svg, listed, notes + more
