"""Derivatives of the Floater-Hormann functions: power series in the distance y from t.

With D the denominator of `rational_form` and a the parameter nearest to t, D (delta_a + y) is smooth around
t, and the functions are w_k (delta_a + y) / (delta_k + y) over it. The coefficients of these series
have terms of both signs, so they run in double-double arithmetic. The formula of Schneider and Werner [1]_
divides differences of values of the curve by t - t_k instead, and loses digits next to t_k.

References
----------
.. [1] C. Schneider and W. Werner, "Some new aspects of rational interpolation", Mathematics of Computation
   47 (1986) 285-299.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import (
    DoubleDouble,
    ExponentArray,
    add,
    difference,
    halved_difference,
    multiply,
    reciprocal,
    rescaled,
)
from curvecore.arrays import BoolArray, FloatArray, IntArray, IntArray32


class Series(NamedTuple):
    """Power series with a power of two each.

    Attributes
    ----------
    series : DoubleDouble, shape (order + 1, ...)
        The coefficients of y**0, y**1 and so on.
    exponent : ndarray of int, shape (...)
        Powers of two that all of them are to be multiplied by.
    """

    series: DoubleDouble
    exponent: ExponentArray


class LocalSeries(NamedTuple):
    """The distances from t to all parameters; the unit is a power of two near that to the second nearest.

    Attributes
    ----------
    powers : DoubleDouble, shape (order + 1, n, m)
        The coefficients of 1 / (m + y), m the mantissa of delta_k; of 1 for the nearest parameter a.
    exponent : ndarray of int, shape (n, m)
        The exponents of 1 / delta_k in this unit, at most 0; 0 for a.
    gaps : DoubleDouble, shape (n, m)
        t_k - t_a, in units of the power of two of delta_k.
    nearest : ndarray of int, shape (m,)
        a.
    offset : DoubleDouble, shape (m,)
        delta_a in this unit.
    unit : ndarray of int, shape (m,)
        The exponent of the unit.
    """

    powers: DoubleDouble
    exponent: ExponentArray
    gaps: DoubleDouble
    nearest: IntArray
    offset: DoubleDouble
    unit: ExponentArray

    @classmethod
    def of(cls, parameters: FloatArray, t: FloatArray, order: int) -> LocalSeries:
        """Measure distances from t, (m,), for series of `order` + 1 coefficients."""
        delta, doubled = halved_difference(t, parameters)
        nearest = np.abs(delta.high).argmin(axis=0)
        at_nearest = nearest, np.arange(t.size)
        offset = DoubleDouble(delta.high[at_nearest], delta.low[at_nearest])
        _, size = np.frexp(delta.high)
        size += doubled
        size[at_nearest] = np.iinfo(np.intc).max
        unit = size.min(axis=0)
        size[at_nearest] = 0
        delta.high[at_nearest], delta.low[at_nearest] = 1.0, 0.0
        inverse = reciprocal(rescaled(delta, doubled - size))
        high, low = np.zeros((2, order + 1, *inverse.high.shape))
        high[0], low[0] = inverse
        for s in range(1, order + 1):
            product = multiply(DoubleDouble(high[s - 1], low[s - 1]), inverse)
            high[s], low[s] = -product.high, -product.low
        high[1:, *at_nearest], low[1:, *at_nearest] = 0.0, 0.0
        size[at_nearest] = unit
        gaps = rescaled(difference(parameters[:, None], parameters[nearest]), -size)
        exponent = (unit - size).astype(np.int64)
        offset = rescaled(offset, doubled - unit)
        return cls(DoubleDouble(high, low), exponent, gaps, nearest, offset, unit.astype(np.int64))

    def quotient(self, s: int) -> DoubleDouble:
        """Return the coefficients of y**s of (delta_a + y) / (delta_k + y), but for `exponent`, (n, m)."""
        powers = row(self.powers, s)
        if s:
            return rescaled(multiply(powers, self.gaps), as_intc((s - 1) * self.exponent))
        result = multiply(powers, self.offset)
        at_nearest = self.nearest, np.arange(len(self.nearest))
        result.high[at_nearest], result.low[at_nearest] = 1.0, 0.0
        return result

    def windows(self, length: int) -> Series:
        """Return the products of 1 / (delta_k + y) over so many neighbours, times delta_a + y."""
        shifts = np.arange(len(self.powers.high))[:, None, None]
        factors = rescaled(self.powers, as_intc(shifts * self.exponent))
        product = _series_products(factors, length)
        i = np.arange(product.high.shape[1])[:, None]
        has_nearest = (i <= self.nearest) & (self.nearest < i + length)
        times = _times_linear(product, self.offset)
        high, low = (np.where(has_nearest, *both) for both in zip(product, times, strict=True))
        return Series(DoubleDouble(high, low), window_sums(self.exponent, length))


def _times_linear(series: DoubleDouble, offset: DoubleDouble) -> DoubleDouble:
    """Return series times (offset + y)."""
    result = multiply(series, offset)
    raised = add(
        DoubleDouble(result.high[1:], result.low[1:]), DoubleDouble(series.high[:-1], series.low[:-1])
    )
    result.high[1:], result.low[1:] = raised
    return result


def _series_products(factors: DoubleDouble, length: int) -> DoubleDouble:
    """Return the products of so many neighbouring series each; axis 0 are the powers, axis 1 the series."""
    if length == 1:
        return factors
    half = length // 2
    count = factors.high.shape[1] - length + 1
    parts = _series_products(factors, half)
    product = _product(_rows(parts, 0, count), _rows(parts, half, half + count))
    return _product(product, _rows(factors, length - 1, None)) if length % 2 else product


def _product(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return the products of power series, as long as they are."""
    high, low = np.empty_like(a.high), np.empty_like(a.low)
    for power in range(len(high)):
        total = multiply(row(a, 0), row(b, power))
        for s in range(1, power + 1):
            total = add(total, multiply(row(a, s), row(b, power - s)))
        high[power], low[power] = total
    return DoubleDouble(high, low)


