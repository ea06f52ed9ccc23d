"""Handles: the Bézier control points beside a point, which a person drags to set its derivatives.

On a segment of length h a Hermite curve of degree d has beside a point p, where its derivatives are d_k, the
control points p + Σ C(m, k) (±h)ᵏ d_k / (d (d − 1) … (d − k + 1)), k from 1 to m, for m = 1, 2, …: plus ahead
of the point, minus behind it, with the h of the segment on that side. The cubic has p ± h·v/3; the quintic
p ± h·v/5 and p ± 2h·v/5 + h²·a/20; the septic p ± h·v/7, p ± 2h·v/7 + h²·a/42 and p ± 3h·v/7 + h²·a/14 ±
h³·j/210. The m-th is the handle of the derivative of order m; those below stay what they are under a drag.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from itertools import pairwise
from typing import Protocol

import msgspec

from ..document.edits import EditError, set_velocity
from ..document.model import Curve, Document, Vector
from .curve_view import CurveView
from .jets import is_explicit
from .point_moves import Motion


class _Derivatives(Protocol):
    """Tells a derivative at a point of a curve, None where it has none."""

    def __call__(self, index: int, order: int, *, ahead: bool) -> Vector | None: ...


class Handle(msgspec.Struct, frozen=True):
    """One handle of a point.

    Attributes
    ----------
    kind
        The order of the derivative: 1 for a velocity.
    ahead
        Whether it belongs to the segment after the point.
    position
        Its place in the plane.
    anchor
        The beginning of the line to it: the point, or the handle of the derivative before.
    explicit
        Whether the person set the value; otherwise a rule estimates it.
    """

    kind: int
    ahead: bool
    position: Vector
    anchor: Vector
    explicit: bool


def handles_of(view: CurveView, index: int, *, free: bool = False) -> list[Handle]:
    """Return the handles of point `index`; none for Lagrange, or while there is no curve.

    With `free` an end of the curve has handles on its free side as well, mirrored from the other. A point
    that stands alone has the handle that was pulled out of it.
    """
    if len(view.source.points) == 1:
        return _lone_handle(view)
    if view.is_followed and view.motion is not None:
        return _moved_handles(view, view.motion, index, free=free)
    return _handles_at(view, index, view.source.points[index].position, view.derivative_of, free=free)


def _handles_at(
    view: CurveView, index: int, position: Vector, derivative_of: _Derivatives, *, free: bool
) -> list[Handle]:
    """Return the handles of a point, were it at this position, with these derivatives."""
    handles: list[Handle] = []
    if not view.source.family.derivatives or not view.is_current:
        return handles
    point = view.source.points[index]
    for ahead in (True, False):
        if not free and view.spacing(index, ahead=ahead) is None:
            continue
        anchor = position
        for order in range(1, view.source.family.derivatives + 1):
            tip = _control_point(view, index, position, order, order, derivative_of, ahead=ahead)
            handles.append(Handle(order, ahead, tip, anchor, is_explicit(point, order, ahead=ahead)))
            anchor = tip
    return handles


def _moved_handles(view: CurveView, motion: Motion, index: int, *, free: bool) -> list[Handle]:
    """Return the handles of a point while points are dragged: they follow by a share of the way."""
    moves, (dx, dy) = motion.moves, motion.way
    if (index, free) not in moves.handles:
        at_rest, unit = moves.at_rest, moves.unit
        moves.handles[index, free] = (
            _handles_at(view, index, at_rest.position(index), at_rest.derivative, free=free),
            _handles_at(view, index, unit.position(index), unit.derivative, free=free),
        )
    return [
        Handle(
            each.kind,
            each.ahead,
            (each.position[0] + share.position[0] * dx, each.position[1] + share.position[0] * dy),
            (each.anchor[0] + share.anchor[0] * dx, each.anchor[1] + share.anchor[0] * dy),
            each.explicit,
        )
        for each, share in zip(*moves.handles[index, free], strict=True)
    ]


def control_polygon(view: CurveView) -> list[Handle]:
    """Return the sides of the polygon of control points as handles; none of a curve through its points."""
    if view.source.family.interpolates:
        return []
    points = [point.position for point in view.source.points]
    return [Handle(1, True, tip, anchor, explicit=True) for anchor, tip in pairwise(points)]


def _lone_handle(view: CurveView) -> list[Handle]:
    point = view.source.points[0]
    velocity = point.explicit_sides(1)[1]
    if not view.source.family.derivatives or velocity is None:
        return []
    tip = _along(point.position, velocity, _signed_spacing(view, 0, ahead=True) / _degree(view))
    return [Handle(1, True, tip, point.position, explicit=True)]


def _control_point(
    view: CurveView,
    index: int,
    position: Vector,
    place: int,
    highest: int,
    derivative_of: _Derivatives,
    *,
    ahead: bool,
) -> Vector:
    """Return where the control point `place` of a point lies, were derivatives above the `highest` zero."""
    at, h = position, _signed_spacing(view, index, ahead=ahead)
    for order in range(1, highest + 1):
        derivative = derivative_of(index, order, ahead=ahead)
        if derivative is not None:
            share = math.comb(place, order) * h**order / math.perm(_degree(view), order)
            at = _along(at, derivative, share)
    return at


def derivative_from_handle(
    view: CurveView, index: int, order: int, position: Vector, *, ahead: bool
) -> Vector:
    """Return the derivative of an order whose handle lies at `position`, those below staying what they are.

    Infinite where no number is large enough, on an interval of next to no length: no edit takes that.
    """
    place = view.source.points[index].position
    base = _control_point(view, index, place, order, order - 1, view.derivative_of, ahead=ahead)
    h = _signed_spacing(view, index, ahead=ahead)
    x, y = (math.perm(_degree(view), order) * float(a - b) for a, b in zip(position, base, strict=True))
    # Not by a power of h: it may vanish where h does not.
    for _ in range(order):
        x, y = x / h, y / h
    return (x, y)


def with_velocities_pulled(view: CurveView, indices: Collection[int], visible: float) -> Curve:
    """Return the curve with explicit velocities at these points whose handles can be seen.

    A handle nearer to its point than `visible` is pulled out by a third of the way to the neighbour, in the
    direction of the velocity, or along the curve's points where that is zero.

    Raises
    ------
    EditError
        If there is no curve, or the neighbours lie at the same place.
    """
    document = Document((view.source,))
    for index in indices:
        for ahead in _own_sides(view, index):
            document = set_velocity(document, 0, index, _pulled(view, index, visible, ahead), ahead=ahead)
    return document.curves[0]


def _own_sides(view: CurveView, index: int) -> list[bool]:
    """Return the sides of a point with velocities of their own: at a corner both, else ahead of it."""
    if not view.source.points[index].corner:
        return [True]
    return [ahead for ahead in (False, True) if view.spacing(index, ahead=ahead) is not None]


def _pulled(view: CurveView, index: int, visible: float, ahead: bool) -> Vector:
    """Return a velocity whose handle can be seen: the present one, or one that points the same way."""
    velocity, h = view.velocity_of(index, ahead=ahead), _signed_spacing(view, index, ahead=ahead)
    if velocity is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")
    if math.hypot(*velocity) * abs(h) / _degree(view) >= visible:
        return velocity
    if math.hypot(*velocity) > 0:
        return pulled_out(view, index, velocity, ahead=ahead)
    point = view.source.points[index]
    if not point.corner or point.tied:
        return pulled_out(view, index, way_past(view, index), ahead=ahead)
    before, after = _neighbours(view, index)
    ends = (point.position, after) if ahead else (before, point.position)
    return pulled_out(view, index, (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]), ahead=ahead)


def pulled_out(view: CurveView, index: int, direction: Vector, *, ahead: bool) -> Vector:
    """Return the velocity in a direction whose handle is a third as long as the way to the neighbour.

    Raises
    ------
    EditError
        If there is no direction, or no way.
    """
    length, reach = math.hypot(*direction), _way_to_neighbour(view, index, ahead=ahead)
    if length == 0 or reach == 0:
        raise EditError(f"The neighbours of point {index} give its velocity no direction or length.")
    factor = reach / 3 * _degree(view) / abs(_signed_spacing(view, index, ahead=ahead)) / length
    return (direction[0] * factor, direction[1] * factor)


def way_past(view: CurveView, index: int) -> Vector:
    """Return the way from the point before to the point after one."""
    before, after = _neighbours(view, index)
    return (after[0] - before[0], after[1] - before[1])


def _neighbours(view: CurveView, index: int) -> tuple[Vector, Vector]:
    """Return the points before and after a point; at an end the point itself is one of them."""
    points, last = view.source.points, len(view.source.points) - 1
    if view.source.is_closed:
        return points[index - 1].position, points[(index + 1) % len(points)].position
    return points[max(index - 1, 0)].position, points[min(index + 1, last)].position


def _way_to_neighbour(view: CurveView, index: int, *, ahead: bool) -> float:
    before, after = _neighbours(view, index)
    p = view.source.points[index].position
    return math.dist(p, after if ahead else before) or math.dist(p, before if ahead else after)


def _signed_spacing(view: CurveView, index: int, *, ahead: bool) -> float:
    """Return the h of one side, negative behind the point; the free side of an end goes by the other.

    Of a point that stands alone, the interval that it is going to open.
    """
    h = view.spacing(index, ahead=ahead) or view.spacing(index, ahead=not ahead)
    if h is None:
        return view.source.parametrization.end - view.source.parametrization.start
    return h if ahead else -h


def _degree(view: CurveView) -> int:
    return 2 * view.source.family.derivatives + 1


def _along(p: Vector, direction: Vector, factor: float) -> Vector:
    return (p[0] + factor * direction[0], p[1] + factor * direction[1])
