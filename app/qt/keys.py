"""Keys that have a name of their own here, and those of a widget that are also shortcuts of its window."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent

from .overrides import Guarded, guard

ENTER = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
DELETE = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)

PASSING = (Qt.FocusReason.ActiveWindowFocusReason, Qt.FocusReason.PopupFocusReason)
"""Ways to lose the focus of somebody who comes back to go on typing: another window, the field's own menu."""


class ClaimsKeys(Guarded):
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
