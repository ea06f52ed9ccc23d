"""Copy, Cut, Duplicate and Delete act on what is highlighted: points, the curve, or all chosen ones."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from app.document.model import Document, make_curve
from app.document.selection import NONE_SELECTED
from app.families import HERMITE
from app.features.curve_list.commands import CurveListCommands
from app.workbench.clipboard import CURVES, POINTS
from tests.gui.editor_facts import names, undo_text

CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier
NONE = Qt.KeyboardModifier.NoModifier
KEYS = {"copy": (Qt.Key.Key_C, CTRL), "cut": (Qt.Key.Key_X, CTRL), "delete": (Qt.Key.Key_Delete, NONE)}


@pytest.fixture
def three(waves):
    editor = waves("ABC")
    editor.session.undo_stack.clear()
    editor.window.canvas.setFocus()
    return editor


def held():
    return QGuiApplication.clipboard().mimeData()


def focus_list(editor):
    editor.show_dock("curvesDock")
    view = editor.window.commands[CurveListCommands].panel.view
    view.setFocus()
    return view


def lock(editor, *places):
    document = editor.session.document
    curves = (replace(each, locked=at in places) for at, each in enumerate(document.curves))
    editor.session.commit(replace(document, curves=tuple(curves)), "Lock")


# Copy


def test_with_nothing_selected_the_edited_curve_is_copied(three):
    three.key(*KEYS["copy"])
    assert three.status == "Copied “B”."
    assert held().hasFormat(CURVES)


def test_selected_points_are_copied_before_the_curve(three):
    three.select([1, 2])
    three.key(*KEYS["copy"])
    assert three.status == "Copied 2 points."
    assert held().hasFormat(POINTS)
    assert held().text() == "1.0\t4.0\n2.0\t3.0"


def test_with_the_focus_in_the_list_its_curves_are_copied_whatever_points_are_selected(three):
    three.select([1, 2])
    QTest.keyClick(focus_list(three), *KEYS["copy"])
    assert three.status == "Copied “B”."
    assert held().hasFormat(CURVES)


def test_a_copy_is_pasted_from_the_focused_list(three):
    view = focus_list(three)
    QTest.keyClick(view, *KEYS["copy"])
    QTest.keyClick(view, Qt.Key.Key_V, CTRL | ALT)
    assert [each.name for each in three.session.document.curves] == ["A", "B", "C", "B copy"]


# Cut and delete


@pytest.mark.parametrize("how", ["cut", "delete"])
def test_with_nothing_selected_the_edited_curve_is_deleted(three, how):
    three.key(*KEYS[how])
    assert names(three) == "AC"
    assert undo_text(three) == f"{how.capitalize()} B"
    assert three.status == {"cut": "Cut “B”.", "delete": "Deleted “B”."}[how]
    three.trigger("undo")
    assert names(three) == "ABC"


@pytest.mark.parametrize("how", ["cut", "delete"])
def test_deleting_some_points_keeps_the_curve(three, how):
    three.select([0, 3])
    three.key(*KEYS[how])
    assert [point.position for point in three.curve.points] == [(1, 4), (2, 3)]
    assert undo_text(three) == f"{how.capitalize()} 2 points"


@pytest.mark.parametrize("how", ["cut", "delete"])
def test_deleting_the_last_points_of_a_curve_deletes_the_curve(three, how):
    three.trigger("selectAll")
    three.key(*KEYS[how])
    assert names(three) == "AC"
    assert three.session.selection == frozenset()
    three.trigger("undo")
    assert names(three) == "ABC"


@pytest.mark.parametrize("key", [Qt.Key.Key_Delete, Qt.Key.Key_Backspace])
def test_selected_curves_are_deleted_together(three, key):
    three.session.selected.set_curves({0, 1})
    three.key(key)
    assert names(three) == "C"
    assert three.status == "Deleted 2 curves."


def test_deleting_the_only_curve_empties_the_document(editor):
    editor.session.commit(Document((make_curve([(0, 0), (1, 1)]),), unit="mm"), "Begin")
    editor.key(*KEYS["delete"])
    assert [curve.points for curve in editor.session.document.curves] == [()]
    assert editor.session.document.unit == "mm"
    editor.trigger("undo")
    assert len(editor.curve.points) == 2


def test_without_its_last_points_the_only_curve_stays_of_its_family(editor):
    editor.session.commit(Document((make_curve([(0, 0), (1, 1)], family=HERMITE),)), "Begin")
    editor.window.canvas.setFocus()
    editor.trigger("selectAll")
    editor.key(*KEYS["delete"])
    assert (editor.curve.family, editor.curve.points) == (HERMITE, ())


@pytest.mark.parametrize("how", ["cut", "delete"])
def test_a_locked_curve_is_not_deleted_or_cut_and_the_status_gives_the_reason(three, how):
    lock(three, 1)
    QGuiApplication.clipboard().setText("before")
    three.key(*KEYS[how])
    assert names(three) == "ABC"
    assert three.status == "“B” is locked. Unlock it in the list of curves to change it."
    assert held().text() == "before"
    three.session.selected.set_curves({0, 1})
    three.key(*KEYS[how])
    assert names(three) == "BC"
    assert three.status.endswith("“A”; 1 locked curve stays.")


def test_a_locked_curve_is_copied(three):
    lock(three, 1)
    three.key(*KEYS["copy"])
    three.key(Qt.Key.Key_V, CTRL | ALT)
    assert (three.curve.name, three.curve.locked) == ("B copy", False)


# Duplicate


def test_with_nothing_selected_the_edited_curve_is_duplicated(three):
    three.key(Qt.Key.Key_D, CTRL)
    assert [each.name for each in three.session.document.curves] == ["A", "B", "B copy", "C"]
    assert undo_text(three) == "Duplicate B"


def test_selected_points_are_duplicated_as_a_curve_of_their_own(three):
    three.select([1, 2, 3])
    three.key(Qt.Key.Key_D, CTRL)
    assert [each.name for each in three.session.document.curves] == ["A", "B", "B copy", "C"]
    assert [point.position for point in three.curve.points] == [(1, 4), (2, 3), (3, 4)]
    assert three.session.selection == {0, 1, 2}
    assert undo_text(three) == "Duplicate 3 points"
    three.trigger("undo")
    assert names(three) == "ABC"


@pytest.mark.parametrize("selected", [[0, 1], [1, 2], [1, 2, 3]])
def test_neighbouring_points_duplicated_as_a_curve_keep_the_shape(three, selected):
    whole = three.session.active_view
    start, end = (float(whole.parameters[at]) for at in (selected[0], selected[-1]))
    expected = whole.curve.evaluate(np.linspace(start, end, 41))
    three.select(selected)
    three.key(Qt.Key.Key_D, CTRL)
    part = three.session.active_view.curve
    assert part.domain == (0.0, 1.0)
    assert part.evaluate(np.linspace(0.0, 1.0, 41)) == pytest.approx(expected, abs=1e-12)


def test_points_that_are_no_neighbours_are_duplicated_without_the_points_between(three):
    three.select([0, 2])
    three.key(Qt.Key.Key_D, CTRL)
    assert [point.position for point in three.curve.points] == [(0, 3), (2, 3)]


@pytest.mark.parametrize("selected", [[1], [0, 1, 2, 3]])
def test_one_point_and_all_points_mean_the_curve(three, selected):
    three.select(selected)
    three.key(Qt.Key.Key_D, CTRL)
    assert len(three.session.document.curves) == 4
    assert len(three.curve.points) == 4


# Whole curves, while none is edited


@pytest.mark.parametrize(("how", "left"), [("copy", "ABC"), ("cut", "BC"), ("delete", "BC")])
def test_keys_act_on_a_curve_selected_as_a_whole(three, how, left):
    three.session.selected.select_whole({0})
    three.key(*KEYS[how])
    assert names(three) == left
    assert "“A”" in three.status


@pytest.mark.parametrize("how", ["copy", "cut", "delete"])
def test_without_a_selection_keys_change_nothing(three, how):
    three.session.selected.select_whole(())
    three.session.say("An older answer.")
    three.key(*KEYS[how])
    assert names(three) == "ABC"
    assert three.status == NONE_SELECTED


def test_a_pasted_curve_is_selected_as_a_whole(three):
    three.key(*KEYS["copy"])
    three.key(Qt.Key.Key_V, CTRL | ALT)
    assert not three.session.selected.is_editing
    assert three.session.selected.whole_curves == {3}
    three.key(*KEYS["delete"])
    assert names(three) == "ABC"


def test_points_pasted_while_no_curve_is_edited_are_a_curve_of_their_own(three):
    three.session.selected.select_whole({0})
    three.paste_text("0 0\n1 1\n2 0")
    three.key(Qt.Key.Key_V, CTRL)
    assert len(three.session.document.curves) == 4
    assert len(three.curve.points) == 3
