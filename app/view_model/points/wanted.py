"""Derivatives that the points of a curve are to have: set by hand only where rules estimate others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec.structs import replace

from ...document.model import Curve, Point, Vector, vectors_of
from ...document.ties import tied_if_parallel
from ..curve.curve_view import CurveView, view_of

SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

_UNSEEN = 1e-4
"""The same for what a rule estimates: it stays an estimate where it changes by less."""

_ROUNDS = 3
"""Times that a look is taken at what rules estimate otherwise since something was set."""

Derivatives = list[Vector]
"""Derivatives at one side of a point, by their orders from 1 on."""


def with_wanted(curve: Curve, wanted: Mapping[tuple[int, bool], Derivatives]) -> Curve:
    """Return a curve with these derivatives of points, before (False) and after (True), set where needed."""
    for _ in range(_ROUNDS if wanted else 0):
        before, curve = curve, _a_round(view_of(curve), wanted)
        if curve.points == before.points:
            break
    return curve


def _a_round(view: CurveView, wanted: Mapping[tuple[int, bool], Derivatives]) -> Curve:
    points = list(view.source.points)
    for index, point in enumerate(points):
        sides = [wanted.get((index, ahead)) for ahead in (False, True)]
        is_off = [side is not None and not _has(view, index, side, ahead) for ahead, side in enumerate(sides)]
        if any(is_off):
            points[index] = with_sides(point, *sides)
    return replace(view.source, points=tuple(points))


def _has(view: CurveView, index: int, side: Derivatives, ahead: int) -> bool:
    """Whether a point has these derivatives on a side."""
    now = [view.derivative_of(index, order, ahead=bool(ahead)) for order in range(1, len(side) + 1)]
    within = SAME if any(vectors_of(view.source.points[index])) else _UNSEEN
    return all(own is not None and _alike(own, each, within) for own, each in zip(now, side, strict=True))


def _alike(one: Sequence[float], other: Sequence[float], within: float = SAME) -> bool:
    largest = max(map(abs, (*one, *other)))
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) <= within * largest


def with_sides(point: Point, before: Derivatives | None, after: Derivatives | None) -> Point:
    """Return a point with derivatives set on the sides where there is curve; one that was smooth still is."""
    before, after = before or after or [], after or before or []
    if not point.corner and all(map(_alike, before, after)):
        return point.with_derivatives(before, ())
    was_corner = point.corner and not point.tied
    made = replace(point.as_corner(), tied=False).with_derivatives(before, after)
    return made if was_corner else tied_if_parallel(made)
