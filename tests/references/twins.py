#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""NumPy twins of the exact solutions: the same values by other means, from the values that the program given prints.

torque_free  rotation matrix by an eighth-order Gauss-Legendre integrator (the program: Jacobi's elliptic functions)
lattice      conduction operator as a sparse sum over the particles of a periodic block (the program: a sum over one
neighbourhood)
step         cosine series summed to round-off (the program: images of error functions)
layers       matrix exponential of a finite-volume operator (the program: eigenfunctions or error functions)
Those of solids and phase change are in solid_twins.py.
"""

import subprocess
import sys

import numpy as np

import solid_twins


def gauss_legendre(stages):
    """Butcher tableau of the Gauss-Legendre collocation method, of order 2 x stages."""
    x, _ = np.polynomial.legendre.leggauss(stages)
    c = 0.5 * (x + 1)
    powers = np.vander(c, stages, increasing=True)
    a = np.array([[c[i] ** (j + 1) / (j + 1) for j in range(stages)] for i in range(stages)]) @ np.linalg.inv(powers)
    b = np.array([1 / (j + 1) for j in range(stages)]) @ np.linalg.inv(powers)
    return a, b


TOPS = {}


def torque_free(values):
    """Spin in the body and attitude at t, from one integration for each start; every t asked for is a whole number of
    steps."""
    inertia, w0, t = values[:3], values[3:6], values[6]
    h, last = 0.02, 10.0
    if tuple(w0) not in TOPS:
        a, b = gauss_legendre(4)

        def rate(y):  # rows of y: spin, then the rows of R; dR/dt = R [w]x turns each row r into r x w
            w, R = y[:, 0], y[:, 1:]
            return np.concatenate([(np.cross(inertia * w, w) / inertia)[:, None], np.cross(R, w[:, None])], axis=1)

        y, history = np.concatenate([w0[None], np.eye(3)]), []
        for _ in range(round(last / h)):
            history.append(y)
            k = np.repeat(rate(y[None]), 4, axis=0)
            for _ in range(14):  # fixed point: h |w| <= 0.1
                k = rate(y + h * np.einsum("ij,jkl->ikl", a, k))
            y = y + h * np.einsum("j,jkl->kl", b, k)
        TOPS[tuple(w0)] = history + [y]
    y = TOPS[tuple(w0)][round(t / h)]
    return y[0], y[1:]


def matrix(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def check_torque_free(arguments, found):
    spin, R = torque_free(arguments)
    difference = np.abs(matrix(found[:4]) - R).max()
    return max(difference, np.abs(R @ spin - found[4:]).max() / np.linalg.norm(found[4:])), 1e-11


def neighbours(ratio):
    n = int(np.ceil(ratio))
    grid = np.stack(np.meshgrid(*[np.arange(-n, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3).astype(float)
    return grid[np.linalg.norm(grid, axis=1) < ratio]


def check_lattice(arguments, found):
    ratio, k = arguments[0], np.array(arguments[1:])
    offset = neighbours(ratio)
    r = np.linalg.norm(offset, axis=1)
    at = np.array([3.3, -1.7, 0.4])  # any particle, any phase
    mode = lambda x: np.cos(x @ k + 0.7)
    change = mode(at + offset) - mode(at)
    density = (315 / (64 * np.pi * ratio**9) * (ratio**2 - r**2) ** 3).sum()
    paper = -(45 / (np.pi * ratio**6) * (ratio - r) * change).sum() / density / mode(at)
    # Wendland C2 by differences of the kernel itself, the moment as a matrix.
    W = lambda q: 21 / (2 * np.pi * ratio**3) * (1 - q) ** 4 * (1 + 4 * q)
    away = r > 0
    e = 1e-5
    K = -2 * (W((r[away] + e) / ratio) - W((r[away] - e) / ratio)) / (2 * e) / r[away]
    M = 0.5 * np.einsum("n,ni,nj->ij", K, offset[away], offset[away])
    direction = offset[away] / r[away][:, None]
    factor = np.einsum("ni,ij,nj->n", direction, np.linalg.inv(M), direction)
    corrected = -(factor * K * change[away]).sum() / mode(at)
    return max(abs(paper / found[0] - 1), abs(corrected / found[1] - 1)), 1e-8


def check_step(arguments, found):
    periodic, t, x, cell = arguments
    L, place, D = 0.05, 0.017, 2e-6
    n = np.arange(1, 20001)
    k = (2 if periodic else 1) * n * np.pi / L
    decay = np.exp(-k * k * D * t) * (np.sinc(k * cell / 2 / np.pi))  # the mean over a cell multiplies a mode by sinc
    series = 2 * np.sin(k * place) / (k * L) * np.cos(k * x)
    if periodic:
        series = series + 2 * (1 - np.cos(k * place)) / (k * L) * np.sin(k * x)
    inside = cell == 0 or (
        x - cell / 2 > 0 and x + cell / 2 < L
    )  # beyond an insulated end the mirror image continues both forms
    return abs(place / L + (decay * series).sum() - found[0]) if inside else 0.0, 1e-12


LAYERS = {}


def check_layers(arguments, found):
    t, x = arguments
    n = 500
    dx = 0.01 / n
    if not LAYERS:
        centre = (np.arange(n) + 0.5) * dx
        low = centre < 0.007
        conductivity = np.where(low, 2.0, 0.2)
        G = 2 * conductivity[1:] * conductivity[:-1] / (conductivity[1:] + conductivity[:-1]) / dx**2 / 1e6
        A = np.diag(np.append(-G, 0) + np.append(0, -G)) + np.diag(G, 1) + np.diag(G, -1)
        LAYERS["values"], LAYERS["vectors"] = np.linalg.eigh(A)
        LAYERS["start"] = LAYERS["vectors"].T @ np.where(low, 310.0, 300.0)
        LAYERS["centre"] = centre
    T = LAYERS["vectors"] @ (np.exp(LAYERS["values"] * t) * LAYERS["start"])
    # Ends are level and the interface lies on a face, so linear interpolation between centres never crosses the kink
    # here.
    return abs(np.interp(x, LAYERS["centre"], T) - found[0]), 4e-4  # second order in dx: (dx/front)^2 of a step of 10 K


CHECKS = {
    "torque_free": check_torque_free,
    "lattice": check_lattice,
    "step": check_step,
    "layers": check_layers,
    **solid_twins.CHECKS,
}


def main():
    lines = subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout.splitlines()
    worst, seen = {}, {}
    for line in lines:
        left, right = line.split("=")
        name, *arguments = left.split()
        error, tolerance = CHECKS[name](np.array(arguments, float), np.array(right.split(), float))
        worst[name] = max(worst.get(name, 0.0), float(error) / tolerance if np.isfinite(error) else np.inf)
        seen[name] = seen.get(name, 0) + 1
    for name in CHECKS:
        print(f"{name}: {seen.get(name, 0)} values, largest difference {worst.get(name, np.inf):.2g} of its tolerance")
    sys.exit(any(seen.get(name, 0) == 0 or worst[name] > 1 for name in CHECKS))


if __name__ == "__main__":
    main()
