#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Carries out the instructions of the Dockerfile in bare Debian roots by mmdebstrap and chroot, and runs a gate in the
last one.

    image_root.py [--keep DIR] [--profile NAME]     as root; --keep leaves the image's root in DIR, --profile runs the
    suite's profile in it too

It knows ARG, FROM, RUN (with a cache mount), COPY (with --from), WORKDIR, ENV and CMD in the forms that the file uses,
and refuses any other. What a root lacks to reach this machine's registries (hosts, certificates, proxies, pip settings)
is given to it as tools/test-fresh.sh does, and counts as the machine's, not the image's; so does CI, with which
warnings are errors."""

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
RELEASES = {"debian:12": "bookworm"}
CERTIFICATE = "usr/local/share/ca-certificates/outer.crt"


def say(text):
    print(f"image: {text}", file=sys.stderr, flush=True)


def instructions(path):
    """(word, rest) of each instruction; a backslash at the end goes on."""
    text = re.sub(r"\\\n\s*", " ", path.read_text())
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            word, rest = line.split(None, 1)
            yield word.upper(), rest.strip()


class Root:
    """One stage: a bare Debian with what its instructions have made of it."""

    def __init__(self, folder, image):
        if image not in RELEASES:
            raise SystemExit(f"image: FROM {image}: only {', '.join(RELEASES)} can be made here")
        self.folder, self.workdir, self.extra, self.command = folder, "/", {}, []
        self.environment = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}
        options = [f"--aptopt={line}" for line in self.apt_settings()]
        subprocess.run(
            ["mmdebstrap", "--quiet", "--variant=minbase", *options, RELEASES[image], str(folder), *self.sources()],
            check=True,
            stdout=sys.stderr,
        )
        self.furnish()

    @staticmethod
    def apt_settings():
        answer = subprocess.run(["apt-config", "dump"], capture_output=True, text=True).stdout
        return [line for line in answer.splitlines() if re.match(r"Acquire::(https?|Retries|Check-)", line)]

    @staticmethod
    def sources():
        """This machine's where it is a Debian 12 too; else Debian's own."""
        if "VERSION_CODENAME=bookworm" not in Path("/etc/os-release").read_text():
            return []
        files = [Path("/etc/apt/sources.list"), *Path("/etc/apt/sources.list.d").glob("*")]
        return [
            str(f)
            for f in files
            if f.is_file()
            and "bookworm" in f.read_text()
            and re.search(r"debian-archive-keyring|^deb .*/debian", f.read_text(), re.M)
        ]

    def furnish(self):
        (self.folder / "etc/hosts").write_text("127.0.0.1 localhost\n::1 localhost\n")
        bundle = Path(os.environ.get("SSL_CERT_FILE", "/etc/ssl/certs/ca-certificates.crt"))
        if bundle.is_file():
            (self.folder / CERTIFICATE).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(bundle, self.folder / CERTIFICATE)
        for kind, place in (("proc", "proc"), ("sysfs", "sys"), ("tmpfs", "dev")):
            subprocess.run(["mount", "-t", kind, kind, str(self.folder / place)], check=True)
        for name, minor in (("null", 3), ("zero", 5), ("full", 7), ("random", 8), ("urandom", 9)):
            subprocess.run(["mknod", "-m", "666", str(self.folder / "dev" / name), "c", "1", str(minor)], check=True)
        (self.folder / "dev/fd").symlink_to("/proc/self/fd")
        (self.folder / "dev/shm").mkdir(mode=0o1777)

    def run(self, words, network=True):
        """A process in the root, with the image's environment. @return seconds"""
        machine = {name: value for name, value in os.environ.items() if re.fullmatch(r"(?i)(https?|no)_proxy|CI", name)}
        environment = {
            "HOME": "/root",
            "LANG": "C.UTF-8",
            "DEBIAN_FRONTEND": "noninteractive",
            **(machine if network else {}),
            **self.environment,
            **self.extra,
        }
        words = [
            "chroot",
            str(self.folder),
            "/usr/bin/env",
            "-i",
            *(f"{k}={v}" for k, v in environment.items()),
            "sh",
            "-c",
            f'cd {shlex.quote(self.workdir)} && exec "$@"',
            "_",
            *words,
        ]
        begin = time.monotonic()
        subprocess.run(words if network else ["unshare", "--net", *words], check=True, stdin=subprocess.DEVNULL)
        return time.monotonic() - begin

    def bind(self, outer, inner):
        (self.folder / inner.lstrip("/")).mkdir(parents=True, exist_ok=True)
        subprocess.run(["mount", "--bind", str(outer), str(self.folder / inner.lstrip("/"))], check=True)

    def release(self, inner):
        subprocess.run(["umount", str(self.folder / inner.lstrip("/"))], check=True)


