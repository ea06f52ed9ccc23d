"""Patterns of a document's styles as brushes of Qt."""

from __future__ import annotations

import math
from functools import lru_cache

from PySide6.QtCore import QByteArray, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QImage, QPainter, QTransform
from PySide6.QtSvg import QSvgRenderer

from ..document.gradient import Gradient, Tile

_FINER = 2.0
"""Pixels of a tile for each pixel of the device: it need not lie on their grid."""

_MOST = 2048
"""Pixels along a side of a tile."""


def pattern_brush(gradient: Gradient, tile: Tile, ink: QColor, opacity: float) -> QBrush:
    """Return a pattern, which is not flat, for a painter in whose units it lies."""
    (a, b), (c, d) = gradient.axes
    width, height = (_pixels(math.hypot(*axis)) for axis in ((a, b), (c, d)))
    colour = gradient.stops[0].colour or ink.name()
    brush = QBrush(_picture(tile, colour, width, height, opacity))
    brush.setTransform(QTransform(a / width, b / width, c / height, d / height, *gradient.start))
    return brush


def _pixels(length: float) -> int:
    return min(max(math.ceil(_FINER * length), 1), _MOST)


@lru_cache(maxsize=32)
def _picture(tile: Tile, colour: str, width: int, height: int, opacity: float) -> QImage:
    picture = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
        painter.setOpacity(opacity)
        renderer_of(tile, colour).render(painter, QRectF(0, 0, width, height))
    return picture


def renderer_of(tile: Tile, colour: str) -> QSvgRenderer:
    """Return what draws a tile, whose own colour is this, into any rectangle."""
    # Not kept: it would be gone with the application that an export ends with.
    box = " ".join(map(repr, tile.view))
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' viewBox="{box}">{tile.body.replace("currentColor", colour)}</svg>'
    )
    renderer = QSvgRenderer(QByteArray(text.encode()))
    renderer.setAspectRatioMode(Qt.AspectRatioMode.IgnoreAspectRatio)
    return renderer
