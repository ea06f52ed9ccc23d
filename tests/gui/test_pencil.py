"""The pencil: a drag with the mouse becomes a curve of few points near the line."""

import math
import threading

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, Qt

from app.document.model import Document, make_curve
from app.families import FAMILIES
from app.tools.canvas import pencil
from app.view_model.curve.curve_view import view_of
from tests.waiting import until

PLACES = {
    "wobbling": [(100 + 2 * i, round(240 + 70 * math.sin(i / 20) + math.sin(1.3 * i))) for i in range(200)],
    "loop": [(round(300 + 90 * math.cos(i / 20)), round(240 + 70 * math.sin(i / 20))) for i in range(126)],
    "arc": [(round(300 + 90 * math.cos(i / 20)), round(240 + 70 * math.sin(i / 20))) for i in range(60)],
    "corner": [(200 + i, 300) for i in range(0, 101, 4)] + [(300, 300 - i) for i in range(0, 101, 4)],
}


@pytest.fixture
def editor(editor):
    editor.new()
    editor.choose_family(FAMILIES.named("hermite"))
    editor.trigger("pencilTool")
    return editor


def draw(editor, places, *, release=True):
    """Drag from place to place, in pixels; return the line in the plane."""
    canvas = editor.window.canvas
    pixels = [QPoint(*place) for place in places]
    line = np.array([canvas.to_plane(pixel) for pixel in pixels])
    editor.press(tuple(line[0]))
    for pixel in pixels:
        editor.send(canvas, QEvent.Type.MouseMove, pixel)
    editor.settle()
    if release:
        editor.release(tuple(line[-1]))
        wait(editor)
    return line


def wait(editor):
    """Wait until the lines that were drawn have become curves."""
    MAY_FIT.set()
    until(lambda: not editor.window.canvas.tools.background.lines)
    editor.settle()


def farthest(editor, line):
    """Return the largest distance of a line from the active curve, in pixels, by samples of it."""
    view = view_of(editor.session.active_curve)
    curve = view.curve.evaluate(np.linspace(*view.curve.domain, 4000))
    dx, dy = (line[:, None] - curve[None]).transpose(2, 0, 1)
    return math.sqrt((dx * dx + dy * dy).min(axis=1).max()) * editor.window.canvas.pixel_map.sx


def test_a_wobbling_line_becomes_few_points_within_the_tolerance(editor):
    line = draw(editor, PLACES["wobbling"])
    curve = editor.session.active_curve
    assert len(editor.session.document.curves) == 1
    assert 3 <= len(curve.points) <= 14
    assert not curve.is_closed
    # The samples of the curve lie 0.2 pixels apart.
    assert farthest(editor, line) <= 2.2
    assert [curve.points[0].position, curve.points[-1].position] == [tuple(line[0]), tuple(line[-1])]
    assert editor.session.undo_stack.undoText() == "Draw with the pencil"
    assert editor.session.undo_stack.count() == 2  # the family before it
    said = editor.status
    assert said.startswith(f"{len(curve.points)} points; largest deviation ")
    assert " px (" in said
    editor.trigger("undo")
    assert not editor.session.active_curve.points


def test_a_second_line_is_another_curve_of_the_same_family(editor):
    draw(editor, PLACES["wobbling"])
    draw(editor, PLACES["corner"])
    first, second = editor.session.document.curves
    assert editor.session.active_index == 1
    assert second.family is first.family
    assert second.name != first.name
    assert [point.corner for point in second.points] == [False, True, False]


def test_a_line_back_to_its_beginning_is_closed_where_the_family_can(editor):
    draw(editor, PLACES["loop"])
    assert editor.session.active_curve.is_closed
    assert len(editor.session.active_curve.points) <= 5
    editor.new()
    editor.choose_family(FAMILIES.named("lagrange"))
    editor.trigger("pencilTool")
    line = draw(editor, PLACES["loop"])
    assert not editor.session.active_curve.closed
    assert farthest(editor, line) <= 2.2


def test_every_family_can_be_drawn(editor):
    for family in FAMILIES:
        editor.new()
        editor.choose_family(family)
        editor.trigger("pencilTool")
        line = draw(editor, PLACES["corner"] if family.curve_class.is_local else PLACES["arc"])
        assert editor.session.active_curve.family is family
        assert farthest(editor, line) <= 2.2, family


