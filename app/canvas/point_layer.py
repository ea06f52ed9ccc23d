"""Points, their handles, their numbers, and their weights at the scrub line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from app.plot.pixel_map import Floats, PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme, point_colours
from app.view_model.curve_view import CurveView
from app.view_model.handles import Handle, handles_of

_RADIUS, _SELECTED_RADIUS, _GROWTH = 4.5, 5.5, 1.0
_LABELLED_UP_TO = 12
_WEIGHED_UP_TO = 24
_FAR = 1e5


class PointLayer:
    """Draws the nodes of the active curve; all in one item."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self.selection: frozenset[int] = frozenset()
        self.hovered = -1
        self.weights: Floats | None = None
        self.scrub: tuple[float, float, float] | None = None
        self._view: CurveView | None = None
        self._handles: list[Handle] = []
        self._layer = plot.add_layer(self.paint, z=10)
        self._font = QFont(plot.font())

    def render(self, view: CurveView) -> None:
        """Draw `view` from the next paint on."""
        self._view = view
        self._handles = self._handles_now()
        self._layer.update()

    def refresh(self) -> None:
        """Draw again after one of the attributes was set."""
        self._handles = self._handles_now()
        self._layer.update()

    @property
    def handles(self) -> Sequence[Handle]:
        """The handles on screen, those of the selected point."""
        return self._handles

    def _handles_now(self) -> list[Handle]:
        if self._view is None or len(self.selection) != 1:
            return []
        return handles_of(self._view, next(iter(self.selection)))

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw weights, handles, points and numbers."""
        view = self._view
        if view is None or not len(view.points):
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        colours = point_colours(len(view.points), self.theme)
        pixels = shown.points(view.points)
        visible = np.flatnonzero(_is_near(pixels, shown)).tolist()
        places = pixels.tolist()
        if self.weights is not None and len(self.weights) == len(places):
            self._paint_weights(painter, places, visible, colours)
        self._paint_handles(painter, shown)
        self._paint_points(painter, places, visible, colours)
        self._paint_numbers(painter, pixels, visible)
        if self.scrub is not None:
            self._paint_scrub_dot(painter, shown)

    # Points

    def _paint_points(
        self,
        painter: QPainter,
        places: list[list[float]],
        visible: list[int],
        colours: Sequence[QColor],
    ) -> None:
        rim = QPen(self.theme.paper, 1.5 * self.scale)
        painter.setPen(rim)
        for index in visible:
            if index not in self.selection:
                painter.setBrush(colours[index])
                radius = (_RADIUS + (_GROWTH if index == self.hovered else 0)) * self.scale
                painter.drawEllipse(QPointF(*places[index]), radius, radius)
        for index in self.selection:
            if index < len(places) and index in visible:
                self._paint_selected(painter, QPointF(*places[index]), colours[index])

    def _paint_selected(self, painter: QPainter, place: QPointF, colour: QColor) -> None:
        radius = _SELECTED_RADIUS * self.scale
        painter.setBrush(colour)
        painter.setPen(QPen(self.theme.paper, 1.5 * self.scale))
        painter.drawEllipse(place, radius, radius)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, 2 * self.scale))
        painter.drawEllipse(place, radius + 3 * self.scale, radius + 3 * self.scale)

    # Numbers

    def _paint_numbers(self, painter: QPainter, pixels: Floats, visible: list[int]) -> None:
        everyone = len(pixels) <= _LABELLED_UP_TO
        chosen = [i for i in visible if everyone or i in self.selection or i == self.hovered]
        if not chosen:
            return
        painter.setFont(self._scaled_font(0.95))
        painter.setPen(self.theme.muted)
        for index in chosen:
            centre = self._number_place(pixels, index)
            box = QRectF(centre.x() - 30, centre.y() - 10, 60, 20)
            painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), str(index))

    def _number_place(self, pixels: Floats, index: int) -> QPointF:
        """Put the number on the outer side of the bend, where the curve is not."""
        here = pixels[index]
        before, after = pixels[max(index - 1, 0)], pixels[min(index + 1, len(pixels) - 1)]
        outward = here - (before + after) / 2
        length = float(np.hypot(*outward))
        bends = 0 < index < len(pixels) - 1 and length > 2
        outward = outward / length if bends else _beside(after - before)
        distance = 17 * self.scale
        return QPointF(here[0] + distance * outward[0], here[1] + distance * outward[1])

    def _scaled_font(self, factor: float) -> QFont:
        font = QFont(self._font)
        font.setPointSizeF(self._font.pointSizeF() * factor * self.scale)
        return font

    # Handles

    def _paint_handles(self, painter: QPainter, shown: PixelMap) -> None:
        for handle in self._handles:
            tip, anchor = shown.point(*handle.position), shown.point(*handle.anchor)
            if max(map(abs, (*tip, *anchor))) > _FAR:
                continue
            self._paint_handle(painter, handle, QPointF(*tip), QPointF(*anchor))

    def _paint_handle(self, painter: QPainter, handle: Handle, tip: QPointF, anchor: QPointF) -> None:
        line = QPen(self.theme.handle, 1.2 * self.scale)
        line.setStyle(Qt.PenStyle.SolidLine if handle.kind == 1 else Qt.PenStyle.DotLine)
        painter.setPen(line)
        painter.drawLine(anchor, tip)
        painter.setPen(QPen(self.theme.handle, 1.5 * self.scale))
        # Filled: set by the person. Hollow: estimated by a rule.
        painter.setBrush(self.theme.handle if handle.explicit else self.theme.paper)
        size = (4.0 if handle.kind == 1 else 5.5) * self.scale
        if handle.kind == 1:
            painter.drawRect(QRectF(tip.x() - size, tip.y() - size, 2 * size, 2 * size))
        else:
            painter.drawPolygon(_diamond(tip, size))

    # Weights

    def _paint_weights(
        self,
        painter: QPainter,
        places: list[list[float]],
        visible: list[int],
        colours: Sequence[QColor],
    ) -> None:
        assert self.weights is not None
        values = self.weights.tolist()
        largest = max(map(abs, values)) or 1.0
        with_text = len(places) <= _WEIGHED_UP_TO
        painter.setFont(self._scaled_font(0.85))
        for index in visible:
            # The area shows the weight; weights beyond 1 share the scale of the largest.
            share = abs(values[index]) / max(largest, 1.0)
            radius = 30 * self.scale * float(np.sqrt(share))
            if radius < 1:
                continue
            place = QPointF(*places[index])
            self._paint_weight_disc(painter, place, radius, colours[index], negative=values[index] < 0)
            if with_text and abs(values[index]) >= 5e-3:
                self._paint_weight_text(painter, place, values[index])

    def _paint_weight_disc(
        self, painter: QPainter, place: QPointF, radius: float, colour: QColor, *, negative: bool
    ) -> None:
        ring = QPen(self.theme.warning if negative else colour, 1.5 * self.scale)
        ring.setStyle(Qt.PenStyle.DashLine if negative else Qt.PenStyle.SolidLine)
        fill = QColor(self.theme.warning if negative else colour)
        fill.setAlphaF(0.22)
        painter.setPen(ring)
        painter.setBrush(fill)
        painter.drawEllipse(place, radius, radius)

    def _paint_weight_text(self, painter: QPainter, place: QPointF, weight: float) -> None:
        painter.setPen(self.theme.warning if weight < 0 else self.theme.ink)
        text = f"{weight:.2f}".replace("-", "−")
        box = QRectF(place.x() - 40, place.y() + 8 * self.scale, 80, 18 * self.scale)
        painter.drawText(box, int(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop), text)

    def _paint_scrub_dot(self, painter: QPainter, shown: PixelMap) -> None:
        assert self.scrub is not None
        _, x, y = self.scrub
        pixel = shown.point(x, y)
        if max(map(abs, pixel)) > _FAR:
            return
        painter.setPen(QPen(self.theme.paper, 2 * self.scale))
        painter.setBrush(self.theme.accent)
        painter.drawEllipse(QPointF(*pixel), 6.5 * self.scale, 6.5 * self.scale)


def _is_near(pixels: Floats, shown: PixelMap) -> np.ndarray:
    """Tell which points are close enough to the visible area to be drawn."""
    margin = 60.0
    x, y = pixels[:, 0], pixels[:, 1]
    return (x > -margin) & (x < shown.width + margin) & (y > -margin) & (y < shown.height + margin)


def _beside(direction: Floats) -> Floats:
    """Return the unit vector across `direction` (pixels) that points up; straight up without direction."""
    length = float(np.hypot(*direction))
    if length == 0:
        return np.array([0.0, -1.0])
    across = np.array([direction[1], -direction[0]]) / length
    return -across if across[1] > 0 else across


def _diamond(centre: QPointF, size: float) -> QPolygonF:
    x, y = centre.x(), centre.y()
    corners = ((x, y - size), (x + size, y), (x, y + size), (x - size, y))
    return QPolygonF([QPointF(*corner) for corner in corners])
