"""Straight segments between points, with the rest of the curve kept as it is."""

from __future__ import annotations

from collections.abc import Collection

from ..document.edits import EditError
from ..document.model import Curve, Document
from ..document.straight_edits import corners_of, straighten, why_not_straight
from .curve_view import CurveView
from .reshape import refuse_without_curve
from .smoothness import with_corners


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


def segments_between(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return the segments of which both ends are among the points `indices`."""
    count = len(curve.points)
    last = count if curve.is_closed else count - 1
    return [index for index in range(last) if {index, (index + 1) % count} <= set(indices)]
