"""Drawings painted with Qt: shapes with their styles, points and annotations."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from curvecore.arrays import FloatArray

from ...document.style import Style
from ...qt.strokes import FILL_RULES, dot_at, pen_of, with_opacity
from ...tasks.progress import Report, silent, with_progress
from .drawing import POINT_RADIUS, Annotation, Drawing
from .outlines import Outline, length_within
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

    def paint(self, *, points: bool, report: Report = silent) -> None:
        """Paint all of it, from the back to the front."""
        if self._style.paper:
            frame = QRectF(0, 0, self._drawing.frame.width, self._height)
            self._painter.fillRect(frame, QColor(self._style.paper))
        paint_annotations(self._painter, self._drawing, self._style, "grid")
        for shape in with_progress(self._drawing.shapes, report, "Painting"):
            self._paint_shape(shape)
        paint_annotations(self._painter, self._drawing, self._style, "handles")
        if points:
            paint_points(self._painter, self._drawing, self._style)
        paint_annotations(self._painter, self._drawing, self._style, "basis")

    # Shapes

    def _paint_shape(self, shape: tuple[Outline, ...]) -> None:
        style, path = shape[0].style, self._path(shape)
        pen = self._pen(style, length_within(shape))
        if style.has_fill:
            self._painter.fillPath(path, self._colour(style))
        if pen is not None:
            self._painter.strokePath(path, pen)
            for outline in shape:
                if outline.is_dot:
                    (x, y), width = outline.control_points[0, 0].tolist(), pen.widthF()
                    self._painter.fillPath(dot_at(x, self._height - y, style, width), pen.color())

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
        # Qt draws a pen of width 0 one pixel wide.
        if not style.has_stroke or width <= 0:
            return None
        colour = with_opacity(QColor(self._style.stroke_of(style)), style.stroke_opacity)
        is_dashed = length <= _MOST_DASHES * sum(style.dash) * width
        return pen_of(style, colour, width, is_dashed=is_dashed)

    def _colour(self, style: Style) -> QColor:
        """Return the colour of the inside."""
        return with_opacity(QColor(self._style.fill_of(style)), style.fill_opacity)


def paint_points(painter: QPainter, drawing: Drawing, style: PictureStyle) -> None:
    """Paint the points of a drawing as discs, on a painter that has its size."""
    radius = POINT_RADIUS * drawing.frame.side
    painter.setPen(Qt.PenStyle.NoPen)
    for outline in drawing.outlines:
        painter.setBrush(QColor(style.visible_colour(outline.colour)))
        for position in _positions(outline.points, drawing):
            painter.drawEllipse(position, radius, radius)


def paint_annotations(painter: QPainter, drawing: Drawing, style: PictureStyle, name: str) -> None:
    """Paint the lines of a drawing with a name, "grid" or "handles" or "basis"."""
    for annotation in drawing.annotations:
        if annotation.name == name:
            painter.save()
            _paint(painter, annotation, drawing, style)
            painter.restore()


def _paint(painter: QPainter, annotation: Annotation, drawing: Drawing, style: PictureStyle) -> None:
    colour = QColor(style.visible_colour(annotation.colour))
    painter.setOpacity(annotation.opacity)
    path = QPainterPath()
    for line in annotation.lines:
        path.addPolygon(QPolygonF(_positions(line, drawing)))
    if annotation.filled:
        painter.fillPath(path, colour)
        return
    pen = QPen(colour, annotation.width)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if annotation.dash:
        pen.setDashPattern([length / annotation.width for length in annotation.dash])
    painter.strokePath(path, pen)


def _positions(points: FloatArray, drawing: Drawing) -> list[QPointF]:
    return [QPointF(x, drawing.frame.height - y) for x, y in points.tolist()]
