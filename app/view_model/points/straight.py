"""Straight segments between points, with the rest of the curve kept as it is; handles retracted."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from ...document.edits import EditError
from ...document.jet_edits import JetValue, with_jet_values
from ...document.lines import ends_of
from ...document.model import Curve, Document, Vector
from ...document.straight_edits import corners_of, straighten, why_not_straight
from ...document.ties import tied_to_line
from ..curve.curve_view import CurveView, view_of
from ..fitting.reshape import refuse_without_curve
from .appending import closed_by_pen, with_point_appended
from .smoothness import inner_points, with_corners


def with_straight_segments(view: CurveView, segments: Collection[int]) -> Curve:
    """Return the curve with these segments straight: everything beside them stays.

    Raises
    ------
    EditError
        If there is no curve, or its family has no segments of their own.
    """
    if reason := why_not_straight(view.source.family):
        raise EditError(reason)
    refuse_without_curve(view)
    corners = [index for index in corners_of(view.source, segments) if not view.source.points[index].tied]
    cornered = with_corners(view, corners) if corners else view.source
    return straighten(Document((cornered,)), 0, segments, view.parameters.tolist()).curves[0]


def with_line_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a new last point on its curve `curve`, which `view` shows, after a line.

    As `appending.with_point_appended`, where the family has no straight segments, or there was no point.

    Raises
    ------
    EditError
        If the position is not one that a document may hold, or leaves no way for a line.
    """
    return _with_last_straight(with_point_appended(document, curve, view, position), curve, view)


def closed_by_line(document: Document, curve: int, view: CurveView) -> Document:
    """Return the document with its curve `curve`, which `view` shows, closed by a straight line.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    return _with_last_straight(closed_by_pen(document, curve, view), curve, view)


def _with_last_straight(document: Document, curve: int, before: CurveView) -> Document:
    """Return the document with a straight segment behind the last point of `before`."""
    last = len(before.source.points) - 1
    if last < 0 or why_not_straight(before.source.family):
        return document
    made = with_straight_segments(view_of(document.curves[curve]), [last])
    points = list(made.points)
    for index in corners_of(made, [last]):
        points[index] = tied_to_line(made, index)
    return document.with_curve(curve, replace(made, points=tuple(points)))


def segments_between(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return the segments of which both ends are among the points `indices`."""
    count = len(curve.points)
    last = count if curve.is_closed else count - 1
    return [index for index in range(last) if {index, (index + 1) % count} <= set(indices)]


def with_handle_retracted(view: CurveView, index: int, *, ahead: bool) -> Curve:
    """Return the curve with the velocity zero on one side of a point, which is a corner then.

    The other side stays. Where the handle at the other end of the segment is retracted, that is straight.

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
