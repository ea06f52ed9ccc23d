"""Panels hold still under the pointer: what is chosen changes what they show, not where it stands."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QLineEdit,
    QScrollArea,
    QSlider,
    QToolButton,
    QWidget,
)

SHOWN = (QAbstractButton, QComboBox, QLineEdit, QSlider)


def places(editor, panel):
    """Where every field and button of a panel stands that is shown, in its content."""
    editor.settle()
    dock = editor.window.findChild(QWidget, panel)
    content = dock.findChild(QScrollArea).widget()
    return {
        each.objectName(): (each.mapTo(content, QPoint(0, 0)).toTuple(), each.size().toTuple())
        for kind in SHOWN
        for each in content.findChildren(kind)
        if each.objectName() and not each.objectName().startswith("qt_") and each.isVisibleTo(content)
    }


def moved(before, after):
    return {name for name in before.keys() & after.keys() if before[name] != after[name]}


@pytest.fixture
def paper(editor):
    """A drawing of a rectangle, an ellipse and a line, with both panels open and nothing chosen."""
    editor.trigger("newDrawing")
    editor.trigger("showStyle")
    editor.trigger("openTransform")
    for tool, start in (("rectangleTool", (20, 20)), ("ellipseTool", (80, 20))):
        editor.trigger(tool)
        editor.drag(start, (start[0] + 40, 60))
    editor.trigger("addTool")
    editor.click((20, 200))
    editor.click((60, 220))
    editor.escape()
    editor.session.selected.choose([1])
    editor.trigger("showStyle")
    QTest.mouseClick(editor.window.findChild(QToolButton, "fillPaint_Blue"), Qt.MouseButton.LeftButton)
    editor.session.selected.choose([])
    return editor


@pytest.mark.parametrize("panel", ["styleDock", "transformDock"])
def test_nothing_moves_when_other_objects_are_chosen(paper, panel):
    """A rectangle brought a scroll bar, and all fields of Transform went 14 pixels to the left."""
    paper.window.resize(1200, 700)
    before = places(paper, panel)
    assert len(before) > 12
    for chosen in ([0], [1], [0, 1], [2], [0, 1, 2], []):
        paper.session.selected.choose(chosen)
        assert moved(before, places(paper, panel)) == set(), chosen
    paper.session.selected.choose([0])
    paper.session.selected.edit_chosen()
    paper.session.selected.set_points([0])
    assert moved(before, places(paper, panel)) == set()


def test_the_colour_stays_under_the_pointer_when_the_fill_becomes_a_gradient(paper):
    """The stops came above it: the colours went 112 pixels down."""
    paper.session.selected.choose([1])
    before = places(paper, "styleDock")
    button = paper.window.findChild(QWidget, "fillKind_linear")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    after = places(paper, "styleDock")
    assert "fillStopOffset" in after
    kept = {name for name in before if name.startswith(("fillKind", "fillPaint"))}
    assert len(kept) > 12
    assert moved(before, after).isdisjoint(kept)


def test_neither_panel_scrolls_sideways(paper):
    """With a fifth word for kinds of paint the Style panel was 390 pixels wide, and it has 336."""
    for panel in ("styleDock", "transformDock"):
        area = paper.window.findChild(QWidget, panel).findChild(QScrollArea)
        assert area.horizontalScrollBar().maximum() == 0, panel
