"""The style of what is drawn next: that of the active curve, or what was set with nothing chosen."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit

from tests.gui.editor_facts import retype

BLUE, RED = "#0000ff", "#ff0000"


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


def test_a_shape_without_any_paint_is_no_model_of_what_is_drawn_next(empty):
    """A rectangle was drawn that nobody could see."""
    rectangle(empty, 20)
    style_set(empty, "fillPaintHex", BLUE)
    style_set(empty, "strokePaintHex", "none")
    style_set(empty, "fillPaintHex", "none")
    empty.key(Qt.Key.Key_V)
    empty.session.selected.choose(())
    drawn = rectangle(empty, 120)
    assert drawn.has_stroke or drawn.has_fill
    # With nothing chosen it is what was asked for.
    empty.key(Qt.Key.Key_V)
    empty.session.selected.choose(())
    empty.settle()
    for field in ("fillPaintHex", "strokePaintHex"):
        style_set(empty, field, "none")
    drawn = rectangle(empty, 220)
    assert not drawn.has_fill
    assert not drawn.has_stroke


def test_what_is_set_while_a_tool_holds_a_curve_that_nobody_chose_is_for_the_next_one(empty):
    first = rectangle(empty, 20)
    empty.key(Qt.Key.Key_V)
    empty.session.selected.choose(())
    style_set(empty, "strokePaintHex", RED)
    empty.trigger("addTool")
    style_set(empty, "fillPaintHex", BLUE)
    assert empty.session.document.curves[-1].style == first
    drawn = rectangle(empty, 120)
    assert (drawn.stroke, drawn.fill) == (RED, BLUE)
    # From then on it is the style of the curve that is chosen.
    empty.key(Qt.Key.Key_V)
    empty.session.selected.choose([0])
    assert empty.session.model.style == first


def test_what_is_drawn_after_a_curve_was_deleted_looks_like_it(empty):
    first = rectangle(empty, 20)
    rectangle(empty, 120)
    empty.key(Qt.Key.Key_V)
    style_set(empty, "fillPaintHex", BLUE)
    empty.session.selected.choose([1])
    empty.key(Qt.Key.Key_Delete)
    assert [curve.style for curve in empty.session.document.curves] == [first]
    assert empty.session.model.style.fill == BLUE
