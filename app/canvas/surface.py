"""What tools can ask of the canvas."""

from __future__ import annotations

from ..plotting.tool_plot import ToolPlot
from ..tools.pointer import Hit, Pointer
from ..tools.surface import Finder, Surface
from .scene import CanvasScene


class CanvasSurface(Surface):
    """The drawing as tools see it.

    Parameters
    ----------
    plot, drawing
        Where it is drawn, and what lies there.
    """

    def __init__(self, plot: ToolPlot, drawing: CanvasScene) -> None:
        self._plot, self._drawing = plot, drawing

    def hit(self, pointer: Pointer, tool: Finder) -> Hit | None:
        return self._drawing.hit(pointer, tool)

    def locked_at(self, pointer: Pointer) -> int:
        return self._drawing.locked_at(pointer)

    def grid_spacing(self) -> float:
        return self._drawing.grid.spacing(self._plot.pixel_map)
