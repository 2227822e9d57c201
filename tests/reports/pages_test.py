# SPDX-License-Identifier: BSD-3-Clause
"""What the pages on cost, corrections and engines and the report to sign must do: python3 pages_test.py"""

import contextlib
import io
import json
import math
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]
import ablation
import digit_cost
import load
import page
import paper_figures
import report
import side_by_side
from report_test import Reader


def ladder(order, power, name="tripoint", finest=None, **more):
    """Runs whose error falls with the order and whose cost grows with the power of 1/spacing."""
    runs = [
        {
            "knobs": {"mode": "corrected", "spacing": h, "time_step": h},
            "levels": {"spacing": h},
            "base": h == 0.1,
            "status": "ok",
            "metrics": {"error": {"value": h**order}},
            "cost": {"cpu_s": h**-power, "pairs": 7 * h**-power},
        }
        for h in (0.1, 0.05, 0.025)
    ]
    if finest:
        runs[-1].update(finest)
    return {"name": name, "status": "ok", "runs": runs, "gates": [], **more}


def study(order=2.0):
    return {"axis": "spacing", "levels": [0.1, 0.05, 0.025], "metric": "error", "order": order}


def case(engines, case_id="heat/one", **more):
    return {
        "id": case_id,
        "title": "One",
        "kind": "verification",
        "requirement": "R-1",
        "claims": "it holds",
        "verdict": "PASS",
        "metrics": [{"name": "error", "unit": "K"}],
        "engines": engines,
        "repeat": "tripoint validate one",
        **more,
    }


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def load(self, *cases):
        (self.path / "results.json").write_text(json.dumps({"format": 1, "verdict": "PASS", "cases": list(cases)}))
        return load.load(self.path / "results.json")

    def write(self, *cases, words=()):
        self.load(*cases)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            code = report.main([str(self.path / "results.json"), "--jobs", "1", *words])
        return code

    def text(self, name):
        return Reader((self.path / name).read_text(encoding="utf-8")).text


class DigitCost(Pages):
    def test_a_tenth_of_the_error_costs_what_the_slopes_say(self):
        found = digit_cost.read(self.load(case([ladder(2.0, 5.0)], studies=[study()])))
        self.assertAlmostEqual(found[0].factor, 10**2.5, places=6)  # cost ~ error^(-5/2)
        self.assertAlmostEqual(found[0].factor_pairs, 10**2.5, places=6)
        self.assertAlmostEqual(found[0].factor_theory, 10**2.0, places=6)  # dt ~ dx: (3 + 1) / 2

    def test_a_plateau_is_said_and_not_drawn_as_a_slope(self):
        engine = ladder(2.0, 5.0)
        for run in engine["runs"]:
            run["metrics"]["error"]["value"] = 0.07 + 1e-3 * run["knobs"]["spacing"]
        found = digit_cost.read(self.load(case([engine], studies=[study()])))
        self.assertIsNone(found[0].factor)
        self.assertIn("no accuracy", found[0].why)

    def test_levels_close_together_are_judged_by_how_close_they_are(self):
        engine = ladder(2.0, 5.0)
        for run, spacing, error in zip(
            engine["runs"], (5e-4, 3e-4, 2.5e-4), (2.3e-3, 1.5e-3, 1.35e-3)
        ):  # order 0.7, the last two a sixth apart
            run["levels"]["spacing"] = run["knobs"]["spacing"] = spacing
            run["metrics"]["error"]["value"] = error
            run["cost"] = {"cpu_s": spacing**-4.0, "pairs": spacing**-4.0}
        found = digit_cost.read(self.load(case([engine], studies=[study()])))
        self.assertAlmostEqual(
            math.log10(found[0].factor), 4.0 * math.log(2.0) / math.log(2.3 / 1.35), places=9
        )  # between 5e-4 and 2.5e-4
        self.write(case([engine], studies=[study()]))
        self.assertIn(f"{float(f'{found[0].factor:.3g}'):,.0f} ×", self.text("digit-cost.html"))

    def test_a_level_that_failed_is_shown(self):
        self.write(
            case(
                [ladder(2.0, 5.0, finest={"status": "diverged", "reason": "particle 7", "metrics": {}})],
                studies=[study()],
            )
        )
        self.assertIn("0.025: particle 7", self.text("digit-cost.html"))

    def test_what_lies_inside_the_noise_floor_is_not_resolved(self):
        engine = ladder(2.0, 5.0, finest={"cost": {"cpu_s": 0.05**-5 * 1.25, "pairs": 1.0}})
        found = digit_cost.read(self.load(case([engine], studies=[study()], timing={"rounds": 5, "noise_floor": 1.3})))
        self.assertIsNone(found[0].factor)
        self.assertIn("not resolved", found[0].why)
        found = digit_cost.read(self.load(case([engine], studies=[study()], timing={"rounds": 5, "noise_floor": 1.1})))
        self.assertIsNotNone(found[0].factor)

    def test_seconds_are_the_median_of_the_timed_rounds(self):
        engine = ladder(2.0, 5.0, finest={"cost": {"cpu_s": 9.0, "timed": {"cpu_s": [1.0, 2.0, 7.0], "median": 2.0}}})
        self.assertEqual(self.load(case([engine])).cases[0].engines[0].runs[-1].cost["cpu_s"], 2.0)

    def test_what_has_no_study_is_not_on_the_page(self):
        self.assertEqual(digit_cost.read(self.load(case([ladder(2.0, 5.0)]))), [])

    def test_cases_without_a_study_are_named(self):
        self.write(case([ladder(2.0, 5.0)], studies=[study()]), case([ladder(2.0, 5.0)], "phase/bare"))
        text = self.text("digit-cost.html")
        self.assertIn("Cases without a study: 1", text)
        self.assertIn("phase/bare", text[text.index("Cases without a study") :])
        self.assertNotIn("heat/one", text[text.index("Cases without a study") :])


