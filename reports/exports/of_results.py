# SPDX-License-Identifier: BSD-3-Clause
"""Tables and figures of a results.json for a paper: CSV, LaTeX and PDF."""

from __future__ import annotations

import csv
import re

from model import combined, is_number, number, rows, table, text

from .files import whole

GATES = (
    "case",
    "engine",
    "preset",
    "mode",
    "metric",
    "unit",
    "level",
    "value",
    "uncertainty",
    "limit",
    "at_least",
    "band_low",
    "band_high",
    "verdict",
    "reason",
)
METRICS = (
    "case",
    "engine",
    "preset",
    "mode",
    "status",
    "spacing",
    "time_step",
    "support_ratio",
    "walkers",
    "iterations",
    "seed",
    "jitter",
    "base",
    "metric",
    "unit",
    "value",
    "uncertainty",
    "numerical",
    "statistical",
    "input",
    "data",
    "cpu_s",
    "wall_s",
    "setup_cpu_s",
    "peak_bytes",
    "pairs",
    "steps",
    "particles",
    "state_hash",
)
ORDERS = ("case", "engine", "preset", "mode", "metric", "axis", "order", "low", "high", "class", "formal")
CASES = ("case", "title", "kind", "requirement", "verdict", "exit_code", "reference", "source")


def tables(results):
    """{name: (columns, rows)} of all that was measured; a row is a dict."""
    found = {"cases": (CASES, []), "gates": (GATES, []), "metrics": (METRICS, []), "orders": (ORDERS, [])}
    for case in results.cases:
        reference = case.reference
        found["cases"][1].append(
            {
                "case": case.id,
                "title": case.title,
                "kind": case.kind,
                "requirement": case.requirement,
                "verdict": case.verdict,
                "exit_code": case.raw.get("exit_code"),
                "reference": text(reference.get("function")) or text(reference.get("kind")),
                "source": text(reference.get("source")),
            }
        )
        for engine in case.engines:
            who = {"case": case.id, "engine": engine.name, "preset": engine.preset}
            for raw in rows(engine.raw.get("gates")):
                band = raw.get("band") or [None, None]
                found["gates"][1].append(
                    {
                        **who,
                        **raw,
                        "unit": case.units.get(text(raw.get("metric"))),
                        "uncertainty": combined(raw.get("uncertainty")),
                        "band_low": band[0],
                        "band_high": band[1],
                    }
                )
            for raw in rows(engine.raw.get("order")):
                found["orders"][1].append({**who, **raw, "order": raw.get("value")})
            for raw in rows(engine.raw.get("runs")):
                found["metrics"][1].extend(measured(case, who, raw))
    return found


def measured(case, who, raw):
    """A row a metric of the run; one without numbers where the run has none."""
    common = {
        **who,
        **table(raw.get("knobs")),
        **table(raw.get("cost")),
        "status": raw.get("status"),
        "base": raw.get("base"),
        "state_hash": raw.get("state_hash"),
    }
    metrics = table(raw.get("metrics"))
    return [
        {
            **common,
            "metric": name,
            "unit": case.units.get(name),
            "value": number(table(m).get("value"), table(m).get("finite")),
            "uncertainty": combined(table(m).get("uncertainty")),
            **table(table(m).get("uncertainty")),
        }
        for name, m in metrics.items()
    ] or [common]


def write_csv(results, out):
    made = []
    for name, (columns, lines) in tables(results).items():
        made.append(out / f"{name}.csv")
        with whole(made[-1]) as file:
            sheet = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
            sheet.writeheader()
            sheet.writerows({key: plain(line.get(key)) for key in columns} for line in lines)
    return made


def plain(value):
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else value


# What a paper shows: few columns, digits as many as mean something
SHOWN = {
    "gates": (
        ("case", "engine", "metric", "value", "u", "bound", "verdict"),
        "Gates: measured value with its standard uncertainty, and the bound that it must hold.",
    ),
    "orders": (
        ("case", "engine", "metric", "axis", "order", "interval", "class"),
        "Observed orders of convergence with their 95\\,\\% intervals.",
    ),
}


def write_latex(results, out):
    """A table float a kind. They need the package booktabs, and longtable where they are long."""
    made = []
    for name, (heads, caption) in SHOWN.items():
        lines = [latex_row(name, line) for line in tables(results)[name][1]]
        if not lines:
            continue
        made.append(out / f"{name}.tex")
        alignment = "".join("r" if head in ("value", "u", "order") else "l" for head in heads)
        title = " & ".join("$u$" if head == "u" else head for head in heads) + r" \\"
        with whole(made[-1]) as file:
            file.write("% \\usepackage{booktabs,longtable}; 170 mm wide at 8 pt\n\\begingroup\\footnotesize\n")
            file.write(
                f"\\begin{{longtable}}{{@{{}}{alignment}@{{}}}}\n\\caption{{{caption}}}\\label{{tab:{name}}}\\\\\n\\toprule\n{title}\n\\midrule\n\\endhead\n"
            )
            file.writelines(" & ".join(line) + " \\\\\n" for line in lines)
            file.write("\\bottomrule\n\\end{longtable}\n\\endgroup\n")
    return made


