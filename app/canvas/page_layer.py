"""The page of the document: the edge of what its pictures show."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from ..document.model import Page
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget

_BEYOND = 10.0
"""Pixels out of sight to which an edge is drawn at most."""


class PageLayer(Layer):
    """Layer of the page's edge, above the grid and below the curves.

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
        """Draw the edge, on whole pixels so that it stays crisp."""
        if self.page is None:
            return
        page = self.page
        corners = np.array([(page.x, page.y), (page.x + page.width, page.y + page.height)])
        pixels = np.clip(shown.points(corners), -_BEYOND, (shown.width + _BEYOND, shown.height + _BEYOND))
        (left, bottom), (right, top) = np.round(pixels).tolist()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.muted, 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(QRectF(left, top, right - left, bottom - top))
