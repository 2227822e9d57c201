# SPDX-License-Identifier: BSD-3-Clause
"""All figures of a case, drawn anew only where what they are drawn from has changed. A figure that cannot be drawn
becomes a note; the report is written anyway."""

from __future__ import annotations

import functools
import hashlib
import json
import os
import re
import warnings
from dataclasses import asdict, dataclass
from pathlib import Path

from model import rows
from trajectories import NoTrajectory, folder_of, read

from . import bodies, convergence, history, observed, particles, profiles, series, style, work_precision
from .curve import curves

warnings.filterwarnings("ignore", category=RuntimeWarning)  # bodies that are not alive are NaN by contract
OF_A_CASE = (particles, observed, profiles, bodies, series, convergence, work_precision, history)
OF_TRAJECTORIES = (particles, profiles, bodies)  # the others draw what results.json and the history hold


@dataclass
class Picture:
    """What the page needs of a figure."""

    name: str
    title: str
    alt: str
    caption: str
    svg: str
    file: str
    half: bool  # two of them stand side by side
    slim: str = ""  # the same, drawn for a narrow screen


def draw_case(root, out, case):
    """@returns (pictures, notes, files that belong to them)"""
    shelf = out / "figures" / f"{case.slug}.json"
    kept = kept_on(shelf)
    shown = [(curve, curve.shown) for curve in curves(case)]
    trajectories, drawn = None, {}
    for module, wanted in keys_of(root, case, shown).items():
        name, with_notes = module.__name__.rsplit(".", 1)[-1], module in OF_TRAJECTORIES
        entry = kept.get(name)
        if not sound(entry, wanted, out):
            if with_notes and trajectories is None:
                trajectories = read_all(root, shown)
            entry = {"key": wanted, **drawing_of(module, case, trajectories or ([], []), out, with_notes)}
        drawn[name] = entry
    shelf.parent.mkdir(parents=True, exist_ok=True)
    if drawn != kept:
        keep(drawn, shelf)
    pictures = [Picture(**entry["picture"]) for entry in drawn.values() if entry["picture"]]
    notes = undrawn(shown) + [note for entry in drawn.values() for note in entry["notes"]]
    files = [f"figures/{shelf.name}"] + [f"{picture.file}.svg" for picture in pictures]
    return pictures, list(dict.fromkeys(notes)), files


def undrawn(shown):
    return [
        f"{curve.label}: no sound run, nothing to draw"
        for curve, run in shown
        if run is None and curve.engine.status == "ok"
    ]


def kept_on(shelf):
    """{module: its entry} of the drawings before; empty where there are none that can be read."""
    try:
        kept = json.loads(shelf.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return kept if isinstance(kept, dict) else {}


def keep(drawn, shelf):
    part = shelf.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(drawn), encoding="utf-8")
    part.replace(shelf)


def keys_of(root, case, shown):
    """{module: the key of what it draws from}"""
    states = [state(root, curve, run) for curve, run in shown if run]
    inputs = {
        particles: states,
        profiles: states,
        bodies: states,
        work_precision: numbers_of(case, True),
        history: runs_of(case.history),
    }
    return {
        module: key(module.__name__, case.slug, inputs.get(module) or numbers_of(case, False)) for module in OF_A_CASE
    }


def drawing_of(module, case, trajectories, out, with_notes):
    """@return {"picture", "notes"}"""
    found, notes = trajectories[0], list(trajectories[1]) if with_notes else []
    try:
        drawing = module.draw(case, found, notes)
        return {"picture": asdict(finish(drawing, out, case.slug)) if drawing else None, "notes": notes}
    except Exception as error:  # odd data must cost one figure, not the report
        return {
            "picture": None,
            "notes": notes
            + [
                f"the figure {module.__name__.rsplit('.', 1)[-1].replace('_', ' ')} could not be drawn: "
                f"{type(error).__name__}: {error}"
            ],
        }


def read_all(root, shown):
    """@return ([(curve, trajectory)], notes)"""
    found, notes = [], []
    for curve, run in shown:
        if run is None:
            continue
        try:
            found.append((curve, read(root, run)))
        except NoTrajectory as reason:
            notes.append(f"{curve.label}: no picture and no curves, {reason}")
    return found, notes


def state(root, curve, run):
    """What a trajectory's picture depends on: the bits of the run's end, the frames that it wrote, and its names and
    knobs."""
    files = []
    try:
        folder = folder_of(root, run)
        for name in ("trajectory.h5", "trajectory.csv"):
            if (folder / name).is_file():
                found = (folder / name).stat()
                files.append([name, found.st_size] + ([] if run.state_hash else [found.st_mtime_ns]))
    except (NoTrajectory, OSError):
        pass
    return [curve.label, curve.mode, run.state_hash, run.folder, run.knobs, files]


def numbers_of(case, with_cost):
    """What the figures of numbers are drawn from; seconds differ from run to run, and only one figure has them."""
    runs = [
        [
            {k: v for k, v in run.items() if k != "state_hash" and (with_cost or k != "cost")}
            for run in rows(engine.raw.get("runs"))
        ]
        for engine in case.engines
    ]
    return [
        case.id,
        case.title,
        case.reference,
        case.metrics,
        runs,
        [[engine.label, engine.status, engine.raw.get("order"), engine.raw.get("gates")] for engine in case.engines],
    ]


def runs_of(history):
    return [[entry.date, entry.commit, entry.accepted, sorted(map(repr, entry.used.items()))] for entry in history] or [
        "no run before"
    ]


def key(*parts):
    return hashlib.sha256((code() + json.dumps(parts, sort_keys=True, default=str)).encode()).hexdigest()


@functools.lru_cache
def code():
    """The bits of what draws, so that another version of this program draws anew."""
    import matplotlib
    import numpy

    room = Path(__file__).resolve().parent
    files = sorted([*room.glob("*.py"), *(room.parent / name for name in ("trajectories.py", "model.py", "load.py"))])
    return hashlib.sha256(
        b"".join(path.read_bytes() for path in files) + matplotlib.__version__.encode() + numpy.__version__.encode()
    ).hexdigest()


def sound(entry, wanted, out):
    """Whether what was kept is of these inputs, and whole."""
    if not isinstance(entry, dict) or entry.get("key") != wanted or not isinstance(entry.get("notes"), list):
        return False
    picture = entry.get("picture")
    return (
        picture is None
        or isinstance(picture, dict)
        and picture.keys() == Picture.__dataclass_fields__.keys()
        and (out / f"{picture['file']}.svg").is_file()
    )


def finish(drawing, out, stem):
    name = f"{stem}-{drawing.name}"
    svg = style.files(drawing.figure, out / "figures" / name)
    return Picture(
        drawing.name,
        drawing.title,
        drawing.alt,
        drawing.caption,
        style.inline(svg, re.sub(r"\W+", "-", name)),
        f"figures/{name}",
        bool(drawing.figure.get_figwidth() <= style.HALF),
    )
