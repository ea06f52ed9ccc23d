"""Curvature made continuous by the smallest change: of handle lengths for cubics, else of accelerations.

At a joint two sides meet: those of a point, or the ends of two curves. The point stays, and its tangent where
it is one: tangents that differ by up to two degrees are turned to their mean direction first. On a
cubic the curvature at an end is two thirds of the height of the far handle's tip over the tangent, divided by
the square of the length of the near handle ("harmonised" handles of type design have one curvature); with
accelerations it is their normal part divided by the square of the speed.

The heights depend on the handles of the neighbours, which a rule may estimate from what is set here, or which
change at the same time. So this is Newton's method on the curves as they are with each result, each step to
the nearest values to the first ones with which the linearised differences of curvatures vanish [1]_. That the
estimates of neighbours answer counts in the curvatures, not in their slopes.

References
----------
.. [1] J. Nocedal and S. Wright, "Numerical Optimization", 2nd ed., Springer 2006, section 18.1: sequential
   quadratic programming, here with the identity for the Hessian of the Lagrangian.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import chain, combinations, product
from typing import NamedTuple

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore.arrays import BoolArray, FloatArray

from ..document.constraints import PARALLEL, angle_between, turned_along, with_derivative
from ..document.derivatives import DERIVATIVES
from ..document.model import Curve, Vector
from ..document.point_group import PointGroup
from ..document.words import number
from ..families import titles_with_derivatives
from .curve.core_curve import Sides, sides_of
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense, largest_distance
from .curve.point_arrays import arrays_of
from .geometry import size_of
from .point_kinds import inner_points

_EQUAL, _MATCHED = 1e-12, 1e-9
"""Relative differences of two curvatures: the largest for which nothing is changed, and that of matched
ones, as in the joint certificate."""

_FLAT = 1e-12
"""Height over the tangent, relative to the distance from the point, that counts as 0."""

_MEET = 1e-9
"""Distance, relative to the size of two curves, up to which two ends are one point."""

MOST_JOINTS = 60
"""Joints that are matched at once: all affect each other, and more take longer than a window may wait."""

_LEAST_STEPS, _MOST_STEPS = 20, 50
"""Steps to the least change, and all steps, after which joints count as incompatible."""

_TURNED = math.radians(2.0)
"""Angle between tangents up to which they are turned into line."""

_INCOMPATIBLE = "no handles were found that suit the other points as well"


class Side(NamedTuple):
    """One side of a joint: the segment before or after a point of a curve."""

    curve: int
    point: int
    ahead: bool


Joint = tuple[Side, Side]
"""Two sides that meet: of one point, or of the ends of two curves."""


def joints_of(views: Sequence[CurveView], points: PointGroup, whole_curves: Collection[int]) -> list[Joint]:
    """Return the joints of a selection: inner points, and ends that meet.

    A selected end meets another selected end, or else that of any visible curve. Without selected points
    these are the ends of whole curves.
    """
    joints, ends = list[Joint](), list[Side]()
    for curve, indices in points.parts:
        inner = inner_points(views[curve].source, indices)
        joints += [(Side(curve, point, ahead=False), Side(curve, point, ahead=True)) for point in inner]
        ends += [end for end in _ends(views, curve) if end.point in indices]
    if not points.parts:
        ends = [end for curve in sorted(whole_curves) for end in _ends(views, curve)]
    others = [end for curve in range(len(views)) for end in _ends(views, curve)] if points.parts else []
    joined = set[Side]()
    for one, other in chain(combinations(ends, 2), product(ends, others)):
        if one != other and joined.isdisjoint((one, other)) and _meet(views, one, other):
            joined |= {one, other}
            joints.append((one, other))
    return joints


def _ends(views: Sequence[CurveView], curve: int) -> list[Side]:
    """Return the ends of a visible open curve."""
    view = views[curve]
    if view.source.is_closed or not (view.source.visible and view.is_current):
        return []
    return [Side(curve, 0, ahead=True), Side(curve, len(view.points) - 1, ahead=False)]


def _meet(views: Sequence[CurveView], one: Side, other: Side) -> bool:
    """Whether two ends are one point."""
    points = [views[end.curve].points for end in (one, other)]
    return math.dist(points[0][one.point], points[1][other.point]) <= _MEET * size_of(np.vstack(points))


# The curvature of a side


class Bend(NamedTuple):
    """One side of a joint in numbers; signs are those of a curve that leaves the joint.

    Attributes
    ----------
    outwards
        The unit tangent away from the joint; zero where the curve stands still.
    value
        What is changed: the length of the handle, or the normal part of the acceleration.
    is_length
        Whether it is the length of a handle.
    curvature
        The curvature.
    slope
        Its derivative by `value`.
    far
        The side at the other end of the segment.
    far_slope
        The derivative of the curvature by the height of the far handle's tip; 0 for accelerations.
    """

    outwards: Vector
    value: float
    is_length: bool
    curvature: float
    slope: float
    far: Side
    far_slope: float


def _bends(sides: Sequence[Side], start: Mapping[int, CurveView], curves: Mapping[int, Curve]) -> list[Bend]:
    """Return sides of curves in numbers, given their views at first; parameters have not changed."""
    jets = {
        curve: sides_of(new, start[curve].at_knots, start[curve].parameters, arrays_of(new.points))
        for curve, new in curves.items()
    }
    return [_bend(start[side.curve], jets[side.curve], side) for side in sides]


def _bend(view: CurveView, jets: Sides, side: Side) -> Bend:
    towards, jet = 1 if side.ahead else -1, jets[side.ahead][side.point]
    h = view.spacing(side.point, ahead=side.ahead) or 0.0
    far = Side(side.curve, (side.point + towards) % len(view.points), not side.ahead)
    speed, is_cubic = math.hypot(*jet[1]), view.source.family.derivatives == 1
    if not speed:
        return Bend((0.0, 0.0), 0.0, is_cubic, 0.0, 0.0, far, 0.0)
    x, y = (towards / speed * jet[1]).tolist()
    if not is_cubic:
        normal, slope = x * float(jet[2, 1]) - y * float(jet[2, 0]), 1.0 / speed**2
        return Bend((x, y), normal, is_cubic, slope * normal, slope, far, 0.0)
    far_point, far_velocity = jets[far.ahead][far.point]
    arm = far_point - towards * h / 3 * far_velocity - jet[0]
    height, length = x * float(arm[1]) - y * float(arm[0]), h * speed / 3
    far_slope = 2 / 3 / length**2
    curvature = far_slope * height if abs(height) > _FLAT * math.hypot(*arm) else 0.0
    return Bend((x, y), length, is_cubic, curvature, -2.0 * curvature / length, far, far_slope)


def _refusal(first: Bend, second: Bend) -> str:
    """Return why the curvatures of two sides cannot be matched; empty where they can."""
    if not any(first.outwards) or not any(second.outwards):
        return "a handle lies on the point"
    if (turn := math.pi - angle_between(first.outwards, second.outwards)) > PARALLEL:
        return f"the tangents differ by {number(math.degrees(turn), 2)}°"
    if first.is_length is not second.is_length:
        return "one curve is cubic, the other is not"
    if not first.is_length or first.curvature == second.curvature == 0.0:
        return ""
    if not (first.curvature and second.curvature):
        return "the curvature is 0 on one side"
    return "the curve bends to opposite sides" if first.curvature * second.curvature > 0.0 else ""


def _unevenness(first: Bend, second: Bend) -> float:
    """Return the relative difference of the curvatures of two sides."""
    largest = max(abs(first.curvature), abs(second.curvature))
    return abs(first.curvature + second.curvature) / largest if largest else 0.0


# The smallest change


class Matched(msgspec.Struct, frozen=True):
    """Curves with continuous curvature at some joints.

    Attributes
    ----------
    curves
        The curves by their indices.
    joints
        The joints at which something was changed.
    refusals
        The joints at which it is not possible, with the reason.
    turn
        The largest angle in radians between tangents that were turned into line; 0 for none.
    """

    curves: Mapping[int, Curve]
    joints: Sequence[Joint]
    refusals: Mapping[Joint, str]
    turn: float = 0.0

    @property
    def changed_curves(self) -> dict[int, Curve]:
        """The changed curves by their indices."""
        changed = {side.curve for side in chain.from_iterable(self.joints)}
        return {curve: self.curves[curve] for curve in sorted(changed)}

    def largest_change(self, before: Sequence[CurveView]) -> float:
        """Return the largest distance by which a point of the curves moved."""
        at = {curve: dense(before[curve].parameters) for curve in self.changed_curves}
        after = {curve: view_of(self.curves[curve]) for curve in at}
        return max(largest_distance(before[curve], t, after[curve], t) for curve, t in at.items())


def matched(views: Sequence[CurveView], joints: Sequence[Joint]) -> Matched:
    """Return the curves with continuous curvature at those of some joints where it is possible."""
    start = {side.curve: views[side.curve] for side in chain.from_iterable(joints)}
    rigid = {curve: why for curve, view in start.items() if (why := _why_rigid(view))}
    refusals = {joint: rigid[side.curve] for joint in joints for side in joint if side.curve in rigid}
    others = {curve: view for curve, view in start.items() if curve not in rigid}
    while (result := _searched(others, [joint for joint in joints if joint not in refusals])).refusals:
        refusals |= result.refusals
    return replace(result, refusals=refusals)


def _why_rigid(view: CurveView) -> str:
    """Return why nothing of a curve can be changed to match its curvature; empty where it can."""
    family = view.source.family
    if view.problem or family.derivatives:
        return view.problem
    if all(
        joint.geometric > 1
        for joint in curvecore.joint_report(view.present_curve, closed=view.source.is_closed)
    ):
        return f"the curvature of {family.a_curve} is continuous already"
    return f"{family.a_curve} has no handles; choose {titles_with_derivatives()}"


def _searched(start: Mapping[int, CurveView], joints: Sequence[Joint]) -> Matched:
    """Search for the nearest values with equal curvatures at joints."""
    start, turns = _in_line(start, joints)
    sides, curves = list(chain.from_iterable(joints)), {curve: view.source for curve, view in start.items()}
    first = bends = _bends(sides, start, curves)
    if refusals := _refusals(joints, bends):
        return Matched(curves, (), refusals)
    least, is_changed = math.inf, np.array([joint in turns for joint in joints], dtype=bool)
    values = last = origin = np.array([bend.value for bend in first])
    for step in range(_MOST_STEPS):
        if _refusals(joints, bends):
            values = (values + last) / 2
        else:
            unevenness = np.array([_unevenness(*pair) for pair in _pairs(bends)])
            is_changed |= unevenness > _EQUAL
            largest = unevenness[is_changed].max(initial=0.0)
            is_end = step >= _LEAST_STEPS or largest <= _EQUAL
            if largest == 0.0 or (is_end and least / 2 < largest <= _MATCHED):
                break
            # Towards the least change it converges slowly where points affect each other much; to values near
            # the last ones in a few steps, until rounding is left.
            last = values
            least, origin = (largest, values) if is_end else (math.inf, origin)
            values = _following(sides, bends, values, origin, np.repeat(is_changed, 2))
        changes = zip(sides, first, values.tolist(), np.repeat(is_changed, 2), strict=True)
        changed = ((side, bend, value) for side, bend, value, is_new in changes if is_new)
        curves = _with_values(start, changed)
        bends = _bends(sides, start, curves)
    pairs = zip(joints, _pairs(bends), strict=True)
    uneven = [joint for joint, pair in pairs if _refusal(*pair) or _unevenness(*pair) > _MATCHED]
    if uneven:
        return Matched(curves, (), {uneven[0]: _INCOMPATIBLE})
    matched_joints = [joint for joint, is_new in zip(joints, is_changed, strict=True) if is_new]
    return Matched(curves, matched_joints, {}, max(turns.values(), default=0.0))


def _in_line(
    start: Mapping[int, CurveView], joints: Sequence[Joint]
) -> tuple[Mapping[int, CurveView], Mapping[Joint, float]]:
    """Return curves with nearly parallel tangents turned to their mean, and the angles between those.

    The mean is weighted by the lengths of handles. A side without curvature, such as a straight one, is kept.
    """
    curves, turns = {curve: view.source for curve, view in start.items()}, dict[Joint, float]()
    bends = _bends([*chain.from_iterable(joints)], start, curves)
    for joint, (one, other) in zip(joints, _pairs(bends), strict=True):
        turn = math.pi - angle_between(one.outwards, other.outwards)
        if not (PARALLEL < turn <= _TURNED and one.curvature and other.curvature):
            continue
        turns[joint] = turn
        a, b = (one.value, other.value) if one.is_length and other.is_length else (1.0, 1.0)
        x, y = (a * out - b * back for out, back in zip(one.outwards, other.outwards, strict=True))
        for side, sign in zip(joint, (1, -1), strict=True):
            curve, (_, point, ahead), along = curves[side.curve], side, sign if side.ahead else -sign
            velocity = start[side.curve].velocity_of(point, ahead=ahead) or (0.0, 0.0)
            turned = turned_along(velocity, (along * x, along * y))
            new = with_derivative(curve, point, 1, turned, ahead=ahead)
            points = (*curve.points[:point], new, *curve.points[point + 1 :])
            curves[side.curve] = replace(curve, points=points)
    return {curve: view_of(new) for curve, new in curves.items()} if turns else start, turns


def _pairs(bends: Sequence[Bend]) -> list[tuple[Bend, Bend]]:
    return list(zip(bends[::2], bends[1::2], strict=True))


def _refusals(joints: Sequence[Joint], bends: Sequence[Bend]) -> dict[Joint, str]:
    return {joint: why for joint, pair in zip(joints, _pairs(bends), strict=True) if (why := _refusal(*pair))}


def _following(
    sides: Sequence[Side],
    bends: Sequence[Bend],
    values: FloatArray,
    origin: FloatArray,
    is_changed: BoolArray,
) -> FloatArray:
    """Return the nearest values to `origin` with which the linearised differences of curvatures vanish."""
    slopes = np.zeros((len(sides) // 2, len(sides)))
    columns = {side: column for column, side in enumerate(sides)}
    for column, bend in enumerate(bends):
        slopes[column // 2, column] += bend.slope
        if bend.far in columns:
            (x, y), (far_x, far_y) = bend.outwards, bends[columns[bend.far]].outwards
            slopes[column // 2, columns[bend.far]] += bend.far_slope * (x * far_y - y * far_x)
    differences = np.array([first.curvature + second.curvature for first, second in _pairs(bends)])
    rows, slopes = is_changed[::2], slopes[:, is_changed]
    rest = (slopes @ (values - origin)[is_changed] - differences)[rows]
    slopes = slopes[rows]
    result = values.copy()
    result[is_changed] = origin[is_changed] + slopes.T @ np.linalg.solve(slopes @ slopes.T, rest)
    return result


def _with_values(
    start: Mapping[int, CurveView], changes: Iterable[tuple[Side, Bend, float]]
) -> dict[int, Curve]:
    """Return the curves with other values on some sides, given their first numbers."""
    points = {curve: list(view.source.points) for curve, view in start.items()}
    for side, bend, value in changes:
        view = start[side.curve]
        x, y = view.velocity_of(side.point, ahead=side.ahead) or bend.outwards
        changed = (value / bend.value * x, value / bend.value * y)
        if not bend.is_length:
            x, y = view.derivative_of(side.point, 2, ahead=side.ahead) or (0.0, 0.0)
            by = value - bend.value
            changed = (x - by * bend.outwards[1], y + by * bend.outwards[0])
        point = points[side.curve][side.point]
        if not point.corner and inner_points(view.source, [side.point]):
            point = replace(point.as_corner(), tied=True)
        row = DERIVATIVES[0 if bend.is_length else 1]
        name = row.after if point.corner and side.ahead else row.name
        is_even = point.even and not bend.is_length
        points[side.curve][side.point] = replace(point, even=is_even, **{name: changed})
    return {curve: replace(view.source, points=tuple(points[curve])) for curve, view in start.items()}
