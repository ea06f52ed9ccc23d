"""Pens, brushes, font and widths of numbers that points and handles are drawn with."""

from __future__ import annotations

import enum
from typing import NamedTuple

from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import (
    QColor,
    QFontMetrics,
    QFontMetricsF,
    QGlyphRun,
    QPainter,
    QPen,
    QPixmap,
    QTextLayout,
)

from ..appearance.theme import Theme, mix
from ..plotting.fonts import Sizes
from ..plotting.halo import with_halo
from ..plotting.pens import diamond, triangle
from ..plotting.sprites import Sprites
from ..view_model.palette import contrast
from .point_density import RADIUS
from .point_marks import paint_mark
from .point_stamps import PLAIN_RIM

_LINES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DotLine, Qt.PenStyle.DashDotLine)
"""The lines of handles, by the order of their derivatives."""


_SELECTED_RADIUS, _GROWTH = 5.5, 1.0

_REACH = 11.0
"""Pixels that marks reach at most: the ring of a selected point, or a kind with corners."""

_HOVERED = 0.4
"""Share of the accent in a plain point under the pointer."""

_FACING, _SEEN, _STEP = 0.6, 3.0, 0.05
"""Least share of ink in the handles of points that are not selected, the rest is paper; the contrast between
the two that it is raised for; and by what steps."""

_LINE, _FACING_LINE = 1.2, 0.9
"""Pixels of the lines of handles, and of those of points that are not selected."""

_BENEATH_PICTURE, _BENEATH_DRAWING = 1.4, 0.9
"""Pixels of paper beside the line of a handle: over a picture that is traced, and over a drawing."""

_RIM_OF_HANDLE = (2.5, 2.25)
"""The same around its mark, from the middle of its line."""


HANDLE_SIZES = (4.0, 5.5, 5.5)
"""Half the sizes of marks of handles in pixels, by the order of their derivatives."""


_HALO = 2.0
"""Pixels of paper on either side of each line of a number."""

_MOST_NUMBERS = 256
"""Numbers of which pictures are kept."""


class Shade(enum.IntEnum):
    """What handles are drawn in: ink, ink with paper in it, or the paper beneath both."""

    STRONG = 0
    FAINT = 1
    PAPER = 2


def _faint(ink: QColor, paper: QColor) -> QColor:
    """Return ink with as much paper in it as lets it be seen."""
    share = _FACING
    while share < 1.0 and contrast(mix(ink, paper, share).name(), paper.name()) < _SEEN:
        share += _STEP
    return mix(ink, paper, min(share, 1.0))


class HandleLook(NamedTuple):
    """How the mark of a handle looks.

    Attributes
    ----------
    order
        That of the derivative, less one.
    size
        Half of it, in pixels.
    is_given
        Whether a person has set it: it is filled then. What a rule estimates is hollow.
    shade
        What it is drawn in.
    """

    order: int
    size: float
    is_given: bool
    shade: Shade


class PointLook(NamedTuple):
    """How a point looks that is selected, or under the pointer: its colour, as a number, and its kind.

    A plain one has no colour of its own.
    """

    colour: int | None
    kind: int
    is_selected: bool


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
        self.scale = scale
        # What is drawn over pictures and fills of whatever colour has paper beneath it.
        self.has_paper_beneath = over_picture
        # In the grey of a faded letter grey handles cannot be seen.
        ink = theme.curve if over_picture else theme.handle
        self._theme, self._rim, self._ring = (
            theme,
            QPen(theme.paper, 1.5 * scale),
            QPen(theme.accent, 2 * scale),
        )
        self._greys = {Shade.STRONG: ink, Shade.FAINT: _faint(ink, theme.paper)}
        self.lines = {
            (shade, order): QPen(grey, (_FACING_LINE if shade is Shade.FAINT else _LINE) * scale, style)
            for shade, grey in self._greys.items()
            for order, style in enumerate(_LINES)
        }
        beside = _BENEATH_PICTURE if over_picture else _BENEATH_DRAWING
        self.beneath = QPen(theme.paper, (_LINE + 2 * beside) * scale)
        self._rim_of_handle = _RIM_OF_HANDLE[not over_picture] * scale
        self.handles = Sprites(self._paint_handle, _REACH * scale)
        self.points = Sprites(self._paint_point, _REACH * scale)
        self.font = fonts.times(0.95 * scale)
        self._written: dict[tuple[str, float], Written] = {}
        self._numbers: dict[tuple[str, int, float], QPixmap] = {}

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

    def number(self, text: str, colour: QColor, painter: QPainter) -> QPixmap:
        """Return the picture of a number with paper around its digits: a filled shape may lie beneath."""
        key = (text, colour.rgba(), painter.device().devicePixelRatioF())
        picture = self._numbers.get(key)
        if picture is None:
            if len(self._numbers) >= _MOST_NUMBERS:
                self._numbers.clear()
            size, width = QSizeF(self.written(text, painter).size), _HALO * self.scale
            painter.setFont(self.font)
            around = size + QSizeF(2 * width, 2 * width)
            picture = with_halo(painter, around, text, self._theme.paper, colour, width)
            self._numbers[key] = picture
        return picture

    def _paint_handle(self, painter: QPainter, look: HandleLook) -> None:
        """Draw a square for a velocity, a diamond for an acceleration, a triangle for a jerk."""
        size = look.size
        if look.shade is Shade.PAPER:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._theme.paper)
            size += self._rim_of_handle
        else:
            grey = self._greys[look.shade]
            painter.setPen(QPen(grey, 1.5 * self.scale))
            painter.setBrush(grey if look.is_given else self._theme.paper)
        if look.order == 0:
            painter.drawRect(QRectF(-size, -size, 2 * size, 2 * size))
        else:
            painter.drawPolygon((diamond, triangle)[look.order - 1](QPointF(), size))

    def _paint_point(self, painter: QPainter, look: PointLook) -> None:
        """Draw a point larger than it is at rest; one that is selected, within a ring."""
        radius = (_SELECTED_RADIUS if look.is_selected else RADIUS + _GROWTH) * self.scale
        if look.colour is None:
            self._paint_plain(painter, radius, look)
            return
        painter.setPen(self._rim)
        painter.setBrush(QColor.fromRgba(look.colour))
        paint_mark(painter, QPointF(), radius, look.kind, self._theme.paper)
        if look.is_selected:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(self._ring)
            painter.drawEllipse(QPointF(), radius + 3 * self.scale, radius + 3 * self.scale)

    def _paint_plain(self, painter: QPainter, radius: float, look: PointLook) -> None:
        """Draw a plain point: filled with the accent where it is selected, half so under the pointer."""
        accent, paper = self._theme.accent, self._theme.paper
        fill, line = (accent, paper) if look.is_selected else (mix(accent, paper, _HOVERED), accent)
        painter.setPen(QPen(line, PLAIN_RIM * self.scale))
        painter.setBrush(fill)
        paint_mark(painter, QPointF(), radius, look.kind)
