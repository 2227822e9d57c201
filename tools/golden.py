#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether results have the same bits in every build: two compilers, four optimisation levels, every vector width, any number of threads.

    tools/golden.py --builds FOLDER                  # compiles what is missing there (half an hour on two cores), runs, compares
    tools/golden.py --builds FOLDER --write HASHES   # keeps the hashes, to compare another machine by:
    tools/golden.py --builds FOLDER --against HASHES

Runs `state-hashes` on twelve cases of the commit profile, in each mode that they have: a hash of all columns, bonds, bookings and the order of
rows after some steps. Exit 0: all equal; 1: some differ, and each is named; 2: nothing was compared.
The last row has the C library take the functions that it has for processors without fused multiply-add: what another processor would do.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CASES = ("fluid/dam-break-small", "fluid/rotating-bucket", "coupling/floating-block-050", "coupling/gum-ball", "solid/cantilever", "solid/plastic-sheet",
         "solid/tear-limit", "phase/melt-rigid", "phase/freeze-merge", "phase/split-by-melting", "heat/inflow", "rigid/merge-in-flight")
# name: compiler, CMake's build type, level. A Debug build has vector units at -O1 (cmake/tripoint.cmake says why), the others at -O3.
BUILDS = {
    "gcc-O0": ("g++", "Debug", "-O0"),
    "gcc-O2": ("g++", "Release", "-O2"),
    "gcc-O3": ("g++", "Release", "-O3"),
    "clang-O0": ("clang++", "Debug", "-O0"),
    "clang-O2": ("clang++", "Release", "-O2"),
    "clang-O3": ("clang++", "Release", "-O3"),
}
WITHOUT_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}


def compiler(name):
    """The newest installed program of that compiler, or nothing."""
    return next((found for version in ("-16", "-15", "-14", "") if (found := shutil.which(name + (version if name == "clang++" else "")))), None)


def build(name, folder, jobs):
    """The program state-hashes of that build; nothing where the compiler is missing. @throws subprocess.CalledProcessError where it does not compile"""
    what, kind, level = BUILDS[name]
    path = compiler(what)
    if not path:
        return None
    tree = folder / name
    if not (tree / "build.ninja").exists():
        flags = f"-DCMAKE_CXX_FLAGS_{kind.upper()}={level}"
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={path}", f"-DCMAKE_BUILD_TYPE={kind}", flags, *launcher],
                       check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", tree, "-j", str(jobs), "state-hashes"], check=True, stdout=sys.stderr)
    return tree / "tests" / "state-hashes"


def widths():
    """Vector widths that this processor has."""
    flags = next((line for line in pathlib.Path("/proc/cpuinfo").read_text().split("\n") if line.startswith("flags")), "").split()
    return [1] + [lanes for lanes, flag in ((4, "avx2"), (8, "avx512dq")) if flag in flags]


def hashes(program, steps, lanes, threads, environment=None):
    """One line a case and mode."""
    command = [program, "--steps", steps, "--lanes", lanes, "--threads", threads] + [ROOT / "cases" / f"{case}.toml" for case in CASES]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True, env=os.environ | (environment or {}))
    return done.stdout.strip().split("\n")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--builds", type=pathlib.Path, required=True, metavar="FOLDER")
    p.add_argument("--only", default=",".join(BUILDS), help="builds, by name: " + ", ".join(BUILDS))
    p.add_argument("--steps", type=int, default=200)
    p.add_argument("--jobs", type=int, default=2)
    p.add_argument("--write", type=pathlib.Path, metavar="HASHES")
    p.add_argument("--against", type=pathlib.Path, metavar="HASHES")
    options = p.parse_args()
    if unknown := set(options.only.split(",")) - set(BUILDS):
        p.error(f"no build is called {', '.join(sorted(unknown))}: there are {', '.join(BUILDS)}")

    truth = options.against.read_text().strip().split("\n") if options.against else None
    compared = different = 0
    program = None
    print(f"{'build':10}  {'lanes':>5}  {'threads':>7}  equal")

    def row(name, lanes, threads, environment=None, note=""):
        nonlocal truth, compared, different
        lines = hashes(program, options.steps, lanes, threads, environment)
        truth = truth or lines
        others = [line for line in lines if line not in truth]
        compared += 1
        different += bool(others) and not note
        print(f"{name:10}  {lanes:5}  {threads:7}  {len(lines) - len(others)} of {len(truth)}{note}", flush=True)
        for line in others:
            print(f"            differs: {line}")

    for name in options.only.split(","):
        found = build(name, options.builds, options.jobs)
        if not found:
            print(f"{name:10}  no such compiler here")
            continue
        program = found
        for lanes in widths():
            for threads in (1, 3):
                row(name, lanes, threads)
    if program:
        row("no FMA", 1, 1, WITHOUT_FMA, "  (the C library's other functions; not promised)")
    if options.write and truth:
        options.write.write_text("\n".join(truth) + "\n")
    return 2 if compared == 0 else 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
