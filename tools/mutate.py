#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutation score of the judge: one small fault at a time in gate, metrics or references, and the tests that should \
see it.

    tools/mutate.py [--seed 1] [--count 50] [--room gate|metrics|references]... [--build build-dev] [--fast] [--list] \
[--at "FILE:LINE:COLUMN: OPERATOR"]...

A mutant that its tests do not see, and that no reader can show to compute the same, is a test that is missing. No \
file of the
checkout is changed: the mutated copy is compiled without optimisation in a folder of its own and linked before the \
library that holds the true one.
The build is one whose files are compiled each alone, as by `cmake --preset dev`.
--list shows the mutants and runs none; --fast leaves out the tests that start processes, which take a minute for each \
mutant that survives.
"""

import argparse
import json
import os
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Tests: a program and the filters in the order in which they are tried. The first leaves out what starts processes.
METRICS, REFERENCES = (
    ("metrics", ["*"]),
    ("references", ["-Collapse*", "Collapse*"]),
)  # the mesh takes ten times as long as all others
PROCESSES = "Ends/*:Files/*:Lies/*:Starts*:ThirdPartyReader*:ForkStorm*:Uncertainty.OfAnInput*:StaleOutput*"
SLOW = "Process*:Kills*:Engines*:Instructions*:Timing*:*Hostile*:NeverFails*:Invariance*"
HARNESS = (
    "harness",
    [
        f"-{PROCESSES}:{SLOW}",
        "NeverFailsGate*",
        PROCESSES,
        "NeverFails*:Invariance*:*Hostile*:Timing*:-NeverFailsGate*",
    ],
)
FAST = 2  # of the filters: the rest starts a process for each test
TWINS = (
    "print-reference-values",
    ["tests/references/twins.py"],
)  # not GoogleTest: a script computes again what the program prints
# A room: its files, and the tests that cover it.
ROOMS = {
    "gate": (
        ["validation/metrics/verdict.cpp"]
        + [
            f"validation/{path}.cpp"
            for path in (
                "judge/apply_gate",
                "judge/judge",
                "judge/judge_asked",
                "judge/headroom",
                "results/verdict",
                "results/rows",
                "results/results_read",
                "campaign/recheck",
                "baseline/gate_verdict",
                "baseline/baseline",
                "baseline/baseline_compare",
                "baseline/baseline_edges",
                "baseline/baseline_rows",
                "baseline/baseline_text",
                "baseline/baseline_cases",
                "baseline/baseline_accept",
            )
        ],
        [HARNESS],
    ),
    "metrics": (["validation/metrics/*.cpp"], [METRICS, HARNESS]),
    "references": (["validation/references/*.cpp"], [REFERENCES, TWINS, METRICS, HARNESS]),
}
ELSEWHERE = {"validation/metrics/verdict.cpp"}  # of the gate, though in the room of the metrics

SWAPS = {
    "<": "<=",
    "<=": "<",
    ">": ">=",
    ">=": ">",
    "==": "!=",
    "!=": "==",
    "&&": "||",
    "||": "&&",
    "+": "-",
    "-": "+",
    "*": "/",
    "/": "*",
    "+=": "-=",
    "-=": "+=",
    "++": "--",
}
KINDS = {
    "<": "bound",
    "<=": "bound",
    ">": "bound",
    ">=": "bound",
    "==": "condition",
    "!=": "condition",
    "&&": "condition",
    "||": "condition",
}
TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|[A-Za-z_]\w*|\d[\w.]*(?:(?<=[eE])[-+]\d+)?|<=>|->|::|<<|>>|[<>=!+\-*/&|]=|&&|\|\||\+\+|--|.',
    re.S,
)


def code_of(line):
    """The line without its comment."""
    at, out = 0, []
    for match in TOKEN.finditer(line):
        if line.startswith("//", match.start()):
            break
        at = match.end()
        out.append(match)
    return out, line[:at]


def is_binary(tokens, k):
    """Whether a sign or star stands between two values: by the spaces of the format."""
    return 0 < k < len(tokens) - 1 and tokens[k - 1].group() == " " and tokens[k + 1].group() == " "


def mutants_of(path, text):
    """@return [(line number from 0, column, operator, the line as mutated)]"""
    return [(number, *mutant) for number, line in enumerate(text.split("\n")) for mutant in mutants_of_line(line)]


DECLARATIONS = (
    "//",
    "#",
    "namespace",
    "using",
    "template",
    "static_assert",
    "enum",
    "struct",
    "class",
    "constexpr std::string_view",
)


def mutants_of_line(line):
    """(column, operator, the line as mutated) of each word, then of its calls, then of the whole statement."""
    bare = line.strip()
    if not bare or bare.startswith(DECLARATIONS):
        return
    tokens, code = code_of(line)
    for k, match in enumerate(tokens):
        change = mutated_sign(tokens, k, code) or mutated_value(tokens, k, code)
        if change:
            kind, new = change
            yield match.start(), kind, line[: match.start()] + new + line[match.end() :]
        elif match.group() == "if":
            yield from negated(line, code, match)
    yield from swapped_arguments(line, code)
    yield from deleted_statement(line, code)


def mutated_sign(tokens, k, code):
    """(operator, new text) of a comparison or sum; nothing where it is none."""
    word, binary = tokens[k].group(), is_binary(tokens, k)
    comparison = word in ("==", "!=", "&&", "||", "<=", ">=")
    reference = word == "&&" and not binary  # to what is about to end
    if word not in SWAPS or not (comparison or binary) or reference:
        return None
    declares = "operator" in code or code.rstrip().endswith("delete;")
    return None if declares else (KINDS.get(word, "arithmetic"), SWAPS[word])


def mutated_value(tokens, k, code):
    """(operator, new text) of a whole number or a truth; nothing of other words."""
    word = tokens[k].group()
    if re.fullmatch(r"\d+", word):
        part = k > 0 and tokens[k - 1].group() in (".", "_")
        return None if part or "array<" in code else ("off by one", str(int(word) + 1))
    if word in ("true", "false") and "=" not in code.split(word)[0][-3:]:
        return "condition", "false" if word == "true" else "true"
    return None


def negated(line, code, match):
    inside = parenthesised(code, match.end()) if "constexpr" not in code and "(" in code else None
    if inside and ";" not in code[slice(*inside)]:
        begin, end = inside
        yield match.start(), "condition", line[:begin] + "!(" + line[begin:end] + ")" + line[end:]


def swapped_arguments(line, code):
    for match in re.finditer(r"\b[\w:]+\(([\w.\[\]]+), ([\w.\[\]]+)\)", code):
        one, two = match.groups()
        if one != two and not re.match(r"(const|double|int|auto)\b", one):
            a, b = match.span(1), match.span(2)
            yield match.start(), "swapped arguments", line[: a[0]] + two + line[a[1] : b[0]] + one + line[b[1] :]


STATEMENT = re.compile(r"\s+[\w.\[\]()*>-]+(\.|->|\[|\s[-+*/|&]?=\s|\()")
KEPT = re.compile(
    r"\s*(return|throw|const|auto|double|int|bool|std::|static|constexpr|if|for|while|else|using|case|break|continue"
    r"|[A-Z]\w* )"
)


def deleted_statement(line, code):
    if STATEMENT.match(code) and code.rstrip().endswith(";") and not KEPT.match(code):
        indent = len(line) - len(line.lstrip())
        yield indent, "deleted statement", line[:indent] + ";" + line[len(code) :]


def parenthesised(code, start):
    """Where the first bracket after start begins and ends, inside; None where it does not end on this line."""
    begin = code.find("(", start)
    level = 0
    for k in range(begin, len(code)):
        level += {"(": 1, ")": -1}.get(code[k], 0)
        if level == 0:
            return begin + 1, k
    return None


class Mutant:
    def __init__(self, room, path, number, column, operator, line):
        self.room, self.path, self.number, self.column, self.operator, self.line = (
            room,
            path,
            number,
            column,
            operator,
            line,
        )

    def __str__(self):
        return f"{self.path.relative_to(ROOT)}:{self.number + 1}:{self.column + 1}: {self.operator}"


def all_mutants(rooms):
    found = []
    for room in rooms:
        for pattern in ROOMS[room][0]:
            for path in sorted(ROOT.glob(pattern)):
                if room == "metrics" and str(path.relative_to(ROOT)) in ELSEWHERE:
                    continue
                found += [Mutant(room, path, *what) for what in mutants_of(path, path.read_text())]
    return found


def sample(mutants, count, seed):
    """A file first, then a mutant in it: a long file does not crowd out the rest. Each mutant once, as many in each
    room as in another."""
    r, chosen = random.Random(seed), []
    rooms = {}
    for m in mutants:
        rooms.setdefault(m.room, {}).setdefault(m.path, []).append(m)
    while rooms:
        for room in list(rooms):
            files = rooms[room]
            path = r.choice(sorted(files))
            chosen.append(files[path].pop(r.randrange(len(files[path]))))
            if not files[path]:
                del files[path]
            if not files:
                del rooms[room]
            if len(chosen) == count * 3:  # some do not compile
                return chosen
    return chosen


class Build:
    """What is built already, and how a changed file is compiled and linked into its tests."""

    def __init__(self, folder, work):
        self.folder, self.work, self.links = Path(folder).resolve(), Path(work), {}
        self.commands = {
            entry["file"]: shlex.split(entry["command"])
            for entry in json.loads((self.folder / "compile_commands.json").read_text())
        }
        if str(ROOT / "validation/metrics/verdict.cpp") not in self.commands:
            sys.exit(f"{self.folder} compiles several files as one: cmake --preset dev makes build-dev, which does not")

    def program(self, name):
        return f"tests/{name}" if name == TWINS[0] else f"tests/test-{name}"

    def make(self, name):
        subprocess.run(
            ["ninja", "-C", str(self.folder), "-j", "1", self.program(name)], check=True, capture_output=True
        )
        listed = subprocess.run(
            ["ninja", "-C", str(self.folder), "-t", "commands", self.program(name)],
            check=True,
            capture_output=True,
            text=True,
        ).stdout.splitlines()[-1]
        words = shlex.split(listed)
        self.links[name] = words[words.index("&&") + 1 : len(words) - 1 - words[::-1].index("&&")]

    def compile(self, path, text):
        """@return whether the file with this text compiles"""
        copy = self.work / path.name
        copy.write_text(text)
        words = [
            w
            for w in self.commands[str(path)]
            if not w.endswith("ccache") and not w.startswith(("-O", "-W", "-D_FORTIFY", "-U_FORTIFY"))
        ]
        words[words.index("-o") + 1], words[words.index("-c") + 1] = str(self.work / "mutant.o"), str(copy)
        return subprocess.run([*words, "-O0", "-w"], cwd=self.folder, capture_output=True, check=False).returncode == 0

    def link(self, name):
        """The object comes before the library, so that the library's own is not taken."""
        words = list(self.links[name])
        words[words.index("-o") + 1] = str(self.work / name)
        words.insert(words.index("-o"), str(self.work / "mutant.o"))
        gold = ["-fuse-ld=gold"] if shutil.which("ld.gold") else []
        subprocess.run([*words, *gold], cwd=self.folder, check=True, capture_output=True)
        return self.work / name

    def original(self, name):
        return self.folder / self.program(name)


