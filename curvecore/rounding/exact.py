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
from fractions import Fraction
from typing import NamedTuple

from curvecore.arithmetic import LARGEST


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
        above, below = math.prod(x - each for each in others), math.prod(node - each for each in others)
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
    places = [Fraction(float(parameter)) for parameter in parameters]
    data = [[Fraction(float(value)) for value in jet] for jet in jets]
    differences = newton_coefficients(places, data)
    # In t 2**e, in which the parameters are integers, and over one denominator: fractions would be reduced
    # after every operation.
    integers, scale = scaled_integers([place for place in parameters for _ in jets[0]])
    scaled = [each / scale**order for order, each in enumerate(differences)]
    denominator = math.lcm(*(each.denominator for each in scaled))
    newton = [each.numerator * (denominator // each.denominator) for each in scaled]
    coefficients = newton[-1:]
    for difference, place in zip(reversed(newton[:-1]), reversed(integers[:-1]), strict=True):
        lowered = [place * each for each in coefficients]
        raised = [difference, *coefficients]
        coefficients = [a - b for a, b in zip(raised, [*lowered, 0], strict=True)]
    of_t = [each * scale**order for order, each in enumerate(coefficients)]
    common = math.gcd(denominator, *of_t)
    return CommonPolynomial(tuple(each // common for each in of_t), denominator // common)
