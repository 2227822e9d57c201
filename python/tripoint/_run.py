# SPDX-License-Identifier: BSD-3-Clause
"""One run: its end, its metrics, and its fields as arrays."""

from __future__ import annotations

import importlib.util
import json
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

from ._program import call, share, words_of


@lru_cache
def reader():
    """The reader that the program's own exports use: reports/exports/run.py beside the program."""
    path = share() / "reports" / "exports" / "run.py"
    spec = importlib.util.spec_from_file_location("tripoint._reader", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


class Run:
    """A run on the disk. Arrays are numpy's, SI, and read when they are asked for.

    run["temperature"] or run.field("temperature"): (frames, particles); rows that are not alive are NaN, integers -1.
    run.field(name, frame): one frame of it. run.frame(n): the living particles of one frame.
    run.body(name): (frames, bodies[, 3]); run.observable(name): (frames,).
    fields, bodies, observables: {name: unit}; times [s]; metrics: {name: {"value", "uncertainty"}}; folder; status.
    """

    def __init__(self, folder, said=None):
        self.folder = Path(folder)
        self._file = reader().Run(self.folder)
        said = said or {}
        self.status = said.get("status") or self._file.result.get("status", "")
        self.metrics = said.get("metrics", {})
        self.cost = said.get("cost", {})
        self.steps = said.get("steps", self._file.result.get("steps"))
        self.times = self._file.times
        self.fields, self.bodies, self.observables = self._file.fields, self._file.bodies, self._file.observables
        self.job = self._file.job

    def __getitem__(self, name):
        return self._file.field(name)

    def __len__(self):
        return len(self._file)

    def __repr__(self):
        rows = self._file.dataset("particles/all/position/value").shape[1]
        return (
            f"<Run {self.folder}: {self.status}, {len(self)} frames to {self.times[-1]:g} s, {rows} particles, "
            f"fields {', '.join(self.fields)}>"
        )

    def field(self, name, frame=None):
        return self._file.field(name, frame)

    def body(self, name, frame=None):
        return self._file.body(name, frame)

    def body_names(self):
        return self._file.body_names()

    def observable(self, name):
        return self._file.observable(name)

    def frame(self, number):
        return self._file.frame(range(len(self))[number])

    def frames(self):
        return self._file.frames()

    def export(self, *formats, out=None, frames="all"):
        """Files for other programs. @return their paths"""
        return [
            Path(name)
            for name in json.loads(
                call(["export", self.folder, "--json", *words_of({"to": list(formats), "out": out, "frames": frames})])
            )["files"]
        ]

    def view(self, out=None, limit=None):
        """A page with the particles in three dimensions, for any browser. @param limit its greatest size [MB]   @return
        its path"""
        call(["view", self.folder, *words_of({"out": out, "limit": limit})])
        return Path(out) if out else Path(self.folder, "view.html")

    def plot(self, name="kinetic", axis=None):
        """A term of the energy, or any other observable, in time. @return matplotlib's axes"""
        import matplotlib.pyplot as plt

        key = name if name in self.observables else f"energy_{name}"
        axis = axis or plt.subplots()[1]
        axis.plot(self.times, self.observable(key), label=name)
        axis.set_xlabel("time [s]")
        axis.set_ylabel(f"{name} [{self.observables[key]}]")
        return axis

    def close(self):
        self._file.close()


def run(case, out=None, quiet=True, **options):
    """Runs a case: an id, or a case file. Options are those of `tripoint run`: engine, threads, until,
    set={"scene.spacing": "1 mm"}, resume, ...

    Without `out` the run lies in a folder for temporary files. @return Run. @raises ProgramError with the program's own
    sentence"""
    folder = Path(out) if out else Path(tempfile.mkdtemp(prefix="tripoint-run-"))
    said = call(["run", case, "--json", "--out", folder, *words_of(options)], quiet)
    return Run(folder, json.loads(said))


def read_run(folder):
    """A run that is on the disk."""
    return Run(folder)
