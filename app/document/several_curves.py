"""Several curves at once: edits of all of them, and of points that change together.

`curves` are indices of curves. Like all edits these are pure, and change all or nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import chain, islice
from typing import NamedTuple

from msgspec.structs import replace

from .curve_edits import map_curves, refuse_locked, remove_curve, unused_copy_name, without_curve
from .group_edits import as_contained, with_unused_group_names
from .groups import OUTSIDE, Container, expand_to_shapes, node_count_label, shape_of, tidy_shapes, whole_nodes
from .model import Curve, Document, Vector
from .point_edits import PointsChange, shift_points, translation
from .point_group import PointGroup, PointsEdit
from .transforms import Affine, decimal_translation, positions_mapped, transform_points
from .words import count_of


class AddedCurves(NamedTuple):
    """A document with copies of curves added, and their places in it, in the order of the originals."""

    document: Document
    indices: tuple[int, ...]


def whole_curves(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of some curves."""
    places = sorted(curves)
    return PointGroup(
        tuple((curve, frozenset(range(len(document.curves[curve].points)))) for curve in places),
        is_whole=True,
        name=(name := common_name(document, places)),
        several_label="" if name is not None else count_label(document, places),
    )


def unlocked_curves(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return those of some curves that are not locked; all where all are locked, for an edit to refuse."""
    meant = frozenset(curves)
    return frozenset(place for place in meant if not document.curves[place].locked) or meant


def locked_remark(document: Document, curves: Collection[int]) -> str:
    """Return which of some curves are not `unlocked_curves`: "1 locked curve stays"; empty for none."""
    left = frozenset(curves) - unlocked_curves(document, curves)
    if not left:
        return ""
    nodes = whole_nodes(document.curves, expand_to_shapes(document, left))
    return f"{node_count_label(nodes, 'locked ')} {'stays' if len(nodes) == 1 else 'stay'}"


def whole_unlocked_curves(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of those of some curves that are `unlocked_curves`; the group tells what stays."""
    free = unlocked_curves(document, curves)
    return replace(whole_curves(document, free), remark=locked_remark(document, curves))


# Edits


def move_group(document: Document, group: PointGroup, by: Vector) -> Document:
    """Move the points of a group; their derivatives stay."""
    return _whole_shifted(document, group, translation(by))


def step_group(document: Document, group: PointGroup, by: Vector) -> Document:
    """Move the points of a group by decimal steps; see `decimal_translation`."""
    return _whole_shifted(document, group, decimal_translation(by))


def transform_group(document: Document, group: PointGroup, by: Affine) -> Document:
    """Map the points of a group and the derivatives set there."""
    return _whole_mapped(
        document,
        group,
        positions_mapped(by),
        lambda each, curve, indices: transform_points(each, curve, indices, by),
    )


def set_appearance(
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
    return map_curves(
        document,
        expand_to_shapes(document, curves),
        lambda curve: replace(
            curve, **looks, style=curve.style if colour is None else curve.style.in_colour(colour)
        ),
    )


def show_all(document: Document) -> Document:
    """Show what is hidden."""
    return set_appearance(document, range(len(document.curves)), visible=True)


def unlock_all(document: Document) -> Document:
    """Free what is locked."""
    return set_appearance(document, range(len(document.curves)), locked=False)


def remove_curves(document: Document, curves: Collection[int]) -> Document:
    """Remove curves; where none is left, an empty one is."""
    before = document
    for curve in sorted(curves, reverse=True):
        document = remove_curve(document, curve)
    refuse_locked(before, document)
    return document


def extract_curves(document: Document, curves: Collection[int]) -> Document:
    """Return some curves of a document in a document of their own."""
    chosen = tuple(document.curves[place] for place in sorted(curves))
    return tidy_shapes(replace(document, curves=chosen, image=None))


def reorder_curves(document: Document, order: Sequence[int]) -> Document:
    """Return the document with its curves in this order, each given by its place now."""
    return replace(document, curves=tuple(document.curves[place] for place in order))


def index_of(document: Document, curve: Curve) -> int:
    """Return the place of a curve, by identity: another one may be equal to it."""
    return next(place for place, each in enumerate(document.curves) if each is curve)


def active_after_removal(
    document: Document, curves: Collection[int], active: int, edited: Collection[int] = ()
) -> int:
    """Return which curve is the active one when `curves` are gone.

    Of those `edited`, or of the shape of the active one, the nearest that is left; where none is, the one
    that takes its place.
    """
    left = [place for place in edited or shape_of(document, active) if place not in curves]
    nearest = min(left, key=lambda place: abs(place - active), default=active)
    before = sum(place not in curves for place in range(nearest))
    return max(0, min(before, len(document.curves) - len(curves) - 1))


def duplicate_curves(document: Document, curves: Collection[int]) -> AddedCurves:
    """Add copies of curves, in their order, as they look, visible and free.

    Each stays in the group of its original, in front of the last that is copied there. Copies of whole shapes
    and groups are shapes and groups of their own; those of a part of a shape are in front of it, and not in
    it.
    """
    copied = dict[Container, tuple[int, list[int]]]()
    for node in whole_nodes(document.curves, curves):
        around, at = node.container, node.indices.stop
        if around.shape:
            around, at = around.parent, shape_of(document, node.indices.start).stop
        _, before = copied.get(around, (at, []))
        copied[around] = (at, [*before, *node.indices])
    new, places = document, dict[int, int]()
    for around, (place, originals) in sorted(copied.items(), key=lambda each: each[1][0]):
        at = place + len(places)
        new = add_curves(new, list(as_contained(document.curves, originals, around).values()), at, around)
        places |= zip(originals, range(at, at + len(originals)), strict=True)
    return AddedCurves(new, tuple(places[curve] for curve in sorted(places)))


def add_curves(
    document: Document, curves: Sequence[Curve], at: int, container: Container = OUTSIDE
) -> Document:
    """Add curves from elsewhere at place `at` of the order, visible and free, under names of their own.

    Of the shapes and groups that they are in, that which they come into keeps its name.
    """
    own = with_unused_group_names(
        with_unused_names(curves, {curve.name for curve in document.curves}), document, container
    )
    return replace(document, curves=(*document.curves[:at], *own, *document.curves[at:]))


def add_imported(document: Document, new: Document) -> tuple[Document, int]:
    """Return the document with the curves of another in front, and the place of the first of them.

    A lone curve without points is what a new document begins with; it gives way, and with it unit and guides.
    The other's picture to trace comes along where there is none yet.
    """
    is_begun = not is_blank(document)
    base, image = document if is_begun else without_curve(document, 0), document.image or new.image
    place, own = len(base.curves), with_unused_group_names(new.curves, base)
    document = replace(base, curves=(*base.curves, *own), image=image)
    if is_begun:
        return document, place
    return replace(document, unit=new.unit or document.unit, guides=new.guides or document.guides), 0


def ignored_on_import(document: Document, new: Document) -> list[str]:
    """Return what `add_imported` leaves behind of the other document beside its curves: "its grid"."""
    found = ["its picture to trace"] if new.image and document.image else []
    if is_blank(document):
        return found
    if new.unit not in ("", document.unit):
        found.append(f"its unit {new.unit}")
    if new.grid_spacing not in (0.0, document.grid_spacing):
        found.append("its grid")
    guides = set(new.guides) - set(document.guides)
    return [*found, *([count_of(len(guides), "guide")] if guides else [])]


def is_blank(document: Document) -> bool:
    """Whether a document is what File > New opens: one curve without points."""
    return len(document.curves) == 1 and not document.curves[0].points


def with_unused_names(curves: Sequence[Curve], taken: Collection[str]) -> list[Curve]:
    """Return the curves, visible and free, under names not `taken`: "Leaf", "Leaf copy", "Leaf copy 2"."""
    used, fresh = set(taken), []
    for curve in curves:
        name = unused_copy_name(curve.name, used)
        used.add(name)
        fresh.append(replace(curve, name=name, visible=True, locked=False))
    return fresh


def name_or_count(document: Document, curves: Collection[int]) -> str:
    """Return the name of the curve, or of the shape or group that they are, or "3 curves"."""
    name = common_name(document, curves)
    return count_label(document, curves) if name is None else name


def count_label(document: Document, curves: Collection[int]) -> str:
    """Return "3 curves"; with whole shapes or groups among them, "1 shape and 2 curves"."""
    marked = [document.curves[curve] for curve in curves]
    if [each for each in marked if each.shape or each.groups]:
        return node_count_label(whole_nodes(document.curves, curves))
    return count_of(len(curves), "curve")


def common_name(document: Document, curves: Collection[int]) -> str | None:
    """Return the name of the curve, or of the shape or group that they are; None where they are several."""
    if len(curves) == 1:
        return document.curves[next(iter(curves))].name
    first = document.curves[min(curves, default=0)]
    if not curves or not (first.shape or first.groups):
        return None
    nodes = whole_nodes(document.curves, curves)
    return nodes[0].name if len(nodes) == 1 else None


def _whole_shifted(document: Document, group: PointGroup, shift: PointsChange) -> Document:
    """Put the points of a group elsewhere, all by the same way; see `shift_points`."""

    def edit(each: Document, curve: int, indices: Collection[int]) -> Document:
        return shift_points(each, curve, indices, shift)

    return _changed_whole(document, group, shift, edit, lambda _: True)


def _whole_mapped(document: Document, group: PointGroup, place: PointsChange, edit: PointsEdit) -> Document:
    """Return what `edit` makes of the points of a group, of those without more than a place by `place`."""
    return _changed_whole(document, group, place, edit, _has_only_places)


def _has_only_places(curve: Curve) -> bool:
    """Whether nothing else of a curve follows where all of its points go."""
    return not (curve.has_derivatives or (curve.closed and curve.is_manual))


def _changed_whole(
    document: Document,
    group: PointGroup,
    place: PointsChange,
    edit: PointsEdit,
    is_simple: Callable[[Curve], bool],
) -> Document:
    """Put whole simple curves elsewhere at once, and do an edit to the others one by one."""
    group.refuse_locked(document)
    curves, rest, whole = list(document.curves), list[tuple[int, frozenset[int]]](), list[int]()
    for part in group.parts:
        curve = curves[part[0]]
        if len(part[1]) == len(curve.points) and is_simple(curve):
            whole.append(part[0])
        else:
            rest.append(part)
    if whole:
        new = iter(place([*chain.from_iterable([curves[each].points for each in whole])]))
        for each in whole:
            curve = curves[each]
            curves[each] = replace(curve, points=tuple(islice(new, len(curve.points))))
        document = replace(document, curves=tuple(curves))
    return replace(group, parts=tuple(rest)).apply_to_each(document, edit) if rest else document
