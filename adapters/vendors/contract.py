# SPDX-License-Identifier: BSD-3-Clause
"""The contract of an engine (docs/engines.md): the three calls, the job, the trajectory, and the result by rename.

An adapter is a class of `Engine` and one line, `sys.exit(serve(MyEngine(), sys.argv[1:]))`. Only the standard library
is used, because each engine runs in an environment of its own."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import sys
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

Row = Sequence[float]  # of trajectory.csv
DONE, BAD_JOB, REFUSED, DIVERGED = 0, 2, 4, 7  # exit codes of --run

BODY_COLUMNS = (
    "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz"  # s, -, m, m/s, quaternion (w, x, y, z), rad/s in the world frame
)
PARTICLE_COLUMNS = "time,id,x,y,z,vx,vy,vz"  # s, -, m, m/s
HEAT_COLUMNS = "time,id,x,y,z,vx,vy,vz,temperature"  # s, -, m, m/s, K


class BadJob(Exception):
    """The job breaks the contract: exit code 2."""


class Diverged(Exception):
    """The engine's state is no longer finite: exit code 7."""

    def __init__(self, message: str, body: int, time_: float) -> None:
        super().__init__(message)
        self.body = body
        self.time = time_  # [s]


@dataclass(frozen=True)
class Job:
    """JOB.json, read and checked. Units are SI."""

    document: dict[str, Any]
    path: Path
    scene: dict[str, Any]
    bodies: list[dict[str, Any]]
    times: list[float]  # output times, rising [s]
    preset: str
    settings: dict[str, Any]
    time_step: float | None  # of the scene or of a study; None = the engine's own choice [s]

    @property
    def folder(self) -> Path:
        """Where trajectory and result go."""
        return self.path.parent / self.document["output"]

    @property
    def gauges(self) -> list[dict[str, Any]]:
        """metric, quantity, body, where: what the case asks for at a point, or of a body or region."""
        return self.document.get("gauges") or []

    @property
    def particles(self) -> Path:
        return self.path.parent / self.document["particles"]


