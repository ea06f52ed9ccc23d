"""Differences between a document and the next one, as during a drag: same objects have not changed.

Needed at every move of the mouse: values are compared by `map` over C functions, not by loops of Python.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain, compress
from operator import attrgetter, eq, is_, is_not
from typing import TypeAlias

from .model import Curve, Document, Point

_besides_curves = attrgetter(*(name for name in Document.__struct_fields__ if name != "curves"))
_points = attrgetter("points")
_besides_points = attrgetter(*(name for name in Curve.__struct_fields__ if name != "points"))
_besides_position = attrgetter(*(name for name in Point.__struct_fields__ if name not in ("x", "y")))


_Step: TypeAlias = tuple[Document | None, Document | None, list[int] | None]

_last: _Step = (None, None, None)
_last_moved: tuple[Document | None, Document | None, list[Point] | None] = (None, None, None)


def reshaped_curves(before: Document, after: Document) -> list[int] | None:
    """Return the indices of curves whose points changed; None if anything else changed.

    The numbers of curves and points are the same, so that all indices stay valid. The last result is
    remembered, because every listener of a step asks for it.
    """
    global _last  # noqa: PLW0603
    step = _last
    if step[0] is not before or step[1] is not after:
        step = _last = (before, after, _reshaped(before, after))
    return step[2]


def _reshaped(before: Document, after: Document) -> list[int] | None:
    old, new = before.curves, after.curves
    if len(old) != len(new) or not all(map(is_, _besides_curves(before), _besides_curves(after))):
        return None
    indices = list(compress(range(len(new)), map(is_not, new, old)))
    were, are = ([curves[index] for index in indices] for curves in (old, new))
    return indices if _all_differ_in_points(were, are) else None


def known_curves(before: Document | None) -> tuple[set[int], dict[int, Curve]]:
    """Return the identities of the curves of a document, and its curves by the identity of their points."""
    curves = before.curves if before is not None else ()
    return set(map(id, curves)), dict(zip(map(id, map(_points, curves)), curves, strict=True))


def curves_changed_besides_points(before: Sequence[Curve], after: Sequence[Curve]) -> list[int]:
    """Return the indices of curves that differ in more than their points; their number is the same."""
    indices = list(compress(range(len(after)), map(is_not, after, before)))
    were, are = ([curves[index] for index in indices] for curves in (before, after))
    if _all_differ_in_points(were, are):
        return []
    return [
        index for index, *pair in zip(indices, were, are, strict=True) if not differ_only_in_points(*pair)
    ]


def _all_differ_in_points(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    same_rest = map(is_, *(chain.from_iterable(map(_besides_points, curves)) for curves in (before, after)))
    same_numbers = map(eq, *(map(len, map(_points, curves)) for curves in (before, after)))
    return all(same_rest) and all(same_numbers)


def differ_only_in_points(before: Curve, after: Curve) -> bool:
    """Return whether two curves have the same number of points and are equal apart from these."""
    same_number = len(before.points) == len(after.points)
    return same_number and all(map(is_, _besides_points(before), _besides_points(after)))


def have_only_moved(before: Iterable[Point], after: Iterable[Point]) -> bool:
    """Return whether points differ from as many others only in their positions."""
    was, now = (chain.from_iterable(map(_besides_position, points)) for points in (before, after))
    return all(map(is_, was, now))


def moved_points(before: Document, after: Document) -> list[Point] | None:
    """Return the points of `after` that moved; None if anything but positions changed.

    The last result is remembered, as that of `reshaped_curves`.
    """
    global _last_moved  # noqa: PLW0603
    step = _last_moved
    if step[0] is not before or step[1] is not after:
        step = _last_moved = (before, after, _moved_points(before, after))
    return step[2]


def are_last_moved(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Return whether these are the curves of the last call of `moved_points`, and only points moved."""
    was, now, moved = _last_moved
    if was is None or now is None or moved is None:
        return False
    return was.curves is before and now.curves is after


def _moved_points(before: Document, after: Document) -> list[Point] | None:
    indices = reshaped_curves(before, after)
    if indices is None:
        return None
    old, new = list[Point](), list[Point]()
    for index in indices:
        was, now = before.curves[index].points, after.curves[index].points
        old += compress(was, map(is_not, now, was))
        new += compress(now, map(is_not, now, was))
    return new if have_only_moved(old, new) else None
