"""How far errors of the data reach: Lebesgue function and constant.

Of a curve they tell what errors of the points do while velocities and accelerations stay as they are; of its
`CardinalBasis`, what they do where these are estimated from the points.

References
----------
.. [1] T. J. Rivlin, "An Introduction to the Approximation of Functions",
   Dover 1981, section 4.1: the Lebesgue constant.
.. [2] L. N. Trefethen, "Approximation Theory and Approximation Practice",
   SIAM 2013, chapter 15: its growth, 2**(n+1) / (e n log n) for n + 1 equal
   spaces and 2 / pi log n for Chebyshev points.
.. [3] F. W. Luttmann and T. J. Rivlin, "Some numerical experiments in the
   theory of polynomial interpolation", IBM J. Research and Development 9
   (1965) 187-191: one local maximum between neighbours, and a table.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, parameter_values
from curvecore.cardinal import CardinalBasis
from curvecore.chain import Chain
from curvecore.curve import Curve
from curvecore.hermite import LocalBasis
from curvecore.scaling import LARGEST

__all__ = ["derivative_sums", "lebesgue_constant", "lebesgue_function"]


class _Search(NamedTuple):
    """How the largest value in an interval is looked for: what is left, squared, is the relative error."""

    samples: int
    shrink: float
    rounds: int


_ONE_PEAK = _Search(9, 0.3, 15)
_FEW_PEAKS = _Search(19, 0.15, 9)
_MANY = 500  # intervals, of which the likelier half or fewer is searched
_MOST_PEAKS = 64  # intervals that are looked into more closely; of equal ones a few will do


@runtime_checkable
class _Local(Protocol):
    def local_basis(self, t: ArrayLike, order: int = 0) -> LocalBasis: ...


def lebesgue_function(curve: Curve | CardinalBasis, t: ArrayLike) -> FloatArray:
    """Return the sum of |B_i0(t)| over all points, or of their cardinal functions |C_i(t)|.

    Errors of size eps in every point displace c(t) by at most eps times this,
    and for some errors by exactly that.

    Parameters
    ----------
    curve : Curve or CardinalBasis
        Of any family; only its parameters matter.
    t : float or array_like, shape (m,)
        As for `Curve.evaluate`.

    Returns
    -------
    ndarray, shape () or (m,)
        At least 1, but for rounding. Relative error about 25 u. Limited to
        the largest finite number.

    Notes
    -----
    For curves of the Hermite families it is 1 throughout the domain: B_i0 and
    B_(i+1)0 are positive there and add up to 1. What errors of given velocities
    do is in `derivative_sums`; where a rule estimates them, the points move
    them too, and the cardinal functions tell.
    """
    at = parameter_values(t)
    result = curve.sums(at.values) if isinstance(curve, CardinalBasis) else _sums(curve, at.values)[:, 0]
    return result[0] if at.is_scalar else result


def derivative_sums(curve: Curve, t: ArrayLike) -> FloatArray:
    """Return the sums of |B_i1(t)| and |B_i2(t)|: what errors of derivatives do.

    Parameters
    ----------
    curve : Curve
        Of any family; only its parameters matter.
    t : float or array_like, shape (m,)
        As for `Curve.evaluate`.

    Returns
    -------
    ndarray, shape (R - 1,) or (m, R - 1)
        Column 0 for velocities, in units of t; column 1 for accelerations,
        in units of t squared. A `LagrangeCurve` has none. On a segment of
        length h the largest values are h / 4 for cubics, and 5 h / 16 and
        h**2 / 32 for quintics.
    """
    at = parameter_values(t)
    result = _sums(curve, at.values)[:, 1:]
    return result[0] if at.is_scalar else result


def lebesgue_constant(curve: Curve | CardinalBasis) -> float:
    """Return the maximum of the Lebesgue function over the domain.

    Parameters
    ----------
    curve : Curve or CardinalBasis
        Of any family; only its parameters matter.

    Returns
    -------
    float
        Correct to a relative 1e-12 for up to 60 points, or so. Exactly 1 for
        the Hermite families where no derivative follows the points. Limited
        to the largest finite number.

    Notes
    -----
    Between neighbouring t_i the function of a `LagrangeCurve` is a polynomial,
    of one sign pattern, with a single maximum [3]_; that of cardinal functions
    is made of a few. It is sampled at 9 places of each interval, or 19; those
    that may hold the largest are narrowed down around their best sample, to
    0.3 of their length each time, 15 times, or 0.15 and 9 times. Of more than
    500 intervals only the 250 that three samples show to be the highest.
    """
    if isinstance(curve, CardinalBasis):
        if not curve.follows:
            return lebesgue_constant(curve.curve)
        return _largest_sum(curve.sums, curve.parameters, _FEW_PEAKS)
    if isinstance(curve, Chain):
        return max(lebesgue_constant(piece) for piece in curve.pieces)
    if curve.jets.shape[1] > 1 or len(curve.parameters) == 2:
        return 1.0
    return _largest_sum(lambda t: _sums(curve, t)[:, 0], curve.parameters, _ONE_PEAK)


def _largest_sum(sums: Callable[[FloatArray], FloatArray], joints: FloatArray, search: _Search) -> float:
    """Return the largest value of `sums` between the joints, at least 1."""
    low, high = joints[:-1], joints[1:]
    if len(low) > _MANY:
        quarters = (low + (high - low) * np.array([[0.25], [0.5], [0.75]])).ravel()
        likely = np.argsort(sums(quarters).reshape(3, -1).max(axis=0))[-_MANY // 2 :]
        low, high = low[likely], high[likely]
    largest = 1.0
    steps = np.arange(1, search.samples + 1) / (search.samples + 1)
    with np.errstate(under="ignore"):
        for step in range(search.rounds):
            t = low[:, None] + (high - low)[:, None] * steps
            values = sums(np.minimum(t, high[:, None]).ravel()).reshape(t.shape)
            best = np.argmax(values, axis=1)
            rows = np.arange(len(best))
            peak = values[rows, best]
            largest = max(largest, float(peak.max()))
            # What a maximum may exceed its samples by falls with the square of their distance.
            keep = np.flatnonzero(peak >= (1.0 - search.shrink ** (step + 1)) * largest)
            if len(keep) > _MOST_PEAKS:
                keep = keep[np.argsort(peak[keep])[-_MOST_PEAKS:]]
            width = 0.5 * search.shrink * (high - low)[keep]
            middle = t[rows, best][keep]
            low, high = np.maximum(middle - width, low[keep]), np.minimum(middle + width, high[keep])
    return min(largest, LARGEST)


def _sums(curve: Curve, t: FloatArray) -> FloatArray:
    """Return the sums of all |B_ir|, shape (m, R)."""
    values = curve.local_basis(t).values if isinstance(curve, _Local) else curve.basis(t)
    with np.errstate(over="ignore", under="ignore"):
        result: FloatArray = np.minimum(np.abs(values).sum(axis=1), LARGEST)
    return result
