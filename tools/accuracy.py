#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy over particles and steps: what the studies of cases/accuracy found, as kept numbers, pictures and a page.

    tools/accuracy.py keep RESULTS.json [RESULTS.json ...] --to docs/accuracy   keeps of each case of cases/accuracy its
    levels, orders and costs
    tools/accuracy.py draw docs/accuracy/*.json --to docs/accuracy             draws one picture a case
    tools/accuracy.py page docs/accuracy/*.json > docs/accuracy.md             writes the page
    tools/accuracy.py tables docs/accuracy/*.json                              prints every level of every study

Every number of page and pictures comes from results.json. Orders and extrapolated values are the harness's fits;
nothing is fitted here."""

import argparse
import json
import math
import sys
import textwrap
from pathlib import Path

AXES = {"spacing": "more particles", "time_step": "shorter steps"}
UNFIT = ("oscillating", "noise-limited", "too-few", "roundoff", "diverging")  # classes that show no order
HUES, NAMES = {"corrected": "#0072b2", "paper": "#d55e00"}, {"corrected": "corrected", "paper": "as printed"}
ORDER_OF_PAGE = ("melting", "contact", "elastic", "fig-09", "fig-10", "fig-12", "fig-13")

INTRODUCTION = """# Accuracy over particles and steps

The paper leaves open how accuracy depends on the number of particles and on the time step. Cases of three kinds of \
physics have an exact solution; the paper's figures 9, 10, 12 and 13 have none.

    tripoint validate accuracy --profile nightly --out accuracy-report   # 10 minutes
    tools/accuracy.py keep accuracy-report/results.json --to docs/accuracy   # a few minutes, with draw and page: \
pictures and this page
    tools/accuracy.py tables docs/accuracy/melting.json   # every order, and every level with its values and CPU seconds

**The answer in words.** The number of particles decides, and the step hardly matters. Within its bound the error of \
the step is of second order and below the error of the spacing. Where an exact
solution exists, more particles come nearer to it, with an order between one and two. The printed elasticity converges \
to a wrong limit. Its bar swings 2 M times as fast as the true one, with M the
lattice's gradient moment ([model.md](model.md), (12)). The figures show the same events at each level. How much melts \
and freezes, and where matter ends, changes by a few parts in a hundred
from level to level, mostly without an order. Particles melt one by one, and flowing liquid is chaotic.

**How to read the orders.** An order is the p of E + C h^p, fitted by the harness ([harness.md](harness.md)), with its \
95 % interval. "No order" has one of four reasons:

- the class of the fit has none;
- the interval holds 0;
- a number without a truth has no limit in the fit;
- the runs of one level scatter by as much as the two finest levels differ.

In the pictures a point is the mean of a level, its bar the least and greatest run, a dashed line the extrapolated \
value. Left: more particles, with the step at its bound. Right: shorter steps at one
spacing. The figures' scenes run two or three times a level, from starts that differ by a thousandth of a spacing.
"""


def spread(level):
    return max(level["values"]) - min(level["values"])


def mean(level):
    return sum(level["values"]) / len(level["values"])


def is_number(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


# --- keep
# ---------------------------------------------------------------------------------------------------------------


def levels_of(runs, axis, metric, mode):
    """Levels of one study, coarse to fine; a level whose run failed says so."""
    found = {}
    for run in runs:
        at = run["levels"].get(axis)
        if at is None or run["knobs"]["mode"] != mode:
            continue
        level = found.setdefault(at, {"at": at, "values": [], "cpu_s": [], "steps": [], "particles": 0, "failed": ""})
        value = run["metrics"].get(metric, {}).get("value")
        if run["status"] != "ok" or not is_number(value):
            level["failed"] = run["status"] if run["status"] != "ok" else "no number"
            continue
        level["values"].append(value)
        level["cpu_s"].append(run["cost"]["cpu_s"])
        level["steps"].append(run["knobs"]["time_step"])
        level["particles"] = int(run["cost"]["particles"])
    for level in found.values():
        for key in ("cpu_s", "steps"):
            level[key] = sum(level[key]) / len(level[key]) if level[key] else None
    return [found[at] for at in sorted(found, reverse=True)]


def study_of(engine, axis, metric, mode):
    order = next((o for o in engine["order"] if (o["axis"], o["metric"], o["mode"]) == (axis, metric, mode)), None)
    fit = {key: order.get(key) for key in ("value", "low", "high", "class", "floor", "coefficient")} if order else None
    levels = levels_of(engine["runs"], axis, metric, mode)
    fitted = order["step"] if order else []  # the case's own run may be no level of the study
    return {
        "axis": axis,
        "metric": metric,
        "mode": mode,
        "fit": fit,
        "levels": [
            level for level in levels if level["failed"] or any(math.isclose(level["at"], step) for step in fitted)
        ],
    }


def kept(case, metrics):
    engine = next(e for e in case["engines"] if e["name"] == "tripoint")
    pairs = dict.fromkeys((o["axis"], o["metric"], o["mode"]) for o in engine["order"])
    return {
        "case": case["id"],
        "title": case["title"],
        "kind": case["reference"]["kind"],
        "metrics": metrics,
        "studies": [study_of(engine, *pair) for pair in pairs if pair[0] in AXES],
    }


def units_of(path):
    import tomllib

    with open(path, "rb") as file:
        return {m["name"]: m.get("unit", "") for m in tomllib.load(file)["metric"]}


def keep(args):
    for path in args.results:
        for case in json.loads(Path(path).read_text(encoding="utf-8"))["cases"]:
            if not case["id"].startswith("accuracy/"):
                continue
            root = Path(__file__).resolve().parent.parent
            value = kept(case, units_of(root / "cases" / f"{case['id']}.toml"))
            to = Path(args.to) / f"{case['id'].split('/')[1]}.json"
            to.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")


# --- what the page says of a study
# --------------------------------------------------------------------------------------


def verdict(study, kind):
    """(words, order, extrapolated value): "no order" and why, or the order with its interval. What is no error of a
    truth tends to a limit, which the fit has to find."""
    fit = study["fit"]
    if why := why_no_ladder(study["levels"]) or why_no_fit(fit, kind):
        return why, None, None
    words = f"{fit['value']:.2f} ({fit['low']:.2f} to {fit['high']:.2f}), {fit['class']}"
    return words, fit["value"], fit["floor"] or None


def why_no_ladder(levels):
    """Why no order can be fitted to the levels; empty where one can."""
    good = [level for level in levels if level["values"] and not level["failed"]]
    failed = [level for level in levels if level["failed"]]
    if failed and not good:
        return f"no order: every level {failed[0]['failed']}"
    if len(good) < 4:
        return "no order: fewer than four levels have a number"
    if all(math.isclose(mean(a), mean(good[0]), rel_tol=1e-9) for a in good):
        return "the same at every level"
    scatter, step = max(spread(good[-1]), spread(good[-2])), abs(mean(good[-1]) - mean(good[-2]))
    if scatter > 0.0 and scatter >= step:
        return f"no order: scatter {short(scatter)}, difference {short(step if step > 1e-12 else 0.0)}"
    return ""


def why_no_fit(fit, kind):
    """Why the fit is no order; empty where it is one."""
    if not fit or fit["class"] in UNFIT or not is_number(fit["value"]):
        return f"no order: {fit['class'] if fit else 'not fitted'}"
    if not fit["low"] > 0.0:
        return f"no order: {fit['value']:.2f} in {fit['low']:.2f} to {fit['high']:.2f}"
    return "no order: the fit finds no limit" if not fit["floor"] and kind != "analytic" else ""


def short(value):
    return f"{value:.3g}"


def cell(level):
    if level["failed"]:
        return level["failed"]
    if len(level["values"]) == 1:
        return short(level["values"][0])
    return f"{short(mean(level))} ({short(min(level['values']))} to {short(max(level['values']))})"


def table(value, axis, metric):
    studies = [s for s in value["studies"] if (s["axis"], s["metric"]) == (axis, metric)]
    head = "spacing [mm]" if axis == "spacing" else "step [ms]"
    lines = [
        f"| {head} | particles | " + " | ".join(f"{NAMES[s['mode']]} | CPU s" for s in studies) + " |",
        "|---|---|" + "---|---|" * len(studies),
    ]
    for n, level in enumerate(studies[0]["levels"]):
        of_mode = [s["levels"][n] for s in studies]
        particles = max(l["particles"] for l in of_mode)
        cells = " | ".join(f"{cell(l)} | {short(l['cpu_s']) if l['cpu_s'] is not None else '-'}" for l in of_mode)
        lines.append(f"| {1e3 * level['at']:.4g} | {particles} | {cells} |")
    for name, pick in (("order", 0), ("extrapolated", 2)):
        cells = []
        for s in studies:
            said = verdict(s, value["kind"])[pick]
            cells.append(f"{said if pick == 0 else short(said) if said is not None else '-'} | ")
        lines.append(f"| {name} | | " + " | ".join(c.rstrip() for c in cells) + " |")
    return lines


def picture(value):
    name = value["case"].split("/")[1]
    return [f"![{value['title']}](accuracy/{name}.png)", ""]


def case_tables(value):
    lines = [f"## {value['title']}", "", f"Case `{value['case']}`.", ""]
    for metric, unit in value["metrics"].items():
        for axis, words in AXES.items():
            if any((s["axis"], s["metric"]) == (axis, metric) for s in value["studies"]):
                lines += [f"**{metric}**, {unit}: {words}.", "", *table(value, axis, metric), ""]
    return lines


def numbers(values):
    """(case, metric, axis, words of the verdict by mode, whether one of them is an order)"""
    for value in values:
        for metric in value["metrics"]:
            for axis in AXES:
                said = {
                    s["mode"]: verdict(s, value["kind"])
                    for s in value["studies"]
                    if (s["axis"], s["metric"]) == (axis, metric)
                }
                if said:
                    yield (
                        value["case"],
                        metric,
                        axis,
                        {mode: words for mode, (words, _, _) in said.items()},
                        any(order is not None for _, order, _ in said.values()),
                    )


def summary(values, all_rows=False):
    lines = ["| case | number | with | corrected | as printed |", "|---|---|---|---|---|"]
    left = {}
    for case, metric, axis, words, has_order in numbers(values):
        if has_order or all_rows:
            lines.append(
                f"| `{case}` | {metric} | {AXES[axis]} | " + " | ".join(words.get(mode, "-") for mode in NAMES) + " |"
            )
        else:
            left.setdefault((case.split("/")[1], AXES[axis]), []).append(metric)
    names = [f"- {case}, {axis}: {', '.join(metrics)}" for (case, axis), metrics in left.items()]
    return lines + (["", "No order is seen in:", "", *names] if left else [])


def in_order(paths):
    values = [json.loads(Path(p).read_text(encoding="utf-8")) for p in paths]
    return sorted(values, key=lambda v: ORDER_OF_PAGE.index(v["case"].split("/")[1]))


def say(lines):
    sys.stdout.write("\n".join(lines).rstrip() + "\n")


def page(args):
    values = in_order(args.kept)
    say(
        [
            INTRODUCTION,
            "## Orders found",
            "",
            *summary(values),
            "",
            "## Pictures",
            "",
            *(line for value in values for line in picture(value)),
        ]
    )


def tables(args):
    values = in_order(args.kept)
    say([*summary(values, all_rows=True), "", *(line for value in values for line in case_tables(value))])


# --- pictures
# -----------------------------------------------------------------------------------------------------------


def curve(axis, value, study, above):
    """@returns what the title says of it, and the places of its levels."""
    good = [level for level in study["levels"] if level["values"] and not level["failed"]]
    name, hue = NAMES[study["mode"]], HUES[study["mode"]]
    words, order, floor = verdict(study, value["kind"])
    size = abs if value["kind"] == "analytic" else float  # an error is drawn by its size
    x = [level["particles"] if study["axis"] == "spacing" else level["at"] for level in good]
    y = [size(mean(level)) for level in good]
    bars = [
        [max(0.0, m - min(map(size, l["values"]))) for m, l in zip(y, good)],
        [max(0.0, max(map(size, l["values"])) - m) for m, l in zip(y, good)],
    ]
    dashes, marker = ("-", "o") if study["mode"] == "corrected" else ("--", "s")
    axis.errorbar(x, y, yerr=bars, capsize=3, elinewidth=0.9, label=name, color=hue, linestyle=dashes, marker=marker)
    if floor is not None:
        axis.axhline(size(floor), color=hue, linewidth=0.8, linestyle=(0, (2, 3)))
    for place, level in zip(zip(x, y), good):
        axis.annotate(
            f"{level['cpu_s']:.2g} s",
            place,
            textcoords="offset points",
            xytext=(0, 7 if above else -13),
            fontsize=6.5,
            ha="center",
            color=hue,
        )
    return f"{name}: order {words}" if order is not None else f"{name}: {words.split(':')[0]}", x


def panel(style, axis, value, metric, knob):
    studies = [s for s in value["studies"] if (s["axis"], s["metric"]) == (knob, metric) and with_values(s)]
    height = {s["mode"]: max(abs(mean(level)) for level in with_values(s)) for s in studies}
    drawn = [curve(axis, value, s, height[s["mode"]] == max(height.values())) for s in studies]
    places = sorted({x for _, at in drawn for x in at})
    axis.margins(x=0.14, y=0.25)
    style.logarithmic(axis, "xy" if value["kind"] == "analytic" else "x")
    axis.set_xticks(places, [style.power(x) for x in places])
    if knob == "time_step":
        axis.invert_xaxis()
    axis.set_xlabel("particles in all" if knob == "spacing" else "time step [s], shorter to the right")
    axis.set_ylabel(metric)
    axis.set_title(
        "\n".join([*textwrap.wrap(f"{metric}, {value['metrics'][metric]}", 66), *(words for words, _ in drawn)]),
        fontsize=7.5,
    )


def with_values(study):
    return [level for level in study["levels"] if level["values"]]


def draw(args):
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "reports"))
    from figures import style

    for value in in_order(args.kept):
        pairs = list(dict.fromkeys((s["metric"], s["axis"]) for s in value["studies"]))
        pairs.sort(key=lambda pair: (list(value["metrics"]).index(pair[0]), list(AXES).index(pair[1])))
        figure, axes = style.panels(len(pairs), 2, height=3.0, columns=2)
        for axis, pair in zip(axes, pairs):
            panel(style, axis, value, *pair)
        style.legend(figure, axes)
        total = figure.get_figheight()
        figure.subplots_adjust(
            left=0.08, right=0.98, bottom=0.55 / total, top=1 - 0.95 / total, wspace=0.24, hspace=0.62
        )
        figure.savefig(Path(args.to) / f"{value['case'].split('/')[1]}.png", dpi=110, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, action, what in (
        ("keep", keep, "results"),
        ("draw", draw, "kept"),
        ("page", page, "kept"),
        ("tables", tables, "kept"),
    ):
        command = commands.add_parser(name)
        command.add_argument(what, nargs="+")
        if name not in ("page", "tables"):
            command.add_argument("--to", required=True)
        command.set_defaults(action=action)
    args = parser.parse_args()
    args.action(args)


if __name__ == "__main__":
    main()