def test_a_zigzag_of_few_teeth_that_took_a_polynomial_half_a_minute_is_drawn(editor):
    editor.new()
    editor.choose_family(FAMILIES.named("bezier"))
    editor.trigger("pencilTool")
    line = draw(editor, [(100 + 4 * i, 160 + abs(10 * i % 160 - 80)) for i in range(100)])
    assert editor.session.active_curve.family is FAMILIES.named("bezier")
    assert farthest(editor, line) <= 2.2


def test_a_zigzag_too_slow_for_a_polynomial_becomes_local_pieces(editor, monkeypatch):
    monkeypatch.setattr(pencil, "_PATIENCE_S", 0.2)
    editor.new()
    editor.choose_family(FAMILIES.named("bezier"))
    editor.trigger("pencilTool")
    line = draw(editor, [(100 + i, 160 + abs(10 * i % 120 - 60)) for i in range(600)])
    assert editor.session.active_curve.family.curve_class.is_local
    assert farthest(editor, line) <= 2.2
    assert "It is a Hermite curve: finding a Bézier curve that close takes too long." in editor.status
    editor.trigger("undo")
    assert editor.session.active_curve.family == FAMILIES.named("bezier")


@pytest.mark.parametrize("way", [0, 2])
def test_a_click_and_two_pixels_draw_nothing(editor, way):
    before = editor.session.document
    draw(editor, [(200, 200), (200 + way, 200)])
    assert editor.session.document == before
    assert editor.status.startswith("Drag to draw freehand")


def test_escape_leaves_no_trace(editor):
    before, count = editor.session.document, editor.session.undo_stack.count()
    draw(editor, PLACES["wobbling"], release=False)
    assert len(editor.window.canvas.marks.line) > 100
    editor.key(Qt.Key.Key_Escape)
    editor.release(editor.window.canvas.to_plane(QPoint(300, 300)))
    assert editor.session.document == before
    assert editor.session.undo_stack.count() == count
    assert editor.window.canvas.marks.line == ()
    assert editor.status == "Cancelled."


def test_the_smoothness_of_the_pencil_is_selected_in_the_menu_and_remembered(editor):
    draw(editor, PLACES["wobbling"])
    usual = len(editor.session.active_curve.points)
    # A second line from the end of the first curve would extend that.
    editor.trigger("undo")
    editor.trigger("pencilVerySmooth")
    assert editor.window.preferences.tool_settings.value(pencil.DETAIL).pixels == 10.0
    line = draw(editor, PLACES["wobbling"])
    assert len(editor.session.active_curve.points) < usual
    assert farthest(editor, line) <= 10.2


