# SPDX-License-Identifier: BSD-3-Clause
"""scikit-fem (BSD-3-Clause) as a witness of conduction and of linear elasticity: finite elements on hexahedra, one
element a particle.

Presets are its elements. Each particle is a cube of one spacing, and its temperature is the mean of its element, which
is what it holds. Time is stepped by Crank and Nicolson, the first step in four of backward Euler, because
Crank-Nicolson does not damp a step of temperature. What touches nothing is insulated; what is held keeps its
temperature up to its sides. Elastic bodies that something fixed holds are in scikit_fem_solid.py."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from contract import HEAT_COLUMNS, PARTICLE_COLUMNS, Engine, Job, Outcome, Row, serve, write_trajectory
from lattice import materials_of, refuse_body, refuse_work
from rigid import steps_in
from scikit_fem_mesh import Lattice
from scikit_fem_solid import Solid

START_STEPS = 4  # of backward Euler, in the place of the first step
REFINEMENTS = 4  # of the start: the means of elements then are the job's temperatures, to 1e-7 at ten elements a wave
MOST_QUADRATIC = 250_000  # elements times steps of ElementHex2, up to a millisecond of a processor each


def is_elastic(job: Job) -> bool:
    return any(body["phase"] == "elastic" and body["temperature"] is None for body in job.bodies)


def refuse_scene(job: Job) -> str:
    """Why the scene is neither conduction at rest nor a held elastic body; "" if it is."""
    scene = job.scene
    if scene["mode"] == "paper":
        return "the paper's forms belong to the particle solver; scikit-fem has none"
    if scene["events"] or scene["inflows"]:
        return "events and inflow are not handed to scikit-fem"
    if scene["jitter"]:
        return "particles off their lattice are no elements"
    return refuse_solids(job) if is_elastic(job) else refuse_heat(job)


def linked(job: Job) -> list[set[str]]:
    """Names of the bodies that hang together by `joined_to`."""
    groups = [{body["name"]} for body in job.bodies]
    for body in job.bodies:
        for other in body["joined_to"]:
            one = next(group for group in groups if body["name"] in group)
            two = next((group for group in groups if other in group), one)
            if one is not two:
                groups.remove(two)
                one |= two
    return groups


def refuse_solids(job: Job) -> str:
    fixed = {body["name"] for body in job.bodies if body["motion"] == "fixed"}
    for body, material in zip(job.bodies, materials_of(job)):
        if reason := refuse_body(body, material, "scikit-fem"):
            return reason
    for body in job.bodies:
        group = next(g for g in linked(job) if body["name"] in g)
        if body["motion"] == "free" and not group & fixed:
            return f"bodies that nothing holds are not handed to scikit-fem, and {body['name']} is free"
    if len(linked(job)) > 1:
        return "contact is not handed to scikit-fem, and not all bodies hang together"
    return ""


def refuse_heat(job: Job) -> str:
    scene = job.scene
    names = {material["name"]: material for material in scene["materials"]}
    for body in job.bodies:
        if body["temperature"] is None:
            return f"scikit-fem is handed conduction only, and {body['name']} has no temperature"
        driven = any(scene["gravity"]) or any(body["velocity"]) or any(body["angular_velocity"])
        if body["phase"] == "liquid" or (body["motion"] != "fixed" and driven):
            return f"scikit-fem is handed conduction at rest, and {body['name']} may move"
        if names[body["material"]]["t_melt"] is not None:
            return f"{body['name']} may melt, and the elements here have no latent heat"
    return refuse_size(job)


def of_solid(material: dict[str, Any], key: str) -> float:
    """A value of the solid, which is the liquid's where it has none of its own."""
    own = material.get("solid_" + key)
    return float(material[key] if own is None else own)


