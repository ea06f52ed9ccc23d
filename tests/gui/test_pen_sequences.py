"""Smooth points, automatic ones and corners with the pen in all orders: handles as in Inkscape, FontForge.

The expected handles are those of a pen that knows nothing of velocities: a point that was dragged has its
handle and the mirrored one, a corner has none, and what lies between two points without handles is a line.
"""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document import rule_edits
from app.document.constraints import is_straight
from app.document.model import ParametrizationKind
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.view_model.curve.handles import handles_of
from tests.gui.editor_facts import at, undo_text

ALT = Qt.KeyboardModifier.AltModifier

PLACES = ((20, -60), (120, -20), (160, 110), (60, 160), (10, 70))
"""At distances of 108, 136, 112, 103 and, back, 130 pixels: no two segments have the same length in t."""

PULLED = (40, 24)

IN_LINE = ((0, 0), (50, 30), (130, 78), (180, 108), (280, 168))
"""On one line, along which `PULLED` leads."""

SMOOTH, AUTOMATIC, CORNER = "drag", "click", "Alt+click"


def draw(pen, kinds, closing=None, places=PLACES):
    """Draw a point of each kind, and close the curve by a click, or by one with Alt."""
    for (x, y), kind in zip(places, kinds, strict=False):
        if kind == SMOOTH:
            pen.drag(at(pen, x, y), at(pen, x + PULLED[0], y + PULLED[1]))
        else:
            pen.click(at(pen, x, y), keys=ALT if kind == CORNER else Qt.KeyboardModifier.NoModifier)
    if closing is not None:
        pen.click(pen.point(0), keys=ALT if closing == CORNER else Qt.KeyboardModifier.NoModifier)
    return pen


def expected_handles(kinds, closing=None):
    """Return for each segment the handles at both ends, by how many times `PULLED`; or that it is a line.

    None for a handle at an automatic point, which a rule has estimated.
    """
    pairs = [*pairwise(kinds)]
    if closing is not None:
        # A click takes the first point as it is, one with Alt makes it a corner behind.
        pairs.append((kinds[-1], CORNER if closing == CORNER else kinds[0]))
    result = []
    for number, (start, end) in enumerate(pairs):
        is_clicked_line = end == CORNER and (number < len(kinds) - 1 or closing == CORNER)
        if start != SMOOTH and is_clicked_line:
            result.append("line")
            continue
        ends = {SMOOTH: 1, AUTOMATIC: None}
        ahead, behind = ends.get(start), ends.get(end)
        if start == CORNER and end == SMOOTH:
            ahead = 0
        is_first_of_line = number == len(kinds) - 1 and kinds[:2] == (AUTOMATIC, CORNER)
        if start == SMOOTH and (end == CORNER or is_first_of_line):
            # A point at which a line begins is a corner, however it was clicked.
            behind = 0
        result.append((ahead, behind if behind is None else -behind))
    return result


def assert_handles(pen, kinds, closing=None):
    view, count = pen.session.active_view, len(kinds)
    curve, unit = view.source, pen.pixel
    assert curve.is_closed is (closing is not None)
    assert len(curve.points) == count
    for segment, expected in enumerate(expected_handles(kinds, closing)):
        ends = (segment, (segment + 1) % count)
        if expected == "line":
            assert is_straight(curve, segment), (kinds, closing, segment)
            continue
        assert not is_straight(curve, segment), (kinds, closing, segment)
        for index, ahead, times in zip(ends, (True, False), expected, strict=True):
            (handle,) = (each for each in handles_of(view, index) if each.ahead is ahead and each.order == 1)
            where = (kinds, closing, segment, "start" if ahead else "end")
            if times is None:
                assert math.dist(handle.position, handle.anchor) > pen.pixel, where
            else:
                assert handle.explicit, where
                x, y = curve.points[index].position
                tip = (x + times * PULLED[0] * unit, y + times * PULLED[1] * unit)
                assert handle.position == pytest.approx(tip, abs=1e-9 + 1e-9 * unit), where


