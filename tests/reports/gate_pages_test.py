# SPDX-License-Identifier: BSD-3-Clause
"""What the pages say of gates, of known defects and of changes since the last run."""

import json
import re
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]
import front
import model
from pages_test import Pages, case, ladder


def share(value, limit, band):
    """What the judge writes beside such a gate."""
    if not band:
        return abs(value) / limit
    low, high = band
    return (
        value / (high if value > 0 else low) if low <= 0 <= high else abs(value - (low + high) / 2) / (high - low) * 2
    )


def gated(value, step=1e-3, verdict="pass", state="a", limit=1.0, band=None, **more):
    gate = {
        "metric": "error",
        "mode": "corrected",
        "value": value,
        "verdict": verdict,
        "reason": "r",
        "used": share(value, limit, band),
        "physics": "right" if verdict == "pass" else "wrong",
        **({"band": band} if band else {"limit": limit}),
        **more,
    }
    run = {
        "knobs": {"mode": "corrected", "time_step": step},
        "base": True,
        "status": "ok",
        "metrics": {"error": {"value": value}},
        "cost": {},
        "state_hash": state,
        "folder": "runs/heat/one/tripoint",
    }
    return case([{"name": "tripoint", "status": "ok", "runs": [run], "gates": [gate]}])


class SinceTheLastRun(Pages):
    def test_the_heading_says_gate_and_physics_where_a_known_defect_stands_beside_it(self):
        sound, known = case([], physics="right"), case([], "heat/two", physics="known defect")
        self.assertEqual(front.hero(self.load(sound)), ("PASS", "pass"))
        self.assertEqual(front.hero(self.load(sound, known)), ("gate PASS; physics known defect in 1 case", "defect"))
        wrong = case([], "heat/three", physics="wrong")
        self.assertEqual(
            front.hero(self.load(known, wrong)), ("gate PASS; physics wrong in 1 case, known defect in 1 case", "fail")
        )

    def test_known_defects_are_counted_by_name(self):
        def with_defects(name, *defects):
            gates = [
                {"metric": "error", "verdict": "pass", "physics": "known defect", "defect": defect, "reason": "r"}
                for defect in defects
            ]
            engine = {"name": "ode", "status": "ok", "runs": [], "gates": gates}
            return case([engine], name, physics="known defect")

        results = self.load(
            with_defects("heat/one", "soft-contact", "mass-ratio"), with_defects("heat/two", "mass-ratio")
        )
        _, words, names = front.verdict_words(results)
        self.assertEqual(words, {"known defect": 2})
        self.assertEqual(names, [("mass ratio", 2), ("soft contact", 1)])

    def front(self, before, now):
        self.load(before)
        (self.path / "results.json").rename(self.path / "results.previous.json")
        self.write(now)
        text = self.text("index.html")
        return text[text.index("Since the last run") : text.index("Engines by subject")]

    def test_says_that_nothing_got_worse_only_where_nothing_did(self):
        self.assertIn("Nothing got worse.", self.front(gated(0.5), gated(0.5)))
        self.assertIn("Nothing got worse.", self.front(gated(0.5), gated(0.3)))
        self.assertNotIn("Nothing got worse", self.front(gated(0.5), gated(0.9)))
        self.assertNotIn("Nothing got worse", self.front(gated(0.9), gated(1.1, verdict="fail")))

    def test_a_figure_made_at_another_step_is_not_called_better_or_worse(self):
        text = self.front(gated(0.7, 0.742e-3), gated(0.35, 0.437e-3))
        self.assertIn(
            "not comparable heat/one tripoint, error: its step changed, 0.742 to 0.437 ms: 0.7 → 0.35 (allowed ≤ 1)",
            text,
        )
        self.assertIn("Nothing got worse, of what can be compared.", text)
        self.assertNotIn("better", text)
        self.assertIn("better heat/one", self.front(gated(0.7, 0.742e-3), gated(0.35, 0.741e-3)))

    def test_a_limit_that_moves_along_does_not_hide_what_got_worse(self):
        text = self.front(gated(-0.0095, band=[-0.03, 0.03]), gated(-0.0301, band=[-0.045, 0.015]))
        self.assertIn(
            "not comparable heat/one tripoint, error: its limit changed: -0.0095 (allowed -0.03 to 0.03) → -0.0301 "
            "(allowed -0.045 to 0.015)",
            text,
        )
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
        gates = [
            {
                "metric": name,
                "mode": "corrected",
                "value": value,
                "at_least": 0.999,
                "verdict": "pass",
                "reason": "r",
                "used": 0.999 / value,
            }
            for name, value in (("melted", 1.0), ("share", 0.9991))
        ]
        near = front.nearest(self.load(case([ladder(2.0, 5.0, gates=gates)])))
        self.assertEqual([gate.metric for _, _, _, gate in near], ["share"])


