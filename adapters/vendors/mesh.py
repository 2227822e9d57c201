# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of a job as engines of rigid bodies take them: shared corners, triangles, and whether the surface is convex.

The harness has read the same file before and found it closed; what it accepts is read here."""

from __future__ import annotations

import struct
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from contract import BadJob
from rotation import Vector, cross, dot, norm, scaled, subtract, vector

Face = tuple[int, int, int]
SAME = 1e-7  # of the extent: corners that are nearer than about this are one


class Mesh(NamedTuple):
    corners: tuple[Vector, ...]  # [m]
    faces: tuple[Face, ...]  # counter-clockwise seen from outside


def _of_obj(text: str) -> tuple[list[Vector], list[Face]]:
    corners: list[Vector] = []
    faces: list[Face] = []
    for line in text.replace("\\\n", " ").splitlines():
        kind, *words = line.split("#")[0].split() or [""]
        if kind == "v":
            corners.append(vector(words[:3]))
        elif kind == "f":
            named = [int(word.split("/")[0]) for word in words]
            ring = [n - 1 if n > 0 else len(corners) + n for n in named]
            faces += [(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)]
    return corners, faces


def _of_stl(data: bytes) -> tuple[list[Vector], list[Face]]:
    start = data.lstrip(b"\xef\xbb\xbf \t\r\n")[:4096].lower()
    if start.startswith(b"solid") and b"facet" in start and b"\0" not in data:
        lines = (line.split() for line in data.decode("utf-8", "replace").splitlines())
        corners = [vector(words[1:4]) for words in lines if words and words[0].lower() == "vertex"]
    else:
        (count,) = struct.unpack_from("<I", data, 80)
        corners = [struct.unpack_from("<3f", data, 84 + 50 * t + 12 * (k + 1)) for t in range(count) for k in range(3)]
    return corners, [(k, k + 1, k + 2) for k in range(0, len(corners), 3)]


def _joined(corners: list[Vector], faces: list[Face], scale: float) -> Mesh:
    """Equal corners become one, and triangles without an area go."""
    extent = max(norm(subtract(corner, corners[0])) for corner in corners)
    numbers: dict[tuple[int, ...], int] = {}
    kept: list[Vector] = []
    index = []
    for corner in corners:
        key = tuple(round(c / (SAME * extent)) for c in corner)
        if key not in numbers:
            numbers[key] = len(kept)
            kept.append(scaled(scale, corner))
        index.append(numbers[key])
    named = [(index[a], index[b], index[c]) for a, b, c in faces]
    return Mesh(tuple(kept), tuple(face for face in named if len(set(face)) == 3))


@lru_cache
def read_mesh(file: str, scale: float) -> Mesh:
    """@raise BadJob where the file is no mesh"""
    path = Path(file)
    try:
        data = path.read_bytes()
        if path.suffix.lower() == ".obj":
            corners, faces = _of_obj(data.decode("utf-8-sig", "replace").replace("\r\n", "\n").replace("\r", "\n"))
        else:
            corners, faces = _of_stl(data)
        return _joined(corners, faces, scale)
    except (OSError, ValueError, IndexError, struct.error) as error:
        raise BadJob(f"{path}: {error}") from error


def is_convex(mesh: Mesh) -> bool:
    """Whether no triangle's neighbour lies before it by more than rounding, and the surface is one piece."""
    across = {
        edge: (number, face[(k + 2) % 3])
        for number, face in enumerate(mesh.faces)
        for k, edge in enumerate(_edges(face))
    }
    size = max(norm(subtract(corner, mesh.corners[0])) for corner in mesh.corners)
    reached, front = {0}, [0]
    while front:
        face = mesh.faces[front.pop()]
        a, b, c = (mesh.corners[k] for k in face)
        normal = cross(subtract(b, a), subtract(c, a))
        for one, other in _edges(face):
            number, corner = across.get((other, one), (-1, -1))
            if number < 0 or dot(normal, subtract(mesh.corners[corner], a)) > 1e-9 * size * norm(normal):
                return False
            if number not in reached:
                reached.add(number)
                front.append(number)
    return len(reached) == len(mesh.faces)


def _edges(face: Face) -> tuple[tuple[int, int], ...]:
    a, b, c = face
    return (a, b), (b, c), (c, a)
