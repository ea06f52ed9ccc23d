"""The t-rail: several ticks, ripple, typed values, starts, nudges and the ghost, with real events."""

from __future__ import annotations

from decimal import Decimal

import numpy as np
import pytest
from event_count import layouts_of
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QSlider, QWidget

from app.document.curve_edits import set_closed
from app.document.model import ParametrizationKind
from app.document.rule_edits import set_parameter
from app.document.transforms import round_step_above
from app.families import FAMILIES, HERMITE
from curvecore import centripetal, chebyshev, chebyshev_roots, chord_length, uniform
from tests.waiting import until

SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def panel(editor):
    return editor.window.basis_panel


def pixels(panel, count=1.0):
    return count / panel.pixel_map.sx


# Several ticks


def test_shift_click_adds_to_and_removes_from_the_selection(editor):
    editor.rail.click(2)
    editor.rail.click(4, keys=SHIFT)
    editor.rail.click(5, keys=SHIFT)
    assert editor.session.selection == {2, 4, 5}
    editor.rail.click(4, keys=SHIFT)
    assert editor.session.selection == {2, 5}
    editor.rail.click(5)
    assert editor.session.selection == {5}
    assert editor.session.undo_stack.count() == 0


def test_a_drag_of_a_selected_tick_moves_all_selected_ticks(editor, panel):
    old = np.array(editor.parameters)
    editor.select([2, 3])
    editor.drag_parameter(3, to=old[3] + 0.05)
    moved = np.array(editor.parameters) - old
    assert moved[[2, 3]] == pytest.approx(0.05, abs=pixels(panel, 1.5))
    assert moved[2] == pytest.approx(moved[3], abs=1e-15)
    assert (moved[[0, 1, 4, 5, 6, 7]] == 0).all()
    assert editor.session.selection == {2, 3}
    assert editor.session.undo_stack.undoText() == "Change t of 2 points"
    editor.trigger("undo")
    assert editor.parameters == old.tolist()


def test_a_drag_of_a_tick_that_is_not_selected_moves_only_that_tick(editor):
    old = editor.parameters
    editor.select([2, 3])
    editor.drag_parameter(5, to=old[5] + 0.05)
    assert editor.session.selection == {5}
    assert editor.parameters[:5] == old[:5]


@pytest.mark.parametrize("to", [-0.4, 1.4])
def test_ticks_keep_their_order_in_a_drag_of_any_length(editor, to):
    for chosen in ([2, 3], [1, 4, 5], [0, 6], [0, 7], list(range(8))):
        editor.select(chosen)
        before = editor.session.document
        editor.drag_parameter(chosen[0], to=to)
        assert editor.session.document is not before, chosen
        assert (np.diff(editor.parameters) > 0).all(), chosen
        assert editor.session.active_view.is_current, chosen
        editor.trigger("undo")
        assert editor.session.document is before


def test_the_end_ticks_can_be_dragged_and_a_closed_curve_keeps_its_closing_knot(editor):
    editor.choose_family(HERMITE)
    editor.run_command("centripetal")
    editor.session.commit(set_closed(editor.session.document, 0, True), "Close")
    old = editor.parameters
    editor.select([6, 7])
    editor.drag_parameter(7, to=old[7] - 0.03)
    assert len(editor.parameters) == 9
    assert editor.parameters[8] == old[8]
    assert editor.parameters[6] < old[6]


# Ripple


@pytest.mark.parametrize(("by", "moving"), [(0.04, [3, 4, 5, 6, 7]), (-0.04, [0, 1, 2, 3])])
def test_with_e_all_ticks_on_one_side_move_along(editor, panel, by, moving):
    old = np.array(editor.parameters)
    panel.setFocus()
    QTest.keyPress(panel, Qt.Key.Key_E)
    editor.drag_parameter(3, to=old[3] + by)
    QTest.keyRelease(panel, Qt.Key.Key_E)
    moved = np.array(editor.parameters) - old
    assert moved[moving] == pytest.approx(by, abs=pixels(panel, 1.5))
    assert np.ptp(moved[moving]) < 1e-15
    assert np.delete(moved, moving) == pytest.approx(0, abs=0)
    editor.trigger("undo")
    editor.drag_parameter(3, to=old[3] + 0.04)
    assert np.count_nonzero(np.array(editor.parameters) - old) == 1


