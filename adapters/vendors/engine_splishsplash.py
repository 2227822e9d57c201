# SPDX-License-Identifier: BSD-3-Clause
"""SPlisHSPlasH (MIT), its Python wheel in single precision: one liquid between walls, and rigid bodies that float or
sink in it.

Presets are its pressure solvers by name. Walls and bodies are the job's particles (Akinci et al. 2012), each with the
volume of its mass: with the volumes that it finds by itself a lattice of liquid is too dense beside a wall. The wheel
is linked to a part of OpenGL that the system has too, and ends by a signal where both get loaded: the system's comes
first here, from Debian's packages in the engine's own environment."""

from __future__ import annotations

import ctypes
import math
import os
import sys
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from contract import Diverged, Engine, Job, Outcome, file_hash, file_of, serve
from rigid import LARGEST, steps_in
from rotation import conjugate, normalised, product, quaternion, rotate, vector
from splishsplash_frames import Frame, write_frames
from splishsplash_scene import Files, from_engine, friction_is_mixed, refuse_scene, to_engine

PRELOADED = ("libmd", "libbsd", "libXau", "libXdmcp", "libxcb", "libX11", "libXext", "libGLdispatch", "libGLX", "libGL")
METHODS = {"DFSPH": 4, "IISPH": 3, "PCISPH": 1, "WCSPH": 0}  # simulationMethod of a scene file
PRESSURE = {"DFSPH": "p / rho^2", "IISPH": "pressure", "PCISPH": "pressure", "WCSPH": "pressure"}  # its field by name
EXPONENT = 7.0  # of its equation of state, as in its own examples
CONFIGURED = {"cflFactor": 0.5, "cflMaxTimeStepSize": 0.005, "maxError": 0.01}  # its defaults


def wanted_step(job: Job) -> float | None:
    """[s]: the setting's, else the scene's; None = by the engine's CFL condition."""
    step = job.settings.get("time_step", job.time_step)
    return None if step is None else float(step)


def liquid_of(job: Job) -> dict[str, Any]:
    name = next(body["material"] for body in job.bodies if body["phase"] == "liquid")
    return next(material for material in job.scene["materials"] if material["name"] == name)


def boundary_viscosity(job: Job) -> float:
    """[m2/s]: the setting's, else 0 where all walls slip and the liquid's own where none does."""
    liquid = liquid_of(job)
    slips = bool(job.scene["periodic"]) or any(
        body["slip"] == "free" for body in job.bodies if body["phase"] == "rigid"
    )
    natural = 0.0 if slips or friction_is_mixed(job) else liquid["viscosity"] / liquid["density"]
    return float(job.settings.get("viscosityBoundary", natural))


def configuration(job: Job) -> dict[str, Any]:
    """Of a scene file, in its words."""
    liquid, settings = liquid_of(job), {**CONFIGURED, **job.settings}
    solver = {"maxError": float(settings["maxError"])}
    gravity = job.scene["gravity"]
    return {
        "particleRadius": 0.5 * job.scene["spacing"],
        "simulationMethod": METHODS[job.preset],
        "boundaryHandlingMethod": 0,
        "enableZSort": False,
        "gravitation": [gravity[0], gravity[2], -gravity[1]],
        "cflMethod": 0,
        "cflFactor": float(settings["cflFactor"]),
        "cflMaxTimeStepSize": float(settings["cflMaxTimeStepSize"]),
        "cflMinTimeStepSize": 1e-7,
        "timeStepSize": 1e-3,
        "stopAt": 0.5,
        "DFSPH": solver,
        "IISPH": solver,
        "PCISPH": solver,
        "WCSPH": {"stiffness": liquid["density"] * liquid["stiffness"] / EXPONENT, "exponent": EXPONENT},
    }


