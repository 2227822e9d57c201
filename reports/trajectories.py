# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run wrote (trajectory.h5 by H5MD, or trajectory.csv of a small engine) as far as pictures need it."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from shapes import shapes_of

MOST_FRAMES = 400  # of a body's path
MOST_ROWS = 2_000_000  # bound on what a file may ask this program to read


class NoTrajectory(Exception):
    """There is nothing to draw; the message says which file and why."""


@dataclass
class Trajectory:
    """Rows are particles (or bodies), SI; `strobe` are a few frames from first to last."""

    times: np.ndarray
    position: np.ndarray | None = None
    temperature: np.ndarray | None = None
    temperature_error: np.ndarray | None = None
    body: np.ndarray | None = None
    strobe: list = field(default_factory=list)
    bodies: dict = field(default_factory=dict)  # name -> (frames, bodies, components)
    body_times: np.ndarray | None = None
    observables: dict = field(default_factory=dict)  # name -> (times, values)
    gravity: tuple = (0.0, 0.0, 0.0)  # as the job says
    domain: tuple | None = None  # (least, greatest) corner of the scene, where the job says both
    shapes: list = field(default_factory=list)  # shapes.Shape of each body, where all are rigid boxes and balls

    @property
    def pulled(self):
        return any(self.gravity)


@dataclass
class Frame:
    time: float
    position: np.ndarray
    temperature: np.ndarray | None = None
    phase: np.ndarray | None = None  # 0 liquid, 1 elastic, 2 rigid
    material: np.ndarray | None = None


def folder_of(root, run):
    """The run's folder inside the results' folder. @raises NoTrajectory where it lies outside or is not said"""
    if not run.folder:
        raise NoTrajectory("results.json names no folder for this run")
    folder = (Path(root) / run.folder).resolve()
    if not folder.is_relative_to(Path(root).resolve()):
        raise NoTrajectory(f"folder {run.folder} lies outside the report's folder")
    return folder


def read(root, run):
    """@raises NoTrajectory"""
    folder = folder_of(root, run)
    for name, reader in (("trajectory.h5", read_h5md), ("trajectory.csv", read_csv)):
        if (folder / name).is_file():
            try:
                found = reader(folder / name)
                found.gravity, found.domain, found.shapes = scene_of(folder / "job.json")
                if not found.strobe:
                    found.strobe = corners_of(found)
                    found.position = found.strobe[-1].position if found.strobe else None
                return found
            except NoTrajectory:
                raise
            except (
                Exception
            ) as error:  # h5py and csv raise what they like on torn files: the page must say it and go on
                raise NoTrajectory(f"{run.folder}/{name} cannot be read: {error}") from error
    raise NoTrajectory(f"{run.folder}/trajectory.h5 is missing")


def corners_of(trajectory):
    """A few frames of a run that wrote bodies alone: the corners of its boxes and the middles of its balls."""
    bodies, times = trajectory.bodies, trajectory.body_times
    if not trajectory.shapes or not {"position", "orientation"} <= bodies.keys():
        return []
    frames = np.unique(np.linspace(0, len(times) - 1, 5).astype(int))
    return [
        Frame(
            float(times[f]),
            np.concatenate(
                [s.points(bodies["position"][f, s.row], bodies["orientation"][f, s.row]) for s in trajectory.shapes]
            ),
        )
        for f in frames
    ]


def scene_of(job):
    """(gravity, corners of the domain, shapes of the bodies) as the job says; a job that is not there or is torn says
    nothing."""
    try:
        scene = json.loads(job.read_text(encoding="utf-8"))["scene"]
        gravity = tuple(float(g) for g in scene["gravity"])
        corners = (
            [np.array([np.nan if v is None else float(v) for v in scene[key]]) for key in ("min", "max")]
            if scene.get("min") and scene.get("max")
            else None
        )
    except (OSError, ValueError, KeyError, TypeError):
        return (0.0, 0.0, 0.0), None, []
    whole = tuple(corners) if corners and all(c.shape == (3,) for c in corners) else None
    return gravity if len(gravity) == 3 else (0.0, 0.0, 0.0), whole, shapes_of(scene)


