# SPDX-License-Identifier: BSD-3-Clause
"""CalculiX (GPL-2.0, a process of its own), Debian's ccx: conduction at rest and elastic bodies that something fixed
holds.

Presets are its elements. Each body is meshed with cubes of one spacing, one a particle, and a particle shows the mean
of the corners of its cube. It also answers the job's gauges, each a sum of the values at the nodes about a point or of
a body. Time: CalculiX's own `*HEAT TRANSFER` (backward Euler) and `*DYNAMIC` (its alpha method, ALPHA=0: no numerical
damping), with direct increments."""

from __future__ import annotations

import itertools
import math
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from contract import (
    HEAT_COLUMNS,
    PARTICLE_COLUMNS,
    Diverged,
    Engine,
    Job,
    Outcome,
    Row,
    serve,
    write_gauges,
    write_trajectory,
)
from lattice import (
    Mesh,
    across,
    materials_of,
    mesh_of,
    nodes_in_box,
    refuse_body,
    refuse_boxes,
    refuse_work,
    temperature_at,
    velocity_at,
)
from rigid import steps_in
from rotation import norm, vector

FASTEST_RUN = 590.0  # [s] of wall time
GAUGES = {
    "temperature_at": "NT",
    "mean_temperature": "NT",
    "displacement": "U",
    "centre": "U",
    "velocity_at": "V",
    "mean_velocity": "V",
}  # what is summed


def is_elastic(job: Job) -> bool:
    return any(body["phase"] == "elastic" and body["temperature"] is None for body in job.bodies)


def of_solid(material: dict, key: str) -> float:
    """A value of the solid, which is the liquid's where it has none of its own."""
    own = material.get("solid_" + key)
    return float(material[key] if own is None else own)


MOST_QUADRATIC = 250_000  # elements times steps of the elements of 20 nodes


def linked(job: Job, one: dict, other: dict) -> bool:
    return other["name"] in one["joined_to"] or one["name"] in other["joined_to"]


def near(job: Job, one: dict, other: dict) -> bool:
    """Whether two boxes touch or overlap, or could before long: they are less than two spacings apart."""
    reach = 2.0 * job.scene["spacing"]
    a, b = one["shape"], other["shape"]
    return all(a["min"][k] < b["max"][k] + reach and b["min"][k] < a["max"][k] + reach for k in range(3))


def heat_step(job: Job) -> float:
    """[s]: half of dx^2 over the greatest diffusivity of what is not held."""
    every = list(zip(job.bodies, materials_of(job)))
    live = [m for body, m in every if not body["temperature_held"]] or [m for _, m in every]
    diffusivity = max(of_solid(m, "conductivity") / (m["density"] * of_solid(m, "heat_capacity")) for m in live)
    return 0.5 * float(job.scene["spacing"]) ** 2 / diffusivity


def refuse_heat(job: Job) -> str:
    for body, material in zip(job.bodies, materials_of(job)):
        if body["temperature"] is None:
            return f"{body['name']} has no temperature beside others that have one"
        driven = any(job.scene["gravity"]) or any(body["velocity"]) or any(body["angular_velocity"])
        if body["phase"] == "liquid" or (body["motion"] != "fixed" and driven):
            return f"CalculiX is handed conduction at rest, and {body['name']} may move"
        if material["t_melt"] is not None:
            return f"{body['name']} may melt, and the elements here have no latent heat"
    if "20" not in job.preset:
        return ""
    return refuse_work(job, float(job.settings.get("time_step", heat_step(job))), MOST_QUADRATIC, job.preset, "C3D8")


def refuse_solids(job: Job) -> str:
    reasons = (refuse_solid(body, material) for body, material in zip(job.bodies, materials_of(job)))
    if reason := next(filter(None, reasons), ""):
        return reason
    elastic = [body for body in job.bodies if body["phase"] == "elastic"]
    for body in elastic:
        if not any(linked(job, body, other) and other["motion"] == "fixed" for other in job.bodies):
            return f"bodies that nothing holds are not handed to CalculiX, and {body['name']} is free"
    for body in elastic:
        if any(other is not body and not linked(job, body, other) and near(job, body, other) for other in job.bodies):
            return f"contact is not handed to CalculiX, and {body['name']} may touch another body"
    return ""


