"""Node mode on a compound path: with no point selected all of its contours are meant; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit

from app.document.model import make_curve
from app.families import HERMITE

Key = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
OUTER = ((20.0, 20.0), (60.0, 20.0), (60.0, 80.0), (20.0, 80.0), (15.0, 50.0))
COUNTER = ((30.0, 50.0), (50.0, 50.0), (50.0, 70.0), (30.0, 70.0))


@pytest.fixture
def letter(editor):
    """A letter with a counter in a drawing, made one by Ctrl+K and double-clicked: no node is chosen."""
    editor.new()
    editor.window.canvas.camera.show_box((0, 210), (0, 297))
    contours = [make_curve(places, name="R", family=HERMITE) for places in (OUTER, COUNTER)]
    document = editor.session.document
    curves = tuple(replace(each, closed=True, name=f"R{at}") for at, each in enumerate(contours))
    editor.session.commit(replace(document, curves=curves), "Begin")
    editor.window.canvas.camera.show_box((0, 90), (0, 100))
    editor.session.selected.choose([0, 1])
    editor.window.canvas.setFocus()
    editor.key(Key.Key_K, CTRL)
    editor.trigger("selectTool")
    # On its line.
    editor.double_click(tuple(editor.session.views[0].polyline[7]))
    assert editor.session.selected.is_editing
    assert editor.session.selected.group.parts == ()
    return editor


def places(editor):
    return np.concatenate(
        [[point.position for point in each.points] for each in editor.session.document.curves]
    )


def test_the_panel_counts_the_points_of_all_contours(letter):
    """It said “All 5 points”."""
    letter.trigger("openTransform")
    label = letter.window.findChild(QLabel, "transformWhat")
    assert label.text() == "All 9 points in 2 curves"


def test_a_typed_width_takes_the_counter_along(letter):
    letter.trigger("openTransform")
    before = places(letter)[:, 0]
    edit = letter.window.findChild(QLineEdit, "transformWidth")
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "90")
    QTest.keyClick(edit, Key.Key_Return)
    assert letter.window.canvas.tools.target.bounds.size[0] == pytest.approx(90)
    factors = np.diff(places(letter)[:, 0])[np.diff(before) != 0] / np.diff(before)[np.diff(before) != 0]
    assert factors == pytest.approx(factors[0] * np.ones(len(factors)), abs=1e-9)
    assert factors[0] > 1.5


def test_flips_turns_and_keys_take_all_contours_along(letter):
    target = letter.window.canvas.tools.target
    for key, held, linear in (
        (Key.Key_H, Qt.KeyboardModifier.NoModifier, ((-1, 0), (0, 1))),
        (Key.Key_V, SHIFT, ((1, 0), (0, -1))),
        (Key.Key_BracketLeft, CTRL, ((0, -1), (1, 0))),
    ):
        before, centre = places(letter), np.array(target.centre)
        letter.window.canvas.setFocus()
        letter.key(key, held)
        assert places(letter) == pytest.approx((before - centre) @ np.array(linear).T + centre, abs=1e-9)


@pytest.mark.parametrize(
    ("key", "typed", "linear", "shift"),
    [
        (Key.Key_G, "7", np.eye(2), (7, 0)),
        (Key.Key_S, "2", 2 * np.eye(2), (0, 0)),
        (Key.Key_R, "180", -np.eye(2), (0, 0)),
    ],
)
def test_g_s_and_r_take_all_contours_along(letter, key, typed, linear, shift):
    before, centre = places(letter), np.array(letter.window.canvas.tools.target.centre)
    letter.hover((80, 90))
    letter.key(key)
    letter.type_amount(typed)
    assert letter.status.startswith("All 9 points in 2 curves: ")
    letter.key(Key.Key_Return)
    wanted = (before - centre) @ linear + centre + shift
    assert places(letter) == pytest.approx(wanted, abs=1e-9)
    letter.trigger("undo")
    assert places(letter) == pytest.approx(before, abs=0)


def test_a_chosen_node_is_meant_alone(letter):
    letter.click((60, 20))
    before = places(letter)
    letter.key(Key.Key_Right)
    moved = np.abs(places(letter) - before).max(axis=1) > 0
    assert moved.tolist() == [False, True, *[False] * 7]


def test_reverse_opening_and_the_family_are_of_all_contours(letter):
    before = places(letter)
    letter.key(Key.Key_R, CTRL)
    curves = letter.session.document.curves
    assert {point.position for curve in curves for point in curve.points} == set(map(tuple, before))
    assert all(
        [point.position for point in curve.points] != list(old)
        for curve, old in zip(curves, (OUTER, COUNTER), strict=True)
    )
    letter.trigger("closeCurve")
    assert [curve.closed for curve in letter.session.document.curves] == [False, False]
    letter.trigger("undo")
    letter.trigger("familyLagrange")
    assert {curve.family.name for curve in letter.session.document.curves} == {"lagrange"}


def test_with_a_node_chosen_its_contour_alone_is_reversed(letter):
    letter.click((60, 20))
    letter.key(Key.Key_R, CTRL)
    assert [point.position for point in letter.session.document.curves[1].points] == list(COUNTER)
    assert [point.position for point in letter.session.document.curves[0].points] != list(OUTER)