ALL_KINDS = (SMOOTH, AUTOMATIC, CORNER)

BOTH_FAMILIES = pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE], ids=lambda family: family.name)


@BOTH_FAMILIES
@pytest.mark.parametrize("closing", [None, AUTOMATIC, CORNER])
def test_three_points_of_all_kinds_in_all_orders(pen, closing, family):
    begun = rule_edits.set_family(pen.session.document, 0, family)
    for kinds in product(ALL_KINDS, repeat=3):
        pen.session.commit(begun, "Begin")
        assert_handles(draw(pen, kinds, closing), kinds, closing)


@BOTH_FAMILIES
@pytest.mark.parametrize("closing", [None, AUTOMATIC, CORNER])
def test_handles_pulled_in_line_with_their_segments_stay_as_well(pen, closing, family):
    """A segment of equal velocities along its chord looks straight; what is stored decides."""
    begun = rule_edits.set_family(pen.session.document, 0, family)
    for kinds in product((SMOOTH, CORNER), repeat=3):
        pen.session.commit(begun, "Begin")
        assert_handles(draw(pen, kinds, closing, IN_LINE), kinds, closing)


@BOTH_FAMILIES
@pytest.mark.parametrize("keys", [Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.AltModifier])
def test_a_click_on_the_tip_of_the_handle_just_pulled_adds_a_point(pen, family, keys):
    """Within some 8 pixels of the tip nothing was added; a drag there moves the handle as before."""
    pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
    pen.drag(at(pen, 0, 0), at(pen, 60, 0))
    pen.hover(at(pen, 64, 2))
    assert pen.status.startswith("Click to add point 1 · Drag to move the handle")
    pen.drag(at(pen, 64, 2), at(pen, 64, 40))
    assert len(pen.curve.points) == 1
    pen.trigger("undo")
    pen.click(at(pen, 64, 2), keys=keys)
    assert len(pen.curve.points) == 2
    assert pen.point(1) == pytest.approx(at(pen, 64, 2), abs=pen.pixel)
    assert pen.curve.points[1].corner is (keys is Qt.KeyboardModifier.AltModifier)
    pen.click(at(pen, 200, 90))
    assert len(pen.curve.points) == 3, "the pen goes on"
    pen.trigger("undo")
    pen.trigger("undo")
    assert len(pen.curve.points) == 1


@BOTH_FAMILIES
def test_a_pill_keeps_its_eight_handles_and_its_points_move_alone(pen, family):
    pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
    corners = ((0, 150, 60), (200, 150, 60), (200, 20, -60), (0, 20, -60))
    for x, y, far in corners:
        pen.drag(at(pen, x, y), at(pen, x + far, y))
    pen.click(pen.point(0))

    def tips():
        return [
            {
                each.ahead: each.position
                for each in handles_of(pen.session.active_view, index)
                if each.order == 1
            }
            for index in range(4)
        ]

    for by_side, (x, y, far) in zip(tips(), corners, strict=True):
        assert by_side[True] == pytest.approx(at(pen, x + far, y), abs=1e-9)
        assert by_side[False] == pytest.approx(at(pen, x - far, y), abs=1e-9)
    pen.trigger("selectTool")
    # A handle leaves the line of its segment, with the mirrored one.
    pen.click(pen.point(1))
    pen.drag(at(pen, 260, 150), at(pen, 250, 190))
    assert tips()[1][True] == pytest.approx(at(pen, 250, 190), abs=1.5 * pen.pixel)
    assert tips()[1][False] == pytest.approx(at(pen, 150, 110), abs=1.5 * pen.pixel)
    before = tips()
    pen.drag(at(pen, 200, 20), at(pen, 230, 0))
    for index in (0, 1, 3):
        for ahead in (False, True):
            assert tips()[index][ahead] == pytest.approx(before[index][ahead], abs=1e-9)


