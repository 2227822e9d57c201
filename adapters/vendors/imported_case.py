# SPDX-License-Identifier: BSD-3-Clause
"""The case file of an imported model (imported_model.py), as text, and the meshes that stand beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement
from typing import Any, Iterable

from imported_model import Link, Model, Part, one_line, plain
from rotation import (
    IDENTITY,
    Quaternion,
    Vector,
    add,
    conjugate,
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

ACROSS = 4  # particles across the thinnest body
LAYERS = 3  # of particles in the slab that stands for a plane
MOST = 60_000  # particles of all bodies
SLAB = 100_000  # of one slab
OTHERS = ("bullet", "ode", "rapier", "jolt", "dart", "drake")


@dataclass
class Choices:
    """What the model does not say."""

    end: float = 1.0  # [s]
    spacing: float = 0.0  # [m]; 0: by the thinnest body
    particles_alone: frozenset[str] = frozenset()  # bodies whose given moments their particles cannot carry


def number(x: float) -> str:
    x = float(f"{float(x):.15g}")
    return "0.0" if abs(x) < 1e-15 else repr(x)


def numbers(values: Iterable[float]) -> str:
    return f"[{', '.join(map(number, values))}]"


def thickness(part: Part) -> float:
    """Its least extent [m]."""
    if part.kind == "box":
        return 2.0 * min(part.size)
    if part.kind == "cylinder":
        return 2.0 * min(part.size)
    if part.kind == "mesh":
        return float(min(part.corners.max(axis=0) - part.corners.min(axis=0)))
    return 2.0 * part.size[0]


def volume(part: Part) -> float:
    """[m3]"""
    size = part.size
    if part.kind == "box":
        return 8.0 * size[0] * size[1] * size[2]
    if part.kind == "sphere":
        return 4.0 / 3.0 * math.pi * size[0] ** 3
    if part.kind == "cylinder":
        return 2.0 * math.pi * size[0] ** 2 * size[1]
    if part.kind == "capsule":
        return math.pi * size[0] ** 2 * (2.0 * size[1] + 4.0 / 3.0 * size[0])
    triangles = ([vector(part.corners[k]) for k in face] for face in part.faces)
    return abs(sum(dot(a, vector_product(b, c)) for a, b, c in triangles)) / 6.0


def vector_product(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def corners(part: Part) -> list[Vector]:
    """Of a box around it, in the world [m]."""
    if part.kind == "mesh":
        local = [vector(corner) for corner in part.corners]
    else:
        r = part.size[0]
        half = {"box": part.size, "sphere": (r, r, r), "cylinder": (r, r, part.size[-1])}.get(
            part.kind, (r, r, r + part.size[-1])
        )
        local = [(x * half[0], y * half[1], z * half[2]) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return [add(vector(part.centre), rotate(quaternion(part.turn), corner)) for corner in local]


def spacing_of(model: Model, chosen: float, notes: list[str]) -> float:
    """[m]: so that the thinnest body has a few particles across, and all have not too many."""
    parts = [part for link in model.links for part in link.parts if part.kind != "plane"]
    if chosen > 0.0 or not parts:
        return chosen or 0.1
    spacing = min(map(thickness, parts)) / ACROSS
    least = (sum(map(volume, parts)) / MOST) ** (1.0 / 3.0)
    if spacing < least:
        notes.append(f"the spacing is {least:.2g} m; thin bodies have fewer than {ACROSS} particles across")
    return float(f"{max(spacing, least):.4g}")


def reach(link: Link, turn: Quaternion, end: float) -> list[float]:
    """How far it gets along the two axes of a plane until the end, gliding or rolling [m]."""
    glides, spin = (rotate_back(turn, vector(v)) for v in (link.velocity, link.spin))
    radius = max((norm(subtract(c, vector(link.centre))) for part in link.parts for c in corners(part)), default=0.0)
    return [end * max(abs(glides[a]), radius * abs(spin[1 - a])) for a in range(2)]


def extent_along(turn: Quaternion, at: Vector, model: Model) -> tuple[list[float], list[float]]:
    """Least and greatest place of all other shapes along the two axes of a plane [m]."""
    others = [p for link in model.links for p in link.parts if p.kind != "plane"]
    seen = [rotate_back(turn, subtract(c, at)) for p in others for c in corners(p)] or [(0.0, 0.0, 0.0)]
    return [min(c[a] for c in seen) for a in range(2)], [max(c[a] for c in seen) for a in range(2)]


def slab(part: Part, model: Model, end: float, spacing: float, notes: list[str]) -> Part:
    """A box below the plane, as wide as bodies can get along it [m]."""
    turn, at = quaternion(part.turn), vector(part.centre)
    low, high = extent_along(turn, at, model)
    pull = rotate_back(turn, vector(model.gravity))
    ways = [reach(link, turn, end) for link in model.links if link.free] or [[0.0, 0.0]]
    size = max(high[0] - low[0], high[1] - low[1], spacing)
    half = [0.5 * (high[a] - low[a] + size + abs(pull[a]) * end * end) + max(way[a] for way in ways) for a in range(2)]
    cut = min(1.0, math.sqrt(SLAB * spacing * spacing / (4.0 * LAYERS * half[0] * half[1])))
    half = [math.ceil(cut * h / spacing) * spacing for h in half]
    middle = (0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), -0.5 * LAYERS * spacing)
    notes.append(
        f"an infinite plane is written as a slab of {2.0 * half[0]:.4g} x {2.0 * half[1]:.4g} m, "
        f"{LAYERS} spacings thick" + ("; bodies can get beyond it" if cut < 1.0 else "")
    )
    centre = add(at, rotate(turn, middle))
    return replace(part, kind="box", centre=centre, size=(half[0], half[1], 0.5 * LAYERS * spacing))


def same_turn(a: Quaternion, b: Quaternion) -> bool:
    return abs(abs(sum(x * y for x, y in zip(a, b))) - 1.0) < 1e-14


def common_turn(parts: list[Part]) -> Quaternion | None:
    """The turn of all parts, where they share one; a sphere has any."""
    turns = [quaternion(part.turn) for part in parts if part.kind != "sphere"] or [IDENTITY]
    return turns[0] if all(same_turn(turns[0], turn) for turn in turns) else None


def part_text(part: Part, centre: Vector, turn: Quaternion, file: str) -> str:
    """A shape whose middle is `centre` [m] and whose axes are turned by `turn`."""
    if part.kind == "sphere":
        return f'{{ kind = "sphere", centre = {numbers(centre)}, radius = {number(part.size[0])} }}'
    if part.kind == "box":
        low, high = subtract(centre, vector(part.size)), add(centre, vector(part.size))
        turned = "" if same_turn(turn, IDENTITY) else f", rotation = {numbers(turn)}"
        return f'{{ kind = "box", min = {numbers(low)}, max = {numbers(high)}{turned} }}'
    if part.kind == "mesh":
        return f'{{ kind = "mesh", file = "{file}" }}'
    axis = rotate(turn, (0.0, 0.0, 1.0))
    foot, head = (add(centre, scaled(s * part.size[1], axis)) for s in (-1.0, 1.0))
    radius = number(part.size[0])
    rod = (
        f'{{ kind = "cylinder", base = {numbers(foot)}, axis = {numbers(axis)}, '
        f"length = {number(2.0 * part.size[1])}, radius = {radius} }}"
    )
    if part.kind == "cylinder":
        return rod
    ends = (f'{{ kind = "sphere", centre = {numbers(end)}, radius = {radius} }}' for end in (foot, head))
    return f'{{ kind = "union", of = [{rod}, {", ".join(ends)}] }}'


def mesh_text(part: Part) -> str:
    """The mesh where it is in the world, as .obj."""
    turn, at = quaternion(part.turn), vector(part.centre)
    lines = [f"v {' '.join(map(number, add(at, rotate(turn, vector(c)))))}" for c in part.corners]
    return "\n".join(lines + [f"f {' '.join(str(int(k) + 1) for k in face)}" for face in part.faces]) + "\n"


class Shapes:
    """Shapes of bodies as text, and the files of their meshes."""

    def __init__(self, stem: str) -> None:
        self.stem = plain(stem).replace(" ", "-")
        self.files: dict[str, str] = {}

    def of(self, link: Link) -> list[str]:
        """The lines `shape` and, where all parts are turned as one, `rotation`."""
        turn = common_turn(link.parts)
        meshes = any(part.kind == "mesh" for part in link.parts)
        if turn is None or meshes or same_turn(turn, IDENTITY):
            return [f"shape = {self.united(link, IDENTITY, (0.0, 0.0, 0.0))}"]
        # The rotation of a case is about the middle of the bounding box of the shape that is not turned.
        local = [replace(part, centre=rotate_back(turn, vector(part.centre)), turn=IDENTITY) for part in link.parts]
        points = [corner for part in local for corner in corners(part)]
        middle = tuple(0.5 * (min(p[a] for p in points) + max(p[a] for p in points)) for a in range(3))
        shift = subtract(rotate(turn, middle), middle)
        return [f"shape = {self.united(link, turn, shift)}", f"rotation = {numbers(turn)}"]

    def united(self, link: Link, turn: Quaternion, shift: Vector) -> str:
        """@param turn, shift  of the axes that the parts are written in"""
        texts = []
        for k, part in enumerate(link.parts):
            centre = add(rotate_back(turn, vector(part.centre)), shift)
            file = f"{self.stem}-{link.name.replace(' ', '-')}-{k}.obj" if part.kind == "mesh" else ""
            if file:
                self.files[file] = mesh_text(part)
            texts.append(part_text(part, centre, product(conjugate(turn), quaternion(part.turn)), file))
        return texts[0] if len(texts) == 1 else f'{{ kind = "union", of = [{", ".join(texts)}] }}'


def friction_between(model: Model, a: Link, b: Link) -> float:
    """As MuJoCo combines geoms: the larger coefficient, and none where neither asks for friction."""
    stated = model.pairs.get(frozenset((a.name, b.name)))
    if stated is not None:
        return stated
    return 0.0 if a.slick and b.slick else max(a.friction, b.friction)


class Materials:
    """Materials of the bodies, and the friction of their pairs."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.names: dict[tuple[Any, ...], str] = {}
        self.of: dict[str, str] = {}  # link -> material
        self.density: dict[str, float] = {}
        for link in model.links:
            solid = sum(map(volume, link.parts))
            density = float(f"{link.mass / solid:.4g}") if link.free and solid > 0.0 else 1000.0
            alone = link.name if any(link.name in pair for pair in model.pairs) else ""
            key = (density, link.friction, link.slick, alone)
            name = self.names.setdefault(key, f"material {len(self.names) + 1}")
            self.of[link.name], self.density[name] = name, density

    def frictions(self) -> dict[tuple[str, str], float]:
        """Of pairs of materials whose bodies can meet."""
        found = {}
        for a, b in combinations_with_replacement(self.model.links, 2):
            if a is not b and (a.free or b.free):
                found[tuple(sorted((self.of[a.name], self.of[b.name])))] = friction_between(self.model, a, b)
        return found


