"""Drawings painted with Qt: shapes with their styles, points and annotations."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QImage,
    QPaintEngine,
    QPainter,
    QPainterPath,
    QPainterPathStroker,
    QPen,
    QPolygonF,
)

from curvecore.arrays import FloatArray

from ...document.style import Style
from ...qt.strokes import FILL_RULES, overhang_of, pen_of, with_opacity
from ...tasks.progress import Report, told
from .drawing import POINT_RADIUS, Annotation, Drawing
from .outlines import Outline
from .styles import PictureStyle

_MOST_DASHES = 100_000
"""In a line: Qt makes a line of each, also where nothing is seen of them."""


class Painting:
    """Paints a drawing whose frame is the painter's whole device, from (0, 0) on.

    Parameters
    ----------
    drawing
        Fitted to the device.
    painter
        With nothing set but, perhaps, antialiasing.
    style
        The colours.
    """

    def __init__(self, drawing: Drawing, painter: QPainter, style: PictureStyle) -> None:
        self._drawing, self._painter, self._style = drawing, painter, style
        self._height = drawing.frame.height

    def paint(self, *, points: bool, report: Report) -> None:
        """Paint all of it, from the back to the front."""
        frame = self._drawing.frame
        if self._style.paper:
            self._painter.fillRect(QRectF(0, 0, frame.width, frame.height), QColor(self._style.paper))
        self._paint_annotations("grid")
        for shape in told(self._drawing.shapes, report, "Painting"):
            self._paint_shape(shape)
        self._paint_annotations("handles")
        if points:
            self._paint_points()
        self._paint_annotations("basis")

    # Shapes

    def _paint_shape(self, shape: tuple[Outline, ...]) -> None:
        style, path = shape[0].style, self._path(shape)
        pen = self._pen(style, _length(shape))
        brush = (
            with_opacity(QColor(self._style.fill_of(style)), style.fill_opacity) if style.has_fill else None
        )
        if pen is not None and brush is not None and style.opacity < 1:
            self._paint_together(path, pen, brush, style.opacity)
            return
        self._painter.save()
        self._painter.setOpacity(style.opacity)
        self._fill_and_stroke(self._painter, path, pen, brush)
        self._painter.restore()

    @staticmethod
    def _fill_and_stroke(
        painter: QPainter, path: QPainterPath, pen: QPen | None, brush: QColor | None
    ) -> None:
        if brush is not None:
            painter.fillPath(path, brush)
        if pen is not None:
            painter.strokePath(path, pen)

    def _paint_together(self, path: QPainterPath, pen: QPen, brush: QColor, opacity: float) -> None:
        """Paint stroke and fill so that nothing of the fill is seen through the stroke."""
        painter = self._painter
        engine = painter.paintEngine()
        painter.save()
        painter.setOpacity(opacity)
        if engine is not None and engine.type() == QPaintEngine.Type.Raster:
            place = self._bounds(path, pen)
            if not place.isEmpty():
                painter.drawImage(place.topLeft(), self._layer(place, path, pen, brush))
        else:
            # As outlines: what lies below the stroke is taken out of the area.
            stroker = QPainterPathStroker(pen)
            painter.fillPath(path.subtracted(stroker.createStroke(path)), brush)
            painter.strokePath(path, pen)
        painter.restore()

    def _bounds(self, path: QPainterPath, pen: QPen) -> QRect:
        """Return the pixels of the device that a shape can reach."""
        reach = 1 + overhang_of(pen)
        frame = self._drawing.frame
        within = QRectF(0, 0, math.ceil(frame.width), math.ceil(frame.height))
        return (
            path.controlPointRect().adjusted(-reach, -reach, reach, reach).intersected(within).toAlignedRect()
        )

    def _layer(self, place: QRect, path: QPainterPath, pen: QPen, brush: QColor) -> QImage:
        """Return a picture of one shape in a part of the device."""
        layer = QImage(place.size(), QImage.Format.Format_ARGB32_Premultiplied)
        layer.fill(Qt.GlobalColor.transparent)
        with QPainter(layer) as painter:
            painter.setRenderHints(self._painter.renderHints())
            painter.translate(-place.topLeft())
            self._fill_and_stroke(painter, path, pen, brush)
        return layer

    def _path(self, shape: Iterable[Outline]) -> QPainterPath:
        path = QPainterPath()
        for outline in shape:
            pieces = (outline.control_points * (1, -1) + (0, self._height)).tolist()
            path.moveTo(*pieces[0][0])
            for _, (bx, by), (cx, cy), (dx, dy) in pieces:
                path.cubicTo(bx, by, cx, cy, dx, dy)
            if outline.closed:
                path.closeSubpath()
            path.setFillRule(FILL_RULES[outline.style.fill_rule])
        return path

    def _pen(self, style: Style, length: float) -> QPen | None:
        width = self._drawing.usual_width if style.width is None else style.width
        # A pen of no width would be one of a pixel.
        if not style.has_stroke or width <= 0:
            return None
        colour = with_opacity(QColor(self._style.stroke_of(style)), style.stroke_opacity)
        is_dashed = length <= _MOST_DASHES * sum(style.dash) * width
        return pen_of(style, colour, width, is_dashed=is_dashed)

    # What goes with them

    def _paint_points(self) -> None:
        radius = POINT_RADIUS * self._drawing.frame.side
        self._painter.setPen(Qt.PenStyle.NoPen)
        for outline in self._drawing.outlines:
            self._painter.setBrush(QColor(self._style.seen(outline.colour)))
            for place in self._places(outline.points):
                self._painter.drawEllipse(place, radius, radius)

    def _paint_annotations(self, name: str) -> None:
        for each in self._drawing.annotations:
            if each.name == name:
                self._painter.save()
                self._paint_annotation(each)
                self._painter.restore()

    def _paint_annotation(self, annotation: Annotation) -> None:
        colour = QColor(self._style.seen(annotation.colour))
        painter = self._painter
        painter.setOpacity(annotation.opacity)
        path = QPainterPath()
        for line in annotation.lines:
            path.addPolygon(QPolygonF(self._places(line)))
        if annotation.filled:
            painter.fillPath(path, colour)
            return
        pen = QPen(colour, annotation.width)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        if annotation.dash:
            pen.setDashPattern([each / annotation.width for each in annotation.dash])
        painter.strokePath(path, pen)

    def _places(self, points: FloatArray) -> list[QPointF]:
        return [QPointF(x, self._height - y) for x, y in points.tolist()]


def _length(shape: Iterable[Outline]) -> float:
    """Return a length that no outline of a shape is longer than."""
    return float(sum(np.hypot(*np.diff(each.control_points, axis=1).T).sum() for each in shape))
