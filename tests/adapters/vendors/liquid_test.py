# SPDX-License-Identifier: BSD-3-Clause
"""What SPlisHSPlasH is handed and what it refuses, and the files of its scene; the engine itself is not needed."""

import json
import math
import os
import struct
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ADAPTERS = Path(os.environ["TRIPOINT_VENDORS"])
sys.path[:0] = [str(ADAPTERS), str(HERE)]

from contract import read_job  # noqa: E402
from engine_splishsplash import boundary_viscosity, natural_limit  # noqa: E402
from scenes import body, check, job  # noqa: E402
from splishsplash_bodies import UNIT_BALL, UNIT_BOX, cuboids_of, equal_half, mesh_of, solid_of, touched  # noqa: E402
from splishsplash_scene import mirrored, write_particles  # noqa: E402

COMMAND = ["/usr/bin/python3", "-B", str(ADAPTERS / "engine_splishsplash.py")]
REST = {"kind": "constant", "value": [0.0, 0.0, 0.0]}
WATER = {"name": "water", "density": 1000.0, "viscosity": 2.0, "stiffness": 100.0}
WOOD = {"name": "wood", "density": 500.0, "viscosity": 0.0, "stiffness": 100.0}
LIQUID = {
    "name": "pool",
    "index": -1,
    "material": "water",
    "phase": "liquid",
    "velocity": [0.0, 0.0, 0.0],
    "velocity_field": REST,
    "shape": {"kind": "box", "min": [0.0, 0.0, 0.0], "max": [1.0, 0.6, 0.5]},
}
BLOCK = {
    "name": "block",
    "material": "wood",
    "velocity": [0.0, 0.0, 0.0],
    "velocity_field": REST,
    "shape": {"kind": "box", "min": [0.4, 0.2, 0.5], "max": [0.6, 0.4, 0.7]},
}
TANK = {
    **BLOCK,
    "name": "tank",
    "index": 1,
    "motion": "fixed",
    "slip": "free",
    "shape": {"kind": "box", "min": [-0.2, -0.2, -0.2], "max": [1.2, 0.8, 0.0]},
}


def scene(liquid=None, tank=None, others=(), **words):
    bodies = [body(**{**LIQUID, **(liquid or {})}), body(**{**TANK, **(tank or {})}), *others]
    return job(bodies, **{"preset": "DFSPH", "materials": [WATER, WOOD], "min": None, "max": None, **words})


def reason(*words, **changes):
    return check(COMMAND, scene(*words, **changes))["reason"]


class Refusals(unittest.TestCase):
    def test_a_liquid_in_a_tank_is_taken(self):
        self.assertEqual(check(COMMAND, scene()), {"can": True, "reason": ""})

    def test_what_it_has_no_law_for_is_refused_by_name(self):
        for changes, word in (
            ({"mode": "paper"}, "paper"),
            ({"events": [{"kind": "grip", "bodies": []}]}, "events"),
            ({"liquid": {"phase": "rigid"}}, "one liquid, and there are 0"),
            ({"liquid": {"temperature": {"kind": "constant", "value": 300.0}}}, "heat"),
            ({"tank": {"motion": "prescribed"}}, "prescribed"),
            ({"tank": {"phase": "elastic"}}, "elastic"),
            ({"preset": "PBD"}, "no preset"),
            ({"settings": {"gyro": 1.0}}, "no setting"),
            ({"settings": {"time_step": 0.0}}, "above zero"),
        ):
            self.assertIn(word, reason(**changes), changes)

    def test_bodies_float_sink_and_meet_where_their_shapes_have_contact(self):
        floats, iron = body(**BLOCK, slip="free"), body(**{**BLOCK, "material": "water"}, slip="free")
        second = body(**{**BLOCK, "name": "second", "index": 2}, slip="free")
        rod = {"kind": "cylinder", "base": [0.5, 0.3, 0.3], "axis": [0.0, 0.0, 1.0], "length": 0.2, "radius": 0.1}
        for bodies in ([floats], [iron], [floats, second], [{**iron, "velocity": [0.0, 0.0, 1.0]}]):
            self.assertEqual(reason(others=bodies), "")
        self.assertEqual(reason(others=[floats], gravity=[0.0, 0.0, -1.62]), "")
        self.assertEqual(reason(others=[{**floats, "shape": rod}]), "")
        self.assertIn("are boxes or balls", reason(others=[{**iron, "shape": rod}]))
        self.assertIn("not made of them", reason(tank={"shape": rod}, others=[iron]))
        tiny = {"kind": "sphere", "centre": [0.5, 0.3, 0.4], "radius": 0.015}
        self.assertIn("not much larger", reason(others=[{**iron, "shape": tiny}]))

    def test_of_events_only_the_hold_of_bodies_is_taken(self):
        hold = {"kind": "hold", "bodies": ["block"], "time": 0.0, "until": 0.1}
        self.assertEqual(reason(others=[body(**BLOCK, slip="free")], events=[hold]), "")
        self.assertIn("hold of bodies", reason(events=[{**hold, "kind": "grip"}]))

    def test_two_mirrors_stand_for_a_period_across_which_nothing_flows(self):
        period = {"periodic": ["y"], "min": [-0.2, 0.0, -0.2], "max": [1.2, 0.6, 1.0]}
        wide = {"shape": {"kind": "box", "min": [-0.2, 0.0, -0.2], "max": [1.2, 0.6, 0.0]}}
        self.assertEqual(reason(tank=wide, **period), "")
        self.assertIn("gravity drives along it", reason(tank=wide, gravity=[0.0, 1.0, 0.0], **period))
        self.assertIn(
            "may flow across it",
            reason({"velocity_field": {"kind": "constant", "value": [0.0, 0.1, 0.0]}}, wide, **period),
        )
        self.assertIn(
            "not its own mirror image",
            reason({"shape": {"kind": "box", "min": [0.0, 0.0, 0.0], "max": [1.0, 0.5, 0.5]}}, wide, **period),
        )

    def test_walls_that_slip_beside_walls_that_do_not_need_a_choice(self):
        sticky = body(**{**TANK, "name": "sticky", "index": 2, "slip": "no"})
        self.assertIn("one viscosityBoundary", reason(others=[sticky]))
        self.assertEqual(reason(others=[sticky], settings={"viscosityBoundary": 0.0}), "")


