"""The canvas: shows the active curve and turns mouse and keys into gestures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import msgspec
import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QImage, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from app.canvas.corner_layer import CornerLayer
from app.canvas.curve_layer import CurveLayer
from app.canvas.grid_layer import GridLayer
from app.canvas.hit_test import hit_test
from app.canvas.image_layer import ImageLayer
from app.canvas.keys import ARROWS, cursor_of, transform_key
from app.canvas.other_curves_layer import OtherCurvesLayer
from app.canvas.overlay_layer import OverlayLayer
from app.canvas.point_layer import PointLayer
from app.canvas.unit_layer import UnitLayer
from app.document.model import Curve, ReferenceImage, Vector
from app.gestures.image_tool import ImageTool
from app.gestures.overlay import Overlay
from app.gestures.pointer import Hint, Pointer
from app.gestures.snapping import Snapping
from app.gestures.tools import CanvasTool, ToolKind
from app.gestures.transform import TransformKind
from app.plot.plot_widget import PlotWidget
from app.theme import LIGHT, Theme
from app.view_model.basis_view import weights_at
from app.view_model.curve_view import CurveView, Floats
from app.view_model.handles import Handle

_FIT_MARGIN = 0.12

_REVEAL_MARGIN = 40.0
"""Pixels between the edge and a point that the view was moved to show."""


class Canvas(PlotWidget):
    """The drawing area.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    progress_changed
        How far the gesture in flight has come (a sentence).
    pointed_at
        The position of the pointer in the plane, or None when it has left.
    menu_requested
        A menu is wanted: for what lies there (a Hit or None), at a place of the screen.
    """

    hint_changed = Signal(str)
    progress_changed = Signal(str)
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
        self._image_layer = ImageLayer(self, LIGHT)
        self._image_tool: ImageTool | None = None
        self._grid = GridLayer(self, LIGHT)
        self._units = UnitLayer(self, LIGHT)
        self._curve_layer = CurveLayer(self, LIGHT)
        self._point_layer = PointLayer(self, LIGHT)
        self._overlay_layer = OverlayLayer(self, LIGHT)
        self._theme = LIGHT
        self._pointer: Pointer | None = None
        self._menu_refused = False
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
        self._show_overlay()
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
        self._overlay_layer.theme = theme
        self._other_curves.theme = self._corner_layer.theme = theme
        super().set_theme(theme)

    def set_scale(self, scale: float) -> None:
        """Enlarge points, lines and numbers, for a projector."""
        self._curve_layer.scale = self._point_layer.scale = self._overlay_layer.scale = scale
        self._other_curves.scale = self._corner_layer.scale = scale
        self.viewport().update()

    def set_selection(self, selection: frozenset[int]) -> None:
        """Show which points are selected."""
        self._point_layer.selection = selection
        self._point_layer.refresh()
        self._show_overlay()

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

    def set_snapping(self, snapping: Snapping) -> None:
        """Choose whether points snap, and to what."""
        self._tool.snapping = snapping

    def set_unit(self, name: str) -> None:
        """Name the unit of length at the axes and in measures; empty for none."""
        self._tool.unit = name
        self._units.unit = name

    def set_box_visible(self, visible: bool) -> None:
        """Show or hide the box with grips around two or more selected points."""
        self._tool.shows_box = visible
        self._show_overlay()

    @property
    def overlay(self) -> Overlay:
        """What the gestures show over the drawing."""
        return self._overlay_layer.overlay

    def _show_overlay(self) -> None:
        self._overlay_layer.render(self._tool.overlay())

    # The picture to trace

    def set_image(self, image: ReferenceImage | None, pixels: QImage | None) -> None:
        """Show a picture behind the curves; without `pixels` the frame where it belongs."""
        self._image_layer.render(image, pixels)

    def set_image_tool(self, tool: ImageTool | None) -> None:
        """Let the mouse move and scale the picture, until None gives it back to the points."""
        self.cancel_gesture()
        self._image_tool = tool
        self._image_layer.has_grips = tool is not None
        self._set_cursor(Hint())
        self.viewport().update()

    @property
    def is_moving_image(self) -> bool:
        """Whether the mouse moves the picture instead of the points."""
        return self._image_tool is not None

    @property
    def _active_tool(self) -> CanvasTool | ImageTool:
        return self._image_tool or self._tool

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
        self._active_tool.cancel()
        self._tool.put_away()
        self._tool.kind = kind
        self._set_cursor(Hint())
        self._show_overlay()

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self._active_tool.is_pressed

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        cancelled = self._active_tool.cancel()
        self._show_overlay()
        return cancelled

    def put_away(self) -> bool:
        """Put away what was measured; return whether there was something."""
        found = self._tool.put_away()
        self._show_overlay()
        return found

    def forget_gesture(self) -> None:
        """Drop the gesture in flight; the document is another one."""
        self._active_tool.forget()

    def begin_transform(self, kind: TransformKind) -> None:
        """Let the selected points follow the pointer from where it is, until Enter, a click or Escape."""
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self._tool.grid = self.grid_spacing
        if self._tool.begin_transform(kind, self._pointer_now()):
            self._show_progress()

    def _pointer_now(self) -> Pointer:
        """Return where the pointer is in the plane as it is shown now; in the middle if it is elsewhere."""
        shown = self.pixel_map
        pixel = self._pointer.pixel if self._pointer is not None else (shown.width / 2, shown.height / 2)
        return Pointer(shown.plane(*pixel), pixel, scale=shown.sx)

    def pressed(self, pointer: Pointer) -> None:
        self._pointer = pointer
        self._tool.grid = self.grid_spacing
        self._active_tool.press(self._with_hit(pointer))
        self._show_progress()

    def moved(self, pointer: Pointer) -> None:
        self._pointer = pointer
        self._tool.grid = self.grid_spacing
        self._active_tool.move(pointer)
        self._show_progress()
        self.pointed_at.emit(pointer.position)

    def released(self, pointer: Pointer) -> None:
        self._active_tool.release(pointer)
        self.hovered_at(pointer)

    def hovered_at(self, pointer: Pointer) -> None:
        if self._tool.is_modal:
            self.moved(pointer)
            return
        self._pointer = pointer
        self._tool.grid = self.grid_spacing
        hint = self._active_tool.hover(self._with_hit(pointer))
        self._show_hint(hint)
        self._show_overlay()
        self.pointed_at.emit(pointer.position)

    def _show_progress(self) -> None:
        self._show_overlay()
        self.progress_changed.emit(self._tool.progress())

    def left(self) -> None:
        if not self._active_tool.is_pressed:
            self._pointer = None
            self._active_tool.hover(Pointer((np.inf, np.inf), (np.inf, np.inf)))
            self._show_overlay()
            self.hint_changed.emit("")
            self.pointed_at.emit(None)

    def _with_hit(self, pointer: Pointer) -> Pointer:
        if self._image_tool is not None:
            return replace(pointer, hit=self._image_layer.hit(pointer.pixel, self.pixel_map))
        if self._view is None:
            return pointer
        shown, layer = self.pixel_map, self._point_layer
        polyline = self._curve_layer.polyline(shown)
        hit = hit_test(pointer.pixel, shown, self._view, polyline, layer.selection, layer.handles)
        if hit is None and self._tool.kind is ToolKind.SELECT:
            hit = self._other_curves.hit(pointer.pixel, shown)
        return replace(pointer, hit=hit)

    def _show_hint(self, hint: Hint) -> None:
        self._set_cursor(hint)
        self.hint_changed.emit(hint.text)

    def _set_cursor(self, hint: Hint) -> None:
        if self._space_down or self._pan_from is not None:
            return
        kind = ToolKind.SELECT if self._image_tool is not None else self._tool.kind
        self.viewport().setCursor(cursor_of(hint, kind, self._theme))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        # A right click ends a transform; it must not open a menu as well.
        is_right = event.button() == Qt.MouseButton.RightButton
        self._menu_refused = is_right and self._tool.is_modal and self.cancel_gesture()
        if not self._menu_refused:
            super().mousePressEvent(event)

    def event(self, event: QEvent) -> bool:
        # While a transform is in flight, digits and letters are its own and no shortcuts.
        is_override = event.type() == QEvent.Type.ShortcutOverride and self._tool.is_modal
        if is_override and isinstance(event, QKeyEvent) and transform_key(event) is not None:
            event.accept()
            return True
        return bool(super().event(event))

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for a menu: for what lies under the pointer; by the Menu key, for the selected point."""
        event.accept()
        refused, self._menu_refused = self._menu_refused, False
        if refused or self._active_tool.is_pressed:
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
        is_escape = event.key() == Qt.Key.Key_Escape
        if (is_escape and self._escape()) or self._type_into_transform(event) or self._nudge(event):
            event.accept()
            return
        super().keyPressEvent(event)

    def _escape(self) -> bool:
        return self.cancel_gesture() or self.put_away()

    def _type_into_transform(self, event: QKeyEvent) -> bool:
        """Give a transform in flight the key; all others wait until it has ended."""
        if not self._tool.is_modal:
            return False
        key = transform_key(event)
        if key is not None and self._tool.transform_key(key):
            self._show_progress()
            if not self._tool.is_modal:
                self.hovered_at(self._pointer_now())
        return key is not None

    def _nudge(self, event: QKeyEvent) -> bool:
        """Move the selected points by a pixel or a step of the grid: with Shift ten, with Ctrl a tenth."""
        direction = ARROWS.get(Qt.Key(event.key()))
        if direction is None or self._active_tool.is_pressed:
            return False
        held = event.modifiers()
        factor = 10.0 if held & Qt.KeyboardModifier.ShiftModifier else 1.0
        if held & Qt.KeyboardModifier.ControlModifier:
            factor *= 0.1
        pixel = 1.0 / self.pixel_map.sx
        if self._image_tool is not None:
            self._image_tool.nudge((direction[0] * factor * pixel, direction[1] * factor * pixel))
            return True
        self._tool.grid = self.grid_spacing
        self._tool.nudge(direction, pixel, factor)
        return True

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Let Tab walk the points; past the last one it leaves the canvas, as Tab does everywhere."""
        if self._tool.is_pressed:
            return True
        if not self._tool.walk(1 if forward else -1):
            return bool(super().focusNextPrevChild(forward))
        self._reveal_selected()
        return True

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

    def focusOutEvent(self, event: QFocusEvent) -> None:
        # A transform that keys drive ends with the keys; a menu or another window only borrows them.
        borrowed = (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason)
        if self._tool.is_modal and event.reason() not in borrowed:
            self.cancel_gesture()
        super().focusOutEvent(event)

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
