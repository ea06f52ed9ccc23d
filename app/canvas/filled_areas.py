"""Insides of filled shapes, as far as a press on them means them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ..document.model import Curve, Vector
from ..document.shapes import shapes
from ..plotting.pixel_map import PixelMap
from ..tools.pointer import Hit, Part
from ..view_model.curve.curve_view import CurveView
from ..view_model.geometry import is_inside, windings
from .looks import line_of


class FilledAreas:
    """Filled shapes that are seen and free, and the boxes around them.

    A locked one is no more in the way than the paper is.
    """

    def __init__(self) -> None:
        self._views: Sequence[CurveView] = ()
        # Found when somebody asks, and kept as long as the views are the same.
        self._shapes: list[range] | None = None
        self._boxes = np.empty((0, 2, 2))

    def render(self, views: Sequence[CurveView]) -> None:
        """Take the areas of these views."""
        if views is not self._views:
            self._views, self._shapes = views, None

    def hit(self, pixel: Vector, shown: PixelMap, active: int | None, line: Hit | None) -> Hit | None:
        """Return what lies at `pixel`: the topmost area, or the `line` there unless the area covers it.

        The inside of the shape that is edited is nothing: a rubber band for its points begins there.
        """
        top = self._topmost(pixel, shown)
        if top is None or (line is not None and line.index >= top.start):
            return line
        return (
            Hit(Part.OTHER_CURVE, top.start, shown.plane(*pixel), inside=True) if active not in top else None
        )

    def _topmost(self, pixel: Vector, shown: PixelMap) -> range | None:
        if self._shapes is None:
            self._find()
        assert self._shapes is not None
        place = np.array([shown.plane(*pixel)])
        around = np.all((self._boxes[:, 0] <= place) & (place <= self._boxes[:, 1]), axis=1)
        for number in reversed(np.flatnonzero(around).tolist()):
            views = self._drawn(self._shapes[number])
            turns = windings([line_of(view, shown).points for view in views], place)
            if is_inside(turns, views[0].source.style.fill_rule)[0]:
                return self._shapes[number]
        return None

    def _find(self) -> None:
        curves = [view.source for view in self._views]
        filled = [each for each in shapes(curves) if _is_pressed(curves[each.start])]
        self._shapes = [each for each in filled if self._drawn(each)]
        self._boxes = np.array([self._box(each) for each in self._shapes]).reshape(-1, 2, 2)

    def _drawn(self, places: range) -> list[CurveView]:
        return [self._views[place] for place in places if self._views[place].has_curve]

    def _box(self, places: range) -> FloatArray:
        first, *others = [view.drawn_box for view in self._drawn(places)]
        if not others:
            return first
        corners = np.vstack([first, *others])
        return np.array([corners.min(axis=0), corners.max(axis=0)])


def _is_pressed(curve: Curve) -> bool:
    """Whether what begins with a curve is filled, seen and free."""
    return curve.style.has_fill and curve.is_free
