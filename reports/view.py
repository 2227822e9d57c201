# SPDX-License-Identifier: BSD-3-Clause
"""Writes one page that shows the particles of runs in three dimensions: python3 view.py RUN [RUN...] [--out FILE]
[--limit MB]

It is what `tripoint view` calls. The page holds everything that it needs, three.js too, and loads nothing. Places and
fields of the frames that were written are rounded to 1/65534 of their range, so a page is for looking; digits are in
trajectory.h5. Where a run is too large for the page, first frames are left out, then particles, and the page says so.
Exit: 0 written; 2 bad input; 4 a dataset, a library or room on the disk is missing; 130 Ctrl-C."""

from __future__ import annotations

import argparse
import base64
import errno
import json
import math
import signal
import sys
from dataclasses import dataclass, field
from pathlib import Path

import no_plugins  # noqa: F401  before h5py

REPORTS = Path(__file__).resolve().parent
DONE, BAD_INPUT, MISSING, INTERRUPTED = 0, 2, 4, 130
MOST_RUNS = 6  # side by side in one window
STEPS = 65534  # parts of a range; 65535 says that there is no number
NOTHING = 65535
FEWEST_FRAMES = 12  # frames are thinned to this number before any particle is left out
FLOWN_OFF = 0.5  # percent of the free particles, at each end of each axis, that need not be in the first view
BESIDE = 900_000  # bytes of the page that are not data: three.js, the script, the style
PHASES = ("liquid", "elastic", "rigid")
CLASSES = ("phase", "body", "material")
NUMBERS = ("temperature", "speed", "pressure", "density", "liquid_fraction")
UNITS = {"m s-1": "m/s", "kg m-3": "kg/m³", "1": ""}


class BadInput(Exception):
    """What was asked for cannot be; the message is a sentence that says what can."""


@dataclass
class Shown:
    """What a page holds of one run: rows are the particles that are shown, and columns follow the frames that are
    shown."""

    name: str
    times: list
    position: object  # (frames, particles, 3) [m]; NaN where a particle is not alive
    wall: object  # (particles,) whether it belongs to a body that is fixed or driven
    fields: dict  # name -> (frames, particles); classes are integers
    labels: dict  # class -> names of its numbers
    spacing: float  # [m]
    up: tuple  # against gravity
    frames: int = 0  # that the run wrote
    particles: int = 0  # that the run has
    every_frame: int = 1
    every_particle: int = 1
    notes: list = field(default_factory=list)


def folder_of(words):
    """The folder of a run by its name, as `tripoint render` takes it: a folder, a trajectory.h5, or the id of a case
    that has a run in runs/."""
    by_case = Path("runs") / words / "tripoint"
    return by_case if not Path(words).exists() and (by_case / "trajectory.h5").is_file() else Path(words)


def read(words, room):
    """@param room bytes that this run may take in the page   @raises BadInput; exports.run.NotARun"""
    from exports.run import Run

    with Run(folder_of(words)) as run:
        frames, particles = len(run), run.dataset("particles/all/position/value").shape[1]
        if frames == 0 or particles == 0:
            raise BadInput(
                f"{run.path}: holds no {'frame' if frames == 0 else 'particle'}, so there is nothing to look at"
            )
        names = [name for name in (*CLASSES, *NUMBERS) if name in run.fields or name == "speed"]
        every_frame, every_particle = thinned(frames, particles, len(names), room)
        numbers = sorted({*range(0, frames, every_frame), frames - 1})
        rows = slice(None, None, every_particle)
        place = places_of(run, numbers, rows)
        fields = {name: field_of(run, name, numbers, rows) for name in names}
        shown = Shown(
            str(run.folder),
            [float(run.times[n]) for n in numbers],
            place,
            walls_of(run, fields.get("body"), place),
            fields,
            labels_of(run, fields),
            stated_spacing(run) or spacing_of(place),
            up_of(run),
            frames,
            particles,
            every_frame,
            every_particle,
        )
        shown.name = name_of(run)
        return shown


