"""What reaches Qt of a polyline: everything near the visible area, in short pieces, and nothing far away.

A calm one is painted as Qt paints its pieces, to the pixel; a crowd, which fills the area, all but so.
"""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from app.plotting.drawing import MARGIN, Stroke, covered, polygon, thinned, visible_segments
from curvecore.bezier.flatten import segment_distance

WIDTH, HEIGHT = 300, 200


def wave(count, height=60.0, centre=100.0):
    x = np.linspace(10, 290, count)
    return np.column_stack([x, centre + height * np.sin(x / 17)])


def painted(points, stroke=None, width=WIDTH):
    """Draw as the canvas does, and return the grey values."""
    stroke = stroke or Stroke()
    stroke.fill(points, width, HEIGHT)
    return picture(stroke.draw, width)


def picture(draw, width=WIDTH):
    """Return the grey values of what `draw` does with a painter."""
    image = QImage(width, HEIGHT, QImage.Format.Format_Grayscale8)
    image.fill(QColor("white"))
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(QColor("black"), 2, c=Qt.PenCapStyle.RoundCap))
        draw(painter)
    grey = np.frombuffer(image.constBits(), np.uint8).reshape(HEIGHT, image.bytesPerLine())
    return grey[:, :width].copy()


def painted_by_qt(points, width=WIDTH):
    """Return the grey values of a polyline that Qt joins, 24 segments at a time."""
    pieces = [polygon(*points[i : i + 25].T) for i in range(0, len(points) - 1, 24)]
    return picture(lambda painter: [painter.drawPolyline(piece) for piece in pieces], width)


@pytest.mark.parametrize("count", [2, 3, 24, 25, 26, 49, 300])
def test_pieces_are_drawn_from_end_to_end(count):
    points = wave(count)
    columns = (painted(points) < 128).any(axis=0)
    assert columns[12:288].all()
    assert not columns[:8].any()


@pytest.mark.parametrize("count", [0, 1])
def test_less_than_a_segment_is_nothing(count):
    assert (painted(wave(count)) == 255).all()


def test_a_line_that_leaves_the_area_is_cut_and_continues_where_it_returns():
    points = wave(400, height=1e6)
    segments = visible_segments(points, WIDTH, HEIGHT)
    assert segments.min() >= -MARGIN
    assert segments.max() <= WIDTH + MARGIN
    picture = painted(points) < 128
    # The sine is zero five times: as many upright lines, each with white beside it.
    assert np.count_nonzero(np.diff(picture[100].astype(int)) == 1) == 5


@pytest.mark.parametrize("far", [1e6, 1e12, 1e20, 1e75, 1e300])
def test_a_segment_from_far_away_is_cut_at_the_exact_position(far):
    """It was (0, 0, 0, 0): seen from 1e20 pixels, all that lies in the area is at one place."""
    arrives = visible_segments(np.array([[100 - far, 100 - 2 * far], [100.0, 100.0]]), WIDTH, HEIGHT)
    leaves = visible_segments(np.array([[100.0, 100.0], [100 - far, 100 - 2 * far]]), WIDTH, HEIGHT)
    np.testing.assert_allclose(leaves, [[100, 100, 100 - 75, -50]], atol=1e-6)
    assert (arrives == np.roll(leaves, 2, axis=1)).all()


CALM = {
    "a wave": wave(300),
    "many vertices": wave(5000),
    "a spiral": np.column_stack(
        [150 + (r := np.linspace(2, 95, 3000)) * np.cos(r / 2), 100 + r * np.sin(r / 2)]
    ),
    "a few hundred strokes": np.column_stack([np.linspace(10, 290, 300), np.tile([20.0, 180.0], 150)]),
}


@pytest.mark.parametrize("points", CALM.values(), ids=list(CALM))
def test_a_smooth_curve_is_painted_as_by_qt(points):
    assert (painted(points) == painted_by_qt(points)).all()


def noise(count, height):
    """Return a polyline that crosses the area at every step, a little farther right."""
    x = np.linspace(10, 290, count)
    return np.column_stack([x, 100 + height * np.random.default_rng(5).uniform(-1, 1, count)])


CROWDS = {
    "within the area": noise(1500, 90.0),
    "leaving it": noise(1500, 1e3),
    "leaving it by far": noise(1500, 1e5),
    "with its turns": np.column_stack([np.linspace(10, 290, 6000), 100 + 80 * np.sin(np.arange(6000) / 2)]),
}


@pytest.mark.parametrize("points", CROWDS.values(), ids=list(CROWDS))
def test_a_crowd_is_painted_almost_as_by_qt(points):
    """The bounds are what can be missed: a pixel at a turn, for there are no joints, and a trace of paper.

    Qt fills what a piece covers at once; strokes that cover a pixel by halves, one by one, leave a quarter.
    """
    stroke = Stroke()
    off = np.abs(painted(points, stroke).astype(int) - painted_by_qt(points))
    assert len(stroke._crowd)
    assert off.mean() < 4
    assert (off > 64).mean() < 0.005


def test_separate_segments_of_a_crowd_are_painted_as_by_qt():
    points = np.column_stack([np.linspace(-1e3, 4e3, 1000), np.tile([-2e4, 2e4], 500)])
    stroke = Stroke()
    off = painted(points, stroke, width=3000).astype(int) - painted_by_qt(points, width=3000)
    assert len(stroke._crowd)
    # Antialiasing counts in sixteenths in one of them.
    assert np.abs(off).max() <= 16


def test_segments_at_the_edge_of_an_area_are_distinguished_from_those_inside():
    """Steep strokes and level ones, with a gap of three pixels; then one that ends half-way."""
    at = np.concatenate([np.arange(20.0, 60.0, 0.4), np.arange(63.0, 90.0, 0.4)])
    steep = np.column_stack([at, np.full(len(at), -20.0), at + 30.0, np.full(len(at), 220.0)])
    gap, last = int(np.argmax(np.diff(at))), len(at) - 1
    edges = [0, 1, *range(gap - 1, gap + 3), last - 1, last]
    assert np.flatnonzero(~covered(steep, WIDTH, HEIGHT)).tolist() == edges
    assert np.flatnonzero(~covered(steep[:, [1, 0, 3, 2]], HEIGHT, WIDTH)).tolist() == edges
    steep[20, 2:] = (at[20] + 15.0, 100.0)
    beside_the_end = [18, 19, 21, 22]
    assert np.flatnonzero(~covered(steep, WIDTH, HEIGHT)).tolist() == sorted([*edges, *beside_the_end])


@pytest.mark.parametrize("count", range(6))
def test_a_few_strokes_are_all_at_the_edge(count):
    strokes = np.tile([20.0, -20.0, 20.0, 220.0], (count, 1))
    assert covered(strokes, WIDTH, HEIGHT).tolist() == [False, False, count == 5, False, False][:count]


def test_segments_are_joined_again_where_the_line_calms_down():
    stroke = Stroke()
    painted(CROWDS["leaving it"], stroke)
    assert (painted(wave(300), stroke) == painted_by_qt(wave(300))).all()


def test_a_refilled_stroke_draws_only_the_new_line():
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
