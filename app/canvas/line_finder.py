"""Finder of lines: which of some curves a pixel is on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ..document.model import Vector
from ..plotting.pixel_map import PixelMap
from ..tools.pointer import Hit, Part
from ..view_model.curve.curve_view import CurveView
from .hit_test import CURVE_REACH, PixelOutline
from .looks import line_of

_ANYWHERE = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])

_OUTWARD = np.array([[-1.0], [1.0]])
"""Ways of the corners of a box that grows."""


class LineFinder:
    """Finder among curves, each with its place in the document."""

    def __init__(self) -> None:
        self._views: Sequence[tuple[int, CurveView]] = ()
        # Found when somebody asks.
        self._outline: _Outline | None = None

    def render(self, views: Sequence[tuple[int, CurveView]]) -> None:
        """Find these curves from now on."""
        self._views, self._outline = views, None

    def hit(self, pixel: Vector, shown: PixelMap) -> Hit | None:
        """Return the curve at `pixel`, the last one where several lie."""
        if not self._views:
            return None
        if self._outline is None or self._outline.shown is not shown:
            self._outline = _Outline(self._views, shown)
        return self._outline.hit(pixel)


class _Outline:
    """Curves as lines of pixels; of thousands those are looked at whose boxes are near a pixel."""

    def __init__(self, views: Sequence[tuple[int, CurveView]], shown: PixelMap) -> None:
        self.shown, self._views = shown, views
        boxes, off = zip(*(_box_of(view) for _, view in views), strict=True)
        self._boxes = np.array(boxes) + np.array(off)[:, None, None] * _OUTWARD
        self._near: list[int] = []
        self._segments: PixelOutline | None = None
        self._places = np.empty(0, dtype=np.intp)

    def hit(self, pixel: Vector) -> Hit | None:
        """Return the curve within reach that is nearest."""
        self._look_near(pixel)
        nearest = None if self._segments is None else self._segments.nearest(pixel)
        if nearest is None or nearest.distance > CURVE_REACH:
            return None
        return Hit(Part.OTHER_CURVE, int(self._places[nearest.segment]), self.shown.plane(*pixel))

    def _look_near(self, pixel: Vector) -> None:
        place, reach = (
            self.shown.plane(*pixel),
            (CURVE_REACH + 1.0) / np.array([self.shown.sx, self.shown.sy]),
        )
        low, high = self._boxes[:, 0] - reach, self._boxes[:, 1] + reach
        near = np.flatnonzero(((low <= place) & (place <= high)).all(axis=1)).tolist()
        if near != self._near:
            self._near = near
            polylines = [pixels_of(self._views[each][1], self.shown) for each in near]
            self._segments = PixelOutline(polylines) if near else None
            self._places = np.repeat(
                [self._views[each][0] for each in near], [len(each) - 1 for each in polylines]
            )


def _box_of(view: CurveView) -> tuple[FloatArray, float]:
    """Return a box, and by how much the curve leaves it at most."""
    view.drawn_box  # noqa: B018 - with it the box is known, if it can be
    return view.known_box or (_ANYWHERE, 0.0)


def pixels_of(view: CurveView, shown: PixelMap) -> FloatArray:
    """Return the curve as a polyline in pixels."""
    return shown.points(line_of(view, shown).points)
