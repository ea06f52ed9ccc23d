"""Several curves in one document: the list, the canvas, and the commands; real mouse and key events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtTest import QTest

from app.appearance.colours import point_colours
from app.families import HERMITE, LAGRANGE
from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.rows import Spot, spot_rect
from tests.gui.curve_rows import heard, open_row_menu
from tests.gui.editor_facts import names
from tests.waiting import until

CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def three(waves):
    """Three waves one above the other, A below, C on top; B is active."""
    editor = waves("ABC")
    editor.show_dock("curvesDock")
    return editor


def list_of(editor):
    return editor.window.commands[CurveListCommands].panel


def row_place(editor, row, spot=Spot.NAME):
    view = list_of(editor).view
    return spot_rect(view.parts.row_rect(row), spot).center()


def drag_row(editor, row, y, *, release=True):
    """Drag a row to a height in the list's viewport."""
    port = list_of(editor).view.viewport()
    start = row_place(editor, row)
    QTest.mousePress(port, LEFT, pos=start)
    for share in (0.3, 0.7, 1.0):
        QTest.mouseMove(port, QPoint(start.x(), round(start.y() + share * (y - start.y()))))
        editor.settle()
    if release:
        QTest.mouseRelease(port, LEFT, pos=QPoint(start.x(), y))
        editor.settle()


# Which curve is edited


def test_a_click_in_the_list_edits_another_curve(three):
    three.select([1, 2])
    three.click_in_list(2)
    assert (three.session.selected.is_editing, three.curve.name) == (True, "C")
    assert three.session.selection == frozenset()
    assert three.window.point_table.model().rowCount() == 4
    assert list_of(three).model.marks.active == 2


def test_arrows_walk_the_list(three):
    view = list_of(three).view
    view.setFocus()
    for key, expected in ((Qt.Key.Key_Up, "C"), (Qt.Key.Key_Up, "C"), (Qt.Key.Key_Down, "B")):
        QTest.keyClick(view, key)
        three.settle()
        assert three.curve.name == expected


def test_keys_walk_the_curves_from_the_canvas(three):
    for expected in "ACB":
        three.key(Qt.Key.Key_PageDown, CTRL)
        assert three.curve.name == expected
    three.key(Qt.Key.Key_PageUp, CTRL)
    assert three.curve.name == "C"
    assert three.status == "Editing “C”."


def test_a_hidden_curve_is_not_under_the_pointer(three):
    at = tuple(three.session.views[2].curve.evaluate(0.45))
    three.click_in_list(2, Spot.EYE)
    three.click(at)
    assert three.curve.name == "B"


def test_the_add_tool_adds_points_also_on_top_of_other_curves(three):
    at = tuple(three.session.views[2].curve.evaluate(0.45))
    three.add_point(*at)
    assert three.curve.name == "B"
    assert len(three.curve.points) == 5


def test_activating_a_curve_during_a_drag_cancels_the_drag(three):
    document = three.session.document
    three.press(three.point(1))
    three.move((1, 5))
    assert three.session.document is not document
    three.session.selected.activate(0)
    assert three.session.document is document
    three.move((2, 5))
    three.release((2, 5))
    assert three.session.document is document


def test_undo_restores_the_edited_curve(three):
    three.drag_point(1, to=(1.2, 4.5))
    three.click_in_list(2)
    three.drag_point(0, to=(0.2, 6.5))
    three.click_in_list(0)
    three.trigger("undo")
    assert three.curve.name == "C"
    three.trigger("undo")
    assert three.curve.name == "B"
    three.trigger("redo")
    three.trigger("redo")
    assert three.curve.name == "C"


def test_the_scrub_line_stays_inside_the_curve_that_is_edited(three):
    curve = three.session.document.curves[0]
    longer = replace(curve, parametrization=replace(curve.parametrization, end=5.0))
    three.session.commit(three.session.document.with_curve(0, longer), "Longer")
    three.session.selected.activate(0)
    three.session.scrub.set(4.0)
    three.session.selected.activate(1)
    assert three.session.scrub.t == 1.0


def test_fit_shows_all_visible_curves(three):
    _, low, _, high = three.window.canvas.pixel_map.box
    assert (low < 0, high > 7) == (True, True)
    three.click_in_list(2, Spot.EYE)
    three.fit()
    _, low, _, high = three.window.canvas.pixel_map.box
    assert (low < 0, high > 4, high < 7) == (True, True, True)


# The list


