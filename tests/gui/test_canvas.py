"""Points and handles on the canvas, with real mouse and key events."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
import pytest
from event_count import paints_of
from PySide6.QtCore import QEvent, QPoint, Qt

from app.document.model import Document, ParametrizationKind, make_curve
from app.document.transforms import round_step_above
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE, titles
from app.view_model.curve.handles import handles_of

SHIFT = Qt.KeyboardModifier.ShiftModifier
ALT = Qt.KeyboardModifier.AltModifier


@pytest.fixture
def arch(editor):
    """Four points of an arch, the last one selected, in the view of an empty document."""
    editor.new()
    editor.trigger("selectTool")
    curve = make_curve(((0, 0), (1, 2), (3, 2), (4, 0)), name=editor.curve.name)
    editor.session.commit(Document((curve,)), "Begin")
    editor.select([3])
    return editor


def test_a_click_with_the_add_tool_appends_a_point(editor):
    editor.new()
    editor.add_point(1, 2)
    editor.add_point(3, 1)
    assert editor.point(0) == pytest.approx((1, 2), abs=editor.pixel)
    assert editor.point(1) == pytest.approx((3, 1), abs=editor.pixel)
    assert editor.session.undo_stack.undoText() == "Add point 1"


def test_the_add_tool_draws_many_points_in_a_row_even_by_double_clicks(editor):
    editor.new()
    for x in range(4):
        pixel = editor.window.canvas.to_pixel(x, 1)
        for kind in (QEvent.Type.MouseButtonDblClick, QEvent.Type.MouseButtonRelease):
            editor.send(editor.window.canvas, kind, pixel, held=kind != QEvent.Type.MouseButtonRelease)
    assert len(editor.curve.points) == 4


def test_a_step_is_painted_once_under_a_pointer_that_rests(arch):
    """What lies under the pointer was found after the paint, and both plots were painted twice."""
    arch.drag_point(1, (1, 2.5))
    arch.wait_for_rest()
    counts = [paints_of(plot.viewport()) for plot in (arch.window.canvas, arch.window.basis_panel)]
    assert arch.session.selected.hovered == 1
    arch.trigger("undo")
    assert arch.session.selected.hovered == -1
    assert [each.count for each in counts] == [1, 1]


def test_a_drag_repaints_the_curve_and_neither_axes_nor_grid(arch, monkeypatch):
    """Through the graphics view, with all its items, a frame took half as long again."""
    canvas, of_all = arch.window.canvas, pg.GraphicsView.paintEvent
    painted: list[str] = []

    def paint_all(view, event):
        painted.append("all")
        of_all(view, event)

    def paint_area():
        painted.append("area")

    arch.wait_for_rest()
    monkeypatch.setattr(pg.GraphicsView, "paintEvent", paint_all)
    ground = canvas.layers._ground
    canvas.painted.connect(paint_area)
    arch.press(arch.point(1))
    for step in range(1, 4):
        arch.move((1, 2 + 0.2 * step))
    assert painted.count("area") >= 3
    assert canvas.layers._ground is ground
    arch.release((1, 2.6))
    canvas.camera.pan(10, 0)
    arch.settle()
    canvas.painted.disconnect(paint_area)
    assert canvas.layers._ground is not ground
    assert "all" not in painted


def test_press_and_drag_sets_the_velocity_of_a_new_point(editor):
    editor.new()
    editor.choose_family(HERMITE)
    editor.add_point(0, 0)
    editor.add_point(2, 2, velocity_handle=(3, 2))
    # The interval is [0, 1] and there is one segment: the handle lies at p + v/3.
    assert editor.curve.points[1].velocity == pytest.approx((3, 0), abs=6 * editor.pixel)
    assert editor.curve.points[0].velocity is None


def test_the_handle_of_a_new_point_is_under_the_pointer(editor):
    editor.new()
    editor.choose_family(HERMITE)
    editor.add_point(0, 0)
    editor.trigger("addTool")
    editor.press((2, 2))
    editor.move((3, 3))
    assert editor.handle(ahead=True).position == pytest.approx((3, 3), abs=2 * editor.pixel)
    editor.release((3, 3))


def test_handles_stay_when_a_point_is_appended(editor):
    editor.new()
    editor.choose_family(HERMITE)
    editor.add_point(0, 0)
    editor.add_point(2, 2, velocity_handle=(3, 2))
    (behind,) = (each.position for each in handles_of(editor.session.active_view, 1))
    editor.add_point(4, 0)
    (handle,) = (each.position for each in handles_of(editor.session.active_view, 1) if not each.ahead)
    assert handle == pytest.approx(behind, rel=1e-12)


def test_a_click_on_the_curve_inserts_between_the_neighbours(arch):
    x, y = arch.session.active_view.curve.evaluate(0.5)
    arch.add_point(x, y)
    assert len(arch.curve.points) == 5
    assert arch.point(2) == pytest.approx((x, y), abs=arch.pixel)
    assert arch.session.undo_stack.undoText() == "Insert point 2"


def test_dragging_moves_the_point_as_one_step(arch):
    steps = arch.session.undo_stack.count()
    arch.drag_point(1, to=(1.5, 3))
    assert arch.point(1) == pytest.approx((1.5, 3), abs=arch.pixel)
    assert arch.session.undo_stack.count() == steps + 1
    assert arch.session.undo_stack.undoText() == "Move point 1"
    arch.trigger("undo")
    assert arch.point(1) == pytest.approx((1, 2), abs=arch.pixel)


def test_the_curve_follows_while_the_button_is_down(arch):
    arch.press(arch.point(1))
    arch.move((1.5, 3))
    assert arch.session.active_view.points[1] == pytest.approx((1.5, 3), abs=arch.pixel)
    assert arch.session.undo_stack.undoText() != "Move point 1"
    arch.release((1.5, 3))


def test_shift_keeps_to_one_axis(arch):
    x, y = arch.point(1)
    arch.drag_point(1, to=(2, 2.3), keys=SHIFT)
    assert arch.point(1)[0] == pytest.approx(2, abs=2 * arch.pixel)
    assert arch.point(1)[1] == y
    arch.drag_point(1, to=(2.1, 3.5), keys=SHIFT)
    assert arch.point(1)[1] == pytest.approx(3.5, abs=2 * arch.pixel)
    assert x != arch.point(1)[0]


def test_escape_cancels_a_drag_completely(arch):
    document, steps = arch.session.document, arch.session.undo_stack.count()
    arch.press(arch.point(1))
    arch.move((2, 4))
    assert arch.session.document != document
    arch.escape()
    assert arch.session.document is document
    assert arch.session.undo_stack.count() == steps
    arch.move((3, 4))
    arch.release((3, 4))
    assert arch.session.document is document


def test_undo_during_a_drag_cancels_only_the_drag(arch):
    document = arch.session.document
    arch.press(arch.point(1))
    arch.move((2, 4))
    arch.trigger("undo")
    assert arch.session.document is document
    arch.release((2, 4))
    assert arch.session.document is document


def test_a_press_that_moves_two_pixels_is_a_click(arch):
    document = arch.session.document
    canvas = arch.window.canvas
    start = canvas.to_pixel(*arch.point(1))
    arch.drag_pixels(canvas, start, start + QPoint(2, 0))
    assert arch.session.document is document
    assert arch.session.selection == {1}


def test_a_press_ten_pixels_beside_a_point_grabs_the_point(arch):
    canvas = arch.window.canvas
    start = canvas.to_pixel(*arch.point(1)) + QPoint(-6, -7)
    arch.drag_pixels(canvas, start, start + QPoint(40, 0))
    assert arch.point(1) == pytest.approx((1 + 40 * arch.pixel, 2), abs=1.5 * arch.pixel)


def test_a_selected_point_is_hit_before_a_point_on_top(arch):
    arch.drag_point(2, to=arch.point(1))
    arch.select([1])
    arch.drag(arch.point(2), (0.5, 3))
    assert arch.point(1) == pytest.approx((0.5, 3), abs=2 * arch.pixel)


def test_a_drag_survives_leaving_the_canvas(arch):
    canvas = arch.window.canvas
    start = canvas.to_pixel(*arch.point(1))
    far = QPoint(-300, -200)
    x, y = canvas.to_plane(far)
    arch.drag_pixels(canvas, start, far)
    assert arch.point(1) == pytest.approx((x, y), abs=2 * arch.pixel)


def test_a_click_on_empty_space_deselects(arch):
    arch.select_point(1)
    assert arch.session.selection == {1}
    arch.click((2, 0.2))
    assert arch.session.selection == frozenset()


@pytest.mark.parametrize("key", [Qt.Key.Key_Delete, Qt.Key.Key_Backspace])
def test_delete_removes_the_selected_point(arch, key):
    arch.select_point(1)
    arch.key(key)
    assert len(arch.curve.points) == 3
    assert arch.session.undo_stack.undoText() == "Delete point 1"
    assert arch.session.selection == frozenset()


def test_dragging_a_velocity_handle_sets_the_velocity(arch):
    arch.choose_family(HERMITE)
    arch.select_point(1)
    h = arch.parameters[2] - arch.parameters[1]
    arch.drag_handle(to=(2, 3))
    expected = ((2 - 1) * 3 / h, (3 - 2) * 3 / h)
    assert arch.curve.points[1].velocity == pytest.approx(expected, abs=6 / h * arch.pixel)
    assert arch.session.undo_stack.undoText() == "Set velocity of point 1"
    tip = arch.handle().position
    assert tip == pytest.approx((2, 3), abs=2 * arch.pixel)


def test_dragging_an_acceleration_handle_sets_the_acceleration(arch):
    arch.choose_family(QUINTIC_HERMITE)
    arch.select_point(1)
    arch.drag_handle(to=(3, 3.3), kind=2)
    assert arch.handle(2).position == pytest.approx((3, 3.3), abs=2 * arch.pixel)
    assert arch.curve.points[1].acceleration is not None
    assert arch.curve.points[1].velocity is None
    assert arch.session.undo_stack.undoText() == "Set acceleration of point 1"


@pytest.mark.parametrize("ahead", [True, False])
def test_dragging_a_jerk_handle_sets_the_jerk(arch, ahead):
    arch.choose_family("septic_hermite")
    arch.select_point(1)
    before = arch.session.active_view
    others = [arch.handle(kind, ahead=ahead).position for kind in (1, 2)]
    x, y = arch.handle(3, ahead=ahead).position
    arch.drag_handle((x + 0.4, y + 0.3), kind=3, ahead=ahead)
    assert arch.handle(3, ahead=ahead).position == pytest.approx((x + 0.4, y + 0.3), abs=2 * arch.pixel)
    point = arch.curve.points[1]
    assert (point.velocity, point.acceleration) == (None, None)
    assert arch.session.undo_stack.undoText() == "Set jerk of point 1"
    # h**3 j / 210: the third control point goes as the pointer goes, those before it stay.
    h = before.spacing(1, ahead=ahead) * (1 if ahead else -1)
    moved = np.subtract(point.jerk, before.derivative_of(1, 3)) * h**3 / 210
    assert moved == pytest.approx((0.4, 0.3), abs=2 * arch.pixel)
    assert [arch.handle(kind, ahead=ahead).position for kind in (1, 2)] == others
    control = arch.session.active_view.curve.bezier_pieces()[1 if ahead else 0, 3 if ahead else 4]
    assert arch.handle(3, ahead=ahead).position == pytest.approx(control.tolist(), abs=1e-12)
    arch.trigger("undo")
    assert arch.curve.points[1].jerk is None


def test_each_kind_of_handle_is_hit_and_its_drag_cancelled(arch):
    arch.choose_family("septic_hermite")
    arch.select_point(1)
    document = arch.session.document
    for kind, name in enumerate(("velocity", "acceleration", "jerk"), start=1):
        arch.press(arch.handle(kind).position)
        arch.move((3, 4))
        assert arch.session.document.curves[0].points[1] != document.curves[0].points[1]
        assert arch.status.startswith(f"{name.capitalize()} of point 1: ")
        arch.escape()
        assert arch.session.document is document
        arch.release((3, 4))


def test_several_points_show_velocities_and_a_single_point_all_derivatives(arch):
    arch.choose_family("septic_hermite")
    arch.select_point(1)
    assert len(arch.window.canvas.drawing.points.handles) == 6
    arch.select([0, 1])
    shown = [(each.index, each.ahead, each.order) for each in arch.window.canvas.drawing.points.handles]
    assert shown == [(0, True, 1), (1, True, 1), (1, False, 1)]
    arch.select([])
    assert len(arch.window.canvas.drawing.points.handles) == 0


def test_a_handle_drag_can_be_cancelled(arch):
    arch.choose_family(HERMITE)
    arch.select_point(1)
    document = arch.session.document
    start = arch.handle().position
    arch.press(start)
    arch.move((3, 4))
    assert arch.session.document != document
    arch.escape()
    assert arch.session.document is document


def test_alt_drag_pulls_out_a_velocity_hidden_under_its_point(arch):
    arch.choose_family(HERMITE)
    arch.session.commit(_with_velocity(arch, 1, (0.0, 0.0)), "Stop")
    arch.drag_point(1, to=(2, 3), keys=ALT)
    assert arch.handle().position == pytest.approx((2, 3), abs=2 * arch.pixel)
    assert arch.point(1) == pytest.approx((1, 2), abs=arch.pixel)


def _with_velocity(editor, index, velocity):
    from app.document.point_edits import set_velocity

    return set_velocity(editor.session.document, 0, index, velocity)


def test_the_wheel_zooms_at_the_pointer(arch):
    canvas = arch.window.canvas
    place = canvas.to_pixel(3, 1)
    before = canvas.to_plane(place)
    scale = canvas.pixel_map.sx
    arch.wheel((3, 1), 3)
    assert canvas.pixel_map.sx == pytest.approx(scale * 1.2**3)
    assert canvas.to_plane(place) == pytest.approx(before, abs=1e-9)


def test_zooming_out_for_ever_stops_at_a_limit(arch):
    for _ in range(60):
        arch.wheel((1, 1), 10)
    for _ in range(120):
        arch.wheel((1, 1), -10)
    x_min, y_min, x_max, y_max = arch.window.canvas.pixel_map.box
    assert np.isfinite([x_min, y_min, x_max, y_max]).all()
    arch.fit()
    assert arch.window.canvas.pixel_map.sx > 10


def test_middle_button_and_space_pan(arch):
    canvas = arch.window.canvas
    document = arch.session.document
    start = canvas.to_pixel(1, 1)
    arch.drag_pixels(canvas, start, start + QPoint(60, 30), button=Qt.MouseButton.MiddleButton)
    assert canvas.to_pixel(1, 1) == start + QPoint(60, 30)
    arch.hold_space()
    arch.drag_pixels(canvas, start + QPoint(60, 30), start)
    arch.release_space()
    assert canvas.to_pixel(1, 1) == start
    assert arch.session.document is document


def test_equal_aspect_holds_after_every_resize(arch):
    for size in ((1280, 860), (700, 900), (1600, 700)):
        arch.window.resize(*size)
        arch.settle()
        shown = arch.window.canvas.pixel_map
        assert shown.sx == pytest.approx(shown.sy, rel=1e-6)


def test_to_pixel_and_to_plane_are_inverse(arch):
    canvas = arch.window.canvas
    for point in ((0, 0), (1.5, 2.5), (-3, 4)):
        assert canvas.to_plane(canvas.to_pixel(*point)) == pytest.approx(point, abs=arch.pixel)


def test_the_hint_describes_the_effect_of_a_press(arch):
    arch.hover(arch.point(2))
    assert "Drag to move point 2" in arch.window.status_line.hint
    assert arch.session.selected.hovered == 2
    arch.hover((2, 0.3))
    assert arch.session.selected.hovered == -1


def test_the_hovered_point_follows_the_view(arch):
    """It used to stay: after F the point that had been under the pointer was still large."""
    arch.hover(arch.point(2))
    arch.wheel((0, 0), 3)
    arch.hover(arch.point(2))
    assert arch.session.selected.hovered == 2
    arch.window.canvas.camera.pan(150, 0)
    arch.settle()
    assert arch.session.selected.hovered == -1


def test_an_end_has_a_handle_on_its_free_side_only_while_points_are_added(arch):
    arch.choose_family(HERMITE)
    arch.select_point(3)
    assert [handle.ahead for handle in arch.window.canvas.drawing.points.handles] == [False]
    arch.trigger("addTool")
    assert {handle.ahead for handle in arch.window.canvas.drawing.points.handles} == {True, False}
    arch.trigger("selectTool")


def test_coincident_points_are_explained_and_the_last_good_curve_stays(arch):
    before = arch.session.active_view.curve
    arch.drag_point(2, to=arch.point(1))
    # Where the mouse let go is a pixel away at most; put it exactly there.
    from app.document.point_edits import set_position

    arch.session.commit(set_position(arch.session.document, 0, 2, arch.point(1)), "Meet")
    arch.settle()
    assert "1 and 2 coincide" in arch.message
    assert arch.session.active_view.curve is not None
    assert arch.session.active_view.curve is not before
    arch.choose_parametrization(ParametrizationKind.UNIFORM)
    assert arch.message == ""
    assert arch.session.active_view.is_current


def test_tab_walks_the_points_and_arrows_nudge(arch):
    arch.select([])
    arch.key(Qt.Key.Key_Tab)
    assert arch.session.selection == {0}
    arch.key(Qt.Key.Key_Tab)
    assert arch.session.selection == {1}
    arch.key(Qt.Key.Key_Backtab, SHIFT)
    assert arch.session.selection == {0}
    (x, y), step = arch.point(0), round_step_above(2 * arch.pixel)
    arch.key(Qt.Key.Key_Right)
    arch.key(Qt.Key.Key_Up, SHIFT)
    assert arch.point(0) == pytest.approx((x + step, y + 10 * step), rel=1e-12)
    assert arch.session.undo_stack.undoText() == "Nudge point 0"


def test_an_enormous_curve_neither_crashes_nor_draws_nonsense(editor):
    from app.document.model import Document, make_curve

    points = [(float(i), (-1.0) ** i * 1e12) for i in range(30)]
    editor.session.commit(Document((make_curve(points),)), "Go wild")
    editor.settle()
    editor.fit()
    image = editor.screenshot()
    assert not image.isNull()


def test_subnormal_coordinates_reach_neither_pyqtgraph_nor_a_crash(editor):
    from app.document.model import Document, make_curve

    points = [(0.0, 0.0), (5e-324, 1e-323), (1e-323, 0.0)]
    editor.session.commit(Document((make_curve(points),)), "Shrink")
    editor.fit()
    assert not editor.screenshot().isNull()


# Closing with the pen


@pytest.mark.parametrize("family", [family for family in FAMILIES if family.derivatives])
def test_the_pen_closes_the_curve_at_its_first_point(arch, family):
    arch.choose_family(family)
    arch.trigger("addTool")
    # One that the pen is drawing: at the first point of any other it goes on.
    arch.click((5, 1))
    arch.trigger("closeCurve")
    expected = arch.session.document
    arch.trigger("undo")
    before, steps = arch.session.document, arch.session.undo_stack.count()
    arch.hover(arch.point(0))
    assert arch.window.status_line.hint.startswith("Click to close the curve")
    assert arch.window.canvas.viewport().cursor().shape() == Qt.CursorShape.PointingHandCursor
    arch.click(arch.point(0))
    assert arch.session.document == expected
    assert arch.session.undo_stack.count() == steps
    assert arch.session.undo_stack.undoText() == f"Close {arch.curve.name}"
    assert arch.action("closeCurve").isChecked()
    arch.hover(arch.point(0))
    assert "close" not in arch.window.status_line.hint
    arch.trigger("undo")
    assert arch.session.document == before


def test_the_pen_explains_why_a_polynomial_cannot_be_closed(arch):
    arch.choose_family(LAGRANGE)
    arch.trigger("addTool")
    arch.click((5, 1))
    before = arch.session.document
    arch.click(arch.point(0))
    assert arch.session.document == before
    closing = titles(family for family in FAMILIES if family.curve_class.can_close)
    assert arch.status.startswith(f"To close the curve, choose {closing}")


def test_the_pen_pulls_a_handle_out_of_the_first_point_and_continues_there(arch):
    arch.choose_family(HERMITE)
    arch.trigger("addTool")
    arch.press(arch.point(0))
    arch.move((1, 0.5))
    arch.key(Qt.Key.Key_Escape)
    arch.release((1, 0.5))
    assert not arch.curve.is_closed
    assert arch.point(0) == pytest.approx((0, 0), abs=2 * arch.pixel)
    first = arch.point(0)
    arch.drag(first, (0, 1))
    assert not arch.curve.is_closed
    assert arch.point(3) == first
    arch.click((5, 1))
    assert len(arch.curve.points) == 5
    assert arch.point(3) == first
    assert not arch.curve.is_closed


def test_a_curve_of_two_points_cannot_be_closed(editor):
    editor.new()
    editor.choose_family("cubic_spline")
    for point in ((0, 0), (2, 1)):
        editor.add_point(*point)
    editor.trigger("addTool")
    editor.hover(editor.point(0))
    assert "close" not in editor.window.status_line.hint
    editor.click(editor.point(0))
    assert not editor.curve.is_closed


def test_small_curves_at_the_edge_of_a_large_drawing_have_its_margin(editor):
    small = make_curve([(0, 0), (1, 1)], name="Small")
    large = make_curve([(0, -180), (90, -20), (180, -180)], name="Large")
    editor.session.commit(Document((small, large)), "Begin")
    editor.fit()
    canvas = editor.window.canvas
    assert canvas.to_pixel(1, 1).y() > 0.05 * canvas.viewport().height()
