# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint import MODEL.xml [--out CASE.toml]`: a model in MJCF or URDF as a case file. MuJoCo's own parser reads it,
in the environment of the engine mujoco."""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from environments import home

INSIDE = "TRIPOINT_IMPORT_INSIDE"  # set once the environment's Python runs this file


def say(line: str) -> None:
    print(f"import: {line}", file=sys.stderr, flush=True)


def enter_environment() -> None:
    """Goes on in the engine's environment. @return only where this is it"""
    if os.environ.get(INSIDE):
        return
    python = home() / "mujoco" / "bin" / "python"
    if not os.access(python, os.X_OK):
        say("MJCF and URDF are read by MuJoCo's own parser, which is not installed here:")
        say("  tripoint engine install mujoco")
        sys.exit(4)
    os.environ[INSIDE] = "1"
    os.execv(python, [str(python), "-B", __file__, *sys.argv[1:]])


def findings(program: str, folder: Path, stem: str) -> list[str]:
    """What `tripoint check` says of the case, without its place."""
    end = subprocess.run(
        [program, "check", f"{stem}.toml"], cwd=folder, capture_output=True, text=True, timeout=600, check=False
    )
    lines = re.sub(rf"{re.escape(stem)}\.toml:[\d:]* ?", "", end.stderr).splitlines()
    return [line for line in lines if not line.startswith("note:")]


def written(model, given: argparse.Namespace, folder: Path, stem: str) -> list[str]:
    """Writes the case, without moments that the particles of a body cannot carry. @return notes"""
    from imported_case import Choices, case_text

    alone: set[str] = set()
    while True:
        choices = Choices(given.end, given.spacing, frozenset(alone))
        text, files, notes = case_text(model, Path(given.model).name, stem, choices)
        for name, content in {**files, f"{stem}.toml": text}.items():
            (folder / name).write_text(content, encoding="utf-8")
        said = findings(given.program, folder, stem) if given.program else []
        found = (re.search(r'body "([^"]*)": its \d+ particles cannot carry', line) for line in said)
        heavy = {match.group(1) for match in found if match} - alone
        if not heavy:
            lost = [f"body {name}: its shape cannot have the given moments: those of the shape stand" for name in alone]
            return notes + lost + [f"check: {line}" for line in said]
        alone |= heavy


def moved(folder: Path, target: Path) -> None:
    """Nothing that exists is written over. @raise FileExistsError"""
    for name in sorted(os.listdir(folder)):
        with open(target.parent / name, "x", encoding="utf-8") as out:
            out.write((folder / name).read_text(encoding="utf-8"))


def run(given: argparse.Namespace) -> int:
    from imported_model import Unreadable, read_model

    source = Path(given.model)
    target = Path(given.out or f"{source.stem}.toml")
    target = target if target.suffix == ".toml" else Path(f"{target}.toml")
    try:
        if not source.is_file():
            raise Unreadable("there is no such file")
        if target.exists():
            raise Unreadable(f"{target} exists already, and is left as it is: choose another name by --out")
        model = read_model(source, given.key, given.base, given.joints)
        if not model.links:
            raise Unreadable("it has no body with a shape")
        with tempfile.TemporaryDirectory() as folder:
            notes = written(model, given, Path(folder), target.stem)
            moved(Path(folder), target)
    except Unreadable as error:
        say(f"{source}: {error}")
        return 2
    except OSError as error:
        say(f"{error.filename}: {error.strerror}")
        return 2
    free = sum(link.free for link in model.links)
    print(f"wrote {target}: {free} free and {len(model.links) - free} fixed bodies, {len(model.joints)} joints")
    for line in model.left_out:
        print(f"left out: {line}")
    for line in model.notes + notes:
        print(f"note: {line}")
    say(f"next: tripoint run {target} --engine mujoco")
    return 0


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="tripoint import", description=__doc__)
    parser.add_argument("model", metavar="MODEL.xml")
    parser.add_argument("--out", default="")
    parser.add_argument("--end", type=float, default=1.0)
    parser.add_argument("--spacing", type=float, default=0.0)
    parser.add_argument("--key", default="")
    parser.add_argument("--base", choices=("", "free", "fixed"), default="")
    parser.add_argument("--joints", choices=("keep", "free", "lock"), default="keep")
    parser.add_argument("--program", default="")
    given = parser.parse_args(words)
    enter_environment()
    return run(given)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
