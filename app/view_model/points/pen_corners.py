"""Segments as a pen draws them that makes corners: straight, unless a handle was drawn out at an end of them.

What has been drawn stays as it is when further points come: everything that shapes it is set, and a corner is
no part of what the rules estimate beside it.
"""

from __future__ import annotations

from msgspec.structs import replace

from ...document.derivatives import DERIVATIVES
from ...document.jet_edits import JetValue, with_jet_values
from ...document.lines import chord_of, ends_of
from ...document.model import Curve, Document, Point, Vector
from ...document.straight_edits import why_not_straight
from ...document.ties import PARALLEL, angle_between, tied
from ..curve.curve_view import CurveView, view_of
from .appending import closed_by_pen, with_point_appended
from .smoothness import inner_points, with_corners
from .straight import with_straight_segments


def with_corner_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a corner at the end of its curve `curve`, which `view` shows.

    What goes on from there goes its own way. As `appending.with_point_appended`, where the family has no
    velocities.

    Raises
    ------
    EditError
        If the position is not one that a document may hold, or leaves no way for a line.
    """
    index = len(view.source.points)
    document = with_point_appended(document, curve, view, position)
    document = with_segment_by_handles(document, curve, index - 1) if index else document
    made = document.curves[curve]
    if why_not_straight(made.family):
        return document
    points = (*made.points[:index], _with_free_side(made.points[index]))
    return document.with_curve(curve, replace(made, points=points))


def with_free_end(document: Document, curve: int) -> Document:
    """Return the document with the last point of a curve as one that leaves open how the curve goes on."""
    made = document.curves[curve]
    if not made.points or made.is_closed or why_not_straight(made.family):
        return document
    free = _with_free_side(made.points[-1])
    return document.with_curve(curve, replace(made, points=(*made.points[:-1], free)))


def closed_by_handles(document: Document, curve: int, view: CurveView) -> Document:
    """Return the document with its curve `curve`, which `view` shows, closed by such a segment.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    last = len(view.source.points) - 1
    return with_segment_by_handles(closed_by_pen(document, curve, view), curve, last)


def with_own_lengths(document: Document, curve: int, index: int) -> Document:
    """Return the document with a point whose two handles keep their lengths, whatever segments come."""
    made = document.curves[curve]
    point = made.points[index]
    if point.velocity is None or point.corner:
        return document
    points = (*made.points[:index], tied(point, point.velocity, point.velocity), *made.points[index + 1 :])
    return document.with_curve(curve, replace(made, points=points))


def with_segment_by_handles(document: Document, curve: int, segment: int) -> Document:
    """Return the document with a segment straight where no handle lies in it, or one along its chord.

    Where one leads elsewhere, the end without one becomes a corner whose handle is retracted, as pens do.
    """
    made = document.curves[curve]
    if why_not_straight(made.family):
        return document
    start, end = ends_of(made, segment)
    ahead = made.points[start].explicit_sides(1)[1]
    behind = made.points[end].explicit_sides(1)[0]
    handles = [each for each in (ahead, behind) if each is not None]
    if len(handles) < 2 and all(_leads_along(each, chord_of(made, segment)) for each in handles):
        made = with_straight_segments(view_of(made), [segment])
    elif ahead is None and behind is not None:
        made = _retracted(made, segment, start)
    elif behind is None and ahead is not None:
        made = _retracted(made, segment, end)
    return document.with_curve(curve, made)


def _retracted(made: Curve, segment: int, index: int) -> Curve:
    """Return the curve with no handle at one end of a segment: its control point lies on the corner."""
    if inner_points(made, [index]) and not made.points[index].corner:
        made = with_corners(view_of(made), [index])
    return with_jet_values(made, [JetValue(index, 1, index == ends_of(made, segment)[0], (0.0, 0.0))])


def _leads_along(handle: Vector, chord: Vector) -> bool:
    return any(handle) and angle_between(handle, chord) <= PARALLEL


def _with_free_side(point: Point) -> Point:
    """Return an end of a curve as a corner that leaves open how the curve goes on."""
    return replace(point.as_corner(), tied=False, **{each.after: None for each in DERIVATIVES})
