# SPDX-License-Identifier: BSD-3-Clause
"""Which engine for what: one page, uses by engines, from results.json, the scorecard.json beside it, and the runs'
trajectories.

    which_engine.py RESULTS.json [which-engine.html]

Verdicts, errors and shares of limits are the scorecard's. An engine is shown by the preset that does best in a use.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path

import load
import page
import thumbnails
import uses
from buyer_questions import LOSES, energy_changes, questions
from engine_words import defects_of, of_limit, spoken, worst_share
from headlines import case_of, join, own_engines, runs_of
from model import number, rows, table, text
from trajectories import NoTrajectory, read

JUDGED = ("pass", "known defect", "fail", "inconclusive", "diverged", "crashed")


@dataclass
class Cell:
    """An engine in a use, by its best preset."""

    engine: str
    preset: str
    version: str
    lines: list  # the scorecard's rows of the cases that it was judged in
    picture: str = ""
    pictured: str = ""  # the case of the picture
    fell: int = 0  # boxes that fell, over all stacks
    words: str = ""
    note: str = ""  # what a limit that holds does not say
    refused: list = field(default_factory=list)

    @property
    def right(self):
        return sum(line["verdict"] == "pass" for line in self.lines)

    @property
    def asked(self):
        """Cases of the use: those that it was judged in, and those that it refused."""
        return len(self.lines) + len(self.refused)

    @property
    def tone(self):
        wrong = any(line["verdict"] not in ("pass", "known defect") for line in self.lines)
        return "wrong" if wrong else "right" if self.right == len(self.lines) else "known"

    @property
    def share(self):
        """The largest share of a limit that it uses."""
        return max((found for found in map(worst_share, self.lines) if found is not None), default=None)

    @property
    def exceeded(self):
        """Metric and case of the largest share, where it is above its limit."""
        line = max(self.lines, key=lambda line: worst_share(line) or 0.0)
        if (worst_share(line) or 0.0) <= 1.0:
            return ""
        return f"{text(table(line.get('worst')).get('metric'))}, {line['case'].split('/')[-1]}"

    @property
    def cpu(self):
        """CPU seconds a case."""
        return sum(number(line.get("cpu_s")) or 0.0 for line in self.lines) / len(self.lines)


def words_of(use, cell):
    """What the cell says: "stands", "falls: known defect soft contact", "wrong: way 0.79"."""
    fails = "falls" if cell.fell else "off"
    if cell.tone == "right" and len(cell.refused) > len(cell.lines):
        return f"right in the {len(cell.lines)} of {cell.asked} that it takes"
    if cell.tone == "right":
        return use.right
    if cell.tone == "known":
        return f"{fails}: known defect {join(defects_of(cell.lines)[:2])}"
    bad = next(line for line in cell.lines if line["verdict"] not in ("pass", "known defect"))
    return f"{'falls: ' if cell.fell else ''}wrong: {bad['verdict']} in {bad['case'].split('/')[-1]}"


def judged_in(score, use):
    """(the rows of a preset in a use that were judged, those that it refused)."""
    mine = [line for line in rows(score.get("rows")) if uses.belongs(use, text(line.get("case")))]
    refused = [line for line in mine if line.get("verdict") == "refused"]
    return [line for line in mine if line.get("verdict") in JUDGED], refused


def best_preset(scores, use):
    """(score, its judged rows, its refusals) of the preset that is right in most cases, then ran most, then has the
    smallest error.
    """
    found = []
    for score in scores:
        judged, refused = judged_in(score, use)
        right = sum(line["verdict"] == "pass" for line in judged)
        worst = max((worst_share(line) or 0.0 for line in judged), default=0.0)
        if judged:
            found.append(((-right, -len(judged), worst), score, judged, refused))
    return min(found, key=lambda entry: entry[0])[1:] if found else None


def trajectory_of(results, case_id, engine, preset):
    """@return the trajectory of the run at the case's own resolution; None where there is none"""
    case = case_of(results, case_id)
    for row, run in runs_of(case) if case is not None else ():
        if (row.name, row.preset) == (engine, preset):
            try:
                return read(results.folder, run)
            except NoTrajectory:
                return None
    return None


