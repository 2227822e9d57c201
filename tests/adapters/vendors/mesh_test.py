# SPDX-License-Identifier: BSD-3-Clause
"""Meshes as the adapters read them, and friction of pairs by the numbers of single surfaces."""

import os
import struct
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
sys.path[:0] = [str(ADAPTERS), str(HERE)]

from contract import BadJob  # noqa: E402
from mesh import is_convex, read_mesh  # noqa: E402
from pair_fit import by_harmonic_mean, by_least, harmonic  # noqa: E402
from rigid import pieces_of  # noqa: E402
from rotation import IDENTITY, between  # noqa: E402
from scenes import body, check, floor, job  # noqa: E402

CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]  # outward


def obj(corners, sides):
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(
        "f " + " ".join(str(k + 1) for k in side) + "\n" for side in sides
    )


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name, content):
        path = Path(self.folder.name) / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def test_obj_and_both_kinds_of_stl_are_the_same_cube(self):
        faces = [(side[0], side[k], side[k + 1]) for side in SIDES for k in (1, 2)]
        text = (
            "solid cube\n"
            + "".join(
                "facet normal 0 0 0\nouter loop\n"
                + "".join("vertex {} {} {}\n".format(*CORNERS[k]) for k in face)
                + "endloop\nendfacet\n"
                for face in faces
            )
            + "endsolid\n"
        )
        binary = (
            b"\0" * 80
            + struct.pack("<I", len(faces))
            + b"".join(struct.pack("<12fH", 0, 0, 0, *(c for k in face for c in CORNERS[k]), 0) for face in faces)
        )
        for name, content in (("cube.obj", obj(CORNERS, SIDES)), ("text.stl", text), ("binary.stl", binary)):
            mesh = read_mesh(self.file(name, content), 2.0)
            self.assertEqual(sorted(mesh.corners), sorted(tuple(2.0 * c for c in corner) for corner in CORNERS), name)
            self.assertEqual((len(mesh.faces), is_convex(mesh)), (12, True), name)

    def test_negative_numbers_textures_and_continued_lines_are_read(self):
        text = (
            obj(CORNERS, SIDES[:-1]).replace("v 1.0 1.0 1.0", "v 1.0 1.0 \\\n 1.0 # last") + "f -7/1/2 -3/ -1//4 -5\n"
        )
        self.assertTrue(is_convex(read_mesh(self.file("cube.obj", text), 1.0)))

    def test_a_dent_and_a_second_piece_are_not_convex(self):
        dented = [*CORNERS, (0.5, 0.5, 0.9)]
        cap = [(1, 5, 8), (5, 7, 8), (7, 3, 8), (3, 1, 8)]
        apart = CORNERS + [(x + 3.0, y, z) for x, y, z in CORNERS]
        for name, text in (
            ("dent.obj", obj(dented, SIDES[:-1] + cap)),
            ("two.obj", obj(apart, SIDES + [tuple(k + 8 for k in side) for side in SIDES])),
        ):
            self.assertFalse(is_convex(read_mesh(self.file(name, text), 1.0)), name)

    def test_what_is_no_mesh_is_a_broken_job(self):
        with self.assertRaises(BadJob):
            read_mesh(self.file("cut.stl", b"\0" * 90), 1.0)

    def test_a_convex_mesh_is_handed_to_each_engine_that_has_hulls_and_a_dented_one_where_triangles_may_be(self):
        cube = {"kind": "mesh", "file": self.file("cube.obj", obj(CORNERS, SIDES)), "scale": 1.0}
        dent = {
            **cube,
            "file": self.file(
                "dent.obj", obj([*CORNERS, (0.5, 0.5, 0.9)], SIDES[:-1] + [(1, 5, 8), (5, 7, 8), (7, 3, 8), (3, 1, 8)])
            ),
        }
        base = floor(shape={"kind": "box", "min": [-1, -1, -1], "max": [1, 1, 0]})
        for name, preset, hull, held, free in (
            ("mujoco", "Euler", "", "dent", "dent"),
            ("ode", "dWorldStep", "", "", ""),
            ("jolt", "default", "", "", "dent"),
            ("rapier", "SIMPLIFIED", "", "", "dent"),
            ("drake", "discrete", "", "dent", "dent"),
            ("dart", "default", "corners", "dent", "dent"),
        ):
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / f"engine_{name}.py")]
            for shape, motion, word in ((cube, "free", hull), (dent, "fixed", held), (dent, "free", free)):
                reason = check(
                    command, job([body(shape=shape, motion=motion, velocity=[0.0, 0.0, 0.0]), base], preset=preset)
                )["reason"]
                self.assertEqual(bool(reason), bool(word), (name, motion, reason))
                self.assertIn(word, reason)

    def test_corners_are_in_the_principal_frame(self):
        cube = {"kind": "mesh", "file": self.file("cube.obj", obj(CORNERS, SIDES)), "scale": 1.0}
        (piece,) = pieces_of(cube, (0.5, 0.5, 0.5), between((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))
        self.assertEqual(piece.kind, "hull")
        self.assertEqual({tuple(round(abs(c), 12) for c in corner) for corner in piece.corners}, {(0.5, 0.5, 0.5)})
        (same,) = pieces_of(cube, (0.0, 0.0, 0.0), IDENTITY)
        self.assertEqual(sorted(same.corners), sorted(CORNERS))


class Pairs(unittest.TestCase):
    def test_surfaces_have_numbers_whose_combination_is_what_is_stated(self):
        wanted = {("slick", "stone"): 0.2, ("rough", "stone"): 0.8}
        mean = by_harmonic_mean(wanted)
        for (a, b), mu in wanted.items():
            self.assertAlmostEqual(harmonic(mean[a], mean[b]), mu, delta=1e-12)
        self.assertEqual(by_least(wanted), {"slick": 0.2, "rough": 0.8, "stone": 0.8})

    def test_where_none_have_there_is_no_answer(self):
        self.assertIsNone(by_least({("a", "a"): 0.1, ("b", "b"): 0.1, ("a", "b"): 0.5}))
        self.assertIsNone(by_harmonic_mean({("a", "a"): 0.1, ("b", "b"): 0.1, ("a", "b"): 0.5}))
        self.assertEqual(by_harmonic_mean({("a", "a"): 0.0, ("b", "b"): 0.0, ("a", "b"): 0.0}), {"a": 0.0, "b": 0.0})
        self.assertEqual(by_harmonic_mean({("a", "a"): 0.0, ("a", "b"): 0.0, ("b", "b"): 0.3})["a"], 0.0)
        self.assertEqual(by_harmonic_mean({("a", "b"): 0.0, ("b", "b"): 0.3})["a"], 0.0)

    def test_drake_and_dart_refuse_a_table_that_their_rule_cannot_give(self):
        two = [body(), floor(material="other", shape={"kind": "box", "min": [-1, -1, -1], "max": [1, 1, 0]})]
        laws = [
            {"materials": pair, "friction": mu, "restitution": None}
            for pair, mu in ((["stuff", "stuff"], 0.1), (["other", "other"], 0.1), (["stuff", "other"], 0.5))
        ]
        for name, preset in (("drake", "discrete"), ("dart", "default")):
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / f"engine_{name}.py")]
            self.assertIn("no numbers", check(command, job(two, preset=preset, contacts=laws))["reason"])
            self.assertEqual(check(command, job(two, preset=preset, contacts=laws[2:]))["reason"], "")


if __name__ == "__main__":
    unittest.main()
