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

Derivatives are the business of `rational_series`.

References
----------
.. [1] M. S. Floater and K. Hormann, "Barycentric rational interpolation with no poles and high rates of
   approximation", Numerische Mathematik 107 (2007) 315-331.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import (
    DoubleDouble,
    ExponentArray,
    Scaled,
    add,
    difference,
    multiply,
    normalise,
    scaled_differences,
)
from curvecore.arrays import FloatArray, IntArray
from curvecore.families.rational_series import (
    LocalSeries,
    Series,
    as_intc,
    inverse_of,
    row,
    total_of,
    window_sums,
)

_CHUNK = 1 << 17
"""Entries of one working array: 1 MB."""
_MOST_BITS = 400.0
"""Products of d + 2 factors within 2**+-400 leave room for what else a value is made of."""


_MOST_GROWTH = 1e3
"""Largest value of the Lebesgue function at which sums in double precision serve to draw derivatives."""


_MOST_UNEVEN = 64.0
"""Longest distance between parameters over the shortest, up to which they do: its powers multiply errors."""


class RationalPart(NamedTuple):
    """Basis functions for a slice of t.

    Attributes
    ----------
    where : slice
        Which t.
    values : ndarray, shape (n, m)
        B_i, or a derivative of it, in row i.
    exponent : ndarray of int, shape (n, m), or None
        Powers of two that the values are to be multiplied by; None is 0.
    """

    where: slice
    values: FloatArray
    exponent: ExponentArray | None


