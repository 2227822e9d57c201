# SPDX-License-Identifier: BSD-3-Clause
"""The terms of docs/model.md as plain sums over all pairs, for a state that write-states has written.

Nothing here is shared with the solver but the page. Each function names its section. `d[i, j]` is r_i - r_j of the
nearest images; sums are over all j but i itself. A function returns the sum and the sum of the magnitudes of what it
added, which round-off is measured by."""

import numpy as np

from kernels import interface_kernel, isotropic_shear, lattice_numbers, poly6, spiky_slope, wendland, wendland_slope

LIQUID, DEFORMABLE, WALL = -1.0, -2.0, 0.0  # groups; 1 + body for free rigid bodies


# --- a state ----------------------------------------------------------------------------------------------------------


class State:
    """Columns by name, in order of id; distances of all pairs."""

    def __init__(self, scene, state):
        self.scene, self.raw = scene, state
        self.dx = scene["spacing"]
        self.h = scene["support_ratio"] * self.dx
        self.S0, self.M, self.layer = lattice_numbers(scene["support_ratio"])
        self.columns = {name: np.array(values) for name, values in state["particles"].items()}
        self.n = len(self["id"])
        self.m = self["mass"]
        self.r = self.vector("position")
        self.periodic = ["xyz".index(a) for a in scene["periodic"]]
        self.d = self.nearest(self.r[:, None] - self.r[None, :])
        self.r2 = np.einsum("ijk,ijk->ij", self.d, self.d)
        np.fill_diagonal(self.r2, np.inf)  # a particle is no neighbour of itself
        self.distance = np.sqrt(self.r2)
        self.materials = scene["materials"]
        self.body = self["body"]
        self.group = self._groups()
        self.own = np.zeros((self.n, self.n), dtype=bool)
        for i, j, _ in state["own_pairs"]:
            self.own[i, j] = True
        self.bonds = [[] for _ in range(self.n)]
        for i, j, *numbers in state["bonds"]:
            self.bonds[i].append((j, np.array(numbers[:3]), np.array(numbers[3:6]), numbers[6]))

    def __getitem__(self, name):
        return self.columns[name]

    def has(self, name):
        return name in self.columns

    def vector(self, name):
        return np.stack([self[f"{name}.{a}"] for a in "xyz"], axis=1)

    def symmetric(self, name):
        c = {a: self[f"{name}.{a}"] for a in ("xx", "yy", "zz", "yz", "xz", "xy")}
        rows = [[c["xx"], c["xy"], c["xz"]], [c["xy"], c["yy"], c["yz"]], [c["xz"], c["yz"], c["zz"]]]
        return np.moveaxis(np.array(rows), 2, 0)

    def box_widths(self, i):
        """By how much particle i has been moved back into the box."""
        back = np.zeros(3)
        for a in self.periodic:
            back[a] = self["image." + "xyz"[a]][i] * (self.scene["max"][a] - self.scene["min"][a])
        return back

    def nearest(self, d):
        for a in self.periodic:
            width = self.scene["max"][a] - self.scene["min"][a]
            d[..., a] -= width * np.round(d[..., a] / width)
        return d

    def printed(self, term):
        return self.scene["modes"][term] == "paper"

    def material(self, key, default=None):
        """A number of each particle's material."""
        return np.array(
            [default if self.materials[k].get(key) is None else self.materials[k][key] for k in self["material"]],
            dtype=float,
        )

    def moves_as_one(self, body):
        return self.raw["bodies"]["body.phase"][body] == 2

    def _groups(self):
        """Who exerts nothing on whom: chapter 13, `group`."""
        motion = self.raw["bodies"].get("body.motion", [])
        of = [
            DEFORMABLE if not self.moves_as_one(b) else 1.0 + b if motion[b] == 0 else WALL for b in range(len(motion))
        ]
        return np.array([LIQUID if b < 0 else of[b] for b in self.body])

    @property
    def clamps(self):
        """Reading 1: the clamp of (9) is a correction with a form of its own."""
        return not self.printed("clamp")

    @property
    def acts(self):
        """Pairs that exert pressure and viscous force: 8.3."""
        one_body = (self.group[:, None] >= 0) & (self.group[:, None] == self.group[None, :])
        return ~self.own & ~one_body

    @property
    def condition(self):
        """Digits that a kernel loses near the edge of its support, where 1 - r/h cancels."""
        return np.where(self.distance < self.h, 1 / np.maximum(1 - self.distance / self.h, 1e-300), 0.0)

    @property
    def slope_over_r(self):
        return wendland_slope(self.distance, self.h) / self.distance

    @property
    def shear_weight(self):
        """Of -W'/r in 8.5 and 8.4: scene.isotropic_shear of the weight c + s (r/dx)^2."""
        if not is_central(self):
            return 1.0
        share, (c, s) = self.scene["isotropic_shear"], isotropic_shear(self.scene["support_ratio"])
        return 1.0 + share * (c + s * np.where(np.isfinite(self.r2), self.r2, 0.0) / self.dx**2 - 1.0)

    @property
    def stiffness(self):
        return max(m["stiffness"] or 0.0 for m in self.materials)

    def stiffnesses(self):
        """k of each particle: twice that of the scene in a patch of a wall, 8.4; that of solids where one is free and
        none freezes, 8.3."""
        k = np.full(self.n, self.stiffness)
        if self.averages_walls():
            return np.where(self.group == WALL, 2 * k, k)
        free = any(b["phase"] != "liquid" and b["motion"] == "free" for b in self.scene["bodies"])
        stiffer = free and not self.printed("state") and not self.has("liquid_fraction")
        return np.where((self.group != LIQUID) & stiffer, (1 + self.scene["contact_stiffness"]) * k, k)

    def rest_densities(self):
        """rho_ref and the lightest rest density: 8.3. (No scene here has an inflow.)"""
        density = {m["name"]: m["density"] for m in self.materials}
        liquids = [density[b["material"]] for b in self.scene["bodies"] if b["phase"] == "liquid"]
        all_of = [density[b["material"]] for b in self.scene["bodies"]]
        return max(liquids or all_of), min(all_of)

    def averages_walls(self):
        """8.4: liquid alone touches the walls, and nothing freezes."""
        free = any(b["phase"] != "liquid" and b["motion"] == "free" for b in self.scene["bodies"])
        printed = any(self.printed(t) for t in ("walls", "density", "pressure"))
        return not free and not printed and not self.has("liquid_fraction") and (self.group == WALL).any()

    def surface(self):
        """p_s and b of 8.3: where clamp, density, pressure and state are corrected, and nothing freezes."""
        corrected = self.clamps and not any(self.printed(t) for t in ("density", "pressure", "state"))
        free = any(b["phase"] != "liquid" and b["motion"] == "free" for b in self.scene["bodies"])
        on = corrected and not free and not self.has("liquid_fraction")
        weight = (
            self.scene["surface_weight"] * np.linalg.norm(np.delete(self.scene["gravity"], self.periodic)) * self.dx
        )
        return np.where(self.group == LIQUID, weight * self.material("density"), 0.0) * on, 0.5 * (
            1 + self.layer / self.S0
        )


