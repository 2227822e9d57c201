# SPDX-License-Identifier: BSD-3-Clause
"""Rapier (Apache-2.0) in double precision: its crate rapier3d-f64, built by cargo at the install. Presets are its
friction models.

The world lives in a process of its own, rapier_f64/src/main.rs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from contract import Job, serve
from engine_rapier import WORLD_SETTINGS, Rapier, friction_model
from rapier_joints import REDUCED
from rigid import Body, Held, PairLaws, Piece, State, World, body_words, bounciness, coulomb, upright
from rotation import Vector, quaternion, vector

PROTOCOL = 2  # of rapier_f64/src/main.rs


def piece_words(piece: Piece) -> dict[str, Any]:
    return upright(piece)._asdict()


class DoubleWorld(World):
    """Its process ends with its stdin."""

    def __init__(self, program: Path, job: Job, bodies: list[Body], dt: float) -> None:
        self.process = subprocess.Popen([str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        scene = {
            "gravity": job.scene["gravity"],
            "dt": dt,
            "preset": friction_model(job),
            "friction": coulomb(job),
            "restitution": bounciness(job),
            "gyroscopic": bool(job.settings.get("gyroscopic_forces", True)),
            "bodies": [body_words(job, body, piece_words) for body in bodies],
            "laws": PairLaws(job).pairs([body.material for body in bodies]),
            "settings": {key: job.settings[key] for key in WORLD_SETTINGS if key in job.settings},
        }
        self.opened = self.ask({"open": scene})
        if self.opened.get("protocol") != PROTOCOL:
            raise RuntimeError(
                "rapier_world was built of other sources: run `tripoint engine install rapier-f64` again"
            )
        self.states = self.opened["states"]
        free = [number for number, body in enumerate(bodies) if body.free]
        self.rows = {number: row for row, number in enumerate(free)}

    def ask(self, call: dict[str, Any]) -> Any:
        """@raise RuntimeError where the process has ended"""
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(json.dumps(call) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"rapier_world ended with code {self.process.wait()}")
        return json.loads(line)

    def step(self, dt: float, count: int) -> None:
        self.states = self.ask({"step": [dt, count]})

    def state(self, number: int) -> State:
        s = [float(c) for c in self.states[self.rows[number]]]  # "NaN" is a text there
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

    def gravity(self) -> Vector:
        return vector(self.opened["gravity"])

    def close(self) -> None:
        assert self.process.stdin
        self.process.stdin.close()
        self.process.wait()


class RapierDouble(Rapier):
    name = "rapier-f64"
    capabilities = tuple(word for word in Rapier.capabilities if word != "joint")
    presets = tuple(word for word in Rapier.presets if word not in REDUCED)
    joint_kinds = ()
    precision = "double"

    def version(self) -> str:
        return os.environ.get("TRIPOINT_ENGINE_VERSION", "")

    def library(self) -> Path | None:
        return Path(os.environ.get("TRIPOINT_ENGINE_FOLDER", "")) / "bin/rapier_world"

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        program = self.library()
        assert program
        return DoubleWorld(program, job, bodies, dt)


if __name__ == "__main__":
    sys.exit(serve(RapierDouble(), sys.argv[1:]))
