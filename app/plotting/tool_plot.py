"""A plot with tools: what the mouse and keys do goes to the tool in use, and what it says is told."""

from __future__ import annotations

from string import ascii_lowercase

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QCursor, QKeyEvent
from PySide6.QtWidgets import QWidget

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..tasks.task import SingleTask
from ..tools.pointer import Cursor, Hint, Hit, Pointer
from ..tools.toolbox import Toolbox
from .plot_widget import PlotWidget

_ARROWS = {
    Qt.Key.Key_Left: "left",
    Qt.Key.Key_Right: "right",
    Qt.Key.Key_Up: "up",
    Qt.Key.Key_Down: "down",
}
"""The names of the arrow keys, whatever modifiers are held."""

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
"""Keys that tools hear of, and their names."""

_WITH_SHIFT = {
    Qt.Key.Key_Backtab,
    Qt.Key.Key_Tab,
    Qt.Key.Key_Return,
    Qt.Key.Key_Enter,
    *(key for key, name in _NAMES.items() if name in "+*/()" or key == Qt.Key.Key_Semicolon),
}
"""Keys that mean the same with Shift: some keyboards have the characters there, and a hand may hold it."""


def key_name(event: QKeyEvent) -> str | None:
    """Return what a tool calls a key, a letter with Shift a capital; None for one that it never hears of."""
    key, held = Qt.Key(event.key()), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    if key in _ARROWS:
        return _ARROWS[key]
    if key in _WITH_SHIFT:
        held &= ~Qt.KeyboardModifier.ShiftModifier
    if held == Qt.KeyboardModifier.ShiftModifier and Qt.Key.Key_A <= key <= Qt.Key.Key_Z:
        return chr(key)
    return _NAMES.get(key) if not held else None


def cursor_of(cursor: Cursor, theme: Theme) -> QCursor:
    """Return the shape of the pointer."""
    if cursor.value in Qt.CursorShape.__members__:
        return QCursor(Qt.CursorShape[cursor.value])
    return QCursor(icon(cursor.value, theme).pixmap(20, 20))


MOVING_KEYS = frozenset({*_ARROWS.values(), "next", "previous"})
"""Keys that move or select points: the panels that follow tell what has changed, no hover is needed."""

_WORDS_MS = 33
"""Milliseconds between two readouts of a gesture."""