def natural_limit(job: Job) -> float:
    """What bounds a step besides the engine's CFL condition, of liquid speeds alone [s]: explicit viscosity and, in
    WCSPH, sound."""
    liquid, dx = liquid_of(job), float(job.scene["spacing"])
    limits = [math.inf]
    if liquid["viscosity"] > 0.0:
        limits.append(0.125 * dx * dx * liquid["density"] / liquid["viscosity"])
    if job.preset == "WCSPH":
        limits.append(0.25 * dx / math.sqrt(liquid["stiffness"]))
    return min(limits)


def load() -> Any:
    """The wheel's module, after the parts of OpenGL that it shares with the system."""
    folder = Path(os.environ.get("TRIPOINT_ENGINE_FOLDER", "")) / "usr/lib/x86_64-linux-gnu"
    for name in PRELOADED:
        file = next(iter(sorted(folder.glob(f"{name}.so.?"))), None)
        if file:
            ctypes.CDLL(str(file), ctypes.RTLD_GLOBAL)
    import pysplishsplash

    return pysplishsplash


class Tank:
    """The engine's own scene."""

    def __init__(self, splash: Any, job: Job, files: Files) -> None:
        import numpy as np

        self.np, self.job, self.files = np, job, files
        self.base = splash.Exec.SimulatorBase()
        self.base.init(
            sceneFile=str(files.folder / "scene.json"),
            useGui=False,
            initialPause=False,
            outputDir=str(files.folder),
            useCache=False,
            stopAt=0.5,
        )
        self.base.initSimulation()
        self.time = splash.TimeManager.getCurrent()
        self.time.setTime(1.0)  # beyond its stopAt: bodies are set up, and no step is taken
        self.base.runSimulation()
        self.time.setTime(0.0)
        self.base.setValueFloat(self.base.STOP_AT, -1.0)
        self.simulation = splash.Simulation.getCurrent()
        self.model = self.simulation.getFluidModel(0)
        self.models = [self.simulation.getBoundaryModel(k) for k in range(self.simulation.numberOfBoundaryModels())]
        for model in self.models:
            for k in range(model.numberOfParticles()):
                model.setVolume(k, job.scene["spacing"] ** 3)
        self.rest = np.array([material["density"] for material in job.scene["materials"]])[
            files.start["material"]
        ]  # by particle [kg/m3]
        count = self.model.numActiveParticles()
        if count != len(files.liquid):
            raise RuntimeError(f"SPlisHSPlasH holds {count} particles of liquid, and the job {len(files.liquid)}")
        self.place, self.velocity = self.field("position"), self.field("velocity")
        self.velocity[:] = to_engine(files.start["velocity"][files.liquid])
        free = files.free_bodies
        self.bodies = [model.getRigidBodyObject() for model in self.models[len(self.models) - len(free) :]]
        self.first_pose = [self.pose(body) for body in self.bodies]
        self.holds = [
            (self.bodies[k], place, turn, event)
            for event in job.scene["events"]
            for k, (place, turn) in enumerate(self.first_pose)
            if free[k]["name"] in event["bodies"]
        ]

    def field(self, name: str) -> Any:
        """A view of the engine's own column of the liquid."""
        return self.np.array(self.model.getFieldBuffer(name), copy=False)[: len(self.files.liquid)]

    def pose(self, body: Any) -> tuple[Any, Any]:
        """Place and turn, in the engine's axes and order."""
        return self.np.array(body.getPosition(), float), self.np.array(body.getRotation(), float)

    def turn(self, number: int) -> Any:
        """Of a free body from its start (w, x, y, z), in the engine's axes."""
        (x, y, z, w), first = self.pose(self.bodies[number])[1], self.first_pose[number][1]
        start = normalised(quaternion((first[3], *first[:3])))
        return product(normalised(quaternion((w, x, y, z))), conjugate(start))

    def hold(self) -> None:
        """Puts back what an event holds at this time."""
        for body, place, turn, event in self.holds:
            if event["time"] <= self.time.getTime() < event["until"]:
                body.setPosition(place)
                body.setRotation(turn)
                body.setVelocity(self.np.zeros(3))
                body.setAngularVelocity(self.np.zeros(3))

    def gravity(self) -> list[float]:
        return from_engine(self.np.array(self.simulation.getVec3ValueReal(self.simulation.GRAVITATION), float)).tolist()

    def held(self) -> list[dict[str, Any]]:
        """The free bodies as the engine holds them. It tells no moments: each is what a torque of its axis answers."""
        self.time.setTimeStepSize(1.0)  # [s], in which a torque of 1 N m makes a spin of one over the moment
        return [self.held_body(body, asked) for body, asked in zip(self.bodies, self.files.free_bodies)]

    def held_body(self, body: Any, asked: dict[str, Any]) -> dict[str, Any]:
        np, moments, spin = self.np, [], self.np.array(body.getAngularVelocity(), float)
        for axis in np.eye(3):
            direction = to_engine(np.array(rotate(quaternion(asked["principal_axes"]), vector(axis))))
            body.setAngularVelocity(np.zeros(3))
            body.addTorque(direction)
            moments.append(1.0 / float(np.array(body.getAngularVelocity(), float) @ direction))
        body.setAngularVelocity(spin)
        laws = self.job.settings
        return {
            "name": asked["name"],
            "mass": float(body.getMass()),
            "centre": (from_engine(self.pose(body)[0]) + self.files.origin).tolist(),
            "principal_inertia": moments,
            "friction": float(laws["friction"]) if "friction" in laws else None,
            "restitution": float(laws["restitution"]) if "restitution" in laws else None,
            "linear_damping": 0.0,
            "angular_damping": 0.0,
        }

    def limit(self) -> float:
        """[s]"""
        fixed = wanted_step(self.job)
        if fixed is not None:
            return fixed
        self.simulation.updateTimeStepSizeCFL()
        return min(float(self.time.getTimeStepSize()), natural_limit(self.job))

    def advance(self, span: float) -> int:
        """@return steps taken, which end at `span` [s]"""
        left, taken = span, 0
        while left > 0.0:
            count = steps_in(left, self.limit())
            step = left / count
            self.time.setTimeStepSize(step)
            self.base.timeStepNoGUI()
            self.hold()
            left = left - step if count > 1 else 0.0
            taken += 1
        return taken

    def first(self, at: float) -> Frame:
        """The job's own start: before its first step the engine has no density."""
        start = self.files.start
        return Frame(
            at, start["position"].copy(), start["velocity"].copy(), self.rest.copy(), self.np.zeros_like(self.rest), []
        )

    def pascal(self, density: Any) -> Any:
        """[Pa] of one unit of the solver's pressure: DFSPH keeps p rho_0 / rho^2 times its last step squared, IISPH and
        PCISPH p / rho_0.

        @param density of the liquid's particles [kg/m3]"""
        rest = self.rest[self.files.liquid]
        if self.job.preset == "DFSPH":
            return density**2 / (rest * float(self.time.getTimeStepSize()) ** 2)
        return 1.0 if self.job.preset == "WCSPH" else rest

    def frame(self, at: float) -> Frame:
        """Density and pressure of walls and bodies are those of the rest."""
        np, start, liquid = self.np, self.files.start, self.files.liquid
        place, velocity = start["position"].copy(), np.zeros_like(start["velocity"])
        place[liquid] = from_engine(self.place.astype(float)) + self.files.origin
        velocity[liquid] = from_engine(self.velocity.astype(float))
        if not (np.abs(place) < LARGEST).all() or not (np.abs(velocity) < LARGEST).all():
            raise Diverged(f"the liquid's state is not finite, or beyond {LARGEST:g}", -1, at)
        density, pressure = self.rest.copy(), np.zeros_like(self.rest)
        density[liquid] = self.field("density").astype(float)
        pressure[liquid] = self.field(PRESSURE[self.job.preset]).astype(float)
        pressure[liquid] *= self.pascal(density[liquid])
        poses = [self.pose_and_rates(k) for k in range(len(self.bodies))]
        return Frame(at, place, velocity, density, pressure, poses)

    def pose_and_rates(self, number: int) -> tuple[Any, Any, Any, Any]:
        body, (w, *axis) = self.bodies[number], self.turn(number)
        centre, drift, spin = (
            from_engine(self.np.array(read(), float))
            for read in (body.getPosition, body.getVelocity, body.getAngularVelocity)
        )
        return centre + self.files.origin, (w, *from_engine(self.np.array(axis))), drift, spin


