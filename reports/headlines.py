# SPDX-License-Identifier: BSD-3-Clause
"""The headline pages: one question that engines are chosen by, one picture of engines over the exact curve, one
sentence of answer, one table.

Each page is written where its case was run. The curves are the runs' own trajectories, the truth is that of the engine
`exact` or of the metric's zero line, and every number is one of results.json."""

from __future__ import annotations

import math
from types import SimpleNamespace

import headline_pictures as pictures
from headline_parts import (
    Line,
    Page,
    by_engine,
    case_of,
    count,
    join,
    of_all,
    own_engines,
    runs_of,
    share,
    step_of,
    value,
)
from headline_pictures import PRINTED, is_own
from model import is_number, text

SAME = 1e-3  # share of the whole below which a sentence calls an error none


def trajectories_of(results, case):
    """[(label, trajectory)], `exact` first and printed forms last; what cannot be read is left out."""
    from trajectories import NoTrajectory, read

    found = []
    for printed in (False, True):
        for engine, run in runs_of(case, printed):
            try:
                found.append((engine.label + (PRINTED if printed else ""), read(results.folder, run)))
            except NoTrajectory:
                continue
    return sorted(found, key=lambda entry: entry[0] != "exact")


# --- does your engine spin a free body right? -------------------------------------------------------------------------

SPIN = "rigid/torque-free"


def long_axis(quaternions):
    """The first body's x axis in the world, (frames, 3): the first column of its rotation."""
    import numpy as np

    w, x, y, z = (quaternions[:, 0, k] for k in range(4))
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=1)


def tip(trajectory):
    """(times, z of the long axis, its rate): da/dt = omega x a, whose z is omega_x a_y - omega_y a_x. Rate None where
    the run wrote no angular velocity."""
    axis = long_axis(trajectory.bodies["orientation"])
    spins = trajectory.bodies.get("angular_velocity")
    rate = None if spins is None else spins[:, 0, 0] * axis[:, 1] - spins[:, 0, 1] * axis[:, 0]
    return trajectory.body_times, axis[:, 2], rate


def spin(results, out):
    case = case_of(results, SPIN)
    if case is None:
        return None
    sides = turned_against_exact(results, case)
    others, printed = spins_of(case, sides), spins_of(case, sides, printed=True)
    if not others:
        return None
    notes = [
        "Signs: within 0.01 rad, within 0.1 rad, farther off. One body at one step: other spins are in the case "
        "rigid/precession."
    ]
    if printed:
        notes.append(
            f'"{PRINTED.strip()}": our own solver by the equations as the paper prints them, the mode paper of the '
            "case."
        )
    return Page(
        "spin.html",
        "Does your engine spin a free body right?",
        spin_answer(others, printed),
        spin_picture(results, out, case),
        ["engine", "time step", "angle error [rad]", "[degrees]", "along its spin", "energy error", "order"],
        [
            Line(label, cells, "pass" if angle < 0.01 else "fail" if angle > 0.1 else "open")
            for angle, label, cells, _ in sorted(others + printed)
        ],
        cases=[c for c in (case, case_of(results, "rigid/precession")) if c is not None],
        notes=notes,
    )


def spin_answer(others, printed):
    right = [label for angle, label, _, _ in others if angle < 0.01]
    steps = sorted({step for _, _, _, step in others + printed})
    end = (
        f"after 10 s of tumbling at {'a step' if len(steps) == 1 else 'steps'} of {join(steps)}, "
        f"{of_all(len(right), len(others))} {'(without our printed form) ' if printed else ''}point within 0.01 "
        "rad of the truth"
    )
    own = "".join(f"; {label} is {angle:.4g} rad off" for angle, label, _, _ in printed)
    return f"{'Yes for ' + join(list(by_engine(right))) if right else 'No'}: {end}{farthest(others)}{own}."


def farthest(others):
    """The engines that are farther off than 0.1 rad, the farthest one with its angle."""
    wrong = [(angle, label) for angle, label, _, _ in others if angle > 0.1]
    far = f"; {others[-1][1]} is {others[-1][0]:.4g} rad off" if others[-1][0] >= 0.01 else ""
    if wrong[:-1]:
        far += ", " + join([f"{label} {angle:.2g}" for angle, label in reversed(wrong[:-1])])
    return far


