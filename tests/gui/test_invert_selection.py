"""Invert Selection, by its key: of curves that are chosen, and of points of those that are edited."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.model import Document, make_curve
from app.document.selection import NONE_SELECTABLE
from tests.gui.editor_facts import whole_curve_names


@pytest.fixture
def row(editor):
    """Curves side by side, A to D; D is locked."""
    curves = [
        make_curve([(3 * at, 0), (3 * at + 1, 1), (3 * at + 2, 0)], name=name)
        for at, name in enumerate("ABCD")
    ]
    curves[-1] = replace(curves[-1], locked=True)
    editor.session.commit(Document(tuple(curves)), "Begin")
    editor.fit()
    return editor


def press(editor):
    editor.key(Qt.Key.Key_Exclam)


def test_a_key_turns_the_choice_around_of_curves_and_of_points(row):
    selected = row.session.selected
    selected.select_whole([0])
    press(row)
    assert whole_curve_names(row) == "BC"
    press(row)
    assert whole_curve_names(row) == "A"
    selected.activate(1)
    row.select([0])
    press(row)
    assert row.session.selection == {1, 2}
    press(row)
    press(row)
    assert row.session.selection == {1, 2}


def test_invert_is_refused_when_all_curves_are_locked(row):
    curves = tuple(replace(curve, locked=True) for curve in row.session.document.curves)
    row.session.commit(Document(curves), "Lock")
    row.session.selected.select_whole([])
    press(row)
    assert row.status == NONE_SELECTABLE
