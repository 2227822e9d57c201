# SPDX-License-Identifier: BSD-3-Clause
"""trajectory.h5 (H5MD 1.1, docs/trajectory.md) of an engine whose particles are the job's: liquid, walls and free
bodies."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

from contract import Job


class Frame(NamedTuple):
    """One output time. Columns are by particle of the job."""

    time: float  # [s]
    position: Any  # (n, 3) [m]
    velocity: Any  # (n, 3) [m/s]
    density: Any  # (n,) [kg/m3]
    pressure: Any  # (n,) [Pa]
    # of the free bodies in the order of the job, none at the start: centre [m], turn (w, x, y, z) from the start,
    # velocity [m/s], spin [rad/s]
    poses: list[tuple[Any, Any, Any, Any]]


def turned(turn: Any, arms: Any) -> Any:
    """Vectors (n, 3) turned by a unit quaternion (w, x, y, z)."""
    import numpy as np

    axis = np.array(turn[1:])
    across = np.cross(axis, arms)
    return arms + 2.0 * (turn[0] * across + np.cross(axis, across))


class Bodies:
    """Rows of the job's solid bodies: those that stand still, and those that move with their particles."""

    def __init__(self, job: Job, start: dict[str, Any]) -> None:
        import numpy as np

        self.np, self.start = np, start
        self.solid = sorted((body for body in job.bodies if body["index"] >= 0), key=lambda body: body["index"])
        self.free = [
            next(k for k, row in enumerate(self.solid) if row is body)
            for body in job.bodies
            if body["phase"] == "rigid" and body["motion"] == "free"
        ]

    def place(self, frame: Frame) -> dict[str, Any]:
        """Columns of /particles/bodies; the free bodies' particles are moved in `frame` itself."""
        np, count = self.np, len(self.solid)
        rows = {
            "position": np.array([body["centre"] for body in self.solid]).reshape(count, 3),
            "velocity": np.array([body["velocity"] for body in self.solid]).reshape(count, 3),
            "angular_velocity": np.array([body["angular_velocity"] for body in self.solid]).reshape(count, 3),
            "orientation": np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
            "mass": np.array([body["mass"] for body in self.solid]),
        }
        for k, (centre, turn, velocity, spin) in zip(self.free, frame.poses):
            own = self.start["body"] == self.solid[k]["index"]
            arms = turned(turn, self.start["position"][own] - rows["position"][k])
            frame.position[own], frame.velocity[own] = centre + arms, velocity + np.cross(spin, arms)
            rows["position"][k], rows["orientation"][k] = centre, turn
            rows["velocity"][k], rows["angular_velocity"][k] = velocity, spin
        return rows


UNITS = {
    "position": "m",
    "velocity": "m s-1",
    "angular_velocity": "rad s-1",
    "orientation": "1",
    "mass": "kg",
    "density": "kg m-3",
    "pressure": "Pa",
}


def write_frames(path: Path, job: Job, start: dict[str, Any], frames: Iterable[Frame]) -> None:
    """Frames go to the file as they come."""
    import h5py
    import numpy as np

    bodies, count = Bodies(job, start), len(start["mass"])
    fixed = {
        "mass": start["mass"],
        "id": np.arange(count),
        "phase": start["phase"],
        "body": start["body"],
        "material": start["material"],
    }
    with h5py.File(path, "w") as file:
        file.create_group("h5md").attrs["version"] = np.array([1, 1], dtype="i4")
        file.create_group("h5md/author").attrs["name"] = "tripoint"
        file.create_group("h5md/creator").attrs.update({"name": "engine-splishsplash", "version": "1"})

        def append(name: str, value: Any, unit: str) -> None:
            value = np.asarray(value)
            if name not in file:
                kind = "i4" if value.dtype.kind == "i" else "f8"
                made = file.create_dataset(
                    name,
                    (0, *value.shape),
                    kind,
                    maxshape=(None, *value.shape),
                    chunks=(1, *(max(1, n) for n in value.shape)),
                    fletcher32=True,
                )
                if unit:
                    made.attrs["unit"] = unit
            data = file[name]
            data.resize(data.shape[0] + 1, axis=0)
            data[-1] = value

        for number, frame in enumerate(frames):
            rows = bodies.place(frame)
            append("particles/all/position/step", number, "")
            append("particles/all/position/time", float(frame.time), "s")
            for name in ("position", "velocity", "density", "pressure"):
                append(f"particles/all/{name}/value", getattr(frame, name), UNITS[name])
            for name, value in fixed.items():
                append(f"particles/all/{name}/value", value, UNITS.get(name, ""))
            for name, value in rows.items() if bodies.solid else ():
                append(f"particles/bodies/{name}/value", value, UNITS[name])
            file.flush()
