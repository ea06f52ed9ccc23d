"""Gestures of the Select tool: carrying with Alt, below with Shift, a tap on Space."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.tools.canvas.add import ADD
from app.tools.canvas.select import SELECT

Key = Qt.Key
ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def paper(editor):
    """A drawing of two rectangles, 40 units square, and an ellipse over a part of the second one."""
    editor.new()
    editor.window.canvas.camera.show_box((0, 210), (0, 297))
    for tool, start in (
        ("rectangleTool", (20, 20)),
        ("rectangleTool", (100, 20)),
        ("ellipseTool", (120, 20)),
    ):
        editor.trigger(tool)
        editor.drag(start, (start[0] + 40, start[1] + 40))
    editor.trigger("selectTool")
    editor.session.selected.choose([])
    return editor


def corners(editor):
    """The lower left corner of each curve's points."""
    curves = editor.session.document.curves
    return [
        (min(point.x for point in curve.points), min(point.y for point in curve.points)) for curve in curves
    ]


def test_alt_drags_what_is_chosen_wherever_the_pointer_is(paper):
    """It drew a rubber band."""
    (x, y), *others = corners(paper)
    paper.session.selected.choose([0])
    paper.drag((60, 200), (90, 210), keys=ALT)
    assert corners(paper) == [pytest.approx((x + 30, y + 10), abs=2 * paper.pixel), *others]
    assert paper.session.selected.chosen == {0}
    paper.session.selected.choose([])
    paper.drag((10, 10), (60, 100), keys=ALT)
    assert paper.session.selected.chosen == {0}
    assert corners(paper)[1:] == others


def test_shift_alt_click_chooses_what_lies_below_too(paper):
    paper.trigger("showStyle")
    for place in (1, 2):
        paper.session.selected.choose([place])
        paper.trigger("swapFillAndStroke")
    paper.session.selected.choose([])
    paper.click((140, 40))
    top = paper.session.selected.chosen
    assert len(top) == 1
    paper.click((135, 40), keys=ALT | SHIFT)
    assert paper.session.selected.chosen == {1, 2}


def test_a_tap_on_space_takes_the_tool_that_selects_and_the_one_before(paper):
    paper.trigger("addTool")
    QTest.keyClick(paper.window.canvas, Key.Key_Space)
    assert paper.window.store.state.tool is SELECT
    QTest.keyClick(paper.window.canvas, Key.Key_Space)
    assert paper.window.store.state.tool is ADD
    paper.hold_space()
    paper.drag((40, 20), (60, 40))
    paper.release_space()
    assert paper.window.store.state.tool is ADD
    paper.trigger("selectTool")


def test_shift_click_puts_the_pivot_back(paper):
    paper.session.selected.choose([0])
    paper.click((40, 20))
    paper.drag((40, 40), (70, 90))
    target = paper.window.canvas.tools.target
    assert target.pivot == pytest.approx((70, 90), abs=2 * paper.pixel)
    paper.click((70, 90), keys=SHIFT)
    assert target.pivot is None


def test_ctrl_alt_click_on_a_line_inserts_a_point_there(paper):
    paper.session.selected.choose([0])
    paper.session.selected.edit_chosen()
    paper.click((40, 20), keys=ALT | Qt.KeyboardModifier.ControlModifier)
    assert len(paper.curve.points) == 5
    (index,) = paper.session.selection
    assert paper.point(index) == pytest.approx((40, 20), abs=2 * paper.pixel)
