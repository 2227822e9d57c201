# SPDX-License-Identifier: BSD-3-Clause
"""Case files as Python tables: templates with drawn values, TOML text, scaling by units, turning and mirroring."""

import copy
import math
import re
import tomllib

import numpy as np

VECTORS = {
    "velocity",
    "angular_velocity",
    "gravity",
    "wave_vector",
    "point",
    "normal",
    "centre",
    "base",
    "axis",
    "position",
}
AXIAL = {"angular_velocity"}


# --- templates


def draw(rule, rng):
    """A value by its rule: { from, to } even, { low, high } even in its logarithm, { whole = [a, b] }."""
    if "whole" in rule:
        return int(rng.integers(rule["whole"][0], rule["whole"][1] + 1))
    if "low" in rule:
        return float(np.exp(rng.uniform(np.log(rule["low"]), np.log(rule["high"]))))
    return float(rng.uniform(rule["from"], rule["to"]))


def drawn_values(head, rng):
    """Drawn numbers in the order of the template, then those that follow from them."""
    values = {name: draw(rule, rng) for name, rule in head.get("draw", {}).items()}
    for name, formula in head.get("derive", {}).items():
        values[name] = evaluated(formula, values)
    return values


def evaluated(formula, values):
    names = {n: getattr(math, n) for n in ("sqrt", "pi", "cos", "sin", "exp", "tanh", "log")}
    return eval(formula, {"__builtins__": {}, **names, "min": min, "max": max, "round": round, "abs": abs}, values)


def parts(text):
    """The head of a template, above the line `# case`, and the text of its case."""
    head, _, body = text.partition("\n# case\n")
    return tomllib.loads(head), body


def filled(body, values):
    """The case as a table: every ${formula} replaced by its value."""
    return tomllib.loads(re.sub(r"\$\{(.+?)\}", lambda m: repr(evaluated(m[1], values)).replace("'", '"'), body))


# --- TOML text


def inline(v):
    if isinstance(v, bool):
        return "true" if v else "false"
    if isinstance(v, str):
        return '"' + v.replace('"', '\\"') + '"'
    if isinstance(v, (list, tuple)):
        return "[" + ", ".join(inline(x) for x in v) + "]"
    if isinstance(v, dict):
        return "{ " + ", ".join(f"{k} = {inline(x)}" for k, x in v.items()) + " }"
    return repr(v)


def toml(case):
    lines = ["format = 1"]
    for name, table in case.items():
        if not isinstance(table, (dict, list)):
            continue
        several = isinstance(table, list)
        for one in table if several else [table]:
            lines += ["", f"[[{name}]]" if several else f"[{name}]"]
            lines += [f"{k} = {inline(v)}" for k, v in one.items()]
    return "\n".join(lines) + "\n"


# --- boxes


def corners(shape):
    """The box around a shape: its lower and its upper corner."""
    kind = shape["kind"]
    if kind == "box":
        return np.array(shape["min"], float), np.array(shape["max"], float)
    if kind == "sphere":
        c, r = np.array(shape["centre"], float), shape["radius"]
        return c - r, c + r
    if kind == "cylinder":
        axis = np.array(shape.get("axis", [0, 0, 1]), float)
        axis /= np.linalg.norm(axis)
        ends = np.array([shape["base"], np.array(shape["base"]) + axis * shape["length"]], float)
        rim = shape["radius"] * np.sqrt(np.maximum(0.0, 1.0 - axis**2))
        return ends.min(0) - rim, ends.max(0) + rim
    if kind == "difference":
        return corners(shape["from"])
    raise ValueError(f"no box of a {kind}")


def box_of(case):
    lows, highs = zip(*(corners(b["shape"]) for b in case["body"]), strict=True)
    return np.min(lows, 0), np.max(highs, 0)


# --- scaling

LENGTH, TIME, SPEED, RATE, HEAT = (1, 0, 0), (0, 0, 1), (1, 0, -1), (0, 0, -1), (2, 0, -2)
STRESS, VISCOSITY, CONDUCTIVITY = (-1, 1, -2), (-1, 1, -1), (1, 1, -3)
UNITS = {  # powers of length, mass and time of each key that has a unit
    "scene": {"end_time": TIME, "output_interval": TIME, "time_step": TIME, "gravity": (1, 0, -2)}
    | dict.fromkeys(("spacing", "min", "max"), LENGTH),
    "material": {"density": (-3, 1, 0), "stiffness": HEAT, "sound_speed": SPEED, "viscosity": VISCOSITY}
    | {"young_modulus": STRESS, "conductivity": CONDUCTIVITY, "solid_conductivity": CONDUCTIVITY}
    | dict.fromkeys(("heat_capacity", "solid_heat_capacity", "latent_heat"), HEAT),
    "shape": dict.fromkeys(("min", "max", "centre", "radius", "base", "length", "point"), LENGTH),
    "body": {"velocity": SPEED, "angular_velocity": RATE},
    "temperature": {"wave_vector": (-1, 0, 0), "point": LENGTH},
    "velocity": dict.fromkeys(("speed", "amplitude", "mean"), SPEED)
    | {"wavelength": LENGTH, "centre": LENGTH, "wave_vector": (-1, 0, 0), "gradient": RATE},
    "keyframes": {"time": TIME, "position": LENGTH},
}


