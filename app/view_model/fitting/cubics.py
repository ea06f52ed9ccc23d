"""Curves as cubic Bézier pieces, and such pieces as the points of a cubic Hermite curve."""

from __future__ import annotations

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.limits import EditError
from ...document.model import Point
from .cubic_joints import EXACT, SMOOTH, Joints, points_of

RELATIVE_TOLERANCE = 1e-5
"""Usual tolerance against a drawing's larger side: a fiftieth of a pixel on a screen of 2000."""

# A control point moves the curve by at most the largest value of its Bernstein polynomial.
_INFLUENCE = 4.0 / 9.0


class CubicPoints(msgspec.Struct, frozen=True):
    """Points that make a cubic Hermite curve of pieces.

    Attributes
    ----------
    points
        With velocities, and manual parameters from 0 to 1.
    moved
        By how much the curve is another one at most: joints were made smooth.
    """

    points: tuple[Point, ...]
    moved: float


def points_of_cubics(
    pieces: FloatArray, *, closed: bool, most_turned: float = EXACT, letters: str = ""
) -> CubicPoints:
    """Return the points of pieces (k, 4, 2), each of some length and beginning where the one before ends.

    Parameters
    ----------
    closed
        Whether the last piece ends where the first begins, on purpose.
    most_turned
        Angle by which a handle is turned where it nearly goes on from the one before.
    letters
        One of `cubic_joints` for each point, which is such a one where it can be; others say nothing.

    Raises
    ------
    EditError
        If their lengths are too different for one curve.
    """
    if closed and len(pieces) == 1:
        pieces = _halves(pieces[0])
    if len(letters) != len(pieces) + (not closed):
        letters = ""
    leaving, arriving = 3 * (pieces[:, 1] - pieces[:, 0]), 3 * (pieces[:, 3] - pieces[:, 2])
    size = float(np.ptp(pieces.reshape(-1, 2), axis=0).max())
    joints = Joints(leaving, arriving, _lengths(pieces), SMOOTH * size, closed, most_turned, letters)
    t = np.append(0.0, np.cumsum(joints.steps))
    t /= t[-1]
    if not (np.diff(t) > 0).all():
        raise EditError("There are pieces of too different lengths for one curve.")
    h = np.diff(t)[:, None]
    points = points_of(pieces, leaving / h, arriving / h, t, joints, closed=closed)
    return CubicPoints(points, _INFLUENCE * joints.moved)


def _halves(piece: FloatArray) -> FloatArray:
    """Return a cubic piece (4, 2) as two (de Casteljau)."""
    a, b, c, d = piece
    ab, bc, cd = (a + b) / 2, (b + c) / 2, (c + d) / 2
    abc, bcd = (ab + bc) / 2, (bc + cd) / 2
    middle = (abc + bcd) / 2
    return np.array([[a, ab, abc, middle], [middle, bcd, cd, d]])


def _lengths(pieces: FloatArray) -> FloatArray:
    return np.asarray(np.hypot(*np.moveaxis(np.diff(pieces, axis=1), 2, 0)).sum(axis=1))
