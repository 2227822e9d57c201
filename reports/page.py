# SPDX-License-Identifier: BSD-3-Clause
"""Fills the templates: one HTML file that needs nothing else."""
from __future__ import annotations

import math
import time
from pathlib import Path

import ablation
import digit_cost
import paper_figures
import printed
import side_by_side
import signable
import stability
import stability_peers
import summary
import table1
from model import is_number, number

TEMPLATES = Path(__file__).resolve().parent / "templates"
EXITS = {"0": "pass", "1": "accuracy, order or an invariant fails", "2": "bad input", "3": "inconclusive", "4": "a required engine, reference or metric is missing", "5": "the gate's self-test failed",
         "6": "cost regression only", "7": "a run diverged", "130": "interrupted"}


def show(value):
    """A number as text; what is absent and what was not finite look different."""
    if value is None:
        return "—"
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return str(value)
    if math.isnan(value):
        return "not finite"
    if math.isinf(value):
        return "infinite"
    if value == 0:
        return "0"
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    if 1e-3 <= abs(value) < 9999.5:
        return f"{value:.4g}"
    mantissa, exponent = f"{value:.3e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def size(value):
    return "—" if not is_number(value) else f"{value / 1e6:.0f} MB" if value >= 1e6 else f"{value / 1e3:.0f} kB"


def percent(value):
    """How much of a limit is used."""
    if not is_number(value):
        return "—"
    return f"{100 * value:.0f} %" if value < 9.995 else f"{value:.3g} times" if value < 1e6 else "far above"


def anchor(case):
    return f"case-{case.number + 1}"


def terms(ledgers):
    """Every term of any ledger, the residual last."""
    found = list(dict.fromkeys(term for _, entries in ledgers for term in entries))
    return [term for term in found if term != "residual"] + [term for term in found if term == "residual"]


def measure(metric):
    """How a metric is formed, in words."""
    body, at, scale = metric.get("body"), metric.get("at"), metric.get("scale")
    words = [f"{metric.get('norm', 'norm not stated')} of {metric.get('quantity', 'a quantity not stated')}"]
    words += [f"of body {body}"] if body else []
    words += [f"at {at}"] if at not in (None, "") else []
    words += [f"divided by {show(scale)}"] if scale not in (None, 1, 1.0) else []
    return " ".join(words) + (f" ({metric['unit']})" if metric.get("unit") else "")


def truth(row, case, side):
    """Error to the reference of one side of an equivalence: as stated, else of that engine's gate or finest run."""
    if number(row.get(f"error_{side}")) is not None:
        return number(row[f"error_{side}"])
    for engine in case.engines:
        if row.get(side) in (engine.label, engine.name):
            gate = next((g for g in engine.gates if g.metric == row.get("metric")), None)
            run = next((r for r in reversed(engine.runs) if row.get("metric") in r.metrics), None)
            return gate.value if gate else run.metrics[row["metric"]].value if run else None
    return None


def fill(template, results, **more):
    import jinja2
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(show=show, size=size, percent=percent, tone=summary.tone, anchor=anchor, terms=terms, measure=measure, truth=truth)
    return environment.get_template(template).render(results=results, written=time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()), **more)


def render_printed(results):
    """@return HTML of the page that lists what the printed equations get wrong"""
    found, notes = printed.read(results)
    return fill("printed.html.j2", results, rows=found, notes=notes, tally=summary.tally(row.verdict for row in found))


def render_table1(results):
    """@return HTML of the paper's table of features beside what was measured"""
    features, systems, films, notes = table1.read(results)
    return fill("table1.html.j2", results, features=features, systems=systems, films=films, notes=notes, columns=table1.COLUMNS, predicted=table1.PREDICTED)


def render_stability(results, out):
    """@return HTML of the map of stable steps and of the hard cases"""
    frontiers, drawing, listed, notes = stability.read(results, out)
    hits, contact, peers, engines, more = stability_peers.drawings(out)
    return fill("stability.html.j2", results, frontiers=frontiers, drawing=drawing, listed=listed, notes=notes + more, columns=stability.COLUMNS, hits=hits, contact=contact, peers=peers, peer_drawing=engines)


def render_figures(results):
    """@return HTML of the paper's figures: claims met, and the time of a frame"""
    rows = paper_figures.read(results)
    full = any("full-size" in table1.tags(row.case) for row in rows)
    return fill("paper_figures.html.j2", results, rows=rows, full=full, notes=[], papers_frame=paper_figures.PAPERS_FRAME)


def render_gallery(results, films):
    """@param films: case, file name, why there is none, end [s], tone of the verdict   @return HTML of the paper's figures in motion"""
    return fill("gallery.html.j2", results, films=films, notes=[])


def render_digit_cost(results, out):
    """@return HTML of what a tenth of the error costs, over cases and engines"""
    ladders, notes = digit_cost.read(results), []
    try:
        picture = digit_cost.draw(ladders, out)
    except Exception as error:  # no library, or odd data: the table stands without its figure
        picture, notes = None, [f"the figure could not be drawn: {error}"]
    return fill("digit_cost.html.j2", results, ladders=ladders, picture=picture, notes=notes)


def render_ablation(results):
    """@return HTML of what each correction buys"""
    terms, rows, notes = ablation.read(results.folder)
    return fill("ablation.html.j2", results, terms=terms, rows=rows, notes=notes, means=ablation.MEANS, picked=ablation.best(rows, terms), worse=ablation.WORSE, most=ablation.MOST)


def render_side_by_side(results):
    """@return HTML of every engine beside every other"""
    return fill("side_by_side.html.j2", results, comparisons=side_by_side.read(results), notes=[])


def render_headline(results, found, others):
    """@return HTML of one question that engines are chosen by"""
    return fill("headline.html.j2", results, page=found, others=others, notes=[])


def render_signable(results):
    """@return HTML of the report that is signed; its PDF is made of it"""
    return fill("signable.html.j2", results, **signable.context(results))


def render(results, pictures, notes, suite, missing_libraries, headlines=()):
    """@param pictures, notes: case number -> list   @param suite: pictures of all cases   @return HTML"""
    columns = summary.columns(results)
    return fill(
        "report.html.j2", results,
        columns=columns, cells={(case.number, label): summary.cell(case, label) for case in results.cases for label in columns},
        counts=summary.counts(results), engines=summary.engine_table(results), gaps=summary.not_validated(results), pictures=pictures, notes=notes, suite=suite,
        missing=missing_libraries, headlines=headlines, proof=signable.selftest_document(results.folder), meaning=EXITS.get(results.exit_code, "not one of the codes of the contracts"))
