"""Points appended, curves closed, points inserted in the middle of segments, at extrema and at inflections.

A handle that is pulled out is stored for both sides of its point at once: two velocities of one direction,
whose handles are equally long. The handles lie at ±h·v/3 of the segments beside the point, so that a segment
which comes later rescales the velocity of its side alone. Whatever comes, the handles stay where they were
pulled; the rules estimate higher derivatives on each side for itself.

A corner that was clicked has no handle: beside a handle that was pulled its own is retracted, and elsewhere
the rules estimate it, until it is pulled out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from functools import partial

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import CurveError, ParametricCurve
from curvecore.arrays import FloatArray

from ..document.constraints import ends_of, is_straight_beside, rescaled_beside, tied_to_straight_segment
from ..document.curve_edits import set_closed
from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.model import Curve, Document, Point, Vector, derivatives_of
from ..document.point_edits import JetValue, append_point, insert_points, make_corner, with_jet_values
from ..document.rule_edits import freeze_parameters
from ..document.words import number
from .curve.core_curve import parameters_of
from .curve.curve_view import CurveView, view_of
from .curve.handles import derivative_of_offset
from .geometry import at_knots, polygon_length, segment_at
from .reshape import (
    Reshaped,
    change_of_shape,
    convert_first,
    inserted_index,
    refuse_without_curve,
    with_point_inserted,
)

_MOST_LOCAL, _MOST_GLOBAL = 200, 24
"""Points up to which a preview takes a millisecond at each move of the pointer.

Beyond some 40 points a Lagrange curve by the distances swings so wildly that flattening it takes 5 to 80 ms.
"""


def with_point_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a new last point on its curve `curve`, which `view` shows.

    Derivatives that were set are rescaled so that handles stay. The point that was the last one of an open
    curve gets a segment on its other side, and a handle there as long as the one that was drawn. The handle
    of the only point of a curve is the one ahead of it, and stays.

    Raises
    ------
    EditError
        If a document may not hold the position.
    """
    t = appended_parameter(view, Point(*position)) if view.source.is_manual else None
    return with_points_appended(document, curve, view, [Point(*position, t=t)])


Appending = Callable[[Document, int, CurveView, Vector], Document]
"""A function that adds a last point to a curve of a document, given its view."""


def with_points_appended(
    document: Document, curve: int, view: CurveView, points: Sequence[Point]
) -> Document:
    """Return the document with `points` at the end of its curve `curve`; handles as by `with_point_appended`.

    Raises
    ------
    EditError
        If a document may not hold them.
    """
    count = len(view.source.points)
    scale = scale_of(view, replace(view.source, points=(*view.source.points, *points)))
    document = append_point(document, curve, points[0], parameter_scale=scale)
    document = insert_points(document, curve, count + 1, points[1:])
    if view.source.is_closed:
        return document
    return _with_handles_as_drawn(document, curve, view, [count - 1])


def is_quick(view: CurveView) -> bool:
    """Whether a preview of a curve with one more point can be drawn at each move of the pointer."""
    most = _MOST_LOCAL if view.source.family.curve_class.is_local else _MOST_GLOBAL
    return len(view.source.points) <= most


def view_with_point(
    document: Document,
    curve: int,
    view: CurveView,
    position: Vector,
    previous: CurveView | None = None,
    *,
    append: Appending = with_point_appended,
) -> CurveView | None:
    """Return the view of curve `curve` of the document, which `view` shows, with a last point at `position`.

    None where there is no such curve, or where it would take too long. `previous` is the last result, which
    lends what did not change; `append` adds the point.
    """
    if not view.source.points or not is_quick(view):
        return None
    try:
        longer = append(document, curve, view, position).curves[curve]
    except EditError:
        return None
    ahead = view_of(longer, previous)
    return ahead if ahead.is_current else None


