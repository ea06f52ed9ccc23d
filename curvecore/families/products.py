"""Products over many parameters whose factors need no exponents of their own, and their derivatives.

Where the distances of t to all t_j fit in doubles, L_i and its derivatives up to the third are a number for
all i, a product, times a weight of i alone, times an entry of a matrix, the kernel. With t_k the parameter
nearest to t, l_k the product of t - t_j over the others, r_j = 1 / (t - t_j), and e_m the sum of all products
of m different r_j without r_k,

    L_i(t) = l(t) w_i r_i                                                        l(t) = prod (t - t_j)
    L_i^(m)(t) = m! l_k(t) w_i r_i (A_m - r_i (A_(m-1) - r_i (... A_0)))         for i != k
    L_k^(m)(t) = m! l_k(t) w_k e_m

where A_0 + A_1 y + A_2 y**2 + ... = (t - t_k + y) (1 + e_1 y + e_2 y**2 + ...). The sums, and brackets that
nearly cancel, are formed in double-double arithmetic: a tenth of the time of the power series of ``lagrange``
and less.

Working arrays are kept from call to call (`working_memory`). The system clears every page of memory when it
is first touched, and large arrays go back to it at once: for 10,000 parameters of a cubic that took six times
as long as the arithmetic.
"""

from __future__ import annotations

import math
import threading
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import DoubleDouble, Scaled, add, divide, multiply, put_product_error
from curvecore.arrays import FloatArray, IntArray

_BLOCK_BITS = 500.0  # a block of factors may reach 2**+-500, which leaves room for its neighbours
_MANY = 64  # parameters, above which roundings that do not average out are worth half the time again
_SPAN = 400  # powers of two that the weights of one block may differ by
_CANCELLED = 0.125  # of its terms: what is left of a sum that is computed anew


class Hits(NamedTuple):
    """Values of t that are parameters: t[columns] == parameters[rows]."""

    columns: IntArray
    rows: IntArray


class Kernel(NamedTuple):
    """A matrix, and a number for each of its columns.

    Attributes
    ----------
    values : ndarray, shape (n, m)
        Without the weights of the rows.
    common : Scaled, shape (m,)
        What all values of a column are to be multiplied by.
    """

    values: FloatArray
    common: Scaled


class WeightBlock(NamedTuple):
    """Neighbouring parameters whose weights fit in one range of doubles.

    Attributes
    ----------
    rows : slice
    weights : ndarray, shape (k,)
        ``w_i / 2**exponent``.
    exponent : int
    """

    rows: slice
    weights: FloatArray
    exponent: int


def weight_blocks(weights: Scaled) -> list[WeightBlock]:
    """Return all weights in blocks, each as long as fits, from the first weight on."""
    blocks, start = [], 0
    exponents = weights.exponent
    while start < len(exponents):
        rest = exponents[start:]
        span = np.maximum.accumulate(rest) - np.minimum.accumulate(rest)
        rows = slice(start, start + int(np.searchsorted(span, _SPAN, side="right")))
        some = exponents[rows]
        middle = (int(some.min()) + int(some.max())) // 2
        plain = np.ldexp(weights.mantissa[rows], (some - middle).astype(np.intc))
        blocks.append(WeightBlock(rows, plain, middle))
        start = rows.stop
    return blocks


def value_kernel(x: FloatArray, scaled: FloatArray, hits: Hits, bits: float, out: FloatArray) -> Kernel:
    """Return the kernel of the functions themselves, in `out`; it has no meaning where t is a parameter.

    Parameters
    ----------
    x, scaled : ndarray, shapes (m,) and (n,)
        t and the parameters, scaled.
    hits : Hits
    bits : float
        No difference of x and a parameter, but the least, is beyond 2**+-bits.
    out : ndarray, shape (n, m)
    """
    distances = np.subtract(x, scaled[:, None], out=out)
    distances[hits.rows, hits.columns] = 1.0
    common = column_product(distances, block_of(bits))
    if len(scaled) <= _MANY:
        return Kernel(np.reciprocal(distances, out=out), common)
    lost = lost_in_differences(x, scaled, distances, hits)
    values = np.reciprocal(distances, out=out)
    common.mantissa[:] *= 1.0 + np.einsum("nm,nm->m", lost, values)
    return Kernel(values, common)