class Physics(Pages):
    """What is wrong is never green: physics gives word and colour, the gate stands beside it."""

    def pages(self):
        """Pyramids that fell in one engine, as its declared defect says, and stand in the other."""

        def engine(name, value, physics, **more):
            gate = {
                "metric": "error",
                "mode": "",
                "value": value,
                "verdict": "pass",
                "physics": physics,
                "used": 0.2,
                "limit": 1.0,
                "reason": "r",
                **more,
            }
            run = {
                "knobs": {},
                "base": True,
                "status": "ok",
                "metrics": {"error": {"value": value}},
                "cost": {"cpu_s": 1.0},
            }
            return {"name": name, "status": "ok", "runs": [run], "gates": [gate], "physics": physics}

        self.write(
            case(
                [
                    engine("bullet", 1e-4, "right"),
                    engine(
                        "rapier",
                        0.66,
                        "known defect",
                        defect="soft-contact",
                        reason="known defect soft-contact: it sinks",
                        order=[],
                    ),
                ],
                physics="known defect",
            )
        )

    def tones(self, page, word):
        """Classes of the badges that hold this word."""
        html = (self.path / page).read_text(encoding="utf-8")
        return {
            found.group(1)
            for found in re.finditer(r'<span class="badge ([^"]*)"[^>]*>([^<]*)</span>', html)
            if found.group(2).startswith(word)
        }

    def test_a_known_defect_is_named_and_not_green_on_any_page(self):
        self.pages()
        for name in ("engines.html", "index.html", "case/heat-one.html"):
            with self.subTest(name=name):
                self.assertIn("known defect soft-contact", self.text(name))
                self.assertEqual(self.tones(name, "known defect"), {"defect"})

    def test_the_gate_says_as_expected_beside_it(self):
        self.pages()
        for name in ("engines.html", "case/heat-one.html"):
            self.assertIn("known defect soft-contact gate: as expected", self.text(name))
            self.assertIn("right gate: as expected", self.text(name))
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


class Selftest(Pages):
    def test_the_smallest_visible_defects_are_in_the_report_and_in_what_is_signed(self):
        (self.path / "selftest").mkdir()
        (self.path / "selftest" / "selftest.json").write_text(
            json.dumps(
                {
                    "format": 1,
                    "defects": [{"killed": True}],
                    "harmless": [],
                    "smallest_growth": 1.25,
                    "smallest": [
                        {
                            "defect": "heat.conductivity",
                            "what": "k times 1 + size",
                            "case": "heat/one",
                            "metric": "rate",
                            "size": 0.0052,
                            "hidden": 0.005,
                            "stored": 0.004,
                            "verdict": "GREW",
                            "holds": False,
                        }
                    ],
                }
            )
        )
        self.write(case([ladder(2.0, 5.0)]))
        for name in ("index.html", "signable.html"):
            for words in ("heat.conductivity", "0.0052", "GREW", "1.25"):
                self.assertIn(words, self.text(name))


if __name__ == "__main__":
    unittest.main()
