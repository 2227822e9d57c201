#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Faults at every call that changes a file or a name, reads, asks for memory, or is about a child: what an engine or
the program promises must hold afterwards.

    faults.py BUILD [--what engine|suite] [--kinds before,read-eio,...] [--every N] [--each-call] [--seeded COUNT --seed
    S] [--jobs N] [--out TABLE.json]

seam.cpp lets the n-th call fail, in each kind, for every n (or every N-th of them), or for COUNT points drawn at random
by a printed seed. Of calls for memory those with the same callers are one: the first and the last of them fail;
--each-call takes every one. What was announced as written stands in the program's stderr, which this script keeps apart
from the files. Then it looks:

- exit 0 means that every frame and the result are there, to the last bit of an undisturbed run;
- another exit has a code of the contracts and words on stderr, and no result says ok;
- frames that were announced are in the file with their bits (a loss of power may take them);
- a run goes on from the last announced checkpoint, and ends with the bits of the undisturbed one;
- nothing hangs, no process is left behind, and nothing ends by a signal but the one that we sent (a process without
memory may: the libraries below it do).

--what suite is `tripoint validate` of one case, and then that of two engines, one of them third-party, where calls
about children fail.
Exit: 0 all of it held, 1 something did not, with the command that shows it again.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
STICKY = "+sticky"
DEATHS = ("before", "half", "after", "lost")
HARMLESS = ("short", "eintr", "clock")  # a call that is cut short is made again; a date that jumps is nobody's concern
ALWAYS_HARMLESS = ("pidfd", "kill", "limit")  # sets of calls: there is another way, or nothing was left to be done
KINDS = [*DEATHS, *HARMLESS, "eio", "enospc", "erofs", "edquot", "eio" + STICKY, "enospc" + STICKY, "erofs" + STICKY]
NAMES = """
name-before name-after name-lost name-eio name-enospc name-erofs name-eacces name-eio+sticky
name-erofs+sticky
""".split()
READS = ["read-short", "read-eintr", "read-eio", "read-eio" + STICKY]
MEMORY = ["memory", "memory" + STICKY]
CHILDREN = """
fork-after fork-eagain fork-eagain+sticky spawn-before spawn-after spawn-eagain spawn-enomem+sticky
pipe-emfile pipe-emfile+sticky poll-before poll-eintr poll-enomem poll-enomem+sticky pidfd-emfile
pidfd-enosys+sticky wait-before wait-eintr wait-echild wait-echild+sticky kill-eperm
kill-eperm+sticky limit-eperm limit-eperm+sticky stream-short stream-eintr stream-eio
stream-eio+sticky
""".split()
PATIENCE = 60.0  # [s] for a run of 0.05 s
CODES = {"engine-tripoint": (0, 1, 2, 4, 7, 130), "tripoint": (0, 1, 2, 3, 4, 5, 6, 7, 130)}  # that the contracts know
GOOD = ("whole", "died", "refused")
EXIT_OF_HDF5 = 255  # it leaves by exit(-1) where it has no memory for an identifier


def set_of(kind):
    """Calls that a kind is among."""
    return "memory" if kind.startswith("memory") else kind.partition("-")[0] if "-" in kind else "files"


def word_of(kind):
    """What happens to the call."""
    return kind.rpartition("-")[2].removesuffix(STICKY)


def is_harmless(kind):
    return word_of(kind) in HARMLESS or set_of(kind) in ALWAYS_HARMLESS


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
    """Whether all of `wanted` is there. Bodies that are born later make a column wider: they are missing from a file
    that ends before."""

    def same(a, b):
        if a.ndim < 2 or a.shape[0] != b.shape[0]:
            return a.tobytes() == b.tobytes()
        return a.tobytes() == b[:, : a.shape[1]].tobytes() and bool(np.isnan(b[:, a.shape[1] :]).all())

    return there.keys() == wanted.keys() and all(same(there[name], wanted[name]) for name in wanted)


