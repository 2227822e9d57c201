# SPDX-License-Identifier: BSD-3-Clause
"""Linear elasticity of small strains on scikit-fem's elements, by the trapezoidal rule in time, which keeps the energy
of a linear body.

What is fixed holds the nodes of its faces. A free rigid body moves its nodes by a translation and a small rotation of
its own."""

from __future__ import annotations

from typing import Any

from contract import Job
from scikit_fem_mesh import Lattice

STEPS_A_CELL = 0.5  # of the time that a pressure wave takes through one spacing


def lame(material: dict[str, Any]) -> tuple[float, float]:
    """Lame's lambda and mu [Pa] from Young's modulus and Poisson's ratio."""
    E, nu = float(material["young_modulus"]), float(material["poisson_ratio"] or 0.0)
    return E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))


class Solid:
    """M dv/dt = f - K u over the unknowns that are not held."""

    def __init__(self, job: Job, element: str) -> None:
        import numpy as np
        import skfem
        from skfem.helpers import ddot, dot, sym_grad, trace

        self.np = np
        self.lattice = lattice = Lattice(job, ("position", "velocity", "source"))
        self.start = lattice.start
        fixed = np.array([body["motion"] == "fixed" for body in job.bodies])[self.start["source"]]
        mesh, self.particle = lattice.mesh(~fixed)
        bodies = lattice.bodies(self.particle)
        own = {m["name"]: m for m in job.scene["materials"]}
        materials = [own[body["material"]] for body in bodies]
        elastic = np.array([body["phase"] == "elastic" for body in bodies])
        lam, mu = np.array([lame(m) if e else (0.0, 0.0) for m, e in zip(materials, elastic)]).T[:, :, None]
        rho = np.array([float(m["density"]) for m in materials])[:, None]

        basis = skfem.Basis(mesh, skfem.ElementVector(getattr(skfem, element)()))
        cells = basis.with_element(skfem.ElementVector(skfem.ElementHex0()))
        stiffness = skfem.BilinearForm(
            lambda u, v, w: lam * trace(sym_grad(u)) * trace(sym_grad(v)) + 2.0 * mu * ddot(sym_grad(u), sym_grad(v))
        )
        mass = skfem.BilinearForm(lambda u, v, w: rho * dot(u, v))
        content = skfem.BilinearForm(lambda u, v, w: dot(u, v))
        gravity = np.array(job.scene["gravity"], float)
        weight = skfem.LinearForm(lambda v, w: rho * (gravity[0] * v[0] + gravity[1] * v[1] + gravity[2] * v[2]))

        component = self.components(basis)
        join = lattice.joined(basis.doflocs, component)
        motion = self.motions(job, basis, bodies, component, join)
        held = self.held(fixed, basis, join)
        free = np.setdiff1d(np.arange(join.shape[1]), held)
        reduce = join[:, free] @ motion[free]  # (dofs, unknowns)
        reduce = reduce[:, np.unique(reduce.indices)].tocsr()
        self.stiffness = (reduce.T @ stiffness.assemble(basis) @ reduce).tocsc()
        self.mass = (reduce.T @ mass.assemble(basis) @ reduce).tocsc()
        load = weight.assemble(basis)  # [N]
        self.force = reduce.T @ load
        total = float((rho * np.ones_like(lam)).sum()) * lattice.spacing**3  # [kg]
        self.gravity = [float(load[component == k].sum()) / total for k in range(3)]  # [m/s2], as it acts
        mean = content.assemble(basis, cells) @ reduce / lattice.spacing**3  # (3 elements, unknowns)
        self.mean = [mean[cells.element_dofs[k]] for k in range(3)]
        given = self.start_velocities(cells)
        heavy = mass.assemble(basis, cells)
        self.u = np.zeros(reduce.shape[1])  # [m]
        self.v = self.factor(self.mass)(reduce.T @ (heavy.T @ given)) if given.any() else np.zeros_like(self.u)  # [m/s]
        self.elements, self.solvers = len(self.particle), {}
        fastest = float(np.sqrt((lam + 2.0 * mu) / rho).max())
        self.natural_step = lattice.spacing / (STEPS_A_CELL * fastest)

    def start_velocities(self, cells: Any) -> Any:
        """[m/s] of each dof of the cells."""
        given = self.np.zeros(cells.N)
        for k in range(3):
            given[cells.element_dofs[k]] = self.start["velocity"][self.particle, k]
        return given

    def components(self, basis: Any) -> Any:
        """Axis of each dof, 0 to 2."""
        component = self.np.empty(basis.N, int)
        for group in (basis.nodal_dofs, basis.edge_dofs, basis.facet_dofs, basis.interior_dofs):
            for row, dofs in enumerate(group):
                component[dofs] = row % 3
        return component

    def held(self, fixed: Any, basis: Any, join: Any) -> Any:
        """Unknowns at the faces that bodies share with what is fixed."""
        np = self.np
        if not fixed.any():
            return np.array([], int)
        other, _ = self.lattice.mesh(fixed)
        cells = {tuple(x) for x in self.quarters(other.p[:, other.t].mean(axis=1))}
        inside = np.array([self._touches(x, cells) for x in self.quarters(basis.doflocs)])
        return np.unique(join[np.nonzero(inside)[0]].indices)

    def quarters(self, places: Any) -> Any:
        """(n, 3): places (3, n) in quarters of a spacing from the lattice's corner."""
        corner = [side[0] for side in self.lattice.sides]
        return self.np.rint((places.T - corner) / (0.25 * self.lattice.spacing)).astype(int)

    @staticmethod
    def _touches(at: Any, cells: set[tuple[int, ...]]) -> bool:
        """Whether a place, in quarters of a spacing, lies in or on a cell; cells are known by their middles."""
        reach = (-2, 0, 2)
        return any((at[0] + i, at[1] + j, at[2] + k) in cells for i in reach for j in reach for k in reach)

    def motions(self, job: Job, basis: Any, bodies: list[dict[str, Any]], component: Any, join: Any) -> Any:
        """(joined dofs, unknowns): the identity, and six columns in the place of the dofs of each free rigid body."""
        import scipy.sparse as sparse

        np, count = self.np, join.shape[1]
        place, axis = np.zeros((count, 3)), np.zeros(count, int)
        number = join.indices
        place[number], axis[number] = basis.doflocs.T, component
        columns, own = [], np.ones(count)
        for body in job.bodies:
            mine = np.array([other is body for other in bodies])
            if body["phase"] != "rigid" or not mine.any():
                continue
            dofs = np.unique(number[basis.element_dofs[:, mine].ravel()])
            own[dofs] = 0.0
            arm = place[dofs] - np.array(body["centre"], float)
            for k in range(3):
                columns.append(
                    sparse.csr_matrix(((axis[dofs] == k) * 1.0, (dofs, np.zeros(len(dofs), int))), (count, 1))
                )
                turn = np.cross(np.eye(3)[k], arm)[np.arange(len(dofs)), axis[dofs]]
                columns.append(sparse.csr_matrix((turn, (dofs, np.zeros(len(dofs), int))), (count, 1)))
        return sparse.hstack([sparse.diags(own).tocsr()] + columns).tocsr()

    def factor(self, matrix: Any) -> Any:
        from scipy.sparse.linalg import splu

        return splu(
            matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        ).solve

    def advance(self, dt: float, count: int) -> None:
        """`count` steps of dt [s]: u1 = u0 + dt (v0 + v1)/2, M (v1 - v0) = dt (f - K (u0 + u1)/2)."""
        if dt not in self.solvers:
            self.solvers[dt] = self.factor(self.mass + (0.25 * dt * dt) * self.stiffness)
        for _ in range(count):
            pull = self.force - self.stiffness @ (self.u + (0.25 * dt) * self.v)
            new = self.solvers[dt](self.mass @ self.v + dt * pull)
            self.u += (0.5 * dt) * (self.v + new)
            self.v = new

    def of_particles(self) -> tuple[Any, Any]:
        """Places [m] and velocities [m/s], by particle: the means over each element."""
        place, velocity = self.start["position"].copy(), self.np.zeros_like(self.start["position"])
        for k in range(3):
            place[self.particle, k] += self.mean[k] @ self.u
            velocity[self.particle, k] = self.mean[k] @ self.v
        return place, velocity
