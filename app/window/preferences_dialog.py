"""Preferences, not modal: what is changed there is in force at once."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QCheckBox, QDialogButtonBox, QLineEdit, QTabWidget, QWidget

from app.actions.keymap import Keymap
from app.appearance.theme import ThemeMode, theme_of
from app.document.expression import ExpressionError
from app.qt.labels import Label
from app.settings.preferences import LONGEST_UNIT, Preferences
from app.tools.snapping import SnapKind
from app.widgets.boxes import column_of, form_of
from app.widgets.controls import check_box, choice_box, named
from app.widgets.field_edit import NumberEdit, read_number
from app.widgets.fitting import FittedDialog
from app.widgets.number_text import typed_text
from app.window.shortcut_editor import ShortcutEditor

UNITS = ("none", "mm", "cm", "m", "in", "px", "s")
_ADAPTIVE = "adaptive"


class PreferencesDialog(FittedDialog):
    """A window with what is remembered from one start to the next.

    Signals
    -------
    theme_chosen
        Another theme mode was chosen.
    changed
        Anything else in the preferences has changed.
    """

    theme_chosen = Signal(object)
    changed = Signal()

    def __init__(self, preferences: Preferences, keymap: Keymap, parent: QWidget | None = None) -> None:
        super().__init__("preferencesDialog", "Preferences", parent)
        self._preferences = preferences
        modes = (each.label for each in ThemeMode)
        self.theme_box = choice_box("themeBox", "Theme", "Light or dark colours", modes)
        self.unit_box = choice_box("unitBox", "Unit", "What a length of one is called; type any name", UNITS)
        self._unit_edit = QLineEdit()
        self._unit_edit.setMaxLength(LONGEST_UNIT)
        self.unit_box.setEditable(True)
        self.unit_box.setLineEdit(self._unit_edit)
        self.grid_edit = NumberEdit(
            "gridSpacing",
            "Grid spacing",
            "“adaptive”, or a distance in the plane (Enter to set)",
            _spacing_of,
        )
        self.snap_checks = {kind: _snap_check(kind) for kind in SnapKind}
        self._problem = Label(name="preferencesProblem", wordWrap=True)
        self.shortcuts = ShortcutEditor(keymap)
        self.tabs = QTabWidget()
        self.tabs.setObjectName("preferencesTabs")
        self.tabs.addTab(self._general(), "General")
        self.tabs.addTab(self.shortcuts, "Shortcuts")
        column_of(self.tabs, margins=(0, 4, 0, 0), parent=self.body)
        self.hold(self._buttons(), wished=QSize(540, 560))
        self._connect()
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
        first, *others = self.snap_checks.values()
        form_of(
            ("Theme", self.theme_box),
            ("Unit", self.unit_box),
            ("Grid spacing", self.grid_edit),
            ("", self._problem),
            ("Snap to", first),
            *(("", check) for check in others),
            margins=16,
            across=16,
            down=10,
            parent=page,
        )
        return page

    def _connect(self) -> None:
        self.theme_box.activated.connect(lambda row: self.theme_chosen.emit(list(ThemeMode)[row]))
        self.unit_box.textActivated.connect(self._choose_unit)
        self._unit_edit.editingFinished.connect(lambda: self._choose_unit(self._unit_edit.text()))
        self.grid_edit.entered.connect(self._choose_grid)
        self.grid_edit.refused.connect(self._complain)
        self.grid_edit.left.connect(lambda: self._complain(""))
        for check in self.snap_checks.values():
            check.clicked.connect(self._choose_snaps)

    # Rendering: nothing here writes back

    def show_values(self) -> None:
        """Show what the preferences hold."""
        preferences = self._preferences
        self.theme_box.setCurrentIndex(list(ThemeMode).index(preferences.theme_mode))
        self.unit_box.setCurrentText(preferences.unit_name or UNITS[0])
        spacing = preferences.grid_spacing
        self.grid_edit.show_text(typed_text(spacing) if spacing else _ADAPTIVE)
        for kind, check in self.snap_checks.items():
            check.setChecked(kind in preferences.snap_kinds)

    def show_shortcuts(self) -> None:
        """Turn to the keys."""
        self.tabs.setCurrentWidget(self.shortcuts)
        self.shortcuts.search.setFocus()

    # What the person did

    def _choose_unit(self, text: str) -> None:
        name = text.strip()
        name = "" if name == UNITS[0] else name
        if name != self._preferences.unit_name:
            self._preferences.unit_name = name
            self.changed.emit()

    def _choose_grid(self, spacing: float) -> None:
        self._complain("")
        self._preferences.grid_spacing = spacing
        self.show_values()
        self.changed.emit()

    def _choose_snaps(self) -> None:
        chosen = frozenset(kind for kind, check in self.snap_checks.items() if check.isChecked())
        self._preferences.snap_kinds = chosen
        self.changed.emit()

    def _complain(self, text: str) -> None:
        self._problem.setStyleSheet(f"color: {theme_of(self.palette()).warning.name()}")
        self._problem.setText(f"⚠ {text}" if text else "")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        # Enter confirms what was typed; it does not close.
        if event.key() not in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            super().keyPressEvent(event)


def _spacing_of(text: str) -> float:
    """Return the spacing that was typed, 0 for one that adapts."""
    if text.strip().casefold() in ("", _ADAPTIVE):
        return 0.0
    spacing = read_number(text)
    if not spacing > 0:
        raise ExpressionError("The grid needs a distance greater than 0, or “adaptive”.")
    return spacing


def _snap_check(kind: SnapKind) -> QCheckBox:
    text = kind.label
    tip = f"Points that are dragged snap to this: {text[0].lower()}{text[1:]}"
    return check_box(f"snap_{kind}", text, tip)
