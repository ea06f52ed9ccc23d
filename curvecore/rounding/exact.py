"""Exact polynomials through given data, in integers.

Every double is an integer times a power of two, so that interpolation needs
no rounding: parameters become integers over a common power of two, and only the
last division of an integer by another one rounds, once.

References
----------
.. [1] J. Stoer and R. Bulirsch, "Introduction to Numerical Analysis", 3rd
   ed., Springer 2002, section 2.1.5: divided differences with equal nodes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray, integer, number_array, parameter_row
from curvecore.errors import CurveError
from curvecore.rounding.data import Data, digit_count


class CommonPolynomial(NamedTuple):
    """A polynomial sum a_k t**k / b with integers a_k and b.

    Attributes
    ----------
    coefficients : tuple of int
        a_0, a_1, ...
    denominator : int
        b > 0.
    """

    coefficients: tuple[int, ...]
    denominator: int

    def value(self, t: float) -> float:
        """Return the value at t, rounded once and limited to the largest finite number."""
        return as_float(*self.ratio(t))

    def ratio(self, t: float) -> tuple[int, int]:
        """Return the value at t as a numerator and a denominator above 0."""
        top, bottom = t.as_integer_ratio()
        result, power = self.coefficients[-1], 1
        for coefficient in reversed(self.coefficients[:-1]):
            power *= bottom
            result = result * top + coefficient * power
        return result, self.denominator * power


def scaled_integers(values: Sequence[float]) -> tuple[list[int], int]:
    """Return integers and the least power of two 2**e >= 1 with value = integer / 2**e, and that power."""
    ratios = [float(value).as_integer_ratio() for value in values]
    power = max((bottom for _, bottom in ratios), default=1)
    return [top * (power // bottom) for top, bottom in ratios], power


def lagrange_ratio(parameters: Sequence[float], values: Sequence[float], t: float) -> tuple[int, int]:
    """Return the polynomial through values at one t as a numerator and a denominator, in n**2 products.

    For one t the coefficients of `interpolated` would take n**4 operations.
    """
    (x, *nodes), _ = scaled_integers([t, *parameters])
    total = Fraction(0)
    for i, (node, value) in enumerate(zip(nodes, values, strict=True)):
        others = nodes[:i] + nodes[i + 1 :]
        above, below = math.prod(x - other for other in others), math.prod(node - other for other in others)
        total += Fraction(value) * Fraction(above, below)
    return total.as_integer_ratio()


def as_float(numerator: int, denominator: int) -> float:
    """Return a quotient of integers, correctly rounded, limited to the largest finite number."""
    try:
        return numerator / denominator
    except OverflowError:
        return LARGEST if (numerator > 0) == (denominator > 0) else -LARGEST


def newton_coefficients(parameters: Sequence[Fraction], jets: Sequence[Sequence[Fraction]]) -> list[Fraction]:
    """Return divided differences for parameters with derivatives.

    Parameters
    ----------
    parameters : sequence of Fraction, n
        Distinct.
    jets : sequence of n sequences of Fraction, R each
        Value and derivatives at each parameter.

    Returns
    -------
    list of Fraction, n R
        The coefficients of 1, (t - t_0), (t - t_0)**2, ...: each parameter R times.
    """
    width = len(jets[0])
    repeated = [parameter for parameter in parameters for _ in range(width)]
    of = [jet for jet in jets for _ in range(width)]
    column = [jet[0] for jet in of]
    result = [column[0]]
    for order in range(1, len(repeated)):
        following = []
        for i in range(len(repeated) - order):
            gap = repeated[i + order] - repeated[i]
            equal = of[i][order] / math.factorial(order) if not gap else (column[i + 1] - column[i]) / gap
            following.append(equal)
        column = following
        result.append(column[0])
    return result


def interpolated(parameters: Sequence[float], jets: Sequence[Sequence[float]]) -> CommonPolynomial:
    """Return the polynomial with given values and derivatives at distinct parameters, exactly."""
    nodes = [Fraction(float(parameter)) for parameter in parameters]
    data = [[Fraction(float(value)) for value in jet] for jet in jets]
    differences = newton_coefficients(nodes, data)
    # In t 2**e, in which the parameters are integers, and over one denominator: fractions would be reduced
    # after every operation.
    integers, scale = scaled_integers([node for node in parameters for _ in jets[0]])
    scaled = [value / scale**order for order, value in enumerate(differences)]
    denominator = math.lcm(*(value.denominator for value in scaled))
    newton = [value.numerator * (denominator // value.denominator) for value in scaled]
    coefficients = newton[-1:]
    for difference, node in zip(reversed(newton[:-1]), reversed(integers[:-1]), strict=True):
        lowered = [node * value for value in coefficients]
        raised = [difference, *coefficients]
        coefficients = [a - b for a, b in zip(raised, [*lowered, 0], strict=True)]
    of_t = [value * scale**order for order, value in enumerate(coefficients)]
    common = math.gcd(denominator, *of_t)
    return CommonPolynomial(tuple(value // common for value in of_t), denominator // common)


# Curves without rounding


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
        inside = segments == segment
        nodes, jets = data.stretch(segment)
        for axis, values in enumerate(jets.transpose(2, 0, 1).tolist()):
            polynomial = interpolated(nodes.tolist(), values)
            result[inside, axis] = [polynomial.value(x) for x in where[inside].tolist()]
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
    nodes, jets = data.stretch(int(data.segments(at)[0]))
    context = Context(prec=integer(digits, "digits", 1), rounding=ROUND_HALF_EVEN)
    result = []
    for values in jets.transpose(2, 0, 1).tolist():
        if len(values[0]) == 1:
            ratio = lagrange_ratio(nodes.tolist(), [value for (value,) in values], float(where))
        else:
            ratio = interpolated(nodes.tolist(), values).ratio(float(where))
        result.append(context.divide(*map(Decimal, ratio)))
    return result


def digits_lost(computed: ArrayLike, exact: ArrayLike, digits: int, scale: float | None = None) -> FloatArray:
    """Return the number of the k digits that are wrong.

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
    result, truth = number_array(computed, "computed"), _finite_rows(exact)
    if result.shape != truth.shape:
        raise CurveError(f"computed and exact must have the same shape, not {result.shape} and {truth.shape}")
    size = float(np.abs(truth).max(initial=0.0)) if scale is None else float(scale)
    with np.errstate(all="ignore"):
        error = np.abs(result - truth).max(axis=1)
        lost = np.log10(error / (0.5 * 10.0 ** (1 - k) * size))
    lost = np.where(error == 0.0, 0.0, np.nan_to_num(lost, nan=float(k)))
    return np.clip(lost, 0.0, float(k))


def _finite_rows(values: ArrayLike) -> FloatArray:
    """Check an array of shape (m, dim) of finite numbers, m from 0 on."""
    array = number_array(values, "exact")
    if array.ndim != 2 or not np.isfinite(array).all():
        raise CurveError("exact must have the shape (m, dim) and finite values")
    return array
