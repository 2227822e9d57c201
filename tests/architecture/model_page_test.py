# SPDX-License-Identifier: BSD-3-Clause
"""docs/model.md names files, functions and cases that are there, and figures that the baselines hold:
model_page_test.py SOURCE."""

import re
import sys
import tomllib
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
PAGE = (ROOT / "docs/model.md").read_text()
IDENTIFIER = re.compile(r"[A-Za-z_]\w*(::[A-Za-z_]\w*)*")
FILE = re.compile(r"(?:\w+/)*(\w+)\.(?:cpp|hpp)")
PATH = re.compile(r"(src|adapters|validation|program|tests|docs|cases|reports|tools)/.*")
CASE = re.compile(r"[a-z]+(/[a-z]+)?/[a-z0-9-]+")
# `CASE`: METRIC at LEVEL VALUE (MODE), ...
FIGURE = r"(\w+)(?:\s+at\s+([0-9.e-]+))?\s+([0-9.e+-]+|round-off)\s+\((paper|corrected)\)"
FIGURES = re.compile(rf"`([a-z]+/[a-z0-9-]+)`:((?:,?\s+{FIGURE})+)")

FILES = [file for room in ("src", "adapters", "validation", "program", "tests") for file in (ROOT / room).rglob("*")]
NAMES = {file.name for file in FILES}
STEMS = {}  # text of a header and its source together, by the name without its ending
for file in FILES:
    if file.suffix in (".cpp", ".hpp"):
        STEMS[file.stem] = STEMS.get(file.stem, "") + file.read_text()
CODE = "".join(STEMS.values())


def quoted_words(text):
    """Words in single back-quotes, outside code blocks."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"`([^`\n]+)`", re.sub(r"^    .*$", "", text, flags=re.MULTILINE))


def is_there(word):
    if PATH.fullmatch(word):
        return (ROOT / word).exists()
    if CASE.fullmatch(word):
        return (ROOT / "cases" / f"{word}.toml").exists()
    if re.fullmatch(r"\w+\.(cpp|hpp)", word):
        return word in NAMES
    return not IDENTIFIER.fullmatch(word) or word.rpartition(":")[2] in CODE


def strayed(bullet):
    """Of "`f`, `g`, `src/a/b.cpp`": (name, file, whether the name stands in b.cpp or b.hpp)."""
    waiting = []
    for word in quoted_words(bullet):
        if file := FILE.fullmatch(word):
            yield from ((name, word, name in STEMS.get(file[1], "")) for name in waiting)
            waiting = []
        elif IDENTIFIER.fullmatch(word):
            waiting.append(word.rpartition(":")[2])


def accepted(case, metric, level, mode):
    """Values of a metric of our solver in the baseline of a case; at one level, where one is said. Two gates may judge
    one value."""
    gates = tomllib.loads((ROOT / "baselines" / f"{case}.toml").read_text())["gate"]
    return {
        gate["value"]
        for gate in gates
        if (gate.get("metric"), gate.get("engine"), gate.get("mode")) == (metric, "tripoint", mode)
        and (not level or abs(gate.get("level", 0.0) / float(level) - 1.0) < 1e-9)
    }


def agree(said, value):
    if said == "round-off":
        return abs(value) < 1e-9
    return abs(float(said) - value) <= 0.1 * abs(float(said)) + 1e-12


class ModelPage(unittest.TestCase):
    def test_its_figures_are_those_of_the_baselines(self):
        figures = [(m[1], *figure) for m in FIGURES.finditer(PAGE) for figure in re.findall(FIGURE, m[2])]
        self.assertGreater(len(figures), 25)
        for case, metric, level, said, mode in figures:
            with self.subTest(case, metric=metric, mode=mode):
                values = accepted(case, metric, level, mode)
                self.assertEqual(len(values), 1, "say the level, or a metric that a gate judges")
                self.assertTrue(agree(said, *values), f"the page says {said}, the baseline {values}")

    def test_figures_agree_within_a_tenth(self):
        same = [("0.5", 0.52), ("round-off", 1e-13), ("0", 0.0)]
        other = [("0.5", 0.56), ("round-off", 1e-6), ("-0.5", 0.5)]
        self.assertEqual([agree(*pair) for pair in same + other], [True] * 3 + [False] * 3)

    def test_each_function_stands_in_the_file_that_is_named_with_it(self):
        found = [row for bullet in re.findall(r"\*\*Code\.\*\*([^*]*)", PAGE) for row in strayed(bullet)]
        self.assertGreater(len(found), 30)
        self.assertEqual([f"{name} in {file}" for name, file, stands in found if not stands], [])
        elsewhere = "`pressure_paper`, `src/effects/pressure/pressure.cpp`"  # it stands in equation_of_state.hpp
        self.assertEqual([stands for *_, stands in strayed(elsewhere)], [False])

    def test_every_name_is_code_a_file_or_a_case(self):
        words = quoted_words(PAGE)
        self.assertGreater(len(words), 200)
        self.assertEqual([word for word in words if not is_there(word)], [])
        self.assertFalse(is_there("neither_code_nor_file") or is_there("src/none.cpp") or is_there("fluid/none"))


if __name__ == "__main__":
    unittest.main()
