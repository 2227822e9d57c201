# SPDX-License-Identifier: BSD-3-Clause
"""Sums of model 8.12 for liquid that carries its density, at a start, where all columns are of one state.

`D` is r_j - r_i, `f` is -W'/r, and a tensor T of each particle acts on D as T D. An impedance of 0 marks a solid."""

import numpy as np

import model
from kernels import isotropic_shear, wendland, wendland_slope

FORMS = {  # pair of pressures, damping
    "adjoint": ("own", "residue"),
    "adjoint_limited": ("own", "limited residue"),
    "reverse": ("reverse", "limited residue"),
    "reverse_riemann": ("reverse plain", "limited"),
    "mean": ("mean", "residue"),
}
BETA = 0.1


class Pairs:
    """What all sums share: [i, j] or [i, j, k]."""

    def __init__(self, s):
        self.s, self.D = s, -s.d
        self.z, self.rest, self.V = s["impedance"], s["liquid_rest_density"], s["carried_volume"]
        self.wall = self.z == 0
        self.f = np.where((s.distance < s.h) & ~both_solid(s), -s.slope_over_r, 0.0)
        self.same = (self.rest[:, None] == self.rest[None, :]) & ~self.wall[None, :]
        self.liquids = ~self.wall[:, None] & ~self.wall[None, :]
        B = s.symmetric("correction")
        self.of_i = self.D @ B.swapaxes(1, 2)
        self.of_j = (self.D.swapaxes(0, 1) @ B.swapaxes(1, 2)).swapaxes(0, 1)

    def sides(self, pair):
        """X and Y over f."""
        if pair == "own":
            return self.of_i, self.of_j
        own = 0.5 if pair == "mean" else 0.0
        X = own * self.of_i + (1 - own) * self.of_j
        Y = own * self.of_j + (1 - own) * self.of_i
        X[:, self.wall] = self.of_i[:, self.wall]
        Y[self.wall] = self.of_j[self.wall]
        return X, Y


def total(s, pairs):
    """Sums over j, and the sum of their magnitudes, each times its condition."""
    size = np.abs(pairs).reshape(s.n, s.n, -1).max(axis=2)
    return pairs.sum(axis=1), (s.condition * size).sum(axis=1)


def summed_density(s):
    return total(s, wendland(s.distance, s.h))


def summed_slope(s):
    f = np.where(s.distance < s.h, -s.slope_over_r, 0.0)
    return total(s, f[..., None] * -s.d)


def moments(s):
    """M of all neighbours, M of the same liquid, and the share of solids."""
    p = Pairs(s)
    outer = p.D[..., :, None] * p.D[..., None, :]
    f = p.f * p.V[None, :]
    share = np.where(p.wall[None, :], p.V[None, :] * wendland(s.distance, s.h), 0.0)
    return [
        total(s, f[..., None, None] * outer),
        total(s, np.where(p.same, f, 0.0)[..., None, None] * outer),
        total(s, share),
    ]


def blended(M, full):
    """Inverse that fades to 0 where the determinant is below `full`."""
    det = np.linalg.det(M)
    usable = det > 1e-9
    inverse = np.linalg.inv(np.where(usable[:, None, None], M, np.eye(3)))
    share = np.where(usable, det / (det + np.maximum(full - det, 0)), 0.0)
    return share[:, None, None] * inverse


