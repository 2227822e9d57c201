# SPDX-License-Identifier: BSD-3-Clause
"""A suite as a folder of jobs: suite_test.py TRIPOINT FAKE_ENGINE [unittest arguments].

What is compared with an undisturbed `tripoint validate` is the whole results.json but times, memory, dates and the
command line."""

import contextlib
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

import yaml

TRIPOINT, FAKE = str(Path(sys.argv[1]).resolve()), str(Path(sys.argv[2]).resolve())
FLIGHT = Path(FAKE).with_name("flight.toml").read_text()
STUDY = (
    FLIGHT + '[[study]]\naxis = "time_step"\nlevels = [0.02, 0.01, 0.005]\nseeds = 2\njitter = 0.1\nengine = '
    '"tripoint"\nexpect = "roundoff"\n'
)
PAID = {"cpu_s", "wall_s", "setup_cpu_s", "peak_bytes", "instructions", "counted_by", "timed"}


def bare(results):
    """All that does not depend on the clock."""
    kept = {key: value for key, value in results.items() if key not in ("command", "date")}
    for case in kept["cases"]:
        for engine in case["engines"]:
            for run in engine["runs"]:
                run["cost"] = {key: value for key, value in run["cost"].items() if key not in PAID}
    return kept


def wait_for(what, seconds=60.0):
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise AssertionError("it did not come to be in time")
        time.sleep(0.02)


