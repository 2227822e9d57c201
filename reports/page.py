# SPDX-License-Identifier: BSD-3-Clause
"""Fills the templates: HTML files that need nothing else."""

from __future__ import annotations

import base64
import functools
import hashlib
import math
import shlex
import time
from pathlib import Path

import ablation
import digit_cost
import front
import paper_figures
import printed
import side_by_side
import signable
import stability
import stability_peers
import summary
import table1
from model import COUNTED, is_number, number

TEMPLATES = Path(__file__).resolve().parent / "templates"
VENDOR = Path(__file__).resolve().parent / "vendor"  # Tabulator as npm has it; tests/reports holds its hash
WRITES_TO = ("--out", "--history", "--to")
EXITS = {
    "0": "pass",
    "1": "accuracy, order or an invariant fails",
    "2": "bad input",
    "3": "inconclusive",
    "4": "a required engine, reference or metric is missing",
    "5": "the gate's self-test failed",
    "6": "cost regression only",
    "7": "a run diverged",
    "130": "interrupted",
}


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


def page_of(case, up=""):
    """Where the case stands, seen from the report's folder."""
    return f"{up}case/{case.slug}.html"


def of_one_value(gates):
    """[[gate]]: gates that judge the same value stand together, in the order in which values come first."""
    found = {}
    for gate in gates:
        found.setdefault((gate.metric, gate.mode, gate.level), []).append(gate)
    return list(found.values())


def worded(value, metric):
    """A metric's value; 0 of a count or of a difference of counts is said in a word, so that nobody takes it for
    nothing."""
    return "0, equal" if value == 0 and metric and metric.get("quantity") in COUNTED else show(value)


def script_hash(script):
    """What the page's policy lets run: this text and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


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


def portable(command):
    """A command as it can be typed elsewhere: of a place on this machine the name is enough."""
    try:
        words = shlex.split(command or "")
    except ValueError:
        return command
    for n, word in enumerate(words):
        option, sign, value = word.partition("=") if word.startswith("-") else ("", "", word)
        written = option in WRITES_TO or (n and words[n - 1] in WRITES_TO)
        here = [Path(v).name or "." if v and (written or v[0] in "/~") else v for v in value.split(",")]
        words[n] = option + sign + ",".join(here)
    return shlex.join(words)


@functools.lru_cache
def environment():
    import jinja2

    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    made.filters.update(
        show=show,
        portable=portable,
        times=digit_cost.times,
        size=size,
        percent=percent,
        tone=summary.tone,
        page=page_of,
        terms=terms,
        measure=measure,
        truth=truth,
        gate_word=summary.gate_word,
        physics_word=summary.physics_word,
        hash=script_hash,
        of_one_value=of_one_value,
        worded=worded,
        turn=lambda kind: front.WORDS.get(kind, kind),
        headline=summary.headline,
        standings=summary.standings,
        ran=summary.ran,
        share=front.worst_share,
    )
    return made


def fill(template, results, **more):
    return (
        environment()
        .get_template(template)
        .render(
            results=results,
            written=time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime()),
            **{"up": "", "scripts": [], "notes": [], **more},
        )
    )


def vendor(name):
    """A library's file without the line that names its source map, which is not shipped."""
    return "\n".join(
        line for line in (VENDOR / name).read_text(encoding="utf-8").splitlines() if "sourceMappingURL" not in line
    )


def render_printed(results):
    """@return HTML of the page that lists what the printed equations get wrong"""
    found, notes = printed.read(results)
    return fill("printed.html.j2", results, rows=found, notes=notes, tally=summary.tally(row.verdict for row in found))


def render_table1(results):
    """@return HTML of the paper's table of features beside what was measured"""
    features, systems, films, notes = table1.read(results)
    return fill(
        "table1.html.j2",
        results,
        features=features,
        systems=systems,
        films=films,
        notes=notes,
        columns=table1.COLUMNS,
        predicted=table1.PREDICTED,
    )


