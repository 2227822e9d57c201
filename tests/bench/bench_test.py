# SPDX-License-Identifier: BSD-3-Clause
"""tripoint bench: what its JSON document holds, and how it refuses.   bench_test.py TRIPOINT"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = sys.argv.pop(1)


def bench(*words):
    return subprocess.run([TRIPOINT, "bench", *words], capture_output=True, text=True, timeout=300, check=False)


class Bench(unittest.TestCase):
    def test_the_stages_of_a_step_add_up_to_it(self):
        document = json.loads(
            bench("--work", "rigid-1000", "--threads", "1", "--steps", "4", "--rounds", "2", "--json").stdout
        )
        self.assertEqual((document["format"], document["threads"]), (1, 1))
        work = document["works"][0]
        self.assertEqual((work["name"], work["particles"], work["steps"]), ("rigid-1000", 27000, 4))
        step = sum(work["stages_s"].values())
        self.assertTrue(work["step_s"]["best"] <= step <= work["step_s"]["worst"] * 1.001)
        self.assertGreater(work["stages_s"]["rates"], 0.0)
        self.assertGreater(work["bytes_per_particle"], work["planned_bytes_per_particle"])

    def test_bits_do_not_depend_on_threads(self):
        hashes = {
            json.loads(bench("--work", "rigid-1000", "--threads", n, "--steps", "2", "--rounds", "1", "--json").stdout)[
                "works"
            ][0]["state_hash"]
            for n in "123"
        }
        self.assertEqual(len(hashes), 1)

    def test_the_list_names_every_standard_work(self):
        names = [line.split()[0] for line in bench("--list").stdout.splitlines()]
        for name in ("liquid-heat-40k", "liquid-heat-200k", "elastic-40k", "figure-12-corrected", "rigid-1000"):
            self.assertIn(name, names)

    def test_particles_are_written_for_other_codes(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "start.h5"
            self.assertEqual(bench("--work", "rigid-1000", "--particles", str(file)).returncode, 0)
            self.assertGreater(file.stat().st_size, 27000 * 24)

    def test_an_unknown_work_is_bad_input_that_says_where_to_look(self):
        refused = bench("--work", "liquid")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("bench --list", refused.stderr)


if __name__ == "__main__":
    unittest.main()
