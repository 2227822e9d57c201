# SPDX-License-Identifier: BSD-3-Clause
"""NumPy twins of the exact solutions of solids and phase change.

beam     energies of a Timoshenko beam by linear elements, extrapolated (the program: closed forms and a transfer matrix)
plane    plane strain elasticity by quadrilaterals of second order: the clamped plate as a body, not as a beam
"""
import numpy as np


def lowest(K, M, start):
    """Lowest angular frequency by inverse iteration."""
    inverse = np.linalg.inv(K)
    for _ in range(30):
        start = inverse @ (M @ start)
        start /= np.linalg.norm(start)
    return np.sqrt(start @ K @ start / (start @ M @ start))


def beam_by_elements(arguments, count):
    """Sag and rotation at the end under weight, and the lowest frequency, from the energies alone."""
    L, EI, kGA, rhoA, rhoI, m, J, d, g = arguments
    n, h = 2 * (count + 1), L / count
    K, M, f = np.zeros((n, n)), np.zeros((n, n)), np.zeros(n)
    for e in range(count):
        at = np.arange(2 * e, 2 * e + 4)  # w, psi at both ends
        bend, shear = np.array([0, -1, 0, 1]) / h, np.array([-1 / h, -0.5, 1 / h, -0.5])
        K[np.ix_(at, at)] += h * (EI * np.outer(bend, bend) + kGA * np.outer(shear, shear))
        share = h / 6 * np.array([[2, 1], [1, 2]])
        M[np.ix_(at[::2], at[::2])] += rhoA * share
        M[np.ix_(at[1::2], at[1::2])] += rhoI * share
        f[at[::2]] += rhoA * g * h / 2
    tip = np.array([1.0, d])  # the tip's centre moves by w + d psi
    M[n - 2 :, n - 2 :] += m * np.outer(tip, tip) + np.diag([0, J])
    f[n - 2 :] += m * g * tip
    K, M, f = K[2:, 2:], M[2:, 2:], f[2:]
    u = np.linalg.solve(K, f)
    return np.array([u[-2], u[-1], lowest(K, M, u)])


def check_beam(arguments, found):
    coarse, fine = beam_by_elements(arguments, 60), beam_by_elements(arguments, 120)
    return np.abs((fine + (fine - coarse) / 3) / found - 1).max(), 2e-5  # fourth order after extrapolation: (5 h/L)^4


def plane_strain(L, H, nu, nx, ny):
    """E = rho = g = 1, unit depth: mean sag of the free end and lowest frequency of a clamped plate, nine-node quadrilaterals."""
    C = np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, 0.5 - nu]]) / ((1 + nu) * (1 - 2 * nu))
    columns, rows = 2 * nx + 1, 2 * ny + 1
    n = 2 * columns * rows
    K, M, f = np.zeros((n, n)), np.zeros((n, n)), np.zeros(n)
    points, weights = np.polynomial.legendre.leggauss(3)
    shape = lambda s: np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2])
    slope = lambda s: np.array([s - 0.5, -2 * s, s + 0.5])
    hx, hy = L / nx / 2, H / ny / 2
    ke, me, fe = np.zeros((18, 18)), np.zeros((18, 18)), np.zeros(18)
    for a, wa in zip(points, weights):
        for b, wb in zip(points, weights):
            N, Nx, Ny = np.kron(shape(a), shape(b)), np.kron(slope(a), shape(b)) / hx, np.kron(shape(a), slope(b)) / hy
            B = np.zeros((3, 18))
            B[0, ::2], B[1, 1::2], B[2, ::2], B[2, 1::2] = Nx, Ny, Ny, Nx
            w = wa * wb * hx * hy
            ke += w * B.T @ C @ B
            me += w * np.kron(np.outer(N, N), np.eye(2))
            fe[1::2] += w * N
    for i in range(nx):
        for j in range(ny):
            node = ((2 * i + np.arange(3))[:, None] * rows + 2 * j + np.arange(3)).ravel()
            at = np.stack([2 * node, 2 * node + 1], -1).ravel()
            K[np.ix_(at, at)] += ke
            M[np.ix_(at, at)] += me
            f[at] += fe
    free = slice(2 * rows, n)
    u = np.linalg.solve(K[free, free], f[free])
    return u[-2 * rows + 1 :: 2].mean(), lowest(K[free, free], M[free, free], u)


def check_plane(arguments, found):
    L, H, nu = arguments
    sag, frequency = plane_strain(L, H, nu, 24, 2)
    # The root of a body is stiffer than that of a beam, for its sides cannot draw in: at L/H = 10 by 0 / 0.5 / 1.2 % of the sag for nu = 0 / 0.3 / 0.3975.
    return max(abs(sag / found[0] - 1), abs(frequency / found[1] - 1)), 2e-4 + 0.1 * nu**2


CHECKS = {"beam": check_beam, "plane": check_plane}
