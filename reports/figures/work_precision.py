# SPDX-License-Identifier: BSD-3-Clause
"""Error against CPU seconds, log-log, one curve an engine and mode; failed runs stand at the edge, none is dropped."""

from __future__ import annotations

from model import is_number

from . import plot, style
from .curve import Drawing, judged, label_metric, metrics

KNOBS = (("walkers", "N"), ("spacing", "dx"), ("time_step", "dt"), ("iterations", "it"), ("support_ratio", "h/dx"))
SHORT = {"N": "walkers", "dx": "spacing [m]", "dt": "time step [s]", "it": "iterations", "h/dx": "support ratio"}


def draw(case, trajectories, notes):
    names, rest = metrics(case, 2)
    if not names or not worth_a_picture(case):
        return None
    figure, axes = plot.panels(len(names), len(judged(case)) + 1, height=3.1)
    drawn = [panel(case, axis, metric) for axis, metric in zip(axes, names)]
    return Drawing(
        "work-precision",
        "Work and precision",
        f"Log-log plot of {', '.join(names)} against CPU seconds for each engine and mode, with the Pareto front.",
        figure,
        caption(drawn, rest),
    )


def worth_a_picture(case):
    """The two forms of one engine at one resolution are no trade of work for precision."""
    curves = judged(case)
    several = len({curve.engine.label for curve in curves if curve.runs}) > 1
    refined = any(engine.orders for engine in case.engines)
    return (several or refined) and sum(len(curve.runs) for curve in curves) >= 2


def caption(drawn, rest):
    meant = list(dict.fromkeys(words.rpartition(" ")[0] for written, _ in drawn for words in written))
    said = "Lower left is better; the engine exact, which evaluates the reference, is left out."
    if meant:
        said += f" Labels: {', '.join(f'{word} = {SHORT[word]}' for word in meant)}."
    if any(loose for _, loose in drawn):
        said += " Points without a line: several runs of one level, or seconds that do not follow what was refined."
    said += (
        " Wide grey line: Pareto front, where no other run is both faster and more accurate. Crosses at the edge: "
        "runs that failed or gave no number."
    )
    return said + (f" In the table of runs alone: {', '.join(rest)}." if rest else "")


def panel(case, axis, metric):
    """@return the labels that were written, and whether points of a curve stand without a line"""
    good, bad, labels, loose = [], [], [], False
    for curve in judged(case):
        look = style.look(curve)
        own, failures = points_of(curve, metric)
        bad += [(cost, why, look["color"]) for cost, why in failures]
        if own:
            if len(own) > 1 and not is_ladder(own):
                look["linestyle"], loose = "none", True
            own.sort()
            draw_points(axis, curve, own, look)
            for cost, error, _, words, _ in own[:: max(1, len(own) - 1)]:
                labels.append((words, (cost, error), look["color"]))
            good += [(cost, error) for cost, error, *_ in own]
    front(axis, good)
    axis.margins(x=0.12, y=0.1)
    if good:  # else there is nothing to scale by
        axis.logarithmic()
        low, high = axis.get_xlim()
        axis.set_xlim(low, high * (high / low) ** 0.13)  # room for the last label
    axis.labels(labels)
    failed(axis, bad, good)
    axis.set_xlabel("CPU seconds, all threads")
    label_metric(axis, case, metric)
    return [words for words, _, _ in labels if words], loose


def points_of(curve, metric):
    """([(cost, error, its uncertainty, label, level)], [(cost, why there is no point)])"""
    own, failures = [], []
    for run in curve.runs:
        m, cost = run.metrics.get(metric), run.cost.get("cpu_s")
        sound = run.status == "ok" and m and is_number(m.value) and is_number(cost) and cost > 0
        if sound and m.value != 0:
            own.append((cost, abs(m.value), m.u or 0.0, *label(curve, run)))
        elif (m or run.status != "ok") and run.status not in ("refused", "missing"):
            failures.append((cost, "0" if sound else run.status if run.status != "ok" else "no number"))
    return own, failures


def draw_points(axis, curve, own, look):
    x, y, u, _, _ = zip(*own)
    bars = [[min(2 * s, 0.95 * e) for e, s in zip(y, u)], [2 * s for s in u]]
    axis.errorbar(x, y, yerr=bars, capsize=2, elinewidth=0.8, label=curve.label, **look)


def label(curve, run):
    """The knob in which this curve's runs differ, with its value, as text; and the value. ("", None) where they differ
    in none."""
    for name, short in KNOBS:
        values = {r.knob(name) for r in curve.runs}
        if len(values) > 1 and is_number(run.knob(name)):
            return f"{short} {style.power(run.knob(name))}", run.knob(name)
    return "", None


def is_ladder(own):
    """Whether runs, by what was refined in them, cost more and more or less and less: a line through them then goes one
    way."""
    levels = [level for *_, level in own]
    if None in levels or len(set(levels)) < len(levels):
        return False
    costs = [entry[0] for entry in sorted(own, key=lambda entry: entry[-1])]
    return costs == sorted(costs) or costs == sorted(costs, reverse=True)


def front(axis, good):
    """Steps through the runs that no other run beats in both."""
    best, steps = float("inf"), []
    for x, y in sorted(good):
        if y < best:
            best = y
            steps.append((x, y))
    if steps:
        low, high = min(x for x, _ in good), max(x for x, _ in good)
        xs, ys = [steps[0][0]], [max(y for _, y in good)]
        for x, y in steps:
            xs += [x, x]
            ys += [ys[-1], y]
        axis.plot(
            xs + [max(high, low * 1.01)],
            ys + [ys[-1]],
            color=style.GREY,
            linewidth=5,
            alpha=0.28,
            zorder=0,
            solid_joinstyle="miter",
            label="Pareto front",
        )


def failed(axis, bad, good):
    """Crosses at the upper edge at their cost, or in its corner where the cost is not known."""
    middle = good[0][0] if good else 1.0
    for k, (cost, why, hue) in enumerate(bad[:6]):
        known = is_number(cost) and cost > 0
        height = 1.03 - 0.07 * k if why != "0" else 0.03
        axis.cross(
            cost if known else middle,
            height,
            ("error exactly 0" if why == "0" else why) + ("" if known else " (cost unknown)"),
            hue,
        )
    if len(bad) > 6:
        axis.set_title(f"and {len(bad) - 6} more failed runs: see the table", fontsize=8, color=style.RED)
