"""Several curves at once: edits of all of them, and points that change together.

`curves` are indices of curves. Like all edits these are pure, and change all or nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import NamedTuple

import msgspec
from msgspec.structs import replace

from .curve_edits import free_copy_name, locked_sentence, refuse_locked, remove_curve, with_each
from .curve_tree import OUTSIDE, Container, whole_nodes
from .edits import EditError, move_points
from .model import Curve, Document, Vector
from .shape_edits import contained, with_own_names
from .shapes import whole_shapes
from .transforms import Affine, transform_points
from .words import points


class Added(NamedTuple):
    """A document with curves added, and their places in it."""

    document: Document
    places: range


PointsEdit = Callable[[Document, int, Collection[int]], Document]
"""An edit of some points of one curve."""


class PointGroup(msgspec.Struct, frozen=True):
    """Points that change together: some of one curve, or all of several.

    Attributes
    ----------
    parts
        The curves, each with the indices of its points.
    """

    parts: tuple[tuple[int, frozenset[int]], ...]

    @property
    def is_several(self) -> bool:
        """Whether it is several curves, whole."""
        return len(self.parts) > 1

    @property
    def words(self) -> str:
        """The words "point 3", "4 points" or "3 curves"."""
        return f"{len(self.parts)} curves" if self.is_several else points(self.parts[0][1])

    @property
    def first_point(self) -> tuple[int, int]:
        """A curve and one of its points; there must be one."""
        return next((curve, min(indices)) for curve, indices in self.parts if indices)

    @property
    def only_point(self) -> tuple[int, int] | None:
        """The curve and the point where it is a single one."""
        return self.first_point if not self.is_several and len(self.parts[0][1]) == 1 else None

    @property
    def curves(self) -> frozenset[int]:
        """The curves that it is of."""
        return frozenset(curve for curve, _ in self.parts)

    def changed(self, document: Document, edit: PointsEdit) -> Document:
        """Return `document` with `edit` done to all of it; locked curves refuse, named together."""
        self.refuse_locked(document)
        for curve, indices in self.parts:
            document = edit(document, curve, indices)
        return document

    def refuse_locked(self, document: Document) -> None:
        """Raise EditError if curves that it is of are locked."""
        names = [document.curves[curve].name for curve, _ in self.parts if document.curves[curve].locked]
        if names:
            raise EditError(locked_sentence(names))


def points_of(curve: int, indices: Collection[int]) -> PointGroup:
    """Return some points of one curve."""
    return PointGroup(((curve, frozenset(indices)),))


def whole_curves(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of some curves."""
    return PointGroup(
        tuple((curve, frozenset(range(len(document.curves[curve].points)))) for curve in sorted(curves))
    )


# Edits


def moved(document: Document, group: PointGroup, by: Vector) -> Document:
    """Move the points of a group; their derivatives stay."""
    return group.changed(document, lambda each, curve, indices: move_points(each, curve, indices, by))


def mapped(document: Document, group: PointGroup, by: Affine) -> Document:
    """Map the points of a group and the derivatives set there."""
    return group.changed(document, lambda each, curve, indices: transform_points(each, curve, indices, by))


def with_appearance(
    document: Document,
    curves: Collection[int],
    *,
    visible: bool | None = None,
    locked: bool | None = None,
    colour: str | None = None,
) -> Document:
    """Show or hide curves, lock or free them, draw them in a colour; None leaves each as it is."""
    given = {"visible": visible, "locked": locked}
    looks = {name: value for name, value in given.items() if value is not None}
    style = {} if colour is None else {"stroke": colour}
    return with_each(
        document,
        whole_shapes(document, curves),
        lambda curve: replace(curve, **looks, style=replace(curve.style, **style)),
    )


def remove_curves(document: Document, curves: Collection[int]) -> Document:
    """Remove curves; where none is left, an empty one is."""
    before = document
    for curve in sorted(curves, reverse=True):
        document = remove_curve(document, curve)
    refuse_locked(before, document)
    return document


def in_order(document: Document, order: Sequence[int]) -> Document:
    """Return the document with its curves in this order, each given by its place now."""
    return replace(document, curves=tuple(document.curves[place] for place in order))


def place_in(document: Document, curve: Curve) -> int:
    """Return the place of a curve, by identity: another one may be equal to it."""
    return next(place for place, each in enumerate(document.curves) if each is curve)


def active_after_removal(document: Document, curves: Collection[int], active: int) -> int:
    """Return which curve to edit when `curves` are gone: the one that takes the place of the active one."""
    before = sum(place not in curves for place in range(active))
    return max(0, min(before, len(document.curves) - len(curves) - 1))


def add_copies(document: Document, curves: Collection[int], colours: Sequence[str]) -> Added:
    """Add copies of curves right in front of them, in their order, in these colours, visible and free.

    Copies of whole shapes and groups are shapes and groups of their own.
    """
    last = whole_nodes(document.curves, curves)[-1]
    inside = contained(document.curves, curves, last.around)
    copies = [
        replace(curve, style=replace(curve.style, stroke=colour))
        for curve, colour in zip(inside.values(), colours, strict=True)
    ]
    at = last.places.stop
    return Added(add_curves(document, copies, at, last.around), range(at, at + len(copies)))


def add_curves(
    document: Document, curves: Sequence[Curve], at: int, container: Container = OUTSIDE
) -> Document:
    """Add curves from elsewhere at place `at` of the order, visible and free, under names of their own.

    Of the shapes and groups that they are in, that which they come into keeps its name.
    """
    own = with_own_names(renamed(curves, {curve.name for curve in document.curves}), document, container)
    return replace(document, curves=(*document.curves[:at], *own, *document.curves[at:]))


def add_imported(document: Document, new: Document) -> tuple[Document, int]:
    """Return the document with the curves of another, and the place of the first of them.

    A lone curve without points is what a new document begins with; it gives way. The other's picture to
    trace comes along where there is none yet.
    """
    begun = document.curves if len(document.curves) > 1 or document.curves[0].points else ()
    curves = (*begun, *with_own_names(new.curves, replace(document, curves=begun)))
    return replace(document, curves=curves, image=document.image or new.image), len(begun)


def renamed(curves: Sequence[Curve], taken: Collection[str]) -> list[Curve]:
    """Return the curves, visible and free, under names not `taken`: "Leaf", "Leaf copy", "Leaf copy 2"."""
    used, fresh = set(taken), []
    for curve in curves:
        name = free_copy_name(curve.name, used)
        used.add(name)
        fresh.append(replace(curve, name=name, visible=True, locked=False))
    return fresh


def named(document: Document, curves: Collection[int]) -> str:
    """Return the name of the curve, or of the shape or group that they are, or "3 curves"."""
    if len(curves) == 1:
        return document.curves[next(iter(curves))].name
    nodes = whole_nodes(document.curves, curves)
    return nodes[0].name if len(nodes) == 1 else f"{len(curves)} curves"