def read_job(path: str) -> Job:
    """@raise BadJob naming what is missing"""
    try:
        document = json.loads(Path(path).read_text(encoding="utf-8"))
        if document["contract"] != 1:
            raise BadJob(f"contract {document['contract']}, expected 1")
        times = [float(t) for t in document["times"]]
        if not times or times != sorted(times):
            raise BadJob("times must rise, and there must be one at least")
        scene = document["scene"]
        step = document["resolution"].get("time_step")
        preset, settings = document.get("preset") or "default", document.get("settings") or {}
        return Job(
            document,
            Path(path).resolve(),
            scene,
            scene["bodies"],
            times,
            preset,
            settings,
            None if step is None else float(step),
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise BadJob(f"{path}: {error!r}") from error


@dataclass
class Outcome:
    """What a run leaves beside its trajectory."""

    steps: int = 0
    pairs: float = 0.0  # contact points or elements that were worked on, summed over steps
    iterations: float = 0.0
    readback: dict[str, Any] = field(
        default_factory=dict
    )  # gravity, time_step, precision, bodies: as the engine itself holds them
    setup_cpu: float = 0.0  # [s]
    state_hash: str = ""


class Engine(ABC):
    """One engine: five answers. `presets`, `preset_words` and `settings` are in the vendor's own words."""

    name: str
    capabilities: tuple[str, ...]
    presets: tuple[str, ...]
    preset_words: dict[str, str] = {}  # preset -> a short quotation of the vendor on it, and where it stands
    settings: dict[str, str] = {}
    precision = "double"
    deterministic = True

    @abstractmethod
    def version(self) -> str:
        """Release of the engine itself."""

    @abstractmethod
    def library(self) -> Path | None:
        """The file that holds the engine's code."""

    @abstractmethod
    def refusal(self, job: Job) -> str:
        """Why this job cannot be run honestly; "" if it can."""

    @abstractmethod
    def run(self, job: Job) -> Outcome:
        """Runs the job and writes trajectory.csv into its folder. @raise Diverged"""

    def build(self) -> str:
        return f"Python {platform.python_version()}, {self.precision} precision, adapter {adapter_hash()[:12]}"

    def info(self) -> dict[str, Any]:
        library = self.library()
        held = {"path": str(library or ""), "hash": file_hash(library) if library else ""}
        return {
            "contract": 1,
            "name": self.name,
            "version": self.version(),
            "build": self.build(),
            "library": held,
            "capabilities": list(self.capabilities),
            "presets": list(self.presets),
            "preset_words": self.preset_words,
            "settings": self.settings,
            "deterministic": self.deterministic,
        }


def file_of(package: str, wanted: Callable[[str], bool]) -> Path | None:
    """The first file of an installed package whose name, without folders, is wanted."""
    files = distribution(package).files or []
    return next((Path(str(f.locate())) for f in files if wanted(f.name)), None)


def file_hash(path: Path) -> str:
    """SHA-256 of a file, as hex digits."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def adapter_hash() -> str:
    """SHA-256 of the files of this folder: a run by another adapter is not kept by `validate --resume`."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).resolve().parent.iterdir()):
        if path.suffix in (".py", ".mjs"):
            digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()


def write_trajectory(job: Job, columns: str, rows: Iterable[Row]) -> str:
    """Writes trajectory.csv. @return SHA-256 of its text"""
    digest = hashlib.sha256()
    with open(job.folder / "trajectory.csv", "w", encoding="ascii") as out:
        out.write(columns + "\n")
        for row in rows:
            line = ",".join(map(repr, row)) + "\n"
            digest.update(line.encode())
            out.write(line)
    return digest.hexdigest()


def write_gauges(job: Job, rows: Iterable[Row]) -> str:
    """Writes gauges.csv: time [s], number of the gauge in `job.gauges`, value [SI]. @return SHA-256 of its text"""
    text = "time,gauge,value\n" + "".join(f"{time_!r},{number},{value!r}\n" for time_, number, value in rows)
    (job.folder / "gauges.csv").write_text(text, encoding="ascii")
    return hashlib.sha256(text.encode()).hexdigest()


def write_result(job: Job, result: dict[str, Any]) -> None:
    """The engine's last act, by rename: without it the run counts as killed."""
    part = job.folder / "result.json.part"
    with open(part, "w", encoding="utf-8") as out:
        json.dump(result, out)
        out.flush()
        os.fsync(out.fileno())
    os.rename(part, job.folder / "result.json")


def _result(
    status: str, message: str, time_reached: float, outcome: Outcome, spent: tuple[float, float]
) -> dict[str, Any]:
    """@param spent wall and CPU seconds of the whole run"""
    stepping_cpu = max(0.0, spent[1] - outcome.setup_cpu)
    return {
        "contract": 1,
        "status": status,
        "message": message,
        "time_reached": time_reached,
        "steps": outcome.steps,
        "counters": {"pairs": outcome.pairs, "iterations": outcome.iterations},
        "seconds": {
            "setup_wall": 0.0,
            "setup_cpu": outcome.setup_cpu,
            "stepping_wall": spent[0],
            "stepping_cpu": stepping_cpu,
        },
        "state_hash": outcome.state_hash,
        "readback": outcome.readback,
        "divergence": None,
    }


def _refusal(engine: Engine, job: Job) -> str:
    """What no vendor's adapter takes, then what this engine refuses."""
    if any(material.get("surface_temperature") for material in job.scene["materials"]):
        return f"{engine.name} is not told to hold the temperature of a surface (surface_temperature)"
    return engine.refusal(job)


def _run(engine: Engine, job: Job) -> int:
    reason = _refusal(engine, job)
    nothing = Outcome(readback={"gravity": job.scene["gravity"], "bodies": []})
    if reason:
        write_result(job, _result("refused", reason, 0.0, nothing, (0.0, 0.0)))
        return REFUSED
    wall, cpu = time.perf_counter(), time.process_time()
    try:
        outcome = engine.run(job)
    except Diverged as end:
        result = _result("diverged", str(end), end.time, nothing, (0.0, 0.0))
        result["divergence"] = {
            "particle": -1,
            "body": end.body,
            "field": "position",
            "stage": "step",
            "time": end.time,
        }
        write_result(job, result)
        return DIVERGED
    write_result(
        job, _result("ok", "", job.times[-1], outcome, (time.perf_counter() - wall, time.process_time() - cpu))
    )
    return DONE


def _answer(document: dict[str, Any]) -> int:
    print(json.dumps(document))
    return DONE


def serve(engine: Engine, words: Sequence[str]) -> int:
    """Answers one call. @return the process's exit code"""
    verb, path = (list(words) + ["", ""])[:2]
    try:
        if verb == "--info":
            return _answer(engine.info())
        if verb == "--check":
            reason = _refusal(engine, read_job(path))
            return _answer({"can": not reason, "reason": reason})
        if verb == "--run":
            return _run(engine, read_job(path))
        raise BadJob("--info, --check JOB.json or --run JOB.json")
    except BadJob as error:
        print(f"engine-{engine.name}: bad job: {error}", file=sys.stderr)
        return BAD_JOB
