"""Which part of the plane to show: boxes around curves, and ways back into sight."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from app.plotting.pixel_map import Floats, PixelMap
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
    boxes, size = _limited(views)
    if not len(boxes):
        return None
    low, high = boxes[:, 0], boxes[:, 1]
    own = _FIT_MARGIN * size[:, None]
    # A small curve at the edge of a large drawing has the margin of the drawing.
    margin = _FIT_MARGIN * float((high.max(axis=0) - low.min(axis=0)).max())
    return Box(
        np.minimum((low - own).min(axis=0), low.min(axis=0) - margin),
        np.maximum((high + own).max(axis=0), high.max(axis=0) + margin),
    )


def with_margin(box: Box) -> Box:
    """Return a box with the margin that is left around what is shown."""
    margin = _FIT_MARGIN * float((box.high - box.low).max())
    return Box(box.low - margin, box.high + margin)


def are_in_sight(views: Sequence[CurveView], shown: PixelMap) -> bool:
    """Whether curves lie in sight, as far as `box_of` would show them."""
    return all_inside(shown, _boxes(views).reshape(-1, 2))


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


def _boxes(views: Sequence[CurveView]) -> Floats:
    """Return the boxes to show, (k, 2, 2): of the curves, at most three times as large as their points."""
    return _limited(views)[0]


def _limited(views: Sequence[CurveView]) -> tuple[Floats, Floats]:
    """Return the boxes, and of each how large what it shows counts, (k,).

    One point, or several at one place, are shown in an area of unit size (at 1e9 a visible part of that).
    """
    extents = np.array([view.extent for view in views if len(view.points)]).reshape(-1, 2, 2, 2)
    points, curves = extents[:, 0], extents[:, 1]
    size = np.ptp(points, axis=1).max(axis=1)
    low = np.maximum(curves[:, 0], points[:, 0] - size[:, None])
    high = np.minimum(curves[:, 1], points[:, 1] + size[:, None])
    visible = np.maximum(1e-6 * np.abs(high).max(axis=1), 1e-7)
    counts = np.where(size > 0.0, np.maximum((high - low).max(axis=1), visible), 4.0)
    return np.stack([low, high], axis=1), counts
