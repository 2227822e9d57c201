# SPDX-License-Identifier: BSD-3-Clause
"""Fetches pinned packages with each registry's own client, checks their SHA-256, and unpacks them into an environment.

A file that is there and whole is not fetched again, so that an install that was stopped goes on."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tarfile
import urllib.parse
from collections.abc import Callable
from pathlib import Path

from environments import ADAPTERS, File, InstallError, Release

PYTHON = "/usr/bin/python3"
FETCH_LIMIT = 900.0  # [s]
BUILD_LIMIT = 3600.0  # [s]


def say(line: str) -> None:
    print(f"install: {line}", file=sys.stderr, flush=True)


def call(words: list[str], folder: Path, limit: float = FETCH_LIMIT) -> None:
    """@raise InstallError with the client's own last words"""
    try:
        end = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=limit, check=False)
    except FileNotFoundError as error:
        raise InstallError(f"{words[0]} is not installed here, and it is what fetches this engine", 4) from error
    except subprocess.TimeoutExpired as error:
        raise InstallError(
            f"{' '.join(words[:3])} took more than {limit:g} s; the same command goes on where it stopped", 4
        ) from error
    if end.returncode != 0:
        last = "\n  ".join((end.stderr or end.stdout).strip().splitlines()[-4:])
        raise InstallError(
            f"{' '.join(words[:3])} failed; the same command goes on where it stopped. It said:\n  {last}", 4
        )


def is_whole(path: Path, file: File) -> bool:
    if not path.is_file() or path.stat().st_size != file.size:
        return False
    return hashlib.sha256(path.read_bytes()).hexdigest() == file.sha256


def file_of(folder: Path, file: File) -> Path | None:
    """The pinned file, whatever name its registry gave it."""
    return next((path for path in sorted(folder.iterdir()) if is_whole(path, file)), None)


def fetched(file: File, downloads: Path, fetch: Callable[[File, Path], None]) -> Path:
    """@raise InstallError where the registry now holds other bytes under that name"""
    folder = downloads / urllib.parse.quote(file.name, safe="")
    folder.mkdir(parents=True, exist_ok=True)
    whole = file_of(folder, file)
    if whole:
        say(f"{file.name}: here already")
        return whole
    for left in folder.iterdir():
        left.unlink()
    say(f"{file.name}: {file.size / 1e6:.1f} MB")
    fetch(file, folder)
    whole = file_of(folder, file)
    if whole is None:
        there = ", ".join(path.name for path in folder.iterdir()) or "nothing"
        raise InstallError(
            f"{file.name}: what came ({there}) has not the pinned hash {file.sha256[:16]}...; it is not used", 4
        )
    return whole


def install_wheels(release: Release, downloads: Path) -> None:
    folder = release.folder
    if not (folder / "bin" / "pip").exists():
        call([PYTHON, "-m", "venv", str(folder)], folder.parent)
    pip = str(folder / "bin" / "pip")

    def fetch(file: File, to: Path) -> None:
        pins = to / "pin.txt"
        pins.write_text(f"{file.name} --hash=sha256:{file.sha256}\n", encoding="ascii")
        call(
            [
                pip,
                "download",
                "--quiet",
                "--no-deps",
                "--require-hashes",
                "--only-binary",
                ":all:",
                "--retries",
                "2",
                "--timeout",
                "30",
                "--dest",
                str(to),
                "--requirement",
                str(pins),
            ],
            to,
        )

    unpack_debian(release, downloads, tuple(file for file in release.files if "==" not in file.name))
    wheels = [fetched(file, downloads, fetch) for file in release.files if "==" in file.name]
    call([pip, "install", "--quiet", "--no-deps", "--no-index", *map(str, wheels)], folder)


def unpack_debian(release: Release, downloads: Path, files: tuple[File, ...]) -> None:
    """Unpacks Debian's packages into the environment: nothing of the system is changed, and no root is needed."""

    def fetch(file: File, to: Path) -> None:
        call(["apt-get", "download", "--quiet", file.name], to)

    for file in files:
        call(["dpkg-deb", "--extract", str(fetched(file, downloads, fetch)), str(release.folder)], release.folder)


def install_debian(release: Release, downloads: Path) -> None:
    unpack_debian(release, downloads, release.files)


def install_npm(release: Release, downloads: Path) -> None:
    def fetch(file: File, to: Path) -> None:
        call(["npm", "pack", "--silent", "--ignore-scripts", file.name], to)

    for file in release.files:
        unpack(fetched(file, downloads, fetch), release.folder / "node_modules" / file.name.rpartition("@")[0])


def unpack(archive: Path, folder: Path) -> None:
    """The plain files of an npm package. @raise InstallError for a name that leads out of the folder"""
    with tarfile.open(archive) as members:
        for member in members.getmembers():
            inside = Path(member.name.partition("/")[2])  # without the leading folder "package"
            if inside.is_absolute() or ".." in inside.parts:
                raise InstallError(
                    f"{archive.name}: {member.name} leads out of the package; nothing more of it is unpacked", 4
                )
            content = members.extractfile(member) if member.isfile() else None
            if content is None:
                continue
            (folder / inside).parent.mkdir(parents=True, exist_ok=True)
            (folder / inside).write_bytes(content.read())


def install_crates(release: Release, downloads: Path) -> None:
    """Builds an adapter's own small program on crates. Its Cargo.lock is the pin: cargo checks every crate by the hash
    that stands there."""
    (lock,) = release.files
    project = ADAPTERS / Path(lock.name).parent
    if hashlib.sha256((ADAPTERS / lock.name).read_bytes()).hexdigest() != lock.sha256:
        raise InstallError(f"{lock.name} has not the pinned hash {lock.sha256[:16]}...; it is not used", 4)
    target = downloads / f"{release.engine}-{release.version}"
    say("cargo fetches the crates and builds: two minutes of a processor")
    call(
        [
            "cargo",
            "build",
            "--quiet",
            "--release",
            "--locked",
            "--manifest-path",
            str(project / "Cargo.toml"),
            "--target-dir",
            str(target),
        ],
        project,
        BUILD_LIMIT,
    )
    (release.folder / "bin").mkdir(exist_ok=True)
    for built in (target / "release").iterdir():
        if built.is_file() and not built.suffix and not built.name.startswith("."):
            shutil.copy2(built, release.folder / "bin" / built.name)
    shutil.rmtree(target)


INSTALLERS = {"PyPI": install_wheels, "Debian": install_debian, "npm": install_npm, "crates.io": install_crates}
