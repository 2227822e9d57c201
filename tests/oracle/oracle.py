# SPDX-License-Identifier: BSD-3-Clause
"""Every pair term and bond term of the solver beside plain sums written from docs/model.md (kernels.py, model.py,
flows.py, solids.py).

  oracle.py WRITE_STATES [SCENE...]

The solver writes the states of the scenes beside this file: two liquids, walls, free and soft bodies, jittered,
periodic. Each term is computed again from the columns that it reads, and compared particle by particle. The difference
is divided by the sum of the magnitudes of what the term adds up there, each over 1 - r/h where a kernel's slope has
that factor: so nothing hides in the forces of others, and round-off is all that is forgiven. Prints each term with its
greatest difference; fails where one is above LIMIT, or was never compared. Each pair term that is compiled must name
the rows that compare it (PAIR_TERMS)."""

import json
import pathlib
import subprocess
import sys

import numpy as np

import carried
import kernels
import flows
import model
import solids
import transport
from model import WALL

LIMIT = 1e-13
HERE = pathlib.Path(__file__).parent

# What must have been compared when all scenes have run.
TERMS = """density (4) | number density 8.2 | excluded pairs 8.2 | own density 8.2 | density of walls 8.4 | volume | \
pressure (9) | pressure 8.3 |
bulk pressure 8.4 | pressure share 8.3 | pressure share of walls 8.4 | pressure force (7) | pressure force 8.3 | \
compression energy 8.3 |
predicted velocity 9 | seen velocity of bodies 8.4 | wall weight 8.4 | wall velocity 8.4 | mirrored velocity 8.4 | \
viscous force (8) |
viscous force central 8.5 | viscous force laplacian 8.5 | viscous bound (8) | viscous bound central 8.10 | viscous \
bound laplacian 8.10 |
background force 8.3 | damping of sound 8.3 | stress of the shift 8.3 | shift 8.3 | heat (21) | exchange (21) | moment \
8.6 | heat flow 8.6 | conductance 8.6 |
bonds 11 | kernel of bonds (17) | body volume (11) | body volume 8.7 | stiffness of joints 8.7 | shape inverse 8.7 | \
rank 8.7 | gradients at surfaces 8.7 | strain (14) | strain 8.7 |
strain of sheets and chains 8.7 | bond force (12) | bond force 8.7 | bond force of sheets and chains 8.7 | elastic \
energy (10) | elastic energy 8.7 |
hourglass energy 8.7 | plastic strain 8.8 | plastic strain of sheets and chains 8.8 | broken bonds (12) | broken bonds \
8.8 |
carried sum 8.12 | slope of the sum 8.12 | carried moments 8.12 | carried gradients 8.12 | \
carried pressure force 8.12 | carried viscous force 8.12 | carried damping 8.12 | carried diffusion 8.12 | \
sound rate 8.12 | sound force 8.12 | load of faces 8.12 | wall rate 8.12 | wall pressure 8.12 | \
number density of solids 8.12 | pressure force of solids 8.12"""
TERMS = [t.strip() for t in TERMS.replace("\n", " ").split("|")]

# Each pair term that the passes have compiled (its pair_slots.hpp brings it), and the rows above that show its sums.
PAIR_TERMS = {
    "DensityPaper": ["density (4)"],
    "NumberDensity": ["number density 8.2"],
    "PressurePaper": ["pressure force (7)"],
    "PressureCorrected": ["pressure force 8.3"],
    "ViscosityPaper": ["viscous force (8)"],
    "ViscosityCentral": ["viscous force central 8.5"],
    "ViscosityCentralWeighted": ["viscous force central 8.5"],
    "ViscosityLaplacian": ["viscous force laplacian 8.5"],
    "ViscousSpread of ViscosityPaper": ["viscous bound (8)"],
    "ViscousSpread of ViscosityCentral": ["viscous bound central 8.10"],
    "ViscousSpread of ViscosityCentralWeighted": ["viscous bound central 8.10"],
    "ViscousSpread of ViscosityLaplacian": ["viscous bound laplacian 8.10"],
    "WallExtrapolation": ["wall weight 8.4", "wall velocity 8.4"],
    "WallExtrapolationWeighted": ["wall weight 8.4", "wall velocity 8.4"],
    "TransportForces": ["background force 8.3", "stress of the shift 8.3"],
    "TransportForcesAndMeans": [
        "background force 8.3",
        "stress of the shift 8.3",
        "damping of sound 8.3",
        "pressure 8.3",
    ],
    "HeatMoment": ["moment 8.6"],
    "HeatFlowPaper": ["heat (21)", "exchange (21)"],
    "HeatFlowCorrected": ["heat flow 8.6", "conductance 8.6"],
    "CarriedMoments": ["carried moments 8.12"],
    "SolidNumberDensity": ["number density of solids 8.12"],
    "PressureOfSolids": ["pressure force of solids 8.12"],
}
PAIR_TERMS |= {"CarriedWallRate": ["wall rate 8.12"], "CarriedWallPressure": ["wall pressure 8.12"]}
PAIR_TERMS |= {"FaceRate": ["carried gradients 8.12"], "FaceLoad": ["load of faces 8.12"]}
PAIR_TERMS |= {"SoundRate": ["sound rate 8.12"], "SoundForce": ["sound force 8.12"]}
CARRIED_FORCES = [f"carried {what} 8.12" for what in ("pressure force", "viscous force", "damping", "diffusion")]
for pair, damping in set(carried.FORMS.values()):
    PAIR_TERMS[f"CarriedGradients {pair}"] = ["carried gradients 8.12", "carried sum 8.12", "slope of the sum 8.12"]
    PAIR_TERMS[f"CarriedForces {pair} {damping}"] = CARRIED_FORCES

