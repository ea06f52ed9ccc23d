"""A plot with tools: mouse and keys go to the tool in use, and its status and hints are signalled."""

from __future__ import annotations

from string import ascii_lowercase

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QCursor, QKeyEvent
from PySide6.QtWidgets import QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..tasks.task import DelayedCall, SingleTask
from ..tools.pointer import Cursor, Hint, Hit, Pointer
from ..tools.toolbox import Toolbox
from .plot_widget import PlotWidget

_ARROWS = {Qt.Key[f"Key_{name.capitalize()}"]: name for name in ("left", "right", "up", "down")}
"""Names of the arrow keys, with any modifiers."""

_NAMES = {
    **{Qt.Key(Qt.Key.Key_0 + digit): str(digit) for digit in range(10)},
    Qt.Key.Key_Period: ".",
    Qt.Key.Key_Comma: ".",
    Qt.Key.Key_Minus: "-",
    Qt.Key.Key_Plus: "+",
    Qt.Key.Key_Asterisk: "*",
    Qt.Key.Key_Slash: "/",
    Qt.Key.Key_ParenLeft: "(",
    Qt.Key.Key_ParenRight: ")",
    Qt.Key.Key_Backspace: "backspace",
    Qt.Key.Key_Delete: "delete",
    Qt.Key.Key_Tab: "tab",
    Qt.Key.Key_Backtab: "tab",
    Qt.Key.Key_Semicolon: "tab",
    Qt.Key.Key_Return: "enter",
    Qt.Key.Key_Enter: "enter",
    **{Qt.Key(ord(letter.upper())): letter for letter in ascii_lowercase},
}
"""Names of the keys that are passed to tools."""

_WITH_SHIFT = {
    Qt.Key.Key_Backtab,
    Qt.Key.Key_Tab,
    Qt.Key.Key_Return,
    Qt.Key.Key_Enter,
    *(key for key, name in _NAMES.items() if name in "+*/()" or key == Qt.Key.Key_Semicolon),
}
"""Keys that mean the same with Shift: some keyboards need it for these characters."""


def key_name(event: QKeyEvent) -> str | None:
    """Return the name of a key for tools, with Shift a capital letter; None for keys that tools never get."""
    key, modifiers = Qt.Key(event.key()), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    if key in _ARROWS:
        return _ARROWS[key]
    if key in _WITH_SHIFT:
        modifiers &= ~Qt.KeyboardModifier.ShiftModifier
    if modifiers == Qt.KeyboardModifier.ShiftModifier and Qt.Key.Key_A <= key <= Qt.Key.Key_Z:
        return chr(key)
    return _NAMES.get(key) if not modifiers else None


def cursor_of(cursor: Cursor, theme: Theme) -> QCursor:
    """Return the cursor in Qt's terms."""
    if cursor.value in Qt.CursorShape.__members__:
        return QCursor(Qt.CursorShape[cursor.value])
    return QCursor(icon(cursor.value, theme).pixmap(20, 20))


MOVING_KEYS = frozenset({*_ARROWS.values(), "next", "previous"})
"""Keys that move or select points: panels show the change, so no hover is needed."""

_STATUS_MS = 33
"""Milliseconds between two status texts of a gesture: nobody reads faster."""


