"""A press, a drag or a right click on a curve that is not the one edited acts on it at once; real events."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def three(waves):
    """Three waves one above the other, A below, C on top; B is active."""
    return waves("ABC")


def on_curve(editor, row, t=0.45):
    x, y = editor.session.views[row].curve.evaluate(t)
    return float(x), float(y)


def entries(menu):
    return {entry.objectName(): entry.isEnabled() for entry in menu.actions() if entry.objectName()}


def close(editor):
    QTest.keyClick(editor.menu(), Qt.Key.Key_Escape)


def test_a_press_edits_it_and_the_drag_bends_it(three):
    before, steps = three.session.document, three.session.undo_stack.count()
    x, y = on_curve(three, 2)
    three.press((x, y))
    assert three.curve.name == "C"
    three.move((x, y + 0.4))
    assert three.status.startswith("Bend at t = 0.45")
    three.release((x, y + 0.4))
    assert on_curve(three, 2)[1] == pytest.approx(y + 0.4, abs=2 * three.pixel)
    assert three.session.undo_stack.count() == steps + 1
    assert three.session.undo_stack.undoText().startswith("Bend curve at t = 0.45")
    assert three.session.document.curves[:2] == before.curves[:2]
    three.trigger("undo")
    assert three.session.document == before
    assert three.curve.name == "C"


def test_a_drag_of_its_point_moves_the_point(three):
    steps = three.session.undo_stack.count()
    three.drag((2, 6), (2.3, 6.6))
    assert three.curve.name == "C"
    assert three.point(2) == pytest.approx((2.3, 6.6), abs=2 * three.pixel)
    assert three.session.selection == {2}
    assert three.session.undo_stack.count() == steps + 1
    assert three.session.undo_stack.undoText() == "Move point 2"


@pytest.mark.parametrize("at", [(2, 6), None])
@pytest.mark.parametrize("way", ["escape", "right button"])
def test_it_can_be_taken_back(three, at, way):
    before, steps = three.session.document, three.session.undo_stack.count()
    x, y = at or on_curve(three, 2)
    three.press((x, y))
    three.move((x + 0.3, y + 0.5))
    assert three.session.document != before
    if way == "escape":
        three.escape()
    else:
        with pytest.raises(LookupError, match="no menu open"):
            three.open_menu((x + 0.3, y + 0.5))
    assert three.session.document is before
    three.move((x + 0.6, y + 0.5))
    three.release((x + 0.6, y + 0.5))
    assert three.session.document is before
    assert three.session.undo_stack.count() == steps
    assert three.status == "Cancelled."


def test_a_click_on_its_point_selects_it_too(three):
    before = three.session.document
    three.click((1, 7))
    assert (three.curve.name, three.session.selection) == ("C", {1})
    assert three.status == "Editing “C” now."
    assert three.session.document is before


def test_a_click_on_its_line_selects_nothing(three):
    before = three.session.document
    three.click(on_curve(three, 0))
    assert (three.curve.name, three.session.selection) == ("A", frozenset())
    assert three.status == "Editing “A” now."
    three.click(on_curve(three, 0))
    assert three.status.startswith("t = 0.45")
    assert three.session.document is before


@pytest.mark.parametrize("pixels", [7.4, 9.0, 15.0])
def test_at_the_edge_of_reach_there_is_a_click_or_a_band_but_never_both(three, pixels):
    x, y = on_curve(three, 2, 0.5)
    place = (x + pixels * three.pixel * 0.7, y + pixels * three.pixel * 0.7)
    three.press(place)
    three.move((place[0] + 0.3, place[1] + 0.3))
    edited, has_band = three.curve.name, three.window.canvas.marks.band is not None
    assert (edited == "C") != has_band
    three.escape()
    three.release(place)


def test_shift_click_still_chooses_and_a_shift_drag_moves_nothing(three):
    before = three.session.document
    three.click(on_curve(three, 2), keys=SHIFT)
    assert (three.session.active_index, three.session.selected.curves) == (1, {1, 2})
    three.drag(on_curve(three, 0), (1.5, -1), keys=SHIFT)
    assert three.session.active_index == 1
    assert three.session.document is before


def test_curves_chosen_together_still_move_together(three):
    three.click(on_curve(three, 2), keys=SHIFT)
    x, y = on_curve(three, 2)
    three.drag((x, y), (x + 0.5, y + 0.25))
    assert three.session.undo_stack.undoText() == "Move 2 curves"
    assert three.session.active_index == 1


def test_a_locked_curve_refuses_with_a_sentence(three):
    three.session.selected.activate(2)
    three.trigger("curveLocked")
    three.session.selected.activate(1)
    before = three.session.document
    sentence = "“C” is locked; unlock it in the list of curves to change it."
    x, y = on_curve(three, 2)
    three.hover((x, y))
    assert three.window.status_line.hint == "Click to edit “C” (locked) · Shift+click: choose it too"
    for start in ((x, y), (2, 6)):
        three.session.selected.activate(1)
        three.press(start)
        three.move((start[0] + 0.5, start[1] + 0.5))
        assert three.session.document is before
        assert three.status == sentence
        three.release((start[0] + 0.5, start[1] + 0.5))
        assert three.session.document is before
        assert three.status == sentence


# The right button


def test_the_first_right_click_offers_what_can_be_done_at_that_place(three):
    at = on_curve(three, 2)
    found = entries(three.open_menu(at))
    assert three.curve.name == "C"
    assert found["insertPointHere"]
    assert found["splitHere"]
    three.choose("insertPointHere")
    assert len(three.curve.points) == 5
    assert three.point(2) == pytest.approx(at, abs=2 * three.pixel)


def test_the_first_right_click_on_a_locked_curve_offers_no_change_of_shape(three):
    three.session.selected.activate(2)
    three.trigger("curveLocked")
    three.session.selected.activate(1)
    three.settle()
    found = entries(three.open_menu(on_curve(three, 2)))
    assert three.curve.name == "C"
    assert not found["insertPointHere"]
    assert not found["splitHere"]
    assert found["curveLocked"]
    close(three)


def test_the_first_right_click_on_its_point_is_for_the_point(three):
    found = entries(three.open_menu((2, 6)))
    assert (three.curve.name, three.session.selection) == ("C", {2})
    assert found["deleteSelection"]
    three.choose("tangentCorner")
    assert three.curve.points[2].corner


def test_a_right_click_on_one_of_several_chosen_leaves_them_chosen(three):
    three.click(on_curve(three, 2), keys=SHIFT)
    assert "insertPointHere" in entries(three.open_menu(on_curve(three, 2)))
    assert (three.curve.name, three.session.selected.curves) == ("C", {1, 2})
    close(three)
    assert "deleteCurve" in entries(three.open_menu((2, 3)))
    assert (three.session.selected.curves, three.session.selection) == ({1, 2}, frozenset())
    close(three)


def test_escape_closes_the_menu_and_changes_nothing(three):
    before = three.session.document
    three.open_menu(on_curve(three, 2))
    close(three)
    assert three.session.document is before
    assert three.curve.name == "C"
