# SPDX-License-Identifier: BSD-3-Clause
"""Jobs for the tests of the adapters, as the harness writes them, and how one is run."""

import csv
import json
import subprocess
import tempfile
from pathlib import Path

CUBE = {
    "name": "cube",
    "index": 0,
    "material": "stuff",
    "phase": "rigid",
    "motion": "free",
    "keyframes": [],
    "temperature_held": False,
    "mass": 8.0,
    "centre": [0.5, 0.0, 1.0],
    "principal_inertia": [1.0, 2.0, 2.5],
    "principal_axes": [1.0, 0.0, 0.0, 0.0],
    "orientation": [1.0, 0.0, 0.0, 0.0],
    "velocity": [1.0, 0.0, 3.0],
    "angular_velocity": [0.0, 0.0, 0.0],
    "temperature": None,
    "shape": {"kind": "box", "min": [0.3, -0.2, 0.9], "max": [0.7, 0.2, 1.1]},
    "slip": "no",
    "joins": False,
    "joined_to": [],
}


def body(**changes):
    return {**CUBE, **changes}


def floor(**changes):
    return body(
        **{
            "name": "floor",
            "index": 1,
            "motion": "fixed",
            "centre": [0.0, 0.0, -0.5],
            "velocity": [0.0, 0.0, 0.0],
            "shape": {"kind": "half_space", "point": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0]},
            **changes,
        }
    )


def job(bodies, times=(0.0, 0.5, 1.0), time_step=0.01, preset="default", settings=None, **scene):
    whole = {
        "mode": "corrected",
        "gravity": [0.0, 0.0, -9.81],
        "periodic": [],
        "inflows": [],
        "events": [],
        "bodies": bodies,
        "spacing": 0.1,
        "jitter": 0.0,
        "materials": [{"name": "stuff", "t_melt": None}],
    }
    return {
        "contract": 1,
        "case": "test",
        "scene": {**whole, **scene},
        "particles": "particles.h5",
        "resolution": {"time_step": time_step},
        "preset": preset,
        "settings": settings or {},
        "times": list(times),
        "output": ".",
    }


class Ended:
    """A run that has ended: exit code, result.json and the rows of trajectory.csv, as numbers by column."""

    def __init__(self, code, folder, log):
        self.code, self.log = code, log
        result = folder / "result.json"
        self.result = json.loads(result.read_text()) if result.exists() else None
        rows = folder / "trajectory.csv"
        lines = rows.read_text().splitlines() if rows.exists() else []
        self.rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def run(command, document, environment=None):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "job.json").write_text(document if isinstance(document, str) else json.dumps(document))
        end = subprocess.run(
            [*command, "--run", str(folder / "job.json")],
            capture_output=True,
            text=True,
            timeout=120,
            env=environment,
            check=False,
        )
        return Ended(end.returncode, folder, end.stderr)


def check(command, document, environment=None):
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "job.json"
        path.write_text(json.dumps(document))
        end = subprocess.run(
            [*command, "--check", str(path)], capture_output=True, text=True, timeout=120, env=environment, check=False
        )
        return json.loads(end.stdout)
