# SPDX-License-Identifier: BSD-3-Clause
"""What the pages on cost, corrections and engines and the report to sign must do: python3 pages_test.py"""
import contextlib
import io
import json
import math
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]
import ablation  # noqa: E402
import digit_cost  # noqa: E402
import front  # noqa: E402
import headline_pictures  # noqa: E402
import headlines  # noqa: E402
import load  # noqa: E402
import model  # noqa: E402
import page  # noqa: E402
import paper_figures  # noqa: E402
import releases  # noqa: E402
import report  # noqa: E402
import side_by_side  # noqa: E402
from report_test import Reader  # noqa: E402


def ladder(order, power, name="tripoint", finest=None, **more):
    """Runs whose error falls with the order and whose cost grows with the power of 1/spacing."""
    runs = [{"knobs": {"mode": "corrected", "spacing": h, "time_step": h}, "levels": {"spacing": h}, "base": h == 0.1, "status": "ok", "metrics": {"error": {"value": h ** order}},
             "cost": {"cpu_s": h ** -power, "pairs": 7 * h ** -power}} for h in (0.1, 0.05, 0.025)]
    if finest:
        runs[-1].update(finest)
    return {"name": name, "status": "ok", "runs": runs, "gates": [], **more}


def study(order=2.0):
    return {"axis": "spacing", "levels": [0.1, 0.05, 0.025], "metric": "error", "order": order}


def case(engines, case_id="heat/one", **more):
    return {"id": case_id, "title": "One", "kind": "verification", "requirement": "R-1", "claims": "it holds", "verdict": "PASS", "metrics": [{"name": "error", "unit": "K"}], "engines": engines, "repeat": "tripoint validate one", **more}


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
        self.assertAlmostEqual(found[0].factor, 10 ** 2.5, places=6)       # cost ~ error^(-5/2)
        self.assertAlmostEqual(found[0].factor_pairs, 10 ** 2.5, places=6)
        self.assertAlmostEqual(found[0].factor_theory, 10 ** 2.0, places=6)  # dt ~ dx: (3 + 1) / 2

    def test_a_plateau_is_said_and_not_drawn_as_a_slope(self):
        engine = ladder(2.0, 5.0)
        for run in engine["runs"]:
            run["metrics"]["error"]["value"] = 0.07 + 1e-3 * run["knobs"]["spacing"]
        found = digit_cost.read(self.load(case([engine], studies=[study()])))
        self.assertIsNone(found[0].factor)
        self.assertIn("no accuracy", found[0].why)

    def test_levels_close_together_are_judged_by_how_close_they_are(self):
        engine = ladder(2.0, 5.0)
        for run, spacing, error in zip(engine["runs"], (5e-4, 3e-4, 2.5e-4), (2.3e-3, 1.5e-3, 1.35e-3)):  # order 0.7, the last two a sixth apart
            run["levels"]["spacing"] = run["knobs"]["spacing"] = spacing
            run["metrics"]["error"]["value"] = error
            run["cost"] = {"cpu_s": spacing ** -4.0, "pairs": spacing ** -4.0}
        found = digit_cost.read(self.load(case([engine], studies=[study()])))
        self.assertAlmostEqual(math.log10(found[0].factor), 4.0 * math.log(2.0) / math.log(2.3 / 1.35), places=9)  # between 5e-4 and 2.5e-4
        self.write(case([engine], studies=[study()]))
        self.assertIn(f"{float(f'{found[0].factor:.3g}'):,.0f} ×", self.text("digit-cost.html"))

    def test_a_level_that_failed_is_shown(self):
        self.write(case([ladder(2.0, 5.0, finest={"status": "diverged", "reason": "particle 7", "metrics": {}})], studies=[study()]))
        self.assertIn("0.025: particle 7", self.text("digit-cost.html"))

    def test_what_lies_inside_the_noise_floor_is_not_resolved(self):
        engine = ladder(2.0, 5.0, finest={"cost": {"cpu_s": 0.05 ** -5 * 1.25, "pairs": 1.0}})
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
        self.assertIn("phase/bare", text[text.index("Cases without a study"):])
        self.assertNotIn("heat/one", text[text.index("Cases without a study"):])


