"""Copies of curves in a circle, a row, or rows and columns, each a step further than the one before."""

from __future__ import annotations

from collections.abc import Collection
from typing import Final, NamedTuple

from ...document.edits import EditError
from ...document.model import Document, Vector
from ...document.readings import Readings
from ...document.several_curves import add_copies, whole_curves
from .last_transform import Move, Turn

MOST_COPIES: Final = 500
"""Of one thing at once, the original among them."""


class Copies(NamedTuple):
    """How many there are, and how far each is from the one before.

    Attributes
    ----------
    columns, step
        How many there are in a circle or in a row, and what is between two of them.
    rows, row_step
        How many such rows there are, and what is between two of them.
    """

    columns: int
    step: Turn | Move
    rows: int = 1
    row_step: Move = Move((0.0, 0.0))

    @property
    def total(self) -> int:
        """How many there are in all, the original among them."""
        return self.columns * self.rows

    def words(self, readings: Readings) -> str:
        """Return what a step of the history says: "5 of {}, each by 72°", "4 × 3 of {}, each by 20, 30"."""
        step, count = self.step, str(self.columns)
        if self.rows > 1 and isinstance(step, Move):
            step, count = Move((step.by[0], self.row_step.by[1])), f"{self.columns} × {self.rows}"
        _, _, apart = step.words(readings).partition(" by ")
        return f"{count} of {{}}, each by {apart}"

    def placed(self, document: Document, curves: Collection[int], about: Vector, number: int) -> Document:
        """Return the document with one of the copies, counted along the rows, where it belongs."""
        row, column = divmod(number, self.columns)
        document = self.step.done(document, whole_curves(document, curves), about, column)
        return self.row_step.done(document, whole_curves(document, curves), about, row) if row else document


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
        document = copies.placed(document, places, about, number)
    return Copied(document, frozenset(at[id(curve)] for curve in originals).union(*sets))
