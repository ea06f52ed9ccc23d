"""The control polygon: of a curve that does not pass its points, the lines from one to the next."""

from __future__ import annotations

from PySide6.QtGui import QPainter, QPen

from ..appearance.theme import Theme
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..view_model.curve.curve_view import CurveView
from .point_layer import opacity_of

_WIDTH = 1.0


class ControlPolygonLayer(Layer):
    """Layer below the curve that is edited; a curve through its points has none."""

    z = -0.25

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._view: CurveView | None = None
        self._stroke = Stroke()
        # The pen of the last frame, and what it was made for.
        self._made_for: tuple[Theme, float] | None = None
        self._made = QPen()
        self.set_visible(False)

    def render(self, view: CurveView) -> None:
        """Draw the polygon of `view` from the next paint on."""
        self._view = view
        self.set_visible(view.source.family.has_control_points)
        if self.is_visible:
            self.set_opacity(opacity_of(view))
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw thin lines, which stand back behind the curve."""
        if self._view is None or len(self._view.points) < 2:
            return
        self._stroke.show(self._view.points, shown)
        if self._made_for != (self.theme, self.scale):
            self._made_for = (self.theme, self.scale)
            self._made = QPen(self.theme.handle, _WIDTH * self.scale)
        painter.setPen(self._made)
        self._stroke.draw(painter)
