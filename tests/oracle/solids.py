# SPDX-License-Identifier: BSD-3-Clause
"""Bonds, strain, stress, energies and flow of solids: chapters 2, 8.7, 8.8 and 11 of docs/model.md, for a State of
model.py."""

import numpy as np

from kernels import elasticity, elasticity_slope
from flows import pseudo_inverse

IDENTITY = np.eye(3)
REACH = 2.12  # of bonds and of (17), in spacings


def first_bonds(s):
    """Chapter 11: pairs of one deformable body, or of two that are joined, nearer than 2.12 spacings; within a rigid
    body pairs with a member that is itself that near to a deformable body it is joined to; and, within a rigid body
    that can melt, pairs nearer than the merging distance. @return the bonded pairs, and those that can be excluded,
    by [i, j]"""
    solid = [b for b in s.scene["bodies"] if b["phase"] != "liquid"]
    n = len(solid)
    joined = np.zeros((n, n), dtype=bool)
    for a in range(n):
        joined[a, a] = not s.moves_as_one(a)
        for name in solid[a]["joined_to"]:
            b = [other["name"] for other in solid].index(name)
            if not (s.moves_as_one(a) and s.moves_as_one(b)):
                joined[a, b] = joined[b, a] = True
    deformable = np.array([b >= 0 and not s.moves_as_one(b) for b in s.body])
    near = s.distance < REACH * s.dx
    may = np.array([[a >= 0 and b >= 0 and joined[a, b] for b in s.body] for a in s.body])
    at_joint = ~deformable & (near & may & deformable[None, :]).any(axis=1)
    mates = (
        (s.body[:, None] == s.body[None, :])
        & (s.body >= 0)[:, None]
        & ~deformable[:, None]
        & (at_joint[:, None] | at_joint[None, :])
    )
    bonded = near & (may | mates)
    if s.has("liquid_fraction"):
        melts = ~np.isnan(s.material("t_melt", np.nan))
        of_rigid = (
            (s.body[:, None] == s.body[None, :])
            & ((s.body >= 0) & ~deformable)[:, None]
            & (melts[:, None] | melts[None, :])
        )
        bonded = bonded | of_rigid & (s.distance < s.scene["merge_distance"] * s.dx)
    return bonded, may & ~mates


def solid_volume(s, owns):
    """m/rho0; (11) as printed."""
    volume = s.m / s.material("density")
    if s.printed("elastic"):
        for i in np.flatnonzero(owns):
            volume[i] = s.m[i] / (s.m[i] * elasticity(0.0, REACH * s.dx) + sum(s.m[j] * W for j, _, _, W in s.bonds[i]))
    return volume


def bond_gradients(s, i, volume, share):
    """8.7: grad W(x_ij) of the kernel (17) for the list of i; at a surface of a solid with the correction for bending,
    as the quotient of least squares of second order, and of first order where less than a fifth is known of a
    curvature."""
    x = -np.array([b[1] for b in s.bonds[i]]).reshape(-1, 3)  # x_ji
    r = np.linalg.norm(x, axis=1)
    plain = np.array([elasticity_slope(d, REACH * s.dx) for d in r])[:, None] * -x / r[:, None]
    v = volume[[b[0] for b in s.bonds[i]]]
    w = -v * np.array([elasticity_slope(d, REACH * s.dx) for d in r]) / r
    M = (x * w[:, None]).T @ x
    eigenvalues = np.linalg.eigvalsh(M)
    inward = w @ x
    outward = -(x @ inward) / (r * np.linalg.norm(inward)) if np.linalg.norm(inward) > 1e-9 * (w @ r) else np.ones(1)
    if share == 0 or eigenvalues[0] < 0.2 * eigenvalues[2] or outward.max() > 0.65:
        return plain
    q = np.einsum("ka,kb->kab", x, x).reshape(-1, 9) / 2  # |q| does not depend on the axes
    root = np.sqrt(w)[:, None]
    linear = root * x
    rest = root * q - linear @ np.linalg.lstsq(linear, root * q, rcond=None)[0]
    _, size, known = np.linalg.svd(rest, full_matrices=False)
    greatest = np.linalg.norm(root * q, 2)
    known = known[size**2 > 0.2 * greatest**2]
    fit = np.linalg.pinv(np.hstack([linear, root * q @ known.T]), rcond=1e-8)[:3] * root.T  # 3 rows: d_ij
    first = np.linalg.pinv(linear) * root.T
    return plain + share * ((fit - first).T @ M) / v[:, None]


