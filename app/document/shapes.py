"""Shapes: neighbouring curves of one name that are drawn as one, with one fill and one line.

A curve whose `shape` is empty is a shape of its own.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import count as counting
from itertools import takewhile
from operator import attrgetter, is_

from msgspec.structs import replace

from .model import Curve, Document
from .steps import reshaped
from .words import count_of

SHARED = ("style", "groups", "visible", "locked")
"""Values that all curves of a shape have in common."""

_DEEPEST = 50
"""Groups that may be within each other."""

_looks = attrgetter(*SHARED, "shape")


def shape_of(document: Document, curve: int) -> range:
    """Return the places of the curves of the shape that a curve is a part of."""
    return shape_around(document.curves, curve)


def shape_around(curves: Sequence[Curve], curve: int) -> range:
    """Return the places of the curves of the shape that one of these curves is a part of."""
    name, first, end = curves[curve].shape, curve, curve + 1
    if name:
        while first > 0 and curves[first - 1].shape == name:
            first -= 1
        while end < len(curves) and curves[end].shape == name:
            end += 1
    return range(first, end)


def shapes(curves: Sequence[Curve]) -> Iterator[range]:
    """Yield the places of the curves of each shape, in order."""
    first = 0
    for place in range(1, len(curves) + 1):
        name = curves[first].shape
        if place == len(curves) or not name or curves[place].shape != name:
            yield range(first, place)
            first = place


def counted_shapes(curves: Sequence[Curve]) -> str:
    """Return "3 curves", or "2 shapes" where some are of several curves."""
    count = sum(1 for _ in shapes(curves)) if curves else 0
    return count_of(count, "curve" if count == len(curves) else "shape")


def whole_shapes(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return curves with all others of their shapes."""
    found, values = set(curves), document.curves
    whole: set[int] = set()
    # Most of thousands are shapes by themselves.
    for curve in [each for each in found if values[each].shape]:
        if curve not in whole:
            whole.update(shape_of(document, curve))
    return frozenset(found | whole)


def tidy_shapes(document: Document, before: Document | None = None) -> Document:
    """Return the document with shapes that look the same all over, and all under names of their own.

    Edits may leave one curve of a shape, tear a shape or a group apart, or change how one of the curves of a
    shape looks; the first one of a shape then says what holds for all. `before` is tidy, and what is known of
    it is not looked for again.
    """
    if before is not None and (
        reshaped(before, document) is not None or _look_the_same(before.curves, document.curves)
    ):
        return document
    if not any(curve.shape or curve.groups for curve in document.curves):
        return document
    curves = list(_with_own_groups(_with_whole_shapes(document)))
    if any(new is not old for new, old in zip(curves, document.curves, strict=True)):
        return replace(document, curves=tuple(curves))
    return document


def _look_the_same(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Whether nothing that shapes and groups are made of is another, nor at another place."""
    return len(before) == len(after) and all(
        new is old or all(map(is_, values := _looks(new), was := _looks(old))) or values == was
        for new, old in zip(after, before, strict=True)
    )


def _with_whole_shapes(document: Document) -> Iterator[Curve]:
    """Yield the curves, those of a shape with what its first one has, under a name that no other has."""
    used: set[str] = set()
    for places in shapes(document.curves):
        parts = document.curves[places.start : places.stop]
        if not parts[0].shape and len(parts) == 1:
            yield parts[0]
            continue
        name = _free(parts[0].shape, used) if len(parts) > 1 else ""
        used.add(name)
        shared = {field: getattr(parts[0], field) for field in SHARED} | {"shape": name}
        for part in parts:
            yield with_values(part, shared)


def _with_own_groups(curves: Iterable[Curve]) -> Iterator[Curve]:
    """Yield the curves, those of each group in one that no others name, and in no more than there may be."""
    used: set[str] = set()
    before: tuple[str, ...] = ()
    names: list[str] = []
    for curve in curves:
        if not curve.groups:
            before, names = (), []
            yield curve
            continue
        groups = tuple(filter(None, curve.groups))[:_DEEPEST]
        if groups == before == curve.groups == tuple(names):
            yield curve
            continue
        names = names[: len(shared_start(groups, before))]
        for name in groups[len(names) :]:
            names.append(_free(name, used))
            used.add(names[-1])
        before = groups
        yield with_values(curve, {"groups": tuple(names)})


def shared_start(*groups: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names that all begin with."""
    pairs = takewhile(lambda names: len(set(names)) == 1, zip(*groups, strict=False))
    return tuple(names[0] for names in pairs)


def _free(name: str, used: Collection[str]) -> str:
    """Return the name, with a number where it is taken."""
    names = (f"{name} {number}" for number in counting(2))
    return name if name not in used else next(each for each in names if each not in used)


def with_values(curve: Curve, values: Mapping[str, object]) -> Curve:
    """Return the curve with these values: itself where it has them."""
    is_so = all(getattr(curve, field) == value for field, value in values.items())
    return curve if is_so else replace(curve, **values)


def shape_problem(document: Document) -> str:
    """Return the first thing that is not as `tidy_shapes` leaves it, with its place; empty if none is."""
    tidy = tidy_shapes(document)
    if tidy is document:
        return ""
    if tidy.curves == document.curves:
        return ""
    place = next(
        i for i, pair in enumerate(zip(tidy.curves, document.curves, strict=True)) if pair[0] is not pair[1]
    )
    return f"curves[{place}].{_problem_at(place, tidy.curves, document.curves[place])}"


def _problem_at(place: int, tidy: Sequence[Curve], bad: Curve) -> str:
    """Return in what way a curve is not as it is in a tidy document."""
    good = tidy[place]
    if good.shape != bad.shape:
        return "shape must name two or more curves that follow each other, and no others"
    field = next(each for each in SHARED if getattr(good, each) != getattr(bad, each))
    if place and good.shape and good.shape == tidy[place - 1].shape:
        return f"{field} must be that of the curve before it, which is of the same shape"
    return f"groups must name {_DEEPEST} groups at most, each of curves that follow each other"
