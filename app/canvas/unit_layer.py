"""The name of the unit at the ends of the axes, and what the numbers at the left leave out."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter

from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget


class UnitLayer(Layer):
    """Layer of the unit's name, at the right end of the x axis and the upper end of the y axis.

    What has to be added to the numbers of the y axis stands there, too: they have too little room for it.
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

    def words(self, shown: PixelMap) -> tuple[str, str]:
        """Return what stands at the x axis and at the y axis."""
        offset = self._plot.getAxis("left").ticks_in(shown).offset
        return self._unit, " ".join(filter(None, (offset, self._unit)))

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Write both."""
        painter.setFont(self.fonts.less(1.5, 1.0))
        painter.setPen(self.theme.muted)
        side = Qt.AlignmentFlag
        at_x, at_y = self.words(shown)
        top = 4 if self._plot.rulers.are_shown else shown.height - 22
        left, right = int(side.AlignLeft | side.AlignVCenter), int(side.AlignRight | side.AlignVCenter)
        painter.drawText(QRectF(shown.width - 126, top, 120, 18), right, at_x)
        painter.drawText(QRectF(6, 4, 200, 18), left, at_y)
