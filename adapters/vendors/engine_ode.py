# SPDX-License-Identifier: BSD-3-Clause
"""ODE (BSD-3-Clause or LGPL-2.1+), Debian's library in double precision: rigid bodies, contact joints.

Presets are its two steppers by name."""

from __future__ import annotations

import os
import sys
from ctypes import byref, c_double, c_int, sizeof
from pathlib import Path
from typing import Any

from contract import Job, serve
from ode_joints import KINDS, LAWS, Ties
from ode_library import APPROX_1, BOUNCE, Contact, Mass, Near, load, reals
from rigid import (
    SHARED_SETTINGS,
    Body,
    Held,
    PairLaws,
    Piece,
    RigidEngine,
    State,
    World,
    bounciness,
    coulomb,
    forces_on,
    moves,
)
from rotation import Vector, add, dot, product, quaternion, rotate, vector

MOST_CONTACTS = 64  # of a pair of surfaces; a box meets a box in 8 at most


def plane_of(body: Body, piece: Piece) -> tuple[Vector, float]:
    """Unit normal n and offset d of the plane n.x = d in the world [m]."""
    normal = rotate(product(body.frame, piece.rotation), (0.0, 0.0, 1.0))
    return normal, dot(normal, add(body.centre, rotate(body.frame, piece.centre)))


class OdeWorld(World):
    def __init__(self, ode: Any, job: Job, bodies: list[Body]) -> None:
        self.ode = ode
        self.world = ode.dWorldCreate()
        ode.dWorldSetGravity(self.world, *vector(job.scene["gravity"]))
        for key, function in (("erp", ode.dWorldSetERP), ("cfm", ode.dWorldSetCFM)):
            if key in job.settings:
                function(self.world, float(job.settings[key]))
        if "iterations" in job.settings:
            ode.dWorldSetQuickStepNumIterations(self.world, int(job.settings["iterations"]))
        self.advance = getattr(ode, job.preset)
        self.space = ode.dHashSpaceCreate(None)
        self.joints = ode.dJointGroupCreate(0)
        self.mu = coulomb(job)
        self.bounce = float(job.settings.get("bounce", bounciness(job)))
        self.bounce_vel = float(job.settings.get("bounce_vel", 0.0))
        self.laws = PairLaws(job)
        self.materials: dict[int, str] = {}  # geom -> material
        self.meshes: list[Any] = []  # corners and triangles that ODE reads, and does not copy
        self.touched = 0
        self.found = (Contact * MOST_CONTACTS)()
        self.near = Near(self.meet)
        gyroscopic = int(job.settings.get("gyroscopic", True))
        self.finite = int(job.settings.get("finite_rotation", False))
        self.bodies = {number: self.add_free(body, gyroscopic) for number, body in enumerate(bodies) if body.free}
        self.pushed = [
            (self.bodies[number], force)
            for number, body in enumerate(bodies)
            if body.free and any(force := forces_on(job, body))
        ]
        self.ties = Ties(ode, self.world, job, bodies, self.bodies)
        self.surfaces = sum(len(body.pieces) for body in bodies)
        for body in bodies:
            if moves(body):
                self.add_moved(body)
            elif not body.free:
                self.add_fixed(body)

    def add_free(self, body: Body, gyroscopic: int) -> Any:
        ode, handle, mass = self.ode, self.ode.dBodyCreate(self.world), Mass()
        ode.dMassSetParameters(byref(mass), body.mass, 0.0, 0.0, 0.0, *body.inertia, 0.0, 0.0, 0.0)
        ode.dBodySetMass(handle, byref(mass))
        ode.dBodySetPosition(handle, *body.centre)
        ode.dBodySetQuaternion(handle, reals(body.frame))
        ode.dBodySetLinearVel(handle, *body.velocity)
        ode.dBodySetAngularVel(handle, *body.spin)
        ode.dBodySetGyroscopicMode(handle, gyroscopic)
        ode.dBodySetFiniteRotationMode(handle, self.finite)
        self.cover(handle, body)
        return handle

    def cover(self, handle: Any, body: Body) -> None:
        """Gives a body of ODE its surface."""
        ode = self.ode
        for piece in body.pieces:
            geom = self.geom(piece, body)
            ode.dGeomSetBody(geom, handle)
            ode.dGeomSetOffsetPosition(geom, *piece.centre)
            ode.dGeomSetOffsetQuaternion(geom, reals(piece.rotation))

    def add_moved(self, body: Body) -> None:
        """A kinematic body goes on at its velocity, and contacts see it."""
        handle = self.ode.dBodyCreate(self.world)
        self.ode.dBodySetPosition(handle, *body.centre)
        self.ode.dBodySetQuaternion(handle, reals(body.frame))
        self.ode.dBodySetKinematic(handle)
        self.ode.dBodySetLinearVel(handle, *body.velocity)
        self.cover(handle, body)

    def add_fixed(self, body: Body) -> None:
        for piece in body.pieces:
            if piece.kind == "plane":
                normal, offset = plane_of(body, piece)
                self.materials[self.ode.dCreatePlane(self.space, *normal, offset)] = body.material
                continue
            geom = self.geom(piece, body)
            self.ode.dGeomSetPosition(geom, *add(body.centre, rotate(body.frame, piece.centre)))
            self.ode.dGeomSetQuaternion(geom, reals(product(body.frame, piece.rotation)))

    def geom(self, piece: Piece, body: Body) -> Any:
        if piece.kind == "box":
            made = self.ode.dCreateBox(self.space, *(2.0 * half for half in piece.size))
        elif piece.kind == "sphere":
            made = self.ode.dCreateSphere(self.space, piece.size[0])
        elif piece.kind in ("hull", "surface"):
            made = self.mesh(piece)
        else:
            rod = self.ode.dCreateCylinder if piece.kind == "cylinder" else self.ode.dCreateCapsule
            made = rod(self.space, piece.size[0], 2.0 * piece.size[2])
        self.materials[made] = body.material
        return made

    def mesh(self, piece: Piece) -> Any:
        corners = (c_double * (3 * len(piece.corners)))(*(c for corner in piece.corners for c in corner))
        faces = (c_int * (3 * len(piece.faces)))(*(k for face in piece.faces for k in face))
        self.meshes += [corners, faces]
        data = self.ode.dGeomTriMeshDataCreate()
        self.ode.dGeomTriMeshDataBuildDouble(data, corners, 24, len(piece.corners), faces, len(faces), 12)
        return self.ode.dCreateTriMesh(self.space, data, None, None, None)

    def meet(self, _: Any, first: Any, second: Any) -> None:
        """Makes a contact joint for each point where two surfaces touch; two fixed ones, or two of one body, do not."""
        ode = self.ode
        one, other = ode.dGeomGetBody(first), ode.dGeomGetBody(second)
        if one == other:
            return
        count = ode.dCollide(first, second, MOST_CONTACTS, byref(self.found[0].geom), sizeof(Contact))
        mu, bounce = self.mu, self.bounce
        if self.laws.stated:
            mu, bounce = self.laws.of(self.materials[first], self.materials[second])
        for contact in self.found[:count]:
            surface = contact.surface
            surface.mode = APPROX_1 | (BOUNCE if bounce > 0.0 else 0)
            surface.mu, surface.bounce, surface.bounce_vel = mu, bounce, self.bounce_vel
            joint = ode.dJointCreateContact(self.world, self.joints, byref(contact))
            ode.dJointAttach(joint, ode.dGeomGetBody(contact.geom.g1), ode.dGeomGetBody(contact.geom.g2))
        self.touched += count

    def step(self, dt: float, count: int) -> None:
        for _ in range(count):
            if self.surfaces:
                self.ode.dSpaceCollide(self.space, None, self.near)
            for handle, force in self.pushed:  # ODE forgets forces after each step
                self.ode.dBodyAddForce(handle, *force)
            self.ties.push()
            self.advance(self.world, dt)
            self.ode.dJointGroupEmpty(self.joints)

    def state(self, number: int) -> State:
        ode, handle = self.ode, self.bodies[number]
        return State(
            vector(ode.dBodyGetPosition(handle)[0:3]),
            vector(ode.dBodyGetLinearVel(handle)[0:3]),
            quaternion(ode.dBodyGetQuaternion(handle)[0:4]),
            vector(ode.dBodyGetAngularVel(handle)[0:3]),
        )

    def held(self, number: int) -> Held:
        handle, mass = self.bodies[number], Mass()
        self.ode.dBodyGetMass(handle, byref(mass))
        return Held(
            mass.mass,
            (mass.inertia[0], mass.inertia[5], mass.inertia[10]),
            self.mu,
            self.bounce,
            self.ode.dBodyGetLinearDamping(handle),
            self.ode.dBodyGetAngularDamping(handle),
        )

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.ties.held()

    def gravity(self) -> Vector:
        found = reals((0.0,) * 4)
        self.ode.dWorldGetGravity(self.world, found)
        return vector(found[0:3])

    def contacts(self) -> float:
        return float(self.touched)


