# SPDX-License-Identifier: BSD-3-Clause
"""The pieces of the headline pages: their table, the runs that they show, and the words of their sentences."""

from __future__ import annotations

import shlex
from dataclasses import dataclass, field
from pathlib import Path

from model import is_number


@dataclass
class Line:
    """One engine in the table."""

    label: str
    cells: list
    tone: str = ""
    own: bool = False  # of the engine that the user brought


@dataclass
class Page:
    file: str
    question: str
    answer: str
    picture: object
    columns: list
    lines: list
    notes: list = field(default_factory=list)
    cases: list = field(default_factory=list)  # whose numbers these are


def case_of(results, case_id):
    return next((case for case in results.cases if case.id == case_id), None)


def runs_of(case, printed=False):
    """(engine, run) of each engine and preset at the case's own resolution; of ours the corrected form, or the printed
    one alone."""
    found = []
    for engine in case.engines:
        run = next(
            (run for run in engine.runs if run.base and run.status == "ok" and (run.mode == "paper") == printed), None
        )
        if run is not None:
            found.append((engine, run))
    return found


def step_of(run):
    """The run's time step as text, in milliseconds."""
    step = run.knob("time_step")
    return f"{1e3 * step:.4g} ms" if is_number(step) else "—"


def value(run, metric):
    found = run.metrics.get(metric)
    return found.value if found is not None and is_number(found.value) else None


def join(words):
    return ", ".join(words[:-1]) + " and " + words[-1] if len(words) > 1 else "".join(words)


def share(number):
    """A share as percent with two digits."""
    size = 100 * abs(number)
    return f"{size:.0f} %" if size >= 9.95 else f"{size:.2g} %" if size >= 0.0995 else "< 0.1 %"


def count(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def of_all(some, every):
    """ "3 of 4 engines and presets"."""
    return f"{some} of {count(every, 'engine and preset') if every == 1 else f'{every} engines and presets'}"


def own_engines(results):
    """Names of the engines that the user brought: those after `all` of --engines, and the paths that it names."""
    try:
        words = shlex.split(results.command)
    except ValueError:
        return []
    words = [part for word in words for part in (word.split("=", 1) if word.startswith("--") else [word])]
    given = []
    for option, value in zip(words, words[1:]):
        names = value.split(",")
        if option == "--engine":  # an earlier spelling
            given.append(value)
        if option == "--engines":
            given += [name for name in names if name != "all" and ("all" in names or "/" in name)]
    return [Path(path).name.removeprefix("engine-").split("@")[0] for path in given]


def by_engine(labels):
    """Presets of one engine in one word: ["a · x", "a · y", "b"] -> {"a (x, y)": labels, "b": labels}, in the order in
    which engines come first."""
    found = {}
    for label in labels:
        found.setdefault(label.split(" · ")[0], []).append(label)
    return {
        name
        if members == [name]
        else f"{name} ({', '.join(label.partition(' · ')[2] or 'default' for label in members)})"
        if len(members) > 1
        else members[0]: members
        for name, members in found.items()
    }
