# SPDX-License-Identifier: BSD-3-Clause
"""Error against the refined quantity, log-log: measured points, the fitted order with its 95 % interval, the formal
slope."""

from __future__ import annotations

import math

import numpy as np

from model import is_number

from . import plot, style
from .curve import Drawing, judged, label_metric

UNITS = {
    "spacing": "particle spacing [m]",
    "time_step": "time step [s]",
    "support_ratio": "1 / support ratio",
    "walkers": "1 / walkers",
    "iterations": "1 / iterations",
}
INVERSE = (
    "support_ratio",
    "walkers",
    "iterations",
)  # the more the finer: drawn against 1/level, so that finer is always left
MOST_PANELS = 4


def draw(case, trajectories, notes):
    wanted = list(dict.fromkeys((order.metric, order.axis) for engine in case.engines for order in engine.orders))
    wanted = [pair for pair in wanted if any(len(points(curve, *pair)) > 1 for curve in judged(case))]
    if not wanted:
        return None
    if len(wanted) > MOST_PANELS:
        notes.append(
            f"convergence is drawn for the first {MOST_PANELS} studies; in the table of orders alone: "
            + ", ".join(f"{m} by {a}" for m, a in wanted[MOST_PANELS:])
        )
        wanted = wanted[:MOST_PANELS]
    figure, axes = plot.panels(len(wanted), len(judged(case)))
    for axis, (metric, knob) in zip(axes, wanted):
        panel(case, axis, metric, knob)
    return Drawing(
        "convergence",
        "Convergence",
        f"Log-log plot of {', '.join(m for m, _ in wanted)} against {', '.join(UNITS.get(k, k) for _, k in wanted)} "
        "for each engine and mode.",
        figure,
        "Finer is to the left. Points: error with two standard uncertainties. Line: fitted order, shaded over its 95 "
        "% interval, which is written beside it. Dots: formal slope.",
    )


def order_of(curve, metric, knob):
    return next(
        (o for o in curve.engine.orders if (o.metric, o.axis) == (metric, knob) and o.mode in (curve.mode, "")), None
    )


def points(curve, metric, knob):
    """[(step, error, uncertainty)], fine to coarse: as fitted; without a fit, the study's runs; without a study, runs
    that differ in this knob alone."""
    order = order_of(curve, metric, knob)
    if order and order.points:
        return order.points
    groups = {}
    for run in curve.runs:
        level, m = run.levels.get(knob, None if run.levels else run.knobs.get(knob)), run.metrics.get(metric)
        if run.status == "ok" and is_number(level) and level > 0 and m and is_number(m.value) and m.value != 0:
            point = (1.0 / level if knob in INVERSE else level, abs(m.value), m.u or 0.0)
            groups.setdefault(other_knobs(run, knob), []).append(point)
    return sorted(max(groups.values(), key=len, default=[]))


def other_knobs(run, knob):
    """What else runs differ in; nothing within a study."""
    knobs = () if run.levels else ("spacing", "support_ratio", "walkers", "iterations")
    return tuple(run.knob(k) for k in knobs if k != knob)


def panel(case, axis, metric, knob):
    formal, labels = {}, []
    for curve in judged(case):
        found = points(curve, metric, knob)
        if not found:
            continue
        look = style.look(curve)
        x, y, u = zip(*found)
        axis.errorbar(
            x,
            y,
            yerr=[[min(2 * s, 0.95 * e) for e, s in zip(y, u)], [2 * s for s in u]],
            color=look["color"],
            marker=look["marker"],
            linestyle="none",
            capsize=2,
            elinewidth=0.9,
            label=curve.label,
        )
        order = order_of(curve, metric, knob)
        if order and is_number(order.value) and len(found) > 1:
            labels.append(fitted(axis, found, order, look))
            if is_number(order.formal):
                formal.setdefault(order.formal, found)
    for slope, found in sorted(formal.items()):
        guide(axis, slope, found)
    axis.margins(x=0.1, y=0.12)
    axis.logarithmic()
    axis.labels(labels, (4, -14))
    axis.set_xlabel(UNITS.get(knob, knob.replace("+", ", with it ").replace("_", " ")))
    label_metric(axis, case, metric)


def fitted(axis, found, order, look):
    """The fitted curve and the fan of its interval about the points' centre. @return the label that says the order"""
    log_x, log_y = (np.log([p[k] for p in found]) for k in (0, 1))
    x0, y0 = math.exp(log_x.mean()), math.exp(log_y.mean())
    x = np.exp(np.linspace(log_x.min(), log_x.max(), 25))
    y = y0 * (x / x0) ** order.value
    if is_number(order.coefficient) and is_number(order.floor):
        y = law(order, x, x0, order.value)
    axis.plot(x, y, color=look["color"], linestyle=look["linestyle"], linewidth=1.3)
    words = f"{order.value:.2f}"
    if is_number(order.low) and is_number(order.high):
        fan = [
            law(order, x, x0, edge)
            if is_number(order.coefficient) and is_number(order.floor)
            else y * (x / x0) ** (edge - order.value)
            for edge in (order.low, order.high)
        ]
        axis.fill_between(x, np.minimum(*fan), np.maximum(*fan), color=look["color"], alpha=0.15, linewidth=0)
        words += f" [{order.low:.2f}, {order.high:.2f}]" + f" {order.fit_class}"
    if order.fit_class == "plateau":  # the slope of its falling part is no order of the flat line that is seen
        words = "no order: the error no longer falls"
    return words, (x[-9], y[-9]), look["color"]


def law(order, x, x0, slope):
    """|floor + C x^p| as fitted; at another slope the term keeps its value at x0. Floor and C are signed."""
    return np.abs(order.floor + order.coefficient * x0**order.value * (x / x0) ** slope)


def guide(axis, slope, found):
    """The formal slope a little under the points whose study states it."""
    x = [found[0][0], found[-1][0]]
    y = [0.55 * found[0][1], 0.55 * found[0][1] * (x[1] / x[0]) ** slope]
    axis.plot(x, y, color=style.GREY, linestyle=":", linewidth=1.3, zorder=1, label=f"formal order {slope:g}")
