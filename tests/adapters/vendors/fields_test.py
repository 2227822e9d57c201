# SPDX-License-Identifier: BSD-3-Clause
"""The engines of fields: conduction and elastic bodies in scikit-fem and CalculiX."""

import json
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
sys.path[:0] = [str(ADAPTERS), str(HERE)]
import engine_calculix
from contract import read_job
from scenes import body, check, job


class Fields(unittest.TestCase):
    COMMAND = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_scikit_fem.py")]
    WARM = {"motion": "fixed", "temperature": {"kind": "constant", "value": 300.0}, "velocity": [0.0, 0.0, 0.0]}

    def answer(self, changes, **scene):
        return check(self.COMMAND, job([body(**{**self.WARM, **changes})], preset="ElementHex1", **scene))

    def test_conduction_at_rest_is_taken(self):
        self.assertEqual(self.answer({}), {"can": True, "reason": ""})
        self.assertTrue(self.answer({"motion": "free"}, gravity=[0.0, 0.0, 0.0])["can"])

    def test_what_moves_melts_or_has_no_temperature_is_refused(self):
        for changes, scene, word in (
            ({"temperature": None}, {}, "no temperature"),
            ({"phase": "liquid"}, {}, "may move"),
            ({"motion": "free"}, {}, "may move"),
            ({}, {"materials": [{"name": "stuff", "t_melt": 273.0}]}, "may melt"),
            ({}, {"jitter": 0.1}, "lattice"),
            ({}, {"mode": "paper"}, "paper"),
        ):
            self.assertIn(word, self.answer(changes, **scene)["reason"])


