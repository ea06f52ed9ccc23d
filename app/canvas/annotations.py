"""Annotations of the active curve: figures, ghosts, other versions, and the legend that explains them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from .. import canvas
from ..plotting.plot_widget import PlotWidget
from ..view_model import analysis
from ..view_model.curve.curve_view import CurveView
from ..view_model.line_styles import FILE_STYLE, LineStyle
from .figure_layer import FigureLayer
from .other_curves_layer import FileLayer
from .trace_layer import Trace, TraceLayer

if TYPE_CHECKING:
    from ..view_model.analysis.legend import LegendRow
    from .legend import Legend, Room


class Annotations(QObject):
    """Figures, ghosts and other versions of the curve.

    Attributes
    ----------
    figure_layer
        Combs, vectors, bands and the like, and variants of the curve.
    trace_layer
        Other versions of the curve, over it.
    legend
        None until there is something to explain.
    file_version
        The name of a file's curves in the legend; empty while none are shown.

    Signals
    -------
    ghost_chosen, ghost_hidden
        A variant of the curve shall become the curve, or go away; said in the legend.
    """

    ghost_chosen = Signal(object)
    ghost_hidden = Signal(object)

    def __init__(self, plot: PlotWidget, room: Room) -> None:
        super().__init__(plot)
        self._plot, self._room = plot, room
        self.figure_layer = FigureLayer(plot)
        self._file_layer = FileLayer(plot)
        self.trace_layer = TraceLayer(plot)
        self.legend: Legend | None = None
        self.file_version = ""

    # Other versions

    def show_file_version(self, views: Sequence[CurveView], name: str) -> None:
        """Show the curves that a file holds, dashed and with this name; none: put them away."""
        self._file_layer.render(views, range(len(views)))
        self.file_version = name if self._file_layer.is_visible else ""
        self._explain_lines("file", [(FILE_STYLE, self.file_version)] if self.file_version else ())

    def render_traces(
        self, group: str, traces: Sequence[Trace], heading: str = "", *, faded: bool = False
    ) -> None:
        """Show other versions of the curve over it, explained; none take the group away."""
        self.trace_layer.render(group, traces, faded=faded)
        named = [(trace.style, trace.label) for trace in traces]
        self._explain_lines(group, named, heading, muted=faded)

    # The legend

    def render_legend(self, group: str, rows: Sequence[LegendRow]) -> None:
        """Explain what is shown; without rows of any group there is no legend."""
        if self.legend is None:
            if not rows:
                return
            # Built when there is something to explain: nobody waits for it at the start.

            self.legend = canvas.legend.Legend(self._plot.viewport(), self._plot.layers, self._room)
            self._plot.camera.changed.connect(self.legend.make_way)
            self._plot.style_changed.connect(self.legend.render_style)
            self.legend.chosen.connect(self.ghost_chosen)
            self.legend.hidden.connect(self.ghost_hidden)
        self.legend.render_rows(group, rows)
        self.legend.make_way()

    def make_way(self) -> None:
        """Let the legend go where it covers less of the drawing."""
        if self.legend is not None:
            self.legend.make_way()

    def _explain_lines(
        self, group: str, lines: Sequence[tuple[LineStyle, str]], heading: str = "", *, muted: bool = False
    ) -> None:
        if not lines and self.legend is None:
            return

        self.render_legend(group, analysis.legend.line_rows(lines, heading, muted=muted))
