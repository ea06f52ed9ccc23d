"""The unit and the grid of a document, and what a new one begins with."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QPushButton, QWidget

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.document.several_curves import set_style
from app.document.style import Style
from app.families import FAMILIES, LAGRANGE
from app.settings.preferences import Preferences
from app.testing import Editor


@pytest.fixture
def panel(editor):
    editor.session.commit(Document((make_curve([(0, 0), (3, 1)], name="Line"),)), "Begin")
    editor.fit()
    editor.key(Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    found = editor.window.findChild(QWidget, "documentPanel")
    assert found.isVisible()
    return found


def retype(editor, line, text):
    line.setFocus()
    line.selectAll()
    editor.type_text(line, text)
    QTest.keyClick(line, Qt.Key.Key_Return)
    editor.settle()


def unit_line(panel):
    return panel.findChild(QComboBox, "documentUnit").lineEdit()


def test_the_unit_is_a_step_of_the_history_and_the_numbers_stay(editor, panel):
    points = editor.curve.points
    retype(editor, unit_line(panel), "mm")
    assert (editor.session.document.unit, editor.curve.points) == ("mm", points)
    assert editor.session.undo_stack.undoText() == "Set the unit"
    assert editor.status == "Lengths are now in mm; the numbers are unchanged."
    editor.hover((1.5, 0.5))
    assert editor.window.context.status_line.readouts.unit == "mm"
    assert editor.window.canvas.drawing.units.text(editor.window.canvas.pixel_map) == "mm"
    editor.trigger("undo")
    assert editor.session.document.unit == ""
    assert editor.window.context.status_line.readouts.unit == ""
    assert unit_line(panel).text() == "none"


def test_a_click_selects_the_unit_for_typing(editor, panel):
    line = unit_line(panel)
    assert line.text() == "none"
    QTest.mouseClick(line, Qt.MouseButton.LeftButton)
    assert line.selectedText() == "none"
    editor.type_text(line, "mm")
    QTest.keyClick(line, Qt.Key.Key_Return)
    editor.settle()
    assert (line.text(), editor.session.document.unit) == ("mm", "mm")
    # In a line that has the cursor a click puts it elsewhere.
    QTest.mouseClick(line, Qt.MouseButton.LeftButton)
    assert not line.hasSelectedText()


def test_an_unknown_unit_stays_and_gets_a_note(editor, panel):
    note = panel.findChild(QLabel, "documentUnitNote")
    retype(editor, unit_line(panel), "mm")
    assert not note.isVisible()
    retype(editor, unit_line(panel), "nonemm")
    assert editor.session.document.unit == "nonemm"
    assert note.isVisible()
    assert note.text().startswith("“nonemm” is not a known unit of length")
    assert note.text() in editor.status
    editor.trigger("undo")
    assert not note.isVisible()


def test_the_grid_is_a_step_of_the_history(editor, panel):
    line = panel.findChild(QLineEdit, "documentGrid")
    retype(editor, line, "1/4")
    assert editor.session.document.grid_spacing == editor.window.canvas.tools.canvas.grid_spacing() == 0.25
    retype(editor, line, "-1")
    assert panel.findChild(QLabel, "preferencesProblem").text().startswith("⚠")
    assert editor.session.document.grid_spacing == 0.25
    QTest.keyClick(line, Qt.Key.Key_Escape)
    editor.trigger("undo")
    assert editor.session.document.grid_spacing == 0.0
    assert line.text() == "adaptive"


def test_each_document_has_its_own_settings(editor, panel, tmp_path):
    retype(editor, unit_line(panel), "in")
    editor.session.save(tmp_path / "a.curve.json")
    editor.session.new()
    assert editor.window.context.status_line.readouts.unit == ""
    editor.session.open(tmp_path / "a.curve.json")
    assert editor.window.context.status_line.readouts.unit == "in"
    assert editor.window.preferences.unit_name == ""


def test_new_documents_use_the_settings_saved_for_them(editor, panel):
    retype(editor, unit_line(panel), "mm")
    editor.set_grid(0.5)
    style = Style(stroke="#0072b2", width=0.3)
    editor.session.change("Style", lambda d: set_style(d, [0], stroke="#0072b2", width=0.3))
    QTest.mouseClick(panel.findChild(QPushButton, "useForNew"), Qt.MouseButton.LeftButton)
    assert "“mm”, a grid of 0.5 mm" in panel.findChild(QLabel, "newDocuments").text()
    editor.session.new()
    document = editor.session.document
    assert (document.unit, document.grid_spacing, document.curves[0].style) == ("mm", 0.5, style)


def test_the_first_sketch_has_the_unit_of_new_documents(qtbot, tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.unit_name = "mm"
    editor = Editor(qtbot, preferences=preferences)
    assert editor.session.document.unit == "mm"
    assert not editor.session.files.is_modified


def test_a_new_document_uses_the_last_family(qtbot, tmp_path):
    bezier, spline = FAMILIES.named("bezier"), FAMILIES.named("b_spline")
    preferences = Preferences(tmp_path / "settings.ini")
    editor = Editor(qtbot, preferences=preferences)
    editor.choose_family(bezier)
    editor.choose_parametrization(ParametrizationKind.CENTRIPETAL)
    editor.new()
    assert (editor.curve.family, editor.curve.points, editor.curve.name) == (bezier, (), "Curve 1")
    assert editor.curve.parametrization == Parametrization(ParametrizationKind.CENTRIPETAL)
    editor.choose_family(spline)
    editor.session.files.give_up_changes()
    editor.window.close()
    editor = Editor(qtbot, preferences=preferences)
    assert editor.curve.family is LAGRANGE, "the first sketch stays what it is"
    editor.new()
    assert editor.curve.family is spline
    preferences.file.write("document/new_curve", "{}")
    editor.new()
    assert editor.curve.family is LAGRANGE
    assert "curve" in preferences.complaint


def test_an_unreadable_style_in_the_settings_becomes_the_default_style(tmp_path):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.file.write("document/new_style", '{"stroke": "blue"}')
    assert preferences.new_style == Style()
    assert "style" in preferences.complaint