class Suite(unittest.TestCase):
    maxDiff = 4000

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint suite ü ")
        self.path = Path(self.folder.name)
        self.suite = self.path / "suite"
        self.started = []

    def tearDown(self):
        for process in self.started:
            if process.poll() is None:
                process.kill()
            process.wait()
            process.stdout.close()
        hold = self.path / "hold" / "pid"
        if hold.exists():
            try:
                os.kill(int(hold.read_text()), signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.folder.cleanup()

    def call(self, *words, **more):
        return subprocess.run(
            [TRIPOINT, *map(str, words)], capture_output=True, text=True, timeout=300, cwd=self.path, **more
        )

    def done(self, *words):
        end = self.call(*words)
        self.assertEqual(end.returncode, 0, f"{words}\n{end.stdout}{end.stderr}")
        return end

    def start(self, *words):
        process = subprocess.Popen(
            [TRIPOINT, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=self.path
        )
        self.started.append(process)
        return process

    def cases(self, count=3, study=True):
        folder = self.path / "cases" / "test"
        folder.mkdir(parents=True, exist_ok=True)
        for n in range(count):
            (folder / f"flight{n}.toml").write_text(STUDY if study and n == 0 else FLIGHT)

    def engine(self, name="fake", fault="nothing"):
        """The fake engine. Where the folder `hold` exists, the next run that starts takes the word `taken` and stays
        until it is killed."""
        script = self.path / f"engine-{name}"
        hold = self.path / "hold"
        script.write_text(f"""#!/bin/sh
if [ "$1" = --run ] && [ -d '{hold}' ] && mkdir '{hold}/taken' 2>/dev/null; then
  echo $$ > '{hold}/pid.part' && mv '{hold}/pid.part' '{hold}/pid'
  exec sleep 600
fi
FAKE='{fault}' FAKE_NAME={name} exec /usr/bin/python3 -B '{FAKE}' "$@"
""")
        script.chmod(0o755)
        return script

    def question(self, *engines):
        words = [
            "cases",
            "--engines",
            ",".join(["tripoint", "exact", *(e.name.removeprefix("engine-") for e in engines)]),
        ]
        for engine in engines:
            words += ["--engine", engine]
        return words

    def make(self, *engines, more=()):
        return self.done("suite", "make", "suite", *self.question(*engines), *more)

    def status(self):
        return json.loads(self.done("status", "suite", "--json").stdout)

    def jobs(self):
        return json.loads((self.suite / "suite.json").read_text())["jobs"]

    def undisturbed(self, *engines, code=0, more=()):
        end = self.call("validate", *self.question(*engines), "--out", "whole", "--no-report", *more)
        self.assertEqual(end.returncode, code, end.stdout + end.stderr)
        return bare(json.loads((self.path / "whole" / "results.json").read_text()))

    def merged(self, code=0):
        end = self.call("merge", "suite", "--no-report")
        self.assertEqual(end.returncode, code, end.stdout + end.stderr)
        return bare(json.loads((self.suite / "results.json").read_text()))

    def hold(self):
        (self.path / "hold").mkdir()

    def held(self):
        """Waits until a run is held; the process id of its engine."""
        pid = self.path / "hold" / "pid"
        wait_for(pid.exists)
        return int(pid.read_text())

    def test_two_workers_and_a_merge_give_the_results_of_one_validation(self):
        self.cases()
        fake, bad = self.engine(), self.engine("bad", "is killed")
        whole = self.undisturbed(fake, bad, code=4)
        self.make(fake, bad)
        workers = [self.start("suite", "work", "suite") for _ in range(2)]
        for worker in workers:
            text = worker.communicate(timeout=300)[0]
            self.assertEqual(worker.returncode, 0, text)
        status = self.status()
        self.assertEqual((status["waiting"], status["running"], status["lost"], status["doubled"]), (0, 0, 0, 0))
        self.assertEqual(status["failed"], 3, "the engine that is killed, in each case")
        self.assertEqual(status["done"] + status["failed"], len(self.jobs()))
        self.assertEqual(list((self.suite / "workers").iterdir()), [], "they leave nothing behind")
        self.assertEqual(self.merged(code=4), whole)
        self.assertEqual(
            (self.suite / "summary.md").read_text().split("CPU")[0],
            (self.path / "whole" / "summary.md").read_text().split("CPU")[0],
        )
        self.assertEqual(self.files_of_runs(self.suite), self.files_of_runs(self.path / "whole"))

    def files_of_runs(self, folder):
        """What runs leave, but for the notes that each way keeps of what is finished."""
        files = (file.relative_to(folder) for file in (folder / "runs").rglob("*") if file.is_file())
        return sorted(str(file) for file in files if file.name != "row.json" and not file.name.startswith("outcome-"))

    def test_a_plan_alone_writes_no_particles(self):
        self.cases(1, study=False)
        self.make()
        self.assertEqual(list(self.suite.rglob("*.h5")), [])

    def test_a_merge_writes_particles_that_are_gone(self):
        self.cases(1, study=False)
        whole = self.undisturbed()
        self.make()
        self.done("suite", "work", "suite")
        files = list(self.suite.rglob("particles/*.h5"))
        self.assertEqual(len(files), 1)
        files[0].unlink()
        self.assertEqual(self.merged(), whole)
        self.assertTrue(files[0].exists())

    def test_shards_hold_every_job_once_and_give_the_same_results(self):
        self.cases()
        fake = self.engine()
        whole = self.undisturbed(fake, more=("--seed", "5"))
        self.make(fake, more=("--seed", "5"))
        made = 0
        for k in range(1, 4):
            made += int(self.done("suite", "work", "suite", "--shard", f"{k}/3").stdout.split(": ")[1].split()[0])
        self.assertEqual(made, len(self.jobs()))
        self.assertEqual(self.merged(), whole)

    def test_a_killed_worker_is_seen_and_named_and_only_its_job_is_made_again(self):
        self.cases()
        fake = self.engine()
        whole = self.undisturbed(fake)
        self.make(fake)
        self.done("suite", "work", "suite", "--shard", "1/2")
        self.hold()
        worker = self.start("suite", "work", "suite")
        self.held()
        running = self.status()["running_jobs"]
        self.assertEqual([job["engine"] for job in running], ["fake"])
        worker.kill()
        worker.communicate()
        status = self.status()
        self.assertEqual([job["id"] for job in status["lost_jobs"]], [running[0]["id"]])
        text = self.done("status", "suite").stdout
        self.assertRegex(text, rf"lost +{running[0]['id']}  {running[0]['case']} fake")
        refused = self.call("merge", "suite")
        self.assertEqual(refused.returncode, 2)
        self.assertIn(running[0]["id"], refused.stderr)
        before = {file.name: file.stat().st_mtime_ns for file in (self.suite / "done").iterdir()}
        self.assertGreater(len(before), 5)
        again = self.done("suite", "work", "suite")
        self.assertIn(f"lost: {running[0]['case']} fake base ({running[0]['id']})", again.stderr)
        for name, stamp in before.items():
            self.assertEqual((self.suite / "done" / name).stat().st_mtime_ns, stamp, "what was done is not made again")
        self.assertEqual(self.merged(), whole)

    def test_a_worker_that_waits_takes_over_from_one_that_is_killed(self):
        self.cases(1, study=False)
        fake = self.engine()
        whole = self.undisturbed(fake)
        self.make(fake)
        self.hold()
        first = self.start("suite", "work", "suite")
        self.held()
        second = self.start("suite", "work", "suite")
        wait_for(lambda: self.status()["done"] == len(self.jobs()) - 1)
        first.kill()
        self.assertEqual(second.wait(timeout=60), 0)
        self.assertEqual(self.merged(), whole)

    def test_a_merge_into_another_folder_takes_nothing_that_a_run_links_to(self):
        self.cases(1, study=False)
        self.make(self.engine())
        self.done("suite", "work", "suite")
        secret, leak = self.path / "secret.txt", self.suite / "runs" / "leak"
        secret.write_text("precious")
        leak.symlink_to(secret)
        refused = self.call("merge", "suite", "--out", "merged", "--no-report")
        self.assertEqual(refused.returncode, 2, refused.stdout + refused.stderr)
        self.assertIn("suite/runs/leak", refused.stderr)
        self.assertEqual(list((self.path / "merged").rglob("leak")), [])
        leak.unlink()
        self.done("merge", "suite", "--out", "merged", "--no-report")

    def test_ctrl_c_gives_the_job_back(self):
        self.cases(1, study=False)
        self.make(self.engine())
        self.hold()
        worker = self.start("suite", "work", "suite")
        self.held()
        worker.send_signal(signal.SIGINT)
        self.assertEqual(worker.wait(timeout=60), 130)
        status = self.status()
        self.assertEqual((status["running"], status["lost"]), (0, 0))
        self.assertEqual(status["waiting"] + status["done"], len(self.jobs()))
        self.done("suite", "work", "suite")
        self.assertEqual(self.status()["done"], len(self.jobs()))

    def test_a_job_that_is_made_twice_is_seen_and_its_first_result_counts(self):
        self.cases(1, study=False)
        fake = self.engine()
        whole = self.undisturbed(fake)
        self.make(fake)
        self.hold()
        first = self.start("suite", "work", "suite")
        engine = self.held()
        first.send_signal(signal.SIGSTOP)  # it gives no sign any more
        sign = next((self.suite / "workers").glob("*.json"))
        told = json.loads(sign.read_text())
        sign.write_text(
            json.dumps(dict(told, machine="another"))
        )  # as if it were elsewhere, and had been silent for minutes
        os.utime(sign, (time.time() - 600,) * 2)
        self.assertEqual(self.status()["lost"], 1)
        self.done("suite", "work", "suite")
        self.assertEqual(self.merged(), whole)
        first.send_signal(signal.SIGCONT)
        os.kill(engine, signal.SIGKILL)  # the silent one goes on: its engine ends without a result
        self.assertEqual(first.wait(timeout=60), 0)
        status = self.status()
        self.assertEqual([row["same"] for row in status["doubled_jobs"]], [False])
        self.assertEqual(status["done"], len(self.jobs()))
        self.assertEqual(self.merged(), whole)

    def test_a_job_that_costs_three_workers_their_lives_is_given_up(self):
        self.cases(1, study=False)
        self.make(self.engine())
        for _ in range(3):
            self.hold()
            worker = self.start("suite", "work", "suite")
            engine = self.held()
            worker.kill()
            worker.communicate()
            with contextlib.suppress(ProcessLookupError):  # what watches the worker is mostly the first to end it
                os.kill(engine, signal.SIGKILL)
            (self.path / "hold" / "pid").unlink()
            (self.path / "hold" / "taken").rmdir()
            (self.path / "hold").rmdir()
        self.done("suite", "work", "suite")
        status = self.status()
        self.assertEqual([job["reason"] for job in status["failed_jobs"]], ["killed: its worker was lost 3 times"])
        self.merged(code=4)
        self.done("suite", "retry", "suite")
        self.done("suite", "work", "suite")
        self.merged(code=0)

    def test_what_is_done_is_not_made_again_and_a_change_remakes_what_it_changes(self):
        self.cases(2, study=False)
        fake = self.engine()
        self.make(fake)
        ids = {job["id"] for job in self.jobs()}
        self.done("suite", "work", "suite")
        self.assertIn(": 0 of ", self.done("suite", "work", "suite").stdout)
        file = self.path / "cases/test/flight1.toml"
        file.write_text(FLIGHT.replace("velocity = [1.0, 0.0, 2.0]", "velocity = [1.5, 0.0, 2.0]"))
        refused = self.call("merge", "suite")
        self.assertEqual(refused.returncode, 2, refused.stdout)
        self.assertIn("test/flight1", refused.stderr)
        kept = self.make(fake).stdout
        changed = {job["id"] for job in self.jobs()} - ids
        self.assertEqual(len(changed), len(ids) // 2)
        self.assertIn(f"; {len(ids) // 2} have a result", kept)
        self.assertIn(f": {len(changed)} of {len(ids)} jobs made here", self.done("suite", "work", "suite").stdout)
        self.assertEqual(self.merged(), self.undisturbed(fake))

    def test_a_worker_refuses_a_job_that_is_another_now(self):
        self.cases(1, study=False)
        fake = self.engine()
        self.make(fake)
        fake.write_text(fake.read_text() + "# another version\n")
        refused = self.call("suite", "work", "suite")
        self.assertEqual(refused.returncode, 2, refused.stdout)
        self.assertIn("test/flight0 fake base", refused.stderr)
        self.assertEqual((self.status()["running"], self.status()["lost"]), (0, 0))

    def test_scripts_are_right_in_the_syntax_of_their_schedulers(self):
        self.cases(2, study=False)
        self.make(self.engine())
        for name in ("slurm", "hyperqueue", "parallel"):
            script = self.done("suite", "emit", "suite", "--for", name, "--shards", "3").stdout
            self.assertEqual(subprocess.run(["bash", "-n"], input=script, text=True).returncode, 0, name)
        flow = yaml.safe_load(self.done("suite", "emit", "suite", "--for", "github", "--shards", "3").stdout)
        self.assertEqual(flow["jobs"]["shard"]["strategy"]["matrix"]["k"], [1, 2, 3])
        self.assertTrue(
            any(
                "suite work 'suite' --shard ${{ matrix.k }}/3" in step.get("run", "")
                for step in flow["jobs"]["shard"]["steps"]
            )
        )
        make = next(step["run"] for step in flow["jobs"]["merge"]["steps"] if "suite make" in step.get("run", ""))
        ids = [job["id"] for job in self.jobs()]
        subprocess.run(
            make.replace("'suite'", "again", 1),
            shell=True,
            check=True,
            cwd=self.path,
            env=dict(os.environ, PATH=f"{Path(TRIPOINT).parent}:{os.environ['PATH']}"),
            stdout=subprocess.DEVNULL,
        )
        self.assertEqual(
            [job["id"] for job in json.loads((self.path / "again/suite.json").read_text())["jobs"]],
            ids,
            "another machine plans the same jobs",
        )
        self.assertEqual(self.call("suite", "emit", "suite", "--for", "cron").returncode, 2)

    def test_only_the_shards_that_are_left_are_sent_again(self):
        self.cases(3, study=False)
        self.make(self.engine())
        self.done("suite", "work", "suite", "--shard", "2/3")
        self.assertIn(
            "--array=1,3\n", self.done("suite", "emit", "suite", "--for", "slurm", "--shards", "3", "--left").stdout
        )

    def test_a_job_whose_file_was_taken_away_is_put_back(self):
        self.cases(1, study=False)
        self.make(self.engine())
        gone = self.jobs()[0]["id"]
        (self.suite / "todo" / gone).unlink()
        self.assertEqual([job["id"] for job in self.status()["lost_jobs"]], [gone])
        self.done("suite", "work", "suite")
        self.assertEqual(self.status()["done"], len(self.jobs()))

    def test_words_that_are_wrong_end_2(self):
        self.cases(1, study=False)
        self.make(self.engine())
        for words in (
            ["status", "nowhere"],
            ["suite", "work", "suite", "--shard", "4/3"],
            ["suite", "work", "nowhere"],
            ["merge", "suite"],
            ["suite", "retry", "suite", "abc"],
            ["suite"],
            ["suite", "make", "suite", "no/such-case"],
            ["suite", "wrok", "suite"],
        ):
            self.assertEqual(self.call(*words).returncode, 2, words)
        (self.suite / "suite.json").write_text("{")
        self.assertEqual(self.call("status", "suite").returncode, 2)

    def test_a_worker_spends_at_most_five_milliseconds_more_on_a_job_than_a_validation(self):
        """CPU seconds, all processes: on a machine that others use, wall seconds say little. The least of three
        differences. Plan and merge are beside the validation, which a slow machine slows as well."""
        count = 60
        self.cases(count, study=False)
        question = ["cases", "--engines", "exact"]

        def cpu_of(*words):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.call(*words)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

        more, in_all, around = [], [], []
        for n in range(3):
            planned = cpu_of("suite", "make", f"suite{n}", *question)
            worked = cpu_of("suite", "work", f"suite{n}")
            merged = cpu_of("merge", f"suite{n}", "--no-report")
            self.assertEqual(len(list((self.path / f"suite{n}" / "done").iterdir())), count)
            validated = cpu_of("validate", *question, "--out", f"whole{n}", "--no-report")
            more.append((worked - validated) / count)
            in_all.append((planned + worked + merged - validated) / count)
            around.append((planned + merged) / validated)
        print(
            f"a job costs {min(more) * 1e3:.2f} ms more than in a validation, and {min(in_all) * 1e3:.2f} ms with "
            f"plan and merge, which take {min(around):.2f} of it",
            file=sys.stderr,
        )
        self.assertLess(min(more), 5e-3, more)
        self.assertLess(min(around), 0.2, around)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
