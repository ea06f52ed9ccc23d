"""The page of the document: the edge of what its pictures show, and the pasteboard around it."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen

from ..document.model import Page
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget

_BEYOND = 10.0
"""Pixels out of sight to which an edge is drawn at most."""

_PASTEBOARD = 0.14
"""Opacity of ink over the paper around a page."""


class PageLayer(Layer):
    """Layer of the page's edge and of the pasteboard, above the grid and below the curves.

    Attributes
    ----------
    page
        What is drawn; None for nothing.
    """

    z = -8.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.page: Page | None = None

    def render(self, page: Page | None) -> None:
        """Draw this page from the next paint on."""
        if page != self.page:
            self.page = page
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Shade what is not the page, and draw its edge, on whole pixels so that it stays crisp."""
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
        shade = QColor(self.theme.ink)
        shade.setAlphaF(_PASTEBOARD)
        painter.fillPath(around, shade)
        painter.setPen(QPen(self.theme.muted, 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(edge)