class SplishSplash(Engine):
    name = "splishsplash"
    capabilities = ("liquid", "rigid")
    presets = tuple(METHODS)
    preset_words = {
        "DFSPH": '"Divergence-free smoothed particle hydrodynamics (DFSPH)", the default (SPlisHSPlasH, '
        "doc/file_format.md)",
        "IISPH": '"Implicit incompressible SPH (IISPH)" (SPlisHSPlasH, doc/file_format.md)',
        "PCISPH": '"Predictive-corrective incompressible SPH (PCISPH)" (SPlisHSPlasH, doc/file_format.md)',
        "WCSPH": '"Weakly compressible SPH for free surface flows (WCSPH)" (SPlisHSPlasH, doc/file_format.md)',
    }
    settings = {
        "time_step": "goes before the job's [s]; default its CFL condition, and bounds of explicit viscosity and, in "
        "WCSPH, of sound",
        "cflFactor": '"Factor to scale the CFL time step size", default 0.5',
        "cflMaxTimeStepSize": '"Max. allowed time step size", default 0.005 [s]',
        "maxError": '"Maximal density error in percent which the pressure solver tolerates", default 0.01',
        "viscosityBoundary": "viscosity at all walls [m2/s]; default 0 where all slip, the liquid's where none does",
        "friction": "Coulomb's coefficient of every pair of bodies, default 0",
        "restitution": "of every pair of bodies, default 0",
        "subSteps": '"Number of sub steps of the solver" of rigid bodies, default 1 here and 5 there',
        "contactStiffnessRigidBody": '"Stiffness coefficient for rigid-rigid contact resolution", default 100, 1 there',
    }
    precision = "single"

    def version(self) -> str:
        return version("pysplishsplash")

    def library(self) -> Path | None:
        return file_of("pysplishsplash", lambda name: name.startswith("pysplishsplash.") and name.endswith(".so"))

    def refusal(self, job: Job) -> str:
        if job.preset not in self.presets:
            return f"splishsplash: no preset '{job.preset}'; there are {', '.join(self.presets)}"
        unknown = [key for key in job.settings if key not in self.settings]
        if unknown:
            return f"splishsplash: no setting '{unknown[0]}'; there are {', '.join(self.settings)}"
        step = wanted_step(job)
        if step is not None and not step > 0.0:
            return "splishsplash: time_step must be above zero"
        return refuse_scene(job)

    def run(self, job: Job) -> Outcome:
        began = time.process_time()
        os.environ["OMP_NUM_THREADS"] = str(job.document.get("threads") or 1)
        os.dup2(2, 1)  # it prints
        splash = load()
        files = Files(job, job.folder / "splishsplash", configuration(job), boundary_viscosity(job))
        tank = Tank(splash, job, files)
        outcome = Outcome(setup_cpu=time.process_time() - began)
        bodies = tank.held()
        outcome.readback = {
            "gravity": tank.gravity(),
            "time_step": wanted_step(job) or tank.limit(),
            "precision": self.precision,
            "bodies": bodies,
        }
        path = job.folder / "trajectory.h5"
        write_frames(path, job, files.start, _frames(job, tank, outcome))
        outcome.state_hash = file_hash(path)
        outcome.pairs = float(outcome.steps * len(files.liquid))
        return outcome


def _frames(job: Job, tank: Tank, outcome: Outcome) -> Iterator[Frame]:
    now = job.times[0]
    for at in job.times:
        if at > now:
            outcome.steps += tank.advance(at - now)
            now = at
        yield tank.frame(at) if outcome.steps else tank.first(at)


if __name__ == "__main__":
    code = serve(SplishSplash(), sys.argv[1:])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # its own end may run into the system's graphics
