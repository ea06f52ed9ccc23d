"""Handles: the Bézier control points beside a point, which a person drags to set its derivatives.

On a segment of length h a Hermite curve of degree d has beside a point p, where its derivatives are d_k, the
control points p + Σ C(m, k) (±h)ᵏ d_k / (d (d − 1) … (d − k + 1)), k from 1 to m, for m = 1, 2, …: plus ahead
of the point, minus behind it, with the h of the segment on that side. The cubic has p ± h·v/3; the quintic
p ± h·v/5 and p ± 2h·v/5 + h²·a/20; the septic p ± h·v/7, p ± 2h·v/7 + h²·a/42 and p ± 3h·v/7 + h²·a/14 ±
h³·j/210. The m-th is the handle of the derivative of order m; those below stay what they are under a drag.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from itertools import pairwise

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...document.constraints import unit_vector
from ...document.derivatives import DERIVATIVES
from ...document.limits import EditError
from ...document.model import Curve, Document, Vector
from ...document.point_edits import set_velocity
from ...document.transforms import polar_vector
from .core_curve import Sides
from .curve_view import CurveView
from .moving import Displacement


class Handle(msgspec.Struct, frozen=True):
    """One handle of a point.

    Attributes
    ----------
    order
        The order of the derivative: 1 for a velocity.
    ahead
        Whether it belongs to the segment after the point.
    position
        The position in the plane.
    anchor
        The start of the line to it: the point, or the handle of the derivative below.
    explicit
        Whether the person set the value; else a rule estimates it.
    index
        The index of its point.
    """

    order: int
    ahead: bool
    position: Vector
    anchor: Vector
    explicit: bool
    index: int = 0


class Handles(msgspec.Struct, frozen=True, eq=False):
    """Handles of points, in arms: an arm has those on one side of a point, each attached to the one before.

    Attributes
    ----------
    indices, ahead
        The point of each arm, and whether the arm lies on the segment after it; (a,).
    arms
        The point and then the handles of its arm, by the orders of the derivatives, (a, 1 + orders, 2).
    explicit
        Whether the person set the derivatives, (a, orders).
    """

    indices: IntArray
    ahead: BoolArray
    arms: FloatArray
    explicit: BoolArray

    def __len__(self) -> int:
        return self.explicit.size

    def __getitem__(self, number: int) -> Handle:
        arm, order = divmod(number, self.explicit.shape[1])
        (x0, y0), (x, y) = self.arms[arm, order : order + 2].tolist()
        side, is_explicit = bool(self.ahead[arm]), bool(self.explicit[arm, order])
        return Handle(order + 1, side, (x, y), (x0, y0), is_explicit, int(self.indices[arm]))

    def __iter__(self) -> Iterator[Handle]:
        return map(self.__getitem__, range(len(self)))

    @property
    def positions(self) -> FloatArray:
        """The positions of the handles, one arm after the other, (k, 2)."""
        return self.arms[:, 1:].reshape(-1, 2)

    @property
    def lines(self) -> FloatArray:
        """The lines to the handles from their anchors, (k, 4)."""
        return np.concatenate([self.arms[:, :-1], self.arms[:, 1:]], axis=2).reshape(-1, 4)

    def of_velocities(self) -> Handles:
        """Return the handles of the velocities alone."""
        return Handles(self.indices, self.ahead, self.arms[:, :2], self.explicit[:, :1])

    def of_arms(self, which: BoolArray | slice) -> Handles:
        """Return the handles of some of the arms."""
        return Handles(self.indices[which], self.ahead[which], self.arms[which], self.explicit[which])


NO_HANDLES = Handles(
    np.empty(0, dtype=np.intp), np.empty(0, dtype=bool), np.empty((0, 2, 2)), np.empty((0, 1), dtype=bool)
)


class PointSides(msgspec.Struct, frozen=True, eq=False):
    """Sides of points: the indices of the points, and whether it is the side ahead of them; (a,) each."""

    indices: IntArray
    ahead: BoolArray


NO_SIDES = PointSides(np.empty(0, dtype=np.intp), np.empty(0, dtype=np.bool_))


class _Arms(msgspec.Struct, frozen=True, eq=False):
    """Sides of points, and the signed lengths of the segments there; (a,) each."""

    indices: IntArray
    ahead: BoolArray
    h: FloatArray


def handles_of(view: CurveView, index: int) -> list[Handle]:
    """Return the handles of point `index`, as `handles_at` does."""
    return list(handles_at(view, [index]))


def handles_at(view: CurveView, indices: Collection[int]) -> Handles:
    """Return the handles of some points, as `handles_on` their sides."""
    return handles_on(view, sides_at(indices))


def sides_at(indices: Collection[int]) -> PointSides:
    """Return both sides of some points."""
    if not len(indices):
        return NO_SIDES
    return PointSides(
        np.repeat(np.array(sorted(indices), dtype=np.intp), 2), np.tile([True, False], len(indices))
    )


def sides_facing(indices: Collection[int], count: int, *, closed: bool) -> PointSides:
    """Return the sides of other points at the far ends of the segments beside some points.

    The curve has `count` points; sides of the points themselves are left out.
    """
    if not len(indices):
        return NO_SIDES
    points = np.array(sorted(indices), dtype=np.intp)
    facing = np.concatenate([points - 1, points + 1])
    if closed:
        facing %= count
    is_other = (facing >= 0) & (facing < count) & ~np.isin(facing, points)
    return PointSides(facing[is_other], np.repeat([True, False], len(points))[is_other])


def handles_on(view: CurveView, sides: PointSides, *, free: bool = False) -> Handles:
    """Return the handles on sides of points; none for Lagrange, or while there is no curve.

    With `free` an end of the curve has handles on its free side as well, mirrored from the other. A point
    that stands alone has the handle that was pulled out of it.
    """
    if not view.source.family.derivatives or not len(sides.indices):
        return NO_HANDLES
    if len(view.source.points) == 1:
        return _lone_handle(view)
    if not view.is_current:
        return NO_HANDLES
    if view.is_followed and view.displacement is not None:
        return _moved_handles(view, view.displacement, sides, free=free)
    assert view.sides is not None
    return _handles_from(view, view.sides, _arms(view, sides, free=free))


def _arms(view: CurveView, sides: PointSides, *, free: bool) -> _Arms:
    """Return the sides of points on which there is a segment; with `free` all of them."""
    indices, ahead = sides.indices, sides.ahead
    t, last = view.parameters, len(view.parameters) - 1
    # Behind its first point a closed curve has its last knot.
    knots = np.where((indices == 0) & ~ahead & view.source.is_closed, last, indices)
    others = knots + np.where(ahead, 1, -1)
    is_there = (others >= 0) & (others <= last)
    mirrored = np.where(is_there, others, 2 * knots - others)
    h = np.where(ahead, 1.0, -1.0) * np.abs(t[mirrored] - t[knots])
    return _Arms(indices, ahead, h) if free else _Arms(indices[is_there], ahead[is_there], h[is_there])


def _handles_from(view: CurveView, sides: Sides, arms: _Arms) -> Handles:
    """Return the handles of arms of a curve with these jets."""
    orders = view.source.family.derivatives
    jets = np.where(arms.ahead[:, None, None], sides.after[arms.indices], sides.before[arms.indices])
    controls = _control_points(jets, arms.h, _degree(view))
    given = view.arrays.given[arms.indices, arms.ahead.astype(np.intp), :orders, 0]
    return Handles(arms.indices, arms.ahead, controls, ~np.isnan(given))


def _control_points(jets: FloatArray, h: FloatArray, degree: int) -> FloatArray:
    """Return the control points of jets (a, R, 2) on segments of signed lengths h (a,), (a, R, 2)."""
    controls = np.repeat(jets[:, :1], jets.shape[1], axis=1)
    # Far outside they are infinite, and not drawn.
    with np.errstate(over="ignore", invalid="ignore"):
        for index in range(1, jets.shape[1]):
            for order in range(1, index + 1):
                share = math.comb(index, order) * h**order / math.perm(degree, order)
                controls[:, index] += share[:, None] * jets[:, order]
    return controls


def _moved_handles(view: CurveView, displacement: Displacement, sides: PointSides, *, free: bool) -> Handles:
    """Return handles while points are dragged: they follow by a share of the offset."""
    moves, key = displacement.moving, (id(sides), free)
    if key not in moves.handles:
        # Two: the sides of the selected points and those that face them; others belong to another selection.
        while len(moves.handles) > 1:
            moves.handles.pop(next(iter(moves.handles)))
        arms = _arms(view, sides, free=free)
        at_rest, unit = (_handles_from(view, jets, arms) for jets in (moves.at_rest, moves.unit))
        moves.handles[key] = (sides, at_rest, unit.arms[..., :1])
    _, at_rest, share = moves.handles[key]
    moved = at_rest.arms + share * displacement.offset
    return Handles(at_rest.indices, at_rest.ahead, moved, at_rest.explicit)


def control_polygon(view: CurveView) -> list[Handle]:
    """Return the sides of the polygon of control points as handles; none of a curve through its points."""
    if view.source.family.interpolates:
        return []
    points = [point.position for point in view.source.points]
    return [Handle(1, True, tip, anchor, True, at) for at, (anchor, tip) in enumerate(pairwise(points))]


def _lone_handle(view: CurveView) -> Handles:
    point = view.source.points[0]
    velocity = point.explicit_sides(1)[1]
    if velocity is None:
        return NO_HANDLES
    h = np.array([_signed_spacing(view, 0, ahead=True)])
    controls = _control_points(np.array([[point.position, velocity]]), h, _degree(view))
    return Handles(np.zeros(1, dtype=np.intp), np.ones(1, dtype=bool), controls, np.ones((1, 1), dtype=bool))


def derivative_from_handle(
    view: CurveView, index: int, order: int, position: Vector, *, ahead: bool
) -> Vector:
    """Return the derivative of an order whose handle lies at `position`, with those of lower orders fixed.

    It is infinite on an interval of almost no length, where no number is large enough: edits refuse that.
    """
    base = _controls_on(view, index, ahead, (0.0, 0.0), order)[-1]
    h = _signed_spacing(view, index, ahead=ahead)
    x, y = (math.perm(_degree(view), order) * float(a - b) for a, b in zip(position, base, strict=True))
    # Not by a power of h: it may vanish where h does not.
    for _ in range(order):
        x, y = x / h, y / h
    return (x, y)


def _controls_on(view: CurveView, index: int, ahead: bool, derivative: Vector, order: int) -> FloatArray:
    """Return a point and its control points on one side, up to that of a derivative of an order."""
    h = _signed_spacing(view, index, ahead=ahead)
    below = [view.derivative_of(index, lower, ahead=ahead) or (0.0, 0.0) for lower in range(1, order)]
    jet = [view.source.points[index].position, *below, derivative]
    return np.asarray(_control_points(np.array([jet]), np.array([h]), _degree(view))[0])


def offset_of_handle(view: CurveView, index: int, order: int, derivative: Vector, *, ahead: bool) -> Vector:
    """Return the line to the handle of a derivative from its anchor: the point, or the handle below."""
    anchor, tip = _controls_on(view, index, ahead, derivative, order)[-2:].tolist()
    return (tip[0] - anchor[0], tip[1] - anchor[1])


def derivative_of_offset(view: CurveView, index: int, order: int, offset: Vector, *, ahead: bool) -> Vector:
    """Return the derivative of an order whose handle lies at an offset from its anchor."""
    x, y = _controls_on(view, index, ahead, (0.0, 0.0), order)[-2].tolist()
    return derivative_from_handle(view, index, order, (x + offset[0], y + offset[1]), ahead=ahead)


def handle_offsets(view: CurveView, order: int, *, ahead: bool) -> FloatArray:
    """Return the lines to the handles of an order on one side of all points, from their anchors, (n, 2).

    NaN where a point has no such handle.
    """
    count = len(view.source.points)
    offsets = np.full((count, 2), np.nan)
    if view.is_current and view.sides is not None:
        # Not `handles_on`, which keeps the handles of two selections alone during a drag.
        sides = PointSides(np.arange(count), np.full(count, ahead))
        handles = _handles_from(view, view.sides, _arms(view, sides, free=False))
        offsets[handles.indices] = handles.arms[:, order] - handles.arms[:, order - 1]
    return offsets


def with_length_or_angle(
    view: CurveView,
    index: int,
    order: int,
    present: Vector,
    *,
    ahead: bool,
    length: float | None = None,
    degrees: float | None = None,
) -> Vector:
    """Return the derivative whose handle has another length or angle than that of the `present` one.

    Angles are counterclockwise from x. A velocity of no length is pulled out along the curve's points.

    Raises
    ------
    EditError
        If the point has no such handle, the length is negative, or the handle has no direction.
    """
    side = "ahead of" if ahead else "behind"
    if view.spacing(index, ahead=ahead) is None:
        raise EditError(view.problem or f"The curve ends at point {index}: there is no handle {side} it.")
    label = f"{DERIVATIVES[order - 1].name} handle {side} point {index}"
    if length is not None and length < 0.0:
        raise EditError(f"The length of the {label} is 0 or more; its angle turns it round.")
    offset = offset_of_handle(view, index, order, present, ahead=ahead)
    size = math.hypot(*offset) if length is None else length
    if not any(offset) and length and order == 1:
        x, y = _pulled(view, index, math.inf, ahead)
        offset = (x, y) if ahead else (-x, -y)
    if not any(offset) and length != 0.0:
        raise EditError(f"The {label} has no length, and so no angle. Drag it out first.")
    x, y = unit_vector(offset) if degrees is None else polar_vector(1.0, degrees)
    return derivative_of_offset(view, index, order, (size * x, size * y), ahead=ahead)


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
        for ahead in _sides_with_velocity(view, index):
            document = set_velocity(document, 0, index, _pulled(view, index, visible, ahead), ahead=ahead)
    return document.curves[0]


def _sides_with_velocity(view: CurveView, index: int) -> list[bool]:
    """Return the sides of a point with separate velocities: at a corner both, else the side ahead."""
    if not view.source.points[index].corner:
        return [True]
    return [ahead for ahead in (False, True) if view.spacing(index, ahead=ahead) is not None]


def _pulled(view: CurveView, index: int, visible: float, ahead: bool) -> Vector:
    """Return a velocity whose handle is visible: the present one, or a longer one in the same direction."""
    velocity, h = view.velocity_of(index, ahead=ahead), _signed_spacing(view, index, ahead=ahead)
    if velocity is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")
    if math.hypot(*velocity) * abs(h) / _degree(view) >= visible:
        return velocity
    if math.hypot(*velocity) > 0:
        return pulled_out(view, index, velocity, ahead=ahead)
    point = view.source.points[index]
    if not point.corner or point.tied:
        return pulled_out(view, index, offset_past(view, index), ahead=ahead)
    before, after = _neighbours(view, index)
    ends = (point.position, after) if ahead else (before, point.position)
    return pulled_out(view, index, (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]), ahead=ahead)


def pulled_out(view: CurveView, index: int, direction: Vector, *, ahead: bool) -> Vector:
    """Return the velocity in a direction whose handle is a third as long as the distance to the neighbour.

    Raises
    ------
    EditError
        If there is no direction, or no distance.
    """
    length, reach = math.hypot(*direction), _distance_to_neighbour(view, index, ahead=ahead)
    if length == 0 or reach == 0:
        raise EditError(f"The neighbours of point {index} define no direction or length of its velocity.")
    factor = reach / 3 * _degree(view) / abs(_signed_spacing(view, index, ahead=ahead)) / length
    return (direction[0] * factor, direction[1] * factor)


def offset_past(view: CurveView, index: int) -> Vector:
    """Return the offset from the point before to the point after a point."""
    before, after = _neighbours(view, index)
    return (after[0] - before[0], after[1] - before[1])


def _neighbours(view: CurveView, index: int) -> tuple[Vector, Vector]:
    """Return the positions before and after a point; at an end the point itself is one of them."""
    points, last = view.source.points, len(view.source.points) - 1
    if view.source.is_closed:
        return points[index - 1].position, points[(index + 1) % len(points)].position
    return points[max(index - 1, 0)].position, points[min(index + 1, last)].position


def _distance_to_neighbour(view: CurveView, index: int, *, ahead: bool) -> float:
    before, after = _neighbours(view, index)
    p = view.source.points[index].position
    return math.dist(p, after if ahead else before) or math.dist(p, before if ahead else after)


def _signed_spacing(view: CurveView, index: int, *, ahead: bool) -> float:
    """Return the h of one side, negative behind the point; the free side of an end has that of the other.

    The only point of a curve has the interval of the curve.
    """
    h = view.spacing(index, ahead=ahead) or view.spacing(index, ahead=not ahead)
    if h is None:
        h = view.source.parametrization.end - view.source.parametrization.start
    return h if ahead else -h


def _degree(view: CurveView) -> int:
    return 2 * view.source.family.derivatives + 1
