# SPDX-License-Identifier: BSD-3-Clause
"""All figures of a case, or of the suite. A figure that cannot be drawn becomes a note; the report is written anyway."""
from __future__ import annotations

import re
import warnings
from dataclasses import dataclass

from trajectories import NoTrajectory, read

from . import bodies, convergence, gates, history, particles, profiles, series, style, work_precision
from .curve import curves

warnings.filterwarnings("ignore", category=RuntimeWarning)  # bodies that are not alive are NaN by contract
OF_A_CASE = (particles, profiles, bodies, series, convergence, work_precision, history)


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


def stem_of(case):
    """A file name that is safe, and distinct also where ids are not."""
    return f"{case.number + 1:02d}-" + (re.sub(r"[^A-Za-z0-9_-]+", "-", case.id).strip("-")[:60] or "case")


def draw_case(root, out, case):
    """@returns (pictures, notes)"""
    notes, pictures, trajectories = [], [], []
    for curve in curves(case):
        run = curve.shown
        if run is None:
            notes += [] if curve.engine.status != "ok" else [f"{curve.label}: no sound run, nothing to draw"]  # else the matrix says why
            continue
        try:
            trajectories.append((curve, read(root, run)))
        except NoTrajectory as reason:
            notes.append(f"{curve.label}: no picture and no curves, {reason}")
    for module in OF_A_CASE:
        try:
            drawing = module.draw(case, trajectories, notes)
            if drawing:
                pictures.append(finish(drawing, out, stem_of(case)))
        except Exception as error:  # odd data must cost one figure, not the report
            notes.append(f"the figure {module.__name__.rsplit('.', 1)[-1].replace('_', ' ')} could not be drawn: {type(error).__name__}: {error}")
    return pictures, list(dict.fromkeys(notes))


def draw_suite(out, results):
    notes = []
    try:
        drawing = gates.draw(results, notes)
        return ([finish(drawing, out, "00-suite")] if drawing else []), notes
    except Exception as error:
        return [], [f"the overview of limits could not be drawn: {type(error).__name__}: {error}"]


def finish(drawing, out, stem):
    name = f"{stem}-{drawing.name}"
    svg = style.files(drawing.figure, out / "figures" / name)
    return Picture(drawing.name, drawing.title, drawing.alt, drawing.caption, style.inline(svg, re.sub(r"\W+", "-", name)), f"figures/{name}",
                   drawing.figure.get_figwidth() <= style.HALF)
