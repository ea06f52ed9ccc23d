"""Second derivatives of cubic splines at their joints, by one tridiagonal system.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter IV: end conditions.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from curvecore.arithmetic import DoubleDouble, add, difference, divide, multiply
from curvecore.arrays import FloatArray
from curvecore.tridiagonal import solve_dominant


class SplineEnds(StrEnum):
    """Conditions at the ends of a cubic spline: SciPy's ``bc_type``.

    Attributes
    ----------
    label
        The name for people.
    NATURAL
        c'' = 0 at both ends.
    CLAMPED
        c' = 0 at both ends.
    NOT_A_KNOT
        c''' does not jump at the second parameter and at the last but one: the first two pieces are one
        cubic, and the last two. Through three points the parabola.
    PERIODIC
        c' and c'' are the same at both ends: what makes a closed curve smooth at its seam.

    See Also
    --------
    CubicSplineCurve : The spline.

    Examples
    --------
    >>> from curvecore import SplineEnds
    >>> [ends.value for ends in SplineEnds]
    ['natural', 'clamped', 'not_a_knot', 'periodic']
    """

    NATURAL = "natural"
    CLAMPED = "clamped"
    NOT_A_KNOT = "not_a_knot"
    PERIODIC = "periodic"

    @property
    def label(self) -> str:
        """The name for people: Not a knot."""
        return self.value.replace("_", " ").capitalize()


def spline_derivatives(
    points: FloatArray, parameters: FloatArray, ends: SplineEnds
) -> tuple[FloatArray, FloatArray]:
    """Return the first and the second derivatives at the joints; O(n).

    Parameters
    ----------
    points : ndarray, shape (n, dim)
    parameters : ndarray, shape (n,)
        Ascending.
    ends : SplineEnds

    Returns
    -------
    tuple of ndarray, shape (n, dim)
        Not finite where no double holds them.
    """
    with np.errstate(all="ignore"):
        spline = _Spline.of(points, parameters, ends)
        return np.ldexp(spline.velocities, -spline.exponent), np.ldexp(spline.bends, -2 * spline.exponent)


def velocity_moves(points: FloatArray, parameters: FloatArray, ends: SplineEnds) -> FloatArray:
    """Return what the velocities change by per unit of each parameter, the points at rest; O(n**2).

    Parameters
    ----------
    points, parameters, ends
        As for `spline_derivatives`.

    Returns
    -------
    ndarray, shape (n, n, dim)
        ``[j, i]`` is d(c'(t_j)) / dt_i. Not finite where no double holds it.

    Notes
    -----
    The system differentiated: the same one for the changes of the second derivatives, with the derivatives
    of its rows by the lengths as right sides.
    """
    n, dim = points.shape
    with np.errstate(all="ignore"):
        spline = _Spline.of(points, parameters, ends)
        h, double = spline.h, 2.0 * spline.slope
        starts, finishes = (double - spline.velocities[:-1]) / h, (double - spline.velocities[1:]) / h
        # A segment becomes shorter by what its beginning moves, and longer by what its end does.
        lengths = (np.eye(n - 1, n, 1) - np.eye(n - 1, n))[:, :, None]
        shares = _Shares(*((each[:, None] * lengths).reshape(n - 1, -1) for each in (-starts, finishes)))
        thirds = np.diff(spline.bends, axis=0) / (h * h)
        ratios = (thirds[:, None] * lengths).reshape(n - 1, -1)
        bends = _bends(h, shares, ends, np.stack([ratios[1:2] - ratios[:1], ratios[-1:] - ratios[-2:-1]]))
        moves = _velocities(h, shares, bends, ends)
        return np.ldexp(moves, -2 * spline.exponent).reshape(n, n, dim)


def refined_bends(
    points: FloatArray, parameters: FloatArray, bends: FloatArray, ends: SplineEnds
) -> FloatArray:
    """Return second derivatives at the joints after one step of iterative refinement.

    What they leave of the rows of the system is found in double-double arithmetic from the numbers given, so
    that the roundings of lengths, slopes and elimination are gone [1]_.

    Parameters
    ----------
    points : ndarray, shape (n, dim)
    parameters : ndarray, shape (n,)
    bends : ndarray, shape (n, dim)
        As from `spline_derivatives`.
    ends : SplineEnds

    References
    ----------
    .. [1] N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., SIAM 2002, chapter 12.
    """
    with np.errstate(all="ignore"):
        exponent = int(np.frexp(np.diff(parameters).max())[1])
        places = np.ldexp(parameters, -exponent)[:, None]
        h = difference(places[1:], places[:-1])
        slope = divide(difference(points[1:], points[:-1]), h)
        scaled = np.ldexp(bends, 2 * exponent)
        starts, finishes = _halves_of_rows(h, slope, scaled)
        before = DoubleDouble(*(np.roll(each, 1, axis=0) for each in finishes))
        rows = -add(starts, before).high / 6.0
        last = np.zeros_like(rows)
        if ends is SplineEnds.CLAMPED:
            rows[0], last[-1] = -starts.high[0] / 6.0, -finishes.high[-1] / 6.0
        thirds = divide(difference(scaled[1:], scaled[:-1]), h)
        at, beside = ([0, -1], [1, -2]) if len(rows) > 1 else ([0, 0], [0, 0])
        high, low = (each[at] - each[beside] for each in thirds)
        change = _bends(h.high, _Shares(rows, last), ends, (high + low)[:, None] * [[[1.0]], [[-1.0]]])
        refined = bends + np.ldexp(change, -2 * exponent)
        return np.where(np.isfinite(refined), refined, bends)


def _halves_of_rows(
    h: DoubleDouble, slope: DoubleDouble, bends: FloatArray
) -> tuple[DoubleDouble, DoubleDouble]:
    """Return what segments add to the left sides of the rows of their ends, less the right ones."""
    near, far = bends[:-1], bends[1:]
    sixfold = multiply(slope, DoubleDouble(np.array(6.0), np.array(0.0)))
    halves = []
    for first, second, sign in ((near, far, -1.0), (far, near, 1.0)):
        total = add(DoubleDouble(2.0 * first, 0.0 * first), DoubleDouble(second, 0.0 * second))
        halves.append(add(multiply(h, total), DoubleDouble(sign * sixfold.high, sign * sixfold.low)))
    return halves[0], halves[1]


class _Shares(NamedTuple):
    """A sixth of what segments add to the right sides of the rows of their ends.

    Attributes
    ----------
    starts, finishes : ndarray, shape (n - 1, k)
        To the rows of the joints before and behind them.
    """

    starts: FloatArray
    finishes: FloatArray


class _Spline(NamedTuple):
    """A spline in a unit of t in which the longest segment has a length of about 1.

    Attributes
    ----------
    exponent : int
        The unit is 2**exponent.
    h : ndarray, shape (n - 1, 1)
        Lengths of the segments.
    slope : ndarray, shape (n - 1, dim)
        From point to point.
    velocities, bends : ndarray, shape (n, dim)
        The first and the second derivatives at the joints.
    """

    exponent: int
    h: FloatArray
    slope: FloatArray
    velocities: FloatArray
    bends: FloatArray

    @classmethod
    def of(cls, points: FloatArray, parameters: FloatArray, ends: SplineEnds) -> _Spline:
        # For lengths near 1, so that their squares stay in range.
        spacing = np.diff(parameters)
        exponent = int(np.frexp(spacing.max())[1])
        h = np.ldexp(spacing, -exponent)[:, None]
        slope = np.diff(points, axis=0) / h
        shares = _Shares(slope, -slope)
        bends = _bends(h, shares, ends)
        if ends is SplineEnds.NOT_A_KNOT:
            # Beside a short segment all depends on a small difference of second derivatives.
            bends = refined_bends(points, np.ldexp(parameters, -exponent), bends, ends)
        return cls(exponent, h, slope, _velocities(h, shares, bends, ends), bends)


def _velocities(h: FloatArray, shares: _Shares, bends: FloatArray, ends: SplineEnds) -> FloatArray:
    at_starts = shares.starts - h / 6.0 * (2.0 * bends[:-1] + bends[1:])
    at_ends = h / 6.0 * (bends[:-1] + 2.0 * bends[1:]) - shares.finishes
    # Of two segments the shorter one: in a long one terms may cancel that are large beside the result.
    inner = np.where(h[:-1] < h[1:], at_ends[:-1], at_starts[1:])
    velocities = np.concatenate((at_starts[:1], inner, at_ends[-1:]))
    if ends is SplineEnds.CLAMPED:
        velocities[[0, -1]] = 0.0
    elif ends is SplineEnds.PERIODIC:
        velocities[[0, -1]] = at_ends[-1] if h[-1] < h[0] else at_starts[0]
    return velocities


def _bends(h: FloatArray, shares: _Shares, ends: SplineEnds, jumps: FloatArray | None = None) -> FloatArray:
    """Return the second derivatives at the joints.

    The jumps, (2, 1, k), are those of the third derivative at the joints that are not knots; 0 without them.
    """
    bends = np.zeros((len(h) + 1, shares.starts.shape[1]))
    if ends is SplineEnds.PERIODIC:
        bends[:-1] = _periodic(h, shares)
        bends[-1] = bends[0]
        return bends
    before, after, right_side = _inner_rows(h, shares)
    if ends is SplineEnds.CLAMPED:
        none, half = np.zeros((1, 1)), np.full((1, 1), 0.5)
        edges = 3.0 * shares.starts[:1] / h[:1], 3.0 * shares.finishes[-1:] / h[-1:]
        bends[:] = solve_dominant(
            np.concatenate((none, before, half)),
            np.concatenate((half, after, none)),
            np.concatenate((edges[0], right_side, edges[1])),
        )
    elif len(h) > 1 and ends is SplineEnds.NOT_A_KNOT:
        bends[:] = _not_a_knot(h, before, after, right_side, np.zeros((2, 1, 1)) if jumps is None else jumps)
    elif len(h) > 1:
        before[0] = after[-1] = 0.0
        bends[1:-1] = solve_dominant(before, after, right_side)
    return bends


def _inner_rows(h: FloatArray, shares: _Shares) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the rows of the inner joints: c' is the same on both sides."""
    length = h[:-1] + h[1:]
    before, after = 0.5 * (h[:-1] / length), 0.5 * (h[1:] / length)
    return before, after, 3.0 * ((shares.starts[1:] + shares.finishes[:-1]) / length)


def _not_a_knot(
    h: FloatArray, before: FloatArray, after: FloatArray, right_side: FloatArray, jumps: FloatArray
) -> FloatArray:
    """Return all second derivatives; those at the ends lie on the lines through the two beside them.

    Lines that bend by the jumps, (2, 1, k), where these are not 0.
    """
    if len(right_side) == 1:
        # A parabola: 3/2 of the row is twice the second divided difference.
        return np.repeat(right_side / 1.5, 3, axis=0)
    first, last = h[0] / h[1], h[-1] / h[-2]
    rise, fall = h[0] * jumps[0], h[-1] * jumps[1]
    right_side[0] -= before[0] * rise[0]
    right_side[-1] -= after[-1] * fall[0]
    # The row of the joint beside an end, with the unknown at the end replaced.
    after[0], right_side[0] = (1.0 - first) / (2.0 + first), right_side[0] * (2.0 / (2.0 + first))
    before[-1], right_side[-1] = (1.0 - last) / (2.0 + last), right_side[-1] * (2.0 / (2.0 + last))
    before[0] = after[-1] = 0.0
    inner = solve_dominant(before, after, right_side)
    start = inner[:1] + first * (inner[:1] - inner[1:2]) + rise
    end = inner[-1:] + last * (inner[-1:] - inner[-2:-1]) + fall
    return np.concatenate((start, inner, end))


def _periodic(h: FloatArray, shares: _Shares) -> FloatArray:
    """Return the second derivatives at all joints but the last, which is the first one again.

    The others are solved for twice: for the first one being 0, and for what it adds.
    """
    if len(h) == 1:
        return np.zeros_like(shares.starts)
    around = _Shares(*(np.concatenate((each[-1:], each)) for each in shares))
    before, after, right_side = _inner_rows(np.concatenate((h[-1:], h)), around)
    own_before, own_after = before[1:].copy(), after[1:].copy()
    seam = np.zeros_like(own_before)
    seam[0] -= own_before[0]
    seam[-1] -= own_after[-1]
    own_before[0] = own_after[-1] = 0.0
    both = solve_dominant(own_before, own_after, np.concatenate((right_side[1:], seam), axis=1))
    rest, share = both[:, :-1], both[:, -1:]
    left = right_side[:1] - before[:1] * rest[-1:] - after[:1] * rest[:1]
    first = left / (1.0 + before[:1] * share[-1:] + after[:1] * share[:1])
    return np.concatenate((first, rest + share * first))
