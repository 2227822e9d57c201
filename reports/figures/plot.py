# SPDX-License-Identifier: BSD-3-Clause
"""Panels of lines, written as SVG without matplotlib's artists, which cost ten times as much; its tick locators,
formatters and text widths are used.

A panel keeps the calls that were made of it. They are those of matplotlib's Axes, as far as the figures of a case need
them, so that `matplotlib()` gives the same figure there, for a PDF."""

from __future__ import annotations

import math

import numpy as np
from matplotlib import ticker
from matplotlib.transforms import nonsingular

from . import style
from .marks import extent, markers, number, stroke, through, write

PIXEL = 0.72  # points: of a hundredth of an inch
TICK, PAD, APART = 3.5, 3.5, 4.0  # points: length of a tick, to its words, on to the label of the axis
DASHES = {"-": None, "--": (3.7, 1.6), ":": (1.0, 1.65)}  # in widths of the line
LEGEND = 8.5  # points: size of its words


class Side:
    """One direction of a panel: limits, scale and ticks."""

    def __init__(self, powers):
        self.low, self.high, self.margin, self.log, self.powers, self.seen, self.fixed, self.few = (
            None,
            None,
            0.05,
            False,
            powers,
            [],
            False,
            False,
        )

    def limits(self):
        """Those that were set, else those of the data with a margin."""
        if self.fixed:
            return self.low, self.high
        values = np.concatenate([np.ravel(part) for part in self.seen]) if self.seen else np.empty(0)
        values = values[np.isfinite(values) & ((values > 0) | (not self.log))]
        low, high = (float(values.min()), float(values.max())) if values.size else (math.inf, -math.inf)
        if not self.log:
            low, high = nonsingular(low, high, expander=0.05)
            reach = self.margin * (high - low)
            return nonsingular(low - reach, high + reach, expander=1e-12, tiny=1e-13)
        if not values.size:
            return 1.0, 10.0
        if low == high:
            low, high = 10 ** math.floor(math.log10(low) - 1e-12), 10 ** math.ceil(math.log10(high) + 1e-12)
        reach = (high / low) ** self.margin
        low, high = low / reach, high * reach
        return (low / 2, high * 2) if high / low < 2 else (low, high)

    def share(self, values):
        """Where values lie: 0 at the low limit, 1 at the high one; NaN for what no log axis has."""
        low, high = self.limits()
        values = np.asarray(values, float)
        if self.log:
            values = np.where(values > 0, values, np.nan)
            low, high, values = math.log(low), math.log(high), np.log(values)
        return (values - low) / (high - low)

    def ticks(self):
        """([(share, words)], the power of ten that they are written in)"""
        low, high = self.limits()
        if self.log:
            locator = ticker.LogLocator(subs=(1, 2, 5)) if self.few else ticker.LogLocator(numticks=7)
            places = locator.tick_values(low, high)
            words, power = [style.power(place) for place in places], ""
        else:
            places = ticker.MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
            formatter = ticker.ScalarFormatter(useOffset=False, useMathText=False)
            formatter.create_dummy_axis()
            formatter.axis.set_view_interval(low, high)
            formatter.set_powerlimits(self.powers)
            words, power = formatter.format_ticks(places), formatter.get_offset()
        return [
            (share, word) for share, word in zip(self.share(places).tolist(), words) if -1e-10 <= share <= 1 + 1e-10
        ], power


