"""The grid: one unit along x and y, so one step, at every zoom."""

from __future__ import annotations

import math

import pytest
from PySide6.QtCore import Qt

from app.canvas.grid_layer import adaptive_steps, tick_labels
from app.document.model import Document, make_curve

CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.mark.parametrize("exponent", [-11, -3, -1, 0, 2, 9])
def test_steps_are_round_and_never_dense(exponent):
    for share in range(100):
        scale = 10 ** (exponent + share / 100)
        coarse, fine = adaptive_steps(scale)
        assert 79.9 < coarse * scale < 201
        assert fine * scale > 15.9
        assert round(coarse / fine) in (2, 5)
        for step in (coarse, fine):
            digits = step / 10.0 ** math.floor(math.log10(step) + 1e-9)
            assert min(abs(digits - good) for good in (1, 2, 5)) < 1e-9


def labels(editor, side):
    """The positions and texts of the labels of an axis of the canvas."""
    canvas = editor.window.canvas
    axis, shown = canvas.getAxis(side), canvas.pixel_map
    x_min, y_min, x_max, y_max = shown.box
    low, high, size = (x_min, x_max, shown.width) if side == "bottom" else (y_min, y_max, shown.height)
    levels = axis.tickValues(low, high, size)[: axis.style["maxTextLevel"] + 1]
    (spacing, values) = levels[0]
    return spacing, axis.tickStrings(values, 1.0, spacing)


@pytest.mark.parametrize("notches", [-9, -4, -1, 0, 1, 2, 3, 5, 12])
def test_both_axes_have_the_same_steps_and_labels_at_every_zoom(editor, notches):
    canvas = editor.window.canvas
    canvas.camera.zoom(1.2**notches, canvas.camera.centre())
    editor.settle()
    shown = canvas.pixel_map
    x_levels = canvas.getAxis("bottom").tickSpacing(shown.box[0], shown.box[2], shown.width)
    y_levels = canvas.getAxis("left").tickSpacing(shown.box[1], shown.box[3], shown.height)
    assert x_levels == y_levels
    assert canvas.tools.grid() == x_levels[1][0]
    assert labels(editor, "bottom")[0] == labels(editor, "left")[0] == x_levels[0][0]


def test_what_snaps_to_the_grid_meets_a_fine_line_both_ways(editor):
    editor.session.commit(Document((make_curve(((0.0, 0.0), (4.0, 3.0))),)), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    fine = editor.window.canvas.tools.grid()
    near = editor.pixel
    editor.drag_point(1, to=(4 + 3 * fine + near, 3 - 2 * fine - near), keys=CTRL)
    assert editor.point(1) == pytest.approx((4 + 3 * fine, 3 - 2 * fine), abs=1e-12)


def test_labels_are_decimal_numbers_and_told_apart_far_from_the_origin():
    assert tick_labels([-0.2, 0.0, 0.2, 0.6000000000000001], 1.0, 0.2) == ["−0.2", "0", "0.2", "0.6"]
    far = tick_labels([1e6, 1e6 + 0.02, 1e6 + 0.04], 1.0, 0.02)
    assert far == ["1000000", "1000000.02", "1000000.04"]
    assert tick_labels([], 1.0, 0.2) == []
