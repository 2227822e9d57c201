# SPDX-License-Identifier: BSD-3-Clause
"""The table of threads and load is made of what the program says: busy_machine_test.py TRIPOINT SOURCE"""

import subprocess
import sys
import unittest

TRIPOINT, SOURCE = sys.argv[1], sys.argv[2]


class BusyMachine(unittest.TestCase):
    def test_every_row_has_a_time_for_every_load(self):
        words = [
            f"{SOURCE}/tools/busy_machine.py",
            f"{SOURCE}/cases/fluid/dam-break-20.toml",
            "--program",
            TRIPOINT,
            "--loads",
            "0,1",
            "--steps",
            "3",
            "--rounds",
            "1",
        ]
        done = subprocess.run(["/usr/bin/python3", *words], capture_output=True, text=True, timeout=200, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        head, _, *rows = done.stdout.splitlines()
        self.assertIn("0 busy", head)
        self.assertEqual(
            [row.split("|")[1].strip().split(",")[0] for row in rows],
            ["1 thread", "2 threads", "2 threads", "2 threads", "as shipped"],
        )
        for row in rows:
            times = [float(cell) for cell in row.split("|")[2:-1]]
            self.assertEqual(len(times), 2, row)
            self.assertTrue(all(time > 0 for time in times), row)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