@BOTH_FAMILIES
def test_what_is_drawn_stays_where_it_is_between_points_that_were_pulled(pen, family):
    pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")

    def drawn(count):
        view = pen.session.active_view
        t = np.concatenate([np.linspace(*pair, 20) for pair in pairwise(view.parameters[:count])])
        return view.curve.evaluate(t)

    draw(pen, (SMOOTH, SMOOTH))
    for count, (x, y) in enumerate(PLACES[2:], start=2):
        before = drawn(count)
        pen.drag(at(pen, x, y), at(pen, x + PULLED[0], y + PULLED[1]))
        assert drawn(count) == pytest.approx(before, abs=1e-9), count
    before = drawn(5)
    pen.click(pen.point(0))
    assert drawn(5) == pytest.approx(before, abs=1e-9)


@BOTH_FAMILIES
@pytest.mark.parametrize("keys", [Qt.KeyboardModifier.NoModifier, ALT])
@pytest.mark.parametrize("kinds", [(SMOOTH, SMOOTH, AUTOMATIC), (CORNER, SMOOTH, CORNER), (AUTOMATIC,) * 3])
def test_a_drag_on_the_first_point_closes_and_pulls_its_handle(pen, kinds, keys, family):
    """A handle that is there ahead of it stays; none is drawn out where none was, but mirrored."""
    pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
    draw(pen, kinds)
    before, steps = pen.session.document, pen.session.undo_stack.count()
    (x, y), (dx, dy) = PLACES[0], (30, -45)
    pen.press(pen.point(0))
    pen.move(at(pen, x + dx, y + dy), keys=keys)
    assert pen.status.startswith("Close Curve 1, handle at −56")
    assert "Alt: only the handle behind" in pen.status
    pen.escape()
    pen.release(at(pen, x + dx, y + dy))
    assert pen.session.document == before
    pen.press(pen.point(0))
    pen.move(at(pen, x + dx, y + dy), keys=keys)
    pen.release(at(pen, x + dx, y + dy), keys=keys)
    assert pen.curve.is_closed
    assert pen.point(0) == before.curves[0].points[0].position
    assert (undo_text(pen), pen.session.undo_stack.count()) == ("Close Curve 1", steps + 1)
    by_side = {each.ahead: each for each in handles_of(pen.session.active_view, 0) if each.order == 1}
    assert by_side[False].position == pytest.approx(at(pen, x - dx, y - dy), abs=1e-9)
    first = pen.curve.points[0]
    if kinds[0] == SMOOTH:
        assert by_side[True].position == pytest.approx(at(pen, x + PULLED[0], y + PULLED[1]), abs=1e-9)
    elif kinds[0] == AUTOMATIC and keys != ALT:
        assert by_side[True].position == pytest.approx(at(pen, x + dx, y + dy), abs=1e-9)
        assert first.even
        return
    assert first.corner
    assert not first.tied


def test_a_click_on_the_first_point_with_an_unsteady_hand_closes(pen):
    draw(pen, (SMOOTH, SMOOTH, AUTOMATIC))
    first = pen.point(0)
    pen.drag(first, (first[0] + 3 * pen.pixel, first[1]))
    assert pen.curve.is_closed
    assert pen.point(0) == first


@BOTH_FAMILIES
@pytest.mark.parametrize("kind", [SMOOTH, AUTOMATIC, CORNER])
def test_backspace_restores_the_curve_as_it_was_before_the_last_point(pen, kind, family):
    pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
    for kinds in product(ALL_KINDS, repeat=2):
        before = []
        for number, each in enumerate((*kinds, kind)):
            before.append(pen.curve)
            (x, y), pulled = PLACES[number], PULLED if each == SMOOTH else (0, 0)
            keys = ALT if each == CORNER else Qt.KeyboardModifier.NoModifier
            pen.press(at(pen, x, y), keys=keys)
            pen.move(at(pen, x + pulled[0], y + pulled[1]), keys=keys)
            pen.release(at(pen, x + pulled[0], y + pulled[1]), keys=keys)
        for was in reversed(before):
            pen.key(Qt.Key.Key_Backspace)
            assert pen.curve == was, kinds


