# SPDX-License-Identifier: BSD-3-Clause
"""What `gate adopt` writes turns red where the engine drifts, to either side, and what it refuses: adopt_test.py
TRIPOINT TOY_ENGINE STONE_ENGINE [unittest arguments]."""

import json
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

TRIPOINT, TOY, STONE = (Path(argument).resolve() for argument in sys.argv[1:4])
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
        return subprocess.run(
            [TRIPOINT, *map(str, words)], cwd=self.path, capture_output=True, text=True, timeout=300, check=False
        )

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
        code = self.call(
            "validate", "cases", "--engine", "./engine-toy", "--engines", "toy", "--no-report", "--no-history"
        ).returncode
        results = json.loads((self.path / "report" / "results.json").read_text())
        red = [
            f"{c['id']} {g['metric']}"
            for c in results["cases"]
            for e in c["engines"]
            for g in e["gates"]
            if g["verdict"] != "pass"
        ]
        return code, red, self.call("gate", "report").returncode

    def gates(self, case):
        return tomllib.loads((self.path / "cases" / f"{case}.toml").read_text())["gate"]

    def test_adoption_writes_green_gates_with_reasons_and_baselines(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        for case in CASES:
            self.assertTrue((self.path / "baselines" / f"{case}.toml").is_file())
            for gate in self.gates(case):
                self.assertEqual(gate["engine"], "toy")
                self.assertRegex(
                    gate["reason"], r"^adopted: (-?[\d.e+-]+ measured|observed order)|^acceptance of any engine"
                )
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

    def test_what_does_not_hold_on_a_second_look_is_taken_back(self):
        for word, code, names in (("nan", 2, ()), ("1", 1, ()), ("1.5", 4, ('"name": "toy"', '"name": "all"'))):
            with self.subTest(word):
                self.engine(*([names] if names else []))
                done = self.call(
                    "gate", "adopt", "--engine", "./engine-toy", "--margin", word, "--out", "lost/cases", CASES[0]
                )
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertFalse((self.path / "lost").exists())
                self.assertNotIn("cases adopted", done.stdout + done.stderr)

    def test_an_engine_that_runs_nothing_has_nothing_to_gate(self):
        self.engine()
        done = self.call("gate", "adopt", "--engine", "./engine-toy", "--out", "none", "heat/cosine-mode")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertFalse((self.path / "none").exists())

    def test_noise_widens_the_room(self):
        self.engine(
            ("NOISE = 0.0", "NOISE = 1e-6"), ("GRAVITY = 1.0", "GRAVITY = 0.999999")
        )  # an error that the noise does not exceed
        done = self.call("gate", "adopt", "--engine", "./engine-toy", "--out", "noisy/cases", "rigid/ballistic")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        gate = next(
            g
            for g in tomllib.loads((self.path / "noisy/cases/rigid/ballistic.toml").read_text())["gate"]
            if g["metric"] == "position"
        )
        self.assertIn("for the noise", gate["reason"])
        self.assertGreater(gate["band"][1] / gate["band"][0], 1.5**2)


class Refused(unittest.TestCase):
    """Engines that nobody should adopt, and what a reason lets pass. Each test has a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint refused ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def adopt(self, source, changes, *words):
        """`gate adopt` of an engine with some of its lines changed."""
        text = source.read_text()
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after)
        script = self.path / source.name
        script.write_text(text)
        script.chmod(0o755)
        command = [TRIPOINT, "gate", "adopt", "--engine", f"./{source.name}", "--out", "cases", *words]
        return subprocess.run(command, cwd=self.path, capture_output=True, text=True, timeout=300, check=False)

    def case(self, name):
        return tomllib.loads((self.path / "cases" / f"{name}.toml").read_text())

    def assert_refused(self, done, code, *said):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for words in said:
            self.assertIn(words, done.stdout)
        self.assertFalse((self.path / "cases").exists(), "nothing is written of what is refused")
        self.assertFalse((self.path / "baselines").exists())

    def test_the_scene_is_kept_whole(self):
        done = self.adopt(STONE, [], "contact/slope-slip", "contact/ball-restitution-050")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(
            self.case("contact/slope-slip")["engines"]["all"]["settings"], {"friction": 0.3, "restitution": 0.0}
        )
        self.assertEqual(
            self.case("contact/ball-restitution-050")["engines"]["all"]["settings"],
            {"friction": 0.3, "restitution": 0.5},
        )

    def test_an_engine_without_friction_is_refused(self):
        done = self.adopt(STONE, [("FRICTION = 1.0 ", "FRICTION = 0.0 ")], "contact/slope-slip", "contact/slope-stick")
        self.assert_refused(
            done,
            1,
            "contact/slope-stick: NOT ADOPTED: creep fails a limit that holds for any engine",
            "contact/slope-slip: NOT ADOPTED: velocity fails",
        )

    def test_an_engine_without_restitution_is_refused(self):
        done = self.adopt(STONE, [("RESTITUTION = 1.0 ", "RESTITUTION = 0.0 ")], "contact/ball-restitution-050")
        self.assert_refused(done, 1, "contact/ball-restitution-050: NOT ADOPTED: rebound fails")

    def test_an_engine_without_contact_is_refused(self):
        done = self.adopt(
            STONE,
            [("ground = None if floor is None else", "ground = None if True else")],
            "contact/ball-restitution-000",
            "contact/slope-stick",
        )
        self.assert_refused(
            done, 1, "contact/ball-restitution-000: NOT ADOPTED: sunk fails", "contact/slope-stick: NOT ADOPTED: "
        )

    def test_an_engine_without_gyroscopic_term_is_refused(self):
        changes = [("GYROSCOPIC = 1.0 ", "GYROSCOPIC = 0.0 ")]
        self.assert_refused(
            self.adopt(STONE, changes, "rigid/torque-free"),
            1,
            "rigid/torque-free: NOT ADOPTED: angle at 0.01 fails a limit",
        )
        self.assert_refused(
            self.adopt(STONE, changes, "rigid/flip-time"),
            4,
            "rigid/flip-time: NOT ADOPTED: flip has no finite value: the body never flips",
        )
        self.assert_refused(
            self.adopt(STONE, changes, "rigid/precession", "rigid/long-spin"),
            1,
            "rigid/precession: NOT ADOPTED: ",
            "rigid/long-spin: NOT ADOPTED: ",
        )

    def test_what_is_sound_is_adopted_beside_what_is_refused(self):
        done = self.adopt(
            STONE, [("FRICTION = 1.0 ", "FRICTION = 0.0 ")], "contact/slope-slip", "contact/ball-restitution-050"
        )
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertFalse((self.path / "cases/contact/slope-slip.toml").exists())
        self.assertTrue((self.path / "baselines/contact/ball-restitution-050.toml").exists())

    def test_a_reason_adopts_what_fails_and_stands_in_the_case_and_its_baseline(self):
        done = self.adopt(
            STONE,
            [("FRICTION = 1.0 ", "FRICTION = 0.0 ")],
            "contact/slope-slip",
            "--despite",
            "friction comes with 2.0",
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("friction comes with 2.0", self.case("contact/slope-slip")["case"]["claims"])
        self.assertIn(
            "# Despite: velocity fails a limit that holds for any engine",
            (self.path / "cases/contact/slope-slip.toml").read_text(),
        )
        self.assertIn("friction comes with 2.0", (self.path / "baselines/contact/slope-slip.toml").read_text())
        done = self.adopt(STONE, [], "contact/slope-slip", "--overwrite", "--despite", " ")
        self.assertEqual(done.returncode, 2, "a reason says something")

    def test_an_untrue_flag_is_named(self):
        chance = (
            "        yield [t, body",
            "        x = [c + 1e-7 * float.fromhex('0x' + os.urandom(4).hex()) / 2**32 for c in x] if t > 0 else x\n  "
            "      yield [t, body",
        )
        done = self.adopt(STONE, [chance], "rigid/ballistic")
        self.assert_refused(
            done,
            1,
            "rigid/ballistic: NOT ADOPTED: stone says that it is deterministic, and that is untrue: centre is 0.0",
        )
        done = self.adopt(STONE, [chance, ('"deterministic": True', '"deterministic": False')], "rigid/ballistic")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("over 6 runs and seeds", self.case("rigid/ballistic")["gate"][0]["reason"])

    def own(self, text):
        file = self.path / "own.toml"
        file.write_text('extends = "rigid/ballistic"\ncase.id = "own"\n' + text)
        return str(file)

    def test_a_metric_without_a_value_refuses_the_case_whatever_the_reason(self):
        case = self.own('[[metric]]\nname = "heat"\nquantity = "temperature"\n')
        self.assert_refused(
            self.adopt(TOY, [], case, "--despite", "no heat here"), 4, "NOT ADOPTED: heat has no finite value"
        )

    def test_chance_above_the_value_is_no_room(self):
        case = self.own('remove = ["gate"]\n[[gate]]\nmetric = "position"\nlimit = 0.5\nreason = "any"\n')
        done = self.adopt(TOY, [("NOISE = 0.0", "NOISE = 0.05")], case)
        self.assertIn("the noise of position exceeds its value", done.stdout)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertFalse((self.path / "cases").exists())

    def test_a_study_of_the_engine_stays_and_the_case_is_gated_at_its_own_step(self):
        case = self.own(
            '[engines.stone]\n[[study]]\naxis = "time_step"\nlevels = [0.008, 0.004, 0.002]\nengine = "stone"\n'
        )
        done = self.adopt(STONE, [], case)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        gates = self.case("own")["gate"]
        self.assertEqual(
            [g["level"] for g in gates if g["metric"] == "position"], [0.01, 0.01]
        )  # what was measured, and the limit of any engine
        self.assertIn("position.order", [g["metric"] for g in gates])

    def test_every_preset_is_taken(self):
        done = self.adopt(STONE, [('"presets": ["default"]', '"presets": ["default", "fine"]')], "contact/slope-slip")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        case = self.case("contact/slope-slip")
        self.assertEqual(case["engines"]["stone"], {"required": True, "adopted": True, "preset": ["default", "fine"]})
        self.assertEqual({g["preset"] for g in case["gate"]}, {"default", "fine"})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
