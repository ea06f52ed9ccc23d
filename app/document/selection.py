"""Chosen curves and selected points: at a moment, after a change, and those that came back with it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import repeat
from operator import is_

import msgspec

from .groups import shape_around
from .model import Curve, Document, Point, Vector
from .point_group import PointGroup, group_points

NONE_SELECTED = "No curve is selected. Click one, or press Ctrl+A to select all."
"""What is said to whoever wants something of a curve while none is edited and none chosen."""

NONE_SELECTABLE = "All curves are hidden or locked. Show or unlock them in the list of curves."
"""What is said where all curves are asked for, and none is seen and free."""


class SelectionState(msgspec.Struct, frozen=True):
    """All that is selected at a moment, for a gesture that is taken back.

    Attributes
    ----------
    active
        The active curve.
    points
        The selected points, of all curves that are edited.
    curves, chosen
        The curves that are worked on together, and those acted on as wholes.
    is_editing
        Whether the active curve is edited.
    """

    active: int
    points: PointGroup
    curves: frozenset[int]
    chosen: frozenset[int]
    is_editing: bool


def selectable_curves(document: Document) -> frozenset[int]:
    """Return the curves that all of them are to a person: seen, and not locked."""
    return frozenset(place for place, curve in enumerate(document.curves) if curve.is_selectable)


def followed_curves(
    selected: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> frozenset[int]:
    """Return where selected curves are after a change, as far as they are there."""
    return frozenset(followed_indices(selected, before, after).values())


def followed_indices(
    selected: Collection[int], before: Sequence[Curve], after: Sequence[Curve]
) -> dict[int, int]:
    """Return for selected curves where each is after a change: the same value, or else in the same place.

    An edit hands on what it does not change, so that a curve elsewhere in the order is the same object. One
    that was changed is looked for in its place, where the number of curves is what it was.
    """
    same_number = len(before) == len(after)
    if before is after or (same_number and all(after[place] is before[place] for place in selected)):
        return {place: place for place in selected}
    places = {id(curve): place for place, curve in enumerate(after)}
    found = {}
    for place in selected:
        if same_number and after[place] is before[place]:
            found[place] = place
        elif id(before[place]) in places:
            found[place] = places[id(before[place])]
        elif same_number:
            found[place] = place
    return found


def followed_points(
    selected: Collection[int], before: Sequence[Point], after: Sequence[Point]
) -> frozenset[int]:
    """Return where selected points are after a change; those of which nothing is left are left out.

    As many points as before are the same ones, wherever they went. Otherwise a point is where it was in the
    plane: of several at one place the first stays the first.
    """
    if len(before) == len(after):
        return frozenset(selected)
    places: dict[Vector, list[int]] = {}
    for index, point in enumerate(after):
        places.setdefault(point.position, []).append(index)
    found = set()
    # Every old point takes the first place left where it is, so that one walk over the points will do.
    left = {position: iter(indices) for position, indices in places.items()}
    for index, point in enumerate(before):
        place = next(left[point.position], None) if point.position in left else None
        if place is not None and index in selected:
            found.add(place)
    return frozenset(found)


def followed_group(
    group: PointGroup, active: int, before: Sequence[Curve], after: Sequence[Curve]
) -> PointGroup:
    """Return where selected points are after a change; `active` is the curve that is edited from then on."""
    places = followed_indices(group.curves, before, after)
    is_lost = active in group.curves and active not in places
    if is_lost and not any(curve is after[active] for curve in before):
        # It was changed, and others added beside it: it is still the one that is edited.
        places[active] = active
    return group_points(
        (places[curve], followed_points(indices, before[curve].points, after[places[curve]].points))
        for curve, indices in group.parts
        if curve in places
    )


def existing_points(group: PointGroup, curves: Sequence[Curve], edited: Collection[int]) -> PointGroup:
    """Return what there is of some points of curves that are edited."""
    return group_points(
        (curve, _within(indices, len(curves[curve].points)))
        for curve, indices in group.parts
        if curve in edited
    )


def _within(indices: frozenset[int], count: int) -> frozenset[int]:
    """Return the indices of points that a curve of so many has; the same object where all are."""
    if indices and min(indices) >= 0 and max(indices) < count:
        return indices
    return frozenset(index for index in indices if 0 <= index < count)


def followed_selection(
    choice: SelectionState, before: Sequence[Curve], after: Sequence[Curve]
) -> SelectionState:
    """Return what is selected after a change: the same curves and points, where they are now.

    The active curve is one of `after`. Where what was edited is gone, and no curve has come in its place,
    none is edited and none chosen: the next key is not about a curve that nobody has asked for.
    """
    active, is_editing = choice.active, choice.is_editing
    points = followed_group(choice.points, active, before, after)
    kept = followed_curves(choice.chosen, before, after)
    if is_editing and _are_left(choice.curves, active, before, after):
        is_editing, kept = False, frozenset()
    elif active not in kept and kept and not is_editing and len(after) <= len(before):
        # Undo and redo of a drag that has chosen something leave that chosen, whatever was before it. What
        # was chosen since copies were made stays so when these go.
        active = min(kept, key=lambda place: abs(place - active))
    elif active not in kept:
        # A curve that was added is what is worked on now; where one has gone nobody has chosen another.
        kept = frozenset({active} if is_editing or len(after) > len(before) else ())
    curves = kept or frozenset({active})
    chosen = kept if not is_editing or len(kept) > 1 else frozenset()
    return SelectionState(active, points, curves, chosen, is_editing)


def _are_left(edited: Collection[int], active: int, before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Whether all that was edited is gone, and the active curve is another one that was there already."""
    if len(after) >= len(before) or not any(map(is_, before, repeat(after[active]))):
        return False
    shapes = {place for each in edited for place in shape_around(before, each)}
    return not followed_indices(shapes, before, after)


def all_points(document: Document, curves: Collection[int]) -> PointGroup:
    """Return all points of some curves."""
    return group_points((at, frozenset(range(len(document.curves[at].points)))) for at in curves)


def returned_points(edited: Collection[int], before: Sequence[Curve], after: Sequence[Curve]) -> PointGroup:
    """Return which points of edited curves were not there before."""
    return group_points((curve, _returned(before[curve].points, after[curve].points)) for curve in edited)


def _returned(before: Sequence[Point], after: Sequence[Point]) -> frozenset[int]:
    """Return which points of `after` are at no place of `before`; none unless there are more of them."""
    if len(after) <= len(before):
        return frozenset()
    places = {point.position for point in before}
    return frozenset(index for index, point in enumerate(after) if point.position not in places)


def returned_curves(before: Sequence[Curve], after: Sequence[Curve]) -> frozenset[int]:
    """Return which curves of `after` are not among `before`; none where they are the same ones, changed."""
    known, kept = set(map(id, before)), set(map(id, after))
    new = {place for place, curve in enumerate(after) if id(curve) not in known}
    gone = {place for place, curve in enumerate(before) if id(curve) not in kept}
    return frozenset() if new == gone else frozenset(new)
