"""A wide line in one opaque colour, drawn as separate segments that overlap at the joints.

Qt's stroker, which joins the segments of a polyline, takes more than twice as long as all else of a frame:
for a segment by itself Qt has a rasteriser without a path.
"""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from .crowds import Crowd
from .drawing import MARGIN, cut_segments, is_crowd
from .pixel_map import PixelMap
from .segments import Segments

_OVERLAP = 0.4
"""Pixels by which both segments reach beyond a joint: less leaves a notch, more a bead at the line's edge."""


class WideLine:
    """A polyline in pixels, for a pen that is opaque and has blunt ends."""

    def __init__(self) -> None:
        self._segments = Segments()
        self._crowd: Crowd | None = None
        self._shown: tuple[FloatArray | None, PixelMap | None, float] = (None, None, 0.0)

    def show(self, points: FloatArray, shown: PixelMap, width: float) -> None:
        """Take a polyline (k, 2) of the plane, unless it is the very one that was shown so before."""
        if self._shown[0] is points and self._shown[1] is shown and self._shown[2] == width:
            return
        self._shown, self._crowd = (points, shown, width), None
        pixels = shown.points(points)
        segments = self._segments.room_for(max(len(pixels) - 1, 0))
        if not len(segments):
            return
        segments[:, :2], segments[:, 2:] = pixels[:-1], pixels[1:]
        if not _are_near(pixels, shown):
            near = cut_segments(segments, shown.width, shown.height)
            self._segments.fill(near)
            segments = self._segments.room_for(len(near))
        if is_crowd(segments):
            self._crowd = Crowd()
            self._crowd.fill(segments, shown.width, shown.height)
        else:
            overlap(segments, width)

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen."""
        (self._crowd or self._segments).draw(painter)


def _are_near(pixels: FloatArray, shown: PixelMap) -> bool:
    """Whether no pixel lies further away than a square around the area reaches: Qt clips those well."""
    # Both columns at once: apart, NumPy takes three times as long, in every frame of a drag.
    low, high = np.minimum.reduce(pixels, axis=None), np.maximum.reduce(pixels, axis=None)
    return bool(low >= -MARGIN and high <= max(shown.width, shown.height) + MARGIN)


def overlap(segments: FloatArray, width: float) -> None:
    """Make segments (m, 4) longer at both ends, so that no joint of a line `width` wide is seen.

    At a sharp corner they reach as far as its sides meet, or half the width, whichever is less.
    """
    # As complex numbers, whose size and turn NumPy finds in one step each.
    starts, ends = segments.view(np.complex128).T
    steps = ends - starts
    # One without a length has no direction to reach in.
    steps *= _OVERLAP / np.maximum(np.abs(steps), 1e-9)
    starts -= steps
    ends += steps
    # The cosines of the turns, times the square of the overlap.
    dots = (steps[1:] * steps[:-1].conj()).real
    share = (2 * _OVERLAP / width) ** 2
    # By a turn of θ the sides meet half a width times tan θ/2 beyond the joint.
    if len(dots) and np.minimum.reduce(dots) < (1 - share) / (1 + share) * _OVERLAP**2:
        cosines = dots / _OVERLAP**2
        half_turns = np.sqrt(np.maximum(1 - cosines, 0) / np.maximum(1 + cosines, 1e-9))
        most = max(width / 2, _OVERLAP)
        further = np.clip(half_turns * (width / 2), _OVERLAP, most) / _OVERLAP - 1
        starts[1:] -= further * steps[1:]
        ends[:-1] += further * steps[:-1]
