# SPDX-License-Identifier: BSD-3-Clause
"""The headline pages: one question that engines are chosen by, one picture of engines over the exact curve, one sentence of answer, one table.

Each page is written where its case was run. The curves are the runs' own trajectories, the truth is that of the engine `exact` or of the
metric's zero line, and every number is one of results.json.
"""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from types import SimpleNamespace

from model import is_number, text

STRANGERS = 10  # curves beside the exact one that a picture holds
SAME = 1e-3     # share of the whole below which a sentence calls an error none


@dataclass
class Line:
    """One engine in the table."""
    label: str
    cells: list
    tone: str = ""


@dataclass
class Page:
    file: str
    question: str
    answer: str
    picture: object
    columns: list
    lines: list
    notes: list = field(default_factory=list)
    cases: list = field(default_factory=list)  # whose numbers these are


def case_of(results, case_id):
    return next((case for case in results.cases if case.id == case_id), None)


def runs_of(case):
    """(engine, run) of each engine and preset at the case's own resolution; ours in its corrected form only."""
    found = []
    for engine in case.engines:
        run = next((run for run in engine.runs if run.base and run.status == "ok" and run.mode != "paper"), None)
        if run is not None:
            found.append((engine, run))
    return found


def value(run, metric):
    found = run.metrics.get(metric)
    return found.value if found is not None and is_number(found.value) else None


def join(words):
    return ", ".join(words[:-1]) + " and " + words[-1] if len(words) > 1 else "".join(words)


def share(number):
    """A share as percent with two digits."""
    size = 100 * abs(number)
    return f"{size:.0f} %" if size >= 9.95 else f"{size:.2g} %" if size >= 0.0995 else "less than 0.1 %"


