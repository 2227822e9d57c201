# SPDX-License-Identifier: BSD-3-Clause
"""Reads exported files by programs that are not ours and compares every number with trajectory.h5: foreign_readers.py
RUN EXPORT

For the Python of .venv-readers (tools/requirements-readers.txt). Equal means the same double, but where the reader
itself keeps less (MDAnalysis: float32)."""

import csv
import sys
import warnings
from pathlib import Path

import ase.io
import h5py
import meshio
import numpy as np
import vtk
from MDAnalysis.coordinates.H5MD import H5MDReader
from vtk.util.numpy_support import vtk_to_numpy

warnings.simplefilter("ignore")
RUN, EXPORT = Path(sys.argv[1]), Path(sys.argv[2])
checked = {}


def same(what, got, wanted):
    np.testing.assert_array_equal(np.asarray(got), wanted, err_msg=what)
    checked[what.split(":")[0]] = checked.get(what.split(":")[0], 0) + np.size(wanted)


with h5py.File(RUN / "trajectory.h5") as file:
    group = file["particles/all"]
    fields = {name: group[name]["value"][:] for name in group if "value" in group[name]}
    times, steps = group["position/time"][:], group["position/step"][:]
    boundary = list(group["box"].attrs["boundary"])
    bodies = (
        {name: file["particles/bodies"][name]["value"][:] for name in file["particles/bodies"]}
        if "bodies" in file["particles"]
        else {}
    )
    kinetic = file["observables/energy_kinetic/value"][:]
frames = range(len(times))
alive = fields["id"] >= 0
assert len(times) > 2 and alive.any()
truth = [{name: values[f][alive[f]] for name, values in fields.items()} for f in frames]

# VTK: frames of the collection, with their times
collection = (EXPORT / "frames.pvd").read_text()
for f in frames:
    assert f'timestep="{float(times[f])!r}"' in collection and f'file="frames/{f:05d}.vtp"' in collection
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(EXPORT / "frames" / f"{f:05d}.vtp"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    data = reader.GetOutput()
    assert data.GetNumberOfVerts() == data.GetNumberOfPoints() == alive[f].sum()
    same("vtp: points", vtk_to_numpy(data.GetPoints().GetData()), truth[f]["position"])
    same("vtp: row", vtk_to_numpy(data.GetPointData().GetArray("row")), np.flatnonzero(alive[f]))
    same("vtp: time", vtk_to_numpy(data.GetFieldData().GetArray("TimeValue")), times[f])
    for name, values in truth[f].items():
        if name != "position":
            same(f"vtp: {name}", vtk_to_numpy(data.GetPointData().GetArray(name)), values)

# meshio: XDMF
with meshio.xdmf.TimeSeriesReader(EXPORT / "fields.xdmf") as reader:
    points, cells = reader.read_points_cells()
    same("xdmf: points", points, truth[0]["position"])
    assert cells[0].type == "vertex" and len(cells[0].data) == len(points) and reader.num_steps == len(times)
    for f in frames:
        time, data, _ = reader.read_data(f)
        same("xdmf: time", time, times[f])
        assert set(data) == {*fields, "row"}
        for name, values in truth[f].items():
            same(f"xdmf: {name}", data[name], values)

# MDAnalysis: H5MD; it keeps float32 of rows that are NaN where they are not alive
reader = H5MDReader(str(EXPORT / "particles.h5md"), convert_units=False)
assert reader.n_frames == len(times)
for f in frames:
    frame = reader[f]
    same("h5md: time", frame.time, times[f])
    same("h5md: position", frame.positions, fields["position"][f].astype(np.float32))
    same("h5md: velocity", frame.velocities, fields["velocity"][f].astype(np.float32))
    assert frame.dimensions is not None and (frame.dimensions[3:] == 90).all() and np.isfinite(frame.dimensions).all()
with h5py.File(EXPORT / "particles.h5md") as copy:
    for name, values in fields.items():
        same(f"h5md: {name}", copy[f"particles/all/{name}/value"][:], values)
    assert list(copy["particles/all/box"].attrs["boundary"]) == boundary

# ASE: extended XYZ and LAMMPS dump
pictures = ase.io.read(EXPORT / "particles.xyz", ":")
dumped = ase.io.read(EXPORT / "particles.dump", ":", format="lammps-dump-text")
assert len(pictures) == len(dumped) == len(times)
for f in frames:
    same("xyz: position", pictures[f].positions, truth[f]["position"])
    same("xyz: time", pictures[f].info["Time"], times[f])
    same("xyz: pbc", pictures[f].pbc, [word == "periodic" for word in boundary])
    for name, values in truth[f].items():
        if name != "position":
            same(f"xyz: {name}", pictures[f].arrays[name], values)
    same("lammps: position", dumped[f].positions, truth[f]["position"])
    same("lammps: type", dumped[f].arrays["type"], truth[f]["material"] + 1)
    same("lammps: pbc", dumped[f].pbc, [word == "periodic" for word in boundary])
lines = (EXPORT / "particles.dump").read_text().splitlines()  # the columns that ASE does not take
head = next(line for line in lines if line.startswith("ITEM: ATOMS")).split()[2:]
last = np.array([line.split() for line in lines[-int(alive[-1].sum()) :]], dtype=float)
same("lammps: vy", last[:, head.index("vy")], truth[-1]["velocity"][:, 1])
with open(EXPORT / "particles.times.csv", encoding="utf-8") as file:
    same("lammps: times", [float(row["time"]) for row in csv.DictReader(file)], times)

# PLY by meshio and VTK, OBJ by VTK
for f in frames:
    mesh = meshio.read(EXPORT / "ply" / f"{f:05d}.ply")
    same("ply: position", mesh.points, truth[f]["position"])
    same("ply: velocity", mesh.point_data["vz"], truth[f]["velocity"][:, 2])
    same("ply: phase", mesh.point_data["phase"], truth[f]["phase"])
    for kind, ending in ((vtk.vtkPLYReader, "ply"), (vtk.vtkOBJReader, "obj")):
        reader = kind()
        reader.SetFileName(str(EXPORT / ending / f"{f:05d}.{ending}"))
        reader.Update()
        same(
            f"{ending}: by VTK",
            vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(np.float32),
            truth[f]["position"].astype(np.float32),
        )

# CSV
with open(EXPORT / "observables.csv", encoding="utf-8") as file:
    same("csv: energy", [float(row["energy_kinetic [J]"]) for row in csv.DictReader(file)], kinetic)
if bodies:
    with open(EXPORT / "bodies.csv", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    living = np.isfinite(bodies["position"]).all(axis=2)
    assert len(table) == living.sum()
    same("csv: bodies", [float(row["position_z [m]"]) for row in table], bodies["position"][living][:, 2])
    same("csv: orientation", [float(row["orientation_w"]) for row in table], bodies["orientation"][living][:, 0])

print(", ".join(f"{name} {count}" for name, count in checked.items()), "numbers are equal")
