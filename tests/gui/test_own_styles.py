"""Styles of their own that lines and texts have in drawings, as in Inkscape; shapes take the last one."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

BLUE, RED = "#0000ff", "#ff0000"


@pytest.fixture
def drawing(editor):
    """A new drawing with the panel of styles."""
    editor.new()
    editor.window.canvas.camera.show_box((0, 210), (0, 297))
    editor.show_dock("styleDock")
    return editor


def style_set(editor, name, text):
    """Type into a field of the panel."""
    field = editor.window.findChild(QLineEdit, name)
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    editor.window.canvas.setFocus()


def rectangle(editor, x):
    editor.trigger("rectangleTool")
    editor.drag((x, 200), (x + 20, 230))
    return editor.session.document.curves[-1].style


def test_in_a_sketch_the_pen_goes_on_with_the_last_style(editor):
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


def test_a_shape_without_any_paint_is_no_model_of_what_is_drawn_next(drawing):
    """A rectangle was drawn that nobody could see."""
    rectangle(drawing, 20)
    style_set(drawing, "fillPaintHex", BLUE)
    style_set(drawing, "strokePaintHex", "none")
    style_set(drawing, "fillPaintHex", "none")
    drawing.key(Qt.Key.Key_V)
    drawing.session.selected.choose(())
    drawn = rectangle(drawing, 120)
    assert drawn.has_stroke or drawn.has_fill
    # With nothing chosen it is what was asked for.
    drawing.key(Qt.Key.Key_V)
    drawing.session.selected.choose(())
    drawing.settle()
    for field in ("fillPaintHex", "strokePaintHex"):
        style_set(drawing, field, "none")
    drawn = rectangle(drawing, 220)
    assert not drawn.has_fill
    assert not drawn.has_stroke
