# SPDX-License-Identifier: BSD-3-Clause
"""Small pictures of one run, as SVG: poses of boxes, a curve over the truth, particles, a profile."""

from __future__ import annotations

import numpy as np

from headline_pictures import smooth
from headlines import tip

WIDE, HIGH, EDGE = 120.0, 66.0, 3.0
MOST_DOTS = 420  # of one picture
ENLARGED = 10.0  # times that a small displacement is drawn larger


def svg(body, words):
    return f'<svg class="thumb" viewBox="0 0 {WIDE:g} {HIGH:g}" role="img" aria-label="{words}">{body}</svg>'


def path(points, kind, closed=False):
    steps = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path class="{kind}" d="M{steps}{"Z" if closed else ""}"/>'


class Frame:
    """Maps data to the picture; lengths keep their proportion where both axes are lengths."""

    def __init__(self, points, equal):
        sound = points[np.isfinite(points).all(axis=1)]
        low, high = (sound.min(axis=0), sound.max(axis=0)) if len(sound) else (np.zeros(2), np.ones(2))
        span = np.maximum(high - low, 1e-9 * max(1.0, float(np.abs(sound).max(initial=0.0))))
        room = np.array([WIDE - 2 * EDGE, HIGH - 2 * EDGE])
        self.scale = np.full(2, (room / span).min()) if equal else room / span
        self.low, self.spare = low, (room - self.scale * (high - low)) / 2

    def __call__(self, points):
        placed = (np.asarray(points) - self.low) * self.scale + self.spare + EDGE
        return np.stack([placed[:, 0], HIGH - placed[:, 1]], axis=1)


def outline(points):
    """The convex hull, anticlockwise, by Andrew's chain."""
    ordered = sorted(map(tuple, points))

    def half(sequence):
        chain = []
        for p in sequence:
            while len(chain) > 1 and (chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1]) <= (
                chain[-1][1] - chain[-2][1]
            ) * (p[0] - chain[-2][0]):
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


def silhouette(shape, bodies, frame):
    """The outline of a body seen along y; of a ball 24 points of its rim."""
    points = shape.points(bodies["position"][frame, shape.row], bodies["orientation"][frame, shape.row])
    if shape.corners is not None:
        return outline(points[:, [0, 2]])
    angle = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
    return points[0, [0, 2]] + shape.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def boxes(trajectory, truth):
    """The bodies at the end over their outlines at the start. @return None where the run has no shapes"""
    bodies, free = trajectory.bodies, [s for s in trajectory.shapes if not s.fixed]
    if not free or not {"position", "orientation"} <= bodies.keys():
        return None
    first, last = ([silhouette(s, bodies, frame) for s in free] for frame in (0, -1))
    whole = np.concatenate(first + last)
    floor = np.array([[whole[:, 0].min(), 0.0], [whole[:, 0].max(), 0.0]])
    place = Frame(np.concatenate([whole, floor]), equal=True)
    drawn = [path(place(form), "truth", closed=True) for form in first] + [
        path(place(form), "solid", closed=True) for form in last
    ]
    base = float(place(floor)[0, 1])
    return path([(EDGE, base), (WIDE - EDGE, base)], "ground") + "".join(drawn)


def over(curve):
    """A picture of a curve in time over the truth's. @param curve trajectory -> (times, values, rates or None), or
    None
    """

    def draw(trajectory, truth):
        own, other = curve(trajectory), curve(truth) if truth is not None else None
        if own is None:
            return None
        lines = [("truth", np.stack(smooth(*other), axis=1))] if other is not None else []
        lines.append(("own", np.stack(smooth(*own), axis=1)))
        place = Frame(np.concatenate([points for _, points in lines]), equal=False)
        return "".join(
            path(place(points[np.isfinite(points).all(axis=1)]), kind)
            for kind, points in lines
            if np.isfinite(points).any()
        )

    return draw


