"""Objects masked by the one in front, seen through it, and whole again; real clicks and pixels."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

SHIFT = Qt.KeyboardModifier.ShiftModifier
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<linearGradient id="g"><stop stop-color="#000"/><stop offset="1" stop-color="#fff"/></linearGradient>
<rect id="Board" x="10" y="20" width="80" height="40" fill="#0000ff"/>
<circle id="Dot" cx="20" cy="80" r="8" fill="#aa0033"/>
<rect id="Fade" x="20" y="10" width="60" height="60" fill="url(#g)"/></svg>"""


@pytest.fixture
def drawing(open_drawing):
    editor = open_drawing(DRAWING)
    editor.window.context.store.change(grid=False)
    return editor


def colour(editor, *place):
    """The colour of the canvas at a place, with nothing chosen, as red, green and blue."""
    editor.session.selected.choose([])
    editor.settle()
    canvas = editor.window.canvas
    found = canvas.viewport().grab().toImage().pixelColor(canvas.to_pixel(*place))
    return [found.red(), found.green(), found.blue()]


def choose(editor, *names):
    curves = editor.session.document.curves
    editor.session.selected.choose([place for place, curve in enumerate(curves) if curve.name in names])
    editor.settle()


def names_in(editor):
    return [curve.name for curve in editor.session.document.curves]


def test_what_lies_in_front_masks_the_others_and_comes_back(drawing):
    session, before = drawing.session, drawing.session.document
    drawing.click((85.0, 60.0))
    drawing.click((50.0, 35.0), keys=SHIFT)
    drawing.trigger("setMask")
    assert session.undo_stack.undoText() == "Set mask of Board and Fade"
    assert names_in(drawing) == ["Board", "Dot"]
    # From black to white along 60: a quarter of the way there a quarter of the blue is seen.
    for x in (35.0, 50.0, 65.0):
        share = 255.0 * (1.0 - (x - 20.0) / 60.0)
        assert colour(drawing, x, 60.0) == pytest.approx([share, share, 255], abs=4)
    assert colour(drawing, 15.0, 60.0) == colour(drawing, 85.0, 60.0) == [255, 255, 255]
    # It goes with the shape.
    choose(drawing, "Board")
    drawing.drag((60.0, 60.0), to=(60.0, 40.0))
    assert colour(drawing, 50.0, 40.0) == pytest.approx([128, 128, 255], abs=4)
    session.undo_stack.undo()
    choose(drawing, "Board")
    drawing.trigger("releaseMask")
    assert session.undo_stack.undoText() == "Release mask of Board"
    assert names_in(drawing) == ["Board", "Mask", "Dot"]
    board, mask, _ = session.document.curves
    assert board.style == before.curves[0].style
    assert mask.style.fill_gradient is not None
    old, new = ([point.position for point in each.points] for each in (before.curves[2], mask))
    for one, other in zip(old, new, strict=True):
        assert other == pytest.approx(one, abs=1e-9)
    session.undo_stack.undo()
    session.undo_stack.undo()
    assert session.document == before


def test_a_group_masks_and_is_masked_and_comes_back_as_one(drawing):
    choose(drawing, "Dot", "Fade")
    drawing.trigger("groupCurves")
    choose(drawing, "Board", "Dot", "Fade")
    drawing.trigger("setMask")
    assert names_in(drawing) == ["Board"]
    assert colour(drawing, 50.0, 60.0) == pytest.approx([128, 128, 255], abs=4)
    choose(drawing, "Board")
    drawing.trigger("releaseMask")
    _, dot, fade = drawing.session.document.curves
    assert dot.groups[-1:] == fade.groups[-1:] != ()


def test_what_cannot_be_masked_is_not_offered(drawing):
    choose(drawing, "Board")
    assert not drawing.action("setMask").isEnabled()
    assert not drawing.action("releaseMask").isEnabled()