class ToolPlot(PlotWidget):
    """Plot whose mouse and keys are events of a tool.

    Attributes
    ----------
    tools
        The tools of this plot.
    jobs
        What they do beside the window.

    Signals
    -------
    hint_changed
        What a press here would do (a sentence).
    progress_changed
        How far the gesture in flight has come (a sentence); empty when it has ended.
    gesture_began, gesture_ended
        A press begins a gesture; none is in flight any more.
    background_changed
        A tool has something more, or less, done beside the window.
    pointed_at
        The place under the pointer, or None when it has left: the position on a canvas, t over t.
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
        # Later: whoever has ended it may be within a change of the document.
        self.gesture_ended.connect(tools.background.hand_over, Qt.ConnectionType.QueuedConnection)
        # Words that wait; at first they come at once, then as the timer runs out.
        self._has_words = False
        self._words_due = QTimer(self, singleShot=True)
        self._words_due.timeout.connect(self.tell)
        # Later, but before Qt paints: one paint shows the change and what lies under the pointer now.
        self._is_hover_due = False
        self._hover_wanted.connect(self._hover_if_due, Qt.ConnectionType.QueuedConnection)

    # A subclass fills in these.

    def _hit_at(self, place: QPointF) -> Hit | None:
        """Return what lies at a place of the viewport."""
        return self.tools.canvas.hit(self.pointer_at(place), self.tools.tool.hits)

    def place_of(self, pointer: Pointer) -> object:
        """Return what is told of the place under the pointer: t."""
        return pointer.position[0]

    def show_marks(self) -> None:
        """Draw what the tool shows over the plot."""

    def _show_background(self) -> None:
        self.show_marks()
        self.background_changed.emit()

    # Gestures

    @property
    def is_dragging(self) -> bool:
        """Whether a gesture is in flight."""
        return self.tools.is_pressed

    def cancel_gesture(self) -> bool:
        """Take the gesture in flight back; return whether there was one."""
        cancelled = self.tools.cancel()
        self._end_gesture()
        return cancelled

    def abandon_gesture(self) -> None:
        """Drop the gesture in flight, if there is one; the document is another one."""
        is_any = self.is_dragging
        self.tools.abandon()
        if is_any:
            self._end_gesture()

    def dismiss(self) -> bool:
        """Remove what the tool has left on the plot; return whether there was something."""
        found = self.tools.dismiss()
        self.show_marks()
        return found

    def _pressed(self, pointer: Pointer) -> None:
        self.gesture_began.emit()
        self.tools.press(pointer)
        self._show_progress()

    def _moved(self, pointer: Pointer) -> None:
        self.tools.move(pointer)
        self.show_marks()
        # The eye is on the curve: words come once that has been painted, and no faster than they are read.
        self._has_words = True
        if not self._words_due.isActive():
            self._words_due.start(0)

    def _released(self, pointer: Pointer) -> None:
        self.tools.release(pointer)
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
        self.pointed_at.emit(self.place_of(pointer))

    def hover_again(self) -> None:
        """Tell anew what lies under a pointer that rests while the view moves, or the document."""
        if self._pointer is not None and not self.is_dragging and not self._panning.is_active:
            self._hovered_at(self._pointer_now())

    def hover_soon(self) -> None:
        """Do that once all has been told that has changed; a release does by itself."""
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
        """Return where the pointer is in the plane as it is shown now; in the middle if it is elsewhere."""
        shown = self.pixel_map
        pixel = self._pointer.pixel if self._pointer is not None else (shown.width / 2, shown.height / 2)
        return Pointer(shown.plane(*pixel), pixel, scale=shown.sx)

    def _end_gesture(self) -> None:
        self._words_due.stop()
        self._has_words = False
        self.show_marks()
        self.progress_changed.emit("")
        self.gesture_ended.emit()

    def _show_progress(self) -> None:
        self.show_marks()
        self.progress_changed.emit(self.tools.status())

    def _show_share(self, share: float, word: str) -> None:
        """Tell how far work beside the window has come, which takes long enough to be read of."""
        if self.jobs.is_long and not self.is_dragging:
            self.progress_changed.emit(f"{word}: {share:.0%} · Escape cancels")

    def tell(self) -> None:
        """Say how far the gesture has come, and where the pointer is, if it has moved since."""
        if not self._has_words:
            return
        self._has_words = False
        self._words_due.start(_WORDS_MS)
        self.progress_changed.emit(self.tools.status())
        if self._pointer is not None:
            self.pointed_at.emit(self.place_of(self._pointer))

    def _show_cursor(self, hint: Hint) -> None:
        if not self._panning.owns_cursor:
            self.viewport().setCursor(cursor_of(hint.cursor_over(self.tools.tool.cursor), self.layers.theme))

    # Keys

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            # While an amount is typed, digits and letters are its own and no shortcuts.
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
        """Give the tool a key by name; return whether it is the tool's, also where it means nothing now."""
        is_wanted, was_dragging = self.tools.wants_key(key), self.is_dragging
        had_effect = self.tools.key(key, self._pointer_of_key(event))
        if had_effect and was_dragging:
            self._show_progress()
        if had_effect and not self.is_dragging and key not in MOVING_KEYS:
            self._hovered_at(self._pointer_now())
        return had_effect or is_wanted

    def _pointer_of_key(self, event: QKeyEvent | None) -> Pointer:
        """Return the pointer with the modifier keys of a key event."""
        held = event.modifiers() if event is not None else Qt.KeyboardModifier.NoModifier
        shift, ctrl = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
        return replace(self._pointer_now(), shift=bool(held & shift), ctrl=bool(held & ctrl))

    def focusNextPrevChild(self, forward: bool) -> bool:
        if not self.hasFocus():
            # Asked by a field on top of it: by Tab there, or when it goes with the focus.
            return bool(super().focusNextPrevChild(forward))
        # Tab belongs to a transform in flight; no gesture lets it lead elsewhere.
        self.give_key("tab")
        if self.is_dragging or self.give_key("next" if forward else "previous"):
            return True
        return bool(super().focusNextPrevChild(forward))
