# SPDX-License-Identifier: BSD-3-Clause
"""A model in MJCF or URDF as MuJoCo's own parser reads it: rigid bodies with their shapes, masses and motion at the
start, and a list of what a case file cannot say.

Runs in the environment of the engine mujoco, which has numpy. Units are SI; all places are in the world's frame."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn here

import mujoco
import numpy as np
from imported_joints import Joint, Joints

INTEGRATORS = {"EULER": "Euler", "RK4": "RK4", "IMPLICIT": "implicit", "IMPLICITFAST": "implicitfast"}  # presets
DEFAULT_SOLREF, DEFAULT_SOLIMP = (0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0)


class Unreadable(Exception):
    """Why a file is not read, for people."""


@dataclass
class Part:
    """A geom: box, sphere, cylinder, capsule, plane or mesh (its convex hull)."""

    kind: str
    centre: np.ndarray  # [m]
    turn: np.ndarray  # (w, x, y, z), geom to world
    size: tuple[float, ...] = ()  # as MJCF: half lengths; radius; radius and half length
    corners: np.ndarray | None = None  # of a mesh, in the geom's frame [m]
    faces: np.ndarray | None = None  # its triangles, counter-clockwise seen from outside


@dataclass
class Link:
    """A body of the case: bodies of the model that are welded together."""

    name: str
    free: bool
    parts: list[Part]
    friction: float = 0.0  # of sliding, of its geoms
    slick: bool = False  # all of its geoms ask for contacts without friction (condim 1)
    mass: float = 0.0  # [kg]
    centre: np.ndarray = field(default_factory=lambda: np.zeros(3))  # of mass [m]
    inertia: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))  # about it [kg m2]
    velocity: np.ndarray = field(default_factory=lambda: np.zeros(3))  # of the centre of mass [m/s]
    spin: np.ndarray = field(default_factory=lambda: np.zeros(3))  # [rad/s]


@dataclass
class Model:
    name: str
    gravity: tuple[float, ...]
    time_step: float
    integrator: str
    cone: str
    solref: str  # "" is MuJoCo's default
    solimp: str
    links: list[Link]
    joints: list[Joint]
    touches: bool  # whether any geom can touch another
    pairs: dict[frozenset[str], float]  # friction of pairs of links that the model states itself
    left_out: list[str]
    notes: list[str]


def plain(name: str) -> str:
    """As names of a case file are: letters, digits, blanks and _ - . alone."""
    return re.sub(r"[^A-Za-z0-9_. -]", "-", name)[:60] or "model"


def one_line(text: str) -> str:
    """Names of a model may hold line breaks and other characters that no comment may."""
    return re.sub(r"[\x00-\x1f\x7f]", " ", text)


def text_of(values: Any) -> str:
    return " ".join(f"{float(v):.12g}" for v in values)


def compiled(path: Path, base: str, notes: list[str]) -> Any:
    """The model of the vendor's parser. @param base free or fixed: what holds the root of a URDF
    @raise Unreadable with the parser's own words"""
    text = path.read_text(encoding="utf-8", errors="replace")
    root = re.search(r"<(?![?!])\s*([\w:.-]+)", text)
    kind = root.group(1) if root else ""
    if kind not in ("mujoco", "mujocoinclude", "robot"):
        raise Unreadable(f"a model in MJCF begins with <mujoco>, one in URDF with <robot>; this begins with <{kind}>")
    try:
        if kind != "robot":
            return mujoco.MjModel.from_xml_path(str(path))
        return compiled_urdf(path, text, base, notes)
    except ValueError as error:
        raise Unreadable(f"MuJoCo's parser says: {' '.join(str(error).split())}") from error


def compiled_urdf(path: Path, text: str, base: str, notes: list[str]) -> Any:
    if not hasattr(mujoco, "MjSpec"):
        raise Unreadable(f"MuJoCo {mujoco.__version__} cannot keep the links of a URDF apart: install a later release")
    spec = mujoco.MjSpec.from_file(str(path))
    spec.compiler.fusestatic = False
    root = spec.worldbody.first_body()
    held = base == "fixed" or (not base and root is not None and root.name == "world")
    if root is not None and not held:
        root.add_freejoint()
        notes.append(f"the base link {root.name} is free; --base fixed holds it, as a link named world would")
    notes.append("URDF has no gravity and no friction: those of MuJoCo are written, 9.81 m/s2 along -z and 1")
    if re.search(r"lateral_friction|<mu1>|<mu2>", text):
        notes.append("MuJoCo's parser does not read friction by the tags of Gazebo or Bullet")
    return spec.compile()


