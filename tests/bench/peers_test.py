# SPDX-License-Identifier: BSD-3-Clause
"""What `make bench-peers` does beside running other codes: their input, their logs, the ratios and the page."""

import argparse
import json
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools" / "peers"), str(ROOT / "reports")]

import numpy

import bench_peers
import lammps_work
import speed

LOG = """
Loop time of 9.0 on 2 procs for 5 steps with 100 atoms
99.0% CPU use with 2 MPI tasks x 1 OpenMP threads
Neighbor list builds = 1
Loop time of 2.0 on 2 procs for 40 steps with 100 atoms
50.0% CPU use with 2 MPI tasks x 1 OpenMP threads
Neighbor list builds = 10
"""


def start(particles):
    place = numpy.array([[0.01 * n, 0.02, 0.03] for n in range(particles)])
    return {
        "position": place,
        "velocity": place * 10.0,
        "temperature": numpy.full(particles, 300.0),
        "spacing": 0.01,
        "support": 0.0225,
    }


def code(name, costs, neighbours=None, parallel=2):
    made = bench_peers.Code(name, "liquid-heat-40k", parallel, "nothing", None)
    made.rounds = [
        {"step_s": c, "cpu_s": c / 4, "particles": 100, "neighbours": neighbours, "rebuilds_per_step": 0.1}
        for c in costs
    ]
    return made


class LammpsInput(unittest.TestCase):
    def test_a_deck_holds_every_particle_in_units_of_spacing_and_sound(self):
        for method in lammps_work.BODY:
            with tempfile.TemporaryDirectory() as folder:
                deck = lammps_work.write(folder, method, start(7), 5e-4, 5, 40).read_text()
                data = (Path(folder) / f"{method}.data").read_text()
            self.assertIn("7 atoms", data)
            atoms = data[data.index("Atoms") : data.index("Velocities")].split("\n")[2:9]
            self.assertEqual([float(line.split()[-3]) for line in atoms], [float(n) for n in range(7)], method)
            self.assertAlmostEqual(float(data.strip().split("\n")[-1].split()[1]), 0.6 / lammps_work.SPEED)
            self.assertIn("timestep 0.5", deck)
            self.assertTrue(deck.endswith("run 5\nrun 40\n"))

    def test_the_second_run_of_a_log_is_what_counts(self):
        read = lammps_work.read(LOG)
        self.assertAlmostEqual(read["step_s"], 0.05)
        self.assertAlmostEqual(read["cpu_s"], 0.05)  # two tasks, half used
        self.assertAlmostEqual(read["rebuilds_per_step"], 0.25)

    def test_a_log_without_a_second_run_names_the_error(self):
        with self.assertRaisesRegex(ValueError, "Lost atoms"):
            lammps_work.read(
                "Loop time of 9.0 on 2 procs for 5 steps with 100 atoms\nERROR: Lost atoms: original 100 current 3\n"
            )


class Neighbours(unittest.TestCase):
    def test_a_cube_of_three_across_has_the_neighbours_that_counting_finds(self):
        place = numpy.array([[i, j, k] for i in range(3) for j in range(3) for k in range(3)])
        apart = ((place[:, None] - place[None]) ** 2).sum(axis=2)
        counted = ((apart > 0) & (apart < 2.1**2)).sum() / 27
        self.assertAlmostEqual(
            bench_peers.lattice_neighbours({"spacing": 0.34 / 3, "support": 2.1 * 0.34 / 3}), counted
        )


class Ratios(unittest.TestCase):
    def test_ratios_are_formed_within_a_round(self):
        ours, theirs = code("tripoint", [1.0, 2.0, 4.0], 40.0), code("other", [3.0, 6.0, 16.0], 20.0)
        row = bench_peers.row_of(theirs, ours.rounds, 40.0)
        self.assertEqual(row["ratio_particle_step"], {"median": 3.0, "least": 3.0, "greatest": 4.0})
        self.assertEqual(row["ratio_cpu"], {"median": 3.0, "least": 3.0, "greatest": 4.0})
        self.assertEqual(row["ratio_pair"], {"median": 6.0, "least": 6.0, "greatest": 8.0})

    def test_the_best_times_of_all_rounds_are_compared_too(self):
        row = bench_peers.row_of(
            code("other", [8.0, 6.0, 9.0], 20.0), code("tripoint", [4.0, 4.0, 2.0], 40.0).rounds, 40.0
        )
        self.assertEqual(row["ratio_best"], 3.0)
        self.assertEqual(row["ratio_particle_step"]["median"], 2.0)

    def test_a_code_that_never_ran_keeps_its_row_and_its_reason(self):
        failed = bench_peers.Code(
            "other", "liquid-heat-40k", 2, "all", lambda: (_ for _ in ()).throw(ValueError("no wheel"))
        )
        bench_peers.run_rounds([failed], 3, lambda line: None)
        row = bench_peers.row_of(failed, code("tripoint", [1.0], 40.0).rounds, 40.0)
        self.assertEqual((row["error"], row["ratio_particle_step"]), ("no wheel", None))
        page = speed.render(
            {
                "rows": [
                    row,
                    bench_peers.row_of(code("tripoint", [1.0], 40.0), code("tripoint", [1.0], 40.0).rounds, 40.0),
                ],
                "rounds": 3,
                "machine": {"cpu": "a <processor>", "cores": 2},
            }
        )
        self.assertIn("no wheel", page)
        self.assertIn("1.00 (1.00 to 1.00)", page)
        self.assertIn("a &lt;processor&gt;", page)


class TwoBuilds(unittest.TestCase):
    def test_a_second_build_is_timed_as_one_more_code(self):
        with tempfile.TemporaryDirectory() as folder:
            programs = {}
            for name, seconds in (("now", 2.0), ("before", 3.0)):
                row = {"step_s": {"median": seconds}, "particles": 10, "neighbours": 41.0}
                programs[name] = Path(folder) / name
                programs[name].write_text(f"#!/bin/sh\necho '{json.dumps({'works': [row]})}'\n", encoding="utf-8")
                programs[name].chmod(0o755)
            bench = bench_peers.Bench(argparse.Namespace(tripoint=str(programs["now"]), beside=str(programs["before"])))
            self.addCleanup(bench.scratch.cleanup)
            ours = [
                c for c in bench_peers.codes_of(bench, 2) if c.work == "elastic-40k" and c.name.startswith("tripoint")
            ]
            bench_peers.run_rounds(ours, 1, lambda line: None)
        self.assertEqual(
            [(c.name, c.parallel, c.rounds[0]["step_s"]) for c in ours],
            [("tripoint", 1, 2.0), ("tripoint", 2, 2.0), ("tripoint beside", 1, 3.0), ("tripoint beside", 2, 3.0)],
        )


if __name__ == "__main__":
    unittest.main()
