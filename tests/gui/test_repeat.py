"""The last transform once more, and copies all around; real keys, mouse and fields."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QToolButton, QWidget

from app.document.model import Document, make_curve
from app.document.transforms import rotation
from app.families import HERMITE

Key = Qt.Key
CTRL, SHIFT, ALT = (
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
PETAL = ((1.0, 0.0), (2.0, 0.6), (3.0, 0.0), (2.0, -0.7))


@pytest.fixture
def petal(editor):
    """A petal beside the origin, chosen, and a base."""
    curves = (
        make_curve(PETAL, name="Petal", family=HERMITE),
        make_curve([(-4, -4), (-3, -3), (-1, -4)], name="Base", family=HERMITE),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-6, 6), (-5, 5))
    editor.settle()
    editor.session.selected.choose([0])
    return editor


def points(editor, place=0):
    return np.array([point.position for point in editor.session.document.curves[place].points])


def again(editor):
    editor.key(Key.Key_R, CTRL | ALT)


def turned(places, degrees, about=(0.0, 0.0)):
    by = rotation(degrees, about)
    return np.array([by.point(tuple(place)) for place in places])


def by_typing(key, text, keys=Qt.KeyboardModifier.NoModifier):
    def do(editor):
        editor.key(key, keys)
        editor.type_amount(text)
        editor.key(Key.Key_Return)

    return do


def by_mouse(editor):
    editor.drag((2.0, 0.6), (2.5, 0.1), keys=ALT)


TRANSFORMS = {
    "Rotate": by_typing(Key.Key_R, "30"),
    "Move": by_typing(Key.Key_G, "0.3"),
    "Scale": by_typing(Key.Key_S, "1.5"),
    "Skew": by_typing(Key.Key_R, "10", SHIFT),
    "Flip": lambda editor: editor.key(Key.Key_H),
    "Arrow": lambda editor: editor.key(Key.Key_Right),
    "Drag": by_mouse,
}


@pytest.mark.parametrize("do", TRANSFORMS.values(), ids=TRANSFORMS)
def test_what_was_done_to_one_is_done_once_more_to_it_and_then_to_another(petal, do):
    session = petal.session
    start = points(petal)
    do(petal)
    first = points(petal)
    assert not np.allclose(first, start)
    again(petal)
    # The same map once more.
    pairs = np.hstack([start, np.ones((4, 1))])
    matrix = np.linalg.lstsq(pairs, first, rcond=None)[0]
    assert points(petal) == pytest.approx(np.hstack([first, np.ones((4, 1))]) @ matrix, abs=1e-9)
    assert session.undo_stack.undoText().endswith(" again")
    session.selected.choose([1])
    before = points(petal, 1)
    again(petal)
    after = points(petal, 1)
    assert (after - after.mean(axis=0)) == pytest.approx(
        (before - before.mean(axis=0)) @ matrix[:2], abs=1e-9
    )


def test_a_copy_goes_on_about_the_pivot_so_that_five_keys_make_a_flower(petal):
    session, target = petal.session, petal.window.canvas.tools.target
    target.pivot = (0.0, 0.0)
    by_typing(Key.Key_R, "60")(petal)
    start = points(petal)
    for _ in range(4):
        petal.key(Key.Key_D, CTRL | ALT)
    assert len(session.document.curves) == 6
    assert session.undo_stack.undoText().startswith("Rotate a copy of Petal copy")
    found = {curve.name: place for place, curve in enumerate(session.document.curves)}
    for number in range(1, 5):
        name = "Petal copy" if number == 1 else f"Petal copy {number}"
        assert points(petal, found[name]) == pytest.approx(turned(start, 60 * number), abs=1e-12)
    petal.key(Key.Key_Z, CTRL)
    assert len(session.document.curves) == 5


def test_points_edited_one_by_one_are_no_transform_and_nothing_is_done_before_one(petal):
    again(petal)
    assert "Nothing was moved" in petal.status
    by_typing(Key.Key_R, "30")(petal)
    petal.session.selected.activate(1)
    petal.select([0, 1, 2])
    petal.trigger("alignLeft")
    petal.session.selected.choose([0])
    before = points(petal)
    again(petal)
    middle = petal.session.undo_stack.undoText()
    assert middle == "Rotate Petal by 30° again"
    way, old = points(petal)[2] - points(petal)[0], before[2] - before[0]
    assert math.degrees(math.atan2(*way[::-1]) - math.atan2(*old[::-1])) == pytest.approx(30)


# Copies around


def field(editor, name):
    found = editor.window.findChild(QLineEdit, name)
    assert found is not None
    return found


def enter(editor, edit, text):
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)


def test_petals_are_typed_seen_meanwhile_and_one_step(petal):
    session, start, before = petal.session, points(petal), petal.session.document
    petal.window.canvas.tools.target.pivot = (0.0, 0.0)
    petal.key(Key.Key_C, ALT | SHIFT)
    assert QApplication.focusWidget() is field(petal, "copiesCount")
    QTest.keyClicks(QApplication.focusWidget(), "6")
    petal.settle()
    assert field(petal, "copiesAngle").text() == "60", "all around, until another angle is typed"
    assert len(session.document.curves) == 7
    assert session.is_previewing
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Escape)
    petal.settle()
    assert session.document is before
    assert session.selected.chosen == {0}

    petal.key(Key.Key_C, ALT | SHIFT)
    QTest.keyClicks(QApplication.focusWidget(), "4")
    enter(petal, field(petal, "copiesAngle"), "360/5")
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Return)
    petal.settle()
    assert session.undo_stack.undoText() == "4 of Petal, each by 72°"
    petals = sorted(session.selected.chosen)
    assert [session.document.curves[place].name for place in petals] == [
        "Petal", "Petal copy", "Petal copy 2", "Petal copy 3",
    ]  # fmt: skip
    for number, place in enumerate(petals):
        assert points(petal, place) == pytest.approx(turned(start, 72 * number), abs=1e-12)
    petal.key(Key.Key_Z, CTRL)
    assert session.document == before


def test_a_row_has_a_step_with_its_unit_and_what_cannot_be_is_told_in_the_field(petal):
    petal.set_unit("mm")
    session, start = petal.session, points(petal)
    session.selected.choose([0, 1])
    petal.run_command("Copies Around")
    button = petal.window.findChild(QToolButton, "copiesWay")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    enter(petal, field(petal, "copiesCount"), "1")
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Return)
    frame = petal.window.findChild(QWidget, "copiesField")
    assert "from 2 to" in frame.remark
    assert not session.is_previewing
    enter(petal, field(petal, "copiesCount"), "3")
    enter(petal, field(petal, "copiesX"), "1 cm")
    enter(petal, field(petal, "copiesY"), "-2")
    assert session.is_previewing
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Return)
    petal.settle()
    assert session.undo_stack.undoText() == "3 of 2 curves, each by 10, \N{MINUS SIGN}2"
    assert len(session.selected.chosen) == 6
    found = {curve.name: place for place, curve in enumerate(session.document.curves)}
    assert points(petal, found["Petal copy 2"]) == pytest.approx(start + np.array([20, -4]))


def test_a_grid_is_typed_seen_meanwhile_and_one_step(petal):
    petal.set_unit("mm")
    session, start, before = petal.session, points(petal), petal.session.document
    session.selected.choose([0])
    width, height = petal.window.canvas.tools.target.bounds.size
    petal.run_command("Copies in Rows and Columns")
    frame = petal.window.findChild(QWidget, "copiesField")
    seen = [float(field(petal, name).text().removesuffix(" mm")) for name in ("copiesX", "copiesY")]
    assert seen == pytest.approx([width, height], rel=1e-3), "copies touch, until other steps are typed"
    QTest.keyClicks(QApplication.focusWidget(), "30")
    enter(petal, field(petal, "copiesRows"), "20")
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Return)
    petal.settle()
    assert "There are 2 to 500 in all" in frame.remark
    assert not session.is_previewing
    enter(petal, field(petal, "copiesCount"), "4")
    enter(petal, field(petal, "copiesRows"), "3")
    enter(petal, field(petal, "copiesX"), "1 cm")
    enter(petal, field(petal, "copiesY"), "-7/2")
    assert session.is_previewing
    assert len(session.document.curves) == len(before.curves) + 11
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Escape)
    petal.settle()
    assert session.document is before

    petal.run_command("array grid")
    QTest.keyClicks(QApplication.focusWidget(), "4")
    enter(petal, field(petal, "copiesRows"), "2")
    enter(petal, field(petal, "copiesX"), "1 cm")
    enter(petal, field(petal, "copiesY"), "-7/2")
    QTest.keyClick(QApplication.focusWidget(), Key.Key_Return)
    petal.settle()
    assert session.undo_stack.undoText() == "4 × 2 of Petal, each by 10, \N{MINUS SIGN}3.5"
    made = sorted(session.selected.chosen)
    assert len(made) == 8
    for number, place in enumerate(made):
        shift = np.array([10 * (number % 4), -3.5 * (number // 4)])
        assert points(petal, place) == pytest.approx(start + shift)
    petal.key(Key.Key_Z, CTRL)
    assert session.document == before
