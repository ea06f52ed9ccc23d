"""Small parts that the dialogs around files share."""

from __future__ import annotations

from enum import Enum

from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QDialog, QDialogButtonBox, QLineEdit, QPushButton

from ...qt.keys import ENTER
from ...widgets.controls import choice_box, named

A_NEW_DOCUMENT = "A new document"
INTO = ("This document", A_NEW_DOCUMENT)


def enters_number(dialog: QDialog, event: QKeyEvent) -> bool:
    """Whether a key is the Enter that ends typing into a field, and no order to go ahead."""
    is_enter = event.key() in ENTER
    return is_enter and isinstance(dialog.focusWidget(), QLineEdit | QAbstractSpinBox)


class Verb(Enum):
    """What is done with a file that is shown: its curves are taken in, or it is a document of its own."""

    IMPORT = "Import"
    OPEN = "Open"

    def towards(self, where: str) -> Verb:
        """Return what it is once the person has said where the curves go: into this document, an import."""
        return self if where == A_NEW_DOCUMENT else Verb.IMPORT


def into_box(verb: Verb) -> QComboBox:
    """Return the box that asks where the curves go; of what is opened, to a new document."""
    box = choice_box("importInto", "Into", "Where the curves go", INTO)
    if verb is Verb.OPEN:
        box.setCurrentText(A_NEW_DOCUMENT)
    return box


def buttons(text: str, name: str, tip: str, cancel: str) -> tuple[QDialogButtonBox, QPushButton]:
    """Return the buttons at the foot of a dialog, and the one that goes ahead.

    `cancel` is the object name of the other one.
    """
    box = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
    ahead = named(QPushButton(text), name, tip=tip)
    ahead.setDefault(True)
    box.addButton(ahead, QDialogButtonBox.ButtonRole.AcceptRole)
    other = box.button(QDialogButtonBox.StandardButton.Cancel)
    named(other, cancel, tip="Close and leave everything as it is (Esc)")
    return box, ahead
