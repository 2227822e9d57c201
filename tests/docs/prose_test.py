# SPDX-License-Identifier: BSD-3-Clause
"""Pages and help texts are plain English, and the check of that sees a bad one: prose_test.py SOURCE TRIPOINT."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, TRIPOINT = (Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(SOURCE / "tools"))
import prose

LONG = "The run " + "and the run " * 8 + "end."  # 27 words


def check(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-B", SOURCE / "tools/prose.py", *arguments], capture_output=True, text=True)


class Checkout(unittest.TestCase):
    def test_no_page_has_more_findings_than_its_allowance(self):
        answer = check()
        self.assertEqual(answer.returncode, 0, answer.stdout)


def helps(*command: str) -> dict[str, str]:
    """The help of a command and of the commands in it."""
    text = subprocess.run([TRIPOINT, *command, "--help"], capture_output=True, text=True, check=True).stdout
    found = {" ".join(command): text}
    for name in re.findall(r"(?m)^  ([a-z]+)  ", text.partition("\nSubcommands:\n")[2]):
        found |= helps(*command, name)
    return found


def paragraphs(text: str) -> str:
    """A help text with each example and option as a paragraph, without lists of exit codes."""
    text = re.sub(r"\n {20,}", " ", text)  # an option's second line
    text = re.sub(r"(?m)^Exit.*(\n(?!  |Usage).+)*", "", text)
    return re.sub(r"(?m)^  .*$", lambda line: f"\n{re.split(' {2,}', line[0].strip(), maxsplit=1)[-1]}\n", text)


class Helps(unittest.TestCase):
    def test_texts_of_commands_are_plain(self):
        texts = helps()
        self.assertGreater(len(texts), 30)
        for command, text in texts.items():
            with self.subTest(command):
                self.assertEqual(prose.findings(command, paragraphs(text)), [])

    def test_a_command_has_one_list_of_exit_codes(self):
        for command, text in helps().items():
            with self.subTest(command):
                self.assertEqual(len(re.findall(r"(?m)^Exit(?: codes)?[: ]", text)), 1, text)


class Planted(unittest.TestCase):
    """A checkout of one page, which has one allowed finding."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "tools").mkdir()
        (self.root / "README.md").write_text(f"# Title\n\nA sentence.\n{LONG}\n")
        self.check("--write")

    def check(self, *arguments: str) -> subprocess.CompletedProcess:
        return check("--root", str(self.root), *arguments)

    def plant(self, text: str) -> subprocess.CompletedProcess:
        with (self.root / "README.md").open("a") as page:
            page.write(f"\n{text}\n")
        return self.check()

    def test_an_allowed_finding_passes_and_one_more_fails_with_file_line_and_advice(self):
        self.assertEqual(self.check().returncode, 0)
        answer = self.plant(LONG)
        self.assertEqual(answer.returncode, 1)
        self.assertIn(f"README.md:6: {LONG}\n    27 words: split it", answer.stdout)

    def test_each_banned_construction_fails_with_its_advice(self):
        for text, advice in (
            ("There is no key that names it nor a default.", "no ... nor"),
            ("What no step reads.", "begin with the noun"),
            ("The sum of what moves is kept.", "noun in place"),
            ("So is an end that comes before.", "begin with the subject"),
            ("It reads files of strangers.", "third party"),
        ):
            with self.subTest(text):
                (self.root / "README.md").write_text("")
                answer = self.plant(text)
                answer = self.plant(text) if answer.returncode == 0 else answer  # the first one is allowed
                self.assertEqual(answer.returncode, 1)
                self.assertIn(advice, answer.stdout)

    def test_a_long_cell_fails(self):
        answer = self.plant("| a | b |\n|---|---|\n| " + "word. " * 31 + "| short |")
        self.assertEqual(answer.returncode, 1)
        self.assertIn("README.md:8: ", answer.stdout)
        self.assertIn("31 words: a cell has at most 30", answer.stdout)

    def test_a_long_decision_fails(self):
        (self.root / "docs/decisions").mkdir(parents=True)
        for words, code in ((198, 0), (199, 1)):
            (self.root / "docs/decisions/001-a.md").write_text("# Title\n\n" + "Word. " * words)
            answer = self.check()
            self.assertEqual(answer.returncode, code, answer.stdout)
        self.assertIn("docs/decisions/001-a.md:1: # Title\n    201 words: a decision has at most 200", answer.stdout)

    def test_an_allowance_falls_and_never_rises(self):
        self.plant(LONG)
        self.check("--write")
        self.assertEqual(self.check().returncode, 1)
        (self.root / "README.md").write_text("A sentence.\n")
        self.check("--write")
        self.assertEqual(self.plant(LONG).returncode, 1)


class Sentences(unittest.TestCase):
    """The reader's sentences: a false end would hide a long one, a missed end would make one."""

    def lines(self, text: str) -> list[tuple[int, str]]:
        return [row for block in prose.blocks(text) for row in prose.sentences(block)]

    def test_a_bold_title_is_a_part_of_its_sentence(self):
        for words, found in ((22, 0), (23, 1)):
            text = "**Title of three.** " + " ".join(["Word"] + ["word"] * (words - 1)) + ". Next.\n"
            self.assertEqual(len(prose.findings("page.md", text)), found)

    def test_abbreviations_and_numbers_do_not_end_a_sentence(self):
        text = "See Fig. 5, e.g. The one by B. Solenthaler et al. 2007 at 0.5 m. Next."
        self.assertEqual([row[1] for row in self.lines(text)], [text[:-6], "Next."])

    def test_items_headings_and_cells_are_apart(self):
        text = "# A title\nText goes\non. More.\n- an item\n1. another\n\n| a | `b|c` |\n"
        expected = [(1, "A title"), (2, "Text goes on."), (3, "More."), (4, "an item"), (5, "another"), (7, "a")]
        self.assertEqual(self.lines(text), [*expected, (7, "`b|c`")])

    def test_code_and_comments_are_not_prose(self):
        text = f"```\n{LONG}\n```\n<!-- {LONG}\n{LONG} -->\n\n    {LONG}\n"
        self.assertEqual(prose.findings("page", text), [])

    def test_code_has_its_words_and_a_link_is_its_text(self):
        self.assertEqual(self.lines("Run `a b c` by [the page](to/it.md)."), [(1, "Run `a b c` by the page.")])
        self.assertEqual(prose.count("Run `a b c` with x = 1."), 8)


if __name__ == "__main__":
    unittest.main()