def share(value, limit, band):
    """What the judge writes beside such a gate."""
    if not band:
        return abs(value) / limit
    low, high = band
    return value / (high if value > 0 else low) if low <= 0 <= high else abs(value - (low + high) / 2) / (high - low) * 2


def gated(value, step=1e-3, verdict="pass", state="a", limit=1.0, band=None, **more):
    gate = {"metric": "error", "mode": "corrected", "value": value, "verdict": verdict, "reason": "r", "used": share(value, limit, band), "physics": "right" if verdict == "pass" else "wrong",
            **({"band": band} if band else {"limit": limit}), **more}
    run = {"knobs": {"mode": "corrected", "time_step": step}, "base": True, "status": "ok", "metrics": {"error": {"value": value}}, "cost": {}, "state_hash": state, "folder": "runs/heat/one/tripoint"}
    return case([{"name": "tripoint", "status": "ok", "runs": [run], "gates": [gate]}])


class SinceTheLastRun(Pages):
    def front(self, before, now):
        self.load(before)
        (self.path / "results.json").rename(self.path / "results.previous.json")
        self.write(now)
        text = self.text("index.html")
        return text[text.index("Since the last run"):text.index("Engines by subject")]

    def test_says_that_nothing_got_worse_only_where_nothing_did(self):
        self.assertIn("Nothing got worse.", self.front(gated(0.5), gated(0.5)))
        self.assertIn("Nothing got worse.", self.front(gated(0.5), gated(0.3)))
        self.assertNotIn("Nothing got worse", self.front(gated(0.5), gated(0.9)))
        self.assertNotIn("Nothing got worse", self.front(gated(0.9), gated(1.1, verdict="fail")))

    def test_a_figure_made_at_another_step_is_not_called_better_or_worse(self):
        text = self.front(gated(0.7, 0.742e-3), gated(0.35, 0.437e-3))
        self.assertIn("not comparable heat/one tripoint, error: its step changed, 0.742 to 0.437 ms: 0.7 → 0.35 (allowed ≤ 1)", text)
        self.assertIn("Nothing got worse, of what can be compared.", text)
        self.assertNotIn("better", text)
        self.assertIn("better heat/one", self.front(gated(0.7, 0.742e-3), gated(0.35, 0.741e-3)))

    def test_a_limit_that_moves_along_does_not_hide_what_got_worse(self):
        text = self.front(gated(-0.0095, band=[-0.03, 0.03]), gated(-0.0301, band=[-0.045, 0.015]))
        self.assertIn("not comparable heat/one tripoint, error: its limit changed: -0.0095 (allowed -0.03 to 0.03) → -0.0301 (allowed -0.045 to 0.015)", text)
        self.assertNotIn("Nothing got worse.", text)
        self.assertIn("new limit heat/one tripoint, error: ≤ 1 → ≤ 2", self.front(gated(0.5), gated(0.5, limit=2.0)))

    def test_in_a_band_about_zero_the_error_counts_and_not_the_way_to_the_middle(self):
        self.assertIn("better heat/one", self.front(gated(0.25, band=[-0.1, 0.3]), gated(0.05, band=[-0.1, 0.3])))
        self.assertIn("worse heat/one", self.front(gated(0.0, band=[-0.1, 0.3]), gated(0.1, band=[-0.1, 0.3])))

    def test_in_a_band_about_a_stated_figure_nothing_is_better_or_worse(self):
        text = self.front(gated(-0.35, band=[-0.42, -0.28]), gated(-0.302, band=[-0.42, -0.28]))
        self.assertIn("moved heat/one tripoint, error: -0.35 → -0.302", text)
        self.assertIn("Nothing got worse.", text)

    def test_a_gate_that_falls_is_worse_at_any_step(self):
        self.assertIn("worse heat/one", self.front(gated(0.7, 1e-3), gated(1.2, 2e-3, "fail")))

    def test_runs_that_ended_in_other_bits_are_named(self):
        text = self.front(gated(0.5), gated(0.5, state="b"))
        self.assertIn("0 of 1 runs ended in the same bits as before. The other 1 heat/one/tripoint", text)
        self.assertNotIn("The other", self.front(gated(0.5), gated(0.5)))

    def test_a_new_case_is_no_slower_program(self):
        old, now, new = gated(0.5), gated(0.5), {**gated(0.5), "id": "heat/two"}
        for one, seconds in ((old, 2.0), (now, 3.0), (new, 40.0)):
            one["engines"][0]["runs"][0]["cost"] = {"cpu_s": seconds}
        self.load(old)
        (self.path / "results.json").rename(self.path / "results.previous.json")
        self.write(now, new)
        self.assertIn("43 CPU s (runs that both have: 3, before 2)", self.text("index.html"))

    def test_the_nearest_gates_say_whether_they_hold(self):
        self.assertIn("100 % holds", self.front(gated(1.0), gated(1.0)))
        self.assertIn("120 % fails", self.front(gated(1.2, verdict="fail"), gated(1.2, verdict="fail")))

    def test_a_gate_that_asks_for_all_and_has_all_is_not_near_its_limit(self):
        gates = [{"metric": name, "mode": "corrected", "value": value, "at_least": 0.999, "verdict": "pass", "reason": "r", "used": 0.999 / value} for name, value in (("melted", 1.0), ("share", 0.9991))]
        near = front.nearest(self.load(case([ladder(2.0, 5.0, gates=gates)])))
        self.assertEqual([gate.metric for _, _, _, gate in near], ["share"])


