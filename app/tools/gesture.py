"""What happens from a press to the release: the base classes of the gestures and of the drags."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

import msgspec
from msgspec.structs import replace

from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.selection import SelectionState
from .marks import Marks
from .pointer import Pointer

if TYPE_CHECKING:
    from .tool import ToolEvent

THRESHOLD = 3.0
"""Pixels the pointer must travel before a press becomes a drag."""

CANCELLED = "Cancelled."
"""Message after Escape has ended a gesture."""


class Gesture(msgspec.Struct, kw_only=True):
    """What happens from a press to the release. Escape calls `cancel`; three pixels make a drag of a click.

    Attributes
    ----------
    starts_at_press
        Whether it moves from the press on, and is never a click: the pen, whose effect is seen at once.
    scrolls_view
        Whether the view moves on where the pointer comes to the edge.
    on_click
        What a click does; None for nothing.
    pressed_at, has_moved
        Pixel of the press; whether the pointer has travelled far enough for a drag. The toolbox sets them.
    """

    starts_at_press: ClassVar[bool] = False
    scrolls_view: ClassVar[bool] = True
    on_click: Callable[[ToolEvent], object] | None = None
    pressed_at: Vector = (0.0, 0.0)
    has_moved: bool = False

    def click(self, event: ToolEvent) -> None:
        """End where the press was: it is a click."""
        if self.on_click is not None:
            self.on_click(event)

    def move(self, event: ToolEvent) -> None:
        """Follow the pointer."""

    def release(self, event: ToolEvent) -> None:
        """End; the last move has been made."""

    def cancel(self, event: ToolEvent) -> None:
        """Restore what was there before the press."""
        event.session.say(CANCELLED)

    def wants_key(self, key: str) -> bool:
        """Return whether a key is for the gesture that would be a shortcut otherwise; "enter" releases."""
        return False

    def key(self, event: ToolEvent, key: str) -> bool:
        """Take a key: a typed digit, an axis. Return whether it had an effect; a move follows then."""
        return False

    def status(self, pointer: Pointer) -> str:
        """Return the sentence for the status line, asked at most every 33 ms."""
        return ""

    def marks(self, event: ToolEvent) -> Marks:
        """Return what is drawn over the plot: by default the frame around the selection."""
        return event.frame_marks()

    def position_at(self, pointer: Pointer) -> Vector | None:
        """Return the position of the point that is dragged, for the coordinates in the status line."""
        return None


class Drag(Gesture, kw_only=True):
    """A gesture that changes the document: previewed at each move, one undo step at the release.

    Attributes
    ----------
    document
        The document at the press; every move computes another one from it, never from the last move.
    selects
        Selection from the first preview on; cancelling and undo restore the one before.
    refusal
        Why the last move changed nothing; empty where it did.
    keys, remark
        Effects of the modifier keys; what of the selection is locked and stays.
    """

    document: Document
    selects: SelectionState | None = None
    refusal: str = ""

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, for the status line."""
        return ""

    @property
    def remark(self) -> str:
        """What of the selection stays as it is, for the status line; empty for nothing."""
        return ""

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the pointer there; pure. An EditError keeps the last good one."""
        raise NotImplementedError

    def undo_text(self, pointer: Pointer) -> str:
        """Return the name of the step in the history, such as "Move point 2"."""
        raise NotImplementedError

    def amount(self, pointer: Pointer) -> str:
        """Return how far the drag has come, such as "Rotate 30°"; empty where nothing is to be said."""
        return ""

    def move(self, event: ToolEvent) -> None:
        """Preview the document at the pointer, or say why it cannot be."""
        try:
            document = self.document_at(event.pointer)
        except EditError as reason:
            self.refusal = str(reason)
            event.session.refuse(self.refusal)
            return
        self.refusal = ""
        event.session.preview(document, selects=self.selects)

    def release(self, event: ToolEvent) -> None:
        """Make what is previewed a step of the history."""
        session = event.session
        if session.commit(session.document, self.undo_text(event.pointer)):
            self.committed(event)

    def committed(self, event: ToolEvent) -> None:
        """Say what stays as it is, after the step has been made."""
        if self.remark:
            event.session.say(f"{self.remark}.")

    def cancel(self, event: ToolEvent) -> None:
        """Restore the document and the selection."""
        event.session.cancel()
        super().cancel(event)

    def status(self, pointer: Pointer) -> str:
        """Return the amount, what stays, and the keys; or why nothing changes."""
        amount = self.amount(pointer)
        if self.refusal or not amount:
            return self.refusal
        return " · ".join(filter(None, (amount, self.remark, self.keys, "Escape cancels")))

    def marks(self, event: ToolEvent) -> Marks:
        """Return the frame around the selection, and what the drag has snapped to."""
        return replace(super().marks(event), snap=event.snapping.caught)


class Refusal(Gesture, kw_only=True):
    """Drag of what cannot be changed: it says why; a click is a click."""

    reason: str

    def move(self, event: ToolEvent) -> None:
        """Say why nothing moves."""
        event.session.refuse(self.reason)

    def status(self, pointer: Pointer) -> str:
        """Return the reason."""
        return self.reason
