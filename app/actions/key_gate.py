"""Keys of actions that are refused while their buttons and menu entries act."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QAction

from ..qt.overrides import SafeOverrides
from .needs import Need
from .state import ActionFacts


class KeyGate(SafeOverrides, QObject):
    """Lets the keys of actions pass, or says why not."""

    def __init__(self, facts: ActionFacts) -> None:
        super().__init__()
        self._facts = facts
        self._guarded: dict[str, Need] = {}

    def guard(self, action: QAction, needs: Need) -> None:
        """Let the keys of `action` pass only where `needs` is met."""
        self._guarded[action.objectName()] = needs
        action.installEventFilter(self)

    def release(self, action: QAction) -> None:
        """Guard the keys of `action` no longer; it has its name still."""
        if self._guarded.pop(action.objectName(), None) is not None:
            action.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take a key that is refused."""
        if event.type() is not QEvent.Type.Shortcut:
            return False
        needs, state = self._guarded[watched.objectName()], self._facts.read()
        if needs.is_met(state):
            return False
        self._facts.session.refuse(needs.reason(state))
        return True
