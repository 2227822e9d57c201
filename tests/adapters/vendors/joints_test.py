# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a job as adapters see them: sides, trees and loops, rates at the start, refusals, and MuJoCo's model."""

import os
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

HERE = Path(__file__).resolve().parent
ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
sys.path[:0] = [str(ADAPTERS), str(HERE)]

from engine_dart import Dart  # noqa: E402
from engine_drake import Drake  # noqa: E402
from engine_jolt import Jolt  # noqa: E402
from engine_mujoco import Mujoco, model_text  # noqa: E402
from engine_ode import Ode  # noqa: E402
from engine_rapier import Rapier  # noqa: E402
from engine_rapier_f64 import RapierDouble  # noqa: E402
from joints import WORLD, joints_of, start_rate, tree_of  # noqa: E402
from rigid import bodies_of  # noqa: E402
from scenes import body, job  # noqa: E402

ENGINES = (Mujoco, Drake, Dart, Ode, Rapier, Jolt)


def joint(name, kind, first, second, place, axis=None, **laws):
    plain = {"other_place": None, "other_axis": None, "limits": None}
    laws = {"restitution": 0.0, "friction": 0.0, "damping": 0.0, **laws}
    whole = {"name": name, "kind": kind, "bodies": [first, second], "place": place, "axis": axis}
    return {**plain, "spring": None, "motor": None, **whole, **laws}


def rod(name, index, x, **words):
    """From x to x + 1 m, at rest."""
    still = {"velocity": [0.0, 0.0, 0.0], "centre": [x + 0.5, 0.0, 0.0], "principal_inertia": [0.01, 0.1, 0.1]}
    return body(**{"name": name, "index": index, **still, **words})


def given(joints, count=2, **scene):
    rods = scene.pop("rods", [rod(f"r{k}", k, float(k)) for k in range(count)])
    words = {"preset": "Euler", "contact": "none", "joints": joints, **scene}
    document = job(rods, **words)
    return SimpleNamespace(
        document=document,
        scene=document["scene"],
        bodies=document["scene"]["bodies"],
        preset=document["preset"],
        settings=document["settings"],
        time_step=0.01,
        times=document["times"],
    )


Y = [0.0, 1.0, 0.0]
CHAIN = [joint("a", "hinge", "r0", "world", [0.0, 0.0, 0.0], Y), joint("b", "hinge", "r0", "r1", [1.0, 0.0, 0.0], Y)]


class Trees(unittest.TestCase):
    def test_a_side_is_in_the_frame_of_its_body(self):
        one = joints_of(given(CHAIN), bodies_of(given(CHAIN)))[1]
        self.assertEqual(one.one.point, (0.5, 0.0, 0.0))
        self.assertEqual(one.other.point, (-0.5, 0.0, 0.0))

    def test_a_chain_hangs_on_the_world_parents_first(self):
        held = given(CHAIN)
        links, loops = tree_of(bodies_of(held), joints_of(held, bodies_of(held)))
        self.assertEqual([(link.number, link.parent, link.sign) for link in links], [(0, WORLD, 1.0), (1, 0, -1.0)])
        self.assertEqual(loops, [])

    def test_a_second_joint_to_the_world_closes_a_loop_and_a_distance_always_does(self):
        closing = joint("c", "hinge", "r1", "world", [2.0, 0.0, 0.0], Y)
        tied = joint("d", "distance", "r1", "world", [2.0, 0.0, 0.0], None, other_place=[2.0, 0.0, 1.0])
        held = given([*CHAIN, closing, tied])
        _, loops = tree_of(bodies_of(held), joints_of(held, bodies_of(held)))
        self.assertEqual([one.name for one in loops], ["c", "d"])

    def test_bodies_that_nothing_holds_are_roots(self):
        held = given(CHAIN[1:], count=3)
        links, _ = tree_of(bodies_of(held), joints_of(held, bodies_of(held)))
        self.assertEqual([(link.number, link.joint is None) for link in links], [(0, True), (1, False), (2, True)])

    def test_the_rate_is_that_of_the_first_body_against_the_second(self):
        rods = [rod("r0", 0, 0.0), rod("r1", 1, 1.0, angular_velocity=[0.0, 2.0, 0.0], velocity=[0.0, 0.0, -1.0])]
        held = given(CHAIN, rods=rods)
        one = joints_of(held, bodies_of(held))[1]
        self.assertEqual(start_rate(one, bodies_of(held)), -2.0)


