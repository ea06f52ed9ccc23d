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


def spline_velocities(points, t, given=None):
    """The velocities of the C² spline with those given; the others make c'' continuous, or 0 at an end.

    Of one coordinate, by elimination in exact fractions; `given` are velocities by their joints.
    """
    h = [v - u for u, v in pairwise(t)]
    slopes = [(q - p) / each for (p, q), each in zip(pairwise(points), h, strict=True)]
    rows = []
    for i in range(len(points)):
        row, right = [Fraction(0)] * len(points), Fraction(0)
        if i in (given or {}):
            row[i], right = Fraction(1), Fraction(given[i])
        else:
            # c'' at the end of the segment before, and at the beginning of the one after.
            for j, k in ((i, i - 1), (i, i + 1)):
                if 0 <= k < len(points):
                    segment = min(j, k)
                    row[j] += 4 / h[segment]
                    row[k] += 2 / h[segment]
                    right += 6 * slopes[segment] / h[segment]
        rows.append([*row, right])
    return solved(rows)


def solved(rows):
    """The solution of linear equations, each with its right side behind it."""
    for i in range(len(rows)):
        pivot = next(k for k in range(i, len(rows)) if rows[k][i])
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [each / rows[i][i] for each in rows[i]]
        for k, row in enumerate(rows):
            if k != i and row[i]:
                rows[k] = [a - row[i] * b for a, b in zip(row, rows[i], strict=True)]
    return [row[-1] for row in rows]


def bends_beside(points, t, velocities):
    """c'' of the cubic Hermite segments at the joints, before and after each; None beyond the ends."""
    before, after = [None], []
    for (p, q), (u, w), (s, e) in zip(pairwise(points), pairwise(velocities), pairwise(t), strict=True):
        h = e - s
        slope = (q - p) / h
        after.append((6 * slope - 4 * u - 2 * w) / h)
        before.append((2 * u + 4 * w - 6 * slope) / h)
    return before, [*after, None]


def spline_accelerations(points, t, velocities):
    """The mean of both sides' c'': of two, that of the shorter segment counts more."""
    h = [v - u for u, v in pairwise(t)]
    found = []
    for i, (left, right) in enumerate(zip(*bends_beside(points, t, velocities), strict=True)):
        if left is None or right is None:
            found.append(right if left is None else left)
        else:
            found.append((h[i] * left + h[i - 1] * right) / (h[i - 1] + h[i]))
    return found


def spline_jerks(t, accelerations):
    """The slopes of the accelerations; between two segments their mean in the same way."""
    h = [v - u for u, v in pairwise(t)]
    slopes = [(b - a) / each for (a, b), each in zip(pairwise(accelerations), h, strict=True)]
    inner = [(k * a + g * b) / (g + k) for (a, b), (g, k) in zip(pairwise(slopes), pairwise(h), strict=True)]
    return [slopes[0], *inner, slopes[-1]]
