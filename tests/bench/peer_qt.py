"""The floor: the same drag in two bare Qt widgets that do nothing but paint what is dragged.

A curve of 500 samples with its points, and beside it the basis functions, each 500 samples, over a background
that was painted once. No axes, no selection, no document and no undo: what an editor takes more is its own.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import shiboken6
from harness import Paints, Times, drag
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import (
    QColor,
    QMouseEvent,
    QPainter,
    QPainterPath,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QHBoxLayout, QWidget

_SAMPLES = 500
_LEFT, _MARGIN = 44, 8


def _polygon(size: int) -> tuple[QPolygonF, np.ndarray]:
    """Return a polygon and its corners as an array that shares its memory."""
    polygon = QPolygonF()
    polygon.resize(size)
    memory = shiboken6.VoidPtr(polygon.data(), size * 16, True)
    return polygon, np.frombuffer(memory, np.float64).reshape(size, 2)


class _Plot(QWidget):
    """A widget whose background is a pixmap and whose drawing is a list of polygons."""

    lowest, highest = -0.2, 1.2

    def __init__(self, painted: Callable[[], None]) -> None:
        super().__init__()
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.painted = painted
        self.background = QPixmap()
        self.pen = QPen(QColor(120, 200, 255), 1)

    def x(self, t: np.ndarray) -> np.ndarray:
        return _LEFT + (self.width() - _LEFT - _MARGIN) * t

    def y(self, value: np.ndarray) -> np.ndarray:
        scale = (self.height() - 32) / (self.highest - self.lowest)
        return _MARGIN + (self.highest - value) * scale

    def resizeEvent(self, event: QResizeEvent) -> None:
        self.background = QPixmap(self.size())
        self.background.fill(QColor(0, 0, 0))
        with QPainter(self.background) as painter:
            painter.setPen(QColor(150, 150, 150))
            painter.drawLine(_LEFT, 0, _LEFT, self.height())
            painter.drawLine(0, self.height() - 24, self.width(), self.height() - 24)
        self.lay_out()

    def lay_out(self) -> None:
        raise NotImplementedError

    def paintEvent(self, event: QPaintEvent) -> None:
        with QPainter(self) as painter:
            painter.drawPixmap(event.rect(), self.background, event.rect())
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(self.pen)
            self.draw(painter)
        self.painted()

    def draw(self, painter: QPainter) -> None:
        raise NotImplementedError


class _Curve(_Plot):
    """The curve with its points; the one in the middle follows the mouse."""

    def __init__(
        self, n: int, painted: Callable[[], None], moved: Callable[[], None], *, styled: bool = False
    ) -> None:
        super().__init__(painted)
        self.styled = styled
        self.moved, self.middle, self.is_held = moved, n // 2, False
        self.t = np.linspace(0, 1, _SAMPLES)
        self.places = np.linspace(0, 1, n)
        self.values = 0.5 + 0.35 * np.sin(7 * self.places)
        # Any function with the support of a cardinal one does: the peer is about painting.
        self.weight = np.clip(1 - np.abs(self.t - self.places[self.middle]) * n / 2, 0, None)
        self.samples = np.interp(self.t, self.places, self.values)
        self.line, self.line_array = _polygon(_SAMPLES)
        self.discs, self.disc_array = _polygon(n)
        self.disc_pen = QPen(QColor("red"), 8)
        self.disc_pen.setCapStyle(Qt.PenCapStyle.RoundCap)

    def lay_out(self) -> None:
        self.line_array[:, 0], self.disc_array[:, 0] = self.x(self.t), self.x(self.places)
        self.set_values()

    def set_values(self) -> None:
        self.line_array[:, 1], self.disc_array[:, 1] = self.y(self.samples), self.y(self.values)
        self.update()

    def place(self) -> QPointF:
        return QPointF(*(round(value) for value in self.disc_array[self.middle]))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.is_held = True

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.is_held = False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.is_held:
            scale = (self.height() - 32) / (self.highest - self.lowest)
            value = self.highest - (event.position().y() - _MARGIN) / scale
            self.samples += (value - self.values[self.middle]) * self.weight
            self.values[self.middle] = value
            self.set_values()
            self.moved()

    def draw(self, painter: QPainter) -> None:
        if self.styled:
            area = QPainterPath()
            area.addPolygon(self.line)
            painter.fillPath(area, QColor(0, 114, 178))
            pen = QPen(QColor(213, 94, 0), 3)
            pen.setCapStyle(Qt.PenCapStyle.RoundCap)
            pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
            painter.setPen(pen)
        painter.drawPolyline(self.line)
        painter.setPen(self.disc_pen)
        painter.drawPoints(self.discs)


class _Functions(_Plot):
    """Waves in place of basis functions; `change` gives every one other values."""

    lowest, highest = -0.5, 1.2

    def __init__(self, n: int, painted: Callable[[], None]) -> None:
        super().__init__(painted)
        self.t = np.linspace(0, 1, _SAMPLES)
        steps = np.arange(n)[:, None]
        self.values = 0.35 + 0.6 * np.sin(2 * np.pi * (1 + 3 * steps / n) * self.t + steps)
        self.lines = [_polygon(_SAMPLES) for _ in range(n)]
        self.step = 0

    def lay_out(self) -> None:
        for _, array in self.lines:
            array[:, 0] = self.x(self.t)
        self.set_values(self.values)

    def change(self) -> None:
        self.step += 1
        self.set_values(self.values * (1 + 0.05 * np.sin(0.7 * self.step)))

    def set_values(self, values: np.ndarray) -> None:
        for (_, array), row in zip(self.lines, values, strict=True):
            array[:, 1] = self.y(row)
        self.update()

    def draw(self, painter: QPainter) -> None:
        for line, _ in self.lines:
            painter.drawPolyline(line)


def drag_in_bare_qt(
    qtbot, n: int, *, functions_change: bool, pace: float = 0.0, styled: bool = False
) -> Times:
    """Drag the point in the middle; with `functions_change` all n functions are painted at each move, too.

    A `styled` curve is filled, and its line is 3 pixels wide.
    """
    paints = Paints()
    window = QWidget()
    qtbot.addWidget(window)
    functions = _Functions(n, paints.counter("functions"))
    curve = _Curve(
        n, paints.counter("curve"), functions.change if functions_change else lambda: None, styled=styled
    )
    row = QHBoxLayout(window)
    row.addWidget(curve)
    row.addWidget(functions)
    window.resize(1200, 600)
    with qtbot.waitExposed(window):
        window.show()
    qtbot.wait(100)
    awaited = ["curve", "functions"] if functions_change else ["curve"]
    times = drag(curve, curve.place(), paints, awaited, moves=30 if n > 100 else 150, pace=pace)
    window.hide()
    return times