def way(trajectory):
    """(times, the first free body's farthest-moving coordinate, its velocity)."""
    bodies = trajectory.bodies
    if "position" not in bodies:
        return None
    free = next((s.row for s in trajectory.shapes if not s.fixed), 0)
    axis = int(np.nanargmax(np.ptp(bodies["position"][:, free], axis=0)))
    rates = bodies["velocity"][:, free, axis] if "velocity" in bodies else None
    return trajectory.body_times, bodies["position"][:, free, axis], rates


def height(trajectory):
    """(times, height of the first free body, no rate): a hit has none."""
    if "position" not in trajectory.bodies:
        return None
    free = next((s.row for s in trajectory.shapes if not s.fixed), 0)
    return trajectory.body_times, trajectory.bodies["position"][:, free, 2], None


def spin(trajectory):
    return tip(trajectory) if "orientation" in trajectory.bodies else None


def thinned(count):
    return np.arange(0, count, max(1, -(-count // MOST_DOTS)))


def apart(points, cell=1.2):
    """Rows of points of the picture, one in each square of this side; of more than MOST_DOTS squares coarser ones."""
    while True:
        _, rows = np.unique(np.floor(points / cell), axis=0, return_index=True)
        if len(rows) <= MOST_DOTS:
            return np.sort(rows)
        cell *= 1.1


def dots(enlarged=1.0):
    """Particles at the end, seen along y where gravity is along z. @param enlarged displacements are drawn so many
    times larger
    """

    def draw(trajectory, truth):
        if not trajectory.strobe:
            return None
        start = trajectory.strobe[0].position
        frame = (
            max(trajectory.strobe, key=lambda f: np.nanmax(np.abs(f.position - start), initial=0.0))
            if enlarged > 1
            else trajectory.strobe[-1]
        )
        up = int(np.argmax(np.abs(trajectory.gravity))) if trajectory.pulled else 2
        here = (start + enlarged * (frame.position - start))[:, [0 if up else 1, up]]
        sound = np.isfinite(here).all(axis=1)
        phase = frame.phase[sound] if frame.phase is not None else np.zeros(int(sound.sum()))
        seen = Frame(here[sound], equal=True)(here[sound])
        rows = apart(seen)
        return "".join(cloud(seen[rows[phase[rows] == k]], kind) for k, kind in ((0, "wet"), (1, "soft"), (2, "hard")))

    return draw


def cloud(points, kind):
    """Dots as one path of short strokes with round ends."""
    return f'<path class="{kind}" d="{"".join(f"M{x:.1f} {y:.1f}h0" for x, y in points)}"/>' if len(points) else ""


def profile(trajectory, truth):
    """Temperature along the axis on which it changes most, at the end, over the truth's."""
    own, along = warm(trajectory, None)
    if own is None:
        return None
    other = warm(truth, along)[0] if truth is not None else None
    place = Frame(np.concatenate([own] + ([other] if other is not None else [])), equal=False)
    back = path(place(other), "truth") if other is not None else ""
    return back + cloud(place(own[thinned(len(own))]), "warm")


def warm(trajectory, along):
    """((n, 2) of place and temperature in the order of places, axis), or (None, axis)."""
    frame = trajectory.strobe[-1] if trajectory.strobe else None
    if frame is None or frame.temperature is None:
        return None, along
    sound = np.isfinite(frame.position).all(axis=1) & np.isfinite(frame.temperature)
    here, values = frame.position[sound], frame.temperature[sound]
    if not len(values):
        return None, along
    axis = int(np.argmax(np.ptp(here, axis=0))) if along is None else along
    order = np.argsort(here[:, axis], kind="stable")
    return np.stack([here[order, axis], values[order]], axis=1), axis


def fell(trajectory):
    """How many free boxes or balls end lower than they began by more than half of their height, of all free ones."""
    free = [s for s in trajectory.shapes if not s.fixed]
    if not free or "position" not in trajectory.bodies:
        return 0, len(free)
    drop = [trajectory.bodies["position"][0, s.row, 2] - trajectory.bodies["position"][-1, s.row, 2] for s in free]
    tall = [np.ptp(s.corners[:, 2]) if s.corners is not None else 2 * s.radius for s in free]
    return sum(bool(d > 0.5 * h) for d, h in zip(drop, tall, strict=True)), len(free)
