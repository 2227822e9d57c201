# SPDX-License-Identifier: BSD-3-Clause
"""NumPy twins of the exact solutions of solids and phase change.

beam     energies of a Timoshenko beam by linear elements, extrapolated (the program: closed forms and a transfer
matrix)
bar      strain and plastic strain as tensors, the sides' stress relaxed step by step (the program: a play operator in
one dimension)
factors  gradient and volume of the printed form, summed over particles of a stretched block (the program: two lattice
sums)
front    enthalpy by finite differences on a long bar (the program: a similarity solution)
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
    """E = rho = g = 1, unit depth: mean sag of the free end and lowest frequency of a clamped plate, nine-node
    quadrilaterals."""
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
    # The root of a body is stiffer than that of a beam, for its sides cannot draw in: at L/H = 10 by 0 / 0.5 / 1.2 % of
    # the sag for nu = 0 / 0.3 / 0.3975.
    return max(abs(sag / found[0] - 1), abs(frequency / found[1] - 1)), 2e-4 + 0.1 * nu**2


class Tensors:
    """E = 1e7, nu = 0.3, g1 = 0.004: principal components of a bar's strain, with return mapping."""

    mu, bulk, g1 = 1e7 / 2.6, 1e7 / 1.2, 0.004

    def __init__(self, confined, cap, factor, moment, volume):
        self.confined, self.cap, self.factor, self.moment, self.volume = confined, cap, factor, moment, volume
        self.plastic, self.dissipated, self.stretch = np.zeros(3), 0.0, 1.0

    def flow(self, strain):
        elastic = strain - self.plastic
        deviator = elastic - elastic.mean()
        size = np.linalg.norm(deviator)
        plastic = self.plastic + max(0.0, 1 - self.g1 / size) * deviator if size > 0 else self.plastic
        size = np.linalg.norm(plastic)
        return plastic * min(1.0, self.cap / size) if size > 0 else plastic

    def stress(self, strain, plastic):
        elastic = strain - plastic
        return self.bulk * elastic.sum() + 2 * self.mu * (elastic - elastic.mean())

    def step(self, stretch):
        F = 1 + self.moment * (stretch - 1)
        along = self.factor * (F * F - 1)
        low, high = (0.0, 0.0) if self.confined else (-abs(along) - 0.1, abs(along) + 0.1)
        while high - low > 1e-15:  # the sides draw in until they bear nothing
            side = 0.5 * (low + high)
            strain = np.array([along, side, side])
            low, high = (side, high) if self.stress(strain, self.flow(strain))[1] < 0 else (low, side)
        strain = np.array([along, low, low])
        plastic = self.flow(strain)
        S = self.stress(strain, plastic)
        # Work of the stress on the plastic strain, which flows along the deviator of the stress at its end.
        self.dissipated += self.volume * abs((S - S.mean()) @ (plastic - self.plastic))
        self.plastic, self.stretch = plastic, stretch
        energy = self.volume * 0.5 * S @ (strain - plastic)
        return np.array([plastic[0], self.volume * S[0] * 2 * self.factor * F * self.moment, energy, self.dissipated])


BARS = {}


def check_bar(arguments, found):
    key, stretch = tuple(arguments[:5]), arguments[5]
    bar = BARS.setdefault(key, Tensors(*key))
    start, count = bar.stretch, 40
    for n in range(1, count + 1):
        result = bar.step(start + (stretch - start) * n / count)
    scale = np.array([1e-2, 1e5, 1e3, 1e3])
    # Where the plastic limit is reached within a step the flow's last part is at more than the yield stress: half a
    # step, a dozen times in all.
    tolerance = np.array([1e-12, 1e-9, 1e-9, 1e-9 if key[1] > 0.1 else 2e-2])
    return (np.abs(result - found) / scale / tolerance).max(), 1.0


def check_factors(arguments, found):
    h = arguments[0]
    c = np.pi / (8 * h**4 * (np.pi / 3 - 8 / np.pi + 16 / np.pi**2))
    W = lambda r: c * 2 * h / np.pi * (np.cos((r + h) * np.pi / (2 * h)) + 1)
    n = int(np.ceil(h))
    grid = np.stack(np.meshgrid(*[np.arange(-n, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3).astype(float)
    r = np.linalg.norm(grid, axis=1)
    grid, r = grid[r < h], r[r < h]
    volume, e, stretch = 1 / W(r).sum(), 1e-5, 1e-3
    away = r > 0
    slope = np.where(away, (W(r + e) - W(np.abs(r - e))) / (2 * e), 0.0)
    # x_ij = -grid; grad W(x_ij) = W' x_ij/r, and u_ji = stretch times grid_x along x: (14) gives M times the stretch.
    gradient = volume * (slope * -grid[:, 0] / np.where(away, r, 1)) @ (stretch * grid[:, 0])
    return max(abs(gradient / stretch / found[0] - 1), abs(volume / found[1] - 1)), 1e-8


def check_front(arguments, found):
    """Change at 0 K, D = c = 1; the front by the enthalpy that has passed it."""
    surface, far, latent = arguments
    n = 150
    dx = 3.0 / n
    dt, flow = 0.4 * dx * dx, np.sign(surface)
    stop = (0.8 / 2 / found[0]) ** 2  # when the front is at about 0.8: 40 cells
    H = np.full(n, float(far))  # from that of the old phase at the change
    steps = int(round(stop / dt))
    for _ in range(steps):
        T = np.where(flow * H < 0, H, flow * np.maximum(0.0, flow * H - latent))
        Q = np.diff(
            np.concatenate([[surface + (surface - T[0])], T, [T[-1]]])
        )  # the surface lies on the first cell's face
        H += dt / dx**2 * np.diff(Q)
    front = np.clip(flow * H / latent, 0, 1).sum() * dx
    return abs(
        front / (2 * np.sqrt(steps * dt)) / found[0] - 1
    ), 0.01  # a cell of the front's 40 changes at once: half of it


CHECKS = {"front": check_front, "factors": check_factors, "bar": check_bar, "beam": check_beam, "plane": check_plane}
