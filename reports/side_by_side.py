# SPDX-License-Identifier: BSD-3-Clause
"""The page "engines side by side": each metric of each case that two engines or more ran, at the case's own
resolution."""

from __future__ import annotations

from dataclasses import dataclass, field

import digit_cost
import summary
from headline_parts import own_engines
from model import is_number, number, text

EXACT = "exact"


@dataclass
class Cell:
    value: float | None = None
    uncertainty: float | None = None
    verdict: str = ""
    physics: str = ""
    best: bool = False
    off: bool = False  # the engine is wrong in this case, or has a known defect there: nothing of it is green or bold


@dataclass
class Comparison:
    case: object
    columns: list  # labels of the engines that ran, the user's own first: engine, preset, mode
    own: list  # those of the user's own
    absent: dict  # {why it did not run: labels}
    cost: dict  # label -> (CPU seconds, times the cheapest, whether that is outside the noise floor; None = not known)
    floor: float | None  # factor by which an engine's seconds differed from themselves; None = runs were made once
    metrics: list  # (name, unit, {label: Cell})
    agreements: list = field(default_factory=list)  # rows of the equivalence table


def read(results):
    own = own_engines(results)
    return [comparison for case in results.cases if (comparison := compare(case, own))]


def compare(case, own=()):
    shown = shown_runs(case)
    sound = {label: run for label, (_, _, run) in shown.items() if run is not None and run.status == "ok"}
    if len({shown[label][0].name for label in sound}) < 2:
        return None
    rows = [row for metric in case.metrics for row in [metric_row(metric, shown)] if row]
    floor = digit_cost.floor_of(case)
    mine = [label for label in sound if shown[label][0].name in own]
    columns = mine + [label for label in sound if label not in mine]
    return Comparison(case, columns, mine, absent(shown), costs(sound, floor), floor, rows, case.equivalence)


def absent(shown):
    """{why it did not run: labels}"""
    found = {}
    for label, (engine, _, run) in shown.items():
        if why := why_not(engine, run):
            found.setdefault(why, []).append(label)
    return found


def why_not(engine, run):
    if run is None:
        return engine.reason or engine.status
    return "" if run.status == "ok" else run.reason or run.status


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
    """(name, unit, {label: Cell}), the smallest error of the engines that are right marked; None where no engine has a
    number."""
    name = text(metric.get("name"))
    cells = {label: cell(engine, mode, run, name) for label, (engine, mode, run) in shown.items()}
    known = [c for c in cells.values() if is_number(c.value)]
    sound = [c for c in known if not c.off]
    least = min((abs(c.value) for c in sound), default=0.0)
    for c in sound:
        c.best = len(known) > 1 and abs(c.value) <= least and max(abs(other.value) for other in known) > 1e-12
    return (name, text(metric.get("unit")), cells) if known else None


def cell(engine, mode, run, name):
    if why_not(engine, run):
        return Cell()
    metric = run.metrics.get(name)
    gates = [gate for gate in engine.gates if gate.metric == name and gate.mode in ("", mode)]
    return Cell(
        metric.value if metric else None,
        metric.u if metric else None,
        summary.worst(gate.verdict for gate in gates),
        summary.physics_of(gates),
        off=any(gate.physics in (summary.WRONG, summary.DEFECT) for gate in engine.gates if gate.mode in ("", mode)),
    )
