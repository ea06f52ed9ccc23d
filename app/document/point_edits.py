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
    """Insert points before point `index`; an `index` equal to the number of points appends them."""
    for point in points:
        _check_point(point, "the point")
    old = document.curves[curve].points
    return _with_points(document, curve, (*old[:index], *points, *old[index:]))


def append_point(document: Document, curve: int, point: Point, *, parameter_scale: float = 1.0) -> Document:
    """Append a point; explicit derivatives are rescaled so that the curve drawn so far keeps its shape.

    Where a rule gives the parameters, those of the old points move into a part of the interval when a point
    is appended. `parameter_scale` is the factor dt_new / dt_old: velocities per unit of t grow by
    1/parameter_scale, accelerations by its square, and handles stay where they are.
    """
    checked_vector(point.position, "the point")
    old = (rescaled(old_point, parameter_scale) for old_point in document.curves[curve].points)
    return _with_points(document, curve, (*old, point))


def set_points(document: Document, curve: int, points: Iterable[Point]) -> Document:
    """Replace all points; every number is checked."""
    points = tuple(points)
    for index, point in enumerate(points):
        _check_point(point, f"point {index}")
    return _with_points(document, curve, points)


def _check_point(point: Point, subject: str) -> None:
    checked_vector(point.position, subject)
    if point.t is not None:
        checked(point.t, f"The t of {subject}")
    for _, name in VECTORS:
        vector = getattr(point, name)
        if vector is not None:
            checked_vector(vector, f"the {name.partition('_')[0]} of {subject}")


def delete_points(document: Document, curve: int, indices: Collection[int]) -> Document:
    """Remove the points at `indices`; a closed curve with too few points left is opened."""
    old = document.curves[curve]
    remaining = [point for i, point in enumerate(old.points) if i not in indices]
    if len(remaining) < old.family.least_to_close and old.closed:
        document = document.with_curve(curve, replace(old, closed=False))
    return with_moved_points(document, curve, remaining)


def set_position(document: Document, curve: int, index: int, position: Vector) -> Document:
    """Move point `index` to `position`."""
    points = list(document.curves[curve].points)
    points[index] = moved_to(points[index], position, f"point {index}")
    return with_moved_points(document, curve, points)


def move_points(document: Document, curve: int, indices: Collection[int], by: Vector) -> Document:
    """Move the points at `indices` with their handles by the vector `by`; handles of other points stay."""
    return shift_points(document, curve, indices, translation(by))


def translation(by: Vector) -> PointsChange:
    """Return the change that moves points by the vector `by`."""
    x, y = float(by[0]), float(by[1])
    return lambda points: all_moved_to(
        points, [point.x + x for point in points], [point.y + y for point in points]
    )


PointsChange = Callable[[Sequence[Point]], Iterable[Point]]
"""Change of some points: a function that returns one new point for each."""


def shift_points(document: Document, curve: int, indices: Collection[int], shift: PointsChange) -> Document:
    """Move the points at `indices` by the same vector; if these are all points, nothing else changes."""
    old = document.curves[curve]
    if len(indices) < len(old.points):
        return change_points(document, curve, indices, shift)
    return document.with_curve(curve, replace(old, points=tuple(shift(old.points))))


def change_points(document: Document, curve: int, indices: Collection[int], change: PointsChange) -> Document:
    """Replace the points at `indices` by the result of `change`; they move together."""
    points = list(document.curves[curve].points)
    for index, point in zip(indices, change([points[index] for index in indices]), strict=True):
        points[index] = point
    return with_moved_points(document, curve, points, indices)


def moved_to(point: Point, position: Vector, subject: str = "the point") -> Point:
    """Return a point at another position; refuse positions that a document may not hold."""
    x, y = checked_vector(position, subject)
    return replace(point, x=x, y=y)


