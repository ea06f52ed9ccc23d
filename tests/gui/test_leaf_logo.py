"""A logo of five leaves, 70 mm wide, made by keys and clicks alone, and how many of them it takes."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, sampled_bounds
from hands import Hands
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QToolButton

from app.document.model import Document, make_curve
from app.families import HERMITE

Key = Qt.Key
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier

LEAF = ((0.0, 0.0), (8.0, 14.0), (0.0, 30.0), (-8.0, 14.0))

IN_INKSCAPE = 31
"""Clicks and keys of the same by the manual of Inkscape 1.3, a key with modifiers counted as one.

B, five clicks of the pen; S, a click for the centre and its drag to the foot; Ctrl+Shift+M, the page Rotate,
a click into the angle, Ctrl+A, 7, 2; four times Ctrl+D and a click on Apply; Ctrl+A, the lock, a click into
W, Ctrl+A, 7, 0, Tab. The unit is that of the document in both.
"""


@pytest.fixture
def sheet(editor, point_locale):
    """An empty document in millimetres, of Hermite curves."""
    editor.session.commit(replace(Document((make_curve((), family=HERMITE),)), unit="mm"), "Begin")
    editor.window.canvas.camera.show_box((-60, 60), (-45, 45))
    editor.window.canvas.setFocus()
    editor.settle()
    return editor


def test_five_leaves_around_a_foot_seventy_millimetres_wide(sheet):
    hands = Hands(sheet)
    hands.press(Key.Key_P)
    hands.press(Key.Key_P, SHIFT)
    for place in LEAF:
        hands.click(place)
    hands.click(LEAF[0])
    assert sheet.curve.closed
    hands.press(Key.Key_Escape)
    hands.press(Key.Key_Escape)
    leaf = sheet.session.active_view.curve.evaluate(np.linspace(0, 1, 9))
    hands.press(Key.Key_M, CTRL | SHIFT)
    hands.click_on(QToolButton, "pivotBottom")
    x, y = sheet.window.canvas.marks.pivot
    hands.click_on(QLineEdit, "transformTurn")
    hands.press(Key.Key_A, CTRL)
    hands.type("72")
    for _ in range(4):
        hands.press(Key.Key_D, CTRL)
        hands.press(Key.Key_Return)
    check_leaves(sheet, leaf, (x, y))
    hands.press(Key.Key_Escape)
    hands.press(Key.Key_A, CTRL | SHIFT)
    hands.click_on(QToolButton, "panelProportionsButton")
    hands.press(Key.Key_M, CTRL | SHIFT)
    hands.type("70")
    hands.press(Key.Key_Return)
    width = np.ptp(sampled_bounds(sheet, *range(5)), axis=0)[0]
    assert width == pytest.approx(70.0, abs=CLOSE)
    assert sheet.window.canvas.tools.target.bounds.size[0] == pytest.approx(70.0, abs=1e-11)
    assert hands.count <= IN_INKSCAPE
    sheet.trigger("keepProportions")


"""Clicks and keys of the same by the manual of Inkscape, a key with modifiers counted as one.

B, five clicks and drags of the pen; S, a click for the centre and its drag to the foot; twice Ctrl+D, a drag
of a corner with Ctrl, Ctrl+D, H; Ctrl+A, the lock, a click into W, Ctrl+A, 7, 0, Tab.
"""


def check_leaves(editor, leaf, about):
    """Each leaf is the first one turned about the foot by a multiple of 72°, to rounding."""
    assert len(editor.session.document.curves) == 5
    turns = []
    for view in editor.session.views:
        reached = view.curve.evaluate(np.linspace(0, 1, 9)) - about
        before = leaf - about
        turn = np.vdot(before @ (1, 1j), reached @ (1, 1j))
        turns.append(round(np.degrees(np.angle(turn)) / 72.0, 9) % 5)
        matrix = np.array([[turn.real, -turn.imag], [turn.imag, turn.real]]) / abs(turn)
        assert reached == pytest.approx(before @ matrix.T, abs=1e-11)
    assert sorted(turns) == [0, 1, 2, 3, 4]


def test_a_leaf_is_mirrored_at_its_foot_by_three_keys_and_a_click(sheet):
    sheet.session.commit(
        replace(sheet.session.document, curves=(make_curve(LEAF, name="Leaf", family=HERMITE),)), "Leaf"
    )
    sheet.trigger("openTransform")
    sheet.window.canvas.setFocus()
    hands = Hands(sheet)
    hands.click_on(QToolButton, "pivotRight")
    right = sampled_bounds(sheet)[1][0]
    hands.press(Key.Key_D, CTRL)
    sheet.window.canvas.setFocus()
    hands.press(Key.Key_H)
    one, two = (
        np.array([point.position for point in curve.points]) for curve in sheet.session.document.curves
    )
    assert two == pytest.approx(one * (-1, 1) + (2 * right, 0), abs=CLOSE)
    assert hands.count == 3
