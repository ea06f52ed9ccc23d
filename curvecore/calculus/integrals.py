"""Integrals of functions between breaks, by Gauss-Legendre quadrature.

A rule of k points integrates polynomials of degree 2 k - 1 exactly [1]_, and its weights are positive:
errors of the values do not grow. So the integral of a curve of polynomial pieces has the accuracy of its
values, whatever its parameters. Intervals of other functions are halved until the rule agrees with itself on
both halves.

References
----------
.. [1] P. J. Davis and P. Rabinowitz, "Methods of Numerical Integration", 2nd ed., Academic Press 1984,
   sections 2.7 (Gauss rules) and 6.2 (adaptive integration).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial.legendre import leggauss

from curvecore.arithmetic import made_finite
from curvecore.arrays import FloatArray, finite_number, read_only
from curvecore.bezier.control_points import all_joints
from curvecore.families.curve import Extrapolate, ParametricCurve, checked_extrapolate

Function: TypeAlias = Callable[[FloatArray], FloatArray]
"""A function of t (m,) with values (m, q)."""

_MOST_EXACT = 40
"""Degree of polynomials that one rule integrates; above they are smooth functions like others."""
_POINTS = 12
_TOLERANCE = 2.0**-46  # relative to the integral of the absolute values
_ROUNDS = 40
_MOST = 1 << 16  # intervals that are halved no further
_AT_ONCE = 1 << 20  # values at a time


class Integral(NamedTuple):
    """The integral of a function from the first knot on.

    Attributes
    ----------
    knots : ndarray, shape (k,)
        Ascending; between two of them the function is smooth.
    sums : ndarray, shape (k, q)
        The integrals from the first knot to each.
    points : int
        Of the rule that is good enough between two knots.
    """

    knots: FloatArray
    sums: FloatArray
    points: int

    def at(self, function: Function, t: FloatArray) -> FloatArray:
        """Return the integrals of the function to t (m,), (m, q); outside the knots it is taken to go on."""
        start = np.clip(np.searchsorted(self.knots, t, side="right") - 1, 0, None)
        return self.sums[start] + _on(function, self.knots[start], t, self.points)


def integral_of(function: Function, curve: ParametricCurve, degree: int | None) -> Integral:
    """Return the integral of a function that is smooth where the curve is, over its domain.

    Parameters
    ----------
    function : callable
    curve : ParametricCurve
        Its breaks and joints are the knots to begin with.
    degree : int or None
        Of the function as a polynomial between the breaks; None if it is none.
    """
    if degree is not None and degree <= _MOST_EXACT:
        knots, points = curve.breaks, degree // 2 + 1
        parts = _on(function, knots[:-1], knots[1:], points)
    else:
        knots, parts = _refined(function, all_joints(curve))
        points = _POINTS
    return Integral(knots, _cumulated(parts), points)


def integral(curve: ParametricCurve, a: float, b: float, extrapolate: Extrapolate = True) -> FloatArray:
    """Return the integral of a curve from a to b, (dim,); see `ParametricCurve.integrate`."""
    start, end = finite_number(a, "a"), finite_number(b, "b")
    rule = checked_extrapolate(extrapolate)
    if start > end:
        return -integral(curve, end, start, rule)
    first, last = curve.domain
    if rule == "periodic":
        return _periodic(curve, start, end)
    if not rule and (start < first or end > last):
        return np.full(curve.jets.shape[2], np.nan)
    return _between(curve, start, end)


def _periodic(curve: ParametricCurve, start: float, end: float) -> FloatArray:
    """Return the integral of the curve that repeats itself, start <= end."""
    first, last = curve.domain
    period = last - first
    times, rest = divmod(end - start, period)
    begin = first + (start - first) % period
    result = times * _between(curve, first, last) if times else np.zeros(curve.jets.shape[2])
    result = result + _between(curve, begin, min(begin + rest, last))
    if begin + rest > last:
        result = result + _between(curve, first, first + (begin + rest - last))
    return result


def _between(curve: ParametricCurve, start: float, end: float) -> FloatArray:
    """Return the integral from start to end >= start, piece by piece: no difference of larger integrals."""
    is_exact = curve.degree is not None and curve.degree <= _MOST_EXACT
    joints = curve.breaks if is_exact else all_joints(curve)
    inner = joints[(joints > start) & (joints < end)]
    knots = np.concatenate(([start], inner, [end]))
    if curve.degree is not None and is_exact:
        parts = _on(curve.evaluate, knots[:-1], knots[1:], curve.degree // 2 + 1)
    else:
        _, parts = _refined(curve.evaluate, knots)
    return made_finite(parts.sum(axis=0))


@cache
def _rule(points: int) -> tuple[FloatArray, FloatArray]:
    """Return the nodes of a Gauss-Legendre rule on [0, 1] and its weights, whose sum is 1."""
    nodes, weights = leggauss(points)
    return read_only(0.5 + 0.5 * nodes), read_only(0.5 * weights)


def _on(function: Function, starts: FloatArray, ends: FloatArray, points: int) -> FloatArray:
    """Return the integrals over intervals (k,), (k, q), by a rule of so many points on each."""
    nodes, weights = _rule(points)
    lengths = ends - starts
    parts = []
    step = max(_AT_ONCE // points, 1)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        for first in range(0, max(len(starts), 1), step):
            here = slice(first, first + step)
            t = starts[here, None] + lengths[here, None] * nodes
            values = function(t.ravel())
            values = values.reshape(*t.shape, values.shape[1]) * weights[:, None]
            # The length last: it may be as small as the values are large.
            parts.append(values.sum(axis=1) * lengths[here, None])
    return np.concatenate(parts)


def _cumulated(parts: FloatArray) -> FloatArray:
    """Return the sums of the first 0, 1, ... k parts, (k + 1, q)."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return np.concatenate((np.zeros((1, parts.shape[1])), np.cumsum(parts, axis=0)))


def _refined(function: Function, knots: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return knots between which the rule is good enough, and the integrals there."""
    starts, ends = knots[:-1], knots[1:]
    wholes = _on(function, starts, ends, _POINTS)
    size = _on(lambda t: np.abs(function(t)), starts, ends, _POINTS).sum(axis=0)
    done_starts, done_parts = [], []
    for step in range(_ROUNDS):
        middles = 0.5 * (starts + ends)
        halves = [_on(function, starts, middles, _POINTS), _on(function, middles, ends, _POINTS)]
        both = np.stack((starts, middles), axis=1), np.stack(halves, axis=1)
        poor = (np.abs(halves[0] + halves[1] - wholes) > _TOLERANCE * size).any(axis=1)
        poor &= (middles > starts) & (middles < ends)
        if step == _ROUNDS - 1 or 2 * int(poor.sum()) > _MOST:
            poor[:] = False
        done_starts.append(both[0][~poor].ravel())
        done_parts.append(both[1][~poor].reshape(-1, wholes.shape[1]))
        if not poor.any():
            break
        ends = np.stack((middles, ends), axis=1)[poor].ravel()
        starts, wholes = both[0][poor].ravel(), both[1][poor].reshape(-1, wholes.shape[1])
    starts_of_parts = np.concatenate(done_starts)
    order = np.argsort(starts_of_parts, kind="stable")
    return np.append(starts_of_parts[order], knots[-1]), np.concatenate(done_parts)[order]
