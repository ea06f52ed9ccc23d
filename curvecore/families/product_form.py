"""Lagrange basis functions as products, with values accurate for any distinct parameters.

With l(t) = prod (t - t_j) and w_i = 1 / prod_(j != i) (t_i - t_j), the basis
function is L_i(t) = l(t) w_i / (t - t_i). Every factor is one subtraction of
the given numbers, so l, w_i and L_i have small *relative* errors however the
parameters lie [1]_. The second barycentric form divides by a sum that cancels, and
lacks this property.

Three things keep the products in range. The parameters are scaled, by a power of
two and hence without error, to an interval of length about 4, whose capacity
is 1, so that n factors have a product near 1 for well spread parameters. Products
run over blocks of rows that provably cannot leave the range. Between blocks,
mantissas and exponents are kept apart.

Derivatives are the business of `product_series`, and are as accurate while
the distances of parameters differ by at most 1e50.

References
----------
.. [1] N. J. Higham, "The numerical stability of barycentric Lagrange
   interpolation", IMA J. Numer. Anal. 24 (2004) 547-556, theorem 3.1.
.. [2] J.-P. Berrut and L. N. Trefethen, "Barycentric Lagrange
   interpolation", SIAM Review 46 (2004) 501-517; section 7 on scaling.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from curvecore.arrays import FloatArray, IntArray
from curvecore.families.product_series import leave_one_out
from curvecore.scaling import ExponentArray, Scaled

_CHUNK = 1 << 18  # entries of one working array: 2 MB, so that a slice is worth its dozen calls
_BLOCK_BITS = 500.0  # a block of factors may reach 2**+-500, which leaves room for its neighbours
_MANY = 64  # parameters, above which roundings that do not average out are worth half the time again
_TINY = 2.0**-340  # scaled distances below need exponents of their own
_FAR = 2.0**60  # so do those above


class Hits(NamedTuple):
    """Values of t that are parameters: t[columns] == parameters[rows]."""

    columns: IntArray
    rows: IntArray


class BasisPart(NamedTuple):
    """Basis functions for a slice of t.

    Attributes
    ----------
    where : slice
        Which t.
    values : ndarray, shape (n, m)
        L_i, or a derivative of it, in row i.
    exponent : ndarray of int, shape (n, m), or None
        Powers of two that the values are to be multiplied by; None is 0.
    hits : Hits
        Columns are counted within the slice.
    """

    where: slice
    values: FloatArray
    exponent: ExponentArray | None
    hits: Hits


class ProductForm(NamedTuple):
    """The product form of all basis functions of given parameters.

    Attributes
    ----------
    given : ndarray, shape (n,)
        The parameters.
    scaled : ndarray, shape (n,)
        ``given * 2**shift``, spanning a length of about 4.
    shift : int
        See `scaled`.
    least_bits : float
        -log2 of half the least gap in `scaled`: no parameter but the nearest to
        some t is closer to it than ``2**-least_bits``.
    weights : Scaled
        w_i for the scaled parameters.
    plain_weights : ndarray, shape (n,), or None
        ``w_i / 2**plain_exponent`` if these fit in 2**+-450.
    plain_exponent : int
        See `plain_weights`.
    """

    given: FloatArray
    scaled: FloatArray
    shift: int
    least_bits: float
    weights: Scaled
    plain_weights: FloatArray | None
    plain_exponent: int

    @classmethod
    def of(cls, parameters: FloatArray) -> ProductForm:
        """Prepare checked parameters; O(n**2) operations, O(n) memory."""
        mantissa, exponent = math.frexp(float(parameters[-1]) - float(parameters[0]))
        shift = (3 if mantissa < math.sqrt(0.5) else 2) - exponent
        with np.errstate(under="ignore"):
            scaled = np.ldexp(parameters, shift)
        gap = float(np.diff(parameters).min())
        least_bits = 1.0 - math.log2(gap) - shift
        if least_bits < _BLOCK_BITS:
            weights = _weights(scaled, least_bits)
        else:
            weights = _weights_far_apart(parameters, shift)
        low, high = int(weights.exponent.min()), int(weights.exponent.max())
        middle = (low + high) // 2
        plain = None
        # Parameters that are all but zero relative to the length are left to the general method.
        if high - low <= 800 and not _has_tiny(scaled, parameters):
            plain = np.ldexp(weights.mantissa, (weights.exponent - middle).astype(np.intc))
        return cls(parameters, scaled, shift, least_bits, weights, plain, middle)

    def basis_parts(self, t: FloatArray, order: int, out: FloatArray | None = None) -> Iterator[BasisPart]:
        """Yield all basis functions at t, a slice of t at a time.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.
        order : int
            Order of the derivative with respect to t.
        out : ndarray, shape (n, m), optional
            Where plain values may be put; without it, the arrays of one
            part are overwritten by the next.

        Notes
        -----
        Numbers may over- and underflow on the way: the caller sets
        `numpy.errstate`, which a generator cannot without leaking it.
        """
        x = np.ldexp(t, self.shift)
        reach = _reach(x, self.scaled) if t.size else 1.0
        plain = self.plain_weights is not None and reach < _FAR and not _has_tiny(x, t)
        n = len(self.given)
        # A series costs a Python loop over the parameters for each slice: not too few columns.
        size = max(64, _CHUNK // (n * (order + 1))) if order else max(1, _CHUNK // n)
        buffer = np.empty((n, min(size, t.size))) if out is None and plain and not order else None
        for start in range(0, t.size, size):
            where = slice(start, min(start + size, t.size))
            hits = self._hits(t[where])
            values, exponent = None, None
            if order:
                values, exponent = self._derivatives(t[where], order)
            elif plain:
                into = out[:, where] if out is not None else buffer[:, : where.stop - start]  # type: ignore[index]
                values = self._plain(x[where], hits, reach, into)
            if values is None:
                values, exponent = self._general(t[where], hits)
            yield BasisPart(where, values, exponent, hits)

    def _hits(self, t: FloatArray) -> Hits:
        nearest = np.searchsorted(self.given[:-1], t)
        columns = np.flatnonzero(self.given[nearest] == t)
        return Hits(columns, nearest[columns])

    def _plain(self, x: FloatArray, hits: Hits, reach: float, out: FloatArray) -> FloatArray | None:
        """Order 0 where all quantities of one column fit in one double; None if they do not."""
        assert self.plain_weights is not None
        difference = np.subtract(x, self.scaled[:, None], out=out)
        difference[hits.rows, hits.columns] = 1.0
        total = _column_product(difference, _block(max(math.log2(reach), self.least_bits)))
        # sum |L_i| >= 1 bounds this exponent from below by about -900.
        exponent = total.exponent + self.plain_exponent
        if exponent.size and int(exponent.max()) > _BLOCK_BITS:
            return None
        common = np.ldexp(total.mantissa, exponent.astype(np.intc))
        if len(self.scaled) > _MANY:
            common *= 1.0 + _rounding_of_product(x, self.scaled, difference, hits)
        values = np.divide(self.plain_weights[:, None], difference, out=out)
        values *= common
        _put_units(values, hits)
        return values

    def _general(self, t: FloatArray, hits: Hits) -> Scaled:
        """Order 0 with an exponent for every factor."""
        difference, total = _differences_and_product(t, self.given, self.shift, hits)
        values = (self.weights.mantissa[:, None] / difference.mantissa) * total.mantissa
        exponent = self.weights.exponent[:, None] - difference.exponent + total.exponent
        _put_units(values, hits)
        exponent[:, hits.columns] = 0
        return Scaled(values, exponent)

    def _derivatives(self, t: FloatArray, order: int) -> Scaled:
        """Return the functions' derivatives of an order from 1 on."""
        shape = len(self.given), t.size
        if order >= len(self.given):
            return Scaled(np.zeros(shape), np.zeros(shape, dtype=np.int64))
        coefficient = leave_one_out(t, self.given, self.shift, order)
        values = coefficient.mantissa * (self.weights.mantissa[:, None] * math.factorial(order))
        return Scaled(values, coefficient.exponent + self.weights.exponent[:, None] + order * self.shift)


