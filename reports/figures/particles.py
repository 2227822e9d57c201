# SPDX-License-Identifier: BSD-3-Clause
"""The particles at the end of the run, one picture an engine, on one scale of length and of colour.

Thin scenes are seen along their thinnest axis, others from above in parallel projection. Points are a picture inside the
SVG, text stays text. Where nothing is warm and bodies fly, earlier frames are drawn paler: a stroboscope.
"""
from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import style
from .curve import Drawing

MOST_PANELS = 8
CELLS = 110  # squares across a picture, of which each shows one particle
THIN = 0.12  # of the longest extent: below it the scene is seen along that axis
LONG = 0.35  # second extent of the first: below it a bar is seen from the side
TURN, TILT = np.radians(-55.0), np.radians(24.0)


def draw(case, trajectories, notes):
    shown = [(curve, t) for curve, t in trajectories if t.position is not None and len(t.position)]
    if not shown:
        return None
    if len(shown) > MOST_PANELS:
        notes.append("pictures show the first " + str(MOST_PANELS) + " engines; not drawn: " + ", ".join(c.label for c, _ in shown[MOST_PANELS:]))
        shown = shown[:MOST_PANELS]
    warm = warmth(shown)
    frames = [t.strobe if warm is None else t.strobe[-1:] for _, t in shown]
    everything = np.concatenate([finite(p) for each in frames for _, p in each])
    view, names = projection(everything)
    if len(everything) and np.abs(everything).max() < 0.1:
        names = [name.replace("[m]", "[mm]") for name in names]
    bounds = extent([view(finite(p)) for each in frames for _, p in each], max(curve.shown.knob("spacing") or 0.0 for curve, _ in shown))
    figure, axes, bar = layout(len(shown), bounds, warm is not None)
    for axis, (curve, trajectory), strobe in zip(axes, shown, frames):
        panel(axis, curve, trajectory, strobe, view, bounds, warm, len(strobe) == 1 and names[0].startswith("across"))
        if "[mm]" in names[0]:
            for side in (axis.xaxis, axis.yaxis):
                side.set_major_formatter(lambda value, _: f"{1000 * value:.4g}")
        axis.set_xlabel(names[0], labelpad=1)
        axis.set_ylabel(names[1], labelpad=1)
        if bounds[1][0] - bounds[0][0] > 6 * (bounds[1][1] - bounds[0][1]):
            axis.locator_params(axis="y", nbins=2)
            axis.set_xlabel("")
    axes[-1].set_xlabel(names[0], labelpad=1)
    if warm is not None:
        colours = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(*warm), style.TEMPERATURE)
        figure.colorbar(colours, cax=bar, orientation="horizontal").set_label("temperature [K]")
        bar.grid(False)
    time = shown[0][1].strobe[-1][0]
    how = "coloured by temperature on one scale" if warm is not None else "coloured by body" + (", earlier times paler" if len(frames[0]) > 1 else "")
    most = max(int(np.isfinite(t.position).all(axis=1).sum()) for _, t in shown)
    caption = f"At t = {time:.4g} s, at the case's own resolution, {how}." + f" Up to {most} particles; of those behind one another the foremost is drawn."
    return Drawing("particles", "Particles, engine by engine", f"Particles at {time:.4g} s for {', '.join(c.label for c, _ in shown)}, {how}.", figure, caption)


def finite(position):
    return position[np.isfinite(position).all(axis=1)]


def warmth(shown):
    """(low, high) of all engines, or None where no temperature differs."""
    values = [t.temperature[np.isfinite(t.temperature)] for _, t in shown if t.temperature is not None]
    values = np.concatenate(values) if values else np.empty(0)
    if not values.size or np.ptp(values) <= 1e-9 * max(1.0, abs(values).max()):
        return None
    return float(values.min()), float(values.max())


def projection(points):
    """A map from (n, 3) to (n, 3): two screen coordinates and depth; and the names of the screen axes."""
    size = np.ptp(points, axis=0) if len(points) else np.ones(3)
    order = np.argsort(-size, kind="stable")
    if size[order[2]] <= THIN * max(size[order[0]], 1e-300) or size[order[1]] <= LONG * size[order[0]]:
        a, b = order[:2] if order[0] < order[1] or size[order[0]] > 4 * size[order[1]] else order[1::-1]
        return (lambda p: p[:, [a, b, order[2]]]), [f"{'xyz'[a]} [m]", f"{'xyz'[b]} [m]"]
    turn = np.array([[np.cos(TURN), -np.sin(TURN), 0], [np.sin(TURN) * np.sin(TILT), np.cos(TURN) * np.sin(TILT), np.cos(TILT)], [np.sin(TURN) * np.cos(TILT), np.cos(TURN) * np.cos(TILT), -np.sin(TILT)]])
    return (lambda p: p @ turn.T), ["across [m]", "up [m]"]


