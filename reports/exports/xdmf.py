# SPDX-License-Identifier: BSD-3-Clause
"""XDMF with a file of its own: fields.xdmf and fields.h5, one dataset a frame and field. ParaView and meshio read it.

trajectory.xdmf beside trajectory.h5 shows the same frames by slices of its datasets, which meshio cannot read.
"""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

import numpy as np

from .files import digits, whole, whole_hdf5


def write(run, out, frames):
    data, page = out / "fields.h5", out / "fields.xdmf"
    with whole_hdf5(data) as file, whole(page) as text:
        text.write(
            '<?xml version="1.0"?>\n<Xdmf Version="3.0"><Domain>\n<Grid Name="particles" GridType="Collection" '
            'CollectionType="Temporal">\n'
        )
        for frame in run.frames(frames):
            group = file.create_group(f"{frame.number:05d}")
            for name, values in (
                *frame.fields.items(),
                ("row", frame.row.astype(np.int32)),
                ("vertices", np.arange(len(frame), dtype=np.int64)[:, None]),
            ):
                node = group.create_dataset(
                    name, data=values, fletcher32=values.size > 0, chunks=values.shape if values.size else None
                )
                if run.fields.get(name):
                    node.attrs["unit"] = run.fields[name]
            text.write(f'<Grid Name="frame {frame.number}" GridType="Uniform"><Time Value="{digits(frame.time)}"/>\n')
            text.write(
                f'<Topology TopologyType="Polyvertex" NumberOfElements="{len(frame)}" '
                f'NodesPerElement="1">{item(group["vertices"])}</Topology>\n'
            )
            text.write(f'<Geometry GeometryType="XYZ">{item(group["position"])}</Geometry>\n')
            for name in (*frame.fields, "row"):  # the places too: meshio moves no point in time
                kind = "Vector" if group[name].ndim == 2 else "Scalar"
                text.write(
                    f'<Attribute Name={quoteattr(name)} AttributeType="{kind}" '
                    f'Center="Node">{item(group[name])}</Attribute>\n'
                )
            text.write("</Grid>\n")
        text.write("</Grid>\n</Domain></Xdmf>\n")
    return [page, data]


def item(node):
    kind = "Int" if node.dtype.kind in "iu" else "Float"
    return (
        f'<DataItem Format="HDF" DataType="{kind}" Precision="{node.dtype.itemsize}" '
        f'Dimensions="{" ".join(map(str, node.shape))}">fields.h5:{node.name}</DataItem>'
    )
