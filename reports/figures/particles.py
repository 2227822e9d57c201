# SPDX-License-Identifier: BSD-3-Clause
"""The particles as a strip of times, a line an engine, on one scale of length and of colour, with gravity down.

The picture shows the scene: a stray particle does not stretch it, and what never moves is cut away where it would hide
what does. Thin scenes are seen along their thinnest axis, others from above in parallel projection. Where a body flies
far, its times stand in one picture, earlier ones paler. Points are a picture inside the SVG, text stays text."""

from __future__ import annotations

import matplotlib
import numpy as np

from . import solids, style
from .curve import Drawing
from .sheet import KINDS, Sheet

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
TURN, TILT = np.radians(-55.0), np.radians(24.0)


def draw(case, trajectories, notes):
    shown = shown_of(trajectories, notes)
    if not shown:
        return None
    scene = Scene(shown)
    sheet = Sheet(scene.lines, scene.columns, scene.low, scene.high, scene.below)
    kinds = set().union(*(draw_strip(sheet, scene, line) for line in range(len(scene.strips))))
    how = sheet.legend(scene.warm, kinds)
    return Drawing(
        "particles",
        "Bodies in space" if scene.solid else "Particles in time",
        f"Particles from the start to {scene.end:.4g} s for {', '.join(c.label for c, _ in shown)}, {how}.",
        sheet.figure,
        caption(scene, how),
    )


def shown_of(trajectories, notes):
    """The curves and trajectories that have particles, at most MOST_LINES of them, the exact one last."""
    shown = [(curve, t) for curve, t in trajectories if t.position is not None and len(t.position) and t.strobe]
    shown.sort(key=lambda entry: entry[0].engine.name == "exact")
    if len(shown) > MOST_LINES:
        rest = ", ".join(curve.label for curve, _ in shown[MOST_LINES:])
        notes.append(f"particles are drawn of {MOST_LINES} engines; not drawn: {rest}")
    return shown[:MOST_LINES]


class Scene:
    """How the particles are looked at, the same for all engines and times."""

    def __init__(self, shown):
        self.shown, (curve, self.first) = shown, shown[0]
        frames = [frame.position for _, t in shown for frame in t.strobe]
        self.view, self.flat = projection(np.concatenate([finite(f) for f in frames]), upward(self.first.gravity))
        self.warm, self.resting = warmth(shown), [still(t) for _, t in shown]
        self.walled = any(rest.any() for rest in self.resting)
        projected = [self.view(f) for f in frames]
        self.low, self.high = extent(projected, spacing_of(shown), self.first.domain, self.view, self.walled)
        self.solid = self.warm is None and all(solids.usable(t) for _, t in shown)
        self.end = self.first.strobe[-1].time
        self.lay_out()
        cell = cell_of(curve, self.low, self.high)
        self.cut = -np.inf if self.flat else cut_through(self.first, self.resting[0], self.view, cell)

    def lay_out(self):
        """Strips of times: one an engine, and one more by phase where a warm engine changes phase."""
        self.flight = self.warm is None and flies(self.first, self.view, self.resting[0])
        ratio = (self.high - self.low)[0] / (self.high - self.low)[1]
        self.times = 1 if self.flight or ratio > 6 else 3 if ratio > 2.5 else 5
        alone = self.times == 1 and ratio < 6
        self.columns = min(len(self.shown), 4 if ratio < 1.2 else 2) if alone else self.times
        self.strips = [
            (curve, t, rest, by_phase)
            for (curve, t), rest in zip(self.shown, self.resting)
            for by_phase in ((False, True) if self.warm and changes_phase(t) else (False,))
        ]
        self.lines = -(-len(self.shown) // self.columns) if self.flight else len(self.strips)
        both = len(self.strips) > len(self.shown)
        self.below = (0.88 if both else 0.62) if self.warm else 0.42

    def chosen(self, trajectory):
        """The frames of a strip."""
        strobe = trajectory.strobe
        if self.flight or self.times == 1:
            return strobe if self.flight else strobe[-1:]
        return [strobe[k] for k in np.unique(np.linspace(0, len(strobe) - 1, self.times).round().astype(int))]

    def place(self, line, k=0):
        """The panel of the k-th frame of a strip."""
        return line if self.flight else line * self.columns + k

    def paleness(self, k, count):
        return 1.0 if not self.flight or k == count - 1 else 0.12 + 0.35 * k / count


def draw_strip(sheet, scene, line):
    """@return kinds that it shows"""
    curve, t, rest, by_phase = scene.strips[line]
    frames, kinds = scene.chosen(t), set()
    for k, frame in enumerate(frames):
        place, pale = scene.place(line, k), scene.paleness(k, len(frames))
        kinds |= panel(
            sheet, place, curve, t, frame, rest, scene.view, scene.cut, scene.warm, scene.flat, pale, by_phase
        )
        if line == 0 and not scene.flight:
            time = f"t = {style.power(frame.time) if frame.time else 0} s"
            sheet.write(place, 0.0, 1.0, time, (0, 3), "bottom", style.SOFT)
    words, hue = "by phase" if by_phase else curve.label, style.look(curve)["color"]
    sheet.write(scene.place(line), 0.0, 1.0, words, (3, -3), "top", hue, "bold")
    return kinds


def caption(scene, how):
    when = "" if scene.times > 1 else f"at t = {scene.end:.4g} s, "
    if scene.flight:
        when = f"from 0 to {scene.end:.4g} s in one picture, earlier times paler, "
    down = "; gravity points down" if scene.first.pulled else ""
    parts = [f"At the case's own resolution, {when}{how}{down}.", what_is_drawn(scene)]
    if np.isfinite(scene.cut):
        parts.append("Cut open through the middle of the solids, which liquid hides.")
    outside = max(
        beyond(scene.view(scene.chosen(t)[-1].position), scene.low, scene.high) for _, t, _, _ in scene.strips
    )
    if outside:
        parts.append(f"{outside} particle{'s lie' if outside > 1 else ' lies'} outside of the picture.")
    return " ".join(parts)


def what_is_drawn(scene):
    if scene.solid:
        return "Boxes and balls are drawn by their shapes."
    most = max(int(np.isfinite(t.position).all(axis=1).sum()) for _, t in scene.shown)
    walls = ", and of what never moves not the part in front" if not scene.flat and scene.walled else ""
    return f"Up to {most} particles; of those behind one another the foremost is drawn{walls}."


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
