# SPDX-License-Identifier: BSD-3-Clause
"""What stands on the first screen: the verdict in words, what changed since the run before, the gates nearest to their
limits, engines by subject, cost.

Nothing is judged here: verdicts, shares of limits and seconds are those of results.json, of results.previous.json and
of the history."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import load
import summary
from model import is_number

NEAREST = 10
MOVED = 0.05  # a change of a share of a limit below this is not listed: most of it is noise of the machine's seeds
STEP = 0.01  # a relative change of a knob below this is none: a solver's own step follows the last digits of the run
ORDER = ("worse", "better", "moved", "apart", "limit", "new")
WORDS = {"apart": "not comparable", "limit": "new limit"}
KNOBS = {
    "time_step": ("step", 1e3, " ms"),
    "spacing": ("spacing", 1e3, " mm"),
    "support_ratio": ("support ratio", 1, ""),
    "walkers": ("number of walkers", 1, ""),
    "iterations": ("number of iterations", 1, ""),
    "jitter": ("jitter", 1, ""),
    "seed": ("seed", 1, ""),
}


@dataclass
class Change:
    case: object  # None where the case is gone
    where: str  # engine, metric, mode
    before: str
    after: str
    # worse, better, moved (within a band that holds a stated figure, not 0), apart (made at another step or setting),
    # limit (another one is asked) or new
    kind: str
    weight: float  # the largest first

    @property
    def word(self):
        return WORDS.get(self.kind, self.kind)


def count(number, noun):
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def verdict_words(results):
    """One sentence of the verdict; how many cases have each word that is not plain green; known defects by name."""
    gates = [gate for case in results.cases for engine in case.engines for gate in engine.gates]
    headlines = [[word for word in summary.headline(case) if is_reported(word)] for case in results.cases]
    words = summary.tally(summary.DEFECT if summary.is_defect(word) else word for case in headlines for word in case)
    names = Counter(name for case in headlines for word in case for name in defect_names(word))
    return gates_sentence(gates, count(len(results.cases), "case")), words, names.most_common()


def defect_names(word):
    """Of "known defect soft-contact, mass-ratio", in spoken words."""
    listed = word.removeprefix(summary.DEFECT).strip() if summary.is_defect(word) else ""
    return [name.replace("-", " ") for name in listed.split(", ") if name]


def is_reported(word):
    return word in (summary.DIVERGENCE, summary.UNJUDGED, summary.RIGHT, summary.WRONG) or summary.is_defect(word)


def gates_sentence(gates, cases):
    if not gates:
        return "No gate: nothing here was judged."
    held = sum(gate.verdict == "PASS" for gate in gates)
    bad = summary.tally(gate.verdict for gate in gates if gate.verdict != "PASS")
    if not bad:
        return f"{'The one gate holds' if held == 1 else f'All {held} gates hold'}, in {cases}."
    failed = ", ".join(f"{n} {word.lower()}" for word, n in bad.items())
    return f"{held} of {count(len(gates), 'gate')} hold in {cases}; {failed}."


def hero(results):
    """(heading, its tone): the gate's verdict; a PASS with the physics of the cases, where that is not right."""
    found = summary.tally(case.physics for case in results.cases if case.physics not in ("", summary.RIGHT))
    kinds = [word for word in (summary.WRONG, summary.DEFECT, summary.UNKNOWN) if word in found]
    if results.verdict != "PASS" or not kinds:
        return results.verdict, summary.tone(results.verdict)
    said = ", ".join(f"{word} in {count(found[word], 'case')}" for word in kinds)
    return f"gate {results.verdict}; physics {said}", summary.tone(kinds[0])


def keyed(case):
    """[(key, engine, gate)]: several gates may hold one metric, so the key ends with which of them it is."""
    found, seen = [], {}
    for engine in case.engines:
        for gate in engine.gates:
            key = (case.id, engine.label, gate.mode, gate.metric, gate.level)
            seen[key] = seen.get(key, -1) + 1
            found.append(((*key, seen[key]), engine, gate))
    return found


