# SPDX-License-Identifier: BSD-3-Clause
"""Every gate of the suite on one scale: how much of its limit is used."""
from __future__ import annotations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from model import is_number

from . import style
from .curve import Drawing

FLOOR = 1e-4  # smaller shares stand at the left edge
MOST_LINES = 160


def draw(results, notes):
    lines = {}
    for case in results.cases:
        for engine in case.engines:
            for gate in engine.gates:
                mode = gate.mode or next((g.mode for e in case.engines for g in e.gates if g.metric == gate.metric and g.mode), "")
                if not (gate.expect and gate.allowed.startswith("class")):  # a class of convergence has no scale
                    lines.setdefault((case.number, gate.metric, mode), []).append((case, engine, gate))
    if not lines:
        return None
    if len(lines) > MOST_LINES:
        notes.append(f"the overview of limits shows {MOST_LINES} of {len(lines)} lines; every gate is in the table of its case")
    kept = list(lines.items())[:MOST_LINES]
    height = 0.2 * len(kept) + 0.95
    figure = Figure(figsize=(style.WIDTH, height))
    FigureCanvasAgg(figure)
    axis = figure.add_axes([0.46, 0.48 / height, 0.49, 1 - 0.95 / height])
    seen = set()
    for k, ((number, metric, mode), gates) in enumerate(kept):
        for case, engine, gate in gates:
            mark(axis, k, case, engine, gate, seen)
    finish(axis, kept)
    handles = axis.get_legend_handles_labels()
    figure.legend(*handles, loc="upper left", ncol=min(6, len(handles[1])), bbox_to_anchor=(0.0, 1.0), columnspacing=1.2, borderaxespad=0.3)
    return Drawing("limits", "How much of each limit is used", f"{len(kept)} gates on a logarithmic scale of value over limit; the limit is at 1.", figure,
                   "Value over limit (distance from the middle over half the width for a band). Whiskers: two standard uncertainties. Left of 1 is inside. Far left is a slack limit. Triangles: beyond the scale. Crosses: no finite value.")


def mark(axis, k, case, engine, gate, seen):
    hue = style.colour(engine.name, [e.name for e in case.engines])
    name = engine.name if engine.name not in seen else None
    used = gate.used
    if not is_number(used) and gate.verdict == "PASS":
        used = 0.0  # a limit of zero that is met
    if not is_number(used):
        axis.plot([1.0], [k], "x", color=style.RED, markersize=6, markeredgewidth=2)
        axis.annotate(gate.verdict.lower(), (1.0, k), xytext=(6, -3), textcoords="offset points", fontsize=7.5, color=style.RED)
        return
    if name:
        axis.plot([], [], "o", color=hue, label=name, markersize=4.5)
    seen.add(engine.name)
    place, k = min(max(used, FLOOR), 100.0), k + shift(engine, case)
    if is_number(gate.uncertainty) and gate.uncertainty > 0 and gate.value:
        reach = 2 * gate.uncertainty * used / abs(gate.value) if not gate.band else 4 * gate.uncertainty / (gate.band[1] - gate.band[0])
        axis.plot([max(place - reach, FLOOR), place + reach], [k, k], color=hue, linewidth=0.9, alpha=0.7)
    presets = list(dict.fromkeys(e.preset for e in case.engines if e.name == engine.name))
    axis.plot([place], [k], style.MARKERS[presets.index(engine.preset) % len(style.MARKERS)] if FLOOR <= used <= 100.0 else "<" if used < FLOOR else ">", color=hue, markersize=4.5,
              markeredgecolor=style.RED if gate.verdict == "FAIL" else style.INK if gate.verdict != "PASS" else hue, markeredgewidth=1.4)


def shift(engine, case):
    """Engines of one line stand a little apart, so that equal ones are seen."""
    judged = [e.label for e in case.engines if e.gates]
    return 0.0 if len(judged) < 2 else 0.36 * (judged.index(engine.label) / (len(judged) - 1) - 0.5)


def finish(axis, kept):
    style.logarithmic(axis, "x")
    low, high = axis.get_xlim()
    axis.set_xlim(max(low, FLOOR) * 0.8, max(high, 3.0))
    axis.axvline(1.0, color=style.RED, linewidth=1.4, zorder=0)
    axis.axvspan(1.0, axis.get_xlim()[1], color=style.RED, alpha=0.06, linewidth=0, zorder=0)
    axis.set_ylim(len(kept) - 0.4, -0.6)
    cases = {entries[0][0].number: entries[0][0] for _, entries in kept}
    axis.set_yticks(range(len(kept)))
    before = [None] + [number for (number, _, _), _ in kept]
    axis.set_yticklabels([("" if before[k] == number else short(cases[number].id) + "   ") + metric + (f" ({mode})" if mode else "") for k, ((number, metric, mode), _) in enumerate(kept)], fontsize=8)
    axis.tick_params(axis="y", length=0)
    axis.set_xlabel("value / limit")
    for k, ((number, _, _), _) in enumerate(kept):
        if k and before[k] != number:
            axis.axhline(k - 0.5, color=style.GRID, linewidth=1.0)
    axis.grid(axis="y", visible=False)


def short(name):
    return name if len(name) <= 34 else name[:33] + "…"
