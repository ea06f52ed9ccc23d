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

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.nearest_on_arc import MOST_DEGREE, nearest_on_arc
from curvecore.arithmetic import UNIT_ROUNDOFF, vector_lengths
from curvecore.arrays import FloatArray, jet_array, number_array, tolerance_value
from curvecore.bezier.bernstein import Arcs, derivative, elevated, squared_length, weights
from curvecore.bezier.pieces import bezier_pieces, size_of
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve

_ROUNDS = 60
_MOST = 1 << 13  # pieces at a time; only where very many points are equally near
_NEWTON = 8
_PARTED = 32  # arcs, up to which each is cut into more than two
_FOLLOWED = 1e-11  # how closely pieces follow a polynomial of high degree, of its size
_SHARE = 1e-3  # of the reach, by which another point of the curve may be nearer
_CLOSE = 1e-6  # the same, of the size of the curve
_LEAST = 128  # pieces to look among: most are told by their hulls to be out of reach
_ALIKE = 1.0 + 2.0**-50  # ratio of distances that may be equal
_TRIALS = 4  # of a step that leads away, each of half the length


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

    See Also
    --------
    nearest : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, nearest
    >>> found = nearest(LagrangeCurve([[0, 1], [2, 1]], [0, 1]), [1, 3], 1e-9)
    >>> round(found.parameter, 9), found.point.round(9).tolist(), round(found.distance, 9)
    (0.5, [1.0, 1.0], 2.0)
    """

    parameter: float
    point: FloatArray
    distance: float
    error: float


def nearest(curve: ParametricCurve, point: ArrayLike, tolerance: float) -> Nearest:
    """Return the point of a curve that is nearest to a given point.

    Parameters
    ----------
    curve : ParametricCurve
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

    See Also
    --------
    Nearest : What it returns.
    NearestWithin : Of many targets.

    Notes
    -----
    Global: all pieces are searched, by bounds and not from starting values;
    Newton's method only polishes the result and is used if it improves it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, nearest
    >>> found = nearest(LagrangeCurve([[0, 1], [2, 1]], [0, 1]), [1, 3], 1e-9)
    >>> round(found.parameter, 9), round(found.distance, 9)
    (0.5, 2.0)
    """
    limit, target = tolerance_value(tolerance), _point_of(curve, point)
    quick = _nearest_of_one_piece(curve, target, limit)
    if quick is not None:
        return quick
    size = size_of(np.concatenate([curve.points, target[None]]))

    def at(t: float) -> _Descent:
        rest = curve.evaluate(t) - target

        def step() -> float:
            velocity, acceleration = curve.evaluate(t, 1), curve.evaluate(t, 2)
            slope, speed = float(rest @ velocity), float(velocity @ velocity)
            return _newton_step(slope, speed, float(rest @ acceleration))

        return _Descent(math.hypot(*rest.tolist()), step)

    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        pieces = bezier_pieces(curve, min(1e-3, 0.1 * limit / size))
        _, more = np.frexp(max(np.abs(np.ldexp(target, -pieces.exponent)).max(), 1.0))
        exponent = pieces.exponent + int(more)
        controls = np.ldexp(pieces.controls, -int(more)) - np.ldexp(target, -exponent)
        slack = float(np.ldexp(pieces.error.max(), -int(more)))
        arcs = Arcs(controls, pieces.starts, pieces.ends)
        known: dict[float, _Candidate] = {}

        def improved(t: float) -> _Candidate:
            if t not in known:
                better, distance = _polished(curve.domain, at, t)
                known[t] = known[better] = _Candidate(better, float(np.ldexp(distance, -exponent)))
            return known[t]

        result = _search(arcs, float(np.ldexp(limit, -exponent)), slack, improved=improved)
        return _nearest_at(curve, target, improved(result.parameter).parameter, result, exponent)


def _nearest_of_one_piece(curve: ParametricCurve, target: FloatArray, limit: float) -> Nearest | None:
    """Return the nearest point of a curve that is one polynomial of low degree, else None."""
    if curve.degree is None or not 1 < curve.degree <= MOST_DEGREE or len(curve.breaks) > 2:
        return None
    controls = curve.bezier_pieces()
    if controls is None or len(controls) != 1:
        return None
    columns = zip(controls[0].T.tolist(), target.tolist(), strict=True)
    nearest = nearest_on_arc([[x_of_arc - x for x_of_arc in column] for column, x in columns], limit)
    if nearest is None:
        return None
    start, end = curve.domain
    t = min(start + nearest.s * (end - start), end)
    point = curve.evaluate(t)
    distance = math.hypot(*(point - target).tolist())
    slack = 8.0 * UNIT_ROUNDOFF * float(np.abs(controls).max())
    return Nearest(t, point, distance, max(0.0, distance - max(0.0, nearest.bound - slack)))


def _nearest_at(
    curve: ParametricCurve, target: FloatArray, t: float, result: _SearchResult, exponent: int
) -> Nearest:
    """Return the point at t as the nearest one, from a search in units of 2**exponent."""
    point = curve.evaluate(t)
    distance = float(vector_lengths(point - target))
    return Nearest(t, point, distance, max(0.0, distance - float(np.ldexp(result.bound, exponent))))


def _point_of(curve: ParametricCurve, point: ArrayLike) -> FloatArray:
    dim = curve.points.shape[1]
    target = number_array(point, "point")
    if target.shape != (dim,):
        raise CurveError(f"point must have the shape ({dim},), like the points of the curve")
    return np.asarray(jet_array(target[None, None], (1, 1))[0, 0])


class NearestWithin:
    """Search for the points of one plane curve nearest to many targets, each within a reach.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family, dim 2. Its Bezier pieces are made here, once; a target
        costs a bounded search among those in reach, and one evaluation.

    See Also
    --------
    nearest : Of one target, however far away.

    Notes
    -----
    The pieces of one polynomial follow it within 1e-9 of its size. Where that
    is far more than the size of its points, as on 40 and more points at equal
    parameters, a point beside them may not be found.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, NearestWithin
    >>> finder = NearestWithin(LagrangeCurve([[0, 0], [2, 0]], [0, 1]))
    >>> round(finder.to([0.5, 0.25], 1.0).parameter, 9)
    0.25
    >>> finder.to([9, 9], 1.0) is None
    True
    """

    def __init__(self, curve: ParametricCurve) -> None:
        self._curve = curve
        pieces = bezier_pieces(curve, _FOLLOWED)
        self._exponent, self._slack = pieces.exponent, float(pieces.error.max())
        arcs = Arcs(pieces.controls, pieces.starts, pieces.ends)
        while len(arcs.start) < _LEAST:
            arcs = arcs.halved()
        self._arcs, controls = arcs, arcs.controls
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
        target, reach = _point_of(self._curve, point), tolerance_value(reach, "reach")
        with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
            centre, radius = np.ldexp(target, -self._exponent), float(np.ldexp(reach, -self._exponent))
            near = ((self._low - radius <= centre) & (self._high + radius >= centre)).all(axis=1)
            if not near.any():
                return None
            arcs = self._arcs.selected(near)
            arcs = arcs._replace(controls=arcs.controls - centre)
            # What is found at the very edge may move inside when it is polished.
            limit = (1.0 + 2.0 * _SHARE) * radius
            best = _search(arcs, min(_SHARE * radius, self._tolerance), self._slack, limit)
            if np.isnan(best.parameter):
                return None
            t, _ = _polished(self._curve.domain, partial(self._at, *centre.tolist()), best.parameter, _TRIALS)
            result = _nearest_at(self._curve, target, t, best, self._exponent)
        return result if result.distance <= reach else None

    def _at(self, target_x: float, target_y: float, t: float) -> _Descent:
        """Return the numbers of Newton's method at t, from the pieces."""
        start, end = self._arcs.start, self._arcs.end
        i = max(int(np.searchsorted(start, t, side="right")) - 1, 0)
        h = float(end[i] - start[i])
        s = np.array([(t - float(start[i])) / h])
        x, y, vx, vy, ax, ay = (weights(s, self._jets.shape[1] - 1)[0] @ self._jets[i]).tolist()
        x, y = x - target_x, y - target_y
        products = x * vx + y * vy, vx * vx + vy * vy, x * ax + y * ay
        return _Descent(x * x + y * y, lambda: h * _newton_step(*products))


