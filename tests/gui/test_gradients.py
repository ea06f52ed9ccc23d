"""Gradients in the Style panel and under the Gradient tool: live, one step each, taken back by Escape."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QToolButton, QWidget

from app.document.gradient import Gradient, GradientKind, Stop, with_stop_between
from app.document.model import Document, make_curve
from app.document.style import NO_PAINT, Style
from app.document.style_edits import with_style
from app.families import HERMITE
from app.features.style.stop_bar import StopBar

BLUE, RED = "#0072b2", "#d55e00"


def square(x, y, side, name, **fields):
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    curve = make_curve(corners, name=name, family=HERMITE)
    points = tuple(replace(point, corner=True, velocity=None) for point in curve.points)
    style = Style(stroke=NO_PAINT, fill=BLUE)
    return replace(curve, points=points, closed=True, style=style, **fields)


@pytest.fixture
def squares(editor):
    """Two filled squares, 4 and 2 wide, the first chosen; no grid beside them."""
    editor.window.context.store.change(grid=False)
    editor.session.commit(Document((square(0, 0, 4, "Leaf"), square(6, 0, 2, "Root"))), "Begin")
    editor.fit()
    editor.session.selected.choose([0])
    editor.settle()
    return editor


@pytest.fixture
def panel(squares):
    squares.show_dock("styleDock")
    return squares.window.findChild(QWidget, "stylePanel")


def click(panel, name):
    button = panel.findChild(QToolButton, name)
    assert button is not None, name
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)


def gradient(editor, place=0):
    return editor.session.document.curves[place].style.fill_gradient


def stops(editor, place=0):
    return [(stop.offset, stop.colour, stop.opacity) for stop in gradient(editor, place).stops]


def seen(editor, x, y):
    canvas = editor.window.canvas
    editor.settle()
    editor.wait_for_rest()
    return QColor(canvas.viewport().grab().toImage().pixel(canvas.to_pixel(x, y)))


def steps(editor):
    return editor.session.undo_stack.count()


def on_bar(bar, offset):
    return QPoint(round(bar.place_of(offset).x()), 8)


# The panel


def test_a_fill_becomes_a_gradient_across_each_shape_and_a_colour_again(squares, panel):
    squares.session.selected.choose([0, 1])
    before = steps(squares)
    click(panel, "fillKind_linear")
    assert steps(squares) == before + 1
    assert squares.session.undo_stack.undoText() == "Fill of 2 curves"
    assert stops(squares) == stops(squares, 1) == [(0.0, BLUE, 1.0), (1.0, BLUE, 0.0)]
    assert [(each.start, each.end) for each in (gradient(squares, i) for i in (0, 1))] == [
        ((0.0, 2.0), (4.0, 2.0)),
        ((6.0, 1.0), (8.0, 1.0)),
    ]
    # It fades out to the right: paper is far lighter in red.
    across = [seen(squares, x, 1.0).red() for x in (0.2, 2.0, 3.8)]
    assert across == [pytest.approx(level, abs=25) for level in (12, 125, 238)]
    click(panel, "fillKind_radial")
    assert (gradient(squares).start, gradient(squares).end) == ((2.0, 2.0), (4.0, 2.0))
    click(panel, "fillKind_flat")
    assert squares.session.document.curves[0].style == Style(stroke=NO_PAINT, fill=BLUE)


def test_one_that_is_flat_and_one_that_is_a_gradient_of_that_colour_are_mixed(squares, panel):
    """The panel showed the colour of the flat one, as if both were."""
    click(panel, "fillKind_linear")
    squares.session.selected.choose([0, 1])
    squares.settle()
    hex_field = panel.findChild(QLineEdit, "fillPaintHex")
    assert hex_field.text() == "mixed"
    squares.trigger("groupCurves")
    squares.settle()
    assert hex_field.text() == "mixed"
    squares.trigger("undo")
    squares.session.selected.choose([1])
    squares.settle()
    assert hex_field.text() == BLUE


def test_stops_are_added_coloured_moved_and_removed(squares, panel):
    click(panel, "fillKind_linear")
    bar = panel.findChild(StopBar, "fillStops")
    squares.settle()
    QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=on_bar(bar, 0.5))
    assert stops(squares)[1] == (pytest.approx(0.5, abs=0.01), BLUE, pytest.approx(0.5, abs=0.01))
    click(panel, "fillPaint_Vermillion")
    assert [colour for _, colour, _ in stops(squares)] == [BLUE, RED, BLUE]
    assert squares.session.undo_stack.undoText() == "Fill gradient of Leaf"
    field = panel.findChild(QLineEdit, "fillStopOpacity")
    field.setFocus()
    field.selectAll()
    squares.type_text(field, "100")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert stops(squares)[1][2] == 1.0
    # A drag is seen at once; Escape takes it back, and a whole one is one step.
    before, count = stops(squares), steps(squares)
    QTest.mousePress(bar, Qt.MouseButton.LeftButton, pos=on_bar(bar, 0.5))
    QTest.mouseMove(bar, on_bar(bar, 0.8))
    assert stops(squares)[1][0] == pytest.approx(0.8, abs=0.01)
    assert seen(squares, 3.2, 1.0).red() > 200
    QTest.keyClick(bar, Qt.Key.Key_Escape)
    assert stops(squares) == before
    QTest.mouseRelease(bar, Qt.MouseButton.LeftButton, pos=on_bar(bar, 0.8))
    assert (stops(squares), steps(squares)) == (before, count)
    QTest.mousePress(bar, Qt.MouseButton.LeftButton, pos=on_bar(bar, 0.5))
    for offset in (0.4, 0.3, 0.2):
        QTest.mouseMove(bar, on_bar(bar, offset))
    QTest.mouseRelease(bar, Qt.MouseButton.LeftButton, pos=on_bar(bar, 0.2))
    assert (stops(squares)[1][0], steps(squares)) == (pytest.approx(0.2, abs=0.01), count + 1)
    QTest.keyClick(bar, Qt.Key.Key_Delete)
    assert [colour for _, colour, _ in stops(squares)] == [BLUE, BLUE]
    # Two stay.
    QTest.keyClick(bar, Qt.Key.Key_Delete)
    assert len(stops(squares)) == 2


def test_a_style_is_pasted_across_the_other_shape_and_svg_has_the_gradient(squares, panel):
    click(panel, "fillKind_radial")
    squares.trigger("copyStyle")
    squares.session.selected.choose([1])
    squares.trigger("pasteStyle")
    found = gradient(squares, 1)
    assert found.kind is GradientKind.RADIAL
    assert (found.start, found.end, found.side) == ((7.0, 1.0), (8.0, 1.0), (7.0, 2.0))
    squares.trigger("copySvg")
    squares.wait_for_work()
    assert "<radialGradient" in QGuiApplication.clipboard().text()


# The tool


def test_a_drag_lays_a_gradient_and_its_ends_are_dragged(squares):
    squares.trigger("gradientTool")
    before = steps(squares)
    squares.drag((1.0, 1.0), (3.0, 1.0))
    assert steps(squares) == before + 1
    assert squares.session.undo_stack.undoText() == "Gradient of Leaf"
    near = squares.pixel
    assert gradient(squares).start == pytest.approx((1.0, 1.0), abs=near)
    assert gradient(squares).end == pytest.approx((3.0, 1.0), abs=near)
    # Live, and Escape leaves no trace.
    laid = gradient(squares)
    squares.press(laid.end)
    squares.move((1.5, 3.0))
    squares.move((1.0, 4.0))
    assert gradient(squares).end == pytest.approx((1.0, 4.0), abs=near)
    assert seen(squares, 0.2, 3.8).red() > 200  # far along the new axis nothing is left
    squares.escape()
    squares.release((1.0, 4.0))
    assert (gradient(squares), steps(squares)) == (laid, before + 1)
    squares.drag(laid.end, (1.0, 4.0))
    moved = gradient(squares)
    assert moved.end == pytest.approx((1.0, 4.0), abs=near)
    (a, b), (c, d) = moved.axes
    assert a * c + b * d == pytest.approx(0.0, abs=1e-9)
    assert steps(squares) == before + 2
    squares.drag((3.0, 0.5), (3.5, 0.7), keys=Qt.KeyboardModifier.ShiftModifier)
    (a, b), _ = gradient(squares).axes
    assert np.degrees(np.arctan2(b, a)) == pytest.approx(15.0)


def test_a_radial_one_has_two_axes_stops_between_and_a_focus(squares):
    stops = (Stop(0.0, BLUE), Stop(0.5, RED), Stop(1.0, BLUE))
    round_ = Gradient(stops, GradientKind.RADIAL, (2.0, 2.0), (4.0, 2.0), (2.0, 4.0))
    curve = squares.session.document.curves[0]
    styled = replace(curve, style=curve.style.with_gradient("fill", round_))
    squares.session.commit(squares.session.document.with_curve(0, styled), "Round")
    squares.session.selected.choose([0])
    squares.trigger("gradientTool")
    near = 2 * squares.pixel
    squares.drag((2.0, 4.0), (2.0, 3.0))
    assert gradient(squares).side == pytest.approx((2.0, 3.0), abs=near)
    assert gradient(squares).end == pytest.approx((4.0, 2.0), abs=near)
    squares.drag((3.0, 2.0), (3.5, 2.2))
    assert [stop.offset for stop in gradient(squares).stops] == [0.0, pytest.approx(0.75, abs=near), 1.0]
    assert squares.session.undo_stack.undoText() == "Stop of Leaf"
    squares.drag((2.0, 2.0), (1.5, 2.0), keys=Qt.KeyboardModifier.ShiftModifier)
    assert gradient(squares).focus == pytest.approx((1.5, 2.0), abs=near)
    squares.drag((2.0, 2.0), (2.5, 2.5))
    assert gradient(squares).start == pytest.approx((2.5, 2.5), abs=near)
    assert gradient(squares).focus == pytest.approx((2.0, 2.5), abs=near)


def test_a_double_click_on_the_line_adds_a_stop_of_the_colour_that_is_there(squares):
    """It edited the curve, and the gradient was as before."""
    squares.trigger("gradientTool")
    squares.drag((0.5, 2.0), (3.5, 2.0))
    before, chosen = steps(squares), squares.session.selected.choice
    laid = gradient(squares)
    squares.hover((1.25, 2.0))
    assert squares.window.status_line.hint.startswith("Double-click the line to add a stop")
    squares.click((1.25, 2.0))
    assert squares.status == "Double-click the line to add a stop."
    assert (gradient(squares), squares.session.box.turns) == (laid, False)
    squares.double_click((1.25, 2.0))
    one, new, other = stops(squares)
    assert (one, other) == tuple((stop.offset, stop.colour, stop.opacity) for stop in laid.stops)
    assert new == (pytest.approx(0.25, abs=squares.pixel), BLUE, pytest.approx(0.75, abs=squares.pixel))
    assert steps(squares) == before + 1
    assert squares.session.undo_stack.undoText() == "Add stop of Leaf"
    assert squares.session.selected.choice == chosen
    # It is one to drag from now on.
    squares.drag((1.25, 2.0), (2.0, 2.3))
    assert [stop[0] for stop in stops(squares)] == [0.0, pytest.approx(0.5, abs=squares.pixel), 1.0]
    squares.trigger("undo")
    squares.trigger("undo")
    assert gradient(squares) == laid


def test_a_shape_that_is_dragged_takes_its_gradient_along(squares):
    squares.trigger("gradientTool")
    squares.drag((0.0, 2.0), (4.0, 2.0))
    before = [seen(squares, x, 1.0).red() for x in (0.5, 2.0, 3.5)]
    squares.trigger("selectTool")
    old = gradient(squares)
    squares.drag((1.0, 1.0), (1.0, 0.0))
    new = gradient(squares)
    shift = squares.session.document.curves[0].points[0].y
    assert shift == pytest.approx(-1.0, abs=2 * squares.pixel)
    assert new.start == pytest.approx((old.start[0], old.start[1] + shift))
    after = [seen(squares, x, 1.0 + shift).red() for x in (0.5, 2.0, 3.5)]
    assert after == pytest.approx(before, abs=6)


def test_with_nothing_chosen_the_tool_says_so_and_a_press_on_a_shape_means_that(squares):
    squares.session.selected.choose([])
    squares.trigger("gradientTool")
    before = steps(squares)
    squares.drag((9.0, 3.0), (10.0, 3.0))
    assert steps(squares) == before
    squares.click((9.0, 3.0))
    assert squares.status == "Choose a curve first: click one."
    squares.drag((6.5, 1.0), (7.5, 1.0))
    assert (gradient(squares), gradient(squares, 1) is not None) == (None, True)


@pytest.mark.parametrize("flat", [BLUE, NO_PAINT])
def test_what_is_drawn_next_has_the_last_flat_paint_from_before_the_gradient(squares, flat):
    """A line drawn with the pen got a solid fill, where only the shape before it was to have a gradient."""
    squares.session.change("Paint", lambda document: with_style(document, [0], fill=flat, stroke=RED))
    squares.trigger("gradientTool")
    squares.drag((0.5, 2.0), (3.5, 2.0))
    assert gradient(squares) is not None
    squares.trigger("rectangleTool")
    squares.drag((6.2, 2.5), (8.0, 4.0))
    style = squares.session.document.curves[-1].style
    assert len(squares.session.document.curves) == 3
    assert (style.fill, style.fill_gradient, style.stroke) == (flat, None, RED)
    # Nor of one that was only chosen.
    squares.session.selected.choose([0])
    assert (squares.session.model.style.fill, squares.session.model.style.fill_gradient) == (flat, None)


@pytest.fixture
def striped(squares):
    """The first square with a gradient of three stops along y = 2, from 0.5 to 3.5, under its tool."""
    squares.trigger("gradientTool")
    squares.drag((0.5, 2.0), (3.5, 2.0))
    squares.double_click((1.25, 2.0))
    return squares


def test_delete_means_the_stop_that_was_clicked_and_not_the_curve(striped):
    before, document = stops(striped), striped.session.document
    striped.click((0.5, 2.0))
    assert striped.status.startswith("Stop at 0 % · Arrow keys: move it · Del")
    assert striped.window.canvas.tools.marks().stop == (0, 0)
    striped.click((1.25, 2.0))
    striped.key(Qt.Key.Key_Delete)
    assert stops(striped) == [before[0], before[2]]
    assert striped.session.undo_stack.undoText() == "Delete stop of Leaf"
    assert len(striped.session.document.curves) == 2
    # One of two: the colour of the other is left, and the next key would mean the curve.
    striped.click((0.5, 2.0))
    striped.key(Qt.Key.Key_Backspace)
    style = striped.session.document.curves[0].style
    assert (style.fill, style.fill_gradient, style.fill_opacity) == (BLUE, None, 0.0)
    striped.trigger("undo")
    striped.trigger("undo")
    assert striped.session.document == document
    striped.click((1.25, 2.0), keys=Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier)
    assert stops(striped) == [before[0], before[2]]


def test_arrow_keys_move_the_chosen_stop_and_escape_lets_it_go(striped):
    striped.click((1.25, 2.0))
    count, place = steps(striped), stops(striped)[1][0]
    corner = striped.session.document.curves[0].points[0]
    for _ in range(3):
        striped.key(Qt.Key.Key_Right)
    striped.key(Qt.Key.Key_Up)
    assert stops(striped)[1][0] == pytest.approx(place + 0.03)
    assert steps(striped) == count + 1
    assert striped.session.undo_stack.undoText() == "Nudge stop of Leaf"
    striped.click((3.5, 2.0))
    striped.key(Qt.Key.Key_Up)
    assert gradient(striped).end[1] > 2.0
    assert striped.session.document.curves[0].points[0] == corner
    striped.escape()
    assert striped.window.canvas.tools.marks().stop is None
    assert striped.window.context.store.state.tool.name == "gradient"
    striped.key(Qt.Key.Key_Delete)
    assert len(striped.session.document.curves) == 1


def test_a_stop_chosen_in_the_panel_is_lit_on_the_canvas_and_the_other_way_round(striped, panel):
    editor, session = striped, striped.session
    bar = panel.gradients["fill"].bar
    editor.click((3.5, 2.0))
    assert panel.gradients["fill"].stop == session.document.curves[0].style.fill_gradient.stops[2]
    panel.choose_colour("fill", RED)
    assert session.document.curves[0].style.fill_gradient.stops[2].colour == RED
    # And from there.
    place = bar.place_of(stops(editor)[1][0]).toPoint() + QPoint(0, 4)
    QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=place)
    assert editor.window.canvas.tools.marks().stop == (0, 1)
    count = len(stops(editor))
    editor.key(Qt.Key.Key_Delete)
    assert len(stops(editor)) == count - 1
    # A stop that is added there is chosen here, too; of another document none is.
    bar.wanted.emit(*with_stop_between(session.document.curves[0].style.fill_gradient.stops, 0.7))
    assert session.selected.stop.chosen == (0, "fill", 1)
    assert editor.window.canvas.tools.marks().stop == (0, 1)
    session.new()
    assert session.selected.stop.chosen is None


def test_the_mark_of_the_chosen_stop_is_larger(striped):
    canvas = striped.window.canvas
    striped.leave()
    striped.click((3.5, 2.0))
    striped.settle()
    at = canvas.to_pixel(3.5, 2.0) + QPoint(0, 7)
    chosen = canvas.viewport().grab().toImage().pixelColor(at)
    striped.escape()
    striped.settle()
    assert chosen != canvas.viewport().grab().toImage().pixelColor(at)
