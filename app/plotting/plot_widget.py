"""A plot that hears mouse and keys: it pans and zooms, and hands everything else on as pointers.

pyqtgraph's own mouse layer is bypassed (it throttles moves and tests every item).
"""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import (
    QContextMenuEvent,
    QEnterEvent,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from app.plotting.layered_plot import LayeredPlot
from app.plotting.panning import Panning
from app.plotting.scrolling import Scrolling
from app.tools.pointer import Pointer

_MODIFIERS = {Qt.Key.Key_Shift: "shift", Qt.Key.Key_Control: "ctrl", Qt.Key.Key_Alt: "alt"}
"""Keys that change what a gesture does, and which part of a pointer tells."""

_BY_KEYS = (
    Qt.FocusReason.TabFocusReason,
    Qt.FocusReason.BacktabFocusReason,
    Qt.FocusReason.ShortcutFocusReason,
)

_FLAGS = {
    "shift": Qt.KeyboardModifier.ShiftModifier,
    "ctrl": Qt.KeyboardModifier.ControlModifier,
    "alt": Qt.KeyboardModifier.AltModifier,
}


class PlotWidget(LayeredPlot):
    """A plot that pans and zooms by mouse, wheel and trackpad, on which a subclass builds its gestures."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panning, self._scrolling = Panning(self), Scrolling(self)
        self._menu_refused = False
        # Where the mouse was heard of last, None once it has left; and whether its left button was down.
        self._hand: Pointer | None = None
        self._is_held = False
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    # A subclass fills in these.

    def pressed(self, pointer: Pointer) -> None:
        """Handle a press of the left button."""

    def moved(self, pointer: Pointer) -> None:
        """Handle a move with the left button down."""

    def released(self, pointer: Pointer) -> None:
        """Handle the release of the left button."""

    def hovered_at(self, pointer: Pointer) -> None:
        """Handle a move with no button down."""

    def left(self) -> None:
        """Handle the pointer leaving the widget."""

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return False

    def cancel_gesture(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return False

    def menu_wanted(self, event: QContextMenuEvent) -> None:
        """Handle the wish for a menu, while no gesture is in flight."""

    # Events

    def pointer_at(self, event: QMouseEvent | QPointF) -> Pointer:
        """Return the record of a mouse event (or of a bare viewport position)."""
        position = event if isinstance(event, QPointF) else event.position()
        held = Qt.KeyboardModifier.NoModifier if isinstance(event, QPointF) else event.modifiers()
        pixel = self.area_pixel(position)
        return Pointer(
            position=self.pixel_map.plane(*pixel),
            pixel=pixel,
            shift=bool(held & Qt.KeyboardModifier.ShiftModifier),
            ctrl=bool(held & Qt.KeyboardModifier.ControlModifier),
            alt=bool(held & Qt.KeyboardModifier.AltModifier),
            scale=self.pixel_map.sx,
        )

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.RightButton:
            # It takes a gesture back, a drag as well as a transform; it must not open a menu as well.
            self._menu_refused = self._panning.is_active or (self.is_dragging and self.cancel_gesture())
            if self._menu_refused:
                event.accept()
                return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        if self._is_held and event.button() == Qt.MouseButton.LeftButton:
            self._let_go()  # the release was never heard of
        if not self._panning.press(event) and event.button() == Qt.MouseButton.LeftButton:
            self._hand, self._is_held = self.pointer_at(event), True
            self.pressed(self._hand)
        event.accept()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.accept()
        refused, self._menu_refused = self._menu_refused, False
        if not refused and not self.is_dragging:
            self.menu_wanted(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        # The second press of a double click is a press like any other: quick clicks must all count.
        self.mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if not self._panning.move(event):
            self._hand = self.pointer_at(event)
            if event.buttons() & Qt.MouseButton.LeftButton:
                self.moved(self._hand)
            elif not event.buttons():
                if self._is_held:
                    # The release went elsewhere: to a list that a key has opened, for instance.
                    self._let_go()
                self.hovered_at(self._hand)
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        # A drag with the left button ends with it, also while the middle one pans.
        if not self._panning.release(event) and event.button() == Qt.MouseButton.LeftButton:
            self._hand, self._is_held = self.pointer_at(event), False
            self.released(self._hand)
        event.accept()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowBlocked:
            # A dialog takes the mouse, and the release with it.
            self._let_go()
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and self.is_dragging
            and Qt.Key(event.key()) in _MODIFIERS
        ):
            # Else Alt alone, let go, would go to the menu bar and take the keys along.
            event.accept()
            return True
        if isinstance(event, QNativeGestureEvent) and self._scrolling.pinch(event):
            event.accept()
            return True
        return bool(super().event(event))

    def _let_go(self) -> None:
        """Drop what the mouse is doing here, panning too."""
        self._is_held = False
        self._panning.forget_key()
        self._panning.stop()
        if self.is_dragging:
            self.cancel_gesture()

    def _hear_modifier(self, event: QKeyEvent, *, down: bool) -> None:
        name = _MODIFIERS.get(Qt.Key(event.key()))
        if name is None or event.isAutoRepeat() or self._hand is None:
            return
        held = event.modifiers()
        now = {each: bool(held & _FLAGS[each]) for each in _FLAGS} | {name: down}
        self._hand = replace(self._hand, **now)
        self._move_again()

    def _move_again(self) -> None:
        """Go on as if the pointer had moved to where it is: another key is held, or the view has moved."""
        if self._hand is None or self._panning.is_active:
            return
        shown, pixel = self.pixel_map, self._hand.pixel
        self._hand = replace(self._hand, position=shown.plane(*pixel), scale=shown.sx)
        if self.is_dragging:
            self.moved(self._hand)
        elif not self._is_held:
            self.hovered_at(self._hand)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._scrolling.wheel(event)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=True)
        self._hear_modifier(event, down=True)
        event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._panning.hear_key(event, down=False)
        self._hear_modifier(event, down=False)
        event.ignore()

    def enterEvent(self, event: QEnterEvent) -> None:
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        if not self.is_dragging:
            self._hand = None
        self.left()
        event.accept()

    def focusInEvent(self, event: QFocusEvent) -> None:
        # Whoever came by mouse sees the pointer.
        self.show_focus(event.reason() in _BY_KEYS)
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        self.show_focus(False)
        self._panning.forget_key()
        super().focusOutEvent(event)