def started(model: Any, key: str, notes: list[str]) -> Any:
    """The state at the start: that of a keyframe, by default the first one. @param key its name or number, or none"""
    data = mujoco.MjData(model)
    names = [model.key(k).name or str(k) for k in range(model.nkey)]
    if key and key != "none" and key not in names and not (key.isdigit() and int(key) < model.nkey):
        raise Unreadable(f"no keyframe {key}; there are {', '.join(names) or 'none'}")
    if model.nkey and key != "none":
        row = names.index(key) if key in names else int(key or 0)
        mujoco.mj_resetDataKeyframe(model, data, row)
        notes.append(f"the start is that of keyframe {names[row]}; --key none takes the model's own")
    mujoco.mj_forward(model, data)
    return data


def quaternion_of(matrix: np.ndarray) -> np.ndarray:
    turn = np.zeros(4)
    mujoco.mju_mat2Quat(turn, np.asarray(matrix, dtype=float).flatten())
    return turn if turn[0] >= 0.0 else -turn


def hull_of(model: Any, mesh: int) -> tuple[np.ndarray, np.ndarray] | None:
    """Corners and triangles of the convex hull that MuJoCo made for contact; None where it made none."""
    at = model.mesh_graphadr[mesh]
    if at < 0:
        return None
    graph = model.mesh_graph
    corners, triangles = int(graph[at]), int(graph[at + 1])
    kept = graph[at + 2 + corners : at + 2 + 2 * corners]
    first = at + 2 + 3 * corners + 3 * triangles  # after the edges: 2 numbers before, corners + 3 triangles
    faces = np.array(graph[first : first + 3 * triangles]).reshape(-1, 3)
    start = model.mesh_vertadr[mesh]
    number = {int(vertex): k for k, vertex in enumerate(kept)}
    points = np.array(model.mesh_vert[start : start + model.mesh_vertnum[mesh]], dtype=float)
    return points[kept], np.array([[number[int(v)] for v in face] for face in faces])


