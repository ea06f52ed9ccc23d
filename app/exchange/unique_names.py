"""Names made different from each other: a number is put to those that are taken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Protocol


class NameContainer(Protocol):
    """Collection of names in use."""

    def __contains__(self, name: str, /) -> bool:
        """Return whether a name is in use."""


class UniqueNames:
    """Source of names, each given once; the next number for a base is remembered, not searched.

    Parameters
    ----------
    used
        Names that others use.
    between
        Between a name and its number.
    """

    def __init__(self, used: NameContainer = (), between: str = " ") -> None:
        self._used, self._between = used, between
        self._given: set[str] = set()
        self._next: dict[str, int] = {}

    def unique(self, base: str) -> str:
        """Return the base, or the base with the least number from 2 on that makes a new name."""
        name, number = base, self._next.get(base, 2)
        while name in self._given or name in self._used:
            name, number = f"{base}{self._between}{number}", number + 1
        self._given.add(name)
        self._next[base] = number
        return name


def numbered(names: Sequence[str]) -> list[str]:
    """Return names with numbers where they repeat: "A (1)", "A (2)"."""
    counts, occurrences, result = Counter(names), Counter[str](), []
    for name in names:
        occurrences[name] += 1
        result.append(f"{name} ({occurrences[name]})" if counts[name] > 1 else name)
    return result
