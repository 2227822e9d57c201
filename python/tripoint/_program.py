# SPDX-License-Identifier: BSD-3-Clause
"""Where the program is, and how it is called."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path


class ProgramError(RuntimeError):
    """The program ended with an error. `code` is its exit code (2 bad input, 4 missing, 7 diverged, 130 Ctrl-C); the
    message is what it said."""

    def __init__(self, code, message):
        super().__init__(message or f"tripoint ended with exit code {code}")
        self.code = code


def program():
    """The program's path: TRIPOINT_PROGRAM, then the one inside this package, then the one on PATH. @raises
    FileNotFoundError"""
    inside = Path(__file__).resolve().parent / "program" / "bin" / "tripoint"
    named = os.environ.get("TRIPOINT_PROGRAM")
    found = named or (str(inside) if inside.is_file() else shutil.which("tripoint"))
    if not found or not Path(found).is_file():
        raise FileNotFoundError(
            f"no program {named}"
            if named
            else "no program tripoint: install a wheel that has it inside, put it on PATH, or name it by "
            "TRIPOINT_PROGRAM"
        )
    return Path(found)


def share():
    """The folder of cases and reports that belongs to the program."""
    at = program().resolve().parent
    for folder in (at, *at.parents[:3]):
        if (folder / "share" / "tripoint").is_dir():
            return folder / "share" / "tripoint"
    raise FileNotFoundError(f"{program()} has no share/tripoint beside it")


def environment():
    """The reports are drawn by this very Python."""
    return {"TRIPOINT_PYTHON": sys.executable, **os.environ}


def call(words, quiet=True, good=(0,)):
    """Runs the program. @return its result (stdout). @raises ProgramError for an exit code that is not good"""
    done = subprocess.run(
        [str(program()), *map(str, words)],
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if quiet else None,
        text=True,
        check=False,
    )
    if done.returncode not in good:
        raise ProgramError(done.returncode, (done.stderr or "").strip())
    return done.stdout


def words_of(options):
    """until="1 s", threads=2, set={"scene.spacing": "1 mm"}, no_report=True as the program's options."""
    words = []
    for name, value in options.items():
        option = "--" + name.rstrip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(option)
        elif isinstance(value, dict):
            for key, inner in value.items():
                words += [option, f"{key}={inner}"]
        elif name == "set":
            for pair in value:
                words += [option, str(pair)]
        elif isinstance(value, (list, tuple)):
            words += [option, ",".join(map(str, value))]
        else:
            words += [option, str(value)]
    return words


def main():
    """The console script: this process becomes the program."""
    os.environ.setdefault("TRIPOINT_PYTHON", sys.executable)
    path = str(program())
    os.execv(path, [path, *sys.argv[1:]])
