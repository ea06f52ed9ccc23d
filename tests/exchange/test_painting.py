"""Painting of styles: what Qt alone would not do as SVG does."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage, QPainter

from app.document.model import Document, make_curve
from app.document.style import LineCap, LineJoin, Style
from app.exchange.drawing.drawing import drawing_of
from app.exchange.drawing.outlines import Frame
from app.exchange.drawing.painting import Painting
from app.exchange.drawing.styles import INK
from app.families import HERMITE

pytestmark = pytest.mark.usefixtures("qapp")

SQUARE = [(1.0, 1.0), (9.0, 1.0), (9.0, 9.0), (1.0, 9.0)]


def line(points, style, **fields):
    corners = tuple(
        replace(each, corner=True, velocity=(0.0, 0.0), velocity_after=(0.0, 0.0))
        for each in make_curve(points).points
    )
    return replace(make_curve(points, family=HERMITE), points=corners, style=style, **fields)


def painted(*curves):
    """Pixels of a square of 10 by 10 without paper, (100, 100, 4): blue, green, red, alpha."""
    drawing = replace(drawing_of(Document(curves)), frame=Frame(0.0, 0.0, 10.0, 10.0)).fitted(100, 100)
    image = QImage(100, 100, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(0)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        Painting(drawing, painter, INK).paint(points=False)
    image = image.convertToFormat(QImage.Format.Format_ARGB32)
    return np.frombuffer(image.constBits(), np.uint8).reshape(100, 100, 4).copy()


def test_a_fill_is_visible_through_a_transparent_stroke():
    style = Style(stroke="#ff0000", width=2.0, stroke_opacity=0.5, fill="#0000ff", fill_opacity=0.25)
    seen = painted(line(SQUARE, style, closed=True))
    # The outer half of the stroke, and the inside.
    assert np.abs(seen[50, 6].astype(int) - [0, 0, 255, 128]).max() <= 2
    assert np.abs(seen[50, 50].astype(int) - [255, 0, 0, 64]).max() <= 2
    # The inner half: 1 − 0.5 × 0.75 of all that lies below is covered, a fifth of it by the fill.
    assert np.abs(seen[50, 14].astype(int) - [51, 0, 204, 159]).max() <= 2


def test_dashes_of_no_length_are_dots_under_round_caps():
    style = Style(stroke="#000000", width=1.0, dash=(0.0, 4.0), cap=LineCap.ROUND)
    seen = painted(line([(1.0, 5.0), (9.5, 5.0)], style))
    assert [seen[50, x, 3] > 200 for x in (10, 30, 50, 70, 90)] == [True, False, True, False, True]


def test_a_miter_beyond_its_limit_is_a_bevel():
    wedge = [(1.0, 2.0), (5.0, 8.0), (9.0, 2.0)]
    tips = {}
    for limit in (1.0, 8.0):
        style = Style(stroke="#000000", width=1.5, join=LineJoin.MITER, miter_limit=limit)
        seen = painted(line(wedge, style))
        tips[limit] = int(np.flatnonzero(seen[:, 50, 3] > 128)[0])
    assert tips[8.0] < tips[1.0] - 5


def test_a_line_of_width_zero_is_not_drawn():
    seen = painted(
        line([(1.0, 5.0), (9.0, 5.0)], Style(stroke="#000000", width=0.0)),
        line([(1.0, 1.0), (9.0, 1.0)], Style(stroke="#000000", width=0.5)),
    )
    assert not seen[40:60, :, 3].any()
    assert seen[90, 50, 3] == 255
