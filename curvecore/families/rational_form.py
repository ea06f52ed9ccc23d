"""Basis functions of Floater and Hormann, each accurate relative to itself wherever the parameters lie.

With delta_j = t - t_j the curve blends the polynomials q_i through d + 1 neighbouring points [1]_:

    c = sum lambda_i q_i / sum lambda_i,   lambda_i = (-1)^i / (delta_i ... delta_(i+d)),

which is sum (w_k / delta_k) p_k / D with D = sum lambda_i and weights w_k that are sums of terms of one
sign. D, too, can be written so: next to the segment of t all lambda_i have one sign, and further out two
neighbours, of which the nearer one is the larger, are

    lambda_i + lambda_(i+1) = (-1)^(i+1) (t_(i+d+1) - t_i) / (delta_i ... delta_(i+d+1)).

That is the pairing by which the paper shows that there are no poles (theorem 1). No sum here cancels, where
sum w_k / delta_k, the denominator of the usual formula, loses as many digits as the Lebesgue function has
before the point: every function comes out with a small relative error.

Derivatives are coefficients of power series in the distance y from t: of D (delta_a + y), a the parameter
nearest to t, which is smooth there, and of (delta_a + y) / (delta_k + y). Their terms have both signs, so
they run in double-double arithmetic. The formula of Schneider and Werner [2]_ divides differences of values
of the curve by t - t_k instead, and loses digits next to t_k.

References
----------
.. [1] M. S. Floater and K. Hormann, "Barycentric rational interpolation with no poles and high rates of
   approximation", Numerische Mathematik 107 (2007) 315-331.
.. [2] C. Schneider and W. Werner, "Some new aspects of rational interpolation", Mathematics of Computation
   47 (1986) 285-299.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray, IntArray32
from curvecore.double_double import DoubleDouble, add, difference, multiply, reciprocal, rescaled
from curvecore.scaling import ExponentArray, Scaled, normalise

_CHUNK = 1 << 17
"""Entries of one working array: 1 MB."""


class RationalPart(NamedTuple):
    """Basis functions for a slice of t.

    Attributes
    ----------
    where : slice
        Which t.
    values : Scaled, shape (n, m)
        B_i, or a derivative of it, in row i.
    """

    where: slice
    values: Scaled


class RationalForm(NamedTuple):
    """What the basis functions of given parameters need.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
        t_i.
    degree : int
        d, at most n - 1.
    weights : Scaled, shape (n,)
        w_i.
    """

    parameters: FloatArray
    degree: int
    weights: Scaled

    @classmethod
    def of(cls, parameters: FloatArray, degree: int) -> RationalForm:
        """Prepare checked parameters; O(n d**2) operations."""
        degree = min(degree, len(parameters) - 1)
        return cls(parameters, degree, _weights(parameters, degree))

    def parts(self, t: FloatArray, order: int) -> Iterator[RationalPart]:
        """Yield the order-th derivatives of all functions at t, shape (m,), a slice of t at a time.

        Notes
        -----
        Numbers may underflow on the way: the caller sets `numpy.errstate`, which a generator cannot
        without leaking it.
        """
        size = max(1, _CHUNK // (len(self.parameters) * (order + 1)))
        for start in range(0, t.size, size):
            where = slice(start, min(start + size, t.size))
            values = self._derivatives(t[where], order) if order else self._values(t[where])
            yield RationalPart(where, values)

    def _values(self, t: FloatArray) -> Scaled:
        nearest = np.minimum(np.searchsorted(self.parameters, t), len(self.parameters) - 1)
        columns = np.flatnonzero(self.parameters[nearest] == t)
        hits = nearest[columns], columns
        delta = _differences(t, self.parameters)
        delta.mantissa[hits], delta.exponent[hits] = 0.5, 1
        total = self._denominator(t, delta)
        values = self.weights.mantissa[:, None] / (delta.mantissa * total.mantissa)
        exponent = self.weights.exponent[:, None] - (delta.exponent + total.exponent)
        values[:, columns], exponent[:, columns] = 0.0, 0
        values[hits] = 1.0
        return Scaled(values, exponent)

    def _denominator(self, t: FloatArray, delta: Scaled) -> Scaled:
        """Return D, shape (m,)."""
        d, n = self.degree, len(self.parameters)
        single, pair = self._chosen(t)
        product = delta.mantissa[: n - d].copy()
        for j in range(1, d + 1):
            product *= delta.mantissa[j : n - d + j]
        exponent = _window_sums(delta.exponent, d + 1)
        gaps, gap_exponent = np.frexp(self.parameters[d + 1 :] - self.parameters[: n - d - 1])
        pairs = gaps[:, None] / (product[:-1] * delta.mantissa[d + 1 :])
        pair_exponent = gap_exponent[:, None] - exponent[:-1] - delta.exponent[d + 1 :]
        sign = _signs(n - d)[:, None]
        terms = np.concatenate(
            [np.where(single, sign / product, 0.0), np.where(pair, -sign[:-1] * pairs, 0.0)]
        )
        rows = normalise(Scaled(terms, np.concatenate([-exponent, pair_exponent])))
        return Scaled(rows.values.sum(axis=0), rows.exponent)

    def _chosen(self, t: FloatArray) -> tuple[BoolArray, BoolArray]:
        """Return which lambda_i stand alone, (n - d, m), and which stand with the next, (n - d - 1, m)."""
        count = len(self.parameters) - self.degree
        i = np.arange(count)[:, None]
        segment = np.searchsorted(self.parameters, t, side="right") - 1
        # How far lambda_i is from those of one sign, before and after them.
        before, after = segment - self.degree - i, i - segment - 1
        alone = (before < 0) & (after < 0)
        alone |= (i == 0) & (before >= 0) & (before % 2 == 0)
        alone |= (i == count - 1) & (after >= 0) & (after % 2 == 0)
        paired = ((before >= 1) & (before % 2 == 1)) | ((after >= 0) & (after % 2 == 0))
        return alone, paired[:-1]

    def _derivatives(self, t: FloatArray, order: int) -> Scaled:
        local = _Local.of(self.parameters, t, order)
        inverse = _inverse(self._local_denominator(t, local))
        total = None
        for s in range(order + 1):
            term = multiply(local.quotient(s), _row(inverse.series, order - s))
            total = term if total is None else add(total, term)
        assert total is not None
        values = (total.high + total.low) * (self.weights.mantissa[:, None] * math.factorial(order))
        exponent = self.weights.exponent[:, None] + local.exponent + inverse.exponent
        return Scaled(values, exponent + (self.degree - order) * local.unit)

    def _local_denominator(self, t: FloatArray, local: _Local) -> _Series:
        """Return D (delta_a + y) as a series, shape (order + 1, m)."""
        d, n = self.degree, len(self.parameters)
        single, pair = self._chosen(t)
        products = local.windows(d + 1)
        gaps = difference(self.parameters[d + 1 :], self.parameters[: n - d - 1])
        _, gap_exponent = np.frexp(gaps.high)
        gaps = DoubleDouble(*(np.ldexp(each, -gap_exponent)[:, None] for each in gaps))
        longer = (
            local.windows(d + 2)
            if n > d + 1
            else _Series(_rows(products.series, 0, 0), products.exponent[:0])
        )
        pairs = multiply(longer.series, gaps)
        sign = _signs(n - d)[:, None]
        signs = np.concatenate([np.where(single, sign, 0.0), np.where(pair, -sign[:-1], 0.0)])
        high, low = (
            np.concatenate(both, axis=1) * signs for both in zip(products.series, pairs, strict=True)
        )
        exponent = np.concatenate([products.exponent, longer.exponent + gap_exponent[:, None] - local.unit])
        return _total(_Series(DoubleDouble(high, low), exponent), signs != 0.0)


class _Series(NamedTuple):
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


class _Local(NamedTuple):
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
    def of(cls, parameters: FloatArray, t: FloatArray, order: int) -> _Local:
        delta = difference(t, parameters[:, None])
        nearest = np.abs(delta.high).argmin(axis=0)
        at_nearest = nearest, np.arange(t.size)
        offset = DoubleDouble(delta.high[at_nearest], delta.low[at_nearest])
        _, size = np.frexp(delta.high)
        size[at_nearest] = np.iinfo(np.intc).max
        unit = size.min(axis=0)
        size[at_nearest] = 0
        delta.high[at_nearest], delta.low[at_nearest] = 1.0, 0.0
        inverse = reciprocal(rescaled(delta, -size))
        high, low = np.zeros((2, order + 1, *inverse.high.shape))
        high[0], low[0] = inverse
        for s in range(1, order + 1):
            product = multiply(DoubleDouble(high[s - 1], low[s - 1]), inverse)
            high[s], low[s] = -product.high, -product.low
        high[1:, *at_nearest], low[1:, *at_nearest] = 0.0, 0.0
        size[at_nearest] = unit
        gaps = rescaled(difference(parameters[:, None], parameters[nearest]), -size)
        exponent = (unit - size).astype(np.int64)
        return cls(
            DoubleDouble(high, low), exponent, gaps, nearest, rescaled(offset, -unit), unit.astype(np.int64)
        )

    def quotient(self, s: int) -> DoubleDouble:
        """Return the coefficients of y**s of (delta_a + y) / (delta_k + y), but for `exponent`, (n, m)."""
        powers = _row(self.powers, s)
        if s:
            return rescaled(multiply(powers, self.gaps), _as_intc((s - 1) * self.exponent))
        result = multiply(powers, self.offset)
        at_nearest = self.nearest, np.arange(len(self.nearest))
        result.high[at_nearest], result.low[at_nearest] = 1.0, 0.0
        return result

    def windows(self, length: int) -> _Series:
        """Return the products of 1 / (delta_k + y) over so many neighbours, times delta_a + y."""
        shifts = np.arange(len(self.powers.high))[:, None, None]
        factors = rescaled(self.powers, _as_intc(shifts * self.exponent))
        product = _window_products(factors, length)
        i = np.arange(product.high.shape[1])[:, None]
        has_nearest = (i <= self.nearest) & (self.nearest < i + length)
        times = _times_linear(product, self.offset)
        high, low = (np.where(has_nearest, *both) for both in zip(product, times, strict=True))
        return _Series(DoubleDouble(high, low), _window_sums(self.exponent, length))


def _times_linear(series: DoubleDouble, offset: DoubleDouble) -> DoubleDouble:
    """Return series times (offset + y)."""
    result = multiply(series, offset)
    raised = add(
        DoubleDouble(result.high[1:], result.low[1:]), DoubleDouble(series.high[:-1], series.low[:-1])
    )
    result.high[1:], result.low[1:] = raised
    return result


def _window_products(factors: DoubleDouble, length: int) -> DoubleDouble:
    """Return the products of so many neighbouring series each; axis 0 are the powers, axis 1 the series."""
    if length == 1:
        return factors
    half = length // 2
    count = factors.high.shape[1] - length + 1
    parts = _window_products(factors, half)
    product = _product(_rows(parts, 0, count), _rows(parts, half, half + count))
    return _product(product, _rows(factors, length - 1, None)) if length % 2 else product


def _product(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Return the products of power series, as long as they are."""
    high, low = np.empty_like(a.high), np.empty_like(a.low)
    for power in range(len(high)):
        total = multiply(_row(a, 0), _row(b, power))
        for s in range(1, power + 1):
            total = add(total, multiply(_row(a, s), _row(b, power - s)))
        high[power], low[power] = total
    return DoubleDouble(high, low)