def test_the_eye_and_the_lock_are_switches(three):
    three.click_in_list(2, Spot.EYE)
    assert not three.session.document.curves[2].visible
    assert three.session.undo_stack.undoText() == "Hide C"
    three.click_in_list(2, Spot.LOCK)
    assert three.session.document.curves[2].locked
    assert three.curve.name == "B"
    three.trigger("undo")
    three.trigger("undo")
    assert three.session.document.curves[2] == replace(three.session.document.curves[2], visible=True)


def test_a_colour_is_set_in_the_palette_by_keys(three):
    three.trigger("curveColour")
    menu = three.menu()
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Return):
        QTest.keyClick(menu, key)
    three.settle()
    assert three.curve.style.stroke == "#0072b2"


def test_the_points_of_an_edited_hidden_curve_are_faint(three):
    def ink():
        x, y = three.window.canvas.to_pixel(*three.point(1)).toTuple()
        colour = three.window.canvas.viewport().grab().toImage().pixelColor(x, y)
        return colour.hslSaturation()

    strong = ink()
    three.trigger("curveVisible")
    assert ink() < strong
    three.trigger("curveVisible")
    assert ink() == strong


def test_escape_leaves_the_palette_and_the_colour(three):
    three.click_in_list(2, Spot.SWATCH)
    QTest.keyClick(three.menu(), Qt.Key.Key_Escape)
    three.settle()
    assert three.session.document.curves[2].style.stroke == ""


@pytest.mark.parametrize("how", ["double click", "F2", "menu"])
def test_a_name_is_edited_in_place(three, how):
    view = list_of(three).view
    if how == "double click":
        QTest.mouseDClick(view.viewport(), LEFT, pos=row_place(three, 1))
    elif how == "F2":
        view.setFocus()
        QTest.keyClick(view, Qt.Key.Key_F2)
    else:
        three.trigger("renameCurve")
    editor = view.viewport().findChild(object, "curveNameEditor")
    editor.selectAll()
    three.type_text(editor, "Spine 2")
    QTest.keyClick(editor, Qt.Key.Key_Return)
    three.settle()
    assert three.curve.name == "Spine 2"
    assert three.session.undo_stack.undoText() == "Rename curve"


def test_escape_keeps_the_name(three):
    three.trigger("renameCurve")
    editor = list_of(three).view.viewport().findChild(object, "curveNameEditor")
    three.type_text(editor, "No")
    QTest.keyClick(editor, Qt.Key.Key_Escape)
    three.settle()
    assert three.curve.name == "B"
    assert three.session.undo_stack.undoText() == "Begin"


def test_an_empty_name_is_refused(three):
    model = list_of(three).model
    assert not model.setData(model.index(model.row_of(0)), "  ")
    assert three.status == "A curve needs a name."
    assert names(three) == "ABC"


@pytest.mark.parametrize(("row", "after", "expected"), [(0, 2, "BCA"), (2, 0, "CAB"), (0, 1, "BAC")])
def test_a_row_is_dragged_to_another_place(three, row, after, expected):
    rect = list_of(three).view.parts.row_rect(after)
    drag_row(three, row, rect.top() if after > row else rect.bottom())
    assert names(three) == expected
    assert three.curve.name == "ABC"[row]
    three.trigger("undo")
    assert names(three) == "ABC"


def test_escape_cancels_the_drag_of_a_row(three):
    view = list_of(three).view
    drag_row(three, 0, view.parts.row_rect(2).top(), release=False)
    assert view.is_dragging
    QTest.keyClick(view, Qt.Key.Key_Escape)
    QTest.mouseRelease(view.viewport(), LEFT, pos=view.parts.row_rect(2).topLeft())
    three.settle()
    assert names(three) == "ABC"
    assert not view.is_dragging


