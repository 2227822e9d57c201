# SPDX-License-Identifier: BSD-3-Clause
"""The program as people and CI call it: cli_test.py TRIPOINT FAKE_ENGINE [unittest arguments]."""

import copy
import hashlib
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

TRIPOINT, FAKE = sys.argv[1], sys.argv[2]
VERBS = (
    "run validate merge suite status compare report render view converge recommend plan ablate gate check "
    "explain list new schema engines engine"
).split()
FLIGHT = (
    Path(FAKE)
    .with_name("flight.toml")
    .read_text()
    .replace("[reference]", "[engines.fake]\nrequired = true\n[reference]")
    .replace("limit = 1e-10", 'engine = "fake"\nlimit = 1e-10')
)


def call(*words, **more):
    return subprocess.run([TRIPOINT, *map(str, words)], capture_output=True, text=True, timeout=120, **more)


class Cli(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint cli ü ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def write_cases(self, *names):
        for name in names:
            file = self.path / "cases" / "test" / f"{name}.toml"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(FLIGHT)

    def fake(self, fault="nothing"):
        script = self.path / "engine-fake"
        script.write_text(f"#!/bin/sh\nFAKE='{fault}' exec /usr/bin/python3 '{FAKE}' \"$@\"\n")
        script.chmod(0o755)
        return script

    def validate(self, fault="nothing", *more):
        return call(
            "validate",
            self.path / "cases",
            "--engines",
            "fake",
            "--engine",
            self.fake(fault),
            "--out",
            self.path / "out",
            *more,
        )

    def results(self):
        return json.loads((self.path / "out" / "results.json").read_text())

    def test_frames_say_the_sums_of_their_particles(self):
        for engine in ("tripoint", "exact", "bullet"):
            with self.subTest(engine):
                done = call("run", "rigid/ballistic", "--engine", engine, "--out", self.path / engine, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                with h5py.File(self.path / engine / "trajectory.h5") as file:
                    mass, place, velocity = (
                        file[f"particles/all/{name}/value"][()] for name in ("mass", "position", "velocity")
                    )
                    mass = np.broadcast_to(mass, place.shape[:2])[..., None]
                    for name, sums in (
                        ("mass", mass.sum((1, 2))),
                        ("momentum", (mass * velocity).sum(1)),
                        ("angular_momentum", np.cross(place, mass * velocity).sum(1)),
                    ):
                        stated = file[f"observables/{name}/value"][()]
                        self.assertGreater(np.abs(sums).max(), 0.0, name)
                        np.testing.assert_allclose(stated, sums, rtol=0, atol=1e-9 * np.abs(sums).max(), err_msg=name)

    def test_every_help_teaches_with_an_example(self):
        for verb in VERBS:
            done = call(verb, "--help")
            self.assertEqual(done.returncode, 0, verb)
            self.assertGreater(len(done.stdout), 80, verb)
            self.assertIn(f"tripoint {verb}", done.stdout)

    def test_help_costs_less_than_fifty_milliseconds_of_cpu(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        for _ in range(5):
            call("--help")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess((after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) / 5, 0.05)

    def test_what_is_no_command_option_file_or_tag_ends_2(self):
        self.write_cases("flight")
        for words in (
            ["no-such-verb"],
            [],
            ["validate", "--no-such-option"],
            ["validate", "no/such-case"],
            ["validate", self.path / "cases", "--tag", "no-such-tag"],
            ["validate", "--profile", "daily"],
            ["gate"],
            ["gate", "absent.json"],
            ["validate", "--shard", "3/2"],
            ["compare", self.path / "cases/test/flight.toml", "--engines", "one"],
        ):
            self.assertEqual(call(*words).returncode, 2, words)

    def test_output_that_cannot_be_written_is_no_success(self):
        with open("/dev/full", "w") as full:
            end = subprocess.run([TRIPOINT, "list"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(end.returncode, 2)
        self.assertIn("could not be written", end.stderr)
        end = subprocess.run(f"exec {TRIPOINT} list >&-", shell=True, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(end.returncode, 2)

    def test_a_case_that_is_wrong_ends_2_and_names_file_and_line_before_anything_runs(self):
        self.write_cases("flight", "wrong")
        wrong = self.path / "cases/test/wrong.toml"
        wrong.write_text(FLIGHT.replace("end_time", "end_tme"))
        done = self.validate()
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"wrong\.toml:\d+")
        self.assertFalse((self.path / "out").exists())

    def test_a_green_suite_leaves_its_files_and_ends_with_its_verdict(self):
        self.write_cases("flight")
        done = self.validate()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], f"verdict PASS exit 0  {self.path}/out/index.html")
        for name in (
            "results.json",
            "junit.xml",
            "summary.md",
            "index.html",
            "runs/test/flight/fake/base/trajectory.csv",
        ):
            self.assertTrue((self.path / "out" / name).exists(), name)

    def test_with_json_stdout_is_one_document(self):
        self.write_cases("flight")
        self.assertEqual(json.loads(self.validate("nothing", "--json").stdout)["verdict"], "PASS")
        self.assertIn("engines", json.loads(call("engines", "--json").stdout))
        self.assertIn("cases", json.loads(call("list", "--json").stdout))

    def test_each_fault_of_an_engine_has_the_exit_code_of_the_contract(self):
        self.write_cases("flight")
        for fault, code in {
            "one per cent of gravity": 1,
            "leaves no result": 4,
            "is killed": 4,
            "ends with an error": 4,
            "refuses": 4,
            "not there": 4,
            "diverges": 7,
            "holds another gravity": 4,
            "stops early": 4,
            "not a number": 4,
        }.items():
            with self.subTest(fault):
                self.assertEqual(self.validate(fault).returncode, code)
                self.assertEqual(self.results()["exit_code"], code)

    def test_a_call_that_ends_early_leaves_no_results_to_be_judged(self):
        self.write_cases("flight")
        self.validate()
        results = self.path / "out" / "results.json"
        self.assertEqual(self.validate("nothing", "--tag", "no-such-tag").returncode, 2)
        self.assertTrue(results.exists(), "a mistyped tag asks for no run: the last report stays")
        (self.path / "cases" / "test" / "broken.toml").write_text("no case")
        self.assertEqual(self.validate("nothing").returncode, 2)
        self.assertFalse(results.exists())
        self.assertTrue(results.with_name("results.previous.json").exists())

    def test_results_that_were_spoilt_do_not_pass_the_gate(self):
        self.write_cases("flight")
        self.validate()
        good = self.results()
        engine = next(e for e in good["cases"][0]["engines"] if e["gates"])

        def spoilt(change):
            bad = copy.deepcopy(good)
            change(bad, next(e for e in bad["cases"][0]["engines"] if e["name"] == engine["name"]))
            file = self.path / "bad.json"
            file.write_text(json.dumps(bad))
            return call("gate", file).returncode

        self.assertEqual(spoilt(lambda bad, e: None), 0)
        metric = lambda e: e["runs"][0]["metrics"]["position"]
        for name, change, code in (
            ("an error that its series does not show", lambda b, e: metric(e).update(value=1e6), 4),
            ("null", lambda b, e: metric(e).update(value=None, finite=False), 1),
            ("a metric removed", lambda b, e: e["runs"][0]["metrics"].clear(), 4),
            ("runs removed", lambda b, e: e.update(runs=[]), 4),
            ("cases removed", lambda b, e: b.update(cases=[]), 4),
            ("diverged", lambda b, e: e["runs"][0].update(status="diverged"), 7),
            ("the engine removed", lambda b, e: b["cases"][0].update(engines=[]), 4),
            ("gates removed", lambda b, e: b["cases"][0].update(gates=[]), 4),
        ):
            with self.subTest(name):
                self.assertEqual(spoilt(change), code)

    def test_shards_merge_into_the_verdict_and_numbers_of_the_whole(self):
        self.write_cases(*"abcdefg")  # seven over four: shards of two and of one
        engine = self.fake()
        common = ["validate", self.path / "cases", "--engines", "fake", "--engine", engine]
        for k in (1, 2, 3, 4):
            self.assertEqual(call(*common, "--shard", f"{k}/4", "--out", self.path / f"s{k}").returncode, 0)
        merged = call("merge", *(self.path / f"s{k}" for k in (2, 4, 1, 3)), "--out", self.path / "merged")
        self.assertEqual(merged.returncode, 0)
        whole = call(*common, "--out", self.path / "whole")
        self.assertEqual(
            merged.stdout.splitlines()[:-1], whole.stdout.splitlines()[:-1]
        )  # the last line names the folder
        merged, whole = (json.loads((self.path / d / "results.json").read_text()) for d in ("merged", "whole"))

        def numbers(results):
            return [
                (c["id"], e["name"], r["metrics"], g["verdict"])
                for c in results["cases"]
                for e in c["engines"]
                for r in e["runs"]
                for g in e["gates"]
            ]

        self.assertEqual(numbers(merged), numbers(whole))
        self.assertEqual(len(whole["cases"]), 7)
        self.assertEqual(call("merge", self.path / "s1", "--out", self.path / "part").returncode, 2)

    def test_ctrl_c_ends_130_kills_the_engines_and_leaves_what_was_done(self):
        self.write_cases("a", "b")
        script = self.path / "engine-fake"  # hangs on case b only
        script.write_text(
            f'#!/bin/sh\ncase "$2" in */b/*) FAKE=hangs; export FAKE;; esac\nexec /usr/bin/python3 \'{FAKE}\' "$@"\n'
        )
        script.chmod(0o755)
        process = subprocess.Popen(
            [
                TRIPOINT,
                "validate",
                self.path / "cases",
                "--engines",
                "fake",
                "--engine",
                script,
                "--out",
                self.path / "out",
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.assertIn("test/a", process.stdout.readline())
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual([c["id"] for c in self.results()["cases"]], ["test/a"])
        self.assertNotEqual(self.results()["exit_code"], 0)
        running = [
            p
            for p in Path("/proc").iterdir()
            if p.name.isdigit() and str(self.path).encode() in read_or_empty(p / "cmdline")
        ]
        self.assertEqual(running, [])

    def gated_fake(self):
        """An engine that says that it runs, and goes on once the file `go` is there."""
        script, runs, go = self.path / "engine-fake", self.path / "runs", self.path / "go"
        script.write_text(
            f"#!/bin/sh\nif [ \"$1\" = --run ]; then touch '{runs}'; while [ ! -e '{go}' ]; do sleep 0.05; done; "
            f"fi\nexec /usr/bin/python3 '{FAKE}' \"$@\"\n"
        )
        script.chmod(0o755)
        return script

    def start_and_wait_for_its_engine(self, *words):
        runs = self.path / "runs"
        runs.unlink(missing_ok=True)
        process = subprocess.Popen(
            [TRIPOINT, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.addCleanup(process.kill)
        end = time.monotonic() + 60
        while not runs.exists():
            self.assertLess(time.monotonic(), end, "the engine was never started")
            time.sleep(0.01)
        return process

    def test_a_second_call_in_the_folder_of_a_call_ends_2_names_its_process_and_harms_nothing(self):
        self.write_cases("flight")
        case, engine, out = self.path / "cases/test/flight.toml", self.gated_fake(), self.path / "out"
        validate = [
            "validate",
            self.path / "cases",
            "--engines",
            "fake",
            "--engine",
            engine,
            "--out",
            out,
            "--no-report",
        ]
        first = self.start_and_wait_for_its_engine(*validate)
        before = hashes(out)
        for words in (
            validate,
            [*validate, "--resume"],
            ["validate", case, "--last-failed", "--out", out],
            ["run", case, "--engine", "exact", "--out", out],
            ["compare", case, "--engines", "exact,tripoint", "--out", out],
            ["converge", case, "--axis", "time_step", "--levels", "0.02,0.01", "--engine", "tripoint", "--out", out],
        ):
            with self.subTest(words[0]):
                second = call(*words)
                self.assertEqual(second.returncode, 2, second.stdout + second.stderr)
                self.assertIn(f"process {first.pid} writes into this folder", second.stderr)
                self.assertIn("name another folder with --out", second.stderr)
        self.assertEqual(hashes(out), before)
        (self.path / "go").touch()
        told, said = first.communicate(timeout=60)
        self.assertEqual(first.returncode, 0, told + said)
        self.assertEqual([c["id"] for c in self.results()["cases"]], ["test/flight"])
        again = call(*validate, "--resume")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("kept, ok", again.stderr)

    def test_merges_keep_out_of_the_folder_of_a_call(self):
        self.write_cases("a", "b")
        engine, out = self.gated_fake(), self.path / "out"
        shards = [self.path / "s1", self.path / "s2"]
        (self.path / "go").touch()
        for k, shard in enumerate(shards, 1):
            self.assertEqual(
                call(
                    "validate",
                    self.path / "cases",
                    "--engines",
                    "fake",
                    "--engine",
                    engine,
                    "--shard",
                    f"{k}/2",
                    "--out",
                    shard,
                    "--no-report",
                ).returncode,
                0,
            )
        self.assertEqual(
            call(
                "suite", "make", self.path / "suite", self.path / "cases", "--engines", "fake", "--engine", engine
            ).returncode,
            0,
        )
        self.assertEqual(call("suite", "work", self.path / "suite").returncode, 0)
        (self.path / "go").unlink()
        first = self.start_and_wait_for_its_engine(
            "validate", self.path / "cases", "--engines", "fake", "--engine", engine, "--out", out, "--no-report"
        )
        for words in (["merge", *shards, "--out", out], ["merge", self.path / "suite", "--out", out]):
            second = call(*words)
            self.assertEqual(second.returncode, 2, second.stdout + second.stderr)
            self.assertIn(f"process {first.pid} writes into this folder", second.stderr)
        first.kill()
        first.communicate(timeout=60)
        (self.path / "go").touch()
        for words in (["merge", *shards, "--out", out], ["merge", self.path / "suite", "--out", out]):
            second = call(*words)
            self.assertEqual(
                second.returncode, 0, "a call that was killed holds nothing: " + second.stdout + second.stderr
            )

    def test_shards_run_at_once_into_folders_of_their_own(self):
        self.write_cases("a", "b")
        common = [
            TRIPOINT,
            "validate",
            self.path / "cases",
            "--engines",
            "fake",
            "--engine",
            self.fake(),
            "--no-report",
        ]
        shards = [
            subprocess.Popen(
                [*common, "--shard", f"{k}/2", "--out", self.path / f"s{k}"],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
            )
            for k in (1, 2)
        ]
        for shard in shards:
            said = shard.communicate(timeout=60)
            self.assertEqual(shard.returncode, 0, said)

    def test_a_merge_takes_nothing_that_a_shard_links_to(self):
        self.write_cases("a", "b")
        shards = [self.path / "s1", self.path / "s2"]
        for k, shard in enumerate(shards, 1):
            self.assertEqual(
                call(
                    "validate",
                    self.path / "cases",
                    "--engines",
                    "fake",
                    "--engine",
                    self.fake(),
                    "--shard",
                    f"{k}/2",
                    "--out",
                    shard,
                    "--no-report",
                ).returncode,
                0,
            )
        secret = self.path / "secret.txt"
        secret.write_text("precious")
        leak = shards[0] / "runs" / "leak"
        for put in (lambda: leak.symlink_to(secret), lambda: leak.symlink_to(self.path), lambda: os.mkfifo(leak)):
            put()
            refused = call("merge", *shards, "--out", self.path / "merged")
            self.assertEqual(refused.returncode, 2, refused.stdout + refused.stderr)
            self.assertIn(str(leak), refused.stderr)
            self.assertFalse((self.path / "merged").exists())
            leak.unlink()
        self.assertEqual(call("merge", *shards, "--out", self.path / "merged").returncode, 0)

    def test_the_engine_of_each_template_passes_the_compliance_test(self):
        done = call("engine", "new", "my-engine", "--lang", "python", cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stderr)
        engine = self.path / "my-engine" / "engine-my-engine"
        done = call("engine", "check", engine)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(call("engine", "new", "my-engine", cwd=self.path).returncode, 2)
        self.assertEqual(call("engine", "new", "../x", cwd=self.path).returncode, 2)

    def test_an_engine_that_is_known_is_checked_by_its_name(self):
        self.assertEqual(call("engine", "check", "exact").returncode, 0)
        done = call("engine", "check", "nobody")
        self.assertEqual(done.returncode, 2)
        self.assertIn("tripoint engines", done.stderr)

    def test_engines_that_break_the_contract_fail_the_compliance_test(self):
        for fault in (
            "broken info",
            "leaves no result",
            "stops early",
            "millimetres",
            "not a number",
            "holds another mass",
            "frozen",
            "says ok and exits 3",
            "torn result",
        ):
            with self.subTest(fault):
                self.assertEqual(call("engine", "check", self.fake(fault)).returncode, 1)
        self.assertEqual(call("engine", "check", self.fake()).returncode, 0)


def hashes(folder):
    return {
        str(file): hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(folder.rglob("*")) if file.is_file()
    }


def read_or_empty(path):
    try:
        return path.read_bytes()
    except OSError:
        return b""


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
