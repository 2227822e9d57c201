# SPDX-License-Identifier: BSD-3-Clause
"""The page "engines side by side": each metric of each case that two engines or more ran, at the case's own
resolution."""

from __future__ import annotations

from dataclasses import dataclass, field

import digit_cost
import summary
from model import is_number, number, text

EXACT = "exact"


@dataclass
class Cell:
    value: float | None = None
    uncertainty: float | None = None
    verdict: str = ""
    physics: str = ""
    best: bool = False
    word: str = ""


@dataclass
class Comparison:
    case: object
    columns: list  # labels: engine, preset, mode
    cost: dict  # label -> (CPU seconds, times the cheapest, whether that is outside the noise floor; None = not known)
    floor: float | None  # factor by which an engine's seconds differed from themselves; None = runs were made once
    metrics: list  # (name, unit, {label: Cell})
    agreements: list = field(default_factory=list)  # rows of the equivalence table


def read(results):
    return [comparison for comparison in map(compare, results.cases) if comparison]


def compare(case):
    shown = {}
    for engine in case.engines:
        if engine.name == EXACT:
            continue
        for mode in engine.modes:
            run = next((run for run in engine.runs if run.mode == mode and run.base), None) or next(
                (run for run in engine.runs if run.mode == mode), None
            )
            if run is not None or engine.status != "ok":
                shown[engine.label + (f", {mode}" if mode else "")] = (engine, mode, run)
    if len({engine.name for engine, _, run in shown.values() if run is not None and run.status == "ok"}) < 2:
        return None
    seconds = {
        label: number(run.cost.get("cpu_s"))
        for label, (_, _, run) in shown.items()
        if run is not None and run.status == "ok"
    }
    seconds = {label: s for label, s in seconds.items() if is_number(s) and s > 0}
    least = min(seconds.values(), default=None)
    rows = []
    for metric in case.metrics:
        name = text(metric.get("name"))
        cells = {label: cell(engine, mode, run, name) for label, (engine, mode, run) in shown.items()}
        sizes = [abs(c.value) for c in cells.values() if is_number(c.value)]
        for c in cells.values():
            c.best = len(sizes) > 1 and is_number(c.value) and abs(c.value) <= min(sizes) and max(sizes) > 1e-12
        if any(is_number(c.value) for c in cells.values()):
            rows.append((name, text(metric.get("unit")), cells))
    floor = digit_cost.floor_of(case)
    return Comparison(
        case,
        list(shown),
        {label: (s, s / least, s == least or s / least > floor if floor else None) for label, s in seconds.items()},
        floor,
        rows,
        case.equivalence,
    )


def cell(engine, mode, run, name):
    if run is None or run.status != "ok":
        return Cell(word=(run.reason or run.status) if run is not None else engine.reason or engine.status)
    metric = run.metrics.get(name)
    gates = [gate for gate in engine.gates if gate.metric == name and gate.mode in ("", mode)]
    return Cell(
        metric.value if metric else None,
        metric.u if metric else None,
        summary.worst(gate.verdict for gate in gates),
        summary.physics_of(gates),
    )
