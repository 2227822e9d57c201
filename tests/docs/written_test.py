# SPDX-License-Identifier: BSD-3-Clause
"""What pages hold of the program is what make pages writes: docs/case-file.md, docs/results.md and the field
dictionary of docs/model.md.

written_test.py TRIPOINT SOURCE [unittest arguments]
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(SOURCE / "tools"))

from field_dictionary import Wrong, columns_of_all, fields_from, table, with_table, words_from


def column(name, owner, unit="1", size=8, per="particle"):
    return {"name": name, "unit": unit, "per": per, "owner": owner, "bytes": size}


def of_drag(owner="drag"):
    return [column(f"drag_force.{axis}", owner, "N") for axis in "xyz"]


class Pages(unittest.TestCase):
    def test_the_pages_of_the_case_file_and_of_results_are_what_the_program_prints(self):
        for page, *words in (("docs/case-file.md",), ("docs/results.md", "--results")):
            command = [TRIPOINT, "schema", *words, "--page"]
            printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
            self.assertEqual((SOURCE / page).read_text(), printed, f"{page} is old: make pages")

    def test_the_command_that_the_page_on_engines_names_prints_every_key_of_the_protocol(self):
        page = (SOURCE / "docs/engines.md").read_text()
        for name in ("job", "result"):
            command = f"tripoint schema --{name} --page"
            self.assertIn(f"    {command}", page)
            printed = subprocess.run(
                [TRIPOINT, *command.split()[1:]], capture_output=True, text=True, check=True
            ).stdout
            schema = subprocess.run(
                [TRIPOINT, "schema", f"--{name}"], capture_output=True, text=True, check=True
            ).stdout
            for key in json.loads(schema)["properties"]:
                self.assertIn(f"| `{key}` |", printed)

    def test_the_field_dictionary_is_what_the_tool_writes(self):
        rows = table(
            fields_from(columns_of_all(TRIPOINT, SOURCE / "cases")), words_from(SOURCE / "src"), SOURCE / "src"
        )
        page = (SOURCE / "docs/model.md").read_text()
        self.assertEqual(page, with_table(page, rows), "docs/model.md is old: make pages")


class Dictionary(unittest.TestCase):
    """The tool on a tree of one effect."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "src"
        (self.root / "effects/drag").mkdir(parents=True)

    def words(self, *lines):
        (self.root / "effects/drag/fields.toml").write_text("\n".join(lines) + "\n")
        return words_from(self.root)

    def refusal(self, columns, *lines):
        with self.assertRaises(Wrong) as refused:
            table(fields_from(columns), self.words(*lines), self.root)
        return str(refused.exception)

    def test_the_added_effect_has_its_row_by_its_folder_alone(self):
        root = SOURCE / "tests/effects"
        rows = table(fields_from(of_drag()), words_from(root), root).splitlines()
        self.assertEqual(rows[2:], ["| `drag_force` x,y,z | F | N | drag | force of drag, -c m v |"])

    def test_types_owners_and_a_missing_symbol_are_shown(self):
        columns = [
            column("a.b", "drag", "m", 24, "body"),
            column("a.b", "drag", "m", 24, "body"),
            column("n", "wind"),
            column("n", "drag"),
            column("q", "drag", "1", 32),
        ]
        rows = table(
            fields_from(columns),
            self.words(
                '"a.b" = { meaning = "place" }', 'n = { symbol = "n", meaning = "number" }', 'q = { meaning = "turn" }'
            ),
            self.root,
        )
        self.assertEqual(
            rows.splitlines()[2:],
            [
                "| `a.b` Vec3 (body) | - | m | drag | place |",
                "| `n` | n | 1 | drag, wind | number |",
                "| `q` Quaternion | - | 1 | drag | turn |",
            ],
        )

    def test_a_field_without_a_meaning_is_named(self):
        self.assertIn("the field drag_force of drag has no meaning", self.refusal(of_drag()))

    def test_a_line_of_no_field_or_of_another_effect_is_named_with_its_file(self):
        self.assertIn(
            "src/effects/drag/fields.toml: no effect of any case owns a field lift",
            self.refusal([], 'lift = { meaning = "force" }'),
        )
        self.assertIn(
            "drag_force is a field of wind", self.refusal(of_drag("wind"), 'drag_force = { meaning = "force" }')
        )

    def test_a_line_that_is_not_understood_is_refused(self):
        for line in (
            'drag_force = "force"',
            'drag_force = { symbol = "F" }',
            'drag_force = { meaning = "force", unit = "N" }',
        ):
            self.assertIn("write drag_force = {", self.refusal(of_drag(), line), line)
        self.assertIn("a cell of a table", self.refusal(of_drag(), 'drag_force = { meaning = "a | b" }'))
        self.assertIn("fields.toml", self.refusal(of_drag(), "drag_force ="))

    def test_a_field_has_one_line_and_its_components_one_unit(self):
        (self.root / "particles").mkdir()
        (self.root / "particles/fields.toml").write_text('drag_force = { meaning = "force" }\n')
        self.assertIn("drag_force has two lines", self.refusal(of_drag(), 'drag_force = { meaning = "force" }'))
        self.assertIn("differ in unit", self.refusal([*of_drag(), column("drag_force.x", "drag", "kg")]))

    def test_a_page_without_its_marks_is_refused(self):
        self.assertEqual(
            with_table("a\n<!-- begin fields -->\nold\n<!-- end fields -->\nb\n", "new\n"),
            "a\n<!-- begin fields -->\nnew\n<!-- end fields -->\nb\n",
        )
        for page in (
            "",
            "<!-- end fields --> <!-- begin fields -->",
            "<!-- begin fields --> <!-- begin fields --> <!-- end fields -->",
        ):
            with self.assertRaises(Wrong):
                with_table(page, "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
