"""Bezier curves of high degree: the few hundred Bernstein functions that count at a place.

B_i(x) is the chance of i heads among N tosses, which lie within some sqrt(N) of N x: by Hoeffding's
inequality all functions with |i - N x| >= W add up to 2 exp(-2 W**2 / N) at most [1]_.

References
----------
.. [1] W. Hoeffding, "Probability inequalities for sums of bounded random variables", Journal of the American
   Statistical Association 58 (1963) 13-30, theorem 2.
"""

from __future__ import annotations

import numpy as np

from curvecore.arithmetic import DoubleDouble, divide
from curvecore.arrays import FloatArray

_LEFT_OUT = 100.0
"""Weights below 2 to minus so many are left out, all of them together."""

_CHUNK = 1 << 16


def windowed_values(points: FloatArray, x: DoubleDouble, y: DoubleDouble) -> FloatArray:
    """Return a Bezier curve at places x = 1 - y.

    Parameters
    ----------
    points : ndarray, shape (N + 1, dim)
        The control points.
    x, y : DoubleDouble, shape (m,)
        In (0, 1).

    Returns
    -------
    ndarray, shape (m, dim)
        Off by some ten units in the last place of the points that count, and by 2**-100 of the largest.
    """
    degree = len(points) - 1
    reach = int(np.ceil(np.sqrt(degree * (_LEFT_OUT + 1.0) * np.log(2.0) / 2.0)))
    result = np.empty((len(x.high), points.shape[1]))
    step = max(1, _CHUNK // (2 * reach + 1))
    with np.errstate(all="ignore"):
        for start in range(0, len(result), step):
            part = slice(start, start + step)
            ratio = divide(*(DoubleDouble(each.high[part, None], each.low[part, None]) for each in (x, y)))
            middle = np.clip(np.rint(degree * x.high[part]).astype(np.intp), 0, degree)[:, None]
            index = middle + np.arange(-reach, reach + 1)
            weights = _weights(index, middle, reach, degree, ratio)
            near = points[index.clip(0, degree)]
            result[part] = np.einsum("mk,mkd->md", weights, near) / weights.sum(axis=1)[:, None]
    return result


def _weights(
    index: np.ndarray, middle: np.ndarray, reach: int, degree: int, ratio: DoubleDouble
) -> FloatArray:
    """Return the functions over the middle one, by the quotients of neighbours; 0 beyond the ends."""
    before, here, after = index[:, :reach], index[:, reach:-1], index[:, reach + 1 :]
    rising = np.where(here < degree, (degree - here) / np.maximum(after, 1) * ratio.high, 0.0)
    falling = np.where(before >= 0, (before + 1) / np.maximum(degree - before, 1) / ratio.high, 0.0)
    weights = np.ones(index.shape)
    weights[:, reach + 1 :] = np.multiply.accumulate(rising, axis=1)
    weights[:, :reach] = np.multiply.accumulate(falling[:, ::-1], axis=1)[:, ::-1]
    # What the ratio was rounded by, as often as it is a factor.
    weights *= 1.0 + (index - middle) * (ratio.low / ratio.high)
    return weights