def heat_step(job: Job) -> float:
    """[s]: the job's own, else half of dx^2 over the greatest diffusivity."""
    own = [next(m for m in job.scene["materials"] if m["name"] == body["material"]) for body in job.bodies]
    diffusivity = max(of_solid(m, "conductivity") / (m["density"] * of_solid(m, "heat_capacity")) for m in own)
    return float(job.settings.get("time_step", job.time_step or 0.5 * job.scene["spacing"] ** 2 / diffusivity))


def refuse_size(job: Job) -> str:
    """Why a run of quadratic elements would take longer than a run may; "" if it would not."""
    if job.preset != "ElementHex2":
        return ""
    return refuse_work(job, heat_step(job), MOST_QUADRATIC, "ElementHex2", "ElementHex1")


class Bar:
    """The scene as a linear system: M dT/dt = -K T over the degrees of freedom that are not held."""

    def __init__(self, job: Job, element: str) -> None:
        import numpy as np
        import skfem
        from skfem.helpers import dot, grad

        self.np = np
        lattice = Lattice(job, ("position", "velocity", "temperature", "source"))
        column = self.start = lattice.start
        dx = lattice.spacing
        mesh, self.particle = lattice.mesh(np.ones(len(column["source"]), bool))
        bodies = lattice.bodies(self.particle)
        materials = {m["name"]: m for m in job.scene["materials"]}
        own = [materials[body["material"]] for body in bodies]
        k = np.array([of_solid(m, "conductivity") for m in own])[:, None]  # [W/(m K)]
        c = np.array([m["density"] * of_solid(m, "heat_capacity") for m in own])[:, None]  # [J/(m3 K)]
        basis = skfem.Basis(mesh, getattr(skfem, element)())
        cells = basis.with_element(skfem.ElementHex0())
        stiffness = skfem.BilinearForm(lambda u, v, w: k * dot(grad(u), grad(v))).assemble(basis)
        mass = skfem.BilinearForm(lambda u, v, w: c * u * v).assemble(basis)
        content = skfem.BilinearForm(lambda u, v, w: u * v).assemble(
            basis, cells
        )  # (elements, dofs): integral over each [m3]
        warmth = skfem.BilinearForm(lambda u, v, w: c * u * v).assemble(basis, cells)
        join = lattice.joined(basis.doflocs, np.zeros(basis.N, int))
        self.stiffness, self.mass = join.T @ stiffness @ join, join.T @ mass @ join
        self.mean = (content @ join) / dx**3
        held = np.array([body["temperature_held"] for body in bodies])
        fixed = np.unique(join[basis.element_dofs[:, held].ravel()].indices) if held.any() else np.array([], int)
        given = column["temperature"][self.particle]
        self.free = np.setdiff1d(np.arange(join.shape[1]), fixed)
        self.fixed = fixed
        self.temperature = np.zeros(join.shape[1])
        for _ in range(
            1 + REFINEMENTS
        ):  # a projection alone lowers a wave, which a short run would show as a faster decay
            missing = given - self.mean @ self.temperature
            self.temperature += self.solve(self.mass, join.T @ (warmth.T @ missing))
        if held.any():
            weight = (content @ join)[held]
            total = np.maximum(np.asarray(weight.sum(axis=0)).ravel(), 1e-300)
            self.temperature[fixed] = ((weight.T @ given[held]) / total)[fixed]
        self.elements = len(self.particle)

    def solve(self, matrix: Any, right: Any) -> Any:
        """Conjugate gradients: the mass matrix prevails, so that a few dozen iterations reach round-off."""
        from scipy.sparse import diags
        from scipy.sparse.linalg import cg

        found, left = cg(matrix, right, rtol=1e-13, atol=0.0, maxiter=2000, M=diags(1.0 / matrix.diagonal()))
        if left != 0:
            raise RuntimeError(f"conjugate gradients did not converge ({left})")
        return found

    def advance(self, dt: float, count: int, theta: float) -> None:
        """`count` steps of dt [s]; theta 1/2 is Crank and Nicolson, 1 backward Euler."""
        free = self.free
        left = (self.mass + theta * dt * self.stiffness)[free][:, free]
        for _ in range(count):
            flow = -(self.stiffness @ self.temperature)  # [W]
            self.temperature[free] += self.solve(left, dt * flow[free])

    def of_particles(self) -> Any:
        """[K], by particle"""
        values = self.np.empty(self.elements)
        values[self.particle] = self.mean @ self.temperature
        return values