class HeldSolids(unittest.TestCase):
    """A bar between a clamp and nothing, as scikit-fem and CalculiX take it."""

    BAR = {
        "phase": "elastic",
        "name": "bar",
        "velocity": [0.0, 0.0, 0.0],
        "joined_to": ["clamp"],
        "velocity_field": {"kind": "constant", "value": [0.0, 0.0, 0.0]},
        "shape": {"kind": "box", "min": [0.0, 0.0, 0.0], "max": [0.4, 0.1, 0.1]},
    }
    CLAMP = {
        **BAR,
        "name": "clamp",
        "index": 1,
        "phase": "rigid",
        "motion": "fixed",
        "joined_to": [],
        "shape": {"kind": "box", "min": [-0.1, 0.0, 0.0], "max": [0.0, 0.1, 0.1]},
    }
    STUFF = {
        "name": "stuff",
        "density": 1000.0,
        "young_modulus": 1e6,
        "poisson_ratio": 0.0,
        "t_melt": None,
        "elastic_limit": None,
        "fracture_stretch": None,
        "fracture_distance": None,
    }

    def scene(self, bar=None, clamp=None, preset="C3D8", **scene):
        return job(
            [body(**{**self.BAR, **(bar or {})}), body(**{**self.CLAMP, **(clamp or {})})],
            preset=preset,
            **{"materials": [self.STUFF], **scene},
        )

    def answer(self, name, preset, **changes):
        return check(["/usr/bin/python3", "-B", str(ADAPTERS / name)], self.scene(preset=preset, **changes))

    def test_a_clamped_bar_is_taken(self):
        for name, preset in (("engine_scikit_fem.py", "ElementHex2"), ("engine_calculix.py", "C3D20R")):
            self.assertEqual(self.answer(name, preset), {"can": True, "reason": ""}, name)

    def test_what_linear_elasticity_does_not_know_is_refused(self):
        plastic = [{**self.STUFF, "elastic_limit": 0.01}]
        for name, preset in (("engine_scikit_fem.py", "ElementHex1"), ("engine_calculix.py", "C3D8")):
            for changes, word in (
                ({"bar": {"joined_to": []}}, "free"),
                ({"bar": {"angular_velocity": [0, 0, 1]}}, "turns"),
                ({"materials": plastic}, "plastic"),
                ({"clamp": {"motion": "prescribed"}}, "prescribed"),
                ({"mode": "paper"}, "paper"),
                ({"events": [{}]}, "events"),
            ):
                self.assertIn(word, self.answer(name, preset, **changes)["reason"], (name, word))

    def test_the_deck_of_calculix_holds_the_clamps_nodes_and_bears_the_weight(self):
        path = Path(tempfile.mkdtemp()) / "job.json"
        path.write_text(json.dumps(self.scene()))
        self.addCleanup(shutil.rmtree, path.parent)
        deck = engine_calculix.Deck(read_job(str(path)))
        lines = list(deck.lines())
        self.assertEqual((len(deck.mesh.elements), len(deck.mesh.node)), (4, 20))
        held = lines[lines.index("*BOUNDARY") + 1 : lines.index("*STEP, INC=" + str(deck.count() + 1))]
        self.assertEqual(len(held), 4)
        self.assertIn("EALL,GRAV,9.81,0.0,0.0,-1.0", lines)

    def test_what_ccx_prints_becomes_rows_of_particles(self):
        path = Path(tempfile.mkdtemp()) / "job.json"
        path.write_text(json.dumps(self.scene()))
        self.addCleanup(shutil.rmtree, path.parent)
        deck = engine_calculix.Deck(read_job(str(path)))
        text = ""
        for at in (0.5, 1.0):
            text += f"\n displacements (vx,vy,vz) for set ALL and time  {at:.7E}\n\n"
            text += "".join(
                f"  {n}  {at * deck.place_of(n)[0]:.6E}  0.000000E+00  0.000000E+00\n" for n in deck.mesh.node.values()
            )
            text += f"\n velocities (vx,vy,vz) for set ALL and time  {at:.7E}\n\n"
            text += "".join(f"  {n}  0.000000E+00  2.000000E+00  0.000000E+00\n" for n in deck.mesh.node.values())
            text += f"\n total volume for set ALL and time  {at:.7E}\n\n        4.000000E-03\n"
        frames, volume = deck.read(text)
        self.assertEqual(volume, 4e-3)
        places = [[-0.05, 0.05, 0.05], [0.05, 0.05, 0.05], [0.35, 0.05, 0.05]]  # of the clamp, and the ends of the bar
        rows = list(deck.rows(frames, {"position": places, "velocity": [[0.0] * 3] * 3}))
        self.assertEqual([row[:2] for row in rows], [(t, i) for t in (0.0, 0.5, 1.0) for i in range(3)])
        self.assertEqual([round(row[2], 9) for row in rows[6:]], [-0.05, 0.10, 0.70])  # the clamp stays; u = x t
        self.assertEqual([row[6] for row in rows[6:]], [0.0, 2.0, 2.0])

    def test_calculix_answers_gauges_by_its_nodes(self):
        asked = [
            {
                "metric": "tip",
                "quantity": "displacement",
                "body": "bar",
                "where": {"point": [0.4, 0.05, 0.05], "axis": "x"},
            },
            {"metric": "middle", "quantity": "centre", "body": "bar", "where": {"axis": "x"}},
            {"metric": "squeeze", "quantity": "pressure_at", "body": "", "where": {"point": [0.0, 0.0, 0.0]}},
            {
                "metric": "beyond",
                "quantity": "displacement",
                "body": "bar",
                "where": {"point": [1.0, 0.0, 0.0], "axis": "x"},
            },
        ]
        path = Path(tempfile.mkdtemp()) / "job.json"
        path.write_text(json.dumps({**self.scene(), "gauges": asked}))
        self.addCleanup(shutil.rmtree, path.parent)
        deck = engine_calculix.Deck(read_job(str(path)))
        stretched = {
            f"U{axis}": {n: (0.5 * deck.place_of(n)[0] if axis == 1 else 0.0) for n in deck.mesh.node.values()}
            for axis in (1, 2, 3)
        }
        rows = [(at, number, round(value, 12)) for at, number, value in deck.gauge_rows([stretched, stretched])]
        self.assertEqual(
            rows,
            [
                (t, g, v)
                for t, tip, middle in ((0.0, 0.0, 0.2), (0.5, 0.2, 0.3), (1.0, 0.2, 0.3))
                for g, v in ((0, tip), (1, middle))
            ],
        )


if __name__ == "__main__":
    unittest.main()
