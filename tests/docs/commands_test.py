# SPDX-License-Identifier: BSD-3-Clause
"""Types what README and docs say, block by block: commands_test.py TRIPOINT SOURCE [unittest arguments].

A folder with the checkout's files and the built tree stands in for a fresh clone after `make validate`; the blocks of a
page are typed in it in their order, each line by the shell. A line must end 0, or as its comment says ("exit 1"). Not
typed, but held to name only commands, options, cases and targets that exist, are:
  - lines whose comment says on the page that they take minutes or download ("# 12 minutes"), and those with SUBJECT,
  NAME or FILE in them
  - builds and installs by make, cmake and ctest; `tripoint ...` in running text and in every --help
A block whose first line is "# file: NAME" is written as that file where the lines before it were typed, and a fence
"python" is run as a script. Case files are checked by `tripoint check`, parts of them by the TOML reader; every other
block must be listed here by its first line."""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
from functools import lru_cache
from pathlib import Path

TRIPOINT, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
COPIED = ("baselines", "cases", "examples")  # a line must not change the checkout
LINKED = (
    "adapters",
    "cmake",
    "docs",
    "program",
    "reports",
    "src",
    "tests",
    "tools",
    "validation",
    "CMakeLists.txt",
    "CMakePresets.json",
    "Makefile",
)
PAGES = [
    SOURCE / "README.md",
    SOURCE / "CONTRIBUTING.md",
    *sorted((SOURCE / "docs").glob("*.md")),
    SOURCE / "examples" / "gated-engine" / "README.md",
]
HELD_ELSEWHERE = (
    "add-an-effect.md",
)  # its blocks are the files of an effect that the program does not have: test-effects-added holds them
PROGRAMS = (
    "tripoint",
    "build/bin/tripoint",
    "make",
    "cmake",
    "ctest",
    "ninja",
    "sed",
    "git",
    "echo",
    "cp",
    "printf",
    "python3",
    "pip",
    ".ci/run",
)
TYPED = ("tripoint", "build/bin/tripoint", "sed", "git", "echo", "python3")
FILE = "# file: "  # then the name under which the block is written
LISTINGS = (
    "case file -> runs ->",
    "report/index.html ",
)  # blocks that are no commands: a diagram, the files of a report
PYTHON = ("python",)  # fences of this word are run as a script, in the folder in which the lines before them were typed
PICTURES = (
    "math",
    "mermaid",
    "markdown",
    "cmake",
    "cpp",
    "{toctree}",
)  # fences with these words are drawn, or hold a text that another test makes
SPARED = re.compile(
    r"\b(\d+|an?|a few) (minutes?|hours?)\b|\bdownload"
)  # what the page itself says of a line that is not typed
PLACEHOLDER = re.compile(
    r"\b[A-Z]{4,}\b|[a-z]/n\b|\.\.\."
)  # CASE, RESULTS.json, i/n: stands for what the reader fills in
AUTHOR = {
    f"GIT_{who}_{what}": f"nobody{'' if what == 'NAME' else '@localhost'}"
    for who in ("AUTHOR", "COMMITTER")
    for what in ("NAME", "EMAIL")
}
STAND_IN = "rigid/ballistic"  # instead of the whole suite in report/


def blocks(page, words=None):
    """(line number, lines) of each block that is indented by four spaces or fenced; none of a page that another test
    holds. With words: of such fences alone."""
    if page.name in HELD_ELSEWHERE:
        return []
    lines = list(enumerate(page.read_text().splitlines(), 1))
    fenced, rest = fences(lines, words)
    found = sorted(fenced + ([] if words else indented(rest)))
    return [(number, "\n".join(text).strip("\n").splitlines()) for number, text in found]


def fences(lines, words):
    """([(number, text) of each wanted fence], the numbered lines outside all; a fence leaves None)"""
    found, rest, block = [], [], None
    for number, line in lines:
        if line.startswith("```"):
            word, block = line[3:].strip(), [] if block is None else None
            if block is not None and (word in words if words else word not in (*PICTURES, *PYTHON)):
                found.append((number + 1, block))
            rest.append((number, None))
        elif block is not None:
            block.append(line)
        else:
            rest.append((number, line))
    return found, rest


def indented(lines):
    """[(number, text)] of each block that is indented by four spaces after an empty line."""
    found, block, blank = [], None, True
    for number, line in lines:
        if line is None:
            block = None
            continue
        inside = line.startswith("    ") and (blank or block is not None)
        if inside and block is None:
            block = []
            found.append((number, block))
        if inside or (block is not None and not line.strip()):
            block.append(line[4:])
        elif line.strip():
            block = None
        blank = not line.strip()
    return found


def commands(lines):
    """(command, comment) of each line; a backslash at the end goes on."""
    for line in "\n".join(lines).replace("\\\n", " ").splitlines():
        command, _, comment = line.partition("  #")
        if command.strip():
            yield command.strip(), comment.strip()


