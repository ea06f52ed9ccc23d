"""The history in the window: its dock."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from app.features.history.controller import HistoryController
from app.features.history.panel import HistoryPanel
from app.workbench.context import WindowContext
from app.workbench.docks import UPPER, Panel


class HistoryCommands:
    """Shows the undo stack of a session.

    Attributes
    ----------
    panel
        The list of steps, as soon as the docks are filled.
    """

    panel: HistoryPanel

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @Panel("historyDock", "History", UPPER)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the list of steps."""
        self.panel = HistoryPanel(self._session.undo_stack, parent)
        self._controller = HistoryController(self._session, self.panel)
        return self.panel


COMMAND_SETS = (HistoryCommands,)
