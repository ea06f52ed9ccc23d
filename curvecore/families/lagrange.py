"""The interpolating polynomial, and its Lagrange basis functions as products, accurate for any parameters.

With l(t) = prod (t - t_j) and w_i = 1 / prod_(j != i) (t_i - t_j), the basis function is
L_i(t) = l(t) w_i / (t - t_i). Every factor is one subtraction of the given numbers, so l, w_i and L_i have
small *relative* errors however the parameters lie [1]_. The second barycentric form divides by a sum that
cancels, and lacks this property.

Three things keep the products in range. The parameters are scaled, by a power of two and hence without error,
to an interval of length about 4, whose capacity is 1, so that n factors have a product near 1 for well spread
parameters [2]_. Products run over blocks of rows that provably cannot leave the range. Between blocks,
mantissas and exponents are kept apart, and so they are between blocks of weights.

Derivatives have three ways, by what they cost:

- ``products`` has values and derivatives up to the third at the distances of parameters that are usual.
- Power series (`leave_one_out`) are as accurate while the distances differ by at most 1e50. With y the
  distance from t, prod_(j != i) (t - t_j + y) has the derivatives of L_i as its coefficients, but for
  factorials and the weight. The factor t - t_i is left out by a running product from the left times one from
  the right, not by a division: next to t_i the quotient of two series would cancel. A coefficient is a sum of
  products of both signs. With uneven parameters it can be thousands of times smaller than its terms, and for
  all i at once, so the series run in double-double arithmetic; what remains is the error of the weights.
- Many t at once (`derivatives_by_matrix`): the derivatives of a polynomial are polynomials of no higher
  degree. Known at the parameters, from the differentiation matrix, they are interpolated like points: a tenth
  of the time of differentiating the basis at every t [3]_.

References
----------
.. [1] N. J. Higham, "The numerical stability of barycentric Lagrange interpolation", IMA J. Numer. Anal. 24
   (2004) 547-556, theorem 3.1.
.. [2] J.-P. Berrut and L. N. Trefethen, "Barycentric Lagrange interpolation", SIAM Review 46 (2004) 501-517;
   section 7 on scaling, section 9.3 on the differentiation matrix.
.. [3] R. Baltensperger and M. R. Trummer, "Spectral differencing with a twist", SIAM J. Sci. Comput. 24
   (2003) 1465-1487: the matrix whose rows sum to 0.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arithmetic import (
    LARGEST,
    DoubleDouble,
    ExponentArray,
    Scaled,
    add,
    halved_difference,
    multiply,
    normalise,
    rescaled,
    scale_by_power,
    scaled_differences,
)
from curvecore.arrays import FloatArray, IntArray32, parameter_row
from curvecore.families.curve import ParametricCurve
from curvecore.families.defaults import Interpolant
from curvecore.families.products import (
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
from curvecore.families.same_shape import check_one_polynomial, pieces_of
from curvecore.parametrization import chebyshev, spread

_SURELY = 1e-3
"""Share of the sum of sizes from which on the sum of some terms is no rounding of them."""


class LagrangeCurve(ParametricCurve):
    """One polynomial through all points.

    Of degree n - 1: c(t) = sum over i of L_i(t) p_i with L_i(t_j) = 1 for
    i = j, else 0.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i, finite; n >= 2, dim >= 1. Copied.
    parameters : array_like, shape (n,)
        t_i, finite and strictly increasing. Copied.

    Raises
    ------
    CurveError
        If an argument does not have the shape or values above.

    See Also
    --------
    HermiteCurve : Cubic pieces, which follow many points calmly.
    chebyshev : Parameters at which many points do no harm.
    lebesgue_constant : How much harm they may do.

    Notes
    -----
    With u = 2**-53, values and derivatives differ from the exact ones by at
    most c u sum |L_i^(order)(t)| |p_i|, c at most about 25 for n <= 60 and of
    the size of 2 sqrt(n) above: values for any distinct parameters,
    derivatives where the longest distance between parameters is at most 1e50
    times the shortest. (Beyond, the terms of a derivative differ by more than
    the range of exponents that they share; from 1e60 on digits are lost, from
    1e90 on all of them.) That
    says nothing about the sum itself: on many uniform parameters it is huge,
    and no method can do better with points given to 53 bits.

    The first evaluation takes O(n**2) operations more than the later ones,
    which take O(n) per t; memory beyond the result is bounded. Results beyond the floating point range
    become the largest finite number of their sign.

    Examples
    --------
    >>> from curvecore import LagrangeCurve
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> curve
    LagrangeCurve(n=3, dim=2, domain=(0, 2))
    >>> curve(0.5).round(9).tolist()
    [0.25, 1.5]
    >>> curve.basis(0.5)[:, 0].round(9).tolist()
    [0.375, 0.75, -0.125]
    >>> curve.degree
    2
    """

    __slots__ = ("_form",)
    _caches = ("_form",)

    name = "lagrange"
    title = "Lagrange"
    rank = 10
    is_one_polynomial = True
    most_points = None

    _form: ProductForm | None

    @property
    def _product_form(self) -> ProductForm:
        # Made when first needed: what draws a curve under a hand often knows a shorter way.
        if self._form is None:
            self._form = ProductForm.of(self._parameters)
        return self._form

    def weight_ratios(self, index: int) -> FloatArray:
        """Return w_i / w_index for all i, with w_i = 1 / prod_(j != i) (t_i - t_j).

        Parameters
        ----------
        index : int
            From 0 to n - 1.

        Returns
        -------
        ndarray, shape (n,)
            Infinite or 0 beyond the range of floating point.
        """
        weights = self._product_form.weights
        mantissa = weights.mantissa / weights.mantissa[index]
        exponent = np.clip(weights.exponent - weights.exponent[index], -5000, 5000)
        with np.errstate(over="ignore", under="ignore"):
            return np.asarray(np.ldexp(mantissa, exponent.astype(np.intc)))

    @property
    def degree(self) -> int:
        """The degree n - 1."""
        return len(self._parameters) - 1

    @property
    def is_positive(self) -> bool:
        """Whether no L_i is negative in the domain: only those of a straight line are not."""
        return len(self._parameters) == 2

    def exact_pieces(self) -> FloatArray | None:
        """Return the control points of the one polynomial; None of more than 64 points."""
        from curvecore.bezier.conversion import bezier_stretch  # noqa: PLC0415 - it imports this module

        return bezier_stretch(self, *self.domain)[None] if self.has_exact_pieces else None

    @property
    def has_exact_pieces(self) -> bool:
        """Whether the curve has 64 points at most: the work grows with the fourth power."""
        from curvecore.bezier.conversion import MOST  # noqa: PLC0415 - it imports this module

        return len(self._parameters) <= MOST

    def surely_exceeds(self, degree: int) -> bool:
        """Return whether the leading coefficient is far more than rounding, and of a higher degree."""
        first, last = self.domain
        if degree >= self.degree or not self.has_exact_pieces:
            return False
        # On an interval of length 4 products of that many differences keep far from the ends of the range.
        with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
            t = 4.0 * ((self._parameters - first) / (last - first))
            steps = t[:, None] - t
            np.fill_diagonal(steps, 1.0)
            terms = self.points / np.prod(steps, axis=1)[:, None]
            return bool((np.abs(terms.sum(axis=0)) > _SURELY * np.abs(terms).sum(axis=0)).any())

    @classmethod
    def check_shape(cls, curve: ParametricCurve) -> None:
        """Raise where a curve is not one polynomial."""
        check_one_polynomial(curve, cls.title)

    @classmethod
    def same_shape_as(cls, curve: ParametricCurve) -> Self:
        """Return one polynomial through Chebyshev points of another way to write it."""
        cls.check_shape(curve)
        chain = pieces_of(curve, None, cls.title)
        t = spread(chebyshev(chain.controls.shape[1]), *curve.domain)
        return cls(curve.evaluate(t), t)

    def interpolants(self) -> list[Interpolant]:
        """Return the one polynomial: all points."""
        return [Interpolant(self._parameters, self._jets)]

    def derivatives_at(self, t: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
        """Return derivatives of several orders at many parameters.

        Of many t by a short cut: derivatives at the t_i, and interpolation of these. The errors are then up
        to max sum |L_i(t)| <= 1e5 times larger than those of `evaluate`.
        """
        if matrix_serves(self._parameters, self.points, t, orders):
            basis = self._finite_basis(t, 0)[:, :, 0]
            derivatives = derivatives_by_matrix(self._parameters, self.points, basis, orders)
            if derivatives is not None:
                return derivatives
        return super().derivatives_at(t, orders)

    def parameter_derivatives(self, t: ArrayLike) -> FloatArray:
        """Return dc(t)/dt_i = -L_i(t) c'(t_i), shape (m, n, dim)."""
        (velocity,) = self.derivatives_at(self._parameters, (1,))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            return -self._basis(parameter_row(t), 0)[:, :, None] * velocity

    def _evaluate(self, t: FloatArray, order: int) -> FloatArray:
        return self._product_form.sums(t, order, self.points)

    def _basis(self, t: FloatArray, order: int) -> FloatArray:
        """Return all basis functions, or their derivatives; each function lies contiguous in memory."""
        return self._product_form.functions(t, order).T

    def with_jets(self, jets: ArrayLike) -> Self:
        """Return the curve with other points; it shares everything that depends on the parameters."""
        curve = super().with_jets(jets)
        curve._form = self._product_form
        return curve


