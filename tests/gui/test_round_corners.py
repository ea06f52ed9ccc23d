"""Corners rounded by a radius that is typed on the canvas; real clicks and keys."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest

from app.document.model import Document, make_curve
from app.exchange.svg.reader import read_svg
from app.features.shapes.corner_commands import CornerCommands

# A triangle, a door with an arch above two corners, and a line; y down.
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<g id="Signs"><path id="Tent" d="M10 40H50L30 10Z"/><path id="Door" d="M60 40V20C65 0 85 0 90 20V40Z"/></g>
<path id="Wave" d="M10 60C20 50 30 70 40 60"/></svg>"""


@pytest.fixture
def drawing(editor):
    """The drawing in mm, below the origin; nothing is chosen."""
    editor.session.commit(read_svg(DRAWING.encode(), None).document, "Begin", active=0)
    editor.session.selected.choose([])
    editor.window.canvas.camera.show_box((-5, 105), (-105, 5))
    editor.settle()
    yield editor
    editor.new()
    editor.settle()


def field_of(editor):
    return editor.window.commands[CornerCommands].field


def enter(editor, text, *, waits=True):
    QTest.keySequence(editor.window, QKeySequence("Alt+Shift+R"))
    field = field_of(editor)
    assert (field.isVisible(), field.edit.hasFocus()) == (True, True)
    QTest.keyClicks(field.edit, text)
    QTest.keyClick(field.edit, Qt.Key.Key_Return)
    if waits:
        editor.wait_for_work()


def count(editor, name):
    return next(len(each.points) for each in editor.session.document.curves if each.name == name)


def test_a_rectangle_that_was_just_drawn_gets_round_corners(drawing):
    session = drawing.session
    drawing.trigger("rectangleTool")
    drawing.drag((20, -95), (80, -70))
    drawn = session.document
    corners = np.array([point.position for point in session.active_curve.points])
    low, high = corners.min(axis=0), corners.max(axis=0)
    enter(drawing, "5 mm")
    assert drawing.status.startswith("4 corners are round now.")
    assert session.undo_stack.undoText() == f"Round 4 corners of {session.active_curve.name}"
    outline = session.active_view.polyline
    assert [*outline.min(axis=0), *outline.max(axis=0)] == pytest.approx([*low, *high], abs=1e-9)
    # Within the arc of each corner, what is drawn is 5 mm from its centre.
    inner = np.clip(outline, low + 5, high - 5)
    arcs = ((outline < low + 5) | (outline > high - 5)).all(axis=1)
    assert arcs.sum() > 20
    assert np.hypot(*(outline - inner)[arcs].T) == pytest.approx(5.0, rel=5e-3)
    field = field_of(drawing)
    assert (field.isVisible(), drawing.window.canvas.hasFocus()) == (False, True)
    QTest.keySequence(drawing.window, QKeySequence("Ctrl+Z"))
    assert session.document == drawn
    QTest.keySequence(drawing.window, QKeySequence("Alt+Shift+R"))
    assert (field.edit.text(), field.edit.selectedText()) == ("5 mm", "5 mm")
    QTest.keyClick(field.edit, Qt.Key.Key_Escape)
    assert (field.isVisible(), session.document == drawn) == (False, True)


def test_all_corners_of_a_group_also_beside_curves_and_where_it_does_not_fit_is_said(drawing):
    drawing.click((30, -30))
    enter(drawing, "1.2 cm")
    assert drawing.status == (
        "7 corners are round now; 1.2 cm does not fit at 2 of them, so the largest radius that does was "
        "taken."
    )
    assert drawing.session.undo_stack.undoText() == "Round 7 corners of Signs"
    assert (count(drawing, "Tent"), count(drawing, "Door")) == (7, 8)
    drawing.click((25, -60))
    enter(drawing, "1")
    assert drawing.status.startswith("There is no corner to round.")


def test_selected_corners_alone_become_arcs_which_are_selected(drawing):
    session = drawing.session
    # The first enters the group.
    drawing.double_click((30, -30))
    drawing.double_click((30, -30))
    tent = next(place for place, each in enumerate(session.document.curves) if each.name == "Tent")
    drawing.click((50, -40))
    assert session.selected.group.parts == ((tent, frozenset({1})),)
    enter(drawing, "0")
    field = field_of(drawing)
    assert field.remark == "⚠ Type a radius above 0."
    QTest.keyClicks(field.edit, "2")
    QTest.keyClick(field.edit, Qt.Key.Key_Return)
    drawing.wait_for_work()
    assert session.undo_stack.undoText() == "Round 1 corner of Tent"
    assert session.selected.group.parts == ((tent, frozenset({1, 2, 3})),)
    # Once more: the arc is selected, and no corner.
    enter(drawing, "2")
    assert drawing.status.startswith("There is no corner")


def test_what_has_no_segments_is_refused_with_the_reason(drawing):
    curve = make_curve([(0, 0), (50, -50), (90, 0)])
    drawing.session.commit(Document((curve,), unit="mm"), "Begin", active=0)
    drawing.session.selected.activate(0)
    enter(drawing, "3")
    assert "has no segments of its own; choose" in drawing.status
    assert drawing.session.document.curves == (curve,)


def test_corners_of_many_curves_are_rounded_beside_the_window(drawing):
    """The window stood still for 2.6 s with 500 of them; none is computed in its thread."""
    boxes = "".join(f'<path d="M{3 * (k % 10)} {3 * (k // 10)}h2v2h-2z"/>' for k in range(100))
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 30">{boxes}</svg>'
    session, jobs = drawing.session, drawing.window.context.work.jobs
    session.commit(read_svg(text.encode(), None).document, "Boxes", active=0)
    session.selected.choose(range(100))
    drawn, shares = session.document, []
    jobs.progressed.connect(lambda share, _: shares.append(share))
    enter(drawing, "0.5", waits=False)
    assert (jobs.is_busy, session.document is drawn) == (True, True)
    QTest.keySequence(drawing.window, QKeySequence("Ctrl+."))
    assert drawing.status.endswith("was stopped; nothing has changed.")
    assert session.document is drawn
    shares.clear()
    enter(drawing, "0.5")
    assert drawing.status == "400 corners are round now."
    assert {len(curve.points) for curve in session.document.curves} == {8}
    assert {len(curve.points) for curve in drawn.curves} == {4}
    assert (shares == sorted(shares), bool(shares)) == (True, True)
    QTest.keySequence(drawing.window, QKeySequence("Ctrl+Z"))
    assert session.document == drawn
