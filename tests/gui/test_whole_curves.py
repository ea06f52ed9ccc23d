"""No curve is edited: clicks and the rubber band choose whole curves, drags move them; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from app.appearance.colours import point_colours
from app.canvas.other_curves_layer import loose_indices, sections_of
from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE
from app.features.curve_list.rows import Spot
from tests.gui.curve_rows import click_row, heard, open_row_menu, row_named
from tests.gui.editor_facts import moved_by, on_curve, transform, whole_curve_names

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier
RETURN = Qt.Key.Key_Return


@pytest.fixture
def three(waves):
    """Three waves one above the other, A below, C on top, 3 apart; B is edited."""
    return waves("ABC")


@pytest.fixture
def whole(three):
    """The same, none edited and none chosen."""
    three.escape()
    three.escape()
    return three


def state(editor):
    """Whether a curve is edited, which curves are chosen as wholes, which is the active one."""
    return editor.session.selected.is_editing, whole_curve_names(editor), editor.curve.name


def shows_points(editor):
    """Whether the disc of the active curve's point 1 is seen, in its colour."""
    canvas = editor.window.canvas
    image, place = canvas.viewport().grab().toImage(), canvas.to_pixel(*editor.point(1))
    return image.pixelColor(place) == point_colours(4, canvas.layers.theme)[1]


# In and out


def test_a_program_begins_with_a_curve_that_is_edited(new_editor):
    assert state(new_editor)[:2] == (True, "")


def test_escape_deselects_points_then_the_curve_then_all(three):
    document, steps = three.session.document, three.session.undo_stack.count()
    three.select([1])
    found = []
    for _ in range(4):
        three.escape()
        found.append((*state(three), sorted(three.session.selection)))
    assert found == [(True, "", "B", []), (False, "B", "B", []), (False, "", "B", []), (False, "", "B", [])]
    assert three.session.document is document
    assert three.session.undo_stack.count() == steps
    assert three.session.active_view.source.name == "B"


@pytest.mark.parametrize("places", [{2}, {0, 2}])
def test_the_menu_key_opens_the_menu_of_the_selected_curves(whole, places):
    """It opened that of the canvas."""
    whole.session.selected.select_whole(places)
    menu = whole.press_menu_key()
    found = {entry.objectName() for entry in menu.actions()}
    menu.close()
    assert "deleteSelection" in found or "deleteCurve" in found
    assert not {"toggleGrid", "selectAllCurves"} & found
    assert whole.session.selected.whole_curves == places


def test_a_return_to_whole_curves_is_reported_and_hides_the_points(three):
    assert shows_points(three)
    three.hover((1.5, 4.4))
    assert "Escape: whole curves" in three.window.status_line.hint
    three.escape()
    assert three.status == "“B” is selected as a whole; Enter edits its points."
    assert not shows_points(three)
    three.key(RETURN)
    assert state(three) == (True, "", "B")
    assert three.status == "Editing “B”."
    assert shows_points(three)


def test_enter_edits_all_selected_curves_and_escape_selects_the_whole_curves(whole):
    """One was edited, and the others had to be clicked again each time."""
    whole.click(on_curve(whole, 0))
    whole.click(on_curve(whole, 2), keys=SHIFT)
    whole.key(RETURN)
    assert whole.status == "Editing 2 curves."
    selected = whole.session.selected
    assert (selected.is_editing, whole_curve_names(whole)) == (True, "AC")
    whole.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert dict(selected.group.parts) == {0: {0, 1, 2, 3}, 2: {0, 1, 2, 3}}
    whole.escape()
    assert (selected.is_editing, whole_curve_names(whole), selected.group.parts) == (True, "AC", ())
    whole.escape()
    assert (selected.is_editing, whole_curve_names(whole)) == (False, "AC")
    assert whole.status.startswith("2 curves are selected as wholes")
    assert whole.status.endswith("Enter edits their points.")
    # By the action it goes the same way.
    for is_editing in (True, False):
        whole.trigger("editCurve")
        assert (selected.is_editing, whole_curve_names(whole)) == (is_editing, "AC")
        assert whole.action("editCurve").isChecked() == is_editing
    whole.escape()
    assert (selected.is_editing, whole_curve_names(whole)) == (False, "")