class Physics(Pages):
    """What is wrong is never green: physics gives word and colour, the gate stands beside it."""

    def pages(self):
        """Pyramids that fell in one engine, as its declared defect says, and stand in the other."""
        def engine(name, value, physics, **more):
            gate = {"metric": "error", "mode": "", "value": value, "verdict": "pass", "physics": physics, "used": 0.2, "limit": 1.0, "reason": "r", **more}
            run = {"knobs": {}, "base": True, "status": "ok", "metrics": {"error": {"value": value}}, "cost": {"cpu_s": 1.0}}
            return {"name": name, "status": "ok", "runs": [run], "gates": [gate], "physics": physics}
        self.write(case([engine("bullet", 1e-4, "right"), engine("rapier", 0.66, "known defect", defect="soft-contact", reason="known defect soft-contact: it sinks", order=[])], physics="known defect"))

    def tones(self, page, word):
        """Classes of the badges that hold this word."""
        html = (self.path / page).read_text(encoding="utf-8")
        return {found.group(1) for found in re.finditer(r'<span class="badge ([^"]*)"[^>]*>([^<]*)</span>', html) if found.group(2).startswith(word)}

    def test_a_known_defect_is_named_and_not_green_on_any_page(self):
        self.pages()
        for page in ("engines.html", "index.html", "case/heat-one.html"):
            with self.subTest(page=page):
                self.assertIn("known defect soft-contact", self.text(page))
                self.assertEqual(self.tones(page, "known defect"), {"defect"})

    def test_the_gate_says_as_expected_beside_it(self):
        self.pages()
        for page in ("engines.html", "case/heat-one.html"):
            self.assertIn("known defect soft-contact gate: as expected", self.text(page))
            self.assertIn("right gate: as expected", self.text(page))
        self.assertIn("as expected known defect soft-contact", self.text("index.html"))

    def test_pass_stands_beside_right_values_alone(self):
        self.pages()
        self.assertEqual(self.tones("engines.html", "PASS"), set())
        self.assertEqual(self.tones("case/heat-one.html", "PASS"), {"pass"})  # of Bullet in the list of engines

    def test_a_wrong_value_is_red_in_both(self):
        self.write(gated(1.2, verdict="fail"))
        text = self.text("case/heat-one.html")
        self.assertIn("wrong gate: FAIL", text)
        self.assertEqual(self.tones("case/heat-one.html", "wrong"), {"fail"})

    def test_a_cured_defect_is_right_and_its_gate_red(self):
        self.write(gated(0.5, verdict="fail", physics="right", why="take the declaration away"))
        self.assertIn("right gate: FAIL", self.text("case/heat-one.html"))

    def test_an_order_stands_with_its_class(self):
        self.assertEqual(model.ordered(2.0, "plateau"), "2.0 (plateau)")
        self.assertEqual(model.ordered(None, "roundoff"), "roundoff")


