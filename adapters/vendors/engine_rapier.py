# SPDX-License-Identifier: BSD-3-Clause
"""Rapier (Apache-2.0), its Python wheel in single precision: rigid bodies, contacts. Presets are its friction models by
name, with contacts as they come, and `stiff-contact`: SIMPLIFIED with stiff contacts."""

from __future__ import annotations

import math
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

from contract import Job, file_of, serve
from joints import joints_of, tree_of
from rapier_joints import KINDS, LAWS, REDUCED, Ties
from rigid import (
    SHARED_SETTINGS,
    Body,
    Held,
    PairLaws,
    Piece,
    RigidEngine,
    State,
    World,
    bodies_of,
    bounciness,
    coulomb,
    forces_on,
    moves,
    upright,
)
from rotation import Quaternion, Vector, norm, rotate, vector

WORLD_SETTINGS = {  # attributes of IntegrationParameters, in Rapier's words, with what they are
    "num_solver_iterations": "substeps of a step, Rapier's default 4",
    "num_internal_pgs_iterations": "Rapier's default 1",
    "num_internal_stabilization_iterations": "Rapier's default 1",
    "contact_natural_frequency": "Rapier's default 30 [Hz]",
    "contact_damping_ratio": "Rapier's default 10",
    "static_contact_natural_frequency": "of contact with fixed bodies, Rapier's default 60 [Hz]",
    "static_contact_damping_ratio": "of contact with fixed bodies, Rapier's default 10",
    "contact_recycling": "whether pairs that hardly moved keep their points, true (Rapier's default) or false",
    "friction_in_bias_pass": "true, or false (Rapier's default): friction in the second pass of a substep alone",
    "normalized_allowed_linear_error": "Rapier's default 0.005 [m]",
    "normalized_prediction_distance": "Rapier's default 0.02 [m]",
    "normalized_max_corrective_velocity": "Rapier's default 3 [m/s]",
    "warmstart_coefficient": "Rapier's default 1",
}
# Of a step [rad]: Rapier slows a faster spin down, unless allow_fast_rotation is set, which is not its default.
FASTEST_TURN = math.pi / 4


def xyz(v: Any) -> Vector:
    return float(v.x), float(v.y), float(v.z)


SOFTNESS = {
    f"{pairs}_{word}": (f"{pairs}_softness", word)  # setting -> member of IntegrationParameters, and its own member
    for pairs in ("contact", "static_contact")
    for word in ("natural_frequency", "damping_ratio")
}


def set_parameter(parameters: Any, key: str, value: Any) -> None:
    if key not in SOFTNESS:
        setattr(parameters, key, type(getattr(parameters, key))(value))
        return
    outer, inner = SOFTNESS[key]
    spring = getattr(parameters, outer)  # the wheel hands out a copy
    setattr(spring, inner, float(value))
    setattr(parameters, outer, spring)


def friction_model(job: Job) -> str:
    return "COULOMB" if job.preset == "COULOMB" else "SIMPLIFIED"


class MaterialHooks:
    """Hands each contact the friction and restitution of its pair of materials."""

    def __init__(self, laws: PairLaws, materials: dict[int, str]) -> None:
        self.laws, self.materials = laws, materials  # user data of a collider -> material

    def modify_solver_contacts(self, context: Any) -> None:
        one, other = (
            self.materials[context.colliders[handle].user_data] for handle in (context.collider1, context.collider2)
        )
        context.friction, context.restitution = self.laws.of(one, other)


