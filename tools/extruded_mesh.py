#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a closed mesh (OBJ): a simple polygon in x and z, which may be concave, drawn out along y.

    tools/extruded_mesh.py --half-width 0.02 -0.03,0.045 0.03,0.045 0.03,0.125 ... > body.obj     corners x,z [m],
    counterclockwise

Each side of the polygon makes two triangles and both ends the same triangulation, so that every edge has two triangles:
the mesh is closed."""

import argparse
import sys


def cross(a, b, c):
    """Twice the area of a triangle, positive where it turns to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def inside(p, a, b, c):
    return cross(a, b, p) >= 0 and cross(b, c, p) >= 0 and cross(c, a, p) >= 0


def triangles(corners):
    """Ear clipping: rows of corners, each triangle counterclockwise."""
    left, found = list(range(len(corners))), []
    while len(left) > 3:
        for n, b in enumerate(left):
            a, c = left[n - 1], left[(n + 1) % len(left)]
            others = (corners[k] for k in left if k not in (a, b, c))
            if cross(corners[a], corners[b], corners[c]) > 0 and not any(
                inside(p, corners[a], corners[b], corners[c]) for p in others
            ):
                found.append((a, b, c))
                left.remove(b)
                break
        else:
            sys.exit("the corners cross each other, lie on a line, or run clockwise")
    return [*found, tuple(left)]


def mesh(corners, half_width):
    """(vertices, faces): faces turn outwards. Counterclockwise in x and z turns to -y."""
    count = len(corners)
    vertices = [(x, y, z) for y in (-half_width, half_width) for x, z in corners]
    faces = []
    for a, b, c in triangles(corners):
        faces += [(a, b, c), (count + a, count + c, count + b)]
    for a in range(count):
        b = (a + 1) % count
        faces += [(b, a, count + a), (b, count + a, count + b)]
    return vertices, faces


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--half-width", type=float, required=True)
    words = sys.argv[1:]
    args, corners = parser.parse_known_args(words)
    points = [tuple(float(v) for v in word.split(",")) for word in corners]
    vertices, faces = mesh(points, args.half_width)
    for x, y, z in vertices:
        print(f"v {x:g} {y:g} {z:g}")
    for a, b, c in faces:
        print(f"f {a + 1} {b + 1} {c + 1}")


if __name__ == "__main__":
    main()