class PaperFigures(Pages):
    def test_figure_8_stands_before_figure_10(self):
        titles = ["Figure 10: cold", "Figure 8: rigid", "Figure 11", "Table 1", "Figure 1: merge"]
        cases = [{**case([ladder(2.0, 5.0)], f"paper/{n}"), "title": title, "tags": ["paper"]} for n, title in enumerate(titles)]
        self.assertEqual([row.case.title for row in paper_figures.read(self.load(*cases))], ["Figure 1: merge", "Figure 8: rigid", "Figure 10: cold", "Figure 11", "Table 1"])


class Corrections(Pages):
    def ablate(self, printed, corrected=0.01):
        run = lambda value: {"status": "ok", "metrics": {"error": {"value": value}}}
        (self.path / "ablation.json").write_text(json.dumps({"format": 1, "cases": [{"id": "heat/one", "title": "One", "metrics": [{"name": "error", "unit": "K"}], "corrected": run(corrected),
                                                             "printed": {term: value if isinstance(value, dict) else run(value) for term, value in printed.items()}}]}))
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
        gates = [{"metric": "error", "mode": "corrected", "value": 0.01, "limit": 1.0, "verdict": "pass", "reason": "r"}]
        found = side_by_side.read(self.load(case([ladder(2.0, 5.0, gates=gates), ladder(1.0, 2.0, name="bullet")])))
        cells = found[0].metrics[0][2]
        self.assertEqual([(label, c.best, c.verdict) for label, c in cells.items()], [("tripoint, corrected", True, "PASS"), ("bullet, corrected", False, "")])
        self.assertAlmostEqual(found[0].cost["tripoint, corrected"][1], 1000.0)

    def test_a_ratio_inside_the_noise_floor_is_not_resolved_and_without_one_that_is_said(self):
        engines = [ladder(2.0, 5.0), ladder(1.0, 4.99, name="bullet")]
        self.write(case(engines, timing={"rounds": 5, "noise_floor": 1.1}))
        self.assertIn("not resolved", self.text("engines.html"))
        self.write(case(engines, timing={"rounds": 5, "noise_floor": 1.001}))
        self.assertNotIn("cheapest, not resolved", self.text("engines.html"))
        self.write(case(engines))
        self.assertIn("no noise floor was measured", self.text("engines.html"))

    def test_a_case_of_one_engine_is_no_comparison(self):
        self.assertEqual(side_by_side.read(self.load(case([ladder(2.0, 5.0)]))), [])


