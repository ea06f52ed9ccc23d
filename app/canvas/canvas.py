"""The canvas: shows the active curve and turns mouse and keys into gestures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import msgspec
import numpy as np
from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent
from PySide6.QtWidgets import QWidget

from app.canvas.corner_layer import CornerLayer
from app.canvas.curve_layer import CurveLayer
from app.canvas.grid_layer import GridLayer
from app.canvas.hit_test import hit_test
from app.canvas.other_curves_layer import OtherCurvesLayer
from app.canvas.point_layer import PointLayer
from app.document.model import Curve, Vector
from app.gestures.pointer import Hint, Pointer
from app.gestures.tools import CanvasTool, ToolKind
from app.plot.plot_widget import PlotWidget
from app.theme import LIGHT, Theme
from app.view_model.basis_view import weights_at
from app.view_model.curve_view import CurveView, Floats
from app.view_model.handles import Handle

_FIT_MARGIN = 0.12

_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


class Canvas(PlotWidget):
    """The drawing area.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    pointed_at
        The position of the pointer in the plane, or None when it has left.
    menu_requested
        A menu is wanted: for what lies there (a Hit or None), at a place of the screen.
    """

    hint_changed = Signal(str)
    pointed_at = Signal(object)
    menu_requested = Signal(object, QPoint)

    def __init__(self, tool: CanvasTool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("canvas")
        self.setAccessibleName("Canvas")
        self.setAccessibleDescription("The curve with its points; drag points to change it.")
        self._tool = tool
        self._view: CurveView | None = None
        self._scrub: float | None = None
        self.getViewBox().setAspectLocked(True)
        self._grid = GridLayer(self, LIGHT)
        self._curve_layer = CurveLayer(self, LIGHT)
        self._point_layer = PointLayer(self, LIGHT)
        self._other_curves = OtherCurvesLayer(self, LIGHT)
        self._corner_layer = CornerLayer(self, LIGHT)
        self._views: Sequence[CurveView] = ()

    # What is shown

    def render_view(self, view: CurveView) -> None:
        """Show `view`; a ghost of the old curve stays for a moment when a rule has changed."""
        self._show_ghost_of_other_rules(view)
        self._view = view
        self._curve_layer.render(view)
        self._show_weights()
        self._point_layer.render(view)
        self._corner_layer.render(view)

    def render_others(self, views: Sequence[CurveView], active: int) -> None:
        """Show the other curves of the document behind the active one."""
        self._views = views
        self._other_curves.render(views, active)

    def _show_ghost_of_other_rules(self, view: CurveView) -> None:
        old = self._view
        if old is None or self._tool.is_pressed or not old.is_current or not view.is_current:
            return
        same_nodes = old.source.nodes == view.source.nodes
        if same_nodes and _rules(old.source) != _rules(view.source):
            polyline = self._curve_layer.polyline(self.pixel_map)
            if polyline is not None:
                self._curve_layer.show_ghost(polyline.points)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        for layer in (self._grid, self._curve_layer, self._point_layer):
            layer.theme = theme
        self._other_curves.theme = self._corner_layer.theme = theme
        super().set_theme(theme)

    def set_scale(self, scale: float) -> None:
        """Enlarge points, lines and numbers, for a projector."""
        self._curve_layer.scale = self._point_layer.scale = scale
        self._other_curves.scale = self._corner_layer.scale = scale
        self.viewport().update()

    def set_selection(self, selection: frozenset[int]) -> None:
        """Show which points are selected."""
        self._point_layer.selection = selection
        self._point_layer.refresh()

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

    @property
    def is_grid_visible(self) -> bool:
        """Whether the grid is shown."""
        return self._grid.visible

    def _show_weights(self) -> None:
        layer, view, t = self._point_layer, self._view, self._scrub
        if t is None or view is None or view.curve is None or not view.is_current:
            layer.weights = layer.scrub = None
            return
        x, y = view.curve.evaluate(t)
        layer.weights = weights_at(view, t)
        layer.scrub = (t, float(x), float(y))

    def fit(self) -> None:
        """Show all visible curves and the active one; of a wild one, its points and their surroundings."""
        views = [view for view in self._views if view.source.visible or view is self._view]
        if self._view is not None and not any(view is self._view for view in views):
            views.append(self._view)
        boxes = [_box_to_fit(view.points, view.polyline) for view in views if len(view.points)]
        if not boxes:
            self.show_box((-0.5, 4.5), (-0.5, 4.5))
            return
        low = np.min([box[0] for box in boxes], axis=0)
        high = np.max([box[1] for box in boxes], axis=0)
        self.show_box((low[0], high[0]), (low[1], high[1]))

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
    def handles(self) -> Sequence[Handle]:
        """The handles on screen: those of the selected point."""
        return self._point_layer.handles

    # Gestures

    def set_tool(self, kind: ToolKind) -> None:
        """Choose what a press means."""
        self._tool.cancel()
        self._tool.kind = kind
        self._set_cursor(grab=False)

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self._tool.is_pressed

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return self._tool.cancel()

    def forget_gesture(self) -> None:
        """Drop the gesture in flight; the document is another one."""
        self._tool.forget()

    def pressed(self, pointer: Pointer) -> None:
        self._tool.press(self._with_hit(pointer))

    def moved(self, pointer: Pointer) -> None:
        self._tool.move(pointer)
        self.pointed_at.emit(pointer.position)

    def released(self, pointer: Pointer) -> None:
        self._tool.release(pointer)
        self.hovered_at(pointer)

    def hovered_at(self, pointer: Pointer) -> None:
        hint = self._tool.hover(self._with_hit(pointer))
        self._show_hint(hint)
        self.pointed_at.emit(pointer.position)

    def left(self) -> None:
        if not self._tool.is_pressed:
            self._tool.hover(Pointer((np.inf, np.inf), (np.inf, np.inf)))
            self.hint_changed.emit("")
            self.pointed_at.emit(None)

    def _with_hit(self, pointer: Pointer) -> Pointer:
        if self._view is None:
            return pointer
        shown, layer = self.pixel_map, self._point_layer
        polyline = self._curve_layer.polyline(shown)
        hit = hit_test(pointer.pixel, shown, self._view, polyline, layer.selection, layer.handles)
        if hit is None and self._tool.kind is ToolKind.SELECT:
            hit = self._other_curves.hit(pointer.pixel, shown)
        return replace(pointer, hit=hit)

    def _show_hint(self, hint: Hint) -> None:
        self._set_cursor(grab=hint.grab)
        self.hint_changed.emit(hint.text)

    def _set_cursor(self, *, grab: bool) -> None:
        if self._space_down or self._pan_from is not None:
            return
        idle = Qt.CursorShape.CrossCursor if self._tool.kind is ToolKind.ADD else Qt.CursorShape.ArrowCursor
        self.viewport().setCursor(Qt.CursorShape.PointingHandCursor if grab else idle)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for a menu: for what lies under the pointer; by the Menu key, for the selected point."""
        event.accept()
        if self._tool.is_pressed:
            return
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        place = self._selected_place() if by_key else QPointF(event.pos())
        hit = self._with_hit(self.pointer_at(place)).hit if place is not None else None
        corner = (place or self.centre()).toPoint()
        self.menu_requested.emit(hit, self.viewport().mapToGlobal(corner))

    def _selected_place(self) -> QPointF | None:
        """Return where the first selected point lies in the viewport."""
        chosen = sorted(self._point_layer.selection)
        if self._view is None or not chosen or chosen[0] >= len(self._view.points):
            return None
        return QPointF(self.to_pixel(*self._view.points[chosen[0]].tolist()))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if (event.key() == Qt.Key.Key_Escape and self.cancel_gesture()) or self._nudge(event):
            event.accept()
            return
        super().keyPressEvent(event)

    def _nudge(self, event: QKeyEvent) -> bool:
        """Move the selected points by a pixel: with Shift ten, with Ctrl a tenth."""
        direction = _ARROWS.get(Qt.Key(event.key()))
        if direction is None or self._tool.is_pressed:
            return False
        held = event.modifiers()
        step = 1.0 / self.pixel_map.sx
        if held & Qt.KeyboardModifier.ShiftModifier:
            step *= 10
        if held & Qt.KeyboardModifier.ControlModifier:
            step /= 10
        self._tool.nudge((direction[0] * step, direction[1] * step))
        return True

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Let Tab walk the points; past the last one it leaves the canvas, as Tab does everywhere."""
        return self._tool.walk(1 if forward else -1) or super().focusNextPrevChild(forward)

    def centre(self) -> QPointF:
        """Return the middle of the plot area in viewport pixels, where the zoom actions zoom."""
        shown = self.pixel_map
        return self._area_origin() + QPointF(shown.width / 2, shown.height / 2)


def _rules(curve: Curve) -> Curve:
    """Return a curve without what does not shape it."""
    return msgspec.structs.replace(curve, name="", colour="", visible=True, locked=False)


def _box_to_fit(points: Floats, polyline: Floats) -> tuple[Floats, Floats]:
    """Return the corners of the box to show: the curve, but at most three times as large as its points."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    if len(polyline):
        low = np.maximum(np.minimum(low, polyline.min(axis=0)), low - size)
        high = np.minimum(np.maximum(high, polyline.max(axis=0)), high + size)
    # One point, or several at one place, are shown in an area of unit size (at 1e9 a visible part of that).
    size = max(float((high - low).max()), 1e-6 * float(np.abs(high).max()), 1e-7) if size else 4.0
    margin = _FIT_MARGIN * size
    return low - margin, high + margin