def test_a_click_selects_and_a_double_click_edits(whole):
    whole.click(on_curve(whole, 2))
    assert state(whole) == (False, "C", "C")
    assert whole.status == "“C” is selected."
    whole.click(on_curve(whole, 0))
    assert state(whole) == (False, "A", "A")
    whole.double_click(on_curve(whole, 2))
    assert state(whole) == (True, "", "C")
    assert whole.status == "Editing “C”."


def test_a_double_click_on_a_point_selects_the_point(whole):
    whole.double_click((2, 6))
    assert (state(whole), whole.session.selection) == ((True, "", "C"), {2})


def test_shift_click_adds_and_removes_and_a_click_elsewhere_clears_the_selection(whole):
    for row, expected in ((2, "C"), (0, "AC"), (2, "A")):
        whole.click(on_curve(whole, row), keys=SHIFT)
        assert (whole.session.selected.is_editing, whole_curve_names(whole)) == (False, expected)
        assert whole.session.active_index in whole.session.selected.curves
    whole.click((-1, 4.6))
    assert (whole.session.selected.is_editing, whole_curve_names(whole)) == (False, "")


@pytest.mark.parametrize("how", ["table", "menu of the list", "pen", "new document", "action"])
def test_actions_that_need_points_resume_editing(whole, how):
    if how == "table":
        whole.select([1])
    elif how == "menu of the list":
        open_row_menu(whole, row_named(whole, "C"))
        whole.choose("editCurve")
        assert whole.curve.name == "C"
    elif how == "pen":
        whole.key(Qt.Key.Key_P)
    elif how == "new document":
        whole.new()
    else:
        whole.trigger("editCurve")
    assert whole.session.selected.is_editing
    assert whole_curve_names(whole) == ""


def test_a_click_in_the_list_selects_as_with_the_select_tool(whole):
    """Where nothing is edited it begins no editing, and panels show what was clicked."""
    whole.show_dock("curvesDock")
    found = []
    for name, keys in (
        *(("C", NO_KEYS), ("A", NO_KEYS)),
        *(("C", CTRL), ("A", CTRL), ("C", CTRL)),
        *(("A", NO_KEYS), ("C", SHIFT)),
    ):
        click_row(whole, name, keys)
        found.append(whole_curve_names(whole))
        assert not whole.session.selected.is_editing
        assert whole.session.active_index in whole.session.selected.curves
    assert found == ["C", "A", "AC", "C", "", "A", "ABC"]
    click_row(whole, "C")
    assert state(whole) == (False, "C", "C")
    assert whole.session.target_view is whole.session.views[2]
    before = whole.session.document
    whole.drag(on_curve(whole, 2), np.add(on_curve(whole, 2), (0.5, 0.0)))
    assert moved_by(whole, before, 2)[0] == pytest.approx(0.5, abs=2 * whole.pixel)


def test_list_and_shortcut_sheet_name_the_selected_curves(whole):
    told = [heard(whole, row) for row in range(3)]
    assert [text.rpartition("points")[2] for text in told] == ["", "", ""]
    whole.click(on_curve(whole, 2))
    assert heard(whole, 2).endswith(", selected")
    whole.trigger("showShortcuts")
    texts = [label.text() for label in whole.window.findChild(object, "shortcutSheet").findChildren(QLabel)]
    assert "<b>Now: 1 curve selected</b>" in texts
    whole.trigger("showShortcuts")


def test_the_pen_begins_another_curve_where_none_was_edited(whole):
    whole.key(Qt.Key.Key_P)
    whole.hover((1.5, 4.6))
    assert whole.window.status_line.hint.startswith("Click to begin another curve")
    whole.click((1.5, 4.6))
    assert [len(curve.points) for curve in whole.session.document.curves] == [4, 4, 4, 1]
    whole.click((2.0, 4.8))
    assert len(whole.curve.points) == 2


