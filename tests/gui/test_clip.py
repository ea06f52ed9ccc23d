"""Shapes cut by the one in front, made whole again, and curves that a file has cut; real clicks."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from app.document.style import PLAIN_STYLE
from app.exchange.svg.reader import read_svg
from app.view_model.boxes.bounds import seen_line_box

SHIFT = Qt.KeyboardModifier.ShiftModifier
DISC, RED = "#ff8800", "#cc0000"

# The frame from −1 to 9 has a hole from 2 to 6; the bar is cut by the file to what is left of −7.
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" viewBox="-10 -10 20 20">
<clipPath id="c"><path d="M-10-10H-7L-7 10H-9L-10 9Z"/></clipPath>
<path id="Bar" d="M-9 5H9V7H-9Z" fill="#cc0000" clip-path="url(#c)"/>
<circle id="Disc" r="4" fill="#ff8800"/>
<path id="Frame" d="M-1 -1H9V9H-1Z M2 2V6H6V2Z" fill="#0088ff"/></svg>"""

LEFT, IN_BOTH, IN_HOLE, FRAME = (-2.0, 1.3), (0.4, -1.7), (2.2, -2.2), (7.5, -1.3)
SEEN, CUT = (-8.0, -6.0), (-4.0, -6.0)


@pytest.fixture
def drawing(editor):
    """The drawing, y up, nothing chosen, without a grid."""
    editor.window.context.store.change(grid=False)
    editor.session.commit(read_svg(DRAWING.encode(), None).document, "Begin", active=0)
    editor.session.selected.choose([])
    editor.window.canvas.camera.show_box((-11, 11), (-11, 11))
    editor.settle()
    return editor


def colours(editor, *places):
    canvas = editor.window.canvas
    editor.settle()
    image = canvas.viewport().grab().toImage()
    return [QColor(image.pixel(canvas.to_pixel(*place))).name() for place in places]


def chosen(editor):
    return [editor.session.document.curves[place].name for place in sorted(editor.session.selected.chosen)]


def names_in(editor):
    return [curve.name for curve in editor.session.document.curves]


def test_the_shape_in_front_cuts_the_others_and_comes_back(drawing):
    session, before = drawing.session, drawing.session.document
    drawing.click(LEFT)
    drawing.click(FRAME, keys=SHIFT)
    drawing.trigger("setClip")
    assert session.undo_stack.undoText() == "Set clip of Disc and Frame"
    assert chosen(drawing) == ["Disc"]
    drawing.escape()
    drawing.session.selected.choose([])
    left, both, hole, frame = colours(drawing, LEFT, IN_BOTH, IN_HOLE, FRAME)
    assert (both, DISC not in (left, hole, frame)) == (DISC, True)
    # What is cut away is no more in the way than paper is.
    drawing.click(LEFT)
    assert chosen(drawing) == []
    drawing.click(IN_BOTH)
    assert chosen(drawing) == ["Disc"]
    # Moved, it shows the same of itself.
    drawing.drag(IN_BOTH, to=(IN_BOTH[0] - 4, IN_BOTH[1] + 4))
    drawing.session.selected.choose([])
    assert colours(drawing, (IN_BOTH[0] - 4, IN_BOTH[1] + 4), IN_BOTH)[0] == DISC
    session.undo_stack.undo()
    drawing.click(IN_BOTH)
    drawing.trigger("releaseClip")
    assert session.undo_stack.undoText() == "Release clip of Disc"
    names = [curve.name for curve in session.document.curves]
    assert names == ["Bar", "Disc", "Clip (1)", "Clip (2)"]
    disc, outer, hole = session.document.curves[1:]
    assert (disc.style, outer.style.stroke) == (before.curves[1].style, PLAIN_STYLE.stroke)
    frame = [[point.position for point in curve.points] for curve in before.curves[2:]]
    for curve, places in zip((outer, hole), frame, strict=True):
        assert {point.position for point in curve.points} == set(places)
    session.undo_stack.undo()
    session.undo_stack.undo()
    assert session.document == before


def test_a_curve_that_its_file_has_cut_is_whole_as_a_thin_line_and_while_it_is_edited(drawing):
    seen, cut = colours(drawing, SEEN, CUT)
    assert (seen, cut != RED) == (RED, True)
    drawing.click(CUT)
    assert chosen(drawing) == []
    drawing.click(SEEN)
    assert chosen(drawing) == ["Bar"]
    edge = (-4.0, -5.0)
    drawing.session.selected.choose([])
    (paper, faint) = colours(drawing, (-4.0, -8.5), edge)
    assert paper == faint
    drawing.double_click(SEEN)
    (faint,) = colours(drawing, edge)
    assert paper != faint


