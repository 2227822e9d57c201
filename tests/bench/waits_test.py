# SPDX-License-Identifier: BSD-3-Clause
"""How threads of the engine wait: what the library of threads says that it was given.   waits_test.py
ENGINE_TRIPOINT"""

import os
import re
import subprocess
import sys
import unittest

ENGINE = sys.argv.pop(1)
WAITS = ("GOMP_SPINCOUNT", "OMP_WAIT_POLICY")


def told(**given):
    """Settings of the threads of the process that answers: the last that the library printed, since the program begins
    twice."""
    environment = (
        {name: value for name, value in os.environ.items() if name not in WAITS}
        | {"OMP_DISPLAY_ENV": "verbose"}
        | given
    )
    said = subprocess.run(
        [ENGINE, "--info"], capture_output=True, text=True, check=True, timeout=60, env=environment
    ).stderr
    return dict(re.findall(r"(GOMP_SPINCOUNT|OMP_WAIT_POLICY) = '(\w+)'", said)), said.count(
        "OPENMP DISPLAY ENVIRONMENT BEGIN"
    )


class Waits(unittest.TestCase):
    def test_threads_spin_briefly_and_then_sleep(self):
        settings, starts = told()
        self.assertEqual(settings["GOMP_SPINCOUNT"], "1000")
        self.assertEqual(starts, 2, "the settings are read before main, so that the program begins once more")

    def test_what_the_user_sets_is_left_alone(self):
        self.assertEqual(told(GOMP_SPINCOUNT="7"), ({"GOMP_SPINCOUNT": "7", "OMP_WAIT_POLICY": "PASSIVE"}, 1))
        settings, starts = told(OMP_WAIT_POLICY="passive")
        self.assertEqual((settings["OMP_WAIT_POLICY"], settings["GOMP_SPINCOUNT"], starts), ("PASSIVE", "0", 1))


if __name__ == "__main__":
    unittest.main()