class Ode(RigidEngine):
    name, title = "ode", "ODE"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint")
    joint_kinds, joint_laws = KINDS, LAWS
    presets = ("dWorldStep", "dWorldQuickStep")
    settings = SHARED_SETTINGS | {
        "gyroscopic": "gyroscopic term, true (ODE's default) or false",
        "finite_rotation": "orientation by a finite rotation, true or false (ODE's default: an infinitesimal one)",
        "bounce": "ODE's word for restitution, which it goes before",
        "bounce_vel": "slower hits than this do not bounce, default 0 [m/s]",
        "erp": "share of an error that a step removes, ODE's default 0.2",
        "cfm": "constraint force mixing, ODE's default 1e-10",
        "iterations": "of dWorldQuickStep, ODE's default 20",
    }
    moves_bodies = True
    dented_meshes = ("fixed", "free", "prescribed")
    default_step = 1.0 / 240.0  # ours: ODE has none

    def version(self) -> str:
        return os.environ.get("TRIPOINT_ENGINE_VERSION", "")

    def library(self) -> Path | None:
        return Path(os.environ.get("TRIPOINT_ENGINE_FOLDER", "")) / "usr/lib/x86_64-linux-gnu/libode.so.8"

    def refuse(self, job: Job) -> str:
        for key in ("gyroscopic", "finite_rotation"):
            if not isinstance(job.settings.get(key, True), bool):
                return f"ode: the setting {key} is true or false"
        return ""

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        return OdeWorld(load(self.library().parent), job, bodies)


if __name__ == "__main__":
    sys.exit(serve(Ode(), sys.argv[1:]))