class History(Pages):
    def line(self, date, used, verdict="pass", **more):
        return json.dumps({"format": 1, "case": "heat/one", "date": date, "commit": "abc", "gates": [{"engine": "tripoint", "mode": "corrected", "metric": "error", "level": None, "value": 0.1, "used": used, "verdict": verdict}], **more})

    def test_is_a_strip_from_two_runs_on_with_a_mark_where_figures_were_accepted(self):
        (self.path / "history.jsonl").write_text(self.line("2026-11-20", 0.5) + "\n")
        self.write(case([ladder(2.0, 5.0)]))
        self.assertNotIn("History: share", self.text("case/heat-one.html"))
        with open(self.path / "history.jsonl", "a") as file:
            file.write(self.line("2026-11-21", 0.9) + "\n" + json.dumps({"format": 1, "case": "heat/one", "date": "2026-11-21", "accepted": "why"}) + "\n" + self.line("2026-11-22", 1.4, "fail") + "\n")
        found = self.load(case([ladder(2.0, 5.0)])).cases[0].history
        self.assertEqual([(e.date[-2:], e.accepted) for e in found], [("20", ""), ("21", ""), ("21", "why"), ("22", "")])
        self.write(case([ladder(2.0, 5.0)]))
        self.assertIn("History: share", self.text("case/heat-one.html"))

    def test_torn_lines_are_counted_and_cost_no_report(self):
        (self.path / "history.jsonl").write_text(self.line("2026-11-20", 0.5) + "\n{\"format\": 1, \"ca\n[]\n")
        self.assertIn("2 lines of history.jsonl could not be read", self.load(case([])).notes)

    def test_the_same_run_written_twice_is_one(self):
        (self.path / "history.jsonl").write_text((self.line("2026-11-20", 0.5) + "\n") * 2)
        self.assertEqual(len(self.load(case([])).cases[0].history), 1)


class Selftest(Pages):
    def test_the_smallest_visible_defects_are_in_the_report_and_in_what_is_signed(self):
        (self.path / "selftest").mkdir()
        (self.path / "selftest" / "selftest.json").write_text(json.dumps({"format": 1, "defects": [{"killed": True}], "harmless": [], "smallest_growth": 1.25, "smallest": [{"defect": "heat.conductivity", "what": "k times 1 + size", "case": "heat/one", "metric": "rate", "size": 0.0052, "hidden": 0.005, "stored": 0.004, "verdict": "GREW", "holds": False}]}))
        self.write(case([ladder(2.0, 5.0)]))
        for page in ("index.html", "signable.html"):
            for words in ("heat.conductivity", "0.0052", "GREW", "1.25"):
                self.assertIn(words, self.text(page))


class Signable(Pages):
    def test_every_requirement_gate_and_uncertainty_is_in_it(self):
        gates = [{"metric": "error", "mode": "corrected", "value": 0.01, "uncertainty": 0.002, "budget": {"numerical": 0.002, "statistical": 0, "input": 0, "data": 0}, "limit": 1.0, "verdict": "pass", "reason": "r"}]
        self.write(case([ladder(2.0, 5.0, gates=gates)], gates=[{"metric": "error", "date": "2026-11-21", "reason": "waived for now"}]))
        text = self.text("signable.html")
        for words in ("R-1", "heat/one", "it holds", "0.002", "waived for now", "tripoint validate one", "What is not validated", "Reviewer"):
            self.assertIn(words, text)

    def test_its_hash_is_that_of_the_results(self):
        import hashlib
        self.write(case([ladder(2.0, 5.0)]))
        self.assertIn(hashlib.sha256((self.path / "results.json").read_bytes()).hexdigest(), self.text("signable.html"))

    @unittest.skipUnless(shutil.which("weasyprint"), "weasyprint is not installed")
    def test_the_pdf_is_one(self):
        self.assertEqual(self.write(case([ladder(2.0, 5.0)]), words=["--pdf"]), 0)
        self.assertEqual((self.path / "report.pdf").read_bytes()[:5], b"%PDF-")


def bounce(case_id, gain, engines=(("bullet", "impact"),)):
    runs = [{"knobs": {"time_step": 1e-3}, "base": True, "status": "ok", "metrics": {"energy_gain": {"value": gain, "times": [0.0, 0.5, 1.0], "series": [1.0, 1.0, 1.0 + gain]}}, "cost": {}}]
    return case([{"name": name, "preset": preset, "status": "ok", "runs": runs, "gates": []} for name, preset in engines], case_id)


