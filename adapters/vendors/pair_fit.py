# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of single surfaces whose combination, by an engine's own rule, gives the friction that a scene states of
pairs of materials.

A pair that no table states and no setting names is free: the engine's own rule decides it."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from contract import Job
from rigid import PairLaws

Pair = tuple[str, str]


def stated_friction(job: Job, materials: list[str]) -> dict[Pair, float]:
    """Friction of each pair that the scene states, or that the setting `friction` holds for."""
    names, laws = list(dict.fromkeys(materials)), PairLaws(job)
    pairs = [(a, b) for k, a in enumerate(names) for b in names[k:]]
    return {
        (a, b): laws.of(a, b)[0] for a, b in pairs if "friction" in job.settings or frozenset((a, b)) in laws.stated
    }


def _holds(wanted: dict[Pair, float], of: dict[str, float], rule: Callable[[float, float], float]) -> bool:
    return all(abs(rule(of[a], of[b]) - mu) <= 1e-9 * max(mu, 1.0) for (a, b), mu in wanted.items())


def least(a: float, b: float) -> float:
    return min(a, b)


def harmonic(a: float, b: float) -> float:
    return 2.0 * a * b / (a + b) if a + b > 0.0 else 0.0


def by_least(wanted: dict[Pair, float]) -> dict[str, float] | None:
    """Of an engine that takes the smaller of both numbers. @return None where no numbers do"""
    of = {name: max(mu for pair, mu in wanted.items() if name in pair) for pair in wanted for name in pair}
    return of if _holds(wanted, of, least) else None


def by_harmonic_mean(wanted: dict[Pair, float]) -> dict[str, float] | None:
    """Of an engine that takes 2 a b / (a + b). @return None where no numbers do"""
    inverse: dict[str, float] = {}

    def follow(name: str) -> None:
        if inverse[name] == inf:  # without friction whatever the other surface is
            return
        for (a, b), mu in wanted.items():
            other = b if a == name else a if b == name else name
            if other not in inverse:
                inverse[other] = max(0.0, (2.0 / mu if mu > 0.0 else inf) - inverse[name])
                follow(other)

    def partners(
        name: str,
    ) -> tuple[bool, int]:  # a pair of one material leaves no choice; then the middle of a star comes first
        return (name, name) not in wanted, -sum(name in pair for pair in wanted)

    for name in sorted({name for pair in wanted for name in pair}, key=lambda name: (*partners(name), name)):
        if name not in inverse:
            greatest = wanted.get((name, name), max(mu for pair, mu in wanted.items() if name in pair))
            inverse[name] = 1.0 / greatest if greatest > 0.0 else inf
            follow(name)
    of = {name: 1.0 / x if x > 0.0 else 1e30 for name, x in inverse.items()}
    return of if _holds(wanted, of, harmonic) else None
