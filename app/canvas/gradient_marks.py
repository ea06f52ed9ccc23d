"""Marks of a gradient: the line from its start to its end, of a radial one both axes, and what is dragged."""

from __future__ import annotations

from itertools import pairwise

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF

from ..appearance.colours import fill_colour
from ..appearance.theme import Theme
from ..document.gradient import Gradient
from ..plotting.pixel_map import PixelMap
from ..tools.gradient_places import Grip, places_of

_HALF, _HALF_CHOSEN = 4.5, 6.5
"""Pixels from the middle of a mark to its sides; of that of the stop that is chosen."""

_FAR = 1e6

_SHAPES = {
    Grip.START: ((-1, -1), (1, -1), (1, 1), (-1, 1)),
    Grip.STOP: ((0, -1), (1, 0), (0, 1), (-1, 0)),
    Grip.FOCUS: ((0, -1), (1, 0.8), (-1, 0.8)),
}
"""Corners of the marks; the others are discs."""


def paint_gradient(
    painter: QPainter,
    shown: PixelMap,
    gradient: Gradient,
    theme: Theme,
    scale: float,
    chosen: int | None = None,
) -> None:
    """Paint the marks of a gradient, each in the colour of its stop; the `chosen` one is larger."""
    places = [(each, shown.point(*each.place)) for each in places_of(gradient)]
    if any(abs(pixel) > _FAR for _, place in places for pixel in place):
        return
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    at = {each.grip: QPointF(*place) for each, place in places}
    line = [at[grip] for grip in (Grip.END, Grip.START, Grip.SIDE) if grip in at]
    # On any colour one of the two is seen.
    for pen in (QPen(theme.paper, 3.0 * scale), QPen(theme.accent, 1.2 * scale)):
        painter.setPen(pen)
        for one, other in pairwise(line):
            painter.drawLine(one, other)
    for each, place in reversed(places):
        colour = theme.paper if each.stop is None else fill_colour(gradient.stops[each.stop].colour, theme)
        painter.setBrush(colour)
        is_chosen = chosen is not None and each.stop == chosen
        half, width = (_HALF_CHOSEN, 3.0) if is_chosen else (_HALF, 1.5)
        for pen in (QPen(theme.paper, (width + 3.0) * scale), QPen(theme.accent, width * scale)):
            painter.setPen(pen)
            _paint_mark(painter, each.grip, QPointF(*place), half * scale)
    painter.setBrush(Qt.BrushStyle.NoBrush)


def _paint_mark(painter: QPainter, grip: Grip, place: QPointF, half: float) -> None:
    corners = _SHAPES.get(grip)
    if corners is None:
        painter.drawEllipse(place, half, half)
    else:
        painter.drawPolygon(QPolygonF([place + QPointF(x, y) * half for x, y in corners]))
