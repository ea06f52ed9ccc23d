"""The numbers in a curve's points as arrays; made anew only for points that are other values now."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import TypeVar

import msgspec
import numpy as np

from app.document.kept_handles import DERIVATIVES
from app.document.model import Point, Vector
from curvecore.arrays import BoolArray, FloatArray, IntArray

Column = TypeVar("Column", FloatArray, BoolArray)

_NONE = (np.nan, np.nan)

_beside_place = operator.attrgetter("t", "corner", *(name for _, name in DERIVATIVES))


class PointArrays(msgspec.Struct, frozen=True, eq=False):
    """What n points hold; NaN stands for None. An array that did not change is the same object as before.

    Attributes
    ----------
    points
        The document's values.
    positions
        Coordinates, (n, 2).
    times
        Manual parameters, (n,).
    corners
        Which points are corners, (n,).
    given
        Derivatives that the person set: ``[i, side, order - 1]``, side 0 before and 1 after the point,
        order 1 the velocity and 2 the acceleration; (n, 2, 2, 2).
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
    changed = [(points[row], previous.points[row]) for row in rows.tolist()]
    if all(_moved_alone(point, before) for point, before in changed):
        return PointArrays(
            points, _with_rows(old[0], rows, _places([point for point, _ in changed])), *old[1:]
        )
    fresh = _columns([point for point, _ in changed])
    return PointArrays(
        points,
        _with_rows(old[0], rows, fresh[0]),
        _with_rows(old[1], rows, fresh[1]),
        _with_rows(old[2], rows, fresh[2]),
        _with_rows(old[3], rows, fresh[3]),
    )


def _moved_alone(point: Point, before: Point) -> bool:
    """Whether all that two points hold is the same object but for their places: as in a drag."""
    return all(map(operator.is_, _beside_place(point), _beside_place(before)))


def _columns(points: Sequence[Point]) -> tuple[FloatArray, FloatArray, BoolArray, FloatArray]:
    positions = _places(points)
    times = np.array([np.nan if point.t is None else point.t for point in points], dtype=float)
    corners = np.array([point.corner for point in points], dtype=bool)
    given = np.array([_given(point) for point in points], dtype=float).reshape(-1, 2, 2, 2)
    for column in (positions, times, corners, given):
        # Views of one curve after the other share what did not change.
        column.setflags(write=False)
    return positions, times, corners, given


def _places(points: Sequence[Point]) -> FloatArray:
    return np.array([(point.x, point.y) for point in points], dtype=float).reshape(-1, 2)


def _given(point: Point) -> tuple[Vector, Vector, Vector, Vector]:
    velocity, acceleration = point.velocity or _NONE, point.acceleration or _NONE
    if not point.corner:
        return velocity, acceleration, velocity, acceleration
    return velocity, acceleration, point.velocity_after or _NONE, point.acceleration_after or _NONE


def _with_rows(old: Column, rows: IntArray, fresh: Column) -> Column:
    # By their bytes: NaN is NaN, and a comparison of NumPy's takes ten times as long.
    if old[rows].tobytes() == fresh.tobytes():
        return old
    result = old.copy()
    result[rows] = fresh
    result.setflags(write=False)
    return result
