# SPDX-License-Identifier: BSD-3-Clause
"""Kernels of docs/model.md and their sums on the cubic lattice. Each is 0 beyond its support h."""

import itertools

import numpy as np


def poly6(r, h):
    """[Mueller, Charypar, Gross 2003], for (4)."""
    return np.where(r < h, 315 / (64 * np.pi * h**9) * (h * h - r * r) ** 3, 0.0)


def spiky_slope(r, h):
    """W' of the spiky kernel, for (7)."""
    return np.where(r < h, -45 / (np.pi * h**6) * (h - r) ** 2, 0.0)


def viscosity_laplacian(r, h):
    """For (8) and (21)."""
    return np.where(r < h, 45 / (np.pi * h**6) * (h - r), 0.0)


def wendland(r, h):
    """[Wendland 1995], C2 in three dimensions."""
    x = np.minimum(r / h, 1.0)
    return 21 / (2 * np.pi * h**3) * np.square(np.square(1 - x)) * (1 + 4 * x)


def wendland_slope(r, h):
    """W'."""
    x = np.minimum(r / h, 1.0)
    return -210 / (np.pi * h**4) * x * np.square(1 - x) * (1 - x)


def _elasticity_constant(h):
    return np.pi / (8 * h**4 * (np.pi / 3 - 8 / np.pi + 16 / np.pi**2))


def elasticity(r, h):
    """(17)"""
    return np.where(r < h, _elasticity_constant(h) * 2 * h / np.pi * (np.cos((r + h) * np.pi / (2 * h)) + 1), 0.0)


def elasticity_slope(r, h):
    """W' of (17)."""
    return np.where(r < h, -_elasticity_constant(h) * np.sin((r + h) * np.pi / (2 * h)), 0.0)


def isotropic_shear(ratio):
    """c and s of 8.5 in spacings: c + s r^2 makes both shear moduli of the lattice 1; c is 0 where it would be
    negative."""
    reach = np.arange(-int(np.ceil(ratio)), int(np.ceil(ratio)) + 1.0)
    x, y, z = (a.ravel() for a in np.meshgrid(reach, reach, reach))
    r = np.sqrt(x * x + y * y + z * z)
    x, y, r = (a[(r > 0) & (r < ratio)] for a in (x, y, r))
    pair = -5 * wendland_slope(r, ratio) / r**3 / lattice_numbers(ratio)[1]
    moduli = np.array(
        [[(pair * form * weight).sum() for weight in (1, r * r)] for form in (x * x * y * y, (x * x - y * y) ** 2 / 4)]
    )
    c, s = np.linalg.solve(moduli, [1.0, 1.0])
    return (c, s) if c > 0 else (0.0, 1 / ([0.6, 0.4] @ moduli)[1])


def interface_kernel(ratio):
    """c and s of 8.3 in spacings: with the energy of K = (c + s r^2) W both layers beside a level interface bear their
    weight."""
    reach = np.arange(-int(np.ceil(ratio)), int(np.ceil(ratio)) + 1.0)
    x, y, z = (a.ravel() for a in np.meshgrid(reach, reach, reach))
    r = np.sqrt(x * x + y * y + z * z)
    z, r = (a[(r > 0) & (r < ratio)] for a in (z, r))
    W, slope = wendland(r, ratio), wendland_slope(r, ratio) / r
    given = [
        [-(z * z * k + K)[z > a].sum() for K, k in ((W, slope), (r * r * W, r * r * slope + 2 * W))] for a in (0.5, 1.5)
    ]
    missing = [-(2 * (z - a) * z * slope)[z > a].sum() for a in (0.5, 1.5)]
    return np.linalg.solve(given, missing)


def lattice_numbers(ratio):
    """S0 and M of chapter 8, and the part of S0 within one layer."""
    reach = range(-int(np.ceil(ratio)), int(np.ceil(ratio)) + 1)
    total = layer = moment = 0.0
    for x, y, z in itertools.product(reach, reach, reach):
        r = np.sqrt(float(x * x + y * y + z * z))
        total += wendland(r, ratio)
        layer += wendland(r, ratio) if z == 0 else 0.0
        moment -= r * wendland_slope(r, ratio) / 3
    return float(total), float(moment), float(layer)
