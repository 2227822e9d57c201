# SPDX-License-Identifier: BSD-3-Clause
"""What all engines of rigid bodies share: the bodies of a job, why some are refused, the step loop and the rows of the
trajectory.

An engine works in the body's principal frame: `Body.frame` turns that frame into the world's at the start. Masses and
principal moments are the job's, never those of the shapes; the shapes are for contact alone."""

from __future__ import annotations

import math
import time
from abc import abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from joints import refuse_joints
from contract import BODY_COLUMNS, Diverged, Engine, Job, Outcome, Row, write_trajectory
from mesh import Face, is_convex, read_mesh
from rotation import (
    IDENTITY,
    Quaternion,
    Vector,
    add,
    between,
    conjugate,
    norm,
    normalised,
    product,
    quaternion,
    rotate_back,
    scaled,
    subtract,
    vector,
)


LARGEST = 1e30  # m, m/s or rad/s: what is beyond has diverged, though it still has a number


class Piece(NamedTuple):
    """A part of a body's surface, in its principal frame."""

    kind: str  # box | sphere | plane | cylinder | capsule | hull: convex | surface: triangles of any shape
    centre: Vector  # from the body's centre of mass [m]
    # piece to principal frame; a plane's outward normal and the axis of a cylinder or capsule are its z axis
    rotation: Quaternion
    # half lengths of a box; radius of a sphere in x; radius of a cylinder or capsule in x, half its straight part in z
    # [m]
    size: Vector
    corners: tuple[Vector, ...] = ()  # of a hull or surface, from `centre` in the piece's axes [m]
    faces: tuple[Face, ...] = ()  # their triangles, counter-clockwise seen from outside


