# SPDX-License-Identifier: BSD-3-Clause
"""Joints of a job ([[joint]]), as engines of rigid bodies take them: the two sides of each in the frames of their
bodies, and the bodies as a tree for engines with reduced coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from contract import Job
from rotation import (
    Quaternion,
    Vector,
    add,
    conjugate,
    cross,
    dot,
    norm,
    product,
    quaternion,
    rotate,
    rotate_back,
    scaled,
    subtract,
    vector,
)

WORLD = -1  # number of a side that no body has
LAWS = ("limits", "restitution", "friction", "damping", "spring", "motor")  # keys beside the kind
AGREE = 1e-9  # to which bodies start with the velocities that a joint allows, of the greatest of them


class Side(NamedTuple):
    """One of the two bodies of a joint."""

    number: int  # of the body, or WORLD
    point: Vector  # of the joint, in the principal frame of the body, or in the world [m]
    frame: Quaternion  # the world's axes at the start, in that frame

    def direction(self, world: Vector) -> Vector:
        """A direction of the world at the start, in the frame of the body."""
        return rotate(self.frame, world)


class Joint(NamedTuple):
    name: str
    kind: str  # hinge | ball | slider | fixed | distance | universal
    one: Side
    other: Side
    place: Vector  # in the world at the start [m]
    other_place: Vector  # the same but for a distance [m]
    axis: Vector  # unit; of the first body where the other has its own
    other_axis: Vector
    limits: tuple[float, float] | None
    restitution: float  # of the limits
    friction: float
    damping: float
    stiffness: float
    rest: float
    effort: float
    speed: float | None

    @property
    def numbers(self) -> tuple[int, int]:
        return self.one.number, self.other.number


def across_of(joint: Joint) -> Vector:
    """Unit vector across the axis, in the world at the start."""
    least = (1.0, 0.0, 0.0) if abs(joint.axis[0]) < 0.6 else (0.0, 1.0, 0.0)
    across = cross(joint.axis, least)
    return scaled(1.0 / norm(across), across)


def _side(bodies: Sequence[Any], name: str, place: Vector) -> Side:
    if name == "world":
        return Side(WORLD, place, (1.0, 0.0, 0.0, 0.0))
    number, body = next((n, body) for n, body in enumerate(bodies) if body.name == name)
    return Side(number, rotate_back(body.frame, subtract(place, body.centre)), conjugate(body.frame))


def joints_of(job: Job, bodies: Sequence[Any]) -> list[Joint]:
    """@param bodies the job's (rigid.Body), in the order of their numbers"""
    made = []
    for given in job.scene.get("joints") or ():
        place = vector(given["place"])
        other = vector(given["other_place"]) if given["other_place"] is not None else place
        axis = vector(given["axis"]) if given["axis"] is not None else (0.0, 0.0, 1.0)
        second = vector(given["other_axis"]) if given["other_axis"] is not None else axis
        spring, motor, limits = given["spring"] or {}, given["motor"] or {}, given["limits"]
        made.append(
            Joint(
                given["name"],
                given["kind"],
                _side(bodies, given["bodies"][0], place),
                _side(bodies, given["bodies"][1], other),
                place,
                other,
                axis,
                second,
                (float(limits[0]), float(limits[1])) if limits else None,
                float(given["restitution"]),
                float(given["friction"]),
                float(given["damping"]),
                float(spring.get("stiffness") or 0.0),
                float(spring.get("rest") or 0.0),
                float(motor.get("effort") or 0.0),
                None if motor.get("speed") is None else float(motor["speed"]),
            )
        )
    return made


def laws_of(joint: Joint) -> list[str]:
    """The keys that the joint has beside its kind: limits, restitution, friction, damping, spring, effort, speed."""
    has = {
        "limits": joint.limits is not None,
        "restitution": joint.restitution > 0.0,
        "friction": joint.friction > 0.0,
        "damping": joint.damping > 0.0,
        "spring": joint.stiffness > 0.0,
        "effort": joint.effort != 0.0,
        "speed": joint.speed is not None,
    }
    return [law for law, there in has.items() if there]


def refuse_joints(
    job: Job, bodies: Sequence[Any], engine: str, kinds: Sequence[str], laws: Sequence[str], loops: str
) -> str:
    """Why the joints of a job are not handed over; "" if they are.

    @param kinds, laws that this engine takes
    @param loops kinds that may close a loop of bodies in reduced coordinates; "any" for free bodies"""
    joints = joints_of(job, bodies)
    for joint in joints:
        if joint.kind not in kinds:
            return f"{engine} is handed no joint of kind {joint.kind}, and {joint.name} is one"
        other = [law for law in laws_of(joint) if law not in laws]
        if other:
            return f"{engine} is handed no {other[0]} of a joint, and {joint.name} has one"
        if _parting(joint, bodies) > AGREE * max(1.0, _fastest(bodies)):
            return f"the velocities at the start break the joint {joint.name}"
    if loops != "any":
        for joint in tree_of(bodies, joints)[1]:
            if joint.kind not in loops.split():
                return f"{joint.name} closes a loop, and {engine} is handed no loop that a {joint.kind} closes"
    return ""


