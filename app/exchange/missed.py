"""Something in a file that does not come in as it stands there."""

from __future__ import annotations

import msgspec


class Missed(msgspec.Struct, frozen=True):
    """An element of a drawing that comes in otherwise than it is drawn, or not at all.

    Attributes
    ----------
    element
        What it is, as the file calls it: "<text>".
    name
        What its program or its author calls it; empty without.
    why
        What stands in the way, as the end of a sentence.
    instead
        What was done, as the end of a sentence.
    """

    element: str
    name: str
    why: str
    instead: str

    @property
    def sentence(self) -> str:
        """All of it in a line."""
        called = f" “{self.name}”" if self.name else ""
        return f"{self.element}{called}: {self.why}; {self.instead}."
