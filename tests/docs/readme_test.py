# SPDX-License-Identifier: BSD-3-Clause
"""README is one screen that a newcomer can read, and leads to a page that is whole and of the engines that are pinned:
readme_test.py SOURCE [unittest arguments].

Its commands are typed by commands_test.py, and its links are followed by links_test.py."""

import json
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).resolve()
README = (SOURCE / "README.md").read_text(encoding="utf-8")
PAGE = SOURCE / "docs" / "which-engine.html"
PICTURE = SOURCE / "docs" / "which-engine.png"
COLUMNS, LINES, WORDS = 100, 45, 25


def plain(text):
    """Without code, pictures and targets of links."""
    text = re.sub(r"\[!\[[^\]]*\]\([^)]*\)\]\([^)]*\)", "", text)
    text = re.sub(r"^    .*$", "", text, flags=re.MULTILINE)
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "code", text))


def sentences(text):
    """Of paragraphs; headings and rows of tables are none."""
    for paragraph in re.split(r"\n\s*\n", plain(text)):
        if not paragraph.lstrip().startswith(("#", "|", "-")):
            yield from re.split(r"(?<=[.?!;])\s+", " ".join(paragraph.split()))


class Readme(unittest.TestCase):
    def test_it_is_one_screen_without_a_dense_line(self):
        lines = README.splitlines()
        self.assertLessEqual(len(lines), LINES)
        for number, line in enumerate(lines, 1):
            if not line.startswith("[!["):
                self.assertLessEqual(len(line), COLUMNS, f"README.md:{number}")

    def test_its_sentences_are_short(self):
        for sentence in sentences(README):
            self.assertLessEqual(len(sentence.split()), WORDS, sentence)

    def test_a_picture_of_the_page_stands_above_the_first_command(self):
        top = README[: README.index("\n    ")]
        self.assertIn("](docs/which-engine.png)](docs/which-engine.html)", top)
        self.assertLess(PICTURE.stat().st_size, 300_000)

    def test_three_commands_say_how_to_begin_and_how_to_get_an_engine(self):
        found = re.findall(r"^    (\S.*)$", README, re.MULTILINE)
        self.assertEqual(len(found), 3)
        self.assertTrue(any("tripoint engine install" in command for command in found))
        self.assertIn("tripoint engine install", (SOURCE / "docs" / "tutorial.md").read_text(encoding="utf-8"))

    def test_the_page_is_linked_first_from_the_guide_too(self):
        guide = (SOURCE / "docs" / "index.md").read_text(encoding="utf-8")
        self.assertIn("which-engine.html", re.findall(r"(?<!!)\]\(([^)]+)\)", guide)[0])


class Page(unittest.TestCase):
    def setUp(self):
        self.html = PAGE.read_text(encoding="utf-8")

    def test_it_is_one_file_that_loads_nothing(self):
        self.assertLess(len(self.html.encode()), 3_000_000)
        self.assertIn("default-src 'none'", self.html)
        self.assertFalse(re.findall(r"<(?:img|script|link|iframe)\b|\bsrc=|url\(", self.html))

    def test_it_has_the_pinned_release_of_every_engine(self):
        for name, entry in json.loads((SOURCE / "adapters" / "vendors" / "catalogue.json").read_text())[
            "engines"
        ].items():
            self.assertRegex(
                self.html,
                rf"(?i){re.escape(entry['title'].split(' in ')[0].split(' Physics')[0])}[^<]*? "
                rf"{re.escape(entry['default'])}",
                name,
            )

    def test_its_cases_are_there_and_are_acceptance_cases(self):
        found = set(re.findall(r"\b((?:contact|rigid|coupling|fluid|solid|heat|phase)/[a-z0-9-]+)", self.html))
        self.assertGreater(len(found), 30)
        for case in found:
            self.assertIn("acceptance", (SOURCE / "cases" / f"{case}.toml").read_text(encoding="utf-8"), case)

    def test_every_use_has_a_row_and_a_picture(self):
        for use in ("Stack", "Slide and roll", "Bounce", "Spin", "Float", "Pour", "Bend", "Conduct", "Melt"):
            row = self.html.split(f'<tr><th scope="row">{use}<')[1].split("</tr>")[0]
            self.assertIn("<svg", row, use)
            self.assertRegex(row, r"of the limit|× the limit", use)

    def test_questions_of_a_buyer_are_answered_on_it(self):
        answers = dict(re.findall(r"<dt>([^<]+)</dt><dd>([^<]+)</dd>", self.html))
        for words in (
            "stacks boxes",
            "fast spin",
            "restitution 0.5",
            "two materials",
            "pour?",
            "accuracy cost",
            "cheapest",
        ):
            answer = next((answer for question, answer in answers.items() if words in question), "")
            self.assertGreater(len(answer), 30, words)

    def test_no_cell_with_a_known_defect_looks_right(self):
        cells = [cell for cell in self.html.split("<td class=")[1:] if 'class="said"' in cell]
        self.assertGreater(len(cells), 40)
        for cell in cells:
            said = re.search(r'class="said">([^<]*)<', cell)[1]
            self.assertEqual(cell.startswith('"right'), "known defect" not in said and "wrong" not in said, said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
