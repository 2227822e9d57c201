# SPDX-License-Identifier: BSD-3-Clause
"""Poses of bodies and numbers of the whole scene, as CSV with a unit in each column's name."""

from __future__ import annotations

import csv

import numpy as np

from .files import whole

PARTS = {3: "xyz", 4: "wxyz"}


def write(run, out, frames):
    """bodies.csv: a row a frame and living body; observables.csv: a row a frame."""
    numbers = list(range(len(run))) if frames is None else list(frames)
    made = [out / "observables.csv"]
    with whole(made[0]) as file:
        columns = {"time [s]": run.times, "step": run.steps}
        for name, unit in run.observables.items():
            columns.update(split(name, unit, run.observable(name)))
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        table.writerows([cell(values[number]) for values in columns.values()] for number in numbers)
    if run.bodies:
        made.append(out / "bodies.csv")
        write_bodies(run, made[-1], numbers)
    return made


def write_bodies(run, path, numbers):
    names = run.body_names()
    with whole(path) as file:
        table = csv.writer(file, lineterminator="\n")
        for count, number in enumerate(numbers):
            columns = {}
            for name, unit in run.bodies.items():
                columns.update(split(name, unit, run.body(name, number)))
            if count == 0:
                table.writerow(["time [s]", "step", "body", "name", *columns])
            alive = np.isfinite(run.body("position", number)).all(axis=-1)
            for row in np.flatnonzero(alive):
                table.writerow(
                    [
                        cell(run.times[number]),
                        int(run.steps[number]),
                        int(row),
                        names[row],
                        *(cell(values[row]) for values in columns.values()),
                    ]
                )


def split(name, unit, values):
    """{"velocity_x [m s-1]": its column}"""
    tail = f" [{unit}]" if unit and unit != "1" else ""
    if values.ndim < 2 or values.shape[-1] not in PARTS:
        return {name + tail: values}
    return {f"{name}_{part}{tail}": values[..., axis] for axis, part in enumerate(PARTS[values.shape[-1]])}


def cell(value):
    return int(value) if isinstance(value, np.integer) else repr(float(value))
