"""Data rounded to decimal digits, and the arithmetic that keeps so many.

A double is taken as the shortest decimal that stands for it, as printed.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_HALF_EVEN, Context, Decimal
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import (
    FloatArray,
    IntArray,
    integer,
    number_array,
    parameter_array,
    parameter_row,
    stacked_jets,
)
from curvecore.errors import CurveError

_NAMES = ("velocities", "accelerations", "jerks")


class Data(NamedTuple):
    """Checked data of a curve.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
    jets : ndarray, shape (n, R, dim)
        R = 1 for one polynomial, 2 and 3 for piecewise Hermite curves.
    """

    parameters: FloatArray
    jets: FloatArray

    @classmethod
    def of(cls, points: ArrayLike, parameters: ArrayLike, *derivatives: ArrayLike | None) -> Self:
        """Return checked data; the derivatives are velocities, accelerations and jerks."""
        given = dict(zip(_NAMES, derivatives, strict=True))
        jets = stacked_jets(points, **{name: values for name, values in given.items() if values is not None})
        for below, above in pairwise(_NAMES):
            if given[below] is None and given[above] is not None:
                raise CurveError(f"{above} need {below} beside them")
        return cls(parameter_array(parameters, len(jets)), jets)

    def rounded(self, digits: int) -> Self:
        """Return data of so many significant digits; raise CurveError where that makes parameters equal."""
        parameters = round_significant(self.parameters, digits)
        equal = np.flatnonzero(np.diff(parameters) <= 0)
        if len(equal):
            first = int(equal[0])
            raise CurveError(f"to {digits} digits parameters[{first}] and parameters[{first + 1}] are equal")
        return type(self)(parameters, round_significant(self.jets, digits))

    def segments(self, t: FloatArray) -> IntArray:
        """Return the polynomial that counts at each t."""
        if self.jets.shape[1] == 1:
            return np.zeros(len(t), dtype=np.intp)
        return np.searchsorted(self.parameters[1:-1], t, side="right")

    def stretch(self, segment: int) -> tuple[FloatArray, FloatArray]:
        """Return the parameters and jets that make a polynomial."""
        if self.jets.shape[1] == 1:
            return self.parameters, self.jets
        return self.parameters[segment : segment + 2], self.jets[segment : segment + 2]


# Rounding

MOST_DIGITS = 16


def digit_count(digits: int) -> int:
    """Check a number of significant digits, from 2 to 16."""
    k = integer(digits, "digits", 2)
    if k > MOST_DIGITS:
        raise CurveError(f"digits must be at most {MOST_DIGITS}, not {k}")
    return k


def decimal_context(digits: int) -> Context:
    """Return an arithmetic of so many digits, half to even."""
    # No traps: a division by zero goes on as Infinity or NaN, like in a floating point unit.
    return Context(prec=digit_count(digits), rounding=ROUND_HALF_EVEN, traps=[])


def round_data(values: ArrayLike, decimals: int) -> FloatArray:
    """Round data to so many digits behind the decimal point, half to even.

    Parameters
    ----------
    values : array_like, any shape
        Finite.
    decimals : int
        At least 0.

    Returns
    -------
    ndarray, same shape
        The doubles nearest to the rounded decimal numbers. The values are
        taken as the shortest decimals that stand for them, as printed: 0.125
        and 2.675 are ties, though the double 2.675 is a little less.
        (`numpy.round` multiplies by a power of ten and may round twice.)

    See Also
    --------
    round_significant : To significant digits.

    Examples
    --------
    >>> from curvecore import round_data
    >>> round_data([2.675, 0.125, -1.5], 2).tolist()
    [2.68, 0.12, -1.5]
    """
    digits = integer(decimals, "decimals", 0)
    array = number_array(values, "values")
    unit = Decimal(1).scaleb(-digits)
    context = Context(prec=400 + digits, rounding=ROUND_HALF_EVEN)
    return _rounded(array, lambda value: value.quantize(unit, context=context))


def round_significant(values: ArrayLike, digits: int) -> FloatArray:
    """Round data to so many significant digits, half to even.

    Parameters
    ----------
    values : array_like, any shape
        Finite.
    digits : int
        From 2 to 16.

    Returns
    -------
    ndarray, same shape
        The doubles nearest to the rounded decimal numbers, the values taken as
        `round_data` takes them.

    See Also
    --------
    round_data : To decimals.

    Examples
    --------
    >>> from curvecore import round_significant
    >>> round_significant([123456.0, 0.00123456], 3).tolist()
    [123000.0, 0.00123]
    """
    context = decimal_context(digits)
    return _rounded(number_array(values, "values"), context.plus)


def _rounded(values: FloatArray, rounded: Callable[[Decimal], Decimal]) -> FloatArray:
    """Round numbers, which must be finite, as the shortest decimals that stand for them."""
    flat = parameter_row(values.ravel())
    return np.array([float(rounded(Decimal(repr(x)))) for x in flat.tolist()]).reshape(values.shape)
