# SPDX-License-Identifier: BSD-3-Clause
"""Viscosity, with the velocities that it sees at walls, and heat: the other half of model.py, whose State it reads."""

import numpy as np

from kernels import viscosity_laplacian
from model import LIQUID, WALL, is_central, summed


def seen_velocity_at_start(s):
    """v of what moves by itself, V + omega x arm of members of rigid bodies; of walls that liquid is near the mirrored
    one, 8.4."""
    v = s.vector("velocity").copy()
    for i in range(s.n):
        if s.body[i] >= 0 and s.moves_as_one(s.body[i]):
            b = {k: np.array(values[s.body[i]]) for k, values in s.raw["bodies"].items()}
            v[i] = b["body.velocity"] + np.cross(
                b["body.angular_velocity"], s.r[i] + s.box_widths(i) - b["body.centre"]
            )
    return v


def mirrored(s):
    """2 v_w - mean v_f of 8.4, and of which walls; the sums it is made of."""
    mu = s.material("viscosity", 0.0)
    slips = np.array([k < len(s.scene["bodies"]) and s.scene["bodies"][k]["slip"] == "free" for k in s["source"]])
    sticks = ~slips | s.printed("viscosity")  # no other viscous pair would see it
    pairs = ((s.group == WALL) & sticks)[:, None] & (s.group[None, :] == LIQUID)
    weight = np.where(pairs, -mu[None, :] * s.slope_over_r * s.shear_weight, 0.0)
    v_f = s.vector("viscous_velocity")
    total, moved = weight.sum(axis=1), weight @ np.where((s.group == LIQUID)[:, None], v_f, 0.0)
    wet = np.flatnonzero(total > 0)
    rough = s.condition * weight
    return (
        wet,
        2 * s.vector("velocity")[wet] - moved[wet] / total[wet, None],
        total,
        moved,
        rough.sum(axis=1),
        rough @ np.linalg.norm(v_f, axis=1),
    )