def test_the_pen_continues_the_curve_that_was_edited(three):
    three.key(Qt.Key.Key_P)
    three.click((1.5, 4.6))
    assert [len(curve.points) for curve in three.session.document.curves] == [4, 5, 4]


# Moved


@pytest.mark.parametrize("letters", ["C", "AC"])
def test_selected_curves_are_dragged_and_nudged_and_stay_selected(whole, letters):
    rows = ["ABC".index(letter) for letter in letters]
    for row in rows:
        whole.click(on_curve(whole, row), keys=SHIFT)
    before, steps = whole.session.document, whole.session.undo_stack.count()
    x, y = on_curve(whole, rows[-1])
    whole.drag((x, y), (x + 0.5, y + 0.25))
    for row in range(3):
        expected = (0.5, 0.25) if row in rows else (0.0, 0.0)
        assert moved_by(whole, before, row) == pytest.approx(expected, abs=2 * whole.pixel)
    words = "2 curves" if len(rows) > 1 else letters
    assert whole.session.undo_stack.count() == steps + 1
    assert whole.session.undo_stack.undoText() == f"Move {words}"
    assert state(whole)[:2] == (False, letters)
    whole.key(Qt.Key.Key_Left)
    assert whole.session.undo_stack.undoText() == f"Nudge {words}"
    whole.trigger("undo")
    whole.trigger("undo")
    assert whole.session.document == before
    assert state(whole)[:2] == (False, letters)


def test_a_selected_curve_has_a_box_and_is_moved_scaled_and_deleted(whole):
    whole.click(on_curve(whole, 2))
    assert whole.window.canvas.marks.box is not None
    x, y = whole.grip(1, 1)
    whole.drag((x, y), (x + 1, y + 1))
    assert whole.session.undo_stack.undoText() == "Scale C"
    whole.hover((1.5, 4.4))
    transform(whole, "G", "2")
    assert whole.session.undo_stack.undoText() == "Move C"
    whole.key(Qt.Key.Key_Delete)
    assert [curve.name for curve in whole.session.document.curves] == ["A", "B"]
    # A second Delete takes none that nobody has chosen.
    assert state(whole)[:2] == (False, "")
    whole.key(Qt.Key.Key_Delete)
    assert len(whole.session.document.curves) == 2
    whole.trigger("undo")
    assert state(whole)[:2] == (False, "C")


def test_without_a_selection_keys_report_the_missing_selection(whole):
    before = whole.session.document
    whole.hover((1.5, 4.4))
    whole.key(Qt.Key.Key_G)
    assert whole.status == "No curve is selected. Click one, or press Ctrl+A to select all."
    whole.key(Qt.Key.Key_Left)
    assert whole.session.document is before


def test_a_message_on_the_selection_is_removed_with_the_selection(whole):
    whole.hover((1.5, 4.4))
    assert whole.status == "No curve is selected."
    whole.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert whole_curve_names(whole) == "ABC"
    assert whole.status == whole.window.status_line.hint
    whole.escape()
    whole.key(Qt.Key.Key_G)
    assert whole.status == "No curve is selected. Click one, or press Ctrl+A to select all."
    assert whole.window.status_line.is_refusal
    whole.trigger("selectAll")
    assert not whole.window.status_line.is_refusal


def test_the_status_line_describes_the_effect_of_a_press(whole):
    line = whole.window.status_line
    whole.hover((1.5, 4.4))
    assert line.hint == "Drag to select curves inside · Shift adds · Double-click edits one"
    whole.hover(on_curve(whole, 2))
    assert line.hint == (
        "Drag to move “C” · click to select it, double-click to edit it · "
        "Shift+click: add it to the selection"
    )
    whole.click(on_curve(whole, 2))
    whole.hover(on_curve(whole, 2))
    assert line.hint == (
        "Drag to move “C” · Click: grips that rotate and skew · Double-click to edit “C” · "
        "Shift: one axis, a click removes it from the selection"
    )
    assert whole.window.canvas.viewport().cursor().shape() == Qt.CursorShape.SizeAllCursor


# The rubber band