def test_what_marks_a_clipped_shape_as_chosen_is_around_what_is_seen_of_it(drawing):
    places = [(x, -2.0) for x in np.linspace(-4.3, 4.5, 400)]
    drawing.click(LEFT)
    drawing.click(FRAME, keys=SHIFT)
    drawing.trigger("setClip")
    assert chosen(drawing) == ["Disc"]
    disc = drawing.session.views[1]
    low, high = seen_line_box(disc)
    assert (low, high) == (pytest.approx((-1, -4), abs=0.1), pytest.approx((4, 1), abs=0.1))
    chosen_looks = colours(drawing, *places)
    drawing.session.selected.choose([])
    pairs = zip(places, chosen_looks, colours(drawing, *places), strict=True)
    marked = [x for (x, _y), one, other in pairs if one != other]
    # A pixel or two beside it, and nothing where the rest of it lay.
    assert marked
    assert all(min(abs(x - low[0]), abs(x - high[0])) < 0.3 for x in marked)


def test_only_what_is_clipped_is_released_and_one_shape_cuts_nothing(drawing):
    drawing.click(LEFT)
    assert not drawing.action("setClip").isEnabled()
    assert not drawing.action("releaseClip").isEnabled()


def test_the_outline_of_a_clip_is_edited_live_and_put_back_by_escape(drawing):
    session = drawing.session
    drawing.click(LEFT)
    drawing.click(FRAME, keys=SHIFT)
    drawing.trigger("setClip")
    before = session.document
    drawing.trigger("editClip")
    assert session.undo_stack.undoText() == "Edit clip of Disc"
    names = [curve.name for curve in session.document.curves]
    assert names == ["Bar", "Disc", "Clip (1)", "Clip (2)"]
    assert session.selected.is_editing
    # The corner of the outer ring at (-1, 1), y up, goes to (-3, 3): more of the disc is seen.
    more = (-1.5, 1.0)
    (hidden,) = colours(drawing, more)
    assert hidden != DISC
    drawing.drag((-1.0, 1.0), to=(-3.0, 3.0))
    assert session.undo_stack.undoText() != "Edit clip of Disc"
    (seen,) = colours(drawing, more)
    assert seen == DISC
    while session.selected.is_editing:
        drawing.escape()
    drawing.settle()
    assert session.undo_stack.undoText() == "Put back clip of Disc"
    assert [curve.name for curve in session.document.curves] == ["Bar", "Disc"]
    assert chosen(drawing) == ["Disc"]
    (ring, _hole) = session.document.curves[1].style.clips[0].rings
    # Within a pixel of where the corner was dropped.
    assert min(np.hypot(x + 3, y - 3) for x, y in ring.places) < 0.05
    session.undo_stack.undo()
    assert [curve.name for curve in session.document.curves] == names
    session.undo_stack.undo()
    session.undo_stack.undo()
    assert session.document == before


def test_escape_or_a_click_on_something_else_puts_the_outline_back_as_it_was(drawing):
    session = drawing.session
    drawing.click(SEEN)
    bar = session.document.curves[0].style.clips[0]
    drawing.trigger("editClip")
    assert names_in(drawing) == ["Bar", "Clip", "Disc", "Frame (1)", "Frame (2)"]
    drawing.escape()
    drawing.settle()
    assert names_in(drawing) == ["Bar", "Disc", "Frame (1)", "Frame (2)"]
    assert chosen(drawing) == ["Bar"]
    drawing.trigger("editClip")
    # While points are edited a click in another curve edits that.
    drawing.click(LEFT)
    drawing.settle()
    assert names_in(drawing) == ["Bar", "Disc", "Frame (1)", "Frame (2)"]
    assert session.selected.edited == {1}
    # What was not touched is the same outline, but for roundings.
    (again,) = session.document.curves[0].style.clips
    corners, old = (
        {(round(x, 9), round(y, 9)) for x, y in each.rings[0].places[::3]} for each in (again, bar)
    )
    assert {tuple(each) for each in corners} == {tuple(each) for each in old}


def test_the_outline_follows_a_cancelled_drag_back_and_other_clips_stay(drawing):
    session = drawing.session
    drawing.click(LEFT)
    drawing.click(FRAME, keys=SHIFT)
    drawing.trigger("setClip")
    bar = session.document.curves[0]
    drawing.trigger("editClip")
    before = session.document
    drawing.press((-1.0, 1.0))
    drawing.move((-2.0, 2.0))
    drawing.move((-3.0, 3.0))
    assert session.document.curves[1].style != before.curves[1].style
    drawing.escape()
    assert session.document == before
    drawing.release((-3.0, 3.0))
    assert session.document == before
    assert session.document.curves[0] is bar
