"""The test driver does what a person can do, and says why not where there is no such thing."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QAbstractEventDispatcher, QEvent, QPoint, Qt, QTimer
from PySide6.QtWidgets import QLabel, QMessageBox
from shiboken6 import delete, getAllValidWrappers, isValid

from app.testing import ApplicationQuitError, ImpossibleError, spin, wait_for_rest, waiting


def impossible(reason):
    return pytest.raises(ImpossibleError, match=reason)


def test_impossible_input_is_refused_with_the_reason(editor):
    session, canvas = editor.session, editor.window.canvas
    before = session.document
    with impossible(r"'undo' \(.*\) is disabled"):
        editor.trigger("undo")
    with impossible("is disabled"):
        editor.trigger("redo")
    x_min, y_min, x_max, _ = canvas.pixel_map.box
    outside = (x_max + 0.5 * (x_max - x_min), y_min)
    for gesture in (
        lambda: editor.click(outside),
        lambda: editor.hover(outside),
        lambda: editor.drag(outside, editor.point(0)),
        lambda: editor.wheel(outside, 1),
        lambda: editor.open_menu(outside),
    ):
        with impossible("lies outside canvas"):
            gesture()
    # With the button held the mouse may leave the window, but not for a place that is on no screen.
    far = (1e6, 1e6)
    for gesture in (
        lambda: editor.click(far),
        lambda: editor.drag_point(1, to=far),
        lambda: editor.drag_point(1, to=(-1e22, 0.0)),
        lambda: editor.bend(0.5, to=far),
        lambda: editor.drag_parameter(1, to=1e6),
        lambda: editor.scrub(-1e6),
        lambda: editor.add_point(*editor.point(1), velocity_handle=far),
        lambda: editor.move(far),
        lambda: editor.release(far),
    ):
        with impossible(r"lies outside .*editor.fit\(\)"):
            gesture()
        assert session.document is before
        assert not session.is_previewing
    editor.drag(editor.point(1), outside)
    assert editor.point(1) == pytest.approx(outside, abs=2 * editor.pixel)
    editor.trigger("undo")
    assert session.document is before


def test_hidden_and_covered_widgets_cannot_be_reached(editor):
    label = QLabel("Over it", editor.window.canvas.viewport())
    label.setObjectName("overIt")
    label.setGeometry(200, 200, 50, 20)
    label.show()
    with impossible("lies overIt"):
        editor.click(editor.window.canvas.to_plane(QPoint(210, 210)))
    label.deleteLater()
    editor.trigger("toggleBasis")
    for gesture in (
        lambda: editor.drag_parameter(1, 0.3),
        lambda: editor.rail.click(1),
        lambda: editor.rail.type(1, "0.3"),
        lambda: editor.scrub(0.5),
    ):
        with impossible("is not shown"):
            gesture()
    with impossible("is not shown"):
        editor.type_text(editor.window.central["plotPanel"], "x")
    editor.window.canvas.setEnabled(False)
    with impossible("is disabled"):
        editor.key(Qt.Key.Key_A)
    editor.window.canvas.setEnabled(True)


def test_nothing_is_reached_under_a_dialog_that_waits(editor):
    box = QMessageBox(editor.window)
    box.setObjectName("question")
    box.open()
    editor.settle()
    for gesture in (
        lambda: editor.trigger("selectAll"),
        lambda: editor.click(editor.point(0)),
        lambda: editor.key(Qt.Key.Key_A),
        lambda: editor.drag_parameter(1, 0.3),
        lambda: editor.wheel((1.0, 1.0), 1),
        lambda: editor.choose_parametrization("uniform"),
        lambda: editor.send(editor.window.canvas, QEvent.Type.MouseButtonRelease, QPoint(9, 9), held=False),
    ):
        with impossible("waits for an answer"):
            gesture()
    box.close()
    editor.trigger("selectAll")
    assert len(editor.session.selection) == len(editor.curve.points)


@pytest.fixture
def quitting_app(qapp):
    """Tell the application to quit while nobody runs it: every later event loop ends at once."""
    qapp.exit(3)
    yield qapp
    repair_loops(qapp)


def repair_loops(qapp):
    """Let event loops run again, as the message says; `quit` would close the windows, too."""
    QTimer.singleShot(0, lambda: qapp.exit(0))
    assert qapp.exec() == 0
    spin(1)


@pytest.mark.parametrize(
    "wait",
    [
        lambda editor: editor.settle(),
        lambda _editor: spin(1),
        lambda editor: editor.wait_for_rest(),
        lambda editor: wait_for_rest(editor.window),
    ],
)
def test_waiting_in_an_application_that_was_told_to_quit_raises(editor, quitting_app, wait):
    late = QTimer(editor.window, singleShot=True, interval=100)
    late.start()
    before = timers_of_nobody()
    with pytest.raises(ApplicationQuitError, match="was asked to quit"):
        wait(editor)
    assert timers_of_nobody() == before
    late.deleteLater()


def test_an_event_loop_that_ends_early_is_reported(qapp, quitting_app):
    with pytest.raises(ApplicationQuitError):
        spin(1)
    repair_loops(qapp)
    QTimer.singleShot(0, lambda: qapp.exit(0))
    with pytest.raises(ApplicationQuitError):
        spin(60_000)


def timers_of_nobody():
    """Return how many active timers have no parent; those of `QTimer.singleShot` are the dispatcher's."""
    timers = [each for each in getAllValidWrappers() if isinstance(each, QTimer) and each.isActive()]
    return sum(each.parent() is None for each in timers) + len(QAbstractEventDispatcher.instance().children())


def test_short_timers_are_fired_in_order_and_slow_ones_are_left(editor):
    editor.wait_for_rest()
    done = []
    timers = {
        name: QTimer(editor.window, singleShot=True, interval=interval)
        for name, interval in (("last", 300), ("slow", 301), ("first", 200), ("never", 250), ("gone", 260))
    }
    for name, timer in timers.items():
        timer.timeout.connect(lambda name=name: done.append(name))
        timer.start()
    follower = QTimer(editor.window, singleShot=True, interval=299)
    follower.timeout.connect(lambda: done.append("follower"))
    timers["last"].timeout.connect(follower.start)
    timers["first"].timeout.connect(timers["never"].stop)
    timers["first"].timeout.connect(lambda: delete(timers["gone"]))
    editor.wait_for_rest()
    assert done == ["first", "last", "follower"]
    assert timers["slow"].isActive()
    for timer in (follower, *timers.values()):
        if isValid(timer):
            timer.stop()
            timer.deleteLater()


def test_a_window_that_never_rests_is_reported(editor, monkeypatch):
    monkeypatch.setattr(waiting, "WAIT_S", 0.05)
    restless = QTimer(editor.window, singleShot=True, interval=1)
    restless.timeout.connect(restless.start)
    restless.start()
    with pytest.raises(TimeoutError, match=r"is not idle within 0.05 s"):
        editor.wait_for_rest()
    restless.stop()
    restless.deleteLater()
