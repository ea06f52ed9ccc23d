"""Strokes that fill an area: with neighbours on both sides they need no smooth edges."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import BoolArray, FloatArray

from .segments import Segments

_NEIGHBOURS, _REACH = 2, 1.0
"""Neighbours on either side of a stroke that must lie within so many pixels: nothing is seen between them."""

_LINES, _CROSSINGS = 24, 60_000
"""Lines across the area at which neighbours are sought; crossings of lines and strokes, at most."""


class Crowd:
    """Separate segments in two calls: those at an edge of what they fill are smoothed, which takes longer."""

    def __init__(self) -> None:
        self._inner, self._edges = Segments(), Segments()

    def __len__(self) -> int:
        return len(self._inner) + len(self._edges)

    def fill(self, segments: FloatArray, width: float, height: float) -> None:
        """Take segments (m, 4) in pixels, cut to an area."""
        inner = covered(segments, width, height)
        self._inner.fill(segments[inner])
        self._edges.fill(segments[~inner])

    def draw(self, painter: QPainter) -> None:
        """Draw with the painter's pen, but with blunt ends: with others each would be made a path."""
        if not len(self):
            return
        pen, hints = painter.pen(), painter.renderHints()
        blunt = QPen(pen)
        blunt.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(blunt)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        self._inner.draw(painter)
        painter.setRenderHints(hints)
        self._edges.draw(painter)
        painter.setPen(pen)


def covered(segments: FloatArray, width: float, height: float) -> BoolArray:
    """Return which of segments (m, 4) lie between others, as far as lines across the area show."""
    is_steep = np.abs(segments[:, 3] - segments[:, 1]) >= np.abs(segments[:, 2] - segments[:, 0])
    result = np.zeros(len(segments), dtype=np.bool_)
    result[is_steep] = _have_neighbours(segments[is_steep], height)
    result[~is_steep] = _have_neighbours(segments[~is_steep][:, [1, 0, 3, 2]], width)
    return result


def _have_neighbours(segments: FloatArray, height: float) -> BoolArray:
    """Return which steep segments have neighbours left and right wherever level lines cross them."""
    if not len(segments):
        return np.zeros(0, dtype=np.bool_)
    lines = min(_LINES, _CROSSINGS // len(segments))
    level = ((np.arange(lines) + 0.5) * (height / max(lines, 1)))[:, None]
    x1, y1, x2, y2 = segments.T
    is_crossed = ((level - y1) * (level - y2) <= 0) & (y1 != y2)
    with np.errstate(divide="ignore", invalid="ignore"):
        x = np.where(is_crossed, x1 + (level - y1) * ((x2 - x1) / (y2 - y1)), np.inf)
        order = np.argsort(x, axis=1)
        x = np.take_along_axis(x, order, axis=1)
        touches = x[:, _NEIGHBOURS:] - x[:, :-_NEIGHBOURS] <= _REACH
    sorted_ones, between = np.zeros_like(is_crossed), np.zeros_like(is_crossed)
    sorted_ones[:, _NEIGHBOURS:-_NEIGHBOURS] = touches[:, :-_NEIGHBOURS] & touches[:, _NEIGHBOURS:]
    np.put_along_axis(between, order, sorted_ones, axis=1)
    result: BoolArray = is_crossed.any(axis=0) & (between | ~is_crossed).all(axis=0)
    return result
