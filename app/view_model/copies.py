"""Copies of curves in a circle or in a row, each a step further than the one before."""

from __future__ import annotations

from collections.abc import Collection
from typing import Final, NamedTuple

from ..document.edits import EditError
from ..document.model import Document, Vector
from ..document.several_curves import add_copies, whole_curves
from .last_transform import Move, Turn

MOST_COPIES: Final = 500
"""Of one thing at once, the original among them."""


class Copies(NamedTuple):
    """How many there are in all, and how far each is from the one before."""

    total: int
    step: Turn | Move

    @property
    def words(self) -> str:
        """What a step of the history says: "5 of {}, each by 72°"."""
        _, _, apart = self.step.words.partition(" by ")
        return f"{self.total} of {{}}, each by {apart}"


class Copied(NamedTuple):
    """A document with copies, and the places of these and of their originals."""

    document: Document
    places: frozenset[int]


def copied(document: Document, curves: Collection[int], copies: Copies, about: Vector) -> Copied:
    """Return the document with copies of some curves, the first in front of the originals, then the second.

    Raises
    ------
    EditError
        If there are fewer than two in all, or too many.
    """
    if not 2 <= copies.total <= MOST_COPIES:
        raise EditError(f"There are 2 to {MOST_COPIES} in all, the original among them.")
    originals, last, made = [document.curves[place] for place in curves], tuple(sorted(curves)), []
    for _ in range(copies.total - 1):
        document, last = add_copies(document, last)
        made.append([document.curves[place] for place in last])
    # Where each set is now that all are there.
    at = {id(curve): place for place, curve in enumerate(document.curves)}
    sets = [[at[id(curve)] for curve in curves] for curves in made]
    for number, places in enumerate(sets, start=1):
        document = copies.step.done(document, whole_curves(document, places), about, number)
    return Copied(document, frozenset(at[id(curve)] for curve in originals).union(*sets))
