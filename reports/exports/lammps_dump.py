# SPDX-License-Identifier: BSD-3-Clause
"""LAMMPS' text dump: OVITO, ASE and LAMMPS' own read_dump read it. SI units, `units si`."""

from __future__ import annotations

import numpy as np

from .files import digits, whole

VECTORS = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz")}


def columns(frame):
    """{column: values}, those that LAMMPS names first. `type` is 1 + material, since LAMMPS counts types from 1; `id`
    is 1 + the row."""
    count = len(frame)
    found = {"id": frame.row + 1, "type": frame.fields.get("material", np.zeros(count, dtype=int)) + 1}
    for field, names in VECTORS.items():
        found.update((name, frame[field][:, axis]) for axis, name in enumerate(names))
    for name, values in frame.fields.items():
        if name in VECTORS or name in ("id", "material"):
            continue
        if values.ndim == 1:
            found[name] = values
        else:
            found.update((f"{name}_{'xyz'[axis]}", values[:, axis]) for axis in range(values.shape[1]))
    return found


def write(run, out, frames):
    """particles.dump, and particles.times.csv: a dump has step numbers and no times."""
    low, high, periodic = run.box()
    rising = len(run) < 2 or bool((np.diff(run.steps) > 0).all())
    path, times = out / "particles.dump", out / "particles.times.csv"
    with whole(path) as file, whole(times) as clock:
        clock.write("timestep,time\n")
        for frame in run.frames(frames):
            step = frame.step if rising else frame.number  # an engine that counts no steps: the frame's number
            clock.write(f"{step},{digits(frame.time)}\n")
            table = columns(frame)
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(frame)}\n")
            file.write(f"ITEM: BOX BOUNDS {' '.join('pp' if p else 'ff' for p in periodic)}\n")
            file.writelines(f"{digits(a)} {digits(b)}\n" for a, b in zip(low, high))
            file.write(f"ITEM: ATOMS {' '.join(table)}\n")
            file.writelines(" ".join(row) + "\n" for row in zip(*(texts(values) for values in table.values())))
    return [path, times]


def texts(values):
    return map(str, values.tolist()) if values.dtype.kind in "iu" else map(repr, values.tolist())
