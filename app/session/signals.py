"""Signals of a session, told as a whole where they belong together, and sentences for the person."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, auto

import msgspec
from PySide6.QtCore import QObject, Signal


class Batch:
    """Whether a session is about to tell more of what it does.

    A step changes the document, what is selected and the history, and each has a signal of its own. Who shows
    all of them together, at every one of these, would show the same several times, and what never was in
    between: it waits for the end.
    """

    def __init__(self) -> None:
        self._depth = 0
        self._waiting: dict[Callable[[], object], None] = {}

    def __bool__(self) -> bool:
        return self._depth > 0

    def __enter__(self) -> None:
        self._depth += 1

    def __exit__(self, *_raised: object) -> None:
        self._depth -= 1
        while self._waiting and not self:
            show = next(iter(self._waiting))
            # First: what it shows may change something once more.
            del self._waiting[show]
            show()

    def then(self, show: Callable[[], object]) -> None:
        """Call `show` when all is told, once; right now, where nothing is being told."""
        if self:
            self._waiting[show] = None
        else:
            show()


class MessageKind(Enum):
    """Kind of a sentence."""

    INFORMATION = auto()
    """Something was done, or can be: for the status line."""
    REFUSAL = auto()
    """Something was not done, and why: for the status line, marked."""
    OFFER = auto()
    """An action that goes with what there is: it stays until the next step."""


class Message(msgspec.Struct, frozen=True):
    """A sentence for the person.

    Attributes
    ----------
    actions
        The names of the actions that are offered; none for any other kind.
    """

    kind: MessageKind
    text: str
    actions: tuple[str, ...] = ()


class SessionSignals(QObject):
    """What a session tells.

    Signals
    -------
    document_changed
        The document shown is another one: a preview, a change, undo, redo, open or new.
    active_changed
        Another curve is edited.
    selection_changed
        Another set of points is selected.
    selected_curves_changed
        Another set of curves is selected, to be worked on together.
    hovered_changed
        The pointer is over another point (its index, or -1), on the canvas or in the basis panel.
    scrub_changed
        The scrub line was moved to another t, or put away (None).
    pivot_changed
        Another pivot was chosen, or it has gone along with what it was chosen for.
    grips_changed
        The grips of the box around what is selected do something else.
    file_changed
        The path or the modified mark is another one.
    opened
        Another document was opened or begun, or undo or redo has gone back to another one.
    left
        A document without a file was left with this work in it; undo or redo goes back to it.
    saved
        The document was written to its file.
    history_changed
        There is another step to undo or redo.
    interrupted
        The document or the curve that is edited is being replaced (a step, undo, open): a gesture in flight
        is void, and what has been said about the old one is out of date.
    message
        A `Message` for the person.

    Attributes
    ----------
    telling
        Entered while several of these tell of one thing.
    """

    document_changed = Signal(object)
    active_changed = Signal(int)
    selection_changed = Signal(object)
    selected_curves_changed = Signal(object)
    hovered_changed = Signal(int)
    scrub_changed = Signal(object)
    pivot_changed = Signal()
    grips_changed = Signal()
    file_changed = Signal()
    opened = Signal()
    left = Signal(object)
    saved = Signal()
    history_changed = Signal()
    interrupted = Signal()
    message = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.batch = Batch()

    def say(self, text: str) -> None:
        """Show a sentence in the status line."""
        self.message.emit(Message(MessageKind.INFORMATION, text))

    def refuse(self, text: str) -> None:
        """Say that something was not done, and why: marked, so that it is not taken for a hint."""
        self.message.emit(Message(MessageKind.REFUSAL, text))

    def offer(self, text: str, *actions: str) -> None:
        """Show a sentence above the canvas, and beside it a button for each action of these names.

        Without a sentence, the one that was there goes: the action has done it.
        """
        self.message.emit(Message(MessageKind.OFFER, text, actions))
