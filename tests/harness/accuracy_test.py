# SPDX-License-Identifier: BSD-3-Clause
"""What tools/accuracy.py keeps of results and says of studies: accuracy_test.py TOOL"""

import contextlib
import importlib.util
import io
import json
import sys
import types
import unittest
from pathlib import Path

TOOL = Path(sys.argv.pop(1)).resolve()
SPEC = importlib.util.spec_from_file_location("accuracy", TOOL)
accuracy = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(accuracy)
DOCS = TOOL.parent.parent / "docs"
FIT = {"value": 2.0, "low": 1.9, "high": 2.1, "class": "plateau", "floor": 0.5, "coefficient": 1.0}


def study(*levels, fit=FIT):
    return {
        "axis": "spacing",
        "metric": "m",
        "mode": "corrected",
        "fit": fit,
        "levels": [
            {"at": 0.1 / (n + 1), "values": list(v), "cpu_s": 1.0, "steps": 1e-3, "particles": 10, "failed": ""}
            for n, v in enumerate(levels)
        ],
    }


def run(spacing, value, seed=1, status="ok"):
    return {
        "knobs": {"mode": "paper", "time_step": 1e-3, "seed": seed},
        "levels": {"spacing": spacing},
        "status": status,
        "metrics": {"m": {"value": value}} if status == "ok" else {},
        "cost": {"cpu_s": 2.0 * seed, "particles": 7},
    }


class Accuracy(unittest.TestCase):
    def test_an_order_is_the_fits_and_its_floor_the_extrapolated_value(self):
        self.assertEqual(
            accuracy.verdict(study([1.5], [0.75], [0.61], [0.56]), "analytic"),
            ("2.00 (1.90 to 2.10), plateau", 2.0, 0.5),
        )

    def test_no_order_where_the_starts_scatter_by_more_than_the_levels_differ(self):
        words, order, _ = accuracy.verdict(study([0.9, 0.91], [0.7, 0.71], [0.60, 0.66], [0.59, 0.65]), "analytic")
        self.assertIsNone(order)
        self.assertIn("no order: scatter 0.06, difference 0.01", words)

    def test_no_order_where_the_fit_has_none_or_levels_are_missing(self):
        self.assertEqual(
            accuracy.verdict(study([1.0], [0.5], [0.7], [0.4], fit=FIT | {"class": "oscillating"}), "analytic")[0],
            "no order: oscillating",
        )
        self.assertEqual(
            accuracy.verdict(study([1.0], [0.5], [0.7]), "analytic")[0],
            "no order: fewer than four levels have a number",
        )
        self.assertEqual(accuracy.verdict(study([1.0], [1.0], [1.0], [1.0]), "analytic")[0], "the same at every level")

    def test_no_order_where_its_interval_holds_zero_or_what_has_no_truth_has_no_limit(self):
        levels = ([1.0], [0.5], [0.4], [0.3])
        self.assertEqual(
            accuracy.verdict(study(*levels, fit=FIT | {"low": -0.1}), "invariant")[0], "no order: 2.00 in -0.10 to 2.10"
        )
        self.assertEqual(
            accuracy.verdict(study(*levels, fit=FIT | {"floor": 0.0}), "invariant")[0],
            "no order: the fit finds no limit",
        )
        self.assertEqual(accuracy.verdict(study(*levels, fit=FIT | {"floor": 0.0}), "analytic")[1], 2.0)

    def test_levels_are_coarse_to_fine_with_all_their_runs(self):
        levels = accuracy.levels_of(
            [run(0.05, 3.0), run(0.1, 1.0), run(0.1, 2.0, seed=2), run(0.02, 0.0, status="diverged")],
            "spacing",
            "m",
            "paper",
        )
        self.assertEqual([level["at"] for level in levels], [0.1, 0.05, 0.02])
        self.assertEqual((levels[0]["values"], levels[0]["cpu_s"], levels[0]["particles"]), ([1.0, 2.0], 3.0, 7))
        self.assertEqual((levels[2]["values"], levels[2]["failed"]), ([], "diverged"))

    def test_the_tables_hold_every_level_of_every_study(self):
        kept = sorted((DOCS / "accuracy").glob("*.json"))
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            accuracy.tables(types.SimpleNamespace(kept=kept))
        levels = [
            (s["axis"], level)
            for path in kept
            for s in json.loads(path.read_text())["studies"]
            for level in s["levels"]
        ]
        self.assertGreater(len(levels), 100)
        for axis, level in levels:
            self.assertIn(
                f"| {1e3 * level['at']:.4g} | {level['particles']} |"
                if level["particles"]
                else f"| {1e3 * level['at']:.4g} |",
                said.getvalue(),
                axis,
            )
            self.assertIn(f"| {accuracy.cell(level)} |", said.getvalue())

    def test_the_page_is_what_the_kept_numbers_make_of_it(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            accuracy.page(types.SimpleNamespace(kept=sorted((DOCS / "accuracy").glob("*.json"))))
        self.assertEqual(said.getvalue(), (DOCS / "accuracy.md").read_text(encoding="utf-8"))
        for path in (DOCS / "accuracy").glob("*.json"):
            self.assertTrue(path.with_suffix(".png").exists(), path)
            self.assertTrue((TOOL.parent.parent / "cases" / f"{json.loads(path.read_text())['case']}.toml").exists())


if __name__ == "__main__":
    unittest.main()
