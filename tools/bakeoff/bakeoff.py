#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs schemes of the liquid on scenes with a known answer, and prints a row a run: figures, CPU seconds, steps.

tools/bakeoff/bakeoff.py --schemes today,adjoint --scenes still,wave [--levels 20] [--out DIR]
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from scenes import SCENES

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRIPOINT", str(ROOT / "build/bin/tripoint"))
BARE = {"model.core": "none", "model.surface": "none", "model.bulk_viscosity": "none"}
SCHEMES = {
    "adjoint-wide": {"model.pressure": "adjoint", "scene.support_ratio": 3.2},
    "today": {},
    "bare": {**BARE, "scene.support_ratio": 3.2},
    "adjoint": {"model.pressure": "adjoint", "scene.support_ratio": 2.6},
    "riemann": {"model.pressure": "reverse_riemann", "scene.support_ratio": 2.6},
    "mean": {"model.pressure": "mean", "scene.support_ratio": 2.6},
    "adjoint-limited": {"model.pressure": "adjoint_limited", "scene.support_ratio": 3.2},
    "reverse": {"model.pressure": "reverse", "scene.support_ratio": 3.2},
}


class Run:
    """The frames of a run; liquid particles alone, but for those of bodies."""

    def __init__(self, folder):
        self.file = h5py.File(folder / "trajectory.h5")
        self.all = self.file["particles/all"]
        position = self.all["position"]
        self.times = position["time"][:]
        self.frames = len(self.times)
        self.wet = self.all["phase/value"][0] == 0
        self.job = json.loads((folder / "job.json").read_text())

    def of(self, name, frame):
        return self.all[name + "/value"][frame][self.wet]

    def places(self, frame):
        return self.of("position", frame)

    def speeds(self, frame):
        return self.of("velocity", frame)

    def pressure(self, frame):
        return self.of("pressure", frame)

    def temperature(self, frame):
        return self.of("temperature", frame)

    def masses(self, frame):
        return self.of("mass", frame)

    def row_of(self, body):
        return [b["name"] for b in self.job["scene"]["bodies"] if b["phase"] != "liquid"].index(body)

    def body(self, name, field):
        return self.file[f"particles/bodies/{field}/value"][:, self.row_of(name)]

    def body_mass(self, frame, name):
        return float(self.file["particles/bodies/mass/value"][frame, self.row_of(name)])

    def gained(self):
        """Greatest rise of energy above the start, over the kinetic energy or the spread of the potential one."""
        E = sum(
            self.file[f"observables/energy_{t}/value"][:]
            for t in ("kinetic", "potential", "compression")
            if f"observables/energy_{t}" in self.file
        )
        K = self.file["observables/energy_kinetic/value"][:]
        return float((E.max() - E[0]) / max(K.max(), 1e-300))


def run(scheme, scene, n, out, threads):
    make, judge, _ = SCENES[scene]
    folder = out / f"{scene}-{n}-{scheme}"
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "case.toml"
    case.write_text(make(n))
    (folder / "result.json").unlink(missing_ok=True)
    command = [PROGRAM, "run", str(case), "--out", str(folder), "--quiet", "--threads", str(threads)]
    if settings := SCHEMES[scheme]:
        command += [part for k, v in settings.items() for part in ("--set", f"{k}={v}")]
    done = subprocess.run(command, capture_output=True, text=True)
    result = folder / "result.json"
    if not result.exists():
        return {"failed": (done.stderr + done.stdout).strip()[-300:]}
    info = json.loads(result.read_text())
    if info["status"] != "ok":
        return {"failed": f"{info['status']}: {info.get('message', '')[:200]}"}
    at = Run(folder)
    figures = judge(at, n)
    figures["cpu s"] = info["seconds"]["stepping_cpu"]
    figures["steps"] = info["steps"]
    return figures


def shown(v):
    return f"{v:.4g}" if isinstance(v, float) else str(v)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--schemes", default=",".join(SCHEMES))
    p.add_argument("--scenes", default=",".join(SCENES))
    p.add_argument("--levels", default="")
    p.add_argument("--out", default="runs/bakeoff")
    p.add_argument("--threads", type=int, default=1)
    a = p.parse_args()
    out = pathlib.Path(a.out)
    for scene in a.scenes.split(","):
        levels = [int(n) for n in a.levels.split(",")] if a.levels else SCENES[scene][2]
        for n in levels:
            for scheme in a.schemes.split(","):
                try:
                    figures = run(scheme, scene, n, out, a.threads)
                except Exception as e:
                    figures = {"failed": repr(e)}
                print(f"{scene} {n} {scheme}: " + "; ".join(f"{k} {shown(v)}" for k, v in figures.items()), flush=True)
                with open(out / "rows.jsonl", "a") as rows:
                    rows.write(json.dumps({"scene": scene, "n": n, "scheme": scheme, **figures}) + "\n")


if __name__ == "__main__":
    main()
