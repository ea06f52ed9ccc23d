"""From one value to the next, as under a drag: what is the same object has not changed.

Asked at every move of a mouse, so that no field is looked at by Python itself.
"""

from __future__ import annotations

from itertools import compress
from operator import attrgetter, is_, is_not
from typing import TypeAlias

from .model import Curve, Document, Point

_besides_curves = attrgetter(*(name for name in Document.__struct_fields__ if name != "curves"))
_besides_points = attrgetter(*(name for name in Curve.__struct_fields__ if name != "points"))
_besides_place = attrgetter(*(name for name in Point.__struct_fields__ if name not in ("x", "y")))


_Step: TypeAlias = tuple[Document | None, Document | None, list[int] | None]

_last: _Step = (None, None, None)


def reshaped(before: Document, after: Document) -> list[int] | None:
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
    for place in places:
        if not differ_in_points(old[place], new[place]):
            return None
    return places


def differ_in_points(before: Curve, after: Curve) -> bool:
    """Whether all but the points is the same of two curves, and how many these are."""
    same_number = len(before.points) == len(after.points)
    return same_number and all(map(is_, _besides_points(before), _besides_points(after)))


def has_only_moved(before: Point, after: Point) -> bool:
    """Whether all but the place is the same of two points."""
    return all(map(is_, _besides_place(before), _besides_place(after)))
