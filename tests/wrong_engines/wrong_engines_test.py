# SPDX-License-Identifier: BSD-3-Clause
"""Engines that are wrong, each by one fault of faults.py: wrong_engines_test.py TRIPOINT SOURCE [FAULT]...

Each must be red in its case by a limit of any engine, or by the audit, that its row names. Without the fault the same
engine must be green there. The table that is printed says which gate saw what."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from faults import FAULTS, HARMLESS

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
CHOSEN = sys.argv[3:] or list(FAULTS)
WRONG = Path(__file__).resolve().parent / "engine-wrong"
SLOW = 2e5  # walkers above which a fault is left to those who ask for it by name


class Judged:
    """What the case says of the engine: red limits of any engine with their values, green ones, and why the run is no
    result."""

    def __init__(self, case, fault):
        environment = os.environ | {
            "WRONG": fault,
            "WRONG_ENGINES": str(TRIPOINT.parent.parent / "libexec" / "tripoint"),
        }
        with tempfile.TemporaryDirectory(prefix="tripoint wrong ") as folder:
            words = [
                TRIPOINT,
                "validate",
                SOURCE / "cases" / f"{case}.toml",
                "--engine",
                WRONG,
                "--engines",
                "wrong",
                "--no-report",
                "--no-history",
            ]
            done = subprocess.run(
                words, cwd=folder, env=environment, capture_output=True, text=True, timeout=600, check=False
            )
            file = Path(folder) / "report" / "results.json"
            if not file.exists():
                raise AssertionError(done.stdout + done.stderr)
            result = json.loads(file.read_text())["cases"][0]
        self.code = done.returncode
        engine = next(row for row in result["engines"] if row["name"] == "wrong")
        lines = {gate["line"] for gate in result["gates"] if not gate["engine"]}
        rows = [row for row in engine["gates"] if row["line"] in lines]
        self.red = {row["metric"]: row["value"] for row in rows if row["verdict"] == "fail"}
        self.green = {row["metric"] for row in rows} - {row["metric"] for row in rows if row["verdict"] != "pass"}
        self.audit = next((run["reason"] for run in engine["runs"] if run["status"] == "error"), "")


def seen(fault, judged):
    """By what of the names that the fault's row asks for the engine is red, with what was measured there."""
    if judged.code == 0:
        return ""
    if judged.audit:  # a run that contradicts itself comes to no gate
        return judged.audit
    if judged.code == 3 and fault.seen_by == ("inconclusive",):
        return "inconclusive"
    return "; ".join(f"{name} {judged.red[name]:.3g}" for name in fault.seen_by if name in judged.red)


class WrongEngines(unittest.TestCase):
    right = {}

    @classmethod
    def tearDownClass(cls):
        if len(cls.table) > 1:
            print("\n| " + " |\n| ".join(" | ".join(row) for row in cls.table) + " |")

    table = [("engine", "fault", "case", "seen by")]

    def test_each_is_red_where_its_row_says_and_the_right_one_is_green(self):
        for name in CHOSEN:
            fault = FAULTS.get(name)
            if fault is None:
                continue
            if fault.walkers > SLOW and not sys.argv[3:]:
                continue
            with self.subTest(f"{name}: {fault.words}; {fault.case}"):
                if fault.case not in self.right:
                    self.right[fault.case] = Judged(fault.case, "")
                right = self.right[fault.case]
                self.assertEqual((right.code, right.red, right.audit), (0, {}, ""), "the engine without the fault")
                judged = Judged(fault.case, name)
                by = seen(fault, judged)
                self.table.append((name, fault.words, fault.case, by or "NOTHING"))
                self.assertTrue(
                    by,
                    f"not red by {' or '.join(fault.seen_by)}: exit {judged.code}, red {judged.red}, audit "
                    f"{judged.audit!r}",
                )

    def test_a_right_engine_may_write_as_it_likes(self):
        for name, way in HARMLESS.items():
            if CHOSEN == list(FAULTS) or name in CHOSEN:
                with self.subTest(f"{name}: {way.words}; {way.case}"):
                    judged = Judged(way.case, name)
                    self.assertEqual((judged.code, judged.red, judged.audit), (0, {}, ""))

    def test_there_are_sixteen_at_least_and_each_has_a_case_that_is_shipped(self):
        self.assertGreaterEqual(len(FAULTS), 16)
        for fault in FAULTS.values():
            self.assertTrue((SOURCE / "cases" / f"{fault.case}.toml").exists(), fault.case)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
