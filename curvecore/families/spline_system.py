"""Second derivatives of cubic splines at their joints, by one tridiagonal system.

References
----------
.. [1] C. de Boor, "A Practical Guide to Splines", revised ed., Springer 2001, chapter IV: end conditions.
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np

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
    points: FloatArray, spacing: FloatArray, ends: SplineEnds
) -> tuple[FloatArray, FloatArray]:
    """Return the first and the second derivatives at the joints; O(n).

    Parameters
    ----------
    points : ndarray, shape (n, dim)
    spacing : ndarray, shape (n - 1,)
        Lengths of the segments, positive.
    ends : SplineEnds

    Returns
    -------
    tuple of ndarray, shape (n, dim)
        Not finite where no double holds them.
    """
    with np.errstate(all="ignore"):
        # For lengths near 1, so that their squares stay in range.
        exponent = int(np.frexp(spacing.max())[1])
        h = np.ldexp(spacing, -exponent)[:, None]
        slope = np.diff(points, axis=0) / h
        bends = _bends(h, slope, ends)
        velocities = _velocities(h, slope, bends, ends)
        return np.ldexp(velocities, -exponent), np.ldexp(bends, -2 * exponent)


def _velocities(h: FloatArray, slope: FloatArray, bends: FloatArray, ends: SplineEnds) -> FloatArray:
    velocities = np.empty_like(bends)
    velocities[:-1] = slope - h / 6.0 * (2.0 * bends[:-1] + bends[1:])
    velocities[-1] = slope[-1] + h[-1] / 6.0 * (bends[-2] + 2.0 * bends[-1])
    if ends is SplineEnds.CLAMPED:
        velocities[[0, -1]] = 0.0
    elif ends is SplineEnds.PERIODIC:
        velocities[-1] = velocities[0]
    return velocities


def _bends(h: FloatArray, slope: FloatArray, ends: SplineEnds) -> FloatArray:
    """Return the second derivatives at the joints."""
    bends = np.zeros((len(h) + 1, slope.shape[1]))
    if ends is SplineEnds.PERIODIC:
        bends[:-1] = _periodic(h, slope)
        bends[-1] = bends[0]
        return bends
    before, after, right_side = _inner_rows(h, slope)
    if ends is SplineEnds.CLAMPED:
        none, half = np.zeros((1, 1)), np.full((1, 1), 0.5)
        edges = 3.0 * slope[:1] / h[:1], -3.0 * slope[-1:] / h[-1:]
        bends[:] = solve_dominant(
            np.concatenate((none, before, half)),
            np.concatenate((half, after, none)),
            np.concatenate((edges[0], right_side, edges[1])),
        )
    elif len(h) > 1 and ends is SplineEnds.NOT_A_KNOT:
        bends[:] = _not_a_knot(h, before, after, right_side)
    elif len(h) > 1:
        before[0] = after[-1] = 0.0
        bends[1:-1] = solve_dominant(before, after, right_side)
    return bends


def _inner_rows(h: FloatArray, slope: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the rows of the inner joints: c' is the same on both sides."""
    length = h[:-1] + h[1:]
    before, after = 0.5 * (h[:-1] / length), 0.5 * (h[1:] / length)
    return before, after, 3.0 * ((slope[1:] - slope[:-1]) / length)


def _not_a_knot(h: FloatArray, before: FloatArray, after: FloatArray, right_side: FloatArray) -> FloatArray:
    """Return all second derivatives; those at the ends lie on the lines through the two beside them."""
    if len(right_side) == 1:
        # A parabola: 3/2 of the row is twice the second divided difference.
        return np.repeat(right_side / 1.5, 3, axis=0)
    first, last = h[0] / h[1], h[-1] / h[-2]
    # The row of the joint beside an end, with the unknown at the end replaced.
    after[0], right_side[0] = (1.0 - first) / (2.0 + first), right_side[0] * (2.0 / (2.0 + first))
    before[-1], right_side[-1] = (1.0 - last) / (2.0 + last), right_side[-1] * (2.0 / (2.0 + last))
    before[0] = after[-1] = 0.0
    inner = solve_dominant(before, after, right_side)
    start = inner[:1] + first * (inner[:1] - inner[1:2])
    return np.concatenate((start, inner, inner[-1:] + last * (inner[-1:] - inner[-2:-1])))


def _periodic(h: FloatArray, slope: FloatArray) -> FloatArray:
    """Return the second derivatives at all joints but the last, which is the first one again.

    The others are solved for twice: for the first one being 0, and for what it adds.
    """
    if len(h) == 1:
        return np.zeros_like(slope)
    before, after, right_side = _inner_rows(np.concatenate((h[-1:], h)), np.concatenate((slope[-1:], slope)))
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
