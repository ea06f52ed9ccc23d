"""A pyqtgraph plot that we paint ourselves: layers, the pixel map, and which part of the plane is seen.

pyqtgraph supplies the view box, the axes and the ranges. All drawing is done by layers that paint in pixels
of the plot area. They are no items of its scene: where the area alone has changed, as under every drag,
neither Qt's graphics view nor pyqtgraph is asked to paint.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeVar, runtime_checkable

import pyqtgraph as pg
from pyqtgraph.graphicsItems.ViewBox.ViewBox import ChildGroup
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QGraphicsGridLayout, QGraphicsView, QGraphicsWidget, QSizePolicy, QWidget

from app.overrides import Guarded, guard_library, report
from app.plotting.pixel_map import PixelMap
from app.theme import LIGHT, Theme, theme_of

_AXIS_WIDTH = 46
_FOCUS_WIDTH = 2

_INSET = 2
"""Pixels by which layers stay inside the plot area: what is nearer to its edge belongs to the axes."""

_LEAST_SPAN = 1e-9

GREATEST_SPAN = 1e13
"""Longest range of an axis: pyqtgraph shrinks a longer one about its middle, wherever that lies."""


# Whatever a plot is made of: Qt calls their overrides as it calls ours.
guard_library(pg.GraphicsView, pg.GraphicsScene, pg.ViewBox, ChildGroup, pg.AxisItem)


class Themed(Protocol):
    """What is drawn in the colours of a theme."""

    theme: Theme


@runtime_checkable
class Scaled(Protocol):
    """What is drawn larger for a projector."""

    scale: float


Dressed = TypeVar("Dressed", bound=Themed)

Painting = Callable[[QPainter, PixelMap], None]


class Layer:
    """One layer of the drawing: a function that paints in pixels of the plot area."""

    def __init__(self, plot: LayeredPlot, paint: Painting, z: float, *, is_still: bool) -> None:
        self._plot, self._paint = plot, paint
        self.z, self.is_still = z, is_still
        self.is_visible = True
        self._opacity = 1.0

    def update(self) -> None:
        """Have it painted anew."""
        self._plot.update_area(self)

    def set_visible(self, visible: bool) -> None:
        """Show or hide it."""
        if visible != self.is_visible:
            self.is_visible = visible
            self._plot.update_area(self)

    def set_opacity(self, opacity: float) -> None:
        """Paint it with this opacity, from 0 to 1, from the next paint on."""
        if opacity != self._opacity:
            self._opacity = opacity
            self._plot.update_area(self)

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Paint; the painter is as before when it is done."""
        if not self.is_visible:
            return
        painter.save()
        try:
            painter.setOpacity(self._opacity)
            self._paint(painter, shown)
        except Exception as problem:
            # The layers above are painted all the same.
            report(problem)
        finally:
            painter.restore()


class _Axis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """An axis with a true minus, and without a label: pyqtgraph would lay it out for every pen and range."""

    def labelString(self) -> str:  # noqa: N802
        return ""

    def tickStrings(self, values: Sequence[float], scale: float, spacing: float) -> list[str]:  # noqa: N802
        return [text.replace("-", "−") for text in super().tickStrings(values, scale, spacing)]