def spin_picture(results, out, case):
    curves = [
        (label, tip(trajectory))
        for label, trajectory in trajectories_of(results, case)
        if "orientation" in trajectory.bodies
    ]
    exact = next((curve for label, curve in curves if label == "exact"), None)
    if exact is None:
        return None
    caption = (
        f"Case {case.id}, at its own time step. The wide grey curve is exact. Dots are the frames that were "
        "written; between them, cubics by attitude and angular velocity."
    )
    return pictures.picture(
        out,
        "spin",
        "Height of the long axis's tip over ten seconds",
        "z of the body's long axis [1]",
        [entry for entry in curves if entry[0] != "exact"],
        ("exact", exact),
        caption,
        own_engines(results),
    )


AHEAD = 0.5  # cosine between the angle error and the spin, above which it is called one along the spin


def turned_against_exact(results, case):
    """{label: "behind", "ahead" or "aside"}: whether the body has turned less or more than the exact one at the last
    frame, about the axis that it spins about."""
    import numpy as np

    found = dict(trajectories_of(results, case))
    exact = found.get("exact")
    if exact is None or not {"orientation", "angular_velocity"} <= exact.bodies.keys():
        return {}
    spin, (w, x, y, z) = exact.bodies["angular_velocity"][-1, 0], exact.bodies["orientation"][-1, 0]
    back = np.array(
        [[w, -x, -y, -z], [x, w, z, -y], [y, -z, w, x], [z, y, -x, w]]
    )  # the error in the world is (attitude of the engine) @ back
    words = {}
    for label, trajectory in found.items():
        if label == "exact" or "orientation" not in trajectory.bodies:
            continue
        error = trajectory.bodies["orientation"][-1, 0] @ back
        error *= math.copysign(1.0, error[0])
        sizes = float(np.linalg.norm(error[1:]) * np.linalg.norm(spin))
        along = float(error[1:] @ spin) / sizes if sizes > 0.0 else 0.0
        words[label] = "ahead" if along > AHEAD else "behind" if along < -AHEAD else "aside"
    return words


def spins_of(case, sides, printed=False):
    """[(angle error, label, cells of the table, step)], the best first."""
    found = []
    for engine, run in runs_of(case, printed):
        angle = value(run, "angle")
        if engine.name != "exact" and angle is not None:
            order = next((o for o in engine.orders if o.metric == "angle" and (o.mode == "paper") == printed), None)
            found.append(
                (
                    abs(angle),
                    engine.label + (PRINTED if printed else ""),
                    [
                        step_of(run),
                        f"{abs(angle):.4g}",
                        f"{math.degrees(abs(angle)):.3g}",
                        sides.get(engine.label + (PRINTED if printed else ""), "—"),
                        signed_energy(run),
                        order_of(order),
                    ],
                    step_of(run),
                )
            )
    return sorted(found)


def order_of(order):
    """The order with its class: a number whose error ends on a floor is none."""
    if order is None or not is_number(order.value):
        return "—"
    return f"{order.value:.1f}" + (f" ({order.fit_class})" if order.fit_class else "")


def signed_energy(run):
    energy = value(run, "energy")
    return "—" if energy is None else f"{energy:.2g}"


# --- does it make energy when it bounces? -----------------------------------------------------------------------------

BOUNCES = (
    ("contact/ball-restitution-100", "1"),
    ("contact/ball-restitution-090", "0.9"),
    ("contact/ball-restitution-050", "0.5"),
    ("contact/ball-restitution-000", "0"),
    ("contact/box-restitution-100", "1, box"),
    ("contact/tumble-elastic", "1, tumbling box"),
    ("contact/tumble-elastic-default", "1, tumbling box"),
)


MAKES = 0.01  # share of the energy of the fall above which the page says that an engine makes energy


