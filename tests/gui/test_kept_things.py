"""Texts and pictures of an opened drawing on the canvas: shown, hidden, and no work under a drag."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QSize
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
    assert hints[-1] == "Text “MMM” of the file: it is shown, and stays as it is."
    drawing.trigger("addTool")
    drawing.move((16, 35), held=False)
    assert "Text" not in hints[-1]
    drawing.trigger("selectTool")
    drawing.trigger("toggleKept")
    drawing.move((15, 35), held=False)
    assert "Text" not in hints[-1]
    drawing.trigger("toggleKept")
