"""Exact boxes of many curves at once, of those that were moved or stretched along the axes by their roots'.

A map along the axes takes the box of a curve to that of its image, but for roundings; where a point is what
reaches farthest, the box reaches just as far as the point does now, to the last digit.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ..curve.curve_view import CurveView
from ..curve.made_curve import Carry

_ALONG = 1e-14
"""Share of a map that may lead across the axes: what is rounded."""


def find_boxes(views: Sequence[CurveView]) -> None:
    """Find the exact boxes of curves that there are, and keep them with their views."""
    missing = [view for view in views if "bounds" not in view.__dict__]
    if not missing:
        return
    carried = [(view, view.carry) for view in missing if view.carry is not None and _is_along(view.carry)]
    alone = {id(view): view for view in missing} | {id(carry.root): carry.root for _, carry in carried}
    for view, _ in carried:
        del alone[id(view)]
    _compute(view for view in alone.values() if "bounds" not in view.__dict__)
    if carried:
        _carry_along(carried)


def box_found(view: CurveView) -> FloatArray:
    """Return the box that was found: lowest and highest corner, (2, 2)."""
    found: FloatArray = view.__dict__["bounds"]
    return found


def _is_along(carry: Carry[CurveView]) -> bool:
    (a, b), (c, d) = carry.matrix.tolist()
    return bool(max(abs(b), abs(c)) <= _ALONG * min(abs(a), abs(d)))


def _compute(views: Iterable[CurveView]) -> None:
    from curvecore.analysis.bounding_boxes import bounding_boxes  # noqa: PLC0415 - when first looked at
    from curvecore.bezier.pieces import bezier_pieces  # noqa: PLC0415

    pairs = [(view, view.curve) for view in views if view.curve is not None]
    curves = [curve for _, curve in pairs]
    boxes = bounding_boxes(curves, [bezier_pieces(curve) for curve in curves])
    for (view, _), box in zip(pairs, boxes, strict=True):
        view.__dict__["bounds"] = np.array([box.minimum, box.maximum])


def _carry_along(carried: Sequence[tuple[CurveView, Carry[CurveView]]]) -> None:
    """Keep the boxes of views that were carried here, by those of their roots."""
    scale = np.array([carry.matrix.diagonal() for _, carry in carried])[:, None]
    shift = np.array([carry.shift for _, carry in carried])[:, None]
    before = np.array([box_found(carry.root) for _, carry in carried])
    by_points = before == np.array([carry.root.extent[0] for _, carry in carried])
    points = np.array([view.extent[0] for view, _ in carried])
    boxes = before * scale + shift
    turned = np.broadcast_to(scale < 0.0, boxes.shape)
    boxes, by_points = (np.where(turned, each[:, ::-1], each) for each in (boxes, by_points))
    boxes = np.where(by_points, points, boxes)
    boxes[:, 0] = np.minimum(boxes[:, 0], points[:, 0])
    boxes[:, 1] = np.maximum(boxes[:, 1], points[:, 1])
    for (view, _), box in zip(carried, boxes, strict=True):
        view.__dict__["bounds"] = box
