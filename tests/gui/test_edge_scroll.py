"""A drag at the edge of the canvas scrolls the view, also under a mouse that rests; real mouse events."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, Qt, QTimer

from app.document.model import Document, make_curve
from app.families import HERMITE
from app.plotting.scrolling import EdgeScroll
from tests.waiting import until

POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0))
BESIDE = ((0.0, -2.0), (2.0, -1.0), (4.0, -2.0))


@pytest.fixture
def arch(editor):
    """An arch that is edited, and another curve below it."""
    curves = make_curve(POINTS, name="A", family=HERMITE), make_curve(BESIDE, name="B", family=HERMITE)
    editor.session.commit(Document(curves), "Begin")
    editor.session.selected.activate(0)
    editor.window.canvas.camera.show_box((-3, 7), (-4, 4))
    editor.settle()
    return editor


def again(editor, document):
    """Go on with the drawing that was there, and see it from where it was seen."""
    editor.session.commit(document, "Again", active=0)
    editor.session.selected.activate(0)
    editor.window.canvas.camera.show_box((-3, 7), (-4, 4))
    editor.settle()


def left_edge(editor):
    return editor.window.canvas.camera.pixel_map.x0


def is_scrolling(editor):
    """Whether the view will move at the next tick."""
    return editor.window.canvas.findChild(EdgeScroll).findChild(QTimer).isActive()


def edge(editor, where, beyond):
    """A pixel of the viewport so far beyond an edge of the drawing, negative for inside it."""
    area, middle = editor.window.canvas.camera.area, editor.window.canvas.camera.area.center()
    return {
        "right": QPoint(area.right() + beyond, middle.y()),
        "left": QPoint(area.left() - beyond, middle.y()),
        "top": QPoint(middle.x(), area.top() - beyond),
        "bottom": QPoint(middle.x(), area.bottom() + beyond),
    }[where]


def move_to(editor, pixel):
    editor.send(editor.window.canvas, QEvent.Type.MouseMove, pixel)
    editor.settle()


def release_at(editor, pixel):
    editor.send(editor.window.canvas, QEvent.Type.MouseButtonRelease, pixel, held=False)
    editor.settle()


def start_of(editor, what):
    """The place where a drag of something begins."""
    curve = editor.session.active_view.curve
    if what == "handle":
        editor.select([1])
        return editor.handle().position
    return {
        "point": POINTS[1],
        "bend": tuple(curve.evaluate(0.5).tolist()),
        "curve": tuple(editor.session.views[1].curve.evaluate(0.4).tolist()),
        "band": (-1.0, 3.0),
    }[what]


def test_the_view_scrolls_under_a_resting_mouse_and_the_drag_follows(arch):
    document = arch.session.document
    for what in ("point", "handle", "bend", "curve", "band"):
        steps, committed = arch.session.undo_stack.count(), arch.session.committed
        start, seen = start_of(arch, what), left_edge(arch)
        arch.press(start)
        place = edge(arch, "right", 20)
        move_to(arch, place)
        until(lambda seen=seen: left_edge(arch) > seen + 1.0)
        # What is dragged has gone along, with no further event of the mouse.
        canvas = arch.window.canvas
        arch.settle()
        x, _y = canvas.to_plane(place)
        if what == "band":
            assert canvas.marks.band[1][0] == pytest.approx(x, abs=40 * arch.pixel), what
            assert canvas.marks.band[0] == pytest.approx(start, abs=2 * arch.pixel), what
        else:
            assert arch.session.document != committed, what
        if what == "point":
            assert arch.point(1)[0] == pytest.approx(x, abs=40 * arch.pixel), what
        release_at(arch, place)
        assert arch.session.undo_stack.count() == steps + (what != "band"), what
        assert not is_scrolling(arch), what
        again(arch, document)


def test_the_view_scrolls_towards_the_edge_at_the_pointer(arch):
    document = arch.session.document
    for where in ("right", "left", "top", "bottom"):
        shown = arch.window.canvas.camera.pixel_map
        arch.press(POINTS[1])
        move_to(arch, edge(arch, where, 5))

        def way(shown=shown):
            now = arch.window.canvas.camera.pixel_map
            return now.x0 - shown.x0, now.box[1] - shown.box[1]

        until(lambda way=way: any(abs(each) > 0.2 for each in way()))
        x, y = way()
        assert {"right": x > 0, "left": x < 0, "top": y > 0, "bottom": y < 0}[where], where
        assert (abs(x) > 0.2) != (abs(y) > 0.2), where
        arch.escape()
        arch.release(POINTS[1])
        again(arch, document)


def test_scrolling_stops_inside_and_escape_restores_everything(arch):
    document, steps, seen = arch.session.document, arch.session.undo_stack.count(), left_edge(arch)
    arch.press(POINTS[1])
    move_to(arch, edge(arch, "right", 20))
    until(lambda: left_edge(arch) > seen + 1.0)
    move_to(arch, edge(arch, "right", -100))
    assert not is_scrolling(arch)
    stopped = left_edge(arch)
    move_to(arch, edge(arch, "right", 20))
    until(lambda: left_edge(arch) > stopped)
    arch.escape()
    assert arch.session.document is document
    move_to(arch, edge(arch, "right", 30))
    assert not is_scrolling(arch)
    release_at(arch, edge(arch, "right", 30))
    assert arch.session.undo_stack.count() == steps


def test_a_press_at_the_edge_scrolls_only_after_a_drag_outwards(arch):
    canvas, seen = arch.window.canvas, left_edge(arch)
    at = edge(arch, "right", -5)
    arch.send(canvas, QEvent.Type.MouseButtonPress, at)
    move_to(arch, at + QPoint(1, 0))
    move_to(arch, at + QPoint(0, 40))
    assert not is_scrolling(arch)
    move_to(arch, at + QPoint(20, 40))
    until(lambda: left_edge(arch) > seen)
    release_at(arch, at + QPoint(20, 40))


def step_at(editor, pixel):
    """The pixels by which a tick scrolls to the right, for a pointer at a pixel of the viewport."""
    canvas = editor.window.canvas
    editor.send(canvas, QEvent.Type.MouseMove, pixel)
    before = left_edge(editor)
    if is_scrolling(editor):
        canvas.findChild(EdgeScroll).findChild(QTimer).timeout.emit()
    return (left_edge(editor) - before) * canvas.pixel_map.sx


def test_scrolling_grows_with_the_distance_and_is_gentle_over_panels(arch):
    canvas, window = arch.window.canvas, arch.window
    assert window.point_table.isVisible()
    edge_of_plot = canvas.camera.area.right()
    outside = canvas.mapFrom(window, QPoint(window.width(), 0)).x()
    panels = outside - canvas.viewport().width()
    assert panels > 200
    arch.press(POINTS[1])
    y = canvas.camera.area.center().y()
    within = [step_at(arch, QPoint(edge_of_plot + beyond, y)) for beyond in (-8, -4, 0)]
    over = [step_at(arch, QPoint(outside - before, y)) for before in (panels - 10, panels // 2, 0)]
    far = [step_at(arch, QPoint(outside + beyond, y)) for beyond in (20, 60, 120, 200)]
    steps = [*within, *over, *far]
    assert steps == sorted(set(steps))
    # Over the table, hundreds of pixels away, it scrolled by 30 pixels a tick: twice the drawing in a second.
    assert all(1.5 <= step < 7.5 for step in over)
    assert over[-1] - over[0] < 0.012 * panels
    assert far[-1] == pytest.approx(30.0)
    # Beyond the window the speed grows fast.
    assert far[1] - far[0] == pytest.approx(0.15 * 40)
    arch.escape()
    arch.release(POINTS[1])


def test_escape_undo_and_redo_of_a_drag_that_scrolled_bring_the_view_back(arch):
    camera = arch.window.canvas.camera
    before, document = camera.ranges, arch.session.document
    arch.press(POINTS[1])
    step_at(arch, edge(arch, "right", 40))
    assert camera.ranges != before
    arch.escape()
    assert np.array(camera.ranges) == pytest.approx(np.array(before))
    arch.release(POINTS[1])
    # A drag that is dropped by a command brings it back as well.
    arch.press(POINTS[1])
    step_at(arch, edge(arch, "right", 40))
    arch.trigger("undo")
    assert arch.session.document == document
    assert np.array(camera.ranges) == pytest.approx(np.array(before))
    arch.release(POINTS[1])
    arch.press(POINTS[1])
    for where in ("right", "top"):
        step_at(arch, edge(arch, where, 40))
    release_at(arch, edge(arch, "right", -200))
    after = camera.ranges
    assert abs(after[0][0] - before[0][0]) > 2 * arch.pixel
    assert arch.session.undo_stack.undoText() == "Move point 1"
    arch.trigger("undo")
    assert np.array(camera.ranges) == pytest.approx(np.array(before))
    arch.trigger("redo")
    assert np.array(camera.ranges) == pytest.approx(np.array(after))
    # Steps that have scrolled nothing leave the view where it is.
    arch.window.canvas.camera.show_box((-4, 6), (-3, 5))
    seen = camera.ranges
    arch.drag_point(0, to=(0.5, 0.5))
    arch.trigger("undo")
    assert camera.ranges == seen
    # The view is no longer that in which the drag has ended: it stays.
    arch.trigger("undo")
    assert arch.session.document == document
    assert camera.ranges == seen


def test_a_level_drag_that_scrolls_says_no_rounding_error(arch):
    """It said "moved 4.217, 1.776e−15"."""
    canvas = arch.window.canvas
    canvas.camera.show_box((-3.1, 6.7), (-4.3, 3.9))
    level = canvas.to_pixel(*POINTS[1]).y()
    arch.press(POINTS[1])
    for beyond in (-200, -100, 5):
        pixel = QPoint(edge(arch, "right", beyond).x(), level)
        arch.send(canvas, QEvent.Type.MouseMove, pixel)
    for _ in range(40):
        canvas.findChild(EdgeScroll)._scroll()
        arch.settle()
        assert "e−" not in arch.status
    assert arch.status.split("moved ")[1].split(" · ")[0].endswith(", 0")
    arch.escape()
    arch.release(POINTS[1])


def test_undo_and_redo_of_a_drag_that_scrolled_leave_a_view_that_was_zoomed_since(arch):
    """Undo jumped from 461 pixels per unit to the 320 before the drag."""
    camera = arch.window.canvas.camera
    arch.press(POINTS[1])
    step_at(arch, edge(arch, "right", 40))
    release_at(arch, edge(arch, "right", -200))
    arch.wheel((2.0, 0.0), 2)
    zoomed = camera.ranges
    for action in ("undo", "redo"):
        arch.trigger(action)
        assert camera.ranges == zoomed, action


def test_undo_of_a_pencil_line_that_scrolled_brings_the_view_back(arch):
    camera = arch.window.canvas.camera
    before, curves = camera.ranges, len(arch.session.document.curves)
    arch.trigger("pencilTool")
    arch.press((2.0, 3.0))
    for x in (3.0, 4.0, 5.0):
        arch.move((x, 3.0 - 0.1 * x * x))
    step_at(arch, edge(arch, "right", 60))
    release_at(arch, edge(arch, "right", -30))
    until(lambda: len(arch.session.document.curves) == curves + 1)
    assert camera.ranges != before
    arch.trigger("undo")
    assert len(arch.session.document.curves) == curves
    assert np.array(camera.ranges) == pytest.approx(np.array(before))


def test_a_rubber_band_that_scrolled_is_cancelled_with_its_view(arch):
    camera = arch.window.canvas.camera
    before = camera.ranges
    arch.press((-1.0, 3.0))
    step_at(arch, edge(arch, "right", 40))
    assert camera.ranges != before
    arch.escape()
    assert np.array(camera.ranges) == pytest.approx(np.array(before))
    arch.release((-1.0, 3.0))


def test_without_a_button_the_edge_does_not_scroll(arch):
    arch.select([1])
    arch.hover((2, 2))
    arch.key(Qt.Key.Key_G)
    arch.send(arch.window.canvas, QEvent.Type.MouseMove, edge(arch, "right", -3), held=False)
    assert not is_scrolling(arch)
    arch.escape()
