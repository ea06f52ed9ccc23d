"""Ties: velocities before and after a point that go the same way, each at a speed of its own.

A point that is tied is a corner whose two velocities are parallel: the curve has a tangent there (G¹), and
its two handles have lengths of their own, or, where it is even, are as long as each other. Whoever turns one
velocity turns the other along, and a straight segment beside the point gives both their direction. No Qt, no
arrays.
"""

from __future__ import annotations

import math

from msgspec.structs import replace

from .derivatives import DERIVATIVES
from .lines import line_beside
from .model import Curve, Point, Vector

PARALLEL = 1e-9
"""Angle in radians up to which two velocities go the same way: what the certificate of joints takes for
none. Turning one to the other leaves some 1e-16."""


def angle_between(v: Vector, w: Vector) -> float:
    """Return the angle between two vectors, 0 to π; 0 where one of them is zero and has no direction."""
    (a, b), (c, d) = unit(v), unit(w)
    return 2.0 * math.atan2(math.hypot(a - c, b - d), math.hypot(a + c, b + d)) if any(v) and any(w) else 0.0


def unit(v: Vector) -> Vector:
    """Return the direction of a vector, zero where it has none."""
    largest = max(abs(v[0]), abs(v[1]))
    if not largest:
        return (0.0, 0.0)
    # Scaled first: the square of a small number vanishes.
    x, y = v[0] / largest, v[1] / largest
    length = math.hypot(x, y)
    return (x / length, y / length)


def turned(v: Vector, along: Vector) -> Vector:
    """Return a vector as long as `v` that goes the way of `along`; where that is zero, `v` itself."""
    if not any(along) or unit(v) == unit(along):
        return v
    (x, y), length = unit(along), math.hypot(*v)
    return (length * x, length * y)


def holds(point: Point) -> bool:
    """Whether the two velocities of a point are what a tie says: both set, and parallel."""
    before, after = point.velocity, point.velocity_after
    return (
        point.corner and before is not None and after is not None and angle_between(before, after) <= PARALLEL
    )


def tied(point: Point, before: Vector, after: Vector, h: tuple[float, float] = (1.0, 1.0)) -> Point:
    """Return a point whose velocities are tied: the shorter handle is turned to the longer.

    `h` are the lengths in t of the segments before and after it, which handles are in proportion to.
    """
    if h[0] * math.hypot(*before) < h[1] * math.hypot(*after):
        before = turned(before, after)
    else:
        after = turned(after, before)
    cornered = point if point.corner else point.as_corner()
    return replace(cornered, tied=True, velocity=before, velocity_after=after)


def tied_if_parallel(point: Point) -> Point:
    """Return a corner whose velocities go the same way as tied: nothing turns there. Others as they are."""
    return replace(point, tied=True) if holds(point) else untied(point)


def untied(point: Point) -> Point:
    """Return a point whose velocities are free of each other, themselves what they are."""
    return replace(point, tied=False, even=False) if point.tied else point


BY_HAND = math.radians(5)
"""Angle up to which a handle drawn by hand beside a straight line means the direction of the line."""


def tied_to_line(curve: Curve, index: int) -> Point:
    """Return point `index` of a curve, tied where a handle goes on from a line beside it, or nearly so."""
    point = curve.points[index]
    before, after = point.velocity, point.velocity_after
    if before is None or after is None or angle_between(before, after) > BY_HAND:
        return point
    behind, ahead = (line_beside(curve, index, ahead=each) for each in (False, True))
    if behind is ahead:
        return point
    if behind:
        return replace(point, tied=True, velocity_after=turned(after, before))
    return replace(point, tied=True, velocity=turned(before, after))


def with_derivative(
    curve: Curve,
    index: int,
    order: int,
    vector: Vector | None,
    *,
    ahead: bool,
    point: Point | None = None,
) -> Point:
    """Return point `index` of a curve with another derivative on one side, and what is tied to that.

    Of a tied point the velocity on the other side turns along and keeps its length, or where it is even, its
    share of the other's. Where a straight segment
    lies there, it stays straight: the velocity goes along it, as far as it did. One that is left to the rules
    (None) ends the tie. `point` stands for the one of the curve where that has been changed already.
    """
    point, each = point or curve.points[index], DERIVATIVES[order - 1]
    name, other = (each.after, each.name) if point.corner and ahead else (each.name, each.after)
    if not point.tied or order > 1:
        return replace(point, **{name: vector})
    if vector is None:
        return replace(untied(point), **{name: None})
    held: Vector = getattr(point, other)
    was: Vector = getattr(point, name)
    if line_beside(curve, index, ahead=not ahead):
        x, y = unit(held)
        far = max(vector[0] * x + vector[1] * y, 0.0)
        vector = (far * x, far * y)
        return replace(point, **{name: vector} | ({other: _in_step(held, was, vector)} if point.even else {}))
    other_way = _in_step(held, was, vector) if point.even else turned(held, vector)
    return replace(point, **{name: vector, other: other_way})


def _in_step(held: Vector, was: Vector, vector: Vector) -> Vector:
    """Return the velocity across an even point: along `vector`, at its speed by the ratio that there was.

    Handles that are equally long stay so, whatever the lengths of the segments are: speeds go by their ratio.
    """
    length = math.hypot(*was)
    if not length or not any(held) or not any(vector):
        return turned(held, vector)
    (x, y), far = unit(vector), math.hypot(*vector) * (math.hypot(*held) / length)
    return (far * x, far * y)


def along_lines(curve: Curve, index: int) -> Point:
    """Return point `index` with its tie kept, where straight segments beside it may have turned.

    One line gives the velocity on its other side the direction; two of different directions end the tie.
    """
    point = curve.points[index]
    if not point.tied or point.velocity is None or point.velocity_after is None:
        return untied(point)
    if line_beside(curve, index, ahead=True):
        if not line_beside(curve, index, ahead=False):
            return replace(point, velocity=turned(point.velocity, point.velocity_after))
        return point if holds(point) else untied(point)
    return replace(point, velocity_after=turned(point.velocity_after, point.velocity))
