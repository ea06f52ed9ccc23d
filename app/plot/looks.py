"""The pens of figures and ghosts: on the canvas, in its legend and in the Analysis dock."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap, QPolygonF

from app.colours import curve_colour
from app.theme import Theme
from app.view_model.analysis.figures import Style
from app.view_model.analysis.settings import Ghost


class Mark(enum.Enum):
    """The forms of marks: told apart without colours."""

    DOT = enum.auto()
    RING = enum.auto()
    DIAMOND = enum.auto()
    SQUARE = enum.auto()
    CROSS = enum.auto()


@dataclass(frozen=True)
class Look:
    """How a style is drawn.

    Attributes
    ----------
    colour
        An attribute of the theme, or an Okabe–Ito colour as documents write it.
    dashes
        Pixels of dash, gap, dash, …; empty for a solid line.
    """

    colour: str
    opacity: float = 1.0
    width: float = 1.0
    dashes: tuple[float, ...] = ()
    mark: Mark = Mark.DOT

    def pen(self, theme: Theme, scale: float) -> QPen:
        """Return the pen, without the dashes."""
        ink = curve_colour(self.colour, theme) if self.colour[0] == "#" else getattr(theme, self.colour)
        colour = QColor(ink)
        colour.setAlphaF(self.opacity)
        return QPen(colour, self.width * scale)


_BLUE, _VERMILLION, _GREEN, _PURPLE = "#0072b2", "#d55e00", "#009e73", "#cc79a7"
_ORANGE, _SKY, _YELLOW = "#e69f00", "#56b4e9", "#f0e442"

LOOKS = {
    Style.COMB_TEETH: Look("accent", 0.35),
    Style.COMB_EDGE: Look("accent", 0.9),
    Style.VELOCITY: Look(_GREEN, width=1.6),
    Style.ACCELERATION: Look(_VERMILLION, width=1.6),
    Style.CIRCLE: Look(_PURPLE, width=1.4),
    Style.CIRCLE_CENTRE: Look(_PURPLE, 0.8),
    Style.BEZIER: Look("handle", 0.9),
    Style.BEZIER_POINT: Look("handle", mark=Mark.SQUARE),
    Style.POLYGON: Look("muted", 0.8, dashes=(2.0, 4.0)),
    Style.TICK: Look("accent", width=1.4),
    Style.INFLECTION: Look(_SKY, width=1.8, mark=Mark.RING),
    Style.SHARPEST: Look(_VERMILLION, width=1.4, mark=Mark.DIAMOND),
    Style.FLATTEST: Look(_GREEN, width=1.6, mark=Mark.SQUARE),
    Style.CROSSING: Look(_PURPLE, width=2.0, mark=Mark.CROSS),
    Style.BAND: Look("accent", 0.16),
    Style.ENSEMBLE: Look("muted", 0.3),
}

GHOST_LOOKS = {
    Ghost.LAGRANGE: Look(_BLUE, width=1.5, dashes=(9.0, 4.0)),
    Ghost.HERMITE: Look(_VERMILLION, width=1.5, dashes=(9.0, 4.0, 2.0, 4.0)),
    Ghost.QUINTIC_HERMITE: Look(_GREEN, width=1.5, dashes=(9.0, 4.0, 2.0, 4.0, 2.0, 4.0)),
    Ghost.UNIFORM: Look(_PURPLE, width=1.5, dashes=(5.0, 3.0)),
    Ghost.CHORD_LENGTH: Look(_ORANGE, width=1.5, dashes=(2.0, 3.0)),
    Ghost.CENTRIPETAL: Look(_SKY, width=1.5, dashes=(14.0, 4.0)),
    Ghost.CHEBYSHEV: Look(_YELLOW, width=1.5, dashes=(14.0, 4.0, 2.0, 4.0)),
}


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
        painter.drawPolygon(_diamond(x, y, size))
    else:
        painter.setBrush(Qt.BrushStyle.NoBrush if mark is Mark.RING else pen.color())
        radius = size if mark is Mark.RING else 0.6 * size
        painter.drawEllipse(QPointF(x, y), radius, radius)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _diamond(x: float, y: float, size: float) -> QPolygonF:
    corners: Sequence[tuple[float, float]] = ((0, -size), (size, 0), (0, size), (-size, 0))
    return QPolygonF([QPointF(x + dx, y + dy) for dx, dy in corners])


SIGN = QSize(30, 14)
"""Size of a sign in pixels."""

_MARKS = (Style.INFLECTION, Style.SHARPEST, Style.FLATTEST, Style.CROSSING)


def sign_pixmap(sign: Style | Ghost | None, theme: Theme, ratio: float = 1.0) -> QPixmap:
    """Return a small picture of a line, a mark or an area as the canvas draws it; None is the curve."""
    picture = QPixmap(SIGN * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    middle = SIGN.height() / 2
    look = _look(sign)
    painter.setPen(look.pen(theme, 1.0))
    if sign in _MARKS:
        draw_mark(painter, look.mark, SIGN.width() / 2, middle, 4.5)
    elif sign is Style.BAND:
        painter.fillRect(QRectF(1, 2, SIGN.width() - 2, SIGN.height() - 4), painter.pen().color())
    else:
        painter.setPen(_dashed_pen(painter.pen(), look))
        painter.drawLine(QPointF(1, middle), QPointF(SIGN.width() - 1, middle))
        if sign is Style.BEZIER:
            draw_mark(painter, Mark.SQUARE, SIGN.width() / 2, middle, 4.0)
    painter.end()
    return picture


def _look(sign: Style | Ghost | None) -> Look:
    if sign is None:
        return Look("curve", width=2.0)
    return GHOST_LOOKS[sign] if isinstance(sign, Ghost) else LOOKS[sign]


def _dashed_pen(pen: QPen, look: Look) -> QPen:
    if look.dashes:
        pen.setDashPattern([length / pen.widthF() for length in look.dashes])
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
    return pen
