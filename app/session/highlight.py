"""The highlight: some points of the curves that are edited, or whole curves."""

from __future__ import annotations

import msgspec

from ..document.model import Document
from ..document.point_group import NO_POINTS, PointGroup, PointsEdit
from ..document.several_curves import (
    common_name,
    locked_remark,
    name_or_count,
    remove_curves,
    unlocked_curves,
)


class ClipboardSelection(msgspec.Struct, frozen=True):
    """Points or curves that Copy, Cut, Duplicate and Delete act on.

    Attributes
    ----------
    curves
        The curves, whole; those of the points where there are points.
    points
        The points; none where whole curves are meant.
    stays
        What was meant, too, but cannot be changed: "1 locked curve stays"; empty for nothing.
    """

    curves: frozenset[int]
    points: PointGroup = NO_POINTS
    stays: str = ""

    def changeable(self, document: Document) -> ClipboardSelection:
        """Return it without the curves that are locked, unless all are; points stay as they are."""
        if self.points.parts:
            return self
        return ClipboardSelection(
            unlocked_curves(document, self.curves), stays=locked_remark(document, self.curves)
        )

    def curves_of(self, document: Document) -> frozenset[int]:
        """Return the curves that are meant as a whole: also those of which all points are.

        The points of the only curve are not: without them the document is empty, and of the same family.
        """
        if not self.points.parts:
            return self.curves
        if len(document.curves) == 1:
            return frozenset()
        return frozenset(
            curve
            for curve, indices in self.points.parts
            if len(indices) == len(document.curves[curve].points)
        )

    def words(self, document: Document) -> str:
        """Return the words "point 3" or "4 points", the name of the curve, or "2 curves"."""
        is_whole = self.curves_of(document) == self.curves
        return name_or_count(document, self.curves) if is_whole else self.points.label

    def said(self, document: Document) -> str:
        """Return what it is within a sentence: "3 points", the name in quotation marks, or "2 curves"."""
        if self.points.parts:
            return self.points.count_label
        name = common_name(document, self.curves)
        return name_or_count(document, self.curves) if name is None else f"“{name}”"

    def told(self, document: Document) -> str:
        """Return the same, and what of it stays: "2 curves; 1 locked curve stays"."""
        return "; ".join(filter(None, (self.said(document), self.stays)))

    def removed_from(self, document: Document, delete: PointsEdit) -> Document:
        """Return the document without it; `delete` deletes points of one curve."""
        whole = self.curves_of(document)
        for curve, indices in self.points.parts:
            if curve not in whole:
                document = delete(document, curve, indices)
        return remove_curves(document, whole)
