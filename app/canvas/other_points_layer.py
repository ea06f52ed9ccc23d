"""Points and handles of the curves that are edited together with the active one."""

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
from .handle_marks import MOST_POINTS, TOO_MANY_HANDLES, VisibleHandles
from .hit_test import NearestPart, PixelPoints, handle_or_point
from .point_marks import InkCache, paint_mark, paint_plain

_RADIUS, _RIM, _GAP, _RING = 4.5, 1.5, 3.0, 2.0
_REACH = 2.2
"""Reach of ring and mark, relative to the radius of the mark."""


class OtherPointsLayer(Layer):
    """Layer of the selected points of the curves that are edited together with the active one.

    The points have the colour of the selection: the colours of points belong to the basis functions of the
    active curve. The hit test finds all points of these curves; points that are not selected are drawn with
    the curves.

    Parameters
    ----------
    is_told
        Returns whether a note about hidden handles is shown already.
    """

    z = 9.0

    def __init__(self, plot: PlotWidget, has_note: Callable[[], bool]) -> None:
        super().__init__(plot)
        self._has_note = has_note
        # As in the layer of the active curve.
        self.over_picture = False
        self._views: list[tuple[int, CurveView]] = []
        self._group = NO_POINTS
        self._ringed = _SelectedStamps(self._stamp, _REACH)
        self._plain = _SelectedStamps(paint_plain, _REACH)
        # As in the layer of the active curve.
        self.is_plain = False
        self._kinds: IntArray = np.arange(len(POINT_KINDS))
        self._pixel_points: PixelPoints | None = None
        self.set_visible(False)
        self._handles: dict[int, VisibleHandles] = {}
        self._inks = InkCache()

    def render(self, views: Sequence[CurveView], indices: Sequence[int]) -> None:
        """Show and find the points of the views at these indices from the next paint on."""
        edited = [(index, views[index]) for index in indices]
        if edited != self._views:
            self._views, self._pixel_points = edited, None
            self._find_handles()
            self.set_visible(bool(edited))
            self.update()

    def set_group(self, group: PointGroup) -> None:
        """Show these points, of any curves, as selected."""
        if group != self._group:
            self._group = group
            self._find_handles()
            self.update()

    def _find_handles(self) -> None:
        before, self._handles = self._handles, {}
        for curve, view in self._views:
            if points := self._group.of(curve):
                self._handles[curve] = before.get(curve) or VisibleHandles()
                self._handles[curve].find(view, points, free=False)

    def handles(self, pixel_map: PixelMap) -> list[tuple[int, VisibleHandles]]:
        """Return the visible handles, with the indices of their curves; none where they are too many."""
        count = sum(len(handles.of_selected(pixel_map).indices) for handles in self._handles.values())
        return list(self._handles.items()) if count <= 2 * MOST_POINTS else []

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the visible selected points, all in one call, and their handles."""
        self._paint_handles(painter, pixel_map)
        selected = [(view, self._selected(curve, view)) for curve, view in self._views]
        parts = [(view, indices) for view, indices in selected if indices]
        if not parts:
            return
        pixels = pixel_map.points(np.concatenate([view.points[indices] for view, indices in parts]))
        kinds = np.concatenate([kinds_of(view)[indices] for view, indices in parts])
        near = pixel_map.near(pixels, _REACH * _RADIUS * self.scale)
        radius, rim = _RADIUS * self.scale, _RIM * self.scale
        stamps = self._plain if self.is_plain else self._ringed
        count, theme = len(POINT_KINDS), self.theme
        stamps.draw(painter, pixels[near], kinds[near], count, theme, radius, rim, self._kinds)

    def _paint_handles(self, painter: QPainter, pixel_map: PixelMap) -> None:
        if not self._handles:
            return
        ink = self._inks.of(self.theme, self.scale, self.fonts, over_picture=self.over_picture)
        visible = self.handles(pixel_map)
        for _, handles in visible:
            handles.paint(painter, pixel_map, ink)
        notes = [TOO_MANY_HANDLES]
        if visible:
            notes = [handles.note(pixel_map) for handles in self._handles.values()]
        if any(notes) and not self._has_note():
            painter.setFont(self.fonts.times(0.9 * self.scale))
            write_in_corner(painter, max(notes), self.theme.paper, self.theme.muted)

    def _selected(self, curve: int, view: CurveView) -> list[int]:
        # The selection may arrive before the views of another document.
        count = len(view.points)
        return sorted(index for index in self._group.of(curve) if index < count)

    def _stamp(self, painter: QPainter, radius: float, kind: int) -> None:
        paint_mark(painter, QPointF(0.0, 0.0), radius, kind, self.theme.paper)
        unit = radius / _RADIUS
        painter.save()
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, _RING * unit))
        painter.drawEllipse(QPointF(0.0, 0.0), radius + _GAP * unit, radius + _GAP * unit)
        painter.restore()

    def nearest(self, pixel: Vector, pixel_map: PixelMap) -> NearestPart | None:
        """Return the point or the handle within reach that is nearest to `pixel`."""
        if not self._views:
            return None
        if self._pixel_points is None or self._pixel_points.pixel_map != pixel_map:
            self._pixel_points = PixelPoints(self._views, pixel_map)
        point, handles = self._pixel_points.nearest(pixel, self._group), self.handles(pixel_map)
        if not handles:
            return point
        of_selected = [(curve, visible_handles.of_selected(pixel_map)) for curve, visible_handles in handles]
        facing = [(curve, visible_handles.facing(pixel_map)) for curve, visible_handles in handles]
        return handle_or_point(pixel, pixel_map, point, of_selected, facing, self._group)


class _SelectedStamps(Stamps):
    """Marks in the colour of the selection, one for each kind of point."""

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return [theme.accent] * count
