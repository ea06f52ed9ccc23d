"""Points appended and curves closed so that no handle grows beyond what was drawn.

A point has one velocity, and its handles lie at ±h·v/3 of the segments on its two sides: a segment that is
ten times as long as the one before it would pull the handle ahead ten times as far out as the person did.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from msgspec.structs import replace

from app.document.edits import append_point, insert_points, stretched
from app.document.model import Curve, Document, Point, Vector
from app.view_model.closing import with_closed
from app.view_model.curve_view import CurveView, appended_parameter, appended_scale, parameters_of
from curvecore import CurveError


def with_point_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a new last point on its curve `curve`, which `view` shows.

    What was set before is rescaled so that handles stay. The point that was the last one of an open curve
    gets a segment on its other side, and its velocity shrinks until neither handle is longer than it was
    drawn.
    The handle of a point that stood alone is the one ahead of it, and stays.

    Raises
    ------
    EditError
        If the position is not one that a document may hold.
    """
    t = appended_parameter(view, Point(*position)) if view.source.is_manual else None
    return with_points_appended(document, curve, view, [Point(*position, t=t)])


def with_points_appended(
    document: Document, curve: int, view: CurveView, points: Sequence[Point]
) -> Document:
    """Return the document with `points` at the end of its curve `curve`; handles as by `with_point_appended`.

    Raises
    ------
    EditError
        If they are not what a document may hold.
    """
    count = len(view.source.points)
    document = append_point(document, curve, points[0], parameter_scale=appended_scale(view, points))
    document = insert_points(document, curve, count + 1, points[1:])
    if view.source.is_closed:
        return document
    return _kept_short(document, curve, view, [count - 1])


def closed_by_pen(document: Document, curve: int, view: CurveView) -> Document:
    """Return the document with its curve `curve`, which `view` shows, closed; handles at its ends stay short.

    Raises
    ------
    EditError
        If the curve cannot be closed.
    """
    document = with_closed(document, curve, view, closed=True)
    return _kept_short(document, curve, view, [0, len(view.source.points) - 1])


def _kept_short(document: Document, curve: int, view: CurveView, ends: Collection[int]) -> Document:
    """Shrink what was set at the ends of `view`, which have a segment more now, to the longer of the two."""
    grown = document.curves[curve]
    ends = [index for index in ends if _is_set(view.source, index)]
    if not ends or not view.is_current:
        return document
    positions = np.array([point.position for point in grown.points])
    try:
        h = np.diff(
            parameters_of(grown, np.vstack([positions, positions[:1]]) if grown.is_closed else positions)
        )
    except CurveError:
        return document
    points = list(grown.points)
    for index in ends:
        drawn = view.spacing(index, ahead=index == 0)
        if drawn:
            # From what was drawn, not from what the new parameters have made of it: the factor is for both.
            points[index] = stretched(view.source.points[index], float(max(h[index - 1], h[index])) / drawn)
    return document.with_curve(curve, replace(grown, points=tuple(points)))


def _is_set(curve: Curve, index: int) -> bool:
    """Whether the person set a derivative that the family uses at a point."""
    point = curve.points[index] if 0 <= index < len(curve.points) else None
    if point is None or not curve.family.derivatives:
        return False
    given = (point.velocity, point.velocity_after, point.acceleration, point.acceleration_after)
    return any(value is not None for value in given)
