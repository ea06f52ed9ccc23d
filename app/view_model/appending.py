"""Points appended and curves closed so that no handle grows beyond what was drawn.

A node has one velocity, and its handles lie at ±h·v/3 of the segments on its two sides: a segment that is ten
times as long as the one before it would pull the handle ahead ten times as far out as the person did.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from msgspec.structs import replace

from app.document.edits import append_node, insert_nodes, stretched
from app.document.model import Curve, Document, Node, Vector
from app.view_model.closing import with_closed
from app.view_model.curve_view import CurveView, appended_parameter, appended_squeeze, parameters_of
from curvecore import CurveError


def with_point_appended(document: Document, curve: int, view: CurveView, position: Vector) -> Document:
    """Return the document with a new last point on its curve `curve`, which `view` shows.

    What was set before is rescaled so that handles stay. The node that was the last one of an open curve gets
    a segment on its other side, and its velocity shrinks until neither handle is longer than what was drawn.
    The handle of a node that stood alone is the one ahead of it, and stays.

    Raises
    ------
    EditError
        If the position is not one that a document may hold.
    """
    t = appended_parameter(view, Node(*position)) if view.source.is_manual else None
    return with_nodes_appended(document, curve, view, [Node(*position, t=t)])


def with_nodes_appended(document: Document, curve: int, view: CurveView, nodes: Sequence[Node]) -> Document:
    """Return the document with `nodes` at the end of its curve `curve`; handles as by `with_point_appended`.

    Raises
    ------
    EditError
        If they are not what a document may hold.
    """
    count = len(view.source.nodes)
    document = append_node(document, curve, nodes[0], squeeze=appended_squeeze(view, nodes))
    document = insert_nodes(document, curve, count + 1, nodes[1:])
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
    return _kept_short(document, curve, view, [0, len(view.source.nodes) - 1])


def _kept_short(document: Document, curve: int, view: CurveView, ends: Collection[int]) -> Document:
    """Shrink what was set at the ends of `view`, which have a segment more now, to the longer of the two."""
    grown = document.curves[curve]
    ends = [index for index in ends if _is_set(view.source, index)]
    if not ends or not view.is_current:
        return document
    points = np.array([node.position for node in grown.nodes])
    try:
        h = np.diff(parameters_of(grown, np.vstack([points, points[:1]]) if grown.is_closed else points))
    except CurveError:
        return document
    nodes = list(grown.nodes)
    for index in ends:
        drawn = view.spacing(index, ahead=index == 0)
        if drawn:
            # From what was drawn, not from what the squeeze has made of it: the factor is for both.
            nodes[index] = stretched(view.source.nodes[index], float(max(h[index - 1], h[index])) / drawn)
    return document.with_curve(curve, replace(grown, nodes=tuple(nodes)))


def _is_set(curve: Curve, index: int) -> bool:
    """Whether the person set a derivative that the family uses at a node."""
    node = curve.nodes[index] if 0 <= index < len(curve.nodes) else None
    if node is None or not curve.family.derivatives:
        return False
    given = (node.velocity, node.velocity_after, node.acceleration, node.acceleration_after)
    return any(value is not None for value in given)
