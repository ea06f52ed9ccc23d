"""Whole curves put elsewhere in one pass: thousands of them go with every move of a drag."""

from __future__ import annotations

from collections.abc import Callable, Collection
from itertools import chain, islice

from msgspec.structs import replace

from .edits import PointsChange, with_all_shifted
from .model import Curve, Document
from .point_group import PointGroup, PointsEdit


def shifted(document: Document, group: PointGroup, shift: PointsChange) -> Document:
    """Put the points of a group elsewhere, all by the same way; see `with_all_shifted`."""

    def edit(each: Document, curve: int, indices: Collection[int]) -> Document:
        return with_all_shifted(each, curve, indices, shift)

    return _changed(document, group, shift, edit, lambda _: True)


def mapped(document: Document, group: PointGroup, place: PointsChange, edit: PointsEdit) -> Document:
    """Return what `edit` makes of the points of a group, of those without more than a place by `place`."""
    return _changed(document, group, place, edit, _has_only_places)


def _has_only_places(curve: Curve) -> bool:
    """Whether nothing else of a curve follows where all of its points go."""
    return not (curve.has_derivatives or (curve.closed and curve.is_manual))


def _changed(
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
    return replace(group, parts=tuple(rest)).changed_apart(document, edit) if rest else document
