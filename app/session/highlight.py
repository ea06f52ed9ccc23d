"""The highlight: some points of the curve that is edited, or whole curves."""

from __future__ import annotations

import msgspec

from ..document.edits import delete_points
from ..document.model import Document
from ..document.several_curves import name_of, named, remove_curves
from ..document.words import count_of, points


class Highlight(msgspec.Struct, frozen=True):
    """Points or curves that Copy, Cut, Duplicate and Delete act on.

    Attributes
    ----------
    curves
        The curves, whole; the one of the points where there are points.
    points
        Indices of points of that one; empty where whole curves are meant.
    """

    curves: frozenset[int]
    points: frozenset[int] = frozenset()

    def curves_of(self, document: Document) -> frozenset[int]:
        """Return the curves that are meant as a whole: also one of which all points are.

        The points of the only curve are not: without them the document is empty, and of the same family.
        """
        if not self.points:
            return self.curves
        (curve,) = self.curves
        is_whole = len(self.points) == len(document.curves[curve].points)
        return self.curves if is_whole and len(document.curves) > 1 else frozenset()

    def words(self, document: Document) -> str:
        """Return the words "point 3" or "4 points", the name of the curve, or "2 curves"."""
        whole = self.curves_of(document)
        return named(document, whole) if whole else points(self.points)

    def said(self, document: Document) -> str:
        """Return what it is within a sentence: "3 points", the name in quotation marks, or "2 curves"."""
        if self.points:
            return count_of(len(self.points), "point")
        name = name_of(document, self.curves)
        return named(document, self.curves) if name is None else f"“{name}”"

    def removed_from(self, document: Document) -> Document:
        """Return the document without it."""
        if whole := self.curves_of(document):
            return remove_curves(document, whole)
        (curve,) = self.curves
        return delete_points(document, curve, self.points)
