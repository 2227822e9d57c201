# SPDX-License-Identifier: BSD-3-Clause
"""Builds the wheel: the Python package, and inside it what `cmake --install` installs of a build folder, with its
libraries.

The build folder is ../build, or TRIPOINT_BUILD. The libraries that Debian's packages bring go into program/lib, and
programs find them there by a relative path; those of the C library stay out. LAMMPS stays out too: its MPI looks for
its parts at fixed places. Its rows say "missing"."""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import tempfile
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LEFT_OUT = ("engine-lammps", "engine-lammps-wheel")
OF_THE_SYSTEM = re.compile(r"^(ld-linux|linux-vdso|lib(c|m|dl|pthread|rt|resolv|util)\.so)")
TIME = (1980, 1, 1, 0, 0, 0)  # the same bytes for the same files


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = Path(os.environ.get("TRIPOINT_BUILD") or HERE.parent / "build").resolve()
    if not (build / "bin" / "tripoint").is_file():
        raise SystemExit(f"{build} has no bin/tripoint: run `make build`, or name a build folder by TRIPOINT_BUILD")
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    version = re.search(r"project\(tripoint VERSION ([\d.]+)", (HERE.parent / "CMakeLists.txt").read_text())[1]
    name = f"tripoint-{version}-py3-none-{platform_tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        shutil.copytree(HERE / "tripoint", root / "tripoint", ignore=shutil.ignore_patterns("__pycache__"))
        pack_program(build, root / "tripoint" / "program")
        write_metadata(root / f"tripoint-{version}.dist-info", project, version)
        pack(root, Path(wheel_directory) / name)
    return name


def platform_tag():
    """Of the C library that it was built with: an older one lacks its symbols."""
    major, minor = os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")[:2]
    return f"manylinux_{major}_{minor}_{os.uname().machine}"


def pack_program(build, target):
    subprocess.run(
        ["cmake", "--install", str(build), "--prefix", str(target), "--strip"], check=True, stdout=subprocess.DEVNULL
    )
    for name in LEFT_OUT:
        (target / "libexec" / "tripoint" / name).unlink(missing_ok=True)
    shutil.rmtree(next(target.glob("lib*/cmake"), target / "none"), ignore_errors=True)
    shutil.rmtree(next(target.glob("lib/*/cmake"), target / "none"), ignore_errors=True)
    binaries = [
        path
        for path in target.rglob("*")
        if path.is_file() and not path.is_symlink() and path.read_bytes()[:4] == b"\x7fELF"
    ]
    libraries = {}
    for binary in binaries:
        libraries.update(needed_by(binary))
    store = target / "lib"
    store.mkdir(exist_ok=True)
    for soname, path in libraries.items():
        shutil.copy(Path(path).resolve(), store / soname)
        (store / soname).chmod(0o755)
    for binary in [*binaries, *(store / soname for soname in libraries)]:
        subprocess.run(
            ["patchelf", "--set-rpath", f"$ORIGIN/{os.path.relpath(store, binary.parent)}", str(binary)], check=True
        )


def needed_by(binary):
    """{soname: path} of all libraries that it loads. @raises SystemExit where one is missing"""
    found = {}
    for line in subprocess.run(["ldd", str(binary)], capture_output=True, text=True, check=True).stdout.splitlines():
        words = line.split()
        if "not found" in line:
            raise SystemExit(f"{binary}: {line.strip()}")
        if len(words) >= 3 and words[1] == "=>" and not OF_THE_SYSTEM.match(words[0]):
            found[words[0]] = words[2]
    return found


def write_metadata(folder, project, version):
    folder.mkdir()
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {version}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        f"License: {project['license']['text']}",
        *(f"Requires-Dist: {word}" for word in project["dependencies"]),
    ]
    (folder / "METADATA").write_text("\n".join(lines) + "\n")
    (folder / "WHEEL").write_text(
        f"Wheel-Version: 1.0\nGenerator: tripoint\nRoot-Is-Purelib: false\nTag: py3-none-{platform_tag()}\n"
    )
    (folder / "entry_points.txt").write_text(
        "[console_scripts]\n" + "".join(f"{name} = {where}\n" for name, where in project["scripts"].items())
    )
    shutil.copy(HERE.parent / "LICENSE", folder / "LICENSE")


def pack(root, wheel):
    """A zip with its list of hashes last."""
    record = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        files = sorted(path for path in root.rglob("*") if path.is_file())
        listing = next(path for path in root.iterdir() if path.name.endswith(".dist-info")).name + "/RECORD"
        for path in files:
            data, name = path.read_bytes(), path.relative_to(root).as_posix()
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr = (0o100755 if os.access(path, os.X_OK) else 0o100644) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{len(data)}")
        archive.writestr(zipfile.ZipInfo(listing, TIME), "\n".join([*record, f"{listing},,"]) + "\n")
