# SPDX-License-Identifier: BSD-3-Clause
"""The sheet that particles are drawn on: panels of one scale, a bar of a round length, and a legend of the colours."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.image import BboxImage
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.transforms import Affine2D, Bbox, IdentityTransform, TransformedBbox

from . import style

DISC = (MarkerStyle("o").get_path().transformed(MarkerStyle("o").get_transform()),)
KINDS = (
    ("liquid", style.BLUE),
    ("liquid of another material", style.SKY),
    ("elastic", "#2bb58c"),
    ("rigid", "#e8803a"),
    ("at rest", style.GREY),
)


class Sheet:
    """Panels of one scale on one figure in inches, without axes: an axis each would cost ten times the drawing, and one
    for all half of it."""

    def __init__(self, lines, columns, low, high, below):
        self.low, self.high, self.columns, gap = low, high, columns, 0.1
        wide = (style.WIDTH - 0.1) / columns - gap
        self.scale = min(wide / (high - low)[0], (3.4 if columns < 4 else 2.4) / (high - low)[1])  # [inches/m]
        self.size = self.scale * (high - low)
        self.step = np.array(
            [wide + gap if self.size[0] > 0.7 * wide else max(self.size[0] + gap, 0.9), max(self.size[1], 0.25) + gap]
        )
        self.base, total = below, below + lines * self.step[1] + 0.25
        self.figure = Figure(figsize=(style.WIDTH, total))
        FigureCanvasAgg(self.figure)
        self.inches = Affine2D().scale(1 / style.WIDTH, 1 / total) + self.figure.transFigure
        self.lines = lines

    def origin(self, place):
        """The lower left corner of a panel."""
        return np.array(
            [
                0.1 + (place % self.columns) * self.step[0],
                self.base + (self.lines - 1 - place // self.columns) * self.step[1],
            ]
        )

    def draw(self, place, seen, area, pale, colours):
        at = self.origin(place) + (seen[:, :2] - self.low) * self.scale
        discs = PathCollection(
            DISC,
            [area],
            offsets=at,
            offset_transform=self.inches,
            facecolors=colours,
            edgecolors="none",
            linewidths=0,
            alpha=pale,
            rasterized=True,
        )
        discs.set_transform(IdentityTransform())
        self.figure.add_artist(discs)
        corner, (wide, tall) = self.origin(place), self.size
        self.line(
            corner[0] + np.array([0, wide, wide, 0, 0]),
            corner[1] + np.array([0, 0, tall, tall, 0]),
            color=style.GRID,
            linewidth=0.8,
            zorder=0,
        )

    def line(self, x, y, **look):
        self.figure.add_artist(Line2D(x, y, transform=self.inches, **look))

    def words(self, x, y, words, hue=style.INK, **look):
        """@param x, y: inches"""
        self.figure.text(x, y, words, transform=self.inches, color=hue, zorder=3, **look)

    def write(self, place, x, y, words, offset, align, hue, weight="normal"):
        """@param x, y: shares of a panel   @param offset: points"""
        self.words(
            *(self.origin(place) + np.array([x, y]) * self.size + np.array(offset) / 72),
            words,
            hue,
            va=align,
            fontsize=8.5,
            fontweight=weight,
            bbox={"facecolor": style.PAPER, "edgecolor": "none", "alpha": 0.75, "pad": 1.0} if align == "top" else None,
        )

    def legend(self, warm, kinds):
        """A bar of a round length, and what the colours are. @return the same in words"""
        length = round_below(0.4 * self.size[0] / self.scale)
        self.line([0.1, 0.1 + length * self.scale], [0.24, 0.24], color=style.INK, linewidth=2.2, solid_capstyle="butt")
        self.words(0.1, 0.08, f"{1000 * length:.4g} mm" if length < 0.1 else f"{length:.4g} m", fontsize=8)
        if warm is not None:
            bar = BboxImage(TransformedBbox(Bbox.from_extents(3.2, 0.3, 6.0, 0.4), self.inches), cmap=style.TEMPERATURE)
            bar.set_data(np.linspace(0, 1, 128)[None, :])
            self.figure.add_artist(bar)
            for share in (0.0, 0.5, 1.0):
                self.words(
                    3.2 + 2.8 * share,
                    0.13,
                    f"{warm[0] + share * (warm[1] - warm[0]):.4g}{' K' if share == 1 else ''}",
                    ha="center",
                    fontsize=8,
                )
            if not kinds:
                return "coloured by temperature on one scale"
        names = [KINDS[k] for k in sorted(kinds)]
        height = 0.18 if warm is None else 0.58
        widths = [0.35 + 0.062 * len(name) if len(names) > 3 else 1.9 for name, _ in names]
        at = min(3.2, style.WIDTH - 0.1 - sum(widths))
        for (name, hue), wide in zip(names, widths):
            self.line([at], [height], marker="o", linestyle="none", color=hue, markersize=5)
            self.words(at + 0.1, height, name, va="center", fontsize=8)
            at += wide
        if warm is not None:
            return "coloured by temperature on one scale, and below it by phase"
        return "coloured by phase" if kinds else "coloured by body"


def round_below(length):
    """1, 2 or 5 times a power of ten."""
    if not length > 0:
        return 1.0
    ten = 10.0 ** np.floor(np.log10(length))
    return next(n * ten for n in (5, 2, 1) if n * ten <= length * (1 + 1e-9))
