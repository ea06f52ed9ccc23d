"""Corners made of smooth points and smooth points of corners, with the curve kept as it is.

A corner divides the estimates of the rules, and every point of a natural spline feels that. What it would
change, and no more, is written down as it was, so that nothing moves before somebody moves it.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from msgspec.structs import replace

from ..document.edits import EditError, make_corner, make_smooth
from ..document.model import Curve, Document, Vector
from .curve_view import CurveView
from .reshape import estimates_kept, with_jets

_SAME = 1e-9
"""Share of the largest derivative of an order up to which two of them are the same."""

ENDS_STAY = "the ends of an open curve cannot be corners"
"""The words where some of the selected points are such ends."""


def inner_points(curve: Curve, indices: Collection[int]) -> list[int]:
    """Return those of the points `indices` that have curve on both sides, in order."""
    return sorted(index for index in indices if curve.is_closed or 0 < index < len(curve.points) - 1)


def with_corners(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with corners at these points: both sides are explicit, and the shape stays.

    Ends of an open curve are left out.

    Raises
    ------
    EditError
        If there is no curve, or nothing is left.
    """
    for index in indices:
        _refuse_without_tangent(view, index)
    inner = inner_points(view.source, indices)
    if len(inner) < len(indices) == 1:
        raise EditError(f"Point {min(indices)} is an end of the curve; a corner needs curve on both sides.")
    if not inner:
        raise EditError(f"{ENDS_STAY[0].upper()}{ENDS_STAY[1:]}.")
    new = [index for index in inner if not view.source.points[index].corner]
    document = Document((view.source,))
    for index in new:
        document = make_corner(document, 0, index, None, None)
    if not new or view.sides is None:
        return view.source
    points = list(document.curves[0].points)
    for index in new:
        points[index] = with_jets(points[index], view.sides, index)
    return _kept(view, replace(view.source, points=tuple(points)), new)


def made_smooth(view: CurveView, indices: Collection[int]) -> Curve:
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
