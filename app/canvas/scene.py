"""Scene of the canvas: its layers, and the values rendered into them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QRect
from PySide6.QtGui import QImage

from curvecore.arrays import FloatArray

from .. import canvas
from ..document.curve_edits import without_appearance
from ..document.model import ReferenceImage, Vector
from ..document.point_group import PointGroup
from ..plotting.drawing import cut_segments, visible_segments
from ..plotting.text import Surroundings, number_box, segments_near
from ..plotting.tool_plot import ToolPlot
from ..tools.marks import Marks
from ..tools.pointer import Hit, Part, Pointer
from ..view_model.basis import weights_at
from ..view_model.curve.curve_view import CurveView
from .curve_layer import ControlPolygonLayer, PenLayer
from .figure_layer import Annotations
from .grid_layer import GridLayer, GuidesLayer, UnitLayer
from .hit_test import hit_test, nearer
from .image_layer import ImageLayer
from .marks_layer import MarksLayer
from .other_curves_layer import DrawnCurves
from .other_points_layer import OtherPointsLayer
from .point_layer import PointLayer

if TYPE_CHECKING:
    from ..view_model.motion import Dot, Role
    from .motion_layer import MotionLayer


_DISC = 5.0
"""Half the width of a point in pixels."""


class CanvasScene:
    """The layers of the canvas, and the values rendered into them.

    The window calls `render_view` and `render_others` with the views of a document, and `follow_drag` at
    every step of a drag, in which only the active curve has moved. `hit` returns the part under the pointer.

    Attributes
    ----------
    view, views
        The active curve, None before the first; all curves of the document.
    is_editing
        Whether the active curve is edited: otherwise it is drawn and found as the others are.
    image
        The picture to trace.
    grid, units
        The grid behind the drawing; the unit at the axes.
    curves
        All curves, from the back to the front.
    others, selected
        The curves that are not edited; marks of those that are selected with the active one.
    polygon, curve, points
        The active curve, and its control polygon if it does not pass its points.
    other_points
        Selected points of the curves that are edited with the active one.
    guides
        The guides.
    annotations
        Figures, ghosts and other versions of the active curve, and the legend.
    marks, pen
        Marks of a gesture; preview of the pen.
    """

    def __init__(self, plot: ToolPlot) -> None:
        self._plot = plot
        self.view: CurveView | None = None
        self.views: Sequence[CurveView] = ()
        self.is_editing = True
        self._scrub: float | None = None
        self.image = ImageLayer(plot)
        self.grid = GridLayer(plot)
        self.units = UnitLayer(plot)
        self.curves = DrawnCurves(plot)
        curves = self.curves
        self.others, self.selected, self.curve = curves.others, curves.selected, curves.curve
        self.polygon = ControlPolygonLayer(plot)
        self.annotations = Annotations(plot, self)
        self.guides = GuidesLayer(plot)
        self.points = PointLayer(plot)
        self.other_points = OtherPointsLayer(plot, lambda: bool(self.points.note))
        self.marks = MarksLayer(plot, self._surroundings_of)
        self.pen = PenLayer(plot)
        self._motion: MotionLayer | None = None

    # Curves

    def render_view(self, view: CurveView) -> None:
        """Show the active curve; a ghost of the old one fades when a rule has changed."""
        self._show_ghost_of_other_rules(view)
        self.view = view
        self.polygon.render(view)
        self.curve.render(view)
        self._show_weights()
        self.points.render(view)
        self.annotations.move_legend()

    def render_others(
        self,
        views: Sequence[CurveView],
        active: int | None,
        selected: frozenset[int],
        edited: frozenset[int],
    ) -> None:
        """Show all curves of the document: the active one if it is edited, the selected and edited ones."""
        self.views, self.is_editing = views, active is not None
        for layer in (self.curve, self.points, self.polygon):
            layer.set_enabled(self.is_editing)
        self.curves.render(views, active, selected, edited)
        self.other_points.render(views, sorted(edited - {active}))
        self._show_marks_now()

    def follow_drag(self, views: Sequence[CurveView]) -> None:
        """Show the active curve after a step of a drag; other curves and the selection stay."""
        self.views = views
        self.curves.follow_drag(views)
        self._show_marks_now()

    def set_selection(self, selection: frozenset[int], group: PointGroup) -> None:
        """Show the selected points of the active curve, and of all curves that are edited."""
        self.points.selection = selection
        self.points.refresh()
        self.other_points.set_group(group)
        self._plot.show_marks()

    def set_hovered(self, index: int) -> None:
        """Highlight a point (−1 for none)."""
        self.points.hovered = index
        self.points.refresh()

    def set_image(self, image: ReferenceImage | None, pixels: QImage | None) -> None:
        """Show a picture behind the curves; without `pixels` a frame in its place."""
        self.image.render(image, pixels)
        self.curves.set_cased(pixels is not None)
        self.points.over_picture = self.other_points.over_picture = pixels is not None

    def set_plain(self, is_plain: bool) -> None:
        """Draw points without numbers and colours of their own."""
        for layer in (self.points, self.other_points):
            layer.is_plain = is_plain
            layer.update()

    # Ghost

    def _show_ghost_of_other_rules(self, view: CurveView) -> None:
        old = self.view
        if old is not None and len(old.source.points) != len(view.source.points):
            self.curve.drop_ghost()
        if old is None or old.source.points != view.source.points:
            return
        if self._plot.is_dragging or not old.is_current or not view.is_current:
            return
        if without_appearance(old.source) != without_appearance(view.source):
            self.curve.show_ghost(self._plot.pixel_map)

    def hold_ghost(self, held: bool) -> None:
        """Keep a ghost of the present curve while a slider is dragged; then let it fade."""
        if held:
            self.curve.show_ghost(self._plot.pixel_map, held=True)
        else:
            self.curve.release_ghost()

    # Scrub line and motion

    def set_scrub(self, t: float | None) -> None:
        """Show the point of the curve at `t` and every point's weight there; None removes both."""
        self._scrub = t
        self._show_weights()
        self.points.refresh()

    def _show_weights(self) -> None:
        layer, view, t = self.points, self.view, self._scrub
        if t is None or view is None or view.curve is None or not view.is_current:
            layer.weights = layer.scrub = None
            return
        x, y = view.curve.evaluate(t)
        # Weights would cover the moving dots, which have numbers of their own.
        layer.weights = None if self.dots else weights_at(view, t)
        layer.scrub = (t, float(x), float(y))

    def render_motion(self, dots: Sequence[Dot], lines: Sequence[tuple[Role, FloatArray]] = ()) -> None:
        """Show moving dots, and the curves that some of them run along."""
        if self._motion is None:
            # Built with the first motion: the first frame does without it.
            self._motion = canvas.motion_layer.MotionLayer(self._plot)
        had_dots = bool(self.dots)
        self._motion.render(dots, lines)
        if bool(dots) != had_dots:
            self._show_weights()
            self.points.refresh()

    @property
    def dots(self) -> Sequence[Dot]:
        """The moving dots."""
        return self._motion.dots if self._motion is not None else ()

    # Gestures

    def _show_marks_now(self) -> None:
        """Show the marks again, unless a gesture in flight does so."""
        if not self._plot.is_dragging:
            self._plot.show_marks()

    def show_marks(self, marks: Marks) -> None:
        """Show the marks of a gesture, or of the pen before a press."""
        self.marks.render(marks)
        self.guides.highlight(marks.guide)
        lines = (*marks.waiting, *([marks.line] if marks.line else []))
        self.pen.render(marks.preview_curve, lines, marks.replaced)

    def hit(self, pointer: Pointer, parts: frozenset[Part]) -> Hit | None:
        """Return the part of the drawing under the pointer if it is one of some kinds."""
        pixel_map, pixel, points = self._plot.pixel_map, pointer.pixel, self.points
        if Part.IMAGE in parts:
            return self.image.hit(pixel, pixel_map)
        if self.view is None:
            return None
        hit = None
        if self.is_editing:
            polyline = self.curve.polyline(pixel_map)
            handles = points.visible_handles
            both_handles = handles.of_selected(pixel_map), handles.facing(pixel_map)
            hit = hit_test(pixel, pixel_map, self.view, polyline, points.selection, *both_handles)
            if Part.OTHER_POINT in parts:
                hit = nearer(self.other_points.nearest(pixel, pixel_map), hit, pixel, pixel_map)
        if Part.OTHER_END in parts:
            hit = nearer(self.curves.nearest_end(pixel, pixel_map), hit, pixel, pixel_map)
        if hit is None and Part.OTHER_CURVE in parts:
            hit = self.curves.hit(pixel, pixel_map)
        if Part.GUIDE in parts and (hit is None or hit.inside):
            hit = self.guides.hit(pixel, pixel_map) or hit
        return hit

    def locked_at(self, pointer: Pointer) -> int:
        """Return the index of the locked curve at the pointer; −1 for none."""
        return self.curves.locked_at(pointer.pixel, self._plot.pixel_map)

    @property
    def area(self) -> QRect:
        """The drawing in pixels of the viewport."""
        return self._plot.camera.area

    @property
    def is_busy(self) -> bool:
        """Whether a gesture is in flight."""
        return self._plot.is_dragging

    def segments(self) -> FloatArray:
        """Return curve, ghosts and points as line segments (k, 4) in pixels of the viewport."""
        pixel_map, origin = self._plot.pixel_map, self._plot.camera.origin
        polyline = self.curve.polyline(pixel_map)
        lines = [polyline.points] if polyline is not None else []
        lines += self.annotations.figure_layer.ghost_lines(pixel_map)
        parts = [
            visible_segments(pixel_map.points(line), pixel_map.width, pixel_map.height) for line in lines
        ]
        if self.view is not None:
            pixels, disc = pixel_map.points(self.view.points), np.array([_DISC, 0.0])
            parts.append(np.hstack([pixels - disc, pixels + disc]))
        offset = np.tile([origin.x(), origin.y()], 2)
        segments: FloatArray = np.concatenate([np.empty((0, 4)), *parts]) + offset
        return segments

    def _surroundings_of(self, pixel: Vector) -> Surroundings:
        """Return the lines and numbers that a label beside a pixel should not cover."""
        pixel_map, layer = self._plot.pixel_map, self.points
        beside = [handles.of_selected(pixel_map) for _, handles in self.other_points.handles(pixel_map)]
        lines = np.concatenate([handles.lines for handles in (layer.handles, *beside)])
        segments = pixel_map.points(lines.reshape(-1, 2)).reshape(-1, 4)
        polyline = self.curve.polyline(pixel_map)
        if polyline is not None:
            segments = np.vstack([segments, segments_near(polyline.points, pixel, pixel_map)])
        labels = [number_box(centre, length, layer.scale) for centre, length in layer.numbers]
        return Surroundings(cut_segments(segments, pixel_map.width, pixel_map.height), labels)
