"""A drag of a curve that is not the one edited moves it whole, a click edits it; real events."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.actions.keymap import plain
from tests.gui.editor_facts import moved_by, on_curve

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def three(waves):
    """Three waves one above the other, A below, C on top; B is active."""
    return waves("ABC")


def entries(menu):
    return {entry.objectName(): entry.isEnabled() for entry in menu.actions() if entry.objectName()}


def close(editor):
    QTest.keyClick(editor.menu(), Qt.Key.Key_Escape)


@pytest.mark.parametrize("at", [(2, 6), None])
def test_a_drag_on_another_curve_moves_the_whole_curve_without_editing(three, at):
    before, steps = three.session.document, three.session.undo_stack.count()
    three.select([1])
    x, y = at or on_curve(three, 2)
    three.press((x, y))
    assert three.curve.name == "B"
    three.move((x + 0.2, y + 0.4))
    assert three.status.startswith("Move C by 0.")
    three.release((x + 0.2, y + 0.4))
    assert moved_by(three, before, 2) == pytest.approx((0.2, 0.4), abs=2 * three.pixel)
    assert three.session.document.curves[:2] == before.curves[:2]
    assert (three.curve.name, three.session.selection) == ("B", {1})
    assert three.session.undo_stack.count() == steps + 1
    assert three.session.undo_stack.undoText() == "Move C"
    three.trigger("undo")
    assert three.session.document == before
    assert (three.curve.name, three.session.selection) == ("B", {1})


def test_the_hint_before_the_press_names_the_other_curve(three):
    line, at = three.window.status_line, on_curve(three, 2)
    three.hover(at)
    assert line.hint == (
        "Drag to move “C” · click to edit it, double-click to insert a point · "
        "Shift+click: add it to the selection"
    )
    assert three.window.canvas.viewport().cursor().shape() == Qt.CursorShape.SizeAllCursor
    three.move(at, held=False, keys=SHIFT)
    assert line.hint == "Drag to move “C” along one axis · click to add it to the selection"
    three.move(at, held=False, keys=CTRL)
    assert line.hint.startswith("Drag to move “C” along one axis · click to edit it")


@pytest.mark.parametrize("keys", [SHIFT, CTRL])
def test_a_key_keeps_the_drag_to_an_axis(three, keys):
    before = three.session.document
    x, y = on_curve(three, 2)
    three.drag((x, y), (x + 0.5, y + 0.2), keys=keys)
    assert moved_by(three, before, 2) == (pytest.approx(0.5, abs=2 * three.pixel), 0.0)
    assert three.session.selected.curves == {1}


def test_a_dragged_other_curve_snaps_by_its_point_to_points_at_rest(three):
    x, y = three.session.views[2].curve.evaluate(0.02)
    goal, end = three.session.document.curves[0].points[2].position, (0.0, 6.0)
    near = (x + goal[0] - end[0] + 0.02, y + goal[1] - end[1] - 0.02)
    three.trigger("toggleSnap")
    three.press((x, y))
    three.move(near)
    assert "snapped to: point 2 of A" in three.status
    three.release(near)
    assert three.session.document.curves[2].points[0].position == goal
    three.trigger("undo")
    # One of the curve that is edited, too.
    goal = three.point(1)
    near = (x + goal[0] - end[0] + 0.02, y + goal[1] - end[1] - 0.02)
    three.drag((x, y), near)
    assert three.session.document.curves[2].points[0].position == goal


def test_a_drag_of_another_curve_can_be_cancelled(three):
    for at, way in product(((2, 6), None), ("escape", "right button")):
        before, steps = three.session.document, three.session.undo_stack.count()
        x, y = at or on_curve(three, 2)
        three.press((x, y))
        three.move((x + 0.3, y + 0.5))
        assert three.session.document != before, (at, way)
        if way == "escape":
            three.escape()
        else:
            with pytest.raises(LookupError, match="no menu open"):
                three.open_menu((x + 0.3, y + 0.5))
        assert three.session.document is before, (at, way)
        three.move((x + 0.6, y + 0.5))
        three.release((x + 0.6, y + 0.5))
        assert three.session.document is before, (at, way)
        assert three.session.undo_stack.count() == steps, (at, way)
        assert three.status == "Cancelled.", (at, way)
        three.window.status_line.clear_message()


def test_a_click_on_a_point_of_another_curve_edits_the_curve_and_selects_the_point(three):
    before = three.session.document
    three.click((1, 7))
    assert (three.curve.name, three.session.selection) == ("C", {1})
    assert three.status == "Editing “C”."
    assert three.session.document is before


def test_a_click_on_the_line_of_another_curve_selects_no_point(three):
    before = three.session.document
    three.click(on_curve(three, 0))
    assert (three.curve.name, three.session.selection) == ("A", frozenset())
    assert three.status == "Editing “A”."
    three.click(on_curve(three, 0))
    said, at, _place = three.status.split(" · ")
    assert (said, len(three.session.selection)) == ("2 points selected", 2)
    # On whole pixels.
    assert float(at.removeprefix("t = ")) == pytest.approx(0.45, abs=2e-3)
    assert three.session.document is before


def test_at_the_edge_of_reach_a_drag_moves_the_curve_or_draws_a_band_but_never_both(three):
    for pixels in (7.4, 9.0, 15.0):
        before = three.session.document
        x, y = on_curve(three, 2, 0.5)
        place = (x + pixels * three.pixel * 0.7, y + pixels * three.pixel * 0.7)
        three.press(place)
        three.move((place[0] + 0.3, place[1] + 0.3))
        assert (three.session.document != before) != (three.window.canvas.marks.band is not None), pixels
        three.escape()
        three.release(place)
        assert three.session.document is before, pixels


LOCKED = "“C” is locked. Unlock it in the list of curves to change it."


@pytest.fixture(params=[True, False], ids=["edited", "none edited"])
def locked(three, request):
    """The same with C locked and D below it; B is edited, or nothing is, nor chosen."""
    document = three.session.document
    below = replace(document.curves[2], name="D")
    curves = (below, *document.curves[:2], replace(document.curves[2], locked=True))
    three.session.commit(replace(document, curves=curves), "Lock C", active=2)
    if request.param:
        three.session.selected.activate(2)
    else:
        three.session.selected.select_whole(())
    return three


def test_clicks_and_drags_go_through_a_locked_curve_to_the_curve_below(locked):
    at, is_editing = on_curve(locked, 3), locked.session.selected.is_editing
    locked.hover(at)
    assert "“D”" in locked.window.status_line.hint
    locked.click(at)
    assert (locked.curve.name, locked.session.selected.is_editing) == ("D", is_editing)
    before = locked.session.document
    locked.drag(at, np.add(at, (0.5, 0.25)))
    assert locked.session.document.curves[3] is before.curves[3]
    assert locked.session.document.curves[0] is not before.curves[0]


def test_a_press_on_a_locked_curve_without_another_below_is_refused_with_a_message(locked):
    locked.session.change(
        "Delete D", lambda document: replace(document, curves=document.curves[1:]), active=1
    )
    if not locked.session.selected.is_editing:
        locked.session.selected.select_whole(())
    before, choice = locked.session.document, locked.session.selected.state
    at = on_curve(locked, 2)
    locked.hover(at)
    assert locked.window.status_line.hint == LOCKED
    for keys in (Qt.KeyboardModifier.NoModifier, SHIFT, Qt.KeyboardModifier.AltModifier):
        locked.click(at, keys=keys)
        locked.drag(at, np.add(at, (0.1, 0.1)), keys=keys)
        assert (locked.session.document, locked.session.selected.state) == (before, choice)
    locked.click(at)
    assert (locked.status, locked.window.status_line.is_refusal) == (LOCKED, True)
    assert locked.session.selected.state == choice
    # The list takes it, and a drag of it is refused.
    locked.click_in_list(2)
    assert locked.curve.name == "C"
    assert locked.session.selected.marked == {2}
    locked.drag(at, np.add(at, (0.5, 0.25)))
    assert locked.session.document is before


# The right button


def test_the_first_right_click_offers_the_commands_for_the_clicked_position(three):
    at = on_curve(three, 2)
    found = entries(three.open_menu(at))
    assert three.curve.name == "C"
    assert found["insertPointHere"]
    assert found["splitHere"]
    three.choose("insertPointHere")
    assert len(three.curve.points) == 5
    assert three.point(2) == pytest.approx(at, abs=2 * three.pixel)


def test_a_right_click_on_a_locked_curve_is_for_the_canvas(three):
    three.session.selected.activate(2)
    three.trigger("curveLocked")
    three.session.selected.activate(1)
    three.settle()
    found = entries(three.open_menu(on_curve(three, 2)))
    assert three.curve.name == "B"
    assert found["selectAllCurves"]
    assert not {"insertPointHere", "splitHere", "curveLocked"} & set(found)
    close(three)


def test_the_first_right_click_on_a_point_of_another_curve_opens_the_menu_of_the_point(three):
    found = entries(three.open_menu((2, 6)))
    assert (three.curve.name, three.session.selection) == ("C", {2})
    assert found["deleteSelection"]
    three.choose("tangentCorner")
    assert three.curve.points[2].corner


def test_a_right_click_on_a_selected_curve_keeps_all_selected_curves(three):
    three.click(on_curve(three, 2), keys=SHIFT)
    assert "insertPointHere" in entries(three.open_menu(on_curve(three, 2)))
    assert (three.curve.name, three.session.selected.curves) == ("C", {1, 2})
    close(three)
    assert "deleteCurve" in entries(three.open_menu((2, 3)))
    assert (three.session.selected.curves, three.session.selection) == ({1, 2}, frozenset())
    close(three)


def test_the_menu_of_several_selected_curves_is_short_and_acts_on_all(three):
    """It was that of a curve whose points are edited, of thirty entries, half of them grey."""
    selected = three.session.selected
    selected.select_whole([0, 1])
    found = entries(three.open_menu(on_curve(three, 1)))
    assert all(found.values())
    assert {"insertPointHere", "splitHere", "ungroupCurves", "breakApart"}.isdisjoint(found)
    wanted = ["cutPoints", "copyPoints", "pastePoints", "duplicateCurve", "deleteCurve"]
    wanted += ["groupCurves", "copyStyle", "curveVisible", "curveLocked"]
    assert [name for name in found if name in wanted] == wanted
    menus = {plain(each.text()): each.menu() for each in three.menu().actions() if each.menu()}
    assert list(menus) == ["Order", "Shape"]
    assert {"combineCurves", "simplify"} <= entries(menus["Shape"]).keys()
    assert list(entries(menus["Order"])) == ["raiseCurve", "lowerCurve", "raiseToTop", "lowerToBottom"]
    three.choose("groupCurves")
    # Something that is not chosen is chosen first, with the group that it is in.
    found = entries(three.open_menu(on_curve(three, 2)))
    assert selected.whole_curves == {2}
    assert "ungroupCurves" not in found
    assert "groupCurves" in found
    three.choose("lowerToBottom")
    assert [curve.name for curve in three.session.document.curves] == ["C", "A", "B"]
    three.trigger("undo")
    assert selected.whole_curves == {2}
    found = entries(three.open_menu(on_curve(three, 0)))
    assert selected.whole_curves == {0, 1}
    assert "ungroupCurves" in found
    three.choose("deleteCurve")
    assert [curve.name for curve in three.session.document.curves] == ["C"]


def test_escape_closes_the_menu_and_changes_nothing(three):
    before = three.session.document
    three.open_menu(on_curve(three, 2))
    close(three)
    assert three.session.document is before
    assert three.curve.name == "C"