def test_a_line_of_two_thousand_positions_is_drawn_as_quickly_as_a_short_line(editor):
    """Each move of the pointer takes what is new alone: the line, not the curve, is shown meanwhile."""
    places = [(100 + i % 600, 100 + i // 10) for i in range(2000)]
    draw(editor, places, release=False)
    assert len(editor.window.canvas.marks.line) >= 1900
    assert editor.session.undo_stack.count() == 1
    editor.key(Qt.Key.Key_Escape)


MAY_FIT = threading.Event()
"""Whether the lines of a `slow` editor may become curves."""


@pytest.fixture
def slow(editor, monkeypatch):
    """An editor in which a line becomes a curve once somebody waits for it."""
    quick = pencil.fitted

    def fitted(model, line, *, tolerance, report):
        while not MAY_FIT.wait(0.01):
            report(0.5, "Fitting")
        return quick(model, line, tolerance=tolerance, report=report)

    monkeypatch.setattr(pencil, "fitted", fitted)
    MAY_FIT.clear()
    editor.new()
    editor.choose_family(FAMILIES.named("bezier"))
    editor.trigger("pencilTool")
    yield editor
    MAY_FIT.set()


def draw_without_waiting(editor, places):
    MAY_FIT.clear()
    line = draw(editor, places, release=False)
    editor.release(tuple(line[-1]))
    return line


def test_the_drawn_line_stays_with_progress_until_the_curve_is_fitted(slow):
    line = draw_without_waiting(slow, PLACES["arc"])
    canvas = slow.window.canvas
    assert not slow.session.active_curve.points
    assert np.array_equal(canvas.marks.waiting, [line])
    until(lambda: "Escape cancels" in slow.status)
    assert slow.status.startswith("Fitting: ")
    wait(slow)
    assert canvas.marks.waiting == ()
    assert slow.session.active_curve.points
    assert slow.session.undo_stack.count() == 2  # the family before it


def test_escape_cancels_a_running_fit_of_a_line(slow):
    before, count = slow.session.document, slow.session.undo_stack.count()
    draw_without_waiting(slow, PLACES["arc"])
    slow.key(Qt.Key.Key_Escape)
    assert slow.window.canvas.marks.waiting == ()
    assert slow.status == "Cancelled."
    assert slow.session.document == before
    assert slow.session.undo_stack.count() == count
    assert slow.window.canvas.tools.record.name == "pencil"
    line = draw(slow, PLACES["wobbling"])
    assert farthest(slow, line) <= 2.2


def test_undo_during_a_fit_removes_the_line_and_not_the_step_before(slow):
    """The step before the line went, and then the line's curve came."""
    before, step = slow.session.document, slow.session.undo_stack.undoText()
    draw_without_waiting(slow, PLACES["arc"])
    slow.trigger("undo")
    assert slow.window.canvas.marks.waiting == ()
    assert slow.status == "The pencil's curve was cancelled."
    wait(slow)
    assert slow.session.document == before
    assert slow.session.undo_stack.undoText() == step
    slow.trigger("undo")
    assert slow.session.undo_stack.undoText() != step


@pytest.mark.parametrize("is_held", [True, False])
def test_the_undo_key_removes_the_first_line_of_a_document(slow, is_held):
    """“Needs a step to take back”, and the curve came."""
    editor = slow
    editor.session.undo_stack.clear()
    assert not editor.action("undo").isEnabled()
    line = draw(editor, PLACES["arc"], release=False)
    if not is_held:
        editor.release(tuple(line[-1]))
    editor.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert (editor.window.canvas.marks.waiting, editor.window.canvas.marks.line) == ((), ())
    assert editor.status == ("Cancelled." if is_held else "The pencil's curve was cancelled.")
    assert not editor.action("undo").isEnabled()
    if is_held:
        editor.release(tuple(line[-1]))
    wait(editor)
    assert not editor.curve.points


def test_the_undo_key_cancels_the_first_drag_in_a_document(editor):
    editor.session.commit(Document((make_curve([(0, 0), (1, 2), (3, 2)]),)), "Begin")
    editor.fit()
    editor.session.undo_stack.clear()
    document = editor.session.document
    editor.press(editor.point(1))
    editor.move((2, 1))
    editor.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert editor.session.document is document
    editor.release((2, 1))
    assert editor.session.document is document
    assert not editor.action("undo").isEnabled()


def test_undo_removes_the_last_of_several_lines(slow):
    draw_without_waiting(slow, PLACES["arc"])
    draw_without_waiting(slow, PLACES["wobbling"])
    slow.trigger("undo")
    assert len(slow.window.canvas.marks.waiting) == 1
    wait(slow)
    assert len(slow.session.document.curves) == 1
    assert slow.session.active_curve.points


def test_quick_lines_are_fitted_in_order(slow):
    first = draw_without_waiting(slow, PLACES["arc"])
    second = draw_without_waiting(slow, PLACES["wobbling"])
    assert len(slow.window.canvas.marks.waiting) == 2
    wait(slow)
    curves = slow.session.document.curves
    assert len({curve.name for curve in curves}) == len(curves) == 2
    for place, line in enumerate((first, second)):
        slow.session.selected.activate(place)
        assert farthest(slow, line) <= 2.2
    slow.trigger("undo")
    assert len(slow.session.document.curves) == 1


def test_a_gesture_in_flight_is_not_disturbed_by_a_curve_that_is_done(slow):
    draw_without_waiting(slow, PLACES["wobbling"])
    line = draw(slow, PLACES["corner"], release=False)
    MAY_FIT.set()
    until(lambda: not slow.window.canvas.jobs.is_busy)
    assert not slow.session.active_curve.points
    assert len(slow.window.canvas.marks.line) > 40
    slow.release(tuple(line[-1]))
    wait(slow)
    assert len(slow.session.document.curves) == 2


def test_another_tool_does_not_lose_the_line_and_another_document_does(slow):
    line = draw_without_waiting(slow, PLACES["wobbling"])
    slow.trigger("selectTool")
    wait(slow)
    assert farthest(slow, line) <= 2.2
    slow.trigger("pencilTool")
    draw_without_waiting(slow, PLACES["arc"])
    slow.new()
    wait(slow)
    assert not slow.session.active_curve.points


@pytest.mark.parametrize("name", ["lagrange", "hermite"])
def test_closing_is_promised_where_the_family_can_close(editor, name):
    editor.choose_family(FAMILIES.named(name))
    draw(editor, PLACES["loop"], release=False)
    assert ("closed" in editor.status) is (name == "hermite")
    editor.escape()
