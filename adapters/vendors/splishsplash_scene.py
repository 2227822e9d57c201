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
from rotation import IDENTITY, Vector, add, conjugate, norm, scaled, subtract, vector
from splishsplash_bodies import (
    BOX,
    NO_CONTACT,
    TOLERANCE,
    UNIT_BOX,
    Cuboid,
    Solid,
    Triangle,
    axis_angle,
    cuboids_of,
    mesh_of,
    refuse_contact,
    sized,
    solid_of,
    touched,
    write_mesh,
)
from splishsplash_frames import turned

STIFFNESS = 100.0  # of contact; with its default of 1 a body lies g times a step deep
SUB_STEPS = 1  # its default of 5 serves joints, and makes the rounding of velocities five times as large
LAYERS = 2  # of a wall that stands for a periodic direction: the kernel's support is two spacings


def to_engine(values: Any) -> Any:
    """Vectors of the job, (..., 3), in the axes of SPlisHSPlasH: a turn by -90 degrees about x. For places, from
    `Files.origin`."""
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


def refuse_body(body: dict[str, Any]) -> str:
    name = body["name"]
    if body["phase"] == "elastic":
        return f"elastic bodies are not handed to SPlisHSPlasH, and {name} is elastic"
    if body["temperature"] is not None:
        return f"SPlisHSPlasH has no heat, and {name} has a temperature"
    if body["joined_to"]:
        return f"bonds between bodies are not handed to SPlisHSPlasH, and {name} has some"
    if body["motion"] == "prescribed":
        return f"prescribed motion is not handed to SPlisHSPlasH, and {name} has one"
    return ""


def free_bodies(job: Job) -> list[dict[str, Any]]:
    return [body for body in job.bodies if body["phase"] == "rigid" and body["motion"] == "free"]


def rests(body: dict[str, Any]) -> bool:
    return not any(body["velocity"]) and not any(body["angular_velocity"])


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
    if scene["inflows"] or any(event["kind"] != "hold" or not event["bodies"] for event in scene["events"]):
        return "events but the hold of bodies, and inflow, are not handed to SPlisHSPlasH"
    if len(liquids) != 1:
        return f"SPlisHSPlasH is handed one liquid, and there are {len(liquids)}"
    liquid = materials[liquids[0]]
    for body in job.bodies:
        if reason := refuse_body(body):
            return reason
    return refuse_free_bodies(job, liquid) or refuse_periodic(job) or refuse_friction(job, liquid)


def refuse_free_bodies(job: Job, liquid: dict[str, Any]) -> str:
    """A body that floats alone meets nothing; others need contact."""
    free = free_bodies(job)
    density = {material["name"]: material["density"] for material in job.scene["materials"]}
    floats = len(free) == 1 and density[free[0]["material"]] < liquid["density"] and rests(free[0])
    return "" if floats or not free else refuse_contact(job)


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


def side_boxes(job: Job, sides: Any) -> list[Cuboid]:
    """What the particles of side walls fill: two boxes a periodic direction, each as wide as all."""
    scene, half = job.scene, 0.5 * float(job.scene["spacing"])
    low, high = (sides.min(axis=0) - half).tolist(), (sides.max(axis=0) + half).tolist()
    boxes = []
    for k in ("xyz".index(name) for name in scene["periodic"]):
        boxes.append((vector(low), vector([*high[:k], scene["min"][k], *high[k + 1 :]])))
        boxes.append((vector([*low[:k], scene["max"][k], *low[k + 1 :]]), vector(high)))
    return boxes


def laws(settings: dict[str, Any]) -> dict[str, float]:
    """Friction and restitution of a body: a pair has the sum of the first and the product of the second."""
    return {
        "friction": 0.5 * float(settings.get("friction", 0.0)),
        "restitution": math.sqrt(float(settings.get("restitution", 0.0))),
    }


