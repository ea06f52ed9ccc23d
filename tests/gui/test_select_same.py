"""Chosen by what is chosen: what looks the same, and what is not chosen now; the real menu and key."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu

from app.actions.mnemonics import plain
from app.document.gradient import Gradient, Stop
from app.document.model import Document, make_curve
from app.document.selection import NONE_FREE
from app.document.style import NO_PAINT, Style

RED, BLUE = "#d55e00", "#0072b2"
GRADIENT = Gradient((Stop(0.0, RED), Stop(1.0, BLUE)))
ELSEWHERE = replace(GRADIENT, start=(4.0, 4.0), end=(9.0, 7.0), side=(3.0, 9.0))

LOOKS = {
    "A": Style(fill=RED, stroke=BLUE, width=2.0),
    "B": Style(fill=RED, stroke=BLUE, width=2.0, fill_opacity=0.5),
    "C": Style(fill=RED, stroke=NO_PAINT, width=7.0),
    "D": Style(fill=BLUE, stroke=BLUE, width=2.0, dash=(2.0, 1.0)),
    "E": Style(fill=RED, stroke=NO_PAINT, width=2.0),
    "F": Style().with_gradient("fill", GRADIENT),
    "G": Style().with_gradient("fill", ELSEWHERE),
    "H": Style(fill=RED, stroke=BLUE, width=2.0),
}


@pytest.fixture
def looks(editor):
    """Curves side by side, each with the look of its name; H is locked."""
    curves = [
        replace(make_curve([(3 * at, 0), (3 * at + 1, 1), (3 * at + 2, 0)], name=name), style=style)
        for at, (name, style) in enumerate(LOOKS.items())
    ]
    curves[-1] = replace(curves[-1], locked=True)
    editor.session.commit(Document(tuple(curves)), "Begin")
    editor.fit()
    return editor


def chosen(editor):
    session = editor.session
    return "".join(session.document.curves[place].name for place in sorted(session.selected.chosen))


def select_same(editor, names, entry):
    """Choose curves, and click on an entry of the submenu."""
    editor.session.selected.choose(["ABCDEFGH".index(name) for name in names])
    menu = editor.window.findChild(QMenu, "select_sameMenu")
    menu.popup(QPoint(0, 0))
    (found,) = [each for each in menu.actions() if plain(each.text()) == entry]
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(found).center())
    editor.settle()


def press(editor):
    editor.key(Qt.Key.Key_Exclam)


@pytest.mark.parametrize(
    ("names", "entry", "found"),
    [
        ("A", "Fill and Stroke", "AB"),
        ("A", "Fill", "ABCE"),
        ("A", "Stroke", "ABD"),
        ("A", "Stroke Width and Style", "AB"),
        ("C", "Fill and Stroke", "CE"),
        ("AD", "Fill", "ABCDE"),
        # A gradient looks the same wherever it lies.
        ("F", "Fill", "FG"),
    ],
)
def test_what_looks_the_same_is_chosen_where_it_is_seen_and_free(looks, names, entry, found):
    before = looks.session.document
    select_same(looks, names, entry)
    assert chosen(looks) == found
    assert looks.status.endswith("what is hidden or locked is not.") is ("A" in names)
    assert looks.session.document is before


def test_what_is_chosen_and_locked_itself_is_left_out_and_told_where_nothing_is_left(looks):
    select_same(looks, "H", "Fill and Stroke")
    assert chosen(looks) == "AB"
    looks.session.commit(replace(looks.session.document, curves=looks.session.document.curves[-1:]), "Last")
    looks.session.selected.choose([0])
    looks.run_command("Select Same Stroke")
    assert "hidden or locked" in looks.status
    assert chosen(looks) == "H"


def test_a_key_turns_the_choice_around_of_curves_and_of_points(looks):
    selected = looks.session.selected
    selected.choose([0, 2])
    press(looks)
    assert chosen(looks) == "BDEFG"
    press(looks)
    assert chosen(looks) == "AC"
    selected.activate(1)
    looks.select([0])
    press(looks)
    assert looks.session.selection == {1, 2}
    press(looks)
    press(looks)
    assert looks.session.selection == {1, 2}


def test_nothing_is_turned_around_where_all_is_locked(looks):
    curves = tuple(replace(curve, locked=True) for curve in looks.session.document.curves)
    looks.session.commit(Document(curves), "Lock")
    looks.session.selected.choose([])
    press(looks)
    assert looks.status == NONE_FREE
