"""The tools Rectangle and Ellipse: a drag opens a box, and a closed curve fills it."""

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.constraints import is_straight
from app.document.model import Document, make_curve
from app.document.style import PLAIN_STYLE
from app.document.words import number
from app.families import HERMITE, LAGRANGE
from app.view_model.curve.curve_view import view_of

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
STYLE = replace(PLAIN_STYLE, width=3.0)
FROM, TO = (1.0, -1.0), (4.0, 1.0)


@pytest.fixture
def drawing(editor):
    """A quartic with a style of its own, a curve above it, and a grid of 0.1; nothing snaps."""
    first = replace(make_curve([(0, 3), (1, 4), (2, 3)], family=LAGRANGE), style=STYLE)
    above = make_curve([(3, 3), (4, 4), (5, 3)], name="Above")
    editor.session.commit(Document((first, above), unit="mm", grid_spacing=0.1), "Begin")
    editor.window.canvas.camera.show_box((-1, 7), (-3, 5))
    editor.settle()
    yield editor
    # The zoom says what the unit is when it is shown anew.
    editor.new()


def at(editor, place):
    """Return where exactly the pixel of a place lies."""
    canvas = editor.window.canvas
    return canvas.to_plane(canvas.to_pixel(*place))


def box_of(curve):
    view = view_of(curve)
    places = view.curve.evaluate(np.linspace(*view.curve.domain, 4001))
    return [*places.min(axis=0), *places.max(axis=0)]


def steps(editor):
    return editor.session.undo_stack.count()


def test_a_drag_draws_a_rectangle_of_straight_lines_above_all_others(drawing):
    before, count = drawing.session.document, steps(drawing)
    drawing.trigger("rectangleTool")
    drawing.press(FROM)
    drawing.move((2.0, 0.0))
    assert len(drawing.session.document.curves) == 3  # live
    drawing.move(TO)
    (left, low), (right, high) = at(drawing, FROM), at(drawing, TO)
    size = f"{number(right - left)} × {number(high - low)} mm"
    assert drawing.status.startswith(f"{size} · Ctrl: a square · Shift: about the centre")
    drawing.release(TO)
    curve = drawing.session.active_curve
    assert drawing.session.document.curves == (*before.curves, curve)
    assert curve.family is HERMITE
    assert curve.is_closed
    assert curve.style == STYLE
    corners = [(left, high), (right, high), (right, low), (left, low)]  # as in SVG
    assert [point.position for point in curve.points] == corners
    assert all(is_straight(curve, segment) for segment in range(4))
    assert (drawing.session.undo_stack.undoText(), steps(drawing)) == ("Draw rectangle", count + 1)
    assert drawing.action("rectangleTool").isChecked()
    drawing.trigger("undo")
    assert drawing.session.document == before
    assert drawing.session.active_index == 0


def test_an_ellipse_is_as_round_as_cubics_are(drawing):
    drawing.trigger("ellipseTool")
    # From the upper right to the lower left.
    drawing.drag(TO, FROM)
    curve, (low, high) = drawing.session.active_curve, (at(drawing, FROM), at(drawing, TO))
    assert box_of(curve) == pytest.approx([*low, *high], abs=1e-12)
    middle, half = np.add(low, high) / 2, np.subtract(high, low) / 2
    view = view_of(curve)
    places = (view.curve.evaluate(np.linspace(*view.curve.domain, 4001)) - middle) / half
    # The error of the usual arc, with k = 4/3 (√2 − 1).
    assert np.hypot(*places.T).max() - 1 == pytest.approx(2.7253e-4, abs=1e-7)
    assert np.hypot(*places.T).min() == pytest.approx(1, abs=1e-12)
    assert not any(point.corner for point in curve.points)
    assert drawing.session.undo_stack.undoText() == "Draw ellipse"


def test_ctrl_makes_a_circle_and_shift_draws_about_the_centre(drawing):
    drawing.trigger("ellipseTool")
    drawing.drag(FROM, TO, keys=CTRL)
    left, low, right, high = box_of(drawing.session.active_curve)
    side = at(drawing, TO)[0] - at(drawing, FROM)[0]
    assert [right - left, high - low] == pytest.approx([side, side], abs=1e-12)
    assert [left, low] == pytest.approx(at(drawing, FROM), abs=1e-12)
    drawing.trigger("undo")
    drawing.trigger("rectangleTool")
    drawing.drag((2.0, 1.0), (3.0, -1.0), keys=SHIFT)
    (x, y), (right, low) = at(drawing, (2.0, 1.0)), at(drawing, (3.0, -1.0))
    assert box_of(drawing.session.active_curve) == pytest.approx([2 * x - right, low, right, 2 * y - low])


def test_a_snapped_box_lies_on_the_grid_to_the_last_digit(drawing):
    drawing.trigger("toggleSnap")
    drawing.window.canvas.camera.show_box((-0.3, 1.3), (-0.6, 1.0))
    off = 3 * drawing.pixel
    drawing.trigger("rectangleTool")
    drawing.drag((0.1 + off, 0.1 - off), (0.3 + off, 0.7 - off))
    assert [point.position for point in drawing.session.active_curve.points] == [
        (0.1, 0.7), (0.3, 0.7), (0.3, 0.1), (0.1, 0.1)
    ]  # fmt: skip
    # With Ctrl, too, which elsewhere turns the switch round; 0.1 + 0.2 is no 0.3 of floats.
    drawing.drag((0.1 + off, -0.1 - off), (0.3 + off, 0.0 - off), keys=CTRL)
    assert {point.position for point in drawing.session.active_curve.points} == {
        (0.1, -0.1), (0.3, -0.1), (0.3, 0.1), (0.1, 0.1)
    }  # fmt: skip


