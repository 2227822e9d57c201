# SPDX-License-Identifier: BSD-3-Clause
"""What the headline pages say of the engines."""

import re
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]
import headline_pictures
import headlines
import releases
from pages_test import Pages, case, ladder


def bounce(case_id, gain, engines=(("bullet", "impact"),)):
    runs = [
        {
            "knobs": {"time_step": 1e-3},
            "base": True,
            "status": "ok",
            "metrics": {"energy_gain": {"value": gain, "times": [0.0, 0.5, 1.0], "series": [1.0, 1.0, 1.0 + gain]}},
            "cost": {},
        }
    ]
    return case(
        [{"name": name, "preset": preset, "status": "ok", "runs": runs, "gates": []} for name, preset in engines],
        case_id,
    )


class Headlines(Pages):
    def pages(self, *cases):
        return headlines.pages(self.load(*cases), self.path)

    def test_an_engine_that_makes_energy_is_named_with_how_much(self):
        (page,), notes = self.pages(
            bounce("contact/ball-restitution-100", 0.12), bounce("contact/ball-restitution-050", 0.0)
        )
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
        (page,), _ = self.pages(
            bounce(
                "contact/ball-restitution-000", 0.04, [("mujoco", "Euler"), ("mujoco", "RK4"), ("ode", "dWorldStep")]
            )
        )
        self.assertIn("ode · dWorldStep makes up to 4 % and mujoco (RK4, Euler) makes up to 4 %", page.answer)

    def test_a_picture_is_drawn_for_a_page_and_for_a_telephone(self):
        (page,), _ = self.pages(bounce("contact/ball-restitution-100", 0.12))
        broad, slim = (
            float(re.search(r'viewBox="0 0 ([\d.]+) ', svg)[1]) for svg in (page.picture.svg, page.picture.slim)
        )  # [points]
        self.assertGreater(broad, 600)
        self.assertLess(slim, 320)  # on 364 pixels a text of 9 points is one of 10 pixels or more
        for svg in (page.picture.svg, page.picture.slim):
            self.assertIn("bullet · impact", svg)
        self.assertEqual(self.write(bounce("contact/ball-restitution-100", 0.12)), 0)
        self.assertIn('class="drawing slim"', (self.path / "bounce.html").read_text())

    def test_between_frames_stands_the_cubic_through_values_and_rates(self):
        import numpy as np

        times = np.array([0.0, 0.5, 1.5])
        fine, curve = headline_pictures.smooth(times, times**3 - times, 3 * times**2 - 1)
        self.assertGreater(len(fine), 20)
        self.assertLess(np.abs(curve - (fine**3 - fine)).max(), 1e-14)  # round-off: a cubic is its own
        self.assertEqual(headline_pictures.smooth(times, times, None)[0].tolist(), times.tolist())

    def test_the_tip_of_a_body_that_turns_about_y_falls_as_the_sine(self):
        import numpy as np
        from trajectories import Trajectory

        times, rate = np.linspace(0.0, 1.0, 5), 1.3
        half = 0.5 * rate * times
        attitude = np.stack([np.cos(half), 0 * half, np.sin(half), 0 * half], axis=1)[:, None]
        turning = np.broadcast_to([0.0, rate, 0.0], (5, 1, 3))
        _, z, slope = headlines.tip(
            Trajectory(times=times, bodies={"orientation": attitude, "angular_velocity": turning}, body_times=times)
        )
        self.assertLess(np.abs(z + np.sin(rate * times)).max(), 1e-15)
        self.assertLess(np.abs(slope + rate * np.cos(rate * times)).max(), 1e-15)

    def test_an_upgrade_is_answered_from_the_greatest_change(self):
        releases = [{"engine": "mujoco", "version": v} for v in ("3.10.0", "3.11.0")]
        worse = {
            "from": "3.10.0",
            "to": "3.11.0",
            "preset": "implicitfast",
            "metric": "angle",
            "before": 4.6e-4,
            "after": 0.6,
            "worse": True,
            "round_off": False,
        }
        self.assertIn(
            "implicitfast's angle error grows 1300 times",
            headlines.upgrade_answer({"releases": releases, "changes": [worse]}),
        )
        self.assertTrue(
            headlines.upgrade_answer({"releases": releases, "changes": [], "margin": 1.5}).startswith("Yes")
        )

    def test_an_upgrade_draws_no_panel_without_a_point(self):
        def release(version, error):
            return {
                "engine": "mujoco",
                "version": version,
                "rows": [
                    {
                        "preset": "RK4",
                        "status": "ok",
                        "metrics": {"angle": {"value": error, "order": 2.0}, "energy": {"value": 1e-15}},
                    }
                ],
            }

        document = {
            "case": "a",
            "metrics": [{"name": "angle"}, {"name": "energy"}],
            "releases": [release("1", 0.1), release("2", 0.2)],
        }
        picture = releases.draw(document, self.path)
        for svg in (picture.svg, picture.slim):
            self.assertIn("angle: observed order", svg)
            self.assertIn("energy: error", svg)
            self.assertNotIn("energy: observed order", svg)


