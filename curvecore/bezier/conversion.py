"""Exact Bezier control points: of any stretch of any curve, of any degree.

A polynomial of degree n - 1 through n points has n Bezier control points. In
theory that is a change of basis; in practice the control points of many
uniformly spaced points are astronomically far away, and the condition number
says how far. The conversion itself is done in integers and rounds once.

References
----------
.. [1] R. T. Farouki, "The Bernstein polynomial basis: a centennial
   retrospective", Computer Aided Geometric Design 29 (2012) 379-419, sections
   3.3 (degree elevation) and 5 (conditioning).
.. [2] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 4.6 (subdivision) and 6.1 (degree elevation).
.. [3] A. Marco and J.-J. Martinez, "A fast and accurate algorithm for solving
   Bernstein-Vandermonde linear systems", Linear Algebra and its Applications
   422 (2007) 616-628: the matrix of this conversion.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, data_array, finite_number, integer
from curvecore.bezier.bernstein import elevated
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant
from curvecore.rounding.exact import CommonPolynomial, as_float, interpolated, scaled_integers

MOST = 64
"""Points of the longest polynomial that is converted; the work grows with the fourth power."""


class LagrangeBezier(NamedTuple):
    """One polynomial through n points in Bezier form.

    Attributes
    ----------
    control_points : ndarray, shape (n, dim)
        Over the whole domain.
    condition : float
        By how much an error of the points may grow in the control points:
        the largest row sum of the conversion matrix, max_k sum_i |A_ki|. It is
        the condition number in the maximum norm, since the inverse matrix,
        b_k(t_i), has row sums 1.

    See Also
    --------
    lagrange_to_bezier : The function that returns it.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, lagrange_to_bezier
    >>> form = lagrange_to_bezier(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]))
    >>> form.control_points.tolist(), round(form.condition, 9)
    ([[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]], 3.0)
    """

    control_points: FloatArray
    condition: float


def elevate_degree(control_points: ArrayLike, by: int = 1) -> FloatArray:
    """Return the control points of the same Bezier curve as one of higher degree.

    Parameters
    ----------
    control_points : array_like, shape (d + 1, dim)
        d >= 1.
    by : int, optional
        How many degrees more, at least 0.

    Returns
    -------
    ndarray, shape (d + 1 + by, dim)
        Convex combinations of the given ones, so rounding does not grow.

    Raises
    ------
    CurveError
        If the control points are unusable or `by` is negative.

    See Also
    --------
    bezier_segments : Control points of a curve.

    Examples
    --------
    >>> from curvecore import elevate_degree
    >>> elevate_degree([[0, 0], [1, 2], [2, 0]]).round(9).tolist()
    [[0.0, 0.0], [0.666666667, 1.333333333], [1.333333333, 1.333333333], [2.0, 0.0]]
    """
    controls = data_array(control_points, "control_points")
    with np.errstate(under="ignore"):
        return np.asarray(elevated(controls[None], integer(by, "by", 0))[0])


def lagrange_to_bezier(curve: ParametricCurve) -> LagrangeBezier:
    """Return the Bezier form of an interpolating polynomial.

    Parameters
    ----------
    curve : LagrangeCurve
        Of at most 64 points.

    Returns
    -------
    LagrangeBezier
        Each coordinate is the exact one, rounded once; limited to the
        largest finite number. Using them is another matter: evaluation from
        them errs by about u times their size, that is u times the condition.

    Raises
    ------
    CurveError
        For another family or too many points.

    See Also
    --------
    LagrangeBezier : What it returns.
    bezier_stretch : Of a part.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, lagrange_to_bezier
    >>> lagrange_to_bezier(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])).control_points.tolist()
    [[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]]
    """
    interpolants = curve.interpolants()
    if interpolants is None or len(interpolants) > 1 or curve.jets.shape[1] > 1:
        raise CurveError("curve must be a LagrangeCurve; bezier_segments converts the Hermite families")
    controls = bezier_stretch(curve, *curve.domain)
    return LagrangeBezier(controls, _condition(curve.parameters))


def bezier_stretch(curve: ParametricCurve, start: float, end: float) -> FloatArray:
    """Return the Bezier control points of a stretch of a curve.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family and dim; a `LagrangeCurve` of at most 64 points.
    start, end : float
        Parameters inside the domain, start < end, with no joint of a Hermite
        curve or chain strictly between them.

    Returns
    -------
    ndarray, shape (degree + 1, dim)
        The exact ones, rounded once. (`bezier_segments` is the fast way to
        all segments.)

    Raises
    ------
    CurveError
        If the stretch is no single polynomial, or leaves the domain.

    See Also
    --------
    bezier_segments : All segments at once.
    power_coefficients : By powers of s.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, bezier_stretch
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> bezier_stretch(curve, 0, 1).tolist()
    [[0.0, 0.0], [0.0, 2.0], [1.0, 2.0]]
    """
    return _columns([_bernstein(powers) for powers in _powers(curve, start, end, MOST)])


def power_coefficients(curve: ParametricCurve, start: float, end: float) -> FloatArray:
    """Return the coefficients of a stretch of a curve by powers of s = (t - start) / (end - start).

    Parameters
    ----------
    curve : ParametricCurve
        Of polynomials whose data are known, of any number of points.
    start, end : float
        Parameters inside the domain, start < end, with no joint of a Hermite
        curve or chain strictly between them.

    Returns
    -------
    ndarray, shape (degree + 1, dim)
        Lowest power first; the exact ones, rounded once, limited to the largest finite number.

    Raises
    ------
    CurveError
        If the stretch is no single polynomial, or leaves the domain.

    See Also
    --------
    bezier_stretch : The same polynomial in Bezier form.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, power_coefficients
    >>> power_coefficients(LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2]), 0, 2).tolist()
    [[0.0, 0.0], [0.0, 8.0], [4.0, -8.0]]
    """
    return _columns(_powers(curve, start, end))


def _columns(exact: list[list[Fraction]]) -> FloatArray:
    """Return exact numbers, an axis a list, as columns of floats."""
    rounded = [[as_float(value.numerator, value.denominator) for value in column] for column in exact]
    return np.array(rounded).T.copy()


def _powers(curve: ParametricCurve, start: float, end: float, most: float = math.inf) -> list[list[Fraction]]:
    """Return the exact coefficients of each axis by powers of s; refuse more points than `most`."""
    low, high = finite_number(start, "start"), finite_number(end, "end")
    first, last = curve.domain
    if not first <= low < high <= last:
        raise CurveError(f"start and end must ascend inside the domain, from {first} to {last}")
    parameters, jets = _interpolant_over(curve, low, high)
    if len(parameters) > most:
        raise CurveError(f"curve must have at most {most} points to be converted, not {len(parameters)}")
    return [
        _shifted(interpolated(parameters.tolist(), jets[:, :, axis].tolist()), low, high)
        for axis in range(jets.shape[2])
    ]


def _interpolant_over(curve: ParametricCurve, low: float, high: float) -> Interpolant:
    interpolants = curve.interpolants()
    if interpolants is None:
        raise CurveError("curve must consist of polynomials whose data are known to be converted exactly")
    ends = np.array([piece.parameters[-1] for piece in interpolants[:-1]])
    interpolant = interpolants[int(np.searchsorted(ends, low, side="right"))]
    if high > interpolant.parameters[-1]:
        joint = int(np.searchsorted(curve.parameters, interpolant.parameters[-1]))
        raise CurveError(f"parameters[{joint}] is inside the stretch; no joint must be", (joint,))
    return interpolant


def _shifted(polynomial: CommonPolynomial, low: float, high: float) -> list[Fraction]:
    """Return the coefficients by powers of s on [low, high]."""
    start, length = Fraction(low), Fraction(high) - Fraction(low)
    # Coefficients in powers of s by repeated division by t - start (Taylor shift).
    shifted = [Fraction(value, polynomial.denominator) for value in polynomial.coefficients]
    degree = len(shifted) - 1
    for i in range(degree):
        for k in range(degree - 1, i - 1, -1):
            shifted[k] += start * shifted[k + 1]
    return [value * length**k for k, value in enumerate(shifted)]


def _bernstein(powers: list[Fraction]) -> list[Fraction]:
    """Return the Bernstein coefficients of a polynomial given by powers of s."""
    degree = len(powers) - 1
    scaled = [value / math.comb(degree, k) for k, value in enumerate(powers)]
    return [sum((math.comb(k, j) * scaled[j] for j in range(k + 1)), Fraction(0)) for k in range(degree + 1)]


def _condition(parameters: FloatArray) -> float:
    """Return the largest sum over i of |Bernstein coefficient k of L_i|."""
    nodes, _ = scaled_integers(parameters.tolist())
    first, last = nodes[0], nodes[-1]
    n = len(nodes)
    rows = [Fraction(0)] * n
    for i, node in enumerate(nodes):
        # t - t_j is (last - t_j) s - (t_j - first) r: products stay homogeneous in r and s.
        product, below = [1], 1
        for j, other in enumerate(nodes):
            if j != i:
                a, b = last - other, first - other
                below *= node - other
                product = [
                    (a * product[k - 1] if k else 0) + (b * product[k] if k < len(product) else 0)
                    for k in range(len(product) + 1)
                ]
        for k, value in enumerate(product):
            rows[k] += Fraction(abs(value), abs(below) * math.comb(n - 1, k))
    worst = max(rows)
    return as_float(worst.numerator, worst.denominator)
