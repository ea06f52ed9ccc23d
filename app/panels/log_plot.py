"""A small plot with a logarithmic axis: errors over t, operations over n."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QWheelEvent
from PySide6.QtWidgets import QWidget

from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.plot.traces import Look, draw_dashed
from app.theme import LIGHT, theme_of
from app.view_model.analysis.wording import power

Floats = npt.NDArray[np.float64]

_MOST_TICKS = 5
_LEAST_DECADES = 2.0
_NOTHING = 1e-18
"""What is smaller counts as this: a logarithm has no place for 0."""

_MOST = 1e30
_MARGIN = 0.02


@dataclass(frozen=True, eq=False)
class LogLine:
    """A line of the plot: x (m,), values (m,) of at least 0, and how it looks."""

    x: Floats
    values: Floats
    look: Look
    label: str


class LogPlot(PlotWidget):
    """Draws lines over x, with a logarithmic axis upwards; with `log_x` both ways."""

    def __init__(self, name: str, label: str, *, log_x: bool = False, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setAccessibleName(label)
        self.setToolTip(label)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setMinimumHeight(120)
        self._log_x = log_x
        self._drawn_theme = LIGHT
        self._faded = False
        self._marker: float | None = None
        self._lines: list[tuple[Floats, LogLine]] = []
        self._layer = self.add_layer(self._paint, z=0)
        self._dress()

    def sizeHint(self) -> QSize:
        return QSize(300, 160)

    @property
    def lines(self) -> list[LogLine]:
        """What is drawn."""
        return [line for _, line in self._lines]

    def render_lines(
        self, lines: Sequence[LogLine], marker: float | None = None, *, faded: bool = False
    ) -> None:
        """Draw these lines, and an upright line at `marker`, in axes that hold all of them."""
        self._lines = [(self._logged(line), line) for line in lines]
        self._marker, self._faded = marker, faded
        if self._lines:
            self._fit()
        self._layer.update()

    def _logged(self, line: LogLine) -> Floats:
        x = np.log10(line.x) if self._log_x else line.x
        return np.column_stack([x, np.log10(np.clip(line.values, _NOTHING, _MOST))])

    def _fit(self) -> None:
        points = np.vstack([points for points, _ in self._lines])
        (left, low), (right, high) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        # A method that hits the points exactly must not press all else against the top.
        usual = points[points[:, 1] > math.log10(_NOTHING) + 0.5, 1]
        if len(usual):
            low = max(low, float(np.quantile(usual, 0.02)) - 0.5)
        low, high = math.floor(min(low, high - _LEAST_DECADES)), math.ceil(high)
        right = right if right > left else left + 1.0
        margin = _MARGIN * (right - left)
        self.show_box((left - margin, right + margin), (low, high))
        self.getAxis("left").setTicks([_decades(low, high)])
        if self._log_x:
            self.getAxis("bottom").setTicks([_decades(math.ceil(left), math.floor(right))])

    def _paint(self, painter: QPainter, shown: PixelMap) -> None:
        theme = self._drawn_theme
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(QColor(theme.grid_fine), 1.0))
        _, low, _, high = shown.box
        for exponent in range(math.ceil(low), math.floor(high) + 1):
            y = shown.point(0.0, exponent)[1]
            painter.drawLine(QPointF(0, y), QPointF(shown.width, y))
        for place, (points, line) in enumerate(self._lines):
            pen = line.look.pen(theme, 1.5, 0.3 if self._faded else 1.0)
            draw_dashed(painter, pen, shown.points(points), shown.width, shown.height)
            if self._log_x:
                self._paint_label(painter, shown, points, line, below=place > 0)
        if self._marker is not None:
            self._paint_marker(painter, shown, self._marker)

    def _paint_label(
        self, painter: QPainter, shown: PixelMap, points: Floats, line: LogLine, *, below: bool
    ) -> None:
        """Write a line's name above it to the left, or below it to the right, near its end."""
        x, y = shown.points(points[-len(points) // (2 if below else 5) :])[0].tolist()
        painter.setPen(line.look.pen(self._drawn_theme, 1.0).color())
        box = QRectF(x + 6, y + 2, 200, 18) if below else QRectF(x - 206, y - 24, 200, 18)
        side = Qt.AlignmentFlag.AlignLeft if below else Qt.AlignmentFlag.AlignRight
        painter.drawText(box, int(side | Qt.AlignmentFlag.AlignBottom), line.label)

    def _paint_marker(self, painter: QPainter, shown: PixelMap, marker: float) -> None:
        place = math.log10(marker) if self._log_x else marker
        x = shown.point(place, 0.0)[0]
        painter.setPen(QPen(self._drawn_theme.accent, 1.0))
        painter.drawLine(QPointF(x, 0), QPointF(x, shown.height))
        if self._log_x:
            side = Qt.AlignmentFlag.AlignLeft if x < shown.width - 80 else Qt.AlignmentFlag.AlignRight
            left = x + 4 if side == Qt.AlignmentFlag.AlignLeft else x - 84
            painter.drawText(QRectF(left, 2, 80, 18), int(side), f"n = {marker:g}")

    # It stands in a panel that scrolls, and shows all there is.

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()

    def pan(self, dx: float, dy: float) -> None:
        """Stay: everything is in sight."""

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_layer"):
            self._dress()

    def _dress(self) -> None:
        self._drawn_theme = theme_of(self.palette())
        self.set_theme(self._drawn_theme)


def _decades(low: int, high: int) -> list[tuple[float, str]]:
    """Return some powers of ten between two exponents, with their names."""
    step = max(1, math.ceil((high - low) / _MOST_TICKS))
    return [(float(each), power(each)) for each in range(low + (-low % step), high + 1, step)]
