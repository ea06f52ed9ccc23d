"""The page of the document: the edge of what its pictures show, and the desk around it."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen

from ..appearance.theme import mix
from ..document.model import Page
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from .grid_layer import GridLayer

_BEYOND = 10.0
"""Pixels out of sight to which an edge is drawn at most."""

_MIDDLE = 0.5
_FINE, _COARSE = 0.08, 0.16
"""Contrast of the lines of the grid around a page: as on it."""


class PageLayer(Layer):
    """Layer of the page's edge and of the desk, above the grid and below the curves.

    Attributes
    ----------
    page
        What is drawn; None for nothing.
    """

    z = -8.0
    is_still = True

    def __init__(self, plot: PlotWidget, grid: GridLayer) -> None:
        super().__init__(plot)
        self._grid = grid
        self.page: Page | None = None

    def render(self, page: Page | None) -> None:
        """Draw this page from the next paint on."""
        if page != self.page:
            self.page = page
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Lay the desk around the page, with the grid on it, and draw the edge, on whole pixels: crisp."""
        if self.page is None:
            return
        page = self.page
        corners = np.array([(page.x, page.y), (page.x + page.width, page.y + page.height)])
        pixels = np.clip(shown.points(corners), -_BEYOND, (shown.width + _BEYOND, shown.height + _BEYOND))
        (left, bottom), (right, top) = np.round(pixels).tolist()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        everything = QRectF(-_BEYOND, -_BEYOND, shown.width + 2 * _BEYOND, shown.height + 2 * _BEYOND)
        edge = QRectF(left, top, right - left, bottom - top)
        around = QPainterPath()
        around.addRect(everything)
        around.addRect(edge)
        painter.save()
        painter.setClipPath(around, Qt.ClipOperation.IntersectClip)
        desk = self.theme.desk
        painter.fillRect(everything, desk)
        if self._grid.is_visible and self._grid.is_shown:
            line = max(
                self.theme.paper, self.theme.ink, key=lambda each: abs(each.lightnessF() - desk.lightnessF())
            )
            self._grid.paint_in(painter, shown, mix(line, desk, _FINE), mix(line, desk, _COARSE))
        painter.restore()
        painter.setPen(QPen(self.theme.muted, 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(edge)