def test_a_row_dropped_at_the_same_position_changes_nothing(three):
    rect = list_of(three).view.parts.row_rect(1)
    drag_row(three, 1, rect.top() + rect.height() // 3 + 12)
    assert three.session.undo_stack.undoText() == "Begin"


def test_keys_move_a_curve_in_the_order(three):
    three.key(Qt.Key.Key_PageUp, CTRL | SHIFT)
    assert names(three) == "ACB"
    three.key(Qt.Key.Key_PageUp, CTRL | SHIFT)
    assert names(three) == "ACB"
    three.key(Qt.Key.Key_PageDown, CTRL | SHIFT)
    three.key(Qt.Key.Key_PageDown, CTRL | SHIFT)
    assert names(three) == "BAC"
    assert three.curve.name == "B"


def test_the_front_curve_is_the_top_row_and_raise_moves_up(three):
    view = list_of(three).view
    tops = [view.parts.row_rect(place).top() for place in range(3)]
    assert tops == sorted(tops, reverse=True)
    assert list_of(three).model.index(0).data() == "C"
    three.trigger("raiseCurve")
    assert [list_of(three).model.index(row).data() for row in range(3)] == ["B", "C", "A"]
    assert view.parts.row_rect(three.session.active_index).top() == 0
    assert not three.action("raiseCurve").isEnabled()


def test_a_copy_is_placed_right_above_and_a_new_curve_on_top(three):
    model = list_of(three).model
    three.trigger("duplicateCurve")
    assert [model.index(row).data() for row in range(4)] == ["C", "B copy", "B", "A"]
    three.trigger("undo")
    three.trigger("newCurve")
    assert [model.index(row).data() for row in range(4)] == ["Curve 1", "C", "B", "A"]


@pytest.mark.parametrize("key", [Qt.Key.Key_Delete, Qt.Key.Key_Backspace])
def test_delete_in_the_list_deletes_the_curve_and_not_its_points(three, key):
    three.click_in_list(0)
    three.select([1, 2])
    QTest.keyClick(list_of(three).view, key)
    three.settle()
    assert names(three) == "BC"
    assert three.session.undo_stack.undoText() == "Delete A"
    three.trigger("undo")
    assert names(three) == "ABC"
    assert len(three.session.document.curves[0].points) == 4


def test_delete_while_a_name_is_typed_is_for_the_name(three):
    view = list_of(three).view
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_F2)
    editor = view.viewport().findChild(object, "curveNameEditor")
    editor.selectAll()
    QTest.keyClick(editor, Qt.Key.Key_Delete)
    three.type_text(editor, "X")
    QTest.keyClick(editor, Qt.Key.Key_Delete)
    QTest.keyClick(editor, Qt.Key.Key_Return)
    three.settle()
    assert names(three) == "AXC"


def test_every_part_of_a_row_has_a_tip_for_a_click(three):
    view = list_of(three).view
    tips = [view.parts.tip_at(row_place(three, 1, spot)) for spot in Spot]
    assert tips == [
        "Set the colour of “B”",
        "“B”: Hermite, 4 points. Double-click to rename, drag to reorder;"
        " right-click › Edit Curve shows its points.",
        "Lock “B”",
        "Hide “B”",
    ]
    assert "Click to select a curve" in view.parts.tip_at(QPoint(5, view.viewport().height() - 2))


def test_the_list_is_read_aloud(three):
    three.click_in_list(1, Spot.LOCK)
    assert heard(three, 1) == "B, Hermite, 4 points, locked"


def test_the_menu_of_a_row_is_for_that_curve(three):
    open_row_menu(three, 0)
    assert three.curve.name == "C"
    three.choose("curveLocked")
    assert three.curve.locked


# Number


def test_new_duplicate_and_delete(three):
    three.trigger("newCurve")
    assert names(three) == "ABCCurve 1"
    assert three.curve.points == ()
    assert three.curve.family is HERMITE
    assert three.action("addTool").isChecked()
    three.click((1, 2))
    three.trigger("undo")
    three.trigger("undo")
    assert names(three) == "ABC"
    assert three.curve.name == "B"
    three.session.selected.activate(1)
    three.trigger("duplicateCurve")
    assert [curve.name for curve in three.session.document.curves] == ["A", "B", "B copy", "C"]
    assert three.session.selection == frozenset(range(4))
    three.trigger("deleteCurve")
    assert names(three) == "ABC"
    assert not three.session.selected.marked
    three.session.selected.select_whole({0, 1, 2})
    three.trigger("deleteCurve")
    assert three.curve.points == ()
    assert len(three.session.document.curves) == 1


# Locked and hidden


def test_a_locked_curve_refuses_gestures_and_edits_with_a_sentence(three):
    three.trigger("curveLocked")
    document = three.session.document
    sentence = "“B” is locked. Unlock it in the list of curves to change it."
    three.drag_point(1, to=(1, 5))
    assert (three.session.document, three.status) == (document, sentence)
    three.add_point(1, 5)
    assert three.session.document is document
    three.add_point(*three.session.active_view.curve.evaluate(0.4))
    assert three.session.document is document
    three.drag_parameter(1, to=0.5)
    three.trigger("reverseCurve")
    three.trigger("deleteCurve")
    three.choose_family(LAGRANGE)
    assert three.session.document is document
    assert three.action("familyHermite").isChecked()
    three.hover(three.point(2))
    assert three.window.status_line.hint == sentence
    three.trigger("curveLocked")
    three.drag_point(1, to=(1, 5))
    assert three.point(1) == pytest.approx((1, 5), abs=three.pixel)


