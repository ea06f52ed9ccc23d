"""While no curve is edited, a drag selects the moved curves; real events."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

from tests.gui.editor_facts import on_curve

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def whole(waves):
    """Three waves one above the other, A below, C on top; none is edited, B is chosen."""
    three = waves("ABC")
    three.escape()
    return three


def selected_names(editor):
    document, selected = editor.session.document, editor.session.selected
    assert not selected.is_editing
    return "".join(document.curves[place].name for place in sorted(selected.whole_curves))


def test_a_drag_selects_the_moved_curves_and_keys_act_on_the_selection(whole):
    before, steps = whole.session.document, whole.session.undo_stack.count()
    x, y = on_curve(whole, 2)
    whole.press((x, y))
    whole.move((x + 0.2, y + 0.4))
    assert selected_names(whole) == "C"
    whole.release((x + 0.2, y + 0.4))
    assert (selected_names(whole), whole.curve.name) == ("C", "C")
    assert whole.session.undo_stack.undoText() == "Move C"
    assert whole.session.undo_stack.count() == steps + 1
    moved = whole.session.document
    whole.key(Qt.Key.Key_Right)
    assert whole.session.document.curves[2] != moved.curves[2]
    assert whole.session.document.curves[:2] == before.curves[:2]
    whole.trigger("undo")
    assert (whole.session.document, selected_names(whole)) == (moved, "C")
    for step, document in (("undo", before), ("redo", moved)):
        whole.trigger(step)
        assert (whole.session.document, selected_names(whole), whole.curve.name) == (document, "C", "C")
    whole.click(on_curve(whole, 0))
    for step, document in (("undo", before), ("redo", moved)):
        whole.trigger(step)
        assert (whole.session.document, selected_names(whole), whole.curve.name) == (document, "A", "A")
    whole.click(on_curve(whole, 2))
    whole.drag(on_curve(whole, 2), (x, y))
    whole.key(Qt.Key.Key_Delete)
    assert [curve.name for curve in whole.session.document.curves] == ["A", "B"]


def test_escape_cancels_the_move_and_the_selection(whole):
    before, steps = whole.session.document, whole.session.undo_stack.count()
    x, y = on_curve(whole, 0)
    whole.press((x, y))
    whole.move((x + 0.2, y + 0.4))
    assert selected_names(whole) == "A"
    whole.escape()
    assert (selected_names(whole), whole.curve.name) == ("B", "B")
    whole.release((x + 0.2, y + 0.4))
    assert (whole.session.document, selected_names(whole)) == (before, "B")
    assert whole.session.undo_stack.count() == steps


def test_a_drag_of_a_curve_in_a_group_selects_the_group(whole):
    whole.key(Qt.Key.Key_A, CTRL)
    whole.trigger("groupCurves")
    whole.escape()
    assert selected_names(whole) == ""
    x, y = on_curve(whole, 1)
    whole.drag((x, y), (x + 0.3, y))
    assert selected_names(whole) == "ABC"
    for step in ("undo", "redo"):
        whole.trigger(step)
        assert selected_names(whole) == "ABC"


def test_select_all_selects_visible_unlocked_curves(whole):
    """What was hidden was deleted unseen, and what was locked refused everything."""
    selected = whole.session.selected
    selected.select_whole({0})
    whole.trigger("curveLocked")
    selected.select_whole({2})
    whole.trigger("curveVisible")
    selected.select_whole(())
    whole.window.canvas.setFocus()
    whole.trigger("selectAll")
    assert selected_names(whole) == "B"
    whole.key(Qt.Key.Key_Delete)
    assert [curve.name for curve in whole.session.document.curves] == ["A", "C"]
    document = whole.session.document
    for keys in (CTRL, CTRL | Qt.KeyboardModifier.ShiftModifier):
        whole.key(Qt.Key.Key_A, keys)
        assert whole.status == "All curves are hidden or locked. Show or unlock them in the list of curves."
        assert selected_names(whole) == ""
    whole.key(Qt.Key.Key_Delete)
    assert whole.session.document is document
