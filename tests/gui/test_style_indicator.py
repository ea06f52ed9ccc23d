"""Fill and stroke in the status line of a drawing: of what is chosen, or of what is drawn next."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton, QWidget

LEFT = Qt.MouseButton.LeftButton
BLUE = "#0072b2"


@pytest.fixture
def paper(editor):
    """A new drawing with the tool that selects in hand."""
    editor.trigger("newDrawing")
    editor.trigger("selectTool")
    return editor


def button(editor):
    return editor.window.findChild(QToolButton, "styleNow")


def colours(editor):
    """The colours of the square of the fill, and of the frame of the stroke."""
    image = button(editor).icon().pixmap(35, 16).toImage()
    ratio = image.width() / 35
    return [QColor(image.pixelColor(round(x * ratio), round(8 * ratio))).name() for x in (5, 22)]


def click(editor, name):
    QTest.mouseClick(editor.window.findChild(QToolButton, name), LEFT)
    editor.settle()


def test_what_is_chosen_with_nothing_chosen_is_seen_and_drawn(paper):
    assert button(paper).isVisible()
    assert button(paper).toolTip().startswith("What is drawn next: fill none · stroke #000000")
    paper.trigger("showStyle")
    click(paper, "fillPaint_Blue")
    assert button(paper).toolTip().startswith(f"What is drawn next: fill {BLUE} · stroke #000000")
    assert colours(paper)[0] == BLUE
    paper.trigger("rectangleTool")
    paper.drag((20, 20), (60, 60))
    assert paper.curve.style.fill == BLUE
    assert button(paper).toolTip().startswith(f"Rectangle 1: fill {BLUE} · stroke #000000")


def test_what_was_styled_last_is_drawn_next_and_a_line_has_its_own(paper):
    paper.trigger("showStyle")
    paper.trigger("rectangleTool")
    paper.drag((20, 20), (60, 60))
    paper.trigger("selectTool")
    click(paper, "strokePaint_Blue")
    assert colours(paper)[1] == BLUE
    paper.trigger("ellipseTool")
    paper.drag((80, 20), (120, 60))
    assert paper.curve.style.stroke == BLUE
    paper.escape()
    paper.escape()
    paper.trigger("addTool")
    assert button(paper).toolTip().startswith("The next line: fill none · stroke #000000")


def test_of_several_it_says_that_they_differ(paper):
    paper.trigger("rectangleTool")
    paper.drag((20, 20), (60, 60))
    paper.trigger("showStyle")
    click(paper, "fillPaint_Blue")
    paper.trigger("ellipseTool")
    paper.drag((80, 20), (120, 60))
    click(paper, "fillPaint_None")
    paper.trigger("selectTool")
    paper.session.selected.choose([0, 1])
    paper.settle()
    assert "fill mixed · stroke #000000" in button(paper).toolTip()


def test_a_click_opens_the_panel_and_a_sketch_has_none(paper):
    paper.window.findChild(QWidget, "styleDock").close()
    QTest.mouseClick(button(paper), LEFT)
    paper.settle()
    assert paper.window.findChild(QWidget, "stylePanel").isVisible()
    paper.new()
    assert not button(paper).isVisible()
