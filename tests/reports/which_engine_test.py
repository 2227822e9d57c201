# SPDX-License-Identifier: BSD-3-Clause
"""What the page of engines by use must say: python3 which_engine_test.py"""

import contextlib
import io
import json
import re
import unittest

from pages_test import Pages, case  # it knows the folders of the others
from report_test import Reader
import page
import report
import scorecard
import thumbnails
import uses
import which_engine
from buyer_questions import bounces, by_case


def score(engine, preset, *lines):
    return {"engine": engine, "preset": preset, "label": engine, "version": "1.2", "rows": list(lines)}


def judged(case_id, verdict, share, **more):
    return {"case": case_id, "verdict": verdict, "worst": {"metric": "top", "share": share}, "cpu_s": 0.5, **more}


class WhichEngine(Pages):
    """One tower on two engines, the user's own one beside them."""

    SCORES = (
        score("ode", "default", judged("contact/tower-1", "pass", 0.25), judged("contact/tower-10", "pass", 0.5)),
        score(
            "mujoco",
            "Euler",
            judged("contact/tower-1", "known defect", 9.0, defect="soft-contact"),
            judged("contact/tower-10", "pass", 0.1),
        ),
        score(
            "mujoco",
            "RK4",
            judged("contact/tower-1", "known defect", 34.0, defect="soft-contact"),
            judged("contact/tower-10", "known defect", 2.0, defect="soft-contact"),
        ),
        score("mine", "default", judged("contact/tower-1", "fail", 3.0), judged("contact/tower-10", "refused", None)),
    )

    def page(self, *scores, drop=0.0):
        engines = [
            {
                "name": s["engine"],
                "preset": s["preset"],
                "status": "ok",
                "gates": [],
                "runs": [self.run_of(s["engine"] + s["preset"], drop if s["engine"] == "mujoco" else 0.0)],
            }
            for s in scores
        ]
        results = self.load(case(engines, "contact/tower-1"))
        results.command = "tripoint validate contact --engine engine-mine"
        (self.path / "scorecard.json").write_text(json.dumps({"engines": list(scores)}))
        return which_engine.render(results)

    def run_of(self, name, drop):
        """A box of 0.2 m that ends lower by `drop`, on a floor."""
        folder = self.path / "runs" / name
        folder.mkdir(parents=True, exist_ok=True)
        box = {
            "name": "box",
            "phase": "rigid",
            "motion": "free",
            "centre": [0, 0, 0.5],
            "shape": {"kind": "box", "min": [-0.1, -0.1, 0.4], "max": [0.1, 0.1, 0.6]},
        }
        (folder / "job.json").write_text(json.dumps({"scene": {"gravity": [0, 0, -9.81], "bodies": [box]}}))
        (folder / "trajectory.csv").write_text(
            "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz\n0,0,0,0,0.5,0,0,0,1,0,0,0\n1,0,0,0,%s,0,0,0,1,0,0,0\n" % (0.5 - drop)
        )
        return {"knobs": {}, "base": True, "status": "ok", "metrics": {}, "cost": {}, "folder": f"runs/{name}"}

    def cell(self, html, engine):
        return Reader(
            "<td "
            + next(part for part in html.split("<td ")[1:] if f'class="engine">{engine}<' in part).split("</td>")[0]
            + "</td>"
        ).text

    def test_a_cell_has_the_verdict_in_words_the_error_in_limits_and_the_cost(self):
        html = self.page(*self.SCORES)
        self.assertIn("stands 0.5 of the limit 0.5 CPU s a case right in 2 of 2 cases", self.cell(html, "ODE"))
        self.assertIn("off: known defect soft contact 9 × the limit", self.cell(html, "MuJoCo"))
        self.assertIn("preset Euler", self.cell(html, "MuJoCo"))  # the better of two
        self.assertIn("wrong: fail in tower-1", self.cell(html, "mine"))
        self.assertIn("<svg", html)

    def test_the_preset_that_is_right_in_most_cases_is_shown_though_another_ran_fewer(self):
        few = score("ode", "quick", judged("contact/tower-1", "pass", 0.1))
        most = score(
            "ode",
            "exact",
            *(judged(f"contact/tower-{n}", "pass", 0.9) for n in (1, 10)),
            judged("contact/tower-100", "known defect", 2.0, defect="x"),
        )
        self.assertEqual(which_engine.best_preset([few, most], uses.RIGID[0])[0]["preset"], "exact")

    def test_dots_of_a_picture_do_not_lie_on_each_other_and_are_few(self):
        import numpy as np

        points = np.random.default_rng(1).uniform(0.0, 60.0, (20000, 2))
        rows = thumbnails.apart(points)
        self.assertLessEqual(len(rows), thumbnails.MOST_DOTS)
        self.assertGreater(len(rows), thumbnails.MOST_DOTS // 2)
        self.assertEqual(len(thumbnails.apart(np.repeat(points[:50], 9, axis=0))), len(thumbnails.apart(points[:50])))

    def test_bodies_without_times_of_their_own_have_those_of_the_particles(self):
        import h5py
        import numpy as np
        from trajectories import read_h5md

        with h5py.File(self.path / "trajectory.h5", "w") as file:
            file["particles/all/position/value"] = np.zeros((3, 4, 3))
            file["particles/all/position/time"] = [0.0, 0.5, 1.0]
            file["particles/bodies/position/value"] = np.zeros((3, 1, 3))
        self.assertEqual(list(read_h5md(self.path / "trajectory.h5").body_times), [0.0, 0.5, 1.0])

    def test_who_refuses_most_cases_is_not_said_to_do_it(self):
        few = score(
            "ode",
            "default",
            *(judged(f"contact/tower-{n}", w, 0.1) for n, w in ((1, "pass"), (2, "refused"), (3, "refused"))),
        )
        cell = self.cell(self.page(few, self.SCORES[3]), "ODE")
        self.assertIn("right in the 1 of 3 that it takes", cell)
        self.assertIn("right in 1 of 3 cases, 2 refused", cell)
        self.assertNotIn("stands", cell)

    def test_a_box_that_sank_by_more_than_half_of_its_height_fell(self):
        self.assertIn("falls: known defect soft contact", self.cell(self.page(*self.SCORES, drop=0.15), "MuJoCo"))
        self.assertIn("off: known defect", self.cell(self.page(*self.SCORES, drop=0.05), "MuJoCo"))

    def test_the_users_own_engine_is_the_first_column_in_its_own_colour(self):
        html = self.page(*self.SCORES)
        columns = re.findall(r"<th( class=\"mine\")?>([^<]+)</th>", html.split("<tbody>")[0])
        self.assertEqual(columns, [(' class="mine"', "mine"), ("", "ODE"), ("", "MuJoCo")])

    def test_questions_are_answered_by_the_cells(self):
        text = Reader(self.page(*self.SCORES)).text
        self.assertIn(
            "ODE holds every tower and pyramid. Firm, but off elsewhere: mine: wrong. Soft contact: MuJoCo (Euler).",
            text,
        )
        self.assertIn("stack ODE 0.5 s", text)

    def test_one_case_is_answered_by_the_preset_that_does_best_in_it(self):
        heat, ball = "heat/two-conductivities", "contact/ball-restitution-050"
        engines = {
            "ode": [score("ode", "a", judged(heat, "pass", 0.5)), score("ode", "b", judged(heat, "pass", 0.2))],
            "mujoco": [score("mujoco", "default", judged(heat, "known defect", 3.0, defect="printed-digits"))],
            "jolt": [score("jolt", "default", judged(ball, "pass", 0.1))],
        }
        self.assertEqual(
            by_case(engines, heat, "does"),
            "Error over its limit in heat/two-conductivities: ODE (b) 0.2. "
            "Off: MuJoCo 3 in top, known defect printed digits.",
        )
        self.assertEqual(bounces(engines, []), "Error over its limit in contact/ball-restitution-050: Jolt 0.1.")

    def test_an_error_above_its_limit_says_of_what_and_where(self):
        self.assertIn("9 × the limit (top, tower-1)", self.cell(self.page(*self.SCORES), "MuJoCo"))

    def test_nothing_is_to_be_chosen_from_one_engine_or_without_a_scorecard(self):
        self.assertEqual(self.page(self.SCORES[0]), "")
        (self.path / "scorecard.json").unlink()
        self.assertEqual(which_engine.render(self.load(case([]))), "")

    def test_the_front_page_links_it_first_and_the_scorecard_next(self):
        self.page(*self.SCORES)
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(self.path / "results.json"), "--jobs", "1"]), 0)
        links = re.findall(
            r'href="([^"]+)"', (self.path / "index.html").read_text().split('class="questions"')[1].split("</p>")[0]
        )
        self.assertEqual(links[:2], ["which-engine.html", "scorecard.html"])
        self.assertTrue((self.path / "which-engine.html").is_file())


