"""Arithmetic where plain doubles would overflow or cancel: scaled numbers, vectors, numbers of 106 bits.

- `Scaled` numbers have an exponent of their own, so that products stay in range.
- Lengths and cross products of vectors do not overflow where the results do not.
- `DoubleDouble` numbers are unevaluated sums high + low of two doubles, about 106 bits. Their error-free
  transformations need a round-to-nearest double and no overflow above 2**996; the callers' numbers are scaled
  to lie near 1.

References
----------
.. [1] T. J. Dekker, "A floating-point technique for extending the available
   precision", Numerische Mathematik 18 (1971) 224-242.
.. [2] T. Ogita, S. M. Rump and S. Oishi, "Accurate sum and dot product", SIAM
   J. Sci. Comput. 26 (2005) 1955-1988, algorithms 3.1 to 3.3.
"""

from __future__ import annotations

from functools import reduce
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from curvecore.arrays import FloatArray, IntArray32

# Numbers kept as mantissa and power of two

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


# Vectors


def cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the cross products of plane vectors along the last axis."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def along_last(operation: np.ufunc, values: FloatArray) -> FloatArray:
    """Reduce the last axis entry by entry: where it is short, NumPy would begin a loop for every vector."""
    return reduce(operation, np.moveaxis(values, -1, 0))


def vector_lengths(vectors: FloatArray) -> FloatArray:
    """Return Euclidean lengths along the last axis without needless over- or underflow."""
    largest = along_last(np.maximum, np.abs(vectors))
    divisor = np.where(largest > 0.0, largest, 1.0)
    with np.errstate(over="ignore", under="ignore"):
        shares = (coordinate / divisor for coordinate in np.moveaxis(vectors, -1, 0))
        result = largest * np.sqrt(sum(map(np.square, shares)))
    return np.asarray(np.minimum(result, LARGEST))


# Numbers of 106 bits

_SPLITTER = 134217729.0  # 2**27 + 1
_LOG_2 = 0.6931471805599453, 2.3190468138462996e-17


class DoubleDouble(NamedTuple):
    """The numbers ``high + low``, |low| at most half an ulp of high (or little more)."""

    high: FloatArray
    low: FloatArray


def difference(a: FloatArray, b: FloatArray) -> DoubleDouble:
    """Return a - b without any error."""
    return _two_sum(a, -b)


def halved_difference(a: FloatArray, b: FloatArray) -> tuple[DoubleDouble, IntArray32]:
    """Return a_k - b_i, (n, m), and for each column 1 where they are halved, else 0.

    They are where one exceeds the largest number; a difference of that size loses nothing that counts.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        exact = difference(a, b[:, None])
    halved = np.asarray(np.isinf(exact.high).any(axis=0))
    if halved.any():
        exact.high[:, halved], exact.low[:, halved] = difference(0.5 * a[halved], 0.5 * b[:, None])
    return exact, halved.astype(np.intc)


def add(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return a + b.

    The error is about 2**-104 (|a| + |b|), hence not relative to a sum that
    cancels; that is what the callers' bounds ask for.
    """
    total, rest = _two_sum(a.high, b.high)
    rest += a.low
    rest += b.low
    return _renormalised(total, rest)


