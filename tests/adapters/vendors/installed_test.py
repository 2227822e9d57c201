# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint engine check` on each engine that is installed here; with none installed there is nothing to check, which
is said."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, os.environ["TRIPOINT_VENDORS"])
PROGRAM = os.environ["TRIPOINT_PROGRAM"]

from environments import catalogue  # noqa: E402


class Installed(unittest.TestCase):
    def test_each_installed_engine_holds_the_contract(self):
        listed = json.loads(
            subprocess.run(
                [PROGRAM, "engines", "--json"], capture_output=True, text=True, timeout=120, check=True
            ).stdout
        )
        here = [e for e in listed["engines"] if e["available"] and e["name"] in catalogue()["engines"]]
        print("installed:", ", ".join(f"{e['name']} {e['version']}" for e in here) or "none")
        for engine in here:
            with self.subTest(engine["name"]):
                self.assertTrue(Path(engine["library"]["path"]).is_file(), engine["library"])
                end = subprocess.run(
                    [PROGRAM, "engine", "check", engine["executable"]],
                    capture_output=True,
                    text=True,
                    timeout=300,
                    check=False,
                )
                self.assertEqual(end.returncode, 0, end.stdout)


if __name__ == "__main__":
    unittest.main()