def test_e_acts_during_the_drag_and_escape_restores_all_ticks(editor, panel):
    document, old = editor.session.document, editor.parameters
    start = panel.rail_pixel(old[3])
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    QTest.keyPress(panel, Qt.Key.Key_E)
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(20, 0))
    assert editor.parameters[7] > old[7]
    QTest.keyClick(panel, Qt.Key.Key_Escape)
    QTest.keyRelease(panel, Qt.Key.Key_E)
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(20, 0), held=False)
    assert editor.session.document is document
    assert editor.session.undo_stack.count() == 0


def test_the_hint_names_all_gestures_on_a_tick(editor, panel):
    editor.send(panel, QEvent.Type.MouseMove, panel.rail_pixel(editor.parameters[3]), held=False)
    hint = editor.window.status_line.hint
    for word in ("point 3", "E:", "Shift+click", "Double-click"):
        assert word in hint
    editor.select([2, 3])
    editor.send(
        panel, QEvent.Type.MouseMove, panel.rail_pixel(editor.parameters[3]) + QPointF(1, 0), held=False
    )
    assert "2 points" in editor.window.status_line.hint


# Typed values


def test_a_double_click_types_a_value(editor, panel):
    editor.rail.type(3, "2/5")
    assert editor.parameters[3] == 0.4
    assert not panel.tick_edit.isVisible()
    assert panel.hasFocus()
    assert editor.session.undo_stack.count() == 1
    assert editor.session.undo_stack.undoText() == "Change t of point 3"


NO_PARAMETERS = {
    "0": "must be greater than",
    "0.9": "must be less than",
    "half": "half",
    "": "missing",
}


def test_a_value_that_cannot_be_is_explained_at_the_tick(editor, panel):
    document = editor.session.document
    for typed, reason in NO_PARAMETERS.items():
        if typed:
            editor.rail.type(3, typed)
        else:
            panel.edit_tick(3)
            panel.tick_edit.line.clear()
            QTest.keyClick(panel.tick_edit.line, Qt.Key.Key_Return)
        assert panel.tick_edit.isVisible(), typed
        assert reason in panel.tick_edit.problem
        assert editor.session.document is document, typed
        QTest.keyClick(panel.tick_edit.line, Qt.Key.Key_Escape)
        assert not panel.tick_edit.isVisible(), typed
        assert editor.session.document is document, typed


def test_an_untouched_value_is_no_change(editor, panel):
    document = editor.session.document
    editor.trigger("freezeParameters")
    frozen = editor.session.document
    panel.edit_tick(3)
    QTest.keyClick(panel.tick_edit.line, Qt.Key.Key_Return)
    assert editor.session.document is frozen
    assert document is not frozen


def test_a_click_elsewhere_closes_the_line_at_a_tick(editor, panel):
    panel.edit_tick(3)
    editor.click((-1.0, -0.2))
    assert not panel.tick_edit.isVisible()


def test_the_action_types_at_the_selected_point(editor, panel):
    assert not editor.action("typeParameter").isEnabled()
    editor.select([4])
    editor.trigger("typeParameter")
    assert panel.tick_edit.isVisible()
    assert panel.tick_edit.line.hasFocus()
    QTest.keyClicks(panel.tick_edit.line, "0.5")
    QTest.keyClick(panel.tick_edit.line, Qt.Key.Key_Return)
    assert editor.parameters[4] == 0.5


# Starts


STARTS = [
    ("startUniform", lambda points: uniform(len(points))),
    ("startChordLength", chord_length),
    ("startCentripetal", centripetal),
    ("startChebyshev", lambda points: chebyshev(len(points))),
    ("startChebyshevRoots", lambda points: chebyshev_roots(len(points))),
]


def test_manual_parameters_start_from_a_rule(editor):
    for name, rule in STARTS:
        editor.trigger(name)
        points = np.array([point.position for point in editor.curve.points])
        assert editor.parameters == pytest.approx(rule(points).tolist()), name
        assert editor.curve.parametrization.kind is ParametrizationKind.MANUAL, name
        assert editor.session.undo_stack.count() == 1, name
        editor.trigger("undo")


def test_a_start_keeps_the_interval(editor):
    editor.trigger("startUniform")
    editor.drag_parameter(7, to=1.02)
    end = editor.parameters[7]
    editor.trigger("startChebyshev")
    assert editor.parameters[0] == 0.0
    assert editor.parameters[7] == end


