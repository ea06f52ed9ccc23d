"""Fitting: the part of the plane that shows curves, and ways back into sight."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PySide6.QtCore import QPointF

from curvecore.arrays import FloatArray

from ..document.model import Curve
from ..plotting.camera import Camera
from ..plotting.pixel_map import PixelMap
from ..view_model.curve.curve_view import CurveView
from ..view_model.stroke_box import around_dot

if TYPE_CHECKING:
    from .scene import CanvasScene

_FIT_MARGIN = 0.12

_REVEAL_MARGIN = 40.0
"""Pixels between the edge and a point that the view was moved to show."""


class PlaneBox(NamedTuple):
    """Lower left and upper right corner, (2,) each, in the plane."""

    low: FloatArray
    high: FloatArray


def box_of(views: Sequence[CurveView]) -> PlaneBox | None:
    """Return the box that shows all these curves with a margin; None where there is no point."""
    boxes, size = _limited(views)
    if not len(boxes):
        return None
    low, high = boxes[:, 0], boxes[:, 1]
    own = _FIT_MARGIN * size[:, None]
    # A small curve at the edge of a large drawing has the margin of the drawing.
    margin = _FIT_MARGIN * float((high.max(axis=0) - low.min(axis=0)).max())
    return PlaneBox(
        np.minimum((low - own).min(axis=0), low.min(axis=0) - margin),
        np.maximum((high + own).max(axis=0), high.max(axis=0) + margin),
    )


def with_margin(box: PlaneBox) -> PlaneBox:
    """Return a box with the margin that is left around what is shown."""
    margin = _FIT_MARGIN * float((box.high - box.low).max())
    return PlaneBox(box.low - margin, box.high + margin)


def all_inside(pixel_map: PixelMap, points: FloatArray) -> bool:
    """Whether points (n, 2) of the plane lie in sight."""
    pixels = pixel_map.points(points)
    return bool(((pixels >= 0) & (pixels <= (pixel_map.width, pixel_map.height))).all())


def way_back_inside(pixel: float, size: float) -> float:
    """Return how far to move what lies at `pixel` so that it is in sight; 0 where it is already."""
    margin = min(_REVEAL_MARGIN, size / 4)
    if 0 <= pixel <= size:
        return 0.0
    return (margin if pixel < 0 else size - margin) - pixel


class Framing:
    """Ways to bring the drawing into the view of the canvas.

    Attributes
    ----------
    covered_top
        Tells how many pixels at the top a message covers; what is fitted into the view stays clear of it.
    """

    def __init__(self, camera: Camera, drawing: CanvasScene) -> None:
        self._camera, self._drawing = camera, drawing
        self.covered_top: Callable[[], float] = lambda: 0.0
        self._fitted: Sequence[Curve] | None = None
        camera.moved.connect(self._forget_fit)

    @property
    def shows_all_points(self) -> bool:
        """Whether every point of the active curve is in sight."""
        view = self._drawing.view
        return view is None or not len(view.points) or all_inside(self._camera.pixel_map, view.points)

    def shows_curves(self, places: Iterable[int]) -> bool:
        """Whether the curves at these places lie in sight, as far as `fit` would show them."""
        boxes, _sizes = _limited([self._drawing.views[place] for place in places])
        return all_inside(self._camera.pixel_map, boxes.reshape(-1, 2))

    @property
    def is_as_fitted(self) -> bool:
        """Whether neither the view nor the drawing has changed since all was fitted into it."""
        return self._fitted == self._curves

    @property
    def _curves(self) -> Sequence[Curve]:
        return [view.source for view in self._drawing.views]

    def _forget_fit(self) -> None:
        self._fitted = None

    def fit(self) -> None:
        """Show all visible curves and the active one; of a wild one, its points and their surroundings.

        Where there are no points the picture to trace is shown, or else what lies between guides.
        """
        drawing = self._drawing
        views = [view for view in drawing.views if view.source.visible or view is drawing.view]
        if drawing.view is not None and not any(view is drawing.view for view in views):
            views.append(drawing.view)
        # A picture may be far larger than what is traced of it; it counts while there is nothing else.
        image = drawing.image.corners
        box = box_of(views)
        if box is None:
            corners = image if image is not None else drawing.guides.corners
            box = None if corners is None else with_margin(PlaneBox(*corners))
        self._show(box)
        self._fitted = self._curves

    def fit_views(self, views: Sequence[CurveView]) -> None:
        """Show these curves, with a margin."""
        self._show(box_of(views))

    def fit_points(self, points: FloatArray) -> None:
        """Show points (k, 2) with a margin; a place alone in the middle, as large as it is now."""
        low, high = points.min(axis=0), points.max(axis=0)
        if (low == high).all():
            shown = self._camera.pixel_map
            half = np.array([shown.width / shown.sx, shown.height / shown.sy]) / 2
            self._camera.show_box(*np.column_stack([low - half, low + half]).tolist())
        else:
            self._show(with_margin(PlaneBox(low, high)))

    def _show(self, box: PlaneBox | None) -> None:
        if box is None:
            self._camera.show_box((-0.5, 4.5), (-0.5, 4.5))
        else:
            self._show_below(*box, self.covered_top())

    def _show_below(self, low: FloatArray, high: FloatArray, covered: float) -> None:
        """Show a box below `covered` pixels at the top, on which a message lies."""
        shown = self._camera.pixel_map
        room = max(shown.height - covered, 0.5 * shown.height)
        # As tall as it becomes with equal units along x and y.
        tall = max(high[1] - low[1], (high[0] - low[0]) * room / shown.width)
        top = (low[1] + high[1] + tall) / 2 + tall * (shown.height - room) / room
        self._camera.show_box((low[0], high[0]), ((low[1] + high[1] - tall) / 2, top))

    def selected_pixel(self) -> QPointF | None:
        """Return where the first selected point lies in the viewport."""
        view, selected = self._drawing.view, sorted(self._drawing.points.selection)
        if view is None or not selected or selected[0] >= len(view.points):
            return None
        return QPointF(self._camera.to_pixel(*view.points[selected[0]].tolist()))

    def reveal_selected(self) -> None:
        """Move the view so far that the selected point is in sight."""
        view, selected = self._drawing.view, self._drawing.points.selection
        if view is None or len(selected) != 1:
            return
        self.reveal(*self._camera.pixel_map.point(*view.points[next(iter(selected))].tolist()))

    def reveal(self, x: float, y: float) -> None:
        """Move the view so far that a pixel is in sight."""
        shown = self._camera.pixel_map
        dx, dy = way_back_inside(x, shown.width), way_back_inside(y, shown.height)
        if dx or dy:
            self._camera.pan(dx, dy)


def _extent(view: CurveView) -> FloatArray:
    """Return the boxes of the points and of the curve, (2, 2, 2), or twice that of the dot that it is."""
    extent = view.extent
    is_dot = (extent == extent[0, 0]).all()
    return np.stack([around_dot(extent[0, 0], view.source.style)] * 2) if is_dot else extent


def _limited(views: Sequence[CurveView]) -> tuple[FloatArray, FloatArray]:
    """Return the boxes to show, (k, 2, 2), and of each how large what it shows counts, (k,).

    They are those of the curves, and at most three times as large as their points.
    One point, or several at one place, are shown in an area of unit size (at 1e9 a visible part of that).
    """
    extents = np.array([_extent(view) for view in views if len(view.points)]).reshape(-1, 2, 2, 2)
    points, curves = extents[:, 0], extents[:, 1]
    size = np.ptp(points, axis=1).max(axis=1)
    low = np.maximum(curves[:, 0], points[:, 0] - size[:, None])
    high = np.minimum(curves[:, 1], points[:, 1] + size[:, None])
    visible = np.maximum(1e-6 * np.abs(high).max(axis=1), 1e-7)
    counts = np.where(size > 0.0, np.maximum((high - low).max(axis=1), visible), 4.0)
    return np.stack([low, high], axis=1), counts
