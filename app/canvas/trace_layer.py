"""Other versions of the curve over the curve: computed with few digits, or with a cure tried out."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pens import line_in_pixels, pen_of
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.segments import Segments
from ..view_model.line_styles import LineStyle

_FADED = 0.3


class Trace(msgspec.Struct, frozen=True, eq=False):
    """A curve as polylines (k, 2), in the plane, with its style and its name."""

    pieces: Sequence[FloatArray]
    style: LineStyle
    label: str


class TraceLayer(Layer):
    """Layer of groups of traces."""

    z = 0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.groups: dict[str, tuple[Sequence[Trace], bool]] = {}
        self._lines: list[tuple[LineStyle, bool, Stroke | Segments]] = []
        self._drawn_at: tuple[PixelMap, float] | None = None
        self.set_visible(False)

    def render(self, group: str, traces: Sequence[Trace], *, faded: bool) -> None:
        """Draw the traces of a group from the next paint on; none take the group away."""
        if not traces and group not in self.groups:
            return
        self.groups.pop(group, None)
        if traces:
            self.groups[group] = (traces, faded)
        self._drawn_at = None
        self.set_visible(bool(self.groups))
        self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the traces of every group, the last one on top.

        During a drag they are old results that stay: their dashes are made once.
        """
        if self._drawn_at != (shown, self.scale):
            self._drawn_at = shown, self.scale
            self._lines = [
                (trace.style, faded, self._line(points, trace.style, shown))
                for traces, faded in self.groups.values()
                for trace in traces
                for points in trace.pieces
            ]
        for style, faded, line in self._lines:
            painter.setPen(pen_of(style, self.theme, self.scale, _FADED if faded else 1.0))
            line.draw(painter)

    def _line(self, points: FloatArray, style: LineStyle, shown: PixelMap) -> Stroke | Segments:
        with np.errstate(over="ignore"):
            return line_in_pixels(shown.points(points), style.dashes, style.width * self.scale, shown)
