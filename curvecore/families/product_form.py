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
mantissas and exponents are kept apart, and so they are between blocks of weights.

Derivatives are the business of `product_series`, and are as accurate while
the distances of parameters differ by at most 1e50; `product_kernels` is the faster way to
values and derivatives up to the third at the distances that are usual.

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

from curvecore.arithmetic import LARGEST, Scaled, normalise, scale_by_power, scaled_differences
from curvecore.arrays import FloatArray
from curvecore.families.product_kernels import (
    Hits,
    Kernel,
    WeightBlock,
    block_of,
    column_product,
    derivative_kernel,
    lost_in_differences,
    value_kernel,
    weight_blocks,
)
from curvecore.families.product_series import leave_one_out

_CHUNK = 1 << 17  # entries of one working array: a megabyte, for slices worth their dozens of calls
_MOST_BITS = 500.0  # of the least distance, up to which differences need no exponents of their own
_DERIVATIVE_BITS = {1: 30.0, 2: 30.0, 3: 20.0}  # the same for derivatives: what cancels keeps its digits
_MANY = 64  # parameters, above which roundings that do not average out are worth half the time again
_TINY = 2.0**-340  # scaled distances below need exponents of their own
_FAR = 2.0**60  # so do those above
_EXPONENT = 2000  # beyond, every number is 0 or infinite
_SAFE = 300  # up to here, weights and reciprocal distances stay in range


