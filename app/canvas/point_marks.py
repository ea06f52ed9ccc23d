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
"""Radius of the dot in an open mark, relative to the mark: three pixels across in a mark of nine."""

_PICTURE = 16
"""Side of the picture of a mark in pixels: headers would scale pictures smaller than their icons."""

REACH = max(abs(coordinate) for kind in POINT_KINDS for corner in kind.outline for coordinate in corner)
"""Largest reach of a mark of radius 1."""


def paint_mark(
    painter: QPainter, centre: QPointF, radius: float, kind: int, paper: QColor | None = None
) -> None:
    """Draw the mark of the kind with index `kind` in `POINT_KINDS`, with the painter's pen and brush.

    Open marks have a dot in the colour `paper`, if given.
    """
    record = POINT_KINDS[kind]
    if record.outline:
        corners = [centre + QPointF(radius * x, radius * y) for x, y in record.outline]
        painter.drawPolygon(QPolygonF(corners))
    else:
        painter.drawEllipse(centre, radius, radius)
    if record.is_open and paper is not None:
        painter.save()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(paper)
        painter.drawEllipse(centre, _DOT * radius, _DOT * radius)
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
"""Radius of a disc in pixels, where there is enough room."""

_LEAST_RADIUS = 1.25
_RIM = 1.5
_MOST_SAMPLED, _LEAST_SAMPLED, _MOST_PAIRS = 48, 8, 16_000
"""Points whose nearest neighbour is searched, at most and at least, and the largest number of pairs."""

_LEAST_ROOM = 3.0
"""Distance of points in pixels below which discs would merge into a ribbon, and are hidden."""

_FEW = 24
"""Number of points that are always drawn: together they are no larger than a blot."""

_NEIGHBOURS = 2
_MOST_WITH_NEIGHBOURS = 32


class Discs(msgspec.Struct, frozen=True):
    """Size of the discs.

    Attributes
    ----------
    radius, rim
        In pixels.
    crowded
        Whether only selected and hovered points and their neighbours are drawn.
    """

    radius: float
    rim: float
    crowded: bool = False


