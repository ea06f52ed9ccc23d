"""What could not be done: it is said, marked as that, and not taken for a hint."""

from __future__ import annotations

import pytest
from pixels import is_colour
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit

from app.appearance.theme import DARK, LIGHT, ThemeMode
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.features.curve_list.commands import CurveListCommands

CTRL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier
KEYPAD = Qt.KeyboardModifier.KeypadModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def line(editor):
    """Three points of a Lagrange curve."""
    editor.new()
    editor.trigger("selectTool")
    editor.session.commit(Document((make_curve(((0, 0), (1, 2), (3, 1))),)), "Begin")
    editor.settle()
    return editor


def label(editor):
    return editor.window.status_line.findChild(QLabel, "hint")


def has(widget, colour):
    """Whether any pixel of a widget has exactly this colour."""
    return bool(is_colour(widget.grab().toImage(), colour).any())


# Keys of what is disabled

HERMITES = "choose Hermite, quintic Hermite or septic Hermite."
NO_VELOCITIES = f"A Lagrange curve has no velocities at its points; {HERMITES}"
NO_SEGMENTS = f"A Lagrange curve is one polynomial and has no segments. C{HERMITES[1:]}"


@pytest.mark.parametrize(
    ("key", "held", "expected"),
    [
        (Qt.Key.Key_J, CTRL, "“Join Ends of Curves” needs two selected ends, or a second curve."),
        (Qt.Key.Key_2, ALT, NO_VELOCITIES),
        (Qt.Key.Key_4, ALT, NO_SEGMENTS),
        (Qt.Key.Key_4, ALT | KEYPAD, NO_SEGMENTS),
    ],
)
def test_the_keys_of_a_disabled_action_show_its_need(line, key, held, expected):
    line.session.say("An older answer.")
    line.key(key, held)
    assert line.status == expected
    assert line.window.status_line.is_refusal


SO_ALREADY = [
    (Qt.Key.Key_PageUp, CTRL | SHIFT, "The curve is already at the top."),
    (Qt.Key.Key_Home, CTRL | SHIFT, "The curve is already at the top."),
    (Qt.Key.Key_End, CTRL | SHIFT, "The curve is already at the bottom."),
    (Qt.Key.Key_4, ALT, "The segment is already straight."),
]


def test_a_redundant_action_shows_a_message_and_no_refusal(line):
    """Pressed once more, keys were answered by an orange line with a sign."""
    line.choose_family(HERMITE)
    line.select([0, 1])
    line.key(Qt.Key.Key_4, ALT)
    steps = line.session.undo_stack.count()
    for key, held, expected in SO_ALREADY:
        line.session.say("An older answer.")
        line.key(key, held)
        assert (line.status, line.session.undo_stack.count()) == (expected, steps), key
        assert not line.window.status_line.is_refusal, key


def test_select_all_with_all_selected_gives_no_message(line):
    line.key(Qt.Key.Key_A, CTRL)
    line.key(Qt.Key.Key_A, CTRL)
    assert len(line.session.selected.points) == 3
    assert not line.window.status_line.is_refusal
    line.session.selected.select_whole([0])
    for held in (CTRL, CTRL, CTRL | SHIFT, CTRL | SHIFT):
        line.key(Qt.Key.Key_A, held)
        assert line.session.selected.whole_curves == {0}
        assert not line.window.status_line.is_refusal


OF_NOTHING = [
    (Qt.Key.Key_Delete, Qt.KeyboardModifier.NoModifier, "Delete"),
    (Qt.Key.Key_C, CTRL, "Copy"),
    (Qt.Key.Key_X, CTRL, "Cut"),
    (Qt.Key.Key_D, CTRL, "Duplicate"),
]


def test_in_an_empty_document_copy_and_delete_are_refused(editor):
    editor.new()
    editor.trigger("selectTool")
    for key, held, name in OF_NOTHING:
        editor.key(key, held)
        assert editor.status == f"“{name}” needs a selected curve or point.", name
        assert editor.window.status_line.is_refusal, name


def test_refusals_appear_for_keys_in_panels(line):
    line.show_dock("curvesDock")
    view = line.window.commands[CurveListCommands].panel.view
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_J, CTRL)
    assert line.status == "“Join Ends of Curves” needs two selected ends, or a second curve."


def test_changed_keys_show_the_need(line):
    keymap = line.window.actions_by_name.keymap
    key = line.action("splitCurve").shortcut()
    keymap.assign("joinCurve", [key])
    line.key(Qt.Key.Key_B, SHIFT)
    assert line.status.startswith("“Join Ends of Curves” needs")
    keymap.reset_all()


def test_the_keys_of_a_refused_action_work_for_another_family(line):
    line.choose_family(HERMITE)
    line.select([0, 1])
    line.key(Qt.Key.Key_4, ALT)
    assert line.status.startswith("Straight segment 0–1")
    assert not line.window.status_line.is_refusal


