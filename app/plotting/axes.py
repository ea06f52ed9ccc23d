"""The axes beside a plot, and the rulers that mark the pointer and the selection on them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QFontMetricsF, QPainter, QPolygonF
from PySide6.QtWidgets import QGraphicsGridLayout, QGraphicsWidget, QWidget

from curvecore.arrays import FloatArray

from ..appearance.theme import LIGHT, Theme
from .camera import Camera
from .drawing import Bars
from .graphs import pg
from .pixel_map import PixelMap
from .stamps import Sprites
from .ticks import LabelRoom, Stretch, Ticks, choose_ticks, nice_step, with_marks

_WIDTH = 46
_TICK, _MARK = 5.0, 3.5
"""Length in pixels of a tick with a number, and of one without."""

_GAP = 4.0
"""Pixels between a tick and its number."""

_LEAST_ALONG_X, _LEAST_ALONG_Y = 70.0, 30.0
"""Smallest distance in pixels of two numbers, where none was set."""

_BETWEEN_ALONG_X, _BETWEEN_ALONG_Y = 10.0, 2.0
"""Free pixels between two numbers."""

_PARTS = 5
"""Ticks from one number to the next, where no distances were set."""

_MARGIN, _FOOT = 1, 6
"""Pixels around the axes, and below the numbers along x."""

_ONE_LINE = Qt.TextFlag.TextSingleLine | Qt.TextFlag.TextDontClip
_IN_THE_MIDDLE = int(_ONE_LINE | Qt.AlignmentFlag.AlignCenter)
_AT_THE_RIGHT = int(_ONE_LINE | Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)


class Axis:
    """One axis: its numbers and ticks for the visible part.

    Attributes
    ----------
    font
        Font of the numbers.
    is_ruler
        Whether the axis has finer ticks, on a background of its own.
    """

    def __init__(self, changed: Callable[[], object], *, is_upright: bool) -> None:
        self._changed, self._is_upright = changed, is_upright
        self.is_ruler = False
        self.set_font(QFont(), 1.0)
        self._factor = 1.0
        self._least = -math.inf
        # Distances of ticks and numbers, None to suit the zoom; or all ticks, as given.
        self._distances: tuple[float, float] | None = None
        self._given: Ticks | None = None
        self._cached: tuple[object, Ticks] = (None, Ticks(()))

    # Settings

    def set_ticks(self, ticks: Sequence[tuple[float, str]]) -> None:
        """Show these ticks with their labels, and no others."""
        self._given = Ticks(tuple(ticks))
        self._changed()

    def set_distances(self, tick: float, number: float) -> None:
        """Set the distances of ticks and, where there is room, of numbers, which stand at ticks."""
        if self._distances != (tick, number):
            self._distances = (tick, number)
            self._changed()

    def set_least(self, least: float) -> None:
        """Show no ticks below this value: the area below is no part of the plot."""
        if least != self._least:
            self._least = least
            self._changed()

    def set_factor(self, factor: float) -> None:
        """Write numbers times `factor`."""
        self._factor = factor
        self._changed()

    def set_font(self, font: QFont, scale: float) -> None:
        """Use this font, which is enlarged by `scale` already."""
        self.font, self._scale, self._metrics = font, scale, QFontMetricsF(font)

    # Ticks

    @property
    def thickness(self) -> float:
        """Width of the axis in pixels, or its height.

        The left axes of all plots have one width: they stay aligned, and nothing jumps when numbers grow.
        """
        if self._is_upright:
            return _WIDTH * self._scale
        return math.ceil(self._metrics.height()) + _TICK + _GAP + _FOOT

    def ticks(self, low: float, high: float, size: float) -> Ticks:
        """Return the ticks from `low` to `high`, on `size` pixels."""
        if self._given is not None:
            return self._given
        key = (low, high, size, self._distances, self._factor, self._scale, self.is_ruler)
        if self._cached[0] != key:
            self._cached = (key, self._find(Stretch(low, high, size, self._factor)))
        return self._cached[1]

    def ticks_in(self, pixel_map: PixelMap) -> Ticks:
        """Return the ticks of the visible part."""
        x_min, y_min, x_max, y_max = pixel_map.box
        if self._is_upright:
            minimum = max(y_min, self._least) if self._least < y_max else y_min
            return self.ticks(minimum, y_max, pixel_map.height * (y_max - minimum) / (y_max - y_min))
        return self.ticks(x_min, x_max, pixel_map.width)

    def _find(self, visible: Stretch) -> Ticks:
        minimum = (_LEAST_ALONG_Y if self._is_upright else _LEAST_ALONG_X) * self._scale
        suited = nice_step(minimum / visible.scale * self._factor) / self._factor
        tick, number_distance = self._distances or (suited / _PARTS, suited)
        return with_marks(
            choose_ticks(visible, tick, number_distance, self._room()), visible, tick, finer=self.is_ruler
        )

    def _room(self) -> LabelRoom:
        wide, high = self._metrics.horizontalAdvance, self._metrics.height()
        if self._is_upright:
            return LabelRoom(lambda _text: high, wide, _BETWEEN_ALONG_Y, self._strip, high / 4, high / 4)
        return LabelRoom(wide, lambda _text: high, _BETWEEN_ALONG_X, self._strip, _WIDTH / 2, _MARGIN)

    @property
    def _strip(self) -> float:
        """Pixels for a number, across the axis."""
        return self.thickness - _TICK - _GAP


class Side:
    """The side of the plot area at which an axis is painted: pixels along it, and away from the area."""

    def __init__(self, axis: Axis, pixel_map: PixelMap, *, is_upright: bool, is_above: bool) -> None:
        self.axis, self._pixel_map, self._is_upright = axis, pixel_map, is_upright
        # The edge at which ticks begin, and their direction.
        self._edge = 0.0 if is_upright or is_above else pixel_map.height
        self._out = -1.0 if is_upright or is_above else 1.0

    @property
    def length(self) -> float:
        """Length of the side in pixels."""
        return self._pixel_map.height if self._is_upright else self._pixel_map.width

    def at(self, coordinate: float) -> float:
        """Return the pixel along the side of a coordinate of the plane."""
        return self._pixel_map.point(coordinate, coordinate)[1 if self._is_upright else 0]

    def point(self, along: float, away: float) -> QPointF:
        """Return a pixel of the plot area."""
        across = self._edge + self._out * away
        return QPointF(across, along) if self._is_upright else QPointF(along, across)

    def box(self, first: float, last: float, near: float, far: float) -> QRectF:
        """Return the box between two pixels along the side and two distances from the area."""
        return QRectF(self.point(first, near), self.point(last, far)).normalized()

    def paint(self, painter: QPainter, theme: Theme) -> None:
        """Paint the background, the line, the ticks and the numbers."""
        axis = self.axis
        ticks = axis.ticks_in(self._pixel_map)
        if axis.is_ruler:
            painter.fillRect(self.box(0, self.length, 0, axis.thickness), theme.surface)
        numbers = [(round(self.at(coordinate)), text) for coordinate, text in ticks.labels]
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.ghost if axis.is_ruler else theme.grid_coarse)
        bars = Bars()
        bars.fill(self._bars_of(ticks.marks, [along for along, _ in numbers]))
        bars.draw(painter)
        painter.setFont(axis.font)
        painter.setPen(theme.muted)
        metrics = painter.fontMetrics()
        for along, text in numbers:
            self._write(painter, along, text, metrics)

    def _bars_of(self, marks: Sequence[tuple[float, float]], numbered: Sequence[int]) -> FloatArray:
        """Return bars for `marks` (coordinate, size), for ticks at `numbered` pixels, and for the line."""
        coordinates, sizes = np.array(marks, dtype=float).reshape(-1, 2).T
        to_pixels = self._pixel_map.y if self._is_upright else self._pixel_map.x
        along = np.round(to_pixels(coordinates))
        along = np.concatenate([along, numbered, [0.0]])
        away = np.concatenate([_MARK * sizes, np.full(len(numbered), _TICK), [1.0]])
        ones = np.ones_like(away)
        ones[-1] = self.length
        edge = self._edge + (-away if self._out < 0 else np.zeros_like(away))
        if self._is_upright:
            return np.column_stack([edge, along, away, ones])
        return np.column_stack([along, edge, ones, away])

    def _write(self, painter: QPainter, along: float, text: str, metrics: QFontMetrics) -> None:
        """Write a number beside its tick, squeezed where there is too little room."""
        half = metrics.height() / 2
        if not self._is_upright:
            away = _TICK + _GAP / 2
            box = self.box(along - half, along + half, away, away + 2 * half)
            painter.drawText(box, _IN_THE_MIDDLE, text)
            return
        width, room = metrics.horizontalAdvance(text), self.axis.thickness - _TICK - _GAP
        end = self.point(along, _TICK + _GAP)
        if width <= room:
            painter.drawText(QRectF(end.x() - width, end.y() - half, width, 2 * half), _AT_THE_RIGHT, text)
            return
        painter.save()
        painter.translate(end)
        painter.scale(room / width, 1.0)
        painter.drawText(QRectF(-width, -half, width, 2 * half), _AT_THE_RIGHT, text)
        painter.restore()


class Axes:
    """The left and the lower axis of a view box; as rulers, the left and the upper one.

    Attributes
    ----------
    frame
        Holds the view box, with room for the axes.
    are_rulers
        Whether the axes are rulers.
    """

    def __init__(self, box: pg.ViewBox, changed: Callable[[], object]) -> None:
        self._by_side = {side: Axis(changed, is_upright=side == "left") for side in ("left", "bottom")}
        self._theme = LIGHT
        self.are_rulers = False
        # The sides, and the map and kind of axes that they depend on: they stay during a drag.
        self._sides: tuple[Side, ...] = ()
        self._sides_key: tuple[PixelMap | None, bool] = (None, False)
        self.frame = QGraphicsWidget()
        self._grid = QGraphicsGridLayout(self.frame)
        self._grid.setSpacing(0)
        self._grid.addItem(box, 0, 0)

    def __getitem__(self, side: str) -> Axis:
        """Return the axis along x, "bottom", or the one along y, "left"."""
        return self._by_side[side]

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self._theme = theme

    def set_scale(self, font: QFont, scale: float) -> None:
        """Write numbers a little smaller than in `font`, times `scale`."""
        small = QFont(font)
        small.setPointSizeF(max(font.pointSizeF() - 1.5, 7.0) * scale)
        for axis in self._by_side.values():
            axis.set_font(small, scale)
        self._lay_out()

    def set_rulers(self, are_rulers: bool) -> None:
        """Show the axes as rulers, or as plain axes."""
        self.are_rulers = are_rulers
        for axis in self._by_side.values():
            axis.is_ruler = are_rulers
        self._lay_out()

    def _lay_out(self) -> None:
        left, across = (self[side].thickness for side in ("left", "bottom"))
        above, below = (across, 0.0) if self.are_rulers else (0.0, across)
        self._grid.setContentsMargins(_MARGIN + left, _MARGIN + above, _MARGIN, _MARGIN + below)
        self._grid.activate()

    def sides(self, pixel_map: PixelMap) -> tuple[Side, ...]:
        """Return the sides of the plot area for the axis along x and the axis along y."""
        if self._sides_key[0] is not pixel_map or self._sides_key[1] is not self.are_rulers:
            self._sides_key = (pixel_map, self.are_rulers)
            self._sides = (
                Side(self["bottom"], pixel_map, is_upright=False, is_above=self.are_rulers),
                Side(self["left"], pixel_map, is_upright=True, is_above=False),
            )
        return self._sides

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint both axes, in pixels of the plot area."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        if self.are_rulers:
            left, above = self["left"].thickness + _MARGIN, self["bottom"].thickness + _MARGIN
            painter.fillRect(QRectF(-left, -above, left, above), self._theme.surface)
        for side in self.sides(pixel_map):
            side.paint(painter, self._theme)
        if offset := self["bottom"].ticks_in(pixel_map).offset:
            self._write_offset(painter, pixel_map, offset)

    def _write_offset(self, painter: QPainter, pixel_map: PixelMap, text: str) -> None:
        """Write the offset of the numbers along x where both axes meet, over any number there."""
        across, left = self["bottom"].thickness, self["left"].thickness
        metrics = painter.fontMetrics()
        top = -across if self.are_rulers else pixel_map.height + 1
        box = QRectF(-left, top, max(metrics.horizontalAdvance(text) + 6, left), across)
        painter.fillRect(box, self._theme.surface if self.are_rulers else self._theme.paper)
        painter.setPen(self._theme.muted)
        painter.drawText(box, _AT_THE_RIGHT, text)


_POINTER_MARK = 6.0
"""Length in pixels of the mark of the pointer."""

_REACH = math.ceil(_POINTER_MARK) + 2
"""Pixels beside the plot area that marks occupy, along both sides and at their corner."""

_INSIDE = 2
"""Pixels of the plot area that marks touch."""

_BAND = 4.0
_BAND_SHARE = 0.45


class Extent(NamedTuple):
    """Lower left and upper right corner of something in the plane."""

    low: tuple[float, float]
    high: tuple[float, float]


class Rulers:
    """Marks on the axes of a plot, while these are rulers.

    Attributes
    ----------
    pointer
        The pixel of the plot area under the pointer, None while it is elsewhere.
    extent
        Extent of the selection, None without one.

    Parameters
    ----------
    is_due
        Returns whether a paint of the spread is requested already.
    """

    def __init__(self, viewport: QWidget, axes: Axes, camera: Camera, is_due: Callable[[], bool]) -> None:
        self._viewport, self._axes, self._camera, self._is_due = viewport, axes, camera, is_due
        self.pointer: tuple[float, float] | None = None
        self.extent: Extent | None = None
        # The colour of bands, and its theme.
        self._band: tuple[QColor, Theme | None] = (QColor(), None)
        # The marks of the pointer on both rulers, and their theme.
        self._marks, self._marks_theme = Sprites[int](partial(_paint_mark, LIGHT), _POINTER_MARK), LIGHT
        # The plot area with the marks beside it, and the area for which it was computed.
        self._spread, self._spread_area = QRect(), QRect()

    @property
    def are_visible(self) -> bool:
        """Whether the axes are rulers."""
        return self._axes.are_rulers

    @property
    def thickness(self) -> float:
        """Height of the upper ruler in pixels; 0 without rulers."""
        return self._camera.origin.y() if self.are_visible else 0.0

    @property
    def spread(self) -> QRect:
        """The plot area with the marks beside it: one rectangle, to which Qt clips quickly."""
        area = self._camera.area
        if not self._axes.are_rulers:
            return area
        if area is not self._spread_area:
            corner = self._camera.origin.toPoint() - QPoint(_REACH, _REACH)
            self._spread, self._spread_area = QRect(corner, self._viewport.rect().bottomRight()), area
        return self._spread

    def show(self, pointer: tuple[float, float] | None, extent: Extent | None) -> None:
        """Mark the pointer and the extent from the next paint on."""
        if (pointer, extent) == (self.pointer, self.extent):
            return
        self.pointer, self.extent = pointer, extent
        if self.are_visible and not self._is_due():
            spread = self.spread
            self._viewport.update(spread.x(), spread.y(), spread.width(), _REACH + _INSIDE)
            self._viewport.update(spread.x(), spread.y(), _REACH + _INSIDE, spread.height())

    def axis_at(self, pixel: tuple[float, float]) -> int | None:
        """Return the axis of the ruler at a pixel of the plot area: 0 for x, 1 for y, None elsewhere."""
        pixel_map, (x, y) = self._camera.pixel_map, pixel
        if not self.are_visible:
            return None
        if y < 0 <= x <= pixel_map.width:
            return 0
        return 1 if x < 0 <= y <= pixel_map.height else None

    def paint(self, painter: QPainter, pixel_map: PixelMap, theme: Theme) -> None:
        """Paint the marks, in pixels of the plot area."""
        if not self.are_visible:
            return
        sides = self._axes.sides(pixel_map)
        if self.extent is not None:
            self._paint_bands(painter, sides, self.extent, theme)
        if self.pointer is not None:
            if self._marks_theme is not theme:
                self._marks, self._marks_theme = Sprites(partial(_paint_mark, theme), _POINTER_MARK), theme
            x, y = self.pointer
            marks = [(0, x, 0.0)] * (0 <= x <= pixel_map.width) + [(1, 0.0, y)] * (0 <= y <= pixel_map.height)
            self._marks.draw(painter, marks)

    def _paint_bands(self, painter: QPainter, sides: Sequence[Side], extent: Extent, theme: Theme) -> None:
        """Paint the extent of the selection, with a line at each end."""
        if self._band[1] is not theme:
            colour = QColor(theme.accent)
            colour.setAlphaF(_BAND_SHARE)
            self._band = (colour, theme)
        painter.setPen(theme.accent)
        for axis, side in enumerate(sides):
            ends = sorted((side.at(extent.low[axis]), side.at(extent.high[axis])))
            first, last = max(ends[0], 0.0), min(ends[1], side.length)
            if first <= last:
                painter.fillRect(side.box(first, last, 0, _BAND), self._band[0])
                for end in (round(first), round(last)):
                    painter.drawLine(side.point(end, 0), side.point(end, _POINTER_MARK))


def _paint_mark(theme: Theme, painter: QPainter, axis: int) -> None:
    """Draw a triangle that points at the drawing: above it for x, left of it for y."""
    half = 0.7 * _POINTER_MARK
    corners = [(0.0, 0.0), (-half, -_POINTER_MARK), (half, -_POINTER_MARK)]
    painter.setPen(theme.surface)
    painter.setBrush(theme.ink)
    painter.drawPolygon(QPolygonF([QPointF(y, x) if axis else QPointF(x, y) for x, y in corners]))
