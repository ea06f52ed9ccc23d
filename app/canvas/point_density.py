"""Sizes of the discs of points, and which are drawn at all: many of them must not hide the curve."""

from __future__ import annotations

import math
from collections.abc import Collection

import msgspec
import numpy as np

from curvecore.arrays import FloatArray, IntArray

RADIUS = 4.5
"""Radius of a disc in pixels, where there is room."""

_LEAST_RADIUS = 1.25
_RIM = 1.5
_MOST_SAMPLED, _LEAST_SAMPLED, _MOST_PAIRS = 48, 8, 16_000
"""Points that are asked how near the others are: fewer of very many, for they are asked every frame."""

_LEAST_ROOM = 3.0
"""Pixels from point to point below which discs make a ribbon, and are left away."""

_FEW = 24
"""So few points are drawn in any case: together they are no larger than a blot."""

_NEIGHBOURS = 2
_MOST_WITH_NEIGHBOURS = 32


class Discs(msgspec.Struct, frozen=True):
    """Size of the discs.

    Attributes
    ----------
    radius, rim
        In pixels.
    crowded
        Whether only those that are selected or under the pointer are drawn, and their neighbours.
    """

    radius: float
    rim: float
    crowded: bool = False


def discs_for(pixels: FloatArray, visible: IntArray, scale: float) -> Discs:
    """Return how large discs are so that about half of the curve between them stays free.

    Parameters
    ----------
    pixels
        All points, (n, 2).
    visible
        The indices of those on the screen.
    """
    if len(visible) < 2:
        return Discs(RADIUS * scale, _RIM * scale)
    gaps = _gaps(pixels, visible)
    few = len(visible) <= _FEW
    # One pair that lies close is no reason to shrink all; of many, a quarter is.
    room = float(gaps[min((len(gaps) + 1) // 2, len(gaps) - 1) if few else len(gaps) // 4])
    if not few and float(gaps[len(gaps) // 2]) < _LEAST_ROOM * scale:
        return Discs(2.0 * scale, 0.0, crowded=True)
    # In steps, so that the discs do not swell and shrink under a drag.
    radius = min(max(math.floor(room / 2) / 2, _LEAST_RADIUS * scale), RADIUS * scale)
    return Discs(radius, _RIM * scale if radius >= RADIUS * scale else 0.0)


def _gaps(pixels: FloatArray, visible: IntArray) -> FloatArray:
    """Return how far it is from points to whatever other point is nearest, ascending; of many, of some."""
    here = pixels[visible]
    wanted = min(max(_MOST_PAIRS // len(visible), _LEAST_SAMPLED), _MOST_SAMPLED)
    sample = np.arange(0, len(visible), max(len(visible) // wanted, 1))
    squares = (here[sample, :1] - here[:, 0]) ** 2
    squares += (here[sample, 1:] - here[:, 1]) ** 2
    squares[np.arange(len(sample)), sample] = np.inf
    gaps: FloatArray = np.sqrt(np.sort(squares.min(axis=1)))
    return gaps


def with_neighbours(selected: Collection[int], among: IntArray) -> IntArray:
    """Return those `among` some points that lie within two places of a selected one."""
    if len(selected) > _MOST_WITH_NEIGHBOURS:
        # They are many themselves.
        return among[:0]
    near = {index + by for index in selected for by in range(-_NEIGHBOURS, _NEIGHBOURS + 1)}
    return among[np.isin(among, np.fromiter(near, dtype=np.intp, count=len(near)))]