def is_file(lines):
    return lines[0].startswith(FILE)


def program(command):
    words = [word for word in command.split() if not re.fullmatch(r"[A-Z_]+=\S*", word)]
    return words[1] if words[:1] == ["sudo"] else words[0] if words else ""


def is_typed(command, comment):
    return program(command) in TYPED and not SPARED.search(comment) and not PLACEHOLDER.search(command)


def is_commands(lines):
    return any(
        program(command) in PROGRAMS or program(command).startswith(("tests/", "build/tests/", "tools/"))
        for command, _ in commands(lines)
    )


def is_case(lines):
    return any(re.match(r"\[\[?[a-z.]+\]\]?\s*$", line) for line in lines)


@lru_cache
def tripoint(*words):
    return subprocess.run([TRIPOINT, *words], capture_output=True, text=True, timeout=120, check=False)


@lru_cache
def helps():
    """{("gate", "accept"): its --help}, of every command and subcommand."""
    found, open_ends = {}, [()]
    while open_ends:
        words = open_ends.pop()
        found[words] = tripoint(*words, "--help").stdout
        below = found[words].rpartition("Subcommands:\n")[2] if "Subcommands:\n" in found[words] else ""
        open_ends += [(*words, line.split()[0]) for line in below.splitlines() if re.match(r"  [a-z]", line)]
    return found


@lru_cache
def targets():
    return set(re.findall(r"^([a-z-]+):", (SOURCE / "Makefile").read_text(), re.MULTILINE))


def wrong_in(command):
    """What a line names that does not exist: a target, a command, an option, a case; "" when all is there."""
    try:
        words = [word for word in shlex.split(command) if not re.fullmatch(r"[A-Z_]+=.*", word)]
    except ValueError as error:
        return str(error)
    words = words[1:] if words[:1] == ["sudo"] else words
    words = words[: next((n for n, word in enumerate(words) if word in ("|", "&&", ";", ">")), len(words))]
    if words[0] == "make":
        return " ".join(f"no target {word}" for word in words[1:] if word not in targets())
    if words[0].endswith("tripoint"):
        return wrong_word(words)
    return "" if is_program(words[0]) else f"no program {words[0]}"


def is_program(word):
    return word in PROGRAMS or (SOURCE / word).exists() or shutil.which(word) or word.startswith("build/")


def wrong_word(words):
    """The first word of a call of tripoint that does not exist."""
    verb = max((words[1 : 1 + n] for n in range(3) if tuple(words[1 : 1 + n]) in helps()), key=len)
    if not verb and len(words) > 1 and not words[1].startswith("-") and not PLACEHOLDER.search(words[1]):
        return f"no command {words[1]}"
    text = helps()[tuple(verb)]
    for word in words[1 + len(verb) :]:
        if not has_option(text, word):
            return f"{' '.join(verb)} has no option {word}"
        if lacks_case(word):
            return f"no case {word}"
    return ""


def has_option(text, word):
    """Whether a word is no option, or one that this text of --help names."""
    name = re.escape(word.split("=")[0])
    return not word.startswith("-") or word == "-" or re.search(rf"(^|[\s,]){name}\b", text, re.MULTILINE)


def lacks_case(word):
    if "/" not in word or PLACEHOLDER.search(word) or word.split("/")[0] not in subjects():
        return False
    return not any((SOURCE / "cases" / name).exists() for name in (word, f"{word}.toml"))


