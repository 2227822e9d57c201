# SPDX-License-Identifier: BSD-3-Clause
"""Python has the form and the limits of ruff.toml, and ruff sees what has not: ruff_test.py SOURCE."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
RUFF = SOURCE / ".venv-lint/bin/ruff"

BRANCHY = "def choose(x):\n" + "".join(f"    if x == {n}:\n        return {n}\n" for n in range(15)) + "    return x\n"
PLANTED = {
    "C901": BRANCHY,  # a complexity of 16
    "E501": f"A = {'x' * 120!r}\n",
    "F401": "import os\n",
    "PLR0915": "def f(x):\n" + "    x += 1\n" * 51,  # a function of 51 statements
    "F841": "def f():\n    unused = 1\n",
}


def ruff(*words, text=None):
    return subprocess.run([RUFF, *words], cwd=SOURCE, input=text, capture_output=True, text=True)


class Tree(unittest.TestCase):
    def test_every_file_has_its_form(self):
        answer = ruff("format", "--check")
        self.assertEqual(answer.returncode, 0, answer.stdout + ".venv-lint/bin/ruff format writes it\n")

    def test_every_file_keeps_the_limits(self):
        answer = ruff("check")
        self.assertEqual(answer.returncode, 0, answer.stdout)

    def test_programs_without_a_suffix_are_checked_too(self):
        names = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True, check=True).stdout
        plain = [SOURCE / name for name in names.splitlines() if not Path(name).suffix and (SOURCE / name).is_file()]
        programs = {str(path) for path in plain if b"python" in path.read_bytes().partition(b"\n")[0]}
        self.assertGreater(len(programs), 10)
        self.assertEqual(programs - set(ruff("check", "--show-files").stdout.splitlines()), set())


class Planted(unittest.TestCase):
    def test_each_fault_is_named(self):
        for rule, text in PLANTED.items():
            with self.subTest(rule):
                answer = ruff("check", "--stdin-filename", "tools/planted.py", "-", text=text)
                self.assertEqual(answer.returncode, 1)
                self.assertIn(rule, answer.stdout)


if __name__ == "__main__":
    if not RUFF.exists():
        print("no ruff: tools/setup.sh test installs it into .venv-lint")
        sys.exit(1 if os.environ.get("CI") else 77)  # a CI that did not look says so
    unittest.main()
