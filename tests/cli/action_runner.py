# SPDX-License-Identifier: BSD-3-Clause
"""As much of a runner as the composite action asks of one: it reads action.yml and runs its very steps in a shell."""

import os
import re
import subprocess
from pathlib import Path

import yaml


class Runner:
    """Inputs, outputs of steps, `if`, and the files that steps write to. `environment`: what the runner says of the
    event."""

    def __init__(self, folder, workspace, inputs, environment=None):
        self.folder, self.workspace, self.environment = Path(folder), workspace, environment or {}
        self.action = yaml.safe_load((self.folder / "action.yml").read_text())
        self.inputs = {
            name: inputs.get(name, about.get("default", "")) for name, about in self.action["inputs"].items()
        }
        for name, about in self.action["inputs"].items():
            assert not about.get("required") or inputs.get(name), name
        self.outputs, self.log, self.messages, self.failed, self.summary = {}, "", "", False, workspace / "summary"

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
            environment = dict(
                os.environ,
                GITHUB_ACTION_PATH=str(self.folder),
                GITHUB_OUTPUT=str(output),
                GITHUB_STEP_SUMMARY=str(self.summary),
                GITHUB_WORKSPACE=str(self.workspace),
                GITHUB_ACTIONS="true",
                **self.environment,
                **{name: self.fill(text) for name, text in step.get("env", {}).items()},
            )
            done = subprocess.run(
                ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", self.fill(step["run"])],
                cwd=self.workspace,
                env=environment,
                capture_output=True,
                text=True,
                timeout=300,
            )
            self.log += done.stdout
            self.messages += done.stderr
            self.outputs[step.get("id", step["name"])] = dict(
                line.split("=", 1) for line in output.read_text().splitlines()
            )
            self.failed = self.failed or done.returncode != 0
        return self