def inverse_deformations(s):
    """Which particles are elastic and bonded in all directions, and F^-1 of each: the identity of all others."""
    elastic = (s.group == DEFORMABLE) & (s["shape_rank"] == 3)
    inverse, A = np.tile(np.eye(3), (s.n, 1, 1)), s.symmetric("shape_inverse")
    for i in np.flatnonzero(elastic):
        sum_of = sum(
            np.outer(s.nearest(s.r[j] - s.r[i]) + x, s["solid_volume"][j] * gradient)
            for j, x, gradient, _ in s.bonds[i]
        )
        inverse[i] = np.linalg.inv(np.eye(3) + sum_of @ A[i])
    return elastic, inverse


def add_bond_load(s, k, T, size, force, scale):
    """Adds what the load T on particle k does to its bonds."""
    for j, _, gradient, _ in s.bonds[k]:
        f = s["solid_volume"][j] * T @ gradient
        force[k] += f
        force[j] -= f
        scale[[k, j]] += s["solid_volume"][j] * size * np.linalg.norm(gradient)


def faces(s):
    """Pairs with an elastic particle whose pressure acts at its face (8.3), r_i - r_j measured there (d*) and its
    length, and F^-1 of each particle: the identity of what is not elastic. None where the scene does not ask for it."""
    share = s.scene["face_pressure"]
    if share == 0 or not s.has("shape_rank") or any(s.printed(t) for t in ("density", "pressure", "state", "elastic")):
        return None
    elastic, inverse = inverse_deformations(s)
    D = 0.5 * share * (np.einsum("iba,ibc->iac", inverse, inverse) - np.eye(3))
    at_face = s.d + np.einsum("iab,ijb->ija", D, s.d) + np.einsum("jab,ijb->ija", D, s.d)
    distance = np.sqrt(np.einsum("ijk,ijk->ij", s.d, at_face))
    np.fill_diagonal(distance, np.inf)
    return s.acts & (elastic[:, None] | elastic[None, :]), at_face, distance, inverse, elastic