class Headlines(Pages):
    def pages(self, *cases):
        return headlines.pages(self.load(*cases), self.path)

    def test_an_engine_that_makes_energy_is_named_with_how_much(self):
        (page,), notes = self.pages(bounce("contact/ball-restitution-100", 0.12), bounce("contact/ball-restitution-050", 0.0))
        self.assertEqual((page.file, notes), ("bounce.html", []))
        self.assertIn("bullet · impact makes up to 12 % of the energy of the fall", page.answer)
        self.assertEqual([line.cells for line in page.lines], [["12 %", "12 %", "< 0.1 %"]])

    def test_one_that_makes_none_is_told_so_and_a_case_that_did_not_run_has_no_page(self):
        (page,), _ = self.pages(bounce("contact/ball-restitution-100", 0.006))
        self.assertTrue(page.answer.startswith("No: none of 1 "), page.answer)
        self.assertEqual(self.pages(case([ladder(2, 3)])), ([], []))

    def test_the_front_page_links_what_there_is(self):
        self.assertEqual(self.write(bounce("contact/ball-restitution-100", 0.0)), 0)
        self.assertIn("make energy when it bounces", self.text("index.html"))
        self.assertTrue((self.path / "bounce.html").is_file())
        self.assertFalse((self.path / "float.html").exists())

    def test_presets_of_one_engine_are_named_together(self):
        (page,), _ = self.pages(bounce("contact/ball-restitution-000", 0.04, [("mujoco", "Euler"), ("mujoco", "RK4"), ("ode", "dWorldStep")]))
        self.assertIn("ode · dWorldStep makes up to 4 % and mujoco (RK4, Euler) makes up to 4 %", page.answer)

    def test_a_picture_is_drawn_for_a_page_and_for_a_telephone(self):
        (page,), _ = self.pages(bounce("contact/ball-restitution-100", 0.12))
        broad, slim = (float(re.search(r'viewBox="0 0 ([\d.]+) ', svg)[1]) for svg in (page.picture.svg, page.picture.slim))  # [points]
        self.assertGreater(broad, 600)
        self.assertLess(slim, 320)  # on 364 pixels a text of 9 points is one of 10 pixels or more
        for svg in (page.picture.svg, page.picture.slim):
            self.assertIn("bullet · impact", svg)
        self.assertEqual(self.write(bounce("contact/ball-restitution-100", 0.12)), 0)
        self.assertIn('class="drawing slim"', (self.path / "bounce.html").read_text())

    def test_between_frames_stands_the_cubic_through_values_and_rates(self):
        import numpy as np
        times = np.array([0.0, 0.5, 1.5])
        fine, curve = headline_pictures.smooth(times, times ** 3 - times, 3 * times ** 2 - 1)
        self.assertGreater(len(fine), 20)
        self.assertLess(np.abs(curve - (fine ** 3 - fine)).max(), 1e-14)  # round-off: a cubic is its own
        self.assertEqual(headline_pictures.smooth(times, times, None)[0].tolist(), times.tolist())

    def test_the_tip_of_a_body_that_turns_about_y_falls_as_the_sine(self):
        import numpy as np
        from trajectories import Trajectory
        times, rate = np.linspace(0.0, 1.0, 5), 1.3
        half = 0.5 * rate * times
        attitude = np.stack([np.cos(half), 0 * half, np.sin(half), 0 * half], axis=1)[:, None]
        turning = np.broadcast_to([0.0, rate, 0.0], (5, 1, 3))
        _, z, slope = headlines.tip(Trajectory(times=times, bodies={"orientation": attitude, "angular_velocity": turning}, body_times=times))
        self.assertLess(np.abs(z + np.sin(rate * times)).max(), 1e-15)
        self.assertLess(np.abs(slope + rate * np.cos(rate * times)).max(), 1e-15)

    def test_an_upgrade_is_answered_from_the_greatest_change(self):
        releases = [{"engine": "mujoco", "version": v} for v in ("3.10.0", "3.11.0")]
        worse = {"from": "3.10.0", "to": "3.11.0", "preset": "implicitfast", "metric": "angle", "before": 4.6e-4, "after": 0.6, "worse": True, "round_off": False}
        self.assertIn("implicitfast's angle error grows 1300 times", headlines.upgrade_answer({"releases": releases, "changes": [worse]}))
        self.assertTrue(headlines.upgrade_answer({"releases": releases, "changes": [], "margin": 1.5}).startswith("Yes"))

    def test_an_upgrade_draws_no_panel_without_a_point(self):
        def release(version, error):
            return {"engine": "mujoco", "version": version, "rows": [{"preset": "RK4", "status": "ok", "metrics": {"angle": {"value": error, "order": 2.0}, "energy": {"value": 1e-15}}}]}
        document = {"case": "a", "metrics": [{"name": "angle"}, {"name": "energy"}], "releases": [release("1", 0.1), release("2", 0.2)]}
        picture = releases.draw(document, self.path)
        for svg in (picture.svg, picture.slim):
            self.assertIn("angle: observed order", svg)
            self.assertIn("energy: error", svg)
            self.assertNotIn("energy: observed order", svg)


