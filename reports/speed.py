# SPDX-License-Identifier: BSD-3-Clause
"""The page "Speed": the solver and its peers on the same particles, from the speed.json that `make bench-peers` leaves.

speed.py speed.json [speed.html]
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import foreign
import page
from model import number, rows, text

MEANING = {
    "liquid-heat-40k": "a cube of 39,304 particles of liquid that conducts heat, drawn out in free flight",
    "liquid-heat-200k": "the same cube, 195,112 particles",
    "elastic-40k": "a free elastic cube of 39,304 particles that swings",
}


def spread(value):
    """median (least to greatest), or a dash."""
    if not isinstance(value, dict) or number(value.get("median")) is None:
        return "—"
    return f"{value['median']:.2f} ({value['least']:.2f} to {value['greatest']:.2f})"


def milliseconds(value):
    return f"{1e3 * value['median']:.1f}" if isinstance(value, dict) else "—"


def line(raw):
    rate = number(raw.get("particle_steps_per_s"))
    return {
        "code": text(raw.get("code")),
        "parallel": raw.get("parallel"),
        "error": text(raw.get("error")),
        "leaves_out": text(raw.get("leaves_out")),
        "ms": milliseconds(raw.get("step_s")),
        "cpu_ms": milliseconds(raw.get("cpu_s")),
        "rate": f"{1e-6 * rate:.2f}" if rate else "—",
        "neighbours": page.show(number(raw.get("neighbours"))),
        "rebuilds": page.show(number(raw.get("rebuilds_per_step"))),
        "particle_step": spread(raw.get("ratio_particle_step")),
        "pair": spread(raw.get("ratio_pair")),
        "best": page.show(number(raw.get("ratio_best"))),
        "cpu": spread(raw.get("ratio_cpu")),
        "limit": spread(raw.get("over_limit")),
    }


def render(document):
    """@return HTML. @param document what bench_peers.py wrote"""
    works = {}
    for raw in rows(document.get("rows")):
        works.setdefault(text(raw.get("work")), []).append(line(raw))
    results = SimpleNamespace(tool={}, profile="")
    return page.fill(
        "speed.html.j2",
        results,
        works=works,
        meaning=MEANING,
        machine=document.get("machine", {}),
        rounds=document.get("rounds"),
        notes=[],
    )


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        print(__doc__, file=sys.stderr)
        return 2
    source = Path(arguments[0])
    target = Path(arguments[1]) if len(arguments) == 2 else source.with_suffix(".html")
    try:
        document = foreign.read(source)
    except (OSError, ValueError) as reason:
        print(f"speed: {source}: {reason}", file=sys.stderr)
        return 2
    target.write_text(render(document), encoding="utf-8")
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
