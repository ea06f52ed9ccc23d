"""Marks of points and handles: the shape of each kind, its colours, and many of them drawn in one call."""

from __future__ import annotations

import enum
import math
from collections.abc import Collection
from functools import lru_cache
from typing import Final, NamedTuple

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import (
    QColor,
    QFontMetrics,
    QFontMetricsF,
    QGlyphRun,
    QPainter,
    QPen,
    QPixmap,
    QPolygonF,
    QTextLayout,
)

from curvecore.arrays import FloatArray, IntArray

from ..appearance.theme import Theme, mix
from ..plotting.pens import diamond, triangle
from ..plotting.stamps import RingStamps, Sprites, Stamps
from ..plotting.text import Sizes, with_halo
from ..view_model.palette import contrast
from ..view_model.point_kinds import POINT_KINDS

_DOT = 0.36
"""Radius of the dot in the middle of a mark that is open: three pixels across in one of nine."""

_PICTURE = 16
"""Pixels along the sides of the picture of a mark: headers scale what is smaller than their icons are."""

REACH = max(abs(coordinate) for kind in POINT_KINDS for corner in kind.outline for coordinate in corner)
"""Largest reach of a mark of radius 1."""


def paint_mark(
    painter: QPainter, place: QPointF, radius: float, kind: int, paper: QColor | None = None
) -> None:
    """Draw the mark of a point of the kind at a place in `POINT_KINDS`, with the painter's pen and brush.

    Without `paper` no mark has a dot.
    """
    record = POINT_KINDS[kind]
    if record.outline:
        corners = [place + QPointF(radius * x, radius * y) for x, y in record.outline]
        painter.drawPolygon(QPolygonF(corners))
    else:
        painter.drawEllipse(place, radius, radius)
    if record.is_open and paper is not None:
        painter.save()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(paper)
        painter.drawEllipse(place, _DOT * radius, _DOT * radius)
        painter.restore()


@lru_cache(maxsize=512)
def mark_picture(colour: str, paper: str, size: int, kind: int) -> QPixmap:
    """Return the mark of a kind, `size` pixels across, in the middle of a picture."""
    pixmap = QPixmap(2 * _PICTURE, 2 * _PICTURE)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(colour))
    paint_mark(painter, QPointF(_PICTURE / 2, _PICTURE / 2), size / 2, kind, QColor(paper))
    painter.end()
    return pixmap


RADIUS = 4.5
"""Radius of a disc in pixels, where there is room."""

_LEAST_RADIUS = 1.25
_RIM = 1.5
_MOST_SAMPLED, _LEAST_SAMPLED, _MOST_PAIRS = 48, 8, 16_000
"""Points that are asked how near the others are: fewer of very many, for they are asked every frame."""

_LEAST_ROOM = 3.0
"""Pixels from point to point below which discs make a ribbon, and are left away."""

_FEW = 24
"""So few points are drawn in any case: together they are no larger than a blot."""

_NEIGHBOURS = 2
_MOST_WITH_NEIGHBOURS = 32


class Discs(msgspec.Struct, frozen=True):
    """Size of the discs.

    Attributes
    ----------
    radius, rim
        In pixels.
    crowded
        Whether only those that are selected or under the pointer are drawn, and their neighbours.
    """

    radius: float
    rim: float
    crowded: bool = False


def discs_for(pixels: FloatArray, visible: IntArray, scale: float) -> Discs:
    """Return how large discs are so that about half of the curve between them stays free.

    Parameters
    ----------
    pixels
        All points, (n, 2).
    visible
        The indices of those on the screen.
    """
    if len(visible) < 2:
        return Discs(RADIUS * scale, _RIM * scale)
    gaps = _gaps(pixels, visible)
    few = len(visible) <= _FEW
    # One pair that lies close is no reason to shrink all; of many, a quarter is.
    room = float(gaps[min((len(gaps) + 1) // 2, len(gaps) - 1) if few else len(gaps) // 4])
    if not few and float(gaps[len(gaps) // 2]) < _LEAST_ROOM * scale:
        return Discs(2.0 * scale, 0.0, crowded=True)
    # In steps, so that the discs do not swell and shrink under a drag.
    radius = min(max(math.floor(room / 2) / 2, _LEAST_RADIUS * scale), RADIUS * scale)
    return Discs(radius, _RIM * scale if radius >= RADIUS * scale else 0.0)


def _gaps(pixels: FloatArray, visible: IntArray) -> FloatArray:
    """Return how far it is from points to whatever other point is nearest, ascending; of many, of some."""
    here = pixels[visible]
    wanted = min(max(_MOST_PAIRS // len(visible), _LEAST_SAMPLED), _MOST_SAMPLED)
    sample = np.arange(0, len(visible), max(len(visible) // wanted, 1))
    squares = (here[sample, :1] - here[:, 0]) ** 2
    squares += (here[sample, 1:] - here[:, 1]) ** 2
    squares[np.arange(len(sample)), sample] = np.inf
    gaps: FloatArray = np.sqrt(np.sort(squares.min(axis=1)))
    return gaps


def with_neighbours(selected: Collection[int], among: IntArray) -> IntArray:
    """Return those `among` some points that lie within two places of a selected one."""
    if len(selected) > _MOST_WITH_NEIGHBOURS:
        # They are many themselves.
        return among[:0]
    near = {index + by for index in selected for by in range(-_NEIGHBOURS, _NEIGHBOURS + 1)}
    return among[np.isin(among, np.fromiter(near, dtype=np.intp, count=len(near)))]


PLAIN_RIM: Final = 1.5
"""Pixels of the line around a plain mark; small ones have a finer line."""

_FINE_RIM = 1.0
_KINDS: Final[IntArray] = np.arange(len(POINT_KINDS))


class PointStamps:
    """Marks of points by their kinds.

    Those of a plain look are paper in a rim of the accent: which point is which is nothing that a person who
    draws asks.
    """

    def __init__(self) -> None:
        self._theme: Theme | None = None
        self._coloured = Stamps(self._paint_coloured, REACH)
        self._plain = RingStamps(_paint_plain, REACH)

    def draw(
        self,
        painter: QPainter,
        pixels: FloatArray,
        calm: IntArray,
        kinds: IntArray,
        theme: Theme,
        discs: Discs,
        *,
        is_plain: bool,
    ) -> None:
        """Draw the `calm` ones of points at `pixels` (n, 2), of these `kinds` (n,)."""
        self._theme = theme
        if not is_plain:
            self._coloured.draw(
                painter, pixels[calm], calm, len(pixels), theme, discs.radius, discs.rim, kinds
            )
            return
        rim = PLAIN_RIM if discs.rim else _FINE_RIM
        self._plain.draw(
            painter, pixels[calm], kinds[calm], len(POINT_KINDS), theme, discs.radius, rim, _KINDS
        )

    def _paint_coloured(self, painter: QPainter, radius: float, kind: int) -> None:
        assert self._theme is not None
        paint_mark(painter, QPointF(0.0, 0.0), radius, kind, self._theme.paper)


def _paint_plain(painter: QPainter, radius: float, kind: int) -> None:
    paint_mark(painter, QPointF(0.0, 0.0), radius, kind)


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