# Scene, form, steps, changes to the scene.
RUNS = [
    ("mixture", "corrected", 3, []),
    ("mixture", "corrected", 2, ["model.viscosity='morris'"]),
    ("mixture", "corrected", 2, ["model.contact='stiff'"]),
    ("mixture", "corrected", 3, ["model.contact_face='face'", "model.interface='weighted'"]),
    ("mixture", "paper", 3, []),
    ("mixture", "corrected", 2, ["scene.modes={pressure='paper', heat='paper'}"]),
    ("mixture", "corrected", 2, ["model.pressure='adjoint'"]),
    ("basin", "corrected", 3, []),
    ("basin", "corrected", 2, ["model.viscosity='morris'"]),
    ("basin", "corrected", 2, ["scene.isotropic_shear=0.7", "scene.core_reach=0.7"]),  # numbers of old files
    ("basin", "paper", 2, []),
    ("vortices", "corrected", 3, []),
    ("vortices", "corrected", 3, ["model.mean_pressure='neighbours'", "model.sound_damping='bulk'"]),
    ("solids", "corrected", 5, []),  # a body splits
    ("solids", "corrected", 12, []),
    ("solids", "corrected", 12, ["model.elasticity='first-order'"]),
    ("solids", "paper", 12, []),
    ("freezing", "corrected", 12, []),
    ("freezing", "paper", 12, []),
] + [("basin", "corrected", 2, [f"model.pressure='{form}'", "scene.support_ratio=2.9"]) for form in carried.FORMS]
RUNS += [("basin", "corrected", 2, ["model.pressure='adjoint'", "material.water.viscosity=80"])]


class Differences:
    def __init__(self):
        self.greatest = {}

    def compare(self, term, solver, twin, scale):
        """Greatest |solver - twin|/scale; components of one thing share its scale, which is a number or one a row.
        Equal zeros differ by 0."""
        solver, twin = np.asarray(solver, dtype=float), np.asarray(twin, dtype=float)
        if solver.shape != twin.shape:
            raise ValueError(f"{term}: {solver.shape} beside {twin.shape}")
        if solver.size == 0:
            return
        off = np.abs(solver - twin).reshape(len(np.atleast_1d(solver)), -1).max(axis=1)
        scale = np.broadcast_to(np.asarray(scale, dtype=float), off.shape)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(off == 0, 0.0, off / scale)
        ratio = np.where(np.isnan(ratio), np.inf, ratio)  # what is no number agrees with nothing
        worst, where, count = self.greatest.get(term, (0.0, "", 0))
        if ratio.max() >= worst:
            worst, where = ratio.max(), self.where
        self.greatest[term] = (float(worst), where, count + len(ratio))

    def same(self, term, solver, twin):
        """Of whole numbers and sets: 0 or infinity."""
        equal = (
            len(solver) == len(twin) and bool(np.all(np.asarray(solver) == np.asarray(twin)))
            if len(solver)
            else len(twin) == 0
        )
        self.compare(term, np.array([0.0 if equal else 1.0]), np.array([0.0]), 0.0)


