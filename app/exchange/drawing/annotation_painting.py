"""Points, handles, the grid and other annotations of drawings, painted with Qt."""

from __future__ import annotations

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPainterPath, QPen, QPolygonF

from curvecore.arrays import FloatArray

from .drawing import POINT_RADIUS, Annotation, Drawing
from .styles import PictureStyle


def paint_points(painter: QPainter, drawing: Drawing, style: PictureStyle) -> None:
    """Paint the points of a drawing as discs, on a painter that has its size."""
    radius = POINT_RADIUS * drawing.frame.side
    painter.setPen(Qt.PenStyle.NoPen)
    for outline in drawing.outlines:
        painter.setBrush(QColor(style.seen(outline.colour)))
        for place in _places(outline.points, drawing):
            painter.drawEllipse(place, radius, radius)


def paint_annotations(painter: QPainter, drawing: Drawing, style: PictureStyle, name: str) -> None:
    """Paint the lines of a drawing with a name, "grid" or "handles" or "basis"."""
    for each in drawing.annotations:
        if each.name == name:
            painter.save()
            _paint(painter, each, drawing, style)
            painter.restore()


def _paint(painter: QPainter, annotation: Annotation, drawing: Drawing, style: PictureStyle) -> None:
    colour = QColor(style.seen(annotation.colour))
    painter.setOpacity(annotation.opacity)
    path = QPainterPath()
    for line in annotation.lines:
        path.addPolygon(QPolygonF(_places(line, drawing)))
    if annotation.filled:
        painter.fillPath(path, colour)
        return
    pen = QPen(colour, annotation.width)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    if annotation.dash:
        pen.setDashPattern([each / annotation.width for each in annotation.dash])
    painter.strokePath(path, pen)


def _places(points: FloatArray, drawing: Drawing) -> list[QPointF]:
    return [QPointF(x, drawing.frame.height - y) for x, y in points.tolist()]
