# SPDX-License-Identifier: BSD-3-Clause
"""Writing whole files: under a temporary name, renamed when complete, removed when anything stops the writing."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path


class Unwritable(Exception):
    """An HDF5 file could not be written; the message is a sentence."""


@contextlib.contextmanager
def whole(path, mode="w"):
    """A file that is there complete or not at all, also after Ctrl-C and on a full disk."""
    path = Path(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with open(part, mode, **({} if "b" in mode else {"encoding": "utf-8", "newline": ""})) as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


@contextlib.contextmanager
def whole_hdf5(path):
    """The same for an HDF5 file. @raises Unwritable, after which the program must end at once: HDF5 would go on to
    complain of each block that it still holds"""
    import h5py

    path = Path(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        file = h5py.File(
            part, "w", driver="core", block_size=1 << 20
        )  # in memory until it is closed: HDF5 ignores a write that fails in between
        yield file
        file.close()
        part.replace(path)
    except (OSError, RuntimeError) as error:
        raise Unwritable(
            f"{path} could not be written "
            f"({'the disk is full' if 'No space left' in str(error) else 'no space left, or too large?'})"
        ) from error
    finally:
        part.unlink(missing_ok=True)


def digits(value):
    """The shortest text that reads back as the same double."""
    return repr(float(value))
