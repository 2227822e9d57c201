# SPDX-License-Identifier: BSD-3-Clause
"""Faults of engine-wrong: what each changes in the job or in the trajectory, the case that must be red, and the gates
or the audit that see it there."""

import bisect
import math
import os
import struct
from dataclasses import dataclass
from typing import Callable, Optional

import flight

PER_CENT = 0.01
STEP = 0.01  # of a fault in time, where the job says none [s]


@dataclass(frozen=True)
class Fault:
    words: str
    case: str
    seen_by: tuple  # metrics with a red limit of any engine; "audit": the run is no result; "inconclusive": exit 3
    job: Optional[Callable] = None  # changes the job that the inner engine runs
    rows: Optional[Callable] = None  # (job, rows of bodies) -> rows
    heat: Optional[Callable] = None  # (job, time, places, temperatures) -> temperatures
    columns: Optional[Callable] = None  # changes the group of particles of trajectory.h5 where there is heat
    gauges: Optional[Callable] = None  # (job, gauge) -> what gauges.csv says of it at the end
    walkers: float = 0.0  # heat by so many of LAMMPS's walkers, where the job says no number
    preset: str = ""  # of Bullet, instead of the one that suits the case


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


# --- trajectories -----------------------------------------------------------------------------------------------------


def moved(change):
    """A change of each row after the start."""

    def all_rows(job, rows):
        return [row if row[0] == job["times"][0] else change(job, list(row)) for row in rows]

    return all_rows


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