def face_forces(s):
    """What 8.3 adds to the pressure force where pressure acts at faces: pairs, and the load on bonds."""
    found = faces(s)
    if found is None:
        return 0.0, 0.0
    pairs, at_face, distance, inverse, elastic = found
    pressure = np.where(pairs, s["pressure_share"][:, None] + s["pressure_share"][None, :], 0.0)
    there, here = wendland_slope(distance, s.h) / distance, s.slope_over_r
    force = -(pressure[..., None] * (there[..., None] * at_face - here[..., None] * s.d)).sum(axis=1)
    edge = np.where(distance < s.h, 1 / np.maximum(1 - distance / s.h, 1e-300), 0.0)
    scale = np.abs(pressure * edge * wendland_slope(distance, s.h)).sum(axis=1)
    A = s.symmetric("shape_inverse")
    for k in np.flatnonzero(elastic):
        y = s.d[k] @ inverse[k].T
        load = -0.5 * s.scene["face_pressure"] * np.einsum("j,ja,jb->ab", pressure[k] * there[k], y, y)
        T = inverse[k].T @ load @ A[k]
        add_bond_load(s, k, T, np.abs(load).max() * np.abs(A[k]).max(), force, scale)
    return force, scale


def interface_share(s):
    """s of 8.3 where liquids sum their density."""
    corrected = s.clamps and not any(s.printed(t) for t in ("density", "pressure", "state"))
    return s.scene["interface_weight"] * (corrected and not s.has("liquid_fraction"))


def interfaces(s, share):
    """a of 8.3 for pairs of unlike liquids [i, j], g.d with d = r_j - r_i, K and K'/r."""
    c, square = interface_kernel(s.scene["support_ratio"])
    rho0, liquid = s.material("density"), s.group == LIQUID
    unlike = liquid[:, None] & liquid[None, :] & (s.distance < s.h)
    a = np.where(unlike, 0.5 * share * (rho0[:, None] - rho0[None, :]) * s.dx**6 / s.M, 0.0)
    g = np.array(s.scene["gravity"], dtype=float)
    g[s.periodic] = 0.0
    r2 = np.where(np.isfinite(s.r2), s.r2, 0.0)
    W, weight = wendland(s.distance, s.h), c + square * r2 / s.dx**2
    return a, g, -s.d @ g, weight * W, weight * s.slope_over_r + 2 * square / s.dx**2 * W


def interface_force(s, share):
    """The force of the energy of unlike pairs, and the sum of its magnitudes."""
    a, g, along, K, K_slope = interfaces(s, share)
    force = (a * K).sum(axis=1)[:, None] * g - ((a * along * K_slope)[..., None] * s.d).sum(axis=1)
    distance = np.where(np.isfinite(s.distance), s.distance, 0.0)
    size = np.abs(a) * (np.abs(K) * np.linalg.norm(g) + np.abs(along * K_slope) * distance)
    return force, (s.condition * size).sum(axis=1)


def summed(s, pairs):
    """Sums over j of vectors [i, j, k], and what their magnitudes sum to, each times its condition."""
    return pairs.sum(axis=1), (s.condition * np.linalg.norm(pairs, axis=2)).sum(axis=1)


# --- density and pressure ---------------------------------------------------------------------------------------------


def density_printed(s):
    """(4), the particle itself included."""
    total = (s.m[None, :] * poly6(s.distance, s.h)).sum(axis=1) + s.m * poly6(0.0, s.h)
    return total, total


def number_density(s):
    """S0 delta of 8.2: the particle itself, its excluded pairs by their constant weight, all others."""
    total = np.where(s.own, 0.0, wendland(s.distance, s.h)).sum(axis=1) + wendland(0.0, s.h)
    if s.has("own_density"):
        total = total + s["own_density"]
    if s.averages_walls():
        laid, d = from_lattice(s)
        total = total + np.where(laid, wendland(np.linalg.norm(d, axis=2), s.h) - wendland(s.distance, s.h), 0.0).sum(
            axis=1
        )
    if (found := faces(s)) is not None:
        pairs, _, distance, _, _ = found
        total = total + np.where(pairs, wendland(distance, s.h) - wendland(s.distance, s.h), 0.0).sum(axis=1)
    return total, total


