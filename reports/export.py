# SPDX-License-Identifier: BSD-3-Clause
"""Writes files for other programs: python3 export.py RUN|RESULTS --to FORMAT... [--out DIR] [--frames LIST]

It is what `tripoint export` calls; docs/trajectory.md says which program reads which file. Nothing is computed: numbers
are copied. Exit: 0 written; 2 bad input; 4 a dataset, a library or room on the disk is missing; 130 Ctrl-C."""

from __future__ import annotations

import argparse
import difflib
import errno
import json
import os
import signal
import sys
from pathlib import Path

import no_plugins  # noqa: F401  before h5py

OF_RUNS = {
    "vtp": "vtk_files.write",
    "pvd": "vtk_files.write",
    "xdmf": "xdmf.write",
    "h5md": "h5md.write",
    "lammps": "lammps_dump.write",
    "xyz": "extended_xyz.write",
    "ply": "point_files.write_ply",
    "obj": "point_files.write_obj",
    "csv": "tables.write",
    "paraview": "paraview.write",
}
OF_RESULTS = {"csv": "write_csv", "latex": "write_latex", "pdf": "write_pdf"}
DONE, BAD_INPUT, MISSING, INTERRUPTED = 0, 2, 4, 130


class BadInput(Exception):
    """What was asked for cannot be; the message is a sentence that says what can."""


def main(arguments):
    asked = read_arguments(arguments)
    try:
        tell(made_of(asked), asked.json)
        return DONE
    except BadInput as error:
        return end(error, BAD_INPUT)
    except KeyboardInterrupt:
        return end("interrupted; files that were complete stay, none is left half written", INTERRUPTED)
    except OSError as error:
        full = error.errno == errno.ENOSPC or "No space left" in str(error)
        return end(
            f"{error.filename or 'a file'} could not be written: the disk is full"
            if full
            else f"{error.filename or 'a file'}: {error.strerror or error}",
            MISSING,
        )


def made_of(asked):
    """The files that were written. @raises BadInput"""
    source, formats = Path(asked.source), formats_of(asked)
    results = results_of(source)
    known = OF_RESULTS if results else OF_RUNS
    for name in formats:
        if name not in known:
            other = "a run's folder" if name in OF_RUNS else "a results.json"
            raise BadInput(f"{name} is exported from {other}; {source} gives {', '.join(known)}")
    if results:
        return export_results(results, formats, make_folder(Path(asked.out or results.parent / "export")))
    out = Path(asked.out or (source if source.is_dir() else source.parent) / "export")
    return export_run(source, formats, lambda: make_folder(out), asked)


def read_arguments(arguments):
    parser = argparse.ArgumentParser(prog="tripoint export", description=__doc__.splitlines()[0])
    parser.add_argument("source", metavar="RUN|RESULTS")
    parser.add_argument("--to", action="append", default=[], metavar="FORMAT")
    parser.add_argument("--out")
    parser.add_argument("--frames", default="all")
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(arguments)


def formats_of(asked):
    names = [name.strip().lower() for words in asked.to for name in words.split(",") if name.strip()]
    known = sorted({*OF_RUNS, *OF_RESULTS})
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise BadInput(
                f"no format is named {name}" + (f" (did you mean {near[0]}?)" if near else f": {', '.join(known)}")
            )
    if not names:
        raise BadInput(
            f"name a format with --to: {', '.join(OF_RUNS)} of a run; {', '.join(OF_RESULTS)} of a results.json"
        )
    return list(dict.fromkeys(names))


def results_of(source):
    """results.json, or None where a run was named. @raises BadInput"""
    if source.is_file() and source.suffix == ".json":
        return source
    if (source / "results.json").is_file() and not (source / "trajectory.h5").is_file():
        return source / "results.json"
    if not source.exists():
        raise BadInput(f"{source}: there is no such file or folder")
    return None


def make_folder(out):
    try:
        out.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError, PermissionError) as error:
        raise BadInput(f"--out {out}: the folder cannot be made ({error.strerror}). Name another with --out") from None
    return out


def frames_of(words, count):
    """ "all", "last", "7" or "0:100:10" as numbers of frames. @raises BadInput"""
    if words == "all":
        return None
    if words == "last":
        return [count - 1]
    try:
        parts = [int(part) if part else None for part in words.split(":")]
        numbers = list(range(count))[slice(*parts)] if len(parts) > 1 else [range(count)[parts[0]]]
    except (ValueError, IndexError):
        numbers = []
    if not numbers:
        raise BadInput(
            f"--frames {words}: the run has frames 0 to {count - 1}; write all, last, a number, or FROM:TO:STEP"
        )
    return numbers


def export_run(source, formats, folder, asked):
    """@return the files, the ones to open first in front"""
    import importlib

    from exports.files import Unwritable
    from exports.run import MissingDataset, NotARun, Run

    try:
        with Run(source) as run:
            if len(run) == 0:
                raise BadInput(f"{run.path}: has no whole frame")
            frames, made = frames_of(asked.frames, len(run)), []
            for name in formats:
                module, function = OF_RUNS[name].split(".")
                made += getattr(importlib.import_module(f"exports.{module}"), function)(run, folder(), frames)
            return list(dict.fromkeys(made))
    except MissingDataset as error:
        raise SystemExit(end(error, MISSING)) from None
    except NotARun as error:
        raise BadInput(str(error)) from None
    except Unwritable as error:
        end(error, MISSING)
        sys.stderr.flush()
        os._exit(MISSING)


def export_results(path, formats, out):
    import load

    try:
        results = load.load(path)
    except load.Unreadable as error:
        raise BadInput(str(error)) from None
    from exports import of_results

    try:
        return [file for name in formats for file in getattr(of_results, OF_RESULTS[name])(results, out)]
    except ImportError as error:
        raise SystemExit(
            end(f"Python's {error.name} is missing: install the Debian package python3-{error.name}", MISSING)
        ) from None


def tell(made, as_json):
    if as_json:
        print(
            json.dumps(
                {"files": [str(path) for path in made], "bytes": sum(path.stat().st_size for path in made)}, indent=1
            )
        )
        return
    groups = {}
    for path in made:
        groups.setdefault((path.parent, path.suffix), []).append(path)
    for (folder, suffix), paths in groups.items():
        size = sum(path.stat().st_size for path in paths)
        what = str(paths[0]) if len(paths) == 1 else f"{folder}/*{suffix} ({len(paths)} files)"
        print(f"{what}  {size / 1e6:.3g} MB")


def end(message, code):
    print(f"tripoint: {message}", file=sys.stderr)
    return code


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        sys.exit(main(sys.argv[1:]))
    except BrokenPipeError:
        sys.exit(end("what it printed could not be written (standard output is closed)", BAD_INPUT))
