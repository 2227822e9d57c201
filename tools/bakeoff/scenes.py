# SPDX-License-Identifier: BSD-3-Clause
"""Scenes with a known answer, to compare schemes: each is a case file by resolution, and a judge of its run.

A slab of 5 spacings across y, periodic, stands for a flow in two dimensions. The first figure of a judge is the error.
"""

import math

import numpy as np

G = 9.81
PI = math.pi


def head(end, dx, every, **keys):
    lines = ["format = 1", "[scene]", f"end_time = {end}", f"spacing = {dx}", f"output_interval = {every}"]
    return "\n".join(lines + [f"{k} = {v}" for k, v in keys.items()]) + "\n"


def liquid(name, density, viscosity, sound):
    return f'[[material]]\nname = "{name}"\ndensity = {density}\nviscosity = {viscosity}\nsound_speed = {sound}\n'


def body(name, material, shape, **keys):
    more = "".join(f"{k} = {v}\n" for k, v in keys.items())
    return f'[[body]]\nname = "{name}"\nmaterial = "{material}"\nshape = {shape}\n{more}'


def box(lo, hi):
    return f'{{ kind = "box", min = {list(lo)}, max = {list(hi)} }}'


def minus(a, b):
    return f'{{ kind = "difference", from = {a}, minus = {b} }}'


def tank(x0, x1, z0, z1, w, dx, sides=True, lid=False):
    """Walls of four layers around x0..x1, z0..z1."""
    t = 4 * dx
    out = box([x0 - (t if sides else 0), 0, z0 - t], [x1 + (t if sides else 0), w, z1 + (t if lid else 0)])
    inner = box([x0 if sides else x0 - 1, -1, z0], [x1 if sides else x1 + 1, 1 + w, z1 if lid else z1 + 1])
    return '[[material]]\nname = "glass"\ndensity = 1000.0\n' + body(
        "tank", "glass", minus(out, inner), phase='"rigid"', motion='"fixed"'
    )


TAIL = '[reference]\nkind = "invariant"\n[[metric]]\nname = "momentum"\nquantity = "ledger.residual"\nnorm = "drift"\n'
WET = {"phase": '"liquid"'}


def domain(lo, hi, periodic):
    return {"min": list(lo), "max": list(hi), "periodic": str(periodic).replace("'", '"')}


def fall(n):
    dx = 0.4 / n
    text = head(0.5, dx, 0.1, gravity=[0.0, 0.0, -G]) + liquid("water", 1000.0, 1e-3, 14.0)
    return text + body("cube", "water", box([0, 0, 0], [0.4, 0.4, 0.4]), **WET) + TAIL


def judge_fall(run, n):
    x = run.places(-1) - run.places(0)
    return {"distortion/side": float(np.abs(x - x.mean(0)).max() / 0.4)}


def still(n):
    dx, H = 0.2 / n, 0.2
    end = round(60 * math.sqrt(H / G), 3)
    text = head(
        end, dx, end / 60, gravity=[0.0, 0.0, -G], jitter=0.2, **domain([-0.1, 0, -0.1], [0.3, 5 * dx, 0.5], ["y"])
    )
    text += liquid("water", 1000.0, 1e-3, 10 * math.sqrt(G * H)) + tank(0, 0.2, 0, 0.3, 5 * dx, dx)
    return text + body("pool", "water", box([0, 0, 0], [0.2, 5 * dx, H]), **WET) + TAIL


def judge_still(run, n):
    H, dx = 0.2, 0.2 / n
    late = range(int(0.8 * run.frames), run.frames)
    speed = np.sqrt(np.mean([np.mean(np.sum(run.speeds(f) ** 2, 1)) for f in late]))
    level = np.mean([2 * run.places(f)[:, 2].mean() / H for f in late])
    p = [run.pressure(f) - 1000 * G * (level * H - run.places(f)[:, 2]) for f in late]
    first, last = run.places(1), run.places(-1)
    return {
        "speed/sqrt(gH)": float(speed / math.sqrt(G * H)),
        "pressure rms/(rho g H)": float(np.sqrt(np.mean(np.square(p))) / (1000 * G * H)),
        "level": float(level),
        "way/dx": float(np.sqrt(np.mean(np.sum((last - first)[:, [0, 2]] ** 2, 1))) / dx),
        "energy gained": run.gained(),
    }


