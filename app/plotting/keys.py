"""Keys and shapes of the pointer, as Qt has them."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QCursor, QKeyEvent

from ..appearance.icons import icon
from ..appearance.theme import Theme
from ..tools.pointer import Cursor, Stride

ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
"""Directions in the plane."""

_NAMES = {
    **{Qt.Key(Qt.Key.Key_0 + digit): str(digit) for digit in range(10)},
    Qt.Key.Key_Period: ".",
    Qt.Key.Key_Comma: ".",
    Qt.Key.Key_Minus: "-",
    Qt.Key.Key_Backspace: "backspace",
    Qt.Key.Key_Delete: "delete",
    Qt.Key.Key_Tab: "tab",
    Qt.Key.Key_Backtab: "tab",
    Qt.Key.Key_Semicolon: "tab",
    Qt.Key.Key_Return: "enter",
    Qt.Key.Key_Enter: "enter",
    **{Qt.Key(getattr(Qt.Key, f"Key_{name.upper()}")): name for name in "xygsr"},
}
"""Keys that tools hear of, and their names."""

_WITH_SHIFT = {Qt.Key.Key_Backtab, Qt.Key.Key_Tab, Qt.Key.Key_Semicolon, Qt.Key.Key_Return, Qt.Key.Key_Enter}
"""Keys that mean the same with Shift: some keyboards have the semicolon there, and a hand may hold it."""


def key_name(event: QKeyEvent) -> str | None:
    """Return what a tool calls a key, None for one that it never hears of."""
    key, held = Qt.Key(event.key()), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    if key in _WITH_SHIFT:
        held &= ~Qt.KeyboardModifier.ShiftModifier
    return _NAMES.get(key) if not held else None


def stride_of(event: QKeyEvent, pixel: float) -> Stride:
    """Return how far an arrow key goes: with Shift ten times as far, with Ctrl a tenth."""
    held = event.modifiers()
    factor = 10.0 if held & Qt.KeyboardModifier.ShiftModifier else 1.0
    if held & Qt.KeyboardModifier.ControlModifier:
        factor *= 0.1
    return Stride(pixel, factor)


def cursor_of(cursor: Cursor, theme: Theme) -> QCursor:
    """Return the shape of the pointer."""
    if cursor.value in Qt.CursorShape.__members__:
        return QCursor(Qt.CursorShape[cursor.value])
    return QCursor(icon(cursor.value, theme).pixmap(20, 20))
