"""Condition numbers of the systems that monomials need.

The condition number is the norm of the matrix times the norm of its inverse.
Computed from the rounded matrix it stops at about 1e16, where it becomes
noise; here the inverse is exact, column by column the coefficients of the
basis functions in powers of t, and rounded once.

References
----------
.. [1] W. Gautschi and G. Inglese, "Lower bounds for the condition number of
   Vandermonde matrices", Numerische Mathematik 52 (1988) 241-250: it grows
   exponentially for any real nodes.
.. [2] W. Gautschi, "On inverses of Vandermonde and confluent Vandermonde
   matrices", Numerische Mathematik 4 (1962) 117-123.
.. [3] N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd
   ed., SIAM 2002, chapter 22.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray, integer, parameter_array
from curvecore.errors import CurveError
from curvecore.families.curve import ParametricCurve
from curvecore.rounding.exact import as_float, interpolated, scaled_integers

_MOST = 128  # rows of a matrix that is inverted exactly


def vandermonde_condition(parameters: ArrayLike, norm: float = 2, derivatives: int = 0) -> float:
    """Return the condition number of the system for the coefficients of t**k.

    Parameters
    ----------
    parameters : array_like, shape (n,)
        Strictly increasing, n >= 2.
    norm : {1, 2, inf}, optional
        Which norm.
    derivatives : int, optional
        With 0, the Vandermonde matrix t_i**k. Otherwise the confluent matrix
        of one polynomial with that many derivatives given at every t_i:
        n (derivatives + 1) rows, the derivatives' ones unscaled, ordered by
        parameter.

    Returns
    -------
    float
        Correct to about 1e-14 relatively, however large; limited to the
        largest finite number.

    Raises
    ------
    CurveError
        If the parameters are unusable, the norm is another one, or the matrix
        has more than 128 rows.

    See Also
    --------
    segment_conditions : Of pieces.
    monomial_condition : Of a curve.

    Examples
    --------
    >>> from curvecore import uniform, vandermonde_condition
    >>> [f"{vandermonde_condition(uniform(n)):.3g}" for n in (5, 10, 20)]
    ['686', '1.52e+07', '1.14e+16']
    """
    t = parameter_array(parameters, max(np.size(parameters), 2))
    width = integer(derivatives, "derivatives", 0) + 1
    if norm not in (1, 2, math.inf):
        raise CurveError(f"norm must be 1, 2 or infinity, not {norm!r}")
    if len(t) * width > _MOST:
        raise CurveError(f"the matrix must have at most {_MOST} rows, not {len(t) * width}")
    matrix, inverse = _matrix(t.tolist(), width), _inverse(t.tolist(), width)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        result = _norm(matrix, norm) * _norm(inverse, norm)
    return float(min(result, LARGEST))


def segment_conditions(parameters: ArrayLike, derivatives: int, norm: float = 2) -> FloatArray:
    """Return the condition numbers of the small systems of a piecewise Hermite curve.

    Parameters
    ----------
    parameters : array_like, shape (n,)
        Strictly increasing, n >= 2.
    derivatives : int
        1 for cubic, 2 for quintic pieces.
    norm : {1, 2, inf}, optional
        Which norm.

    Returns
    -------
    ndarray, shape (n - 1,)
        Of the confluent matrix in powers of t (not of the local s) of each
        segment: moving the t axis away from 0 changes them.

    See Also
    --------
    vandermonde_condition : Of one polynomial.
    monomial_condition : Of a curve.

    Examples
    --------
    >>> from curvecore import segment_conditions
    >>> segment_conditions([0, 1, 3], 1).round(3).tolist()
    [23.782, 257.675]
    """
    t = parameter_array(parameters, max(np.size(parameters), 2)).tolist()
    return np.array([vandermonde_condition(pair, norm, derivatives) for pair in pairwise(t)])


def monomial_condition(curve: ParametricCurve, norm: float = 2) -> float:
    """Return the condition number of the worst system that a curve in powers of t needs.

    Parameters
    ----------
    curve : ParametricCurve
        Of polynomials whose data are known.
    norm : {1, 2, inf}, optional
        Which norm.

    Returns
    -------
    float
        The largest `vandermonde_condition` of any of its polynomial pieces.

    Raises
    ------
    CurveError
        If the curve is of another kind, or has a piece with more than 128 data.

    See Also
    --------
    vandermonde_condition, segment_conditions : Of parameters alone.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, monomial_condition, uniform
    >>> curve = LagrangeCurve([[k, 0] for k in range(9)], uniform(9))
    >>> f"{monomial_condition(curve):.3g}"
    '2.01e+06'
    """
    interpolants = curve.interpolants()
    if interpolants is None:
        raise CurveError("curve must consist of polynomials whose data are known")
    return max(vandermonde_condition(part.parameters, norm, part.jets.shape[1] - 1) for part in interpolants)


def _matrix(t: Sequence[float], width: int) -> FloatArray:
    size = len(t) * width
    column = np.array(t)[:, None]
    rows = []
    with np.errstate(over="ignore", under="ignore"):
        for order in range(width):
            factor = np.array([math.perm(k, order) for k in range(size)], dtype=np.float64)
            power = np.maximum(np.arange(size) - order, 0)
            rows.append(factor * column**power)
    return np.stack(rows, axis=1).reshape(size, size)


def _inverse(t: Sequence[float], width: int) -> FloatArray:
    """Return the exact inverse, rounded: the coefficients of the basis functions in columns."""
    if width == 1:
        return _simple_inverse(t)
    size = len(t) * width
    unit_data = np.eye(size).reshape(size, len(t), width).tolist()
    columns = [interpolated(t, jets) for jets in unit_data]
    return np.array([[as_float(x, poly.denominator) for x in poly.coefficients] for poly in columns]).T


def _simple_inverse(t: Sequence[float]) -> FloatArray:
    """Return the coefficients of the L_i in columns.

    With t_i = k_i / b for integers k_i, the product of all (x - k_j) is
    divided by one factor at a time: O(n**2) operations on integers.
    """
    nodes, b = scaled_integers(t)
    n = len(nodes)
    master = [1]
    for node in nodes:
        master = [low - node * high for low, high in zip([0, *master], [*master, 0], strict=True)]
    result = np.empty((n, n))
    for i, node in enumerate(nodes):
        below = math.prod(node - other for j, other in enumerate(nodes) if j != i)
        coefficient, power = 0, 1
        # The coefficient of t**k is that of x**k times b**k.
        powers = [power := 1] + [power := power * b for _ in range(n - 1)]
        for k in range(n - 1, -1, -1):
            coefficient = master[k + 1] + node * coefficient
            result[k, i] = as_float(coefficient * powers[k], below)
    return result


def _norm(matrix: FloatArray, norm: float) -> float:
    largest = float(np.abs(matrix).max())
    if not np.isfinite(matrix).all():
        return LARGEST
    scaled = matrix / largest
    if norm == 2:
        return largest * float(np.linalg.norm(scaled, 2))
    sums = np.abs(scaled).sum(axis=0 if norm == 1 else 1)
    return largest * float(sums.max())
