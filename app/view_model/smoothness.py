"""Corners made of smooth points and smooth points of corners, with the curve kept as it is.

A corner divides the estimates of the rules, and every point feels that. What it would change is written
down as it was, so that nothing moves before somebody moves it.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from msgspec.structs import replace

from app.document.edits import EditError, make_corner, make_smooth
from app.document.model import Curve, Document, Vector
from app.view_model.curve_view import CurveView
from app.view_model.reshape import estimates_kept, with_jets


def with_corners(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with corners at these nodes: both sides are explicit, and the shape stays.

    Raises
    ------
    EditError
        If there is no curve, or a node is an end of it.
    """
    new = [index for index in indices if not view.source.nodes[index].corner]
    document = Document((view.source,))
    for index in new:
        _refuse_without_tangent(view, index)
        if not view.source.is_closed and index in (0, len(view.source.nodes) - 1):
            raise EditError(f"Point {index} is an end of the curve; a corner needs curve on both sides.")
        document = make_corner(document, 0, index, None, None)
    if not new or view.sides is None:
        return view.source
    nodes = list(document.curves[0].nodes)
    for index in new:
        nodes[index] = with_jets(nodes[index], view.sides, index)
    return _kept(view, replace(view.source, nodes=tuple(nodes)), new)


def made_smooth(view: CurveView, indices: Collection[int]) -> Curve:
    """Return the curve with one velocity, and one acceleration, on both sides of these nodes.

    Each is the mean of the two; where they are alike already, the shape stays.

    Raises
    ------
    EditError
        If there is no curve.
    """
    document = Document((view.source,))
    corners = [index for index in indices if view.source.nodes[index].corner]
    for index in indices:
        _refuse_without_tangent(view, index)
        document = make_smooth(document, 0, index, _mean(view, index, 1))
    nodes = list(document.curves[0].nodes)
    if view.source.family.derivatives > 1:
        for index in corners:
            nodes[index] = replace(nodes[index], acceleration=_mean(view, index, 2))
    return _kept(view, replace(view.source, nodes=tuple(nodes)), corners)


def _refuse_without_tangent(view: CurveView, index: int) -> None:
    if view.sides is None:
        raise EditError(f"There is no tangent at point {index} yet. {view.problem}")


def _mean(view: CurveView, index: int, order: int) -> Vector:
    """Return the mean of a derivative before and after a node; at an end, that of its one side."""
    assert view.sides is not None
    before, after = view.sides.before[index, order], view.sides.after[index, order]
    if not view.source.is_closed and index == 0:
        before = after
    elif not view.source.is_closed and index == len(view.source.nodes) - 1:
        after = before
    x, y = ((before + after) / 2).tolist()
    return (x, y)


def _kept(view: CurveView, changed: Curve, but: Collection[int]) -> Curve:
    """Return `changed` with all estimates as they were, except at the nodes `but`."""
    own = np.delete(np.arange(len(changed.nodes)), sorted(but))
    return estimates_kept(view, changed, own, own)
