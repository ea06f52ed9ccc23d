"""Other versions of the curve over the curve: computed with few digits, or with a cure tried out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtGui import QPainter

from app.plot.drawing import Floats
from app.plot.pens import draw_line, pen_of
from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import Theme
from app.view_model.looks import Look

_FADED = 0.3


@dataclass(frozen=True, eq=False)
class Trace:
    """A curve as polylines (k, 2), in the plane, with its look and its name."""

    pieces: Sequence[Floats]
    look: Look
    label: str


class TraceLayer:
    """Draws groups of traces."""

    def __init__(self, plot: PlotWidget, theme: Theme) -> None:
        self.theme = theme
        self.scale = 1.0
        self.groups: dict[str, tuple[Sequence[Trace], bool]] = {}
        self._layer = plot.add_layer(self.paint, z=0.5)

    def render(self, group: str, traces: Sequence[Trace], *, faded: bool) -> None:
        """Draw the traces of a group from the next paint on; none take the group away."""
        if not traces and group not in self.groups:
            return
        self.groups.pop(group, None)
        if traces:
            self.groups[group] = (traces, faded)
        self._layer.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the traces of every group, the last one on top."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        for traces, faded in self.groups.values():
            for trace in traces:
                painter.setPen(pen_of(trace.look, self.theme, self.scale, _FADED if faded else 1.0))
                for points in trace.pieces:
                    with np.errstate(over="ignore"):
                        pixels = shown.points(points)
                    draw_line(painter, pixels, trace.look.dashes, shown)
