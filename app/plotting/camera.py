"""The camera of a plot: the visible part of the plane, and its position on the screen."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, QPoint, QPointF, QRect, Signal

from ..document.fields import Ranges
from ..qt.overrides import SafeOverrides
from .graphs import pg
from .pixel_map import PixelMap


class ViewBox(SafeOverrides, pg.ViewBox):  # type: ignore[misc]  # pyqtgraph has no types
    """pyqtgraph's view box without its menu.

    Attributes
    ----------
    resized
        Called after a resize, before pyqtgraph adapts the ranges: a range that is set here is the only one
        that is signalled.
    """

    resized: Callable[[], object] | None = None

    def __init__(self) -> None:
        super().__init__(enableMenu=False)

    def resizeEvent(self, event: Any) -> None:  # noqa: ANN401 - an event without a class of its own in Python
        if self.resized is not None and event.oldSize() != event.newSize():
            self.resized()
        super().resizeEvent(event)


_INSET = 2
"""Pixels by which layers stay inside the plot area: the edge belongs to the axes."""

_LEAST_SPAN = 1e-9

GREATEST_SPAN = 1e13
"""Longest range of an axis: pyqtgraph shrinks a longer one about its middle."""


class Camera(QObject):
    """Visible part of the plane: zooms and pans, and maps the plane to pixels.

    Attributes
    ----------
    area
        The part of the viewport on which layers paint, as of the last paint.
    resized
        Called when the plot area has another size, to set the visible part; without it pyqtgraph decides.

    Signals
    -------
    changed
        Another part of the plane is visible.
    steered
        The user has zoomed or panned.
    moved
        Another part has been set by the program or the user.

    Parameters
    ----------
    view
        The graphics view that shows the plot.
    box
        Its view box, which keeps the ranges.
    """

    changed = Signal()
    steered = Signal()
    moved = Signal()

    def __init__(self, view: pg.GraphicsView, box: ViewBox) -> None:
        super().__init__(view)
        self._box = box
        self._map: PixelMap | None = None
        self._origin: QPointF | None = None
        self.area = QRect()
        self.resized: Callable[[], object] | None = None
        box.resized = self.follow_area
        box.setMouseEnabled(x=False, y=False)
        box.disableAutoRange()
        box.setLimits(
            minXRange=_LEAST_SPAN, maxXRange=GREATEST_SPAN, minYRange=_LEAST_SPAN, maxYRange=GREATEST_SPAN
        )
        box.sigRangeChanged.connect(self._reset)
        box.sigResized.connect(self._reset)

    def _reset(self) -> None:
        self._map = self._origin = None
        self.changed.emit()

    def follow_area(self) -> None:
        """Adapt to another size or position of the plot area."""
        self._map = self._origin = None
        if self.resized is not None:
            self.resized()

    def reset_origin(self) -> None:
        """Forget the origin of the plot area after a resize."""
        self._origin = None

    # Plane and pixels

    @property
    def pixel_map(self) -> PixelMap:
        """The present map from the plane to the pixels of the plot area."""
        if self._map is None:
            box = self._box
            (x_range, y_range), rect = box.viewRange(), box.rect()
            self._map = PixelMap.of_ranges(tuple(x_range), tuple(y_range), rect.width(), rect.height())
        return self._map

    @property
    def origin(self) -> QPointF:
        """The pixel of the viewport at which the plot area begins."""
        if self._origin is None:
            box = self._box
            # The scene has the pixels of the viewport; the view's own map is outdated during a resize.
            self._origin = QPointF(box.mapToScene(QPointF(0, 0)))
            rect = box.rect().translated(self._origin)
            self.area = rect.adjusted(_INSET, _INSET, -_INSET, -_INSET).toAlignedRect()
        return self._origin

    def to_pixel(self, x: float, y: float) -> QPoint:
        """Return the viewport pixel nearest to a point of the plane."""
        return (self.origin + QPointF(*self.pixel_map.point(x, y))).toPoint()

    def to_plane(self, pixel: QPoint | QPointF) -> tuple[float, float]:
        """Return the point of the plane at a viewport pixel."""
        return self.pixel_map.plane(*self.area_pixel(QPointF(pixel)))

    def area_pixel(self, pixel: QPointF) -> tuple[float, float]:
        """Return a viewport pixel as a pixel of the plot area."""
        moved = pixel - self.origin
        return (moved.x(), moved.y())

    @property
    def pixel_size(self) -> float:
        """The size of a pixel in the plane, along x."""
        return 1.0 / self.pixel_map.sx

    @property
    def ranges(self) -> Ranges:
        """The visible part of the plane, exactly as it was given to `show_box`."""
        (left, right), (lower, upper) = self._box.targetRange()
        return (float(left), float(right)), (float(lower), float(upper))

    def centre(self) -> QPointF:
        """Return the middle of the plot area in viewport pixels, the centre of the zoom actions."""
        pixel_map = self.pixel_map
        return self.origin + QPointF(pixel_map.width / 2, pixel_map.height / 2)

    # Zoom and pan

    def show_box(self, x_range: tuple[float, float], y_range: tuple[float, float]) -> None:
        """Show this part of the plane."""
        self.moved.emit()
        self._box.setRange(xRange=x_range, yRange=y_range, padding=0)

    def return_to(self, ranges: Ranges, left: Ranges) -> None:
        """Show this part of the plane if the one visible is still that which was left."""
        if np.abs(np.subtract(left, self.ranges)).max() < self.pixel_size:
            self.show_box(*ranges)

    def keep(self, pixel_map: PixelMap, moved: tuple[float, float]) -> None:
        """Show the plane as in `pixel_map`, on the same pixels, though the plot area has `moved`."""
        rect = self._box.rect()
        left, top = pixel_map.plane(*moved)
        right = left + max(rect.width(), 1.0) / pixel_map.sx
        bottom = top - max(rect.height(), 1.0) / pixel_map.sy
        self._box.setRange(xRange=(left, right), yRange=(bottom, top), padding=0)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom in by `factor` (out if it is below 1) about a pixel."""
        self.steered.emit()
        x, y = self.to_plane(pixel)
        x_min, y_min, x_max, y_max = self.pixel_map.box
        if not _LEAST_SPAN < (x_max - x_min) / factor < GREATEST_SPAN:
            return
        self.show_box(
            (x + (x_min - x) / factor, x + (x_max - x) / factor),
            (y + (y_min - y) / factor, y + (y_max - y) / factor),
        )

    def pan(self, dx: float, dy: float) -> None:
        """Move the drawing by pixels."""
        self.steered.emit()
        pixel_map = self.pixel_map
        x_min, y_min, x_max, y_max = pixel_map.box
        by_x, by_y = -dx / pixel_map.sx, dy / pixel_map.sy
        self.show_box((x_min + by_x, x_max + by_x), (y_min + by_y, y_max + by_y))


