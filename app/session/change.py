"""Result of a change of the document, the reasons to refuse one, and messages to the person."""

from __future__ import annotations

import traceback
from enum import Enum, auto

import msgspec

from ..document.curve_edits import refuse_locked
from ..document.field_paths import with_path_in_words
from ..document.limits import EditError
from ..document.model import Document
from ..storage.format_error import FormatError
from ..storage.validation import validate_changes


class Change(msgspec.Struct, frozen=True):
    """Result of a change of the document; true where it is a step of the history now.

    Attributes
    ----------
    is_done
        Whether the document is another one.
    refusal
        Why it is not, as the status line has it; empty where the change was none.
    """

    is_done: bool
    refusal: str = ""

    def __bool__(self) -> bool:
        return self.is_done


def raiser_of(reason: EditError) -> str:
    """Return the function that refused an edit."""
    *_, (frame, _line) = traceback.walk_tb(reason.__traceback__)
    return frame.f_code.co_qualname


def why_locked(before: Document, after: Document) -> str:
    """Return the sentence about a locked curve of `before` that is changed in `after`; empty for none."""
    try:
        refuse_locked(before, after)
    except EditError as reason:
        return str(reason)
    return ""


def why_unsavable(before: Document, after: Document) -> str:
    """Return why no file may hold the values that are new in `after`; empty where one may."""
    try:
        validate_changes(before, after)
    except FormatError as reason:
        return f"This cannot be saved: {with_path_in_words(after, str(reason))}."
    return ""


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
