"""The grid behind the drawing, the unit at the axes, and the guides over the drawing."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from ..document.model import Axis, Guide, Vector
from ..document.plane_edits import guide_label
from ..plotting.drawing import Bars
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import Halo, size_of, write_on_plate
from ..plotting.ticks import Stretch, nice_step
from ..tools.pointer import Hit, Part

_LEAST_GAP = 8.0
"""Smallest distance in pixels between two lines of a grid of fixed spacing."""

_LEAST_COARSE_GAP = 80.0
"""Smallest distance in pixels of coarse lines of an adaptive grid; steps of 1, 2, 5 keep it below 200."""


class GridLayer(Layer):
    """Layer of fine and coarse lines that adapt to the zoom.

    Attributes
    ----------
    steps
        The distances of coarse and fine lines.
    """

    z = -10.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        self._plot = plot
        super().__init__(plot)
        self._pixel_map: PixelMap | None = None
        self._fine, self._coarse = Bars(), Bars()
        self._fixed, self.steps = 0.0, (0.0, 0.0)
        plot.camera.changed.connect(self._tune_axes)
        self.set_spacing(0.0)

    def set_spacing(self, spacing: float) -> None:
        """Fix the distance of the lines, in units of the plane; 0 adapts it to the zoom."""
        self._fixed, self.steps = spacing, (0.0, 0.0)
        self._tune_axes()
        self.update()

    def spacing(self, pixel_map: PixelMap) -> float:
        """Return the distance of the fine lines, along x and y alike, to which points snap."""
        return self._fixed or adaptive_steps(pixel_map.sx)[1]

    def _tune_axes(self) -> None:
        """Keep the lines apart on the screen, along x as along y: the plane has the same unit along both."""
        sx = self._plot.pixel_map.sx
        steps = grid_steps(self._fixed, sx) if self._fixed else adaptive_steps(sx)
        if steps == self.steps:
            return
        self.steps, self._pixel_map = steps, None
        coarse, fine = steps
        for side in ("bottom", "left"):
            # An adaptive grid has numbers at coarse lines only, as dense along x as along y.
            self._plot.getAxis(side).set_distances(fine, fine if self._fixed else coarse)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the lines, computed anew only when another part of the plane is visible."""
        if pixel_map is not self._pixel_map:
            self._compute(pixel_map)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(Qt.PenStyle.NoPen)
        for lines, colour in ((self._fine, self.theme.grid_fine), (self._coarse, self.theme.grid_coarse)):
            painter.setBrush(colour)
            lines.draw(painter)

    def _compute(self, pixel_map: PixelMap) -> None:
        self._pixel_map = pixel_map
        x_min, y_min, x_max, y_max = pixel_map.box
        visible = Stretch(x_min, x_max, pixel_map.width), Stretch(y_min, y_max, pixel_map.height)
        for lines, step in ((self._coarse, self.steps[0]), (self._fine, self.steps[1])):
            x, y = (np.array(along.multiples(step), dtype=float) for along in visible)
            lines.fill(_lines(pixel_map.x(x), pixel_map.y(y), pixel_map))


def adaptive_steps(pixels_per_unit: float) -> tuple[float, float]:
    """Return the distances of coarse and fine lines that suit the zoom: steps of 1, 2, 5, 10, ….

    Coarse lines are 80 to 200 pixels apart, fine ones a fifth of that, or a half where the fifth would be an
    odd number (0.4): never less than 16 pixels.
    """
    needed = _LEAST_COARSE_GAP / pixels_per_unit
    coarse = nice_step(needed)
    power = math.floor(math.log10(coarse) + 1e-9)
    fine = {1: 0.2, 2: 1.0, 5: 1.0}[round(coarse / 10.0**power)]
    return coarse, float(f"{fine}e{power}")


def grid_steps(spacing: float, pixels_per_unit: float) -> tuple[float, float]:
    """Return the distances of coarse and fine lines for a grid of fixed spacing.

    The fine lines are `spacing` apart, or 2, 5, 10, 20, … times that where they would be denser than
    `_LEAST_GAP` pixels.
    """
    needed = max(_LEAST_GAP / (spacing * pixels_per_unit), 1.0)
    decade = 10.0 ** math.floor(math.log10(needed))
    factor = next(step * decade for step in (1, 2, 5, 10) if step * decade >= needed * (1 - 1e-12))
    # After 2 comes 10, so that lines of both kinds fall together.
    return (5 if round(factor / decade) == 2 else 10) * factor * spacing, factor * spacing


def _lines(x: FloatArray, y: FloatArray, pixel_map: PixelMap) -> FloatArray:
    """Return vertical lines at `x` and horizontal lines at `y`, on whole pixels so that they stay crisp."""
    x, y = np.round(x), np.round(y)
    vertical = np.column_stack([x, np.zeros_like(x), np.ones_like(x), np.full_like(x, pixel_map.height)])
    horizontal = np.column_stack([np.zeros_like(y), y, np.full_like(y, pixel_map.width), np.ones_like(y)])
    return np.vstack([vertical, horizontal])


