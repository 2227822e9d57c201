# SPDX-License-Identifier: BSD-3-Clause
"""One way to say a thing: earlier spellings work, name the present one on stderr, and are in no --help; a group called
alone lists its commands: spellings_test.py TRIPOINT SOURCE."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT, SOURCE = (Path(argument).resolve() for argument in (sys.argv.pop(1), sys.argv.pop(1)))
FAKE = SOURCE / "tests/harness/fake/engine.py"


class Spellings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        engine = self.path / "engine-fake"
        engine.write_text(f"#!/bin/sh\nexec /usr/bin/python3 '{FAKE}' \"$@\"\n")
        engine.chmod(0o755)

    def call(self, *words):
        return subprocess.run([TRIPOINT, *words], cwd=self.path, capture_output=True, text=True, timeout=120)

    def commands(self):
        """Every command that a --help lists, as words."""
        for name in self.listed():
            yield (name,)
            yield from ((name, below) for below in self.listed(name))

    def listed(self, *words):
        _, _, below = self.call(*words, "--help").stdout.partition("\nSubcommands:\n")
        return re.findall(r"^  ([a-z]+)", below, re.MULTILINE)

    def engines_of(self, *words):
        """The engines of a suite that is planned with these words, and what is said on stderr."""
        done = self.call("suite", "make", "suite", "rigid/ballistic", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return set(re.findall(r'"engine": "(\w+)"', (self.path / "suite/suite.json").read_text())), done.stderr

    def test_earlier_spellings_name_the_present_one(self):
        for words, now in (
            (("export", "none", "--csv"), "--csv is now --to csv"),
            (("render", "none", "--frame", "0"), "--frame N is now --frames N"),
            (("render", "none", "--surface"), "--surface is now the default"),
            (("plan", "none", "--within", "1%"), "--within X is now --error X"),
            (("suite", "status", "none"), "tripoint suite status is now tripoint status"),
            (("suite", "merge", "none", "--out", "x"), "tripoint suite merge is now tripoint merge"),
        ):
            with self.subTest(words):
                done = self.call(*words)
                self.assertIn(f"tripoint: note: {now}\n", done.stderr)
                self.assertEqual(done.returncode, 2, done.stderr)  # nothing is called `none`

    def test_engines_restricts_and_with_all_it_adds(self):
        one, _ = self.engines_of("--engines", "exact")
        self.assertEqual(one, {"exact"})
        mine, said = self.engines_of("--engines", "./engine-fake,exact")
        self.assertEqual((mine, "note:" in said), ({"fake", "exact"}, False))
        every, _ = self.engines_of()
        more, _ = self.engines_of("--engines", "all,./engine-fake")
        self.assertEqual(more, every | {"fake"})
        earlier, said = self.engines_of("--engine", "./engine-fake")
        self.assertEqual(earlier, more)
        self.assertIn("--engine X is now --engines all,X", said)
        both, _ = self.engines_of("--engine", "./engine-fake", "--engines", "exact")
        self.assertEqual(both, mine)

    def test_engine_list_lists_the_engines(self):
        done = self.call("engine", "list")
        self.assertEqual((done.returncode, done.stdout), (0, self.call("engines").stdout))

    def test_a_group_called_alone_lists_its_commands(self):
        groups = [words for words in self.commands() if self.listed(*words)]
        self.assertEqual(groups, [("suite",), ("gate",), ("engine",)])
        for group in groups:
            done = self.call(*group)
            self.assertEqual(done.returncode, 2)
            for below in self.listed(*group):
                self.assertRegex(done.stderr, rf"\n  {group[0]} {below}  [A-Z]")

    def test_no_help_has_two_lists_of_exit_codes_or_an_earlier_spelling(self):
        for words in self.commands():
            text = self.call(*words, "--help").stdout
            self.assertEqual(len(re.findall(r"^Exit\b", text, re.MULTILINE)), 1, words)
            self.assertNotRegex(text, r"(?m)^  --(csv|latex|frame|surface|within)\b")


if __name__ == "__main__":
    unittest.main()