class Mirrors(unittest.TestCase):
    def test_shapes_that_are_their_own_image_and_that_are_not(self):
        box = {"kind": "box", "min": [0.0, 0.0, 0.0], "max": [1.0, 2.0, 3.0]}
        for axis, middle, expected in ((0, 0.5, True), (0, 0.6, False), (1, 1.0, True)):
            self.assertEqual(mirrored(box, axis, middle, 1e-6), expected)
        rod = {"kind": "cylinder", "base": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 2.0], "length": 4.0, "radius": 1.0}
        self.assertTrue(mirrored(rod, 2, 2.0, 1e-6) and mirrored(rod, 0, 0.0, 1e-6))
        self.assertFalse(mirrored(rod, 2, 0.0, 1e-6))
        self.assertFalse(mirrored({"kind": "mesh", "file": "x.obj"}, 0, 0.0, 1e-6))


class Values(unittest.TestCase):
    def test_a_mesh_has_the_mass_the_centre_and_the_moments_that_are_asked_for(self):
        for form in (UNIT_BOX, UNIT_BALL):
            a, b, c = equal_half(form, 6.0, (1.0, 2.0, 2.5))
            moments = [6.0 * form.square * (q * q + r * r) for q, r in ((b, c), (a, c), (a, b))]
            for moment, wanted in zip(moments, (1.0, 2.0, 2.5)):
                self.assertAlmostEqual(moment, wanted, 12)
        block = body(**{**BLOCK, "mass": 6.0, "centre": [0.51, 0.3, 0.6]})
        mesh = mesh_of(block, solid_of(block))
        for axis, wanted in enumerate((0.01, 0.0, 0.0)):  # the first eight corners have the mass
            self.assertAlmostEqual(sum(corner[axis] for corner in mesh.corners[:8]) / 8.0, wanted, 12)
        self.assertAlmostEqual(max(corner[0] for corner in mesh.corners[8:]), 0.1, 12)

    def test_a_tank_is_made_of_boxes_that_leave_its_inside_free(self):
        whole, hole = ([0.0, 0.0, 0.0], [3.0, 3.0, 3.0]), ([1.0, 1.0, 1.0], [2.0, 2.0, 4.0])
        parts = [{"kind": "box", "min": low, "max": high} for low, high in (whole, hole)]
        boxes = cuboids_of({"kind": "difference", "of": parts})
        volume = sum(math.prod(b - a for a, b in zip(low, high)) for low, high in boxes)
        self.assertAlmostEqual(volume, 27.0 - 2.0, 12)

    def test_contacts_act_at_the_surface_and_at_no_seam(self):
        given = self.given(periodic=["y"], min=[0.0, 0.0, 0.0], max=[2.0, 1.0, 2.0])
        low, high = touched(given, [((0.0, 0.0, 0.0), (1.0, 1.0, 0.5)), ((1.0, 0.0, 0.0), (2.0, 1.0, 0.5))])[0]
        for value, wanted in zip((*low, *high), (0.01, -0.21, 0.01, 1.01, 1.21, 0.49)):
            self.assertAlmostEqual(value, wanted, 12)

    def given(self, **changes):
        with tempfile.TemporaryDirectory() as name:
            path = Path(name) / "job.json"
            path.write_text(json.dumps(scene(**changes)))
            return read_job(str(path))

    def test_the_step_is_bounded_by_viscosity_and_in_wcsph_by_sound(self):
        self.assertAlmostEqual(natural_limit(self.given()), 0.125 * 0.01 / 0.002)
        self.assertAlmostEqual(natural_limit(self.given(preset="WCSPH")), 0.25 * 0.1 / math.sqrt(100.0))

    def test_walls_brake_with_the_liquids_viscosity_or_not_at_all(self):
        self.assertEqual(boundary_viscosity(self.given()), 0.0)
        self.assertEqual(boundary_viscosity(self.given(tank={"slip": "no"})), 0.002)
        self.assertEqual(boundary_viscosity(self.given(settings={"viscosityBoundary": 0.5})), 0.5)

    def test_particles_are_written_as_big_endian_floats(self):
        try:
            import numpy as np
        except ImportError:
            self.skipTest("no numpy for this Python; the engine brings its own")
        with tempfile.TemporaryDirectory() as name:
            path = Path(name) / "x.bgeo"
            write_particles(path, np.array([[1.0, 2.0, 3.0]]))
            self.assertEqual(
                path.read_bytes(),
                b"BgeoV" + struct.pack(">9i", 5, 1, 0, 0, 0, 0, 0, 0, 0) + struct.pack(">4f", 1.0, 2.0, 3.0, 1.0),
            )


if __name__ == "__main__":
    unittest.main()
