"""A button that shows, and switches, what an action switches."""

from __future__ import annotations

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton


def mirror(button: QAbstractButton, action: QAction) -> None:
    """Let a button show whether an action is checked, and trigger it."""
    button.setCheckable(action.isCheckable())
    button.setChecked(action.isChecked())
    button.setToolTip(action.toolTip())
    button.clicked.connect(action.trigger)
    if action.isCheckable():
        action.toggled.connect(button.setChecked)
