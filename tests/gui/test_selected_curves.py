"""Several curves chosen and worked on together: the list, the canvas, the commands; real mouse and keys."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, box_shown, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QMimeData, QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton

from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.style import Style
from app.document.transforms import round_step_above
from app.families import QUINTIC_HERMITE
from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.rows import Spot, spot_rect
from app.features.import_export.commands import ImportCommands
from app.storage.format import encode
from app.tools.snapping import SnapKind, Snapping
from app.workbench.clipboard import CURVES
from tests.gui.curve_rows import heard
from tests.gui.editor_facts import moved_by, names, on_curve, transform, undo_text

CTRL = Qt.KeyboardModifier.ControlModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
WAVE = ((0, 0), (1, 1), (2, 0), (3, 1))


@pytest.fixture
def five(editor):
    """Five waves one above the other, A below, E on top; B is active. C has derivatives of its own."""
    curves = [
        make_curve([(x, y + 2 * level) for x, y in WAVE], name=name, family=QUINTIC_HERMITE)
        for level, name in enumerate("ABCDE")
    ]
    # Spaced evenly in t, so that derivatives per unit of t go as vectors do, however distances change.
    evenly = Parametrization(ParametrizationKind.UNIFORM)
    curves = [replace(curve, parametrization=evenly) for curve in curves]
    point = replace(curves[2].points[1], velocity=(4.0, 2.0), acceleration=(-8.0, 16.0))
    curves[2] = replace(curves[2], points=(curves[2].points[0], point, *curves[2].points[2:]))
    editor.session.commit(Document(tuple(curves)), "Begin", active=1)
    editor.show_dock("curvesDock")
    editor.fit()
    return editor


def selected_names(editor):
    """Return the names of the selected curves, the active one first."""
    curves, session = editor.session.document.curves, editor.session
    others = sorted(session.selected.curves - {session.active_index})
    assert session.active_index in session.selected.curves
    return "".join(curves[place].name for place in (session.active_index, *others))


def choose(editor, letters):
    """Choose by clicks in the list, the first letter as the curve that is edited."""
    for number, letter in enumerate(letters):
        click_row(editor, "ABCDE".index(letter), CTRL if number else NO_KEYS)


def click_row(editor, row, keys=NO_KEYS, spot=Spot.NAME):
    view = editor.window.commands[CurveListCommands].panel.view
    QTest.mouseClick(view.viewport(), LEFT, keys, spot_rect(view.parts.row_rect(row), spot).center())
    editor.settle()


def positions(editor, row):
    return np.array([point.position for point in editor.session.document.curves[row].points])


# Choosing in the list


def test_control_click_adds_and_removes(five):
    click_row(five, 3, CTRL)
    assert selected_names(five) == "BD"
    click_row(five, 0, CTRL)
    assert selected_names(five) == "BAD"
    click_row(five, 3, CTRL)
    assert selected_names(five) == "BA"
    assert undo_text(five) == "Begin"


def test_removing_the_edited_curve_from_the_selection_edits_its_neighbour(five):
    choose(five, "BCE")
    click_row(five, 1, CTRL)
    assert selected_names(five) == "CE"
    click_row(five, 4, CTRL)
    click_row(five, 2, CTRL)
    assert selected_names(five) == "C"


def test_a_plain_click_selects_one_curve(five):
    choose(five, "BCE")
    click_row(five, 1)
    assert selected_names(five) == "B"
    choose(five, "BCE")
    click_row(five, 4)
    assert selected_names(five) == "E"


def test_shift_click_extends_from_the_edited_curve(five):
    click_row(five, 3, SHIFT)
    assert selected_names(five) == "BCD"
    click_row(five, 0, SHIFT)
    assert selected_names(five) == "BA"


def test_shift_and_arrows_extend_and_shrink(five):
    view = five.window.commands[CurveListCommands].panel.view
    view.setFocus()
    for key, expected in (
        ("Up", "BC"),
        ("Up", "BCD"),
        ("Down", "BC"),
        ("Down", "B"),
        ("Down", "BA"),
        ("Down", "BA"),
    ):
        QTest.keyClick(view, getattr(Qt.Key, f"Key_{key}"), SHIFT)
        five.settle()
        assert selected_names(five) == expected
    QTest.keyClick(view, Qt.Key.Key_Up)
    five.settle()
    assert selected_names(five) == "C"


def test_control_a_in_the_list_selects_all_and_on_the_canvas_the_points(five):
    view = five.window.commands[CurveListCommands].panel.view
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_A, CTRL)
    five.settle()
    assert selected_names(five) == "BACDE"
    assert five.session.selection == frozenset()
    five.key(Qt.Key.Key_A, CTRL)
    assert five.session.selection == {0, 1, 2, 3}


def test_the_action_selects_all(five):
    five.run_command("Select All Curves")
    assert selected_names(five) == "BACDE"
    # Once more is harmless, and no warning.
    five.key(Qt.Key.Key_A, CTRL | SHIFT)
    assert selected_names(five) == "BACDE"
    assert (five.status, five.window.status_line.is_refusal) == ("All 5 curves are selected.", False)
    assert undo_text(five) == "Begin"


def test_the_list_has_accessible_texts(five):
    choose(five, "BD")
    told = [heard(five, row) for row in (0, 1, 3)]
    assert [text.partition("points")[2] for text in told] == ["", ", selected, edited", ", selected"]


# Choosing on the canvas


def test_shift_click_adds_another_curve_to_the_selection(five):
    five.select([1, 2])
    at = on_curve(five, 3)
    five.hover(at)
    assert five.window.status_line.hint.startswith("Drag to move “D” · click to edit it")
    five.click(at, keys=SHIFT)
    assert selected_names(five) == "BD"
    assert five.session.selection == frozenset()
    assert five.status == "2 curves selected, “B” is edited."
    five.click(at, keys=SHIFT)
    assert selected_names(five) == "B"
    assert five.status == "Only “B” is selected."


def test_a_click_on_a_selected_curve_edits_that_curve_alone(five):
    choose(five, "BD")
    five.click(on_curve(five, 3))
    assert selected_names(five) == "D"


def test_clicks_deselect_the_points_first_and_then_the_other_curves(five):
    choose(five, "BD")
    five.click(five.point(1))
    assert five.session.selection == {1}
    for expected in ("BD", "B"):
        five.click((-1.5, 4.4))
        assert (five.session.selection, selected_names(five)) == (frozenset(), expected)


def test_the_status_line_names_the_curves_affected_by_tools(five):
    choose(five, "BD")
    five.hover((-1.5, 4.4))
    assert five.window.status_line.hint.startswith("2 curves selected, “B” is edited · G moves, S scales")
    five.hover(on_curve(five, 3))
    assert five.window.status_line.hint.startswith("Drag to move 2 curves · Shift: one axis, a click removes")
    five.select([1])
    five.hover((-1.5, 4.4))
    assert five.window.status_line.hint.startswith("Drag to select points")


def test_the_sheet_names_the_selected_curves(five):
    choose(five, "BD")
    five.trigger("showShortcuts")
    texts = [label.text() for label in five.window.findChild(object, "shortcutSheet").findChildren(QLabel)]
    assert "<b>Now: 2 curves selected</b>" in texts
    assert texts.index("Drag a selected curve") < texts.index("<b>Otherwise</b>")
    five.trigger("showShortcuts")


# The choice is kept valid


def test_the_selection_follows_its_curves_through_changes_of_the_list(five):
    choose(five, "BDE")
    five.trigger("raiseCurve")
    assert (names(five), selected_names(five)) == ("ACBDE", "BDE")
    five.trigger("undo")
    assert (names(five), selected_names(five)) == ("ABCDE", "BDE")
    click_row(five, 2, spot=Spot.EYE)
    assert (undo_text(five), selected_names(five)) == ("Hide C", "BDE")
    five.trigger("undo")
    five.trigger("reverseCurve")
    assert selected_names(five) == "BDE"


def test_replacing_the_edited_curve_ends_the_selection(five):
    choose(five, "BDE")
    five.trigger("newCurve")
    assert selected_names(five) == "Curve 1"
    five.trigger("undo")
    assert selected_names(five) == "BDE"
    five.trigger("selectTool")
    choose(five, "BDE")
    five.trigger("nextCurve")
    assert selected_names(five) == "A"


def test_the_choice_ends_with_the_document(five):
    five.trigger("selectAllCurves")
    five.new()
    assert five.session.selected.curves == {0}


# Commands


def test_all_selected_curves_are_hidden_and_unhidden_in_one_step(five):
    choose(five, "BDE")
    five.trigger("curveVisible")
    assert [curve.visible for curve in five.session.document.curves] == [True, False, True, False, False]
    assert undo_text(five) == "Hide 3 curves"
    click_row(five, 3, spot=Spot.EYE)
    assert all(curve.visible for curve in five.session.document.curves)
    assert undo_text(five) == "Show 3 curves"


def test_all_selected_curves_are_locked_and_freed(five):
    choose(five, "BD")
    click_row(five, 3, spot=Spot.LOCK)
    assert [curve.locked for curve in five.session.document.curves] == [False, True, False, True, False]
    assert undo_text(five) == "Lock 2 curves"
    five.trigger("curveLocked")
    assert not any(curve.locked for curve in five.session.document.curves)


def test_all_selected_curves_get_a_colour(five):
    choose(five, "BDE")
    click_row(five, 4, spot=Spot.SWATCH)
    five.choose("colour_Vermillion")
    colours = [curve.style.stroke for curve in five.session.document.curves]
    assert colours == ["", "#d55e00", "", "#d55e00", "#d55e00"]
    assert undo_text(five) == "Colour 3 curves"


@pytest.mark.parametrize("how", ["action", "Delete", "Delete in the list"])
def test_all_selected_curves_are_deleted_in_one_step(five, how):
    document = five.session.document
    choose(five, "BDE")
    assert five.action("deleteCurve").text() == "Delete 3 Curves"
    if how == "action":
        five.trigger("deleteCurve")
    elif how == "Delete":
        five.key(Qt.Key.Key_Delete)
    else:
        QTest.keyClick(five.window.commands[CurveListCommands].panel.view, Qt.Key.Key_Delete)
        five.settle()
    assert (names(five), selected_names(five), undo_text(five)) == ("AC", "C", "Delete 3 curves")
    assert five.action("deleteCurve").text() == "Delete Curve"
    five.trigger("undo")
    assert five.session.document == document


def test_all_selected_curves_are_duplicated_and_the_copies_selected(five):
    choose(five, "CB")
    five.trigger("duplicateCurve")
    assert [curve.name for curve in five.session.document.curves[1:5]] == ["B", "C", "B copy", "C copy"]
    assert (five.curve.name, five.session.selected.curves) == ("C copy", {3, 4})
    assert undo_text(five) == "Duplicate 2 curves"
    assert five.session.selection == frozenset()


def test_locked_curves_stay_unchanged_and_are_named_when_all_are_locked(five):
    choose(five, "BD")
    five.trigger("curveLocked")
    choose(five, "ABDE")
    locked, box = five.session.document, five.window.canvas.marks.box
    assert box is not None
    five.key(Qt.Key.Key_Left)
    assert five.status.endswith(" · 2 locked curves stay")
    x, y = on_curve(five, 4)
    five.drag((x, y), (x + 1, y + 1))
    assert five.status == "2 locked curves stay."
    document = five.session.document
    stay = [document.curves[at] is locked.curves[at] for at in range(5)]
    assert stay == [False, True, True, True, False]
    five.trigger("deleteCurve")
    assert [curve.name for curve in five.session.document.curves] == ["B", "C", "D"]
    assert five.status == "2 locked curves stay."
    for _ in range(3):
        five.trigger("undo")
    choose(five, "BD")
    document = five.session.document
    sentence = "“B” and “D” are locked. Unlock them in the list of curves to change them."
    for act in (
        lambda: five.trigger("deleteCurve"),
        lambda: five.trigger("moveSelection"),
        lambda: five.key(Qt.Key.Key_Left),
    ):
        five.session.say("")
        act()
        assert (five.status, five.session.document) == (sentence, document)
    five.drag(on_curve(five, 3), (2, 9))
    assert five.session.document is document
    five.hover(on_curve(five, 3))
    assert five.window.status_line.hint == "“D” is locked. Unlock it in the list of curves to change it."
    # What cannot be moved has no grips.
    assert five.window.canvas.marks.box is None
    assert undo_text(five) == "Lock 2 curves"


# Transforms


def test_dragging_one_selected_curve_moves_all(five):
    before = five.session.document
    choose(five, "BD")
    x, y = on_curve(five, 3)
    five.press((x, y))
    five.move((x + 0.5, y - 0.25))
    assert "Move 2 curves by" in five.status
    assert moved_by(five, before, 1) == pytest.approx((0.5, -0.25), abs=five.pixel)
    five.release((x + 0.5, y - 0.25))
    by = moved_by(five, before, 3)
    assert by == pytest.approx((0.5, -0.25), abs=five.pixel)
    assert moved_by(five, before, 1) == pytest.approx(by)
    assert [moved_by(five, before, row) for row in (0, 2, 4)] == [(0, 0)] * 3
    assert (undo_text(five), selected_names(five)) == ("Move 2 curves", "BD")
    five.trigger("undo")
    assert (five.session.document, selected_names(five)) == (before, "BD")


def test_shift_keeps_the_drag_to_an_axis(five):
    before = five.session.document
    choose(five, "BD")
    x, y = on_curve(five, 3)
    five.drag((x, y), (x + 0.5, y - 0.2), keys=SHIFT)
    assert moved_by(five, before, 1)[1] == 0.0
    assert selected_names(five) == "BD"


def test_dragging_an_unselected_curve_moves_that_curve_alone(five):
    before = five.session.document
    choose(five, "BD")
    x, y = on_curve(five, 4)
    five.drag((x, y), (x, y + 0.5))
    assert undo_text(five) == "Move E"
    assert selected_names(five) == "BD"
    now = five.session.document
    assert [now.curves[at] is before.curves[at] for at in range(5)] == [True, True, True, True, False]


def test_bending_and_points_of_the_edited_curve_work_as_ever(five):
    before = five.session.document
    choose(five, "BD")
    five.bend(0.42, (1.4, 3.3))
    assert undo_text(five).startswith("Bend")
    five.drag_point(1, to=(1.2, 3.4))
    assert undo_text(five) == "Move point 1"
    assert five.session.document.curves[3] is before.curves[3]
    assert selected_names(five) == "BD"


@pytest.mark.parametrize(
    ("key", "typed", "name"),
    [("G", "x2.5", "Move 2 curves"), ("S", "y2", "Scale 2 curves"), ("R", "90", "Rotate 2 curves")],
)
def test_keys_transform_all_selected_curves_by_a_typed_amount(five, key, typed, name):
    choose(five, "BC")
    box = five.window.canvas.marks.box
    assert box_shown(five) == pytest.approx(sampled_bounds(five, 1, 2), abs=CLOSE)
    assert box.low[1] < 2, "the curve falls below its points"
    mx, my = box.centre
    five.hover((1.5, 4.4))
    five.key(getattr(Qt.Key, f"Key_{key}"))
    five.type_amount(typed)
    five.key(Qt.Key.Key_Return)
    place = {
        "G": lambda x, y: (x + 2.5, y),
        "S": lambda x, y: (x, y + (y - my)),
        "R": lambda x, y: (x + (-(x - mx) - (y - my)), y + ((x - mx) - (y - my))),
    }[key]
    for row in (1, 2):
        # Rounding of places of some tenths, added up three times.
        expected = np.array([place(x, y + 2 * row) for x, y in WAVE])
        assert positions(five, row) == pytest.approx(expected, abs=1e-14)
    point = five.session.document.curves[2].points[1]
    expected = {
        "G": ((4, 2), (-8, 16)),
        "S": ((4, 4), (-8, 32)),
        "R": ((-2, 4), (-16, -8)),
    }[key]
    assert (point.velocity, point.acceleration) == expected
    plain = five.session.document.curves[1].points[1]
    assert plain == Point(plain.x, plain.y)
    assert undo_text(five) == name


@pytest.mark.parametrize("how", ["Escape", "right button"])
def test_a_transform_of_all_selected_curves_is_cancelled(five, how):
    document, steps = five.session.document, five.session.undo_stack.count()
    choose(five, "BCE")
    for key in (Qt.Key.Key_G, Qt.Key.Key_S, Qt.Key.Key_R):
        five.hover((2.5, 4.4))
        five.key(key)
        five.move((3.5, 6.0), held=False)
        is_as_before = [five.session.document.curves[row] == document.curves[row] for row in range(5)]
        assert is_as_before == [True, False, False, True, False], key
        if how == "Escape":
            five.escape()
        else:
            place = five.window.canvas.to_pixel(3.5, 6.0)
            five.drag_pixels(five.window.canvas, place, place, button=RIGHT)
        assert five.session.document is document, key
        assert five.session.undo_stack.count() == steps, key
        assert selected_names(five) == "BCE", key


@pytest.mark.parametrize("how", ["Escape", "right button"])
def test_a_drag_of_all_selected_curves_is_cancelled(five, how):
    document = five.session.document
    choose(five, "BC")
    for what, start in {"curve": on_curve(five, 2), "grip": five.grip(1, 1), "turn": five.grip()}.items():
        five.press(start)
        five.move((start[0] + 0.7, start[1] + 0.9))
        assert five.session.document.curves[1] != document.curves[1], what
        assert five.session.document.curves[2] != document.curves[2], what
        if how == "Escape":
            five.escape()
        else:
            place = five.window.canvas.to_pixel(start[0] + 0.7, start[1] + 0.9)
            five.send(five.window.canvas, QEvent.Type.MouseButtonPress, place, button=RIGHT)
            five.settle()
        assert five.session.document is document, what
        five.release((start[0] + 0.7, start[1] + 0.9))
        assert five.session.document is document, what


def test_a_grip_scales_all_selected_curves_about_the_opposite_corner(five):
    choose(five, "BC")
    before = sampled_bounds(five, 1, 2)
    x, y = five.grip(1, 1)
    five.drag((x, y), (x + 3.0, y + 1.5))
    after = sampled_bounds(five, 1, 2)
    assert after == pytest.approx(np.add(before, [(0.0, 0.0), (3.0, 1.5)]), abs=2 * five.pixel)
    assert after[0] == pytest.approx(before[0], abs=CLOSE)
    factors = np.ptp(after, axis=0) / np.ptp(before, axis=0)
    point = five.session.document.curves[2].points[1]
    assert point.velocity == pytest.approx((4 * factors[0], 2 * factors[1]))
    assert point.acceleration == pytest.approx((-8 * factors[0], 16 * factors[1]))
    assert undo_text(five) == "Scale 2 curves"


def test_a_grip_snaps_a_side_to_the_grid_in_all_curves(five):
    choose(five, "BC")
    five.set_grid(0.3)
    five.window.canvas.tools.snapping.settings = Snapping(True, frozenset({SnapKind.GRID}))
    x, y = five.grip(1, 0)
    five.drag((x, y), (x + 0.62, y))
    assert [positions(five, row)[3][0] for row in (1, 2)] == [3.6, 3.6]


def test_the_point_under_the_pointer_snaps_to_a_curve_that_stays(five):
    choose(five, "BC")
    five.window.canvas.tools.snapping.settings = Snapping(True, frozenset({SnapKind.POINTS}))
    x, y = five.session.views[2].curve.evaluate(0.9)
    end, goal = positions(five, 2)[3], positions(five, 3)[2]
    five.drag((x, y), (x + goal[0] - end[0] + 0.02, y + goal[1] - end[1] - 0.02))
    assert tuple(positions(five, 2)[3]) == tuple(goal)
    assert tuple(positions(five, 1)[3]) == pytest.approx((goal[0], goal[1] - 2))


def test_arrows_nudge_all_selected_curves_and_are_one_step(five):
    before = five.session.document
    choose(five, "BD")
    step = round_step_above(2 * five.window.canvas.camera.pixel_size)
    for _ in range(3):
        five.key(Qt.Key.Key_Left)
    five.key(Qt.Key.Key_Up, SHIFT)
    assert moved_by(five, before, 1) == pytest.approx((-3 * step, 10 * step))
    assert moved_by(five, before, 3) == pytest.approx((-3 * step, 10 * step))
    assert undo_text(five) == "Nudge 2 curves"
    five.trigger("undo")
    assert five.session.document == before


def test_selected_points_take_precedence_over_selected_curves(five):
    before = five.session.document
    choose(five, "BD")
    five.click(five.point(1))
    five.hover((1.5, 4.4))
    transform(five, "G", "1")
    assert undo_text(five) == "Move point 1"
    assert five.session.document.curves[3] is before.curves[3]


def test_the_box_is_visible_for_several_curves_only(five):
    choose(five, "BD")
    assert five.window.canvas.marks.box is not None
    choose(five, "B")
    assert five.window.canvas.marks.box is None


# Seen


def test_selected_curves_are_drawn_with_rings(five):
    canvas = five.window.canvas
    accent = five.window.canvas.layers.theme.accent

    def ringed(row):
        """Whether the accent stands around a point, and paper within."""
        image, (x, y) = (
            canvas.viewport().grab().toImage(),
            canvas.to_pixel(*positions(five, row)[1]).toTuple(),
        )
        around = [image.pixelColor(x + dx, y + dy) for dx in range(-5, 6) for dy in range(-5, 6)]
        near = [abs(c.red() - accent.red()) + abs(c.blue() - accent.blue()) for c in around]
        return min(near) < 40

    choose(five, "BD")
    five.hover((-1.5, 4.4))
    assert [ringed(row) for row in (0, 2, 3, 4)] == [False, False, True, False]
    choose(five, "B")
    assert not ringed(3)


def test_a_selected_curve_that_is_hidden_is_faint_and_moves_along(five):
    before = five.session.document

    def strength():
        x, y = five.window.canvas.to_pixel(*on_curve(five, 3)).toTuple()
        return min(
            five.window.canvas.viewport().grab().toImage().pixelColor(x + dx, y + dy).lightness()
            for dx in (-1, 0, 1)
            for dy in (-1, 0, 1)
        )

    choose(five, "BD")
    shown = strength()
    click_row(five, 3, spot=Spot.EYE)
    assert shown + 40 < strength() < 250
    x, y = on_curve(five, 3)
    five.drag((x, y), (x + 0.5, y))
    assert moved_by(five, before, 1) == pytest.approx(moved_by(five, before, 3))
    choose(five, "B")
    assert five.window.canvas.drawing.selected.hit(
        five.window.canvas.to_pixel(*on_curve(five, 3)).toTuple(), five.window.canvas.pixel_map
    ) is None  # fmt: skip


def test_curves_outside_a_drag_are_not_painted_again(five):
    choose(five, "BDE")
    canvas = five.window.canvas
    five.settle()
    pictures = canvas.drawing.others._picture, canvas.drawing.selected._picture
    five.press(five.point(1))
    five.move((1.3, 3.5))
    five.move((1.4, 3.6))
    assert (canvas.drawing.others._picture, canvas.drawing.selected._picture) == pictures
    five.escape()
    # The others stay while all that are chosen are dragged.
    start = on_curve(five, 3)
    five.press(start)
    five.move((start[0] + 0.3, start[1]))
    five.move((start[0] + 0.5, start[1]))
    assert canvas.drawing.others._picture is pictures[0]
    assert canvas.drawing.selected._picture is not pictures[1]
    five.escape()


def test_choosing_drops_no_row_drag(five):
    view = five.window.commands[CurveListCommands].panel.view
    place = spot_rect(view.parts.row_rect(3), Spot.NAME).center()
    QTest.mousePress(view.viewport(), LEFT, CTRL, place)
    QTest.mouseMove(view.viewport(), QPoint(place.x(), 4))
    QTest.mouseRelease(view.viewport(), LEFT, CTRL, QPoint(place.x(), 4))
    five.settle()
    assert (names(five), selected_names(five)) == ("ABCDE", "BD")


# Clipboard


def test_all_selected_curves_are_copied_and_pasted(five):
    choose(five, "BC")
    originals = five.session.document.curves
    five.key(Qt.Key.Key_C, CTRL)
    assert five.status == "Copied 2 curves."
    assert QApplication.clipboard().text().count("<path ") == 2
    click_row(five, 4)
    five.key(Qt.Key.Key_V, CTRL | Qt.KeyboardModifier.AltModifier)
    assert [curve.name for curve in five.session.document.curves[5:]] == ["B copy", "C copy"]
    assert [curve.points for curve in five.session.document.curves[5:]] == [
        curve.points for curve in originals[1:3]
    ]
    assert (five.session.active_index, five.session.selected.curves) == (5, {5, 6})
    assert undo_text(five) == "Paste 2 curves"


def test_all_selected_curves_are_cut(five):
    choose(five, "BD")
    five.key(Qt.Key.Key_X, CTRL)
    assert (names(five), selected_names(five), undo_text(five)) == ("ACE", "C", "Cut 2 curves")
    five.key(Qt.Key.Key_V, CTRL)
    assert (names(five), selected_names(five)) == ("ACEBD", "BD")


def test_pasting_without_curves_on_the_clipboard_is_refused(five):
    data = QMimeData()
    data.setData(CURVES, b"{")
    QApplication.clipboard().setMimeData(data)
    document = five.session.document
    five.key(Qt.Key.Key_V, CTRL)
    assert five.status.startswith("The curves on the clipboard cannot be read")
    assert five.session.document is document


def test_data_of_older_versions_on_the_clipboard_are_reported(five):
    data = QMimeData()
    content = encode(Document((make_curve([(0.0, 0.0), (1.0, 1.0)], name="Old"),)))
    more = b'"version": 2, "kept_texts": [{}, {}],'
    data.setData(CURVES, content.replace(b'"version": 4,', more))
    QApplication.clipboard().setMimeData(data)
    five.key(Qt.Key.Key_V, CTRL)
    assert "Old" in [curve.name for curve in five.session.document.curves]
    assert (
        five.message
        == "The clipboard content was made with a version that had more features: 2 texts were left out."
    )


@pytest.mark.usefixtures("drawings_read_here")
def test_curves_that_are_imported_to_others_are_selected(five, tmp_path):
    path = tmp_path / "drawing.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L9 9"/><path d="M0 9L9 0"/></svg>')
    five.window.commands[ImportCommands].import_files([path])
    five.wait_for_work()
    QTest.mouseClick(five.window.findChild(QPushButton, "importDrawing"), LEFT)
    five.settle()
    assert (five.session.active_index, five.session.selected.curves) == (5, {5, 6})


# The order


@pytest.mark.parametrize(("name", "order"), [("raiseCurve", "ACBED"), ("lowerCurve", "BADCE")])
def test_selected_curves_are_raised_and_lowered_together(five, name, order):
    five.session.selected.set_curves({1, 3})
    five.trigger(name)
    verb = "Raise" if name == "raiseCurve" else "Lower"
    assert (names(five), selected_names(five)) == (order, "BD")
    assert undo_text(five) == f"{verb} 2 curves"
    assert five.status.startswith("Moved 2 curves one step to the ")
    assert five.curve.name == "B"
    five.trigger("undo")
    assert (names(five), selected_names(five)) == ("ABCDE", "BD")


@pytest.mark.parametrize(
    ("key", "order", "name"),
    [
        (Qt.Key.Key_Home, "ACEBD", "Raise 2 curves to top"),
        (Qt.Key.Key_End, "BDACE", "Lower 2 curves to bottom"),
    ],
)
def test_selected_curves_go_to_the_top_and_the_bottom_together(five, key, order, name):
    five.session.selected.set_curves({1, 3})
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    five.key(key, both)
    assert (names(five), selected_names(five), five.curve.name) == (order, "BD", "B")
    assert undo_text(five) == name
    steps = five.session.undo_stack.count()
    five.key(key, both)
    assert five.session.undo_stack.count() == steps, "they are there already"
    five.trigger("undo")
    assert (names(five), selected_names(five)) == ("ABCDE", "BD")


def test_selected_rows_are_dragged_together(five):
    five.session.selected.set_curves({1, 2}, 1)
    view = five.window.commands[CurveListCommands].panel.view
    start, end = view.parts.row_rect(2).center(), view.parts.row_rect(4).top()
    QTest.mousePress(view.viewport(), LEFT, pos=start)
    for y in (start.y() - 8, end - 1):
        QTest.mouseMove(view.viewport(), QPoint(start.x(), y))
    assert selected_names(five) == "BC"
    QTest.mouseRelease(view.viewport(), LEFT, pos=QPoint(start.x(), end - 1))
    assert (names(five), selected_names(five), undo_text(five)) == ("ADEBC", "BC", "Reorder 2 curves")
    # A click without a drag chooses the one alone, as before.
    QTest.mouseClick(view.viewport(), LEFT, pos=view.parts.row_rect(4).center())
    assert selected_names(five) == "C"


def test_rename_while_a_name_is_typed_commits_the_name_and_edits_again(editor):
    """Qt warned: "edit: editing failed"."""
    for text in ("First", "Second"):
        editor.trigger("renameCurve")
        QTest.keyClicks(QApplication.focusWidget(), text)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    editor.settle()
    assert editor.curve.name == "Second"
    assert editor.session.undo_stack.count() == 2


GREEN = "#009e73"


def fine_lines(editor, count):
    """So many short lines of 3 px in green, twenty in a row, of which all are chosen and none is edited."""
    editor.window.context.store.change(grid=False)
    curves = [
        make_curve([(k % 20, k // 20), (k % 20 + 0.4, k // 20 + 0.5)], name=f"Line {k}") for k in range(count)
    ]
    editor.session.commit(Document(tuple(curves)), "Begin")
    editor.window.canvas.camera.show_box((-1, 20), (-1, 13))
    style = Style(stroke=GREEN, width=3 / editor.window.canvas.camera.pixel_map.sx)
    styled = tuple(replace(curve, style=style) for curve in curves)
    editor.session.commit(Document(styled), "Style")
    editor.session.selected.select_whole(range(count))
    editor.settle()
    editor.wait_for_rest()
    return editor


def test_many_selected_curves_keep_their_colours_and_have_boxes(editor):
    """More than twelve fine lines had a line in the colour of choice in place of their own."""
    fine_lines(editor, 14)
    canvas = editor.window.canvas
    image, accent = canvas.viewport().grab().toImage(), canvas.layers.theme.accent
    for k in (0, 7, 13):
        assert image.pixelColor(canvas.to_pixel(k + 0.2, 0.25)) == QColor(GREEN)
        # Two pixels beside what is printed: half of the line, and half of a pixel more by its round end.
        left, top = (canvas.to_pixel(k, 0.5) - QPoint(3, 3)).toTuple()
        near = {image.pixelColor(left + dx, top + 20 + dy).name() for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
        assert accent.name() in near
    editor.session.selected.select_whole([])
    editor.settle()
    after = canvas.viewport().grab().toImage()
    assert accent.name() not in {after.pixelColor(x, top + 20).name() for x in range(left - 2, left + 3)}


def test_the_box_has_the_size_of_the_curves_and_its_grips_lie_outside(five):
    """They lay sixteen pixels off, where nothing but a line can be pressed."""
    five.session.selected.select_whole([0, 1])
    five.settle()
    box, scale = five.window.canvas.marks.box, five.window.canvas.pixel_map.sx
    outline = np.concatenate([five.session.views[at].polyline for at in (0, 1)])
    assert [*box.low, *box.high] == pytest.approx(
        [*outline.min(axis=0), *outline.max(axis=0)], abs=0.2 / scale
    )
    before = five.session.document.curves[1].points[-1].x
    x, y = five.grip(1, 1)
    assert ((x - box.high[0]) * scale, (y - box.high[1]) * scale) == pytest.approx((10.0, 10.0))
    five.drag((x, y), (x + 1.0, y))
    assert five.session.undo_stack.undoText() == "Scale 2 curves"
    assert five.session.document.curves[1].points[-1].x > before + 0.9
    five.session.selected.activate(0)
    five.select([0, 1])
    box = five.window.canvas.marks.box
    assert (five.grip(1, 1)[0] - box.high[0]) * scale == pytest.approx(16.0)
