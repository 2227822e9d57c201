# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the page that are put together from several places of results.json: the matrix, counts, engines, what is
not validated."""

from __future__ import annotations

from model import is_number, text

GRADES = ("DIVERGED", "FAIL", "MISSING", "INCONCLUSIVE", "NO VERDICT", "PASS")  # worst first
KINDS = {"verification": "an exact solution", "validation": "an experiment", "comparison": "another engine"}


RIGHT, DEFECT, WRONG, UNKNOWN = "right", "known defect", "wrong", "not known"  # physics, as results.json says it
AS_EXPECTED = (
    "as expected"  # a gate that holds a value that is not right: PASS, which is green, stands beside right values alone
)
DIVERGENCE, UNJUDGED = "expected divergence", "not judged"
TONES = {
    "PASS": "pass",
    "OK": "pass",
    "EQUIVALENT": "pass",
    "FAIL": "fail",
    "DIVERGED": "fail",
    "KILLED": "fail",
    "ERROR": "fail",
    "TIMEOUT": "fail",
    "DIFFERENT": "fail",
    "REFUSED": "refused",
    "MISSING": "missing",
    RIGHT.upper(): "pass",
    WRONG.upper(): "fail",
    UNKNOWN.upper(): "open",
    DIVERGENCE.upper(): "diverges",
    UNJUDGED.upper(): "unjudged",
    "INTERRUPTED": "open",
}


def tone(verdict):
    """The look of a word: each tone has its own sign and border, so that none is told by colour alone."""
    verdict = verdict.upper()
    return TONES.get(verdict) or (
        "defect"
        if is_defect(verdict.lower())
        else "open"
        if verdict.startswith(("INCONCLUSIVE", "UNRESOLVED", "NEGLIGIBLE"))
        else "none"
    )


def is_defect(word):
    return word.startswith(DEFECT)


def gate_word(verdict, physics):
    """What the gate says. @param physics: of the value that it judged"""
    return AS_EXPECTED if verdict == "PASS" and physics != RIGHT else verdict


def physics_word(physics, defects=()):
    """ "right", "wrong", "known defect soft-contact"."""
    names = ", ".join(dict.fromkeys(name for name in defects if name))
    return f"{DEFECT} {names}" if physics == DEFECT and names else physics


def physics_of(gates):
    """The word of several gates: the worst that one of them says."""
    said = {gate.physics for gate in gates}
    return next(
        (
            physics_word(word, (gate.defect for gate in gates))
            for word in (WRONG, DEFECT, UNKNOWN, RIGHT)
            if word in said
        ),
        "",
    )


def worst(verdicts):
    verdicts = list(verdicts)
    unknown = [v for v in verdicts if v not in GRADES]
    return unknown[0] if unknown else min(verdicts, key=GRADES.index) if verdicts else ""


def declared_divergence(case, mode):
    """Whether the case passes because it diverges in this mode, as it says that it will."""
    return case.verdict == "PASS" and (
        text(case.raw.get("expect")) == "diverges"
        or text(case.raw.get("expect")) == "paper-diverges"
        and mode in ("paper", "")
    )


def standing(case, engine, mode=""):
    """One word for an engine in a case (in one mode): the worst of its gates, what was expected of it, or why there is
    no gate."""
    gates = [gate for gate in engine.gates if not mode or gate.mode in (mode, "")]
    runs = [run.status for run in engine.runs if not mode or run.mode in (mode, "")]
    verdict = worst(gate.verdict for gate in gates)
    if verdict not in ("", "PASS"):
        return verdict
    if declared_divergence(case, mode) and "diverged" in (runs or [engine.status]):
        return DIVERGENCE
    if verdict == "PASS":
        physics = physics_of(gates)
        return physics if is_defect(physics) else gate_word(verdict, physics)
    return UNJUDGED if engine.status == "ok" else engine.status


def standings(case, engine):
    """[(mode, word)], one without a name where the engine has one mode."""
    return [(mode if len(engine.modes) > 1 else "", standing(case, engine, mode)) for mode in engine.modes]


def gates_of(case):
    return [gate for engine in case.engines for gate in engine.gates]


def headline(case):
    """The words of a case: its gate's, its physics', and what it expected beside."""
    words = [word for engine in case.engines for _, word in standings(case, engine)]
    diverged = DIVERGENCE in words
    if diverged and case.verdict == "PASS" and text(case.raw.get("expect")) == "diverges":
        return [DIVERGENCE]
    gates = gates_of(case)
    gate = gate_word(case.verdict, case.physics) if case.verdict != "PASS" or gates or diverged else UNJUDGED
    physics = physics_word(case.physics, (gate.defect for gate in gates if gate.physics == DEFECT))
    return [gate] + [word for word in (physics, DIVERGENCE if diverged else "") if word not in ("", UNKNOWN)]


def ran(case):
    return [engine for engine in case.engines if engine.status not in ("missing", "refused")]


def counts(results):
    gates = [gate for case in results.cases for gate in gates_of(case)]
    runs = [run for case in results.cases for engine in case.engines for run in engine.runs]
    return {
        "cases": tally(case.verdict for case in results.cases),
        "gates": tally(gate.verdict for gate in gates),
        "engines": tally(engine.status for case in results.cases for engine in case.engines),
        "runs": tally(run.status for run in runs),
        "cpu": sum(run.cost["cpu_s"] for run in runs if is_number(run.cost.get("cpu_s"))),
    }


def tally(words):
    found = {}
    for word in words:
        found[word] = found.get(word, 0) + 1
    return dict(
        sorted(found.items(), key=lambda entry: (GRADES.index(entry[0]) if entry[0] in GRADES else 99, entry[0]))
    )


def engine_table(results):
    """One row a name and version; library, hash and capabilities from `engines` of the file, where it has them."""
    infos = infos_of(results)
    table = {}
    for engine in (engine for case in results.cases for engine in case.engines):
        row = table.setdefault(engine.name, new_row(engine.name, infos.get(engine.name, {})))
        for key, value in (("versions", engine.version), ("presets", engine.preset)):
            if value and value not in row[key]:
                row[key].append(value)
        row["cases"] += 1
        row["ok"] += engine.status == "ok"
        library = engine.raw.get("library") or row["info"].get("library")
        if isinstance(library, dict) and not row["library"]:
            row["library"] = library
    for name, info in infos.items():
        if name not in table and isinstance(name, str):
            library = info.get("library") if isinstance(info.get("library"), dict) else {}
            table[name] = new_row(name, info) | {"versions": [str(info.get("version", ""))], "library": library}
    return list(table.values())


def infos_of(results):
    """{engine name: what it says of itself}"""
    rows = results.raw.get("engines")
    rows = list(rows.values()) if isinstance(rows, dict) else rows if isinstance(rows, list) else []
    return {row.get("name"): row for row in rows if isinstance(row, dict)}


def new_row(name, info):
    return {"name": name, "versions": [], "presets": [], "library": {}, "cases": 0, "ok": 0, "info": info}


def not_validated(results):
    """What a reader must not take from this page, found in the results themselves."""
    cases = results.cases
    stated = results.raw.get("not_validated")
    lines = [line for line in stated if isinstance(line, str)] if isinstance(stated, list) else []
    kinds = {case.kind for case in cases}
    lines += [
        f"No case of kind {kind}: nothing here was compared with {against}."
        for kind, against in KINDS.items()
        if kind not in kinds
    ]
    for name in dict.fromkeys(engine.name for case in cases for engine in case.engines):
        lines += engine_gaps(cases, name)
    unsettled = [case.id for case in cases if case.verdict not in ("PASS", "FAIL")]
    lines += listed("Without a clear verdict:", unsettled)
    unsure = [case.id for case in cases if case.reference.get("uncertainty") is None]
    lines += listed("Reference states no uncertainty:", unsure)
    lines.append(
        "Verdicts hold for the scenes, resolutions, engines and versions listed here, and say nothing of others."
    )
    return lines


def listed(words, ids):
    return [f"{words} {', '.join(ids)}."] if ids else []


def engine_gaps(cases, name):
    """Cases in which this engine gave no result, or was judged by no gate."""
    lines = []
    here = [(case, engine) for case in cases for engine in case.engines if engine.name == name]
    absent = [(case, engine) for case, engine in here if engine.status != "ok"]
    if len(absent) == len(here):
        lines.append(f"{name}: ran no case ({absent[0][1].status}: {absent[0][1].reason or 'no reason stated'}).")
    else:
        lines += listed(f"{name}: no result for", [f"{case.id} ({engine.status})" for case, engine in absent])
    ungated = dict.fromkeys(case.id for case, engine in here if standing(case, engine) == UNJUDGED)
    if ungated and name != "exact":
        lines.append(f"{name}: ran without any gate in {', '.join(ungated)}; its numbers are shown, not judged.")
    return lines
