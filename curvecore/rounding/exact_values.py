"""Curves without rounding, and the digits of computed ones that are wrong."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, integer, number_array, parameter_row
from curvecore.errors import CurveError
from curvecore.rounding.data import Data
from curvecore.rounding.exact import interpolated, lagrange_ratio
from curvecore.rounding.rounded_data import digit_count


def exact_values(
    points: ArrayLike,
    parameters: ArrayLike,
    t: ArrayLike,
    velocities: ArrayLike | None = None,
    accelerations: ArrayLike | None = None,
    jerks: ArrayLike | None = None,
) -> FloatArray:
    """Return the curve computed in fractions, each coordinate rounded once.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        Strictly increasing.
    t : float or array_like, shape (m,)
        Any finite values; a scalar counts as m = 1.
    velocities, accelerations, jerks : array_like, shape (n, dim), optional
        Velocities make it the cubic Hermite curve, accelerations with them the quintic one, all three the
        septic one.

    Returns
    -------
    ndarray, shape (m, dim)
        The doubles nearest to the exact values.

    See Also
    --------
    evaluate_rounded : The same with few digits.
    exact_decimals : The same with more digits than a double has.

    Notes
    -----
    The polynomial's exact coefficients have some 50 n**2 bits for parameters
    of full precision, hence about n**4 operations: 10 ms for 12 points and
    200 parameters, 0.1 s for 20.

    Examples
    --------
    >>> from curvecore import exact_values
    >>> exact_values([[0.0], [1.0], [4.0]], [0, 1, 2], [0.5, 3]).tolist()
    [[0.25], [9.0]]
    """
    data = Data.of(points, parameters, velocities, accelerations, jerks)
    where = parameter_row(t)
    segments = data.segments(where)
    result = np.empty((len(where), data.jets.shape[2]))
    for segment in sorted(set(segments.tolist())):
        chosen = segments == segment
        places, jets = data.stretch(segment)
        for axis, values in enumerate(jets.transpose(2, 0, 1).tolist()):
            polynomial = interpolated(places.tolist(), values)
            result[chosen, axis] = [polynomial.value(x) for x in where[chosen].tolist()]
    return result


def exact_decimals(
    points: ArrayLike, parameters: ArrayLike, t: float, digits: int, *derivatives: ArrayLike
) -> list[Decimal]:
    """Return one point of the curve with so many correct digits.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        Strictly increasing.
    t : float
        Finite.
    digits : int
        At least 1: significant digits of each coordinate.
    *derivatives : array_like, shape (n, dim), up to three
        Velocities make it the cubic Hermite curve, accelerations with them the quintic one, jerks with both
        the septic one.

    Returns
    -------
    list of Decimal, dim
        The exact values for the data as doubles, rounded once, half to even.

    See Also
    --------
    exact_values : The nearest doubles, at many t.
    rounded_decimals : The digits of a computation.

    Examples
    --------
    >>> from curvecore import exact_decimals
    >>> print(*exact_decimals([[0.0], [1.0], [4.0]], [0, 1, 3], 0.5, 20))
    0.45833333333333333333
    """
    data = Data.of(points, parameters, *derivatives, *[None] * (3 - len(derivatives)))
    (where,) = at = parameter_row(t)
    places, jets = data.stretch(int(data.segments(at)[0]))
    context = Context(prec=integer(digits, "digits", 1), rounding=ROUND_HALF_EVEN)
    result = []
    for values in jets.transpose(2, 0, 1).tolist():
        if len(values[0]) == 1:
            ratio = lagrange_ratio(places.tolist(), [value for (value,) in values], float(where))
        else:
            ratio = interpolated(places.tolist(), values).ratio(float(where))
        result.append(context.divide(*map(Decimal, ratio)))
    return result


def digits_lost(computed: ArrayLike, exact: ArrayLike, digits: int, scale: float | None = None) -> FloatArray:
    """Return how many of the k digits are wrong.

    Parameters
    ----------
    computed, exact : array_like, shape (m, dim)
        From `evaluate_rounded` and `exact_values`.
    digits : int
        k of the computation.
    scale : float, optional
        The size that digits are counted from, above 0; by default the largest
        absolute coordinate of `exact`.

    Returns
    -------
    ndarray, shape (m,)
        log10 of the largest error of a coordinate over 1/2 10**(1-k) scale,
        the rounding of a number of that size; from 0 (as good as can be) to k
        (nothing is right, or not a number).

    See Also
    --------
    evaluate_rounded, exact_values : What it compares.

    Examples
    --------
    >>> from curvecore import digits_lost
    >>> digits_lost([[1.2], [1.5]], [[1.2], [1.25]], 2, scale=1.0).round(3).tolist()
    [0.0, 0.699]
    """
    k = digit_count(digits)
    found, truth = number_array(computed, "computed"), _finite_rows(exact)
    if found.shape != truth.shape:
        raise CurveError(f"computed and exact must have the same shape, not {found.shape} and {truth.shape}")
    size = float(np.abs(truth).max(initial=0.0)) if scale is None else float(scale)
    with np.errstate(all="ignore"):
        error = np.abs(found - truth).max(axis=1)
        lost = np.log10(error / (0.5 * 10.0 ** (1 - k) * size))
    lost = np.where(error == 0.0, 0.0, np.nan_to_num(lost, nan=float(k)))
    return np.clip(lost, 0.0, float(k))


def _finite_rows(values: ArrayLike) -> FloatArray:
    """Check an array of shape (m, dim) of finite numbers, m from 0 on."""
    array = number_array(values, "exact")
    if array.ndim != 2 or not np.isfinite(array).all():
        raise CurveError("exact must have the shape (m, dim) and finite values")
    return array
