"""Result of a change of the document, the reasons to refuse one, and messages to the person."""

from __future__ import annotations

import re
import traceback
from enum import Enum, auto

import msgspec

from ..document.curve_edits import refuse_locked
from ..document.fields import Value, fields_of
from ..document.limits import EditError
from ..document.model import Curve, Document
from ..document.style import Style
from ..storage.format_error import FormatError
from ..storage.validation import validate_changes

_PATH = re.compile(r"[a-z_]+(\[\d+\])?(\.[a-z_]+(\[\d+\])?)*")
_FIELD = re.compile(r"([a-z_]+)(?:\[(\d+)\])?")


class Change(msgspec.Struct, frozen=True):
    """Result of a change of the document; true where it is a step of the history now.

    So a command can go on from it: ``if session.change(text, edit): session.say("Curve closed.")``.

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


def with_path_in_words(document: Document, sentence: str) -> str:
    """Return a sentence that begins with a path of a field with “the x of point 3 of …” in place of the path.

    Other sentences are returned unchanged.
    """
    path = _PATH.match(sentence)
    words = _words(document, path[0]) if path is not None else ""
    return f"{words}{sentence[path.end() :]}" if path is not None and words else sentence


def _words(document: Document, path: str) -> str:
    value: object = document
    parts: list[str] = []
    for name, index in _FIELD.findall(path):
        fields = fields_of(type(value)) if isinstance(value, Value) else ()
        field = next((entry for entry in fields if entry.name == name), None)
        if field is None:
            return ""
        value = getattr(value, name)
        label = field.label.replace("_", " ")
        label = f"{label[0].lower()}{label[1:]}"
        if field.is_many and index and isinstance(value, tuple):
            value = value[int(index)]
            label = f"{label.removesuffix('s')} {index}"
        parts.append(_name_of(value, label))
    *holders, last = filter(None, parts)
    return " of ".join([f"the {last}", *reversed(holders)])


def _name_of(value: object, label: str) -> str:
    """Return the name of one part of the path; empty for a style, whose fields have full names."""
    if isinstance(value, Curve):
        return f"“{value.name}”"
    if isinstance(value, Style):
        return ""
    is_one = isinstance(value, Value) and not label[-1].isdigit()
    return f"the {label}" if is_one else label


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
    is_hint
        Whether it is about the next press, and goes with the tool in use.
    """

    kind: MessageKind
    text: str
    actions: tuple[str, ...] = ()
    is_hint: bool = False