class PaperFigures(Pages):
    def test_figure_8_stands_before_figure_10(self):
        titles = ["Figure 10: cold", "Figure 8: rigid", "Figure 11", "Table 1", "Figure 1: merge"]
        cases = [
            {**case([ladder(2.0, 5.0)], f"paper/{n}"), "title": title, "tags": ["paper"]}
            for n, title in enumerate(titles)
        ]
        self.assertEqual(
            [row.case.title for row in paper_figures.read(self.load(*cases))],
            ["Figure 1: merge", "Figure 8: rigid", "Figure 10: cold", "Figure 11", "Table 1"],
        )


class Corrections(Pages):
    def ablate(self, printed, corrected=0.01):
        run = lambda value: {"status": "ok", "metrics": {"error": {"value": value}}}
        (self.path / "ablation.json").write_text(
            json.dumps(
                {
                    "format": 1,
                    "cases": [
                        {
                            "id": "heat/one",
                            "title": "One",
                            "metrics": [{"name": "error", "unit": "K"}],
                            "corrected": run(corrected),
                            "printed": {
                                term: value if isinstance(value, dict) else run(value)
                                for term, value in printed.items()
                            },
                        }
                    ],
                }
            )
        )
        return ablation.read(self.path)

    def test_a_cell_is_how_many_times_larger_the_error_is(self):
        terms, rows, notes = self.ablate({"heat": -0.05, "time": 0.0101, "kernel": 0.005})
        self.assertEqual((terms, notes), (["kernel", "heat", "time"], []))
        self.assertAlmostEqual(rows[0].cells["heat"].factor, 5.0)
        self.assertEqual([rows[0].cells[t].tone for t in ("heat", "time", "kernel")], ["fail", "none", "pass"])

    def test_round_off_against_round_off_is_the_same(self):
        _, rows, _ = self.ablate({"heat": 3e-16}, corrected=1e-17)
        self.assertEqual(rows, [])

    def test_a_form_that_diverges_is_a_word(self):
        _, rows, _ = self.ablate({"heat": {"status": "diverged", "metrics": {}}})
        self.assertEqual(rows[0].cells["heat"].word, "diverged")

    def test_without_its_file_the_page_says_how_to_make_it(self):
        self.write(case([ladder(2.0, 5.0)]))
        self.assertFalse((self.path / "corrections.html").exists())
        self.assertIn("tripoint ablate", page.render_ablation(self.load(case([ladder(2.0, 5.0)]))))


