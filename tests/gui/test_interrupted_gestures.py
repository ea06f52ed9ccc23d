"""Gestures that a dialog, a list or another tool interrupts: nothing of them stays behind."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt, QTimer
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox

from app.canvas.canvas import Canvas
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.features.curve_list.commands import CurveListCommands
from app.features.reference_image.commands import ImageCommands
from app.window.command_palette import CommandPalette
from tests.effort import noted_calls
from tests.gui.editor_facts import picture

CTRL = Qt.KeyboardModifier.ControlModifier
Key = Qt.Key
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0))


@pytest.fixture
def arch(editor):
    """Four points of an arch, not saved."""
    editor.session.commit(Document((make_curve(POINTS, family=HERMITE),)), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    return editor


def begin(editor, what):
    """Begin a gesture on the canvas."""
    if what == "transform":
        editor.select([1, 2])
        editor.hover((0, 3))
        editor.key(Key.Key_G)
        editor.move((1, 4), held=False)
        return
    start = {"point": editor.point(1), "band": (-1, 3)}.get(what, (5, 1))
    if what in ("pen", "measure"):
        editor.trigger({"pen": "addTool", "measure": "measureTool"}[what])
    editor.press(start)
    editor.move((start[0] + 0.7, start[1] + 0.9))


def ask_to_save(editor, widget=None):
    """Press Ctrl+N, as the person does, and cancel what it asks."""
    asked = []

    def answer():
        box = editor.window.findChild(QMessageBox, "saveChanges")
        if box is None or QApplication.activeModalWidget() is not box:
            QTimer.singleShot(10, answer)
            return
        asked.append(editor.status)
        box.button(QMessageBox.StandardButton.Cancel).click()

    QTimer.singleShot(0, answer)
    QTest.keyClick(widget or editor.window.canvas, Key.Key_N, CTRL)
    editor.settle()
    assert len(asked) == 1
    assert QApplication.activeModalWidget() is None
    return asked[0]


@pytest.mark.parametrize("what", ["point", "band", "pen", "measure", "transform"])
def test_a_dialog_cancels_a_gesture(arch, what):
    document, steps = arch.session.document, arch.session.undo_stack.count()
    begin(arch, what)
    assert arch.window.canvas.is_dragging
    assert "Escape cancels" in arch.status or what == "measure"
    assert "Escape cancels" not in ask_to_save(arch)
    canvas = arch.window.canvas
    assert not canvas.is_dragging
    assert (arch.session.document, arch.session.undo_stack.count()) == (document, steps)
    assert (canvas.marks.band, canvas.marks.ruler, canvas.marks.note) == (None, None, None)
    arch.trigger("selectTool")
    arch.window.status_line.clear_message()
    arch.hover(arch.point(2))
    assert arch.status.startswith("Drag to move")
    arch.drag_point(2, to=(3.5, 3))
    assert arch.point(2) == pytest.approx((3.5, 3), abs=2 * arch.pixel)


def test_a_dialog_cancels_a_drag_of_the_picture(arch, tmp_path):
    arch.window.commands[ImageCommands].trace(picture(tmp_path / "red.png"))
    arch.trigger("moveImage")
    before = arch.session.document.image
    arch.press((before.x + before.width / 2, before.y + before.height / 2))
    arch.move((before.x, before.y))
    assert arch.session.document.image != before
    ask_to_save(arch)
    assert arch.session.document.image == before
    assert not arch.window.canvas.is_dragging
    arch.move((2, 2), held=False)
    assert arch.session.document.image == before


def test_a_dialog_cancels_a_drag_of_a_tick(arch):
    document, panel = arch.session.document, arch.window.basis_panel
    start = panel.rail_pixel(arch.parameters[1])
    arch.send(panel, QEvent.Type.MouseButtonPress, start)
    arch.send(panel, QEvent.Type.MouseMove, start + QPointF(30, 0))
    assert arch.session.document is not document
    ask_to_save(arch, panel)
    assert arch.session.document is document
    assert not panel.is_dragging
    arch.send(panel, QEvent.Type.MouseMove, start + QPointF(60, 0), held=False)
    assert arch.session.document is document


def test_a_dialog_ends_panning(arch):
    canvas = arch.window.canvas
    arch.hold_space()
    arch.press((1, 1))
    arch.move((2, 1))
    ask_to_save(arch)
    box = canvas.pixel_map.box
    arch.move((3, 1), held=False)
    assert canvas.pixel_map.box == box
    arch.drag_point(1, to=(1.5, 3))
    assert canvas.pixel_map.box == box
    assert arch.point(1) == pytest.approx((1.5, 3), abs=2 * arch.pixel)


def test_a_dialog_cancels_a_drag_of_a_row(arch):
    arch.trigger("duplicateCurve")
    arch.show_dock("curvesDock")
    document, view = arch.session.document, arch.window.commands[CurveListCommands].panel.view
    start, end = (view.parts.row_rect(row).center() for row in (0, 1))
    left = Qt.MouseButton.LeftButton
    QTest.mousePress(view.viewport(), left, pos=start)
    for place in (start, view.parts.row_rect(1).bottomLeft(), end):
        arch.send(view, QEvent.Type.MouseMove, place)
    assert view.is_dragging
    ask_to_save(arch, view)
    assert not view.is_dragging
    QTest.mouseRelease(view.viewport(), left, pos=end)
    assert arch.session.document is document


def test_the_command_palette_opened_during_a_gesture_cancels_the_gesture(arch):
    document = arch.session.document
    begin(arch, "band")
    arch.trigger("commandPalette")
    arch.window.findChild(CommandPalette).close()
    arch.hover((2, 3))
    assert not arch.window.canvas.is_dragging
    assert arch.window.canvas.marks.band is None
    assert "Escape cancels" not in arch.status
    assert arch.session.document is document


OTHER_TOOLS = [("pen", Key.Key_V), ("pen", Key.Key_M), ("pen", Key.Key_P), ("band", Key.Key_P)]


def test_another_tool_in_mid_drag_cancels_the_drag(arch):
    for what, key in OTHER_TOOLS:
        document = arch.session.document
        begin(arch, what)
        assert "Escape cancels" in arch.status, (what, key)
        QTest.keyClick(arch.window.canvas, key)
        arch.settle()
        assert arch.session.document is document, (what, key)
        assert arch.status == "Cancelled.", (what, key)
        arch.move((5.5, 2))
        arch.release((5.5, 2))
        assert arch.session.document is document, (what, key)
        assert "Escape cancels" not in arch.status, (what, key)
        arch.trigger("selectTool")


# The selection


@pytest.mark.parametrize("moved", [0.0, 0.7])
@pytest.mark.parametrize("tool", ["selectTool", "addTool"])
def test_escape_restores_the_selection_from_before_the_press_on_a_point(arch, tool, moved):
    arch.trigger(tool)
    arch.select([0])
    document, (x, y) = arch.session.document, arch.point(2)
    arch.press((x, y))
    assert arch.session.selection == {2}
    if moved:
        arch.move((x + moved, y + moved))
    arch.escape()
    assert arch.session.selection == {0}
    assert arch.status == "Cancelled."
    arch.release((x + moved, y + moved))
    assert (arch.session.selection, arch.session.document) == ({0}, document)
    arch.press((x, y))
    arch.release((x, y))
    assert arch.session.selection == {2}


@pytest.mark.parametrize("moved", [0.0, 0.7])
def test_escape_restores_the_active_curve_from_before_a_press_on_another_edited_curve(arch, moved):
    session = arch.session
    below = make_curve([(x, y - 2.5) for x, y in POINTS], family=HERMITE)
    session.commit(Document((*session.document.curves, below)), "Begin")
    session.selected.select_whole({0, 1})
    arch.key(Key.Key_Return)
    other = 1 - session.active_index
    arch.select([3])
    before, at = session.selected.state, session.document.curves[other].points[1].position
    arch.press(at)
    assert (session.active_index, session.selection) == (other, {1})
    if moved:
        arch.move((at[0] - moved, at[1] + moved))
    arch.escape()
    assert session.selected.state == before
    assert arch.status == "Cancelled."
    arch.release(at)
    assert session.selected.state == before


@pytest.mark.parametrize("moved", [0.0, 0.7])
def test_escape_restores_the_selection_from_before_alt_and_a_press_on_a_point(arch, moved):
    arch.select([0])
    x, y = arch.point(2)
    arch.press((x, y), keys=Qt.KeyboardModifier.AltModifier)
    if moved:
        arch.move((x + moved, y + moved), keys=Qt.KeyboardModifier.AltModifier)
    arch.escape()
    assert arch.session.selection == {0}
    arch.release((x + moved, y + moved))
    assert arch.session.selection == {0}


# Two buttons


def mouse(editor, kind, at, button, held):
    """One mouse event on the canvas, as the window system reports it."""
    canvas = editor.window.canvas
    pixel = QPointF(canvas.to_pixel(*at))
    place = canvas.viewport().mapToGlobal(pixel)
    keys = Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(canvas.viewport(), QMouseEvent(kind, pixel, place, button, held, keys))


def test_a_drag_ends_with_its_own_button_while_the_middle_one_pans(editor):
    left, middle, none = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.NoButton
    start = editor.point(1)
    there = (start[0] + 0.5, start[1] + 0.5)
    editor.press(start)
    editor.move(there)
    mouse(editor, QEvent.Type.MouseButtonPress, there, middle, left | middle)
    mouse(editor, QEvent.Type.MouseButtonRelease, there, left, middle)
    assert not editor.window.canvas.is_dragging
    assert editor.session.undo_stack.undoText() == "Move point 1"
    mouse(editor, QEvent.Type.MouseButtonRelease, there, middle, none)
    moved = editor.point(1)
    editor.drag_point(2, to=(3.0, 2.0))
    assert editor.point(1) == moved


def test_a_press_after_a_missed_release_begins_a_new_gesture(editor):
    document = editor.session.document
    start = editor.point(1)
    editor.press(start)
    editor.move((start[0] + 0.5, start[1] + 0.5))
    editor.press(editor.window.canvas.pixel_map.plane(20, 20))
    assert editor.session.document is document
    editor.escape()


def test_without_a_gesture_its_end_shows_no_marks_and_ends_nothing(arch, monkeypatch):
    """With each step of the history the marks were found for the document before it."""
    arch.select([1, 2])
    marks, ends = noted_calls(monkeypatch, Canvas, "show_marks"), []
    arch.window.canvas.gesture_ended.connect(lambda: ends.append(True))
    arch.session.gesture_ended.emit()
    assert (marks, ends) == ([], [])
    begin(arch, "transform")
    marks.clear()
    arch.session.gesture_ended.emit()
    assert marks
    assert ends == [True]
