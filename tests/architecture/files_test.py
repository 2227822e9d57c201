# SPDX-License-Identifier: BSD-3-Clause
"""Every source file names its licence, has at most 500 lines and holds no path of one machine; functions of C++ are
short and decide little: files_test.py SOURCE."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1)).resolve()
FOLDERS = ("src", "adapters", "validation", "program", "tests", "reports", "cmake", "tools", "python")
ENDINGS = (".cpp", ".hpp", ".py", ".sh", ".cmake")
GPL = ("adapters/lammps/", "adapters/ranks/")
PAGES = ("docs", "cases", "baselines", "examples", ".github")
WORDS = (".md", ".html", ".toml", ".yml", ".json", ".csv")
MOST = 500  # lines
MOST_OF_A_FUNCTION = 65  # lines, where the program is written; a test's table may be long
PROGRAM = ("src/", "adapters/", "validation/", "program/")
HEAD = re.compile(r"\)( const| noexcept| override| final| mutable| ->.*)* \{$")
CONTROL = re.compile(r"\s*(\} )?(if|for|while|switch|else|do|try|catch)\b")
MOST_DECISIONS = 15  # of a function of src
DECISION = re.compile(r"\b(?:if|for|while|case|catch)\b|&&|\|\||\?")
COMMENT_OR_TEXT = re.compile(r'//.*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'')
# What the step does for effects, and those whose lists by id are no columns, so that they do it themselves
# (docs/add-an-effect.md, "Over ranks").
HOUSEKEEPING = re.compile(r"\brefresh\(|\bhand_to_ghosts\(|\bhalo\b|\bforms_fixed\b|\bformed\(\)")
KEEP_HOUSE = {
    "carried_liquid/carried_liquid.cpp",
    "carried_liquid/elastic_faces.cpp",
    "elastic/bond_forces.cpp",
    "faces/face_pressure.cpp",
    "friction/friction.cpp",
    "heat/held_surface.cpp",
    "phase/softening.cpp",
    "pressure/let_out.cpp",
    "walls/wall_patches.cpp",
}
MACHINE = re.compile(r"(?<![\w.}/-])/(?:home|root|work|mnt|Users|opt)/[A-Za-z0-9]")
HOME = "/".join(["", "home", "ann"])  # in parts, since no file may hold such a path


def faults(path, text):
    """What breaks a rule, as file:line: why."""
    lines = text.splitlines()
    licence = f"SPDX-License-Identifier: {'GPL-2.0-only' if path.startswith(GPL) else 'BSD-3-Clause'}"
    if not any(line.endswith(licence) for line in lines[:3]):
        yield f"{path}:1: no line '{licence}' at the top"
    if len(lines) > MOST:
        yield f"{path}:{MOST + 1}: {len(lines)} lines, {MOST} at most: split by subject"
    if path.startswith(PROGRAM) and path.endswith(("pp", ".inc")):
        for number, length in long_functions(lines):
            yield f"{path}:{number}: a function of {length} lines, {MOST_OF_A_FUNCTION} at most: split it by subject"
    yield from machine_paths(path, text)


def machine_paths(path, text):
    for number, line in enumerate(text.splitlines(), 1):
        if MACHINE.search(line):
            yield f"{path}:{number}: a path of one machine: {line.strip()[:200]}"


def functions(lines):
    """(line of the head, end) of each. A body is what stands deeper than the brace that ends it."""
    for number, head in enumerate(lines[:-1], 1):
        if not HEAD.search(head) or CONTROL.match(head):
            continue
        depth = indent(lines[number])
        end = next((n for n in range(number, len(lines)) if lines[n].strip() and indent(lines[n]) < depth), number)
        yield number, end


def long_functions(lines):
    for number, end in functions(lines):
        if end + 2 - number > MOST_OF_A_FUNCTION:
            yield number, end + 2 - number


def decisions(lines):
    """(line, its decisions) of each function: branches, loops, cases, and, or."""
    for number, end in functions(lines):
        body = (COMMENT_OR_TEXT.sub("", line) for line in lines[number:end] if not line.lstrip().startswith("#"))
        yield number, sum(len(DECISION.findall(line)) for line in body)


def undecided(path, text):
    for number, count in decisions(text.splitlines()):
        if count > MOST_DECISIONS:
            yield f"{path}:{number}: a function of {count} decisions, {MOST_DECISIONS} at most: split it by subject"


def indent(line):
    return len(line) - len(line.lstrip()) if not line.startswith("#") else 1000


class Rules(unittest.TestCase):
    TAG = "// SPDX-License-Identifier: "

    def told(self, path, text):
        return [fault.split(": ")[1] for fault in faults(path, text)]

    def test_the_licence_is_at_the_top_and_is_the_gpl_for_lammps(self):
        good = self.TAG + "BSD-3-Clause\n"
        self.assertEqual(self.told("src/core/a.cpp", good), [])
        self.assertEqual(self.told("reports/a.py", "#!/usr/bin/python3\n# SPDX-License-Identifier: BSD-3-Clause\n"), [])
        self.assertEqual(self.told("adapters/lammps/a.cpp", self.TAG + "GPL-2.0-only\n"), [])
        for path, text in (
            ("src/core/a.cpp", "int x;\n"),
            ("src/core/a.cpp", ""),
            ("src/core/a.cpp", "\n\n\n" + good),
            ("adapters/lammps/a.cpp", good),
        ):
            self.assertEqual(len(self.told(path, text)), 1, text)

    def test_a_file_has_five_hundred_lines_at_most(self):
        text = self.TAG + "BSD-3-Clause\n" + 499 * "x\n"
        self.assertEqual(self.told("src/core/a.cpp", text), [])
        self.assertEqual(self.told("src/core/a.cpp", text + "y"), ["501 lines, 500 at most"])

    def test_a_function_of_the_program_has_sixty_five_lines_at_most(self):
        for lines, found in ((61, []), (62, ["a function of 66 lines, 65 at most"])):
            head = "BSD-3-Clause\nint sum(int x,\n        int y) const {\n"
            planted = self.TAG + head + lines * "  x += y;\n" + "#endif\n  return x;\n}\n\nint z() {\n}\n"
            self.assertEqual(self.told("src/core/a.cpp", planted), found)
            self.assertEqual(self.told("tests/core/a_test.cpp", planted), [])

    def test_a_function_of_the_solver_has_fifteen_decisions_at_most(self):
        for count, found in ((7, 0), (8, 1)):
            planted = "int sum(int x) {\n" + count * "  if (x && x) x += '?';  // if so\n" + "  return x;\n}\n"
            self.assertEqual(len(list(undecided("src/core/a.cpp", planted))), found)

    def test_a_path_of_one_machine_is_named_with_its_line(self):
        text = self.TAG + "BSD-3-Clause\n"
        self.assertEqual(
            list(faults("src/core/a.cpp", text + f'open("{HOME}/decks");\n')),
            [f'src/core/a.cpp:2: a path of one machine: open("{HOME}/decks");'],
        )
        good = f'open("/usr/bin/python3"); f(a{HOME}/b, ".{HOME}"); // kinetic/{"work"}/heat\n'
        self.assertEqual(self.told("src/core/a.cpp", text + good), [])


class Tree(unittest.TestCase):
    def test_no_function_of_the_solver_decides_more(self):
        found = {str(f.relative_to(ROOT)): f.read_text() for f in sorted((ROOT / "src").rglob("*.[ch]pp"))}
        self.assertGreater(len(found), 300)
        self.assertEqual([fault for path, text in found.items() for fault in undecided(path, text)], [])

    def test_effects_leave_ghosts_and_fixed_rows_to_the_step(self):
        room = ROOT / "src/effects"
        code = {
            str(f.relative_to(room)): [COMMENT_OR_TEXT.sub("", line) for line in f.read_text().splitlines()]
            for f in sorted(room.glob("*/*.[ch]pp"))
        }
        self.assertGreater(len(code), 100)
        self.assertEqual({f for f, lines in code.items() if any(map(HOUSEKEEPING.search, lines))}, KEEP_HOUSE)

    def test_no_page_or_case_holds_a_path_of_one_machine(self):
        """Nor what a command has drawn into the project."""
        pages = [f for room in PAGES for f in sorted((ROOT / room).rglob("*")) if f.suffix in WORDS]
        pages += [f for f in sorted(ROOT.iterdir()) if f.is_file() and f.suffix in WORDS]
        self.assertGreater(len(pages), 400)
        self.assertEqual(
            [f for page in pages for f in machine_paths(str(page.relative_to(ROOT)), page.read_text())], []
        )

    def test_every_file_keeps_the_rules(self):
        files = [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*"))]
        files = [file for file in files if file.suffix in ENDINGS or file.name == "CMakeLists.txt"]
        self.assertGreater(len(files), 40)  # else the tree was not found
        self.assertEqual([f for file in files for f in faults(str(file.relative_to(ROOT)), file.read_text())], [])


if __name__ == "__main__":
    unittest.main()
