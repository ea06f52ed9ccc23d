"""Pens, brushes, font and widths of numbers that points and handles are drawn with."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFontMetrics,
    QFontMetricsF,
    QGlyphRun,
    QPainter,
    QPen,
    QTextLayout,
)

from ..appearance.theme import Theme, mix
from ..plotting.fonts import Sizes

_LINES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DotLine, Qt.PenStyle.DashDotLine)
"""The lines of handles, by the order of their derivatives."""


_FACING = 0.6
"""Share of ink in the handles of points that are not selected; the rest is paper."""


class HandleInk:
    """Pens and brush of handles in one colour."""

    def __init__(self, colour: QColor, scale: float) -> None:
        self.lines = [QPen(colour, 1.2 * scale, style) for style in _LINES]
        self.outline, self.filled = QPen(colour, 1.5 * scale), QBrush(colour)


class Written(NamedTuple):
    """A text as it is written: glyphs, which Qt need not seek in every frame.

    Attributes
    ----------
    size
        In whole pixels.
    to_start
        The way from its middle to the left end of its baseline.
    glyphs, ascent
        The runs of glyphs, and how far below where they are drawn the baseline lies.
    """

    size: QSize
    to_start: QPointF
    glyphs: list[QGlyphRun]
    ascent: QPointF

    def draw(self, painter: QPainter, centre: QPointF) -> None:
        """Draw it with the painter's pen, its middle at a place."""
        for run in self.glyphs:
            painter.drawGlyphRun(centre + self.to_start - self.ascent, run)


class Inks:
    """The ink of a layer, which is made anew where what it is made for is another one."""

    def __init__(self) -> None:
        self._made_for: tuple[object, ...] = ()

    def of(self, theme: Theme, scale: float, fonts: Sizes, *, over_picture: bool) -> PointInk:
        """Return the ink for a theme, a scale and fonts."""
        made_for = (theme, scale, fonts, over_picture)
        if made_for != self._made_for:
            self._made_for = made_for
            self._ink = PointInk(theme, scale, fonts, over_picture=over_picture)
        return self._ink


class PointInk:
    """Pens and fonts of points under one theme, in one scale: they stay from frame to frame."""

    def __init__(self, theme: Theme, scale: float, fonts: Sizes, *, over_picture: bool) -> None:
        self.scale, self.over_picture = scale, over_picture
        # In the grey of a faded letter grey handles cannot be seen.
        ink = theme.curve if over_picture else theme.handle
        self.rim, self.ring = QPen(theme.paper, 1.5 * scale), QPen(theme.accent, 2 * scale)
        self.strong, self.faint = (
            HandleInk(colour, scale) for colour in (ink, mix(ink, theme.paper, _FACING))
        )
        self.paper, self.beneath = QBrush(theme.paper), QPen(theme.paper, 4 * scale)
        self.font = fonts.times(0.95 * scale)
        self._written: dict[tuple[str, float], Written] = {}

    def written(self, text: str, painter: QPainter) -> Written:
        """Return a text as it is written on what is painted on."""
        device = painter.device()
        key = (text, device.devicePixelRatioF())
        if key not in self._written:
            exact = QFontMetricsF(self.font, device)
            to_start = QPointF(-exact.horizontalAdvance(text) / 2, exact.ascent() - exact.height() / 2)
            layout = QTextLayout(text, self.font, device)
            layout.beginLayout()
            line = layout.createLine()
            layout.endLayout()
            size, ascent = QFontMetrics(self.font, device).size(0, text), QPointF(0.0, line.ascent())
            self._written[key] = Written(size, to_start, layout.glyphRuns(), ascent)
        return self._written[key]
