"""The point of a curve nearest to a given one: the nearest of all, for certain.

The squared distance to a Bezier piece is a polynomial, nowhere less than its
least Bernstein coefficient. Pieces whose bound exceeds the least distance
found so far are dropped, the rest are halved. The bounds converge
quadratically, so only a few pieces around the answer stay.

References
----------
.. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial
   retrospective", Computer Aided Geometric Design 29 (2012) 379-419, section
   3.2.
.. [2] X.-D. Chen, J.-H. Yong, G. Wang, J.-C. Paul and G. Xu, "Computing the
   minimum distance between a point and a NURBS curve", Computer-Aided Design
   40 (2008) 1051-1054: the same idea with a clipping circle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, jet_array, tolerance_value
from curvecore.bernstein_algebra import product, subdivided
from curvecore.curve import Curve
from curvecore.errors import CurveError
from curvecore.geometry import lengths
from curvecore.pieces import bezier_pieces, size_of

__all__ = ["Nearest", "nearest"]

_ROUNDS = 60
_MOST = 1 << 13  # pieces at a time; only where very many points are equally near
_NEWTON = 8


class Nearest(NamedTuple):
    """The nearest point of a curve.

    Attributes
    ----------
    parameter : float
        Its t.
    point : ndarray, shape (dim,)
        c(t).
    distance : float
        From the given point.
    error : float
        No point of the curve is nearer by more than this.
    """

    parameter: float
    point: FloatArray
    distance: float
    error: float


def nearest(curve: Curve, point: ArrayLike, tolerance: float) -> Nearest:
    """Return the point of a curve that is nearest to a given point.

    Parameters
    ----------
    curve : Curve
        Of any family and dim.
    point : array_like, shape (dim,)
        Finite.
    tolerance : float
        By how much another point of the curve may be nearer, above 0.

    Returns
    -------
    Nearest
        Among points equally near, one of them.

    Raises
    ------
    CurveError
        If the point has another dim or is not finite, or the tolerance is
        not positive.

    Notes
    -----
    Global: all pieces are searched, by bounds and not from starting values;
    Newton's method only polishes the result and is used if it improves it.
    """
    limit = tolerance_value(tolerance)
    dim = curve.points.shape[1]
    target = jet_array(np.asarray(point)[None, None], (1, 1))[0, 0] if np.ndim(point) == 1 else None
    if target is None or target.shape != (dim,):
        raise CurveError(f"point must have the shape ({dim},), like the points of the curve")
    size = size_of(np.concatenate([curve.points, target[None]]))
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        pieces = bezier_pieces(curve, min(1e-3, 0.1 * limit / size))
        _, more = np.frexp(max(np.abs(np.ldexp(target, -pieces.exponent)).max(), 1.0))
        exponent = pieces.exponent + int(more)
        controls = np.ldexp(pieces.controls, -int(more)) - np.ldexp(target, -exponent)
        slack = float(np.ldexp(pieces.error.max(), -int(more)))
        place = _search(controls, pieces.starts, pieces.ends, float(np.ldexp(limit, -exponent)), slack)
        t = _polished(curve, target, place.parameter)
        found = curve.evaluate(t)
        distance = float(lengths(found - target))
        error = max(0.0, distance - float(np.ldexp(place.bound, exponent)))
    return Nearest(t, found, distance, error)


class _Place(NamedTuple):
    parameter: float
    bound: float


def _search(
    controls: FloatArray, start: FloatArray, end: FloatArray, tolerance: float, slack: float
) -> _Place:
    """Return where the controls come nearest to 0, and a lower bound of their distance."""
    best, parameter = _nearest_end(controls, start, end)
    bound = np.inf
    for step in range(_ROUNDS):
        low = _lower_bounds(controls)
        open_ = low < best - tolerance
        closed = low[~open_]
        bound = min(bound, float(closed.min(initial=np.inf)))
        if not open_.any() or 2 * int(open_.sum()) > _MOST or step == _ROUNDS - 1:
            bound = min(bound, float(low.min(initial=np.inf)))
            break
        controls = subdivided(controls[open_])
        middle = 0.5 * start[open_] + 0.5 * end[open_]
        start = np.stack((start[open_], middle), axis=1).ravel()
        end = np.stack((middle, end[open_]), axis=1).ravel()
        distance, candidate = _nearest_end(controls, start, end)
        if distance < best:
            best, parameter = distance, candidate
    return _Place(parameter, max(0.0, min(bound, best) - slack))


def _nearest_end(controls: FloatArray, start: FloatArray, end: FloatArray) -> tuple[float, float]:
    distance = lengths(controls[:, [0, -1]])
    i, side = np.unravel_index(int(np.argmin(distance)), distance.shape)
    return float(distance[i, side]), float(end[i] if side else start[i])


def _lower_bounds(controls: FloatArray) -> FloatArray:
    square = sum(product(controls[:, :, d], controls[:, :, d]) for d in range(controls.shape[2]))
    least = np.asarray(square).min(axis=1)
    bound: FloatArray = np.sqrt(np.maximum(least, 0.0))
    return bound


def _polished(curve: Curve, target: FloatArray, t: float) -> float:
    """Improve t by Newton's method on (c - p) . c' = 0, as long as that brings c nearer."""
    first, last = curve.domain
    best = float(lengths(curve.evaluate(t) - target))
    for _ in range(_NEWTON):
        rest, velocity = curve.evaluate(t) - target, curve.evaluate(t, 1)
        slope = float(velocity @ velocity + rest @ curve.evaluate(t, 2))
        if not np.isfinite(slope) or slope <= 0.0:
            break
        step = float(rest @ velocity) / slope
        following = min(max(t - step, first), last)
        distance = float(lengths(curve.evaluate(following) - target))
        if not distance < best:
            break
        t, best = following, distance
    return t
