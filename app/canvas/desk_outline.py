"""Outlines of what lies beside the page, on a dark desk: lines in ink could not be seen there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath

from ..appearance.theme import Theme, mix
from ..document.page import Page
from ..document.style import INK, NO_PAINT, LineJoin, Style
from ..plotting.pixel_map import PixelMap
from ..plotting.printed import Ink, Part, paint_printed
from ..view_model.look.palette import contrast

_LEAST = 3.0
"""Contrast with the desk from which a shape is seen without an outline."""

_BESIDE = 1.25
"""Pixels of an outline on either side of a line."""

_SHARE = 0.75
"""Share of paper in an outline; the rest is desk."""

_AS_A_LINE = {
    "fill": NO_PAINT,
    "stroke": INK,
    "stroke_gradient": None,
    "stroke_opacity": 1.0,
    "opacity": 1.0,
    "dash": (),
    "join": LineJoin.ROUND,
}


def outline_on_desk(
    painter: QPainter,
    parts: Sequence[Part],
    style: Style,
    ink: Ink,
    shown: PixelMap,
    theme: Theme,
    page: Page,
) -> None:
    """Paint the outline of what of a shape lies beside the page, where its own colour is not seen."""
    outermost = ink.stroke if style.has_stroke else ink.fill
    if not (style.has_stroke or style.has_fill) or contrast(outermost.name(), theme.desk.name()) >= _LEAST:
        return
    low, high = np.array((page.x, page.y)), np.array((page.x + page.width, page.y + page.height))
    if all(((low <= part.points) & (part.points <= high)).all() for part in parts):
        return
    (left, bottom), (right, top) = shown.points(np.array([low, high])).tolist()
    around = QPainterPath()
    around.addRect(QRectF(0, 0, shown.width, shown.height))
    around.addRect(QRectF(left, top, right - left, bottom - top))
    painter.save()
    painter.setClipPath(around, Qt.ClipOperation.IntersectClip)
    width = (ink.width if style.has_stroke else 0.0) + 2 * _BESIDE
    colour = mix(theme.paper, theme.desk, _SHARE)
    outline = Ink(colour, colour, width, colour)
    paint_printed(painter, parts, style.with_fields(_AS_A_LINE), outline, shown)
    painter.restore()
