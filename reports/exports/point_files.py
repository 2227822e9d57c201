# SPDX-License-Identifier: BSD-3-Clause
"""PLY and OBJ: points for programs of pictures and scans, one file a frame. Blender, MeshLab and CloudCompare read
them."""

from __future__ import annotations

import numpy as np

from .files import digits, whole

KINDS = {"f": ("double", "<f8"), "i": ("int", "<i4")}


def write_ply(run, out, frames):
    folder = out / "ply"
    folder.mkdir(exist_ok=True)
    made = []
    for frame in run.frames(frames):
        columns = [("row", frame.row.astype(np.int32))]
        for name, values in frame.fields.items():
            stem = {"position": "", "velocity": "v"}.get(name, f"{name}_")
            columns += (
                [(name, values)]
                if values.ndim == 1
                else [(f"{stem}{'xyz'[axis]}", values[:, axis]) for axis in range(values.shape[1])]
            )
        columns.sort(key=lambda column: column[0] not in ("x", "y", "z"))  # places first, in their order
        table = np.empty(len(frame), dtype=[(name, KINDS[values.dtype.kind][1]) for name, values in columns])
        for name, values in columns:
            table[name] = values
        made.append(folder / f"{frame.number:05d}.ply")
        with whole(made[-1], "wb") as file:
            head = (
                f"ply\nformat binary_little_endian 1.0\ncomment time {digits(frame.time)} s, SI units\nelement "
                f"vertex {len(frame)}\n"
            )
            head += "".join(f"property {KINDS[values.dtype.kind][0]} {name}\n" for name, values in columns)
            file.write((head + "end_header\n").encode())
            file.write(table.tobytes())
    return made


def write_obj(run, out, frames):
    """Places alone: OBJ has no other values."""
    folder = out / "obj"
    folder.mkdir(exist_ok=True)
    made = []
    for frame in run.frames(frames):
        made.append(folder / f"{frame.number:05d}.obj")
        with whole(made[-1]) as file:
            file.write(f"# {len(frame)} particles at {digits(frame.time)} s, metres\n")
            file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in frame["position"].tolist())
            file.writelines(f"p {n}\n" for n in range(1, len(frame) + 1))
    return made