# Values: the basis functions as products

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

        Numbers may over- and underflow on the way: the caller sets `numpy.errstate`.

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
        """Return the functions' derivatives of an order at t, (n, m), limited to the largest number.

        The caller sets `numpy.errstate`.
        """
        result = np.empty((len(self.given), t.size))
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
        """Write the functions, (n, m), into `out`."""
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
        size = max(1, (_CHUNK >> min(order, 1)) // n)
        if order and not plain:
            size = max(64, _CHUNK // (n * (order + 1)))
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
        """Return the functions with an exponent for every factor."""
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


# Derivatives: products of truncated power series

_FAR_BITS = 60


class _RunningProducts(NamedTuple):
    """Products of the factors before each t_i, from both sides.

    Attributes
    ----------
    series : DoubleDouble, shape (n, 2, order + 1, m)
        ``[i, 0]`` is the series of the factors 0 .. i - 1 and ``[i, 1]`` that
        of the last i factors; the third axis is the power of y.
    exponent : ndarray of int, shape (n, 2, m)
        Powers of two that the series are to be multiplied by.
    """

    series: DoubleDouble
    exponent: ExponentArray


def leave_one_out(t: FloatArray, parameters: FloatArray, shift: int, order: int) -> Scaled:
    """Return the coefficients of y**order of prod_(j != i) (x - x_j + y).

    Parameters
    ----------
    t : ndarray, shape (m,)
        Parameters; x = ``t * 2**shift``.
    parameters : ndarray, shape (n,)
        t_j; x_j = ``t_j * 2**shift`` span a length of about 4.
    shift : int
        See above.
    order : int
        From 1 to n - 1.

    Returns
    -------
    Scaled, shape (n, m)
    """
    exact, halved = halved_difference(t, parameters)
    row_shift = _row_shift(exact.high, shift)
    factors = rescaled(exact, row_shift)
    running = _running_products(factors, order)
    high, low = running.series
    # Row i of the left products meets row n - 1 - i of the right ones.
    total = None
    for k in range(order + 1):
        term = multiply(
            DoubleDouble(high[:, 0, k], low[:, 0, k]),
            DoubleDouble(high[::-1, 1, order - k], low[::-1, 1, order - k]),
        )
        total = term if total is None else add(total, term)
    assert total is not None
    exponent = running.exponent[:, 0] + running.exponent[::-1, 1]
    # The coefficient has n - 1 - order factors.
    exponent += (shift - row_shift.astype(np.int64) + halved) * (len(parameters) - 1 - order)
    return Scaled(total.high + total.low, exponent)


def _row_shift(differences: FloatArray, shift: int) -> IntArray32:
    """Return the powers of two that bring the columns near 1: `shift`, but for t far outside."""
    _, size = np.frexp(np.abs(differences).max(axis=0))
    return np.where(size + shift > _FAR_BITS, -size, shift).astype(np.intc)


def _running_products(factors: DoubleDouble, order: int) -> _RunningProducts:
    n, m = factors.high.shape
    high = np.zeros((n, 2, order + 1, m))
    low = np.zeros((n, 2, order + 1, m))
    exponent = np.zeros((n, 2, m), dtype=np.int64)
    state = DoubleDouble(high[0], low[0])
    state.high[:, 0] = 1.0
    for i in range(1, n):
        # The next factor from the left beside the next from the right.
        pair = DoubleDouble(factors.high[[i - 1, n - i], None], factors.low[[i - 1, n - i], None])
        product = multiply(state, pair)
        raised = add(
            DoubleDouble(product.high[:, 1:], product.low[:, 1:]),
            DoubleDouble(state.high[:, :-1], state.low[:, :-1]),
        )
        product.high[:, 1:], product.low[:, 1:] = raised
        _, extra = np.frexp(np.abs(product.high).max(axis=1))
        high[i], low[i] = rescaled(product, -extra[:, None])
        np.add(exponent[i - 1], extra, out=exponent[i])
        state = DoubleDouble(high[i], low[i])
    return _RunningProducts(DoubleDouble(high, low), exponent)


# Derivatives at many t, by those at the parameters

_MATRIX_POINTS = 64  # parameters
_MATRIX_LEBESGUE = 1e5  # Lebesgue function above which the short cut loses more digits than a picture has
_MATRIX_LARGEST = 1e100


def matrix_serves(parameters: FloatArray, points: FloatArray, t: FloatArray, orders: tuple[int, ...]) -> bool:
    """Return whether the matrix is the faster way, and accurate for this spacing and these sizes."""
    if 2 * len(parameters) >= t.size or len(parameters) > _MATRIX_POINTS or max(orders) > 3:
        return False
    first, last = float(parameters[0]), float(parameters[-1])
    if not (first <= float(t.min()) and float(t.max()) <= last and last - first > 1.0 / _MATRIX_LARGEST):
        return False
    is_sized = float(np.abs(points).max()) < _MATRIX_LARGEST
    return is_sized and bool(np.diff(parameters).min() > 1e-9 * (last - first))


def derivatives_by_matrix(
    parameters: FloatArray, points: FloatArray, basis: FloatArray, orders: tuple[int, ...]
) -> list[FloatArray] | None:
    """Return derivatives where the basis functions are `basis`, (m, n); None where they grow too large."""
    if np.abs(basis).sum(axis=1).max() > _MATRIX_LEBESGUE:
        return None
    with np.errstate(under="ignore"):
        return [basis @ data for data in _at_parameters(parameters, points, orders)]


def _at_parameters(parameters: FloatArray, points: FloatArray, orders: tuple[int, ...]) -> list[FloatArray]:
    """Return the derivatives at the parameters themselves, shape (n, dim) each."""
    first, last = float(parameters[0]), float(parameters[-1])
    half = 0.25 * (last - first)
    x = (parameters - first) / half
    difference = x[:, None] - x
    np.fill_diagonal(difference, 1.0)
    weight = 1.0 / np.prod(difference, axis=1)
    matrix = weight / weight[:, None] / difference
    np.fill_diagonal(matrix, 0.0)
    row_sum = matrix.sum(axis=1)
    results = [points]
    for _ in range(max(orders)):
        previous = results[-1]
        # The row's own entry is minus the sum of the others: constants have derivative 0.
        results.append((matrix @ previous - row_sum[:, None] * previous) / half)
    return [results[order] for order in orders]
