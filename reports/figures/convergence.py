# SPDX-License-Identifier: BSD-3-Clause
"""Error against the refined quantity, log-log: measured points, the fitted order with its 95 % interval, the formal slope."""
from __future__ import annotations

import math

from load import is_number

from . import style
from .curve import Drawing, curves

UNITS = {"spacing": "particle spacing [m]", "time_step": "time step [s]", "support_ratio": "support ratio h/dx", "walkers": "walkers", "iterations": "iterations"}
RISING = ("walkers", "iterations")  # the more the finer: an order p falls as value^-p
MOST_PANELS = 4


def draw(case, trajectories, notes):
    wanted = list(dict.fromkeys((order.metric, order.axis) for engine in case.engines for order in engine.orders))
    wanted = [pair for pair in wanted if any(len(points(curve, *pair)) > 1 for curve in curves(case))]
    if not wanted:
        return None
    if len(wanted) > MOST_PANELS:
        notes.append("convergence drawn for the first " + str(MOST_PANELS) + " studies; the others are in the table of orders: " + ", ".join(f"{m} by {a}" for m, a in wanted[MOST_PANELS:]))
        wanted = wanted[:MOST_PANELS]
    figure, axes = style.panels(len(wanted))
    for axis, (metric, knob) in zip(axes, wanted):
        panel(case, axis, metric, knob)
    style.legend(figure, axes)
    return Drawing("convergence", "Convergence", f"Log-log plot of {', '.join(m for m, _ in wanted)} against {', '.join(UNITS.get(k, k) for _, k in wanted)} for each engine and mode.", figure,
                   "Points: measured error with two standard uncertainties. Line: fitted order, shaded over its 95 % interval. Grey dots: formal order, or slopes 1 and 2 as a guide where the study names none.")


def points(curve, metric, knob):
    """[(knob, error, uncertainty)] of sound runs; of several runs at one value, those of a study in another knob are kept too."""
    groups = {}
    others = [name for name in ("spacing", "time_step", "support_ratio", "walkers", "iterations") if name != knob and (knob, name) not in (("spacing", "time_step"),)]
    for run in curve.runs:
        x, m = run.knob(knob), run.metrics.get(metric)
        if run.status == "ok" and is_number(x) and x > 0 and m and is_number(m.value) and m.value != 0:
            groups.setdefault(tuple(run.knob(name) for name in others), []).append((x, abs(m.value), m.u or 0.0))
    best = max(groups.values(), key=lambda found: len({x for x, _, _ in found}), default=[])
    return sorted(best, key=lambda p: p[0])


def panel(case, axis, metric, knob):
    everything, formals = [], set()
    for curve in curves(case):
        found = points(curve, metric, knob)
        if not found:
            continue
        everything += found
        look = style.look(curve)
        x, y, u = zip(*found)
        down = [min(2 * s, 0.95 * e) for e, s in zip(y, u)]
        axis.errorbar(x, y, yerr=[down, [2 * s for s in u]], color=look["color"], marker=look["marker"], linestyle="none", capsize=2, elinewidth=0.9, label=curve.label)
        order = next((o for o in curve.engine.orders if (o.metric, o.axis) == (metric, knob) and o.mode in (curve.mode, "")), None)
        if order and is_number(order.value) and len(found) > 1:
            fitted(axis, found, order, look, knob)
            if is_number(order.formal):
                formals.add(order.formal)
    style.logarithmic(axis)
    guides(axis, everything, formals, knob)
    axis.set_xlabel(UNITS.get(knob, knob))
    axis.set_ylabel(metric)


def centre(found):
    return (math.exp(sum(math.log(p[0]) for p in found) / len(found)), math.exp(sum(math.log(p[1]) for p in found) / len(found)))


def fitted(axis, found, order, look, knob):
    sign = -1 if knob in RISING else 1
    x0, y0 = centre(found)
    ends = (found[0][0], found[-1][0])

    def line(slope):
        return [y0 * (x / x0) ** (sign * slope) for x in ends]
    axis.plot(ends, line(order.value), color=look["color"], linestyle=look["linestyle"], linewidth=1.3)
    if is_number(order.low) and is_number(order.high):
        xs = [ends[0], x0, ends[1]]
        one, two = ([y0 * (x / x0) ** (sign * slope) for x in xs] for slope in (order.low, order.high))
        axis.fill_between(xs, [min(a, b) for a, b in zip(one, two)], [max(a, b) for a, b in zip(one, two)], color=look["color"], alpha=0.15, linewidth=0)
        words = f"{order.value:.2f}  [{order.low:.2f}, {order.high:.2f}]"
    else:
        words = f"{order.value:.2f}"
    axis.annotate(words, (ends[1], line(order.value)[1]), xytext=(-4, -13), textcoords="offset points", ha="right", color=look["color"], fontsize=8)


def guides(axis, everything, formals, knob):
    """Formal slopes, anchored under the finest points."""
    if len({p[0] for p in everything}) < 2:
        return
    sign = -1 if knob in RISING else 1
    low, high = min(p[0] for p in everything), max(p[0] for p in everything)
    anchor = min(p[1] for p in everything) * 0.6
    fine, coarse = (high, low) if sign < 0 else (low, high)
    for slope in sorted(formals or ({0.5} if knob in RISING else {1.0, 2.0})):
        axis.plot([fine, coarse], [anchor, anchor * (coarse / fine) ** (sign * slope)], color=style.GREY, linestyle=":", linewidth=1.2, zorder=1)
        axis.annotate(f"formal {slope:g}" if formals else f"slope {slope:g}", (coarse, anchor * (coarse / fine) ** (sign * slope)), xytext=(3 if sign > 0 else -3, 2), textcoords="offset points",
                      ha="left" if sign > 0 else "right", color=style.SOFT, fontsize=8, annotation_clip=False)
    axis.set_xlim(low / 1.25, high * 1.6)
