"""Styles of their own that lines and texts have in drawings, as in Inkscape; shapes take the last one."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit

from app.document.style import LineCap, LineJoin, Style

BLUE, RED = "#0000ff", "#ff0000"
LINE = Style(stroke="#000000", cap=LineCap.BUTT, join=LineJoin.MITER, width=0.3)


@pytest.fixture
def drawing(editor):
    """A new drawing with the panel of styles."""
    editor.trigger("newDrawing")
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


def shown(editor):
    """Return what the panel says it shows, and its fill."""
    panel = editor.window
    return panel.findChild(QLabel, "styleSubject").text(), panel.findChild(QLineEdit, "fillPaintHex").text()


def rectangle(editor, x):
    editor.trigger("rectangleTool")
    editor.drag((x, 200), (x + 20, 230))
    return editor.session.document.curves[-1].style


def line(editor, x):
    """Draw one with the pen, and end it by Enter."""
    editor.trigger("addTool")
    for y in (60, 90):
        editor.click((x, y))
    editor.key(Qt.Key.Key_Return)
    return editor.session.document.curves[-1].style


def freehand(editor, x):
    editor.trigger("pencilTool")
    editor.drag((x, 100), (x + 20, 130))
    editor.wait_for_rest()
    return editor.session.document.curves[-1].style


def test_lines_begin_in_their_own_style_and_leave_that_of_shapes_alone(drawing):
    """The pen went on with the fill of the last rectangle, and the rectangle with the line of the pen."""
    rectangle(drawing, 20)
    style_set(drawing, "fillPaintHex", BLUE)
    style_set(drawing, "strokePaintHex", RED)
    filled = drawing.session.document.curves[-1].style
    assert (filled.fill, filled.stroke) == (BLUE, RED)
    assert line(drawing, 20) == LINE
    assert rectangle(drawing, 50) == filled
    assert freehand(drawing, 60) == LINE
    drawing.trigger("selectTool")
    assert rectangle(drawing, 80) == filled
    assert rectangle(drawing, 110) == filled
    # What is chosen says how the next shape looks, and no line.
    drawing.session.selected.choose({1})
    assert line(drawing, 120) == LINE
    drawing.trigger("selectTool")
    drawing.session.selected.choose({1})
    assert rectangle(drawing, 140) == LINE


def test_a_style_set_while_a_tool_is_in_use_is_that_of_what_it_draws(drawing):
    rectangle(drawing, 20)
    style_set(drawing, "fillPaintHex", BLUE)
    drawing.escape()
    drawing.trigger("selectTool")
    drawing.session.selected.choose(())
    assert shown(drawing) == ("What is drawn next", BLUE)
    steps = drawing.session.undo_stack.count()
    drawing.trigger("addTool")
    assert shown(drawing) == ("The next line", "none")
    style_set(drawing, "strokePaintHex", RED)
    assert drawing.session.undo_stack.count() == steps
    assert line(drawing, 20) == replace(LINE, stroke=RED)
    # Also of the line that was drawn just now.
    style_set(drawing, "strokeWidth", "1")
    assert drawing.session.document.curves[-1].style == replace(LINE, stroke=RED, width=1.0)
    assert freehand(drawing, 60) == replace(LINE, stroke=RED, width=1.0)
    assert rectangle(drawing, 50).fill == BLUE


def test_the_first_line_of_a_drawing_has_the_style_that_the_panel_showed(drawing):
    """The curve that a drawing begins with is empty, and has the style of what is drawn next."""
    drawing.trigger("selectTool")
    style_set(drawing, "fillPaintHex", BLUE)
    drawing.trigger("addTool")
    assert shown(drawing) == ("The next line", "none")
    assert line(drawing, 20) == LINE
    drawing.trigger("undo")
    drawing.trigger("undo")
    assert drawing.session.document.curves[0].style.fill == BLUE
    assert freehand(drawing, 20) == LINE


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
