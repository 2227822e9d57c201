# SPDX-License-Identifier: BSD-3-Clause
"""The page "what one more digit costs": along every ladder of levels, CPU seconds and pairs for a tenth of the error.

Error is |value| + 2 u of a run, as a limit sees it. The slope is that between two levels in log-log: the finest and the
nearest one that is at least 1.5 times as coarse. Coarser ones are dear by the start of the program, not by their work;
between closer ones the scatter of the error is as large as its fall. Nothing is said outside what was measured."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from model import is_number, number, rows, table, text

EXACT = "exact"
APART = 1.5  # least ratio of the two levels between which a slope is taken, where the ladder has such a pair
GAIN = 0.8  # of the error left after a step of two in the level: where more is left, finer levels buy no accuracy


@dataclass
class Ladder:
    case: object
    engine: object
    mode: str
    axis: str
    metric: str
    points: list  # (level, error, cpu_s, pairs), coarse to fine
    failed: list = field(default_factory=list)  # what a level that gave no error says
    slope: float | None = None  # of CPU seconds over 1/error
    pairs: float | None = None  # of pairs over 1/error
    theory: float | None = None
    why: str = ""  # no slope can be given

    @property
    def label(self):
        return f"{self.engine.label}{', ' + self.mode if self.mode else ''}"

    @property
    def factor(self):
        return 10.0**self.slope if self.slope is not None else None

    @property
    def time(self):
        """ "2.7 s become 6 days", of the finest level; empty without a factor."""
        return (
            f"{spoken(self.points[-1][2])} become {spoken(self.factor * self.points[-1][2])}"
            if self.factor is not None and self.points
            else ""
        )

    @property
    def factor_pairs(self):
        return 10.0**self.pairs if self.pairs is not None else None

    @property
    def factor_theory(self):
        return 10.0**self.theory if self.theory is not None else None


def plain(factor):
    """Three digits of a factor, and no power of ten up to a thousand million: a slope through two levels holds no
    more."""
    return f"{float(f'{factor:.3g}'):,.0f}" if 100.0 <= factor < 1e9 else f"{factor:.3g}"


def times(factor):
    """Two digits: a factor from two levels has no more."""
    return f"{plain(float(f'{factor:.2g}'))} ×"


def spoken(seconds):
    """ "0.3 s", "12 min", "6 days", "3e+04 years"."""
    for size, unit in ((31557600.0, "years"), (86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"


def floor_of(case):
    """Factor by which an engine's CPU seconds differed from themselves; None where no run was timed."""
    floor = number(table(case.raw.get("timing")).get("noise_floor"))
    return floor if is_number(floor) and floor >= 1.0 else None


def read(results):
    """@return ladders with a slope, dearest digit first, then those without"""
    found = []
    for case in results.cases:
        for study in rows(case.raw.get("studies")):
            axis, wanted = text(study.get("axis")), text(study.get("metric"))
            for engine in case.engines:
                if engine.name == EXACT or text(study.get("engine")) not in ("", engine.name):
                    continue
                for mode in engine.modes:
                    if text(study.get("mode")) in ("", mode):
                        ladder = ladder_of(
                            case, engine, mode, axis, wanted or first_metric(case), number(study.get("order"))
                        )
                        if ladder and not any(same(ladder, other) for other in found):
                            found.append(ladder)
    return sorted(found, key=lambda ladder: (ladder.slope is None, -(ladder.slope or 0.0)))


def without_study(results):
    """Cases of which nothing was refined, so that nothing says what one more digit of theirs costs."""
    return [case for case in results.cases if not rows(case.raw.get("studies"))]


def same(a, b):
    return (a.case.id, a.engine.label, a.mode, a.axis, a.metric) == (
        b.case.id,
        b.engine.label,
        b.mode,
        b.axis,
        b.metric,
    )


def first_metric(case):
    return next((text(m.get("name")) for m in case.metrics), "")


def ladder_of(case, engine, mode, axis, metric, formal):
    levels, failed = levels_of(engine, mode, axis, metric)
    if len(levels) + len(failed) < 2:
        return None
    upward = axis in ("walkers", "iterations", "support_ratio")
    points = [
        (level, *[sum(column) / len(group) for column in zip(*group)])
        for level, group in sorted(levels.items(), reverse=not upward)
    ]
    ladder = Ladder(case, engine, mode, axis, metric, [point[:4] for point in points], failed)
    settle(ladder, points, formal)
    return ladder


def levels_of(engine, mode, axis, metric):
    """({level: [(error, CPU seconds, pairs, time step)]}, what each level says that gave no error)"""
    levels, failed = {}, []
    for run in engine.runs:
        level, value = number(run.levels.get(axis)), run.metrics.get(metric)
        if run.mode != mode or not is_number(level):
            continue
        cost = number(run.cost.get("cpu_s"))
        if run.status != "ok" or value is None or not is_number(value.value):
            failed.append(f"{level:.4g}: {run.reason or run.status}")
        elif is_number(cost) and cost > 0:
            error = abs(value.value) + 2.0 * (value.u or 0.0)
            point = (error, cost, number(run.cost.get("pairs")) or 0.0, run.knob("time_step") or 0.0)
            levels.setdefault(level, []).append(point)
    return levels, failed


