"""Wide lines in one opaque colour, drawn as separate segments that overlap at the joints.

Qt's stroker, which joins the segments of a polyline, takes more than twice as long as all else of a frame:
for a segment by itself Qt has a rasteriser without a path.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from .drawing import MARGIN, Crowd, Points, Segments, cut_segments, is_crowd
from .pixel_map import PixelMap

_ComplexArray = NDArray[np.complex128]

_OVERLAP = 0.4
"""Pixels by which both segments extend beyond a joint: less leaves a notch, more a bead at the edge."""


class WideLine:
    """A polyline in pixels, for a pen that is opaque and has blunt ends."""

    def __init__(self) -> None:
        self._segments = Segments()
        self._crowd: Crowd | None = None
        self._source: tuple[FloatArray | None, PixelMap | None, float] = (None, None, 0.0)

    def show(self, points: FloatArray, pixel_map: PixelMap, width: float) -> None:
        """Take a polyline (k, 2) of the plane, unless it is the same array, map and width as before."""
        if self._source[0] is points and self._source[1] is pixel_map and self._source[2] == width:
            return
        self._source = (points, pixel_map, width)
        self.fill(pixel_map.points(points), pixel_map, width)

    def fill(self, pixels: FloatArray, pixel_map: PixelMap, width: float) -> None:
        """Take a polyline (k, 2) in pixels; only its part near the area is drawn."""
        self._crowd = None
        segments = self._segments.room_for(max(len(pixels) - 1, 0))
        segments[:, :2], segments[:, 2:] = pixels[:-1], pixels[1:]
        if len(segments) and not _are_near(pixels, pixel_map):
            near = cut_segments(segments, pixel_map.width, pixel_map.height)
            self._segments.fill(near)
            segments = self._segments.room_for(len(near))
        if not len(segments):
            return
        if is_crowd(segments):
            self._crowd = Crowd()
            self._crowd.fill(segments, pixel_map.width, pixel_map.height)
        else:
            self._join(segments, width)

    def _join(self, segments: FloatArray, width: float) -> None:
        """Join segments (m, 4) to one line."""
        steps, cosines = overlap(segments)
        reach_to_corners(segments, steps, cosines, width)

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen."""
        (self._crowd or self._segments).draw(painter)


class RoundLine(WideLine):
    """A polyline in pixels with round ends and corners, for a pen that is opaque and wider than a pixel."""

    def __init__(self) -> None:
        super().__init__()
        # The ends, and the corners at which the sides of overlapping segments do not meet.
        self._discs = Points()

    def _join(self, segments: FloatArray, width: float) -> None:
        steps, cosines = overlap(segments)
        starts, ends = segments.view(np.complex128).T
        discs = np.array([starts[0] + steps[0], ends[-1] - steps[-1]])
        if _have_corners(cosines, width):
            sharp = np.flatnonzero(cosines < _least_cosine(width)) + 1
            discs = np.concatenate([discs, starts[sharp] + steps[sharp]])
        self._discs.fill(discs.view(np.float64).reshape(-1, 2))

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen."""
        if self._crowd or not len(self._segments):
            super().draw(painter)
            return
        rounded = painter.pen()
        blunt = QPen(rounded)
        blunt.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(blunt)
        self._segments.draw(painter)
        painter.setPen(rounded)
        self._discs.draw(painter)


def _are_near(pixels: FloatArray, pixel_map: PixelMap) -> bool:
    """Whether all pixels lie in a square around the area: Qt clips those well."""
    # Both columns at once: separately, NumPy takes three times as long in every frame of a drag.
    low, high = np.minimum.reduce(pixels, axis=None), np.maximum.reduce(pixels, axis=None)
    return bool(low >= -MARGIN and high <= max(pixel_map.width, pixel_map.height) + MARGIN)


def overlap(segments: FloatArray) -> tuple[_ComplexArray, FloatArray]:
    """Extend segments (m, 4) at both ends, so that no joint of a smooth line is visible.

    Returns
    -------
    steps, cosines
        The extension of each segment as a complex number, (m,); the cosines of the turns from one segment to
        the next, (m − 1,).
    """
    # As complex numbers, whose sizes and turns NumPy computes in one step each.
    starts, ends = segments.view(np.complex128).T
    steps = ends - starts
    # A segment without length has no direction.
    steps *= _OVERLAP / np.maximum(np.abs(steps), 1e-9)
    starts -= steps
    ends += steps
    return steps, (steps[1:] * steps[:-1].conj()).real / _OVERLAP**2


def _least_cosine(width: float) -> float:
    """Return the cosine of the sharpest turn at which the sides of overlapping segments still meet.

    At a turn of θ they meet half the width times tan θ/2 beyond the joint.
    """
    share = (2 * _OVERLAP / width) ** 2
    return (1 - share) / (1 + share)


def _have_corners(cosines: FloatArray, width: float) -> bool:
    """Whether a line of this width has turns at which the overlap is too small."""
    return len(cosines) > 0 and bool(np.minimum.reduce(cosines) < _least_cosine(width))


def reach_to_corners(segments: FloatArray, steps: _ComplexArray, cosines: FloatArray, width: float) -> None:
    """Extend overlapping segments at sharp corners to where their sides meet, at most by half the width."""
    if not _have_corners(cosines, width):
        return
    starts, ends = segments.view(np.complex128).T
    half_turns = np.sqrt(np.maximum(1 - cosines, 0) / np.maximum(1 + cosines, 1e-9))
    maximum = max(width / 2, _OVERLAP)
    further = np.clip(half_turns * (width / 2), _OVERLAP, maximum) / _OVERLAP - 1
    starts[1:] -= further * steps[1:]
    ends[:-1] += further * steps[:-1]
