"""Numbers kept as mantissa and power of two, so that products stay in range."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import FloatArray

ExponentArray: TypeAlias = NDArray[np.int64]
LARGEST = float(np.finfo(np.float64).max)
SMALLEST = float(np.finfo(np.float64).tiny)
UNIT_ROUNDOFF = 2.0**-53

LIMIT = 1e300
"""Coordinates of what is drawn are limited to this size, so that their differences stay finite."""


class Scaled(NamedTuple):
    """Numbers ``mantissa * 2**exponent``, both arrays of one shape."""

    mantissa: FloatArray
    exponent: ExponentArray


class ScaledRows(NamedTuple):
    """An array with one power of two for each column.

    Attributes
    ----------
    values : ndarray, shape (n, m)
        Entries of at most moderate size.
    exponent : ndarray of int, shape (m,)
        Column k stands for ``values[:, k] * 2**exponent[k]``.
    """

    values: FloatArray
    exponent: ExponentArray


def normalise(numbers: Scaled) -> ScaledRows:
    """Give each column of scaled numbers, shape (n, m), one common exponent."""
    mantissa, extra = np.frexp(numbers.mantissa)
    exponent = numbers.exponent + extra
    # A zero has no exponent of its own and must not decide the column's.
    common = np.where(mantissa != 0.0, exponent, np.iinfo(np.int64).min // 2).max(axis=0)
    return ScaledRows(scale_by_power(mantissa, exponent - common), common)


def made_finite(values: FloatArray) -> FloatArray:
    """Return `values` itself, with the largest finite number in place of infinities and NaN."""
    if not np.isfinite(values).all():
        np.nan_to_num(values, copy=False, nan=LARGEST)
    return values


def scale_by_power(values: FloatArray, exponent: ExponentArray | int) -> FloatArray:
    """Return ``values * 2**exponent``, limited to the largest finite number.

    A result that no double can hold becomes the largest double of its sign,
    so that drawing code never meets an infinity.
    """
    # numpy's ldexp takes C ints; beyond +-5000 every double over- or underflows anyway.
    with np.errstate(over="ignore", under="ignore"):
        result = np.ldexp(values, np.clip(exponent, -5000, 5000).astype(np.intc))
    return np.clip(result, -LARGEST, LARGEST, out=result)


def scaled_differences(t: FloatArray, parameters: FloatArray, shift: int) -> Scaled:
    """Return (t - t_i) * 2**shift, shape (n, m), where t - t_i may exceed the largest number."""
    with np.errstate(over="ignore"):
        difference = t - parameters[:, None]
    mantissa, size = np.frexp(difference)
    exponent = size.astype(np.int64) + shift
    overflow = np.isinf(difference)
    if overflow.any():
        halved, size = np.frexp(0.5 * t - 0.5 * parameters[:, None])
        mantissa = np.where(overflow, halved, mantissa)
        exponent = np.where(overflow, size.astype(np.int64) + (shift + 1), exponent)
    return Scaled(mantissa, exponent)
