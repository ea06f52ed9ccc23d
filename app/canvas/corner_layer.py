"""The marks of corners: a square in place of the disc, where a curve may turn sharply."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPen

from app.appearance.colours import point_colours
from app.canvas.point_layer import opacity_of
from app.plotting.layers import Layer
from app.plotting.pixel_map import PixelMap
from app.plotting.plot_widget import PlotWidget
from app.view_model.curve_view import CurveView

_HALF = 5.0
_FAR = 1e5


class CornerLayer(Layer):
    """Draws a square on every corner of the active curve; without corners it costs nothing."""

    z = 11.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._corners: list[int] = []
        self._view: CurveView | None = None

    def render(self, view: CurveView) -> None:
        """Draw the corners of `view` from the next paint on."""
        self._view = view
        self._corners = view.corners
        self.set_opacity(opacity_of(view))
        self.set_visible(bool(self._corners))
        self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the squares."""
        if self._view is None or not self._corners:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(self.theme.paper, 1.5 * self.scale))
        colours = point_colours(len(self._view.points), self.theme)
        half = _HALF * self.scale
        for index in self._corners:
            x, y = shown.point(*self._view.points[index].tolist())
            if max(abs(x), abs(y)) < _FAR:
                painter.setBrush(colours[index])
                painter.drawRect(QRectF(x - half, y - half, 2 * half, 2 * half))
