# SPDX-License-Identifier: BSD-3-Clause
"""Writes the report of a validation run: python3 report.py RESULTS.json [--out DIR] [--jobs N]

results.json is the one source; trajectories beside it are read to draw them. DIR/index.html is the front page,
DIR/case/NAME.html has one case; each is one file that loads nothing. Pages that compare cases stand beside index.html,
each only where these results hold a case for it. DIR/figures holds every figure as SVG, and what it was drawn from: a
figure whose inputs are the same is not drawn again. No physics is computed here, and no verdict is formed. Exit: 0 the
pages are written, whatever they say; 2 there is nothing to report on."""

from __future__ import annotations

import argparse
import gc
import json
import multiprocessing
import os
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import no_plugins  # noqa: F401  before h5py
import digit_cost
import headlines
import load
import page
import plain
import printed
import releases
import scorecard
import side_by_side
import signable
import speed
import table1

PACKAGES = {
    "numpy": "python3-numpy",
    "matplotlib": "python3-matplotlib",
    "h5py": "python3-h5py",
    "jinja2": "python3-jinja2",
}


def absent():
    """Libraries that cannot be imported, as sentences that say what to install."""
    lines = []
    for name, package in PACKAGES.items():
        try:
            __import__(name)
        except Exception as error:  # a broken library raises more than ImportError
            lines.append(
                f"Python's {name} is not usable ({type(error).__name__}): install the Debian package {package}"
            )
    return lines


def make_case(results, out, missing, case):
    """Draws one case and writes its page. @return files that it made"""
    try:
        import figures

        pictures, notes, made = figures.draw_case(results.folder, out, case)
    except ImportError as error:
        pictures, notes, made = [], missing or [f"no figures: {error}"], []
    if not any("jinja2" in line for line in missing):
        write(out / "case" / f"{case.slug}.html", page.render_case(results, case, pictures, notes))
        made = [*made, f"case/{case.slug}.html"]
    return made


def take_colour_for_own(results, missing):
    """The user's own engine has its own colour in every figure."""
    if not missing:
        from figures import style

        style.KNOWN.update(dict.fromkeys(headlines.own_engines(results), style.OWN))


def make_cases(results, out, missing, jobs):
    """@return files that belong to the cases. Children are forked, so that the results need not be sent to them."""
    global WORK
    WORK = (results, out, missing)
    (out / "case").mkdir(exist_ok=True)
    gc.freeze()  # the results stay to the end
    numbers = range(len(results.cases))
    if jobs > 1 and len(numbers) > 1:
        with ProcessPoolExecutor(max_workers=jobs, mp_context=multiprocessing.get_context("fork")) as pool:
            made = list(pool.map(make_nth, numbers, chunksize=4))
    else:
        made = [make_nth(number) for number in numbers]
    return [name for names in made for name in names]


def make_nth(number):
    """Memory is swept once a case: while matplotlib makes its thousands of small objects, sweeps took a fifth of the
    time."""
    gc.disable()
    try:
        return make_case(*WORK, WORK[0].cases[number])
    finally:
        gc.enable()
        gc.collect(0)


