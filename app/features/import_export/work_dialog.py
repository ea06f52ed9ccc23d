"""Base of the dialogs around files, which compute something beside the window, and their parts."""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeyEvent
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QLineEdit,
    QPushButton,
    QWidget,
)

from ...document.words import count_of
from ...qt.labels import WARNING, Label
from ...qt.overrides import ENTER
from ...tasks.task import SingleTask
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box, named, push_button
from ...widgets.frames import FittedDialog
from .import_series import SeriesPosition

A_NEW_DOCUMENT = "A new document"
INTO = ("This document", A_NEW_DOCUMENT)


def enters_number(dialog: QDialog, event: QKeyEvent) -> bool:
    """Whether a key is an Enter that ends typing into a field, and does not accept the dialog."""
    is_enter = event.key() in ENTER
    return is_enter and isinstance(dialog.focusWidget(), QLineEdit | QAbstractSpinBox)


class Verb(Enum):
    """Verb of a dialog: the curves are imported, or the file is opened as a document of its own."""

    IMPORT = "Import"
    OPEN = "Open"

    def towards(self, where: str) -> Verb:
        """Return the verb for a target: curves that go into this document are imported."""
        return self if where == A_NEW_DOCUMENT else Verb.IMPORT


def into_box(verb: Verb) -> QComboBox:
    """Return the box for the target of the curves; for files that are opened, a new document."""
    box = choice_box("importInto", "Into", "Document that receives the curves", INTO)
    if verb is Verb.OPEN:
        box.setCurrentText(A_NEW_DOCUMENT)
    return box


def buttons(text: str, name: str, tip: str, cancel: str) -> tuple[QDialogButtonBox, QPushButton]:
    """Return the buttons at the foot of a dialog, and the accepting one.

    `cancel` is the object name of the other one.
    """
    box = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
    ahead = named(QPushButton(text), name, tip=tip)
    ahead.setDefault(True)
    box.addButton(ahead, QDialogButtonBox.ButtonRole.AcceptRole)
    other = box.button(QDialogButtonBox.StandardButton.Cancel)
    named(other, cancel, tip="Close without changes (Esc)")
    return box, ahead


class WorkDialog(FittedDialog):
    """Dialog that is deleted when it closes, together with its computation.

    Attributes
    ----------
    jobs
        The computation.
    problem
        Label with the problem.
    """

    def __init__(self, name: str, title: str, problem: str, parent: QWidget | None = None) -> None:
        super().__init__(name, title, parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.jobs = SingleTask(self)
        self.problem = Label(name=problem, wordWrap=True, role=WARNING)
        self.problem.hide()

    def show_problem(self, text: str) -> None:
        """Show a problem; hide it when empty."""
        self.problem.show_problem(text)

    def done(self, result: int) -> None:
        """Close the dialog and drop its computation."""
        self.jobs.close()
        super().done(result)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not enters_number(self, event):
            super().keyPressEvent(event)

    def closeEvent(self, event: QCloseEvent) -> None:
        self.jobs.close()
        super().closeEvent(event)


class ImportFoot(QWidget):
    """Import, or Open, and Cancel; while other files wait, Skip and Skip the Rest.

    Signals
    -------
    rest_skipped
        Skip the Rest was pressed.
    """

    rest_skipped = Signal()

    def __init__(self, dialog: QDialog, name: str, tip: str, verb: Verb, into: QComboBox) -> None:
        super().__init__()
        self._dialog, self._title = dialog, dialog.windowTitle()
        self.box, self.ok = buttons(verb.value, name, tip, "cancelImport")
        into.currentTextChanged.connect(lambda where: self.ok.setText(verb.towards(where).value))
        self.box.rejected.connect(dialog.reject)
        self._cancel = self.box.button(QDialogButtonBox.StandardButton.Cancel)
        self._words, self._tip = self._cancel.text(), self._cancel.toolTip()
        self.rest = push_button("skipRest", "Skip the Rest", "")
        self.rest.clicked.connect(self.rest_skipped)
        self.rest.hide()
        row_of(self.rest, (self.box, 1), margins=0, parent=self)

    def show_position(self, position: SeriesPosition) -> None:
        """Show the number of the file among several, and the button to skip the others."""
        self._dialog.setWindowTitle(
            f"{self._title} ({position.number} of {position.count})" if position.count > 1 else self._title
        )
        waits = position.waiting > 0
        self._cancel.setText("Skip" if waits else self._words)
        self._cancel.setToolTip("Skip this file and continue with the next (Esc)" if waits else self._tip)
        self.rest.setToolTip(f"Skip this file and the {count_of(position.waiting, 'file')} after it")
        self.rest.setVisible(waits)
