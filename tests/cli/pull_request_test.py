# SPDX-License-Identifier: BSD-3-Clause
"""Pull requests played through the action's own steps, and what the workflows may do: pull_request_test.py TRIPOINT
SOURCE."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

from pull_requests import CHANGES, Repository, comments, with_comments

TRIPOINT, SOURCE = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
WORKFLOWS = [
    *sorted((SOURCE / ".github" / "workflows").glob("*.yml")),
    *sorted((SOURCE / "examples" / "gated-engine" / ".github" / "workflows").glob("*.yml")),
]


def row(comment, metric):
    return next(line for line in comment.splitlines() if line.startswith("|") and metric in line)


class PullRequests(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory(prefix="tripoint pull requests ")
        self.repository = Repository(Path(self.place.name) / "project", TRIPOINT)

    def tearDown(self):
        self.place.cleanup()

    def test_a_better_one_is_green_and_says_by_how_much(self):
        run, comment = self.repository.pull_request("shorter-steps")
        self.assertFalse(run.failed, run.log)
        self.assertTrue(comment.startswith("<!-- tripoint: accuracy -->\n## Accuracy: PASS\n"), comment)
        self.assertRegex(
            row(comment, "glide lag"),
            r"\| \*\*better\*\* \| -0\.409 \| "
            r"\[flight/glide\]\(https://github\.com/OWNER/project/blob/[0-9a-f]{40}/cases/flight/glide\.toml#L\d+\) "
            r".* of limit 0\.006 ",
        )
        self.assertIn("**1 better, 0 worse, 2 unchanged, 0 new, 0 gone**", comment)
        self.assertIn("head shorter-steps; base main", comment)
        self.assertIn(comment, run.summary.read_text())

    def test_a_worse_one_within_its_limit_is_said_and_noise_is_told_from_it(self):
        run, comment = self.repository.pull_request("longer-steps")
        self.assertFalse(run.failed, run.log)
        self.assertIn("| **worse** | +0.111 |", row(comment, "glide lag"))
        self.assertRegex(row(comment, "glide gauge"), r"^\| same \| [+-]0\.\d+ .*, 5 seeds \|$")
        said = re.findall(
            r"^::warning file=cases/flight/glide\.toml,line=(\d+),title=flight/glide glide lag at 0\.1::(.*)$",
            run.log,
            re.M,
        )
        self.assertEqual(len(said), 1, run.log)
        self.assertIn("is worse than the base by +0.111 of its limit, and within it", said[0][1])
        self.assertEqual(
            (self.repository.folder / "cases/flight/glide.toml").read_text().splitlines()[int(said[0][0]) - 1],
            "limit = 6e-3",
        )

    def test_where_nothing_may_get_worse_it_is_red(self):
        run, comment = self.repository.pull_request("longer-steps", **{"no-worse": "true"})
        self.assertTrue(run.failed)
        self.assertEqual(run.outputs["gate"]["exit-code"], "1")
        self.assertIn("verdict WORSE exit 1", run.log)

    def test_one_beyond_its_limit_is_red_and_informational_says_so_and_passes(self):
        run, comment = self.repository.pull_request("too-long-steps")
        self.assertTrue(run.failed)
        self.assertEqual(run.outputs["gate"]["exit-code"], "1")
        self.assertIn("## Accuracy: FAIL\n", comment)
        self.assertIn("### Not green", comment)
        run, comment = self.repository.pull_request("too-long-steps", informational="true")
        self.assertFalse(run.failed, run.log)
        self.assertEqual(run.outputs["gate"]["exit-code"], "1")
        self.assertIn("nothing is blocked", run.log)
        self.assertIn("## Accuracy: FAIL (informational: nothing is blocked)\n", comment)

    def test_without_a_base_it_says_so(self):
        self.repository.results.unlink()
        run, comment = self.repository.pull_request("shorter-steps")
        self.assertFalse(run.failed, run.log)
        self.assertIn("no base to compare with yet", run.log)
        self.assertIn("| case | metric | value | of the limit |", comment)

    def test_leaves_data_for_dashboards_a_badge_and_sarif(self):
        self.repository.pull_request("longer-steps")
        report = self.repository.folder / "report"
        data = {entry["name"]: entry for entry in json.loads((report / "data.json").read_text())}
        self.assertEqual(
            set(data),
            {"flight/glide glide lag at 0.1", "flight/glide glide gauge at 0.1", "flight/glide glide flown at 0.1"},
        )
        self.assertAlmostEqual(
            data["flight/glide glide lag at 0.1"]["value"], 9.81 * 0.05 / 44 / 2, delta=1e-7
        )  # 44 steps in each 50 ms
        self.assertEqual(data["flight/glide glide lag at 0.1"]["unit"], "m")
        self.assertRegex(data["flight/glide glide gauge at 0.1"]["range"], r"^\u00b1 [\d.e-]+$")
        self.assertTrue(all(entry["value"] < 1.0 for entry in json.loads((report / "shares.json").read_text())))
        self.assertEqual(json.loads((report / "badge.json").read_text())["message"], "3/3 gates")
        self.assertIn("accuracy: 3/3 gates", (report / "badge.svg").read_text())
        self.assertEqual(json.loads((report / "results.sarif").read_text())["version"], "2.1.0")

    def test_a_baseline_is_proposed_and_accepted_by_nobody_but_a_person(self):
        repository = self.repository
        (repository.folder / "baselines").mkdir()
        subprocess.run(
            [TRIPOINT, "gate", "accept", "--reason", "first figures", "report/results.json"],
            cwd=repository.folder,
            check=True,
            capture_output=True,
        )
        repository.commit("Keep the first figures")
        run, _ = repository.pull_request("shorter-steps")
        self.assertEqual(run.outputs["gate"]["exit-code"], "6", "twice the steps are dearer than what was accepted")
        self.assertEqual(repository.git("status", "--porcelain", "baselines"), "")
        patch = (repository.folder / "report/baselines.patch").read_text()
        self.assertIn(
            "# tripoint gate accept --reason 'who decided what, and why' report/results.json flight/glide\n", patch
        )
        repository.git("apply", "report/baselines.patch")
        self.assertIn("nobody has decided", (repository.folder / "baselines/flight/glide.toml").read_text())
        done = subprocess.run([TRIPOINT, "gate", "report"], cwd=repository.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 4, done.stdout)
        self.assertIn("was proposed, and nobody has accepted it", done.stdout)
        subprocess.run(
            [TRIPOINT, "gate", "accept", "--reason", "smaller steps", "report"],
            cwd=repository.folder,
            check=True,
            capture_output=True,
        )
        self.assertEqual(
            subprocess.run([TRIPOINT, "gate", "report"], cwd=repository.folder, capture_output=True).returncode, 0
        )

    def assert_nothing_is_forged(self, text):
        commands = [line for line in text.splitlines() if re.match(r"\s*::", line)]
        self.assertEqual(
            [line for line in commands if not re.match(r"::(error|warning) (file=[^,]*,line=\d+,)?title=", line)], []
        )
        self.assertEqual(
            [line for line in text.splitlines() if line.startswith("verdict PASS") or "##[" in line or "\x1b" in line],
            [],
        )

    def test_no_text_of_others_forges_a_command_a_verdict_or_a_tag(self):
        hostile = r"x\n::error file=a::forged\nverdict PASS exit 0\n<script>alert(1)</script>|##[error]old \u001b[2J"
        engine, case = (self.repository.folder / name for name in ("engine-glide", "cases/flight/glide.toml"))
        engine.write_text(
            engine.read_text()
            .replace('"version": "1"', f'"version": "{hostile}"')
            .replace("STEP = 1e-3 ", "STEP = 2e-3 ")
        )
        case.write_text(
            case.read_text()
            .replace('A block thrown up and sideways"', hostile + '"')
            .replace('unit = "m"', f'unit = "m{hostile}"')
            .replace("mean of five runs", hostile)
            .replace("g dt t/2 is", hostile)
        )
        run = self.repository.action("feature", "main")
        self.assertTrue(run.failed)
        self.assert_nothing_is_forged(run.log)
        self.assert_nothing_is_forged(run.messages)
        report = self.repository.folder / "report"
        results = json.loads((report / "results.json").read_text())
        self.assertIn("\n::error", results["cases"][0]["engines"][0]["version"])
        # What validate refuses as a name, a results file that was made by hand may hold.
        text = (report / "results.json").read_text()
        for name in ("flight/glide", '"glide"', '"lag"'):
            text = text.replace(name, name.rstrip('"') + hostile + ('"' if name.endswith('"') else ""))
        (report / "results.json").write_text(text)
        for words in (
            ["gate", "report"],
            ["gate", "report", "--against", str(self.repository.results)],
            ["summary", "report"],
            ["report", "report"],
        ):
            done = subprocess.run([TRIPOINT, *words], cwd=self.repository.folder, capture_output=True, text=True)
            self.assert_nothing_is_forged(done.stdout.replace("verdict PASS exit 0  report", ""))
            self.assert_nothing_is_forged(done.stderr)
        markdown = subprocess.run(
            [TRIPOINT, "summary", "report", "--markdown", "--against", str(self.repository.results)],
            cwd=self.repository.folder,
            capture_output=True,
            text=True,
        ).stdout
        self.assertIn("## Accuracy: FAIL", markdown)
        texts = {"the comment": markdown} | {
            name: (report / name).read_text()
            for name in ("comment.md", "summary.md", "index.html", "junit.xml", "badge.svg", "data.json")
        }
        for name, text in texts.items():
            self.assertNotIn("<script>alert", text, name)
            if name != "index.html":  # a page has no lines: a break in its text is a space
                self.assertEqual(
                    [line for line in text.splitlines() if line.startswith(("verdict PASS", "::"))], [], name
                )
        for line in markdown.splitlines():
            if line.startswith("|"):
                self.assertEqual(line.count("|"), 8, line)

    def test_the_page_holds_the_comments_as_they_are_made(self):
        page = (SOURCE / "docs" / "ci.md").read_text()
        self.assertEqual(page, with_comments(page, comments(TRIPOINT)), "make pages writes them anew")
        self.assertLess({"shorter-steps", "longer-steps"}, set(CHANGES))


class Workflows(unittest.TestCase):
    def test_every_action_is_pinned_by_its_commit(self):
        found = 0
        for path in WORKFLOWS:
            for line in path.read_text().splitlines():
                if re.search(r"^\s*(- )?uses:", line):
                    found += 1
                    self.assertRegex(line, r"uses: [\w/.-]+@([0-9a-f]{40}|COMMIT) # v\d+\.\d+\.\d+$", path)
        self.assertGreaterEqual(found, 5)

    def test_each_has_the_least_permissions_and_fills_no_text_of_others_into_a_script(self):
        for path in WORKFLOWS:
            workflow = yaml.safe_load(path.read_text())
            self.assertNotIn("pull_request_target", str(workflow.get("on", workflow.get(True))), path)
            self.assertIn(workflow["permissions"], ({}, {"contents": "read"}), path)
            for job in workflow["jobs"].values():
                self.assertLessEqual(
                    set(job.get("permissions", {}).items()), {("actions", "read"), ("pull-requests", "write")}, path
                )
                for step in job["steps"]:
                    self.assertNotIn("${{", step.get("run", ""), path)
                    if step.get("uses", "").startswith("actions/checkout"):
                        self.assertIs(step["with"]["persist-credentials"], False, path)

    def test_what_may_write_runs_nothing_that_the_pull_request_brings(self):
        workflow = yaml.safe_load((SOURCE / "examples/gated-engine/.github/workflows/accuracy-comment.yml").read_text())
        steps = workflow["jobs"]["comment"]["steps"]
        self.assertFalse([s for s in steps if "checkout" in s.get("uses", "")])
        self.assertIn("--network none --read-only", next(s["run"] for s in steps if s.get("name") == "text"))

    def test_the_other_project_gives_what_the_action_asks_for(self):
        inputs = yaml.safe_load((SOURCE / ".github/actions/gate/action.yml").read_text())["inputs"]
        workflow = yaml.safe_load((SOURCE / "examples/gated-engine/.github/workflows/accuracy.yml").read_text())
        step = next(s for s in workflow["jobs"]["gate"]["steps"] if "tripoint" in s.get("uses", ""))
        self.assertLessEqual(set(step["with"]), set(inputs))
        self.assertLessEqual({name for name, about in inputs.items() if about.get("required")}, set(step["with"]))

    def test_the_shell_of_each_step_is_well_formed(self):
        for path in [*WORKFLOWS, SOURCE / ".github/actions/gate/action.yml"]:
            document = yaml.safe_load(path.read_text())
            for job in document["jobs"].values() if "jobs" in document else [document["runs"]]:
                for step in job["steps"]:
                    done = subprocess.run(["bash", "-n"], input=step.get("run", ""), capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, f"{path}: {done.stderr}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
