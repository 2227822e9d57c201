# SPDX-License-Identifier: BSD-3-Clause
"""DART (BSD-2-Clause), its wheel in double precision: free joints with semi-implicit Euler, contacts by its default
solver.

Presets are its collision detectors: `default` is FCL, which makes a cylinder a coarse mesh and has no capsule; Bullet's
has both."""

from __future__ import annotations

import math
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

from contract import Job, file_of, serve
from dart_joints import KINDS, LAWS, LOOPS, Ties
from joints import WORLD
from pair_fit import by_least, stated_friction
from rigid import (
    SHARED_SETTINGS,
    Body,
    Held,
    Piece,
    RigidEngine,
    State,
    World,
    bounciness,
    coulomb,
    forces_on,
    pieces_of,
    why_it_grows,
)
from rotation import IDENTITY, Quaternion, Vector, quaternion, rotate, vector


def matrix_of(q: Quaternion) -> list[list[float]]:
    """The rotation as a matrix: its columns are the turned axes."""
    columns = [rotate(q, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    return [[columns[c][r] for c in range(3)] for r in range(3)]


class DartWorld(World):
    def __init__(self, dart: Any, job: Job, bodies: list[Body], dt: float) -> None:
        import numpy as np

        self.dart, self.np = dart, np
        self.world = dart.simulation.World()
        self.world.setTimeStep(dt)
        if job.preset != "default":
            self.world.getConstraintSolver().setCollisionDetector(getattr(dart.collision, job.preset)())
        self.world.setGravity(np.array(job.scene["gravity"]))
        self.friction = coulomb(job)
        self.restitution = math.sqrt(bounciness(job))  # a pair's value is the product of both
        self.mu = by_least(stated_friction(job, [body.material for body in bodies])) or {}
        self.ties = Ties(job, bodies, self.transform)
        self.nodes: dict[int, Any] = {}
        for number, body in enumerate(bodies):
            if number not in self.ties.tree or not body.free:
                self.nodes[number] = self.add(body)
        self.add_trees(bodies)
        forces = [(self.nodes[number], forces_on(job, body)) for number, body in enumerate(bodies) if body.free]
        self.pushed = [(node, np.array(force)) for node, force in forces if any(force)]

    def transform(self, at: Vector, turn: Quaternion) -> Any:
        whole = self.dart.math.Isometry3()
        whole.set_rotation(self.np.array(matrix_of(turn)))
        whole.set_translation(self.np.array(at))
        return whole

    def add_trees(self, bodies: list[Body]) -> None:
        """Bodies that joints hold: a skeleton for each that is free of the others or hangs on the world."""
        skeletons: dict[int, Any] = {}
        for link in self.ties.links:
            number = link.number
            if number not in self.ties.tree:
                continue
            fresh = link.parent == WORLD
            skeleton = skeletons[number] = (
                self.dart.dynamics.Skeleton(f"body {bodies[number].index}") if fresh else skeletons[link.parent]
            )
            if link.joint is None:
                self.nodes[number] = self.add_free(skeleton, bodies[number])
            else:
                self.nodes[number] = self.ties.add(skeleton, link, self.nodes)
                self.give_mass(self.nodes[number], bodies[number])
        for skeleton in dict.fromkeys(skeletons.values()):
            self.world.addSkeleton(skeleton)

    def give_mass(self, node: Any, body: Body) -> None:
        node.setInertia(self.dart.dynamics.Inertia(body.mass, self.np.zeros(3), self.np.diag(body.inertia)))

    def add_free(self, skeleton: Any, body: Body) -> Any:
        joint, node = skeleton.createFreeJointAndBodyNodePair()
        self.give_mass(node, body)
        joint.setTransform(self.transform(body.centre, body.frame))
        joint.setLinearVelocity(self.np.array(body.velocity))
        joint.setAngularVelocity(self.np.array(body.spin))
        return node

    def add(self, body: Body) -> Any:
        skeleton = self.dart.dynamics.Skeleton(f"body {body.index}")
        if body.free:
            node = self.add_free(skeleton, body)
        else:
            joint, node = skeleton.createWeldJointAndBodyNodePair()
            joint.setTransformFromParentBodyNode(self.transform(body.centre, body.frame))
        for piece in body.pieces:
            self.surface(node, piece, body.material)
        self.world.addSkeleton(skeleton)
        return node

    def surface(self, node: Any, piece: Piece, material: str) -> None:
        np, dynamics = self.np, self.dart.dynamics
        if piece.kind == "box":
            shape = dynamics.BoxShape(np.array([2.0 * half for half in piece.size]))
        elif piece.kind == "sphere":
            shape = dynamics.SphereShape(piece.size[0])
        else:
            rod = dynamics.CylinderShape if piece.kind == "cylinder" else dynamics.CapsuleShape
            shape = rod(piece.size[0], 2.0 * piece.size[2])
        held = node.createShapeNode(shape)
        held.setRelativeTransform(self.transform(piece.centre, piece.rotation))
        held.createCollisionAspect()
        held.createDynamicsAspect()
        aspect = held.getDynamicsAspect()
        aspect.setFrictionCoeff(self.mu.get(material, self.friction))
        aspect.setRestitutionCoeff(self.restitution)

    def step(self, dt: float, count: int) -> None:
        self.world.setTimeStep(dt)
        for _ in range(count):
            for node, force in self.pushed:  # DART forgets forces after each step
                node.addExtForce(force, self.np.zeros(3), False, True)
            self.ties.push()
            self.world.step()

    def state(self, number: int) -> State:
        node = self.nodes[number]
        place = node.getWorldTransform()
        turn = quaternion(place.quaternion().wxyz())
        return State(
            vector(place.translation()), vector(node.getLinearVelocity()), turn, vector(node.getAngularVelocity())
        )

    def held(self, number: int) -> Held:
        inertia = self.nodes[number].getInertia()
        moment = inertia.getMoment()
        return Held(
            float(inertia.getMass()),
            (float(moment[0][0]), float(moment[1][1]), float(moment[2][2])),
            self.friction,
            self.restitution * self.restitution,
        )

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.ties.held()

    def gravity(self) -> Vector:
        return vector(self.world.getGravity())


class Dart(RigidEngine):
    name, title = "dart", "DART"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint")
    joint_kinds, joint_laws, joint_loops = KINDS, LAWS, LOOPS
    presets = ("BulletCollisionDetector", "default")
    settings = SHARED_SETTINGS
    default_step = 0.001  # DART's own

    def version(self) -> str:
        return version("dartpy")

    def library(self) -> Path | None:
        return file_of("dartpy", lambda name: name.startswith("dartpy") and name.endswith(".so"))

    def refuse(self, job: Job) -> str:
        grows = why_it_grows(job, self.default_step)
        if grows:
            return "DART " + grows
        if by_least(stated_friction(job, [body["material"] for body in job.bodies])) is None:
            return (
                "DART takes the smaller friction of two surfaces, and no numbers of the materials give what is "
                "stated of their pairs"
            )
        if len({bounciness(job)} | {law["restitution"] or 0.0 for law in job.scene.get("contacts", ())}) > 1:
            return "one restitution is handed to all pairs of DART, and the scene states several"
        for body in job.bodies:
            kinds = {
                piece.kind for piece in pieces_of(body["shape"], (0.0, 0.0, 0.0), IDENTITY) or () if len(job.bodies) > 1
            }
            if "plane" in kinds:
                return f"half spaces are not handed to DART, and {body['name']} has one"
            if "hull" in kinds:
                return f"DART's wheel has no shape that is made of corners, and {body['name']} is a mesh"
            if job.preset == "default" and "capsule" in kinds:
                return (
                    f"DART's default detector knows no capsule, and {body['name']} is one; its "
                    "BulletCollisionDetector does"
                )
        return ""

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        import dartpy  # here, because --info and --check need no engine

        return DartWorld(dartpy, job, bodies, dt)


if __name__ == "__main__":
    sys.exit(serve(Dart(), sys.argv[1:]))
