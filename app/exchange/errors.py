"""The error of import and export, and the record of content that an import loses or changes."""

from __future__ import annotations

from collections.abc import Hashable
from typing import NamedTuple

from ..document.words import count_of, names_of

LEFT_OUT = "left out"


class ExchangeError(ValueError):
    """Error of an export or an import; the message says why."""


class Loss(NamedTuple):
    """Kind of content that an import loses or changes.

    Attributes
    ----------
    noun
        One of them.
    outcome
        The outcome, after the noun of one or of several: "left out", "imported as one colour".
    """

    noun: str
    outcome: str = LEFT_OUT


class Losses:
    """Record of the content that an import loses or changes, each kind in order of its first occurrence."""

    def __init__(self) -> None:
        self._names: dict[Loss, dict[Hashable, str]] = {}

    def note(self, loss: Loss, key: Hashable, name: str = "") -> None:
        """Count an object, identified by a key, once for each loss; its name may be empty."""
        self._names.setdefault(loss, {})[key] = name

    @property
    def sentences(self) -> tuple[str, ...]:
        """One sentence for each kind of loss: its count, its outcome, and the first names."""
        return tuple(_sentence(loss, list(names.values())) for loss, names in self._names.items())


def _sentence(loss: Loss, names: list[str]) -> str:
    named = [name for name in names if name]
    which = f": {names_of(named)}" if named else ""
    return f"{count_of(len(names), loss.noun)} {loss.outcome}{which}."
