"""Straight lines with the pen: Alt+click."""

from __future__ import annotations

import math

import pytest
from PySide6.QtCore import Qt

from app.document import point_edits, rule_edits
from app.document.constraints import is_straight
from app.document.model import Point
from app.families import FAMILIES, LAGRANGE
from tests.gui.editor_facts import at

ALT = Qt.KeyboardModifier.AltModifier
WITH_VELOCITIES = [family for family in FAMILIES if family.derivatives]
PLACES = ((20, 20), (160, 40), (140, 200), (40, 180))


def lines(editor):
    """Which segments of the curve are straight."""
    curve = editor.curve
    count = len(curve.points) if curve.is_closed else len(curve.points) - 1
    return [is_straight(curve, segment) for segment in range(count)]


def test_alt_click_makes_a_polygon(pen):
    empty = pen.session.document
    for family in WITH_VELOCITIES:
        pen.session.commit(rule_edits.set_family(empty, 0, family), "Begin")
        for place in PLACES:
            pen.click(at(pen, *place), keys=ALT)
        assert lines(pen) == [True] * 3, family
        assert pen.session.undo_stack.undoText() == "Add point 3", family
        pen.click(at(pen, *PLACES[0]), keys=ALT)
        assert pen.curve.is_closed, family
        assert lines(pen) == [True] * 4, family
        assert all(point.corner for point in pen.curve.points), family
        # At an even pace: half the time is half the way.
        view = pen.session.active_view
        middles = view.curve.evaluate((view.parameters[1:] + view.parameters[:-1]) / 2)
        for start, end, middle in zip(PLACES, (*PLACES[1:], PLACES[0]), middles, strict=True):
            there = at(pen, (start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
            assert middle == pytest.approx(there, abs=2 * pen.pixel), family


def test_a_curve_continues_from_a_line_with_a_corner(pen):
    pen.click(at(pen, 20, 20), keys=ALT)
    pen.click(at(pen, 160, 20), keys=ALT)
    pen.click(at(pen, 240, 120))
    assert lines(pen) == [True, False]
    point = pen.curve.points[1]
    assert point.corner
    assert point.velocity_after is None
    vx, vy = pen.session.active_view.derivative_of(1, 1, ahead=True)
    assert math.degrees(math.atan2(vy, vx)) > 30, "to where the next point is"


def test_a_handle_drawn_along_the_line_makes_the_point_smooth(pen):
    pen.click(at(pen, 20, 20), keys=ALT)
    pen.drag(at(pen, 160, 20), at(pen, 200, 22), keys=ALT)
    pen.click(at(pen, 240, 120))
    assert lines(pen) == [True, False]
    point = pen.curve.points[1]
    assert point.tied
    assert math.atan2(*reversed(point.velocity_after)) == pytest.approx(0, abs=1e-3)


def test_alt_drag_is_a_corner_after_a_line(pen):
    pen.click(at(pen, 20, 20), keys=ALT)
    pen.press(at(pen, 160, 20), keys=ALT)
    pen.move(at(pen, 160, 80), keys=ALT)
    pen.release(at(pen, 160, 80), keys=ALT)
    pen.click(at(pen, 60, 160))
    assert lines(pen) == [True, False]
    point = pen.curve.points[1]
    assert point.corner
    assert math.atan2(*reversed(point.velocity)) == pytest.approx(0, abs=0.02)
    assert math.atan2(*reversed(point.velocity_after)) == pytest.approx(math.pi / 2, abs=0.02)


def test_escape_leaves_no_trace(pen):
    pen.click(at(pen, 20, 20))
    before = pen.session.document
    pen.press(at(pen, 160, 20), keys=ALT)
    pen.move(at(pen, 160, 80), keys=ALT)
    pen.key(Qt.Key.Key_Escape)
    assert pen.session.document == before


def test_the_preview_shows_the_line(pen):
    pen.click(at(pen, 20, 20))
    pen.click(at(pen, 60, 120))
    marks = pen.window.canvas.tools.marks
    pen.move(at(pen, 200, 120), held=False, keys=ALT)
    assert is_straight(marks().preview_curve.source, 1)
    pen.move(at(pen, 200, 120), held=False)
    assert not is_straight(marks().preview_curve.source, 1)


def test_without_velocities_a_press_of_the_pen_adds_a_plain_point(pen):
    pen.choose_family(LAGRANGE)
    for place in PLACES[:3]:
        pen.click(at(pen, *place), keys=ALT)
    assert len(pen.curve.points) == 3
    assert pen.session.active_view.is_current


def test_the_hint_over_the_first_point_mentions_closing(pen):
    for place in PLACES:
        pen.click(at(pen, *place))
    pen.hover(pen.point(0))
    words = "Click to close the curve · Alt: straight line · Drag to pull out its handle"
    assert pen.window.status_line.hint == words


def test_the_first_point_promises_to_close_only_curves_that_can_be_closed(pen):
    """Of a Lagrange curve, too, and the click was refused."""
    *before, last = (at(pen, *place) for place in PLACES)
    document = point_edits.set_points(pen.session.document, 0, [Point(*place) for place in before])
    for family in FAMILIES:
        pen.session.commit(rule_edits.set_family(document, 0, family), "Begin")
        pen.session.selected.set_points([2])
        pen.click(last)
        assert not pen.window.status_line.hint.startswith("Click to close the curve"), family
        pen.hover(pen.point(0))
        hint, can_close = pen.window.status_line.hint, family.curve_class.can_close
        assert hint.startswith("Click to close the curve") is can_close, family
        assert ("cannot be closed" in hint) is not can_close, family
        pen.click(pen.point(0))
        assert pen.curve.is_closed is can_close, family
