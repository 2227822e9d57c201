# SPDX-License-Identifier: BSD-3-Clause
"""Each guard is tripped by a scene made for it: guards_test.py TRIPOINT [unittest arguments]."""

import base64
import json
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TRIPOINT = sys.argv[1]
HEAD = """format = 1
[case]
title = "a guard"
requirement = "R"
claims = "it trips"
[reference]
kind = "invariant"
"""
STEEL = '[[material]]\nname = "steel"\ndensity = 1000.0\nstiffness = 100.0\n'
JELLY = '[[material]]\nname = "jelly"\ndensity = 1.0\nyoung_modulus = 100.0\npoisson_ratio = 0.3\n'
WAX = '[[material]]\nname = "wax"\ndensity = 1000.0\nconductivity = 100.0\nheat_capacity = 1000.0\n'


def box(low, high):
    return f'{{ kind = "box", min = {low}, max = {high} }}'


def scene(keys):
    return f"[scene]\nspacing = 1.0\n{keys}\n"


def body(name, material, phase, low, high, more=""):
    return f'[[body]]\nname = "{name}"\nmaterial = "{material}"\nphase = "{phase}"\nshape = {box(low, high)}\n{more}\n'


FORCED = "[engines.tripoint]\nsettings = { force_time_step = true }\n"
# guard -> (scene, particles that may be to blame, body, words of the message)
TRIPS = {
    "finite": (
        scene('end_time = 1e6\ntime_step = 10.0\nunguarded = ["inversion", "overlap", "escape", "ledger", "time_step"]')
        + FORCED
        + JELLY
        + body("cube", "jelly", "elastic", [0.0, 0.0, 0.0], [2.0, 2.0, 2.0], "angular_velocity = [0.0, 0.0, 0.02]"),
        range(8),
        0,
        "no finite",
    ),
    "temperature": (
        scene("end_time = 1e7\ntime_step = 1e6")
        + FORCED
        + WAX
        + body(
            "bar",
            "wax",
            "rigid",
            [0.0, 0.0, 0.0],
            [8.0, 2.0, 2.0],
            'motion = "fixed"\ntemperature = { kind = "step", point = [4.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0], '
            "behind = 900.0, ahead = 1.0 }",
        ),
        range(32),
        0,
        "absolute zero",
    ),
    "inversion": (
        scene("end_time = 4.0")
        + JELLY
        + body(
            "cube",
            "jelly",
            "elastic",
            [0.0, 0.0, 0.0],
            [5.0, 5.0, 5.0],
            'velocity = { kind = "linear", centre = [2.5, 2.5, 2.5], gradient = [[-30.0, 0.0, 0.0], [0.0, 0.0, 0.0], '
            "[0.0, 0.0, 0.0]] }",
        ),
        range(125),
        0,
        "det F",
    ),
    "overlap": (
        scene("end_time = 2.0")
        + STEEL
        + body("left", "steel", "rigid", [-5.0, 0.0, 0.0], [-1.0, 4.0, 4.0], "velocity = [10.0, 0.0, 0.0]")
        + body("right", "steel", "rigid", [1.0, 0.0, 0.0], [5.0, 4.0, 4.0]),
        range(128),
        None,
        "overlap by one spacing",
    ),
    "escape": (
        scene("end_time = 20.0\nmin = [0.0, 0.0, 0.0]\nmax = [10.0, 10.0, 10.0]")
        + STEEL
        + body("drop", "steel", "liquid", [7.0, 5.0, 5.0], [9.0, 6.0, 6.0], "velocity = [1.0, 0.0, 0.0]"),
        [1],
        -1,
        "left the domain: x",
    ),
    "ledger": (
        scene('end_time = 20.0\nmode = "paper"')
        + JELLY.replace("100.0", "1000.0")
        + body("four", "jelly", "elastic", [0.0, 0.0, 0.0], [2.0, 2.0, 1.0], "angular_velocity = [1.0, 2.0, 3.0]"),
        range(4),
        0,
        "the scheme itself has",
    ),
    "time_step": (
        scene("end_time = 20.0\ngravity = [0.0, 0.0, -10.0]\ntime_step = 0.05")
        + STEEL
        + body("drop", "steel", "liquid", [0.0, 0.0, 0.0], [2.0, 2.0, 2.0]),
        range(8),
        -1,
        "bound of sound",
    ),
}


