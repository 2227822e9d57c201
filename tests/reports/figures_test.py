# SPDX-License-Identifier: BSD-3-Clause
"""What the figures must do: python3 figures_test.py"""

import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "reports")]


class Figures(unittest.TestCase):
    def test_a_line_is_drawn_where_there_is_a_function_and_points_where_there_is_none(self):
        import numpy as np
        from figures import profiles, work_precision

        x = np.linspace(0, 1, 40)
        self.assertFalse(profiles.wavers(np.sin(6 * x)))
        self.assertFalse(profiles.wavers(300 + 0 * x))
        self.assertTrue(profiles.wavers(np.where(np.arange(40) % 2, 390.0, 412.0)))
        self.assertTrue(work_precision.is_ladder([(1.0, 0.1, 0, "", 0.02), (2.0, 0.05, 0, "", 0.01)]))
        self.assertFalse(
            work_precision.is_ladder([(2.0, 0.1, 0, "", 0.02), (1.0, 0.05, 0, "", 0.01), (3.0, 0.02, 0, "", 0.005)])
        )
        self.assertFalse(work_precision.is_ladder([(2.0, 0.1, 0, "", None), (1.0, 0.05, 0, "", None)]))

    def test_who_lags_and_who_leads_is_said_with_its_size(self):
        import numpy as np
        from types import SimpleNamespace
        from figures import bodies

        lines = [
            (SimpleNamespace(label=label), np.array([0.0, 1.0]), np.array([0.0, end]), 0)
            for label, end in (("bullet", -0.04905), ("paper", 0.04905), ("own", 1e-15))
        ]
        said = bodies.who_leads("z of the centre [m]", ("engine minus exact [m]", lines))
        self.assertIn(
            "in z against exact: bullet lags by 0.04905 m, paper leads by 0.04905 m; within 1e-15 m of exact: own.",
            said,
        )
        self.assertEqual(bodies.who_leads("z of the centre [m]", None), "")

    def test_a_caption_speaks_of_the_panels_that_are_there(self):
        from figures import bodies

        liquid, solid = (
            [(bodies.ENERGY, [("tripoint", [], [], 0)])],
            [(bodies.TURN, [("tripoint", [], [], 0), ("tripoint", [], [], 1)])],
        )
        self.assertEqual(
            bodies.caption(liquid, False),
            "Each engine at the case's own resolution. Energy change: of the kinetic and the stored energy since the "
            "start, as a part of the run's greatest kinetic energy.",
        )
        for words in ("what is left between engine and exact", "Turn from the start", "dashes: further ones"):
            self.assertIn(words, bodies.caption(solid, True))

    def test_engines_of_one_hue_have_other_markers(self):
        from types import SimpleNamespace as Any
        from figures import style

        engines = [Any(name=f"engine {n}", preset="default", label=f"engine {n}", status="run") for n in range(20)]
        case = Any(engines=engines)
        looks = [style.look(Any(case=case, engine=e, mode="corrected")) for e in engines]
        self.assertEqual(len({(look["color"], look["marker"]) for look in looks}), 20)
        self.assertEqual({look["marker"] for look in looks[:8]}, {"o"})

    def test_a_legend_of_many_long_names_stands_above_the_panels(self):
        from figures import style

        figure, axes = style.panels(2, 15)
        before = axes[0].get_window_extent().height
        for n in range(15):
            axes[0].plot([0, 1], [0, n], label=f"an engine of a long name, number {n}")
        style.legend(figure, axes)
        below = figure.legends[0].get_window_extent(figure.canvas.get_renderer()).y0
        self.assertGreater(below, axes[0].get_window_extent().y1)
        self.assertAlmostEqual(axes[0].get_window_extent().height, before, delta=1.0)

    def test_phases_are_drawn_beside_temperatures_where_they_change(self):
        import numpy as np
        from trajectories import Frame, Trajectory
        from figures import particles

        def run(*phases):
            return Trajectory(
                times=np.arange(len(phases)),
                strobe=[Frame(t, np.zeros((2, 3)), phase=np.array(p)) for t, p in enumerate(phases)],
            )

        self.assertTrue(particles.changes_phase(run([0, 2], [2, 2])))
        self.assertFalse(particles.changes_phase(run([0, 2], [0, 2])))
        self.assertFalse(particles.changes_phase(run([0, -1], [0, 2])))  # flowed in, did not change

    def test_solids_that_liquid_hides_are_cut_open_and_those_in_sight_are_not(self):
        import numpy as np
        from trajectories import Frame, Trajectory
        from figures import particles

        grid = np.stack(np.meshgrid(*[np.arange(12.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        ball = np.linalg.norm(grid - 5.5, axis=1) < 5.2
        lying = grid[:, 2] > 5
        view = lambda p: p[:, [0, 2, 1]]
        for solid, plane in ((ball, 5.5), (lying, -np.inf)):
            phase = np.where(solid, 2, 0)
            run = Trajectory(
                times=np.arange(2), strobe=[Frame(0.0, grid, phase=phase), Frame(1.0, grid + 0.01, phase=phase)]
            )
            self.assertAlmostEqual(particles.cut_through(run, np.zeros(len(grid), bool), view, 1.0), plane)

    def test_a_turn_between_far_frames_follows_the_angular_velocity(self):
        import numpy as np
        from figures import bodies
        from trajectories import Trajectory

        time = np.arange(0.0, 8.0, 0.4)
        axis, spin = (
            np.array([0.6, 0.0, 0.8]),
            3.7,
        )  # [rad/s]: 85 degrees from frame to frame, so that straight lines would be a zigzag
        half = 0.5 * spin * time[:, None]
        attitude = (
            np.concatenate([np.cos(half), np.sin(half) * axis], axis=1) * np.where(np.arange(20) % 3, 1, -1)[:, None]
        )  # either sign is the same attitude
        run = Trajectory(
            times=time,
            body_times=time,
            bodies={"orientation": attitude[:, None], "angular_velocity": np.tile(spin * axis, (20, 1, 1))},
        )
        fine, turn = bodies.between(bodies.TURN, run, 0, time, np.zeros(20))
        exact = np.degrees(np.abs((spin * fine + np.pi) % (2 * np.pi) - np.pi))
        self.assertGreater(len(fine), 200)
        self.assertLess(np.abs(turn - exact).max(), 0.3)  # [degrees]: the cubic's own error at 85 degrees a frame
        del run.bodies["angular_velocity"]
        self.assertEqual(len(bodies.between(bodies.TURN, run, 0, time, np.zeros(20))[0]), 20)

    def test_the_centre_between_frames_follows_the_velocity(self):
        import numpy as np
        from figures import bodies
        from trajectories import Trajectory

        time = np.linspace(0.0, 2.0, 4)
        run = Trajectory(
            times=time,
            body_times=time,
            bodies={"velocity": np.stack([0 * time, 0 * time, 5 - 9.81 * time], axis=1)[:, None]},
        )
        fine, height = bodies.between("z " + bodies.CENTRE, run, 0, time, 5 * time - 9.81 * time**2 / 2)
        self.assertLess(np.abs(height - (5 * fine - 9.81 * fine**2 / 2)).max(), 1e-12)

    def test_a_rigid_cube_is_drawn_as_the_faces_that_look_at_the_viewer(self):
        import numpy as np
        import shapes
        from figures import solids

        cube = {
            "name": "cube",
            "phase": "rigid",
            "motion": "free",
            "centre": [1.0, 2.0, 3.0],
            "shape": {"kind": "box", "min": [0.5, 1.5, 2.5], "max": [1.5, 2.5, 3.5]},
        }
        (shape,) = shapes.shapes_of({"bodies": [cube]})
        straight = solids.parts(shape, (np.zeros(3), np.array([1.0, 0, 0, 0])), lambda points: points[:, [0, 2, 1]])
        self.assertEqual(len(straight), 1)  # seen along its y axis
        np.testing.assert_allclose(np.abs(straight[0][2]), 0.5)
        turned = solids.parts(
            shape, (np.zeros(3), np.array([0.9, 0.3, 0.2, 0.1]) / np.sqrt(0.95)), lambda points: points[:, [0, 2, 1]]
        )
        self.assertEqual(len(turned), 3)
        self.assertEqual(solids.parts(shape, (np.full(3, np.nan), np.array([1.0, 0, 0, 0])), lambda points: points), [])

    def test_a_scene_with_a_liquid_or_a_mesh_or_a_torn_job_is_drawn_by_its_particles(self):
        import shapes

        ball = {
            "name": "ball",
            "phase": "rigid",
            "centre": [0, 0, 0],
            "shape": {"kind": "sphere", "centre": [0, 0, 0], "radius": 1},
        }
        self.assertEqual(len(shapes.shapes_of({"bodies": [ball]})), 1)
        for other in (
            {**ball, "phase": "liquid"},
            {**ball, "shape": {"kind": "mesh", "file": "a.stl"}},
            {**ball, "rotation": [0.6, 0.8, 0, 0]},
            {"name": "torn"},
            {**ball, "centre": [None, 0, 0]},
        ):
            self.assertEqual(shapes.shapes_of({"bodies": [ball, other]}), [])

    def test_a_profile_of_round_off_is_not_drawn(self):
        import numpy as np
        from trajectories import Trajectory
        from figures import profiles

        place = np.stack(np.meshgrid(np.arange(8.0), np.arange(4.0), [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
        across = Trajectory(times=np.arange(1), position=place, temperature=300 + np.where(place[:, 1] % 2, 5.0, -5.0))
        along = Trajectory(times=np.arange(1), position=place, temperature=300 + place[:, 0])
        self.assertTrue(profiles.flat([(None, across)], 0))
        self.assertFalse(profiles.flat([(None, along)], 0))


if __name__ == "__main__":
    unittest.main()
