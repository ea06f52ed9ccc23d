"""Handles of the selected points and those that face them: lines and marks, as large as can be told apart."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter

from curvecore.arrays import BoolArray, FloatArray

from ..document.lines import line_beside
from ..document.model import Curve
from ..plotting.pens import diamond, triangle
from ..plotting.pixel_map import PixelMap
from ..plotting.segments import Bars, Segments
from ..view_model.curve_view import CurveView
from ..view_model.handles import (
    NO_HANDLES,
    Handles,
    PointSides,
    handles_on,
    sides_at,
    sides_facing,
)
from .point_ink import HandleInk, PointInk

MOST_POINTS = 100
"""Points up to which handles are shown: those of more hide the curve, and each other."""

LEFT_AWAY = f"Handles of up to {MOST_POINTS} selected points are shown · zoom in to see them"

_SIZES = (4.0, 5.5, 5.5)
"""Half the sizes of marks in pixels, by the order of their derivatives."""

_LEAST = 2.0
_SHARE = 0.42
"""Part of the way to the next mark that half a mark takes at most: a gap is left between the two."""

_FAR = 1e5
"""Pixels beyond which Qt draws nothing."""


def mark_sizes(handles: Handles, shown: PixelMap, scale: float) -> FloatArray:
    """Return half the sizes of the marks of handles, in pixels, (a, orders).

    On short segments the handles of a point lie within a few pixels of each other: the mark of each is small
    enough then to be seen beside the one that it hangs on, and the one that hangs on it.
    """
    return _sizes(shown.points(handles.places), scale)


def _sizes(pixels: FloatArray, scale: float) -> FloatArray:
    ways = pixels[:, 1:] - pixels[:, :-1]
    rooms = np.hypot(ways[..., 0], ways[..., 1])
    rooms[:, :-1] = np.minimum(rooms[:, :-1], rooms[:, 1:])
    largest = np.array(_SIZES[: rooms.shape[1]]) * scale
    sizes: FloatArray = np.minimum(largest, np.maximum(_SHARE * rooms, _LEAST * scale))
    return sizes


class ShownHandles:
    """The handles that are shown, and their picture.

    Of a single selected point all handles are shown, of several those of the velocities. So are, fainter,
    the velocity handles at the far ends of the segments beside them, which shape the same segments; not
    while points are added, when a press beside the curve means a point. Straight segments are bent by those
    of a single point: more would only lie on them.
    """

    def __init__(self) -> None:
        self._own = self._facing = NO_HANDLES
        self._view: CurveView | None = None
        # Which sides of points have them, and what that follows from: it stays under a drag.
        self._sides: tuple[PointSides, PointSides] = (sides_at(()), sides_at(()))
        self._sides_of: tuple[object, ...] = ()
        self._in_sight: tuple[PixelMap | None, Handles, Handles] = (None, NO_HANDLES, NO_HANDLES)
        self._lines, self._squares = Segments(), Bars()

    def find(self, view: CurveView, selection: frozenset[int], *, free: bool) -> None:
        """Find the handles; `free`, while points are added: at an end one point has them on both sides."""
        count, is_closed = len(view.source.points), view.source.is_closed
        sides_of = (selection, count, is_closed, free)
        if view is self._view and sides_of == self._sides_of:
            return
        is_one = len(selection) == 1
        # A line stays one while points are dragged.
        if sides_of != self._sides_of or not view.is_followed:
            indices = [index for index in selection if index < count]
            facing = sides_facing(() if free else indices, count, closed=is_closed)
            sides = sides_at(indices)
            self._sides = (sides if is_one else _bent(view.source, sides), _bent(view.source, facing))
        self._view, self._sides_of = view, sides_of
        self._in_sight = (None, NO_HANDLES, NO_HANDLES)
        own = handles_on(view, self._sides[0], free=free and is_one)
        self._own = own if is_one else own.of_velocities()
        self._facing = handles_on(view, self._sides[1]).of_velocities()

    def of_selected(self, shown: PixelMap) -> Handles:
        """Return the handles of the selected points; none where too many are in sight."""
        return self._limited(shown)[0]

    def facing(self, shown: PixelMap) -> Handles:
        """Return the handles that face the selected points from beyond the segments beside them."""
        return self._limited(shown)[1]

    def _limited(self, shown: PixelMap) -> tuple[Handles, Handles]:
        if self._in_sight[0] is not shown:
            own, facing = (_near(each, shown) for each in (self._own, self._facing))
            if len(own.indices) > 2 * MOST_POINTS:
                own = facing = NO_HANDLES
            self._in_sight = (shown, own, facing)
        return self._in_sight[1:]

    def note(self, shown: PixelMap) -> str:
        """Return the sentence about handles that are left away; empty where all are shown."""
        if len(self._own.indices) <= 2 * MOST_POINTS or len(self.of_selected(shown)):
            return ""
        return LEFT_AWAY

    def paint(self, painter: QPainter, shown: PixelMap, ink: PointInk) -> None:
        """Draw them."""
        own, facing = self._limited(shown)
        for handles, grey in ((facing, ink.faint), (own, ink.strong)):
            if len(handles):
                self._paint(painter, shown, handles, grey, ink)

    def _paint(
        self, painter: QPainter, shown: PixelMap, handles: Handles, grey: HandleInk, ink: PointInk
    ) -> None:
        pixels = shown.points(handles.places)
        sizes, is_near = _sizes(pixels, ink.scale), np.abs(pixels).max(axis=2) < _FAR
        is_drawn: BoolArray = is_near[:, 1:] & is_near[:, :-1]
        if ink.over_picture:
            # Paper under handles and their lines.
            painter.setBrush(ink.paper)
            painter.setPen(ink.beneath)
            for order in range(sizes.shape[1]):
                self._paint_lines(painter, pixels, is_drawn, order)
            painter.setPen(Qt.PenStyle.NoPen)
            self._paint_marks(painter, pixels, sizes + 2.5 * ink.scale, is_drawn)
        for order in range(sizes.shape[1]):
            painter.setPen(grey.lines[order])
            self._paint_lines(painter, pixels, is_drawn, order)
        painter.setPen(grey.outline)
        # Filled: set by the person. Hollow: estimated by a rule.
        painter.setBrush(ink.paper)
        self._paint_marks(painter, pixels, sizes, is_drawn & ~handles.explicit)
        painter.setBrush(grey.filled)
        self._paint_marks(painter, pixels, sizes, is_drawn & handles.explicit)

    def _paint_lines(self, painter: QPainter, pixels: FloatArray, is_drawn: BoolArray, order: int) -> None:
        self._lines.fill(pixels[is_drawn[:, order], order : order + 2].reshape(-1, 4))
        self._lines.draw(painter)

    def _paint_marks(
        self, painter: QPainter, pixels: FloatArray, sizes: FloatArray, which: BoolArray
    ) -> None:
        """Draw squares for velocities, diamonds for accelerations, triangles for jerks."""
        rows = which[:, 0].nonzero()[0]
        if len(rows):
            half, squares = sizes[rows, :1], np.empty((len(rows), 4))
            squares[:, :2] = pixels[rows, 1] - half
            squares[:, 2:] = 2.0 * half
            self._squares.fill(squares)
            self._squares.draw(painter)
        for order in range(1, which.shape[1]):
            # Those of a single point: never many.
            for arm in which[:, order].nonzero()[0].tolist():
                shape, place = (diamond, triangle)[order - 1], QPointF(*pixels[arm, order + 1].tolist())
                painter.drawPolygon(shape(place, float(sizes[arm, order])))


def _bent(curve: Curve, sides: PointSides) -> PointSides:
    """Return the sides on which there is no straight segment."""
    if not curve.family.derivatives:
        return sides
    arms = zip(sides.indices.tolist(), sides.ahead.tolist(), strict=True)
    is_bent = np.array([not line_beside(curve, index, ahead=ahead) for index, ahead in arms], dtype=bool)
    return sides if is_bent.all() else PointSides(sides.indices[is_bent], sides.ahead[is_bent])


def _near(handles: Handles, shown: PixelMap) -> Handles:
    """Return the arms that reach into the area; all where they are few."""
    if len(handles.indices) <= 2 * MOST_POINTS:
        return handles
    pixels = shown.points(handles.places)
    low, high = pixels.min(axis=1), pixels.max(axis=1)
    which: BoolArray = ((high > 0) & (low < [shown.width, shown.height])).all(axis=1)
    return handles.of_arms(which)
