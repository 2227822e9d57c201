# SPDX-License-Identifier: BSD-3-Clause
"""What `tripoint run` says while a run goes on: progress_test.py TRIPOINT [unittest arguments]."""

import json
import os
import pty
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = Path(sys.argv[1]).resolve()
RUN = ["paper/fig-08-rigid", "--until", "3"]  # a few seconds


class Progress(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint-progress-")
        self.addCleanup(self.folder.cleanup)
        self.out = Path(self.folder.name) / "run"

    def call(self, *words):
        done = subprocess.run(
            [TRIPOINT, "run", *RUN, "--out", self.out, *words], capture_output=True, text=True, timeout=300, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_json_lines_tell_time_step_bound_ledger_and_what_is_left(self):
        done = self.call("--progress", "json", "--json")
        result = json.loads(done.stdout)  # one document and nothing else
        lines = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
        self.assertGreaterEqual(len(lines), 2)
        times = [line["time"] for line in lines]
        self.assertEqual(times, sorted(times))
        self.assertTrue(all(0.0 <= line["done"] <= 1.0 and line["end"] == 3.0 for line in lines))
        self.assertTrue(all(abs(line["done"] - line["time"] / 3.0) < 1e-12 for line in lines))
        last = lines[-1]
        self.assertTrue(0 < last["step"] <= result["steps"])
        self.assertTrue(0.0 < last["time_step"] < 3.0 / last["step"] * 10)
        self.assertEqual(last["bound"], result["time_step_bound"])
        self.assertLess(abs(last["ledger_residual"]), 1e-3 * last["ledger_exchanged"])
        left = [line["seconds_left"] for line in lines if line["seconds_left"] is not None]
        self.assertTrue(left and all(0.0 <= seconds < 600 for seconds in left))
        self.assertNotIn("seconds_left", (self.out / "log.txt").read_text())

    def test_lines_are_for_people(self):
        said = self.call("--progress", "lines").stderr
        self.assertRegex(said, r"(?m)^ *\d+ %  t = \S+ s  step \d+  dt = \S+ s \(\w[\w ]*\)")

    def test_quiet_says_nothing(self):
        done = self.call("--quiet")
        self.assertEqual(done.stderr, "")
        self.assertNotIn("status {", (self.out / "log.txt").read_text())  # nor is it asked for

    def test_without_a_terminal_there_is_no_line_that_is_written_over(self):
        self.assertNotIn("\r", self.call().stderr)

    def test_a_terminal_has_one_line_that_is_cleared(self):
        leader, follower = pty.openpty()
        run = subprocess.Popen(
            [TRIPOINT, "run", *RUN, "--out", self.out], stdout=subprocess.PIPE, stderr=follower, text=True
        )
        os.close(follower)
        said = b""
        while True:
            try:
                piece = os.read(leader, 65536)
            except OSError:
                break
            if not piece:
                break
            said += piece
        run.communicate(timeout=60)
        os.close(leader)
        self.assertEqual(run.returncode, 0)
        shown = said.decode().split("\r\x1b[K")
        self.assertTrue(any(re.search(r"dt = .* s left$", part) for part in shown), shown)
        self.assertEqual(shown[-1].strip(), "")

    def test_a_wrong_word_is_refused(self):
        done = subprocess.run(
            [TRIPOINT, "run", *RUN, "--progress", "yaml"], capture_output=True, text=True, timeout=60, check=False
        )
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
