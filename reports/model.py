# SPDX-License-Identifier: BSD-3-Clause
"""What results.json holds, as plain data for the page and the figures.

A number is a float, NaN where the file says that it was not finite, and None where there is none; the three look
different on the page.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path


COUNTED = (
    "body_count",
    "bonded_objects",
    "object_count",
    "phase_count",
    "event_count",
)  # quantities that count; their metric is the distance to the number that the case states


def number(value, finite=True):
    """A float; NaN for what was not finite; None for what is not a number at all."""
    if value is None:
        return None if finite is not False else math.nan
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    try:
        return float(value)
    except OverflowError:  # an integer beyond the range of double
        return math.inf


def is_number(value):
    return value is not None and math.isfinite(value)


def text(value, default=""):
    if isinstance(value, str):
        return value
    return default if value is None or isinstance(value, (dict, list)) else str(value)


def table(value):
    return value if isinstance(value, dict) else {}


def rows(value):
    return [row for row in value if isinstance(row, dict)] if isinstance(value, list) else []


def combined(uncertainty):
    """Root sum of squares of the named standard uncertainties; a plain number is taken as it stands."""
    if isinstance(uncertainty, dict):
        parts = [number(part) for part in uncertainty.values()]
        parts = [part for part in parts if part is not None]
        return math.sqrt(sum(part * part for part in parts)) if parts else None
    return number(uncertainty)


def ordered(value, fit_class):
    """An observed order with its class of convergence."""
    if not is_number(value):
        return fit_class or "—"
    return f"{value:.1f}" + (f" ({fit_class})" if fit_class else "")


@dataclass
class Metric:
    value: float | None
    uncertainty: dict
    note: str = ""
    times: list = field(default_factory=list)  # the error in time, where the norm is over time
    series: list = field(default_factory=list)

    @property
    def u(self):
        return combined(self.uncertainty)


@dataclass
class Run:
    knobs: dict
    status: str
    reason: str
    metrics: dict
    cost: dict
    state_hash: str
    folder: str
    series: dict
    levels: dict  # study axis -> the level that this run is
    base: bool  # the case's own resolution
    number: int = 0

    @property
    def mode(self):
        return text(self.knobs.get("mode"))

    def knob(self, name):
        return number(self.knobs.get(name))

    @property
    def size(self):
        """The knobs that set the resolution, as text."""
        words = {
            "spacing": "dx {:.4g} m",
            "time_step": "dt {:.4g} s",
            "support_ratio": "h/dx {:.4g}",
            "walkers": "{:.0f} walkers",
            "iterations": "{:.0f} iterations",
            "jitter": "jitter {:.3g}",
            "seed": "seed {:.0f}",
        }
        parts = [(form, self.knob(key)) for key, form in words.items()]
        return ", ".join(
            form.format(value) for form, value in parts if is_number(value) and (value or "jitter" not in form)
        )


@dataclass
class Order:
    metric: str
    axis: str
    mode: str
    value: float | None
    low: float | None
    high: float | None
    fit_class: str
    formal: float | None
    coefficient: float | None  # error = floor + coefficient step^value
    floor: float | None
    points: list  # (step, error, standard uncertainty) that were fitted

    @property
    def words(self):
        """ "2.0 (asymptotic)": a number without its class may be that of a floor."""
        return ordered(self.value, self.fit_class)


@dataclass
class Gate:
    metric: str
    mode: str
    value: float | None
    uncertainty: float | None
    limit: float | None
    at_least: float | None
    band: tuple | None
    verdict: str
    reason: str  # of the limit
    why: str  # of a verdict that is not pass
    expect: str  # class of convergence that a study declares
    fit_class: str
    low: float | None  # an order's 95 % interval
    high: float | None
    level: float | None
    file: str
    line: str
    used: float | None = None  # share of the limit: 1 at the edge, above it outside; None where that has no meaning
    physics: str = ""  # right, known defect, wrong, not known; empty where an older version wrote the file
    defect: str = ""  # NAME of the known defect

    @property
    def allowed(self):
        if self.band:
            return f"{self.band[0]:.4g} to {self.band[1]:.4g}"
        if self.at_least is not None:
            return f"≥ {self.at_least:.4g}"
        if self.limit is not None:
            return f"≤ {self.limit:.4g}"
        return f"class {self.expect}" if self.expect else "none"


@dataclass
class Engine:
    name: str
    version: str
    preset: str
    required: bool
    status: str
    reason: str
    runs: list
    orders: list
    gates: list
    raw: dict
    physics: str = ""  # the worst of its gates

    @property
    def label(self):
        return f"{self.name} · {self.preset}" if self.preset and self.preset != "default" else self.name

    @property
    def modes(self):
        seen = [run.mode for run in self.runs] + [gate.mode for gate in self.gates]
        return list(dict.fromkeys(mode for mode in seen if mode)) or [""]


@dataclass
class Case:
    id: str
    title: str
    kind: str
    requirement: str
    claims: str
    file: str
    verdict: str
    reference: dict
    engines: list
    equivalence: list
    ledgers: list
    repeat: str
    number: int
    raw: dict
    metrics: list  # as declared
    units: dict  # metric -> unit
    notes: list = field(default_factory=list)
    history: list = field(default_factory=list)  # runs before, oldest first: history.Entry
    slug: str = ""  # its file name, without an ending
    physics: str = ""  # the worst of its engines

    @property
    def subject(self):
        return self.id.split("/")[0] if "/" in self.id else "other"


@dataclass
class Results:
    tool: dict
    command: str
    profile: str
    seed: str
    verdict: str
    exit_code: str
    cases: list
    folder: Path
    notes: list
    raw: dict