class Spin(Pages):
    def test_the_printed_form_of_our_own_solver_and_the_step_are_shown(self):
        def run(mode, angle):
            return {"knobs": {"mode": mode, "time_step": 0.01}, "base": True, "status": "ok", "metrics": {"angle": {"value": angle}, "energy": {"value": 0.1}}, "cost": {}}
        engines = [{"name": "tripoint", "status": "ok", "runs": [run("corrected", 3.6e-5), run("paper", 1.9007)], "gates": []},
                   {"name": "bullet", "status": "ok", "runs": [run(None, 0.60346)], "gates": []}]
        (page,), notes = headlines.pages(self.load(case(engines, "rigid/torque-free")), self.path)
        self.assertEqual(notes, [])
        self.assertIn("at a step of 10 ms, 1 of 2 engines and presets (without our printed form) point within 0.01 rad of the truth; bullet is 0.6035 rad off; tripoint as printed is 1.901 rad off.", page.answer)
        self.assertEqual([(line.label, line.cells[:2]) for line in page.lines], [("tripoint", ["10 ms", "3.6e-05"]), ("bullet", ["10 ms", "0.6035"]), ("tripoint as printed", ["10 ms", "1.901"])])


    def test_an_order_is_shown_with_its_class(self):
        class Found:
            value, fit_class = 2.0, "plateau"
        self.assertEqual(headlines.order_of(Found), "2.0 (plateau)")
        self.assertEqual(headlines.order_of(None), "—")

    def test_the_users_own_engine_comes_first_in_table_and_picture_and_has_its_own_colour(self):
        def run(angle):
            return {"knobs": {"time_step": 0.01}, "base": True, "status": "ok", "metrics": {"angle": {"value": angle}}, "cost": {}}
        engines = [{"name": name, "status": "ok", "runs": [run(angle)], "gates": []} for name, angle in (("ode", 0.001), ("mine", 0.3), ("bullet", 0.6))]
        results = self.load(case(engines, "rigid/torque-free"))
        results.command = "tripoint validate rigid --engine 'my folder/engine-mine' --out x"
        (found,), _ = headlines.pages(results, self.path)
        self.assertEqual([(line.label, line.own) for line in found.lines], [("mine", True), ("ode", False), ("bullet", False)])
        curves = [(name, (None, None, None)) for name in ("ode", "mine · a", "bullet")]
        looks = headline_pictures.looks_of([name for name, _ in curves], ["mine"])
        from figures import style
        self.assertEqual([name for name in looks][0], "mine · a")
        self.assertEqual([look["color"] == style.OWN for look in looks.values()], [True, False, False])
        self.assertGreater(looks["mine · a"]["zorder"], looks["ode"]["zorder"])


class CasePages(Pages):
    def test_limits_of_one_value_stand_under_one_name(self):
        gates = [{"metric": "error", "mode": "corrected", "value": 0.25, "limit": limit, "verdict": "pass", "reason": reason} for limit, reason in ((0.5, "own"), (2.0, "acceptance"))]
        self.write(case([{"name": "tripoint", "status": "ok", "runs": [], "gates": gates}]))
        html = (self.path / "case" / "heat-one.html").read_text()
        self.assertEqual(html.count("<td rowspan=\"2\">error"), 1)
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