def test_escape_and_a_click_draw_nothing(drawing):
    before, count = drawing.session.document, steps(drawing)
    drawing.trigger("ellipseTool")
    drawing.press(FROM)
    drawing.move(TO)
    drawing.escape()
    drawing.release(TO)
    assert (drawing.session.document, steps(drawing)) == (before, count)
    assert drawing.session.active_index == 0
    drawing.press(FROM)
    drawing.release(FROM)
    assert drawing.status == "Drag to draw an ellipse."
    assert (drawing.session.document, steps(drawing)) == (before, count)
    assert drawing.action("ellipseTool").isChecked()


def test_a_box_curve_replaces_an_empty_curve_and_a_flat_box_draws_nothing(editor):
    editor.new()
    editor.trigger("rectangleTool")
    editor.press((1.0, 1.0))
    editor.move((2.0, 1.0))
    assert editor.status.startswith("Drag to the side and up or down")
    editor.release((2.0, 1.0))
    assert not editor.curve.points
    editor.drag((1.0, 1.0), (2.0, 2.0))
    assert [curve.name for curve in editor.session.document.curves] == ["Rectangle 1"]
    assert len(editor.curve.points) == 4


@pytest.mark.parametrize(
    ("word", "tool"), [("circle tool", "ellipseTool"), ("oval", "ellipseTool"), ("square", "rectangleTool")]
)
def test_the_palette_finds_the_tools_by_synonyms(editor, word, tool):
    editor.run_command(word)
    assert editor.action(tool).isChecked()


def test_width_and_height_are_typed_during_the_drag(drawing):
    """A digit threw the drag away and made another family of the curve below."""
    drawing.trigger("rectangleTool")
    drawing.press(FROM)
    drawing.move((2.0, -2.0))
    drawing.key(Qt.Key.Key_6)
    drawing.key(Qt.Key.Key_0)
    assert drawing.status.startswith("60| × ")
    drawing.key(Qt.Key.Key_Backspace)
    drawing.key(Qt.Key.Key_Tab)
    drawing.type_amount("2.5")
    assert drawing.status.startswith("6 × 2.5| mm")
    drawing.release((2.0, -2.0))
    left, top = at(drawing, FROM)
    assert box_of(drawing.curve) == pytest.approx([left, top - 2.5, left + 6, top], abs=1e-12)
    assert drawing.session.undo_stack.undoText() == "Draw rectangle"
    before = drawing.session.document
    drawing.key(Qt.Key.Key_6)
    assert drawing.session.document is before, "too late, and no reason for another family"
    assert "while you drag" in drawing.status
    drawing.press(TO)
    drawing.move((5.0, 2.0), keys=CTRL)
    drawing.key(Qt.Key.Key_1)
    drawing.escape()
    drawing.release((5.0, 2.0))
    assert drawing.session.document is before


def test_width_and_height_may_be_expressions_but_not_incomplete_ones(drawing):
    """A slash was left out: 1/3 was 13."""
    drawing.trigger("rectangleTool")
    drawing.press(FROM)
    drawing.move((2.0, -2.0))
    drawing.type_amount("1/4\t(1+2)*2")
    assert drawing.status.startswith("1/4 × (1+2)*2| mm")
    drawing.release((2.0, -2.0))
    left, top = at(drawing, FROM)
    assert box_of(drawing.curve) == pytest.approx([left, top - 6, left + 0.25, top], abs=1e-12)
    before, count = drawing.session.document, steps(drawing)
    drawing.press(FROM)
    drawing.move((2.0, -2.0))
    drawing.type_amount("1/")
    drawing.key(Qt.Key.Key_Return)
    assert drawing.status.endswith("The number or expression is incomplete.")
    assert drawing.window.canvas.is_dragging
    drawing.release((2.0, -2.0))
    assert drawing.status.endswith("The number or expression is incomplete.")
    assert (drawing.session.document, steps(drawing)) == (before, count)


def test_units_may_follow_width_and_height_and_other_letters_are_refused(drawing):
    """The letter m dropped the rectangle and took the tool that measures."""
    drawing.trigger("rectangleTool")
    drawing.press(FROM)
    drawing.move((2.0, -2.0))
    drawing.type_amount("2 mm\t0.1cm")
    assert drawing.status.startswith("2mm × 0.1cm| mm")
    for key in (Qt.Key.Key_V, Qt.Key.Key_X, Qt.Key.Key_G):
        drawing.key(key)
        assert "is not a unit of length" in drawing.status
    assert drawing.action("rectangleTool").isChecked()
    drawing.release((2.0, -2.0))
    left, top = at(drawing, FROM)
    assert box_of(drawing.curve) == pytest.approx([left, top - 1, left + 2, top], abs=1e-12)
