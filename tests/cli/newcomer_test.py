# SPDX-License-Identifier: BSD-3-Clause
"""What somebody new types, mistypes and interrupts: newcomer_test.py TRIPOINT FAKE_ENGINE SOURCE [unittest
arguments]."""

import hashlib
import json
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TRIPOINT, FAKE, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:4])
CASE = "rigid/ballistic"
FLIGHT = FAKE.with_name("flight.toml").read_text()


def hashes(folder):
    return {
        str(file): hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(folder.rglob("*")) if file.is_file()
    }


class Newcomer(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint newcomer ü ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *words, **more):
        return subprocess.run(
            [TRIPOINT, *map(str, words)],
            **({"cwd": self.path, "capture_output": True, "text": True, "timeout": 240} | more),
            check=False,
        )

    def fake(self, shell="FAKE=nothing"):
        script = self.path / "engine-fake"
        script.write_text(f"#!/bin/sh\n{shell}; export FAKE\nexec /usr/bin/python3 '{FAKE}' \"$@\"\n")
        script.chmod(0o755)
        return script

    def cases(self, *names):
        for name in names:
            file = self.path / "cases" / "test" / f"{name}.toml"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(FLIGHT)

    def validate(self, *more, shell="FAKE=nothing", **how):
        return self.call(
            "validate", "cases", "--engines", "fake", "--engine", self.fake(shell), "--out", "out", *more, **how
        )

    def judged(self, folder="out"):
        return [c["id"] for c in json.loads((self.path / folder / "results.json").read_text())["cases"]]

    # A report is not overwritten by another command
    def test_no_command_touches_the_report_of_the_suite(self):
        self.assertEqual(self.call("validate", CASE, "--engines", "bullet,exact", "--no-report").returncode, 0)
        before = hashes(self.path / "report")
        self.assertTrue(before)
        for words in (
            ["converge", CASE, "--axis", "time_step", "--engine", "bullet", "--levels", "0.04,0.02"],
            ["compare", CASE, "--engines", "bullet,exact"],
            ["plan", CASE, "--engines", "bullet", "--error", "0.02"],
            ["recommend", CASE, "--engines", "bullet", "--error", "0.03"],
            ["ablate", CASE],
        ):
            with self.subTest(words[0]):
                done = self.call(*words)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(hashes(self.path / "report"), before)
                self.assertTrue((self.path / f"report-{words[0]}").is_dir())

    def test_an_option_with_a_list_does_not_swallow_the_case_behind_it(self):
        self.cases("a")
        done = self.call("validate", "--engine", self.fake(), "--engines", "fake", "cases/test/a.toml", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            self.call(
                "converge", "--levels", "0.04,0.02", "--axis", "time_step", "--engine", "bullet", CASE
            ).returncode,
            0,
        )

    # Mistyped words
    def test_mistyped_words_get_the_nearest_name(self):
        for words, near in (
            (["valdate"], "`validate`"),
            (["run", CASE, "--engin", "bullet"], "`--engine`"),
            (["gate", "selftst"], "`gate selftest`"),
            (["gate", "accept", "--reson", "x"], "`--reason`"),
            (["engine", "chck", "x"], "`engine check`"),
            (["validate", "rigid/balistic"], "`rigid/ballistic`"),
            (["validate", "cases/rigid/ballistik.toml"], "`rigid/ballistic`"),
            (["run", "ballistic"], "`rigid/ballistic`"),
            (["explain", "haet/cosine-mode"], "`heat/cosine-mode`"),
            (["check", "heat/cosinemode"], "`heat/cosine-mode`"),
            (["validate", "haet"], "`heat`"),
        ):
            with self.subTest(" ".join(words)):
                done = self.call(*words)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(near, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_two_results_are_not_accepted_at_once(self):
        done = self.call("gate", "accept", "--reason", "x", "one.json", "other.json")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("one.json and other.json are two results", done.stderr)

    def test_a_mistyped_engine_gets_the_nearest_name_and_is_missing(self):
        for words in (
            ["run", CASE, "--engine", "bulet"],
            ["compare", CASE, "--engines", "exact,bulet"],
            ["converge", CASE, "--engine", "bulet", "--axis", "time_step", "--levels", "0.02,0.01"],
            ["plan", CASE, "--engines", "bulet", "--error", "1%"],
        ):
            with self.subTest(words[0]):
                done = self.call(*words)
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertIn("`bullet`", done.stderr)
        self.assertIn("`bullet`", self.call("validate", CASE, "--engines", "exact,bulet", "--no-report").stderr)

    def test_a_bare_call_shows_the_first_steps(self):
        done = self.call()
        self.assertEqual(done.returncode, 2)
        self.assertIn("First steps", done.stderr)

    def test_a_case_of_ones_own_goes_by_its_name_and_a_report_by_its_folder(self):
        self.assertEqual(self.call("new", "my-case").returncode, 0)
        for words in (
            ["check", "my-case"],
            ["run", "my-case"],
            ["validate", "my-case", "--no-report"],
            ["gate", "report"],
            ["report", "report"],
        ):
            done = self.call(*words)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.path / "report" / "index.html").exists())

    def test_each_template_is_a_case_without_an_error(self):
        kinds = sorted(file.stem for file in (SOURCE / "cases" / "templates").glob("*.toml"))
        self.assertEqual(len(kinds), 10)
        for kind in kinds:
            self.assertEqual(self.call("new", f"my-{kind}", "--from", kind).returncode, 0)
            text = (self.path / f"my-{kind}.toml").read_text()
            self.assertIn(f'id = "my/my-{kind}"', text)
            self.assertNotIn("profiles", text)
            done = self.call("check", f"my-{kind}.toml")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("0 errors, 0 warnings", done.stdout)
        unknown = self.call("new", "other", "--from", "tenk")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("did you mean `tank`", unknown.stderr)
        self.assertFalse((self.path / "other.toml").exists())

    def test_a_file_of_another_program_is_called_by_its_name(self):
        for text, name, next_command in (
            ("<mujoco><worldbody/></mujoco>", "MuJoCo", "tripoint import"),
            ('<?xml version="1.0"?><robot name="arm"/>', "URDF", "tripoint import"),
            ("<case><casedef/></case>", "DualSPHysics", "tripoint new"),
            ('<sdf version="1.6"/>', "SDF", "tripoint new"),
            ('{"Configuration": {}, "RigidBodies": []}', "SPlisHSPlasH", "tripoint new"),
            ("units si\natom_style sph\n", "LAMMPS", "tripoint new"),
        ):
            with self.subTest(name):
                (self.path / "scene.txt").write_text(text)
                done = self.call("check", "scene.txt")
                self.assertEqual(done.returncode, 2)
                self.assertIn(name, done.stderr)
                self.assertIn(next_command, done.stderr)

    def test_gate_from_another_folder_says_in_which_one_to_call_it(self):
        self.assertEqual(self.call("new", "my-case").returncode, 0)
        self.assertEqual(self.call("validate", "my-case", "--no-report").returncode, 0)
        elsewhere = self.path / "elsewhere"
        elsewhere.mkdir()
        done = self.call("gate", "../report", cwd=elsewhere)
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn(
            f"my-case.toml is not in {elsewhere.resolve()}: call this command in {self.path.resolve()}", done.stderr
        )
        missing = self.call("gate", "report", cwd=elsewhere)
        self.assertEqual(missing.returncode, 2)
        self.assertIn(f"report: there is no such file or folder in {elsewhere.resolve()}", missing.stderr)
        self.assertNotIn("call this command", self.call("gate", "report").stderr)

    def test_validate_tells_of_limits_that_gate_does_not_pass(self):
        self.assertEqual(self.call("new", "my-case").returncode, 0)
        case = self.path / "my-case.toml"
        self.assertNotIn("loose: ", self.call("validate", "my-case", "--no-report").stdout)
        case.write_text(case.read_text().replace("limit = 1e-10", "limit = 1e-3"))  # round-off is measured
        done = self.call("validate", "my-case", "--no-report")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        said = done.stdout.splitlines()
        self.assertEqual(
            said[-2],
            "loose: 1 limit is more than 10 times what was measured: tripoint gate report names it, and does not pass",
        )
        self.assertTrue(said[-1].startswith("verdict PASS exit 0"), said[-1])
        self.assertEqual(self.call("gate", "report").returncode, 1)

    def test_a_mistyped_tag_gets_the_nearest(self):
        self.assertIn("`heat`", self.call("validate", "heat", "--tag", "haet").stderr)

    # Folders that cannot be
    def test_an_out_that_cannot_be_made_is_said_in_one_line_before_anything_runs(self):
        (self.path / "file").write_text("")
        for words in (
            ["validate", CASE],
            ["run", CASE],
            ["compare", CASE, "--engines", "bullet,exact"],
            ["converge", CASE, "--axis", "time_step", "--engine", "bullet", "--levels", "0.02,0.01"],
            ["plan", CASE, "--error", "1%"],
            ["recommend", CASE, "--error", "1%"],
            ["ablate", CASE],
        ):
            with self.subTest(words[0]):
                done = self.call(*words, "--out", "file/below")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("--out file/below", done.stderr.splitlines()[-1])
                self.assertNotIn("filesystem error", done.stderr)

    # What the paper does not have
    def test_ablate_leaves_the_numerical_bulk_viscosity_out_where_the_scene_has_one(self):
        rows = {}
        for name, word in (("with", "numerical"), ("without", "none")):
            text = (SOURCE / "cases/fluid/breathing-column.toml").read_text()
            (self.path / "column.toml").write_text(
                text.replace("[model]", f'[model]\nbulk_viscosity = "{word}"').replace('"0.16 s"', '"8 ms"')
            )
            done = self.call("ablate", "column.toml", "--out", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows[name] = json.loads((self.path / name / "ablation.json").read_text())["cases"][0]
        taken = rows["with"]["corrected"]["metrics"]["taken"]["value"]
        self.assertGreater(taken, 1e-3)
        left_out = rows["with"]["printed"]["bulk_viscosity"]
        self.assertEqual(left_out["state_hash"], rows["without"]["corrected"]["state_hash"])
        self.assertNotIn("bulk_viscosity", rows["without"]["printed"])

    # Nor are the pressure and the steps of a contact whose stiffness the scene chooses
    def test_ablate_has_rows_of_a_contact_without_a_stiffness_in_the_case(self):
        done = self.call("ablate", "coupling/twenty-bounces-short", "--out", "contact")
        self.assertEqual(done.returncode, 0, done.stderr)
        case = json.loads((self.path / "contact" / "ablation.json").read_text())["cases"][0]
        error = {name: run["metrics"]["after twenty"]["value"] for name, run in case["printed"].items()}
        self.assertLess(case["corrected"]["metrics"]["after twenty"]["value"], 0.01)
        self.assertGreater(error["contact_step"], 0.05)
        self.assertIn("pressure", error)

    # Ctrl-C
    def test_ctrl_c_ends_with_the_report_of_the_cases_that_are_complete(self):
        self.cases("a", "b", "c")
        script = self.fake('case "$2" in */b/*) FAKE=hangs;; esac')
        process = subprocess.Popen(
            [TRIPOINT, "validate", "cases", "--engines", "fake", "--engine", script, "--out", "out"],
            cwd=self.path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        first = process.stdout.readline()
        self.assertIn("test/a", first)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(out.splitlines()[-1], "verdict INTERRUPTED exit 130  out/index.html")
        self.assertEqual(self.judged(), ["test/a"])
        self.assertIn("test/a", (self.path / "out" / "index.html").read_text())
        results = json.loads((self.path / "out" / "results.json").read_text())
        self.assertEqual(results["problems"], ["stopped by Ctrl-C: 1 of 3 planned cases are complete"])
        self.assertEqual(self.call("gate", "out/results.json").returncode, 130)  # not green, whatever the one case says

    # Everyday use
    def test_k_and_last_failed_choose_cases(self):
        self.cases("float", "fall", "fly")
        self.assertEqual(self.validate("-k", "f", "--no-report").returncode, 0)
        self.assertEqual(self.judged(), ["test/fall", "test/float", "test/fly"])
        self.assertEqual(self.validate("-k", "nothing-like-it", "--no-report").returncode, 2)
        self.assertEqual(self.validate("--last-failed", "--no-report").returncode, 2)  # all are green
        self.assertEqual(
            self.validate("--no-report", shell='case "$2" in */fl*) FAKE="one per cent of gravity";; esac').returncode,
            1,
        )
        self.assertEqual(self.validate("--last-failed", "--no-report").returncode, 0)
        self.assertEqual(self.judged(), ["test/float", "test/fly"])

    def test_no_report_leaves_results_without_a_page_and_names_them(self):
        self.cases("a")
        self.assertEqual(self.validate().stdout.splitlines()[-1], "verdict PASS exit 0  out/index.html")
        done = self.validate("--no-report")
        self.assertEqual(done.stdout.splitlines()[-1], "verdict PASS exit 0  out/results.json")
        self.assertFalse((self.path / "out" / "index.html").exists())  # a page of the run before would lie
        self.assertTrue((self.path / "out" / "junit.xml").exists())

    def test_subjects_and_profiles_of_the_shipped_cases_from_any_folder(self):
        every = self.call("list", "--json").stdout
        heat = [c["id"] for c in json.loads(self.call("list", "heat", "--json").stdout)["cases"]]
        self.assertEqual(heat, [c["id"] for c in json.loads(every)["cases"] if c["id"].startswith("heat/")])
        commit = [c["id"] for c in json.loads(self.call("list", "--profile", "commit", "--json").stdout)["cases"]]
        self.assertEqual(commit, [c["id"] for c in json.loads(every)["cases"] if "commit" in c["profiles"]])
        carried = [id for id in heat if "cosine" in id]
        self.assertIn(
            f"{len(carried)} case",
            self.call("validate", "heat", "-k", "cosine", "--engines", "exact", "--no-report").stderr,
        )

    def test_a_folder_of_runs_with_the_name_of_a_subject_is_not_taken_for_it(self):
        (self.path / "heat" / "runs").mkdir(parents=True)
        self.assertIn("heat/cosine-mode", self.call("list", "heat").stdout)

    def on_a_terminal(self, *words, **environment):
        leader, follower = pty.openpty()
        process = subprocess.Popen(
            [TRIPOINT, *map(str, words)],
            cwd=self.path,
            stdout=follower,
            stderr=subprocess.DEVNULL,
            env=dict(os.environ, TERM="xterm") | environment,
        )
        os.close(follower)
        text = b""
        while True:
            try:
                piece = os.read(leader, 4096)
            except OSError:
                break
            if not piece:
                break
            text += piece
        process.wait(timeout=60)
        os.close(leader)
        return text.decode()

    def test_verdicts_have_colours_on_a_terminal_and_nowhere_else(self):
        self.cases("a")
        words = ["validate", "cases", "--engines", "fake", "--engine", self.fake(), "--out", "out", "--no-report"]
        environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        self.assertIn("\033[1;32mPASS\033[0m", self.on_a_terminal(*words))
        self.assertNotIn("\033", self.on_a_terminal(*words, NO_COLOR="1"))
        self.assertNotIn("\033", self.on_a_terminal(*words, TERM="dumb"))
        self.assertNotIn("\033", self.call(*words, env=environment | {"TERM": "xterm"}).stdout)

    def test_run_prints_values_with_units_and_limits(self):
        out = self.call("run", CASE, "--engine", "bullet").stdout
        self.assertRegex(out, r"(?m)^  metric +value +unit +\+- u$")
        self.assertRegex(out, r"(?m)^  position +0\.04905 m +0  band 0\.0485 to 0\.0496")
        self.assertRegex(out, r"(?m)^  orientation +\S+ rad +0  limit 1e-10 \(\S+ % of it\)")

    def test_explain_begins_with_a_summary(self):
        lines = self.call("explain", CASE).stdout.splitlines()
        head = lines[: lines.index("")]
        self.assertTrue(9 <= len(head) <= 11, head)
        self.assertEqual(head[0], f"{CASE}: Ballistic flight with spin")
        for name in (
            "claims",
            "simulates  64 particles",
            "bodies",
            "effects",
            "truth",
            "measures",
            "judged by",
            "engines",
            "costs",
        ):
            self.assertTrue(any(line.strip().startswith(name) for line in head), name)
        self.assertIn("100 steps of 0.01 s, bound by scene, each computed in ", head[-1])

    # What is not installed or not built is said with the line to type
    def test_a_pdf_without_its_library_is_no_success(self):
        self.cases("a")
        self.validate("--no-report")
        tools = self.path / "bin"
        tools.mkdir()
        done = self.call("report", "out/results.json", "--pdf", env=dict(os.environ, PATH=str(tools)))
        self.assertEqual(done.returncode, 4)
        self.assertIn("apt-get install weasyprint", done.stderr)
        self.assertTrue((self.path / "out" / "index.html").exists())

    def test_a_selftest_without_its_build_says_the_line_to_type(self):
        shutil.copy(TRIPOINT, self.path / "tripoint")  # beside no engine
        (self.path / "share").symlink_to(TRIPOINT.parent.parent / "share")
        done = subprocess.run(
            [self.path / "tripoint", "gate", "selftest", CASE],
            cwd=self.path,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        self.assertEqual(done.returncode, 4, done.stderr)
        line = re.search(r"type:  (\S+) (--selftest) \d", done.stderr)
        self.assertIn(line[2] + ")", (SOURCE / line[1]).read_text())

    def test_the_build_for_the_selftest_needs_no_library_of_the_tests(self):
        build = self.path / "build"
        subprocess.run(
            ["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DTRIPOINT_TESTS=OFF", "-DTRIPOINT_SELFTEST=ON"],
            check=True,
            capture_output=True,
            timeout=240,
        )
        self.assertNotIn("GTest_DIR", (build / "CMakeCache.txt").read_text())
        targets = subprocess.run(
            ["ninja", "-C", build, "-t", "targets", "all"], check=True, capture_output=True, text=True, timeout=60
        ).stdout
        self.assertIn("libexec/tripoint/selftest/engine-tripoint:", targets)
        self.assertNotIn("test-effects", targets)

    def test_a_plan_offers_no_level_far_beyond_what_was_measured(self):
        self.call(
            "converge", CASE, "--axis", "time_step", "--engine", "bullet", "--levels", "0.04,0.02,0.01", "--out", "c"
        )
        file = self.path / "c" / "results.json"
        self.assertEqual(
            self.call("plan", CASE, "--from", file, "--error", "0.01", "--axis", "time_step").returncode, 0
        )  # four times finer
        far = self.call("plan", CASE, "--from", file, "--error", "1e-7", "--axis", "time_step")
        self.assertEqual(far.returncode, 3)
        self.assertIn("out of reach", far.stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