def inverse_of(series: Series) -> Series:
    """Return 1 / series."""
    first = reciprocal(row(series.series, 0))
    high, low = np.empty_like(series.series.high), np.empty_like(series.series.low)
    high[0], low[0] = first
    for power in range(1, len(high)):
        total = multiply(row(series.series, 1), DoubleDouble(high[power - 1], low[power - 1]))
        for s in range(2, power + 1):
            earlier = DoubleDouble(high[power - s], low[power - s])
            total = add(total, multiply(row(series.series, s), earlier))
        product = multiply(total, first)
        high[power], low[power] = -product.high, -product.low
    return Series(DoubleDouble(high, low), -series.exponent)


def total_of(terms: Series, counts: BoolArray) -> Series:
    """Return the sum over axis 1 of the series that count, with the first coefficient near 1."""
    common = np.where(counts, terms.exponent, np.iinfo(np.int64).min // 2).max(axis=0)
    total = rescaled(terms.series, as_intc(terms.exponent - common))
    while (count := total.high.shape[1]) > 1:
        half = count // 2
        pairs = add(_rows(total, 0, half), _rows(total, half, 2 * half))
        rest = _rows(total, 2 * half, None)
        total = DoubleDouble(*(np.concatenate(both, axis=1) for both in zip(pairs, rest, strict=True)))
    return Series(_rows(total, 0, 1), common)


def window_sums(values: ExponentArray, length: int) -> ExponentArray:
    """Return the sums of so many neighbouring rows each."""
    sums = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])
    return np.asarray(sums[length:] - sums[:-length])


def row(numbers: DoubleDouble, index: int) -> DoubleDouble:
    """Return a part along axis 0."""
    return DoubleDouble(numbers.high[index], numbers.low[index])


def _rows(numbers: DoubleDouble, start: int, stop: int | None) -> DoubleDouble:
    """Return a part along axis 1."""
    return DoubleDouble(numbers.high[:, start:stop], numbers.low[:, start:stop])


def as_intc(exponent: ExponentArray) -> IntArray32:
    """Return exponents as ldexp takes them; beyond these all numbers vanish anyway."""
    return np.clip(exponent, -5000, 5000).astype(np.intc)
