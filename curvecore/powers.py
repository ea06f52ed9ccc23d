"""Powers of numbers of 106 bits, to whole exponents."""

from __future__ import annotations

import numpy as np

from curvecore.double_double import DoubleDouble, multiply
from curvecore.scaling import Scaled

MULTIPLIED = 128
"""Powers up to this one are products one after the other, as quick as ten multiplications are to one `power`.

Their roundings, half a unit each and of either sign, come to some sqrt(128) / 3 units.
"""

_IN_RANGE = 1000
"""Powers of numbers between 0.7 and 1.4 up to this one are neither too large nor too small."""


def small_power(base: DoubleDouble, exponent: np.ndarray, most: int) -> DoubleDouble:
    """Return powers of (m, 1) numbers to whole exponents (n,) up to `most`, shape (m, n)."""
    high, low = np.ones((most + 1, len(base.high))), np.zeros((most + 1, len(base.high)))
    flat = DoubleDouble(base.high[:, 0], base.low[:, 0])
    for k in range(most):
        high[k + 1], low[k + 1] = multiply(DoubleDouble(high[k], low[k]), flat)
    return DoubleDouble(high[exponent].T, low[exponent].T)


def power(base: DoubleDouble, exponent: np.ndarray) -> Scaled:
    """Return powers of (m, 1) numbers of 106 bits to whole exponents (n,), shape (m, n).

    (a + b)**i is a**i (1 + i b / a) to all digits.
    """
    mantissa, shift = np.frexp(base.high)
    # Between 0.7 and 1.4, so that powers stay in range for long.
    low = np.abs(mantissa) < np.sqrt(0.5)
    mantissa, shift = np.where(low, 2.0 * mantissa, mantissa), (shift - low).astype(np.int64)
    with np.errstate(divide="ignore"):
        correction = 1.0 + exponent * np.where(base.high == 0.0, 0.0, base.low / base.high)
    most = int(exponent.max(initial=0))
    if most <= MULTIPLIED:
        table = np.ones((len(mantissa), most + 1))
        table[:, 1:] = mantissa
        powers = np.multiply.accumulate(table, axis=1)[:, exponent]
        return Scaled(powers * correction, shift * exponent)
    steps, rest = np.divmod(exponent, _IN_RANGE)
    step, per_step = np.frexp(np.power(mantissa, float(_IN_RANGE)))
    powers, carried = np.frexp(np.power(step, steps) * np.power(mantissa, rest.astype(np.float64)))
    return Scaled(powers * correction, shift * exponent + per_step * steps + carried)
