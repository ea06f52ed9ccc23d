"""What the canvas shows: a picture to trace, grid, curves, points and weights. No gestures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from app.canvas.corner_layer import CornerLayer
from app.canvas.curve_layer import CurveLayer
from app.canvas.figure_layer import FigureLayer
from app.canvas.file_layer import FileLayer
from app.canvas.grid_layer import GridLayer
from app.canvas.image_layer import ImageLayer
from app.canvas.other_curves_layer import OtherCurvesLayer
from app.canvas.point_layer import PointLayer
from app.canvas.trace_layer import Trace, TraceLayer
from app.canvas.unit_layer import UnitLayer
from app.document.model import Curve, ReferenceImage, Vector
from app.plot.pixel_map import PixelMap
from app.plot.plot_widget import PlotWidget
from app.theme import LIGHT, Theme
from app.view_model.analysis.figures import Figure
from app.view_model.basis_view import weights_at
from app.view_model.curve_view import CurveView, Floats
from app.view_model.handles import Handle
from app.view_model.looks import FILE_LOOK, Look

if TYPE_CHECKING:
    from app.canvas.legend import Legend
    from app.canvas.motion_layer import MotionLayer
    from app.view_model.analysis.ghosts import GhostView
    from app.view_model.analysis.legend import LegendRow
    from app.view_model.motion_picture import Dot, Role

_FIT_MARGIN = 0.12

_REVEAL_MARGIN = 40.0
"""Pixels between the edge and a point that the view was moved to show."""


class CanvasView(PlotWidget):
    """Draws the document; equal aspect.

    Attributes
    ----------
    covered_top
        Tells how many pixels at the top a message covers; what is fitted into the view stays clear of it.

    Signals
    -------
    ghost_chosen, ghost_hidden
        A variant of the curve shall become the curve, or go away; said in the legend.
    """

    ghost_chosen = Signal(object)
    ghost_hidden = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("canvas")
        self.setAccessibleName("Canvas")
        self.setAccessibleDescription("The curve with its points; drag points to change it.")
        self.getViewBox().setAspectLocked(True)
        self._view: CurveView | None = None
        self._views: Sequence[CurveView] = ()
        self._scrub: float | None = None
        self._theme = LIGHT
        self._image_layer = ImageLayer(self, LIGHT)
        self._grid = GridLayer(self, LIGHT)
        self._units = UnitLayer(self, LIGHT)
        self._other_curves = OtherCurvesLayer(self, LIGHT)
        self._figures = FigureLayer(self, LIGHT, z=-0.5)
        self._file_layer = FileLayer(self, LIGHT)
        self.legend: Legend | None = None
        self._curve_layer = CurveLayer(self, LIGHT)
        self._traces = TraceLayer(self, LIGHT)
        self._point_layer = PointLayer(self, LIGHT)
        self._corner_layer = CornerLayer(self, LIGHT)
        self._motion: MotionLayer | None = None
        self.covered_top: Callable[[], float] = lambda: 0.0

    def render_view(self, view: CurveView) -> None:
        """Show `view`; a ghost of the old curve stays for a moment when a rule has changed."""
        self._show_ghost_of_other_rules(view)
        self._view = view
        self._curve_layer.render(view)
        self._show_weights()
        self._point_layer.render(view)
        self._corner_layer.render(view)

    def set_selection(self, selection: frozenset[int]) -> None:
        """Show which points are selected."""
        self._point_layer.selection = selection
        self._point_layer.refresh()

    def set_unit(self, name: str) -> None:
        """Name the unit of length at the axes; empty for none."""
        self._units.unit = name

    def render_others(self, views: Sequence[CurveView], active: int) -> None:
        """Show the other curves of the document behind the active one."""
        self._views = views
        self._other_curves.render(views, active)

    def render_figures(self, figures: Sequence[Figure], ghosts: Sequence[GhostView] = ()) -> None:
        """Show combs, vectors, bands and the like beside the active curve, and variants of it."""
        self._figures.render(figures, ghosts)

    @property
    def figures(self) -> Sequence[Figure]:
        """What is shown beside the active curve."""
        return self._figures.figures

    def show_file_version(self, views: Sequence[CurveView], name: str) -> None:
        """Show the curves that a file holds, dashed and with this name; none: put them away."""
        self._file_layer.render(views, name)
        self._explain_lines("file", [(FILE_LOOK, self.file_version)] if self.file_version else ())

    @property
    def file_version(self) -> str:
        """What the curves of a file are called in the legend; empty while none are shown."""
        return self._file_layer.name

    def render_legend(self, group: str, rows: Sequence[LegendRow]) -> None:
        """Explain what is shown beside the active curve; without rows of any group there is no legend."""
        if self.legend is None:
            if not rows:
                return
            # Built when there is something to explain: nobody waits for it at the start.
            from app.canvas.legend import Legend  # noqa: PLC0415

            self.legend = Legend(self.viewport(), self._theme)
            self.legend.set_scale(self._figures.scale)
            self.legend.chosen.connect(self.ghost_chosen)
            self.legend.hidden.connect(self.ghost_hidden)
        self.legend.render_rows(group, rows)

    @property
    def ghosts(self) -> Sequence[GhostView]:
        """The variants of the active curve that are shown."""
        return self._figures.ghosts

    def render_traces(
        self, group: str, traces: Sequence[Trace], heading: str = "", *, faded: bool = False
    ) -> None:
        """Show other versions of the active curve over it, explained; none take the group away."""
        self._traces.render(group, traces, faded=faded)
        named = [(trace.look, trace.label) for trace in traces]
        self._explain_lines(group, named, heading, muted=faded)

    def _explain_lines(
        self, group: str, lines: Sequence[tuple[Look, str]], heading: str = "", *, muted: bool = False
    ) -> None:
        if not lines and self.legend is None:
            return
        from app.view_model.analysis.legend import line_rows  # noqa: PLC0415 - late, as the legend

        self.render_legend(group, line_rows(lines, heading, muted=muted))

    def traces(self, group: str) -> tuple[Sequence[Trace], bool]:
        """Return the traces of a group, and whether they are shown faded."""
        return self._traces.groups.get(group, ((), False))

    def render_motion(self, dots: Sequence[Dot], lines: Sequence[tuple[Role, Floats]] = ()) -> None:
        """Show dots that run, and the curves that some of them run along."""
        if self._motion is None:
            # Made when something runs: nobody waits for it at the start.
            from app.canvas.motion_layer import MotionLayer  # noqa: PLC0415

            self._motion = MotionLayer(self, self._theme)
            self._motion.scale = self._corner_layer.scale
        had_dots = bool(self.dots)
        self._motion.render(dots, lines)
        if bool(dots) != had_dots:
            self._show_weights()
            self._point_layer.refresh()

    @property
    def dots(self) -> Sequence[Dot]:
        """The dots that run."""
        return self._motion.dots if self._motion is not None else ()

    def _show_ghost_of_other_rules(self, view: CurveView) -> None:
        old = self._view
        if old is None or self.is_dragging or not old.is_current or not view.is_current:
            return
        same_nodes = old.source.nodes == view.source.nodes
        if same_nodes and _rules(old.source) != _rules(view.source):
            polyline = self._curve_layer.polyline(self.pixel_map)
            if polyline is not None:
                self._curve_layer.show_ghost(polyline.points)

    def hold_ghost(self, held: bool) -> None:
        """Keep a ghost of the curve as it is now while something is dragged elsewhere; then let it fade."""
        if not held:
            self._curve_layer.release_ghost()
            return
        polyline = self._curve_layer.polyline(self.pixel_map)
        if polyline is not None:
            self._curve_layer.hold_ghost(polyline.points)

    @property
    def ghost_opacity(self) -> float:
        """How much of a ghost is seen: 1 while it is held, less while it fades, 0 without one."""
        return self._curve_layer.ghost_opacity

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._theme = theme
        for layer in (self._image_layer, self._grid, self._units, self._curve_layer, self._point_layer):
            layer.theme = theme
        for other in (self._other_curves, self._corner_layer, self._figures, self._file_layer, self._traces):
            other.theme = theme
        if self.legend is not None:
            self.legend.set_theme(theme)
        if self._motion is not None:
            self._motion.theme = theme
        super().set_theme(theme)

    def set_scale(self, scale: float) -> None:
        """Enlarge points, lines and numbers, for a projector."""
        self._curve_layer.scale = self._point_layer.scale = scale
        for other in (self._other_curves, self._corner_layer, self._figures, self._file_layer, self._traces):
            other.scale = scale
        if self.legend is not None:
            self.legend.set_scale(scale)
        if self._motion is not None:
            self._motion.scale = scale
        super().set_scale(scale)

    def set_hovered(self, index: int) -> None:
        """Light up a point (−1 for none)."""
        self._point_layer.hovered = index
        self._point_layer.refresh()

    def set_scrub(self, t: float | None) -> None:
        """Show the point of the curve at `t` and every point's weight there; None puts both away."""
        self._scrub = t
        self._show_weights()
        self._point_layer.refresh()

    def set_grid_visible(self, visible: bool) -> None:
        """Show or hide the grid."""
        self._grid.visible = visible
        self.viewport().update()

    def set_grid_spacing(self, spacing: float) -> None:
        """Fix the distance of the grid's lines; 0 adapts it to the zoom."""
        self._grid.set_spacing(spacing)
        self.viewport().update()

    @property
    def grid_spacing(self) -> Vector:
        """The distance of the grid's lines along x and y at this zoom."""
        return self._grid.spacing(self.pixel_map)

    @property
    def shows_all_points(self) -> bool:
        """Whether every point of the active curve is in sight."""
        if self._view is None or not len(self._view.points):
            return True
        shown = self.pixel_map
        return _all_inside(shown, self._view.points)

    def shows_curves_from(self, first: int) -> bool:
        """Whether the curves from this place on lie in sight, as far as `fit` would show them."""
        boxes = _boxes_to_fit(self._views[first:], margin=0.0)
        return all(_all_inside(self.pixel_map, np.array(box)) for box in boxes)

    @property
    def pixel_size(self) -> float:
        """The size of a pixel in the plane, at this zoom."""
        return 1.0 / self.pixel_map.sx

    # The picture to trace

    def set_image(self, image: ReferenceImage | None, pixels: QImage | None) -> None:
        """Show a picture behind the curves; without `pixels` the frame where it belongs."""
        self._image_layer.render(image, pixels)
        self._point_layer.over_picture = pixels is not None

    def _show_weights(self) -> None:
        layer, view, t = self._point_layer, self._view, self._scrub
        if t is None or view is None or view.curve is None or not view.is_current:
            layer.weights = layer.scrub = None
            return
        x, y = view.curve.evaluate(t)
        # Where a dot runs, weights would cover it, and it tells its own numbers.
        layer.weights = None if self.dots else weights_at(view, t)
        layer.scrub = (t, float(x), float(y))

    def fit(self) -> None:
        """Show all visible curves and the active one; of a wild one, its points and their surroundings.

        Where there are no points the picture to trace is shown.
        """
        views = [view for view in self._views if view.source.visible or view is self._view]
        if self._view is not None and not any(view is self._view for view in views):
            views.append(self._view)
        # A picture may be far larger than what is traced of it; it counts while there is nothing else.
        boxes = _boxes_to_fit(views, margin=_FIT_MARGIN) or self._image_layer.boxes(_FIT_MARGIN)
        if not boxes:
            self.show_box((-0.5, 4.5), (-0.5, 4.5))
            return
        low = np.min([box[0] for box in boxes], axis=0)
        high = np.max([box[1] for box in boxes], axis=0)
        # A small curve at the edge of a large drawing has the margin of the drawing.
        bare = _boxes_to_fit(views, margin=0.0) or self._image_layer.boxes(0.0)
        inner_low = np.min([box[0] for box in bare], axis=0)
        inner_high = np.max([box[1] for box in bare], axis=0)
        margin = _FIT_MARGIN * float((inner_high - inner_low).max())
        low, high = np.minimum(low, inner_low - margin), np.maximum(high, inner_high + margin)
        self._show_below(low, high, self.covered_top())

    def _show_below(self, low: Floats, high: Floats, covered: float) -> None:
        """Show a box below `covered` pixels at the top, on which a message lies."""
        shown = self.pixel_map
        room = max(shown.height - covered, 0.5 * shown.height)
        # As tall as it becomes with equal units along x and y.
        tall = max(high[1] - low[1], (high[0] - low[0]) * room / shown.width)
        top = (low[1] + high[1] + tall) / 2 + tall * (shown.height - room) / room
        self.show_box((low[0], high[0]), ((low[1] + high[1] - tall) / 2, top))

    @property
    def weights(self) -> Floats | None:
        """The weight of every point at the scrub line, None while there is none."""
        return self._point_layer.weights

    @property
    def scrub_point(self) -> Vector | None:
        """The point of the curve at the scrub line, None while there is none."""
        scrub = self._point_layer.scrub
        return scrub[1:] if scrub is not None else None

    @property
    def points_note(self) -> str:
        """What is said where so many points lie so close that not all are drawn; empty where they are."""
        return self._point_layer.note

    @property
    def handles(self) -> Sequence[Handle]:
        """The handles on screen: those of the selected point."""
        return self._point_layer.handles

    def _selected_place(self) -> QPointF | None:
        """Return where the first selected point lies in the viewport."""
        chosen = sorted(self._point_layer.selection)
        if self._view is None or not chosen or chosen[0] >= len(self._view.points):
            return None
        return QPointF(self.to_pixel(*self._view.points[chosen[0]].tolist()))

    def _reveal_selected(self) -> None:
        """Move the view so far that the selected point is in sight."""
        if self._view is None or len(self._point_layer.selection) != 1:
            return
        shown = self.pixel_map
        index = next(iter(self._point_layer.selection))
        x, y = shown.point(*self._view.points[index].tolist())
        dx, dy = _back_inside(x, shown.width), _back_inside(y, shown.height)
        if dx or dy:
            self.pan(dx, dy)

    def centre(self) -> QPointF:
        """Return the middle of the plot area in viewport pixels, where the zoom actions zoom."""
        shown = self.pixel_map
        return self._area_origin() + QPointF(shown.width / 2, shown.height / 2)


