"""The toolbar in windows of different widths, with few families and with many."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox

from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE, Family
from app.testing import Editor
from curvecore import LagrangeCurve

FIRST = (LAGRANGE, HERMITE, QUINTIC_HERMITE)
TEXT, BOTH, ICON = (
    Qt.ToolButtonStyle.ToolButtonTextOnly,
    Qt.ToolButtonStyle.ToolButtonTextBesideIcon,
    Qt.ToolButtonStyle.ToolButtonIconOnly,
)


@pytest.fixture
def editor_with(qtbot):
    """Make an editor of a width that offers so many families: three as they are, the others of the test."""
    others = [family for family in FAMILIES if family not in FIRST]
    added = []

    def editor_with(count, width):
        for family in others:
            FAMILIES.remove(family)
        for k in range(count - len(FIRST)):
            body = {"__slots__": (), "name": f"tests_no_{k}", "title": f"invented no. {k}"}
            added.append(Family.of(type("InventedCurve", (LagrangeCurve,), body)))
            FAMILIES.add(added[-1])
        return Editor(qtbot, size=(width, 800))

    yield editor_with
    for family in added:
        FAMILIES.remove(family)
    for family in others:
        FAMILIES.add(family)


def button_of(editor, name):
    return editor.window.toolbar.widgetForAction(editor.action(name))


def styles(editor):
    return [button_of(editor, family.action_name).toolButtonStyle() for family in FAMILIES]


@pytest.mark.parametrize(
    ("count", "width", "words", "style"),
    [
        (3, 1280, "Quintic Hermite", [BOTH] * 3),
        (3, 1024, "Quintic", [TEXT] * 3),
        (3, 960, "Quintic", [BOTH, ICON, ICON]),
        (4, 1280, "Quintic", [BOTH] * 4),
        (4, 1024, "Quintic", [BOTH, ICON, ICON, ICON]),
        (8, 1280, "Quintic", [BOTH, *[ICON] * 7]),
    ],
)
def test_it_says_as_much_as_there_is_room_for(editor_with, count, width, words, style):
    """With one family more than three, 1057 pixels were the least, and at 1280 no family had its icon."""
    editor = editor_with(count, width)
    toolbar = editor.window.toolbar
    assert toolbar.sizeHint().width() <= toolbar.width() == width
    assert editor.action("familyQuinticHermite").iconText() == words
    assert styles(editor) == style
    assert all(button_of(editor, family.action_name).isVisible() for family in FAMILIES)


@pytest.mark.parametrize(("count", "width"), [(3, 900), (4, 900), (8, 1024)])
def test_the_families_and_the_rule_are_seen_where_not_all_has_room(editor_with, count, width):
    editor = editor_with(count, width)
    assert editor.window.toolbar.sizeHint().width() > editor.window.toolbar.width() == width
    assert styles(editor) == [BOTH, *[ICON] * (count - 1)]
    assert all(button_of(editor, family.action_name).isVisible() for family in FAMILIES)
    assert button_of(editor, "fitView").isVisible()
    box = editor.window.findChild(QComboBox, "parametrizationBox")
    assert box.visibleRegion().boundingRect() == box.rect()


def test_the_words_go_with_the_family_in_use(editor_with):
    editor = editor_with(4, 1024)
    editor.trigger("familyHermite")
    assert styles(editor) == [ICON, BOTH, ICON, ICON]
    editor.trigger("undo")
    assert styles(editor) == [BOTH, ICON, ICON, ICON]


def test_a_wider_window_says_more_again(editor_with):
    editor = editor_with(3, 900)
    editor.window.resize(1280, 800)
    editor.settle()
    assert styles(editor) == [BOTH] * 3
    assert editor.action("familyQuinticHermite").iconText() == "Quintic Hermite"
    editor.window.resize(1024, 800)
    editor.settle()
    assert styles(editor) == [TEXT] * 3