def test_a_hidden_curve_that_is_edited_is_explained(three):
    three.trigger("curveVisible")
    assert three.message == "“B” is hidden. It is drawn faintly while you edit it."
    # It is not edited while it is only chosen.
    active = three.session.active_index
    three.session.selected.select_whole([active])
    assert three.message == ""
    three.session.selected.edit_selected()
    assert three.message.startswith("“B” is hidden")
    three.trigger("curveVisible")
    assert three.message == ""


# Shape


def test_splitting_at_a_selected_point_makes_two_curves(three):
    before = three.session.active_view
    three.select_point(2)
    three.trigger("splitCurve")
    assert [curve.name for curve in three.session.document.curves] == ["A", "B a", "B b", "C"]
    assert "shape kept, largest change " in three.status
    t = np.linspace(0, before.parameters[2], 50)
    assert three.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-13)
    three.trigger("undo")
    assert names(three) == "ABC"


def test_splitting_at_the_scrub_line_and_joining_again(three):
    before = three.session.active_view
    three.session.scrub.set(0.37)
    three.trigger("splitCurve")
    three.trigger("joinCurve")
    assert [curve.name for curve in three.session.document.curves] == ["A", "B a", "C"]
    assert three.status.startswith("Joined with “B b”, end to start: shapes kept, largest change ")
    t = np.linspace(0, 1, 99)
    assert three.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-13)


def test_a_split_without_a_position_is_refused_with_a_reason(three):
    three.trigger("splitCurve")
    assert "scrub line" in three.status
    assert names(three) == "ABC"


def test_a_join_of_one_curve_is_refused_with_a_reason(three):
    for row in (0, 2):
        three.click_in_list(row, Spot.EYE)
    three.trigger("joinCurve")
    assert three.status == "There is no other visible open curve to join."


def test_a_locked_curve_is_not_joined(three):
    three.click_in_list(2, Spot.LOCK)
    three.click_in_list(0, Spot.LOCK)
    three.trigger("joinCurve")
    assert names(three) == "ABC"
    assert "is locked" in three.status


def test_a_join_to_an_earlier_curve_keeps_the_active_curve(three):
    three.click_in_list(2, Spot.EYE)
    three.trigger("joinCurve")
    assert names(three) == "BC"
    assert three.curve.name == "B"
    assert len(three.curve.points) == 8


def test_reversing_reverses_the_direction(three):
    first, last = three.point(0), three.point(3)
    three.trigger("reverseCurve")
    assert (three.point(0), three.point(3)) == (last, first)
    assert three.status.startswith("Shape kept, largest change ")


def test_closing_and_opening(three):
    three.trigger("closeCurve")
    assert three.curve.is_closed
    assert three.action("closeCurve").isChecked()
    view = three.session.active_view
    for order in (0, 1):
        assert view.curve.evaluate(0.0, order) == pytest.approx(view.curve.evaluate(1.0, order))
    three.trigger("closeCurve")
    assert not three.curve.is_closed


def test_closing_a_polynomial_is_explained(three):
    three.choose_family(LAGRANGE)
    three.trigger("closeCurve")
    assert "is one polynomial" in three.status
    assert not three.action("closeCurve").isChecked()


def test_a_point_added_to_a_closed_curve_lies_between_the_last_and_the_first(three):
    three.trigger("closeCurve")
    three.trigger("freezeParameters")
    end = three.parameters[-1]
    three.trigger("addTool")
    three.click((1.5, 1.8), keys=Qt.KeyboardModifier.ShiftModifier)
    assert len(three.parameters) == 6
    assert three.parameters[-1] == end
    assert three.session.active_view.is_current


# Insert


def test_a_click_on_the_curve_keeps_its_shape_under_manual_parameters(three):
    three.trigger("freezeParameters")
    before = three.session.active_view
    three.add_point(*before.curve.evaluate(0.41))
    assert three.status.startswith("Shape kept, largest change ")
    t = np.linspace(0, 1, 200)
    assert three.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=1e-13)
    # A C² spline through one more of its points is the same: the new one is an estimate like the others.
    assert not three.curve.has_derivatives