class Deformed:
    """F, strain, stress, energy and forces of one particle that owns strain energy, by its list: (10) to (16) or
    8.7."""

    def __init__(self, s, i, constants, hourglass):
        E, nu, share = constants
        self.printed = s.printed("elastic")
        self.s, self.i = s, i
        v = s["solid_volume"]
        self.v = v[i]
        self.young = share * E
        lam, mu = share * E * nu / ((1 + nu) * (1 - 2 * nu)), share * E / (2 * (1 + nu))
        self.mu = mu
        others = s.bonds[i]
        self.j = [j for j, _, _, _ in others]
        x = np.array([b[1] for b in others]).reshape(-1, 3)
        gradient = np.array([b[2] for b in others]).reshape(-1, 3)
        weight = np.array([b[3] for b in others])
        self.r_ji = s.nearest((s.r[self.j] - s.r[i]).reshape(-1, 3))
        self.x_ji = -x
        u = self.r_ji + x  # (15)
        vj = v[self.j]
        moment = np.einsum("j,jk,jl->kl", vj, gradient, self.x_ji)
        self.A, self.rank = (
            (IDENTITY, 3)
            if self.printed
            else pseudo_inverse(0.5 * (moment + moment.T), 0.2)
            if self.j
            else (np.zeros((3, 3)), 0)
        )
        self.D = vj[:, None] * (gradient @ self.A)  # (16)
        self.F = IDENTITY + np.einsum("jk,jl->kl", u, self.D)
        self.P = (
            IDENTITY
            if self.rank == 3
            else self.A @ np.linalg.pinv(self.A, rcond=0.1)
            if self.rank
            else np.zeros((3, 3))
        )
        green = self.F.T @ self.F - IDENTITY
        self.strain = self.P @ (green if self.printed else 0.5 * green) @ self.P
        self.strain_scale = max(1.0, np.abs(self.F).max() ** 2)
        self.lam = lam if self.rank != 2 else 2 * lam * mu / (lam + 2 * mu)
        self.c = 0.25 * hourglass * self.young * self.v * vj * weight

    def stress(self, elastic):
        if self.rank == 1:
            return self.young * elastic
        return 2 * self.mu * elastic + self.lam * np.trace(elastic) * self.P

    def elastic_strain(self, plastic):
        return self.P @ (self.strain - plastic) @ self.P

    def residuals(self):
        """Of the hourglass energy: vectors of a solid, numbers of a sheet or chain."""
        if self.rank == 3:
            return self.x_ji @ self.F.T - self.r_ji
        x2 = (self.x_ji**2).sum(axis=1)
        stretched = x2 + 2 * np.einsum("jk,kl,jl->j", self.x_ji, self.strain, self.x_ji)
        return ((self.r_ji**2).sum(axis=1) - stretched) / (2 * x2)

    def energies(self, plastic):
        elastic = self.elastic_strain(plastic)
        U = 0.5 * self.v * (elastic * self.stress(elastic)).sum()
        if not self.j:
            return U, 0.0
        e, x2 = self.residuals(), (self.x_ji**2).sum(axis=1)
        return U, (self.c * (e**2).sum(axis=1) / x2).sum() if self.rank == 3 else (self.c * e**2).sum()

    def forces(self, plastic):
        """On each partner, and magnitudes of what they are made of. What acts on the particle itself is minus their
        sum."""
        S = self.stress(self.elastic_strain(plastic))
        factor = 2.0 if self.printed else 1.0
        out = -factor * self.v * self.D @ (self.F @ S).T  # (12)
        scale = (
            factor
            * self.v
            * np.linalg.norm(self.D, axis=1)
            * max(np.linalg.norm(self.F @ S), 1e-3 * self.young * np.linalg.norm(self.F))
        )
        if not self.c.any():
            return out, scale
        x2, e = (self.x_ji**2).sum(axis=1), self.residuals()
        along = self.D @ self.x_ji.T  # [k, j]: D_k . x_j
        if self.rank == 3:  # U = sum c |e|^2/x^2: e_j changes with r_k by (D_k.x_j) - delta_jk
            push = 2 * (self.c / x2)[:, None] * e
            out = out - along @ push + push
            size = 2 * self.c / x2 * (np.linalg.norm(self.x_ji @ self.F.T, axis=1) + np.linalg.norm(self.r_ji, axis=1))
            return out, scale + np.abs(along) @ size + size
        y = self.x_ji @ self.P
        push = 2 * self.c * e / x2  # dg_j/dr_k = (delta_jk r_j - (F y_j)(D_k.y_j))/x^2
        out = out + (self.D @ y.T) @ (push[:, None] * (y @ self.F.T)) - push[:, None] * self.r_ji
        size = 2 * self.c / x2 * np.linalg.norm(self.r_ji, axis=1)
        return out, scale + np.abs(self.D @ y.T) @ size + size


def flowed(d, plastic, elastic_limit, plastic_limit):
    """eps_p after flow, 8.8."""
    norm = lambda a: np.sqrt((a * a).sum())
    deviator = lambda a: a - np.trace(a) / 3 * IDENTITY
    size = lambda a: np.sqrt((a * a).sum() + (np.trace(a) ** 2 / (3 - d.rank) if d.rank < 3 else 0.0))
    if d.rank == 3:
        e = deviator(d.strain - plastic)
        passed, limit = norm(e), elastic_limit
    else:
        e = d.elastic_strain(plastic)
        passed, limit = np.sqrt(1.5) * norm(deviator(d.stress(e))), np.sqrt(6) * d.mu * elastic_limit
    if passed <= limit * (1 + 1e-12):
        return plastic
    grown = plastic + (1 - limit / passed) * e
    most = max(plastic_limit, size(plastic))
    return grown if size(grown) <= most else most / size(grown) * grown
