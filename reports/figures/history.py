# SPDX-License-Identifier: BSD-3-Clause
"""The strip of a case's history: how much of its limits each run used, one place a run, a line where its figures were
accepted."""

from __future__ import annotations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from model import is_number

from . import style
from .curve import Drawing

MOST_LINES, MOST_RUNS = 6, 200
MOVED = 0.02  # of the limit: where no gate has moved by more, a sentence says so
FLOOR = 1e-4  # smaller shares stand at the lower edge


def draw(case, trajectories, notes):
    runs = [entry for entry in case.history if not entry.accepted][-MOST_RUNS:]
    if len(runs) < 2:
        return None  # one run is no history
    keys = worst_first(runs)
    if not any(moved([entry.used[key] for entry in runs if key in entry.used]) for key in keys):
        notes.append(
            f"history: over {len(runs)} runs no gate's use of its limit has moved by more than {100 * MOVED:.0f} %, "
            "and no verdict has changed"
        )
        return None
    if len(keys) > MOST_LINES:
        notes.append(f"the strip of runs shows the {MOST_LINES} of {len(keys)} gates that use most of their limits")
    keys = keys[:MOST_LINES]
    figure = Figure(figsize=(style.WIDTH, 2.5))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0.1, 0.2, 0.58, 0.72))
    for k in range(len(keys)):
        draw_gate(axis, runs, keys, k)
    axis.axhline(1.0, color=style.RED, linewidth=1.2)
    mark_acceptances(axis, case, runs)
    scale_axes(axis, runs)
    figure.legend(*axis.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(0.69, 0.55), fontsize=8)
    return Drawing(
        "history",
        "History: share of each limit over runs",
        f"{len(runs)} runs, oldest left; the limit is at 1.",
        figure,
        "Oldest left. Red line: the limit. Crosses: not green. Dashed: figures were accepted there (tripoint gate "
        "accept).",
    )


def draw_gate(axis, runs, keys, k):
    """The line of the k-th gate, with a cross at each run in which it was not green."""
    key = keys[k]
    engine, mode, metric, level = key
    used = [(n, entry.used[key]) for n, entry in enumerate(runs) if key in entry.used]
    places = [(n, max(share, FLOOR), verdict) for n, (share, _, verdict) in used if is_number(share)]
    label = " ".join(part for part in (engine, mode, metric, f"at {level:g}" if level is not None else "") if part)
    axis.plot(
        [p[0] for p in places],
        [p[1] for p in places],
        color=style.colour(engine_label(engine), [engine_label(name) for name, *_ in keys]),
        marker=style.MARKERS[k % len(style.MARKERS)],
        markersize=3.5,
        linewidth=1,
        label=label,
        alpha=0.9,
    )
    red = [p for p in places if p[2] != "pass"]
    axis.plot([p[0] for p in red], [p[1] for p in red], "x", color=style.RED, markersize=7, markeredgewidth=2)


def scale_axes(axis, runs):
    axis.set_yscale("log")
    axis.yaxis.set_major_locator(style.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.yaxis.set_major_formatter(style.ticker.FuncFormatter(style.power))
    axis.yaxis.set_minor_locator(style.ticker.NullLocator())
    axis.set_xlim(-0.5, len(runs) - 0.5)
    ticks = sorted({0, len(runs) // 2, len(runs) - 1})
    axis.set_xticks(ticks, [f"{runs[n].date[:10]}\n{runs[n].commit[:8]}" for n in ticks], fontsize=8)
    axis.set_ylabel("share of the limit")


def engine_label(engine):
    return engine.replace(" (", " · ").rstrip(")")


def worst_first(runs):
    worst = {}
    for entry in runs:
        for key, (used, _, _) in entry.used.items():
            if is_number(used):
                worst[key] = max(worst.get(key, 0.0), used)
    return sorted(worst, key=lambda key: (-worst[key], str(key)))


def moved(found):
    """Whether shares or verdicts of one gate differ between runs."""
    shares = [used for used, _, _ in found if is_number(used)]
    return len({verdict for _, _, verdict in found}) > 1 or bool(shares) and max(shares) - min(shares) > MOVED


def mark_acceptances(axis, case, runs):
    for entry in case.history:
        if entry.accepted:
            before = sum(run.date <= entry.date for run in runs)
            axis.axvline(before - 0.5 if before == 0 else before - 1, color=style.SOFT, linewidth=1, linestyle="--")
