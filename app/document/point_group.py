"""Group of points that change together: points of one or several curves, or whole curves."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence

import msgspec
from msgspec.structs import replace

from .curve_edits import locked_message
from .limits import EditError
from .model import Curve, Document, Vector
from .point_edits import explicit_points
from .words import capitalized, count_of, enumerated, points_label

_MOST_NAMED = 8
"""Largest number of points that a sentence names one by one."""

PointsEdit = Callable[[Document, int, Collection[int]], Document]
"""Edit of some points of one curve."""


class PointGroup(msgspec.Struct, frozen=True):
    """Group of points that change together: points of one or several curves, or whole curves.

    It knows its label for undo steps and messages: ``points_of(0, [2]).label`` is "point 2", and that of five
    points of two curves "5 points in 2 curves".

    Attributes
    ----------
    parts
        The curves, in order, each with the indices of its points.
    is_whole
        Whether the group stands for whole curves.
    name
        The name of the one curve, shape or group that it stands for.
    several_label
        The label of several whole ones, such as "1 group and 2 curves"; empty for "3 curves".
    remark
        Remark on curves that were selected but cannot change: "1 locked curve stays".
    """

    parts: tuple[tuple[int, frozenset[int]], ...] = ()
    is_whole: bool = False
    name: str | None = None
    several_label: str = ""
    remark: str = ""

    @property
    def label(self) -> str:
        """The label: "point 3", "4 points", "5 points in 2 curves", "Leaf", or "3 curves"."""
        if self.name is not None:
            return self.name or "curve"
        if self.is_whole:
            return self.several_label or f"{len(self.parts)} curves"
        return points_label(self.parts[0][1]) if len(self.parts) == 1 else self.count_label

    @property
    def count_label(self) -> str:
        """The number of points: "1 point", "4 points" or "5 points in 2 curves"."""
        count = count_of(self.count, "point")
        return f"{count} in {len(self.parts)} curves" if len(self.parts) > 1 else count

    @property
    def names(self) -> str:
        """The names of few points: "point 3", "points 1, 2 and 4"; the label of many."""
        if len(self.parts) != 1 or not 1 < self.count <= _MOST_NAMED:
            return self.label
        return f"points {enumerated(list(map(str, sorted(self.parts[0][1]))))}"

    @property
    def quoted_label(self) -> str:
        """The label within a sentence: a name in quotation marks."""
        return f"“{self.name}”" if self.name else self.label

    @property
    def count(self) -> int:
        """The number of points."""
        return sum(len(indices) for _, indices in self.parts)

    @property
    def only_point(self) -> tuple[int, int] | None:
        """The curve and the index of the point, if the group is a single point; else None."""
        if self.is_whole or self.count != 1:
            return None
        return next((curve, next(iter(indices))) for curve, indices in self.parts if indices)

    @property
    def curves(self) -> frozenset[int]:
        """The curves of the points."""
        return frozenset(curve for curve, _ in self.parts)

    def of(self, curve: int) -> frozenset[int]:
        """Return the indices of the points of one curve."""
        return next((indices for part, indices in self.parts if part == curve), frozenset())

    def joined(self, other: PointGroup) -> PointGroup:
        """Return the union with another group."""
        return group_points((curve, self.of(curve) | other.of(curve)) for curve in self.curves | other.curves)

    def toggled(self, other: PointGroup) -> PointGroup:
        """Return the points that are in exactly one of the two groups."""
        return group_points((curve, self.of(curve) ^ other.of(curve)) for curve in self.curves | other.curves)

    def apply(self, document: Document, edit: PointsEdit) -> Document:
        """Return the document with `edit` applied to each curve; raise EditError if curves are locked."""
        self.refuse_locked(document)
        for curve, indices in self.parts:
            document = edit(document, curve, indices)
        return document

    def apply_to_each(self, document: Document, edit: PointsEdit) -> Document:
        """Return the document with `edit` applied to each curve, alone in a document of its own.

        Faster than `apply` for thousands of curves: replacing a curve copies the tuple of all curves.
        """
        self.refuse_locked(document)
        curves = list(document.curves)
        for curve, indices in self.parts:
            (curves[curve],) = edit(replace(document, curves=(curves[curve],)), 0, indices).curves
        return replace(document, curves=tuple(curves))

    def refuse_locked(self, document: Document) -> None:
        """Raise EditError if curves of the group are locked."""
        names = [
            document.curves[curve].display_name for curve, _ in self.parts if document.curves[curve].locked
        ]
        if names:
            raise EditError(locked_message(names))


NO_POINTS = PointGroup()


def reset_message(step: str, curves: Sequence[Curve], group: PointGroup) -> str:
    """Return the message after a step that has reset derivatives, with the points that stay corners."""
    corners = group_points(
        (curve, frozenset(index for index in indices if curves[curve].points[index].corner))
        for curve, indices in group.parts
    )
    stay = "stays a corner" if corners.count == 1 else "stay corners"
    sides = f" {capitalized(corners.names)} {stay}, estimated on each side." if corners.parts else ""
    return f"{step} to estimate.{sides}"


def newly_set(before: Sequence[Curve], after: Sequence[Curve], exempt: Collection[Vector] = ()) -> PointGroup:
    """Return the points of which a step has set derivatives that were estimates before it.

    The points at the positions `exempt` are left out; points are known by their positions, for their indices
    may have changed.
    """
    same = set(map(id, before)) & set(map(id, after))
    estimated = set[Vector]()
    for curve in before:
        if id(curve) not in same:
            every = frozenset(range(len(curve.points)))
            estimated |= {curve.points[index].position for index in every - explicit_points(curve, every)}
    estimated -= set(exempt)
    parts = []
    for number, curve in enumerate(after):
        if id(curve) not in same:
            are_set = explicit_points(curve, range(len(curve.points)))
            known = (index for index in are_set if curve.points[index].position in estimated)
            parts.append((number, frozenset(known)))
    return group_points(parts)


def points_of(curve: int, indices: Collection[int]) -> PointGroup:
    """Return some points of one curve."""
    return PointGroup(((curve, frozenset(indices)),))


def group_points(parts: Iterable[tuple[int, frozenset[int]]]) -> PointGroup:
    """Return the group of points of several curves; empty parts are left out, parts of one curve united."""
    united: dict[int, frozenset[int]] = {}
    for curve, indices in parts:
        if indices:
            united[curve] = united[curve] | indices if curve in united else indices
    return PointGroup(tuple(sorted(united.items())))
