# SPDX-License-Identifier: BSD-3-Clause
"""The drawing of defects: what it makes of a line, that a seed repeats, and that it leaves the tree it belongs to
alone.   draw_mutants_test.py SCRIPT"""

import importlib.util
import pathlib
import random
import subprocess
import sys
import unittest

SCRIPT = pathlib.Path(sys.argv.pop(1)).resolve()
spec = importlib.util.spec_from_file_location("draw_mutants", SCRIPT)
mutants = importlib.util.module_from_spec(spec)
spec.loader.exec_module(mutants)


class DrawMutants(unittest.TestCase):
    def test_makes_each_kind_of_change_of_a_line(self):
        made = mutants.changes_of("  sum += 0.5 * a;")
        for change in (
            ("operator", "  sum += 0.5 / a;"),
            ("operator", "  sum -= 0.5 * a;"),
            ("sign", "  sum += -(0.5 * a);"),
            ("factor", "  sum += 1.02 * (0.5 * a);"),
            ("factor", "  sum += (1.02 * 0.5) * a;"),
            ("dropped", "  ;"),
        ):
            self.assertIn(change, made)

    def test_leaves_text_and_includes_alone(self):
        for line in ("// a + b", '  throw InputError("a + b");', "#include <a>", ""):
            self.assertEqual(mutants.changes_of(line), [], line)

    def test_draws_the_same_for_a_seed_and_something_else_for_another(self):
        tree = SCRIPT.parent.parent
        drawn = [
            [mutants.draw(rng, tree) for _ in range(30)]
            for rng in (random.Random(7), random.Random(7), random.Random(8))
        ]
        self.assertEqual(drawn[0], drawn[1])
        self.assertNotEqual(drawn[0], drawn[2])
        for m in drawn[0]:
            self.assertNotEqual(m["old"], m["new"])
            self.assertIn(m["old"], (tree / m["file"]).read_text().split("\n")[m["line"] - 1])

    def test_refuses_the_tree_that_it_belongs_to(self):
        done = subprocess.run(
            [sys.executable, "-B", str(SCRIPT), "--tree", str(SCRIPT.parent.parent), "--seed", "1"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 1)
        self.assertIn("give a copy", done.stderr)


if __name__ == "__main__":
    unittest.main()
