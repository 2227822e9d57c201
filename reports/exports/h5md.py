# SPDX-License-Identifier: BSD-3-Clause
"""H5MD 1.1 for readers that ask for a box and for particles only: MDAnalysis, VMD's plug-in, pyh5md.

trajectory.h5 is H5MD itself. This copy adds a box in every frame, and leaves out /particles/bodies, which some readers
take for a second system. MDAnalysis knows no metre and refuses a file that names it, so that lengths have the attribute
`si_unit` instead of `unit`: open it with convert_units=False."""

from __future__ import annotations

import h5py
import numpy as np

from .files import whole_hdf5

LENGTHS = ("m",)


def write(run, out, frames):
    path = out / "particles.h5md"
    low, high, periodic = run.box()
    numbers = list(range(len(run))) if frames is None else list(frames)
    with whole_hdf5(path) as file:
        head = file.create_group("h5md")
        head.attrs["version"] = np.array([1, 1], dtype=np.int32)
        head.create_group("author").attrs["name"] = "tripoint"
        creator = head.create_group("creator")
        creator.attrs["name"], creator.attrs["version"] = "tripoint", "1"
        group = file.create_group("particles/all")
        steps = rising(run.steps[numbers])
        times, counts = run.times[numbers], steps
        box = group.create_group("box")
        box.attrs["dimension"] = 3
        box.attrs["boundary"] = np.array(["periodic" if p else "none" for p in periodic], dtype=h5py.string_dtype())
        clock = element(box, "edges", np.tile(high - low, (len(numbers), 1)))
        clock.create_dataset("step", data=counts)
        clock.create_dataset("time", data=times).attrs["unit"] = "s"
        for name, unit in run.fields.items():
            node = group.create_group(name)
            source = run.dataset(f"particles/all/{name}/value")
            value = node.create_dataset(
                "value",
                shape=(len(numbers), *source.shape[1:]),
                dtype=source.dtype,
                fletcher32=True,
                chunks=(1, *(max(1, n) for n in source.shape[1:])),
            )
            for at, number in enumerate(numbers):
                value[at] = run.field(name, number)
            if unit:
                value.attrs["si_unit" if unit in LENGTHS else "unit"] = unit
            node["step"], node["time"] = clock["step"], clock["time"]
    return [path]


def element(parent, name, values):
    node = parent.create_group(name)
    node.create_dataset("value", data=values).attrs["si_unit"] = "m"
    return node


def rising(steps):
    """H5MD wants steps that rise; an engine that counts none gets the frames' numbers."""
    steps = np.asarray(steps, dtype=np.int64)
    return steps if (np.diff(steps) > 0).all() else np.arange(len(steps), dtype=np.int64)
