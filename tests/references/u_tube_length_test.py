# SPDX-License-Identifier: BSD-3-Clause
"""The true frequency that cases/fluid/u-tube.toml states, against Laplace's equation in its water:
u_tube_length_test.py CASE

Small swings of an ideal liquid of equal bore have omega^2 = 2 g/L, where L is the drop of the velocity potential from
one surface to the other over the mean speed in the bore. Cells of a square grid are nodes and their shared faces are
conductors of unit conductance. The error falls as h^(4/3), the order of the potential at the inner edge of a bend."""

import math
import sys
import tomllib
import unittest
from pathlib import Path

import numpy

CASE = tomllib.loads(Path(sys.argv.pop(1)).read_text())
WATER = next(body for body in CASE["body"] if body["phase"] == "liquid")
G = -CASE["scene"]["gravity"][2]


def boxes():
    """The water's boxes in x and z, whole multiples of the bore of 0.1 m."""
    return [((b["min"][0], b["min"][2]), (b["max"][0], b["max"][2])) for b in WATER["shape"]["of"]]


def length(bore, across):
    """Effective length [m] on a grid of `across` cells a bore, by conjugate gradients."""
    h = bore / across
    top = max(high[1] for _, high in boxes())
    wide, tall = round(max(high[0] for _, high in boxes()) / h), round(top / h)
    wet = numpy.zeros((wide + 2, tall + 2), dtype=bool)  # a dry rim
    for low, high in boxes():
        wet[1 + round(low[0] / h) : 1 + round(high[0] / h), 1 + round(low[1] / h) : 1 + round(high[1] / h)] = True
    # A surface is half a cell from the centres below it, and has potential 1 in the left leg, 0 in the right one.
    surface = numpy.zeros(wet.shape)
    surface[:, tall][wet[:, tall]] = 2.0
    left = numpy.arange(wide + 2)[:, None] <= wide // 2
    links = [wet & numpy.roll(wet, shift, axis) for axis in (0, 1) for shift in (1, -1)]
    shifts = [(axis, shift) for axis in (0, 1) for shift in (1, -1)]
    diagonal = sum(link.astype(float) for link in links) + surface

    def apply(phi):
        return numpy.where(
            wet,
            diagonal * phi - sum(link * numpy.roll(phi, shift, axis) for link, (axis, shift) in zip(links, shifts)),
            0.0,
        )

    source = surface * left
    phi = numpy.where(wet, 0.5, 0.0)
    r = source - apply(phi)
    p, rr = r.copy(), (r * r).sum()
    for _ in range(20 * (wide + tall)):
        q = apply(p)
        a = rr / (p * q).sum()
        phi, r = phi + a * p, r - a * q
        rr, last = (r * r).sum(), rr
        if rr < 1e-24:
            break
        p = r + (rr / last) * p
    else:
        raise AssertionError("conjugate gradients have not converged")
    flux = (surface * left * (1.0 - phi)).sum()  # through the left surface, over its width in cells
    return bore / flux


class EffectiveLength(unittest.TestCase):
    def test_the_stated_frequency_is_that_of_a_potential_flow(self):
        bore = 0.1
        coarse, fine = length(bore, 12), length(bore, 24)
        limit = fine + (fine - coarse) / (2.0 ** (4.0 / 3.0) - 1.0)
        stated = next(m for m in CASE["metric"] if m["name"] == "frequency")["reference"]["args"]["value"]
        true = math.sqrt(2.0 * G / limit) / (2.0 * math.pi)
        print(f"L = {coarse:.6f}, {fine:.6f} -> {limit:.6f} m, {true:.6f} Hz, stated {stated} Hz")
        self.assertLess(abs(stated / true - 1.0), 2e-4)

    def test_a_corner_counts_what_conformal_mapping_says(self):
        """1 - 2 ln 2/pi widths each, where the legs and the channel between them are long."""
        straight = sum(max(high[0] - low[0], high[1] - low[1]) for low, high in boxes()) - 0.2
        coarse, fine = length(0.1, 12), length(0.1, 24)
        limit = fine + (fine - coarse) / (2.0 ** (4.0 / 3.0) - 1.0)
        self.assertAlmostEqual((limit - straight) / 0.2, 1.0 - 2.0 * math.log(2.0) / math.pi, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
