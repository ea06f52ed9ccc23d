"""Joints for a curve near many data: at corners, and where the error asks for them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, point_array, tolerance_value

SHARP = np.pi / 3
"""Angle, in radians, from which a turn counts as a corner."""

_PERSISTS = 0.8
"""Share of a turn that is left at half the reach: of a corner nearly all, of an arc half."""

_SEVERAL, _RAYLEIGH = 100, 1.18
"""Data from which their errors are told; the median length of a pair of errors of standard deviation 1."""

_SMOOTHED = 0.125
"""Share of the reach, before and after a datum, in which the data's errors are averaged."""


def lengths_along(points: FloatArray, grain: float = 0.0) -> FloatArray:
    """Return the length of the polyline up to each point, shape (m,).

    It is measured in steps of `grain`, at least: errors of the data, of which many lie in such a step, make a
    polyline many times as long as the curve.
    """
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    rows = _steps_of(points, grain)
    steps = np.linalg.norm(np.diff(points[rows], axis=0), axis=1)
    return np.asarray(np.interp(along, along[rows], np.append(0.0, np.cumsum(steps))))


def _steps_of(points: FloatArray, grain: float) -> list[int]:
    """Return points each farther than `grain` from the one before; the last one among them in any case."""
    rows, last = points.tolist(), points[0].tolist()
    steps = [0]
    for index, row in enumerate(rows):
        if dist(row, last) > grain:
            steps.append(index)
            last = row
    if steps[-1] != len(rows) - 1:
        # The last step is a longer one, not one of errors alone.
        steps[max(len(steps) - 1, 1) :] = [len(rows) - 1]
    return steps


def scatter_of(points: FloatArray) -> float:
    """Return the standard deviation of the data's errors in each direction, by fourth differences.

    Of smooth and dense data these are far smaller than the errors; the median passes over corners.
    """
    if len(points) < _SEVERAL:
        return 0.0
    lengths = np.linalg.norm(np.diff(points, 4, axis=0), axis=1)
    return float(np.median(lengths) / (_RAYLEIGH * np.sqrt(70.0)))


def sharp_turns(points: ArrayLike, reach: float, *, closed: bool = False) -> list[int]:
    """Return which of the points of a polyline are corners.

    A corner turns as much between points at half the reach as between those at the whole; a smooth bend
    turns by half.

    Parameters
    ----------
    points : array_like, shape (m, dim)
        The data, in order.
    reach : float
        How far before and after a point its turn is measured along the polyline, above 0: well above the
        size of the data's errors.
    closed : bool, optional
        Whether the last point is the first one again.

    Returns
    -------
    list of int
        Ascending; no two nearer than the reach. The ends of an open polyline are none.

    Raises
    ------
    CurveError
        If the points are none, or the reach is not positive.
    """
    data, reach = point_array(points), tolerance_value(reach, "reach")
    along = lengths_along(data, 0.25 * reach)
    if not reach < 0.25 * along[-1]:
        return []
    smooth = data if closed else _averaged(data, along, _SMOOTHED * reach)
    turn, close = (_turns(smooth, along, distance, closed) for distance in (reach, 0.5 * reach))
    inside = np.full(len(along), True) if closed else (along >= reach) & (along <= along[-1] - reach)
    sharp = inside & (turn > SHARP) & (close > _PERSISTS * turn)
    if closed:
        sharp[-1] = False
    corners: list[int] = []
    for index in sorted(np.flatnonzero(sharp).tolist(), key=lambda index: -(turn[index] + close[index])):
        gaps = np.abs(along[corners] - along[index])
        if closed:
            gaps = np.minimum(gaps, along[-1] - gaps)
        if (gaps >= reach).all():
            corners.append(index)
    return sorted(corners)


def _averaged(points: FloatArray, along: FloatArray, reach: float) -> FloatArray:
    """Return the means of the polyline from `reach` before each point to as far after it."""
    steps = np.diff(along)[:, None]
    sums = np.append(
        np.zeros((1, points.shape[1])), np.cumsum(0.5 * steps * (points[1:] + points[:-1]), axis=0), axis=0
    )
    start, end = np.maximum(along - reach, 0.0), np.minimum(along + reach, along[-1])
    differences = [np.interp(end, along, column) - np.interp(start, along, column) for column in sums.T]
    return np.asarray(np.stack(differences, axis=1) / (end - start)[:, None])


def _turns(points: FloatArray, along: FloatArray, reach: float, closed: bool) -> FloatArray:
    """Return by how much the polyline turns at each point, between the points `reach` before and after."""
    period = along[-1] if closed else None
    before, after = (
        np.stack([np.interp(at, along, column, period=period) for column in points.T], axis=1)
        for at in (along - reach, along + reach)
    )
    back, ahead = points - before, after - points
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        cosine = (back * ahead).sum(axis=1) / np.linalg.norm(back, axis=1) / np.linalg.norm(ahead, axis=1)
    return np.asarray(np.arccos(np.clip(np.nan_to_num(cosine, nan=1.0), -1.0, 1.0)))


def placed(
    shares: FloatArray, count: int, corners: Sequence[int], apart: int, *, towards_ends: bool
) -> IntArray:
    """Return which data are joints, so that between any two there is as much of the error.

    Parameters
    ----------
    shares : ndarray, shape (m,)
        What is to be shared evenly, summed up from the first datum on: increasing.
    count : int
        Joints wanted; where the data between two corners are fewer, there are fewer.
    corners : sequence of int
        Data that are joints in any case, ascending.
    apart : int
        Data from one joint to the next, at least, where there are so many.
    towards_ends : bool
        Whether the joints lie like Chebyshev points, closer towards the ends, where one polynomial needs it.

    Returns
    -------
    ndarray of int
        Ascending, the first and last datum among them.
    """
    cuts = [0, *(corner for corner in corners if 0 < corner < len(shares) - 1), len(shares) - 1]
    numbers = _allotted(np.diff(shares[cuts]), np.diff(cuts), count - 1)
    joints = [0]
    for (start, end), number in zip(pairwise(cuts), numbers, strict=True):
        step = np.arange(number + 1) / number
        if towards_ends:
            step = 0.5 * (1.0 - np.cos(np.pi * step))
        of_stretch = shares[start : end + 1]
        wanted = of_stretch[0] + step * (of_stretch[-1] - of_stretch[0])
        # The nearer one of the two data around it.
        nearest = np.interp(wanted, of_stretch, np.arange(end - start + 1.0)).round().astype(np.intp)
        gap = max(min(apart, (end - start) // number), 1)
        room = gap * np.arange(number + 1)
        nearest = np.maximum.accumulate(nearest - room) + room
        nearest = np.minimum(nearest, end - start - room[::-1])
        joints.extend((start + nearest[1:]).tolist())
    return np.array(joints)


def _allotted(weights: FloatArray, room: IntArray, total: int) -> list[int]:
    """Return the number of segments of each stretch: at least one, at most its room, else by its weight."""
    numbers = np.ones(len(weights), dtype=np.intp)
    for _ in range(total - len(weights)):
        need = np.where(numbers < room, weights / numbers, -1.0)
        stretch = int(np.argmax(need))
        if need[stretch] < 0.0:
            break
        numbers[stretch] += 1
    return list(numbers.tolist())