def scaled(case, length, mass, time):
    """The same scene in other units, or a similar one: every number with a unit is multiplied by its powers."""

    def times(v, powers):
        factor = length ** powers[0] * mass ** powers[1] * time ** powers[2]
        return (
            [times(x, powers) for x in v] if isinstance(v, list) else v * factor if isinstance(v, (int, float)) else v
        )

    def through(table, where):
        for key, v in table.items():
            if isinstance(v, dict) and v.get("kind") == "expression":
                raise ValueError("formulas have no units")
            if isinstance(v, dict):
                through(v, "shape" if key in ("from", "minus") else key)
            elif key == "keyframes":
                for k in v:
                    through(k, "keyframes")
            elif key in UNITS.get(where, {}):
                table[key] = times(v, UNITS[where][key])

    case = copy.deepcopy(case)
    through(case["scene"], "scene")
    for name in ("material", "body"):
        for table in case[name]:
            through(table, name)
    return case


# --- turning


def quaternion(axis, angle):
    axis = np.array(axis, float) / np.linalg.norm(axis)
    return [float(math.cos(angle / 2)), *(float(x) for x in math.sin(angle / 2) * axis)]


def matrix(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def product(a, b):
    (w, x, y, z), (s, t, u, v) = a, b
    return [
        w * s - x * t - y * u - z * v,
        w * t + x * s + y * v - z * u,
        w * u - x * v + y * s + z * t,
        w * v + x * u - y * t + z * s,
    ]


def moved_shape(shape, A, turn):
    """A shape by an orthogonal matrix; `turn`, the same as a quaternion, where it does not map axes on axes."""
    shape = copy.deepcopy(shape)
    kind = shape["kind"]
    if kind == "sphere":
        shape["centre"] = (A @ shape["centre"]).tolist()
    elif kind == "cylinder":
        shape["base"] = (A @ shape["base"]).tolist()
        shape["axis"] = (A @ shape.get("axis", [0, 0, 1])).tolist()
    elif kind == "difference" and turn is None:
        shape["from"], shape["minus"] = moved_shape(shape["from"], A, None), moved_shape(shape["minus"], A, None)
    elif kind == "box" and turn is None:
        ends = np.array([A @ shape["min"], A @ shape["max"]])
        shape["min"], shape["max"] = ends.min(0).tolist(), ends.max(0).tolist()
    elif kind == "box":
        low, high = corners(shape)
        centre = A @ (0.5 * (low + high))
        shape["min"], shape["max"] = (centre - 0.5 * (high - low)).tolist(), (centre + 0.5 * (high - low)).tolist()
        shape["rotation"] = turn
    else:
        raise ValueError(f"a {kind} is not turned off the axes")
    return shape


def moved_fields(table, A, det):
    for key, v in table.items():
        if isinstance(v, dict) and v.get("kind") in ("expression", "taylor_green"):
            raise ValueError("formulas and vortices are not turned")
        if isinstance(v, dict) and v.get("kind") == "linear":
            v["gradient"] = (A @ np.array(v["gradient"]) @ A.T).tolist()
            v["centre"] = (A @ v.get("centre", [0, 0, 0])).tolist()
        elif isinstance(v, dict) and key != "shape":
            moved_fields(v, A, det)
        elif key in VECTORS | {"amplitude", "mean"} and isinstance(v, list):
            table[key] = ((det if key in AXIAL else 1.0) * (A @ v)).tolist()
        elif key == "keyframes":
            for k in v:
                if k.get("rotation", [1, 0, 0, 0])[0] != 1:
                    raise ValueError("keyframes that turn are not turned")
                k["position"] = (A @ k["position"]).tolist()


def moved(case, A, turn=None):
    """A scene by an orthogonal matrix. Without `turn` the matrix maps axes on axes."""
    case = copy.deepcopy(case)
    s = case["scene"]
    if turn is not None and s.get("periodic"):
        raise ValueError("periodic directions are not turned off the axes")
    s["gravity"] = (A @ s.get("gravity", [0, 0, 0])).tolist()
    if "min" in s and turn is None:
        ends = np.array([A @ s["min"], A @ s["max"]])
        s["min"], s["max"] = ends.min(0).tolist(), ends.max(0).tolist()
        s["periodic"] = ["xyz"[int(np.argmax(np.abs(A[:, "xyz".index(p)])))] for p in s.get("periodic", [])]
    elif "min" in s:
        del s["min"], s["max"]
    for b in case["body"]:
        own = b.pop("rotation", None)
        b["shape"] = moved_shape(b["shape"], A, turn)
        if own is not None:
            whole = mirrored_turn(own, A) if turn is None else product(turn, own)
            b["shape"].pop("rotation", None)
            b["rotation"] = whole
        moved_fields(b, A, round(float(np.linalg.det(A))))
    return case


def mirrored_turn(q, A):
    """The turn of a box whose axes a matrix has mapped on axes: A R A^-1."""
    axis = round(float(np.linalg.det(A))) * (A @ q[1:])
    return [q[0], *axis.tolist()]
