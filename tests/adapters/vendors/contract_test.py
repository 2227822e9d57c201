# SPDX-License-Identifier: BSD-3-Clause
"""What the adapters of installed engines share: the calls, the refusals, surfaces and steps. MuJoCo's adapter runs on a
stand-in."""

import json
import math
import os
import shutil
import sys
import tempfile
import unittest
from ctypes import sizeof
from pathlib import Path
from types import SimpleNamespace

HERE = Path(__file__).resolve().parent
ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
sys.path[:0] = [str(ADAPTERS), str(HERE)]

import engine_mujoco  # noqa: E402
from contract import read_job  # noqa: E402
from environments import catalogue  # noqa: E402
from lattice import formula  # noqa: E402
from engine_drake import Drake  # noqa: E402
from engine_jolt import Jolt, piece_words  # noqa: E402
from engine_mujoco import model_text  # noqa: E402
from engine_ode import plane_of  # noqa: E402
from engine_rapier import Rapier  # noqa: E402
from ode_library import Contact, ContactGeom, Mass, Surface  # noqa: E402
from rigid import body_of, moves, pieces_of, steps_in, upright  # noqa: E402
from rotation import IDENTITY, between, product, rotate  # noqa: E402
from scenes import body, check, floor, job, run  # noqa: E402

MUJOCO = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_mujoco.py")]
STAND_IN = {**os.environ, "PYTHONPATH": str(HERE / "fake")}


def mujoco(bodies, **words):
    return run(MUJOCO, job(bodies, preset=words.pop("preset", "Euler"), **words), STAND_IN)


def refusal(bodies, **words):
    answer = check(MUJOCO, job(bodies, preset=words.pop("preset", "Euler"), **words), STAND_IN)
    return "" if answer["can"] else answer["reason"]


class Calls(unittest.TestCase):
    def test_a_broken_job_ends_with_2_and_leaves_no_result(self):
        for text in ("{", "{}", '{"contract": 2}'):
            end = run(MUJOCO, text, STAND_IN)
            self.assertEqual((end.code, end.result), (2, None), text)

    def test_times_that_fall_are_a_broken_job(self):
        self.assertEqual(mujoco([body()], times=(0.0, 1.0, 0.5)).code, 2)

    def test_a_refusal_ends_with_4_and_says_why(self):
        end = mujoco([body(phase="elastic")])
        self.assertEqual((end.code, end.result["status"]), (4, "refused"))
        self.assertIn("elastic", end.result["message"])

    def test_mujoco_that_begins_anew_is_diverged(self):
        end = mujoco([body()], gravity=[0.0, 0.0, -1e8], times=(0.0, 1.0, 900.0))
        self.assertEqual((end.code, end.result["status"]), (7, "diverged"))
        self.assertIn("began anew", end.result["message"])

    def test_a_state_that_is_not_finite_is_diverged(self):
        end = mujoco([body()], gravity=[0.0, 0.0, -1e308], times=(0.0, 1.0, 900.0))
        self.assertEqual((end.code, end.result["status"], end.result["divergence"]["body"]), (7, "diverged", 0))


