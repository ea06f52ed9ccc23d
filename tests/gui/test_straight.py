"""Straight segments, from the menu, by the key and where the right button was pressed."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.curve.handles import handles_of
from app.view_model.point_kinds import SMOOTH, kind_at

ALT = Qt.KeyboardModifier.AltModifier
CTRL = Qt.KeyboardModifier.ControlModifier
BOW = ((0, 0), (1, 2), (3, 2.5), (4, 1), (6, 0))
WITH_VELOCITIES = [family for family in FAMILIES if family.derivatives]


@pytest.fixture
def drawn(editor):
    """Return what begins with a curve of five points of a family, none of them selected."""

    def begin(family):
        editor.session.commit(Document((make_curve(BOW, name="Bow", family=family),)), "Begin", active=0)
        editor.fit()
        editor.select([])
        return editor

    return begin


def distance_from_chord(view, segment):
    """How far a segment leaves the line between its ends, and how unevenly it is run through."""
    t = np.linspace(*view.parameters[segment : segment + 2], 101)
    curve = view.curve.evaluate(t)
    return np.abs(curve - np.linspace(curve[0], curve[-1], 101)).max()


def other_segments(view, segments):
    """The curve on all other segments."""
    t = [
        np.linspace(*view.parameters[segment : segment + 2], 50)
        for segment in range(len(view.parameters) - 1)
        if segment not in segments
    ]
    return view.curve.evaluate(np.concatenate(t))


def test_two_neighbours_and_the_key(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        before, steps = bow.session.active_view, bow.session.undo_stack.count()
        assert distance_from_chord(before, 1) > 0.1, family
        bow.select([1, 2])
        bow.key(Qt.Key.Key_4, ALT)
        after = bow.session.active_view
        assert distance_from_chord(after, 1) < 1e-14, family
        assert other_segments(after, [1]) == pytest.approx(other_segments(before, [1]), abs=1e-13), family
        assert [point.corner for point in bow.curve.points] == [False, True, True, False, False], family
        for index, ahead in ((1, False), (2, True)):
            kept, old = (
                [each.position for each in handles_of(view, index) if each.ahead is ahead]
                for view in (after, before)
            )
            assert np.array(kept) == pytest.approx(np.array(old), abs=1e-13), family
        assert bow.session.undo_stack.count() == steps + 1, family
        assert bow.session.undo_stack.undoText() == "Straight segment 1–2", family
        assert bow.status == "Straight segment 1–2, corner at points 1 and 2."
        assert bow.message == ""
        bow.trigger("straightSegment")
        assert bow.status == "The segment is already straight.", family
        assert bow.session.undo_stack.count() == steps + 1, family
        bow.trigger("undo")
        assert bow.session.document.curves[0] == before.source, family


def test_a_smooth_point_keeps_a_tangent_that_is_in_line(drawn):
    """It became a corner, and the next drag of its handle made a kink."""
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        for degrees, tied in ((0.0, True), (2.0, True), (15.0, False)):
            document = bow.session.committed
            bow.select([1])
            # In line with the segment from (1, 2) to (3, 2.5), as a person drags it.
            along = np.array([2.0, 0.5]) / np.hypot(2.0, 0.5)
            turn = np.deg2rad(degrees)
            x, y = along * np.cos(turn) + np.array([-along[1], along[0]]) * np.sin(turn)
            bow.drag_handle((1 + 0.9 * x, 2 + 0.9 * y))
            before = bow.session.active_view
            bow.select([1, 2])
            bow.trigger("straightSegment")
            after = bow.session.active_view
            point = bow.curve.points[1]
            assert distance_from_chord(after, 1) < 1e-14
            assert point.tied == tied, (family, degrees)
            assert bow.status.startswith(
                "Straight segment 1–2, corner at point 2, tangent at point 1."
                if tied
                else "Straight segment 1–2, corner at points 1 and 2."
            )
            # The other side is as long as it was, and in line with the segment.
            was, now = (view.velocity_of(1, ahead=False) for view in (before, after))
            assert np.hypot(*now) == pytest.approx(np.hypot(*was))
            if tied:
                assert np.array(now) / np.hypot(*now) == pytest.approx(along)
            else:
                assert now == pytest.approx(was)
            bow.session.commit(document, "Again", active=0)


def test_a_symmetric_point_keeps_its_other_handle(editor):
    """The straight segment's handle was longer, and the other one grew from 60 to 100 pixels with it."""
    editor.new()
    editor.choose_family(HERMITE)
    editor.trigger("addTool")
    editor.click((0.0, 0.0))
    editor.drag((1.0, 1.0), (1.4, 1.0))
    editor.drag((3.0, 1.0), (3.4, 1.0))
    editor.click((4.0, 0.0))
    editor.key(Qt.Key.Key_Return)
    editor.trigger("selectTool")
    before = editor.session.active_view
    assert editor.curve.points[1].even
    editor.select([1, 2])
    editor.key(Qt.Key.Key_4, ALT)
    after = editor.session.active_view
    assert distance_from_chord(after, 1) < 1e-14
    assert other_segments(after, [1]) == pytest.approx(other_segments(before, [1]), abs=1e-12)
    assert kind_at(after, 1) is SMOOTH


