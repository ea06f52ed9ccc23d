"""Snapping and measuring."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.style import PLAIN_STYLE
from app.families import HERMITE, QUINTIC_HERMITE
from app.settings.preferences import Preferences
from app.testing import Editor
from app.tools.canvas.box_curves import draw_closed_curve, ellipse_in, rectangle_in
from app.tools.pointer import Pointer
from app.tools.snapping import SnapKind, Snapper, Snapping, grid_value, targets_of
from app.view_model.curve.curve_view import view_of
from app.view_model.curve.distances import NearestPoint

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
POINTS = ((0.0, 0.0), (1.03, 2.04), (3.07, 2.11), (4.0, 0.0))
OTHER = ((0.0, -2.0), (2.0, -1.0), (4.0, -2.0))


@pytest.fixture
def pair(editor):
    """Two curves, the first one edited; snapping is on and the grid has a spacing of 0.5."""
    one = make_curve(POINTS)
    two = make_curve(OTHER, name="Base", family=HERMITE)
    document = rule_edits.set_parametrization(
        Document((one, two), grid_spacing=0.5), 0, ParametrizationKind.UNIFORM, []
    )
    editor.session.commit(document, "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.trigger("toggleSnap")
    return editor


def near(editor, place, dx=3, dy=2):
    return (place[0] + dx * editor.pixel, place[1] + dy * editor.pixel)


@pytest.mark.parametrize(
    ("value", "spacing", "expected"),
    [
        (0.31, 0.1, 0.3),
        (0.69, 0.1, 0.7),
        (-0.29, 0.1, -0.3),
        (1.14, 0.05, 1.15),
        (7.1e-5, 2e-5, 8e-5),
        (2.4, 1, 2),
    ],
)
def test_grid_values_are_round_decimal_numbers(value, spacing, expected):
    assert grid_value(value, spacing) == expected


def snap_of(position, *, kinds=frozenset(SnapKind), grid=1.0, axis=None, moving=(1,), on=True):
    views = [view_of(make_curve(POINTS)), view_of(make_curve(OTHER, name="Base"))]
    snapper = Snapper(
        lambda: Snapping(on, kinds),
        lambda: grid,
        lambda: targets_of(views, 0, {0: moving}, moving[0], kinds),
    )
    place = snapper.snap(position, Pointer(position, (0, 0), scale=100.0), axis)
    return place, snapper.caught.label if snapper.caught is not None else None


def test_the_nearest_target_is_caught_within_eight_pixels():
    assert snap_of((3.95, 0.03)) == ((4.0, 0.0), "point 3")
    assert snap_of((4.09, 0.5), kinds={SnapKind.POINTS}) == ((4.09, 0.5), None)
    assert snap_of((2.05, -1.05)) == ((2.0, -1.0), "point 1 of Base")
    assert snap_of((1.96, 0.6)) == ((2.0, 0.6), "grid x")
    assert snap_of((2.05, 1.06)) == ((2.0, 1.0), "grid")
    assert snap_of((1.5, 2.15)) == ((1.5, 2.11), "level with point 2")
    assert snap_of((3.05, 3.5)) == ((3.07, 3.5), "straight above point 2")
    assert snap_of((3.05, 0.03)) == ((3.07, 0.0), "straight below point 2 · level with point 0")


def test_a_dragged_point_does_not_snap_to_its_neighbours():
    # Two points in a row in one place have no distance to go by.
    assert snap_of((0.02, 0.03), kinds={SnapKind.POINTS})[1] is None


def test_the_nearest_point_is_exact_on_a_curve_that_doubles_back():
    """The nearest chord was one of another branch: there was no snap, or one 3.48 units away."""
    curve = view_of(make_curve([(0, 0), (4, 0.001), (1, 0.002), (3, 0.003)]))
    place = tuple(curve.curve.evaluate(0.3916).tolist())
    for reach in (0.01, 9.0):
        assert NearestPoint(curve).within(place, reach).point == pytest.approx(place, abs=1e-12)


def test_a_point_snaps_exactly_to_another_curve():
    (x, y), label = snap_of((1.0, -1.3), kinds={SnapKind.CURVES})
    assert label == "Base"
    curve = view_of(make_curve(OTHER)).curve
    t = np.linspace(0, 1, 200_001)
    away = np.hypot(*(curve.evaluate(t) - (1.0, -1.3)).T)
    assert (x, y) == pytest.approx(curve.evaluate(t[np.argmin(away)]), abs=1e-4)
    assert math.dist((x, y), (1.0, -1.3)) <= away.min() + 1e-12


def test_a_locked_axis_stays_locked():
    assert snap_of((3.95, 0.03), axis=0) == ((4.0, 0.03), "grid x")
    assert snap_of((3.95, 0.03), axis=1)[0] == (3.95, 0.0)


def test_nothing_snaps_while_that_is_off():
    assert snap_of((2.05, 1.06), on=False) == ((2.05, 1.06), None)


def test_a_dragged_point_lands_exactly_on_the_grid(pair):
    pair.press(pair.point(1))
    pair.move(near(pair, (1.5, 3.5)))
    assert pair.point(1) == (1.5, 3.5)
    assert pair.window.canvas.marks.snap.label == "grid"
    assert "snapped to: grid" in pair.status
    pair.release(near(pair, (1.5, 3.5)))
    assert pair.point(1) == (1.5, 3.5)
    assert pair.window.canvas.marks.snap is None


def test_escape_removes_the_mark_of_a_snap(pair):
    document = pair.session.document
    pair.press(pair.point(1))
    pair.move(near(pair, (1.5, 3.5)))
    pair.escape()
    assert pair.session.document is document
    assert pair.window.canvas.marks.snap is None
    pair.release((0, 0))


@pytest.mark.parametrize("keys", [CTRL, SHIFT])
def test_ctrl_and_shift_keep_a_point_to_an_axis_and_snap_along_the_axis(pair, keys):
    """Ctrl turned snapping round."""
    pair.hover(pair.point(1))
    assert "Ctrl or Shift: one axis" in pair.window.status_line.hint
    pair.drag(pair.point(1), near(pair, (1.5, 6.5)), keys=keys)
    assert pair.point(1) == (1.03, 6.5)


def test_a_key_turns_snapping_off_and_on_in_mid_drag(pair):
    document = pair.session.document
    free, held = near(pair, (1.5, 3.5)), pair.window.canvas.marks
    pair.press(pair.point(1))
    pair.move(free)
    for _ in range(2):
        assert pair.point(1) == (1.5, 3.5)
        pair.key(Qt.Key.Key_Percent)
        assert pair.point(1) == pytest.approx(free, abs=pair.pixel)
        assert pair.window.canvas.marks.snap is held.snap is None
        pair.key(Qt.Key.Key_Percent)
    pair.key(Qt.Key.Key_Percent)
    pair.release(free)
    assert pair.point(1) == pytest.approx(free, abs=pair.pixel)
    pair.trigger("undo")
    assert pair.session.document is document


def test_a_point_lands_exactly_on_a_point_of_another_curve(pair):
    pair.drag(pair.point(2), near(pair, OTHER[1]))
    assert pair.point(2) == OTHER[1]


def test_a_selection_moves_with_its_grip_on_the_grid(pair):
    pair.select([1, 2])
    pair.drag(pair.point(1), near(pair, (1.5, 3.5)))
    assert pair.point(1) == (1.5, 3.5)
    assert pair.point(2) == pytest.approx((3.54, 3.57))


def test_a_new_point_snaps_and_the_snap_is_marked_before_the_press(pair):
    pair.trigger("addTool")
    pair.hover(near(pair, (5.5, 1.5)))
    assert pair.window.canvas.marks.snap.position == (5.5, 1.5)
    pair.click(near(pair, (5.5, 1.5)))
    assert pair.point(4) == (5.5, 1.5)
    pair.trigger("selectTool")
    pair.hover((-2, 4))
    assert pair.window.canvas.marks.snap is None


def test_a_move_by_keys_snaps(pair):
    pair.select([1])
    pair.hover(pair.point(1))
    pair.key(Qt.Key.Key_G)
    pair.move(near(pair, (2.0, 3.0)), held=False)
    pair.key(Qt.Key.Key_Return)
    assert pair.point(1) == (2.0, 3.0)


# The grips of the box, and handles


def drag_grip(pair, x, y, corner, to, *, keys=Qt.KeyboardModifier.NoModifier):
    """Press a grip and move the corner of the box, which lies beside it, near `to`."""
    grip = pair.grip(x, y)
    pair.press(grip)
    by = np.subtract(near(pair, to), corner)
    pair.move(tuple(np.add(grip, by)), keys=keys)
    return tuple(np.add(grip, by))


def test_the_corner_of_the_box_lands_exactly_on_the_grid(pair):
    pair.select([0, 1, 2])
    at = drag_grip(pair, 1, 1, (3.07, 2.11), (4.5, 3.5))
    assert pair.point(2) == (4.5, 3.5)
    assert pair.point(0) == (0, 0)
    assert pair.point(1) == pytest.approx((1.03 * 4.5 / 3.07, 2.04 * 3.5 / 2.11))
    assert pair.window.canvas.marks.snap.position == (4.5, 3.5)
    assert pair.status.endswith("snapped to: grid")
    pair.release(at)
    assert pair.point(2) == (4.5, 3.5)
    assert pair.session.undo_stack.undoText() == "Scale 3 points"
    assert pair.window.canvas.marks.snap is None


def test_the_corner_of_the_box_lands_exactly_on_a_point_of_another_curve(pair):
    pair.select([0, 1])
    pair.release(drag_grip(pair, 1, -1, (1.03, 0.0), OTHER[1]))
    assert (pair.point(1)[0], pair.point(0)[1]) == OTHER[1]


def test_the_corner_of_the_box_meets_another_curve(pair):
    place = pair.session.views[1].curve.evaluate(0.3)
    pair.select([0, 1])
    pair.window.preferences.snap_kinds = {SnapKind.CURVES}
    pair.window.store.read_preferences()
    at = drag_grip(pair, 1, -1, (1.03, 0.0), place)
    assert pair.window.canvas.marks.snap.label == "Base"
    assert pair.window.canvas.marks.snap.position == (pair.point(1)[0], pair.point(0)[1])
    pair.release(at)


@pytest.mark.parametrize(("to", "label"), [(3.5, "grid x"), (4.0, "straight above point 3")])
def test_a_side_of_the_box_snaps_along_its_direction(pair, to, label):
    pair.select([0, 1, 2])
    at = drag_grip(pair, 1, 0, (3.07, 1.055), (to, 1.055))
    assert pair.window.canvas.marks.snap.label == label
    pair.release(at)
    assert pair.point(2) == (to, 2.11)


def test_a_box_in_proportion_snaps_with_its_longer_side(pair):
    pair.select([0, 2])
    pair.release(drag_grip(pair, 1, 1, (3.07, 2.11), (4.5, 4.5 / 3.07 * 2.11), keys=CTRL), keys=CTRL)
    assert pair.point(2)[0] == 4.5
    assert pair.point(2)[1] / 4.5 == pytest.approx(2.11 / 3.07)


def test_a_scaled_box_is_free_without_snapping_and_escape_restores_the_points(pair):
    pair.select([0, 1, 2])
    document = pair.session.document
    at = drag_grip(pair, 1, 1, (3.07, 2.11), (4.5, 3.5))
    assert pair.point(2) == (4.5, 3.5)
    pair.key(Qt.Key.Key_Percent)
    assert pair.point(2) != (4.5, 3.5)
    assert pair.window.canvas.marks.snap is None
    pair.escape()
    pair.release(at)
    assert pair.session.document is document
    assert pair.window.canvas.marks.snap is None


@pytest.fixture
def quintic(pair):
    pair.choose_family(QUINTIC_HERMITE)
    pair.select([1])
    return pair


def handle_end(editor, kind):
    return editor.handle(kind).position


@pytest.mark.parametrize("kind", [1, 2])
def test_the_end_of_a_handle_snaps(quintic, kind):
    start = handle_end(quintic, kind)
    for target, label in (
        ((2.5, 3.5), "grid"),
        (OTHER[1], "point 1 of Base"),
        ((2.3, 2.04), "level with point 1"),
    ):
        quintic.press(start)
        # Points 1 and 2 are almost level: nearer to the one that is meant.
        beside = near(quintic, target, dx=0, dy=1)
        quintic.move(beside)
        assert quintic.window.canvas.marks.snap.label == label
        assert f"snapped to: {label}" in quintic.status
        quintic.release(beside)
        along = 1 if label.startswith("level") else slice(None)
        end = np.array(handle_end(quintic, kind))
        assert end[along] == pytest.approx(np.array(target)[along], abs=1e-12), label
        assert quintic.window.canvas.marks.snap is None, label
        quintic.trigger("undo")
        assert handle_end(quintic, kind) == start


def test_the_end_of_a_handle_meets_another_curve(quintic):
    place = tuple(quintic.session.views[1].curve.evaluate(0.3))
    quintic.press(handle_end(quintic, 1))
    quintic.move(near(quintic, place))
    snap = quintic.window.canvas.marks.snap
    assert snap.label == "Base"
    assert handle_end(quintic, 1) == pytest.approx(snap.position, abs=1e-12)
    quintic.release(place)


def test_a_handle_keeps_a_held_angle_or_direction_and_snaps_no_more(quintic):
    for keys in (CTRL, SHIFT, SHIFT | Qt.KeyboardModifier.AltModifier):
        document = quintic.session.document
        x, y = quintic.point(1)
        start = handle_end(quintic, 1)
        quintic.press(start)
        quintic.move(near(quintic, (2.5, 3.5)), keys=keys)
        tip = handle_end(quintic, 1)
        degrees = math.degrees(math.atan2(tip[1] - y, tip[0] - x))
        held = 45.0 if keys in (CTRL, SHIFT) else math.degrees(math.atan2(start[1] - y, start[0] - x))
        assert degrees == pytest.approx(held, abs=1e-9), keys
        assert quintic.window.canvas.marks.snap is None, keys
        quintic.move(near(quintic, (2.5, 3.5)))
        assert quintic.window.canvas.marks.snap is not None, keys
        quintic.escape()
        quintic.release((0, 0))
        assert quintic.session.document is document, keys
        assert quintic.window.canvas.marks.snap is None, keys


def test_a_velocity_pulled_out_of_a_point_snaps(quintic):
    quintic.press(quintic.point(1), keys=Qt.KeyboardModifier.AltModifier)
    quintic.move(near(quintic, (2.5, 3.5)), keys=Qt.KeyboardModifier.AltModifier)
    assert handle_end(quintic, 1) == pytest.approx((2.5, 3.5), abs=1e-12)
    quintic.release((2.5, 3.5), keys=Qt.KeyboardModifier.AltModifier)


def test_a_closed_curve_is_measured_from_all_its_points(pair):
    pair.choose_family(HERMITE)
    pair.trigger("closeCurve")
    pair.trigger("measureTool")
    pair.hover(near(pair, pair.point(3)))
    assert pair.window.canvas.marks.snap.label == "point 3"


def test_points_snap_to_the_grid_on_screen(editor):
    canvas = editor.window.canvas
    canvas.camera.show_box((0, 10), (0, 8))
    wide = canvas.tools.canvas.grid_spacing()
    canvas.camera.show_box((0, 0.1), (0, 0.08))
    assert canvas.tools.canvas.grid_spacing() == pytest.approx(wide / 100)
    for spacing in (wide, canvas.tools.canvas.grid_spacing()):
        assert len(f"{spacing!r}") <= 6
    canvas.drawing.grid.set_spacing(0.25)
    assert canvas.tools.canvas.grid_spacing() == 0.25
    for width in (1e-3, 1.0, 1e4, 1e9):
        canvas.camera.show_box((0, width), (0, width))
        editor.settle()
        assert 0 < len(canvas.getAxis("bottom").ticks_in(canvas.pixel_map).marks) < 200


def test_settings_are_remembered(qtbot, tmp_path):
    store = tmp_path / "settings.ini"
    preferences = Preferences(store)
    preferences.snap_kinds = {SnapKind.GRID, SnapKind.LEVEL}
    preferences.grid_spacing = 0.1
    preferences.unit_name = "mm"
    first = Editor(qtbot, preferences=preferences)
    first.trigger("toggleSnap")
    again = Preferences(store)
    assert again.snap_on
    assert again.snap_kinds == {SnapKind.GRID, SnapKind.LEVEL}
    assert (again.grid_spacing, again.unit_name) == (0.1, "mm")
    second = Editor(qtbot, preferences=again)
    assert second.action("toggleSnap").isChecked()
    assert second.window.canvas.tools.canvas.grid_spacing() == 0.1


@pytest.mark.parametrize(
    ("key", "value", "name", "default"),
    [
        ("snap/on", "perhaps", "snap_on", False),
        ("snap/kinds", "moon", "snap_kinds", frozenset(SnapKind)),
        ("grid/spacing", "wide", "grid_spacing", 0.0),
        ("grid/spacing", "-1", "grid_spacing", 0.0),
        ("grid/spacing", "nan", "grid_spacing", 0.0),
        ("view/transform_box", "2", "transform_box", True),
    ],
)
def test_foreign_settings_give_the_default_and_a_sentence(tmp_path, key, value, name, default):
    preferences = Preferences(tmp_path / "settings.ini")
    preferences.file.write(key, value)
    assert getattr(preferences, name) == default
    assert key in preferences.complaint


# Measuring


def test_measuring_snaps_and_changes_nothing(pair):
    pair.set_unit("mm")
    document = pair.session.document
    pair.trigger("measureTool")
    pair.press(near(pair, POINTS[0]))
    pair.move(near(pair, (3.0, 4.0)))
    ruler = pair.window.canvas.marks.ruler
    assert (ruler.start, ruler.end) == (POINTS[0], (3.0, 4.0))
    assert ruler.text == "5 mm · Δx 3 · Δy 4 · 53.1°"
    assert pair.status.startswith(ruler.text)
    pair.release(near(pair, (3.0, 4.0)))
    assert pair.window.canvas.marks.ruler == ruler
    pair.escape()
    assert pair.window.canvas.marks.ruler is None
    assert pair.action("measureTool").isChecked()
    pair.escape()
    assert pair.action("selectTool").isChecked()
    assert pair.session.document is document


def test_measuring_can_be_cancelled_and_does_not_swallow_undo(pair):
    pair.trigger("measureTool")
    pair.press((0, 3))
    pair.move((2, 3))
    pair.escape()
    assert pair.window.canvas.marks.ruler is None
    pair.release((2, 3))
    assert pair.window.canvas.marks.ruler is None
    pair.drag((0, 3), (2, 3))
    pair.trigger("undo")
    assert len(pair.session.document.curves) == 1


def test_a_point_is_measured_not_dragged(pair):
    pair.trigger("measureTool")
    pair.drag(pair.point(1), (2, 3))
    assert pair.point(1) == POINTS[1]
    assert pair.window.canvas.marks.ruler.start == POINTS[1]


def test_percent_switches_snapping_and_leaves_shift_s_to_smooth_points(pair):
    before = pair.action("toggleSnap").isChecked()
    pair.key(Qt.Key.Key_Percent)
    assert pair.action("toggleSnap").isChecked() is not before
    pair.key(Qt.Key.Key_S, SHIFT)
    assert pair.action("toggleSnap").isChecked() is not before


# Midpoints


@pytest.fixture
def boxes(editor):
    """A rectangle and an ellipse, and a line to drag; points snap to no grid."""
    document = Document((make_curve(((3.0, -2.0), (4.6, -1.0)), name="Line", family=HERMITE),))
    for pieces in (rectangle_in((0.0, 0.0), (2.0, 1.0)), ellipse_in((5.0, 2.0), (6.0, 3.5))):
        document = draw_closed_curve(document, 0, "Curve", pieces, PLAIN_STYLE)
    names = ("Line", "Card", "Egg")
    curves = [replace(each, name=name) for each, name in zip(document.curves, names, strict=True)]
    editor.session.commit(replace(document, curves=tuple(curves)), "Begin")
    editor.session.selected.select_whole([0])
    editor.window.canvas.camera.show_box((-2, 8), (-3, 5))
    editor.trigger("toggleSnap")
    return editor


def test_a_point_finds_midpoints(boxes):
    place, label = (1.0, 0.0), "midpoint of Card"
    boxes.session.selected.edit_selected()
    boxes.window.store.change(snap_kinds=frozenset({SnapKind.MIDDLES}))
    boxes.press(boxes.point(0))
    boxes.move(near(boxes, place))
    assert (boxes.window.canvas.marks.snap.position, boxes.window.canvas.marks.snap.label) == (place, label)
    boxes.escape()
    boxes.window.store.change(snap_kinds=frozenset({SnapKind.POINTS}))
    boxes.press(boxes.point(0))
    boxes.move(near(boxes, place))
    assert boxes.window.canvas.marks.snap is None
    boxes.escape()
