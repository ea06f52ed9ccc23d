"""Holes of contours, and the contours around them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore.arrays import FloatArray
from curvecore.bezier.bernstein_algebra import values
from curvecore.regions.rays import windings_at
from curvecore.regions.region import contour_area


def connected_parts(contours: Sequence[FloatArray]) -> list[tuple[FloatArray, ...]]:
    """Return contours that run around parts of the inside to the left, each with the holes in it.

    They do not cross, and holes run to the right.
    """
    areas = [contour_area(each) for each in contours]
    outer = [place for place, area in enumerate(areas) if area > 0.0]
    found = {place: [contours[place]] for place in outer}
    holes = [contours[place] for place, area in enumerate(areas) if area <= 0.0]
    if not holes or not outer:
        return [tuple(each) for each in found.values()]
    # A place of a hole that is not one where it touches what is around it.
    spots = np.array([values(hole[:1], np.array([0.5]))[0] for hole in holes])
    around = np.array([windings_at([contours[place]], spots) > 0 for place in outer])
    sizes = np.where(around, np.array([areas[place] for place in outer])[:, None], np.inf)
    for hole, place in zip(holes, sizes.argmin(axis=0).tolist(), strict=True):
        found[outer[place]].append(hole)
    return [tuple(each) for each in found.values()]
