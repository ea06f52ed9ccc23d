"""Place of a file among several that are asked about; light, for the window's start."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Turn:
    """Place of a file among several that are asked about.

    Attributes
    ----------
    place, count
        Its place, from 1 on, and how many there are.
    """

    place: int = 1
    count: int = 1

    @property
    def waiting(self) -> int:
        """How many files come after it."""
        return self.count - self.place
