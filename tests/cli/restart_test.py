# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are cut and continued, as people do it: restart_test.py TRIPOINT SAME_TRAJECTORY [unittest arguments]."""

import json
import os
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT, SAME = sys.argv[1:3]
ENGINE = Path(TRIPOINT).resolve().parents[1] / "libexec" / "tripoint" / "engine-tripoint"
FLIGHT = """format = 1
[case]
title = "Flight"
requirement = "R"
claims = "it flies, conducts, and breaks in two"
profiles = ["commit"]
[scene]
end_time = 0.5
gravity = [0.0, 0.0, -9.81]
spacing = 0.1
time_step = 0.002
output_interval = 0.05
[[material]]
name = "stuff"
density = 1000.0
conductivity = 5.0
heat_capacity = 500.0
[[body]]
name = "bar"
material = "stuff"
phase = "rigid"
shape = { kind = "box", min = [0.0, 0.0, 0.0], max = [0.8, 0.4, 0.3] }
velocity = [1.0, 0.0, 2.0]
angular_velocity = [0.3, 1.0, 2.0]
temperature = { kind = "step", point = [0.4, 0.0, 0.0], normal = [1.0, 0.0, 0.0], behind = 400.0, ahead = 300.0 }
[[event]]
time = 0.2
kind = "split"
name = "half"
region = { kind = "half_space", point = [0.6, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }
[[metric]]
name = "momentum"
quantity = "ledger.momentum"
norm = "max"
unit = "kg m/s"
[reference]
kind = "invariant"
"""


# An elastic block melts from below while liquid is poured on it: bonds end, rows are added.
MELTING = """format = 1
[case]
title = "an elastic block melts under a jet"
requirement = "R-T-2"
claims = "a restart continues bit for bit"
[scene]
end_time = 0.2
gravity = [0.0, 0.0, -9.81]
spacing = 0.01
output_interval = 0.04
[[material]]
name = "wax"
density = 1000.0
viscosity = 2.0
sound_speed = 20.0
young_modulus = 5e4
poisson_ratio = 0.3
conductivity = 5000.0
heat_capacity = 1000.0
t_melt = 400.0
t_solid = 390.0
latent_heat = 5e4
[[material]]
name = "stone"
density = 1000.0
sound_speed = 20.0
conductivity = 5000.0
heat_capacity = 1000.0
[[body]]
name = "ground"
material = "stone"
phase = "rigid"
motion = "fixed"
temperature = 700.0
temperature_held = true
shape = { kind = "box", min = [-0.04, -0.04, -0.02], max = [0.04, 0.04, 0.0] }
[[body]]
name = "block"
material = "wax"
phase = "elastic"
temperature = 300.0
shape = { kind = "box", min = [-0.02, -0.02, 0.0], max = [0.02, 0.02, 0.04] }
[[inflow]]
material = "wax"
shape = { kind = "box", min = [-0.01, -0.01, 0.06], max = [0.01, 0.01, 0.08] }
velocity = [0.0, 0.0, -0.5]
stop = 0.2
temperature = 500.0
[engines.tripoint]
required = true
"""


def call(*words, **more):
    return subprocess.run([TRIPOINT, *map(str, words)], capture_output=True, text=True, timeout=300, **more)


