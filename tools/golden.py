#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether results have the same bits: as they were stored, at every vector width, on any number of threads, and by two
compilers at four optimisation levels.

    tools/golden.py --program build/tests/state-hashes                  # against tests/golden/hashes.toml, a test of
    every build (10 s)
    tools/golden.py --program build/tests/state-hashes --store REASON   # stores them anew: the results of a state were
    changed on purpose, and REASON says why
    tools/golden.py --builds FOLDER                                     # compiles what is missing there (half an hour
    on two cores), runs, compares with the same file

Runs `state-hashes` on twelve cases of the commit profile, in each mode that they have: a hash of all columns, bonds,
energy accounts and the order of rows after some steps. Exit 0: all equal; 1: some differ, and each is named; 2: nothing
was compared. 77: the stored hashes are not for this machine. The last digit of a sine is another in another C library,
and in the functions that this one has for processors without fused multiply-add (the last row of --builds shows it)."""

import argparse
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
CASES = (
    "fluid/dam-break-small",
    "fluid/rotating-bucket",
    "coupling/floating-block-050",
    "coupling/gum-ball",
    "solid/cantilever",
    "solid/plastic-sheet",
    "solid/tear-limit",
    "phase/melt-rigid",
    "phase/freeze-merge",
    "phase/split-by-melting",
    "heat/inflow",
    "rigid/merge-in-flight",
)
# name: compiler, CMake's build type, level. A Debug build has vector units at -O1 (cmake/tripoint.cmake says why), the
# others at -O3.
BUILDS = {
    "gcc-O0": ("g++", "Debug", "-O0"),
    "gcc-O2": ("g++", "Release", "-O2"),
    "gcc-O3": ("g++", "Release", "-O3"),
    "clang-O0": ("clang++", "Debug", "-O0"),
    "clang-O2": ("clang++", "Release", "-O2"),
    "clang-O3": ("clang++", "Release", "-O3"),
}
STORED = ROOT / "tests" / "golden" / "hashes.toml"
SKIPPED = 77
WITHOUT_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}


def compiler(name):
    """The newest installed program of that compiler, or nothing."""
    return next(
        (
            found
            for version in ("-16", "-15", "-14", "")
            if (found := shutil.which(name + (version if name == "clang++" else "")))
        ),
        None,
    )


def build(name, folder, jobs):
    """The program state-hashes of that build; nothing where the compiler is missing. @throws
    subprocess.CalledProcessError where it does not compile"""
    what, kind, level = BUILDS[name]
    path = compiler(what)
    if not path:
        return None
    tree = folder / name
    if not (tree / "build.ninja").exists():
        flags = f"-DCMAKE_CXX_FLAGS_{kind.upper()}={level}"
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(
            [
                "cmake",
                "-S",
                ROOT,
                "-B",
                tree,
                "-G",
                "Ninja",
                f"-DCMAKE_CXX_COMPILER={path}",
                f"-DCMAKE_BUILD_TYPE={kind}",
                flags,
                *launcher,
            ],
            check=True,
            stdout=subprocess.DEVNULL,
        )
    subprocess.run(["ninja", "-C", tree, "-j", str(jobs), "state-hashes"], check=True, stdout=sys.stderr)
    return tree / "tests" / "state-hashes"


def processor():
    """What this processor can, in the system's words."""
    lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").split("\n")
    return next((line for line in lines if line.startswith("flags")), "").split()


def widths():
    """Vector widths that this processor has."""
    flags = processor()
    return [1] + [lanes for lanes, flag in ((4, "avx2"), (8, "avx512dq")) if flag in flags]


def library():
    """The C library, on whose sines and powers the states stand."""
    try:
        return os.confstr("CS_GNU_LIBC_VERSION") or "another C library"
    except ValueError:
        return "another C library"


def why_not_here(stored):
    """Why the stored hashes say nothing of this machine; empty where they do."""
    if platform.machine() != "x86_64":
        return f"the hashes are for x86-64, and this is {platform.machine()}"
    if missing := {"fma", "avx2"} - set(processor()):
        return f"this processor has no {' and no '.join(sorted(missing))}, so that the C library takes other functions"
    if stored["library"] != library():
        return f"the hashes were stored with {stored['library']}, and this is {library()}"
    return ""


def hashes(program, steps, lanes, threads, environment=None):
    """{case and mode: steps that were made, and the hash}."""
    command = [program, "--steps", steps, "--lanes", lanes, "--threads", threads] + [
        ROOT / "cases" / f"{case}.toml" for case in CASES
    ]
    own = {name: value for name, value in os.environ.items() if name != "GLIBC_TUNABLES"}
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=True, env=own | (environment or {})
    )
    rows = [line.split(" ", 2) for line in done.stdout.strip().split("\n")]
    return {f"{case} {mode}": state for case, mode, state in rows}


