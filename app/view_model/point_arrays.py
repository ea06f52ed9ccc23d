"""The numbers in a curve's points as arrays; made anew only for points that are other values now."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ..document.derivatives import DERIVATIVES
from ..document.model import Point, Vector, vectors_of

_NONE = (np.nan, np.nan)


class PointArrays(msgspec.Struct, frozen=True, eq=False):
    """The numbers of n points; NaN stands for None. An array without a change is the same object as before.

    Attributes
    ----------
    points
        The document's values.
    positions
        Coordinates, (n, 2).
    times
        Manual parameters, (n,).
    corners
        Whether each point is a corner, (n,).
    given
        Derivatives that the person set: ``[i, side, order - 1]``, side 0 before and 1 after the point;
        (n, 2, highest order, 2).
    """

    points: tuple[Point, ...]
    positions: FloatArray
    times: FloatArray
    corners: BoolArray
    given: FloatArray


def arrays_of(points: tuple[Point, ...], previous: PointArrays | None = None) -> PointArrays:
    """Return the arrays of `points`; rows of points that `previous` has too are taken from there."""
    if previous is None or len(previous.points) != len(points):
        return PointArrays(points, *_columns(points))
    differs = np.fromiter(map(operator.is_not, points, previous.points), dtype=bool, count=len(points))
    rows = np.flatnonzero(differs)
    old = (previous.positions, previous.times, previous.corners, previous.given)
    if not len(rows):
        return PointArrays(points, *old)
    fresh = _columns([points[row] for row in rows.tolist()])
    return PointArrays(points, *(_with_rows(*columns, rows) for columns in zip(old, fresh, strict=True)))


def _columns(points: Sequence[Point]) -> tuple[FloatArray, FloatArray, BoolArray, FloatArray]:
    positions = np.array([(point.x, point.y) for point in points], dtype=float).reshape(-1, 2)
    times = np.array([np.nan if point.t is None else point.t for point in points], dtype=float)
    corners = np.array([point.corner for point in points], dtype=bool)
    given = np.array([_given(point) for point in points], dtype=float)
    given = given.reshape(-1, 2, len(DERIVATIVES), 2)
    for column in (positions, times, corners, given):
        # Views of one curve after the other share what did not change.
        column.setflags(write=False)
    return positions, times, corners, given


def _given(point: Point) -> list[Vector]:
    """Return the vectors of a point, those before it and then those after it."""
    vectors = vectors_of(point)
    if not point.corner:
        before = vectors[: len(DERIVATIVES)]
        vectors = before + before
    return [vector or _NONE for vector in vectors]


def _with_rows(old: NDArray[Any], fresh: NDArray[Any], rows: IntArray) -> NDArray[Any]:
    # By their bytes: NaN is NaN, and a comparison of NumPy's takes ten times as long.
    if old[rows].tobytes() == fresh.tobytes():
        return old
    result = old.copy()
    result[rows] = fresh
    result.setflags(write=False)
    return result
