"""Annotations of the active curve: figures, ghosts and other versions, explained by the legend."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from PySide6.QtCore import QObject, QRectF, Qt, Signal
from PySide6.QtGui import QPainter

from curvecore.arrays import FloatArray

from .. import canvas
from ..plotting.drawing import MARGIN, AreaFill, Segments, Stroke, draw_segments
from ..plotting.graphs import pg
from ..plotting.layers import Layer
from ..plotting.pens import draw_line, draw_mark, line_in_pixels, pen_of
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.text import inside, size_of, write_on_plate
from ..view_model import analysis
from ..view_model.analysis.overlay import Figure, Shape
from ..view_model.curve.curve_view import CurveView
from ..view_model.line_styles import FILE_STYLE, LineStyle, Mark
from .other_curves_layer import FileLayer
from .shape_painting import TOLERANCE

if TYPE_CHECKING:
    from ..view_model.analysis.ghost_views import GhostView
    from ..view_model.analysis.legend import LegendRow
    from .legend import Legend, Room


_HEAD = 9.0
"""Length of an arrow's head, in widths of its line; at most half the arrow."""

_TICK, _MARK = 5.0, 5.0
"""Half the length of a tick and the radius of a mark, in pixels."""

_ABOVE = (Shape.ARROWS, Shape.TICKS, Shape.MARKS)
"""Shapes that are drawn over the curve."""

_FAR, _FARTHEST = 1e5, 1e30
"""Pixels to which the vertices of an area, or of a line, are limited."""


class FigureLayer(Layer):
    """Layer of figures of the plane, each in the pen of its style, with ghosts over them.

    Lines and areas lie under the curve, marks over it and under the points.
    """

    z = -0.5

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.figures: Sequence[Figure] = ()
        self.ghosts: Sequence[GhostView] = ()
        self._area = AreaFill()
        self._layers: list[Layer] = [self, Layer(plot, self._paint_above, z=0.5)]
        for layer in self._layers:
            # Even an empty layer takes time in every frame.
            layer.set_visible(False)

    def render(self, figures: Sequence[Figure], ghosts: Sequence[GhostView]) -> None:
        """Draw `figures` and `ghosts` from the next paint on."""
        if figures or ghosts or self.figures or self.ghosts:
            self.figures, self.ghosts = figures, ghosts
            for layer in self._layers:
                layer.set_visible(bool(figures or ghosts))
                layer.update()

    def ghost_lines(self, pixel_map: PixelMap) -> list[FloatArray]:
        """Return the ghosts that are drawn, as polylines (k, 2) of the plane."""
        return [_line_of(ghost, pixel_map) for ghost in self.ghosts if ghost.is_drawn]

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw lines and areas in order, then the ghosts: all of them below the curve."""
        for figure in self.figures:
            if figure.shape not in _ABOVE:
                self._paint_figure(painter, pixel_map, figure)
        for ghost in self.ghosts:
            self._paint_ghost(painter, pixel_map, ghost)

    def _paint_above(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the figures that the curve would hide, and the labels."""
        for figure in self.figures:
            if figure.shape in _ABOVE:
                self._paint_figure(painter, pixel_map, figure)
        for figure in self.figures:
            if figure.label:
                self._paint_label(painter, pixel_map, figure)

    def _paint_figure(self, painter: QPainter, pixel_map: PixelMap, figure: Figure) -> None:
        painter.setPen(pen_of(figure.style, self.theme, self.scale))
        pixels = _pixels(figure.points, pixel_map)
        match figure.shape:
            case Shape.LINE:
                draw_line(painter, pixels, figure.style.dashes, pixel_map)
            case Shape.SEGMENTS:
                draw_segments(painter, pixels.reshape(-1, 4), pixel_map)
            case Shape.ARROWS:
                _draw_arrows(painter, pixels, pixel_map)
            case Shape.TICKS:
                _draw_ticks(painter, pixels, pixel_map, _TICK * self.scale)
            case Shape.AREA:
                self._paint_area(painter, pixel_map, pixels)
            case Shape.MARKS:
                _draw_marks(painter, pixels, pixel_map, figure.style.mark, _MARK * self.scale)

    def _paint_area(self, painter: QPainter, pixel_map: PixelMap, pixels: FloatArray) -> None:
        """Fill polygons as one area, so that a translucent one has no seams."""
        is_corner = ~np.isnan(pixels[:, 0])
        corners = np.clip(pixels[is_corner], -_FAR, _FAR)
        # A corner before a break is not joined to the next; polygons close themselves when they are filled.
        connect = np.append(is_corner[1:], False)[is_corner].astype(np.int32)
        path = pg.arrayToQPath(corners[:, 0], corners[:, 1], connect=connect, finiteCheck=False)
        path.setFillRule(Qt.FillRule.WindingFill)
        self._area.fill(painter, path, painter.pen().color(), QRectF(0, 0, pixel_map.width, pixel_map.height))

    def _paint_ghost(self, painter: QPainter, pixel_map: PixelMap, ghost: GhostView) -> None:
        if not ghost.is_drawn:
            return
        style = ghost.ghost.style
        painter.setPen(pen_of(style, self.theme, self.scale))
        draw_line(painter, _pixels(_line_of(ghost, pixel_map), pixel_map), style.dashes, pixel_map)

    def _paint_label(self, painter: QPainter, pixel_map: PixelMap, figure: Figure) -> None:
        """Write beside the last point, on a plate of paper, inside the drawing."""
        x, y = _pixels(figure.points[-1:], pixel_map)[0].tolist()
        if not (-MARGIN < x < pixel_map.width + MARGIN and -MARGIN < y < pixel_map.height + MARGIN):
            return
        painter.setFont(self.fonts.times(0.95 * self.scale))
        size = size_of(painter, figure.label, 8, 2)
        plate = inside(x + 8, y - size.height() - 4, size, pixel_map)
        write_on_plate(painter, plate, figure.label, self.theme.paper, self.theme.ink)


