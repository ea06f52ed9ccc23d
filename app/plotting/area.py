"""A translucent area, filled without waiting.

Qt hands translucent spans to a pool of threads and waits for them, which takes ten times as long when the
machine is busy. Opaque spans it fills at once, so the area is painted opaque beside the screen and then laid
over it.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QRect, QRectF
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath


class AreaFill:
    """Filling of areas one after the other, in a picture that is kept for the next frame."""

    def __init__(self) -> None:
        self._picture = QImage()

    def fill(self, painter: QPainter, path: QPainterPath, colour: QColor, room: QRectF) -> None:
        """Fill what lies of `path` in `room` (pixels of the painter)."""
        box = path.controlPointRect().adjusted(-1, -1, 1, 1).intersected(room).toAlignedRect()
        if box.isEmpty():
            return
        ratio = painter.device().devicePixelRatio()
        size = QRect(0, 0, math.ceil(box.width() * ratio), math.ceil(box.height() * ratio))
        self._prepare(size, ratio)
        inner = QPainter(self._picture)
        inner.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        inner.translate(-box.topLeft())
        opaque = QColor(colour)
        opaque.setAlphaF(1.0)
        inner.fillPath(path, opaque)
        inner.end()
        before = painter.opacity()
        painter.setOpacity(before * colour.alphaF())
        painter.drawImage(QRectF(box), self._picture, QRectF(size))
        painter.setOpacity(before)

    def _prepare(self, size: QRect, ratio: float) -> None:
        """Have an empty picture of at least this size."""
        if self._picture.width() < size.width() or self._picture.height() < size.height():
            self._picture = QImage(size.size(), QImage.Format.Format_ARGB32_Premultiplied)
        self._picture.setDevicePixelRatio(ratio)
        self._picture.fill(0)
