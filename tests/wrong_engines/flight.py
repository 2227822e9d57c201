# SPDX-License-Identifier: BSD-3-Clause
"""Right physics of free rigid bodies: the parabola, and Euler's equations of the free top by the classical Runge-Kutta
rule."""

import math


def product(a, b):
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def conjugate(q):
    return (q[0], -q[1], -q[2], -q[3])


def rotate(q, v):
    return product(product(q, (0.0, *v)), conjugate(q))[1:]


def scaled(q, angle_factor):
    """The rotation about the same axis by another angle."""
    half = math.acos(max(-1.0, min(1.0, q[0])))
    sine = math.sin(half)
    share = math.sin(angle_factor * half) / sine if sine else 0.0
    return (math.cos(angle_factor * half), *(share * c for c in q[1:]))


def by_inertia(body, q, v, power):
    """I^power v in the orientation q, v in the world frame."""
    axes = product(q, body["principal_axes"])
    return rotate(
        axes, [c * i**power if i > 0.0 else 0.0 for c, i in zip(rotate(conjugate(axes), v), body["principal_inertia"])]
    )


def turned(body, q, L, span, limit):
    """The orientation after a time, by steps of `limit` at most: q' = w q / 2, w = I^-1 L."""

    def rate(q):
        return [0.5 * c for c in product((0.0, *by_inertia(body, q, L, -1)), q)]

    def ahead(q, h, k):
        return [a + h * b for a, b in zip(q, k)]

    steps = max(1, math.ceil(span / limit - 1e-9))
    h = span / steps
    for _ in range(steps):
        k1 = rate(q)
        k2 = rate(ahead(q, h / 2, k1))
        k3 = rate(ahead(q, h / 2, k2))
        k4 = rate(ahead(q, h, k3))
        q = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(q, k1, k2, k3, k4)]
    return [c / math.hypot(*q) for c in q]


def fly(scene, times, step):
    """Rows [time, body, x, y, z, vx, vy, vz, qw, qx, qy, qz, wx, wy, wz] of every body, frame by frame."""
    bodies = scene["bodies"]
    turn = {b["index"]: [1.0, 0.0, 0.0, 0.0] for b in bodies}
    spin = {b["index"]: by_inertia(b, turn[b["index"]], b["angular_velocity"], 1) for b in bodies}
    last = times[0]
    for t in times:
        for b in bodies:
            k = b["index"]
            if t > last:
                turn[k] = turned(b, turn[k], spin[k], t - last, step)
            x = [c + v * t + 0.5 * a * t * t for c, v, a in zip(b["centre"], b["velocity"], scene["gravity"])]
            v = [c + a * t for c, a in zip(b["velocity"], scene["gravity"])]
            yield [t, k, *x, *v, *turn[k], *by_inertia(b, turn[k], spin[k], -1)]
        last = t