class LayeredPlot(Guarded, pg.GraphicsView):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot with layers, exact pixel mapping, and ranges that zoom and pan.

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
        super().__init__(parent)
        self._box = pg.ViewBox(enableMenu=False)
        self._axes = {side: _Axis(side) for side in ("left", "bottom")}
        self._layers: list[Layer] = []
        self._dressed: list[Themed] = []
        self._theme = LIGHT
        self._scale = 1.0
        self._map: PixelMap | None = None
        self._origin: QPointF | None = None
        self._area = QRect()
        self._ground: QPixmap | None = None
        self._shows_focus = False
        self._set_up_plot()
        # The paper is in the picture of what is still; Qt need not keep another one of it.
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        # Every pixel is painted here: Qt need not paint paper below.
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        # A dropped file is the window's business.
        self.setAcceptDrops(False)

    def _set_up_plot(self) -> None:
        self._lay_out()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.enableMouse(False)
        box = self._box
        box.setMouseEnabled(x=False, y=False)
        box.disableAutoRange()
        box.setLimits(
            minXRange=_LEAST_SPAN, maxXRange=GREATEST_SPAN, minYRange=_LEAST_SPAN, maxYRange=GREATEST_SPAN
        )
        box.sigRangeChanged.connect(self._forget_map)
        box.sigResized.connect(self._forget_map)
        for axis in self._axes.values():
            # There is no unit to put a prefix to, but pyqtgraph would lay its label out at every new range.
            axis.enableAutoSIPrefix(False)
            axis.setStyle(tickLength=5, tickTextOffset=4, hideOverlappingLabels=True)
        # The left axes of all plots have one width: they stay aligned, and nothing jumps when numbers grow.
        LayeredPlot.set_scale(self, 1.0)

    def _lay_out(self) -> None:
        """Put the axes beside the view box.

        pyqtgraph's PlotItem does that too, and half of the time it takes to build goes into menus, a title
        and two more axes that are never shown.
        """
        whole = QGraphicsWidget()
        grid = QGraphicsGridLayout(whole)
        grid.setContentsMargins(1, 1, 1, 1)
        grid.setSpacing(0)
        grid.addItem(self._axes["left"], 0, 0)
        grid.addItem(self._box, 0, 1)
        grid.addItem(self._axes["bottom"], 1, 1)
        grid.setRowStretchFactor(0, 1)
        grid.setColumnStretchFactor(1, 1)
        for axis in self._axes.values():
            axis.linkToView(self._box)
            # Above what the view box paints.
            axis.setZValue(0.5)
        self.setCentralItem(whole)

    def getViewBox(self) -> Any:  # noqa: ANN401, N802 - as in pyqtgraph's PlotWidget
        """Return the view box."""
        return self._box

    def getAxis(self, side: str) -> Any:  # noqa: ANN401, N802 - as in pyqtgraph's PlotWidget
        """Return the axis "left" or "bottom"."""
        return self._axes[side]

    def add_layer(self, paint: Painting, *, z: float, is_still: bool = False) -> Layer:
        """Add a layer that `paint` draws; higher `z` is nearer to the eye.

        One that `is_still` lies below all others, and is painted only when it or the view has changed.
        """
        layer = Layer(self, paint, z, is_still=is_still)
        self._layers.append(layer)
        self._layers.sort(key=lambda each: (not each.is_still, each.z))
        self.update_area(layer)
        return layer

    def update_area(self, layer: Layer) -> None:
        """Have the plot area painted anew, in which `layer` is another one now."""
        if layer.is_still:
            self._ground = None
        self.viewport().update(self._area)

    def dress(self, drawing: Dressed) -> Dressed:
        """Keep what is drawn here in the plot's theme and, if it has one, in its scale; return it."""
        self._dressed.append(drawing)
        drawing.theme = self._theme
        if isinstance(drawing, Scaled):
            drawing.scale = self._scale
        return drawing

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme
        for drawing in self._dressed:
            drawing.theme = theme
        self.setBackground(theme.paper)
        for axis in self._axes.values():
            axis.setPen(QColor(theme.grid_coarse))
            axis.setTextPen(QColor(theme.muted))
        self._repaint_all()

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        self._scale = scale
        for drawing in self._dressed:
            if isinstance(drawing, Scaled):
                drawing.scale = scale
        font = QFont(self.font())
        font.setPointSizeF(max(self.font().pointSizeF() - 1.5, 7.0) * scale)
        for axis in self._axes.values():
            axis.setTickFont(font)
        self._axes["left"].setWidth(_AXIS_WIDTH * scale)
        self._repaint_all()

    def _repaint_all(self) -> None:
        self._ground = None
        self.viewport().update()

    # Plane and pixels

    @property
    def pixel_map(self) -> PixelMap:
        """The present map from the plane to the pixels of the plot area."""
        if self._map is None:
            box = self._box
            (x_range, y_range), rect = box.viewRange(), box.rect()
            self._map = PixelMap.of_ranges(tuple(x_range), tuple(y_range), rect.width(), rect.height())
        return self._map

    def _area_origin(self) -> QPointF:
        """Return where in the viewport the plot area begins: as long as it is as large, at the same place."""
        if self._origin is None:
            box = self._box
            self._origin = QPointF(self.viewportTransform().map(box.mapToScene(QPointF(0, 0))))
            rect = box.rect().translated(self._origin)
            self._area = rect.adjusted(_INSET, _INSET, -_INSET, -_INSET).toAlignedRect()
        return self._origin

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

    @property
    def pixel_size(self) -> float:
        """The size of a pixel in the plane, along x."""
        return 1.0 / self.pixel_map.sx

    def centre(self) -> QPointF:
        """Return the middle of the plot area in viewport pixels, where the zoom actions zoom."""
        shown = self.pixel_map
        return self._area_origin() + QPointF(shown.width / 2, shown.height / 2)

    def _forget_map(self) -> None:
        self._map = self._origin = None
        self._repaint_all()
        self.map_changed.emit()

    def show_box(self, x_range: tuple[float, float], y_range: tuple[float, float]) -> None:
        """Show this part of the plane."""
        self._box.setRange(xRange=x_range, yRange=y_range, padding=0)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom in by `factor` (out where it is below one), keeping what lies under the pixel there."""
        x, y = self.to_plane(pixel)
        self._scale_about(1 / factor, x, y)

    def _scale_about(self, factor: float, x: float, y: float) -> None:
        x_min, y_min, x_max, y_max = self.pixel_map.box
        if not _LEAST_SPAN < (x_max - x_min) * factor < GREATEST_SPAN:
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

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._origin = self._ground = None

    def paintEvent(self, event: QPaintEvent) -> None:
        origin = self._area_origin()
        if not self._area.contains(event.rect()):
            super().paintEvent(event)
        with QPainter(self.viewport()) as painter:
            painter.setClipRect(self._area)
            self._paint_layers(painter, origin)
        if self._shows_focus:
            self._paint_focus()
        self.painted.emit()

    def _paint_layers(self, painter: QPainter, origin: QPointF) -> None:
        shown = self.pixel_map
        if self._ground is None or self._ground.devicePixelRatio() != painter.device().devicePixelRatioF():
            self._ground = self._paint_ground(painter.device().devicePixelRatioF(), origin)
        painter.drawPixmap(0, 0, self._ground)
        painter.translate(origin)
        for layer in self._layers:
            if not layer.is_still:
                layer.paint(painter, shown)

    def _paint_ground(self, ratio: float, origin: QPointF) -> QPixmap:
        """Paint the paper and the layers that are still: one picture for the frames of a drag."""
        ground = QPixmap((QSizeF(self.viewport().size()) * ratio).toSize())
        ground.setDevicePixelRatio(ratio)
        ground.fill(self._theme.paper)
        with QPainter(ground) as painter:
            painter.setClipRect(self._area)
            painter.translate(origin)
            for layer in self._layers:
                if layer.is_still:
                    layer.paint(painter, self.pixel_map)
        return ground

    def show_focus(self, shown: bool) -> None:
        """Frame the plot while it has the keyboard's focus, or not."""
        if shown != self._shows_focus:
            self._shows_focus = shown
            self.viewport().update()

    def _paint_focus(self) -> None:
        painter = QPainter(self.viewport())
        painter.setPen(QPen(theme_of(self.palette()).accent, _FOCUS_WIDTH))
        inset = _FOCUS_WIDTH / 2
        painter.drawRect(QRectF(self.viewport().rect()).adjusted(inset, inset, -inset, -inset))
        painter.end()
