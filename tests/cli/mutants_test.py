# SPDX-License-Identifier: BSD-3-Clause
"""200 mutated case files through the whole program: each is refused with file, line and remedy, or its change is seen
in
`explain --json`. Never a crash, a hang, or a silent pass.   mutants_test.py TRIPOINT WRITE_MUTANTS"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

COUNT, SEED = 200, 20260101  # the seed is kept: a failure repeats
tripoint, write_mutants = sys.argv[1:3]


def explain(path):
    return subprocess.run(
        [tripoint, "explain", path, "--json"], capture_output=True, text=True, errors="replace", timeout=20
    )


def shown(path):
    """What explain makes of a file: every key with its value."""
    return [(d["key"], d["value"]) for d in json.loads(explain(path).stdout)["decisions"]]


def meaning(path):
    """The file as another TOML reader sees it; None where that refuses it."""
    try:
        return tomllib.loads(path.read_text())
    except (ValueError, RecursionError):
        return None


def refusal_fault(path, result, needs_line):
    if path.name not in result.stderr:
        return "the refusal does not name the file"
    if needs_line and not re.search(re.escape(path.name) + r":\d+", result.stderr):
        return "the refusal names no line"
    return "" if len(result.stderr.split(path.name)[-1]) > 20 else "the refusal says nothing of what to do"


def fault_of(mutant, source):
    result = explain(mutant)
    if result.returncode == 2:
        return refusal_fault(mutant, result, True)
    if result.returncode != 0:
        return f"ended {result.returncode}"
    if meaning(mutant) == meaning(source):
        return ""  # a comment, a blank or the spelling of a number
    return "" if shown(mutant) != shown(source) else "passed in silence: explain shows no change"


def main():
    faults = []
    with tempfile.TemporaryDirectory(prefix="tripoint mutants ü ") as name:
        folder = pathlib.Path(name)
        subprocess.run([write_mutants, name, str(COUNT), str(SEED)], check=True, capture_output=True)
        for n in range(COUNT):
            fault = fault_of(folder / f"mutant-{n}.toml", folder / f"source-{n}.toml")
            if fault:
                faults.append(f"mutant-{n}: {fault}")
        breakers = sorted(folder.glob("breaker-*.toml"))
        for path in breakers:
            result = explain(path)
            fault = f"ended {result.returncode}" if result.returncode != 2 else refusal_fault(path, result, False)
            if fault:
                faults.append(f"{path.name}: {fault}: {path.read_bytes()[:60]!r}")
    print("\n".join(faults))
    total = COUNT + len(breakers)
    print(f"{total - len(faults)} passed, {len(faults)} failed")
    return 1 if faults or not breakers else 0


if __name__ == "__main__":
    sys.exit(main())
