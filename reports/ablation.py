# SPDX-License-Identifier: BSD-3-Clause
"""The page "what each correction buys": ablation.json beside results.json, written by `tripoint ablate`.

Each term of the model is put back to its printed form, all others corrected. A cell is how many times larger the size
of a metric is then; the metrics of a case are errors to its truth, or what a law says must not change."""

from __future__ import annotations

from dataclasses import dataclass

import foreign
from model import is_number, number, rows, table, text

WORSE, MOST = 1.1, 1e5  # factors that are worth a word, and that a page shows as a number
ROUNDOFF = 1e-12  # of a scaled error: below it two values are the same
MEANS = {
    "kernel": "kernel that fits its use, in the place of the printed two",
    "pressure": "pressure force as the gradient of an energy (7)",
    "density": "number density at walls and between liquids (4)",
    "state": "equation of state, not clamped where it must pull (9)",
    "clamp": "no pressure below zero, which the paper does not have",
    "viscosity": "viscosity that keeps angular momentum (8)",
    "walls": "walls that press by the mean density of their face, and mirror the velocity",
    "elasticity": "strain in the turned frame (11), gradients at surfaces exact for curved displacements (8.7)",
    "hourglass": "energy against zero-energy modes (12)",
    "heat": "conduction with equal and opposite flows and a moment factor (21)",
    "phase": "latent heat and hysteresis (Fig. 5)",
    "rotation": "splitting of the free top (19)-(20)",
    "time": "kick-drift-kick, two-stage heat",
    "bulk_viscosity": "numerical bulk viscosity of liquids (8.4), which the paper does not have",
    "contact_step": "steps that are short where solids touch alone (8.10), which the paper does not have",
    "contact": "solids that are stiffer than liquids where they touch (8.3), which the paper does not have",
    "core": "core that keeps pairs apart where the clamp leaves no pressure (8.3), which the paper does not have",
    "contact_face": "pressure on elastic solids at their face and not at the middles of their outer particles (8.3), "
    "which the paper does not have",
    "interface": "pressure that is right on both sides of a level interface (8.3), which the paper does not have",
    "transport": "particles that a background pressure moves (8.3), which the paper does not have",
    "mean_pressure": "pressure of transported liquid as the mean over its neighbours (8.3), which the paper does not "
    "have",
    "sound_damping": "numerical bulk viscosity of liquid that nothing clamps (8.3), which the paper does not have",
    "surface": "pressure of half a layer's weight at a free surface (8.3), which the paper does not have",
    "heat_surface": "surfaces that exchange heat where they lie (8.6), which the paper does not have",
}


@dataclass
class Cell:
    factor: float | None = None
    value: float | None = None
    word: str = ""  # where there is no number
    tone: str = "none"


@dataclass
class Row:
    case_id: str
    title: str
    metric: str
    unit: str
    corrected: float | None
    cells: dict


def read(folder):
    """@return (terms, rows, notes)"""
    path = folder / "ablation.json"
    if not path.exists():
        return [], [], ["there is no ablation.json beside results.json: tripoint ablate --out DIR makes it"]
    try:
        cases = rows(table(foreign.read(path)).get("cases"))
    except (OSError, ValueError) as error:
        return [], [], [f"ablation.json cannot be read: {error}"]
    terms = [term for term in MEANS if any(term in table(case.get("printed")) for case in cases)]
    found = []
    for case in cases:
        base = table(table(case.get("corrected")).get("metrics"))
        for metric in rows(case.get("metrics")):
            name = text(metric.get("name"))
            if name.endswith(
                ("_printed", "_predicted")
            ):  # distance to what the printed form must do: there it is meant to be near
                continue
            value = number(table(base.get(name)).get("value"))
            cells = {
                term: cell(table(table(case.get("printed")).get(term)), name, value)
                for term in terms
                if term in table(case.get("printed"))
            }
            if any(c.tone != "same" for c in cells.values()):
                found.append(
                    Row(text(case.get("id")), text(case.get("title")), name, text(metric.get("unit")), value, cells)
                )
    return terms, found, []


def cell(run, metric, corrected):
    if text(run.get("status")) != "ok":
        return Cell(word=text(run.get("status"), "error"), tone="fail")
    value = number(table(table(run.get("metrics")).get(metric)).get("value"))
    if not is_number(value) or not is_number(corrected):
        return Cell(word="no number", tone="fail")
    if max(abs(value), abs(corrected)) <= ROUNDOFF or abs(value - corrected) <= 1e-3 * abs(corrected) + ROUNDOFF:
        return Cell(1.0, value, tone="same")
    factor = abs(value) / max(abs(corrected), ROUNDOFF)
    tone = "fail" if factor >= 3.0 else "open" if factor >= WORSE else "pass" if factor <= 0.9 else "none"
    return Cell(factor, value, tone=tone)


def best(found, terms):
    """For each term the metric that it changes most, of those that the corrected model does not keep to round-off where
    there are any: how many times larger than nothing says little. (term, row, cell, cases)"""
    picked = []
    for term in terms:
        here = [
            (row, row.cells[term])
            for row in found
            if term in row.cells and row.cells[term].factor and row.cells[term].tone not in ("same",)
        ]
        if here:
            row, cell_ = max(here, key=lambda pair: (WORSE < pair[1].factor < MOST, pair[1].factor))
            picked.append((term, row, cell_, len({r.case_id for r, c in here if c.tone in ("fail", "open")})))
    return picked
