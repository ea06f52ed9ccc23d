"""Small parts that the dialogs around files share."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QLineEdit,
    QPushButton,
)

from app.qt.labels import Label

INTO = ("This document", "A new document")


def enters_number(dialog: QDialog, event: QKeyEvent) -> bool:
    """Whether a key is the Enter that ends typing into a field, and no order to go ahead."""
    is_enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
    return is_enter and isinstance(dialog.focusWidget(), QLineEdit | QAbstractSpinBox)


def choice_box(name: str, label: str, tip: str, items: Sequence[str]) -> QComboBox:
    """Return a box with these items."""
    box = QComboBox()
    box.setObjectName(name)
    box.setAccessibleName(label)
    box.setToolTip(tip)
    box.addItems(list(items))
    return box


def into_box() -> QComboBox:
    """Return the box that asks where imported curves go."""
    return choice_box("importInto", "Into", "Where the curves go", INTO)


def problem_label(name: str) -> Label:
    """Return a label for what is wrong; hidden while nothing is."""
    label = Label()
    label.setObjectName(name)
    label.setWordWrap(True)
    label.hide()
    return label


def buttons(text: str, name: str, tip: str, cancel: str) -> tuple[QDialogButtonBox, QPushButton]:
    """Return the buttons at the foot of a dialog, and the one that goes ahead.

    `cancel` is the object name of the other one.
    """
    box = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
    ahead = QPushButton(text)
    ahead.setObjectName(name)
    ahead.setToolTip(tip)
    ahead.setDefault(True)
    box.addButton(ahead, QDialogButtonBox.ButtonRole.AcceptRole)
    other = box.button(QDialogButtonBox.StandardButton.Cancel)
    other.setObjectName(cancel)
    other.setToolTip("Close and leave everything as it is (Esc)")
    return box, ahead
