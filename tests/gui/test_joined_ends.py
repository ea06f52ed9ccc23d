"""Ends of curves joined: two that are selected, both of one curve, those of chosen curves; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.constraints import is_straight
from app.document.derivatives import VelocityRule
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from tests.gui.editor_facts import assert_actions_as_rendered_anew

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
Key = Qt.Key

LEFT = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0)]
RIGHT = [(8.0, 0.0), (7.0, 2.0), (4.0, 2.0)]
FAR = [(4.0, -3.0), (1.0, -3.0), (0.0, -2.0)]


def show(editor, *curves):
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.session.selected.activate(0)
    editor.window.canvas.camera.show_box((-2, 10), (-5, 5))
    editor.settle()
    return editor


def hermite(points, name, shape=""):
    return (
        make_curve(points, name=name, family=HERMITE)
        if not shape
        else replace(make_curve(points, name=name, family=HERMITE), shape=shape)
    )


@pytest.fixture
def arcs(editor):
    """Two contours of one shape whose last points are neighbours, and another curve."""
    return show(editor, hermite(LEFT, "Left", "Arch"), hermite(RIGHT, "Right", "Arch"), hermite(FAR, "Far"))


def names(editor):
    return [curve.name for curve in editor.session.document.curves]


def positions(editor):
    return [point.position for point in editor.curve.points]


def farthest(editor, curve):
    """How far a curve of before is from the one that is edited, at most."""
    t = np.linspace(0, 1, 60)
    before = view_of(curve)
    start, end = before.curve.domain
    whole = editor.session.active_view.curve
    fine = whole.evaluate(np.linspace(*whole.domain, 40_001))
    away = fine - before.curve.evaluate(start + t * (end - start))[:, None]
    return np.hypot(away[..., 0], away[..., 1]).min(axis=1).max()


@pytest.mark.parametrize("meets", [False, True])
def test_the_joining_segment_between_straight_lines_is_straight(editor, meets):
    """It bulged."""
    far = (3.0, 1.0) if meets else (4.0, 3.0)
    show(editor, hermite([(0, 0), (3, 1)], "Left", "Arch"), hermite([(6, 0), far], "Right", "Arch"))
    for place in (0, 1):
        editor.session.selected.activate(place)
        editor.select([0, 1])
        editor.trigger("straightSegment")
    editor.session.selected.activate(0)
    editor.drag((2.5, 3.6), (4.5, 0.5))
    editor.key(Key.Key_J, CTRL)
    assert positions(editor) == [(0.0, 0.0), (3.0, 1.0), *([] if meets else [far]), (6.0, 0.0)]
    assert [is_straight(editor.curve, segment) for segment in range(len(positions(editor)) - 1)] == (
        [True] * (len(positions(editor)) - 1)
    )


def test_ctrl_j_joins_two_ends_selected_by_a_band(arcs):
    begun = arcs.session.document
    arcs.drag((2.5, 2.6), (4.5, 1.5))
    assert dict(arcs.session.selected.group.parts) == {0: {2}, 1: {2}}
    arcs.key(Key.Key_J, CTRL)
    assert names(arcs) == ["Left", "Far"]
    # The other one runs the other way now.
    assert positions(arcs) == [*LEFT, *reversed(RIGHT)]
    assert max(farthest(arcs, curve) for curve in begun.curves[:2]) < 1e-3
    assert arcs.status.startswith("Joined with “Right”, end to end: shapes kept, largest change ")
    assert dict(arcs.session.selected.group.parts) == {0: {2, 3}}
    assert arcs.session.undo_stack.undoText() == "Join Left and Right"
    arcs.trigger("undo")
    assert arcs.session.document == begun
    assert arcs.session.selected.curves == {0, 1}


def test_meeting_ends_become_one_point(editor):
    """Two starts: the edited curve keeps its direction, the other one comes before it."""
    show(editor, hermite(LEFT, "A"), hermite([LEFT[0], *FAR], "B"))
    editor.session.selected.set_curves({0, 1}, active=0)
    editor.drag((-0.5, 0.5), (0.5, -0.5))
    assert editor.session.selected.group.count_label == "2 points in 2 curves"
    editor.key(Key.Key_J, CTRL)
    assert names(editor) == ["A"]
    assert positions(editor) == [*reversed(FAR), *LEFT]
    assert editor.session.selection == {3}
    assert editor.curve.points[3].corner


def test_joining_both_ends_closes_a_curve_and_moves_nothing_else(editor):
    show(editor, hermite(LEFT, "A"))
    before = editor.curve
    editor.click(LEFT[0])
    editor.click(LEFT[2], keys=SHIFT)
    assert editor.action("joinCurve").isEnabled()
    editor.key(Key.Key_J, CTRL)
    assert editor.curve.is_closed
    assert positions(editor) == LEFT
    assert farthest(editor, before) < 1e-3
    assert editor.session.selection == {0, 2}
    assert editor.session.undo_stack.undoText() == "Close A"
    assert editor.status.startswith("Joined both ends: shapes kept")


def test_joining_the_meeting_ends_of_a_loop_closes_the_curve_in_one_point(editor):
    show(editor, hermite([*LEFT, (3.0, -1.0), LEFT[0]], "A"))
    before = editor.curve
    editor.drag((-0.5, 0.5), (0.5, -0.5))
    editor.key(Key.Key_J, CTRL)
    assert editor.curve.is_closed
    assert len(editor.curve.points) == 4
    assert farthest(editor, before) < 1e-3
    assert editor.session.selection == {0}


@pytest.mark.parametrize("end", [(3.0, -1.0), LEFT[0]])
def test_a_curve_without_velocities_closes_by_its_rules(editor, end):
    """Where its ends met the segment between them had no length, and there was no curve."""
    points = [*LEFT, (4.0, -1.0), end]
    show(editor, make_curve(points, name="A", family=FAMILIES.named("cubic_spline")))
    editor.session.selected.set_points([0, 4])
    editor.key(Key.Key_J, CTRL)
    assert editor.curve.is_closed
    assert editor.session.active_view.is_current
    assert positions(editor) == list(dict.fromkeys(points))
    assert editor.session.undo_stack.undoText() == "Close A"


def test_an_inner_point_beside_an_end_joins_nothing(arcs):
    begun = arcs.session.document
    arcs.click(LEFT[2])
    arcs.click(RIGHT[1], keys=SHIFT)
    arcs.key(Key.Key_J, CTRL)
    assert arcs.status.startswith("Select only one end of each of two open curves")
    assert arcs.session.document == begun


def test_polynomials_cannot_be_joined_at_their_ends(editor):
    show(editor, make_curve(LEFT, name="A"), make_curve(RIGHT, name="B"))
    editor.session.selected.set_curves({0, 1}, active=0)
    editor.drag((2.5, 2.6), (4.5, 1.5))
    editor.key(Key.Key_J, CTRL)
    assert editor.status.startswith("Two polynomials cannot be joined")
    assert names(editor) == ["A", "B"]


def test_selected_curves_are_joined_nearest_ends_first_and_a_ring_closes(editor):
    sides = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)]
    a, b, c, d = ((sides[at], sides[at + 1]) for at in range(4))
    pieces = [list(a), list(reversed(c)), list(reversed(b)), list(d)]
    show(editor, *(hermite(points, name) for points, name in zip(pieces, "acbd", strict=True)))
    editor.key(Key.Key_Escape)
    editor.key(Key.Key_A, CTRL)
    assert len(editor.session.selected.whole_curves) == 4
    editor.key(Key.Key_J, CTRL)
    assert len(editor.session.document.curves) == 1
    assert editor.curve.is_closed
    assert sorted(positions(editor)) == sorted(sides[:4])
    assert editor.session.undo_stack.undoText() == "Join 4 curves"
    assert editor.status.startswith("Joined 4 curves: shapes kept")
    editor.trigger("undo")
    assert names(editor) == list("acbd")


def test_two_selected_curves_are_joined_at_their_nearest_ends(arcs):
    arcs.session.selected.select_whole({1, 0})
    arcs.key(Key.Key_J, CTRL)
    assert len(arcs.session.document.curves) == 2
    assert len(arcs.curve.points) == 6
    assert not arcs.curve.is_closed
    assert arcs.session.selected.whole_curves == {arcs.session.active_index}


# Ends of other curves


@pytest.fixture
def apart(editor):
    """Two curves that belong to no shape, and another one; the first is edited."""
    return show(editor, hermite(LEFT, "Left"), hermite(RIGHT, "Right"), hermite(FAR, "Far"))


def selected(editor):
    return dict(editor.session.selected.group.parts)


@pytest.mark.parametrize(
    ("ends", "points", "words"),
    [
        ((LEFT[2], RIGHT[2]), [*LEFT, *reversed(RIGHT)], "end to end"),
        ((LEFT[2], RIGHT[0]), [*LEFT, *RIGHT], "end to start"),
        ((LEFT[0], RIGHT[0]), [*reversed(RIGHT), *LEFT], "start to start"),
        ((LEFT[0], RIGHT[2]), [*RIGHT, *LEFT], "start to end"),
    ],
)
def test_shift_click_on_an_end_of_another_curve_adds_it_and_join_uses_both(apart, ends, points, words):
    begun, (one, other) = apart.session.document, ends
    apart.click(one)
    assert not apart.action("mergeEnds").isEnabled()
    apart.hover(other)
    assert "Shift+click: add its end to the selection" in apart.window.status_line.hint
    apart.move(other, held=False, keys=SHIFT)
    assert apart.window.status_line.hint.endswith("click to add its end to the selection")
    assert apart.window.canvas.marks.spot == other
    apart.click(other, keys=SHIFT)
    assert apart.status == "2 points in 2 curves selected."
    assert apart.session.document is begun
    assert (apart.session.active_index, apart.session.selected.curves) == (0, {0, 1})
    assert selected(apart) == {0: {LEFT.index(one)}, 1: {RIGHT.index(other)}}
    assert apart.action("joinCurve").isEnabled()
    assert apart.action("mergeEnds").isEnabled()
    apart.key(Key.Key_J, CTRL)
    assert names(apart) == ["Left", "Far"]
    assert positions(apart) == points
    assert apart.status.startswith(f"Joined with “Right”, {words}: shapes kept, largest change ")
    assert max(farthest(apart, curve) for curve in begun.curves[:2]) < 1e-3
    apart.trigger("undo")
    assert apart.session.document == begun


def test_a_second_shift_click_removes_the_end_again(apart):
    apart.click(LEFT[2])
    apart.click(RIGHT[2], keys=SHIFT)
    apart.click(RIGHT[2], keys=SHIFT)
    assert selected(apart) == {0: {2}}
    assert apart.curve.name == "Left"
    apart.click(RIGHT[2], keys=SHIFT)
    apart.click(LEFT[2], keys=SHIFT)
    assert selected(apart) == {1: {2}}


def test_an_end_is_added_where_its_line_is_out_of_reach(apart):
    """Ten pixels beyond the end the line is not hit, the point is."""
    beyond = (FAR[0][0] + 10 * apart.pixel, FAR[0][1])
    apart.click(LEFT[2])
    apart.click(beyond, keys=SHIFT)
    assert selected(apart) == {0: {2}, 2: {0}}
    assert apart.status == "2 points in 2 curves selected."


def test_shift_click_on_an_end_without_a_selected_point_selects_that_end(apart):
    apart.click(RIGHT[0], keys=SHIFT)
    assert selected(apart) == {1: {0}}
    apart.click(LEFT[0], keys=SHIFT)
    assert selected(apart) == {0: {0}, 1: {0}}


def test_shift_click_on_the_middle_of_another_curve_adds_the_curve(apart):
    apart.click(LEFT[2])
    apart.click(RIGHT[1], keys=SHIFT)
    assert selected(apart) == {}
    assert apart.session.selected.whole_curves == {0, 1}
    # While whole curves are being selected, an end stands for its curve.
    apart.click(FAR[0], keys=SHIFT)
    assert apart.session.selected.whole_curves == {0, 1, 2}


def test_shift_click_selects_whole_curves_while_none_is_edited(apart):
    apart.escape()
    apart.click(LEFT[2])
    apart.click(RIGHT[2], keys=SHIFT)
    assert apart.session.selected.whole_curves == {0, 1}
    assert selected(apart) == {}


def test_a_drag_with_shift_from_an_end_moves_the_curve_along_an_axis(apart):
    apart.click(LEFT[2])
    apart.drag(RIGHT[0], (RIGHT[0][0] + 1.0, 0.2), keys=SHIFT)
    moved = apart.session.document.curves[1].points
    assert [point.y for point in moved] == [y for _, y in RIGHT]
    assert moved[0].x == pytest.approx(RIGHT[0][0] + 1.0, abs=2 * apart.pixel)
    assert selected(apart) == {0: {2}}


def test_escape_during_the_press_on_an_end_leaves_the_selection(apart):
    apart.click(LEFT[2])
    apart.press(RIGHT[2], keys=SHIFT)
    apart.escape()
    apart.release(RIGHT[2], keys=SHIFT)
    assert selected(apart) == {0: {2}}
    assert apart.session.selected.curves == {0}


@pytest.mark.parametrize("fields", [{"locked": True}, {"visible": False}, {"closed": True}])
def test_no_end_is_added_of_locked_hidden_and_closed_curves(editor, fields):
    show(editor, hermite(LEFT, "Left"), replace(hermite(RIGHT, "Right"), **fields))
    editor.click(LEFT[2])
    editor.click(RIGHT[2], keys=SHIFT)
    assert 1 not in selected(editor)


@pytest.mark.parametrize("end", [0, 2])
def test_with_one_selected_end_join_uses_it_and_the_nearest_end(apart, end):
    """It joined the last point to a start, whichever was selected."""
    begun = apart.session.document
    apart.click(LEFT[end])
    apart.key(Key.Key_J, CTRL)
    partner, points, words = {
        0: ("Far", [*FAR, *LEFT], "start to end"),
        2: ("Right", [*LEFT, *reversed(RIGHT)], "end to end"),
    }[end]
    assert positions(apart) == points
    assert apart.status.startswith(f"Joined with “{partner}”, {words}: shapes kept")
    assert apart.session.undo_stack.undoText() == f"Join Left and {partner}"
    apart.trigger("undo")
    assert apart.session.document == begun


@pytest.mark.parametrize("end", [0, 2])
def test_one_selected_end_decides_where_two_selected_curves_are_joined(apart, end):
    """Their nearest ends are the last points of both."""
    apart.session.selected.set_curves({0, 1}, active=0)
    apart.click(LEFT[end], keys=SHIFT)
    assert selected(apart) == {0: {end}}
    apart.key(Key.Key_J, CTRL)
    assert positions(apart) == ([*LEFT, *reversed(RIGHT)] if end else [*RIGHT, *LEFT])
    assert names(apart) == ["Left", "Far"]


def test_one_selected_end_comes_first_among_three_curves(apart):
    apart.session.selected.set_curves({0, 1, 2}, active=0)
    apart.click(LEFT[0], keys=SHIFT)
    apart.key(Key.Key_J, CTRL)
    assert names(apart) == ["Left"]
    # The start of Left goes to the end of Far, the nearest to it; then the nearest ends that are left.
    joined = positions(apart)
    assert abs(joined.index(LEFT[0]) - joined.index(FAR[2])) == 1
    assert apart.status.startswith("Joined 3 curves: shapes kept")


def test_merge_brings_ends_of_two_curves_together(apart):
    apart.click(LEFT[2])
    apart.click(RIGHT[2], keys=SHIFT)
    apart.key(Key.Key_J, SHIFT)
    assert positions(apart) == [*LEFT[:2], (3.5, 2.0), *reversed(RIGHT[:2])]


def test_an_unselected_inner_point_leaves_join_to_the_nearest_start(apart):
    apart.click(LEFT[1])
    apart.key(Key.Key_J, CTRL)
    assert apart.status.startswith("Joined with “Far”, end to start")


def test_the_actions_follow_ends_of_several_curves(apart):
    assert_actions_as_rendered_anew(apart)
    apart.click(LEFT[2])
    assert_actions_as_rendered_anew(apart)
    apart.click(RIGHT[2], keys=SHIFT)
    assert_actions_as_rendered_anew(apart)
    apart.key(Key.Key_J, CTRL)
    assert_actions_as_rendered_anew(apart)


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE], ids=lambda family: family.name)
@pytest.mark.parametrize("meets", [False, True])
def test_estimated_points_stay_estimated_and_follow_their_neighbours(editor, family, meets):
    """A join set them all: from then on no neighbour followed a drag."""
    begin = LEFT[2] if meets else RIGHT[2]
    other = replace(hermite([begin, (6.0, 0.0), (8.0, 1.0), (8.0, 4.0)], "Right"), family=family)
    show(editor, replace(hermite(LEFT, "Left"), family=family), other)
    begun = editor.session.document
    editor.session.selected.set_curves({0, 1}, active=0)
    editor.key(Key.Key_J, CTRL)
    seams = editor.session.selected.group.of(0) or ({2} if meets else {2, 3})
    assert {index for index, point in enumerate(editor.curve.points) if point.velocity} == seams
    assert max(farthest(editor, curve) for curve in begun.curves) < 1e-3
    before, last = editor.session.active_view.velocity_of(len(editor.curve.points) - 1), editor.point(-1)
    editor.session.selected.activate(0)
    editor.drag(editor.point(len(editor.curve.points) - 2), (8.5, 0.0))
    assert editor.session.active_view.velocity_of(len(editor.curve.points) - 1) != before
    assert editor.point(-1) == last


def test_what_other_rules_have_estimated_is_set(editor):
    """The joined curve has the rules of one; the shape of the other is kept by what is set."""
    other = replace(
        hermite([LEFT[2], (5.0, 0.0), (6.0, 2.0), (8.0, 0.0)], "B"), velocity_rule=VelocityRule.BESSEL
    )
    show(editor, hermite(LEFT, "A"), other)
    begun = editor.session.document
    editor.session.selected.set_curves({0, 1}, active=0)
    editor.key(Key.Key_J, CTRL)
    assert max(farthest(editor, curve) for curve in begun.curves) < 1e-3
    assert [point.velocity is not None for point in editor.curve.points] == [
        False,
        False,
        True,
        True,
        True,
        True,
    ]