def outward(corners: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The triangles of a convex surface, counter-clockwise seen from outside."""
    a, b, c = (corners[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), (a + b + c) / 3.0 - corners.mean(axis=0)) < 0.0
    faces = faces.copy()
    faces[inward] = faces[inward][:, ::-1]
    return faces


def ball(rings: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Corners and triangles of a unit sphere, by circles of latitude."""
    around = 2 * rings
    corners = [(0.0, 0.0, -1.0)]
    for ring in range(1, rings):
        z, r = -np.cos(np.pi * ring / rings), np.sin(np.pi * ring / rings)
        corners += [(r * np.cos(2 * np.pi * k / around), r * np.sin(2 * np.pi * k / around), z) for k in range(around)]
    corners.append((0.0, 0.0, 1.0))
    top, faces = len(corners) - 1, []
    row = lambda ring, k: 1 + (ring - 1) * around + k % around
    for k in range(around):
        faces += [(0, row(1, k), row(1, k + 1)), (top, row(rings - 1, k), row(rings - 1, k + 1))]
        for ring in range(1, rings - 1):
            faces += [
                (row(ring, k), row(ring, k + 1), row(ring + 1, k + 1)),
                (row(ring, k), row(ring + 1, k + 1), row(ring + 1, k)),
            ]
    points = np.array(corners)
    return points, outward(points, np.array(faces))


def part_of(model: Any, data: Any, geom: int, notes: list[str]) -> Part | None:
    """@return None for a geom that no shape of a case stands for"""
    kind = mujoco.mjtGeom(model.geom_type[geom]).name.removeprefix("mjGEOM_").lower()
    part = Part(kind, np.array(data.geom_xpos[geom]), quaternion_of(data.geom_xmat[geom]))
    size = [float(s) for s in model.geom_size[geom]]
    name = name_of(model, "geom", geom)
    if kind in ("box", "plane"):
        part.size = tuple(size)
    elif kind == "sphere":
        part.size = tuple(size[:1])
    elif kind in ("cylinder", "capsule"):
        part.size = tuple(size[:2])
    elif kind == "ellipsoid":
        points, part.faces = ball()
        part.kind, part.corners = "mesh", points * np.array(size)
        notes.append(f"geom {name}: an ellipsoid is written as a mesh of {len(part.faces)} triangles")
    elif kind == "mesh":
        hull = hull_of(model, int(model.geom_dataid[geom]))
        if hull is None:
            return None
        part.corners, part.faces = hull[0], outward(*hull)
        mesh = int(model.geom_dataid[geom])
        if len(part.corners) < int(model.mesh_vertnum[mesh]):
            notes.append(f"geom {name}: the mesh is written as its convex hull, with which MuJoCo collides it")
    else:
        return None
    return part


def name_of(model: Any, kind: str, number: int) -> str:
    return getattr(model, kind)(number).name or f"{kind}_{number}"


def touches(model: Any, geom: int) -> bool:
    return bool(model.geom_contype[geom] or model.geom_conaffinity[geom])


def can_touch(model: Any) -> bool:
    return any(touches(model, geom) for geom in range(model.ngeom))


def friction_of(model: Any, geoms: list[int], name: str, notes: list[str]) -> float:
    found = {float(model.geom_friction[g][0]) for g in geoms}
    if len(found) > 1:
        notes.append(f"body {name}: its geoms have several coefficients of friction, and the largest is taken")
    return max(found, default=0.0)


class Links:
    """Bodies of the case, made of the model's bodies.

    @param locked bodies that a joint connects move as one"""

    def __init__(self, model: Any, data: Any, locked: bool, left_out: list[str], notes: list[str]) -> None:
        self.model, self.data, self.locked, self.left_out, self.notes = model, data, locked, left_out, notes
        self.links: list[Link] = []
        self.of_geom: dict[int, str] = {}
        self.of_body: list[str | None] = [None] * model.nbody

    def made(self) -> list[Link]:
        for geom in self.geoms_of([0]):
            self.add(name_of(self.model, "geom", geom), [geom], [])
        roots = [self.root_of(body) for body in range(self.model.nbody)]
        for body in range(1, self.model.nbody):
            if roots[body] == 0:
                self.add(name_of(self.model, "body", body), self.geoms_of([body]), [])
            elif roots[body] == body:
                members = [b for b, root in enumerate(roots) if root == body]
                self.add(name_of(self.model, "body", body), self.geoms_of(members), members)
        by_root = {roots[body]: name for body, name in enumerate(self.of_body) if name}
        self.of_body = ["world" if root == 0 else by_root.get(root) for root in roots]
        return self.links

    def root_of(self, body: int) -> int:
        """The body that this one moves with: 0 is the world."""
        while body:
            first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
            kinds = [int(self.model.jnt_type[j]) for j in range(first, first + count)]
            if int(mujoco.mjtJoint.mjJNT_FREE) in kinds or (kinds and not self.locked):
                return body
            body = int(self.model.body_parentid[body])
        return 0

    def geoms_of(self, bodies: list[int]) -> list[int]:
        return [g for g in range(self.model.ngeom) if int(self.model.geom_bodyid[g]) in bodies]

    def add(self, name: str, geoms: list[int], members: list[int]) -> None:
        """@param members bodies that move as one; none: fixed"""
        solid = [g for g in geoms if touches(self.model, g)]
        parts = []
        for geom in solid or (geoms if members else []):
            part = part_of(self.model, self.data, geom, self.notes)
            if part is None or (part.kind == "plane" and members):
                self.left_out.append(
                    f"geom {name_of(self.model, 'geom', geom)}: a shape that a case file does not have"
                )
            else:
                parts.append(part)
                self.of_geom[geom] = self.unused(name)
        if not parts:
            if members:
                self.left_out.append(f"body {name}: it has mass and no shape")
            return
        if not solid and can_touch(self.model):
            self.notes.append(f"body {name}: its geoms touch nothing in MuJoCo; here they can")
        link = Link(self.unused(name), bool(members), parts, friction_of(self.model, solid, name, self.notes))
        link.slick = all(self.model.geom_condim[g] == 1 for g in solid)
        if members:
            self.give_motion(link, members)
            self.of_body[members[0]] = link.name
        self.links.append(link)

    def unused(self, name: str) -> str:
        """A name that no body has yet."""
        name = plain(name)
        names = {link.name for link in self.links}
        return next(n for n in (name, *(f"{name} {k}" for k in range(2, len(names) + 3))) if n not in names)

    def give_motion(self, link: Link, members: list[int]) -> None:
        """Mass, centre, moments and velocities of bodies that move as one."""
        model, data, root = self.model, self.data, members[0]
        masses = [float(model.body_mass[b]) for b in members]
        link.mass = sum(masses)
        link.centre = sum(m * np.array(data.xipos[b]) for m, b in zip(masses, members)) / link.mass
        for mass, body in zip(masses, members):
            axes = np.array(data.ximat[body]).reshape(3, 3)
            arm = np.array(data.xipos[body]) - link.centre
            link.inertia += axes @ np.diag(model.body_inertia[body]) @ axes.T
            link.inertia += mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        both = np.zeros(6)  # spin, then velocity of the body's origin, in the world's axes
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, root, both, 0)
        link.spin = both[:3]
        link.velocity = both[3:] + np.cross(link.spin, link.centre - np.array(data.xpos[root]))


