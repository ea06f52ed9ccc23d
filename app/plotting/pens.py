"""Line styles on the screen: pens, lines, marks, and their small pictures for legends and switches."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap, QPolygonF

from curvecore.arrays import FloatArray

from ..appearance.colours import line_colour
from ..appearance.theme import Theme, mix
from ..view_model.line_styles import Dashes, LineStyle, Mark, Sign
from .drawing import Segments, Stroke, visible_segments
from .pixel_map import PixelMap
from .stamps import transparent


def dashed(segments: FloatArray, pattern: Sequence[float]) -> FloatArray:
    """Return the dashes of segments (m, 4), drawn one after the other with a pattern of pixels.

    `pattern` has the lengths of a dash, a gap, a dash and so on; if empty, the lines are solid.
    """
    if not pattern or not len(segments):
        return segments
    along = segments[:, 2:] - segments[:, :2]
    ends = np.cumsum(np.hypot(along[:, 0], along[:, 1]))
    total = float(ends[-1])
    stops = np.cumsum(pattern)
    periods = np.arange(np.ceil(total / stops[-1]) + 1)[:, None] * stops[-1]
    switches = (periods + stops).ravel()
    cuts = np.unique(np.concatenate([[0.0], ends, switches[switches < total]]))
    middle = (cuts[:-1] + cuts[1:]) / 2
    # Pieces between an even and an odd switch are dashes.
    is_dash = np.searchsorted(switches, middle) % 2 == 0
    owner = np.minimum(np.searchsorted(ends, middle), len(segments) - 1)[is_dash]
    starts = np.concatenate([[0.0], ends[:-1]])
    lengths = np.maximum(ends - starts, 1e-300)
    shares = [
        np.clip((cut[is_dash] - starts[owner]) / lengths[owner], 0.0, 1.0)[:, None]
        for cut in (cuts[:-1], cuts[1:])
    ]
    pieces = [segments[owner, :2] + share * along[owner] for share in shares]
    return np.hstack(pieces)


SIGN = QSize(30, 14)
"""Size of a sign in a legend, in pixels."""


def colour_of(style: LineStyle, theme: Theme, strength: float = 1.0) -> QColor:
    """Return the colour of a line style in a theme, mixed with the paper for a strength below 1."""
    named = style.colour.startswith("#")
    colour = line_colour(style.colour, theme) if named else QColor(getattr(theme, style.colour))
    if strength < 1.0:
        colour = mix(colour, theme.paper, strength)
    colour.setAlphaF(style.opacity)
    return colour


def pen_of(style: LineStyle, theme: Theme, scale: float = 1.0, strength: float = 1.0) -> QPen:
    """Return the pen of a line style, without the dashes."""
    return QPen(colour_of(style, theme, strength), style.width * scale)


def with_dashes(pen: QPen, dashes: Dashes) -> QPen:
    """Return a pen with dashes, for short lines and single polylines."""
    pen = QPen(pen)
    if dashes:
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setDashPattern(dashes)
    return pen


def line_in_pixels(
    pixels: FloatArray, dashes: Dashes, width: float, pixel_map: PixelMap
) -> Stroke | Segments:
    """Return a drawable of a polyline (k, 2) in pixels for a pen of some width.

    Dashes run on over the vertices.
    """
    if not dashes:
        stroke = Stroke()
        stroke.fill(pixels, pixel_map.width, pixel_map.height)
        return stroke
    # A pen's square caps make every dash longer by its width, and the gap shorter.
    pattern = [
        width * (max(length - 1.0, 0.1) if index % 2 == 0 else length + 1.0)
        for index, length in enumerate(dashes)
    ]
    segments = Segments()
    segments.fill(dashed(visible_segments(pixels, pixel_map.width, pixel_map.height), pattern))
    return segments


def draw_line(painter: QPainter, pixels: FloatArray, dashes: Dashes, pixel_map: PixelMap) -> None:
    """Draw a polyline (k, 2) in pixels with the painter's pen."""
    line_in_pixels(pixels, dashes, painter.pen().widthF(), pixel_map).draw(painter)


def draw_mark(painter: QPainter, mark: Mark, x: float, y: float, size: float) -> None:
    """Draw a mark in the painter's pen, `size` its radius in pixels."""
    pen = painter.pen()
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if mark is Mark.CROSS:
        painter.drawLine(QPointF(x - size, y - size), QPointF(x + size, y + size))
        painter.drawLine(QPointF(x - size, y + size), QPointF(x + size, y - size))
    elif mark is Mark.SQUARE:
        painter.drawRect(QRectF(x - 0.8 * size, y - 0.8 * size, 1.6 * size, 1.6 * size))
    elif mark is Mark.DIAMOND:
        painter.setBrush(pen.color())
        painter.drawPolygon(diamond(QPointF(x, y), size))
    else:
        painter.setBrush(Qt.BrushStyle.NoBrush if mark is Mark.RING else pen.color())
        radius = size if mark is Mark.RING else 0.6 * size
        painter.drawEllipse(QPointF(x, y), radius, radius)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def diamond(centre: QPointF, size: float) -> QPolygonF:
    """Return a square that stands on a corner, `size` from its centre."""
    corners = ((0, -size), (size, 0), (0, size), (-size, 0))
    return QPolygonF([centre + QPointF(*corner) for corner in corners])


def triangle(centre: QPointF, size: float) -> QPolygonF:
    """Return a triangle that stands on its side, its corners `size` from its centre."""
    corners = ((0, -size), (0.866 * size, 0.5 * size), (-0.866 * size, 0.5 * size))
    return QPolygonF([centre + QPointF(*corner) for corner in corners])


def sign_pixmap(style: LineStyle, theme: Theme, ratio: float = 1.0) -> QPixmap:
    """Return a small picture of a line, a mark or an area as it is drawn."""
    picture = transparent(SIGN.width(), SIGN.height(), ratio)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    centre = QPointF(SIGN.width() / 2, SIGN.height() / 2)
    painter.setPen(pen_of(style, theme))
    if style.sign is Sign.AREA:
        painter.fillRect(QRectF(1, 2, SIGN.width() - 2, SIGN.height() - 4), painter.pen().color())
    if style.sign in (Sign.LINE, Sign.LINE_WITH_MARK):
        painter.setPen(with_dashes(painter.pen(), style.dashes))
        painter.drawLine(QPointF(1, centre.y()), QPointF(SIGN.width() - 1, centre.y()))
    if style.sign in (Sign.MARK, Sign.LINE_WITH_MARK):
        draw_mark(painter, style.mark, centre.x(), centre.y(), 4.5 if style.sign is Sign.MARK else 4.0)
    painter.end()
    return picture
