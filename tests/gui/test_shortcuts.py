"""Keys that the person chooses: recorded, in force, remembered; conflicts are settled by the person."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from app.actions.declaration import action
from app.actions.keymap import refusal
from app.actions.menus import CURVE, CURVE_SHAPE
from app.families import HERMITE, LAGRANGE
from app.features.help.shortcut_sheet import ShortcutSheet
from app.session import Session
from app.settings.preferences import Preferences
from app.testing import Editor
from app.window import MainWindow
from app.window.connect import COMMAND_SETS
from app.window.preferences_dialog import PreferencesDialog
from tests.count_drag import codes_called

CTRL = Qt.KeyboardModifier.ControlModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def keys(editor):
    return open_keys(editor)


def open_keys(editor):
    editor.trigger("editShortcuts")
    dialog = editor.window.findChild(PreferencesDialog)
    assert dialog.isVisible()
    assert not dialog.isModal()
    return dialog.shortcuts


def record(keys, name, key, held=NO_KEYS):
    """Click the row of an action and press keys."""
    keys.choose(name)
    row = keys.table.currentRow()
    rect = keys.table.visualItemRect(keys.table.item(row, 1))
    QTest.mouseClick(keys.table.viewport(), Qt.MouseButton.LeftButton, pos=rect.center())
    assert keys.recorder.hasFocus()
    QTest.keyClick(keys.recorder, key, held)


def displayed_key(keys, name):
    for row in range(keys.table.rowCount()):
        if keys.table.item(row, 0).data(Qt.ItemDataRole.UserRole) == name:
            return keys.table.item(row, 1).text()
    raise LookupError(name)


def test_recorded_keys_work_at_once_everywhere(editor, keys):
    record(keys, "familyHermite", Qt.Key.Key_U, CTRL)
    assert displayed_key(keys, "familyHermite") == "Ctrl+U"
    action = editor.action("familyHermite")
    assert action.toolTip().endswith("(Ctrl+U)")
    assert ("Ctrl+U", "Cubic pieces with given velocities") in editor.window.actions_by_name.shortcuts(CURVE)
    keys.window().hide()
    # Offscreen nobody else hands the keyboard back.
    editor.window.activateWindow()
    editor.settle()
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_2)
    assert editor.curve.family is LAGRANGE
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_U, CTRL)
    assert editor.curve.family is HERMITE
    editor.trigger("showShortcuts")
    sheet = editor.window.findChild(QWidget, "shortcutSheet")
    assert any("Ctrl+U" in label.text() for label in sheet.findChildren(QLabel))
    assert editor.find_command("hermite")[0] == "Hermite"


def test_a_conflict_is_named_and_waits_for_an_answer(editor, keys):
    record(keys, "fitView", Qt.Key.Key_S, CTRL)
    assert "Ctrl+S is assigned to Save" in keys.note.text()
    assert editor.action("fitView").shortcuts() == [QKeySequence("F")]
    assert keys.take.isVisible()
    keys.keep.click()
    assert editor.action("fitView").shortcuts() == [QKeySequence("F")]
    assert not keys.take.isVisible()
    record(keys, "fitView", Qt.Key.Key_S, CTRL)
    keys.take.click()
    assert editor.action("fitView").shortcuts() == [QKeySequence("Ctrl+S")]
    assert editor.action("saveDocument").shortcuts() == []
    assert editor.action("saveDocument").toolTip() == "Save the document"
    assert displayed_key(keys, "saveDocument") == ""
    # Only the key in conflict is taken.
    record(keys, "fitView", Qt.Key.Key_Y, CTRL)
    keys.take.click()
    assert editor.action("redo").shortcuts() == [QKeySequence("Ctrl+Shift+Z")]


def test_escape_leaves_the_recorded_keys_unchanged(editor, keys):
    record(keys, "fitView", Qt.Key.Key_Escape)
    assert editor.action("fitView").shortcuts() == [QKeySequence("F")]
    assert keys.window().isVisible()


@pytest.mark.parametrize("key", [Qt.Key.Key_Space, Qt.Key.Key_Left, Qt.Key.Key_Return, Qt.Key.Key_E])
def test_keys_of_the_drawing_are_refused_with_the_reason(editor, keys, key):
    record(keys, "fitView", key)
    assert "choose another key" in keys.note.text()
    assert editor.action("fitView").shortcuts() == [QKeySequence("F")]


def test_a_reserved_key_with_ctrl_is_free():
    assert refusal(QKeySequence("Shift+Left"))
    assert not refusal(QKeySequence("Ctrl+Left"))


def test_reset_one_and_reset_all(editor, keys):
    record(keys, "fitView", Qt.Key.Key_S, CTRL)
    keys.take.click()
    record(keys, "quit", Qt.Key.Key_F5)
    keys.choose("saveDocument")
    keys.reset.click()
    assert editor.action("saveDocument").shortcuts() == [QKeySequence("Ctrl+S")]
    assert editor.action("fitView").shortcuts() == []
    assert "Fit" in keys.note.text()
    keys.reset_all.click()
    assert editor.action("fitView").shortcuts() == [QKeySequence("F")]
    assert editor.action("quit").shortcuts() == [QKeySequence("Ctrl+Q")]
    assert editor.window.preferences.shortcuts == {}
    assert not keys.reset_all.isEnabled()


def test_no_keys_at_all(editor, keys):
    keys.choose("redo")
    keys.clear.click()
    assert editor.action("redo").shortcuts() == []
    assert editor.action("redo").toolTip() == "Redo the last undone step\nNothing to redo."


def test_changed_keys_are_saved(qtbot, tmp_path):
    store = tmp_path / "settings.ini"
    first = Editor(qtbot, preferences=Preferences(store))
    record(open_keys(first), "familyHermite", Qt.Key.Key_U, CTRL)
    assert first.window.preferences.shortcuts == {"familyHermite": "Ctrl+U"}
    first.window.close()
    second = Editor(qtbot, preferences=Preferences(store))
    assert second.action("familyHermite").shortcuts() == [QKeySequence("Ctrl+U")]
    assert second.action("familyHermite").toolTip().endswith("(Ctrl+U)")


def test_remembered_keys_that_make_no_sense_stop_nothing(qtbot, tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.shortcuts = {"unicorn": "Ctrl+U", "fitView": "Q", "selectAll": "Q", "quit": ""}
    editor = Editor(qtbot, preferences=preferences)
    assert editor.action("fitView").shortcuts() == [QKeySequence("Q")]
    assert editor.action("selectAll").shortcuts() == []
    assert editor.action("quit").shortcuts() == []


def test_a_saved_key_wins_over_a_newer_default_key(qtbot, tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.shortcuts = {"fitView": "Ctrl+S"}
    editor = Editor(qtbot, preferences=preferences)
    assert editor.action("fitView").shortcuts() == [QKeySequence("Ctrl+S")]
    assert editor.action("saveDocument").shortcuts() == []
    record(open_keys(editor), "quit", Qt.Key.Key_F5)
    assert preferences.shortcuts == {"fitView": "Ctrl+S", "saveDocument": "", "quit": "F5"}


@pytest.mark.parametrize(
    ("text", "key", "reason"),
    [
        ("Count", "Ctrl+S", "“Save” and “Count” both have the default key Ctrl+S."),
        ("Count", "F5, F", "“Count” and “Fit View” both have the default key F."),
        (
            "Count",
            "E",
            "“Count” cannot have its default key: E also moves the following ticks",
        ),
    ],
)
@pytest.mark.usefixtures("qapp")
def test_an_impossible_default_key_is_an_error_at_the_start(text, key, reason):
    class CountingCommands:
        @action("count", text, CURVE_SHAPE, key)
        def _count(self):
            """Count aloud."""

    with pytest.raises(ValueError, match=f"^{re.escape(reason)}"):
        MainWindow(Session(), command_sets=(*COMMAND_SETS, CountingCommands))


def test_searching_by_name_and_by_key(editor, keys):
    def visible():
        return [
            keys.table.item(row, 0).text()
            for row in range(keys.table.rowCount())
            if not keys.table.isRowHidden(row)
        ]

    QTest.keyClicks(keys.search, "ctrl+shift+s")
    assert visible() == ["Save As"]
    assert keys.current == "saveDocumentAs"
    keys.search.clear()
    QTest.keyClicks(keys.search, "pres")
    assert "Presentation" in visible()
    # Whoever comes again sees all of them.
    keys.window().close()
    open_keys(editor)
    assert len(visible()) == keys.table.rowCount()


def test_no_two_actions_have_the_same_default_key(editor):
    keymap = editor.window.actions_by_name.keymap
    for name, binding in keymap.bindings.items():
        assert keymap.is_default(name)
        for key in binding.defaults:
            assert keymap.owner_of(key) == name


def test_the_sheet_filters_events_only_while_visible(editor):
    """Hidden by anything but its own close, it went on listening to every event of the program."""
    listens = ShortcutSheet.eventFilter.__wrapped__.__code__

    def heard():
        return codes_called(lambda: QApplication.sendEvent(editor.window, QEvent(QEvent.Type.User)))

    editor.trigger("showShortcuts")
    assert listens in heard()
    editor.window.findChild(ShortcutSheet).hide()
    assert listens not in heard()


def test_the_sheet_keeps_its_field_and_its_button_without_a_match(editor):
    """The field was 6 pixels high, the button covered."""
    editor.trigger("showShortcuts")
    sheet = editor.window.findChild(QWidget, "shortcutSheet")
    search, close = (sheet.findChild(QWidget, name) for name in ("shortcutSearch", "closeShortcuts"))
    QTest.keyClicks(search, "qqqq")
    editor.settle()
    assert any("No match." in label.text() for label in sheet.findChildren(QLabel))
    assert search.height() >= search.minimumSizeHint().height()
    assert close.height() >= close.minimumSizeHint().height()
    assert sheet.rect().contains(close.geometry())
    QTest.mouseClick(close, Qt.MouseButton.LeftButton)
    assert not sheet.isVisible()