class Panel:
    """Takes the calls of an Axes. They are drawn by `svg`, or made again of an Axes by `again`."""

    def __init__(self):
        self.x, self.y, self.calls, self.visible, self.words = (
            Side((-5, 6)),
            Side((-3, 4)),
            [],
            True,
            {"x": "", "y": ""},
        )
        self.titles = {}

    def keep(self, name, *given, **more):
        self.calls.append((name, given, more))

    def plot(self, x, y, **look):
        self.keep("plot", x, y, **look)
        self.see(x, y)

    def errorbar(self, x, y, yerr=None, errorevery=1, **look):
        self.keep("errorbar", x, y, yerr=yerr, errorevery=errorevery, **look)
        self.see(x, y, *([] if yerr is None else self.ends(y, yerr)))

    def fill_between(self, x, low, high, **look):
        self.keep("fill_between", x, low, high, **look)
        self.see(x, low, high)

    def axhline(self, y, **look):
        self.keep("axhline", y, **look)
        self.y.seen.append(np.array([y], float))

    def see(self, x, *ys):
        x, ys = np.asarray(x, float), [np.asarray(y, float) for y in ys]
        self.x.seen += [x[np.isfinite(y)] for y in ys]  # where there is a point
        self.y.seen += ys

    @staticmethod
    def ends(y, yerr):
        lower, upper = yerr if isinstance(yerr, list) else (yerr, yerr)
        return np.asarray(y, float) - np.asarray(lower, float), np.asarray(y, float) + np.asarray(upper, float)

    def margins(self, x, y):
        self.keep("margins", x=x, y=y)
        self.x.margin, self.y.margin = x, y

    def logarithmic(self, which="xy"):
        self.keep("logarithmic", which)
        for name in which:
            side = getattr(self, name)
            side.log = True
            low, high = side.limits()
            side.few = high / low < 30

    def get_xlim(self):
        return self.x.limits()

    def set_xlim(self, low, high):
        self.keep("set_xlim", low, high)
        self.x.low, self.x.high, self.x.fixed = low, high, True

    def set_ylim(self, bottom, top):
        self.keep("set_ylim", bottom, top)
        self.y.low, self.y.high, self.y.fixed = bottom, top, True

    def set_visible(self, visible):
        self.keep("set_visible", visible)
        self.visible = visible

    def set_xlabel(self, words, **look):
        self.keep("set_xlabel", words, **look)
        self.words["x"] = words, look.get("fontsize", 9)

    def set_ylabel(self, words, **look):
        self.keep("set_ylabel", words, **look)
        self.words["y"] = words, look.get("fontsize", 9)

    def set_title(self, words, loc="left", fontsize=9.5, color=style.INK):
        self.keep("set_title", words, loc=loc, fontsize=fontsize, color=color)
        self.titles[loc] = words, fontsize, color

    def labels(self, wanted, aside=(6, 6)):
        self.keep("labels", wanted, aside)

    def cross(self, x, height, words, hue):
        """A cross at a share of the height, with words beside it."""
        self.keep("cross", x, height, words, hue)
        self.x.seen.append(np.array([x], float))

    def again(self, axis):
        """Makes the calls of an Axes."""
        own = {"logarithmic": style.logarithmic, "labels": style.labels, "cross": style.cross}
        for name, given, more in self.calls:
            own[name](axis, *given, **more) if name in own else getattr(axis, name)(*given, **more)

    def entries(self):
        """[(label, name of the call, look)] for the legend: lines first, then those with bars."""
        return [
            (more["label"], name, more)
            for wanted in ("plot", "errorbar")
            for name, _, more in self.calls
            if name == wanted and more.get("label")
        ]

    def svg(self, box, clip):
        """@param box: x, y of the upper left corner, width, height [points]"""
        left, top, wide, tall = box
        across, up = self.x.limits(), self.y.limits()

        def at(x, y):
            return np.stack(
                np.broadcast_arrays(left + self.x.share(x) * wide, top + (1.0 - self.y.share(y)) * tall), axis=-1
            )

        below, above, beside = [], [], []  # under the grid, over it, and outside of the clip
        for name, given, look in self.calls:
            if name in ("plot", "errorbar"):
                level = look.get("zorder", 2 if name == "plot" else 2.1)  # bars over lines, as in matplotlib
                (below if level < 1.5 else above).append((level, self.curve(at, name, given, look)))
            elif name == "fill_between":
                x, low, high = (np.asarray(part, float) for part in given)
                for part in np.ma.clump_unmasked(np.ma.masked_invalid(x + low + high)):
                    edge = np.concatenate([at(x[part], low[part]), at(x[part], high[part])[::-1]])
                    edge[~np.isfinite(edge[:, 1]), 1] = top + tall  # what a log axis has not lies below
                    below.append(
                        (
                            1,
                            f'<path d="{through(edge)}z" style="fill: {look["color"]}; fill-opacity: '
                            f'{look.get("alpha", 1):g}"/>\n',
                        )
                    )
            elif name == "axhline":
                y = number(float(at(across[0], given[0])[1]))
                dashes = DASHES[look.get("linestyle", "-")]
                above.append(
                    (
                        2,
                        f'<path d="M{number(left)} {y}L{number(left + wide)} {y}" '
                        f"{stroke(look['color'], look.get('linewidth', 1.5), look.get('alpha'), dashes)}/>\n",
                    )
                )
            elif name == "labels":
                beside += self.placed(at, box, *given)
            elif name == "cross":
                x, height, words, hue = given
                place = np.array([float(at(x, up[0])[0]), top + (1.0 - height) * tall])
                beside += [
                    markers(place[None], "x", 7, hue, None, 2),
                    write(words, place[0] + 7, place[1] + 3, 7.5, style.SOFT),
                ]
        ink = lambda layer: "".join(piece for _, piece in sorted(layer, key=lambda entry: entry[0]))
        frame = (
            f'<path d="M{number(left)} {number(top)}V{number(top + tall)}H{number(left + wide)}" '
            f"{stroke(style.SOFT, 0.8, more='; stroke-linecap: square')}/>\n"
        )
        return (
            f'<g clip-path="url(#{clip})">\n{ink(below)}</g>\n{self.axes(box, clip)}<g '
            f'clip-path="url(#{clip})">\n{ink(above)}</g>\n{frame}{"".join(beside)}'
        )

    def curve(self, at, name, given, look):
        x, y = given
        points, hue, alpha = at(x, y), look["color"], look.get("alpha")
        width, dashes = look.get("linewidth", 1.5), look.get("linestyle", "-")
        drawn = ""
        if name == "errorbar" and look["yerr"] is not None and len(points):
            drawn += self.bars(at, x, y, look)
        if dashes not in ("none", "") and len(points):
            dashes = dashes[1] if isinstance(dashes, tuple) else DASHES[dashes]
            more = "" if dashes else "; stroke-linecap: square"
            more += "; stroke-linejoin: miter" if look.get("solid_joinstyle") == "miter" else ""
            drawn += f'<path d="{through(points)}" {stroke(hue, width, alpha, dashes, more)}/>\n'
        if look.get("marker") and len(points):
            every = look.get("markevery", 1)
            first, every = every if isinstance(every, tuple) else (0, every)
            drawn += markers(
                points[first::every],
                look["marker"],
                look.get("markersize", 4.5),
                hue,
                look.get("markerfacecolor"),
                alpha=alpha,
            )
        return drawn

    def bars(self, at, x, y, look):
        every, cap = look["errorevery"], look.get("capsize", 0)
        low, high = (at(x, end)[::every] for end in self.ends(y, look["yerr"]))
        sound = np.isfinite(low).all(axis=1) & np.isfinite(high).all(axis=1)
        pairs = list(zip(low[sound].tolist(), high[sound].tolist()))
        path = "".join(f"M{a:.2f} {b:.2f}V{d:.2f}" for (a, b), (_, d) in pairs)
        drawn = (
            f'<path d="{path}" {stroke(look["color"], look.get("elinewidth", 1.5), look.get("alpha"))}/>\n'
            if path
            else ""
        )
        caps = "".join(f"M{a - cap:.2f} {y:.2f}h{2 * cap:g}" for (a, b), (_, d) in pairs for y in (b, d)) if cap else ""
        return drawn + (f'<path d="{caps}" {stroke(look["color"], 1, look.get("alpha"))}/>\n' if caps else "")

    def placed(self, at, box, wanted, aside):
        """Words aside of their points, shifted on until no earlier ones are in the way."""
        found, on = [], 11 if aside[1] > 0 else -11
        for words, point, hue in wanted:
            x, y = (at(*point) - (box[0], box[1] + box[3])) * (1, -1) / PIXEL + aside
            x = min(x, box[2] / PIXEL - 5.4 * len(words))
            while any(abs(x - a) < 5.2 * max(len(words), n) and abs(y - b) < 11 for a, b, n, *_ in found):
                y += on
            found.append((x, y, len(words), words, hue))
        return [
            write(words, box[0] + x * PIXEL, box[1] + box[3] - y * PIXEL, 7.5, hue)
            for x, y, _, words, hue in found
            if words
        ]

    def axes(self, box, clip):
        """Grid, ticks, their words and the labels."""
        left, top, wide, tall = box
        (across, power_x), (up, power_y) = self.x.ticks(), self.y.ticks()
        xs, ys = [left + share * wide for share, _ in across], [top + (1 - share) * tall for share, _ in up]
        _, height, descent = extent("lp", 9)
        drawn = grid_and_ticks(box, clip, xs, ys)
        foot, edge = top + tall + TICK + PAD, left - TICK - PAD
        for x, (_, words) in zip(xs, across):
            drawn += write(words, x, foot + height - descent, 9, style.INK, "middle")
        for y, (_, words) in zip(ys, up):
            drawn += write(words, edge, y + 0.5 * (height - descent), 9, style.INK, "end")
        foot, edge = foot + height, edge - max((extent(words, 9)[0] for _, words in up), default=0.0)
        drawn += self.labels_of_axes(box, foot, edge)
        drawn += write(power_x, left + wide, foot + 3 + height - descent, 9, style.SOFT, "end") if power_x else ""
        drawn += write(power_y, left, top - 3, 9, style.SOFT) if power_y else ""
        return drawn + self.head(box, power_y)

    def labels_of_axes(self, box, foot, edge):
        left, top, wide, tall = box
        drawn = ""
        if self.words["x"]:
            words, size = self.words["x"]
            _, high, low = extent("lp", size)
            drawn += write(words, left + 0.5 * wide, foot + APART + high - low, size, style.INK, "middle")
        if self.words["y"]:
            words, size = self.words["y"]
            x = edge - APART - extent("lp", size)[2]
            drawn += write(words, x, top + 0.5 * tall, size, style.INK, "middle", True)
        return drawn

    def head(self, box, power):
        """Titles, above the power of ten where both would stand in one place."""
        left, top, wide, _ = box
        drawn = ""
        for where, (words, size, hue) in self.titles.items():
            meet = power and (where == "left" or extent(words, size)[0] + extent(power, 9)[0] > wide)
            x, anchor = (left + wide, "end") if where == "right" else (left, "start")
            drawn += write(words, x, top - 6 - (9.84 if meet else 0), size, hue, anchor)
        return drawn