def settle(ladder, points, formal):
    """Slopes, or why there are none."""
    points = [point for point in points if point[1] > 0]
    if len(points) < 2:
        ladder.why = "fewer than two levels gave an error above 0"
        return
    ladder.theory = theory(ladder.axis, points, formal)
    coarse, fine = apart(points)
    ladder.why = why_no_slope(ladder, coarse, fine)
    if not ladder.why:
        ladder.slope = slope(coarse, fine, 2)
        if coarse[3] > 0 and fine[3] > 0:
            ladder.pairs = slope(coarse, fine, 3)


def why_no_slope(ladder, coarse, fine):
    """Why these two levels have none; empty where they have one."""
    orders = [
        order.fit_class
        for order in ladder.engine.orders
        if (order.metric, order.axis, order.mode) == (ladder.metric, ladder.axis, ladder.mode)
    ]
    left, floor = GAIN ** min(1.0, math.log2(ratio(coarse, fine))), floor_of(ladder.case)
    if fine[1] > left * coarse[1] or "plateau" in orders:
        return "finer levels buy no accuracy here" + (": the error has a floor" if orders[:1] == ["plateau"] else "")
    if fine[2] < 1.2 * coarse[2]:
        return "cost is that of starting the program: too short to say"
    if floor and fine[2] <= floor * coarse[2]:
        return f"not resolved: the two levels cost the same within the noise floor, a factor {floor:.3g}"
    return ""


def ratio(a, b):
    """Of two levels, at least 1, whichever way the axis is refined."""
    return max(a[0] / b[0], b[0] / a[0])


def apart(points):
    """@return (coarse, fine): the finest level and the nearest that is APART from it, or the coarsest of a ladder so
    short that none is"""
    return next(
        (point for point in reversed(points[:-1]) if ratio(point, points[-1]) > APART * (1.0 - 1e-9)), points[0]
    ), points[-1]


def slope(coarse, fine, cost):
    """Of work over accuracy."""
    return math.log(fine[cost] / coarse[cost]) / math.log(coarse[1] / fine[1])


def theory(axis, points, formal):
    """Work over accuracy of an explicit scheme of the declared order: particles grow with the third power of 1/spacing,
    and steps as the time step that was used."""
    if axis == "walkers":
        return 2.0  # the error falls with the root of their number
    if not formal or formal <= 0 or len(points) < 2:
        return None
    if axis == "time_step":
        return 1.0 / formal
    if axis == "spacing" and points[0][4] > 0 and points[-1][4] > 0:
        steps = math.log(points[-2][4] / points[-1][4]) / math.log(points[-2][0] / points[-1][0])
        return (3.0 + max(0.0, steps)) / formal
    return None


def draw(ladders, out):
    """A bar for each ladder: the factor that a tenth of the error costs. @return picture for the page, or None"""
    from figures import finish, style
    from figures.curve import Drawing

    shown = [ladder for ladder in ladders if ladder.factor is not None]
    if not shown:
        return None
    names = [ladder.engine.name for ladder in shown]
    height = 0.9 + 0.27 * len(shown)
    figure = style.Figure(figsize=(style.WIDTH, height))
    style.FigureCanvasAgg(figure)
    axis = figure.add_axes((0.42, 0.55 / height, 0.55, 1 - 0.8 / height))
    for k, ladder in enumerate(shown):
        hue = style.colour(ladder.engine.name, names)
        axis.barh(
            k, ladder.factor - 1.0, left=1.0, height=0.62, color=hue, alpha=0.55 if ladder.mode == "paper" else 1.0
        )
        if ladder.factor_theory:
            axis.plot([ladder.factor_theory] * 2, [k - 0.42, k + 0.42], color=style.INK, linewidth=1.6)
        mark = ladder.factor_theory or 0.0
        beside = mark if ladder.factor <= mark < 3.0 * ladder.factor else ladder.factor  # not under the black line
        axis.annotate(
            plain(ladder.factor),
            (beside, k),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
            color=style.INK,
        )
    axis.set_yticks(
        range(len(shown)),
        [f"{ladder.case.id} · {ladder.label} · {ladder.axis.replace('_', ' ')}" for ladder in shown],
        fontsize=8,
    )
    axis.set_xscale("log")
    axis.set_xlim(1.0, 3.0 * max(max(ladder.factor, ladder.factor_theory or 1.0) for ladder in shown))
    axis.xaxis.set_major_formatter(style.ticker.FuncFormatter(style.power))
    axis.set_xlabel("times the CPU seconds, for a tenth of the error (black: theory's slope)")
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    caption = (
        "Shorter is better. Pale bars: the printed equations. The black line is what an explicit scheme of the "
        "declared order pays: the third power of 1/spacing in particles, and the steps that were taken."
    )
    return finish(
        Drawing(
            "digit",
            "A tenth of the error, in CPU seconds",
            "Bars of the factor in CPU seconds for a tenth of the error, one for each case, engine and mode.",
            figure,
            caption,
        ),
        out,
        "00-suite",
    )
