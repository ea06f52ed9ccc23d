"""The name of the unit where both axes begin, and what the numbers at the left leave out."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter

from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plates import size_of, write_on_plate
from ..plotting.plot_widget import PlotWidget


class UnitLayer(Layer):
    """Layer of the unit's name, at the upper end of the y axis.

    What has to be added to the numbers of that axis stands before it: they have too little room for it.
    """

    z = -5.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._plot = plot
        self._unit = ""

    def render(self, unit: str) -> None:
        """Write this name from the next paint on; empty for none."""
        self._unit = unit
        self.update()

    def words(self, shown: PixelMap) -> str:
        """Return what stands there."""
        offset = self._plot.getAxis("left").ticks_in(shown).offset
        return " ".join(filter(None, (offset, self._unit)))

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Write it."""
        painter.setFont(self.fonts.less(1.5, 1.0))
        if text := self.words(shown):
            # In the colours of the axes, which it belongs to.
            plate = QRectF(QPointF(3, 4), size_of(painter, text, 8.0, 2.0))
            write_on_plate(painter, plate, text, self.theme.surface, self.theme.muted)
