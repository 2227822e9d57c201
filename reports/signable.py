# SPDX-License-Identifier: BSD-3-Clause
"""The report that an engineer signs: every requirement with its case, metric and verdict, from results.json alone. HTML
first, PDF by weasyprint."""

from __future__ import annotations

import hashlib
import shutil
import subprocess

import foreign
import summary
from model import number, rows, table, text


def requirements(results):
    """(requirement, case, [(engine, gate)]) in the order of their names; a case without one stands last."""
    listed = [
        (
            case.requirement or "(none stated)",
            case,
            [(engine, gate) for engine in case.engines for gate in engine.gates],
        )
        for case in results.cases
    ]
    return sorted(listed, key=lambda entry: (entry[0] == "(none stated)", entry[0], entry[1].id))


def orders(results):
    """Code verification: every fitted order that has a formal one, with the uncertainty estimated from the grids alone
    and the true error."""
    found = []
    for case in results.cases:
        for engine in case.engines:
            for raw in rows(engine.raw.get("order")):
                gci, errors = raw.get("numerical"), raw.get("error")
                last = number(gci[-1]) if isinstance(gci, list) and gci else None
                error = number(errors[-1]) if isinstance(errors, list) and errors else None
                found.append((case, engine, raw, last, error))
    return found


def budgets(results):
    """Gated values that carry an uncertainty: (case, engine, gate as written, budget)."""
    found = []
    for case in results.cases:
        for engine in case.engines:
            for raw in rows(engine.raw.get("gates")):
                budget = {name: number(part) for name, part in table(raw.get("budget")).items()}
                if any(part for part in budget.values()):
                    found.append((case, engine, raw, budget))
    return found


def waivers(results):
    """Gates whose limit stands by a dated reason, and cases whose pass is a defect or a divergence that was
    declared."""
    dated = [
        (case, text(raw.get("metric")), text(raw.get("date")), text(raw.get("reason")))
        for case in results.cases
        for raw in rows(case.raw.get("gates"))
        if text(raw.get("date"))
    ]
    declared = [
        (case, "the case itself", "", f"expects {text(case.raw.get('expect'))}")
        for case in results.cases
        if text(case.raw.get("expect"), "pass") != "pass"
    ]
    return declared + dated


def selftest(folder):
    """What `tripoint gate selftest --out` has left beside the results, line by line; empty where it was not run
    there."""
    for path in (folder / "selftest.txt", folder / "selftest" / "selftest.txt"):
        if path.exists():
            return path.read_text(encoding="utf-8", errors="replace").splitlines()
    return []


def selftest_document(folder):
    """selftest.json of the same place; empty where there is none."""
    for path in (folder / "selftest.json", folder / "selftest" / "selftest.json"):
        try:
            raw = foreign.read(path)
        except (OSError, ValueError, RecursionError):
            continue
        if isinstance(raw, dict):
            return {
                "defects": rows(raw.get("defects")),
                "harmless": rows(raw.get("harmless")),
                "smallest": rows(raw.get("smallest")),
                "growth": number(raw.get("smallest_growth")),
                "exit_code": raw.get("exit_code"),
            }
    return {}


def raw_hash(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def context(results):
    return {
        "requirements": requirements(results),
        "orders": orders(results),
        "budgets": budgets(results),
        "waivers": waivers(results),
        "gaps": summary.not_validated(results),
        "counts": summary.counts(results),
        "engines": summary.engine_table(results),
        "selftest": selftest(results.folder),
        "proof": selftest_document(results.folder),
        "hash": raw_hash(results.folder / "results.json")
        if (results.folder / "results.json").exists()
        else "not known",
    }


def to_pdf(html, pdf):
    """@return why there is no PDF; empty when it is written"""
    program = shutil.which("weasyprint")
    if not program:
        return "no PDF: weasyprint is not installed. Type:  apt-get install weasyprint"
    part = pdf.with_suffix(".part.pdf")
    done = subprocess.run([program, "--quiet", str(html), str(part)], capture_output=True, text=True)
    if done.returncode != 0 or not part.exists():
        return f"no PDF: weasyprint ended with {done.returncode}: {done.stderr.strip()[-300:]}"
    part.replace(pdf)
    return ""
