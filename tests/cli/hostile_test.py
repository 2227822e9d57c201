# SPDX-License-Identifier: BSD-3-Clause
"""Hostile engines and hostile case files against the whole program: none passes, none harms the host, each stays in
bounds of time and memory.

    hostile_test.py TRIPOINT PAGE           compares with the tables on tests/cli/hostile/tables.md; seconds and memory
    are held to bounds alone
    hostile_test.py TRIPOINT PAGE --write   writes those tables anew

Time is the processor's of all that ran, memory that of the largest process. We take in every orphan (as a child
subreaper): what an engine leaves alive would be ours."""

import ctypes
import json
import os
import re
import resource
import socket
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from hostile import cases, engines

TRIPOINT, PAGE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
PR_SET_CHILD_SUBREAPER = 36
TIME_LIMIT = 5.0  # [s] of one run of an engine
FORGED = re.compile(r"^(::|verdict PASS|file\.toml)", re.M)
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")


@dataclass
class End:
    code: int
    cpu: float  # [s]
    wall: float  # [s]
    peak: float  # [MB]
    out: str
    err: str


def run(words, folder, memory=None, limit=120.0):
    """A program to its end. @param memory bound of its address space [bytes]"""

    def bounds():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    start = time.monotonic()
    with (folder / "out.txt").open("w+b") as out, (folder / "err.txt").open("w+b") as err:
        child = subprocess.Popen(
            [str(w) for w in words],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            preexec_fn=bounds,
            env={**os.environ, "SOME_TOKEN": "secret"},
        )
        while True:
            pid, status, use = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > limit:
                child.kill()
                limit = float("inf")
            time.sleep(0.005)
        child.returncode = os.waitstatus_to_exitcode(status)  # it is waited for
    texts = [(folder / name).read_bytes().decode("utf-8", "replace") for name in ("out.txt", "err.txt")]
    if limit == float("inf"):
        texts[1] += "\nhangs"
    return End(child.returncode, use.ru_utime + use.ru_stime, time.monotonic() - start, use.ru_maxrss / 1024, *texts)


def left_alive():
    """Whether a process that an engine started lives on: it would be our child by now."""
    for _ in range(200):
        try:
            if os.waitpid(-1, os.WNOHANG)[0] == 0:
                time.sleep(0.02)
        except ChildProcessError:
            return False
    return True


def faults_of(end, longest):
    """What is wrong with any end."""
    said = end.out + end.err
    yield from (["it hung"] if end.err.endswith("\nhangs") else [])
    yield from ([f"ended by signal {-end.code}"] if end.code < 0 else [])
    yield from ([f"passed:\n{said}"] if end.code == 0 else [])
    yield from ([f"a line is forged:\n{said}"] if FORGED.search(said) else [])
    yield from ([f"control characters:\n{said!r}"] if CONTROL.search(said) else [])
    yield from ([f"took {end.cpu:.1f} s of the processor"] if end.cpu > longest else [])


class Engine:
    """One hostile engine beside an honest one."""

    def __init__(self, hostile, sandbox):
        self.faults = []
        with tempfile.TemporaryDirectory() as place, socket.socket() as door:
            place = Path(place).resolve()
            for name in ("mine", "engine", "cases", "work"):
                (place / name).mkdir()
            for name in ("secret", "victim"):
                (place / "mine" / name).write_text("precious")
            door.bind(("127.0.0.1", 0))
            door.listen(8)
            door.settimeout(0.0)
            engine = engines.make(place / "engine", hostile, place / "mine", door.getsockname()[1])
            case = place / "cases" / "flight.toml"
            case.write_text((engines.FAKE / "flight.toml").read_text() + "[engines.evil]\nrequired = true\n")
            words = [
                TRIPOINT,
                "validate",
                case,
                "--engine",
                engine,
                "--engines",
                "evil,exact",
                "--out",
                place / "work/out",
                "--no-history",
                "--time-limit",
                TIME_LIMIT,
            ]
            self.end = run(words + ["--sandbox"] * sandbox + ["--no-report"] * (not hostile.page), place / "work")
            self.said = self.suite_said(place / "work/out/results.json")
            self.faults += faults_of(self.end, 60.0)
            self.faults += ["it left processes alive"] if left_alive() else []
            self.faults += (
                [f"the host was harmed: {sorted(p.name for p in (place / 'mine').iterdir())}"]
                if self.harmed(place)
                else []
            )
            self.faults += ["it called out"] if self.called(door) else []
            self.faults += [f"an engine took {self.end.peak:.0f} MB"] if self.end.peak > 2048 else []
            pages = [
                path.read_text(errors="replace")
                for path in sorted((place / "work/out").glob("*.html")) + sorted((place / "work/out").glob("*.md"))
            ]
            self.faults += ["its markup is in the report"] if any("<script>alert(1)" in text for text in pages) else []
            self.faults += ["no report was drawn"] if hostile.page and not pages else []

    @staticmethod
    def harmed(place):
        files = {path.name: path.read_text() for path in (place / "mine").iterdir()}
        return files != {"secret": "precious", "victim": "precious"} or sorted(
            path.name for path in place.iterdir()
        ) != ["cases", "engine", "mine", "work"]

    @staticmethod
    def called(door):
        try:
            door.accept()
        except BlockingIOError:
            return False
        return True

    def suite_said(self, path):
        """Status and reason of the engine's row, on one short line."""
        if not path.exists():
            return self.end.err.strip().split("\n")[-1]
        for engine in json.loads(path.read_text())["cases"][0]["engines"]:
            if engine["name"] != "exact":
                if "escaped" in json.dumps(engine) or "exited with code 8" in engine["reason"]:
                    self.faults.append(f"it escaped: {engine}")
                return f"{engine['status']}: {engine['reason']}"
        return self.end.err.strip().split("\n")[-1]


