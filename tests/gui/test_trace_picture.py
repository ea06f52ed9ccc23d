"""Trace Picture: what is dark becomes a shape, by real keys; against the shapes that were painted."""

from __future__ import annotations

import math

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QLineEdit

from app.document.style import FillRule
from app.features.reference_image.commands import ImageCommands
from app.features.tracing.commands import TraceCommands
from app.view_model.curve.curve_view import view_of

WIDTH, HEIGHT = 240, 160
BLOCK = QRectF(30.25, 20.5, 180.0, 120.0)
HOLE, RADIUS = QPointF(120.25, 80.5), 40.0
PIXEL = 25.4 / 96
"""In millimetres: pictures without a density have 96 dpi."""


def painted(path):
    """A dark block with a round hole on light paper, antialiased."""
    image = QImage(WIDTH, HEIGHT, QImage.Format.Format_RGB32)
    image.fill(QColor("#eeeeee"))
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.fillRect(BLOCK, QColor("#202020"))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor("#eeeeee"))
    painter.drawEllipse(HOLE, RADIUS, RADIUS)
    painter.end()
    assert image.save(str(path))
    return path


@pytest.fixture
def placed(editor, tmp_path, monkeypatch):
    """A drawing with the picture, which is chosen."""
    editor.trigger("newDrawing")
    editor.settle()
    path = painted(tmp_path / "block.png")
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([str(path)], ""))
    editor.trigger("importFile")
    editor.wait_for_work()
    return editor


def field(editor):
    return editor.window.commands[TraceCommands].field


def enter(editor, text=None):
    edit = field(editor).findChild(QLineEdit, "traceBrightness")
    assert edit.hasFocus()
    if text is not None:
        QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)
    editor.wait_for_work()


def in_pixels(curve, corner):
    """The points of a curve in pixels of the picture, y downwards."""
    return [((point.x - corner[0]) / PIXEL, (corner[1] - point.y) / PIXEL) for point in curve.points]


def test_a_block_with_a_round_hole_has_four_corners_and_a_circle(placed):
    frame = placed.session.document.curves[-1]
    corner = frame.points[0].position
    keys = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.ShiftModifier
    placed.key(Qt.Key.Key_B, keys)
    # Half-way between both greys, within a level and what antialiasing leaves to either side.
    assert 20 < float(field(placed).edit.text()) < 85
    enter(placed)
    block, hole = placed.session.document.curves[-2:]
    assert placed.session.selected.chosen == {
        len(placed.session.document.curves) - 2,
        len(placed.session.document.curves) - 1,
    }
    assert block.shape == hole.shape == "Trace of block"
    assert (block.style.fill, block.style.stroke, block.style.fill_rule) == (
        "#000000",
        "none",
        FillRule.EVENODD,
    )
    corners = in_pixels(block, corner)
    assert len(corners) == 4
    for x, y in corners:
        assert min(abs(x - BLOCK.left()), abs(x - BLOCK.right())) < 0.3
        assert min(abs(y - BLOCK.top()), abs(y - BLOCK.bottom())) < 0.3
    assert len(hole.points) <= 8
    x, y = view_of(hole).polyline.T
    radii = np.hypot((x - corner[0]) / PIXEL - HOLE.x(), (corner[1] - y) / PIXEL - HOLE.y())
    # 0.4 is what the fit may be off; softening the picture moves so round an edge by less than 0.02.
    assert np.abs(radii - RADIUS).max() < 0.5
    assert placed.session.undo_stack.undoText() == "Trace block"
    assert "Trace block: 2 outlines, " in placed.status
    placed.trigger("undo")
    assert placed.session.document.curves[-1] == frame


def test_another_brightness_is_typed_and_what_is_none_is_said(placed):
    before = placed.session.document
    placed.trigger("tracePicture")
    enter(placed, "dark")
    assert field(placed).remark
    assert placed.session.document is before
    QTest.keyClick(field(placed).edit, Qt.Key.Key_Escape)
    assert field(placed).isHidden()
    placed.trigger("tracePicture")
    enter(placed, "5 %")
    assert placed.status == "Nothing in “block” is darker than 5 %."
    assert placed.session.document is before


def test_a_picture_that_is_noise_alone_is_not_traced(editor, open_drawing, tmp_path, monkeypatch):
    rng = np.random.default_rng(3)
    pixels = np.kron(rng.integers(0, 2, (90, 90)) * 255, np.ones((6, 6))).astype(np.uint8)
    image = QImage(pixels.tobytes(), 540, 540, 540, QImage.Format.Format_Grayscale8).copy()
    path = tmp_path / "noise.png"
    assert image.save(str(path))
    editor.trigger("newDrawing")
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: ([str(path)], ""))
    editor.trigger("importFile")
    editor.wait_for_work()
    monkeypatch.setattr("app.view_model.shapes.tracing._MOST", 100)
    before = editor.session.document
    editor.trigger("tracePicture")
    enter(editor)
    assert editor.session.document is before
    assert "spots that are darker than" in editor.status
    assert "at most 100 are traced" in editor.status


def test_the_picture_behind_a_sketch_is_traced_where_it_lies(editor, tmp_path):
    editor.window.commands[ImageCommands].trace(painted(tmp_path / "block.png"))
    editor.settle()
    image = editor.session.document.image
    editor.trigger("tracePicture")
    enter(editor)
    block, _ = [curve for curve in editor.session.document.curves if curve.shape == "Trace of block"]
    low, high = view_of(block).drawn_box
    scale = image.width / WIDTH
    found = [*((low - (image.x, image.y)) / scale), *((high - (image.x, image.y)) / scale)]
    expected = [BLOCK.left(), HEIGHT - BLOCK.bottom(), BLOCK.right(), HEIGHT - BLOCK.top()]
    assert np.abs(np.array(found) - expected).max() < 0.3
    assert math.isclose(image.width / image.height, WIDTH / HEIGHT)