def _inverse(series: _Series) -> _Series:
    """Return 1 / series."""
    first = reciprocal(_row(series.series, 0))
    high, low = np.empty_like(series.series.high), np.empty_like(series.series.low)
    high[0], low[0] = first
    for power in range(1, len(high)):
        total = multiply(_row(series.series, 1), DoubleDouble(high[power - 1], low[power - 1]))
        for s in range(2, power + 1):
            earlier = DoubleDouble(high[power - s], low[power - s])
            total = add(total, multiply(_row(series.series, s), earlier))
        product = multiply(total, first)
        high[power], low[power] = -product.high, -product.low
    return _Series(DoubleDouble(high, low), -series.exponent)


def _total(terms: _Series, counts: BoolArray) -> _Series:
    """Return the sum over axis 1 of the series that count, with the first coefficient near 1."""
    common = np.where(counts, terms.exponent, np.iinfo(np.int64).min // 2).max(axis=0)
    total = rescaled(terms.series, _as_intc(terms.exponent - common))
    while (count := total.high.shape[1]) > 1:
        half = count // 2
        pairs = add(_rows(total, 0, half), _rows(total, half, 2 * half))
        rest = _rows(total, 2 * half, None)
        total = DoubleDouble(*(np.concatenate(both, axis=1) for both in zip(pairs, rest, strict=True)))
    return _Series(_rows(total, 0, 1), common)


def _weights(parameters: FloatArray, degree: int) -> Scaled:
    """Return w_k: (-1)^(k-d) times the sum over all windows of 1 / |t_k - t_j|, multiplied; shape (n,)."""
    n = len(parameters)
    k = np.arange(n)
    left, right = (_running_distances(parameters, degree, side) for side in (-1, 1))
    terms, exponents = np.zeros((2, degree + 1, n))
    for before in range(degree + 1):
        after = degree - before
        fits = (before <= k) & (k < n - after)
        product = left.mantissa[before] * right.mantissa[after]
        terms[before] = np.where(fits, 1.0 / product, 0.0)
        exponents[before] = -(left.exponent[before] + right.exponent[after])
    rows = normalise(Scaled(terms, exponents.astype(np.int64)))
    return Scaled(rows.values.sum(axis=0) * _signs(n) * (-1.0) ** degree, rows.exponent)


def _running_distances(parameters: FloatArray, degree: int, side: int) -> Scaled:
    """Return the products of the distances to the next 0, 1, ... neighbours on one side, (d + 1, n)."""
    n = len(parameters)
    neighbour = np.arange(n) + side * np.arange(1, degree + 1)[:, None]
    exists = (neighbour >= 0) & (neighbour < n)
    distance = np.abs(parameters[np.clip(neighbour, 0, n - 1)] - parameters)
    mantissa, exponent = np.frexp(np.where(exists, distance, 1.0))
    mantissa = np.concatenate([np.ones((1, n)), np.cumprod(mantissa, axis=0)])
    exponent = np.concatenate([np.zeros((1, n)), np.cumsum(exponent, axis=0)])
    return Scaled(mantissa, exponent.astype(np.int64))


def _differences(t: FloatArray, parameters: FloatArray) -> Scaled:
    """Return t - t_i, shape (n, m)."""
    mantissa, exponent = np.frexp(t - parameters[:, None])
    return Scaled(mantissa, exponent.astype(np.int64))


def _window_sums(values: ExponentArray, length: int) -> ExponentArray:
    """Return the sums of so many neighbouring rows each."""
    sums = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])
    return np.asarray(sums[length:] - sums[:-length])


def _signs(count: int) -> FloatArray:
    """Return 1, -1, 1, ..."""
    return np.asarray(1.0 - 2.0 * (np.arange(count) % 2))


def _row(numbers: DoubleDouble, index: int) -> DoubleDouble:
    return DoubleDouble(numbers.high[index], numbers.low[index])


def _rows(numbers: DoubleDouble, start: int, stop: int | None) -> DoubleDouble:
    """Return a part along axis 1."""
    return DoubleDouble(numbers.high[:, start:stop], numbers.low[:, start:stop])


def _as_intc(exponent: ExponentArray) -> IntArray32:
    """Return exponents as ldexp takes them; beyond these all numbers vanish anyway."""
    return np.clip(exponent, -5000, 5000).astype(np.intc)
