"""Gradients of a document's styles as brushes of Qt: the same on the screen and in print."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from PySide6.QtGui import QBrush, QColor, QGradient, QLinearGradient, QRadialGradient, QTransform

from ..document.gradient import Gradient, GradientKind, Spread, Stop
from ..document.value import Vector
from .patterns import pattern_brush
from .strokes import with_opacity

_SPREADS: Final = {
    Spread.PAD: QGradient.Spread.PadSpread,
    Spread.REFLECT: QGradient.Spread.ReflectSpread,
    Spread.REPEAT: QGradient.Spread.RepeatSpread,
}

_APART = 1e-5
"""Between stops of one offset, of which Qt would keep but the last."""


def brush_of(
    gradient: Gradient, ink: QColor, opacity: float, place: Callable[[Vector], Vector]
) -> QBrush | QColor:
    """Return a gradient for a painter: `place` tells where places of the plane are there.

    One without any area is the colour of its last stop.
    """
    mapped = gradient.mapped(place)
    if mapped.is_flat:
        return _colour(mapped.stops[-1], ink, opacity)
    if mapped.tile is not None:
        return pattern_brush(mapped, mapped.tile, ink, opacity)
    made = _unit_gradient(mapped)
    made.setSpread(_SPREADS[gradient.spread])
    # As SVG has it; Qt would mix what is seen of the colours.
    made.setInterpolationMode(QGradient.InterpolationMode.ComponentInterpolation)
    made.setStops(
        [
            (offset, _colour(stop, ink, opacity))
            for offset, stop in zip(_offsets(gradient), gradient.stops, strict=True)
        ]
    )
    brush = QBrush(made)
    (a, b), (c, d) = mapped.axes
    brush.setTransform(QTransform(a, b, c, d, *mapped.start))
    return brush


def _unit_gradient(gradient: Gradient) -> QGradient:
    """Return the gradient in its own plane."""
    if gradient.kind is GradientKind.LINEAR:
        return QLinearGradient(0.0, 0.0, 1.0, 0.0)
    focus = (0.0, 0.0) if gradient.focus is None else gradient.coordinates(gradient.focus)
    return QRadialGradient(0.0, 0.0, 1.0, *focus)


def _offsets(gradient: Gradient) -> list[float]:
    """Return offsets that are all different."""
    found, last = list[float](), len(gradient.stops) - 1
    for index, stop in enumerate(gradient.stops):
        least = found[-1] + _APART if found else 0.0
        found.append(min(max(stop.offset, least), 1.0 - (last - index) * _APART))
    return found


def _colour(stop: Stop, ink: QColor, opacity: float) -> QColor:
    colour = QColor(stop.colour) if stop.colour else ink
    return with_opacity(colour, stop.opacity * opacity)
