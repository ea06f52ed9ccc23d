"""The drawing that pictures are made from: exact extents, frames, fitting."""

import numpy as np
import pytest

from app.document.model import Document, make_curve
from app.exchange.drawing.drawing import drawing_of
from app.exchange.options import automatic_tolerance
from app.view_model.extents import extent_of
from tests.rows import each_row


def cubic(pieces, s):
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3])
    return np.einsum("ks,pkd->psd", weights, pieces).reshape(-1, 2)


@pytest.mark.parametrize("seed", range(5))
def test_the_extent_is_that_of_dense_samples(seed):
    pieces = np.random.default_rng(seed).normal(size=(6, 4, 2))
    samples = cubic(pieces, np.linspace(0, 1, 20001))
    low, high = extent_of(pieces)
    # Next to an extreme the curve falls off with the square of the distance: |c''| / 8 · step².
    np.testing.assert_allclose([low, high], [samples.min(axis=0), samples.max(axis=0)], atol=1e-7)
    assert (low <= samples.min(axis=0) + 1e-15).all()
    assert (high >= samples.max(axis=0) - 1e-15).all()


def test_the_extent_of_lines_parabolas_and_dots():
    straight = np.array([[(0, 0), (1, 2), (2, 4), (3, 6)]], dtype=float)
    np.testing.assert_allclose(extent_of(straight), [(0, 0), (3, 6)])
    # A parabola raised to a cubic: the quadratic that is solved loses its leading term.
    arch = np.array([[(0, 0), (1, 2), (2, 2), (3, 0)]], dtype=float)
    np.testing.assert_allclose(extent_of(arch), [(0, 0), (3, 1.5)])
    np.testing.assert_array_equal(extent_of(np.ones((1, 4, 2))), np.ones((2, 2)))


def test_fitting_keeps_the_shape_and_centres(sketch):
    drawing = drawing_of(sketch)
    fitted = drawing.fitted(500, 2000)
    before, after = drawing.outlines[0].points, fitted.outlines[0].points
    scale = 500 / drawing.frame.width
    np.testing.assert_allclose(np.diff(after, axis=0), scale * np.diff(before, axis=0), atol=1e-9)
    frame = drawing.frame
    middle = (frame.left + frame.width / 2, frame.bottom + frame.height / 2)
    np.testing.assert_allclose(after[0] - (250, 1000), scale * (before[0] - middle), atol=1e-9)
    assert fitted.deviation == drawing.deviation


@each_row(
    ("size", "unit", "tolerance"),
    [
        (9.0, "", 4e-4),
        (10.0, "", 5e-4),
        (800.0, "px", 0.03),  # 0.01 mm are 0.0378 px
        (100.0, "mm", 0.005),
        (200.0, "mm", 0.01),
        (2000.0, "mm", 0.01),
        (2.0, "m", 1e-5),
        (1e-9, "", 5e-14),
        (0.0, "", 5e-5),
    ],
)
def test_the_automatic_tolerance_is_what_an_eye_and_a_laser_cutter_need(size, unit, tolerance):
    document = Document((make_curve([(0.0, 0.0), (size, size / 2)]),), unit=unit)
    assert automatic_tolerance(document) == tolerance
