# SPDX-License-Identifier: BSD-3-Clause
"""The page "the paper's figures": each figure that was run, how long a step and a film's frame took, and what it
claims.

A case belongs to it by its tag `paper`. The paper says of its figures: 0.5 s a frame at worst.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import table1
from model import Case, is_number

TAG = "paper"
ENGINE = "tripoint"
FRAME = 1.0 / 30.0  # s of the scene that a frame of a film shows
PAPERS_FRAME = 0.5  # s at worst, on a 2 GHz machine of 2007, with about 40 neighbours a particle


@dataclass
class Row:
    """One figure in one mode."""

    case: Case
    mode: str
    particles: float | None = None
    neighbours: float | None = None  # particles within the support, in bulk
    simulated: float | None = None  # s
    steps: float | None = None
    wall: float | None = None  # s, with the writing of its frames
    threads: float | None = None
    step: float | None = None  # ms
    frame: float | None = None  # s
    entry: table1.Entry | None = None
    why: str = ""


def read(results):
    """@return rows, the scenes with the most particles first"""
    found = [
        row(case, engine, run)
        for case in results.cases
        if TAG in table1.tags(case)
        for engine in case.engines
        if engine.name == ENGINE
        for run in engine.runs
        if run.base
    ]
    return sorted(found, key=lambda r: (-(r.particles or 0) // 10000, natural(r.case.title), r.mode))


def natural(title):
    """The title, with its numbers as numbers: figure 8 stands before figure 10."""
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in re.split(r"([0-9]+)", title)]


def pictures(results, out):
    """[(case, file without its ending, what it shows)] of the figures that were drawn, in the order of the ids."""
    found = [
        (case, f"figures/{case.slug}-particles", f"Particles of {case.title or case.id} in time")
        for case in sorted(results.cases, key=lambda case: case.id)
        if TAG in table1.tags(case)
    ]
    return [entry for entry in found if out is not None and (out / f"{entry[1]}.svg").is_file()]


def row(case, engine, run):
    made = Row(case, run.mode, entry=table1.entry(case, engine, run.mode))
    if run.status != "ok":
        made.why = run.reason or run.status
        return made
    cost, ratio = run.cost, run.knob("support_ratio")
    made.particles, made.simulated, made.steps, made.wall = (
        positive(cost.get(key)) for key in ("particles", "simulated_s", "steps", "wall_s")
    )
    made.threads = run.knob("threads")
    made.neighbours = 4.0 / 3.0 * math.pi * ratio**3 if is_number(ratio) else None
    stepping = made.wall - (positive(cost.get("setup_cpu_s")) or 0.0) if made.wall else None
    made.step = 1e3 * stepping / made.steps if stepping and made.steps else None
    made.frame = stepping * FRAME / made.simulated if stepping and made.simulated else None
    return made


def positive(value):
    return value if is_number(value) and value > 0 else None