def test_the_rubber_band_selects_the_curves_inside_live(whole):
    whole.press((-0.7, 7.6))
    whole.move((3.5, 2.5))
    assert whole_curve_names(whole) == "BC"
    assert whole.status.startswith("2 curves selected · Shift: add to the selection")
    whole.move((3.5, 5.5))
    assert whole_curve_names(whole) == "C"
    whole.move((1.5, 2.5))
    assert whole_curve_names(whole) == ""
    whole.move((3.5, 2.5))
    whole.release((3.5, 2.5))
    assert state(whole)[:2] == (False, "BC")
    assert whole.session.selected.curves == {1, 2}
    assert whole.session.active_index in {1, 2}


def test_shift_adds_to_the_selection_and_escape_restores_the_selection(whole):
    whole.click(on_curve(whole, 0))
    for way in ("escape", "release"):
        whole.press((-0.7, 7.6), keys=SHIFT)
        whole.move((3.5, 5.5), keys=SHIFT)
        assert whole_curve_names(whole) == "AC"
        if way == "escape":
            whole.escape()
            assert whole.status == "Cancelled."
            assert state(whole) == (False, "A", "A")
        whole.release((3.5, 5.5), keys=SHIFT)
    assert state(whole)[:2] == (False, "AC")


def test_hidden_and_locked_curves_are_not_selected(whole):
    whole.session.selected.select_whole({2})
    whole.trigger("curveLocked")
    whole.session.selected.select_whole({1})
    whole.trigger("curveVisible")
    whole.session.selected.select_whole(())
    whole.drag((3.6, -0.6), (-0.7, 7.6))
    assert whole_curve_names(whole) == "A"


def test_while_a_curve_is_edited_the_rubber_band_selects_points(three):
    three.drag((-0.7, 7.6), (1.5, 2.5))
    assert (state(three), three.session.selection) == ((True, "", "B"), {0, 1})


# The box


def test_a_drag_inside_the_box_of_points_moves_the_points(three):
    three.select([0, 1, 2, 3])
    before, steps = three.session.document, three.session.undo_stack.count()
    place = (0.3, 3.9)
    three.hover(place)
    hint = three.window.status_line.hint
    assert hint == (
        "Drag to move 4 points · Ctrl: one axis · Shift+drag: rubber band · %: snap · Click: deselect"
    )
    assert three.window.canvas.viewport().cursor().shape() == Qt.CursorShape.SizeAllCursor
    three.drag(place, (place[0] + 0.4, place[1] + 0.2))
    assert moved_by(three, before, 1) == pytest.approx((0.4, 0.2), abs=2 * three.pixel)
    assert three.session.undo_stack.count() == steps + 1
    assert three.session.undo_stack.undoText() == "Move 4 points"
    assert three.session.selection == {0, 1, 2, 3}


def test_the_box_fits_the_selection_and_grips_are_outside(three):
    """It stood 16 pixels off, and looked as if the shape did not reach the edge of a page."""
    three.select([0, 1, 2, 3])
    canvas, box = three.window.canvas, three.window.canvas.marks.box
    right, middle = box.high[0], (box.low[1] + box.high[1]) / 2
    assert three.grip(1, 0) == pytest.approx((right + 16 * three.pixel, middle))
    with_box = pixels_of(canvas)
    three.trigger("toggleTransformBox")
    is_drawn = (pixels_of(canvas) != with_box).any(axis=-1)
    three.trigger("toggleTransformBox")
    (x, top), bottom = canvas.to_pixel(*box.high).toTuple(), canvas.to_pixel(*box.low).y()
    assert is_drawn[top:bottom, x - 1 : x + 2].any(axis=1).mean() > 0.4, "dashes along the side"
    three.hover((right + 6 * three.pixel, middle - 30 * three.pixel))
    assert three.window.status_line.hint.startswith("Drag to select points")


def test_a_drag_inside_the_box_of_curves_moves_the_curves(whole):
    whole.session.selected.select_whole({1, 2})
    before = whole.session.document
    whole.drag((0.5, 5.2), (0.9, 5.4))
    for row, expected in ((0, (0, 0)), (1, (0.4, 0.2)), (2, (0.4, 0.2))):
        assert moved_by(whole, before, row) == pytest.approx(expected, abs=2 * whole.pixel)
    assert whole.session.undo_stack.undoText() == "Move 2 curves"