def baseline(results):
    """({gate: (share, verdict, that gate or None, knobs)}, {case id: verdict}, date, the results before or None): of
    the run before, else of the history."""
    before = results_before(results)
    used, verdicts, date = {}, {}, ""
    if before:
        for case in before.cases:
            verdicts[case.id] = case.verdict
            used |= {key: (g.used, g.verdict, g, knobs_of(engine, g)) for key, engine, g in keyed(case)}
        date = str(before.raw.get("date") or "")
    now = str(results.raw.get("date") or "")
    for case in results.cases:
        last = None if case.id in verdicts else last_entry(case, now)
        if last is not None:
            verdicts[case.id], date = last.verdict.upper(), max(date, last.date)
            used |= used_in(last, case)
    return used, verdicts, date, before


def results_before(results):
    path = results.folder / "results.previous.json"
    try:
        return load.load(path) if path.is_file() else None
    except load.Unreadable:
        return None


def last_entry(case, now):
    """The last run of the history before this one."""
    runs = [entry for entry in case.history if not entry.accepted and (not now or entry.date < now)]
    return runs[-1] if runs else None


def used_in(entry, case):
    """Shares of limits by gate; the history does not say which of several gates of one metric it means."""
    several = {key[:-1] for key, _, _ in keyed(case) if key[-1] > 0}
    used = {}
    for (engine, mode, metric, level), (share, _, verdict) in entry.used.items():
        key = (case.id, engine.replace(" (", " · ").rstrip(")"), mode, metric, level)
        if key not in several:
            used[*key, 0] = (share, verdict.upper(), None, {})
    return used


def changes(results):
    """@return {"since", "list": [Change], "worse", "apart": whether one is so, "cases": {case number: one of ORDER},
    "gone", "same"}; None where there is no run before"""
    used, verdicts, date, before = baseline(results)
    if not verdicts:
        return None
    found, marks = [], {}
    for case in results.cases:
        changed, mark = changes_of(case, used, verdicts)
        found += changed
        if mark:
            marks[case.number] = mark
    found.sort(key=lambda change: (ORDER.index(change.kind), -change.weight))
    return {
        "since": date,
        "list": found,
        "worse": any(change.kind == "worse" for change in found),
        "apart": any(change.kind == "apart" for change in found),
        "cases": marks,
        "gone": gone(results, before),
        "bits": bits(results, before),
        "cpu": seconds(results, before),
    }


def changes_of(case, used, verdicts):
    """([Change], one of ORDER or nothing) of a case."""
    if case.id not in verdicts:
        kind, weight = ("worse", 1.0) if case.verdict != "PASS" else ("new", 0.0)
        return [Change(case, "", "not run", case.verdict, kind, weight)], "new"
    compared = (compare(case, engine, gate, used.get(key)) for key, engine, gate in keyed(case))
    found = [change for change in compared if change]
    if found:
        return found, min((change.kind for change in found), key=ORDER.index)
    before = verdicts[case.id]
    if not before or case.verdict == before:
        return [], ""
    kind = "worse" if is_worse(case.verdict, before) else "better"
    return [Change(case, "verdict", before, case.verdict, kind, 10.0)], kind


def is_worse(verdict, before):
    """A word that is no grade counts as worse."""
    grades = summary.GRADES
    return not {verdict, before} <= set(grades) or grades.index(verdict) < grades.index(before)


def gone(results, before):
    """Cases that the run before had, where both were asked for the same."""
    if not before or before.raw.get("what") != results.raw.get("what"):
        return []
    return sorted({case.id for case in before.cases} - {case.id for case in results.cases})


