# SPDX-License-Identifier: BSD-3-Clause
"""tripoint is killed by SIGKILL while an engine runs: nothing of what it started is alive afterwards.   killed_test.py
TRIPOINT

We take in every orphan (as a child subreaper), so that "nothing" means no process at all, marked or not."""

import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT = sys.argv[1]
PR_SET_CHILD_SUBREAPER = 36
PATIENCE = 15.0  # [s]; it takes a fifth of a second on a quiet machine

# An engine that hangs, with a child in a session of its own that ignores what it can ignore.
HANGS = """
import subprocess, sys, time
if sys.argv[1] == "--run":
    subprocess.Popen(["/bin/sh", "-c", "trap '' TERM HUP INT; sleep 300; sleep 300"], start_new_session=True)
    open("hangs", "w").close()
    time.sleep(300)
"""


def processes():
    """@return {pid: (parent, name)} of all that live"""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            name, rest = (folder / "stat").read_text().split("(", 1)[1].rsplit(")", 1)
        except OSError:
            continue
        state, parent = rest.split()[:2]
        if state not in "ZX":
            found[int(folder.name)] = (int(parent), name)
    return found


def below(pid):
    """@return {pid: name} of all that descend from this process"""
    every, found = processes(), {}
    grown = {pid}
    while grown:
        grown = {child for child, (parent, _) in every.items() if parent in grown and child not in found}
        found.update({child: every[child][1] for child in grown})
    return found


def reap():
    """Waits for those that came to us. @return whether any child is left"""
    while True:
        try:
            if os.waitpid(-1, os.WNOHANG)[0] == 0:
                return True
        except ChildProcessError:
            return False


def all_end():
    """Whether everything that came to us ends in time."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if not reap():
            return True
        time.sleep(0.02)
    return False


class Killed(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = Path(self.place.name).resolve()
        subprocess.run(
            [TRIPOINT, "engine", "new", "mine", "--lang", "python"], cwd=self.folder, check=True, capture_output=True
        )
        self.engine = next((self.folder / "mine").glob("engine-*"))

    def make_it_hang(self):
        lines = self.engine.read_text().split("\n")
        at = next(n for n, line in enumerate(lines) if line.startswith("import "))
        self.engine.write_text("\n".join(lines[:at] + HANGS.split("\n") + lines[at:]))

    def start(self, n, engines="mine", before=()):
        words = [
            "validate",
            "rigid/ballistic",
            "--engine",
            self.engine,
            "--engines",
            engines,
            "--out",
            self.folder / f"out{n}",
            "--no-report",
            "--no-history",
        ]
        return subprocess.Popen(
            [*before, TRIPOINT, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )

    def wait_until_it_hangs(self, n):
        end = time.monotonic() + 60.0
        while not list((self.folder / f"out{n}").rglob("hangs")):
            self.assertLess(time.monotonic(), end, "the engine was never started")
            time.sleep(0.01)

    def kill(self, harness):
        os.kill(harness.pid, signal.SIGKILL)
        os.waitpid(harness.pid, 0)
        harness.returncode = -signal.SIGKILL

    def test_nothing_is_alive_after_a_kill_at_any_moment(self):
        self.make_it_hang()
        before = time.monotonic()
        first = self.start("first")
        self.wait_until_it_hangs("first")
        whole = time.monotonic() - before
        while (
            len(below(first.pid)) < 4
        ):  # engine, shell, sleep, and who watches; the shell says that it hangs before it starts its sleep
            self.assertLess(time.monotonic() - before, 60.0, below(first.pid))
            time.sleep(0.01)
        self.kill(first)
        self.assertTrue(all_end(), below(os.getpid()))
        for n in range(14):
            harness = self.start(n)
            time.sleep(whole * (n + 1) / 10.0)  # while it reads, asks, samples, starts the engine, waits for it
            self.kill(harness)
            self.assertTrue(all_end(), f"kill {n}: {below(os.getpid())}")

    def test_it_is_the_watcher_who_ends_them(self):
        self.make_it_hang()
        harness = self.start(0)
        self.wait_until_it_hangs(0)
        started = below(harness.pid)
        watchers = [pid for pid, name in started.items() if name == "tripoint-watch"]
        self.assertEqual(len(watchers), 1, started)
        os.kill(watchers[0], signal.SIGKILL)
        self.kill(harness)
        time.sleep(1.0)
        reap()
        left = below(os.getpid())
        self.assertIn("sleep", left.values(), "the other test could not have failed")
        for pid in left:
            os.kill(pid, signal.SIGKILL)
        self.assertTrue(all_end())

    def test_a_kill_of_the_whole_group_spares_the_watcher(self):
        self.make_it_hang()
        harness = self.start(0, before=["setsid"])
        self.wait_until_it_hangs(0)
        os.killpg(harness.pid, signal.SIGKILL)
        os.waitpid(harness.pid, 0)
        harness.returncode = -signal.SIGKILL
        self.assertTrue(all_end(), below(os.getpid()))

    def test_an_ordinary_end_leaves_nobody(self):
        harness = self.start(0, "exact")
        harness.wait(timeout=120)
        self.assertFalse(reap(), below(os.getpid()))  # at once, the watcher too


if __name__ == "__main__":
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    unittest.main(argv=sys.argv[:1])