def gradients(s, pair):
    """Of velocity and pressure; the unevenness; the divergence."""
    p = Pairs(s)
    v, P = s.vector("velocity"), s["carried_pressure"]
    dv = v[None, :] - v[:, None]
    f = p.f * p.V[None, :]
    G = np.where(p.same, f, 0.0)[..., None] * p.D
    inverse = blended(s.symmetric("own_moment"), 0.02)
    size = np.abs(inverse).max(axis=(1, 2)) * 3
    A, A_size = total(s, dv[..., :, None] * G[..., None, :])
    slope, slope_size = total(s, (P[None, :] - P[:, None])[..., None] * G)
    X, Y = p.sides(pair)
    along = p.D if pair == "reverse plain" else X
    if s.has("face_rate.xx"):
        e = s.symmetric("face_rate")
        meet = (p.wall[:, None] != p.wall[None, :])[..., None]
        dv = dv - np.where(meet, 0.5 * np.einsum("ijkl,ijl->ijk", e[:, None] + e[None, :], p.D), 0.0)
    return [
        (A @ inverse, A_size * size),
        (np.einsum("ikl,il->ik", inverse, slope), slope_size * size),
        total(s, f[..., None] * (X + Y)),
        total(s, f * np.einsum("ijk,ijk->ij", dv, along)),
    ]


def greatest_near(s):
    """Whether a neighbour is exposed, and the greatest square of a velocity difference."""
    within = s.distance < s.h
    v = s.vector("velocity")
    speed2 = ((v[None, :] - v[:, None]) ** 2).sum(axis=2)
    liquid = within & (s["impedance"] != 0)[None, :]
    near = np.where(within, s["exposed"][None, :], 0.0).max(axis=1)
    return near, np.where(liquid, speed2, 0.0).max(axis=1)


def at_solids(s):
    """Of solids: sums V W over liquids, of 1, of their pressure, and of the weight between them and the solid."""
    p = Pairs(s)
    share = np.where(p.wall[:, None] & ~p.wall[None, :], p.V[None, :] * wendland(s.distance, s.h), 0.0)
    lean = np.einsum("ik,ijk->ij", s.vector("pull"), p.D)
    return (
        total(s, share),
        total(s, share * s["carried_pressure"][None, :]),
        total(s, -share * s["density"][None, :] * lean),
    )


def pressure_force(s, pair):
    p = Pairs(s)
    P = s["carried_pressure"]
    X, Y = p.sides(pair)
    out = s["wall_pressure"]
    push = np.where(p.wall[None, :], out[:, None], 0.0) + np.where(p.wall[:, None], out[None, :], 0.0)
    inner = P[:, None, None] * X + P[None, :, None] * Y + push[..., None] * p.D
    pairs = model.summed(s, -(p.f * p.V[:, None] * p.V[None, :])[..., None] * inner)
    return [sum(parts) for parts in zip(pairs, model.interface_force(s, 1.0), face_force(s))]


def face_load(s):
    """Of elastic particles that liquid touches: half the sum of f (x) d + d (x) f over liquids, f the force of pressure
    on the solid."""
    p = Pairs(s)
    stress = (s["carried_pressure"] * p.V)[:, None, None] * s.symmetric("correction")
    T = p.V[None, :, None, None] * stress[:, None] + p.V[:, None, None, None] * stress[None, :]
    f = -np.where(p.wall[:, None] & ~p.wall[None, :], p.f, 0.0)[..., None] * np.einsum("ijkl,ijl->ijk", T, p.D)
    fd = f[..., :, None] * p.D[..., None, :]
    return total(s, 0.5 * (fd + fd.transpose(0, 1, 3, 2)))


def face_force(s):
    """What the loads do to bonds."""
    force, scale = np.zeros((s.n, 3)), np.zeros(s.n)
    if not s.has("face_load.xx"):
        return force, scale
    A, load = s.symmetric("shape_inverse"), s.symmetric("face_load")
    elastic, inverse = model.inverse_deformations(s)
    for k in np.flatnonzero(elastic & (s["touching"] > 0)):
        size = np.abs(load[k]).max() * np.abs(A[k]).max()
        model.add_bond_load(s, k, -0.5 * load[k] @ inverse[k].T @ A[k], size, force, scale)
    return force, scale


