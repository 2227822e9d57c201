# SPDX-License-Identifier: BSD-3-Clause
"""Paths, attitude and energies of solid bodies in time, engine over engine."""

from __future__ import annotations

import numpy as np

from headline_pictures import smooth

from . import plot, style
from .curve import Drawing

MOST_BODIES = 4
STORED = (
    "potential",
    "compression",
    "elastic",
    "hourglass",
)  # energies that motion is exchanged with and comes back from
CENTRE = "of the centre [m]"
TURN, ENERGY = "turn from the start [deg]", "energy change / kinetic"  # of panels


def draw(case, trajectories, notes):
    shown = [(curve, t) for curve, t in trajectories if t.bodies]
    wanted = panels_of(shown, trajectories, notes) if shown else []
    if not wanted:
        return None
    say_how_many(shown, notes)
    truth = next((curve for curve, _ in shown if curve.engine.name == "exact"), None)
    left = [residual(title, lines, truth) for title, lines in wanted]
    order = who_leads(wanted[0][0], left[0]) if wanted[0][0].endswith(CENTRE) else ""
    columns = min(len(wanted), 2)
    ordered = in_rows(wanted, left, columns)
    figure, axes = plot.panels(len(ordered), len(shown), height=2.3, columns=columns)
    for axis, panel in zip(axes, ordered):
        draw_panel(axis, panel, shown)
    energy_alone = len(wanted) == 1 and wanted[0][0] == ENERGY
    title = "Energy in time" if energy_alone else "Bodies in time"
    what = "Energy" if energy_alone else "Position, rotation and energy of the bodies"
    return Drawing(
        "bodies",
        title,
        f"{what} against time for " + ", ".join(c.label for c, _ in shown) + ".",
        figure,
        caption(wanted, any(left)) + order,
    )


def panels_of(shown, trajectories, notes):
    panels = (position_panel(shown), turn_panel(shown), spin_panel(shown), energy_panel(trajectories, notes))
    return [panel for panel in panels if panel]


def say_how_many(shown, notes):
    most = max((t.bodies["position"].shape[1] for _, t in shown if "position" in t.bodies), default=1)
    if most > MOST_BODIES:
        notes.append(f"curves show the first {MOST_BODIES} of {most} bodies")


def in_rows(wanted, left, columns):
    """The panels row by row, below each row its residuals, where it has any; None is an empty place."""
    ordered = []
    for n in range(0, len(wanted), columns):
        for row in (wanted[n : n + columns], left[n : n + columns]):
            ordered += row + [None] * (columns - len(row)) if any(row) else []
    return ordered


def draw_panel(axis, panel, shown):
    if panel is None:
        axis.set_visible(False)
        return
    title, lines = panel
    for line in lines:
        draw_line(axis, title, line, shown)
    axis.set_xlabel("time [s]")
    axis.set_ylabel(title)


