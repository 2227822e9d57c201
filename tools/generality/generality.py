#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of generality: scenes that are drawn, not chosen, each with a known answer.

    tools/generality/generality.py --scenes 200 --seed 7 --jobs 2 --out DIR    runs, resumes, writes DIR/index.html

drawn: each family of tools/generality/families with drawn sizes, materials and spacings; the error over its limit.
bystanders: a drawn scene again with something far away; its matter moves as before within 1 % of the family's limit.
symmetries: a drawn scene mirrored, turned, boosted, in other units; its matter moves as before within what is stated.
--scenes is for each kind. Exit 1 where the 95th percentile of a group is above its limit, or outside its band
in known.toml.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import zlib

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import changes
import page
import scenes
from page import used

ROOT = HERE.parents[1]
PROGRAM = os.environ.get("TRIPOINT", str(ROOT / "build/bin/tripoint"))
TEMPLATES = HERE / "families"
SHARE_OF_LIMIT = 0.01  # of a bystander
EXACT = 1e-6  # of a symmetry, of the way that matter goes: round-off that a run has amplified
EARLY = 0.2  # of a run of liquid, whose flow amplifies round-off: a symmetry is judged until then
ROUND_OFF = 1e-10


def family(name):
    head, body = scenes.parts((TEMPLATES / f"{name}.toml").read_text())
    return head, body


def drawn(name, seed, n):
    """The n-th scene of a family: its head, drawn values and case."""
    head, body = family(name)
    values = scenes.drawn_values(head, np.random.default_rng([seed, zlib.crc32(name.encode()), n]))
    case = scenes.filled(body, values)
    case["case"] = {"title": head["title"]}
    return head, values, case


# --- runs


