"""Arc length within a proven bound, and its inverse.

On a piece the speed is sqrt(q), q a polynomial. If q has no root inside the
Bernstein ellipse of parameter rho, and |sqrt(q)| <= M there, then Gauss-
Legendre quadrature with n points errs by at most
64 M rho**(-2 n) / (15 (1 - rho**-2)) on [-1, 1] [1]_. The Chebyshev
coefficients of q show both: with S = sum_(k > 0) |a_k| (rho**k + rho**-k) / 2,
S < |a_0| suffices, and M**2 = |a_0| + S. Pieces where this is not good enough
are halved. Towards a cusp, where the speed is 0, no ellipse is free of roots,
but the chord and the control polygon enclose the length [2]_. They enclose
the quadrature as well, whose weights are positive and which is exact for the
Bernstein polynomials. Both shrink fourfold with every halving, so the bound
holds at cusps too.

References
----------
.. [1] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, theorem 19.3.
.. [2] J. Gravesen, "Adaptive subdivision and the length and energy of Bezier
   curves", Computational Geometry 8 (1997) 13-31.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    finite_number,
    integer,
    parameter_values,
    read_only,
    tolerance_value,
)
from curvecore.bernstein_algebra import halves, weights
from curvecore.curve import Curve
from curvecore.errors import CurveError
from curvecore.immutable import Immutable
from curvecore.pieces import BezierPieces, bezier_pieces, size_of
from curvecore.scaling import LARGEST

__all__ = ["ArcLength", "Length", "arc_length", "equal_arc_length_parameters", "parameter_at_length"]

_NODES = 16
_UNIT = 2.0**-53
_ROUNDS = 60
_MOST = 1 << 14  # arcs, or 8 a piece; a curve that needs more gets a larger error bound
_AT_ONCE = 1 << 12  # quadratures, of 16 sets of weights each: a few megabytes
_RHO = np.array([1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 12.0, 24.0, 64.0, 1024.0])


class Length(NamedTuple):
    """An arc length.

    Attributes
    ----------
    value : float
        In units of the points.
    error : float
        Bound of its error: proved, with roundings, for the Hermite families;
        for `LagrangeCurve` it holds a measured part, see `arc_length`.
    """

    value: float
    error: float


class _Arcs(NamedTuple):
    """Stretches of the curve in order, with what is known of their lengths.

    Attributes
    ----------
    slopes : ndarray, shape (k, d, dim)
        Bezier control points of dc/ds, s in [0, 1] on the stretch.
    start, end : ndarray, shape (k,)
        In t.
    slack : ndarray, shape (k,)
        What the length may be off because `slopes` is.
    """

    slopes: FloatArray
    start: FloatArray
    end: FloatArray
    slack: FloatArray

    def taken(self, chosen: BoolArray | IntArray) -> _Arcs:
        """Return some of the arcs."""
        return _Arcs(self.slopes[chosen], self.start[chosen], self.end[chosen], self.slack[chosen])


class ArcLength(Immutable):
    """The arc length of a curve as a function of t, and back.

    A table made once, for motion at constant speed and the like; lengths and
    parameters then cost one quadrature of 16 points each.

    Parameters
    ----------
    curve : Curve
        Of any family and dim.
    tolerance : float
        Largest wanted error of any length, above 0, in units of the points.

    Attributes
    ----------
    total : Length
        The whole length.

    Raises
    ------
    CurveError
        If the tolerance is not a positive number.
    """

    __slots__ = ("_arcs", "_at", "_scale", "total")

    def __init__(self, curve: Curve, tolerance: float) -> None:
        limit = tolerance_value(tolerance)
        size = max(size_of(curve.points), float(np.finfo(float).tiny))
        # Derivatives of pieces are some 100 times less accurate, and there may be 100 pieces.
        pieces = bezier_pieces(curve, min(1e-3, 1e-5 * limit / size))
        shift = min(pieces.exponent, 1000)
        self._scale = float(np.ldexp(1.0, shift))
        slopes = np.ldexp(pieces.slopes, pieces.exponent - shift)
        with np.errstate(all="ignore"):
            slack = np.ldexp(_slack(pieces), pieces.exponent - shift)
            arcs = _Arcs(slopes, pieces.starts, pieces.ends, slack)
            self._arcs, error = _accurate(arcs, limit / self._scale)
            lengths = _integrals(self._arcs.slopes, np.zeros(len(error)), np.ones(len(error)))
            self._at = np.concatenate(([0.0], np.cumsum(lengths)))
            value = float(self._at[-1])
            bound = error.sum() + self._arcs.slack.sum() + 16.0 * _UNIT * value
            self.total = Length(min(value * self._scale, LARGEST), min(float(bound) * self._scale, LARGEST))

    def length_at(self, t: ArrayLike) -> FloatArray:
        """Return the length from the beginning of the domain.

        Parameters
        ----------
        t : float or array_like, shape (m,)
            Limited to the domain.

        Returns
        -------
        ndarray, shape () or (m,)
            Each with at most the error ``total.error``.
        """
        at = parameter_values(t)
        arc = np.clip(np.searchsorted(self._arcs.start, at.values, side="right") - 1, 0, None)
        with np.errstate(all="ignore"):
            start, end = self._arcs.start[arc], self._arcs.end[arc]
            place = np.clip((at.values - start) / (end - start), 0.0, 1.0)
            part = _integrals(self._arcs.slopes[arc], np.zeros(len(arc)), place)
            result = np.minimum((self._at[arc] + part) * self._scale, LARGEST)
        return result[0] if at.is_scalar else result

    def parameter_at(self, length: ArrayLike) -> FloatArray:
        """Return the parameters at which lengths are reached.

        Parameters
        ----------
        length : float or array_like, shape (m,)
            From the beginning; limited to 0 and the whole length.

        Returns
        -------
        ndarray, shape () or (m,)
            Where the curve rests over an interval, its beginning. The length
            there differs from the wanted one by ``total.error`` at most, and
            by what one unit in the last place of t makes.
        """
        at = parameter_values(length)
        with np.errstate(all="ignore"):
            wanted = np.clip(at.values / self._scale, 0.0, self._at[-1])
            arc = np.clip(np.searchsorted(self._at, wanted, side="left") - 1, 0, len(self._at) - 2)
            place = _places(self._arcs.slopes[arc], wanted - self._at[arc], np.diff(self._at)[arc])
            start, end = self._arcs.start[arc], self._arcs.end[arc]
            result = np.minimum(start + place * (end - start), end)
        return result[0] if at.is_scalar else result


def arc_length(
    curve: Curve, tolerance: float, start: float | None = None, end: float | None = None
) -> Length:
    """Return the arc length of a curve, or of a part of it.

    Parameters
    ----------
    curve : Curve
        Of any family and dim.
    tolerance : float
        Largest wanted error, above 0, in units of the points.
    start, end : float, optional
        The part, start <= end, limited to the domain; without them, its ends.

    Returns
    -------
    Length
        The value and a bound of its error, which exceeds the tolerance where
        rounding does not allow better: relative 1e-14, or so.

    Raises
    ------
    CurveError
        If the tolerance is not positive, or start exceeds end.

    Notes
    -----
    The bound is proved for the Hermite families, cusps included. A
    `LagrangeCurve` is first replaced by pieces of degree 8; how far their
    derivatives are from its own is measured, with a factor of two to spare.

    Examples
    --------
    >>> curve = HermiteCurve([[0, 0], [3, 4]], [[3, 4], [3, 4]], [0, 1])
    >>> round(arc_length(curve, 1e-9).value, 9)
    5.0
    """
    table = ArcLength(curve, 0.5 * tolerance_value(tolerance))
    first, last = curve.domain
    low = first if start is None else finite_number(start, "start")
    high = last if end is None else finite_number(end, "end")
    if low > high:
        raise CurveError(f"start must not exceed end, but {low} > {high}")
    if low <= first and high >= last:
        return table.total
    from_start, to_end = table.length_at([low, high])
    return Length(float(to_end - from_start), 2.0 * table.total.error)


def parameter_at_length(curve: Curve, length: ArrayLike, tolerance: float) -> FloatArray:
    """Return the parameters at which the curve has given lengths.

    Parameters
    ----------
    curve : Curve
        Of any family and dim.
    length : float or array_like, shape (m,)
        From the beginning of the domain, limited to 0 and the whole length.
    tolerance : float
        How far the length at the result may be off, above 0.

    Returns
    -------
    ndarray, shape () or (m,)
        See `ArcLength.parameter_at`, which is the thing to keep for many calls.
    """
    return ArcLength(curve, tolerance).parameter_at(length)


def equal_arc_length_parameters(curve: Curve, count: int, tolerance: float) -> FloatArray:
    """Return parameters that divide the curve into parts of equal length.

    Parameters
    ----------
    curve : Curve
        Of any family and dim.
    count : int
        Number of parameters, at least 2.
    tolerance : float
        How far each length from the beginning may be off, above 0.

    Returns
    -------
    ndarray, shape (count,)
        Not decreasing; the first and the last are the ends of the domain.
    """
    number = integer(count, "count", 2)
    table = ArcLength(curve, tolerance)
    with np.errstate(under="ignore"):
        wanted = table.total.value * (np.arange(number) / (number - 1))
    result = table.parameter_at(wanted)
    result[0], result[-1] = curve.domain
    return np.maximum.accumulate(result)


def _slack(pieces: BezierPieces) -> FloatArray:
    """Bound what errors of the pieces make of their lengths, (k,), in the units of their control points.

    An error e of c makes |c' + e'| - |c'| of the speed: at most |e'|, and between T . e' and that plus
    |e'|**2 / (2 |c'|), with the tangent T. The integral of T . e' is, by parts, at most |e| times the angle
    by which the piece turns; what is left at its ends goes with its neighbours', where the curve has no
    corner, and is 0 at the ends of the curve and of exact pieces. The control polygon turns as far, at least.
    """
    slopes = pieces.slopes
    fast = slopes / np.maximum(np.linalg.norm(slopes, axis=2, keepdims=True), np.finfo(float).tiny)
    ahead = fast.sum(axis=1)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    slowest = np.einsum("kbd,kd->kb", slopes, ahead).min(axis=1)
    # Chords of the unit circle, pi / 2 times at most as long in angles.
    turn = 0.5 * np.pi * np.linalg.norm(np.diff(fast, axis=1), axis=2).sum(axis=1)
    smooth = pieces.error * (turn + 4.0 * _UNIT) + 0.5 * pieces.slope_error**2 / slowest
    return np.where(slowest > pieces.slope_error, np.minimum(smooth, pieces.slope_error), pieces.slope_error)


def _accurate(arcs: _Arcs, tolerance: float) -> tuple[_Arcs, FloatArray]:
    """Halve arcs until their lengths are accurate; return them in order with their error bounds."""
    done: list[_Arcs] = []
    errors: list[FloatArray] = []
    span = float(arcs.end[-1]) - float(arcs.start[0])
    count = 0
    share = 0.5 * tolerance / len(arcs.start)
    most = max(_MOST, 8 * len(arcs.start))
    for step in range(_ROUNDS):
        bound, polygon = _bounds(arcs.slopes)
        # Both halves of an arc together get what it had: the shares of all add up to the tolerance.
        fine = (bound <= share) | (bound <= 2.0 * _UNIT * polygon)
        fine |= arcs.end - arcs.start <= 4.0 * _UNIT * span
        count += int(fine.sum())
        if step == _ROUNDS - 1 or count + 2 * int((~fine).sum()) > most:
            fine[:] = True
        done.append(arcs.taken(fine))
        errors.append(bound[fine])
        if fine.all():
            break
        arcs = _halved(arcs.taken(~fine))
        share *= 0.5
    order = np.argsort(np.concatenate([each.start for each in done]), kind="stable")
    together = _Arcs(*(np.concatenate(column) for column in zip(*done, strict=True)))
    return together.taken(order), np.concatenate(errors)[order]


def _halved(arcs: _Arcs) -> _Arcs:
    left, right = halves(0.5 * arcs.slopes)
    middle = 0.5 * arcs.start + 0.5 * arcs.end
    return _Arcs(
        np.concatenate([left, right]),
        np.concatenate([arcs.start, middle]),
        np.concatenate([middle, arcs.end]),
        np.tile(0.5 * arcs.slack, 2),
    )


def _bounds(slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bounds of the errors of the quadrature, and the control polygons' lengths."""
    polygon = np.linalg.norm(slopes, axis=2).mean(axis=1)
    chord = np.linalg.norm(slopes.mean(axis=1), axis=1)
    rough = np.maximum(polygon - chord, 0.0)
    degree = slopes.shape[1] - 1
    evaluation, transform = _square_matrices(degree)
    q = np.square(np.einsum("pb,kbd->kpd", evaluation, slopes)).sum(axis=2)
    coefficients = np.abs(q @ transform.T)
    k = np.arange(1, 2 * degree + 1)
    growth = 0.5 * (_RHO[:, None] ** k + _RHO[:, None] ** -k)
    rest = coefficients[:, 1:] @ growth.T
    free = rest < coefficients[:, :1]
    largest = np.sqrt(coefficients[:, :1] + rest)
    factor = 64.0 * _RHO ** (-2.0 * _NODES) / (15.0 * (1.0 - _RHO**-2.0))
    # Half, because s runs over an interval of length 1.
    proved = np.where(free, 0.5 * largest * factor, np.inf).min(axis=1)
    return np.minimum(proved, rough), polygon


