"""A dot that runs along the curve, driven by keys, buttons and a clock of our own."""

from __future__ import annotations

import threading
import time
from itertools import combinations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDoubleSpinBox,
    QFileDialog,
    QLabel,
    QMenu,
    QPushButton,
    QSpinBox,
    QToolButton,
)

from app.actions.keymap import action_name
from app.document import rule_edits
from app.document.derivatives import VelocityRule
from app.document.model import ParametrizationKind
from app.document.words import number
from app.exchange.drawing.film import write_film
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.motion.player import Player
from app.features.motion.stage import MotionBar
from app.view_model.motion import ACTIVE
from app.view_model.motion_settings import Pace
from tests.waiting import LIMIT, until

LEFT = Qt.MouseButton.LeftButton


class Clock:
    """Seconds that pass when a test says so."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


class Motion:
    """The motion of a window, with its clock in our hands."""

    def __init__(self, editor):
        self.editor, self.clock = editor, Clock()
        # Pressing stop, which does nothing yet, makes the player.
        editor.action("motionLoop").trigger()
        self.player = editor.window.findChild(Player)
        self.player.clock = self.clock
        self.bar = editor.window.findChild(MotionBar)

    def wait(self, seconds):
        """Let the clock go on, and the next frame come."""
        self.clock.now += seconds
        self.player.tick()
        self.editor.settle()

    def part(self, kind, name):
        found = self.bar.findChild(kind, name)
        assert found is not None
        return found

    @property
    def t(self):
        return self.editor.session.scrub.t

    @property
    def dots(self):
        return self.editor.window.canvas.drawing.dots


@pytest.fixture
def motion(editor):
    return Motion(editor)


def readout(motion):
    return motion.bar.findChild(QLabel, "motionReadout").text()


def words(motion):
    label = motion.bar.findChild(QLabel, "motionWords")
    return "" if label.isHidden() else label.text()


def span(editor, start, end):
    """Give the parameters an interval of their own."""
    session = editor.session
    session.commit(rule_edits.set_interval(session.document, 0, start, end), "Set the interval")


def test_k_plays_and_pauses(editor, motion):
    assert motion.bar.isHidden()
    editor.key(Qt.Key.Key_K)
    assert editor.action("playMotion").isChecked()
    assert motion.bar.isVisible()
    assert motion.t == 0.0
    motion.wait(0.25)
    assert motion.t == pytest.approx(0.25)
    editor.key(Qt.Key.Key_K)
    assert not motion.player.is_playing
    assert motion.bar.isVisible()
    assert motion.t == pytest.approx(0.25)
    editor.key(Qt.Key.Key_K)
    motion.wait(0.5)
    assert motion.t == pytest.approx(0.75)


def test_the_real_clock_moves_the_dot(editor):
    began = time.perf_counter()
    editor.trigger("playMotion")
    player = editor.window.findChild(Player)
    until(lambda: editor.session.scrub.t > 0.05)
    # Frames may be dropped; the dot is never ahead of the clock.
    assert player.seconds <= time.perf_counter() - began


def test_the_domain_is_in_seconds(editor, motion):
    span(editor, 0.0, 2.5)
    editor.trigger("playMotion")
    motion.wait(2.0)
    assert motion.t == pytest.approx(2.0)
    motion.wait(1.0)
    assert motion.t == pytest.approx(0.5)


def test_canvas_and_basis_panel_show_the_same_dot(editor, motion):
    editor.trigger("playMotion")
    motion.wait(0.3)
    (dot,) = motion.dots
    assert dot.t == pytest.approx(0.3)
    assert editor.window.canvas.drawing.points.scrub[1:] == pytest.approx(dot.position)
    assert [arrow.text[:3] for arrow in dot.arrows] == ["|v|", "|a|"]
    curve = editor.session.active_view.curve
    assert dot.speed == pytest.approx(np.linalg.norm(curve.evaluate(0.3, 1)))
    assert dot.acceleration == pytest.approx(np.linalg.norm(curve.evaluate(0.3, 2)))
    assert len(dot.trail) == 18
    assert readout(motion).startswith("t 0.3   |v| ")


@pytest.mark.parametrize("start", [0.0, 1e6])
@pytest.mark.parametrize("pace", [action_name("motionBy", pace) for pace in Pace])
def test_rail_bar_canvas_and_status_line_show_the_same_t_in_a_frame(editor, motion, pace, start):
    """The bar wrote its numbers every 80 ms and the status line after 33 ms: three t in one frame."""
    editor.window.basis_panel.grab()
    span(editor, start, start + 2.5)
    # A pointer that rests over the panel does not hold the t under it.
    panel = editor.window.basis_panel
    editor.send(panel, QEvent.Type.MouseMove, panel.to_pixel(start + 0.5, 0.5), held=False)
    editor.settle()
    editor.trigger("playMotion")
    editor.trigger(pace)
    status = editor.window.status_line.findChild(QLabel, "pointerT")

    def text_of(t):
        # Thousandths of 2.5, also of 1000002.5.
        return f"t {number(t, step=0.0025)}"

    def assert_one_t():
        t = motion.t
        assert readout(motion).split("   ")[0] == status.text() == text_of(t)
        assert panel.drawing.rail.scrub == t
        (dot,) = motion.dots
        assert dot.t == pytest.approx(t, abs=1e-12, rel=1e-15)
        drawing = editor.window.canvas.drawing
        assert drawing.points.scrub[0] == t
        assert drawing.points.scrub[1:] == pytest.approx(dot.position)

    for seconds in (0.0123, 0.0016, 0.31, 1.7, 0.9):
        # No event between the frame's tick and the look at it.
        motion.clock.now += seconds
        motion.player.tick()
        assert_one_t()
        editor.settle()
        assert_one_t()
    editor.trigger("playMotion")
    editor.scrub(start + 1.1)
    motion.editor.settle()
    assert readout(motion).split("   ")[0] == text_of(motion.t)
    assert panel.drawing.rail.scrub == motion.t


@pytest.mark.parametrize("plays", [False, True])
def test_the_dot_keeps_its_relative_place_when_the_interval_changes(editor, motion, plays):
    editor.trigger("playMotion")
    motion.wait(0.25)
    if not plays:
        editor.trigger("playMotion")
    span(editor, 0.0, 2.5)
    assert motion.t == pytest.approx(0.625)
    assert motion.player.is_playing == plays
    if not plays:
        editor.trigger("playMotion")
    motion.wait(1.0)
    assert motion.t == pytest.approx(1.625)
    editor.trigger("undo")
    assert motion.t == pytest.approx(0.65)
    motion.wait(0.1)
    assert motion.t == pytest.approx(0.75)


def test_a_late_frame_drops_others(editor, motion):
    editor.trigger("playMotion")
    motion.wait(0.016)
    motion.wait(0.4)
    assert motion.t == pytest.approx(0.416)


def test_speed_by_keys_and_by_box(editor, motion):
    editor.trigger("playMotion")
    editor.key(Qt.Key.Key_J)
    motion.wait(0.2)
    assert motion.t == pytest.approx(0.1)
    editor.key(Qt.Key.Key_L)
    editor.key(Qt.Key.Key_L)
    motion.wait(0.2)
    assert motion.t == pytest.approx(0.5)
    box = motion.part(QComboBox, "motionSpeed")
    assert box.currentText() == "2×"
    QTest.keyClick(box, Qt.Key.Key_Home)
    motion.wait(1.0)
    assert motion.t == pytest.approx(0.6)
    editor.key(Qt.Key.Key_J)
    assert motion.player.settings.speed == 0.1


def test_a_motion_played_once_stops_at_the_end_and_can_start_again(editor, motion):
    editor.trigger("motionOnce")
    editor.trigger("playMotion")
    motion.wait(7.0)
    assert motion.t == 1.0
    assert not motion.player.is_playing
    assert not editor.action("playMotion").isChecked()
    editor.trigger("playMotion")
    assert motion.t == 0.0


def test_a_ping_pong_runs_backwards_from_the_end(editor, motion):
    box = motion.part(QComboBox, "motionRepeat")
    editor.trigger("playMotion")
    QTest.keyClick(box, Qt.Key.Key_End)
    assert editor.action("motionPingPong").isChecked()
    motion.wait(1.25)
    assert motion.t == pytest.approx(0.75)
    motion.wait(0.5)
    assert motion.t == pytest.approx(0.25)


def test_by_arc_length_the_dot_has_a_constant_speed(editor, motion):
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    editor.trigger("playMotion")
    editor.trigger("motionByLength")
    assert motion.part(QComboBox, "motionPace").currentText() == "By Arc Length"
    speeds = []
    for _ in range(6):
        motion.wait(0.15)
        speeds.append(motion.dots[0].speed)
    assert np.ptp(speeds) <= 1e-9 * speeds[0]


def test_escape_stops_the_motion_and_restores_the_scrub_line(editor, motion):
    editor.scrub(0.4)
    before = editor.session.scrub.t
    editor.trigger("playMotion")
    motion.wait(0.2)
    assert motion.t == pytest.approx(before + 0.2)
    editor.escape()
    assert motion.t == before
    assert motion.bar.isHidden()
    assert motion.dots == ()
    assert not editor.action("stopMotion").isEnabled()
    editor.escape()
    assert motion.t is None


def test_escape_first_cancels_the_drag(editor, motion):
    editor.trigger("playMotion")
    x, y = editor.point(1)
    editor.press((x, y))
    editor.move((x + 0.5, y))
    editor.escape()
    assert editor.point(1) == (x, y)
    assert motion.player.is_playing
    editor.release((x, y))
    editor.escape()
    assert not motion.player.is_open


def test_points_can_be_dragged_during_a_motion(editor, motion):
    editor.choose_family(HERMITE)
    editor.trigger("playMotion")
    motion.wait(0.3)
    x, y = editor.point(2)
    editor.press((x, y))
    for step in range(1, 6):
        editor.move((x + 0.1 * step, y + 0.1 * step))
        motion.wait(0.02)
        (dot,) = motion.dots
        curve = editor.session.active_view.curve
        assert dot.position == pytest.approx(curve.evaluate(dot.t))
    editor.release((x + 0.5, y + 0.5))
    assert editor.point(2) == pytest.approx((x + 0.5, y + 0.5), abs=editor.pixel)
    assert editor.session.undo_stack.undoText().startswith("Move")
    assert motion.t == pytest.approx(0.4)
    editor.trigger("undo")
    assert editor.point(2) == (x, y)
    assert motion.player.is_playing


def test_a_shorter_domain_does_not_stop_the_motion(editor, motion):
    span(editor, 0.0, 4.0)
    editor.trigger("playMotion")
    motion.wait(3.0)
    span(editor, 0.0, 1.0)
    # At three quarters, as before.
    motion.wait(0.15)
    assert motion.player.is_playing
    assert motion.t == pytest.approx(0.9)


def test_the_scrub_line_stays_where_it_was_dragged_when_the_motion_ends(editor, motion):
    """Dragged from 1.498 to 1.077 beside a paused motion, it went back at Escape."""
    editor.scrub(0.4)
    editor.trigger("playMotion")
    motion.wait(0.2)
    editor.trigger("playMotion")
    editor.scrub(0.7)
    dragged = motion.t
    editor.escape()
    assert motion.bar.isHidden()
    assert motion.t == dragged


def test_dragging_the_scrub_line_pauses_the_dot_there(editor, motion):
    editor.trigger("playMotion")
    motion.wait(0.2)
    editor.scrub(0.7)
    assert not motion.player.is_playing
    assert motion.dots[0].t == pytest.approx(0.7, abs=0.01)
    at = motion.t
    editor.trigger("playMotion")
    motion.wait(0.1)
    assert motion.t == pytest.approx(at + 0.1)


def test_hiding_the_scrub_line_ends_the_motion(editor, motion):
    editor.trigger("playMotion")
    editor.trigger("toggleScrub")
    assert motion.t is None
    assert motion.bar.isHidden()


def test_without_a_curve_the_dot_is_hidden_and_the_bar_gives_the_reason(editor, motion):
    editor.trigger("playMotion")
    motion.wait(0.2)
    editor.session.selected.set_points(range(len(editor.curve.points)))
    editor.trigger("deleteSelection")
    motion.wait(0.2)
    assert motion.dots == ()
    assert readout(motion) == "A curve needs at least two points."
    editor.trigger("undo")
    motion.wait(0.1)
    assert motion.dots[0].t == pytest.approx(0.3)
    editor.new()
    assert motion.bar.isHidden()
    assert not editor.action("playMotion").isEnabled()


def test_cubic_beside_quintic(editor, motion):
    session = editor.session
    editor.choose_family(HERMITE)
    session.commit(rule_edits.set_rule(session.document, 0, VelocityRule.CATMULL_ROM), "Rule")
    editor.trigger("motionWithQuinticHermite")
    assert motion.player.is_playing
    motion.wait(0.3)
    own, cubic, quintic = motion.dots
    assert own.role is ACTIVE
    assert (cubic.role.families, quintic.role.families) == ((HERMITE,), (QUINTIC_HERMITE,))
    assert own.position == cubic.position != quintic.position
    assert "Hermite: acceleration jumps at 6 of 6 joints" in words(motion)
    assert "Quintic: no jump of acceleration." in words(motion)
    assert editor.session.document.curves[0].family == HERMITE
    editor.trigger("motionWithQuinticHermite")
    motion.wait(0.1)
    assert len(motion.dots) == 1
    assert words(motion) == ""


def test_all_families_that_go_through_the_points_run_side_by_side(editor, motion):
    session = editor.session
    editor.choose_family(HERMITE)
    session.commit(rule_edits.set_rule(session.document, 0, VelocityRule.CATMULL_ROM), "Rule")
    editor.trigger("motionCompare")
    motion.wait(0.3)
    own, *others = motion.dots
    timed = [family for family in FAMILIES if family.interpolates]
    assert [family for dot in others for family in dot.role.families] == timed
    assert len(timed) >= 6
    assert not editor.window.findChild(QAction, "motionWithBezier")
    for family in timed:
        action = editor.action(family.action_name.replace("family", "motionWith"))
        assert action.isChecked()
        assert action.text().replace("&", "") == f"Compare with {family.label}"
        assert family.short in words(motion)
    # Each of its own colour, one ring within the other where they meet.
    assert len({dot.role.colour for dot in others}) == len(others)
    radii = [dot.role.radius for dot in others]
    assert radii == sorted(radii, reverse=True)
    assert min(radii) > own.role.radius
    # Their names do not cover each other, though they are all but in one place.
    written = editor.window.canvas.drawing._motion._plates
    assert len(written) == len(others)
    assert not any(one.intersects(other) for one, other in combinations(written, 2))
    # One of them less.
    editor.trigger("motionWithLagrange")
    motion.wait(0.1)
    assert LAGRANGE not in [family for dot in motion.dots for family in dot.role.families]
    assert not editor.action("motionCompare").isChecked()
    editor.trigger("motionCompare")
    editor.trigger("motionCompare")
    motion.wait(0.1)
    assert len(motion.dots) == 1


def test_identical_curves_share_one_dot(editor, motion):
    """By the natural rules the cubic pieces, the quintic ones and the spline are one curve."""
    editor.choose_family(HERMITE)
    editor.trigger("motionCompare")
    motion.wait(0.1)
    names = [[family.name for family in dot.role.families] for dot in motion.dots]
    assert ["hermite", "quintic_hermite", "cubic_spline"] in names
    assert "Hermite, Quintic, Spline: no jump of acceleration (its velocities are those of" in words(motion)


def test_another_theme_keeps_the_icon_of_pause(editor, motion):
    button = motion.part(QToolButton, "playPauseButton")
    editor.trigger("playMotion")
    pause = button.icon().cacheKey()
    editor.trigger("themeDark")
    assert button.accessibleName() == "Pause"
    assert button.icon().cacheKey() != pause
    editor.trigger("themeLight")
    assert button.icon().cacheKey() == pause
    QTest.mouseClick(button, LEFT)
    assert not motion.player.is_playing


@pytest.mark.parametrize("size", [(1024, 700), (1400, 900)])
def test_no_text_of_the_bar_is_cut_off(editor, motion, size):
    editor.window.resize(*size)
    editor.trigger("playMotion")
    motion.wait(0.1)
    bar = motion.bar
    assert all(
        bar.rect().contains(child.geometry())
        for child in bar.findChildren(QToolButton) + bar.findChildren(QComboBox)
        if child.isVisible() and child.parent() is bar
    )
    play = editor.window.toolbar.widgetForAction(editor.action("playMotion"))
    assert play.isVisible()


# Export


def export(editor, motion, path, **fields):
    """Fill the dialog in by keys, and answer the question for a file."""
    editor.trigger("exportMotion")
    dialog = editor.window.findChild(QDialog, "motionDialog")
    kinds = {"filmWidth": QSpinBox, "filmFps": QSpinBox, "filmSeconds": QDoubleSpinBox}
    for name, value in fields.items():
        box = dialog.findChild(kinds[name], name)
        box.selectAll()
        QTest.keyClicks(box, str(value))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
        QTest.mouseClick(dialog.findChild(QPushButton, "filmExport"), LEFT)


def test_a_motion_is_exported(editor, motion, tmp_path):
    path = tmp_path / "film.gif"
    export(editor, motion, path, filmWidth=160, filmFps=10, filmSeconds=2)
    assert editor.window.context.work.jobs.title == "Writing film.gif"
    until(lambda: not editor.window.context.work.jobs.is_busy)
    with Image.open(path) as film:
        assert (film.n_frames, film.width, film.info["duration"]) == (20, 160, 100)
    assert "Exported film.gif: 20 frames." in editor.status
    assert motion.bar.isHidden()


def test_the_window_stays_usable_while_a_film_is_written(editor, motion, tmp_path, monkeypatch):
    beat, frames = threading.Event(), []

    def write_to_the_beat(document, path, film, report):
        def report_frame(share, word):
            beat.clear()
            assert beat.wait(LIMIT), "the window does not go on between two frames"
            frames.append(share)
            report(share, word)

        write_film(document, path, film, report=report_frame)

    monkeypatch.setattr("app.features.motion.export.write_film", write_to_the_beat)
    timer = QTimer(editor.window, interval=1)
    timer.timeout.connect(beat.set)
    timer.start()
    export(editor, motion, tmp_path / "film.apng", filmWidth=64, filmSeconds=1)
    until(lambda: not editor.window.context.work.jobs.is_busy)
    timer.stop()
    assert len(frames) > 10
    assert (tmp_path / "film.apng").exists()


@pytest.fixture
def immediate_progress(editor):
    """Have the window show at once what takes long: while it waits the film is written in vain."""
    patience = editor.window.context.work.jobs._patience
    usual = patience.interval()
    patience.setInterval(0)
    yield
    patience.setInterval(usual)


def test_a_cancelled_export_leaves_no_file(editor, motion, immediate_progress, tmp_path):
    export(editor, motion, tmp_path / "film.gif", filmWidth=200, filmSeconds=40)

    def is_offered():
        # Another film may have left the button here, out of sight.
        stop = editor.window.findChild(QToolButton, "cancelJobButton")
        return stop is not None and stop.isVisible()

    until(is_offered)
    stop = editor.window.findChild(QToolButton, "cancelJobButton")
    QTest.mouseClick(stop, LEFT)
    assert not editor.window.context.work.jobs.is_busy
    assert editor.status == "Writing film.gif was stopped. Nothing has changed."
    assert not stop.isVisible()
    assert list(tmp_path.iterdir()) == []


def test_a_failed_export_gives_the_reason(editor, motion, tmp_path):
    export(editor, motion, tmp_path / "no" / "film.gif", filmWidth=64, filmSeconds=1)
    until(lambda: not editor.window.context.work.jobs.is_busy)
    assert editor.message.startswith("film.gif was not written. The folder of")


def test_closing_the_window_ends_the_export(editor, motion, tmp_path):
    export(editor, motion, tmp_path / "film.gif", filmWidth=200, filmSeconds=40)
    editor.session.files.give_up_changes()
    editor.window.close()
    assert list(tmp_path.iterdir()) == []
    assert not editor.window.context.work.jobs.is_busy
    assert not [each for each in threading.enumerate() if each.name == "work"]


def test_the_dialog_counts_frames_and_knows_its_limits(editor, motion):
    editor.trigger("exportMotion")
    dialog = editor.window.findChild(QDialog, "motionDialog")
    count = dialog.findChild(QLabel, "filmFrames")
    assert count.text() == "25 frames"
    seconds = dialog.findChild(QDoubleSpinBox, "filmSeconds")
    seconds.selectAll()
    QTest.keyClicks(seconds, "100")
    assert count.text() == "2500 frames; at most 1200 are possible"
    assert not dialog.findChild(QPushButton, "filmExport").isEnabled()


def test_a_number_outside_the_limits_of_a_film_is_refused(editor, motion):
    """Of 60 frames a second, 6 was left in the box without a word."""
    editor.trigger("exportMotion")
    dialog = editor.window.findChild(QDialog, "motionDialog")
    said, button = dialog.findChild(QLabel, "filmFrames"), dialog.findChild(QPushButton, "filmExport")
    for name, kind, typed, problem in (
        ("filmFps", QSpinBox, "60", "Frames per second: from 1 to 50."),
        ("filmFps", QSpinBox, "0", "Frames per second: from 1 to 50."),
        ("filmWidth", QSpinBox, "5000", "Width: from 64 to 1920."),
        ("filmSeconds", QDoubleSpinBox, "4000", "Length: from 0.1 to 3600."),
        ("filmSeconds", QDoubleSpinBox, "-2", "Length: from 0.1 to 3600."),
    ):
        box = dialog.findChild(kind, name)
        before = box.value()
        box.selectAll()
        QTest.keyClicks(box, typed)
        assert box.value() == float(typed)
        assert said.text() == problem
        assert not button.isEnabled()
        box.selectAll()
        QTest.keyClicks(box, f"{before:g}")
        assert button.isEnabled()
    fps = dialog.findChild(QSpinBox, "filmFps")
    fps.setValue(49)
    for _ in range(3):
        QTest.keyClick(fps, Qt.Key.Key_Up)
    assert fps.value() == 50


def test_the_parts_of_a_motion_are_made_at_the_first_use(new_editor):
    window = new_editor.window
    assert window.findChild(Player) is None
    assert window.findChild(MotionBar) is None
    new_editor.send(window.canvas, QEvent.Type.MouseMove, window.canvas.to_pixel(0, 0), held=False)
    assert window.canvas.drawing.dots == ()


def test_the_boxes_of_the_bar_have_the_texts_of_the_menu(new_editor):
    """With the menu opened first, the box said “By &Arc Length”."""
    for menu in new_editor.window.menuBar().findChildren(QMenu):
        menu.aboutToShow.emit()
    new_editor.trigger("playMotion")
    box = new_editor.window.findChild(QComboBox, "motionPace")
    assert [box.itemText(index) for index in range(box.count())] == ["By t", "By Arc Length"]


def test_weights_are_hidden_for_the_dot_and_restored(editor):
    editor.scrub(0.4)
    assert editor.window.canvas.drawing.points.weights is not None
    editor.trigger("playMotion")
    until(lambda: editor.window.canvas.drawing.dots)
    assert editor.window.canvas.drawing.points.weights is None
    editor.trigger("stopMotion")
    assert editor.window.canvas.drawing.points.weights is not None


def test_keys_typed_beside_a_field_of_the_dialog_do_not_change_the_curve(editor, qtbot):
    """In a tool window, "1" used to make the curve behind it a Lagrange curve."""
    editor.choose_family("hermite")
    editor.trigger("exportMotion")
    dialog = editor.window.findChild(QDialog, "motionDialog")
    assert dialog.windowType() is Qt.WindowType.Dialog
    dialog.setFocus()
    qtbot.keyClick(dialog, Qt.Key.Key_1)
    assert editor.curve.family is HERMITE
    dialog.close()