@lru_cache
def subjects():
    return {folder.name for folder in (SOURCE / "cases").iterdir() if folder.is_dir()}


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tripoint-docs-")
        cls.root = Path(cls.folder.name)
        cls.spent = []
        (cls.root / "build").symlink_to(TRIPOINT.parent.parent)
        (cls.root / "tmp").mkdir()
        for name in COPIED:
            shutil.copytree(SOURCE / name, cls.root / name)
        for name in LINKED:
            (cls.root / name).symlink_to(SOURCE / name)
        done = subprocess.run(
            [TRIPOINT, "validate", STAND_IN, "--out", "report", "--no-report"],
            cwd=cls.root,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr

    @classmethod
    def tearDownClass(cls):
        for seconds, where in sorted(cls.spent, reverse=True)[:5]:
            print(f"{seconds:6.1f} s  {where}")
        print(f"{len(cls.spent)} lines typed, {sum(seconds for seconds, _ in cls.spent):.0f} s")
        cls.folder.cleanup()

    def type(self, command, comment, folder, where):
        environment = dict(os.environ, PATH=f"{TRIPOINT.parent}:{os.environ['PATH']}", NO_COLOR="1", **AUTHOR)
        expected = int(found[1]) if (found := re.search(r"\bexit (\d+)\b", comment)) else 0
        began = time.monotonic()
        done = subprocess.run(
            ["bash", "-c", command.replace("/tmp/", f"{self.root}/tmp/")],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=240,
            check=False,
        )
        self.spent.append((time.monotonic() - began, f"{where}: {command}"))
        self.assertEqual(done.returncode, expected, f"{where}: {command}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")

    def run_script(self, lines, folder, where):
        """Where it imports our package, from the checkout's `python` folder and with this build's program."""
        environment = dict(
            os.environ,
            PYTHONPATH=str(SOURCE / "python"),
            TRIPOINT_PROGRAM=str(TRIPOINT),
            PYTHONDONTWRITEBYTECODE="1",
            MPLBACKEND="Agg",
        )
        began = time.monotonic()
        done = subprocess.run(
            ["/usr/bin/python3", "-c", "\n".join(lines)],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=240,
            check=False,
        )
        self.spent.append((time.monotonic() - began, f"{where}: a script"))
        self.assertEqual(
            done.returncode, 0, f"{where}: the script ends with\n{done.stdout[-1000:]}{done.stderr[-2000:]}"
        )

    def test_every_line_of_every_page_does_what_it_says(self):
        for page in PAGES:
            name = str(page.relative_to(SOURCE))
            folder = self.root
            elsewhere = (
                page.parent.name == "gated-engine"
            )  # another project, which begins with an empty folder: empty_repository_test.py types it
            scripts = [block for block in blocks(page, PYTHON) if not is_file(block[1])]
            for number, lines in sorted(blocks(page) + blocks(page, PYTHON)):
                if is_file(lines):
                    (folder / lines[0].removeprefix(FILE)).write_text("\n".join(lines) + "\n")
                    continue
                if (number, lines) in scripts:
                    with self.subTest(f"{name}:{number}"):
                        self.run_script(lines, folder, f"{name}:{number}")
                    continue
                if not is_commands(lines):
                    continue
                for command, comment in commands(lines):
                    with self.subTest(f"{name}:{number}", command=command):
                        self.assertEqual(wrong_in(command), "")
                        if is_typed(command, comment) and not elsewhere:
                            self.type(command, comment, folder, f"{name}:{number}")

    def test_what_is_not_typed_is_long_by_its_own_word_or_builds(self):
        typed, spared, left = 0, 0, []
        for page in PAGES:
            for number, lines in blocks(page):
                for command, comment in commands(lines) if is_commands(lines) else ():
                    if is_typed(command, comment):
                        typed += 1
                    else:
                        left.append(command)
                        spared += program(command) in TYPED
        self.assertGreater(typed, 20)
        self.assertGreater(typed, 2 * spared)  # most of what a page shows is typed
        for command in left:
            self.assertEqual(wrong_in(command), "", command)

    def test_case_files_are_taken_and_parts_of_them_are_toml(self):
        for page in PAGES:
            for number, lines in blocks(page):
                if is_commands(lines) or not is_case(lines) or is_file(lines):  # the lines below a file use it
                    continue
                with self.subTest(f"{page.relative_to(SOURCE)}:{number}"):
                    document = tomllib.loads("\n".join(lines))
                    if "body" in document and "scene" in document:
                        file = self.root / f"{page.stem}-{number}.toml"
                        file.write_text("\n".join(lines) + "\n")
                        done = tripoint("check", str(file))
                        self.assertEqual(done.returncode, 0, done.stderr)

    def test_no_block_is_of_a_kind_that_nothing_looks_at(self):
        for page in PAGES:
            for number, lines in blocks(page):
                if not is_commands(lines) and not is_case(lines) and not is_file(lines):
                    self.assertTrue(
                        lines[0].startswith(LISTINGS),
                        f"{page.relative_to(SOURCE)}:{number} is no command, no case file and no known listing: "
                        f"{lines[0]}",
                    )

    def test_commands_in_running_text_exist(self):
        for page in PAGES:
            for command in re.findall(r"`((?:build/bin/)?tripoint [^`]+|make [a-z-]+)`", page.read_text()):
                with self.subTest(page.name, command=command):
                    self.assertEqual(wrong_in(re.sub(r"\[|\]", " ", command)), "")

    def test_every_help_has_examples_and_they_exist(self):
        examples = 0
        for words, text in helps().items():
            self.assertRegex(
                text, rf"(?m)^ *tripoint {' '.join(words)}", f"tripoint {' '.join(words)} --help has no example"
            )
            for line in re.findall(r"^ +(tripoint .*)$", text, re.MULTILINE):
                for command in re.split(r"\s{2,}(?=tripoint )|; (?=tripoint )", line):
                    command = re.split(r"\s{2,}|  #", command)[0]
                    with self.subTest(" ".join(words), command=command):
                        self.assertEqual(wrong_in(command), "")
                        examples += 1
        self.assertGreater(examples, 40)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
