"""The style of what is drawn next: that of the active curve, or what was set with nothing chosen."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QLineEdit

from app.features.import_export.commands import ImportCommands
from tests.gui.editor_facts import retype

BLUE, RED, GREEN = "#0000ff", "#ff0000", "#008000"
SQUARES = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="2in" height="1in" viewBox="0 0 20 10"><g fill="#f00">'
    '<path d="M0 0H8V8Z"/><path d="M10 0H18V8Z"/></g></svg>'
)


@pytest.fixture
def empty(editor):
    """A new document with the panel of styles."""
    editor.new()
    editor.window.canvas.camera.show_box((0, 210), (0, 297))
    editor.show_dock("styleDock")
    return editor


def style_set(editor, name, text):
    """Type into a field of the panel."""
    field = editor.window.findChild(QLineEdit, name)
    retype(field, text)
    editor.window.canvas.setFocus()


def rectangle(editor, x):
    editor.trigger("rectangleTool")
    editor.drag((x, 200), (x + 20, 230))
    return editor.session.document.curves[-1].style


def test_the_pen_continues_with_the_last_style(editor):
    editor.show_dock("styleDock")
    editor.trigger("newCurve")
    editor.trigger("addTool")
    style_set(editor, "fillPaintHex", BLUE)
    for x in (0, 3):
        editor.click((x, 4))
    editor.key(Qt.Key.Key_Return)
    for x in (1, 4):
        editor.click((x, 5))
    assert [curve.style.fill for curve in editor.session.document.curves[-2:]] == [BLUE, BLUE]


def test_a_shape_without_paint_does_not_set_the_next_style(empty):
    """A rectangle was drawn that nobody could see."""
    rectangle(empty, 20)
    style_set(empty, "fillPaintHex", BLUE)
    style_set(empty, "strokePaintHex", "none")
    style_set(empty, "fillPaintHex", "none")
    empty.key(Qt.Key.Key_V)
    empty.session.selected.select_whole(())
    drawn = rectangle(empty, 120)
    assert drawn.has_stroke or drawn.has_fill
    # With nothing chosen it is what was asked for.
    empty.key(Qt.Key.Key_V)
    empty.session.selected.select_whole(())
    empty.settle()
    for field in ("fillPaintHex", "strokePaintHex"):
        style_set(empty, field, "none")
    drawn = rectangle(empty, 220)
    assert not drawn.has_fill
    assert not drawn.has_stroke


def test_a_style_set_without_a_selection_is_that_of_the_next_curve(empty):
    first = rectangle(empty, 20)
    empty.key(Qt.Key.Key_V)
    empty.session.selected.select_whole(())
    style_set(empty, "strokePaintHex", RED)
    empty.trigger("addTool")
    style_set(empty, "fillPaintHex", BLUE)
    assert empty.session.document.curves[-1].style == first
    drawn = rectangle(empty, 120)
    assert (drawn.stroke, drawn.fill) == (RED, BLUE)
    # From then on it is the style of the curve that is chosen.
    empty.key(Qt.Key.Key_V)
    empty.session.selected.select_whole([0])
    assert empty.session.template_curve.style == first


def test_the_next_curve_has_the_style_of_a_deleted_one(empty):
    first = rectangle(empty, 20)
    rectangle(empty, 120)
    empty.key(Qt.Key.Key_V)
    style_set(empty, "fillPaintHex", BLUE)
    empty.session.selected.select_whole([1])
    empty.key(Qt.Key.Key_Delete)
    assert [curve.style for curve in empty.session.document.curves] == [first]
    assert empty.session.template_curve.style.fill == BLUE


@pytest.fixture
def imported(empty, tmp_path, drawings_read_here):
    """A green rectangle, and a drawing of two red squares that was imported after it."""
    rectangle(empty, 20)
    style_set(empty, "fillPaintHex", GREEN)
    empty.key(Qt.Key.Key_V)
    path = tmp_path / "squares.svg"
    path.write_text(SQUARES, encoding="utf-8")
    empty.window.commands[ImportCommands].import_files([path])
    empty.wait_for_work()
    dialog = empty.window.findChild(QDialog, "importDrawingDialog")
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    empty.settle()
    assert [curve.style.fill for curve in empty.session.document.curves] == [GREEN, RED, RED]
    empty.window.activateWindow()
    empty.window.canvas.setFocus()
    empty.settle()
    return empty


@pytest.mark.parametrize("escape", [True, False])
def test_an_import_does_not_change_the_next_style(imported, escape):
    """It looked like the first shape that was imported."""
    if escape:
        imported.key(Qt.Key.Key_Escape)
    imported.key(Qt.Key.Key_P)
    imported.window.canvas.camera.show_box((0, 210), (0, 297))
    for place in ((100, 250), (140, 270)):
        imported.click(place)
    assert [curve.style.fill for curve in imported.session.document.curves[3:]] == [GREEN]


def test_an_undone_import_does_not_change_the_next_style(imported):
    imported.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert len(imported.session.document.curves) == 1
    assert rectangle(imported, 120).fill == GREEN


def test_a_selected_imported_curve_sets_the_next_style(imported):
    imported.session.selected.select_whole([1])
    assert rectangle(imported, 120).fill == RED
