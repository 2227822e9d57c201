#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Still water in tanks of every shape: how fast does it move, and who does work?

    tools/still_water.py run --out FOLDER [--budget SECONDS] [--only TEXT]     runs the cells that FOLDER lacks, the
    cheapest first
    tools/still_water.py keep --out FOLDER [FOLDER ...] --to docs/still-water  adds what FOLDER holds to
    docs/still-water/FOLDER.json: of each cell the longest run
    tools/still_water.py page --out docs/still-water/*.json > docs/still-water.md   writes the page from kept files, or
    from folders
    tools/still_water.py table --out FILE [FILE ...]                           prints every cell of them

Each cell is the case fluid/still-water-conservative with another spacing, tank, viscosity or slip, set on the command
line of `tripoint run`, on one thread. The short side of the tank is 0.2 m. A cell runs for 60 s, or for 20, 5 or 1 s
where its cost would be above the budget (CPU seconds, estimated from particles and steps), or not at all; the table
says how long each ran."""

import argparse
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SIDE, G, RHO = 0.2, 9.81, 1000.0  # short side of the tank [m], gravity, density
ACROSS = (5, 10, 20)  # particles along the short side
ASPECTS = (0.25, 1.0, 4.0, 8.0)  # depth over width
VISCOSITIES = (0.0, 1e-3, 1.0)  # [Pa s]
SLIPS = ("free", "no")
LENGTHS = (60.0, 20.0, 5.0, 1.0)  # [s]
WINDOWS = ((0.0, 5.0), (5.0, 20.0), (20.0, 60.0))  # [s]
LAYERS, DEEP = 3, 6  # of the walls; particles along the periodic direction, the fewest that the support allows
PER_PARTICLE_STEP = 0.75e-6  # CPU seconds, for the estimate alone
GOAL = 0.02  # rms speed over sqrt(g H)


class Cell:
    """One tank: its size [m], its water, and the words that set it."""

    def __init__(self, across, aspect, viscosity, slip):
        self.across, self.aspect, self.viscosity, self.slip = across, aspect, viscosity, slip
        self.dx = SIDE / across
        self.width, self.depth = (SIDE / aspect, SIDE) if aspect < 1.0 else (SIDE, SIDE * aspect)
        self.name = f"{across}-across-aspect-{aspect:g}-{viscosity:g}-Pa-s-{slip}-slip"

    @property
    def same_as(self):
        """Name of the cell that is the same run: without viscosity a wall cannot hold the water back, whatever its
        slip, and every bit is equal."""
        return self.name.replace("-no-slip", "-free-slip") if self.viscosity == 0.0 else self.name

    def particles(self):
        wide, deep = round(self.width / self.dx), round(self.depth / self.dx)
        return DEEP * ((wide + 2 * LAYERS) * (deep + 2 * LAYERS))

    def cost(self, seconds):
        """CPU seconds, by the bound of sound."""
        speed = 10.0 * math.sqrt(2.0 * G * self.depth)
        step = 0.45 * 2.6 * self.dx / speed
        return self.particles() * seconds / step * PER_PARTICLE_STEP

    def length(self, budget):
        return next((t for t in LENGTHS if self.cost(t) <= budget), None)

    def words(self, seconds, more):
        dx, w, d, y, rim, wall = self.dx, self.width, self.depth, DEEP * self.dx, LAYERS * self.dx, LAYERS * self.dx
        box = lambda low, high: (
            f'{{ kind = "box", min = {[round(v, 9) for v in low]}, max = {[round(v, 9) for v in high]} }}'
        )
        outside = box((-wall, 0.0, -wall), (w + wall, y, d + rim))
        sets = {
            "scene.end_time": seconds,
            "scene.output_interval": 0.25,
            "scene.spacing": dx,
            "scene.min": [round(-2 * wall, 9), 0.0, round(-2 * wall, 9)],
            "scene.max": [round(w + 2 * wall, 9), round(y, 9), round(d + 0.4, 9)],
            "metric.moving.window": [0.0, seconds],
            "metric.pressure.window": [0.0, seconds],
            "material.water.viscosity": self.viscosity,
            "body.tank.slip": f'"{self.slip}"',
            "body.water.shape": box((0.0, 0.0, 0.0), (w, y, d)),
            "body.tank.shape": f'{{ kind = "difference", from = {outside}, minus = '
            f"{box((0.0, -1.0, 0.0), (w, 1.0, d + 2.0))} }}",
        }
        return [word for key, value in (*sets.items(), *more) for word in ("--set", f"{key}={value}")]


def cells():
    return [Cell(a, s, v, p) for a in ACROSS for s in ASPECTS for v in VISCOSITIES for p in SLIPS]


def measure(folder, cell):
    """Speeds over sqrt(g H) by window, and energies over rho g H V."""
    import h5py
    import numpy

    with h5py.File(folder / "trajectory.h5", "r") as file:
        every = file["particles/all"]
        liquid = every["body/value"][0] < 0
        velocity = every["velocity/value"]
        time = numpy.asarray(every["velocity/time"])
        square = numpy.array([(numpy.asarray(velocity[n])[liquid] ** 2).sum(axis=1) for n in range(len(time))])
        energy = {
            name: numpy.asarray(file[f"observables/energy_{name}/value"])
            for name in ("walls", "time_integration", "bulk_viscous", "viscous")
        }
    unit, weight = math.sqrt(G * cell.depth), RHO * G * cell.depth * (cell.depth * cell.width * DEEP * cell.dx)
    rms, most = numpy.sqrt(square.mean(axis=1)) / unit, numpy.sqrt(square.max(axis=1)) / unit
    seen = {
        "liquid": int(liquid.sum()),
        "windows": [],
        "greatest_wall_work": float(abs(energy["walls"] - energy["walls"][0]).max() / weight),
    }
    for first, last in WINDOWS:
        inside = (time >= first) & (time <= last) & (time > 0.0)
        whole = inside.any() and time[-1] > first
        seen["windows"].append([float(rms[inside].max()), float(most[inside].max())] if whole else None)
    steps = energy["time_integration"] - energy["time_integration"][0]
    seen["steps"], seen["steps_most"] = float(steps[-1] / weight), float(abs(steps).max() / weight)
    seen["end_rms"] = float(rms[-1])
    return seen


def run_cell(cell, seconds, args, folder):
    words = [
        "nice",
        "-n",
        "10",
        args.tripoint,
        "run",
        "fluid/still-water-conservative",
        "--json",
        "--quiet",
        "--out",
        str(folder),
        *cell.words(seconds, [s.split("=", 1) for s in args.set]),
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=os.environ | {"OMP_NUM_THREADS": "1"})
    if not done.stdout.strip().startswith("{"):
        sys.exit(f"{cell.name}: {done.stderr[-800:]}")
    said = json.loads(done.stdout)
    row = {
        "name": cell.name,
        "across": cell.across,
        "aspect": cell.aspect,
        "viscosity": cell.viscosity,
        "slip": cell.slip,
        "asked": seconds,
        "status": said["status"],
        "reason": said["reason"],
        "time": said["time_reached"],
        "steps_made": said["steps"],
        "bound": said["time_step_bound"],
        "cpu_s": said["cost"]["cpu_s"],
    }
    if (folder / "trajectory.h5").exists():
        row |= measure(folder, cell)
    return row


def run(args):
    out = Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    chosen = sorted(
        (c for c in cells() if args.only in c.name),
        key=lambda c: (c.length(args.budget) is None, c.cost(c.length(args.budget) or 1.0)),
    )
    for cell in chosen:
        seconds, file = cell.length(args.budget), out / f"{cell.name}.json"
        if (
            seconds is None
            or cell.same_as != cell.name
            or (file.exists() and json.loads(file.read_text())["asked"] >= seconds)
        ):
            continue
        claim = out / f"{cell.name}.running"  # two of these programs may work on one folder
        try:
            claim.touch(exist_ok=False)
        except FileExistsError:
            continue
        try:
            row = run_cell(cell, seconds, args, out / "runs" / cell.name)
            file.write_text(json.dumps(row, indent=1) + "\n")
            last = next((w for w in reversed(row.get("windows", [])) if w), [float("nan")] * 2)
            print(
                f"{cell.name:48} {row['status']:9} {row['time']:5.1f} s, {row['cpu_s']:6.0f} CPU s, rms "
                f"{last[0]:.4f}, most {last[1]:.4f}",
                flush=True,
            )
        finally:
            claim.unlink()
            shutil.rmtree(out / "runs" / cell.name, ignore_errors=True)


def window_words(row, n):
    seen = row["windows"][n] if "windows" in row else None
    return f"{seen[0]:.4f} / {seen[1]:.3f}" if seen else "-"


def small(value):
    return "0" if value == 0.0 else re.sub(r"e([+-])0", r"e\1", f"{value:.1e}")


def table(rows):
    lines = [
        "| across | depth : width | viscosity [Pa s] | slip | ran [s] | 0-5 s | 5-20 s | 20-60 s | work of walls | "
        "made by steps |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for cell in cells():
        row = rows.get(cell.name) or rows.get(cell.same_as)
        if not row:
            continue
        ran = f"{row['time']:g}" if row["status"] == "ok" else f"{row['status']} at {row['time']:.3g}"
        slip = cell.slip if cell.name in rows else f"{cell.slip}, the same run"
        shape = f"{cell.aspect:g} : 1" if cell.aspect >= 1.0 else f"1 : {1.0 / cell.aspect:g}"
        lines.append(
            f"| {cell.across} | {shape} | {cell.viscosity:g} | {slip} | {ran} | {window_words(row, 0)} | "
            f"{window_words(row, 1)} | {window_words(row, 2)} | "
            f"{small(row.get('greatest_wall_work', float('nan')))} | {small(row.get('steps', float('nan')))} |"
        )
    return "\n".join(lines)


def summary(rows):
    """Sentences that count; nothing is said that the rows do not hold."""
    every = [rows.get(c.name) or rows.get(c.same_as) for c in cells()]
    done = [r for r in every if r and "windows" in r]
    lines = [
        f"{len(done)} of {len(cells())} tanks were run, "
        f"{sum(r['status'] == 'ok' and r['time'] >= 60.0 for r in done)} of them for 60 s. "
        f"{sum(r['status'] != 'ok' for r in done)} did not reach their end.",
        "",
    ]
    lines += [words for n in range(len(WINDOWS)) for words in window_sentence(done, n)]
    if done:
        lines.append(
            f"- Work of fixed walls: at most {small(max(r['greatest_wall_work'] for r in done))}. Energy made by "
            f"finite steps: at most {small(max(abs(r['steps_most']) for r in done))}."
        )
    return "\n".join(lines)


def window_sentence(done, n):
    seen = [(r["windows"][n][0], r["windows"][n][1], r["name"]) for r in done if r["windows"][n]]
    if seen:
        (first, last), worst, fastest = WINDOWS[n], max(seen), max(seen, key=lambda s: s[1])
        yield (
            f"- {first:g} to {last:g} s: {sum(s[0] < GOAL for s in seen)} of {len(seen)} stay below {GOAL:g} rms. "
            f"The worst has {worst[0]:.4f} (`{worst[2]}`), the fastest particle {fastest[1]:.3f}."
        )


def rows_of(place):
    """Rows by name, of a folder of cells or of a kept file."""
    place = Path(place)
    rows = (
        json.loads(place.read_text())
        if place.is_file()
        else [json.loads(p.read_text()) for p in sorted(place.glob("*.json"))]
    )
    return {r["name"]: r for r in rows}


def keep(args):
    for folder in args.out:
        file = Path(args.to) / f"{Path(folder).name}.json"
        kept = rows_of(file) if file.exists() else {}
        for name, row in rows_of(folder).items():
            if name not in kept or row["asked"] >= kept[name]["asked"]:
                kept[name] = row
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("[\n" + ",\n".join(json.dumps(kept[c.name]) for c in cells() if c.name in kept) + "\n]\n")


INTRODUCTION = """# Still water

Water at rest in an open tank must stay at rest. `tools/still_water.py` runs `fluid/still-water-conservative` in 72 \
other tanks. They have 5, 10 and 20 particles along the short side of 0.2 m, and
depths of 1:4 to 8:1 of the width. Viscosities are 0, 0.001 and 1 Pa s, and walls have slip or not. Tanks whose cost \
was above the budget ran shorter, or not at all. Without viscosity both kinds of wall give the same bits.

    tools/still_water.py table --out docs/still-water/laid-as-a-lattice.json docs/still-water/settled.json   # every \
tank: speeds by window, energies
    tools/still_water.py run --out settled --set scene.settle=true --budget 60   # an hour: measures anew

Speeds are over sqrt(g H), H being the depth. Energies are over rho g H V."""


def title_of(place):
    title = Path(place).stem.replace("-", " ")
    return f"\n## {title[0].upper() + title[1:]}\n"


def page(args):
    print(INTRODUCTION)
    for place in args.out:
        print(f"{title_of(place)}\n{summary(rows_of(place))}")


def print_table(args):
    for place in args.out:
        print(f"{title_of(place)}\n{table(rows_of(place))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    runs = verbs.add_parser("run")
    runs.add_argument("--out", required=True)
    runs.add_argument("--budget", type=float, default=1e9, help="CPU seconds a cell may cost")
    runs.add_argument("--only", default="", help="cells with this text in their name")
    runs.add_argument("--set", action="append", default=[], help="a.b=VALUE, for every cell")
    runs.add_argument("--tripoint", default=str(ROOT / "build/bin/tripoint"))
    for verb in ("page", "table"):
        verbs.add_parser(verb).add_argument("--out", nargs="+", required=True)
    keeps = verbs.add_parser("keep")
    keeps.add_argument("--out", nargs="+", required=True)
    keeps.add_argument("--to", required=True)
    args = parser.parse_args()
    return {"run": run, "keep": keep, "page": page, "table": print_table}[args.verb](args)


if __name__ == "__main__":
    sys.exit(main())