def render_stability(results, out):
    """@return HTML of the map of stable steps and of the hard cases"""
    frontiers, drawing, listed, notes = stability.read(results, out)
    hits, contact, peers, engines, more = stability_peers.drawings(out)
    return fill(
        "stability.html.j2",
        results,
        frontiers=frontiers,
        drawing=drawing,
        listed=listed,
        notes=notes + more,
        columns=stability.COLUMNS,
        hits=hits,
        contact=contact,
        peers=peers,
        peer_drawing=engines,
    )


def render_figures(results, out=None):
    """@param out: the report's folder, which holds the cases' pictures   @return HTML of the paper's figures: pictures,
    claims met, and the time of a frame"""
    rows = paper_figures.read(results)
    full = any("full-size" in table1.tags(row.case) for row in rows)
    return fill(
        "paper_figures.html.j2",
        results,
        rows=rows,
        full=full,
        notes=[],
        pictures=paper_figures.pictures(results, out),
        papers_frame=paper_figures.PAPERS_FRAME,
    )


def render_gallery(results, films):
    """@param films: case, names of film and sheet, why one is missing, colours of the sheet, end [s], tone of the
    verdict, what the paper says   @return HTML of the paper's figures in motion"""
    return fill("gallery.html.j2", results, films=films, notes=[])


def render_digit_cost(results, out):
    """@return HTML of what a tenth of the error costs, over cases and engines"""
    ladders, notes = digit_cost.read(results), []
    try:
        picture = digit_cost.draw(ladders, out)
    except Exception as error:  # no library, or odd data: the table stands without its figure
        picture, notes = None, [f"the figure could not be drawn: {error}"]
    return fill(
        "digit_cost.html.j2",
        results,
        ladders=ladders,
        bare=digit_cost.without_study(results),
        picture=picture,
        notes=notes,
    )


def render_ablation(results):
    """@return HTML of what each correction buys"""
    terms, rows, notes = ablation.read(results.folder)
    return fill(
        "ablation.html.j2",
        results,
        terms=terms,
        rows=rows,
        notes=notes,
        means=ablation.MEANS,
        picked=ablation.best(rows, terms),
        worse=ablation.WORSE,
        most=ablation.MOST,
    )


def render_side_by_side(results):
    """@return HTML of every engine beside every other"""
    return fill("side_by_side.html.j2", results, comparisons=side_by_side.read(results), notes=[])


def render_headline(results, found, others):
    """@return HTML of one question that engines are chosen by"""
    return fill("headline.html.j2", results, page=found, others=others, notes=[])


def render_signable(results):
    """@return HTML of the report that is signed; its PDF is made of it"""
    return fill("signable.html.j2", results, **signable.context(results))


def render_case(results, case, pictures, notes):
    """@param pictures, notes: what figures.draw_case gave   @return HTML of one case"""
    before, after = (
        results.cases[n] if 0 <= n < len(results.cases) else None for n in (case.number - 1, case.number + 1)
    )
    return fill(
        "case.html.j2",
        results,
        case=case,
        declared={metric.get("name"): metric for metric in case.metrics},
        drawings=pictures,
        figure_notes=notes,
        before=before,
        after=after,
        up="../",
    )


def render(results, missing_libraries, headlines=(), beside=()):
    """@param headlines: pages of questions   @param beside: (file, name) of the other pages that were written   @return
    HTML of the front page"""
    names, matrix, nowhere = front.subjects(results)
    return fill(
        "report.html.j2",
        results,
        hero=front.hero(results),
        words=front.verdict_words(results),
        changed=front.changes(results),
        near=front.nearest(results),
        spent=front.cost(results),
        names=names,
        matrix=matrix,
        nowhere=nowhere,
        engines=summary.engine_table(results),
        gaps=summary.not_validated(results),
        missing=missing_libraries,
        headlines=headlines,
        beside=beside,
        proof=signable.selftest_document(results.folder),
        meaning=EXITS.get(results.exit_code, "not one of the codes of the contracts"),
        table_style=vendor("tabulator.min.css"),
        scripts=[vendor("tabulator.min.js"), (TEMPLATES / "front.js").read_text(encoding="utf-8")],
    )
