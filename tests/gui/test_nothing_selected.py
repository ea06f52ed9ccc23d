"""With nothing edited and nothing chosen, no action does anything to a curve."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QLineEdit

from app.actions.menus import ANALYSIS, CURVE, EDIT
from app.widgets.sliders import LiveSlider
from app.window.connect import all_actions

NO_CURVE = "No curve is selected. Click one, or press Ctrl+A to select all."
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier

BY_THEMSELVES = {
    *("newCurve", "pastePoints", "pasteInPlace", "pasteAsCurve"),
    *("undo", "redo", "commandPalette"),
}
"""Actions that are about the document as a whole, or add to it."""


@pytest.fixture
def none(waves):
    """Three waves, none edited and none chosen."""
    three = waves("ABC")
    three.escape()
    three.escape()
    assert not three.session.selected.is_editing
    assert not three.session.selected.whole_curves
    return three


def test_no_action_changes_an_unselected_curve(none):
    session, before, tried = none.session, none.session.document, []
    for each in all_actions():
        action = none.action(each.name)
        elsewhere = each.section.menu not in {EDIT, CURVE, ANALYSIS} or each.name in BY_THEMSELVES
        if elsewhere or action.text().endswith("…") or each.field:
            continue
        session.selected.select_whole(())
        if action.isEnabled():
            action.trigger()
            session.interrupt()
            tried.append(each.name)
            assert session.document is before, each.name
    assert len(tried) > 20


KEYS_OF_CURVES = [
    (Qt.Key.Key_Delete, SHIFT),
    (Qt.Key.Key_C, Qt.KeyboardModifier.NoModifier),
    (Qt.Key.Key_1, Qt.KeyboardModifier.NoModifier),
    (Qt.Key.Key_H, CTRL),
    (Qt.Key.Key_R, CTRL),
]


def test_a_key_of_a_curve_is_refused_without_a_selection(none):
    for key, held in KEYS_OF_CURVES:
        before = none.session.document
        none.key(key, held)
        assert none.session.document is before, key
        assert none.status == NO_CURVE, key
        assert none.window.status_line.is_refusal, key
        none.window.status_line.clear_message()


def test_the_menu_of_curves_is_disabled_with_the_reason(none):
    offered = [each.name for each in all_actions() if each.section.needs is CURVE.needs]
    assert {"deleteCurve", "splitCurve", "joinCurve", "closeCurve", "lowerCurve"} < set(offered)
    for name in offered:
        assert not none.action(name).isEnabled(), name
        assert none.action(name).toolTip().endswith(NO_CURVE), name
    none.session.selected.select_whole((0,))
    assert none.action("deleteCurve").isEnabled()
    assert NO_CURVE not in none.action("deleteCurve").toolTip()
    none.trigger("deleteCurve")
    assert [curve.name for curve in none.session.document.curves] == ["B", "C"]


def test_the_toolbar_and_the_form_are_empty_and_disabled_without_a_curve(none):
    find, session = none.window.findChild, none.session
    box, slider = find(QComboBox, "parametrizationBox"), find(LiveSlider, "alphaSlider")
    name, start = find(QLineEdit, "curveName"), find(QLineEdit, "intervalStart")
    rule, facts = find(QComboBox, "velocityRule"), find(QLabel, "curveFacts")
    none.show_dock("curveDock")
    before = session.document
    for each in (box, slider, name, start, rule):
        QTest.mouseClick(each, Qt.MouseButton.LeftButton)
        QTest.keyClicks(each, "7")
        QTest.keyClick(each, Qt.Key.Key_Down)
        QTest.keyClick(each, Qt.Key.Key_Return)
        assert not each.isEnabled()
    assert session.document is before
    assert (box.currentIndex(), name.text(), start.text(), rule.currentIndex()) == (-1, "", "", -1)
    assert facts.text() == box.toolTip() == NO_CURVE
    assert not none.action("familyHermite").isChecked()
    session.selected.select_whole((1,))
    assert (box.currentText(), name.text(), start.text()) == ("Chord length", "B", "0")
    assert none.action("familyHermite").isChecked()
    name.selectAll()
    none.type_text(name, "Leaf\r")
    assert session.document.curves[1].name == "Leaf"


def test_enter_edits_the_selected_curve_after_the_pointer_has_left(none):
    """It sought a point below a pointer at infinity, and warned of numbers that are none."""
    none.hover(none.point(1))
    QApplication.sendEvent(none.window.canvas, QEvent(QEvent.Type.Leave))
    none.session.selected.select_whole((1,))
    none.key(Qt.Key.Key_Return)
    assert (none.session.selected.active_curves, none.session.selection) == ({1}, frozenset())
    assert none.status == "Editing “B”."


def test_in_a_blank_document_there_is_no_curve_to_choose_and_the_family_is_free(editor):
    editor.new()
    editor.trigger("selectTool")
    editor.escape()
    editor.escape()
    assert not editor.session.selected.marked
    editor.key(Qt.Key.Key_3)
    assert editor.curve.family.name == "quintic_hermite"


def test_a_digit_key_keeps_selected_curves_and_the_toolbar_changes_their_family(none):
    none.session.selected.select_whole((0, 2))
    before = none.session.document
    none.key(Qt.Key.Key_5)
    assert none.session.document is before
    assert none.status == (
        "Press Enter to edit “A”; then the same key makes it septic Hermite. "
        "The toolbar changes all selected curves."
    )
    none.trigger("familySepticHermite")
    families = [curve.family.name for curve in none.session.document.curves]
    assert families == ["septic_hermite", "hermite", "septic_hermite"]
    none.trigger("undo")
    none.session.selected.activate(2)
    none.key(Qt.Key.Key_5)
    assert none.curve.family.name == "septic_hermite"


def test_a_digit_key_changes_the_family_of_one_selected_curve(none):
    """It was refused, though the toolbar did it."""
    none.session.selected.select_whole((1,))
    none.key(Qt.Key.Key_3)
    families = [curve.family.name for curve in none.session.document.curves]
    assert families == ["hermite", "quintic_hermite", "hermite"]
    assert none.session.selected.whole_curves == {1}


def test_a_single_curve_can_be_selected_with_select_all(waves):
    """It said that none was left to choose, beside "Nothing is chosen"."""
    one = waves("A")
    one.escape()
    one.escape()
    assert not one.session.selected.marked
    one.key(Qt.Key.Key_A, CTRL | SHIFT)
    assert one.session.selected.whole_curves == {0}


def test_measuring_activates_no_curve(none):
    """M, S, 1.5 and Enter scaled the curve that was edited last."""
    for key in (Qt.Key.Key_G, Qt.Key.Key_S, Qt.Key.Key_R, Qt.Key.Key_H):
        before = none.session.document
        none.key(Qt.Key.Key_M)
        none.drag((0.0, 0.0), (1.0, 1.0))
        none.key(key)
        none.type_amount("1.5")
        none.key(Qt.Key.Key_Return)
        assert none.session.document is before, key
        assert not none.session.selected.marked, key


def test_measuring_keeps_the_selection(none):
    none.session.selected.select_whole((0, 1))
    none.key(Qt.Key.Key_M)
    assert none.session.selected.whole_curves == {0, 1}
    none.session.selected.activate(2)
    none.key(Qt.Key.Key_V)
    none.key(Qt.Key.Key_M)
    assert none.session.selected.active_curves == {2}
