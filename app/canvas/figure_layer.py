"""Figures over and under the curve: combs, vectors, bands, marks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from app.plot.drawing import MARGIN, Segments, Stroke, cut_segments, polygon
from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme
from app.view_model.analysis.figures import Figure, Shape, Style

_HEAD = 9.0
"""Length of an arrow's head, in widths of its line."""

_MARK = 3.5
"""Radius of a mark in pixels."""

_FAR = 1e5
"""Pixels beyond which an area need not be where it is."""


@dataclass(frozen=True)
class Look:
    """How a style is drawn."""

    colour: str
    """An attribute of the theme."""
    opacity: float = 1.0
    width: float = 1.0
    line: Qt.PenStyle = Qt.PenStyle.SolidLine


LOOKS = {
    Style.COMB_TEETH: Look("accent", 0.35),
    Style.COMB_EDGE: Look("accent", 0.9),
}


class FigureLayer:
    """Draws figures of the plane, each in the pen of its style."""

    def __init__(self, plot: PlotWidget, theme: Theme, *, z: float) -> None:
        self.theme = theme
        self.scale = 1.0
        self.figures: Sequence[Figure] = ()
        self._layer = plot.add_layer(self.paint, z=z)

    def render(self, figures: Sequence[Figure]) -> None:
        """Draw `figures` from the next paint on."""
        if figures or self.figures:
            self.figures = figures
            self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the figures, the first one first."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        for figure in self.figures:
            painter.setPen(self._pen(LOOKS[figure.style]))
            _PAINTERS[figure.shape](painter, figure, shown)

    def _pen(self, look: Look) -> QPen:
        colour = QColor(getattr(self.theme, look.colour))
        colour.setAlphaF(look.opacity)
        return QPen(colour, look.width * self.scale, look.line)


def _line(painter: QPainter, figure: Figure, shown: PixelMap) -> None:
    stroke = Stroke()
    stroke.fill(shown.points(figure.points), shown.width, shown.height)
    stroke.draw(painter)


def _segments(painter: QPainter, figure: Figure, shown: PixelMap) -> None:
    drawn = Segments()
    drawn.fill(cut_segments(shown.points(figure.points).reshape(-1, 4), shown.width, shown.height))
    drawn.draw(painter)


def _arrows(painter: QPainter, figure: Figure, shown: PixelMap) -> None:
    """Draw segments with heads; short arrows have small heads, so that the shaft is seen."""
    ends = shown.points(figure.points).reshape(-1, 2, 2)
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    unit = along / np.where(length > 0, length, 1.0)[:, None]
    head = np.minimum(_HEAD * painter.pen().widthF(), length / 2)[:, None] * unit
    side = np.column_stack([-head[:, 1], head[:, 0]]) * 0.45
    tips = ends[:, 1]
    barbs = [np.hstack([tips, tips - head + sign * side]) for sign in (1, -1)]
    drawn = Segments()
    drawn.fill(cut_segments(np.vstack([ends.reshape(-1, 4), *barbs]), shown.width, shown.height))
    drawn.draw(painter)


def _area(painter: QPainter, figure: Figure, shown: PixelMap) -> None:
    pixels = np.clip(shown.points(figure.points), -_FAR, _FAR)
    painter.setBrush(painter.pen().color())
    painter.setPen(Qt.PenStyle.NoPen)
    painter.drawPolygon(polygon(pixels[:, 0], pixels[:, 1]), Qt.FillRule.WindingFill)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _marks(painter: QPainter, figure: Figure, shown: PixelMap) -> None:
    pixels = shown.points(figure.points)
    near = np.all((pixels >= -MARGIN) & (pixels <= (shown.width + MARGIN, shown.height + MARGIN)), axis=1)
    for x, y in pixels[near].tolist():
        painter.drawEllipse(QPointF(x, y), _MARK, _MARK)


_PAINTERS = {
    Shape.LINE: _line,
    Shape.SEGMENTS: _segments,
    Shape.ARROWS: _arrows,
    Shape.AREA: _area,
    Shape.MARKS: _marks,
}
