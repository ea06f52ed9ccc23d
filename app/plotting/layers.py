"""Layers of a plot: painted in order, in one theme and scale; those that are still, once into a picture.

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

    A subclass has a `paint` of its own, or a function is given.

    Attributes
    ----------
    z
        Higher is nearer to the eye.
    is_still
        Whether it lies below all others, and is painted only when it or the view has changed.
    """

    z = 0.0
    is_still = False

    def __init__(self, plot: HasLayers, paint: Painting | None = None, *, z: float | None = None) -> None:
        self._stack = plot.layers
        self._paint = paint
        if z is not None:
            self.z = z
        self.is_visible = self.is_shown = True
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
        """Have it painted anew."""
        self._stack.update(self)

    def set_visible(self, visible: bool) -> None:
        """Show or hide it."""
        if visible != self.is_visible:
            self.is_visible = visible
            self._stack.update(self)

    def set_shown(self, shown: bool) -> None:
        """Show it, as far as it is visible of its own accord, or withhold it."""
        if shown != self.is_shown:
            self.is_shown = shown
            self._stack.update(self)

    def set_opacity(self, opacity: float) -> None:
        """Paint it with this opacity, from 0 to 1, from the next paint on."""
        if opacity != self._opacity:
            self._opacity = opacity
            self._stack.update(self)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint what the layer shows."""
        if self._paint is not None:
            self._paint(painter, pixel_map)

    def draw(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Paint; the painter is as before when it is done: opaque and smooth."""
        painter.save()
        try:
            if self._opacity < 1.0:
                painter.setOpacity(self._opacity)
            self.paint(painter, pixel_map)
        except Exception as problem:
            # The layers above are painted all the same.
            report(problem)
        finally:
            painter.restore()


class LayerStack:
    """The layers of one plot, from the lowest to the one nearest to the eye.

    Attributes
    ----------
    theme, scale, fonts
        Those of all that is drawn.
    is_due
        Whether Qt has been told to paint them all anew.

    Parameters
    ----------
    area
        Tells which part of the viewport they paint on.
    spread
        Tells which part is painted anew with them: that, and what is marked beside it.
    beside
        Paints what lies beside that, and is still.
    """

    def __init__(
        self, viewport: QWidget, area: Callable[[], QRect], spread: Callable[[], QRect], beside: Painting
    ) -> None:
        self._viewport, self._area, self._spread, self._paint_beside = viewport, area, spread, beside
        # Told once: several layers change at every move.
        self.is_due = False
        self._layers: list[Layer] = []
        self._ground: QPixmap | None = None
        self.theme, self.scale, self.fonts = LIGHT, 1.0, Sizes(viewport.font())

    def add(self, layer: Layer) -> None:
        """Add a layer; of those of one height the later one is nearer to the eye."""
        self._layers.append(layer)
        self._layers.sort(key=lambda each: (not each.is_still, each.z))
        self.update(layer)

    def update(self, layer: Layer) -> None:
        """Have the plot area painted anew, in which `layer` is another one now."""
        if layer.is_still:
            self._ground = None
        if not self.is_due:
            self.is_due = True
            self._viewport.update(self._spread())

    def reset_ground(self) -> None:
        """Have the layers that are still painted anew as well."""
        self._ground = None

    def paint_ground(self, painter: QPainter, pixel_map: PixelMap, origin: QPointF, region: QRegion) -> None:
        """Paint what is still, and what lies beside the plot area, which begins at `origin`.

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
            if layer.is_visible and layer.is_shown and layer.is_still is still:
                layer.draw(painter, pixel_map)

    def _make_ground(self, ratio: float, pixel_map: PixelMap, origin: QPointF) -> QPixmap:
        """Return the paper, the axes and the layers that are still: one picture for the frames of a drag."""
        ground = QPixmap((QSizeF(self._viewport.size()) * ratio).toSize())
        ground.setDevicePixelRatio(ratio)
        ground.fill(self.theme.paper)
        with QPainter(ground) as painter:
            painter.translate(origin)
            self.paint_still(painter, pixel_map, origin)
        return ground


def rectangles_of(region: QRegion) -> Iterator[QRect]:
    """Yield the rectangles that make up a region."""
    # PySide6's stubs do not know that it can be gone through.
    yield from cast("Iterable[QRect]", region)
