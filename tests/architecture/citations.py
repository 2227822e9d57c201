# SPDX-License-Identifier: BSD-3-Clause
"""Citations in comments, messages and pages: of an equation of the paper, of a section of docs/model.md, of a decision,
of a source."""

import re
from typing import Iterator, NamedTuple

YEAR = r"(?:1[89]|20)\d\d"
TOKEN = re.compile(
    r"//[/!<]*(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/"
    r'|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?P<text>(?:\\.|[^"\\\n])*)"'
    r"|(?<![0-9A-Za-z])'(?:\\.|[^'\\\n])+'",
    re.DOTALL,
)
# [Author year, detail]: the numbers in it are those of the source.
SOURCE = re.compile(rf"\[([A-Z][^\[\]]*?\s{YEAR})(?:[,;][^\[\]]*)?\]")
# Author year without brackets, in messages and on pages.
LOOSE = re.compile(
    r"(?:^|[^\w'])([A-Z][a-z'][A-Za-z']*(?:(?:, | & | and )[A-Z][A-Za-z']+)*(?: et al\.)?)" + rf" ({YEAR})(?![\d-])",
    re.MULTILINE,
)
MONTH = re.compile(r"Jan|Feb|Mar|Apr|May|June?|July?|Aug|Sep|Oct|Nov|Dec")
SECTIONS = re.compile(r"\bmodel\s+\d+(?:\.\d+)?(?:(?:,\s*|-|\s+and\s+)\d+\.\d+)*")  # model 2, 8.7
SECTION = re.compile(r"(?<!\w)\((8\.\d+)\)")
EQUATIONS = re.compile(r"(?:^|[^\w)\]>])\((\d{1,2})\)(?:\s*(?:-|to)\s*\((\d{1,2})\))?", re.MULTILINE)  # (7), (7)-(9)
NUMBERED = ((re.compile(r"\bdecisions?\s+(\d+)\b"), "decision"), (re.compile(r"\bFig\.\s+(\d+)"), "fig"))


class Citation(NamedTuple):
    path: str
    line: int
    target: str  # "eq-7", "8-4", "7", "fig-5", "decision-6" or "source Wendland 1995"


def prose_of(path: str, text: str) -> Iterator[tuple[int, str]]:
    """Comments and literals of C++, each with its line; what follows a # in Python and TOML; a page as it is."""
    if path.endswith(".md"):
        return iter([(1, text)])
    if path.endswith((".py", ".toml")):
        lines = enumerate(text.split("\n"), 1)
        return ((number, line.partition("#")[2]) for number, line in lines if "#" in line)
    return prose_of_code(text)


def prose_of_code(text: str) -> Iterator[tuple[int, str]]:
    """Lines of comment that follow each other are one text: a citation may be broken between them."""
    first, words, last = 0, "", -1
    number, at = 1, 0
    for token in TOKEN.finditer(text):
        number, at = number + text.count("\n", at, token.start()), token.start()
        alone = not text[text.rfind("\n", 0, at) + 1 : at].strip()
        if token["line"] is not None and alone and number == last + 1:
            words, last = f"{words}\n{token['line']}", number
            continue
        if words:
            yield first, words
        words = next((token[part] for part in ("line", "block", "text") if token[part]), "")
        first, last = number, number if token["line"] is not None else -1
    if words:
        yield first, words


def targets_of(text: str, loose: bool) -> Iterator[tuple[int, str]]:
    """(place, target) of each citation."""
    for found in SOURCE.finditer(text):
        yield found.start(), "source " + " ".join(found[1].split())
    text = SOURCE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    for found in LOOSE.finditer(text) if loose else ():
        if not MONTH.fullmatch(found[1]):
            yield found.start(), f"source {found[1].replace(' and ', ' & ')} {found[2]}"
    for found in SECTIONS.finditer(text):
        yield from ((found.start(), number.replace(".", "-")) for number in re.findall(r"\d+(?:\.\d+)?", found[0]))
    for found in SECTION.finditer(text):
        yield found.start(), found[1].replace(".", "-")
    for found in EQUATIONS.finditer(text):
        yield from ((found.start(), f"eq-{n}") for n in range(int(found[1]), int(found[2] or found[1]) + 1))
    for pattern, kind in NUMBERED:
        yield from ((found.start(), f"{kind}-{int(found[1])}") for found in pattern.finditer(text))


def citations_of(path: str, text: str) -> list[Citation]:
    loose = not path.startswith("cases/")  # data of cases carry their sources in the file
    return [
        Citation(path, line + prose.count("\n", 0, place), target)
        for line, prose in prose_of(path, text)
        for place, target in targets_of(prose, loose)
    ]


class Targets(NamedTuple):
    """What citations may lead to."""

    anchors: set[str]  # of docs/model.md: "eq-7", "8-4-walls"
    decisions: set[int]  # numbers of the files in docs/decisions
    sources: set[str]  # first cells of the table of REFERENCES.md

    def hold(self, target: str) -> bool:
        """A section may be cited by its number alone: "8-4" is the anchor "8-4-walls", and "8" is not "8-1-mass"."""
        kind, _, rest = target.partition(" ")
        if kind == "source":
            return rest in self.sources
        if target.startswith("decision-"):
            return int(target.removeprefix("decision-")) in self.decisions
        return any(re.fullmatch(re.escape(target) + r"(-[A-Za-z].*)?", anchor) for anchor in self.anchors)


def anchors_of(page: str) -> set[str]:
    return set(re.findall(r'<a id="([^"]+)">', page))


def sources_of(references: str) -> set[str]:
    return set(re.findall(r"^\| (.*?) \|", references, re.MULTILINE))
