# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the page that are put together from several places of results.json: the matrix, counts, engines, what is not validated."""
from __future__ import annotations

from dataclasses import dataclass, field

from model import is_number

GRADES = ("DIVERGED", "FAIL", "MISSING", "INCONCLUSIVE", "NO VERDICT", "PASS")  # worst first
KINDS = {"verification": "an exact solution", "validation": "an experiment", "comparison": "another engine"}


@dataclass
class Cell:
    """One case by one engine: a word, its tone, what stands behind it."""
    word: str = ""
    tone: str = "none"
    detail: str = ""
    reason: str = ""
    modes: list = field(default_factory=list)  # (mode, word, tone) where there are several


def tone(verdict):
    verdict = verdict.upper()
    if verdict in ("PASS", "OK", "EQUIVALENT"):
        return "pass"
    if verdict in ("FAIL", "DIVERGED", "KILLED", "ERROR", "TIMEOUT", "DIFFERENT"):
        return "fail"
    if verdict.startswith(("INCONCLUSIVE", "UNRESOLVED", "NEGLIGIBLE")):
        return "open"
    return "none"


def worst(verdicts):
    verdicts = list(verdicts)
    unknown = [v for v in verdicts if v not in GRADES]
    return unknown[0] if unknown else min(verdicts, key=GRADES.index) if verdicts else ""


def columns(results):
    """Engine and preset, in the order in which they first appear; one that is nowhere here, and need not be, is in the table of engines only."""
    here = {engine.label for case in results.cases for engine in case.engines if engine.status != "missing" or engine.required}
    return [label for label in dict.fromkeys(engine.label for case in results.cases for engine in case.engines) if label in here]


def cell(case, label):
    engines = [engine for engine in case.engines if engine.label == label]
    if not engines:
        return Cell(word="—", detail="not asked", reason="the case does not list this engine")
    engine = engines[0]
    verdict = worst(gate.verdict for gate in engine.gates)
    failing = [f"{g.metric}{' (' + g.mode + ')' if g.mode else ''}: {g.why or g.verdict.lower()}" for g in engine.gates if g.verdict != "PASS"]
    reason = "; ".join(filter(None, [engine.reason] + failing))
    if not engine.gates:
        word = engine.status if engine.status != "ok" else "ran"
        return Cell(word, tone(word) if word != "ran" else "none", "no gate" if word == "ran" else "", reason or ("ran; the case sets no gate on this engine" if word == "ran" else ""))
    passed = sum(gate.verdict == "PASS" for gate in engine.gates)
    detail = f"{passed} of {len(engine.gates)} gates" + (f", {engine.status}" if engine.status != "ok" else "")
    modes = list(dict.fromkeys(gate.mode for gate in engine.gates if gate.mode))
    each = [(mode, w, tone(w)) for mode in modes for w in [worst(g.verdict for g in engine.gates if g.mode == mode)]]
    return Cell(verdict, tone(verdict), detail, reason, each if len(each) > 1 else [])


def counts(results):
    gates = [gate for case in results.cases for engine in case.engines for gate in engine.gates]
    runs = [run for case in results.cases for engine in case.engines for run in engine.runs]
    return {"cases": tally(case.verdict for case in results.cases), "gates": tally(gate.verdict for gate in gates),
            "engines": tally(engine.status for case in results.cases for engine in case.engines), "runs": tally(run.status for run in runs),
            "cpu": sum(run.cost["cpu_s"] for run in runs if is_number(run.cost.get("cpu_s")))}


def tally(words):
    found = {}
    for word in words:
        found[word] = found.get(word, 0) + 1
    return dict(sorted(found.items(), key=lambda entry: (GRADES.index(entry[0]) if entry[0] in GRADES else 99, entry[0])))


def engine_table(results):
    """One row a name and version; library, hash and capabilities from `engines` of the file, where it has them."""
    told = results.raw.get("engines")
    told = told if isinstance(told, list) else list(told.values()) if isinstance(told, dict) else []
    told = {row.get("name"): row for row in told if isinstance(row, dict)}
    table = {}
    for case in results.cases:
        for engine in case.engines:
            row = table.setdefault(engine.name, {"name": engine.name, "versions": [], "presets": [], "library": {}, "cases": 0, "ok": 0, "info": told.get(engine.name, {})})
            for key, value in (("versions", engine.version), ("presets", engine.preset)):
                if value and value not in row[key]:
                    row[key].append(value)
            row["cases"] += 1
            row["ok"] += engine.status == "ok"
            library = engine.raw.get("library") or row["info"].get("library")
            if isinstance(library, dict) and not row["library"]:
                row["library"] = library
    for name, info in told.items():
        if name not in table and isinstance(name, str):
            table[name] = {"name": name, "versions": [str(info.get("version", ""))], "presets": [], "library": info.get("library") if isinstance(info.get("library"), dict) else {},
                           "cases": 0, "ok": 0, "info": info}
    return list(table.values())


def not_validated(results):
    """What a reader must not take from this page, found in the results themselves."""
    lines = [str(line) for line in results.raw.get("not_validated", []) or [] if isinstance(line, str)] if isinstance(results.raw.get("not_validated"), list) else []
    kinds = {case.kind for case in results.cases}
    lines += [f"No case of kind {kind}: nothing here was compared with {against}." for kind, against in KINDS.items() if kind not in kinds]
    for name in dict.fromkeys(engine.name for case in results.cases for engine in case.engines):
        here = [(case, engine) for case in results.cases for engine in case.engines if engine.name == name]
        absent = [(case, engine) for case, engine in here if engine.status != "ok"]
        if len(absent) == len(here):
            lines.append(f"{name}: ran no case ({absent[0][1].status}: {absent[0][1].reason or 'no reason stated'}).")
        elif absent:
            lines.append(f"{name}: no result for " + ", ".join(f"{case.id} ({engine.status})" for case, engine in absent) + ".")
        ungated = [case.id for case, engine in here if engine.status == "ok" and not engine.gates]
        if ungated and name != "exact":
            lines.append(f"{name}: ran without any gate in {', '.join(dict.fromkeys(ungated))}; its numbers are shown, not judged.")
    open_cases = [case.id for case in results.cases if case.verdict not in ("PASS", "FAIL")]
    if open_cases:
        lines.append("Without a clear verdict: " + ", ".join(open_cases) + ".")
    unsure = [case.id for case in results.cases if case.reference.get("uncertainty") is None]
    if unsure:
        lines.append("Reference states no uncertainty: " + ", ".join(unsure) + ".")
    lines.append("Verdicts hold for the scenes, resolutions, engines and versions listed here, and say nothing of others.")
    return lines