def engines_text(model: Model, shared: float) -> list[str]:
    """@param shared friction of every pair, 0 where tables say it or there is none"""
    settings = [f'cone = "{model.cone}"']
    settings += [f'{key} = "{text}"' for key, text in (("solref", model.solref), ("solimp", model.solimp)) if text]
    lines = [f"[engines.all]\nsettings = {{ friction = {number(shared)} }}\n"] if shared > 0.0 else []
    lines.append("# MuJoCo as the model sets it.")
    lines.append(f'[engines.mujoco]\npreset = "{model.integrator}"\nsettings = {{ {", ".join(settings)} }}\n')
    lines.append("[engines.tripoint]\nrequired = false\n")
    return lines + [f"[engines.{name}]\n" for name in OTHERS]


def body_text(link: Link, shapes: Shapes, material: str, alone: bool) -> str:
    lines = [f'[[body]]\nname = "{link.name}"\nmaterial = "{material}"\nphase = "rigid"', *shapes.of(link)]
    if not link.free:
        return "\n".join([*lines, 'motion = "fixed"', ""])
    lines.append(f"mass = {number(link.mass)}")
    if not alone:
        tensor = link.inertia
        least = 1e-12 * float(tensor.trace())
        products = [0.0 if abs(p) < least else float(p) for p in (tensor[0][1], tensor[0][2], tensor[1][2])]
        lines += [f"centre = {numbers(link.centre)}", f"inertia = {numbers(tensor[k][k] for k in range(3))}"]
        lines += [f"products = {numbers(products)}"] if any(products) else []
    lines += [
        f"{key} = {numbers(v)}" for key, v in (("velocity", link.velocity), ("angular_velocity", link.spin)) if any(v)
    ]
    return "\n".join([*lines, ""])