def wave(n, periods=4):
    dx, h, k, a = 1.0 / n, 0.5, 2 * PI, 0.025
    om = math.sqrt(G * k * math.tanh(k * h))
    T = 2 * PI / om
    u = f"-{a * om}*cosh({k}*z)/sinh({k * h})*sin({k}*x)"
    w = f"{a * om}*sinh({k}*z)/sinh({k * h})*cos({k}*x)"
    text = head(
        round(periods * T, 4),
        dx,
        T / 40,
        gravity=[0.0, 0.0, -G],
        jitter=0.02,
        **domain([0, 0, -5 * dx], [1, 5 * dx, 1.0], ["x", "y"]),
    )
    text += liquid("water", 1000.0, 1e-3, 10 * math.sqrt(G * h))
    text += tank(0, 1, 0, 0.3, 5 * dx, dx, sides=False)
    velocity = f'{{ kind = "expression", value = ["{u}", "0", "{w}"] }}'
    return text + body("pool", "water", box([0, 0, 0], [1, 5 * dx, h]), velocity=velocity, **WET) + TAIL


def fit(t, q, om):
    best = (1e99, 0, 0)
    for f in np.arange(0.85, 1.12, 0.0025):
        for b in np.arange(-0.3, 1.5, 0.01):
            m = np.exp(-b * t)[:, None] * np.stack([np.cos(f * om * t), np.sin(f * om * t)], 1)
            c, *_ = np.linalg.lstsq(m, q, rcond=None)
            e = float(np.sum((m @ c - q) ** 2))
            if e < best[0]:
                best = (e, f, b)
    return best


def judge_wave(run, n):
    h, k = 0.5, 2 * PI
    om = math.sqrt(G * k * math.tanh(k * h))
    q = []
    for f in range(run.frames):
        x, v = run.places(f), run.speeds(f)
        e = np.stack(
            [
                -np.cosh(k * x[:, 2]) / np.sinh(k * h) * np.sin(k * x[:, 0]),
                np.sinh(k * x[:, 2]) / np.sinh(k * h) * np.cos(k * x[:, 0]),
            ],
            1,
        )
        q.append(np.sum(e * v[:, [0, 2]]) / np.sum(e * e))
    error, f, b = fit(run.times, np.array(q), om)
    return {
        "decay [1/s]": float(b),
        "lost a period": float(1 - math.exp(-b * 2 * PI / om)),
        "period": float(1 / f),
        "energy gained": run.gained(),
    }


def vortices(n):
    dx = 1.0 / n
    text = head(
        0.5, dx, 0.1, jitter=0.02, clamp="false", **domain([0, 0, 0], [1, 1, round(5 * dx, 6)], ["x", "y", "z"])
    ) + liquid("water", 1.0, 0.01, 10.0)
    velocity = '{ kind = "taylor_green", speed = 1.0, wavelength = 1.0 }'
    return text + body("pool", "water", box([0, 0, 0], [1, 1, round(5 * dx, 6)]), velocity=velocity, **WET) + TAIL


def judge_vortices(run, n):
    x, v, k, t = run.places(-1), run.speeds(-1), 2 * PI, run.times[-1]
    start = run.speeds(0)[:, :2]
    x0 = run.places(0)
    shape = lambda r: np.stack(
        [-np.cos(k * r[:, 0]) * np.sin(k * r[:, 1]), np.sin(k * r[:, 0]) * np.cos(k * r[:, 1])], 1
    )
    if np.sum(shape(x0) * start) < 0.5 * np.sum(start**2):  # the other phase of the same flow
        shape = lambda r: np.stack(
            [np.sin(k * r[:, 0]) * np.cos(k * r[:, 1]), -np.cos(k * r[:, 0]) * np.sin(k * r[:, 1])], 1
        )
    true = math.exp(-8 * PI * PI * 0.01 * t) * shape(x)
    d = v[:, :2] - true
    return {
        "L2": float(np.sqrt(np.sum(d**2) + np.sum(v[:, 2] ** 2)) / np.sqrt(np.sum(true**2))),
        "amplitude": float(np.sum(v[:, :2] * true) / np.sum(true**2)),
        "momentum/sum m U": float(np.abs(v.sum(0)).max() / len(v)),
    }