def test_a_drag_inside_the_box_can_be_cancelled(three):
    three.select([0, 1, 2, 3])
    before = three.session.document
    three.press((0.3, 3.9))
    three.move((0.9, 4.4))
    assert three.session.document != before
    three.escape()
    assert three.session.document is before
    three.release((0.9, 4.4))
    assert three.session.selection == {0, 1, 2, 3}


def test_a_click_inside_the_box_clears_the_selection(three):
    three.select([0, 1, 2, 3])
    three.click((0.3, 3.9))
    assert (state(three), three.session.selection) == ((True, "", "B"), frozenset())
    three.session.selected.select_whole({1, 2})
    three.click((0.5, 5.2))
    assert state(three)[:2] == (False, "")


def test_shift_drag_inside_the_box_is_a_rubber_band(three):
    three.select([0, 1, 3])
    before = three.session.document
    three.move((0.3, 3.9), held=False, keys=SHIFT)
    assert three.window.status_line.hint.startswith("Drag to select points, Shift adds")
    three.drag((1.7, 2.6), (2.3, 3.4), keys=SHIFT)
    assert three.session.document is before
    assert three.session.selection == {0, 1, 2, 3}


def test_points_and_curve_inside_the_box_are_hit_before_the_box(three):
    three.select([0, 1, 2, 3])
    three.drag(on_curve(three, 1), (1.5, 4.2))
    assert three.session.undo_stack.undoText().startswith("Bend curve")
    three.select([0, 3])
    three.drag(three.point(1), (1.2, 4.3))
    assert three.session.undo_stack.undoText() == "Move point 1"


def test_without_the_box_a_drag_inside_moves_nothing(three):
    three.trigger("toggleTransformBox")
    three.select([0, 1, 2, 3])
    before = three.session.document
    three.drag((0.3, 3.9), (0.6, 3.6))
    assert three.session.document is before