def count(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def trajectories_of(results, case):
    """[(engine, run, trajectory)], `exact` first; what cannot be read is left out."""
    from trajectories import NoTrajectory, read
    found = []
    for engine, run in runs_of(case):
        try:
            found.append((engine, run, read(results.folder, run)))
        except NoTrajectory:
            continue
    return sorted(found, key=lambda entry: entry[0].name != "exact")


# --- does your engine spin a free body right? ---------------------------------------------------------------------------

SPIN = "rigid/torque-free"


def long_axis(quaternions):
    """z of the body's x axis, in the world: row 3, column 1 of the rotation."""
    w, x, y, z = (quaternions[:, 0, k] for k in range(4))
    return 2 * (x * z - w * y)


def spin(results, out):
    case = case_of(results, SPIN)
    if case is None:
        return None
    lines = []
    for engine, run in runs_of(case):
        angle = value(run, "angle")
        if engine.name != "exact" and angle is not None:
            order = next((o for o in engine.orders if o.metric == "angle" and o.mode != "paper"), None)
            lines.append((abs(angle), engine.label, [f"{abs(angle):.2g}", f"{math.degrees(abs(angle)):.2g}", signed_energy(run), f"{order.value:.1f}" if order and is_number(order.value) else "—"]))
    if not lines:
        return None
    lines.sort()
    right = [label for angle, label, _ in lines if angle < 0.01]
    end = f"after 10 s of tumbling at the case's step, {len(right)} of {count(len(lines), 'engine and preset') if len(lines) == 1 else f'{len(lines)} engines and presets'} point within 0.01 rad of the truth"
    far = f"; {lines[-1][1]} is {lines[-1][0]:.2g} rad off" if lines[-1][0] >= 0.01 else ""
    answer = f"{'Yes for ' + join(right) if right else 'No'}: {end}{far}."
    picture = curves_picture(results, out, case, "spin", "Height of the long axis's tip over ten seconds", "z of the body's long axis [1]", lambda t: (t.body_times, long_axis(t.bodies["orientation"])), "orientation")
    return Page("spin.html", "Does your engine spin a free body right?", answer, picture, ["engine", "angle error [rad]", "[degrees]", "energy change", "order"],
                [Line(label, cells, "pass" if angle < 0.01 else "fail" if angle > 0.1 else "open") for angle, label, cells in lines], cases=[case])


def signed_energy(run):
    energy = value(run, "energy")
    return "—" if energy is None else f"{energy:.2g}"


# --- does it make energy when it bounces? -------------------------------------------------------------------------------

BOUNCES = (("contact/ball-restitution-100", "1"), ("contact/ball-restitution-090", "0.9"), ("contact/ball-restitution-050", "0.5"), ("contact/ball-restitution-000", "0"),
           ("contact/box-restitution-100", "1, box"), ("contact/tumble-elastic", "1, tumbling box"),
           ("contact/tumble-elastic-default", "1, tumbling box"))


def bounce(results, out):
    cases = [(case_of(results, name), words) for name, words in BOUNCES]
    cases = [(case, words) for case, words in cases if case is not None]
    if not cases:
        return None
    gains = {}
    for case, words in cases:
        for engine, run in runs_of(case):
            gain = value(run, "energy_gain")
            if engine.name != "exact" and gain is not None:
                gains.setdefault(engine.label, {})[words] = gain
    if not gains:
        return None
    columns = list(dict.fromkeys(words for _, words in cases))
    worst = {label: max(found.values()) for label, found in gains.items()}
    ordered = sorted(gains, key=worst.get)
    makers = [label for label in ordered if worst[label] > 0.01]
    if makers:
        rest = len(ordered) - len(makers)
        answer = f"{'Some do' if rest else 'Yes'}: {join([f'{label} makes up to {share(worst[label])}' for label in reversed(makers)])} of the energy of the fall in its hits; {rest} of {len(ordered)} engines and presets stay below 1 %."
    else:
        answer = f"No: none of {len(ordered)} engines and presets makes more than {share(max(worst.values()))} of the energy of the fall."
    picture = curves_picture(results, out, cases[0][0], "bounce", f"Height of a ball of restitution {cases[0][1]}", "height of the centre [m]", lambda t: (t.body_times, t.bodies["position"][:, 0, 2]), "position")
    lines = [Line(label, ["—" if words not in gains[label] else share(gains[label][words]) for words in columns], "fail" if worst[label] > 0.01 else "pass") for label in ordered]
    return Page("bounce.html", "Does it make energy when it bounces?", answer, picture, ["engine"] + [f"e = {words}" for words in columns], lines, cases=[case for case, _ in cases])


# --- does it float? -----------------------------------------------------------------------------------------------------

FLOATS = (("coupling/floating-block-025", 0.25), ("coupling/floating-block-050", 0.5), ("coupling/floating-block-080", 0.8))


def floats(results, out):
    cases = [(case_of(results, name), density) for name, density in FLOATS]
    cases = [(case, density) for case, density in cases if case is not None]
    errors, depths = {}, {}
    for case, density in cases:
        for engine, run in runs_of(case):
            draught = value(run, "draught")
            if engine.name != "exact" and draught is not None:
                errors.setdefault(engine.label, {})[density] = draught
                depths.setdefault(engine.label, []).append((density, run.metrics["draught"]))
    if not errors:
        return None
    worst = {label: max(map(abs, found.values())) for label, found in errors.items()}
    ordered = sorted(errors, key=worst.get)
    good = [label for label in ordered if worst[label] <= 0.5]
    answer = (f"Yes for {join(good)}: blocks of {join([f'{density:g}' for _, density in cases])} of the density of water float within {max(worst[label] for label in good):.2g} spacings of Archimedes' draught."
              if good else f"No: the best, {ordered[0]}, is {worst[ordered[0]]:.2g} spacings off Archimedes' draught.")
    lines = [Line(label, ["—" if density not in errors[label] else f"{errors[label][density]:+.2f}" for _, density in cases], "pass" if worst[label] <= 0.5 else "fail") for label in ordered]
    return Page("float.html", "Does it float?", answer, draught_picture(out, depths, cases), ["engine"] + [f"density {density:g}: draught error [spacings]" for _, density in cases], lines, cases=[case for case, _ in cases])


# --- pictures -----------------------------------------------------------------------------------------------------------

def finished(figure, out, name, title, alt, caption):
    from figures import Picture, style
    return Picture(name, title, alt, caption, style.inline(style.files(figure, out / "figures" / f"headline-{name}"), f"headline-{name}"), f"figures/headline-{name}", False)


def hues(labels):
    from figures import style
    palette = (style.BLUE, style.ORANGE, style.GREEN, style.PINK, style.AMBER, style.SKY, style.RED, style.GREY)
    return {label: {"color": palette[k % len(palette)], "linestyle": ("-", "--", ":", "-.")[k // len(palette) % 4]} for k, label in enumerate(labels)}


def curves_picture(results, out, case, name, title, axis_label, curve, needs):
    """Every engine's own curve over the exact one, which is wide and grey."""
    import numpy as np

    from figures import style
    shown = [entry for entry in trajectories_of(results, case) if needs in entry[2].bodies]
    if not shown:
        return None
    figure, (axis,) = style.panels(1, 1, height=3.4)
    figure.set_size_inches(style.WIDTH, 4.2)
    labels = [engine.label for engine, _, _ in shown if engine.name != "exact"][:STRANGERS]
    looks = hues(labels)
    for engine, _, trajectory in shown:
        times, heights = curve(trajectory)
        if engine.name == "exact":
            axis.plot(times, heights, color=style.GREY, linewidth=5, alpha=0.55, label="exact", zorder=1)
        elif engine.label in looks:
            axis.plot(times, np.asarray(heights), linewidth=1.3, label=engine.label, zorder=2, **looks[engine.label])
    axis.set_xlabel("time [s]")
    axis.set_ylabel(axis_label)
    frame(figure, axis, len(labels) + 1)
    return finished(figure, out, name, title, f"{title}, of {join(labels)} over the exact curve.", f"Case {case.id}, at its own time step. The wide grey curve is exact.")


def frame(figure, axis, entries):
    from figures import style
    lines = -(-entries // 5)
    height = figure.get_figheight()
    figure.subplots_adjust(left=0.75 / style.WIDTH, right=1 - 0.15 / style.WIDTH, bottom=0.5 / height, top=1 - (0.2 + 0.2 * lines) / height)
    style.legend(figure, [axis])


def draught_picture(out, depths, cases):
    """Error of the draught in time; the zero line is Archimedes."""
    from figures import style
    figure, (axis,) = style.panels(1, 1, height=3.4)
    figure.set_size_inches(style.WIDTH, 4.2)
    curves = [(f"{label}, {density:g}", metric) for label, found in depths.items() for density, metric in found if len(metric.times) == len(metric.series) > 1]
    looks = hues([label for label, _ in curves])
    axis.axhline(0.0, color=style.GREY, linewidth=5, alpha=0.55, label="Archimedes", zorder=1)
    for label, metric in curves:
        axis.plot(metric.times, metric.series, linewidth=1.3, label=label, zorder=2, **looks[label])
    axis.set_xlabel("time [s]")
    axis.set_ylabel("draught less Archimedes' [spacings]")
    frame(figure, axis, len(curves) + 1)
    return finished(figure, out, "float", "Draught of floating blocks in time", "Error of the draught of each engine and density against time.", f"Cases {join([case.id for case, _ in cases])}. Labels: engine and density relative to water.")


# --- can I upgrade? -----------------------------------------------------------------------------------------------------

def upgrade_answer(document):
    """One sentence from a table of releases: the greatest change for the worse, else that there is none. @return "" where nothing can be said"""
    changes = [c for c in document.get("changes") or [] if isinstance(c, dict) and not c.get("round_off")]
    sized = [(after / before, c) for c in changes if is_number(before := c.get("before")) and is_number(after := c.get("after")) and before and after]
    sized = [(abs(ratio), c) for ratio, c in sized]
    releases = [row for row in document.get("releases") or [] if isinstance(row, dict)]
    if not releases:
        return ""
    worse = max(sized, key=lambda entry: entry[0], default=(0, None))
    names = f"{text(releases[0].get('engine'))} {text(releases[0].get('version'))} to {text(releases[-1].get('version'))}"
    if worse[0] > 1 and worse[1].get("worse"):
        c = worse[1]
        return f"Not blindly: over {names}, {text(c.get('preset'))}'s {text(c.get('metric'))} error grows {worse[0]:.3g} times from {text(c.get('from'))} to {text(c.get('to'))}."
    return f"Yes: over {names} no error of this case grows by more than {document.get('margin', 1)} times."


# --- all ----------------------------------------------------------------------------------------------------------------

QUESTIONS = (spin, bounce, floats)


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
            found.append(page)
    if (results.folder / "releases.json").is_file():
        found.append(SimpleNamespace(file="upgrade.html", question="Can I upgrade?"))
    return found, notes
