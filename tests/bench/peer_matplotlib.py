"""The peer: what one would write with matplotlib and SciPy, an example of matplotlib's made to do the same.

Curve and all basis functions at 500 samples, two plots, the point in the middle dragged.
"""

from __future__ import annotations

import matplotlib
import numpy as np
from harness import Paints, Times, drag
from PySide6.QtCore import QPointF
from scipy.interpolate import BarycentricInterpolator

matplotlib.use("QtAgg")

from matplotlib.backends.backend_qtagg import FigureCanvasQTAgg
from matplotlib.figure import Figure

_SAMPLES = 500


class _Canvas(FigureCanvasQTAgg):
    """Reports real frames, not the stale ones painted before a redraw."""

    def __init__(self, figure, painted):
        super().__init__(figure)
        self._painted = painted

    def paintEvent(self, event):
        super().paintEvent(event)
        if not self._draw_pending:
            self._painted()


class _Demo:
    def __init__(self, n: int, mode: str, painted):
        self.figure = Figure(figsize=(12, 6), dpi=100)
        self.canvas = _Canvas(self.figure, painted)
        self.left, self.right = self.figure.subplots(1, 2)
        self.x = (1 - np.cos(np.pi * np.arange(n) / (n - 1))) / 2
        self.y = 0.5 + 0.35 * np.sin(7 * self.x)
        self.middle, self.dragged, self.blits, self.background = n // 2, False, mode == "blit", None
        t, curve, basis = self.compute()
        self.line = self.left.plot(t, curve, animated=self.blits)[0]
        self.points = self.left.plot(self.x, self.y, "o", animated=self.blits)[0]
        self.functions = [self.right.plot(t, row, lw=1, animated=self.blits)[0] for row in basis]
        self.left.set_ylim(-0.2, 1.2)
        self.right.set_ylim(-0.5, 1.2)
        for name, handler in (
            ("button_press_event", self.press),
            ("motion_notify_event", self.move),
            ("button_release_event", self.release),
            ("draw_event", self.drawn),
        ):
            self.canvas.mpl_connect(name, handler)

    def compute(self):
        t = np.linspace(self.x[0], self.x[-1], _SAMPLES)
        both = BarycentricInterpolator(self.x, np.column_stack([self.y, np.eye(len(self.x))]))(t)
        return t, both[:, 0], both[:, 1:].T

    def press(self, event):
        self.dragged = event.inaxes is self.left

    def release(self, _event):
        self.dragged = False

    def move(self, event):
        if not self.dragged or event.inaxes is not self.left:
            return
        self.y[self.middle] = event.ydata
        t, curve, basis = self.compute()
        self.line.set_data(t, curve)
        self.points.set_data(self.x, self.y)
        for line, row in zip(self.functions, basis, strict=True):
            line.set_data(t, row)
        if self.blits:
            self.canvas.restore_region(self.background)
            self.draw_artists()
            self.canvas.blit(self.figure.bbox)
        else:
            self.canvas.draw_idle()

    def draw_artists(self):
        for artist in (self.line, self.points):
            self.left.draw_artist(artist)
        for line in self.functions:
            self.right.draw_artist(line)

    def drawn(self, _event):
        if self.blits:
            self.background = self.canvas.copy_from_bbox(self.figure.bbox)
            self.draw_artists()


def drag_in_matplotlib(qtbot, n: int, *, mode: str, moves: int = 80, pace: float = 0.0) -> Times:
    """Drag the point in the middle of the demo; `mode` is "naive" or "blit"."""
    paints = Paints()
    demo = _Demo(n, mode, paints.counter("demo"))
    qtbot.addWidget(demo.canvas)
    demo.canvas.resize(1200, 600)
    with qtbot.waitExposed(demo.canvas):
        demo.canvas.show()
    qtbot.wait(300)
    x, y = demo.left.transData.transform((demo.x[demo.middle], demo.y[demo.middle]))
    place = QPointF(round(x), round(demo.canvas.height() - y))
    return drag(demo.canvas, place, paints, ["demo"], moves=moves, pace=pace)
