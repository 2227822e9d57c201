# SPDX-License-Identifier: BSD-3-Clause
"""What every figure of a case asks: which curves there are, and which runs belong to each."""

from __future__ import annotations

from dataclasses import dataclass

from model import COUNTED, Case, Engine, is_number


@dataclass
class Curve:
    """One engine with one preset in one mode: one colour, marker and line style."""

    case: Case
    engine: Engine
    mode: str
    runs: list

    @property
    def label(self):
        several = len({run.mode for engine in self.case.engines for run in engine.runs if run.mode}) > 1
        return (
            f"{self.engine.label} ({self.mode})"
            if several and self.mode and self.engine.name != "exact"
            else self.engine.label
        )

    @property
    def shown(self):
        """The run that pictures and curves show: of the case's own resolution, which all engines share, else the
        finest."""
        sound = [run for run in self.runs if run.status == "ok"]
        sound = [run for run in sound if run.base] or sound

        def key(run):
            return (
                run.knob("spacing") or 0,
                run.knob("time_step") or 0,
                -(run.knob("walkers") or 0),
                -(run.knob("iterations") or 0),
                run.number,
            )

        return min(sound, key=key) if sound else None


@dataclass
class Drawing:
    """A figure that is ready for the page."""

    name: str
    title: str
    alt: str
    figure: object
    caption: str = ""


def label_metric(axis, case, metric):
    """Name at the axis; a unit of several words stands over the panel."""
    unit = case.units.get(metric) or (
        "0: equal" if any(row.get("name") == metric and row.get("quantity") in COUNTED for row in case.metrics) else ""
    )
    axis.set_ylabel(f"{metric} [{unit}]" if unit and len(unit) < 9 else metric)
    if len(unit) >= 9:
        axis.set_title(unit, loc="right", fontsize=8)


def curves(case):
    """In the order of results.json."""
    result = []
    for engine in case.engines:
        for mode in dict.fromkeys(run.mode for run in engine.runs):
            result.append(Curve(case, engine, mode, [run for run in engine.runs if run.mode == mode]))
    return result


def judged(case):
    """Without `exact`: it evaluates the reference, its round-off says nothing of a method."""
    return [curve for curve in curves(case) if curve.engine.name != "exact"]


def metrics(case, wanted=4):
    """(names to draw, other names): with a value that is not zero; a study's metrics alone where there are any, else
    gated ones first."""
    studied = [order.metric for engine in case.engines for order in engine.orders]
    gated = [gate.metric for engine in case.engines for gate in engine.gates]
    found = [entry for engine in case.engines for run in engine.runs for entry in run.metrics.items()]
    drawn = {name for name, m in found if is_number(m.value) and m.value != 0}
    ordered = [name for name in dict.fromkeys(studied + gated + list(dict(found))) if name in drawn]
    most = min(wanted, sum(name in studied for name in ordered) or wanted)
    return ordered[:most], ordered[most:]