def run_tests(name, program, words, limit):
    """@return what saw a fault, or None"""
    asked = (
        ["/usr/bin/python3", "-B", str(ROOT / words), str(program)]
        if name == TWINS[0]
        else [str(program), "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={words}"]
    )
    with subprocess.Popen(
        asked,
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
        preexec_fn=bounded,
    ) as child:
        try:
            text, _ = child.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.communicate()
            return "time limit"
    if child.returncode == 0:
        return None
    failed = re.findall(r"\[  FAILED  \] (\S+)", text)
    return (
        words
        if name == TWINS[0]
        else failed[0].rstrip(",")
        if failed
        else f"the tests of {name} ended {child.returncode}"
    )


def bounded():
    """A mutant may ask for all the memory."""
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))


def seen_by(mutant, build, limits, fast):
    """@return "invalid", "survived", or which test saw it"""
    lines = mutant.path.read_text().split("\n")
    lines[mutant.number] = mutant.line
    if not build.compile(mutant.path, "\n".join(lines)):
        return "invalid"
    for name, filters in ROOMS[mutant.room][1]:
        program = build.link(name)
        for words in filters[:FAST] if fast else filters:
            if seen := run_tests(name, program, words, 10.0 + 5.0 * limits[name, words]):
                return seen
    return "survived"