def all_moved_to(points: Sequence[Point], xs: Sequence[float], ys: Sequence[float]) -> list[Point]:
    """Return points at other positions, as `moved_to` does, but fast: thousands at every move of a drag."""
    if not (are_within(xs) and are_within(ys)):
        # A position must be refused, or its numbers are not plain yet.
        return [moved_to(*pair) for pair in zip(points, zip(xs, ys, strict=True), strict=True)]
    return [replace(point, x=x, y=y) for point, x, y in zip(points, xs, ys, strict=True)]


def with_moved_points(
    document: Document, curve: int, points: Iterable[Point], together: Collection[int] = ()
) -> Document:
    """Replace all points by the same points at other positions, or by fewer.

    Handles of points that did not move stay, and curve pieces between points that moved `together` keep their
    shape.
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
    """Set the velocity of point `index`, per unit of t; None leaves it to the rule.

    At a corner it is the velocity before the point or, if `ahead`, the one after it.
    """
    return set_derivative(document, curve, index, 1, velocity, ahead=ahead)


def set_derivative(
    document: Document, curve: int, index: int, order: int, vector: Vector | None, *, ahead: bool = False
) -> Document:
    """Set the derivative of an order at point `index`, per unit of t; None leaves it to the rule.

    At a corner it is the derivative before the point or, if `ahead`, the one after it. Where the two
    velocities are tied, the other one is turned as well.
    """
    if vector is not None:
        vector = checked_vector(vector, f"the {DERIVATIVES[order - 1].name} of point {index}")
    changed = with_derivative(document.curves[curve], index, order, vector, ahead=ahead)
    return _with_point(document, curve, index, changed)


def explicit_points(curve: Curve, indices: Collection[int]) -> frozenset[int]:
    """Return the points, of `indices`, at which a derivative of the family is set."""
    orders, points = range(1, curve.family.derivatives + 1), curve.points
    return frozenset(i for i in indices if any(any(points[i].explicit_sides(order)) for order in orders))


def clear_derivatives(
    document: Document, curve: int, indices: Collection[int], orders: Collection[int] | None = None
) -> Document:
    """Leave the derivatives of these orders to the rules, at the points at `indices`.

    Without `orders`, those that the family has. Corners stay, and each side is estimated for itself; where
    velocities were tied the point stays smooth, with one estimate for both sides.
    """
    old = document.curves[curve]
    orders = range(1, old.family.derivatives + 1) if orders is None else orders
    points = list(old.points)
    for index in indices:
        cleared = replace(points[index], **dict.fromkeys(name for order, name in VECTORS if order in orders))
        points[index] = cleared.without_corner() if 1 in orders and cleared.tied else cleared
    return _with_points(document, curve, points)


def make_corner(
    document: Document,
    curve: int,
    index: int,
    before: Vector | None,
    after: Vector | None,
    *,
    even: bool = False,
) -> Document:
    """Make point `index` a corner with these velocities (None: estimated); tied where it is to be `even`."""
    point, what = document.curves[curve].points[index].as_corner(), f"the velocity of point {index}"
    before, after = (vector and checked_vector(vector, what) for vector in (before, after))
    corner = replace(point, velocity=before, velocity_after=after, tied=even, even=even)
    return _with_point(document, curve, index, corner)


class JetValue(msgspec.Struct, frozen=True):
    """A position (order 0) or a derivative of some order that a point gets.

    At a corner, `ahead` selects the side after the point; elsewhere it has no effect.
    """

    index: int
    order: int
    ahead: bool
    value: Vector


def with_jet_values(curve: Curve, values: Iterable[JetValue]) -> Curve:
    """Return a curve with these positions and explicit derivatives.

    At a tied point the velocity on the other side is turned as well.
    """
    points = list(curve.points)
    for value in values:
        points[value.index] = _with_value(curve, points[value.index], value)
    return replace(curve, points=tuple(points))


def _with_value(curve: Curve, point: Point, given: JetValue) -> Point:
    if given.order == 0:
        x, y = checked_vector(given.value, f"the position of point {given.index}")
        return replace(point, x=x, y=y)
    name = DERIVATIVES[given.order - 1].name
    vector = checked_vector(given.value, f"the {name} of point {given.index}")
    return with_derivative(curve, given.index, given.order, vector, ahead=given.ahead, point=point)