def own_density(s):
    total = np.zeros(s.n)
    for i, _, weight in s.raw["own_pairs"]:
        total[i] += weight
    return total, total


def pressure(s):
    """(9), or 8.3; a patch of a wall has twice the stiffness, 8.4."""
    rho, rho0 = s["density"], s.material("density")
    k = s.stiffnesses()
    reference, _ = s.rest_densities()
    p = k * (rho - rho0) * (1.0 if s.printed("state") else reference / rho0)
    if s.clamps:
        p_s, b = s.surface()
        p = np.where(p < 0, p_s * np.maximum(0, 1 - np.abs(rho / rho0 - b) / (1 - b)), p)
    scale = np.abs(k * rho)
    if s.has("pressure_around"):
        W = np.where((s.group == LIQUID)[:, None] & (s.group == LIQUID)[None, :], wendland(s.distance, s.h), 0.0)
        weight = s.scene["mean_pressure"] * s.dx**3 / s.S0
        p, scale = p + weight * (W * (p[None, :] - p[:, None])).sum(axis=1), scale + weight * W @ scale
    return p, scale


def lattice_walls(s):
    """Particles of fixed walls, where jitter leaves each nearest to its own place of the lattice."""
    if not 0 < s.scene["jitter"] < 0.25:
        return np.zeros(s.n, dtype=bool)
    return np.array([b >= 0 and s.raw["bodies"]["body.motion"][b] == 1 for b in s.body]) & (s.group == WALL)


def from_lattice(s):
    """Pairs of liquid and wall that are felt from the lattice of 8.4, and r_i - r_j with the wall particle there."""
    moves, x = np.zeros((s.n, 3)), s.r / s.dx
    for source in np.unique(s["source"][lattice_walls(s)]):
        wall = lattice_walls(s) & (s["source"] == source)
        place = x[wall] - np.angle(np.exp(2j * np.pi * x[wall]).sum(axis=0)) / (2 * np.pi)
        moves[wall] = s.dx * np.round((np.round(place) - place) * 2.0**20) / 2.0**20
    liquid = s.group == LIQUID
    return (liquid[:, None] != liquid[None, :]) & (s.distance < s.h), s.d + moves[:, None, :] - moves[None, :, :]


def jitter_of_walls(s):
    """What jitter adds to the part of a fixed wall particle's density that is wall, over the rest density: 8.4."""
    of_one_lattice = (
        lattice_walls(s)[:, None]
        & lattice_walls(s)[None, :]
        & (s["source"][:, None] == s["source"][None, :])
        & (s.distance < s.h)
    )
    laid = wendland(np.linalg.norm(np.round(s.d / s.dx), axis=2) * s.dx, s.h)
    added = np.where(of_one_lattice, wendland(s.distance, s.h) - laid, 0.0).sum(axis=1) * s.dx**3 / s.S0
    return np.round(added * 2.0**20) / 2.0**20


def wall_patches(s):
    """A of 8.4 over the particles of faces, and which these are."""
    frame = np.array([-1 if b >= 0 and s.raw["bodies"]["body.motion"][b] == 1 else b for b in s.body])
    wall = s.group == WALL
    together = wall[:, None] & wall[None, :] & (frame[:, None] == frame[None, :])
    filled = np.where(together, wendland(s.distance, s.h), 0.0).sum(axis=1) + wendland(0.0, s.h)
    full = s.S0 / s.dx**3
    lacks_at_plane_face = 0.5 * (s.S0 - s.layer) / s.dx**3
    face = np.flatnonzero(wall & (filled < full - 0.5 * lacks_at_plane_face))
    near = (together & (s.distance < 1.75 * s.dx))[np.ix_(face, face)] | np.eye(len(face), dtype=bool)
    return near / near.sum(axis=1, keepdims=True), face


def density(s):
    """rho of 8.2, and of walls the mean of 8.4."""
    rho0 = s.material("density")
    rho = s.m * s["number_density"] / s.S0
    if s.averages_walls():
        A, face = wall_patches(s)
        at_face = A @ A @ (rho / rho0 - jitter_of_walls(s))[face]
        rho = np.where(s.group == WALL, rho0, rho)
        rho[face] = at_face * rho0[face]
    return rho, rho


