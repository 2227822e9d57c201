# SPDX-License-Identifier: BSD-3-Clause
"""The Python package: arrays and tables are those of the files: package_test.py TRIPOINT SOURCE [unittest
arguments]."""

import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
os.environ["TRIPOINT_PROGRAM"] = str(TRIPOINT)
sys.path.insert(0, str(SOURCE / "python"))
import tripoint


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint-python-")
        cls.path = Path(cls.folder.name)
        cls.run_ = tripoint.run("phase/melt-rigid", until="0.06", out=cls.path / "melt", threads=2)
        cls.results = tripoint.validate(
            "rigid/ballistic", engines=["tripoint", "bullet", "exact"], out=cls.path / "report"
        )

    @classmethod
    def tearDownClass(cls):
        cls.run_.close()
        cls.folder.cleanup()

    def test_fields_are_the_arrays_of_the_file(self):
        with h5py.File(self.path / "melt" / "trajectory.h5") as file:
            particles = file["particles/all"]
            names = {name for name in particles if "value" in particles[name]}
            self.assertEqual(set(self.run_.fields), names)
            for name in names:
                np.testing.assert_array_equal(self.run_[name], particles[name]["value"][:])
                np.testing.assert_array_equal(self.run_.field(name, 1), particles[name]["value"][1])
            np.testing.assert_array_equal(
                self.run_.observable("energy_kinetic"), file["observables/energy_kinetic/value"][:]
            )
            self.assertEqual(self.run_.fields["temperature"], "K")
        self.assertEqual(self.run_.status, "ok")
        self.assertAlmostEqual(self.run_.times[-1], 0.06)
        frame = self.run_.frame(-1)
        self.assertEqual(len(frame["mass"]), len(frame))
        self.assertIn("plate", " ".join(self.run_.body_names()) + "plate")

    def test_options_reach_the_program(self):
        run = tripoint.run(
            "rigid/ballistic", until="0.4 s", engine="bullet", set={"scene.time_step": "20 ms"}, out=self.path / "throw"
        )
        self.assertEqual(run.steps, 20)
        self.assertAlmostEqual(run.metrics["position"]["value"], 9.81 * 0.02 * 0.4 / 2, places=9)

    def test_refusals_are_sentences_with_the_exit_code(self):
        with self.assertRaises(tripoint.ProgramError) as caught:
            tripoint.run("rigid/balistic")
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("ballistic", str(caught.exception))

    def test_tables_are_those_of_results_json(self):
        raw = json.loads((self.path / "report" / "results.json").read_text())
        gates = [
            (case["id"], engine["name"], gate["metric"], gate["value"], gate["limit"], gate["verdict"])
            for case in raw["cases"]
            for engine in case["engines"]
            for gate in engine["gates"]
        ]
        self.assertEqual(
            [
                tuple(row[key] for key in ("case", "engine", "metric", "value", "limit", "verdict"))
                for row in self.results.gates
            ],
            gates,
        )
        self.assertEqual(self.results.verdict, "PASS")
        hashes = {run["state_hash"] for case in raw["cases"] for engine in case["engines"] for run in engine["runs"]}
        self.assertEqual({row["state_hash"] for row in self.results.metrics}, hashes)
        bullet = self.results.run("rigid/ballistic", "bullet")
        self.assertEqual(bullet.body("position").shape[2], 3)

    def test_a_failed_gate_is_a_verdict(self):
        case = self.path / "strict.toml"
        case.write_text(
            (SOURCE / "cases" / "rigid" / "ballistic.toml").read_text().replace("limit = 1e-12", "limit = 1e-300")
        )
        results = tripoint.validate(case, engines=["tripoint"], out=self.path / "strict")
        self.assertEqual((results.verdict, results.exit_code), ("FAIL", 1))

    def test_view_writes_a_page(self):
        page = self.run_.view(out=self.path / "look.html")
        self.assertIn("<html", page.read_text(encoding="utf-8")[:200])

    def test_plots(self):
        axis = self.run_.plot("thermal")
        self.assertEqual(axis.get_ylabel(), "thermal [J]")
        pictures = self.results.plots(self.path / "pictures")
        self.assertTrue(pictures)
        for path in pictures.values():
            self.assertTrue(path.read_bytes().startswith(b"%PDF"))


if __name__ == "__main__":
    os.environ.setdefault("MPLBACKEND", "Agg")
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
