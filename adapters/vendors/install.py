# SPDX-License-Identifier: BSD-3-Clause
"""`tripoint engine install NAME[@VERSION] [--yes]`: one pinned engine into an environment of its own."""

from __future__ import annotations

import argparse
import fcntl
import json
import os
import subprocess
import sys
from pathlib import Path

from environments import STAMP, InstallError, Release, catalogue, home, release
from packages import INSTALLERS, PYTHON, say


def describe(wanted: Release) -> str:
    fetch = sum(file.size for file in wanted.files) / 1e6
    return (
        f"{wanted.title} {wanted.version}, licence {wanted.licence}: {fetch:.1f} MB to fetch from {wanted.registries}, "
        f"about {wanted.disk} MB on the disk, in {wanted.folder}"
    )


def ask(wanted: Release, yes: bool) -> None:
    """@raise InstallError unless somebody agreed"""
    say(describe(wanted))
    if yes:
        return
    if not sys.stdin.isatty():
        raise InstallError(
            f"nobody is here to ask; to agree:  tripoint engine install {wanted.engine}@{wanted.version} --yes"
        )
    print("Go on? [y/N] ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise InstallError("nothing was installed")


def write_executable(wanted: Release) -> None:
    """HOME/NAME-VERSION/engine-NAME: the adapter on this environment's Python, or on Debian's where the engine is no
    wheel."""
    python = '"$here/bin/python"' if wanted.registry == "PyPI" else PYTHON
    lines = [
        "#!/bin/sh",
        'here=$(dirname "$(readlink -f "$0")")',
        f'export TRIPOINT_ENGINE_FOLDER="$here" TRIPOINT_ENGINE_VERSION={wanted.version}',
        f'exec {python} -B "{wanted.adapter}" "$@"',
        "",
    ]
    wanted.executable.write_text("\n".join(lines), encoding="utf-8")
    wanted.executable.chmod(0o755)


def check_answer(wanted: Release) -> dict[str, object]:
    """Its --info. @raise InstallError where the engine does not start here, or is another version"""
    end = subprocess.run([str(wanted.executable), "--info"], capture_output=True, text=True, timeout=60.0, check=False)
    if end.returncode != 0:
        raise InstallError(f"{wanted.executable} --info failed:\n  {end.stderr.strip()[-400:]}", 4)
    info = json.loads(end.stdout)
    if info["version"] != wanted.version:
        raise InstallError(f"{wanted.executable} says version {info['version']}, installed was {wanted.version}", 4)
    return info


def point_to(wanted: Release) -> None:
    """From now on the plain name means this version."""
    link, part = home() / wanted.engine, home() / f".{wanted.engine}.part"
    part.unlink(missing_ok=True)
    part.symlink_to(wanted.folder.name)
    os.replace(part, link)


def install(wanted: Release, yes: bool, keep: bool) -> None:
    """@param keep the plain name goes on meaning what it means now"""
    if not wanted.installed:
        ask(wanted, yes)
        wanted.folder.mkdir(parents=True, exist_ok=True)
        INSTALLERS[wanted.registry](wanted, home() / "downloads")
        write_executable(wanted)
        info = check_answer(wanted)
        part = wanted.folder / (STAMP + ".part")
        done = {"name": wanted.engine, "version": wanted.version, "library": info["library"]}
        part.write_text(json.dumps(done, indent=1), encoding="utf-8")
        os.replace(part, wanted.folder / STAMP)
    write_executable(wanted)  # the adapter may have moved since
    if not (keep and (home() / wanted.engine).exists()):
        point_to(wanted)


def main(words: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="tripoint engine install", description=__doc__)
    parser.add_argument("engine", metavar="NAME[@VERSION]")
    parser.add_argument("--yes", action="store_true")
    parser.add_argument("--keep", action="store_true", help="the plain name goes on meaning what it means now")
    parser.add_argument("--versions", action="store_true", help="print the pinned versions and install nothing")
    given = parser.parse_args(words)
    try:
        if given.versions:
            print("\n".join(catalogue()["engines"][release(given.engine).engine]["versions"]))
            return 0
        wanted = release(given.engine)
        Path(home()).mkdir(parents=True, exist_ok=True)
        with open(home() / ".lock", "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)  # two installs at a time would share the downloads
            install(wanted, given.yes, given.keep)
    except InstallError as error:
        say(str(error))
        return error.code
    except OSError as error:
        say(f"{error.filename or home()}: {error.strerror}; another folder is taken from the variable TRIPOINT_ENGINES")
        return 4
    print(f"{wanted.executable}")
    say(f"next: tripoint validate {wanted.first} --engines {wanted.engine}")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        say("stopped; the same command goes on where it stopped")
        sys.exit(130)
