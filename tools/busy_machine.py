#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Threads, load and how threads wait: milliseconds of wall time a step, as a table.

    tools/busy_machine.py CASE.toml [--program build/bin/tripoint] [--threads 2] [--loads 0,4,8] [--steps 100] [--rounds
    3]

Each load is so many processes that do nothing but work. Rows of forced threads are `tripoint explain --trial`, which
keeps the threads that it is given; the last is `tripoint run`, which waits and gives way as users have it. All rows of
a load are measured in turn, the median of the rounds is shown. Other work on the machine comes on top: the load that
the system tells at the end is in the heading."""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ENDLESS = "30000000000"


def environment(**waits):
    return {
        name: value for name, value in os.environ.items() if name not in ("GOMP_SPINCOUNT", "OMP_WAIT_POLICY")
    } | waits


def trial(program, case, steps, threads, **waits):
    done = subprocess.run(
        [program, "explain", case, "--trial", str(steps), "--threads", str(threads), "--json"],
        capture_output=True,
        text=True,
        check=True,
        env=environment(**waits),
    )
    return json.loads(done.stdout)["trial"]


def forced(*words, **waits):
    """A step with so many threads, whatever the machine does [ms]."""
    return 1e3 * trial(*words, **waits)["step_seconds"]


def as_shipped(program, case, steps, threads, time_step):
    """A step of a run [ms]."""
    with tempfile.TemporaryDirectory() as folder:
        end = str(steps * time_step)
        subprocess.run(
            [
                program,
                "run",
                case,
                "--threads",
                str(threads),
                "--until",
                end,
                "--set",
                f"scene.output_interval={end}",
                "--out",
                folder,
                "--quiet",
            ],
            capture_output=True,
            text=True,
            check=True,
            env=environment(),
        )
        result = json.loads(next(Path(folder).rglob("result.json")).read_text(encoding="utf-8"))
    return 1e3 * result["seconds"]["stepping_wall"] / result["steps"]


def measured(args, load, time_step):
    """Median milliseconds of each row, with so many busy processes beside them."""
    rows = {
        "1 thread": lambda: forced(args.program, args.case, args.steps, 1),
        f"{args.threads} threads, spinning": lambda: forced(
            args.program, args.case, args.steps, args.threads, GOMP_SPINCOUNT=ENDLESS
        ),
        f"{args.threads} threads, spinning briefly": lambda: forced(
            args.program, args.case, args.steps, args.threads, GOMP_SPINCOUNT="1000"
        ),
        f"{args.threads} threads, sleeping": lambda: forced(
            args.program, args.case, args.steps, args.threads, OMP_WAIT_POLICY="passive"
        ),
        f"as shipped, {args.threads} threads": lambda: as_shipped(
            args.program, args.case, args.steps, args.threads, time_step
        ),
    }
    taken = {name: [] for name in rows}
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(load)]
    try:
        for _ in range(args.rounds):
            for name, row in rows.items():
                taken[name].append(row())
    finally:
        for process in busy:
            process.kill()
            process.wait()
    return {name: statistics.median(times) for name, times in taken.items()}


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("case")
    words.add_argument("--program", default="build/bin/tripoint")
    words.add_argument("--threads", type=int, default=2)
    words.add_argument("--loads", default="0,4,8")
    words.add_argument("--steps", type=int, default=100)
    words.add_argument("--rounds", type=int, default=3)
    args = words.parse_args()
    time_step = trial(args.program, args.case, 1, 1)["time_step"]
    table = {}
    for load in map(int, args.loads.split(",")):
        table[load] = (measured(args, load, time_step), os.getloadavg()[0])
    print("| | " + " | ".join(f"{load} busy (load {seen:.0f})" for load, (_, seen) in table.items()) + " |")
    print("|---" * (len(table) + 1) + "|")
    for name in next(iter(table.values()))[0]:
        print(f"| {name} | " + " | ".join(f"{rows[name]:.1f}" for rows, _ in table.values()) + " |")


if __name__ == "__main__":
    main()