class SideBySide(Pages):
    def test_the_nearest_engine_is_marked_and_cost_is_relative(self):
        gates = [
            {"metric": "error", "mode": "corrected", "value": 0.01, "limit": 1.0, "verdict": "pass", "reason": "r"}
        ]
        found = side_by_side.read(self.load(case([ladder(2.0, 5.0, gates=gates), ladder(1.0, 2.0, name="bullet")])))
        cells = found[0].metrics[0][2]
        self.assertEqual(
            [(label, c.best, c.verdict) for label, c in cells.items()],
            [("tripoint, corrected", True, "PASS"), ("bullet, corrected", False, "")],
        )
        self.assertAlmostEqual(found[0].cost["tripoint, corrected"][1], 1000.0)

    def test_nothing_of_an_engine_that_is_wrong_in_a_case_is_green_or_bold(self):
        gate = {"mode": "corrected", "value": 0.01, "limit": 1.0, "verdict": "pass", "physics": "right", "reason": "r"}
        gates = [{**gate, "metric": "error"}, {**gate, "metric": "spin", "verdict": "fail", "physics": "wrong"}]
        mine, other = ladder(2.0, 5.0, name="mine", gates=gates), ladder(1.0, 2.0, gates=[{**gate, "metric": "error"}])
        results = self.load(case([mine, other]))
        cells = side_by_side.read(results)[0].metrics[0][2]
        self.assertEqual([(c.best, c.off) for c in cells.values()], [(False, True), (True, False)])
        self.assertEqual(page.render_side_by_side(results).count("within its limit"), 1)

    def test_a_ratio_inside_the_noise_floor_is_not_resolved_and_without_one_that_is_said(self):
        engines = [ladder(2.0, 5.0), ladder(1.0, 4.99, name="bullet")]
        self.write(case(engines, timing={"rounds": 5, "noise_floor": 1.1}))
        self.assertIn("not resolved", self.text("engines.html"))
        self.write(case(engines, timing={"rounds": 5, "noise_floor": 1.001}))
        self.assertNotIn("cheapest, not resolved", self.text("engines.html"))
        self.write(case(engines))
        self.assertIn("no noise floor was measured", self.text("engines.html"))

    def test_own_engines_stand_first_and_those_that_did_not_run_below_with_the_reason(self):
        refused = {"name": "slow", "preset": "default", "status": "refused", "reason": "no conduction", "runs": []}
        results = self.load(case([ladder(2.0, 5.0), refused, ladder(1.0, 4.0, name="mine")]))
        results.command = "tripoint validate heat --engines all,./engine-mine"
        found = side_by_side.read(results)[0]
        self.assertEqual(found.columns, ["mine, corrected", "tripoint, corrected"])
        self.assertEqual((found.own, list(found.absent)), (["mine, corrected"], ["no conduction"]))
        html = page.render_side_by_side(results)
        self.assertLess(html.index("mine, corrected"), html.index("tripoint, corrected"))
        self.assertIn('data-label="error"', html)  # a telephone shows each number with its name

    def test_a_case_of_one_engine_is_no_comparison(self):
        self.assertEqual(side_by_side.read(self.load(case([ladder(2.0, 5.0)]))), [])


