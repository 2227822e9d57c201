#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the same particles by `tripoint render --mesh` and by splashsurf: surface_bench.py TRIPOINT

Particles of a cubic lattice inside a ball and a cube, whose volume, area and distance are known. Rows: volume and area
over the exact ones minus 1, greatest distance of a corner from the exact surface in spacings, triangles, CPU seconds
(least of three; of tripoint the whole process, which also reads the file and draws 16 x 16 pixels). splashsurf is left
out where it is not installed: pip install pysplashsurf==0.14.1.0 Settings of splashsurf: particle radius half a
spacing, smoothing length 2 spacings, threshold 0.6, cubes of a half and a quarter of a spacing. (At a smoothing length
of 1 spacing this version leaves holes between the particles of a lattice.)"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

try:
    import pysplashsurf
except ImportError:
    pysplashsurf = None

ROUNDS = 3


def lattice(inside, count, offset):
    axis = np.arange(-count - 2, count + 2) + offset
    places = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    return places[inside(places)]


def ball(count):
    """A ball of so many spacings, spacing 1: particles, volume, area, distance."""
    return (
        f"ball of {count} spacings",
        lattice(lambda r: (r**2).sum(1) < count**2, count, 0.5),
        4 / 3 * np.pi * count**3,
        4 * np.pi * count**2,
        lambda r: np.abs(np.linalg.norm(r, axis=1) - count),
    )


def cube(count):
    half = count / 2

    def distance(r):
        q = np.abs(r) - half
        return np.abs(np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(1), 0))

    return (
        f"cube of {count} spacings",
        lattice(lambda r: (np.abs(r) < half).all(1), count // 2, 0.5),
        float(count**3),
        6.0 * count**2,
        distance,
    )


def write_run(folder, places):
    """The least that a trajectory holds: one frame of particles of one body."""
    with h5py.File(folder / "trajectory.h5", "w") as file:
        file.create_group("h5md")
        n = len(places)
        for name, values, unit in (
            ("position", places[None], "m"),
            ("velocity", np.zeros((1, n, 3)), "m s-1"),
            ("mass", np.ones((1, n)), "kg"),
            ("id", np.arange(n)[None], None),
            ("phase", np.full((1, n), 2), None),
            ("body", np.zeros((1, n), int), None),
            ("material", np.zeros((1, n), int), None),
        ):
            value = file.create_dataset(f"particles/all/{name}/value", data=values)
            if unit:
                value.attrs["unit"] = unit
            file[f"particles/all/{name}/time"], file[f"particles/all/{name}/step"] = np.zeros(1), np.zeros(1, int)


def read_ply(file):
    head, _, body = file.read_bytes().partition(b"end_header\n")
    corners, triangles = (
        int(next(line for line in head.decode().splitlines() if line.startswith(f"element {what}")).split()[-1])
        for what in ("vertex", "face")
    )
    corner, face = np.dtype([("place", "<f8", 3), ("values", "<i4", 4)]), np.dtype([("n", "u1"), ("corner", "<i4", 3)])
    return np.frombuffer(body, corner, corners)["place"], np.frombuffer(
        body, face, triangles, corners * corner.itemsize
    )["corner"]


def children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def by_tripoint(program, places, *words):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_run(folder, places)
        least = np.inf
        for _ in range(ROUNDS):
            before = children()
            subprocess.run(
                [program, "render", folder, "--frame", "0", "--size", "16x16", "--mesh", folder / "mesh.ply", *words],
                check=True,
                capture_output=True,
            )
            least = min(least, children() - before)
        return *read_ply(folder / "mesh.ply"), least


def by_splashsurf(places, cube_size):
    least = np.inf
    for _ in range(ROUNDS):
        before = time.process_time()
        made = pysplashsurf.reconstruct_surface(
            places, particle_radius=0.5, smoothing_length=2.0, cube_size=cube_size, iso_surface_threshold=0.6
        )
        least = min(least, time.process_time() - before)
    return np.asarray(made.mesh.vertices), np.asarray(made.mesh.triangles), least


def row(title, code, count, exact, corners, triangles, seconds):
    volume, area, distance = exact
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    measured = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    surface = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    print(
        f"| {title} | {count:,} | {code} | {100 * (measured / volume - 1):+.2f} % | {100 * (surface / area - 1):+.2f} "
        f"% | {distance(corners).max():.2f} | {len(triangles):,} | {seconds:.2f} |",
        flush=True,
    )


def main():
    if len(sys.argv) != 2 or not os.access(sys.argv[1], os.X_OK):
        print(__doc__.splitlines()[0], file=sys.stderr)
        return 2
    print(
        "| body | particles | code | volume | area | greatest distance | triangles | CPU s "
        "|\n|---|---|---|---|---|---|---|---|"
    )
    for title, places, *exact in (ball(10), ball(20), cube(34)):
        row(title, "tripoint", len(places), exact, *by_tripoint(sys.argv[1], places))
        row(title, "tripoint, f = 1", len(places), exact, *by_tripoint(sys.argv[1], places, "--zb05"))
        for cubes in (0.5, 0.25) if pysplashsurf else ():
            row(title, f"splashsurf, cubes of {cubes} spacings", len(places), exact, *by_splashsurf(places, cubes))
    if not pysplashsurf:
        print("surface_bench: splashsurf is not installed: pip install pysplashsurf==0.14.1.0", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
