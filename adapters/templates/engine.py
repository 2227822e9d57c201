#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""engine-@NAME@: an engine of tripoint, one process a run. Put its folder on TRIPOINT_ENGINE_PATH and ask
`tripoint engine check PATH`. Everything in JOB.json is SI; the particles are in the job's particles.h5 (H5MD)."""
import json, os, sys

INFO = {"contract": 1, "name": "@NAME@", "version": "1", "build": "", "library": {"path": os.path.abspath(__file__), "hash": ""},
        "capabilities": ["rigid-free-flight", "gravity"], "presets": ["default"], "settings": {}, "deterministic": True}
HEADER = "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz"  # of particles: time,id,x,y,z,vx,vy,vz[,temperature]

def refusal(job):
    """Why this engine cannot run the job honestly; "" if it can. A refusal is a row of the report, not an error."""
    scene = job["scene"]
    if scene["events"] or any(b["phase"] != "rigid" or b["motion"] != "free" or b["temperature"] for b in scene["bodies"]):
        return "only free rigid bodies, without heat and events"
    if any(any(b["angular_velocity"]) for b in scene["bodies"]):
        return "no rotation yet"
    return ""

def solve(job):
    """Rows of trajectory.csv: one a body and output time. Here a body without spin follows its parabola: put your engine in its place."""
    g = job["scene"]["gravity"]
    for body in job["scene"]["bodies"]:
        for t in job["times"]:
            x = [c + v * t + a * t * t / 2 for c, v, a in zip(body["centre"], body["velocity"], g)]
            v = [v + a * t for v, a in zip(body["velocity"], g)]
            yield [t, body["index"], *x, *v, 1.0, 0.0, 0.0, 0.0, *body["angular_velocity"]]

def read_job(path):
    with open(path) as file:
        job = json.load(file)
    if job["contract"] != 1 or not job["times"] or job["times"] != sorted(job["times"]):
        raise ValueError("contract 1 and rising times are needed")
    return job, os.path.join(os.path.dirname(os.path.abspath(path)), job["output"])

def run(path):
    job, folder = read_job(path)
    reason = refusal(job)
    if not reason:
        with open(os.path.join(folder, "trajectory.csv"), "w") as out:
            out.write(HEADER + "\n")
            out.writelines(",".join(map(repr, row)) + "\n" for row in solve(job))
    # Gravity, step and bodies as the engine itself holds them: the harness compares them with the job.
    held = {"gravity": job["scene"]["gravity"], "time_step": 0.0, "precision": "double", "bodies": []}
    result = {"contract": 1, "status": "refused" if reason else "ok", "message": reason, "time_reached": 0.0 if reason else job["times"][-1], "readback": held}
    with open(os.path.join(folder, "result.json.part"), "w") as out:
        json.dump(result, out)
    os.rename(os.path.join(folder, "result.json.part"), os.path.join(folder, "result.json"))  # the last act
    return 4 if reason else 0

def main(verb="", path=""):
    if verb == "--info":
        print(json.dumps(INFO))
        return 0
    if verb == "--check":
        reason = refusal(read_job(path)[0])
        print(json.dumps({"can": not reason, "reason": reason}))
        return 0
    if verb == "--run":
        return run(path)
    raise ValueError("--info, --check JOB.json or --run JOB.json")

try:
    code = main(*sys.argv[1:3])
except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
    print(f"bad job: {error!r}", file=sys.stderr)
    code = 2
sys.exit(code)