def upright(piece: Piece) -> Piece:
    """The piece with the axis of a cylinder or capsule along y, as some engines have it."""
    y_to_z = between((0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    return piece._replace(rotation=product(piece.rotation, y_to_z)) if piece.kind in ("cylinder", "capsule") else piece


@dataclass(frozen=True)
class Body:
    name: str
    index: int  # row of the trajectory
    free: bool  # else fixed, or moved at its velocity
    mass: float  # [kg]
    centre: Vector  # centre of mass at the start [m]
    frame: Quaternion  # principal to world axes at the start
    inertia: Vector  # principal moments [kg m2]
    velocity: Vector  # [m/s]; of a moved body that of the plane, for ever
    spin: Vector  # angular velocity in the world frame [rad/s]
    pieces: tuple[Piece, ...]  # empty where nothing can be touched
    material: str = ""


def moves(body: Body) -> bool:
    """Whether it is prescribed: it goes on at its velocity, whatever it meets."""
    return not body.free and body.velocity != (0.0, 0.0, 0.0)


class State(NamedTuple):
    """Of one body. The orientation turns the principal frame into the world's."""

    centre: Vector  # [m]
    velocity: Vector  # [m/s]
    orientation: Quaternion
    spin: Vector  # world frame [rad/s]


class Held(NamedTuple):
    """A body as the engine itself holds it."""

    mass: float  # [kg]
    inertia: Vector  # in the order of the principal axes [kg m2]
    friction: float | None = None  # of contact with its like; None where the engine has no such number
    restitution: float | None = None
    linear_damping: float = 0.0
    angular_damping: float = 0.0


class World:
    """An engine's world with the job's bodies in it. Numbers count from 0 in the order of the bodies that were handed
    over."""

    def step(self, dt: float, count: int) -> None:
        """Takes `count` steps of dt [s]."""
        raise NotImplementedError

    def state(self, number: int) -> State:
        raise NotImplementedError

    def held(self, number: int) -> Held:
        raise NotImplementedError

    def gravity(self) -> Vector:
        """[m/s2], as the engine holds it"""
        raise NotImplementedError

    def joint_laws(self) -> list[dict[str, Any]]:
        """name, damping, friction, stiffness, armature of each joint, as the engine itself holds them."""
        return []

    def contacts(self) -> float:
        """Contact points that were worked on, summed over steps; 0 where the engine does not say."""
        return 0.0

    def close(self) -> None:
        """Called once, after the last state was read."""


def _capsule(parts: list[dict[str, Any]]) -> dict[str, Any] | None:
    """The cylinder of a union that is a capsule: balls of its radius lie at both ends of its axis."""
    rods = [part for part in parts if part["kind"] == "cylinder" and "rotation" not in part]
    balls = [part for part in parts if part["kind"] == "sphere"]
    if len(parts) != 3 or len(rods) != 1 or len(balls) != 2:
        return None
    rod = rods[0]
    foot, size = vector(rod["base"]), 1e-9 * float(rod["radius"])
    ends = (foot, add(foot, scaled(float(rod["length"]), vector(rod["axis"]))))
    same = all(abs(float(ball["radius"]) - float(rod["radius"])) <= size for ball in balls)
    met = all(any(norm(subtract(vector(ball["centre"]), end)) <= size for ball in balls) for end in ends)
    return rod if same and met else None


def pieces_of(shape: dict[str, Any], centre: Vector, frame: Quaternion) -> tuple[Piece, ...] | None:
    """@return None for a shape that no pieces are made of, as a difference"""
    if "rotation" in shape:  # the body's centre and axes as they are before the shape is turned
        turn, middle = quaternion(shape["rotation"]), vector(shape["rotation_centre"])
        centre, frame = add(middle, rotate_back(turn, subtract(centre, middle))), product(conjugate(turn), frame)

    def local(x: Vector) -> Vector:
        return rotate_back(frame, subtract(x, centre))

    kind = shape["kind"]
    if kind == "box":
        low, high = vector(shape["min"]), vector(shape["max"])
        return (Piece("box", local(scaled(0.5, add(low, high))), conjugate(frame), scaled(0.5, subtract(high, low))),)
    if kind == "sphere":
        return (Piece("sphere", local(vector(shape["centre"])), IDENTITY, (float(shape["radius"]),) * 3),)
    if kind == "half_space":
        turn = product(conjugate(frame), between((0.0, 0.0, 1.0), vector(shape["normal"])))
        return (Piece("plane", local(vector(shape["point"])), turn, (0.0, 0.0, 0.0)),)
    if kind in ("cylinder", "capsule"):
        axis, half = vector(shape["axis"]), 0.5 * float(shape["length"])
        turn = product(conjugate(frame), between((0.0, 0.0, 1.0), axis))
        return (
            Piece(
                kind,
                local(add(vector(shape["base"]), scaled(half, axis))),
                turn,
                (float(shape["radius"]),) * 2 + (half,),
            ),
        )
    if kind == "mesh":
        mesh = read_mesh(shape["file"], float(shape["scale"]))
        corners = tuple(local(corner) for corner in mesh.corners)
        return (
            Piece(
                "hull" if is_convex(mesh) else "surface",
                (0.0, 0.0, 0.0),
                IDENTITY,
                (0.0, 0.0, 0.0),
                corners,
                mesh.faces,
            ),
        )
    if kind == "union":
        rod = _capsule(shape["of"])
        if rod:
            return pieces_of({**rod, "kind": "capsule"}, centre, frame)
        parts = [pieces_of(part, centre, frame) for part in shape["of"]]
        return None if None in parts else tuple(piece for part in parts for piece in part)  # type: ignore[union-attr]
    return None


def body_of(body: dict[str, Any], touchable: bool) -> Body:
    centre, frame = vector(body["centre"]), quaternion(body["principal_axes"])
    pieces = pieces_of(body["shape"], centre, frame) if touchable else ()
    return Body(
        body["name"],
        int(body["index"]),
        body["motion"] == "free",
        float(body["mass"]),
        centre,
        frame,
        vector(body["principal_inertia"]),
        vector(body["velocity"]),
        vector(body["angular_velocity"]),
        pieces or (),
        body["material"],
    )


def bodies_of(job: Job) -> list[Body]:
    """A body that is alone, or in a scene without contact, gets no surface: it can touch nothing."""
    return [body_of(body, can_touch(job)) for body in job.bodies]


def can_touch(job: Job) -> bool:
    return len(job.bodies) > 1 and job.scene.get("contact") != "none"


def _refuse_body(body: dict[str, Any], engine: str, alone: bool) -> str:
    name = body["name"]
    if body["phase"] != "rigid":
        return f"{engine} is handed rigid bodies only, and {name} is {body['phase']}"
    if body["temperature"] is not None:
        return f"{engine} knows no heat, and {name} has a temperature"
    if body["joins"] or body["joined_to"]:
        return f"bonds between bodies are not handed to {engine}, and {name} has some"
    if body["motion"] == "prescribed" and (body["keyframes"] or any(body["angular_velocity"])):
        return f"of prescribed motions only a constant velocity is handed over, and {name} has keyframes or turns"
    if body["motion"] == "free" and min(body["principal_inertia"]) <= 0.0:
        return f"{engine} needs three principal moments above 0, and {name} has {body['principal_inertia']} kg m2"
    if not alone and pieces_of(body["shape"], (0.0, 0.0, 0.0), IDENTITY) is None:
        return (
            f"{engine} is handed boxes, spheres, cylinders, capsules, meshes, half spaces and unions of them, and "
            f"{name} is a {body['shape']['kind']}"
        )
    if body["motion"] == "free" and body["shape"]["kind"] == "half_space":
        return f"a half space cannot be free, and {name} is"
    return ""


def refuse_scene(job: Job, engine: str) -> str:
    """Why no engine of rigid bodies here runs the job; "" if it can."""
    scene = job.scene
    if scene["mode"] == "paper":
        return f"the paper's forms belong to the particle solver; {engine} has none"
    if any(scene["periodic"]):
        return f"{engine} has no periodic directions"
    if scene["inflows"]:
        return f"{engine} has no inflow"
    if scene["events"]:
        return f"events are not handed to {engine}"
    if any(force["place"] is not None for force in scene.get("forces", ())):
        return f"forces are handed to {engine} at centres of mass only, and one has a place"
    reasons = (_refuse_body(body, engine, not can_touch(job)) for body in job.bodies)
    return next((reason for reason in reasons if reason), "")


def steps_in(interval: float, limit: float) -> int:
    """Number of equal steps, none above `limit`, over an interval [s]."""
    return max(1, math.ceil(interval / limit * (1.0 - 1e-9)))


class RigidEngine(Engine):
    """An engine that takes rigid bodies: a subclass says its own refusals and opens a `World`."""

    title: str  # the vendor's own spelling
    moves_bodies = False  # whether bodies of constant velocity are handed over
    dented_meshes: tuple[
        str, ...
    ] = ()  # motions of the bodies whose meshes need not be convex: fixed, free, prescribed
    preset_settings: dict[str, dict[str, Any]] = {}  # preset -> settings that it stands for; the job's own go before
    joint_kinds: tuple[str, ...] = ()  # kinds of [[joint]] that are handed over
    joint_laws: tuple[str, ...] = ()  # limits, friction, damping, spring, effort, speed, of hinges and sliders
    joints_touch = False  # whether joints are handed over in scenes with contact
    joint_loops = "any"  # kinds that may close a loop; "any" where bodies are not a tree
    default_step: float  # [s], where neither the scene nor the settings say one

    @abstractmethod
    def refuse(self, job: Job) -> str:
        """What this engine alone refuses; the presets, settings and scene have been looked at."""

    @abstractmethod
    def open(self, job: Job, bodies: list[Body], dt: float) -> World:
        """A world with these bodies. @param dt first step [s]"""

    def refuse_meshes(self, job: Job) -> str:
        for body in job.bodies if can_touch(job) else ():
            pieces = pieces_of(body["shape"], (0.0, 0.0, 0.0), IDENTITY) or ()
            if body["motion"] not in self.dented_meshes and any(piece.kind == "surface" for piece in pieces):
                held = f" or {self.dented_meshes[0]}" if self.dented_meshes else ""
                return f"{self.title} is handed meshes that are convex{held}, and {body['name']} has a dent"
        return ""

    def wanted_step(self, job: Job) -> float:
        """[s]: the setting's, else the scene's, else the engine's own."""
        return float(job.settings.get("time_step", job.time_step or self.default_step))

    def refusal(self, job: Job) -> str:
        if job.preset not in self.presets:
            return f"{self.name}: no preset '{job.preset}'; there are {', '.join(self.presets)}"
        unknown = [key for key in job.settings if key not in self.settings]
        if unknown:
            return f"{self.name}: no setting '{unknown[0]}'; there are {', '.join(self.settings)}"
        if not self.wanted_step(job) > 0.0:
            return f"{self.name}: time_step must be above zero"
        moved = [body["name"] for body in job.bodies if body["motion"] == "prescribed"]
        if moved and not self.moves_bodies:
            return f"prescribed motion is not handed to {self.title}, and {moved[0]} has one"
        return refuse_scene(job, self.title) or self.refuse_meshes(job) or self.refuse_ties(job) or self.refuse(job)

    def refuse_ties(self, job: Job) -> str:
        """Joints and springs between bodies that this engine does not have."""
        if job.scene.get("springs") and "spring" not in self.capabilities:
            return f"springs between points are not handed to {self.title}"
        if not job.scene.get("joints"):
            return ""
        if not self.joint_kinds:
            return f"joints are not handed to {self.title}"
        if can_touch(job) and not self.joints_touch:
            return f'joints are handed to {self.title} where nothing touches: write contact = "none"'
        return refuse_joints(job, bodies_of(job), self.title, self.joint_kinds, self.joint_laws, self.joint_loops)

    def run(self, job: Job) -> Outcome:
        began = time.process_time()
        job = replace(job, settings=self.preset_settings.get(job.preset, {}) | job.settings)
        bodies = bodies_of(job)
        limit = self.wanted_step(job)
        first = (
            (job.times[1] - job.times[0]) / steps_in(job.times[1] - job.times[0], limit)
            if len(job.times) > 1
            else limit
        )
        world = self.open(job, bodies, first)
        outcome = Outcome(setup_cpu=time.process_time() - began)
        held = [(body, world.held(k)) for k, body in enumerate(bodies) if body.free]
        outcome.readback = {
            "gravity": list(world.gravity()),
            "time_step": first,
            "precision": self.precision,
            "bodies": [_readback(body, h) for body, h in held],
            "joints": world.joint_laws(),
        }
        outcome.state_hash = write_trajectory(job, BODY_COLUMNS, _rows(job, bodies, world, limit, outcome))
        outcome.pairs = world.contacts()
        world.close()
        return outcome


def _readback(body: Body, held: Held) -> dict[str, Any]:
    return {
        "name": body.name,
        "mass": held.mass,
        "centre": list(body.centre),
        "principal_inertia": list(held.inertia),
        "friction": held.friction,
        "restitution": held.restitution,
        "linear_damping": held.linear_damping,
        "angular_damping": held.angular_damping,
    }


def _rows(job: Job, bodies: list[Body], world: World, limit: float, outcome: Outcome) -> Iterator[Row]:
    """Equal steps, none above `limit` [s], that end at each output time."""
    now = job.times[0]
    for at in job.times:
        if at > now:
            count = steps_in(at - now, limit)
            world.step((at - now) / count, count)
            outcome.steps += count
            now = at
        for number, body in enumerate(bodies):
            yield _row(at, body, world.state(number) if body.free else None)


def _row(at: float, body: Body, state: State | None) -> Row:
    if state is None:
        return [at, body.index, *add(body.centre, scaled(at, body.velocity)), *body.velocity, *IDENTITY, 0.0, 0.0, 0.0]
    if not all(abs(c) < LARGEST for part in state for c in part):  # nor is a number that is none below it
        raise Diverged(f"the state of {body.name} is not finite, or beyond {LARGEST:g}", body.index, at)
    turned = product(normalised(state.orientation), conjugate(body.frame))
    return [at, body.index, *state.centre, *state.velocity, *turned, *state.spin]


MOST_GROWTH = 10.0  # of the logarithm of the energy: at 25 the state is no longer finite


def growth(job: Job, body: dict[str, Any], default_step: float) -> float:
    """What explicit Euler adds to the logarithm of the energy of a free top: (rate of its nutation)^2 dt T [Hairer,
    Lubich & Wanner 2006, I.1]."""
    low, middle, high = body["principal_inertia"]
    rate = norm(vector(body["angular_velocity"])) * math.sqrt(max(0.0, (middle - low) * (high - middle) / (low * high)))
    return rate * rate * (job.time_step or default_step) * (job.times[-1] - job.times[0])


def why_it_grows(job: Job, default_step: float) -> str:
    """Why an engine with explicit Euler's gyroscopic term cannot run the job's free tops to the end; empty = it can."""
    exponent = max((growth(job, body, default_step) for body in job.bodies if body["motion"] == "free"), default=0.0)
    if exponent <= MOST_GROWTH:
        return ""
    return (
        "takes the gyroscopic term from the start of a step, which at this spin, step and length multiplies the "
        "energy by about "
        f"e^{exponent:.0f}, until nothing is finite"
    )


def coulomb(job: Job) -> float:
    """Coefficient of friction of every pair [-], none where the settings say none."""
    return float(job.settings.get("friction", 0.0))


def bounciness(job: Job) -> float:
    """Restitution of every pair [-], none where the settings say none."""
    return float(job.settings.get("restitution", 0.0))


class PairLaws:
    """Friction and restitution by pairs of materials, for engines with the capability contact-pairs."""

    def __init__(self, job: Job) -> None:
        self.common = coulomb(job), bounciness(job)
        self.stated = {
            frozenset(law["materials"]): (law["friction"], law["restitution"]) for law in job.scene.get("contacts", ())
        }

    def of(self, material: str, other: str) -> tuple[float, float]:
        """What no table states of a pair is the setting's."""
        stated = self.stated.get(frozenset((material, other)), (None, None))
        friction, restitution = (common if one is None else float(one) for one, common in zip(stated, self.common))
        return friction, restitution

    def pairs(self, materials: list[str]) -> list[tuple[str, str, float, float]]:
        """The stated laws of these materials: both, friction, restitution."""
        names = list(dict.fromkeys(materials))
        return [
            (a, b, *self.of(a, b)) for k, a in enumerate(names) for b in names[k:] if frozenset((a, b)) in self.stated
        ]


def forces_on(job: Job, body: Body) -> Vector:
    """Sum of the constant forces on a body [N]."""
    total = (0.0, 0.0, 0.0)
    for force in job.scene.get("forces", ()):
        if force["body"] == body.name:
            total = add(total, vector(force["value"]))
    return total


SHARED_SETTINGS = {
    "time_step": "goes before the job's [s]; shortened so that output times are hit exactly",
    "friction": "Coulomb's coefficient of every pair, default 0",
    "restitution": "of every pair, default 0",
}


def body_words(job: Job, body: Body, piece_words: Callable[[Piece], dict[str, Any]]) -> dict[str, Any]:
    """A body as a world in a process of its own reads it, in JSON."""
    return {
        "free": body.free,
        "moves": moves(body),
        "material": body.material,
        "force": forces_on(job, body),
        "mass": body.mass,
        "inertia": body.inertia,
        "centre": body.centre,
        "frame": body.frame,
        "velocity": body.velocity,
        "spin": body.spin,
        "pieces": [piece_words(piece) for piece in body.pieces],
    }
