"""Colours of points and curves in a theme, and small discs in such a colour."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from ..document.style import NO_PAINT, Style
from ..view_model.palette import OKABE_ITO, colour_on, point_palette
from .theme import Theme, rim

CURVE_COLOURS: Final = {
    "Ink": "",
    "Blue": "#0072b2",
    "Vermillion": "#d55e00",
    "Bluish green": "#009e73",
    "Reddish purple": "#cc79a7",
    "Orange": "#e69f00",
    "Sky blue": "#56b4e9",
    "Yellow": "#f0e442",
}
"""The colours for curves, as a document writes them; ink, the empty text, is that of the theme."""


def curve_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of a line in this theme, adjusted until it is visible on the paper."""
    if code in ("", NO_PAINT):
        return QColor(theme.curve)
    return QColor(colour_on(theme.paper.name(), code))


def fill_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of an area in this theme, never adjusted: its surroundings make it visible."""
    return QColor(theme.curve) if code in ("", NO_PAINT) else QColor(code)


def line_colour(code: str, theme: Theme) -> QColor:
    """Return a distinguishing colour of marks and lines: Okabe–Ito, adjusted to the paper."""
    published = OKABE_ITO["published"]
    return QColor(OKABE_ITO[theme.name][published.index(code)]) if code in published else QColor(code)


@lru_cache(maxsize=8)
def point_colours(n: int, theme: Theme) -> tuple[QColor, ...]:
    """
    Return one colour for each of ``n`` points, all legible on the theme's paper.

    Up to eight points have the Okabe–Ito colours, adjusted to the paper; the eighth is the ink.
    More points run through an even ramp of hues whose lightness alternates, so that neighbours
    can be told apart however many there are.

    Parameters
    ----------
    n : int
        Number of points, 0 or more.
    theme : Theme
        Theme in which they are drawn.

    Returns
    -------
    tuple of QColor
        The colours by point index; the same objects for the same arguments, not to be changed.
    """
    return tuple(QColor(code) for code in point_palette(n, theme.name, theme.ink.name()))


_SIDE = 16
"""Side of the picture in pixels: headers and menus would scale a smaller one."""


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
    """Return a square filled with a paint as a style writes it; struck through for no paint."""
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
    """Draw a disc of the fill within a ring of the stroke; without a fill, a disc of the stroke."""
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