class Engine:
    """One run of engine-tripoint: acknowledged are its frames and checkpoints."""

    name = "engine"
    process = "engine-tripoint"
    kinds = KINDS + NAMES + READS + MEMORY
    callers = 128  # that tell one call for memory from another
    seen = {}  # what became of the same files and words before

    def __init__(self, build, scratch):
        self.program = build / "libexec/tripoint/engine-tripoint"
        self.start = scratch / "start"
        made = scratch / "made"
        subprocess.run(
            [build / "bin/tripoint", "run", HERE / "halved.toml", "--quiet", "--out", made],
            check=True,
            capture_output=True,
        )
        self.start.mkdir()
        shutil.copy(made / "particles.h5", self.start)
        self.job = json.loads((made / "job.json").read_text())
        self.job["settings"]["checkpoint_interval"] = 0.03
        self.job["threads"] = 1
        self.reference = scratch / "reference"
        end = self.run(self.reference, {})
        assert end.returncode == 0, end.stderr
        self.frames = frames_of(self.reference / "trajectory.h5")

    def run(self, folder, environment, **more):
        if not folder.exists():
            shutil.copytree(self.start, folder)
        (folder / "job.json").write_text(
            json.dumps(self.job | {"output": str(folder), "particles": str(folder / "particles.h5")} | more)
        )
        return subprocess.run(
            [self.program, "--run", folder / "job.json"],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=PATIENCE,
            env=os.environ | environment,
            check=False,
        )

    def status(self, folder):
        result = folder / "result.json"
        return json.loads(result.read_text())["status"] if result.exists() else ""

    def is_whole(self, folder):
        return self.status(folder) == "ok" and same_bits(frames_of(folder / "trajectory.h5"), self.frames)

    def left_behind(self, folder, end):
        """Hash of all that was left: the same is judged once."""
        what = hashlib.sha256(f"{end.returncode} {end.stderr.replace(str(folder), '')}".encode())
        for file in sorted(folder.iterdir()):
            data = b"" if file.name == "job.json" else file.read_bytes()
            what.update(f"{file.name} {len(data)} ".encode() + data.replace(bytes(folder), b""))
        return what.digest()

    def broken_promise(self, folder, end, kind):
        if set_of(kind) != "memory":
            return self.promise_that_is_broken(folder, end, kind)
        key = self.left_behind(folder, end)
        if key not in self.seen:
            self.seen[key] = self.promise_that_is_broken(folder, end, kind)
        return self.seen[key]

    def promise_that_is_broken(self, folder, end, kind):
        """@return "" or which promise about acknowledged frames and checkpoints does not hold"""
        announced = len(re.findall(r"^frame \d+ ", end.stderr, re.M))
        if announced and word_of(kind) != "lost":
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
                return (
                    f"LOST: the announced {Path(checkpoints[-1]).name} is refused: "
                    f"{again.stderr.strip().splitlines()[-1:]}"
                )
            if not self.is_whole(folder):
                return f"WRONG: from {Path(checkpoints[-1]).name} on, the run has other bits"
        return ""


class Suite:
    """`tripoint validate` of one case: its verdict is what must not be wrong."""

    name = "suite"
    process = "tripoint"
    kinds = KINDS + NAMES + MEMORY
    callers = 2
    case, more, engines, environment = HERE / "halved.toml", "", "tripoint", {}

    def __init__(self, build, scratch):
        self.program = scratch / "tree/bin/tripoint"  # beside it the one engine that is asked
        for part in ("bin/tripoint", "libexec/tripoint/engine-tripoint"):
            (scratch / "tree" / part).parent.mkdir(parents=True)
            shutil.copy(build / part, scratch / "tree" / part)
        self.prepare(scratch)
        self.reference = scratch / "reference"
        end = self.run(self.reference, {})
        assert end.returncode == 0, end.stderr
        self.values = self.of(self.reference)

    def prepare(self, scratch):
        pass

    def run(self, folder, environment):
        folder.mkdir()
        case = folder / self.case.name
        case.write_text(self.case.read_text() + self.more)
        command = [
            self.program,
            "validate",
            case,
            "--engines",
            self.engines,
            "--no-report",
            "--no-history",
            "--out",
            folder / "out",
        ]
        return subprocess.run(
            command,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=PATIENCE,
            env=os.environ | self.environment | environment,
            check=False,
        )

    def of(self, folder):
        results = json.loads((folder / "out/results.json").read_text())
        return (
            results["verdict"],
            results["exit_code"],
            [run["metrics"] for case in results["cases"] for engine in case["engines"] for run in engine["runs"]],
        )

    def status(self, folder):
        try:
            return "ok" if self.of(folder) != self.values and self.of(folder)[0] == "PASS" else ""
        except FileNotFoundError:
            return ""

    def is_whole(self, folder):
        return self.of(folder) == self.values

    def broken_promise(self, folder, end, kind):
        return (
            "WRONG: prints that it passed"
            if re.search(r"^verdict PASS exit 0", end.stdout, re.M) and end.returncode > 0
            else ""
        )