def viscous_force(s):
    p = Pairs(s)
    mu, slips, seen = s["liquid_viscosity"], s["slips"], s.vector("predicted_velocity")
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = 2 * mu[:, None] * mu[None, :] / (mu[:, None] + mu[None, :])
    sticks = 2 * (1 - slips)
    at_wall = (
        np.where(p.wall, sticks, 0.0)[:, None] * mu[None, :] + np.where(p.wall, sticks, 0.0)[None, :] * mu[:, None]
    )
    along = np.einsum("ijk,ijk->ij", seen[None, :] - seen[:, None], p.D) / s.r2
    c, square = isotropic_shear(s.scene["support_ratio"])
    weight = c + square * (np.where(np.isfinite(s.distance), s.distance, 0.0) / s.scene["spacing"]) ** 2
    k = 10 / s.M * weight * p.f * p.V[:, None] * p.V[None, :] * np.where(p.liquids, mean, at_wall) * along
    return model.summed(s, k[..., None] * p.D)


def parting(p, damping):
    """Rate at which a pair parts [1/s], and the part of it that linear reconstruction leaves."""
    s, v = p.s, p.s.vector("predicted_velocity")
    rate = np.einsum("ijk,ijk->ij", v[None, :] - v[:, None], p.D) / s.r2
    if damping == "limited":
        return rate, rate
    E = s.symmetric("strain_rate")
    both = E[:, None] + E[None, :]
    return rate, rate - 0.5 * np.einsum("ijk,ijkl,ijl->ij", p.D, both, p.D, optimize=True) / s.r2


def residue_force(s, damping):
    p = Pairs(s)
    z_i, z_j = p.z[:, None], p.z[None, :]
    both = z_i + z_j + 1e-300
    rate, left = parting(p, damping)
    r = np.where(np.isfinite(s.distance), s.distance, 0.0)
    way = BETA * 0.5 * s.h if damping == "residue" else r
    with np.errstate(invalid="ignore"):
        ff = np.where(p.liquids, p.f * p.V[:, None] * p.V[None, :] * 2 * z_i * z_j / both, 0.0)
        if damping == "residue":
            pressed = s["carried_pressure"] != 0
            holds = (pressed[:, None] | pressed[None, :]) & (p.rest[:, None] == p.rest[None, :])
            k = way * np.where(holds, ff * left, 0.0)
        else:
            u = r * np.where(rate > left, -rate, -left)
            mach = 3 * u * (p.rest[:, None] + p.rest[None, :]) / both
            k = np.where(u > 0, -ff * u * np.minimum(mach, 1.0), 0.0)
    scale = (s.condition * ff * (np.abs(rate) + np.abs(rate - left)) * way * r).sum(axis=1)
    return (k[..., None] * p.D).sum(axis=1), scale


def diffused(s, damping):
    p = Pairs(s)
    P = s["pressure"]
    if damping == "limited":
        r = np.where(np.isfinite(s.distance), s.distance, 0.0)
        z = p.z[:, None] + p.z[None, :] + 1e-300
        return total(s, np.where(p.liquids, 2 * p.V[None, :] * (P[None, :] - P[:, None]) * p.f * r / z, 0.0))
    slope = s.vector("pressure_gradient")
    linear = 0.5 * np.einsum("ijk,ijk->ij", slope[:, None] + slope[None, :], p.D)
    same = p.liquids & (p.rest[:, None] == p.rest[None, :])
    jump = P[None, :] - P[:, None]
    terms = np.where(same, p.f * p.V[None, :], 0.0)
    sums = (terms * (jump - linear)).sum(axis=1)
    return sums, (s.condition * terms * (np.abs(jump) + np.abs(linear))).sum(axis=1)


def both_solid(s):
    solid = s["impedance"] == 0
    return solid[:, None] & solid[None, :]


def solid_number_density(s):
    """8.2 over solids alone."""
    total = np.where(s.own | ~both_solid(s), 0.0, wendland(s.distance, s.h)).sum(axis=1) + wendland(0.0, s.h)
    total = total + s["own_density"]
    return total, total


