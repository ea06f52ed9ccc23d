"""The basis panel: turns mouse and keys into gestures on the t-rail and the functions above it."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QFocusEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from app.document.edits import EditError
from app.panels.basis_hits import hit_test
from app.panels.basis_plot import BasisPlot
from app.panels.tick_edit import TickEdit
from app.tools.pointer import Hit, Part, Pointer
from app.tools.rail import RailTool


class BasisPanel(BasisPlot):
    """The basis functions of the active curve, with the gestures on them.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    progress_changed
        How far the gesture in flight has come (a sentence); empty when it has ended.
    gesture_began
        A press begins a gesture.
    pointed_at
        The parameter t under the pointer, or None when it has left.
    drag_changed
        Ticks are being dragged, or no longer.
    menu_requested
        The menu of the t-rail is wanted at a place of the screen.
    """

    hint_changed = Signal(str)
    progress_changed = Signal(str)
    gesture_began = Signal()
    pointed_at = Signal(object)
    drag_changed = Signal(bool)
    menu_requested = Signal(QPoint)

    def __init__(self, tool: RailTool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tool = tool
        self._ripple_down = False
        self._pointer: Pointer | None = None
        self.tick_edit = TickEdit(self)
        self.tick_edit.typed.connect(self._set_tick)

    # Gestures

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self._tool.is_pressed

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        was_pressed = self._tool.cancel()
        self._end_gesture()
        return was_pressed

    def forget_gesture(self) -> None:
        """Drop the gesture in flight, and what is being typed; the document is another one."""
        self._tool.forget()
        self.tick_edit.hide()
        self._end_gesture()

    def _end_gesture(self) -> None:
        self._let_go_of_domain()
        self.drag_changed.emit(False)
        self.progress_changed.emit("")

    def pressed(self, pointer: Pointer) -> None:
        self.gesture_began.emit()
        self._hold_domain()
        hit = self._hit(pointer)
        if hit is not None and hit.part is Part.TICK:
            self.drag_changed.emit(True)
        self._tool.press(replace(pointer, hit=hit), self._rail.scrub)

    def moved(self, pointer: Pointer) -> None:
        pointer = replace(pointer, ripple=self._ripple_down)
        self._tool.move(pointer)
        self.progress_changed.emit(self._tool.progress(pointer))
        self.pointed_at.emit(pointer.position[0])

    def released(self, pointer: Pointer) -> None:
        self._tool.release(replace(pointer, ripple=self._ripple_down))
        self._end_gesture()
        x, y = pointer.pixel
        if 0 <= x <= self.pixel_map.width and 0 <= y <= self.pixel_map.height:
            self.hovered_at(pointer)
        else:
            self.left()

    def hovered_at(self, pointer: Pointer) -> None:
        self._pointer = pointer
        hint = self._tool.hover(replace(pointer, hit=self._hit(pointer)))
        shape = Qt.CursorShape.SizeHorCursor if hint.grab else Qt.CursorShape.ArrowCursor
        self.viewport().setCursor(shape)
        self.hint_changed.emit(hint.text)
        self.pointed_at.emit(pointer.position[0])

    def hover_again(self) -> None:
        """Tell anew what lies under a pointer that rests while the functions change."""
        if self._pointer is not None and not self.is_dragging and not self._panning.is_active:
            pixel = self._pointer.pixel
            self.hovered_at(Pointer(self.pixel_map.plane(*pixel), pixel, scale=self.pixel_map.sx))

    def left(self) -> None:
        if not self._tool.is_pressed:
            self._pointer = None
            self._tool.hover(Pointer((np.inf, np.inf), (np.inf, np.inf)))
            self.hint_changed.emit("")
            self.pointed_at.emit(None)

    def _hit(self, pointer: Pointer) -> Hit | None:
        if self._basis is None:
            return None
        return hit_test(pointer, self.pixel_map, self._basis, self._rail, self._functions.kinds)

    # Typing at a tick, its menu, and keys

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        hit = self._hit(self.pointer_at(event)) if event.button() == Qt.MouseButton.LeftButton else None
        if hit is not None and hit.part is Part.TICK and not event.modifiers():
            self._edit_knot(hit.knot)
            event.accept()
        else:
            super().mouseDoubleClickEvent(event)

    def edit_tick(self, node: int) -> None:
        """Let the person type the parameter of a node at its tick."""
        if self._basis is not None:
            self._edit_knot(self._basis.owners.index(node))

    def _edit_knot(self, knot: int) -> None:
        assert self._basis is not None
        self._tool.cancel()
        t = float(self._basis.curve.parameters[knot])
        place = self.rail_pixel(t) - QPointF(0, 8)
        self.tick_edit.open(knot, t, QPointF(self.viewport().mapTo(self, place.toPoint())))

    def _set_tick(self, knot: int, t: float) -> None:
        if self._basis is None or knot >= self._basis.count:
            self.tick_edit.close_and_return()
            return
        try:
            self._tool.set_value(knot, t)
        except EditError as reason:
            self.tick_edit.refuse(reason)
            return
        self.tick_edit.close_and_return()

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Ask for the menu of the t-rail."""
        self._select_for_menu(event)
        self.menu_requested.emit(event.globalPos())

    def _select_for_menu(self, event: QContextMenuEvent) -> None:
        """Let a right click on a tick that is not selected select it: the menu is about it."""
        if event.reason() != QContextMenuEvent.Reason.Mouse:
            return
        hit = self._hit(self.pointer_at(QPointF(event.pos())))
        if hit is not None and hit.part is Part.TICK:
            self._tool.choose(hit.index)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.modifiers():
            # The repeats count, too: the press may have gone to another widget, before the mouse came here.
            self._set_ripple(down=True)
            event.accept()
        elif (event.key() == Qt.Key.Key_Escape and self.cancel_gesture()) or self._nudge(event):
            event.accept()
        else:
            super().keyPressEvent(event)

    def _nudge(self, event: QKeyEvent) -> bool:
        """Move the selected ticks by a pixel: with Shift ten, with Ctrl a tenth."""
        direction = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()))
        if direction is None:
            return False
        held = event.modifiers()
        step = direction / self.pixel_map.sx
        if held & Qt.KeyboardModifier.ShiftModifier:
            step *= 10
        if held & Qt.KeyboardModifier.ControlModifier:
            step /= 10
        return self._tool.nudge(step)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_E and not event.isAutoRepeat():
            self._set_ripple(down=False)
        super().keyReleaseEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self._set_ripple(down=False)
        super().focusOutEvent(event)

    def _set_ripple(self, *, down: bool) -> None:
        """Note whether E is down, and show at once what it changes of a drag in flight."""
        was_down, self._ripple_down = self._ripple_down, down
        if down != was_down and self.is_dragging:
            self._move_again()
