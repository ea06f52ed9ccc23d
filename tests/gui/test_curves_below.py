"""Alt+click goes down through what lies at one place: the curve below the topmost, then the next below."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE

ALT = Qt.KeyboardModifier.AltModifier
MIDDLE = (2.0, 2.0)


@pytest.fixture
def pile(editor):
    """Three filled squares on one another, and a line far away that is edited."""
    curves = []
    for at, (name, colour) in enumerate((("low", "#336699"), ("mid", "#996633"), ("top", "#669933"))):
        points = ((0 - at, 0), (4, 0), (4, 4 + at), (0 - at, 4))
        curve = make_curve(points, name=name, family=HERMITE)
        curves.append(replace(curve, closed=True, style=Style(fill=colour)))
    line = make_curve(((8, 0), (9, 1)), name="line")
    editor.session.commit(Document((*curves, line)), "Pile", active=3)
    editor.fit()
    return editor


def chosen(editor):
    document = editor.session.document
    return [document.curves[place].name for place in sorted(editor.session.selected.chosen)]


def test_it_chooses_the_next_below_and_comes_round(pile):
    pile.session.selected.choose(())
    pile.click(MIDDLE)
    assert chosen(pile) == ["top"]
    for name, words in (
        ("mid", "2 of 3 here"),
        ("low", "3 of 3 here"),
        ("top", "1 of 3 here"),
        ("mid", "2 of 3"),
    ):
        pile.click(MIDDLE, keys=ALT)
        assert chosen(pile) == [name]
        assert words in pile.status
    assert not pile.session.undo_stack.canUndo() or pile.session.undo_stack.undoText() == "Pile"


def test_with_nothing_chosen_there_it_is_the_one_below_the_topmost(pile):
    pile.session.selected.choose((3,))
    pile.click(MIDDLE, keys=ALT)
    assert chosen(pile) == ["mid"]


def test_while_a_curve_is_edited_it_edits_the_one_below(pile):
    pile.click(MIDDLE)
    assert pile.curve.name == "top"
    for name in ("mid", "low", "top"):
        pile.click(MIDDLE, keys=ALT)
        assert pile.curve.name == name
        assert pile.session.selected.is_editing


def test_a_group_counts_once_while_whole_curves_are_chosen(pile):
    pile.session.selected.choose((0, 1))
    pile.trigger("groupCurves")
    pile.session.selected.choose(())
    pile.click(MIDDLE, keys=ALT)
    assert chosen(pile) == ["low", "mid"]
    assert "2 of 2 here" in pile.status


def test_the_status_line_says_it_before_the_press(pile):
    pile.session.selected.choose(())
    pile.move(MIDDLE, keys=ALT, held=False)
    assert pile.window.status_line.hint.startswith("Click: choose “mid”, 2 of 3 here")
    # One alone: a click like any.
    pile.move((8.5, 0.5), keys=ALT, held=False)
    assert "here" not in pile.window.status_line.hint


def test_a_drag_with_alt_is_a_drag(pile):
    pile.session.selected.choose((2,))
    before = pile.session.document.curves
    pile.drag(MIDDLE, (3.0, 3.0), keys=ALT)
    after = pile.session.document.curves
    assert after[2] != before[2]
    assert after[:2] == before[:2]
    assert chosen(pile) == ["top"]