class ToolPlot(PlotWidget):
    """Plot whose mouse and keys are events of a tool.

    Presses, moves and releases go to `tools` at once; marks are drawn with the curve in the next paint.
    The status text and the coordinates follow after that paint, at most every 33 ms: this keeps drags smooth.

    Attributes
    ----------
    tools
        The tools of this plot.
    jobs
        Background work of the tools.

    Signals
    -------
    hint_changed
        A sentence on the effect of a press here.
    progress_changed
        The status of the gesture in flight, a sentence; empty when it has ended.
    gesture_began, gesture_ended
        A press has begun a gesture; no gesture is in flight any more.
    background_changed
        Background work of a tool has begun or ended.
    pointed_at
        The position under the pointer on a canvas, t on a plot over t; None when it has left.
    """

    hint_changed = Signal(str)
    progress_changed = Signal(str)
    gesture_began = Signal()
    gesture_ended = Signal()
    background_changed = Signal()
    pointed_at = Signal(object)
    _hover_wanted = Signal()

    def __init__(self, tools: Toolbox, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.tools = tools
        self.jobs = SingleTask(self)
        self.jobs.progressed.connect(self._show_share)
        self.jobs.ended.connect(self._show_progress)
        tools.background.jobs, tools.background.changed = self.jobs, self._show_background
        # Queued: the gesture may end within a change of the document.
        self.gesture_ended.connect(tools.background.hand_over, Qt.ConnectionType.QueuedConnection)
        # Whether a status text is due: the first one after the paint, the others when the timer runs out.
        self._is_status_due = False
        self._status_timer = DelayedCall(self, 0, self.show_status)
        # Queued, but before the paint: one paint shows the change and the new hover.
        self._is_hover_due = False
        self._hover_wanted.connect(self._hover_if_due, Qt.ConnectionType.QueuedConnection)

    # Overridden by subclasses

    def _hit_at(self, pixel: QPointF) -> Hit | None:
        """Return the hit at a pixel of the viewport."""
        return self.tools.canvas.hit(self.pointer_at(pixel), self.tools.tool.hits)

    def position_of(self, pointer: Pointer) -> object:
        """Return the value of `pointed_at` for a pointer: t, or None in a gesture, which says its own."""
        return None if self.is_dragging else pointer.position[0]

    def show_marks(self) -> None:
        """Draw the marks of the tool over the plot."""

    def _show_background(self) -> None:
        self.show_marks()
        self.background_changed.emit()

    # Gestures

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self.tools.is_pressed

    def cancel_gesture(self) -> bool:
        """Cancel the gesture in flight; return whether there was one."""
        cancelled = self.tools.cancel()
        self._end_gesture()
        return cancelled

    def abandon_gesture(self) -> None:
        """Forget the gesture in flight, if any: the session has dropped it."""
        is_any = self.is_dragging
        self.tools.abandon()
        if is_any:
            self._end_gesture()

    def dismiss(self) -> bool:
        """Remove marks that the tool has left on the plot; return whether there were any."""
        has_removed = self.tools.dismiss()
        self.show_marks()
        return has_removed

    def _pressed(self, pointer: Pointer) -> None:
        self.gesture_began.emit()
        self.tools.press(pointer)
        self._show_progress()

    def _moved(self, pointer: Pointer) -> None:
        self.tools.move(pointer)
        self.show_marks()
        # The curve is painted first; the status text follows, at most every 33 ms.
        self._is_status_due = True
        if not self._status_timer.isActive():
            self._status_timer.start(0)

    def _released(self, pointer: Pointer) -> None:
        self.tools.release(pointer)
        if not self.tools.is_pressed:
            self._end_gesture()
        x, y = pointer.pixel
        if 0 <= x <= self.pixel_map.width and 0 <= y <= self.pixel_map.height:
            self._hovered_at(pointer)
        else:
            self._left()
        self._is_hover_due = False

    def _hovered_at(self, pointer: Pointer) -> None:
        if self.tools.is_buttonless:
            self._moved(pointer)
            return
        hint = self.tools.hover(pointer)
        self._show_cursor(hint)
        self.hint_changed.emit(hint.text)
        self.show_marks()
        self.pointed_at.emit(self.position_of(pointer))

    def hover_again(self) -> None:
        """Hover again with a resting pointer after the view or the document has changed."""
        if self._pointer is not None and not self.is_dragging and not self._panning.is_active:
            self._hovered_at(self._pointer_now())

    def hover_soon(self) -> None:
        """Hover again after all signals of a change; a release hovers by itself."""
        if not self._is_hover_due:
            self._is_hover_due = True
            self._hover_wanted.emit()

    def _hover_if_due(self) -> None:
        if self._is_hover_due:
            self._is_hover_due = False
            self.hover_again()

    def _left(self) -> None:
        if not self.is_dragging:
            self._pointer = None
            self.tools.leave()
            self.show_marks()
            self.hint_changed.emit("")
            self.pointed_at.emit(None)

    def _pointer_now(self) -> Pointer:
        """Return the pointer in the present view; in the middle if the mouse is elsewhere."""
        pixel_map = self.pixel_map
        pixel = (
            self._pointer.pixel if self._pointer is not None else (pixel_map.width / 2, pixel_map.height / 2)
        )
        return Pointer(pixel_map.plane(*pixel), pixel, scale=pixel_map.sx)

    def _end_gesture(self) -> None:
        self._status_timer.stop()
        self._is_status_due = False
        self.show_marks()
        self.progress_changed.emit("")
        self.gesture_ended.emit()

    def _show_progress(self) -> None:
        self.show_marks()
        self.progress_changed.emit(self.tools.status())

    def _show_share(self, share: float, word: str) -> None:
        """Show the progress of background work that takes long enough to be read."""
        if self.jobs.is_long and not self.is_dragging:
            self.progress_changed.emit(f"{word}: {share:.0%} · Escape cancels")

    def show_status(self) -> None:
        """Show the status of the gesture and the position of the pointer, if it has moved since."""
        if not self._is_status_due:
            return
        self._is_status_due = False
        self._status_timer.start(_STATUS_MS)
        self.progress_changed.emit(self.tools.status())
        if self._pointer is not None:
            self.pointed_at.emit(self.position_of(self._pointer))

    def _show_cursor(self, hint: Hint) -> None:
        if not self._panning.owns_cursor:
            self.viewport().setCursor(cursor_of(hint.cursor_over(self.tools.tool.cursor), self.layers.theme))

    # Keys

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            # While an amount is typed, digits and letters belong to it and are no shortcuts.
            key = key_name(event)
            if key is not None and self.tools.wants_key(key):
                event.accept()
                return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        is_escape, key = event.key() == Qt.Key.Key_Escape, key_name(event)
        if (is_escape and (self.cancel_gesture() or self.dismiss())) or (
            key is not None and self.give_key(key, event)
        ):
            event.accept()
        else:
            super().keyPressEvent(event)

    def give_key(self, key: str, event: QKeyEvent | None = None) -> bool:
        """Give the tool a key by name; return whether the tool handles it, even without an effect."""
        is_wanted, was_dragging = self.tools.wants_key(key), self.is_dragging
        had_effect = self.tools.key(key, self._pointer_of_key(event))
        if had_effect and was_dragging:
            self._show_progress()
        if had_effect and not self.is_dragging and key not in MOVING_KEYS:
            self._hovered_at(self._pointer_now())
        return had_effect or is_wanted

    def _pointer_of_key(self, event: QKeyEvent | None) -> Pointer:
        """Return the pointer with the modifier keys of a key event."""
        modifiers = event.modifiers() if event is not None else Qt.KeyboardModifier.NoModifier
        shift, ctrl = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
        return replace(self._pointer_now(), shift=bool(modifiers & shift), ctrl=bool(modifiers & ctrl))

    def focusNextPrevChild(self, forward: bool) -> bool:
        if not self.hasFocus():
            # Called by a field on top of the plot: at Tab, or when the field with the focus is hidden.
            return bool(super().focusNextPrevChild(forward))
        # Tab belongs to a transform in flight, and leaves the plot during no gesture.
        self.give_key("tab")
        if self.is_dragging or self.give_key("next" if forward else "previous"):
            return True
        return bool(super().focusNextPrevChild(forward))
