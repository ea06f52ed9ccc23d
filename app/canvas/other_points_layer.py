"""Points and handles of the curves that are edited beside the active one: found, shown where selected."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from curvecore.arrays import IntArray

from ..appearance.theme import Theme
from ..document.model import Vector
from ..document.point_group import NO_POINTS, PointGroup
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import Stamps
from ..plotting.text import write_in_corner
from ..view_model.curve.curve_view import CurveView
from ..view_model.point_kinds import POINT_KINDS, kinds_of
from .handle_marks import LEFT_AWAY, MOST_POINTS, ShownHandles
from .hit_test import PartFound, PixelPoints, handle_or_point
from .point_marks import Inks, paint_mark

_RADIUS, _RIM, _GAP, _RING = 4.5, 1.5, 3.0, 2.0
_REACH = 2.2
"""How far ring and mark reach, where the radius of the mark is 1."""


class OtherPointsLayer(Layer):
    """Layer of the selected points of the curves that are edited beside the active one.

    They have the colour of what is selected: those of points belong to the basis functions of the active
    curve. Their handles are as those of the active one. It finds all points of these curves; those that are
    not selected are drawn with the curves.

    Parameters
    ----------
    is_told
        Whether it is said already that something is left away.
    """

    z = 9.0

    def __init__(self, plot: PlotWidget, is_told: Callable[[], bool]) -> None:
        super().__init__(plot)
        self._is_told = is_told
        # As in the layer of the active curve.
        self.over_picture = False
        self._views: list[tuple[int, CurveView]] = []
        self._group = NO_POINTS
        self._ringed = _SelectedStamps(self._stamp, _REACH)
        self._plain = _SelectedStamps(_stamp_plain, _REACH)
        # As in the layer of the active curve.
        self.is_plain = False
        self._kinds: IntArray = np.arange(len(POINT_KINDS))
        self._places: PixelPoints | None = None
        self.set_visible(False)
        self._handles: dict[int, ShownHandles] = {}
        self._inks = Inks()

    def render(self, views: Sequence[CurveView], places: Sequence[int]) -> None:
        """Show and find the points of those of `views` at these places from the next paint on."""
        found = [(place, views[place]) for place in places]
        if found != self._views:
            self._views, self._places = found, None
            self._find_handles()
            self.set_visible(bool(found))
            self.update()

    def set_group(self, group: PointGroup) -> None:
        """Show which points are selected, of whatever curves."""
        if group != self._group:
            self._group = group
            self._find_handles()
            self.update()

    def _find_handles(self) -> None:
        before, self._handles = self._handles, {}
        for place, view in self._views:
            if indices := self._group.of(place):
                self._handles[place] = before.get(place) or ShownHandles()
                self._handles[place].find(view, indices, free=False)

    def handles(self, pixel_map: PixelMap) -> list[tuple[int, ShownHandles]]:
        """Return the handles that are shown, by their curves; none where too many are in sight."""
        count = sum(len(each.of_selected(pixel_map).indices) for each in self._handles.values())
        return list(self._handles.items()) if count <= 2 * MOST_POINTS else []

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the selected points in sight, all in one call, and their handles."""
        self._paint_handles(painter, pixel_map)
        chosen = [(view, self._selected(place, view)) for place, view in self._views]
        parts = [(view, indices) for view, indices in chosen if indices]
        if not parts:
            return
        pixels = pixel_map.points(np.concatenate([view.points[indices] for view, indices in parts]))
        kinds = np.concatenate([kinds_of(view)[indices] for view, indices in parts])
        margin = _REACH * _RADIUS * self.scale
        near = ((pixels > -margin) & (pixels < (pixel_map.width + margin, pixel_map.height + margin))).all(
            axis=1
        )
        radius, rim = _RADIUS * self.scale, _RIM * self.scale
        stamps = self._plain if self.is_plain else self._ringed
        stamps.draw(
            painter, pixels[near], kinds[near], len(POINT_KINDS), self.theme, radius, rim, self._kinds
        )

    def _paint_handles(self, painter: QPainter, pixel_map: PixelMap) -> None:
        if not self._handles:
            return
        ink = self._inks.of(self.theme, self.scale, self.fonts, over_picture=self.over_picture)
        handles = self.handles(pixel_map)
        for _, each in handles:
            each.paint(painter, pixel_map, ink)
        notes = [each.note(pixel_map) for each in self._handles.values()] if handles else [LEFT_AWAY]
        if any(notes) and not self._is_told():
            painter.setFont(self.fonts.times(0.9 * self.scale))
            write_in_corner(painter, max(notes), self.theme.paper, self.theme.muted)

    def _selected(self, place: int, view: CurveView) -> list[int]:
        # What is selected may be told before the views of another document are.
        count = len(view.points)
        return sorted(index for index in self._group.of(place) if index < count)

    def _stamp(self, painter: QPainter, radius: float, kind: int) -> None:
        paint_mark(painter, QPointF(0.0, 0.0), radius, kind, self.theme.paper)
        unit = radius / _RADIUS
        painter.save()
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, _RING * unit))
        painter.drawEllipse(QPointF(0.0, 0.0), radius + _GAP * unit, radius + _GAP * unit)
        painter.restore()

    def nearest(self, pixel: Vector, pixel_map: PixelMap) -> PartFound | None:
        """Return the point or the handle within reach that is nearest to `pixel`."""
        if not self._views:
            return None
        if self._places is None or self._places.shown != pixel_map:
            self._places = PixelPoints(self._views, pixel_map)
        point, handles = self._places.nearest(pixel, self._group), self.handles(pixel_map)
        if not handles:
            return point
        own = [(place, each.of_selected(pixel_map)) for place, each in handles]
        facing = [(place, each.facing(pixel_map)) for place, each in handles]
        return handle_or_point(pixel, pixel_map, point, own, facing, self._group)


def _stamp_plain(painter: QPainter, radius: float, kind: int) -> None:
    paint_mark(painter, QPointF(0.0, 0.0), radius, kind)


class _SelectedStamps(Stamps):
    """Marks in the colour of what is selected, one for each kind of point."""

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return [theme.accent] * count
