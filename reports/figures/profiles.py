# SPDX-License-Identifier: BSD-3-Clause
"""Temperature along the longest axis at the end, engine against exact solution, and what is left between them."""

from __future__ import annotations

import numpy as np

from . import plot, style
from .curve import Drawing
from .particles import warmth

NOTHING = 1e-6  # share of the span of temperatures
CAPTION = (
    "Mean over the particles at each place along the axis at the final time, at the case's own resolution. Bars: "
    "two standard errors where the engine states them."
)
SCATTERED = " Points without a line: temperature is no function of this place alone."


def draw(case, trajectories, notes):
    shown = [(curve, t) for curve, t in trajectories if has_temperatures(t)]
    if not shown or warmth(shown) is None:
        return None
    along = longest_axis(shown[0][1].position)
    if flat(shown, along):
        return None
    exact = next((t for curve, t in shown if curve.engine.name == "exact"), None)
    figure, axes = plot.panels(2 if exact and len(shown) > 1 else 1, len(shown))
    truth = binned(exact, along) if exact else None
    scattered = [draw_curve(axes, curve, binned(t, along), truth, notes) for curve, t in shown]
    name_axes(axes, "xyz"[along])
    labels = ", ".join(c.label for c, _ in shown)
    return Drawing(
        "profile",
        "Temperature profile",
        f"Temperature along {'xyz'[along]} for {labels}{', and difference from the exact profile.' if exact else '.'}",
        figure,
        CAPTION + (SCATTERED if any(scattered) else ""),
    )


def has_temperatures(trajectory):
    return trajectory.position is not None and trajectory.temperature is not None


def longest_axis(position):
    return int(np.argmax(np.ptp(position[np.isfinite(position).all(axis=1)], axis=0)))


def draw_curve(axes, curve, profile, truth, notes):
    """@return whether its points stand without a line"""
    x, value, error = profile
    look = style.look(curve)
    if curve.engine.name == "exact":
        axes[0].plot(x, value, color=style.INK, linewidth=2.2, alpha=0.75, label=curve.label, zorder=1)
        return False
    every = max(1, len(x) // 40)
    lines = {
        "label": curve.label,
        "color": look["color"],
        "linestyle": "none" if wavers(value) else look["linestyle"],
        "linewidth": 1.0,
        "marker": look["marker"],
        "markersize": 3,
        "markevery": 1 if wavers(value) else every,
        "markerfacecolor": "none" if look["linestyle"] == "--" else look["color"],
    }
    axes[0].errorbar(x, value, yerr=bars(error), elinewidth=0.7, errorevery=every, **lines)
    if truth is not None and same_places(x, truth[0]):
        axes[-1].errorbar(x, value - truth[1], yerr=bars(error), elinewidth=0.7, errorevery=every, **lines)
    elif truth is not None:
        notes.append(
            f"{curve.label}: its particles are not those of the exact run, so no difference of profiles is drawn"
        )
    return wavers(value)


def name_axes(axes, direction):
    for axis in axes:
        axis.set_xlabel(f"{direction} [m]")
    axes[0].set_ylabel("temperature [K]")
    if len(axes) > 1:
        axes[1].axhline(0.0, color=style.INK, linewidth=1.2, alpha=0.75)
        axes[1].set_ylabel("engine minus exact [K]")


def flat(shown, along):
    """Whether the means along the axis hold next to nothing of what the temperatures differ by: then the picture shows
    round-off."""
    whole = max(np.ptp(t.temperature[np.isfinite(t.temperature)]) for _, t in shown)
    return max(np.ptp(binned(t, along)[1]) for _, t in shown) < NOTHING * whole


def wavers(values):
    """Whether a line through the points would go up and down with almost every one of them: what lies beside one
    another is then of different bodies."""
    steps = np.diff(values)
    steps = steps[np.abs(steps) > 0.02 * np.ptp(values)]
    return len(steps) > 3 and np.count_nonzero(steps[1:] * steps[:-1] < 0) >= 0.3 * len(steps)


def same_places(a, b):
    """Between other places the exact profile would have to be interpolated, and that error drawn as the engine's."""
    return len(a) == len(b) and np.allclose(a, b, rtol=0.0, atol=1e-3 * np.ptp(b) / max(len(b), 1))


def bars(error):
    return None if error is None else 2 * error


def binned(trajectory, along):
    """(place, mean temperature, standard error of that mean | None): one point for each layer of particles along the
    axis."""
    x, T = trajectory.position[:, along], trajectory.temperature
    sound = np.isfinite(x) & np.isfinite(T)
    x, T = x[sound], T[sound]
    span = max(np.ptp(x), 1e-300)
    layers = np.unique(np.round(x / span * 1e6))
    count = len(layers) if len(layers) <= 400 else 120
    edges = np.linspace(x.min() - 0.5 * span / max(count - 1, 1), x.max() + 0.5 * span / max(count - 1, 1), count + 1)
    where = np.clip(np.digitize(x, edges) - 1, 0, count - 1)
    number = np.bincount(where, minlength=count)
    filled = number > 0

    def mean(values):
        return np.bincount(where, values, count)[filled] / number[filled]

    error = None
    if trajectory.temperature_error is not None:
        e = trajectory.temperature_error[sound]
        if np.isfinite(e).all() and (e > 0).any():
            error = np.sqrt(np.bincount(where, e * e, count)[filled]) / number[filled]
    return mean(x), mean(T), error