class Children(Suite):
    """`tripoint validate` of one case on two engines that must not be missing, one of them third-party: what it wrote
    is read by a copy first."""

    name = "children"
    kinds = CHILDREN + READS
    case, engines = HERE.parent / "harness/fake/flight.toml", "tripoint,fake"
    more = "[engines.tripoint]\nrequired = true\n[engines.fake]\nrequired = true\n"

    def prepare(self, scratch):
        third_party = scratch / "third-party/engine-fake"
        third_party.parent.mkdir()
        third_party.write_text(
            f'#!/bin/sh\nexec /usr/bin/python3 -S -B {HERE.parent / "harness/fake/engine.py"} "$@"\n'
        )
        third_party.chmod(0o755)
        self.environment = {"TRIPOINT_ENGINE_PATH": str(third_party.parent)}


def those_left(folder):
    """Processes that the run of this folder started and that are alive."""
    mark, found = b"FAULT_FOLDER=" + bytes(folder) + b"\0", []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if mark in (process / "environ").read_bytes():
                found.append(int(process.name))
        except OSError:  # it has ended, or is of somebody else
            pass
    return found


def left_alive(folder):
    """@return "" or how many processes are alive when they have had time to end; they are killed then"""
    begun = time.monotonic()
    while found := those_left(folder):
        if time.monotonic() - begun > PATIENCE / 4:
            for process in found:
                os.kill(process, signal.SIGKILL)
            return f"ALIVE: {len(found)} processes are left behind"
        time.sleep(0.02)
    return ""


def judged(target, folder, end, kind):
    """@return what became of the run: whole, died, refused, or a word in capitals"""
    without_memory = set_of(kind) == "memory"  # libraries end as they can, and there may be none left for a word
    ended_by_library = without_memory and (end.returncode < 0 or end.returncode == EXIT_OF_HDF5)
    if ended_by_library or (end.returncode == -signal.SIGKILL and word_of(kind) in DEATHS):
        return target.broken_promise(folder, end, kind) or "died"
    if end.returncode < 0:
        return f"CRASH by signal {-end.returncode}"
    if end.returncode not in CODES[target.process]:
        return f"CODE: exit {end.returncode} means nothing"
    if end.returncode == 0:
        return "whole" if target.is_whole(folder) else "WRONG: exit 0, and not all is there"
    return refused(target, folder, end, kind, without_memory)


def refused(target, folder, end, kind, without_memory):
    """@return what became of a run that ended with a code of its own"""
    if is_harmless(kind):
        return f"REFUSED what may be made again: {end.stderr.strip().splitlines()[-1:]}"
    if not end.stderr.strip() and not without_memory:
        return f"SILENT: exit {end.returncode} without a word"
    if target.status(folder) == "ok":
        return f"WRONG: exit {end.returncode}, and the result says ok"
    return target.broken_promise(folder, end, kind) or "refused"


def seam(target, folder, kind, at, seed, log):
    """Variables for one run. Numbers have one width, so that all runs ask for memory alike."""
    return {
        "LD_PRELOAD": str(target.seam),
        "FAULT_PROCESS": target.process,
        "FAULT_FOLDER": str(folder),
        "FAULT_AT": f"{at:06}",
        "FAULT_SEED": f"{seed:06}",
        "FAULT_KIND": kind,
        "FAULT_LOG": str(log),
        "FAULT_STACKS": str(target.callers),
    }


def folder_of(scratch, kind, at, seed):
    return scratch / f"{kind}-{at:06}-{seed:06}"


def try_point(target, scratch, kind, at, seed):
    """@return the point, what became of it, and what the seam says of the call"""
    folder = folder_of(scratch, kind, at, seed)
    log = scratch / f"{folder.name}.log"
    try:
        found = judged(target, folder, target.run(folder, seam(target, folder, kind, at, seed, log)), kind)
    except subprocess.TimeoutExpired:
        found = "HANG"
    except Exception as error:  # what was left behind cannot even be looked at
        found = f"WRONG: {type(error).__name__}: {error}"
    if isinstance(target, Suite):
        alive = left_alive(folder)
        found = alive if found.startswith(GOOD) and alive else found
    where = " ".join(log.read_text().split()[1:]).replace(str(folder), "") if log.exists() else ""
    if found.startswith(GOOD):
        shutil.rmtree(folder, ignore_errors=True)
    log.unlink(missing_ok=True)
    return kind, at, seed, found, where


def lines_of_calls(target, scratch, kind):
    """What the seam says of the calls of an undisturbed run that this kind is about."""
    folder, log = folder_of(scratch, kind, 0, 0), scratch / f"{kind}.log"
    target.run(folder, seam(target, folder, kind, 0, 0, log))
    lines = [line.split() for line in log.read_text().splitlines()] if log.exists() else []
    shutil.rmtree(folder, ignore_errors=True)
    return lines


