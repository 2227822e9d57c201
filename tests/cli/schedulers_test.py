# SPDX-License-Identifier: BSD-3-Clause
"""A suite by Snakemake, GNU parallel and Slurm, two at a time, one worker killed in the middle: schedulers_test.py
TRIPOINT SOURCE [JOBS [unittest arguments]].

The merged results are those of an undisturbed validation, times aside. All are optional: tools/setup.sh schedulers,
tools/one-node-slurm.sh start."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT, SOURCE = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
CASES = int(sys.argv[3]) if len(sys.argv) > 3 else 20  # two jobs each
FLIGHT = (SOURCE / "tests/harness/fake/flight.toml").read_text()
SNAKEMAKE = next(
    (str(p) for p in (SOURCE / ".venv-schedulers/bin/snakemake",) if p.exists()), shutil.which("snakemake")
)
PARALLEL = shutil.which("parallel")
SLURM = (
    shutil.which("sinfo") and subprocess.run(["sinfo"], capture_output=True, timeout=60, check=False).returncode == 0
)
PAID = {"cpu_s", "wall_s", "setup_cpu_s", "peak_bytes", "instructions", "counted_by", "timed"}


def bare(file):
    kept = {key: value for key, value in json.loads(file.read_text()).items() if key not in ("command", "date")}
    for case in kept["cases"]:
        for engine in case["engines"]:
            for run in engine["runs"]:
                run["cost"] = {key: value for key, value in run["cost"].items() if key not in PAID}
    return kept


class Schedulers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint schedulers ")
        cls.path = Path(cls.folder.name)
        for n in range(CASES):
            file = cls.path / "cases" / "test" / f"flight{n:03}.toml"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(FLIGHT.replace("velocity = [1.0,", f"velocity = [{1 + 0.01 * n},"))
        cls.call("validate", "cases", "--engines", "tripoint,exact", "--out", "whole", "--no-report", "--jobs", "2")
        cls.whole = bare(cls.path / "whole" / "results.json")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def call(cls, *words):
        return subprocess.run(
            [TRIPOINT, *map(str, words)], capture_output=True, text=True, timeout=600, cwd=cls.path, check=True
        ).stdout

    def suite(self, name, scheduler):
        self.call("suite", "make", name, "cases", "--engines", "tripoint,exact")
        script = self.path / f"{name}.{scheduler}"
        script.write_text(self.call("suite", "emit", name, "--for", scheduler, "--shards", "8"))
        return script

    def status(self, name):
        return json.loads(self.call("status", name, "--json"))

    def kill_one(self, name):
        """Kills the first worker that has a job while some are done and many wait; the job that it held. The worker is
        halted before, because it may have gone on to another job since the status was read."""
        end = time.monotonic() + 120
        while time.monotonic() < end:
            status = self.status(name)
            if status["done"] >= 3 and status["running_jobs"]:
                worker = status["running_jobs"][0]["worker"]
                pid = int(worker.split(".")[-3])
                try:
                    os.kill(pid, signal.SIGSTOP)
                    held = [job["id"] for job in self.status(name)["running_jobs"] if job["worker"] == worker]
                    os.kill(pid, signal.SIGKILL if held else signal.SIGCONT)
                except ProcessLookupError:
                    continue
                if held:
                    return held[0]
            time.sleep(0.02)
        self.fail(f"no worker was seen at a job: {status}")

    def check(self, name, killed, seconds, best):
        status = self.status(name)
        self.assertEqual((status["done"], status["waiting"], status["lost"]), (2 * CASES, 0, 0))
        self.assertEqual(bare(self.path / name / "results.json"), self.whole)
        notes = [file.name.split(".")[0] for file in (self.path / name / "lost").iterdir()]
        self.assertLessEqual(set(notes), {killed})
        print(f"{name}: {2 * CASES} jobs, {seconds:.1f} s with a worker killed; {best}", file=sys.stderr)

    @unittest.skipUnless(PARALLEL, "no GNU parallel: tools/setup.sh schedulers")
    def test_gnu_parallel(self):
        script = self.suite("by-parallel", "parallel")
        start = time.monotonic()
        process = subprocess.Popen(
            ["bash", str(script)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=self.path,
            env=dict(os.environ, JOBS="2"),
        )
        self.addCleanup(process.kill)
        killed = self.kill_one("by-parallel")
        text = process.communicate(timeout=600)[0]
        self.assertEqual(process.returncode, 0, text)
        self.check("by-parallel", killed, time.monotonic() - start, "the killed shard was sent again")

    @unittest.skipUnless(SNAKEMAKE, "no Snakemake: tools/setup.sh schedulers")
    def test_snakemake(self):
        script = self.suite("by-snakemake", "snakemake")
        command = [SNAKEMAKE, "--snakefile", str(script), "--cores", "2", "--nolock"]
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=self.path)
        self.addCleanup(process.kill)
        killed = self.kill_one("by-snakemake")
        text = process.communicate(timeout=600)[0]
        self.assertNotEqual(process.returncode, 0, "a killed shard is an error of the workflow")
        left = self.status("by-snakemake")
        self.assertGreater(left["waiting"] + left["lost"], 0, text)
        again = subprocess.run(command, capture_output=True, text=True, cwd=self.path, timeout=600, check=False)
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.check("by-snakemake", killed, time.monotonic() - start, "the same line once more made the rest")

    @unittest.skipUnless(SLURM, "no Slurm answers: tools/one-node-slurm.sh start")
    def test_slurm(self):
        script = self.suite("by-slurm", "slurm")
        start = time.monotonic()
        process = subprocess.Popen(
            ["sbatch", "--wait", str(script)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=self.path,
        )
        self.addCleanup(process.kill)
        killed = self.kill_one("by-slurm")
        text = process.communicate(timeout=600)[0]
        self.assertNotEqual(process.returncode, 0, "a killed task is a failed one")
        again = subprocess.run(
            ["sbatch", "--wait", str(script)], capture_output=True, text=True, cwd=self.path, timeout=600, check=False
        )
        self.assertEqual(again.returncode, 0, text + again.stdout + again.stderr)
        self.call("merge", "by-slurm")
        self.check("by-slurm", killed, time.monotonic() - start, "the same line once more made the rest")


if __name__ == "__main__":
    if not SNAKEMAKE and not PARALLEL and not SLURM:
        print(
            "neither Snakemake, GNU parallel nor Slurm is here: tools/setup.sh schedulers, tools/one-node-slurm.sh "
            "start"
        )
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
