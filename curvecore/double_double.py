"""Arithmetic on unevaluated sums hi + lo of two doubles, about 106 bits.

Error-free transformations need a round-to-nearest double and no overflow
above 2**996; the callers' numbers are scaled to lie near 1.

References
----------
.. [1] T. J. Dekker, "A floating-point technique for extending the available
   precision", Numerische Mathematik 18 (1971) 224-242.
.. [2] T. Ogita, S. M. Rump and S. Oishi, "Accurate sum and dot product", SIAM
   J. Sci. Comput. 26 (2005) 1955-1988, algorithms 3.1 to 3.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray32

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


def vector_lengths(a: DoubleDouble) -> DoubleDouble:
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
