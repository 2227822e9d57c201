# SPDX-License-Identifier: BSD-3-Clause
"""No function of Python takes more than 15 decisions: decisions_test.py SOURCE.

ruff's complexity counts statements alone. Here comprehensions, `and`, `or`, `x if y else z` and lambdas count too."""

import ast
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
MOST = 15
ONE = (ast.If, ast.IfExp, ast.For, ast.While, ast.ExceptHandler, ast.Assert, ast.Lambda, ast.match_case)


def weight(node):
    if isinstance(node, ast.BoolOp):
        return len(node.values) - 1
    if isinstance(node, ast.comprehension):
        return 1 + len(node.ifs)
    return int(isinstance(node, ONE))


def decisions(node):
    """Of a function without those that are defined in it: each of them is counted alone."""
    below = [child for child in ast.iter_child_nodes(node) if not isinstance(child, ast.FunctionDef)]
    return 1 + sum(map(weight, below)) + sum(decisions(child) - 1 for child in below)


def complex_functions(name, text):
    """What each function says that takes too many decisions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef) and decisions(node) > MOST:
            yield f"{name}:{node.lineno}: {node.name} takes {decisions(node)} decisions, at most {MOST}: split it"


def is_python(path):
    return path.suffix == ".py" or not path.suffix and b"python" in path.read_bytes().partition(b"\n")[0]


class Tree(unittest.TestCase):
    def test_every_function_is_simple(self):
        names = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True, check=True).stdout
        files = [SOURCE / name for name in names.splitlines() if (SOURCE / name).is_file()]
        files = [path for path in files if is_python(path)]
        found = [line for path in files for line in complex_functions(path.relative_to(SOURCE), path.read_text())]
        self.assertEqual(found, [], "\n" + "\n".join(found))
        self.assertGreater(len(files), 100)


class Planted(unittest.TestCase):
    def test_what_ruff_does_not_count_is_named(self):
        for body in (
            "return " + " and ".join(f"x != {n}" for n in range(16)),
            "return [y for y in x " + " ".join(f"if y != {n}" for n in range(14)) + "]",
            "return " + "".join(f"{n} if x == {n} else " for n in range(15)) + "x",
        ):
            [said] = complex_functions("planted.py", f"def f(x):\n    {body}\n")
            self.assertTrue(said.startswith("planted.py:1: f takes 16 decisions"), said)

    def test_fifteen_are_allowed(self):
        body = " and ".join(f"x != {n}" for n in range(15))
        self.assertEqual(list(complex_functions("planted.py", f"def f(x):\n    return {body}\n")), [])


if __name__ == "__main__":
    unittest.main()
