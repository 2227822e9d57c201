#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""An engine that flies one body along the exact parabola, and does one thing wrong: the word in FAKE says which."""

import json
import math
import os
import shutil
import signal
import sys
import time
from pathlib import Path

WRONG = os.environ.get("FAKE", "nothing")


def die():
    os.kill(os.getpid(), signal.SIGKILL)


def info():
    answer = {
        "contract": 1,
        "name": os.environ.get("FAKE_NAME", "fake"),
        "version": "1",
        "build": "python",
        "library": {"path": "", "hash": ""},
        "capabilities": ["rigid-free-flight", "gravity"],
        "presets": ["default"],
        "settings": {},
        "deterministic": True,
    }
    if WRONG == "slow info":
        time.sleep(60)
    if WRONG == "dies at info":
        die()
    if WRONG == "not there":
        answer.update(available=False, reason="its library is not installed")
    if WRONG == "deep info":
        print('{"contract": 1, "name": "fake", "settings": {"q": ' + '{"a":' * 400000 + "1" + "}" * 400000 + "}}")
        return
    print("{" if WRONG == "broken info" else json.dumps(answer))


def check():
    refused = WRONG == "refuses"
    if WRONG == "dies at check":
        die()
    if WRONG == "floods its answer":
        sys.stdout.write('{"can": true, "reason": "' + "x" * (5 << 20) + '"}')
        return
    if WRONG == "gives a number as its reason":
        print('{"can": false, "reason": 5}')
        return
    if WRONG == "gives an empty reason":
        print('{"can": false, "reason": ""}')
        return
    if WRONG == "leads its log elsewhere":
        (Path(sys.argv[2]).parent / "log.txt").symlink_to(os.environ["FAKE_VICTIM"])
    print(json.dumps({"can": not refused, "reason": "it has no conduction" if refused else ""}))


def turned(spin, t):
    """Orientation and spin of a body that turns at a constant rate."""
    rate = math.hypot(*spin)
    s = math.sin(0.5 * rate * t) / rate if rate > 0 else 0.0
    return [math.cos(0.5 * rate * t)] + [s * c for c in spin] + list(spin)


def flight(job, g, times):
    """Rows of the trajectory: time, body, position, velocity, orientation, spin."""
    rows = []
    for t in times:
        for body in job["scene"]["bodies"]:
            x, v = body["centre"], body["velocity"]
            rows.append(
                [t, body["index"]]
                + [x[k] + v[k] * t + 0.5 * g[k] * t * t for k in range(3)]
                + [v[k] + g[k] * t for k in range(3)]
                + turned(body["angular_velocity"], t)
            )
    return rows


def write(folder, rows):
    lines = ["time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz"] + [
        ",".join(repr(float(c)) if k != 1 else str(c) for k, c in enumerate(row)) for row in rows
    ]
    (folder / "trajectory.csv").write_text("\n".join(lines) + "\n")


def write_h5md(folder, times, rows):
    """One body of one particle as H5MD, whose velocities say that they are of other times than the places."""
    import h5py

    with h5py.File(folder / "trajectory.h5", "w") as file:
        file.create_group("h5md")
        for name, first, late in (("position", 2, 0.0), ("velocity", 5, 0.01)):
            group = file.create_group(f"particles/all/{name}")
            group["value"] = [[row[first : first + 3]] for row in rows]
            group["value"].attrs["unit"] = "m" if first == 2 else "m s-1"
            group["step"], group["time"] = range(len(times)), [t + late for t in times]


def result(folder, job, **changes):
    scene = job["scene"]
    bodies = [
        {"name": b["name"], "mass": b["mass"], "centre": b["centre"], "principal_inertia": b["principal_inertia"]}
        for b in scene["bodies"]
    ]
    answer = {
        "contract": 1,
        "status": "ok",
        "message": "",
        "time_reached": job["times"][-1],
        "steps": 1,
        "counters": {"pairs": 0, "iterations": 0},
        "seconds": {"setup_wall": 0, "setup_cpu": 0, "stepping_wall": 0, "stepping_cpu": 0},
        "state_hash": "",
        "readback": {"gravity": scene["gravity"], "time_step": 0, "precision": "double", "bodies": bodies},
        "divergence": None,
    }
    if WRONG == "holds another gravity":
        answer["readback"]["gravity"] = [1.01 * c for c in scene["gravity"]]
    if WRONG == "holds another mass":
        bodies[0]["mass"] *= 2.0
    answer.update(
        {
            "says OK": {"status": "OK"},
            "speaks contract 2": {"contract": 2},
            "ends at no time": {"time_reached": float("nan")},
            "says that it diverged": {"status": "diverged"},
        }.get(WRONG, {})
    )
    answer.update(changes)
    (folder / "result.json").write_text("{" if WRONG == "torn result" else json.dumps(answer))


