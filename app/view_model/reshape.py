"""Other points for the same curve: all derivatives set, one point more, the order reversed.

A polynomial through more points than it needs, or a Hermite piece cut where its derivatives are known, stays
the same curve. The change by rounding, or by a rule for the parameters, is measured, never assumed: every
result has the largest distance by which a point of the curve moved.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import count

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.families.chain import joint_of_row

from .. import view_model
from ..document.constraints import is_straight, rescaled_beside, tie_if_parallel
from ..document.curve_edits import reverse_curve
from ..document.limits import EditError
from ..document.model import Curve, Document, ParametrizationKind, Point, Vector
from ..document.point_edits import JetValue, clear_derivatives, with_jet_values
from ..document.rule_edits import freeze_parameters
from ..document.words import number
from ..families import HERMITE, Family
from .curve.core_curve import Sides, sides_of
from .curve.curve_view import CurveView, ParametricCurve, view_of
from .curve.distances import dense, keeps_shape, largest_distance, outcome

SAME_PARAMETER = 1e-9
"""Share of the domain up to which two parameters are those of one point."""

_ROUNDING = 1e-12
"""Share of the largest coordinate by which an estimate may move the curve and count as the same."""

_MOST_ATTEMPTS = 8
"""Attempts to set the nearest estimates alone, before all that would move are set."""


class Reshaped(msgspec.Struct, frozen=True):
    """A curve through other points.

    Attributes
    ----------
    curve
        The new curve.
    residual
        The largest distance by which a point of the curve moved, measured on dense samples.
    parameters_moved
        Whether the rule gave the old points other parameters, which changed the shape.
    left_rule
        Whether the parameters had to become manual for the shape to stay.
    note
        A further sentence; empty for none.
    """

    curve: Curve
    residual: float
    parameters_moved: bool = False
    left_rule: bool = False
    note: str = ""

    @property
    def keeps_shape(self) -> bool:
        """Whether the shape is the same but for roundings."""
        return not self.parameters_moved and keeps_shape(self.residual, (self.curve,))

    @property
    def sentence(self) -> str:
        """The outcome for the shape."""
        if self.parameters_moved:
            return f"The parameters changed: largest change {number(self.residual, 2)}."
        words = outcome(self.residual, (self.curve,))
        manual = "The parameters are now manual." if self.left_rule else ""
        return " ".join(part for part in (words[0].upper() + words[1:], manual, self.note) if part)


def frozen(view: CurveView) -> CurveView:
    """Return the curve with its parameters as manual ones."""
    refuse_without_curve(view)
    document = freeze_parameters(Document((view.source,)), 0, view.parameters.tolist())
    return view_of(document.curves[0])


def refuse_without_curve(view: CurveView) -> None:
    """Raise EditError where the present points and rules give no curve."""
    if not view.is_current:
        raise EditError(f"There is no curve yet. {view.problem}")


def convert_first(view: CurveView) -> str:
    """Return the advice to convert a curve to a cubic Hermite one first, and how far that keeps its shape."""
    within = view_model.convert.outlook(view, HERMITE).within
    how = f"within {number(within, 1)}" if within else "keeping the shape"
    return f"Convert it to {HERMITE.title} first, {how}."


def with_jets(point: Point, sides: Sides, index: int) -> Point:
    """Return `point` with explicit derivatives, those at knot `index`, on both sides of a corner."""
    before, after = (list(map(_vector, jets[index, 1:])) for jets in sides)
    return point.with_derivatives(before, after) if before else point


def _vector(values: FloatArray) -> Vector:
    return (float(values[0]), float(values[1]))


# Insert


def with_point_inserted(view: CurveView, t: float) -> Reshaped:
    """Return the curve with one more point, on the curve at `t`.

    The curve stays the same to rounding: the derivatives at `t` become explicit, and so do those of other
    points whose estimates the new point would change. Where a rule would change the parameters, and with them
    the shape, they become manual. Control points get one more, and others move. A family that has no such
    curve keeps the rule, derivatives are rescaled, and the shape changes by the residual.

    Raises
    ------
    EditError
        If there is no curve, `t` is not inside it, or a point is there already.
    """
    refuse_without_curve(view)
    index = _checked_index(view, t)
    longer = view.present_curve.refined(t)
    if longer is not None:
        with_knot = through(view, longer)
        left_rule = with_knot.is_manual and not view.source.is_manual
        at = dense(longer.parameters)
        return Reshaped(with_knot, largest_distance(view, at, view_of(with_knot), at), left_rule=left_rule)
    by_rule = _with_point_at(view, index, t)
    if view.source.is_manual or by_rule.keeps_shape:
        return by_rule
    frozen_result = _with_point_at(frozen(view), index, t)
    return replace(frozen_result, left_rule=True) if frozen_result.keeps_shape else by_rule


def _with_point_at(view: CurveView, index: int, t: float) -> Reshaped:
    """Return the curve with a point of it at `t` inserted at `index`, under the rule of its parameters."""
    curve, point = view.source, _sampled(view, t)
    if is_straight(curve, index - 1):
        # Two straight segments: whichever end of one moves, it stays straight.
        point = point.as_corner()
    if curve.is_manual:
        grown = _with_point_of_curve(view, index, point)
        after = view_of(grown)
        return Reshaped(grown, change_of_shape(view, after, after.parameters))
    point = replace(point, t=None)
    grown = replace(curve, points=(*curve.points[:index], point, *curve.points[index:]))
    grown, knots = _stretched_along(view, grown, index, t), np.insert(view.parameters, index, t)
    free = grown if point.corner else clear_derivatives(Document((grown,)), 0, [index]).curves[0]
    moved = change_of_shape(view, view_of(free), knots)
    if not keeps_shape(moved, (free,)):
        free, moved = grown, change_of_shape(view, view_of(grown), knots)
    return Reshaped(free, moved, parameters_moved=not keeps_shape(moved, (free,)))


def _with_point_of_curve(view: CurveView, index: int, point: Point) -> Curve:
    """Return the curve with a point of it at `index`, which is estimated if that keeps the shape."""
    curve, every = view.source, np.arange(len(view.source.points) + 1)
    grown = replace(curve, points=(*curve.points[:index], point, *curve.points[index:]))
    if view.sides is None:
        return grown
    jet = [
        point.position,
        *(point.explicit_sides(order)[0] for order in range(1, curve.family.derivatives + 1)),
    ]
    was = Sides(*(np.insert(side, index, np.array(jet), axis=0) for side in view.sides))
    if not point.corner:
        estimated = clear_derivatives(Document((grown,)), 0, [index]).curves[0]
        if with_sides_kept(was, estimated, every, every) == estimated:
            return estimated
    return with_sides_kept(was, grown, every, every)


def inserted_index(view: CurveView, t: float) -> int:
    """Return the index of the point that `with_point_inserted` makes: the control point nearest to `t`."""
    longer = view.curve.refined(t) if view.curve is not None and view.is_current else None
    if longer is None:
        return int(np.searchsorted(view.parameters, t))
    return int(np.argmin(np.abs(longer.nodes - t)))


def through(view: CurveView, curve: ParametricCurve, family: Family | None = None) -> Curve:
    """Return the curve of a view with the points and parameters of `curve`, which has the same shape.

    The rule for the parameters stays where it gives this shape; else they become manual. Points that keep
    their positions keep their other values. `curve` is of the same family if none is given.
    """
    source, known = view.source, {point.position: point for point in view.source.points}
    family = family or source.family
    is_closed = source.is_closed and family.curve_class.can_close
    count = len(curve.parameters) - is_closed
    corners = _corners_of(curve, is_closed=is_closed)
    rows = zip(curve.points.tolist(), curve.parameters.tolist(), strict=True)
    points = [
        replace(
            known.get((x, y), Point(x, y)), x=x, y=y, t=t, corner=index in corners, tied=False, even=False
        )
        for index, ((x, y), t) in enumerate(rows)
    ]
    start, end = curve.domain
    rule = replace(source.parametrization, start=start, end=end)
    result = replace(
        source.with_family(family), points=tuple(points[:count]), parametrization=rule, closed=is_closed
    )
    result = with_jet_values(result, _given(curve, len(result.points), has_corner=0 in corners))
    result = replace(result, points=tuple(_tied_as(known.get(new.position), new) for new in result.points))
    if not source.is_manual and (after := view_of(result)).is_current:
        t = dense(curve.parameters)
        away = float(np.abs(after.present_curve.evaluate(t) - curve.evaluate(t)).max())
        if keeps_shape(away, (result,)):
            return replace(result, points=tuple(replace(point, t=None) for point in result.points))
    return replace(result, parametrization=replace(rule, kind=ParametrizationKind.MANUAL))


def _tied_as(before: Point | None, point: Point) -> Point:
    """Return a point with its velocities tied where they were before and are still parallel."""
    if before is None or not before.tied:
        return point
    again = tie_if_parallel(point.as_corner())
    return again if again.tied else point


def _corners_of(curve: ParametricCurve, *, is_closed: bool) -> set[int]:
    """Return the points at which derivatives before and after differ: where pieces of a chain meet."""
    joints = joint_of_row(curve)
    corners = set(joints[1:][np.diff(joints) == 0].tolist())
    first, last = curve.jets[0, 1:], curve.jets[-1, 1:]
    scale = np.abs(curve.jets[:, 1:]).max(axis=(0, 2))[:, None] if len(first) else 0.0
    return corners | {0} if is_closed and (np.abs(first - last) > 1e-10 * scale).any() else corners


def _given(curve: ParametricCurve, count: int, *, has_corner: bool) -> Iterator[JetValue]:
    """Yield the derivatives at points as values to set.

    Of a closed curve, whose last row is its first point again, that row belongs to a corner there.
    """
    joints = joint_of_row(curve).tolist()
    for row, (joint, jet) in enumerate(zip(joints, curve.jets, strict=True)):
        if joint == count and not has_corner:
            continue
        ahead = row + 1 < len(joints) and joints[row + 1] != joint
        for order, derivative in enumerate(jet[1:], start=1):
            yield JetValue(joint % count, order, ahead, _vector(derivative))


def _checked_index(view: CurveView, t: float) -> int:
    knots = view.parameters
    if not knots[0] < t < knots[-1]:
        raise EditError(f"No point can be inserted at t = {view.t_text(t)}: it is not inside the curve.")
    away = np.where(view.present_curve.idle_parameters, np.inf, np.abs(knots - t))
    nearest = int(np.argmin(away))
    if away[nearest] <= SAME_PARAMETER * (knots[-1] - knots[0]):
        point = view.owner(nearest)
        what = f"Point {point}" if view.source.family.interpolates else f"The knot at t of point {point}"
        raise EditError(f"{what} is already there.")
    return int(np.searchsorted(knots, t))


def _sampled(view: CurveView, t: float) -> Point:
    """Return a point on the curve at `t` with the derivatives there."""
    orders = range(view.source.family.derivatives + 1)
    position, *derivatives = (_vector(view.present_curve.evaluate(t, order)) for order in orders)
    return Point(*position, t=t).with_derivatives(derivatives, ())


def with_sides_kept(was: Sides, changed: Curve, old: IntArray, new: IntArray) -> Curve:
    """Return `changed` with those estimates set that would move the curve away from the jets `was`.

    The rows `old` of the jets are those of the points `new`. What is set holds the estimates beyond it where
    a spline estimates them: so points beside others that are set come first, and lower orders.
    """
    for attempt in count():
        after = view_of(changed)
        refuse_without_curve(after)
        assert after.sides is not None
        is_given = ~np.isnan(after.arrays.given[new, :, : was.before.shape[1] - 1, 0])
        pairs = zip(was, after.sides, strict=True)
        moved = np.stack([_moves(after, *pair, old, new) for pair in pairs], axis=1) & ~is_given
        if not moved.any():
            break
        moved[:, :, moved.any(axis=(0, 1)).argmax() + 1 :] = False
        holds = np.zeros(len(changed.points), dtype=np.bool_)
        holds[new] = is_given.any(axis=(1, 2))
        nearest = moved & (np.roll(holds, 1) | holds | np.roll(holds, -1))[new, None, None]
        rows = np.argwhere(nearest if nearest.any() and attempt < _MOST_ATTEMPTS else moved).tolist()
        changed = with_jet_values(
            changed,
            [
                JetValue(int(new[row]), k + 1, bool(side), _vector(was[side][old[row], k + 1]))
                for row, side, k in rows
            ],
        )
    return changed


def _moves(after: CurveView, was: FloatArray, now: FloatArray, old: IntArray, new: IntArray) -> BoolArray:
    """Return whether a change of a derivative moves the curve, by point and order, (m, R - 1)."""
    knots, orders = after.parameters, np.arange(1, was.shape[1])
    steps = np.diff(knots)
    longest = np.maximum(np.append(steps[0], steps), np.append(steps, steps[-1]))[new, None]
    if after.source.is_closed:
        longest[new == 0] = max(steps[0], steps[-1])
    away = np.abs(now[new, 1:] - was[old, 1:]).max(axis=2) * longest**orders
    return np.asarray(away > _ROUNDING * np.abs(after.points).max())


def with_older_estimates(document: Document) -> tuple[Document, int]:
    """Return a document as it looked with estimates of old versions, and the number of points set for it.

    Until version 3 of the file format the rules estimated derivatives from the points alone.
    """
    curves = tuple(_with_older_estimates(curve) for curve in document.curves)
    count = sum(
        sum(new is not old for old, new in zip(before.points, after.points, strict=True))
        for before, after in zip(document.curves, curves, strict=True)
        if after is not before
    )
    return (replace(document, curves=curves), count) if count else (document, 0)


def _with_older_estimates(curve: Curve) -> Curve:
    view = view_of(curve) if curve.has_derivatives else None
    if view is None or view.sides is None:
        return curve
    corners = view.arrays.corners & ~view.arrays.ties
    nothing_given = replace(view.arrays, given=np.full_like(view.arrays.given, np.nan), corners=corners)
    older = sides_of(curve, view.at_knots, view.parameters, nothing_given)
    every = np.arange(len(curve.points))
    with suppress(EditError):
        return with_sides_kept(older, curve, every, every)
    return curve


def _stretched_along(before: CurveView, grown: Curve, index: int, t: float) -> Curve:
    """Return the curve with explicit derivatives rescaled to the new parameters, so that handles stay."""
    after = view_of(grown)
    refuse_without_curve(after)
    factors = np.diff(after.parameters) / np.diff(np.insert(before.parameters, index, t))
    points = [
        rescaled_beside(point, *_factors_at(factors, point, position, index, is_closed=grown.is_closed))
        for position, point in enumerate(grown.points)
    ]
    return replace(grown, points=tuple(points))


def _factors_at(
    factors: FloatArray, point: Point, index: int, inserted: int, *, is_closed: bool
) -> tuple[float, float]:
    """Return the factors of t behind and ahead of a point: at a corner those of the segments there.

    Elsewhere the factor of a segment beside it, if possible of one that was not cut, twice.
    """
    last = len(factors) - 1
    before = last if is_closed and index == 0 else index - 1
    beside = [segment for segment in (before, index) if 0 <= segment <= last]
    if point.corner:
        return float(factors[beside[0]]), float(factors[beside[-1]])
    whole = [segment for segment in beside if segment not in (inserted - 1, inserted)]
    mean = float(np.mean(factors[whole or beside]))
    return mean, mean


def change_of_shape(before: CurveView, after: CurveView, old_knots: FloatArray) -> float:
    """Return the largest change; `old_knots` are the old parameters of the knots of `after`."""
    return largest_distance(before, dense(old_knots), after, dense(after.parameters))


# Reverse


def reversed_curve(view: CurveView) -> Reshaped:
    """Return the curve in the opposite direction.

    Raises
    ------
    EditError
        If the parameters are too close together to be reversed.
    """
    curve = reverse_curve(Document((view.source,)), 0, view.parameters.tolist()).curves[0]
    after = view_of(curve)
    if not (view.is_current and after.is_current):
        return Reshaped(curve, 0.0)
    t = dense(view.parameters)
    turned = after.parameters[-1] - (t - t[0])
    return Reshaped(curve, largest_distance(view, t, after, turned))
