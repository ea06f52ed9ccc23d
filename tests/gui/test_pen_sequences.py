"""Smooth points, automatic ones and corners with the pen in all orders: handles as in Inkscape, FontForge.

The expected handles are those of a pen that knows nothing of velocities: a point that was dragged has its
handle and the mirrored one, a corner has none, and what lies between two points without handles is a line.
"""

from __future__ import annotations

import math
from itertools import pairwise, product

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document import rule_edits
from app.document.constraints import is_straight
from app.document.model import ParametrizationKind
from app.families import FAMILIES, QUINTIC_HERMITE
from app.view_model.curve.handles import handles_of
from tests.gui.editor_facts import at

ALT = Qt.KeyboardModifier.AltModifier

PLACES = ((20, -60), (120, -20), (160, 110), (60, 160), (10, 70))
"""At distances of 108, 136, 112, 103 and, back, 130 pixels: no two segments have the same length in t."""

PULLED = (40, 24)

SMOOTH, AUTOMATIC, CORNER = "drag", "click", "Alt+click"


def draw(pen, kinds, closing=None):
    """Draw a point of each kind, and close the curve by a click, or by one with Alt."""
    for (x, y), kind in zip(PLACES, kinds, strict=False):
        if kind == SMOOTH:
            pen.press(at(pen, x, y))
            pen.move(at(pen, x + PULLED[0], y + PULLED[1]))
            pen.release(at(pen, x + PULLED[0], y + PULLED[1]))
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


@pytest.mark.parametrize("closing", [None, AUTOMATIC, CORNER])
def test_three_points_of_all_kinds_in_all_orders(pen, closing):
    empty = pen.session.document
    for kinds in product(ALL_KINDS, repeat=3):
        pen.session.commit(empty, "Begin")
        assert_handles(draw(pen, kinds, closing), kinds, closing)


@pytest.mark.parametrize("closing", [AUTOMATIC, CORNER])
def test_smooth_smooth_corner_corner_smooth_and_closed_is_one_undo_step_each(pen, closing):
    kinds, before = (SMOOTH, SMOOTH, CORNER, CORNER, SMOOTH), pen.session.undo_stack.count()
    draw(pen, kinds)
    assert_handles(pen, kinds)
    drawn = pen.curve
    pen.move(pen.point(0), held=False, keys=ALT if closing == CORNER else Qt.KeyboardModifier.NoModifier)
    words = "Click to close the curve · Alt: corner by the handle"
    assert pen.window.status_line.hint.startswith(words)
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


def test_a_quintic_keeps_its_curvature_and_no_handle_is_lost(pen):
    """Two velocities would divide its estimated accelerations: it has one, with handles as drawn at most."""
    begun = rule_edits.set_family(pen.session.document, 0, QUINTIC_HERMITE)
    for closing in (None, AUTOMATIC, CORNER):
        pen.session.commit(begun, "Begin")
        kinds = (SMOOTH, SMOOTH, CORNER, CORNER, SMOOTH)
        draw(pen, kinds, closing)
        curve = pen.curve
        assert not curve.points[1].corner
        assert is_straight(curve, 2)
        lengths = [
            math.dist(each.position, each.anchor) / pen.pixel
            for each in handles_of(pen.session.active_view, 1)
            if each.order == 1
        ]
        assert max(lengths) == pytest.approx(math.hypot(*PULLED), rel=1e-9)
        assert curve.points[2].velocity == (0.0, 0.0)
        assert not is_straight(curve, 1)


def test_families_without_velocities_have_plain_points(pen):
    for family in FAMILIES:
        if family.derivatives or not family.curve_class.can_close:
            continue
        pen.session.commit(rule_edits.set_family(pen.session.document, 0, family), "Begin")
        pen.session.commit(replace(pen.session.document, curves=(replace(pen.curve, points=()),)), "Begin")
        draw(pen, (CORNER, CORNER, CORNER), CORNER)
        assert pen.curve.is_closed, family
        assert not any(point.corner or point.velocity for point in pen.curve.points), family