COUNTED = {
    "nu": "actuator",
    "ntendon": "tendon",
    "neq": "equality constraint",
    "nsensor": "sensor",
    "ncam": "camera",
    "nlight": "light",
    "nsite": "site",
    "nflex": "deformable body",
    "nskin": "skin",
    "nexclude": "excluded pair of bodies",
    "nhfield": "height field",
    "nplugin": "plugin",
}


def settings_left_out(model: Any) -> list[str]:
    """What else is set and no case file says."""
    found = {
        f"motion of {model.nmocap} mocap bodies: they are fixed": model.nmocap,
        "forces of the medium: wind, density, viscosity": any(
            [*model.opt.wind, model.opt.density, model.opt.viscosity]
        ),
        "compensation of gravity (gravcomp)": any(model.body_gravcomp),
        "flags of <option>": model.opt.disableflags or model.opt.enableflags,
    }
    return [line for line, is_set in found.items() if is_set]


def contacts_left_out(model: Any) -> list[str]:
    touching = [g for g in range(model.ngeom) if touches(model, g)]
    filters = {(int(model.geom_contype[g]), int(model.geom_conaffinity[g])) for g in touching}
    found = {
        "friction of spinning and rolling (condim 4 and 6)": any(model.geom_condim[g] > 3 for g in touching),
        "margin and gap of geoms": any(model.geom_margin[g] or model.geom_gap[g] for g in touching),
        "priority of geoms: the larger friction of two holds": len({int(model.geom_priority[g]) for g in touching}) > 1,
        "filters of contacts (contype and conaffinity): every pair of bodies can touch": len(filters) > 1,
    }
    return [line for line, is_set in found.items() if is_set]


def others_left_out(model: Any) -> list[str]:
    counts = {word: int(getattr(model, key, 0)) for key, word in COUNTED.items()}
    counted = [f"{count} {word}{'s' if count > 1 else ''}" for word, count in counts.items() if count]
    return counted + settings_left_out(model) + contacts_left_out(model)


def common(model: Any, key: str, default: tuple[float, ...], left_out: list[str]) -> str:
    """A number of contacts that all geoms share, as text; "" is MuJoCo's default."""
    rows = {text_of(getattr(model, f"geom_{key}")[g]) for g in range(model.ngeom) if touches(model, g)}
    rows |= {text_of(getattr(model, f"pair_{key}")[p]) for p in range(model.npair)}
    if len(rows) > 1:
        left_out.append(f"{key} of geoms: it differs between them, and MuJoCo's default is taken")
        return ""
    return next((row for row in rows if row != text_of(default)), "")


def pairs_of(model: Any, of_geom: dict[int, str]) -> dict[frozenset[str], float]:
    stated = {}
    for pair in range(model.npair):
        a, b = (of_geom.get(int(g)) for g in (model.pair_geom1[pair], model.pair_geom2[pair]))
        if a and b and a != b:
            sliding = float(model.pair_friction[pair][0]) if model.pair_dim[pair] > 1 else 0.0
            stated[frozenset((a, b))] = sliding
    return stated


def read_model(path: Path, key: str, base: str, joints: str) -> Model:
    """@param key name or number of a keyframe, none, or "" for the first   @param base free, fixed or "" (of a URDF)
    @param joints keep; free leaves them out; lock holds what they connect as it stands   @raise Unreadable"""
    left_out: list[str] = []
    notes: list[str] = []
    model = compiled(path, base, notes)
    data = started(model, key, notes)
    links = Links(model, data, joints == "lock", left_out, notes)
    made = links.made()
    joined = Joints(model, data, links.of_body, lambda *of: plain(name_of(*of)))
    if joints != "keep":
        left_out[:0] = [f"joint {one.name}: {one.kind} between {' and '.join(one.bodies)}" for one in joined.made]
        joined.made = []
    return Model(
        plain(path.stem),
        tuple(float(g) for g in model.opt.gravity),
        float(model.opt.timestep),
        INTEGRATORS[mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_")],
        mujoco.mjtCone(model.opt.cone).name.removeprefix("mjCONE_").lower(),
        common(model, "solref", DEFAULT_SOLREF, left_out),
        common(model, "solimp", DEFAULT_SOLIMP, left_out),
        made,
        joined.made,
        can_touch(model),
        pairs_of(model, links.of_geom),
        [one_line(line) for line in joined.left_out + left_out + others_left_out(model)],
        [one_line(line) for line in notes],
    )
