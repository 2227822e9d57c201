#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Faults at every call that changes a file: what an engine or the program promises must hold afterwards.

    faults.py BUILD [--what engine|suite] [--kinds before,half,...] [--every N] [--seeded COUNT --seed S] [--jobs N] [--out TABLE.json]

seam.cpp lets the n-th call fail, in each kind, for every n (or every N-th of them), or for COUNT points drawn at random by a printed seed. What was announced as written
stands in the program's stderr, which this script keeps apart from the files. Then it looks:

- exit 0 means that every frame and the result are there, to the last bit of an undisturbed run;
- another exit has a code of the contracts and words on stderr, and no result says ok;
- frames that were announced are in the file with their bits (a loss of power may take them);
- a run goes on from the last announced checkpoint, and ends with the bits of the undisturbed one;
- nothing hangs, and nothing ends by a signal but the one that we sent (a process without memory may: the libraries below it do).

Exit: 0 all of it held, 1 something did not, with the command that shows it again.
"""
import argparse
import concurrent.futures
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
STICKY = "+sticky"
DEATHS = ("before", "half", "after", "lost")
HARMLESS = ("short", "eintr", "clock")  # a call that is cut short is made again; a date that jumps is nobody's concern
KINDS = [*DEATHS, *HARMLESS, "eio", "enospc", "erofs", "edquot", "eio" + STICKY, "enospc" + STICKY, "erofs" + STICKY]  # and memory, memory+sticky
PATIENCE = 60.0  # [s] for a run of 0.05 s
CODES = {"engine-tripoint": (0, 1, 2, 4, 7, 130), "tripoint": (0, 1, 2, 3, 4, 5, 6, 7, 130)}  # that the contracts know
GOOD = ("whole", "died", "refused")


def frames_of(path, count=None):
    """@return {dataset: values} of the first `count` frames, all where it is None"""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and name.endswith(("value", "time")):
            found[name] = item[:count]

    with h5py.File(path, "r") as file:
        file.visititems(visit)
    return found


def same_bits(there, wanted):
    """Whether all of `wanted` is there. Bodies that are born later make a column wider: they are missing from a file that ends before."""
    def same(a, b):
        if a.ndim < 2 or a.shape[0] != b.shape[0]:
            return a.tobytes() == b.tobytes()
        return a.tobytes() == b[:, : a.shape[1]].tobytes() and bool(np.isnan(b[:, a.shape[1]:]).all())

    return there.keys() == wanted.keys() and all(same(there[name], wanted[name]) for name in wanted)


class Engine:
    """One run of engine-tripoint: acknowledged are its frames and checkpoints."""
    process = "engine-tripoint"

    def __init__(self, build, scratch):
        self.program = build / "libexec/tripoint/engine-tripoint"
        self.start = scratch / "start"
        made = scratch / "made"
        subprocess.run([build / "bin/tripoint", "run", HERE / "halved.toml", "--quiet", "--out", made], check=True, capture_output=True)
        self.start.mkdir()
        shutil.copy(made / "particles.h5", self.start)
        self.job = json.loads((made / "job.json").read_text())
        self.job["settings"]["checkpoint_interval"] = 0.03
        self.reference = scratch / "reference"
        end = self.run(self.reference, {})
        assert end.returncode == 0, end.stderr
        self.frames = frames_of(self.reference / "trajectory.h5")

    def run(self, folder, environment, **more):
        if not folder.exists():
            shutil.copytree(self.start, folder)
        (folder / "job.json").write_text(json.dumps(self.job | {"output": str(folder), "particles": str(folder / "particles.h5")} | more))
        return subprocess.run([self.program, "--run", folder / "job.json"], capture_output=True, text=True, errors="replace", timeout=PATIENCE, env=os.environ | environment, check=False)

    def status(self, folder):
        result = folder / "result.json"
        return json.loads(result.read_text())["status"] if result.exists() else ""

    def is_whole(self, folder):
        return self.status(folder) == "ok" and same_bits(frames_of(folder / "trajectory.h5"), self.frames)

    def broken_promise(self, folder, end, kind):
        """@return "" or which promise about acknowledged frames and checkpoints does not hold"""
        announced = len(re.findall(r"^frame \d+ ", end.stderr, re.M))
        if announced and kind != "lost":
            try:
                there = frames_of(folder / "trajectory.h5", announced)
            except (OSError, RuntimeError) as error:
                return f"LOST: {announced} announced frames cannot be read: {error}"
            if not same_bits(there, {name: data[:announced] for name, data in self.frames.items()}):
                return f"LOST: not all of {announced} announced frames have their bits"
        checkpoints = re.findall(r"^checkpoint (\S+) ", end.stderr, re.M)
        if checkpoints:
            again = self.run(folder, {}, resume=checkpoints[-1])
            if again.returncode != 0:
                return f"LOST: the announced {Path(checkpoints[-1]).name} is refused: {again.stderr.strip().splitlines()[-1:]}"
            if not self.is_whole(folder):
                return f"WRONG: from {Path(checkpoints[-1]).name} on, the run has other bits"
        return ""


class Suite:
    """`tripoint validate` of one case: its verdict is what must not be wrong."""
    process = "tripoint"

    def __init__(self, build, scratch):
        self.program = build / "bin/tripoint"
        self.reference = scratch / "reference"
        end = self.run(self.reference, {})
        assert end.returncode == 0, end.stderr
        self.values = self.of(self.reference)

    def run(self, folder, environment):
        folder.mkdir()
        command = [self.program, "validate", HERE / "halved.toml", "--engines", "tripoint", "--no-report", "--no-history", "--out", folder / "out"]
        return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=PATIENCE, env=os.environ | environment, check=False)

    def of(self, folder):
        results = json.loads((folder / "out/results.json").read_text())
        return results["verdict"], results["exit_code"], [run["metrics"] for case in results["cases"] for engine in case["engines"] for run in engine["runs"]]

    def status(self, folder):
        try:
            return "ok" if self.of(folder) != self.values and self.of(folder)[0] == "PASS" else ""
        except FileNotFoundError:
            return ""

    def is_whole(self, folder):
        return self.of(folder) == self.values

    def broken_promise(self, folder, end, kind):
        return "WRONG: prints that it passed" if re.search(r"^verdict PASS exit 0", end.stdout, re.M) and end.returncode > 0 else ""


def judged(target, folder, end, kind):
    """@return what became of the run: whole, died, refused, or a word in capitals"""
    without_memory = kind.startswith("memory")  # libraries end as they can, and there may be none left for a word
    if end.returncode < 0 and (without_memory or (end.returncode == -signal.SIGKILL and kind in DEATHS)):
        return target.broken_promise(folder, end, kind) or "died"
    if end.returncode < 0:
        return f"CRASH by signal {-end.returncode}"
    if end.returncode not in CODES[target.process]:
        return f"CODE: exit {end.returncode} means nothing"
    if end.returncode == 0:
        return "whole" if target.is_whole(folder) else "WRONG: exit 0, and not all is there"
    if kind in HARMLESS:
        return f"REFUSED what may be made again: {end.stderr.strip().splitlines()[-1:]}"
    if not end.stderr.strip() and not without_memory:
        return f"SILENT: exit {end.returncode} without a word"
    if target.status(folder) == "ok":
        return f"WRONG: exit {end.returncode}, and the result says ok"
    return target.broken_promise(folder, end, kind) or "refused"


def try_point(target, scratch, kind, at, seed):
    folder = scratch / f"{kind}-{at}-{seed}"
    environment = {"LD_PRELOAD": str(target.seam), "FAULT_PROCESS": target.process, "FAULT_FOLDER": str(folder), "FAULT_AT": str(at), "FAULT_SEED": str(seed),
                   "FAULT_KIND": kind, "FAULT_LOG": str(scratch / f"{folder.name}.log")}
    try:
        found = judged(target, folder, target.run(folder, environment), kind)
    except subprocess.TimeoutExpired:
        found = "HANG"
    except Exception as error:  # what was left behind cannot even be looked at
        found = f"WRONG: {type(error).__name__}: {error}"
    log = Path(environment["FAULT_LOG"])
    where = " ".join(log.read_text().split()[1:]).replace(str(folder), "") if log.exists() else ""
    if found.startswith(GOOD):
        shutil.rmtree(folder, ignore_errors=True)
    log.unlink(missing_ok=True)
    return kind, at, seed, found, where


def calls_of(target, scratch, kind):
    """How many calls of an undisturbed run change a file, or ask for memory."""
    name = "memory" if kind.startswith("memory") else "files"
    folder, log = scratch / f"counted-{name}", scratch / f"{name}.log"
    if not log.exists():
        target.run(folder, {"LD_PRELOAD": str(target.seam), "FAULT_PROCESS": target.process, "FAULT_FOLDER": str(folder), "FAULT_AT": "0", "FAULT_KIND": name, "FAULT_LOG": str(log)})
    return int(log.read_text().splitlines()[-1].split()[0])


def drawn(options, calls):
    """(kind, n-th call, seed) of all points. @param calls of each kind"""
    if options.seeded:
        dice = random.Random(options.seed)
        kinds = [dice.choice(list(calls)) for _ in range(options.seeded)]
        return [(kind, dice.randint(1, calls[kind]), dice.randint(0, 10**6)) for kind in kinds]
    return [(kind, at, at) for kind, count in calls.items() for at in range(1 + options.seed % options.every, count + 1, options.every)]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("build", type=Path)
    words.add_argument("--what", choices=("engine", "suite"), default="engine")
    words.add_argument("--kinds", default=",".join(KINDS))
    words.add_argument("--every", type=int, default=1)
    words.add_argument("--seeded", type=int, default=0)
    words.add_argument("--seed", type=int, default=0)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--out", type=Path)
    options = words.parse_args()
    shared = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # a disk is not what is tested
    with tempfile.TemporaryDirectory(prefix="tripoint-faults-", dir=shared) as folder:
        scratch = Path(folder)
        target = {"engine": Engine, "suite": Suite}[options.what](options.build.resolve(), scratch)
        target.seam = options.build.resolve() / "tests/fault-seam.so"
        calls = {kind: calls_of(target, scratch, kind) for kind in options.kinds.split(",")}
        points = drawn(options, calls)
        print(f"{options.what}: {', '.join(f'{n} calls' for n in sorted(set(calls.values())))}; {len(points)} points, seed {options.seed}", flush=True)
        table, bad = {}, []
        with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
            for kind, at, seed, found, where in pool.map(try_point, *zip(*[(target, scratch, *point) for point in points]), chunksize=8):
                row = table.setdefault(kind, {})
                row[found.split(":")[0]] = row.get(found.split(":")[0], 0) + 1
                if not found.startswith(GOOD):
                    bad.append(f"{kind} at {at} ({where}): {found}")
                    print(bad[-1], flush=True)
    for kind, row in table.items():
        print(f"{kind:16} " + ", ".join(f"{n} {word}" for word, n in sorted(row.items())))
    print(f"{len(points)} points, {len(bad)} broke a promise")
    if options.out:
        options.out.write_text(json.dumps({"calls": calls, "points": len(points), "table": table, "bad": bad}, indent=1) + "\n")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