def compare_densities(out, s, before):
    if s.printed("density") or not s.has("number_density"):
        out.compare("density (4)", s["density"], *model.density_printed(s))
    else:
        out.compare("number density 8.2", s["number_density"], *model.number_density(s))
        rho, scale = model.density(s)
        walls = (s.group == WALL) & s.averages_walls()
        out.compare("number density 8.2", s["density"][~walls], rho[~walls], scale[~walls])
        if walls.any():
            out.compare("density of walls 8.4", s["density"][walls], rho[walls], scale[walls])
    if s.has("own_density"):
        out.compare("own density 8.2", s["own_density"], *model.own_density(s))
    out.compare("volume", s["volume"], s.m / s["density"], s["volume"])


def compare_pressure(out, s, before):
    p, scale = model.pressure(s)
    out.compare("pressure (9)" if s.printed("state") else "pressure 8.3", s["pressure"], p, scale)
    if s.has("pressure_around"):
        out.compare(
            "damping of sound 8.3", s["bulk_pressure"], *transport.damping_of_sound(s, half_step_velocity(s, before))
        )
    elif s.has("bulk_pressure") and before is not None:
        out.compare("bulk pressure 8.4", s["bulk_pressure"], *model.bulk_pressure(s, before))
    if s.has("pressure_share"):
        share, scale = model.pressure_share(s)
        walls = (s.group == WALL) & s.averages_walls()
        out.compare("pressure share 8.3", s["pressure_share"][~walls], share[~walls], scale[~walls])
        if walls.any():
            out.compare("pressure share of walls 8.4", s["pressure_share"][walls], share[walls], scale[walls])
    out.compare(
        "pressure force (7)" if s.printed("pressure") else "pressure force 8.3",
        s.vector("force"),
        *model.pressure_force(s),
    )
    if "compression" in s.raw["ledger"]:
        U, scale = model.compression_energy(s)
        out.compare("compression energy 8.3", [s.raw["ledger"]["compression"]], [U], scale)


def half_step_velocity(s, before):
    """That of the middle of the last step, by its first kick."""
    if before is None:
        return s.vector("velocity")
    forces = [before.vector(n) for n in ("force", "viscous_force", "transport_force")]
    return before.vector("velocity") + s.raw["step_numbers"]["half_step"] * (
        sum(forces) / s.m[:, None] + np.array(s.scene["gravity"])
    )


def compare_viscosity(out, s, before):
    seen = s.vector("viscous_velocity")
    of_bodies = np.array([b >= 0 and s.moves_as_one(b) for b in s.body])
    wet = np.zeros(s.n, dtype=bool)
    if s.has("wall.weight"):
        rows, mirrored, weight, moved, weight_scale, scale = flows.mirrored(s)
        wet[rows] = True
        walls = s.group == WALL
        out.compare("wall weight 8.4", s["wall.weight"][walls], weight[walls], weight_scale[walls])
        out.compare("wall velocity 8.4", s.vector("wall.velocity")[walls], moved[walls], scale[walls])
        out.compare(
            "mirrored velocity 8.4", seen[rows], mirrored, np.linalg.norm(mirrored, axis=1) + scale[rows] / weight[rows]
        )
    if before is None:
        start = flows.seen_velocity_at_start(s)
        out.compare("seen velocity of bodies 8.4", seen[of_bodies & ~wet], start[of_bodies & ~wet], 1.0)
        out.compare("predicted velocity 9", seen[~of_bodies], start[~of_bodies], 1.0)
    else:
        names = [n for n in ("force", "viscous_force", "elastic_force", "transport_force") if s.has(n + ".x")]
        gain = [s.raw["step_numbers"]["half_step"] * before.vector(n) / s.m[:, None] for n in names] + [
            np.broadcast_to(s.raw["step_numbers"]["half_step"] * np.array(s.scene["gravity"]), s.r.shape)
        ]
        v = before.vector("velocity")
        predicted = v + 2 * sum(gain)
        scale = np.linalg.norm(v, axis=1) + sum(2 * np.linalg.norm(g, axis=1) for g in gain)
        moving = ~of_bodies & (s["phase"] == before["phase"])
        out.compare("predicted velocity 9", seen[moving], predicted[moving], scale[moving])
    form = "(8)" if s.printed("viscosity") else f"{s.scene['viscosity_form']} 8.5"
    out.compare(f"viscous force {form}", s.vector("viscous_force"), *flows.viscous_force(s))
    if before is None:
        bound = flows.viscous_bound(s)
        out.compare(
            f"viscous bound {form.replace('8.5', '8.10')}", [s.raw["step_numbers"]["viscous_step"]], [bound], bound
        )


