"""The grid behind the drawing, the unit at the axes, and the guides over the drawing."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from curvecore.arrays import FloatArray

from ..document.model import Axis, Guide, Vector
from ..document.plane_edits import place_words
from ..plotting.drawing import Bars
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import Halo, size_of, write_on_plate
from ..plotting.ticks import Stretch, nice_step
from ..tools.pointer import Hit, Part

_LEAST_GAP = 8.0
"""Pixels between two lines of a grid of fixed spacing, at least."""

_LEAST_COARSE_GAP = 80.0
"""Pixels between two coarse lines of a grid that adapts, at least; steps of 1, 2, 5 keep them below 200."""


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
        self._shown: PixelMap | None = None
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
        """Return the distance of the fine lines, along x as along y: what snapping to the grid goes by."""
        return self._fixed or adaptive_steps(pixel_map.sx)[1]

    def _tune_axes(self) -> None:
        """Keep the lines apart on the screen, both ways alike: the plane has the same unit along x and y."""
        sx = self._plot.pixel_map.sx
        steps = grid_steps(self._fixed, sx) if self._fixed else adaptive_steps(sx)
        if steps == self.steps:
            return
        self.steps, self._shown = steps, None
        coarse, fine = steps
        for side in ("bottom", "left"):
            # Numbers of an adaptive grid stand at the coarse lines alone, as dense along x as along y.
            self._plot.getAxis(side).set_distances(fine, fine if self._fixed else coarse)

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the lines; they are computed anew when another part of the plane is visible."""
        if pixel_map is not self._shown:
            self._compute(pixel_map)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(Qt.PenStyle.NoPen)
        for lines, colour in ((self._fine, self.theme.grid_fine), (self._coarse, self.theme.grid_coarse)):
            painter.setBrush(colour)
            lines.draw(painter)

    def _compute(self, pixel_map: PixelMap) -> None:
        self._shown = pixel_map
        x_min, y_min, x_max, y_max = pixel_map.box
        seen = Stretch(x_min, x_max, pixel_map.width), Stretch(y_min, y_max, pixel_map.height)
        for lines, step in ((self._coarse, self.steps[0]), (self._fine, self.steps[1])):
            x, y = (np.array(along.multiples(step), dtype=float) for along in seen)
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

    What has to be added to the numbers of that axis stands before it: they have too little room for it.
    """

    z = -5.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._plot = plot
        self._unit = ""

    def render(self, unit: str) -> None:
        """Write this name from the next paint on; empty for none."""
        self._unit = unit
        self.update()

    def words(self, pixel_map: PixelMap) -> str:
        """Return what stands there."""
        offset = self._plot.getAxis("left").ticks_in(pixel_map).offset
        return " ".join(filter(None, (offset, self._unit)))

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Write it."""
        painter.setFont(self.fonts.less(1.5, 1.0))
        if text := self.words(pixel_map):
            # In the colours of the axes, which it belongs to.
            plate = QRectF(QPointF(3, 4), size_of(painter, text, 8.0, 2.0))
            write_on_plate(painter, plate, text, self.theme.surface, self.theme.muted)


_REACH = 5.0
"""Pixels from the pointer within which a guide is grabbed."""

_DASHES = (8.0, 4.0)

_GAP = 4.0


class GuidesLayer(Layer):
    """Layer of the guides, above all curves and below points and gestures.

    Attributes
    ----------
    guides
        What is drawn.
    lit
        The guide under the pointer, or that is dragged; None for none.
    """

    z = 5.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.guides: tuple[Guide, ...] = ()
        self.lit: int | None = None
        self._unit = ""
        self._halo = Halo()
        self.set_shown(False)

    def render(self, guides: tuple[Guide, ...], unit: str) -> None:
        """Draw these guides from the next paint on; `unit` is that of their places."""
        if (guides, unit) != (self.guides, self._unit):
            self.guides, self._unit = guides, unit
            self.set_shown(bool(guides))
            self.update()

    @property
    def corners(self) -> FloatArray | None:
        """The lower left and the upper right corner of what lies between the guides, (2, 2), or None."""
        at = [{each.position for each in self.guides if each.axis is axis} for axis in Axis]
        is_box = all(len(each) > 1 for each in at)
        return np.array([list(map(min, at)), list(map(max, at))]) if is_box else None

    def light(self, place: int | None) -> None:
        """Draw one of the guides lit, with its place in words."""
        if place != self.lit:
            self.lit = place
            self.update()

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the guide at a pixel of the plot area, the nearest of several."""
        if not self.is_visible or not self.guides:
            return None
        away = [abs(_pixel_of(guide, pixel_map) - pixel[guide.axis.coordinate]) for guide in self.guides]
        # Of those at one place the last one wins: it is drawn on top.
        nearest = len(away) - 1 - int(np.argmin(away[::-1]))
        if away[nearest] > _REACH:
            return None
        return Hit(Part.GUIDE, nearest, self.guides[nearest].beside(pixel_map.plane(*pixel)))

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw those in sight."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for place, guide in enumerate(self.guides):
            at, room = _pixel_of(guide, pixel_map), (pixel_map.width, pixel_map.height)[guide.axis.coordinate]
            if 0 <= at <= room:
                self._paint_guide(painter, pixel_map, guide, round(at), is_lit=place == self.lit)

    def _paint_guide(
        self, painter: QPainter, pixel_map: PixelMap, guide: Guide, at: int, *, is_lit: bool
    ) -> None:
        pen = QPen(self.theme.accent, 1.0)
        if not is_lit:
            pen.setDashPattern(_DASHES)
        painter.setPen(pen)
        if guide.axis is Axis.X:
            painter.drawLine(QPointF(at, 0), QPointF(at, pixel_map.height))
        else:
            painter.drawLine(QPointF(0, at), QPointF(pixel_map.width, at))
        if is_lit:
            self._write(painter, pixel_map, guide, at)

    def _write(self, painter: QPainter, pixel_map: PixelMap, guide: Guide, at: int) -> None:
        """Write where the guide lies, near its upper or left end."""
        text = place_words(guide, self._unit)
        painter.setFont(self.fonts.times(0.95 * self.scale))
        size = size_of(painter, text)
        if guide.axis is Axis.X:
            left = at + _GAP if at + _GAP + size.width() <= pixel_map.width else at - _GAP - size.width()
            left = max(min(left, pixel_map.width - size.width()), 0.0)
            box = QRectF(QPointF(left, _GAP), size)
        else:
            top = at - _GAP - size.height()
            top = max(min(top if top >= 0 else at + _GAP, pixel_map.height - size.height()), 0.0)
            box = QRectF(QPointF(_GAP, top), size)
        self._halo.write(painter, box, text, self.theme.paper, self.theme.accent_text, 2 * self.scale)


def _pixel_of(guide: Guide, pixel_map: PixelMap) -> float:
    """Return where a guide lies in the plot area: from the left, or from the top."""
    place = (guide.position, 0.0) if guide.axis is Axis.X else (0.0, guide.position)
    return pixel_map.point(*place)[guide.axis.coordinate]