class _Descent(NamedTuple):
    """A parameter on the way to the nearest point.

    Attributes
    ----------
    size : float
        The distance, or its square, that is to become smaller.
    step : callable
        What Newton's method subtracts from t.
    """

    size: float
    step: Callable[[], float]


def _newton_step(slope: float, speed: float, bend: float) -> float:
    """Return the step in t, given the products (c - p) . c', c' . c' and (c - p) . c''."""
    # Where the distance is not convex, the way of Gauss and Newton leads down as well.
    divisor = speed + bend if speed + bend > 0.0 else speed
    return slope / divisor if 0.0 < divisor < np.inf else 0.0


def _polished(
    domain: tuple[float, float], at: Callable[[float], _Descent], t: float, trials: int = 1
) -> tuple[float, float]:
    """Improve t by Newton's method, until none of so many trials, each a half step, brings c nearer.

    Returns t and its size.
    """
    here = at(t)
    for _ in range(_NEWTON):
        step = here.step()
        for _ in range(trials):
            following = min(max(t - step, domain[0]), domain[1])
            there = at(following)
            if there.size <= _ALIKE * here.size:
                break
            step *= 0.5
        else:
            break
        before, t, here = here.size, following, there
        # Where roundings alone tell the distances apart, t is better after a step than before, and final.
        if here.size >= before:
            break
    return t, here.size


