# SPDX-License-Identifier: BSD-3-Clause
"""The page "Table 1": the paper's nine features, and beside each what the results measured, engine by engine.

table1.toml holds what the paper's text kept of its table. A cell lists the runs of the cases that carry the feature's
tag with their numbers, or the engine's own words why there are none.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import animation
from model import Case, number, rows, text
from summary import AS_EXPECTED, gate_word, is_defect, physics_of, tone, worst

ROWS = Path(__file__).resolve().parent / "table1.toml"
COLUMNS = (
    ("ours, corrected", "tripoint", "corrected"),
    ("ours, paper", "tripoint", "paper"),
    ("LAMMPS", "lammps", ""),
    ("Bullet", "bullet", ""),
)
PREDICTED = "predicted defect"


@dataclass
class Entry:
    """One case by one engine in one cell."""

    case: Case
    engine: str
    word: str
    tone: str
    lines: list = field(default_factory=list)


@dataclass
class Feature:
    name: str
    meaning: str
    marks: str
    tag: str
    cells: list = field(
        default_factory=list
    )  # one list of entries a column; an empty list with a reason where there is none
    reasons: list = field(default_factory=list)


def read(results, path=ROWS):
    """@return (features, systems, films, notes)"""
    try:
        document = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        return [], [], [], [f"{Path(path).name} cannot be read: {error}"]
    systems = [text(name) for name in document.get("systems", [])]
    return (
        [feature(raw, results, len(systems)) for raw in rows(document.get("feature"))],
        systems,
        animation.films(results, rows(document.get("animation"))),
        [],
    )


def feature(raw, results, systems):
    marks, beside = number(raw.get("marks")), number(raw.get("not_applicable"))
    made = Feature(
        text(raw.get("name")),
        text(raw.get("meaning")),
        f"{marks:.0f} of {systems}" + (f", {beside:.0f} not applicable" if beside else ""),
        text(raw.get("tag")),
    )
    cases = [case for case in results.cases if made.tag in tags(case)]
    for _, name, mode in COLUMNS:
        found = [
            entry(case, engine, mode)
            for case in cases
            for engine in case.engines
            if engine.name.split("-")[0] == name and (not mode or mode in engine.modes or not engine.runs)
        ]
        made.cells.append(found)
        made.reasons.append(
            ""
            if found
            else f"no case of these results carries the tag {made.tag}"
            if not cases
            else "its cases do not run this mode"
            if mode
            else "its cases do not ask this engine"
        )
    return made


def tags(case):
    listed = case.raw.get("tags")
    return listed if isinstance(listed, list) else []


def entry(case, engine, mode):
    made = Entry(case, engine.label, engine.status, tone(engine.status))
    gates = [gate for gate in engine.gates if not mode or gate.mode in (mode, "")]
    gates.sort(key=lambda gate: (gate.verdict == "PASS", not is_predicted(gate)))  # what is not as claimed first
    if gates:
        judged_entry(made, gates)
    elif engine.status != "ok":
        made.lines = [engine.reason or "no reason stated"]
    else:
        made.word, made.tone = "measured, not judged", "none"
        made.lines = measured_lines(case, engine, mode)
    return made


def is_predicted(gate):
    return gate.reason.startswith(PREDICTED)


def judged_entry(made, gates):
    physics = physics_of(gates)
    made.word = gate_word(worst(gate.verdict for gate in gates), physics)
    if made.word == AS_EXPECTED and is_defect(physics):
        made.word = PREDICTED if any(map(is_predicted, gates)) else physics
    made.tone = "open" if made.word == PREDICTED else tone(made.word)
    made.lines = [
        (
            gate.metric,
            gate.value,
            gate.allowed,
            made.case.units.get(gate.metric, ""),
            gate.why or (gate.reason if is_predicted(gate) else ""),
        )
        for gate in gates
    ]


def measured_lines(case, engine, mode):
    run = next((run for run in engine.runs if run.base and (not mode or run.mode == mode)), None)
    if not run:
        return ["no run at the case's own resolution"]
    return [(name, metric.value, "", case.units.get(name, ""), metric.note) for name, metric in run.metrics.items()]
