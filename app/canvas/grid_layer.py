"""The grid behind the drawing: at the ticks of the axes, so that lines and labels agree."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtGui import QPainter, QPen

from app.plot.drawing import Segments
from app.plot.pixel_map import Floats, PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme

_LEAST_GAP = 8.0
"""Pixels between two lines of the grid, at least."""


class GridLayer:
    """Fine and coarse lines that adapt to the zoom."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self._plot = plot
        self.theme = theme
        self.visible = True
        self._shown: PixelMap | None = None
        self._fine, self._coarse = Segments(), Segments()
        plot.add_layer(self.paint, z=-10)
        self._spacing, self._steps = 0.0, (0.0, 0.0)
        plot.map_changed.connect(self._space_ticks)

    @property
    def spacing(self) -> float:
        """Distance of the fine lines; 0 where it adapts to the zoom."""
        return self._spacing

    @spacing.setter
    def spacing(self, spacing: float) -> None:
        self._spacing = spacing
        self._space_ticks()

    def _space_ticks(self) -> None:
        """Give the axes the ticks of a grid of fixed spacing, coarser where its lines would be too dense."""
        steps = grid_steps(self._spacing, self._plot.pixel_map.sx) if self._spacing else (0.0, 0.0)
        if steps == self._steps:
            return
        self._steps, self._shown = steps, None
        for name in ("left", "bottom"):
            axis = self._plot.getAxis(name)
            if self._spacing:
                axis.tickStrings = tick_labels
                axis.setTickSpacing(*steps)
            else:
                # The class's own method again.
                axis.__dict__.pop("tickStrings", None)
                axis.setTickSpacing()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the lines; they are computed anew when another part of the plane is visible."""
        if not self.visible:
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
