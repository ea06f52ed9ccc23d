"""Page on costs: solving a system against the basis form, in numbers and over the number of points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QWheelEvent
from PySide6.QtWidgets import QWidget

from curvecore.arrays import FloatArray

from ...appearance.theme import FollowsTheme, Theme
from ...document.words import number, power, short
from ...plotting.camera import FixedCamera
from ...plotting.layers import Layer
from ...plotting.pens import colour_of, draw_line
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...qt.labels import Label
from ...view_model.analysis.laboratory import SolvingCost, cost_chart
from ...view_model.analysis.settings import Calculation
from ...view_model.line_styles import LineStyle
from ...widgets.boxes import column_of, grid_of
from ...widgets.controls import named

_SMALL = 30
_ROWS = {"first": "Operations, first point", "further": "Each further point", "time": "Time, measured"}


class CostPanel(QWidget):
    """Operations and times of both methods for the number of points n, and a chart over n."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("costPanel")
        self._words = Label(name="costWords", wordWrap=True)
        self._numbers = grid_of(12, stretched=[0])
        self._cells: dict[str, Label] = {}
        self._lay_out_numbers()
        self._note = Label(name="costNote", wordWrap=True)
        self.chart = LogPlot(
            "costChart", "Operations for the first point of the curve over the number of points n"
        )
        title = "Operations for the first point, over n"
        parts = (self._words, self._numbers, title, (self.chart, 1), self._note)
        column_of(*parts, margins=12, spacing=10, parent=self)

    def _lay_out_numbers(self) -> None:
        for column, text in enumerate(("", "Solving, n³", "Basis form, n²")):
            self._numbers.addWidget(Label(text), 0, column)
        for line, (key, text) in enumerate(_ROWS.items(), start=1):
            self._numbers.addWidget(Label(text), line, 0)
            for column, method in enumerate(("solving", "basis"), start=1):
                cell = self._cells[f"{key}_{method}"] = Label("–", name=f"cost_{key}_{method}")
                self._numbers.addWidget(cell, line, column)

    def render_cost(self, cost: SolvingCost | None, *, busy: bool) -> None:
        """Show the counts and times; muted while they are measured anew."""
        for cell in self._cells.values():
            cell.setEnabled(not busy)
        if cost is None:
            self._words.setText("Measuring…" if busy else "There is no curve to measure.")
            return
        texts = {
            "first_solving": short(cost.solving),
            "first_basis": short(cost.basis),
            "further_solving": short(cost.further[0]),
            "further_basis": short(cost.further[1]),
            "time_solving": _duration(cost.seconds[0]),
            "time_basis": _duration(cost.seconds[1]),
        }
        for key, text in texts.items():
            self._cells[key].setText(text)
        self._words.setText(_words(cost))
        self._note.setText(_note(cost))
        chart = cost_chart()
        self.chart.render_lines(
            [
                LogLine(chart.n, chart.solving, Calculation.MONOMIAL.style, "solving, n³"),
                LogLine(chart.n, chart.basis, Calculation.LAGRANGE.style, "basis form, n²"),
            ],
            marker=float(min(cost.count, chart.n[-1])),
        )


def _words(cost: SolvingCost) -> str:
    times = cost.seconds[0] / cost.seconds[1]
    return (
        f"With {cost.count} points, solving for the monomial coefficients takes {cost.ratio:.1f} times "
        f"the operations of the basis form and, measured here, {times:.1f} times its time."
    )


def _note(cost: SolvingCost) -> str:
    text = (
        f"Twice as many points: {cost.doubled[0]:.1f} times the operations to solve, "
        f"{cost.doubled[1]:.1f} times for the basis form; 8 and 4 times for large n. "
        f"With the barycentric formula, each further point takes {short(cost.further[2])}."
    )
    if cost.count < _SMALL:
        text += " With so few points, calling NumPy takes most of the time."
    if cost.piecewise is not None:
        text += (
            f" These numbers are for one polynomial through the points. The Hermite curve itself needs only "
            f"{cost.count - 1} small systems, {short(cost.piecewise)} operations: its cost grows like n."
        )
    if cost.other:
        text += f" These numbers are for one polynomial through the points, not for {cost.other}."
    return text


def _duration(seconds: float) -> str:
    for factor, unit in ((1e6, "µs"), (1e3, "ms")):
        if seconds * factor < 999.5:
            return f"{number(seconds * factor, 3)} {unit}"
    return f"{number(seconds, 3)} s"


_MOST_TICKS = 5
_LEAST_DECADES = 2.0
_MARGIN = 0.02


@dataclass(frozen=True, eq=False)
class LogLine:
    """Line of a plot: x (m,), values (m,), both positive, its style and its label."""

    x: FloatArray
    values: FloatArray
    style: LineStyle
    label: str


class LogPlot(FollowsTheme, PlotWidget):
    """Small plot with two logarithmic axes."""

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
        """Draw these lines and a vertical line at `marker`; the axes fit all lines."""
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
        for index, (points, line) in enumerate(self._lines):
            painter.setPen(QPen(colour_of(line.style, theme), 1.5))
            draw_line(painter, pixel_map.points(points), line.style.dashes, pixel_map)
            self._paint_label(painter, pixel_map, points, line, below=index > 0)
        if self._marker is not None:
            self._paint_marker(painter, pixel_map, self._marker)

    def _paint_label(
        self, painter: QPainter, pixel_map: PixelMap, points: FloatArray, line: LogLine, *, below: bool
    ) -> None:
        """Write the label of a line above it to the left, or below it to the right, near its end."""
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

    # The wheel scrolls the panel around it.
    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()

    def set_theme(self, theme: Theme) -> None:
        PlotWidget.set_theme(self, theme)


def _decades(low: int, high: int) -> list[tuple[float, str]]:
    """Return some powers of ten between two exponents, with their labels."""
    step = max(1, math.ceil((high - low) / _MOST_TICKS))
    return [(float(exponent), power(exponent)) for exponent in range(low + (-low % step), high + 1, step)]
