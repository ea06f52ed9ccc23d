"""Preferences: not modal, in force at once, remembered."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox, QFormLayout, QLabel, QLineEdit, QPushButton

from app.appearance.theme import ThemeMode, theme_of
from app.canvas.grid_layer import grid_steps
from app.document.transforms import Reference
from app.document.words import NamedEnum
from app.plotting.ticks import tick_labels
from app.settings.kinds import Choice, Distance, Several, Text, settings_with_labels
from app.settings.preferences import Preferences
from app.testing import Editor
from app.tools.snapping import SnapKind
from app.window.preferences_dialog import PreferencesDialog
from tests.gui.editor_facts import retype


@pytest.fixture
def dialog(editor):
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_Comma, Qt.KeyboardModifier.ControlModifier)
    dialog = editor.window.findChild(PreferencesDialog)
    assert dialog.isVisible()
    assert not dialog.isModal()
    yield dialog
    dialog.hide()


def themes(dialog):
    return dialog.findChild(QComboBox, "themeBox")


def units(dialog):
    return dialog.findChild(QComboBox, "unitBox")


def spacing(dialog):
    return dialog.findChild(QLineEdit, "gridSpacing")


def pointer_position(editor):
    editor.wait_for_rest()
    return editor.window.status_line.findChild(QLabel, "pointerPlace").text()


def test_the_theme_changes_at_once(editor, dialog):
    themes(dialog).setFocus()
    QTest.keyClick(themes(dialog), Qt.Key.Key_End)
    assert editor.window.preferences.theme_mode is ThemeMode.DARK
    assert theme_of(editor.window.palette()).name == "dark"
    assert editor.action("themeDark").isChecked()
    QTest.keyClick(themes(dialog), Qt.Key.Key_Home)
    assert editor.window.preferences.theme_mode is ThemeMode.SYSTEM


def test_the_button_and_escape_close_the_dialog_and_enter_does_not(editor, dialog):
    button = dialog.findChild(QPushButton, "closePreferences")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert not dialog.isVisible()
    for field in (themes(dialog), spacing(dialog), units(dialog), button):
        editor.trigger("preferences")
        assert dialog.isVisible()
        field.setFocus()
        QTest.keyClick(field, Qt.Key.Key_Return)
        assert dialog.isVisible()
        QTest.keyClick(field, Qt.Key.Key_Escape)
        assert not dialog.isVisible()


def test_the_unit_is_that_of_new_documents(editor, dialog):
    retype(units(dialog).lineEdit(), "mm")
    assert editor.window.preferences.unit_name == "mm"
    editor.hover((1.5, 1.0))
    assert "mm" not in pointer_position(editor)
    before = editor.session.document
    editor.window.context.files.new()
    assert (before.unit, editor.session.document.unit) == ("", "mm")
    editor.hover((1.0, 1.0))
    assert pointer_position(editor).count(" mm") == 2
    retype(units(dialog).lineEdit(), "none")
    assert editor.window.preferences.unit_name == ""
    assert pointer_position(editor).count(" mm") == 2


def test_a_click_selects_the_unit_and_an_unknown_one_gets_a_note(editor, dialog):
    line, note = units(dialog).lineEdit(), dialog.findChild(QLabel, "unitBoxNote")
    for typed, is_told in (("parsec", True), ("cm", False)):
        spacing(dialog).setFocus()
        QTest.mouseClick(line, Qt.MouseButton.LeftButton)
        QTest.keyClicks(line, typed)
        QTest.keyClick(line, Qt.Key.Key_Return)
        assert editor.window.preferences.unit_name == typed
        assert note.isVisible() is is_told
    assert not note.text()


def test_a_grid_spacing_is_typed_as_an_expression_and_can_be_adaptive_again(editor, dialog):
    retype(spacing(dialog), "1/4")
    assert editor.window.preferences.grid_spacing == 0.25
    assert editor.session.document.grid_spacing == 0.0
    assert spacing(dialog).text() == "0.25"
    retype(spacing(dialog), "adaptive")
    assert editor.window.preferences.grid_spacing == 0
    assert spacing(dialog).text() == "adaptive"
    assert dialog.isVisible()


@pytest.mark.parametrize("typed", ["-1", "0", "wide"])
def test_a_spacing_that_cannot_be_is_explained(editor, dialog, typed):
    retype(spacing(dialog), typed)
    assert dialog.findChild(QLabel, "preferencesProblem").text().startswith("⚠")
    assert editor.window.preferences.grid_spacing == 0
    QTest.keyClick(spacing(dialog), Qt.Key.Key_Escape)
    assert spacing(dialog).text() == "adaptive"
    assert dialog.findChild(QLabel, "preferencesProblem").text() == ""


def test_targets_of_snapping_are_preferences(editor, dialog):
    assert editor.window.preferences.snap_kinds == frozenset(SnapKind)
    dialog.findChild(QCheckBox, "snap_curves").click()
    assert editor.window.preferences.snap_kinds == frozenset(SnapKind) - {"curves"}
    dialog.findChild(QCheckBox, "snap_curves").click()
    assert editor.window.preferences.snap_kinds == frozenset(SnapKind)


def rows_of(dialog):
    """The labels of the form, each with the objectName beside it."""
    form = dialog.tabs.widget(0).layout()
    field = QFormLayout.ItemRole.FieldRole
    widgets = [form.itemAt(row, field).widget() for row in range(form.rowCount())]
    labels = [form.labelForField(widget) for widget in widgets]
    return [
        (label.text() if label and not place else "", part.objectName())
        for label, each in zip(labels, widgets, strict=True)
        for place, part in enumerate(each.findChildren(QCheckBox) or [each])
    ]


def test_the_rows_are_in_the_order_of_the_settings(dialog):
    names = [kind.value for kind in SnapKind]
    labels = ["Snap to", *[""] * (len(names) - 1)]
    kinds = list(zip(labels, map("snap_{}".format, names), strict=True))
    assert rows_of(dialog)[: 5 + len(kinds)] == [
        ("Theme", "themeBox"),
        ("Unit of new documents", "unitBox"),
        ("", "unitBoxNote"),
        ("Grid of new documents", "gridSpacing"),
        ("", "preferencesProblem"),
        *kinds,
    ]


class Shape(NamedEnum):
    ROUND = "round", "Round"
    FLAT = "flat", "Flat"


class _WithMore(Preferences):
    """What it takes to add a setting of each kind: its line."""

    shape = Choice("tests/shape", Shape.ROUND, "Shape", "The shape of the sound")
    shapes = Several("tests/shapes", Shape, "Shapes", "Take this one: {}", "shape_{}")
    reach = Distance("tests/reach", "Reach", "How far it goes", none="far", refusal="It needs a reach.")
    call = Text("tests/call", "Call", "What is called", longest=5, usual=("nothing", "hey"))
    align_to = Choice("tests/align", Reference.EACH_OTHER, "Align to", "A state of the window")


def test_a_declared_setting_is_displayed_applied_at_once_and_saved(qtbot, store):
    """The windows of one more person, for the dialog reads the class of the preferences."""
    preferences = _WithMore(store)
    editor = Editor(qtbot, preferences=preferences)
    editor.trigger("preferences")
    dialog = editor.window.findChild(PreferencesDialog)
    labels = [label for label, _ in rows_of(dialog)]
    assert [each for each in labels if each in {"Shape", "Shapes", "Reach", "Call"}] == [
        *("Shape", "Shapes", "Reach", "Call")
    ]
    QTest.keyClick(dialog.findChild(QComboBox, "preference_shape"), Qt.Key.Key_End)
    dialog.findChild(QCheckBox, "shape_round").click()
    retype(dialog.findChild(QLineEdit, "preference_reach"), "1/4")
    retype(dialog.findChild(QComboBox, "preference_call").lineEdit(), "hello, you")
    chosen = (Shape.FLAT, {Shape.FLAT}, 0.25, "hello")
    for each in (preferences, _WithMore(store)):
        assert (each.shape, each.shapes, each.reach, each.call) == chosen
    # What is also a state of the window changes that.
    state = editor.window.context.store
    assert state.state.align_to is Reference.EACH_OTHER
    QTest.keyClick(dialog.findChild(QComboBox, "preference_align_to"), Qt.Key.Key_Down)
    assert state.state.align_to is list(Reference)[1]


def test_saved_window_settings_are_not_in_the_dialog():
    named = settings_with_labels(Preferences)
    assert list(named)[:3] == ["theme_mode", "unit_name", "grid_spacing"]
    for name in ("window_geometry", "shortcuts", "snap_on", "export_choice", "last_folder"):
        assert name not in named


@pytest.mark.parametrize("decades", range(-8, 9))
def test_a_grid_of_fixed_spacing_is_never_too_dense(decades):
    coarse, fine = grid_steps(0.3, 10.0**decades)
    assert fine * 10.0**decades >= 8 - 1e-9 or fine == 0.3
    assert fine >= 0.3 * (1 - 1e-12)
    assert round(coarse / fine) in (5, 10)
    if fine > 0.3:
        # The next finer choice would have been too dense.
        assert fine * 10.0**decades < 8 * 2.6


def test_the_lines_lie_at_the_spacing(editor):
    canvas = editor.window.canvas
    canvas.drawing.grid.set_spacing(0.3)
    editor.settle()
    assert canvas.drawing.grid.steps == pytest.approx((3.0, 0.3))
    ticks = canvas.getAxis("bottom").ticks_in(canvas.pixel_map)
    assert len(ticks.marks) > 5
    for tick, _ in ticks.labels:
        assert abs(tick / 0.3 - round(tick / 0.3)) < 1e-9
    # Rulers have finer marks between those of the lines.
    marks = [tick / 0.3 for tick, _ in ticks.marks]
    lines = [each for each in marks if abs(each - round(each)) < 1e-9]
    assert [round(each) for each in sorted(lines)] == list(range(round(min(lines)), round(max(lines)) + 1))
    editor.wheel((1, 1), -12)
    assert canvas.drawing.grid.steps[1] > 0.3
    canvas.drawing.grid.set_spacing(0.0)
    editor.settle()


def test_the_labels_of_a_fixed_grid_are_exact(editor):
    # pyqtgraph alone writes 0.2, 0.5, 0.8.
    assert tick_labels([0.25, 0.5, 0.75, -1.25], 1.0, 0.25) == ["0.25", "0.5", "0.75", "−1.25"]
    assert tick_labels([0.3 - 0.1 * 3, 3 * 0.1], 1.0, 0.1) == ["0", "0.3"]
    canvas = editor.window.canvas
    own = canvas.getAxis("left").ticks_in(canvas.pixel_map)
    canvas.drawing.grid.set_spacing(0.25)
    found = canvas.getAxis("left").ticks_in(canvas.pixel_map)
    assert len(found.labels) > len(own.labels)
    for place, text in found.labels:
        assert float(text.replace("−", "-")) == place
    editor.settle()
    canvas.drawing.grid.set_spacing(0.0)
    assert canvas.getAxis("left").ticks_in(canvas.pixel_map) == own


@pytest.fixture
def store(tmp_path):
    return tmp_path / "settings.ini"


def test_changed_preferences_are_saved(store):
    first = Preferences(store)
    assert (first.grid_spacing, first.unit_name, first.snap_kinds) == (0.0, "", frozenset(SnapKind))
    first.grid_spacing, first.unit_name, first.snap_kinds = 1 / 3, "cm", frozenset({"grid", "points"})
    first.shortcuts = {"undo": "Ctrl+U"}
    del first
    second = Preferences(store)
    assert (second.grid_spacing, second.unit_name) == (1 / 3, "cm")
    assert second.snap_kinds == {"grid", "points"}
    assert second.shortcuts == {"undo": "Ctrl+U"}
    second.snap_kinds = frozenset()
    assert second.snap_kinds == frozenset()
    assert second.complaint == ""


@pytest.mark.parametrize(
    ("line", "key"),
    [
        ("[grid]\nspacing=wide", "grid/spacing"),
        ("[grid]\nspacing=-1", "grid/spacing"),
        ("[grid]\nspacing=nan", "grid/spacing"),
        ("[snap]\nkinds=unicorns", "snap/kinds"),
        ("[General]\nshortcuts=[1]", "shortcuts"),
        ("[General]\nshortcuts={", "shortcuts"),
    ],
)
def test_an_invalid_setting_counts_as_not_set(store, line, key):
    store.write_text(line)
    preferences = Preferences(store)
    assert preferences.grid_spacing == 0.0
    assert preferences.snap_kinds == frozenset(SnapKind)
    assert preferences.shortcuts == {}
    assert key in preferences.complaint


def test_the_dialog_is_no_larger_than_its_pages(editor, dialog):
    """Its lower half was empty."""
    editor.settle()
    assert dialog.height() == dialog.sizeHint().height()
    last = dialog.findChild(QComboBox, "pencilBox")
    assert last.mapTo(dialog, last.rect().bottomLeft()).y() > dialog.height() / 2
