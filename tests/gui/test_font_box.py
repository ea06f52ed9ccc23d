"""The list of fonts: searched by typing any part of a name, with those used before at the top."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtTest import QTest

from app.features.text.commands import TextCommands
from app.features.text.font_box import FontBox

FONTS = ["DejaVu Sans", "DejaVu Sans Mono", "DejaVu Serif"]


@pytest.fixture
def box(qtbot):
    """A list of fonts, shown, with what it tells."""
    if not {*FONTS} <= {*QFontDatabase.families()}:
        pytest.skip("DejaVu is not installed")
    made = FontBox("DejaVu Sans")
    qtbot.addWidget(made)
    made.told = []
    made.picked.connect(lambda family: made.told.append(("picked", family)))
    made.pointed_at.connect(lambda family: made.told.append(("seen", family)))
    made.show()
    qtbot.waitExposed(made)
    made.lineEdit().setFocus()
    made.lineEdit().selectAll()
    return made


def listed(box):
    return [box.itemText(at) for at in range(box.count())]


def test_any_part_of_a_name_finds_it_and_one_pointed_at_is_seen(box):
    """Only the beginning did, and keys went through all fonts from the one before."""
    QTest.keyClicks(box.lineEdit(), "vu ser")
    found = box.completer().popup()
    assert found.isVisible()
    QTest.keyClick(found, Qt.Key.Key_Down)
    assert (box.family, box.told) == ("DejaVu Serif", [("seen", "DejaVu Serif")])
    QTest.keyClick(found, Qt.Key.Key_Escape)
    assert box.family == "DejaVu Sans"
    assert box.told[-1] == ("seen", "")
    box.lineEdit().selectAll()
    QTest.keyClicks(box.lineEdit(), "sans mono")
    QTest.keyClick(found, Qt.Key.Key_Down)
    QTest.keyClick(found, Qt.Key.Key_Return)
    assert (box.family, box.told[-1][0]) == (box.currentText(), "picked")
    assert "Sans Mono" in box.family


def test_enter_takes_the_first_and_what_is_no_font_is_none(box):
    QTest.keyClicks(box.lineEdit(), "dejavu ser")
    QTest.keyClick(box.lineEdit(), Qt.Key.Key_Return)
    assert (box.family, box.currentText(), box.told) == (
        "DejaVu Serif",
        "DejaVu Serif",
        [("picked", "DejaVu Serif")],
    )
    for typed in ("no such font", ""):
        box.lineEdit().selectAll()
        QTest.keyClicks(box.lineEdit(), typed or "\b")
        QTest.keyClick(box.lineEdit(), Qt.Key.Key_Return)
        assert (box.family, box.currentText(), len(box.told)) == ("DejaVu Serif", "DejaVu Serif", 1)
    box.lineEdit().selectAll()
    QTest.keyClicks(box.lineEdit(), "half")
    box.completer().popup().hide()
    box.clearFocus()
    assert (box.family, box.currentText()) == ("DejaVu Serif", "DejaVu Serif")


def test_a_name_that_stands_for_another_font_is_shown_as_it_is_kept(box):
    """“Noto Sans Mono” was shown, and “Monospace” written."""
    for family in ("Monospace", "No Such Font", "DejaVu Serif"):
        box.take(family)
        assert (box.family, box.currentText()) == (family, family)


def test_some_are_listed_before_all_others_once(box):
    before = listed(box)
    box.offer_first(["DejaVu Serif", "No Such Font", "DejaVu Sans Mono", "DejaVu Serif"])
    assert listed(box)[:2] == ["DejaVu Serif", "DejaVu Sans Mono"]
    assert sorted(listed(box)) == sorted(before)
    assert (box.family, box.currentText()) == ("DejaVu Sans", "DejaVu Sans")


def test_the_fonts_chosen_last_and_those_of_the_document_are_offered_first(open_drawing):
    editor = open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
        '<text x="10" y="30" font-family="DejaVu Serif" font-size="10">abc</text></svg>'
    )
    editor.window.activateWindow()
    editor.session.selected.choose({0})
    editor.trigger("editText")
    field = editor.window.commands[TextCommands].field
    assert listed(field.font_box)[0] == "DejaVu Serif"
    field.font_box.setFocus()
    field.font_box.lineEdit().selectAll()
    QTest.keyClicks(field.font_box.lineEdit(), "dejavu sans mono")
    QTest.keyClick(field.font_box.lineEdit(), Qt.Key.Key_Return)
    QTest.keyClick(field.words, Qt.Key.Key_Escape)
    assert editor.session.document.curves[0].form.lines[0].runs[0].font == ("DejaVu Sans Mono",)
    editor.session.undo_stack.undo()
    editor.session.selected.choose({0})
    editor.trigger("editText")
    assert listed(field.font_box)[:2] == ["DejaVu Sans Mono", "DejaVu Serif"]
    QTest.keyClick(field.words, Qt.Key.Key_Escape)
