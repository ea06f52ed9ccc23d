"""Objects aligned with each other and spaced evenly by their bounds; a shape or group stays together."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import msgspec

from ..document.group_edits import nodes_of
from ..document.limits import EditError
from ..document.model import Document
from ..document.point_group import PointGroup
from ..document.several_curves import changeable, moved, whole_curves
from ..document.transforms import Edge, Reference, Spacing
from .boxes import Bounds, bounds_of_each
from .curve.curve_view import CurveView


class _Item(msgspec.Struct, frozen=True):
    """A group, a shape or a curve, with its bounds."""

    group: PointGroup
    bounds: Bounds

    def middle(self, axis: int) -> float:
        return self.bounds.centre[axis]

    def length(self, axis: int) -> float:
        return self.bounds.size[axis]


def align_curves(
    document: Document,
    views: Sequence[CurveView],
    chosen: Collection[int],
    edge: Edge,
    reference: Reference = Reference.EACH_OTHER,
    first: int = 0,
    last: int = 0,
) -> Document:
    """Move each shape of the chosen curves so that it lies along an edge, or the middle, of the reference.

    What is locked stays where it is, and the others go there.

    Parameters
    ----------
    views
        The views of all curves.
    first, last
        The ones that were chosen first and last.
    """
    items = _items(document, views, chosen)
    if not items:
        raise EditError("What is chosen has no points to align.")
    if reference is Reference.DRAWING:
        everything = _items(document, views, range(len(document.curves)))
        bounds = _joined([item.bounds for item in everything])
    else:
        bounds = _bounds_among(items, reference, first, last)
    target = _place(bounds, edge)
    free = changeable(document, chosen)
    for item in (item for item in items if item.group.curves <= free):
        document = _moved(document, item, edge.axis, target - _place(item.bounds, edge))
    return document


def _bounds_among(items: Sequence[_Item], reference: Reference, first: int, last: int) -> Bounds:
    """Return the bounds of the item that others are aligned to, or those of all."""
    if reference in (Reference.FIRST, Reference.LAST):
        place, other = (first, items[0]) if reference is Reference.FIRST else (last, items[-1])
        return next((item for item in items if place in item.group.curves), other).bounds
    all_bounds = [item.bounds for item in items]
    if reference in (Reference.LARGEST, Reference.SMALLEST):
        choose = max if reference is Reference.LARGEST else min
        return choose(all_bounds, key=lambda each: each.size[0] * each.size[1])
    return _joined(all_bounds)


def distribute_curves(
    document: Document,
    views: Sequence[CurveView],
    chosen: Collection[int],
    axis: int,
    spacing: Spacing,
) -> Document:
    """Space the shapes of the chosen curves evenly between the outer two, along x (axis 0) or y (axis 1)."""
    items = sorted(_items(document, views, chosen), key=lambda item: item.middle(axis))
    if len(items) < 3:
        raise EditError("Choose at least three curves, shapes or groups to distribute them.")
    first, last, count = items[0], items[-1], len(items) - 1
    if spacing is Spacing.CENTRES:
        start, end = first.middle(axis), last.middle(axis)
        places = [start * ((count - k) / count) + end * (k / count) for k in range(len(items))]
    else:
        room = last.bounds.high[axis] - first.bounds.low[axis] - sum(item.length(axis) for item in items)
        places, at = [], first.bounds.low[axis]
        for item in items:
            places.append(at + item.length(axis) / 2)
            at += item.length(axis) + room / count
    for item, place in zip(items[1:-1], places[1:-1], strict=True):
        document = _moved(document, item, axis, place - item.middle(axis))
    return document


def _items(document: Document, views: Sequence[CurveView], curves: Collection[int]) -> list[_Item]:
    """Return what moves as one of some curves: whole groups and shapes, those that have points."""
    groups = [whole_curves(document, node.places) for node in nodes_of(document, curves)]
    found = zip(groups, bounds_of_each(views, groups), strict=True)
    return [_Item(group, bounds) for group, bounds in found if bounds is not None]


def _joined(boxes: Sequence[Bounds]) -> Bounds:
    whole = boxes[0]
    for box in boxes[1:]:
        whole = whole.joined(box)
    return whole


def _place(bounds: Bounds, edge: Edge) -> float:
    return edge.place((bounds.low[edge.axis], bounds.high[edge.axis]))


def _moved(document: Document, item: _Item, axis: int, way: float) -> Document:
    if way == 0.0:
        return document
    return moved(document, item.group, (way, 0.0) if axis == 0 else (0.0, way))
