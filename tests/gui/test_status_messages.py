"""Status line, hints and offers: each message lasts as long as the state that it describes."""

from __future__ import annotations

import re

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QEnterEvent, QGuiApplication, QImage, QStatusTipEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QSlider, QToolButton

from app.document import rule_edits
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.point_table.commands import PointTableCommands
from app.features.reference_image.commands import ImageCommands
from app.workbench import status_line
from tests.waiting import until

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def pair(waves):
    """Two Hermite waves; B, the upper one, is active."""
    return waves("AB")


def offer(editor):
    editor.session.offer("A rule gives the parameters.", "freezeParameters")
    assert editor.message == "A rule gives the parameters."


def enter(widget):
    """Move the pointer onto a widget, as the window system reports it."""
    middle = QPointF(widget.rect().center())
    place = widget.mapToGlobal(middle)
    QApplication.sendEvent(widget, QEnterEvent(middle, middle, place))
    QTest.mouseMove(widget, middle.toPoint())


def displayed_t(editor):
    editor.wait_for_rest(up_to_ms=50)
    return editor.window.status_line.findChild(QLabel, "pointerT").text()


def offer_button(editor):
    return editor.window.message_bar.findChild(QToolButton, "offeredAction")


def test_the_offer_stays_under_the_pointer(pair):
    before = pair.session.active_view
    offer(pair)
    button = offer_button(pair)
    enter(button)
    pair.settle()
    assert button.isVisible()
    assert pair.status == pair.action("freezeParameters").statusTip()
    QTest.mouseClick(button, LEFT)
    pair.settle()
    assert pair.curve.is_manual
    assert pair.message == ""
    pair.trigger("undo")
    assert pair.session.active_view.source == before.source


@pytest.mark.parametrize(
    "act",
    [
        lambda editor: editor.trigger("undo"),
        lambda editor: editor.trigger("familyLagrange"),
        lambda editor: editor.trigger("reverseCurve"),
        lambda editor: editor.session.selected.activate(0),
        lambda editor: editor.new(),
        lambda editor: editor.window.message_bar.findChild(QToolButton, "closeMessage").click(),
    ],
)
def test_the_offered_button_disappears_with_the_reason_for_the_offer(pair, act):
    pair.drag_point(1, to=(1.2, 4.2))
    offer(pair)
    act(pair)
    pair.settle()
    assert not offer_button(pair).isVisible()
    assert "A rule gives" not in pair.message + pair.status


def test_a_tip_replaces_the_status_until_the_pointer_leaves(pair):
    pair.session.say("Something.")
    button = pair.window.toolbar.widgetForAction(pair.action("fitView"))
    QApplication.sendEvent(button, QStatusTipEvent("Show everything"))
    assert pair.status == "Show everything"
    QApplication.sendEvent(button, QStatusTipEvent(""))
    assert pair.status == "Something."
    QApplication.sendEvent(button, QStatusTipEvent("Show everything"))
    pair.session.say("Done.")
    assert pair.status == "Done."


@pytest.mark.parametrize(
    "act",
    [
        lambda editor: editor.trigger("familyLagrange"),
        lambda editor: editor.session.undo_stack.undo(),
        lambda editor: editor.session.selected.activate(0),
        lambda editor: editor.session.new(),
    ],
)
def test_the_status_is_cleared_with_its_document(pair, act):
    pair.session.say("Old.")
    act(pair)
    assert pair.status == ""


def test_undo_and_redo_report_the_undone_or_redone_step(pair):
    pair.drag_point(1, to=(1.2, 4.2))
    pair.trigger("undo")
    assert pair.status == "Undone: Move point 1."
    pair.trigger("redo")
    assert pair.status == "Redone: Move point 1."


def test_the_amount_of_a_cancelled_drag_disappears_at_once(pair):
    pair.press(pair.point(1))
    pair.move((1.3, 4.4))
    assert pair.status.startswith("Point 1 at ")
    pair.escape()
    assert pair.status == "Cancelled."
    pair.release((1.3, 4.4))
    assert not pair.status.startswith("Point 1 at")


