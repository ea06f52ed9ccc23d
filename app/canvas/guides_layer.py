"""The guides over the drawing: dashed lines, and the words at the one under the pointer."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from ..document.model import Axis, Guide, Vector
from ..document.plane_edits import place_words
from ..plotting.halo import Halo
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plates import size_of
from ..plotting.plot_widget import PlotWidget
from ..tools.pointer import Hit, Part

_REACH = 5.0
"""Pixels from the pointer within which a guide is grabbed."""

_DASHES = (8.0, 4.0)

_GAP = 4.0


class GuidesLayer(Layer):
    """Layer of the guides, above all curves and below points and gestures.

    Attributes
    ----------
    guides
        What is drawn.
    lit
        The guide under the pointer, or that is dragged; None for none.
    """

    z = 5.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.guides: tuple[Guide, ...] = ()
        self.lit: int | None = None
        self._unit = ""
        self._halo = Halo()
        self.set_shown(False)

    def render(self, guides: tuple[Guide, ...], unit: str) -> None:
        """Draw these guides from the next paint on; `unit` is that of their places."""
        if (guides, unit) != (self.guides, self._unit):
            self.guides, self._unit = guides, unit
            self.set_shown(bool(guides))
            self.update()

    @property
    def corners(self) -> FloatArray | None:
        """The lower left and the upper right corner of what lies between the guides, (2, 2), or None."""
        at = [{each.position for each in self.guides if each.axis is axis} for axis in Axis]
        is_box = all(len(each) > 1 for each in at)
        return np.array([list(map(min, at)), list(map(max, at))]) if is_box else None

    def light(self, place: int | None) -> None:
        """Draw one of the guides lit, with its place in words."""
        if place != self.lit:
            self.lit = place
            self.update()

    def hit(self, pixel: Vector, shown: PixelMap) -> Hit | None:
        """Return the guide at a pixel of the plot area, the nearest of several."""
        if not self.is_visible or not self.guides:
            return None
        away = [abs(_pixel_of(guide, shown) - pixel[guide.axis.coordinate]) for guide in self.guides]
        # Of those at one place the last one wins: it is drawn on top.
        nearest = len(away) - 1 - int(np.argmin(away[::-1]))
        if away[nearest] > _REACH:
            return None
        return Hit(Part.GUIDE, nearest, self.guides[nearest].beside(shown.plane(*pixel)))

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw those in sight."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for place, guide in enumerate(self.guides):
            at, room = _pixel_of(guide, shown), (shown.width, shown.height)[guide.axis.coordinate]
            if 0 <= at <= room:
                self._paint_guide(painter, shown, guide, round(at), is_lit=place == self.lit)

    def _paint_guide(
        self, painter: QPainter, shown: PixelMap, guide: Guide, at: int, *, is_lit: bool
    ) -> None:
        pen = QPen(self.theme.accent, 1.0)
        if not is_lit:
            pen.setDashPattern(_DASHES)
        painter.setPen(pen)
        if guide.axis is Axis.X:
            painter.drawLine(QPointF(at, 0), QPointF(at, shown.height))
        else:
            painter.drawLine(QPointF(0, at), QPointF(shown.width, at))
        if is_lit:
            self._write(painter, shown, guide, at)

    def _write(self, painter: QPainter, shown: PixelMap, guide: Guide, at: int) -> None:
        """Write where the guide lies, near its upper or left end."""
        text = place_words(guide, self._unit)
        painter.setFont(self.fonts.times(0.95 * self.scale))
        size = size_of(painter, text)
        if guide.axis is Axis.X:
            left = at + _GAP if at + _GAP + size.width() <= shown.width else at - _GAP - size.width()
            left = max(min(left, shown.width - size.width()), 0.0)
            box = QRectF(QPointF(left, _GAP), size)
        else:
            top = at - _GAP - size.height()
            top = max(min(top if top >= 0 else at + _GAP, shown.height - size.height()), 0.0)
            box = QRectF(QPointF(_GAP, top), size)
        self._halo.write(painter, box, text, self.theme.paper, self.theme.accent_text, 2 * self.scale)


def _pixel_of(guide: Guide, shown: PixelMap) -> float:
    """Return where a guide lies in the plot area: from the left, or from the top."""
    place = (guide.position, 0.0) if guide.axis is Axis.X else (0.0, guide.position)
    return shown.point(*place)[guide.axis.coordinate]
