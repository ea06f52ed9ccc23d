"""Handles of selected points and handles that face these: their lines, and marks that do not overlap."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF
from PySide6.QtGui import QPainter

from curvecore.arrays import BoolArray

from ..document.constraints import is_straight_beside
from ..document.model import Curve
from ..plotting.pixel_map import PixelMap
from ..plotting.stamps import Mark
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.handles import NO_HANDLES, Handles, PointSides, handles_on, sides_at, sides_facing
from .point_marks import HANDLE_SIZES, HandleLook, PointInk, Shade

MOST_POINTS = 100
"""Largest number of points with handles: more would hide the curve and each other."""

TOO_MANY_HANDLES = f"Handles are shown for up to {MOST_POINTS} selected points · zoom in to see them"

_LEAST = 2.0
_SHARE = 0.42
"""Largest share of the distance to the next mark that half a mark takes: a gap remains between the two."""

_FAINT_SIZE = 0.8
"""Size of the marks of facing handles, relative to the others."""

_STEPS = 4
"""Steps per pixel in which marks grow."""

_FAR = 1e5
"""Pixels beyond which nothing is drawn."""


Arm = list[list[float]]
"""The pixels of a point and of the handles on one side of it, each [x, y]."""


def mark_sizes(arm: Arm, scale: float, share: float = 1.0) -> list[float]:
    """Return half the sizes of the marks of an arm, in pixels; `share` scales their usual sizes.

    On short segments the handles of a point lie within a few pixels of each other: each mark is then small
    enough to leave its neighbours along the arm visible.
    """
    rooms = [*map(math.dist, arm, arm[1:])]
    rooms = [*map(min, rooms, rooms[1:]), rooms[-1]]
    minimum = _LEAST * scale
    return [
        min(max(largest * share * scale, minimum), max(_SHARE * room, minimum))
        for largest, room in zip(HANDLE_SIZES, rooms, strict=False)
    ]


class VisibleHandles:
    """The visible handles: which there are, and how they are painted.

    A single selected point shows all its handles, several points show their velocities. Velocity handles at
    the far ends of the adjacent segments shape the same segments and are shown fainter ("facing"); not while
    points are added, when a press beside the curve adds a point. On straight segments only a single point
    shows handles: more would only lie on the segments.
    """

    def __init__(self) -> None:
        # Facing handles come first: they lie below the others.
        self._handles = NO_HANDLES
        self._view: CurveView | None = None
        # The sides of points with handles, and the key that they depend on: both stay during a drag.
        self._sides: PointSides = sides_at(())
        self._sides_key: tuple[object, ...] = ()
        self._selection: frozenset[int] = frozenset()
        self._facing_counted: tuple[object, int] = (None, 0)
        self._visible_at: tuple[PixelMap | None, Handles, int] = (None, NO_HANDLES, 0)

    def find(self, view: CurveView, selection: frozenset[int], *, free: bool) -> None:
        """Find the handles; with `free` (points are added) an end has handles on both sides."""
        count, is_closed = len(view.source.points), view.source.is_closed
        # Points of a family without derivatives have no handles.
        may_have = selection if view.source.family.derivatives else frozenset[int]()
        sides_key = (may_have, count, is_closed, free)
        if view is self._view and sides_key == self._sides_key:
            return
        is_one = len(selection) == 1
        # A straight segment stays straight while points are dragged.
        if sides_key != self._sides_key or not view.is_followed:
            indices = [index for index in may_have if index < count]
            sides, facing = sides_at(indices), sides_facing(() if free else indices, count, closed=is_closed)
            self._sides = _joined(_bent(view.source, facing), sides if is_one else _bent(view.source, sides))
        self._view, self._sides_key, self._selection = view, sides_key, selection
        self._visible_at = (None, NO_HANDLES, 0)
        handles = handles_on(view, self._sides, free=free and is_one)
        self._handles = handles if is_one else handles.of_velocities()

    def of_selected(self, pixel_map: PixelMap) -> Handles:
        """Return the handles of the selected points; none where too many are visible."""
        handles, facing = self._visible(pixel_map)
        return handles.of_arms(slice(facing, None))

    def facing(self, pixel_map: PixelMap) -> Handles:
        """Return the handles at the far ends of the segments beside the selected points."""
        handles, facing = self._visible(pixel_map)
        return handles.of_arms(slice(facing)).of_velocities()

    def _visible(self, pixel_map: PixelMap) -> tuple[Handles, int]:
        """Return all visible handles and the number of facing arms, which come first."""
        if self._visible_at[0] is not pixel_map:
            handles, facing = self._handles, self._facing_count
            if len(handles.indices) - facing > 2 * MOST_POINTS:
                is_near = _reach_into(handles, pixel_map)
                handles, facing = handles.of_arms(is_near), int(is_near[:facing].sum())
                if len(handles.indices) - facing > 2 * MOST_POINTS:
                    handles, facing = NO_HANDLES, 0
            self._visible_at = (pixel_map, handles, facing)
        return self._visible_at[1:]

    @property
    def _facing_count(self) -> int:
        indices = self._handles.indices
        if self._facing_counted[0] is not indices:
            # The arms stay the same during a drag.
            self._facing_counted = (indices, sum(index not in self._selection for index in indices.tolist()))
        return self._facing_counted[1]

    def note(self, pixel_map: PixelMap) -> str:
        """Return the note about hidden handles; empty where all are shown."""
        if len(self._handles.indices) <= 2 * MOST_POINTS or len(self._visible(pixel_map)[0]):
            return ""
        return TOO_MANY_HANDLES

    def paint(self, painter: QPainter, pixel_map: PixelMap, ink: PointInk, share: float = 1.0) -> None:
        """Draw the facing handles below the others; `share` scales the marks."""
        handles, facing = self._visible(pixel_map)
        if not len(handles):
            return
        lines: dict[tuple[Shade, int], list[QLineF]] = {}
        marks: list[Mark[HandleLook]] = []
        # As plain numbers: for a few, in every frame of a drag, NumPy would be slower.
        arms: list[Arm] = pixel_map.points(handles.arms).tolist()
        arms[:facing] = [arm[:2] for arm in arms[:facing]]
        for number, (arm, given) in enumerate(zip(arms, handles.explicit.tolist(), strict=True)):
            shade = Shade.FAINT if number < facing else Shade.STRONG
            sizes = mark_sizes(arm, ink.scale, share if shade is Shade.STRONG else share * _FAINT_SIZE)
            for order, ((x0, y0), (x, y)) in enumerate(pairwise(arm)):
                if abs(x0) + abs(y0) + abs(x) + abs(y) < _FAR:
                    lines.setdefault((shade, order), []).append(QLineF(x0, y0, x, y))
                    marks.append((HandleLook(order, _stepped(sizes[order]), given[order], shade), x, y))
        if ink.has_paper_beneath:
            # Paper below handles and their lines.
            painter.setPen(ink.beneath)
            painter.drawLines([line for segments in lines.values() for line in segments])
            ink.handles.draw(painter, [(look._replace(shade=Shade.PAPER), x, y) for look, x, y in marks])
        for pen_key, segments in lines.items():
            painter.setPen(ink.lines[pen_key])
            painter.drawLines(segments)
        ink.handles.draw(painter, marks)


def _stepped(size: float) -> float:
    """Return half the size of a mark, rounded to steps, because each size is a picture of its own."""
    return round(size * _STEPS) / _STEPS


def _bent(curve: Curve, sides: PointSides) -> PointSides:
    """Return the sides without a straight segment."""
    if not curve.family.derivatives:
        return sides
    arms = zip(sides.indices.tolist(), sides.ahead.tolist(), strict=True)
    is_bent = np.array([not is_straight_beside(curve, i, ahead=ahead) for i, ahead in arms], dtype=bool)
    return sides if is_bent.all() else PointSides(sides.indices[is_bent], sides.ahead[is_bent])


def _joined(first: PointSides, second: PointSides) -> PointSides:
    """Return the sides of both."""
    indices = np.concatenate([first.indices, second.indices])
    return PointSides(indices, np.concatenate([first.ahead, second.ahead]))


def _reach_into(handles: Handles, pixel_map: PixelMap) -> BoolArray:
    """Return which arms reach into the visible area."""
    pixels = pixel_map.points(handles.arms)
    low, high = pixels.min(axis=1), pixels.max(axis=1)
    result: BoolArray = ((high > 0) & (low < [pixel_map.width, pixel_map.height])).all(axis=1)
    return result
