"""What the basis panel draws: the functions, the t-rail and the scrub line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from app.plot.drawing import polygon
from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme, point_colours
from app.view_model.basis_view import BasisView

RAIL_HEIGHT = 34.0
"""Pixels at the foot of the plot area that belong to the t-rail."""

KIND_STYLES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine, Qt.PenStyle.DotLine)
"""Line styles of position, velocity and acceleration functions."""

_FADED, _CALM = 0.45, 0.9
_NUMBERED_UP_TO = 40
_LIMIT = 1e4


class FunctionLayer:
    """All basis functions, in one item."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self.kinds: frozenset[int] = frozenset((0, 1, 2))
        self.emphasised: frozenset[int] = frozenset()
        self._basis: BasisView | None = None
        self._polygons: dict[tuple[int, int], QPolygonF] = {}
        self._drawn: tuple[BasisView | None, PixelMap | None] = (None, None)
        self._layer = plot.add_layer(self.paint, z=0)

    def render(self, basis: BasisView | None) -> None:
        """Draw these functions from the next paint on."""
        self._basis = basis
        self._layer.update()

    def refresh(self) -> None:
        """Draw again after one of the attributes was set."""
        self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the lines 0 and 1, the functions, and the emphasised ones on top."""
        painter.setClipRect(QRectF(0, 0, shown.width, shown.height - RAIL_HEIGHT))
        self._paint_levels(painter, shown)
        basis = self._basis
        if basis is None:
            return
        if basis is not self._drawn[0] or shown is not self._drawn[1]:
            self._polygons.clear()
            self._drawn = (basis, shown)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        colours = point_colours(max(basis.owners) + 1, self.theme)
        opacity = _FADED if self.emphasised else _CALM
        for knot, owner in enumerate(basis.owners):
            if owner not in self.emphasised:
                self._paint_function(painter, shown, knot, colours[owner], 1.0, opacity)
        for knot, owner in enumerate(basis.owners):
            if owner in self.emphasised:
                self._paint_function(painter, shown, knot, colours[owner], 2.0, 1.0)

    def _paint_levels(self, painter: QPainter, shown: PixelMap) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        for level in (0.0, 1.0):
            y = round(shown.point(0.0, level)[1])
            painter.drawLine(0, y, int(shown.width), y)

    def _paint_function(
        self,
        painter: QPainter,
        shown: PixelMap,
        index: int,
        colour: QColor,
        width: float,
        opacity: float,
    ) -> None:
        assert self._basis is not None
        colour = QColor(colour)
        colour.setAlphaF(opacity)
        pen = QPen(colour, width * self.scale)
        for kind in range(self._basis.kinds):
            if kind in self.kinds:
                pen.setStyle(KIND_STYLES[kind])
                painter.setPen(pen)
                painter.drawPolyline(self._polygon(shown, index, kind))

    def _polygon(self, shown: PixelMap, index: int, kind: int) -> QPolygonF:
        key = (index, kind)
        if key not in self._polygons:
            assert self._basis is not None
            t, values = self._basis.function(index, kind)
            y = np.clip(shown.y(values), -_LIMIT, _LIMIT)
            self._polygons[key] = polygon(np.clip(shown.x(t), -_LIMIT, _LIMIT), y)
        return self._polygons[key]


class RailLayer:
    """The t-rail: a tick for each t_i in the colour of its point; and the scrub line above it."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self.selection: frozenset[int] = frozenset()
        self.hovered = -1
        self.scrub: float | None = None
        self._parameters: Sequence[float] = ()
        self._owners: Sequence[int] = ()
        self._font = QFont(plot.font())
        self._layer = plot.add_layer(self.paint, z=10)

    def render(self, basis: BasisView | None) -> None:
        """Draw a tick at every knot from the next paint on."""
        self._parameters = basis.curve.parameters.tolist() if basis is not None else ()
        self._owners = basis.owners if basis is not None else ()
        self._layer.update()

    def refresh(self) -> None:
        """Draw again after one of the attributes was set."""
        self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw rail, ticks and scrub line."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        top = shown.height - RAIL_HEIGHT
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        painter.drawLine(QPointF(0, round(top) + 0.5), QPointF(shown.width, round(top) + 0.5))
        self._paint_ticks(painter, shown, top)
        if self.scrub is not None:
            self._paint_scrub(painter, shown, self.scrub)

    def _paint_ticks(self, painter: QPainter, shown: PixelMap, top: float) -> None:
        colours = point_colours(max(self._owners, default=-1) + 1, self.theme)
        last = self.selection | {self.hovered}
        knots = range(len(self._owners))
        order = sorted(knots, key=lambda knot: self._owners[knot] in last)
        numbers_right_of = -np.inf
        font = QFont(self._font)
        font.setPointSizeF(max(self._font.pointSizeF() - 1.5, 7.0) * self.scale)
        painter.setFont(font)
        for index in order:
            x = shown.point(self._parameters[index], 0.0)[0]
            if not -20 < x < shown.width + 20:
                continue
            owner = self._owners[index]
            self._paint_tick(painter, x, top, owner, colours[owner])
            chosen = owner in last
            if chosen or (len(self._parameters) <= _NUMBERED_UP_TO and x > numbers_right_of):
                self._paint_number(painter, x, top, owner, chosen=chosen)
                numbers_right_of = x + 16 * self.scale if not chosen else numbers_right_of

    def _paint_tick(self, painter: QPainter, x: float, top: float, index: int, colour: QColor) -> None:
        size = (6.5 if index == self.hovered or index in self.selection else 5.0) * self.scale
        tip = QPointF(x, top + 1)
        base = top + 1 + 2 * size
        painter.setBrush(colour)
        selected = index in self.selection
        painter.setPen(QPen(self.theme.accent if selected else self.theme.paper, 1.5 * self.scale))
        painter.drawPolygon(QPolygonF([tip, QPointF(x + size, base), QPointF(x - size, base)]))

    def _paint_number(self, painter: QPainter, x: float, top: float, index: int, *, chosen: bool) -> None:
        box = QRectF(x - 20, top + 13 * self.scale, 40, RAIL_HEIGHT - 13 * self.scale)
        if chosen:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self.theme.paper)
            painter.drawRect(QRectF(x - 9 * self.scale, box.top() + 3, 18 * self.scale, box.height() - 4))
        painter.setPen(self.theme.ink if chosen else self.theme.muted)
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), str(index))

    def _paint_scrub(self, painter: QPainter, shown: PixelMap, t: float) -> None:
        x = shown.point(t, 0.0)[0]
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        painter.drawLine(QPointF(x, 0), QPointF(x, shown.height - RAIL_HEIGHT))
        size = 6 * self.scale
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.theme.accent)
        painter.drawPolygon(QPolygonF([QPointF(x - size, 0), QPointF(x + size, 0), QPointF(x, 1.5 * size)]))
        painter.setPen(self.theme.accent)
        left = x > shown.width - 90 * self.scale
        box = QRectF(x - 98 if left else x + 8, 2, 90, 18 * self.scale)
        side = Qt.AlignmentFlag.AlignRight if left else Qt.AlignmentFlag.AlignLeft
        painter.drawText(box, int(side | Qt.AlignmentFlag.AlignTop), f"t = {t:.4g}")