class Refusals(unittest.TestCase):
    def test_each_names_the_body_and_the_reason(self):
        for change, word in (
            ({"temperature": {"kind": "constant", "value": 300.0}}, "heat"),
            ({"joined_to": ["b"]}, "bonds"),
            ({"motion": "prescribed"}, "prescribed"),
            ({"motion": "prescribed", "angular_velocity": [0.0, 0.0, 1.0]}, "prescribed"),
            ({"principal_inertia": [0.0, 1.0, 1.0]}, "moments"),
        ):
            reason = refusal([body(**change)])
            self.assertIn(word, reason)
            self.assertIn("cube", reason)

    def test_scenes_of_the_particle_solver_are_refused(self):
        for scene, word in (
            ({"mode": "paper"}, "paper"),
            ({"periodic": [True, False, False]}, "periodic"),
            ({"inflows": [{}]}, "inflow"),
            ({"events": [{}]}, "events"),
        ):
            self.assertIn(word, refusal([body()], **scene))

    def test_a_shape_without_a_surface_is_refused_only_where_it_can_be_touched(self):
        pipe = body(shape={"kind": "difference", "of": []})
        self.assertEqual(refusal([pipe]), "")
        self.assertIn("difference", refusal([pipe, floor()]))

    def test_rods_are_handed_over(self):
        rod = {"kind": "cylinder", "base": [0, 0, 0], "axis": [0, 1, 0], "length": 1.0, "radius": 0.1}
        floor_box = floor(shape={"kind": "box", "min": [-1, -1, -1], "max": [1, 1, 0]})
        for name, engine in catalogue()["engines"].items():
            if "(RigidEngine)" not in (ADAPTERS / engine["adapter"]).read_text(encoding="utf-8"):
                continue
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / engine["adapter"])]
            with self.subTest(name):
                self.assertTrue(check(command, job([body(shape=rod), floor_box], preset=engine["presets"][0]))["can"])

    def test_mujoco_has_no_restitution_but_contacts_that_are_springs(self):
        self.assertIn("no coefficient of restitution", refusal([body(), floor()], settings={"restitution": 0.5}))
        self.assertEqual(refusal([body(), floor()], settings={"restitution": 0.5, "solref": "-1e5 0"}), "")
        self.assertEqual(refusal([body(), floor()], settings={"restitution": 0.0}), "")
        self.assertEqual(refusal([body()], settings={"restitution": 0.5}), "")  # alone it hits nothing

    def test_presets_and_settings_are_the_vendors_own_words(self):
        self.assertIn("Euler, implicitfast", refusal([body()], preset="tuned"))
        self.assertIn("no setting 'gyro'", refusal([body()], settings={"gyro": "off"}))
        self.assertIn("above zero", refusal([body()], settings={"time_step": 0.0}))

    def test_every_adapter_of_rigid_bodies_takes_a_block_and_refuses_what_it_has_no_law_for(self):
        for name, engine in catalogue()["engines"].items():
            if name in ("scikit-fem", "calculix", "splishsplash"):  # of fields: below; of liquids: liquid_test.py
                continue
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / engine["adapter"])]
            preset = engine["presets"][0]
            with self.subTest(name):
                self.assertEqual(check(command, job([body()], preset=preset)), {"can": True, "reason": ""})
                self.assertIn("elastic", check(command, job([body(phase="elastic")], preset=preset))["reason"])
                self.assertIn(
                    "no setting", check(command, job([body()], preset=preset, settings={"no_such": 1.0}))["reason"]
                )

    def test_rapier_refuses_a_spin_that_it_would_slow_down(self):
        command = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_rapier.py")]
        for spin, word in ((70.0, ""), (90.0, "pi/4")):
            self.assertIn(
                word, check(command, job([body(angular_velocity=[0.0, 0.0, spin])], preset="SIMPLIFIED"))["reason"]
            )

    def test_explicit_euler_refuses_tops_whose_energy_it_multiplies_beyond_bounds(self):
        top = body(angular_velocity=[1.0, 2.0, 3.0], principal_inertia=[0.0417, 0.095, 0.1117])
        for file, preset, word in (
            ("engine_dart.py", "default", "multiplies the energy"),
            ("engine_mujoco.py", "Euler", "multiplies the energy"),
            ("engine_mujoco.py", "RK4", ""),
        ):
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / file)]
            self.assertEqual(check(command, job([top], preset=preset, times=[0.0, 1.0], time_step=0.01))["reason"], "")
            self.assertIn(
                word, check(command, job([top], preset=preset, times=[0.0, 1000.0], time_step=0.01))["reason"]
            )

    def test_dart_refuses_half_spaces(self):
        command = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_dart.py")]
        self.assertIn("floor", check(command, job([body(), floor()]))["reason"])


class Formulas(unittest.TestCase):
    def test_arithmetic_of_the_place_is_worked_out_and_nothing_else_is(self):
        self.assertAlmostEqual(formula("0.2*x^2/0.4 - max(y, sin(pi*z))", (2.0, 3.0, 0.5)), 2.0 - 3.0)
        for text in ("__import__('os')", "x.real", "open('f')", "[x]", "t"):
            with self.assertRaises(ValueError):
                formula(text, (0.0, 0.0, 0.0))


