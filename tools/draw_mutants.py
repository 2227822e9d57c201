#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Defects drawn at random, each judged as a change would be: does anything turn red?

    tools/draw_mutants.py --tree ../copy --seed 7 --count 20 --out mutants.json

Draws file, line and change (another operator, another sign, a factor of 1.02, a statement left out) over all C++ files
of the solver (src/effects, src/sph, src/solids, src/step) and adapters, or of each --room. Each is applied to --tree, a
copy of the project that is already built with tests (`git worktree add`, then `tools/build.sh --tests N`), which is
rebuilt as far as the file reaches. Then the cases of the commit profile that touch the file are run, the quickest
first, and the unit tests of its room between the quick ones and the others, until one is red. Where the change does not
compile another is drawn; a mutant nothing sees is printed with its line. With --cases-only no unit test is asked: the
share that is killed is that of the suite alone. At most --most cases are asked, those of other effects first. The seed
gives the same mutants from the same sources: --from COMMIT draws from those of a commit, and finds each line in --tree
by its text. What was judged already in --out is not judged again, but what lived is with --again. A change that
computes the same is none: equivalent_mutants.toml gives its reason."""

import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time
import tomllib

OURS = ["engine-tripoint", "engine-tripoint-mpi", "tripoint-halo"]  # in one process, and over ranks
ROOMS = ("src/effects", "src/sph", "src/solids", "src/step", "adapters")
EQUIVALENT = tomllib.loads((pathlib.Path(__file__).resolve().parent / "equivalent_mutants.toml").read_text())["mutant"]
# A line that carries no behaviour of the model: text for people, declarations.
PASSED_OVER = re.compile(
    r"^\s*(//|#|\*|using |namespace |template|struct |class |enum "
    r'|static_assert|assert|\[\[nodiscard\]\]|public:|private:|case )|"|throw |fmt::|static '
    r"const|const_cast|operator|= default|= delete|make_unique|\bfor \(|\w&[,)]|std::vector<.*=|\w& \w+ = "
    r"|nullptr|virtual |, \w+ = "
)
OPERATORS = (
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" < ", " >= "),
    (" > ", " <= "),
    (" <= ", " > "),
    (" >= ", " < "),
    (" && ", " || "),
    (" || ", " && "),
    (" += ", " -= "),
    (" -= ", " += "),
    (" == ", " != "),
    (" != ", " == "),
)


def changes_of(line):
    """Every change of a line of code, as (kind, changed line)."""
    code = line.split("//")[0].rstrip()
    if not code.strip() or PASSED_OVER.search(code):
        return []
    found = []
    for old, new in OPERATORS:
        at = -1
        while (at := code.find(old, at + 1)) >= 0:
            found.append(("operator" if old.strip() not in "+-" else "sign", code[:at] + new + code[at + len(old) :]))
    for m in re.finditer(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?)(?![\w.])", code):
        if float(m[1]) == 0.0:
            continue  # 1.02 times nothing
        found.append(("factor", code[: m.start()] + f"(1.02 * {m[1]})" + code[m.end() :]))
    if m := re.fullmatch(r"(\s*)return ([^;{}]+);", code):
        found += [("factor", f"{m[1]}return 1.02 * ({m[2]});"), ("sign", f"{m[1]}return -({m[2]});")]
    if (
        (m := re.fullmatch(r"(\s*[^;{}()=]+(?:\([^;{}=]*\))?[^;{}()=]* (?:\+|-)?= )([^;{}]+);", code))
        and m[2] not in ("0.0", "true", "false", "{}")
        and not re.search(r"\bauto |\bbool ", code)
    ):
        found += [("factor", f"{m[1]}1.02 * ({m[2]});"), ("sign", f"{m[1]}-({m[2]});")]
    if (
        re.fullmatch(r"\s*(?:[\w\].>()\[:-]+ (?:\+|-|\*)?= [^;{}]+|[\w.>:-]+\([^;{}]*\));", code)
        and "0.0;" not in code
        and not re.match(r"\s*(return|const|auto|double|int)\b", code)
    ):
        found.append(("dropped", re.match(r"\s*", code)[0] + ";"))
    return found


def sources(tree, rooms=ROOMS):
    files = []
    for room in rooms:
        files += sorted(
            p for p in (tree / room).rglob("*") if p.suffix in (".cpp", ".hpp") and "templates" not in p.parts
        )
    return files


def draw(rng, tree, rooms=ROOMS):
    """A file, each as likely; in it a line that can be changed; of that a change."""
    while True:
        path = rng.choice(sources(tree, rooms))
        lines = path.read_text().split("\n")
        candidates = [n for n in range(len(lines)) if changes_of(lines[n])]
        if not candidates:
            continue
        n = rng.choice(candidates)
        kind, text = rng.choice(changes_of(lines[n]))
        return {
            "file": str(path.relative_to(tree)),
            "line": n + 1,
            "kind": kind,
            "old": lines[n].strip(),
            "new": text.strip(),
        }


def sources_of(commit):
    """A folder with the sources of a commit, to draw from."""
    folder = tempfile.TemporaryDirectory(prefix="draw-mutants-")
    packed = subprocess.run(
        ["git", "archive", commit, "src", "adapters"],
        cwd=pathlib.Path(__file__).resolve().parent.parent,
        check=True,
        capture_output=True,
    ).stdout
    subprocess.run(["tar", "-x", "-C", folder.name], input=packed, check=True)
    return folder


def place_in(tree, mutant, rooms):
    """Where the line of a mutant stands in the tree: in its file, or in one file that the line has moved to; None where
    it is gone."""

    def at(path):
        lines = path.read_text().split("\n") if path.exists() else []
        return lines, [n for n, line in enumerate(lines) if line.strip() == mutant["old"]]

    for path in [tree / mutant["file"]] + sources(tree, rooms):
        lines, found = at(path)
        if found:
            n = min(found, key=lambda k: abs(k + 1 - mutant["line"]))
            return path, lines, n
    return None


def reason_equal(mutant):
    """Why a mutant is no defect; empty where it may be one."""
    if "-(0)" in mutant["new"] or re.search(r"\b(int|long|std::size_t) \w+ = 1\.02 \* \(\d\d?\);", mutant["new"]):
        return "the number is the same"
    return next((row["why"] for row in EQUIVALENT if row["old"] in mutant["old"] and row["new"] in mutant["new"]), "")


def targets_of(file):
    """The programs that are rebuilt, the unit tests of the room, and the engine whose cases are asked."""
    if file.startswith("src/effects"):
        part = file.split("/")[2]
        of = {
            "elastic": ["elastic"],
            "plastic": ["plastic"],
            "fracture": ["plastic"],
            "phase": ["phase"],
            "heat": ["phase"],
        }.get(part, ["elastic", "passes", "phase"])
        return OURS, ["test-effects"] + [f"test-effects-{x}" for x in of] + ["test-step"], "tripoint"
    if not file.startswith("adapters"):
        return (
            OURS,
            [f"test-{file.split('/')[1]}" if not file.startswith("src/solids") else "test-effects", "test-step"],
            "tripoint",
        )
    part = file.split("/")[1]
    tests = {"tripoint": ["test-step"], "bullet": ["test-bullet"], "lammps": ["test-engines"], "exact": ["test-exact"]}
    if part == "ranks":
        return OURS, ["test-ranks"], "tripoint-mpi"
    if part in tests:
        return OURS if part == "tripoint" else [f"engine-{part}"], tests[part], part
    return (
        ["engine-tripoint", "engine-bullet", "engine-exact", "engine-lammps", "bin/tripoint"],
        ["test-files", "test-exact"],
        "tripoint",
    )


def run(command, tree, seconds):
    try:
        return subprocess.run(command, cwd=tree, capture_output=True, text=True, errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired:
        return None


class Cases:
    """The commit profile: what each case calls for, and what it costs. What `sound`, a tree without a mutant, does not
    pass tells nothing."""

    def __init__(self, tree, sound):
        self.tree, self.sound, self.known = tree, sound, {}
        listed = json.loads(run(["build/bin/tripoint", "list", "--json"], tree, 60).stdout)["cases"]
        self.cases = {c["id"]: self.about(c) for c in listed if "commit" in c["profiles"]}

    def about(self, case):
        shown = json.loads(run(["build/bin/tripoint", "explain", case["id"], "--json"], self.tree, 60).stdout)
        engines = {"tripoint"} | {d["key"].split(".")[1] for d in shown["decisions"] if d["key"].startswith("engines.")}
        baseline = self.tree / "baselines" / (case["id"] + ".toml")
        runs = tomllib.loads(baseline.read_text()).get("cost", []) if baseline.exists() else []
        counted = {what: sum(run[what] for run in runs) for what in ("pairs", "steps")}
        return {
            "effects": {e["name"] for e in shown["effects"]},
            "engines": engines,
            "cost": counted["pairs"] + 1e4 * counted["steps"],
        }

    def touched(self, file, engine):
        part = file.split("/")[2] if file.startswith("src/effects") else ""
        a_folder = (self.tree / "src/effects" / part).is_dir() and part
        of = [
            c
            for c, about in self.cases.items()
            if (not a_folder or part in about["effects"]) and any(e.startswith(engine) for e in about["engines"])
        ]
        return sorted(of, key=lambda c: self.cases[c]["cost"])

    def varied(self, touched):
        """The cheapest case of each set of effects first, so that the first few see as many terms as they can."""
        seen, first = set(), []
        for case in touched:
            effects = frozenset(self.cases[case]["effects"])
            if effects not in seen:
                seen.add(effects)
                first.append(case)
        return first + [c for c in touched if c not in first]

    def judged(self, case, engine, out, tree=None):
        """(verdict, exit code), and why: an engine that no longer answers leaves the verdict and changes the code."""
        engines = sorted(e for e in self.cases[case]["engines"] if e.startswith(engine))
        results = pathlib.Path(out) / "results.json"
        results.unlink(missing_ok=True)
        done = run(
            [
                "build/bin/tripoint",
                "validate",
                case,
                "--jobs",
                "1",
                "--engines",
                ",".join(engines),
                "--no-history",
                "--no-report",
                "--out",
                out,
            ],
            tree or self.tree,
            900,
        )
        if done is None or not results.exists():
            if done is not None and done.returncode in (
                2,
                130,
            ):  # the command was refused, or stopped: the mutant is not judged
                sys.exit(f"draw_mutants: {case} was not run: {done.stderr.strip()[-300:]}")
            return ("none", -1), "timed out" if done is None else f"exit {done.returncode}"
        verdict = json.loads(results.read_text())["cases"][0]["verdict"]
        return (verdict, done.returncode), next(
            (x.strip() for x in (done.stdout + done.stderr).split("\n") if x.startswith("     ")),
            f"{verdict}, exit {done.returncode}",
        )[:200]

    def red(self, case, engine, out):
        """Why the mutant fails the case; empty where it passes, or where the sound tree fails it too."""
        end, why = self.judged(case, engine, out)
        if end == ("PASS", 0):
            return ""
        if (case, engine) not in self.known:
            self.known[case, engine] = self.judged(case, engine, out + "-sound", self.sound)[0]
        sound = self.known[case, engine]
        return f"{case}: {why}" if sound[0] == "PASS" and end != sound else ""


LAMMPS_SUITES = (
    ("rheo", "LammpsPhase"),
    ("sph_liquid", "LammpsLiquid"),
    ("tlsph", "LammpsElastic"),
    ("layer", "LammpsElastic"),
    ("rigid_flight", "Lammps"),
    ("walker", "LammpsWalkers"),
    ("heat", "LammpsWalkers"),
    ("sph_heat", "LammpsSph"),
)


def suites_of(file):
    """The suites of test-engines that a file of the LAMMPS adapter belongs to; all where it serves several."""
    stem = pathlib.Path(file).stem
    return next((f"{suite}.*:LammpsSph.*" for start, suite in LAMMPS_SUITES if stem.startswith(start)), "*")


def build(targets, options):
    done = run(["nice", "ninja", "-C", "build", "-j", options.jobs] + targets, options.tree, 7200)
    return done is not None and done.returncode == 0


def red_test(tests, file, options):
    tree = options.tree
    for test in tests:
        if not build([f"tests/{test}"], options):
            return f"{test} does not compile"
        only = suites_of(file) if test == "test-engines" else "*"
        done = run([f"build/tests/{test}", "--gtest_fail_fast", "--gtest_brief=1", f"--gtest_filter={only}"], tree, 900)
        if done is None or done.returncode != 0:
            failed = re.findall(r"\[  FAILED  \] ([\w./]+)", done.stdout) if done else []
            return (
                f"{test} "
                f"{failed[0] if failed else 'does not end' if done is None else 'ends with ' + str(done.returncode)}"
            )
    return ""


def red_oracle(file, options):
    """What the sums from the page of the model say of a term of ours."""
    if not file.startswith("src/effects"):
        return ""
    if not build(["tests/write-states"], options):
        return "write-states does not compile"
    done = run(["/usr/bin/python3", "-B", "tests/oracle/oracle.py", "build/tests/write-states"], options.tree, 900)
    return "" if done is not None and done.returncode == 0 else "the oracle"


def judge(mutant, cases, options):
    """What turned red first, or nothing: some quick cases, then the unit tests, then all other cases."""
    _, tests, engine = targets_of(mutant["at"])
    out = str(options.out.with_suffix("")) + "-runs"
    touched = cases.touched(mutant["at"], engine)
    mutant["asked"] = 0

    def red_case(some):
        for case in some:
            mutant["asked"] += 1
            if why := cases.red(case, engine, out):
                return why
        return ""

    if options.cases_only:
        mutant["killed_by"] = red_case(cases.varied(touched)[: options.most])
        return
    first = (
        options.first if mutant["at"].startswith("src/effects") else 0
    )  # an adapter's cases are slower than its tests
    mutant["killed_by"] = (
        red_case(touched[:first])
        or red_test(tests, mutant["at"], options)
        or red_oracle(mutant["at"], options)
        or red_case(touched[first:])
    )


def apply(mutant, cases, options, rooms):
    """The mutant with what came of it: whether it compiles, what killed it."""
    mutant, begun = dict(mutant, compiles=False), time.time()
    if not (place := place_in(options.tree, mutant, rooms)):
        return mutant
    path, lines, n = place
    mutant["at"] = str(path.relative_to(options.tree))
    original, indent = path.read_text(), re.match(r"\s*", lines[n])[0]
    path.write_text("\n".join(lines[:n] + [indent + mutant["new"]] + lines[n + 1 :]))
    try:
        mutant["compiles"] = build(targets_of(mutant["at"])[0], options)
        if mutant["compiles"]:
            judge(mutant, cases, options)
    finally:
        path.write_text(original)
    return dict(mutant, seconds=round(time.time() - begun))


def parser():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--tree", type=pathlib.Path, required=True)
    p.add_argument(
        "--sound",
        type=pathlib.Path,
        default=pathlib.Path(__file__).resolve().parent.parent,
        help="a built tree without a mutant; default this one",
    )
    p.add_argument("--seed", type=int, required=True)
    p.add_argument("--count", type=int, default=20)
    p.add_argument("--jobs", default="2")
    p.add_argument("--first", type=int, default=15, help="quick cases that are asked before the unit tests")
    p.add_argument("--out", type=pathlib.Path, default=pathlib.Path("mutants.json"))
    p.add_argument("--room", action="append", help=f"a folder to draw from; default {', '.join(ROOMS)}")
    p.add_argument("--cases-only", action="store_true", help="ask no unit test")
    p.add_argument("--most", type=int, default=60, help="cases that are asked of a mutant with --cases-only")
    p.add_argument("--from", dest="commit", help="draw from the sources of this commit; default those of --tree")
    p.add_argument("--again", action="store_true", help="judge again what lived")
    p.add_argument("--list", action="store_true", help="only print what would be drawn")
    return p


def read_options():
    options = parser().parse_args()
    options.tree, options.out = options.tree.resolve(), options.out.resolve()
    if options.tree == pathlib.Path(__file__).resolve().parent.parent:
        sys.exit("draw_mutants: --tree is the tree of this script: give a copy, its sources are changed")
    if options.tree == options.sound.resolve():
        sys.exit("draw_mutants: --sound is --tree: what a mutant fails there, it fails here too, and nothing is killed")
    return options


class Campaign:
    """The mutants that were judged, of this and earlier calls, and those that this call has seen."""

    def __init__(self, options, rooms):
        self.options, self.rooms, self.seen = options, rooms, []
        self.done = json.loads(options.out.read_text()) if options.out.exists() else []
        self.cases = None if options.list else Cases(options.tree, options.sound.resolve())

    def take(self, mutant):
        """Judges a mutant, or says why it is not judged."""
        place = f"{mutant['file']}:{mutant['line']} {mutant['kind']}: {mutant['old']}  ->  {mutant['new']}"
        equal = reason_equal(mutant)
        if self.options.list or equal:
            self.say(mutant, "no defect" if equal else "", place, equal)
            return
        judged = self.known(mutant) or self.judged_now(mutant)
        if not judged["compiles"]:
            print(f"      no build  {place}", flush=True)
            return
        killed = judged["killed_by"]
        said = f"{killed}  ({judged['asked']} cases, {judged['seconds']} s)"
        self.say(mutant, "killed  " if killed else "SURVIVES", place, said)

    def say(self, mutant, word, place, why):
        self.seen.append(mutant)
        print(f"{len(self.seen):3}  {word}  {place}\n          {why}", flush=True)

    def known(self, mutant):
        """What came of it before; with --again what lived is forgotten."""
        before = next((m for m in self.done if all(m[k] == mutant[k] for k in ("file", "old", "new"))), None)
        if before and self.options.again and before["compiles"] and not before["killed_by"]:
            self.done.remove(before)
            return None
        return before

    def judged_now(self, mutant):
        judged = apply(mutant, self.cases, self.options, self.rooms)
        self.done.append(judged)
        self.options.out.write_text(json.dumps(self.done, indent=1) + "\n")
        return judged

    def score(self):
        seen = {(m["old"], m["new"]) for m in self.seen}
        killed = sum(bool(m["compiles"] and m["killed_by"] and (m["old"], m["new"]) in seen) for m in self.done)
        equal = sum(bool(reason_equal(m)) for m in self.seen)
        return f"{killed} of {len(self.seen) - equal} killed; {equal} more of {len(self.seen)} are no defects"


def main():
    options = read_options()
    rng, rooms = random.Random(options.seed), options.room or ROOMS
    print(f"seed {options.seed}, {len(sources(options.tree, rooms))} files", flush=True)
    campaign = Campaign(options, rooms)
    drawn_from = sources_of(options.commit) if options.commit else None
    base = pathlib.Path(drawn_from.name) if drawn_from else options.tree
    while len(campaign.seen) < options.count:
        mutant = draw(rng, base, rooms)
        if mutant not in campaign.seen:
            campaign.take(mutant)
    if not options.list:
        build([], options)
        print(campaign.score())


if __name__ == "__main__":
    main()
