"""Words on little plates of paper, inside the drawing."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter

from .pixel_map import PixelMap

_EDGE = 4.0

_GAP = 1.0
"""Pixels between plates that lie above one another."""


def size_of(painter: QPainter, text: str, across: float = 10.0, down: float = 4.0) -> QSizeF:
    """Return the size of a plate for text in the painter's font, so many pixels larger in all."""
    metrics = QFontMetricsF(painter.font())
    return QSizeF(metrics.horizontalAdvance(text) + across, metrics.height() + down)


def inside(left: float, top: float, size: QSizeF, shown: PixelMap) -> QRectF:
    """Return a box of some size near a place, moved so far that it lies in the drawing."""
    left = min(max(left, _EDGE), max(shown.width - size.width() - _EDGE, _EDGE))
    top = min(max(top, _EDGE), max(shown.height - size.height() - _EDGE, _EDGE))
    return QRectF(left, top, size.width(), size.height())


def clear_of(others: Sequence[QRectF], plate: QRectF) -> QRectF:
    """Return a plate moved down or up past the others that it would cover, away from the first of these."""
    plate, side = QRectF(plate), 0
    while covered := [other for other in others if plate.intersects(other)]:
        side = side or (1 if plate.center().y() >= covered[0].center().y() else -1)
        # Without a gap it may cover the same one again: its bottom is its top and its height, rounded.
        plate.moveTop(
            max(other.bottom() for other in covered) + _GAP
            if side > 0
            else min(other.top() for other in covered) - plate.height() - _GAP
        )
    return plate


def beyond(place: QPointF, ways: Sequence[QPointF], gap: float, size: QSizeF, shown: PixelMap) -> QRectF:
    """Return a box of some size whose nearest side is `gap` pixels from a place.

    It lies in the first of the directions `ways` in which it does not leave the drawing.
    """
    for way in ways:
        length = math.hypot(way.x(), way.y())
        dx, dy = (way.x() / length, way.y() / length) if length > 1 else (0.0, -1.0)
        away = gap + abs(dx) * size.width() / 2 + abs(dy) * size.height() / 2
        box = QRectF(0, 0, size.width(), size.height())
        box.moveCenter(place + QPointF(dx * away, dy * away))
        if box == inside(box.left(), box.top(), size, shown):
            return box
    return inside(place.x() + gap, place.y() + gap, size, shown)


def write_on_plate(painter: QPainter, plate: QRectF, text: str, paper: QColor, ink: QColor) -> None:
    """Write text in the middle of a plate of translucent paper."""
    paper = QColor(paper)
    paper.setAlphaF(0.85)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(paper)
    painter.drawRoundedRect(plate, 4, 4)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(ink)
    painter.drawText(plate, int(Qt.AlignmentFlag.AlignCenter), text)


def write_in_corner(painter: QPainter, text: str, paper: QColor, ink: QColor) -> None:
    """Write text on a plate in the lower left corner of what is painted."""
    plate = QRectF(QPointF(0, 0), size_of(painter, text))
    plate.moveBottomLeft(painter.clipBoundingRect().bottomLeft() + QPointF(6, -6))
    write_on_plate(painter, plate, text, paper, ink)
