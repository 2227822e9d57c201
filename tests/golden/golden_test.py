# SPDX-License-Identifier: BSD-3-Clause
"""tools/golden.py names each state that has other bits, says how to store anew, and stores nothing that is not the same
at every width.   golden_test.py SOURCE"""

import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
# In place of state-hashes: two states, the second of which has other bits where the folder holds a file `changed`, or
# on more than one thread where it holds `threads`.
PROGRAM = """#!/bin/sh
here=$(dirname "$0")
echo "rigid/ball corrected 200 steps 0123456789abcdef"
last=1111111111111111
if [ -e "$here/changed" ]; then last=2222222222222222; fi
case "$*" in *"--threads 3"*) if [ -e "$here/threads" ]; then last=3333333333333333; fi ;; esac
echo "fluid/tank paper 70 steps $last"
"""


class Golden(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)
        self.program, self.stored = self.folder / "state-hashes", self.folder / "hashes.toml"
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)

    def golden(self, *words):
        done = subprocess.run(
            [SOURCE / "tools/golden.py", "--program", self.program, "--hashes", self.stored, *words],
            capture_output=True,
            text=True,
            check=False,
        )
        return done.returncode, done.stdout + done.stderr

    def store(self):
        code, said = self.golden("--store", 'a "test" of ours')
        self.assertEqual(code, 0, said)

    def test_what_was_stored_is_found_again_with_its_reason(self):
        self.store()
        stored = tomllib.loads(self.stored.read_text())
        self.assertEqual(stored["reason"], 'a "test" of ours')
        self.assertEqual(
            stored["hashes"],
            {"rigid/ball corrected": "200 steps 0123456789abcdef", "fluid/tank paper": "70 steps 1111111111111111"},
        )
        code, said = self.golden()
        self.assertIn(code, (0, 77), said)

    def test_a_state_with_other_bits_is_named_and_how_to_store_anew_is_said(self):
        self.store()
        (self.folder / "changed").touch()
        code, said = self.golden()
        if code == 77:
            self.skipTest(said)
        self.assertEqual(code, 1, said)
        self.assertIn("differs: fluid/tank paper: 70 steps 2222222222222222, should be 70 steps 1111111111111111", said)
        self.assertNotIn("differs: rigid/ball", said)
        self.assertIn("--store REASON", said)

    def test_a_state_that_is_gone_or_new_is_named(self):
        self.store()
        self.stored.write_text(self.stored.read_text().replace("fluid/tank", "fluid/pond"))
        code, said = self.golden()
        if code == 77:
            self.skipTest(said)
        self.assertEqual(code, 1, said)
        self.assertIn("fluid/pond paper: not there", said)
        self.assertIn("fluid/tank paper: 70 steps 1111111111111111, should be not there", said)

    def test_nothing_is_stored_that_differs_between_threads(self):
        (self.folder / "threads").touch()
        code, said = self.golden("--store", "a reason")
        self.assertEqual(code, 1, said)
        self.assertFalse(self.stored.exists())

    def test_no_reason_stores_nothing(self):
        code, said = self.golden("--store", " ")
        self.assertEqual(code, 2, said)
        self.assertFalse(self.stored.exists())

    def test_another_c_library_is_said_and_skipped(self):
        self.store()
        text = self.stored.read_text()
        library = tomllib.loads(text)["library"]
        self.stored.write_text(text.replace(library, "glibc 2.1"))
        code, said = self.golden()
        self.assertEqual(code, 77, said)
        self.assertIn("skipped: ", said)

    def test_what_is_stored_names_every_case(self):
        sys.path.insert(0, str(SOURCE / "tools"))
        import golden

        stored = tomllib.loads(golden.STORED.read_text())
        self.assertEqual({state.split(" ")[0] for state in stored["hashes"]}, set(golden.CASES))
        self.assertTrue(stored["reason"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