def differences(found, truth):
    """One line a state that is not as it should be, by name."""
    missing = "not there"
    return [
        f"{state}: {found.get(state, missing)}, should be {truth.get(state, missing)}"
        for state in dict.fromkeys([*truth, *found])
        if found.get(state) != truth.get(state)
    ]


class Comparison:
    """Rows of a table, each compared with what is stored, or with the first."""

    def __init__(self, truth, steps):
        self.truth, self.steps, self.compared, self.different = truth, steps, 0, set()
        print(f"{'build':10}  {'lanes':>5}  {'threads':>7}  equal")

    def row(self, name, program, lanes, threads, environment=None, note=""):
        found = hashes(program, self.steps, lanes, threads, environment)
        self.truth = self.truth or found
        others = differences(found, self.truth)
        self.compared += 1
        if not note:
            self.different |= {line.split(":", 1)[0] for line in others}
        print(
            f"{name:10}  {lanes:5}  {threads:7}  {len(self.truth) - len(others)} of {len(self.truth)}{note}", flush=True
        )
        for line in others:
            print(f"            differs: {line}")

    def report(self):
        """The exit code, and what is to do."""
        if self.different:
            print(
                f"{len(self.different)} states have other bits: {', '.join(sorted(self.different))}. If that is "
                "meant, store them anew and say why: "
                "tools/golden.py --program build/tests/state-hashes --store REASON"
            )
        return 2 if self.compared == 0 else 1 if self.different else 0


def write(path, steps, truth, reason):
    lines = [
        "# SPDX-License-Identifier: BSD-3-Clause",
        "# A hash of each state after these steps, or fewer where the run ends before. Written by tools/golden.py "
        "--store; the test `golden` compares.",
        f"steps = {steps}",
        f"library = {json.dumps(library())}",
        f"reason = {json.dumps(reason, ensure_ascii=False)}",
        "",
        "[hashes]",
    ]
    path.write_text(
        "\n".join(lines + [f"{json.dumps(state)} = {json.dumps(hashes)}" for state, hashes in truth.items()]) + "\n",
        encoding="utf-8",
    )


def compare_program(program, path, steps, reason):
    """One program with what is stored, or what is to be stored."""
    stored = None if reason else tomllib.loads(path.read_text(encoding="utf-8"))
    if stored and (why := why_not_here(stored)):
        print(f"skipped: {why}")
        return SKIPPED
    comparison = Comparison(stored and stored["hashes"], stored["steps"] if stored else steps)
    for lanes in widths():
        comparison.row("program", program, lanes, 1)
    comparison.row("program", program, widths()[-1], 3)
    code = comparison.report()
    if reason and code == 0:
        write(path, steps, comparison.truth, reason)
        print(f"{path}: {len(comparison.truth)} states are stored: {reason}")
    return code


def compare_builds(names, folder, path, steps, jobs):
    """Every build with what is stored; where that is not for this machine, with the first of them."""
    stored = tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else None
    if stored and (stored["steps"] != steps or why_not_here(stored)):
        print(
            f"compared with one another: {why_not_here(stored) or 'the stored hashes are of another number of steps'}"
        )
        stored = None
    comparison = Comparison(stored and stored["hashes"], steps)
    program = None
    for name in names:
        found = build(name, folder, jobs)
        if not found:
            print(f"{name:10}  no such compiler here")
            continue
        program = found
        for lanes in widths():
            for threads in (1, 3):
                comparison.row(name, program, lanes, threads)
    if program:
        comparison.row("no FMA", program, 1, 1, WITHOUT_FMA, "  (the C library's other functions; not promised)")
    return comparison.report()


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--program", type=pathlib.Path, metavar="STATE-HASHES")
    p.add_argument("--store", metavar="REASON")
    p.add_argument("--hashes", type=pathlib.Path, default=STORED, metavar="FILE")
    p.add_argument("--builds", type=pathlib.Path, metavar="FOLDER")
    p.add_argument("--only", default=",".join(BUILDS), help="builds, by name: " + ", ".join(BUILDS))
    p.add_argument("--steps", type=int, default=200)
    p.add_argument("--jobs", type=int, default=2)
    options = p.parse_args()
    if unknown := set(options.only.split(",")) - set(BUILDS):
        p.error(f"no build is called {', '.join(sorted(unknown))}: there are {', '.join(BUILDS)}")
    if bool(options.program) == bool(options.builds):
        p.error("give --program, or --builds")
    if options.store is not None and (options.builds or not options.store.strip()):
        p.error("--store wants --program, and a reason")
    if options.program:
        return compare_program(options.program, options.hashes, options.steps, options.store)
    return compare_builds(options.only.split(","), options.builds, options.hashes, options.steps, options.jobs)


if __name__ == "__main__":
    sys.exit(main())
