# SPDX-License-Identifier: BSD-3-Clause
"""VTK: one .vtp a frame, and a .pvd that gives each its time. ParaView, VTK and PyVista read both."""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

import numpy as np

from .files import digits, whole

TYPES = {"float64": "Float64", "int32": "Int32", "int64": "Int64"}


def write(run, out, frames):
    """frames.pvd and frames/NNNNN.vtp. @return the files, the one to open first"""
    folder = out / "frames"
    folder.mkdir(exist_ok=True)
    made = []
    for frame in run.frames(frames):
        made.append((frame.time, folder / f"{frame.number:05d}.vtp"))
        write_points(made[-1][1], frame)
    collection = out / "frames.pvd"
    with whole(collection) as file:
        file.write(
            '<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">\n<Collection>\n'
        )
        for time, path in made:
            file.write(
                f'<DataSet timestep={quoteattr(digits(time))} part="0" file={quoteattr(f"frames/{path.name}")}/>\n'
            )
        file.write("</Collection>\n</VTKFile>\n")
    return [collection, *(path for _, path in made)]


def write_points(path, frame):
    """Polygonal data with one vertex a particle; values are raw bytes, so that every bit is kept."""
    blocks = []

    def array(name, values, components=1):
        values = np.ascontiguousarray(
            values,
            dtype={"f": "<f8", "i": "<i4"}.get(values.dtype.kind)
            if values.dtype.itemsize != 8 or values.dtype.kind == "f"
            else "<i8",
        )
        offset = sum(8 + len(block) for block in blocks)
        blocks.append(values.tobytes())
        many = f' NumberOfComponents="{components}"' if components > 1 else ""
        return (
            f'<DataArray type="{TYPES[values.dtype.name]}" Name={quoteattr(name)}{many} format="appended" '
            f'offset="{offset}"/>\n'
        )

    count = len(frame)
    text = (
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" '
        'header_type="UInt64">\n<PolyData>\n'
    )
    text += (
        '<FieldData>\n<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" '
        f'format="ascii">{digits(frame.time)}</DataArray>\n</FieldData>\n'
    )
    text += (
        f'<Piece NumberOfPoints="{count}" NumberOfVerts="{count}" NumberOfLines="0" NumberOfStrips="0" '
        'NumberOfPolys="0">\n<PointData>\n'
    )
    text += array("row", frame.row.astype(np.int32))
    for name, values in frame.fields.items():
        if name != "position":
            text += array(name, values, values.shape[1] if values.ndim == 2 else 1)
    text += "</PointData>\n<Points>\n" + array("Points", frame["position"], 3) + "</Points>\n<Verts>\n"
    text += array("connectivity", np.arange(count, dtype=np.int64)) + array(
        "offsets", np.arange(1, count + 1, dtype=np.int64)
    )
    text += '</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding="raw">\n_'
    with whole(path, "wb") as file:
        file.write(text.encode())
        for block in blocks:
            file.write(len(block).to_bytes(8, "little"))
            file.write(block)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")
