# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint releases` on two builds of one engine, of which one has gravity wrong by 1 %: worse one way, better the
other."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, ENGINE = sys.argv[1], Path(sys.argv[2])


class Releases(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)

    def build(self, version, gravity):
        source = ENGINE.read_text()
        changed = source.replace("GRAVITY_FACTOR = 1.0 ", f"GRAVITY_FACTOR = {gravity} ").replace(
            '"version": "1"', f'"version": "{version}"'
        )
        path = self.folder / version / ENGINE.name
        path.parent.mkdir()
        path.write_text(changed)
        path.chmod(0o755)
        return str(path)

    def releases(self, *versions):
        command = [
            PROGRAM,
            "releases",
            "ballistic-py",
            "--versions",
            ",".join(versions),
            "--out",
            str(self.folder / "out"),
            "rigid/ballistic",
        ]
        end = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        return end, json.loads((self.folder / "out/releases.json").read_text()) if end.returncode in (0, 1) else None

    def test_a_build_that_is_worse_ends_with_1_and_says_where(self):
        good, bad = self.build("7", "1.0"), self.build("8", "1.01")
        end, document = self.releases(good, bad)
        self.assertEqual(end.returncode, 1, end.stderr)
        self.assertIn("ballistic-py 8 in the place of 7: worse: ", end.stdout)
        self.assertTrue(document["worse"])
        position = next(c for c in document["changes"] if c["metric"] == "position")
        self.assertEqual((position["from"], position["to"], position["worse"]), ("7", "8", True))
        self.assertAlmostEqual(position["after"], 0.01 * 0.5 * 9.81, delta=1e-9)
        gates = {
            g["verdict"] for row in document["releases"][1]["rows"] for g in row["gates"] if g["metric"] == "position"
        }
        self.assertIn("fail", gates)
        page = (self.folder / "out/index.html").read_text()
        for word in ("Can I upgrade?", "ballistic-py 8", "position", "<svg"):
            self.assertIn(word, page)

        end, document = self.releases(bad, good)
        self.assertEqual(end.returncode, 0, end.stderr)
        self.assertIn("nothing is worse; better: ", end.stdout)

    def test_one_version_and_an_unknown_one_are_bad_input(self):
        self.assertEqual(self.releases(self.build("7", "1.0"))[0].returncode, 2)
        command = [
            PROGRAM,
            "releases",
            "mujoco",
            "--versions",
            "0.1,0.2",
            "rigid/ballistic",
            "--out",
            str(self.folder / "out"),
        ]
        end = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(end.returncode, 2)
        self.assertIn("4.0.0", end.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
