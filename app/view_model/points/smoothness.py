"""Points made corners, smooth, symmetric or estimated, with the curve kept as it is as far as can be.

A corner divides the estimates of the rules, and every point of a natural spline feels that. What it would
change, and no more, is written down as it was, so that nothing moves before somebody moves it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np
from msgspec.structs import replace

from ...document.edits import EditError, estimate_derivatives, make_smooth
from ...document.lines import line_beside
from ...document.model import Curve, Document, Point, Vector
from ...document.ties import tied, turned, untied
from ..curve.curve_view import CurveView
from ..curve.handles import pulled_out, way_past
from ..fitting.reshape import estimates_kept, with_jets

_SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

NO_CORNERS = "the ends of an open curve cannot be corners"
ONE_SIDED = "the ends of an open curve have one side only"
"""The words where some of the selected points are such ends."""


def inner_points(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return those of the points `indices` that have curve on both sides, in order."""
    return sorted(index for index in indices if curve.is_closed or 0 < index < len(curve.points) - 1)


def with_corners(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with corners at these points: both sides are explicit and free, and the shape stays.

    Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or nothing is left.
    """
    points = view.source.points
    inner = _inner(view, indices, "a corner needs curve on both sides", NO_CORNERS)
    new = [index for index in inner if not points[index].corner or points[index].tied]
    cornered = {
        index: untied(points[index]) if points[index].corner else points[index].as_corner() for index in new
    }
    return _written_down(view, cornered)


def made_smooth(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with velocities at these points that go the same way, at speeds of their own.

    Each handle keeps its length. They turn to the line from one tip to the other, so that the longer one
    turns less; beside a straight segment to that line, which stays. A handle that lies on its point is pulled
    out by a third of the way to the neighbour. Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or nothing is left.
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
        points[index] = replace(tied(points[index], before, after), even=False)
    return _kept(view, replace(curve, points=tuple(points)), new)


def made_symmetric(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with one velocity, and one of each further derivative, on both sides of these points.

    Each is the mean of the two; where they are alike already, the shape stays.

    Raises
    ------
    EditError
        If there is no curve.
    """
    document = Document((view.source,))
    corners = [index for index in indices if view.source.points[index].corner]
    for index in indices:
        _refuse_without_tangent(view, index)
        document = make_smooth(document, 0, index, _mean(view, index, 1))
    points = list(document.curves[0].points)
    for index in corners:
        means = [_mean(view, index, order) for order in range(1, view.source.family.derivatives + 1)]
        points[index] = points[index].with_derivatives(means, ())
    return _kept(view, replace(view.source, points=tuple(points)), corners)


def made_estimated(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with all derivatives at these points left to the rules."""
    document = Document((view.source,))
    for index in indices:
        document = make_smooth(document, 0, index, None)
    return estimate_derivatives(document, 0, indices).curves[0]


def _inner(view: CurveView, indices: Collection[int], needs: str, none: str) -> list[int]:
    """Return those of these points that have curve on both sides, refusing where there is none."""
    for index in indices:
        _refuse_without_tangent(view, index)
    inner = inner_points(view.source, indices)
    if len(inner) < len(indices) == 1:
        raise EditError(f"Point {min(indices)} is an end of the curve; {needs}.")
    if not inner:
        raise EditError(f"{none[0].upper()}{none[1:]}.")
    return inner


def _written_down(view: CurveView, cornered: Mapping[int, Point]) -> Curve:
    """Return the curve with these corners in place of its points, with all that is estimated there set."""
    if not cornered or view.sides is None:
        return view.source
    points = list(view.source.points)
    for index, point in cornered.items():
        points[index] = with_jets(point, view.sides, index)
    return _kept(view, replace(view.source, points=tuple(points)), cornered)


def _velocity(view: CurveView, index: int, *, ahead: bool) -> Vector:
    velocity = view.velocity_of(index, ahead=ahead)
    assert velocity is not None
    return velocity


def _in_one_direction(view: CurveView, index: int, before: Vector, after: Vector) -> tuple[Vector, Vector]:
    """Return the velocities at a corner turned to one direction."""
    h, g = (view.spacing(index, ahead=ahead) or 1.0 for ahead in (False, True))
    lines = [line_beside(view.source, index, ahead=ahead) for ahead in (False, True)]
    # From the tip of one handle to that of the other.
    direction = (h * before[0] + g * after[0], h * before[1] + g * after[1])
    if lines[0] != lines[1]:
        direction = before if lines[0] else after
    elif not any(direction):
        direction = after if any(after) else way_past(view, index)
    first, second = (
        turned(velocity, direction) if any(velocity) else pulled_out(view, index, direction, ahead=ahead)
        for velocity, ahead in ((before, False), (after, True))
    )
    return first, second


def _refuse_without_tangent(view: CurveView, index: int) -> None:
    if view.sides is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")


def _mean(view: CurveView, index: int, order: int) -> Vector:
    """Return the mean of a derivative before and after a point; at an end, that of its one side."""
    assert view.sides is not None
    before, after = (jets[index, order] for jets in view.sides)
    if not view.source.is_closed and index == 0:
        before = after
    elif not view.source.is_closed and index == len(view.source.points) - 1:
        after = before
    x, y = ((before + after) / 2).tolist()
    return (x, y)


def _kept(view: CurveView, changed: Curve, but: Collection[int]) -> Curve:
    """Return `changed` with all estimates as they were, except at the points `but`."""
    own = np.delete(np.arange(len(changed.points)), sorted(but))
    return estimates_kept(view, changed, own, own)


def jolts_of(view: CurveView) -> list[int]:
    """Return the corners at which the velocity goes on, and a derivative above it jumps: no eye sees one."""
    if view.sides is None:
        return []
    before, after = (side[view.corners, 1:] for side in view.sides)
    scale = np.abs(view.sides.after[:, 1:]).max(axis=(0, 2))
    jumps = np.abs(after - before).max(axis=2) > _SAME * scale
    is_jolt = ~jumps[:, 0] & jumps.any(axis=1)
    return [index for index, jolt in zip(view.corners, is_jolt.tolist(), strict=True) if jolt]