def test_a_message_that_could_be_read_gives_way_to_the_hint_when_the_pointer_moves(pair, monkeypatch):
    """“Cancelled.” stayed for six seconds over an empty canvas, where the hint is always the same."""
    pair.hover((1.5, 2.0))
    hint = pair.status
    pair.press(pair.point(1))
    pair.move((1.3, 4.4))
    pair.escape()
    pair.release((1.5, 2.0))
    assert pair.status == "Cancelled."
    assert pair.window.status_line.hint == hint
    # At once: Qt rounds so long a timer to seconds, up or down.
    monkeypatch.setattr(status_line, "_READ_MS", -2000)
    pair.hover((1.52, 2.0))
    assert pair.status == hint
    pair.session.refuse("No.")
    pair.hover((1.5, 2.0))
    assert pair.status == "No."


@pytest.mark.parametrize("act", ["deleteSelection", "undo", "familyLagrange"])
def test_the_amount_of_a_drag_disappears_with_a_command_during_the_drag(pair, act):
    pair.press(pair.point(1))
    pair.move((1.3, 4.4))
    pair.trigger(act)
    assert not pair.status.startswith("Point 1 at")


def test_a_cancelled_transform_by_keys_leaves_no_message(pair):
    pair.select([1, 2])
    pair.trigger("moveSelection")
    pair.hover((1.5, 4.5))
    assert "Move" in pair.status
    pair.escape()
    assert pair.status == "Cancelled."


def test_a_drag_on_the_rail_displays_t_and_the_hint_for_escape(pair):
    panel = pair.window.basis_panel
    start, to = panel.rail_pixel(pair.parameters[1]), panel.rail_pixel(0.4)
    pair.send(panel, QEvent.Type.MouseButtonPress, start)
    pair.send(panel, QEvent.Type.MouseMove, to)
    pair.settle()
    assert pair.status.startswith("t of point 1 = 0.4")
    assert pair.status.endswith("E: all ticks on that side · Escape cancels")
    panel.setFocus()
    QTest.keyClick(panel, Qt.Key.Key_Escape)
    assert pair.status == "Cancelled."
    pair.send(panel, QEvent.Type.MouseButtonRelease, to, held=False)
    assert pair.parameters[1] == pytest.approx(1 / 3, abs=0.1)


def test_t_disappears_when_the_pointer_leaves_the_rail(pair):
    panel = pair.window.basis_panel
    pair.drag_parameter(1, to=0.4)
    assert displayed_t(pair).startswith("t 0.4")
    QApplication.sendEvent(panel, QEvent(QEvent.Type.Leave))
    assert displayed_t(pair) == ""
    pair.session.scrub.set(0.25)
    assert displayed_t(pair) == "t 0.25"


def test_the_displayed_t_is_that_of_the_scrub_line_wherever_the_pointer_is(pair):
    """One clock: beside a line at 1.545 the status line had 1.134, the t under the pointer."""
    panel = pair.window.basis_panel
    pair.session.scrub.set(0.25)
    pair.send(panel, QEvent.Type.MouseMove, panel.to_pixel(0.5, 0.5), held=False)
    assert displayed_t(pair) == "t 0.25"
    start, to = panel.rail_pixel(pair.parameters[1]), panel.rail_pixel(0.4)
    pair.send(panel, QEvent.Type.MouseButtonPress, start)
    pair.send(panel, QEvent.Type.MouseMove, to)
    assert displayed_t(pair) == "t 0.25"
    pair.escape()
    pair.send(panel, QEvent.Type.MouseButtonRelease, to, held=False)
    assert displayed_t(pair) == "t 0.25"


def test_the_drag_of_a_tick_has_one_t(pair):
    """Beside “t of point 3 = 0.8472” the status line had the t under the pointer, 0.8479."""
    panel = pair.window.basis_panel
    start, to = panel.rail_pixel(pair.parameters[1]), panel.rail_pixel(0.4)
    pair.send(panel, QEvent.Type.MouseButtonPress, start)
    pair.send(panel, QEvent.Type.MouseMove, to)
    assert displayed_t(pair) == ""
    assert pair.status.startswith("t of point 1 = 0.4")
    pair.send(panel, QEvent.Type.MouseButtonRelease, to)
    assert displayed_t(pair).startswith("t 0.4")


