"""The kinds of points, and points changed to each of them with the shape kept as far as possible.

`POINT_KINDS` lists a record for each kind, which keys, menus, buttons, table and marks read. To add one: its
record, and an icon of its name in ``resources/icons``. A point is of the kind of the first record whose
`are_of` holds of it.

A corner divides the estimates of the rules. Its own derivatives are set as they were, and they are conditions
of a natural spline on both sides, so that nothing moves before somebody moves it. Where a local rule would
change estimates of others, these, and no others, are set as well. Straight segments and retracted handles
are made of corners.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import BoolArray, IntArray

from ..document.constraints import (
    HAND_DRAWN_ANGLE,
    ends_of,
    is_straight_beside,
    tie,
    tied_to_straight_segment,
    turned_along,
    untie,
)
from ..document.derivatives import DERIVATIVES
from ..document.limits import EditError
from ..document.model import Curve, Document, Point, Vector
from ..document.point_edits import JetValue, clear_derivatives, with_jet_values
from ..document.straight_edits import corners_of, straight_refusal, straighten
from ..families import Family, titles_with_derivatives
from .append import closed_by_pen, has_pulled_handle, with_bare_corner, with_point_appended
from .curve.core_curve import Sides
from .curve.curve_view import CurveView, view_of
from .curve.handles import offset_past, pulled_out
from .curve.point_arrays import PointArrays
from .reshape import refuse_without_curve, with_jets, with_sides_kept

_SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

NO_CORNERS = "the ends of an open curve cannot be corners"
ONE_SIDED = "the ends of an open curve have one side only"
"""Remarks where some of the selected points are such ends."""


def inner_points(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return the points, of `indices`, that have curve on both sides, in order."""
    return sorted(index for index in indices if curve.is_closed or 0 < index < len(curve.points) - 1)


