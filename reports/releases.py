# SPDX-License-Identifier: BSD-3-Clause
"""The page "Can I upgrade?": error and observed order over the releases of an engine, from the releases.json that
`tripoint releases` leaves.

releases.py releases.json [index.html]
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import foreign
import headlines
import page
from model import number, ordered, rows, text


def presets_of(document):
    """Presets in the order in which the releases have them."""
    return list(
        dict.fromkeys(
            text(row.get("preset")) for release in rows(document.get("releases")) for row in rows(release.get("rows"))
        )
    )


def row_of(release, preset):
    return next((row for row in rows(release.get("rows")) if row.get("preset") == preset), {})


def measured(release, preset, metric):
    """@return (error, order); None where there is none"""
    found = (row_of(release, preset).get("metrics") or {}).get(metric) or {}
    return number(found.get("value")), number(found.get("order"))


def class_of(release, preset, metric):
    return text(((row_of(release, preset).get("metrics") or {}).get(metric) or {}).get("class"))


def cell(release, preset, metric):
    row = row_of(release, preset)
    error, order = measured(release, preset, metric)
    if row.get("status") != "ok" or error is None:
        return {"text": text(row.get("status")) or "no such preset", "note": text(row.get("reason"))}
    return {
        "text": page.show(error),
        "note": "" if order is None else f"order {ordered(order, class_of(release, preset, metric))}",
    }


def label(release):
    return f"{text(release.get('engine'))} {text(release.get('version'))}"


def draw(document, out):
    """@return a picture: a line of panels a metric, its error (log) and its order over the releases"""
    from figures import Picture, style

    presets, releases = presets_of(document), rows(document.get("releases"))
    versions = [text(release.get("version")) for release in releases]
    panels = [
        (name, what)
        for name in (text(metric.get("name")) for metric in rows(document.get("metrics")))
        for what in (0, 1)
        if any(measured(release, preset, name)[what] is not None for release in releases for preset in presets)
    ]  # round-off has no order, and no empty panel
    if not panels:
        return None
    title = ("error at the case's own time step", "observed order in the time step")

    def drawn(columns, suffix):
        figure, axes = style.panels(len(panels), len(presets), columns=columns)
        for axis, (name, what) in zip(axes, panels):
            for k, preset in enumerate(presets):
                found = [measured(release, preset, name)[what] for release in releases]
                points = [(x, y if what else max(abs(y), 1e-16)) for x, y in enumerate(found) if y is not None]
                if points:
                    axis.plot(
                        *zip(*points),
                        color=style.HUES[k % len(style.HUES)],
                        marker=style.MARKERS[k % len(style.MARKERS)],
                        label=preset,
                    )
            if not what:
                style.logarithmic(axis, "y")
            axis.set_title(f"{name}: {title[what]}")
            axis.set_xticks(range(len(versions)), versions, rotation=20, ha="right")
        style.legend(figure, axes)
        return style.inline(style.files(figure, Path(out) / f"releases{suffix}"), f"releases{suffix}")

    return Picture(
        "releases",
        "Error and observed order by release",
        f"Error and order of {', '.join(presets)} over {len(releases)} releases.",
        "Errors are on a logarithmic axis. An order of 2 means that half the time step leaves a quarter of the error; "
        "where errors are round-off there is no order.",
        drawn(2, ""),
        "releases",
        False,
        drawn(1, "-narrow"),
    )


def change_line(change):
    before, after = number(change.get("before")), number(change.get("after"))
    orders = [number(change.get(key)) for key in ("order_before", "order_after")]
    note = f"order {orders[0]:.1f} to {orders[1]:.1f}" if None not in orders else ""
    return {
        "from": text(change.get("from")),
        "to": text(change.get("to")),
        "preset": text(change.get("preset")),
        "metric": text(change.get("metric")),
        "before": page.show(before),
        "after": page.show(after),
        "word": "worse" if change.get("worse") else "better",
        "note": note or (("was" if change.get("worse") else "is") + " round-off" if change.get("round_off") else ""),
    }


def gate_line(release, row, gate):
    return {
        "release": label(release),
        "preset": text(row.get("preset")),
        "metric": text(gate.get("metric")),
        "verdict": text(gate.get("verdict")),
        "why": text(gate.get("why")),
    }


def render(document, picture):
    """@return HTML"""
    releases, presets = rows(document.get("releases")), presets_of(document)
    metrics = [
        {
            "name": text(m.get("name")),
            "unit": text(m.get("unit")),
            "lines": [
                {"release": label(r), "cells": [cell(r, preset, text(m.get("name"))) for preset in presets]}
                for r in releases
            ],
        }
        for m in rows(document.get("metrics"))
    ]
    gates = [
        gate_line(r, row, gate) for r in releases for row in rows(r.get("rows")) for gate in rows(row.get("gates"))
    ]
    red = [gate for gate in gates if gate["verdict"] != "pass"]
    return page.fill(
        "releases.html.j2",
        SimpleNamespace(tool={}, profile=""),
        document=document,
        presets=presets,
        metrics=metrics,
        picture=picture,
        answer=headlines.upgrade_answer(document),
        changes=[change_line(c) for c in rows(document.get("changes"))],
        gates=len(gates),
        red=red,
        notes=[],
    )


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    source = Path(arguments[0])
    target = Path(arguments[1]) if len(arguments) == 2 else source.parent / "index.html"
    try:
        document = foreign.read(source)
    except (OSError, ValueError) as reason:
        print(f"releases: {source}: {reason}", file=sys.stderr)
        return 2
    try:
        picture = draw(document, target.parent)
    except ImportError as reason:  # the tables stand without the figure
        picture = None
        print(f"releases: no figure: {reason}", file=sys.stderr)
    target.write_text(render(document, picture), encoding="utf-8")
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