def _fastest(bodies: Sequence[Any]) -> float:
    return max((norm(body.velocity) + norm(body.spin) for body in bodies), default=0.0)


def velocity_at(bodies: Sequence[Any], number: int, place: Vector) -> Vector:
    """Of a point of a body at the start [m/s]."""
    if number == WORLD:
        return (0.0, 0.0, 0.0)
    body = bodies[number]
    return add(body.velocity, cross(body.spin, subtract(place, body.centre)))


def spin_of(bodies: Sequence[Any], number: int) -> Vector:
    return (0.0, 0.0, 0.0) if number == WORLD else bodies[number].spin


def start_rate(joint: Joint, bodies: Sequence[Any]) -> float:
    """Rate of the joint's coordinate at the start [rad/s] or [m/s]."""
    if joint.kind == "slider":
        return dot(_approach(joint, bodies), joint.axis)
    return dot(subtract(spin_of(bodies, joint.one.number), spin_of(bodies, joint.other.number)), joint.axis)


def _approach(joint: Joint, bodies: Sequence[Any]) -> Vector:
    return subtract(
        velocity_at(bodies, joint.one.number, joint.place), velocity_at(bodies, joint.other.number, joint.other_place)
    )


def _parting(joint: Joint, bodies: Sequence[Any]) -> float:
    """Size of the relative velocity at the start that the joint does not allow [m/s] or [rad/s]."""
    way = _approach(joint, bodies)
    turn = subtract(spin_of(bodies, joint.one.number), spin_of(bodies, joint.other.number))
    along = scaled(dot(turn, joint.axis), joint.axis)
    if joint.kind == "distance":
        return abs(dot(way, subtract(joint.place, joint.other_place))) / norm(subtract(joint.place, joint.other_place))
    if joint.kind == "slider":
        return norm(subtract(way, scaled(dot(way, joint.axis), joint.axis))) + norm(turn)
    if joint.kind == "fixed":
        return norm(way) + norm(turn)
    if joint.kind == "universal":
        return norm(way) + abs(dot(turn, cross(joint.axis, joint.other_axis)))
    return norm(way) + (norm(subtract(turn, along)) if joint.kind == "hinge" else 0.0)


class Link(NamedTuple):
    """A free body of a tree: the joint that leads to it, from its parent."""

    number: int
    parent: int  # number of a body that comes before it, or WORLD for the world and all fixed bodies
    joint: Joint | None  # None: it is free of its parent
    sign: float  # of the joint's coordinate: 1 where the first body of the joint is this one


def tree_of(bodies: Sequence[Any], joints: list[Joint]) -> tuple[list[Link], list[Joint]]:
    """The free bodies, parents first, and the joints that close loops. A distance is never part of the tree."""
    links: list[Link] = []
    placed, left = {WORLD}, list(joints)

    def number(side: Side) -> int:
        return side.number if side.number != WORLD and bodies[side.number].free else WORLD

    def grow() -> None:
        found = True
        while found:
            found = False
            for joint in list(left):
                one, other = number(joint.one), number(joint.other)
                if joint.kind == "distance" or (one in placed) == (other in placed):
                    continue
                child, parent, sign = (one, other, 1.0) if other in placed else (other, one, -1.0)
                links.append(Link(child, parent, joint, sign))
                placed.add(child)
                left.remove(joint)
                found = True

    grow()
    for root, body in enumerate(bodies):
        if body.free and root not in placed:
            links.append(Link(root, WORLD, None, 1.0))
            placed.add(root)
            grow()
    return links, left


def springs_of(job: Job, bodies: Sequence[Any]) -> list[tuple[Side, Side, float, float, float]]:
    """Springs between points ([[spring]]): sides, stiffness [N/m], damping [N s/m], length without force [m]."""
    made = []
    for given in job.scene.get("springs") or ():
        point, other = vector(given["point"]), vector(given["other_point"])
        length = norm(subtract(point, other)) if given["length"] is None else float(given["length"])
        made.append(
            (
                _side(bodies, given["body"], point),
                _side(bodies, given["other"], other),
                float(given["stiffness"]),
                float(given["damping"]),
                length,
            )
        )
    return made


def pose_in(bodies: Sequence[Any], parent: int, place: Vector, turn: Quaternion) -> tuple[Vector, Quaternion]:
    """A place and an orientation of the world at the start, in the principal frame of a body."""
    if parent == WORLD:
        return place, turn
    body = bodies[parent]
    return (rotate_back(body.frame, subtract(place, body.centre)), product(conjugate(body.frame), quaternion(turn)))