def test_a_drag_with_the_mouse_really_held(whole):
    """By Qt's own test functions, for the whole way of the events."""
    before, canvas = whole.session.document, whole.window.canvas
    x, y = on_curve(whole, 2)
    start, end = canvas.to_pixel(x, y), canvas.to_pixel(x + 0.5, y)
    QTest.mousePress(canvas.viewport(), Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(canvas.viewport(), end)
    QTest.mouseRelease(canvas.viewport(), Qt.MouseButton.LeftButton, pos=end)
    assert moved_by(whole, before, 2)[0] == pytest.approx(0.5, abs=2 * whole.pixel)


# Painted


@pytest.fixture
def pile(editor):
    """Ten filled leaves that overlap, the first one edited."""
    leaf = ((0.0, 0.0), (2.0, 1.0), (4.0, 0.0), (2.0, -1.0))
    fills = ["#f0e442", "#0072b2", "#d55e00", "#009e73", "#cc79a7"]
    curves = [
        replace(
            make_curve([(x + 0.7 * n, y + 0.5 * n) for x, y in leaf], name=f"Leaf {n}", family=HERMITE),
            style=Style(stroke="#1f2328", width=0.1, fill=fills[n % 5]),
        )
        for n in range(10)
    ]
    editor.session.commit(Document(tuple(curves)), "Begin", active=0)
    editor.fit()
    return editor


def pixels_of(canvas):
    """The red, green and blue of all pixels of the canvas."""
    image = canvas.viewport().grab().toImage().convertToFormat(QImage.Format.Format_RGBA8888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)
    return rows[:, :, :3].astype(int)


@pytest.mark.parametrize("chosen", [None, (4,), (1, 4, 8), (0, 1, 2, 4, 5, 6, 7, 8, 9)])
def test_only_dragged_curves_are_repainted_and_the_order_stays(pile, chosen):
    """Of curves apart in the order, or more than eight, all were painted in every frame."""
    if chosen is not None:
        pile.session.selected.select_whole(chosen)
    others, canvas = pile.window.canvas.drawing.others, pile.window.canvas
    layers = others, pile.window.canvas.drawing.curves.above
    x, y = pile.session.views[4].curve.evaluate(0.99)
    pile.press((float(x), float(y)))
    pile.move((x - 0.3, y + 0.2))
    pile.move((x - 0.4, y + 0.2))
    kept = [layer._picture for layer in layers]
    pile.move((x - 0.8, y + 0.1))
    pile.move((x - 0.9, y + 0.3))
    assert pile.status.startswith(
        "Move Leaf 4 by" if chosen in (None, (4,)) else f"Move {len(chosen)} curves by"
    )
    assert [layer._picture for layer in layers] == kept
    under_way = pixels_of(canvas)
    for layer in layers:
        layer._picture, layer._sections = None, sections_of((), len(layer._shapes))
    # Edges that lie over each other are mixed by another rounding where they are painted on sheets.
    difference = np.abs(pixels_of(canvas) - under_way)
    assert difference.max() <= 6
    assert np.count_nonzero(difference.max(axis=2) > 2) < 400
    pile.release((x - 0.9, y + 0.3))


def test_dragged_curves_return_to_the_picture_after_other_paints(pile):
    pile.session.selected.select_whole(range(1, 10))
    x, y = pile.session.views[4].curve.evaluate(0.99)
    others = pile.window.canvas.drawing.others
    pile.press((float(x), float(y)))
    for way in (0.3, 0.6, 0.9):
        pile.move((x + way, y))
    pile.release((x + way, y))
    assert loose_indices(others._sections) == set(range(10))
    for _ in range(12):
        pixels_of(pile.window.canvas)
    assert not loose_indices(others._sections)


def test_selected_curves_stay_in_the_picture_when_another_curve_becomes_active(pile):
    """Each was another curve at its place in the layer: six of ten were painted in every frame of a drag."""
    pile.session.selected.set_curves(range(6), 0)
    selected = pile.window.canvas.drawing.selected
    pixels_of(pile.window.canvas)
    start = pile.session.views[4].points[1]
    pile.press(start)
    for way in (0.3, 0.6, 0.9):
        pile.move((start[0], start[1] + way))
    assert pile.session.active_index == 4
    assert not loose_indices(selected._sections)
    kept = selected._picture
    pile.move((start[0], start[1] + 0.2))
    assert selected._picture is kept
    pile.release((start[0], start[1] + 0.2))


@pytest.mark.parametrize(
    ("changed", "still"),
    [
        ((), [range(30)]),
        ((3,), [range(3), range(4, 30)]),
        ((0, 29), [range(1, 29)]),
        ((10, 12, 20), [range(10), range(13, 20), range(21, 30)]),
        (tuple(range(30)), []),
        (tuple(range(0, 30, 3)), [range(at, at + 2) for at in range(7, 30, 3)]),
    ],
)
def test_shapes_at_rest_are_in_as_few_sheets_as_possible(changed, still):
    sections = sections_of(changed, 30)
    assert [section.indices for section in sections if section.is_still] == still
    assert [index for section in sections for index in section.indices] == list(range(30))
    assert set(changed) <= loose_indices(sections)


# Copies


def test_a_duplicate_has_the_style_of_the_original_and_is_selected(whole):
    whole.session.selected.select_whole({2})
    click_swatch(whole, 2, "colour_Vermillion")
    whole.trigger("duplicateCurve")
    assert [curve.style.stroke for curve in whole.session.document.curves] == ["", "", "#d55e00", "#d55e00"]
    assert state(whole) == (False, "C copy", "C copy")
    assert whole.status == "“C copy” lies on the original and is selected. Drag it to move it."


def test_a_duplicate_of_the_edited_curve_keeps_colour_and_selected_points(three):
    click_swatch(three, 1, "colour_Vermillion")
    three.trigger("duplicateCurve")
    assert [curve.style.stroke for curve in three.session.document.curves] == ["", "#d55e00", "#d55e00", ""]
    assert (three.curve.name, len(three.session.selection)) == ("B copy", 4)


def click_swatch(editor, row, colour):
    editor.click_in_list(row, Spot.SWATCH)
    editor.choose(colour)
