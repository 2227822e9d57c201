# SPDX-License-Identifier: BSD-3-Clause
"""From an empty repository to red merges: merge_walk_test.py TRIPOINT SOURCE [unittest arguments].

A git repository gets an engine with contact, friction, restitution and a gyroscopic term
(examples/gated-engine/engine-stone) and what `gate adopt` writes of it. Then pull requests come, and each is judged as
the action does: by the baselines of the branch that it is to go into."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from action_runner import Runner

TRIPOINT, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
STONE = SOURCE / "examples" / "gated-engine" / "engine-stone"
BALL, SLOPE, TOP, THROW = "contact/ball-restitution-050", "contact/slope-slip", "rigid/torque-free", "rigid/ballistic"
AUTHOR = {
    f"GIT_{who}_{what}": f"nobody{'' if what == 'NAME' else '@localhost'}"
    for who in ("AUTHOR", "COMMITTER")
    for what in ("NAME", "EMAIL")
}
# A better scheme of the same number of steps: where there is a floor, the place moves by the mean of old and new
# velocity.
BETTER = (
    "x = [c + dt * u for c, u in zip(x, v)]",
    "x = [c + dt * u - (0.0 if ground is None else dt * dt * a / 2) for c, u, a in zip(x, v, g)]",
)


def call(folder, *words):
    environment = {
        **os.environ,
        **AUTHOR,
        "NO_COLOR": "1",
        "GIT_CONFIG_GLOBAL": "/dev/null",
        "GIT_CONFIG_SYSTEM": "/dev/null",
    }
    return subprocess.run(
        [str(word) for word in words],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


class MergeWalk(unittest.TestCase):
    """One repository for all tests; each test is a branch of its own off main."""

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory(prefix="tripoint merge walk ")
        cls.project, cls.target = Path(cls.place.name) / "project", Path(cls.place.name) / "target"
        cls.project.mkdir()
        cls.git("init", "--quiet", "--initial-branch=main")
        shutil.copy(STONE, cls.project / "engine-stone")
        cls.adopted = call(
            cls.project,
            TRIPOINT,
            "gate",
            "adopt",
            "--engine",
            "./engine-stone",
            "--out",
            "cases",
            BALL,
            SLOPE,
            TOP,
            THROW,
        )
        (cls.project / ".gitignore").write_text("report*\nsummary\noutput\n")
        cls.commit("An engine, and what it must keep")
        cls.git("worktree", "add", "--quiet", "--detach", str(cls.target), "main")

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    @classmethod
    def git(cls, *words):
        done = call(cls.project, "git", "-c", "core.hooksPath=/dev/null", "-c", "commit.gpgsign=false", *words)
        assert done.returncode == 0, done.stderr
        return done.stdout

    @classmethod
    def commit(cls, message):
        cls.git("add", "--all")
        cls.git("commit", "--quiet", "--message", message)

    def setUp(self):
        self.assertEqual(self.adopted.returncode, 0, self.adopted.stdout + self.adopted.stderr)
        self.git("checkout", "--quiet", "--force", "main")
        self.git("clean", "--quiet", "--force", "-d")
        self.git("checkout", "--quiet", "-B", re.sub(r"\W+", "-", self.id().rsplit(".", 1)[-1]))

    def tripoint(self, *words):
        return call(self.project, TRIPOINT, *words)

    def edit(self, file, before, after):
        path = self.project / file
        self.assertIn(before, path.read_text())
        path.write_text(path.read_text().replace(before, after))

    def validate(self, *words):
        return self.tripoint(
            "validate",
            "cases",
            "--engine",
            "./engine-stone",
            "--engines",
            "stone",
            "--no-report",
            "--no-history",
            *words,
        )

    def gate(self):
        return self.tripoint("gate", "report", "--baselines", self.target / "baselines", "--require-baselines")

    def accept(self, *ids):
        done = self.tripoint("gate", "accept", "--reason", "trust me", "report/results.json", *ids)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def merge(self):
        """@return (exit code of the required check, its words)"""
        self.commit("A pull request")
        done = self.validate()
        if not (self.project / "report" / "results.json").exists():
            return done.returncode, done.stdout + done.stderr
        gate = self.gate()
        return gate.returncode or done.returncode, gate.stdout

    def band(self, case, metric):
        """(line of the band, its edges) of an adopted gate."""
        text = (self.project / "cases" / f"{case}.toml").read_text()
        found = re.search(rf'metric = "{metric}"\nengine = "stone"\n(?:level = .*\n)?(band = \[(.*), (.*)\])', text)
        self.assertTrue(found, text)
        return found[1], float(found[2]), float(found[3])

    def test_as_it_is_it_is_green(self):
        done = self.validate()
        self.assertEqual((done.returncode, self.gate().returncode), (0, 0), done.stdout + self.gate().stdout)

    def assert_red(self, code, words, *said):
        self.assertNotEqual(code, 0, words)
        for word in said:
            self.assertRegex(words, word)

    def test_a_restitution_two_per_cent_off_is_red(self):
        self.edit("engine-stone", "RESTITUTION = 1.0 ", "RESTITUTION = 1.02 ")
        self.assert_red(*self.merge(), rf"{BALL} stone rebound")

    def test_a_friction_two_per_cent_off_is_red(self):
        self.edit("engine-stone", "FRICTION = 1.0 ", "FRICTION = 0.98 ")
        self.assert_red(*self.merge(), rf"{SLOPE} stone velocity")

    def test_no_gyroscopic_term_is_red(self):
        self.edit("engine-stone", "GYROSCOPIC = 1.0 ", "GYROSCOPIC = 0.0 ")
        self.assert_red(*self.merge(), rf"{TOP} stone angle")

    def test_a_limit_that_is_loosened_and_accepted_is_red(self):
        line, low, high = self.band(THROW, "position")
        self.edit(f"cases/{THROW}.toml", line, f"band = [{low}, {2 * high}]")
        self.validate()
        self.accept(THROW)
        self.assert_red(
            *self.merge(), r"stone position: loosened: .*\(its upper edge has moved", "verdict LOOSENED exit 4"
        )

    def test_a_baseline_that_is_deleted_is_red(self):
        (self.project / "baselines" / f"{THROW}.toml").unlink()
        self.assert_red(*self.merge(), r"its baseline baselines/rigid/ballistic.toml is gone", "verdict GONE exit 4")

    def test_a_case_that_is_deleted_with_its_baseline_is_red(self):
        for folder in ("cases", "baselines"):
            (self.project / folder / f"{THROW}.toml").unlink()
        self.assert_red(
            *self.merge(),
            r"rigid/ballistic: has a baseline of \d+ gates, and its case .* is no more",
            "verdict GONE exit 4",
        )

    def test_all_cases_and_baselines_deleted_are_red(self):
        for folder in ("cases", "baselines"):
            shutil.rmtree(self.project / folder)
        shutil.rmtree(self.project / "report", ignore_errors=True)
        self.assert_red(*self.merge(), "cases")

    def test_a_case_that_is_a_link_is_red(self):
        case = self.project / "cases" / f"{THROW}.toml"
        easy = self.project / "easy.toml"
        easy.write_text(case.read_text().replace(self.band(THROW, "position")[0], "band = [0.0, 1.0]"))
        case.unlink()
        case.symlink_to("../../easy.toml")
        self.assert_red(*self.merge(), r"ballistic.toml: is a link, and could lead to an easier case", r"exit 4")

    def test_a_folder_of_cases_that_is_a_link_is_red(self):
        (self.project / "cases" / "rigid").rename(self.project / "other")
        (self.project / "cases" / "rigid").symlink_to("../other")
        self.assert_red(*self.merge(), r"rigid: is a link", r"exit 4")

    def test_the_folder_cases_that_is_a_link_is_red(self):
        (self.project / "cases").rename(self.project / "real")
        (self.project / "cases").symlink_to("real")
        self.assert_red(*self.merge(), r"cases: is a link", r"exit 4")

    def test_a_case_that_is_renamed_in_place_is_red(self):
        self.edit(f"cases/{THROW}.toml", 'id = "rigid/ballistic"', 'id = "rigid/other"')
        self.assert_red(
            *self.merge(),
            r"its id was rigid/ballistic when its figures were accepted: it was renamed in place",
            "verdict CHANGED exit 4",
        )

    def test_an_easier_scene_is_red_though_it_is_accepted(self):
        self.edit(f"cases/{BALL}.toml", "restitution = 0.5", "restitution = 0.6")
        self.validate()
        self.assert_red(
            *self.merge(), r"contact/ball-restitution-050: its scene, a study, or a setting of an engine has changed"
        )

    def test_a_new_case_without_a_baseline_is_red_and_with_one_green(self):
        text = (self.project / "cases" / f"{THROW}.toml").read_text()
        (self.project / "cases" / "rigid" / "second.toml").write_text(
            text.replace('id = "rigid/ballistic"', 'id = "rigid/second"')
        )
        self.assert_red(*self.merge(), r"rigid/second: has no baseline")
        self.accept("rigid/second")
        code, words = self.merge()
        self.assertEqual(code, 0, words)

    def test_a_case_that_is_not_run_is_red(self):
        self.tripoint(
            "validate",
            "cases/contact",
            "--engine",
            "./engine-stone",
            "--engines",
            "stone",
            "--no-report",
            "--no-history",
        )
        done = self.gate()
        self.assert_red(
            done.returncode,
            done.stdout,
            r"rigid/ballistic: has accepted figures, and is not among these results",
            "exit 4",
        )

    def test_an_adopted_engine_that_is_left_out_is_no_pass(self):
        for engines in ("tripoint", "exact"):
            done = self.tripoint("validate", f"cases/{SLOPE}.toml", "--engines", engines, "--no-report", "--no-history")
            self.assertEqual(done.returncode, 4, engines + done.stdout)
            self.assertIn("stone was adopted by this case, and was left out by --engines", done.stdout)

    def test_a_report_that_is_older_than_the_engine_is_red(self):
        self.validate()
        self.edit("engine-stone", "FRICTION = 1.0 ", "FRICTION = 0.5 ")
        done = self.gate()
        self.assert_red(
            done.returncode,
            done.stdout,
            r"the results are not of this engine: engine-stone has changed since they were made",
            "exit 4",
        )

    def test_a_version_that_falls_is_named(self):
        self.edit("engine-stone", '"version": "1.0"', '"version": "0.9.7"')
        code, words = self.merge()
        self.assertEqual(code, 0, words)
        self.assertIn("its version has fallen from 1.0, which was accepted, to 0.9.7", words)

    def test_a_flag_that_is_untrue_is_named(self):
        self.edit(
            "engine-stone",
            "        now = t\n",
            "        x[0] += 1e-15 * os.urandom(1)[0] if t > 0 else 0.0\n        now = t\n",
        )
        code, words = self.merge()
        self.assertEqual(code, 0, words)
        self.assertRegex(
            words,
            r"warning: .* stone: says that it is deterministic, and that is untrue: \w+ is .* in one run and .* in "
            r"its repeat",
        )

    def test_a_limit_dated_tomorrow_is_no_case(self):
        self.edit(
            f"cases/{THROW}.toml",
            re.search(r'date = ".*"', (self.project / "cases" / f"{THROW}.toml").read_text())[0],
            'date = "tomorrow"',
        )
        self.assert_red(*self.merge(), r"date")

    def test_a_better_engine_within_the_margin_is_green(self):
        self.edit("engine-stone", '"version": "1.0"', '"version": "1.1"')
        self.edit("engine-stone", *BETTER)
        self.edit("engine-stone", "dt * dt * a / 2", "dt * dt * a / 10")  # a fifth of the way to the better scheme
        code, words = self.merge()
        self.assertEqual(code, 0, words)

    def test_a_better_engine_with_new_narrower_bands_is_green(self):
        self.edit("engine-stone", *BETTER)
        self.assert_red(
            *self.merge(), rf"{SLOPE} stone position", "verdict FAIL exit 1"
        )  # news, until its bands are moved
        done = self.tripoint(
            "gate", "adopt", "--engine", "./engine-stone", "--out", "cases", "--overwrite", SLOPE, BALL
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        code, words = self.merge()
        self.assertEqual(code, 0, words)

    def test_the_action_judges_so_too(self):
        action = SOURCE / ".github" / "actions" / "gate"
        given = {
            "tripoint": str(TRIPOINT),
            "cases": "cases",
            "engine": "./engine-stone",
            "engines": "stone",
            "baselines": str(self.target / "baselines"),
        }
        (self.project / "baselines" / f"{THROW}.toml").unlink()
        run = Runner(action, self.project, given).run()
        self.assertTrue(run.failed)
        self.assertEqual(run.outputs["gate"]["exit-code"], "4")
        self.assertRegex(run.log, r"::error .*its baseline baselines/rigid/ballistic.toml is gone")
        self.assertIn("## Accuracy: GONE", (self.project / run.outputs["comment"]["comment"]).read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
