# SPDX-License-Identifier: BSD-3-Clause
"""What the faults of faults.py do to a job, to rows of bodies and to temperatures."""

import bisect
import math
import os
import struct

import flight

PER_CENT = 0.01
STEP = 0.01  # of a fault in time, where the job says none [s]


# --- constants --------------------------------------------------------------------------------------------------------


def gravity(job):
    job["scene"]["gravity"] = [(1.0 - PER_CENT) * c for c in job["scene"]["gravity"]]


def no_gravity(job):
    job["scene"]["gravity"] = [0.0, 0.0, 0.0]


def gravity_is_down(job):
    job["scene"]["gravity"] = [0.0, 0.0, -math.hypot(*job["scene"]["gravity"])]


def moment(axis, factor=1.0 + PER_CENT):
    def change(job):
        for body in job["scene"]["bodies"]:
            body["principal_inertia"][axis] *= factor

    return change


def moments(factor):
    def change(job):
        for body in job["scene"]["bodies"]:
            body["principal_inertia"] = [factor * c for c in body["principal_inertia"]]

    return change


def mass(job):
    body = job["scene"]["bodies"][0]
    body["mass"] *= 1.001
    body["principal_inertia"] = [1.001 * c for c in body["principal_inertia"]]


def setting(name, factor):
    def change(job):
        job["settings"][name] *= factor() if callable(factor) else factor

    return change


def by_chance():
    """1 to 3 % more or less, another share each time."""
    share = int.from_bytes(os.urandom(2), "big") / 65536.0
    return 1.0 + math.copysign(PER_CENT * (1.0 + 2.0 * abs(2.0 * share - 1.0)), share - 0.5)


def of_materials(key):
    def change(job):
        for material in job["scene"]["materials"]:
            if material.get(key) is not None:
                material[key] *= 1.0 + PER_CENT

    return change


def turned_tensor(job):
    """Moments as they should be, about axes that are turned by 0.01 rad."""
    for body in job["scene"]["bodies"]:
        turn = (math.cos(0.005), math.sin(0.005), 0.0, 0.0)
        body["principal_axes"] = list(flight.product(turn, tuple(body["principal_axes"])))


def axes_ignored(job):
    """Moments are taken about the axes of the world."""
    for body in job["scene"]["bodies"]:
        body["principal_axes"] = [1.0, 0.0, 0.0, 0.0]


def conductivity(job, factor=1.0 + PER_CENT):
    for material in job["scene"]["materials"]:
        for key in ("conductivity", "solid_conductivity"):
            if material.get(key) is not None:
                material[key] *= factor


def much_conductivity(job):
    conductivity(job, 1.05)


def sizes(job):
    """Free boxes and balls are 1 % larger than the case says."""
    for body in job["scene"]["bodies"]:
        shape, centre = body["shape"], body["centre"]
        if body["motion"] != "free":
            continue
        if shape["kind"] == "sphere":
            shape["radius"] *= 1.0 + PER_CENT
        else:
            for corner in ("min", "max"):
                shape[corner] = [c + (1.0 + PER_CENT) * (x - c) for x, c in zip(shape[corner], centre)]


def large_meshes(job):
    for body in job["scene"]["bodies"]:
        if body["motion"] == "free" and body["shape"]["kind"] == "mesh":
            body["shape"]["scale"] = (1.0 + PER_CENT) * (body["shape"].get("scale") or 1.0)


def fast_belt(job):
    for body in job["scene"]["bodies"]:
        if body["motion"] == "prescribed":
            body["velocity"] = [(1.0 + PER_CENT) * c for c in body["velocity"]]


def fast_clock(job):
    job["times"] = [(1.0 + PER_CENT) * t for t in job["times"]]
    job["scene"]["end_time"] *= 1.0 + PER_CENT


# --- trajectories -----------------------------------------------------------------------------------------------------


def moved(change):
    """A change of each row after the start."""

    def all_rows(job, rows):
        return [row if row[0] == job["times"][0] else change(job, list(row)) for row in rows]

    return all_rows


