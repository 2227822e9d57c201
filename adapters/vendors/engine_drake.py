# SPDX-License-Identifier: BSD-3-Clause
"""Drake (BSD-3-Clause), the wheel: rigid bodies of its MultibodyPlant, contact by points or hydroelastic patches,
without restitution.

Presets: `hydroelastic` and `discrete` are the plant's own discrete update, with contact over patches and by points; the
others are names of its `integration_scheme` with a fixed step. Optional solvers of other licences are not loaded."""

from __future__ import annotations

import sys
from importlib.metadata import distribution, version
from pathlib import Path
from typing import Any

from contract import Job, serve
from drake_joints import KINDS, LAWS, LOOPS, Ties, refuse_continuous
from pair_fit import by_harmonic_mean, stated_friction
from rigid import (
    SHARED_SETTINGS,
    Body,
    Held,
    bodies_of,
    can_touch,
    Piece,
    RigidEngine,
    State,
    World,
    bounciness,
    coulomb,
    forces_on,
    why_it_grows,
)
from rotation import IDENTITY, Quaternion, Vector, add, product, quaternion, rotate, vector

APPROXIMATIONS = ("tamsi", "sap", "similar", "lagged")  # discrete_contact_approximation, in Drake's words
DISCRETE = ("hydroelastic", "discrete")  # presets of the discrete update: contact over patches, and Drake as it comes
RESOLUTION = 0.02  # of the mesh of a cylinder, Drake's default [m]; boxes need none
PLANT_SETTINGS = {  # members of MultibodyPlantConfig
    "discrete_contact_approximation": "tamsi, sap, similar or lagged (Drake's default), of the presets hydroelastic "
    "and discrete",
    "stiction_tolerance": "Drake's default 1e-4 [m/s]",
}
SURFACE_SETTINGS = {  # members of DefaultProximityProperties
    "margin": "of hydroelastic contact, Drake's default 0 [m]",
    "hunt_crossley_dissipation": "Drake's default 50 [s/m]",
    "relaxation_time": "of sap, Drake's default 0.1 [s]",
    "point_stiffness": "of contact by points, Drake's default 1e6 [N/m]",
}


def shape_of(piece: Piece) -> Any:
    import numpy as np
    from pydrake.geometry import Box, Capsule, Convex, Cylinder, HalfSpace, Sphere

    if piece.kind == "plane":
        return HalfSpace()
    if piece.kind == "box":
        return Box(*(2.0 * half for half in piece.size))
    if piece.kind == "sphere":
        return Sphere(piece.size[0])
    if piece.kind == "hull":
        return Convex(np.array(piece.corners).T, "hull")
    return (Cylinder if piece.kind == "cylinder" else Capsule)(piece.size[0], 2.0 * piece.size[2])


