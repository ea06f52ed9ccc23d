"""The grid behind the drawing: at the ticks of the axes, so that lines and labels agree."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from ..document.words import number
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.segments import Bars

_LEAST_GAP = 8.0
"""Pixels between two lines of a grid of fixed spacing, at least."""

_LEAST_COARSE_GAP = 80.0
"""Pixels between two coarse lines of a grid that adapts, at least; steps of 1, 2, 5 keep them below 200."""

_MOST_DIGITS = 15


class GridLayer(Layer):
    """Layer of fine and coarse lines that adapt to the zoom."""

    z = -10.0
    is_still = True

    def __init__(self, plot: PlotWidget) -> None:
        self._plot = plot
        super().__init__(plot)
        self._shown: PixelMap | None = None
        self._fine, self._coarse = Bars(), Bars()
        self._fixed = 0.0
        self._steps = (0.0, 0.0)
        plot.camera.changed.connect(self._tune_axes)
        self.set_spacing(0.0)

    def set_spacing(self, spacing: float) -> None:
        """Fix the distance of the lines, in units of the plane; 0 adapts it to the zoom."""
        self._fixed, self._shown = spacing, None
        # Labels of an adaptive grid stand at the coarse lines alone, as dense along x as along y.
        text_level = 2 if spacing else 0
        for axis in self._axes():
            axis.setStyle(maxTextLevel=text_level)
        self._tune_axes()
        self.update()

    def _axes(self) -> tuple[Any, Any]:
        return (self._plot.getAxis("bottom"), self._plot.getAxis("left"))

    def spacing(self, shown: PixelMap) -> float:
        """Return the distance of the fine lines, along x as along y: what snapping to the grid goes by."""
        return self._fixed or adaptive_steps(shown.sx)[1]

    def _tune_axes(self) -> None:
        """Keep the lines apart on the screen, both ways alike: the plane has the same unit along x and y."""
        sx = self._plot.pixel_map.sx
        steps = grid_steps(self._fixed, sx) if self._fixed else adaptive_steps(sx)
        if steps == self._steps:
            return
        self._steps, self._shown = steps, None
        for axis in self._axes():
            axis.tickStrings = tick_labels
            axis.setTickSpacing(major=steps[0], minor=steps[1])

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
        x_levels = self._plot.getAxis("bottom").tickValues(x_min, x_max, shown.width)
        y_levels = self._plot.getAxis("left").tickValues(y_min, y_max, shown.height)
        for lines, level in ((self._coarse, 0), (self._fine, 1)):
            across = [shown.x(_values(x_levels, level)), shown.y(_values(y_levels, level))]
            lines.fill(_lines(across[0], across[1], shown))


def adaptive_steps(pixels_per_unit: float) -> tuple[float, float]:
    """Return the distances of coarse and fine lines that suit the zoom: steps of 1, 2, 5, 10, ….

    Coarse lines are 80 to 200 pixels apart, fine ones a fifth of that, or a half where the fifth would be an
    odd number (0.4): never less than 16 pixels.
    """
    needed = _LEAST_COARSE_GAP / pixels_per_unit
    power = math.floor(math.log10(needed))
    digit = next(digit for digit in (1, 2, 5, 10) if digit * 10.0**power >= needed * (1 - 1e-12))
    fine = {1: 0.2, 2: 1.0, 5: 1.0, 10: 2.0}[digit]
    # As the decimal number that is meant: 0.2, not 2 · 0.1 in binary.
    return float(f"{digit}e{power}"), float(f"{fine}e{power}")


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


def tick_labels(values: Sequence[float], scale: float, spacing: float) -> list[str]:
    """Return the numbers at ticks `spacing` apart.

    pyqtgraph writes as many decimals as the spacing has places: 0.75 as 0.8 where ticks are 0.25 apart; and
    six digits at most, so that neighbours far from the origin are told alike.
    """
    # A multiple of the spacing that should be zero may be off by a rounding.
    exact = [round(value / spacing) * spacing * scale for value in values]
    largest = max((abs(value / spacing) for value in values), default=1.0)
    digits = min(max(7, math.ceil(math.log10(max(largest, 1.0))) + 1), _MOST_DIGITS)
    return [number(value, digits) for value in exact]


def _values(levels: list[tuple[float, list[float]]], level: int) -> FloatArray:
    return np.array(levels[level][1] if level < len(levels) else [], dtype=float)


def _lines(x: FloatArray, y: FloatArray, shown: PixelMap) -> FloatArray:
    """Return vertical lines at `x` and horizontal lines at `y`, on whole pixels so that they stay crisp."""
    x, y = np.round(x), np.round(y)
    vertical = np.column_stack([x, np.zeros_like(x), np.ones_like(x), np.full_like(x, shown.height)])
    horizontal = np.column_stack([np.zeros_like(y), y, np.full_like(y, shown.width), np.ones_like(y)])
    return np.vstack([vertical, horizontal])
