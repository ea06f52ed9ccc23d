"""Styles of curves on the canvas."""

from __future__ import annotations

from ..document.style import NO_PAINT, PLAIN_STYLE, LineCap, LineJoin, Style
from ..plotting.pixel_map import PixelMap
from ..view_model.curve.curve_view import CurveView, Polyline

TOLERANCE = 0.1
"""Largest distance between the curve and what is drawn of it, in pixels; a quarter can be seen as corners."""

_WIDE = 8.0
"""Pixels of a line above which its edges show corners that its middle does not."""

_MOST_FINER = 8.0

Shape = tuple[CurveView, ...]
"""The curves of a shape, in order."""


def is_plain(view: CurveView) -> bool:
    """Whether a curve is a line of the same width at every zoom: it has no looks but a colour."""
    style = view.source.style
    return style is PLAIN_STYLE or (
        style.width is None
        and style.fill == NO_PAINT
        and style.stroke != NO_PAINT
        and not style.dash
        and style.cap is LineCap.ROUND
        and style.join is LineJoin.ROUND
        and style.stroke_opacity == 1.0
    )


def line_of(view: CurveView, shown: PixelMap, style: Style | None = None) -> Polyline:
    """Return a curve as a polyline of the plane, exact enough for the width of its line, or of a `style`."""
    scale = max(shown.sx, shown.sy)
    width = (style or view.source.style).width or 0.0
    if width * scale <= _WIDE:
        return view.flattened(TOLERANCE / scale, shown.box)
    # Where the middle turns by some angle the edge turns with a larger radius.
    finer = min(width * scale / _WIDE, _MOST_FINER)
    left, low, right, high = shown.box
    box = (left - width, low - width, right + width, high + width)
    return view.flattened(TOLERANCE / finer / scale, box)


def line_width(style: Style, shown: PixelMap, usual: float) -> float:
    """Return the width in pixels of a line in its style; 0 of none, `usual` where it has none of its own."""
    if not style.has_stroke:
        return 0.0
    return usual if style.width is None else style.width * shown.sx
