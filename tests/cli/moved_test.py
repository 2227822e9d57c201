# SPDX-License-Identifier: BSD-3-Clause
"""A checkout that was copied or moved with its build finds its own cases, not those of the place where it was built."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, ROOT = (Path(word).resolve() for word in sys.argv[1:])
BUILD = PROGRAM.parent.parent


class MovedCheckout(unittest.TestCase):
    def test_reads_its_own_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder, "copy")
            for room in ("cases", "reports"):
                shutil.copytree(ROOT / room, copy / room)
            for room in ("bin", "share"):
                shutil.copytree(BUILD / room, copy / BUILD.relative_to(ROOT) / room, symlinks=True)
            case = copy / "cases/rigid/ballistic.toml"
            lines = case.read_text().splitlines()
            case.write_text(
                "\n".join('title = "Of the copy"' if line.startswith("title") else line for line in lines) + "\n"
            )
            said = subprocess.run(
                [copy / BUILD.relative_to(ROOT) / "bin/tripoint", "list", "rigid/ballistic"],
                capture_output=True,
                text=True,
                cwd=folder,
                check=False,
            )
            self.assertIn("Of the copy", said.stdout, said.stderr)

    def test_no_launcher_names_the_place_of_its_build(self):
        scripts = [p for p in (BUILD / "libexec/tripoint").glob("engine-*") if p.read_bytes().startswith(b"#!")]
        self.assertTrue(scripts)
        for launcher in scripts:
            self.assertNotIn(str(ROOT), launcher.read_text(), launcher.name)


if __name__ == "__main__":
    if not BUILD.is_relative_to(ROOT):
        print("skipped: the build folder lies outside the checkout")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