def bounce(results, out):
    cases = cases_of(results, BOUNCES)
    gains = gains_of(cases)
    if not gains:
        return None
    columns = list(dict.fromkeys(words for _, words in cases))
    worst = {label: max(found.values()) for label, found in gains.items()}
    ordered = sorted(gains, key=worst.get)
    lines = [
        Line(
            label,
            [share(worst[label])] + [share(gains[label][words]) if words in gains[label] else "—" for words in columns],
            "fail" if worst[label] > MAKES else "pass",
        )
        for label in ordered
    ]
    gaps = any(len(found) < len(columns) for found in gains.values())
    return Page(
        "bounce.html",
        "Does it make energy when it bounces?",
        bounce_answer(worst, ordered),
        energies_picture(out, cases, gains, own_engines(results)),
        ["engine", "greatest"] + [f"e = {words}" for words in columns],
        lines,
        notes=['"—": the engine refuses this case, or the case does not ask for it.'] if gaps else [],
        cases=[case for case, _ in cases],
    )


def cases_of(results, names):
    """[(case, what it is called by)] of those that were run."""
    found = [(case_of(results, name), words) for name, words in names]
    return [(case, words) for case, words in found if case is not None]


def measured(cases, metric):
    """(engine's label, what the case is called by, value, run) of each engine but the exact one."""
    for case, words in cases:
        for engine, run in runs_of(case):
            number = value(run, metric)
            if engine.name != "exact" and number is not None:
                yield engine.label, words, number, run


def gains_of(cases):
    """{engine's label: {what the case is called by: energy made}}"""
    gains = {}
    for label, words, gain, _ in measured(cases, "energy_gain"):
        gains.setdefault(label, {})[words] = gain
    return gains


def bounce_answer(worst, ordered):
    makers = by_engine([label for label in reversed(ordered) if worst[label] > MAKES])
    if makers:
        rest = sum(worst[label] <= MAKES for label in ordered)
        made = [f"{name} makes up to {share(max(worst[one] for one in members))}" for name, members in makers.items()]
        return (
            f"{'Some do' if rest else 'Yes'}: {join(made)} of the energy of the fall in its hits; "
            f"{of_all(rest, len(ordered))} stay below 1 %."
        )
    number = count(1, "engine and preset") if len(ordered) == 1 else f"{len(ordered)} engines and presets"
    return f"No: none of {number} makes more than {share(max(worst.values()))} of the energy of the fall."


def energies_picture(out, cases, gains, own):
    """Energy above that of the start, in time, in the case in which most is made."""
    most = max(cases, key=lambda entry: max((found.get(entry[1], 0.0) for found in gains.values()), default=0.0))
    curves = []
    for engine, run in runs_of(most[0]):
        metric = run.metrics.get("energy_gain")
        if engine.name != "exact" and metric is not None and len(metric.times) == len(metric.series) > 1:
            curves.append((engine.label, curve_of(metric, 100.0, metric.series[0])))
    return pictures.picture(
        out,
        "bounce",
        f"Energy since the start, restitution {most[1]}",
        "energy above that of the start [% of the fall's]",
        curves,
        ("none made", None),
        f"Case {most[0].id}: the one of these in which most is made. A curve above the grey line has made energy; to "
        "lose some is right where the restitution is below 1.",
        own,
    )


def curve_of(metric, scale=1.0, start=0.0):
    """(times, values, no rates) of a metric in time."""
    import numpy as np

    return np.array(metric.times, float), scale * (np.array(metric.series, float) - start), None


# --- does it float? ---------------------------------------------------------------------------------------------------

FLOATS = (
    ("coupling/floating-block-025", 0.25),
    ("coupling/floating-block-050", 0.5),
    ("coupling/floating-block-080", 0.8),
)

FLOATS_WITHIN = 0.5  # spacings of draught: below what the particles resolve


def floats(results, out):
    cases = cases_of(results, FLOATS)
    errors, depths = {}, {}
    for label, density, draught, run in measured(cases, "draught"):
        errors.setdefault(label, {})[density] = draught
        depths.setdefault(label, []).append((density, run.metrics["draught"]))
    if not errors:
        return None
    worst = {label: max(map(abs, found.values())) for label, found in errors.items()}
    ordered = sorted(errors, key=worst.get)
    densities = [density for _, density in cases]
    lines = [
        Line(
            label,
            [f"{errors[label][density]:+.2f}" if density in errors[label] else "—" for density in densities],
            "pass" if worst[label] <= FLOATS_WITHIN else "fail",
        )
        for label in ordered
    ]
    return Page(
        "float.html",
        "Does it float?",
        floats_answer(worst, ordered, densities),
        draught_picture(out, depths, cases, own_engines(results)),
        ["engine"] + [f"density {density:g}" for density in densities],
        lines,
        notes=["The table is of the draught's error in particle spacings; the densities are relative to water."],
        cases=[case for case, _ in cases],
    )


