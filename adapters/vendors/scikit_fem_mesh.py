# SPDX-License-Identifier: BSD-3-Clause
"""The particles of a job as hexahedra for scikit-fem: one element a particle, and degrees of freedom that are one
across a period."""

from __future__ import annotations

from typing import Any

from contract import Job


class Lattice:
    """Particles on a cubic lattice; a place of the lattice without a particle has no element."""

    def __init__(self, job: Job, columns: tuple[str, ...]) -> None:
        import h5py
        import numpy as np
        import skfem

        self.np, self.job = np, job
        with h5py.File(job.particles) as file:
            self.start = {key: file[f"particles/all/{key}/value"][0] for key in columns}
        self.spacing = dx = float(job.scene["spacing"])
        place = self.start["position"]
        origin = place.min(axis=0)
        cell = np.rint((place - origin) / dx).astype(int)  # (particles, 3)
        self.sides = [np.arange(n + 2) * dx - 0.5 * dx + o for n, o in zip(cell.max(axis=0), origin)]
        self.box = skfem.MeshHex.init_tensor(*self.sides)
        middle = np.rint((self.box.p[:, self.box.t].mean(axis=1).T - origin) / dx).astype(int)
        taken = np.full([len(side) - 1 for side in self.sides], -1)
        taken[tuple(cell.T)] = np.arange(len(cell))
        self.particle_of_cell = taken[tuple(middle.T)]  # -1 where there is none

    def mesh(self, wanted: Any) -> tuple[Any, Any]:
        """@param wanted (particles,) which particles get an element. @return the mesh and the particle of each
        element"""
        particle = self.particle_of_cell
        inside = self.np.nonzero((particle >= 0) & wanted[particle])[0]
        return self.box.restrict(inside), particle[inside]

    def bodies(self, particle: Any) -> list[dict[str, Any]]:
        return [self.job.bodies[k] for k in self.start["source"][particle]]

    def number(self, places: Any, component: Any) -> Any:
        """(dofs,): the unknown of each degree of freedom; those that lie a period apart are one.

        @param places (3, dofs) [m]   @param component (dofs,) 0 for a scalar"""
        np, scene, dx = self.np, self.job.scene, self.spacing
        at = np.rint((places.T - [side[0] for side in self.sides]) / (0.25 * dx)).astype(
            int
        )  # half nodes of quadratic elements too
        for axis, name in enumerate("xyz"):
            length = scene["max"][axis] - scene["min"][axis] if scene["max"] else 0.0
            cells = len(self.sides[axis]) - 1
            if name in scene["periodic"] and abs(cells * dx - length) < 1e-6 * dx * cells:
                at[:, axis] %= 4 * cells
        _, number = np.unique(np.column_stack([at, component]), axis=0, return_inverse=True)
        return number.ravel()

    def joined(self, places: Any, component: Any) -> Any:
        """(dofs, unknowns) of ones, for `number`."""
        import scipy.sparse as sparse

        number = self.number(places, component)
        return sparse.csr_matrix((self.np.ones(len(number)), (self.np.arange(len(number)), number)))