class Surfaces(unittest.TestCase):
    def test_a_box_in_a_turned_frame_stays_where_it_is(self):
        frame = between((0.0, 0.0, 1.0), (1.0, 1.0, 0.0))
        (piece,) = pieces_of(body()["shape"], (0.5, 0.1, 1.0), frame)
        back = rotate(frame, piece.centre)
        for found, wanted in zip(back, (0.0, -0.1, 0.0)):
            self.assertAlmostEqual(found, wanted, delta=1e-15)
        turned = product(frame, piece.rotation)  # of the box itself: it is along the world's axes
        self.assertAlmostEqual(abs(turned[0]), 1.0, delta=1e-15)
        self.assertEqual(tuple(round(c, 12) for c in piece.size), (0.2, 0.2, 0.1))

    def test_a_plane_looks_along_its_normal(self):
        for normal in ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 2.0, -2.0)):
            (piece,) = pieces_of(
                {"kind": "half_space", "point": [0, 0, 0], "normal": normal}, (0.0, 0.0, 0.0), IDENTITY
            )
            found = rotate(piece.rotation, (0.0, 0.0, 1.0))
            for a, b in zip(found, (c / math.dist((0, 0, 0), normal) for c in normal)):
                self.assertAlmostEqual(a, b, delta=1e-15)

    def test_a_union_is_the_pieces_of_its_parts_and_a_difference_is_none(self):
        box = body()["shape"]
        self.assertEqual(len(pieces_of({"kind": "union", "of": [box, box]}, (0, 0, 0), IDENTITY)), 2)
        self.assertIsNone(pieces_of({"kind": "union", "of": [box, {"kind": "difference"}]}, (0, 0, 0), IDENTITY))

    def test_a_rod_lies_along_its_axis_and_upright_ones_along_y(self):
        rod = {"kind": "cylinder", "base": [0.0, -0.2, 1.0], "axis": [0.0, 1.0, 0.0], "length": 0.4, "radius": 0.1}
        frame = between((0.0, 0.0, 1.0), (1.0, 1.0, 0.0))
        (piece,) = pieces_of(rod, (0.0, 0.0, 0.0), frame)
        self.assertEqual((piece.kind, piece.size), ("cylinder", (0.1, 0.1, 0.2)))
        for turn, along in ((piece.rotation, (0.0, 0.0, 1.0)), (upright(piece).rotation, (0.0, 1.0, 0.0))):
            for found, wanted in zip(rotate(frame, rotate(turn, along)), (0.0, 1.0, 0.0)):
                self.assertAlmostEqual(found, wanted, delta=1e-14)
        for found, wanted in zip(rotate(frame, piece.centre), (0.0, 0.0, 1.0)):
            self.assertAlmostEqual(found, wanted, delta=1e-14)

    def test_a_cylinder_with_a_ball_at_each_end_is_a_capsule(self):
        rod = {"kind": "cylinder", "base": [0.0, 0.0, 0.0], "axis": [0.0, 1.0, 0.0], "length": 0.4, "radius": 0.1}
        balls = [{"kind": "sphere", "centre": [0.0, y, 0.0], "radius": 0.1} for y in (0.0, 0.4)]
        found = {
            kind.kind for kind in pieces_of({"kind": "union", "of": [balls[0], rod, balls[1]]}, (0, 0, 0), IDENTITY)
        }
        self.assertEqual(found, {"capsule"})
        for other in ({**balls[1], "radius": 0.11}, {**balls[1], "centre": [0.0, 0.3, 0.0]}):
            self.assertEqual(len(pieces_of({"kind": "union", "of": [balls[0], rod, other]}, (0, 0, 0), IDENTITY)), 3)