def compare_transport(out, s, before):
    background, stress = transport.transport_forces(s)
    out.compare("background force 8.3", s.vector("background"), *background)
    out.compare("stress of the shift 8.3", s.vector("transport_force"), *stress)
    if before is not None:
        shift = s.raw["step_numbers"]["half_step"] / s.m[:, None] * before.vector("background")
        out.compare("shift 8.3", s.vector("shift"), shift, np.linalg.norm(shift, axis=1))


def compare_heat(out, s, before):
    if s.has("temperature_rate"):
        rate, scale, exchange = flows.heat_printed(s)
        out.compare("heat (21)", s["temperature_rate"], rate, scale)
        out.compare("exchange (21)", s["exchange"], exchange, exchange)
    if s.has("heat_rate"):
        if s.raw["step_numbers"]["heat_steps_held"] == 0:
            sums = zip(*flows.conduction_sums(s), strict=True)
            B = np.array([flows.conduction_tensor(Q, S, s.dx) for Q, S in sums])
            out.compare("moment 8.6", s.symmetric("moment_inverse"), B, np.abs(B).max(axis=(1, 2)))
        rate, scale, conductance = flows.heat_corrected(s)
        out.compare("heat flow 8.6", s["heat_rate"], rate, scale)
        out.compare("conductance 8.6", s["conductance"], conductance, conductance)


def compare_bonds_of_the_start(out, s):
    bonded, own = solids.first_bonds(s)
    kernel = solids.REACH * s.dx
    pairs = sorted((i, j) for i in range(s.n) for j, *_ in s.bonds[i])
    out.same("bonds 11", pairs, [tuple(p) for p in np.argwhere(bonded)])
    bonds = s.raw["bonds"]
    out.same("bonds 11", [i for i, *_ in bonds], [b[-1] for b in bonds])  # each bond's twin is of its own particle
    for i, j in pairs:
        compare_kernel_of_bond(out, s, i, j, kernel)
    if s.has("force.x"):
        compare_excluded_pairs(out, s, own, kernel)


def compare_kernel_of_bond(out, s, i, j, kernel):
    term = "kernel of bonds (17)"
    x, gradient, W = next(b[1:] for b in s.bonds[i] if b[0] == j)
    out.compare("bonds 11", [x], [s.d[i, j]], s.dx)
    if s.scene["bending"] == 0 or s.printed("elastic"):
        slope = kernels.elasticity_slope(s.distance[i, j], kernel) * s.d[i, j] / s.distance[i, j]
        out.compare(term, [gradient], [slope], np.abs(kernels.elasticity_slope(0.5 * kernel, kernel)))
    expected = kernels.elasticity(s.distance[i, j], kernel)
    out.compare(term, [W], [expected], kernels.elasticity(0.5 * kernel, kernel))


def compare_excluded_pairs(out, s, own, kernel):
    printed, pairs = s.printed("density"), s.raw["own_pairs"]
    expected = own & (s.distance < (kernel if printed else max(kernel, s.h)))
    out.same("excluded pairs 8.2", sorted((i, j) for i, j, _ in pairs), [tuple(p) for p in np.argwhere(expected)])
    for i, j, weight in pairs:
        W = 0.0 if printed else kernels.wendland(s.distance[i, j], s.h)
        out.compare("excluded pairs 8.2", [weight], [W], kernels.wendland(0.5 * s.h, s.h))


def compare_solids(out, s, before):
    if before is None:
        compare_bonds_of_the_start(out, s)
    deformable = np.array([b >= 0 and not s.moves_as_one(b) for b in s.body])
    stiffness, material = joints(s, deformable)
    out.compare("stiffness of joints 8.7", s["solid_stiffness"], stiffness, 1.0)
    out.same("stiffness of joints 8.7", s["solid_material"][stiffness > 0], material[stiffness > 0])
    owns = stiffness > 0
    volume = solids.solid_volume(s, owns)
    out.compare(solid_form(s, "body volume", "(11)"), s["solid_volume"], volume, volume)

    plastic = s.symmetric("plastic_strain") if s.has("plastic_strain.xx") else np.zeros((s.n, 3, 3))
    total = BondSums(s.n)
    for i in np.flatnonzero(owns):
        d = deformed(s, i, material[i], stiffness[i])
        if s.scene["bending"] > 0 and not s.printed("elastic") and s.bonds[i]:
            gradients = solids.bond_gradients(s, i, volume, s.scene["bending"])
            out.compare("gradients at surfaces 8.7", [b[2] for b in s.bonds[i]], gradients, np.abs(gradients).max())
        compare_deformation(out, s, i, d)
        total.add(i, d, plastic[i])
        if deformable[i] and before is not None and s.has("plastic_strain.xx"):
            compare_flow(out, s, i, d, before, plastic[i])
    compare_bond_forces(out, s, total)
    compare_bond_energies(out, s, total)


