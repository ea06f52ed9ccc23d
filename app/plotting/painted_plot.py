"""A plot that we paint ourselves: pyqtgraph supplies the view box, the axes and the ranges."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QPoint, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QGraphicsView, QSizePolicy, QWidget

from ..appearance.theme import Theme, theme_of
from ..qt.overrides import SafeOverrides, guard_library
from .axes import Axes, Axis
from .camera import Camera, ViewBox
from .graphs import ChildGroup, pg
from .layers import LayerStack
from .pixel_map import PixelMap
from .rulers import Rulers

_FOCUS_WIDTH = 2

# Whatever a plot is made of: Qt calls their overrides as it calls ours.
guard_library(pg.GraphicsView, pg.GraphicsScene, pg.ViewBox, ChildGroup)


class PaintedPlot(SafeOverrides, pg.GraphicsView):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot of layers, beside its axes.

    Attributes
    ----------
    camera
        Which part of the plane is seen.
    layers
        What is painted.
    rulers
        Marks on the axes, while these are rulers.

    Signals
    -------
    painted
        The viewport has been painted.
    style_changed
        Layers have another theme or scale.
    """

    painted = Signal()
    style_changed = Signal()

    camera_class: type[Camera] = Camera

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._box = ViewBox()
        self._axes = Axes(self._box, self._repaint_all)
        self.camera = self.camera_class(self, self._box)
        self.rulers = Rulers(self.viewport(), self._axes, self.camera, lambda: self.layers.is_due)
        self.layers = LayerStack(
            self.viewport(), lambda: self.camera.area, lambda: self.rulers.spread, self._axes.paint
        )
        self._shows_focus = False
        self._set_up_view()
        self._axes.set_scale(self.font(), 1.0)
        self.camera.changed.connect(self._repaint_all)

    def _set_up_view(self) -> None:
        self.setCentralItem(self._axes.frame)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.enableMouse(False)
        # The paper is in the picture of what is still; Qt need not keep another one of it.
        self.setCacheMode(QGraphicsView.CacheModeFlag.CacheNone)
        # Every pixel is painted here: Qt need not paint paper below.
        self.viewport().setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        # A dropped file is the window's business.
        self.setAcceptDrops(False)
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def getViewBox(self) -> Any:  # noqa: ANN401, N802 - as in pyqtgraph's PlotWidget
        """Return the view box."""
        return self._box

    def getAxis(self, side: str) -> Axis:  # noqa: N802 - as in pyqtgraph's PlotWidget
        """Return the axis along y, "left", or the one along x, "bottom"."""
        return self._axes[side]

    @property
    def pixel_map(self) -> PixelMap:
        """The present map from the plane to the pixels of the plot area."""
        return self.camera.pixel_map

    def to_pixel(self, x: float, y: float) -> QPoint:
        """Return the viewport pixel nearest to a point of the plane."""
        return self.camera.to_pixel(x, y)

    def to_plane(self, pixel: QPoint | QPointF) -> tuple[float, float]:
        """Return the point of the plane at a viewport pixel."""
        return self.camera.to_plane(pixel)

    def show_rulers(self, shown: bool) -> None:
        """Show the axes as rulers, the one along x above the drawing, or as plain axes."""
        if shown != self._axes.are_rulers:
            self._axes.set_rulers(shown)
            self.camera.follow_area()
            self.camera.changed.emit()

    # Painting

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._axes.set_theme(theme)
        self.layers.theme = theme
        self.setBackground(theme.paper)
        self._repaint_all()
        self.style_changed.emit()

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        self.layers.scale = scale
        self._axes.set_scale(self.font(), scale)
        self._repaint_all()
        self.style_changed.emit()

    def _repaint_all(self) -> None:
        self.layers.reset_ground()
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if hasattr(self, "layers"):
            # pyqtgraph resizes while it is being built.
            self.camera.reset_origin()
            self.layers.reset_ground()

    def paintEvent(self, event: QPaintEvent) -> None:
        # Nothing is an item of Qt's graphics scene: neither Qt's view nor pyqtgraph is asked to paint.
        origin, area, shown = self.camera.origin, self.camera.area, self.camera.pixel_map
        region = event.region()
        with QPainter(self.viewport()) as painter:
            self.layers.paint_ground(painter, shown, origin, region)
            painter.translate(origin)
            self.rulers.paint(painter, shown, self.layers.theme)
            if region.intersects(area):
                painter.setClipRect(QRectF(area).translated(-origin))
                self.layers.paint(painter, shown)
        if self._shows_focus:
            self._paint_focus()
        self.painted.emit()

    def _paint_focus(self) -> None:
        painter = QPainter(self.viewport())
        painter.setPen(QPen(theme_of(self.palette()).accent, _FOCUS_WIDTH))
        inset = _FOCUS_WIDTH / 2
        painter.drawRect(QRectF(self.viewport().rect()).adjusted(inset, inset, -inset, -inset))
        painter.end()

    def _show_focus(self, shown: bool) -> None:
        """Frame the plot while it has the keyboard's focus, or not."""
        if shown != self._shows_focus:
            self._shows_focus = shown
            self.viewport().update()