def _rounding_of_product(
    x: FloatArray, parameters: FloatArray, difference: FloatArray, hits: Hits
) -> FloatArray:
    """Return the relative error that rounded differences leave in their product.

    A parameter t_i larger than x has coarser digits, so the difference loses the same
    last bits of x for all such parameters: these roundings do not average out, and
    add up to about n u / 4. Parameters smaller than x, whose roundings are as good
    as independent, may come out as 0 here.
    """
    rest = difference + parameters[:, None]
    np.subtract(x, rest, out=rest)
    rest[hits.rows, hits.columns] = 0.0
    rest /= difference
    error: FloatArray = rest.sum(axis=0)
    return error


def _column_product(factors: FloatArray, block: int) -> Scaled:
    """Multiply the rows, `block` of them at a time before their exponents are set apart."""
    whole = len(factors) // block * block
    products = np.multiply.reduce(factors[:whole].reshape(-1, block, factors.shape[1]), axis=1)
    if whole < len(factors):
        products = np.append(products, np.multiply.reduce(factors[whole:], axis=0)[None], axis=0)
    mantissas, exponents = np.frexp(products)
    exponent = exponents.sum(axis=0, dtype=np.int64)
    if len(mantissas) == 1:
        return Scaled(mantissas[0], exponent)
    rest = _column_product(mantissas, _block(1.0))
    return Scaled(rest.mantissa, rest.exponent + exponent)


