"""Areas inside of polylines, cut to what is near the visible area: a fill may reach beyond every picture."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray

_FARTHEST = 1e150
"""Pixels beyond which a vertex is drawn nearer, so that no difference of two overflows."""


def ring_within(points: FloatArray, width: float, height: float, margin: float) -> FloatArray:
    """Return the part of a closed polyline (k, 2) in pixels that lies within an area and a margin around it.

    What lies outside is led along the edges, so that inside everything is wound about as often as before:
    Sutherland and Hodgman, Communications of the ACM 17 (1974) 32–42.
    """
    low, high = -margin, (width + margin, height + margin)
    if bool(((points >= low) & (points <= high)).all()):
        return points
    ring = np.clip(points, -_FARTHEST, _FARTHEST)
    for axis in (0, 1):
        ring = _beyond(ring, axis, low, 1.0)
        ring = _beyond(ring, axis, high[axis], -1.0)
    return ring


def _beyond(ring: FloatArray, axis: int, limit: float, sign: float) -> FloatArray:
    """Return the part of a ring on the side of a limit to which `sign` points."""
    if not len(ring):
        return ring
    distance = sign * (ring[:, axis] - limit)
    is_inside = distance >= 0
    if is_inside.all():
        return ring
    following, after = np.roll(ring, -1, axis=0), np.roll(distance, -1)
    crosses = is_inside != (after >= 0)
    share = distance[crosses] / (distance[crosses] - after[crosses])
    cut = ring[crosses] + share[:, None] * (following[crosses] - ring[crosses])
    cut[:, axis] = limit
    # Each vertex that is kept, and after it the place where the edge from it crosses the limit.
    count = is_inside.astype(np.intp) + crosses
    ends = np.cumsum(count)
    result = np.empty((int(ends[-1]), 2))
    result[ends[crosses] - 1] = cut
    result[(ends - count)[is_inside]] = ring[is_inside]
    return result