def lost_in_differences(x: FloatArray, scaled: FloatArray, distances: FloatArray, hits: Hits) -> FloatArray:
    """Return the rounding errors of differences, (n, m).

    A parameter larger than x has coarser digits, so the difference loses the same last bits of x for all such
    parameters: these roundings do not average out, and add up to about n u / 4 in their product. Those of
    smaller parameters, which are as good as independent, may come out as 0 here.
    """
    rest = distances + scaled[:, None]
    np.subtract(x, rest, out=rest)
    rest[hits.rows, hits.columns] = 0.0
    return rest


def derivative_kernel(x: FloatArray, scaled: FloatArray, order: int, bits: float, out: FloatArray) -> Kernel:
    """Return the kernel of the derivatives by x, of order 1 to 3, in `out`; see `value_kernel`."""
    # Arrays as large as the kernel: fresh from the system, they would take longer than what is done to them.
    room = working_memory((9, *out.shape))
    columns, distances = np.arange(x.size), _exact_differences(x, scaled, room[:2], room[2])
    nearest = np.abs(distances.high, out=room[2]).argmin(axis=0)
    nearest_distance = DoubleDouble(*(part[nearest, columns] for part in distances))
    for part, instead in zip(distances, (1.0, 0.0), strict=True):
        part[nearest, columns] = instead
    common = column_product(distances.high, block_of(bits))
    reciprocals = _reciprocals(distances, out, room[2:8])
    # What is left of the low parts now are the relative roundings of the distances.
    common.mantissa[:] *= math.factorial(order) * (1.0 + distances.low.sum(axis=0))
    for part in reciprocals:
        part[nearest, columns] = 0.0
    one = _plain(np.ones_like(nearest_distance.high))
    series = _elementary(_power_sums(reciprocals, order, room), one)
    products = [
        nearest_distance,
        *(add(multiply(nearest_distance, part), less) for less, part in pairwise(series)),
    ]
    bracket = _brackets(products, reciprocals, room)
    values = np.multiply(reciprocals.high, bracket, out=out)
    values[nearest, columns] = series[order].high
    return Kernel(values, common)


def _power_sums(numbers: DoubleDouble, order: int, room: FloatArray) -> list[DoubleDouble]:
    """Return the sums over the rows of the numbers, their squares and so on; room[2] holds the low parts."""
    sums, power = [_column_sums(numbers, room[3:5])], numbers
    for k in range(2, order + 1):
        high, low = (room[0], room[1]) if k == 2 else (room[3], room[8])
        np.multiply(power.high, numbers.high, out=high)
        put_product_error(power.high, numbers.high, high, low, room[4:8])
        for first, second in ((power.high, numbers.low), (power.low, numbers.high)):
            np.multiply(first, second, out=room[4])
            low += room[4]
        power = DoubleDouble(high, low)
        sums.append(_column_sums(power, room[4:6]))
    return sums


def _elementary(sums: list[DoubleDouble], one: DoubleDouble) -> list[DoubleDouble]:
    """Return the sums of products of no, one, two ... different numbers, by Newton's identities."""
    functions = [one]
    for k in range(1, len(sums) + 1):
        total = _plain(np.zeros_like(one.high))
        for j in range(1, k + 1):
            term = multiply(functions[k - j], sums[j - 1])
            total = add(total, term if j % 2 else DoubleDouble(-term.high, -term.low))
        functions.append(divide(total, _plain(np.full_like(one.high, k))) if k > 1 else total)
    return functions


def _exact_differences(x: FloatArray, scaled: FloatArray, out: FloatArray, spare: FloatArray) -> DoubleDouble:
    """Return x minus the parameters, without any error."""
    high, low = out
    parameters = scaled[:, None]
    np.subtract(x, parameters, out=high)
    rest = np.subtract(high, x, out=spare)
    np.subtract(high, rest, out=low)
    np.subtract(x, low, out=low)
    rest += parameters
    low -= rest
    return DoubleDouble(high, low)


