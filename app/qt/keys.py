"""Keys that have a name of their own here, and those of a widget that are also shortcuts of its window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLineEdit, QWidget

from .overrides import SafeOverrides, guard

ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)

PASSING = (Qt.FocusReason.ActiveWindowFocusReason, Qt.FocusReason.PopupFocusReason)
"""Ways to lose the focus of somebody who comes back to go on typing: another window, the field's own menu."""


class ClaimsKeys(SafeOverrides):
    """Mixin for widgets, named before Qt's class: keys that `claims` knows do not go to the window."""

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a key is the widget's."""
        raise NotImplementedError

    @guard
    def event(self, event: QEvent) -> bool:
        """Claim a key; called by Qt."""
        is_asked = event.type() == QEvent.Type.ShortcutOverride
        if is_asked and isinstance(event, QKeyEvent) and self.claims(event):
            event.accept()
            return True
        return bool(super().event(event))  # type: ignore[misc]  # that of the widget's class


_OF_TEXT = frozenset(map(Qt.Key, map(ord, "ACVXYZ")))
"""Letters that edit text with Ctrl: the field's own."""

_SHIFT, _CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


class FieldShortcuts(SafeOverrides, QObject):
    """Lets the shortcuts of a window act while one of its fields has the focus: Ctrl and a letter.

    On X11 Qt's fields claim some of these, Ctrl+E for the end of the line. Where no shortcut has the keys
    they still mean that.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._watch)

    def _watch(self, _old: QWidget | None, new: QWidget | None) -> None:
        if isinstance(new, QLineEdit | QAbstractSpinBox):
            new.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep a field from claiming a key that is no text editing."""
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return False
        key, is_ctrl = event.key(), event.modifiers() & ~_SHIFT == _CTRL
        if not is_ctrl or not Qt.Key.Key_A <= key <= Qt.Key.Key_Z or key in _OF_TEXT:
            return False
        event.ignore()
        return True