class Restart(unittest.TestCase):
    def setUp(self):
        before = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup has it ignored, and that is handed down
        self.addCleanup(signal.signal, signal.SIGHUP, before)
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint restart ü ")
        self.path = Path(self.folder.name)
        self.case = self.path / "cases" / "test" / "flight.toml"
        self.case.parent.mkdir(parents=True)
        self.case.write_text(FLIGHT)

    def tearDown(self):
        self.folder.cleanup()

    def run_case(self, out, *more):
        return call("run", self.case, "--out", self.path / out, "--quiet", *more)

    def expect_same(self, one, other):
        same = subprocess.run(
            [SAME, self.path / one / "trajectory.h5", self.path / other / "trajectory.h5"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        one, other = (json.loads((self.path / d / "result.json").read_text()) for d in (one, other))
        for key in ("state_hash", "steps", "time_reached", "counters", "time_step_bound", "readback"):
            self.assertEqual(one[key], other[key], key)

    def test_a_run_that_goes_on_is_the_unbroken_run_frame_by_frame(self):
        self.assertEqual(self.run_case("whole").returncode, 0)
        for interval in ("0.12", "3 ms"):
            shutil.rmtree(self.path / "cut", ignore_errors=True)
            self.assertEqual(self.run_case("cut", "--until", "0.4", "--checkpoint-interval", interval).returncode, 0)
            self.assertEqual(len(list((self.path / "cut").glob("checkpoint-*.h5"))), 2)
            for checkpoint in sorted((self.path / "cut").glob("checkpoint-*.h5")):
                done = self.run_case("again", "--resume", checkpoint, "--threads", 2)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.expect_same("whole", "again")
            done = call(
                "run", self.case, "--quiet", "--resume", self.path / "cut"
            )  # in the same folder, from the last one
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.expect_same("whole", "cut")

    def test_a_restart_of_a_restart_is_the_unbroken_run(self):
        self.assertEqual(self.run_case("whole").returncode, 0)
        self.assertEqual(self.run_case("one", "--until", "0.25", "--checkpoint-interval", "0.06").returncode, 0)
        self.assertEqual(
            self.run_case(
                "two",
                "--until",
                "0.4",
                "--resume",
                sorted((self.path / "one").glob("checkpoint-*.h5"))[0],
                "--checkpoint-interval",
                "0.11",
            ).returncode,
            0,
        )
        self.assertEqual(self.run_case("three", "--resume", self.path / "two").returncode, 0)
        self.expect_same("whole", "three")

    def test_bonds_phases_and_what_flowed_in_go_on_too(self):
        self.case.write_text(MELTING)
        done = self.run_case("whole")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.run_case("cut", "--until", "0.16", "--checkpoint-interval", "0.033").returncode, 0)
        for checkpoint in sorted((self.path / "cut").glob("checkpoint-*.h5")):
            done = self.run_case("again", "--resume", checkpoint, "--threads", 2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.expect_same("whole", "again")

    def test_another_scene_a_torn_checkpoint_and_lost_frames_are_refused_by_name(self):
        self.assertEqual(self.run_case("cut", "--checkpoint-interval", "0.2").returncode, 0)
        checkpoint = sorted((self.path / "cut").glob("checkpoint-*.h5"))[-1]

        def refusal(*more):
            done = self.run_case("other", "--resume", checkpoint, *more)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            return done.stdout + done.stderr

        self.assertIn("another scene", refusal("--set", "scene.gravity=[0.0, 0.0, -9.8]"))
        self.assertIn("no output time", refusal("--until", "0.3"))
        whole = checkpoint.read_bytes()
        checkpoint.write_bytes(whole[:1000] + bytes([whole[1000] ^ 4]) + whole[1001:])
        self.assertIn("torn or altered", refusal())
        checkpoint.write_bytes(whole[:-1])
        self.assertIn(checkpoint.name, refusal())
        checkpoint.write_bytes(whole)
        (self.path / "cut" / "trajectory.h5").unlink()
        self.assertIn("trajectory.h5", refusal())
        self.assertEqual(self.run_case("other", "--resume", self.path / "nowhere").returncode, 2)

    def test_a_run_that_does_not_begin_leaves_the_run_that_was_there(self):
        out = self.path / "out"
        self.assertEqual(self.run_case("out", "--checkpoint-interval", "0.2").returncode, 0)
        self.assertEqual(
            self.run_case("foreign", "--set", "scene.spacing=0.05", "--checkpoint-interval", "0.2").returncode, 0
        )
        (out / "picture.png").write_text("drawn by hand")
        own, foreign = (sorted(folder.glob("checkpoint-*.h5"))[-1] for folder in (out, self.path / "foreign"))
        torn = self.path / "torn.h5"
        torn.write_bytes(own.read_bytes()[:-1])
        silent, refuses = (self.path / f"engine-{name}" for name in ("silent", "refuses"))
        info = (
            '{"contract": 1, "name": "NAME", "version": "1", "capabilities": [], "presets": ["default"], '
            '"deterministic": true}'
        )
        for engine, check, run in (
            (silent, "exit 3", ""),
            (
                refuses,
                """echo '{"can": true, "reason": ""}'""",
                "echo '%s' >result.json; exit 4" % '{"contract": 1, "status": "refused", "message": "not today"}',
            ),
        ):
            engine.write_text(f"""#!/bin/sh
case $1 in --info) echo '{info.replace("NAME", engine.name[7:])}';; --check) {check};; --run) cd "$(dirname "$2")"; \
echo x >gauges.csv; {run};; esac
""")
            engine.chmod(0o755)

        def files():
            return {
                file.relative_to(out).as_posix(): file.read_bytes()
                for file in out.rglob("*")
                if file.name != ".lock" and file.is_file()
            }

        before = files()
        self.assertTrue(
            {"job.json", "particles.h5", "result.json", "trajectory.h5", own.name} <= before.keys(), before.keys()
        )
        for words, code in (
            (("--resume", torn), 2),
            (("--resume", foreign), 2),
            (("--resume", own, "--until", "0.3"), 2),
            (("--resume", own, "--set", "scene.gravity=[0.0, 0.0, -9.8]"), 2),
            (("--resume", self.path / "nowhere"), 2),
            (("--engine", silent), 4),
            (("--engine", refuses), 4),
            (("--set", "scene.spacing=-1"), 2),
            (("--engine", "no-such"), 4),
        ):
            done = self.run_case("out", *words)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertEqual(files(), before, words)
        # A call that was killed before its run had begun: the next one finds the files aside.
        aside = out / ".earlier-run"
        aside.mkdir()
        for name in before.keys() - {"picture.png"}:
            (out / name).rename(aside / name)
        (out / "job.json").write_text("begun")
        self.assertEqual(self.run_case("out", "--resume", torn).returncode, 2)
        self.assertEqual(files(), before)
        self.assertEqual(self.run_case("out", "--until", "0.4").returncode, 0)  # one that begins replaces all
        self.assertFalse(aside.exists() or own.exists())
        self.assertNotEqual((out / "trajectory.h5").read_bytes(), before["trajectory.h5"])

    def test_ctrl_c_leaves_a_checkpoint_and_says_how_to_go_on(self):
        slow = ["--set", "scene.time_step=5e-6", "--until", "0.25"]
        self.assertEqual(self.run_case("whole", *slow).returncode, 0)
        process = subprocess.Popen(
            [TRIPOINT, "run", self.case, "--out", self.path / "cut", *slow],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        while not (self.path / "cut" / "trajectory.h5").exists():
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("--resume", said)
        self.assertEqual(json.loads((self.path / "cut" / "result.json").read_text())["status"], "error")
        command = said[said.index("go on with: tripoint ") + len("go on with: tripoint ") :].splitlines()[0]
        done = subprocess.run(["/bin/sh", "-c", f"'{TRIPOINT}' {command}"], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.expect_same("whole", "cut")

    SLOW = ("--set", "scene.time_step=5e-6", "--until", "0.25")

    def wait_for_its_first_frame(self, folder):
        end = time.monotonic() + 60
        while not (folder / "trajectory.h5").exists():
            self.assertLess(time.monotonic(), end, "it never began")
            time.sleep(0.01)
        time.sleep(0.1)

    def expect_left_a_checkpoint(self, folder):
        result = json.loads((folder / "result.json").read_text())
        self.assertEqual(result["status"], "error")
        self.assertRegex(result["message"], r"^interrupted at t = .*; continue with --resume ")
        self.assertEqual(len(list(folder.glob("checkpoint-*.h5"))), 1)

    def leave_a_job(self, out, *more):
        """A folder with the job of a slow run, of which nothing is done."""
        folder = self.path / out
        process = subprocess.Popen(
            [TRIPOINT, "run", self.case, "--out", folder, "--quiet", *self.SLOW, *more],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.wait_for_its_first_frame(folder)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)
        for left in (folder / "trajectory.h5", *folder.glob("checkpoint-*.h5")):
            left.unlink()
        return folder

    def start_engine(self, folder, **more):
        return subprocess.Popen(
            [ENGINE, "--run", folder / "job.json"],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **more,
        )

    def test_a_hangup_leaves_a_checkpoint_as_ctrl_c_does(self):
        self.assertEqual(self.run_case("whole", *self.SLOW).returncode, 0)
        engine = self.start_engine(self.leave_a_job("cut"))
        self.wait_for_its_first_frame(self.path / "cut")
        for _ in range(2):  # the system tells it, and the shell
            engine.send_signal(signal.SIGHUP)
            time.sleep(0.01)
        _, said = engine.communicate(timeout=60)
        self.assertEqual(engine.returncode, 130, said)
        self.assertIn("interrupted at t = ", said)
        self.expect_left_a_checkpoint(self.path / "cut")
        done = self.run_case("cut", *self.SLOW, "--resume", self.path / "cut")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.expect_same("whole", "cut")

    def test_a_hangup_that_was_to_be_ignored_is_ignored(self):
        folder = self.leave_a_job("cut", "--set", "scene.time_step=1e-5")
        engine = self.start_engine(folder, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_for_its_first_frame(folder)
        self.assertIsNone(engine.poll(), "it has ended before anything could come")
        engine.send_signal(signal.SIGHUP)
        _, said = engine.communicate(timeout=60)
        self.assertEqual(engine.returncode, 0, said)
        self.assertEqual(json.loads((folder / "result.json").read_text())["status"], "ok")

    def close_the_terminal_of(self, words, folder):
        """Runs a command on a terminal of its own, which closes under it; its exit code."""
        child, terminal = pty.fork()
        if child == 0:
            os.execv(words[0], [str(word) for word in words])
        try:
            self.wait_for_its_first_frame(folder)
        finally:
            os.close(terminal)
            os.kill(child, signal.SIGHUP)  # as its shell does, besides the system
        end = time.monotonic() + 60
        while True:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status)
            if time.monotonic() > end:
                os.kill(child, signal.SIGKILL)
            time.sleep(0.01)

    def test_a_run_whose_terminal_closes_leaves_a_checkpoint(self):
        code = self.close_the_terminal_of(
            [TRIPOINT, "run", self.case, "--out", self.path / "cut", *self.SLOW], self.path / "cut"
        )
        self.assertEqual(code, 130)
        self.expect_left_a_checkpoint(self.path / "cut")
        self.assertEqual(self.run_case("cut", *self.SLOW, "--resume", self.path / "cut").returncode, 0)

    def test_an_engine_whose_terminal_closes_leaves_a_checkpoint(self):
        folder = self.leave_a_job("cut")
        self.assertEqual(self.close_the_terminal_of([ENGINE, "--run", folder / "job.json"], folder), 130)
        self.expect_left_a_checkpoint(folder)

    def test_validate_resume_keeps_what_has_ended_and_makes_the_rest(self):
        def validate(*more):
            done = call("validate", self.path / "cases", "--engines", "tripoint", "--out", self.path / "out", *more)
            result = self.path / "out" / "runs" / "test" / "flight" / "tripoint" / "corrected" / "result.json"
            return done, result.stat().st_mtime_ns

        first, made = validate()
        again, kept = validate("--resume")
        self.assertEqual((first.returncode, made), (again.returncode, kept))
        self.assertIn("kept, ok", again.stderr)
        runs = self.results()["cases"][0]["engines"][0]["runs"]
        self.assertGreater(runs[0]["cost"]["cpu_s"], 0.0)
        self.case.write_text(FLIGHT.replace("-9.81", "-9.80"))
        other, remade = validate("--resume")
        self.assertNotIn("kept", other.stderr)
        self.assertNotEqual(remade, made)
        result = self.path / "out" / "runs" / "test" / "flight" / "tripoint" / "corrected" / "result.json"
        result.write_text(result.read_text().replace('"ok"', '"ok" '))
        altered, _ = validate("--resume")
        self.assertNotIn("kept", altered.stderr)
        forced, _ = validate()
        self.assertNotIn("kept", forced.stderr)

    def results(self):
        return json.loads((self.path / "out" / "results.json").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
