"""Drag the pivot of the box around the selection; nothing in the document changes."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document import words
from ..document.model import Vector
from ..view_model.pivot import Pivot
from .marks import Marks
from .offsets import along_axis, axis_held, plus
from .pointer import AXIS_KEYS, SNAP_KEY, Cursor, Hint, Pointer
from .snapping import Snapper
from .tool import Gesture, ToolEvent

_REACH = 7.0
"""Pixels from the mark within which a press takes it."""

PIVOT_HINT = Hint(
    "Drag the pivot, about which the selection is rotated, scaled and mirrored · "
    "Shift+click: reset it to the middle",
    cursor=Cursor.MOVE,
)


def is_on_pivot(pivot: Vector, pointer: Pointer) -> bool:
    """Return whether a press would take the mark of a pivot."""
    return math.dist(pivot, pointer.position) * pointer.scale <= _REACH


def press_on_pivot(event: ToolEvent, on_click: Callable[[ToolEvent], object] | None) -> MovePivot:
    """Start to drag the pivot. A double click or Shift+click puts it back; `on_click` is any other click."""
    pointer = event.pointer

    def click(release: ToolEvent) -> None:
        if pointer.is_double or (pointer.shift and on_click is None):
            release.box.pivot = None
        if on_click is not None:
            on_click(release)

    return MovePivot(
        press=pointer.position,
        start=event.box.centre,
        before=event.session.box.pivot,
        snapper=event.snapping.for_pivot(event.box.bounds),
        on_click=click,
    )


class MovePivot(Gesture, kw_only=True):
    """Drag of the pivot. Ctrl or Shift keeps to one axis; it snaps to the nine positions of the box.

    Attributes
    ----------
    press, start
        The positions of the press and of the pivot then.
    before
        The pivot that was set before.
    """

    press: Vector
    start: Vector
    before: Pivot | None
    snapper: Snapper

    def move(self, event: ToolEvent) -> None:
        """Let the pivot follow the pointer."""
        pointer = event.pointer
        offset = pointer.offset_from(self.press)
        axis = axis_held(offset, pointer)
        event.box.pivot = self.snapper.snap(plus(self.start, along_axis(offset, axis)), pointer, axis)

    def cancel(self, event: ToolEvent) -> None:
        """Put the pivot where it was."""
        event.session.box.set_pivot(self.before)
        super().cancel(event)

    def status(self, event: ToolEvent) -> str:
        """Return the position of the pivot."""
        return f"Pivot {words.pair_text(event.box.centre)} · {AXIS_KEYS} · {SNAP_KEY} · Escape cancels"

    def marks(self, event: ToolEvent) -> Marks:
        """Return the frame, the pivot, and its snap."""
        return replace(super().marks(event), snap=event.snapping.caught)