def refuse_solid(body: dict, material: dict) -> str:
    if reason := refuse_body(body, material, "CalculiX"):
        return reason
    if body["phase"] == "rigid" and body["motion"] == "free":
        return f"free rigid bodies are not handed to CalculiX, and {body['name']} is one"
    if body["velocity_field"]["kind"] not in ("constant", "expression"):
        return f"the velocity of {body['name']} is neither constant nor an expression"
    return ""


class Deck:
    """One input file of ccx, and what is read from its output."""

    def __init__(self, job: Job) -> None:
        self.job, self.elastic = job, is_elastic(job)
        wanted = {k for k, body in enumerate(job.bodies) if not self.elastic or body["phase"] == "elastic"}
        self.mesh: Mesh = mesh_of(job, wanted, "20" in job.preset)
        self.materials = materials_of(job)
        self.limit = float(job.settings.get("time_step", self.natural_step()))

    def natural_step(self) -> float:
        dx, wanted = self.mesh.spacing, set(self.mesh.body)
        if self.elastic:

            def wave(m: dict) -> float:
                E, nu = float(m["young_modulus"]), float(m["poisson_ratio"] or 0.0)
                return math.sqrt(E * (1.0 - nu) / (m["density"] * (1.0 + nu) * (1.0 - 2.0 * nu)))

            return 2.0 * dx / max(wave(self.materials[k]) for k in wanted)
        return heat_step(self.job)

    def gauge(self, asked: dict[str, Any]) -> tuple[dict[int, float], str, float] | None:
        """Weights of the nodes, what is summed (NT, U1, V2 ...) and what is added; None for a gauge that has no answer
        here."""
        where, mesh = asked["where"], self.mesh
        kind = GAUGES.get(asked["quantity"], "")
        bodies = {k for k in set(mesh.body) if asked["body"] in ("", self.job.bodies[k]["name"])}
        if not bodies or not self.has_gauge(kind, where):
            return None
        axis = "xyz".index(where["axis"]) if kind != "NT" else 0
        word = kind if kind == "NT" else f"{kind}{axis + 1}"
        if asked["quantity"] in ("temperature_at", "displacement", "velocity_at"):
            weights = mesh.weights(vector(where["point"]), bodies)
            return (weights, word, 0.0) if weights else None
        inside = [body in bodies and self.in_region(where, mesh.middle(e)) for e, body in enumerate(mesh.body)]
        mass = [float(self.materials[body]["density"]) if kind != "NT" else 1.0 for body in mesh.body]
        if sum(itertools.compress(mass, inside)) == 0.0:
            return None
        start = self.start_centre(mass, inside, axis) if asked["quantity"] == "centre" else 0.0
        return mesh.mean(mass, inside), word, start

    def has_gauge(self, kind: str, where: dict[str, Any]) -> bool:
        of_heat = kind == "NT"
        return bool(kind) and of_heat != self.elastic and "phase" not in where and (of_heat or "axis" in where)

    def start_centre(self, mass: Sequence[float], inside: Sequence[bool], axis: int) -> float:
        """Centre of mass of the elements inside before anything moves [m]."""
        taken = [e for e, take in enumerate(inside) if take]
        return sum(mass[e] * self.mesh.middle(e)[axis] for e in taken) / sum(mass[e] for e in taken)

    @staticmethod
    def in_region(where: dict[str, Any], at: Sequence[float]) -> bool:
        if "min" not in where:
            return True
        return all(a <= x <= b for x, a, b in zip(at, where["min"], where["max"])) != bool(where.get("outside", False))

    def started(self) -> dict[str, dict[int, float]]:
        """What the nodes have at the start, which ccx does not print."""
        values = {
            f"{letter}{axis}": dict.fromkeys(self.mesh.node.values(), 0.0) for letter in "UV" for axis in (1, 2, 3)
        }
        kind = ""
        for line in self.elastic_start() if self.elastic else self.heat_start():
            if line.startswith("*"):
                kind = line
                continue
            words = line.split(",")
            if "TEMPERATURE" in kind:
                values.setdefault("NT", {})[int(words[0])] = float(words[1])
            elif "VELOCITY" in kind:
                values[f"V{words[1]}"][int(words[0])] = float(words[2])
        return values

    def gauge_rows(self, frames: list[dict[str, dict[int, float]]]) -> Iterator[Row]:
        """Rows of gauges.csv."""
        answers = [(number, found) for number, found in enumerate(map(self.gauge, self.job.gauges)) if found]
        for at, values in zip(self.job.times, [self.started(), *frames]) if answers else ():
            for number, (weights, word, start) in answers:
                yield at, number, start + math.fsum(w * values[word][n] for n, w in weights.items())

    def lines(self) -> Iterator[str]:
        mesh, job = self.mesh, self.job
        yield "*NODE, NSET=ALL"
        for at, n in mesh.node.items():
            yield f"{n}," + ",".join(f"{x:.15g}" for x in mesh.place(at))
        for number in sorted(set(mesh.body)):
            yield f"*ELEMENT, TYPE={job.preset}, ELSET=E{number}"
            for e, (nodes, body) in enumerate(zip(mesh.elements, mesh.body)):
                if body == number:
                    words = [str(e + 1), *map(str, nodes)]
                    yield from (
                        ",".join(words[k : k + 11]) + ("," if k + 11 < len(words) else "")
                        for k in range(0, len(words), 11)
                    )
            yield from self.material_lines(number)
        yield "*ELSET, ELSET=EALL"
        yield from (f"E{number}" for number in sorted(set(mesh.body)))
        yield from (self.elastic_start() if self.elastic else self.heat_start())
        yield from self.steps()

    def material_lines(self, number: int) -> Iterator[str]:
        m = self.materials[number]
        yield f"*MATERIAL, NAME=M{number}"
        yield "*DENSITY"
        yield f"{m['density']!r}"
        if self.elastic:
            yield "*ELASTIC"
            yield f"{m['young_modulus']!r},{float(m['poisson_ratio'] or 0.0)!r}"
        else:
            yield "*CONDUCTIVITY"
            yield f"{of_solid(m, 'conductivity')!r}"
            yield "*SPECIFIC HEAT"
            yield f"{of_solid(m, 'heat_capacity')!r}"
        yield f"*SOLID SECTION, ELSET=E{number}, MATERIAL=M{number}"

    def heat_start(self) -> Iterator[str]:
        """A node's temperature is the mean of its elements', by their heat capacity; what is held goes before."""
        mesh, bodies = self.mesh, self.job.bodies
        heat, content, held = {}, {}, {}
        for e, (nodes, body) in enumerate(zip(mesh.elements, mesh.body)):
            c = self.materials[body]["density"] * of_solid(self.materials[body], "heat_capacity")
            own = (
                temperature_at(bodies[body]["temperature"], mesh.middle(e))
                if bodies[body]["temperature"]["kind"] != "cosine"
                else None
            )
            for n in nodes:
                heat[n] = heat.get(n, 0.0) + c * (
                    own if own is not None else temperature_at(bodies[body]["temperature"], self.place_of(n))
                )
                content[n] = content.get(n, 0.0) + c
                if bodies[body]["temperature_held"]:
                    held[n] = own if own is not None else temperature_at(bodies[body]["temperature"], self.place_of(n))
        yield "*INITIAL CONDITIONS, TYPE=TEMPERATURE"
        yield from (f"{n},{held.get(n, heat[n] / content[n]):.12g}" for n in sorted(heat))
        if held:
            yield "*BOUNDARY"
            yield from (f"{n},11,11,{T:.12g}" for n, T in sorted(held.items()))

    def place_of(self, node: int) -> tuple[float, float, float]:
        if not hasattr(self, "places"):
            self.places = {n: self.mesh.place(at) for at, n in self.mesh.node.items()}
        return self.places[node]

    def elastic_start(self) -> Iterator[str]:
        mesh, bodies = self.mesh, self.job.bodies
        held = {n for body in bodies if body["motion"] == "fixed" for n in nodes_in_box(mesh, body["shape"])}
        yield "*BOUNDARY"
        yield from (f"{n},1,3" for n in sorted(held))
        for axis in across(self.job)[1]:
            ends = {min(at[axis] for at in mesh.node), max(at[axis] for at in mesh.node)}
            yield from (
                f"{n},{axis + 1},{axis + 1}" for at, n in mesh.node.items() if at[axis] in ends and n not in held
            )
        moving = self.start_velocities(held)
        if any(norm(v) > 0.0 for v in moving.values()):
            yield "*INITIAL CONDITIONS, TYPE=VELOCITY"
            for n, v in sorted(moving.items()):
                yield from (f"{n},{axis + 1},{v[axis]!r}" for axis in range(3))

    def start_velocities(self, held: set[int]) -> dict[int, Any]:
        """{node that nothing holds: its velocity [m/s]}; where bodies meet, of the last one."""
        return {
            n: velocity_at(self.job.bodies[body]["velocity_field"], self.place_of(n))
            for nodes, body in zip(self.mesh.elements, self.mesh.body)
            for n in nodes
            if n not in held
        }

    def intervals(self) -> list[tuple[float, int]]:
        """Length [s] and number of equal output intervals, one after the other."""
        found: list[tuple[float, int]] = []
        for a, b in zip(self.job.times, self.job.times[1:]):
            if found and abs(found[-1][0] - (b - a)) < 1e-9 * self.job.times[-1]:
                found[-1] = (found[-1][0], found[-1][1] + 1)
            else:
                found.append((b - a, 1))
        return found

    def steps(self) -> Iterator[str]:
        for length, times in self.intervals():
            each = steps_in(length, self.limit)
            yield f"*STEP, INC={each * times + 1}"
            yield "*DYNAMIC, DIRECT, ALPHA=0." if self.elastic else "*HEAT TRANSFER, DIRECT"
            yield f"{length / each:.15g},{length * times:.15g}"
            gravity = vector(self.job.scene["gravity"])
            if self.elastic and norm(gravity) > 0.0:
                yield "*DLOAD"
                yield f"EALL,GRAV,{norm(gravity)!r}," + ",".join(repr(c / norm(gravity)) for c in gravity)
            yield f"*NODE PRINT, NSET=ALL, FREQUENCY={each}"
            yield "U,V" if self.elastic else "NT"
            yield f"*EL PRINT, ELSET=EALL, TOTALS=ONLY, FREQUENCY={each}"
            yield "EVOL"
            yield "*END STEP"

    def count(self) -> int:
        return sum(steps_in(length, self.limit) * times for length, times in self.intervals())

    def read(self, text: str) -> tuple[list[dict[str, dict[int, float]]], float]:
        """Values of the printed nodes at each output time after the start, by kind; and the volume of all elements
        [m3]."""
        frames: list[tuple[float, dict[str, dict[int, float]]]] = []
        volume, block = math.nan, ""
        for line in text.splitlines():
            words = line.split()
            if "for set" in line:
                block = words[0]
                at = float(words[-1])
                if block in ("displacements", "velocities", "temperatures") and (
                    not frames or abs(frames[-1][0] - at) > 1e-9
                ):
                    frames.append((at, {}))
                continue
            if not words or block == "":
                continue
            if block == "total" or "volume" in line:
                volume = float(words[-1])
            elif block == "temperatures":
                frames[-1][1].setdefault("NT", {})[int(words[0])] = float(words[1])
            elif block in ("displacements", "velocities"):
                letter = "U" if block == "displacements" else "V"
                for axis in (1, 2, 3):
                    frames[-1][1].setdefault(f"{letter}{axis}", {})[int(words[0])] = float(words[axis])
        return [values for _, values in frames], volume

    def rows(self, frames: list[dict[str, dict[int, float]]], start: dict[str, list[Any]]) -> Iterator[Row]:
        """Rows of the trajectory. @param start of the particles: position, velocity and, where there is heat,
        temperature"""
        mesh, places = self.mesh, start["position"]
        low = [min(x[k] for x in places) for k in range(3)]
        element = {self.cell(mesh.middle(e), low): e for e in range(len(mesh.elements))}
        corners = [mesh.elements[element[c]][:8] if c in element else () for c in (self.cell(x, low) for x in places)]
        for i, x in enumerate(places):
            yield self.job.times[0], i, *x, *start["velocity"][i], *([] if self.elastic else [start["temperature"][i]])
        for at, values in zip(self.job.times[1:], frames):
            for i, (x, nodes) in enumerate(zip(places, corners)):
                if not self.elastic:
                    yield at, i, *x, 0.0, 0.0, 0.0, mean(values["NT"], nodes)
                elif nodes:
                    yield (
                        at,
                        i,
                        *(a + mean(values[f"U{k}"], nodes) for k, a in enumerate(x, 1)),
                        *(mean(values[f"V{k}"], nodes) for k in (1, 2, 3)),
                    )
                else:
                    yield at, i, *x, 0.0, 0.0, 0.0

    def cell(self, at: Sequence[float], low: Sequence[float]) -> tuple[int, ...]:
        return tuple(round((a - b) / self.mesh.spacing) for a, b in zip(at, low))


