# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment saw, with its uncertainty, the engines over it, and what is left between them.

The points are those of the file of the case's reference; a metric that has a reference of its own is not drawn. An
engine's value at a point is the point plus the judged difference of results.json, so nothing is formed anew."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from model import is_number, number, text

from . import plot, style
from .curve import Drawing, curves

MOST_BYTES = 1_000_000
QUANTITY = {"front_lead": "front"}  # quantity of a metric -> column of the reference whose value it differs from


def draw(case, trajectories, notes):
    metric, column = measured_metric(case)
    if metric is None:
        return None
    truth = read(Path(text(case.reference.get("file"))), {column})
    if truth is None:
        notes.append("the measured points are not drawn: the reference's file is not there or cannot be read")
        return None
    parts = [(curve, differences(curve.shown, metric)) for curve in curves(case) if curve.shown]
    parts = [(curve, points) for curve, points in parts if points is not None]
    if not parts:
        return None
    figure, axes = plot.panels(2, len(parts) + 1)
    draw_parts(axes, truth[column], number(metric.get("scale")) or 1.0, parts)
    for axis in axes:
        axis.set_xlabel("time [s]")
    axes[0].set_ylabel(f"{column} ({text(metric.get('unit')) or 'm'})", fontsize=8.5)
    axes[1].set_ylabel("engine minus measured", fontsize=8.5)
    return Drawing(
        "observed",
        f"Measured {column}, and the engines",
        f"Measured {column} against time with {', '.join(curve.label for curve, _ in parts)} over it, and the "
        "differences.",
        figure,
        f"Circles: {text(case.reference.get('source'))}; bars: two standard uncertainties. Right: what is left "
        "between engine and measurement.",
    )


def measured_metric(case):
    """(the first metric that an experiment's file holds, its column there); None twice where there is none."""
    for metric in case.metrics if text(case.reference.get("kind")) == "experiment" else ():
        column = QUANTITY.get(text(metric.get("quantity")))
        if column and not metric.get("reference"):
            return metric, column
    return None, None


def draw_parts(axes, measured, scale, parts):
    """Left the points with the engines over them, right what is left between them."""
    time, value, u = measured
    points = {"yerr": 2 * u / scale, "color": style.INK, "linestyle": "none", "capsize": 3}
    axes[0].errorbar(time, value / scale, marker="o", markersize=6, markerfacecolor="none", label="measured", **points)
    axes[1].axhline(0.0, color=style.INK, linewidth=1.2, alpha=0.75)
    axes[1].errorbar(time, 0 * time, alpha=0.75, **points)
    for curve, (t, lead) in parts:
        look = style.look(curve)
        axes[0].plot(t, np.interp(t, time, value) / scale + lead, label=curve.label, **look)
        axes[1].plot(t, lead, **look)


def differences(run, metric):
    """(times, judged differences in the metric's unit) of a run; None where it has none."""
    m = run.metrics.get(text(metric.get("name")))
    if (
        m is None
        or not m.times
        or len(m.times) != len(m.series)
        or not all(is_number(number(v)) for v in [*m.times, *m.series])
    ):
        return None
    return np.array(m.times, float), np.array(m.series, float)


def read(path, columns):
    """{column: (times [s], values, standard uncertainties)} in SI of a reference's file; None where it cannot be
    read."""
    try:
        if path.stat().st_size > MOST_BYTES:
            return None
        lines = path.read_text(encoding="utf-8").splitlines()
        units, shares = ({}, {})
        for line in lines:
            unit, share = (
                re.match(r"# unit (\w+): ([\d.eE+-]+)", line),
                re.match(r"# uncertainty (\w+): ([\d.eE+-]+) %", line),
            )
            units.update({unit[1]: float(unit[2])} if unit else {})
            shares.update({share[1]: float(share[2]) / 100} if share else {})
        rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
        found = {}
        for column in columns:
            points = [
                (float(row["time"]) * units.get("time", 1.0), float(row[column]) * units.get(column, 1.0))
                for row in rows
                if row.get(column)
            ]
            time, value = (np.array([p[k] for p in points]) for k in (0, 1))
            found[column] = time, value, shares.get(column, 0.0) * np.abs(value)
        return found
    except (OSError, ValueError, KeyError, TypeError):
        return None
