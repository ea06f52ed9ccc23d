"""Fitting: the visible part of the plane, and moving the view to curves and points."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PySide6.QtCore import QPointF

from curvecore.arrays import FloatArray

from ..document.fields import Ranges
from ..document.model import Curve
from ..plotting.camera import Camera
from ..plotting.pixel_map import PixelMap
from ..view_model.curve.curve_view import CurveView
from ..view_model.extents import around_dot

if TYPE_CHECKING:
    from .scene import CanvasScene

_FIT_MARGIN = 0.12

_LEAST_SHARE = 1e-12
"""Least size of a visible part, relative to its coordinates: some thousand floats lie on it."""

_REVEAL_MARGIN = 40.0
"""Pixels between the edge and a point to which the view was moved."""


class PlaneBox(NamedTuple):
    """Lower left and upper right corner, (2,) each, in the plane."""

    low: FloatArray
    high: FloatArray


def box_of(views: Sequence[CurveView]) -> PlaneBox | None:
    """Return the box around these curves with a margin; None without points."""
    boxes, size = _boxes_to_show(views)
    if not len(boxes):
        return None
    low, high = boxes[:, 0], boxes[:, 1]
    margins = _FIT_MARGIN * size[:, None]
    # A small curve at the edge of a large drawing has the margin of the drawing.
    margin = _FIT_MARGIN * float((high.max(axis=0) - low.min(axis=0)).max())
    return PlaneBox(
        np.minimum((low - margins).min(axis=0), low.min(axis=0) - margin),
        np.maximum((high + margins).max(axis=0), high.max(axis=0) + margin),
    )


def with_margin(box: PlaneBox) -> PlaneBox:
    """Return a box with the usual margin."""
    margin = _FIT_MARGIN * float((box.high - box.low).max())
    return PlaneBox(box.low - margin, box.high + margin)


def all_inside(pixel_map: PixelMap, points: FloatArray) -> bool:
    """Whether points (n, 2) of the plane are visible."""
    pixels = pixel_map.points(points)
    return bool(((pixels >= 0) & (pixels <= (pixel_map.width, pixel_map.height))).all())


def offset_into_view(pixel: float, size: float) -> float:
    """Return the offset that brings `pixel` into view; 0 where it is visible already."""
    margin = min(_REVEAL_MARGIN, size / 4)
    if 0 <= pixel <= size:
        return 0.0
    return (margin if pixel < 0 else size - margin) - pixel


class FramedView(NamedTuple):
    """A view of the canvas, and the curves that it fits, if any."""

    ranges: Ranges
    fitted: Sequence[Curve] | None


class Framing:
    """Ways to bring the drawing into the view of the canvas.

    Attributes
    ----------
    covered_top
        Returns the pixels at the top that a message covers; curves are fitted below it.
    """

    def __init__(self, camera: Camera, drawing: CanvasScene) -> None:
        self._camera, self._drawing = camera, drawing
        self.covered_top: Callable[[], float] = lambda: 0.0
        self._fitted: Sequence[Curve] | None = None
        camera.moved.connect(self._forget_fit)

    @property
    def shows_all_points(self) -> bool:
        """Whether every point of the active curve is visible."""
        view = self._drawing.view
        return view is None or not len(view.points) or all_inside(self._camera.pixel_map, view.points)

    def shows_curves(self, indices: Iterable[int]) -> bool:
        """Whether the curves at these indices are visible, as far as `fit` would show them."""
        boxes, _sizes = _boxes_to_show([self._drawing.views[index] for index in indices])
        return all_inside(self._camera.pixel_map, boxes.reshape(-1, 2))

    @property
    def is_as_fitted(self) -> bool:
        """Whether neither the view nor the drawing has changed since `fit`."""
        return self._fitted == self._curves

    @property
    def _curves(self) -> Sequence[Curve]:
        return [view.source for view in self._drawing.views]

    @property
    def present(self) -> FramedView:
        """The present view, for `restore`."""
        return FramedView(self._camera.ranges, self._fitted)

    def restore(self, view: FramedView) -> None:
        """Show an earlier view again, exactly where the canvas has its size of then."""
        self._camera.show_box(*view.ranges)
        self._fitted = view.fitted

    def _forget_fit(self) -> None:
        self._fitted = None

    def fit(self) -> None:
        """Show all visible curves and the active one; of an oscillating curve, its points with a margin.

        Without points, the picture to trace is shown, or else the area between the guides.
        """
        drawing = self._drawing
        views = [view for view in drawing.views if view.source.visible or view is drawing.view]
        if drawing.view is not None and not any(view is drawing.view for view in views):
            views.append(drawing.view)
        # A picture may be far larger than its traced part: it counts only without points.
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
        """Show points (k, 2) with a margin; a single position in the middle, without a zoom."""
        low, high = points.min(axis=0), points.max(axis=0)
        if (low == high).all():
            pixel_map = self._camera.pixel_map
            half = np.array([pixel_map.width / pixel_map.sx, pixel_map.height / pixel_map.sy]) / 2
            self._camera.show_box(*np.column_stack([low - half, low + half]).tolist())
        else:
            self._show(with_margin(PlaneBox(low, high)))

    def _show(self, box: PlaneBox | None) -> None:
        if box is None:
            self._camera.show_box((-0.5, 4.5), (-0.5, 4.5))
        else:
            self._show_below(*box, self.covered_top())

    def _show_below(self, low: FloatArray, high: FloatArray, covered: float) -> None:
        """Show a box below the `covered` pixels of a message at the top."""
        pixel_map = self._camera.pixel_map
        room = max(pixel_map.height - covered, 0.5 * pixel_map.height)
        # The height of the box with equal units along x and y.
        tall = max(high[1] - low[1], (high[0] - low[0]) * room / pixel_map.width)
        top = (low[1] + high[1] + tall) / 2 + tall * (pixel_map.height - room) / room
        self._camera.show_box((low[0], high[0]), ((low[1] + high[1] - tall) / 2, top))

    def selected_pixel(self) -> QPointF | None:
        """Return the pixel of the first selected point in the viewport."""
        view, selected = self._drawing.view, sorted(self._drawing.points.selection)
        if view is None or not selected or selected[0] >= len(view.points):
            return None
        return QPointF(self._camera.to_pixel(*view.points[selected[0]].tolist()))

    def reveal_selected(self) -> None:
        """Move the view so that the selected point is visible."""
        view, selected = self._drawing.view, self._drawing.points.selection
        if view is None or len(selected) != 1:
            return
        self.reveal(*self._camera.pixel_map.point(*view.points[next(iter(selected))].tolist()))

    def reveal(self, x: float, y: float) -> None:
        """Move the view so that a pixel is visible."""
        pixel_map = self._camera.pixel_map
        dx, dy = offset_into_view(x, pixel_map.width), offset_into_view(y, pixel_map.height)
        if dx or dy:
            self._camera.pan(dx, dy)


def _extent(view: CurveView) -> FloatArray:
    """Return the boxes of the points and of the curve, (2, 2, 2); of a dot, its box twice."""
    extent = view.extent
    is_dot = (extent == extent[0, 0]).all()
    return np.stack([around_dot(extent[0, 0], view.source.style)] * 2) if is_dot else extent


def _boxes_to_show(views: Sequence[CurveView]) -> tuple[FloatArray, FloatArray]:
    """Return the boxes to show, (k, 2, 2), and the size for the margin of each, (k,).

    A box is that of the curve, limited to three times the size of its points.
    A single position is shown in an area of unit size (at 1e9 a visible part of that).
    """
    extents = np.array([_extent(view) for view in views if len(view.points)]).reshape(-1, 2, 2, 2)
    points, curves = extents[:, 0], extents[:, 1]
    size = np.ptp(points, axis=1).max(axis=1)
    low = np.maximum(curves[:, 0], points[:, 0] - size[:, None])
    high = np.minimum(curves[:, 1], points[:, 1] + size[:, None])
    visible = np.maximum(_LEAST_SHARE * np.maximum(np.abs(low), np.abs(high)).max(axis=1), 1e-7)
    counts = np.where(size > 0.0, np.maximum((high - low).max(axis=1), visible), 4.0)
    return np.stack([low, high], axis=1), counts
