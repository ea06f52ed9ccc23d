"""Kinds of points: their keys, what a handle takes along, how Alt breaks it, and the marks that tell them."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.constraints import angle_between, has_parallel_velocities, is_straight
from app.document.model import Document, ParametrizationKind, make_curve
from app.exchange.files import export, import_file
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.storage.format import decode, encode
from app.view_model.analysis.joints import certificate_of
from app.view_model.point_kinds import (
    CORNER,
    ESTIMATED,
    POINT_KINDS,
    SMOOTH,
    SYMMETRIC,
    kind_at,
    kinds_of,
)

Key = Qt.Key
SHIFT = Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier
BOW = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 1.0), (6.0, 0.0))
KEYS = {CORNER: Key.Key_C, SMOOTH: Key.Key_S, SYMMETRIC: Key.Key_Y, ESTIMATED: Key.Key_A}


@pytest.fixture
def bow(editor):
    """A cubic curve of five points."""
    editor.session.commit(Document((make_curve(BOW, name="Bow", family=HERMITE),)), "Begin", active=0)
    editor.fit()
    return editor


def kinds(editor):
    return [POINT_KINDS[kind].name.removeprefix("point-") for kind in kinds_of(editor.session.active_view)]


def handle_lengths(editor, index):
    view = editor.session.active_view
    return [
        math.hypot(*view.velocity_of(index, ahead=ahead)) * view.spacing(index, ahead=ahead) / 3
        for ahead in (False, True)
    ]


def positions(editor):
    return [editor.handle(ahead=ahead).position for ahead in (False, True)]


# Keys


@pytest.mark.parametrize("family", [family for family in FAMILIES if family.derivatives])
def test_a_key_sets_the_kind_of_the_selected_points_in_one_step(bow, family):
    bow.choose_family(family)
    bow.select([1, 2, 3])
    before = bow.session.document
    for kind in POINT_KINDS:
        bow.session.commit(before, "Begin again")
        bow.key(KEYS[SMOOTH if kind is not SMOOTH else CORNER], SHIFT)
        steps = bow.session.undo_stack.count()
        bow.key(KEYS[kind], SHIFT)
        assert kinds(bow)[1:4] == [kind.name.removeprefix("point-")] * 3
        assert bow.session.undo_stack.count() == steps + 1, kind
        assert bow.session.undo_stack.undoText() == f"{kind.step} 3 points"
        assert bow.status.startswith(f"{kind.title} at points 1, 2 and 3.")
        assert bow.action(kind.action).isChecked(), kind
        assert [bow.action(each.action).isChecked() for each in POINT_KINDS].count(True) == 1, kind


def test_each_kind_is_in_the_menus_the_palette_and_above_the_table(bow):
    document = bow.session.document
    for kind in POINT_KINDS:
        bow.session.commit(document, "Again")
        bow.select([2])
        menu = bow.open_menu(bow.point(2))
        assert kind.action in {action.objectName() for action in menu.actions()}, kind
        QTest.keyClick(menu, Key.Key_Escape)
        assert any(kind.title in each for each in bow.find_command(f"{kind.title} Tangents")), kind
        QTest.keyClick(bow.window, Key.Key_Escape)
        bow.escape()
        bow.select([2])
        button = bow.window.findChild(QToolButton, f"{kind.action}AboveButton")
        assert button.isVisible(), kind
        assert button.accessibleName(), kind
        assert kind.key.split(",")[0] in button.toolTip(), kind
        assert not button.icon().isNull(), kind
        if kind is not ESTIMATED:
            QTest.mouseClick(button, Qt.MouseButton.LeftButton)
            bow.settle()
            assert kind_at(bow.session.active_view, 2) is kind, kind


def test_families_without_handles_have_no_kinds(bow):
    bow.select([2])
    bow.choose_family(LAGRANGE)
    for kind in POINT_KINDS:
        action = bow.action(kind.action)
        assert not action.isEnabled()
        assert "A Lagrange curve has no velocities at its points" in action.toolTip()
    assert not bow.window.findChild(QToolButton, "tangentCornerAboveButton").isVisible()
    assert set(kinds(bow)) == {"estimated"}


def test_ends_of_an_open_curve_have_one_handle(bow):
    bow.select([0])
    document = bow.session.document
    for key in (Key.Key_S, Key.Key_Y):
        bow.session.say("")
        bow.key(key, SHIFT)
        assert bow.session.document is document
        assert bow.status == "Point 0 is an end of the curve; it has one handle."
    bow.select([0, 1])
    bow.key(Key.Key_S, SHIFT)
    assert bow.status.startswith("Smooth at point 1; the ends of an open curve have one side only.")
    assert [point.tied for point in bow.curve.points] == [False, True, False, False, False]
    # One that is set is of no kind.
    bow.select_point(0)
    x, y = bow.handle().position
    bow.drag_handle((x + 0.2, y + 0.3))
    assert bow.curve.points[0].velocity
    assert not any(bow.action(kind.action).isChecked() for kind in POINT_KINDS)
    bow.trigger("closeCurve")
    bow.select([0])
    bow.key(Key.Key_S, SHIFT)
    assert bow.curve.points[0].tied


def test_a_point_with_handles_of_two_lengths_is_smooth_and_not_symmetric(bow):
    """The button *Symmetric* was pressed at handles of 103.8 and 59.4 pixels, and changed them at a press."""
    bow.select_point(2)
    x, y = bow.handle().position
    bow.drag_handle((x + 0.3, y + 0.1))
    assert not bow.curve.points[2].corner
    assert kind_at(bow.session.active_view, 2) is SMOOTH
    assert not bow.action("tangentSymmetric").isChecked()
    before = bow.session.active_view.samples
    bow.key(Key.Key_S, SHIFT)
    assert bow.session.active_view.samples == pytest.approx(before, abs=1e-12)
    bow.key(Key.Key_Y, SHIFT)
    assert bow.action("tangentSymmetric").isChecked()
    behind, ahead = positions(bow)
    assert np.add(behind, ahead) / 2 == pytest.approx(BOW[2])


def test_a_symmetric_point_beside_an_inserted_one_is_smooth(bow):
    """The cut shortens one handle, and *Symmetric* stayed pressed at 18.7 and 41.2 pixels."""
    bow.select_point(2)
    bow.key(Key.Key_Y, SHIFT)
    assert kind_at(bow.session.active_view, 2) is SYMMETRIC
    view = bow.session.active_view
    middle = float(view.parameters[2] + view.parameters[3]) / 2
    bow.double_click(tuple(view.curve.evaluate(middle)))
    assert len(bow.curve.points) == len(BOW) + 1
    assert kind_at(bow.session.active_view, 2) is SMOOTH


# What becomes of the shape


def test_a_corner_made_smooth_turns_both_handles_and_keeps_the_lengths(bow):
    bow.select_point(2)
    bow.key(Key.Key_C, SHIFT)
    bow.drag_handle((4.6, 3.4), ahead=True)
    before, lengths = positions(bow), handle_lengths(bow, 2)
    bow.key(Key.Key_S, SHIFT)
    point = bow.curve.points[2]
    assert has_parallel_velocities(point)
    assert handle_lengths(bow, 2) == pytest.approx(lengths)
    # To the line from tip to tip, as in Inkscape: the longer handle turns less.
    across = np.subtract(before[1], before[0])
    assert angle_between(point.velocity, tuple(across)) < 1e-12


def test_a_symmetric_or_estimated_point_becomes_smooth_without_a_change_of_shape(bow):
    t = np.linspace(0, 1, 500)
    before = bow.session.active_view.curve.evaluate(t)
    points = bow.curve.points
    bow.select([1, 2, 3])
    bow.key(Key.Key_S, SHIFT)
    assert bow.session.active_view.curve.evaluate(t) == pytest.approx(before, abs=1e-13)
    # Nothing beside them had to be written down: the estimates go through.
    assert (bow.curve.points[0], bow.curve.points[4]) == (points[0], points[4])


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
def test_symmetric_handles_are_equally_long_on_the_screen(bow, family):
    """With one velocity they were as different as their segments: 1.4 to 1 here."""
    bow.choose_family(family)
    for kind in (ESTIMATED, CORNER, SMOOTH):
        bow.select_point(2)
        bow.key(KEYS[kind], SHIFT)
        if kind is not ESTIMATED:
            x, y = bow.handle(ahead=True).position
            bow.drag_handle((x + 0.2, y + 0.5), ahead=True)
        bow.key(Key.Key_Y, SHIFT)
        behind, ahead = positions(bow)
        pixel_map = bow.window.canvas.pixel_map
        lengths = [math.dist(pixel_map.point(*tip), pixel_map.point(*BOW[2])) for tip in (behind, ahead)]
        assert lengths[0] == pytest.approx(lengths[1], rel=1e-9)
        assert np.add(behind, ahead) / 2 == pytest.approx(BOW[2])
        assert kind_at(bow.session.active_view, 2) is SYMMETRIC
        # A drag, and points that move, leave them equally long.
        bow.drag_handle((ahead[0] + 0.3, ahead[1] - 0.2), ahead=True)
        assert np.add(*positions(bow)) / 2 == pytest.approx(BOW[2])
        bow.drag_point(3, to=(4.6, 1.2))
        bow.select_point(2)
        assert np.add(*positions(bow)) / 2 == pytest.approx(BOW[2])
        bow.drag_point(3, to=BOW[3])


def test_a_handle_that_lies_on_a_point_is_pulled_out(bow):
    bow.select_point(2)
    bow.key(Key.Key_C, SHIFT)
    curve = bow.curve
    resting = replace(curve.points[2], velocity=(0.0, 0.0))
    curve = replace(curve, points=(*curve.points[:2], resting, *curve.points[3:]))
    bow.session.commit(Document((curve,)), "Rest")
    bow.select([2])
    bow.key(Key.Key_S, SHIFT)
    assert has_parallel_velocities(bow.curve.points[2])
    assert handle_lengths(bow, 2)[0] == pytest.approx(math.dist(BOW[1], BOW[2]) / 3)


# Dragging handles


def test_the_other_handle_of_a_smooth_point_turns_and_keeps_the_length(bow):
    document = bow.session.document
    for family, ahead in product((HERMITE, QUINTIC_HERMITE), (False, True)):
        bow.session.commit(document, "Again")
        bow.choose_family(family)
        bow.select_point(2)
        bow.key(Key.Key_S, SHIFT)
        lengths, steps = handle_lengths(bow, 2), bow.session.undo_stack.count()
        x, y = bow.handle(ahead=ahead).position
        bow.drag_handle((x + 0.3, y + 0.6), ahead=ahead)
        point = bow.curve.points[2]
        assert has_parallel_velocities(point), (family, ahead)
        after = handle_lengths(bow, 2)
        assert after[not ahead] == pytest.approx(lengths[not ahead]), (family, ahead)
        assert after[ahead] != pytest.approx(lengths[ahead], rel=0.05), (family, ahead)
        assert bow.session.undo_stack.count() == steps + 1, (family, ahead)
        rows = {row.joint: row for row in certificate_of(bow.session.active_view).rows}
        assert rows[2].continuity[1] >= 1, (family, ahead)
        assert rows[2].smoothness.startswith("C⁰, G¹"), (family, ahead)


def test_the_other_handle_of_a_symmetric_point_is_the_mirror_image(bow):
    bow.choose_parametrization(ParametrizationKind.UNIFORM)
    bow.select_point(2)
    bow.key(Key.Key_Y, SHIFT)
    bow.drag_handle((3.9, 3.4), ahead=True)
    behind, ahead = positions(bow)
    assert np.add(behind, ahead) / 2 == pytest.approx(BOW[2])


@pytest.mark.parametrize("kind", [SMOOTH, SYMMETRIC, ESTIMATED], ids=lambda kind: kind.title)
def test_alt_separates_the_handles_only_while_the_key_is_pressed(bow, kind):
    bow.select_point(2)
    bow.key(KEYS[kind], SHIFT)
    document = bow.session.document
    behind, ahead = positions(bow)
    goal = (ahead[0] + 0.4, ahead[1] + 0.8)
    bow.press(ahead)
    bow.move(goal)
    assert kind_at(bow.session.active_view, 2) is not CORNER
    bow.move(goal, keys=ALT)
    assert kind_at(bow.session.active_view, 2) is CORNER
    assert "now a corner" in bow.status
    # The other handle is where it was before the drag.
    assert positions(bow)[0] == pytest.approx(behind)
    bow.move(goal)
    assert kind_at(bow.session.active_view, 2) is not CORNER
    assert positions(bow)[0] != pytest.approx(behind, abs=0.05)
    bow.move(goal, keys=ALT)
    bow.escape()
    bow.release(goal, keys=ALT)
    assert bow.session.document is document
    steps = bow.session.undo_stack.count()
    bow.drag(positions(bow)[1], goal, keys=ALT)
    assert kind_at(bow.session.active_view, 2) is CORNER
    assert positions(bow)[0] == pytest.approx(behind)
    assert bow.session.undo_stack.count() == steps + 1
    assert bow.session.undo_stack.undoText() == "Break handles of point 2"
    bow.trigger("undo")
    assert bow.session.document == document


def test_alt_separates_the_handles_under_a_resting_mouse(bow):
    bow.select_point(2)
    bow.key(Key.Key_S, SHIFT)
    ahead = positions(bow)[1]
    goal = (ahead[0] + 0.4, ahead[1] + 0.8)
    bow.press(ahead)
    bow.move(goal)
    QTest.keyPress(bow.window.canvas, Key.Key_Alt, ALT)
    bow.settle()
    assert kind_at(bow.session.active_view, 2) is CORNER
    QTest.keyRelease(bow.window.canvas, Key.Key_Alt)
    bow.settle()
    assert kind_at(bow.session.active_view, 2) is SMOOTH
    bow.release(goal)
    assert kind_at(bow.session.active_view, 2) is SMOOTH


def test_the_hint_to_break_handles_is_missing_at_a_corner(bow):
    hints = []
    bow.window.canvas.hint_changed.connect(hints.append)
    bow.select_point(2)
    for kind, breaks in ((CORNER, False), (SMOOTH, True)):
        bow.key(KEYS[kind], SHIFT)
        bow.hover((0.0, 2.0))
        bow.hover(positions(bow)[1])
        assert hints[-1].startswith("Drag to set the velocity of point 2, ahead")
        assert ("Alt: break the handles apart" in hints[-1]) is breaks


# The double click


def test_a_double_click_toggles_corner_and_smooth(bow):
    steps = bow.session.undo_stack.count()
    bow.double_click(bow.point(2))
    assert kind_at(bow.session.active_view, 2) is CORNER
    assert bow.session.undo_stack.undoText() == "Corner at point 2"
    assert bow.session.selection == {2}
    bow.double_click(bow.point(2))
    assert kind_at(bow.session.active_view, 2) is SMOOTH
    assert bow.session.undo_stack.undoText() == "Smooth point 2"
    assert bow.status.startswith("Smooth at point 2")
    assert bow.session.undo_stack.count() == steps + 2
    bow.trigger("undo")
    assert kind_at(bow.session.active_view, 2) is CORNER


def test_a_double_click_toggles_the_kind_only_of_inner_hermite_points(bow):
    document = bow.session.document
    bow.double_click(bow.point(0))
    assert bow.session.document is document
    assert bow.status == "Point 0 is an end of the curve; a corner needs a segment on both sides."
    # A point that is clicked twice and dragged is moved.
    bow.click(bow.point(2))
    bow.drag(bow.point(2), (3.0, 2.0))
    assert kind_at(bow.session.active_view, 2) is not CORNER
    bow.trigger("undo")
    bow.choose_family(LAGRANGE)
    document = bow.session.document
    bow.double_click(bow.point(2))
    assert bow.session.document is document
    bow.choose_family(HERMITE)
    bow.trigger("curveLocked")
    document = bow.session.document
    bow.double_click(bow.point(2))
    assert bow.session.document is document
    assert "is locked" in bow.status


# Lines


def straight(editor, segment):
    editor.select([segment, segment + 1])
    editor.key(Key.Key_4, ALT)
    assert is_straight(editor.curve, segment)


def test_a_smooth_point_beside_a_line_stays_tangent_during_every_drag(bow):
    straight(bow, 2)
    bow.select([2])
    bow.key(Key.Key_S, SHIFT)
    line = np.subtract(BOW[3], BOW[2])
    assert angle_between(bow.curve.points[2].velocity, tuple(line)) < 1e-12
    for index, to in ((3, (4.5, 2.0)), (2, (2.5, 2.0))):
        bow.press(bow.point(index))
        bow.move(to)
        # Live, not only when it is done.
        curve = bow.curve
        assert is_straight(curve, 2)
        assert has_parallel_velocities(curve.points[2])
        assert bow.session.is_previewing
        bow.release(to)
        assert is_straight(bow.curve, 2)
        assert bow.curve.points[2].tied
    bow.select_point(2)
    direction = bow.curve.points[2].velocity
    x, y = bow.handle(ahead=False).position
    bow.drag_handle((x - 0.5, y - 1.0), ahead=False)
    point = bow.curve.points[2]
    assert angle_between(point.velocity, direction) < 1e-12
    assert is_straight(bow.curve, 2)
    (row,) = (row for row in certificate_of(bow.session.active_view).rows if row.joint == 2)
    assert row.continuity[1] >= 1


@pytest.mark.parametrize("kind", [ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM])
def test_a_point_inserted_on_a_line_makes_two_lines(bow, kind):
    bow.choose_parametrization(kind)
    straight(bow, 2)
    view = bow.session.active_view
    place = tuple(view.curve.evaluate(float(view.parameters[2:4].mean())))
    bow.trigger("addTool")
    bow.click(place)
    bow.trigger("selectTool")
    assert [is_straight(bow.curve, segment) for segment in range(5)] == [False, False, True, True, False]
    bow.drag_point(3, (4.2, 2.4))
    assert [is_straight(bow.curve, segment) for segment in range(5)] == [False, False, True, True, False]


@pytest.mark.parametrize("segment", [1, 3])
def test_a_bend_beside_a_line_follows_the_mouse_and_leaves_the_line(bow, segment):
    straight(bow, 2)
    bow.select([2, 3])
    bow.key(Key.Key_S, SHIFT)
    # Between one line a point is tangent to it; here both ends of the line are.
    assert [point.tied for point in bow.curve.points] == [False, False, True, True, False]
    view = bow.session.active_view
    t = float(view.parameters[segment : segment + 2].mean())
    x, y = view.curve.evaluate(t)
    goal = (x + 0.2, y + 0.4)
    bow.select([])
    bow.bend(t, goal)
    after = bow.session.active_view
    share = 0.5 * (after.parameters[segment] + after.parameters[segment + 1])
    assert after.curve.evaluate(share) == pytest.approx(goal, abs=2 * bow.pixel)
    assert is_straight(bow.curve, 2)
    assert has_parallel_velocities(bow.curve.points[2])
    assert has_parallel_velocities(bow.curve.points[3])


def test_a_smooth_point_stays_smooth_when_an_adjacent_segment_is_made_straight(bow):
    bow.select([2])
    bow.key(Key.Key_S, SHIFT)
    straight(bow, 2)
    assert bow.curve.points[2].tied
    # The estimated tangent of point 3 is in line but for a degree.
    assert bow.status.startswith("Straight segment 2–3, tangent at points 2 and 3.")
    straight(bow, 1)
    # Between two lines of different directions there is a corner.
    assert not bow.curve.points[2].tied
    assert is_straight(bow.curve, 2)


# The pen


def test_the_pen_breaks_the_handle_ahead_with_alt(bow):
    bow.wheel((3.0, 1.0), -4)
    bow.trigger("newCurve")
    bow.choose_family(HERMITE)
    bow.trigger("addTool")
    bow.click((0.0, 4.0))
    bow.press((2.0, 4.0))
    bow.move((2.5, 4.5))
    assert "Alt: only the handle ahead" in bow.status
    behind = bow.curve.points[1].velocity
    bow.move((2.5, 3.2), keys=ALT)
    assert "a corner" in bow.status
    point = bow.curve.points[1]
    assert (point.corner, point.velocity) == (True, behind)
    assert point.velocity_after[1] < 0 < point.velocity[1]
    bow.release((2.5, 3.2), keys=ALT)
    # What was drawn stays when the curve goes on: the handle ahead under the pointer, too.
    before = bow.session.active_view
    reach = [np.array(before.velocity_of(1, ahead=False)) * before.spacing(1, ahead=False)]
    bow.click((5.0, 4.0))
    view = bow.session.active_view
    assert np.array(view.velocity_of(1, ahead=False)) * view.spacing(1, ahead=False) == pytest.approx(
        reach[0]
    )
    bow.select([1])
    assert bow.handle(ahead=True).position == pytest.approx((2.5, 3.2), abs=3 * bow.pixel)
    bow.trigger("undo")
    bow.trigger("undo")
    assert len(bow.curve.points) == 1


def test_a_corner_of_the_pen_is_undone_with_the_point(bow):
    bow.wheel((3.0, 1.0), -4)
    document = bow.session.document
    bow.trigger("addTool")
    bow.press((7.0, 3.0), keys=ALT)
    bow.move((7.5, 3.5), keys=ALT)
    # From the press on: a straight line leads here, and only the handle ahead follows the mouse.
    point = bow.curve.points[5]
    assert point.corner
    assert is_straight(bow.curve, 4)
    assert angle_between(point.velocity_after, (0.5, 0.5)) < 0.2
    bow.escape()
    bow.release((7.5, 3.5))
    assert bow.session.document is document


# Marks


def test_the_marks_of_kinds_differ_without_colour(bow, qtbot):
    canvas = bow.window.canvas
    looks = {}
    for kind in POINT_KINDS:
        bow.select([2])
        bow.trigger(kind.action)
        for selected in (False, True):
            bow.select([2] if selected else [])
            bow.hover((5.0, 2.5))
            centre = QPointF(canvas.viewport().mapTo(bow.window, canvas.to_pixel(*bow.point(2))))
            shot = bow.screenshot()
            grey = np.array(
                [
                    [
                        shot.pixelColor(
                            round((centre.x() + x) * shot.devicePixelRatio()),
                            round((centre.y() + y) * shot.devicePixelRatio()),
                        ).lightness()
                        for x in range(-8, 9)
                    ]
                    for y in range(-8, 9)
                ]
            )
            looks[kind.name, selected] = grey
    for selected in (False, True):
        shown = [looks[kind.name, selected] for kind in POINT_KINDS]
        for place, one in enumerate(shown):
            for other in shown[place + 1 :]:
                assert (np.abs(one - other) > 40).sum() >= 4


def test_the_table_names_the_kinds(bow):
    bow.select([1])
    bow.trigger("tangentCorner")
    bow.select([2])
    bow.trigger("tangentSmooth")
    model = bow.window.point_table.model()

    def header(row, role):
        return model.headerData(row, Qt.Orientation.Vertical, role)

    tips = [header(row, Qt.ItemDataRole.ToolTipRole) for row in range(4)]
    assert [", a corner" in tip for tip in tips] == [False, True, False, False]
    assert [", smooth" in tip for tip in tips] == [False, False, True, False]
    tip = model.data(model.index(2, 3), Qt.ItemDataRole.ToolTipRole)
    # A point that has just become smooth has one velocity.
    assert "before the point" not in tip
    bow.drag_handle((3.2, 0.6), index=2)
    tip = model.data(model.index(2, 3), Qt.ItemDataRole.ToolTipRole)
    assert "before the point" in tip
    # A number that is typed turns what is tied.
    model.setData(model.index(2, 4), 40.0)
    bow.settle()
    assert bow.curve.points[2].velocity[1] == 40.0
    assert has_parallel_velocities(bow.curve.points[2])


# Round trips


def test_files_and_both_clipboards_keep_a_tie(bow):
    bow.select_point(2)
    bow.key(Key.Key_S, SHIFT)
    x, y = bow.handle(ahead=True).position
    bow.drag_handle((x + 0.3, y + 0.6), ahead=True)
    tied = bow.curve.points[2]
    assert decode(encode(bow.session.document)) == bow.session.document
    bow.trigger("copyDerivatives")
    bow.select([1])
    bow.trigger("pasteDerivatives")
    assert bow.curve.points[1].tied
    assert bow.curve.points[1].velocity == pytest.approx(tied.velocity)
    bow.select([1, 2, 3])
    bow.trigger("copyPoints")
    bow.trigger("pasteAsCurve")
    assert [point.tied for point in bow.curve.points] == [True, True, False]


def test_a_table_of_points_keeps_a_tie(bow, tmp_path):
    bow.select_point(2)
    bow.key(Key.Key_S, SHIFT)
    bow.drag_handle((4.2, 3.4), ahead=True)
    bow.select([3])
    bow.key(Key.Key_C, SHIFT)
    bow.drag_handle((4.8, 1.6), ahead=True)
    export(bow.session.document, tmp_path / "bow.points.csv")
    (back,) = import_file(tmp_path / "bow.points.csv").document.curves
    assert [(point.corner, point.tied) for point in back.points][1:4] == [
        (False, False), (True, True), (True, False)
    ]  # fmt: skip
    assert has_parallel_velocities(back.points[2])


@pytest.mark.parametrize("name", ["reverseCurve", "freezeParameters", "closeCurve"])
def test_changes_of_the_whole_curve_keep_ties(bow, name):
    bow.select_point(2)
    bow.key(Key.Key_S, SHIFT)
    bow.drag_handle((4.2, 3.4), ahead=True)
    bow.trigger(name)
    assert [point.tied for point in bow.curve.points] == [False, False, True, False, False]
    assert has_parallel_velocities(bow.curve.points[2])


def test_insertion_conversion_splitting_and_joining_keep_ties(bow):
    bow.select_point(2)
    bow.key(Key.Key_S, SHIFT)
    bow.drag_handle((4.2, 3.4), ahead=True)
    place = tuple(bow.session.active_view.curve.evaluate(0.25))
    bow.trigger("addTool")
    bow.click(place)
    bow.trigger("selectTool")
    assert [point.tied for point in bow.curve.points] == [False, False, False, True, False, False]
    assert has_parallel_velocities(bow.curve.points[3])
    before = bow.curve
    bow.select([3])
    bow.trigger("splitCurve")
    assert len(bow.session.document.curves) == 2
    bow.session.selected.activate(0)
    bow.trigger("joinCurve")
    (joined,) = bow.session.document.curves
    assert [point.tied for point in joined.points] == [point.tied for point in before.points]
