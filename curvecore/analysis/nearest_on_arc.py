"""The point of one Bezier arc of low degree that is nearest to 0, in Python's own numbers.

As in `nearest_point` the Bernstein coefficients of the squared distance are the bounds: halved until they are
convex, where Newton's method finds the only minimum. Of one arc, arithmetic without arrays takes a fifth of
the time of NumPy's calls.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations_with_replacement, pairwise
from typing import NamedTuple, TypeAlias

from curvecore.arithmetic import UNIT_ROUNDOFF

MOST_DEGREE = 7
"""Above, arrays are the faster way."""

Row: TypeAlias = list[float]
_LEAST, _MOST = 1e-140, 1e140  # sizes whose squares are in range
_STEPS = 200  # arcs to look at, few of which are ever needed
_SHORT = 2.0**-40
_NOISE = 100.0 * UNIT_ROUNDOFF  # of the coefficients: half a dozen roundings, and as many for each halving
_NEWTON = 60
_CLOSE = 2.0**-30


class NearestOnArc(NamedTuple):
    """The parameter s in [0, 1] of the nearest point of an arc, and a lower bound of all distances."""

    s: float
    bound: float


def nearest_on_arc(rows: list[Row], tolerance: float) -> NearestOnArc | None:
    """Return the point of an arc nearest to 0; None where the search does not reach the tolerance.

    Parameters
    ----------
    rows : list of list of float
        The control points of each coordinate, 3 to 8 of them.
    tolerance : float
        By how much another point may be nearer.
    """
    size = max(max(map(abs, row)) for row in rows)
    if not _LEAST < size < _MOST:
        return None
    squares = _squares(rows)
    noise = _NOISE * max(map(abs, squares))
    (best, nearest), bound = min((squares[0], 0.0), (squares[-1], 1.0)), math.inf
    waiting = [(squares, 0.0, 1.0)]
    for _ in range(_STEPS):
        if not waiting:
            break
        coefficients, start, end = waiting.pop()
        low, reach = min(coefficients) - noise, math.sqrt(best) - tolerance
        if reach <= 0.0 or low >= reach * reach:
            bound = min(bound, low)
        elif end - start <= _SHORT or _is_convex(coefficients):
            guess = coefficients.index(min(coefficients)) / (len(coefficients) - 1)
            s, square = _lowest(rows, start, end, start + guess * (end - start))
            bound = min(bound, square - noise)
            if square < best:
                best, nearest = square, s
        else:
            middle = 0.5 * (start + end)
            left, right = _halves(coefficients)
            parts = [(left, start, middle), (right, middle, end)]
            # The more promising half is looked at first.
            waiting += parts if min(right) < min(left) else parts[::-1]
    if waiting:
        return None
    result = NearestOnArc(nearest, math.sqrt(max(min(bound, best), 0.0)))
    return result if math.sqrt(best) - result.bound <= tolerance else None


def _squares(rows: list[Row]) -> Row:
    """Return the Bernstein coefficients of the squared length."""
    degree = len(rows[0]) - 1
    result = [0.0] * (2 * degree + 1)
    for row in rows:
        for k, i, j, weight in _products(degree):
            result[k] += weight * (row[i] * row[j])
    return result


@cache
def _products(degree: int) -> list[tuple[int, int, int, float]]:
    """Return the weights of the products of coefficients i and j in coefficient k = i + j of a square."""
    products = []
    for i, j in combinations_with_replacement(range(degree + 1), 2):
        count = (1 + (i != j)) * math.comb(degree, i) * math.comb(degree, j)
        products.append((i + j, i, j, count / math.comb(2 * degree, i + j)))
    return products


def _is_convex(coefficients: Row) -> bool:
    before, here = coefficients[0], coefficients[1]
    for after in coefficients[2:]:
        if before + after < here + here:
            return False
        before, here = here, after
    return True


def _halves(coefficients: Row) -> tuple[Row, Row]:
    left, right, level = [coefficients[0]], [coefficients[-1]], coefficients
    while len(level) > 1:
        level = [0.5 * (a + b) for a, b in pairwise(level)]
        left.append(level[0])
        right.append(level[-1])
    return left, right[::-1]


def _lowest(rows: list[Row], start: float, end: float, s: float) -> tuple[float, float]:
    """Return the minimum of the distance on a stretch where it is convex, from a guess: s and the square."""
    knows_start = knows_end = False
    for _ in range(_NEWTON):
        here = _descent(rows, s)
        if here.slope < 0.0:
            start, knows_start = s, True
        else:
            end, knows_end = s, True
        if start >= end:
            break
        downhill = start if here.slope > 0.0 else end
        following = s - here.slope / here.bend if here.bend > 0.0 else downhill
        following = min(max(following, start), end)
        if (following == start and knows_start) or (following == end and knows_end):
            following = 0.5 * (start + end)
        step, s = abs(following - s), following
        if step <= _CLOSE:
            # The square of such a step is beyond the last digit.
            here = _descent(rows, s)
            break
    return s, here.square


class _Descent(NamedTuple):
    """The squared distance at a parameter, and half its first and second derivatives."""

    square: float
    slope: float
    bend: float


def _descent(rows: list[Row], s: float) -> _Descent:
    r, square, slope, bend = 1.0 - s, 0.0, 0.0, 0.0
    degree = len(rows[0]) - 1
    for row in rows:
        level = row
        while len(level) > 3:
            level = [r * a + s * b for a, b in pairwise(level)]
        a, b, c = level
        before, behind = r * a + s * b, r * b + s * c
        value, velocity = r * before + s * behind, degree * (behind - before)
        square += value * value
        slope += value * velocity
        bend += velocity * velocity + value * (degree * (degree - 1) * ((c - b) - (b - a)))
    return _Descent(square, slope, bend)