def with_closed(document: Document, index: int, view: CurveView, closed: bool) -> Document:
    """Return the document with its curve `index`, which `view` shows, closed or open; handles stay.

    What was set at its ends is for both sides, as by `with_point_appended`.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    if closed and _ends_where_it_starts(view.source):
        # The segment that closes it has no length: the last point is the first.
        document = document.with_curve(index, replace(view.source, points=view.source.points[:-1]))
        return set_closed(document, index, closed)
    scale = scale_of(view, replace(view.source, closed=closed))
    document = set_closed(document, index, closed, parameter_scale=scale)
    ends = [0, len(view.source.points) - 1] if closed else []
    return _with_handles_as_drawn(document, index, view, ends)


def _ends_where_it_starts(curve: Curve) -> bool:
    """Whether the last point of an open curve lies on the first, with no derivatives set."""
    first, last = curve.points[:1], curve.points[-1:]
    is_loop = len(curve.points) > curve.family.least_to_close and first[0].position == last[0].position
    return is_loop and curve.family.curve_class.can_close and not any(derivatives_of(last[0]))


def closed_by_pen(document: Document, curve: int, view: CurveView) -> Document:
    """Return the document with its curve `curve`, which `view` shows, closed; handles at its ends as drawn.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    document = with_closed(document, curve, view, closed=True)
    return with_bare_corner(document, curve, len(view.source.points) - 1)


def with_bare_corner(document: Document, curve: int, segment: int) -> Document:
    """Return the document with no handle at a corner at one end of a segment, where the other end has one.

    A corner whose velocity was set, also to zero, stays as it is.
    """
    source = document.curves[curve]
    start, end = ends_of(source, segment)
    points = source.points[start], source.points[end]
    sides = points[0].explicit_sides(1)[1], points[1].explicit_sides(1)[0]
    retracted = [
        JetValue(index, 1, not is_end, (0.0, 0.0))
        for is_end, index in enumerate((start, end))
        if points[is_end].corner and sides[is_end] is None and sides[not is_end] is not None
    ]
    return document.with_curve(curve, with_jet_values(source, retracted)) if retracted else document


def has_pulled_handle(curve: Curve) -> bool:
    """Whether a handle was pulled out ahead of the last point: no rule, and no line before, has set it."""
    if not (curve.points and curve.family.derivatives):
        return False
    return any(_with_two_sides(curve, len(curve.points) - 1).explicit_sides(1)[1] or ())


def with_handles_pulled(
    document: Document, curve: int, index: int, behind: Vector | None, ahead: Vector | None
) -> Document:
    """Return the document with handles pulled out of a point; None for a side that stays as it is.

    `ahead` is the offset of the handle ahead, `behind` that of which the handle behind is the mirror image.
    Where both are the same the point is symmetric, else a corner, but for a line that its handle continues.
    """
    view = view_of(document.curves[curve])
    before, after = view.source.points[index].explicit_sides(1)
    if behind is not None:
        before = derivative_of_offset(view, index, 1, (-behind[0], -behind[1]), ahead=False)
    if ahead is not None:
        after = derivative_of_offset(view, index, 1, ahead, ahead=True)
    document = make_corner(document, curve, index, before, after, even=behind == ahead)
    source = document.curves[curve]
    points = (*source.points[:index], tied_to_straight_segment(source, index), *source.points[index + 1 :])
    return document.with_curve(curve, replace(source, points=points))


def _with_handles_as_drawn(
    document: Document, curve: int, view: CurveView, ends: Collection[int]
) -> Document:
    """Return the document with the handles drawn at the ends of `view`, which have one more segment now."""
    grown = document.curves[curve]
    if not (view.is_current and grown.family.derivatives):
        return document
    try:
        h = np.diff(_parameters_alone(grown))
    except CurveError:
        return document
    points = list(grown.points)
    for index in ends:
        point, drawn = _with_two_sides(view.source, index), view.spacing(index, ahead=index == 0)
        if drawn and point.corner:
            # From the handle as drawn, not as the new parameters have changed it: the factor is for both.
            points[index] = rescaled_beside(point, *(float(h[side]) / drawn for side in (index - 1, index)))
    return document.with_curve(curve, replace(grown, points=tuple(points)))