@pytest.mark.qt_log_ignore("grabbing the (keyboard|mouse)")
def test_a_right_click_opens_the_menu_of_the_rail_and_selects_the_tick(editor, panel):
    place = panel.rail_pixel(editor.parameters[4]).toPoint()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, panel.viewport().mapToGlobal(place))
    QApplication.sendEvent(panel.viewport(), event)
    menu = editor.window.findChild(QMenu, "railMenu")
    assert menu.isVisible()
    assert editor.session.selection == {4}
    names = [action.objectName() for action in menu.actions() if not action.isSeparator()]
    assert names == [
        "typeParameter",
        "startUniform",
        "startChordLength",
        "startCentripetal",
        "startChebyshev",
        "startChebyshevRoots",
        "freezeParameters",
    ]
    menu.close()


# Nudging


@pytest.mark.parametrize(
    ("key", "held", "count"),
    [
        (Qt.Key.Key_Right, Qt.KeyboardModifier.NoModifier, 1),
        (Qt.Key.Key_Left, SHIFT, -10),
        (Qt.Key.Key_Right, CTRL, 0.1),
    ],
)
def test_arrows_nudge_the_selected_ticks(editor, panel, key, held, count):
    """By 0.0012239902080783353, the width of a pixel."""
    old = np.array(editor.parameters)
    editor.select([3, 4])
    panel.setFocus()
    QTest.keyClick(panel, key, held)
    moved, step = np.array(editor.parameters) - old, round_step_above(2 * pixels(panel, 1))
    assert moved[[3, 4]] == pytest.approx(count * step, rel=1e-9)
    assert [editor.parameters[at] for at in (3, 4)] == [
        float(Decimal(repr(float(old[at]))) + Decimal(repr(round(count * step, 9)))) for at in (3, 4)
    ]
    assert np.count_nonzero(np.delete(moved, [3, 4])) == 0
    assert editor.session.undo_stack.count() == 1
    editor.trigger("undo")
    assert editor.parameters == old.tolist()


def test_arrows_without_a_selection_do_nothing(editor, panel):
    panel.setFocus()
    QTest.keyClick(panel, Qt.Key.Key_Right)
    assert editor.session.undo_stack.count() == 0


# The ghost


def until_it_faded(canvas):
    """Wait for the end of the fading; how long all of it takes is not the question."""
    fading = canvas.drawing.curve._fade
    fading.setCurrentTime(max(fading.currentTime(), fading.duration() - 50))
    until(lambda: canvas.drawing.curve.ghost_opacity == 0)


def test_a_ghost_of_the_curve_stays_while_a_tick_is_dragged_and_then_fades(editor, panel):
    canvas = editor.window.canvas
    start = panel.rail_pixel(editor.parameters[3])
    assert canvas.drawing.curve.ghost_opacity == 0
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    for way in (10, 20, 30):
        editor.send(panel, QEvent.Type.MouseMove, start + QPointF(way, 0))
        editor.settle()
        assert canvas.drawing.curve.ghost_opacity == 1
    editor.send(panel, QEvent.Type.MouseButtonRelease, start + QPointF(30, 0), held=False)
    assert 0 < canvas.drawing.curve.ghost_opacity <= 1
    until_it_faded(canvas)


def test_a_ghost_goes_with_a_point_that_is_inserted(editor):
    curve = editor.window.canvas.drawing.curve
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    curve._fade.pause()
    curve._fade.setCurrentTime(0)
    assert curve._ghost is not None
    editor.select([2, 3])
    count = len(editor.curve.points)
    editor.key(Qt.Key.Key_Insert)
    assert len(editor.curve.points) == count + 1
    assert curve._ghost is None
    assert curve.ghost_opacity == 0


def test_a_ghost_that_fades_is_painted_in_few_steps(editor):
    curve = editor.window.canvas.drawing.curve
    curve.show_ghost(editor.window.canvas.pixel_map)
    curve._fade.pause()
    opacities = []
    for time in range(curve._fade.duration()):
        before = curve._fade.currentValue()
        curve._fade.setCurrentTime(time)
        if curve._fade.currentValue() != before:
            opacities.append(curve._fade.currentValue())
    assert 12 <= len(opacities) <= 20
    assert opacities == sorted(opacities, reverse=True)


def test_a_cancelled_drag_removes_the_ghost(editor, panel):
    canvas = editor.window.canvas
    start = panel.rail_pixel(editor.parameters[3])
    editor.send(panel, QEvent.Type.MouseButtonPress, start)
    editor.send(panel, QEvent.Type.MouseMove, start + QPointF(20, 0))
    editor.key(Qt.Key.Key_Escape)
    editor.send(panel, QEvent.Type.MouseButtonRelease, start, held=False)
    until_it_faded(canvas)


