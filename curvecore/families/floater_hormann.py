"""Barycentric rational interpolation: quotients without poles, and without oscillation at uniform parameters.

The functions of Floater and Hormann are each accurate relative to themselves wherever the parameters lie.
With delta_j = t - t_j the curve blends the polynomials q_i through d + 1 neighbouring points [1]_:

    c = sum lambda_i q_i / sum lambda_i,   lambda_i = (-1)^i / (delta_i ... delta_(i+d)),

which is sum (w_k / delta_k) p_k / D with D = sum lambda_i and weights w_k that are sums of terms of one
sign. D, too, can be written so: next to the segment of t all lambda_i have one sign, and further out two
neighbours, of which the nearer one is the larger, are

    lambda_i + lambda_(i+1) = (-1)^(i+1) (t_(i+d+1) - t_i) / (delta_i ... delta_(i+d+1)).

That is the pairing by which the paper shows that there are no poles (theorem 1). No sum here cancels, where
sum w_k / delta_k, the denominator of the usual formula, loses as many digits as the Lebesgue function has
before the point: every function comes out with a small relative error.

Derivatives are power series in the distance y from t. With a the parameter nearest to t, D (delta_a + y) is
smooth around t, and the functions are w_k (delta_a + y) / (delta_k + y) over it. The coefficients of these
series have terms of both signs, so they run in double-double arithmetic. The formula of Schneider and Werner
[2]_ divides differences of values of the curve by t - t_k instead, and loses digits next to t_k.

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
from numpy.typing import ArrayLike

from curvecore.arithmetic import (
    DoubleDouble,
    ExponentArray,
    Scaled,
    ScaledRows,
    add,
    difference,
    halved_difference,
    multiply,
    normalise,
    reciprocal,
    rescaled,
    scale_by_power,
    scaled_differences,
)
from curvecore.arrays import BoolArray, FloatArray, IntArray, IntArray32
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant
from curvecore.families.lagrange import LagrangeCurve
from curvecore.families.setting import FamilySetting

_NO_EXPONENT = np.zeros(1, dtype=np.int64)


class FloaterHormannCurve(ParametricCurve):
    """Smooth blend of polynomials through neighbouring points; free of oscillation at uniform parameters.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i = c(t_i), finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.
    degree : int, optional
        d, from 0 to 10: the degree of the polynomials that are blended, each through d + 1 neighbouring
        points. Where there are fewer points, n <= d, it counts as n - 1.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    LagrangeCurve : The polynomial through the points.
    CubicSplineCurve : Cubic pieces through them.

    Notes
    -----
    c(t) is a quotient of polynomials whose denominator has no real zero, so that the curve is infinitely
    smooth [1]_; it reproduces polynomials of degree d. Of n <= d + 2 points it is the polynomial through
    them: blending two is Neville's formula. Under uniform parameters the Lebesgue constant grows like
    2**(d - 1) (2 + log n), where that of the polynomial grows like 2**n [2]_.

    With u = 2**-53, values and derivatives differ from the exact ones by at most c u sum |B_i^(order)(t)|
    |p_i|, with c at most about 10: of values for any distinct parameters, of derivatives up to the third
    where the longest distance between parameters is at most 1e15 times the shortest. Values of every single
    function are that accurate.

    The first evaluation takes O(n d**2) operations, the later ones O(n d) per t; memory beyond the result is
    bounded. Results beyond the floating point range become the largest finite number of their sign.

    References
    ----------
    .. [1] M. S. Floater and K. Hormann, "Barycentric rational interpolation with no poles and high rates of
       approximation", Numerische Mathematik 107 (2007) 315-331.
    .. [2] L. Bos, S. De Marchi, K. Hormann and G. Klein, "On the Lebesgue constant of barycentric rational
       interpolation at equidistant nodes", Numerische Mathematik 121 (2012) 461-471.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import FloaterHormannCurve, LagrangeCurve
    >>> t, x = np.linspace(-1, 1, 21), np.linspace(-1, 1, 201)
    >>> points = np.stack([t, 1 / (1 + 25 * t**2)], axis=1)
    >>> for family in (LagrangeCurve, FloaterHormannCurve):
    ...     print(round(float(np.abs(family(points, t)(x)[:, 1] - 1 / (1 + 25 * x**2)).max()), 3))
    58.585
    0.003
    """

    __slots__ = ("_form",)
    _caches = ("_form",)

    name = "floater_hormann"
    title = "barycentric rational"
    short_title = "rational"
    rank = 60
    is_calm = True
    settings = (
        FamilySetting(
            "degree",
            "blended degree",
            3,
            "Degree of the local polynomials that are blended",
            limits=(0, 10),
        ),
    )

    _form: RationalForm | None

    @property
    def _rational_form(self) -> RationalForm:
        if self._form is None:
            self._form = RationalForm.of(self._parameters, int(self.chosen["degree"]))
        return self._form

    @property
    def degree(self) -> int | None:
        """The degree n - 1 of the polynomial that the curve is where n <= d + 2; None of more points."""
        degree = len(self._parameters) - 1
        return degree if degree <= int(self.chosen["degree"]) + 1 else None

    @property
    def kind(self) -> str:
        """The words for a quotient of polynomials; see `FamilyDefaults`."""
        return f"rational, blended degree {self.chosen['degree']}" if self.degree is None else ""

    def _vanishes(self, order: int) -> bool:
        """Whether the derivatives of an order are 0 everywhere."""
        return self.degree is not None and order > self.degree

    @property
    def _polynomial(self) -> LagrangeCurve | None:
        """The same curve as one polynomial, where it is one."""
        return None if self.degree is None else LagrangeCurve(self.points, self._parameters)

    def exact_pieces(self) -> FloatArray | None:
        """Return the control points of the one polynomial; None of a quotient."""
        return None if (polynomial := self._polynomial) is None else polynomial.exact_pieces()

    def interpolants(self) -> list[Interpolant] | None:
        """Return the one polynomial, all points; None of a quotient."""
        return None if (polynomial := self._polynomial) is None else polynomial.interpolants()

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many parameters, all of them in one pass.

        Where the Lebesgue function stays below 1e3, and parameters are not too uneven, by sums in double
        precision: the errors are then up to 1e4 times larger than those of `evaluate`.
        """
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            derivatives = (
                self._rational_form.quick_derivatives(self.points, t, max(orders)) if len(t) else None
            )
        if derivatives is None or not all(np.isfinite(values).all() for values in derivatives):
            return super().derivatives_at(t, orders)
        return [derivatives[order] for order in orders]

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i, shape (m, n, dim), by differences; points about their mean lose no digits."""
        centred = self.with_jets(self.jets - self.points.mean(axis=0))
        return super(FloaterHormannCurve, centred).parameter_derivatives(t)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        result = np.zeros((len(self._parameters), t.size))
        if self._vanishes(order):
            return result.T
        for where, values, exponent in self._rational_form.parts(t, order):
            result[:, where] = values if exponent is None else scale_by_power(values, exponent)
        return result.T

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        if self._vanishes(order):
            return np.zeros((t.size, self.points.shape[1]))
        # As in `LagrangeCurve.evaluate`: points near 1 keep a sum of large terms that cancel in range.
        _, exponent = np.frexp(np.abs(self.points).max(axis=0))
        result = np.empty((self.points.shape[1], t.size))
        points = np.ldexp(self.points, -exponent)
        for where, values, exponents in self._rational_form.parts(t, order):
            rows = ScaledRows(values, _NO_EXPONENT)
            if exponents is not None:
                rows = normalise(Scaled(values, exponents))
            result[:, where] = scale_by_power(points.T @ rows.values, exponent[:, None] + rows.exponent)
        curve = np.ascontiguousarray(result.T)
        if order == 0:
            self._put_points(curve, t)
        return curve


# The basis functions

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
            mantissa, powers = scaled_differences(t, self.parameters, 0)
            mantissa[hits], powers[hits] = 0.5, 1
            scale = self._denominator(t, Scaled(np.abs(mantissa), powers))
            values = self.weights.mantissa[:, None] / (mantissa * scale.mantissa)
            scaled = self.weights.exponent[:, None] - (powers + scale.exponent)
            scaled[:, columns] = 0
            exponent = np.asarray(scaled)
        values[:, columns] = 0.0
        values[hits] = 1.0
        return values, exponent

    def _plain_denominator(self, t: FloatArray, size: FloatArray) -> FloatArray:
        """Return D, shape (m,), for |t - t_i|, (n, m), whose products fit in one double."""
        d = self.degree
        signed = self._signed_terms(t)
        terms = np.reciprocal(_window_products(size, d + 1))
        pairs = terms[:-1] / size[d + 1 :]
        pairs *= (self.parameters[d + 1 :] - self.parameters[: -d - 1])[:, None]
        terms *= signed.single.take(signed.column, axis=1)
        pairs *= signed.pair.take(signed.column, axis=1)
        return np.asarray((terms.sum(axis=0) + pairs.sum(axis=0)) * signed.sign)

    def _denominator(self, t: FloatArray, size: Scaled) -> Scaled:
        """Return the same with an exponent for every factor."""
        d = self.degree
        signed = self._signed_terms(t)
        product = _window_products(size.mantissa, d + 1)
        exponent = window_sums(size.exponent, d + 1)
        gaps, gap_exponent = np.frexp(self.parameters[d + 1 :] - self.parameters[: -d - 1])
        pairs = gaps[:, None] / (product[:-1] * size.mantissa[d + 1 :])
        pair_exponent = gap_exponent[:, None] - exponent[:-1] - size.exponent[d + 1 :]
        terms = np.concatenate(
            [signed.single[:, signed.column] / product, signed.pair[:, signed.column] * pairs]
        )
        rows = normalise(Scaled(terms, np.concatenate([-exponent, pair_exponent])))
        return Scaled(rows.values.sum(axis=0) * signed.sign, rows.exponent)

    def _signed_terms(self, t: FloatArray) -> _SignedTerms:
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
        return _SignedTerms(single.astype(float), pair[:-1].astype(float), column, sign)

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
        derivatives = [np.empty((t.size, points.shape[1])) for _ in range(highest + 1)]
        size = max(1, _CHUNK // len(self.parameters))
        for start in range(0, t.size, size):
            where = slice(start, start + size)
            part = self._quick_series(points - centre, t[where], highest)
            if part is None:
                return None
            for order, coefficient in enumerate(part):
                derivatives[order][where] = coefficient.T * math.factorial(order)
        derivatives[0] += centre
        return derivatives

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
        series: list[FloatArray] = []
        for order in range(highest + 1):
            rest = sums[order][1:].copy()
            for s in range(1, order + 1):
                rest -= sums[s][0] * series[order - s]
            series.append(rest / sums[0][0])
        return series

    def _local_denominator(self, t: FloatArray, local: LocalSeries) -> Series:
        """Return D (delta_a + y) as a series, shape (order + 1, m)."""
        d, n = self.degree, len(self.parameters)
        signed = self._signed_terms(t)
        gaps = difference(self.parameters[d + 1 :], self.parameters[: -d - 1])
        _, gap_exponent = np.frexp(gaps.high)
        singles = local.windows(d + 1)
        terms, exponents = [singles.series], [singles.exponent]
        if n > d + 1:
            pairs = local.windows(d + 2)
            scaled = DoubleDouble(*(np.ldexp(part, -gap_exponent)[:, None] for part in gaps))
            terms.append(multiply(pairs.series, scaled))
            exponents.append(pairs.exponent + gap_exponent[:, None] - local.unit)
        alternating = _signs(n - d)[:, None]
        both = [signed.single * alternating, signed.pair * -alternating[:-1]]
        signs = np.concatenate(both)[:, signed.column]
        high, low = (np.concatenate(both, axis=1) * signs for both in zip(*terms, strict=True))
        return total_of(Series(DoubleDouble(high, low), np.concatenate(exponents)), signs != 0.0)


class _SignedTerms(NamedTuple):
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


# Their derivatives, by power series in the distance from t


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