class UnitLayer(Layer):
    """Layer of the unit's name, at the upper end of the y axis.

    Before it stands the offset to be added to the numbers of that axis, which have too little room for it.
    """

    z = -5.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._plot = plot
        self._unit = ""

    def render(self, unit: str) -> None:
        """Write this name from the next paint on; "" for no unit."""
        self._unit = unit
        self.update()

    def text(self, pixel_map: PixelMap) -> str:
        """Return the offset and the unit."""
        offset = self._plot.getAxis("left").ticks_in(pixel_map).offset
        return " ".join(filter(None, (offset, self._unit)))

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Write offset and unit on a plate."""
        painter.setFont(self.fonts.less(1.5, 1.0))
        if line := self.text(pixel_map):
            # In the colours of the axes, to which it belongs.
            plate = QRectF(QPointF(3, 4), size_of(painter, line, 8.0, 2.0))
            write_on_plate(painter, plate, line, self.theme.surface, self.theme.muted)


_REACH = 5.0
"""Pixels from the pointer within which a guide is grabbed."""

_DASHES = (8.0, 4.0)

_GAP = 4.0


class GuidesLayer(Layer):
    """Layer of the guides, above all curves and below points and gestures.

    Attributes
    ----------
    guides
        The guides that are drawn.
    highlighted
        Index of the guide under the pointer, or that is dragged; None for none.
    """

    z = 5.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.guides: tuple[Guide, ...] = ()
        self.highlighted: int | None = None
        self._unit = ""
        self._halo = Halo()
        self.set_enabled(False)

    def render(self, guides: tuple[Guide, ...], unit: str) -> None:
        """Draw these guides from the next paint on; `unit` is the unit of their positions."""
        if (guides, unit) != (self.guides, self._unit):
            self.guides, self._unit = guides, unit
            self.set_enabled(bool(guides))
            self.update()

    @property
    def corners(self) -> FloatArray | None:
        """The lower left and the upper right corner of the area between the guides, (2, 2), or None."""
        positions = [{guide.position for guide in self.guides if guide.axis is axis} for axis in Axis]
        is_box = all(len(on_axis) > 1 for on_axis in positions)
        return np.array([list(map(min, positions)), list(map(max, positions))]) if is_box else None

    def highlight(self, index: int | None) -> None:
        """Draw one of the guides highlighted, with its position in words."""
        if index != self.highlighted:
            self.highlighted = index
            self.update()

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the guide at a pixel of the plot area, the nearest of several."""
        if not self.is_visible or not self.guides:
            return None
        distances = [abs(_pixel_of(guide, pixel_map) - pixel[guide.axis.coordinate]) for guide in self.guides]
        # The last of coincident guides wins: it is drawn on top.
        nearest = len(distances) - 1 - int(np.argmin(distances[::-1]))
        if distances[nearest] > _REACH:
            return None
        return Hit(Part.GUIDE, nearest, self.guides[nearest].nearest_position(pixel_map.plane(*pixel)))

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the visible guides."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for index, guide in enumerate(self.guides):
            pixel = _pixel_of(guide, pixel_map)
            size = (pixel_map.width, pixel_map.height)[guide.axis.coordinate]
            if 0 <= pixel <= size:
                self._paint_guide(painter, pixel_map, guide, round(pixel), is_solid=index == self.highlighted)

    def _paint_guide(
        self, painter: QPainter, pixel_map: PixelMap, guide: Guide, pixel: int, *, is_solid: bool
    ) -> None:
        pen = QPen(self.theme.accent, 1.0)
        if not is_solid:
            pen.setDashPattern(_DASHES)
        painter.setPen(pen)
        if guide.axis is Axis.X:
            painter.drawLine(QPointF(pixel, 0), QPointF(pixel, pixel_map.height))
        else:
            painter.drawLine(QPointF(0, pixel), QPointF(pixel_map.width, pixel))
        if is_solid:
            self._write(painter, pixel_map, guide, pixel)

    def _write(self, painter: QPainter, pixel_map: PixelMap, guide: Guide, pixel: int) -> None:
        """Write the position of the guide near its upper or left end."""
        text = guide_label(guide, self._unit)
        painter.setFont(self.fonts.times(0.95 * self.scale))
        size = size_of(painter, text)
        if guide.axis is Axis.X:
            has_room = pixel + _GAP + size.width() <= pixel_map.width
            left = pixel + _GAP if has_room else pixel - _GAP - size.width()
            left = max(min(left, pixel_map.width - size.width()), 0.0)
            box = QRectF(QPointF(left, _GAP), size)
        else:
            top = pixel - _GAP - size.height()
            top = max(min(top if top >= 0 else pixel + _GAP, pixel_map.height - size.height()), 0.0)
            box = QRectF(QPointF(_GAP, top), size)
        self._halo.write(painter, box, text, self.theme.paper, self.theme.accent, 2 * self.scale)


def _pixel_of(guide: Guide, pixel_map: PixelMap) -> float:
    """Return the pixel of a guide in the plot area: from the left, or from the top."""
    position = (guide.position, 0.0) if guide.axis is Axis.X else (0.0, guide.position)
    return pixel_map.point(*position)[guide.axis.coordinate]