def multiply(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return a b with a relative error of about 2**-103."""
    product = a.high * b.high
    rest = _product_error(a.high, b.high, product)
    rest += a.high * b.low
    rest += a.low * b.high
    return _renormalised(product, rest)


def divide(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return a / b with a relative error of about 2**-102; b is not 0."""
    quotient = a.high / b.high
    product = quotient * b.high
    rest = (a.high - product) - _product_error(quotient, b.high, product)
    rest += a.low - quotient * b.low
    return _renormalised(quotient, rest / b.high)


def reciprocal(a: DoubleDouble) -> DoubleDouble:
    """Return 1 / a with a relative error of about 2**-102; a is not 0."""
    return divide(DoubleDouble(np.ones_like(a.high), np.zeros_like(a.high)), a)


def square_root(a: DoubleDouble) -> DoubleDouble:
    """Return the square root of a > 0 with a relative error of about 2**-102."""
    root = np.sqrt(a.high)
    square = root * root
    rest = (a.high - square) - _product_error(root, root, square)
    return _renormalised(root, (rest + a.low) / (2.0 * root))


def exact_lengths(a: DoubleDouble) -> DoubleDouble:
    """Return the lengths of vectors, (m, dim) to (m,), with a relative error of about 2**-100; none is 0."""
    square = a.high * a.high
    total = square[:, 0]
    rest = (_product_error(a.high, a.high, square) + (2.0 * a.high) * a.low).sum(axis=1)
    for axis in range(1, square.shape[1]):
        total, low = _two_sum(total, square[:, axis])
        rest += low
    return square_root(DoubleDouble(total, rest))


def cumulative_sum(a: DoubleDouble) -> DoubleDouble:
    """Return the sums of the first k of n positive numbers, (n,), to n**2 2**-106 of it [2]_."""
    total = np.add.accumulate(a.high)
    rest = a.low.copy()
    rest[1:] += _two_sum(total[:-1], a.high[1:]).low
    return _renormalised(total, np.add.accumulate(rest))


def logarithm(a: DoubleDouble) -> DoubleDouble:
    """Return log a with an absolute error of about 2**-60; a is above 0."""
    _, exponent = np.frexp(a.high / np.sqrt(0.5))
    mantissa = rescaled(a, 1 - exponent)
    one = DoubleDouble(np.ones_like(a.high), np.zeros_like(a.high))
    # log m = 2 artanh z with |z| <= 0.1716, whose first term alone needs all digits.
    z = divide(add(mantissa, DoubleDouble(-one.high, one.low)), add(mantissa, one))
    square, tail = z.high * z.high, np.zeros_like(z.high)
    for k in range(25, 1, -2):
        tail = square * (tail + 2.0 / k)
    whole = multiply(DoubleDouble(exponent - 1.0, one.low), DoubleDouble(*map(np.array, _LOG_2)))
    return add(whole, DoubleDouble(2.0 * z.high, 2.0 * z.low + z.high * tail))


def put_product_error(
    a: FloatArray, b: FloatArray, product: FloatArray, out: FloatArray, room: FloatArray
) -> None:
    """Write a b minus its rounded value `product` into `out`, exactly; `room` holds four such arrays."""
    a_high, a_low, b_high, b_low = room
    for number, high, low in ((a, a_high, a_low), (b, b_high, b_low)):
        np.multiply(number, _SPLITTER, out=high)
        np.subtract(high, number, out=low)
        np.subtract(high, low, out=high)
        np.subtract(number, high, out=low)
    np.multiply(a_high, b_high, out=out)
    out -= product
    a_high *= b_low
    out += a_high
    b_high *= a_low
    out += b_high
    a_low *= b_low
    out += a_low


def times(a: DoubleDouble, factor: float) -> DoubleDouble:
    """Return a times a small integer."""
    if abs(factor) in (1.0, 2.0, 4.0, 8.0):
        return DoubleDouble(a.high * factor, a.low * factor)
    return multiply(a, DoubleDouble(np.array(factor), np.array(0.0)))


def rescaled(a: DoubleDouble, exponent: IntArray32) -> DoubleDouble:
    """Return a 2**exponent."""
    return DoubleDouble(np.ldexp(a.high, exponent), np.ldexp(a.low, exponent))


def _two_sum(a: FloatArray, b: FloatArray) -> DoubleDouble:
    total = a + b
    b_part = total - a
    rest = a - (total - b_part)
    rest += b - b_part
    return DoubleDouble(total, rest)


def _renormalised(high: FloatArray, low: FloatArray) -> DoubleDouble:
    total = high + low
    return DoubleDouble(total, low - (total - high))


def _product_error(a: FloatArray, b: FloatArray, product: FloatArray) -> FloatArray:
    """Return a b minus its rounded value, exactly."""
    a_high, a_low = _split(a)
    b_high, b_low = (a_high, a_low) if a is b else _split(b)
    rest: FloatArray = a_high * b_high
    rest -= product
    rest += a_high * b_low
    rest += a_low * b_high
    rest += a_low * b_low
    return rest


def _split(a: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two halves of 26 bits each, whose products are exact."""
    scaled = a * _SPLITTER
    high = scaled - (scaled - a)
    return high, a - high


# Powers of numbers of 106 bits

MULTIPLIED = 128
"""Powers up to this one are products one after the other, as quick as ten multiplications are to one `power`.

Their roundings, half a unit each and of either sign, come to some sqrt(128) / 3 units.
"""

_IN_RANGE = 1000
"""Powers of numbers between 0.7 and 1.4 up to this one are neither too large nor too small."""


def small_power(base: DoubleDouble, exponent: np.ndarray, most: int) -> DoubleDouble:
    """Return powers of (m, 1) numbers to whole exponents (n,) up to `most`, shape (m, n)."""
    high, low = np.ones((most + 1, len(base.high))), np.zeros((most + 1, len(base.high)))
    flat = DoubleDouble(base.high[:, 0], base.low[:, 0])
    for k in range(most):
        high[k + 1], low[k + 1] = multiply(DoubleDouble(high[k], low[k]), flat)
    return DoubleDouble(high[exponent].T, low[exponent].T)


def power(base: DoubleDouble, exponent: np.ndarray) -> Scaled:
    """Return powers of (m, 1) numbers of 106 bits to whole exponents (n,), shape (m, n).

    (a + b)**i is a**i (1 + i b / a) to all digits.
    """
    mantissa, shift = np.frexp(base.high)
    # Between 0.7 and 1.4, so that powers stay in range for long.
    low = np.abs(mantissa) < np.sqrt(0.5)
    mantissa, shift = np.where(low, 2.0 * mantissa, mantissa), (shift - low).astype(np.int64)
    with np.errstate(divide="ignore"):
        correction = 1.0 + exponent * np.where(base.high == 0.0, 0.0, base.low / base.high)
    most = int(exponent.max(initial=0))
    if most <= MULTIPLIED:
        table = np.ones((len(mantissa), most + 1))
        table[:, 1:] = mantissa
        powers = np.multiply.accumulate(table, axis=1)[:, exponent]
        return Scaled(powers * correction, shift * exponent)
    steps, rest = np.divmod(exponent, _IN_RANGE)
    step, per_step = np.frexp(np.power(mantissa, float(_IN_RANGE)))
    powers, carried = np.frexp(np.power(step, steps) * np.power(mantissa, rest.astype(np.float64)))
    return Scaled(powers * correction, shift * exponent + per_step * steps + carried)