class RationalForm(NamedTuple):
    """The constants of the basis functions of given parameters.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
        t_i.
    degree : int
        d, at most n - 1.
    weights : Scaled, shape (n,)
        w_i.
    plain_weights : ndarray, shape (n,), or None
        The same, if these fit in 2**+-400.
    """

    parameters: FloatArray
    degree: int
    weights: Scaled
    plain_weights: FloatArray | None

    @classmethod
    def of(cls, parameters: FloatArray, degree: int) -> RationalForm:
        """Prepare checked parameters; O(n d**2) operations."""
        degree = min(degree, len(parameters) - 1)
        weights = _weights(parameters, degree)
        fits = np.abs(weights.exponent).max() <= _MOST_BITS
        plain = np.ldexp(weights.mantissa, as_intc(weights.exponent)) if fits else None
        return cls(parameters, degree, weights, plain)

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
            yield RationalPart(where, *values)

    def _values(self, t: FloatArray) -> tuple[FloatArray, ExponentArray | None]:
        nearest = np.minimum(np.searchsorted(self.parameters, t), len(self.parameters) - 1)
        columns = np.flatnonzero(self.parameters[nearest] == t)
        hits = nearest[columns], columns
        delta = t - self.parameters[:, None]
        delta[hits] = 1.0
        size = np.abs(delta)
        bits = max(abs(math.log2(size.min())), abs(math.log2(size.max())))
        exponent: ExponentArray | None = None
        if self.plain_weights is not None and (self.degree + 2) * bits <= _MOST_BITS:
            delta *= self._plain_denominator(t, size)
            values = np.divide(self.plain_weights[:, None], delta, out=delta)
        else:
            mantissa, own = scaled_differences(t, self.parameters, 0)
            mantissa[hits], own[hits] = 0.5, 1
            scale = self._denominator(t, Scaled(np.abs(mantissa), own))
            values = self.weights.mantissa[:, None] / (mantissa * scale.mantissa)
            scaled = self.weights.exponent[:, None] - (own + scale.exponent)
            scaled[:, columns] = 0
            exponent = np.asarray(scaled)
        values[:, columns] = 0.0
        values[hits] = 1.0
        return values, exponent

    def _plain_denominator(self, t: FloatArray, size: FloatArray) -> FloatArray:
        """Return D, shape (m,), for |t - t_i|, (n, m), whose products fit in one double."""
        d = self.degree
        chosen = self._chosen(t)
        terms = np.reciprocal(_window_products(size, d + 1))
        pairs = terms[:-1] / size[d + 1 :]
        pairs *= (self.parameters[d + 1 :] - self.parameters[: -d - 1])[:, None]
        terms *= chosen.single.take(chosen.column, axis=1)
        pairs *= chosen.pair.take(chosen.column, axis=1)
        return np.asarray((terms.sum(axis=0) + pairs.sum(axis=0)) * chosen.sign)

    def _denominator(self, t: FloatArray, size: Scaled) -> Scaled:
        """Return the same with an exponent for every factor."""
        d = self.degree
        chosen = self._chosen(t)
        product = _window_products(size.mantissa, d + 1)
        exponent = window_sums(size.exponent, d + 1)
        gaps, gap_exponent = np.frexp(self.parameters[d + 1 :] - self.parameters[: -d - 1])
        pairs = gaps[:, None] / (product[:-1] * size.mantissa[d + 1 :])
        pair_exponent = gap_exponent[:, None] - exponent[:-1] - size.exponent[d + 1 :]
        terms = np.concatenate(
            [chosen.single[:, chosen.column] / product, chosen.pair[:, chosen.column] * pairs]
        )
        rows = normalise(Scaled(terms, np.concatenate([-exponent, pair_exponent])))
        return Scaled(rows.values.sum(axis=0) * chosen.sign, rows.exponent)

    def _chosen(self, t: FloatArray) -> _Chosen:
        """Return which lambda_i stand alone and which with the next one, for t in the same segments."""
        segment = np.searchsorted(self.parameters, t, side="right") - 1
        segments, column = np.unique(segment, return_inverse=True)
        count = len(self.parameters) - self.degree
        i = np.arange(count)[:, None]
        # How far lambda_i is from those of one sign, before and after them.
        before, after = segments - self.degree - i, i - segments - 1
        single = (before < 0) & (after < 0)
        single |= (i == 0) & (before >= 0) & (before % 2 == 0)
        single |= (i == count - 1) & (after >= 0) & (after % 2 == 0)
        pair = ((before > 0) & (before % 2 == 1)) | ((after >= 0) & (after % 2 == 0))
        sign = np.where((segment + self.degree) % 2 == 0, 1.0, -1.0)
        return _Chosen(single.astype(float), pair[:-1].astype(float), column, sign)

    def _derivatives(self, t: FloatArray, order: int) -> tuple[FloatArray, ExponentArray]:
        local = LocalSeries.of(self.parameters, t, order)
        inverse = inverse_of(self._local_denominator(t, local))
        total = None
        for s in range(order + 1):
            term = multiply(local.quotient(s), row(inverse.series, order - s))
            total = term if total is None else add(total, term)
        assert total is not None
        values = (total.high + total.low) * (self.weights.mantissa[:, None] * math.factorial(order))
        exponent = self.weights.exponent[:, None] + local.exponent + inverse.exponent
        return values, exponent + (self.degree - order) * local.unit

    def quick_derivatives(self, points: FloatArray, t: FloatArray, highest: int) -> list[FloatArray] | None:
        """Return the curve and its derivatives up to an order at t, (m, dim) each, in double precision.

        All of them take little more than one basis. None where more digits would be lost than a drawing may
        lack: where the Lebesgue function exceeds 1e3 somewhere, parameters are uneven, or exponents exceed
        their range.
        """
        gaps = self.parameters[1:] - self.parameters[:-1]
        if gaps.max() > _MOST_UNEVEN * gaps.min():
            return None
        centre = points.mean(axis=0)
        found = [np.empty((t.size, points.shape[1])) for _ in range(highest + 1)]
        size = max(1, _CHUNK // len(self.parameters))
        for start in range(0, t.size, size):
            where = slice(start, start + size)
            part = self._quick_series(points - centre, t[where], highest)
            if part is None:
                return None
            for order, coefficient in enumerate(part):
                found[order][where] = coefficient.T * math.factorial(order)
        found[0] += centre
        return found

    def _quick_series(self, points: FloatArray, t: FloatArray, highest: int) -> list[FloatArray] | None:
        """Return the coefficients of the powers of y of the curve at t + y, (dim, m) each."""
        delta = t - self.parameters[:, None]
        nearest = np.abs(delta).argmin(axis=0), np.arange(t.size)
        offset, delta[nearest] = delta[nearest], 1.0
        _, bits = np.frexp(delta)
        if self.plain_weights is None or np.abs(bits).max() * (highest + 2) > _MOST_BITS:
            return None
        inverse = np.reciprocal(delta, out=delta)
        factor = inverse * offset
        factor[nearest] = 1.0
        if (
            np.abs(self.plain_weights) @ np.abs(factor) > _MOST_GROWTH * np.abs(self.plain_weights @ factor)
        ).any():
            return None
        inverse[nearest] = 0.0
        numerators = np.vstack([self.plain_weights, self.plain_weights * points.T])
        sums = [numerators @ factor]
        for order in range(1, highest + 1):
            if order == 1:
                factor = inverse * (self.parameters[:, None] - self.parameters[nearest[0]])
            factor *= -inverse
            sums.append(numerators @ factor)
        found: list[FloatArray] = []
        for order in range(highest + 1):
            rest = sums[order][1:].copy()
            for s in range(1, order + 1):
                rest -= sums[s][0] * found[order - s]
            found.append(rest / sums[0][0])
        return found

    def _local_denominator(self, t: FloatArray, local: LocalSeries) -> Series:
        """Return D (delta_a + y) as a series, shape (order + 1, m)."""
        d, n = self.degree, len(self.parameters)
        chosen = self._chosen(t)
        gaps = difference(self.parameters[d + 1 :], self.parameters[: -d - 1])
        _, gap_exponent = np.frexp(gaps.high)
        singles = local.windows(d + 1)
        terms, exponents = [singles.series], [singles.exponent]
        if n > d + 1:
            pairs = local.windows(d + 2)
            scaled = DoubleDouble(*(np.ldexp(each, -gap_exponent)[:, None] for each in gaps))
            terms.append(multiply(pairs.series, scaled))
            exponents.append(pairs.exponent + gap_exponent[:, None] - local.unit)
        alternating = _signs(n - d)[:, None]
        signs = np.concatenate([chosen.single * alternating, chosen.pair * -alternating[:-1]])[
            :, chosen.column
        ]
        high, low = (np.concatenate(both, axis=1) * signs for both in zip(*terms, strict=True))
        return total_of(Series(DoubleDouble(high, low), np.concatenate(exponents)), signs != 0.0)


class _Chosen(NamedTuple):
    """The terms that D is the sum of, all of one sign.

    Attributes
    ----------
    single : ndarray, shape (n - d, k)
        1 where lambda_i stands alone, else 0: a column for each segment that holds some t.
    pair : ndarray, shape (n - d - 1, k)
        1 where it stands together with lambda_(i + 1).
    column : ndarray of int, shape (m,)
        The column of each t.
    sign : ndarray, shape (m,)
        The sign of D.
    """

    single: FloatArray
    pair: FloatArray
    column: IntArray
    sign: FloatArray


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


def _window_products(values: FloatArray, length: int) -> FloatArray:
    """Return the products of so many neighbouring rows each."""
    count = len(values) - length + 1
    product = values[:count].copy()
    for j in range(1, length):
        product *= values[j : count + j]
    return product


def _signs(count: int) -> FloatArray:
    """Return 1, -1, 1, ..."""
    return np.asarray(1.0 - 2.0 * (np.arange(count) % 2))
