# SPDX-License-Identifier: BSD-3-Clause
"""Wrong engines, each a right one whose answer is spoilt in one way, are refused by name: wrong_engines_test.py
TRIPOINT [unittest arguments]."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = Path(sys.argv[1]).resolve()
ENGINES = TRIPOINT.parent.parent / "libexec" / "tripoint"
WRONG = Path(__file__).resolve().parent / "wrong" / "engine-wrong"
VALUE, MOVES, TURNS = (
    "no unit quaternion",
    "moves otherwise than its velocity says",
    "turns otherwise than its angular velocity says",
)

# case, engine that is right, what is spoilt, words of the refusal
SPOILT = (
    ("rigid/torque-free", "tripoint", "zero orientation", VALUE),
    ("rigid/precession", "tripoint", "zero orientation", VALUE),
    ("rigid/hundred-turns", "tripoint", "zero orientation", VALUE),
    ("rigid/torque-free", "tripoint", "long orientation", VALUE),
    ("rigid/torque-free", "tripoint", "infinite spin", "is not finite"),
    ("rigid/torque-free", "tripoint", "spin of the wrong sign", TURNS),
    ("rigid/precession", "tripoint", "spin in the body's frame", TURNS),
    ("rigid/precession", "tripoint", "conjugated orientation", TURNS),
    ("rigid/hundred-turns", "tripoint", "spin of the wrong sign", TURNS),
    ("contact/roll-down-slope", "bullet", "no spin", TURNS),
    ("contact/tower-1", "bullet", "swapped bodies", MOVES),
    ("contact/ball-restitution-100", "bullet", "teleport", MOVES),
    ("rigid/ballistic", "tripoint", "places a frame late", MOVES),
    ("rigid/ballistic", "tripoint", "places a step late", MOVES),
    ("rigid/ballistic", "tripoint", "speed 0.05 % off", MOVES),
    ("rigid/ballistic", "tripoint", "mirrored speed", MOVES),
    ("rigid/ballistic", "tripoint", "copied frame", "frozen"),
)


class WrongEngines(unittest.TestCase):
    def answer(self, case, engine, way):
        """Exit code of a validation, and what it says of the spoilt engine."""
        environment = os.environ | {"WRONG_ENGINE": str(ENGINES / f"engine-{engine}"), "WRONG": way}
        with tempfile.TemporaryDirectory() as folder:
            words = [
                TRIPOINT,
                "validate",
                case,
                "--engine",
                WRONG,
                "--engines",
                "wrong",
                "--no-report",
                "--no-history",
                "--out",
                f"{folder}/out",
            ]
            done = subprocess.run(
                [str(w) for w in words], capture_output=True, text=True, timeout=300, check=False, env=environment
            )
            results = json.loads(Path(folder, "out", "results.json").read_text(encoding="utf-8"))
        return done.returncode, [e["reason"] for e in results["cases"][0]["engines"] if e["name"] == "wrong"]

    def test_each_is_refused_by_name(self):
        for case, engine, way, words in SPOILT:
            with self.subTest(f"{case}, {engine}: {way}"):
                code, reasons = self.answer(case, engine, way)
                self.assertEqual(code, 4)
                self.assertIn(words, " ".join(reasons))

    def test_the_same_engine_unspoilt_is_not(self):
        for case, engine in sorted({row[:2] for row in SPOILT}):
            with self.subTest(f"{case}, {engine}"):
                self.assertEqual(self.answer(case, engine, "")[1], [""])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
