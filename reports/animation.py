# SPDX-License-Identifier: BSD-3-Clause
"""Particles of a run as a small animated picture inside a page: every output frame, no script, nothing loaded.

Seen from the front and a little from above; of what never moves (tanks, grounds) only the half behind, so that the rest
is seen."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass

from model import text

MOST_PARTICLES = 4000  # a page stays small: of more, every second, third, ... is shown
WIDTH = 480  # of a picture [pixels]
SECONDS = 6.0  # of one round
COLOURS = (
    None,
    (42, 111, 184),
    (140, 196, 238),
    (58, 157, 93),
    (217, 130, 43),
    (150, 150, 150),
)  # by kind: not there, liquid, liquid of another material, elastic, rigid, never moves
EDGE = (70, 70, 70)


@dataclass
class Film:
    title: str
    note: str = ""  # why there is no picture
    picture: str = ""  # GIF, base64
    end: float = 0.0  # [s]


def films(results, rows):
    """@param rows: tables with `case` and `title`   @return a Film each"""
    return [film(results, text(row.get("case")), text(row.get("title"))) for row in rows]


def run_to_draw(case):
    """The last good run of our own solver: corrected, or printed where the case has no other form; None where there is
    none."""
    runs = [run for engine in case.engines if engine.name == "tripoint" for run in engine.runs if run.status == "ok"]
    return next((run for mode in ("corrected", "paper") for run in reversed(runs) if run.mode == mode), None)


def film(results, case_id, title):
    case = next((case for case in results.cases if case.id == case_id), None)
    run = run_to_draw(case) if case else None
    if not run:
        return Film(title, f"{case_id} is not among these results, or did not end well")
    try:
        times, position, phase, material = read(results.folder, run)
        return Film(title, "", base64.b64encode(painted(*seen(position, phase, material))).decode(), float(times[-1]))
    except Exception as error:  # a torn or foreign file, or a library that is not there: the page says it and goes on
        return Film(title, f"{case_id}: {error}")


def read(root, run):
    """@return times, position (frames, particles, 3), phase, material (frames, particles)"""
    import h5py
    import numpy as np
    import trajectories

    def per_frame(values, frames):
        return values if values.ndim > 1 else np.broadcast_to(values, (frames, values.shape[0]))

    with h5py.File(trajectories.folder_of(root, run) / "trajectory.h5", "r") as file:
        group = file["particles/all"]
        position = np.asarray(group["position/value"])
        return (
            np.asarray(group["position/time"]),
            position,
            *(per_frame(np.asarray(group[f"{name}/value"]), len(position)) for name in ("phase", "material")),
        )


def seen(position, phase, material):
    """@return places (frames, shown, 2) in the picture's width, kinds (frames, shown), height of the picture and
    diameter of a particle over its width"""
    import numpy as np

    there = np.isfinite(position).all(axis=2)
    moved = np.max(np.abs(position - position[:1]), axis=(0, 2), initial=0.0, where=there[:, :, None])
    still = there.all(axis=0) & (moved < 1e-9 * np.ptp(position[0][there[0]]))
    first = material[-1][(phase == 0).any(axis=0)].min(initial=material.max())
    kinds = (
        np.where(still, 5, np.where(phase == 0, np.where(material == first, 1, 2), np.where(phase == 1, 3, 4))) * there
    )
    shown = np.flatnonzero(~still | (position[0, :, 1] > np.nanmean(position[..., 1])))
    shown = shown[np.argsort(-np.nanmean(position[:, shown, 1], axis=0))]  # what is behind is drawn first
    shown = shown[:: max(1, -(-len(shown) // MOST_PARTICLES))]
    spacing = (np.prod(np.nanmax(position[0], axis=0) - np.nanmin(position[0], axis=0)) / position.shape[1]) ** (
        1 / 3
    ) * 1.2
    x = position[:, shown, 0] + 0.35 * position[:, shown, 1]
    y = -position[:, shown, 2] - 0.2 * position[:, shown, 1]
    places = np.stack([x - np.nanmin(x) + spacing, y - np.nanmin(y) + spacing], axis=-1)
    width, height = (np.nanmax(places[..., k]) + spacing for k in (0, 1))
    return places / width, kinds[:, shown], height / width, spacing / width


def painted(places, kinds, height, diameter):
    """@return an animated GIF"""
    from PIL import Image, ImageDraw

    radius, pictures = 0.5 * diameter * WIDTH, []
    for frame, kinds_now in zip(places * WIDTH, kinds):
        picture = Image.new("RGB", (WIDTH, max(1, round(WIDTH * height))), "white")
        pen = ImageDraw.Draw(picture)
        for (x, y), kind in zip(frame, kinds_now):
            if kind:
                pen.ellipse((x - radius, y - radius, x + radius, y + radius), fill=COLOURS[kind], outline=EDGE)
        pictures.append(picture.quantize(16))
    out = io.BytesIO()
    pictures[0].save(
        out, "GIF", save_all=True, append_images=pictures[1:], duration=round(1000 * SECONDS / len(pictures)), loop=0
    )
    return out.getvalue()
