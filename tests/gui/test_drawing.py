"""What reaches Qt of a polyline: everything near the visible area, in short pieces, and nothing far away."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.plotting.drawing import MARGIN, Stroke, thinned, visible_segments
from curvecore.bezier.polylines import segment_distance

WIDTH, HEIGHT = 300, 200


def wave(count, height=60.0, centre=100.0):
    x = np.linspace(10, 290, count)
    return np.column_stack([x, centre + height * np.sin(x / 17)])


def painted(points, stroke=None):
    """Draw as the canvas does, and return the grey values."""
    image = QImage(WIDTH, HEIGHT, QImage.Format.Format_Grayscale8)
    image.fill(QColor("white"))
    stroke = stroke or Stroke()
    stroke.fill(points, WIDTH, HEIGHT)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor("black"), 2, c=Qt.PenCapStyle.RoundCap))
    stroke.draw(painter)
    painter.end()
    grey = np.frombuffer(image.constBits(), np.uint8).reshape(HEIGHT, image.bytesPerLine())
    return grey[:, :WIDTH].copy()


@pytest.mark.parametrize("count", [2, 3, 24, 25, 26, 49, 300])
def test_pieces_are_drawn_from_end_to_end(count):
    points = wave(count)
    columns = (painted(points) < 128).any(axis=0)
    assert columns[12:288].all()
    assert not columns[:8].any()


@pytest.mark.parametrize("count", [0, 1])
def test_less_than_a_segment_is_nothing(count):
    assert (painted(wave(count)) == 255).all()


def test_what_leaves_the_area_is_cut_and_comes_back():
    points = wave(400, height=1e6)
    segments = visible_segments(points, WIDTH, HEIGHT)
    assert segments.min() >= -MARGIN
    assert segments.max() <= WIDTH + MARGIN
    picture = painted(points) < 128
    # The sine is zero five times: as many upright lines, each with white beside it.
    assert np.count_nonzero(np.diff(picture[100].astype(int)) == 1) == 5


def test_a_stroke_filled_again_forgets_what_it_was():
    stroke = Stroke()
    painted(wave(300), stroke)
    again = painted(wave(40, height=20.0), stroke)
    assert (again == painted(wave(40, height=20.0))).all()


@pytest.mark.parametrize("count", [2, 3, 4, 5, 500, 501])
def test_thinning_stays_within_its_tolerance_and_keeps_the_ends(count):
    points = wave(count)
    kept = thinned(points, 0.05)
    assert (kept[[0, -1]] == points[[0, -1]]).all()
    left_out = points[~np.isin(points[:, 0], kept[:, 0])]
    assert len(left_out) > 150 or count < 500
    for point in left_out:
        assert segment_distance(point, kept[:-1], kept[1:]).min() <= 0.05 * np.sqrt(2)
