# SPDX-License-Identifier: BSD-3-Clause
"""Faults of engine-wrong: what each changes in the job or in the trajectory, the case that must be red, and the gates
or the audit that see it there."""

import math
from dataclasses import dataclass
from typing import Callable, Optional

from spoil import (
    PER_CENT,
    PLACES,
    SPINS,
    VELOCITIES,
    a_step_late,
    arithmetic_mean,
    axes_ignored,
    backward_differences,
    by_chance,
    by_the_fast_clock,
    conductivity,
    copied,
    damped,
    damped_spin,
    fast,
    fast_belt,
    fast_clock,
    floor_sinks,
    frame_late,
    gravity,
    gravity_is_down,
    jumps,
    large_meshes,
    late,
    lifted,
    mass,
    mirrored,
    moment,
    moments,
    moved,
    much_conductivity,
    no_gravity,
    no_gyroscopic_term,
    of_column,
    of_materials,
    other_sign,
    other_way_round,
    rests_at_a_speed,
    right_for_half_a_second,
    setting,
    shifted,
    sideways,
    single_precision,
    sizes,
    spin_in_the_body,
    stale,
    swapped,
    swapped_turns,
    tilted,
    turned_back_once,
    turned_frame,
    turned_tensor,
)


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
    "mirror": Fault("the world in a mirror", "rigid/precession", ("audit",), rows=moved(mirrored)),
    "clock": Fault(
        "the clock runs 1 % fast",
        "contact/tumble-elastic",
        ("fall",),
        job=fast_clock,
        rows=lambda job, rows: list(by_the_fast_clock(job, rows)),
    ),
    "floor": Fault("a fixed floor sinks by 1 mm", "contact/tower-1", ("audit",), rows=moved(floor_sinks)),
    "speed at rest": Fault(
        "one of five cubes at rest states 0.3 m/s", "contact/tower-1", ("audit",), rows=moved(rests_at_a_speed)
    ),
    "jump": Fault(
        "a cube in the middle of a tower jumps aside by 5 mm",
        "contact/tower-1",
        ("audit",),
        rows=jumps(axis=2, way=5e-3, once=False),
    ),
    "jump down": Fault(
        "a cube in the middle of a tower is 5 mm lower in one frame",
        "contact/tower-1",
        ("audit",),
        rows=jumps(axis=4, way=-5e-3, once=True),
    ),
    "tilted": Fault("a block on a board is tilted by 0.04 rad", "contact/conveyor", ("turned",), rows=moved(tilted)),
    "later places": Fault("places two steps late", "contact/roll-down-slope", ("audit",), rows=late(PLACES, 2.0)),
    "differences": Fault(
        "velocities are backward differences of the frames",
        "contact/roll-down-slope",
        ("audit",),
        rows=lambda job, rows: list(backward_differences(job, rows)),
    ),
    "axes": Fault("principal axes ignored", "rigid/precession", ("energy",), job=axes_ignored),
    "stale": Fault("a frame repeats the one before", "contact/roll-down-slope", ("audit",), rows=stale),
    "belt": Fault("a belt 1 % fast", "contact/conveyor", ("velocity",), job=fast_belt),
    "mesh": Fault("meshes 1 % large", "contact/mesh-rest", ("rest",), job=large_meshes),
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
    "warm": Fault(
        "0.3 K warmer after the start",
        "heat/two-conductivities",
        ("worst",),
        heat=lambda job, time, places, T: T + (0.3 if time > 0.0 else 0.0),
    ),
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
