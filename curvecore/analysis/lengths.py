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

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.quadrature import SpeedArcs, arcs_of, integrals, made_accurate, places_of
from curvecore.arithmetic import LARGEST, UNIT_ROUNDOFF
from curvecore.arrays import FloatArray, finite_number, integer, parameter_values, tolerance_value
from curvecore.bezier.pieces import BezierPieces, alike, bezier_pieces, size_of
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.immutable import Immutable


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
            place = np.clip((at.values - start) / (end - start), 0.0, 1.0)
            part = integrals(self._arcs.slopes[arc], np.zeros(len(arc)), place)
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
            place = places_of(self._arcs.slopes[arc], wanted - self._at[arc], np.diff(self._at)[arc])
            start, end = self._arcs.start[arc], self._arcs.end[arc]
            result = np.minimum(start + place * (end - start), end)
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
    found: list[Length | None] = [None] * len(parts)
    for same in alike(parts):
        measured = _measured([parts[index] for index in same], wanted[same])
        for index, total in zip(same, measured.totals, strict=True):
            found[index] = total
    return [each for each in found if each is not None]


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
        arcs, errors = made_accurate(arcs_of(parts, shifts), tolerances / scales)
        lengths = integrals(arcs.slopes, np.zeros(len(errors)), np.ones(len(errors)))
        first = np.searchsorted(arcs.curve, np.arange(len(parts)))
        values = np.add.reduceat(lengths, first)
        bounds = np.add.reduceat(errors + arcs.slack, first) + 16.0 * UNIT_ROUNDOFF * values
        both = np.minimum(np.stack((values, bounds)) * scales, LARGEST)
    return _MeasuredCurves(arcs, lengths, scales, [Length(*pair) for pair in both.T.tolist()])