def discs_for(pixels: FloatArray, visible: IntArray, scale: float) -> Discs:
    """Return the size of discs that leaves about half of the curve between them free.

    Parameters
    ----------
    pixels
        All points, (n, 2).
    visible
        The indices of the points on the screen.
    """
    if len(visible) < 2:
        return Discs(RADIUS * scale, _RIM * scale)
    gaps = _gaps(pixels, visible)
    is_few = len(visible) <= _FEW
    # One close pair is no reason to shrink all discs; a quarter of many points is.
    room = float(gaps[min((len(gaps) + 1) // 2, len(gaps) - 1) if is_few else len(gaps) // 4])
    if not is_few and float(gaps[len(gaps) // 2]) < _LEAST_ROOM * scale:
        return Discs(2.0 * scale, 0.0, crowded=True)
    # In steps, so that discs do not swell and shrink during a drag.
    radius = min(max(math.floor(room / 2) / 2, _LEAST_RADIUS * scale), RADIUS * scale)
    return Discs(radius, _RIM * scale if radius >= RADIUS * scale else 0.0)


def _gaps(pixels: FloatArray, visible: IntArray) -> FloatArray:
    """Return the distances of points to their nearest neighbours, ascending; of many points, of a sample."""
    positions = pixels[visible]
    count = min(max(_MOST_PAIRS // len(visible), _LEAST_SAMPLED), _MOST_SAMPLED)
    sample = np.arange(0, len(visible), max(len(visible) // count, 1))
    squares = (positions[sample, :1] - positions[:, 0]) ** 2
    squares += (positions[sample, 1:] - positions[:, 1]) ** 2
    squares[np.arange(len(sample)), sample] = np.inf
    gaps: FloatArray = np.sqrt(np.sort(squares.min(axis=1)))
    return gaps


def with_neighbours(selected: Collection[int], among: IntArray) -> IntArray:
    """Return the indices in `among` that are at most two away from a selected one."""
    if len(selected) > _MOST_WITH_NEIGHBOURS:
        # The selected points alone are enough.
        return among[:0]
    near = {index + step for index in selected for step in range(-_NEIGHBOURS, _NEIGHBOURS + 1)}
    return among[np.isin(among, np.fromiter(near, dtype=np.intp, count=len(near)))]


PLAIN_RIM: Final = 1.5
"""Width in pixels of the line around a plain mark; small marks have a finer line."""

_FINE_RIM = 1.0
_KINDS: Final[IntArray] = np.arange(len(POINT_KINDS))


class PointStamps:
    """Marks of points by their kinds.

    Plain marks are paper with a rim of the accent: who draws need not tell one point from another.
    """

    def __init__(self) -> None:
        self._theme: Theme | None = None
        self._coloured = Stamps(self._paint_coloured, REACH)
        self._plain = RingStamps(paint_plain, REACH)

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
        """Draw the points with the indices `calm` of those at `pixels` (n, 2), of `kinds` (n,)."""
        self._theme = theme
        radius = discs.radius
        if not is_plain:
            self._coloured.draw(painter, pixels[calm], calm, len(pixels), theme, radius, discs.rim, kinds)
            return
        rim = PLAIN_RIM if discs.rim else _FINE_RIM
        self._plain.draw(painter, pixels[calm], kinds[calm], len(POINT_KINDS), theme, radius, rim, _KINDS)

    def _paint_coloured(self, painter: QPainter, radius: float, kind: int) -> None:
        assert self._theme is not None
        paint_mark(painter, QPointF(0.0, 0.0), radius, kind, self._theme.paper)


def paint_plain(painter: QPainter, radius: float, kind: int) -> None:
    """Paint a mark at the origin without paper in it."""
    paint_mark(painter, QPointF(0.0, 0.0), radius, kind)


_LINES = (Qt.PenStyle.SolidLine, Qt.PenStyle.DotLine, Qt.PenStyle.DashDotLine)
"""The lines of handles, by the order of their derivatives."""


_SELECTED_RADIUS, _GROWTH = 5.5, 1.0

_REACH = 11.0
"""Largest reach of marks in pixels: the ring of a selected point, or a kind with corners."""

_HOVERED = 0.4
"""Share of the accent in a plain point under the pointer."""

_LEAST_INK, _LEAST_CONTRAST, _INK_STEP = 0.6, 3.0, 0.05
"""Smallest share of ink in facing handles, mixed with paper; the smallest contrast to paper, and the steps in
which the share is raised to reach it."""

_LINE, _FACING_LINE = 1.2, 0.9
"""Widths in pixels of the lines of handles, and of facing handles."""

_BENEATH_PICTURE, _BENEATH_DRAWING = 1.4, 0.9
"""Pixels of paper beside the line of a handle: over a picture to trace, and over a drawing."""

_RIM_OF_HANDLE = (2.5, 2.25)
"""The same around the mark of a handle, from the middle of its outline."""


HANDLE_SIZES = (4.0, 5.5, 5.5)
"""Half the sizes of marks of handles in pixels, by the order of their derivatives."""


_HALO = 2.0
"""Pixels of paper on either side of each line of a number."""

_MOST_NUMBERS = 256
"""Largest number of pictures of numbers in the cache."""


class Shade(enum.IntEnum):
    """Shade of a handle: ink, ink mixed with paper, or the paper below both."""

    STRONG = 0
    FAINT = 1
    PAPER = 2


def _faint(ink: QColor, paper: QColor) -> QColor:
    """Return ink mixed with as much paper as the smallest contrast allows."""
    share = _LEAST_INK
    while share < 1.0 and contrast(mix(ink, paper, share).name(), paper.name()) < _LEAST_CONTRAST:
        share += _INK_STEP
    return mix(ink, paper, min(share, 1.0))


class HandleLook(NamedTuple):
    """Look of the mark of a handle.

    Attributes
    ----------
    order
        Order of the derivative, less one.
    size
        Half the size, in pixels.
    is_given
        Whether the derivative was set: then the mark is filled. Estimated ones are hollow.
    shade
        Shade of ink.
    """

    order: int
    size: float
    is_given: bool
    shade: Shade


class PointLook(NamedTuple):
    """Look of a selected or hovered point: its colour as a number, None for a plain one, and its kind."""

    colour: int | None
    kind: int
    is_selected: bool


class TextGlyphs(NamedTuple):
    """Glyphs of a text, so that Qt need not look them up in every frame.

    Attributes
    ----------
    size
        In whole pixels.
    to_start
        Offset from the middle to the left end of the baseline.
    glyphs, ascent
        The runs of glyphs, and the distance from their origin down to the baseline.
    """

    size: QSize
    to_baseline: QPointF
    glyphs: list[QGlyphRun]
    ascent: QPointF

    def draw(self, painter: QPainter, centre: QPointF) -> None:
        """Draw the text with the painter's pen, centred at `centre`."""
        for run in self.glyphs:
            painter.drawGlyphRun(centre + self.to_baseline - self.ascent, run)


class InkCache:
    """The ink of a layer, made anew when theme, scale, fonts or background change."""

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()

    def of(self, theme: Theme, scale: float, fonts: Sizes, *, over_picture: bool) -> PointInk:
        """Return the ink for a theme, a scale and fonts."""
        key = (theme, scale, fonts, over_picture)
        if key != self._key:
            self._key = key
            self._ink = PointInk(theme, scale, fonts, over_picture=over_picture)
        return self._ink


class PointInk:
    """Pens, marks and fonts of points for one theme and scale: they are reused in every frame."""

    def __init__(self, theme: Theme, scale: float, fonts: Sizes, *, over_picture: bool) -> None:
        self.scale = scale
        # Over pictures and fills, of whatever colour, handles have paper below them.
        self.has_paper_beneath = over_picture
        # On the grey of a faded letter, grey handles would be invisible.
        ink = theme.curve if over_picture else theme.handle
        self._theme, self._rim = theme, QPen(theme.paper, 1.5 * scale)
        self._ring = QPen(theme.accent, 2 * scale)
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
        self._glyphs: dict[tuple[str, float], TextGlyphs] = {}
        self._numbers: dict[tuple[str, int, float], QPixmap] = {}

    def glyphs_of(self, text: str, painter: QPainter) -> TextGlyphs:
        """Return the glyphs of a text for the painter's device."""
        device = painter.device()
        key = (text, device.devicePixelRatioF())
        if key not in self._glyphs:
            exact = QFontMetricsF(self.font, device)
            to_baseline = QPointF(-exact.horizontalAdvance(text) / 2, exact.ascent() - exact.height() / 2)
            layout = QTextLayout(text, self.font, device)
            layout.beginLayout()
            line = layout.createLine()
            layout.endLayout()
            size, ascent = QFontMetrics(self.font, device).size(0, text), QPointF(0.0, line.ascent())
            self._glyphs[key] = TextGlyphs(size, to_baseline, layout.glyphRuns(), ascent)
        return self._glyphs[key]

    def number(self, text: str, colour: QColor, painter: QPainter) -> QPixmap:
        """Return the picture of a number with paper around its digits: a filled shape may lie beneath."""
        key = (text, colour.rgba(), painter.device().devicePixelRatioF())
        picture = self._numbers.get(key)
        if picture is None:
            if len(self._numbers) >= _MOST_NUMBERS:
                self._numbers.clear()
            size, width = QSizeF(self.glyphs_of(text, painter).size), _HALO * self.scale
            painter.setFont(self.font)
            outer = size + QSizeF(2 * width, 2 * width)
            picture = with_halo(painter, outer, text, self._theme.paper, colour, width)
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
        """Draw a hovered point larger than at rest, a selected one within a ring."""
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
        """Draw a plain point: filled with the accent if it is selected, with half of it if it is hovered."""
        accent, paper = self._theme.accent, self._theme.paper
        fill, line = (accent, paper) if look.is_selected else (mix(accent, paper, _HOVERED), accent)
        painter.setPen(QPen(line, PLAIN_RIM * self.scale))
        painter.setBrush(fill)
        paint_mark(painter, QPointF(), radius, look.kind)
