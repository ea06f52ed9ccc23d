"""What of a file is there to be referred to: the base of gradients, clips and the like."""

from __future__ import annotations

from ..naming import Names


class DefinedElements:
    """Definitions of one kind in one file.

    Attributes
    ----------
    lines
        Those that were asked for so far.
    """

    def __init__(self, ids: Names) -> None:
        self._ids = ids
        self.lines: list[str] = []

    def taken(self) -> list[str]:
        """Return those that were asked for since it was asked last."""
        lines, self.lines = self.lines, []
        return lines
