"""Preferences, not modal: settings and keys are in force as soon as they are changed."""

from __future__ import annotations

from functools import partial
from typing import Any

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialogButtonBox,
    QHeaderView,
    QKeySequenceEdit,
    QLineEdit,
    QTableWidget,
    QTableWidgetItem,
    QTabWidget,
    QWidget,
)

from ..actions.keymap import Keymap, keys_text, native, refusal
from ..qt.labels import INK, WARNING, Label
from ..qt.overrides import ENTER, SafeOverrides
from ..settings.kinds import settings_with_labels
from ..settings.preferences import Preferences, stored_tool_settings
from ..view_model.settings import OwnedSetting
from ..widgets.boxes import column_of, form_of, row_of
from ..widgets.controls import named, push_button
from ..widgets.frames import FittedDialog
from ..widgets.preference_fields import field_of
from .fuzzy import SearchEntry, ranked


class PreferencesDialog(FittedDialog):
    """Dialog with the settings that have a label, and the editor of shortcuts.

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
        self._tool_fields = {
            setting: field_of(stored, partial(self._choose_of_tool, setting))
            for setting, stored in stored_tool_settings().items()
        }
        self.shortcuts = ShortcutEditor(keymap)
        self.tabs = QTabWidget()
        self.tabs.setObjectName("preferencesTabs")
        self.tabs.addTab(self._general(), "General")
        self.tabs.addTab(self.shortcuts, "Shortcuts")
        column_of(self.tabs, margins=(0, 4, 0, 0), parent=self.body)
        self.hold(self._buttons(), preferred=QSize(540, 0))
        self.show_values()

    def _buttons(self) -> QDialogButtonBox:
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        close = buttons.button(QDialogButtonBox.StandardButton.Close)
        tip = "Close; changes are already in effect (Esc)"
        named(close, "closePreferences", "Close the preferences", tip)
        # Enter confirms input in a field; it must not press this button.
        close.setAutoDefault(False)
        buttons.rejected.connect(self.reject)
        return buttons

    def _general(self) -> QWidget:
        page = QWidget()
        rows = (row for field in (*self._fields.values(), *self._tool_fields.values()) for row in field.rows)
        form_of(*rows, margins=16, across=16, down=10, parent=page)
        return page

    def show_values(self) -> None:
        """Show the values of the preferences."""
        for name, field in self._fields.items():
            field.show(getattr(self._preferences, name))
        values = self._preferences.tool_settings
        for setting, tool_field in self._tool_fields.items():
            tool_field.show(values.value(setting))
        self.shortcuts.show_all()

    def show_shortcuts(self) -> None:
        """Show the tab of shortcuts."""
        self.tabs.setCurrentWidget(self.shortcuts)
        self.shortcuts.search.setFocus()

    def _choose(self, name: str, value: object) -> None:
        setattr(self._preferences, name, value)
        self.changed.emit()

    def _choose_of_tool(self, setting: OwnedSetting[Any], value: object) -> None:
        self._choose("tool_settings", self._preferences.tool_settings.with_value(setting, value))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        # Enter confirms input; it does not close the dialog.
        if event.key() not in ENTER:
            super().keyPressEvent(event)


_NAME = Qt.ItemDataRole.UserRole
_HEADERS = ("Action", "Keys", "Menu")


class ShortcutEditor(SafeOverrides, QWidget):
    """Table of actions and keys; recorded keys are in effect at once.

    Keys of another action are reassigned only after confirmation.
    """

    def __init__(self, keymap: Keymap, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("shortcutEditor")
        self._keymap = keymap
        self._wanted: QKeySequence | None = None
        self.search = _search_field()
        self.table = _table()
        self.recorder = _recorder()
        self.note = Label(name="shortcutNote", wordWrap=True)
        self._caption = Label()
        self.take = push_button("takeKeys", "Reassign", "Assign these keys to this action instead")
        self.keep = push_button("keepKeys", "Cancel", "Keep these keys for the other action")
        self.clear = push_button("clearKeys", "Remove Keys", "Remove the keys of this action")
        self.reset = push_button("resetKeys", "Reset", "Restore the default keys of this action")
        self.reset_all = push_button("resetAllKeys", "Reset All", "Restore the default keys of all actions")
        self._lay_out()
        self._connect()
        self._fill()
        self._select_first()

    def _lay_out(self) -> None:
        record = row_of((self._caption, 1), (self.recorder, 1), self.clear, self.reset)
        answer = row_of((self.note, 1), self.take, self.keep, self.reset_all)
        column_of(self.search, (self.table, 1), record, answer, margins=12, spacing=8, parent=self)
        # Room for two lines of text, so that nothing moves.
        self.note.setMinimumHeight(2 * self.note.fontMetrics().lineSpacing())
        self._clear_wish()

    def _connect(self) -> None:
        self.search.textEdited.connect(lambda _text: self._filter())
        self.table.currentCellChanged.connect(lambda *_cells: self._show_current())
        self.table.cellClicked.connect(self._begin_recording_at)
        self.table.cellActivated.connect(self._begin_recording_at)
        self.recorder.editingFinished.connect(self._recorded)
        self.take.clicked.connect(self._take_over)
        self.keep.clicked.connect(self._show_current)
        self.clear.clicked.connect(lambda: self._assign([]))
        self.reset.clicked.connect(self._reset)
        self.reset_all.clicked.connect(self._keymap.reset_all)
        self._keymap.changed.connect(self._render)

    # The table

    def _fill(self) -> None:
        bindings = self._keymap.bindings
        self.table.setRowCount(len(bindings))
        for row, (name, binding) in enumerate(bindings.items()):
            for column, text in enumerate((binding.text, "", binding.menu)):
                item = QTableWidgetItem(text)
                item.setData(_NAME, name)
                item.setToolTip(binding.action.statusTip())
                self.table.setItem(row, column, item)
        self._render()

    def _render(self) -> None:
        for row in range(self.table.rowCount()):
            name, item = self._name_at(row), self._item(row, 1)
            item.setText(keys_text(self._keymap.keys(name)))
            font = item.font()
            font.setBold(not self._keymap.is_default(name))
            item.setFont(font)
        self._show_current()

    def _item(self, row: int, column: int) -> QTableWidgetItem:
        item = self.table.item(row, column)
        assert item is not None
        return item

    def _name_at(self, row: int) -> str:
        return str(self._item(row, 0).data(_NAME))

    def show_all(self) -> None:
        """Show all actions, without a search."""
        if self.search.text():
            self.search.clear()
            self._filter()

    def _filter(self) -> None:
        typed, rows = self.search.text(), range(self.table.rowCount())
        things = [SearchEntry(self._item(row, 0).text(), self._item(row, 2).text()) for row in rows]
        keys = [row for row in rows if typed.casefold() in self._item(row, 1).text().casefold()]
        matching = list(dict.fromkeys([*ranked(typed, things), *keys])) if typed.strip() else list(rows)
        header = self.table.verticalHeader()
        for position, row in enumerate([*matching, *sorted(set(rows) - set(matching))]):
            header.moveSection(header.visualIndex(row), position)
            self.table.setRowHidden(row, position >= len(matching))
        if typed.strip() or self.table.isRowHidden(self.table.currentRow()):
            self._select_first()

    def _select_first(self) -> None:
        rows = [row for row in self.displayed_rows if not self.table.isRowHidden(row)]
        if rows:
            self.table.setCurrentCell(rows[0], 1)

    @property
    def displayed_rows(self) -> list[int]:
        """Rows of the table in displayed order, hidden ones last."""
        header = self.table.verticalHeader()
        return [header.logicalIndex(position) for position in range(self.table.rowCount())]

    @property
    def current(self) -> str:
        """Name of the selected action."""
        return self._name_at(max(self.table.currentRow(), 0))

    def choose(self, name: str) -> None:
        """Select an action."""
        for row in range(self.table.rowCount()):
            if self._name_at(row) == name:
                self.table.setCurrentCell(row, 1)

    def _show_current(self) -> None:
        name = self.current
        self._clear_wish()
        self._caption.setText(f"Keys of {self._keymap.bindings[name].text}:")
        keys = self._keymap.keys(name)
        self.recorder.setKeySequence(keys[0] if keys else QKeySequence())
        self.clear.setEnabled(bool(keys))
        self.reset.setEnabled(not self._keymap.is_default(name))
        self.reset_all.setEnabled(bool(self._keymap.overrides))

    # Recording

    def _begin_recording_at(self, _row: int, _column: int) -> None:
        self._clear_wish()
        self.note.setText("Press the new keys, or Escape to keep the current ones.")
        self.recorder.clear()
        self.recorder.setFocus()

    def _recorded(self) -> None:
        key = self.recorder.keySequence()
        if key == QKeySequence(Qt.Key.Key_Escape):
            self._show_current()
            self.table.setFocus()
            return
        if key.isEmpty() or key in self._keymap.keys(self.current):
            return
        reason = refusal(key)
        if reason:
            self._show_current()
            self._warn(reason)
            return
        owner = self._keymap.owner_of(key)
        if owner is None or owner == self.current:
            self._assign([key])
        else:
            self._ask_about(key, owner)

    def _ask_about(self, key: QKeySequence, owner: str) -> None:
        self._wanted = key
        self._warn(f"{native(key)} is assigned to {self._keymap.bindings[owner].text}.")
        for button in (self.take, self.keep):
            button.show()
        self.reset_all.hide()

    def _take_over(self) -> None:
        if self._wanted is not None:
            self._assign([self._wanted])

    def _assign(self, keys: list[QKeySequence]) -> None:
        self._keymap.assign(self.current, keys)
        self.table.setFocus()

    def _reset(self) -> None:
        name = self.current
        owners = {self._keymap.owner_of(key) for key in self._keymap.default_keys(name)} - {None, name}
        names = " and ".join(self._keymap.bindings[owner].text for owner in owners if owner is not None)
        self._keymap.reset(name)
        if names:
            self._warn(f"Keys were removed from {names}.")

    def _clear_wish(self) -> None:
        self._wanted = None
        self.note.setText("")
        self.note.setForegroundRole(INK)
        for button in (self.take, self.keep):
            button.hide()
        self.reset_all.show()

    def _warn(self, text: str) -> None:
        self.note.setForegroundRole(WARNING)
        self.note.setText(f"⚠ {text}")


def _search_field() -> QLineEdit:
    label = "Search for an action or a key"
    field = named(QLineEdit(), "shortcutSearch", label, "A few letters of an action, or a key such as Ctrl+S")
    field.setPlaceholderText(label)
    field.setClearButtonEnabled(True)
    return field


def _table() -> QTableWidget:
    table = QTableWidget(0, len(_HEADERS))
    named(table, "shortcutTable", "Actions and their keys", "Click an action to record new keys for it")
    table.setHorizontalHeaderLabels(list(_HEADERS))
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setShowGrid(False)
    table.setTabKeyNavigation(False)
    table.verticalHeader().hide()
    table.verticalHeader().setDefaultSectionSize(26)
    header = table.horizontalHeader()
    header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
    header.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
    header.setSectionResizeMode(2, QHeaderView.ResizeMode.ResizeToContents)
    header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    return table


def _recorder() -> QKeySequenceEdit:
    recorder = named(QKeySequenceEdit(), "keyRecorder", "New keys", "Click and press the new keys")
    # One combination: with a sequence of two, the first would not work at once.
    recorder.setMaximumSequenceLength(1)
    return recorder
