#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The broken copies of the self-test: each defect reaches its copy, every true source is free of them, and a table that
is wrong is refused by name. break_sources_test.py SCRIPT ENGINE"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT, ENGINE = Path(sys.argv.pop(1)), Path(sys.argv.pop(1))
ROOT = SCRIPT.resolve().parent.parent
SOLVER = [ROOT / "src", ROOT / "adapters"]
TABLE = """[[defect]]
name = "a.b"
what = "one more"
case = "x/y"
[[change]]
file = "f.cpp"
text = 'return 1;'
broken = 'return 1 + defect<"a.b">();'
"""


def call(*words):
    return subprocess.run([SCRIPT, *map(str, words)], capture_output=True, text=True)


class BreakSources(unittest.TestCase):
    def folder(self, table, source="#include <cmath>\nint f() {\n  return\n    1;\n}\n"):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = Path(folder.name)
        (root / "defects.toml").write_text(table)
        (root / "f.cpp").write_text(source)
        return root

    def test_writes_the_broken_text_however_lines_are_broken(self):
        root = self.folder(TABLE)
        self.assertEqual(call("--list", root).stdout, "f.cpp\n")
        self.assertEqual(call("--write", "f.cpp", "--to", root / "out.cpp", root).returncode, 0)
        self.assertEqual(
            (root / "out.cpp").read_text(),
            '#include "core/defect.hpp"\n#include <cmath>\nint f() {\n  return 1 + defect<"a.b">();\n}\n',
        )

    def test_refuses_a_wrong_table_by_name(self):
        for change, word in (
            ((TABLE.replace("return 1;", "return 2;")), "stands 0 times"),
            (TABLE.replace('<"a.b">', '<"a.c">'), "a.c"),
            (TABLE.replace("what", "wat"), "what"),
            (TABLE + TABLE[TABLE.index("[[change]]") :], "overlap"),
            (TABLE[: TABLE.index("[[change]]")], "no [[change]]"),
            (TABLE + "[more]\n", "more"),
        ):
            root = self.folder(change)
            done = call("--write", "f.cpp", "--to", root / "out.cpp", root)
            self.assertEqual(done.returncode, 2, change)
            self.assertIn(word, done.stderr)
            self.assertIn("defects.toml", done.stderr)

    def test_every_defect_of_the_solver_reaches_a_copy(self):
        with tempfile.TemporaryDirectory() as out:
            text = ""
            for root in SOLVER:
                files = call("--list", root).stdout.split()
                self.assertTrue(files)
                for file in files:
                    done = call("--write", file, "--to", f"{out}/{file}", root)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    text += Path(out, file).read_text()
            self.assertEqual(call("--register", f"{out}/all.cpp", *SOLVER).returncode, 0)
            rows = [
                json.loads(f"[{row}]") for row in re.findall(r"^ {6}\{(.*)\},$", Path(out, "all.cpp").read_text(), re.M)
            ]
            self.assertGreater(len(rows), 80)
            for name, what, case in rows:
                self.assertIn(f'defect<"{name}">', text)
                self.assertTrue(what)
                self.assertTrue((ROOT / "cases" / f"{case}.toml").exists(), case)

    def test_no_source_and_no_program_that_is_shipped_knows_a_defect(self):
        for root in SOLVER:
            for path in [*root.rglob("*.cpp"), *root.rglob("*.hpp")]:
                if path.name != "defect.hpp":
                    self.assertNotRegex(path.read_text(), r'defect(_size)?\(|defect<"', path)
        names = [
            d["name"]
            for root in SOLVER
            for table in root.rglob("defects.toml")
            for d in __import__("tomllib").loads(table.read_text()).get("defect", [])
        ]
        program = ENGINE.read_bytes()
        self.assertGreater(len(names), 80)
        self.assertEqual([name for name in names if name.encode() + b"\0" in program], [])
        self.assertNotIn(b"TRIPOINT_DEFECT", program)
        symbols = subprocess.run(
            ["nm", "-C", "--defined-only", ENGINE], capture_output=True, text=True, check=True
        ).stdout
        self.assertIn("tripoint::Simulation::step", symbols)
        self.assertEqual([s for s in symbols.split("\n") if re.search(r"\bdefect(_size)?\b|registered_defects", s)], [])


if __name__ == "__main__":
    unittest.main()
