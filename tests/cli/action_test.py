# SPDX-License-Identifier: BSD-3-Clause
"""The composite action's own steps, run in a shell as a runner would, on the example of another project: action_test.py
TRIPOINT SOURCE."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

from action_runner import Runner

TRIPOINT, SOURCE = sys.argv[1], Path(sys.argv[2])
BWRAP = "/usr/bin/bwrap"
ACTION = SOURCE / ".github" / "actions" / "gate"


class Action(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint action ü ")
        self.project = Path(self.folder.name) / "project"
        shutil.copytree(SOURCE / "examples" / "gated-engine", self.project)

    def tearDown(self):
        self.folder.cleanup()

    def gate(self, **inputs):
        return Runner(
            ACTION,
            self.project,
            {"tripoint": TRIPOINT, "cases": "cases", "engine": "./engine-verlet", "engines": "verlet"} | inputs,
        ).run()

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

    def test_an_engine_in_the_sandbox_is_judged_as_outside_and_reaches_no_result(self):
        words = [BWRAP, "--unshare-all", "--unshare-user", "--ro-bind", "/", "/", "/bin/true"]
        if not os.path.exists(BWRAP) or subprocess.run(words, capture_output=True, check=False).returncode != 0:
            self.skipTest("no bubblewrap here, or it may make no namespaces")
        engine, reached = self.project / "engine-verlet", self.project / "output-of-a-step"
        deed = (
            f"    try:\n        open({str(reached)!r}, 'w').write('exit-code=0')\n    except OSError:\n        pass\n"
        )
        main = 'def main(verb, path=""):\n'
        text = engine.read_text()
        self.assertIn(main, text)
        engine.write_text(text.replace(main, main + deed))
        for sandbox in ("false", "true"):
            run = self.gate(sandbox=sandbox)
            self.assertFalse(run.failed, run.log + run.messages)
            self.assertEqual(run.outputs["gate"]["exit-code"], "0")
            self.assertEqual(reached.exists(), sandbox == "false")
            reached.unlink(missing_ok=True)

    def test_a_word_that_is_no_answer_to_sandbox_runs_nothing(self):
        run = self.gate(sandbox="yes")
        self.assertTrue(run.failed)
        self.assertIn("::error::sandbox is true or false", run.log)
        self.assertFalse((self.project / "report").exists())

    def test_the_workflow_of_the_example_gives_what_the_action_asks_for(self):
        workflow = yaml.safe_load((self.project / ".github" / "workflows" / "accuracy.yml").read_text())
        step = next(s for s in workflow["jobs"]["gate"]["steps"] if "tripoint" in s.get("uses", ""))
        self.assertLessEqual(set(step["with"]), set(Runner(ACTION, self.project, {"cases": "c", "engine": "e"}).inputs))
        given = {name: text for name, text in step["with"].items() if "${{" not in text}
        self.assertFalse(self.gate(**given).failed)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