class DrakeWorld(World):
    def __init__(self, job: Job, bodies: list[Body], dt: float) -> None:
        self.job, self.bodies = job, bodies
        self.mu = by_harmonic_mean(stated_friction(job, [body.material for body in bodies])) or {}
        self.free = [number for number, body in enumerate(bodies) if body.free]
        self.balls: dict[str, Any] = {}
        self.build(
            dt,
            {
                number: State(bodies[number].centre, bodies[number].velocity, bodies[number].frame, bodies[number].spin)
                for number in self.free
            },
        )

    def build(
        self, dt: float, states: dict[int, State], coordinates: Any = None, turned: dict[str, Vector] | None = None
    ) -> None:
        """A plant of this step with the bodies in these states; Drake's discrete plants cannot change their step."""
        from pydrake.geometry import SceneGraphConfig
        from pydrake.math import RigidTransform
        from pydrake.multibody.math import SpatialVelocity
        from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig
        from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
        from pydrake.systems.framework import DiagramBuilder

        self.dt, self.ticks = dt, 0
        builder = DiagramBuilder()
        discrete = self.job.preset in DISCRETE
        chosen = self.job.settings
        self.modulus = float(chosen.get("hydroelastic_modulus", 0.0))
        plant, scene = MultibodyPlantConfig(time_step=dt if discrete else 0.0), SceneGraphConfig()
        for part, keys in ((plant, PLANT_SETTINGS), (scene.default_proximity_properties, SURFACE_SETTINGS)):
            for key in keys:
                if key in chosen:
                    setattr(part, key, chosen[key])
        self.plant, _ = AddMultibodyPlant(plant, scene, builder)
        self.plant.mutable_gravity_field().set_gravity_vector(list(self.job.scene["gravity"]))
        self.rigid = {number: self.add(number) for number in self.free}
        self.ties = Ties(self.job, self.bodies, self.plant, self.rigid, self.balls)
        for body in self.bodies:
            for piece in () if body.free else body.pieces:
                self.surface(self.plant.world_body(), piece, body.centre, body.frame, body.material)
        self.plant.Finalize()
        self.simulator = Simulator(builder.Build())
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        for number, state in states.items():
            if number in self.ties.held_by_joints:
                continue
            self.plant.SetFreeBodyPose(
                self.context, self.rigid[number], self.pose(state.centre, state.orientation, RigidTransform)
            )
            self.plant.SetFreeBodySpatialVelocity(
                self.context, self.rigid[number], SpatialVelocity(list(state.spin), list(state.velocity))
            )
        self.ties.start(self.context, coordinates, turned or {})
        self.push()
        if not discrete:
            config = SimulatorConfig()
            config.integration_scheme, config.max_step_size, config.use_error_control = self.job.preset, dt, False
            ApplySimulatorConfig(config, self.simulator)
        self.simulator.Initialize()

    def push(self) -> None:
        """Hands the plant its constant forces, at centres of mass."""
        from pydrake.multibody.math import SpatialForce
        from pydrake.multibody.plant import ExternallyAppliedSpatialForce

        forces = []
        for number in self.free:
            if any(value := forces_on(self.job, self.bodies[number])):
                force = ExternallyAppliedSpatialForce()
                force.body_index, force.F_Bq_W = self.rigid[number].index(), SpatialForce([0.0, 0.0, 0.0], list(value))
                forces.append(force)
        if forces:
            self.plant.get_applied_spatial_force_input_port().FixValue(self.context, forces)

    @staticmethod
    def pose(at: Vector, turn: Quaternion, transform: Any) -> Any:
        from pydrake.common.eigen_geometry import Quaternion as Turn

        length = sum(c * c for c in turn) ** 0.5
        return transform(Turn([c / length for c in turn]), list(at))

    def add(self, number: int) -> Any:
        from pydrake.multibody.tree import SpatialInertia, UnitInertia

        body = self.bodies[number]
        unit = [moment / body.mass for moment in body.inertia]
        rigid = self.plant.AddRigidBody(f"body{number}", SpatialInertia(body.mass, [0.0, 0.0, 0.0], UnitInertia(*unit)))
        for piece in body.pieces:
            self.surface(rigid, piece, (0.0, 0.0, 0.0), IDENTITY, body.material)
        return rigid

    def surface(self, rigid: Any, piece: Piece, at: Vector, turn: Quaternion, material: str) -> None:
        from pydrake.geometry import AddContactMaterial, ProximityProperties
        from pydrake.math import RigidTransform
        from pydrake.multibody.plant import CoulombFriction

        place = self.pose(add(at, rotate(turn, piece.centre)), product(turn, piece.rotation), RigidTransform)
        mu = self.mu.get(material, coulomb(self.job))
        self.count = getattr(self, "count", 0) + 1
        properties = ProximityProperties()
        AddContactMaterial(friction=CoulombFriction(mu, mu), properties=properties)
        if self.modulus and piece.kind not in ("sphere", "capsule"):
            self.compress(properties, fixed=rigid.index() == self.plant.world_body().index())
        self.plant.RegisterCollisionGeometry(rigid, place, shape_of(piece), f"surface{self.count}", properties)

    def compress(self, properties: Any, fixed: bool) -> None:
        """Makes a surface hydroelastic. Balls and capsules are left to points: they meet a face in one, and roll as no
        mesh does."""
        from pydrake.geometry import AddCompliantHydroelasticProperties, AddRigidHydroelasticProperties

        if fixed:  # two rigid surfaces would meet in one point
            AddRigidHydroelasticProperties(RESOLUTION, properties)
        else:
            AddCompliantHydroelasticProperties(RESOLUTION, self.modulus, properties)

    def step(self, dt: float, count: int) -> None:
        if abs(dt / self.dt - 1.0) > 1e-9:
            self.build_again(dt, {})
        for part in [1] * count if self.balls else [count]:
            self.ticks += part
            self.simulator.AdvanceTo(self.ticks * self.dt)
            if turned := self.ties.turn_balls(self.context):
                self.build_again(dt, turned)

    def build_again(self, dt: float, turned: dict[str, Vector]) -> None:
        """With everything where it is. @param turned as of Ties.start"""
        states = {number: self.state(number) for number in self.free}
        self.build(dt, states, self.ties.coordinates(self.context), turned)

    def state(self, number: int) -> State:
        rigid = self.rigid[number]
        pose = self.plant.EvalBodyPoseInWorld(self.context, rigid)
        speed = self.plant.EvalBodySpatialVelocityInWorld(self.context, rigid)
        return State(
            vector(pose.translation()),
            vector(speed.translational()),
            quaternion(pose.rotation().ToQuaternion().wxyz()),
            vector(speed.rotational()),
        )

    def held(self, number: int) -> Held:
        inertia = self.rigid[number].CalcSpatialInertiaInBodyFrame(self.context)
        mass = float(inertia.get_mass())
        return Held(
            mass,
            vector([mass * float(moment) for moment in inertia.get_unit_inertia().get_moments()]),
            coulomb(self.job),
        )

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.ties.held()

    def gravity(self) -> Vector:
        return vector(self.plant.gravity_field().gravity_vector())


