"""A small plot with two logarithmic axes: operations over n."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QWheelEvent

from curvecore.arrays import FloatArray

from ...appearance.theme import FollowsTheme, Theme
from ...plotting.camera import FixedCamera
from ...plotting.layers import Layer
from ...plotting.pens import colour_of, draw_line
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...view_model.analysis.wording import power
from ...view_model.line_styles import LineStyle
from ...widgets.controls import named

_MOST_TICKS = 5
_LEAST_DECADES = 2.0
_MARGIN = 0.02


@dataclass(frozen=True, eq=False)
class LogLine:
    """A line of the plot: x (m,), values (m,), both positive, and how it looks."""

    x: FloatArray
    values: FloatArray
    style: LineStyle
    label: str


class LogPlot(FollowsTheme, PlotWidget):
    """Draws lines over x."""

    camera_class = FixedCamera

    def __init__(self, name: str, label: str) -> None:
        super().__init__()
        named(self, name, label, label)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setMinimumHeight(120)
        self._marker: float | None = None
        self._lines: list[tuple[FloatArray, LogLine]] = []
        self._layer = Layer(self, self._paint)
        self.follow_theme()

    def sizeHint(self) -> QSize:
        return QSize(300, 160)

    @property
    def lines(self) -> list[LogLine]:
        """Lines that are drawn."""
        return [line for _, line in self._lines]

    def render_lines(self, lines: Sequence[LogLine], marker: float) -> None:
        """Draw these lines, and an upright line at `marker`, in axes that hold all of them."""
        self._lines = [(np.log10(np.column_stack([line.x, line.values])), line) for line in lines]
        self._marker = marker
        if self._lines:
            self._fit()
        self._layer.update()

    def _fit(self) -> None:
        points = np.vstack([points for points, _ in self._lines])
        (left, low), (right, high) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        low, high = math.floor(min(low, high - _LEAST_DECADES)), math.ceil(high)
        right = right if right > left else left + 1.0
        margin = _MARGIN * (right - left)
        self.camera.show_box((left - margin, right + margin), (low, high))
        self.getAxis("left").set_ticks(_decades(low, high))
        self.getAxis("bottom").set_ticks(_decades(math.ceil(left), math.floor(right)))

    def _paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        theme = self.layers.theme
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(QColor(theme.grid_fine), 1.0))
        _, low, _, high = pixel_map.box
        for exponent in range(math.ceil(low), math.floor(high) + 1):
            y = pixel_map.point(0.0, exponent)[1]
            painter.drawLine(QPointF(0, y), QPointF(pixel_map.width, y))
        for place, (points, line) in enumerate(self._lines):
            painter.setPen(QPen(colour_of(line.style, theme), 1.5))
            draw_line(painter, pixel_map.points(points), line.style.dashes, pixel_map)
            self._paint_label(painter, pixel_map, points, line, below=place > 0)
        if self._marker is not None:
            self._paint_marker(painter, pixel_map, self._marker)

    def _paint_label(
        self, painter: QPainter, pixel_map: PixelMap, points: FloatArray, line: LogLine, *, below: bool
    ) -> None:
        """Write a line's name above it to the left, or below it to the right, near its end."""
        x, y = pixel_map.points(points[-len(points) // (2 if below else 5) :])[0].tolist()
        painter.setPen(colour_of(line.style, self.layers.theme))
        box = QRectF(x + 6, y + 2, 200, 18) if below else QRectF(x - 206, y - 24, 200, 18)
        side = Qt.AlignmentFlag.AlignLeft if below else Qt.AlignmentFlag.AlignRight
        painter.drawText(box, int(side | Qt.AlignmentFlag.AlignBottom), line.label)

    def _paint_marker(self, painter: QPainter, pixel_map: PixelMap, marker: float) -> None:
        x = pixel_map.point(math.log10(marker), 0.0)[0]
        painter.setPen(QPen(self.layers.theme.accent, 1.0))
        painter.drawLine(QPointF(x, 0), QPointF(x, pixel_map.height))
        side = Qt.AlignmentFlag.AlignLeft if x < pixel_map.width - 80 else Qt.AlignmentFlag.AlignRight
        left = x + 4 if side == Qt.AlignmentFlag.AlignLeft else x - 84
        painter.drawText(QRectF(left, 2, 80, 18), int(side), f"n = {marker:g}")

    # It stands in a panel that scrolls.
    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()

    def set_theme(self, theme: Theme) -> None:
        PlotWidget.set_theme(self, theme)


def _decades(low: int, high: int) -> list[tuple[float, str]]:
    """Return some powers of ten between two exponents, with their names."""
    step = max(1, math.ceil((high - low) / _MOST_TICKS))
    return [(float(each), power(each)) for each in range(low + (-low % step), high + 1, step)]
