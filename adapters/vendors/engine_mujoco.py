# SPDX-License-Identifier: BSD-3-Clause
"""MuJoCo (Apache-2.0), any release from 2.3: rigid bodies, contact by soft constraints.

Presets are its integrators by name, with contacts as they come, and `hard-contact`: implicitfast, with contacts as
stiff as the step allows."""

from __future__ import annotations

import os
import sys
from importlib.metadata import distribution, version
from pathlib import Path
from typing import Any

from contract import Diverged, Job, file_of, serve
from joints import WORLD, Link
from mujoco_joints import KINDS, LAWS, LOOPS, Ties, pose_under, words
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
    why_it_grows,
)
from rotation import IDENTITY, Quaternion, Vector, add, product, quaternion, rotate, vector

os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn here, so no window library is wanted


CONES = ("elliptic", "pyramidal")  # of friction, the first by default


ORIGIN = (0.0, 0.0, 0.0)


def geom_text(name: str, piece: Piece, at: Vector, turn: Quaternion, contact: str) -> str:
    """One geom of the frame whose origin is `at` [m] and whose axes are turned by `turn`."""
    place = (
        f'name="{name}" pos="{words(add(at, rotate(turn, piece.centre)))}" '
        f'quat="{words(product(turn, piece.rotation))}"'
    )
    if piece.kind == "plane":
        return f'<geom type="plane" size="0 0 1" {place} {contact}/>'  # a size of 0 is infinite
    if piece.kind == "hull":
        return f'<geom type="mesh" mesh="{name}" {place} mass="0" {contact}/>'
    size = words(
        {"box": piece.size, "sphere": piece.size[:1]}.get(piece.kind, piece.size[1:])
    )  # of a rod radius and half length
    return f'<geom type="{piece.kind}" size="{size}" {place} mass="0" {contact}/>'


def meshes_text(bodies: list[Body]) -> str:
    """MuJoCo makes the hull of the corners, and moves what it takes for the mesh's centre back when it places a
    geom."""
    text = [
        f'<mesh name="{number}.{k}" vertex="{" ".join(map(words, piece.corners))}"/>'
        for number, body in enumerate(bodies)
        for k, piece in enumerate(body.pieces)
        if piece.kind == "hull"
    ]
    return f"<asset>{''.join(text)}</asset>" if text else ""


def integrator_of(job: Job) -> str:
    return "implicitfast" if job.preset == "hard-contact" else job.preset


def stated_stiffness(job: Job, dt: float) -> str:
    """How stiff contacts are by preset and settings; "" is MuJoCo's default."""
    steps = job.settings.get("timeconst_steps")
    settings = ({"solref": f"{float(steps) * dt!r} 1"} if steps else {}) | job.settings
    return "".join(f' {key}="{settings[key]}"' for key in ("solref", "solimp") if key in settings)


def contact_text(job: Job, dt: float) -> str:
    mu = coulomb(job)
    return f'friction="{mu!r} 0 0" condim="{3 if mu > 0.0 else 1}"{stated_stiffness(job, dt)}'


def pairs_text(job: Job, bodies: list[Body], dt: float) -> str:
    """A pair of geoms for each pair of pieces whose materials state a law; MuJoCo then asks neither geom for its
    own, so that each pair repeats the stiffness."""
    laws = PairLaws(job)
    text = []
    for a, one in enumerate(bodies):
        for b, other in enumerate(bodies[:a]):
            if frozenset((one.material, other.material)) not in laws.stated or not (one.free or other.free):
                continue
            mu, _ = laws.of(one.material, other.material)
            text += [
                f'<pair geom1="{a}.{i}" geom2="{b}.{k}" condim="{3 if mu > 0.0 else 1}" friction="{mu!r} {mu!r} 0 0 '
                f'0"{stated_stiffness(job, dt)}/>'
                for i in range(len(one.pieces))
                for k in range(len(other.pieces))
            ]
    return f"<contact>{''.join(text)}</contact>" if text else ""