class Drake(RigidEngine):
    name, title = "drake", "Drake"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint", "spring")
    joint_kinds, joint_laws, joint_loops = KINDS, LAWS, LOOPS
    presets = (*DISCRETE, "runge_kutta2", "runge_kutta3", "semi_explicit_euler", "runge_kutta5")
    preset_words = {
        "hydroelastic": '"The contact force between two deformed bodies is distributed over a contact patch" '
        "(Drake, Hydroelastic Contact User Guide)",
        "discrete": '"By default no geometry in drake::geometry::SceneGraph has a hydroelastic representation" '
        "(Drake, Hydroelastic Contact User Guide)",
    }
    preset_settings = {"hydroelastic": {"hydroelastic_modulus": 1e9}}
    settings = (
        SHARED_SETTINGS
        | PLANT_SETTINGS
        | SURFACE_SETTINGS
        | {
            "hydroelastic_modulus": "of free bodies [Pa], 1e9 in the preset hydroelastic, fixed ones being rigid; "
            "without it contact is by points"
        }
    )
    default_step = 0.001  # of Drake's own MultibodyPlantConfig

    def version(self) -> str:
        return version("drake")

    def library(self) -> Path | None:
        files = distribution("drake").files or []
        return next((Path(str(f.locate())) for f in files if f.name.startswith("libdrake.so")), None)

    def refuse(self, job: Job) -> str:
        word = job.settings.get("discrete_contact_approximation", "lagged")
        if word not in APPROXIMATIONS:
            return f"drake: discrete_contact_approximation is one of {', '.join(APPROXIMATIONS)}"
        grows = why_it_grows(job, self.default_step) if job.preset in (*DISCRETE, "semi_explicit_euler") else ""
        if grows:
            return f"Drake's {job.preset} " + grows
        if by_harmonic_mean(stated_friction(job, [body["material"] for body in job.bodies])) is None:
            return (
                "Drake combines the friction of two surfaces as 2ab/(a + b), and no numbers of the materials give "
                "what is stated of their pairs"
            )
        bounce = max([bounciness(job), *(law["restitution"] or 0.0 for law in job.scene.get("contacts", ()))])
        if bounce > 0.0:
            return f"Drake's contact has no coefficient of restitution, and {bounce:g} is asked for"
        if job.preset not in DISCRETE and (why := self.refuse_continuous(job)):
            return why
        for body in job.bodies:
            moments = sorted(body["principal_inertia"])
            if body["motion"] == "free" and moments[0] + moments[1] < moments[2] * (1.0 - 1e-12):
                return f"Drake refuses moments of inertia that no body can have, and those of {body['name']} are such"
        return ""

    def refuse_continuous(self, job: Job) -> str:
        """What the continuous plants leave out, or are too stiff for."""
        if can_touch(job):
            return (
                "Drake's continuous contact is stiff, and its integrators run here with a fixed step: contact is "
                f"handed to {' and '.join(DISCRETE)} alone"
            )
        return refuse_continuous(job, bodies_of(job))

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        return DrakeWorld(job, bodies, dt)


if __name__ == "__main__":
    sys.exit(serve(Drake(), sys.argv[1:]))
