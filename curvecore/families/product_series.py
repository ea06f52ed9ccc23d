"""Derivatives of the Lagrange basis: products of truncated power series.

With y the distance from t, prod_(j != i) (t - t_j + y) has L_i's derivatives as
its coefficients, but for factorials and the weight. The factor t - t_i is
left out by a running product from the left times one from the right, not by a
division: next to t_i the quotient of two series would cancel.

A coefficient is a sum of products of both signs. With uneven parameters it
can be thousands of times smaller than its terms, and for all i at once, so
the series run in double-double arithmetic; what remains is the error of the
weights.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import (
    DoubleDouble,
    ExponentArray,
    Scaled,
    add,
    halved_difference,
    multiply,
    rescaled,
)
from curvecore.arrays import FloatArray, IntArray32

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
    own = _own_shift(exact.high, shift)
    factors = rescaled(exact, own)
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
    exponent += (shift - own.astype(np.int64) + halved) * (len(parameters) - 1 - order)
    return Scaled(total.high + total.low, exponent)


def _own_shift(differences: FloatArray, shift: int) -> IntArray32:
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
