# SPDX-License-Identifier: BSD-3-Clause
"""results.json as objects that the page and the figures can rely on.

The file may come from a stranger, from an older version or from a run that broke off: a key that is missing or of the
wrong kind becomes a note on the page, never an exception. A number is a float, NaN where the file says that it was not
finite, and None where there is none; the three look different on the page.
"""
from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from pathlib import Path

STATUSES = ("ok", "refused", "missing", "diverged", "killed", "timeout", "error")
COSTS = ("cpu_s", "wall_s", "setup_cpu_s", "peak_bytes", "pairs", "steps", "instructions")


class Unreadable(Exception):
    """results.json is absent, is not JSON or has no cases; the message says which."""


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
    number: int = 0

    @property
    def mode(self):
        return text(self.knobs.get("mode"))

    def knob(self, name):
        return number(self.knobs.get(name))

    @property
    def size(self):
        """The knobs that set the resolution, as text."""
        units = {"spacing": " m", "time_step": " s"}
        parts = [(key, self.knob(key)) for key in ("spacing", "time_step", "support_ratio", "walkers", "iterations")]
        return ", ".join(f"{key.replace('_', ' ')} {value:.4g}{units.get(key, '')}" for key, value in parts if is_number(value))


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
    why: str     # of a verdict that is not pass
    expect: str  # class of convergence that a study declares
    fit_class: str
    low: float | None  # an order's 95 % interval
    high: float | None
    level: float | None
    file: str
    line: str

    @property
    def allowed(self):
        if self.band:
            return f"{self.band[0]:.4g} to {self.band[1]:.4g}"
        if self.at_least is not None:
            return f"≥ {self.at_least:.4g}"
        if self.limit is not None:
            return f"≤ {self.limit:.4g}"
        return f"class {self.expect}" if self.expect else "none"

    @property
    def used(self):
        """Share of the limit that is used: 1 at the limit, above it outside; None where that has no meaning."""
        if not is_number(self.value):
            return None
        if self.band:
            half = 0.5 * (self.band[1] - self.band[0])
            return abs(self.value - 0.5 * (self.band[0] + self.band[1])) / half if half > 0 else None
        if self.at_least is not None:
            return self.at_least / self.value if self.value > 0 and self.at_least > 0 else None
        return abs(self.value) / self.limit if self.limit is not None and self.limit > 0 else None


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
    units: dict    # metric -> unit
    notes: list = field(default_factory=list)


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


def load(path):
    """Reads results.json. @raises Unreadable"""
    path = Path(path)
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:
        raise Unreadable(f"{path} is not JSON: {error}") from error
    if not isinstance(raw, dict) or not isinstance(raw.get("cases"), list):
        raise Unreadable(f"{path} has no list of cases")
    notes = [] if raw.get("format") == 1 else [f"format {raw.get('format')!r} is not 1, which this report was written for"]
    notes += problems(raw)
    notes += [f"the file has no {key}" for key in ("tool", "command", "profile", "verdict", "exit_code") if key not in raw]
    cases = [read_case(row, index) for index, row in enumerate(rows(raw["cases"]))]
    if not cases:
        notes.append("the file lists no case: nothing was validated")
    return Results(table(raw.get("tool")), text(raw.get("command")), text(raw.get("profile")), text(raw.get("seed")),
                   text(raw.get("verdict"), "no verdict").upper(), text(raw.get("exit_code"), "?"), cases,
                   path.resolve().parent, notes, raw)


def problems(raw):
    """Why a verdict is not pass, beyond what the gates say."""
    listed = raw.get("problems")
    return [text(line) for line in listed if text(line)] if isinstance(listed, list) else []


