# SPDX-License-Identifier: BSD-3-Clause
"""Reads the history: JSON lines that every `tripoint validate` and `gate accept` appended to, a case a line.

A line that is torn, of another format or without a case is counted and left out: a history outlives versions.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import foreign
from model import number, rows, text

MOST_BYTES = 200_000_000


@dataclass
class Entry:
    date: str
    commit: str
    verdict: str
    accepted: str = ""  # the reason, where the line marks an acceptance
    used: dict = field(default_factory=dict)  # (engine, mode, metric, level) -> (share of the limit, value, verdict)
    machine: str = ""


def read(path):
    """@return ({case: [Entry]}, oldest first, and notes)"""
    found, notes, bad = {}, [], 0
    path = Path(path)
    if not path.is_file():
        return found, notes
    if path.stat().st_size > MOST_BYTES:
        return found, [f"{path.name} is larger than {MOST_BYTES // 1_000_000} MB and was not read"]
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        try:
            raw = foreign.parsed(line)
        except (ValueError, RecursionError):
            raw = None
        if not isinstance(raw, dict) or raw.get("format") != 1 or not text(raw.get("case")):
            bad += 1
            continue
        entries, entry = found.setdefault(text(raw["case"]), []), read_entry(raw)
        if not any(same(entry, other) for other in entries):  # `gate --history` may have written it again
            entries.append(entry)
    for entries in found.values():
        entries.sort(key=lambda entry: (entry.date, bool(entry.accepted)))
    return found, notes + ([f"{bad} lines of {path.name} could not be read"] if bad else [])


def same(a, b):
    return (a.date, a.commit, a.accepted, a.machine) == (b.date, b.commit, b.accepted, b.machine)


def read_entry(raw):
    used = {}
    for gate in rows(raw.get("gates")):
        level = number(gate.get("level"))
        preset = text(gate.get("preset"))
        engine = text(gate.get("engine")) + (f" ({preset})" if preset not in ("", "default") else "")
        used[(engine, text(gate.get("mode")), text(gate.get("metric")), level)] = (
            number(gate.get("used")),
            number(gate.get("value")),
            text(gate.get("verdict")),
        )
    return Entry(
        text(raw.get("date")),
        text(raw.get("commit")),
        text(raw.get("verdict")),
        text(raw.get("accepted")),
        used,
        text(raw.get("cpu")),
    )
