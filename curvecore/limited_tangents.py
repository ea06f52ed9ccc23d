"""Velocities that follow the course of the data: monotone and Akima. They are not linear in the points.

Each coordinate is estimated for itself. Both rules are homogeneous of degree one, v(a p) = a v(p) for all
a, and local. What small moves of the points do to the velocities is their Jacobian at the points times the
moves; where it jumps, as between neighbouring slopes that are equal, the change is another one on each side.

References
----------
.. [1] F. N. Fritsch and R. E. Carlson, "Monotone piecewise cubic
   interpolation", SIAM J. Numer. Anal. 17 (1980) 238-246.
.. [2] F. N. Fritsch and J. Butland, "A method for constructing local
   monotone piecewise cubic interpolants", SIAM J. Sci. Stat. Comput. 5
   (1984) 300-304: the weights of the harmonic mean.
.. [3] H. Akima, "A new method of interpolation and smooth curve fitting
   based on local procedures", J. ACM 17 (1970) 589-602.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import BoolArray, FloatArray
from curvecore.tangents import Steps, in_range, steps_of

_SIDES = slice(-2), slice(2, None)
"""Turns before and after each joint."""

_STRAIGHT = 1e-9
"""Change of the slope, relative to the slopes, below which three points count as lying on a straight line."""


@in_range
def monotone_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return velocities with which no coordinate swings beyond its data (PCHIP).

    Between chords that rise both or fall both the weighted harmonic mean of their slopes [2]_, else 0; at the
    ends the parabola's velocity, limited so that the coordinate stays monotone on the end segment. So each
    coordinate of the Hermite curve rises and falls where its data do. The same as SciPy's
    ``PchipInterpolator``.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, dim)
        Velocities per unit of t.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's.

    See Also
    --------
    akima_velocities : Less strict.
    bessel_velocities, natural_spline_velocities : Rules that are linear in the points.

    Examples
    --------
    >>> from curvecore import monotone_velocities
    >>> monotone_velocities([[0], [1], [1], [4]], [0, 1, 2, 3]).round(9).tolist()
    [[1.5], [0.0], [0.0], [4.5]]
    """
    steps = steps_of(points, parameters)
    if len(steps.slope) == 1:
        return np.repeat(steps.slope, 2, axis=0)
    ends = _monotone_ends(steps)
    return np.concatenate((ends[:1], _harmonic_means(steps), ends[1:]))


def monotone_changes(
    points: ArrayLike, parameters: ArrayLike, moves: ArrayLike, *, one_sided: bool = False
) -> FloatArray:
    """Return the effects of small moves of the points on `monotone_velocities`, to first order.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    moves : array_like, shape (n, k)
        Each column moves a coordinate of every point.
    one_sided : bool, optional
        Whether the change is that on the side of a kink to which the moves lead; else it is linear in the
        moves, at a kink that of the case that the rule itself takes.

    Returns
    -------
    ndarray, shape (n, dim, k)
        ``[i, d, j]`` is the change of coordinate d of velocity i by the moves of column j of that coordinate.

    See Also
    --------
    monotone_velocities : The rule.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import monotone_changes
    >>> monotone_changes([[0], [1], [3]], [0, 1, 2], np.eye(3))[1, 0].round(9).tolist()
    [-0.888888889, 0.666666667, 0.222222222]
    """
    steps = steps_of(points, parameters)
    change = _slope_changes(steps, moves)
    if len(steps.slope) == 1:
        return np.repeat(np.broadcast_to(change, (1, steps.slope.shape[1], change.shape[2])), 2, axis=0)
    h, slope = steps.spacing[:, :, None], steps.slope[:, :, None]
    mean = _harmonic_means(steps)[:, :, None]
    before, after = _weights(h)
    with np.errstate(all="ignore"):
        shares = before * (mean / slope[:-1]) ** 2, after * (mean / slope[1:]) ** 2
    changes = np.empty((len(slope) + 1, slope.shape[1], change.shape[2]))
    changes[1:-1] = np.where(mean != 0.0, shares[0] * change[:-1] + shares[1] * change[1:], 0.0)
    for near, beside, case in zip((0, -1), (1, -2), _end_cases(steps), strict=True):
        parabola, steep = _end_parabola(Steps(h, change), near, beside), 3.0 * change[near]
        limited = np.where(case.steep[:, None], steep, parabola)
        changes[near] = np.where(case.flat[:, None], 0.0, limited)
    return _monotone_on_sides(steps, change, changes) if one_sided else changes


