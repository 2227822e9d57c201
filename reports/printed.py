# SPDX-License-Identifier: BSD-3-Clause
"""The page "what the printed equations do": predicted defects beside what the results measured.

printed_equations.toml says what is predicted and where it is measured; every measured figure and every verdict is taken
from results.json. A case that was not run is said to be so.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from model import Case, is_number, number, rows, table, text

ROWS = Path(__file__).resolve().parent / "printed_equations.toml"
ENGINE = "tripoint"
WORDS = {
    "PASS": ("predicted defect seen", "open"),
    "FAIL": ("not as predicted", "fail"),
    "INCONCLUSIVE": ("inconclusive", "none"),
    "MISSING": ("not measured", "none"),
    "DIVERGED": ("diverged", "fail"),
}


@dataclass
class Figure:
    """One measured number in the row's unit, or why there is none."""

    value: float | None = None
    uncertainty: float | None = None
    resolution: list = field(default_factory=list)
    why: str = ""


@dataclass
class Row:
    equation: str
    defect: str
    predicted: str
    source: str
    shown: str
    case_id: str
    case: Case | None
    paper: Figure = field(default_factory=Figure)
    corrected: Figure = field(default_factory=Figure)
    verdict: str = ""
    tone: str = "none"
    why: str = ""


def read(results, path=ROWS):
    """@return rows in the order of the file, and notes on a file that cannot be read"""
    try:
        listed = rows(tomllib.loads(Path(path).read_text(encoding="utf-8")).get("row"))
    except (OSError, ValueError) as error:
        return [], [f"{Path(path).name} cannot be read: {error}"]
    cases = {case.id: case for case in results.cases}
    return [fill(raw, cases.get(text(raw.get("case")))) for raw in listed], []


def fill(raw, case):
    row = Row(
        text(raw.get("equation")),
        text(raw.get("defect")),
        text(raw.get("predicted")),
        text(raw.get("source")),
        text(raw.get("shown")),
        text(raw.get("case")),
        case,
    )
    if case is None:
        row.verdict, row.why = "not run", "the results hold no case of this id"
        return row
    engine = next((e for e in case.engines if e.name == ENGINE), None)
    if engine is None or not engine.runs:
        row.verdict, row.why = (
            "not run",
            (engine.reason or engine.status) if engine else f"the case does not list {ENGINE}",
        )
        return row
    row.paper, row.corrected = (
        figure(table(raw.get(mode)), mode, engine, number(raw.get("level"))) for mode in ("paper", "corrected")
    )
    judge(row, text(raw.get("gate")), engine)
    return row


def figure(wanted, mode, engine, level):
    """The metric of the run of this mode at the level, else at the case's own resolution."""
    name = text(wanted.get("metric"))
    run = run_at([run for run in engine.runs if run.mode == mode], level)
    if run is None:
        return Figure(why="this mode was not run")
    if run.status != "ok":
        return Figure(resolution=steps(run), why=run.reason or run.status)
    if name not in run.metrics:
        return Figure(resolution=steps(run), why=run.reason or f"no metric {name}")
    add, times = number(wanted.get("add")) or 0.0, number(wanted.get("times")) or 1.0
    metric = run.metrics[name]
    return Figure(
        None if metric.value is None else add + times * metric.value,
        abs(times) * metric.u if metric.u else None,
        steps(run),
    )


def run_at(runs, level):
    """The first run at the level, else one at the case's own resolution, else any; None of none."""
    at_level = [run for run in runs if level is not None and is_near(run.levels.values(), level)]
    return next(iter(at_level + [run for run in runs if run.base] + runs), None)


def is_near(values, level):
    return any(is_number(v) and abs(v - level) <= 1e-9 * level for v in map(number, values))


def steps(run):
    """Spacing and time step in short: the case's section has the rest."""
    return [part for part in run.size.split(", ") if part.startswith(("dx ", "dt "))]


def judge(row, name, engine):
    """The verdict is that of the gate that holds the prediction: it is met, or the prediction is refuted."""
    gates = [gate for gate in engine.gates if gate.metric == name and gate.mode == "paper"]
    if not gates:
        row.verdict, row.why = "measured, not judged", f"the case has no gate on {name} in paper mode"
        return
    worst = next((gate for gate in gates if gate.verdict != "PASS"), gates[0])
    row.verdict, row.tone = WORDS.get(worst.verdict, (worst.verdict.lower(), "none"))
    row.why = worst.why or f"gate {name}: {worst.allowed}"
