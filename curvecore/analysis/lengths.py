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
holds at cusps as well.

Arcs of many curves are integrated together, because the number of calls to NumPy is what a small curve
costs, not the arithmetic.

References
----------
.. [1] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, theorem 19.3.
.. [2] J. Gravesen, "Adaptive subdivision and the length and energy of Bezier
   curves", Computational Geometry 8 (1997) 13-31.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST, SMALLEST, UNIT_ROUNDOFF
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
from curvecore.bezier.bernstein import halves, to_chebyshev, weights
from curvecore.bezier.pieces import BezierPieces, alike, bezier_pieces, size_of
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.immutable import Immutable
from curvecore.parametrization import chebyshev


class Length(NamedTuple):
    """An arc length.

    Attributes
    ----------
    value : float
        In units of the points.
    error : float
        Bound of its error: proved, with roundings, for the Hermite families;
        for `LagrangeCurve` it holds a measured part, see `arc_length`.

    See Also
    --------
    arc_length : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, arc_length
    >>> length = arc_length(LagrangeCurve([[0, 0], [3, 4]], [0, 1]), 1e-9)
    >>> round(length.value, 9), length.error <= 1e-9
    (5.0, True)
    """

    value: float
    error: float


class ArcLength(Immutable):
    """The arc length of a curve as a function of t, and back.

    A table made once, for motion at constant speed and the like; lengths and
    parameters then cost one quadrature of 16 points each.

    Parameters
    ----------
    curve : ParametricCurve
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

    See Also
    --------
    arc_length : The length alone.
    equal_arc_length_parameters : Parts of equal length.

    Examples
    --------
    >>> from curvecore import ArcLength, LagrangeCurve
    >>> length = ArcLength(LagrangeCurve([[0, 0], [3, 4], [6, 8]], [0, 1, 2]), 1e-9)
    >>> round(length.total.value, 9)
    10.0
    >>> length.length_at([0.5, 1]).round(9).tolist()
    [2.5, 5.0]
    >>> round(float(length.parameter_at(5)), 9)
    1.0
    """

    __slots__ = ("_arcs", "_at", "_scale", "total")

    def __init__(self, curve: ParametricCurve, tolerance: float) -> None:
        limit = tolerance_value(tolerance)
        # Derivatives of pieces are some 100 times less accurate, and there may be 100 pieces.
        pieces = bezier_pieces(curve, min(1e-3, 1e-5 * limit / size_of(curve.points)))
        measured = _measured([pieces], np.array([limit]))
        self._arcs, self._scale, (self.total,) = measured.arcs, float(measured.scales[0]), measured.totals
        self._at = np.concatenate(([0.0], np.cumsum(measured.lengths)))

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
            share = np.clip((at.values - start) / (end - start), 0.0, 1.0)
            part = integrals(self._arcs.slopes[arc], np.zeros(len(arc)), share)
            result = np.minimum((self._at[arc] + part) * self._scale, LARGEST)
        return at.shaped(result)

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
            share = share_at_length(self._arcs.slopes[arc], wanted - self._at[arc], np.diff(self._at)[arc])
            start, end = self._arcs.start[arc], self._arcs.end[arc]
            result = np.minimum(start + share * (end - start), end)
        return at.shaped(result)


