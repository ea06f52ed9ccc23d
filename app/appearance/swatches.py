"""Small discs in the colour of a curve."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPixmap

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
