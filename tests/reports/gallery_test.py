# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: a film a case of the paper, a page with all of them, and no success where one is lacking."""

import io
import json
import sys
import tempfile
import types
import unittest
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "reports"))
import gallery


def case(name, tags=("paper",), mode="corrected"):
    run = {"knobs": {"mode": mode}, "status": "ok", "base": True, "folder": f"runs/{name}", "metrics": {}}
    return {
        "id": f"paper/{name}",
        "title": f"Figure {name}",
        "claims": "it falls <here>",
        "verdict": "PASS",
        "tags": list(tags),
        "engines": [{"name": "tripoint", "status": "ok", "runs": [run]}],
    }


class Gallery(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="tripoint gallery ü ")
        self.path = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def film(self, name, frames):
        (self.path / "runs" / name).mkdir(parents=True)
        position = np.random.default_rng(1).uniform(size=(1, 30, 3)) - np.linspace(0, 1, frames)[:, None, None] * [
            0,
            0,
            1,
        ]
        with h5py.File(self.path / "runs" / name / "trajectory.h5", "w") as file:
            file["particles/all/position/value"], file["particles/all/position/time"] = (
                position,
                np.linspace(0, 2, frames),
            )
            file["particles/all/phase/value"], file["particles/all/material/value"] = np.full(30, 2), np.zeros(30, int)

    def program(self, script):
        """Stands in for tripoint: called as `render FOLDER --out DIR --size ...`"""
        path = self.path / "program"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(0o755)
        return str(path)

    def draw(self, *cases, program=None):
        (self.path / "results.json").write_text(
            json.dumps(
                {
                    "format": 1,
                    "tool": {},
                    "command": "",
                    "profile": "",
                    "verdict": "PASS",
                    "exit_code": 0,
                    "cases": list(cases),
                }
            )
        )
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()) as self.said:
            return gallery.main([str(self.path / "results.json"), *([program] if program else [])])

    def test_each_case_of_the_paper_has_its_film_on_the_page(self):
        self.film("09", 7)
        self.film("08", 4)
        self.assertEqual(self.draw(case("09"), case("08"), case("unrelated", tags=["heat"])), 0)
        page = (self.path / "index.html").read_text()
        self.assertLess(page.index("paper-08.gif"), page.index("paper-09.gif"))
        self.assertNotIn("unrelated", page)
        self.assertIn("it falls &lt;here&gt;", page)
        self.assertEqual(Image.open(self.path / "paper-09.gif").n_frames, 7)

    def test_a_case_of_the_printed_form_alone_is_drawn_too(self):
        self.film("11", 3)
        program = self.program('echo drawn > "$4/sheet.png"\n')
        self.assertEqual(self.draw(case("11", mode="paper"), program=program), 0)
        self.assertIn("paper-11.png", (self.path / "index.html").read_text())

    def test_a_case_without_a_trajectory_is_named_and_is_no_success(self):
        self.film("09", 3)
        self.assertEqual(self.draw(case("09"), case("10")), 1)
        self.assertIn("runs/10", self.said.getvalue())
        self.assertIn("paper-09.gif", (self.path / "index.html").read_text())

    def test_with_the_program_each_case_has_its_surfaces_too(self):
        self.film("09", 3)
        program = self.program(
            '[ "$1 $3" = "render --out" ] && [ -f "$2/trajectory.h5" ] && echo drawn > "$4/sheet.png"\n'
        )
        self.assertEqual(self.draw(case("09"), program=program), 0)
        self.assertEqual((self.path / "paper-09.png").read_text(), "drawn\n")
        self.assertIn('src="paper-09.png"', (self.path / "index.html").read_text())

    def test_a_figure_says_what_the_paper_says_and_what_its_sheets_colours_mean(self):
        self.film("fig-10-cold", 3)
        program = self.program('echo drawn > "$4/sheet.png"\necho "tripoint: colours: each body its own" >&2\n')
        self.assertEqual(self.draw(case("fig-10-cold"), program=program), 0)
        page = (self.path / "index.html").read_text()
        self.assertIn("Sheet: each body its own.", page)
        self.assertIn("stay distinct", page)

    def test_every_figure_of_the_suite_has_what_the_paper_says_of_it(self):
        cases = Path(__file__).resolve().parents[2] / "cases/paper"
        figures = [types.SimpleNamespace(id=f"paper/{file.stem}") for file in cases.glob("fig-*.toml")]
        self.assertGreater(len(figures), 12)
        self.assertEqual([figure.id for figure in figures if not gallery.said_by_the_paper(figure)], [])

    def test_surfaces_that_fail_are_named_and_are_no_success(self):
        self.film("09", 3)
        self.assertEqual(self.draw(case("09"), program=self.program("echo 'tripoint: no light' >&2; exit 2\n")), 1)
        self.assertIn("no light", self.said.getvalue())
        page = (self.path / "index.html").read_text()
        self.assertIn("no light", page)
        self.assertIn("paper-09.gif", page)

    def test_nothing_to_draw_ends_2_and_says_what_to_type(self):
        self.assertEqual(self.draw(case("x", tags=["heat"])), 2)
        self.assertIn("tripoint validate paper", self.said.getvalue())


if __name__ == "__main__":
    unittest.main()
