"""A wide line of separate segments looks as one that Qt joins: no notches, no beads at the joints."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.plotting.drawing import polygon
from app.plotting.pixel_map import PixelMap
from app.plotting.wide_line import RoundLine, WideLine

SIZE = 200
SHOWN = PixelMap(0.0, float(SIZE), 1.0, 1.0, SIZE, SIZE)
"""The plane is the picture, but that y points up."""


def painted(draw, pen):
    """Return how much ink, from 0 to 1, each pixel has."""
    image = QImage(SIZE, SIZE, QImage.Format.Format_Grayscale8)
    image.fill(QColor("white"))
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(pen)
        draw(painter)
    return 1.0 - np.frombuffer(image.constBits(), np.uint8).reshape(SIZE, image.bytesPerLine()) / 255.0


def ours_and_qt(points, width, *, rounded=False):
    """Return the ink of a polyline drawn as the canvas does, and as Qt joins it; with round ends or blunt."""
    line, cap = (RoundLine(), Qt.PenCapStyle.RoundCap) if rounded else (WideLine(), Qt.PenCapStyle.FlatCap)
    line.show(points, SHOWN, width)
    pen = QPen(QColor("black"), width, c=cap, j=Qt.PenJoinStyle.RoundJoin)
    joined = polygon(points[:, 0], SIZE - points[:, 1])
    return painted(line.draw, pen), painted(lambda painter: painter.drawPolyline(joined), pen)


def circle(radius, tolerance=0.1):
    count = int(np.ceil(np.pi / np.arccos(1 - tolerance / radius)))
    angles = np.linspace(0, 2 * np.pi, count + 1)
    return 100.3 + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def wave(count):
    x = np.linspace(10, 190, count)
    return np.column_stack([x, 100 + 60 * np.sin(x / 17)])


@pytest.mark.parametrize("width", [1.5, 2.0, 4.0])
@pytest.mark.parametrize("points", [wave(40), wave(150), circle(6), circle(12), circle(80)])
def test_smooth_lines_have_the_ink_of_a_joined_one(points, width):
    """Of an edge pixel a tenth of a shade on average; nowhere a hole, and all in all hardly bolder."""
    ours, joined = ours_and_qt(points, width)
    assert np.abs(ours - joined)[joined > 0].mean() < 0.06
    assert (ours - joined)[joined > 0.9].min() > -0.3
    assert ours.sum() == pytest.approx(joined.sum(), rel=0.05)


ZIGZAG = np.array([[40.0, 40.0], [150.0, 60.0], [45.0, 90.0], [160.0, 160.0]])


def test_a_sharp_corner_is_closed():
    ours, joined = ours_and_qt(ZIGZAG, 4.0)
    assert (ours - joined)[joined > 0.9].min() > -0.3


@pytest.mark.parametrize("width", [1.5, 3.0, 8.0])
@pytest.mark.parametrize("points", [wave(40), wave(150), circle(12), circle(80), ZIGZAG])
def test_round_ends_and_corners_match_those_of_qt(points, width):
    """Neither lacks any ink, nor does any lie where Qt has none."""
    ours, joined = ours_and_qt(points, width, rounded=True)
    assert np.abs(ours - joined)[joined > 0].mean() < 0.06
    assert (ours - joined)[joined > 0.9].min() > -0.3
    assert ours[joined == 0].max() < 0.3
    assert ours.sum() == pytest.approx(joined.sum(), rel=0.05)


def test_a_line_restores_the_pen_of_the_painter():
    """What is drawn next has the ends of the pen that was set."""
    pen = QPen(QColor("black"), 8.0, c=Qt.PenCapStyle.RoundCap)
    line, dot = RoundLine(), polygon(np.array([150.0]), np.array([20.0]))

    def draw(painter):
        line.show(wave(40), SHOWN, 8.0)
        line.draw(painter)
        painter.drawPoints(dot)

    assert painted(draw, pen)[20, 150] == 1.0
    assert painted(draw, pen)[16, 146] < 0.5


def test_a_round_line_outside_of_the_area_draws_nothing():
    away = np.array([[1e6, 100.0], [2e6, 100.0]])
    assert ours_and_qt(away, 3.0, rounded=True)[0].sum() == 0


def test_a_repeated_vertex_and_an_empty_line_draw_nothing():
    twice = np.array([[40.0, 40.0], [40.0, 40.0], [160.0, 160.0]])
    assert ours_and_qt(twice, 2.0)[0].sum() > 100
    assert ours_and_qt(twice[:1], 2.0)[0].sum() == ours_and_qt(twice[:0], 2.0)[0].sum() == 0


def test_only_the_part_of_a_line_near_the_area_is_drawn():
    far = np.array([[-1e6, 100.0], [1e6, 100.0]])
    assert (ours_and_qt(far, 2.0)[0][100] > 0.4).all()
