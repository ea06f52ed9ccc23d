"""Keys of actions that are refused, or asked about, while their buttons and menu entries act."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QAction

from ..document.selection import Choice
from ..qt.overrides import Guarded
from .needs import Need
from .state import ActionFacts, ActionState

_Ask = Callable[[ActionState], str]
"""What a key would do that may not be meant, as a sentence; empty where there is nothing to ask."""


class KeyGate(Guarded, QObject):
    """Lets the keys of actions pass, or says why not, or what they would do before they do it."""

    def __init__(self, facts: ActionFacts) -> None:
        super().__init__()
        self._facts, self._session = facts, facts.session
        self._guarded: dict[str, tuple[Need, _Ask | None]] = {}
        # The action that was asked about last, and what was selected.
        self._asked: tuple[str, Choice] | None = None
        facts.session.message.connect(self._forget)
        facts.session.history_changed.connect(self._forget)

    def guard(self, action: QAction, needs: Need, asks: _Ask | None = None) -> None:
        """Let the keys of `action` pass only where `needs` is met, and where it `asks`, the second time."""
        self._guarded[action.objectName()] = needs, asks
        action.installEventFilter(self)
        if asks is not None:
            # A key that is held down is no second one.
            action.setAutoRepeat(False)

    def _forget(self) -> None:
        self._asked = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take a key that is refused."""
        if event.type() is not QEvent.Type.Shortcut:
            return False
        state, name, session = self._facts.read(), watched.objectName(), self._session
        needs, asks = self._guarded[name]
        if not needs.is_met(state):
            session.refuse(needs.reason(state))
            return True
        about = name, session.selected.choice
        if asks is None or self._asked == about or not (question := asks(state)):
            self._forget()
            return False
        session.refuse(question)
        self._asked = about
        return True