def calls_of(lines):
    return max(
        [int(line[0]) for line in lines if "memory" in line or len(line) != 3 or not line[1].isdigit()], default=0
    )


def stacks_of(lines):
    """@return {number of the call: name of its callers}, of the first and the last call with the same callers"""
    found = {}
    for line in lines:
        if len(line) == 3 and line[1].isdigit():
            found |= {int(line[0]): line[2], int(line[1]): line[2]}
    return found


def drawn(options, calls, stacks):
    """(kind, n-th call, seed) of all points. @param calls of each kind   @param stacks of each kind that is about
    memory"""
    if options.seeded:
        dice = random.Random(options.seed)
        kinds = [dice.choice([kind for kind in calls if calls[kind]]) for _ in range(options.seeded)]
        return [(kind, dice.randint(1, calls[kind]), dice.randint(0, 10**6 - 1)) for kind in kinds]
    points = []
    for kind, count in calls.items():
        numbers = sorted(stacks[kind]) if stacks.get(kind) and not options.each_call else range(1, count + 1)
        points += [(kind, at, at) for at in numbers[options.seed % options.every :: options.every]]
    return points


def campaign(target, scratch, options, kinds):
    """@return all that was found, to be written as JSON"""
    lines = {kind: lines_of_calls(target, scratch, kind) for kind in kinds}
    calls = {kind: calls_of(lines[kind]) for kind in kinds}
    stacks = {kind: stacks_of(lines[kind]) for kind in kinds if set_of(kind) == "memory"}
    points = drawn(options, calls, stacks)
    sets = {set_of(kind): calls[kind] for kind in kinds}
    print(
        f"{target.name}: calls {', '.join(f'{name} {count}' for name, count in sets.items())}; {len(points)} points, "
        f"seed {options.seed}",
        flush=True,
    )
    table, bad, met = try_points(target, scratch, options, points, stacks)
    for kind, row in table.items():
        print(f"{kind:20} " + ", ".join(f"{n} {word}" for word, n in sorted(row.items())))
    for kind, names in stacks.items():
        wanted = set(names.values())
        print(
            f"{kind:20} {len(wanted)} different callers of {calls[kind]} calls, {len(wanted & met[kind])} of them "
            f"met, and {len(met[kind] - wanted)} others"
        )
    print(f"{target.name}: {len(points)} points, {len(bad)} broke a promise", flush=True)
    return {"calls": calls, "points": len(points), "table": table, "bad": bad}


def try_points(target, scratch, options, points, stacks):
    """({kind: {word: number of points}}, broken promises, {kind: callers that were met})"""
    table, bad, met = {}, [], {kind: set() for kind in stacks}
    tasks = zip(*[(target, scratch, *point) for point in points])
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        for kind, at, seed, found, where in pool.map(try_point, *tasks, chunksize=8):
            row = table.setdefault(kind, {})
            row[found.split(":")[0]] = row.get(found.split(":")[0], 0) + 1
            if kind in met and where:
                met[kind].add(where.split()[-1])
            if not found.startswith(GOOD):
                bad.append(f"{target.name} {kind} at {at} ({where}): {found}")
                print(bad[-1], flush=True)
    return table, bad, met


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("build", type=Path)
    words.add_argument("--what", choices=("engine", "suite"), default="engine")
    words.add_argument("--kinds", default="")
    words.add_argument("--every", type=int, default=1)
    words.add_argument("--each-call", action="store_true")
    words.add_argument("--seeded", type=int, default=0)
    words.add_argument("--seed", type=int, default=0)
    words.add_argument("--jobs", type=int, default=2)
    words.add_argument("--out", type=Path)
    options = words.parse_args()
    shared = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # a disk is not what is tested
    asked, found = options.kinds.split(",") if options.kinds else [], {}
    targets = {"engine": (Engine,), "suite": (Suite, Children)}[options.what]
    if unknown := set(asked) - {kind for target in targets for kind in target.kinds}:
        words.error(f"no such kinds: {', '.join(sorted(unknown))}")
    for target in targets:
        kinds = [kind for kind in target.kinds if not asked or kind in asked]
        if not kinds:
            continue
        with tempfile.TemporaryDirectory(prefix="tripoint-faults-", dir=shared) as folder:
            made = target(options.build.resolve(), Path(folder))
            made.seam = options.build.resolve() / "tests/fault-seam.so"
            found[target.name] = campaign(made, Path(folder), options, kinds)
    if options.out:
        options.out.write_text(json.dumps(found, indent=1) + "\n")
    return 1 if any(each["bad"] for each in found.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
