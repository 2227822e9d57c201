# SPDX-License-Identifier: BSD-3-Clause
"""The generator of scenes draws the same from a seed, sees what it should, and a small draw is as known today."""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

program, source = sys.argv[1:]
tools = pathlib.Path(source) / "tools/generality"
sys.path.insert(0, str(tools))
os.environ["TRIPOINT"] = program
import changes
import generality
import scenes

SEED = 61
SMALL = {"drawn": "18", "bystanders": "10", "symmetries": "10"}  # scenes
LONG = {"float", "stefan", "vortices", "wave"}  # half a minute a scene: the suite has such cases of its own
QUICK = ",".join(sorted({f.stem for f in (tools / "families").glob("*.toml")} - LONG))


def check_seeds():
    for name in (f.stem for f in (tools / "families").glob("*.toml")):
        once, again, other = (generality.drawn(name, seed, 3) for seed in (5, 5, 6))
        assert once[1:] == again[1:], f"{name}: one seed, two scenes"
        assert once[1] != other[1], f"{name}: two seeds, one scene"


def check_turning():
    case = generality.drawn("flight", 5, 0)[2]
    turned, place_of, _ = changes.SYMMETRIES["turned-oblique"](case)
    back = scenes.moved(turned, scenes.matrix(scenes.quaternion([1, 2, 3], -0.8)), scenes.quaternion([1, 2, 3], -0.8))
    assert np.allclose(back["body"][0]["velocity"], case["body"][0]["velocity"], rtol=1e-14)
    assert not np.allclose(turned["body"][0]["velocity"], case["body"][0]["velocity"], rtol=1e-2)


def check_deviation():
    """A particle that goes a hundredth of the way too far is seen, whatever the order of particles."""
    x = np.zeros((2, 4, 3))
    x[:, :, 0] = np.arange(4)
    x[1, :, 2] = 1.0
    times = np.array([0.0, 1.0])
    y = x[:, ::-1].copy()
    assert generality.deviation((times, x, None), (times, y, None), changes.same, 1.0, 1.0, 1.0)["error"] == 0.0
    y[1, 0, 2] += 0.02
    assert (
        abs(generality.deviation((times, x, None), (times, y, None), changes.same, 1.0, 1.0, 1.0)["error"] - 0.01)
        < 1e-9
    )
    assert "failed" in generality.deviation((times, x, None), (times, x[:, :3], None), changes.same, 1.0, 1.0, 1.0)


def check_verdicts():
    known = {"band": [2.0, 8.0]}
    assert not generality.verdict([0.1] * 19 + [0.9], None)[1]
    assert generality.verdict([0.1] * 18 + [1.1, 1.2], None)[1]
    assert not generality.verdict([4.0], known)[1]
    assert "better" in generality.verdict([0.9], known)[1]
    assert "worse" in generality.verdict([9.0], known)[1]
    assert generality.verdict([float("inf")], known)[1], "a run that fails is worse than any figure"


def small_draw(kind, folder):
    words = ["--kinds", kind, "--scenes", SMALL[kind], "--seed", str(SEED), "--families", QUICK, "--out", folder]
    command = [sys.executable, "-B", str(tools / "generality.py"), *words]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr[-3000:]
    page = (pathlib.Path(folder) / "index.html").read_text()
    assert page.count("<svg") == done.stdout.count("95th percentile"), "one plot a family and kind"
    rows = [f.stat().st_mtime for f in sorted(pathlib.Path(folder).glob(f"seed-{SEED}/rows/{kind}*.json"))]
    assert len(rows) == int(SMALL[kind])
    again = subprocess.run(command, capture_output=True, text=True)
    after = [f.stat().st_mtime for f in sorted(pathlib.Path(folder).glob(f"seed-{SEED}/rows/{kind}*.json"))]
    assert again.stdout == done.stdout and rows == after, "a finished draw is read, not run again"


check_seeds()
check_turning()
check_deviation()
check_verdicts()
with tempfile.TemporaryDirectory() as folder:
    for kind in SMALL:
        small_draw(kind, folder)
