"""Insides of outlines: how often they run around a point, and what a fill rule makes of that."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from curvecore.arrays import FloatArray

from ...document.style import FillRule

_ASKED = 24
"""Points of an outline that are asked whether it lies within the others."""


def windings(outlines: Sequence[FloatArray], points: FloatArray) -> npt.NDArray[np.int64]:
    """Return how often outlines (k, 2), closed by straight lines, run around points (m, 2) to the left."""
    turns = np.zeros(len(points), dtype=np.int64)
    for outline in outlines:
        starts, ends = outline, np.roll(outline, -1, axis=0)
        along = ends - starts
        above = starts[:, 1] <= points[:, 1:]
        rises = above & (ends[:, 1] > points[:, 1:])
        falls = ~above & (ends[:, 1] <= points[:, 1:])
        # Which side of each line the points lie on; where it does not cross their height, nobody asks.
        side = along[:, 0] * (points[:, 1:] - starts[:, 1]) - along[:, 1] * (points[:, :1] - starts[:, 0])
        turns += (rises & (side > 0)).sum(axis=1) - (falls & (side < 0)).sum(axis=1)
    return turns


def is_inside(turns: npt.NDArray[np.int64], rule: FillRule) -> npt.NDArray[np.bool_]:
    """Return which points are inside of what runs so often around them."""
    inside: npt.NDArray[np.bool_] = turns != 0 if rule is FillRule.NONZERO else turns % 2 == 1
    return inside


def fills_holes(outlines: Sequence[FloatArray]) -> bool:
    """Whether the nonzero rule fills what the even-odd rule leaves open: an outline within another.

    It does where both run the same way.
    """
    low, high = (np.array([ends(outline, axis=0) for outline in outlines]) for ends in (np.min, np.max))
    for number, outline in enumerate(outlines):
        # An outline runs around nothing outside of its box: of thousands few are asked.
        near = np.flatnonzero(((low <= high[number]) & (low[number] <= high)).all(axis=1)).tolist()
        others = [outlines[other] for other in near if other != number]
        around = windings(others, outline[:: max(1, len(outline) // _ASKED)])
        # Where it crosses the others it lies in none of them.
        if len(set(around.tolist())) == 1 and around[0] % 2 == 1 and around[0] + _turn(outline) != 0:
            return True
    return False


def _turn(outline: FloatArray) -> int:
    """Return 1 for an outline that runs to the left around its inside, −1 for one to the right."""
    x, y = (outline - outline[0]).T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0 else -1
