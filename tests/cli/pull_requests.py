# SPDX-License-Identifier: BSD-3-Clause
"""Plays pull requests through the action's own steps, in a git repository of its own:

pull_requests.py TRIPOINT                    prints the comments
pull_requests.py TRIPOINT --write docs/ci.md puts them into the page, between its marks (make pages)
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from action_runner import Runner

SOURCE = Path(__file__).resolve().parents[2]
ACTION = SOURCE / ".github" / "actions" / "gate"
PROJECT = Path(__file__).resolve().parent / "pull_requests"

# What each one changes in the engine: (file, text, new text).
CHANGES = {
    "shorter-steps": [("engine-glide", "STEP = 1e-3 ", "STEP = 5e-4 ")],
    "longer-steps": [
        ("engine-glide", "STEP = 1e-3 ", "STEP = 1.15e-3 "),
        ("engine-glide", 'GAUGE = "a"', 'GAUGE = "b"'),
    ],
    "too-long-steps": [("engine-glide", "STEP = 1e-3 ", "STEP = 2e-3 ")],
}


class Repository:
    """A project with an engine and a case, its branches, and what the action left on `main`."""

    def __init__(self, folder, tripoint):
        self.folder, self.tripoint = Path(folder), str(Path(tripoint).resolve())
        shutil.copytree(PROJECT, self.folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__"))
        self.git("init", "--quiet", "--initial-branch=main")
        self.commit("An engine and what it must hold")
        self.results = self.folder.parent / "main-results.json"  # what a cache keeps
        run = self.action("main")
        assert not run.failed, run.log + run.messages
        shutil.copy(self.folder / "report" / "results.json", self.results)

    def git(self, *words):
        # Names and dates are fixed, so that a commit has the same name in every run.
        fixed = {
            f"GIT_{who}_{what}": value
            for who in ("AUTHOR", "COMMITTER")
            for what, value in (("NAME", "A"), ("EMAIL", "a@b"), ("DATE", "2026-01-01T00:00:00Z"))
        }
        done = subprocess.run(
            ["git", "-c", "core.hooksPath=/dev/null", "-c", "commit.gpgsign=false", *words],
            cwd=self.folder,
            env={**os.environ, **fixed, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null"},
            check=True,
            capture_output=True,
            text=True,
        )
        return done.stdout.strip()

    def commit(self, message):
        self.git("add", "engine-glide", "cases")
        if (self.folder / "baselines").is_dir():
            self.git("add", "baselines")
        self.git("commit", "--quiet", "--message", message)

    def branch(self, name, changes):
        """A branch off main with these changes, checked out."""
        self.git("checkout", "--quiet", "--force", "main")
        self.git("checkout", "--quiet", "-B", name)
        for file, text, new in changes:
            path = self.folder / file
            assert text in path.read_text(), text
            path.write_text(path.read_text().replace(text, new))
        self.commit(name)

    def action(self, head, base="", **inputs):
        """The action on what is checked out; with a base it is compared with what main left."""
        shutil.rmtree(self.folder / "report", ignore_errors=True)
        event = {
            "GITHUB_SERVER_URL": "https://github.com",
            "GITHUB_REPOSITORY": "OWNER/project",
            "GITHUB_SHA": self.git("rev-parse", "HEAD"),
        }
        given = {
            "tripoint": self.tripoint,
            "cases": "cases",
            "engine": "./engine-glide",
            "engines": "glide",
            "head": head,
            "base": base,
            "against": str(self.results) if base else "",
        }
        return Runner(ACTION, self.folder, given | inputs, event).run()

    def pull_request(self, name, **inputs):
        """@return (run of the action, text of the comment)"""
        self.branch(name, CHANGES[name])
        run = self.action(name, "main", **inputs)
        comment = self.folder / run.outputs["comment"]["comment"]
        return run, comment.read_text()


def comments(tripoint, names=("shorter-steps", "longer-steps")):
    with tempfile.TemporaryDirectory(prefix="tripoint-pull-requests-") as folder:
        repository = Repository(Path(folder) / "project", tripoint)
        return {name: repository.pull_request(name)[1] for name in names}


def with_comments(page, texts):
    """The page with each comment between <!-- begin NAME --> and <!-- end NAME -->."""
    for name, text in texts.items():
        block = f"<!-- begin {name} -->\n```markdown\n{text.rstrip()}\n```\n<!-- end {name} -->"
        page, count = re.subn(
            rf"<!-- begin {re.escape(name)} -->.*?<!-- end {re.escape(name)} -->", lambda _: block, page, flags=re.S
        )
        assert count == 1, name
    return page


if __name__ == "__main__":
    made = comments(sys.argv[1])
    if sys.argv[2:3] == ["--write"]:
        target = Path(sys.argv[3])
        target.write_text(with_comments(target.read_text(), made))
    else:
        for each in made.values():
            print(each)