class CaseFile:
    """One hostile case file, looked at and run."""

    def __init__(self, hostile):
        with tempfile.TemporaryDirectory() as place:
            place = Path(place).resolve()
            path = hostile.make(place)
            self.check = run([TRIPOINT, "check", path], place, memory=4 << 30)
            self.faults = [f"check {fault}" for fault in faults_of(self.check, 10.0)]
            self.faults += [f"check exits {self.check.code}"] if self.check.code not in (0, 2) else []
            judged = run(
                [
                    TRIPOINT,
                    "validate",
                    path,
                    "--engines",
                    "exact",
                    "--out",
                    place / "out",
                    "--no-report",
                    "--no-history",
                ],
                place,
                memory=4 << 30,
            )
            self.faults += [f"validate {fault}" for fault in faults_of(judged, 10.0)]
            self.faults += [f"validate exits {judged.code}: {judged.err}"] if judged.code != 2 else []
            self.faults += [f"took {self.check.peak:.0f} MB"] if max(self.check.peak, judged.peak) > 1024 else []
            self.faults += ["says nothing"] if len(self.check.err + self.check.out) < 20 else []
            said = self.check.err.strip().replace(str(place) + "/", "")
            self.said = re.sub(r"^[^ ]*: (error: )?", "", said.split("\n")[0])
            self.faults += [f"quotes a file of others: {said}"] if "root:" in said else []


def short(text, most=110):
    """On one line of a table."""
    text = re.sub(r"/proc/\d+", "/proc/self", text)
    text = (
        re.sub(r"/tmp/[\w/.-]*", "...", re.sub(r"[\s\x00-\x1f\x7f]+", " ", text))
        .replace("|", "/")
        .replace("<", "&lt;")
        .replace("`", "'")
    )
    return text if len(text) <= most else text[: most - 3] + "..."


def cost(end):
    return f"{end.cpu:.1f} | {max(1, round(end.peak))}"


def engine_rows(sandbox_works):
    faults = []
    for hostile in engines.HOSTILE:
        inside = Engine(hostile, True) if sandbox_works else None
        outside = None if hostile.needs else Engine(hostile, False)
        for where, one in (("inside", inside), ("outside", outside)):
            faults += [f"{hostile.name} ({where}): {fault}" for fault in one.faults] if one else []
        told = inside or outside
        row = (
            f"| {short(hostile.name)} | {inside.end.code if inside else '-'} | "
            f"{cost(inside.end) if inside else '- | -'} | {outside.end.code if outside else '-'} |"
        )
        yield row + f" {cost(outside.end) if outside else '- | -'} | {short(told.said) if told else ''} |", faults
        faults = []


def case_rows():
    for hostile in cases.HOSTILE:
        one = CaseFile(hostile)
        yield (
            f"| {short(hostile.name, 60)} | {one.check.code} | {one.check.cpu:.2f} | {max(1, round(one.check.peak))} "
            f"| {short(one.said)} |",
            [f"{hostile.name}: {fault}" for fault in one.faults],
        )


def between(name, page):
    begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
    return page.index(begin) + len(begin), page.index(end)


def names_and_codes(rows, columns):
    return [tuple(row.split("|")[k].strip() for k in columns) for row in rows]


def main():
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    bare = ["/usr/bin/bwrap", "--unshare-all", "--unshare-user", "--ro-bind", "/", "/", "/bin/true"]
    sandbox_works = os.path.exists(bare[0]) and subprocess.run(bare, capture_output=True, check=False).returncode == 0
    page = PAGE.read_text()
    faults = []
    for name, rows, columns in (
        ("engines", engine_rows(sandbox_works), (1, 2, 5) if sandbox_works else (1, 5)),
        ("cases", case_rows(), (1, 2)),
    ):
        made = []
        for row, wrong in rows:
            print(row, flush=True)
            for fault in wrong:
                print(f"  FAULT {fault}", flush=True)
            made.append(row)
            faults += wrong
        begin, end = between(name, page)
        head, kept = page[begin:end].split("\n")[:2], page[begin:end].strip().split("\n")[2:]
        if "--write" in sys.argv:
            page = page[:begin] + "\n".join(head + made) + "\n" + page[end:]
        elif names_and_codes(kept, columns) != names_and_codes(made, columns):
            faults.append(f"the page's table of {name} says otherwise: --write writes it anew")
    if "--write" in sys.argv:
        PAGE.write_text(page)
    print(
        f"{len(engines.HOSTILE)} engines, {len(cases.HOSTILE)} case files, {len(faults)} faults"
        + ("" if sandbox_works else "; no sandbox here")
    )
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