def _reciprocals(numbers: DoubleDouble, out: FloatArray, room: FloatArray) -> DoubleDouble:
    """Return the reciprocals, the high parts in `out`; the low parts of the numbers are divided by them."""
    high, low = numbers
    reciprocal = np.reciprocal(high, out=out)
    product, error = np.multiply(high, reciprocal, out=room[0]), room[1]
    put_product_error(high, reciprocal, product, error, room[2:])
    low *= reciprocal
    rest = np.subtract(1.0, product, out=product)
    rest -= error
    rest -= low
    rest *= reciprocal
    return DoubleDouble(reciprocal, rest)


def _column_sums(numbers: DoubleDouble, room: FloatArray) -> DoubleDouble:
    """Return the sums over the rows."""
    total, (rest, leading) = _plain(np.zeros(numbers.high.shape[1])), room
    _, exponent = np.frexp(np.abs(numbers.high, out=rest).max(axis=0))
    rest[:] = numbers.high
    for level in (0, 1):
        # Cut at one digit, the same for a column, the leading parts add up without a rounding.
        exponent += len(rest).bit_length() - 53 * level
        unit = np.ldexp(1.0, exponent)
        np.add(rest, unit, out=leading)
        leading -= unit
        rest -= leading
        total = add(total, _plain(leading.sum(axis=0)))
    rest += numbers.low
    return add(total, _plain(rest.sum(axis=0)))


def _brackets(products: list[DoubleDouble], reciprocals: DoubleDouble, room: FloatArray) -> FloatArray:
    """Return products[m] - r (products[m - 1] - r (...)) for all r, with a small relative error."""
    bracket: FloatArray = room[0]
    size, spare = room[1], room[3]
    lowest, *others = products
    factor = np.abs(reciprocals.high, out=room[4])
    np.multiply(reciprocals.high, lowest.high, out=bracket)
    np.abs(bracket, out=size)
    for k, other in enumerate(others):
        if k:
            bracket *= reciprocals.high
            size *= factor
        np.subtract(other.high, bracket, out=bracket)
        size += np.abs(other.high)
    size *= _CANCELLED
    np.abs(bracket, out=spare)
    rows, columns = np.nonzero(spare < size)
    if rows.size:
        total = DoubleDouble(*(other[columns] for other in lowest))
        negative = DoubleDouble(*(-other[rows, columns] for other in reciprocals))
        for other in others:
            total = add(DoubleDouble(*(part[columns] for part in other)), multiply(negative, total))
        bracket[rows, columns] = total.high
    return bracket


def _plain(values: FloatArray) -> DoubleDouble:
    return DoubleDouble(values, np.zeros_like(values))


def column_product(factors: FloatArray, block: int) -> Scaled:
    """Multiply the rows, `block` of them at a time before their exponents are set apart."""
    whole = len(factors) // block * block
    products = np.multiply.reduce(factors[:whole].reshape(-1, block, factors.shape[1]), axis=1)
    if whole < len(factors):
        products = np.append(products, np.multiply.reduce(factors[whole:], axis=0)[None], axis=0)
    mantissas, exponents = np.frexp(products)
    exponent = exponents.sum(axis=0, dtype=np.int64)
    if len(mantissas) == 1:
        return Scaled(mantissas[0], exponent)
    rest = column_product(mantissas, block_of(1.0))
    return Scaled(rest.mantissa, rest.exponent + exponent)


def block_of(bits: float) -> int:
    """Return the number of factors of at most 2**+-bits that one block may hold."""
    return max(1, int(_BLOCK_BITS / max(bits, 1.0)))


# Memory for working arrays

_MOST_NUMBERS = 1 << 19  # numbers that are kept, for each thread: 4 MB


class _Memory(threading.local):
    """The memory of one thread."""

    numbers: FloatArray = np.empty(0)


_memory = _Memory()


def working_memory(shape: tuple[int, ...]) -> FloatArray:
    """Return an array with arbitrary content, valid until the same thread asks for the next one."""
    size = math.prod(shape)
    if size > _MOST_NUMBERS:
        return np.empty(shape)
    if size > _memory.numbers.size:
        _memory.numbers = np.empty(size)
    return _memory.numbers[:size].reshape(shape)
