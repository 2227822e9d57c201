# SPDX-License-Identifier: BSD-3-Clause
"""Changes that must not change a figure: bystanders far away, and symmetries of nature."""

import copy
import math

import numpy as np
from scenes import box_of, corners, matrix, moved, quaternion, scaled

FAR = 30  # spacings between a scene and its bystander
COLD, MILD, HOT = 250.0, 300.0, 320.0  # [K]
MELTS = 273.15


# --- bystanders: each adds bodies in a cube of `n` spacings whose lower corner is `at`


class Place:
    """Room for a bystander: whole spacings from a corner, as wide as the domain where that is periodic."""

    def __init__(self, case):
        s = case["scene"]
        self.dx, self.gravity = s["spacing"], np.array(s.get("gravity", [0, 0, 0]), float)
        self.periodic = ["xyz".index(p) for p in s.get("periodic", [])]
        low, high = box_of(case)
        level = [a for a in range(3) if a not in self.periodic and self.gravity[a] == 0]
        if not level:
            raise ValueError("no room beside a scene that is periodic in every level direction")
        flown = [b["velocity"] for b in case["body"] if isinstance(b.get("velocity"), list)]
        self.fastest = np.abs([[0.0] * 3, *flown]).max(0)
        self.axis = min(level, key=lambda a: self.fastest[a])  # out of the way
        down = int(np.argmax(np.abs(self.gravity))) if self.gravity.any() else (self.axis + 2) % 3
        self.order = [self.axis, ({0, 1, 2} - {self.axis, down}).pop(), down]
        self.up = -1.0 if self.gravity[down] > 0 else 1.0
        self.corner = np.floor(low / self.dx + 1e-6) * self.dx
        self.corner[self.axis] = (math.ceil(high[self.axis] / self.dx - 1e-6) + FAR) * self.dx
        self.domain = [(s["min"][a], s["max"][a]) if a in self.periodic else None for a in range(3)]
        if "max" in s:
            self.widen(s)

    def widen(self, s):
        """The domain reaches beyond the bystander, and as far as it can fall."""
        fall = 0.5 * np.abs(self.gravity) * s["end_time"] ** 2
        for a in {0, 1, 2} - set(self.periodic):
            room = float(fall[a] + 40 * self.dx)
            s["min"][a], s["max"][a] = s["min"][a] - room, max(s["max"][a], float(self.corner[a])) + room

    def box(self, low, high):
        """From whole spacings: away from the scene, level, and up."""
        ends = np.array([self.corner, self.corner])
        for end, given in zip(ends, (low, high), strict=True):
            for a, n in zip(self.order, given, strict=True):
                end[a] += n * self.dx * (self.up if a == self.order[2] else 1.0)
        ends = np.sort(ends, 0)
        for a, d in enumerate(self.domain):
            if d:
                ends[0, a], ends[1, a] = d
        return {"kind": "box", "min": ends[0].tolist(), "max": ends[1].tolist()}

    def middle(self, low, high):
        b = self.box(low, high)
        return (0.5 * (np.array(b["min"]) + np.array(b["max"]))).tolist()


def warm(case):
    """Where one body has a temperature each needs one: matter of no interest gets one and conducts nothing."""
    for b in case["body"]:
        b.setdefault("temperature", MILD)
    for m in case["material"]:
        m.setdefault("conductivity", 1e-12)
        m.setdefault("heat_capacity", 1000.0)


def is_warm(case):
    return any("temperature" in b for b in case["body"])


def add(case, materials, bodies):
    case["material"] += materials
    case["body"] += bodies
    if is_warm(case):
        warm(case)


def matter(name, **keys):
    return {"name": "bystander " + name, "density": 1000.0, **keys}


def body(name, material, phase, shape, **keys):
    return {"name": "bystander " + name, "material": "bystander " + material, "phase": phase, "shape": shape, **keys}


def ice(case, p):
    heat = {"conductivity": 2.0, "heat_capacity": 2000.0}
    held = {"motion": "fixed"}
    block = body("ice", "ice", "rigid", p.box([0, 0, 0], [3, 3, 3]), **held, temperature=COLD)
    plate = body("plate", "plate", "rigid", p.box([3, 0, 0], [6, 3, 3]), **held, temperature=HOT, temperature_held=True)
    water = matter("ice", **heat, t_melt=MELTS, latent_heat=3e5, solid="rigid")
    add(case, [water, matter("plate", **heat)], [block, plate])


