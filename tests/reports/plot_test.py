# SPDX-License-Identifier: BSD-3-Clause
"""Panels of lines say the same as matplotlib draws: python3 plot_test.py"""

import io
import re
import sys
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "reports"))
from figures import plot, style


def words(svg):
    """[(text, x, y)] of a figure, in order of text and place."""
    found = []
    for node in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}text"):
        found.append((node.text, round(float(node.get("x"))), round(float(node.get("y")))))
    return sorted(found)


def of_matplotlib(figure):
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg")
    return buffer.getvalue()


class Panels(unittest.TestCase):
    def same_words(self, figure):
        ours, theirs = words(figure.svg()), words(of_matplotlib(figure.matplotlib()))
        self.assertEqual([text for text, *_ in ours], [text for text, *_ in theirs])
        for (_, *here), (_, *there) in zip(ours, theirs):
            self.assertLessEqual(np.abs(np.subtract(here, there)).max(), 1, (here, there))

    def test_ticks_labels_and_legend_stand_where_matplotlib_puts_them(self):
        for low, high in (
            (0, 1),
            (-3e-7, 8e-7),
            (299.99999, 300.00001),
            (315 - 8e-12, 315 + 8e-12),
            (1e5, 3e6),
            (0, 0),
            (5, 5),
            (-0.4, 12),
        ):
            figure, axes = plot.panels(3, 5)
            x = np.linspace(0, 0.5, 30)
            for axis in axes:
                axis.plot(
                    x,
                    np.linspace(low, high, 30),
                    color=style.BLUE,
                    label="tripoint (corrected)",
                    marker="o",
                    markevery=5,
                )
                axis.plot(x, np.linspace(high, low, 30), color=style.ORANGE, label="bullet", linestyle="--")
                axis.set_xlabel("time [s]")
                axis.set_ylabel("error [m]")
            axes[0].set_title("of the energy of the fall", loc="right", fontsize=8)
            self.same_words(figure)

    def test_log_axes_too_over_less_than_a_decade_and_over_twenty(self):
        for top in (1.2, 8.0, 1e3, 1e20):
            figure, (axis,) = plot.panels(1, 1, height=3.1)
            axis.errorbar(
                [1.0, 2.0, top + 2],
                [1e-3, 2e-3, 1e-3 * top],
                yerr=[[1e-4] * 3, [2e-4] * 3],
                color=style.BLUE,
                marker="s",
                capsize=2,
                elinewidth=0.8,
                label="with bars",
            )
            axis.margins(x=0.12, y=0.1)
            axis.logarithmic()
            low, high = axis.get_xlim()
            axis.set_xlim(low, high * (high / low) ** 0.13)
            axis.labels([("dx 0.1", (1.0, 1e-3), style.BLUE), ("dx 0.1", (1.01, 1.01e-3), style.BLUE)])
            axis.cross(2.0, 1.03, "diverged", style.RED)
            axis.plot([1.0, 2.0], [1e-3, 2e-3], color=style.GREY, linestyle=":", zorder=1, label="formal order 2")
            self.same_words(figure)

    def test_points_that_are_not_finite_break_a_line_and_set_no_limit(self):
        figure, (axis,) = plot.panels(1, 1)
        axis.plot([0.0, 1.0, 2.0, 3.0, 90.0], [1.0, 2.0, np.nan, 4.0, np.nan], color=style.BLUE)
        axis.fill_between(
            [0.0, 1.0, 2.0, 3.0],
            np.array([0.0, 1.0, np.nan, 3.0]),
            np.array([2.0, 3.0, np.nan, 5.0]),
            color=style.BLUE,
            alpha=0.15,
        )
        self.assertLess(axis.get_xlim()[1], 4.0)
        path = re.search(rf'<path d="([^"]+)" style="fill: none; stroke: {style.BLUE}', figure.svg())[1]
        self.assertEqual((path.count("M"), path.count("L")), (2, 1))
        self.assertNotIn("nan", figure.svg())
        self.same_words(figure)

    def test_an_empty_panel_is_drawn_and_a_hidden_one_is_not(self):
        figure, axes = plot.panels(2, 1)
        axes[0].margins(x=0.12, y=0.1)
        axes[1].set_visible(False)
        self.assertEqual(figure.svg().count("clipPath id"), 1)
        self.same_words(figure)

    def test_every_marker_and_line_style_is_drawn_and_text_stays_text(self):
        figure, (axis,) = plot.panels(1, 8)
        for k, marker in enumerate(style.MARKERS):
            axis.plot(
                [0, 1],
                [k, k + 1],
                color=style.BLUE,
                marker=marker,
                linestyle=("-", "--", ":", (0, (2, 1.5)), "none")[k % 5],
                label=f"<b> & q_{marker}",
            )
        axis.axhline(0.5, color=style.INK)
        ET.fromstring(figure.svg())
        self.assertIn("&lt;b&gt; &amp; q_o", figure.svg())
        self.same_words(figure)


if __name__ == "__main__":
    unittest.main()
