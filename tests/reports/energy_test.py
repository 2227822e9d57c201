# SPDX-License-Identifier: BSD-3-Clause
"""The energy panel: drawn of runs that state every energy that takes part, and of no other."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "reports"))
from figures import bodies
from trajectories import Trajectory

TIMES = np.linspace(0.0, 1.0, 11)
FALL = 9.81 * TIMES  # speed of a body of 1 kg that is let go


def run(label, pulled=True, **energies):
    return SimpleNamespace(label=label), Trajectory(
        times=TIMES,
        gravity=(0.0, 0.0, -9.81 if pulled else 0.0),
        observables={name: (TIMES, values) for name, values in energies.items()},
    )


def drawn(*runs):
    notes = []
    panel = bodies.energy_panel(list(runs), notes)
    return {curve.label: values for curve, _, values, _ in panel[1]} if panel else {}, notes


class EnergyPanel(unittest.TestCase):
    def test_a_fall_keeps_its_energy_where_both_terms_are_stated(self):
        lines, notes = drawn(run("tripoint", kinetic=0.5 * FALL**2, potential=-0.5 * FALL**2))
        self.assertLess(np.abs(lines["tripoint"]).max(), 1e-15)
        self.assertEqual(notes, [])

    def test_a_run_that_states_no_potential_energy_has_no_curve_and_the_page_says_why(self):
        lines, notes = drawn(
            run("tripoint", kinetic=0.5 * FALL**2, potential=-0.5 * FALL**2), run("exact", kinetic=0.5 * FALL**2)
        )
        self.assertEqual(list(lines), ["tripoint"])
        self.assertEqual(len(notes), 1)
        self.assertIn("exact", notes[0])
        self.assertIn("potential", notes[0])

    def test_where_gravity_pulls_and_nobody_states_potential_energy_nothing_is_drawn(self):
        self.assertEqual(drawn(run("exact", kinetic=0.5 * FALL**2))[0], {})

    def test_without_gravity_kinetic_energy_alone_is_a_curve(self):
        lines, notes = drawn(
            run("exact", pulled=False, kinetic=np.ones(11)), run("bullet", pulled=False, kinetic=1.0 + 0.1 * TIMES)
        )
        self.assertAlmostEqual(lines["bullet"][-1], 0.1 / 1.1)
        self.assertEqual(notes, [])

    def test_energy_that_a_bent_body_stores_counts(self):
        swing = np.cos(3.0 * TIMES) ** 2
        lines, _ = drawn(run("tripoint", pulled=False, kinetic=swing, elastic=1.0 - swing))
        self.assertLess(np.abs(lines["tripoint"]).max(), 1e-15)

    def test_terms_that_do_not_change_are_asked_of_nobody(self):
        lines, _ = drawn(
            run("tripoint", pulled=False, kinetic=np.ones(11), elastic=np.zeros(11)),
            run("bullet", pulled=False, kinetic=np.ones(11)),
        )
        self.assertEqual(sorted(lines), ["bullet", "tripoint"])


if __name__ == "__main__":
    unittest.main()
