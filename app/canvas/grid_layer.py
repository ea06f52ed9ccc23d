"""The grid behind the drawing: at the ticks of the axes, so that lines and labels agree."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.segments import Bars
from ..plotting.ticks import Stretch, nice_step

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

    def spacing(self, shown: PixelMap) -> float:
        """Return the distance of the fine lines, along x as along y: what snapping to the grid goes by."""
        return self._fixed or adaptive_steps(shown.sx)[1]

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

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the lines; they are computed anew when another part of the plane is visible."""
        if shown is not self._shown:
            self._compute(shown)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(Qt.PenStyle.NoPen)
        for lines, colour in ((self._fine, self.theme.grid_fine), (self._coarse, self.theme.grid_coarse)):
            painter.setBrush(colour)
            lines.draw(painter)

    def _compute(self, shown: PixelMap) -> None:
        self._shown = shown
        x_min, y_min, x_max, y_max = shown.box
        seen = Stretch(x_min, x_max, shown.width), Stretch(y_min, y_max, shown.height)
        for lines, step in ((self._coarse, self.steps[0]), (self._fine, self.steps[1])):
            x, y = (np.array(along.multiples(step), dtype=float) for along in seen)
            lines.fill(_lines(shown.x(x), shown.y(y), shown))


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


def _lines(x: FloatArray, y: FloatArray, shown: PixelMap) -> FloatArray:
    """Return vertical lines at `x` and horizontal lines at `y`, on whole pixels so that they stay crisp."""
    x, y = np.round(x), np.round(y)
    vertical = np.column_stack([x, np.zeros_like(x), np.ones_like(x), np.full_like(x, shown.height)])
    horizontal = np.column_stack([np.zeros_like(y), y, np.full_like(y, shown.width), np.ones_like(y)])
    return np.vstack([vertical, horizontal])
