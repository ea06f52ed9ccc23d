"""Pens, brushes, font and widths of numbers that points and handles are drawn with."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QFontMetrics, QFontMetricsF, QPainter, QPen

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
        self._written: dict[tuple[str, float], tuple[QSize, QPointF]] = {}

    def written(self, text: str, painter: QPainter) -> tuple[QSize, QPointF]:
        """Return the size of a text in whole pixels, and the way from its middle to where it is begun."""
        device = painter.device()
        key = (text, device.devicePixelRatioF())
        if key not in self._written:
            exact = QFontMetricsF(self.font, device)
            to_start = QPointF(-exact.horizontalAdvance(text) / 2, exact.ascent() - exact.height() / 2)
            self._written[key] = (QFontMetrics(self.font, device).size(0, text), to_start)
        return self._written[key]
