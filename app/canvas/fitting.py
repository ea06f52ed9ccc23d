"""Which part of the plane to show: boxes around curves, and ways back into sight."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from app.plot.pixel_map import Floats, PixelMap
from app.view_model.curve_view import CurveView

_FIT_MARGIN = 0.12

_REVEAL_MARGIN = 40.0
"""Pixels between the edge and a point that the view was moved to show."""


class Box(NamedTuple):
    """Lower left and upper right corner, (2,) each, in the plane."""

    low: Floats
    high: Floats


def box_of(views: Sequence[CurveView]) -> Box | None:
    """Return the box that shows all these curves with a margin; None where there is no point."""
    boxes = _boxes(views, margin=_FIT_MARGIN)
    if not boxes:
        return None
    around, bare = _hull(boxes), _hull(_boxes(views, margin=0.0))
    # A small curve at the edge of a large drawing has the margin of the drawing.
    margin = _FIT_MARGIN * float((bare.high - bare.low).max())
    return Box(np.minimum(around.low, bare.low - margin), np.maximum(around.high, bare.high + margin))


def with_margin(box: Box) -> Box:
    """Return a box with the margin that is left around what is shown."""
    margin = _FIT_MARGIN * float((box.high - box.low).max())
    return Box(box.low - margin, box.high + margin)


def are_in_sight(views: Sequence[CurveView], shown: PixelMap) -> bool:
    """Whether curves lie in sight, as far as `box_of` would show them."""
    return all(all_inside(shown, np.array(box)) for box in _boxes(views, margin=0.0))


def all_inside(shown: PixelMap, points: Floats) -> bool:
    """Whether points (n, 2) of the plane lie in sight."""
    pixels = shown.points(points)
    return bool(((pixels >= 0) & (pixels <= (shown.width, shown.height))).all())


def way_back_inside(pixel: float, size: float) -> float:
    """Return how far to move what lies at `pixel` so that it is in sight; 0 where it is already."""
    margin = min(_REVEAL_MARGIN, size / 4)
    if 0 <= pixel <= size:
        return 0.0
    return (margin if pixel < 0 else size - margin) - pixel


def _hull(boxes: Sequence[Box]) -> Box:
    return Box(np.min([box.low for box in boxes], axis=0), np.max([box.high for box in boxes], axis=0))


def _boxes(views: Sequence[CurveView], *, margin: float) -> list[Box]:
    return [_box_of(view.points, view.polyline, margin) for view in views if len(view.points)]


def _box_of(points: Floats, polyline: Floats, margin: float) -> Box:
    """Return the box to show: that of the curve, but at most three times as large as its points."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    if len(polyline):
        low = np.maximum(np.minimum(low, polyline.min(axis=0)), low - size)
        high = np.minimum(np.maximum(high, polyline.max(axis=0)), high + size)
    # One point, or several at one place, are shown in an area of unit size (at 1e9 a visible part of that).
    size = max(float((high - low).max()), 1e-6 * float(np.abs(high).max()), 1e-7) if size else 4.0
    return Box(low - margin * size, high + margin * size)