class CameraOverT(Camera):
    """The camera of a plot over t: zooms and pans along t only.

    Signals
    -------
    range_requested
        The user has zoomed or panned to (start, end). A camera that is `led` waits for the owner of the
        shared axis, who calls `show_t`.
    """

    range_requested = Signal(float, float)

    def __init__(self, view: pg.GraphicsView, box: ViewBox) -> None:
        super().__init__(view, box)
        self.led = False

    @property
    def t_range(self) -> tuple[float, float]:
        """The part of t that is visible."""
        start, _, end, _ = self.pixel_map.box
        return start, end

    def show_t(self, start: float, end: float) -> None:
        """Show this part of t."""
        self._box.setXRange(start, end, padding=0)

    def _request(self, start: float, end: float) -> None:
        self.range_requested.emit(start, end)
        if not self.led:
            self.show_t(start, end)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom along t."""
        t, _ = self.to_plane(pixel)
        start, end = self.t_range
        self._request(t + (start - t) / factor, t + (end - t) / factor)

    def pan(self, dx: float, dy: float) -> None:
        """Move along t."""
        start, end = self.t_range
        offset = -dx / self.pixel_map.sx
        self._request(start + offset, end + offset)


class FixedCamera(Camera):
    """The camera of a plot that always shows everything."""

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Do nothing: everything is visible."""

    def pan(self, dx: float, dy: float) -> None:
        """Do nothing: everything is visible."""
