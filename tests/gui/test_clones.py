"""Clones on the canvas: they follow in the same frame, in one undo step, and tell what they are."""

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.edits import move_points
from app.document.model import Document, make_curve
from app.features.curve_list.commands import CurveListCommands
from app.storage.format import decode, encode

ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier
LEAF = make_curve([(0, 0), (1, 1), (2, 0)], name="Leaf")


@pytest.fixture
def pair(editor):
    """A curve and a clone of it, which is chosen, three to the right."""
    editor.new()
    editor.session.commit(Document((LEAF,)), "Begin")
    editor.window.canvas.camera.show_box((-1, 6), (-2, 3))
    editor.trigger("selectTool")
    editor.session.selected.choose([0])
    editor.settle()
    editor.key(Qt.Key.Key_D, ALT)
    editor.settle()
    assert editor.status == "A clone of Leaf lies on it and is chosen; a drag moves it."
    editor.drag((1, 1), to=(4, 1))
    yield editor
    editor.new()
    editor.settle()


def places(editor, curve):
    return [point.position for point in editor.session.document.curves[curve].points]


def is_image(editor):
    """Whether the clone runs as its original does, to where it was moved."""
    document = editor.session.document
    clone = document.curves[1].clone
    image = [(x + clone.x, y + clone.y) for x, y in places(editor, 0)]
    return places(editor, 1) == [pytest.approx(place) for place in image]


def test_a_clone_follows_every_frame_of_a_drag_in_one_step(pair):
    session = pair.session
    assert session.document.curves[1].clone.x == pytest.approx(3.0, abs=0.1)
    session.selected.choose([0])
    session.selected.enter(0)
    before, steps = session.committed, session.undo_stack.count()
    frames = []

    def note():
        frames.append(is_image(pair))

    session.document_changed.connect(note)
    pair.drag((2, 0), to=(2, -1))
    session.document_changed.disconnect(note)
    assert len(frames) > 3
    assert all(frames)
    assert places(pair, 0)[2] == pytest.approx((2, -1), abs=0.1)
    assert session.undo_stack.count() == steps + 1
    pair.trigger("undo")
    assert session.document == before


def test_what_a_clone_is_of_is_told_in_the_status_line_and_in_the_list(pair):
    session = pair.session
    pair.hover((4, 1))
    assert "Drag to move “Leaf copy”, a clone of “Leaf” · " in pair.status
    pair.hover((5.5, 2.5))
    assert "“Leaf copy” is chosen, a clone of “Leaf” · " in pair.status
    rows = pair.window.commands[CurveListCommands].panel.model
    assert [rows.row(row).is_clone for row in range(2)] == [True, False]
    pair.key(Qt.Key.Key_D, SHIFT)
    assert session.selected.curves == {0}


def test_edited_or_orphaned_it_is_a_clone_no_more_and_that_is_said(pair):
    session = pair.session
    session.change("Move", lambda document: move_points(document, 1, [0], (0.0, 1.0)))
    assert session.document.curves[1].clone is None
    assert pair.status == "“Leaf copy” is no clone any more."
    pair.trigger("undo")
    assert session.document.curves[1].clone is not None
    session.selected.choose([0])
    pair.settle()
    pair.key(Qt.Key.Key_Delete)
    assert pair.status == "Deleted “Leaf”. “Leaf copy” is no clone any more."
    pair.trigger("undo")
    session.selected.choose([1])
    pair.settle()
    pair.key(Qt.Key.Key_D, ALT | SHIFT)
    assert [curve.clone for curve in session.document.curves] == [None, None]
    assert session.undo_stack.undoText() == "Unlink Leaf copy"


def test_a_locked_clone_follows_and_stays_where_it_is(pair):
    session = pair.session
    session.change("Lock", lambda d: d.with_curve(1, replace(d.curves[1], locked=True)))
    assert session.change("Move", lambda document: move_points(document, 0, [0], (0.0, 1.0)))
    assert is_image(pair)
    assert not session.change("Move", lambda document: move_points(document, 1, [0, 1, 2], (0.0, 1.0)))


def test_a_file_keeps_clones(pair):
    document = pair.session.document
    assert decode(encode(document)) == document
    assert b"clone" not in encode(Document((LEAF,)))
