# SPDX-License-Identifier: BSD-3-Clause
"""A job as a scene of SPlisHSPlasH: what is refused, its files, and the particles of its walls.

SPlisHSPlasH has gravity along -y, so that a job's (x, y, z) becomes (x, z, -y). The liquid and all walls are the job's
own particles. It has no periodic directions: where a scene is its own mirror image along one, two walls of particles
that slip stand for it, which is exact for the equations."""

from __future__ import annotations

import json
import math
import struct
from pathlib import Path
from typing import Any

from contract import Job
from rotation import Vector, add, norm, quaternion, rotate, vector

LAYERS = 2  # of a wall that stands for a periodic direction: the kernel's support is two spacings
EARTH = 9.81  # [m/s2]: the only gravity that its rigid bodies know


def to_engine(values: Any) -> Any:
    """Vectors of the job, (..., 3), in the axes of SPlisHSPlasH: a turn by -90 degrees about x."""
    return values[..., [0, 2, 1]] * (1.0, 1.0, -1.0)


def from_engine(values: Any) -> Any:
    return values[..., [0, 2, 1]] * (1.0, -1.0, 1.0)


def mirrored(shape: dict[str, Any], axis: int, middle: float, slack: float) -> bool:
    """Whether a shape is surely its own mirror image in the plane where the axis is `middle` [m]."""

    def parts(key: str) -> bool:
        return all(mirrored(part, axis, middle, slack) for part in shape[key])

    def central(x: float) -> bool:
        return abs(x - middle) < slack

    kind = shape["kind"]
    if "rotation" in shape:
        return False
    if kind == "box":
        return central(0.5 * (shape["min"][axis] + shape["max"][axis]))
    if kind == "sphere":
        return central(shape["centre"][axis])
    if kind == "cylinder":
        along = shape["axis"][axis] / norm(vector(shape["axis"]))
        lies = abs(along) < 1e-9 and central(shape["base"][axis])
        return lies or (abs(abs(along) - 1.0) < 1e-9 and central(shape["base"][axis] + 0.5 * along * shape["length"]))
    if kind == "half_space":
        return abs(shape["normal"][axis]) < 1e-9
    return kind in ("union", "difference") and parts("of")


def refuse_flow(body: dict[str, Any], axis: int, middle: float) -> str:
    """Why the start of a body is not its own mirror image along an axis; "" if it is."""
    field = body["velocity_field"]
    still = field["kind"] == "constant" and field["value"][axis] == 0.0
    if field["kind"] == "linear":
        gradient = field["gradient"]
        still = field["centre"][axis] == middle or not any(row[axis] for row in gradient)
        still = still and all(gradient[axis][k] == 0.0 and gradient[k][axis] == 0.0 for k in range(3) if k != axis)
    return "" if still and not any(body["angular_velocity"]) else f"{body['name']} may flow across it"


def refuse_periodic(job: Job) -> str:
    """Why no two mirrors stand for a periodic direction; "" if they do."""
    scene = job.scene
    for axis, name in enumerate("xyz"):
        if name not in scene["periodic"]:
            continue
        middle = 0.5 * (scene["min"][axis] + scene["max"][axis])
        no_mirror = f"SPlisHSPlasH has no periodic directions, and no mirror stands for {name}: "
        if scene["gravity"][axis] != 0.0:
            return no_mirror + "gravity drives along it"
        for body in job.bodies:
            if not mirrored(body["shape"], axis, middle, 1e-6 * scene["spacing"]):
                return no_mirror + f"{body['name']} is not its own mirror image"
            if reason := refuse_flow(body, axis, middle):
                return no_mirror + reason
    return ""


def refuse_body(body: dict[str, Any], density: float, material: dict[str, Any]) -> str:
    """@param density of the liquid [kg/m3]"""
    name = body["name"]
    if body["phase"] == "elastic":
        return f"elastic bodies are not handed to SPlisHSPlasH, and {name} is elastic"
    if body["temperature"] is not None:
        return f"SPlisHSPlasH has no heat, and {name} has a temperature"
    if body["joined_to"]:
        return f"bonds between bodies are not handed to SPlisHSPlasH, and {name} has some"
    if body["motion"] == "prescribed":
        return f"prescribed motion is not handed to SPlisHSPlasH, and {name} has one"
    if body["phase"] == "rigid" and body["motion"] == "free":
        if any(body["velocity"]) or any(body["angular_velocity"]):
            return f"free bodies are handed to SPlisHSPlasH at rest, and {name} moves"
        if material["density"] >= density:
            return f"contact between bodies is not handed to SPlisHSPlasH, and {name} sinks"
    return ""


