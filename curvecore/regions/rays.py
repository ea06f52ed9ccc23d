"""Winding numbers, by rays that are halved with the pieces they cross.

A ray begins at a place and goes to the left of a direction. A piece that
crosses its line beyond that place, seen in the direction from left to right,
takes one from the winding number on the near side. Of a piece all of which
lies beyond, the ends alone say how often that is, and rounding cannot make
neighbours disagree about the joint that they share: no root is computed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray

_HALVINGS = 60
_AT_ONCE = 1 << 18  # pairs of a ray and a piece that are tested together


class Rays(NamedTuple):
    """Rays to the left of directions.

    Attributes
    ----------
    origin : ndarray, shape (m, 2)
        Where they begin.
    along : ndarray, shape (m, 2)
        The directions, unit vectors.
    """

    origin: FloatArray
    along: FloatArray


class Crossed(NamedTuple):
    """Sums of the directions in which pieces cross rays: 1 from behind to ahead, else -1.

    Attributes
    ----------
    beyond : ndarray of int, shape (m, regions)
        Of what is farther away than the reach.
    near : ndarray of int, shape (m, regions)
        Of what is not, on either side of the origin.
    """

    beyond: IntArray
    near: IntArray


def windings_at(contours: Sequence[FloatArray], points: FloatArray) -> IntArray:
    """Return how often closed contours, each (k, 4, 2), run around points (m, 2) to the left."""
    if not contours:
        return np.zeros(len(points), dtype=np.intp)
    pieces = np.concatenate(contours)
    rays = Rays(points, np.tile([1.0, 0.0], (len(points), 1)))
    region = np.zeros(len(pieces), dtype=np.intp)
    return -crossed(pieces, region, 1, rays, 0.0).beyond[:, 0]


def crossed(
    pieces: FloatArray,
    region: IntArray,
    regions: int,
    rays: Rays,
    reach: float,
    progress: Callable[[float], object] = lambda _share: None,
) -> Crossed:
    """Return how rays are crossed by pieces (n, 4, 2) of regions.

    Parameters
    ----------
    pieces
        Closed contours, those of each region.
    region
        The region of each piece, (n,).
    regions
        How many there are.
    rays
        Each begins on a piece, or anywhere.
    reach
        Distance from the origin of a ray up to which a crossing is near.
    progress
        Hears the share that is done.
    """
    result = Crossed(*np.zeros((2, len(rays.origin), regions), dtype=np.intp))
    middle, radius = _discs(pieces)
    at_once = max(1, _AT_ONCE // len(pieces))
    for begin in range(0, len(rays.origin), at_once):
        progress(begin / len(rays.origin))
        origin, along = (each[begin : begin + at_once] for each in rays)
        aside = np.stack((-along[:, 1], along[:, 0]), axis=1)
        before = along @ middle.T - (along * origin).sum(axis=1)[:, None]
        beside = aside @ middle.T - (aside * origin).sum(axis=1)[:, None]
        ray, piece = np.nonzero((np.abs(before) <= radius) & (beside >= -radius - reach))
        local = pieces[piece].T - origin[ray].T[:, None]
        ahead, left = (_along(local, axis[ray]) for axis in (along, aside))
        _count(_Seen(ahead, left, begin + ray, region[piece]), reach, result)
    return result


class _Seen(NamedTuple):
    """Pieces as seen along rays: coordinates ahead and to the left of control points, (4, k)."""

    ahead: FloatArray
    left: FloatArray
    ray: IntArray
    region: IntArray

    def taken(self, chosen: BoolArray) -> _Seen:
        return _Seen(self.ahead[:, chosen], self.left[:, chosen], self.ray[chosen], self.region[chosen])

    def halved(self) -> _Seen:
        ahead, left = (np.concatenate(_halves(each), axis=1) for each in (self.ahead, self.left))
        return _Seen(ahead, left, np.tile(self.ray, 2), np.tile(self.region, 2))


def _halves(column: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients (4, k) of both halves, which share the middle to the last bit."""
    a, b, c, d = column
    ab, bc, cd = (a + b) / 2.0, (b + c) / 2.0, (c + d) / 2.0
    abc, bcd = (ab + bc) / 2.0, (bc + cd) / 2.0
    middle = (abc + bcd) / 2.0
    return np.stack((a, ab, abc, middle)), np.stack((middle, bcd, cd, d))


def _along(local: FloatArray, axis: FloatArray) -> FloatArray:
    """Return coordinates of points (2, 4, k) along axes (k, 2), bit for bit the same of the same place."""
    result: FloatArray = local[0] * axis[:, 0] + local[1] * axis[:, 1]
    return result


def _discs(pieces: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the middles and radii of discs that hold pieces, with room for roundings."""
    middle = (pieces.min(axis=1) + pieces.max(axis=1)) / 2.0
    radius = np.hypot(*np.moveaxis(pieces - middle[:, None], 2, 0)).max(axis=1)
    return middle, radius * (1.0 + 2.0**-40) + 2.0**-44 * np.abs(pieces).max(initial=0.0)


def _count(seen: _Seen, reach: float, result: Crossed) -> None:
    """Add how pieces cross their rays."""
    for step in range(_HALVINGS + 1):
        seen = seen.taken((seen.ahead.min(axis=0) < 0.0) & (seen.ahead.max(axis=0) >= 0.0))
        low, high = seen.left.min(axis=0), seen.left.max(axis=0)
        if step == _HALVINGS:
            low = high = (low + high) / 2.0
        sign = (seen.ahead[-1] >= 0.0).astype(np.intp) - (seen.ahead[0] >= 0.0)
        beyond, near = low > reach, (low >= -reach) & (high <= reach)
        for counts, where in ((result.beyond, beyond), (result.near, near)):
            np.add.at(counts, (seen.ray[where], seen.region[where]), sign[where])
        undecided = ~beyond & ~near & (high >= -reach)
        if not undecided.any():
            return
        seen = seen.taken(undecided).halved()
