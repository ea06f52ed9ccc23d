"""Points put elsewhere, one or many at once; what no document may hold is refused."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from .limits import are_within, checked_vector
from .model import Point, Vector


def placed(point: Point, position: Vector, what: str = "the point") -> Point:
    """Return a point at another position, if a document may hold that."""
    x, y = checked_vector(position, what)
    return replace(point, x=x, y=y)


def all_placed(points: Sequence[Point], xs: Sequence[float], ys: Sequence[float]) -> list[Point]:
    """Return points at other positions, as `placed` each: thousands at every move of a drag."""
    if not (are_within(xs) and are_within(ys)):
        # One of them is to be refused, or its numbers are not plain yet.
        return [placed(*each) for each in zip(points, zip(xs, ys, strict=True), strict=True)]
    return [replace(point, x=x, y=y) for point, x, y in zip(points, xs, ys, strict=True)]