def solid_form(s, words, printed):
    """The place of a law of solids: the paper's or the corrected one's."""
    return f"{words} {printed if s.printed('elastic') else '8.7'}"


def joints(s, deformable):
    """(stiffness, material) of each particle. A rigid one that is bonded to a deformable one is ten times as stiff, or
    four times as printed or where the deformable one melts, flows or breaks."""
    lets_go = ("t_melt", "elastic_limit", "fracture_stretch", "fracture_distance")
    stiffness, material = np.where(deformable, 1.0, 0.0), s["material"].copy()
    for i in np.flatnonzero(~deformable & (s.body >= 0)):
        soft = [j for j, *_ in s.bonds[i] if deformable[j]]
        if soft:
            material[i] = s["material"][min(soft)]
            weak = s.printed("elastic") or any(s.materials[material[i]].get(key) is not None for key in lets_go)
            stiffness[i] = 4.0 if weak else 10.0
    return stiffness, material


def deformed(s, i, material, stiffness):
    m = s.materials[material]
    softens = m["solid"] == "elastic" and m["t_melt"] is not None and (m["softens"] or s.printed("phase"))
    share = stiffness * (s["stiffness_share"][i] if softens and s.has("stiffness_share") else 1.0)
    hourglass = 0.0 if s.printed("hourglass") else s.scene["hourglass"]
    return solids.Deformed(s, i, (m["young_modulus"], m["poisson_ratio"], share), hourglass)


class BondSums:
    """Forces and energies of all bonds, with the sizes of what was added."""

    def __init__(self, n):
        self.force, self.scale = np.zeros((n, 3)), np.zeros(n)
        self.elastic, self.hourglass = 0.0, 0.0
        self.flat = np.zeros(n, dtype=bool)

    def add(self, i, d, plastic):
        on_partners, scale = d.forces(plastic)
        for j, f, size in zip(d.j, on_partners, scale):
            self.force[j] += f
            self.force[i] -= f
            self.scale[[i, j]] += size
            self.flat[[i, j]] |= d.rank < 3
        U, H = d.energies(plastic)
        self.elastic, self.hourglass = self.elastic + U, self.hourglass + H


def compare_deformation(out, s, i, d):
    out.compare("shape inverse 8.7", [s.symmetric("shape_inverse")[i]], [d.A], np.abs(d.A).max())
    out.same("rank 8.7", [s["shape_rank"][i]], [d.rank])
    term = solid_form(s, "strain", "(14)") if d.rank == 3 else "strain of sheets and chains 8.7"
    out.compare(term, [s.symmetric("strain")[i]], [d.strain], d.strain_scale)


def compare_flow(out, s, i, d, before, plastic):
    """The plastic strain after this step; not where a bond broke meanwhile."""
    own = s.materials[s["material"][i]]
    if own["elastic_limit"] is None or len(s.bonds[i]) != len(before.bonds[i]):
        return
    limit = own["plastic_limit"] if own["plastic_limit"] is not None else np.inf
    after = solids.flowed(d, before.symmetric("plastic_strain")[i], own["elastic_limit"], limit)
    term = "plastic strain 8.8" if d.rank == 3 else "plastic strain of sheets and chains 8.8"
    out.compare(term, [plastic], [after], d.strain_scale)


def compare_bond_forces(out, s, total):
    flat, force = total.flat, s.vector("elastic_force")
    out.compare(solid_form(s, "bond force", "(12)"), force[~flat], total.force[~flat], total.scale[~flat])
    if flat.any():
        out.compare("bond force of sheets and chains 8.7", force[flat], total.force[flat], total.scale[flat])


def compare_bond_energies(out, s, total):
    ledger = s.raw["ledger"]
    if total.elastic > 0:
        term = solid_form(s, "elastic energy", "(10)")
        out.compare(term, [ledger["elastic"]], [total.elastic], total.elastic)
    if total.hourglass > 0:
        out.compare("hourglass energy 8.7", [ledger["hourglass"]], [total.hourglass], total.hourglass)