def test_the_alpha_slider_shows_a_ghost(editor):
    canvas, slider = editor.window.canvas, editor.window.findChild(QSlider, "alphaSlider")
    at_press = canvas.drawing.curve.polyline(canvas.pixel_map).points
    slider.setSliderDown(True)
    slider.setSliderPosition(70)
    slider.setSliderPosition(20)
    assert canvas.drawing.curve.ghost_opacity == 1
    # It was the curve of the step before.
    assert canvas.drawing.curve._ghost is at_press
    slider.setSliderDown(False)
    assert canvas.drawing.curve.ghost_opacity > 0


# The right button takes a drag back


@pytest.mark.parametrize("what", ["tick", "scrub line", "pan"])
def test_a_right_press_cancels_a_drag_and_opens_no_menu(editor, panel, what):
    document, scrub = editor.session.document, editor.session.scrub.t
    t = editor.parameters[3]
    rail = what == "tick"
    start = panel.rail_pixel(t) if rail else QPointF(panel.to_pixel(t + 0.02, 1.1))
    button = Qt.MouseButton.MiddleButton if what == "pan" else Qt.MouseButton.LeftButton
    away = start + QPointF(12, 0)
    editor.send(panel, QEvent.Type.MouseMove, start, held=False)
    editor.send(panel, QEvent.Type.MouseButtonPress, start, button=button)
    editor.send(panel, QEvent.Type.MouseMove, away, button=button)
    assert (editor.session.document != document) is rail
    assert (editor.session.scrub.t != scrub) is (what == "scrub line")
    right = Qt.MouseButton.RightButton
    editor.send(panel, QEvent.Type.MouseButtonPress, away, button=right)
    menu = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, away.toPoint(), QPoint())
    QApplication.sendEvent(panel.viewport(), menu)
    editor.send(panel, QEvent.Type.MouseButtonRelease, away, button=right)
    assert QApplication.activePopupWidget() is None
    editor.send(panel, QEvent.Type.MouseMove, away + QPointF(9, 0), button=button)
    editor.send(panel, QEvent.Type.MouseButtonRelease, away, held=False, button=button)
    assert editor.session.document is document
    assert editor.session.scrub.t == scrub
    assert editor.session.undo_stack.count() == 0
    # The next right press is one like any other.
    editor.send(panel, QEvent.Type.MouseButtonPress, away, button=right)
    QApplication.sendEvent(panel.viewport(), menu)
    assert isinstance(QApplication.activePopupWidget(), QMenu)
    QApplication.activePopupWidget().close()


# The cost of a drag


def test_a_drag_does_not_lay_the_window_out_at_every_move(new_editor):
    """Labels whose text changed had it done 400 times in a drag of 400 moves: a tenth of every frame."""
    editor, panel = new_editor, new_editor.window.basis_panel
    layouts = layouts_of(editor.window)
    for family in FAMILIES:
        editor.choose_family(family)
        start = panel.rail_pixel(editor.parameters[3])
        editor.send(panel, QEvent.Type.MouseButtonPress, start)
        editor.send(panel, QEvent.Type.MouseMove, start + QPointF(8, 0))
        editor.settle()
        layouts.count = 0
        for step in range(10):
            editor.send(panel, QEvent.Type.MouseMove, start + QPointF(8 + step, 0))
            panel.viewport().repaint()
            QApplication.processEvents()
        editor.send(panel, QEvent.Type.MouseButtonRelease, start, held=False)
        assert layouts.count <= 4, family
        editor.trigger("undo")


@pytest.mark.parametrize("width", [1200, 760])
def test_changed_digits_of_a_note_cause_no_layout(editor, width):
    """Whenever the note on the functions was written, the window was laid out: in a drag all the time."""
    editor.window.resize(width, 800)
    editor.settle()
    pane, before = editor.window.central["basisPane"], editor.parameters
    notes = []
    for step in range(3):
        t = before[4] - 0.02 - 1e-3 * step
        editor.session.preview(set_parameter(editor.session.committed, 0, 3, t, before))
        editor.wait_for_rest()
        if not notes:
            layouts = layouts_of(editor.window)
        notes.append(pane.findChild(QWidget, "basisExtent").toolTip())
    assert len(set(notes)) == 3
    assert layouts.count == 0
    editor.session.cancel()