def model_text(job: Job, bodies: list[Body], dt: float) -> str:
    """The scene in MJCF: free bodies with the job's own masses and principal moments, fixed ones as geoms of the
    world."""
    contact = contact_text(job, dt)
    gravity = words(vector(job.scene["gravity"]))
    ties = Ties(job, bodies, dt)
    text = [
        f'<mujoco><compiler angle="radian" boundmass="0" boundinertia="0" balanceinertia="false"/>'
        f'<option timestep="{dt!r}" integrator="{integrator_of(job)}" gravity="{gravity}" '
        f'cone="{job.settings.get("cone", CONES[0])}"/>{meshes_text(bodies)}<worldbody>{ties.sites_of(WORLD)}'
    ]
    for number, body in enumerate(bodies):
        if not body.free:
            text.append(fixed_text(number, body, ties, contact))
        elif ties.root(number).parent == WORLD:
            text += free_text(ties.root(number), ties, contact)
    return "".join(text) + f"</worldbody>{pairs_text(job, bodies, dt)}{ties.closing_text()}</mujoco>"


def named_pieces(number: int, body: Body) -> list[tuple[str, Piece]]:
    return [(f"{number}.{k}", piece) for k, piece in enumerate(body.pieces)]


def fixed_text(number: int, body: Body, ties: Ties, contact: str) -> str:
    """Geoms of the world; of a body of its own where a joint holds it, so that the pair can be left out."""
    if not ties.is_tied(number):
        return "".join(
            geom_text(name, piece, body.centre, body.frame, contact) for name, piece in named_pieces(number, body)
        )
    geoms = [geom_text(name, piece, ORIGIN, IDENTITY, contact) for name, piece in named_pieces(number, body)]
    return f'<body name="b{number}" pos="{words(body.centre)}" quat="{words(body.frame)}">{"".join(geoms)}</body>'


def free_text(link: Link, ties: Ties, contact: str) -> list[str]:
    """A body with those that hang on it."""
    body = ties.bodies[link.number]
    centre, frame = pose_under(ties.bodies, link)
    text = [
        f'<body name="b{link.number}" pos="{words(centre)}" quat="{words(frame)}">{ties.joint_text(link)}'
        f'<inertial pos="0 0 0" mass="{body.mass!r}" diaginertia="{words(body.inertia)}"/>{ties.sites_of(link.number)}'
    ]
    text += [geom_text(name, piece, ORIGIN, IDENTITY, contact) for name, piece in named_pieces(link.number, body)]
    for child in ties.children(link.number):
        text += free_text(child, ties, contact)
    return [*text, "</body>"]


class MujocoWorld(World):
    def __init__(self, engine: Any, text: str, job: Job, bodies: list[Body], dt: float) -> None:
        self.engine = engine
        self.model = engine.MjModel.from_xml_string(text)
        self.data = engine.MjData(self.model)
        self.ties = Ties(job, bodies, dt)
        self.ties.start(self.model, self.data)
        self.free = {link.number for link in self.ties.links if link.joint is None}  # whose states are coordinates
        self.ids = {number: self.model.body(f"b{number}").id for number, body in enumerate(bodies) if body.free}
        for number, row in self.ids.items():
            if any(force := forces_on(job, bodies[number])):
                self.data.xfrc_applied[row][0:3] = force
        self.touched = 0.0
        self.time = 0.0  # MuJoCo's own starts again when it begins anew
        self.place()

    def place(self) -> None:
        """Poses and velocities of bodies from coordinates: a step ends without them."""
        if len(self.free) < len(self.ids):
            self.engine.mj_kinematics(self.model, self.data)
            self.engine.mj_comPos(self.model, self.data)
            self.engine.mj_comVel(self.model, self.data)

    def step(self, dt: float, count: int) -> None:
        self.model.opt.timestep = dt
        if self.model.ngeom == 0:
            self.engine.mj_step(self.model, self.data, count)
        else:
            for _ in range(count):
                self.engine.mj_step(self.model, self.data)
                self.touched += self.data.ncon
        self.time += count * dt
        warning = self.engine.mjtWarning
        for kind in (warning.mjWARN_BADQPOS, warning.mjWARN_BADQVEL, warning.mjWARN_BADQACC):
            if self.data.warning[int(kind)].number > 0:  # it has then begun anew from its reference state, at rest
                raise Diverged("MuJoCo found its state not finite or huge, and began anew", 0, self.time)
        self.place()

    def state(self, number: int) -> State:
        row = self.ids[number]
        if number not in self.free:
            import numpy as np

            velocity = np.zeros(6)
            self.engine.mj_objectVelocity(self.model, self.data, self.engine.mjtObj.mjOBJ_BODY, row, velocity, 0)
            return State(
                vector(self.data.xipos[row]),
                vector(velocity[3:6]),
                quaternion(self.data.xquat[row]),
                vector(velocity[0:3]),
            )
        joint = int(self.model.body_jntadr[row])
        at, dof = int(self.model.jnt_qposadr[joint]), int(self.model.jnt_dofadr[joint])
        q, v = self.data.qpos[at : at + 7], self.data.qvel[dof : dof + 6]
        orientation = quaternion(q[3:7])
        return State(vector(q[0:3]), vector(v[0:3]), orientation, rotate(orientation, vector(v[3:6])))

    def held(self, number: int) -> Held:
        body = self.ids[number]
        geom = int(self.model.body_geomadr[body])
        friction = float(self.model.geom_friction[geom][0]) if geom >= 0 else None
        return Held(float(self.model.body_mass[body]), vector(self.model.body_inertia[body]), friction)

    def joint_laws(self) -> list[dict[str, Any]]:
        return self.ties.held(self.model)

    def gravity(self) -> Vector:
        return vector(self.model.opt.gravity)

    def contacts(self) -> float:
        return self.touched


