"""Handles retracted into their points."""

from __future__ import annotations

from ...document.jet_edits import JetValue, with_jet_values
from ...document.lines import ends_of
from ...document.model import Curve
from ..curve.curve_view import CurveView, view_of
from ..fitting.reshape import refuse_without_curve
from .smoothness import inner_points, with_corners
from .straight import with_straight_segments


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
