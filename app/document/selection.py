"""Selection: the curves and points that are selected, and where they are after a change."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import repeat
from operator import is_

import msgspec

from .groups import shape_around
from .model import Curve, Document, Point, Vector
from .point_group import PointGroup, group_points

NONE_SELECTED = "No curve is selected. Click one, or press Ctrl+A to select all."
"""Message of an action that needs a curve while no curve is active or selected."""

NONE_SELECTABLE = "All curves are hidden or locked. Show or unlock them in the list of curves."
"""Message of Select All where no curve is visible and unlocked."""


class SelectionState(msgspec.Struct, frozen=True):
    """All that is selected at a moment: a step of the history and a cancelled gesture restore it.

    ``before = selected.state`` and ``selected.restore(before)`` are a pair.

    Attributes
    ----------
    active
        The active curve.
    points
        The selected points, of all curves that are edited.
    curves, whole_curves
        The curves that are edited together, and those that are selected as wholes.
    is_editing
        Whether the active curve is edited.
    is_implicit
        Whether a tool began that while nothing was selected.
    """

    active: int
    points: PointGroup
    curves: frozenset[int]
    whole_curves: frozenset[int]
    is_editing: bool
    is_implicit: bool = False


def selectable_curves(document: Document) -> frozenset[int]:
    """Return the curves that Select All selects: visible and unlocked ones."""
    return frozenset(index for index, curve in enumerate(document.curves) if curve.is_selectable)


def all_points(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of some curves."""
    return group_points((index, frozenset(range(len(document.curves[index].points)))) for index in curves)


def existing_points(group: PointGroup, curves: Sequence[Curve], active_curves: Collection[int]) -> PointGroup:
    """Return the points of a group that exist and belong to active curves."""
    return group_points(
        (curve, _within(indices, len(curves[curve].points)))
        for curve, indices in group.parts
        if curve in active_curves
    )


def _within(indices: frozenset[int], count: int) -> frozenset[int]:
    """Return the indices from 0 to `count` − 1; the same object where all are."""
    if indices and min(indices) >= 0 and max(indices) < count:
        return indices
    return frozenset(index for index in indices if 0 <= index < count)


# Selected curves and points, followed through a change


def followed_selection(
    state: SelectionState, before: Sequence[Curve], after: Sequence[Curve]
) -> SelectionState:
    """Return the selection after a change: the same curves and points, at their new indices.

    The active curve is one of `after`. Where the edited curves are gone and no curve has replaced them, no
    curve is edited and none selected: the next key does not act on an unexpected curve.
    """
    active, is_editing = state.active, state.is_editing
    points = followed_group(state.points, active, before, after)
    selected = followed_curves(state.whole_curves, before, after)
    if is_editing and _are_gone(state.curves, active, before, after):
        is_editing, selected = False, frozenset()
    elif active not in selected and selected and not is_editing and len(after) <= len(before):
        # Undo and redo of a drag that has selected a curve keep that selection. Curves that were selected
        # after copies were made stay selected when the copies go.
        active = min(selected, key=lambda index: abs(index - active))
    elif active not in selected:
        # An added curve becomes the selected one; where a curve was removed, no other is selected.
        selected = frozenset({active} if is_editing or len(after) > len(before) else ())
    curves = selected or frozenset({active})
    whole = selected if not is_editing or len(selected) > 1 else frozenset()
    return SelectionState(active, points, curves, whole, is_editing)


def _are_gone(
    active_curves: Collection[int], active: int, before: Sequence[Curve], after: Sequence[Curve]
) -> bool:
    """Return whether all active curves are gone, and the active curve is another one that existed before."""
    if len(after) >= len(before) or not any(map(is_, before, repeat(after[active]))):
        return False
    shapes = {index for curve in active_curves for index in shape_around(before, curve)}
    return not followed_indices(shapes, before, after)


def followed_curves(
    selected: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> frozenset[int]:
    """Return the indices of selected curves after a change; curves that are gone are left out."""
    return frozenset(followed_indices(selected, before, after).values())


def followed_indices(
    selected: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> dict[int, int]:
    """Return the index of each selected curve after a change, by its index before.

    An edit passes on unchanged curves as the same objects, so that a curve that moved in the order is found
    by identity. A changed curve is found by its index, if the number of curves is the same.
    """
    same_number = len(before) == len(after)
    if before is after or (same_number and all(after[index] is before[index] for index in selected)):
        return {index: index for index in selected}
    indices = {id(curve): index for index, curve in enumerate(after)}
    result = {}
    for index in selected:
        if same_number and after[index] is before[index]:
            result[index] = index
        elif id(before[index]) in indices:
            result[index] = indices[id(before[index])]
        elif same_number:
            result[index] = index
    return result


def followed_group(
    group: PointGroup, active: int, before: Sequence[Curve], after: Sequence[Curve]
) -> PointGroup:
    """Return the selected points after a change; `active` is the curve that is edited from then on."""
    curves = followed_indices(group.curves, before, after)
    is_lost = active in group.curves and active not in curves
    if is_lost and not any(curve is after[active] for curve in before):
        # It was changed, and others were added beside it: it is still the edited one.
        curves[active] = active
    return group_points(
        (curves[curve], followed_points(indices, before[curve].points, after[curves[curve]].points))
        for curve, indices in group.parts
        if curve in curves
    )


def followed_points(
    selected: Collection[int], before: Sequence[Point], after: Sequence[Point]
) -> frozenset[int]:
    """Return the indices of selected points after a change; points that are gone are left out.

    If the number of points is the same, the indices are. Otherwise a point is found by its position: of
    several points at one position, the first stays the first.
    """
    if len(before) == len(after):
        return frozenset(selected)
    indices_at: dict[Vector, list[int]] = {}
    for index, point in enumerate(after):
        indices_at.setdefault(point.position, []).append(index)
    result = set()
    # Every old point uses up the first index at its position, so that one pass over the points is enough.
    unused = {position: iter(indices) for position, indices in indices_at.items()}
    for index, point in enumerate(before):
        new_index = next(unused[point.position], None) if point.position in unused else None
        if new_index is not None and index in selected:
            result.add(new_index)
    return frozenset(result)


# Curves and points that undo brought back


def returned_points(
    active_curves: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> PointGroup:
    """Return the points of active curves that did not exist before."""
    return group_points(
        (curve, _returned(before[curve].points, after[curve].points)) for curve in active_curves
    )


def _returned(before: Sequence[Point], after: Sequence[Point]) -> frozenset[int]:
    """Return the points of `after` at new positions; none unless there are more points than before."""
    if len(after) <= len(before):
        return frozenset()
    positions = {point.position for point in before}
    return frozenset(index for index, point in enumerate(after) if point.position not in positions)


def returned_curves(before: Sequence[Curve], after: Sequence[Curve]) -> frozenset[int]:
    """Return the curves of `after` that are not in `before`; none where the same curves were changed."""
    old, new = set(map(id, before)), set(map(id, after))
    added = {index for index, curve in enumerate(after) if id(curve) not in old}
    removed = {index for index, curve in enumerate(before) if id(curve) not in new}
    return frozenset() if added == removed else frozenset(added)
