# SPDX-License-Identifier: BSD-3-Clause
"""The page of a scorecard: engines by the limits that any engine must hold, from the scorecard.json that `tripoint
validate --profile acceptance` leaves.

scorecard.py scorecard.json [scorecard.html]
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import foreign
import page
from headline_parts import own_engines
from model import number, ordered, rows, table, text

APART = ("refused", "missing")  # verdicts of a case that did not run: they stand below the table, by reason
TONES = {
    "pass": "pass",
    "fail": "fail",
    "known defect": "open",
    "inconclusive": "open",
    "diverged": "fail",
    "crashed": "fail",
    "not judged": "none",
}
BROKEN = ("missing", "crashed", "not judged")  # why a scorecard ends 4
COLUMNS = ("pass", "fail", "known defect", "inconclusive", "refused", "missing", "crashed", "diverged", "not judged")


def line(row):
    """One case of an engine as the table shows it."""
    order, drift, cost, share = (number(row.get(key)) for key in ("order", "drift", "cost", "share"))
    rank = row.get("rank") or 0
    return {
        "case": text(row.get("case")),
        "title": text(row.get("title")),
        "verdict": text(row.get("verdict")),
        "tone": TONES.get(text(row.get("verdict")), "none"),
        "reason": text(row.get("reason")),
        "cause": text(row.get("cause")),
        "metric": text(row.get("metric")),
        "error": page.show(number(row.get("error"))),
        "unit": text(row.get("unit")),
        "allowed": text(row.get("allowed")),
        "share": share,
        "order": ordered(order, text(row.get("order_class"))),
        "order_metric": text(row.get("order_metric")),
        "drift": page.show(drift),
        "drift_metric": text(row.get("drift_metric")),
        "cpu": page.show(number(row.get("cpu_s"))),
        "cost": page.show(None) if cost is None else f"{cost:.2g}",
        "rank": f"{rank} of {row.get('of')}" if rank else page.show(None),
        "first": rank == 1,
    }


def refused(lines):
    """{verdict and reason: cases}, in the order in which they come."""
    found = {}
    for row in lines:
        if row["verdict"] in APART:
            found.setdefault((row["verdict"], row["reason"]), []).append(row["case"])
    return [{"verdict": verdict, "reason": reason, "cases": cases} for (verdict, reason), cases in found.items()]


def engine(document, own):
    lines = [line(row) for row in rows(document.get("rows"))]
    totals = table(document.get("totals"))
    return {
        "label": text(document.get("label")),
        "version": text(document.get("version")),
        "totals": {name: totals.get(name) or 0 for name in COLUMNS},
        "first": document.get("first") or 0,
        "cpu": page.show(number(document.get("cpu_s"))),
        "own": text(document.get("engine")) in own,
        "lines": [row for row in lines if row["verdict"] not in APART],
        "refused": refused(lines),
    }


def broken(engines):
    """Which engine is missing, crashed or not judged in which cases, as sentences."""
    found = []
    for e in engines:
        for verdict in BROKEN:
            cases = [row["case"] for row in e["lines"] if row["verdict"] == verdict] + [
                case for entry in e["refused"] if entry["verdict"] == verdict for case in entry["cases"]
            ]
            if cases:
                found.append(f"{e['label']}: {verdict} in {', '.join(cases)}.")
    return " ".join(found)


def disagreement(document):
    witnesses = [
        {
            "engine": text(w.get("engine")),
            "verdict": text(w.get("verdict")),
            "tone": TONES.get(text(w.get("verdict")), "none"),
            "error": page.show(number(w.get("error"))),
            "words": text(w.get("words")),
        }
        for w in rows(document.get("engines"))
    ]
    return {
        "case": text(document.get("case")),
        "metric": text(document.get("metric")),
        "unit": text(document.get("unit")),
        "allowed": text(document.get("allowed")),
        "a": text(document.get("a")),
        "b": text(document.get("b")),
        "difference": page.show(number(document.get("difference"))),
        "engines": witnesses,
    }


def hero(document, engines):
    """(heading, its tone): the gate's verdict, and how often an engine of a PASS is off by a known defect."""
    verdict, defects = text(document.get("verdict")), sum(e["totals"]["known defect"] for e in engines)
    if document.get("exit_code") != 0:
        return verdict, "fail"
    return (f"gate {verdict}; physics known defect in {defects} rows", "defect") if defects else (verdict, "pass")


def render(document):
    """@return HTML"""
    own = own_engines(SimpleNamespace(command=text(document.get("command"))))
    engines = [engine(e, own) for e in rows(document.get("engines"))]
    engines.sort(key=lambda e: not e["own"])
    heading, tone = hero(document, engines)
    columns = [
        name for name in COLUMNS if name in ("pass", "fail", "refused") or any(e["totals"][name] for e in engines)
    ]  # of the others only what there is
    return page.fill(
        "scorecard.html.j2",
        SimpleNamespace(tool={}, profile=""),
        document=document,
        heading=heading,
        tone=tone,
        engines=engines,
        columns=columns,
        meaning=page.EXITS.get(text(document.get("exit_code"))),
        broken=broken(engines),
        disagreements=[disagreement(d) for d in rows(document.get("disagreements"))],
        notes=[],
    )


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    source = Path(arguments[0])
    target = Path(arguments[1]) if len(arguments) == 2 else source.parent / "scorecard.html"
    try:
        document = foreign.read(source)
    except (OSError, ValueError) as reason:
        print(f"scorecard: {source}: {reason}", file=sys.stderr)
        return 2
    target.write_text(render(document), encoding="utf-8")
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