def friction_is_mixed(job: Job) -> bool:
    """Whether some walls slip and some do not: SPlisHSPlasH has one `viscosityBoundary` for all of them."""
    slips = {body["slip"] == "free" for body in job.bodies if body["phase"] == "rigid"}
    return len(slips | ({True} if job.scene["periodic"] else set())) > 1


def refuse_scene(job: Job) -> str:
    """Why the scene is not one that SPlisHSPlasH can be handed; "" if it is."""
    scene = job.scene
    materials = {material["name"]: material for material in scene["materials"]}
    liquids = sorted({body["material"] for body in job.bodies if body["phase"] == "liquid"})
    if scene["mode"] == "paper":
        return "the paper's forms belong to the particle solver; SPlisHSPlasH has none"
    if scene["events"] or scene["inflows"]:
        return "events and inflow are not handed to SPlisHSPlasH"
    if len(liquids) != 1:
        return f"SPlisHSPlasH is handed one liquid, and there are {len(liquids)}"
    liquid = materials[liquids[0]]
    for body in job.bodies:
        if reason := refuse_body(body, liquid["density"], materials[body["material"]]):
            return reason
    return refuse_free_bodies(job) or refuse_periodic(job) or refuse_friction(job, liquid)


def refuse_free_bodies(job: Job) -> str:
    free = [body["name"] for body in job.bodies if body["phase"] == "rigid" and body["motion"] == "free"]
    if len(free) > 1:
        return f"contact between bodies is not handed to SPlisHSPlasH, and {free[0]} and {free[1]} may touch"
    if free and norm(add(vector(job.scene["gravity"]), (0.0, 0.0, EARTH))) > 1e-9:
        return (
            "rigid bodies of SPlisHSPlasH fall by 9.81 m/s2 along its -y, whatever gravity its liquid has, and "
            f"{free[0]} is free"
        )
    return ""


def refuse_friction(job: Job, liquid: dict[str, Any]) -> str:
    if friction_is_mixed(job) and liquid["viscosity"] > 0.0 and "viscosityBoundary" not in job.settings:
        return (
            "SPlisHSPlasH has one viscosityBoundary for all walls, and here some slip and some do not; the "
            "setting viscosityBoundary chooses"
        )
    return ""


def write_particles(path: Path, places: Any) -> None:
    """The old BGEO format, version 5: a header of counts and, in big-endian floats, x, y, z and 1 of each particle."""
    import numpy as np

    rows = np.ones((len(places), 4))
    rows[:, :3] = places
    path.write_bytes(b"BgeoV" + struct.pack(">9i", 5, len(rows), 0, 0, 0, 0, 0, 0, 0) + rows.astype(">f4").tobytes())


FACES = (
    (1, 3, 4, 2),
    (5, 6, 8, 7),
    (1, 2, 6, 5),
    (3, 7, 8, 4),
    (1, 5, 7, 3),
    (2, 4, 8, 6),
)  # corners of a box, seen from outside


def write_box(path: Path, corners: list[Vector]) -> None:
    """An OBJ file of a box. @param corners eight, the first axis fastest [m]"""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners]
    for a, b, c, d in FACES:
        lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def corners_of(half: Vector) -> list[Vector]:
    return [
        ((-half[0], half[0])[k & 1], (-half[1], half[1])[k >> 1 & 1], (-half[2], half[2])[k >> 2]) for k in range(8)
    ]


def equal_box(mass: float, inertia: Vector) -> Vector:
    """Half lengths [m] of the box that has this mass [kg] and these principal moments [kg m2]."""
    whole = sum(inertia)
    # type: ignore[return-value]
    return tuple(0.5 * math.sqrt(6.0 * (whole - 2.0 * moment) / mass) for moment in inertia)


