# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of tools/extruded_mesh.py are closed and as large as they should be: extruded_mesh_test.py TOOL"""

import importlib.util
import sys
import unittest
from pathlib import Path

TOOL = Path(sys.argv.pop(1)).resolve()
SPEC = importlib.util.spec_from_file_location("extruded_mesh", TOOL)
extruded_mesh = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(extruded_mesh)
EARED = [
    (-0.03, 0.045),
    (0.03, 0.045),
    (0.03, 0.125),
    (0.01, 0.125),
    (0.01, 0.095),
    (-0.01, 0.095),
    (-0.01, 0.125),
    (-0.03, 0.125),
]


def volume(vertices, faces):
    """Of the tetrahedra from the origin, positive where faces turn outwards."""
    total = 0.0
    for a, b, c in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = vertices[a], vertices[b], vertices[c]
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6.0


class ExtrudedMesh(unittest.TestCase):
    def test_every_edge_has_two_faces_that_run_along_it_in_opposite_directions(self):
        _, faces = extruded_mesh.mesh(EARED, 0.02)
        edges = [(f[n], f[(n + 1) % 3]) for f in faces for n in range(3)]
        self.assertEqual(len(edges), len(set(edges)))
        self.assertEqual(set(edges), {(b, a) for a, b in edges})

    def test_the_volume_is_that_of_the_outline_without_its_gap(self):
        self.assertAlmostEqual(volume(*extruded_mesh.mesh(EARED, 0.02)), 0.04 * (0.06 * 0.08 - 0.02 * 0.03), places=15)

    def test_the_file_of_figure_11_is_what_the_tool_makes(self):
        vertices, faces = extruded_mesh.mesh(EARED, 0.02)
        rows = [
            line.split()
            for line in (TOOL.parent.parent / "cases/paper/two-ears.obj").read_text().splitlines()
            if line[:1] in "vf"
        ]
        self.assertEqual([tuple(map(float, r[1:])) for r in rows if r[0] == "v"], vertices)
        self.assertEqual([tuple(int(n) - 1 for n in r[1:]) for r in rows if r[0] == "f"], faces)

    def test_a_clockwise_outline_is_refused(self):
        with self.assertRaises(SystemExit):
            extruded_mesh.mesh(EARED[::-1], 0.02)


if __name__ == "__main__":
    unittest.main()