class _Part(NamedTuple):
    """Basis functions for a slice of t: without their weights, or else with exponents of their own.

    Attributes
    ----------
    where : slice
        Which t.
    hits : Hits
        Columns are counted within the slice.
    kernel : Kernel or None
    functions : Scaled, shape (n, m), or None
        L_i, or a derivative of it, in row i.
    """

    where: slice
    hits: Hits
    kernel: Kernel | None
    functions: Scaled | None


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
    blocks : list of WeightBlock
        The same; empty where distances need exponents of their own.
    """

    given: FloatArray
    scaled: FloatArray
    shift: int
    least_bits: float
    weights: Scaled
    blocks: list[WeightBlock]

    @classmethod
    def of(cls, parameters: FloatArray) -> ProductForm:
        """Prepare checked parameters; O(n**2) operations, O(n) memory."""
        mantissa, exponent = math.frexp(float(parameters[-1]) - float(parameters[0]))
        shift = (3 if mantissa < math.sqrt(0.5) else 2) - exponent
        with np.errstate(under="ignore"):
            scaled = np.ldexp(parameters, shift)
        gap = float(np.diff(parameters).min())
        least_bits = 1.0 - math.log2(gap) - shift
        if least_bits < _MOST_BITS:
            weights = _weights(scaled, least_bits)
        else:
            weights = _weights_far_apart(parameters, shift)
        # Parameters that are all but zero relative to the length are left to the general method.
        is_plain = least_bits < _MOST_BITS and not _has_tiny(scaled, parameters)
        return cls(parameters, scaled, shift, least_bits, weights, weight_blocks(weights) if is_plain else [])

    def sums(self, t: FloatArray, order: int, data: FloatArray) -> FloatArray:
        """Return the sums of the functions' derivatives times data, limited to the largest number.

        Parameters
        ----------
        t : ndarray, shape (m,)
            Finite.
        order : int
            Order of the derivative with respect to t.
        data : ndarray, shape (n, dim)

        Returns
        -------
        ndarray, shape (m, dim)
            At order 0, where t is a parameter, the data there.
        """
        if order == 0:
            hits = self._hits(t)
            if 8 * hits.columns.size > t.size:
                # Many are parameters, as among the samples of a polyline: they take no arithmetic.
                others = np.ones(t.size, dtype=np.bool_)
                others[hits.columns] = False
                result = np.empty((t.size, data.shape[1]))
                result[hits.columns] = data[hits.rows]
                result[others] = self.sums(t[others], order, data)
                return result
        result = np.empty((t.size, data.shape[1]))
        # Bringing the data near 1 keeps a sum of large terms that cancel in range.
        _, size = np.frexp(np.abs(data).max(axis=0))
        with np.errstate(over="ignore", under="ignore"):
            near = np.ldexp(data, -size)
            weighted = [(near[block.rows] * block.weights[:, None]).T for block in self.blocks]
            for part in self._parts(t, order):
                if part.kernel is None:
                    assert part.functions is not None
                    values, exponent = normalise(part.functions)
                    sums = Scaled(near.T @ values, np.broadcast_to(exponent, (data.shape[1], exponent.size)))
                else:
                    sums = self._kernel_sums(part.kernel, weighted, order)
                result[part.where] = scale_by_power(sums.mantissa, sums.exponent + size[:, None]).T
        # A sum that is 0 has the sign of the product that it is multiplied by.
        result += 0.0
        if order == 0:
            result[hits.columns] = data[hits.rows]
        return result

    def functions(self, t: FloatArray, order: int) -> FloatArray:
        """Return the functions' derivatives of an order at t, (n, m), limited to the largest number."""
        result = np.empty((len(self.given), t.size))
        with np.errstate(over="ignore", under="ignore"):
            for part in self._parts(t, order):
                values = result[:, part.where]
                if part.kernel is None:
                    assert part.functions is not None
                    values[:] = scale_by_power(*part.functions)
                else:
                    self._put_functions(part.kernel, order, values)
                if order == 0:
                    _put_units(values, part.hits)
        return result

    def _kernel_sums(self, kernel: Kernel, weighted: list[FloatArray], order: int) -> Scaled:
        """Return the sums of data times functions, given the data times weights, (dim, m)."""
        others = kernel.common.exponent + order * np.int64(self.shift)
        products = [
            data @ kernel.values[block.rows] for block, data in zip(self.blocks, weighted, strict=True)
        ]
        if len(products) == 1:
            return Scaled(products[0] * kernel.common.mantissa, others + self.blocks[0].exponent)
        mantissa, extra = np.frexp(np.stack(products))
        exponent = extra + np.array([block.exponent for block in self.blocks])[:, None, None]
        # A zero has no exponent of its own and must not decide.
        common = np.where(mantissa != 0.0, exponent, exponent.min()).max(axis=0)
        total = np.ldexp(mantissa, np.maximum(exponent - common, -_EXPONENT).astype(np.intc)).sum(axis=0)
        return Scaled(total * kernel.common.mantissa, common + others)

    def _put_functions(self, kernel: Kernel, order: int, out: FloatArray) -> None:
        """Write the functions, (n, m)."""
        mantissa, exponent = kernel.common
        largest = 0
        for block in self.blocks:
            values = np.multiply(kernel.values[block.rows], block.weights[:, None], out=out[block.rows])
            others = np.clip(exponent + (block.exponent + order * self.shift), -_EXPONENT, _EXPONENT)
            largest = max(largest, int(np.abs(others).max(initial=0)))
            half = others.astype(np.intc) // 2 if largest > _SAFE else np.intc(0)
            values *= np.ldexp(mantissa, others.astype(np.intc) - half)
            if largest > _SAFE:
                values *= np.ldexp(1.0, half)
        if largest > _SAFE and not np.isfinite(out).all():
            np.clip(out, -LARGEST, LARGEST, out=out)

    def _parts(self, t: FloatArray, order: int) -> Iterator[_Part]:
        """Yield all functions at t, a slice of t at a time; the arrays of one may be overwritten by the next.

        Numbers may over- and underflow on the way: the caller sets `numpy.errstate`, which a generator cannot
        without leaking it.
        """
        n, x = len(self.given), np.ldexp(t, self.shift)
        reach = _reach(x, self.scaled) if t.size else 1.0
        plain = bool(self.blocks) and reach < _FAR and not _has_tiny(x, t)
        if order:
            plain = plain and order < n and self.least_bits < _DERIVATIVE_BITS.get(order, 0.0)
        # A series costs a Python loop over the parameters for each slice: not too few columns.
        size = (
            max(1, (_CHUNK >> min(order, 1)) // n)
            if plain or not order
            else max(64, _CHUNK // (n * (order + 1)))
        )
        room = np.empty((n, min(size, t.size))) if plain else None
        for start in range(0, t.size, size):
            where = slice(start, min(start + size, t.size))
            hits = self._hits(t[where])
            if room is None:
                functions = self._derivatives(t[where], order) if order else self._general(t[where], hits)
                yield _Part(where, hits, None, functions)
                continue
            bits, out = max(math.log2(reach), self.least_bits), room[:, : where.stop - start]
            if order:
                yield _Part(where, hits, derivative_kernel(x[where], self.scaled, order, bits, out), None)
            else:
                yield _Part(where, hits, value_kernel(x[where], self.scaled, hits, bits, out), None)

    def _hits(self, t: FloatArray) -> Hits:
        nearest = self.given[:-1].searchsorted(t)
        (columns,) = (self.given[nearest] == t).nonzero()
        return Hits(columns, nearest[columns])

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


def _weights(scaled: FloatArray, least_bits: float) -> Scaled:
    n = len(scaled)
    size = max(1, _CHUNK // n)
    block = block_of(max(3.0, least_bits))
    products = []
    for start in range(0, n, size):
        where = slice(start, min(start + size, n))
        difference = scaled[where] - scaled[:, None]
        columns = np.arange(where.stop - start)
        hits = Hits(columns, start + columns)
        difference[hits.rows, hits.columns] = 1.0
        product = column_product(difference, block)
        if n > _MANY:
            lost = lost_in_differences(scaled[where], scaled, difference, hits)
            product.mantissa[:] *= 1.0 + (lost / difference).sum(axis=0)
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
    difference = scaled_differences(t, parameters, shift)
    difference.mantissa[hits.rows, hits.columns] = 0.5
    difference.exponent[hits.rows, hits.columns] = 1
    total = column_product(difference.mantissa, block_of(1.0))
    return difference, Scaled(total.mantissa, total.exponent + difference.exponent.sum(axis=0))


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