def side_walls(job: Job, places: Any) -> Any:
    """Particles of the walls that stand for periodic directions, (n, 3) [m]: where the lattice goes on beyond the
    sides.

    @param places of all particles of the job"""
    import numpy as np

    scene, dx = job.scene, float(job.scene["spacing"])
    axes, outside = [], []
    for axis, name in enumerate("xyz"):
        low, high = (scene["min"][axis], scene["max"][axis]) if scene["max"] else (-math.inf, math.inf)
        beyond = LAYERS if name in scene["periodic"] else 0
        if not beyond:  # as far as the liquid may get
            low, high = max(low, float(places[:, axis].min()) - 0.5 * dx), min(high, 1e30)
            high = high if math.isfinite(high) and high < 1e30 else float(places[:, axis].max()) + 0.5 * dx
        count = round((high - low) / dx)
        steps = np.arange(-beyond, count + beyond)
        axes.append(low + dx * (steps + 0.5))
        outside.append((steps < 0) | (steps >= count))
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    beyond_any = np.logical_or.reduce(np.meshgrid(*outside, indexing="ij")).ravel()
    return grid[beyond_any]


class Files:
    """The scene of a job in a folder: `scene.json` and what it names."""

    def __init__(self, job: Job, folder: Path, configuration: dict[str, Any], boundary_viscosity: float) -> None:
        import h5py
        import numpy as np

        self.folder = folder
        folder.mkdir(exist_ok=True)
        with h5py.File(job.particles) as file:
            self.start = {
                key: file[f"particles/all/{key}/value"][0]
                for key in ("position", "velocity", "mass", "phase", "body", "material")
            }
        materials = {material["name"]: material for material in job.scene["materials"]}
        self.liquid = np.nonzero(self.start["phase"] == 0)[0]
        material = next(materials[body["material"]] for body in job.bodies if body["phase"] == "liquid")
        write_particles(folder / "liquid.bgeo", to_engine(self.start["position"][self.liquid]))
        bodies = [body for body in job.bodies if body["phase"] == "rigid"]
        bodies.sort(
            key=lambda body: body["motion"] == "free"
        )  # it ends by a signal where a body that moves stands before one that does not
        blocks = [
            self.fixed(f"b{k}", self.start["position"][self.start["body"] == body["index"]])
            for k, body in enumerate(bodies)
            if body["motion"] == "fixed"
        ]
        if job.scene["periodic"]:
            blocks.append(self.fixed("sides", side_walls(job, self.start["position"])))
        blocks += [self.free(body) for body in bodies if body["motion"] == "free"]
        self.free_body = next((body for body in bodies if body["motion"] == "free"), None)
        viscosity = {"viscosity": material["viscosity"] / material["density"], "viscosityBoundary": boundary_viscosity}
        scene = {
            "Configuration": configuration,
            "Materials": [
                {"id": "Fluid", "density0": material["density"], "viscosityMethod": 1, "Standard viscosity": viscosity}
            ],
            "FluidModels": [
                {
                    "id": "Fluid",
                    "particleFile": "liquid.bgeo",
                    "translation": [0, 0, 0],
                    "scale": [1, 1, 1],
                    "rotationAxis": [1, 0, 0],
                    "rotationAngle": 0,
                }
            ],
            "RigidBodies": blocks,
        }
        (folder / "scene.json").write_text(json.dumps(scene), encoding="ascii")

    def block(self, name: str, places: Any, moves: bool, density: float) -> dict[str, Any]:
        write_particles(self.folder / f"{name}.bgeo", to_engine(places))
        return {
            "geometryFile": f"{name}.obj",
            "particleFile": f"{name}.bgeo",
            "translation": [0, 0, 0],
            "scale": [1, 1, 1],
            "rotationAxis": [1, 0, 0],
            "rotationAngle": 0,
            "isDynamic": moves,
            "isWall": not moves,
            "density": density,
            "collisionObjectType": 0,
            "mapInvert": False,
            "mapThickness": 0.0,
            "mapResolution": [5, 5, 5],
        }

    def fixed(self, name: str, places: Any) -> dict[str, Any]:
        write_box(self.folder / f"{name}.obj", corners_of((1.0, 1.0, 1.0)))  # only drawn
        return self.block(name, places, False, 1.0)

    def free(self, body: dict[str, Any]) -> dict[str, Any]:
        """Its mass and moments are those of its mesh; the liquid sees its particles alone."""
        import numpy as np

        half = equal_box(body["mass"], vector(body["principal_inertia"]))
        frame, centre = quaternion(body["principal_axes"]), vector(body["centre"])
        corners = np.array([add(centre, rotate(frame, corner)) for corner in corners_of(half)])
        write_box(self.folder / "free.obj", [vector(corner) for corner in to_engine(corners).tolist()])
        density = body["mass"] / (8.0 * math.prod(half))
        return self.block("free", self.start["position"][self.start["body"] == body["index"]], True, density)
