# SPDX-License-Identifier: BSD-3-Clause
"""The particles as a strip of times, a line an engine, on one scale of length and of colour, with gravity down.

The picture shows the scene: a stray particle does not stretch it, and what never moves is cut away where it would hide
what does. Thin scenes are seen along their thinnest axis, others from above in parallel projection. Where a body flies
far, its times stand in one picture, earlier ones paler. Points are a picture inside the SVG, text stays text."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.image import BboxImage
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.transforms import Affine2D, Bbox, IdentityTransform, TransformedBbox

from . import solids, style
from .curve import Drawing

MOST_LINES = 4
LEAVES = 0.3  # of the extent at the start, that a picture with walls reaches beyond it
CELLS = 110  # squares across a picture, of which each shows one particle
THIN = 0.12  # of the longest extent: below it the scene is seen along that axis
LONG = 0.35  # second extent of the first: below it a bar is seen from the side
FAR = 2.5  # extent of a flight over that of what flies: above it all times stand in one picture
MANY = 200  # particles from which on the picture need not hold all
SEEN = 60  # squares of the outline of what is solid: with fewer, cutting open shows nothing
HIDDEN = 0.4  # share of the solids' outline that is seen: below it the scene is cut open
STRAY = 2  # in a hundred that may lie outside on each side
DISC = (MarkerStyle("o").get_path().transformed(MarkerStyle("o").get_transform()),)
TURN, TILT = np.radians(-55.0), np.radians(24.0)
KINDS = (
    ("liquid", style.BLUE),
    ("liquid of another material", style.SKY),
    ("elastic", "#2bb58c"),
    ("rigid", "#e8803a"),
    ("at rest", style.GREY),
)


def draw(case, trajectories, notes):
    shown = [(curve, t) for curve, t in trajectories if t.position is not None and len(t.position) and t.strobe]
    if not shown:
        return None
    shown.sort(key=lambda entry: entry[0].engine.name == "exact")
    if len(shown) > MOST_LINES:
        notes.append(
            f"particles are drawn of {MOST_LINES} engines; not drawn: "
            + ", ".join(c.label for c, _ in shown[MOST_LINES:])
        )
        shown = shown[:MOST_LINES]
    first = shown[0][1]
    view, flat = projection(
        np.concatenate([finite(frame.position) for _, t in shown for frame in t.strobe]), upward(first.gravity)
    )
    warm, resting = warmth(shown), [still(t) for _, t in shown]
    low, high = extent(
        [view(frame.position) for _, t in shown for frame in t.strobe],
        spacing_of(shown),
        first.domain,
        view,
        any(rest.any() for rest in resting),
    )
    flight = warm is None and flies(first, view, resting[0])
    ratio = (high - low)[0] / (high - low)[1]
    times = 1 if flight or ratio > 6 else 3 if ratio > 2.5 else 5
    columns = min(len(shown), 4 if ratio < 1.2 else 2) if times == 1 and ratio < 6 else times
    strips = [
        (curve, t, rest, by_phase)
        for (curve, t), rest in zip(shown, resting)
        for by_phase in ((False, True) if warm and changes_phase(t) else (False,))
    ]
    both = len(strips) > len(shown)
    sheet = Sheet(
        -(-len(shown) // columns) if flight else len(strips),
        columns,
        low,
        high,
        (0.88 if both else 0.62) if warm else 0.42,
    )
    cut = -np.inf if flat else cut_through(first, resting[0], view, cell_of(shown[0][0], low, high))
    kinds, outside = set(), 0
    for line, (curve, t, rest, by_phase) in enumerate(strips):
        chosen = (
            t.strobe
            if flight
            else [t.strobe[k] for k in np.unique(np.linspace(0, len(t.strobe) - 1, times).round().astype(int))]
            if times > 1
            else t.strobe[-1:]
        )
        for k, frame in enumerate(chosen):
            place = line if flight else line * columns + k
            pale = 1.0 if not flight or k == len(chosen) - 1 else 0.12 + 0.35 * k / len(chosen)
            kinds |= panel(sheet, place, curve, t, frame, rest, view, cut, warm, flat, pale, by_phase)
            if line == 0 and not flight:
                sheet.write(
                    place,
                    0.0,
                    1.0,
                    f"t = {style.power(frame.time) if frame.time else 0} s",
                    (0, 3),
                    "bottom",
                    style.SOFT,
                )
        sheet.write(
            line if flight else line * columns,
            0.0,
            1.0,
            "by phase" if by_phase else curve.label,
            (3, -3),
            "top",
            style.look(curve)["color"],
            "bold",
        )
        outside = max(outside, beyond(view(chosen[-1].position), low, high))
    how = sheet.legend(warm, kinds)
    end = first.strobe[-1].time
    most = max(int(np.isfinite(t.position).all(axis=1).sum()) for _, t in shown)
    when = "" if times > 1 else f"at t = {end:.4g} s, "
    if flight:
        when = f"from 0 to {end:.4g} s in one picture, earlier times paler, "
    parts = [
        f"At the case's own resolution, {when}{how}{'; gravity points down' if first.pulled else ''}.",
        f"Up to {most} particles; of those behind one another the foremost is drawn"
        + (
            ", and of what never moves not the part in front."
            if not flat and any(rest.any() for rest in resting)
            else "."
        ),
    ]
    solid = warm is None and all(solids.usable(t) for _, t in shown)
    if solid:
        parts[1] = "Boxes and balls are drawn by their shapes."
    parts += ["Cut open through the middle of the solids, which liquid hides."] if np.isfinite(cut) else []
    parts += [f"{outside} particle{'s lie' if outside > 1 else ' lies'} outside of the picture."] if outside else []
    return Drawing(
        "particles",
        "Bodies in space" if solid else "Particles in time",
        f"Particles from the start to {end:.4g} s for {', '.join(c.label for c, _ in shown)}, {how}.",
        sheet.figure,
        " ".join(parts),
    )


def finite(position):
    return position[np.isfinite(position).all(axis=1)]


def spacing_of(shown):
    return max(curve.shown.knob("spacing") or 0.0 for curve, _ in shown)


def warmth(shown):
    """(low, high) of all engines and times, or None where no temperature differs."""
    columns = [
        values
        for _, t in shown
        for values in [t.temperature, *(frame.temperature for frame in t.strobe)]
        if values is not None
    ]
    values = np.concatenate([v[np.isfinite(v)] for v in columns]) if columns else np.empty(0)
    if not values.size or np.ptp(values) <= 1e-9 * max(1.0, abs(values).max()):
        return None
    return float(values.min()), float(values.max())


def changes_phase(trajectory):
    """Whether a particle has another phase in one frame than in another: then the picture of temperatures alone does
    not show what the case is about."""
    phases = [frame.phase for frame in trajectory.strobe if frame.phase is not None]
    return any(
        (after[there] != before[there]).any()
        for before, after in zip(phases, phases[1:])
        if len(before) == len(after)
        for there in [(before >= 0) & (after >= 0)]
    )


def still(trajectory):
    """Which particles are there in every frame and never move, where others do."""
    frames = np.array([frame.position for frame in trajectory.strobe])
    moved = np.abs(frames - frames[:1]).max(axis=(0, 2))  # NaN: not there all the time, so not at rest
    scale = np.nanmax(frames) - np.nanmin(frames) if np.isfinite(frames).any() else 0.0
    rest = moved < 1e-9 * scale
    return rest if len(frames) > 1 and not rest.all() else np.zeros(len(rest), bool)


def flies(trajectory, view, rest):
    """Whether solids cover a way much longer than they are themselves, and nothing else is in the scene."""
    frames = [view(finite(frame.position))[:, :2] for frame in trajectory.strobe]
    if (
        rest.any()
        or any(len(f) == 0 for f in frames)
        or any(frame.phase is not None and (frame.phase == 0).any() for frame in trajectory.strobe)
    ):
        return False
    own = max(np.ptp(f, axis=0).max() for f in frames)
    return np.ptp(np.concatenate(frames), axis=0).max() > FAR * max(own, 1e-300)


def upward(gravity):
    """The axis that gravity points along, z where there is none; and which way is up."""
    axis = int(np.argmax(np.abs(gravity))) if any(gravity) else 2
    return axis, -1.0 if gravity[axis] > 0 else 1.0


def projection(points, up):
    """A map from (n, 3) to (n, 3): two screen coordinates and depth; and whether the scene is seen along an axis."""
    axis, sign = up
    size = np.ptp(points, axis=0) if len(points) else np.ones(3)
    order = np.argsort(-size, kind="stable")
    thin = int(order[2])
    if thin != axis and (size[thin] <= THIN * max(size[order[0]], 1e-300) or size[order[1]] <= LONG * size[order[0]]):
        side = 3 - axis - thin
        if size[order[1]] <= LONG * size[order[0]] and order[0] != axis:
            side = int(order[0])  # a bar is seen from the side, whichever of its other axes is the thinner
        thin = 3 - axis - side
        scale = np.ones(3)
        scale[axis] = sign
        return (lambda p: (p * scale)[:, [side, axis, thin]]), True
    if size[thin] <= THIN * max(size[order[0]], 1e-300) and size[order[1]] <= LONG * size[order[0]]:
        side = int(order[0]) if order[0] != axis else int(order[1])
        return (lambda p: p[:, [side, axis, 3 - side - axis]] * [1, sign, 1]), True
    place = [(axis + 1) % 3, (axis + 2) % 3, axis]
    turn = np.array(
        [
            [np.cos(TURN), -np.sin(TURN), 0],
            [np.sin(TURN) * np.sin(TILT), np.cos(TURN) * np.sin(TILT), np.cos(TILT)],
            [np.sin(TURN) * np.cos(TILT), np.cos(TURN) * np.cos(TILT), -np.sin(TILT)],
        ]
    )
    return (lambda p: (p[:, place] * [1, 1, sign]) @ turn.T), False


def extent(projected, spacing, domain, view, walled):
    """The corners of the picture: of all times, without the few particles in a hundred that stray, and never beyond the
    domain, nor far from where a scene with walls began."""
    low, high = [], []
    for points in projected:
        sound = points[np.isfinite(points).all(axis=1), :2]
        if len(sound):
            core = (
                np.percentile(sound, (STRAY, 100 - STRAY), axis=0)
                if len(sound) >= MANY
                else np.array([sound.min(axis=0), sound.max(axis=0)])
            )
            reach = 0.25 * np.ptp(core, axis=0).max()
            low.append(np.maximum(sound.min(axis=0), core[0] - reach))
            high.append(np.minimum(sound.max(axis=0), core[1] + reach))
    if not low:
        return np.array([0.0, 0.0]), np.array([1.0, 1.0])
    start = low[0], high[0]
    low, high = np.min(low, axis=0), np.max(high, axis=0)
    if walled:
        reach = LEAVES * (start[1] - start[0]).max()
        low, high = np.maximum(low, start[0] - reach), np.minimum(high, start[1] + reach)
    if domain is not None and np.isfinite(domain).all():
        corners = view(
            np.array([[domain[i][0], domain[j][1], domain[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
        )[:, :2]
        low, high = np.maximum(low, corners.min(axis=0)), np.minimum(high, corners.max(axis=0))
    margin = max(0.04 * (high - low).max(), 0.7 * spacing, 1e-12)
    return low - margin, high + margin


def beyond(points, low, high):
    sound = points[np.isfinite(points).all(axis=1), :2]
    return int(((sound < low) | (sound > high)).any(axis=1).sum())


class Sheet:
    """Panels of one scale on one figure in inches, without axes: an axis each would cost ten times the drawing, and one
    for all half of it."""

    def __init__(self, lines, columns, low, high, below):
        self.low, self.high, self.columns, gap = low, high, columns, 0.1
        wide = (style.WIDTH - 0.1) / columns - gap
        self.scale = min(wide / (high - low)[0], (3.4 if columns < 4 else 2.4) / (high - low)[1])  # [inches/m]
        self.size = self.scale * (high - low)
        self.step = np.array(
            [wide + gap if self.size[0] > 0.7 * wide else max(self.size[0] + gap, 0.9), max(self.size[1], 0.25) + gap]
        )
        self.base, total = below, below + lines * self.step[1] + 0.25
        self.figure = Figure(figsize=(style.WIDTH, total))
        FigureCanvasAgg(self.figure)
        self.inches = Affine2D().scale(1 / style.WIDTH, 1 / total) + self.figure.transFigure
        self.lines = lines

    def origin(self, place):
        """The lower left corner of a panel."""
        return np.array(
            [
                0.1 + (place % self.columns) * self.step[0],
                self.base + (self.lines - 1 - place // self.columns) * self.step[1],
            ]
        )

    def draw(self, place, seen, area, pale, colours):
        at = self.origin(place) + (seen[:, :2] - self.low) * self.scale
        discs = PathCollection(
            DISC,
            [area],
            offsets=at,
            offset_transform=self.inches,
            facecolors=colours,
            edgecolors="none",
            linewidths=0,
            alpha=pale,
            rasterized=True,
        )
        discs.set_transform(IdentityTransform())
        self.figure.add_artist(discs)
        corner, (wide, tall) = self.origin(place), self.size
        self.line(
            corner[0] + np.array([0, wide, wide, 0, 0]),
            corner[1] + np.array([0, 0, tall, tall, 0]),
            color=style.GRID,
            linewidth=0.8,
            zorder=0,
        )

    def line(self, x, y, **look):
        self.figure.add_artist(Line2D(x, y, transform=self.inches, **look))

    def words(self, x, y, words, hue=style.INK, **look):
        """@param x, y: inches"""
        self.figure.text(x, y, words, transform=self.inches, color=hue, zorder=3, **look)

    def write(self, place, x, y, words, offset, align, hue, weight="normal"):
        """@param x, y: shares of a panel   @param offset: points"""
        self.words(
            *(self.origin(place) + np.array([x, y]) * self.size + np.array(offset) / 72),
            words,
            hue,
            va=align,
            fontsize=8.5,
            fontweight=weight,
            bbox={"facecolor": style.PAPER, "edgecolor": "none", "alpha": 0.75, "pad": 1.0} if align == "top" else None,
        )

    def legend(self, warm, kinds):
        """A bar of a round length, and what the colours are. @return the same in words"""
        length = round_below(0.4 * self.size[0] / self.scale)
        self.line([0.1, 0.1 + length * self.scale], [0.24, 0.24], color=style.INK, linewidth=2.2, solid_capstyle="butt")
        self.words(0.1, 0.08, f"{1000 * length:.4g} mm" if length < 0.1 else f"{length:.4g} m", fontsize=8)
        if warm is not None:
            bar = BboxImage(TransformedBbox(Bbox.from_extents(3.2, 0.3, 6.0, 0.4), self.inches), cmap=style.TEMPERATURE)
            bar.set_data(np.linspace(0, 1, 128)[None, :])
            self.figure.add_artist(bar)
            for share in (0.0, 0.5, 1.0):
                self.words(
                    3.2 + 2.8 * share,
                    0.13,
                    f"{warm[0] + share * (warm[1] - warm[0]):.4g}{' K' if share == 1 else ''}",
                    ha="center",
                    fontsize=8,
                )
            if not kinds:
                return "coloured by temperature on one scale"
        names = [KINDS[k] for k in sorted(kinds)]
        height = 0.18 if warm is None else 0.58
        widths = [0.35 + 0.062 * len(name) if len(names) > 3 else 1.9 for name, _ in names]
        at = min(3.2, style.WIDTH - 0.1 - sum(widths))
        for (name, hue), wide in zip(names, widths):
            self.line([at], [height], marker="o", linestyle="none", color=hue, markersize=5)
            self.words(at + 0.1, height, name, va="center", fontsize=8)
            at += wide
        if warm is not None:
            return "coloured by temperature on one scale, and below it by phase"
        return "coloured by phase" if kinds else "coloured by body"


def round_below(length):
    """1, 2 or 5 times a power of ten."""
    if not length > 0:
        return 1.0
    ten = 10.0 ** np.floor(np.log10(length))
    return next(n * ten for n in (5, 2, 1) if n * ten <= length * (1 + 1e-9))


def cell_of(curve, low, high):
    """Side of a square of the screen that shows one particle [m]."""
    return max(0.55 * (curve.shown.knob("spacing") or 0.0), (high - low).max() / CELLS)


def cut_through(trajectory, rest, view, cell):
    """Depth of the plane through the middle of what is solid and free, where liquid hides it at the first time that has
    both; else -inf: no cut."""
    for frame in trajectory.strobe:
        solid = (frame.phase > 0) & ~rest if frame.phase is not None else np.zeros(len(rest), bool)
        if not solid.any() or not (frame.phase == 0).any():
            continue
        seen = view(frame.position)
        there = np.flatnonzero(np.isfinite(seen).all(axis=1) & ~rest)
        among_all = solid[there[in_front(seen[there], np.zeros(len(there), bool), cell)]].sum()
        alone = np.flatnonzero(solid & np.isfinite(seen).all(axis=1))
        outline = len(in_front(seen[alone], np.zeros(len(alone), bool), cell))
        return seen[alone, 2].mean() if outline >= SEEN and among_all < HIDDEN * outline else -np.inf
    return -np.inf


def panel(sheet, place, curve, trajectory, frame, rest, view, cut, warm, flat, pale, by_phase):
    """Draws one time of one engine. @param cut depth before which nothing is drawn   @param by_phase coloured by phase,
    whatever the temperatures   @return kinds that it shows"""
    if warm is None and solids.usable(trajectory):
        solids.draw(sheet, place, trajectory, frame, view, pale)
        return set()
    seen = view(frame.position)
    here = (
        np.isfinite(seen).all(axis=1)
        & (seen[:, :2] > sheet.low).all(axis=1)
        & (seen[:, :2] < sheet.high).all(axis=1)
        & (seen[:, 2] >= cut)
    )
    if not flat and rest.any() and (here & ~rest).any():
        depth, floor = seen[here & ~rest, 2].mean(), seen[here & ~rest, 1].min()
        here &= ~(rest & (seen[:, 2] < depth) & (seen[:, 1] > floor))
    chosen = np.flatnonzero(here)
    front = in_front(
        seen[chosen], rest[chosen] if flat else np.zeros(len(chosen), bool), cell_of(curve, sheet.low, sheet.high)
    )
    chosen = chosen[front]
    chosen = chosen[np.argsort(-seen[chosen, 2], kind="stable")]
    colours, kinds = hues(trajectory, frame, rest, chosen, seen[chosen, 2], warm, by_phase)
    sheet.draw(place, seen[chosen], marker_area(sheet, curve, len(chosen)), pale, colours)
    lost = int((~np.isfinite(frame.position).all(axis=1)).sum())
    if lost and frame is trajectory.strobe[-1] and np.isfinite(trajectory.strobe[0].position).all():
        sheet.write(place, 0.0, 0.0, f"{lost} particles not finite", (3, 3), "bottom", style.RED)
    return kinds


def in_front(seen, rest, cell):
    """Rows of the particle that is nearest to the viewer in each square of the screen, one that moves before one that
    rests; what lies behind is hidden anyway."""
    place = np.floor(seen[:, :2] / cell)
    order = np.lexsort((seen[:, 2], rest, place[:, 1], place[:, 0]))
    place = place[order]
    first = np.ones(len(order), bool)
    first[1:] = (place[1:] != place[:-1]).any(axis=1)
    return order[first]


def marker_area(sheet, curve, count):
    """[points^2]: a disc of a spacing and a quarter, or such that the points cover the panel where no spacing is
    stated."""
    spacing = curve.shown.knob("spacing")
    if spacing and spacing > 0:
        return float(
            np.clip((1.25 * spacing * sheet.scale * 72) ** 2, (1.6 * sheet.size.max() * 72 / CELLS) ** 2, 150.0)
        )
    return float(np.clip(0.7 * sheet.size[0] * sheet.size[1] * 72**2 / max(count, 1), 2.5, 60.0))


def kinds_of(trajectory, frame, rest):
    """An index of KINDS for each particle; None where the run states no phase."""
    if frame.phase is None:
        return None
    kind = np.where(frame.phase == 0, 0, np.where(frame.phase == 1, 2, 3))
    if frame.material is not None and (frame.phase == 0).any():
        kind[(frame.phase == 0) & (frame.material != frame.material[frame.phase == 0].min())] = 1
    kind[rest] = 4
    return kind


def hues(trajectory, frame, rest, chosen, depth, warm, by_phase):
    """(colours, indices of KINDS that are shown): by temperature, by phase, or by body where all are solids of one
    phase."""
    if warm is not None and frame.temperature is not None and not by_phase:
        return style.TEMPERATURE((frame.temperature[chosen] - warm[0]) / (warm[1] - warm[0])), set()
    span = np.ptp(depth) if len(depth) else 0.0
    shade = 0.7 + 0.3 * (depth.max() - depth) / span if span > 0 else np.ones(len(depth))
    kind = kinds_of(trajectory, frame, rest)
    if kind is not None and (by_phase or (kind < 3).any()):
        table = np.array([matplotlib.colors.to_rgb(hue) for _, hue in KINDS])
        return table[kind[chosen]] * shade[:, None], set(kind[chosen].tolist())
    bodies = trajectory.body[chosen].astype(int) if trajectory.body is not None else np.zeros(len(chosen), int)
    colours = np.array(
        [
            matplotlib.colors.to_rgb(style.BODIES[b % len(style.BODIES)] if b >= 0 else style.GREY)
            for b in range(-1, max(bodies.max(initial=0), 0) + 1)
        ]
    )[bodies + 1]
    colours[rest[chosen]] = matplotlib.colors.to_rgb(style.GREY)
    return colours * shade[:, None], set()
