"""Handles of a point: their lines and marks, as large as can be told apart."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter

from ..plotting.drawing import is_near
from ..plotting.pens import diamond, triangle
from ..plotting.pixel_map import PixelMap
from ..view_model.handles import Handle
from .point_ink import PointInk

_SIZES = (4.0, 5.5, 5.5)
"""Half the sizes of marks in pixels, by the order of their derivatives."""

_LEAST = 2.0
_SHARE = 0.42
"""Part of the way to the next mark that half a mark takes at most: a gap is left between the two."""


class _Placed(NamedTuple):
    """A handle in pixels, with half the size of its mark."""

    handle: Handle
    tip: QPointF
    anchor: QPointF
    size: float


def mark_sizes(handles: Sequence[Handle], shown: PixelMap, scale: float) -> list[float]:
    """Return half the size of the mark of each of one point's handles, in pixels.

    On short segments the handles of a point lie within a few pixels of each other: the mark of each is small
    enough then to be seen beside the one that it hangs on, and the one that hangs on it.
    """
    ways = [math.dist(shown.point(*each.position), shown.point(*each.anchor)) for each in handles]
    rooms = list(ways)
    for place, (before, after) in enumerate(pairwise(handles)):
        if after.anchor == before.position:
            rooms[place] = min(ways[place], ways[place + 1])
    return [
        min(_SIZES[each.kind - 1] * scale, max(_SHARE * room, _LEAST * scale))
        for each, room in zip(handles, rooms, strict=True)
    ]


def paint_handles(painter: QPainter, shown: PixelMap, handles: Sequence[Handle], ink: PointInk) -> None:
    """Draw the handles of one point."""
    if not handles:
        return
    placed = [
        _Placed(handle, QPointF(*tip), QPointF(*anchor), size)
        for handle, size in zip(handles, mark_sizes(handles, shown, ink.scale), strict=True)
        for tip, anchor in [(shown.point(*handle.position), shown.point(*handle.anchor))]
        if is_near(*tip) and is_near(*anchor)
    ]
    if ink.over_picture:
        _paint_paper(painter, placed, ink)
    for handle, tip, anchor, size in placed:
        painter.setPen(ink.lines[handle.kind - 1])
        painter.drawLine(anchor, tip)
        painter.setPen(ink.outline)
        # Filled: set by the person. Hollow: estimated by a rule.
        painter.setBrush(ink.filled if handle.explicit else ink.hollow)
        _paint_mark(painter, handle, tip, size)


def _paint_paper(painter: QPainter, placed: Sequence[_Placed], ink: PointInk) -> None:
    """Lay paper under handles and their lines."""
    painter.setBrush(ink.hollow)
    for handle, tip, anchor, size in placed:
        painter.setPen(ink.beneath)
        painter.drawLine(anchor, tip)
        painter.setPen(Qt.PenStyle.NoPen)
        _paint_mark(painter, handle, tip, size + 2.5 * ink.scale)


def _paint_mark(painter: QPainter, handle: Handle, tip: QPointF, size: float) -> None:
    """Draw a square for a velocity, a diamond for an acceleration, a triangle for a jerk."""
    if handle.kind == 1:
        painter.drawRect(QRectF(tip.x() - size, tip.y() - size, 2 * size, 2 * size))
    else:
        painter.drawPolygon((diamond if handle.kind == 2 else triangle)(tip, size))
