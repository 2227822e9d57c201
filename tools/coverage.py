#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which lines tests run, room by room.

    tools/coverage.py [TEST...]        e.g. tools/coverage.py metrics references; without names every test program

Builds test-TEST in build-coverage (preset `coverage`), runs it, and prints for each room the lines that were run, of
those that hold code and were built. `--missed ROOM` lists the lines of a room that no test ran. A whole build takes an
hour of the processor."""

import argparse
import collections
import gzip
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build-coverage"
ROOMS = ("src", "adapters", "validation", "program")


def run(*words, **more):
    return subprocess.run([str(w) for w in words], check=True, **more)


def build(names, jobs):
    if not (BUILD / "build.ninja").exists():
        run("cmake", "--preset", "coverage", cwd=ROOT, stdout=subprocess.DEVNULL)
    targets = [f"test-{name}" for name in names] or ["all"]
    run("ninja", "-C", BUILD, "-j", jobs, *targets, stdout=sys.stderr)


def run_tests(names):
    """Runs the test programs; one that fails is named, and what it ran counts all the same."""
    for counts in BUILD.rglob("*.gcda"):
        counts.unlink()
    programs = [BUILD / "tests" / f"test-{name}" for name in names] or sorted((BUILD / "tests").glob("test-*"))
    failed = [
        p.name for p in programs if subprocess.run([p, "--gtest_brief=1"], stdout=sys.stderr, cwd=BUILD).returncode != 0
    ]
    if failed:
        print("failed:", ", ".join(failed), file=sys.stderr)
    return not failed


def lines_run():
    """Path from the root -> line -> how often it ran, summed over all objects that hold it."""
    lines = collections.defaultdict(collections.Counter)
    objects = sorted(BUILD.rglob("*.gcda"))
    with tempfile.TemporaryDirectory() as folder:
        for start in range(0, len(objects), 100):
            run(
                "gcov",
                "--json-format",
                "--hash-filenames",
                *objects[start : start + 100],
                cwd=folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
        for report in Path(folder).glob("*.gcov.json.gz"):
            data = json.loads(gzip.decompress(report.read_bytes()))
            for file in data["files"]:
                # Objects name files from the checkout's root (-ffile-prefix-map), or in full.
                inside = os.path.relpath(os.path.normpath(ROOT / file["file"]), ROOT)
                if inside.startswith(tuple(room + "/" for room in ROOMS)):
                    for line in file["lines"]:
                        lines[inside][line["line_number"]] += line["count"]
    return lines


def room_of(path):
    parts = path.split("/")
    return "/".join(
        parts[:3] if parts[1] == "effects" and len(parts) > 3 else parts[:2] if len(parts) > 2 else parts[:1]
    )


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("tests", nargs="*", metavar="TEST")
    words.add_argument("--missed", metavar="ROOM", help="e.g. validation/metrics: list its lines that no test ran")
    words.add_argument("--jobs", default="2")
    asked = words.parse_args()
    build(asked.tests, asked.jobs)
    good = run_tests(asked.tests)
    lines = lines_run()
    rooms = collections.defaultdict(list)
    for path, counts in lines.items():
        rooms[room_of(path)] += counts.values()
    print(f"{'room':<28}{'lines':>8}{'run':>8}{'share':>8}")
    for room, counts in sorted(rooms.items()):
        ran = sum(count > 0 for count in counts)
        print(f"{room:<28}{len(counts):>8}{ran:>8}{ran / len(counts):>8.1%}")
    if asked.missed:
        for path, counts in sorted(lines.items()):
            missed = sorted(n for n, count in counts.items() if count == 0)
            if room_of(path) == asked.missed and missed:
                print(f"{path}: {', '.join(map(str, missed))}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