def arc_length(
    curve: ParametricCurve, tolerance: float, start: float | None = None, end: float | None = None
) -> Length:
    """Return the arc length of a curve, or of a part of it.

    Parameters
    ----------
    curve : ParametricCurve
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

    See Also
    --------
    ArcLength : Many lengths of one curve.
    speed : What is integrated.

    Notes
    -----
    The bound is proved for the Hermite families, cusps included. A
    `LagrangeCurve` is first replaced by pieces of degree 8; how far their
    derivatives are from its own is measured, with a factor of two to spare.
    It holds for the parameters of the curve as they are, see `chord_length`.

    Examples
    --------
    >>> from curvecore import HermiteCurve, arc_length
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


def parameter_at_length(curve: ParametricCurve, length: ArrayLike, tolerance: float) -> FloatArray:
    """Return the parameters at which the curve has given lengths.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    length : float or array_like, shape (m,)
        From the beginning of the domain, limited to 0 and the whole length.
    tolerance : float
        How far the length at the result may be off, above 0.

    Returns
    -------
    ndarray, shape () or (m,)
        See `ArcLength.parameter_at`, which is the thing to keep for many calls.

    See Also
    --------
    arc_length : The way back.
    equal_arc_length_parameters : Parts of equal length.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, parameter_at_length
    >>> curve = LagrangeCurve([[0, 0], [3, 4], [6, 8]], [0, 1, 2])
    >>> parameter_at_length(curve, [2.5, 10], 1e-9).round(9).tolist()
    [0.5, 2.0]
    """
    return ArcLength(curve, tolerance).parameter_at(length)


def equal_arc_length_parameters(curve: ParametricCurve, count: int, tolerance: float) -> FloatArray:
    """Return parameters that divide the curve into parts of equal length.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim.
    count : int
        Number of parameters, at least 2.
    tolerance : float
        How far each length from the beginning may be off, above 0.

    Returns
    -------
    ndarray, shape (count,)
        Not decreasing; the first and the last are the ends of the domain.

    See Also
    --------
    parameter_at_length : Of given lengths.
    ArcLength : Lengths and parameters, back and forth.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, equal_arc_length_parameters
    >>> curve = LagrangeCurve([[0, 1], [1, 1], [4, 1]], [0, 1, 2])
    >>> t = equal_arc_length_parameters(curve, 3, 1e-9)
    >>> curve(t).round(6).tolist()
    [[0.0, 1.0], [2.0, 1.0], [4.0, 1.0]]
    """
    number = integer(count, "count", 2)
    table = ArcLength(curve, tolerance)
    with np.errstate(under="ignore"):
        wanted = table.total.value * (np.arange(number) / (number - 1))
    result = table.parameter_at(wanted)
    result[0], result[-1] = curve.domain
    return np.maximum.accumulate(result)


def arc_lengths(parts: Sequence[BezierPieces], tolerances: ArrayLike) -> list[Length]:
    """Return the arc lengths of many curves, whose pieces are at hand, in a fraction of the time.

    Parameters
    ----------
    parts : sequence of BezierPieces
        Of each curve. Their errors count in the bounds of the lengths.
    tolerances : array_like, shape (len(parts),)
        Largest wanted errors, above 0, each in units of the curve's points.

    Returns
    -------
    list of Length
        As `ArcLength.total`.
    """
    wanted = np.asarray(tolerances, dtype=np.float64)
    totals: list[Length | None] = [None] * len(parts)
    for same in alike(parts):
        measured = _measured([parts[index] for index in same], wanted[same])
        for index, total in zip(same, measured.totals, strict=True):
            totals[index] = total
    return [length for length in totals if length is not None]


class _MeasuredCurves(NamedTuple):
    """Arcs of curves with their lengths.

    Attributes
    ----------
    arcs : SpeedArcs
    lengths : ndarray, shape (k,)
        Of the arcs, in units of their curve's scale.
    scales : ndarray, shape (curves,)
    totals : list of Length
        Of the curves.
    """

    arcs: SpeedArcs
    lengths: FloatArray
    scales: FloatArray
    totals: list[Length]


def _measured(parts: Sequence[BezierPieces], tolerances: FloatArray) -> _MeasuredCurves:
    """Measure curves whose pieces have one degree and dim."""
    shifts = [min(part.exponent, 1000) for part in parts]
    scales = np.ldexp(1.0, shifts)
    with np.errstate(all="ignore"):
        arcs, errors = refined_arcs(arcs_of(parts, shifts), tolerances / scales)
        lengths = integrals(arcs.slopes, np.zeros(len(errors)), np.ones(len(errors)))
        first = np.searchsorted(arcs.curve, np.arange(len(parts)))
        values = np.add.reduceat(lengths, first)
        bounds = np.add.reduceat(errors + arcs.slack, first) + 16.0 * UNIT_ROUNDOFF * values
        both = np.minimum(np.stack((values, bounds)) * scales, LARGEST)
    return _MeasuredCurves(arcs, lengths, scales, [Length(*pair) for pair in both.T.tolist()])


# Quadrature for the arcs of many curves at once

_GAUSS_POINTS = 16
_ROUNDS = 60
_MOST = 1 << 14  # arcs, or 8 a piece; a curve that needs more gets a larger error bound
_AT_ONCE = 1 << 12  # quadratures, of 16 sets of weights each: a few megabytes
_RHO = np.array([1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 12.0, 24.0, 64.0, 1024.0])


class SpeedArcs(NamedTuple):
    """Stretches of curves, of each in order, with bounds of their lengths.

    Attributes
    ----------
    slopes : ndarray, shape (k, d, dim)
        Bezier control points of dc/ds, s in [0, 1] on the stretch.
    start, end : ndarray, shape (k,)
        In t.
    slack : ndarray, shape (k,)
        What the length may be off because `slopes` is.
    curve : ndarray of int, shape (k,)
        Which curve each belongs to; ascending.
    """

    slopes: FloatArray
    start: FloatArray
    end: FloatArray
    slack: FloatArray
    curve: IntArray

    def selected(self, rows: BoolArray | IntArray) -> SpeedArcs:
        """Return some of the arcs."""
        return SpeedArcs._make(column[rows] for column in self)


def arcs_of(parts: Sequence[BezierPieces], shifts: Sequence[int]) -> SpeedArcs:
    """Return the pieces of curves as arcs, those of curve i in units of 2**shifts[i].

    All have one degree and dim.
    """
    counts = [len(part.starts) for part in parts]
    up = np.repeat([part.exponent - shift for part, shift in zip(parts, shifts, strict=True)], counts)
    slopes = np.concatenate([part.slopes for part in parts])
    error = np.concatenate([part.error for part in parts])
    slope_error = np.concatenate([part.slope_error for part in parts])
    return SpeedArcs(
        np.ldexp(slopes, up[:, None, None]),
        np.concatenate([part.starts for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.ldexp(_slack(slopes, error, slope_error), up),
        np.repeat(np.arange(len(parts)), counts),
    )


def _slack(slopes: FloatArray, error: FloatArray, slope_error: FloatArray) -> FloatArray:
    """Return bounds of the errors of lengths, (k,), due to errors of the pieces, in their units.

    An error e of c makes |c' + e'| - |c'| of the speed: at most |e'|, and between T . e' and that plus
    |e'|**2 / (2 |c'|), with the tangent T. The integral of T . e' is, by parts, at most |e| times the angle
    by which the piece turns; what is left at its ends goes with its neighbours', where the curve has no
    corner, and is 0 at the ends of the curve and of exact pieces. The control polygon turns as far, at least.
    """
    fast = slopes / np.maximum(np.linalg.norm(slopes, axis=2, keepdims=True), SMALLEST)
    ahead = fast.sum(axis=1)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    slowest = (slopes @ ahead[:, :, None]).min(axis=(1, 2))
    # Chords of the unit circle, pi / 2 times at most as long in angles.
    turn = 0.5 * np.pi * np.linalg.norm(np.diff(fast, axis=1), axis=2).sum(axis=1)
    smooth = error * (turn + 4.0 * UNIT_ROUNDOFF) + 0.5 * slope_error**2 / slowest
    return np.where(slowest > slope_error, np.minimum(smooth, slope_error), slope_error)


def refined_arcs(arcs: SpeedArcs, tolerances: FloatArray) -> tuple[SpeedArcs, FloatArray]:
    """Halve arcs until the lengths of all curves are accurate; return them in order with their error bounds.

    Each curve has its own tolerance, in its own units, and its own limit of how many arcs it may be cut into.
    """
    curves = len(tolerances)
    done: list[SpeedArcs] = []
    errors: list[FloatArray] = []
    arcs_of_curve = np.bincount(arcs.curve, minlength=curves)
    after = np.cumsum(arcs_of_curve)
    span = (arcs.end[after - 1] - arcs.start[after - arcs_of_curve])[arcs.curve]
    share = (0.5 * tolerances / arcs_of_curve)[arcs.curve]
    count, most = np.zeros(curves, dtype=np.intp), np.maximum(_MOST, 8 * arcs_of_curve)
    for step in range(_ROUNDS):
        bound, polygon = _bounds(arcs.slopes)
        # Both halves of an arc together get what it had: the shares of all add up to the tolerance.
        fine = (bound <= share) | (bound <= 2.0 * UNIT_ROUNDOFF * polygon)
        fine |= arcs.end - arcs.start <= 4.0 * UNIT_ROUNDOFF * span
        count += np.bincount(arcs.curve[fine], minlength=curves)
        wanted = count + 2 * np.bincount(arcs.curve[~fine], minlength=curves)
        fine |= (wanted > most)[arcs.curve] | (step == _ROUNDS - 1)
        done.append(arcs.selected(fine))
        errors.append(bound[fine])
        if fine.all():
            break
        arcs, span = _halved(arcs.selected(~fine)), np.tile(span[~fine], 2)
        share = np.tile(0.5 * share[~fine], 2)
    together = SpeedArcs(*(np.concatenate(column) for column in zip(*done, strict=True)))
    order = np.lexsort((together.start, together.curve))
    return together.selected(order), np.concatenate(errors)[order]


def _halved(arcs: SpeedArcs) -> SpeedArcs:
    left, right = halves(0.5 * arcs.slopes)
    middle = 0.5 * arcs.start + 0.5 * arcs.end
    return SpeedArcs(
        np.concatenate([left, right]),
        np.concatenate([arcs.start, middle]),
        np.concatenate([middle, arcs.end]),
        np.tile(0.5 * arcs.slack, 2),
        np.tile(arcs.curve, 2),
    )


def _bounds(slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bounds of the errors of the quadrature, and the control polygons' lengths."""
    polygon = np.linalg.norm(slopes, axis=2).mean(axis=1)
    chord = np.linalg.norm(slopes.mean(axis=1), axis=1)
    rough = np.maximum(polygon - chord, 0.0)
    degree = slopes.shape[1] - 1
    evaluation, transform = _square_matrices(degree)
    q = np.square(evaluation @ slopes).sum(axis=2)
    coefficients = np.abs(q @ transform.T)
    k = np.arange(1, len(transform))
    growth = 0.5 * (_RHO[:, None] ** k + _RHO[:, None] ** -k)
    rest = coefficients[:, 1:] @ growth.T
    free = rest < coefficients[:, :1]
    largest = np.sqrt(coefficients[:, :1] + rest)
    factor = 64.0 * _RHO ** (-2.0 * _GAUSS_POINTS) / (15.0 * (1.0 - _RHO**-2.0))
    # Half, because s runs over an interval of length 1.
    proved = np.where(free, 0.5 * largest * factor, np.inf).min(axis=1)
    return np.minimum(proved, rough), polygon


def integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the lengths between parameters of arcs, shape (k,)."""
    some = [slice(first, first + _AT_ONCE) for first in range(0, max(len(slopes), 1), _AT_ONCE)]
    return np.concatenate([_some_integrals(slopes[rows], start[rows], end[rows]) for rows in some])


def _some_integrals(slopes: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    nodes, gauss = _gauss()
    length = end - start
    s = start[:, None] + length[:, None] * nodes
    degree = slopes.shape[1] - 1
    bernstein = weights(s.ravel(), degree).reshape(*s.shape, degree + 1)
    speeds = np.linalg.norm(bernstein @ slopes, axis=2)
    return np.asarray(length * (speeds @ gauss))


def share_at_length(slopes: FloatArray, wanted: FloatArray, whole: FloatArray) -> FloatArray:
    """Return the shares of arcs at which they have the wanted lengths, by Newton's method within brackets."""
    low, high = np.zeros(len(wanted)), np.ones(len(wanted))
    share = np.clip(np.nan_to_num(wanted / whole), 0.0, 1.0)
    for _ in range(_ROUNDS):
        excess = integrals(slopes, np.zeros(len(share)), share) - wanted
        high, low = np.where(excess >= 0.0, share, high), np.where(excess <= 0.0, share, low)
        degree = slopes.shape[1] - 1
        fast = np.linalg.norm(np.einsum("kb,kbd->kd", weights(share, degree), slopes), axis=1)
        step = share - excess / fast
        inside = (step >= low) & (step <= high)
        following = np.where(inside, step, 0.5 * (low + high))
        moved = np.abs(following - share).max(initial=0.0)
        share = following
        if moved <= 4.0 * UNIT_ROUNDOFF:
            break
    return share


@cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    nodes, gauss = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    return read_only(0.5 * (nodes + 1.0)), read_only(0.5 * gauss)


@cache
def _square_matrices(degree: int) -> tuple[FloatArray, FloatArray]:
    """Return matrices to values at Chebyshev points, and from values of a square to coefficients."""
    n = max(2 * degree, 1)
    return read_only(weights(chebyshev(n + 1), degree)), to_chebyshev(n)
