"""Curves beside their points, by hand: drag, insert with the shape kept, the t-rail, split, convert."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QMenu, QWidget

from app.appearance.theme import theme_of
from app.document.model import Document, make_curve
from app.families import FAMILIES

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))
NAMES = ("bezier", "b_spline")


@pytest.fixture(params=NAMES)
def name(request):
    return request.param


@pytest.fixture
def drawn(editor):
    def draw(name, points=POINTS):
        curve = make_curve(points, family=FAMILIES.named(name))
        editor.session.commit(Document((curve,)), "Draw")
        editor.settle()
        editor.fit()
        return editor

    return draw


def curve_of(editor):
    assert editor.session.active_view.is_current
    return editor.session.active_view.curve


def shape(editor):
    return curve_of(editor).evaluate(np.linspace(0.0, 1.0, 501))


def position_at(editor, t):
    return tuple(curve_of(editor).evaluate(t).tolist())


def test_a_control_point_is_dragged_by_its_disc(drawn, name):
    """It lies beside the curve, which answers by the weight of the point."""
    editor = drawn(name)
    weight = float(curve_of(editor).basis(np.array([0.4]))[0, 2, 0])
    before, start = shape(editor), np.array(position_at(editor, 0.4))
    assert np.hypot(*(before - POINTS[2]).T).min() > 30 * editor.pixel
    editor.drag_point(2, (2.5, 2.0))
    assert editor.point(2) == pytest.approx((2.5, 2.0), abs=2 * editor.pixel)
    assert editor.session.undo_stack.undoText() == "Move point 2"
    if name == "bezier":
        way = np.array(editor.point(2)) - POINTS[2]
        assert np.array(position_at(editor, 0.4)) - start == pytest.approx(weight * way, abs=1e-12)


def test_only_the_active_curve_has_a_control_polygon(drawn, name):
    editor = drawn(name)
    canvas = editor.window.canvas

    def is_line_at(x, y):
        image = canvas.grab().toImage()
        pixel = canvas.viewport().mapTo(canvas, canvas.to_pixel(x, y))
        handle, paper = (getattr(theme_of(canvas.palette()), each) for each in ("handle", "paper"))
        near = [image.pixelColor(pixel.x() + dx, pixel.y() + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        far = abs(paper.lightness() - handle.lightness())
        return any(abs(each.lightness() - paper.lightness()) > 0.5 * far for each in near)

    shown = [is_line_at(*np.mean([p, q], axis=0).tolist()) for p, q in pairwise(POINTS)]
    assert all(shown)
    editor.choose_family("hermite")
    shown = [is_line_at(*np.mean([p, q], axis=0).tolist()) for p, q in pairwise(POINTS)]
    assert not all(shown)


@pytest.mark.parametrize("t", [0.2, 0.55, 0.9])
def test_a_click_on_the_curve_adds_a_control_point_and_keeps_the_shape(drawn, name, t):
    editor = drawn(name)
    before = shape(editor)
    editor.trigger("addTool")
    editor.click(position_at(editor, t))
    assert len(editor.curve.points) == 7
    assert np.abs(shape(editor) - before).max() < 1e-14
    assert "Shape kept" in editor.message + editor.status
    assert editor.curve.is_manual is (name == "b_spline")
    assert ("The parameters are now manual." in editor.message + editor.status) is (name == "b_spline")
    (chosen,) = editor.session.selection
    reach = np.abs(curve_of(editor).nodes - t)
    assert reach[chosen] <= reach.min() + 0.02  # the click is a pixel or two beside t
    editor.trigger("undo")
    assert [point.position for point in editor.curve.points] == list(POINTS)


def test_an_inserted_point_follows_the_pointer(drawn, name):
    editor = drawn(name)
    editor.trigger("addTool")
    x, y = position_at(editor, 0.5)
    editor.press((x, y))
    on_curve = editor.session.active_view
    index = int(np.argmin(np.abs(on_curve.curve.nodes - 0.5)))
    start = on_curve.points[index]
    editor.move((x + 0.3, y + 0.4))
    editor.release((x + 0.3, y + 0.4))
    moved = np.array(editor.point(index)) - start
    assert moved == pytest.approx((0.3, 0.4), abs=4 * editor.pixel)


def test_a_point_can_be_inserted_at_the_scrub_line(drawn, name):
    editor = drawn(name)
    before = shape(editor)
    editor.scrub(0.5)
    editor.trigger("insertPoint")
    assert len(editor.curve.points) == 7
    assert np.abs(shape(editor) - before).max() < 1e-14


def test_ticks_without_effect_have_a_hint(drawn, name):
    editor = drawn(name)
    panel = editor.window.basis_panel
    before = shape(editor)
    editor.send(panel, QEvent.Type.MouseMove, panel.rail_pixel(editor.parameters[1]), held=False)
    assert "does not affect the curve" in editor.status
    assert "Hollow tick" in editor.status
    # Nothing that the pointer says could be dragged, unless E takes others along.
    assert panel.viewport().cursor().shape() == Qt.CursorShape.ArrowCursor
    panel.setFocus()
    QTest.keyPress(panel, Qt.Key.Key_E)
    assert panel.viewport().cursor().shape() == Qt.CursorShape.SizeHorCursor
    QTest.keyRelease(panel, Qt.Key.Key_E)
    knot = panel.rail_pixel(editor.parameters[2 if name == "b_spline" else 5])
    editor.send(panel, QEvent.Type.MouseMove, knot, held=False)
    assert panel.viewport().cursor().shape() == Qt.CursorShape.SizeHorCursor
    document, steps = editor.session.document, editor.session.undo_stack.count()
    # It used to be a step of the history that changed nothing.
    editor.drag_parameter(1, editor.parameters[1] + 0.02)
    assert np.array_equal(shape(editor), before)
    assert editor.session.document is document
    editor.rail.click(1)
    panel.setFocus()
    QTest.keyClick(panel, Qt.Key.Key_Right)
    assert editor.session.undo_stack.count() == steps
    assert editor.session.document is document
    editor.drag_parameter(2, editor.parameters[2] + 0.05)
    moved = np.abs(shape(editor) - before).max()
    # The inner parameters of a Bézier curve do nothing; t₂ is the first knot of the other.
    assert bool(moved > 1e-3) is (name == "b_spline")
    assert curve_of(editor).breaks.tolist() == [
        0.0, *(editor.parameters[2:4] if name == "b_spline" else []), 1.0
    ]  # fmt: skip


def test_a_solid_tick_pushes_hollow_ticks(drawn, name):
    """They stood in the way of the ticks beside them, though they do nothing."""
    editor = drawn(name)
    times = editor.parameters
    grabbed = 2 if name == "b_spline" else 5
    to = 0.5 * times[1] if name == "b_spline" else 0.5 * (times[1] + times[2])
    editor.drag_parameter(grabbed, to)
    assert editor.parameters[grabbed] == pytest.approx(to, abs=2.0 / editor.window.basis_panel.pixel_map.sx)
    assert np.all(np.diff(editor.parameters) > 0.0)
    assert editor.session.active_view.is_current
    if name == "b_spline":
        share = (editor.parameters[1] - times[0]) / (editor.parameters[2] - times[0])
        assert share == pytest.approx((times[1] - times[0]) / (times[2] - times[0]))
        assert editor.parameters[3:] == times[3:]
        # To the end it does not go: there is room for the tick between.
        editor.drag_parameter(2, -0.4)
        assert 0.0 < editor.parameters[1] < editor.parameters[2] < 0.01
    editor.trigger("undo")


def test_pushed_ticks_and_the_end_of_a_rule_are_reported(drawn, name):
    editor = drawn(name)
    panel, grabbed = editor.window.basis_panel, 2 if name == "b_spline" else 5
    place = panel.rail_pixel(editor.parameters[grabbed])
    phrase = editor.curve.parametrization.kind.phrase
    editor.send(panel, QEvent.Type.MouseMove, place, held=False)
    assert f"; {phrase} turns manual · E: " in editor.window.status_line.hint
    editor.send(panel, QEvent.Type.MouseButtonPress, place)
    editor.send(panel, QEvent.Type.MouseMove, place - QPointF(20.0, 0.0))
    editor.settle()
    ticks = "1 hollow tick" if name == "b_spline" else "4 hollow ticks"
    assert f", {ticks} beside adjusted; {phrase} turns manual" in editor.status
    editor.send(panel, QEvent.Type.MouseButtonRelease, place - QPointF(20.0, 0.0), held=False)
    editor.settle()
    # Once they are manual nothing more is said of a rule.
    place = panel.rail_pixel(editor.parameters[grabbed])
    editor.send(panel, QEvent.Type.MouseMove, place, held=False)
    assert "turns manual" not in editor.window.status_line.hint
    assert editor.window.status_line.hint.startswith("Drag to change t of point")


def test_a_hollow_tick_dragged_with_e_moves_the_ticks_beside(drawn, name):
    editor = drawn(name)
    panel, before = editor.window.basis_panel, shape(editor)
    times = editor.parameters
    panel.setFocus()
    QTest.keyPress(panel, Qt.Key.Key_E)
    editor.drag_parameter(1, times[1] + 0.3)
    QTest.keyRelease(panel, Qt.Key.Key_E)
    assert editor.parameters[-1] == pytest.approx(1.3, abs=2.0 / panel.pixel_map.sx)
    assert np.abs(shape(editor) - before).max() > 1e-3 or name == "bezier"


def test_dots_on_the_edge_of_the_rail_have_a_hint(drawn, name):
    editor = drawn(name)
    panel, document = editor.window.basis_panel, editor.session.document
    curve = curve_of(editor)
    for index, place in enumerate(curve.nodes.tolist()):
        # The edge is 8 pixels above where ticks are grabbed.
        at = panel.rail_pixel(place) - QPointF(0.0, 9.0)
        editor.send(panel, QEvent.Type.MouseMove, at, held=False)
        assert editor.status.startswith(f"The dot of point {index}: its influence is largest near t = ")
        assert panel.drawing.rail.hovered == index
    editor.drag_pixels(panel, at, panel.rail_pixel(0.4))
    assert editor.session.document is document
    assert editor.session.scrub.t is not None


def test_the_panel_names_the_functions(drawn, name):
    editor = drawn(name)
    title = editor.window.findChild(QLabel, "basisTitle")
    assert title.text() == {"bezier": "Bernstein functions", "b_spline": "B-spline functions"}[name]
    editor.choose_family("lagrange")
    assert title.text() == "Basis functions"


def test_a_split_keeps_the_shape(drawn, name):
    editor = drawn(name)
    before = curve_of(editor)
    editor.scrub(0.4)
    t = editor.session.scrub.t
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_B, Qt.KeyboardModifier.ShiftModifier)
    editor.settle()
    views = editor.session.views
    assert [view.curve.domain for view in views] == [(0.0, t), (t, 1.0)]
    for view in views:
        at = np.linspace(*view.curve.domain, 200)
        assert np.abs(view.curve.evaluate(at) - before.evaluate(at)).max() < 1e-14


def test_a_spline_becomes_a_hermite_curve_and_a_spline_again(drawn):
    editor = drawn("b_spline")
    before = shape(editor)
    editor.trigger("convertToHermite")
    assert editor.curve.family.name == "hermite"
    assert editor.session.undo_stack.undoText() == "Convert to Hermite, keeping the shape"
    assert "Shape kept" in editor.status + editor.message
    assert len(editor.curve.points) == 4
    assert np.abs(shape(editor) - before).max() < 1e-14
    editor.trigger("convertToBSpline")
    assert len(editor.curve.points) == 6
    assert np.array([point.position for point in editor.curve.points]) == pytest.approx(np.array(POINTS))
    assert not editor.action("convertToBSpline").isEnabled()
    document = editor.session.document
    editor.trigger("convertToBezier")
    assert "is one polynomial from end to end, and this curve has 3" in editor.status
    assert editor.session.document == document


@pytest.fixture
def conversions(editor):
    """Open the menu with the conversions, and return the entry of one family by its name."""

    def entry(name):
        menu = editor.window.findChild(QMenu, "convertMenu")
        menu.popup(editor.window.mapToGlobal(QPoint(20, 20)))
        editor.settle()
        action = editor.action(f"convertTo{name}")
        assert action in menu.actions()
        menu.close()
        editor.settle()
        return action

    return entry


def test_text_and_tip_of_a_conversion_describe_its_result(drawn, conversions):
    editor = drawn("b_spline")
    assert conversions("Hermite").text().replace("&", "") == "Convert to Hermite, Keeping the Shape"
    assert conversions("Hermite").isEnabled()
    for name, why in (
        ("Bezier", "is one polynomial from end to end, and this curve has 3 pieces."),
        ("SepticHermite", "its jerk jumps at 2 joints, and that of a septic Hermite curve is continuous."),
        ("Lagrange", "is one polynomial from end to end, and this curve has 3 pieces."),
    ):
        action = conversions(name)
        assert not action.isEnabled()
        assert why in action.toolTip()
    # Another curve, another outlook: nothing is left of the one before.
    editor.choose_family("lagrange")
    assert editor.action("convertToBezier").isEnabled()
    assert conversions("Bezier").isEnabled()
    assert "pieces" not in conversions("Bezier").toolTip()
    assert "of degree 5, the pieces of a Hermite curve have degree 3" in conversions("Hermite").toolTip()


def test_tip_and_message_mention_the_approximation_of_a_rational_curve(drawn, conversions):
    editor = drawn("floater_hormann")
    before = shape(editor)
    size = np.ptp(np.array(POINTS), axis=0).max()
    entry = conversions("Hermite")
    text = entry.text().replace("&", "")
    within = float(text.removeprefix("Convert to Hermite, Within "))
    assert within == pytest.approx(1e-4 * size, rel=0.3)
    assert f"it changes by at most about {within:g}" in entry.toolTip()
    assert not conversions("BSpline").isEnabled()
    assert (
        "does not consist of polynomials, and a B-spline curve does"
        in entry.parent().findChild(QAction, "convertToBSpline").toolTip()
    )
    # The palette tells the same.
    assert text in editor.find_command("convert hermite")
    entry.trigger()
    editor.settle()
    assert editor.status.startswith("Shape changed by up to ")
    change = editor.status.removeprefix("Shape changed by up to ").partition(". ")[0]
    assert editor.session.undo_stack.undoText() == f"Convert to Hermite, within {change}"
    moved = np.abs(shape(editor) - before).max()
    assert 0.0 < moved <= within
    assert not any(point.corner for point in editor.curve.points)


def test_the_palette_shows_the_reason_of_a_disabled_conversion(drawn):
    editor = drawn("b_spline")
    editor.find_command("Convert to Bézier")
    palette = editor.window.findChild(QWidget, "commandPalettePanel")
    palette.run_current()
    assert (
        "one polynomial from end to end, and this curve has 3 pieces."
        in palette.findChild(QLabel, "paletteNote").text()
    )


def test_no_corners_and_no_straight_segments(drawn, name):
    editor = drawn(name)
    editor.select([2, 3])
    for action in ("straightSegment", "tangentCorner"):
        assert not editor.action(action).isEnabled()
    editor.select([])
    editor.trigger("closeCurve")
    assert "does not return smoothly" in editor.status
