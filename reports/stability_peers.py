# SPDX-License-Identifier: BSD-3-Clause
"""Two more stored maps of the page "Stable steps and hard cases": how exact a contact is, and where the other engines
hold."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "validation" / "stability"


@dataclass
class Hit:
    """A head-on hit of two equal cubes."""

    speed: float  # of approach, over that of sound
    step: float  # over the solver's own
    energy: float  # |kinetic energy at the end / at the start - 1|
    overlap: float  # greatest [spacings]


@dataclass
class Peer:
    """One point of another engine's map."""

    engine: str
    map: str
    parameter: str
    value: float
    measured: float
    predicted: float
    own: float
    unit: str


def read(name, make):
    """@return (what `make` makes of each row of a stored map, notes)"""
    try:
        with open(FOLDER / name, newline="", encoding="utf-8") as file:
            return [make(row) for row in csv.DictReader(file)], []
    except (OSError, ValueError, KeyError, TypeError) as error:
        return [], [f"the stored map {name} cannot be read: {error}"]


def read_contact():
    return read("contact.csv", lambda r: Hit(*(float(x) for x in r.values())))


def read_peers():
    return read(
        "engines.csv",
        lambda r: Peer(
            r["engine"],
            r["map"],
            r["parameter"],
            *(float(r[k]) for k in ("value", "frontier", "predicted", "own")),
            r["unit"],
        ),
    )


def draw_contact(hits, out):
    """Energy error and overlap over the speed, a line for each step."""
    from figures import style

    figure, (energy, overlap) = style.panels(2, 4)
    steps = sorted({h.step for h in hits}, key=lambda step: (step != 1, step))
    for k, step in enumerate(steps):
        shown = sorted((h for h in hits if h.step == step), key=lambda h: h.speed)
        hue, marker = (
            (style.SKY, style.GREEN, style.BLUE, style.ORANGE, style.PINK)[k % 5],
            style.MARKERS[k % len(style.MARKERS)],
        )
        name = "the solver's own step" if step == 1 else f"{step:g} of it"
        energy.plot([h.speed for h in shown], [h.energy for h in shown], color=hue, marker=marker, label=name)
        overlap.plot([h.speed for h in shown], [h.overlap for h in shown], color=hue, marker=marker)
    overlap.axhline(1.0, color=style.SOFT, linestyle=":")
    style.logarithmic(energy)
    style.logarithmic(overlap)
    for axis, title, label in (
        (energy, "energy that a hit does not give back", "share of the energy"),
        (overlap, "deepest overlap; beyond the dotted line the guard stops", "spacings"),
    ):
        axis.set_title(title)
        axis.set_xlabel("speed of approach over that of sound")
        axis.set_ylabel(label)
    style.legend(figure, (energy, overlap))
    return style.inline(style.files(figure, out / "figures" / "contact-map"), "contact")


def draw_peers(peers, out):
    """A panel for each map of another engine."""
    from figures import style

    maps = {}
    for peer in peers:
        maps.setdefault((peer.engine, peer.map), []).append(peer)
    figure, axes = style.panels(len(maps), 3, height=2.6)
    for axis, ((engine, name), points) in zip(axes, maps.items()):
        x = [p.value for p in points]
        axis.plot(x, [p.predicted for p in points], color=style.SOFT, label="predicted")
        axis.plot(
            x,
            [p.measured for p in points],
            color=style.KNOWN.get(engine, style.GREY),
            linestyle="",
            marker="o",
            label="measured",
        )
        axis.plot(
            x,
            [p.own for p in points],
            color=style.KNOWN.get(engine, style.GREY),
            linestyle="",
            marker="_",
            markersize=9,
            label="what the engine or its adapter takes",
        )
        style.logarithmic(axis, "xy" if max(x) > 10 * min(x) else "y")
        axis.set_title(f"{engine}: {name}")
        axis.set_xlabel(points[0].parameter)
        axis.set_ylabel("iterations needed" if points[0].unit == "iterations" else f"longest step [{points[0].unit}]")
    style.legend(figure, axes)
    return style.inline(style.files(figure, out / "figures" / "stability-engines"), "engines")


def drawings(out):
    """@return (hits, drawing, peers, drawing, notes); a drawing is empty where its map or matplotlib is missing"""
    hits, notes = read_contact()
    peers, more = read_peers()
    notes = notes + more
    pictures = []
    for draw, points in ((draw_contact, hits), (draw_peers, peers)):
        try:
            pictures.append(draw(points, out) if points else "")
        except Exception as error:  # a page without a picture still has its table
            pictures.append("")
            notes.append(f"a map is not drawn: {error}")
    return hits, pictures[0], peers, pictures[1], notes
