"""Preview of the pen before it is pressed: the curve with one point more; the lines that the pencil draws."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QPainter, QPen

from ..document.model import Vector
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..view_model.curve.curve_view import CurveView
from .looks import line_of


class PenLayer(Layer):
    """Layer of a thin line below the curve, so that only what would change is seen."""

    z = -0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._preview: CurveView | None = None
        self._lines: tuple[tuple[Vector, ...], ...] = ()
        self._stroke = Stroke()
        self.set_visible(False)

    def render(self, preview: CurveView | None, lines: tuple[tuple[Vector, ...], ...]) -> None:
        """Draw this curve and these lines from the next paint on; None and () for nothing."""
        if preview is not self._preview or lines != self._lines:
            self._preview, self._lines = preview, lines
            self.set_visible(preview is not None or bool(lines))
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the curve or the lines."""
        if self._preview is not None:
            self._stroke.show(line_of(self._preview, shown).points, shown)
            painter.setPen(QPen(self.theme.ghost, 1.3 * self.scale))
            self._stroke.draw(painter)
            return
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        for line in self._lines:
            self._stroke.show(np.array(line), shown)
            self._stroke.draw(painter)