def _back_inside(pixel: float, size: float) -> float:
    """Return how far to move what lies at `pixel` so that it is in sight; 0 where it is already."""
    margin = min(_REVEAL_MARGIN, size / 4)
    if 0 <= pixel <= size:
        return 0.0
    return (margin if pixel < 0 else size - margin) - pixel


def _rules(curve: Curve) -> Curve:
    """Return a curve without what does not shape it."""
    return msgspec.structs.replace(curve, name="", colour="", visible=True, locked=False)


def _all_inside(shown: PixelMap, points: Floats) -> bool:
    pixels = shown.points(points)
    return bool(((pixels >= 0) & (pixels <= (shown.width, shown.height))).all())


def _boxes_to_fit(views: Sequence[CurveView], *, margin: float) -> list[tuple[Floats, Floats]]:
    return [_box_to_fit(view.points, view.polyline, margin) for view in views if len(view.points)]


def _box_to_fit(points: Floats, polyline: Floats, margin: float) -> tuple[Floats, Floats]:
    """Return the corners of the box to show: the curve, but at most three times as large as its points."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    if len(polyline):
        low = np.maximum(np.minimum(low, polyline.min(axis=0)), low - size)
        high = np.minimum(np.maximum(high, polyline.max(axis=0)), high + size)
    # One point, or several at one place, are shown in an area of unit size (at 1e9 a visible part of that).
    size = max(float((high - low).max()), 1e-6 * float(np.abs(high).max()), 1e-7) if size else 4.0
    return low - margin * size, high + margin * size
