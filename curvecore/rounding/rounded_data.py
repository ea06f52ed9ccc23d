"""Data rounded to decimal digits, and the arithmetic that keeps so many.

A double is taken as the shortest decimal that stands for it, as printed.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_HALF_EVEN, Context, Decimal

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, integer, number_array, parameter_row
from curvecore.errors import CurveError

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
    places = integer(decimals, "decimals", 0)
    array = number_array(values, "values")
    unit = Decimal(1).scaleb(-places)
    context = Context(prec=400 + places, rounding=ROUND_HALF_EVEN)
    return _each(array, lambda value: value.quantize(unit, context=context))


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
    return _each(number_array(values, "values"), context.plus)


def _each(values: FloatArray, rounded: Callable[[Decimal], Decimal]) -> FloatArray:
    """Round numbers, which must be finite, as the shortest decimals that stand for them."""
    flat = parameter_row(values.ravel())
    return np.array([float(rounded(Decimal(repr(x)))) for x in flat.tolist()]).reshape(values.shape)
