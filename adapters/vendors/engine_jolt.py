# SPDX-License-Identifier: BSD-3-Clause
"""Jolt Physics (MIT), the npm package jolt-physics on node, in single precision: rigid bodies, contacts.

The gyroscopic term is off by default in Jolt; the preset `mApplyGyroscopicForce` is its switch of that name.
`many-iterations` has the term too, more iterations of its solver, and small tolerances of contact."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from contract import Job, serve
from joints import Joint, across_of, joints_of
from rigid import (
    SHARED_SETTINGS,
    Body,
    Held,
    PairLaws,
    Piece,
    RigidEngine,
    State,
    World,
    body_words,
    bounciness,
    can_touch,
    coulomb,
    upright,
)
from rotation import Vector, dot, quaternion, rotate, vector

WORLD_SETTINGS = {  # members of PhysicsSettings, in Jolt's words
    "mNumVelocitySteps": "Jolt's default 10",
    "mNumPositionSteps": "Jolt's default 2",
    "mBaumgarte": "Jolt's default 0.2",
    "mPenetrationSlop": "Jolt's default 0.02 [m]",
    "mSpeculativeContactDistance": "Jolt's default 0.02 [m]",
    "mMinVelocityForRestitution": "slower hits than this do not bounce, Jolt's default 1 [m/s]",
}


def piece_words(piece: Piece) -> dict[str, Any]:
    if piece.kind == "plane":
        normal = rotate(piece.rotation, (0.0, 0.0, 1.0))
        return {"kind": "plane", "normal": normal, "constant": -dot(normal, piece.centre)}
    return upright(piece)._asdict()


def joint_words(joint: Joint) -> dict[str, Any]:
    return {**joint._asdict(), "numbers": joint.numbers, "across": across_of(joint)}


class JoltWorld(World):
    """Lives in a process of node, which ends with its stdin."""

    def __init__(self, package: Path, job: Job, bodies: list[Body]) -> None:
        program = str(Path(__file__).resolve().parent / "jolt_world.mjs")
        self.node = subprocess.Popen(
            ["node", program, str(package)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        scene = {
            "gravity": job.scene["gravity"],
            "gyroscopic": job.preset != "default",
            "friction": coulomb(job),
            "restitution": bounciness(job),
            "rounded": float(job.settings.get("mConvexRadius", 0.05)),
            "touches": can_touch(job),
            "joints": [joint_words(joint) for joint in joints_of(job, bodies)],
            "bodies": [body_words(job, body, piece_words) for body in bodies],
            "laws": PairLaws(job).pairs([body.material for body in bodies]),
            "settings": {key: job.settings[key] for key in WORLD_SETTINGS if key in job.settings},
        }
        self.opened = self.ask({"open": scene})
        self.states = self.opened["states"]
        free = [number for number, body in enumerate(bodies) if body.free]
        self.rows = {number: row for row, number in enumerate(free)}

    def ask(self, call: dict[str, Any]) -> Any:
        """@raise RuntimeError with what Jolt or node said"""
        assert self.node.stdin and self.node.stdout
        self.node.stdin.write(json.dumps(call) + "\n")
        self.node.stdin.flush()
        line = self.node.stdout.readline()
        if not line:
            raise RuntimeError(f"node ended with code {self.node.wait()}")
        answer = json.loads(line)
        if isinstance(answer, dict) and "error" in answer:
            raise RuntimeError(f"Jolt: {answer['error']}")
        return answer

    def step(self, dt: float, count: int) -> None:
        self.states = self.ask({"step": [dt, count]})

    def state(self, number: int) -> State:
        s = [float(c) for c in self.states[self.rows[number]]]  # "NaN" and "Infinity" are texts there
        return State(vector(s[0:3]), vector(s[3:6]), quaternion(s[6:10]), vector(s[10:13]))

    def held(self, number: int) -> Held:
        held = self.opened["bodies"][self.rows[number]]
        return Held(
            held["mass"],
            vector(held["inertia"]),
            held["friction"],
            held["restitution"],
            held["linear_damping"],
            held["angular_damping"],
        )

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.opened.get("joints", [])

    def gravity(self) -> Vector:
        return vector(self.opened["gravity"])

    def close(self) -> None:
        assert self.node.stdin
        self.node.stdin.close()
        self.node.wait()


class Jolt(RigidEngine):
    name, title = "jolt", "Jolt"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint")
    joint_kinds = ("hinge", "ball", "slider", "fixed", "distance")
    joint_laws = ("limits", "friction")
    presets = ("many-iterations", "default", "mApplyGyroscopicForce")
    preset_settings = {
        "many-iterations": {
            "mNumVelocitySteps": 50,
            "mNumPositionSteps": 10,
            "mPenetrationSlop": 0.001,
            "mMinVelocityForRestitution": 0.01,
            "mConvexRadius": 0.0,
        }
    }
    preset_words = {
        "default": '"mApplyGyroscopicForce = false" (Jolt, Physics/Body/BodyCreationSettings.h)',
        "mApplyGyroscopicForce": '"Set to indicate that the gyroscopic force should be applied to this body (aka '
        "Dzhanibekov "
        'effect...)" (Jolt, Physics/Body/BodyCreationSettings.h)',
    }
    settings = (
        SHARED_SETTINGS
        | WORLD_SETTINGS
        | {
            "mConvexRadius": "by which edges and corners of boxes are rounded, Jolt's default 0.05 [m]; at most half "
            "the thinnest"
        }
    )
    precision = "single"
    moves_bodies = True
    dented_meshes = ("fixed", "prescribed")
    default_step = 1.0 / 60.0  # of Jolt's own example

    def version(self) -> str:
        return os.environ.get("TRIPOINT_ENGINE_VERSION", "")

    def library(self) -> Path | None:
        return (
            Path(os.environ.get("TRIPOINT_ENGINE_FOLDER", ""))
            / "node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js"
        )

    def refuse(self, job: Job) -> str:
        unions = [body for body in job.bodies if body["shape"]["kind"] == "union"]
        planes = [body["name"] for body in unions if any(part["kind"] == "half_space" for part in body["shape"]["of"])]
        return f"Jolt's half space is a body of its own, and {planes[0]} is a union with one" if planes else ""

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        library = self.library()
        assert library
        return JoltWorld(library, job, bodies)


if __name__ == "__main__":
    sys.exit(serve(Jolt(), sys.argv[1:]))