def drop(n):
    dx = 2.0 / n
    text = head(0.8, dx, 0.1, jitter=0.02, **domain([-4, -4, 0], [4, 4, round(5 * dx, 6)], ["z"])) + liquid(
        "water", 1000.0, 0.0, 15.0
    )
    shape = f'{{ kind = "cylinder", base = [0, 0, 0], axis = [0, 0, 1], length = {round(5 * dx, 6)}, radius = 1.0 }}'
    velocity = '{ kind = "linear", gradient = [[-1, 0, 0], [0, 1, 0], [0, 0, 0]] }'
    return text + body("drop", "water", shape, velocity=velocity, **WET) + TAIL


def judge_drop(run, n):
    A, a, b, h = 1.0, 1.0, 1.0, run.times[-1] / 4000
    rate = lambda A, a, b: A * A * (a * a - b * b) / (a * a + b * b)
    for _ in range(4000):
        A1, a1, b1 = A + 0.5 * h * rate(A, a, b), a - 0.5 * h * A * a, b + 0.5 * h * A * b
        A, a, b = A + h * rate(A1, a1, b1), a - h * A1 * a1, b + h * A1 * b1
    x, v = run.places(-1), run.speeds(-1)
    d = v[:, :2] - A * np.stack([-x[:, 0], x[:, 1]], 1)
    dx = 2.0 / n
    tip = (x[:, 1].max() - run.places(0)[:, 1].max() * b) / dx
    L = np.sum(x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]) / len(x)
    return {
        "rms velocity [m/s]": float(np.sqrt(np.mean(np.sum(d**2, 1) + v[:, 2] ** 2))),
        "tip/dx": float(tip),
        "L/(m R v)": float(abs(L)),
        "energy gained": run.gained(),
    }


def disc(n):
    a = 0.01
    dx, W, H = a / n, 0.08, 0.12
    w = round(5 * dx, 8)
    text = head(0.3, dx, 0.01, gravity=[0.0, 0.0, -G], **domain([-0.02, 0, -0.02], [0.1, w, 0.16], ["y"]))
    text += liquid("oil", 1000.0, 3.0, 10 * math.sqrt(G * H)) + '[[material]]\nname = "steel"\ndensity = 1500.0\n'
    cylinder = f'{{ kind = "cylinder", base = [0.04, 0, 0.07], axis = [0, 1, 0], length = {w}, radius = {a} }}'
    text += tank(0, W, 0, H + 4 * dx, w, dx) + body("oil", "oil", minus(box([0, 0, 0], [W, w, H]), cylinder), **WET)
    return text + body("disc", "steel", cylinder, phase='"rigid"') + TAIL


def judge_disc(run, n):
    a, mu, e = 0.01, 3.0, 0.25
    K = math.log(4.0) - 0.9157 + 1.7244 * e**2 - 1.7302 * e**4 + 2.4056 * e**6 - 4.5913 * e**8
    dx = a / n
    area = run.body_mass(0, "disc") / (1500.0 * 5 * dx)
    U = 500.0 * area * G * K / (4 * PI * mu)
    z = run.body("disc", "position")[:, 2]
    t = run.times
    speed = lambda p, q: (np.interp(p, t, z) - np.interp(q, t, z)) / (q - p) / U
    end = t[-1]
    return {
        "late speed - 1": float(speed(0.5 * end, end) - 1),
        "early speed": float(speed(0.3 * end, 0.5 * end)),
        "late speed": float(speed(0.5 * end, end)),
    }


