"""The style of what is drawn next: that of the active curve, or what was set with nothing chosen."""

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


def test_the_pen_goes_on_with_the_last_style(editor):
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


def test_what_is_set_while_a_tool_holds_a_curve_that_nobody_chose_is_for_the_next_one(drawing):
    first = rectangle(drawing, 20)
    drawing.key(Qt.Key.Key_V)
    drawing.session.selected.choose(())
    style_set(drawing, "strokePaintHex", RED)
    drawing.trigger("addTool")
    style_set(drawing, "fillPaintHex", BLUE)
    assert drawing.session.document.curves[-1].style == first
    drawn = rectangle(drawing, 120)
    assert (drawn.stroke, drawn.fill) == (RED, BLUE)
    # From then on it is the style of the curve that is chosen.
    drawing.key(Qt.Key.Key_V)
    drawing.session.selected.choose([0])
    assert drawing.session.model.style == first


def test_what_is_drawn_after_a_curve_was_deleted_looks_like_it(drawing):
    first = rectangle(drawing, 20)
    rectangle(drawing, 120)
    drawing.key(Qt.Key.Key_V)
    style_set(drawing, "fillPaintHex", BLUE)
    drawing.session.selected.choose([1])
    drawing.key(Qt.Key.Key_Delete)
    assert [curve.style for curve in drawing.session.document.curves] == [first]
    assert drawing.session.model.style.fill == BLUE
