"""Preview of the pen before it is pressed: the curve with one point more, or the spot to insert at."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPen

from app.canvas.curve_layer import line_of
from app.document.model import Vector
from app.plotting.drawing import Stroke, is_near
from app.plotting.layers import Layer
from app.plotting.pixel_map import PixelMap
from app.plotting.plot_widget import PlotWidget
from app.view_model.curve_view import CurveView


class PenLayer(Layer):
    """Draws a thin line below the curve, so that only what would change is seen, and a ring on the curve."""

    z = -0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._preview: CurveView | None = None
        self._spot: Vector | None = None
        self._stroke = Stroke()
        self._ring = Layer(plot, self._paint_ring, z=9.5)

    def render(self, preview: CurveView | None, spot: Vector | None) -> None:
        """Draw these from the next paint on; None for nothing."""
        if preview is not self._preview:
            self._preview = preview
            self.update()
        if spot != self._spot:
            self._spot = spot
            self._ring.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the line."""
        view = self._preview
        if view is None:
            return
        self._stroke.show(line_of(view, shown).points, shown)
        painter.setPen(QPen(self.theme.ghost, 1.3 * self.scale))
        self._stroke.draw(painter)

    def _paint_ring(self, painter: QPainter, shown: PixelMap) -> None:
        if self._spot is None:
            return
        x, y = shown.point(*self._spot)
        if not is_near(x, y):
            return
        painter.setBrush(self.theme.paper)
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        painter.drawEllipse(QPointF(x, y), 4 * self.scale, 4 * self.scale)
        painter.setBrush(Qt.BrushStyle.NoBrush)