def truth_of(results, case_id, engines):
    """The exact trajectory; where the case has none, that of the engine that ranks first."""
    exact = trajectory_of(results, case_id, "exact", "default")
    if exact is not None:
        return exact
    first = next(
        (
            (name, text(score.get("preset")))
            for name, scores in engines.items()
            for score in scores
            for line in rows(score.get("rows"))
            if line.get("case") == case_id and line.get("rank") == 1
        ),
        None,
    )
    return trajectory_of(results, case_id, *first) if first else None


def illustrate(results, use, cell, engines):
    """Draws the first case of the use that the engine ran, and counts boxes that fell."""
    judged = [line["case"] for line in cell.lines]
    for case in sorted(
        judged, key=lambda case: use.pictured.index(case) if case in use.pictured else len(use.pictured)
    ):
        own = trajectory_of(results, case, cell.engine, cell.preset)
        body = use.draw(own, truth_of(results, case, engines)) if own is not None else None
        if body:
            cell.picture, cell.pictured = thumbnails.svg(body, f"{spoken(cell.engine)}, {case}: {use.shows}"), case
            break
    if use.draw is thumbnails.boxes:
        own = (trajectory_of(results, case, cell.engine, cell.preset) for case in judged)
        cell.fell = sum(thumbnails.fell(t)[0] for t in own if t is not None)


def cell_of(results, use, name, engines):
    best = best_preset(engines[name], use)
    if best is None:
        return None
    score, judged, refused = best
    cell = Cell(name, text(score.get("preset")), text(score.get("version")), judged, refused=refused)
    illustrate(results, use, cell, engines)
    cell.words = words_of(use, cell)
    change = energy_changes(results, cell) if use.name == "Spin" else None
    if change and change[0] > LOSES:
        cell.note = f"its energy changes by {change[0]:.0%}"
    return cell


@dataclass
class Grid:
    """One table: uses by the engines that take at least one of them."""

    title: str
    engines: list
    lines: list  # (use, {engine: cell}, what the pictures show)


def grid_of(title, chosen, results, engines, own):
    lines = []
    for use in chosen:
        cells = {name: cell for name in engines if (cell := cell_of(results, use, name, engines))}
        if cells:
            lines.append((use, cells))
    taken = {name for _, cells in lines for name in cells}
    score = {name: sum(cells[name].tone == "right" for _, cells in lines if name in cells) for name in taken}
    ordered = sorted(taken, key=lambda name: (name not in own, name != "tripoint", -score[name], name))
    return Grid(title, ordered, lines)


# --- the page ---


def read_card(folder):
    try:
        card = json.loads((Path(folder) / "scorecard.json").read_text(encoding="utf-8"))
        return card if isinstance(card, dict) else None
    except (OSError, ValueError):
        return None


def by_name(card):
    """{engine: its presets' scores}; the truth has none."""
    found = {}
    for score in rows(card.get("engines")):
        found.setdefault(text(score.get("engine")), []).append(score)
    return found


def versions_of(grids):
    """ "ODE 0.16.2", each engine once."""
    found = {name: cell.version for grid in grids for _, cells in grid.lines for name, cell in cells.items()}
    return [f"{spoken(name)} {version}" for name, version in sorted(found.items())]


def render(results, home="index.html"):
    """@param home where the title leads; "" where the page stands alone   @return HTML, or "" where fewer than two
    engines were judged
    """
    card = read_card(results.folder)
    engines = by_name(card) if card else {}
    own = own_engines(results)
    grids = [
        grid_of(title, chosen, results, engines, own)
        for title, chosen in (("Rigid bodies", uses.RIGID), ("Liquids, elastic solids and heat", uses.MATTER))
    ]
    grids = [grid for grid in grids if grid.lines]
    if len({name for grid in grids for name in grid.engines}) < 2:
        return ""
    return page.fill(
        "which_engine.html.j2",
        results,
        grids=grids,
        own=own,
        spoken=spoken,
        of_limit=of_limit,
        questions=questions(grids, results, engines),
        home=home,
        versions=versions_of(grids),
    )


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        results = load.load(arguments[0])
    except load.Unreadable as reason:
        print(f"which_engine: {reason}", file=sys.stderr)
        return 2
    html = render(results, home="" if len(arguments) == 2 else "index.html")
    if not html:
        print(f"which_engine: {results.folder}/scorecard.json has no two engines to choose from", file=sys.stderr)
        return 2
    target = Path(arguments[1]) if len(arguments) == 2 else results.folder / "which-engine.html"
    target.write_text(html, encoding="utf-8")
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