class Mujoco(RigidEngine):
    name, title = "mujoco", "MuJoCo"
    capabilities = ("rigid-free-flight", "gravity", "fixed", "contact", "contact-pairs", "force", "joint", "spring")
    joints_touch = True
    joint_kinds, joint_laws, joint_loops = KINDS, LAWS, LOOPS
    presets = ("hard-contact", "Euler", "implicitfast", "implicit", "RK4")
    preset_settings = {"hard-contact": {"timeconst_steps": 2, "solimp": "0.99 0.999 0.001 0.5 2"}}
    preset_words = {
        "Euler": '"Use Euler for compatibility with older models" (MuJoCo, doc/computation/index.rst)',
        "implicitfast": '"the recommended integrator for most models" (MuJoCo, doc/computation/index.rst)',
        "implicit": '"the implicit integration of Coriolis and centripetal forces, including gyroscopic forces" '
        "(MuJoCo, doc/computation/index.rst)",
        "RK4": '"best for systems which are energy conserving, or almost energy-conserving" '
        "(MuJoCo, doc/computation/index.rst)",
    }
    settings = SHARED_SETTINGS | {
        "solref": "time constant and damping ratio of contacts, MuJoCo's default 0.02 1; "
        "negative: stiffness and damping",
        "timeconst_steps": "time constant of contacts in time steps, at a damping ratio of 1; solref goes before it",
        "cone": "elliptic or pyramidal cones of friction, default elliptic",
        "solimp": "impedance of contacts, MuJoCo's default 0.9 0.95 0.001 0.5 2",
        "joint_solref": "solref of loops, limits and friction of joints, two time steps and 1 by default",
        "joint_solimp": "solimp of loops, MuJoCo's default 0.9 0.95 0.001 0.5 2",
    }
    default_step = 0.002  # MuJoCo's own

    def version(self) -> str:
        return version("mujoco")

    def library(self) -> Path | None:
        held = next((name for name in ("mujoco-core", "mujoco") if _has(name)), "mujoco")
        return file_of(held, lambda name: name.startswith("libmujoco.so"))

    def refuse(self, job: Job) -> str:
        for key in ("solref", "solimp"):
            if key in job.settings and not isinstance(job.settings[key], str):
                return f'mujoco: the setting {key} is a text of numbers, for example "0.02 1"'
        if job.settings.get("cone", CONES[0]) not in CONES:
            return f"mujoco: the setting cone is {' or '.join(CONES)}"
        grows = why_it_grows(job, self.default_step) if job.preset == "Euler" else ""
        if grows:
            return "MuJoCo's Euler " + grows
        bounce = max([bounciness(job), *(law["restitution"] or 0.0 for law in job.scene.get("contacts", ()))])
        if bounce > 0.0 and len(job.bodies) > 1 and "solref" not in job.settings:
            return (
                f"MuJoCo has no coefficient of restitution, and {bounce:g} is asked for; the setting solref makes "
                "contacts springs with a damping"
            )
        return ""

    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        import mujoco  # here, because --info and --check need no engine

        return MujocoWorld(mujoco, model_text(job, bodies, dt), job, bodies, dt)


def _has(name: str) -> bool:
    try:
        return bool(distribution(name).files)
    except ImportError:
        return False


if __name__ == "__main__":
    sys.exit(serve(Mujoco(), sys.argv[1:]))
