"""The canvas: turns mouse and keys into gestures on what it shows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QWidget

from app.canvas.canvas_view import CanvasView
from app.canvas.hit_test import hit_test
from app.canvas.keys import ARROWS, cursor_of, transform_key
from app.canvas.overlay_layer import OverlayLayer
from app.canvas.pen_layer import PenLayer
from app.theme import LIGHT
from app.tools.image_tool import ImageTool
from app.tools.overlay import Overlay
from app.tools.pointer import Hint, Hit, Pointer
from app.tools.snapping import Snapping
from app.tools.tools import CanvasTool, ToolKind
from app.tools.transform import TransformKind
from app.view_model.curve_view import CurveView


class Canvas(CanvasView):
    """The drawing area, with its gestures.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    progress_changed
        How far the gesture in flight has come (a sentence); empty when it has ended.
    gesture_began
        A press, or a key, begins a gesture.
    pointed_at
        The position of the pointer in the plane, or None when it has left.
    menu_requested
        A menu is wanted: for what lies there (a Hit or None), at a place of the screen.
    """

    hint_changed = Signal(str)
    progress_changed = Signal(str)
    gesture_began = Signal()
    pointed_at = Signal(object)
    menu_requested = Signal(object, QPoint)

    def __init__(self, tool: CanvasTool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tool = tool
        self._image_tool: ImageTool | None = None
        self._overlay_layer = self.dress(OverlayLayer(self, LIGHT))
        self._overlay_layer.around = self._surroundings_of
        self._pen_layer = self.dress(PenLayer(self, LIGHT))
        self._pointer: Pointer | None = None
        self._words_due = QTimer(self, singleShot=True, interval=0)
        self._words_due.timeout.connect(self._tell)
        self.map_changed.connect(self.hover_again)

    # What is shown

    def render_view(self, view: CurveView) -> None:
        """Show `view`; a ghost of the old curve stays for a moment when a rule has changed."""
        super().render_view(view)
        self._show_overlay()

    def set_selection(self, selection: frozenset[int]) -> None:
        """Show which points are selected."""
        super().set_selection(selection)
        self._show_overlay()

    def render_others(
        self, views: Sequence[CurveView], active: int, chosen: frozenset[int] = frozenset()
    ) -> None:
        """Show the other curves, and the box around those that are chosen."""
        super().render_others(views, active, chosen)
        self._show_overlay()

    def set_snapping(self, snapping: Snapping) -> None:
        """Choose whether points snap, and to what."""
        self._tool.snapping = snapping

    def set_unit(self, name: str) -> None:
        """Name the unit of length at the axes and in measures; empty for none."""
        super().set_unit(name)
        self._tool.unit = name

    def set_box_visible(self, visible: bool) -> None:
        """Show or hide the box with grips around two or more selected points."""
        self._tool.shows_box = visible
        self._show_overlay()

    @property
    def overlay(self) -> Overlay:
        """What the gestures show over the drawing."""
        return self._overlay_layer.overlay

    @property
    def readout_rect(self) -> QRectF:
        """Where the last readout of a gesture stood, in pixels of the plot area."""
        return self._overlay_layer.plate

    @property
    def snap_label_rect(self) -> QRectF:
        """Where the words about the last snap stood, in pixels of the plot area."""
        return self._overlay_layer.label

    def _show_overlay(self) -> None:
        overlay = self._tool.overlay()
        self._overlay_layer.render(overlay)
        self._pen_layer.render(overlay.ahead, overlay.spot)

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

    # Gestures

    def set_tool(self, kind: ToolKind) -> None:
        """Choose what a press means."""
        self.cancel_gesture()
        self._tool.put_away()
        self._tool.kind = kind
        self._point_layer.is_adding = kind is ToolKind.ADD
        self._point_layer.refresh()
        self._set_cursor(Hint())
        self._show_overlay()

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self._active_tool.is_pressed

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        cancelled = self._active_tool.cancel()
        self._show_progress()
        return cancelled

    def put_away(self) -> bool:
        """Put away what was measured; return whether there was something."""
        found = self._tool.put_away()
        self._show_overlay()
        return found

    def forget_gesture(self) -> None:
        """Drop the gesture in flight; the document is another one."""
        self._active_tool.forget()
        self.progress_changed.emit("")

    def begin_transform(self, kind: TransformKind) -> None:
        """Let the selected points, or else all, follow the pointer until Enter, a click or Escape."""
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self._tool.grid = self.grid_spacing
        pointer = self._pointer_now()
        if self._tool.begin_transform(kind, pointer):
            self._hand = self._hand or pointer
            self._show_progress()

    def _pointer_now(self) -> Pointer:
        """Return where the pointer is in the plane as it is shown now; in the middle if it is elsewhere."""
        shown = self.pixel_map
        pixel = self._pointer.pixel if self._pointer is not None else (shown.width / 2, shown.height / 2)
        return Pointer(shown.plane(*pixel), pixel, scale=shown.sx)

    def pressed(self, pointer: Pointer) -> None:
        self.gesture_began.emit()
        self._pointer = pointer
        self._tool.grid = self.grid_spacing
        pointer = self._with_hit(pointer)
        if self._image_tool is None and self._tool.enter(pointer):
            pointer = self._with_hit(pointer)
        self._active_tool.press(pointer)
        self._show_progress()

    def moved(self, pointer: Pointer) -> None:
        self._pointer = pointer
        self._tool.grid = self.grid_spacing
        self._active_tool.move(pointer)
        self._show_overlay()
        # The eye is on the curve: words come once that has been painted.
        self._words_due.start()

    def _tell(self) -> None:
        """Say how far the gesture has come, and where the pointer is."""
        self.progress_changed.emit(self._tool.progress())
        if self._pointer is not None:
            # Of a point that snaps or keeps to an axis, where it is and not the hand.
            self.pointed_at.emit(self._tool.place() or self._pointer.position)

    def released(self, pointer: Pointer) -> None:
        self._words_due.stop()
        self._active_tool.release(pointer)
        self.progress_changed.emit("")
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

    def hover_again(self) -> None:
        """Tell anew what lies under a pointer that rests while the view moves."""
        if self._pointer is not None and not self.is_dragging and not self._panning.is_active:
            self.hovered_at(self._pointer_now())

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
            hit = self._chosen_curves.hit(pointer.pixel, shown) or self._other_curves.hit(
                pointer.pixel, shown
            )
        return replace(pointer, hit=hit)

    @property
    def drawing_note(self) -> str:
        """What the canvas says of a line that is off by more than a pixel; empty where it is not."""
        return self._curve_layer.said

    def _show_hint(self, hint: Hint) -> None:
        self._set_cursor(hint)
        self.hint_changed.emit(hint.text)

    def _set_cursor(self, hint: Hint) -> None:
        if self._panning.owns_cursor:
            return
        kind = ToolKind.SELECT if self._image_tool is not None else self._tool.kind
        self.viewport().setCursor(cursor_of(hint, kind, self._theme))

    def event(self, event: QEvent) -> bool:
        # While a transform is in flight, digits and letters are its own and no shortcuts.
        is_override = event.type() == QEvent.Type.ShortcutOverride and self._tool.is_modal
        if is_override and isinstance(event, QKeyEvent) and transform_key(event) is not None:
            event.accept()
            return True
        return bool(super().event(event))

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Ask for a menu: for what lies under the pointer; by the Menu key, for the selected point."""
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        place = self._selected_place() if by_key else QPointF(event.pos())
        hit = self._with_hit(self.pointer_at(place)).hit if place is not None else None
        corner = (place or self.centre()).toPoint()
        self.menu_requested.emit(hit, self.viewport().mapToGlobal(corner))

    def hit_at(self, place: QPoint) -> Hit | None:
        """Return what lies at a place of the screen."""
        return self._with_hit(self.pointer_at(QPointF(self.viewport().mapFromGlobal(place)))).hit

    def keyPressEvent(self, event: QKeyEvent) -> None:
        is_escape = event.key() == Qt.Key.Key_Escape
        if (is_escape and self._escape()) or self._type_into_transform(event) or self._takes(event):
            event.accept()
            return
        super().keyPressEvent(event)

    def _escape(self) -> bool:
        return self.cancel_gesture() or self.put_away()

    def _type_into_transform(self, event: QKeyEvent) -> bool:
        """Give a transform in flight the key; all others wait until it has ended."""
        key = transform_key(event) if self._tool.is_modal else None
        if key is not None:
            self._give_to_transform(key)
        return key is not None

    def _give_to_transform(self, key: str) -> None:
        if self._tool.transform_key(key):
            self._show_progress()
            if not self._tool.is_modal:
                self.hovered_at(self._pointer_now())

    def _takes(self, event: QKeyEvent) -> bool:
        return self._nudge(event) or self._finish_curve(event)

    def _finish_curve(self, event: QKeyEvent) -> bool:
        """Finish the curve that the pen draws: the next press begins another one."""
        is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        adds = self._tool.kind is ToolKind.ADD and self._image_tool is None
        if not (is_enter and adds and self._tool.pen.finish()):
            return False
        self.hover_again()
        return True

    def forget_finished(self) -> None:
        """Forget which curves the pen has finished; the document is another one."""
        self._tool.pen.forget_finished()

    def _nudge(self, event: QKeyEvent) -> bool:
        """Move the selected points by a pixel or a step of the grid: with Shift ten, with Ctrl a tenth."""
        direction = ARROWS.get(Qt.Key(event.key()))
        if direction is None or self._active_tool.is_pressed:
            return False
        held = event.modifiers()
        if held & Qt.KeyboardModifier.AltModifier:
            return False
        factor = 10.0 if held & Qt.KeyboardModifier.ShiftModifier else 1.0
        if held & Qt.KeyboardModifier.ControlModifier:
            factor *= 0.1
        pixel = self.pixel_size
        if self._image_tool is not None:
            self._image_tool.nudge((direction[0] * factor * pixel, direction[1] * factor * pixel))
            return True
        self._tool.grid = self.grid_spacing
        self._tool.nudge(direction, pixel, factor)
        self._reveal_selected()
        return True

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Let Tab walk the points; past the last one it leaves the canvas, as Tab does everywhere."""
        if self._tool.is_modal:
            self._give_to_transform("tab")
        if self._tool.is_pressed:
            return True
        if not self._tool.walk(1 if forward else -1):
            return bool(super().focusNextPrevChild(forward))
        self._reveal_selected()
        return True

    def focusOutEvent(self, event: QFocusEvent) -> None:
        # A transform that keys drive ends with the keys; a menu or another window only borrows them.
        borrowed = (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason)
        if self._tool.is_modal and event.reason() not in borrowed:
            self.cancel_gesture()
        super().focusOutEvent(event)
