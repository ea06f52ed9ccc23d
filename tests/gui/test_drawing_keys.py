"""Keys of a drawing: those of other programs for drawing, where a sketch has its own."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence

from app.document.paper import DocumentKind
from app.families import HERMITE, LAGRANGE

Key = Qt.Key


@pytest.fixture
def drawing(open_drawing):
    """A drawing of one small square, with its keys on the canvas."""
    editor = open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="40mm" viewBox="0 0 80 40">'
        '<path id="r" d="M2 2H6V6H2Z" fill="#00ff00"/></svg>'
    )
    editor.window.canvas.setFocus()
    return editor


def test_digits_zoom_in_a_drawing_and_choose_families_in_a_sketch(drawing):
    """They refused, and named keys that zoom."""
    drawing.session.selected.choose([0])
    scale = {}
    for key in (Key.Key_1, Key.Key_2, Key.Key_3, Key.Key_5, Key.Key_4):
        drawing.key(key)
        scale[key] = drawing.window.canvas.pixel_map.sx
    assert scale[Key.Key_2] == pytest.approx(scale[Key.Key_1] / 2)
    assert scale[Key.Key_3] == pytest.approx(scale[Key.Key_4], rel=0.01)
    assert scale[Key.Key_3] > 5 * scale[Key.Key_5]
    assert (drawing.curve.family, drawing.session.undo_stack.count()) == (HERMITE, 0)
    drawing.new()
    before = drawing.window.canvas.pixel_map.sx
    drawing.key(Key.Key_1)
    assert (drawing.curve.family, drawing.window.canvas.pixel_map.sx) == (LAGRANGE, before)


def test_a_key_that_the_person_chose_is_theirs_in_documents_of_both_kinds(drawing):
    actions, three = drawing.window.actions_by_name, [QKeySequence("3")]
    keymap = actions.keymap
    assert actions["familyQuinticHermite"].shortcuts() == []
    for name in keymap.bindings:
        assert keymap.is_default(name)
        assert all(keymap.owner_of(key) == name for key in keymap.keys(name))
    keymap.assign("newCurve", three)
    for kind in (DocumentKind.SKETCH, DocumentKind.DRAWING):
        keymap.use(kind)
        assert keymap.keys("newCurve") == three
        assert keymap.owner_of(three[0]) == "newCurve"
    keymap.reset_all()
    assert keymap.keys("fitSelection")[-1] == three[0]


def test_a_key_taken_from_an_action_in_a_drawing_stays_taken_after_a_sketch(drawing):
    """It was the default of the sketch, and so forgotten: "4" fitted the view again."""
    keymap = drawing.window.actions_by_name.keymap
    own = keymap.keys("fitView")
    assert QKeySequence("4") in own
    keymap.assign("fitView", [QKeySequence("F")])
    drawing.new()
    assert keymap.is_default("fitView")
    assert keymap.overrides["fitView"] == "F"
    drawing.trigger("newDrawing")
    assert keymap.keys("fitView") == [QKeySequence("F")]
    keymap.reset("fitView")
    assert keymap.keys("fitView") == own
    assert "fitView" not in keymap.overrides