class Presets(unittest.TestCase):
    def test_a_preset_is_its_settings_and_the_jobs_own_go_before(self):
        texts = {}
        laws = [{"materials": ["stuff", "stuff"], "friction": 0.3, "restitution": None}]
        for words, settings in (("preset", {}), ("own", {"solimp": "0.9 0.9 0.001 0.5 2"})):
            seen = []
            engine = engine_mujoco.Mujoco()
            engine.open = lambda given, bodies, dt: seen.append(model_text(given, bodies, dt))
            path = Path(tempfile.mkdtemp()) / "job.json"
            scene = job([body(), floor()], preset="hard-contact", settings=settings, contacts=laws)
            path.write_text(json.dumps(scene))
            self.addCleanup(shutil.rmtree, path.parent)
            with self.assertRaises(AttributeError):  # there is no world to go on with
                engine.run(read_job(str(path)))
            texts[words] = seen[0]
        for words in (
            'integrator="implicitfast"',
            'solref="0.02 1"',
            'solimp="0.99 0.999 0.001 0.5 2"',
        ):  # two steps of 10 ms
            self.assertIn(words, texts["preset"])
        for pair in (text[text.index("<pair ") :] for text in texts.values()):
            self.assertIn('solref="0.02 1" solimp=', pair)
        self.assertEqual(texts["own"].count('solimp="0.9 0.9 0.001 0.5 2"'), 3)  # of two geoms and their pair

    def test_presets_that_cost_settings_are_presets_of_the_engine(self):
        for engine in (engine_mujoco.Mujoco, Jolt, Rapier, Drake):
            self.assertLessEqual(set(engine.preset_settings), set(engine.presets))
            for settings in engine.preset_settings.values():
                self.assertLessEqual(set(settings), set(engine.settings), engine.name)


class Steps(unittest.TestCase):
    def test_equal_steps_end_at_each_output_time(self):
        self.assertEqual([steps_in(0.4, 0.01), steps_in(0.4, 0.015), steps_in(0.4, 1.0)], [40, 27, 1])
        end = mujoco([body()], times=(0.0, 0.4, 1.0), time_step=0.1)
        self.assertEqual((end.result["steps"], end.result["time_reached"]), (10, 1.0))

    def test_the_setting_goes_before_the_scene_and_the_scene_before_the_vendors_own(self):
        self.assertAlmostEqual(mujoco([body()], settings={"time_step": 0.25}).result["readback"]["time_step"], 0.25)
        self.assertAlmostEqual(mujoco([body()], time_step=None).result["readback"]["time_step"], 0.002)


class MujocoAdapter(unittest.TestCase):
    def test_the_flight_is_its_schemes_own(self):
        end = mujoco([body()])
        self.assertEqual(end.code, 0)
        last, dt = end.rows[-1], 0.01
        self.assertAlmostEqual(
            last["z"], 1.0 + 3.0 - 9.81 / 2 - 9.81 * dt / 2, delta=1e-12
        )  # semi-implicit Euler lags by g dt t/2
        self.assertAlmostEqual(last["vx"], 1.0, delta=1e-15)

    def test_a_turned_principal_frame_starts_as_the_identity_and_the_spin_is_the_worlds(self):
        end = mujoco([body(principal_axes=list(between((0, 0, 1), (1, 0, 0))), angular_velocity=[0.0, 0.7, 0.2])])
        first, last = end.rows[0], end.rows[-1]
        self.assertAlmostEqual(first["qw"], 1.0, delta=1e-15)
        self.assertAlmostEqual(last["wy"], 0.7, delta=1e-12)
        self.assertAlmostEqual(2.0 * math.acos(last["qw"]), math.hypot(0.7, 0.2), delta=1e-4)  # the turn of 1 s

    def test_masses_and_gravity_are_read_back_from_the_engine(self):
        held = mujoco([body(), floor()]).result["readback"]
        self.assertEqual((held["gravity"], held["precision"]), ([0.0, 0.0, -9.81], "double"))
        self.assertEqual(
            [(b["name"], b["mass"], b["principal_inertia"]) for b in held["bodies"]], [("cube", 8.0, [1.0, 2.0, 2.5])]
        )

    def test_a_fixed_body_stays(self):
        rows = [row for row in mujoco([body(), floor()]).rows if row["body"] == 1.0]
        self.assertEqual({(row["x"], row["z"], row["vz"], row["qw"]) for row in rows}, {(0.0, -0.5, 0.0, 1.0)})

    def test_the_model_says_the_presets_integrator_and_the_contacts_settings(self):
        given = SimpleNamespace(
            scene=job([])["scene"], preset="RK4", settings={"friction": 0.5, "solref": "-1000 -10"}, bodies=[]
        )
        text = model_text(given, [body_of(body(), True), body_of(floor(), True)], 0.004)
        for words in (
            'integrator="RK4"',
            'timestep="0.004"',
            'friction="0.5 0 0"',
            'condim="3"',
            'solref="-1000 -10"',
            'type="plane"',
            'diaginertia="1.0 2.0 2.5"',
        ):
            self.assertIn(words, text)


