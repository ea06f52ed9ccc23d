"""Curvature made continuous by the smallest change: of handle lengths for cubics, else of accelerations.

At a joint two sides meet: those of a point, or the ends of two curves. The point and its tangent stay. On a
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
from collections.abc import Collection, Mapping, Sequence
from itertools import chain, combinations, product
from typing import NamedTuple

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore.arrays import FloatArray

from ..document.constraints import PARALLEL, angle_between
from ..document.derivatives import DERIVATIVES
from ..document.model import Curve, Vector
from ..document.point_group import PointGroup
from ..document.words import angle
from ..families import titles_with_derivatives
from .curve.curve_view import CurveView, view_of
from .curve.distances import dense, largest_distance
from .geometry import size_of
from .point_kinds import inner_points

_EQUAL, _ROUNDING, _MATCHED = 1e-12, 2.0**-50, 1e-9
"""Relative differences of two curvatures: the largest for which nothing is changed, that by rounding, and the
largest of matched ones, as in the joint certificate."""

_FLAT = 1e-12
"""Height over the tangent, relative to the distance from the point, that counts as 0."""

_MEET = 1e-9
"""Distance, relative to the size of two curves, up to which two ends are one point."""

_LEAST_STEPS, _MOST_STEPS, _MOST_HALVINGS = 30, 45, 12
"""Steps to the least change; all steps, and halvings of one, after which joints count as incompatible."""

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
    taken = set[Side]()
    for one, other in chain(combinations(ends, 2), product(ends, others)):
        if one != other and taken.isdisjoint((one, other)) and _meet(views, one, other):
            taken |= {one, other}
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
    other
        What else the curvature depends on: the height of the far handle's tip, or the speed.
    curvature
        The curvature.
    is_length
        Whether `value` is the length of a handle.
    far
        The side at the other end of the segment.
    """

    outwards: Vector
    value: float
    other: float
    curvature: float
    is_length: bool
    far: Side


def _bend(views: Mapping[int, CurveView], side: Side) -> Bend:
    view, towards = views[side.curve], 1 if side.ahead else -1
    jet, h = _jet(views, side), view.spacing(side.point, ahead=side.ahead) or 0.0
    far = Side(side.curve, (side.point + towards) % len(view.points), not side.ahead)
    speed, is_cubic = math.hypot(*jet[1]), view.source.family.derivatives == 1
    if not speed:
        return Bend((0.0, 0.0), 0.0, 0.0, 0.0, is_cubic, far)
    x, y = (towards / speed * jet[1]).tolist()
    if not is_cubic:
        normal = float(x * jet[2, 1] - y * jet[2, 0])
        return Bend((x, y), normal, speed, normal / speed**2, is_cubic, far)
    far_point, far_velocity = _jet(views, far)
    arm = far_point - towards * h / 3 * far_velocity - jet[0]
    height, length = float(x * arm[1] - y * arm[0]), h * speed / 3
    height = height if abs(height) > _FLAT * math.hypot(*arm) else 0.0
    return Bend((x, y), length, height, 2 / 3 * height / length**2, is_cubic, far)


def _jet(views: Mapping[int, CurveView], side: Side) -> FloatArray:
    sides = views[side.curve].sides
    assert sides is not None
    jet: FloatArray = sides[side.ahead][side.point]
    return jet