def by_the_fast_clock(job, rows):
    """Rows at the times of the job, with the rates that such a clock shows after the start."""
    for row in rows:
        row = list(row)
        row[0] = min(job["times"], key=lambda t: abs((1.0 + PER_CENT) * t - row[0]))
        for k in range(5, 8) if row[0] > job["times"][0] else ():
            row[k], row[k + 7] = (1.0 + PER_CENT) * row[k], (1.0 + PER_CENT) * row[k + 7]
        yield row


def mirrored(job, row):
    """The world seen in a mirror across y."""
    y = next(b["centre"][1] for b in job["scene"]["bodies"] if b["index"] == row[1])
    row[3] = 2.0 * y - row[3]
    for k in (6, 9, 11, 12, 14):
        row[k] = -row[k]
    return row


def floor_sinks(job, row):
    """What is fixed lies 1 mm lower."""
    if next(b for b in job["scene"]["bodies"] if b["index"] == row[1])["motion"] == "fixed":
        row[4] -= 1e-3
    return row


def rests_at_a_speed(job, row):
    """The first free body states 0.3 m/s where it lies still."""
    first = next(b for b in job["scene"]["bodies"] if b["motion"] == "free")
    if row[1] == first["index"] and math.hypot(*row[5:8]) < 1e-2:
        row[5] += 0.3
    return row


def jumps(axis, way, once):
    """A cube in the middle of a tower is elsewhere at 1 s, or from then on."""

    def change(job, row):
        if row[1] == 3 and (abs(row[0] - 1.0) < 1e-9 or (not once and row[0] > 1.0)):
            row[axis] += way
        return row

    return moved(change)


def tilted(job, row):
    """What is free is tilted by 0.04 rad after the start."""
    if next(b for b in job["scene"]["bodies"] if b["index"] == row[1])["motion"] == "free":
        row[8:12] = flight.product((math.cos(0.02), 0.0, math.sin(0.02), 0.0), row[8:12])
    return row


def backward_differences(job, rows):
    """Velocities are the way since the frame before."""
    before = {}
    for row in map(list, rows):
        last = before.get(row[1])
        before[row[1]] = list(row)
        if last is not None:
            row[VELOCITIES] = [(x - y) / (row[0] - last[0]) for x, y in zip(row[PLACES], last[PLACES])]
        yield row


def stale(job, rows):
    """The frame in the middle repeats the one before it."""
    rows = list(rows)
    middle = len(job["times"]) // 2
    before = {row[1]: list(row[2:]) for row in rows if row[0] == job["times"][middle - 1]}
    return [[row[0], row[1], *before[row[1]]] if row[0] == job["times"][middle] else row for row in rows]


def spin_in_the_body(job, row):
    q = row[8:12]
    return row[:12] + list(flight.rotate(flight.conjugate(q), row[12:15]))


def other_way_round(job, row):
    return row[:8] + list(flight.conjugate(row[8:12])) + [-c for c in row[12:15]]


def turned_frame(job, row):
    """The world turned by 0.01 rad about the vertical."""
    c, s = math.cos(PER_CENT), math.sin(PER_CENT)
    for x in (2, 5, 12):
        row[x], row[x + 1] = c * row[x] - s * row[x + 1], s * row[x] + c * row[x + 1]
    turn = (math.cos(0.5 * PER_CENT), 0.0, 0.0, math.sin(0.5 * PER_CENT))
    row[8:12] = flight.product(flight.product(turn, row[8:12]), flight.conjugate(turn))
    return row


def no_gyroscopic_term(job, rows):
    spin = {b["index"]: b["angular_velocity"] for b in job["scene"]["bodies"]}
    for row in rows:
        w = spin[row[1]]
        rate, half = math.hypot(*w), 0.5 * math.hypot(*w) * row[0]
        yield row[:8] + [math.cos(half), *(math.sin(half) / rate * c for c in w)] + list(w)


