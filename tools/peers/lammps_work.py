# SPDX-License-Identifier: BSD-3-Clause
"""The standard work as input of LAMMPS: a data file with the very particles, and a deck a method.

Everything is in units of the spacing, of a particle's mass and of the speed of sound (of sqrt(E/density) in a solid):
MACHDYN and RHEO have absolute tolerances that want numbers of the order of one."""

from __future__ import annotations

import re
from pathlib import Path

SPEED, SKIN = 10.0, 0.1  # of sound [m/s]; of the lists, in supports, as the particle solver's

HEAD = """units lj
dimension 3
boundary f f f
newton {newton}
atom_style {style}
{extra}comm_modify vel yes
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
read_data {data}
mass 1 1.0
"""
# The viscosity 2 Pa s and the conductivity 50 W/m/K of the case in these units; taitwater's own viscosity is
# artificial.
BODY = {
    "sph": """pair_style hybrid/overlay sph/taitwater sph/heatconduction
pair_coeff * * sph/taitwater 1.0 1.0 0.1 {support}
pair_coeff * * sph/heatconduction 5e-4 {support}
fix move all sph
""",
    "rheo": """pair_style rheo {support}
pair_coeff * *
fix flow all rheo {support} quintic 0 thermal
fix viscosity all rheo/viscosity * constant 0.02
fix pressure all rheo/pressure * linear
fix heat all rheo/thermal conductivity * constant 5e-4 specific/heat * constant 1.0
""",
    "tlsph": """group tlsph union all
pair_style smd/tlsph
pair_coeff 1 1 *COMMON 1.0 1.0 0.3 0.0 0.0 10.0 1.0 *STRENGTH_LINEAR *EOS_LINEAR *END
fix move tlsph smd/integrate_tlsph
""",
}
STYLE = {
    "sph": ("sph", "on", ""),
    "rheo": ("rheo/thermal", "off", ""),
    "tlsph": ("smd", "off", "atom_modify map array\n"),
}
RUN = """timestep {time_step}
thermo 1000000
run {warm}
run {steps}
"""


def atom(method, i, place, temperature, support):
    """A line of the data file in the column order of the atom style."""
    at = " ".join(f"{x:.17g}" for x in place)
    if method == "sph":  # id type density energy heat-capacity
        return f"{i} 1 1.0 {temperature:.17g} 1.0 {at}"
    if method == "rheo":  # id type status density energy
        return f"{i} 1 0 1.0 {temperature:.17g} {at}"
    # id type molecule volume mass kernel-radius contact-radius x0
    return f"{i} 1 1 1.0 1.0 {support / 2:.17g} 0.5 {at} {at}"


def write(folder, method, start, time_step, warm, steps):
    """@param start position, velocity, temperature, spacing, support; SI  @param time_step [s]  @return path of the
    deck"""
    folder, spacing = Path(folder), start["spacing"]
    data, deck = folder / f"{method}.data", folder / f"{method}.lmp"
    support, place = start["support"] / spacing, start["position"] / spacing
    temperature = start["temperature"] if len(start["temperature"]) else [0.0] * len(place)
    low, high = place.min(axis=0) - 5.0 * support, place.max(axis=0) + 5.0 * support
    text = ["particles of a standard work", "", f"{len(place)} atoms", "1 atom types", ""]
    text += [f"{low[a]:.9g} {high[a]:.9g} {'xyz'[a]}lo {'xyz'[a]}hi" for a in range(3)]
    text += ["", "Atoms", "", *(atom(method, i, x, T, support) for i, (x, T) in enumerate(zip(place, temperature), 1))]
    text += [
        "",
        "Velocities",
        "",
        *(f"{i} {u:.17g} {v:.17g} {w:.17g}" for i, (u, v, w) in enumerate(start["velocity"] / SPEED, 1)),
        "",
    ]
    data.write_text("\n".join(text), encoding="utf-8")
    style, newton, extra = STYLE[method]
    numbers = {
        "style": style,
        "newton": newton,
        "extra": extra,
        "skin": SKIN * support,
        "data": data,
        "support": support,
        "time_step": time_step * SPEED / spacing,
        "warm": warm,
        "steps": steps,
    }
    deck.write_text((HEAD + BODY[method] + RUN).format(**numbers), encoding="utf-8")
    return deck


LOOP = re.compile(r"Loop time of ([0-9.e+-]+) on \d+ procs for (\d+) steps with (\d+) atoms")
BUILDS = re.compile(r"Neighbor list builds = (\d+)")
USE = re.compile(r"([0-9.]+)% CPU use with (\d+) MPI tasks")


def read(log):
    """@return wall and CPU seconds a step, particles and list builds a step of the second run in a log. @throws
    ValueError when there is none"""
    loops, builds, use = LOOP.findall(log), BUILDS.findall(log), USE.findall(log)
    if len(loops) < 2:
        raise ValueError(
            "; ".join(line for line in log.splitlines() if "ERROR" in line)[:300] or "no second run in the log"
        )
    seconds, steps, particles = loops[-1]
    share = sum(float(percent) / 100.0 * int(tasks) for percent, tasks in use[-1:]) or None
    return {
        "step_s": float(seconds) / int(steps),
        "cpu_s": share and share * float(seconds) / int(steps),
        "particles": int(particles),
        "rebuilds_per_step": (int(builds[-1]) if builds else 0) / int(steps),
    }
