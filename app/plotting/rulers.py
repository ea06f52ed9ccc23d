"""Rulers of a plot: its axes with marks for the pointer and for what is selected."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

from PySide6.QtCore import QPoint, QPointF, QRect
from PySide6.QtGui import QColor, QPainter, QPolygonF
from PySide6.QtWidgets import QWidget

from ..appearance.theme import LIGHT, Theme
from .axes import Axes, Side
from .camera import Camera
from .pixel_map import PixelMap
from .sprites import Sprites

_MARK = 6.0
"""Pixels from the plot area to the far end of the pointer's mark."""

_REACH = math.ceil(_MARK) + 2
"""Pixels beside the plot area that marks take, along both sides and where these meet."""

_INSIDE = 2
"""Pixels of the plot area that they touch."""

_BAND = 4.0
_BAND_SHARE = 0.45


class Extent(NamedTuple):
    """Lower left and upper right corner of something in the plane."""

    low: tuple[float, float]
    high: tuple[float, float]


class Rulers:
    """Marks on the axes of a plot, while these are rulers.

    Attributes
    ----------
    pointer
        The pixel of the plot area under the pointer, None while it is elsewhere.
    extent
        That of what is selected, None for nothing.

    Parameters
    ----------
    is_due
        Tells whether the spread is painted anew in any case.
    """

    def __init__(self, viewport: QWidget, axes: Axes, camera: Camera, is_due: Callable[[], bool]) -> None:
        self._viewport, self._axes, self._camera, self._is_due = viewport, axes, camera, is_due
        self.pointer: tuple[float, float] | None = None
        self.extent: Extent | None = None
        # The colour of bands, and the theme that it is of.
        self._band: tuple[QColor, Theme | None] = (QColor(), None)
        # The marks of the pointer on both rulers, and the theme that they are of.
        self._marks, self._marks_of = Sprites[int](partial(_paint_mark, LIGHT), _MARK), LIGHT
        # The plot area with the marks beside it, and the area that it was found for.
        self._spread, self._spread_of = QRect(), QRect()

    @property
    def are_shown(self) -> bool:
        """Whether the axes are rulers."""
        return self._axes.are_rulers

    @property
    def thickness(self) -> float:
        """Pixels that the upper one takes of the height; 0 while there is none."""
        return self._camera.origin.y() if self.are_shown else 0.0

    @property
    def spread(self) -> QRect:
        """The plot area, with what the marks take beside it: one rectangle, which Qt clips to quickly."""
        area = self._camera.area
        if not self._axes.are_rulers:
            return area
        if area is not self._spread_of:
            corner = self._camera.origin.toPoint() - QPoint(_REACH, _REACH)
            self._spread, self._spread_of = QRect(corner, self._viewport.rect().bottomRight()), area
        return self._spread

    def show(self, pointer: tuple[float, float] | None, extent: Extent | None) -> None:
        """Mark these from the next paint on."""
        if (pointer, extent) == (self.pointer, self.extent):
            return
        self.pointer, self.extent = pointer, extent
        if self.are_shown and not self._is_due():
            spread = self.spread
            self._viewport.update(spread.x(), spread.y(), spread.width(), _REACH + _INSIDE)
            self._viewport.update(spread.x(), spread.y(), _REACH + _INSIDE, spread.height())

    def axis_at(self, pixel: tuple[float, float]) -> int | None:
        """Return the ruler at a pixel of the plot area: 0 for that of x, 1 for that of y, None elsewhere."""
        shown, (x, y) = self._camera.pixel_map, pixel
        if not self.are_shown:
            return None
        if y < 0 <= x <= shown.width:
            return 0
        return 1 if x < 0 <= y <= shown.height else None

    def paint(self, painter: QPainter, shown: PixelMap, theme: Theme) -> None:
        """Paint the marks, in pixels of the plot area."""
        if not self.are_shown:
            return
        sides = self._axes.sides(shown)
        if self.extent is not None:
            self._paint_bands(painter, sides, self.extent, theme)
        if self.pointer is not None:
            if self._marks_of is not theme:
                self._marks, self._marks_of = Sprites(partial(_paint_mark, theme), _MARK), theme
            x, y = self.pointer
            marks = [(0, x, 0.0)] * (0 <= x <= shown.width) + [(1, 0.0, y)] * (0 <= y <= shown.height)
            self._marks.draw(painter, marks)

    def _paint_bands(self, painter: QPainter, sides: Sequence[Side], extent: Extent, theme: Theme) -> None:
        """Paint how far the selection reaches, with a line at each end of it."""
        if self._band[1] is not theme:
            colour = QColor(theme.accent)
            colour.setAlphaF(_BAND_SHARE)
            self._band = (colour, theme)
        painter.setPen(theme.accent)
        for axis, side in enumerate(sides):
            ends = sorted((side.at(extent.low[axis]), side.at(extent.high[axis])))
            first, last = max(ends[0], 0.0), min(ends[1], side.length)
            if first <= last:
                painter.fillRect(side.box(first, last, 0, _BAND), self._band[0])
                for end in (round(first), round(last)):
                    painter.drawLine(side.point(end, 0), side.point(end, _MARK))


def _paint_mark(theme: Theme, painter: QPainter, axis: int) -> None:
    """Draw a triangle beside the plot area that points at the drawing: above it for x, left of it for y."""
    half = 0.7 * _MARK
    corners = [(0.0, 0.0), (-half, -_MARK), (half, -_MARK)]
    painter.setPen(theme.surface)
    painter.setBrush(theme.ink)
    painter.drawPolygon(QPolygonF([QPointF(y, x) if axis else QPointF(x, y) for x, y in corners]))
