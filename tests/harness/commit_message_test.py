#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The hook on messages of commits: in a repository of its own, where git calls it.
commit_message_test.py SCRIPT"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(sys.argv.pop(1)).resolve()
ENV = {
    **{name: value for name, value in os.environ.items() if not name.startswith("GIT_")},
    "GIT_CONFIG_GLOBAL": "/dev/null",
    "GIT_CONFIG_SYSTEM": "/dev/null",
    **{
        f"GIT_{who}_{what}": value
        for who in ("AUTHOR", "COMMITTER")
        for what, value in (("NAME", "A"), ("EMAIL", "a@b"))
    },
}


class CommitMessage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.git("init", "--quiet", "--initial-branch=main")
        (self.folder / ".git/hooks/commit-msg").symlink_to(SCRIPT)

    def git(self, *words):
        return subprocess.run(
            ["git", "-c", "commit.gpgsign=false", *words], cwd=self.folder, env=ENV, capture_output=True, text=True
        )

    def commit(self, message, *words):
        """Whether the commit was made, and what was said."""
        done = self.git("commit", "--quiet", "--allow-empty", "--message", message, *words)
        return done.returncode == 0, done.stderr

    def assert_refused(self, message, why):
        made, said = self.commit(message)
        self.assertFalse(made, message)
        self.assertIn(why, said)
        self.assertIn("write one subject line, an empty line, and a body", said)

    def test_a_subject_and_a_body_pass(self):
        for message in (
            "Subject\n\nWhy.",
            "Subject\n\nWhy.\n\nSigned-off-by: A <a@b>",
            "Subject\n\n- a point",
            "Subject\n\nNote: a body may begin so.",
        ):
            self.assertEqual(self.commit(message), (True, ""), message)

    def test_a_message_without_a_body_is_refused(self):
        for message in (
            "Subject",
            "Subject\n\n",
            "Subject\n\nSigned-off-by: A <a@b>\nCo-authored-by: B <b@b>",
            "Subject\n\nFixes: #7",
        ):
            self.assert_refused(message, '"Subject" has no body')
        self.assert_refused("Merge two loops", '"Merge two loops" has no body')

    def test_the_line_below_the_subject_is_empty(self):
        self.assert_refused("Subject\nand more of it", "the line below the subject is not empty")

    def test_comments_and_the_diff_below_the_scissors_are_no_body(self):
        file = self.folder / "message"
        for text in (
            "Subject\n\n# On branch main\n",
            "Subject\n\n# ------------------------ >8 ------------------------\ndiff --git a b\n",
        ):
            file.write_text(text)
            self.assertEqual(
                subprocess.run([SCRIPT, file], cwd=self.folder, env=ENV, capture_output=True).returncode, 1, text
            )

    def test_what_ends_in_another_commit_passes(self):
        for message in ("fixup! Subject", "squash! Subject", "amend! Subject"):
            self.assertTrue(self.commit(message)[0], message)
        self.assert_refused("fixup the hook", "has no body")

    def test_a_merge_passes_in_any_words(self):
        self.commit("Root\n\nIt begins.")
        self.git("checkout", "--quiet", "-b", "side")
        self.commit("Side\n\nIt parts.")
        self.git("checkout", "--quiet", "main")
        for words in ([], ["--message", "Take the side"]):
            done = self.git("merge", "--quiet", "--no-ff", "--no-edit", *words, "side")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.git("log", "-1", "--format=%P").stdout.split()), 2)
            self.git("reset", "--quiet", "--hard", "HEAD~")
        self.assertTrue(self.commit("Merge pull request #7 from a/b")[0])

    def test_an_empty_message_is_left_to_git(self):
        self.assertIn("empty commit message", self.commit("")[1])


if __name__ == "__main__":
    unittest.main()