def sweep(out, made):
    """Removes what an earlier report made of cases that are not among these; what nobody listed stays."""
    listing = out / "case" / "files.json"
    try:
        old = json.loads(listing.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        old = []
    for name in (
        set(
            name
            for name in old
            if isinstance(name, str) and name.startswith(("case/", "figures/")) and ".." not in name
        )
        - set(made)
        if isinstance(old, list)
        else ()
    ):
        (out / name).unlink(missing_ok=True)
    write(listing, json.dumps(sorted(made)))


def pages_beside(results, out):
    """(file, name, what writes it, whether these results hold something for it)"""
    tagged = {tag for case in results.cases for tag in table1.tags(case) if isinstance(tag, str)}
    cases = {case.id for case in results.cases}
    return (
        ("engines.html", "Engines side by side", page.render_side_by_side, side_by_side.read(results)),
        (
            "table-1.html",
            "Table 1: nine features",
            page.render_table1,
            any(tag.startswith("feature-") for tag in tagged),
        ),
        ("paper-figures.html", "The paper's figures", lambda of: page.render_figures(of, out), "paper" in tagged),
        (
            "printed-equations.html",
            "What the printed equations do",
            page.render_printed,
            any(row.case_id in cases for row in printed.read(results)[0]),
        ),
        (
            "digit-cost.html",
            "Cost of one more digit",
            lambda of: page.render_digit_cost(of, out),
            digit_cost.read(results),
        ),
        (
            "corrections.html",
            "What each correction buys",
            page.render_ablation,
            (results.folder / "ablation.json").is_file(),
        ),
        ("stability.html", "Stable steps, hard cases", lambda of: page.render_stability(of, out), "hard" in tagged),
        ("signable.html", "The report to sign", page.render_signable, True),
    )


def other_pages(results, out):
    """Writes those pages beside index.html for which these results hold a case, and removes those for which they do
    not. @return (pages of questions, [(file, name)])"""
    beside = []
    for file, name, render, wanted in pages_beside(results, out):
        (out / file).unlink(missing_ok=True)
        if wanted:
            write(out / file, render(results))
            beside.append((file, name))
    if (results.folder / "speed.json").is_file():
        speed.main([str(results.folder / "speed.json"), str(out / "speed.html")])
        beside.append(("speed.html", "Speed beside other codes"))
    beside = chosen_pages(results, out) + beside
    found, notes = headlines.pages(results, out)
    results.notes.extend(notes)
    for headline in found:
        if headline.file != "upgrade.html":
            write(out / headline.file, page.render_headline(results, headline, found))
    if (results.folder / "releases.json").is_file():
        releases.main([str(results.folder / "releases.json"), str(out / "upgrade.html")])
    return found, beside


def chosen_pages(results, out):
    """Writes the scorecard, and the page of engines by use, where there is a scorecard.json. @return [(file, name)]"""
    if absent():
        return []
    import which_engine  # it needs numpy

    html, made = which_engine.render(results), []
    if html:
        write(out / "which-engine.html", html)
        made.append(("which-engine.html", "Which engine for what?"))
    else:
        (out / "which-engine.html").unlink(missing_ok=True)
    if (results.folder / "scorecard.json").is_file() and scorecard.main(
        [str(results.folder / "scorecard.json"), str(out / "scorecard.html")]
    ) == 0:
        made.append(("scorecard.html", "Scorecard: engines by the limits that any engine must hold"))
    return made


def write(path, content):
    """By rename, so that nobody sees half a page."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".index-", suffix=".html")
    with os.fdopen(handle, "w", encoding="utf-8", errors="replace") as file:
        file.write(content)
    os.chmod(name, 0o644)
    os.replace(name, path)


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Writes the HTML report of a validation run.")
    parser.add_argument("results", metavar="RESULTS.json")
    parser.add_argument("--out", metavar="DIR", help="folder of index.html and figures/ (default: beside RESULTS.json)")
    parser.add_argument(
        "--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes that draw (default: %(default)s)"
    )
    parser.add_argument(
        "--pdf", action="store_true", help="also write DIR/report.pdf, the report to sign, by weasyprint"
    )
    options = parser.parse_args(arguments)
    try:
        results = load.load(options.results)
    except load.Unreadable as reason:
        print(f"report: {reason}", file=sys.stderr)
        return 2
    out = Path(options.out) if options.out else results.folder
    out.mkdir(parents=True, exist_ok=True)
    missing = absent()
    take_colour_for_own(results, missing)
    made = make_cases(results, out, missing, options.jobs)
    sweep(out, made)
    if any("jinja2" in line for line in missing):
        write(out / "index.html", plain.render(results, missing))
    else:
        found, beside = other_pages(results, out)
        write(out / "index.html", page.render(results, missing, found, beside))
    print(out / "index.html")
    if options.pdf:
        why = signable.to_pdf(out / "signable.html", out / "report.pdf")
        print(why or out / "report.pdf", file=sys.stderr if why else sys.stdout)
        return 2 if why else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