def read_h5md(path):
    try:
        import h5py
    except ImportError:
        raise NoTrajectory("Python has no h5py here: install python3-h5py to see trajectories") from None
    with h5py.File(path, "r") as file:
        particles = file.get("particles/all")
        if particles is None:
            raise NoTrajectory(f"{path.name} has no /particles/all")
        result = Trajectory(times=np.empty(0))
        position = particles.get("position/value")
        if position is not None and position.shape[0] > 0:
            result.times = np.asarray(particles["position/time"])[: position.shape[0]]
            if position.shape[1] > MOST_ROWS:
                raise NoTrajectory(f"{path.name} has {position.shape[1]} rows, more than a picture reads")
            frames = np.unique(np.linspace(0, position.shape[0] - 1, 5).astype(int))
            result.strobe = [
                Frame(
                    float(result.times[f]),
                    position[f],
                    *(at(particles, name, f, position.shape) for name in ("temperature", "phase", "material")),
                )
                for f in frames
            ]
            result.position = result.strobe[-1].position
            result.temperature = last(particles, "temperature", position.shape)
            result.temperature_error = last(particles, "temperature_error", position.shape)
            result.body = last(particles, "body", position.shape)
        read_bodies(file, result)
        observables = file.get("observables")
        for name in sorted(observables) if observables is not None else []:
            node = observables[name]
            if name.startswith("energy_") and "value" in node and node["value"].ndim == 1:
                step = max(1, node["value"].shape[0] // MOST_FRAMES)
                result.observables[name[len("energy_") :]] = (node["time"][::step], node["value"][::step])
    return result


def last(particles, name, shape):
    return at(particles, name, -1, shape)


def at(particles, name, frame, shape):
    """A column of one frame; None where there is none, or of other particles."""
    node = particles.get(f"{name}/value")
    if node is None or node.shape[0] == 0:
        return None
    values = np.asarray(node[min(frame, node.shape[0] - 1)] if node.ndim > 1 else node)
    return values if values.shape[0] == shape[1] else None


def read_bodies(file, result):
    node = file.get("particles/bodies/position/value")
    if node is None or node.ndim != 3 or 0 in node.shape:
        return
    step = max(1, node.shape[0] // MOST_FRAMES)
    times = file.get("particles/bodies/position/time")  # where bodies have none, the particles' own
    result.body_times = (times if times is not None else result.times[: node.shape[0]])[::step]
    for name in ("position", "orientation", "velocity", "angular_velocity"):
        values = file.get(f"particles/bodies/{name}/value")
        if values is not None and values.ndim == 3:
            result.bodies[name] = values[::step][: len(result.body_times)]


def read_csv(path):
    """Rows of one time follow each other; a column `body` means rows of bodies."""
    columns = columns_of(path)
    times = np.unique(columns["time"])
    key = "body" if "body" in columns else "id"
    rows = int(columns[key].max()) + 1
    if rows * len(times) > 4 * MOST_ROWS:
        raise NoTrajectory(f"{path.name} numbers its rows up to {rows}")
    frame, row = np.searchsorted(times, columns["time"]), columns[key].astype(int)

    def gather(names):
        values = np.full((len(times), rows, len(names)), np.nan)
        for k, name in enumerate(names):
            values[frame, row, k] = columns[name]
        return values

    result = Trajectory(times=times)
    if key == "body":
        result.bodies = {name: gather(names) for name, names in OF_BODIES.items() if columns.keys() >= {*names}}
        result.body_times = times
    else:
        warm = gather(("temperature",))[..., 0] if "temperature" in columns else None
        take_particles(result, gather(("x", "y", "z")), warm)
    return result


OF_BODIES = {
    "position": ("x", "y", "z"),
    "velocity": ("vx", "vy", "vz"),
    "orientation": ("qw", "qx", "qy", "qz"),
    "angular_velocity": ("wx", "wy", "wz"),
}


def columns_of(path):
    """{name: its column}, at most MOST_ROWS long"""
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        columns = {name: [] for name in reader.fieldnames or []}
        for count, row in enumerate(reader):
            if count > MOST_ROWS:
                raise NoTrajectory(f"{path.name} has more than {MOST_ROWS} rows")
            for name in columns:
                columns[name].append(float(row[name]))
    return {name: np.array(values) for name, values in columns.items()}


def take_particles(result, position, warm):
    """The last frame, and five frames of the whole time."""
    times = result.times
    frames = np.unique(np.linspace(0, len(times) - 1, 5).astype(int))
    result.strobe = [Frame(float(times[f]), position[f], None if warm is None else warm[f]) for f in frames]
    result.position = position[-1]
    result.temperature = None if warm is None else warm[-1]