def pair_viscosity(s):
    """mu_ij of 8.5; (8) prints the arithmetic mean."""
    contact = s.scene["contact_viscosity"]
    solid = s.group != LIQUID
    mu = np.where(solid, contact, s.material("viscosity", 0.0))
    if s.printed("viscosity"):
        return 0.5 * (mu[:, None] + mu[None, :])
    slips = (
        np.array([k < len(s.scene["bodies"]) and s.scene["bodies"][k]["slip"] == "free" for k in s["source"]]) & solid
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        harmonic = np.where(
            mu[:, None] + mu[None, :] > 0, 2 * mu[:, None] * mu[None, :] / (mu[:, None] + mu[None, :]), 0.0
        )
    of_liquid = np.where(
        solid[:, None], np.where(slips[:, None], 0.0, mu[None, :]), np.where(slips[None, :], 0.0, mu[:, None])
    )
    both, none = solid[:, None] & solid[None, :], ~solid[:, None] & ~solid[None, :]
    return np.where(both, contact, np.where(none, harmonic, of_liquid))


def viscous_coefficient(s):
    """G_ij [kg/s]: of `central` that of the velocity along the line of centres."""
    V, mu = s["volume"], pair_viscosity(s)
    if s.printed("viscosity"):
        G = V[:, None] * V[None, :] * mu * viscosity_laplacian(s.distance, s.h)
    elif s.scene["viscosity_form"] == "central":
        G = 10 / s.M * mu * V[:, None] * V[None, :] * -s.slope_over_r * s.shear_weight
    else:
        G = (V[:, None] ** 2 + V[None, :] ** 2) / s.M * mu * -s.slope_over_r
    return np.where(s.acts, G, 0.0)


def viscous_force(s):
    """(8) as printed, or `central` or `laplacian` of 8.5."""
    v = s.vector("viscous_velocity")
    dv = v[None, :] - v[:, None]
    speed = np.linalg.norm(v, axis=1)
    G = viscous_coefficient(s)
    scale = (s.condition * np.abs(G) * (speed[:, None] + speed[None, :])).sum(axis=1)
    if is_central(s):
        dv = (np.einsum("ijk,ijk->ij", dv, s.d) / s.r2)[..., None] * s.d
    return summed(s, G[..., None] * dv)[0], scale


def viscous_bound(s):
    """8.10 [s], of all but walls."""
    G, free = viscous_coefficient(s), s.group != WALL
    if is_central(s):
        tensor = np.einsum("ij,ijk,ijl->ikl", G / s.r2, s.d, s.d, optimize=True)
        rate = np.linalg.eigvalsh(tensor)[:, 2]
    else:
        rate = G.sum(axis=1)
    greatest = (rate / s.m)[free].max()
    return (0.3 if is_central(s) else 0.5) / greatest


# --- heat -------------------------------------------------------------------------------------------------------------


def heat_printed(s):
    """(21): dT_i/dt and the sum of its coefficients."""
    c = s.material("conductivity") / (s.material("density") * s.material("heat_capacity"))
    a = c[:, None] * s["volume"][None, :] * viscosity_laplacian(s.distance, s.h)
    T = s["temperature"]
    return (
        (a * (T[None, :] - T[:, None])).sum(axis=1),
        (s.condition * a * (np.abs(T)[None, :] + np.abs(T)[:, None])).sum(axis=1),
        a.sum(axis=1),
    )


def conduction_sums(s):
    """Q_i = sum w d d^T e e^T over vectors of six components, and S_i = sum 2 w d, of 8.6; w = 1/2 V_j K."""
    V = s.m / s.material("density")
    w = V[None, :] * (s["conductivity"] > 0)[None, :] * -s.slope_over_r
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    dd = np.stack([s.d[..., a] * s.d[..., b] * (1 if a == b else 2**0.5) for a, b in pairs], -1)
    return np.einsum("ij,ijk,ijl->ikl", w / s.distance**2, dd, dd, optimize=True), np.einsum("ij,ijk->ik", 2 * w, s.d)


def conduction_tensor(Q, S, dx):
    """B of 8.6."""
    one, S = np.array([1.0, 1, 1, 0, 0, 0]), S * dx
    QI = Q @ one
    if not QI @ one > 0:
        return np.zeros((3, 3))
    fade = 0.08 * (QI @ one) / 3

    def solved(target):
        values, vectors = np.linalg.eigh(Q)
        return vectors @ (values / (values**2 + fade**2) * (vectors.T @ target))

    even = (QI @ one) / (QI @ QI)
    B = even * one + solved(one - even * QI)
    most = 0.62 * (S @ S - 0.1)
    if most > 0:
        n, root = S / np.linalg.norm(S), 2**0.5
        normal = np.array([*n**2, root * n[1] * n[2], root * n[0] * n[2], root * n[0] * n[1]])
        taken = solved(normal)
        along, per_f = normal @ B, normal @ taken
        B = B - (most if per_f * most <= along else max(along / per_f, 0.0)) * taken
    xx, yy, zz, yz, xz, xy = B / np.array([1, 1, 1, 2**0.5, 2**0.5, 2**0.5])
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def pseudo_inverse(M, cut):
    """Of a symmetric matrix; eigenvalues below `cut` times the largest count as zero. Also how many do not."""
    values, vectors = np.linalg.eigh(M)
    keep = (values >= cut * values[-1]) & (values[-1] > 0)
    inverse = (vectors[:, keep] / values[keep]) @ vectors[:, keep].T
    return inverse, int(keep.sum())


def heat_corrected(s):
    """dH_i/dt of 8.6, what its magnitudes sum to, and the sum of G_ij."""
    V, k, T, B = s.m / s.material("density"), s["conductivity"], s["temperature"], s.symmetric("moment_inverse")
    e = s.d / s.distance[..., None]
    along = 0.5 * np.maximum(
        np.einsum("ijk,ikl,ijl->ij", e, B, e, optimize=True) + np.einsum("ijk,jkl,ijl->ij", e, B, e, optimize=True), 0
    )
    G = V[:, None] * V[None, :] * 2 * k[:, None] * k[None, :] / (k[:, None] + k[None, :]) * along * -2 * s.slope_over_r
    return (
        (G * (T[None, :] - T[:, None])).sum(axis=1),
        (np.abs(G) * (np.abs(T)[None, :] + np.abs(T)[:, None])).sum(axis=1),
        G.sum(axis=1),
    )
