# SPDX-License-Identifier: BSD-3-Clause
"""The composite action's own steps, run in a shell as a runner would, on the example of another project: action_test.py TRIPOINT SOURCE."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

TRIPOINT, SOURCE = sys.argv[1], Path(sys.argv[2])
ACTION = SOURCE / ".github" / "actions" / "gate"


class Runner:
    """As much of a runner as the action asks of one: inputs, outputs of steps, `if`, and the files that steps write to."""

    def __init__(self, workspace, inputs):
        self.workspace, self.action = workspace, yaml.safe_load((ACTION / "action.yml").read_text())
        self.inputs = {name: inputs.get(name, about.get("default", "")) for name, about in self.action["inputs"].items()}
        for name, about in self.action["inputs"].items():
            assert not about.get("required") or inputs.get(name), name
        self.outputs, self.log, self.failed, self.summary = {}, "", False, workspace / "summary"

    def value(self, expression):
        kind, *path = expression.strip().split(".")
        return self.inputs[path[0]] if kind == "inputs" else self.outputs.get(path[0], {}).get(path[-1], "")

    def fill(self, text):
        return re.sub(r"\$\{\{ *([\w.-]+) *\}\}", lambda m: self.value(m[1]), str(text))

    def wanted(self, step):
        parts = [part.strip() for part in step.get("if", "success()").split("&&")]
        if "always()" not in parts and self.failed:
            return False
        for part in parts:
            if part in ("always()", "success()"):
                continue
            left, sign, right = re.fullmatch(r"(\S+) (==|!=) '(.*)'", part).groups()
            if (self.value(left) == right) != (sign == "=="):
                return False
        return True

    def run(self):
        for step in self.action["runs"]["steps"]:
            assert step["shell"] == "bash"
            if not self.wanted(step):
                continue
            output = self.workspace / "output"
            output.write_text("")
            environment = dict(os.environ, GITHUB_ACTION_PATH=str(ACTION), GITHUB_OUTPUT=str(output), GITHUB_STEP_SUMMARY=str(self.summary), GITHUB_WORKSPACE=str(self.workspace),
                               GITHUB_ACTIONS="true", **{name: self.fill(text) for name, text in step.get("env", {}).items()})
            done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", self.fill(step["run"])], cwd=self.workspace, env=environment, capture_output=True, text=True, timeout=300)
            self.log += done.stdout
            self.outputs[step.get("id", step["name"])] = dict(line.split("=", 1) for line in output.read_text().splitlines())
            self.failed = self.failed or done.returncode != 0
        return self


class Action(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint action ü ")
        self.project = Path(self.folder.name) / "project"
        shutil.copytree(SOURCE / "examples" / "gated-engine", self.project)

    def tearDown(self):
        self.folder.cleanup()

    def gate(self, **inputs):
        return Runner(self.project, {"tripoint": TRIPOINT, "cases": "cases", "engine": "./engine-verlet", "engines": "verlet"} | inputs).run()

    def test_the_example_of_another_project_is_green(self):
        run = self.gate()
        self.assertFalse(run.failed, run.log)
        self.assertEqual(run.outputs["gate"]["exit-code"], "0")
        self.assertTrue((self.project / run.outputs["gate"]["report"]).exists())
        self.assertIn("# tripoint: PASS", run.summary.read_text())
        self.assertNotIn("::error", run.log)

    def test_a_wrong_constant_turns_it_red_with_an_annotation_at_the_limit(self):
        engine = self.project / "engine-verlet"
        engine.write_text(engine.read_text().replace("HALF = 0.5 ", "HALF = 0.51 "))
        run = self.gate()
        self.assertTrue(run.failed)
        self.assertEqual(run.outputs["gate"]["exit-code"], "1")
        places = re.findall(r"^::error file=([^,]*),line=(\d+),", run.log, re.M)
        self.assertEqual([file for file, _ in places], ["cases/flight/throw.toml"])
        self.assertEqual((self.project / places[0][0]).read_text().splitlines()[int(places[0][1]) - 1], "limit = 1e-10")
        self.assertIn("FAIL", run.summary.read_text())

    def test_what_cannot_run_fails_the_step_that_found_it(self):
        run = self.gate(cases="no-such-folder")
        self.assertTrue(run.failed)
        self.assertEqual(run.outputs["validate"]["exit-code"], "2")

    def test_the_workflow_of_the_example_gives_what_the_action_asks_for(self):
        workflow = yaml.safe_load((self.project / ".github" / "workflows" / "accuracy.yml").read_text())
        step = next(s for s in workflow["jobs"]["gate"]["steps"] if "tripoint" in s["uses"])
        self.assertLessEqual(set(step["with"]), set(Runner(self.project, {"cases": "c", "engine": "e"}).inputs))
        self.assertFalse(self.gate(**step["with"]).failed)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
