"""What the canvas shows: a picture to trace, grid, curves, points and weights. No gestures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from app.canvas.annotations import Annotations
from app.canvas.chosen_curves_layer import ChosenCurvesLayer
from app.canvas.corner_layer import CornerLayer
from app.canvas.curve_layer import CurveLayer
from app.canvas.fitting import all_inside, are_in_sight, box_of, way_back_inside
from app.canvas.grid_layer import GridLayer
from app.canvas.image_layer import ImageLayer
from app.canvas.label_place import Surroundings, number_box, segments_near
from app.canvas.other_curves_layer import OtherCurvesLayer
from app.canvas.point_layer import PointLayer
from app.canvas.unit_layer import UnitLayer
from app.document.model import Curve, ReferenceImage, Vector
from app.plotting.drawing import cut_segments
from app.plotting.plot_widget import PlotWidget
from app.theme import LIGHT
from app.view_model.basis_view import weights_at
from app.view_model.curve_view import CurveView, Floats
from app.view_model.handles import Handle

if TYPE_CHECKING:
    from app.canvas.motion_layer import MotionLayer
    from app.view_model.motion_picture import Dot, Role


class CanvasView(PlotWidget):
    """Draws the document; equal aspect.

    Attributes
    ----------
    grid
        The grid behind the drawing.
    annotations
        What explains the active curve: figures, ghosts, other versions, the legend.
    covered_top
        Tells how many pixels at the top a message covers; what is fitted into the view stays clear of it.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("canvas")
        self.setAccessibleName("Canvas")
        self.setAccessibleDescription("The curve with its points; drag points to change it.")
        self.getViewBox().setAspectLocked(True)
        self._view: CurveView | None = None
        self._views: Sequence[CurveView] = ()
        self._scrub: float | None = None
        self._image_layer = self.dress(ImageLayer(self, LIGHT))
        self.grid = self.dress(GridLayer(self, LIGHT))
        self._units = self.dress(UnitLayer(self, LIGHT))
        self._other_curves = self.dress(OtherCurvesLayer(self, LIGHT))
        self._chosen_curves = self.dress(ChosenCurvesLayer(self, LIGHT))
        self._curve_layer = self.dress(CurveLayer(self, LIGHT))
        self.annotations = Annotations(self)
        self._point_layer = self.dress(PointLayer(self, LIGHT))
        self._corner_layer = self.dress(CornerLayer(self, LIGHT))
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

    def render_others(
        self, views: Sequence[CurveView], active: int, chosen: frozenset[int] = frozenset()
    ) -> None:
        """Show the other curves of the document behind the active one; some are chosen."""
        self._views = views
        others = [place for place in range(len(views)) if place != active]
        self._other_curves.render(views, [place for place in others if place not in chosen])
        self._chosen_curves.render(views, [place for place in others if place in chosen])

    def render_motion(self, dots: Sequence[Dot], lines: Sequence[tuple[Role, Floats]] = ()) -> None:
        """Show dots that run, and the curves that some of them run along."""
        if self._motion is None:
            # Made when something runs: nobody waits for it at the start.
            from app.canvas.motion_layer import MotionLayer  # noqa: PLC0415

            self._motion = self.dress(MotionLayer(self, LIGHT))
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

    def set_hovered(self, index: int) -> None:
        """Light up a point (−1 for none)."""
        self._point_layer.hovered = index
        self._point_layer.refresh()

    def set_scrub(self, t: float | None) -> None:
        """Show the point of the curve at `t` and every point's weight there; None puts both away."""
        self._scrub = t
        self._show_weights()
        self._point_layer.refresh()

    @property
    def grid_spacing(self) -> Vector:
        """The distance of the grid's lines along x and y at this zoom."""
        return self.grid.spacing(self.pixel_map)

    @property
    def shows_all_points(self) -> bool:
        """Whether every point of the active curve is in sight."""
        if self._view is None or not len(self._view.points):
            return True
        return all_inside(self.pixel_map, self._view.points)

    def shows_curves_from(self, first: int) -> bool:
        """Whether the curves from this place on lie in sight, as far as `fit` would show them."""
        return are_in_sight(self._views[first:], self.pixel_map)

    def set_image(self, image: ReferenceImage | None, pixels: QImage | None) -> None:
        """Show a picture behind the curves; without `pixels` the frame where it belongs."""
        self._image_layer.render(image, pixels)
        for layer in (self._curve_layer, self._other_curves):
            layer.set_cased(pixels is not None)
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
        box = box_of(views) or self._image_layer.box
        if box is None:
            self.show_box((-0.5, 4.5), (-0.5, 4.5))
        else:
            self._show_below(*box, self.covered_top())

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

    def _surroundings_of(self, pixel: Vector) -> Surroundings:
        """Return what words beside a pixel should not cover: curve, handles, and numbers of points."""
        shown, layer = self.pixel_map, self._point_layer
        lines = [(*shown.point(*each.anchor), *shown.point(*each.position)) for each in layer.handles]
        segments = np.array(lines).reshape(-1, 4)
        polyline = self._curve_layer.polyline(shown)
        if polyline is not None:
            segments = np.vstack([segments, segments_near(polyline.points, pixel, shown)])
        words = [number_box(centre, length, layer.scale) for centre, length in layer.numbers]
        return Surroundings(cut_segments(segments, shown.width, shown.height), words)

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
        dx, dy = way_back_inside(x, shown.width), way_back_inside(y, shown.height)
        if dx or dy:
            self.pan(dx, dy)


def _rules(curve: Curve) -> Curve:
    """Return a curve without what does not shape it."""
    return msgspec.structs.replace(curve, name="", colour="", visible=True, locked=False)
