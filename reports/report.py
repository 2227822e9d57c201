# SPDX-License-Identifier: BSD-3-Clause
"""Writes the report of a validation run: python3 report.py RESULTS.json [--out DIR] [--jobs N]

results.json is the one source; trajectories beside it are read to draw them. DIR/index.html is one self-contained file,
as are the pages that it links to: DIR/printed-equations.html, DIR/table-1.html, DIR/paper-figures.html, DIR/stability.html, DIR/digit-cost.html, DIR/corrections.html, DIR/engines.html and DIR/signable.html; and, where their cases were run, DIR/spin.html, DIR/bounce.html, DIR/float.html and DIR/upgrade.html (with --pdf also DIR/report.pdf). DIR/figures holds every figure as PNG and SVG. No physics is computed here, and no verdict is formed.
Exit: 0 the page is written, whatever it says; 2 there is nothing to report on.
"""
from __future__ import annotations

import argparse
import os
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import headlines
import load
import page
import plain
import releases
import signable
import speed

PACKAGES = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "h5py": "python3-h5py", "jinja2": "python3-jinja2"}


def absent():
    """Libraries that cannot be imported, as sentences that say what to install."""
    lines = []
    for name, package in PACKAGES.items():
        try:
            __import__(name)
        except Exception as error:  # a broken library raises more than ImportError
            lines.append(f"Python's {name} is not usable ({type(error).__name__}): install the Debian package {package}")
    return lines


def draw(results, out, jobs):
    """@return (pictures, notes, suite): by case number, and of the suite"""
    try:
        import figures
    except Exception as error:
        return {}, {}, ([], [f"no figures: {error}"])
    cases = results.cases
    if jobs > 1 and len(cases) > 1:
        with ProcessPoolExecutor(max_workers=jobs) as pool:
            drawn = list(pool.map(figures.draw_case, [results.folder] * len(cases), [out] * len(cases), cases))
    else:
        drawn = [figures.draw_case(results.folder, out, case) for case in cases]
    pictures = {case.number: found for case, (found, _) in zip(cases, drawn)}
    notes = {case.number: found for case, (_, found) in zip(cases, drawn)}
    return pictures, notes, figures.draw_suite(out, results)


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
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes that draw (default: %(default)s)")
    parser.add_argument("--pdf", action="store_true", help="also write DIR/report.pdf, the report to sign, by weasyprint")
    options = parser.parse_args(arguments)
    try:
        results = load.load(options.results)
    except load.Unreadable as reason:
        print(f"report: {reason}", file=sys.stderr)
        return 2
    out = Path(options.out) if options.out else results.folder
    out.mkdir(parents=True, exist_ok=True)
    missing = absent()
    pictures, notes, suite = draw(results, out, options.jobs)
    if any("jinja2" in line for line in missing):
        write(out / "index.html", plain.render(results, missing))
    else:
        write(out / "printed-equations.html", page.render_printed(results))
        write(out / "table-1.html", page.render_table1(results))
        write(out / "paper-figures.html", page.render_figures(results))
        write(out / "stability.html", page.render_stability(results, out))
        write(out / "digit-cost.html", page.render_digit_cost(results, out))
        write(out / "corrections.html", page.render_ablation(results))
        write(out / "engines.html", page.render_side_by_side(results))
        write(out / "signable.html", page.render_signable(results))
        if (results.folder / "speed.json").is_file():
            speed.main([str(results.folder / "speed.json"), str(out / "speed.html")])
        found, told = headlines.pages(results, out)
        results.notes.extend(told)
        for headline in found:
            if headline.file != "upgrade.html":
                write(out / headline.file, page.render_headline(results, headline, found))
        if (results.folder / "releases.json").is_file():
            releases.main([str(results.folder / "releases.json"), str(out / "upgrade.html")])
        write(out / "index.html", page.render(results, pictures, notes, suite, missing, found))
    print(out / "index.html")
    if options.pdf:
        why = signable.to_pdf(out / "signable.html", out / "report.pdf")
        print(why or out / "report.pdf", file=sys.stderr if why else sys.stdout)
        return 2 if why else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
