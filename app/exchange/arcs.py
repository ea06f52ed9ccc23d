"""Elliptical arcs as cubic pieces within a stated distance.

References
----------
.. [1] SVG 2, appendix B.2: from the ends of an arc to its centre.
.. [2] M. Goldapp, "Approximation of circular arcs by cubic polynomials", CAGD 8 (1991) 227-238: the
   error of a piece over the angle a is at most 2/27 sin(a/4)^6 / cos(a/4)^2 of the radius.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from curvecore.arrays import FloatArray

from .errors import ExchangeError

PIECES_OF_A_TURN = 4
"""Pieces of a whole turn, if no tolerance is given, as in drawing programs: within 2.8e-4 of the radius."""

MOST_PIECES = 1000


@dataclass(frozen=True, eq=False)
class Arc:
    """An arc as cubic pieces (k, 4, 2), and how far they are from it at most."""

    pieces: FloatArray
    deviation: float


def arc(
    centre: FloatArray, axes: FloatArray, start: float, sweep: float, tolerance: float | None = None
) -> Arc:
    """Return the arc centre + cos(a) axes[0] + sin(a) axes[1], a from `start` over `sweep`, in radians.

    Parameters
    ----------
    centre
        (2,).
    axes
        Two half axes, (2, 2); they need be neither orthogonal nor of one length.
    tolerance
        Largest distance allowed; by default what `PIECES_OF_A_TURN` gives.
    """
    radius = float(np.linalg.norm(axes, 2))
    if not np.isfinite(radius):
        raise ExchangeError("An arc has a radius beyond all numbers.")
    count = pieces_of_arc(radius, sweep, tolerance)
    angles = start + sweep * (np.arange(count + 1) / count)
    handle = 4 / 3 * math.tan(sweep / count / 4)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    tangent = np.column_stack([-circle[:, 1], circle[:, 0]]) * handle
    pieces = np.stack([circle[:-1], circle[:-1] + tangent[:-1], circle[1:] - tangent[1:], circle[1:]], axis=1)
    return Arc(centre + pieces @ axes, radius * error_of_arc(sweep / count))


def arc_between(
    start: FloatArray,
    end: FloatArray,
    radii: tuple[float, float],
    rotation: float,
    large: bool,
    positive: bool,
    tolerance: float | None = None,
) -> Arc | None:
    """Return SVG's arc from start to end [1]_; None where it is a straight line.

    Parameters
    ----------
    radii
        Of the ellipse, enlarged where they are too small to reach.
    rotation
        Of its first axis, in degrees.
    large, positive
        The two flags: the longer way round, and in the direction of growing angles.
    """
    rx, ry = abs(radii[0]), abs(radii[1])
    if rx == 0 or ry == 0 or (start == end).all():
        return None
    phi = math.radians(rotation % 360)
    turn = np.array([[math.cos(phi), math.sin(phi)], [-math.sin(phi), math.cos(phi)]])
    half = turn @ ((start - end) / 2) / (rx, ry)
    square = float(half @ half)
    if not math.isfinite(square) or square == 0:
        raise ExchangeError("An arc has radii that do not fit its ends.")
    grow = max(1.0, math.sqrt(square))
    middle, first, sweep = _on_unit_circle(half / grow, large, positive)
    axes = np.array([[rx], [ry]]) * grow * turn
    centre = (start + end) / 2 + middle @ axes
    result = arc(centre, axes, first, sweep, tolerance)
    # Ends that meet their neighbours, whatever was rounded on the way.
    result.pieces[0, 0], result.pieces[-1, 3] = start, end
    return result


def _on_unit_circle(half: FloatArray, large: bool, positive: bool) -> tuple[FloatArray, float, float]:
    """Return the centre, first angle and sweep of an arc of radius 1 from `half` to its opposite."""
    away = math.sqrt(max(0.0, 1 / min(float(half @ half), 1.0) - 1)) * (1 if large != positive else -1)
    middle = away * np.array([half[1], -half[0]])
    first = math.atan2(half[1] - middle[1], half[0] - middle[0])
    last = math.atan2(-half[1] - middle[1], -half[0] - middle[0])
    return middle, first, (last - first) % math.tau if positive else -((first - last) % math.tau)


def pieces_of_arc(
    radius: float,
    sweep: float,
    tolerance: float | None = None,
    most: int = MOST_PIECES,
    *,
    turn: int = PIECES_OF_A_TURN,
) -> int:
    """Return the number of cubic pieces that an arc over `sweep` needs, at least `turn` of a turn."""
    count = max(1, math.ceil(abs(sweep) / math.tau * turn - 1e-9))
    while tolerance is not None and radius * error_of_arc(sweep / count) > tolerance and count < most:
        count += 1
    return count


def error_of_arc(angle: float) -> float:
    """Return how far a cubic piece over an angle in radians is from the unit circle at most [2]_."""
    quarter = abs(angle) / 4
    return 2 / 27 * math.sin(quarter) ** 6 / math.cos(quarter) ** 2