class _Candidate(NamedTuple):
    """A parameter, and how far its point of the curve is away, in the units of a search."""

    parameter: float
    distance: float


class _SearchResult(NamedTuple):
    """The parameter of the nearest point found, and a lower bound of all distances."""

    parameter: float
    bound: float


def _search(
    arcs: Arcs,
    tolerance: float,
    slack: float,
    reach: float = np.inf,
    improved: Callable[[float], _Candidate] | None = None,
) -> _SearchResult:
    """Return the point of the arcs nearest to 0, and a lower bound of the distance.

    NaN where they do not come within reach. A way to better parameters nearby spares rounds where the curve
    passes through 0: the ends of arcs come nearer only as fast as arcs become shorter.
    """
    best, parameter, bound = reach, np.nan, np.inf
    for step in range(_ROUNDS):
        squares = squared_length(arcs.controls)
        # The first and the last coefficients are those of the ends, to the last digit.
        ends = squares[:, [0, -1]]
        i, side = divmod(int(ends.argmin()), 2)
        distance = math.sqrt(ends[i, side])
        if distance < best:
            best, parameter = distance, float(arcs.end[i] if side else arcs.start[i])
        if improved is not None and step == 1:
            parameter, best = min(
                _Candidate(parameter, best), improved(parameter), key=lambda candidate: candidate.distance
            )
        low = np.sqrt(np.maximum(squares.min(axis=1), 0.0))
        open_ = low < best - tolerance
        bound = min(bound, float(low[~open_].min(initial=np.inf)))
        if not open_.any() or 2 * int(open_.sum()) > _MOST or step == _ROUNDS - 1:
            bound = min(bound, float(low.min(initial=np.inf)))
            break
        arcs = arcs.selected(open_)
        # Of a few arcs, which is the rule, a round takes as long for 16 parts of each as for halves.
        arcs = arcs.divided(16 if len(arcs.start) <= _PARTED else 2)
    return _SearchResult(parameter, max(0.0, min(bound, best) - slack))