def heave(n):
    a = 0.16
    dx, W, H = a / n, 3.2, 0.96
    w = round(5 * dx, 8)
    text = head(0.7, dx, 0.01, gravity=[0.0, 0.0, -G], **domain([-0.3, 0, -0.3], [W + 0.3, w, 1.6], ["y"]))
    text += liquid("water", 1000.0, 1e-3, 10 * math.sqrt(G * H)) + '[[material]]\nname = "wood"\ndensity = 500.0\n'
    cylinder = f'{{ kind = "cylinder", base = [1.6, 0, {H + 0.04}], axis = [0, 1, 0], length = {w}, radius = {a} }}'
    text += tank(0, W, 0, H + 0.3, w, dx) + body("pool", "water", minus(box([0, 0, 0], [W, w, H]), cylinder), **WET)
    return text + body("float", "wood", cylinder, phase='"rigid"') + TAIL


def judge_heave(run, n):
    z = 1e3 * (run.body("float", "position")[:, 2] - 0.96)
    low = float(z[run.times < 0.65].min())
    return {"first minimum + 23.9 [mm]": low + 23.9, "first minimum [mm]": low, "of the drop": (low + 23.9) / 63.9}


def layers_grow(n):
    """Rayleigh-Taylor, 2:1, between two walls."""
    dx, k, h = 1.0 / n, 2 * PI, 0.5
    s = math.sqrt(G * k * math.tanh(k * h) / 3.0)
    a = 0.02 * s

    def v(sign, q):
        along = f"{sign}{a}*cosh({k}*({q}))/sinh({k * h})*sin({k}*x)"
        up = f"{a}*sinh({k}*({q}))/sinh({k * h})*cos({k}*x)"
        return f'{{ kind = "expression", value = ["{along}", "0", "{up}"] }}'

    w = 5 * dx
    text = head(
        0.4, dx, 0.01, gravity=[0.0, 0.0, -G], jitter=0.02, **domain([0, 0, -5 * dx], [1, w, 1 + 5 * dx], ["x", "y"])
    )
    text += liquid("light", 1000.0, 1e-3, 10 * math.sqrt(2 * G)) + liquid("heavy", 2000.0, 2e-3, 10 * math.sqrt(G))
    text += tank(0, 1, 0, 1, w, dx, sides=False, lid=True)
    text += body("below", "light", box([0, 0, 0], [1, w, 0.5]), velocity=v("-", "z"), **WET)
    return text + body("above", "heavy", box([0, 0, 0.5], [1, w, 1]), velocity=v("", "1-z"), **WET) + TAIL


def judge_layers_grow(run, n):
    k, h = 2 * PI, 0.5
    s = math.sqrt(G * k * math.tanh(k * h) / 3.0)
    q = []
    for f in range(run.frames):
        x, v, m = run.places(f), run.speeds(f), run.masses(f)
        up = x[:, 2] > h
        y = np.where(up, 1 - x[:, 2], x[:, 2])
        e = np.stack(
            [
                np.where(up, 1, -1) * np.cosh(k * y) / np.sinh(k * h) * np.sin(k * x[:, 0]),
                np.sinh(k * y) / np.sinh(k * h) * np.cos(k * x[:, 0]),
            ],
            1,
        )
        q.append(np.sum(m[:, None] * e * v[:, [0, 2]]) / np.sum(m[:, None] * e * e))
    q = np.array(q) / q[0]
    exact = np.cosh(s * run.times)  # from a flat interface that moves
    late = run.times <= 0.3
    return {
        "speed at s t = 1.5 - 1": float(q[late][-1] / exact[late][-1] - 1),
        "speed at 0.4 s - 1": float(q[-1] / exact[-1] - 1),
        "energy gained": run.gained(),
    }