def test_backspace_after_a_point_was_moved_keeps_what_was_changed(pen):
    draw(pen, (SMOOTH, SMOOTH, AUTOMATIC))
    moved = at(pen, PLACES[1][0] + 20, PLACES[1][1])
    pen.drag(pen.point(1), moved)
    pen.click(pen.point(2))
    pen.key(Qt.Key.Key_Backspace)
    assert len(pen.curve.points) == 2
    assert pen.point(1) == pytest.approx(moved, abs=1.5 * pen.pixel)


@pytest.mark.parametrize("key", [Qt.Key.Key_Backspace, Qt.Key.Key_Delete])
def test_backspace_during_a_drag_of_the_pen_cancels_the_drag_alone(pen, key):
    draw(pen, (SMOOTH, SMOOTH))
    before = pen.curve
    x, y = PLACES[2]
    pen.press(at(pen, x, y))
    pen.move(at(pen, x + 30, y))
    assert len(pen.curve.points) == 3
    pen.key(key)
    assert pen.status == "Cancelled."
    pen.move(at(pen, x + 60, y))
    pen.release(at(pen, x + 60, y))
    assert pen.curve == before
    pen.click(at(pen, x, y))
    assert len(pen.curve.points) == 3


@pytest.mark.parametrize("closing", [AUTOMATIC, CORNER])
def test_smooth_smooth_corner_corner_smooth_and_closed_is_one_undo_step_each(pen, closing):
    kinds, before = (SMOOTH, SMOOTH, CORNER, CORNER, SMOOTH), pen.session.undo_stack.count()
    draw(pen, kinds)
    assert_handles(pen, kinds)
    drawn = pen.curve
    pen.move(pen.point(0), held=False, keys=ALT if closing == CORNER else Qt.KeyboardModifier.NoModifier)
    words = "Click to close the curve · Alt: corner by the handle · Drag to pull out its handle"
    assert pen.window.status_line.hint == words
    shown = pen.window.canvas.marks.preview_curve.source
    pen.click(pen.point(0), keys=ALT if closing == CORNER else Qt.KeyboardModifier.NoModifier)
    assert pen.curve == shown
    assert_handles(pen, kinds, closing)
    first = pen.curve.points[0]
    assert (first.corner and not first.tied) is (closing == CORNER)
    assert [point.corner and not point.tied for point in pen.curve.points[1:]] == [False, True, True, False]
    assert pen.session.undo_stack.count() == before + len(kinds) + 1
    pen.trigger("undo")
    assert pen.curve == drawn
    for _ in kinds:
        pen.trigger("undo")
    assert not pen.curve.points
    for _ in range(len(kinds) + 1):
        pen.trigger("redo")
    assert_handles(pen, kinds, closing)


@pytest.mark.parametrize(
    "kind", [kind for kind in ParametrizationKind if not kind.name.startswith("CHEBYSHEV")]
)
def test_every_rule_for_the_parameters_keeps_every_handle(pen, kind):
    """Chebyshev parameters have another spacing of all segments with each point, and so other handles."""
    begun = rule_edits.set_parametrization(pen.session.document, 0, kind, [])
    for kinds in ((SMOOTH, SMOOTH, CORNER, CORNER, SMOOTH), (CORNER, SMOOTH, CORNER, SMOOTH, SMOOTH)):
        for closing in (None, AUTOMATIC, CORNER):
            pen.session.commit(begun, "Begin")
            assert_handles(draw(pen, kinds, closing), kinds, closing)


