# SPDX-License-Identifier: BSD-3-Clause
"""A program that is asked for help answers before one notices: start_test.py TRIPOINT ENGINE_TRIPOINT

CPU seconds of the child, the least of a few starts: other work on the machine lengthens wall seconds, not these.
"""

import os
import subprocess
import sys
import unittest

TRIPOINT, ENGINE = sys.argv[1], sys.argv[2]
STARTS, MOST = 10, 0.050  # seconds


def least_cpu(*words):
    """CPU seconds of the cheapest of a few starts."""
    seconds = []
    for _ in range(STARTS):
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise AssertionError(f"{words}: exit {process.returncode}")
        seconds.append(used.ru_utime + used.ru_stime)
    return min(seconds)


class Start(unittest.TestCase):
    def test_help_takes_less_than_fifty_milliseconds(self):
        self.assertLess(least_cpu(TRIPOINT, "--help"), MOST)

    def test_an_engine_says_what_it_is_as_fast(self):
        self.assertLess(least_cpu(ENGINE, "--info"), MOST)

    def test_no_program_waits_for_what_only_meshes_need(self):
        for program in (TRIPOINT, ENGINE):
            needed = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
            self.assertIn("libc.so", needed)
            self.assertNotIn("openvdb", needed, program)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
