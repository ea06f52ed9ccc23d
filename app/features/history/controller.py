"""Name of the state that the history begins with."""

from __future__ import annotations

from app.features.history.panel import HistoryPanel
from app.session import Session


class HistoryController:
    """Names the beginning of the history after each document that is opened."""

    def __init__(self, session: Session, panel: HistoryPanel) -> None:
        self._session, self._panel = session, panel
        session.opened.connect(self._name_beginning)
        if session.files.path is not None:
            self._name_beginning()

    def _name_beginning(self) -> None:
        session = self._session
        if session.undo_stack.count():
            return  # a lesson or an example was opened as a step; it began with something else
        if session.files.path is not None:
            opened = session.files.path.name
        else:
            opened = session.active_curve.name if session.active_curve.points else ""
        self._panel.name_beginning(f"Opened {opened}" if opened else "New document")
