"""The marks of points, by their kinds: disc, square, diamond. Their colours say which points they are."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap, QPolygonF

from ..view_model.points.point_kinds import POINT_KINDS

_DOT = 0.36
"""Radius of the dot in the middle of a mark that is open: three pixels across in one of nine."""

_PICTURE = 16
"""Pixels along the sides of the picture of a mark: headers scale what is smaller than their icons are."""

REACH = max(abs(coordinate) for kind in POINT_KINDS for corner in kind.outline for coordinate in corner)
"""Largest reach of a mark of radius 1."""


def paint_mark(
    painter: QPainter, place: QPointF, radius: float, kind: int, paper: QColor | None = None
) -> None:
    """Draw the mark of a point of the kind at a place in `POINT_KINDS`, with the painter's pen and brush.

    Without `paper` no mark has a dot.
    """
    record = POINT_KINDS[kind]
    if record.outline:
        corners = [place + QPointF(radius * x, radius * y) for x, y in record.outline]
        painter.drawPolygon(QPolygonF(corners))
    else:
        painter.drawEllipse(place, radius, radius)
    if record.is_open and paper is not None:
        painter.save()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(paper)
        painter.drawEllipse(place, _DOT * radius, _DOT * radius)
        painter.restore()


@lru_cache(maxsize=512)
def mark_picture(colour: str, paper: str, size: int, kind: int) -> QPixmap:
    """Return the mark of a kind, `size` pixels across, in the middle of a picture."""
    pixmap = QPixmap(2 * _PICTURE, 2 * _PICTURE)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    paint_mark(painter, QPointF(_PICTURE / 2, _PICTURE / 2), size / 2, kind, QColor(paper))
    painter.end()
    return pixmap