def test_a_point_dragged_off_the_curve_follows_the_pointer(three):
    three.trigger("freezeParameters")
    at = tuple(three.session.active_view.curve.evaluate(0.41))
    three.trigger("addTool")
    three.drag(at, (at[0], at[1] + 1))
    assert three.point(2) == pytest.approx((at[0], at[1] + 1), abs=2 * three.pixel)
    assert "Shape" not in three.status


def test_escape_cancels_an_insertion(three):
    document = three.session.document
    three.trigger("addTool")
    three.press(tuple(three.session.active_view.curve.evaluate(0.41)))
    assert three.session.document is not document
    three.escape()
    assert three.session.document is document


def test_a_point_is_inserted_at_the_scrub_line(three):
    three.trigger("freezeParameters")
    three.session.scrub.set(0.37)
    three.trigger("insertPoint")
    assert three.parameters[2] == 0.37 or three.parameters[1] == 0.37
    assert three.session.selected.points == {three.parameters.index(0.37)}


# Drawn


def test_other_curves_are_drawn_in_their_colours_and_repainted_only_after_a_change(three):
    three.click_in_list(2, Spot.SWATCH)
    three.choose("colour_Vermillion")
    assert three.session.document.curves[2].style.stroke == "#d55e00"
    assert three.session.undo_stack.undoText() == "Colour C"
    layer = three.window.canvas.drawing.others
    picture = layer._picture
    assert picture is not None
    three.drag_point(1, to=(1.3, 4.4))
    assert layer._picture is picture
    x, y = three.session.views[2].curve.evaluate(0.41)
    pixel = three.window.canvas.to_pixel(x, y)
    image = three.window.canvas.grab().toImage()
    ratio = image.devicePixelRatio()
    colours = [
        image.pixelColor(round(pixel.x() * ratio) + dx, round(pixel.y() * ratio) + dy)
        for dx in (-1, 0, 1)
        for dy in (-1, 0, 1)
    ]
    assert max(colour.red() - colour.blue() for colour in colours) > 60
    layer._seconds = 0.0  # as if painting had taken no time
    three.window.canvas.camera.zoom(1.2, three.window.canvas.camera.centre())
    three.settle()
    assert layer._picture is not picture


def test_the_picture_of_many_curves_moves_with_the_view_and_is_repainted_at_rest(three):
    canvas = three.window.canvas
    layer = canvas.drawing.others
    three.settle()
    layer._seconds = 1.0  # as if painting had taken a second
    picture = layer._picture
    canvas.camera.zoom(1.2, canvas.camera.centre())
    canvas.camera.pan(30, 10)
    three.settle()
    assert layer._picture is picture
    shown, place = canvas.pixel_map, picture.rect_in(canvas.pixel_map)
    x, y = picture.pixel_map.plane(100, 50)
    assert shown.point(x, y) == pytest.approx((place.x() + 120, place.y() + 60))
    until(lambda: layer._picture is not picture)
    assert layer._picture.pixel_map == shown


def test_a_corner_is_marked(three):
    three.select([1])
    three.trigger("tangentCorner")
    canvas = three.window.canvas
    assert canvas.drawing.view.corners == [1]
    three.select([])
    count = len(three.session.active_curve.points)
    place, colour = canvas.to_pixel(*three.point(1)), point_colours(count, canvas.layers.theme)[1]
    # Beyond a disc, where there is paper, and within the tip of a diamond.
    near = canvas.viewport().grab().toImage().pixelColor(place.x(), place.y() - 4)
    assert near.getRgb() == pytest.approx(colour.getRgb(), abs=20)


def test_a_press_and_release_of_another_button_does_nothing(three):
    document = three.session.document
    pixel = three.window.canvas.to_pixel(*three.point(1))
    for kind in (QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease):
        three.send(three.window.canvas, kind, pixel, button=Qt.MouseButton.RightButton)
    assert three.session.document is document


def test_all_selected_curves_are_reversed_and_closed(three):
    """One of a group, or of a shape with holes, was, and the others not."""
    before = three.session.document.curves
    three.session.selected.select_whole([0, 2])
    three.trigger("reverseCurve")
    assert three.session.undo_stack.undoText() == "Reverse 2 curves"
    now = three.session.document.curves
    for place in (0, 2):
        there = [point.position for point in now[place].points]
        assert there == [point.position for point in reversed(before[place].points)]
    assert now[1] is before[1]
    three.trigger("closeCurve")
    assert [curve.closed for curve in three.session.document.curves] == [True, False, True]
    three.trigger("undo")
    three.trigger("undo")
    assert three.session.document.curves == before
    assert three.session.selected.whole_curves == {0, 2}