def _monotone_on_sides(steps: Steps, change: FloatArray, changes: FloatArray) -> FloatArray:
    """Return the changes of the velocities, at kinks those on the side to which slopes change."""
    h, slope = steps.spacing[:, :, None], steps.slope[:, :, None]
    # Slopes of 0 are their changes now; against these all others are infinite.
    around = np.abs(np.pad(slope, ((1, 1), (0, 0), (0, 0))))
    is_flat = _vanishes(slope, np.maximum(around[:-2], around[2:]))
    sides = Steps(h, np.where(is_flat, change, np.copysign(np.inf, slope)))
    with np.errstate(all="ignore"):
        ends, means = _monotone_ends(sides), _harmonic_means(sides)
    changes[1:-1] = np.where(is_flat[:-1] | is_flat[1:], means, changes[1:-1])
    for near, beside, case, flat_end in zip((0, -1), (1, -2), _end_cases(steps), ends, strict=True):
        slope_here, velocity = slope[near], case.parabola[:, None]
        parabola, steep = _end_parabola(Steps(h, change), near, beside), 3.0 * change[near]
        rising = np.where(parabola * slope_here > 0.0, parabola, 0.0)
        limited = np.where(slope_here > 0.0, np.minimum(parabola, steep), np.maximum(parabola, steep))
        is_limit = (slope_here * slope[beside] < 0.0) & _vanishes(
            np.abs(velocity) - 3.0 * np.abs(slope_here), slope_here
        )
        kinks = is_flat[near], _vanishes(velocity, slope_here), is_limit
        changes[near] = np.select(kinks, (flat_end, rising, limited), changes[near])
    return changes


@in_range
def akima_velocities(points: ArrayLike, parameters: ArrayLike) -> FloatArray:
    """Return Akima's velocities: means of two slopes, weighted by how straight the other side is.

    The weight of a chord's slope is the change of slope beyond the other chord, so that a straight run of
    points stays straight up to its last segment. Beyond the ends two more slopes go on as an arithmetic
    sequence. Where both weights vanish the mean of both slopes counts. The rule of 1970 [3]_, the same as
    SciPy's ``Akima1DInterpolator``; on unequal spacing the slopes are weighted alike.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.

    Returns
    -------
    ndarray, shape (n, dim)
        Velocities per unit of t.

    Raises
    ------
    CurveError
        For points or parameters that are no curve's.

    See Also
    --------
    monotone_velocities : More strict.
    bessel_velocities, natural_spline_velocities : Rules that are linear in the points.

    Examples
    --------
    >>> from curvecore import akima_velocities
    >>> akima_velocities([[0], [1], [2], [3], [0]], [0, 1, 2, 3, 4]).round(9).tolist()
    [[1.0], [1.0], [1.0], [1.0], [-5.0]]
    """
    slope = _with_outer(steps_of(points, parameters).slope)
    share = _akima_share(slope)
    return slope[1:-2] + share * (slope[2:-1] - slope[1:-2])


def akima_changes(
    points: ArrayLike, parameters: ArrayLike, moves: ArrayLike, *, one_sided: bool = False
) -> FloatArray:
    """Return the effects of small moves of the points on `akima_velocities`, to first order.

    Parameters
    ----------
    points : array_like, shape (n, dim)
        p_i; n >= 2.
    parameters : array_like, shape (n,)
        t_i, strictly increasing.
    moves : array_like, shape (n, k)
        Each column moves a coordinate of every point.
    one_sided : bool, optional
        Whether the change is that on the side of a kink to which the moves lead; else it is linear in the
        moves, at a kink the mean of both sides.

    Returns
    -------
    ndarray, shape (n, dim, k)
        ``[i, d, j]`` is the change of coordinate d of velocity i by the moves of column j of that coordinate.
        On the side of a corner between two straight runs it is infinite: there the velocity jumps.

    See Also
    --------
    akima_velocities : The rule.

    Examples
    --------
    >>> import numpy as np
    >>> from curvecore import akima_changes
    >>> akima_changes([[0], [1], [2], [4], [7]], [0, 1, 2, 3, 4], np.eye(5))[2, 0].round(9).tolist()
    [0.0, -1.0, 1.0, 0.0, 0.0]
    """
    steps = steps_of(points, parameters)
    slope = _with_outer(steps.slope)[:, :, None]
    change = _with_outer(_slope_changes(steps, moves))
    share = _akima_share(slope)
    turn, turned = np.diff(slope, axis=0), np.diff(change, axis=0)
    weight, is_straight = np.abs(turn), _is_straight(slope)
    # By how much the weights before and after each joint grow, on one side also those that are 0.
    least = _STRAIGHT * _sizes(slope) if one_sided else np.full((1, 1, 1), -1.0)
    signs = [np.where(weight[rows] <= least, np.sign(turned[rows]), np.sign(turn[rows])) for rows in _SIDES]
    grown = [sign * turned[rows] for sign, rows in zip(signs, _SIDES, strict=True)]
    with np.errstate(all="ignore"):
        moved = (grown[0] * (1.0 - share) - grown[1] * share) / (weight[:-2] + weight[2:]) * turn[1:-1]
        moved = np.where(is_straight, 0.0, moved)
        if one_sided:
            weights = grown[0] + grown[1]
            share = np.where(is_straight & (weights > 0.0), grown[0] / weights, share)
            is_jump = is_straight & (np.abs(share - 0.5) > _STRAIGHT) & (weight[1:-1] > least)
            moved = np.where(is_jump, np.inf, moved)
    return change[1:-2] + share * (change[2:-1] - change[1:-2]) + moved