def patch(n):
    dx = 1.0 / n
    w = round(5 * dx, 6)
    text = head(3.0, dx, 0.1, jitter=0.02, **domain([-4, -4, 0], [4, 4, w], ["z"])) + liquid("water", 1000.0, 0.0, 7.0)
    velocity = '{ kind = "linear", gradient = [[0, 1, 0], [-1, 0, 0], [0, 0, 0]] }'
    return text + body("square", "water", box([-0.5, -0.5, 0], [0.5, 0.5, w]), velocity=velocity, **WET) + TAIL


def judge_patch(run, n):
    def figures(f):
        x, v = run.places(f), run.speeds(f)
        return np.sum(x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]), np.sum(v**2), np.hypot(x[:, 0], x[:, 1]).max()

    a, b = figures(0), figures(-1)
    return {
        "reach - 3.0": float(b[2] / a[2] - 3.0),
        "L/L0 - 1": float(b[0] / a[0] - 1),
        "K/K0": float(b[1] / a[1]),
        "energy gained": run.gained(),
    }


def heat(n):
    """Warm water over cold water at rest: how fast the temperature spreads beside conduction."""
    dx = 0.4 / n
    w = 5 * dx
    text = head(5.0, dx, 0.5, gravity=[0.0, 0.0, -G], **domain([-0.2, 0, -0.2], [0.4, w, 0.8], ["y"]))
    more = "conductivity = 0.6\nheat_capacity = 4186.0\n"
    text += (
        liquid("water", 1000.0, 1e-3, 10 * math.sqrt(G * 0.4))
        + more
        + '[[material]]\nname = "glass"\ndensity = 1000.0\nconductivity = 1e-6\nheat_capacity = 800.0\n'
    )
    walls = tank(0, 0.2, 0, 0.5, w, dx).split("density = 1000.0\n", 1)[1]
    text += (
        walls
        + "temperature = 313.15\n"
        + body("cold", "water", box([0, 0, 0], [0.2, w, 0.2]), temperature=293.15, **WET)
    )
    return text + body("warm", "water", box([0, 0, 0.2], [0.2, w, 0.4]), temperature=333.15, **WET) + TAIL


def judge_heat(run, n):
    """Effective diffusivity, by how fast the mean height of the warm half falls."""
    T, z = run.temperature(-1), run.places(-1)[:, 2]
    T0, z0 = run.temperature(0), run.places(0)[:, 2]
    lift = lambda T, z: np.sum((T - 313.15) * (z - 0.2)) / len(z) / 20.0
    fallen = max(lift(T0, z0) - lift(T, z), 0.0)
    # d<|z| sign>/dt = D 2/(H) at early times: lift falls by 2 D t/H, H = 0.4
    D = fallen * 0.4 / (2 * run.times[-1])
    return {
        "effective diffusivity [m2/s]": float(D),
        "speed/sqrt(gH)": float(np.sqrt(np.mean(np.sum(run.speeds(-1) ** 2, 1))) / math.sqrt(G * 0.4)),
    }


def still_long(n):
    """Still water of `still` for 100 sqrt(H/g)."""
    text = still(n)
    old, end = round(60 * math.sqrt(0.2 / G), 3), round(100 * math.sqrt(0.2 / G), 3)
    return text.replace(f"end_time = {old}", f"end_time = {end}")


def sphere(n):
    """Sinks slowly in oil, on the axis of a closed cylinder of four radii."""
    a, wide, high = 0.01, 0.04, 0.12
    dx = a / n
    t = 3.5 * dx
    text = head(0.12, dx, 0.01, gravity=[0.0, 0.0, -G], **domain([-0.06] * 2 + [-0.03], [0.06, 0.06, 0.16], []))
    text += liquid("oil", 1000.0, 3.0, 10 * math.sqrt(G * high)) + '[[material]]\nname = "steel"\ndensity = 1500.0\n'
    round_of = lambda z, length, radius: (
        f'{{ kind = "cylinder", base = [0, 0, {z}], axis = [0, 0, 1], length = {length}, radius = {radius} }}'
    )
    ball = f'{{ kind = "sphere", centre = [0, 0, 0.075], radius = {a} }}'
    pot = minus(round_of(-t, high + t, wide + t), round_of(0, 2 * high, wide))
    text += '[[material]]\nname = "glass"\ndensity = 1000.0\n' + body(
        "tank", "glass", pot, phase='"rigid"', motion='"fixed"'
    )
    text += body("oil", "oil", minus(round_of(0, high, wide), ball), **WET)
    return text + body("ball", "steel", ball, phase='"rigid"') + TAIL