def _with_two_sides(curve: Curve, index: int) -> Point:
    """Return a point at an end with its velocity, where it is set, for both sides.

    Beside a line it is a corner, whose other side the rules estimate.
    """
    point, is_first = curve.points[index], index == 0
    if point.corner or point.velocity is None:
        return point
    if is_straight_beside(curve, index, ahead=is_first):
        free = {derivative.name if is_first else derivative.after: None for derivative in DERIVATIVES}
        return replace(point.as_corner(), **free)
    return replace(point.as_corner(), tied=True, even=True)


def scale_of(before: CurveView, after: Curve) -> float:
    """Return the factor by which the points of `before` span more of t in `after`, where they come first.

    One where no rule moves them, where there is no curve, or where their parameters nearly coincide.
    """
    if before.source.is_manual or not before.is_current:
        return 1.0
    try:
        new = _parameters_alone(after)
    except CurveError:
        return 1.0
    last, old = len(before.source.points) - 1, before.parameters
    longer, long = float(new[last] - new[0]), float(old[last] - old[0])
    parameter_scale = longer / long if long > 0.0 else 1.0
    return parameter_scale if 0.0 < parameter_scale < math.inf else 1.0


def _parameters_alone(curve: Curve) -> FloatArray:
    """Return the parameters that the rule of a curve gives, without a view of it."""
    points = np.array([point.position for point in curve.points])
    return parameters_of(curve, at_knots(points, closed=curve.is_closed))


def appended_parameter(before: CurveView, point: Point) -> float:
    """Return a manual parameter for a point appended to `before`, at the mean speed of the curve so far.

    A closed curve's last segment is divided in proportion to the distances.
    """
    t = before.parameters
    if len(t) == 0 or not before.is_current:
        rule = before.source.parametrization
        given = [earlier.t for earlier in before.source.points if earlier.t is not None]
        # After the only point the whole interval: its handle was drawn for that.
        step = rule.end - rule.start if len(given) == 1 else 1.0
        return given[-1] + step if given else rule.start
    last = len(before.points) - 1
    new = math.dist(point.position, before.points[last])
    if before.source.is_closed:
        back = math.dist(point.position, before.points[0])
        share = new / (new + back) if new + back > 0 else 0.5
        return float(t[last] + np.clip(share, 0.01, 0.99) * (t[last + 1] - t[last]))
    total = polygon_length(before.points)
    span = float(t[-1] - t[0])
    mean = span / last
    step = span * new / total if total > 0 else mean
    return float(t[-1]) + max(step, mean * 1e-3)


# Points inserted in the middle of segments


class WithPoints(msgspec.Struct, frozen=True):
    """A curve with more points, the indices of the new points, and the new indices of given points."""

    reshaped: Reshaped
    new: frozenset[int]
    old: frozenset[int]


def with_midpoints(view: CurveView, segments: Collection[int], points: Collection[int]) -> WithPoints:
    """Return the curve with a point in the middle of each of these segments, and the new indices of `points`.

    Its shape is kept as far as it is by one point; see `reshape.with_point_inserted`.

    Raises
    ------
    EditError
        If there is no curve, or no room for a point.
    """
    middles = (partial(_middle, segment=segment) for segment in sorted(segments, reverse=True))
    return _inserted(view, middles, points)


def _inserted(
    view: CurveView, parameters: Iterable[Callable[[CurveView], float]], points: Collection[int]
) -> WithPoints:
    """Return the curve with more points, from the last one, each at a parameter of the view so far."""
    refuse_without_curve(view)
    now, new, old, steps, at = view, frozenset[int](), frozenset(points), list[Reshaped](), list[float]()
    # From the last one: points before it keep their indices, whatever a rule makes of the parameters.
    for parameter in parameters:
        t = parameter(now)
        index = inserted_index(now, t)
        steps.append(with_point_inserted(now, t))
        at.append(parameter(view))
        now = view_of(steps[-1].curve)
        new = _shifted(new, index) | {index}
        old = _shifted(old, index)
    moved, left_rule = (
        any(getattr(step, name) for step in steps) for name in ("parameters_moved", "left_rule")
    )
    # The changes of the single steps add up.
    residual = sum(step.residual for step in steps)
    if moved:
        residual = change_of_shape(view, now, np.sort(np.append(view.parameters, at)))
    reshaped = replace(steps[-1], residual=residual, parameters_moved=moved, left_rule=left_rule)
    return WithPoints(reshaped, new, old)


