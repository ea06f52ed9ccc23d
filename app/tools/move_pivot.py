"""The mark of the pivot: dragged somewhere else, it snaps; a double click puts it back."""

from __future__ import annotations

import math
from collections.abc import Callable

from ..document import words
from ..document.model import Vector
from .drag import along_axis, axis_held, plus
from .drag_machine import CANCELLED, THRESHOLD
from .pointer import AXIS_KEYS, SNAP_KEY, Cursor, Hint, Pointer
from .snapping import with_snap
from .tool import Gesture, ToolContext

_REACH = 7.0
"""Pixels from the mark within which a press takes it."""

PIVOT_HINT = Hint(
    "Drag the pivot: what is turned, scaled and mirrored is so about it · Shift+click: back to the middle",
    cursor=Cursor.MOVE,
)


def is_on_pivot(place: Vector, pointer: Pointer) -> bool:
    """Whether a press would take the mark of a pivot at `place`."""
    return math.dist(place, pointer.position) * pointer.scale <= _REACH


class MovePivot(Gesture):
    """Drag of the pivot; it changes nothing in the document. A double click or Shift+click puts it back.

    Parameters
    ----------
    on_click
        What a click does; None for nothing.
    """

    def __init__(self, context: ToolContext, on_click: Callable[[], None] | None = None) -> None:
        self._on_click = on_click
        self._press, self._start = context.pointer, context.target.centre
        self._before = context.host.box.pivot
        self._snapper = context.snappers.for_pivot(context.target.bounds)
        self._is_moving = False
        if context.pointer.is_double:
            context.target.pivot = None

    def move(self, context: ToolContext) -> None:
        """Follow the pointer."""
        pointer = context.pointer
        self._is_moving |= math.dist(pointer.pixel, self._press.pixel) >= THRESHOLD
        if self._is_moving:
            way = pointer.way_from(self._press.position)
            axis = axis_held(way, pointer)
            to = plus(self._start, along_axis(way, axis))
            context.target.pivot = self._snapper.snap(to, pointer, axis)

    def release(self, context: ToolContext) -> None:
        """Leave it here, or click."""
        self.move(context)
        if not self._is_moving and self._on_click is not None:
            self._on_click()
        elif not self._is_moving and self._press.shift:
            context.target.pivot = None

    def cancel(self, context: ToolContext) -> None:
        """Put it where it was."""
        context.host.box.set_pivot(self._before)
        if self._is_moving:
            context.host.say(CANCELLED)

    def progress(self, context: ToolContext) -> str:
        """Tell where it is."""
        if not self._is_moving:
            return ""
        place = words.pair(context.target.centre)
        text = f"Pivot {place} · {AXIS_KEYS} · {SNAP_KEY} · Escape cancels"
        return with_snap(text, self._snapper.caught)
