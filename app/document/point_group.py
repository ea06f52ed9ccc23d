"""Points that change together: some of one or several curves, or all of whole curves."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable

import msgspec
from msgspec.structs import replace

from .curve_edits import locked_message
from .limits import EditError
from .model import Document
from .words import count_of, points_label

PointsEdit = Callable[[Document, int, Collection[int]], Document]
"""An edit of some points of one curve."""


class PointGroup(msgspec.Struct, frozen=True):
    """Points that change together: some of one or several curves, or all of whole curves.

    Attributes
    ----------
    parts
        The curves, in order, each with the indices of its points.
    is_whole
        Whether whole curves are meant.
    name
        The name of the curve, shape or group where it is a single one, whole.
    several_label
        The words for several whole ones, such as "1 group and 2 curves"; empty for "3 curves".
    remark
        What was meant, too, but cannot be changed: "1 locked curve stays"; empty for nothing.
    """

    parts: tuple[tuple[int, frozenset[int]], ...] = ()
    is_whole: bool = False
    name: str | None = None
    several_label: str = ""
    remark: str = ""

    @property
    def label(self) -> str:
        """The words "point 3", "4 points", "5 points in 2 curves", "Leaf", or "3 curves"."""
        if self.name is not None:
            return self.name or "curve"
        if self.is_whole:
            return self.several_label or f"{len(self.parts)} curves"
        return points_label(self.parts[0][1]) if len(self.parts) == 1 else self.count_label

    @property
    def count_label(self) -> str:
        """The words "1 point", "4 points" or "5 points in 2 curves"."""
        count = count_of(self.count, "point")
        return f"{count} in {len(self.parts)} curves" if len(self.parts) > 1 else count

    @property
    def quoted_label(self) -> str:
        """The same words within a sentence: a name in quotation marks."""
        return f"“{self.name}”" if self.name else self.label

    @property
    def count(self) -> int:
        """How many points there are."""
        return sum(len(indices) for _, indices in self.parts)

    @property
    def only_point(self) -> tuple[int, int] | None:
        """The curve and the point where it is a single one."""
        if self.is_whole or self.count != 1:
            return None
        return next((curve, next(iter(indices))) for curve, indices in self.parts if indices)

    @property
    def curves(self) -> frozenset[int]:
        """The curves that it is of."""
        return frozenset(curve for curve, _ in self.parts)

    def of(self, curve: int) -> frozenset[int]:
        """Return the indices of its points of one curve."""
        return next((indices for place, indices in self.parts if place == curve), frozenset())

    def joined(self, other: PointGroup) -> PointGroup:
        """Return the points of either group."""
        return group_points((curve, self.of(curve) | other.of(curve)) for curve in self.curves | other.curves)

    def toggled(self, other: PointGroup) -> PointGroup:
        """Return the points of one group that are not in the other."""
        return group_points((curve, self.of(curve) ^ other.of(curve)) for curve in self.curves | other.curves)

    def apply(self, document: Document, edit: PointsEdit) -> Document:
        """Return `document` with `edit` done to all of it; locked curves refuse, named together."""
        self.refuse_locked(document)
        for curve, indices in self.parts:
            document = edit(document, curve, indices)
        return document

    def apply_to_each(self, document: Document, edit: PointsEdit) -> Document:
        """Return `document` with `edit` done to all of it, which finds each curve alone in its document.

        To replace one of thousands takes long, and to do so thousands of times seconds.
        """
        self.refuse_locked(document)
        curves = list(document.curves)
        for curve, indices in self.parts:
            (curves[curve],) = edit(replace(document, curves=(curves[curve],)), 0, indices).curves
        return replace(document, curves=tuple(curves))

    def refuse_locked(self, document: Document) -> None:
        """Raise EditError if curves that it is of are locked."""
        names = [
            document.curves[curve].display_name for curve, _ in self.parts if document.curves[curve].locked
        ]
        if names:
            raise EditError(locked_message(names))


NO_POINTS = PointGroup()


def points_of(curve: int, indices: Collection[int]) -> PointGroup:
    """Return some points of one curve."""
    return PointGroup(((curve, frozenset(indices)),))


def group_points(parts: Iterable[tuple[int, frozenset[int]]]) -> PointGroup:
    """Return points of several curves, as far as there are any; a curve may be there more than once."""
    found: dict[int, frozenset[int]] = {}
    for curve, indices in parts:
        if indices:
            found[curve] = found[curve] | indices if curve in found else indices
    return PointGroup(tuple(sorted(found.items())))