def compare(case, engine, gate, old):
    where = place_of(engine, gate)
    if old is None:
        return Change(case, where, "no gate", gate.verdict, "worse", 5.0) if gate.verdict != "PASS" else None
    share, verdict, before, knobs = old
    if verdict != gate.verdict:
        return Change(case, where, verdict, gate.verdict, "worse" if gate.verdict != "PASS" else "better", 10.0)
    if before is not None and before.allowed != gate.allowed:  # shares of two limits are not compared
        return relimited(case, where, before, gate)
    if not has_moved(share, gate.used):
        return None
    changed = settings_changed(knobs, knobs_of(engine, gate))
    kind = "apart" if changed else direction(share, before, gate)
    return Change(
        case,
        f"{where}: {changed}" if changed else where,
        f"{before.value:.4g}" if before is not None else f"{100 * share:.0f} %",
        f"{gate.value:.4g} (allowed {gate.allowed})" if before is not None else f"{100 * gate.used:.0f} % of the limit",
        kind,
        abs(gate.used - share),
    )


def place_of(engine, gate):
    """Engine, metric, level and mode in words."""
    level = f" at {gate.level:.4g}" if is_number(gate.level) else ""
    return f"{engine.label}, {gate.metric.replace('_', ' ')}{level}{', as printed' if gate.mode == 'paper' else ''}"


def has_moved(share, used):
    return is_number(share) and is_number(used) and abs(used - share) > MOVED and max(share, used) > 0.2


def direction(share, before, gate):
    if before is not None and states_a_figure(before):
        return "moved"
    return "worse" if gate.used > share else "better"


def relimited(case, where, before, gate):
    """Another limit is asked; where the value moved with it, nobody can say which way."""
    moved = (
        is_number(before.value)
        and is_number(gate.value)
        and abs(gate.value - before.value) > MOVED * max(abs(before.value), abs(gate.value))
    )
    if moved:
        return Change(
            case,
            f"{where}: its limit changed",
            f"{before.value:.4g} (allowed {before.allowed})",
            f"{gate.value:.4g} (allowed {gate.allowed})",
            "apart",
            1.0,
        )
    return Change(case, where, before.allowed, gate.allowed, "limit", 0.0)


def states_a_figure(gate):
    """Whether the band holds a figure that is expected, as of a known defect, and not the error 0: nearer to its middle
    is not better then."""
    return bool(gate.band) and not gate.band[0] <= 0.0 <= gate.band[1]


def knobs_of(engine, gate):
    """What the run was made with that a gate judged; {} where no run is that of the gate."""
    of_mode = [run for run in engine.runs if gate.mode in ("", run.mode)]
    run = next(
        (run for run in of_mode if (run.base if gate.level is None else gate.level in run.levels.values())), None
    )
    return {name: run.knob(name) for name in KNOBS} if run is not None else {}


def settings_changed(before, after):
    """ "its step changed, 0.742 to 0.437 ms"; empty where both were made with the same, or nobody knows."""
    found = []
    for name, (word, scale, unit) in KNOBS.items():
        old, new = before.get(name), after.get(name)
        if is_number(old) and is_number(new) and abs(new - old) > STEP * max(abs(old), abs(new)):
            found.append(f"its {word} changed, {scale * old:.4g} to {scale * new:.4g}{unit}")
    return ", ".join(found)


def seconds(results, before):
    """(CPU seconds now, CPU seconds before) of the runs that both have: a new case is no slower program; None without
    such runs."""
    if before is None:
        return None

    def spent(of):
        return {
            (case.id, run.folder): run.cost["cpu_s"]
            for case in of.cases
            for engine in case.engines
            for run in engine.runs
            if run.folder and is_number(run.cost.get("cpu_s"))
        }

    now, then = spent(results), spent(before)
    both = now.keys() & then.keys()
    return (sum(now[key] for key in both), sum(then[key] for key in both)) if both else None


def bits(results, before):
    """(runs with the same bits as before, runs that both have, [(case, run's folder)] of the others); None without a
    run before."""

    def hashes(of):
        return {
            (case.id, engine.label, run.folder): run.state_hash
            for case in of.cases
            for engine in case.engines
            for run in engine.runs
            if run.state_hash
        }

    if before is None:
        return None
    now, then = hashes(results), hashes(before)
    cases = {case.id: case for case in results.cases}
    both = [key for key in now if key in then]
    others = [(cases[key[0]], key[2].removeprefix("runs/")) for key in both if now[key] != then[key]]
    return len(both) - len(others), len(both), others