def a_step_late(job, rows):
    """Each state is that of one step before, along a curve through frames and their velocities."""
    step = job["resolution"].get("time_step") or STEP
    for body in sorted({row[1] for row in rows}):
        own = [row for row in rows if row[1] == body]
        times = [row[0] for row in own]
        for row in own:
            yield row if row[0] == times[0] else [row[0], *at_time(own, times, row[0] - step)[1:]]


def at_time(own, times, t):
    k = min(max(bisect.bisect_right(times, t) - 1, 0), len(times) - 2)
    a, b, h = own[k], own[k + 1], times[k + 1] - times[k]
    s = (t - times[k]) / h
    x = [
        (2 * s**3 - 3 * s**2 + 1) * a[i]
        + (s**3 - 2 * s**2 + s) * h * a[i + 3]
        + (3 * s**2 - 2 * s**3) * b[i]
        + (s**3 - s**2) * h * b[i + 3]
        for i in (2, 3, 4)
    ]
    v, w = ([(1 - s) * a[i] + s * b[i] for i in part] for part in ((5, 6, 7), (12, 13, 14)))
    between = flight.product(b[8:12], flight.conjugate(a[8:12]))
    return [t, a[1], *x, *v, *flight.product(flight.scaled(between, s), a[8:12]), *w]


PLACES, VELOCITIES, SPINS = slice(2, 5), slice(5, 8), slice(12, 15)


def late(columns, steps):
    """These columns of each row are those of so many steps before."""

    def all_rows(job, rows):
        step = job["resolution"].get("time_step") or STEP
        for body in sorted({row[1] for row in rows}):
            own = [row for row in rows if row[1] == body]
            times = [row[0] for row in own]
            for row in own[:1] + [list(row) for row in own[1:]]:
                if row[0] > times[0]:
                    row[columns] = at_time(own, times, row[0] - steps * step)[columns]
                yield row

    return lambda job, rows: list(all_rows(job, rows))


def fast(job, row):
    row[VELOCITIES] = [1.0005 * c for c in row[VELOCITIES]]
    return row


def turned_back_once(columns, when):
    def change(job, row):
        if abs(row[0] - when) < 1e-9:
            row[columns] = [-c for c in row[columns]]
        return row

    return moved(change)


def right_for_half_a_second(job, row):
    late = max(0.0, row[0] - 0.5)
    for i, g in enumerate(job["scene"]["gravity"]):
        row[2 + i] -= 0.5 * PER_CENT * g * late * late
        row[5 + i] -= PER_CENT * g * late
    return row


def swapped(job, rows):
    other = {0: 1, 1: 0}
    start = job["times"][0]
    return [row if row[0] == start else [row[0], other.get(row[1], row[1]), *row[2:]] for row in rows]


def damped(job, row):
    """The velocity falls by 0.1 % a second, as if by air."""
    rate, t = 1e-3, row[0]
    first = next(b for b in job["scene"]["bodies"] if b["index"] == row[1])
    fade = -math.expm1(-rate * t) / rate
    for i, (x, v, g) in enumerate(zip(first["centre"], first["velocity"], job["scene"]["gravity"])):
        row[2 + i] = x + fade * v + g * (t - fade) / rate
        row[5 + i] = math.exp(-rate * t) * v + g * fade
    return row


def damped_spin(job, rows):
    """The angular momentum falls by 0.1 % a second: the free motion, which takes place later and later."""
    rate = 1e-3
    for body in sorted({row[1] for row in rows}):
        own = [row for row in rows if row[1] == body]
        times = [row[0] for row in own]
        for row in own:
            then = at_time(own, times, -math.expm1(-rate * row[0]) / rate)
            yield [*row[:8], *then[8:12], *(math.exp(-rate * row[0]) * c for c in then[12:15])]


def sideways(job, row):
    """All that moves drifts aside with 0.02 m/s2."""
    if math.hypot(*row[5:8]) > 0.1:
        row[3] += 0.01 * row[0] ** 2
        row[6] += 0.02 * row[0]
    return row