def read_case(raw, index):
    notes = [f"results.json has no {key} for this case" for key in ("title", "kind", "file", "verdict", "reference", "engines", "repeat")
             if key not in raw] + problems(raw)
    metrics = rows(raw.get("metrics"))
    units = {text(m.get("name")): text(m.get("unit")) for m in metrics}
    engines = [read_engine(row, notes) for row in rows(raw.get("engines"))]
    return Case(text(raw.get("id"), f"case {index + 1}"), text(raw.get("title")), text(raw.get("kind")), text(raw.get("requirement")),
                text(raw.get("claims")), text(raw.get("file")), text(raw.get("verdict"), "no verdict").upper(), table(raw.get("reference")),
                engines, rows(raw.get("equivalence")), read_ledgers(raw, engines), text(raw.get("repeat")), index, raw, metrics, units, notes)


def read_engine(raw, notes):
    name = text(raw.get("name"), "unnamed engine")
    status = text(raw.get("status"), "unknown")
    if status not in STATUSES:
        notes.append(f"{name}: status {status!r} is none of {', '.join(STATUSES)}")
    gates = [read_gate(row) for row in rows(raw.get("gates"))]
    runs = [read_run(row) for row in rows(raw.get("runs"))]
    for index, run in enumerate(runs):
        run.number = index
    if status == "ok" and not runs:
        notes.append(f"{name}: status is ok but no run is listed")
    return Engine(name, text(raw.get("version")), text(raw.get("preset")), raw.get("required") is True, status, text(raw.get("reason")),
                  runs, [read_order(row) for row in rows(raw.get("order"))], gates, raw)


def read_metric(raw):
    times, series = (raw.get(key) if isinstance(raw.get(key), list) else [] for key in ("times", "series"))
    return Metric(number(raw.get("value"), raw.get("finite")), table(raw.get("uncertainty")), text(raw.get("note")), times, series)


def read_run(raw):
    metrics = {key: read_metric(table(m)) for key, m in table(raw.get("metrics")).items()}
    cost = {key: number(table(raw.get("cost")).get(key)) for key in COSTS}
    return Run(table(raw.get("knobs")), text(raw.get("status"), "ok"), text(raw.get("reason") or raw.get("message")), metrics, cost,
               text(raw.get("state_hash")), text(raw.get("folder")), table(raw.get("series")), table(raw.get("levels")))


def read_order(raw):
    step, error, u = ([number(v) for v in raw.get(key)] if isinstance(raw.get(key), list) else [] for key in ("step", "error", "uncertainty"))
    points = [(x, abs(e), s if is_number(s) else 0.0) for x, e, s in zip(step, error, u + [0.0] * len(step)) if is_number(x) and is_number(e) and x > 0 and e != 0]
    return Order(text(raw.get("metric")), text(raw.get("axis")), text(raw.get("mode")), number(raw.get("value"), raw.get("finite")),
                 number(raw.get("low")), number(raw.get("high")), text(raw.get("class")), number(raw.get("formal")), number(raw.get("coefficient")), number(raw.get("floor")), sorted(points))


def read_gate(raw):
    band = raw.get("band")
    band = tuple(number(edge) for edge in band) if isinstance(band, list) and len(band) == 2 else None
    return Gate(text(raw.get("metric")), text(raw.get("mode")), number(raw.get("value"), raw.get("finite")), combined(raw.get("uncertainty")),
                number(raw.get("limit")), number(raw.get("at_least")), band if band and None not in band else None,
                text(raw.get("verdict"), "no verdict").upper(), text(raw.get("reason")), text(raw.get("why")), text(raw.get("expect")),
                text(raw.get("class")), number(raw.get("low")), number(raw.get("high")), number(raw.get("level")), text(raw.get("file")), text(raw.get("line")))


def read_ledgers(raw, engines):
    """[(whose, {term: number})]: of the case, of each engine named in it, or of each engine's own object."""
    found, plain = [], {}
    for key, value in table(raw.get("ledger")).items():
        if isinstance(value, dict) and "value" not in value:
            found.append((key, {term: number(v) for term, v in value.items()}))
        else:
            plain[key] = number(value.get("value"), value.get("finite")) if isinstance(value, dict) else number(value)
    if plain:
        found.insert(0, ("case", plain))
    for engine in engines:
        if isinstance(engine.raw.get("ledger"), dict):
            found.append((engine.label, {term: number(v) for term, v in engine.raw["ledger"].items()}))
    return found
