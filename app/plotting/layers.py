"""Layers of a plot: painted in order, in one theme and scale; those that are still, once into a picture.

They are no items of Qt's graphics scene: where the plot area alone has changed, as under every drag, neither
Qt's graphics view nor pyqtgraph is asked to paint.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Protocol, TypeVar, runtime_checkable

from PySide6.QtCore import QPointF, QRect, QSizeF
from PySide6.QtGui import QPainter, QPixmap
from PySide6.QtWidgets import QWidget

from app.overrides import report
from app.plotting.pixel_map import PixelMap
from app.theme import LIGHT, Theme


class Themed(Protocol):
    """A drawing in the colours of a theme."""

    theme: Theme


@runtime_checkable
class Scaled(Protocol):
    """A drawing that is larger for a projector."""

    scale: float


Styled = TypeVar("Styled", bound=Themed)

Painting = Callable[[QPainter, PixelMap], None]


class Layer:
    """One layer of the drawing: a function that paints in pixels of the plot area."""

    def __init__(self, stack: LayerStack, paint: Painting, z: float, *, is_still: bool) -> None:
        self._stack, self._paint = stack, paint
        self.z, self.is_still = z, is_still
        self.is_visible = True
        self._opacity = 1.0

    def update(self) -> None:
        """Have it painted anew."""
        self._stack.update(self)

    def set_visible(self, visible: bool) -> None:
        """Show or hide it."""
        if visible != self.is_visible:
            self.is_visible = visible
            self._stack.update(self)

    def set_opacity(self, opacity: float) -> None:
        """Paint it with this opacity, from 0 to 1, from the next paint on."""
        if opacity != self._opacity:
            self._opacity = opacity
            self._stack.update(self)

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


class LayerStack:
    """The layers of one plot, from the lowest to the one nearest to the eye.

    Attributes
    ----------
    theme, scale
        Those of all that is drawn.
    """

    def __init__(self, viewport: QWidget, area: Callable[[], QRect]) -> None:
        self._viewport, self._area = viewport, area
        self._layers: list[Layer] = []
        self._styled: list[Themed] = []
        self._ground: QPixmap | None = None
        self.theme, self.scale = LIGHT, 1.0

    def __iter__(self) -> Iterator[Layer]:
        """Return the layers, the lowest first."""
        return iter(self._layers)

    def add(self, paint: Painting, *, z: float, is_still: bool = False) -> Layer:
        """Add a layer that `paint` draws; higher `z` is nearer to the eye.

        One that `is_still` lies below all others, and is painted only when it or the view has changed.
        """
        layer = Layer(self, paint, z, is_still=is_still)
        self._layers.append(layer)
        self._layers.sort(key=lambda each: (not each.is_still, each.z))
        self.update(layer)
        return layer

    def style(self, drawing: Styled) -> Styled:
        """Keep a drawing in the theme and, if it has one, in the scale of all; return it."""
        self._styled.append(drawing)
        drawing.theme = self.theme
        if isinstance(drawing, Scaled):
            drawing.scale = self.scale
        return drawing

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.theme = theme
        for drawing in self._styled:
            drawing.theme = theme

    def set_scale(self, scale: float) -> None:
        """Enlarge lines and numbers, for a projector."""
        self.scale = scale
        for drawing in self._styled:
            if isinstance(drawing, Scaled):
                drawing.scale = scale

    def update(self, layer: Layer) -> None:
        """Have the plot area painted anew, in which `layer` is another one now."""
        if layer.is_still:
            self._ground = None
        self._viewport.update(self._area())

    def reset_ground(self) -> None:
        """Have the layers that are still painted anew as well."""
        self._ground = None

    def paint(self, painter: QPainter, shown: PixelMap, origin: QPointF) -> None:
        """Paint all layers; the plot area begins at `origin`."""
        ratio = painter.device().devicePixelRatioF()
        if self._ground is None or self._ground.devicePixelRatio() != ratio:
            self._ground = self._paint_ground(ratio, shown, origin)
        painter.drawPixmap(0, 0, self._ground)
        painter.translate(origin)
        for layer in self._layers:
            if not layer.is_still:
                layer.paint(painter, shown)

    def _paint_ground(self, ratio: float, shown: PixelMap, origin: QPointF) -> QPixmap:
        """Paint the paper and the layers that are still: one picture for the frames of a drag."""
        ground = QPixmap((QSizeF(self._viewport.size()) * ratio).toSize())
        ground.setDevicePixelRatio(ratio)
        ground.fill(self.theme.paper)
        with QPainter(ground) as painter:
            painter.setClipRect(self._area())
            painter.translate(origin)
            for layer in self._layers:
                if layer.is_still:
                    layer.paint(painter, shown)
        return ground
