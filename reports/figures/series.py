# SPDX-License-Identifier: BSD-3-Clause
"""The error of each metric in time, of every engine and mode at the case's own resolution, with its band of two
standard uncertainties."""

from __future__ import annotations

import numpy as np

from model import table

from . import plot, style
from .curve import Drawing, curves, label_metric

MOST_PANELS = 4


def draw(case, trajectories, notes):
    shown_runs = [(curve, curve.shown) for curve in curves(case) if curve.shown]
    names = list(dict.fromkeys(name for _, run in shown_runs for name in [*run.metrics, *run.series]))
    drawn = [name for name in names if any(numbers(run, name) is not None for _, run in shown_runs)]
    if not drawn:
        return None
    if len(drawn) > MOST_PANELS:
        notes.append("error in time is not drawn for " + ", ".join(drawn[MOST_PANELS:]))
        drawn = drawn[:MOST_PANELS]
    figure, axes = plot.panels(len(drawn), len(shown_runs), height=2.5)
    for axis, name in zip(axes, drawn):
        panel(case, axis, name, shown_runs)
    return Drawing(
        "error-in-time",
        "Metrics in time",
        f"{', '.join(drawn)} against time for each engine and mode.",
        figure,
        "Each engine at the case's own resolution; shaded: two standard uncertainties where the run states them.",
    )


def numbers(run, name):
    """(time, value, uncertainty|None) as arrays of equal length, None where the series is not sound."""
    entry = table(run.series.get(name))
    u = entry.get("uncertainty", entry.get("error"))
    time, value = entry.get("time", ()), entry.get("value", ())
    if name in run.metrics and run.metrics[name].times:
        time, value = run.metrics[name].times, run.metrics[name].series
    try:
        time, value, u = floats(time), floats(value), floats(u) if isinstance(u, list) else None
    except (TypeError, ValueError):
        return None
    if len(time) < 2 or len(time) != len(value) or not np.isfinite(value).any():
        return None
    return time, value, u if u is not None and len(u) == len(value) else None


def floats(values):
    return np.array([np.nan if v is None else float(v) for v in values])


def panel(case, axis, name, shown_runs):
    found = [(curve, numbers(run, name)) for curve, run in shown_runs]
    found = [(curve, entry) for curve, entry in found if entry is not None]
    everything = np.concatenate(
        [
            value[np.isfinite(value) & (value != 0)]
            for curve, (_, value, _) in found
            if curve.engine.name != "exact" or len(found) == 1
        ]
    )
    log = everything.size > 0 and everything.min() > 0 and everything.max() / everything.min() > 50
    for curve, (time, value, u) in found:
        look = style.look(curve)
        if log and not (value > 0).any():
            axis.plot([], [], color=look["color"], linestyle=look["linestyle"], label=f"{curve.label}: 0 throughout")
            continue
        value = np.where(value > 0, value, np.nan) if log else value
        axis.plot(
            time,
            value,
            label=curve.label,
            color=look["color"],
            linestyle=look["linestyle"],
            marker=look["marker"],
            markevery=max(1, len(time) // 6),
            markersize=3.5,
        )
        if u is not None:
            axis.fill_between(time, value - 2 * u, value + 2 * u, color=look["color"], alpha=0.15, linewidth=0)
    if log:
        axis.set_ylim(bottom=max(everything.min() * 0.7, everything.max() * 1e-14), top=everything.max() * 1.6)
        axis.logarithmic("y")
    axis.set_xlabel("time [s]")
    label_metric(axis, case, name)
