"""Shapes: neighbouring curves of one name that are drawn as one, with one fill and one line.

A curve whose `shape` is empty is a shape of its own.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import count

from msgspec.structs import replace

from .model import Curve, Document

_SHARED = ("style", "groups", "visible", "locked")
"""Values that all curves of a shape have in common."""


def shape_of(document: Document, curve: int) -> range:
    """Return the places of the curves of the shape that a curve is a part of."""
    curves, name = document.curves, document.curves[curve].shape
    first, end = curve, curve + 1
    if name:
        while first > 0 and curves[first - 1].shape == name:
            first -= 1
        while end < len(curves) and curves[end].shape == name:
            end += 1
    return range(first, end)


def shapes(document: Document) -> Iterator[range]:
    """Yield the places of the curves of each shape, in order."""
    end = 0
    while end < len(document.curves):
        found = shape_of(document, end)
        yield found
        end = found.stop


def whole_shapes(document: Document, curves: Collection[int]) -> frozenset[int]:
    """Return curves with all others of their shapes."""
    return frozenset(each for curve in curves for each in shape_of(document, curve))


def tidy_shapes(document: Document) -> Document:
    """Return the document with shapes that look the same all over, under names of their own.

    Edits may leave one curve of a shape, tear a shape apart, or change how one of its curves looks; the first
    one of a shape then says what holds for all.
    """
    if not any(curve.shape for curve in document.curves):
        return document
    used: set[str] = set()
    curves: list[Curve] = []
    for places in shapes(document):
        parts = document.curves[places.start : places.stop]
        name = _free(parts[0].shape, used) if len(parts) > 1 else ""
        used.add(name)
        shared = {field: getattr(parts[0], field) for field in _SHARED} | {"shape": name}
        curves += [_with_values(part, shared) for part in parts]
    if all(new is old for new, old in zip(curves, document.curves, strict=True)):
        return document
    return replace(document, curves=tuple(curves))


def _free(name: str, used: Collection[str]) -> str:
    """Return the name, with a number where it is taken."""
    names = (f"{name} {number}" for number in count(2))
    return name if name not in used else next(each for each in names if each not in used)


def _with_values(curve: Curve, values: dict[str, object]) -> Curve:
    """Return the curve with these values: itself where it has them."""
    is_so = all(getattr(curve, field) == value for field, value in values.items())
    return curve if is_so else replace(curve, **values)


def shape_problem(document: Document) -> str:
    """Return the first thing that is not as `tidy_shapes` leaves it, with its place; empty if none is."""
    tidy = tidy_shapes(document)
    if tidy is document:
        return ""
    place = next(
        i for i, pair in enumerate(zip(tidy.curves, document.curves, strict=True)) if pair[0] is not pair[1]
    )
    fields = (*_SHARED, "shape")
    field = next(f for f in fields if getattr(tidy.curves[place], f) != getattr(document.curves[place], f))
    if field != "shape":
        return f"curves[{place}].{field} must be that of the curve before it, which is of the same shape"
    return f"curves[{place}].shape must name two or more curves that follow each other, and no others"
