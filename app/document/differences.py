"""From one value to the next, as under a drag: what is the same object has not changed.

Asked at every move of a mouse, so that no field is looked at by Python itself.
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
_besides_place = attrgetter(*(name for name in Point.__struct_fields__ if name not in ("x", "y")))


_Step: TypeAlias = tuple[Document | None, Document | None, list[int] | None]

_last: _Step = (None, None, None)
_last_moved: tuple[Document | None, Document | None, list[Point] | None] = (None, None, None)


def reshaped_curves(before: Document, after: Document) -> list[int] | None:
    """Return which curves have other points in `after`; None where more than points is another thing.

    Each has as many points as before, so that all that names a curve or a point names the same one. The last
    answer is kept: all who hear of a step ask the same.
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
    places = list(compress(range(len(new)), map(is_not, new, old)))
    were, are = ([curves[place] for place in places] for curves in (old, new))
    return places if _all_differ_in_points(were, are) else None


def known_curves(before: Document | None) -> tuple[set[int], dict[int, Curve]]:
    """Return which curves there are, by identity, and one that has them by the identity of its points."""
    curves = before.curves if before is not None else ()
    return set(map(id, curves)), dict(zip(map(id, map(_points, curves)), curves, strict=True))


def curves_changed_besides_points(before: Sequence[Curve], after: Sequence[Curve]) -> list[int]:
    """Return the places of as many curves as before that differ in more than where their points are."""
    places = list(compress(range(len(after)), map(is_not, after, before)))
    were, are = ([curves[place] for place in places] for curves in (before, after))
    if _all_differ_in_points(were, are):
        return []
    return [at for at, *pair in zip(places, were, are, strict=True) if not differ_only_in_points(*pair)]


def _all_differ_in_points(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    same_rest = map(is_, *(chain.from_iterable(map(_besides_points, each)) for each in (before, after)))
    same_numbers = map(eq, *(map(len, map(_points, each)) for each in (before, after)))
    return all(same_rest) and all(same_numbers)


def differ_only_in_points(before: Curve, after: Curve) -> bool:
    """Whether all but the points is the same of two curves, and how many these are."""
    same_number = len(before.points) == len(after.points)
    return same_number and all(map(is_, _besides_points(before), _besides_points(after)))


def have_only_moved(before: Iterable[Point], after: Iterable[Point]) -> bool:
    """Whether all but the places is the same of points and as many others."""
    was, now = (chain.from_iterable(map(_besides_place, each)) for each in (before, after))
    return all(map(is_, was, now))


def moved_points(before: Document, after: Document) -> list[Point] | None:
    """Return the points of `after` that are elsewhere; None where more than places is another thing.

    The last answer is kept, as that of `reshaped_curves`.
    """
    global _last_moved  # noqa: PLW0603
    step = _last_moved
    if step[0] is not before or step[1] is not after:
        step = _last_moved = (before, after, _moved_points(before, after))
    return step[2]


def are_last_moved(before: Sequence[Curve], after: Sequence[Curve]) -> bool:
    """Whether these are curves of the last step asked about, and points have moved in it and no more."""
    was, now, moved = _last_moved
    if was is None or now is None or moved is None:
        return False
    return was.curves is before and now.curves is after


def _moved_points(before: Document, after: Document) -> list[Point] | None:
    places = reshaped_curves(before, after)
    if places is None:
        return None
    old, new = list[Point](), list[Point]()
    for place in places:
        was, now = before.curves[place].points, after.curves[place].points
        old += compress(was, map(is_not, now, was))
        new += compress(now, map(is_not, now, was))
    return new if have_only_moved(old, new) else None
