#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutation score of the judge: one small fault at a time in gate, metrics or references, and the tests that should see it.

    tools/mutate.py [--seed 1] [--count 50] [--room gate|metrics|references]... [--build build] [--fast] [--list] [--at "FILE:LINE:COLUMN: OPERATOR"]...

A mutant that its tests do not see, and that no reader can show to compute the same, is a test that is missing. The files are changed in place, one
at a time, and are put back whatever happens: run it in a checkout where nothing else works. --list shows the mutants and runs none; --fast leaves out
the tests of the suite's own processes, which take a minute for each mutant that survives.
"""
import argparse
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# A room: its files, the test program that covers it, and the filters in the order in which they are tried (the fast ones first).
HARNESS = ("harness", ["-Process*:Kills*:Engines*:Instructions*:Timing*:*Hostile*:NeverFails*:Harmless*", "NeverFails*:Harmless*:*Hostile*:Timing*"])
ROOMS = {
    "gate": (["validation/metrics/verdict.cpp"] + [f"validation/harness/{name}.cpp" for name in ("apply_gate", "judge", "judge_asked", "verdict", "gate_verdict", "recheck", "slack", "results_read", "baseline",
             "baseline_compare", "baseline_edges", "baseline_rows", "baseline_cases", "baseline_accept")], [HARNESS]),
    "metrics": (["validation/metrics/*.cpp"], [("metrics", ["*"]), HARNESS]),
    "references": (["validation/references/*.cpp"], [("references", ["*"]), ("metrics", ["*"])]),
}
ELSEWHERE = {"validation/metrics/verdict.cpp"}  # of the gate, though in the room of the metrics

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "++": "--"}
KINDS = {"<": "bound", "<=": "bound", ">": "bound", ">=": "bound", "==": "condition", "!=": "condition", "&&": "condition", "||": "condition"}
TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|[A-Za-z_]\w*|\d[\w.]*(?:(?<=[eE])[-+]\d+)?|<=>|->|::|<<|>>|[<>=!+\-*/&|]=|&&|\|\||\+\+|--|.', re.S)


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
    found = []
    for number, line in enumerate(text.split("\n")):
        bare = line.strip()
        if not bare or bare.startswith(("//", "#", "namespace", "using", "template", "static_assert", "enum", "struct", "class", "///", "constexpr std::string_view")):
            continue
        tokens, code = code_of(line)
        put = lambda match, new, kind: found.append((number, match.start(), kind, line[:match.start()] + new + line[match.end():]))
        for k, match in enumerate(tokens):
            word = match.group()
            if word in SWAPS and (word in ("==", "!=", "&&", "||", "<=", ">=") or is_binary(tokens, k)):
                if word == "&&" and not is_binary(tokens, k):  # a reference to what is about to end
                    continue
                if not ("operator" in code or code.rstrip().endswith("delete;")):
                    put(match, SWAPS[word], KINDS.get(word, "arithmetic"))
            elif word == "++":
                pass
            elif re.fullmatch(r"\d+", word) and (k == 0 or tokens[k - 1].group() not in (".", "_")) and "array<" not in code:
                put(match, str(int(word) + 1), "off by one")
            elif word in ("true", "false") and "=" not in code.split(word)[0][-3:]:
                put(match, "false" if word == "true" else "true", "condition")
            elif word == "if" and "constexpr" not in code and "(" in code and (inside := parenthesised(code, match.end())):
                begin, end = inside
                if ";" not in code[begin:end]:
                    found.append((number, match.start(), "condition", line[:begin] + "!(" + line[begin:end] + ")" + line[end:]))
        for match in re.finditer(r"\b[\w:]+\(([\w.\[\]]+), ([\w.\[\]]+)\)", code):
            if match.group(1) != match.group(2) and not re.match(r"(const|double|int|auto)\b", match.group(1)):
                a, b = match.span(1), match.span(2)
                found.append((number, match.start(), "swapped arguments", line[:a[0]] + match.group(2) + line[a[1]:b[0]] + match.group(1) + line[b[1]:]))
        if re.match(r"\s+[\w.\[\]()*>-]+(\.|->|\[|\s[-+*/|&]?=\s|\()", code) and code.rstrip().endswith(";") and not re.match(r"\s*(return|throw|const|auto|double|int|bool|std::|static|constexpr|if|for|while|else|using|case|break|continue|[A-Z]\w* )", code):
            found.append((number, len(line) - len(line.lstrip()), "deleted statement", line[:len(line) - len(line.lstrip())] + ";" + line[len(code):]))
    return found


def parenthesised(code, start):
    """Where the first bracket after start begins and ends, inside; None where it does not end on this line."""
    begin = code.find("(", start)
    level = 0
    for k in range(begin, len(code)):
        level += {"(": 1, ")": -1}.get(code[k], 0)
        if level == 0:
            return begin + 1, k
    return None


# What the compiler would remark on in a mutant: it is to be seen by a test, not by -Werror.
QUIET = "".join(f'#pragma GCC diagnostic ignored "-W{name}"\n' for name in ("parentheses", "unused-variable", "unused-parameter", "unused-but-set-variable", "unused-function", "unused-value",
                "empty-body", "misleading-indentation", "bool-compare", "type-limits", "maybe-uninitialized", "uninitialized", "int-in-bool-context", "conversion", "float-conversion", "extra"))


class Mutant:
    def __init__(self, room, path, number, column, operator, line):
        self.room, self.path, self.number, self.column, self.operator, self.line = room, path, number, column, operator, line

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
    """A file first, then a mutant in it: a long file does not crowd out the rest. Each mutant once, as many in each room as in another."""
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


def seen_by(mutant, build, limits, fast):
    """@return "invalid", "survived", or which test saw it"""
    for program, filters in ROOMS[mutant.room][1]:
        made = subprocess.run(["ninja", "-C", build, "-j", "1", f"test-{program}"], capture_output=True, text=True, check=False)
        if made.returncode != 0:
            return "invalid" if "error:" in made.stdout + made.stderr else sys.exit(made.stdout + made.stderr)
        for words in filters[:1] if fast else filters:
            try:
                limit = 10.0 + 5.0 * limits[program, words]
                ended = subprocess.run([f"{build}/tests/test-{program}", "--gtest_brief=1", f"--gtest_filter={words}"], capture_output=True, text=True, errors="replace", timeout=limit, check=False)
            except subprocess.TimeoutExpired:
                return "time limit"
            if ended.returncode != 0:
                failed = re.findall(r"\[  FAILED  \] (\S+)", ended.stdout)
                return failed[0].rstrip(",") if failed else f"the tests ended {ended.returncode}"
    return "survived"


def unchanged_tests(rooms, build, fast):
    """The tests pass as they are. @return seconds of each"""
    seconds = {}
    for program, filters in {(p, tuple(f)) for room in rooms for p, f in ROOMS[room][1]}:
        subprocess.run(["ninja", "-C", build, "-j", "1", f"test-{program}"], check=True, capture_output=True)
        for words in filters[:1] if fast else filters:
            start = time.monotonic()
            ended = subprocess.run([f"{build}/tests/test-{program}", "--gtest_brief=1", f"--gtest_filter={words}"], capture_output=True, text=True, errors="replace", check=False)
            if ended.returncode != 0:
                sys.exit(f"test-{program} fails as it is ({ended.returncode}):\n{ended.stdout[-2000:]}{ended.stderr[-2000:]}")
            seconds[program, words] = time.monotonic() - start
    return seconds


def show(mutant, verdict, text):
    old, new = text.split("\n")[mutant.number], mutant.line
    print(f"{'SURVIVED' if verdict == 'survived' else 'seen':8} {mutant}{'' if verdict == 'survived' else '  by ' + verdict}\n    - {old.strip()}\n    + {new.strip()}", flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=50)
    words.add_argument("--room", action="append", choices=sorted(ROOMS))
    words.add_argument("--build", default=str(ROOT / "build"))
    words.add_argument("--fast", action="store_true")
    words.add_argument("--list", action="store_true")
    words.add_argument("--at", action="append", help="one mutant, as --list names it: FILE:LINE:COLUMN: OPERATOR")
    asked = words.parse_args()
    rooms = asked.room or sorted(ROOMS)
    every = all_mutants(rooms)
    chosen = [m for m in every if str(m) in asked.at] if asked.at else sample(every, asked.count, asked.seed)
    count = len(chosen) if asked.at else asked.count
    print(f"seed {asked.seed}: {count} of {len(every)} mutants in {', '.join(rooms)}", flush=True)
    if asked.list:
        return print("\n".join(str(m) for m in (every if not asked.at else chosen)))
    limits = unchanged_tests(rooms, asked.build, asked.fast)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    score, invalid = {room: [0, 0] for room in rooms}, 0
    for mutant in chosen:
        if sum(total for _, total in score.values()) == count:
            break
        text = mutant.path.read_text()
        lines = text.split("\n")
        lines[mutant.number] = mutant.line
        try:
            mutant.path.write_text(QUIET + "\n".join(lines))
            verdict = seen_by(mutant, asked.build, limits, asked.fast)
        finally:
            mutant.path.write_text(text)
        if verdict == "invalid":
            invalid += 1
            continue
        score[mutant.room][0] += verdict != "survived"
        score[mutant.room][1] += 1
        show(mutant, verdict, text)
    for room, (seen, total) in score.items():
        print(f"{room}: {seen} of {total} seen")
    seen, total = (sum(s[k] for s in score.values()) for k in (0, 1))
    print(f"score {100.0 * seen / max(total, 1):.0f} % ({seen} of {total}; {invalid} more did not compile)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