def places_of(run, numbers, rows):
    """Positions, (frames, particles, 3); not a number where a particle is not alive."""
    import numpy as np

    place = np.stack([run.field("position", n)[rows] for n in numbers])
    if "id" in run.fields:
        place[np.stack([run.field("id", n)[rows] for n in numbers]) < 0] = np.nan
    there = np.isfinite(place).all(axis=2)
    place[~there] = np.nan
    if not there.any():
        raise BadInput(f"{run.path}: no particle is alive in any frame, so there is nothing to look at")
    return place


def field_of(run, name, numbers, rows):
    import numpy as np

    if name == "speed":
        return np.stack([np.linalg.norm(run.field("velocity", n)[rows], axis=1) for n in numbers])
    return np.stack([run.field(name, n)[rows] for n in numbers])


def stated_spacing(run):
    """[m]; 0 where the run states none"""
    spacing = (run.job.get("resolution") or {}).get("spacing") or run.scene().get("spacing") or 0.0
    return max(float(spacing), 0.0)


def up_of(run):
    import numpy as np

    gravity = np.array(run.scene().get("gravity") or [0.0, 0.0, 0.0], float)
    force = float(np.linalg.norm(gravity))
    return tuple(-gravity / force) if force > 0 else (0.0, 0.0, 1.0)


def name_of(run):
    """ "paper/fig-12: tripoint, corrected": the case and what the run's folder says of engine and form; the folder
    where the job says no case."""
    case, folder = str(run.job.get("case") or ""), run.folder.resolve().as_posix()
    if not case:
        return str(run.folder)
    rest = folder.rpartition(f"/{case}/")[2].split("/") if f"/{case}/" in folder else [run.folder.resolve().name]
    mode = str(run.scene().get("mode") or "")
    words = rest + ([mode] if mode and rest == ["tripoint"] else [])
    return f"{case}: {', '.join(words)}"


def thinned(frames, particles, fields, room):
    """(every n-th frame, every n-th particle) that a run of this size may show in so many bytes: fewer frames first,
    then fewer particles."""
    each = 4 / 3 * (6 + 2 * fields)  # bytes of a particle in a frame, as base64
    every_frame = max(1, math.ceil(frames / max(1, room / (each * particles))))
    if frames > FEWEST_FRAMES:
        every_frame = min(every_frame, math.ceil(frames / FEWEST_FRAMES))
    else:
        every_frame = 1
    left = math.ceil(frames / every_frame) + 1
    return every_frame, max(1, math.ceil(each * particles * left / room))


def walls_of(run, body, place):
    """Rows of bodies that are fixed or driven, in the first frame; none where the job does not say it, or where all is
    wall."""
    import numpy as np

    fixed = [
        entry.get("index")
        for entry in run.scene().get("bodies") or []
        if entry.get("motion") in ("fixed", "prescribed")
        and isinstance(entry.get("index"), int)
        and entry.get("index") >= 0
    ]
    wall = (
        np.isin(body[0], fixed) & np.isfinite(place[0]).all(axis=1)
        if body is not None and fixed
        else np.zeros(place.shape[1], bool)
    )
    return wall if not wall.all() else np.zeros(len(wall), bool)


def labels_of(run, fields):
    bodies = run.body_names()
    materials = [str(entry.get("name", "")) for entry in run.scene().get("materials") or []]
    names = {"phase": list(PHASES), "body": bodies, "material": materials}
    return {name: names[name] for name in CLASSES if name in fields}


def spacing_of(place):
    """As if the particles of the first frame filled the box around them."""
    import numpy as np

    first = next(frame[np.isfinite(frame).all(axis=1)] for frame in place if np.isfinite(frame).any())
    size = np.ptp(first, axis=0)
    size = size[size > 0]
    return float((np.prod(size) / len(first)) ** (1 / max(len(size), 1))) if len(size) else 1.0


# --- what the page holds ----------------------------------------------------------------------------------------------


class Store:
    """Columns one behind the other; what is embedded says where each begins."""

    def __init__(self):
        self.parts, self.bytes = [], 0

    def add(self, values):
        """@return offset [bytes], always even"""
        at, raw = self.bytes, values.tobytes()
        raw += b"\0" * (len(raw) % 2)
        self.parts.append(raw)
        self.bytes += len(raw)
        return at

    def text(self):
        return base64.b64encode(b"".join(self.parts)).decode()