def _integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the lengths between places of arcs, shape (k,)."""
    some = [slice(first, first + _AT_ONCE) for first in range(0, max(len(slopes), 1), _AT_ONCE)]
    return np.concatenate([_some_integrals(slopes[each], start[each], end[each]) for each in some])


def _some_integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    nodes, gauss = _gauss()
    length = end - start
    s = start[:, None] + length[:, None] * nodes
    degree = slopes.shape[1] - 1
    bernstein = weights(s.ravel(), degree).reshape(*s.shape, degree + 1)
    speeds = np.linalg.norm(bernstein @ slopes, axis=2)
    result: FloatArray = length * (speeds @ gauss)
    return result


def _places(slopes: FloatArray, wanted: FloatArray, whole: FloatArray) -> FloatArray:
    """Return where arcs have the wanted lengths: Newton's method within brackets."""
    low, high = np.zeros(len(wanted)), np.ones(len(wanted))
    place = np.clip(np.nan_to_num(wanted / whole), 0.0, 1.0)
    for _ in range(_ROUNDS):
        excess = _integrals(slopes, np.zeros(len(place)), place) - wanted
        high, low = np.where(excess >= 0.0, place, high), np.where(excess <= 0.0, place, low)
        degree = slopes.shape[1] - 1
        fast = np.linalg.norm(np.einsum("kb,kbd->kd", weights(place, degree), slopes), axis=1)
        step = place - excess / fast
        inside = (step >= low) & (step <= high)
        following = np.where(inside, step, 0.5 * (low + high))
        moved = np.abs(following - place).max(initial=0.0)
        place = following
        if moved <= 4.0 * _UNIT:
            break
    return place


@cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    nodes, gauss = np.polynomial.legendre.leggauss(_NODES)
    return read_only(0.5 * (nodes + 1.0)), read_only(0.5 * gauss)


@cache
def _square_matrices(degree: int) -> tuple[FloatArray, FloatArray]:
    """Return matrices to values at Chebyshev points, and from values of a square to coefficients."""
    n = 2 * degree
    if n == 0:
        return read_only(np.ones((1, 1))), read_only(np.ones((1, 1)))
    k = np.arange(n + 1)
    places = np.sin(k * (np.pi / (2 * n))) ** 2
    transform = (2.0 / n) * np.cos(np.pi * np.outer(k, k) / n) * (-1.0) ** k[:, None]
    transform[:, [0, n]] *= 0.5
    transform[[0, n]] *= 0.5
    return read_only(weights(places, degree)), read_only(transform)
