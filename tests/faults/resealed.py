#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checkpoints whose arrays were altered and whose seal is right: the run that goes on from one ends in a sentence, or
in a result.

    resealed.py BUILD [--count N] [--seed S] [--jobs N]

A checkpoint of another program, or of a broken memory, has a seal that holds. So three short runs leave checkpoints,
one to three arrays of one are given other values, another length, or are taken away, and the file is sealed anew. The
engine goes on from it within bounds of memory and time. What a number means is not looked at: one that nothing
contradicts is another state, which a run may go on from. Exit: 0 no run ended by a signal or hung, 1 one did, with what
was altered and the seed that shows it again."""

import argparse
import collections
import concurrent.futures
import json
import random
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
SCENES = {"heat/inflow": "0.0002 s", "phase/over-ranks": "0.0002 s", "coupling/over-ranks": "0.01 s"}
FIRST_BLOCK = 512  # name and seal of a checkpoint: src/files/checkpoint_file.cpp
REALS = (np.nan, np.inf, -1e308, 1e308, 0.0, -1.0, 5e-324, 1e18, 1e-9)
WHOLES = (-1, 0, 1, 2, 7, 65535, 10**6, 2**31 - 1, 2**31, 2**32 + 1, 2**62, -(2**31), -(2**63))
INDICES = (
    2**32,
    2**32 - 1,
    2**40,
    999_999,
    65_536,
    2**63 + 5,
)  # as bits: lists of partners hold whole numbers in arrays of reals
PATIENCE = 60.0  # [s] for runs of a second
MEMORY = 4 << 30  # bytes of address space
BAD = ("killed", "hung")


def seal(path):
    """FNV-1a of what follows the first block."""
    data = bytearray(path.read_bytes())
    value = 1469598103934665603
    for byte in data[FIRST_BLOCK:]:
        value = ((value ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    words = b"tripoint checkpoint 1\nfnv1a64:%016x\n" % value
    data[:FIRST_BLOCK] = words.ljust(FIRST_BLOCK, b"\0")
    path.write_bytes(data)


def other_value(draw, values):
    if values.dtype.kind != "f":
        return draw.choice([0, 1, 10, 65, -1] if values.dtype.itemsize == 1 else WHOLES)
    if draw.random() < 0.4:
        return np.uint64(draw.choice(INDICES)).view(np.float64)
    return draw.choice(REALS)


def alter(draw, path):
    """One to three arrays of the file. @return what was done, in words"""
    done = []
    with h5py.File(path, "r+", libver="latest") as file:
        names = []
        file.visititems(lambda name, held: names.append(name) if isinstance(held, h5py.Dataset) and held.size else None)
        for name in draw.sample(names, draw.choice((1, 1, 1, 2, 3))):
            values = file[name][()]
            way = draw.choice(("one", "one", "one", "all", "fewer", "more", "swap", "gone"))
            if way == "one":
                at = draw.randrange(len(values))
                values[at] = other_value(draw, values)
                done.append(f"{name}[{at}] = {values[at]}")
            elif way == "all":
                values[:] = other_value(draw, values)
                done.append(f"{name}[:] = {values[0]}")
            elif way == "swap":
                values = values[::-1].copy()
                done.append(f"{name} backwards")
            if way in ("one", "all", "swap"):
                file[name][...] = values
                continue
            del file[name]
            done.append(f"{name}: {way}")
            if way != "gone":
                file[name] = (
                    np.resize(values, max(1, len(values) - draw.choice((1, 3))))
                    if way == "fewer"
                    else np.resize(values, len(values) + draw.choice((1, 3, 100)))
                )
    return "; ".join(done)


def prepare(build, folder):
    """A run of each scene, cut in its middle. @return {scene: its folder and its first checkpoint}"""
    kept = {}
    for scene, interval in SCENES.items():
        out = folder / scene.replace("/", "-")
        subprocess.run(
            [build / "bin" / "tripoint", "run", scene, "--out", out, "--checkpoint-interval", interval],
            cwd=ROOT,
            check=True,
            capture_output=True,
        )
        kept[scene] = (out, sorted(out.rglob("checkpoint-*.h5"))[0])
    return kept


def bound():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def go_on(build, source, checkpoint, seed):
    """@return how the run from an altered copy ended, what was altered, the last words"""
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory(prefix="resealed-") as name:
        folder = Path(name)
        for kept in ("particles.h5", "trajectory.h5"):
            shutil.copy(source / kept, folder)
        path = folder / checkpoint.name
        shutil.copy(checkpoint, path)
        done = alter(draw, path)
        seal(path)
        job = json.loads((source / "job.json").read_text(encoding="utf-8")) | {
            "resume": str(path),
            "particles": str(folder / "particles.h5"),
            "output": str(folder),
        }
        (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
        try:
            end = subprocess.run(
                [build / "libexec" / "tripoint" / "engine-tripoint", "--run", folder / "job.json"],
                cwd=folder,
                capture_output=True,
                timeout=PATIENCE,
                preexec_fn=bound,
            )
        except subprocess.TimeoutExpired:
            return "hung", done, ""
        words = end.stderr.decode(errors="replace").strip().split("\n")[-1]
        how = {0: "went on", 2: "refused", 4: "refused", 7: "diverged"}.get(
            end.returncode, "killed" if end.returncode < 0 else f"exit {end.returncode}"
        )
        return how, done, words


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("build", type=Path)
    p.add_argument("--count", type=int, default=90)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--jobs", type=int, default=2)
    o = p.parse_args()
    build = o.build.resolve()
    ends = collections.Counter()
    with (
        tempfile.TemporaryDirectory(prefix="resealed-runs-") as name,
        concurrent.futures.ThreadPoolExecutor(o.jobs) as pool,
    ):
        kept = prepare(build, Path(name))
        scenes = list(kept)
        waiting = {}
        for seed in range(o.seed, o.seed + o.count):
            scene = scenes[seed % len(scenes)]
            waiting[pool.submit(go_on, build, *kept[scene], seed)] = (scene, seed)
        for one in concurrent.futures.as_completed(waiting):
            how, done, words = one.result()
            scene, seed = waiting[one]
            ends[how] += 1
            if how in BAD or how.startswith("exit"):
                print(f"{how}: {scene}, {done}: {words}  (--seed {seed} --count 1)", flush=True)
    print(f"{o.count} altered checkpoints: " + ", ".join(f"{n} {how}" for how, n in sorted(ends.items())))
    return 1 if any(ends[how] for how in BAD) else 0


if __name__ == "__main__":
    sys.exit(main())
