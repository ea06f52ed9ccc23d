"""Dialogs that compute something beside the window while they are open."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QKeyEvent
from PySide6.QtWidgets import QWidget

from ...appearance.theme import theme_of
from ...qt.labels import Label
from ...tasks.single_task import SingleTask
from ...widgets.fitting import FittedDialog
from .form_parts import enters_number


class WorkDialog(FittedDialog):
    """Goes away for good when it closes, and what is being computed with it.

    Attributes
    ----------
    jobs
        What is being computed.
    problem
        A line that says what is wrong.
    """

    def __init__(self, name: str, title: str, problem: str, parent: QWidget | None = None) -> None:
        super().__init__(name, title, parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.jobs = SingleTask(self)
        self.problem = Label(name=problem, wordWrap=True)
        self.problem.hide()

    def complain(self, text: str) -> None:
        """Say what is wrong; nothing when empty."""
        self.problem.setStyleSheet(f"color: {theme_of(self.palette()).warning.name()}")
        self.problem.setText(f"⚠ {text}" if text else "")
        self.problem.setVisible(bool(text))

    def done(self, result: int) -> None:
        """Close; what is being computed is dropped."""
        self.jobs.close()
        super().done(result)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not enters_number(self, event):
            super().keyPressEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        self.jobs.close()
        super().closeEvent(event)