FAULTS = {
    "gravity": Fault("gravity 1 % small", "rigid/ballistic", ("velocity",), job=gravity),
    "gravity is down": Fault(
        "gravity acts along z, whatever the scene says", "contact/slope-slip", ("velocity",), job=gravity_is_down
    ),
    "no gravity": Fault("nothing falls", "contact/tumble-elastic", ("fall",), job=no_gravity),
    "half a second": Fault(
        "right for the first half second, gravity 1 % small after it",
        "rigid/ballistic",
        ("velocity",),
        rows=moved(right_for_half_a_second),
    ),
    "frame": Fault(
        "the world is turned by 0.01 rad about the vertical",
        "rigid/ballistic",
        ("velocity", "orientation"),
        rows=moved(turned_frame),
    ),
    "late": Fault(
        "everything a step late", "rigid/ballistic", ("velocity",), rows=lambda job, rows: list(a_step_late(job, rows))
    ),
    "late spin": Fault("angular velocities a step late", "rigid/torque-free", ("audit",), rows=late(SPINS, 1.0)),
    "half late spin": Fault(
        "angular velocities half a step late", "rigid/precession", ("audit",), rows=late(SPINS, 0.5)
    ),
    "late places": Fault("places a step late", "contact/slide-to-rest", ("audit",), rows=late(PLACES, 1.0)),
    "half late velocities": Fault(
        "velocities half a step late", "contact/roll-down-slope", ("audit",), rows=late(VELOCITIES, 0.5)
    ),
    "late velocities": Fault("velocities a step late", "contact/conveyor", ("audit",), rows=late(VELOCITIES, 1.0)),
    "fast": Fault("velocities 0.05 % large", "contact/slide-to-rest", ("audit",), rows=moved(fast)),
    "spin back": Fault(
        "the spin is reversed in one frame", "contact/roll-down-slope", ("audit",), rows=turned_back_once(SPINS, 0.4)
    ),
    "velocity back": Fault(
        "the velocity is reversed in one frame", "contact/conveyor", ("audit",), rows=turned_back_once(VELOCITIES, 0.4)
    ),
    "damped": Fault("velocities fall by 0.1 % a second", "rigid/ballistic", ("velocity",), rows=moved(damped)),
    "damped spin": Fault(
        "angular momenta fall by 0.1 % a second",
        "rigid/torque-free",
        ("angle.limit", "energy"),
        rows=lambda job, rows: list(damped_spin(job, rows)),
    ),
    "sideways": Fault("a sliding block drifts aside", "contact/turned-slope", ("aside",), rows=moved(sideways)),
    "lifted": Fault("a sliding block rises and comes back", "contact/turned-slope", ("down",), rows=moved(lifted)),
    "rolls backwards": Fault(
        "a ball rolls the other way round", "contact/roll-down-slope", ("spin",), rows=moved(other_way_round)
    ),
    "swapped turns": Fault(
        "orientations and spins of two bodies swapped",
        "contact/oblique-hit",
        ("steep_spin", "middle_spin"),
        rows=lambda job, rows: list(swapped_turns(job, rows)),
    ),
    "moment": Fault("largest moment 1 % large", "rigid/flip-time", ("flip",), job=moment(2)),
    "least moment": Fault("least moment 1 % small", "rigid/flip-time", ("flip",), job=moment(0, 1.0 - PER_CENT)),
    "middle moment": Fault("middle moment 1 % large", "rigid/flip-time", ("flip",), job=moment(1)),
    "gyroscopic": Fault(
        "no gyroscopic term",
        "rigid/torque-free",
        ("angle",),
        rows=lambda job, rows: list(no_gyroscopic_term(job, rows)),
    ),
    "spin in the body": Fault(
        "angular velocity in the body's frame", "rigid/torque-free", ("audit", "energy"), rows=moved(spin_in_the_body)
    ),
    "other way round": Fault(
        "turns the other way round", "rigid/ballistic", ("orientation",), rows=moved(other_way_round)
    ),
    "mass": Fault("first body 0.1 % heavy", "contact/unequal-hit", ("momentum",), job=mass),
    "swapped": Fault("two bodies swapped after the start", "contact/unequal-hit", ("audit", "momentum"), rows=swapped),
    "copied": Fault(
        "the second body copies the first",
        "contact/unequal-hit",
        ("momentum",),
        rows=lambda job, rows: list(copied(job, rows)),
    ),
    "friction": Fault("friction 1 % small", "contact/slide-to-rest", ("way",), job=setting("friction", 1.0 - PER_CENT)),
    "friction on a slope": Fault(
        "friction 1 % small", "contact/slope-slip", ("velocity",), job=setting("friction", 1.0 - PER_CENT)
    ),
    "restitution": Fault(
        "restitution 1 % small",
        "contact/oblique-hit",
        ("steep_hit", "middle_hit"),
        job=setting("restitution", 1.0 - PER_CENT),
    ),
    "chance": Fault(
        "restitution 1 to 3 % off, by chance",
        "contact/oblique-hit",
        ("steep_hit", "middle_hit"),
        job=setting("restitution", by_chance),
    ),
    "friction of a hit": Fault(
        "friction 1 % large",
        "contact/oblique-hit",
        ("middle_spin", "flat_spin"),
        job=setting("friction", 1.0 + PER_CENT),
    ),
    "moment in a hit": Fault(
        "moments of balls 1 % small", "contact/oblique-hit", ("middle_spin", "flat_spin"), job=moments(1.0 - PER_CENT)
    ),
    "threshold": Fault("no rebound below 1 m/s", "contact/low-bounce", ("height",), preset="default"),
    "ball's moment": Fault(
        "moments of a ball 1 % large", "contact/slip-to-roll", ("rolling",), job=moments(1.0 + PER_CENT)
    ),
    "size": Fault("bodies 1 % large in contact", "contact/tower-1", ("top",), job=sizes),
    "diffusivity": Fault("conductivity 1 % large", "heat/cosine-fine", ("rate",), job=conductivity),
    "walkers' diffusivity": Fault(
        "conductivity 1 % large, by walkers",
        "heat/spreading-two-million",
        ("diffusivity",),
        job=conductivity,
        walkers=2e6,
    ),
    "told diffusivity": Fault(
        "conductivity 5 % large, and the gauge says the right diffusivity",
        "heat/spreading-two-million",
        ("audit",),
        job=much_conductivity,
        gauges=lambda job, gauge: 1e-6,
    ),
    "heat capacity": Fault("heat capacity 1 % large", "heat/cosine-fine", ("rate",), job=of_materials("heat_capacity")),
    "latent heat": Fault("latent heat 1 % large", "phase/heat-of-fusion", ("metal",), job=of_materials("latent_heat")),
    "melting point": Fault("melting point 1 % high", "phase/stefan", ("front",), job=of_materials("t_melt")),
    "late heat": Fault("temperatures a frame late", "heat/cosine-fine", ("rate",), heat=frame_late()),
    "error below 0": Fault(
        "a standard error below 0",
        "heat/step-walkers",
        ("audit",),
        columns=of_column("temperature_error/value", lambda u: -u),
        walkers=1e5,
    ),
    "no error": Fault(
        "a standard error that is no number",
        "heat/step-walkers",
        ("audit",),
        columns=of_column("temperature_error/value", lambda u: u * math.nan),
        walkers=1e5,
    ),
    "great error": Fault(
        "a standard error of a million kelvin",
        "heat/step-walkers",
        ("inconclusive",),
        columns=of_column("temperature_error/value", lambda u: u + 1e6),
        walkers=1e5,
    ),
    "other times": Fault(
        "temperatures of other times than places",
        "heat/cosine-fine",
        ("audit",),
        columns=of_column("temperature/time", lambda t: 0.5 * t),
    ),
    "doubled id": Fault(
        "two particles of one id",
        "heat/cosine-fine",
        ("audit",),
        columns=of_column("id/value", lambda n: n - (n == n.max())),
    ),
    "arithmetic mean": Fault(
        "pairs conduct by the arithmetic mean", "heat/two-conductivities", ("worst",), heat=arithmetic_mean()
    ),
    "turned tensor": Fault(
        "moments about axes that are 0.01 rad off",
        "rigid/torque-free",
        ("angle.order", "angle.limit"),
        job=turned_tensor,
    ),
    "drift": Fault(
        "walkers drift by 0.001 spacings a step",
        "heat/step-walkers",
        ("left_half",),
        heat=shifted(1e-3, 1.0 / 24.0),
        walkers=1e5,
    ),
}


# --- ways to write that change nothing --------------------------------------------------------------------------------


def other_sign(job, rows):
    """Each second frame has -q in place of q, which is the same orientation."""
    odd = {t for n, t in enumerate(job["times"]) if n % 2}
    return [row[:8] + [-c for c in row[8:12]] + row[12:] if row[0] in odd else row for row in map(list, rows)]


def single_precision(job, rows):
    return [row[:2] + [struct.unpack("f", struct.pack("f", c))[0] for c in row[2:]] for row in map(list, rows)]


HARMLESS = {
    "other sign": Fault("-q in each second frame", "rigid/precession", (), rows=other_sign),
    "other sign in contact": Fault("-q in each second frame", "contact/oblique-hit", (), rows=other_sign),
    "single precision": Fault("single precision", "rigid/ballistic", (), rows=single_precision),
    "single precision of turns": Fault("single precision", "rigid/torque-free", (), rows=single_precision),
    "single precision in contact": Fault("single precision", "contact/slide-to-rest", (), rows=single_precision),
    "last row first": Fault(
        "bodies of a frame in another order",
        "contact/oblique-hit",
        (),
        rows=lambda job, rows: sorted(rows, key=lambda row: (row[0], -row[1])),
    ),
}
