"""Enter with the pen in hand: the curve is finished, and the next press begins another one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt

from app.document import point_edits, rule_edits
from app.document.model import ParametrizationKind, Point
from app.families import HERMITE, LAGRANGE
from app.view_model.curve.handles import handles_of
from tests.gui.editor_facts import at, undo_text

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def pen(editor):
    """An open Hermite curve of three points, and the pen in hand."""
    editor.new()
    places = [at(editor, x, y) for x, y in ((0, 0), (100, 60), (200, 0))]
    document = rule_edits.set_family(editor.session.document, 0, HERMITE)
    document = point_edits.set_points(document, 0, [Point(*place) for place in places])
    editor.session.commit(document, "Begin")
    editor.session.selected.set_points([2])
    editor.trigger("addTool")
    return editor


def hint(editor):
    return editor.window.status_line.hint


def sizes(editor):
    return [len(curve.points) for curve in editor.session.document.curves]


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Enter])
def test_enter_finishes_and_the_next_press_begins_another_curve(pen, key):
    document, steps = pen.session.document, pen.session.undo_stack.count()
    pen.hover(at(pen, 300, 150))
    assert hint(pen).startswith("Click to add point 3 · Enter, double click: finish the curve")
    pen.key(key)
    assert pen.status == "“Curve 1” is finished; the next press begins another curve."
    assert hint(pen).startswith("Click to begin another curve · Shift: add point 3 to this one")
    assert pen.session.document is document
    assert pen.session.undo_stack.count() == steps
    assert pen.session.selection == frozenset()
    pen.click(at(pen, 300, 150))
    pen.click(at(pen, 340, 150))
    assert sizes(pen) == [3, 2]
    assert pen.session.active_index == 1
    assert pen.session.document.curves[0] == document.curves[0]


def test_several_curves_are_drawn_in_a_row_and_the_active_curve_continues(pen):
    for y in (150, 200):
        pen.key(Qt.Key.Key_Return)
        pen.click(at(pen, 300, y))
        pen.click(at(pen, 340, y))
    assert sizes(pen) == [3, 2, 2]
    pen.session.selected.activate(0)
    pen.hover(at(pen, 400, 200))
    assert hint(pen).startswith("Click to begin another curve")
    pen.session.selected.activate(2)
    pen.hover(at(pen, 400, 200))
    assert hint(pen).startswith("Click to add point 2")


def test_a_click_on_the_last_point_continues_the_curve(pen):
    pen.key(Qt.Key.Key_Return)
    pen.hover(pen.point(2))
    assert hint(pen) == "Click to continue this curve · Drag to pull out its handle"
    pen.click(pen.point(2))
    assert pen.status == "Continuing “Curve 1”; the next press adds point 3."
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [4]


@pytest.mark.parametrize("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.MANUAL])
def test_a_click_on_the_first_point_of_a_finished_curve_continues_from_the_start(pen, kind):
    """It closed a curve that had been finished long ago."""
    document = rule_edits.set_parametrization(pen.session.document, 0, kind, [0.0, 0.3, 1.0])
    pen.session.commit(point_edits.set_velocity(document, 0, 1, (400.0, -90.0)), "Begin")
    drawn, first = pen.session.active_view.curve.evaluate(np.linspace(0, 1, 33)), pen.point(0)
    pen.hover(first)
    assert hint(pen) == "Click to continue this curve from its first point · Drag to pull out its handle"
    assert pen.window.canvas.marks.preview_curve is None
    pen.click(first)
    assert pen.status == "Continuing “Curve 1”; the next press adds point 3."
    assert (pen.curve.is_closed, pen.point(2), pen.session.selection) == (False, first, {2})
    assert pen.curve.points[1].velocity == pytest.approx((-400, 90))
    now = pen.session.active_view.curve.evaluate(np.linspace(0, 1, 33))
    assert now == pytest.approx(drawn[::-1], abs=1e-9)
    pen.click(at(pen, 40, 200))
    assert (sizes(pen), pen.point(2)) == ([4], first)
    # It is drawn now, and its other end closes it.
    pen.hover(pen.point(0))
    assert hint(pen).startswith("Click to close the curve")
    closed = pen.window.canvas.marks.preview_curve.source
    pen.click(pen.point(0))
    assert pen.curve.is_closed
    assert pen.curve == closed


@pytest.mark.parametrize("end", [0, 2])
def test_a_drag_at_an_end_pulls_out_its_handle_and_the_curve_goes_on(pen, end):
    """As at an end of any other curve."""
    pen.key(Qt.Key.Key_Return)
    before, position = pen.curve, pen.point(end)
    tip = (position[0] + 30 * pen.pixel, position[1] + 50 * pen.pixel)
    pen.press(position)
    pen.move(tip)
    assert pen.status.startswith("Continue Curve 1, handle at 59")
    pen.escape()
    pen.release(tip)
    assert pen.curve == before
    pen.drag(position, tip)
    assert undo_text(pen) == "Continue Curve 1"
    assert pen.point(2) == position
    pen.click(at(pen, 300, 150), keys=Qt.KeyboardModifier.AltModifier)
    assert sizes(pen) == [4]
    (ahead,) = (each for each in handles_of(pen.session.active_view, 2) if each.ahead and each.order == 1)
    assert ahead.position == pytest.approx(tip, abs=1.5 * pen.pixel)


def test_a_click_with_shift_continues_a_finished_curve(pen):
    pen.key(Qt.Key.Key_Return)
    pen.click(at(pen, 300, 150), keys=SHIFT)
    assert sizes(pen) == [4]
    pen.click(at(pen, 340, 150))
    assert sizes(pen) == [5]


def test_escape_cancels_a_press_with_shift_and_the_curve_stays_finished(pen):
    document = pen.session.document
    pen.key(Qt.Key.Key_Return)
    pen.press(at(pen, 300, 150), keys=SHIFT)
    pen.escape()
    pen.release(at(pen, 300, 150))
    assert pen.session.document is document
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [3, 1]


def test_escape_cancels_a_new_curve_and_the_finished_curve_stays_finished(pen):
    document = pen.session.document
    pen.key(Qt.Key.Key_Return)
    pen.press(at(pen, 300, 150))
    pen.move(at(pen, 330, 170))
    assert sizes(pen) == [3, 1]
    pen.escape()
    pen.release(at(pen, 330, 170))
    assert pen.session.document is document
    assert pen.session.active_index == 0
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [3, 1]
    pen.trigger("undo")
    assert sizes(pen) == [3]
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [3, 1]


def test_a_finished_curve_stays_finished_with_another_tool_in_between(pen):
    pen.key(Qt.Key.Key_Return)
    pen.escape()
    assert pen.action("selectTool").isChecked()
    pen.trigger("addTool")
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [3, 1]


def test_without_enter_the_reactivated_pen_continues_the_curve(pen):
    pen.escape()
    pen.trigger("addTool")
    pen.click(at(pen, 300, 150))
    assert sizes(pen) == [4]


def test_enter_does_not_finish_during_a_press_with_another_tool_or_after_one_point(pen):
    pen.press(at(pen, 300, 150))
    pen.key(Qt.Key.Key_Return)
    pen.release(at(pen, 300, 150))
    pen.trigger("selectTool")
    pen.key(Qt.Key.Key_Return)
    pen.trigger("addTool")
    pen.click(at(pen, 340, 150))
    assert sizes(pen) == [5]
    pen.new()
    pen.click(at(pen, 0, 0))
    pen.key(Qt.Key.Key_Return)
    pen.click(at(pen, 50, 0))
    assert sizes(pen) == [2]


def test_another_document_knows_of_no_finished_curve(pen):
    pen.key(Qt.Key.Key_Return)
    pen.new()
    for x in (0, 100, 200):
        pen.click(at(pen, x, 0))
    assert sizes(pen) == [3]


def test_a_point_that_is_being_inserted_is_not_drawn_to_itself(pen):
    x, y = map(float, pen.session.active_view.curve.evaluate(0.3))
    pen.trigger("toggleSnap")
    pen.press((x, y))
    away = (x + 12 * pen.pixel, y + 3 * pen.pixel)
    pen.move(away)
    pen.move((away[0] + 4 * pen.pixel, away[1]))
    snap = pen.window.canvas.marks.snap
    assert snap is None or "point 1" not in snap.label
    pen.escape()


# Steps of 15 degrees


def direction(editor, index):
    return math.degrees(math.atan2(*reversed(editor.curve.points[index].velocity)))


@pytest.mark.parametrize("keys", [SHIFT, CTRL])
def test_a_key_turns_the_velocity_drawn_out_in_steps(pen, keys):
    place = at(pen, 300, 150)
    pen.press(place)
    pen.move(at(pen, 360, 180))
    assert direction(pen, 3) == pytest.approx(26.6, abs=1.5)
    pen.move(at(pen, 360, 180), keys=keys)
    assert direction(pen, 3) == pytest.approx(30, abs=1e-9)
    assert "velocity at 30° · both handles stay · Ctrl or Shift: steps of 15°" in pen.status
    assert "%" not in pen.status
    assert math.dist(pen.handle().position, place) == pytest.approx(
        math.dist(at(pen, 360, 180), place), abs=2 * pen.pixel
    )
    pen.release(at(pen, 360, 180), keys=keys)
    assert direction(pen, 3) == pytest.approx(30, abs=1e-9)


def test_a_click_with_ctrl_puts_the_point_at_an_angle_step_from_the_last_point(pen):
    pen.trigger("toggleSnap")
    (x, y), count = pen.point(2), len(pen.curve.points)
    to = (x + 1.0, y + 0.6)
    pen.hover(to)
    assert "Ctrl: steps of 15°" in hint(pen)
    pen.move(to, held=False, keys=CTRL)
    end = pen.window.canvas.marks.preview_curve.source.points[count].position
    assert math.degrees(math.atan2(end[1] - y, end[0] - x)) == pytest.approx(30, abs=1e-9)
    assert pen.window.canvas.marks.snap is None
    pen.click(to, keys=CTRL)
    assert pen.point(count) == pytest.approx(end, abs=2 * pen.pixel)
    assert pen.point(count)[1] - y == pytest.approx((pen.point(count)[0] - x) / math.sqrt(3), abs=1e-12)


def test_escape_cancels_a_velocity_drawn_in_steps(pen):
    document = pen.session.document
    pen.press(at(pen, 300, 150))
    pen.move(at(pen, 360, 180), keys=SHIFT)
    pen.escape()
    pen.release(at(pen, 360, 180), keys=SHIFT)
    assert pen.session.document is document


def test_the_hint_names_the_snap_key_where_a_drag_moves_the_point(pen):
    pen.choose_family(LAGRANGE)
    pen.press(at(pen, 300, 150))
    spacing = pen.window.canvas.tools.canvas.grid_spacing()
    by_the_grid = (12 * spacing + 3 * pen.pixel, 9 * spacing + 2 * pen.pixel)
    pen.move(by_the_grid)
    assert "%: snap on or off" in pen.status
    assert "Shift" not in pen.status
    assert pen.point(3) == pytest.approx(by_the_grid, abs=pen.pixel)
    pen.key(Qt.Key.Key_Percent)
    assert pen.point(3) == pytest.approx((12 * spacing, 9 * spacing), rel=1e-12)
    pen.escape()


MEASURED = [((160, 70), "30°"), ((30, 150), "90°"), ((-90, 11), "180°")]


def test_measuring_with_shift_uses_angle_steps(pen):
    pen.trigger("measureTool")
    for to, angle in MEASURED:
        start = at(pen, 40, 20)
        pen.hover(start)
        assert "Ctrl or Shift: steps of 15° · %: snap on or off" in hint(pen), angle
        pen.press(start)
        pen.move(at(pen, *to), keys=SHIFT)
        ruler = pen.window.canvas.marks.ruler
        assert ruler.text.endswith(f" · {angle}"), angle
        assert "Ctrl or Shift: steps of 15° · %: snap on or off" in pen.status, angle
        assert math.dist(ruler.start, ruler.end) == pytest.approx(
            math.dist(start, at(pen, *to)), abs=2 * pen.pixel
        )
        pen.move(at(pen, *to))
        assert not pen.window.canvas.marks.ruler.text.endswith(f" · {angle}"), angle
        pen.escape()
        assert pen.window.canvas.marks.ruler is None, angle
        pen.release(at(pen, *to))


def test_enter_with_one_point_reports_the_missing_second_point(editor):
    editor.new()
    editor.trigger("addTool")
    editor.click((1.0, 1.0))
    editor.key(Qt.Key.Key_Return)
    assert editor.status == "A curve needs two points before it can be finished."
    editor.click((2.0, 1.0))
    assert len(editor.curve.points) == 2


# Double click


def test_a_double_click_adds_one_point_and_finishes(pen):
    steps = pen.session.undo_stack.count()
    pen.double_click(at(pen, 300, 150))
    assert sizes(pen) == [4]
    assert pen.session.undo_stack.count() == steps + 1
    assert pen.status == "“Curve 1” is finished; the next press begins another curve."
    pen.click(at(pen, 340, 150))
    assert sizes(pen) == [4, 1]


def test_a_curve_of_double_clicks_alone_needs_two_points(editor):
    editor.new()
    editor.double_click(at(editor, 0, 0))
    assert sizes(editor) == [1]
    editor.double_click(at(editor, 100, 60))
    assert sizes(editor) == [2]
    editor.click(at(editor, 200, 60))
    assert sizes(editor) == [2, 1]


def test_a_double_click_on_the_first_point_closes(pen):
    pen.click(at(pen, 300, 150))
    pen.double_click(pen.point(0))
    assert sizes(pen) == [4]
    assert pen.curve.is_closed
    assert pen.session.undo_stack.undoText() == "Close Curve 1"


def test_the_second_press_of_a_double_click_drags_the_point_as_any_press_does(pen):
    place = at(pen, 300, 150)
    pen.click(place)
    pixel = pen.window.canvas.to_pixel(*place)
    pen.send(pen.window.canvas, QEvent.Type.MouseButtonDblClick, pixel)
    pen.move(at(pen, 320, 180))
    pen.release(at(pen, 320, 180))
    assert pen.point(3) == pytest.approx(at(pen, 320, 180), abs=2 * pen.pixel)
    pen.click(at(pen, 360, 200))
    assert sizes(pen) == [5]


def test_a_click_on_the_first_point_closes_a_curve_without_handles_with_a_message(pen):
    pen.choose_family("cubic_spline")
    pen.click(at(pen, 300, 150))
    pen.hover(pen.point(0))
    assert hint(pen) == "Click to close the curve"


@pytest.fixture
def two_drawn(editor):
    """Two points drawn with velocities, up and down, and the pen still in hand; every panel in sight."""
    editor.new()
    for name in ("joints", "points", "curve", "analysis", "hodograph"):
        editor.show_dock(f"{name}Dock")
    editor.choose_family(HERMITE)
    editor.trigger("addTool")
    editor.drag(at(editor, 0, 0), at(editor, 0, 60))
    editor.drag(at(editor, 200, 0), at(editor, 200, -60))
    return editor


def is_lens(editor):
    """Whether the curve goes above the line of its points on the way there, and below on the way back."""
    curve = editor.session.active_view.curve
    start, end = curve.domain
    there, back = curve.evaluate([start + share * (end - start) for share in (0.25, 0.75)])
    height = editor.point(0)[1]
    return there[1] > height + editor.pixel > height - editor.pixel > back[1]


def test_a_click_on_the_first_of_two_points_closes_a_lens(two_drawn):
    pen = two_drawn
    pen.hover(pen.point(0))
    assert hint(pen).startswith("Click to close the curve")
    pen.click(pen.point(0))
    assert pen.curve.is_closed
    assert sizes(pen) == [2]
    assert is_lens(pen)
    pen.trigger("undo")
    assert not pen.curve.is_closed
    assert sizes(pen) == [2]


def test_two_points_are_closed_by_key_opened_and_closed_again(two_drawn):
    pen = two_drawn
    pen.key(Qt.Key.Key_C)
    assert pen.curve.is_closed
    assert is_lens(pen)
    pen.trigger("selectTool")
    pen.bend(0.25, at(pen, 100, 120))
    assert pen.curve.is_closed
    assert sizes(pen) == [2]
    assert is_lens(pen)
    pen.trigger("selectAll")
    pen.trigger("resetVelocities")
    # Nothing is set: a line there and back.
    assert pen.session.active_view.is_current
    assert not is_lens(pen)
    pen.key(Qt.Key.Key_C)
    assert not pen.curve.is_closed


def test_closing_a_curve_of_two_points_is_refused_with_the_reason(two_drawn):
    pen = two_drawn
    pen.choose_family("cubic_spline")
    pen.hover(pen.point(0))
    assert "close the curve" not in hint(pen)
    pen.key(Qt.Key.Key_C)
    assert not pen.curve.is_closed
    assert pen.status.startswith(
        "A closed curve needs at least three points here: through two, a cubic spline"
    )