def run(text, folder, *more):
    (folder / "case.toml").write_text(HEAD + text)
    return subprocess.run(
        [TRIPOINT, "run", str(folder / "case.toml"), "--out", str(folder / "out"), "--quiet", *more],
        capture_output=True,
        text=True,
        timeout=120,
    )


def read_points(path):
    """(places, arrays) of a .vtp, by VTK's own reader where it is there, else as its format says."""
    try:
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        data = reader.GetOutput()
        arrays = {
            data.GetPointData().GetArrayName(k): [
                data.GetPointData().GetArray(k).GetTuple(i) for i in range(data.GetNumberOfPoints())
            ]
            for k in range(data.GetPointData().GetNumberOfArrays())
        }
        return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())], arrays
    except ImportError:
        pass
    piece = ElementTree.parse(path).getroot().find("PolyData/Piece")

    def values(array):
        raw = base64.b64decode(array.text)
        length, width = struct.unpack("<Q", raw[:8])[0], int(array.get("NumberOfComponents"))
        flat = struct.unpack(f"<{length // 8}d", raw[8 : 8 + length])
        return [flat[k : k + width] for k in range(0, len(flat), width)]

    return values(piece.find("Points/DataArray")), {a.get("Name"): values(a) for a in piece.find("PointData")}


class Guards(unittest.TestCase):
    def test_each_guard_names_particle_body_cause_time_and_leaves_a_file_that_opens(self):
        for guard, (text, particles, body_row, words) in TRIPS.items():
            with self.subTest(guard), tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                ended = run(text, folder)
                self.assertEqual(ended.returncode, 7, ended.stdout + ended.stderr)
                self.assertIn(words, ended.stdout)
                self.assertIn("no checkpoint was kept", ended.stdout)
                told = json.loads((folder / "out/result.json").read_text())["divergence"]
                self.assertEqual(told["guard"], guard)
                self.assertIn(told["particle"], particles)
                if body_row is not None:
                    self.assertEqual(told["body"], body_row)
                self.assertGreaterEqual(told["time"], 0.0)
                places, arrays = read_points(folder / "out" / told["file"])
                self.assertGreaterEqual(len(places), 1)
                self.assertTrue(all(abs(x) < 1e200 for place in places for x in place))
                culprits = [k for k, (mark,) in enumerate(arrays["culprit"]) if mark == 1.0]
                self.assertEqual(culprits, [0])
                self.assertEqual(arrays["id [1]"][0][0], told["particle"])
                self.assertIn("velocity [m/s]", arrays)

    def test_the_last_good_checkpoint_is_named_and_can_be_gone_on_from(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            ended = run(TRIPS["escape"][0], folder, "--checkpoint-interval", "0.5")
            self.assertEqual(ended.returncode, 7)
            kept = json.loads((folder / "out/result.json").read_text())["divergence"]["checkpoint"]
            self.assertTrue((folder / "out" / kept).is_file(), kept)
            self.assertIn(kept, ended.stdout)
            self.assertEqual(
                run(
                    TRIPS["escape"][0], folder, "--resume", str(folder / "out" / kept), "--checkpoint-interval", "0.5"
                ).returncode,
                7,
            )

    def test_a_scene_that_recovers_reaches_its_end_and_says_how_often_it_went_back(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            text = TRIPS["time_step"][0].replace("end_time = 20.0", 'end_time = 4.0\non_failure = "recover"')
            metric = (
                '[[metric]]\nname = "recoveries"\nquantity = "recoveries"\nnorm = "final"\nreference = { kind = '
                '"bound", function = "stated", args = { value = 0.0 } }\n'
            )
            ended = run(text + metric, folder, "--json")
            self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
            told = json.loads(ended.stdout)
            self.assertIn("recovered", told["reason"])
            self.assertGreaterEqual(told["metrics"]["recoveries"]["value"], 1.0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