class History(Pages):
    def line(self, date, used, verdict="pass", **more):
        return json.dumps(
            {
                "format": 1,
                "case": "heat/one",
                "date": date,
                "commit": "abc",
                "gates": [
                    {
                        "engine": "tripoint",
                        "mode": "corrected",
                        "metric": "error",
                        "level": None,
                        "value": 0.1,
                        "used": used,
                        "verdict": verdict,
                    }
                ],
                **more,
            }
        )

    def test_is_a_strip_from_two_runs_on_with_a_mark_where_figures_were_accepted(self):
        (self.path / "history.jsonl").write_text(self.line("2026-11-20", 0.5) + "\n")
        self.write(case([ladder(2.0, 5.0)]))
        self.assertNotIn("History: share", self.text("case/heat-one.html"))
        with open(self.path / "history.jsonl", "a") as file:
            file.write(
                self.line("2026-11-21", 0.9)
                + "\n"
                + json.dumps({"format": 1, "case": "heat/one", "date": "2026-11-21", "accepted": "why"})
                + "\n"
                + self.line("2026-11-22", 1.4, "fail")
                + "\n"
            )
        found = self.load(case([ladder(2.0, 5.0)])).cases[0].history
        self.assertEqual(
            [(e.date[-2:], e.accepted) for e in found], [("20", ""), ("21", ""), ("21", "why"), ("22", "")]
        )
        self.write(case([ladder(2.0, 5.0)]))
        self.assertIn("History: share", self.text("case/heat-one.html"))

    def test_torn_lines_are_counted_and_cost_no_report(self):
        (self.path / "history.jsonl").write_text(self.line("2026-11-20", 0.5) + '\n{"format": 1, "ca\n[]\n')
        self.assertIn("2 lines of history.jsonl could not be read", self.load(case([])).notes)

    def test_the_same_run_written_twice_is_one(self):
        (self.path / "history.jsonl").write_text((self.line("2026-11-20", 0.5) + "\n") * 2)
        self.assertEqual(len(self.load(case([])).cases[0].history), 1)


class Signable(Pages):
    def test_every_requirement_gate_and_uncertainty_is_in_it(self):
        gates = [
            {
                "metric": "error",
                "mode": "corrected",
                "value": 0.01,
                "uncertainty": 0.002,
                "budget": {"numerical": 0.002, "statistical": 0, "input": 0, "data": 0},
                "limit": 1.0,
                "verdict": "pass",
                "reason": "r",
            }
        ]
        self.write(
            case(
                [ladder(2.0, 5.0, gates=gates)],
                gates=[{"metric": "error", "date": "2026-11-21", "reason": "waived for now"}],
            )
        )
        text = self.text("signable.html")
        for words in (
            "R-1",
            "heat/one",
            "it holds",
            "0.002",
            "waived for now",
            "tripoint validate one",
            "What is not validated",
            "Reviewer",
        ):
            self.assertIn(words, text)

    def test_its_hash_is_that_of_the_results(self):
        import hashlib

        self.write(case([ladder(2.0, 5.0)]))
        self.assertIn(hashlib.sha256((self.path / "results.json").read_bytes()).hexdigest(), self.text("signable.html"))

    @unittest.skipUnless(shutil.which("weasyprint"), "weasyprint is not installed")
    def test_the_pdf_is_one(self):
        self.assertEqual(self.write(case([ladder(2.0, 5.0)]), words=["--pdf"]), 0)
        self.assertEqual((self.path / "report.pdf").read_bytes()[:5], b"%PDF-")


class CasePages(Pages):
    def test_limits_of_one_value_stand_under_one_name(self):
        gates = [
            {"metric": "error", "mode": "corrected", "value": 0.25, "limit": limit, "verdict": "pass", "reason": reason}
            for limit, reason in ((0.5, "own"), (2.0, "acceptance"))
        ]
        self.write(case([{"name": "tripoint", "status": "ok", "runs": [], "gates": gates}]))
        html = (self.path / "case" / "heat-one.html").read_text()
        self.assertEqual(html.count('<td rowspan="2">error'), 1)
        for words in ("own", "acceptance"):
            self.assertIn(words, self.text("case/heat-one.html"))

    def test_a_count_that_is_right_is_said_to_be_equal(self):
        gates = [{"metric": "error", "mode": "corrected", "value": 0.0, "limit": 0.5, "verdict": "pass", "reason": "r"}]
        engine = {"name": "tripoint", "status": "ok", "runs": [], "gates": gates}
        self.write(case([engine], metrics=[{"name": "error", "quantity": "body_count"}]))
        self.assertIn("corrected 0, equal", self.text("case/heat-one.html"))
        self.write(case([engine], metrics=[{"name": "error", "quantity": "position"}]))
        self.assertNotIn("equal", self.text("case/heat-one.html"))


if __name__ == "__main__":
    unittest.main()
