"""Font and size of all texts that are chosen, set at once."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtTest import QTest

from app.document.contents import corners_of, plane_of
from app.features.text.type_bar import TypeBar
from tests.gui.test_contents import type_into
from tests.gui.test_text import FAMILY, FONT, choose_font

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<text x="10" y="20" font-size="8" font-family="DejaVu Sans">one</text>'
    '<g transform="scale(2)"><text x="10" y="20" font-size="6" font-family="DejaVu Serif">two <tspan'
    ' font-weight="700">bold</tspan></text></g><rect x="80" y="40" width="9" height="9"/></svg>'
)


@pytest.fixture
def bar(open_drawing):
    """What is shown for both texts and the rectangle of a drawing."""
    QFontDatabase.addApplicationFont(str(FONT))
    editor = open_drawing(DRAWING)
    editor.session.selected.choose({0, 1, 2})
    editor.window.activateWindow()
    editor.trigger("textAndFont")
    shown = editor.window.canvas.viewport().findChild(TypeBar)
    yield editor, shown
    shown.closed.emit()


def runs(editor):
    """Return words, font, weight, slant and size in the plane of all runs, text by text."""
    found = []
    for curve in editor.session.document.curves[:2]:
        scale = plane_of(curve.form, corners_of(curve)).scale
        found.append([
            (run.words, run.font[0], run.weight, run.italic, pytest.approx(run.size * scale))
            for line in curve.form.lines for run in line.runs
        ])  # fmt: skip
    return found


def test_font_and_size_of_several_texts_are_set_at_once_and_their_words_stay(bar):
    editor, shown = bar
    steps, begun = editor.session.undo_stack.count(), editor.session.document
    assert "several fonts and sizes" in shown.findChild(type(shown._remark), "typeRemark").text()
    choose_font(shown, FAMILY)
    type_into(shown.size_box.edit, "10")
    QTest.mouseClick(shown.italic, Qt.MouseButton.LeftButton)
    assert runs(editor) == [
        [("one", FAMILY, 400, True, 10)], [("two ", FAMILY, 400, True, 10), ("bold", FAMILY, 700, True, 10)]
    ]  # fmt: skip
    assert not shown._remark.isVisible()
    assert editor.session.undo_stack.count() == steps + 3
    assert editor.session.undo_stack.undoText().startswith("Italic: 2 ")
    assert editor.session.selected.chosen == {0, 1, 2}
    for _ in range(3):
        editor.trigger("undo")
    assert editor.session.document == begun
    assert shown.isVisible()


def test_a_font_that_is_pointed_at_is_seen_in_all_and_nothing_is_left_of_it(bar):
    editor, shown = bar
    begun = editor.session.document
    shown.font_box.pointed_at.emit(FAMILY)
    assert {run[1] for text in runs(editor) for run in text} == {FAMILY}
    shown.font_box.pointed_at.emit("")
    assert editor.session.document == begun


def test_it_follows_the_choice_and_goes_with_the_last_text(bar):
    editor, shown = bar
    editor.session.selected.choose({1})
    assert (float(shown.size_box.edit.text()), shown.font_box.family) == (12, "DejaVu Serif")
    type_into(shown.size_box.edit, "0")
    assert "greater than 0" in shown._remark.text()
    QTest.keyClick(shown.bold, Qt.Key.Key_Escape)
    assert not shown.isVisible()
    editor.trigger("textAndFont")
    assert shown.isVisible()
    editor.session.selected.choose({2})
    assert not shown.isVisible()
    assert not editor.action("textAndFont").isEnabled()