def _refusal(first: Bend, second: Bend) -> str:
    """Return why the curvatures of two sides cannot be matched; empty where they can."""
    if not any(first.outwards) or not any(second.outwards):
        return "a handle lies on the point"
    if (turn := math.pi - angle_between(first.outwards, second.outwards)) > PARALLEL:
        return f"the tangents differ by {angle(math.degrees(turn))}"
    if first.is_length is not second.is_length:
        return "one curve is cubic, the other is not"
    if not first.is_length or first.curvature == second.curvature == 0.0:
        return ""
    if not (first.curvature and second.curvature):
        return "the curve is straight on one side"
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
        The changed curves by their indices.
    joints
        The joints at which something was changed.
    refusals
        The joints at which it is not possible, with the reason.
    change
        The largest distance by which a point of the curves moved.
    """

    curves: Mapping[int, Curve]
    joints: Sequence[Joint]
    refusals: Mapping[Joint, str]
    change: float


def matched(views: Sequence[CurveView], joints: Sequence[Joint]) -> Matched:
    """Return the curves with continuous curvature at those of some joints where it is possible."""
    start = {side.curve: views[side.curve] for joint in joints for side in joint}
    rigid = {curve: why for curve, view in start.items() if (why := _why_rigid(view))}
    refusals = {joint: rigid[side.curve] for joint in joints for side in joint if side.curve in rigid}
    while True:
        search = _Search(start, [joint for joint in joints if joint not in refusals])
        refused = search.run()
        if not refused:
            break
        refusals |= refused
    after = {curve: view for curve, view in search.views.items() if view is not start[curve]}
    knots = {curve: dense(view.parameters) for curve, view in after.items()}
    changes = (largest_distance(start[curve], t, after[curve], t) for curve, t in knots.items())
    curves = {curve: view.source for curve, view in after.items()}
    return Matched(curves, search.changed_joints, refusals, max(changes, default=0.0))


def _why_rigid(view: CurveView) -> str:
    """Return why nothing of a curve can be changed to match its curvature; empty where it can."""
    family = view.source.family
    if view.problem or family.derivatives:
        return view.problem
    assert view.curve is not None
    if all(joint.geometric > 1 for joint in curvecore.joint_report(view.curve, closed=view.source.is_closed)):
        return f"the curvature of {family.a_curve} is continuous already"
    return f"{family.a_curve} has no handles; choose {titles_with_derivatives()}"


class _Search:
    """Search for the nearest values with equal curvatures at joints; `views` are the present curves."""

    def __init__(self, start: Mapping[int, CurveView], joints: Sequence[Joint]) -> None:
        self._start, self._joints = start, joints
        self.views = start
        self._bends = self._first = [_bend(start, side) for joint in joints for side in joint]
        self._is_changed = np.zeros(len(joints), dtype=bool)

    @property
    def changed_joints(self) -> list[Joint]:
        """The joints at which values were changed."""
        return [joint for joint, new in zip(self._joints, self._is_changed, strict=True) if new]

    def run(self) -> dict[Joint, str]:
        """Search, and return the joints that cannot be matched, with the reasons; empty if all are."""
        if refusals := self._refusals:
            return refusals
        values = first = np.array([bend.value for bend in self._first])
        for step in range(_MOST_STEPS):
            self._is_changed |= self._unevenness > _EQUAL
            if not (self._unevenness[self._is_changed] > _ROUNDING).any():
                return {}
            # Where points affect each other much that converges slowly: then to values near the last ones.
            following = self._following(values, first if step < _LEAST_STEPS else values)
            for _ in range(_MOST_HALVINGS):
                self._put(following)
                if not (refusals := self._refusals):
                    break
                following = (following + values) / 2
            else:
                return {next(iter(refusals)): _INCOMPATIBLE}
            values = following
        worst = int(np.argmax(self._unevenness))
        return {self._joints[worst]: _INCOMPATIBLE} if self._unevenness[worst] > _MATCHED else {}

    @property
    def _pairs(self) -> list[tuple[Bend, Bend]]:
        return list(zip(self._bends[::2], self._bends[1::2], strict=True))

    @property
    def _refusals(self) -> dict[Joint, str]:
        pairs = zip(self._joints, self._pairs, strict=True)
        return {joint: why for joint, pair in pairs if (why := _refusal(*pair))}

    @property
    def _unevenness(self) -> FloatArray:
        return np.array([_unevenness(*pair) for pair in self._pairs])

    def _following(self, values: FloatArray, origin: FloatArray) -> FloatArray:
        """Return the nearest values to `origin` with which the linearised differences vanish."""
        differences, slopes = np.zeros(len(self._joints)), np.zeros((len(self._joints), len(values)))
        column_of = {side: column for column, side in enumerate(chain.from_iterable(self._joints))}
        for column, bend in enumerate(self._bends):
            row, sign = column // 2, 1.0 - 2.0 * (column % 2)
            if not bend.is_length:
                differences[row] += bend.curvature
                slopes[row, column] = 1.0 / bend.other**2
                continue
            # Of logarithms: a ratio of curvatures is a ratio of heights and lengths.
            differences[row] += sign * math.log(abs(bend.curvature))
            slopes[row, column] = -2.0 * sign / bend.value
            if (of_far := column_of.get(bend.far)) is not None:
                (x, y), (far_x, far_y) = bend.outwards, self._bends[of_far].outwards
                slopes[row, of_far] += sign * (x * far_y - y * far_x) / bend.other
        columns = np.repeat(self._is_changed, 2)
        slopes, rest = slopes[self._is_changed][:, columns], differences[self._is_changed]
        rest = slopes @ (values - origin)[columns] - rest
        result = values.copy()
        result[columns] = origin[columns] + slopes.T @ np.linalg.solve(slopes @ slopes.T, rest)
        return result

    def _put(self, values: FloatArray) -> None:
        """Give the changed joints other values."""
        points = {curve: list(view.source.points) for curve, view in self._start.items()}
        sides = zip(chain.from_iterable(self._joints), self._first, values.tolist(), strict=True)
        changed = set[int]()
        for (side, bend, value), is_changed in zip(sides, np.repeat(self._is_changed, 2), strict=True):
            if is_changed:
                point = points[side.curve][side.point]
                if not point.corner and side.point in inner_points(
                    self._start[side.curve].source, [side.point]
                ):
                    point = replace(point.as_corner(), tied=True)
                row = DERIVATIVES[0 if bend.is_length else 1]
                name = row.after if point.corner and side.ahead else row.name
                points[side.curve][side.point] = replace(
                    point, even=point.even and not bend.is_length, **{name: self._vector(side, bend, value)}
                )
                changed.add(side.curve)
        self.views = {
            curve: view_of(replace(view.source, points=tuple(points[curve])), view)
            if curve in changed
            else view
            for curve, view in self._start.items()
        }
        self._bends = [_bend(self.views, side) for side in chain.from_iterable(self._joints)]

    def _vector(self, side: Side, bend: Bend, value: float) -> Vector:
        """Return the velocity, or the acceleration, on a side with another value."""
        _, velocity, *higher = _jet(self._start, side)
        normal = np.array([-bend.outwards[1], bend.outwards[0]])
        changed = (
            velocity * (value / bend.value) if bend.is_length else higher[0] + normal * (value - bend.value)
        )
        x, y = changed.tolist()
        return x, y