def mean(values: dict[int, float], nodes: Sequence[int]) -> float:
    return math.fsum(values[n] for n in nodes) / len(nodes)


def particles_of(job: Job, heat: bool) -> dict[str, list[Any]]:
    import h5py  # here, because --info and --check need none

    with h5py.File(job.particles) as file:
        return {
            key: file[f"particles/all/{key}/value"][0].tolist()
            for key in ("position", "velocity") + (("temperature",) if heat else ())
        }


class Calculix(Engine):
    name = "calculix"
    capabilities = ("heat", "heat-held", "elastic")
    presets = ("C3D8", "C3D8I", "C3D20", "C3D20R")
    settings = {
        "time_step": "[s]; default half of dx^2 over the greatest diffusivity, or the time of a pressure wave through "
        "two spacings"
    }

    def version(self) -> str:
        return os.environ.get("TRIPOINT_ENGINE_VERSION", "")

    def library(self) -> Path | None:
        return Path(os.environ.get("TRIPOINT_ENGINE_FOLDER", "")) / "usr/bin/ccx"

    def refusal(self, job: Job) -> str:
        if job.preset not in self.presets:
            return f"calculix: no preset '{job.preset}'; there are {', '.join(self.presets)}"
        unknown = [key for key in job.settings if key not in self.settings]
        if unknown:
            return f"calculix: no setting '{unknown[0]}'; there are {', '.join(self.settings)}"
        scene = job.scene
        if scene["mode"] == "paper":
            return "the paper's forms belong to the particle solver; CalculiX has none"
        if scene["events"] or scene["inflows"]:
            return "events and inflow are not handed to CalculiX"
        elastic = is_elastic(job)
        if not elastic and not any(body["temperature"] for body in job.bodies):
            return "CalculiX is handed heat or elastic bodies, and there are none"
        if scene["jitter"]:
            return "particles off their lattice are no elements"
        return (refuse_solids(job) if elastic else refuse_heat(job)) or refuse_boxes(job, "CalculiX") or across(job)[0]

    def run(self, job: Job) -> Outcome:
        began = time.process_time()
        deck = Deck(job)
        (job.folder / "ccx.inp").write_text("\n".join(deck.lines()) + "\n", encoding="ascii")
        outcome = Outcome(setup_cpu=time.process_time() - began, steps=deck.count())
        frames, volume = deck.read(self.solve(job))
        if len(frames) + 1 != len(job.times):
            raise Diverged(
                f"ccx printed {len(frames)} of {len(job.times) - 1} output times",
                0,
                job.times[min(len(frames), len(job.times) - 1)],
            )
        wanted = len(deck.mesh.elements) * deck.mesh.spacing**3
        if not abs(volume / wanted - 1.0) < 0.01:  # of the deformed elements, whose strains are small
            raise RuntimeError(f"ccx holds a volume of {volume} m3, and the job {wanted} m3")
        outcome.readback = {
            "gravity": job.scene["gravity"],
            "time_step": deck.limit,
            "precision": "double",
            "bodies": [],
        }
        columns = PARTICLE_COLUMNS if deck.elastic else HEAT_COLUMNS
        outcome.state_hash = write_trajectory(job, columns, deck.rows(frames, particles_of(job, not deck.elastic)))
        gauges = list(deck.gauge_rows(frames))
        if gauges:
            outcome.state_hash += write_gauges(job, gauges)
        outcome.pairs = float(len(deck.mesh.elements) * outcome.steps)
        return outcome

    def solve(self, job: Job) -> str:
        """@return what ccx printed. @raise RuntimeError with its own last words"""
        folder = Path(os.environ["TRIPOINT_ENGINE_FOLDER"]) / "usr/lib/x86_64-linux-gnu"
        path = ":".join(str(f) for f in (folder, folder / "blas", folder / "lapack"))
        environment = {**os.environ, "LD_LIBRARY_PATH": path, "OMP_NUM_THREADS": "1"}
        end = subprocess.run(
            [str(self.library()), "-i", "ccx"],
            cwd=job.folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=FASTEST_RUN,
            check=False,
        )
        printed = job.folder / "ccx.dat"
        if end.returncode != 0 or not printed.exists():
            raise RuntimeError(
                f"ccx ended with {end.returncode}: " + " / ".join((end.stdout + end.stderr).strip().splitlines()[-3:])
            )
        for line in end.stdout.splitlines():
            if "*ERROR" in line:
                raise RuntimeError("ccx: " + line.strip())
        return printed.read_text(encoding="ascii")


if __name__ == "__main__":
    sys.exit(serve(Calculix(), sys.argv[1:]))