class Spin(Pages):
    def test_the_printed_form_of_our_own_solver_and_the_step_are_shown(self):
        def run(mode, angle):
            return {
                "knobs": {"mode": mode, "time_step": 0.01},
                "base": True,
                "status": "ok",
                "metrics": {"angle": {"value": angle}, "energy": {"value": 0.1}},
                "cost": {},
            }

        engines = [
            {"name": "tripoint", "status": "ok", "runs": [run("corrected", 3.6e-5), run("paper", 1.9007)], "gates": []},
            {"name": "bullet", "status": "ok", "runs": [run(None, 0.60346)], "gates": []},
        ]
        (page,), notes = headlines.pages(self.load(case(engines, "rigid/torque-free")), self.path)
        self.assertEqual(notes, [])
        self.assertIn(
            "at a step of 10 ms, 1 of 2 engines and presets (without our printed form) point within 0.01 rad of the "
            "truth; bullet is 0.6035 rad off; tripoint as printed is 1.901 rad off.",
            page.answer,
        )
        self.assertEqual(
            [(line.label, line.cells[:2]) for line in page.lines],
            [
                ("tripoint", ["10 ms", "3.6e-05"]),
                ("bullet", ["10 ms", "0.6035"]),
                ("tripoint as printed", ["10 ms", "1.901"]),
            ],
        )

    def test_a_legend_has_the_names_that_fit(self):
        self.assertEqual(headline_pictures.fitted("ode, bullet", 4.3), "ode, bullet")
        long = ", ".join(["drake · runge_kutta2"] * 5)
        self.assertEqual(headline_pictures.fitted(long, 4.3), "drake · runge_kutta2 and 4 more")
        self.assertEqual(headline_pictures.fitted(long, 9.2), long)

    def test_an_order_is_shown_with_its_class(self):
        class Found:
            value, fit_class = 2.0, "plateau"

        self.assertEqual(headlines.order_of(Found), "2.0 (plateau)")
        self.assertEqual(headlines.order_of(None), "—")

    def test_the_users_own_engine_comes_first_in_table_and_picture_and_has_its_own_colour(self):
        def run(angle):
            return {
                "knobs": {"time_step": 0.01},
                "base": True,
                "status": "ok",
                "metrics": {"angle": {"value": angle}},
                "cost": {},
            }

        engines = [
            {"name": name, "status": "ok", "runs": [run(angle)], "gates": []}
            for name, angle in (("ode", 0.001), ("mine", 0.3), ("bullet", 0.6))
        ]
        results = self.load(case(engines, "rigid/torque-free"))
        for words in ("--engine 'my folder/engine-mine'", "--engines=all,mine", "--engines ode,bullet,./engine-mine"):
            results.command = f"tripoint validate rigid {words} --out x"
            (found,), _ = headlines.pages(results, self.path)
            self.assertEqual(
                [(line.label, line.own) for line in found.lines], [("mine", True), ("ode", False), ("bullet", False)]
            )
        curves = [(name, (None, None, None)) for name in ("ode", "mine · a", "bullet")]
        looks = headline_pictures.looks_of([name for name, _ in curves], ["mine"])
        from figures import style

        self.assertEqual([name for name in looks][0], "mine · a")
        self.assertEqual([look["color"] == style.OWN for look in looks.values()], [True, False, False])
        self.assertGreater(looks["mine · a"]["zorder"], looks["ode"]["zorder"])


if __name__ == "__main__":
    unittest.main()