def latex_row(name, line):
    who = (
        text(line["engine"])
        + (f" ({text(line['preset'])})" if text(line.get("preset")) not in ("", "default") else "")
        + (f", {text(line['mode'])}" if text(line.get("mode")) else "")
    )
    if name == "orders":
        return [
            escaped(line["case"]),
            escaped(who),
            escaped(line.get("metric")),
            escaped(line.get("axis")),
            rounded(line.get("order"), 3),
            f"[{rounded(line.get('low'), 3)}, {rounded(line.get('high'), 3)}]",
            escaped(line.get("class")),
        ]
    bound = ""
    if line.get("limit") is not None:
        bound = rf"$\leq$ {rounded(line['limit'])}"
    elif line.get("at_least") is not None:
        bound = rf"$\geq$ {rounded(line['at_least'])}"
    elif line.get("band_low") is not None:
        bound = f"[{rounded(line['band_low'])}, {rounded(line['band_high'])}]"
    unit = f" [{line['unit']}]" if line.get("unit") else ""
    return [
        escaped(line["case"]),
        escaped(who),
        escaped(f"{text(line.get('metric'))}{unit}"),
        rounded(line.get("value")),
        rounded(line.get("uncertainty"), 2),
        bound,
        escaped(line.get("verdict")),
    ]


def rounded(value, digits=4):
    """1.23e-05 as 1.23 x 10^-5; an em dash where there is no number."""
    value = number(value)
    if not is_number(value):
        return "---"
    mantissa, _, exponent = f"{value:.{digits}g}".partition("e")
    return f"${mantissa}$" if not exponent else rf"${mantissa}\times10^{{{int(exponent)}}}$"


SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
}


def escaped(value):
    return re.sub(r"[\\{}$&#%_~^<>]", lambda found: SPECIAL[found.group()], text(value))


def write_pdf(results, out):
    """The report's figures at 170 mm, or 84 mm where they are of one panel, with text that stays text."""
    import matplotlib

    from figures import OF_A_CASE, OF_TRAJECTORIES, curves, read_all, style

    made = []
    (out / "figures").mkdir(exist_ok=True)
    with matplotlib.rc_context({"pdf.fonttype": 42}):
        for case in results.cases:
            found, _ = read_all(results.folder, [(curve, curve.shown) for curve in curves(case)])
            for module in OF_A_CASE:
                drawing = module.draw(case, found if module in OF_TRAJECTORIES else [], [])
                if drawing is None:
                    continue
                figure = drawing.figure.matplotlib() if hasattr(drawing.figure, "matplotlib") else drawing.figure
                shrink(figure, (84 if figure.get_figwidth() <= style.HALF else 170) / 25.4)
                made.append(out / "figures" / f"{case.slug}-{drawing.name}.pdf")
                with whole(made[-1], "wb") as file:
                    figure.savefig(
                        file,
                        format="pdf",
                        metadata={"CreationDate": None, "Creator": "tripoint", "Title": f"{case.id}: {drawing.title}"},
                    )
    return made


SMALLEST = 5.5  # points: a label that is smaller cannot be read in print


def shrink(figure, width):
    """The figure as it is on the page, scaled to this width in inches: text and lines with it."""
    from matplotlib.lines import Line2D
    from matplotlib.text import Text

    scale = width / figure.get_figwidth()
    for axis in figure.axes:
        for side in (axis.xaxis, axis.yaxis):
            sizes = [label.get_fontsize() for label in side.get_ticklabels()]
            if sizes:
                side.set_tick_params(labelsize=max(SMALLEST, sizes[0] * scale), width=0.8 * scale, length=3.5 * scale)
    ticks = {
        label
        for axis in figure.axes
        for side in (axis.xaxis, axis.yaxis)
        for label in side.get_ticklabels(which="both")
    }
    for words in figure.findobj(Text):
        if words not in ticks:
            words.set_fontsize(max(SMALLEST, words.get_fontsize() * scale))
    for line in figure.findobj(Line2D):
        line.set_linewidth(line.get_linewidth() * scale)
        line.set_markersize(line.get_markersize() * scale)
    figure.set_size_inches(width, figure.get_figheight() * scale)
