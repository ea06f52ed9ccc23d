"""Thinning out: as few of many points as a cubic Hermite curve needs to stay near all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.exchange.drawing import ExchangeError, Floats
from curvecore import HermiteCurve, natural_spline_velocities

MOST_KEPT = 20_000
"""Points beyond which a curve is hardly thinned out."""

_FIRST = 9
_ROUNDS = 60


@dataclass(frozen=True, eq=False)
class Thinned:
    """What is left of the points.

    Attributes
    ----------
    rows
        The indices of those kept, the first and the last among them.
    parameters
        Theirs: those given, or the length of the polyline through all points up to each.
    deviation
        Largest distance of any of the points from the natural spline through those kept, at its parameter.
    """

    rows: npt.NDArray[np.intp]
    parameters: Floats
    deviation: float


def thinned(points: Floats, parameters: Floats | None, tolerance: float) -> Thinned:
    """Return few of the points, such that the natural cubic spline through them is near all.

    Starts with few points and adds the farthest of every segment that is too far away, until none is.
    This keeps the parameter of every point, so that the distance is an upper bound and one evaluation of
    the curve finds it.

    Parameters
    ----------
    points
        (n, 2), n >= 2.
    parameters
        (n,), strictly increasing; by default the length of the polyline so far.
    tolerance
        Largest distance allowed, positive.

    Raises
    ------
    ExchangeError
        If the tolerance is no positive number, all points coincide, or more than `MOST_KEPT` points would
        be kept.
    """
    if not 0 < tolerance < np.inf:
        raise ExchangeError("The tolerance must be a positive number.")
    t, distinct = _along(points) if parameters is None else (parameters, np.arange(len(points)))
    if len(distinct) < 2:
        raise ExchangeError("All points coincide; there is no curve through them.")
    points = points[distinct]
    kept = np.unique(np.linspace(0, len(t) - 1, min(_FIRST, len(t))).round().astype(np.intp))
    for _ in range(_ROUNDS):
        distance = _distances(points, t, kept)
        worst = float(distance.max())
        if worst <= tolerance or len(kept) == len(t):
            return Thinned(distinct[kept], t[kept], worst)
        kept = np.union1d(kept, _farthest(distance, kept, tolerance))
        if len(kept) > MOST_KEPT:
            break
    raise ExchangeError(
        f"More than {MOST_KEPT} points would be left; allow a larger distance than {tolerance:g}."
    )


def _along(points: Floats) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Return the length of the polyline up to each distinct point, and which points those are."""
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    distinct = np.flatnonzero(np.append(True, np.diff(length) > 0))
    return length[distinct], distinct


def _distances(points: Floats, t: Floats, kept: npt.NDArray[np.intp]) -> Floats:
    knots, at = points[kept], t[kept]
    curve = HermiteCurve(knots, natural_spline_velocities(knots, at), at)
    return np.asarray(np.hypot(*(curve.evaluate(t) - points).T))


def _farthest(distance: Floats, kept: npt.NDArray[np.intp], tolerance: float) -> npt.NDArray[np.intp]:
    """Return the farthest point of every segment that has one beyond the tolerance."""
    worst = np.maximum.reduceat(distance, kept[:-1])
    segment = np.repeat(np.arange(len(kept) - 1), np.diff(kept))
    inside = distance[: kept[-1]]
    # Of equals all are candidates; the first of each segment counts.
    candidates = np.flatnonzero((inside == worst[segment]) & (inside > tolerance))
    _, first = np.unique(segment[candidates], return_index=True)
    return candidates[first]
