# SPDX-License-Identifier: BSD-3-Clause
"""What a validation measured, as tables."""

from __future__ import annotations

import csv
import json
import tempfile
from pathlib import Path

from ._program import call, words_of
from ._run import Run

TEXTS = (
    "case",
    "engine",
    "preset",
    "mode",
    "status",
    "metric",
    "unit",
    "state_hash",
    "reason",
    "verdict",
    "title",
    "kind",
    "requirement",
    "reference",
    "source",
    "axis",
    "class",
)
VERDICTS = (0, 1, 3, 4, 6, 7)  # exit codes of a validation that has results


class Results:
    """results.json. cases, gates, metrics, orders: lists of dicts, a row each; a number that does not exist is None.

    verdict, exit_code, raw: as in the file (docs/results.md). frame("gates"): the same as a pandas.DataFrame.
    """

    def __init__(self, path):
        self.path = Path(path)
        if self.path.is_dir():
            self.path /= "results.json"
        self.raw = json.loads(self.path.read_text(encoding="utf-8"))
        self.verdict, self.exit_code = self.raw["verdict"], self.raw["exit_code"]
        with tempfile.TemporaryDirectory() as folder:
            call(["export", self.path, "--csv", "--out", folder])
            self.cases, self.gates, self.metrics, self.orders = (
                read_table(Path(folder) / f"{name}.csv") for name in ("cases", "gates", "metrics", "orders")
            )

    def __repr__(self):
        return f"<Results {self.path}: {self.verdict}, {len(self.cases)} cases, {len(self.gates)} gates>"

    def frame(self, table):
        """@raises ImportError where there is no pandas"""
        import pandas

        return pandas.DataFrame(getattr(self, table))

    def run(self, case, engine="tripoint", preset=None):
        """The run of an engine at the case's own resolution, with its arrays. @raises KeyError"""
        for row in self.raw["cases"]:
            for each in row["engines"] if row["id"] == case else []:
                if each["name"] == engine and preset in (None, each["preset"]):
                    for one in each["runs"]:
                        if one["base"] and one["folder"] and one["status"] == "ok":
                            return Run(self.path.parent / one["folder"])
        raise KeyError(f"no run of {case} on {engine}")

    def plots(self, out=None):
        """The report's figures as PDF at print size. @return {name: path}"""
        folder = out or self.path.parent / "export"
        made = [
            Path(name) for name in json.loads(call(["export", self.path, "--pdf", "--json", "--out", folder]))["files"]
        ]
        return {path.stem: path for path in made}

    def report(self):
        """The pages of the report. @return the front page"""
        call(["report", self.path])
        return self.path.parent / "index.html"


def read_table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return [
            {key: (cell or None) if key in TEXTS else value_of(cell) for key, cell in row.items()}
            for row in csv.DictReader(file)
        ]


def value_of(cell):
    if cell == "":
        return None
    if cell in ("True", "False"):
        return cell == "True"
    try:
        number = float(cell)
    except ValueError:
        return cell
    return int(cell) if cell.lstrip("-").isdigit() else number


def validate(*cases, out=None, quiet=True, report=False, **options):
    """Runs and judges cases. Options are those of `tripoint validate`: engines=["bullet"], profile, tag, jobs, seed,
    engine, ...

    A failed gate is a verdict, not an error: see Results.verdict. @raises ProgramError for bad input
    """
    folder = Path(out) if out else Path(tempfile.mkdtemp(prefix="tripoint-validate-"))
    call(["validate", *cases, "--out", folder, *words_of({"no_report": not report, **options})], quiet, VERDICTS)
    return Results(folder)


def compare(case, engines, out=None, quiet=True, **options):
    """One case on several engines. @return Results"""
    folder = Path(out) if out else Path(tempfile.mkdtemp(prefix="tripoint-compare-"))
    call(["compare", case, "--engines", ",".join(engines), "--out", folder, *words_of(options)], quiet, VERDICTS)
    return Results(folder)


def read_results(path):
    """results.json, or the folder of a report."""
    return Results(path)
