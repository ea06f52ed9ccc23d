"""Layers of a plot: painted in order, in one theme and scale; still layers are painted once into a picture.

They are no items of Qt's graphics scene: neither Qt's graphics view nor pyqtgraph is asked to paint.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Protocol, cast

from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF
from PySide6.QtGui import QPainter, QPixmap, QRegion
from PySide6.QtWidgets import QWidget

from ..appearance.theme import LIGHT, Theme
from ..qt.overrides import report
from .pixel_map import PixelMap
from .text import Sizes

Painting = Callable[[QPainter, PixelMap], None]


class HasLayers(Protocol):
    """A plot that layers are added to."""

    layers: LayerStack


class Layer:
    """One layer of a plot, in its theme and scale; it paints smoothly, in pixels of the plot area.

    A subclass overrides `paint`, or a function is given. After a change of its values it calls `update`; the
    next paint of the plot then draws all layers from the lowest `z` to the highest.

    A layer that draws a line through points (n, 2) of the plane:

        class PathLayer(Layer):
            z = 2.0

            def render(self, points: FloatArray) -> None:
                self._points = points
                self.update()

            def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
                painter.setPen(QPen(self.theme.accent, 2.0 * self.scale))
                draw_line(painter, pixel_map.points(self._points), SOLID, pixel_map)

    Attributes
    ----------
    z
        Layers with a higher z are painted over those with a lower one.
    is_still
        Whether the layer lies below all others and is painted only when it or the view has changed.
    """

    z = 0.0
    is_still = False

    def __init__(self, plot: HasLayers, paint: Painting | None = None, *, z: float | None = None) -> None:
        self._stack = plot.layers
        self._paint = paint
        if z is not None:
            self.z = z
        self.is_visible = self.is_enabled = True
        self._opacity = 1.0
        self._stack.add(self)

    @property
    def theme(self) -> Theme:
        """The theme of the plot."""
        return self._stack.theme

    @property
    def scale(self) -> float:
        """The size of lines and numbers; 1 as usual."""
        return self._stack.scale

    @property
    def fonts(self) -> Sizes:
        """The font of the plot in its sizes."""
        return self._stack.fonts

    def update(self) -> None:
        """Request a paint."""
        self._stack.update(self)

    def set_visible(self, visible: bool) -> None:
        """Show or hide the layer, by its own decision."""
        if visible != self.is_visible:
            self.is_visible = visible
            self._stack.update(self)

    def set_enabled(self, enabled: bool) -> None:
        """Let the layer show if it is visible, or hide it, by the decision of its owner."""
        if enabled != self.is_enabled:
            self.is_enabled = enabled
            self._stack.update(self)

    def set_opacity(self, opacity: float) -> None:
        """Paint with this opacity, from 0 to 1, from the next paint on."""
        if opacity != self._opacity:
            self._opacity = opacity
            self._stack.update(self)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint the layer."""
        if self._paint is not None:
            self._paint(painter, pixel_map)

    def draw(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint the layer, and restore the painter."""
        painter.save()
        try:
            if self._opacity < 1.0:
                painter.setOpacity(self._opacity)
            self.paint(painter, pixel_map)
        except Exception as problem:
            # A failure must not keep the layers above from being painted.
            report(problem)
        finally:
            painter.restore()


class LayerStack:
    """The layers of one plot, from the lowest to the highest.

    Attributes
    ----------
    theme, scale, fonts
        Theme, size of lines and fonts of all layers.
    is_due
        Whether a paint of all layers has been requested.

    Parameters
    ----------
    area
        Returns the part of the viewport on which layers paint.
    spread
        Returns the part that is repainted with them: the area and the marks on rulers beside it.
    beside
        Paints the axes beside the area, which are still.
    """

    def __init__(
        self, viewport: QWidget, area: Callable[[], QRect], spread: Callable[[], QRect], beside: Painting
    ) -> None:
        self._viewport, self._area, self._spread, self._paint_beside = viewport, area, spread, beside
        # Requested once a frame, though several layers change at every move.
        self.is_due = False
        self._layers: list[Layer] = []
        self._ground: QPixmap | None = None
        self.theme, self.scale, self.fonts = LIGHT, 1.0, Sizes(viewport.font())

    def add(self, layer: Layer) -> None:
        """Add a layer; of layers with the same z the later one is on top."""
        self._layers.append(layer)
        self._layers.sort(key=lambda other: (not other.is_still, other.z))
        self.update(layer)

    def update(self, layer: Layer) -> None:
        """Request a paint of the plot area because `layer` has changed."""
        if layer.is_still:
            self._ground = None
        if not self.is_due:
            self.is_due = True
            self._viewport.update(self._spread())

    def reset_ground(self) -> None:
        """Repaint the still layers with the next paint."""
        self._ground = None

    def paint_ground(self, painter: QPainter, pixel_map: PixelMap, origin: QPointF, region: QRegion) -> None:
        """Paint the still layers and the axes; the plot area begins at `origin`.

        Only in `region` of the viewport: clipped to several rectangles, Qt takes long for the whole picture.
        """
        ratio = painter.device().devicePixelRatioF()
        if self._ground is None or self._ground.devicePixelRatio() != ratio:
            self._ground = self._make_ground(ratio, pixel_map, origin)
        if region.rectCount() == 1:
            # Qt clips to it already.
            painter.drawPixmap(0, 0, self._ground)
            return
        for part in rectangles_of(region):
            painter.setClipRect(part)
            painter.drawPixmap(0, 0, self._ground)
        painter.setClipping(False)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint the layers that are not still, in pixels of the plot area."""
        self.is_due = False
        self._paint_layers(painter, pixel_map, still=False)

    def paint_still(self, painter: QPainter, pixel_map: PixelMap, origin: QPointF) -> None:
        """Paint the axes and the layers that are still; the plot area begins at `origin`."""
        painter.save()
        self._paint_beside(painter, pixel_map)
        painter.restore()
        painter.setClipRect(QRectF(self._area()).translated(-origin))
        self._paint_layers(painter, pixel_map, still=True)

    def _paint_layers(self, painter: QPainter, pixel_map: PixelMap, *, still: bool) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for layer in self._layers:
            if layer.is_visible and layer.is_enabled and layer.is_still is still:
                layer.draw(painter, pixel_map)

    def _make_ground(self, ratio: float, pixel_map: PixelMap, origin: QPointF) -> QPixmap:
        """Return the paper, the axes and the still layers: one picture for all frames of a drag."""
        ground = QPixmap((QSizeF(self._viewport.size()) * ratio).toSize())
        ground.setDevicePixelRatio(ratio)
        ground.fill(self.theme.paper)
        with QPainter(ground) as painter:
            painter.translate(origin)
            self.paint_still(painter, pixel_map, origin)
        return ground


def rectangles_of(region: QRegion) -> Iterator[QRect]:
    """Yield the rectangles that make up a region."""
    # PySide6's stubs do not know that a region is iterable.
    yield from cast("Iterable[QRect]", region)
