# SPDX-License-Identifier: BSD-3-Clause
"""A run as arrays: trajectory.h5 with the job and the result beside it. docs/trajectory.md says what each array holds.

This file needs numpy and h5py alone, and of this room foreign.py alone, by its place: the Python package reads runs by
it too."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from pathlib import Path

import numpy as np

foreign = SourceFileLoader("tripoint_foreign", str(Path(__file__).resolve().parent.parent / "foreign.py")).load_module()

NEEDED = ("position", "velocity")  # of particles/all; what is not there cannot be drawn or handed on


class NotARun(Exception):
    """What was named is no run, or its file is torn; the message is a sentence that names the file."""


class MissingDataset(NotARun):
    """The file lacks a dataset that was asked for."""


class Frame:
    """The particles that are alive at one time. A field is an array of one row a particle, by its name."""

    def __init__(self, run, number):
        self.number, self.time, self.step = number, float(run.times[number]), int(run.steps[number])
        everything = {name: run.field(name, number) for name in run.fields}
        sound = np.isfinite(everything["position"]).all(axis=1)
        if "id" in everything:
            sound &= everything["id"] >= 0
        self.row = np.flatnonzero(sound)  # the particle's row in trajectory.h5, the same in every frame
        self.fields = {name: values[sound] for name, values in everything.items()}

    def __getitem__(self, name):
        return self.fields[name]

    def __len__(self):
        return len(self.row)


class Run:
    """One run's trajectory. Use it as a context, or close() it.

    times [s], steps: one number a frame; fields, bodies, observables: {name: unit}; job, result: what job.json and
    result.json hold, or {}. @raises NotARun, MissingDataset"""

    def __init__(self, folder):
        self.path = trajectory_of(Path(folder))
        self.folder = self.path.parent
        try:
            import h5py

            self.file = h5py.File(self.path, "r")
        except ImportError:
            raise NotARun("Python has no h5py here: install the Debian package python3-h5py, or h5py by pip") from None
        except OSError as error:
            raise NotARun(f"{self.path}: is no readable HDF5 file ({error})") from None
        for name in NEEDED:
            self.dataset(f"particles/all/{name}/value")
        self.times = self.dataset("particles/all/position/time")[()]
        self.steps = self.dataset("particles/all/position/step")[()]
        frames = min(
            [len(self.times), len(self.steps)] + [node.shape[0] for node in self.elements("particles/all").values()]
        )
        self.times, self.steps = (
            self.times[:frames],
            self.steps[:frames],
        )  # a run that was killed may have begun a frame
        self.fields, self.bodies, self.observables = (
            self.units(group) for group in ("particles/all", "particles/bodies", "observables")
        )
        self.job, self.result = (self.document(name) for name in ("job.json", "result.json"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.file.close()

    def __len__(self):
        return len(self.times)

    def document(self, name):
        """job.json or result.json; {} where there is none. @raises NotARun where it is torn"""
        try:
            return foreign.read(self.folder / name)
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as error:
            raise NotARun(f"{self.folder / name}: cannot be read ({error})") from None

    def dataset(self, path):
        """@raises MissingDataset"""
        import h5py

        node = self.file.get(path)
        if not isinstance(node, h5py.Dataset):
            raise MissingDataset(f"{self.path}: has no dataset /{path}")
        return node

    def elements(self, group):
        """{name: dataset of its values} of the elements that have frames."""
        import h5py

        found = self.file.get(group)
        names = sorted(found) if found is not None else []
        nodes = {name: found[name].get("value") for name in names if isinstance(found[name], h5py.Group)}
        return {name: node for name, node in nodes.items() if isinstance(node, h5py.Dataset)}

    def units(self, group):
        return {name: text(node.attrs.get("unit", "")) for name, node in self.elements(group).items()}

    def read(self, path, frame):
        """Values of one frame, or of all. A frame is a number or a slice. @raises MissingDataset, NotARun where the
        disk's copy is damaged"""
        node = self.dataset(path)
        try:
            return node[: len(self)] if frame is None else node[frame]
        except OSError as error:
            raise NotARun(f"{self.path}: /{path} is damaged ({error})") from None

    def field(self, name, frame=None):
        """particles/all/NAME: (frames, rows[, 3]), or (rows[, 3]) of one frame. Rows that are not alive are NaN, or
        -1."""
        return self.read(f"particles/all/{name}/value", frame)

    def body(self, name, frame=None):
        """particles/bodies/NAME, likewise: a row a solid body that ever existed."""
        return self.read(f"particles/bodies/{name}/value", frame)

    def observable(self, name):
        """observables/NAME: (frames,) or (frames, 3)."""
        return self.read(f"observables/{name}/value", None)

    def __getitem__(self, name):
        return self.field(name)

    def frame(self, number):
        return Frame(self, number)

    def frames(self, numbers=None):
        """Frame after frame, so that a long run need not fit into memory."""
        for number in range(len(self)) if numbers is None else numbers:
            yield Frame(self, number)

    def body_names(self):
        """A name for each row of bodies: the case's, then "born 1", "born 2" of those that a split or freezing made."""
        node = self.elements("particles/bodies").get("position")
        rows = node.shape[1] if node is not None else 0
        names = {}
        for body in self.scene().get("bodies") or []:
            if isinstance(body.get("index"), int) and body.get("index") >= 0:
                names[body["index"]] = str(body.get("name", ""))
        born = iter(range(1, rows + 1))
        return [names.get(row) or f"born {next(born)}" for row in range(rows)]

    def scene(self):
        return self.job.get("scene") or {}

    def box(self):
        """(least corner, greatest corner, periodic directions) [m]: of the domain where the scene has one, else around
        all particles."""
        scene = self.scene()
        periodic = np.array([axis in (scene.get("periodic") or []) for axis in "xyz"])
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for number in range(len(self)):
            place = self.field("position", number)
            place = place[np.isfinite(place).all(axis=1)]
            if len(place):
                low, high = np.minimum(low, place.min(axis=0)), np.maximum(high, place.max(axis=0))
        for key, corner, outer in (("min", low, np.minimum), ("max", high, np.maximum)):
            for axis, value in enumerate(scene.get(key) or []):
                if value is not None and np.isfinite(value):
                    corner[axis] = value if periodic[axis] else outer(corner[axis], value)
        nothing = ~np.isfinite(low)
        low[nothing], high[nothing] = 0.0, 0.0
        return low, high, periodic


def text(value):
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def trajectory_of(path):
    """trajectory.h5 of a run's folder, or the file itself. @raises NotARun that says what is there instead"""
    if path.is_file():
        if path.suffix == ".json":
            raise NotARun(f"{path}: is no run. Particles are exported from a run's folder, which has a trajectory.h5")
        return path
    if not path.exists():
        raise NotARun(f"{path}: there is no such file or folder")
    if (path / "trajectory.h5").is_file():
        return path / "trajectory.h5"
    if (path / "trajectory.csv").is_file():
        raise NotARun(
            f"{path}: its engine wrote trajectory.csv, which is a table of text already; only trajectory.h5 is exported"
        )
    if (path / "results.json").is_file():
        raise NotARun(f"{path}: is a report. Name the folder of one of its runs, below {path / 'runs'}")
    raise NotARun(f"{path}: has no trajectory.h5. `tripoint run CASE --out DIR` leaves one in DIR")