def draw_line(axis, title, line, shown):
    curve, time, values, nth = line
    look, exact, first = style.look(curve), curve.engine.name == "exact", nth == 0
    fine = between(title, next((t for c, t in shown if c is curve), None), nth, time, values)
    intervals = max(1, len(time) - 1)
    parts = max(1, (len(fine[0]) - 1) // intervals)  # of an interval between frames, on which the markers stand
    axis.plot(
        *fine,
        color=look["color"],
        linestyle=look["linestyle"] if first else (0, (1 + nth, 1.5)),
        linewidth=2.6 if exact else 1.3,
        alpha=0.6 if exact else 1.0,
        label=curve.label if first else None,
        marker=look["marker"] if first and not exact else None,
        markersize=3.2,
        markevery=(parts * offset(curve, shown), parts * max(1, len(time) // 8)),
    )


def between(title, trajectory, nth, time, values):
    """The curve of a body between its frames, by the velocities that the engine wrote there; as it is where it wrote
    none."""
    known = trajectory.bodies if trajectory is not None else {}
    if title.endswith(CENTRE) and "velocity" in known:
        return smooth(time, values, known["velocity"][:, nth, "xyz".index(title[0])])
    if title == TURN and "angular_velocity" in known:
        return turn_between(time, known["orientation"][:, nth], known["angular_velocity"][:, nth])
    return time, values


def turn_between(time, q, omega):
    """Degrees of turn: the quaternion by cubics with its rate omega q/2, on the shorter way from frame to frame."""
    turned = np.cumprod(np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0))
    q = q * np.concatenate([[1.0], turned])[:, None]
    w, v = q[:, :1], q[:, 1:]
    rate = 0.5 * np.concatenate([-np.sum(omega * v, axis=1, keepdims=True), w * omega + np.cross(omega, v)], axis=1)
    fine = [smooth(time, q[:, k], rate[:, k]) for k in range(4)]
    parts = np.stack([values for _, values in fine], axis=1)
    return fine[0][0], np.degrees(2 * np.arctan2(np.linalg.norm(parts[:, 1:], axis=1), np.abs(parts[:, 0])))


def caption(wanted, residuals):
    """Sentences on what is drawn, and on nothing else."""
    said = "Each engine at the case's own resolution" + (
        "; below a curve, what is left between engine and exact." if residuals else "."
    )
    if any(title == TURN for title, _ in wanted):
        said += (
            " Turn from the start is the angle of the rotation that leads from the first attitude to the present "
            "one; between frames by the angular velocities that the engine wrote."
        )
    if any(title == ENERGY for title, _ in wanted):
        said += (
            " Energy change: of the kinetic and the stored energy since the start, as a part of the run's "
            "greatest kinetic energy."
        )
    if any(nth > 0 for _, lines in wanted for *_, nth in lines):
        said += " Solid: the first body; dashes: further ones."
    return said


def who_leads(title, left):
    """A sentence: by how much each engine's first body lags or leads the exact one at the end, in the direction of the
    panel's axis."""
    ends = ends_of(left[1] if left else [])
    none = 1e-3 * max(map(abs, ends.values()), default=0.0)
    parts = [
        f"{label} {'lags' if value < 0 else 'leads'} by {abs(value):.4g} m"
        for label, value in sorted(ends.items(), key=lambda entry: entry[1])
        if abs(value) > none
    ]
    if not parts:
        return ""
    level = {label: abs(value) for label, value in ends.items() if abs(value) <= none}
    rest = f"; within {float(f'{max(level.values()):.1g}') or 0:g} m of exact: {', '.join(level)}" if level else ""
    return (
        f" At the end, in {title[0]} against exact: {', '.join(parts)}{rest}. To lag is to have less of {title[0]} "
        "than exact, to lead more."
    )


def ends_of(lines):
    """{label: last value} of the first bodies"""
    ends = {curve.label: values[-1] for curve, _, values, nth in lines if nth == 0 and len(values)}
    return {label: value for label, value in ends.items() if np.isfinite(value)}


def residual(title, lines, truth):
    """What is left between each engine and the exact one, body by body, at the times that both wrote; None where there
    is no exact curve."""
    exact = {nth: (time, values) for curve, time, values, nth in lines if curve is truth}
    found = [
        (curve, time, values - exact[nth][1], nth)
        for curve, time, values, nth in lines
        if curve is not truth
        and nth in exact
        and len(time) == len(exact[nth][0])
        and np.allclose(time, exact[nth][0], rtol=0.0, atol=1e-9 * max(float(np.max(np.abs(time))), 1e-300))
    ]
    return (
        (f"engine minus exact [{title.rsplit('[', 1)[1]}" if "[" in title else "engine minus exact", found)
        if truth is not None and found
        else None
    )


def offset(curve, shown):
    """Markers of engines that lie on one another are set apart in time."""
    return [c for c, _ in shown].index(curve) if curve in [c for c, _ in shown] else 0


def busiest(shown, name):
    """The component in which engines differ most at the end, else the one that changes most; None where nothing
    changes."""
    ends = [
        t.bodies[name][-1]
        for _, t in shown
        if name in t.bodies and t.bodies[name].shape[1:] == shown[0][1].bodies.get(name, t.bodies[name]).shape[1:]
    ]
    apart = np.ptp(ends, axis=0) if len(ends) > 1 else np.zeros((1, 3))
    if np.isfinite(apart).any() and np.nanmax(apart) > 1e-9 * max(1.0, np.nanmax(np.abs(ends))):
        return int(np.nanargmax(np.nanmax(apart, axis=0)))
    spans = [
        np.nanmax(np.nanmax(v, axis=0) - np.nanmin(v, axis=0), axis=0)
        for _, t in shown
        if (v := t.bodies.get(name)) is not None and np.isfinite(v).any()
    ]
    if not spans:
        return None
    span = np.nanmax(spans, axis=0)
    return int(np.nanargmax(span)) if np.nanmax(span) > 1e-12 else None


def component(shown, name):
    chosen = busiest(shown, name)
    if chosen is None:
        return None, []
    return chosen, [
        (curve, t.body_times, t.bodies[name][:, b, chosen], b)
        for curve, t in shown
        if name in t.bodies
        for b in range(min(MOST_BODIES, t.bodies[name].shape[1]))
    ]


def position_panel(shown):
    chosen, lines = component(shown, "position")
    return (f"{'xyz'[chosen]} {CENTRE}", lines) if lines else None


def spin_panel(shown):
    chosen, lines = component(shown, "angular_velocity")
    return (f"angular velocity {'xyz'[chosen]} [rad/s]", lines) if lines else None


def turn_panel(shown):
    lines = []
    for curve, t in shown:
        q = t.bodies.get("orientation")
        for b in range(min(MOST_BODIES, q.shape[1]) if q is not None else 0):
            angle = 2 * np.arctan2(np.linalg.norm(q[:, b, 1:], axis=1), np.abs(q[:, b, 0]))
            if np.isfinite(angle).any() and np.nanmax(angle) > 1e-9:
                lines.append((curve, t.body_times, np.degrees(angle), b))
    return (TURN, lines) if lines else None


def energy_panel(trajectories, notes):
    """Change of mechanical energy since the first frame. A run that does not state every term that takes part has no
    curve: its sum would only seem to change."""
    lines = []
    stating = [(curve, t) for curve, t in trajectories if "kinetic" in t.observables]
    needed = ["kinetic"] + [name for name in STORED if any(takes_part(t, name) for _, t in stating)]
    for curve, t in stating:
        lacking = [
            name for name in needed if len(t.observables.get(name, ((), ()))[1]) != len(t.observables["kinetic"][1])
        ]
        if lacking:
            notes.append(
                f"{curve.label}: no curve of its energy, as it does not state its {' and '.join(lacking)} energy"
            )
            continue
        times, kinetic = t.observables["kinetic"]
        total = sum(t.observables[name][1] for name in needed)
        scale = np.nanmax(np.abs(kinetic)) if np.isfinite(kinetic).any() else 0.0
        if scale > 0:
            lines.append((curve, times, (total - total[0]) / scale, 0))
    return (ENERGY, lines) if lines else None


def takes_part(trajectory, name):
    """Whether this energy changes by more than round-off in the run; potential energy does wherever gravity pulls,
    stated or not."""
    if name == "potential" and trajectory.pulled:
        return True
    kinetic, values = trajectory.observables["kinetic"][1], trajectory.observables.get(name, (None, np.zeros(1)))[1]
    return np.isfinite(values).any() and np.nanmax(values) - np.nanmin(values) > 1e-12 * np.nanmax(
        np.abs(kinetic), initial=0.0
    )