def _line_of(ghost: GhostView, pixel_map: PixelMap) -> FloatArray:
    return ghost.line(TOLERANCE / max(pixel_map.sx, pixel_map.sy), pixel_map.box)


def _pixels(points: FloatArray, pixel_map: PixelMap) -> FloatArray:
    """Return finite pixels within limits; NaN where there is nothing to draw."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.clip(pixel_map.points(points), -_FARTHEST, _FARTHEST)


def _draw_arrows(painter: QPainter, pixels: FloatArray, pixel_map: PixelMap) -> None:
    """Draw segments with heads; short arrows have small heads, so that the shaft stays visible."""
    ends = pixels.reshape(-1, 2, 2)
    along, length = _directions(ends)
    head = np.minimum(_HEAD * painter.pen().widthF() / 1.5, length / 2)[:, None] * along
    side = np.column_stack([-head[:, 1], head[:, 0]]) * 0.45
    tips = ends[:, 1]
    barbs = [np.hstack([tips, tips - head + sign * side]) for sign in (1, -1)]
    draw_segments(painter, np.vstack([ends.reshape(-1, 4), *barbs]), pixel_map)


def _draw_ticks(painter: QPainter, pixels: FloatArray, pixel_map: PixelMap, half: float) -> None:
    ends = pixels.reshape(-1, 2, 2)
    along, _ = _directions(ends)
    draw_segments(painter, np.hstack([ends[:, 0] - half * along, ends[:, 0] + half * along]), pixel_map)


def _directions(ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return unit vectors from the first to the second ends, zero for zero, and their lengths."""
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    return along / np.where(length > 0, length, 1.0)[:, None], length


def _draw_marks(painter: QPainter, pixels: FloatArray, pixel_map: PixelMap, mark: Mark, size: float) -> None:
    for x, y in pixels[pixel_map.near(pixels, MARGIN)].tolist():
        draw_mark(painter, mark, x, y, size)


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
        """Draw the traces of a group from the next paint on; an empty sequence removes the group."""
        if not traces and group not in self.groups:
            return
        self.groups.pop(group, None)
        if traces:
            self.groups[group] = (traces, faded)
        self._drawn_at = None
        self.set_visible(bool(self.groups))
        self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the traces of every group, the last one on top.

        During a drag they are results of the document before it, so their dashes are computed once.
        """
        if self._drawn_at != (pixel_map, self.scale):
            self._drawn_at = pixel_map, self.scale
            self._lines = [
                (trace.style, faded, self._line(points, trace.style, pixel_map))
                for traces, faded in self.groups.values()
                for trace in traces
                for points in trace.pieces
            ]
        for style, faded, line in self._lines:
            painter.setPen(pen_of(style, self.theme, self.scale, _FADED if faded else 1.0))
            line.draw(painter)

    def _line(self, points: FloatArray, style: LineStyle, pixel_map: PixelMap) -> Stroke | Segments:
        with np.errstate(over="ignore"):
            return line_in_pixels(pixel_map.points(points), style.dashes, style.width * self.scale, pixel_map)


class Annotations(QObject):
    """Figures, ghosts and other versions of the curve.

    Attributes
    ----------
    figure_layer
        Combs, vectors, bands and the like, and variants (ghosts) of the curve.
    trace_layer
        Other versions of the curve, over it.
    legend
        None before the first row.
    file_version
        Name of the file's curves in the legend; empty while they are hidden.

    Signals
    -------
    ghost_adopted, ghost_hidden
        A variant shall replace the curve, or be removed; chosen in the legend.
    """

    ghost_adopted = Signal(object)
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
        """Show the curves in a file, dashed, under this name; an empty sequence hides them."""
        self._file_layer.render(views, range(len(views)))
        self.file_version = name if self._file_layer.is_visible else ""
        self._explain_lines("file", [(FILE_STYLE, self.file_version)] if self.file_version else ())

    def render_traces(
        self, group: str, traces: Sequence[Trace], heading: str = "", *, faded: bool = False
    ) -> None:
        """Show other versions of the curve over it, with rows in the legend; () removes the group."""
        self.trace_layer.render(group, traces, faded=faded)
        named = [(trace.style, trace.label) for trace in traces]
        self._explain_lines(group, named, heading, muted=faded)

    # The legend

    def render_legend(self, group: str, rows: Sequence[LegendRow]) -> None:
        """Show the rows of a group in the legend; without rows of any group there is no legend."""
        if self.legend is None:
            if not rows:
                return
            # Built with its first row: the first frame does without it.
            self.legend = canvas.legend.Legend(self._plot.viewport(), self._plot.layers, self._room)
            self._plot.camera.changed.connect(self.legend.move_away)
            self._plot.style_changed.connect(self.legend.render_style)
            self.legend.chosen.connect(self.ghost_adopted)
            self.legend.hidden.connect(self.ghost_hidden)
        self.legend.render_rows(group, rows)
        self.legend.move_away()

    def move_legend(self) -> None:
        """Move the legend to the corner where it covers least of the drawing."""
        if self.legend is not None:
            self.legend.move_away()

    def _explain_lines(
        self, group: str, lines: Sequence[tuple[LineStyle, str]], heading: str = "", *, muted: bool = False
    ) -> None:
        if not lines and self.legend is None:
            return
        self.render_legend(group, analysis.legend.line_rows(lines, heading, muted=muted))
