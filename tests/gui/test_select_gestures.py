"""Gestures of the Select tool on the pivot."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

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
    editor.session.selected.select_whole([])
    return editor


def test_shift_click_puts_the_pivot_back(paper):
    paper.session.selected.select_whole([0])
    paper.click((40, 20))
    paper.drag((40, 40), (70, 90))
    target = paper.window.canvas.tools.box
    assert target.pivot == pytest.approx((70, 90), abs=2 * paper.pixel)
    paper.click((70, 90), keys=SHIFT)
    assert target.pivot is None