def test_t_disappears_when_a_drag_ends_outside(pair):
    panel = pair.window.basis_panel
    start = panel.rail_pixel(pair.parameters[1])
    pair.drag_pixels(panel, start, start + QPointF(30, -900))
    assert displayed_t(pair) == ""


def test_t_disappears_with_the_document(pair):
    pair.drag_parameter(1, to=0.4)
    session = pair.session
    session.commit(rule_edits.set_interval(session.document, session.active_index, 0.0, 20.0), "Stretch")
    pair.settle()
    # The pointer rests, and t is another one below it.
    assert float(displayed_t(pair).removeprefix("t ")) == pytest.approx(8, abs=0.1)


def test_pasting_is_confirmed_by_a_message(pair):
    pair.paste_text("5\t5\n6\t6\n")
    pair.trigger("pastePoints")
    assert pair.status == "Pasted 2 points."
    pair.select([1])
    pair.trigger("copyDerivatives")
    pair.select([2])
    pair.trigger("pasteDerivatives")
    assert pair.status == "Pasted the derivatives into point 2."
    pair.trigger("cutPoints")
    assert pair.status == "Cut 1 point."


def test_a_successful_paste_clears_the_message_of_a_refused_paste(pair):
    table = pair.window.commands[PointTableCommands].panel
    table.view.setCurrentIndex(table.model.index(0, 1))
    QGuiApplication.clipboard().setText("1\t2\n3\tx\n")
    table.paste()
    assert "is not a number" in pair.status
    QGuiApplication.clipboard().setText("1\t2\n3\t4\n")
    table.paste()
    assert "is not a number" not in pair.status
    assert "Pasted" in pair.status or "velocit" in pair.status


def test_the_hint_of_an_empty_canvas_can_be_dismissed(editor):
    editor.new()
    assert editor.message.startswith("Click on the canvas")
    close = editor.window.message_bar.findChild(QToolButton, "closeMessage")
    QTest.mouseClick(close, LEFT)
    editor.settle()
    assert editor.message == ""
    editor.add_point(0.5, 0.5)
    assert editor.message == ""
    editor.new()
    assert editor.message.startswith("Click on the canvas")


def test_a_long_sentence_ends_in_dots_and_is_whole_in_the_tooltip(pair):
    pair.window.resize(1024, 700)
    text = "Word " * 100
    pair.session.say(text)
    pair.settle()
    assert pair.window.width() == 1024
    hint = pair.window.status_line.findChild(QLabel, "hint")
    assert hint.toolTip() == hint.accessibleDescription() == text


