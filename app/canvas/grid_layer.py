"""The grid behind the drawing: at the ticks of the axes, so that lines and labels agree."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from PySide6.QtGui import QPainter, QPen

from app.plot.drawing import Segments
from app.plot.layered_plot import LayeredPlot
from app.plot.pixel_map import Floats, PixelMap
from app.theme import Theme

_LEAST_GAP = 8.0
"""Pixels between two lines of a grid of fixed spacing, at least."""


class GridLayer:
    """Fine and coarse lines that adapt to the zoom."""

    def __init__(self, plot: LayeredPlot, theme: Theme) -> None:
        self._plot = plot
        self.theme = theme
        self._visible = True
        self._shown: PixelMap | None = None
        self._fine, self._coarse = Segments(), Segments()
        self._fixed = 0.0
        self._layer = plot.add_layer(self.paint, z=-10)
        plot.map_changed.connect(self._tune_axes)

    def set_visible(self, visible: bool) -> None:
        """Show or hide the lines."""
        self._visible = visible
        self._layer.update()

    def set_spacing(self, spacing: float) -> None:
        """Fix the distance of the lines, in units of the plane; 0 adapts it to the zoom."""
        self._fixed, self._shown = spacing, None
        for axis in self._axes():
            # The class's own method again.
            axis.__dict__.pop("tickStrings", None)
            axis.setTickSpacing()
        self._tune_axes()
        self._layer.update()

    def _axes(self) -> tuple[Any, Any]:
        return (self._plot.getAxis("bottom"), self._plot.getAxis("left"))

    def spacing(self, shown: PixelMap) -> tuple[float, float]:
        """Return the distance of the fine lines along x and y: what snapping to the grid goes by."""
        if self._fixed:
            return (self._fixed, self._fixed)
        x_min, y_min, x_max, y_max = shown.box
        along_x, along_y = self._axes()
        return (
            _finest(along_x.tickSpacing(x_min, x_max, shown.width)),
            _finest(along_y.tickSpacing(y_min, y_max, shown.height)),
        )

    def _tune_axes(self) -> None:
        """Keep lines of a fixed distance apart on the screen: of a dense grid not every line is drawn."""
        if not self._fixed:
            return
        coarse, fine = grid_steps(self._fixed, self._plot.pixel_map.sx)
        self._shown = None
        for axis in self._axes():
            axis.tickStrings = tick_labels
            axis.setTickSpacing(major=coarse, minor=fine)

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the lines; they are computed anew when another part of the plane is visible."""
        if not self._visible:
            return
        if shown is not self._shown:
            self._compute(shown)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        for lines, colour in ((self._fine, self.theme.grid_fine), (self._coarse, self.theme.grid_coarse)):
            painter.setPen(QPen(colour, 1))
            lines.draw(painter)

    def _compute(self, shown: PixelMap) -> None:
        self._shown = shown
        x_min, y_min, x_max, y_max = shown.box
        x_levels = self._plot.getAxis("bottom").tickValues(x_min, x_max, shown.width)
        y_levels = self._plot.getAxis("left").tickValues(y_min, y_max, shown.height)
        for lines, level in ((self._coarse, 0), (self._fine, 1)):
            across = [shown.x(_values(x_levels, level)), shown.y(_values(y_levels, level))]
            lines.fill(_lines(across[0], across[1], shown))


def _finest(levels: list[tuple[float, float]]) -> float:
    """Return the spacing of the fine lines without the rounding of the power of ten in it."""
    return float(f"{levels[min(1, len(levels) - 1)][0]:.12g}")


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

    pyqtgraph writes as many decimals as the spacing has places: 0.75 as 0.8 where ticks are 0.25 apart.
    """
    # A multiple of the spacing that should be zero may be off by a rounding.
    exact = [round(value / spacing) * spacing * scale for value in values]
    return [f"{value:.7g}".replace("-", "−") for value in exact]


def _values(levels: list[tuple[float, list[float]]], level: int) -> Floats:
    return np.array(levels[level][1] if level < len(levels) else [], dtype=float)


def _lines(x: Floats, y: Floats, shown: PixelMap) -> Floats:
    """Return vertical lines at `x` and horizontal lines at `y`, on whole pixels so that they stay crisp."""
    x, y = np.round(x), np.round(y)
    vertical = np.column_stack([x, np.zeros_like(x), x, np.full_like(x, shown.height)])
    horizontal = np.column_stack([np.zeros_like(y), y, np.full_like(y, shown.width), y])
    return np.vstack([vertical, horizontal])
