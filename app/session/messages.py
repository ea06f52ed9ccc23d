"""A sentence that the session has for the person."""

from __future__ import annotations

from enum import Enum, auto

import msgspec


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
