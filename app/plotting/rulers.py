"""Rulers of a plot: its axes with marks for the pointer and for what is selected."""

from __future__ import annotations

import math
from typing import NamedTuple

from PySide6.QtCore import QRect
from PySide6.QtGui import QColor, QPainter, QPolygonF
from PySide6.QtWidgets import QWidget

from ..appearance.theme import Theme
from .axes import Axes, Side
from .camera import Camera
from .pixel_map import PixelMap

_MARK = 6.0
"""Pixels from the plot area to the far end of the pointer's mark."""

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
    """

    def __init__(self, viewport: QWidget, axes: Axes, camera: Camera) -> None:
        self._viewport, self._axes, self._camera = viewport, axes, camera
        self.pointer: tuple[float, float] | None = None
        self.extent: Extent | None = None

    @property
    def are_shown(self) -> bool:
        """Whether the axes are rulers."""
        return self._axes.are_rulers

    @property
    def thickness(self) -> float:
        """Pixels that the upper one takes of the height; 0 while there is none."""
        return self._camera.origin.y() if self.are_shown else 0.0

    def show(self, pointer: tuple[float, float] | None, extent: Extent | None) -> None:
        """Mark these from the next paint on."""
        if (pointer, extent) == (self.pointer, self.extent):
            return
        self.pointer, self.extent = pointer, extent
        if self.are_shown:
            for strip in self._strips():
                self._viewport.update(strip)

    def _strips(self) -> tuple[QRect, QRect]:
        """Return what the marks take of the viewport, above the plot area and to the left of it."""
        origin, size = self._camera.origin.toPoint(), self._viewport.size()
        reach = math.ceil(_MARK) + 2
        return (
            QRect(0, origin.y() - reach, size.width(), reach + 2),
            QRect(origin.x() - reach, 0, reach + 2, size.height()),
        )

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
        band = QColor(theme.accent)
        band.setAlphaF(_BAND_SHARE)
        for axis, side in enumerate(self._axes.sides(shown)):
            if self.extent is not None:
                self._paint_band(painter, side, axis, self.extent, band, theme)
            if self.pointer is not None:
                painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
                self._paint_pointer(painter, side, self.pointer[axis], theme)

    def _paint_band(
        self, painter: QPainter, side: Side, axis: int, extent: Extent, band: QColor, theme: Theme
    ) -> None:
        """Paint how far the selection reaches, with a line at each end of it."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        ends = sorted((side.at(extent.low[axis]), side.at(extent.high[axis])))
        first, last = max(ends[0], 0.0), min(ends[1], side.length)
        if first > last:
            return
        painter.fillRect(side.box(first, last, 0, _BAND), band)
        painter.setPen(theme.accent)
        for end in (round(first), round(last)):
            painter.drawLine(side.point(end, 0), side.point(end, _MARK))

    def _paint_pointer(self, painter: QPainter, side: Side, along: float, theme: Theme) -> None:
        """Paint a triangle that points at the drawing."""
        if not 0 <= along <= side.length:
            return
        half = 0.7 * _MARK
        tip = [side.point(along, 0), side.point(along - half, _MARK), side.point(along + half, _MARK)]
        painter.setPen(theme.surface)
        painter.setBrush(theme.ink)
        painter.drawPolygon(QPolygonF(tip))