@pytest.mark.parametrize("key", [Qt.Key.Key_F4, Qt.Key.Key_Shift, Qt.Key.Key_X])
def test_unassigned_keys_give_no_message(line, key):
    line.session.say("An older answer.")
    line.key(key)
    assert line.status == "An older answer."


def test_letters_typed_into_a_field_are_text(line):
    line.show_dock("curveDock")
    name = line.window.findChild(QLineEdit, "curveName")
    name.setFocus()
    QTest.keyClick(name, Qt.Key.Key_S)
    assert "needs" not in line.status


def test_the_tip_of_every_disabled_action_has_its_need(line):
    line.session.selected.set_points([])
    for name in ("joinCurve", "alignLeft", "distributeVertically", "undo"):
        action = line.action(name)
        assert ("\nNeeds " in action.toolTip()) is not action.isEnabled()
    line.trigger("selectAll")
    assert line.action("alignLeft").isEnabled()
    assert "Needs" not in line.action("alignLeft").toolTip()


def test_an_action_without_a_need_has_a_plain_refusal(line):
    action = line.action("fitView")
    action.setEnabled(False)
    line.key(Qt.Key.Key_F)
    assert line.status == "“Fit View” is not available here."
    action.setEnabled(True)


# Refusals


@pytest.mark.parametrize(("mode", "theme"), [(ThemeMode.LIGHT, LIGHT), (ThemeMode.DARK, DARK)])
def test_a_refusal_has_a_sign_and_the_colour_of_warnings(line, mode, theme):
    line.window.store.change(theme_mode=mode)
    line.session.say("Copied 3 points.")
    line.settle()
    assert label(line).text() == "Copied 3 points."
    assert not has(label(line), theme.warning)
    line.session.refuse("A sentence.")
    line.settle()
    assert label(line).text() == "⚠ A sentence."
    assert line.status == "A sentence."
    assert has(label(line), theme.warning)
    line.session.say("Copied 3 points.")
    assert label(line).text() == "Copied 3 points."


def test_a_locked_curve_refuses_with_the_sign(line):
    line.trigger("curveLocked")
    before = line.session.document
    line.drag_point(1, to=(1.5, 2.5))
    assert "is locked" in line.status
    assert line.window.status_line.is_refusal
    line.trigger("reverseCurve")
    assert "is locked" in line.status
    assert line.window.status_line.is_refusal
    assert line.session.document == before


def test_a_refused_drag_is_marked_until_the_release(line):
    line.trigger("curveLocked")
    line.press(line.point(1))
    line.move((1.6, 2.6))
    assert "is locked" in line.status
    assert label(line).text().startswith("⚠")
    line.escape()
    line.release((1.6, 2.6))
    assert not label(line).text().startswith("⚠")


def test_a_faulty_paste_refuses_with_the_sign(line):
    line.paste_text("1 2\nabc 3")
    line.key(Qt.Key.Key_V, CTRL)
    assert label(line).text() == "⚠ Row 2, column 1: “abc” is not a number."


# A row of titles


WITH_TITLES = [
    ("x y\n4 0\n5 1", [(4, 0), (5, 1)]),
    ("t;x;y\n2;4;0\n3;5;1", [(4, 0), (5, 1)]),
    ("y\tx\n0\t4\n1\t5", [(4, 0), (5, 1)]),
    ("#\tx [mm]\ty [mm]\n0\t4\t0\n1\t5\t1", [(4, 0), (5, 1)]),
    ("# x y\n4 0\n5 1", [(4, 0), (5, 1)]),
]


def test_a_row_of_titles_above_pasted_points_is_skipped(line):
    document = line.session.document
    for text, points in WITH_TITLES:
        line.paste_text(text)
        line.key(Qt.Key.Key_V, CTRL)
        assert line.status == "Pasted 2 points; the row of titles was skipped.", text
        assert [point.position for point in line.curve.points[3:]] == points, text
        line.key(Qt.Key.Key_N, CTRL | ALT)
        assert line.status.endswith("; the row of titles was skipped."), text
        assert [point.position for point in line.curve.points] == points, text
        line.session.commit(document, "Again", active=0)


@pytest.mark.parametrize("titles", ["x vx", "x x", "x y vx"])
def test_a_table_with_other_columns_is_refused(line, titles):
    before = line.session.document
    line.paste_text(titles + "\n" + " ".join("1" for _ in titles.split()))
    line.key(Qt.Key.Key_V, CTRL)
    assert line.status == (
        f"Points have the columns x y or t x y, but the titles are {titles}. "
        "Paste other columns into the point table."
    )
    assert line.session.document is before


# The view follows a point that arrows move


def test_the_view_follows_a_point_that_is_nudged_out_of_sight(line):
    canvas = line.window.canvas
    line.select([2])
    for _ in range(40):
        line.key(Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
        place = canvas.to_pixel(*line.point(2))
        assert canvas.viewport().rect().contains(place)
    assert line.point(2)[0] > 3
