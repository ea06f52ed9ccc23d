"""Hermite functions of any width as forms: homogeneous polynomials in s and r = 1 - s.

Of R data at each end, the function of the k-th derivative at the left end is

    f_k(s, r) = 1 / k! sum over j < R - k of C(2 R - 1 - k, j) s**(k + j) r**(2 R - 1 - k - j),

with r + s = 1: all coefficients are positive. They and those of the derivatives are integers over k!, and
are found here, so that no table of them is written down. A form of whose coefficients some are negative
may vanish within the segment; it is evaluated in double-double arithmetic from the exact distances, as
`hermite_basis` says.

References
----------
.. [1] G. Farin, "Curves and Surfaces for CAGD", 5th ed., Morgan Kaufmann
   2002, sections 7.5 and 7.6: cubic and quintic Hermite interpolation.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import add, multiply, times
from curvecore.arrays import FloatArray
from curvecore.families.hermite_basis import LeftFunctions, LocalCoordinates


class Form(NamedTuple):
    """A homogeneous polynomial scale / divisor * s**a r**b * (c_0 r**m + c_1 r**(m - 1) s + ... + c_m s**m).

    Attributes
    ----------
    scale, divisor : int
        The coefficients of the sum have no factor in common.
    of_s, of_r : int
        The powers a and b.
    coefficients : tuple of int
        c_0, ..., c_m, of which the first and the last are not 0.
    """

    scale: int
    divisor: int
    of_s: int
    of_r: int
    coefficients: tuple[int, ...]

    @classmethod
    def of(cls, coefficients: tuple[int, ...], divisor: int) -> Form:
        """Return the form of these coefficients of r**m, r**(m - 1) s, ... over a divisor."""
        first = next(k for k, value in enumerate(coefficients) if value)
        last = next(k for k, value in enumerate(reversed(coefficients)) if value)
        inner = coefficients[first : len(coefficients) - last]
        common = math.gcd(*inner)
        return cls(common, divisor, first, last, tuple(value // common for value in inner))

    def __call__(self, at: LocalCoordinates) -> FloatArray:
        """Return the values at places of segments, (m,)."""
        values = self._sum(at) * (self.scale / self.divisor)
        for factor, times_ in ((at.s, self.of_s), (at.r, self.of_r)):
            for _ in range(times_):
                values = values * factor
        return values

    def _sum(self, at: LocalCoordinates) -> FloatArray:
        first, *others = self.coefficients
        plain: FloatArray = np.full_like(at.s, first)
        power = at.s
        for coefficient in others:
            plain = plain * at.r + coefficient * power
            power = power * at.s
        has_one_sign = min(self.coefficients) > 0 or max(self.coefficients) < 0
        if has_one_sign or at.from_left is None or at.from_right is None:
            return plain
        s = at.from_left
        exact = add(times(at.from_right, first), times(s, others[0]))
        for coefficient in others[1:]:
            s = multiply(s, at.from_left)
            exact = add(multiply(exact, at.from_right), times(s, coefficient))
        result = exact.high
        for _ in others:
            result = result / at.length
        # Far outside, splitting overflows, and nothing cancels.
        finite = np.isfinite(result)
        return result if finite.all() else np.where(finite, result, plain)


@cache
def hermite_form(width: int, k: int, order: int) -> tuple[int, ...]:
    """Return the coefficients of r**d, r**(d - 1) s, ..., s**d of a function's derivative by s, r = 1 - s.

    They are integers: those of the functions of the i-th derivatives at an end are multiplied by i!. Of the
    2 R functions, R = `width`, those of the left end come first.
    """
    if order:
        before = hermite_form(width, k, order - 1)
        degree = len(before) - 1
        return tuple((j + 1) * before[j + 1] - (degree - j) * before[j] for j in range(degree))
    of_end = k % width
    top = 2 * width - 1 - of_end
    left = [0] * of_end + [math.comb(top, j) for j in range(width - of_end)] + [0] * width
    return tuple(left) if k < width else tuple((-1) ** of_end * value for value in reversed(left))


def left_functions(width: int) -> tuple[LeftFunctions, ...]:
    """Return the functions of the left end and their derivatives by s, of which there are 2 R, for R data."""
    return tuple(_Functions(width, order) for order in range(2 * width))


class _Functions:
    """The order-th derivatives of all functions of the left end."""

    def __init__(self, width: int, order: int) -> None:
        self._forms = [Form.of(hermite_form(width, k, order), math.factorial(k)) for k in range(width)]

    def __call__(self, at: LocalCoordinates) -> tuple[FloatArray, ...]:
        """Return the values of f_0, ..., f_(R-1) at places of segments."""
        return tuple(form(at) for form in self._forms)


class EndWeights(NamedTuple):
    """A derivative at an end of a segment of length 1 as a sum of data.

    Attributes
    ----------
    near, far : tuple of float, R numbers
        Weights of the data at this end, and of those at the other one.
    """

    near: tuple[float, ...]
    far: tuple[float, ...]


@cache
def end_weights(width: int, order: int) -> EndWeights:
    """Return the weights of the order-th derivative by s at s = 0."""
    at_start = [hermite_form(width, k, order)[0] / math.factorial(k % width) for k in range(2 * width)]
    return EndWeights(tuple(at_start[:width]), tuple(at_start[width:]))
