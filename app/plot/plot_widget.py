"""A pyqtgraph plot that we paint, pan and zoom ourselves.

pyqtgraph supplies the view box, the axes and the ranges. Its mouse layer is bypassed (it throttles moves and
tests every item), and all drawing is done by layers that paint in pixels of the plot area.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QEnterEvent,
    QFocusEvent,
    QFont,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QGraphicsItem, QGraphicsView, QStyleOptionGraphicsItem, QWidget

from app.gestures.pointer import Pointer
from app.plot.pixel_map import PixelMap
from app.theme import Theme

ZOOM_STEP = 1.2
"""Zoom factor of one notch of the wheel."""

_AXIS_WIDTH = 46

_INSET = 3
"""Pixels by which layers stay inside the plot area: nearer to its edge, Qt repaints the axes every frame."""

_LEAST_SPAN, _GREATEST_SPAN = 1e-9, 1e13


class Layer(QGraphicsItem):
    """One layer of the drawing: a function that paints in pixels of the plot area."""

    def __init__(self, plot: PlotWidget, paint: Callable[[QPainter, PixelMap], None]) -> None:
        super().__init__(plot.getViewBox())
        self._plot, self._paint = plot, paint
        self._rect = QRectF()

    def resize(self, rect: QRectF) -> None:
        """Follow the plot area."""
        self.prepareGeometryChange()
        self._rect = rect.adjusted(_INSET, _INSET, -_INSET, -_INSET)

    def boundingRect(self) -> QRectF:
        return self._rect

    def paint(
        self,
        painter: QPainter,
        option: QStyleOptionGraphicsItem,
        widget: QWidget | None = None,
    ) -> None:
        """Paint; called by Qt."""
        try:
            painter.setClipRect(self._rect.adjusted(-1, -1, 1, 1))
            self._paint(painter, self._plot.pixel_map)
        except Exception:
            # An exception that leaves a paint method crashes the process (PySide6 6.11): report it here.
            sys.excepthook(*sys.exc_info())


class _Axis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """An axis without a label, which pyqtgraph would lay out again for every pen and range it is given."""

    def labelString(self) -> str:  # noqa: N802
        return ""


class PlotWidget(pg.PlotWidget):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot with layers, exact pixel mapping, wheel zoom and panning.

    Signals
    -------
    painted
        The viewport has been painted.
    map_changed
        Another part of the plane is visible.
    """

    painted = Signal()
    map_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        # Menus of its own that are never shown take pyqtgraph a tenth of the start to build.
        axes = {side: _Axis(side) for side in ("left", "bottom")}
        super().__init__(parent, enableMenu=False, axisItems=axes)
        self._layers: list[Layer] = []
        self._map: PixelMap | None = None
        self._pan_from: QPointF | None = None
        self._space_down = False
        self._menu_refused = False
        self._set_up_plot()
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        # With it Qt repaints one pixel around each layer, without it two; see _INSET.
        self.setOptimizationFlag(QGraphicsView.OptimizationFlag.DontAdjustForAntialiasing, True)
        # A dropped file is the window's business.
        self.setAcceptDrops(False)

    def _set_up_plot(self) -> None:
        self.setMenuEnabled(False)
        # pyqtgraph builds this menu even so, without a parent; left alone it would keep the whole window.
        self.destroyed.connect(self.plotItem.ctrlMenu.deleteLater)
        self.hideButtons()
        box = self.getViewBox()
        box.setMouseEnabled(x=False, y=False)
        box.disableAutoRange()
        box.setLimits(
            minXRange=_LEAST_SPAN, maxXRange=_GREATEST_SPAN, minYRange=_LEAST_SPAN, maxYRange=_GREATEST_SPAN
        )
        box.sigRangeChanged.connect(self._forget_map)
        box.sigResized.connect(self._forget_map)
        for name in ("left", "bottom", "top", "right"):
            # There is no unit to put a prefix to, but pyqtgraph would lay its label out at every new range.
            self.getAxis(name).enableAutoSIPrefix(False)
        for name in ("left", "bottom"):
            self.getAxis(name).setStyle(tickLength=5, tickTextOffset=4, hideOverlappingLabels=True)
        # The left axes of all plots have one width: they stay aligned, and nothing jumps when numbers grow.
        PlotWidget.set_scale(self, 1.0)

    def add_layer(self, paint: Callable[[QPainter, PixelMap], None], *, z: float) -> Layer:
        """Add a layer that `paint` draws; higher `z` is nearer to the eye."""
        layer = Layer(self, paint)
        layer.setZValue(z)
        layer.resize(self.getViewBox().rect())
        self._layers.append(layer)
        return layer

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.setBackground(theme.paper)
        for name in ("left", "bottom"):
            axis = self.getAxis(name)
            axis.setPen(QColor(theme.grid_coarse))
            axis.setTextPen(QColor(theme.muted))
        self.viewport().update()

    def set_scale(self, scale: float) -> None:
        """Enlarge the numbers at the axes."""
        font = QFont(self.font())
        font.setPointSizeF(max(self.font().pointSizeF() - 1.5, 7.0) * scale)
        for name in ("left", "bottom"):
            self.getAxis(name).setTickFont(font)
        self.getAxis("left").setWidth(_AXIS_WIDTH * scale)
        self.viewport().update()

    # Plane and pixels

    @property
    def pixel_map(self) -> PixelMap:
        """The present map from the plane to the pixels of the plot area."""
        if self._map is None:
            box = self.getViewBox()
            (x_range, y_range), rect = box.viewRange(), box.rect()
            self._map = PixelMap.of_ranges(tuple(x_range), tuple(y_range), rect.width(), rect.height())
        return self._map

    def _area_origin(self) -> QPointF:
        """Return where in the viewport the plot area begins."""
        box = self.getViewBox()
        return QPointF(self.viewportTransform().map(box.mapToScene(QPointF(0, 0))))

    def to_pixel(self, x: float, y: float) -> QPoint:
        """Return the viewport pixel nearest to a point of the plane."""
        pixel = self.pixel_map.point(x, y)
        return (self._area_origin() + QPointF(*pixel)).toPoint()

    def to_plane(self, pixel: QPoint | QPointF) -> tuple[float, float]:
        """Return the point of the plane at a viewport pixel."""
        return self.pixel_map.plane(*self.area_pixel(QPointF(pixel)))

    def area_pixel(self, pixel: QPointF) -> tuple[float, float]:
        """Return a viewport pixel as a pixel of the plot area."""
        moved = pixel - self._area_origin()
        return (moved.x(), moved.y())

    def _forget_map(self) -> None:
        self._map = None
        rect = self.getViewBox().rect()
        for layer in self._layers:
            layer.resize(rect)
        self.map_changed.emit()

    def show_box(self, x_range: tuple[float, float], y_range: tuple[float, float]) -> None:
        """Show this part of the plane."""
        self.getViewBox().setRange(xRange=x_range, yRange=y_range, padding=0)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom in by `factor` (out where it is below one), keeping what lies under the pixel there."""
        x, y = self.to_plane(pixel)
        self._scale_about(1 / factor, x, y)

    def _scale_about(self, factor: float, x: float, y: float) -> None:
        x_min, y_min, x_max, y_max = self.pixel_map.box
        if not _LEAST_SPAN < (x_max - x_min) * factor < _GREATEST_SPAN:
            return
        self.show_box(
            (x + (x_min - x) * factor, x + (x_max - x) * factor),
            (y + (y_min - y) * factor, y + (y_max - y) * factor),
        )

    def pan(self, dx: float, dy: float) -> None:
        """Move the drawing by pixels."""
        shown = self.pixel_map
        x_min, y_min, x_max, y_max = shown.box
        by_x, by_y = -dx / shown.sx, dy / shown.sy
        self.show_box((x_min + by_x, x_max + by_x), (y_min + by_y, y_max + by_y))

    # Events. A subclass fills in the methods below.

    def pressed(self, pointer: Pointer) -> None:
        """Handle a press of the left button."""

    def moved(self, pointer: Pointer) -> None:
        """Handle a move with the left button down."""

    def released(self, pointer: Pointer) -> None:
        """Handle the release of the left button."""

    def hovered_at(self, pointer: Pointer) -> None:
        """Handle a move with no button down."""

    def left(self) -> None:
        """Handle the pointer leaving the widget."""

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return False

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return False

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Handle the wish for a menu, while no gesture is in flight."""

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        """Return the record of a mouse event (or of a bare viewport position)."""
        position = event if isinstance(event, QPointF) else event.position()
        held = Qt.KeyboardModifier.NoModifier if isinstance(event, QPointF) else event.modifiers()
        pixel = self.area_pixel(position)
        return Pointer(
            position=self.pixel_map.plane(*pixel),
            pixel=pixel,
            shift=bool(held & Qt.KeyboardModifier.ShiftModifier),
            ctrl=bool(held & Qt.KeyboardModifier.ControlModifier),
            alt=bool(held & Qt.KeyboardModifier.AltModifier),
            scale=self.pixel_map.sx,
        )

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            # It takes a gesture back, a drag as well as a transform; it must not open a menu as well.
            panning = self._pan_from is not None
            self._menu_refused = panning or (self.is_dragging and self.cancel_gesture())
            if self._menu_refused:
                event.accept()
                return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        pans = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.LeftButton and self._space_down
        )
        if pans:
            self._pan_from = event.position()
            self.viewport().setCursor(Qt.CursorShape.ClosedHandCursor)
        elif event.button() == Qt.MouseButton.LeftButton:
            self.pressed(self.pointer_at(event))
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.accept()
        refused, self._menu_refused = self._menu_refused, False
        if not refused and not self.is_dragging:
            self.menu_wanted(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        # The second press of a double click is a press like any other: quick clicks must all count.
        self.mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._pan_from is not None:
            moved = event.position() - self._pan_from
            self._pan_from = event.position()
            self.pan(moved.x(), moved.y())
        elif event.buttons() & Qt.MouseButton.LeftButton:
            self.moved(self.pointer_at(event))
        elif not event.buttons():
            self.hovered_at(self.pointer_at(event))
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._pan_from is not None:
            self._pan_from = None
            self._show_pan_cursor()
        elif event.button() == Qt.MouseButton.LeftButton:
            self.released(self.pointer_at(event))
        event.accept()

    def wheelEvent(self, event: QWheelEvent) -> None:
        notches = event.angleDelta().y() / 120
        if notches:
            self.zoom(ZOOM_STEP**notches, event.position())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space_down = True
            self._show_pan_cursor()
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space_down = False
            self._show_pan_cursor()
        event.ignore()

    def _show_pan_cursor(self) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._space_down else Qt.CursorShape.ArrowCursor
        self.viewport().setCursor(shape)

    def enterEvent(self, event: QEnterEvent) -> None:
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        self.left()
        event.accept()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        # A Space released in another window is never heard of.
        self._space_down = False
        super().focusOutEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        self.painted.emit()