def rounded(values, low, high):
    """Numbers as parts of their range, 0 to STEPS; NOTHING where there is none."""
    import numpy as np

    sound = np.isfinite(values)
    parts = np.zeros(values.shape) if high <= low else (np.where(sound, values, low) - low) / (high - low) * STEPS
    return np.where(sound, np.clip(np.rint(parts), 0, STEPS), NOTHING).astype("<u2")


def ranges(runs):
    """{field of numbers: (least, greatest)} over all runs, walls too; fields in which nothing differs are left out."""
    import numpy as np

    found = {}
    for name in NUMBERS:
        columns = [
            values[np.isfinite(run.position).all(axis=2)]
            for run in runs
            for values in [run.fields.get(name)]
            if values is not None
        ]
        values = np.concatenate(columns) if columns else np.empty(0)
        values = values[np.isfinite(values)]
        if len(values) and values.max() - values.min() > 1e-9 * max(1e-300, np.abs(values).max()):
            found[name] = (float(values.min()), float(values.max()))
    return found


def packed(runs, units):
    """@return (what the script reads, base64 of the columns). Columns that never change are held once."""
    store, spans = Store(), ranges(runs)
    told = [packed_run(run, spans, store) for run in runs]
    order = [
        name
        for name in ("phase", "temperature", "speed", "pressure", "body", "material", "density", "liquid_fraction")
        if any(name in run["fields"] for run in told)
    ]
    return {
        "steps": STEPS,
        "nothing": NOTHING,
        "runs": told,
        "order": order,
        "spans": {name: list(span) for name, span in spans.items()},
        "units": {name: UNITS.get(units.get(name, ""), units.get(name, "")) for name in spans},
    }, store.text()


def packed_run(run, spans, store):
    import numpy as np

    low = np.nanmin(run.position, axis=(0, 1))
    high = np.nanmax(run.position, axis=(0, 1))
    fields = {}
    for name in run.fields:
        column = column_of(run, name, spans)
        if column is not None:
            once = bool((column == column[:1]).all())
            fields[name] = {"at": store.add(column[:1] if once else column), "once": once}
    look = looked_at(run)
    return {
        "name": run.name,
        "look": [corner.tolist() for corner in look],
        "times": run.times,
        "particles": int(run.position.shape[1]),
        "spacing": run.spacing * run.every_particle ** (1 / 3),
        "up": [float(x) for x in run.up],
        "low": low.tolist(),
        "high": high.tolist(),
        "position": store.add(np.stack([rounded(run.position[..., k], low[k], high[k]) for k in range(3)], axis=-1)),
        "wall": store.add(run.wall.astype("u1")),
        "walls": int(run.wall.sum()),
        "fields": fields,
        "labels": run.labels,
        "all_frames": run.frames,
        "all_particles": run.particles,
        "every_frame": run.every_frame,
        "every_particle": run.every_particle,
    }


def column_of(run, name, spans):
    """Whole numbers for the page; None for a field that tells particles not apart."""
    import numpy as np

    there, values = np.isfinite(run.position).all(axis=2), run.fields[name]
    if name in spans:
        return rounded(np.where(there, values, np.nan), *spans[name])
    if name not in CLASSES:
        return None
    column = np.where(there, values.astype(int) + 1, 0).astype("<u2")  # 0: none, as a liquid has no body
    return column if name == "phase" or len(np.unique(column[there])) >= 2 else None


def looked_at(run):
    """(least, greatest) corner of what a camera looks at: all that moves or rests, but for the few free particles that
    fly off."""
    import numpy as np

    sound = run.position[:, ~run.wall].reshape(-1, 3)
    sound = sound[np.isfinite(sound).all(axis=1)]
    corners = [np.percentile(sound, (FLOWN_OFF, 100 - FLOWN_OFF), axis=0)] if len(sound) else []
    walls = run.position[0, run.wall]
    corners += [np.stack([walls.min(axis=0), walls.max(axis=0)])] if len(walls) else []
    half = 0.5 * run.spacing
    return np.min([c[0] for c in corners], axis=0) - half, np.max([c[1] for c in corners], axis=0) + half


def said_of(run):
    """What is shown of a run and what is left out, as a sentence."""
    words = (
        f"{run['name']}: {len(run['times'])} of {run['all_frames']} frames, {run['particles']} of "
        f"{run['all_particles']} particles"
    )
    if run["every_frame"] > 1 or run["every_particle"] > 1:
        left = [
            f"every {run[key]}th {noun}"
            for key, noun in (("every_frame", "frame"), ("every_particle", "particle"))
            if run[key] > 1
        ]
        words += f" (thinned for the size of this page: {' and '.join(left)} is shown)"
    return words