def run(case, folder):
    """Runs a case: what `tripoint run --json` prints, or {"failed": why}."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case.toml").write_text(scenes.toml(case))
    command = [PROGRAM, "run", str(folder / "case.toml"), "--out", str(folder), "--quiet", "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    try:
        found = json.loads(done.stdout)
    except ValueError:
        return {"failed": (done.stderr or done.stdout).strip()[-400:]}
    return found if found["status"] == "ok" else {"failed": f"{found['status']}: {found['reason']}"}


def frames(folder, count=None):
    """Times, places and temperatures of the first `count` particles of a run."""
    with h5py.File(folder / "trajectory.h5") as f:
        all_ = f["particles/all"]
        heat = all_["temperature/value"][:, :count] if "temperature" in all_ else None
        return all_["position/time"][:], all_["position/value"][:, :count], heat


def judged(head, values, found):
    value = found["metrics"].get(head["figure"], {}).get("value")
    if value is None:
        return {"failed": f"no figure: {found['metrics'].get(head['figure'])}"}
    limit = scenes.evaluated(head["limit"], values)
    return {"error": abs(value), "value": value, "limit": limit}


def order(places, dx):
    """Rows sorted by place, to a thousandth of a spacing: one particle of each of two scenes has one rank."""
    return np.lexsort(np.round(places / dx * 1e3 + 0.123).T)


def until(run, share):
    """The first frames of a run."""
    times, x, T = run
    count = int(np.sum(times <= share * times[-1] * 1.001))
    return times[:count], x[:count], None if T is None else T[:count]


def deviation(base, other, place_of, length, time, dx):
    """Largest rms distance of matter from its place in the base run, over the way that it goes there. The same of
    temperatures, over their range."""
    times, x, T = base
    times2, y, T2 = other
    if len(times) != len(times2) or np.abs(times2 / time - times).max() > 1e-6 * times[-1]:
        return {"failed": "other times"}
    mapped = np.array([place_of(a, t) for a, t in zip(x, times, strict=True)])
    i, j = order(mapped[0], dx * length), order(y[0], dx * length)
    if len(i) != len(j) or np.abs(mapped[0][i] - y[0][j]).max() > 1e-3 * dx * length:
        return {"failed": "other particles at the start"}
    rms = lambda a: np.sqrt(np.nanmean(np.sum(a * a, -1), -1))  # noqa: E731
    way, worst = rms(x - x[0]).max() * length, rms(mapped[:, i] - y[:, j]).max()
    error = worst / way if way > 0 else 0.0
    if T is not None and np.ptp(T[0]) > 0:
        error = max(error, float(np.sqrt(np.nanmean((T[:, i] - T2[:, j]) ** 2, -1)).max() / np.ptp(T[0])))
    return {"error": float(error), "limit": EXACT}


# --- tasks


def base_run(out, name, seed, n):
    """The drawn scene on its own, run once."""
    folder = out / "runs" / f"drawn-{name}-{n}"
    head, values, case = drawn(name, seed, n)
    found = folder / "found.json"
    if not found.exists():
        found_now = run(case, folder)
        found.write_text(json.dumps(found_now))
    return folder, head, values, case, json.loads(found.read_text())


def do_drawn(out, seed, name, n, _):
    folder, head, values, _, found = base_run(out, name, seed, n)
    row = {"failed": found["failed"]} if "failed" in found else judged(head, values, found)
    if "cost" in found:
        row["cpu"] = found["cost"]["cpu_s"]
    return {**row, "drawn": values}


def changed(kind, case, change):
    """The changed case, and how places and times of the first one lie in it."""
    if kind == "bystanders":
        other, place_of, time = changes.beside(case, change), changes.same, 1.0
    else:
        other, place_of, time = changes.SYMMETRIES[change](case)
    return bare(other), place_of, time


def bare(case):
    """Without its truth, which may not hold for more bodies: a run alone."""
    ledger = {"name": "ledger", "quantity": "ledger.residual", "norm": "drift"}
    return {**case, "reference": {"kind": "invariant"}, "metric": [ledger]}


def at_equal_steps(pair, steps, folder, compare):
    """The same comparison with as many steps in both runs: what is left is no error of the step."""
    for name, case in zip(("one", "other"), pair, strict=True):
        step = {"time_step": case["scene"]["end_time"] / steps}
        if "failed" in run(bare({**case, "scene": {**case["scene"], **step}}), folder / name):
            return None
    return compare(folder / "one", folder / "other").get("error")


def do_change(kind, out, seed, name, n, change):
    folder, head, values, case, found = base_run(out, name, seed, n)
    if "failed" in found:
        return {"skipped": "the scene alone fails"}
    try:
        other, place_of, time = changed(kind, case, change)
    except ValueError as why:
        return {"skipped": str(why)}
    its = out / "runs" / f"{kind}-{name}-{n}-{change}"
    found = run(other, its)
    if "failed" in found:
        return {"failed": found["failed"], "drawn": values}
    dx = case["scene"]["spacing"]
    length = other["scene"]["spacing"] / dx
    count = frames(folder)[1].shape[1] if kind == "bystanders" else None
    share = EARLY if kind == "symmetries" and head["room"] == "liquid" else 1.0

    def compare(one, two):
        return deviation(until(frames(one), share), until(frames(two, count), share), place_of, length, time, dx)

    row = compare(folder, its)
    if kind == "bystanders":
        row["limit"] = max(SHARE_OF_LIMIT * scenes.evaluated(head["limit"], values), ROUND_OFF)
    if used(row) > 1.0:
        row["at equal steps"] = at_equal_steps((case, other), found["steps"], its, compare)
    if used(row) <= 1.0:
        shutil.rmtree(its, ignore_errors=True)
    return {**row, "drawn": values}


def task(args):
    out, seed, kind, name, n, change = args
    row_file = out / "rows" / f"{kind}-{name}-{n}-{change}.json"
    if row_file.exists():
        return json.loads(row_file.read_text())
    do = do_drawn if kind == "drawn" else lambda *a: do_change(kind, *a)
    try:
        row = do(out, seed, name, n, change)
    except Exception as e:
        row = {"failed": repr(e)}
    row = {"kind": kind, "family": name, "scene": n, "change": change, **row}
    row_file.write_text(json.dumps(row))
    return row


def tasks(out, seed, kinds, names, count):
    """One family after another; pairs of a family and a change in an order of their own."""
    listed = []
    for kind in kinds:
        of_kind = {"drawn": [""], "bystanders": changes.BYSTANDERS, "symmetries": changes.SYMMETRIES}[kind]
        every = [(name, change) for change in of_kind for name in names]
        if kind != "drawn":
            every = [every[i] for i in np.random.default_rng([seed, zlib.crc32(kind.encode())]).permutation(len(every))]
        for n in range(count):
            name, change = every[n % len(every)]
            listed.append((out, seed, kind, name, n // len(every), change))
    return listed


# --- verdicts


def groups(rows):
    """Rows by kind and family: what a percentile is taken of."""
    found = {}
    for row in rows:
        if "skipped" in row:
            continue
        found.setdefault((row["kind"], row["family"]), []).append(row)
    return found


def verdict(shares, known):
    """95th percentile, why it is not as expected ("" where it is), and what is known of it."""
    at = float(np.quantile(shares, 0.95, method="higher"))
    if known is None:
        return at, "" if at <= 1.0 else "above its limit", None
    low, high = known["band"]
    if at < low and len(shares) >= known.get("scenes", 1):
        return at, f"better than known ({low} to {high}): take it off the list, or narrow its band", known
    return at, "" if at <= high else f"worse than known ({low} to {high})", known


def options():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--scenes", type=int, default=200, help="of each kind")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--jobs", type=int, default=1)
    p.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/generality"))
    p.add_argument("--kinds", default="drawn,bystanders,symmetries")
    p.add_argument("--families", default=",".join(sorted(f.stem for f in TEMPLATES.glob("*.toml"))))
    return p.parse_args()


def main():
    a = options()
    out = a.out / f"seed-{a.seed}"
    (out / "rows").mkdir(parents=True, exist_ok=True)
    rows = []
    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for row in pool.map(task, tasks(out, a.seed, a.kinds.split(","), a.families.split(","), a.scenes)):
            rows.append(row)
            print(line(row), file=sys.stderr, flush=True)
    found = groups(rows)
    verdicts = {key: verdict([used(r) for r in group], page.known().get(key)) for key, group in found.items()}
    print(f"seed {a.seed}")
    for key, (at, why, entry) in sorted(verdicts.items()):
        word = why or ("known" if entry else "")
        print(f"{key[0]:11} {key[1]:20} {len(found[key]):4} scenes, 95th percentile {at:9.3g} of the limit  {word}")
    (out / "rows.json").write_text(json.dumps({"seed": a.seed, "rows": rows}, indent=1))
    (a.out / "index.html").write_text(page.page(a.seed, found, {k[1]: family(k[1])[0] for k in found}, verdicts))
    print(a.out / "index.html")
    return 1 if any(why for _, why, _ in verdicts.values()) else 0


def line(row):
    what = row.get("skipped") or row.get("failed") or f"{row['error']:.3g} of {row['limit']:.3g}: {used(row):.3g}"
    return f"{row['kind']} {row['family']} {row['scene']} {row['change']}: {what}"


if __name__ == "__main__":
    sys.exit(main())
