"""Preview of the pen before it is pressed: the curve with one point more."""

from __future__ import annotations

from PySide6.QtGui import QPainter, QPen

from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..view_model.curve_view import CurveView
from .curve_layer import line_of


class PenLayer(Layer):
    """Layer of a thin line below the curve, so that only what would change is seen."""

    z = -0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._preview: CurveView | None = None
        self._stroke = Stroke()

    def render(self, preview: CurveView | None) -> None:
        """Draw this curve from the next paint on; None for nothing."""
        if preview is not self._preview:
            self._preview = preview
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the line."""
        view = self._preview
        if view is None:
            return
        self._stroke.show(line_of(view, shown).points, shown)
        painter.setPen(QPen(self.theme.ghost, 1.3 * self.scale))
        self._stroke.draw(painter)