def _slope_changes(steps: Steps, moves: ArrayLike) -> FloatArray:
    """Return the changes of the slopes, (n - 1, 1, k): the same for every coordinate."""
    return np.diff(np.asarray(moves, dtype=np.float64), axis=0)[:, None] / steps.spacing[:, :, None]


def _weights(h: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the shares of both slopes in the harmonic mean: that of the longer segment counts less."""
    length = 3.0 * (h[:-1] + h[1:])
    return (2.0 * h[1:] + h[:-1]) / length, (h[1:] + 2.0 * h[:-1]) / length


def _harmonic_means(steps: Steps) -> FloatArray:
    before, after = _weights(steps.spacing)
    slope = steps.slope
    with np.errstate(all="ignore"):
        means = 1.0 / (before / slope[:-1] + after / slope[1:])
    return np.where(np.sign(slope[:-1]) * np.sign(slope[1:]) > 0.0, means, 0.0)


class _EndCase(NamedTuple):
    """The parabola's velocity at an end, (dim,), and where it is 0 instead, or thrice the slope."""

    parabola: FloatArray
    flat: BoolArray
    steep: BoolArray


def _end_cases(steps: Steps) -> list[_EndCase]:
    slope = steps.slope
    cases = []
    for near, beside in ((0, 1), (-1, -2)):
        parabola = _end_parabola(steps, near, beside)
        turns = np.sign(slope[near]) != np.sign(slope[beside])
        steep = turns & (np.abs(parabola) > 3.0 * np.abs(slope[near]))
        cases.append(_EndCase(parabola, np.sign(parabola) != np.sign(slope[near]), steep))
    return cases


def _end_parabola(steps: Steps, near: int, beside: int) -> FloatArray:
    """Return the velocity of the parabola through the three points at an end."""
    h, slope = steps
    return np.asarray(slope[near] + h[near] / (h[near] + h[beside]) * (slope[near] - slope[beside]))


def _vanishes(number: FloatArray, beside: FloatArray) -> BoolArray:
    """Whether a number is 0, but for rounding, beside another one; of two that are 0 both."""
    return np.abs(number) <= _STRAIGHT * np.abs(beside)


def _monotone_ends(steps: Steps) -> FloatArray:
    return np.array(
        [
            np.where(case.flat, 0.0, np.where(case.steep, 3.0 * steps.slope[near], case.parabola))
            for near, case in zip((0, -1), _end_cases(steps), strict=True)
        ]
    )


def _with_outer(slope: FloatArray) -> FloatArray:
    """Return the slopes with two more before and behind them, as an arithmetic sequence goes on."""
    first, last = (slope[1] - slope[0], slope[-1] - slope[-2]) if len(slope) > 1 else (0.0 * slope[0],) * 2
    before = slope[0] - np.multiply.outer([2.0, 1.0], first)
    return np.concatenate((before, slope, slope[-1] + np.multiply.outer([1.0, 2.0], last)))


def _is_straight(slope: FloatArray) -> BoolArray:
    """Whether the slopes before each joint are the same, and those after it."""
    turn = np.abs(np.diff(slope, axis=0))
    return turn[:-2] + turn[2:] <= _STRAIGHT * _sizes(slope)


def _sizes(slope: FloatArray) -> FloatArray:
    """Return the sums of the sizes of the four slopes around each joint."""
    size = np.abs(slope)
    return size[:-3] + size[1:-2] + size[2:-1] + size[3:]


def _akima_share(slope: FloatArray) -> FloatArray:
    """Return the share of the slope after each joint."""
    turn = np.abs(np.diff(slope, axis=0))
    with np.errstate(all="ignore"):
        share = turn[:-2] / (turn[:-2] + turn[2:])
    return np.where(_is_straight(slope), 0.5, share)