def case_text(model: Model, source: str, stem: str, choices: Choices) -> tuple[str, dict[str, str], list[str]]:
    """@return the case file, the files beside it by name, and notes on what was chosen"""
    notes: list[str] = []
    spacing = spacing_of(model, choices.spacing, notes)
    links = []
    for link in model.links:
        flat = [slab(p, model, choices.end, spacing, notes) if p.kind == "plane" else p for p in link.parts]
        links.append(replace(link, parts=flat))
    flat_model = replace(model, links=links)
    materials, shapes = Materials(flat_model), Shapes(stem)
    pairs = materials.frictions()
    shared = next(iter(pairs.values()), 0.0) if len(set(pairs.values())) == 1 else 0.0
    free = sum(link.free for link in links)
    lines = [
        f"# Imported from {one_line(source)} by `tripoint import`.",
        "# Left out:" if model.left_out else "# Nothing is left out.",
    ]
    lines += [f"#   {line}" for line in model.left_out]
    lines += [
        f'format = 1\n\n[case]\ntitle = "{model.name}, imported"\nkind = "comparison"\n',
        f"[scene]\nend_time = {number(choices.end)} # a choice: the model has none",
        f"gravity = {numbers(model.gravity)}\nspacing = {number(spacing)}\ntime_step = {number(model.time_step)}",
        f"output_interval = {number(choices.end / 50.0)}\n" + ("" if model.touches else 'contact = "none"\n'),
    ]
    for name, density in materials.density.items():
        lines.append(f'[[material]]\nname = "{name}"\ndensity = {number(density)}\n')
    if len(set(pairs.values())) > 1:
        for (a, b), mu in pairs.items():
            lines.append(f'[[contact]]\nmaterials = ["{a}", "{b}"]\nfriction = {number(mu)}\n')
    for link in links:
        lines.append(body_text(link, shapes, materials.of[link.name], link.name in choices.particles_alone))
    lines += [joint.text() for joint in model.joints]
    lines += engines_text(model, shared)
    lines.append("[invariants]\nmass = 1e-12")
    if free:
        lines.append(f'body_count = {{ value = {len(links)}, limit = 0, reason = "nothing breaks" }}')
    return "\n".join(lines) + "\n", shapes.files, notes
