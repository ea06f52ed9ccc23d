"""Small discs in the colour of a curve."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from ..document.style import NO_PAINT, Style
from .colours import curve_colour, fill_colour
from .theme import Theme, rim

_SIDE = 16
"""Pixels along the sides of the picture: headers and menus scale what is smaller than their icons are."""


@lru_cache(maxsize=512)
def swatch(colour: str, size: int) -> QPixmap:
    """Return a disc of `size` pixels in the middle of a picture."""
    pixmap = QPixmap(2 * _SIDE, 2 * _SIDE)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    margin = (_SIDE - size) / 2
    painter.drawEllipse(QRectF(margin, margin, size, size))
    painter.end()
    return pixmap


def paint_picture(paint: str, theme: Theme, size: int = _SIDE) -> QPixmap:
    """Return a square of a paint, as a style writes it; of none, one that is struck through."""
    picture = QPixmap(2 * size, 2 * size)
    picture.setDevicePixelRatio(2)
    picture.fill(Qt.GlobalColor.transparent)
    inner = QRectF(1, 1, size - 2, size - 2)
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(rim(theme), 1.0))
        painter.setBrush(theme.paper if paint == NO_PAINT else fill_colour(paint, theme))
        painter.drawRoundedRect(inner, 2.5, 2.5)
        if paint == NO_PAINT:
            painter.setPen(QPen(theme.warning, 1.5))
            painter.drawLine(inner.bottomLeft(), inner.topRight())
    return picture


def draw_style(painter: QPainter, centre: QPointF, size: float, style: Style, theme: Theme) -> None:
    """Draw a disc of the fill within a ring of the stroke; of a line alone, a disc."""
    painter.setPen(Qt.PenStyle.NoPen)
    line = curve_colour(style.stroke, theme)
    if not style.has_fill:
        if style.has_stroke:
            painter.setBrush(line)
        else:
            painter.setPen(QPen(theme.muted, 1.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(centre, size / 2, size / 2)
        return
    ring = size / 4
    painter.setBrush(fill_colour(style.fill, theme))
    if style.has_stroke:
        painter.setPen(QPen(line, ring))
    else:
        painter.setPen(QPen(rim(theme), 1.0))
    radius = (size - (ring if style.has_stroke else 1.0)) / 2
    painter.drawEllipse(centre, radius, radius)