ROWS = {  # the whole trajectory with the wrong thing in it
    "stops early": lambda rows, times: rows[: len(rows) // 2],
    "shows no frame": lambda rows, times: [],
    "frozen": lambda rows, times: [[t] + rows[0][1:] for t in times],
    "not a number": lambda rows, times: [[row[0], row[1]] + [float("nan")] * 6 + row[8:] for row in rows],
    "millimetres": lambda rows, times: [row[:2] + [1e3 * c for c in row[2:8]] + row[8:] for row in rows],
    "says everything twice": lambda rows, times: [row[:4] + [row[4] + 1.0] + row[5:] for row in rows] + rows,
    "shifted time axis": lambda rows, times: [[row[0] + 0.01 * times[-1]] + row[1:] for row in rows],
    "leaves a frame out": lambda rows, times: rows[: len(rows) // 2] + rows[len(rows) // 2 + 1 :],
}
CELLS = {  # one wrong value: whether in the middle row, else the last; column, value
    "one value is not a number": (True, 3, float("nan")),
    "one value is infinite": (False, 2, float("inf")),
    "a time is not a number": (True, 0, float("nan")),
    "names a body that is not there": (False, 1, 1),
    "names a body below the first": (False, 1, -1),
    "names half a body": (False, 1, 0.5),
}


def spoil(rows, times):
    """The trajectory with the wrong thing in it."""
    if WRONG in CELLS:
        middle, column, value = CELLS[WRONG]
        rows[len(rows) // 2 if middle else -1][column] = value
    return ROWS[WRONG](rows, times) if WRONG in ROWS else rows


def pipe(file):
    file.unlink()
    os.mkfifo(file)


def leave_trajectory(folder, trajectory):
    """A hostile engine's trajectory in place of the one that it was asked for."""
    if WRONG == "leaves a pipe as trajectory":
        pipe(trajectory)
    if WRONG == "leaves an endless trajectory":
        trajectory.unlink()
        trajectory.symlink_to("/dev/zero")
    if WRONG == "leaves a trajectory of 10 GB":
        os.truncate(trajectory, 10 << 30)
    if WRONG == "leaves a trajectory that is broken within":
        trajectory.unlink()
        shutil.copy(Path(__file__).with_name("kills-hdf5.h5"), folder / "trajectory.h5")
    if WRONG == "names a column twice":
        trajectory.write_text(trajectory.read_text().replace(",wz", ",x"))
    if WRONG == "leaves half a line":
        trajectory.write_text(trajectory.read_text()[:-60])
    if WRONG == "leaves half of an H5MD file":
        os.truncate(folder / "trajectory.h5", (folder / "trajectory.h5").stat().st_size // 2)
    if WRONG == "numbers its particles past the last":
        trajectory.write_text("time,id,x,y,z,vx,vy,vz\n0,27,0,0,0,0,0,0\n")
    if "link" in WRONG:
        other = next(
            path
            for path in sorted(folder.parents[1].glob("*/*/trajectory.csv"))
            if path.parent != folder.resolve() and "mine" not in path.parts
        )
        trajectory.unlink()
        (os.link if WRONG.startswith("hard") else os.symlink)(other.resolve(), trajectory)


def leave_result(folder, trajectory):
    """A hostile engine's answer, and how it ends."""
    answer = folder / "result.json"
    if WRONG == "leaves a pipe as result":
        pipe(answer)
    if WRONG == "leaves a deep result":
        answer.write_text(answer.read_text()[:-1] + ', "extra": ' + '{"a":' * 400000 + "1" + "}" * 400000 + "}")
    if WRONG == "leaves a folder as result":
        answer.unlink()
        answer.mkdir()
    if WRONG == "leaves half a result":
        answer.write_text(answer.read_text()[:100])
        die()
    if WRONG == "leaves files of other years":
        for file, year in ((trajectory, 0), (answer, 4e9)):
            os.utime(file, (year, year))
    if WRONG == "dies after its result":
        die()
    if WRONG == "takes all runs away":
        shutil.rmtree(folder.parents[1])


def misbehave(folder, job):
    """What a hostile engine does in place of a run, or before it."""
    if WRONG == "dies at once":
        die()
    if WRONG == "hangs":
        time.sleep(600)
    if WRONG == "stops itself":
        os.kill(os.getpid(), signal.SIGSTOP)
    if WRONG == "hides among its parents and hangs":
        os.setpgid(0, os.getpgid(os.getppid()))
        time.sleep(600)
    if WRONG == "closes its streams":
        for stream in (0, 1, 2):
            os.close(stream)
    if WRONG == "floods":
        for _ in range(2000):
            sys.stderr.write("an engine that will not be quiet\n" * 1000)
    if WRONG == "ends with an error":
        sys.stderr.write("ERROR: Unrecognized fix style 'rigid' is part of the RIGID package (src/modify.cpp:899)\n")
        sys.exit(1)
    if WRONG == "diverges":
        place = {"particle": 3, "body": -1, "field": "velocity", "stage": "kick", "time": 0.1}
        result(folder, job, status="diverged", message="blew up", time_reached=0.1, divergence=place)
        sys.exit(7)


def run(path):
    try:
        job = json.loads(Path(path).read_text())
        times, gravity = job["times"], job["scene"]["gravity"]
    except (OSError, ValueError, KeyError):
        sys.exit(2)
    folder = Path(path).parent / job["output"]
    if WRONG == "writes into the particles":
        with (Path(path).parent / job["particles"]).open("ab") as particles:
            particles.write(b"more")
    if WRONG == "leaves no result":
        return
    if WRONG == "leaves a result alone":
        return result(folder, job)
    misbehave(folder, job)
    g = [(1.01 if WRONG == "one per cent of gravity" else 1.0) * c for c in gravity]
    if WRONG == "knows which way is up":
        g[2] *= 1.01
    rows = flight(job, g, times)
    if WRONG == "is killed":
        write(folder, rows[:2])
        die()
    write(folder, spoil(rows, times))
    if WRONG in ("columns of other times", "leaves half of an H5MD file"):
        write_h5md(folder, times, rows)
    result(folder, job)
    leave_trajectory(folder, folder / "trajectory.csv")
    leave_result(folder, folder / "trajectory.csv")
    if WRONG == "says ok and exits 3":
        sys.exit(3)


if __name__ == "__main__":
    {"--info": info, "--check": check, "--run": lambda: run(sys.argv[2])}[sys.argv[1]]()
