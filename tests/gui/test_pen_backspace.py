"""Backspace and Delete with the pen remove the points it drew, and nothing else; real events."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.model import Document

BACKSPACE, DELETE = Qt.Key.Key_Backspace, Qt.Key.Key_Delete
PLACES = ((20, 20), (120, 20), (120, 90))


@pytest.fixture
def paper(waves):
    """Two letters of one group, and the pen in hand."""
    editor = waves("AB")
    letters = [replace(curve, groups=("Text",)) for curve in editor.session.document.curves]
    editor.session.commit(Document(tuple(letters)), "Begin")
    editor.session.selected.select_whole(())
    editor.window.canvas.camera.show_box((0, 210), (0, 148))
    editor.trigger("addTool")
    editor.key(Qt.Key.Key_Return)
    return editor


def sizes(editor):
    return [len(curve.points) for curve in editor.session.document.curves]


@pytest.mark.parametrize("key", [BACKSPACE, DELETE])
def test_backspace_removes_points_of_the_pen_one_by_one_and_then_nothing(paper, key):
    """The second Backspace deleted the curve, the third and fourth letters beside it."""
    for place in PLACES:
        paper.click(place)
    assert sizes(paper) == [4, 4, 3]
    letters = paper.session.document.curves[:2]
    for count in (2, 1):
        paper.key(key)
        assert sizes(paper) == [4, 4, count]
        assert paper.status == f"Removed point {count}."
        assert paper.session.selection == {count - 1}
    assert paper.point(0) == pytest.approx(PLACES[0], abs=2 * paper.pixel)
    paper.key(key)
    assert sizes(paper) == [4, 4]
    steps = paper.session.undo_stack.count()
    for _ in range(3):
        paper.key(key)
        assert paper.status.startswith("There is nothing to remove")
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
    assert paper.status.startswith("There is nothing to remove")


def test_backspace_removes_only_points_that_the_pen_has_added(paper):
    paper.session.selected.activate(1)
    paper.click(PLACES[0], keys=Qt.KeyboardModifier.ShiftModifier)
    paper.click(PLACES[2])
    for expected in (5, 4, 4, 4):
        paper.key(BACKSPACE)
        assert sizes(paper) == [4, expected]
    assert paper.status.startswith("There is nothing to remove")


def test_a_point_that_was_selected_is_deleted_as_ever(paper):
    for place in PLACES:
        paper.click(place)
    paper.click(PLACES[1])
    paper.key(DELETE)
    assert paper.session.undo_stack.undoText() == "Delete point 1"
    assert sizes(paper) == [4, 4, 2]
    paper.key(DELETE)
    assert sizes(paper) == [4, 4, 1]
