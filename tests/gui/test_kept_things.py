"""Texts and pictures of an opened drawing on the canvas: shown, hidden, and no work under a drag."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor

from app.canvas import kept_layer
from tests.effort import noted_calls
from tests.gui.pixels import is_colour

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<path id="area" d="M5 5H60V55H5Z" fill="#ffffee"/><path id="line" d="M10 50L90 50" stroke="#0000ff"/>'
    '<text id="t" x="10" y="30" font-size="20" font-weight="900" fill="#ff0000">MMM</text></svg>'
)
RED = QColor("#ff0000")


@pytest.fixture
def drawing(open_drawing):
    """An SVG opened as a document."""
    return open_drawing(DRAWING)


def red(editor):
    """Return the box of what is red on the canvas, in the plane; None where nothing is."""
    canvas = editor.window.context.central.canvas
    viewport = canvas.viewport()
    found = is_colour(viewport.grab().toImage().scaled(viewport.size() * 1 or QSize()), RED)
    if not found.any():
        return None
    rows, columns = np.nonzero(found)
    origin, shown = canvas.camera.origin, canvas.pixel_map
    left, top = shown.plane(columns.min() - origin.x(), rows.min() - origin.y())
    right, bottom = shown.plane(columns.max() + 1 - origin.x(), rows.max() + 1 - origin.y())
    return np.array([left, bottom, right, top])


def test_a_text_is_seen_where_it_is_and_hidden_by_its_switch(drawing):
    before = red(drawing)
    shown = drawing.window.context.central.canvas.pixel_map
    # On the page, which hangs at the lower left: the baseline lies 30 mm above that.
    assert before[:2] == pytest.approx([11, 30], abs=1 + 2 / shown.sx)
    assert 20 < before[2] - before[0] < 75
    assert before[3] - before[1] == pytest.approx(14.6, abs=0.5 + 2 / shown.sx)
    drawing.trigger("toggleKept")
    assert red(drawing) is None
    drawing.trigger("toggleKept")
    assert red(drawing) == pytest.approx(before)


def test_it_goes_and_comes_back_with_the_document(drawing, tmp_path):
    texts = drawing.session.document.kept_texts
    drawing.session.selected.choose({1})
    drawing.trigger("deleteSelection")
    assert drawing.session.document.kept_texts is texts
    drawing.session.save(tmp_path / "a.curve.json")
    drawing.session.new()
    drawing.settle()
    assert red(drawing) is None
    assert not drawing.action("toggleKept").isEnabled()
    drawing.session.open(tmp_path / "a.curve.json")
    drawing.settle()
    assert drawing.session.document.kept_texts == texts
    drawing.trigger("fitView")
    assert red(drawing) is not None


def test_a_drag_copies_one_sheet(drawing, monkeypatch):
    """A view that moves is painted anew; a point that moves is not."""
    drawing.session.selected.activate(1)
    drawing.settle()
    red(drawing)
    painted = noted_calls(monkeypatch, kept_layer, "paint_kept")
    steps = [(10 + step, 12) for step in range(1, 6)]
    drawing.press((10, 10))
    for step in steps:
        drawing.move(step)
        red(drawing)
    drawing.release(steps[-1])
    assert drawing.session.document.curves[1].points[0].x != 10.0
    assert painted == []
    drawing.trigger("zoomIn")
    red(drawing)
    assert len(painted) == 1


def test_the_status_line_says_what_it_is(drawing):
    hints = []
    drawing.window.context.central.canvas.hint_changed.connect(hints.append)
    drawing.move((75, 33), held=False)
    assert "Text" not in hints[-1]
    drawing.move((15, 35), held=False)
    assert hints[-1].startswith("Text “MMM” · ")
    drawing.trigger("addTool")
    drawing.move((16, 35), held=False)
    assert "Text" not in hints[-1]
    drawing.trigger("selectTool")
    drawing.trigger("toggleKept")
    drawing.move((15, 35), held=False)
    assert "Text" not in hints[-1]
    drawing.trigger("toggleKept")


def texts_of(drawing):
    return [(each.x, each.y) for each in drawing.session.document.kept_texts]


def test_a_text_is_dragged_nudged_and_deleted(drawing):
    session, tools = drawing.session, drawing.window.context.central.canvas.tools
    session.selected.choose({1})
    begun = session.document
    (home,) = texts_of(drawing)
    drawing.press((15, 35))
    drawing.move((20, 39))
    assert texts_of(drawing) == [pytest.approx((home[0] + 5, home[1] + 4), abs=0.3)]
    assert red(drawing)[:2] == pytest.approx([16, 34], abs=1.5)
    drawing.key(Qt.Key.Key_Escape)
    drawing.release((20, 39))
    assert session.document is begun
    drawing.drag((15, 35), (20, 39))
    assert session.undo_stack.undoText() == "Move text “MMM”"
    # The curves that were chosen are let go, and Ctrl keeps to an axis.
    assert session.selected.chosen == frozenset()
    assert tools.marks().kept == session.document.kept_texts
    (there,) = texts_of(drawing)
    drawing.key(Qt.Key.Key_Right)
    ((x, y),) = texts_of(drawing)
    assert x > there[0]
    assert y == there[1]
    drawing.key(Qt.Key.Key_Delete)
    assert session.document.kept_texts == ()
    assert session.document.curves == begun.curves
    assert session.undo_stack.undoText() == "Delete text “MMM”"
    for _ in range(3):
        drawing.trigger("undo")
    assert texts_of(drawing) == [home]
    assert not session.undo_stack.canUndo()


def test_curves_let_a_text_go_and_points_come_first(drawing):
    session, tools = drawing.session, drawing.window.context.central.canvas.tools
    session.selected.choose(())
    drawing.click((15, 35))
    assert tools.marks().kept
    drawing.click((75, 10))
    assert session.selected.chosen == {1}
    assert tools.marks().kept == ()
    # Delete is about the curve.
    drawing.trigger("deleteSelection")
    assert len(session.document.curves) == 1
    assert len(session.document.kept_texts) == 1
    drawing.trigger("undo")
    drawing.click((15, 35))
    drawing.key(Qt.Key.Key_Escape)
    assert tools.marks().kept == ()
    # While points are edited a drag is a rubber band, and a click is about the text.
    session.selected.activate(1)
    before = session.document
    drawing.drag((15, 35), (25, 40))
    assert session.document is before
    assert session.selected.is_editing
    drawing.click((15, 35))
    assert tools.marks().kept
    assert not session.selected.is_editing
