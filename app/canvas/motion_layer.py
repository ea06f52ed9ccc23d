"""A motion on the canvas: dots with their trails, velocities and accelerations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from curvecore.arrays import FloatArray

from ..appearance.colours import line_colour
from ..appearance.theme import mix
from ..plotting.drawing import draw_segments, is_near
from ..plotting.layers import Layer
from ..plotting.pens import draw_line
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import clear_of, inside, size_of, write_on_plate
from ..view_model.line_styles import DASHED
from ..view_model.motion import (
    ACTIVE,
    TRAIL,
    Dot,
    Role,
    arrow_segments,
    colour_of,
)

_TRAIL_DOT = 3.0
_LONGEST = 1e5
_Pixel = tuple[float, float]
_SHORTEST = 3.0
"""Length in pixels below which an arrow is not drawn: its head would cover it."""


class MotionLayer(Layer):
    """Layer of moving dots; the dot of the scrub line lies on top of them."""

    z = 9.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.dots: Sequence[Dot] = ()
        self.lines: Sequence[tuple[Role, FloatArray]] = ()
        self._plates: list[QRectF] = []

    def render(self, dots: Sequence[Dot], lines: Sequence[tuple[Role, FloatArray]]) -> None:
        """Draw `dots`, and the curves that some of them run along, from the next paint on."""
        self.dots, self.lines = dots, lines
        self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the lines, then the trails, then the dots with their arrows."""
        for role, line in self.lines:
            self._paint_line(painter, pixel_map, role, line)
        for dot in self.dots:
            self._paint_trail(painter, pixel_map, dot)
        self._plates.clear()
        painter.setFont(self.fonts.at(9.0 * self.scale))
        for dot in self.dots:
            self._paint_dot(painter, pixel_map, dot)

    def _colour(self, role: Role) -> QColor:
        return line_colour(role.colour, self.theme) if role.colour else QColor(self.theme.accent)

    def _paint_line(self, painter: QPainter, pixel_map: PixelMap, role: Role, line: FloatArray) -> None:
        painter.setPen(QPen(mix(self._colour(role), self.theme.paper, 0.6), self.scale))
        draw_line(painter, pixel_map.points(line), DASHED, pixel_map)

    def _paint_trail(self, painter: QPainter, pixel_map: PixelMap, dot: Dot) -> None:
        colour = self._colour(dot.role)
        painter.setPen(Qt.PenStyle.NoPen)
        radius = _TRAIL_DOT * self.scale
        with np.errstate(all="ignore"):
            pixels = pixel_map.points(dot.trail)
        for age, (x, y) in enumerate(pixels.tolist()):
            if is_near(x, y):
                colour.setAlphaF(0.65 * (1.0 - age / TRAIL))
                painter.setBrush(colour)
                painter.drawEllipse(QPointF(x, y), radius, radius)

    def _paint_dot(self, painter: QPainter, pixel_map: PixelMap, dot: Dot) -> None:
        x, y = pixel_map.point(*dot.position)
        if not is_near(x, y):
            return
        for arrow in dot.arrows:
            colour = line_colour(colour_of(dot, arrow), self.theme)
            label = f"{dot.role.title} {arrow.text}".strip()
            self._paint_arrow(painter, pixel_map, (x, y), pixel_map.point(*arrow.tip), colour, label)
        if dot.role is not ACTIVE:
            painter.setPen(QPen(self.theme.paper, 1.5 * self.scale))
            painter.setBrush(self._colour(dot.role))
            radius = dot.role.radius * self.scale
            painter.drawEllipse(QPointF(x, y), radius, radius)

    def _paint_arrow(
        self, painter: QPainter, pixel_map: PixelMap, start: _Pixel, tip: _Pixel, colour: QColor, label: str
    ) -> None:
        length = float(np.hypot(tip[0] - start[0], tip[1] - start[1]))
        if not _SHORTEST <= length <= _LONGEST:
            return
        painter.setPen(QPen(colour, 2.0 * self.scale))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        draw_segments(painter, arrow_segments(start, tip, 9.0 * self.scale), pixel_map)
        self._write_beyond(painter, pixel_map, start, tip, label)

    def _write_beyond(
        self,
        painter: QPainter,
        pixel_map: PixelMap,
        start: _Pixel,
        tip: _Pixel,
        label: str,
    ) -> None:
        """Write beyond the tip of an arrow, on a little paper and inside the drawing."""
        size = size_of(painter, label, 6, 0)
        width, height = size.width(), size.height()
        along = np.subtract(tip, start) / max(float(np.hypot(*np.subtract(tip, start))), 1e-9)
        x = tip[0] + along[0] * (width / 2 + 4) - width / 2
        y = tip[1] + along[1] * (height / 2 + 4) - height / 2
        plate = clear_of(self._plates, inside(x, y, size, pixel_map))
        self._plates.append(plate)
        write_on_plate(painter, plate, label, self.theme.paper, painter.pen().color())