def test_an_end_gets_no_corner(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        bow.select([3, 4])
        bow.trigger("straightSegment")
        assert distance_from_chord(bow.session.active_view, 3) < 1e-14, family
        assert [point.corner for point in bow.curve.points] == [False, False, False, True, False], family
        assert bow.status.startswith("Straight segment 3–4, corner at point 3."), family


def test_everything_selected_is_a_polygon(drawn):
    kinds = ParametrizationKind.UNIFORM, ParametrizationKind.MANUAL
    for family, kind in product(WITH_VELOCITIES, kinds):
        bow = drawn(family)
        bow.choose_parametrization(kind)
        bow.key(Qt.Key.Key_A, CTRL)
        bow.trigger("straightSegment")
        view = bow.session.active_view
        assert max(distance_from_chord(view, segment) for segment in range(4)) < 1e-14, (family, kind)
        assert bow.session.undo_stack.undoText() == "4 straight segments", (family, kind)


def test_the_closing_segment_can_be_made_straight(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        bow.trigger("closeCurve")
        before = bow.session.active_view
        bow.select([0, 4])
        bow.trigger("straightSegment")
        after = bow.session.active_view
        assert bow.session.undo_stack.undoText() == "Straight segment 4–0", family
        assert distance_from_chord(after, 4) < 1e-14, family
        assert other_segments(after, [4]) == pytest.approx(other_segments(before, [4]), abs=1e-13), family


def test_the_context_menu_straightens_the_segment_under_the_pointer(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        place = tuple(bow.session.active_view.curve.evaluate(sum(bow.parameters[2:4]) / 2))
        bow.open_menu(place)
        bow.choose("straightHere")
        assert bow.session.undo_stack.undoText() == "Straight segment 2–3", family
        assert distance_from_chord(bow.session.active_view, 2) < 1e-14, family


def test_points_that_are_no_neighbours_are_refused(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        bow.select([0, 2])
        document = bow.session.document
        bow.trigger("straightSegment")
        assert bow.session.document is document, family
        assert bow.status.startswith("Select two neighbouring points"), family


def test_the_palette_finds_the_straight_segment_action(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        bow.select([0, 1])
        bow.run_command("straight segment")
        assert bow.session.undo_stack.undoText() == "Straight segment 0–1", family


def test_a_locked_curve_stays(drawn):
    for family in WITH_VELOCITIES:
        bow = drawn(family)
        bow.trigger("curveLocked")
        document = bow.session.document
        bow.select([1, 2])
        bow.trigger("straightSegment")
        assert bow.session.document is document, family
        assert "is locked" in bow.status, family
        # Nothing takes its place as long as it is locked.
        bow.trigger("curveLocked")


def test_a_polynomial_has_no_straight_segments_and_the_action_explains_why(editor):
    action = editor.action("straightSegment")
    editor.choose_family(LAGRANGE)
    assert not action.isEnabled()
    assert action.toolTip().splitlines()[-1].startswith("A Lagrange curve is one polynomial")
    place = tuple(editor.session.active_view.curve.evaluate(0.55))
    menu = editor.open_menu(place)
    here = next(each for each in menu.actions() if each.objectName() == "straightHere")
    assert not here.isEnabled()
    assert here.toolTip() == action.toolTip()
    assert menu.toolTipsVisible()
    QTest.keyClick(menu, Qt.Key.Key_Escape)
    editor.settle()
    editor.choose_family(HERMITE)
    assert action.isEnabled()
    assert action.toolTip().endswith("(Alt+4)")
    assert not action.icon().isNull()
