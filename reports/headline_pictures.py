# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a headline page: each engine's curve over the truth, which is wide and grey. The user's own engine is
first and on top, in its own colour.
"""

from __future__ import annotations

OTHERS = 10  # curves beside the truth that a picture holds
PRINTED = " as printed"  # our own solver by the paper's equations
ALIKE = 0.01  # of the range of all curves: nearer ones lie on each other


def is_own(label, own):
    """Whether the label "engine · preset" is of an engine that the user brought."""
    return label.split(" · ")[0].removesuffix(PRINTED) in own


def smooth(times, values, rates, parts=12):
    """Cubics through values and rates of the frames (Hermite), so that a curve between far frames is no broken line;
    as it is where there are no rates.
    """
    import numpy as np

    if rates is None or not np.isfinite(rates).all() or len(times) < 2:
        return times, values
    s = np.linspace(0.0, 1.0, parts, endpoint=False)
    step = np.diff(times)[:, None]
    start, end, leave, come = (part[:, None] for part in (values[:-1], values[1:], rates[:-1], rates[1:]))
    curve = (
        (1 + 2 * s) * (1 - s) ** 2 * start
        + s * (1 - s) ** 2 * step * leave
        + s * s * (3 - 2 * s) * end
        + s * s * (s - 1) * step * come
    )
    return np.append((times[:-1, None] + s * step).ravel(), times[-1]), np.append(curve.ravel(), values[-1])


def alike(curves, own=()):
    """[(names, curve)]: curves that lie on each other are one, with the names of all; own engines and printed forms
    stay alone.
    """
    import numpy as np

    finite = np.concatenate([values[np.isfinite(values)] for _, (_, values, _) in curves])
    range_ = float(finite.max() - finite.min()) if finite.size else 0.0
    groups = []
    for label, curve in curves:
        alone = label.endswith(PRINTED) or is_own(label, own)
        twin = (
            None
            if alone
            else next(
                (
                    group
                    for group in groups
                    if group[2]
                    and len(group[1][1]) == len(curve[1])
                    and np.abs(group[1][1] - curve[1]).max() < ALIKE * range_
                ),
                None,
            )
        )
        if twin:
            twin[0].append(label)
        else:
            groups.append(([label], curve, not alone))
    return [(", ".join(names), curve) for names, curve, _ in groups]


def looks_of(labels, own):
    """{label: its colour, dashes, width and layer}; grey is the truth's."""
    from figures import style

    palette = (style.BLUE, style.ORANGE, style.GREEN, style.PINK, style.AMBER, style.SKY, style.RED)
    mine = {
        label: {"color": style.OWN, "linestyle": ("-", "--", ":", "-.")[k % 4], "linewidth": 2.4, "zorder": 4}
        for k, label in enumerate(filter(lambda label: is_own(label, own), labels))
    }
    others = [label for label in labels if label not in mine]
    return mine | {
        label: {
            "color": palette[k % len(palette)],
            "linestyle": ("-", "--", ":", "-.")[k // len(palette) % 4],
            "linewidth": 1.3,
            "zorder": 2,
        }
        for k, label in enumerate(others)
    }


def chosen(curves, own):
    """(curves to draw, labels left out): own ones first, printed forms last, at most OTHERS."""
    ordered = sorted(alike(curves, own), key=lambda entry: (not is_own(entry[0], own), entry[0].endswith(PRINTED)))
    printed = [entry for entry in ordered if entry[0].endswith(PRINTED)]
    others = [entry for entry in ordered if entry not in printed]
    room = OTHERS - len(printed)
    return others[:room] + printed, [label for label, _ in others[room:]]


def fitted(label, width):
    """The first names of curves that lie on each other, as many as a legend of this width [inches] has room for."""
    names, most = label.split(", "), int((width - 0.55) / 0.075)
    for n in range(len(names), 1, -1):
        text = ", ".join(names[:n]) + (f" and {len(names) - n} more" if n < len(names) else "")
        if len(text) <= most:
            return text
    return names[0] + (f" and {len(names) - 1} more" if names[1:] else "")


def plotted(axis, label, curve, look):
    """A curve, and dots where the run wrote frames and rates."""
    times, values, rates = curve
    axis.plot(*smooth(times, values, rates), label=label, **look)
    if rates is not None:
        axis.plot(
            times, values, linestyle="none", marker="o", markersize=2.2, color=look["color"], zorder=look["zorder"]
        )


def picture(out, name, title, axis_label, curves, truth, caption, own=(), band=None):
    """@param curves [(label, (times, values, rates or None))]   @param truth (label, such a curve, or None where it is
    0)   @param band half width about 0 that counts as right
    """
    from figures import style

    if not curves:
        return None
    drawn, left_out = chosen(curves, own)
    looks = looks_of([label for label, _ in drawn], own)

    def draw(width):
        figure, axis = canvas(width, 4.2)
        if truth[1] is None:
            axis.axhline(0.0, color=style.GREY, linewidth=5, alpha=0.55, label=truth[0], zorder=1)
        else:
            axis.plot(*smooth(*truth[1]), color=style.GREY, linewidth=5, alpha=0.55, label=truth[0], zorder=1)
        for label, curve in drawn:
            plotted(axis, fitted(label, width), curve, looks[label])
        if band:
            low, high = axis.get_ylim()
            axis.axhspan(-band, band, color=style.GREEN, alpha=0.08, zorder=0)
            axis.set_ylim(min(low, -1.2 * band), max(high, 1.2 * band))
        axis.set_xlabel("time [s]")
        axis.set_ylabel(axis_label)
        frame(figure, axis, len(drawn) + 1)
        return figure

    more = f" Not drawn: {', '.join(left_out)}." if left_out else ""
    return finished(
        draw, out, name, title, f"{title}: {', '.join(label for label, _ in drawn)} over {truth[0]}.", caption + more
    )


def finished(draw, out, name, title, alt, caption):
    """Draws twice, for a page and for a telephone. @param draw (inches) -> figure"""
    from figures import Picture, style

    broad, slim = (
        style.inline(style.files(draw(width), out / "figures" / f"headline-{name}{suffix}"), f"headline-{name}{suffix}")
        for width, suffix in ((style.WIDTH, ""), (style.SLIM, "-narrow"))
    )
    return Picture(name, title, alt, caption, broad, f"figures/headline-{name}", False, slim)


def canvas(width, height):
    """One axis on a figure of this size [inches]."""
    from figures import style

    figure, (axis,) = style.panels(1, 1)
    figure.set_size_inches(width, height)
    return figure, axis


def frame(figure, axis, entries, left=0.75):
    from figures import style

    across = style.columns(axis.get_legend_handles_labels()[1], figure.get_figwidth())
    width, height = figure.get_figwidth(), figure.get_figheight()
    figure.subplots_adjust(
        left=left / width,
        right=1 - 0.15 / width,
        bottom=0.5 / height,
        top=1 - (0.2 + 0.2 * -(-entries // across)) / height,
    )
    style.legend(figure, [axis])