def unchanged_tests(rooms, build, fast):
    """The tests pass as they are. @return seconds of each"""
    seconds = {}
    for name, filters in {(p, tuple(f)) for room in rooms for p, f in ROOMS[room][1]}:
        build.make(name)
        for words in filters[:FAST] if fast else filters:
            start = time.monotonic()
            if seen := run_tests(name, build.original(name), words, None):
                sys.exit(f"the tests of {name} fail as they are: {seen}")
            seconds[name, words] = time.monotonic() - start
    return seconds


def show(mutant, verdict):
    old, new = mutant.path.read_text().split("\n")[mutant.number].strip(), mutant.line.strip()
    word, by = ("SURVIVED", "") if verdict == "survived" else ("seen", f"  by {verdict}")
    print(f"{word:8} {mutant}{by}\n    - {old}\n    + {new}", flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=50)
    words.add_argument("--room", action="append", choices=sorted(ROOMS))
    words.add_argument("--build", default=str(ROOT / "build-dev"))
    words.add_argument("--fast", action="store_true")
    words.add_argument("--list", action="store_true")
    words.add_argument("--at", action="append", help="one mutant, as --list names it: FILE:LINE:COLUMN: OPERATOR")
    asked = words.parse_args()
    asked.build = str(Path(asked.build).resolve())  # the compiler is started in it
    rooms = asked.room or sorted(ROOMS)
    every = all_mutants(rooms)
    chosen = [m for m in every if str(m) in asked.at] if asked.at else sample(every, asked.count, asked.seed)
    count = len(chosen) if asked.at else asked.count
    print(f"seed {asked.seed}: {count} of {len(every)} mutants in {', '.join(rooms)}", flush=True)
    if asked.list:
        return print("\n".join(str(m) for m in (every if not asked.at else chosen)))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with tempfile.TemporaryDirectory(prefix="mutants-", dir=asked.build) as work:
        return run(asked, rooms, chosen, count, Build(asked.build, work))


def run(asked, rooms, chosen, count, build):
    limits = unchanged_tests(rooms, build, asked.fast)
    score, invalid = {room: [0, 0] for room in rooms}, 0
    for mutant in chosen:
        if sum(total for _, total in score.values()) == count:
            break
        verdict = seen_by(mutant, build, limits, asked.fast)
        if verdict == "invalid":
            invalid += 1
            continue
        score[mutant.room][0] += verdict != "survived"
        score[mutant.room][1] += 1
        show(mutant, verdict)
    for room, (seen, total) in score.items():
        print(f"{room}: {seen} of {total} seen")
    seen, total = (sum(s[k] for s in score.values()) for k in (0, 1))
    print(f"score {100.0 * seen / max(total, 1):.0f} % ({seen} of {total}; {invalid} more did not compile)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
