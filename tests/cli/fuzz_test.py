# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes: fuzz_test.py TRIPOINT [SCENES=25] [FIRST_SEED=1] [FOLDER].

Each seed is one small scene of up to four bodies over the stated ranges. None may crash, hang or end in a state that is
not finite without a name; fewer than one in a hundred may diverge, and each that does is printed with its seed and the
guard's words. With FOLDER the scenes are kept there as SEED.toml."""

import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

TRIPOINT = sys.argv[1]
SCENES = int(sys.argv[2]) if len(sys.argv) > 2 else 25
FIRST = int(sys.argv[3]) if len(sys.argv) > 3 else 1
DX = 0.01  # [m]
RANGES = (
    "densities 200 to 4000 kg/m3, E 1e3 to 3e5 Pa, Poisson's ratio -0.3 to 0.45, viscosity 1e-3 to 10 Pa s, 280 "
    "to 420 K about a melting point of 350 K, latent heat 0 to 1e5 J/kg, speeds up to a tenth of sound, spins up to "
    "20 rad/s, jitter up to 0.1"
)


def log_uniform(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


def vector(values):
    return "[" + ", ".join(f"{v:.6g}" for v in values) + "]"


def spin(size, values):
    """Without what no particle feels: a line of particles has no spin about itself, a single one has none; both are
    refused."""
    return [0.0 if all(size[b] == 1 for b in range(3) if b != a) else v for a, v in enumerate(values)]


def material(r, name, melts, sound):
    solid = r.choice(("rigid", "elastic"))
    lines = [
        "[[material]]",
        f'name = "{name}"',
        f"density = {log_uniform(r, 200, 4000):.6g}",
        f"viscosity = {log_uniform(r, 1e-3, 10):.4g}",
        f"sound_speed = {sound:.4g}",
        f"young_modulus = {log_uniform(r, 1e3, 3e5):.4g}",
        f"poisson_ratio = {r.uniform(-0.3, 0.45):.3f}",
        f'solid = "{solid}"',
    ]
    if melts:
        lines += [
            f"conductivity = {log_uniform(r, 1, 1000):.4g}",
            f"heat_capacity = {log_uniform(r, 500, 4000):.4g}",
            "t_melt = 350.0",
            f"t_solid = {350 - r.choice((0, 1, 10))}",
            f"latent_heat = {r.choice((0.0, log_uniform(r, 1e2, 1e5))):.4g}",
        ]
    return solid, lines


def scene(seed):
    """@return the text of a case file"""
    r = random.Random(seed)
    sound, heat, gravity = r.uniform(5, 20), r.random() < 0.6, r.random() < 0.5
    lines = [
        "format = 1",
        "[case]",
        f'title = "random scene {seed}"',
        'requirement = "R-HARD-FUZZ"',
        'claims = "it ends, or says why not"',
        "[scene]",
        "end_time = 0.05",
        f"spacing = {DX}",
        f"jitter = {r.choice((0.0, r.uniform(0, 0.1))):.3g}",
        f"gravity = [0.0, 0.0, {-9.81 if gravity else 0.0}]",
        f"seed = {seed}",
        f"contact_viscosity = {r.choice((0.0, 1.0))}",
        "output_interval = 0.005",
    ]
    names = ["a", "b", "c"][: r.randint(1, 3)]
    solids = {}
    for name in names:
        solids[name], more = material(r, name, heat, sound)
        lines += more
    for n in range(r.randint(1, 4)):
        name = r.choice(names)
        size = [r.randint(1, 4) for _ in range(3)]
        low = [6 * DX * (n % 2), 6 * DX * (n // 2), DX * r.randint(0, 2)]
        temperature = r.uniform(280, 420)
        molten = temperature > 350 if heat else r.random() < 0.4
        phase = "liquid" if molten else solids[name]
        lines += [
            "[[body]]",
            f'name = "body {n}"',
            f'material = "{name}"',
            f'phase = "{phase}"',
            f"velocity = {vector(r.uniform(-1, 1) * sound / 17.4 for _ in range(3))}",
            f"angular_velocity = {vector(spin(size, [r.uniform(-11, 11) for _ in range(3)]))}",
            f'shape = {{ kind = "box", min = {vector(low)}, max = {vector(a + b * DX for a, b in zip(low, size))} }}',
        ]
        if heat:
            lines.append(f"temperature = {temperature:.4g}")
    if r.random() < 0.5:
        lines += [
            "[[body]]",
            'name = "floor"',
            f'material = "{names[0]}"',
            'phase = "rigid"',
            'motion = "fixed"',
            f'shape = {{ kind = "box", min = {vector([-3 * DX, -3 * DX, -3 * DX])}, max = '
            f"{vector([13 * DX, 13 * DX, 0])} }}",
        ]
        if heat:
            lines += [f"temperature = {r.uniform(250, 349):.4g}", "temperature_held = true"]
    lines += [
        "[reference]",
        'kind = "invariant"',
        "[[metric]]",
        'name = "ledger"',
        'quantity = "ledger.residual"',
        'norm = "drift"',
    ]
    return "\n".join(lines) + "\n"


def run(seed, folder):
    """@return (word, explanation): ok, diverged, refused, and what must not be: crashed, hung, unnamed"""
    case = folder / f"{seed}.toml"
    case.write_text(scene(seed))
    try:
        ended = subprocess.run(
            [TRIPOINT, "run", str(case), "--out", str(folder / "out"), "--json", "--quiet"],
            capture_output=True,
            text=True,
            timeout=300,
        )
    except subprocess.TimeoutExpired:
        return "hung", "300 s"
    if ended.returncode == 2:
        return "refused", ended.stderr.strip()[-300:]
    try:
        told = json.loads(ended.stdout)
    except ValueError:
        return "crashed", f"exit {ended.returncode}: {ended.stderr.strip()[-300:]}"
    if ended.returncode == 7:
        named = json.loads((folder / "out/result.json").read_text())["divergence"]
        return ("diverged" if named and named["guard"] and named["field"] else "unnamed"), told["reason"]
    if ended.returncode != 0:
        return "crashed", f"exit {ended.returncode}: {told['reason']}"
    return (
        ("ok", "") if told["metrics"]["ledger"]["value"] is not None else ("unnamed", told["metrics"]["ledger"]["note"])
    )


def main():
    counts, bad = {}, []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(sys.argv[4]) if len(sys.argv) > 4 else Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        for seed in range(FIRST, FIRST + SCENES):
            word, why = run(seed, folder)
            counts[word] = counts.get(word, 0) + 1
            if word != "ok":
                print(f"seed {seed}: {word}: {why}", flush=True)
            if word in ("crashed", "hung", "unnamed", "refused"):
                bad.append(seed)
    print(
        f"{SCENES} scenes from seed {FIRST} on ({RANGES}): "
        + ", ".join(f"{n} {word}" for word, n in sorted(counts.items()))
    )
    return 1 if bad or counts.get("diverged", 0) > max(1, SCENES // 100) else 0


if __name__ == "__main__":
    sys.exit(main())
