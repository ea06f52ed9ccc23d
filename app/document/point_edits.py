"""Edits of the points of a curve: inserted, moved, removed, their derivatives, corners.

`curve` is the index of the curve in the document, `index` and `indices` those of points in the curve.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence

import msgspec
from msgspec.structs import replace

from .constraints import rescaled, with_derivative, with_handles_kept
from .derivatives import DERIVATIVES, VECTORS
from .limits import are_within, checked, checked_vector
from .model import Curve, Document, Point, Vector
from .rule_edits import with_room_to_close

# Points


def insert_points(document: Document, curve: int, index: int, points: Sequence[Point]) -> Document:
    """Insert `points` before point `index`; `index` equal to the number of points appends."""
    for point in points:
        _check_point(point, "the point")
    old = document.curves[curve].points
    return _with_points(document, curve, (*old[:index], *points, *old[index:]))


def append_point(document: Document, curve: int, point: Point, *, parameter_scale: float = 1.0) -> Document:
    """Append `point`; derivatives set before are rescaled so that the shape drawn so far stays.

    Under an automatic rule the parameters of the old points are squeezed into a part of the interval when
    a point is appended. `parameter_scale` is that factor, dt_new / dt_old; a velocity per unit of t grows by
    1/parameter_scale, an acceleration by its square, and the handles stay where the person put them.
    """
    checked_vector(point.position, "the point")
    old = (rescaled(each, parameter_scale) for each in document.curves[curve].points)
    return _with_points(document, curve, (*old, point))


def set_points(document: Document, curve: int, points: Iterable[Point]) -> Document:
    """Put `points` in the place of all points; every number is checked."""
    points = tuple(points)
    for index, point in enumerate(points):
        _check_point(point, f"point {index}")
    return _with_points(document, curve, points)


def _check_point(point: Point, what: str) -> None:
    checked_vector(point.position, what)
    if point.t is not None:
        checked(point.t, f"The t of {what}")
    for _, name in VECTORS:
        vector = getattr(point, name)
        if vector is not None:
            checked_vector(vector, f"the {name.partition('_')[0]} of {what}")


def delete_points(document: Document, curve: int, indices: Collection[int]) -> Document:
    """Remove the points at `indices`; a closed curve that has too few left to close is open from then on."""
    old = document.curves[curve]
    kept = [point for i, point in enumerate(old.points) if i not in indices]
    if len(kept) < old.family.least_to_close and old.closed:
        document = document.with_curve(curve, replace(old, closed=False))
    return with_moved_points(document, curve, kept)


def set_position(document: Document, curve: int, index: int, position: Vector) -> Document:
    """Put point `index` at `position`."""
    points = list(document.curves[curve].points)
    points[index] = moved_to(points[index], position, f"point {index}")
    return with_moved_points(document, curve, points)


def move_points(document: Document, curve: int, indices: Collection[int], by: Vector) -> Document:
    """Move the points at `indices` by the vector `by`; their handles go along, those of others stay."""
    return shift_points(document, curve, indices, translation(by))


def translation(by: Vector) -> PointsChange:
    """Return what puts points elsewhere, by the vector `by`."""
    x, y = float(by[0]), float(by[1])
    return lambda points: all_moved_to(
        points, [each.x + x for each in points], [each.y + y for each in points]
    )


PointsChange = Callable[[Sequence[Point]], Iterable[Point]]
"""What is made of some points, one of each."""


def shift_points(document: Document, curve: int, indices: Collection[int], shift: PointsChange) -> Document:
    """Put the points at `indices` elsewhere, all by the same way; of a whole curve nothing else changes."""
    old = document.curves[curve]
    if len(indices) < len(old.points):
        return change_points(document, curve, indices, shift)
    return document.with_curve(curve, replace(old, points=tuple(shift(old.points))))


def change_points(document: Document, curve: int, indices: Collection[int], change: PointsChange) -> Document:
    """Put what `change` makes of them in the place of the points at `indices`, which go together."""
    points = list(document.curves[curve].points)
    for index, point in zip(indices, change([points[index] for index in indices]), strict=True):
        points[index] = point
    return with_moved_points(document, curve, points, indices)


def moved_to(point: Point, position: Vector, what: str = "the point") -> Point:
    """Return a point at another position, if a document may hold that."""
    x, y = checked_vector(position, what)
    return replace(point, x=x, y=y)


def all_moved_to(points: Sequence[Point], xs: Sequence[float], ys: Sequence[float]) -> list[Point]:
    """Return points at other positions, as `moved_to` each: thousands at every move of a drag."""
    if not (are_within(xs) and are_within(ys)):
        # One of them is to be refused, or its numbers are not plain yet.
        return [moved_to(*each) for each in zip(points, zip(xs, ys, strict=True), strict=True)]
    return [replace(point, x=x, y=y) for point, x, y in zip(points, xs, ys, strict=True)]


def with_moved_points(
    document: Document, curve: int, points: Iterable[Point], together: Collection[int] = ()
) -> Document:
    """Put `points`, the same at other places or fewer, in the place of all.

    The handles of those that stay stay, and those of points that went `together` keep their shape.
    """
    old = document.curves[curve]
    new = with_room_to_close(replace(old, points=tuple(points)))
    return document.with_curve(curve, with_handles_kept(old, new, together))


def _with_points(document: Document, curve: int, points: Iterable[Point]) -> Document:
    return document.with_curve(
        curve, with_room_to_close(replace(document.curves[curve], points=tuple(points)))
    )


def _with_point(document: Document, curve: int, index: int, point: Point) -> Document:
    points = document.curves[curve].points
    return _with_points(document, curve, (*points[:index], point, *points[index + 1 :]))


# Derivatives and corners


def set_velocity(
    document: Document, curve: int, index: int, velocity: Vector | None, *, ahead: bool = False
) -> Document:
    """Fix the velocity of point `index`, per unit of t, or leave it to the rule (None).

    At a corner the one before the point, or the one `ahead` of it.
    """
    return set_derivative(document, curve, index, 1, velocity, ahead=ahead)


def set_derivative(
    document: Document, curve: int, index: int, order: int, vector: Vector | None, *, ahead: bool = False
) -> Document:
    """Fix the derivative of an order at point `index`, per unit of t, or leave it to the rule (None).

    At a corner the one before the point, or the one `ahead` of it; where the two are tied, the other velocity
    turns along.
    """
    if vector is not None:
        vector = checked_vector(vector, f"the {DERIVATIVES[order - 1].name} of point {index}")
    changed = with_derivative(document.curves[curve], index, order, vector, ahead=ahead)
    return _with_point(document, curve, index, changed)


ALL_ORDERS = range(1, len(DERIVATIVES) + 1)


def clear_derivatives(
    document: Document, curve: int, indices: Collection[int], orders: Collection[int] = ALL_ORDERS
) -> Document:
    """Leave the derivatives of these orders of the points at `indices` to the rules."""
    cleared: dict[str, object] = dict.fromkeys(name for order, name in VECTORS if order in orders)
    if 1 in orders:
        cleared["tied"] = False
    points = document.curves[curve].points
    return _with_points(
        document,
        curve,
        (replace(point, **cleared) if index in indices else point for index, point in enumerate(points)),
    )


def make_corner(
    document: Document, curve: int, index: int, before: Vector | None, after: Vector | None
) -> Document:
    """Let the curve have a corner at point `index`, with these velocities (None: estimated)."""
    point = document.curves[curve].points[index]
    corner = replace(point.as_corner(), velocity=before, velocity_after=after, tied=False)
    return _with_point(document, curve, index, corner)


def make_smooth(document: Document, curve: int, index: int, velocity: Vector | None) -> Document:
    """Give point `index` one velocity on both sides (None: estimated)."""
    point = document.curves[curve].points[index]
    smooth = replace(point.without_corner(), velocity=velocity)
    return _with_point(document, curve, index, smooth)


class JetValue(msgspec.Struct, frozen=True):
    """A position (order 0) or a derivative of some order that a point is to have.

    `ahead` chooses the side at a corner; elsewhere both sides are one.
    """

    index: int
    order: int
    ahead: bool
    value: Vector


def with_jet_values(curve: Curve, values: Iterable[JetValue]) -> Curve:
    """Return `curve` with these values set; derivatives among them are explicit from then on.

    Of a tied point the velocity on the other side turns along.
    """
    points = list(curve.points)
    for each in values:
        points[each.index] = _with_value(curve, points[each.index], each)
    return replace(curve, points=tuple(points))


def _with_value(curve: Curve, point: Point, given: JetValue) -> Point:
    if given.order == 0:
        x, y = checked_vector(given.value, f"the position of point {given.index}")
        return replace(point, x=x, y=y)
    each = DERIVATIVES[given.order - 1]
    vector = checked_vector(given.value, f"the {each.name} of point {given.index}")
    return with_derivative(curve, given.index, given.order, vector, ahead=given.ahead, point=point)
