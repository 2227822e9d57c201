# SPDX-License-Identifier: BSD-3-Clause
"""What `gate adopt` writes turns red where the engine drifts, to either side: adopt_test.py TRIPOINT TOY_ENGINE [unittest arguments]."""
import json
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

TRIPOINT, TOY = (Path(argument).resolve() for argument in sys.argv[1:3])
CASES = ("rigid/ballistic", "rigid/torque-free")


class Adopted(unittest.TestCase):
    """One adoption for all tests: the engine is sound then, and each test changes it once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint adopt ")
        cls.path = Path(cls.folder.name)
        cls.engine(cls)
        cls.done = cls.call(cls, "gate", "adopt", "--engine", "./engine-toy", "--out", "cases", *CASES)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def call(self, *words):
        return subprocess.run([TRIPOINT, *map(str, words)], cwd=self.path, capture_output=True, text=True, timeout=300, check=False)

    def engine(self, *changes):
        """The sound engine, or with some of its constants changed."""
        text = TOY.read_text()
        for before, after in changes:
            assert before in text, before
            text = text.replace(before, after)
        script = self.path / "engine-toy"
        script.write_text(text)
        script.chmod(0o755)

    def judged(self, *changes):
        """@return (exit code of validate, [case and metric that is red], exit code of gate)"""
        self.engine(*changes)
        code = self.call("validate", "cases", "--engine", "./engine-toy", "--engines", "toy", "--no-report", "--no-history").returncode
        results = json.loads((self.path / "report" / "results.json").read_text())
        red = [f"{c['id']} {g['metric']}" for c in results["cases"] for e in c["engines"] for g in e["gates"] if g["verdict"] != "pass"]
        return code, red, self.call("gate", "report").returncode

    def gates(self, case):
        return tomllib.loads((self.path / "cases" / f"{case}.toml").read_text())["gate"]

    def test_adoption_writes_green_gates_with_reasons_and_baselines(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        for case in CASES:
            self.assertTrue((self.path / "baselines" / f"{case}.toml").is_file())
            for gate in self.gates(case):
                self.assertEqual(gate["engine"], "toy")
                self.assertRegex(gate["reason"], r"^adopted: (-?[\d.e+-]+ measured|observed order)")
        bands = [gate for case in CASES for gate in self.gates(case) if "band" in gate and gate["metric"] == "angle"]
        low, high = bands[0]["band"]
        self.assertAlmostEqual(high / low, 1.5**2, 3)  # the margin to either side
        code, red, gated = self.judged()
        self.assertEqual((code, red, gated), (0, [], 0))

    def test_gravity_off_by_two_per_cent_is_red(self):
        code, red, gated = self.judged(("GRAVITY = 1.0", "GRAVITY = 1.02"))
        self.assertEqual((code, gated), (1, 1))
        self.assertIn("rigid/ballistic position", red)

    def test_a_moment_of_inertia_off_by_one_per_cent_is_red(self):
        code, red, gated = self.judged(("INERTIA = 1.0", "INERTIA = 1.01"))
        self.assertEqual((code, gated), (1, 1))
        self.assertIn("rigid/torque-free angle", red)

    def test_an_error_that_becomes_smaller_is_red_too(self):
        code, red, gated = self.judged(("SUBSTEPS = 1", "SUBSTEPS = 2"))
        self.assertEqual((code, gated), (1, 1))
        self.assertIn("rigid/ballistic position", red)
        self.assertIn("rigid/torque-free angle", red)

    def test_a_file_that_is_there_is_never_overwritten(self):
        self.engine()
        before = (self.path / "cases/rigid/ballistic.toml").read_text()
        done = self.call("gate", "adopt", "--engine", "./engine-toy", "--out", "cases", "rigid/ballistic")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--overwrite", done.stderr)
        self.assertEqual((self.path / "cases/rigid/ballistic.toml").read_text(), before)

    def test_an_engine_that_runs_nothing_has_nothing_to_gate(self):
        self.engine()
        done = self.call("gate", "adopt", "--engine", "./engine-toy", "--out", "none", "heat/cosine-mode")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertFalse((self.path / "none").exists())

    def test_noise_widens_the_room(self):
        self.engine(("NOISE = 0.0", "NOISE = 1e-3"))
        done = self.call("gate", "adopt", "--engine", "./engine-toy", "--out", "noisy/cases", "rigid/ballistic")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        gate = next(g for g in tomllib.loads((self.path / "noisy/cases/rigid/ballistic.toml").read_text())["gate"] if g["metric"] == "position")
        self.assertIn("for the noise", gate["reason"])
        self.assertGreater(gate["band"][1] / gate["band"][0], 1.5**2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
