# SPDX-License-Identifier: BSD-3-Clause
"""Whether the oracle sees a term that is broken: each defect of a pair term or bond term, by a part in a million, must
turn its term red.

broken_terms.py WRITE_STATES_SELFTEST [DEFECT...]
"""

import os
import sys

import oracle

# Defect and size, scene, form, steps, changes, term that must be red.
BROKEN = [
    ("neighbours.periodic=1", "vortices", "corrected", 2, [], "number density 8.2"),
    ("neighbours.support=0.01", "vortices", "corrected", 2, [], "number density 8.2"),
    ("fluid.density=1e-6", "vortices", "corrected", 2, [], "number density 8.2"),
    ("fluid.paper.density=1e-6", "basin", "paper", 2, [], "density (4)"),
    ("fluid.pressure=1e-6", "basin", "corrected", 2, [], "pressure force 8.3"),
    ("fluid.core=1e-6", "basin", "corrected", 2, [], "pressure force 8.3"),
    ("fluid.contact_stiffness=1e-6", "mixture", "corrected", 2, ["model.contact='stiff'"], "pressure 8.3"),
    ("fluid.face_pressure=1e-6", "mixture", "corrected", 2, ["model.contact_face='face'"], "number density 8.2"),
    ("fluid.interface_weight=1e-6", "mixture", "corrected", 2, ["model.interface='weighted'"], "pressure force 8.3"),
    ("fluid.core.reach=1e-6", "basin", "corrected", 2, ["scene.core_reach=0.7"], "pressure force 8.3"),
    ("fluid.paper.pressure=1e-6", "basin", "paper", 2, [], "pressure force (7)"),
    ("fluid.state=1e-6", "vortices", "corrected", 2, [], "pressure 8.3"),
    ("fluid.paper.state=1e-6", "basin", "paper", 2, [], "pressure (9)"),
    ("walls.pressure=1e-6", "basin", "corrected", 2, [], "pressure share of walls 8.4"),
    ("walls.stiffness=1e-6", "basin", "corrected", 2, [], "pressure 8.3"),
    ("fluid.surface=1e-6", "basin", "corrected", 2, [], "pressure 8.3"),
    ("walls.jitter=1e-6", "basin", "corrected", 2, [], "density of walls 8.4"),
    ("walls.places=1e-5", "basin", "corrected", 2, [], "number density 8.2"),
    ("walls.velocity=1e-6", "basin", "corrected", 2, [], "mirrored velocity 8.4"),
    ("fluid.bulk_viscosity=1e-6", "basin", "corrected", 2, [], "bulk pressure 8.4"),
    ("fluid.viscosity.central=1e-6", "basin", "corrected", 2, [], "viscous force central 8.5"),
    (
        "fluid.viscosity.isotropic=1e-6",
        "basin",
        "corrected",
        2,
        ["model.viscosity='isotropic'"],
        "viscous force central 8.5",
    ),
    (
        "fluid.viscosity.laplacian=1e-6",
        "basin",
        "corrected",
        2,
        ["model.viscosity='morris'"],
        "viscous force laplacian 8.5",
    ),
    ("fluid.viscosity.mean=1e-6", "basin", "corrected", 2, [], "viscous force central 8.5"),
    ("fluid.viscosity.contact=1e-6", "mixture", "corrected", 2, [], "viscous force central 8.5"),
    ("fluid.viscosity.lag=1e-6", "basin", "corrected", 2, [], "predicted velocity 9"),
    ("fluid.paper.viscosity=1e-6", "basin", "paper", 2, [], "viscous force (8)"),
    ("fluid.transport.background=1e-6", "vortices", "corrected", 2, [], "background force 8.3"),
    ("fluid.transport.stress=1e-6", "vortices", "corrected", 2, [], "stress of the shift 8.3"),
    ("fluid.mean_pressure=1e-6", "vortices", "corrected", 2, ["model.mean_pressure='neighbours'"], "pressure 8.3"),
    ("fluid.sound_damping=1e-6", "vortices", "corrected", 2, ["model.sound_damping='bulk'"], "damping of sound 8.3"),
    ("carried.viscosity=1e-6", "basin", "corrected", 2, ["model.pressure='adjoint'"], "carried viscous force 8.12"),
    ("carried.wall_rate=1e-6", "basin", "corrected", 2, ["model.pressure='adjoint'"], "wall rate 8.12"),
    ("carried.wall_weight=1e-6", "basin", "corrected", 2, ["model.pressure='adjoint'"], "wall pressure 8.12"),
    ("heat.paper.diffusivity=1e-6", "mixture", "paper", 2, [], "heat (21)"),
    ("heat.moment=1", "freezing", "corrected", 2, [], "moment 8.6"),
    ("heat.harmonic_mean=1", "freezing", "corrected", 2, [], "heat flow 8.6"),
    ("heat.one_sided=1e-6", "freezing", "corrected", 2, [], "heat flow 8.6"),
    ("elastic.strain=1e-6", "solids", "corrected", 2, [], "strain 8.7"),
    ("elastic.rotation=1e-6", "solids", "corrected", 2, [], "strain 8.7"),
    ("elastic.stress=1e-6", "solids", "corrected", 2, [], "bond force 8.7"),
    ("elastic.force=1e-6", "solids", "corrected", 2, [], "bond force 8.7"),
    ("elastic.shape=1e-6", "solids", "corrected", 2, [], "shape inverse 8.7"),
    ("elastic.joint=1e-6", "solids", "corrected", 2, [], "stiffness of joints 8.7"),
    ("elastic.projector=1e-6", "solids", "corrected", 2, [], "strain of sheets and chains 8.7"),
    ("elastic.reduced=1", "solids", "corrected", 2, [], "bond force of sheets and chains 8.7"),
    ("elastic.hourglass=1e-6", "solids", "corrected", 2, [], "hourglass energy 8.7"),
    ("elastic.bending=1e-6", "solids", "corrected", 2, [], "gradients at surfaces 8.7"),
    ("elastic.own_pairs=1e-6", "freezing", "corrected", 2, [], "excluded pairs 8.2"),
    ("elastic.paper.factor=1e-6", "solids", "paper", 2, [], "bond force (12)"),
    ("elastic.paper.stress=1e-6", "solids", "paper", 2, [], "elastic energy (10)"),
    ("plastic.elastic_limit=1e-6", "solids", "corrected", 2, [], "plastic strain 8.8"),
    ("plastic.plastic_limit=1e-3", "solids", "corrected", 8, [], "plastic strain 8.8"),
    ("plastic.sheet=1e-6", "solids", "corrected", 2, [], "plastic strain of sheets and chains 8.8"),
    ("fracture.stretch=0.1", "solids", "corrected", 12, [], "broken bonds 8.8"),
    ("fracture.paper.distance=0.1", "solids", "paper", 12, [], "broken bonds (12)"),
]


def main():
    chosen, blind = sys.argv[2:], []
    for defect, scene, mode, steps, changes, term in BROKEN:
        if chosen and defect.split("=")[0] not in chosen:
            continue
        os.environ["TRIPOINT_DEFECT"] = defect
        for of_start in (False, True):  # the end of a run alone takes half of the time, and shows most
            greatest, _ = oracle.compare_all(sys.argv[1], [(scene, mode, steps, changes)], of_start)
            red = {t: worst for t, (worst, _, _) in greatest.items() if not worst <= oracle.LIMIT}
            if term in red:
                break
        print(
            f"{defect:34} {term:40} {red.get(term, 0.0):9.2e}"
            + (f"  also {', '.join(sorted(set(red) - {term}))}" if set(red) - {term} else ""),
            flush=True,
        )
        if term not in red:
            blind.append(defect)
    print("every broken term is red" if not blind else "NOT SEEN: " + ", ".join(blind))
    return 1 if blind else 0


if __name__ == "__main__":
    sys.exit(main())