def fixed_sphere(case, p):
    shape = {"kind": "sphere", "centre": p.middle([0, 0, 0], [4, 4, 4]), "radius": 2.0 * p.dx}
    add(
        case,
        [matter("stone")],
        [
            {
                "name": "bystander stone",
                "material": "bystander stone",
                "phase": "rigid",
                "motion": "fixed",
                "shape": shape,
            }
        ],
    )


def pot(p):
    """Walls of four layers, open above, through the whole domain where that is periodic."""
    inner, outer = p.box([0, 0, 0], [6, 6, 13]), p.box([-4, -4, -4], [10, 10, 9])
    for a in p.periodic:
        width = outer["max"][a] - outer["min"][a]
        inner["min"][a], inner["max"][a] = inner["min"][a] - width, inner["max"][a] + width
    return {"kind": "difference", "from": outer, "minus": inner}


def second_liquid(case, p):
    add(
        case,
        [matter("oil", viscosity=1000.0 * p.dx**2 / case["scene"]["end_time"]), matter("pot")],
        [
            {
                "name": "bystander oil",
                "material": "bystander oil",
                "phase": "liquid",
                "shape": p.box([0, 0, 0], [6, 6, 5]),
            },
            {
                "name": "bystander pot",
                "material": "bystander pot",
                "phase": "rigid",
                "motion": "fixed",
                "shape": pot(p),
            },
        ],
    )


def floating_block(case, p):
    if p.order[2] in p.periodic:
        raise ValueError("nothing floats where up is periodic")
    second_liquid(case, p)
    block = {
        "name": "bystander wood",
        "material": "bystander wood",
        "phase": "rigid",
        "shape": p.box([2, 2, 5], [4, 4, 7]),
    }
    add(case, [matter("wood", density=500.0)], [block])


def soft(case, p):
    """A modulus whose waves cross a spacing in a hundredth of the run, and which bears its own weight."""
    wave = (100 * p.dx / case["scene"]["end_time"]) ** 2
    return {"young_modulus": 1000.0 * float(wave + 400 * np.abs(p.gravity).max() * p.dx), "poisson_ratio": 0.3}


def elastic_block(case, p):
    gum = matter("gum", **soft(case, p))
    add(
        case,
        [gum],
        [
            {
                "name": "bystander gum",
                "material": "bystander gum",
                "phase": "elastic",
                "shape": p.box([0, 0, 0], [4, 4, 4]),
            }
        ],
    )


def breaking_block(case, p):
    glass = matter("glass", **soft(case, p), fracture_stretch=1.05)
    held = {
        "name": "bystander holder",
        "material": "bystander glass",
        "phase": "rigid",
        "motion": "fixed",
        "shape": p.box([0, 0, 0], [3, 3, 3]),
    }
    loose = {
        "name": "bystander glass",
        "material": "bystander glass",
        "phase": "elastic",
        "shape": p.box([3, 0, 0], [6, 3, 3]),
    }
    add(case, [glass], [held, {**loose, "joined_to": ["bystander holder"]}])


def heavy_fast_ball(case, p):
    shape = {"kind": "sphere", "centre": p.middle([0, 0, 0], [4, 4, 4]), "radius": 2.0 * p.dx}
    speed = 5.0 * p.dx / case["scene"]["end_time"]
    away = [speed if a == p.axis else 0.0 for a in range(3)]
    lead = matter("lead", density=11340.0)
    add(
        case,
        [lead],
        [{"name": "bystander ball", "material": "bystander lead", "phase": "rigid", "velocity": away, "shape": shape}],
    )


def periodic_side(case, p):
    s = case["scene"]
    if p.axis in p.periodic:
        raise ValueError("periodic already")
    for b in case["body"]:
        faces = corners(b["shape"])[0][p.axis] / p.dx
        if abs(faces - round(faces)) > 1e-6:
            raise ValueError("its bodies lie on lattices of their own, which a periodic direction does not have")
    low, high = box_of(case)
    n = math.ceil((high - low).max() / p.dx) + 4 * FAR
    first = np.floor(low / p.dx) - n
    if "min" not in s:
        way = 1e3 * np.abs(p.gravity) * s["end_time"] ** 2 + p.fastest * s["end_time"]
        s["min"], s["max"] = (first * p.dx - way).tolist(), ((first + 3 * n) * p.dx + way).tolist()
    s["min"][p.axis], s["max"][p.axis] = float(first[p.axis] * p.dx), float((first[p.axis] + 3 * n) * p.dx)
    s["periodic"] = [*s.get("periodic", []), "xyz"[p.axis]]


