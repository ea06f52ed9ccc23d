"""The data of a Hermite curve: those that the person set, and the estimates of the rules for the rest.

A corner divides the curve into pieces, and each piece is estimated for itself; a closed curve without a
corner is estimated as the periodic curve it is. Where the velocities at a point are tied the curve is smooth,
and the estimates go through.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

import curvecore
from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.parametrization import Spaced

from ...document.derivatives import EstimateRule
from ...document.model import Curve, Point
from ..geometry import at_knots
from .point_arrays import PointArrays

Estimate = Callable[[FloatArray, ArrayLike], FloatArray]

_REACH = 64
"""Knots after which an estimate has forgotten the data: a natural spline forgets half at every knot."""


class Sides(NamedTuple):
    """The jets at the knots, before and after each; they differ only at corners. Shapes (k, R, 2)."""

    before: FloatArray
    after: FloatArray


def sides_of(curve: Curve, points: FloatArray, parameters: FloatArray, arrays: PointArrays) -> Sides:
    """Return the jets of `curve` at its knots, whose points (k, 2) and parameters (k,) are given."""
    before = np.zeros((len(points), curve.family.derivatives + 1, 2))
    before[:, 0] = points
    after = before.copy()
    corners = _dividing_knots(arrays, len(points))
    has_given = not np.isnan(arrays.given).all()
    for order, rule in enumerate(curve.rules, start=1):
        estimate = _estimate_by(rule, curve)
        is_given = [_is_given(arrays, side, order, len(points)) for side in (0, 1)] if has_given else None
        _estimate(
            before[:, order],
            after[:, order],
            points,
            parameters,
            corners,
            estimate,
            curve.is_closed,
            is_given,
        )
        for side, jets in enumerate((before, after) if has_given else ()):
            rows = _given_rows(arrays, side, order, len(jets))
            jets[rows, order] = arrays.given[rows % len(arrays.given), side, order - 1]
    return Sides(before, after)


def moved_with_points(
    curve: Curve,
    points: FloatArray,
    parameters: FloatArray,
    arrays: PointArrays,
    coordinate: int | None = None,
) -> Callable[[FloatArray], tuple[FloatArray, FloatArray]]:
    """Return what moves of the points, (n, m), do to the derivatives before and after each knot.

    At fixed parameters, and for Catmull-Rom at fixed knots, the estimates are linear in the points; of
    others it is what small moves do, as a mean or to one coordinate. What the person set stays.
    """
    corners = _dividing_knots(arrays, len(points))

    def moved(moves: FloatArray) -> tuple[FloatArray, FloatArray]:
        # Whatever cuts and unrolls the points does so with their moves, too.
        both = np.hstack([points, at_knots(moves, closed=curve.is_closed)])
        before = np.zeros((len(points), curve.family.derivatives, moves.shape[1]))
        after = before.copy()
        for order, rule in enumerate(curve.rules):
            change = _of_moves(rule, curve, coordinate)
            _estimate(before[:, order], after[:, order], both, parameters, corners, change, curve.is_closed)
            for side, derivatives in enumerate((before, after)):
                derivatives[_given_rows(arrays, side, order + 1, len(points)), order] = 0.0
        return before, after

    return moved


def _of_moves(rule: EstimateRule, curve: Curve, coordinate: int | None) -> Estimate:
    """Return what a rule makes of moves of the points: of (k, 2 + m) the columns behind two.

    Of a rule that is not linear this is its Jacobian at the points, times the moves: where it treats each
    coordinate for itself, the mean of both, which is the mean over the directions of a move; or, of one
    coordinate, the change on that side of a kink to which the moves lead.
    """
    if rule.is_linear:
        return lambda both, t: _estimate_by(rule, curve)(both[:, 2:], t)
    function = getattr(curvecore, rule.changes)

    def changes(both: FloatArray, t: ArrayLike) -> FloatArray:
        if coordinate is not None:
            one: FloatArray = function(both[:, [coordinate]], t, both[:, 2:], one_sided=True)[:, 0]
            return one
        mean: FloatArray = function(both[:, :2], t, both[:, 2:], **_further(rule, curve)).mean(axis=1)
        return mean

    return changes


def two_sided_knots(arrays: PointArrays, count: int) -> list[int]:
    """Return which of the `count` knots have derivatives of their own on each side."""
    return _knots_where(arrays.corners, count)


def _dividing_knots(arrays: PointArrays, count: int) -> list[int]:
    """Return which of the `count` knots divide what is estimated: corners whose velocities are free."""
    return _knots_where(arrays.corners & ~arrays.ties, count)


def _knots_where(holds: BoolArray, count: int) -> list[int]:
    knots: list[int] = holds.nonzero()[0].tolist()
    if count > len(holds) and holds[0]:
        knots.append(count - 1)
    return knots


def _estimate_by(rule: EstimateRule, curve: Curve) -> Estimate:
    function = getattr(curvecore, rule.function)

    def estimate(points: FloatArray, t: ArrayLike) -> FloatArray:
        data = (points, t) if "parameters" in rule.takes else (points,)
        found: FloatArray = function(*data, **_further(rule, curve))
        return found

    return estimate


def _further(rule: EstimateRule, curve: Curve) -> dict[str, float]:
    """Return the arguments of a rule beside points and parameters."""
    return {"alpha": curve.parametrization.alpha} if "alpha" in rule.takes else {}


def _estimate(
    before: FloatArray,
    after: FloatArray,
    points: FloatArray,
    parameters: FloatArray,
    corners: Sequence[int],
    estimate: Estimate,
    closed: bool,
    is_given: Sequence[BoolArray] | None = None,
) -> None:
    """Estimate from corner to corner; a closed curve is unrolled and goes on where it ends.

    Where all derivatives between two corners `is_given`, before and after the knots, nothing is estimated.
    """
    if not closed and not corners:
        after[:] = before[:] = estimate(points, parameters)
        return
    count = len(points) - closed
    spacing = parameters[1:] - parameters[:-1]
    is_endless = closed and not corners
    cuts = sorted({0, count - 1, *corners})
    if is_endless:
        cuts = [-_REACH, count + _REACH]
    elif closed:
        cuts = sorted({corner % count for corner in corners})
        cuts.append(cuts[0] + count)
    for start, end in pairwise(cuts):
        places = np.arange(start, end + 1)
        knots = places % count
        if is_given is not None and is_given[0][knots[1:]].all() and is_given[1][knots[:-1]].all():
            continue
        piece = estimate(points[knots], Spaced(spacing[knots[:-1]]))
        wanted = (places >= 0) & (places < count) | (not is_endless)
        after[knots[:-1][wanted[:-1]]] = piece[:-1][wanted[:-1]]
        before[knots[1:][wanted[1:]]] = piece[1:][wanted[1:]]
    if closed:
        before[count], after[count] = before[0], after[0]
    else:
        # The ends have one side only; the other is never used.
        before[0], after[-1] = after[0], before[-1]


def _given_rows(arrays: PointArrays, side: int, order: int, count: int) -> IntArray:
    """Return the knots, of `count`, whose derivative was set; a closed curve ends at its first point."""
    (rows,) = (~np.isnan(arrays.given[:, side, order - 1, 0])).nonzero()
    return np.append(rows, count - 1) if len(rows) and rows[0] == 0 and count > len(arrays.given) else rows


def _is_given(arrays: PointArrays, side: int, order: int, count: int) -> BoolArray:
    """Return of which knots, of `count`, the derivative was set."""
    found = np.zeros(count, dtype=np.bool_)
    found[_given_rows(arrays, side, order, count)] = True
    return found


def is_explicit(point: Point, order: int, *, ahead: bool) -> bool:
    """Whether the person set the derivative of an order on a side of a point."""
    return point.explicit_sides(order)[ahead] is not None
