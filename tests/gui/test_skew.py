"""Skews, and the grips of the box that rotate and skew: a second click, drags, typed angles, the panel."""

from __future__ import annotations

import math

import numpy as np
import pytest
from extents import CLOSE, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QToolButton

from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE
from tests.gui.editor_facts import undo_text

Key = Qt.Key
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.5))


@pytest.fixture
def arch(editor):
    """A curve chosen as a whole, none edited; another one lies below."""
    curves = (
        replace(make_curve(POINTS, name="Arch", family=HERMITE), style=Style(width=0.2)),
        make_curve([(0, -2), (2, -1), (4, -2)], name="Base", family=HERMITE),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.window.canvas.camera.show_box((-5, 9), (-5, 6))
    editor.session.selected.select_whole({0})
    editor.settle()
    return editor


def points(editor, place=0):
    return np.array([point.position for point in editor.session.document.curves[place].points])


def on_curve(editor, place=0):
    return tuple(editor.session.views[place].curve.evaluate(0.47).tolist())


def box(editor):
    return editor.window.canvas.marks.box


def turned(editor):
    """The same with grips that rotate and skew."""
    editor.click(on_curve(editor))
    assert box(editor).turns
    return editor


def plus(place, x, y):
    return (place[0] + x, place[1] + y)


def skewed(about, degrees, axis=0, start=POINTS):
    moved = np.array(start, dtype=float)
    other = 1 - axis
    moved[:, axis] += math.tan(math.radians(degrees)) * (moved[:, other] - about[other])
    return moved


def test_a_second_click_switches_to_rotate_and_skew_grips_and_a_third_to_scale_grips(arch):
    document = arch.session.document
    arch.hover(on_curve(arch))
    assert "Click: grips that rotate and skew" in arch.window.status_line.hint
    for turns in (True, False):
        arch.click(on_curve(arch))
        assert box(arch).turns is turns
        assert arch.action("turnGrips").isChecked() is turns
    assert arch.session.selected.whole_curves == {0}
    turned(arch)
    arch.click(on_curve(arch, 1))
    assert arch.session.selected.whole_curves == {1}
    assert not box(arch).turns, "of what is chosen next the grips scale"
    assert arch.session.document is document


def test_a_click_on_one_of_several_curves_switches_the_grips_of_all(arch):
    arch.session.selected.select_whole({0, 1})
    turned(arch)
    assert arch.session.selected.whole_curves == {0, 1}


def test_ctrl_click_selects_one_curve_of_a_selected_group(arch):
    arch.session.change(
        "Group",
        lambda document: replace(
            document, curves=tuple(replace(curve, groups=("Pair",)) for curve in document.curves)
        ),
    )
    arch.session.selected.select_whole({0, 1})
    arch.click(on_curve(arch), keys=CTRL)
    assert arch.session.selected.whole_curves == {0}
    assert not box(arch).turns


def test_a_side_is_dragged_along_itself_about_the_middle(arch):
    turned(arch)
    for x, y in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        bounds = sampled_bounds(arch, 0)
        centre, half, axis = bounds.mean(axis=0), np.ptp(bounds, axis=0) / 2, int(y == 0)
        start = arch.grip(x, y)
        arch.hover(start)
        hint = "Drag to skew Arch · Ctrl: steps of 15° · Shift: about the opposite side"
        assert arch.window.status_line.hint == hint, (x, y)
        arch.drag(start, plus(start, *np.eye(2)[axis]))
        arm = (x or y) * half[1 - axis]
        way = 1.0
        expected = skewed(centre, math.degrees(math.atan(way / arm)), axis)
        assert points(arch) == pytest.approx(expected, abs=3 * arch.pixel), (x, y)
        assert undo_text(arch) == "Skew Arch", (x, y)
        arch.trigger("undo")
        assert points(arch).tolist() == [list(each) for each in POINTS], (x, y)


def test_ctrl_has_steps_and_shift_keeps_the_opposite_side(arch):
    turned(arch)
    low, high = sampled_bounds(arch, 0)
    start = arch.grip(0, 1)
    arch.drag(start, plus(start, 0.8, 0.0), keys=CTRL)
    assert points(arch) == pytest.approx(skewed((low + high) / 2, 30.0), abs=CLOSE)
    arch.trigger("undo")
    arch.drag(start, plus(start, 0.8, 0.0), keys=SHIFT)
    degrees = math.degrees(math.atan(0.8 / (high - low)[1]))
    assert points(arch) == pytest.approx(skewed(low, degrees), abs=3 * arch.pixel)


def test_a_corner_rotates_and_with_shift_about_the_opposite_corner(arch):
    turned(arch)
    low = sampled_bounds(arch, 0)[0]
    x, y = low
    start = arch.grip(1, 1)
    away = np.subtract(start, low)
    arch.drag(start, (x - away[1], y + away[0]), keys=SHIFT)
    expected = np.array([(x - (b - y), y + (a - x)) for a, b in POINTS])
    assert points(arch) == pytest.approx(expected, abs=4 * arch.pixel)
    assert undo_text(arch) == "Rotate Arch"
    assert box(arch).turns, "the same is chosen still"


@pytest.mark.parametrize("grip", [(0, 1), (1, 0), (1, 1)])
def test_escape_cancels_a_drag_of_a_skew_grip(arch, grip):
    turned(arch)
    document, count = arch.session.document, arch.session.undo_stack.count()
    centre = sampled_bounds(arch, 0).mean(axis=0)
    start = arch.grip(*grip)
    arch.press(start)
    arch.move(plus(start, 0.7, 0.9))
    assert arch.session.document != document
    assert "Escape cancels" in arch.status
    assert arch.window.canvas.marks.pivot == pytest.approx(tuple(centre), abs=CLOSE), "it stays"
    arch.escape()
    arch.release(plus(start, 0.7, 0.9))
    assert arch.session.document is document
    assert arch.session.undo_stack.count() == count
    assert box(arch).turns


@pytest.mark.parametrize(("keys", "axis"), [((), 0), ((Key.Key_Y,), 1), ((Key.Key_Y, Key.Key_X), 0)])
def test_an_angle_is_typed(arch, keys, axis):
    centre = sampled_bounds(arch, 0).mean(axis=0)
    arch.key(Key.Key_R, SHIFT)
    for key in keys:
        arch.key(key)
    arch.type_amount("45")
    assert arch.status.startswith(f"Skew 45° along {'xy'[axis]}")
    arch.key(Key.Key_Return)
    assert points(arch) == pytest.approx(skewed(centre, 45.0, axis), abs=CLOSE)


def test_an_angle_that_flattens_the_selection_is_refused(arch):
    document = arch.session.document
    arch.key(Key.Key_R, SHIFT)
    arch.type_amount("90")
    assert "Enter a skew between −89° and 89°." in arch.status
    arch.escape()
    assert arch.session.document is document


@pytest.mark.parametrize(("button", "axis"), [("Across", 0), ("Up", 1)])
def test_the_panel_skews_by_its_angle_about_the_pivot(arch, button, axis):
    arch.trigger("openTransform")
    QTest.mouseClick(arch.window.findChild(QToolButton, "pivotBottomLeft"), Qt.MouseButton.LeftButton)
    low = sampled_bounds(arch, 0)[0]
    edit = arch.window.findChild(QLineEdit, "transformSkew")
    edit.setFocus()
    edit.selectAll()
    arch.type_text(edit, "-20")
    QTest.mouseClick(arch.window.findChild(QToolButton, f"transformSkew{button}"), Qt.MouseButton.LeftButton)
    assert points(arch) == pytest.approx(skewed(low, -20.0, axis), abs=CLOSE)
    assert undo_text(arch) == f"Skew Arch by −20° along {'xy'[axis]}"


def test_points_of_a_curve_are_skewed_by_the_grips(arch):
    arch.session.selected.activate(0)
    arch.trigger("familyLagrange")  # no handle lies where a grip is
    arch.select([1, 2, 3])
    arch.trigger("turnGrips")
    start = arch.grip(-1, 0)
    arch.drag(start, plus(start, 0.0, -1.5), keys=CTRL)
    expected = np.array(POINTS)
    expected[1:] = skewed((2.5, 1.25), 45.0, axis=1, start=POINTS[1:])
    assert points(arch) == pytest.approx(expected, abs=1e-12)
    assert undo_text(arch) == "Skew 3 points"