def solid_pressure_force(s):
    """8.3 with its core, between solids."""
    share = s["pressure_share"]
    kappa, reach = 0.03 * s.stiffness * s.rest_densities()[0] * s.dx, s.scene["core_reach"] * s.dx
    size = -(share[:, None] + share[None, :]) * wendland_slope(s.distance, s.h)
    core = np.where(s.distance < min(s.h, reach), kappa * (reach - s.distance), 0.0)
    pairs = np.where(s.acts & both_solid(s), size + core, 0.0)
    return model.summed(s, pairs[..., None] * s.d / s.distance[..., None])


def solid_viscous_force(s):
    """`central` of 8.5, between solids."""
    V, v = s["volume"], s.vector("viscous_velocity")
    G = 10 / s.M * s.scene["contact_viscosity"] * V[:, None] * V[None, :] * -s.slope_over_r
    along = np.einsum("ijk,ijk->ij", v[None, :] - v[:, None], s.d) / s.r2
    return model.summed(s, np.where(s.acts & both_solid(s), G * along, 0.0)[..., None] * s.d)


def half_step_velocity(s):
    """Of liquids that of the middle of the last step, by its second kick."""
    force = sum(s.vector(name) for name in ("force", "viscous_force", "residue_force")) / s.m[:, None]
    kick = s.raw["step_numbers"]["carried_half_step"] * (force + np.array(s.scene["gravity"]))
    return s.vector("velocity") - np.where((s["impedance"] != 0)[:, None], kick, 0.0)


class Halfway:
    """Velocities, distances and slopes -W'/r amid the last drift, of pairs within reach at its end."""

    def __init__(self, s, half_step):
        p, within = Pairs(s), s.distance < s.h
        v = half_step_velocity(s)
        self.v = v[None, :] - v[:, None]
        self.D = p.D - half_step * self.v
        r = np.sqrt((self.D**2).sum(axis=2))
        self.f = np.where(within & ~both_solid(s), -wendland_slope(r, s.h) / np.where(within, r, 1.0), 0.0)
        self.W = np.where(within, wendland(r, s.h), 0.0)


def sound_rate(s, half_step):
    """Divergence, share of liquids at solids, and what solids add to the divergence."""
    p, amid = Pairs(s), Halfway(s, half_step)
    X = np.einsum("ikl,ijl->ijk", s.symmetric("correction_halfway"), amid.D)
    rate = amid.f * p.V[None, :] * np.einsum("ijk,ijk->ij", amid.v, X)
    touching = np.where(p.wall[:, None] & ~p.wall[None, :], amid.W * p.V[None, :], 0.0)
    added = np.where(p.wall[None, :] & ~p.wall[:, None], amid.W * s["displaced"][None, :], 0.0)
    return total(s, rate), total(s, touching), total(s, added)


def compare_rate(out, s, half_step):
    wet = s["impedance"] != 0
    # The velocity of a solid that moves is not known at the middle of the step: its neighbours are left out.
    moves = ~wet & (s.vector("velocity") != 0).any(axis=1)
    known = ~moves & ~((s.distance < s.h) & moves[None, :]).any(axis=1)
    divergence, touching, added = sound_rate(s, half_step)
    of = lambda name, rows, twin: (s[name][rows], twin[0][rows], twin[1][rows])
    out.compare("sound rate 8.12", *of("divergence", known, divergence))
    out.compare("sound rate 8.12", *of("touching_halfway", known & ~wet, touching))
    out.compare("wall rate 8.12", *of("wall_rate", known & wet, added))


def compare_sound(out, s):
    """A step that takes the gradients that an earlier one has formed."""
    wet = s["impedance"] != 0
    share = moments(s)[2]
    out.compare("sound rate 8.12", s["wall_share"][wet], share[0][wet], share[1][wet])
    out.compare("sound force 8.12", s.vector("force")[wet], *(one[wet] for one in pressure_force(s, "own")))
    for name, twin in (("viscous_force", viscous_force(s)), ("residue_force", residue_force(s, "residue"))):
        out.compare("sound force 8.12", s.vector(name)[wet], *(one[wet] for one in twin))


