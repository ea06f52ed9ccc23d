"""What tools can ask of the canvas, and have done there."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..document.model import Vector
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
    write, rewrite
        Told that a text shall begin at a place, or fill a frame from there to the opposite corner; and that
        the one of a curve shall be edited, from a place on if that is not None.
    """

    def __init__(
        self,
        plot: ToolPlot,
        drawing: CanvasScene,
        write: Callable[[Vector, Vector | None], object],
        rewrite: Callable[[int, Vector | None], object],
    ) -> None:
        self._plot, self._drawing = plot, drawing
        self._write, self._rewrite = write, rewrite

    def hit(self, pointer: Pointer, tool: Finder) -> Hit | None:
        return self._drawing.hit(pointer, tool)

    def curves_at(self, pointer: Pointer) -> Sequence[int]:
        return self._drawing.curves_at(pointer)

    def locked_at(self, pointer: Pointer) -> int:
        return self._drawing.locked_at(pointer)

    def grid_spacing(self) -> float:
        return self._drawing.grid.spacing(self._plot.pixel_map)

    def write_at(self, place: Vector, opposite: Vector | None = None) -> None:
        self._write(place, opposite)

    def open_text(self, curve: int, place: Vector | None = None) -> None:
        self._rewrite(curve, place)
