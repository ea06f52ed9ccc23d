"""Selecting, transforming, aligning and nudging, with real mouse and key events."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np
import pytest
from extents import CLOSE, box_shown, sampled_bounds
from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest

from app.document import point_edits, rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.transforms import rotation, transform_points
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.tools.box import TransformKind
from app.view_model.curve.curve_view import view_of
from tests.gui.editor_facts import transform, undo_text

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier
Key = Qt.Key
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0))


def points(editor) -> np.ndarray:
    return np.array([point.position for point in editor.curve.points])


# Selecting


def test_shift_click_toggles(arch):
    arch.select_point(1)
    arch.click(arch.point(2), keys=SHIFT)
    assert arch.session.selection == {1, 2}
    arch.click(arch.point(1), keys=SHIFT)
    assert arch.session.selection == {2}


def test_a_click_on_a_selected_point_selects_the_point_alone(arch):
    arch.select([0, 1, 2])
    arch.click(arch.point(1))
    assert arch.session.selection == {1}


def test_a_drag_of_a_selected_point_moves_all_selected_points(arch):
    arch.select([1, 2])
    arch.drag_point(1, to=(1, 3))
    assert points(arch)[1:3] == pytest.approx(np.array([(1, 3), (3, 3)]), abs=2 * arch.pixel)
    assert undo_text(arch) == "Move 2 points"
    assert arch.session.selection == {1, 2}


def test_a_drag_with_shift_moves_only_the_point_under_the_pointer(arch):
    arch.select([0])
    arch.drag_point(1, to=(2, 2.2), keys=SHIFT)
    assert arch.point(0) == (0.0, 0.0)
    assert arch.point(1)[1] == 2.0
    assert undo_text(arch) == "Move point 1"


def test_the_rubber_band_selects_live(arch):
    arch.press((-1, 3))
    arch.move((2, 1))
    assert arch.window.canvas.marks.band is not None
    assert arch.session.selection == {1}
    assert arch.status.startswith("Point 1 selected")
    arch.move((3.5, 1))
    assert arch.session.selection == {1, 2}
    arch.release((3.5, 1))
    assert arch.session.selection == {1, 2}
    assert arch.window.canvas.marks.band is None


def test_shift_adds_with_the_band_and_a_click_with_shift_keeps(arch):
    arch.select([0])
    arch.drag((2.5, 3), (5, 1), keys=SHIFT)
    assert arch.session.selection == {0, 2}
    arch.click((-2, 4), keys=SHIFT)
    assert arch.session.selection == {0, 2}


def test_escape_restores_the_selection_from_before_the_band(arch):
    arch.select([3])
    arch.press((-1, 3))
    arch.move((3.5, 1))
    assert arch.session.selection == {1, 2}
    arch.escape()
    assert arch.session.selection == {3}
    arch.move((5, -1))
    arch.release((5, -1))
    assert arch.session.selection == {3}


def test_tab_moves_the_view_to_a_point_out_of_sight(arch):
    arch.window.canvas.camera.show_box((-0.5, 1.5), (-0.5, 1.5))
    arch.settle()
    arch.select([0])
    for index in (1, 2, 3):
        arch.key(Key.Key_Tab)
        assert arch.session.selection == {index}
        x_min, y_min, x_max, y_max = arch.window.canvas.pixel_map.box
        x, y = arch.point(index)
        assert x_min < x < x_max
        assert y_min < y < y_max


def test_tab_walks_points_that_lie_on_each_other(editor):
    editor.session.commit(Document((make_curve([(0, 0), (1, 1), (1, 1), (2, 0)]),)), "Begin")
    editor.select([0])
    for index in (1, 2, 3):
        editor.key(Key.Key_Tab)
        assert editor.session.selection == {index}


# Transforms by keys


def test_g_moves_without_a_button_until_a_click(arch):
    arch.select([1, 2])
    steps = arch.session.undo_stack.count()
    arch.hover((0, 3))
    arch.key(Key.Key_G)
    arch.move((1, 4), held=False)
    assert points(arch)[1] == pytest.approx((2, 3), abs=2 * arch.pixel)
    arch.click((1, 4))
    assert undo_text(arch) == "Move 2 points"
    assert arch.session.undo_stack.count() == steps + 1
    arch.move((3, 4), held=False)
    assert points(arch)[1] == pytest.approx((2, 3), abs=2 * arch.pixel)
    assert arch.session.selection == {1, 2}


def test_a_typed_angle_rotates_exactly_about_the_centre(arch):
    arch.select([0, 1, 3])
    arch.key(Key.Key_R)
    arch.type_amount("90")
    assert arch.status.startswith("Rotate 90°")
    assert arch.window.canvas.marks.note.text == "Rotate 90°"
    arch.key(Key.Key_Return)
    assert points(arch)[[0, 1, 3]].tolist() == [[3, -1], [1, 0], [3, 3]]
    assert undo_text(arch) == "Rotate 3 points"


def test_all_points_turn_about_the_middle_of_the_curve(arch):
    x, y = sampled_bounds(arch).mean(axis=0)
    assert y > 1.05, "the curve rises above its points"
    arch.select([0, 1, 2, 3])
    transform(arch, "R", "90")
    expected = [(x - (b - y), y + (a - x)) for a, b in POINTS]
    assert points(arch) == pytest.approx(np.array(expected), abs=CLOSE)
    assert undo_text(arch) == "Rotate 4 points"


def test_typed_digits_of_an_amount_do_not_switch_the_family(arch):
    arch.select([1, 2])
    arch.key(Key.Key_S)
    arch.type_amount("23")
    assert arch.curve.family is LAGRANGE
    arch.escape()
    QTest.keyClicks(arch.window.canvas, "2")
    assert arch.curve.family is HERMITE


def test_numbers_can_be_mended_and_negated(arch):
    arch.select([1, 2])
    arch.key(Key.Key_S)
    for key in (Key.Key_3, Key.Key_Backspace, Key.Key_2, Key.Key_Period, Key.Key_5, Key.Key_Minus):
        arch.key(key)
    arch.key(Key.Key_X)
    assert arch.status.startswith("Scale −2.5 along x")
    arch.key(Key.Key_Enter)
    assert points(arch)[1:3].tolist() == [[4.5, 2], [-0.5, 2]]


def test_an_axis_is_locked_and_freed(arch):
    arch.select([1])
    arch.hover((1, 2.5))
    arch.key(Key.Key_G)
    arch.key(Key.Key_Y)
    arch.move((2, 3.5), held=False)
    assert arch.point(1)[0] == 1.0
    assert arch.window.canvas.marks.axis is not None
    arch.key(Key.Key_Y)
    assert arch.point(1)[0] == pytest.approx(2, abs=2 * arch.pixel)
    arch.key(Key.Key_X)
    arch.key(Key.Key_3)
    arch.key(Key.Key_Return)
    assert arch.point(1) == (4.0, 2.0)


def test_a_transform_can_be_cancelled(arch):
    for way in ("escape", "right click", "undo"):
        arch.select([1, 2])
        document, steps = arch.session.document, arch.session.undo_stack.count()
        for key in (Key.Key_G, Key.Key_S, Key.Key_R):
            arch.hover((0, 3))
            arch.key(key)
            arch.move((1, 4.5), held=False)
            assert arch.session.document != document, (way, key)
            if way == "escape":
                arch.escape()
            elif way == "undo":
                arch.trigger("undo")
            else:
                place = arch.window.canvas.to_pixel(1, 4.5)
                right = Qt.MouseButton.RightButton
                arch.send(arch.window.canvas, QEvent.Type.MouseButtonPress, place, button=right)
                arch.send(arch.window.canvas, QEvent.Type.MouseButtonRelease, place, held=False, button=right)
            assert arch.session.document is document, (way, key)
            assert arch.session.undo_stack.count() == steps, (way, key)
            arch.move((2, 2), held=False)
            assert arch.session.document is document, (way, key)
            assert arch.window.canvas.marks.note is None, (way, key)


def test_s_follows_the_pointer_away_from_the_centre(arch):
    arch.select([1, 2])
    arch.hover((4, 2))
    arch.key(Key.Key_S)
    arch.move((6, 2), held=False)
    arch.click((6, 2))
    assert points(arch)[1:3] == pytest.approx(np.array([(0, 2), (4, 2)]), abs=4 * arch.pixel)


def test_r_follows_the_pointer_and_shift_makes_steps(arch):
    arch.select([1, 2])
    arch.hover((4, 2))
    arch.key(Key.Key_R)
    arch.move((2 + 2 * math.cos(0.75), 2 + 2 * math.sin(0.75)), held=False, keys=SHIFT)
    assert arch.status.startswith("Rotate 45°")
    arch.key(Key.Key_Return)
    away = math.sqrt(0.5)
    assert points(arch)[1:3] == pytest.approx(np.array([(2 - away, 2 - away), (2 + away, 2 + away)]))


def test_a_transform_ends_when_the_focus_moves(arch):
    arch.select([1, 2])
    document = arch.session.document
    arch.hover((0, 3))
    arch.key(Key.Key_G)
    arch.move((1, 4.5), held=False)
    arch.window.point_table.setFocus()
    assert arch.session.document is document


def test_the_menu_begins_a_transform(arch):
    arch.select([1, 2])
    arch.trigger("rotateSelection")
    arch.type_amount("180")
    arch.key(Key.Key_Return)
    assert points(arch).tolist() == [[0, 0], [3, 2], [1, 2], [4, 0]]


def test_an_action_during_a_transform_cancels_the_transform(arch):
    arch.select([1, 2])
    arch.hover((0, 3))
    arch.key(Key.Key_G)
    arch.move((1, 4.5), held=False)
    arch.trigger("deleteSelection")
    assert points(arch).tolist() == [[0, 0], [4, 0]]
    arch.trigger("undo")
    assert points(arch).tolist() == [list(point) for point in POINTS]


RULES = [kind for kind in ParametrizationKind if kind is not ParametrizationKind.MANUAL]


def bent(family, kind):
    """Four points with all that can be set by hand."""
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, family)
    document = rule_edits.set_parametrization(document, 0, kind, [])
    document = point_edits.set_velocity(document, 0, 1, (3.0, 1.0))
    document = point_edits.make_corner(document, 0, 2, (1.0, 2.0), (2.0, -5.0))
    return point_edits.set_derivative(document, 0, 1, 2, (-4.0, 7.0))


def turned(curve, t, centre):
    """The curve, turned by 30° about a point, at parameters."""
    angle = math.radians(30)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    # Rounding of the points and of the rule's distances, which the basis may enlarge.
    return pytest.approx((curve.evaluate(t) - centre) @ turn.T + centre, abs=1e-12)


@pytest.mark.parametrize("family", FAMILIES)
def test_a_rotation_of_all_points_carries_every_curve_along(family):
    t = np.linspace(0, 1, 41)
    for kind in RULES:
        document = bent(family, kind)
        after = transform_points(document, 0, range(4), rotation(30.0, (1.0, 2.0)))
        before, now = (view_of(each.curves[0]).curve for each in (document, after))
        assert now.evaluate(t) == turned(before, t, (1.0, 2.0)), kind


def test_a_rotation_of_all_points_carries_the_curve_along(arch):
    """Each family under two rules; the test above has all of them."""
    t = np.linspace(0, 1, 41)
    for place, family in enumerate(FAMILIES):
        for kind in (RULES[place % len(RULES)], RULES[-1 - place % len(RULES)]):
            arch.session.commit(bent(family, kind), "Prepare")
            before = arch.session.active_view.curve
            arch.select([0, 1, 2, 3])
            centre = box_shown(arch).mean(axis=0)
            transform(arch, "R", "30")
            now = arch.session.active_view.curve
            assert now.evaluate(t) == turned(before, t, centre), (family, kind)


# The box


def test_a_corner_grip_scales_about_the_opposite_corner(arch):
    arch.select([0, 1, 2, 3])
    before, start = sampled_bounds(arch), arch.grip(1, 1)
    arch.drag(start, (start[0] + 2, start[1] + 1))
    # The curve answers to another spacing of its points with another shape; the box follows the pointer.
    assert sampled_bounds(arch) == pytest.approx(np.add(before, [(0, 0), (2, 1)]), abs=3 * arch.pixel)
    assert undo_text(arch) == "Scale 4 points"


def test_a_corner_grip_scales_a_few_points_by_their_own_box(arch):
    arch.select([0, 1, 3])
    start = arch.grip(1, 1)
    arch.drag(start, (start[0] + 2, start[1] + 1))
    assert points(arch) == pytest.approx(np.array([(0, 0), (1.5, 3), (3, 2), (6, 0)]), abs=3 * arch.pixel)


def test_ctrl_keeps_proportions(arch):
    arch.select([0, 1, 2, 3])
    start = arch.grip(1, 1)
    arch.drag(start, (start[0] + 2, start[1] + 1), keys=CTRL)
    size = np.ptp(points(arch), axis=0)
    assert size[0] > 5
    assert size[0] / size[1] == pytest.approx(2)


def test_shift_scales_about_the_middle(arch):
    arch.select([0, 1, 2, 3])
    before = sampled_bounds(arch)
    arch.drag(arch.grip(1, 0), (arch.grip(1, 0)[0] + 1, 1), keys=SHIFT)
    assert sampled_bounds(arch) == pytest.approx(np.add(before, [(-1, 0), (1, 0)]), abs=3 * arch.pixel)


def test_ctrl_and_shift_scale_in_proportion_about_the_middle(arch):
    arch.select([0, 1, 2, 3])
    before, start = sampled_bounds(arch), arch.grip(1, 1)
    arch.drag(start, (start[0] + 1, start[1]), keys=CTRL | SHIFT)
    after = sampled_bounds(arch)
    assert after.mean(axis=0) == pytest.approx(before.mean(axis=0), abs=CLOSE)
    assert np.ptp(after, axis=0) / np.ptp(before, axis=0) == pytest.approx(
        2 * [np.ptp(after[:, 0]) / np.ptp(before[:, 0])], rel=CLOSE
    )


def test_the_round_grip_rotates(arch):
    arch.select([0, 1, 2, 3])
    x, y = sampled_bounds(arch).mean(axis=0)
    arch.drag(arch.grip(), (-1, y), keys=SHIFT)
    expected = [(x - (b - y), y + (a - x)) for a, b in POINTS]
    assert points(arch) == pytest.approx(np.array(expected), abs=CLOSE)
    assert undo_text(arch) == "Rotate 4 points"


def test_escape_cancels_a_drag_of_a_grip(arch):
    for place in ((1, 1), (-1, 0), (0, 0)):
        arch.select([0, 1, 2, 3])
        document = arch.session.document
        start = arch.grip(*place)
        arch.press(start)
        arch.move((start[0] + 1.3, start[1] + 0.8))
        assert arch.session.document != document, place
        arch.escape()
        arch.release((0, 0))
        assert arch.session.document is document, place


def test_points_in_a_row_have_no_grips_that_would_do_nothing(arch):
    arch.select([1, 2])
    box = arch.window.canvas.marks.box
    assert {(each.x, each.y) for each, _ in box.grips(50) if each.does is TransformKind.SCALE} == {
        (-1, 0),
        (1, 0),
    }


def test_the_box_can_be_hidden_and_stays_hidden(arch):
    arch.select([0, 1])
    assert arch.window.canvas.marks.box is not None
    arch.trigger("toggleTransformBox")
    assert arch.window.canvas.marks.box is None
    assert not arch.window.preferences.transform_box


def test_grips_have_a_hint_and_a_pointer_shape(arch):
    arch.select([0, 1, 2, 3])
    arch.hover(arch.grip(1, 1))
    assert "scale 4 points" in arch.window.status_line.hint
    assert arch.window.canvas.viewport().cursor().shape() == Qt.CursorShape.SizeBDiagCursor
    arch.hover(arch.grip())
    assert "rotate 4 points" in arch.window.status_line.hint
    assert arch.window.canvas.viewport().cursor().shape() == Qt.CursorShape.BitmapCursor


# Align, distribute, nudge


SIDES = [
    ("alignLeft", 0, 0.0, "left"),
    ("alignCentre", 0, 1.5, "centre"),
    ("alignRight", 0, 3.0, "right"),
    ("alignTop", 1, 2.0, "top"),
    ("alignMiddle", 1, 1.0, "middle"),
    ("alignBottom", 1, 0.0, "bottom"),
]


def test_align(arch):
    arch.choose_parametrization(ParametrizationKind.UNIFORM)
    for action, axis, value, name in SIDES:
        arch.select([0, 1, 2])
        before = points(arch)
        arch.trigger(action)
        assert points(arch)[:3, axis].tolist() == [value] * 3, name
        assert points(arch)[:, 1 - axis].tolist() == before[:, 1 - axis].tolist(), name
        assert points(arch)[3].tolist() == before[3].tolist(), name
        assert undo_text(arch) == f"Align 3 points {name}", name
        arch.trigger("undo")


def test_distribute(arch):
    arch.select([0, 1, 2, 3])
    arch.trigger("distributeHorizontally")
    assert points(arch)[:, 0] == pytest.approx([0, 4 / 3, 8 / 3, 4])
    assert points(arch)[[0, 3], 0].tolist() == [0, 4]
    assert undo_text(arch) == "Distribute 4 points horizontally"
    arch.trigger("undo")
    assert points(arch).tolist() == [list(point) for point in POINTS]


def test_actions_that_need_more_points_are_disabled(arch):
    arch.select([1])
    assert arch.action("rotateSelection").isEnabled()
    assert not arch.action("alignLeft").isEnabled()
    arch.select([1, 2])
    assert arch.action("alignLeft").isEnabled()
    assert not arch.action("distributeVertically").isEnabled()
    arch.select([])
    assert arch.action("moveSelection").isEnabled()


def test_arrows_nudge_by_the_grid_while_snapping_in_decimal_numbers(arch):
    arch.set_grid(0.1)
    arch.trigger("toggleSnap")
    arch.select([0])
    for _ in range(3):
        arch.key(Key.Key_Right)
    assert arch.point(0) == (0.3, 0.0)
    arch.key(Key.Key_Up, SHIFT)
    assert arch.point(0) == (0.3, 1.0)
    arch.key(Key.Key_Down, CTRL)
    assert arch.point(0) == (0.3, 0.99)


def test_arrows_nudge_by_a_round_number_of_some_pixels_at_any_zoom(arch):
    for width in (7, 11, 17, 0.03, 4000):
        arch.window.canvas.camera.show_box((0, width), (0, width / 2))
        arch.session.commit(Document((make_curve(((0.1, 0.2), (1.0, 2.0))),)), "Begin anew")
        arch.select([0])
        arch.key(Key.Key_Right)
        step = Decimal(repr(arch.point(0)[0])) - Decimal("0.1")
        assert step.normalize().as_tuple().digits in ((1,), (2,), (5,))
        assert 2 <= float(step) / arch.pixel <= 5
        # Decimal sums: no 0.30000000000000004, and back again is where it was, to the last bit.
        for _ in range(2):
            arch.key(Key.Key_Right)
        assert arch.point(0) == (float(Decimal("0.1") + 3 * step), 0.2)
        arch.key(Key.Key_Up, SHIFT)
        assert arch.point(0)[1] == float(Decimal("0.2") + 10 * step)
        for key, keys, times in ((Key.Key_Down, SHIFT, 1), (Key.Key_Left, NO_KEYS, 3)):
            for _ in range(times):
                arch.key(key, keys)
        assert arch.point(0) == (0.1, 0.2)


def test_ctrl_nudges_by_a_tenth(arch):
    arch.select([0])
    arch.key(Key.Key_Right)
    step = arch.point(0)[0]
    arch.key(Key.Key_Left)
    arch.key(Key.Key_Right, CTRL)
    assert arch.point(0)[0] == float(Decimal(repr(step)) / 10)
