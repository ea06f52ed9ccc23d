"""The pen on a page: what is finished is left alone but for its open ends, as in Inkscape."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

Key = Qt.Key


@pytest.fixture
def paper(editor):
    """A new drawing, the pen in hand, and a line that Escape has finished."""
    editor.trigger("newDrawing")
    editor.click((40, 200))
    editor.click((120, 100))
    editor.key(Key.Key_Escape)
    return editor


def sizes(editor):
    return [len(curve.points) for curve in editor.session.document.curves]


def test_after_escape_a_click_on_the_line_begins_another_one_there(paper):
    """It added a point to the line: 3 in one curve."""
    paper.trigger("addTool")
    paper.hover((80, 150))
    assert paper.window.status_line.hint.startswith("Click to begin another curve")
    paper.click((80, 150))
    assert sizes(paper) == [2, 1]
    paper.click((150, 160))
    assert sizes(paper) == [2, 2]
    assert paper.curve.points[0].position == pytest.approx((80, 150), abs=paper.pixel)


def test_after_enter_too_and_an_open_end_goes_on(paper):
    paper.trigger("addTool")
    paper.click((20, 20))
    paper.click((60, 20))
    paper.click((60, 60))
    paper.key(Key.Key_Return)
    paper.click((60, 20))
    assert sizes(paper) == [2, 3, 1]
    paper.trigger("undo")
    paper.trigger("selectTool")
    paper.session.selected.choose([0])
    paper.trigger("addTool")
    paper.click((120, 100))
    assert paper.status == "Going on with “Curve 1”; the next press adds point 2."
    paper.click((180, 40))
    assert sizes(paper)[0] == 3


def test_a_shape_that_the_pen_has_closed_is_chosen_and_its_edge_begins_another(paper):
    paper.trigger("addTool")
    for place in ((20, 20), (100, 20), (100, 80), (20, 20)):
        paper.click(place)
    closed = paper.curve
    assert closed.is_closed
    assert paper.session.selected.chosen == {1}
    paper.click((60, 20))
    assert sizes(paper) == [2, 3, 1]
    assert paper.session.document.curves[1] is closed


@pytest.mark.parametrize("between", ["selectTool", "rectangleTool", ""])
def test_the_edge_of_a_rectangle_begins_a_curve(paper, between):
    """A point was inserted in it, and it was a rectangle no longer."""
    paper.trigger("rectangleTool")
    paper.drag((20, 20), (100, 80))
    rectangle = paper.curve
    if between:
        paper.trigger(between)
    paper.trigger("addTool")
    assert not paper.session.selected.is_editing
    paper.click((60, 20))
    paper.click((60, 50))
    assert sizes(paper) == [2, 4, 2]
    assert paper.session.document.curves[1] is rectangle
