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
    shown = shown_runs(case)
    sound = {label: run for label, (_, _, run) in shown.items() if run is not None and run.status == "ok"}
    if len({shown[label][0].name for label in sound}) < 2:
        return None
    rows = [row for metric in case.metrics for row in [metric_row(metric, shown)] if row]
    floor = digit_cost.floor_of(case)
    return Comparison(case, list(shown), costs(sound, floor), floor, rows, case.equivalence)


def shown_runs(case):
    """{label: (engine, mode, its run at the case's own resolution, else any; None where it has none)}"""
    shown = {}
    for engine in case.engines:
        for mode in engine.modes if engine.name != EXACT else ():
            runs = sorted((run for run in engine.runs if run.mode == mode), key=lambda run: not run.base)
            if runs or engine.status != "ok":
                shown[engine.label + (f", {mode}" if mode else "")] = (engine, mode, runs[0] if runs else None)
    return shown


def costs(sound, floor):
    seconds = {label: number(run.cost.get("cpu_s")) for label, run in sound.items()}
    seconds = {label: s for label, s in seconds.items() if is_number(s) and s > 0}
    least = min(seconds.values(), default=None)
    return {label: (s, s / least, s == least or s / least > floor if floor else None) for label, s in seconds.items()}


def metric_row(metric, shown):
    """(name, unit, {label: Cell}), the smallest errors marked; None where no engine has a number."""
    name = text(metric.get("name"))
    cells = {label: cell(engine, mode, run, name) for label, (engine, mode, run) in shown.items()}
    known = [c for c in cells.values() if is_number(c.value)]
    sizes = [abs(c.value) for c in known]
    for c in known:
        c.best = len(sizes) > 1 and abs(c.value) <= min(sizes) and max(sizes) > 1e-12
    return (name, text(metric.get("unit")), cells) if known else None


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
