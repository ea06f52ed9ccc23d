"""Polylines with bounds of how far they leave a curve, and their geometry."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import LIMIT
from curvecore.arrays import BoolArray, FloatArray
from curvecore.families.curve import ParametricCurve

MAX_VERTICES = 1 << 14
"""A polyline has at most this many vertices, or 4 per joint if that is more."""


class Pieces(NamedTuple):
    """Consecutive pieces of a curve.

    Attributes
    ----------
    parameters : ndarray, shape (k + 1,)
        Their ends.
    points : ndarray, shape (k + 1, 2)
        The curve there, limited to +-1e300.
    deviation : ndarray, shape (k,)
        Bounds of the distance from each to its chord; infinite for pieces
        outside the box, which must not be merged with others.

    See Also
    --------
    flatten_pieces : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, flatten_pieces
    >>> pieces = flatten_pieces(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 0.01)
    >>> pieces.points[0].tolist(), pieces.reached <= 0.01
    ([0.0, 0.0], True)
    """

    parameters: FloatArray
    points: FloatArray
    deviation: FloatArray

    @property
    def reached(self) -> float:
        """The bound of the distance between curve and polyline, as far as they enter the box.

        Greater than the tolerance where `MAX_VERTICES` or roundings do not allow better.
        """
        inside = self.deviation[self.deviation < np.inf]
        return float(inside.max(initial=0.0))


def points_at(curve: ParametricCurve, t: FloatArray) -> FloatArray:
    """Return points of the curve, limited to +-1e300: their differences are finite."""
    return np.clip(curve.evaluate(t), -LIMIT, LIMIT)


def chord_bound(controls: FloatArray) -> FloatArray:
    """Bound the distance between arcs and their chords: max |c''| / 8 over s in [0, 1]."""
    degree = controls.shape[1] - 1
    if degree == 1:
        return np.zeros(len(controls))
    second = controls[:, 2:] - 2.0 * controls[:, 1:-1] + controls[:, :-2]
    sizes = np.hypot(second[:, :, 0], second[:, :, 1])
    bound: FloatArray = _along_columns(np.maximum, sizes) * (degree * (degree - 1) / 8.0)
    return bound


def may_enter(points: FloatArray, box: FloatArray) -> BoolArray:
    """Tell whose hulls, from points of shape (k, j, 2), touch the box."""
    low, high = _along_columns(np.minimum, points), _along_columns(np.maximum, points)
    inside = (high >= box[:2]) & (low <= box[2:])
    return inside[:, 0] & inside[:, 1]


def _along_columns(combine: np.ufunc, values: FloatArray) -> FloatArray:
    """Reduce axis 1, which has a handful of entries: NumPy's reductions take ten times as long."""
    result: FloatArray = values[:, 0]
    for column in range(1, values.shape[1]):
        result = combine(result, values[:, column])
    return result


def segment_distance(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the distances from points to line segments, free of overflow."""
    chord = end - start
    length = np.hypot(chord[..., 0], chord[..., 1])
    unit = chord / np.where(length > 0.0, length, 1.0)[..., None]
    offset = points - start
    along = np.clip(offset[..., 0] * unit[..., 0] + offset[..., 1] * unit[..., 1], 0.0, length)
    rest = offset - along[..., None] * unit
    return np.hypot(rest[..., 0], rest[..., 1])


def merged_pieces(pieces: Pieces, tolerance: float, is_fixed: BoolArray | None = None) -> Pieces:
    """Leave out the vertices that the tolerance does not need, but those that are fixed, (k + 1,).

    A chord of two pieces is at most as far from the curve as the worse of
    their own chords is, plus the middle vertex's distance from it.
    """
    t, points = pieces.parameters, pieces.points
    deviation = pieces.deviation.copy()
    idle, offset = 0, 0
    while idle < 2 and t.size > 2:
        middle = np.arange(1 + offset, t.size - 1, 2)
        joined = np.maximum(deviation[middle - 1], deviation[middle])
        joined += segment_distance(points[middle], points[middle - 1], points[middle + 1])
        dropped = joined <= tolerance
        if is_fixed is not None:
            dropped &= ~is_fixed[middle]
        deviation[middle[dropped] - 1] = joined[dropped]
        # Straight parts halve in every round; a few vertices more are not worth another one.
        idle = 0 if 32 * np.count_nonzero(dropped) > t.size else idle + 1
        kept = np.ones(t.size, dtype=bool)
        kept[middle[dropped]] = False
        t, points, deviation = t[kept], points[kept], deviation[kept[:-1]]
        is_fixed = None if is_fixed is None else is_fixed[kept]
        offset = 1 - offset
    return Pieces(t, points, deviation)