def floats_answer(worst, ordered, densities):
    good = [label for label in ordered if worst[label] <= FLOATS_WITHIN]
    if not good:
        return f"No: the best, {ordered[0]}, is {worst[ordered[0]]:.2g} spacings off Archimedes' draught."
    others = join([f"{label} is {worst[label]:.2g} off" for label in ordered if label not in good])
    return (
        f"Yes for {join(good)}: blocks of {join([f'{density:g}' for density in densities])} of the density of water "
        f"float within {max(worst[label] for label in good):.2g} spacings of Archimedes' "
        f"draught{'; ' + others if others else ''}."
    )


def draught_picture(out, depths, cases, own):
    """Error of the draught in time; the zero line is Archimedes, the band what counts as floating right."""
    curves = [
        (f"{label} · {density:g}", curve_of(metric))
        for label, found in depths.items()
        for density, metric in found
        if len(metric.times) == len(metric.series) > 1
    ]
    return pictures.picture(
        out,
        "float",
        "Error of the draught of floating blocks in time",
        "draught less Archimedes' [spacings]",
        curves,
        ("Archimedes", None),
        f"Cases {join([case.id for case, _ in cases])}. Labels end with the density relative to water. The green band "
        "is half a spacing to either side.",
        own,
        FLOATS_WITHIN,
    )


# --- can I upgrade? ---------------------------------------------------------------------------------------------------


def times(ratio):
    """ "3.4 times", "1300 times": two digits, without an exponent where it can be read so."""
    return f"{float(f'{ratio:.2g}'):g} times" if ratio < 1e6 else f"{ratio:.1e} times"


def upgrade_answer(document):
    """One sentence from a table of releases: the greatest change for the worse, else that there is none. @return ""
    where nothing can be said"""
    releases = dicts(document.get("releases"))
    if not releases:
        return ""
    first, last = releases[0], releases[-1]
    names = f"{text(first.get('engine'))} {text(first.get('version'))} to {text(last.get('version'))}"
    ratio, c = max(map(growth, dicts(document.get("changes"))), key=lambda entry: entry[0], default=(0, {}))
    if ratio > 1 and c.get("worse"):
        return (
            f"Not blindly: over {names}, {text(c.get('preset'))}'s {text(c.get('metric'))} error grows "
            f"{times(ratio)} from {text(c.get('from'))} to {text(c.get('to'))}."
        )
    return f"Yes: over {names} no error of this case grows by more than {document.get('margin', 1)} times."


def dicts(rows):
    return [row for row in rows or [] if isinstance(row, dict)]


def growth(change):
    """(by how many times an error grew, the change); 0 times where that is round-off or has no number."""
    before, after = change.get("before"), change.get("after")
    sized = not change.get("round_off") and is_number(before) and is_number(after) and before and after
    return (abs(after / before) if sized else 0, change)


# --- all --------------------------------------------------------------------------------------------------------------

QUESTIONS = (spin, bounce, floats)


def own_first(page, own):
    """The user's own engine heads the table."""
    for line in page.lines:
        line.own = is_own(line.label, own)
    page.lines.sort(key=lambda line: not line.own)
    return page


def pages(results, out):
    """@return (pages, notes): those whose cases were run; a page that cannot be drawn costs a note, not the report"""
    found, notes = [], []
    for make in QUESTIONS:
        try:
            page = make(results, out)
        except Exception as error:
            notes.append(f"the page of {make.__name__} could not be made: {type(error).__name__}: {error}")
            continue
        if page:
            found.append(own_first(page, own_engines(results)))
    if (results.folder / "releases.json").is_file():
        found.append(SimpleNamespace(file="upgrade.html", question="Can I upgrade?"))
    return found, notes
