#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One statement a line: names each place in C++ where a comma joins two statements. No formatter parts them.

tests/architecture/statements_test.py ROOT        exit 1 where there is one
"""

import re
import sys
from pathlib import Path

ROOMS = ("src", "adapters", "validation", "program", "tests")
# What holds no statement: comments, texts, lines of the preprocessor.
BLANK = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:[^\n]|\\\n)*', re.S | re.M
)
# Innermost brackets without a statement in them; the semicolons in the head of a loop or a condition end none.
BRACKETS = re.compile(
    r"(?:(?<=for )|(?<=if )|(?<=while ))\([^(){}]*\)|\([^(){};]*\)|\[[^\[\]{};]*\]|\{[^(){};]*\}|<[\w:,\s*&#.]*>"
)
# The brace of a list of values, as against that of a block.
LISTS = re.compile(r"([\w>#({]|[,=(]\s+|\breturn )\{")
BEFORE = r"\s*(?:(?:if|for|while|else|do|constexpr)\b[\s#]*|(?:case\b[^;{}]*?|default):\s+)*(?:return\s+)?"
ACTS = r"(?:(?:\+\+|--)[^\s,]+|[\w.:*#>-]+?(?:\s*(?:[-+*/|&^%]|<<|>>)?=(?!=)[^,]*|\+\+|--|#))"
JOINED = re.compile(BEFORE + ACTS + r"\s*,")


def hidden(match):
    """A '#' for each letter, so that every line stays where it was."""
    return re.sub(r"[^\n]", "#", match.group())


def joined(text):
    """Lines of the statements that go on after a comma."""
    text, found = BLANK.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text), 1
    while found:
        text, found = BRACKETS.subn(hidden, text)
    found = 1
    while found:
        text, found = LISTS.subn(r"\1(", text)
    for piece in re.finditer(r"(?:\A|(?<=[;{}]))[^;{}()]+", text):
        if JOINED.match(piece.group()):
            start = piece.start() + len(piece.group()) - len(piece.group().lstrip())
            yield text.count("\n", 0, start) + 1


def main():
    root = Path(sys.argv[1])
    files = [f for room in ROOMS for f in sorted((root / room).rglob("*.[ch]pp"))]
    places = [f"{f.relative_to(root)}:{line}" for f in files for line in joined(f.read_text())]
    print("\n".join(places))
    print(
        f"{len(files)} files read, {len(places)} places in which a comma joins two statements: give each a line of "
        "its own"
    )
    return 1 if places or not files else 0


if __name__ == "__main__":
    sys.exit(main())