def compare_fracture(out, s, before):
    key, printed = ("fracture_distance", True) if s.printed("elastic") else ("fracture_stretch", False)
    limit = s.material(key, np.inf)
    kept = []
    for i in range(s.n):
        for j, x, *_ in before.bonds[i]:
            least = min(limit[i], limit[j])
            holds = s.distance[i, j] <= (least * s.dx if printed else least * np.linalg.norm(x))
            parted = before.body[i] == before.body[j] and s.body[i] != s.body[j]  # the body has split between them
            if holds and not parted:
                kept.append((i, j))
    now = [(i, j) for i in range(s.n) for j, *_ in s.bonds[i]]
    out.same("broken bonds (12)" if printed else "broken bonds 8.8", sorted(now), sorted(kept))


def compare_state(out, s, before):
    if s.has("impedance"):
        return carried.compare(out, s, before)
    if s.has("volume"):
        compare_densities(out, s, before)
    if s.has("pressure"):
        compare_pressure(out, s, before)
        compare_viscosity(out, s, before)
    if s.has("background.x"):
        compare_transport(out, s, before)
    if s.has("temperature"):
        compare_heat(out, s, before)
    if s.has("elastic_force.x"):
        compare_solids(out, s, before)


def summed_liquid(mode, changes):
    """What a run says of the form of pressure: liquid sums its density where no change speaks of pressure."""
    named = mode == "paper" or any("model.pressure" in one or "{pressure=" in one for one in changes)
    return list(changes) if named else [*changes, "model.pressure='conservative'"]


def states_of(writer, scene, mode, steps, changes):
    text = subprocess.run(
        [writer, HERE / "scenes" / f"{scene}.toml", mode, str(steps), *summed_liquid(mode, changes)],
        check=True,
        stdout=subprocess.PIPE,
    ).stdout
    read = json.loads(text)
    return [model.State(read["scene"], state) for state in read["states"]]


def compare_all(writer, runs=RUNS, of_start=True):
    """@return term -> (greatest difference, where, numbers compared), of the start of each run too where asked"""
    out, broken = Differences(), 0
    for scene, mode, steps, changes in runs:
        start, before, after = states_of(writer, scene, mode, steps, changes)
        for state in (start, after):
            state.form_of_pressure = "".join(changes[:1]).removeprefix("model.pressure=").strip("'")
        out.where = " ".join([scene, mode, *changes])
        for state, earlier in [(start, None), (after, before)][not of_start :]:
            compare_state(out, state, earlier)
        if any(m.get("fracture_stretch") for m in start.materials):
            compare_fracture(out, after, before)
            broken += len(start.raw["bonds"]) - len(after.raw["bonds"])
    return out.greatest, broken


def wrong_pair_terms(writer):
    """Pair terms that are compiled and in no row here, entries here whose term is not compiled, and rows that there are
    none of."""
    compiled = set(
        subprocess.run([writer, "--terms"], check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    )
    wrong = [
        f"the pair term {name}, which no row compares (PAIR_TERMS)" for name in sorted(compiled - PAIR_TERMS.keys())
    ]
    wrong += [f"{name} in PAIR_TERMS, which is not compiled" for name in sorted(PAIR_TERMS.keys() - compiled)]
    return wrong + [
        f"{name} in PAIR_TERMS names the row {row}, which TERMS has not"
        for name, rows in PAIR_TERMS.items()
        for row in rows or [""]
        if row not in TERMS
    ]


def main():
    chosen = sys.argv[2:]
    runs = [r for r in RUNS if not chosen or r[0] in chosen]
    greatest, broken = compare_all(sys.argv[1], runs)
    wrong = wrong_pair_terms(sys.argv[1])
    for term in TERMS:
        worst, where, count = greatest.get(term, (float("nan"), "never compared", 0))
        print(f"{term:44} {worst:9.2e}  {count:7} compared, greatest in {where}")
        if term in greatest and not worst <= LIMIT or term not in greatest and not chosen:
            wrong.append(term)
    unknown = sorted(set(greatest) - set(TERMS))
    if unknown:
        wrong += unknown
    if not chosen and broken == 0:
        wrong.append("no bond broke")
    print(f"{len(greatest)} terms, limit {LIMIT:g}" + ("" if not wrong else "; WRONG: " + ", ".join(wrong)))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
