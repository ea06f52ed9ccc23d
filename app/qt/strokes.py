"""Strokes and fills of a document's styles as Qt has them: the same on the screen and in pictures."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainterPath, QPen

from ..document.style import LEAST_DASH, FillRule, LineCap, LineJoin, Style

FILL_RULES: Final = {
    FillRule.NONZERO: Qt.FillRule.WindingFill,
    FillRule.EVENODD: Qt.FillRule.OddEvenFill,
}

_CAPS = {
    LineCap.BUTT: Qt.PenCapStyle.FlatCap,
    LineCap.ROUND: Qt.PenCapStyle.RoundCap,
    LineCap.SQUARE: Qt.PenCapStyle.SquareCap,
}
_JOINS = {
    # Qt's own miter join is cut off at the limit, and not bevelled.
    LineJoin.MITER: Qt.PenJoinStyle.SvgMiterJoin,
    LineJoin.ROUND: Qt.PenJoinStyle.RoundJoin,
    LineJoin.BEVEL: Qt.PenJoinStyle.BevelJoin,
}


def pen_of(style: Style, colour: QColor, width: float, *, is_dashed: bool) -> QPen:
    """Return the pen of a line, `width` wide in units of the painter, with or without dashes."""
    pen = QPen(colour, width)
    pen.setCapStyle(_CAPS[style.cap])
    pen.setJoinStyle(_JOINS[style.join])
    pen.setMiterLimit(style.miter_limit)
    if style.dash and is_dashed:
        pen.setDashPattern([max(length, LEAST_DASH) for length in style.dashes_and_gaps])
        pen.setDashOffset(style.dash_offset)
    return pen


def dot_at(x: float, y: float, style: Style, width: float) -> QPainterPath:
    """Return the dot of a line of no length, made of its caps: Qt's pens draw nothing."""
    dot, half = QPainterPath(), width / 2
    if style.cap is LineCap.ROUND:
        dot.addEllipse(QPointF(x, y), half, half)
    elif style.cap is LineCap.SQUARE:
        dot.addRect(x - half, y - half, width, width)
    return dot


def overhang_of(pen: QPen) -> float:
    """Return the largest distance from the line at which its stroke may be visible."""
    has_miters = pen.joinStyle() == Qt.PenJoinStyle.SvgMiterJoin
    return pen.widthF() * (max(1.0, pen.miterLimit()) if has_miters else 1.0)


def with_opacity(colour: QColor, opacity: float) -> QColor:
    """Return a colour with this opacity."""
    result = QColor(colour)
    result.setAlphaF(opacity)
    return result
