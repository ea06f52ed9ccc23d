"""Backspace and Delete with the pen in hand take back what it draws, and nothing else; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.lines import is_line
from app.document.model import Document, Page, Point
from app.document.plane_edits import set_page
from app.view_model.curve.handles import handles_of

BACKSPACE, DELETE = Qt.Key.Key_Backspace, Qt.Key.Key_Delete
PLACES = ((20, 20), (120, 20), (120, 90))


@pytest.fixture
def paper(waves):
    """A page with two letters of one group on it, and the pen in hand."""
    editor = waves("AB")
    letters = [replace(curve, groups=("Text",)) for curve in editor.session.document.curves]
    editor.session.commit(set_page(Document(tuple(letters)), Page(0, 0, 210, 148)), "Begin")
    editor.session.selected.choose(())
    editor.trigger("fitPage")
    editor.trigger("addTool")
    return editor


def sizes(editor):
    return [len(curve.points) for curve in editor.session.document.curves]


@pytest.mark.parametrize("key", [BACKSPACE, DELETE])
def test_the_pen_takes_back_its_points_one_by_one_and_then_nothing(paper, key):
    """The second Backspace deleted the curve, the third and fourth letters beside it."""
    for place in PLACES:
        paper.click(place)
    assert sizes(paper) == [4, 4, 3]
    letters = paper.session.document.curves[:2]
    for count in (2, 1):
        paper.key(key)
        assert sizes(paper) == [4, 4, count]
        assert paper.status == f"Took back point {count}."
        assert paper.session.selection == {count - 1}
    assert paper.point(0) == pytest.approx(PLACES[0], abs=2 * paper.pixel)
    paper.key(key)
    assert sizes(paper) == [4, 4]
    steps = paper.session.undo_stack.count()
    for _ in range(3):
        paper.key(key)
        assert paper.status.startswith("There is nothing to take back")
    assert (paper.session.document.curves, paper.session.undo_stack.count()) == (letters, steps)
    # The pen is ready.
    for place in PLACES:
        paper.click(place)
    assert sizes(paper) == [4, 4, 3]
    paper.key(key)
    assert sizes(paper) == [4, 4, 2]
    # What is finished is drawn no more.
    paper.key(Qt.Key.Key_Return)
    paper.key(key)
    assert sizes(paper) == [4, 4, 2]
    assert paper.status.startswith("There is nothing to take back")


def test_of_a_curve_that_was_there_only_what_the_pen_has_added_goes(paper):
    paper.session.selected.activate(1)
    paper.click(PLACES[0], keys=Qt.KeyboardModifier.ShiftModifier)
    paper.click(PLACES[2])
    for expected in (5, 4, 4, 4):
        paper.key(BACKSPACE)
        assert sizes(paper) == [4, expected]
    assert paper.status.startswith("There is nothing to take back")


def test_a_point_that_was_selected_is_deleted_as_ever(paper):
    for place in PLACES:
        paper.click(place)
    paper.click(PLACES[1])
    paper.key(DELETE)
    assert paper.session.undo_stack.undoText() == "Delete point 1"
    assert sizes(paper) == [4, 4, 2]
    paper.key(DELETE)
    assert sizes(paper) == [4, 4, 1]


def shape(editor, segment):
    """Places along a segment."""
    view = editor.session.active_view
    return view.curve.evaluate(np.linspace(*view.parameters[segment : segment + 2], 9))


@pytest.mark.parametrize("by_nodes", [False, True])
def test_a_click_goes_on_straight_from_the_end_that_is_left(paper, by_nodes):
    """The handle of the end for the segment that went bent the next one, which was called a corner."""
    paper.click((20, 20))
    paper.drag((80, 30), (110, 60))
    paper.drag((140, 20), (160, 0))
    drawn = shape(paper, 0)
    if by_nodes:
        paper.trigger("selectTool")
        paper.key(Qt.Key.Key_Return)
        paper.select_point(2)
        paper.key(DELETE)
        paper.trigger("addTool")
    else:
        paper.key(BACKSPACE)
        assert [each.ahead for each in handles_of(paper.session.active_view, 1)] == [False]
    paper.hover((140, 100))
    assert "point 2, a corner" in paper.window.status_line.hint
    assert is_line(paper.window.canvas.marks.preview_curve.source, 1)
    paper.click((140, 100))
    assert is_line(paper.curve, 1)
    assert shape(paper, 0) == pytest.approx(drawn, abs=1e-9)
    # A drag bends, and a handle drawn out then bends what a click makes, as ever.
    paper.drag((180, 60), (190, 30))
    paper.click((120, 40))
    assert [is_line(paper.curve, segment) for segment in range(4)] == [False, True, False, False]


def test_a_smooth_curve_that_was_there_keeps_its_shape_beside_the_line_that_goes_on(paper):
    places = ((20, 20), (60, 60), (100, 20))
    smooth = replace(paper.session.document.curves[1], points=tuple(Point(*place) for place in places))
    paper.session.change("Draw", lambda document: document.with_curve(1, smooth), active=1)
    paper.session.selected.activate(1)
    drawn = np.vstack([shape(paper, segment) for segment in range(2)])
    paper.click((160, 90), keys=Qt.KeyboardModifier.ShiftModifier)
    assert is_line(paper.curve, 2)
    now = np.vstack([shape(paper, segment) for segment in range(2)])
    assert now == pytest.approx(drawn, abs=1e-9)


@pytest.mark.parametrize("leave", [lambda paper: paper.escape(), lambda paper: paper.key(Qt.Key.Key_V)])
def test_a_lone_point_goes_when_the_pen_is_put_down(paper, leave):
    """Nobody saw it, and it was counted: 3 curves chosen."""
    letters = paper.session.document.curves
    paper.click((100, 90))
    paper.key(Qt.Key.Key_Return)
    assert sizes(paper) == [4, 4, 1]
    leave(paper)
    assert paper.action("selectTool").isChecked()
    assert paper.session.document.curves == letters
    assert not paper.session.selected.marked
    paper.trigger("undo")
    assert sizes(paper) == [4, 4, 1]
    paper.trigger("undo")
    assert paper.session.document.curves == letters


def test_a_curve_of_two_points_stays_when_the_pen_is_put_down(paper):
    paper.click((100, 90))
    paper.click((150, 90))
    paper.escape()
    assert sizes(paper) == [4, 4, 2]