class Laws(unittest.TestCase):
    def test_the_model_gets_the_friction_of_all_engines(self):
        given = SimpleNamespace(
            scene=job([])["scene"], preset="Euler", settings={"friction": 0.25}, bodies=[body(), floor()]
        )
        self.assertIn(
            'friction="0.25 0 0" condim="3"', model_text(given, [body_of(body(), True), body_of(floor(), True)], 0.004)
        )

    def test_every_rigid_engine_takes_friction_and_restitution_0(self):
        for name, engine in catalogue()["engines"].items():
            if "(RigidEngine)" not in (ADAPTERS / engine["adapter"]).read_text(encoding="utf-8"):
                continue
            command = ["/usr/bin/python3", "-B", str(ADAPTERS / engine["adapter"])]
            with self.subTest(name):
                self.assertEqual(
                    check(
                        command,
                        job([body()], preset=engine["presets"][0], settings={"friction": 0.3, "restitution": 0.0}),
                    )["reason"],
                    "",
                )

    def test_the_read_back_says_what_friction_the_engine_holds(self):
        (held,) = mujoco([body(), floor()], settings={"friction": 0.25}).result["readback"]["bodies"]
        self.assertEqual((held["friction"], held["restitution"]), (0.25, None))

    def test_a_board_that_goes_on_at_its_velocity_is_where_it_is(self):
        board = body_of(floor(velocity=[0.5, 0.0, 0.0]) | {"motion": "prescribed"}, True)
        self.assertTrue(moves(board))
        self.assertFalse(moves(body_of(floor(), True)) or moves(body_of(body(), True)))
        command = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_ode.py")]
        self.assertTrue(
            check(
                command,
                job([body(), floor() | {"motion": "prescribed", "velocity": [0.5, 0.0, 0.0]}], preset="dWorldStep"),
            )["can"]
        )


class OdeAdapter(unittest.TestCase):
    def test_structures_have_the_sizes_of_the_c_headers(self):
        self.assertEqual([sizeof(s) for s in (Mass, Surface, ContactGeom, Contact)], [136, 120, 96, 248])

    def test_a_half_space_is_a_plane_in_the_world(self):
        shape = {"kind": "half_space", "point": [0.0, 0.0, 0.3], "normal": [0.0, 0.6, 0.8]}
        turned = list(between((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))
        held = body_of(body(motion="fixed", shape=shape, principal_axes=turned), True)
        normal, offset = plane_of(held, held.pieces[0])
        for found, wanted in zip((*normal, offset), (0.0, 0.6, 0.8, 0.24)):
            self.assertAlmostEqual(found, wanted, delta=1e-15)


class JoltAdapter(unittest.TestCase):
    COMMAND = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_jolt.py")]
    ENVIRONMENT = {**os.environ, "PATH": str(HERE / "fake")}

    def test_it_drives_a_process_of_node_to_the_end(self):
        end = run(self.COMMAND, job([body(), floor()]), self.ENVIRONMENT)
        self.assertEqual((end.code, end.result["readback"]["precision"]), (0, "single"))
        self.assertAlmostEqual(end.rows[-2]["z"], 1.0 + 3.0 - 9.81 / 2 - 9.81 * 0.01 / 2, delta=1e-12)

    def test_numbers_that_json_has_no_word_for_are_a_divergence(self):
        end = run(self.COMMAND, job([body(mass=0.5)]), self.ENVIRONMENT)
        self.assertEqual((end.code, end.result["status"]), (7, "diverged"))

    def test_a_half_space_is_handed_over_as_normal_and_constant(self):
        held = body_of(floor(), True)
        self.assertEqual(piece_words(held.pieces[0]), {"kind": "plane", "normal": (0.0, 0.0, 1.0), "constant": -0.5})

    def test_a_union_with_a_half_space_is_refused(self):
        whole = floor()
        whole["shape"] = {"kind": "union", "of": [whole["shape"]]}
        self.assertIn("floor", check(self.COMMAND, job([body(), whole]))["reason"])


if __name__ == "__main__":
    unittest.main()
