# SPDX-License-Identifier: BSD-3-Clause
"""Sums of model 8.3 for liquid that the transport velocity moves."""

import numpy as np

import model


def transport_forces(s):
    """8.3, transport velocity: the background force, and that of the momentum that the shift carries."""
    V, rho, v, w = s["volume"], s["density"], s.vector("viscous_velocity"), s.vector("shift")
    gradient = s.slope_over_r[..., None] * s.d
    both = V[:, None] ** 2 + V[None, :] ** 2
    background = -s.stiffness * s.rest_densities()[0] / s.S0 * both[..., None] * gradient
    carried = (rho * 1.0)[:, None] * v
    along_i = np.einsum("ik,ijk->ij", w, gradient)
    along_j = np.einsum("jk,ijk->ij", w, gradient)
    stress = (
        0.5 / s.S0 * both[..., None] * (carried[:, None] * along_i[..., None] + carried[None, :] * along_j[..., None])
    )
    return model.summed(s, background), model.summed(s, stress)


def damping_of_sound(s, v):
    """q of 8.3, of the velocities v."""
    reference, lightest = s.rest_densities()
    zeta = (
        s.scene["sound_damping"]
        * np.minimum(s.material("density"), 4 * lightest)
        * np.sqrt(s.stiffness * reference / lightest)
        * s.h
    )
    along = np.einsum("ijk,ijk->ij", v[:, None] - v[None, :], s.slope_over_r[..., None] * s.d)
    q = zeta * s["volume"] / s.M * along.sum(axis=1)
    size = np.linalg.norm(v[None, :] - v[:, None], axis=2) * np.linalg.norm(s.slope_over_r[..., None] * s.d, axis=2)
    return np.where(s.group == model.LIQUID, q, 0.0), zeta * s["volume"] / s.M * (s.condition * size).sum(axis=1)
