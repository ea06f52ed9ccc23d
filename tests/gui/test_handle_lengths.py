"""Handles by length and angle: in the point table, and typed while one is dragged."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from app.document import point_edits, rule_edits
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE
from app.features.point_table.view import CellEditor
from tests.gui.editor_facts import undo_text

Key = Qt.Key
ALT, CTRL = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ControlModifier
POINTS = ((0.0, 0.0), (2.0, 1.0), (5.0, 0.0), (7.0, 3.0))
ROUNDING = 1e-12
"""Lengths and angles come back from a velocity by four or five operations on numbers below 100."""


@pytest.fixture
def wave(editor):
    """A curve of four points with t = 0, 1/4, 5/8, 1: exact numbers."""
    document = Document((make_curve(POINTS, family=HERMITE),))
    document = rule_edits.freeze_parameters(document, 0, (0.0, 0.25, 0.625, 1.0))
    editor.session.change("Begin", lambda _document: document)
    editor.window.resize(1600, 900)
    editor.fit()
    return editor


def column(editor, name):
    return [each.name for each in editor.window.point_table.model().columns].index(name)


def value(editor, row, name):
    editor.settle()
    return float(editor.window.point_table.model().values[row, column(editor, name)])


def enter(editor, row, name, text):
    """Type a number into a cell."""
    editor.settle()
    table = editor.window.point_table
    table.edit_cell(table.model().index(row, column(editor, name)))
    field = table.viewport().findChild(CellEditor)
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Key.Key_Return)
    editor.settle()
    if table.state() == table.State.EditingState:
        QTest.keyClick(field, Key.Key_Escape)


def velocity(editor, index):
    return editor.session.active_view.velocity_of(index)


def test_lengths_and_angles_stand_beside_vx_and_vy_only_where_they_are_wanted(wave):
    table = wave.window.point_table
    names = [each.name for each in table.model().columns]
    assert names == ["t", "x", "y", "vx", "vy"]
    wave.trigger("toggleHandleColumns")
    assert [each.name for each in table.model().columns] == [*names[:3], "ℓ←", "∠←", "ℓ→", "∠→", *names[3:]]
    header = table.model().headerData
    tip = header(column(wave, "∠→"), Qt.Orientation.Horizontal, Qt.ItemDataRole.ToolTipRole)
    assert tip == "Angle of the handle ahead in degrees, counterclockwise from x"
    assert wave.window.preferences.handle_columns
    wave.choose_family("lagrange")
    assert [each.name for each in table.model().columns] == ["t", "x", "y"]
    wave.choose_family("hermite")
    wave.trigger("toggleHandleColumns")
    assert [each.name for each in table.model().columns] == names


@pytest.mark.parametrize("scale", [1.0, 100.0])
def test_lengths_and_angles_are_in_sight_at_the_usual_size_with_a_decimal_of_degrees(wave, scale):
    """The angle ahead was behind a scroll bar, and −166.889° was “−167”."""
    wave.window.resize(1440, 900)
    points = [(scale * x + 0.0025 * scale, scale * y) for x, y in ((0, 0), (2, 1), (4, 0), (6, 1), (8, 0))]
    wave.session.change("Begin", lambda _: Document((make_curve(points, family=HERMITE),)))
    wave.trigger("toggleHandleColumns")
    wave.settle()
    table, last = wave.window.point_table, column(wave, "∠→")
    assert table.columnViewportPosition(last) + table.columnWidth(last) <= table.viewport().width()
    assert "." in table.cell_delegate.text(3, column(wave, "∠←"))
    assert "." in table.cell_delegate.text(3, last)


def test_length_and_angle_are_those_of_the_bezier_control_points(wave):
    """The handle ahead is h v / 3, the one behind −h v / 3 with the h of its own segment."""
    wave.trigger("toggleHandleColumns")
    enter(wave, 1, "vx", "12")
    enter(wave, 1, "vy", "-9")
    for arrow, h, angle in (
        ("←", Fraction(1, 4), math.atan2(9, -12)),
        ("→", Fraction(3, 8), math.atan2(-9, 12)),
    ):
        # |v| = 15.
        assert value(wave, 1, f"ℓ{arrow}") == pytest.approx(float(h * 15 / 3), abs=ROUNDING)
        assert value(wave, 1, f"∠{arrow}") == pytest.approx(math.degrees(angle), abs=ROUNDING)
    assert math.isnan(value(wave, 0, "ℓ←"))
    assert math.isnan(value(wave, 3, "∠→"))
    drawn = wave.session.active_view.source.points[1].position
    wave.select_point(1)
    assert value(wave, 1, "ℓ→") == pytest.approx(
        math.dist(wave.handle(ahead=True).position, drawn), abs=ROUNDING
    )


def test_a_length_keeps_the_angle_and_an_angle_the_length(wave):
    wave.trigger("toggleHandleColumns")
    angle, behind = value(wave, 2, "∠→"), value(wave, 2, "ℓ←") / value(wave, 2, "ℓ→")
    assert wave.window.point_table.model().estimated[2, column(wave, "ℓ→")]
    enter(wave, 2, "ℓ→", "1/4")
    assert undo_text(wave) == "Set length of the handle ahead of point 2"
    assert value(wave, 2, "ℓ→") == pytest.approx(0.25, abs=ROUNDING)
    assert value(wave, 2, "∠→") == pytest.approx(angle, abs=ROUNDING)
    # One velocity on both sides: the other handle keeps its share.
    assert value(wave, 2, "ℓ←") == pytest.approx(behind / 4, abs=ROUNDING)
    assert not wave.window.point_table.model().estimated[2, column(wave, "ℓ→")]
    enter(wave, 2, "∠→", "90")
    assert undo_text(wave) == "Set angle of the handle ahead of point 2"
    # Exactly: 1/4 in 3/8 of t is 2 a third of t.
    assert velocity(wave, 2) == pytest.approx((0.0, 2.0), abs=ROUNDING)
    assert value(wave, 2, "∠←") == -90.0
    wave.trigger("undo")
    wave.trigger("undo")
    assert wave.curve.points[2].velocity is None


def test_both_sides_of_a_corner_are_set_apart(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    wave.trigger("toggleHandleColumns")
    before = [value(wave, 1, name) for name in ("ℓ←", "∠←")]
    enter(wave, 1, "ℓ→", "3")
    enter(wave, 1, "∠→", "-45")
    assert [value(wave, 1, name) for name in ("ℓ←", "∠←")] == before
    root = math.sqrt(0.5)
    expected = (3 * root * 3 / 0.375, -3 * root * 3 / 0.375)
    assert wave.curve.points[1].velocity_after == pytest.approx(expected, abs=1e-11)
    enter(wave, 1, "∠←", "180")
    assert wave.curve.points[1].velocity[1] == pytest.approx(0.0, abs=ROUNDING)
    assert wave.curve.points[1].velocity[0] > 0


def test_a_handle_without_length_says_why_it_has_no_angle(wave):
    wave.trigger("toggleHandleColumns")
    enter(wave, 1, "ℓ→", "0")
    assert velocity(wave, 1) == (0.0, 0.0)
    assert math.isnan(value(wave, 1, "∠→"))
    before = wave.session.document
    enter(wave, 1, "∠→", "30")
    assert (
        "The velocity handle ahead of point 1 has no length, and so no angle. Drag it out first."
        in wave.status
    )
    assert wave.session.document is before
    # Its length pulls it out along the points beside it.
    enter(wave, 1, "ℓ→", "2")
    assert value(wave, 1, "∠→") == pytest.approx(0.0, abs=ROUNDING)
    assert value(wave, 1, "ℓ→") == pytest.approx(2.0, abs=ROUNDING)


@pytest.mark.parametrize(
    ("row", "name", "text", "reason"),
    [
        (0, "ℓ←", "1", "The curve ends at point 0: there is no handle behind it."),
        (3, "∠→", "1", "The curve ends at point 3: there is no handle ahead of it."),
        (1, "ℓ→", "-1", "The length of the velocity handle ahead of point 1 is 0 or more"),
    ],
)
def test_what_cannot_be_set_is_refused_with_the_reason(wave, row, name, text, reason):
    wave.trigger("toggleHandleColumns")
    before = wave.session.document
    enter(wave, row, name, text)
    assert reason in wave.status
    assert wave.session.document is before


def test_delete_resets_a_handle_to_its_estimate(wave):
    wave.trigger("toggleHandleColumns")
    enter(wave, 1, "ℓ→", "2")
    table = wave.window.point_table
    flags = table.selectionModel().SelectionFlag
    table.selectionModel().setCurrentIndex(table.model().index(1, column(wave, "ℓ→")), flags.ClearAndSelect)
    QTest.keyClick(table, Key.Key_Delete)
    assert wave.curve.points[1].velocity is None
    assert undo_text(wave) == "Reset length of the handle ahead of point 1"


def test_the_handle_of_an_acceleration_is_measured_from_that_of_the_velocity(wave):
    wave.choose_family(FAMILIES.named("quintic_hermite"))
    wave.trigger("toggleHandleColumns")
    enter(wave, 1, "aℓ→", "1.5")
    enter(wave, 1, "a∠→", "60")
    wave.select_point(1)
    tip, below = (np.array(wave.handle(order, ahead=True).position) for order in (2, 1))
    expected = 1.5 * np.array([math.cos(math.radians(60)), math.sin(math.radians(60))])
    assert tip - below == pytest.approx(expected, abs=ROUNDING)
    assert wave.curve.points[1].acceleration is not None


def copied(editor):
    QTest.keyClick(editor.window.point_table, Key.Key_C, CTRL)
    return QGuiApplication.clipboard().text()


def paste_at(editor, row, name, text):
    table = editor.window.point_table
    flags = table.selectionModel().SelectionFlag
    table.selectionModel().setCurrentIndex(
        table.model().index(row, column(editor, name)), flags.ClearAndSelect
    )
    QGuiApplication.clipboard().setText(text)
    QTest.keyClick(table, Key.Key_V, CTRL)
    editor.settle()


def test_pasted_lengths_and_angles_are_both_set_and_empty_cells_leave_the_ends_alone(wave):
    wave.trigger("toggleHandleColumns")
    paste_at(wave, 1, "ℓ→", "1.5\t60\n0.75\t-30\n\t")
    for row, length, angle in ((1, 1.5, 60.0), (2, 0.75, -30.0)):
        assert value(wave, row, "ℓ→") == pytest.approx(length, abs=ROUNDING)
        assert value(wave, row, "∠→") == pytest.approx(angle, abs=ROUNDING)
    assert wave.curve.points[3].velocity is None


def test_rows_that_are_copied_with_their_handles_come_back_the_same(wave):
    wave.trigger("toggleHandleColumns")
    wave.window.point_table.selectAll()
    text = copied(wave)
    assert text.splitlines()[0].split("\t")[3:5] == ["", ""]
    before = wave.session.active_view
    paste_at(wave, 0, "t", text)
    assert wave.status.startswith("Pasted 4 points")
    for index, point in enumerate(wave.curve.points):
        assert point.velocity == before.velocity_of(index)


# Typed while a handle is dragged


def test_length_and_angle_are_typed_while_a_handle_is_dragged(wave):
    wave.set_unit("mm")
    wave.select_point(1)
    start = wave.handle(ahead=True).position
    steps = wave.session.undo_stack.count()
    wave.press(start)
    wave.move((start[0] + 0.5, start[1] + 0.5))
    assert wave.status.startswith("Velocity of point 1: ")
    assert "digits: length, Tab: angle" in wave.status
    offset = np.array(wave.handle(ahead=True).position) - POINTS[1]
    wave.type_amount("0.15cm")
    assert "handle 0.15cm| at " in wave.status
    now = np.array(wave.handle(ahead=True).position) - POINTS[1]
    assert now == pytest.approx(1.5 * offset / np.hypot(*offset), abs=ROUNDING)
    wave.key(Key.Key_Tab)
    wave.type_amount("-90")
    assert "handle 0.15cm at −90|" in wave.status
    assert "typing angle · Tab: length" in wave.status
    wave.key(Key.Key_Return)
    assert wave.handle(ahead=True).position == pytest.approx((2.0, -0.5), abs=ROUNDING)
    assert undo_text(wave) == "Set velocity of point 1"
    assert wave.session.undo_stack.count() == steps + 1
    wave.release(start)
    assert wave.session.undo_stack.count() == steps + 1


def test_escape_restores_a_handle_whose_length_was_typed(wave):
    wave.select_point(1)
    before, start = wave.session.document, wave.handle(ahead=False).position
    wave.press(start)
    wave.move((start[0] + 0.5, start[1] + 0.5))
    wave.type_amount("4")
    assert wave.session.document != before
    wave.escape()
    assert wave.session.document == before
    wave.release(start)
    assert wave.session.document == before


def test_an_angle_has_no_unit(wave):
    wave.set_unit("mm")
    wave.select_point(1)
    start = wave.handle(ahead=True).position
    wave.press(start)
    wave.move((start[0] + 0.5, start[1] + 0.5))
    wave.key(Key.Key_Tab)
    wave.type_amount("5m")
    assert wave.status.startswith("A factor or an angle has no unit")
    wave.escape()


def test_a_velocity_that_is_pulled_out_takes_length_and_angle(wave):
    wave.press(POINTS[2], keys=ALT)
    wave.move((5.5, 0.5), keys=ALT)
    wave.type_amount("3")
    wave.key(Key.Key_Tab)
    wave.type_amount("0")
    wave.key(Key.Key_Return)
    wave.release((5.5, 0.5))
    # h = 3/8 ahead of it.
    assert wave.curve.points[2].velocity == pytest.approx((24.0, 0.0), abs=ROUNDING)


# Velocities that are typed


@pytest.mark.parametrize("kind", ["tangentCorner", "tangentSmooth", "tangentSymmetric"])
def test_a_point_whose_velocity_is_typed_to_zero_stands_still_on_both_sides(wave, kind):
    """After a corner the robot went on with v = (3.67, 0.148); a symmetric point kept (0, −14.2) after it."""
    wave.select_point(1)
    wave.trigger(kind)
    for name in ("vx", "vy"):
        enter(wave, 1, name, "0")
    assert wave.curve.points[1].explicit_sides(1) == ((0.0, 0.0), (0.0, 0.0))
    enter(wave, 1, "vx", "2")
    assert wave.curve.points[1].explicit_sides(1) == ((2.0, 0.0), (2.0, 0.0))


def test_a_quintic_stops_where_zero_is_typed_after_a_corner(wave):
    wave.choose_family("quintic_hermite")
    wave.select_point(1)
    wave.trigger("tangentCorner")
    model = wave.window.point_table.model()
    for name in ("vx", "vy", "ax", "ay"):
        assert not model.shows_one_side(1, column(wave, name))
        enter(wave, 1, name, "0")
    before, after = wave.session.active_view.sides
    assert not before[1, 1:].any()
    assert not after[1, 1:].any()


def test_a_number_typed_at_a_corner_of_two_velocities_is_the_one_before_it(wave):
    wave.select_point(1)
    wave.trigger("tangentCorner")
    enter(wave, 1, "vy", "3")
    document = point_edits.set_velocity(wave.session.document, 0, 1, (5.0, 3.0), ahead=True)
    wave.session.change("Turn", lambda _document: document)
    enter(wave, 1, "vx", "0")
    assert wave.curve.points[1].explicit_sides(1) == ((0.0, 3.0), (5.0, 3.0))
    table = wave.window.point_table.model()
    assert "before the corner; 5.0 after it" in table.data(
        table.index(1, column(wave, "vx")), Qt.ItemDataRole.ToolTipRole
    )
