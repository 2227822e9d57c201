# SPDX-License-Identifier: BSD-3-Clause
"""Reads results.json.

The file may come from a third party, from an older version or from a run that broke off: a key that is missing or of
the wrong kind becomes a note on the page, never an exception.
"""

from __future__ import annotations

import re
from pathlib import Path

import foreign
import history
from model import Case, Engine, Gate, Metric, Order, Results, Run, combined, is_number, number, rows, table, text

STATUSES = ("ok", "refused", "missing", "diverged", "killed", "timeout", "error")
COSTS = ("cpu_s", "wall_s", "setup_cpu_s", "peak_bytes", "pairs", "steps", "simulated_s", "particles", "instructions")


class Unreadable(Exception):
    """results.json is absent, is not JSON or has no cases; the message says which."""


def load(path):
    """Reads results.json. @raises Unreadable"""
    path = Path(path)
    try:
        raw = foreign.read(path)
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror or error}") from error
    except (ValueError, RecursionError) as error:
        raise Unreadable(f"{path} is not JSON: {error}") from error
    if not isinstance(raw, dict) or not isinstance(raw.get("cases"), list):
        raise Unreadable(f"{path} has no list of cases")
    notes = (
        [] if raw.get("format") == 1 else [f"format {raw.get('format')!r} is not 1, which this report was written for"]
    )
    notes += problems(raw)
    notes += [
        f"the file has no {key}" for key in ("tool", "command", "profile", "verdict", "exit_code") if key not in raw
    ]
    cases = [read_case(row, index) for index, row in enumerate(rows(raw["cases"]))]
    past, remarks = history.read(path.resolve().parent / (text(raw.get("history")) or "history.jsonl"))
    notes += remarks
    for case in cases:
        case.history = past.get(case.id, [])
    name(cases)
    if not cases:
        notes.append("the file lists no case: nothing was validated")
    return Results(
        table(raw.get("tool")),
        text(raw.get("command")),
        text(raw.get("profile")),
        text(raw.get("seed")),
        text(raw.get("verdict"), "no verdict").upper(),
        text(raw.get("exit_code"), "?"),
        cases,
        path.resolve().parent,
        notes,
        raw,
    )


def name(cases):
    """Gives each case a file name that is safe, and distinct also where ids are not."""
    taken = set()
    for case in cases:
        stem = re.sub(r"[^A-Za-z0-9_-]+", "-", case.id).strip("-")[:60] or "case"
        case.slug = next(
            s for s in [stem] + [f"{stem}-{n}" for n in range(2, len(cases) + 2)] if s.lower() not in taken
        )
        taken.add(case.slug.lower())


def problems(raw):
    """Why a verdict is not pass, beyond what the gates say."""
    listed = raw.get("problems")
    return [text(line) for line in listed if text(line)] if isinstance(listed, list) else []


def read_case(raw, index):
    notes = [
        f"results.json has no {key} for this case"
        for key in ("title", "kind", "file", "verdict", "reference", "engines", "repeat")
        if key not in raw
    ] + problems(raw)
    notes += [
        f"no gate judges {name}: it is shown, not judged"
        for name in (raw.get("unjudged") if isinstance(raw.get("unjudged"), list) else [])
        if isinstance(name, str)
    ]
    metrics = rows(raw.get("metrics"))
    units = {text(m.get("name")): text(m.get("unit")) for m in metrics}
    engines = [read_engine(row, notes) for row in rows(raw.get("engines"))]
    return Case(
        text(raw.get("id"), f"case {index + 1}"),
        text(raw.get("title")),
        text(raw.get("kind")),
        text(raw.get("requirement")),
        text(raw.get("claims")),
        text(raw.get("file")),
        text(raw.get("verdict"), "no verdict").upper(),
        table(raw.get("reference")),
        engines,
        rows(raw.get("equivalence")),
        read_ledgers(raw, engines),
        text(raw.get("repeat")),
        index,
        raw,
        metrics,
        units,
        notes,
        physics=text(raw.get("physics")),
    )


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
    return Engine(
        name,
        text(raw.get("version")),
        text(raw.get("preset")),
        raw.get("required") is True,
        status,
        text(raw.get("reason")),
        runs,
        [read_order(row) for row in rows(raw.get("order"))],
        gates,
        raw,
        text(raw.get("physics")),
    )


def read_metric(raw):
    times, series = (raw.get(key) if isinstance(raw.get(key), list) else [] for key in ("times", "series"))
    return Metric(
        number(raw.get("value"), raw.get("finite")), table(raw.get("uncertainty")), text(raw.get("note")), times, series
    )


def read_run(raw):
    metrics = {key: read_metric(table(m)) for key, m in table(raw.get("metrics")).items()}
    cost = {key: number(table(raw.get("cost")).get(key)) for key in COSTS}
    timed = table(table(raw.get("cost")).get("timed"))
    if is_number(number(timed.get("median"))):  # interleaved rounds say more than the one run before them
        cost["cpu_s"] = number(timed.get("median"))
    return Run(
        table(raw.get("knobs")),
        text(raw.get("status"), "ok"),
        text(raw.get("reason") or raw.get("message")),
        metrics,
        cost,
        text(raw.get("state_hash")),
        text(raw.get("folder")),
        table(raw.get("series")),
        table(raw.get("levels")),
        raw.get("base") is True,
    )


def read_order(raw):
    step, error, u = (
        [number(v) for v in raw.get(key)] if isinstance(raw.get(key), list) else []
        for key in ("step", "error", "uncertainty")
    )
    points = [
        (x, abs(e), s if is_number(s) else 0.0)
        for x, e, s in zip(step, error, u + [0.0] * len(step))
        if is_number(x) and is_number(e) and x > 0 and e != 0
    ]
    return Order(
        text(raw.get("metric")),
        text(raw.get("axis")),
        text(raw.get("mode")),
        number(raw.get("value"), raw.get("finite")),
        number(raw.get("low")),
        number(raw.get("high")),
        text(raw.get("class")),
        number(raw.get("formal")),
        number(raw.get("coefficient")),
        number(raw.get("floor")),
        sorted(points),
    )


def read_gate(raw):
    band = raw.get("band")
    band = tuple(number(edge) for edge in band) if isinstance(band, list) and len(band) == 2 else None
    return Gate(
        text(raw.get("metric")),
        text(raw.get("mode")),
        number(raw.get("value"), raw.get("finite")),
        combined(raw.get("uncertainty")),
        number(raw.get("limit")),
        number(raw.get("at_least")),
        band if band and None not in band else None,
        text(raw.get("verdict"), "no verdict").upper(),
        text(raw.get("reason")),
        text(raw.get("why")),
        text(raw.get("expect")),
        text(raw.get("class")),
        number(raw.get("low")),
        number(raw.get("high")),
        number(raw.get("level")),
        text(raw.get("file")),
        text(raw.get("line")),
        number(raw.get("used")),
        text(raw.get("physics")),
        text(raw.get("defect")),
    )


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