def grid_and_ticks(box, clip, xs, ys):
    left, top, wide, tall = box
    grid = "".join(f"M{x:.2f} {top:.2f}v{tall:.2f}" for x in xs) + "".join(
        f"M{left:.2f} {y:.2f}h{wide:.2f}" for y in ys
    )
    ticks = "".join(f"M{x:.2f} {top + tall:.2f}v{TICK}" for x in xs) + "".join(
        f"M{left:.2f} {y:.2f}h-{TICK}" for y in ys
    )
    return (
        f'<path d="{grid}" clip-path="url(#{clip})" {stroke(style.GRID, 0.6)}/>\n<path d="{ticks}" '
        f"{stroke(style.SOFT, 0.8)}/>\n"
    )


class Figure:
    """Panels in a grid under one legend."""

    def __init__(self, count, labels, height=2.9, columns=None):
        self.asked = count, labels, height, columns
        self.axes = [Panel() for _ in range(count)]

    def get_figwidth(self):
        return style.grid(*self.asked)[0]

    def matplotlib(self):
        """The same as a figure of matplotlib."""
        figure, axes = style.panels(*self.asked)
        for panel, axis in zip(self.axes, axes):
            panel.again(axis)
        style.legend(figure, axes)
        return figure

    def svg(self):
        width, total, columns, lines, above = style.grid(*self.asked)
        entries = {}
        for panel in self.axes:
            for label, name, look in panel.entries():
                entries.setdefault(label, (name, look))
        across = style.columns(entries, width) if entries else 1
        top = max(above, 0.3 + 0.19 * -(-len(entries) // across)) if entries else above
        total += top - above
        left, right, bottom = 0.72, width - 0.15, 0.5
        aside, apart = 0.24 if columns < 3 else 0.4, 0.36
        wide, tall = (
            (right - left) / (columns + aside * (columns - 1)),
            (total - top - bottom) / (lines + apart * (lines - 1)),
        )
        boxes = [
            tuple(
                72 * part
                for part in (
                    left + (k % columns) * (1 + aside) * wide,
                    top + k // columns * (1 + apart) * tall,
                    wide,
                    tall,
                )
            )
            for k in range(len(self.axes))
        ]
        shown = [(panel, box, f"clip{k}") for k, (panel, box) in enumerate(zip(self.axes, boxes)) if panel.visible]
        clips = "".join(
            '<clipPath id="{}"><rect x="{}" y="{}" width="{}" height="{}"/></clipPath>\n'.format(
                clip, *map(number, box)
            )
            for _, box, clip in shown
        )
        w, h = number(72 * width), number(72 * total)
        return (
            '<?xml version="1.0" encoding="utf-8" standalone="no"?>\n<svg xmlns:xlink="http://www.w3.org/1999/xlink" '
            f'width="{w}pt" height="{h}pt" viewBox="0 0 {w} {h}" xmlns="http://www.w3.org/2000/svg" version="1.1">\n'
            f"<defs>\n{clips}</defs>\n<g style=\"stroke-linejoin: round; font-family: 'DejaVu Sans', Verdana, Arial, "
            f'Helvetica, sans-serif">\n<path d="M0 0H{w}V{h}H0z" style="fill: {style.PAPER}"/>\n'
            + "".join(panel.svg(box, clip) for panel, box, clip in shown)
            + legend(entries, across, width)
            + "</g>\n</svg>\n"
        )


def legend(entries, across, width):
    """Filled column after column, as matplotlib does."""
    drawn, x = "", 72 * 0.03 * width + 0.65 * LEGEND
    _, least, below = extent("lp", LEGEND)
    entries = list(entries.items())
    while across > 0 and entries:
        here, entries = entries[: -(-len(entries) // across)], entries[-(-len(entries) // across) :]
        y = 0.65 * LEGEND
        for label, (name, look) in here:
            _, height, descent = extent(label, LEGEND)
            foot = y + max(height, least) - max(descent, below)
            drawn += sample(name, look, x, foot - 0.35 * LEGEND) + write(
                label, x + (2.4 + 0.8) * LEGEND, foot, LEGEND, style.INK
            )
            y += max(height, least) + 0.5 * LEGEND
        x += (2.4 + 0.8 + 1.4) * LEGEND + max(extent(label, LEGEND)[0] for label, _ in here)
        across -= 1
    return drawn


def sample(name, look, x, y):
    panel = Panel()
    bar = (
        {"yerr": [[0.5 * LEGEND], [0.5 * LEGEND]], "errorevery": 1}
        if name == "errorbar" and look["yerr"] is not None
        else {"yerr": None}
    )
    at = lambda a, b: np.stack(np.broadcast_arrays(np.asarray(a, float), np.asarray(b, float)), axis=-1)
    line = {key: value for key, value in look.items() if key not in ("markevery", "marker")}
    dot = {**look, **bar, "linestyle": "none", "markevery": 1}
    return panel.curve(at, "plot", ([x, x + 2.4 * LEGEND], [y, y]), line) + panel.curve(
        at, name, ([x + 1.2 * LEGEND], [y]), dot
    )


def panels(count, labels, height=2.9, columns=None):
    """@return (figure, its panels)"""
    figure = Figure(count, labels, height, columns)
    return figure, figure.axes