BYSTANDERS = {
    "ice": ice,
    "fixed-sphere": fixed_sphere,
    "floating-block": floating_block,
    "second-liquid": second_liquid,
    "elastic-block": elastic_block,
    "breaking-block": breaking_block,
    "heavy-ball": heavy_fast_ball,
    "periodic-side": periodic_side,
}


def beside(case, name):
    """The case with a bystander. @raise ValueError where there is no room for it"""
    case = copy.deepcopy(case)
    case["scene"].setdefault("gravity", [0.0, 0.0, 0.0])
    BYSTANDERS[name](case, Place(case))
    return case


# --- symmetries: the changed case, and where a place of the first scene lies in it at a time


def same(x, t):
    return x


def refuse_plane(case):
    if case["scene"].get("dimensions", 3) == 2:
        raise ValueError("it would leave the plane")


def by_matrix(A, turn=None):
    def change(case):
        if not np.allclose(np.abs(A[1]), [0, 1, 0]):
            refuse_plane(case)
        return moved(case, A, turn), lambda x, t: x @ A.T, 1.0

    return change


def turned(angle, axis):
    q = quaternion(axis, angle)
    return by_matrix(matrix(q), q)


def boosted(case):
    s = case["scene"]
    if s.get("periodic") or any("keyframes" in b for b in case["body"]):
        raise ValueError("driven bodies and periodic domains keep their frame")
    refuse_plane(case)
    case = copy.deepcopy(case)
    low, high = box_of(case)
    v = (high - low).max() / s["end_time"] * np.array([0.7, -0.4, 0.2])
    for b in case["body"]:
        if b.get("motion") == "fixed":
            b["motion"] = "prescribed"
        own = b.get("velocity", [0.0, 0.0, 0.0])
        if isinstance(own, dict) and own["kind"] != "cosine":
            raise ValueError("this field of velocities has no mean")
        if isinstance(own, dict):
            b["velocity"] = {**own, "mean": (np.array(own.get("mean", [0, 0, 0])) + v).tolist()}
        else:
            b["velocity"] = (np.array(own) + v).tolist()
    case["scene"].pop("min", None)
    case["scene"].pop("max", None)
    return case, lambda x, t: x + v * t, 1.0


def falling(case):
    if any(b.get("motion", "free") != "free" for b in case["body"]):
        raise ValueError("something is held")
    refuse_plane(case)
    if case["scene"].get("periodic") or any(b.get("phase") == "liquid" for b in case["body"]):
        raise ValueError("gravity presses what is periodic, or is told from the liquid's depth")
    case = copy.deepcopy(case)
    low, high = box_of(case)
    g = 2.0 * (high - low).max() / case["scene"]["end_time"] ** 2 * np.array([0.1, 0.2, -1.0])
    case["scene"]["gravity"] = (np.array(case["scene"].get("gravity", [0, 0, 0])) + g).tolist()
    case["scene"].pop("min", None)
    case["scene"].pop("max", None)
    return case, lambda x, t: x + 0.5 * g * t * t, 1.0


def in_units(length, mass, time):
    def change(case):
        return scaled(case, length, mass, time), lambda x, t: x * length, time

    return change


def renumbered(case):
    case = copy.deepcopy(case)
    case["body"].reverse()
    case["material"].reverse()
    return case, same, 1.0


MIRROR = np.diag([-1.0, 1.0, 1.0])
QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
SYMMETRIES = {
    "mirrored": by_matrix(MIRROR),
    "turned-90": by_matrix(QUARTER),
    "turned-30": turned(math.pi / 6, [0.0, 0.0, 1.0]),
    "turned-oblique": turned(0.8, [1.0, 2.0, 3.0]),
    "boosted": boosted,
    "free-fall": falling,
    "froude": in_units(3.0, 27.0, math.sqrt(3.0)),
    "units": in_units(1e3, 1e3, 1e3),
    "renumbered": renumbered,
}
