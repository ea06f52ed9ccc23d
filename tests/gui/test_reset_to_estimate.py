"""Reset to Estimate: the selected points, all points, and points that were set to keep a shape."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.actions.keymap import plain
from app.document import point_edits
from app.document.derivatives import VelocityRule
from app.document.model import Document, Point, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE

HILLS = ((0, 0), (1, 2), (2.5, 1), (4, 3), (5, 0.5), (6.5, 2), (8, 0))
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def hills(editor):
    """A Hermite curve of seven points."""
    editor.session.commit(Document((make_curve(HILLS, name="Hills", family=HERMITE),)), "Begin")
    editor.fit()
    editor.select([])
    return editor


def set_velocities(editor, *indices):
    document = editor.session.document
    for index in indices:
        document = point_edits.set_velocity(document, 0, index, (9.0, 2.0 + index))
    editor.session.commit(document, "Set")


def explicit(editor):
    return sorted(point_edits.explicit_points(editor.curve, range(len(editor.curve.points))))


def titles(menu):
    return [plain(action.text()) for action in menu.actions() if not action.isSeparator()]


def offered(editor):
    """The text of the visible button of the message above the canvas, and the button."""
    button = editor.window.message_bar.findChild(QToolButton, "offeredAction")
    return (button.text(), button) if button.isVisible() else ("", None)


def test_the_menu_of_a_point_resets_the_selected_points_in_one_step(hills):
    set_velocities(hills, 1, 3, 5)
    hills.select([0, 3, 5])
    hills.open_menu(hills.point(3))
    hills.choose("resetVelocities")
    assert explicit(hills) == [1]
    assert hills.session.undo_stack.undoText() == "Reset 2 points to estimate"
    assert hills.status == "Reset points 3 and 5 to estimate."
    hills.trigger("undo")
    assert explicit(hills) == [1, 3, 5]


def test_the_menu_of_a_handle_resets_its_point(hills):
    set_velocities(hills, 3)
    hills.select_point(3)
    assert "Reset to Estimate" in titles(hills.open_menu(hills.handle(ahead=True).position))
    hills.choose("resetVelocities")
    assert explicit(hills) == []
    assert hills.status == "Reset point 3 to estimate."


def test_the_menu_of_the_curve_resets_all_points(hills):
    set_velocities(hills, 1, 3, 5)
    t = float(np.mean(hills.parameters[3:5]))
    menu = hills.open_menu(tuple(hills.session.active_view.curve.evaluate(t)))
    assert "Reset All to Estimate" in titles(menu)
    hills.choose("resetAllPoints")
    assert explicit(hills) == []
    assert hills.status == "Reset points 1, 3 and 5 to estimate."


def test_the_menu_of_a_curve_selected_as_a_whole_resets_all_points(hills):
    set_velocities(hills, 1, 3)
    hills.session.selected.select_whole([0])
    at = tuple(hills.session.active_view.curve.evaluate(float(np.mean(hills.parameters[3:5]))))
    assert "Reset All to Estimate" in titles(hills.open_menu(at))
    hills.choose("resetAllPoints")
    assert explicit(hills) == []


def test_the_table_resets_the_selected_rows_and_all_points(hills):
    set_velocities(hills, 1, 3, 5)
    table, button = hills.window.point_table, hills.window.findChild(QToolButton, "resetToEstimated")
    texts = [plain(action.text()) for action in table.actions()]
    assert {"Reset to Estimate", "Reset All to Estimate"} < set(texts)
    hills.select([0, 1])
    assert button.text() == "Reset to Estimate"
    QTest.mouseClick(button, LEFT)
    assert explicit(hills) == [3, 5]
    assert hills.status == "Reset velocity of point 1 to estimate."
    table.actions()[texts.index("Reset All to Estimate")].trigger()
    assert explicit(hills) == []


def test_reset_to_estimate_says_why_nothing_can_be_reset(hills):
    for name in ("resetVelocities", "resetKept"):
        assert not hills.action(name).isEnabled(), name
    hills.trigger("resetAllPoints")
    assert hills.status == "All derivatives are estimates already."
    hills.select([2])
    assert "a derivative set by hand" in hills.action("resetVelocities").toolTip()
    # An acceleration is none of this family's: there is nothing that shows.
    set_acceleration = point_edits.set_derivative(hills.session.document, 0, 2, 2, (1.0, 2.0))
    hills.session.commit(set_acceleration, "Set")
    assert not hills.action("resetVelocities").isEnabled()
    hills.trigger("resetAllPoints")
    assert hills.status == "All derivatives are estimates already."
    hills.choose_family(LAGRANGE)
    hills.select([2])
    assert "velocities" in hills.action("resetVelocities").toolTip()


def test_a_corner_that_is_reset_stays_a_corner_with_an_estimate_on_each_side(hills):
    hills.select([3])
    hills.trigger("tangentCorner")
    hills.drag_handle((4.5, 1.0), ahead=True)
    hills.trigger("resetVelocities")
    point = hills.curve.points[3]
    assert (point.corner, point.velocity, point.velocity_after) == (True, None, None)
    assert hills.status == "Reset point 3 to estimate. Point 3 stays a corner, estimated on each side."


def test_a_smooth_point_of_two_lengths_that_is_reset_stays_smooth(hills):
    """It became a corner, because the tie was all that held it."""
    hills.select([3])
    hills.trigger("tangentSmooth")
    hills.drag_handle((4.5, 4.0), ahead=True)
    assert hills.curve.points[3].tied
    hills.trigger("resetVelocities")
    assert hills.curve.points[3] == Point(4.0, 3.0, t=hills.curve.points[3].t)
    assert hills.status == "Reset point 3 to estimate."


def test_points_of_several_curves_are_reset_in_one_step(editor):
    curve = make_curve(HILLS, family=QUINTIC_HERMITE)
    set_there = tuple(replace(point, velocity=(1.0, 2.0)) for point in curve.points)
    curves = (replace(curve, points=set_there), replace(curve, name="b", points=set_there))
    editor.session.commit(Document(curves), "Begin")
    editor.session.selected.set_curves([0, 1], 0)
    editor.trigger("resetAllPoints")
    assert editor.session.document.curves[1].points == curve.points
    assert editor.session.document.curves[0].points == curve.points
    assert editor.status == "Reset 14 points in 2 curves to estimate."


# Points that were set to keep the shape


def test_points_set_to_keep_the_shape_are_named_and_reset_by_the_message(hills):
    """A corner divides Akima's estimates beside it: local rules cannot keep the shape by themselves."""
    akima = replace(hills.curve, velocity_rule=VelocityRule.AKIMA)
    hills.session.commit(Document((akima,)), "Akima")
    hills.select([3])
    hills.trigger("tangentCorner")
    assert explicit(hills) == [2, 3, 4]
    assert hills.message == "Points 2 and 4 were set to keep the shape."
    text, button = offered(hills)
    assert text == "Reset to Estimate"
    steps = hills.session.undo_stack.count()
    QTest.mouseClick(button, LEFT)
    hills.settle()
    assert explicit(hills) == [3]
    assert hills.status == "Reset points 2 and 4 to estimate."
    assert hills.session.undo_stack.count() == steps + 1
    assert hills.message == ""
    assert not hills.action("resetKept").isEnabled()


def test_the_offer_ends_with_the_next_step_and_with_undo(hills):
    akima = replace(hills.curve, velocity_rule=VelocityRule.AKIMA)
    hills.session.commit(Document((akima,)), "Akima")
    for end in (lambda: hills.trigger("undo"), lambda: hills.drag_point(0, to=(0.0, 1.0))):
        hills.select([3])
        hills.trigger("tangentCorner")
        assert hills.message
        end()
        assert hills.message == ""
        assert not hills.action("resetKept").isEnabled()
