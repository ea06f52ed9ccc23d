"""Curves aligned and spaced evenly by their bounds; the curves of a shape or group move together."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import msgspec

from ..document.group_edits import nodes_of
from ..document.limits import EditError
from ..document.model import Document
from ..document.point_group import PointGroup
from ..document.several_curves import move_group, unlocked_curves, whole_curves
from ..document.transforms import Edge, Reference, Spacing
from .boxes import Bounds, bounds_of_groups
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
    selected: Collection[int],
    edge: Edge,
    reference: Reference = Reference.EACH_OTHER,
    first: int = 0,
    last: int = 0,
) -> Document:
    """Move each shape of the selected curves to an edge, or the middle, of the reference.

    Locked curves stay where they are.

    Parameters
    ----------
    views
        The views of all curves.
    first, last
        The curves that were selected first and last.
    """
    items = _items(document, views, selected)
    if not items:
        raise EditError("The selection has no points to align.")
    if reference is Reference.DRAWING:
        everything = _items(document, views, range(len(document.curves)))
        bounds = _joined([item.bounds for item in everything])
    else:
        bounds = _bounds_among(items, reference, first, last)
    target = _edge_position(bounds, edge)
    free = unlocked_curves(document, selected)
    for item in (item for item in items if item.group.curves <= free):
        document = _moved(document, item, edge.axis, target - _edge_position(item.bounds, edge))
    return document


def _bounds_among(items: Sequence[_Item], reference: Reference, first: int, last: int) -> Bounds:
    """Return the bounds of the item that others are aligned to, or those of all."""
    if reference in (Reference.FIRST, Reference.LAST):
        index, other = (first, items[0]) if reference is Reference.FIRST else (last, items[-1])
        return next((item for item in items if index in item.group.curves), other).bounds
    all_bounds = [item.bounds for item in items]
    if reference in (Reference.LARGEST, Reference.SMALLEST):
        choose = max if reference is Reference.LARGEST else min
        return choose(all_bounds, key=lambda box: box.size[0] * box.size[1])
    return _joined(all_bounds)


def distribute_curves(
    document: Document,
    views: Sequence[CurveView],
    selected: Collection[int],
    axis: int,
    spacing: Spacing,
) -> Document:
    """Space the shapes of the selected curves evenly between the outer two, along x (0) or y (1)."""
    items = sorted(_items(document, views, selected), key=lambda item: item.middle(axis))
    if len(items) < 3:
        raise EditError("Select at least three curves, shapes or groups to distribute.")
    first, last, count = items[0], items[-1], len(items) - 1
    if spacing is Spacing.CENTRES:
        start, end = first.middle(axis), last.middle(axis)
        centres = [start * ((count - k) / count) + end * (k / count) for k in range(len(items))]
    else:
        room = last.bounds.high[axis] - first.bounds.low[axis] - sum(item.length(axis) for item in items)
        centres, at = [], first.bounds.low[axis]
        for item in items:
            centres.append(at + item.length(axis) / 2)
            at += item.length(axis) + room / count
    for item, centre in zip(items[1:-1], centres[1:-1], strict=True):
        document = _moved(document, item, axis, centre - item.middle(axis))
    return document


def _items(document: Document, views: Sequence[CurveView], curves: Collection[int]) -> list[_Item]:
    """Return the groups, shapes and curves that move as one, those that have points."""
    groups = [whole_curves(document, node.indices) for node in nodes_of(document, curves)]
    pairs = zip(groups, bounds_of_groups(views, groups), strict=True)
    return [_Item(group, bounds) for group, bounds in pairs if bounds is not None]


def _joined(boxes: Sequence[Bounds]) -> Bounds:
    whole = boxes[0]
    for box in boxes[1:]:
        whole = whole.joined(box)
    return whole


def _edge_position(bounds: Bounds, edge: Edge) -> float:
    return edge.target((bounds.low[edge.axis], bounds.high[edge.axis]))


def _moved(document: Document, item: _Item, axis: int, distance: float) -> Document:
    if distance == 0.0:
        return document
    return move_group(document, item.group, (distance, 0.0) if axis == 0 else (0.0, distance))
