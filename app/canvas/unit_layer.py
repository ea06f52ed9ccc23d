"""The name of the unit at the ends of the axes."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter

from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget


class UnitLayer(Layer):
    """Layer of the unit's name, at the right end of the x axis and the upper end of the y axis."""

    z = -5.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._unit = ""
        self.set_visible(False)

    def render(self, unit: str) -> None:
        """Write this name from the next paint on; empty for none."""
        self._unit = unit
        self.set_visible(bool(unit))
        self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Write the name twice."""
        if not self._unit:
            return
        painter.setFont(self.fonts.less(1.5, 1.0))
        painter.setPen(self.theme.muted)
        side = Qt.AlignmentFlag
        below = QRectF(shown.width - 126, shown.height - 22, 120, 18)
        painter.drawText(below, int(side.AlignRight | side.AlignBottom), self._unit)
        painter.drawText(QRectF(6, 4, 120, 18), int(side.AlignLeft | side.AlignTop), self._unit)