def test_escape_restores_the_slider_while_the_button_is_down(pair):
    pair.choose_parametrization("centripetal")
    slider = pair.window.findChild(QSlider, "alphaSlider")
    document, old = pair.session.document, slider.value()
    middle = QPoint(slider.width() // 2, slider.height() // 2)
    QTest.mousePress(slider, LEFT, pos=middle)
    QTest.mouseMove(slider, middle + QPoint(20, 0))
    pair.settle()
    assert slider.value() > old
    QTest.keyClick(slider, Qt.Key.Key_Escape)
    assert (slider.value(), pair.session.document) == (old, document)
    assert pair.status == "Cancelled."
    QTest.mouseMove(slider, middle + QPoint(30, 0))
    pair.settle()
    QTest.mouseRelease(slider, LEFT, pos=middle + QPoint(30, 0))
    assert (slider.value(), pair.session.document) == (old, document)
    QTest.mousePress(slider, LEFT, pos=middle)
    QTest.mouseMove(slider, middle + QPoint(20, 0))
    QTest.mouseRelease(slider, LEFT, pos=middle + QPoint(20, 0))
    assert pair.session.document is not document


def test_opening_a_closed_curve_for_lagrange_is_explained(pair):
    pair.trigger("closeCurve")
    pair.choose_family(LAGRANGE)
    assert "cannot close" in pair.status
    pair.choose_family(HERMITE)
    assert pair.curve.is_closed
    assert pair.status == ""


def test_a_family_chosen_for_several_curves_is_reported(waves):
    """Only one of them, and without a word."""
    editor = waves("ABC")
    count = editor.session.undo_stack.count()
    editor.session.selected.select_whole((0, 1, 2))
    editor.trigger("familyQuinticHermite")
    families = [curve.family for curve in editor.session.document.curves]
    assert families == [QUINTIC_HERMITE] * 3
    assert editor.status == "3 curves are now quintic Hermite · Ctrl+Z: undo"
    assert editor.session.undo_stack.count() == count + 1
    assert editor.session.undo_stack.undoText() == "Switch 3 curves to quintic Hermite"
    editor.key(Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert [curve.family for curve in editor.session.document.curves] == [HERMITE] * 3


def test_a_family_change_that_loses_a_shape_is_reported(pair):
    pair.choose_family(QUINTIC_HERMITE)
    assert pair.status == ""
    pair.choose_family(HERMITE)
    pair.select_point(1)
    pair.drag_handle((2.0, 6.0))
    before = pair.session.active_view
    pair.choose_family(QUINTIC_HERMITE)
    t = np.linspace(*before.curve.domain, 3001)
    away = np.hypot(*(before.curve.evaluate(t) - pair.session.active_view.curve.evaluate(t)).T).max()
    said = re.fullmatch(
        r"The shape changed by up to ([\d.]+); “Convert to Quintic Hermite” keeps it · Ctrl\+Z: undo",
        pair.status,
    )
    assert float(said[1]) == pytest.approx(away, rel=0.05)
    pair.trigger("undo")
    pair.trigger("convertToQuinticHermite")
    assert np.abs(before.curve.evaluate(t) - pair.session.active_view.curve.evaluate(t)).max() < 1e-12


def test_redoing_an_image_leaves_the_tab_in_front(pair, tmp_path):
    image = QImage(40, 30, QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.red)
    image.save(str(tmp_path / "red.png"))
    pair.window.commands[ImageCommands].trace(tmp_path / "red.png")
    pair.settle()
    assert not pair.window.commands[ImageCommands].panel.visibleRegion().isEmpty()
    pair.show_dock("curveDock")
    pair.trigger("undo")
    pair.trigger("redo")
    in_front = [
        dock.objectName() for dock in pair.window.context.docks.side if not dock.visibleRegion().isEmpty()
    ]
    assert in_front == ["pointsDock", "curveDock"]


# What a press would do, under a pointer that rests


def test_a_click_edits_another_curve_with_a_message(pair):
    place = tuple(pair.session.views[0].curve.evaluate(0.5))
    pair.hover(place)
    assert pair.status.startswith("Drag to move “A” · click to edit it")
    pair.click(place)
    assert pair.session.active_index == 0
    assert pair.status == "Editing “A”."
    assert pair.window.status_line.hint.startswith("Drag to bend; the points")


def test_the_hint_follows_a_step_without_a_move(pair):
    home = pair.point(1)
    pair.drag_point(1, to=(home[0] + 0.4, home[1] + 0.4))
    assert pair.window.status_line.hint.startswith("Drag to move point 1")
    pair.trigger("undo")
    assert not pair.window.status_line.hint.startswith("Drag to move point 1")
    assert pair.window.status_line.hint
    pair.hover(home)
    assert pair.window.status_line.hint.startswith("Drag to move point 1")
    pair.trigger("redo")
    assert not pair.window.status_line.hint.startswith("Drag to move point 1")


def test_the_hint_follows_the_curve_that_is_edited(pair):
    place = tuple(pair.session.views[0].curve.evaluate(0.5))
    pair.hover(place)
    pair.session.selected.activate(0)
    pair.settle()
    assert pair.window.status_line.hint.startswith("Drag to bend; the points")


def test_the_hint_of_the_rail_follows_a_step(pair):
    panel = pair.window.basis_panel
    t = pair.parameters[1]
    pair.drag_parameter(1, to=t + 0.1)
    assert "t of point 1" in pair.window.status_line.hint
    pair.trigger("undo")
    assert "t of point 1" not in pair.window.status_line.hint
    pair.send(panel, QEvent.Type.MouseMove, panel.rail_pixel(t), held=False)
    assert "t of point 1" in pair.window.status_line.hint
    pair.trigger("redo")
    assert "t of point 1" not in pair.window.status_line.hint


def test_the_message_on_an_empty_canvas_describes_the_active_tool(editor):
    """With the pencil it spoke of pressing P."""
    editor.new()
    said = {}
    for tool in ("selectTool", "addTool", "pencilTool"):
        editor.trigger(tool)
        said[tool] = editor.message
    assert said["selectTool"].startswith("Press P, then click")
    assert said["addTool"].startswith("Click on the canvas to add points")
    assert said["pencilTool"].startswith("Drag on the canvas to draw freehand")
    bar = editor.window.message_bar
    QTest.mouseClick(bar.close_button, Qt.MouseButton.LeftButton)
    for tool in said:
        editor.trigger(tool)
        assert editor.message == ""


def test_a_press_clears_an_older_refusal_but_not_the_refusal_it_causes(pair):
    """A cell of the table refuses what was typed when the press takes the focus away, however slowly."""
    line = pair.window.status_line
    line.refuse("Not that.")
    line.clear_earlier()
    assert pair.status == "Not that."
    pair.settle()
    line.clear_earlier()
    assert pair.status == ""


@pytest.mark.parametrize(
    ("tool", "act", "expected"),
    [
        ("addTool", lambda editor: editor.key(Qt.Key.Key_Return), "the next press begins another curve"),
        ("addTool", lambda editor: editor.click(editor.point(0)), "the next press adds point 4"),
        ("pencilTool", lambda editor: editor.click((0.5, 2.0)), "Drag to draw freehand"),
        ("rectangleTool", lambda editor: editor.click((0.5, 2.0)), "Drag to draw a rectangle"),
    ],
)
def test_a_hint_about_the_next_press_goes_with_its_tool(pair, tool, act, expected):
    """With the Select tool in hand it said for six seconds that the next press adds a point."""
    pair.trigger(tool)
    if tool == "addTool" and "adds" in expected:
        pair.key(Qt.Key.Key_Return)
    act(pair)
    assert expected in pair.status
    pair.key(Qt.Key.Key_V)
    assert expected not in pair.status
    assert pair.status == "Drag points and handles; P adds points."


def test_what_a_step_has_done_is_still_read_with_another_tool(pair):
    pair.trigger("addTool")
    view = pair.session.active_view
    pair.click(tuple(view.curve.evaluate(0.45).tolist()))
    assert pair.status.startswith("Shape kept")
    pair.key(Qt.Key.Key_V)
    assert pair.status.startswith("Shape kept")


def test_a_message_about_a_point_goes_when_another_is_selected(pair):
    pair.select([1])
    pair.key(Qt.Key.Key_Right)
    assert pair.status.startswith("Point 1 at ")
    pair.key(Qt.Key.Key_Tab)
    assert pair.session.selected.points == {2}
    assert not pair.status.startswith("Point 1 at ")


def test_a_problem_of_a_gesture_goes_with_it(pair):
    """Typed amounts put a point on its neighbour: Escape, another amount, or undo end the warning."""
    x, y = (b - a for a, b in zip(pair.point(1), pair.point(2), strict=True))
    pair.select([1])
    for end in (Qt.Key.Key_Escape, Qt.Key.Key_Backspace, Qt.Key.Key_Return):
        pair.key(Qt.Key.Key_G)
        pair.type_amount(f"{x:g}")
        pair.key(Qt.Key.Key_Tab)
        pair.type_amount(f"{y:g}")
        # Panels follow a drag at most every 100 ms.
        until(lambda: pair.message.startswith("Points 1 and 2 coincide"))
        pair.key(end)
        if end is Qt.Key.Key_Return:
            assert pair.message.startswith("Points 1 and 2 coincide")
            pair.trigger("undo")
        if end is Qt.Key.Key_Backspace:
            until(lambda: pair.message == "")
            pair.escape()
        assert pair.message == ""