def extent(projected, spacing):
    points = np.concatenate([p[:, :2] for p in projected])
    if not len(points):
        return np.array([0.0, 0.0]), np.array([1.0, 1.0])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = max(0.04 * (high - low).max(), 0.7 * spacing, 1e-12)
    return low - margin, high + margin


def layout(count, bounds, bar):
    """Long scenes are stacked, others stand side by side."""
    wide, tall = bounds[1] - bounds[0]
    columns = 1 if wide > 6 * tall else 2 if wide > 2.5 * tall else 3 if count in (3, 5, 6) else 4
    columns = min(columns, max(count, 2)) if columns > 1 else 1
    lines = -(-count // columns)
    each = style.WIDTH / columns - 0.8
    height = float(np.clip(each * tall / wide, 0.32, 2.9))
    below, above, gap = (1.12 if bar else 0.45), 0.32, 0.72 if columns > 1 else 0.55
    total = lines * height + (lines - 1) * gap + below + above
    figure = Figure(figsize=(style.WIDTH, total))
    FigureCanvasAgg(figure)
    axes = []
    for k in range(count):
        line, column = divmod(k, columns)
        left = (column * style.WIDTH / columns + 0.68) / style.WIDTH
        axes.append(figure.add_axes([left, (below + (lines - 1 - line) * (height + gap)) / total, each / style.WIDTH, height / total]))
    return figure, axes, figure.add_axes([0.3, 0.48 / total, 0.4, 0.1 / total]) if bar else None


def panel(axis, curve, trajectory, strobe, view, bounds, warm, solid):
    axis.set_xlim(bounds[0][0], bounds[1][0])
    axis.set_ylim(bounds[0][1], bounds[1][1])
    axis.set_aspect("equal")
    axis.set_title(curve.label, color=style.look(curve)["color"], fontweight="bold")
    axis.locator_params(nbins=4 if bounds[1][0] - bounds[0][0] < 6 * (bounds[1][1] - bounds[0][1]) else 8)
    axis.set_axisbelow(True)
    for k, (_, position) in enumerate(strobe):
        chosen = np.flatnonzero(np.isfinite(position).all(axis=1))
        seen = view(position[chosen])
        front = in_front(seen, max(0.55 * (curve.shown.knob("spacing") or 0.0), (bounds[1] - bounds[0]).max() / CELLS))
        chosen, seen = chosen[front], seen[front]
        order = np.argsort(-seen[:, 2], kind="stable")
        axis.scatter(seen[order, 0], seen[order, 1], s=marker_area(axis, bounds, curve, len(chosen), 1.25 if solid else 1.1 if len(strobe) > 1 else 0.95), linewidths=0, rasterized=True,
                     alpha=1.0 if k == len(strobe) - 1 else 0.1 + 0.3 * k / len(strobe), **hues(trajectory, chosen[order], seen[order, 2], warm))
    lost = int((~np.isfinite(strobe[-1][1]).all(axis=1)).sum())
    if lost:
        axis.annotate(f"{lost} particles not finite", (0.02, 0.9), xycoords="axes fraction", color=style.RED, fontsize=8)


def in_front(seen, cell):
    """Rows of the particle that is nearest to the viewer in each square of the screen; what lies behind is hidden anyway."""
    place = np.floor(seen[:, :2] / cell)
    order = np.lexsort((seen[:, 2], place[:, 1], place[:, 0]))
    place = place[order]
    first = np.ones(len(order), bool)
    first[1:] = (place[1:] != place[:-1]).any(axis=1)
    return order[first]


def marker_area(axis, bounds, curve, count, size_of):
    """[points^2]: a disc of `size_of` spacings, or such that the points cover the panel where no spacing is stated."""
    box, size = axis.get_position(), axis.figure.get_size_inches()
    spacing = curve.shown.knob("spacing")
    if spacing and spacing > 0:
        least = (1.6 * box.width * size[0] * 72 / CELLS) ** 2
        return float(np.clip((size_of * spacing * box.width * size[0] * 72 / (bounds[1][0] - bounds[0][0])) ** 2, least, 150.0))
    return float(np.clip(0.7 * box.width * box.height * size[0] * size[1] * 72**2 / max(count, 1), 2.5, 60.0))


def hues(trajectory, chosen, depth, warm):
    if warm is not None and trajectory.temperature is not None:
        return {"c": trajectory.temperature[chosen], "cmap": style.TEMPERATURE, "vmin": warm[0], "vmax": warm[1]}
    bodies = trajectory.body[chosen].astype(int) if trajectory.body is not None else np.zeros(len(chosen), int)
    colours = np.array([matplotlib.colors.to_rgb(style.BODIES[b % len(style.BODIES)] if b >= 0 else style.GREY) for b in range(-1, max(bodies.max(initial=0), 0) + 1)])[bodies + 1]
    span = np.ptp(depth) if len(depth) else 0.0
    shade = 0.7 + 0.3 * (depth.max() - depth) / span if span > 0 else np.ones(len(depth))
    return {"c": colours * shade[:, None]}
