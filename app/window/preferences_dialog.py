"""Preferences, not modal: what is changed there is in force at once."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QDialogButtonBox, QTabWidget, QWidget

from ..actions.keymap import Keymap
from ..qt.keys import ENTER
from ..settings.kinds import settings_with_labels
from ..settings.preferences import Preferences
from ..widgets.boxes import column_of, form_of
from ..widgets.controls import named
from ..widgets.fitting import FittedDialog
from ..widgets.preference_fields import field_of
from .shortcut_editor import ShortcutEditor


class PreferencesDialog(FittedDialog):
    """A window with the settings that have a label.

    Signals
    -------
    changed
        A setting has changed.
    """

    changed = Signal()

    def __init__(self, preferences: Preferences, keymap: Keymap, parent: QWidget | None = None) -> None:
        super().__init__("preferencesDialog", "Preferences", parent)
        self._preferences = preferences
        self._fields = {
            name: field_of(setting, partial(self._choose, name))
            for name, setting in settings_with_labels(type(preferences)).items()
        }
        self.shortcuts = ShortcutEditor(keymap)
        self.tabs = QTabWidget()
        self.tabs.setObjectName("preferencesTabs")
        self.tabs.addTab(self._general(), "General")
        self.tabs.addTab(self.shortcuts, "Shortcuts")
        column_of(self.tabs, margins=(0, 4, 0, 0), parent=self.body)
        self.hold(self._buttons(), wished=QSize(540, 0))
        self.show_values()

    def _buttons(self) -> QDialogButtonBox:
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close = buttons.button(QDialogButtonBox.StandardButton.Close)
        tip = "Close; what you changed is in force already (Esc)"
        named(close, "closePreferences", "Close the preferences", tip)
        # Enter confirms what is typed in a field; it must not press this.
        close.setAutoDefault(False)
        buttons.rejected.connect(self.reject)
        return buttons

    def _general(self) -> QWidget:
        page = QWidget()
        rows = (row for field in self._fields.values() for row in field.rows)
        form_of(*rows, margins=16, across=16, down=10, parent=page)
        return page

    def show_values(self) -> None:
        """Show what the preferences hold."""
        for name, field in self._fields.items():
            field.show(getattr(self._preferences, name))
        self.shortcuts.show_all()

    def show_shortcuts(self) -> None:
        """Turn to the keys."""
        self.tabs.setCurrentWidget(self.shortcuts)
        self.shortcuts.search.setFocus()

    def _choose(self, name: str, value: object) -> None:
        setattr(self._preferences, name, value)
        self.changed.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        # Enter confirms what was typed; it does not close.
        if event.key() not in ENTER:
            super().keyPressEvent(event)