def lifted(job, row):
    """All that moves rises from the ground, up to 50 mm, and is back at the end."""
    if math.hypot(*row[5:8]) > 0.1:
        way = math.pi * row[0] / job["times"][-1]
        row[4] += 0.05 * math.sin(way) ** 2
        row[7] += 0.05 * math.pi / job["times"][-1] * math.sin(2.0 * way)
    return row


def swapped_turns(job, rows):
    """The first two bodies have each other's orientation and spin."""
    turn = {(row[0], row[1]): row[8:15] for row in rows}
    for row in rows:
        yield [*row[:8], *turn[row[0], {0: 1, 1: 0}.get(row[1], row[1])]]


def copied(job, rows):
    """The second body moves as the first does."""
    centre = {b["index"]: b["centre"] for b in job["scene"]["bodies"]}
    first = {row[0]: row for row in rows if row[1] == 0}
    for row in rows:
        like = first[row[0]]
        way = [x - c for x, c in zip(like[2:5], centre[0])]
        yield row if row[1] != 1 else [row[0], 1, *(c + d for c, d in zip(centre[1], way)), *like[5:]]


# --- heat -------------------------------------------------------------------------------------------------------------


def of_column(name, change):
    """One dataset of the particles, changed in all its frames."""

    def columns(particles):
        particles[name][...] = change(particles[name][...])

    return columns


def frame_late():
    """Temperatures are those of the frame before."""
    before = []

    def change(job, t, where, T):
        before.append(T.copy())
        return before[-2] if len(before) > 1 else T

    return change


def arithmetic_mean():
    """Layers along x whose pairs conduct by the arithmetic mean of their conductivities."""
    state = {}

    def change(job, t, where, T):
        import numpy

        scene = job["scene"]
        dx = scene["spacing"]
        layer = numpy.round((where[:, 0] - where[:, 0].min()) / dx).astype(int)
        if not state:
            material = {m["name"]: m for m in scene["materials"]}
            state.update(t=0.0, T=numpy.array([T[layer == n].mean() for n in range(layer.max() + 1)]))
            jump = numpy.argmax(numpy.abs(numpy.diff(state["T"]))) + 1
            bodies = sorted(scene["bodies"], key=lambda b: b["centre"][0])
            k, C = (
                numpy.where(
                    numpy.arange(len(state["T"])) < jump,
                    *(numpy.prod([material[b["material"]][key] for key in keys]) for b in bodies),
                )
                for keys in (("conductivity",), ("density", "heat_capacity"))
            )
            state.update(k=0.5 * (k[1:] + k[:-1]) / dx**2, C=C)
            return T
        steps = int(numpy.ceil((t - state["t"]) / (0.2 * state["C"].min() / state["k"].max())))
        for _ in range(steps):
            flow = state["k"] * numpy.diff(state["T"]) * (t - state["t"]) / steps
            state["T"][:-1] += flow / state["C"][:-1]
            state["T"][1:] -= flow / state["C"][1:]
        state["t"] = t
        return state["T"][layer]

    return change


def shifted(spacings_a_step, step):
    """Walkers drift along x: the field of whole layers is carried along."""

    def change(job, t, where, T):
        import numpy

        dx = job["scene"]["spacing"]
        layers = numpy.unique(numpy.round(where[:, 0] / dx, 6))
        profile = numpy.array([T[numpy.abs(where[:, 0] / dx - layer) < 1e-3].mean() for layer in layers])
        way = spacings_a_step * t / step
        drifted = numpy.interp(layers - way, layers, profile)
        return T + numpy.interp(where[:, 0] / dx, layers, drifted - profile)

    return change


# --- ways to write that change nothing --------------------------------------------------------------------------------


def other_sign(job, rows):
    """Each second frame has -q in place of q, which is the same orientation."""
    odd = {t for n, t in enumerate(job["times"]) if n % 2}
    return [row[:8] + [-c for c in row[8:12]] + row[12:] if row[0] in odd else row for row in map(list, rows)]


def single_precision(job, rows):
    return [row[:2] + [struct.unpack("f", struct.pack("f", c))[0] for c in row[2:]] for row in map(list, rows)]