def module_as_constant(text):
    """three.js is a module that exports names. In a page of one file its export becomes a constant that holds them."""
    head, _, names = text.rpartition("export{")
    pairs = [pair.split(" as ") for pair in names.rstrip().rstrip(";").rstrip("}").split(",")]
    return (
        f"const THREE = (() => {{ 'use strict'; {head}\nreturn "
        f"{{{', '.join(f'{pair[-1]}: {pair[0]}' for pair in pairs)}}}; }})();"
    )


def render(told, columns):
    """@return the page"""
    from page import environment, script_hash, vendor

    script = (
        module_as_constant(vendor("three.module.min.js"))
        + "\n"
        + (REPORTS / "templates" / "view.js").read_text(encoding="utf-8")
    )
    document = json.dumps(told, allow_nan=False).replace("<", "\\u003c")
    return (
        environment()
        .get_template("view.html.j2")
        .render(
            title=" beside ".join(dict.fromkeys(run["name"] for run in told["runs"])),
            told=told,
            said=[said_of(run) for run in told["runs"]],
            walls=any(run["walls"] for run in told["runs"]),
            document=document,
            columns=columns,
            script=script,
            policy=script_hash(script),
        )
    )


def units_of(runs):
    """Units as trajectory.h5 states them, of the first run that has the field."""
    from exports.run import Run

    found = {}
    for words in runs:
        with Run(folder_of(words)) as run:
            found = {**run.fields, "speed": run.fields.get("velocity", ""), **found}
    return found


# --- the command ------------------------------------------------------------------------------------------------------


def main(arguments):
    asked = read_arguments(arguments)
    from exports.run import MissingDataset, NotARun

    try:
        show(asked)
        return DONE
    except BadInput as error:
        return end(error, BAD_INPUT)
    except MissingDataset as error:
        return end(error, MISSING)
    except NotARun as error:
        return end(f"{error}".replace("only trajectory.h5 is exported", "only trajectory.h5 is shown"), BAD_INPUT)
    except ImportError as error:
        return end(f"Python's {error.name} is missing: install the Debian package python3-{error.name}", MISSING)
    except KeyboardInterrupt:
        return end("interrupted; no page was written", INTERRUPTED)
    except OSError as error:
        full = error.errno == errno.ENOSPC
        return end(
            f"{error.filename or 'the page'} could not be written: the disk is full"
            if full
            else f"{error.filename or 'the page'}: {error.strerror or error}",
            MISSING if full else BAD_INPUT,
        )


def show(asked):
    """Writes the page. @raises BadInput"""
    if len(asked.runs) > MOST_RUNS:
        raise BadInput(f"{len(asked.runs)} runs: at most {MOST_RUNS} stand side by side in one page")
    room = asked.limit * 1e6 - BESIDE
    if room < 100_000:
        raise BadInput(f"--limit {asked.limit:g}: a page takes at least 1 MB, for what draws it")
    runs = [read(words, room / len(asked.runs)) for words in asked.runs]
    told, columns = packed(runs, units_of(asked.runs))
    first = folder_of(asked.runs[0])
    out = Path(asked.out) if asked.out else (first if first.is_dir() else first.parent) / "view.html"
    write(out, render(told, columns))
    print(f"{out}  {out.stat().st_size / 1e6:.3g} MB")
    for run in told["runs"]:
        print(f"  {said_of(run)}")


def read_arguments(arguments):
    parser = argparse.ArgumentParser(prog="tripoint view", description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--out")
    parser.add_argument("--limit", type=float, default=10.0)
    return parser.parse_args(arguments)


def write(out, text):
    from exports.files import whole

    out.parent.mkdir(parents=True, exist_ok=True)
    with whole(out) as file:
        file.write(text)


def end(message, code):
    print(f"tripoint: {message}", file=sys.stderr)
    return code


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        sys.exit(main(sys.argv[1:]))
    except BrokenPipeError:
        sys.exit(end("what it printed could not be written (standard output is closed)", BAD_INPUT))
