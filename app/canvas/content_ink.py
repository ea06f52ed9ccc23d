"""Texts and pictures painted in their frames."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from ..appearance.colours import curve_colour
from ..appearance.theme import Theme
from ..document.content import Lettering, Picture
from ..document.contents import corners_of
from ..document.model import Curve
from ..document.style import Style
from ..document.wrapping import is_overset
from ..plotting.pixel_map import PixelMap
from ..plotting.printed import to_pixels
from ..qt.clips import clipped
from ..qt.contents import inked, paint_picture
from ..qt.gradients import brush_of
from ..qt.strokes import pen_of, with_opacity

_SHORTEST_DASHES = 0.5
"""Pixels of a pattern below which dashes cannot be told apart."""

_SIGN = 6.0
"""Pixels that the plus of a frame too small for its words reaches each way."""


def paint_content(
    painter: QPainter, curve: Curve, style: Style, shown: PixelMap, theme: Theme, width: float
) -> None:
    """Paint what a curve is the frame of, in a style; `width` is that of its line in pixels."""
    way = to_pixels(shown)
    if style.clips:
        area, whole = QRectF(0, 0, shown.width, shown.height), replace(style, clips=())
        with clipped(painter, style.clips, way, area):
            paint_content(painter, curve, whole, shown, theme, width)
    elif isinstance(curve.form, Picture):
        paint_picture(painter, curve.form, corners_of(curve), way, style.opacity, theme.muted)
    elif isinstance(curve.form, Lettering):
        _paint_text(painter, curve, curve.form, style, shown, theme, width)


def _paint_text(
    painter: QPainter,
    curve: Curve,
    text: Lettering,
    style: Style,
    shown: PixelMap,
    theme: Theme,
    width: float,
) -> None:
    area = QRectF(0, 0, shown.width, shown.height)
    for path, own in inked(text, corners_of(curve), to_pixels(shown), style, area):
        wide = width if own is style or own.width is None else own.width * shown.sx
        pen = _pen(own, style.opacity, shown, theme, wide) if own.has_stroke and wide > 0 else None
        if own.has_fill:
            opacity = own.fill_opacity * style.opacity
            painter.fillPath(
                path,
                with_opacity(_seen(own.fill, theme), opacity)
                if own.fill_gradient is None
                else brush_of(own.fill_gradient, theme.curve, opacity, lambda place: shown.point(*place)),
            )
        if pen is not None:
            painter.strokePath(path, pen)
    if is_overset(text):
        _paint_overset(painter, [QPointF(*shown.point(*place)) for place in corners_of(curve)], theme)


def _pen(style: Style, whole: float, shown: PixelMap, theme: Theme, width: float) -> QPen:
    """Return the pen of letters, of a text whose `whole` opacity is this."""
    opacity = style.stroke_opacity * whole
    colour = with_opacity(_seen(style.stroke, theme), opacity)
    pen = pen_of(style, colour, width, is_dashed=sum(style.dash) * width >= _SHORTEST_DASHES)
    if style.stroke_gradient is not None:
        pen.setBrush(brush_of(style.stroke_gradient, theme.curve, opacity, lambda place: shown.point(*place)))
    return pen


def _paint_overset(painter: QPainter, corners: Sequence[QPointF], theme: Theme) -> None:
    """Paint the frame of words that do not fit, and a plus beside its lower right corner."""
    pen = QPen(theme.warning, 1.5)
    pen.setCosmetic(True)
    painter.save()
    painter.setPen(pen)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawPolygon(QPolygonF(list(corners)))
    place = corners[2] + QPointF(2.5 * _SIGN, 0.0)
    sign = QRectF(place.x() - _SIGN, place.y() - _SIGN, 2 * _SIGN, 2 * _SIGN)
    painter.fillRect(sign, theme.paper)
    painter.drawRect(sign)
    reach = _SIGN - 3
    painter.drawLine(place - QPointF(reach, 0), place + QPointF(reach, 0))
    painter.drawLine(place - QPointF(0, reach), place + QPointF(0, reach))
    painter.restore()


def _seen(code: str, theme: Theme) -> QColor:
    """Return a colour as it is seen: on dark paper what is written for light paper, too."""
    return curve_colour(code, theme)