def compare_always(out, s, before):
    """What the state after any step tells."""
    wet = s["impedance"] != 0
    at = lambda pair_of: (pair_of[0][wet], pair_of[1][wet])
    dry = lambda pair_of: (pair_of[0][~wet], pair_of[1][~wet])
    if before is None or s.raw["step_numbers"]["carried_steps_held"] == 0:
        out.compare("carried sum 8.12", s["summed_density"][wet], *at(summed_density(s)))
        out.compare("slope of the sum 8.12", s.vector("summed_slope")[wet], *at(summed_slope(s)))
    for name, twin in zip(("touching", "pressed", "weighed"), at_solids(s)):
        out.compare("wall pressure 8.12", s[name][~wet], *dry(twin))
    if s.has("face_load.xx"):
        solid = ~wet & (s["touching"] > 0)
        sums, scale = face_load(s)
        out.compare("load of faces 8.12", s.symmetric("face_load")[solid], sums[solid], scale[solid])


def compare(out, s, before):
    """Most at a start alone: later the density has moved on since the volumes were taken."""
    pair, damping = FORMS[s.form_of_pressure]
    wet = s["impedance"] != 0
    at = lambda pair_of: (pair_of[0][wet], pair_of[1][wet])
    dry = lambda pair_of: (pair_of[0][~wet], pair_of[1][~wet])
    compare_always(out, s, before)
    if before is not None:
        if pair == "own":
            compare_rate(out, s, s.raw["step_numbers"]["carried_half_step"])
        if s.raw["step_numbers"]["carried_steps_held"] > 0:
            compare_sound(out, s)
        return
    for name, moment in zip(("moment", "own_moment"), moments(s)):
        out.compare("carried moments 8.12", s.symmetric(name)[wet], *at(moment))
    out.compare("carried moments 8.12", s["wall_share"][wet], *at(moments(s)[2]))
    A, slope, uneven, divergence = gradients(s, pair)
    found = np.array([[s[f"velocity_gradient.{a}{b}"] for b in "xyz"] for a in "xyz"]).transpose(2, 0, 1)
    for solver, twin in (
        (found, A),
        (s.symmetric("strain_rate"), ((A[0] + A[0].transpose(0, 2, 1)) / 2, A[1])),
        (s.vector("pressure_gradient"), slope),
        (s.vector("unevenness"), uneven),
        (s["divergence"], divergence),
    ):
        out.compare("carried gradients 8.12", solver[wet], *at(twin))
    out.compare("carried gradients 8.12", s["divergence"][~wet], *dry(divergence))
    near, speed2 = greatest_near(s)
    out.compare("carried gradients 8.12", s["exposed_near"][wet], near[wet], 1.0)
    out.compare("carried gradients 8.12", s["nearby_speed2"][wet], speed2[wet], speed2[wet])
    pressure, viscous = pressure_force(s, pair), viscous_force(s)
    if s.has("number_density"):
        out.compare("number density of solids 8.12", s["number_density"][~wet], *dry(solid_number_density(s)))
        pressure = [a + b for a, b in zip(pressure, solid_pressure_force(s))]
        viscous = [a + b for a, b in zip(viscous, solid_viscous_force(s))]
        out.compare("pressure force of solids 8.12", s.vector("force")[~wet], *dry(pressure))
    out.compare("carried pressure force 8.12", s.vector("force"), *pressure)
    out.compare("carried viscous force 8.12", s.vector("viscous_force"), *viscous)
    out.compare("carried damping 8.12", s.vector("residue_force"), *residue_force(s, damping))
    out.compare("carried diffusion 8.12", s["diffused"][wet], *at(diffused(s, damping)))
