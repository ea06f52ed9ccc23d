"""Keys of actions that can be refused while their buttons and menu entries act."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QAction

from ..qt.overrides import Guarded
from .needs import Need
from .situation import Situation


class KeyGate(Guarded, QObject):
    """Lets the keys of actions pass, or says why not."""

    def __init__(self, now: Situation) -> None:
        super().__init__()
        self._now = now
        self._needs: dict[str, Need] = {}

    def guard(self, action: QAction, needs: Need) -> None:
        """Let the keys of `action` pass only where `needs` is met."""
        self._needs[action.objectName()] = needs
        action.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take a key that is refused."""
        if event.type() is not QEvent.Type.Shortcut:
            return False
        needs = self._needs[watched.objectName()]
        if needs.is_met(self._now):
            return False
        self._now.session.refuse(needs.reason(self._now))
        return True
