"""What keys mean on the canvas, and what shape the pointer has."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QCursor, QKeyEvent

from app.icons import icon
from app.theme import Theme
from app.tools.pointer import Cursor, Hint
from app.tools.tools import ToolKind

ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
"""Directions in the plane."""

_TRANSFORM_KEYS = {
    **{Qt.Key(Qt.Key.Key_0 + digit): str(digit) for digit in range(10)},
    Qt.Key.Key_Period: ".",
    Qt.Key.Key_Comma: ".",
    Qt.Key.Key_Minus: "-",
    Qt.Key.Key_Backspace: "backspace",
    Qt.Key.Key_Tab: "tab",
    Qt.Key.Key_Backtab: "tab",
    Qt.Key.Key_Semicolon: "tab",
    Qt.Key.Key_Return: "enter",
    Qt.Key.Key_Enter: "enter",
    **{Qt.Key(getattr(Qt.Key, f"Key_{name.upper()}")): name for name in "xygsr"},
}
"""What a transform in flight understands, and calls it."""

_WITH_SHIFT = (Qt.Key.Key_Backtab, Qt.Key.Key_Tab, Qt.Key.Key_Semicolon)
"""Keys that mean the same with Shift: some keyboards have the semicolon there."""

_CURSORS = {
    Cursor.MOVE: Qt.CursorShape.SizeAllCursor,
    Cursor.WIDER: Qt.CursorShape.SizeHorCursor,
    Cursor.HIGHER: Qt.CursorShape.SizeVerCursor,
    Cursor.RISING: Qt.CursorShape.SizeBDiagCursor,
    Cursor.FALLING: Qt.CursorShape.SizeFDiagCursor,
}


def transform_key(event: QKeyEvent) -> str | None:
    """Return what a key means to a transform in flight, None for nothing."""
    key, held = Qt.Key(event.key()), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
    if key in _WITH_SHIFT:
        held &= ~Qt.KeyboardModifier.ShiftModifier
    return _TRANSFORM_KEYS.get(key) if not held else None


def cursor_of(hint: Hint, tool: ToolKind, theme: Theme) -> QCursor:
    """Return the shape of the pointer for what a press would do."""
    if hint.cursor is Cursor.ROTATE:
        return QCursor(icon("rotate", theme).pixmap(20, 20))
    if hint.cursor is not None:
        return QCursor(_CURSORS[hint.cursor])
    if hint.grab:
        return QCursor(Qt.CursorShape.PointingHandCursor)
    idle = Qt.CursorShape.ArrowCursor if tool is ToolKind.SELECT else Qt.CursorShape.CrossCursor
    return QCursor(idle)