class Files:
    """The scene of a job in a folder: `scene.json` and what it names."""

    def __init__(self, job: Job, folder: Path, configuration: dict[str, Any], boundary_viscosity: float) -> None:
        import h5py
        import numpy as np

        self.folder, self.spacing = folder, float(job.scene["spacing"])
        folder.mkdir(exist_ok=True)
        with h5py.File(job.particles) as file:
            self.start = {
                key: file[f"particles/all/{key}/value"][0]
                for key in ("position", "velocity", "mass", "phase", "body", "material")
            }
        materials = {material["name"]: material for material in job.scene["materials"]}
        self.free_bodies = free_bodies(job)
        centres = [body["centre"] for body in self.free_bodies] or [[0.0] * 3]
        self.origin = np.mean(centres, axis=0)  # of places in single precision, which is finest near it [m]
        self.liquid = np.nonzero(self.start["phase"] == 0)[0]
        material = next(materials[body["material"]] for body in job.bodies if body["phase"] == "liquid")
        write_particles(folder / "liquid.bgeo", to_engine(self.start["position"][self.liquid] - self.origin))
        contacts = bool(self.free_bodies) and not refuse_contact(job)
        # It ends by a signal where a body that moves stands before one that does not.
        blocks = self.walls(job, contacts)
        blocks += [self.free(f"free{k}", body, contacts, job.settings) for k, body in enumerate(self.free_bodies)]
        viscosity = {"viscosity": material["viscosity"] / material["density"], "viscosityBoundary": boundary_viscosity}
        scene = {
            "Configuration": configuration,
            "Simulation": {
                "gravity": configuration["gravitation"],  # of its rigid bodies
                "subSteps": int(job.settings.get("subSteps", SUB_STEPS)),
                "contactStiffnessRigidBody": float(job.settings.get("contactStiffnessRigidBody", STIFFNESS)),
            },
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

    def of(self, body: dict[str, Any]) -> Any:
        """Particles of a body (n, 3) [m]"""
        return self.start["position"][self.start["body"] == body["index"]]

    def walls(self, job: Job, contacts: bool) -> list[dict[str, Any]]:
        """What does not move, with contacts where something may meet it."""
        fixed = [body for body in job.bodies if body["phase"] == "rigid" and body["motion"] == "fixed"]
        sides = side_walls(job, self.start["position"]) if job.scene["periodic"] else None
        if not contacts:
            blocks = [self.block(f"b{k}", self.of(body), False) for k, body in enumerate(fixed)]
            return blocks if sides is None else [*blocks, self.block("sides", sides, False)]
        boxes = [box for body in fixed for box in cuboids_of(body["shape"]) or ()]
        places = [place for body in fixed for place in self.of(body)]
        if sides is not None:
            boxes += side_boxes(job, sides)
            places += list(sides)
        return self.touched_walls(boxes, touched(job, boxes), places, job.settings)

    def touched_walls(
        self, boxes: list[Cuboid], surfaces: list[Cuboid], places: list[Any], settings: dict[str, Any]
    ) -> list[dict[str, Any]]:
        """Each particle goes to the first box that holds it, and a box without any is in the middle of others."""
        blocks, left = [], list(places)
        for k, (box, (low, high)) in enumerate(zip(boxes, surfaces)):
            slack = 1e-6 * self.spacing
            own = [x for x in left if all(a - slack <= c <= b + slack for c, a, b in zip(x, *box))]
            left = [x for x in left if not all(a - slack <= c <= b + slack for c, a, b in zip(x, *box))]
            if own:
                middle, half = scaled(0.5, add(low, high)), scaled(0.5, subtract(high, low))
                surface = Solid(BOX, middle, IDENTITY, half)
                blocks.append({**self.block(f"b{k}", own, False, surface), **laws(settings)})
        if left:
            raise RuntimeError(f"{len(left)} particles of walls lie outside their shapes")
        return blocks

    def block(self, name: str, places: Any, moves: bool, solid: Solid | None = None) -> dict[str, Any]:
        """@param places of its particles [m] @param solid what others touch of it"""
        import numpy as np

        centre, turn, half = (solid.centre, solid.turn, solid.half) if solid else (self.origin, IDENTITY, (1.0,) * 3)
        arms = turned(conjugate(turn), np.array(places) - centre)
        write_particles(self.folder / f"{name}.bgeo", to_engine(arms))
        if not moves:
            self.mesh(name, [sized(corner, half) for corner in UNIT_BOX.corners], UNIT_BOX.faces)
        axis, angle = axis_angle(turn)
        scale = np.abs(to_engine(2.0 * np.array(half))) if not solid or solid.kind == BOX else np.array(half)
        return {
            "geometryFile": f"{name}.obj",
            "particleFile": f"{name}.bgeo",
            "translation": to_engine(np.array(centre) - self.origin).tolist(),
            "scale": [1, 1, 1],
            "rotationAxis": to_engine(np.array(axis)).tolist(),
            "rotationAngle": angle,
            "isDynamic": moves,
            "isWall": not moves,
            "density": 1.0,
            "collisionObjectType": solid.kind if solid else NO_CONTACT,
            "collisionObjectScale": scale.tolist(),
            "mapInvert": False,
            "mapThickness": 0.0,
            "mapResolution": [5, 5, 5],
        }

    def mesh(self, name: str, corners: list[Vector], faces: list[Triangle]) -> None:
        import numpy as np

        write_mesh(self.folder / f"{name}.obj", [vector(c) for c in to_engine(np.array(corners)).tolist()], faces)

    def free(self, name: str, body: dict[str, Any], contacts: bool, settings: dict[str, Any]) -> dict[str, Any]:
        """Its mass and moments are those of its mesh; the liquid sees its particles alone."""
        import numpy as np

        solid = solid_of(body) if contacts else None
        mesh = mesh_of(body, solid or Solid(NO_CONTACT, vector(self.origin), IDENTITY, (1.0,) * 3))
        surface = solid and solid._replace(half=vector([h - TOLERANCE for h in solid.half]))
        block = {**self.block(name, self.of(body), True, surface), **laws(settings), "density": mesh.density}
        self.mesh(name, mesh.corners, mesh.faces)
        block["velocity"] = to_engine(np.array(body["velocity"])).tolist()
        block["angularVelocity"] = to_engine(np.array(body["angular_velocity"])).tolist()
        return block
