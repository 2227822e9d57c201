#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the pages are plain English: those at the top, in docs and in examples, and the texts of commands.

    tools/prose.py             fails where a file has more findings than tools/prose-allowance.txt allows
    tools/prose.py FILE...     prints every finding of these files, without an allowance
    tools/prose.py --write     lowers the allowances to today's counts; none is ever raised

Rules: a sentence has at most 25 words, a table cell at most 30, a decision at most 200, and no banned construction.
"""

import argparse
import re
import sys
from pathlib import Path
from typing import Iterator, NamedTuple

SENTENCE, CELL, DECISION = 25, 30, 200  # words at most
ROOMS = ("docs", "examples")
ALLOWANCE = "tools/prose-allowance.txt"

# A construction that needs a second reading, and the advice that goes with it.
BANNED = [
    (r"\bno\b[^.;:]*\bnor\b", "say each part of 'no ... nor' in a sentence of its own"),
    (r"^(\*\*)?What\b[^?]*$", "begin with the noun, not with 'What'"),
    (r"\b(of|from|by|than|with|beside|over|under) what\b", "put a noun in place of 'what'"),
    (r"^(So|As) (is|are|does|do|must|was|were)\b", "begin with the subject, then the verb"),
    (r"\bthat which\b", "put a noun in place of 'that which'"),
    (r"\bkeepers?\b", "write 'subscriber'"),
    (r"\bstrangers?\b", "write 'third party'"),
    (r"\blaid walls?\b", "write 'lattice wall'"),
    (r"\bown pairs?\b", "write 'excluded pair'"),
    (r"\bslack\b", "write 'headroom' or 'loose'"),
    (r"\bseams?\b", "write 'periodic boundary'"),
]
BANNED = [(re.compile(pattern), advice) for pattern, advice in BANNED]

# A full stop after these does not end a sentence, nor does that of a bold title.
ABBREVIATIONS = (
    r"(?<!\be\.g)(?<!\bi\.e)(?<!\bal)(?<!\bFig)(?<!\bEq)(?<!\bNo)(?<!\bvs)(?<!\bcf)(?<!\bca)(?<!\bSec)(?<!\b[A-Z])"
)
END = re.compile(ABBREVIATIONS + r"[.!?](?!\*\*)[)\"*_]*\s+(?=[\"'(*_\[]*[A-Z0-9`])")


class Finding(NamedTuple):
    path: str
    line: int
    text: str
    advice: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.text}\n    {self.advice}"


class Block(NamedTuple):
    """A paragraph, an item of a list, a heading or a cell of a table."""

    line: int
    text: str
    cell: bool = False


def visible(line: str) -> str:
    """The line as a reader sees it: a link is its text."""
    line = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", line)
    line = re.sub(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)]*\)", r"\1", line)
    return re.sub(r"<[^>]*>", "", line)


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|(?=(?:[^`]*`[^`]*`)*[^`]*$)", line.strip().strip("|"))]


def prose_lines(text: str) -> Iterator[tuple[int, str]]:
    """Numbered lines without fenced code, indented code and comments."""
    fence, comment, blank = "", False, True
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and (not fence or mark[1].startswith(fence)):
            fence = "" if fence else mark[1]
            line = ""
        comment = comment or line.lstrip().startswith("<!--")
        hidden = fence or comment or (blank and re.match(r"    |\t", line))
        comment = comment and "-->" not in line
        blank = not line.strip() or (blank and bool(hidden))
        yield number, "" if hidden else line


def blocks(text: str) -> Iterator[Block]:
    start, words, heading = 0, "", False
    for number, line in prose_lines(text):
        if line.lstrip().startswith("|"):
            if words:
                yield Block(start, words)
            words = ""
            for cell in cells(visible(line)):
                yield Block(number, cell, cell=True)
            continue
        item = re.match(r"\s*(?:[-*+>]|\d+\.|#+)\s+", line)
        if words and (item or heading or not line.strip()):
            yield Block(start, words)
            words = ""
        heading = line.startswith("#")
        start = start if words else number
        words += ("\n" if words else "") + line[item.end() if item else 0 :]
    if words:
        yield Block(start, words)


def sentences(block: Block) -> Iterator[tuple[int, str]]:
    """The sentences of a block, each with the line that it begins on."""
    text, begin = visible(block.text), 0
    for end in [match.end() for match in END.finditer(text)] + [len(text)]:
        yield block.line + text.count("\n", 0, begin), " ".join(text[begin:end].split())
        begin = end


def count(text: str) -> int:
    """Words as they are read: each word of code and each sign of a formula is one."""
    return len(text.split())


def findings(path: str, text: str) -> list[Finding]:
    found = []
    if "decisions/" in path and len(text.split()) > DECISION:
        advice = f"{len(text.split())} words: a decision has at most {DECISION}; measurements go to the case"
        found.append(Finding(path, 1, text.splitlines()[0], advice))
    for block in blocks(text):
        if block.cell and count(block.text) > CELL:
            advice = f"{count(block.text)} words: a cell has at most {CELL}; move the rest below the table"
            found.append(Finding(path, block.line, block.text, advice))
        for line, sentence in sentences(block):
            if count(sentence) > SENTENCE:
                advice = f"{count(sentence)} words: split it, a sentence has at most {SENTENCE}"
                found.append(Finding(path, line, sentence, advice))
            words = re.sub(r"`+[^`]*`+", "`code`", sentence)
            found += [Finding(path, line, sentence, advice) for rule, advice in BANNED if rule.search(words)]
    return found


def pages(root: Path) -> list[str]:
    """All pages but REFERENCES.md, which is a table of citations."""
    paths = [*root.glob("*.md"), *(path for room in ROOMS for path in (root / room).rglob("*.md"))]
    return sorted(str(path.relative_to(root)) for path in paths if path.name != "REFERENCES.md")


def allowed(root: Path) -> dict[str, int]:
    rows = [line.split() for line in (root / ALLOWANCE).read_text().splitlines() if line and line[0] != "#"]
    return {path: int(number) for number, path in rows}


def write(root: Path, found: dict[str, list[Finding]]) -> None:
    old = allowed(root) if (root / ALLOWANCE).exists() else None
    counts = {path: len(rows) if old is None else min(len(rows), old.get(path, 0)) for path, rows in found.items()}
    head = "# Findings of tools/prose.py that a page may still have. Numbers only fall: tools/prose.py --write\n"
    (root / ALLOWANCE).write_text(head + "".join(f"{n:4} {path}\n" for path, n in counts.items() if n))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", help="pages whose findings to print")
    parser.add_argument("--write", action="store_true", help="lower the allowances to today's counts")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent, help="the checkout")
    arguments = parser.parse_args()
    if arguments.files:
        rows = [row for path in arguments.files for row in findings(path, Path(path).read_text())]
        print(*rows, f"{len(rows)} findings", sep="\n")
        return 0
    found = {path: findings(path, (arguments.root / path).read_text()) for path in pages(arguments.root)}
    if arguments.write:
        write(arguments.root, found)
    allowances = allowed(arguments.root)
    over = {path: rows for path, rows in found.items() if len(rows) > allowances.get(path, 0)}
    for path, rows in over.items():
        print(*rows, f"{path}: {len(rows)} findings, {allowances.get(path, 0)} allowed; shorten any of these", sep="\n")
    total = sum(map(len, found.values()))
    print(f"prose: {total} findings in {len(found)} pages, {sum(allowances.values())} allowed")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