def with_corners(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with corners at these points: both sides explicit and independent, the shape kept.

    Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or no point is left.
    """
    points = view.source.points
    inner = _inner(view, indices, "a corner needs a segment on both sides", NO_CORNERS)
    new = [index for index in inner if not points[index].corner or points[index].tied]
    cornered = {index: untie(points[index].as_corner()) for index in new}
    return _written_down(view, cornered)


def with_smooth_points(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with velocities of one direction at these points, with independent speeds.

    Each handle keeps its length. The handles turn to the line from one tip to the other, so that the longer
    one turns less; beside a straight segment to the line of that segment. A handle that lies on its point is
    pulled out by a third of the distance to the neighbour. Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or no point is left.
    """
    inner = _inner(view, indices, "it has one handle", ONE_SIDED)
    was = view.source.points
    new = [index for index in inner if was[index].even or not was[index].tied]
    corners = {index: view.source.points[index] for index in new if view.source.points[index].corner}
    document = Document((_written_down(view, corners),))
    curve, points = document.curves[0], list(document.curves[0].points)
    for index in new:
        before, after = (_velocity(view, index, ahead=ahead) for ahead in (False, True))
        if index in corners:
            before, after = _in_one_direction(view, index, before, after)
        points[index] = replace(tie(points[index], before, after), even=False)
    return _with_estimates_kept(view, replace(curve, points=tuple(points)), turned=bool(corners))


def with_symmetric_points(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with handles that mirror each other at these points.

    One velocity would be handles of different lengths as soon as the segments beside the point have
    different lengths in t. So the handles are the mean of the two, tied and even, and so are the derivatives
    per unit of a segment, which keeps the curvature continuous. Where handles cancel each other, they turn
    to one direction first. Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or no point is left.
    """
    points, changed = list(view.source.points), []
    for index in _inner(view, indices, "it has one handle", ONE_SIDED):
        point, lengths = points[index], _lengths_beside(view, index)
        points[index] = _symmetric(view, index, lengths)
        if point.corner or not math.isclose(*lengths):
            changed.append(index)
    return _with_estimates_kept(view, replace(view.source, points=tuple(points)), turned=bool(changed))


def _lengths_beside(view: CurveView, index: int) -> tuple[float, float]:
    """Return the lengths in t of the segments before and after a point; at an end, that of its one side."""
    before, after = (view.spacing(index, ahead=ahead) for ahead in (False, True))
    return before or after or 1.0, after or before or 1.0


def _symmetric(view: CurveView, index: int, lengths: tuple[float, float]) -> Point:
    """Return a point with handles that mirror each other between segments of these lengths in t."""
    assert view.sides is not None
    before, after = (jets[index, 1:].copy() for jets in view.sides)
    scales = [h ** np.arange(1, len(before) + 1)[:, None] for h in lengths]
    if not (scales[0] * before + scales[1] * after)[0].any():
        velocities = (_velocity(view, index, ahead=ahead) for ahead in (False, True))
        before[0], after[0] = _in_one_direction(view, index, *velocities)
    mean, position = (scales[0] * before + scales[1] * after) / 2, np.zeros((1, 2))
    sides = Sides(*(np.vstack([position, mean / scale])[None] for scale in scales))
    point = view.source.points[index].without_corner()
    return with_jets(replace(point.as_corner(), tied=True, even=True), sides, 0)


def with_estimated_points(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with all derivatives at these points left to the rules."""
    points = list(view.source.points)
    for index in indices:
        points[index] = points[index].without_corner()
    document = Document((replace(view.source, points=tuple(points)),))
    return clear_derivatives(document, 0, indices).curves[0]


def _inner(view: CurveView, indices: Collection[int], needs: str, none: str) -> list[int]:
    """Return the points that have curve on both sides; refuse where there is none."""
    for index in indices:
        _refuse_without_tangent(view, index)
    inner = inner_points(view.source, indices)
    if len(inner) < len(indices) == 1:
        raise EditError(f"Point {min(indices)} is an end of the curve; {needs}.")
    if not inner:
        raise EditError(f"{none[0].upper()}{none[1:]}.")
    return inner


def _written_down(view: CurveView, cornered: Mapping[int, Point]) -> Curve:
    """Return the curve with these corners in place of its points, with their estimates set."""
    if not cornered or view.sides is None:
        return view.source
    points = list(view.source.points)
    for index, point in cornered.items():
        points[index] = with_jets(point, view.sides, index)
    return _with_estimates_kept(view, replace(view.source, points=tuple(points)))


def _velocity(view: CurveView, index: int, *, ahead: bool) -> Vector:
    velocity = view.velocity_of(index, ahead=ahead)
    assert velocity is not None
    return velocity


def _in_one_direction(view: CurveView, index: int, before: Vector, after: Vector) -> tuple[Vector, Vector]:
    """Return the velocities at a corner turned to one direction."""
    h, g = (view.spacing(index, ahead=ahead) or 1.0 for ahead in (False, True))
    lines = [is_straight_beside(view.source, index, ahead=ahead) for ahead in (False, True)]
    # From the tip of one handle to that of the other.
    direction = (h * before[0] + g * after[0], h * before[1] + g * after[1])
    if lines[0] != lines[1]:
        direction = before if lines[0] else after
    elif not any(direction):
        direction = after if any(after) else offset_past(view, index)
    first, second = (
        turned_along(velocity, direction)
        if any(velocity)
        else pulled_out(view, index, direction, ahead=ahead)
        for velocity, ahead in ((before, False), (after, True))
    )
    return first, second


def _refuse_without_tangent(view: CurveView, index: int) -> None:
    if view.sides is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")


def _with_estimates_kept(view: CurveView, changed: Curve, *, turned: bool = False) -> Curve:
    """Return `changed` with those estimates set that would change.

    Where velocities were `turned`, the estimates of a spline follow them.
    """
    after = view_of(changed).sides
    if view.sides is None or after is None:
        return changed
    was = Sides(*(side.copy() for side in view.sides))
    for order, rule in enumerate(changed.rules if turned else (), start=1):
        if rule.is_spline:
            was.before[:, order], was.after[:, order] = after.before[:, order], after.after[:, order]
    every = np.arange(len(changed.points))
    return with_sides_kept(was, changed, every, every)


def jolts_of(view: CurveView) -> list[int]:
    """Return the corners that are not visible: the velocity is continuous and a higher derivative jumps.

    Where the velocity is zero, a jump of the next turns the curve: a cusp is visible.
    """
    if view.sides is None:
        return []
    before, after = (side[view.corners, 1:] for side in view.sides)
    scale = np.abs(view.sides.after[:, 1:]).max(axis=(0, 2))
    jumps = np.abs(after - before).max(axis=2) > _SAME * scale
    is_jolt = ~jumps[:, 0] & jumps.any(axis=1) & before[:, 0].any(axis=1)
    return [index for index, jolt in zip(view.corners, is_jolt.tolist(), strict=True) if jolt]


# Straight segments and retracted handles


def with_straight_segments(
    view: CurveView, segments: Collection[int], angle: float = HAND_DRAWN_ANGLE
) -> Curve:
    """Return the curve with these segments straight, and corners at their ends.

    A smooth point whose tangent is in line with one, up to an angle, keeps it: it is tied to the line.
    Nothing else changes.

    Raises
    ------
    EditError
        If there is no curve, or its family is not piecewise.
    """
    if reason := straight_refusal(view.source.family):
        raise EditError(reason)
    refuse_without_curve(view)
    corners = [index for index in corners_of(view.source, segments) if not view.source.points[index].tied]
    cornered = with_corners(view, corners) if corners else view.source
    curve = straighten(Document((cornered,)), 0, segments, view.parameters.tolist()).curves[0]
    points = list(curve.points)
    for index in corners:
        if not view.source.points[index].corner:
            points[index] = tied_to_straight_segment(curve, index, angle)
    return replace(curve, points=tuple(points))


def with_corner_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a new last point on its curve `curve`, which `view` shows, a corner.

    The segment before it goes by the handle that was pulled out of the point before, if there is one, and
    else straight. As `with_point_appended` where the family has no corners.

    Raises
    ------
    EditError
        If a document may not hold the position, or a line would have no length.
    """
    document, count = with_point_appended(document, curve, view, position), len(view.source.points)
    if not view.source.family.derivatives:
        return document
    if count and not has_pulled_handle(view.source):
        return _with_last_straight(document, curve, view)
    return with_bare_corner(_with_clicked_corner(document, curve, count), curve, count - 1)


def closed_by_corner(document: Document, curve: int, view: CurveView) -> Document:
    """Return the document with its curve `curve`, which `view` shows, closed with a corner at point 0.

    The closing segment goes by the handle that was pulled out of the last point, or else straight.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    document = closed_by_pen(document, curve, view)
    if not view.source.family.derivatives:
        return document
    document = _with_clicked_corner(document, curve, 0)
    if has_pulled_handle(view.source):
        return with_bare_corner(document, curve, len(view.source.points) - 1)
    return _with_last_straight(document, curve, view)


def _with_clicked_corner(document: Document, curve: int, index: int) -> Document:
    """Return the document with a corner at a point, without a handle behind it; the one ahead stays."""
    source = document.curves[curve]
    point = untie(source.points[index].as_corner())
    point = replace(point, **dict.fromkeys(row.name for row in DERIVATIVES))
    points = (*source.points[:index], point, *source.points[index + 1 :])
    return document.with_curve(curve, replace(source, points=points))


def _with_last_straight(document: Document, curve: int, before: CurveView) -> Document:
    """Return the document with a straight segment behind the last point of `before`."""
    last = len(before.source.points) - 1
    straightened = with_straight_segments(view_of(document.curves[curve]), [last])
    points = list(straightened.points)
    for index in corners_of(straightened, [last]):
        points[index] = tied_to_straight_segment(straightened, index)
    return document.with_curve(curve, replace(straightened, points=tuple(points)))


def segments_between(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return the segments of which both ends are among the points `indices`."""
    count = len(curve.points)
    last = count if curve.is_closed else count - 1
    return [index for index in range(last) if {index, (index + 1) % count} <= set(indices)]


def with_handle_retracted(view: CurveView, index: int, *, ahead: bool) -> Curve:
    """Return the curve with the velocity zero on one side of a point, which becomes a corner.

    The other side stays. Where the handle at the other end of the segment is retracted, it becomes straight.

    Raises
    ------
    EditError
        If there is no curve.
    """
    refuse_without_curve(view)
    curve = view.source
    if inner_points(curve, [index]) and (not curve.points[index].corner or curve.points[index].tied):
        curve = with_corners(view, [index])
    segment = index if ahead else (index - 1) % len(curve.points)
    start, end = ends_of(curve, segment)
    far = curve.points[end if ahead else start].explicit_sides(1)[not ahead]
    if far is not None and not any(far):
        return with_straight_segments(view_of(curve), [segment])
    return with_jet_values(curve, [JetValue(index, 1, ahead, (0.0, 0.0))])


# The records

Outline = tuple[Vector, ...]


class PointKind(msgspec.Struct, frozen=True, kw_only=True):
    """A kind of point, which defines how its handles depend on each other.

    Attributes
    ----------
    name
        The name in the program, and that of its icon.
    title
        The name on the screen.
    action
        The name of the action that makes points of this kind.
    key
        The keys of the action, comma separated.
    tip
        The effect on the selected points.
    keywords
        Other words by which the command palette finds it.
    step
        The words of the undo step before "point 3".
    one
        The words about a point of this kind after "point 3, "; empty for none.
    apply
        Returns the curve of a view with points of this kind, its shape kept as far as possible; raises
        `EditError` where it cannot.
    are_of
        Returns the mask of points of this kind, unless of one before it.
    outline
        Corners of its mark, as large as a disc of radius 1; none for a disc.
    is_open
        Whether its mark has a dot of paper in the middle.
    ends
        Why ends of an open curve are left out; empty where they are not.
    """

    name: str
    title: str
    action: str
    key: str
    tip: str
    keywords: str
    step: str
    one: str
    apply: Callable[[CurveView, Collection[int]], Curve]
    are_of: Callable[[PointArrays], BoolArray]
    outline: Outline = ()
    is_open: bool = False
    ends: str = ""


_SIDE = 0.96
"""Half the side of a square that looks as large as a disc of radius 1."""

_SQUARE = ((-_SIDE, -_SIDE), (_SIDE, -_SIDE), (_SIDE, _SIDE), (-_SIDE, _SIDE))
_REACH = 1.4
_DIAMOND = ((0.0, -_REACH), (_REACH, 0.0), (0.0, _REACH), (-_REACH, 0.0))

CORNER = PointKind(
    name="point-corner",
    title="Corner",
    action="tangentCorner",
    key="Shift+C, Alt+2",
    tip="Give the selected points independent velocities on both sides: each handle moves alone",
    keywords="cusp sharp break handles",
    step="Corner at",
    one="a corner",
    apply=with_corners,
    are_of=lambda points: points.corners & ~points.ties,
    outline=_DIAMOND,
    ends=NO_CORNERS,
)
SMOOTH = PointKind(
    name="point-smooth",
    title="Smooth",
    action="tangentSmooth",
    key="Shift+S",
    tip="Align the two handles of each selected point, with independent lengths; tangent to straight lines",
    keywords="tangent collinear G1 tie handles",
    step="Smooth",
    one="smooth",
    apply=with_smooth_points,
    are_of=lambda points: points.ties & ~points.evens,
    outline=_SQUARE,
    ends=ONE_SIDED,
)
SYMMETRIC = PointKind(
    name="point-symmetric",
    title="Symmetric",
    action="tangentSymmetric",
    key="Shift+Y, Alt+1",
    tip="Give the two handles of each selected point one direction and one length, their mean",
    keywords="smooth C1 mirror equal handles length",
    step="Symmetric",
    one="symmetric",
    apply=with_symmetric_points,
    are_of=lambda points: np.isfinite(points.given).any(axis=(1, 2, 3)).astype(bool),
    outline=_SQUARE,
    is_open=True,
    ends=ONE_SIDED,
)
ESTIMATED = PointKind(
    name="point-estimated",
    title="Estimated",
    action="tangentEstimated",
    key="Shift+A, Alt+3",
    tip="Let the rules estimate the tangents of the selected points",
    keywords="auto smooth automatic reset",
    step="Estimate",
    one="",
    apply=with_estimated_points,
    are_of=lambda points: np.ones(len(points.points), dtype=bool),
)

POINT_KINDS = (CORNER, SMOOTH, SYMMETRIC, ESTIMATED)
"""All kinds, in the order of menus and keys; a point is of the first kind that matches."""


def kinds_of(view: CurveView) -> IntArray:
    """Return for each point the index of its kind in `POINT_KINDS`, (n,).

    A point whose handles are of different lengths is smooth, also with one velocity between segments of
    different lengths, and so is an end of an open curve with a velocity. All points of families without
    velocities are of the last kind.
    """
    kinds, last = np.full(len(view.points), len(POINT_KINDS) - 1, dtype=np.intp), len(view.points) - 1
    if view.source.family.derivatives and view.source.has_derivatives:
        holds = [kind.are_of(view.arrays) for kind in POINT_KINDS]
        kinds, symmetric = np.argmax(holds, axis=0), POINT_KINDS.index(SYMMETRIC)
        if view.is_current:
            h, is_closed = np.diff(view.parameters), view.source.is_closed
            beside = (np.roll(h, 1), h) if is_closed else (np.append(0.0, h), np.append(h, 0.0))
            handles = np.hypot(*view.arrays.given[:, :, 0].T) * beside
            is_even = np.isclose(handles[0], handles[1], rtol=_SAME, atol=0.0)
            is_even |= np.isclose(beside[0], beside[1], rtol=_SAME, atol=0.0)
            kinds[(kinds == symmetric) & ~is_even] = POINT_KINDS.index(SMOOTH)
        for end in () if view.source.is_closed else (0, last):
            if POINT_KINDS[kinds[end]].ends:
                kinds[end] = POINT_KINDS.index(SMOOTH if holds[symmetric][end] else ESTIMATED)
    return kinds


def kind_at(view: CurveView, index: int) -> PointKind:
    """Return the kind of a point of a curve."""
    return POINT_KINDS[kinds_of(view)[index]]


def is_breakable(view: CurveView, index: int) -> bool:
    """Whether a handle of a point moves the other one with it: curve on both sides, and no corner."""
    return kind_at(view, index) is not CORNER and bool(inner_points(view.source, [index]))


def toggled(view: CurveView, index: int) -> PointKind:
    """Return the kind that a double click gives a point: a corner becomes smooth, any other a corner."""
    return SMOOTH if kind_at(view, index) is CORNER else CORNER


def why_no_kinds(family: Family) -> str:
    """Return a sentence why points of a family are of no kind; empty if they are."""
    if family.derivatives:
        return ""
    return f"{family.subject} has no velocities at its points; choose {titles_with_derivatives()}."
