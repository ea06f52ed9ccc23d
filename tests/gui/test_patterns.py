"""Patterns: chosen in the Style panel, dragged on the canvas, made of objects and taken apart."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton

from app.document.gradient import GradientKind
from app.document.patterns import PATTERNS
from app.exchange.drawing.image import png_file
from app.exchange.options import Options
from app.features.style.panel import StylePanel

LEFT = Qt.MouseButton.LeftButton
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<rect id="Board" x="20" y="20" width="60" height="40" fill="#0088ff"/>
<circle id="Dot" cx="10" cy="80" r="4" fill="#aa0033"/>
<path id="Bar" d="M14 76h6v8h-6z" fill="#00aa33"/></svg>"""


@pytest.fixture
def drawing(open_drawing):
    editor = open_drawing(DRAWING)
    editor.show_dock("styleDock")
    return editor


def choose(editor, *names):
    curves = editor.session.document.curves
    editor.session.selected.choose([place for place, curve in enumerate(curves) if curve.name in names])
    editor.settle()


def click(editor, name):
    panel = editor.window.findChild(StylePanel)
    button = panel.findChild(QToolButton, name)
    assert button.isVisible()
    QTest.mouseClick(button, LEFT)
    editor.settle()


def seen(editor, place):
    """The colour of the canvas at a place."""
    canvas = editor.window.canvas
    pixel = canvas.to_pixel(*place)
    return canvas.viewport().grab().toImage().pixelColor(pixel).name()


def board(editor):
    (curve,) = [each for each in editor.session.document.curves if each.name == "Board"]
    return curve.style


def test_a_fill_becomes_a_pattern_in_its_colour_and_another_one_lies_where_that_did(drawing):
    choose(drawing, "Board")
    click(drawing, "fillKind_pattern")
    first = board(drawing).fill_gradient
    assert (first.kind, first.tile, first.mean) == (GradientKind.PATTERN, PATTERNS[0].tile, "#0088ff")
    # Eight times along the longer side, from the upper left corner on.
    assert first.start == pytest.approx((20.0, 80.0))
    assert first.end == pytest.approx((27.5, 80.0))
    assert first.side == pytest.approx((20.0, 72.5))
    # A stripe of the first tile, and what is clear between.
    assert seen(drawing, (22.0, 78.5)) == "#0088ff"
    assert seen(drawing, (22.0, 74.0)) == "#ffffff"
    assert drawing.session.undo_stack.undoText() == "Fill of Board"
    click(drawing, "fillPattern4")
    dots = board(drawing).fill_gradient
    assert (dots.tile, dots.start, dots.end) == (PATTERNS[4].tile, first.start, first.end)
    click(drawing, "fillKind_flat")
    assert (board(drawing).fill, board(drawing).fill_gradient) == ("#0088ff", None)


def test_a_pattern_takes_another_colour_in_both_of_its_stops(drawing):
    choose(drawing, "Board")
    click(drawing, "fillKind_pattern")
    panel = drawing.window.findChild(StylePanel)
    panel.fill.edit.setFocus()
    panel.fill.edit.selectAll()
    QTest.keyClicks(panel.fill.edit, "#ff0000")
    QTest.keyClick(panel.fill.edit, Qt.Key.Key_Return)
    drawing.settle()
    assert board(drawing).fill_gradient.mean == board(drawing).fill == "#ff0000"
    assert board(drawing).fill_gradient.tile == PATTERNS[0].tile
    assert seen(drawing, (22.0, 78.5)) == "#ff0000"


def test_the_marks_of_a_pattern_are_dragged_and_escape_leaves_it(drawing):
    choose(drawing, "Board")
    click(drawing, "fillKind_pattern")
    before = board(drawing).fill_gradient
    drawing.trigger("gradientTool")
    drawing.settle()
    canvas = drawing.window.canvas
    drawing.drag_pixels(canvas, canvas.to_pixel(20.0, 80.0), canvas.to_pixel(25.0, 70.0))
    moved = board(drawing).fill_gradient
    assert moved.start == pytest.approx((25.0, 70.0), abs=0.5)
    way = np.array(moved.start) - before.start
    assert np.array(moved.end) - before.end == pytest.approx(way)
    assert np.array(moved.side) - before.side == pytest.approx(way)
    drawing.trigger("undo")
    assert board(drawing).fill_gradient == before
    end = canvas.to_pixel(*before.end)
    drawing.drag_pixels(canvas, end, canvas.to_pixel(35.0, 80.0))
    wider = board(drawing).fill_gradient
    assert wider.end == pytest.approx((35.0, 80.0), abs=0.5)
    assert wider.side == pytest.approx(before.side, abs=0.1)


def test_objects_become_a_pattern_that_looks_as_they_did_and_come_out_of_it_again(drawing):
    document = drawing.session.document
    picture = png_file(document, Options(width=400)).content
    choose(drawing, "Dot", "Bar")
    drawing.key(Qt.Key.Key_I, Qt.KeyboardModifier.AltModifier)
    assert [curve.name for curve in drawing.session.document.curves] == ["Board", "Pattern"]
    made = drawing.session.document.curves[1]
    assert drawing.session.selected.chosen == {1}
    assert made.form.noun == "rectangle"
    assert (made.form.width, made.form.height) == pytest.approx((14.0, 8.0), abs=1e-6)
    assert made.style.fill_gradient.kind is GradientKind.PATTERN
    assert _off(picture, png_file(drawing.session.document, Options(width=400)).content) < 0.004
    drawing.trigger("patternToObjects")
    names = {curve.name for curve in drawing.session.document.curves}
    assert {"Board", "Pattern"} < names
    assert len(drawing.session.selected.chosen) == 2
    assert _off(picture, png_file(drawing.session.document, Options(width=400)).content) < 0.004
    drawing.trigger("undo")
    drawing.trigger("undo")
    assert drawing.session.document == document


def _off(one, other):
    """The share of pixels that are not as they were."""
    first, second = (
        QImage.fromData(each).convertToFormat(QImage.Format.Format_Grayscale8) for each in (one, other)
    )
    rows = [np.frombuffer(each.constBits(), np.uint8).astype(int) for each in (first, second)]
    return float((np.abs(rows[0] - rows[1]) > 48).mean())
