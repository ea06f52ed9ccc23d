"""Bounds of groups of points: of whole curves the exact bounds of the curves, else those of the points.

Bounds of curves are those of their lines, without strokes. `bounds_of` gives those of a group; the exact
boxes of many curves are computed at once, or mapped, and kept with the views.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ..document.model import Vector
from ..document.point_group import PointGroup
from .curve.curve_view import CurveMap, CurveView

_AXES_ROUNDING = 1e-14
"""Rounding of a map along the axes: the share of it that may lead across them."""


def compute_boxes(views: Sequence[CurveView]) -> None:
    """Compute the exact boxes of current curves, and keep them with their views."""
    missing = [view for view in views if "bounds" not in view.__dict__]
    if not missing:
        return
    mapped = [(view, by) for view in missing if (by := view.curve_map) is not None and _keeps_axes(by)]
    alone = {id(view): view for view in missing} | {id(by.root): by.root for _, by in mapped}
    for view, _ in mapped:
        del alone[id(view)]
    _compute(view for view in alone.values() if "bounds" not in view.__dict__)
    if mapped:
        _map_boxes(mapped)


def exact_box(view: CurveView) -> FloatArray:
    """Return the box that `compute_boxes` has kept: lowest and highest corner, (2, 2)."""
    return np.asarray(view.__dict__["bounds"])


def _keeps_axes(curve_map: CurveMap) -> bool:
    (a, b), (c, d) = curve_map.matrix.tolist()
    return bool(max(abs(b), abs(c)) <= _AXES_ROUNDING * min(abs(a), abs(d)))


def _compute(views: Iterable[CurveView]) -> None:
    from curvecore.analysis.bounding_boxes import bounding_boxes  # noqa: PLC0415 - at the first use
    from curvecore.bezier.pieces import bezier_pieces  # noqa: PLC0415

    pairs = [(view, view.curve) for view in views if view.curve is not None]
    curves = [curve for _, curve in pairs]
    boxes = bounding_boxes(curves, [bezier_pieces(curve) for curve in curves])
    for (view, _), box in zip(pairs, boxes, strict=True):
        view.__dict__["bounds"] = np.array([box.minimum, box.maximum])


def _map_boxes(mapped: Sequence[tuple[CurveView, CurveMap]]) -> None:
    """Keep the boxes of views whose curves were mapped, by the boxes of their roots."""
    scale = np.array([curve_map.matrix.diagonal() for _, curve_map in mapped])[:, None]
    shift = np.array([curve_map.shift for _, curve_map in mapped])[:, None]
    before = np.array([exact_box(curve_map.root) for _, curve_map in mapped])
    by_points = before == np.array([curve_map.root.extent[0] for _, curve_map in mapped])
    points = np.array([view.extent[0] for view, _ in mapped])
    boxes = before * scale + shift
    turned = np.broadcast_to(scale < 0.0, boxes.shape)
    boxes, by_points = (np.where(turned, values[:, ::-1], values) for values in (boxes, by_points))
    boxes = np.where(by_points, points, boxes)
    boxes[:, 0] = np.minimum(boxes[:, 0], points[:, 0])
    boxes[:, 1] = np.maximum(boxes[:, 1], points[:, 1])
    for (view, _), box in zip(mapped, boxes, strict=True):
        view.__dict__["bounds"] = box


class Bounds(msgspec.Struct, frozen=True):
    """A box with its sides along the axes, by its lower left and its upper right corner."""

    low: Vector
    high: Vector

    @property
    def size(self) -> Vector:
        """Width and height."""
        return (self.high[0] - self.low[0], self.high[1] - self.low[1])

    @property
    def centre(self) -> Vector:
        """The middle."""
        return self.position(0, 0)

    def position(self, across: int, up: int) -> Vector:
        """Return one of nine positions: −1, 0 or 1 for left, middle, right, and for bottom, middle, top."""
        return (self._along(0, across), self._along(1, up))

    def _along(self, axis: int, step: int) -> float:
        low, high = self.low[axis], self.high[axis]
        return low if step < 0 else high if step > 0 else low / 2 + high / 2

    def joined(self, other: Bounds) -> Bounds:
        """Return the box around both."""
        low = (min(self.low[0], other.low[0]), min(self.low[1], other.low[1]))
        return Bounds(low, (max(self.high[0], other.high[0]), max(self.high[1], other.high[1])))


NINE: Final = tuple((across, up) for up in (1, 0, -1) for across in (-1, 0, 1))
"""The nine positions of a box in reading order: from the upper left one to the lower right one."""

_ACROSS, _UP = ("left", "middle", "right"), ("bottom", "middle", "top")


def position_name(across: int, up: int) -> str:
    """Return the name of one of the nine positions: "top left", "right", "middle"."""
    names = [_UP[up + 1]] * bool(up) + [_ACROSS[across + 1]] * bool(across)
    return " ".join(names) or "middle"


def nine_positions(bounds: Bounds) -> dict[str, Vector]:
    """Return the nine positions of a box by their names."""
    return {position_name(*at): bounds.position(*at) for at in NINE}


def bounds_of(views: Sequence[CurveView], group: PointGroup, *, as_drawn: bool = False) -> Bounds | None:
    """Return the bounds of a group, None where it has no points.

    Of a curve all of whose points are in the group they are those of the curve: exact, or `as_drawn` by its
    polyline, while it is dragged. Of some points of a curve, or where there is no curve, they are those of
    the points.
    """
    whole = _whole(views, group)
    known = {id(view) for view in whole}
    some = [
        views[curve].points[sorted(indices)]
        for curve, indices in group.parts
        if indices and id(views[curve]) not in known
    ]
    return around(some + _boxes(whole, as_drawn=as_drawn))


def _boxes(views: Sequence[CurveView], *, as_drawn: bool) -> list[FloatArray]:
    """Return boxes whose union is the box of the curves."""
    if as_drawn:
        return [view.drawn_box for view in views]
    views = _reaching_out(views)
    compute_boxes(views)
    return [exact_box(view) for view in views]


def bounds_of_groups(views: Sequence[CurveView], groups: Sequence[PointGroup]) -> list[Bounds | None]:
    """Return the bounds of many groups, as `bounds_of`, with all their curves measured at once."""
    compute_boxes([view for group in groups for view in _reaching_out(_whole(views, group))])
    return [bounds_of(views, group) for group in groups]


def _whole(views: Sequence[CurveView], group: PointGroup) -> list[CurveView]:
    """Return the views of those curves all of whose points are in a group."""
    return [views[curve] for curve, indices in group.parts if is_whole(views[curve], indices)]


def _reaching_out(views: Sequence[CurveView]) -> list[CurveView]:
    """Return the curves that may touch the box of all, by their polylines.

    Exact bounds take a tenth of a millisecond for each piece, and there may be thousands of curves.
    """
    known = [(view, box) for view in views if (box := view.known_box) is not None]
    if len(known) < 2:
        return list(views)
    corners, off = np.array([box[0] for _, box in known]), np.array([box[1] for _, box in known])
    low, high = corners[:, 0], corners[:, 1]
    far_low, far_high = low - 2.0 * off[:, None], high + 2.0 * off[:, None]
    reaches = (far_low <= low.min(axis=0)).any(axis=1) | (far_high >= high.max(axis=0)).any(axis=1)
    inside = {id(view) for (view, _), is_far in zip(known, reaches, strict=True) if not is_far}
    return [view for view in views if id(view) not in inside]


def around(boxes: Sequence[FloatArray]) -> Bounds | None:
    """Return the box around points, (k, 2) each; None where there are none."""
    if not boxes:
        return None
    corners = np.concatenate(boxes)
    low, high = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Bounds((low[0], low[1]), (high[0], high[1]))


def is_whole(view: CurveView, indices: frozenset[int]) -> bool:
    """Whether points are all points of a current curve: its bounds count, not those of its points."""
    return len(indices) == len(view.points) > 1 and view.is_current