def judge_sphere(run, n):
    """Stokes, with the cylinder's factor for a ball on its axis, radius ratio 1/4."""
    dx, mu, q = 0.01 / n, 3.0, 0.25
    wall = (1 - 2.105 * q + 2.0865 * q**3 - 1.7068 * q**5 + 0.72603 * q**6) / (1 - 0.75857 * q**5)
    volume = run.body_mass(0, "ball") / 1500.0
    radius = (3 * volume / (4 * PI)) ** (1 / 3)
    U = 500.0 * volume * G / (6 * PI * mu * radius) * wall
    z, t = run.body("ball", "position")[:, 2], run.times
    speed = lambda p, q: (np.interp(p, t, z) - np.interp(q, t, z)) / (q - p) / U
    return {"speed - 1": float(speed(0.08, 0.12) - 1), "early": float(speed(0.04, 0.08)), "radius/dx": radius / dx}


def layers(n):
    """Light liquid on liquid five times as heavy, n layers each, at rest."""
    dx = 0.8 / n
    w = 6 * dx
    text = head(1.5, dx, 0.05, gravity=[0.0, 0.0, -G], **domain([0, 0, -1], [w, w, 3], ["x", "y"]))
    text += liquid("heavy", 1000.0, 300.0, 10 * math.sqrt(G * 1.6)) + liquid("light", 200.0, 60.0, 1.0)
    text = text.replace("sound_speed = 1.0\n", "")
    text += '[[material]]\nname = "floor"\ndensity = 1000.0\n'
    text += body("floor", "floor", box([0, 0, -4 * dx], [w, w, 0]), phase='"rigid"', motion='"fixed"')
    text += body("below", "heavy", box([0, 0, 0], [w, w, 0.8]), **WET)
    return text + body("above", "light", box([0, 0, 0.8], [w, w, 1.6]), **WET) + TAIL


def judge_layers(run, n):
    late = range(int(0.6 * run.frames), run.frames)
    dx, m = 0.8 / n, run.masses(0)
    heavy = m > 0.5 * m.max()
    z, p = (np.mean([of(f) for f in late], 0) for of in (lambda f: run.places(f)[:, 2], run.pressure))
    true = np.where(heavy, 200 * G * 0.8 + 1000 * G * (0.8 - z), 200 * G * (1.6 - z))
    error = p / true - 1
    near = np.abs(z - 0.8) < 0.9 * dx
    speed = np.sqrt(np.mean([np.mean(np.sum(run.speeds(f) ** 2, 1)) for f in late]))
    return {
        "heavy side - 1": float(error[near & heavy].mean()),
        "light side - 1": float(error[near & ~heavy].mean()),
        "floor - 1": float(error[z < dx].mean()),
        "speed/sqrt(gH)": float(speed / math.sqrt(G * 1.6)),
    }


SCENES = {
    "fall": (fall, judge_fall, (10,)),
    "still": (still, judge_still, (10, 20)),
    "wave": (wave, judge_wave, (20, 40)),
    "vortices": (vortices, judge_vortices, (20, 40)),
    "drop": (drop, judge_drop, (20, 40)),
    "disc": (disc, judge_disc, (4,)),
    "heave": (heave, judge_heave, (4, 8)),
    "rayleigh-taylor": (layers_grow, judge_layers_grow, (20, 40)),
    "patch": (patch, judge_patch, (20, 40)),
    "heat": (heat, judge_heat, (20,)),
    "still-long": (still_long, judge_still, (20,)),
    "sphere": (sphere, judge_sphere, (3,)),
    "layers": (layers, judge_layers, (8,)),
}