def test_a_preview_with_alt_shows_the_segment_by_the_handle(pen):
    draw(pen, (SMOOTH, SMOOTH))
    pen.move(at(pen, *PLACES[2]), held=False)
    assert " · Alt: corner by the handle · " in pen.window.status_line.hint
    pen.move(at(pen, *PLACES[2]), held=False, keys=ALT)
    shown = pen.window.canvas.marks.preview_curve.source
    pen.click(at(pen, *PLACES[2]), keys=ALT)
    assert pen.curve == shown
    pen.move(at(pen, *PLACES[3]), held=False, keys=ALT)
    assert " · Alt: straight line · " in pen.window.status_line.hint
    assert is_straight(pen.window.canvas.marks.preview_curve.source, 2)


def test_a_handle_that_alt_has_broken_off_makes_the_next_segment(pen):
    """Alt during a drag turns the handle ahead alone; a click with Alt then follows it."""
    draw(pen, (SMOOTH,))
    start, ahead = at(pen, *PLACES[1]), at(pen, PLACES[1][0] - 30, PLACES[1][1] + 50)
    behind = at(pen, PLACES[1][0] + PULLED[0], PLACES[1][1] + PULLED[1])
    pen.press(start)
    pen.move(behind)
    pen.move(ahead, keys=ALT)
    pen.release(ahead, keys=ALT)
    pen.click(at(pen, *PLACES[2]), keys=ALT)
    by_side = {each.ahead: each.position for each in handles_of(pen.session.active_view, 1)}
    assert by_side[True] == pytest.approx(ahead, abs=1e-9)
    mirrored = tuple(2 * here - there for here, there in zip(start, behind, strict=True))
    assert by_side[False] == pytest.approx(mirrored, abs=1e-9)
    (end,) = handles_of(pen.session.active_view, 2)
    assert end.position == pytest.approx(end.anchor, abs=1e-12)


def test_a_handle_pulled_out_of_a_clicked_corner_makes_the_next_segment(pen):
    draw(pen, (SMOOTH, CORNER))
    x, y = PLACES[1]
    pen.drag(at(pen, x, y), at(pen, x + 30, y + 50), keys=ALT)
    pen.click(at(pen, *PLACES[2]), keys=ALT)
    by_side = {each.ahead: each.position for each in handles_of(pen.session.active_view, 1)}
    assert by_side[True] == pytest.approx(at(pen, x + 30, y + 50), abs=1e-9)
    assert by_side[False] == pytest.approx(pen.point(1), abs=1e-12)
    assert pen.curve.points[1].corner


def test_a_handle_dragged_later_moves_the_mirrored_one(pen):
    """The two velocities of a point that was dragged are tied: it is symmetric, as it was drawn."""
    draw(pen, (SMOOTH, SMOOTH, CORNER))
    point = pen.curve.points[1]
    assert point.tied
    assert point.even
    pen.trigger("selectTool")
    pen.click(pen.point(1))
    by_side = {each.ahead: each.position for each in handles_of(pen.session.active_view, 1)}
    to = at(pen, PLACES[1][0] + 10, PLACES[1][1] + 60)
    pen.drag(by_side[True], to)
    by_side = {each.ahead: each.position for each in handles_of(pen.session.active_view, 1)}
    assert by_side[True] == pytest.approx(to, abs=1.5 * pen.pixel)
    middle = [(x + y) / 2 for x, y in zip(by_side[True], by_side[False], strict=True)]
    assert middle == pytest.approx(point.position, abs=1e-9)


def test_families_without_velocities_have_plain_points(pen):
    for family in FAMILIES:
        if family.derivatives or not family.curve_class.can_close:
            continue
        pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
        pen.session.commit(replace(pen.session.document, curves=(replace(pen.curve, points=()),)), "Begin")
        draw(pen, (CORNER, CORNER, CORNER), CORNER)
        assert pen.curve.is_closed, family
        assert not any(point.corner or point.velocity for point in pen.curve.points), family