def bulk_pressure(s, before):
    """q of 8.4."""
    dt = 2 * s.raw["step_numbers"]["half_step"]
    reference, lightest = s.rest_densities()
    c = np.sqrt(s.stiffness * reference / lightest)
    rho0 = np.minimum(s.material("density"), 4 * lightest)
    rate = (s["number_density"] / before["number_density"] - 1) / dt
    zeta = s.scene["bulk_viscosity"]
    q = np.where(s.group == LIQUID, zeta * rho0 * c * s.h * rate, 0.0)
    return np.where(
        (s["pressure"] > 0) & (s["density"] > s.material("density")), np.maximum(q, -s["pressure"]), 0.0
    ), zeta * rho0 * c * s.h / dt


def pressure_share(s):
    """V^2 (p + q)/M of 8.3, of a wall's face by the transpose of its mean."""
    p = s["pressure"] + (s["bulk_pressure"] if s.has("bulk_pressure") else 0.0)
    p_s, _ = s.surface()
    volume = np.where(p_s > 0, np.minimum(s["volume"], s.m / s.material("density")), s["volume"])
    share = volume**2 * p / s.M
    scale = np.abs(share)
    if s.averages_walls():
        A, face = wall_patches(s)
        share[face] = A.T @ (A.T @ share[face])
        scale[face] = A.T @ (A.T @ scale[face])
    return share, scale


def pressure_force(s):
    """(7) as printed, or 8.3 with its core of pairs."""
    away = s.d / s.distance[..., None]
    if s.printed("pressure"):
        V, p = s["volume"], s["pressure"]
        size = -V[:, None] * V[None, :] * 0.5 * (p[:, None] + p[None, :]) * spiky_slope(s.distance, s.h)
        return summed(s, np.where(s.acts, size, 0.0)[..., None] * away)
    share = s["pressure_share"]
    kappa, reach = 0.03 * s.stiffness * s.rest_densities()[0] * s.dx, s.scene["core_reach"] * s.dx
    size = -(share[:, None] + share[None, :]) * wendland_slope(s.distance, s.h)
    core = np.where((s.distance < s.h) & (s.distance < reach), kappa * (reach - s.distance), 0.0)
    total, _ = summed(s, np.where(s.acts, size + core, 0.0)[..., None] * away)
    if s.averages_walls():
        laid, d = from_lattice(s)
        distance = np.linalg.norm(d, axis=2)
        there = -(share[:, None] + share[None, :]) * wendland_slope(distance, s.h)
        total = total + np.where(
            laid[..., None],
            there[..., None] * d / np.where(laid, distance, 1.0)[..., None] - size[..., None] * away,
            0.0,
        ).sum(axis=1)
    of_interfaces, interface_scale = interface_force(s, interface_share(s))
    total = total + of_interfaces
    at_faces, scale = face_forces(s)
    scale = scale + interface_scale
    return total + at_faces, scale + (s.condition * np.where(s.acts, np.abs(size) + core, 0.0)).sum(axis=1)


def compression_energy(s):
    """U of 8.3 and half of each pair's core."""
    rho0, k = s.material("density"), s.stiffnesses()
    ratio = s["density"] / rho0
    U = s.S0 / s.M * k * s.rest_densities()[0] / rho0 * s.m * (np.log(ratio) + 1 / ratio - 1)
    size = s.S0 / s.M * k * s.rest_densities()[0] / rho0 * s.m * (np.abs(np.log(ratio)) + 1e-3)
    if s.clamps:
        p_s, b = s.surface()
        foot = np.maximum(
            0, np.where(ratio > b, 1 - ratio, ratio - 2 * b + 1)
        )  # U is minus the area under a triangle, from here to the rest density
        of_surface = np.where(ratio > b, foot**2, 2 * (1 - b) ** 2 - foot**2) / (2 * (1 - b))
        U = np.where(ratio > 1, U, -s.S0 / s.M * s.m / rho0 * p_s * of_surface)
    kappa, reach = 0.03 * s.stiffness * s.rest_densities()[0] * s.dx, s.scene["core_reach"] * s.dx
    core = np.where(
        s.acts & (s.distance < reach), 0.25 * kappa * (reach - np.minimum(s.distance, reach)) ** 2, 0.0
    ).sum()
    a, _, along, K, _ = interfaces(s, interface_share(s))
    return U.sum() + core + 0.5 * (a * along * K).sum(), size.sum() + core + np.abs(a * along * K).sum()


# --- viscosity --------------------------------------------------------------------------------------------------------


def is_central(s):
    return not s.printed("viscosity") and s.scene["viscosity_form"] == "central"
