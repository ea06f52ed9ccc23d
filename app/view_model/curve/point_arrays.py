"""The numbers in a curve's points as arrays; computed again only for points that have changed."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, chain, compress
from operator import attrgetter, is_not
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...document.derivatives import DERIVATIVES
from ...document.differences import have_only_moved
from ...document.model import Point, Vector, derivatives_of

_x, _y = attrgetter("x"), attrgetter("y")

_NONE = (np.nan, np.nan)


class PointArrays(msgspec.Struct, frozen=True, eq=False, gc=False):
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
        Whether each point has derivatives of its own on each side, (n,).
    ties
        Whether its velocities are tied there, (n,).
    evens
        Whether tied velocities keep their handles equally long, (n,).
    given
        Derivatives that the person set: ``[i, side, order - 1]``, side 0 before and 1 after the point;
        (n, 2, highest order, 2).
    """

    points: tuple[Point, ...]
    positions: FloatArray
    times: FloatArray
    corners: BoolArray
    ties: BoolArray
    evens: BoolArray
    given: FloatArray


def arrays_of(points: tuple[Point, ...], previous: PointArrays | None = None) -> PointArrays:
    """Return the arrays of `points`; rows of points that have not changed come from `previous`."""
    if previous is None or len(previous.points) != len(points):
        return PointArrays(points, *_columns(points))
    rows = rows_changed(points, previous.points)
    old = (previous.positions, *_columns_besides_positions(previous))
    if not rows:
        return PointArrays(points, *old)
    if have_only_moved([previous.points[row] for row in rows], [points[row] for row in rows]):
        # As under nearly every drag.
        positions = previous.positions.copy()
        for row in rows:
            positions[row] = points[row].x, points[row].y
        positions.setflags(write=False)
        return PointArrays(points, positions, *old[1:])
    fresh, indices = _columns([points[row] for row in rows]), np.array(rows)
    return PointArrays(points, *(_with_rows(*columns, indices) for columns in zip(old, fresh, strict=True)))


def arrays_of_all(
    points: Sequence[tuple[Point, ...]], previous: Sequence[PointArrays], *, are_moved: bool = False
) -> list[PointArrays]:
    """Return the arrays of points of many curves, each of as many points as before, computed all at once.

    `are_moved` says that nothing but their positions has changed.
    """
    all_points = [*chain.from_iterable(points)]
    if are_moved or have_only_moved(chain.from_iterable(old.points for old in previous), all_points):
        # As under nearly every drag.
        unchanged = [True] * len(points)
    else:
        unchanged = [have_only_moved(old.points, new) for new, old in zip(points, previous, strict=True)]
    all_positions = _positions(all_points)
    all_positions.setflags(write=False)
    positions = _parts(all_positions, points)
    others = [curve for curve, is_unchanged in zip(points, unchanged, strict=True) if not is_unchanged]
    _, *columns = _columns([*chain.from_iterable(others)])
    fresh = iter([*zip(*(_parts(column, others) for column in columns), strict=True)])
    return [
        PointArrays(
            new,
            moved,
            *(
                _columns_besides_positions(old)
                if is_unchanged
                else map(_same_or, _columns_besides_positions(old), next(fresh))
            ),
        )
        for new, moved, old, is_unchanged in zip(points, positions, previous, unchanged, strict=True)
    ]


def _columns_besides_positions(arrays: PointArrays) -> tuple[NDArray[Any], ...]:
    return arrays.times, arrays.corners, arrays.ties, arrays.evens, arrays.given


def _parts(column: NDArray[Any], points: Sequence[Sequence[Point]]) -> list[NDArray[Any]]:
    """Return the rows of each of several curves, one after the other."""
    ends = list(accumulate(map(len, points)))
    return [column[start:end] for start, end in zip([0, *ends], ends, strict=False)]


def _same_or(old: NDArray[Any], fresh: NDArray[Any]) -> NDArray[Any]:
    """Return the old array where it holds the same bytes; NaN equals NaN."""
    return old if old.tobytes() == fresh.tobytes() else fresh


def rows_changed(points: Sequence[Point], before: Sequence[Point]) -> list[int]:
    """Return the rows of points that are other objects than before, of as many points."""
    return list(compress(range(len(points)), map(is_not, points, before)))


def _columns(
    points: Sequence[Point],
) -> tuple[FloatArray, FloatArray, BoolArray, BoolArray, BoolArray, FloatArray]:
    positions = _positions(points)
    times = np.array([np.nan if point.t is None else point.t for point in points], dtype=float)
    corners = np.array([point.corner for point in points], dtype=bool)
    ties = np.array([point.tied for point in points], dtype=bool)
    evens = np.array([point.even for point in points], dtype=bool)
    given = np.array([_given(point) for point in points], dtype=float)
    given = given.reshape(-1, 2, len(DERIVATIVES), 2)
    for column in (positions, times, corners, ties, evens, given):
        # Views of one curve after the other share what did not change.
        column.setflags(write=False)
    return positions, times, corners, ties, evens, given


def _positions(points: Sequence[Point]) -> FloatArray:
    positions = np.empty((len(points), 2))
    for axis, value in enumerate((_x, _y)):
        positions[:, axis] = np.fromiter(map(value, points), dtype=float, count=len(points))
    return positions


def _given(point: Point) -> list[Vector]:
    """Return the vectors of a point, those before it and then those after it."""
    vectors = derivatives_of(point)
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
