# SPDX-License-Identifier: BSD-3-Clause
"""What tools/still_water.py makes of a cell and of its trajectory: still_water_test.py TOOL TRIPOINT"""

import contextlib
import importlib.util
import io
import json
import sys
import tempfile
import types
import unittest
from pathlib import Path

import h5py
import numpy

TRIPOINT = sys.argv.pop(2)
SPEC = importlib.util.spec_from_file_location("still_water", sys.argv.pop(1))
still_water = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(still_water)


def write(folder, times, speeds):
    """Two particles of water and a wall; the first moves along x with the speed of its time, the wall faster than
    all."""
    with h5py.File(folder / "trajectory.h5", "w") as file:
        velocity = numpy.zeros((len(times), 3, 3))
        velocity[:, 0, 0], velocity[:, 2, 0] = speeds, 100.0
        file["particles/all/velocity/value"], file["particles/all/velocity/time"] = velocity, times
        file["particles/all/body/value"] = numpy.tile([-1, -1, 0], (len(times), 1))
        for name in ("walls", "time_integration", "bulk_viscous", "viscous"):
            file[f"observables/energy_{name}/value"] = (
                numpy.linspace(1.0, 2.0, len(times)) if name == "walls" else numpy.zeros(len(times))
            )


class StillWater(unittest.TestCase):
    def test_measures_the_water_alone_by_window_in_units_of_the_tank(self):
        cell, speeds = still_water.Cell(5, 4.0, 1e-3, "free"), [0.0, 1.0, 3.0, 2.0]
        with tempfile.TemporaryDirectory() as folder:
            write(Path(folder), [0.0, 4.0, 10.0, 20.0], speeds)
            seen = still_water.measure(Path(folder), cell)
        unit = (9.81 * 0.8) ** 0.5
        self.assertEqual(seen["liquid"], 2)
        self.assertAlmostEqual(seen["windows"][0][1], 1.0 / unit)
        self.assertAlmostEqual(seen["windows"][1][0], 3.0 / unit / 2**0.5)
        self.assertIsNone(seen["windows"][2])
        self.assertAlmostEqual(seen["greatest_wall_work"], 1.0 / (1000.0 * 9.81 * 0.8 * 0.8 * 0.2 * 6 * 0.04))

    def test_cells_are_72_and_the_dearer_run_shorter_or_not_at_all(self):
        cells = still_water.cells()
        self.assertEqual(len({c.name for c in cells}), 72)
        lengths = [c.length(60.0) for c in sorted(cells, key=lambda c: c.cost(1.0))]
        known = [0.0 if t is None else t for t in lengths]
        self.assertEqual(known, sorted(known, reverse=True))
        self.assertEqual((known[0], known[-1]), (60.0, 0.0))

    def test_the_page_says_what_ran_how_long_and_counts_the_goal(self):
        with tempfile.TemporaryDirectory() as root:
            folder = Path(root) / "laid-as-a-lattice"
            folder.mkdir()
            for viscosity, rms, slip in ((0.0, 0.03, "free"), (1.0, 0.01, "no")):
                cell = still_water.Cell(5, 1.0, viscosity, slip)
                row = {
                    "name": cell.name,
                    "status": "ok",
                    "time": 20.0,
                    "windows": [[rms, 0.1], [rms, 0.2], None],
                    "greatest_wall_work": 0.0,
                    "steps": 1e-4,
                    "steps_most": 1e-4,
                }
                (folder / f"{cell.name}.json").write_text(json.dumps(row))
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                still_water.page(types.SimpleNamespace(out=[str(folder)]))
                still_water.print_table(types.SimpleNamespace(out=[str(folder)]))
        text = said.getvalue()
        self.assertIn("## Laid as a lattice", text)
        self.assertIn("3 of 72 tanks were run, 0 of them for 60 s", text)
        self.assertIn("| 5 | 1 : 1 | 0 | no, the same run | 20 | 0.0300", text)
        self.assertIn("5 to 20 s: 1 of 3 stay below 0.02", text)
        self.assertIn("| 5 | 1 : 1 | 1 | no | 20 | 0.0100 / 0.100 | 0.0100 / 0.200 | - | 0 | 1.0e-4 |", text)

    def test_the_page_in_docs_is_what_the_kept_numbers_make_of_it(self):
        docs, said = still_water.ROOT / "docs", io.StringIO()
        with contextlib.redirect_stdout(said):
            still_water.page(types.SimpleNamespace(out=sorted((docs / "still-water").glob("*.json"))))
        self.assertEqual(said.getvalue(), (docs / "still-water.md").read_text(encoding="utf-8"))

    def test_keeps_of_each_cell_the_longest_run(self):
        cell = still_water.Cell(5, 1.0, 1e-3, "no")
        with tempfile.TemporaryDirectory() as root:
            folder, to = Path(root) / "settled", Path(root) / "kept"
            folder.mkdir()
            args = types.SimpleNamespace(out=[str(folder)], to=str(to))
            for asked, steps in ((20.0, 2e-4), (5.0, 5e-4), (60.0, 6e-4)):
                (folder / f"{cell.name}.json").write_text(
                    json.dumps({"name": cell.name, "asked": asked, "steps": steps})
                )
                still_water.keep(args)
                self.assertEqual(still_water.rows_of(to / "settled.json")[cell.name]["asked"], max(asked, 20.0))
            other = still_water.Cell(5, 4.0, 1e-3, "no")
            (folder / f"{cell.name}.json").rename(folder / f"{other.name}.json")
            (folder / f"{other.name}.json").write_text(json.dumps({"name": other.name, "asked": 5.0}))
            still_water.keep(args)
            self.assertEqual(list(still_water.rows_of(to / "settled.json")), [cell.name, other.name])

    def test_a_cell_runs(self):
        cell = still_water.Cell(5, 0.25, 1.0, "no")
        with tempfile.TemporaryDirectory() as root:
            args = types.SimpleNamespace(tripoint=TRIPOINT, set=[])
            row = still_water.run_cell(cell, 0.5, args, Path(root) / "run")
        self.assertEqual((row["status"], row["liquid"], row["greatest_wall_work"]), ("ok", 20 * 5 * 6, 0.0))
        self.assertGreater(row["windows"][0][0], 0.0)


if __name__ == "__main__":
    unittest.main()