def is_whole(gate):
    """Whether it asks for all of something, up to a rounding, and has all: such a gate uses its limit to the last
    thousandth and is in no danger."""
    return (
        gate.at_least is not None
        and 0.99 <= gate.at_least <= 1.0
        and is_number(gate.value)
        and abs(gate.value - 1.0) < 1e-9
    )


def nearest(results):
    """[(share, case, engine, gate)]: the ten gates that use most of their limits, broken ones first."""
    found = [
        (gate.used, case, engine, gate)
        for case in results.cases
        for engine in case.engines
        for gate in engine.gates
        if is_number(gate.used) and not is_whole(gate)
    ]
    return sorted(found, key=lambda entry: (entry[3].verdict == "PASS", -entry[0]))[:NEAREST]


def worst_share(case):
    shares = [gate.used for engine in case.engines for gate in engine.gates if is_number(gate.used)]
    return max(shares, default=None)


def subjects(results):
    """(names of subjects, [(engine, {subject: (word, text)})], engines that ran nowhere): presets of one engine count
    together."""
    names = list(dict.fromkeys(case.subject for case in results.cases))
    rows, nowhere = {}, []
    for name in dict.fromkeys(engine.name for case in results.cases for engine in case.engines):
        here = [(case, [engine for engine in case.engines if engine.name == name]) for case in results.cases]
        if all(engine.status == "missing" for _, engines in here for engine in engines):
            nowhere.append(name)
            continue
        rows[name] = {
            subject: square([(case, engines) for case, engines in here if case.subject == subject and engines])
            for subject in names
        }
    return names, list(rows.items()), nowhere


def square(entries):
    """(word, what to write) of one engine in one subject; None where no case of it names the engine."""
    words = [[word for engine in engines for _, word in summary.standings(case, engine)] for case, engines in entries]
    words = [found for found in words if found]
    bad = [word for found in words for word in found if is_bad(word)]
    if bad:
        return summary.worst(bad), f"{having(words, bad.__contains__)} of {len(words)}"
    green = having(words, expected)
    if green:
        return best_word(entries), str(green)
    for word in (summary.UNJUDGED, "refused", "missing"):
        if number := having(words, word.__eq__):
            return word, str(number)
    return None


def having(words, asked):
    """The number of cases in which one word at least is as asked."""
    return sum(any(map(asked, found)) for found in words)


def expected(word):
    return word in ("PASS", summary.AS_EXPECTED, summary.DIVERGENCE) or summary.is_defect(word)


def is_bad(word):
    return not expected(word) and summary.tone(word) in ("fail", "open", "none")


def best_word(entries):
    """The word of a green square, which a printed form alone does not set."""
    said = {
        word
        for case, engines in entries
        for engine in engines
        for mode, word in summary.standings(case, engine)
        if mode != "paper"
    }
    lesser = (summary.DEFECT, summary.AS_EXPECTED)
    return next((word for word in lesser if any(found.startswith(word) for found in said)), "PASS")


def cost(results):
    """(CPU seconds of all runs, [(engine, s)], [(case, s)]), dearest first."""
    engines, cases = {}, {}
    for case in results.cases:
        for engine in case.engines:
            spent = sum(run.cost["cpu_s"] for run in engine.runs if is_number(run.cost.get("cpu_s")))
            engines[engine.name] = engines.get(engine.name, 0.0) + spent
            cases[case.number] = cases.get(case.number, 0.0) + spent

    def dearest(of):
        return sorted(((key, s) for key, s in of.items() if s > 0), key=lambda entry: -entry[1])

    return (
        sum(engines.values()),
        dearest(engines),
        {number: s for number, s in cases.items()},
        [(results.cases[number], s) for number, s in dearest(cases)[:3]],
    )