class Refusals(unittest.TestCase):
    def test_every_adapter_takes_hinges_and_says_so(self):
        for engine in ENGINES:
            self.assertIn("joint", engine.capabilities, engine.name)
            held = given(CHAIN)
            held.preset = engine.presets[0]
            self.assertEqual(engine().refusal(held), "", engine.name)

    def test_an_adapter_without_joints_refuses_them_by_name(self):
        held = given(CHAIN)
        held.preset = RapierDouble.presets[0]
        self.assertIn("joints are not handed to", RapierDouble().refusal(held))
        self.assertNotIn("joint", RapierDouble.capabilities)

    def test_what_an_engine_lacks_is_named(self):
        speed = [joint("a", "hinge", "r0", "world", [0.0, 0.0, 0.0], Y, motor={"effort": None, "speed": 1.0})]
        held = given(speed, count=1)
        self.assertIn("no speed of a joint, and a has one", Mujoco().refusal(held))
        tied = joint("d", "distance", "r0", "world", [0.0, 0.0, 0.0], None, other_place=[0.0, 0.0, 1.0])
        held = given([tied], count=1)
        held.preset = Rapier.presets[0]
        self.assertIn("no joint of kind distance", Rapier().refusal(held))

    def test_velocities_that_break_a_joint_are_refused(self):
        held = given(CHAIN, rods=[rod("r0", 0, 0.0), rod("r1", 1, 1.0, velocity=[0.0, 0.0, 1.0])])
        self.assertIn("break the joint b", Mujoco().refusal(held))

    def test_joints_where_bodies_touch_go_to_mujoco_alone(self):
        held = given(CHAIN, contact="auto")
        self.assertEqual(Mujoco().refusal(held), "")
        held.preset = Ode.presets[0]
        self.assertIn('contact = "none"', Ode().refusal(held))

    def test_a_continuous_plant_closes_no_loop(self):
        held = given([*CHAIN, joint("c", "hinge", "r1", "world", [2.0, 0.0, 0.0], Y)])
        held.preset = "runge_kutta3"
        self.assertIn("c closes one", Drake().refusal(held))


class Model(unittest.TestCase):
    def test_bodies_are_nested_and_angles_are_radians(self):
        held = given([*CHAIN[:1], joint("b", "hinge", "r1", "r0", [1.0, 0.0, 0.0], Y, limits=[-0.1, 0.5], damping=2.0)])
        text = model_text(held, bodies_of(held), 0.01)
        for words in (
            'angle="radian"',
            '<body name="b1" pos="1.0 0.0 0.0"',
            'range="-0.1 0.5"',
            'damping="2.0"',
            'solreflimit="0.02 1"',
        ):
            self.assertIn(words, text)
        self.assertLess(text.index('name="b1"'), text.index("</body>"))

    def test_a_loop_of_hinges_is_held_at_two_points_with_the_steps_own_time_constant(self):
        held = given([*CHAIN, joint("c", "hinge", "r1", "world", [2.0, 0.0, 0.0], Y)])
        text = model_text(held, bodies_of(held), 0.001)
        self.assertEqual(text.count("<connect"), 2)
        self.assertIn('solref="0.002 1"', text)

    def test_a_spring_is_a_tendon_between_sites(self):
        held = given(
            [],
            count=1,
            springs=[
                {
                    "body": "r0",
                    "point": [1.0, 0.0, 0.0],
                    "other": "world",
                    "other_point": [2.0, 0.0, 0.0],
                    "stiffness": 3.0,
                    "damping": 0.5,
                    "length": None,
                }
            ],
        )
        text = model_text(held, bodies_of(held), 0.01)
        self.assertIn('stiffness="3.0" damping="0.5" springlength="1.0"', text)
        self.assertEqual(text.count("<site name="), 2)


if __name__ == "__main__":
    unittest.main()
