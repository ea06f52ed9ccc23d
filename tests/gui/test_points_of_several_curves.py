"""Points of several curves selected and edited together: of a shape, of chosen curves; real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
Key = Qt.Key


def diamond(size, name, x=0.0, shape="O"):
    points = [(x + size, 0.0), (x, size), (x - size, 0.0), (x, -size)]
    curve = make_curve(points, name=name, family=HERMITE)
    return replace(curve, closed=True, shape=shape, style=Style())


@pytest.fixture
def letter(editor):
    """An O of two contours, of which the outer is edited, and a dot beside it."""
    curves = (diamond(3.0, "Outer"), diamond(1.5, "Inner"), diamond(1.0, "Dot", x=6.0, shape=""))
    editor.session.commit(Document(curves), "Begin", active=0)
    editor.session.selected.activate(0)
    editor.window.canvas.camera.show_box((-5, 8), (-5, 5))
    editor.settle()
    return editor


def places(editor):
    """The points of all curves, (curves, 4, 2)."""
    return np.array([[point.position for point in curve.points] for curve in editor.session.document.curves])


def selected(editor):
    return dict(editor.session.selected.group.parts)


def step_name(editor):
    return editor.session.undo_stack.undoText()


def ways(editor, before):
    return places(editor) - before


def test_a_band_over_both_contours_and_a_drag_moves_the_stem(letter):
    before, document = places(letter), letter.session.document
    letter.press((-4.0, 0.7))
    letter.move((-1.0, -0.7))
    assert letter.status.startswith("2 points in 2 curves selected")
    letter.release((-1.0, -0.7))
    assert selected(letter) == {0: {2}, 1: {2}}
    assert (letter.session.selection, letter.session.active_index) == ({2}, 0)
    letter.hover((-1.5, 0.0))
    assert letter.window.status_line.hint.startswith("Drag to move 2 points in 2 curves")
    letter.drag((-1.5, 0.0), (-2.0, 0.5))
    way = np.zeros((3, 4, 2))
    way[:2, 2] = (-0.5, 0.5)
    assert ways(letter, before) == pytest.approx(way, abs=2 * letter.pixel)
    # To the last bit the same way.
    moved = ways(letter, before)[:2, 2]
    assert moved[0] == pytest.approx(moved[1], abs=1e-12)
    assert (step_name(letter), letter.curve.name) == ("Move 2 points in 2 curves", "Inner")
    assert selected(letter) == {0: {2}, 1: {2}}
    letter.trigger("undo")
    assert letter.session.document == document
    assert selected(letter) == {0: {2}, 1: {2}}


def test_a_band_around_another_contour_alone_edits_that_one(letter):
    letter.drag((-1.7, 1.7), (0.5, -1.8))
    assert selected(letter) == {1: {1, 2, 3}}
    assert (letter.curve.name, letter.session.selection) == ("Inner", {1, 2, 3})