class RapierWorld(World):
    def __init__(self, rapier: Any, job: Job, bodies: list[Body], dt: float) -> None:
        self.rapier = rapier
        self.world = rapier.PhysicsWorld(gravity=vector(job.scene["gravity"]))
        # No set_num_threads: it would hand every step to a thread of its own, which on a busy machine waits for its
        # turn each time.
        parameters = self.world.integration_parameters
        parameters.dt = dt
        parameters.friction_model = getattr(rapier.FrictionModel, friction_model(job))
        for key in WORLD_SETTINGS:
            if key in job.settings:
                set_parameter(parameters, key, job.settings[key])
        self.friction = coulomb(job)
        self.restitution = bounciness(job)
        self.gyroscopic = bool(job.settings.get("gyroscopic_forces", True))
        laws = PairLaws(job)
        self.hooked = bool(laws.stated)
        if self.hooked:
            self.world.physics_hooks = MaterialHooks(
                laws, {number: body.material for number, body in enumerate(bodies)}
            )
        self.job = job
        self.handles = {number: self.add(number, body) for number, body in enumerate(bodies)}
        self.ties = Ties(rapier, self.world, job, bodies, self.handles, self.isometry)

    def isometry(self, at: Vector, turn: Quaternion) -> Any:
        return self.rapier.Isometry3(at, self.rapier.Rotation3.from_quaternion(*turn))

    def add(self, number: int, body: Body) -> Any:
        kinds = self.rapier.RigidBody
        make = kinds.dynamic if body.free else kinds.kinematic_velocity_based if moves(body) else kinds.fixed
        builder = make().position(self.isometry(body.centre, body.frame)).can_sleep(False)
        if body.free:
            # The colliders have no density: the mass is the job's alone.
            mass = self.rapier.MassProperties((0.0, 0.0, 0.0), body.mass, body.inertia)
            builder = builder.linvel(body.velocity).angvel(body.spin).additional_mass_properties(mass)
            builder = builder.gyroscopic_forces(self.gyroscopic)
        if moves(body):
            builder = builder.linvel(body.velocity)
        handle = self.world.add_body(builder, [self.collider(piece, number) for piece in body.pieces])
        # Else the mass would be 0 until the first step, and could not be read back.
        self.world.rigid_bodies[handle].recompute_mass_properties_from_colliders(self.world.colliders)
        if body.free and any(force := forces_on(self.job, body)):
            self.world.rigid_bodies[handle].add_force(force)  # Rapier keeps it
        return handle

    def collider(self, piece: Piece, number: int) -> Any:
        if piece.kind == "plane":
            shape = self.rapier.Collider.halfspace(rotate(piece.rotation, (0.0, 0.0, 1.0)))
            shape = shape.position(self.isometry(piece.centre, (1.0, 0.0, 0.0, 0.0)))
        else:
            shape = self.shape(piece).position(self.isometry(piece.centre, upright(piece).rotation))
        shape = shape.density(0.0).friction(self.friction).restitution(self.restitution)
        return (
            shape.user_data(number).active_hooks(self.rapier.ActiveHooks.MODIFY_SOLVER_CONTACTS)
            if self.hooked
            else shape
        )

    def shape(self, piece: Piece) -> Any:
        collider = self.rapier.Collider
        if piece.kind == "box":
            return collider.cuboid(*piece.size)
        if piece.kind == "sphere":
            return collider.ball(piece.size[0])
        if piece.kind == "hull":
            return collider.convex_hull(piece.corners)
        if piece.kind == "surface":
            return collider.trimesh(piece.corners, piece.faces)
        return (collider.cylinder if piece.kind == "cylinder" else collider.capsule_y)(piece.size[2], piece.size[0])

    def step(self, dt: float, count: int) -> None:
        self.world.integration_parameters.dt = dt
        for _ in range(count):
            self.world.step()

    def state(self, number: int) -> State:
        body = self.world.rigid_bodies[self.handles[number]]
        turn = body.rotation
        return State(xyz(body.center_of_mass), xyz(body.linvel), (turn.w, turn.i, turn.j, turn.k), xyz(body.angvel))

    def held(self, number: int) -> Held:
        body = self.world.rigid_bodies[self.handles[number]]
        return Held(
            float(body.mass),
            xyz(body.mass_properties.principal_inertia),
            self.friction,
            self.restitution,
            float(body.linear_damping),
            float(body.angular_damping),
        )

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.ties.held()

    def gravity(self) -> Vector:
        return xyz(self.world.gravity)


class Rapier(RigidEngine):
    name, title = "rapier", "Rapier"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint")
    joint_kinds, joint_laws = KINDS, LAWS
    presets = ("stiff-contact", "SIMPLIFIED", "COULOMB", *REDUCED)
    preset_settings = {
        "stiff-contact": {"contact_natural_frequency": 1000.0, "static_contact_natural_frequency": 1000.0}
    }
    preset_words = {
        "stiff-contact": '"Higher values make the constraint stiffer and resolve constraint violations more quickly" '
        "(Rapier, dynamics/integration_parameters.rs)",
        "SIMPLIFIED": '"significantly faster to solve than Self::Coulomb but less accurate" (Rapier, '
        "dynamics/integration_parameters.rs)",
        "COULOMB": '"one Coulomb friction constraint per contact point" (Rapier, dynamics/integration_parameters.rs)',
    }
    settings = SHARED_SETTINGS | WORLD_SETTINGS | {"gyroscopic_forces": "true (Rapier's default) or false"}
    precision = "single"
    moves_bodies = True
    dented_meshes = ("fixed", "prescribed")
    default_step = 1.0 / 60.0  # Rapier's own

    def version(self) -> str:
        return version("rapier3d")

    def library(self) -> Path | None:
        return file_of("rapier3d", lambda name: name.endswith(".so"))

    def refuse(self, job: Job) -> str:
        if not isinstance(job.settings.get("gyroscopic_forces", True), bool):
            return "rapier: the setting gyroscopic_forces is true or false"
        if job.preset in REDUCED and (why := self.refuse_reduced(job)):
            return why
        for body in job.bodies:
            turn = norm(vector(body["angular_velocity"])) * self.wanted_step(job)
            if body["motion"] == "free" and turn > FASTEST_TURN:
                return f"{body['name']} turns by {turn:.3g} rad a step, and Rapier slows down a spin above pi/4 a step"
        return ""

    def refuse_reduced(self, job: Job) -> str:
        bodies = bodies_of(job)
        joints = joints_of(job, bodies)
        if not joints:
            return f"the preset {job.preset} is of joints, and the scene has none"
        for joint in tree_of(bodies, joints)[1]:
            return f"{joint.name} closes a loop, and a multibody of Rapier has none"
        moving = [body.name for body in bodies if norm(body.velocity) + norm(body.spin) > 0.0]
        return f"a multibody of Rapier starts at rest, and {moving[0]} moves" if moving else ""

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        import rapier3d  # here, because --info and --check need no engine

        return RapierWorld(rapier3d, job, bodies, dt)


if __name__ == "__main__":
    sys.exit(serve(Rapier(), sys.argv[1:]))