def _middle(view: CurveView, segment: int) -> float:
    """Return the parameter between a point and the next one."""
    parameters, end = view.present_curve.nodes, view.present_curve.domain[1]
    after = parameters[segment + 1] if segment + 1 < len(parameters) else end
    return float(parameters[segment] + after) / 2


def _shifted(points: frozenset[int], index: int) -> frozenset[int]:
    """Return the indices of points after one was inserted at `index`."""
    return frozenset(point + (point >= index) for point in points)


# Points inserted at extrema and inflections


class SpecialPoints(msgspec.Struct, frozen=True):
    """Special points of plane curves, at which a point can be inserted.

    Attributes
    ----------
    action
        The name of the action that inserts them.
    title
        Their name in the menu.
    parameters
        Returns their parameters on a curve.
    """

    action: str
    title: str
    parameters: Callable[[ParametricCurve], FloatArray]

    @property
    def name(self) -> str:
        """The name within a sentence."""
        return self.title.lower()


def _coordinate_extrema(curve: ParametricCurve) -> FloatArray:
    return np.concatenate([curvecore.coordinate_extrema(curve, axis) for axis in (0, 1)])


# Functions of the core are imported when they are needed.
SPECIAL_POINTS = (
    SpecialPoints("insertAtExtrema", "Extrema of x and y", _coordinate_extrema),
    SpecialPoints("insertAtInflections", "Inflections", lambda c: curvecore.inflections(c)),  # noqa: PLW0108
    SpecialPoints(
        "insertAtCurvatureExtrema",
        "Extrema of Curvature",
        lambda c: curvecore.curvature_extrema(c).parameters,
    ),
)


_SAME_ROOT = 1e-7
"""Share of the domain up to which a root is at a point: high degrees make roots less exact."""


def special_points(
    view: CurveView, kind: SpecialPoints, segments: Collection[int] = ()
) -> tuple[list[float], bool]:
    """Return the parameters of special points that are no points of the curve yet, and whether some are.

    Those of all segments, or of the given ones.

    Raises
    ------
    EditError
        If there is no curve, or it does not pass its points.
    """
    refuse_without_curve(view)
    if not view.source.family.interpolates:
        raise EditError(
            f"{view.source.family.subject} does not pass its points: none can lie at the {kind.name}. "
            f"{convert_first(view)}"
        )
    knots, free, is_any_occupied = view.parameters, list[float](), False
    for t in np.sort(kind.parameters(view.present_curve)).tolist():
        if segments and segment_at(knots, t) not in segments:
            continue
        if np.abs(np.append(knots, free) - t).min() > _SAME_ROOT * (knots[-1] - knots[0]):
            free.append(t)
        else:
            is_any_occupied = True
    return free, is_any_occupied


def with_points_at(view: CurveView, parameters: Sequence[float]) -> WithPoints:
    """Return the curve with points at these parameters, ascending, and its shape kept.

    Parameters become manual, derivatives explicit as by `reshape.with_point_inserted`.

    Raises
    ------
    EditError
        If the shape would change.
    """
    frozen = view_of(freeze_parameters(Document((view.source,)), 0, view.parameters.tolist()).curves[0])
    result = _inserted(frozen, [partial(_at, t) for t in reversed(parameters)], ())
    if not result.reshaped.keeps_shape:
        raise EditError(
            f"{view.source.family.subject} changes its shape where points are inserted, by up to "
            f"{number(result.reshaped.residual, 2)} here. {convert_first(view)}"
        )
    is_exact = all(piece.has_exact_pieces for piece in frozen.pieces)
    note = "" if is_exact else "Their parameters were computed to rounding."
    reshaped = replace(result.reshaped, left_rule=not view.source.is_manual, note=note)
    return replace(result, reshaped=reshaped)


def _at(t: float, _view: CurveView) -> float:
    return t