def _block(bits: float) -> int:
    """Return how many factors of at most 2**+-bits one block may hold."""
    return max(1, int(_BLOCK_BITS / max(bits, 1.0)))


def _weights(scaled: FloatArray, least_bits: float) -> Scaled:
    n = len(scaled)
    size = max(1, _CHUNK // n)
    block = _block(max(3.0, least_bits))
    products = []
    for start in range(0, n, size):
        where = slice(start, min(start + size, n))
        difference = scaled[where] - scaled[:, None]
        columns = np.arange(where.stop - start)
        hits = Hits(columns, start + columns)
        difference[hits.rows, hits.columns] = 1.0
        product = _column_product(difference, block)
        if n > _MANY:
            product.mantissa[:] *= 1.0 + _rounding_of_product(scaled[where], scaled, difference, hits)
        products.append(product)
    return _reciprocals(products)


def _weights_far_apart(parameters: FloatArray, shift: int) -> Scaled:
    """Weights with an exponent for every factor."""
    hits = [Hits(np.array([0]), np.array([i])) for i in range(len(parameters))]
    columns = zip(parameters[:, None], hits, strict=True)
    return _reciprocals([_differences_and_product(t, parameters, shift, hit)[1] for t, hit in columns])


def _reciprocals(products: list[Scaled]) -> Scaled:
    mantissa, exponent = (np.concatenate(column) for column in zip(*products, strict=True))
    return Scaled(1.0 / mantissa, -exponent)


def _differences_and_product(
    t: FloatArray, parameters: FloatArray, shift: int, hits: Hits
) -> tuple[Scaled, Scaled]:
    """Return (t - t_i) * 2**shift, (n, m), with 1 in place of 0, and the products of the columns."""
    difference = _scaled_differences(t, parameters, shift)
    difference.mantissa[hits.rows, hits.columns] = 0.5
    difference.exponent[hits.rows, hits.columns] = 1
    total = _column_product(difference.mantissa, _block(1.0))
    return difference, Scaled(total.mantissa, total.exponent + difference.exponent.sum(axis=0))


def _scaled_differences(t: FloatArray, parameters: FloatArray, shift: int) -> Scaled:
    """Return (t - t_i) * 2**shift, shape (n, m)."""
    difference = t - parameters[:, None]
    mantissa, size = np.frexp(difference)
    exponent = size.astype(np.int64) + shift
    overflow = np.isinf(difference)
    if overflow.any():
        halved, size = np.frexp(0.5 * t - 0.5 * parameters[:, None])
        mantissa = np.where(overflow, halved, mantissa)
        exponent = np.where(overflow, size.astype(np.int64) + (shift + 1), exponent)
    return Scaled(mantissa, exponent)


def _reach(x: FloatArray, scaled: FloatArray) -> float:
    """Return at least the largest distance of any x from any parameter."""
    low, high = float(x.min()), float(x.max())
    return max(high - float(scaled[0]), float(scaled[-1]) - low, 4.0)


def _has_tiny(x: FloatArray, t: FloatArray) -> bool:
    """Tell whether some t is not 0 but x, t scaled, is as good as 0."""
    small = np.abs(x) < _TINY
    return bool(small.any()) and bool((small & (t != 0.0)).any())


def _put_units(values: FloatArray, hits: Hits) -> None:
    values[:, hits.columns] = 0.0
    values[hits.rows, hits.columns] = 1.0
