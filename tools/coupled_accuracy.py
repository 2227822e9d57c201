#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How accurate is a unified particle model? Error over uncertainty of each published benchmark of coupling.

    tools/coupled_accuracy.py table                                    prints ours at each spacing, and published codes
    tools/coupled_accuracy.py draw --to docs/accuracy/coupled.png      draws them

Ours are the accepted figures of baselines/coupled, in units of the standard uncertainty of the reference. Published
codes are columns of the data beside the cases, against the same reference at the same times. The uncertainty is
that of the case, of the table, or of the baseline, whichever is stated."""

import argparse
import math
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# case, metric, label, standard uncertainty in the metric's unit, codes: label -> column (reference column first)
ROWS = (
    (
        "obstacle",
        "way",
        "dam break on an elastic obstacle",
        4.0,
        ("mean", "idelsohn liu sun bogaers meduri ryzhakov"),
        1.0,
    ),
    ("elastic-gate", "opens", "elastic gate, opening until 0.12 s", 1.5, ("x", "khayyer_x yang_x ng_x"), 1.0),
    ("cylinder-entry", "depth", "half-buoyant cylinder enters water", 0.015, ("bem500", "sph500 test500"), 1.0),
    ("cylinder-entry-neutral", "depth", "neutral cylinder enters water", 0.015, ("bem1000", "sph1000"), 1.0),
    ("wedge-entry", "speed", "wedge enters water", 0.02, ("bem", "sph test"), 5.05),
    ("heave", "height", "heave of a cylinder", 0.01, None, 1.0),
    ("sinking-box", "speed", "sinking box, speed", 0.045, None, 1.0),
    ("rising-box", "peak", "rising box, greatest height", 1.0, None, 1.0),
    ("falling-disc", "terminal", "disc in a viscous liquid, final speed", 0.011, None, 1.0),
    ("turek-hron-cfd1", "drag", "Turek-Hron CFD1, drag", 0.001, None, 1.0),
    ("turek-hron-csm3", "mean", "Turek-Hron CSM3, mean deflection", 0.01, None, 1.0),
    ("wall-pressure", "P1 plateau", "pressure on a wall, P1", 0.03, None, 1.0),
    ("wall-pressure", "P4", "pressure on a wall, P4", 0.03, None, 1.0),
    ("cavity-1e3", "nusselt", "square cavity, Ra 1e3, Nusselt", 0.002, None, 1.0),
    ("cavity-1e4", "nusselt", "square cavity, Ra 1e4, Nusselt", 0.002, None, 1.0),
    ("cavity-1e5", "nusselt", "square cavity, Ra 1e5, Nusselt", 0.002, None, 1.0),
)
STARTS = {"obstacle": 0.14, "elastic-gate": 0.0}  # [s] the metric's window begins
ENDS = {"obstacle": 0.32, "elastic-gate": 0.121}


def columns(case):
    """Columns of a table beside a case, times in their unit first."""
    name = "cylinder-entry" if case.startswith("cylinder-entry") else case
    lines = (ROOT / f"cases/coupled/{name}.ref.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines if line and not line.startswith("#")]
    return {head: [float(row[i]) for row in rows[1:]] for i, head in enumerate(rows[0])}


def of_codes(case, names, scale):
    """Root mean square of each code's difference from the reference, in the metric's unit."""
    if names is None:
        return {}
    table = columns(case)
    first, last = STARTS.get(case, -math.inf), ENDS.get(case, math.inf)
    kept = [i for i, t in enumerate(table["time"]) if first <= t <= last]
    truth = table[names[0]]

    def error(code):
        return math.sqrt(sum((table[code][i] - truth[i]) ** 2 for i in kept) / len(kept)) / scale

    return {code: error(code) for code in names[1].split()}


def of_ours(case, metric):
    """Accepted figures by level, coarse to fine; the only one has level None."""
    file = ROOT / f"baselines/coupled/{case}.toml"
    if not file.exists():
        return []
    gates = [g for g in tomllib.loads(file.read_text())["gate"] if g["metric"] == metric and g["engine"] == "tripoint"]
    return sorted(((g.get("level"), g["value"]) for g in gates), key=lambda pair: -(pair[0] or 0.0))


def rows():
    """Label, ours and codes of each benchmark that has accepted figures, in standard uncertainties."""
    for case, metric, label, uncertainty, names, scale in ROWS:
        ours = [(level, abs(value) / uncertainty) for level, value in of_ours(case, metric)]
        if metric == "peak":  # a height that the case states as it is: 51.2 mm is the truth
            ours = [(level, abs(value * uncertainty - 51.2) / uncertainty) for level, value in ours]
        if ours:
            yield label, ours, {code: e / uncertainty for code, e in of_codes(case, names, scale).items()}


def draw(to):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    shown = list(rows())[::-1]
    figure, axes = pyplot.subplots(figsize=(9.0, 0.42 * len(shown) + 1.4))
    axes.axvspan(0.02, 2.0, color="0.9", label="two standard uncertainties of the reference")
    for y, (_, ours, codes) in enumerate(shown):
        axes.plot(
            list(codes.values()),
            [y] * len(codes),
            "x",
            color="tab:orange",
            label="published codes and tests" if codes else None,
        )
        values = [value for _, value in ours]
        axes.plot(values, [y] * len(values), "-", color="tab:blue", lw=1)
        for i, value in enumerate(values):
            axes.plot(value, y, "o", color="tab:blue", ms=5 + 3 * (i == len(values) - 1))
    axes.plot([], [], "o", color="tab:blue", label="ours; larger: the finest spacing")
    axes.set_yticks(range(len(shown)), [label for label, _, _ in shown])
    axes.set_xscale("log")
    axes.set_xlim(0.1, 100)
    axes.set_xlabel("error over the standard uncertainty of the reference")
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles))
    axes.legend(unique.values(), unique.keys(), loc="upper center", bbox_to_anchor=(0.4, 1.12), ncols=3, fontsize=8)
    figure.tight_layout()
    figure.savefig(to, dpi=110, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("table", "draw"))
    parser.add_argument("--to", default="docs/accuracy/coupled.png")
    given = parser.parse_args()
    if given.what == "draw":
        draw(given.to)
        return
    for label, ours, codes in rows():
        levels = ", ".join(f"{value:.2f}" + (f" at {level:g} m" if level else "") for level, value in ours)
        others = ", ".join(f"{code} {value:.2f}" for code, value in codes.items())
        print(f"{label}: ours {levels}" + (f"; {others}" if others else ""))


if __name__ == "__main__":
    main()
