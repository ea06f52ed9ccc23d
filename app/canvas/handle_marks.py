"""Handles of the selected points and those that face them: lines and marks, as large as can be told apart."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF
from PySide6.QtGui import QPainter

from curvecore.arrays import BoolArray

from ..document.constraints import line_beside
from ..document.model import Curve
from ..plotting.pixel_map import PixelMap
from ..plotting.stamps import Mark
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.handles import NO_HANDLES, Handles, PointSides, handles_on, sides_at, sides_facing
from .point_marks import HANDLE_SIZES, HandleLook, PointInk, Shade

MOST_POINTS = 100
"""Points up to which handles are shown: those of more hide the curve, and each other."""

LEFT_AWAY = f"Handles of up to {MOST_POINTS} selected points are shown · zoom in to see them"

_LEAST = 2.0
_SHARE = 0.42
"""Part of the way to the next mark that half a mark takes at most: a gap is left between the two."""

_FAINT_SIZE = 0.8
"""Size of the fainter marks, as a share of the others'."""

_STEPS = 4
"""Steps within a pixel in which marks grow."""

_FAR = 1e5
"""Pixels beyond which Qt draws nothing."""


Arm = list[list[float]]
"""The pixels of a point and of the handles on one side of it, each [x, y]."""


def mark_sizes(arm: Arm, scale: float, share: float = 1.0) -> list[float]:
    """Return half the sizes of the marks of an arm, in pixels; `share` is that of what they usually are.

    On short segments the handles of a point lie within a few pixels of each other: the mark of each is small
    enough then to be seen beside the one that it hangs on, and the one that hangs on it.
    """
    rooms = [*map(math.dist, arm, arm[1:])]
    rooms = [*map(min, rooms, rooms[1:]), rooms[-1]]
    least = _LEAST * scale
    return [
        min(max(largest * share * scale, least), max(_SHARE * room, least))
        for largest, room in zip(HANDLE_SIZES, rooms, strict=False)
    ]


