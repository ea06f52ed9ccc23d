"""Tips of mitered corners of strokes."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import BoolArray, FloatArray
from curvecore.vectors import cross


def miter_tips(points: FloatArray, before: FloatArray, after: FloatArray, half: float) -> FloatArray:
    """Return the tips of miters at joints (m, 2) between directions, unit vectors, that do not turn back."""
    cosine = (before * after).sum(axis=1)
    aside = before + after
    outwards = np.sign(cross(before, after))[:, None] * np.stack((aside[:, 1], -aside[:, 0]), axis=1)
    # The tip is 1 / cos(φ/2) as far away as the sides, φ being the turn.
    tips: FloatArray = points + half * outwards / (1.0 + cosine)[:, None]
    return tips


def are_pointed(before: FloatArray, after: FloatArray, limit: float) -> BoolArray:
    """Tell which joints between directions, unit vectors, are not too sharp for a miter."""
    pointed: BoolArray = (1.0 + (before * after).sum(axis=1)) * limit * limit >= 2.0
    return pointed
