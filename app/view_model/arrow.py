"""The lines of an arrow."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray


def arrow_segments(start: tuple[float, float], tip: tuple[float, float], head: float) -> FloatArray:
    """Return shaft and barbs as segments (3, 4) = x1, y1, x2, y2.

    A short arrow has a small head, so that its shaft is seen.
    """
    along = np.subtract(tip, start)
    length = float(np.hypot(*along))
    barb = along * (min(head, length / 2) / length if length else 0.0)
    side = np.array([-barb[1], barb[0]]) * 0.45
    ends = [start, tip - barb + side, tip - barb - side]
    return np.array([[*tip, *end] for end in ends])