class ShownHandles:
    """The handles that are shown, and their picture.

    Of a single selected point all handles are shown, of several those of the velocities. So are, fainter,
    the velocity handles at the far ends of the segments beside them, which shape the same segments; not
    while points are added, when a press beside the curve means a point. Straight segments are bent by those
    of a single point: more would only lie on them.
    """

    def __init__(self) -> None:
        # The facing ones come first: they lie below the others.
        self._handles = NO_HANDLES
        self._view: CurveView | None = None
        # Which sides of points have them, and what that follows from: it stays under a drag.
        self._sides: PointSides = sides_at(())
        self._sides_of: tuple[object, ...] = ()
        self._selection: frozenset[int] = frozenset()
        self._counted: tuple[object, int] = (None, 0)
        self._in_sight: tuple[PixelMap | None, Handles, int] = (None, NO_HANDLES, 0)

    def find(self, view: CurveView, selection: frozenset[int], *, free: bool) -> None:
        """Find the handles; `free`, while points are added: at an end one point has them on both sides."""
        count, is_closed = len(view.source.points), view.source.is_closed
        # Points without derivatives have none, and their sides are not looked for.
        may_have = selection if view.source.family.derivatives else frozenset[int]()
        sides_of = (may_have, count, is_closed, free)
        if view is self._view and sides_of == self._sides_of:
            return
        is_one = len(selection) == 1
        # A line stays one while points are dragged.
        if sides_of != self._sides_of or not view.is_followed:
            indices = [index for index in may_have if index < count]
            sides, facing = sides_at(indices), sides_facing(() if free else indices, count, closed=is_closed)
            self._sides = _joined(_bent(view.source, facing), sides if is_one else _bent(view.source, sides))
        self._view, self._sides_of, self._selection = view, sides_of, selection
        self._in_sight = (None, NO_HANDLES, 0)
        handles = handles_on(view, self._sides, free=free and is_one)
        self._handles = handles if is_one else handles.of_velocities()

    def of_selected(self, pixel_map: PixelMap) -> Handles:
        """Return the handles of the selected points; none where too many are in sight."""
        handles, facing = self._seen(pixel_map)
        return handles.of_arms(slice(facing, None))

    def facing(self, pixel_map: PixelMap) -> Handles:
        """Return the handles that face the selected points from beyond the segments beside them."""
        handles, facing = self._seen(pixel_map)
        return handles.of_arms(slice(facing)).of_velocities()

    def _seen(self, pixel_map: PixelMap) -> tuple[Handles, int]:
        """Return all handles in sight, and how many of the arms are facing ones: these come first."""
        if self._in_sight[0] is not pixel_map:
            handles, facing = self._handles, self._facing_count
            if len(handles.indices) - facing > 2 * MOST_POINTS:
                near = _near(handles, pixel_map)
                handles, facing = handles.of_arms(near), int(near[:facing].sum())
                if len(handles.indices) - facing > 2 * MOST_POINTS:
                    handles, facing = NO_HANDLES, 0
            self._in_sight = (pixel_map, handles, facing)
        return self._in_sight[1:]

    @property
    def _facing_count(self) -> int:
        indices = self._handles.indices
        if self._counted[0] is not indices:
            # The arms stay under a drag.
            self._counted = (indices, sum(index not in self._selection for index in indices.tolist()))
        return self._counted[1]

    def note(self, pixel_map: PixelMap) -> str:
        """Return the sentence about handles that are left away; empty where all are shown."""
        if len(self._handles.indices) <= 2 * MOST_POINTS or len(self._seen(pixel_map)[0]):
            return ""
        return LEFT_AWAY

    def paint(self, painter: QPainter, pixel_map: PixelMap, ink: PointInk, share: float = 1.0) -> None:
        """Draw them: the fainter ones below the others, their marks a share of their usual size."""
        handles, facing = self._seen(pixel_map)
        if not len(handles):
            return
        lines: dict[tuple[Shade, int], list[QLineF]] = {}
        marks: list[Mark[HandleLook]] = []
        # As plain numbers: there are few, and in every frame of a drag each step through NumPy counts.
        arms: list[Arm] = pixel_map.points(handles.places).tolist()
        arms[:facing] = [arm[:2] for arm in arms[:facing]]
        for number, (arm, given) in enumerate(zip(arms, handles.explicit.tolist(), strict=True)):
            shade = Shade.FAINT if number < facing else Shade.STRONG
            sizes = mark_sizes(arm, ink.scale, share if shade is Shade.STRONG else share * _FAINT_SIZE)
            for order, ((x0, y0), (x, y)) in enumerate(pairwise(arm)):
                if abs(x0) + abs(y0) + abs(x) + abs(y) < _FAR:
                    lines.setdefault((shade, order), []).append(QLineF(x0, y0, x, y))
                    marks.append((HandleLook(order, _stepped(sizes[order]), given[order], shade), x, y))
        if ink.has_paper_beneath:
            # Paper under handles and their lines.
            painter.setPen(ink.beneath)
            painter.drawLines([line for alike in lines.values() for line in alike])
            ink.handles.draw(painter, [(look._replace(shade=Shade.PAPER), x, y) for look, x, y in marks])
        for drawn_with, alike in lines.items():
            painter.setPen(ink.lines[drawn_with])
            painter.drawLines(alike)
        ink.handles.draw(painter, marks)


def _stepped(size: float) -> float:
    """Return half the size of a mark in steps: each size is a picture."""
    return round(size * _STEPS) / _STEPS


def _bent(curve: Curve, sides: PointSides) -> PointSides:
    """Return the sides on which there is no straight segment."""
    if not curve.family.derivatives:
        return sides
    arms = zip(sides.indices.tolist(), sides.ahead.tolist(), strict=True)
    is_bent = np.array([not line_beside(curve, index, ahead=ahead) for index, ahead in arms], dtype=bool)
    return sides if is_bent.all() else PointSides(sides.indices[is_bent], sides.ahead[is_bent])


def _joined(first: PointSides, second: PointSides) -> PointSides:
    """Return all sides of the two."""
    return PointSides(
        np.concatenate([first.indices, second.indices]), np.concatenate([first.ahead, second.ahead])
    )


def _near(handles: Handles, pixel_map: PixelMap) -> BoolArray:
    """Tell which arms reach into the area."""
    pixels = pixel_map.points(handles.places)
    low, high = pixels.min(axis=1), pixels.max(axis=1)
    which: BoolArray = ((high > 0) & (low < [pixel_map.width, pixel_map.height])).all(axis=1)
    return which
