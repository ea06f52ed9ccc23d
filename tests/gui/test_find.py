"""Find: the field above the list of curves."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document.model import Document, make_curve
from app.features.curve_list.commands import CurveListCommands

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def finding(editor):
    """Return the editor with named curves, some in groups, and what Ctrl+F shows."""
    names = [("Leaf left", ()), ("Leaf right", ("Leaves",)), ("Stem", ("Leaves",)), ("Sky", ())]
    curves = tuple(
        replace(make_curve([(0, at), (1, at + 1)], name=name), groups=groups)
        for at, (name, groups) in enumerate(names)
    )
    editor.session.commit(Document(curves), "Begin")
    editor.show_dock("curvesDock")
    editor.key(Qt.Key.Key_F, CTRL)
    panel = editor.window.commands[CurveListCommands].panel
    assert panel.finder.hasFocus()
    yield editor, panel
    panel.finder.show_all()


def rows(panel):
    """What is seen of the list, from the top."""
    return [
        panel.model.row(row).name for row in range(panel.model.rowCount()) if not panel.view.isRowHidden(row)
    ]


def test_words_leave_what_they_find_with_what_it_is_in_and_enter_chooses_it(finding):
    editor, panel = finding
    assert rows(panel) == ["Sky", "Leaves", "Leaf left"]
    QTest.keyClicks(panel.finder, "leaf")
    # Also what a folded group holds.
    assert rows(panel) == ["Leaves", "Leaf right", "Leaf left"]
    QTest.keyClicks(panel.finder, " RIG")
    assert rows(panel) == ["Leaves", "Leaf right"]
    QTest.keyClick(panel.finder, Qt.Key.Key_Return)
    assert editor.session.selected.curves == {1}
    assert not editor.session.undo_stack.canUndo() or editor.session.undo_stack.undoText() == "Begin"
    QTest.keyClick(panel.finder, Qt.Key.Key_Escape)
    assert "Sky" in rows(panel)
    assert "Stem" in rows(panel)
    assert not panel.finder.isVisible()
    assert editor.window.canvas.hasFocus()


def test_what_is_drawn_and_renamed_meanwhile_is_found_or_not(finding):
    editor, panel = finding
    QTest.keyClicks(panel.finder, "sky")
    assert rows(panel) == ["Sky"]
    editor.session.change(
        "Rename", lambda document: document.with_curve(3, replace(document.curves[3], name="Sea"))
    )
    assert rows(panel) == []
    QTest.keyClick(panel.finder, Qt.Key.Key_Return)
    assert editor.status == "Nothing is found by these words."
    editor.trigger("undo")
    assert rows(panel) == ["Sky"]
    editor.session.change(
        "More",
        lambda document: replace(
            document, curves=(*document.curves, make_curve([(5, 5), (6, 6)], name="Sky 2"))
        ),
    )
    assert rows(panel) == ["Sky 2", "Sky"]


def test_arrows_go_from_one_found_row_to_the_next(finding):
    editor, panel = finding
    QTest.keyClicks(panel.finder, "leaf")
    right = next(row for row in range(9) if panel.model.row(row).name == "Leaf right")
    place = panel.view.visualRect(panel.model.index(right)).center()
    QTest.mouseClick(panel.view.viewport(), Qt.MouseButton.LeftButton, pos=place)
    panel.view.setFocus()
    for key, curve in ((Qt.Key.Key_Down, 0), (Qt.Key.Key_Down, 0), (Qt.Key.Key_Up, 1)):
        QTest.keyClick(panel.view, key)
        assert editor.session.selected.highlight().curves == {curve}