class ScikitFem(Engine):
    name = "scikit-fem"
    capabilities = ("heat", "heat-held", "elastic")
    presets = ("ElementHex1", "ElementHex2")
    settings = {
        "time_step": "goes before the job's [s]; default half of dx^2 over the greatest diffusivity, or twice the time "
        "of a pressure wave through a spacing"
    }

    def version(self) -> str:
        return version("scikit-fem")

    def library(self) -> Path | None:
        found = find_spec("skfem")
        return Path(found.origin).parent / "assembly/form/bilinear_form.py" if found and found.origin else None

    def refusal(self, job: Job) -> str:
        if job.preset not in self.presets:
            return f"scikit-fem: no preset '{job.preset}'; there are {', '.join(self.presets)}"
        unknown = [key for key in job.settings if key not in self.settings]
        if unknown:
            return f"scikit-fem: no setting '{unknown[0]}'; there are {', '.join(self.settings)}"
        return refuse_scene(job)

    def run(self, job: Job) -> Outcome:
        return self.run_solid(job) if is_elastic(job) else self.run_heat(job)

    def run_heat(self, job: Job) -> Outcome:
        began = time.process_time()
        bar = Bar(job, job.preset)
        limit = heat_step(job)
        outcome = Outcome(setup_cpu=time.process_time() - began)
        outcome.readback = {"gravity": job.scene["gravity"], "time_step": limit, "precision": "double", "bodies": []}
        outcome.state_hash = write_trajectory(job, HEAT_COLUMNS, _rows(job, bar, limit, outcome))
        outcome.pairs = float(bar.elements * outcome.steps)
        return outcome

    def run_solid(self, job: Job) -> Outcome:
        began = time.process_time()
        solid = Solid(job, job.preset)
        limit = float(job.settings.get("time_step", solid.natural_step))
        outcome = Outcome(setup_cpu=time.process_time() - began)
        outcome.readback = {"gravity": solid.gravity, "time_step": limit, "precision": "double", "bodies": []}
        outcome.state_hash = write_trajectory(job, PARTICLE_COLUMNS, _solid_rows(job, solid, limit, outcome))
        outcome.pairs = float(solid.elements * outcome.steps)
        return outcome


def _solid_rows(job: Job, solid: Solid, limit: float, outcome: Outcome) -> Iterator[Row]:
    now = job.times[0]
    for at in job.times:
        if at > now:
            count = steps_in(at - now, limit)
            solid.advance((at - now) / count, count)
            outcome.steps += count
            now = at
        place, velocity = solid.of_particles() if outcome.steps else (solid.start["position"], solid.start["velocity"])
        for number, (x, v) in enumerate(zip(place.tolist(), velocity.tolist())):
            yield [at, number, *x, *v]


def _rows(job: Job, bar: Bar, limit: float, outcome: Outcome) -> Iterator[Row]:
    now, place = job.times[0], bar.start["position"].tolist()
    start = bar.start["temperature"].tolist()
    for at in job.times:
        if at > now:
            count = steps_in(at - now, limit)
            dt = (at - now) / count
            if outcome.steps == 0:
                bar.advance(dt / START_STEPS, START_STEPS, 1.0)
                bar.advance(dt, count - 1, 0.5)
            else:
                bar.advance(dt, count, 0.5)
            outcome.steps += count
            now = at
        values = bar.of_particles().tolist() if outcome.steps else start
        for number, (x, temperature) in enumerate(zip(place, values)):
            yield [at, number, *x, 0.0, 0.0, 0.0, temperature]


if __name__ == "__main__":
    sys.exit(serve(ScikitFem(), sys.argv[1:]))
