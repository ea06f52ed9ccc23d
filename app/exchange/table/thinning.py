"""Thinning out: as few of many points as a curve, or a polyline, needs to stay near all of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from curvecore import HermiteCurve, natural_spline_velocities
from curvecore.arrays import FloatArray, IntArray

from ...document.words import NamedEnum
from ...tasks.progress import Report, silent
from ..errors import ExchangeError

MAX_POINTS = 20_000
"""Points beyond which a curve is hardly thinned out."""

_FIRST = 9
_ROUNDS = 60
_DEEPEST = 1_000


class TooManyPointsError(ExchangeError):
    """The tolerance is so small that almost all points would be kept."""


class Thinning(NamedEnum):
    """Line that stays within the tolerance of every point."""

    CURVE = "curve", "Fit a curve within"
    POLYLINE = "polyline", "Keep corners within"


@dataclass(frozen=True, eq=False)
class ThinnedPoints:
    """Points that were kept.

    Attributes
    ----------
    rows
        The indices of those kept, the first and the last among them.
    parameters
        Parameters of these points: those given, or the length of the polyline up to the point.
    deviation
        Largest distance of any of the points from the natural spline through those kept, at its parameter.
    """

    rows: IntArray
    parameters: FloatArray
    deviation: float


def thin_out(
    points: FloatArray,
    parameters: FloatArray | None,
    tolerance: float,
    thinning: Thinning = Thinning.CURVE,
    *,
    report: Report = silent,
) -> ThinnedPoints:
    """Return few of the points, such that the spline or polyline through them is close to all of them.

    Starts with few points and adds the farthest of every segment that is too far away, until none is. For
    the polyline this is the method of Douglas and Peucker (Cartographica 10 (1973) 112-122), all segments
    at once. For the spline it keeps the parameter of every point, so that the distance is an upper bound
    and one evaluation of the curve finds it.

    Parameters
    ----------
    points
        (n, 2), n >= 2.
    parameters
        (n,), strictly increasing; by default the length of the polyline so far.
    tolerance
        Largest distance allowed, positive.
    thinning
        Spline or polyline.
    report
        Called with the progress.

    Raises
    ------
    ExchangeError
        If the tolerance is no positive number, or all points coincide.
    TooManyPointsError
        If more than `MAX_POINTS` points would be kept.
    """
    if not 0 < tolerance < np.inf:
        raise ExchangeError("The tolerance must be a positive number.")
    t, distinct = _lengths_along(points) if parameters is None else (parameters, np.arange(len(points)))
    if len(distinct) < 2:
        raise ExchangeError("All points coincide; no curve can pass through them.")
    points = points[distinct]
    indices = _enough_points(points, t, tolerance, thinning is Thinning.CURVE, report)
    return ThinnedPoints(distinct[indices], t[indices], float(_distances(points, t, indices).max()))


def _enough_points(
    points: FloatArray, t: FloatArray, tolerance: float, is_curve: bool, report: Report
) -> IntArray:
    """Return the indices of sufficient points among distinct ones with parameters t (n,)."""
    first, began = _FIRST if is_curve else 2, 0.0
    indices = np.unique(np.linspace(0, len(t) - 1, min(first, len(t))).round().astype(np.intp))
    for _ in range(_ROUNDS if is_curve else _DEEPEST):
        distance = _distances(points, t, indices) if is_curve else _from_chords(points, indices)
        worst = float(distance.max())
        began = began or worst
        report(_share(began, worst, tolerance), "Thinning out")
        if worst <= tolerance or len(indices) == len(t):
            return indices
        indices = np.union1d(indices, _farthest(distance, indices, tolerance))
        if len(indices) > MAX_POINTS:
            break
    raise TooManyPointsError(
        f"More than {MAX_POINTS} points would be left; choose a larger distance than {tolerance:g}."
    )


def _share(began: float, worst: float, tolerance: float) -> float:
    """Return the share of the work that is done: the distance shrinks by a factor from round to round."""
    if not tolerance < worst < began:
        return 0.0 if worst > tolerance else 1.0
    return math.log(began / worst) / math.log(began / tolerance)


def _lengths_along(points: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the length of the polyline up to each distinct point, and the indices of these points."""
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    distinct = np.flatnonzero(np.append(True, np.diff(length) > 0))
    return length[distinct], distinct


def _distances(points: FloatArray, t: FloatArray, indices: IntArray) -> FloatArray:
    knots, at = points[indices], t[indices]
    curve = HermiteCurve(knots, natural_spline_velocities(knots, at), at)
    return np.asarray(np.hypot(*(curve.evaluate(t) - points).T))


def _from_chords(points: FloatArray, indices: IntArray) -> FloatArray:
    """Return the distance of every point from the chord of its segment."""
    segment = np.repeat(np.arange(len(indices) - 1), np.diff(indices))
    start, along = points[indices[:-1]][segment], np.diff(points[indices], axis=0)[segment]
    offset = points[: indices[-1]] - start
    square = np.einsum("md,md->m", along, along)
    with np.errstate(all="ignore"):
        share = np.clip(np.nan_to_num(np.einsum("md,md->m", offset, along) / square), 0, 1)
    return np.append(np.hypot(*(offset - share[:, None] * along).T), 0.0)


def _farthest(distance: FloatArray, indices: IntArray, tolerance: float) -> IntArray:
    """Return the farthest point of every segment that has one beyond the tolerance."""
    worst = np.maximum.reduceat(distance, indices[:-1])
    segment = np.repeat(np.arange(len(indices) - 1), np.diff(indices))
    inside = distance[: indices[-1]]
    # Equally far points are all candidates; the first of each segment counts.
    candidates = np.flatnonzero((inside == worst[segment]) & (inside > tolerance))
    _, first = np.unique(segment[candidates], return_index=True)
    return candidates[first]