class Image:
    def __init__(self, folder, cache):
        self.folder, self.cache, self.stages, self.root = folder, cache, {}, None
        self.arguments = {}  # by name: as the file gives them

    def make(self):
        for word, rest in instructions(SOURCE / "Dockerfile"):
            begin = time.monotonic()
            say(f"{word} {rest}")
            getattr(self, f"do_{word.lower()}", self.refuse)(rest)
            say(f"  {time.monotonic() - begin:.0f} s")
        return self.root

    def refuse(self, rest):
        raise SystemExit(f"image: this instruction of the Dockerfile is not known here: {rest}")

    def do_arg(self, rest):
        name, _, value = rest.partition("=")
        if self.root:  # of a stage: its instructions see it
            self.root.environment[name] = value
        else:
            self.arguments[name] = value

    def do_from(self, rest):
        rest = re.sub(r"\$\{(\w+)\}", lambda found: self.arguments[found[1]], rest)
        image, *name = re.fullmatch(r"(\S+)(?: AS (\S+))?", rest).groups()
        self.root = Root(self.folder / f"stage{len(self.stages)}", image)
        self.stages[name[0] or str(len(self.stages))] = self.root

    def do_run(self, rest):
        mounts = re.findall(r"--mount=type=cache,target=(\S+)", rest)
        for target in mounts:
            self.root.bind(self.cache, target)
            self.root.extra = {
                "CCACHE_BASEDIR": self.root.workdir,
                "CCACHE_NOHASHDIR": "1",
            }  # hits of a checkout in another folder
        self.root.run(["sh", "-c", re.sub(r"--mount=\S+\s+", "", rest)])
        for target in mounts:
            self.root.release(target)
        self.root.extra = {}

    def do_copy(self, rest):
        stage = re.match(r"--from=(\S+)\s+", rest)
        sources, target = (words := rest[stage.end() :].split() if stage else rest.split())[:-1], words[-1]
        to = self.root.folder / target.lstrip("/")
        if target.endswith("/"):
            to.mkdir(parents=True, exist_ok=True)
        for source in sources:
            if stage:
                self.copy(self.stages[stage[1]].folder / source.lstrip("/"), to)
            elif source == ".":
                self.copy_checkout(to)
            else:
                self.copy(SOURCE / source, to)

    @staticmethod
    def copy(source, to):
        if source.is_dir():
            shutil.copytree(source, to, symlinks=True, dirs_exist_ok=True)
        else:
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, to)

    @staticmethod
    def copy_checkout(to):
        """The committed checkout: what a clone of it would send to Docker."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["git", "clone", "--quiet", "--no-hardlinks", str(SOURCE), f"{folder}/clone"], check=True)
            shutil.copytree(f"{folder}/clone", to, symlinks=True, dirs_exist_ok=True)

    def do_workdir(self, rest):
        self.root.workdir = rest
        (self.root.folder / rest.lstrip("/")).mkdir(parents=True, exist_ok=True)

    def do_env(self, rest):
        name, value = rest.split("=", 1)
        self.root.environment[name] = value

    def do_cmd(self, rest):
        self.root.command = re.findall(r'"([^"]*)"', rest)


def compiler_cache():
    """This machine's: what has been compiled here once is not compiled again, which only shortens the build."""
    answer = (
        subprocess.run(["ccache", "--get-config", "cache_dir"], capture_output=True, text=True).stdout
        if shutil.which("ccache")
        else ""
    )
    return Path(answer.strip() or tempfile.gettempdir() + "/tripoint-image-ccache")


def size_of(folder):
    """Megabytes of the files in the root, without what is mounted there."""
    answer = subprocess.run(
        ["du", "--summarize", "--one-file-system", "--block-size=1000000", str(folder)], capture_output=True, text=True
    ).stdout
    return int(answer.split()[0])


def gate_in(root):
    """What a project's job does in the image: its cases on its engine, without network; then with a defect, which must
    be red."""
    project = root.folder / "project"
    shutil.copytree(SOURCE / "examples" / "gated-engine", project)
    root.workdir = "/project"
    validate = ["tripoint", "validate", "cases", "--engines", "./engine-verlet"]
    seconds = (
        root.run(validate, network=False)
        + root.run(["tripoint", "gate", "report"], network=False)
        + root.run(["tripoint", "summary", "report", "--markdown"], network=False)
    )
    if not (project / "report/index.html").is_file():
        raise SystemExit("image: the report's page is missing")
    engine = project / "engine-verlet"
    engine.write_text(engine.read_text().replace("HALF = 0.5 ", "HALF = 0.51 "))
    try:
        root.run(validate, network=False)
    except subprocess.CalledProcessError as red:
        if red.returncode == 1:
            return seconds
    raise SystemExit("image: the gate is not red for an engine with half of g t^2 off by 2 %")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--keep", type=Path, help="folder that the image's root is moved to")
    parser.add_argument("--profile", help="a profile of the suite that is run in the image as well")
    options = parser.parse_args()
    if os.geteuid() != 0:
        raise SystemExit("image: needs root: sudo make test-image")
    if not shutil.which("mmdebstrap"):
        raise SystemExit("image: needs mmdebstrap: apt-get install --no-install-recommends mmdebstrap")
    if (
        "TRIPOINT_IMAGE" not in os.environ
    ):  # in namespaces of its own nothing stays mounted or running, however this ends
        os.execvpe(
            "unshare",
            ["unshare", "--mount", "--pid", "--fork", "--kill-child", sys.executable, *sys.argv],
            {**os.environ, "TRIPOINT_IMAGE": "1"},
        )
    cache = compiler_cache()
    cache.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp(prefix="tripoint-image-"))
    begin = time.monotonic()
    try:
        root = Image(folder, cache).make()
        say(f"built in {time.monotonic() - begin:.0f} s; {size_of(root.folder)} MB on the disk")
        say(f"its command: {' '.join(root.command)}")
        root.run(root.command)
        say(f"PASS: a gate in it took {gate_in(root):.1f} s")
        if options.profile:
            seconds = root.run(
                ["tripoint", "validate", "--profile", options.profile, "--jobs", "2", "--out", "suite"], network=False
            )
            say(f"PASS: its profile {options.profile} took {seconds:.0f} s")
        for place in ("proc", "sys", "dev"):
            subprocess.run(["umount", "--recursive", str(root.folder / place)], check=True)
        if options.keep:
            shutil.move(str(root.folder), options.keep)
    finally:
        for mount in reversed(Path("/proc/mounts").read_text().splitlines()):
            if str(folder) in mount:
                subprocess.run(["umount", "--lazy", mount.split()[1]], check=False)
        subprocess.run(["rm", "-rf", "--one-file-system", str(folder)], check=False)


if __name__ == "__main__":
    main()
