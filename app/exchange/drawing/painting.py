"""Drawings painted with Qt: shapes with their styles, points and annotations."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QImage,
    QPaintEngine,
    QPainter,
    QPainterPath,
    QPainterPathStroker,
    QPen,
    QPolygonF,
    QTransform,
)

from curvecore.arrays import FloatArray

from ...document.content import Lettering, Picture
from ...document.gradient import Gradient
from ...document.style import Style
from ...qt.clips import clipped
from ...qt.contents import inked, paint_picture
from ...qt.gradients import brush_of
from ...qt.markers import path_of
from ...qt.strokes import FILL_RULES, overhang_of, pen_of, with_opacity
from ...tasks.progress import Report, told
from .drawing import POINT_RADIUS, Annotation, Drawing
from .outlines import Outline, markers_at
from .styles import PictureStyle

_MOST_DASHES = 100_000
"""In a line: Qt makes a line of each, also where nothing is seen of them."""


_PICTURE = QImage.Format.Format_ARGB32_Premultiplied
FINEST = 1000
"""Pixels along the longer side of a gradient that goes into a PDF as a picture."""


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
        if clips := shape[0].style.clips:
            # Outlines of a shape have one style.
            whole = replace(shape[0], style=replace(shape[0].style, clips=()))
            with clipped(self._painter, clips, QTransform(1, 0, 0, -1, 0, self._height)):
                self._paint_shape((whole, *shape[1:]))
            return
        if shape[0].content is not None:
            self._paint_content(shape[0])
            return
        style, path, markers = shape[0].style, self._path(shape), self._markers(shape)
        is_together = style.opacity < 1 and style.has_fill and style.has_stroke
        if _is_raster(self._painter) and (is_together or (style.opacity < 1 and not markers.isEmpty())):
            self._paint_layer(path, markers, replace(style, opacity=1.0), _length(shape), style.opacity)
            return
        pen = self._pen(style, _length(shape))
        brush = self._brush(style) if style.has_fill else None
        if style.opacity < 1 and pen is not None:
            markers = markers.subtracted(QPainterPathStroker(pen).createStroke(path))
        if is_together and pen is not None:
            # As outlines: what lies below the stroke is taken out of the area.
            path_below = path.subtracted(QPainterPathStroker(pen).createStroke(path)).subtracted(markers)
            self._fill_and_stroke(self._painter, path_below, None, brush)
            brush = None
        self._fill_and_stroke(self._painter, path, pen, brush)
        if pen is not None and not markers.isEmpty():
            self._fill(self._painter, markers, pen.brush())

    def _paint_content(self, frame: Outline) -> None:
        """Paint a text or a picture in its frame."""
        content, way = frame.content, QTransform(1, 0, 0, -1, 0, self._height)
        if isinstance(content, Picture):
            paint_picture(self._painter, content, frame.corners, way, frame.style.opacity, None)
        elif isinstance(content, Lettering):
            area = QRectF(0, 0, self._drawing.frame.width, self._height)
            for path, style in inked(content, frame.corners, way, frame.style, area):
                brush = self._brush(style) if style.has_fill else None
                self._fill_and_stroke(self._painter, path, self._pen(style, 0.0), brush)

    def _fill_and_stroke(
        self, painter: QPainter, path: QPainterPath, pen: QPen | None, brush: QBrush | QColor | None
    ) -> None:
        if brush is not None:
            self._fill(painter, path, brush)
        if pen is None:
            return
        if _has_alpha(pen.brush()) and not _is_raster(painter):
            self._fill(painter, QPainterPathStroker(pen).createStroke(path), pen.brush())
        else:
            painter.strokePath(path, pen)

    def _fill(self, painter: QPainter, path: QPainterPath, brush: QBrush | QColor) -> None:
        """Fill an area; what a gradient lets through is lost in Qt's PDF files (6.11), of a picture not."""
        if isinstance(brush, QColor) or not _has_alpha(brush) or _is_raster(painter):
            painter.fillPath(path, brush)
            return
        place = path.boundingRect().intersected(QRectF(0, 0, self._drawing.frame.width, self._height))
        if place.isEmpty():
            return
        scale = min(1.0, FINEST / max(place.width(), place.height()))
        picture = QImage((place.size() * scale).toSize().expandedTo(QSize(1, 1)), _PICTURE)
        picture.fill(Qt.GlobalColor.transparent)
        with QPainter(picture) as inner:
            inner.scale(picture.width() / place.width(), picture.height() / place.height())
            inner.translate(-place.topLeft())
            inner.fillRect(place, brush)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.LosslessImageRendering)
        painter.setClipPath(path, Qt.ClipOperation.IntersectClip)
        painter.drawImage(place, picture)
        painter.restore()

    def _paint_layer(
        self, path: QPainterPath, markers: QPainterPath, style: Style, length: float, opacity: float
    ) -> None:
        """Paint stroke and fill so that nothing of the fill is seen through the stroke."""
        painter, pen = self._painter, self._pen(style, length)
        place = self._bounds(path, markers, pen or QPen(Qt.PenStyle.NoPen))
        if not place.isEmpty():
            brush = self._brush(style) if style.has_fill else None
            painter.save()
            painter.setOpacity(opacity)
            painter.drawImage(place.topLeft(), self._layer(place, path, markers, pen, brush))
            painter.restore()

    def _bounds(self, path: QPainterPath, markers: QPainterPath, pen: QPen) -> QRect:
        """Return the pixels of the device that a shape can reach."""
        reach = 1 + overhang_of(pen)
        frame = self._drawing.frame
        within = QRectF(0, 0, math.ceil(frame.width), math.ceil(frame.height))
        seen = path.controlPointRect().united(markers.controlPointRect())
        return seen.adjusted(-reach, -reach, reach, reach).intersected(within).toAlignedRect()

    def _layer(
        self,
        place: QRect,
        path: QPainterPath,
        markers: QPainterPath,
        pen: QPen | None,
        brush: QBrush | QColor | None,
    ) -> QImage:
        """Return a picture of one shape in a part of the device."""
        layer = QImage(place.size(), _PICTURE)
        layer.fill(Qt.GlobalColor.transparent)
        with QPainter(layer) as painter:
            painter.setRenderHints(self._painter.renderHints())
            painter.translate(-place.topLeft())
            self._fill_and_stroke(painter, path, pen, brush)
            if pen is not None:
                painter.fillPath(markers, pen.brush())
        return layer

    def _markers(self, shape: Sequence[Outline]) -> QPainterPath:
        style = shape[0].style
        width = self._drawing.usual_width if style.width is None else style.width
        way = QTransform(1, 0, 0, -1, 0, self._height)
        return way.map(path_of(markers_at(shape, width)))

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
        colour = with_opacity(QColor(self._style.stroke_of(style)), style.stroke_opacity * style.opacity)
        is_dashed = length <= _MOST_DASHES * sum(style.dash) * width
        pen = pen_of(style, colour, width, is_dashed=is_dashed)
        if style.stroke_gradient is not None:
            pen.setBrush(self._served(style.stroke_gradient, style.stroke_opacity * style.opacity))
        return pen

    def _brush(self, style: Style) -> QBrush | QColor:
        # A painter's own opacity is nothing to the gradients of a PDF.
        opacity = style.fill_opacity * style.opacity
        if style.fill_gradient is not None:
            return self._served(style.fill_gradient, opacity)
        return with_opacity(QColor(self._style.fill_of(style)), opacity)

    def _served(self, gradient: Gradient, opacity: float) -> QBrush | QColor:
        ink = QColor(self._style.ink)
        return brush_of(gradient, ink, opacity, lambda place: (place[0], self._height - place[1]))

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


def _has_alpha(brush: QBrush) -> bool:
    """Whether a gradient lets something through."""
    return brush.gradient() is not None and not brush.isOpaque()


def _is_raster(painter: QPainter) -> bool:
    engine = painter.paintEngine()
    return engine is not None and engine.type() == QPaintEngine.Type.Raster


def _length(shape: Iterable[Outline]) -> float:
    """Return a length that no outline of a shape is longer than."""
    return float(sum(np.hypot(*np.diff(each.control_points, axis=1).T).sum() for each in shape))
