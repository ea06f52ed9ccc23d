"""Menu of switches that stays open while they are switched."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QMenu

from ..qt.keys import ENTER
from ..qt.overrides import Guarded


class ChoicesMenu(Guarded, QMenu):
    """Menu of switches: a click or Space on one leaves it open; Escape closes it."""

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if not self._switch(self.actionAt(event.position().toPoint())):
            super().mouseReleaseEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        is_meant = event.key() == Qt.Key.Key_Space or event.key() in ENTER
        if not (is_meant and self._switch(self.activeAction())):
            super().keyPressEvent(event)

    @staticmethod
    def _switch(action: QAction | None) -> bool:
        """Switch an action, if it is one to switch; return whether it is."""
        if action is None or not action.isCheckable():
            return False
        action.trigger()
        return True