class Scorecards(unittest.TestCase):
    CARD = {
        "verdict": "MISSING",
        "exit_code": 4,
        "command": "tripoint validate",
        "engines": [
            {
                "label": "jolt",
                "totals": {"pass": 1, "crashed": 1},
                "rows": [
                    {"case": "contact/a", "verdict": "pass"},
                    {"case": "contact/b", "verdict": "crashed", "reason": "frozen"},
                ],
            }
        ],
    }

    def test_says_why_it_is_not_green(self):
        text = Reader(scorecard.render(self.CARD)).text
        self.assertIn("exit 4: a required engine, reference or metric is missing", text)
        self.assertIn("jolt: crashed in contact/b.", text)

    def test_no_green_stands_beside_known_defects(self):
        card = {"verdict": "PASS", "exit_code": 0, "engines": [{"label": "jolt", "totals": {"pass": 3}, "rows": []}]}
        self.assertIn('<span class="badge pass">PASS</span>', scorecard.render(card))
        card["engines"][0]["totals"]["known defect"] = 2
        html = scorecard.render(card)
        self.assertIn('<span class="badge defect">gate PASS; physics known defect in 2 rows</span>', html)

    def test_the_users_own_engine_is_first(self):
        engines = [{"engine": name, "label": name, "rows": []} for name in ("bullet", "mine")]
        html = scorecard.render({"command": "tripoint validate --engines all,./engine-mine", "engines": engines})
        self.assertLess(html.index(">mine</a>"), html.index(">bullet</a>"))
        self.assertIn('<tr class="mine"><th scope="row"><a href="#engine-1">mine', html)

    def test_says_what_an_error_is_like(self):
        card = {
            "engines": [
                {
                    "label": "mine",
                    "rows": [
                        {
                            "case": "rigid/a",
                            "verdict": "fail",
                            "reason": "angle: 1.9",
                            "cause": "angle 1.9: as of an engine without gyroscopic term (jolt)",
                        }
                    ],
                }
            ]
        }
        self.assertIn(
            "Likely: angle 1.9: as of an engine without gyroscopic term (jolt).", Reader(scorecard.render(card)).text
        )

    def test_has_no_column_of_what_never_happened(self):
        html = scorecard.render(self.CARD)
        self.assertIn('<th class="n">crashed</th>', html)
        self.assertIn('<th class="n">refused</th>', html)
        self.assertNotIn("known defect", html)
        self.assertNotIn('<th class="n">diverged</th>', html)


class Commands(unittest.TestCase):
    def test_a_command_names_no_folder_of_the_machine_that_it_wrote_on(self):
        home = "/".join(["", "home", "ann"])
        for typed, shown in (
            (
                f"tripoint validate contact --out {home}/reports/new --jobs 2",
                "tripoint validate contact --out new --jobs 2",
            ),
            (f"tripoint validate --out='{home}/a b'", "tripoint validate '--out=a b'"),
            (f"tripoint validate --history {home}/h.jsonl -k tower", "tripoint validate --history h.jsonl -k tower"),
            (
                "tripoint validate --out report --engines all,./mine",
                "tripoint validate --out report --engines all,./mine",
            ),
            (f"{home}/bin/tripoint run {home}/x.toml --out .", "tripoint run x.toml --out ."),
            (f"tripoint run x --engine {home}/engine-b -o {home}/r", "tripoint run x --engine engine-b -o r"),
            (f"tripoint validate --engines all,{home}/engine-b", "tripoint validate --engines all,engine-b"),
            ("tripoint validate 'open", "tripoint validate 'open"),
            (None, ""),
        ):
            self.assertEqual(page.portable(typed), shown)


if __name__ == "__main__":
    unittest.main()
