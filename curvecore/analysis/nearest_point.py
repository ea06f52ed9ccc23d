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

from curvecore.arrays import FloatArray, jet_array, number_array, tolerance_value
from curvecore.bezier.bernstein_algebra import derivative, elevated, product, subdivided, weights
from curvecore.bezier.pieces import bezier_pieces, size_of
from curvecore.errors import CurveError
from curvecore.families.curve import Curve
from curvecore.vectors import vector_lengths

_ROUNDS = 60
_MOST = 1 << 13  # pieces at a time; only where very many points are equally near
_NEWTON = 8
_FOLLOWED = 1e-11  # how closely pieces follow a polynomial of high degree, of its size
_SHARE = 1e-3  # of the reach, by which another point of the curve may be nearer
_CLOSE = 1e-6  # the same, of the size of the curve
_LEAST = 128  # pieces to look among: most are told by their hulls to be out of reach
_HALVINGS = 4  # of a step that leads away


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
    limit, target = tolerance_value(tolerance), _point_of(curve, point)
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
        distance = float(vector_lengths(found - target))
        error = max(0.0, distance - float(np.ldexp(place.bound, exponent)))
    return Nearest(t, found, distance, error)


def _point_of(curve: Curve, point: ArrayLike) -> FloatArray:
    dim = curve.points.shape[1]
    target = number_array(point, "point")
    if target.shape != (dim,):
        raise CurveError(f"point must have the shape ({dim},), like the points of the curve")
    checked: FloatArray = jet_array(target[None, None], (1, 1))[0, 0]
    return checked


class NearestWithin:
    """Finds the points of one plane curve nearest to many places, each within a reach.

    Parameters
    ----------
    curve : Curve
        Of any family, dim 2. Its Bezier pieces are made here, once; a place
        costs a bounded search among those in reach, and one evaluation.

    Notes
    -----
    The pieces of one polynomial follow it within 1e-9 of its size. Where that
    is far more than the size of its points, as on 40 and more points at equal
    parameters, a place beside them may not be found.
    """

    def __init__(self, curve: Curve) -> None:
        self._curve = curve
        pieces = bezier_pieces(curve, _FOLLOWED)
        self._exponent, self._slack = pieces.exponent, float(pieces.error.max())
        controls, start, end = pieces.controls, pieces.starts, pieces.ends
        while len(controls) < _LEAST:
            controls = subdivided(controls)
            start, end = _halved(start, end)
        self._controls, self._start, self._end = controls, start, end
        velocities = derivative(controls)
        # Of one degree, so that one row of weights evaluates them all.
        degree = controls.shape[1]
        parts = (controls, velocities, derivative(velocities))
        self._jets = np.concatenate([elevated(part, degree - part.shape[1]) for part in parts], axis=2)
        self._low, self._high = controls.min(axis=1), controls.max(axis=1)
        self._tolerance = _CLOSE * size_of(controls)

    def to(self, point: ArrayLike, reach: float) -> Nearest | None:
        """Return the nearest point of the curve.

        Parameters
        ----------
        point : array_like, shape (2,)
            Finite.
        reach : float
            Above 0.

        Returns
        -------
        Nearest or None
            None where no point of the curve is within reach. `error` is at
            most a thousandth of the reach and a millionth of the curve's size.

        Raises
        ------
        CurveError
            If the point has another dim or is not finite, or the reach is
            not positive.
        """
        exponent, place, reach = (
            self._exponent,
            _point_of(self._curve, point),
            tolerance_value(reach, "reach"),
        )
        with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
            target, radius = np.ldexp(place, -exponent), float(np.ldexp(reach, -exponent))
            near = ((self._low - radius <= target) & (self._high + radius >= target)).all(axis=1)
            if not near.any():
                return None
            controls, start, end = self._controls[near] - target, self._start[near], self._end[near]
            # What is found at the very edge may move inside when it is polished.
            limit = (1.0 + 2.0 * _SHARE) * radius
            best = _search(controls, start, end, min(_SHARE * radius, self._tolerance), self._slack, limit)
            if np.isnan(best.parameter):
                return None
            t = self._polished((float(target[0]), float(target[1])), best.parameter)
            found = self._curve.evaluate(t)
            distance = float(vector_lengths(found - place))
            error = max(0.0, distance - float(np.ldexp(best.bound, exponent)))
        return Nearest(t, found, distance, error) if distance <= reach else None

    def _polished(self, target: tuple[float, float], t: float) -> float:
        """Improve t by Newton's method on the pieces, by steps that bring the curve nearer."""
        first, last = self._curve.domain
        at = self._at(t, target)
        for _ in range(_NEWTON):
            step = at.step
            for _ in range(_HALVINGS):
                following = min(max(t - step, first), last)
                there = self._at(following, target)
                if there.square < at.square:
                    break
                step *= 0.5
            else:
                break
            t, at = following, there
        return t

    def _at(self, t: float, target: tuple[float, float]) -> _Local:
        """Return the squared distance at t, and Newton's step from there in t."""
        i = max(int(np.searchsorted(self._start, t, side="right")) - 1, 0)
        h = float(self._end[i] - self._start[i])
        s = np.array([(t - float(self._start[i])) / h])
        x, y, vx, vy, ax, ay = (weights(s, self._jets.shape[1] - 1)[0] @ self._jets[i]).tolist()
        x, y = x - target[0], y - target[1]
        slope, speed = x * vx + y * vy, vx * vx + vy * vy
        curvature = speed + x * ax + y * ay
        # Where the distance is not convex, the way of Gauss and Newton leads down as well.
        divisor = curvature if curvature > 0.0 else speed
        return _Local(x * x + y * y, h * slope / divisor if divisor > 0.0 else 0.0)


class _Local(NamedTuple):
    square: float
    step: float


class _Place(NamedTuple):
    parameter: float
    bound: float


def _search(
    controls: FloatArray,
    start: FloatArray,
    end: FloatArray,
    tolerance: float,
    slack: float,
    reach: float = np.inf,
) -> _Place:
    """Return where the controls come nearest to 0, and a lower bound of their distance.

    NaN where they do not come within reach.
    """
    best, parameter = _nearest_end(controls, start, end)
    if best > reach:
        best, parameter = reach, np.nan
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
        start, end = _halved(start[open_], end[open_])
        distance, candidate = _nearest_end(controls, start, end)
        if distance < best:
            best, parameter = distance, candidate
    return _Place(parameter, max(0.0, min(bound, best) - slack))


def _halved(start: FloatArray, end: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return where the halves of intervals begin and end."""
    middle = 0.5 * start + 0.5 * end
    return np.stack((start, middle), axis=1).ravel(), np.stack((middle, end), axis=1).ravel()


def _nearest_end(controls: FloatArray, start: FloatArray, end: FloatArray) -> tuple[float, float]:
    distance = vector_lengths(controls[:, [0, -1]])
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
    best = float(vector_lengths(curve.evaluate(t) - target))
    for _ in range(_NEWTON):
        rest, velocity = curve.evaluate(t) - target, curve.evaluate(t, 1)
        slope = float(velocity @ velocity + rest @ curve.evaluate(t, 2))
        if not np.isfinite(slope) or slope <= 0.0:
            break
        step = float(rest @ velocity) / slope
        following = min(max(t - step, first), last)
        distance = float(vector_lengths(curve.evaluate(following) - target))
        if not distance < best:
            break
        t, best = following, distance
    return t
