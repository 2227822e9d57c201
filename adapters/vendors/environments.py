# SPDX-License-Identifier: BSD-3-Clause
"""Which engines can be installed, and where their environments are.

An environment is the folder HOME/NAME-VERSION with a file `installed.json`, which is written last; HOME/NAME points to
the version that the plain name means. HOME is $TRIPOINT_ENGINES, else `.venv-engines` of the checkout. Nothing else is
written to."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ADAPTERS = Path(__file__).resolve().parent
STAMP = "installed.json"


class InstallError(Exception):
    """What went wrong and what to do, for people; `code` is the exit code."""

    def __init__(self, message: str, code: int = 2) -> None:
        super().__init__(message)
        self.code = code


@dataclass(frozen=True)
class File:
    """One package of a registry, pinned."""

    # as its registry writes it: numpy==2.4.6, libode8=2:0.16.2-1, jolt-physics@1.1.0; of crates the file that pins them
    # all
    name: str
    sha256: str
    size: int  # [bytes]


@dataclass(frozen=True)
class Release:
    engine: str
    title: str
    version: str
    licence: str
    registry: str  # PyPI | Debian | npm | crates.io
    adapter: Path
    files: tuple[File, ...]
    first: str  # subject of the suite that it is tried on first
    disk: int  # what an installed environment took [MB]

    @property
    def folder(self) -> Path:
        return home() / f"{self.engine}-{self.version}"

    @property
    def registries(self) -> str:
        """All that files come from: its own first."""
        debian = any("==" not in file.name and "=" in file.name for file in self.files)
        return f"{self.registry} and Debian" if debian and self.registry != "Debian" else self.registry

    @property
    def executable(self) -> Path:
        return self.folder / f"engine-{self.engine}"

    @property
    def installed(self) -> bool:
        return (self.folder / STAMP).is_file() and os.access(self.executable, os.X_OK)


def home() -> Path:
    return Path(os.environ.get("TRIPOINT_ENGINES") or ADAPTERS.parent.parent / ".venv-engines").absolute()


def catalogue() -> dict[str, Any]:
    return json.loads((ADAPTERS / "catalogue.json").read_text(encoding="utf-8"))


def release(words: str) -> Release:
    """@param words NAME or NAME@VERSION. @raise InstallError naming what there is"""
    name, _, version = words.partition("@")
    known = catalogue()
    engine = known["engines"].get(name)
    if engine is None:
        raise InstallError(
            f"{name}: is no engine that can be installed; there are {', '.join(sorted(known['engines']))}"
        )
    version = version or engine["default"]
    pins = engine["versions"].get(version)
    if pins is None:
        raise InstallError(f"{name}@{version}: no such version is pinned; there are {', '.join(engine['versions'])}")
    files = tuple(File(pin, known["files"][pin]["sha256"], known["files"][pin]["bytes"]) for pin in pins)
    adapter = ADAPTERS / engine["adapter"]
    return Release(
        name,
        engine["title"],
        version,
        engine["licence"],
        engine["from"],
        adapter,
        files,
        engine.get("first", "rigid"),
        engine["disk_mb"],
    )
