"""What is edited and chosen when a curve is gone: nothing, until somebody asks for it; real events."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.model import Document
from app.document.selection import NONE_SELECTED
from app.features.curve_list.commands import CurveListCommands
from tests.gui.editor_facts import names

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
DELETE = Qt.Key.Key_Delete


@pytest.fixture
def four(waves):
    """Four waves, the second edited by a double click, with no point selected."""
    editor = waves("ABCD")
    editor.escape()
    editor.double_click(tuple(editor.session.views[1].curve.evaluate(0.45).tolist()))
    assert state(editor) == ("ABCD", True, "", "B")
    return editor


def state(editor):
    """Return which curves there are, whether one is edited, which are chosen, and the active one."""
    selected, curves = editor.session.selected, editor.session.document.curves
    chosen = "".join(curves[place].name for place in sorted(selected.whole_curves))
    return names(editor), selected.is_editing, chosen, editor.curve.name if selected.is_editing else ""


@pytest.mark.parametrize(
    ("key", "held", "step"),
    [(DELETE, 0, "Delete B"), (Qt.Key.Key_X, CTRL, "Cut B"), (DELETE, SHIFT, "Delete B")],
)
def test_repeated_delete_deletes_no_other_curve(four, key, held, step):
    """Three keys took the curve that was edited and two that nobody had touched."""
    steps = four.session.undo_stack.count()
    for _ in range(3):
        four.key(key, held or Qt.KeyboardModifier.NoModifier)
        assert state(four) == ("ACD", False, "", "")
    assert four.status == NONE_SELECTED
    assert (four.session.undo_stack.count(), four.session.undo_stack.undoText()) == (steps + 1, step)
    four.trigger("undo")
    # It is edited again, as it was; it came back chosen as a whole.
    assert state(four) == ("ABCD", True, "", "B")
    four.trigger("redo")
    assert state(four) == ("ACD", False, "", "")


def test_undo_of_deleted_points_selects_the_points_and_undo_of_a_deleted_curve_the_whole_curve(four):
    four.select([0, 1, 2, 3])
    four.key(DELETE)
    assert state(four)[:2] == ("ACD", False)
    four.trigger("undo")
    assert state(four) == ("ABCD", True, "", "B")
    assert four.session.selection == {0, 1, 2, 3}
    four.session.selected.select_whole([1])
    four.key(DELETE)
    four.trigger("undo")
    assert state(four) == ("ABCD", False, "B", "")


@pytest.mark.parametrize("name", ["duplicateSelection", "duplicateCurve", "newCurve"])
def test_undo_of_an_addition_restores_the_previous_selection(four, name):
    """Nothing was chosen, and the next key said so."""
    four.session.selected.select_whole([1, 2])
    four.trigger(name)
    assert state(four)[2] != "BC"
    four.trigger("undo")
    assert state(four) == ("ABCD", False, "BC", "")


def test_undo_of_copies_keeps_a_later_selection(four):
    four.session.selected.select_whole([1])
    four.trigger("duplicateSelection")
    four.session.selected.select_whole([0])
    four.trigger("undo")
    assert state(four) == ("ABCD", False, "A", "")


def test_a_curve_deleted_in_the_list_leaves_the_edited_curve_edited(four):
    four.show_dock("curvesDock")
    four.click_in_list(3)
    four.window.commands[CurveListCommands].panel.view.setFocus()
    four.trigger("deleteCurve")
    assert state(four) == ("ABC", False, "", "")


def test_all_points_deleted_of_one_part_leave_the_rest_of_the_shape_edited(four):
    document = four.session.document
    parts = [replace(curve, shape="S") if curve.name in "CD" else curve for curve in document.curves]
    four.session.commit(Document(tuple(parts)), "Combine")
    four.session.selected.activate(3)
    four.select([0, 1, 2, 3])
    four.key(DELETE)
    assert state(four) == ("ABC", True, "", "C")


def test_deleting_one_of_several_edited_curves_leaves_the_others_edited(four):
    selected = four.session.selected
    selected.select_whole({0, 3})
    four.key(Qt.Key.Key_Return)
    gone, left = ("A", "D") if four.curve.name == "A" else ("D", "A")
    four.select([0, 1, 2, 3])
    four.key(DELETE)
    assert state(four) == ("ABCD".replace(gone, ""), True, "", left)


def test_undo_of_a_curve_that_was_drawn_edits_the_curve_before_again(four):
    four.key(Qt.Key.Key_P)
    four.key(Qt.Key.Key_Return)
    four.click((1.5, 4.6))
    assert names(four) == "ABCDCurve 1"
    four.trigger("undo")
    assert state(four) == ("ABCD", True, "", "B")
    # The pen in hand begins another curve, as before.
    four.hover((1.5, 4.6))
    assert four.window.status_line.hint.startswith("Click to begin another curve")
    four.click((1.5, 4.6))
    assert [len(curve.points) for curve in four.session.document.curves] == [4, 4, 4, 4, 1]
    four.trigger("undo")
    four.trigger("redo")
    assert state(four) == ("ABCDCurve 1", True, "", "Curve 1")


def test_undo_of_the_first_curve_drawn_while_nothing_was_selected_edits_none(four):
    four.key(DELETE)
    four.trigger("rectangleTool")
    four.drag((1.5, 4.6), (1.8, 4.8))
    assert len(four.session.document.curves) == 4
    four.trigger("undo")
    assert state(four) == ("ACD", False, "", "")


def test_escape_removes_a_curve_begun_after_the_edited_curve_was_deleted(four):
    four.key(Qt.Key.Key_P)
    four.key(DELETE)
    assert state(four) == ("ACD", False, "", "")
    document = four.session.document
    four.press((1.5, 4.6))
    four.move((1.8, 4.8))
    four.escape()
    four.release((1.8, 4.8))
    assert four.session.document is document
    assert state(four) == ("ACD", False, "", "")
    four.hover((1.5, 4.6))
    assert four.window.status_line.hint.startswith("Click to begin another curve")


def test_deleting_the_last_curve_leaves_an_empty_curve(waves):
    one = waves("AB")
    one.key(DELETE)
    one.session.selected.select_whole({0})
    one.key(Qt.Key.Key_Return)
    one.key(DELETE)
    assert one.curve.points == ()
    one.key(Qt.Key.Key_P)
    one.fit()
    one.click((0.4, 0.4))
    one.click((0.6, 0.4))
    assert [len(curve.points) for curve in one.session.document.curves] == [2]
