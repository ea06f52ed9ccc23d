"""Something in a file that does not come in as it stands there."""

from __future__ import annotations

import msgspec

LEFT_OUT = "left out"
"""What was done of which nothing came in."""


def named_by_place(tag: str, number: int) -> str:
    """Return what a shape without a name is called, by its place in the file."""
    return f"{tag.capitalize()} {number}"


class Flaw(msgspec.Struct, frozen=True):
    """What is not taken over as it is.

    Attributes
    ----------
    why
        What stands in the way, as the end of a sentence.
    instead
        What is done, likewise.
    """

    why: str
    instead: str


class Missed(msgspec.Struct, frozen=True):
    """An element of a drawing that comes in otherwise than it is drawn, or not at all.

    Attributes
    ----------
    element
        What it is, as the file calls it: "<text>".
    name
        What its program or its author calls it; empty without.
    number
        The how manieth element of the file it is, from 1.
    why
        What stands in the way, as the end of a sentence.
    instead
        What was done, as the end of a sentence.
    """

    element: str
    name: str
    number: int
    why: str
    instead: str

    @property
    def sentence(self) -> str:
        """All of it in a line."""
        return f"{self.element} {self.called}: {self.why}; {self.instead}."

    @property
    def called(self) -> str:
        """Words to find it by: its name, or its place."""
        return f"“{self.name}”" if self.name else f"(element {self.number})"
