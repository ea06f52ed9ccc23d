"""Monotone and Akima velocities of one coordinate in exact fractions, and how small errors grow by them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product

import numpy as np

SMALL = Fraction(1, 10**40)
"""Size of a move: what is left out of a difference is about as small against it."""


def sign(value):
    return (value > 0) - (value < 0)


def akima(points, t):
    """Akima's rule of 1970."""
    slopes = [(q - p) / (u - s) for p, q, s, u in zip(points, points[1:], t, t[1:], strict=False)]
    first, last = (slopes[1] - slopes[0], slopes[-1] - slopes[-2]) if len(slopes) > 1 else (0, 0)
    slopes = [slopes[0] - 2 * first, slopes[0] - first, *slopes, slopes[-1] + last, slopes[-1] + 2 * last]
    found = []
    for far, before, after, beyond in zip(slopes, slopes[1:], slopes[2:], slopes[3:], strict=False):
        weights = abs(beyond - after), abs(before - far)
        total = sum(weights)
        found.append((weights[0] * before + weights[1] * after) / total if total else (before + after) / 2)
    return found


def monotone(points, t):
    """The rule of Fritsch and Carlson with the weights of Fritsch and Butland."""
    h = [u - s for s, u in pairwise(t)]
    slopes = [(q - p) / each for p, q, each in zip(points, points[1:], h, strict=False)]
    if len(slopes) == 1:
        return slopes * 2

    def end(near, beside):
        own, other = slopes[near], slopes[beside]
        velocity = own + h[near] / (h[near] + h[beside]) * (own - other)
        if sign(velocity) != sign(own):
            return Fraction(0)
        return 3 * own if sign(own) != sign(other) and abs(velocity) > 3 * abs(own) else velocity

    inner = []
    for before, after, g, k in zip(slopes, slopes[1:], h, h[1:], strict=False):
        weights = 2 * k + g, k + 2 * g
        rises = before * after > 0
        inner.append(sum(weights) / (weights[0] / before + weights[1] / after) if rises else Fraction(0))
    return [end(0, 1), *inner, end(-1, -2)]


def changes(rule, points, t, moves):
    """What a small move of each point, in its direction, does to the velocities, per unit of the move."""
    points, t = [Fraction(p) for p in points], [Fraction(each) for each in t]
    moved = [p + SMALL * Fraction(by) for p, by in zip(points, moves, strict=True)]
    rest = rule(points, t)
    return np.array([float((v - w) / SMALL) for v, w in zip(rule(moved, t), rest, strict=True)])


def growth(rule, points, t, closed, samples):
    """The largest displacement of a coordinate by small errors of any signs, at samples s of each segment."""
    h, n = np.diff(t), len(points)
    around = (points * 3 + points[:1], slice(n, 2 * n + 1)) if closed else (points, slice(None))
    period = t[-1] - t[0]
    times = [each + turn * period for turn in (-1, 0, 1) for each in t[:-1]] + [t[0] + 2 * period]
    best, s, r = 0.0, samples, 1.0 - samples
    for signs in product((-1, 1), repeat=n):
        errors = [*signs * 3, signs[0]] if closed else signs
        velocities = changes(rule, around[0], times if closed else t, errors)[around[1]]
        ends = np.array(errors[around[1]], dtype=float)[:, None]
        moved = ends[:-1] * r**2 * (1 + 2 * s) + ends[1:] * s**2 * (3 - 2 * s)
        moved += h[:, None] * s * r * (r * velocities[:-1, None] - s * velocities[1:, None])
        best = max(best, float(np.abs(moved).max()))
    return best
