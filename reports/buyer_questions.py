# SPDX-License-Identifier: BSD-3-Clause
"""Questions of somebody who must choose an engine, answered from the cells of the page of uses by engines, or from one
case by the preset that does best in it."""

from __future__ import annotations

from typing import NamedTuple

from engine_words import defects_of, named, spoken, with_preset, worst_share
from headlines import case_of, join, runs_of
from model import is_number, rows, table, text

LOSES = 0.01  # share of the energy of spin, above which the page names an engine
SHORTEST = 4  # engines in the answer on costs of a use


def cells_of(grids, name):
    return list(next((cells for grid in grids for use, cells in grid.lines if use.name == name), {}).values())


def with_defects(cells):
    return join(
        [f"{with_preset(cell.engine, cell.preset)}: {join(defects_of(cell.lines)) or 'wrong'}" for cell in cells]
    )


def right_ones(cells):
    """Those that hold every limit, the smallest error first."""
    return sorted((cell for cell in cells if cell.tone == "right"), key=lambda cell: cell.share or 0.0)


def stacks(cells):
    firm = [c for c in cells if "soft contact" not in defects_of(c.lines)]
    soft = [c for c in cells if c not in firm]
    right = right_ones(firm)
    rest = [c for c in firm if c.tone != "right"]
    if not right:
        answer = "None holds every tower and pyramid."
    else:
        answer = f"{named(right)} {'hold' if len(right) > 1 else 'holds'} every tower and pyramid"
        answer += f", the smallest error first. {cheapest(right)}" if len(right) > 1 else "."
    if rest:
        answer += f" Firm, but off elsewhere: {with_defects(rest)}."
    return answer + (f" Soft contact: {named(soft)}." if soft else "")


def cheapest(cells):
    least = min(cells, key=lambda cell: cell.cpu)
    return f"{with_preset(least.engine, least.preset)} takes the least time: {least.cpu:.2g} CPU s a case."


def energy_changes(results, cell):
    """(greatest share of the kinetic energy by which a spin changes it, case)."""
    found = []
    for line in cell.lines:
        case = case_of(results, line["case"])
        for row, run in runs_of(case) if case is not None else ():
            metric = run.metrics.get("energy")
            if (row.name, row.preset) == (cell.engine, cell.preset) and metric is not None and is_number(metric.value):
                found.append((abs(metric.value), line["case"]))
    return max(found, default=None)


def spins(cells, results):
    found = [(change, cell) for cell in cells if (change := energy_changes(results, cell))]
    found.sort(key=lambda entry: entry[0][0])
    keeping = [cell for change, cell in found if change[0] <= LOSES]
    lost = join(
        [
            f"{with_preset(cell.engine, cell.preset)} {share:.0%} in {case.split('/')[-1]}"
            for (share, case), cell in found
            if share > LOSES
        ]
    )
    kept = f"These keep the energy of a free spin to 1 %, the best first: {named(keeping)}." if keeping else ""
    return f"{kept} Others change it by: {lost}.".strip() if lost else kept


def units(share):
    """An error in units of its limit, as a number alone."""
    return f"{share:.2g}" if share < 100 else f"{share:.0f}"


class Best(NamedTuple):
    """An engine in one case, by the preset that does best in it."""

    engine: str
    preset: str
    verdict: str
    share: float  # of the limit
    line: dict

    @property
    def words(self):
        """ "ODE (dWorldStep) 0.22" """
        return f"{with_preset(self.engine, self.preset)} {units(self.share)}"

    @property
    def metric(self):
        return text(table(self.line.get("worst")).get("metric"))

    @property
    def why(self):
        names = defects_of([self.line])
        return f"known defect {names[0]}" if names else "wrong"


def best_in(engines, case):
    """The engines that were judged in a case, the smallest error first."""
    found = []
    for engine, scores in engines.items():
        tried = [
            Best(engine, text(score.get("preset")), line["verdict"], worst_share(line), line)
            for score in scores
            for line in rows(score.get("rows"))
            if line.get("case") == case and worst_share(line) is not None
        ]
        if tried:
            found.append(min(tried, key=lambda best: (best.verdict != "pass", best.share)))
    return sorted(found, key=lambda best: (best.verdict != "pass", best.share))


def by_case(engines, case, doing):
    """Who passes a case, and who does not with the reason. @param doing what those who pass do"""
    found = best_in(engines, case)
    right = [best.words for best in found if best.verdict == "pass"]
    wrong = [f"{best.words} in {best.metric}, {best.why}" for best in found if best.verdict != "pass"]
    if not found:
        return ""
    said = f"Error over its limit in {case}: {join(right)}." if right else f"None {doing}, by {case}."
    return said + (f" Off: {join(wrong)}." if wrong else "")


def bounces(engines, cells):
    said = by_case(engines, "contact/ball-restitution-050", "does")
    slow = [
        with_preset(best.engine, best.preset)
        for best in best_in(engines, "contact/low-bounce")
        if best.verdict == "pass"
    ]
    asked = ("contact/low-bounce", "contact/ball-restitution-050")
    none = named([c for c in cells if any(text(line.get("case")) in asked for line in c.refused)])
    parts = [said, slow and f"Also below 1 m/s: {join(slow)}.", none and f"Without restitution: {none}."]
    return " ".join(filter(None, parts))


def prices(grids):
    """What an error costs, of the uses in which liquids flow."""
    parts = []
    for use in ("Pour", "Float"):
        cells = sorted((c for c in cells_of(grids, use) if c.share is not None), key=lambda cell: cell.share)
        found = [f"{with_preset(c.engine, c.preset)} {units(c.share)} for {c.cpu:.2g} s" for c in cells]
        if found:
            parts.append(f"{use}: {join(found[:SHORTEST])}.")
    return " ".join(["Error over its limit, and CPU seconds a case.", *parts]) if parts else ""


def pours(cells):
    right, rest = right_ones(cells), [c for c in cells if c.tone != "right"]
    off = f" Off: {with_defects(rest)}." if rest else ""
    return f"{named(right) or 'None'}, by the dam break of Martin and Moyce.{off}" if cells else ""


def costs(grids):
    parts = []
    for grid in grids:
        for use, cells in grid.lines:
            right = sorted((c.cpu, c.engine) for c in cells.values() if c.tone == "right" and not c.note)
            if right:
                parts.append(f"{use.name.lower()} {spoken(right[0][1])} {right[0][0]:.2g} s")
    return f"The cheapest engine that is right, in CPU seconds a case: {join(parts)}." if parts else ""


def questions(grids, results, engines):
    """[(question, answer)] @param engines {engine: its presets' scores}"""
    stack = cells_of(grids, "Stack")
    asked = (
        ("Which engine stacks boxes?", stacks(stack) if stack else ""),
        ("Which keeps a fast spin, as of a gyroscope?", spins(cells_of(grids, "Spin"), results)),
        ("Which bounces a ball at restitution 0.5?", bounces(engines, cells_of(grids, "Bounce"))),
        ("Which conducts heat through two materials?", by_case(engines, "heat/two-conductivities", "does")),
        ("Which can pour?", pours(cells_of(grids, "Pour"))),
        ("What does accuracy cost in a pour or a float?", prices(grids)),
        ("Which is cheapest?", costs(grids)),
    )
    return [(question, answer) for question, answer in asked if answer]
