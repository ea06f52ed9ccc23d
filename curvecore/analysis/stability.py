"""Lebesgue function and constant: growth of errors of the data.

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

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.analysis.cardinal import CardinalBasis
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray, IntArray, parameter_values
from curvecore.bezier.bernstein import weights
from curvecore.bezier.control_points import all_joints
from curvecore.families.curve import ParametricCurve
from curvecore.parametrization import chebyshev


class _SearchPlan(NamedTuple):
    """Steps of a search for the largest value in an interval: its remaining length, squared, is the error."""

    samples: int
    shrink: float
    rounds: int


_ONE_PEAK = _SearchPlan(9, 0.3, 15)
_FEW_PEAKS = _SearchPlan(19, 0.15, 9)
_MANY = 500  # intervals, of which the likelier half or fewer is searched
_MOST_AT_ONCE = 1 << 20  # values: a few megabytes
_MOST_PEAKS = 64  # intervals that are looked into more closely; of equal ones a few will do


def lebesgue_function(curve: ParametricCurve | CardinalBasis, t: ArrayLike) -> FloatArray:
    """Return the sum of |B_i0(t)| over all points, or of their cardinal functions |C_i(t)|.

    Errors of size eps in every point displace c(t) by at most eps times this,
    and for some errors by exactly that.

    Parameters
    ----------
    curve : ParametricCurve or CardinalBasis
        Of any family; only its parameters matter.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, of the shape of t
        At least 1, but for rounding. Relative error about 25 u. Limited to
        the largest finite number.

    See Also
    --------
    lebesgue_constant : Its maximum.
    derivative_sums : The same for velocities and accelerations.

    Notes
    -----
    Of a `CardinalBasis` with ``one_sided`` effects it is what small errors do
    to one coordinate at most, each being eps or -eps.

    For curves of the Hermite families it is 1 throughout the domain: B_i0 and
    B_(i+1)0 are positive there and add up to 1. What errors of given velocities
    do is in `derivative_sums`; where a rule estimates them, the points move
    them too, and the cardinal functions tell.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, lebesgue_function
    >>> curve = LagrangeCurve([[0, 0], [1, 2], [4, 0]], [0, 1, 2])
    >>> lebesgue_function(curve, [0.5, 1]).tolist()
    [1.25, 1.0]
    """
    at = parameter_values(t)
    result = curve.sums(at.values) if isinstance(curve, CardinalBasis) else _sums(curve, at.values)[:, 0]
    return at.shaped(result)


def derivative_sums(curve: ParametricCurve, t: ArrayLike) -> FloatArray:
    """Return the sums of |B_i1(t)| and |B_i2(t)|: the growth of errors of derivatives.

    Parameters
    ----------
    curve : ParametricCurve
        Of any family; only its parameters matter.
    t : float or array_like of any shape
        Finite, inside the domain or not.

    Returns
    -------
    ndarray, shape (*shape of t, R - 1)
        Column 0 for velocities, in units of t; column 1 for accelerations,
        in units of t squared. A `LagrangeCurve` has none. On a segment of
        length h the largest values are h / 4 for cubics, and 5 h / 16 and
        h**2 / 32 for quintics.

    See Also
    --------
    lebesgue_function : The same for the points.
    worst_case_band : What errors of all data do.

    Examples
    --------
    >>> from curvecore import HermiteCurve, derivative_sums
    >>> curve = HermiteCurve([[0], [1]], [[0], [0]], [0, 2])
    >>> derivative_sums(curve, 1).tolist()
    [0.5]
    """
    at = parameter_values(t)
    return at.shaped(_sums(curve, at.values)[:, 1:])


def lebesgue_constant(curve: ParametricCurve | CardinalBasis) -> float:
    """Return the maximum of the Lebesgue function over the domain.

    Parameters
    ----------
    curve : ParametricCurve or CardinalBasis
        Of any family; only its parameters matter.

    Returns
    -------
    float
        Correct to a relative 1e-12 for up to 60 points, or so; for rational
        curves with points less than 1e-10 of the domain apart, whose peaks
        are narrower than the search, to 1e-4. Exactly 1 for the Hermite
        families where no derivative follows the points. Limited to the
        largest finite number.

    See Also
    --------
    lebesgue_function : Of which it is the maximum.

    Notes
    -----
    Between neighbouring t_i the function of a `LagrangeCurve` is a polynomial,
    of one sign pattern, with a single maximum [3]_; that of cardinal functions
    is made of a few. It is sampled at 9 Chebyshev points of each interval, or 19; those
    that may hold the largest are narrowed down around their best sample, to
    0.3 of their length each time, 15 times, or 0.15 and 9 times. Of more than
    500 intervals only the 250 that three samples show to be the highest.

    Examples
    --------
    >>> from curvecore import LagrangeCurve, chebyshev, lebesgue_constant, uniform
    >>> points = [[k, 0] for k in range(15)]
    >>> round(lebesgue_constant(LagrangeCurve(points, uniform(15))), 3)
    283.211
    >>> round(lebesgue_constant(LagrangeCurve(points, chebyshev(15))), 3)
    2.639
    """
    if isinstance(curve, CardinalBasis):
        if curve.follows:
            return lebesgue_constants([curve])[0]
        if curve.closed and not curve.curve.is_positive:
            return _largest_over(curve.curve, curve)
        return lebesgue_constant(curve.curve)
    return max(1.0 if piece.is_positive else _largest_over(piece) for piece in curve.pieces)


def _largest_over(curve: ParametricCurve, functions: CardinalBasis | None = None) -> float:
    """Return the largest sum over the domain of a curve, of its own functions or of others."""
    joints = all_joints(curve)
    segments = np.arange(len(joints) - 1)
    intervals = _Intervals(joints[:-1], joints[1:], segments, np.zeros_like(segments))

    def sums(t: FloatArray, _segment: IntArray) -> FloatArray:
        totals = _sums(curve, t.ravel())[:, 0] if functions is None else functions.sums(t.ravel())
        return totals.reshape(t.shape)

    search = _FEW_PEAKS if curve.degree is None or functions is not None else _ONE_PEAK
    return float(_largest_sums(sums, intervals, 1, search)[0])


def lebesgue_constants(bases: Sequence[CardinalBasis]) -> list[float]:
    """Return the constants of many cardinal bases in a fraction of the time.

    Parameters
    ----------
    bases : sequence of CardinalBasis
        In all of them derivatives follow the points.

    Returns
    -------
    list of float
        As `lebesgue_constant`.
    """
    controls = {index: basis.controls for index, basis in enumerate(bases) if not basis.one_sided}
    constants = [
        1.0 if index in controls else _largest_over(basis.curve, basis) for index, basis in enumerate(bases)
    ]
    for degree in dict.fromkeys(pieces.shape[1] for pieces in controls.values()):
        same = [index for index, pieces in controls.items() if pieces.shape[1] == degree]
        for index, constant in zip(same, _largest_of([controls[index] for index in same]), strict=True):
            constants[index] = constant
    return constants


def _largest_of(controls: list[FloatArray]) -> list[float]:
    """Return the largest sums of absolute values of functions with these control points, of one degree."""
    counts = [len(pieces) for pieces in controls]
    width = max(pieces.shape[2] for pieces in controls)
    # What narrower ones are filled up with adds 0.
    table = np.zeros((sum(counts), controls[0].shape[1], width))
    for pieces, after in zip(controls, np.cumsum(counts), strict=True):
        table[after - len(pieces) : after, :, : pieces.shape[2]] = pieces
    np.nan_to_num(table, copy=False, nan=LARGEST)

    def sums(s: FloatArray, segment: IntArray) -> FloatArray:
        at = weights(s.ravel(), table.shape[1] - 1).reshape(*s.shape, -1)
        step = max(_MOST_AT_ONCE // (s.shape[1] * width), 1)
        blocks = [
            np.abs(at[first : first + step] @ table[segment[first : first + step]]).sum(axis=2)
            for first in range(0, len(segment), step)
        ]
        # Sums beyond all floats, and those of infinities of either sign, which are no numbers.
        return np.asarray(np.fmin(np.concatenate(blocks), LARGEST))

    owner = np.repeat(np.arange(len(controls)), counts)
    segments = np.arange(len(owner))
    intervals = _Intervals(np.zeros(len(owner)), np.ones(len(owner)), segments, owner)
    largest: list[float] = _largest_sums(sums, intervals, len(controls), _FEW_PEAKS).tolist()
    return largest


class _Intervals(NamedTuple):
    """Intervals in which largest values are looked for.

    Attributes
    ----------
    low, high : ndarray, shape (k,)
    segment : ndarray of int, shape (k,)
        Of the curve, or of all curves.
    owner : ndarray of int, shape (k,)
        The curve, ascending.
    """

    low: FloatArray
    high: FloatArray
    segment: IntArray
    owner: IntArray

    def selected(self, rows: IntArray) -> _Intervals:
        return _Intervals(self.low[rows], self.high[rows], self.segment[rows], self.owner[rows])


_SumsIn = Callable[[FloatArray, IntArray], FloatArray]
"""Places (k, m) in segments (k,) to sums of the same size."""


def _largest_sums(sums: _SumsIn, intervals: _Intervals, owners: int, search: _SearchPlan) -> FloatArray:
    """Return the largest value of `sums` in the intervals of each owner, at least 1."""
    left = intervals
    if len(left.owner) > _MANY and np.bincount(left.owner).max() > _MANY:
        quarters = left.low[:, None] + (left.high - left.low)[:, None] * np.array([0.25, 0.5, 0.75])
        highest = sums(quarters, left.segment).max(axis=1)
        left = left.selected(_highest(highest, left.owner, _MANY // 2, above=_MANY))
    largest = np.ones(owners)
    # Near the ends of a segment a function may be negative for a short way only.
    steps = chebyshev(search.samples + 2)[1:-1]
    with np.errstate(all="ignore"):
        for step in range(search.rounds):
            t = np.minimum(left.low[:, None] + (left.high - left.low)[:, None] * steps, left.high[:, None])
            values = sums(t, left.segment)
            best = np.argmax(values, axis=1)
            rows = np.arange(len(best))
            peak, middle = values[rows, best], t[rows, best]
            np.maximum.at(largest, left.owner, peak)
            # What a maximum may exceed its samples by falls with the square of their distance.
            keep = np.flatnonzero(peak >= (1.0 - search.shrink ** (step + 1)) * largest[left.owner])
            keep = keep[_highest(peak[keep], left.owner[keep], _MOST_PEAKS, above=_MOST_PEAKS)]
            left, middle = left.selected(keep), middle[keep]
            width = 0.5 * search.shrink * (left.high - left.low)
            left = left._replace(
                low=np.maximum(middle - width, left.low), high=np.minimum(middle + width, left.high)
            )
    return np.minimum(largest, LARGEST)


def _highest(peaks: FloatArray, owner: IntArray, count: int, above: int) -> IntArray:
    """Return which intervals to keep, ascending: of an owner of more than `above` the `count` highest."""
    if len(peaks) <= above or not (many := np.bincount(owner) > above).any():
        return np.arange(len(peaks))
    order = np.lexsort((-peaks, owner))
    rank = np.arange(len(order)) - np.searchsorted(owner, owner)
    return np.sort(order[(rank < count) | ~many[owner]])


def _sums(curve: ParametricCurve, t: FloatArray) -> FloatArray:
    """Return the sums of all |B_ir|, shape (m, R)."""
    values = curve.local_basis(t).values if curve.is_local else curve.basis(t)
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(np.minimum(np.abs(values).sum(axis=1), LARGEST))
